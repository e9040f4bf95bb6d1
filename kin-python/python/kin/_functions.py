"""Defines functions of plain and traced numbers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Protocol, overload

import numpy as np

from . import _mistakes
from ._number import Number
from ._place import users_line
from ._scalars import Condition, Expr, Scalar
from ._ufunc import itemwise, two

if TYPE_CHECKING:
    from ._dimension import Dimension


class Function(Protocol):
    """A function of one number.

    A plain number gives a plain number, a traced number a traced number, a dimension an expression, and an array an
    array.
    """

    @overload
    def __call__(self, x: float) -> float: ...
    @overload
    def __call__(self, x: Expr) -> Expr: ...
    @overload
    def __call__(self, x: "Dimension") -> "Dimension": ...
    @overload
    def __call__(self, x: "np.ndarray[Any, Any]") -> "np.ndarray[Any, Any]": ...


def _one(name: str, numpys: str, formula: str) -> Function:
    plain = getattr(np, numpys)

    def function(x: Any) -> Any:
        if isinstance(x, Number):
            return getattr(x, numpys)()
        if isinstance(x, np.ndarray) and x.dtype == object:
            return itemwise(function, x)
        made = plain(x)
        return float(made) if isinstance(x, (int, float)) else made

    function.__name__ = function.__qualname__ = name
    function.__doc__ = f"{formula}, of a plain or traced number, or of an array of them."
    return function


sin = _one("sin", "sin", "sin x   [rad]")
cos = _one("cos", "cos", "cos x   [rad]")
tan = _one("tan", "tan", "tan x   [rad]")
asin = _one("asin", "arcsin", "arcsin x   [rad]")
acos = _one("acos", "arccos", "arccos x   [rad]")
atan = _one("atan", "arctan", "arctan x   [rad]")
sinh = _one("sinh", "sinh", "sinh x")
cosh = _one("cosh", "cosh", "cosh x")
tanh = _one("tanh", "tanh", "tanh x")
asinh = _one("asinh", "arcsinh", "arsinh x")
acosh = _one("acosh", "arccosh", "arcosh x")
atanh = _one("atanh", "arctanh", "artanh x")
exp = _one("exp", "exp", "eˣ")
exp2 = _one("exp2", "exp2", "2ˣ")
expm1 = _one("expm1", "expm1", "eˣ − 1")
log = _one("log", "log", "ln x")
log1p = _one("log1p", "log1p", "ln(1 + x)")
log2 = _one("log2", "log2", "log₂ x")
log10 = _one("log10", "log10", "log₁₀ x")
sqrt = _one("sqrt", "sqrt", "√x")
cbrt = _one("cbrt", "cbrt", "∛x")
floor = _one("floor", "floor", "the largest whole number ≤ x; slope 0")
ceil = _one("ceil", "ceil", "the smallest whole number ≥ x; slope 0")
trunc = _one("trunc", "trunc", "the whole part of x; slope 0")
sign = _one("sign", "sign", "−1, 0 or 1; slope 0")
fabs = _one("fabs", "fabs", "|x|; slope 1 at 0")
radians = _one("radians", "radians", "degrees as radians")
degrees = _one("degrees", "degrees", "radians as degrees")


def atan2(y: Scalar, x: Scalar) -> Any:
    """Returns the angle of (x, y) from the x-axis, in (−π, π]. [rad]"""
    return two("arctan2", y, x)


def hypot(x: Scalar, y: Scalar) -> Any:
    """Returns √(x² + y²)."""
    return two("hypot", x, y)


def maximum(a: Scalar, b: Scalar, *more: Scalar) -> Any:
    """Returns the larger number; if both are equal, the derivatives are those of the first."""
    found = two("maximum", a, b)
    for one in more:
        found = two("maximum", found, one)
    return found


def minimum(a: Scalar, b: Scalar, *more: Scalar) -> Any:
    """Returns the smaller number; if both are equal, the derivatives are those of the first."""
    found = two("minimum", a, b)
    for one in more:
        found = two("minimum", found, one)
    return found


def power(x: Scalar, y: Scalar) -> Any:
    """Returns x to the power y."""
    if isinstance(x, int) and isinstance(y, int):
        # Numbers are floats here: a whole one of a million digits would be computed for hours.
        return float(x) ** y
    return x**y


def clip(x: Scalar, low: Scalar, high: Scalar) -> Any:
    """Returns x limited to the range from low to high."""
    return minimum(maximum(x, low), high)


def where(condition: Any, a: Any, b: Any) -> Any:
    """Returns a if the condition holds, otherwise b.

    Both are numbers, vectors, or lists of the same length.
    """
    from ._vectors import _Components

    if not isinstance(condition, Condition):
        if isinstance(condition, (bool, np.bool_)):
            return a if condition else b
        if isinstance(condition, np.ndarray) and condition.dtype != object:
            return np.where(condition, a, b)
        if not isinstance(condition, np.ndarray):
            _mistakes.at(users_line(), f"`where` needs a condition such as s.x > 0, not {condition!r}")
        return itemwise(where, condition, a, b)
    trace = condition._trace
    for first, second in ((a, b), (b, a)):
        if isinstance(first, _Components):
            second = first._like(second) if hasattr(first, "_like") else second
            if not isinstance(second, type(first)):
                _mistakes.at(users_line(), f"`where` chooses between two of a kind, not {a!r} and {b!r}")
            return type(first)(*(where(condition, x, y) for x, y in zip(*_ordered(a, b, first, second))))
    if isinstance(a, (list, tuple)) and isinstance(b, (list, tuple)) and len(a) == len(b):
        return type(a)([where(condition, x, y) for x, y in zip(a, b)])
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return itemwise(lambda x, y: where(condition, x, y), a, b)
    first, second = trace.number(a), trace.number(b)
    if first is None or second is None:
        _mistakes.at(users_line(), f"`where` chooses between two of a kind, not {a!r} and {b!r}")
    template = "if {:a} {{ {:a} }} else {{ {:a} }}"
    return Expr(trace, trace.op(template, "f64", condition._node, first, second))


def _ordered(a: Any, b: Any, first: Any, second: Any) -> tuple[Any, Any]:
    return (first, second) if first is a else (second, first)


pi = math.pi
tau = math.tau
