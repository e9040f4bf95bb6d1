"""Defines laws f(x) for drivers and profiles of cams."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import Any, Callable, Iterable, Optional, Sequence, Union

import numpy as np

from . import _native
from ._dimension import Dimension, NumberLike, valued, written
from ._mistakes import KINS, values
from ._ufunc import Operand


@dataclass(frozen=True)
class LawRange:
    """The range of arguments, from `first` to `last`, for which a law is defined.

    If `beyond` is `"line"`, the law continues outside the range as a straight line, and a run that leaves the range
    warns. If `beyond` is `"held"`, the law keeps the value of its end.
    """

    first: float
    last: float
    beyond: str


@values
class Law(Operand):
    """A function of one variable with its derivatives: of time in a driver, of an angle for a cam.

    You can add laws, multiply laws, and multiply and divide laws by numbers: `Law.constant(0.3) + Law.cycloidal(1.0,
    0.5) / 10`. To apply a function to a law, compose both: `kin.law(kin.sin).compose(law)`.
    """

    __slots__ = ("_data", "_made")

    def __init__(self, data: dict[str, Any]) -> None:
        self._data = data
        self._made: Optional[_native.Law] = None

    @classmethod
    def _of(cls, kind: str, parts: "Optional[dict[str, Law]]" = None, **numbers: Any) -> "Law":
        data: dict[str, Any] = {"kind": kind, "numbers": {k: _number(kind, k, v) for k, v in numbers.items()}}
        if parts:
            data["parts"] = {name: part._data for name, part in parts.items()}
        return cls(data)

    @property
    def _native(self) -> "_native.Law":
        if self._made is None:
            self._made = _native.Law(json.dumps(_each(self._data, valued)))
        return self._made

    def _written(self, place: str, mechanism: str, own: str) -> dict[str, Any]:
        """Its data, dimensions of the mechanism as their texts."""
        return _each(self._data, lambda number: written(place, mechanism, own, number))

    def _json(self, place: str, mechanism: str, own: str) -> str:
        return json.dumps(self._written(place, mechanism, own))

    def _key(self) -> str:
        return json.dumps(_each(self._data, lambda x: [x.text, x._of] if isinstance(x, Dimension) else x), sort_keys=True)

    @property
    def kind(self) -> str:
        """The kind of the law, such as `ramp`, or the name of the function that defines the law."""
        return str(self._data["kind"])

    # The laws, in the order of docs/library.md.

    @staticmethod
    def constant(c: NumberLike) -> "Law":
        """Returns the constant law f(x) = c."""
        return Law._of("constant", c=c)

    @staticmethod
    def ramp(rate: NumberLike) -> "Law":
        """Returns the law of constant rate f(x) = rate · x."""
        return Law._of("ramp", rate=rate)

    @staticmethod
    def linear(f0: NumberLike, rate: NumberLike) -> "Law":
        """Returns the straight line f(x) = f0 + rate · x."""
        return Law._of("linear", f0=f0, rate=rate)

    @staticmethod
    def polynomial(c: Sequence[NumberLike] = ()) -> "Law":
        """Returns the polynomial f(x) = c[0] + c[1] x + c[2] x² + …."""
        given = [] if isinstance(c, (str, int, float, Dimension)) else list(c)
        if not given:
            raise TypeError(f"Law.polynomial takes a list of numbers, lowest power first, such as Law.polynomial([0.1, 2.0]), not {c!r}")
        named: dict[str, Any] = {f"c[{k}]": one for k, one in enumerate(given)}
        return Law._of("polynomial", **named)

    @staticmethod
    def harmonic(mean: NumberLike, amplitude: NumberLike) -> "Law":
        """Returns the harmonic law f(x) = mean + amplitude · sin x."""
        return Law._of("harmonic", mean=mean, amplitude=amplitude)

    @staticmethod
    def sine(amplitude: NumberLike, omega: NumberLike, phase: NumberLike = 0.0) -> "Law":
        """Returns the sine law f(x) = amplitude · sin(omega · x + phase). [rad/s, rad]"""
        return Law._of("sine", amplitude=amplitude, omega=omega, phase=phase)

    @staticmethod
    def fourier(mean: NumberLike, omega: NumberLike, pairs: Iterable[tuple[NumberLike, NumberLike]]) -> "Law":
        """Returns the Fourier series f(x) = mean + Σ a_k cos(k · omega · x) + b_k sin(k · omega · x) for pairs (a_k,
        b_k).
        """
        named: dict[str, Any] = {}
        for k, (a, b) in enumerate(pairs, start=1):
            named[f"a[{k}]"], named[f"b[{k}]"] = a, b
        return Law._of("fourier", mean=mean, omega=omega, **named)

    @staticmethod
    def harmonic_rise(height: NumberLike, length: NumberLike) -> "Law":
        """Returns the simple harmonic rise f(x) = h/2 (1 − cos(π x/β)).

        The law is 0 before the rise and h after the rise.
        """
        return Law._of("harmonic_rise", height=height, length=length)

    @staticmethod
    def cycloidal(height: NumberLike, length: NumberLike) -> "Law":
        """Returns the cycloidal rise f(x) = h (x/β − sin(2π x/β)/2π).

        The law is 0 before the rise and h after the rise.
        """
        return Law._of("cycloidal", height=height, length=length)

    @staticmethod
    def polynomial_345(height: NumberLike, length: NumberLike) -> "Law":
        """Returns the 3-4-5 polynomial rise f(x) = h (10 ξ³ − 15 ξ⁴ + 6 ξ⁵) with ξ = x/β.

        The law is 0 before the rise and h after the rise.
        """
        return Law._of("polynomial_345", height=height, length=length)

    @staticmethod
    def polynomial_4567(height: NumberLike, length: NumberLike) -> "Law":
        """Returns the 4-5-6-7 polynomial rise, which is 0 before the rise and h after the rise."""
        return Law._of("polynomial_4567", height=height, length=length)

    @staticmethod
    def modified_sine(height: NumberLike, length: NumberLike) -> "Law":
        """Returns the modified sine rise, which is 0 before the rise and h after the rise."""
        return Law._of("modified_sine", height=height, length=length)

    @staticmethod
    def modified_trapezoid(height: NumberLike, length: NumberLike) -> "Law":
        """Returns the modified trapezoidal rise, which is 0 before the rise and h after the rise."""
        return Law._of("modified_trapezoid", height=height, length=length)

    @staticmethod
    def trapezoidal(distance: NumberLike, speed: NumberLike, acceleration: NumberLike) -> "Law":
        """Returns a motion from rest to rest over a distance, with constant acceleration up to a speed."""
        return Law._of("trapezoidal", distance=distance, speed=speed, acceleration=acceleration)

    @staticmethod
    def s_curve(distance: NumberLike, speed: NumberLike, acceleration: NumberLike, jerk: NumberLike) -> "Law":
        """Returns a motion from rest to rest over a distance, limited in speed, acceleration and jerk."""
        return Law._of("s_curve", distance=distance, speed=speed, acceleration=acceleration, jerk=jerk)

    @staticmethod
    def spline(x: Any, y: Any, ends: Union[str, tuple[NumberLike, NumberLike]] = "natural") -> "Law":
        """Returns a cubic spline through (x, y), which are arrays or lists.

        `ends` is "natural", "periodic", or a pair of slopes at both ends.
        """
        return _spline("spline", x, y, ends)

    @staticmethod
    def quintic_spline(x: Any, y: Any, ends: Union[str, tuple[NumberLike, NumberLike]] = "natural") -> "Law":
        """Returns a quintic spline through (x, y), with continuous derivatives up to the fourth.

        `ends` has the same values as for `spline`.
        """
        return _spline("quintic_spline", x, y, ends)

    @staticmethod
    def sequence(start: NumberLike, parts: Iterable[tuple[NumberLike, "Law"]]) -> "Law":
        """Returns a law whose parts follow each other, each part over its length: f(x) = f_k(x − x_k).

        The parts are pairs (length, law).
        """
        numbers: dict[str, Any] = {"start": start}
        laws: dict[str, Law] = {}
        for k, (length, law) in enumerate(parts):
            numbers[f"part[{k}].length"], laws[f"part[{k}].law"] = length, law
        return Law._of("sequence", laws, **numbers)

    def periodic(self, period: NumberLike) -> "Law":
        """Returns a law that repeats the part of this law over 0 ≤ x < period."""
        return Law._of("periodic", {"law": self}, period=period)

    def compose(self, inner: "Law") -> "Law":
        """Returns the composition f(g(x)), where this law is f and `inner` is g."""
        return Law._of("composed", {"outer": self, "inner": inner})

    def shifted(self, x0: NumberLike) -> "Law":
        """Returns the law f(x − x0): the same curve, shifted by x0."""
        return self.compose(Law.linear(-x0, 1.0))

    def __add__(self, other: Union["Law", NumberLike]) -> "Law":
        return Law._of("sum", {"first": self, "second": _law(other)}) if _is_law(other) else NotImplemented

    __radd__ = __add__

    def __sub__(self, other: Union["Law", NumberLike]) -> "Law":
        return self + (-1.0) * _law(other) if _is_law(other) else NotImplemented

    def __rsub__(self, other: NumberLike) -> "Law":
        return _law(other) + (-1.0) * self if _is_law(other) else NotImplemented

    def __neg__(self) -> "Law":
        return (-1.0) * self

    def __pos__(self) -> "Law":
        return self

    def __mul__(self, other: Union["Law", NumberLike]) -> "Law":
        if isinstance(other, Law):
            return Law._of("product", {"first": self, "second": other})
        return Law._of("multiple", {"law": self}, factor=other) if _is_law(other) else NotImplemented

    __rmul__ = __mul__

    def __truediv__(self, divisor: NumberLike) -> "Law":
        if isinstance(divisor, Law):
            raise TypeError(f"a law is divided by numbers only: {self._cure('divide')}")
        return self * (1.0 / divisor) if _is_law(divisor) else NotImplemented

    def __rtruediv__(self, _: Any) -> "Law":
        raise TypeError(f"a law is no divisor: {self._cure('divide')}")

    def __pow__(self, exponent: Any) -> "Law":
        raise TypeError(f"a law has no powers: {self._cure('power')}")

    def __rpow__(self, _: Any) -> "Law":
        raise TypeError("a law is no exponent: write kin.law(lambda x: 2.0**x).compose(law)")

    def __abs__(self) -> "Law":
        raise TypeError(f"|law| has a kink wherever it is zero: {self._cure('absolute')}")

    def _cure(self, name: str) -> str:
        if name == "divide":
            return "write first * kin.law(lambda x: 1.0 / x).compose(second)"
        if name == "power":
            return "write kin.law(lambda x: x**2).compose(law)"
        return f"write kin.law(kin.{KINS.get(name, name)}).compose(law)" if name in _FUNCTIONS else ""

    # What it is asked.

    def at(self, x: Any) -> Any:
        """Returns f(x) for a number or an array."""
        return self._order(x, 0)

    def slope(self, x: Any) -> Any:
        """Returns the first derivative f′(x)."""
        return self._order(x, 1)

    def second(self, x: Any) -> Any:
        """Returns the second derivative f″(x)."""
        return self._order(x, 2)

    def third(self, x: Any) -> Any:
        """Returns the third derivative f‴(x)."""
        return self._order(x, 3)

    __call__ = at

    @property
    def range(self) -> Optional[LawRange]:
        """The range of arguments for which the law is defined, such as that of a table; None for all arguments."""
        found = self._native.range()
        return None if found is None else LawRange(*found)

    def _order(self, x: Any, order: int) -> Any:
        law = self._native
        if isinstance(x, (int, float, np.integer, np.floating)):
            return law.jet(float(x))[order]
        if np.asarray(x).dtype.kind == "c":
            raise TypeError(f"a law is a function of real numbers, not of {x!r}")
        array = np.asarray(x, dtype=float)
        return np.array([law.jet(one)[order] for one in array.ravel().tolist()]).reshape(array.shape)

    def __repr__(self) -> str:
        if "text" in self._data:
            return f"<law {self.kind}>"
        numbers = ", ".join(f"{name}={value:g}" for name, value in list(self._data["numbers"].items())[:6])
        return f"Law.{self.kind}({numbers})"

    def __eq__(self, other: Any) -> bool:
        return isinstance(other, Law) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __reduce__(self) -> Any:
        return (Law, (self._data,))


def _each(data: dict[str, Any], of: Callable[[Any], Any]) -> dict[str, Any]:
    """The data of a law with something else for each of its numbers."""
    made = dict(data)
    if "numbers" in data:
        made["numbers"] = {name: of(number) for name, number in data["numbers"].items()}
    if "parts" in data:
        made["parts"] = {name: _each(part, of) for name, part in data["parts"].items()}
    return made


# Functions of one number that laws are put into by `compose`.
_FUNCTIONS = {
    "sin", "cos", "tan", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "arcsinh", "arccosh", "arctanh", "exp", "exp2", "expm1",
    "log", "log1p", "log2", "log10", "sqrt", "cbrt", "floor", "ceil", "trunc", "sign", "fabs", "absolute", "radians", "degrees",
    "deg2rad", "rad2deg",
}  # fmt: skip


def _is_law(value: Any) -> bool:
    """True of a law, and of a number, which is a constant one."""
    is_number = isinstance(value, (int, float, np.integer, np.floating, Dimension)) and not isinstance(value, bool)
    return is_number or isinstance(value, Law)


def _law(value: Union[Law, NumberLike]) -> Law:
    return value if isinstance(value, Law) else Law.constant(value)


def _number(kind: str, name: str, value: Any) -> NumberLike:
    if isinstance(value, Dimension):
        return value
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise TypeError(f"Law.{kind}: `{name}` is a number, not {value!r}")
    if not math.isfinite(value):
        raise ValueError(f"Law.{kind}: `{name}` is {float(value)}. Give a finite number")
    return float(value)


def _spline(kind: str, x: Any, y: Any, ends: Union[str, tuple[NumberLike, NumberLike]]) -> Law:
    # The places of the points are fixed, their values may be dimensions.
    xs, ys = np.asarray(x, dtype=float).ravel().tolist(), np.asarray(y).ravel().tolist()
    if len(xs) != len(ys):
        raise ValueError(f"Law.{kind}: x has {len(xs)} numbers, y {len(ys)}")
    numbers: dict[str, Any] = {f"x[{k}]": one for k, one in enumerate(xs)}
    numbers.update({f"y[{k}]": one for k, one in enumerate(ys)})
    if ends == "periodic":
        numbers["periodic"] = 1.0
    elif isinstance(ends, tuple):
        numbers["start"], numbers["end"] = ends
    elif ends != "natural":
        raise ValueError(f"Law.{kind}: ends are \"natural\", \"periodic\" or two slopes, not {ends!r}")
    law = Law._of(kind, **numbers)
    law._native  # noqa: B018  a table that is no table of a law is told now
    return law
