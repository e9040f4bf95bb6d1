"""Stores the result of a run: position, velocity and acceleration over time, as arrays."""

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
from ._errors import UnknownName
from ._pictures import Picture
from ._handles import Coordinate, Ground, Handle, PlanarBody, PlanarLike, SpatialBody, SpatialLink
from ._mistakes import values
from ._names import Named
from ._values import flat, local_of

if TYPE_CHECKING:
    from ._system import System

Array = "np.ndarray[Any, np.dtype[np.float64]]"


def array(data: bytes, columns: Optional[int] = None) -> Any:
    """Returns the numbers as a read-only array with the given number of columns, without a copy."""
    numbers = np.frombuffer(data, dtype=np.float64)
    return numbers if columns is None else numbers.reshape(-1, columns)


@dataclass(frozen=True)
class Peak:
    """The value of largest magnitude of a quantity over time, with its sign, and its time."""

    value: float
    t: float
    unit: str
    text: str

    def __str__(self) -> str:
        return self.text


@values
@dataclass(frozen=True)
class Quantity:
    """One quantity over time with its derivatives, as arrays: a coordinate, the angle of a joint, a slide. [unit,
    unit/s, unit/s², unit/s³]

    A derivative is `None` if it is unknown.
    """

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
        """Returns the quantity with another name."""
        return replace(self, name=name)

    def __sub__(self, other: "Quantity") -> "Quantity":
        """Returns the difference of two quantities of one motion, with its derivatives."""
        if not isinstance(other, Quantity):
            return NotImplemented
        pairs = ((getattr(self, one), getattr(other, one)) for one in ("value", "velocity", "acceleration", "jerk"))
        orders = (None if a is None or b is None else np.asarray(a) - np.asarray(b) for a, b in pairs)
        return Quantity(f"{self.name} − {other.name}", self.unit, self.times, *orders)

    @property
    def rate(self) -> Any:
        """The derivative ẋ, the same array as `velocity`."""
        return self.velocity

    @property
    def second_rate(self) -> Any:
        """The derivative ẍ, the same array as `acceleration`."""
        return self.acceleration

    @property
    def max(self) -> float:
        """The largest value."""
        return float(np.max(self.value))

    @property
    def min(self) -> float:
        """The smallest value."""
        return float(np.min(self.value))

    @property
    def at_max(self) -> float:
        """The first time of the largest value. [s]"""
        return float(self.times[np.argmax(self.value)])

    @property
    def at_min(self) -> float:
        """The first time of the smallest value. [s]"""
        return float(self.times[np.argmin(self.value)])

    @property
    def rms(self) -> float:
        """The root mean square over time, by the trapezoidal rule."""
        if len(self.value) < 2:
            return float(np.max(np.abs(self.value)))
        square, steps = np.square(self.value), np.diff(self.times)
        return float(np.sqrt(np.sum(steps * (square[1:] + square[:-1]) / 2) / np.sum(steps)))

    @property
    def peak(self) -> Peak:
        """The value of largest magnitude, with its first time."""
        k = int(np.argmax(np.abs(self.value)))
        value, t = float(self.value[k]), float(self.times[k])
        return Peak(value, t, self.unit, f"{value:.6g} {self.unit} at t = {t:.6g}")

    def crossings(self, value: float) -> list[tuple[float, bool]]:
        """Returns the times at which the quantity passes a value, by linear interpolation, and the directions.

        Use this method for the time at which a drive begins to brake, or at which a pin lifts. For a measure use
        `System.crossings`, which solves poses. A quantity that reaches the value and returns to the same side does not
        pass the value.
        """
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


@values
@dataclass(frozen=True)
class Point:
    """A point of a body over time: `r`, `v`, `a`, and `jerk` if the run computed the jerk; a row for each time."""

    times: Any
    r: Any
    v: Any
    a: Any
    jerk: Any = None
    _unit: str = "m"

    @property
    def speed(self) -> Any:
        """The speed |v|. [m/s]"""
        return np.linalg.norm(self.v, axis=1)

    @property
    def acceleration_magnitude(self) -> Any:
        """The magnitude |a| of the acceleration. [m/s²]"""
        return np.linalg.norm(self.a, axis=1)

    @property
    def jerk_magnitude(self) -> Any:
        """The magnitude of the jerk, if the run computed the jerk. [m/s³]"""
        if self.jerk is None:
            raise AttributeError("the motion has no jerk. Request it by run(times, jerk=True)")
        return np.linalg.norm(self.jerk, axis=1)

    def along(self, n: Any) -> Quantity:
        """Returns the coordinate r · n / |n| of the point along a global direction n, with its derivatives. [m]"""
        direction = np.array(flat(n))
        unit = direction / np.linalg.norm(direction)
        r, v, a = (one @ unit for one in (self.r, self.v, self.a))
        return Quantity("along", self._unit, self.times, r, v, a, None if self.jerk is None else self.jerk @ unit)


@values
@dataclass(frozen=True)
class Rotation:
    """The rotation of a spatial body: `omega` and `alpha`, and the derivative of `alpha` if the run computed the jerk;
    a row for each time. [rad/s, rad/s²]
    """

    times: Any
    omega: Any
    alpha: Any
    alpha_rate: Any = None

    @property
    def speed(self) -> Any:
        """The magnitude |ω| of the angular velocity. [rad/s]"""
        return np.linalg.norm(self.omega, axis=1)

    def about(self, h: Any) -> Any:
        """Returns the angular velocity ω · h / |h| about a direction h in the same components. [rad/s]"""
        direction = np.array(flat(h))
        return self.omega @ (direction / np.linalg.norm(direction))


@dataclass(frozen=True)
class Break:
    """A break of a law that a run has crossed.

    The break is in the law `law` of the `constraint`, at the argument `x`, between two times. `order` is the lowest
    derivative that jumps (0 is the value, 1 the slope).
    """

    between: tuple[float, float]
    constraint: str
    law: str
    x: float
    order: int


@dataclass(frozen=True)
class Displacement:
    """The distance between the guess and the first position of a body or angle. [m, rad]

    A value is `None` if the user gave no position. `hint` is the likely cause, if the distance is larger than usual.
    """

    name: str
    moved: Optional[float]
    turned: Optional[float]
    hint: Optional[str]


@dataclass(frozen=True)
class Event:
    """An event at one time of a motion."""

    t: float
    kind: str
    name: str
    text: str


class MotionWarning(UserWarning):
    """A common mistake that Kin suspects although the run succeeds.

    The numbers of the motion are correct for the mechanism in the program, but the user may have intended another
    mechanism. `kind` is "degrees", "far from drawn", "singular start" or "beyond range". `names` lists the constraints,
    bodies and coordinates that the warning concerns.

    A run passes each warning to `warnings.warn`. `warnings.simplefilter("ignore", kin.MotionWarning)` hides the
    warnings, and "error" instead of "ignore" raises them as exceptions.
    """

    kind: str
    names: list[str]

    def __init__(self, kind: str, names: list[str], text: str) -> None:
        super().__init__(text)
        self.kind = kind
        self.names = names

    def __reduce__(self) -> Any:
        return (MotionWarning, (self.kind, self.names, str(self)))


@values
class Motion:
    """Position, velocity and acceleration at each time.

    `times`, `q`, `qd` and `qdd` are read-only arrays with a row for each time, which Kin creates once.
    `motion["crank.theta"]` is a coordinate with its derivatives.
    """

    def __init__(self, native: "_native.Motion") -> None:
        self._native = native

    @property
    def name(self) -> str:
        """The name of the mechanism."""
        return self._native.name()

    @cached_property
    def names(self) -> list[str]:
        """The names of the coordinates, such as `crank.theta`."""
        return self._native.names()

    @cached_property
    def units(self) -> list[str]:
        """The units of the coordinates."""
        return self._native.units()

    def __len__(self) -> int:
        return self._native.len()

    @cached_property
    def times(self) -> Any:
        """The times.   [s]"""
        return self._rows(4).ravel()

    @cached_property
    def q(self) -> Any:
        """The positions q: a row for each time, a column for each coordinate. [m, rad]"""
        return self._rows(0)

    @cached_property
    def qd(self) -> Any:
        """The velocities q̇: a row for each time, a column for each coordinate. [m/s, rad/s]"""
        return self._rows(1)

    @cached_property
    def qdd(self) -> Any:
        """The accelerations q̈: a row for each time, a column for each coordinate. [m/s², rad/s²]"""
        return self._rows(2)

    @cached_property
    def qddd(self) -> Any:
        """The jerks q⃛, if the run computed the jerk (`run(times, jerk=True)`). [m/s³, rad/s³]"""
        if not self._native.has_jerk():
            raise AttributeError("the motion has no jerk. Request it by run(times, jerk=True)")
        return self._rows(3)

    def _rows(self, which: int) -> Any:
        """The numbers where they lie, read-only: the array keeps the native motion."""
        return np.asarray(self._native.rows(which))

    @cached_property
    def iterations(self) -> Any:
        """The number of Newton steps at each time."""
        return np.array(self._native.iterations())

    @cached_property
    def residuals(self) -> Any:
        """The largest residual max |C_i| at each time, in the unit of its row."""
        return array(self._native.residuals())

    def __getitem__(self, name: Union[str, Coordinate]) -> Quantity:
        """Returns a coordinate over time, by its name or its handle: `motion["crank.theta"]`, `motion[crank.theta]`."""
        if not isinstance(name, (str, Coordinate)):
            text = f"motion[…] takes a coordinate, such as motion[crank.theta] or motion[\"crank.theta\"], not {name!r}"
            raise TypeError(f"{text}. All coordinates at time number k are motion.q[k]")
        key = coordinate_name(self.names, name.name if isinstance(name, Coordinate) else name)
        try:
            return Quantity._of(self._native.named(key), self.times)
        except UnknownName as error:
            owner, dot, _ = key.rpartition(".")
            if dot and not any(one.startswith(f"{owner}.") for one in self.names):
                error.args = (f"{error}. If `{owner}` is a joint, its measure is system.measure(motion, \"{key}\")",)
            raise

    def quantity(self, name: str, unit: str, orders: Any) -> Quantity:
        """Creates a quantity over the times of this motion from computed values.

        `orders` are x, ẋ, ẍ and, if known, x⃛, with one value for each time; x is in `unit`. Use this method in a
        measure that is a function of a motion (`system.extremes`). Kin does not check that the derivatives match the
        values.
        """
        lists = [np.asarray(one, dtype=float) for one in orders]
        if not 3 <= len(lists) <= 4 or any(one.shape != (len(self.times),) for one in lists):
            text = f"`{name}`: x, its rate and its second rate are lists of {len(self.times)} numbers, one a time"
            raise ValueError(text)
        return Quantity(name, unit, self.times, *lists)

    def point(self, body: Union[PlanarBody, SpatialBody, Ground], local: Any = None) -> Point:
        """Returns r, v and a of the point with local position `local` of a body; the default is the origin of the body.
        [m, m/s, m/s²]
        """
        if isinstance(body, Ground):
            fixed = np.tile(np.array(flat(local if local is not None else (0.0, 0.0))), (len(self), 1))
            return Point(self.times, fixed, np.zeros_like(fixed), np.zeros_like(fixed))
        kind, name, u = place_of("point", body, local)
        found = self._native.point(kind, name, u)
        r, v, a, *jerk = (array(one, len(u)) for one in found)
        return Point(self.times, r, v, a, jerk[0] if jerk else None, self._native.unit_words()[0])

    def rotation(self, body: Union[SpatialBody, SpatialLink], *, in_body: bool = False) -> Rotation:
        """Returns the angular velocity and acceleration of a spatial body, in global components or in those of the
        body.
        """
        found = self._native.rotation(body.name, in_body)
        return Rotation(self.times, *(array(one, 3) for one in found))

    def distance(self, a: Handle, p: Any, b: Handle, q: Any) -> Quantity:
        """Returns the distance |r_P − r_Q| with its derivatives, where P is at p in body a and Q is at q in body b. [m]

        Use the distance for the length of a cylinder or the clearance of two edges.

        Raises an error if a body belongs to another mechanism, or if the points coincide, where the distance has no
        derivative.
        """
        points = local_of("distance", p), local_of("distance", q)
        in_plane = len(points[0]) == 2
        names = [_name_of("distance", body, PlanarBody if in_plane else SpatialBody) for body in (a, b)]
        return Quantity._of(self._native.distance(in_plane, (names[0], points[0]), (names[1], points[1])), self.times)

    def relative_angle(self, a: PlanarLike, b: PlanarLike) -> Quantity:
        """Returns the angle θ_a − θ_b, which counts full revolutions. [rad]"""
        names = (_name_of("relative_angle", body, PlanarBody) for body in (a, b))
        return Quantity._of(self._native.relative_angle(*names), self.times)

    def transmission_angle(
        self, coupler: Union[PlanarLike, tuple[PlanarLike, Any]], driven: Union[PlanarLike, tuple[PlanarLike, Any]]
    ) -> Quantity:
        """Returns the transmission angle between a coupler and the link that it drives, from 0 to π/2, with its
        derivatives. [rad]

        The closer the angle is to π/2, the better the coupler transmits force. A body gives the direction of its
        x-axis, which is the line through the pins of a link. A pair (body, direction) gives another direction. For a
        slider write `motion.transmission_angle(rod, (m.ground, (0, 1)))`.
        """
        lines = (_line(one) for one in (coupler, driven))
        return Quantity._of(self._native.transmission_angle(*lines), self.times)

    def instant_centre(self, a: PlanarLike, b: PlanarLike) -> Any:
        """Returns the instant centre of two planar bodies, in the global frame, a row for each time. [m]

        The instant centre is the point with the same velocity in both bodies, (−v_y, v_x)/ω of the relative motion. The
        row is NaN at times at which the bodies do not rotate relative to each other.
        """
        names = (_name_of("instant_centre", body, PlanarBody) for body in (a, b))
        found = self._native.instant_centre(*names)
        return np.array([(np.nan, np.nan) if one is None else one for one in found]).reshape(-1, 2)

    @property
    def summary(self) -> str:
        """A summary: counts, Newton steps, the largest residual, and the distance of the first position from the drawn
        position.
        """
        return self._native.summary()

    @property
    def worst(self) -> Optional[str]:
        """The name of the equation with the largest residual of all times, such as `A.x`."""
        return self._native.facts()[1]

    @property
    def misfit(self) -> float:
        """The contradiction of redundant equations as a share of their norms; 0 unless `allowed_misfit` allows a
        contradiction. [-]
        """
        return self._native.facts()[2]

    @property
    def displaced(self) -> list[Displacement]:
        """The distance between the guess and the first position of each body and scalar angle, the largest first."""
        return [Displacement(*one) for one in self._native.displaced()]

    @property
    def breaks(self) -> list[Break]:
        """The breaks of laws that the run crossed, in the order of time.

        At each break a derivative of the motion jumps.
        """
        return [Break(*one) for one in self._native.breaks()]

    @property
    def events(self) -> list[Event]:
        """The events of the motion: ends of slots, limits, toggles, change points, kinks, and ends of tables."""
        return [Event(*one) for one in self._native.events()]

    @property
    def warnings(self) -> list[MotionWarning]:
        """The warnings of the motion: common mistakes with which a run still succeeds.

        Kin warns of numbers that look like degrees, a first position far from the drawn position, a start near a
        singular position, and a table that ends before the run. The list contains at most four warnings of each kind.
        """
        return [MotionWarning(*one) for one in self._native.warnings()]

    def _warn(self) -> None:
        """Passes each warning to Python, at the line of whoever called the method that calls this."""
        for one in self.warnings:
            warnings.warn(one, stacklevel=3)

    @property
    def singular_positions(self) -> list[dict[str, Any]]:
        """The singular positions of the run in the order of time: change points, and a toggle as the last one."""
        found: list[dict[str, Any]] = json.loads(self._native.singular_positions())
        return found

    @property
    def engine(self) -> tuple[int, int]:
        """The number of times that a program has computed (`run(times, engine="compiled")`), and the number of returns
        to the step-by-step solver.
        """
        return self._native.engine()

    @property
    def why_not_compiled(self) -> Optional[str]:
        """The reason why the step-by-step solver computed everything although a program would have been faster.

        The reason names the constraint.
        """
        return self._native.facts()[0]

    # Pictures.

    def chart(self, *what: Union[str, Coordinate], title: str = "") -> Picture:
        """Returns a chart of coordinates over time, which a notebook shows."""
        names = [coordinate_name(self.names, one.name if isinstance(one, Coordinate) else one) for one in what]
        return Picture(self._native.chart(title or ", ".join(names), names))

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.summary)}</pre>"

    # Tables and files.

    def columns(self) -> dict[str, Any]:
        """Returns time, and each coordinate with its derivatives, by the headers of the CSV file: `t`, `crank.theta`,
        `crank.theta'`, …
        """
        table: dict[str, Any] = Named("column", {"t": self.times})
        for k, name in enumerate(self.names):
            for mark, rows in (("", self.q), ("'", self.qd), ("''", self.qdd)):
                table[name + mark] = rows[:, k]
        return table

    def to_pandas(self) -> Any:
        """Returns the columns as a pandas DataFrame. The package pandas must be installed."""
        import pandas

        return pandas.DataFrame(self.columns())

    def to_arrow(self) -> Any:
        """Returns the columns as an Arrow table. The package pyarrow must be installed."""
        import pyarrow

        return pyarrow.table(self.columns())

    def write_csv(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes all numbers with 17 digits and units in the header, and creates missing folders."""
        self._native.write_csv(os.fspath(path))

    def write_json(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the motion to a JSON file without loss."""
        self._native.write_json(os.fspath(path))

    def to_json(self) -> str:
        """Returns the motion as the text of a file."""
        return self._native.to_json()

    @staticmethod
    def from_states(system: "System", times: Any, q: Any, qd: Any, qdd: Any) -> "Motion":
        """Creates a motion from measured states, or from states of another program. [m, rad, s]

        q, q̇ and q̈ have a row for each time and a column for each coordinate of the system. You can compute the forces
        and measures of the motion.

        Raises an error if an array has another shape, if a number is not finite, or if the times do not only increase
        or only decrease.
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
        """Creates a motion from the text of a file."""
        return Motion(_native.Motion.from_json(text))

    @staticmethod
    def read_json(path: Union[str, "os.PathLike[str]"]) -> "Motion":
        """Reads a motion from a file."""
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
    """Converts the result of a function of a motion for the native module: name, unit, x, ẋ, ẍ and x⃛ (empty if
    unknown).
    """
    if not isinstance(made, Quantity):
        raise TypeError(f"a measure is a function of a motion that gives a kin.Quantity, not {made!r}")
    if made.velocity is None or made.acceleration is None:
        text = f"`{made.name}` has no rates: give motion.quantity(name, unit, [x, rate, second_rate])"
        raise ValueError(text)
    rates = (made.value, made.velocity, made.acceleration, () if made.jerk is None else made.jerk)
    return made.name, made.unit, [np.asarray(one, dtype=float).ravel().tolist() for one in rates]


def place_of(call: str, body: Any, local: Any) -> tuple[str, str, list[float]]:
    """Returns the kind and name of a body, and a local position; the default is the origin."""
    if not isinstance(body, (PlanarBody, SpatialBody)):
        raise TypeError(f"`{call}` takes a body, not {body!r}")
    kind, n = ("spatial", 3) if isinstance(body, SpatialBody) else ("planar", 2)
    return kind, body.name, local_of(call, local) if local is not None else [0.0] * n


def coordinate_name(names: Any, name: str) -> str:
    """Returns the name unchanged, or `slider.R_y` for `slider.y`."""
    if name in names or "." not in name:
        return name
    body, axis = name.rsplit(".", 1)
    longer = f"{body}.{_SHORT.get(axis, axis)}"
    return longer if longer in names else name
