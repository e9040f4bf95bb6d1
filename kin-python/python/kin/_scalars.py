"""Numbers of a traced function: what the function does with them is written down as text of Kin's language."""

from __future__ import annotations

import linecache
import math
import os
import sys
from typing import TYPE_CHECKING, Any, Callable, NoReturn, Optional, Union

import numpy as np

from . import _mistakes

if TYPE_CHECKING:
    from ._trace import Trace

HERE = os.path.dirname(os.path.abspath(__file__))


def users_line() -> tuple[str, int]:
    """File and line of the innermost frame that is not of this package or of NumPy."""
    frame = sys._getframe(1)
    numpy_home = os.path.dirname(np.__file__)
    while frame is not None:
        name = frame.f_code.co_filename
        if not name.startswith((HERE, numpy_home)):
            return name, frame.f_lineno
        if frame.f_back is None:
            break
        frame = frame.f_back
    return "?", 0


class Traced:
    """Anything that stands for a part of a traced function: a node of its trace."""

    __slots__ = ("_trace", "_node")
    # NumPy hands arithmetic with arrays over to `__array_ufunc__`.
    __array_priority__ = 1000.0

    def __init__(self, trace: "Trace", node: int) -> None:
        self._trace = trace
        self._node = node

    def __repr__(self) -> str:
        return self._trace.inline(self._node)

    def __hash__(self) -> int:
        return hash((id(self._trace), self._node))

    def __bool__(self) -> bool:
        _mistakes.condition(users_line())

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **keywords: Any) -> Any:
        return _array_ufunc(ufunc, method, inputs, keywords)

    def __array_function__(self, function: Any, types: Any, args: Any, keywords: Any) -> Any:
        from . import _arrays

        return _arrays.apply(function, args, keywords)


class Condition(Traced):
    """A comparison of traced numbers: for `kin.where`, `&`, `|` and `~`."""

    __slots__ = ()

    def __and__(self, other: Any) -> "Condition":
        return self._trace.both("&&", self, other)

    def __or__(self, other: Any) -> "Condition":
        return self._trace.both("||", self, other)

    __rand__ = __and__
    __ror__ = __or__

    def __invert__(self) -> "Condition":
        return Condition(self._trace, self._trace.op("!{}", "bool", self._node))


class Expr(Traced):
    """A traced number."""

    __slots__ = ()

    def _two(self, template: str, other: Any, swapped: bool = False) -> "Expr":
        operand = self._trace.number(other)
        if operand is None:
            return NotImplemented  # type: ignore[no-any-return]
        pair = (operand, self._node) if swapped else (self._node, operand)
        return Expr(self._trace, self._trace.op(template, "f64", *pair))

    def _one(self, method: str) -> "Expr":
        return Expr(self._trace, self._trace.op("{}." + method + "()", "f64", self._node))

    def _method(self, method: str, other: Any) -> "Expr":
        made = self._two("{}." + method + "({:a})", other)
        if made is NotImplemented:
            raise TypeError(f"`{method}` of a traced number needs a number, not {type(other).__name__}")
        return made

    def _compared(self, sign: str, other: Any) -> Condition:
        operand = self._trace.number(other)
        if operand is None:
            return NotImplemented  # type: ignore[no-any-return]
        return Condition(self._trace, self._trace.op("{} " + sign + " {}", "bool", self._node, operand))

    def __add__(self, other: Any) -> "Expr":
        return self._two("{} + {}", other)

    def __radd__(self, other: Any) -> "Expr":
        return self if _is_zero(other) else self._two("{} + {}", other, swapped=True)

    def __sub__(self, other: Any) -> "Expr":
        return self._two("{} - {}", other)

    def __rsub__(self, other: Any) -> "Expr":
        return self._two("{} - {}", other, swapped=True)

    def __mul__(self, other: Any) -> "Expr":
        return self._two("{} * {}", other)

    def __rmul__(self, other: Any) -> "Expr":
        return self._two("{} * {}", other, swapped=True)

    def __truediv__(self, other: Any) -> "Expr":
        return self._two("{} / {}", other)

    def __rtruediv__(self, other: Any) -> "Expr":
        return self._two("{} / {}", other, swapped=True)

    def __neg__(self) -> "Expr":
        return Expr(self._trace, self._trace.op("-{}", "f64", self._node))

    def __pos__(self) -> "Expr":
        return self

    def __abs__(self) -> "Expr":
        return self._one("abs")

    def __pow__(self, other: Any, modulus: Any = None) -> "Expr":
        if modulus is not None:
            return NotImplemented
        if isinstance(other, (int, float, np.floating, np.integer)):
            exponent = float(other)
            if exponent.is_integer() and abs(exponent) <= 64:
                return Expr(self._trace, self._trace.op("{}.powi(" + str(int(exponent)) + ")", "f64", self._node))
            if exponent == 0.5:
                return self._one("sqrt")
        return self._two("{}.powf({:a})", other)

    def __rpow__(self, other: Any) -> "Expr":
        return self._two("{}.powf({:a})", other, swapped=True)

    def __floordiv__(self, other: Any) -> "Expr":
        quotient = self.__truediv__(other)
        return quotient if quotient is NotImplemented else quotient._one("floor")

    def __rfloordiv__(self, other: Any) -> "Expr":
        quotient = self.__rtruediv__(other)
        return quotient if quotient is NotImplemented else quotient._one("floor")

    def __mod__(self, other: Any) -> "Expr":
        # Python's remainder has the sign of the divisor.
        whole = self.__floordiv__(other)
        return whole if whole is NotImplemented else self - whole * other

    def __rmod__(self, other: Any) -> "Expr":
        whole = self.__rfloordiv__(other)
        return whole if whole is NotImplemented else self._trace.expression(other) - whole * self

    def __divmod__(self, other: Any) -> Any:
        return self // other, self % other

    def __lt__(self, other: Any) -> Condition:
        return self._compared("<", other)

    def __le__(self, other: Any) -> Condition:
        return self._compared("<=", other)

    def __gt__(self, other: Any) -> Condition:
        return self._compared(">", other)

    def __ge__(self, other: Any) -> Condition:
        return self._compared(">=", other)

    def __eq__(self, other: Any) -> Any:
        return self._compared("==", other)

    def __ne__(self, other: Any) -> Any:
        return self._compared("!=", other)

    __hash__ = Traced.__hash__

    def __floor__(self) -> "Expr":
        return self._one("floor")

    def __ceil__(self) -> "Expr":
        return self._one("ceil")

    def __trunc__(self) -> "Expr":
        return self._one("trunc")

    def __float__(self) -> float:
        _mistakes.plain_number(users_line())

    def __int__(self) -> int:
        _mistakes.count(users_line())

    def __index__(self) -> int:
        _mistakes.count(users_line())

    def __round__(self, digits: Optional[int] = None) -> Any:
        _mistakes.at(users_line(), "`round` goes to even numbers: write kin.floor(x + 0.5)")

    def __iter__(self) -> NoReturn:
        _mistakes.at(users_line(), "a number has no components")

    def __len__(self) -> int:
        _mistakes.at(users_line(), "a number has no components")

    def __getitem__(self, key: Any) -> NoReturn:
        _mistakes.at(users_line(), "a number has no components")

    def __array__(self, *_: Any, **__: Any) -> Any:
        # An array of objects: NumPy works on its items one by one.
        array = np.empty((), dtype=object)
        array[()] = self
        return array

    # The names by which NumPy asks the items of arrays of objects.
    def sin(self) -> "Expr":
        return self._one("sin")

    def cos(self) -> "Expr":
        return self._one("cos")

    def tan(self) -> "Expr":
        return self._one("tan")

    def arcsin(self) -> "Expr":
        return self._one("asin")

    def arccos(self) -> "Expr":
        return self._one("acos")

    def arctan(self) -> "Expr":
        return self._one("atan")

    def arctan2(self, x: Any) -> "Expr":
        return self._method("atan2", x)

    def sinh(self) -> "Expr":
        return self._one("sinh")

    def cosh(self) -> "Expr":
        return self._one("cosh")

    def tanh(self) -> "Expr":
        return self._one("tanh")

    def arcsinh(self) -> "Expr":
        return self._one("asinh")

    def arccosh(self) -> "Expr":
        return self._one("acosh")

    def arctanh(self) -> "Expr":
        return self._one("atanh")

    def exp(self) -> "Expr":
        return self._one("exp")

    def exp2(self) -> "Expr":
        return self._one("exp2")

    def expm1(self) -> "Expr":
        return self._one("exp_m1")

    def log(self) -> "Expr":
        return self._one("ln")

    def log1p(self) -> "Expr":
        return self._one("ln_1p")

    def log2(self) -> "Expr":
        return self._one("log2")

    def log10(self) -> "Expr":
        return self._one("log10")

    def sqrt(self) -> "Expr":
        return self._one("sqrt")

    def cbrt(self) -> "Expr":
        return self._one("cbrt")

    def hypot(self, y: Any) -> "Expr":
        return self._method("hypot", y)

    def floor(self) -> "Expr":
        return self._one("floor")

    def ceil(self) -> "Expr":
        return self._one("ceil")

    def trunc(self) -> "Expr":
        return self._one("trunc")

    def deg2rad(self) -> "Expr":
        return self * (math.pi / 180.0)

    def rad2deg(self) -> "Expr":
        return self * (180.0 / math.pi)

    radians = deg2rad
    degrees = rad2deg

    def square(self) -> "Expr":
        return Expr(self._trace, self._trace.op("{}.powi(2)", "f64", self._node))

    def reciprocal(self) -> "Expr":
        return 1.0 / self

    def conjugate(self) -> "Expr":
        return self

    def fabs(self) -> "Expr":
        return self._one("abs")

    def sign(self) -> Any:
        """0 at 0, as NumPy's; its slope is 0."""
        from ._functions import where

        return where(self > 0.0, 1.0, where(self < 0.0, -1.0, 0.0))

    def maximum(self, other: Any) -> "Expr":
        return self._method("max", other)

    def minimum(self, other: Any) -> "Expr":
        return self._method("min", other)


Scalar = Union[float, Expr]


def _is_zero(other: Any) -> bool:
    return isinstance(other, int) and other == 0


_RENAMED: dict[str, Callable[..., Any]] = {
    "add": lambda a, b: a + b,
    "subtract": lambda a, b: a - b,
    "multiply": lambda a, b: a * b,
    "divide": lambda a, b: a / b,
    "true_divide": lambda a, b: a / b,
    "floor_divide": lambda a, b: a // b,
    "remainder": lambda a, b: a % b,
    "mod": lambda a, b: a % b,
    "power": lambda a, b: a**b,
    "float_power": lambda a, b: a**b,
    "negative": lambda a: -a,
    "positive": lambda a: +a,
    "absolute": abs,
    "less": lambda a, b: a < b,
    "less_equal": lambda a, b: a <= b,
    "greater": lambda a, b: a > b,
    "greater_equal": lambda a, b: a >= b,
    "equal": lambda a, b: a == b,
    "not_equal": lambda a, b: a != b,
    "logical_and": lambda a, b: a & b,
    "logical_or": lambda a, b: a | b,
    "logical_not": lambda a: ~a,
    "matmul": lambda a, b: a @ b,
    "fmax": lambda a, b: _two(a, b, "maximum"),
    "fmin": lambda a, b: _two(a, b, "minimum"),
    "maximum": lambda a, b: _two(a, b, "maximum"),
    "minimum": lambda a, b: _two(a, b, "minimum"),
    "arctan2": lambda a, b: _two(a, b, "arctan2"),
    "hypot": lambda a, b: _two(a, b, "hypot"),
}


def _two(a: Any, b: Any, name: str) -> Any:
    """A function of two numbers, one of which is traced; the other may be plain."""
    if isinstance(a, Expr):
        return getattr(a, name)(b)
    if isinstance(b, Expr):
        return getattr(b._trace.expression(a), name)(b)
    return getattr(np, name)(a, b)


def _array_ufunc(ufunc: Any, method: str, inputs: tuple[Any, ...], keywords: dict[str, Any]) -> Any:
    """A function of NumPy on traced numbers; with arrays among them item by item."""
    name = ufunc.__name__
    if method != "__call__" or any(value is not None for key, value in keywords.items() if key != "dtype"):
        _mistakes.at(users_line(), f"`np.{name}` with these keywords, or as `.{method}`, cannot be traced")
    function = _RENAMED.get(name)
    if function is None:
        if not hasattr(Expr, name) or ufunc.nin != 1:
            _mistakes.at(users_line(), f"`np.{name}` has no derivative here; there are the functions of `kin`")
        function = lambda x: getattr(x, name)() if isinstance(x, Traced) else ufunc(x)  # noqa: E731
    inputs = tuple(x.item() if isinstance(x, np.ndarray) and x.ndim == 0 else x for x in inputs)
    if any(isinstance(x, np.ndarray) for x in inputs):
        if any(not isinstance(x, (Expr, np.ndarray, int, float, np.number)) for x in inputs):
            return function(*inputs)
        return np.frompyfunc(function, len(inputs), 1)(*inputs)
    return function(*inputs)


def line_of(place: tuple[str, int]) -> str:
    """The text of a line of a program."""
    return linecache.getline(*place).strip()
