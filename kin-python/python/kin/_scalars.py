"""Defines the numbers of a traced function, which write their operations as text in Kin's language."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Union

from . import _mistakes
from ._number import Number
from ._place import users_line
from ._ufunc import Operand

if TYPE_CHECKING:
    from ._trace import Trace


class Traced(Operand):
    """A part of a traced function: a node of its trace."""

    __slots__ = ("_trace", "_node")

    def __init__(self, trace: "Trace", node: int) -> None:
        self._trace = trace
        self._node = node

    def __repr__(self) -> str:
        return self._trace.inline(self._node)

    def __hash__(self) -> int:
        # A table would be searched for the stand-in, and not for the number that it stands for.
        _mistakes.key(users_line())

    def __format__(self, _: str) -> str:
        # Its value is not known: however its digits are asked for, it is shown as what it is.
        return repr(self)

    def __bool__(self) -> bool:
        _mistakes.condition(users_line(), isinstance(self, Number), self._trace.is_moving(self._node))


class Condition(Traced):
    """A comparison of traced numbers, for `kin.where`, `&`, `|` and `~`."""

    __slots__ = ()

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

    def __complex__(self) -> complex:
        _mistakes.plain_number(users_line())

    def __getattr__(self, name: str) -> Any:
        # What a plain number has would be there when the function is called with plain numbers.
        if not name.startswith("__") and hasattr(float, name):
            _mistakes.at(users_line(), f"`{name}` of a coordinate or parameter is not known here: use the number itself")
        raise AttributeError(f"`{self!r}` has no attribute `{name}`")

    def __index__(self) -> int:
        _mistakes.count(users_line())

    def sign(self) -> Any:
        """Returns the sign; 0 at 0 as in NumPy, with the slope 0."""
        from ._functions import where

        return where(self > 0.0, 1.0, where(self < 0.0, -1.0, 0.0))


Scalar = Union[float, Expr]
