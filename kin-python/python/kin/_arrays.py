"""Applies NumPy's functions of arrays to traced vectors and numbers."""

from __future__ import annotations

from typing import Any, Callable

import numpy as np

from . import _functions, _mistakes
from ._number import Number
from ._place import users_line


def _vector(x: Any) -> Any:
    """A vector of a list or array of two or three numbers."""
    from ._vectors import Vec2, Vec3, _Vector

    if isinstance(x, _Vector):
        return x
    if len(x) not in (2, 3):
        _mistakes.at(users_line(), f"a vector has two or three components, not {len(x)}")
    return (Vec2 if len(x) == 2 else Vec3)(*x)


def _sum(x: Any, *_: Any, **__: Any) -> Any:
    return x if isinstance(x, Number) else sum(x, 0)


def _norm(x: Any, *_: Any, **__: Any) -> Any:
    return _vector(x).norm()


def _dot(a: Any, b: Any) -> Any:
    if isinstance(a, Number) or isinstance(b, Number):
        return a * b
    return a @ b if hasattr(a, "_N") else _vector(a).dot(b)


def _polyval(p: Any, x: Any) -> Any:
    value: Any = 0.0
    for c in p:
        value = value * x + c
    return value


def _interp(*_: Any, **__: Any) -> Any:
    text = "`np.interp` has corners. Give the function an argument `table: kin.Law`, and pass kin.Law.spline(x, y)"
    _mistakes.at(users_line(), text)


KNOWN: dict[Any, Callable[..., Any]] = {
    np.where: _functions.where,
    np.dot: _dot,
    np.vdot: _dot,
    np.inner: _dot,
    np.cross: lambda a, b: _vector(a).cross(b),
    np.linalg.norm: _norm,
    np.linalg.det: lambda a: a.determinant(),
    np.transpose: lambda a: a.transpose(),
    np.trace: lambda a: a.trace(),
    np.sum: _sum,
    np.polyval: _polyval,
    np.interp: _interp,
    np.clip: _functions.clip,
}


def apply(function: Any, args: Any, keywords: Any) -> Any:
    """Evaluates a NumPy function that the user called with a traced value."""
    known = KNOWN.get(function)
    if known is None:
        name = getattr(function, "__name__", str(function))
        _mistakes.at(users_line(), f"`np.{name}` cannot be traced. Use the functions of `kin`")
    return known(*args, **keywords)
