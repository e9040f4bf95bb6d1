"""Implements arithmetic and NumPy's functions for traced numbers and for dimensions."""

from __future__ import annotations

import math
from typing import Any, NoReturn, Optional, TypeVar

import numpy as np

from . import _mistakes
from ._place import users_line
from ._ufunc import Operand

N = TypeVar("N", bound="Number")


class Number(Operand):
    """A number that records its operations.

    Each subclass says how operators and functions are written.
    """

    __slots__ = ()

    def _operator(self: N, sign: str, other: Any, swapped: bool = False) -> N:
        raise NotImplementedError

    def _one(self: N, method: str) -> N:
        raise NotImplementedError

    def _two(self: N, method: str, other: Any, swapped: bool = False) -> N:
        """A function of two numbers; NotImplemented if the other is none."""
        raise NotImplementedError

    def _powi(self: N, exponent: int) -> N:
        raise NotImplementedError

    def _compared(self, sign: str, other: Any) -> Any:
        raise NotImplementedError

    def _like(self: N, other: Any) -> N:
        """A plain number as one of this kind."""
        raise NotImplementedError

    def _method(self: N, method: str, other: Any) -> N:
        made = self._two(method, other)
        if made is NotImplemented:
            raise TypeError(f"`{method}` of {self!r} needs a number, not {type(other).__name__}")
        return made

    def __array__(self, *_: Any, **__: Any) -> Any:
        # An array of objects: NumPy works on its items one by one.
        array = np.empty((), dtype=object)
        array[()] = self
        return array

    def __add__(self: N, other: Any) -> N:
        return self._operator("+", other)

    def __radd__(self: N, other: Any) -> N:
        return self if isinstance(other, int) and other == 0 else self._operator("+", other, swapped=True)

    def __sub__(self: N, other: Any) -> N:
        return self._operator("-", other)

    def __rsub__(self: N, other: Any) -> N:
        return self._operator("-", other, swapped=True)

    def __mul__(self: N, other: Any) -> N:
        return self._operator("*", other)

    def __rmul__(self: N, other: Any) -> N:
        return self._operator("*", other, swapped=True)

    def __truediv__(self: N, other: Any) -> N:
        return self._operator("/", other)

    def __rtruediv__(self: N, other: Any) -> N:
        return self._operator("/", other, swapped=True)

    def __pos__(self: N) -> N:
        return self

    def __abs__(self: N) -> N:
        return self._one("abs")

    def __pow__(self: N, other: Any, modulus: Any = None) -> N:
        if modulus is not None:
            return NotImplemented  # type: ignore[no-any-return, return-value, unused-ignore]
        if isinstance(other, (int, float, np.floating, np.integer)):
            exponent = float(other)
            if exponent.is_integer() and abs(exponent) <= 64:
                return self._powi(int(exponent))
            if exponent == 0.5:
                return self._one("sqrt")
        return self._two("powf", other)

    def __rpow__(self: N, other: Any) -> N:
        return self._two("powf", other, swapped=True)

    def __floordiv__(self: N, other: Any) -> N:
        quotient = self.__truediv__(other)
        return quotient if quotient is NotImplemented else quotient._one("floor")

    def __rfloordiv__(self: N, other: Any) -> N:
        quotient = self.__rtruediv__(other)
        return quotient if quotient is NotImplemented else quotient._one("floor")

    def __mod__(self: N, other: Any) -> N:
        # Python's remainder has the sign of the divisor.
        whole = self.__floordiv__(other)
        return whole if whole is NotImplemented else self - whole * other

    def __rmod__(self: N, other: Any) -> N:
        whole = self.__rfloordiv__(other)
        return whole if whole is NotImplemented else self._like(other) - whole * self

    def __divmod__(self, other: Any) -> Any:
        return self // other, self % other

    def __rdivmod__(self, other: Any) -> Any:
        return other // self, other % self

    def __lt__(self, other: Any) -> Any:
        return self._compared("<", other)

    def __le__(self, other: Any) -> Any:
        return self._compared("<=", other)

    def __gt__(self, other: Any) -> Any:
        return self._compared(">", other)

    def __ge__(self, other: Any) -> Any:
        return self._compared(">=", other)

    def __eq__(self, other: Any) -> Any:
        return self._compared("==", other)

    def __ne__(self, other: Any) -> Any:
        return self._compared("!=", other)

    def __hash__(self) -> int:
        raise NotImplementedError

    def __floor__(self: N) -> N:
        return self._one("floor")

    def __ceil__(self: N) -> N:
        return self._one("ceil")

    def __trunc__(self: N) -> N:
        return self._one("trunc")

    def __round__(self, digits: Optional[int] = None) -> Any:
        _mistakes.at(users_line(), "`round` goes to even numbers: write kin.floor(x + 0.5)")

    def __iter__(self) -> NoReturn:
        _mistakes.as_plain(users_line(), "a number has no components")

    def __len__(self) -> int:
        _mistakes.as_plain(users_line(), "a number has no components")

    def __getitem__(self, key: Any) -> NoReturn:
        _mistakes.as_plain(users_line(), "a number has no components")

    # The names by which NumPy asks the items of arrays of objects.
    def sin(self: N) -> N:
        return self._one("sin")

    def cos(self: N) -> N:
        return self._one("cos")

    def tan(self: N) -> N:
        return self._one("tan")

    def arcsin(self: N) -> N:
        return self._one("asin")

    def arccos(self: N) -> N:
        return self._one("acos")

    def arctan(self: N) -> N:
        return self._one("atan")

    def arctan2(self: N, x: Any) -> N:
        return self._method("atan2", x)

    def sinh(self: N) -> N:
        return self._one("sinh")

    def cosh(self: N) -> N:
        return self._one("cosh")

    def tanh(self: N) -> N:
        return self._one("tanh")

    def arcsinh(self: N) -> N:
        return self._one("asinh")

    def arccosh(self: N) -> N:
        return self._one("acosh")

    def arctanh(self: N) -> N:
        return self._one("atanh")

    def exp(self: N) -> N:
        return self._one("exp")

    def exp2(self: N) -> N:
        return self._one("exp2")

    def expm1(self: N) -> N:
        return self._one("exp_m1")

    def log(self: N) -> N:
        return self._one("ln")

    def log1p(self: N) -> N:
        return self._one("ln_1p")

    def log2(self: N) -> N:
        return self._one("log2")

    def log10(self: N) -> N:
        return self._one("log10")

    def sqrt(self: N) -> N:
        return self._one("sqrt")

    def cbrt(self: N) -> N:
        return self._one("cbrt")

    def hypot(self: N, y: Any) -> N:
        return self._method("hypot", y)

    def floor(self: N) -> N:
        return self._one("floor")

    def ceil(self: N) -> N:
        return self._one("ceil")

    def trunc(self: N) -> N:
        return self._one("trunc")

    def deg2rad(self: N) -> N:
        return self * (math.pi / 180.0)

    def rad2deg(self: N) -> N:
        return self * (180.0 / math.pi)

    radians = deg2rad
    degrees = rad2deg

    def square(self: N) -> N:
        return self._powi(2)

    def reciprocal(self: N) -> N:
        return 1.0 / self

    def conjugate(self: N) -> N:
        return self

    def fabs(self: N) -> N:
        return self._one("abs")

    def maximum(self: N, other: Any) -> N:
        return self._method("max", other)

    def minimum(self: N, other: Any) -> N:
        return self._method("min", other)
