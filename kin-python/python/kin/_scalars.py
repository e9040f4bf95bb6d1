"""Numbers of a traced function: what the function does with them is written down as text of Kin's language."""

from __future__ import annotations

import linecache
from typing import TYPE_CHECKING, Any, Callable, Union

import numpy as np

from . import _mistakes
from ._number import Number
from ._place import users_line

if TYPE_CHECKING:
    from ._trace import Trace


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

    def __format__(self, _: str) -> str:
        # Its value is not known: however its digits are asked for, it is shown as what it is.
        return repr(self)

    def __bool__(self) -> bool:
        _mistakes.condition(users_line())


class Condition(Traced):
    """A comparison of traced numbers: for `kin.where`, `&`, `|` and `~`."""

    __slots__ = ()

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **keywords: Any) -> Any:
        return array_ufunc(ufunc, method, inputs, keywords)

    def __array_function__(self, function: Any, types: Any, args: Any, keywords: Any) -> Any:
        from . import _arrays

        return _arrays.apply(function, args, keywords)

    def __and__(self, other: Any) -> "Condition":
        return self._trace.both("&&", self, other)

    def __or__(self, other: Any) -> "Condition":
        return self._trace.both("||", self, other)

    __rand__ = __and__
    __ror__ = __or__

    def __invert__(self) -> "Condition":
        return Condition(self._trace, self._trace.op("!{}", "bool", self._node))


class Expr(Traced, Number):
    """A traced number."""

    __slots__ = ()

    def _op(self, template: str, other: Any, swapped: bool) -> "Expr":
        operand = self._trace.number(other)
        if operand is None:
            return NotImplemented  # type: ignore[no-any-return, return-value, unused-ignore]
        pair = (operand, self._node) if swapped else (self._node, operand)
        return Expr(self._trace, self._trace.op(template, "f64", *pair))

    def _operator(self, sign: str, other: Any, swapped: bool = False) -> "Expr":
        return self._op("{} " + sign + " {}", other, swapped)

    def _two(self, method: str, other: Any, swapped: bool = False) -> "Expr":
        return self._op("{}." + method + "({:a})", other, swapped)

    def _one(self, method: str) -> "Expr":
        return Expr(self._trace, self._trace.op("{}." + method + "()", "f64", self._node))

    def _powi(self, exponent: int) -> "Expr":
        return Expr(self._trace, self._trace.op("{}.powi(" + str(exponent) + ")", "f64", self._node))

    def _compared(self, sign: str, other: Any) -> Any:
        operand = self._trace.number(other)
        if operand is None:
            return NotImplemented
        return Condition(self._trace, self._trace.op("{} " + sign + " {}", "bool", self._node, operand))

    def _like(self, other: Any) -> "Expr":
        return self._trace.expression(other)

    def __neg__(self) -> "Expr":
        return Expr(self._trace, self._trace.op("-{}", "f64", self._node))

    __hash__ = Traced.__hash__

    def __float__(self) -> float:
        _mistakes.plain_number(users_line())

    def __int__(self) -> int:
        _mistakes.count(users_line())

    def __index__(self) -> int:
        _mistakes.count(users_line())

    def sign(self) -> Any:
        """0 at 0, as NumPy's; its slope is 0."""
        from ._functions import where

        return where(self > 0.0, 1.0, where(self < 0.0, -1.0, 0.0))


Scalar = Union[float, Expr]


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
    """A function of two numbers, one of which may be traced or a dimension."""
    if isinstance(a, Number):
        return getattr(a, name)(b)
    if isinstance(b, Number):
        return getattr(b._like(a), name)(b)
    return getattr(np, name)(a, b)


def array_ufunc(ufunc: Any, method: str, inputs: tuple[Any, ...], keywords: dict[str, Any]) -> Any:
    """A function of NumPy on traced numbers or dimensions; with arrays among them item by item."""
    name = ufunc.__name__
    if method != "__call__" or any(value is not None for key, value in keywords.items() if key != "dtype"):
        _mistakes.at(users_line(), f"`np.{name}` with these keywords, or as `.{method}`, cannot be traced")
    function = _RENAMED.get(name)
    if function is None:
        if not hasattr(Expr, name) or ufunc.nin != 1:
            _mistakes.at(users_line(), f"`np.{name}` has no derivative here; there are the functions of `kin`")
        function = lambda x: getattr(x, name)() if isinstance(x, Number) else ufunc(x)  # noqa: E731
    inputs = tuple(x.item() if isinstance(x, np.ndarray) and x.ndim == 0 else x for x in inputs)
    if any(isinstance(x, np.ndarray) for x in inputs):
        if any(not isinstance(x, (Number, np.ndarray, int, float, np.number)) for x in inputs):
            return function(*inputs)
        return np.frompyfunc(function, len(inputs), 1)(*inputs)
    return function(*inputs)


def line_of(place: tuple[str, int]) -> str:
    """The text of a line of a program."""
    return linecache.getline(*place).strip()
