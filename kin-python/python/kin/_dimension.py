"""Defines named dimensions, and expressions of dimensions."""

from __future__ import annotations

import math
import numbers
import re
from typing import Any, Callable, Union

import numpy as np

from ._errors import DimensionError
from ._number import Number
from ._ufunc import real

# Longer expressions are not written.
_LONGEST = 20_000

_ONE: dict[str, Callable[[Any], Any]] = {
    "abs": np.abs, "sqrt": np.sqrt, "cbrt": np.cbrt, "sin": np.sin, "cos": np.cos, "tan": np.tan, "asin": np.arcsin,
    "acos": np.arccos, "atan": np.arctan, "sinh": np.sinh, "cosh": np.cosh, "tanh": np.tanh, "asinh": np.arcsinh,
    "acosh": np.arccosh, "atanh": np.arctanh, "exp": np.exp, "exp2": np.exp2, "exp_m1": np.expm1, "ln": np.log,
    "ln_1p": np.log1p, "log2": np.log2, "log10": np.log10, "floor": np.floor, "ceil": np.ceil, "trunc": np.trunc,
    "signum": lambda x: np.copysign(1.0, x),
}  # fmt: skip
_TWO: dict[str, Callable[[Any, Any], Any]] = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide, "atan2": np.arctan2, "hypot": np.hypot,
    "powf": np.power, "max": np.maximum, "min": np.minimum,
}  # fmt: skip
_SIGNS: dict[str, Callable[[float, float], bool]] = {
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
}


class Frozen(float):
    """The plain number of a dimension, and what arithmetic with plain numbers makes of it: it stays when the dimension changes.
    `text` is the dimension."""

    text: str

    @staticmethod
    def of(value: float, text: str) -> "Frozen":
        """The number of this dimension."""
        made = Frozen(value)
        made.text = text
        return made


def _frozen(name: str) -> Callable[..., Any]:
    plain = getattr(float, name)

    def operation(self: Frozen, *others: Any) -> Any:
        found = plain(self, *others)
        return Frozen.of(found, self.text) if isinstance(found, float) else found

    return operation


for _name in ("add", "radd", "sub", "rsub", "mul", "rmul", "truediv", "rtruediv", "pow", "neg", "pos", "abs"):
    setattr(Frozen, f"__{_name}__", _frozen(f"__{_name}__"))


class Dimension(Number):
    """A named dimension from `m.dimension(…)`, or an expression of dimensions: `a / 2`, `kin.hypot(dx, dy)`.

    Use a dimension instead of a number for a parameter of a constraint, the length of a link, a coefficient of a law, a
    planar guess, a mass or a number of a load. Then `system.set("crank", 0.16)` changes all numbers that depend on the
    dimension, without a rebuild.

    Comparisons use `value`, the value at the nominal dimensions. Functions that need a plain number, such as
    `math.sin`, would lose the dimension, so they raise an error. To use the plain number, write `.value`.
    """

    __slots__ = ("text", "value", "_of")

    def __init__(self, text: str, value: float, of: str) -> None:
        if len(text) > _LONGEST:
            raise DimensionError("an expression of dimensions is too long. Give names to its parts")
        #: The expression, as mechanism files have it.
        self.text = text
        #: The value that the nominal dimensions give it.
        self.value: float = Frozen.of(value, text)
        self._of = of

    def _operand(self, other: Any) -> Any:
        """Text and value of another number; `None` of anything else."""
        if isinstance(other, Dimension):
            if other._of != self._of:
                text = f"`{self.text}` and `{other.text}` are dimensions of two mechanisms. Take both from one"
                raise DimensionError(text)
            return _bracketed(other.text), other.value
        if isinstance(other, np.ndarray) and other.ndim == 0:
            other = other.item()
        if isinstance(other, (bool, np.bool_)) or not isinstance(other, (numbers.Real, np.integer, np.floating)):
            return None
        value = float(other)
        if not math.isfinite(value):
            raise DimensionError(f"`{self.text}` meets {value}. Give a finite number")
        return (repr(value) if value >= 0.0 else f"({value!r})"), value

    def _made(self, text: str, function: Callable[..., Any], *values: float) -> "Dimension":
        with np.errstate(all="ignore"):
            return Dimension(text, float(function(*(np.float64(one) for one in values))), self._of)

    def _operator(self, sign: str, other: Any, swapped: bool = False) -> "Dimension":
        operand = self._operand(other)
        if operand is None:
            return NotImplemented  # type: ignore[no-any-return, return-value, unused-ignore]
        pair = [(_bracketed(self.text), self.value), operand]
        (a, x), (b, y) = reversed(pair) if swapped else pair
        return self._made(f"{a} {sign} {b}", _TWO[sign], x, y)

    def _two(self, method: str, other: Any, swapped: bool = False) -> "Dimension":
        operand = self._operand(other)
        if operand is None:
            return NotImplemented  # type: ignore[no-any-return, return-value, unused-ignore]
        pair = [(self.text, self.value), operand]
        (a, x), (b, y) = reversed(pair) if swapped else pair
        return self._made(f"{method}({a}, {b})", _TWO[method], x, y)

    def _one(self, method: str) -> "Dimension":
        return self._made(f"{method}({self.text})", _ONE[method], self.value)

    def _powi(self, exponent: int) -> "Dimension":
        return self._made(f"powi({self.text}, {exponent})", lambda x: np.power(x, exponent), self.value)

    def _compared(self, sign: str, other: Any) -> Any:
        value = other.value if isinstance(other, Dimension) else other
        if not isinstance(value, (numbers.Real, np.integer, np.floating)):
            return NotImplemented
        return _SIGNS[sign](self.value, float(value))

    def _like(self, other: Any) -> "Dimension":
        text, value = self._operand(other)
        return Dimension(text, value, self._of)

    def sign(self) -> "Dimension":
        """Returns −1 or 1; for 0 returns the sign of the zero."""
        return self._one("signum")

    def __neg__(self) -> "Dimension":
        return Dimension(f"-{_bracketed(self.text)}", -self.value, self._of)

    def __bool__(self) -> bool:
        return self.value != 0.0

    def __hash__(self) -> int:
        return hash(self.value)

    def __float__(self) -> float:
        raise TypeError(f"the dimension `{self.text}` would become a plain number here. Write `.value` if you want its number, which does not change with the dimension")

    def __round__(self, digits: Any = None) -> Any:
        return round(float(self))

    def __format__(self, spec: str) -> str:
        return format(self.value, spec)

    def __str__(self) -> str:
        return str(self.value)

    def __repr__(self) -> str:
        return f"<dimension {self.text} = {self.value:g}>"

    def __reduce__(self) -> Any:
        return (Dimension, (self.text, self.value, self._of))


NumberLike = Union[float, Dimension]


def quoted(name: str) -> str:
    """Returns a name in the form for expressions: in backticks unless the name is a single word."""
    if "`" in name:
        raise DimensionError(f"the dimension `{name}`: expressions cannot contain a name with backticks. Choose another name")
    return name if re.fullmatch(r"[A-Za-z_][A-Za-z0-9_.]*", name) else f"`{name}`"


def _bracketed(text: str) -> str:
    return text if re.fullmatch(r"[A-Za-z0-9_.]+|`[^`]*`", text) else f"({text})"


def valued(number: Any) -> Any:
    """Returns the value of a dimension, and any other argument unchanged."""
    return number.value if isinstance(number, Dimension) else number


def _float(number: Any) -> float:
    if isinstance(number, (str, bytes, bool)):
        raise TypeError("text is no number")
    return real(number)


def written(place: str, mechanism: str, own: str, number: Any) -> Any:
    """Converts a number for the native module; a dimension becomes its text.

    Raises `DimensionError` for a dimension of another mechanism than that of the token `own`, and TypeError for an
    argument that is not a number.
    """
    if not isinstance(number, Dimension):
        try:
            return _float(number)
        except (TypeError, ValueError):
            raise TypeError(f"`{place}`: a number or a dimension is needed, not {number!r}") from None
    if number._of != own:
        text = f'`{place}` has a dimension of another mechanism than "{mechanism}". Use the dimensions of "{mechanism}"'
        error = DimensionError(text)
        error.__dict__.update(mechanism=mechanism, place=place)
        raise error
    return number.text
