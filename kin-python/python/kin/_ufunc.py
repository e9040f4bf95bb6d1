"""Arithmetic of NumPy with numbers, vectors, conditions and laws of Kin: one dispatch for all of them.

NumPy hands an operation to `__array_ufunc__` when one of its operands is an `Operand`. The operation is then done by the
methods of the operand of Kin, `__mul__` or `__rmul__`, and never by those of NumPy, which would hand it back without end.
"""

from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np

from . import _mistakes
from ._place import users_line

# A function of NumPy: the method of the first operand, and that of the second one where the first has none.
_OPERATORS: dict[str, tuple[str, str]] = {
    "add": ("__add__", "__radd__"),
    "subtract": ("__sub__", "__rsub__"),
    "multiply": ("__mul__", "__rmul__"),
    "divide": ("__truediv__", "__rtruediv__"),
    "floor_divide": ("__floordiv__", "__rfloordiv__"),
    "remainder": ("__mod__", "__rmod__"),
    "divmod": ("__divmod__", "__rdivmod__"),
    "power": ("__pow__", "__rpow__"),
    "float_power": ("__pow__", "__rpow__"),
    "matmul": ("__matmul__", "__rmatmul__"),
    "vecdot": ("__matmul__", "__rmatmul__"),
    "less": ("__lt__", "__gt__"),
    "less_equal": ("__le__", "__ge__"),
    "greater": ("__gt__", "__lt__"),
    "greater_equal": ("__ge__", "__le__"),
    "equal": ("__eq__", "__eq__"),
    "not_equal": ("__ne__", "__ne__"),
    "logical_and": ("__and__", "__rand__"),
    "logical_or": ("__or__", "__ror__"),
    "bitwise_and": ("__and__", "__rand__"),
    "bitwise_or": ("__or__", "__ror__"),
}
_UNARY = {
    "negative": "__neg__",
    "positive": "__pos__",
    "absolute": "__abs__",
    "logical_not": "__invert__",
    "invert": "__invert__",
}
# Functions of two numbers, and their names as methods.
_TWO = {"fmax": "maximum", "fmin": "minimum", "maximum": "maximum", "minimum": "minimum", "arctan2": "arctan2", "hypot": "hypot"}
# These work on whole vectors and matrices; other functions work item by item.
_WHOLE = {"add", "subtract", "multiply", "divide", "matmul", "vecdot", "negative", "positive", "equal", "not_equal"}


class Operand:
    """A value of Kin that NumPy's functions and operators accept."""

    __slots__ = ()
    # NumPy's older arrays and matrices leave arithmetic to the operand of the higher priority.
    __array_priority__ = 1000.0

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **keywords: Any) -> Any:
        return array_ufunc(ufunc, method, inputs, keywords)

    def _cure(self, name: str) -> str:
        """What to write in place of a function of NumPy that is not defined for it."""
        return ""

    def __array_function__(self, function: Any, types: Any, args: Any, keywords: Any) -> Any:
        from . import _arrays

        return _arrays.apply(function, args, keywords)


def plain(value: Any) -> Any:
    """Converts a NumPy scalar or an array of no dimension to a Python number; returns any other value unchanged."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value[()]
    if isinstance(value, np.bool_):
        return bool(value)
    if isinstance(value, np.integer):
        return int(value)
    return float(value) if isinstance(value, np.floating) else value


def real(value: Any) -> float:
    """Returns the number as a float.

    Raises TypeError for a complex number, because NumPy would drop its imaginary part.
    """
    if isinstance(value, np.complexfloating) or (isinstance(value, np.ndarray) and value.dtype.kind == "c"):
        raise TypeError(f"a real number is needed, not {value!r}")
    # The plain number of a dimension stays one.
    return value if isinstance(value, float) and not isinstance(value, np.floating) else float(value)


def by_operands(forward: str, reflected: str, a: Any, b: Any) -> Any:
    """Performs an operation by a method of one of its operands; returns NotImplemented if neither has the method."""
    made = NotImplemented
    if isinstance(a, Operand):
        made = getattr(a, forward, lambda _: NotImplemented)(b)
    if made is NotImplemented and isinstance(b, Operand):
        made = getattr(b, reflected, lambda _: NotImplemented)(a)
    return made


def itemwise(function: Callable[..., Any], *inputs: Any) -> Any:
    """Applies a function of numbers to arrays item by item, as NumPy does; for numbers alone it returns a number."""
    if not any(isinstance(one, np.ndarray) for one in inputs):
        return function(*(plain(one) for one in inputs))

    def of_items(*items: Any) -> Any:
        return function(*(plain(one) for one in items))

    # A number of Kin goes in as an array of no dimension: as itself it would be asked how it does this.
    held = (_held(one) if isinstance(one, Operand) else one for one in inputs)
    return np.frompyfunc(of_items, len(inputs), 1)(*held)


def two(name: str, a: Any, b: Any) -> Any:
    """Applies a function of two numbers by its name in NumPy; arrays item by item."""
    return itemwise(lambda x, y: _two(name, x, y), a, b)


def _held(value: Any) -> Any:
    array = np.empty((), dtype=object)
    array[()] = value
    return array


def _two(name: str, a: Any, b: Any) -> Any:
    from ._number import Number

    if isinstance(a, Number):
        return getattr(a, name)(b)
    if isinstance(b, Number):
        return getattr(b._like(a), name)(b)
    if isinstance(a, Operand) or isinstance(b, Operand):
        return _refused(name, a, b)
    return getattr(np, name)(a, b)


def _function(ufunc: Any) -> Optional[Callable[..., Any]]:
    """What a function of NumPy does with numbers of which one is of Kin; `None` of functions without a derivative."""
    from ._number import Number

    # `divide` calls itself so in one version of NumPy and `true_divide` in another.
    name = {"true_divide": "divide", "mod": "remainder", "conj": "conjugate"}.get(ufunc.__name__, ufunc.__name__)
    if name in _OPERATORS:
        return lambda a, b: _operator(name, ufunc, a, b)
    if name in _UNARY:
        return lambda a: getattr(a, _UNARY[name])() if hasattr(a, _UNARY[name]) else _refused(name, a)
    if name in _TWO:
        return lambda a, b: _two(_TWO[name], a, b)
    if ufunc.nin == 1 and ufunc.nout == 1 and hasattr(Number, name) or name == "sign":
        return lambda a: getattr(a, name)() if hasattr(a, name) else (_refused(name, a) if isinstance(a, Operand) else ufunc(a))
    return None


def _operator(name: str, ufunc: Any, a: Any, b: Any) -> Any:
    if not isinstance(a, Operand) and not isinstance(b, Operand):
        return ufunc(a, b)
    made = by_operands(*_OPERATORS[name], a, b)
    return _refused(name, a, b) if made is NotImplemented else made


def _refused(name: str, *operands: Any) -> Any:
    kinds = " and ".join(f"{type(one).__name__} {_short(one)}" for one in operands)
    cures = [cure for one in operands if isinstance(one, Operand) for cure in [one._cure(name)] if cure]
    raise TypeError(f"`np.{name}` is not defined for {kinds}" + (f": {cures[0]}" if cures else ""))


def _short(value: Any) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else text[:57] + "..."


def array_ufunc(ufunc: Any, method: str, inputs: tuple[Any, ...], keywords: dict[str, Any]) -> Any:
    """Applies a NumPy function to numbers, vectors, conditions or laws of Kin; arrays item by item."""
    name = ufunc.__name__
    out = keywords.pop("out", None)
    if method != "__call__" or any(value is not None for key, value in keywords.items() if key != "dtype"):
        _mistakes.at(users_line(), f"`np.{name}` with these keywords, or as `.{method}`, cannot be traced")
    if out is not None and any(isinstance(one, np.ndarray) and one.dtype != object for one in out):
        text = f"`np.{name}` writes into an array of plain numbers, which cannot hold coordinates or parameters: give the array dtype=object"
        _mistakes.at(users_line(), text)
    made = _applied(ufunc, name, tuple(plain(one) for one in inputs))
    if out is None:
        return made
    out[0][...] = made
    return out[0]


def _applied(ufunc: Any, name: str, inputs: tuple[Any, ...]) -> Any:
    from ._vectors import _Components

    function = _function(ufunc)
    if function is None:
        _mistakes.at(users_line(), f"`np.{name}` has no derivative here. Use the functions of `kin`")
    if any(isinstance(one, _Components) for one in inputs):
        whole = {"true_divide": "divide"}.get(name, name) in _WHOLE
        return function(*inputs) if whole else itemwise(function, *(_items(one) for one in inputs))
    if name in ("matmul", "vecdot") and any(isinstance(one, np.ndarray) for one in inputs):
        return _refused(name, *inputs)
    return itemwise(function, *inputs)


def _items(value: Any) -> Any:
    from ._vectors import _Components

    return np.asarray(value) if isinstance(value, _Components) else value
