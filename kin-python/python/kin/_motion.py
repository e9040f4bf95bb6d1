"""What a run gives: position, velocity and acceleration over time, as arrays."""

from __future__ import annotations

import html
import json
import os
import warnings
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _native
from ._pictures import Picture
from ._handles import Coordinate, Ground, Handle, PlanarBody, PlanarLike, SpatialBody, SpatialLink
from ._values import flat

if TYPE_CHECKING:
    from ._system import System

Array = "np.ndarray[Any, np.dtype[np.float64]]"


def array(data: bytes, columns: Optional[int] = None) -> Any:
    """The numbers where they lie, read-only: rows of so many columns."""
    numbers = np.frombuffer(data, dtype=np.float64)
    return numbers if columns is None else numbers.reshape(-1, columns)


@dataclass(frozen=True)
class Peak:
    """The largest magnitude of a number over time, with its sign, and when."""

    value: float
    t: float
    unit: str
    text: str

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class Quantity:
    """One number over time with its rates, as arrays: a coordinate, the angle of a joint, a slide. Rates are `None` where
    they are not known.   [unit, unit/s, unit/s², unit/s³]"""

    name: str
    unit: str
    times: Any
    value: Any
    velocity: Any = None
    acceleration: Any = None
    jerk: Any = None

    @staticmethod
    def _of(told: tuple[str, str, list[bytes]], times: Any) -> "Quantity":
        name, unit, lists = told
        return Quantity(name, unit, times, *(array(one) for one in lists))

    def renamed(self, name: str) -> "Quantity":
        """The same under another name."""
        return replace(self, name=name)

    def __sub__(self, other: "Quantity") -> "Quantity":
        """The difference of two measures of one motion, with its rates."""
        if not isinstance(other, Quantity):
            return NotImplemented
        pairs = ((getattr(self, one), getattr(other, one)) for one in ("value", "velocity", "acceleration", "jerk"))
        orders = (None if a is None or b is None else np.asarray(a) - np.asarray(b) for a, b in pairs)
        return Quantity(f"{self.name} − {other.name}", self.unit, self.times, *orders)

    @property
    def rate(self) -> Any:
        """ẋ: the same as `velocity`."""
        return self.velocity

    @property
    def second_rate(self) -> Any:
        """ẍ: the same as `acceleration`."""
        return self.acceleration

    @property
    def max(self) -> float:
        """The largest of the values."""
        return float(np.max(self.value))

    @property
    def min(self) -> float:
        """The smallest of the values."""
        return float(np.min(self.value))

    @property
    def at_max(self) -> float:
        """The first time at which it is largest.   [s]"""
        return float(self.times[np.argmax(self.value)])

    @property
    def at_min(self) -> float:
        """The first time at which it is smallest.   [s]"""
        return float(self.times[np.argmin(self.value)])

    @property
    def rms(self) -> float:
        """The root mean square over time, by trapezia."""
        if len(self.value) < 2:
            return float(np.max(np.abs(self.value)))
        square, steps = np.square(self.value), np.diff(self.times)
        return float(np.sqrt(np.sum(steps * (square[1:] + square[:-1]) / 2) / np.sum(steps)))

    @property
    def peak(self) -> Peak:
        """The largest magnitude, the first one of several, and when."""
        k = int(np.argmax(np.abs(self.value)))
        value, t = float(self.value[k]), float(self.times[k])
        return Peak(value, t, self.unit, f"{value:.6g} {self.unit} at t = {t:.6g}")

    def crossings(self, value: float) -> list[tuple[float, bool]]:
        """When it passes a value, by straight lines between its times, and whether it rises there: where a drive begins to hold
        back, or a pin to be lifted. Of what can be measured `System.crossings` is exact. A value that is reached and left to the
        same side is not passed."""
        off = np.asarray(self.value) - value
        there = np.flatnonzero((off != 0) & ~np.isnan(off))
        found = []
        for k, n in zip(there[:-1], there[1:]):
            if (off[k] < 0) != (off[n] < 0):
                share = off[k] / (off[k] - off[n]) if n == k + 1 else 1.0
                t, end = self.times[k], self.times[k + 1]
                found.append((float(t + share * (end - t)), bool((off[n] > 0) == (self.times[n] > t))))
        return found

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        return np.array(self.value, dtype=dtype)

    def __repr__(self) -> str:
        return f"<{self.name} [{self.unit}], {len(self.value)} times, {self.min:.6g} to {self.max:.6g}>"


@dataclass(frozen=True)
class Point:
    """A point of a body over time: `r`, `v`, `a` (and `jerk` where the run was asked for it), a row a time."""

    times: Any
    r: Any
    v: Any
    a: Any
    jerk: Any = None
    _unit: str = "m"

    @property
    def speed(self) -> Any:
        """|v|   [m/s]"""
        return np.linalg.norm(self.v, axis=1)

    @property
    def acceleration_magnitude(self) -> Any:
        """|a|   [m/s²]"""
        return np.linalg.norm(self.a, axis=1)

    @property
    def jerk_magnitude(self) -> Any:
        """|jerk|, where the run was asked for it.   [m/s³]"""
        if self.jerk is None:
            raise AttributeError("the motion has no jerk. Request it by run(times, jerk=True)")
        return np.linalg.norm(self.jerk, axis=1)

    def along(self, n: Any) -> Quantity:
        """Its coordinate in a global direction n, with its rates: r · n / |n|.   [m]"""
        direction = np.array(flat(n))
        unit = direction / np.linalg.norm(direction)
        r, v, a = (one @ unit for one in (self.r, self.v, self.a))
        return Quantity("along", self._unit, self.times, r, v, a, None if self.jerk is None else self.jerk @ unit)


@dataclass(frozen=True)
class Rotation:
    """How a spatial body turns: `omega`, `alpha` (and its rate where the run was asked for the jerk), a row a time.   [rad/s,
    rad/s²]"""

    times: Any
    omega: Any
    alpha: Any
    alpha_rate: Any = None

    @property
    def speed(self) -> Any:
        """|ω|   [rad/s]"""
        return np.linalg.norm(self.omega, axis=1)

    def about(self, h: Any) -> Any:
        """ω · h / |h|, the angular velocity about a direction in the same components.   [rad/s]"""
        direction = np.array(flat(h))
        return self.omega @ (direction / np.linalg.norm(direction))


@dataclass(frozen=True)
class Break:
    """A break of a law that a run has crossed: of the law `law` of a `constraint`, at the argument `x`, between two times; from
    derivative `order` on it jumps (0 the value, 1 the slope)."""

    between: tuple[float, float]
    constraint: str
    law: str
    x: float
    order: int


@dataclass(frozen=True)
class Displacement:
    """How far the first position of a body or angle is from its guess; `None` where nobody has said where it is. `hint` is the
    likely cause, where that is farther than assembly leads as a rule.   [m, rad]"""

    name: str
    moved: Optional[float]
    turned: Optional[float]
    hint: Optional[str]


@dataclass(frozen=True)
class Event:
    """Something that happens at one time of a motion."""

    t: float
    kind: str
    name: str
    text: str


class MotionWarning(UserWarning):
    """A usual slip that Kin sees in a run that succeeds: the numbers are right for the mechanism as it was described, but it may
    not be the one that was meant. `kind` is "degrees", "far from drawn", "singular start" or "beyond range"; `names` are the
    constraints, bodies and coordinates that the warning concerns.

    A run passes each of its warnings to `warnings.warn`; `warnings.simplefilter("ignore", kin.MotionWarning)` hides them, and
    "error" in place of "ignore" makes exceptions of them.
    """

    kind: str
    names: list[str]

    def __init__(self, kind: str, names: list[str], text: str) -> None:
        super().__init__(text)
        self.kind = kind
        self.names = names

    def __reduce__(self) -> Any:
        return (MotionWarning, (self.kind, self.names, str(self)))


class Motion:
    """Position, velocity and acceleration at each time. Arrays are made once and are read-only, a row a time:
    `times`, `q`, `qd`, `qdd`; `motion["crank.theta"]` is a coordinate with its rates."""

    def __init__(self, native: "_native.Motion") -> None:
        self._native = native

    @property
    def name(self) -> str:
        """Name of the mechanism."""
        return self._native.name()

    @cached_property
    def names(self) -> list[str]:
        """Names of the coordinates, such as `crank.theta`."""
        return self._native.names()

    @cached_property
    def units(self) -> list[str]:
        """Units of the coordinates."""
        return self._native.units()

    def __len__(self) -> int:
        return self._native.len()

    @cached_property
    def times(self) -> Any:
        """The times.   [s]"""
        return self._rows(4).ravel()

    @cached_property
    def q(self) -> Any:
        """q, a row a time, a column a coordinate.   [m, rad]"""
        return self._rows(0)

    @cached_property
    def qd(self) -> Any:
        """q̇   [m/s, rad/s]"""
        return self._rows(1)

    @cached_property
    def qdd(self) -> Any:
        """q̈   [m/s², rad/s²]"""
        return self._rows(2)

    @cached_property
    def qddd(self) -> Any:
        """q⃛, where the run was asked for the jerk (`run(times, jerk=True)`).   [m/s³, rad/s³]"""
        if not self._native.has_jerk():
            raise AttributeError("the motion has no jerk. Request it by run(times, jerk=True)")
        return self._rows(3)

    def _rows(self, which: int) -> Any:
        """The numbers where they lie, read-only: the array keeps the native motion."""
        return np.asarray(self._native.rows(which))

    @cached_property
    def iterations(self) -> Any:
        """Newton steps taken at each time."""
        return np.array(self._native.iterations())

    @cached_property
    def residuals(self) -> Any:
        """max |C_i| at each time, in the unit of its row."""
        return array(self._native.residuals())

    def __getitem__(self, name: Union[str, Coordinate]) -> Quantity:
        """A coordinate over time, by its name or as a body gives it: `motion["crank.theta"]`, `motion[crank.theta]`."""
        key = coordinate_name(self.names, name.name if isinstance(name, Coordinate) else name)
        return Quantity._of(self._native.named(key), self.times)

    def quantity(self, name: str, unit: str, orders: Any) -> Quantity:
        """One number over the times of this motion that is computed from it: `orders` are x, ẋ, ẍ and, where it is known, x⃛, one
        a time each, x in `unit`. It is for a measure that is a function of a motion (`system.extremes`); whoever computes it
        answers for its rates."""
        lists = [np.asarray(one, dtype=float) for one in orders]
        if not 3 <= len(lists) <= 4 or any(one.shape != (len(self.times),) for one in lists):
            text = f"`{name}`: x, its rate and its second rate are lists of {len(self.times)} numbers, one a time"
            raise ValueError(text)
        return Quantity(name, unit, self.times, *lists)

    def point(self, body: Union[PlanarBody, SpatialBody, Ground], local: Any = None) -> Point:
        """r, v and a of the point with local position `local` of a body, its origin where none is given.   [m, m/s, m/s²]"""
        if isinstance(body, Ground):
            fixed = np.tile(np.array(flat(local if local is not None else (0.0, 0.0))), (len(self), 1))
            return Point(self.times, fixed, np.zeros_like(fixed), np.zeros_like(fixed))
        kind, name, u = place_of("point", body, local)
        found = self._native.point(kind, name, u)
        r, v, a, *jerk = (array(one, len(u)) for one in found)
        return Point(self.times, r, v, a, jerk[0] if jerk else None, self._native.unit_words()[0])

    def rotation(self, body: Union[SpatialBody, SpatialLink], *, in_body: bool = False) -> Rotation:
        """Angular velocity and acceleration of a spatial body, in global components or those of the body."""
        found = self._native.rotation(body.name, in_body)
        return Rotation(self.times, *(array(one, 3) for one in found))

    def distance(self, a: Handle, p: Any, b: Handle, q: Any) -> Quantity:
        """|r_P − r_Q| with its rates, P at p in body a, Q at q in body b: the length of a cylinder, the clearance of two edges.   [m]

        Raises an error by name: bodies of another mechanism, points that meet, where a distance has no rate.
        """
        points = flat(p), flat(q)
        in_plane = len(points[0]) == 2
        names = [_name_of("distance", body, PlanarBody if in_plane else SpatialBody) for body in (a, b)]
        return Quantity._of(self._native.distance(in_plane, (names[0], points[0]), (names[1], points[1])), self.times)

    def relative_angle(self, a: PlanarLike, b: PlanarLike) -> Quantity:
        """θ_a − θ_b, any number of turns.   [rad]"""
        names = (_name_of("relative_angle", body, PlanarBody) for body in (a, b))
        return Quantity._of(self._native.relative_angle(*names), self.times)

    def transmission_angle(
        self, coupler: Union[PlanarLike, tuple[PlanarLike, Any]], driven: Union[PlanarLike, tuple[PlanarLike, Any]]
    ) -> Quantity:
        """The angle between a coupler and what it drives, between 0 and π/2, with its rates: the nearer to π/2, the better it pushes.
        A body is told by its x-axis, along which the pins of a link are, or as (body, direction): of a slider
        `motion.transmission_angle(rod, (m.ground, (0, 1)))`.   [rad]"""
        lines = (_line(one) for one in (coupler, driven))
        return Quantity._of(self._native.transmission_angle(*lines), self.times)

    def instant_centre(self, a: PlanarLike, b: PlanarLike) -> Any:
        """The point that has the same velocity in both of two planar bodies, (−v_y, v_x)/ω of the one against the other, in the global
        frame, a row a time; NaN where they do not turn against each other.   [m]"""
        names = (_name_of("instant_centre", body, PlanarBody) for body in (a, b))
        found = self._native.instant_centre(*names)
        return np.array([(np.nan, np.nan) if one is None else one for one in found]).reshape(-1, 2)

    @property
    def summary(self) -> str:
        """Counts, Newton steps, the largest residual, and how far the first position is from the drawn one."""
        return self._native.summary()

    @property
    def worst(self) -> Optional[str]:
        """Name of the equation with the largest residual of all, such as `A.x`."""
        return self._native.facts()[1]

    @property
    def misfit(self) -> float:
        """The contradiction of redundant equations as a share of their norms; 0 unless `allowed_misfit` allows it.   [-]"""
        return self._native.facts()[2]

    @property
    def displaced(self) -> list[Displacement]:
        """How far each body and bare angle is at the first time from its guess, the worst first."""
        return [Displacement(*one) for one in self._native.displaced()]

    @property
    def breaks(self) -> list[Break]:
        """The breaks of laws that were crossed, where a derivative of the motion jumps, in the order of time."""
        return [Break(*one) for one in self._native.breaks()]

    @property
    def events(self) -> list[Event]:
        """What happened on the way: ends of slots, limits, toggles, change points, kinks, ends of tables that the run goes beyond."""
        return [Event(*one) for one in self._native.events()]

    @property
    def warnings(self) -> list[MotionWarning]:
        """Usual slips that still give a motion: numbers that look like degrees, a first position far from the drawn one, a start near a
        singular position, a table that ends before the run. At most four of a kind."""
        return [MotionWarning(*one) for one in self._native.warnings()]

    def _warn(self) -> None:
        """Passes each warning to Python, at the line of whoever called the method that calls this."""
        for one in self.warnings:
            warnings.warn(one, stacklevel=3)

    @property
    def singular_positions(self) -> list[dict[str, Any]]:
        """Change points, and at last a toggle, in the order of time."""
        found: list[dict[str, Any]] = json.loads(self._native.singular_positions())
        return found

    @property
    def engine(self) -> tuple[int, int]:
        """How many times a program has computed (`run(times, engine="compiled")`), and how often it has handed back."""
        return self._native.engine()

    @property
    def why_not_compiled(self) -> Optional[str]:
        """Why all of it was computed by plain steps, where a program would have paid, by the name of the constraint in the way."""
        return self._native.facts()[0]

    # Pictures.

    def chart(self, *what: Union[str, Coordinate], title: str = "") -> Picture:
        """Coordinates over time as a chart, which shows itself in a notebook."""
        names = [coordinate_name(self.names, one.name if isinstance(one, Coordinate) else one) for one in what]
        return Picture(self._native.chart(title or ", ".join(names), names))

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.summary)}</pre>"

    # Tables and files.

    def columns(self) -> dict[str, Any]:
        """Time, and each coordinate with its rates, by the headers of the CSV file: `t`, `crank.theta`, `crank.theta'`, …"""
        table: dict[str, Any] = {"t": self.times}
        for k, name in enumerate(self.names):
            for mark, rows in (("", self.q), ("'", self.qd), ("''", self.qdd)):
                table[name + mark] = rows[:, k]
        return table

    def to_pandas(self) -> Any:
        """The columns as a pandas DataFrame, which has to be installed."""
        import pandas

        return pandas.DataFrame(self.columns())

    def to_arrow(self) -> Any:
        """The columns as a table of Arrow (pyarrow, which has to be installed)."""
        import pyarrow

        return pyarrow.table(self.columns())

    def write_csv(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes all numbers with 17 digits, units in the header, making folders that are missing."""
        self._native.write_csv(os.fspath(path))

    def write_json(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the motion without loss."""
        self._native.write_json(os.fspath(path))

    def to_json(self) -> str:
        """The motion as the text of a file."""
        return self._native.to_json()

    @staticmethod
    def from_states(system: "System", times: Any, q: Any, qd: Any, qdd: Any) -> "Motion":
        """A motion that was measured, or comes from elsewhere: q, q̇ and q̈ a row a time, a column a coordinate of the system, whose
        forces and measures it can then be asked for.   [m, rad, s]

        Raises an error by name: arrays of other shapes, numbers that are not finite, times that do not only increase or only
        decrease.
        """
        from ._system import as_bytes

        n, instants = len(system.names), as_bytes(times)
        states = []
        for name, rows in (("q", q), ("qd", qd), ("qdd", qdd)):
            if np.shape(rows) != (len(instants) // 8, n):
                text = f"`{name}` has a row of {n} numbers for each of the {len(instants) // 8} times, not the shape {np.shape(rows)}"
                raise ValueError(text)
            states.append(as_bytes(rows))
        return Motion(_native.Motion.from_states(system._native, instants, tuple(states)))

    @staticmethod
    def from_json(text: str) -> "Motion":
        """The motion that such a text says."""
        return Motion(_native.Motion.from_json(text))

    @staticmethod
    def read_json(path: Union[str, "os.PathLike[str]"]) -> "Motion":
        """The motion of such a file."""
        with open(os.fspath(path), encoding="utf-8") as file:
            return Motion.from_json(file.read())

    def __reduce__(self) -> Any:
        return (Motion.from_json, (self.to_json(),))

    def __copy__(self) -> "Motion":
        return self

    def __repr__(self) -> str:
        return f"<motion of {self.name}, {len(self)} times>"


def _name_of(place: str, body: Any, kind: Any) -> Optional[str]:
    """Name of a body, `None` of the ground."""
    if isinstance(body, Ground):
        return None
    if not isinstance(body, kind):
        raise TypeError(f"`{place}` takes {'planar' if kind is PlanarBody else 'spatial'} bodies here, not {body!r}")
    name: str = body.name
    return name


def _line(line: Any) -> tuple[Optional[str], list[float]]:
    """A planar body and a direction in it, its x-axis where none is told."""
    body, h = line if isinstance(line, tuple) else (line, (1.0, 0.0))
    return _name_of("transmission_angle", body, PlanarBody), flat(h)


_SHORT = {"x": "R_x", "y": "R_y", "z": "R_z"}


def orders_of(made: Any) -> tuple[str, str, list[list[float]]]:
    """What a function of a motion has given, as the native part takes it: name, unit, x, ẋ, ẍ and x⃛ (empty if there is none)."""
    if not isinstance(made, Quantity):
        raise TypeError(f"a measure is a function of a motion that gives a kin.Quantity, not {made!r}")
    if made.velocity is None or made.acceleration is None:
        text = f"`{made.name}` has no rates: give motion.quantity(name, unit, [x, rate, second_rate])"
        raise ValueError(text)
    rates = (made.value, made.velocity, made.acceleration, () if made.jerk is None else made.jerk)
    return made.name, made.unit, [np.asarray(one, dtype=float).ravel().tolist() for one in rates]


def place_of(call: str, body: Any, local: Any) -> tuple[str, str, list[float]]:
    """The kind and name of a body, and a local position on it: its origin where none is given."""
    if not isinstance(body, (PlanarBody, SpatialBody)):
        raise TypeError(f"`{call}` takes a body, not {body!r}")
    kind, n = ("spatial", 3) if isinstance(body, SpatialBody) else ("planar", 2)
    return kind, body.name, list(flat(local)) if local is not None else [0.0] * n


def coordinate_name(names: Any, name: str) -> str:
    """The name as it is, or `slider.R_y` for `slider.y`."""
    if name in names or "." not in name:
        return name
    body, axis = name.rsplit(".", 1)
    longer = f"{body}.{_SHORT.get(axis, axis)}"
    return longer if longer in names else name
