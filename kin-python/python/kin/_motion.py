"""What a run gives: position, velocity and acceleration over time, as arrays."""

from __future__ import annotations

import html
import json
import os
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Optional, Union

import numpy as np

from . import _native
from ._pictures import Picture
from ._handles import Coordinate, Ground, PlanarBody, SpatialBody, SpatialLink
from ._values import flat

Array = "np.ndarray[Any, np.dtype[np.float64]]"


def array(data: bytes, columns: Optional[int] = None) -> Any:
    """The numbers where they lie, read-only: rows of so many columns."""
    numbers = np.frombuffer(data, dtype=np.float64)
    return numbers if columns is None else numbers.reshape(-1, columns)


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

    @property
    def speed(self) -> Any:
        """|v|   [m/s]"""
        return np.linalg.norm(self.v, axis=1)


@dataclass(frozen=True)
class Rotation:
    """How a spatial body turns: `omega`, `alpha` (and its rate where the run was asked for the jerk), a row a time.   [rad/s,
    rad/s²]"""

    times: Any
    omega: Any
    alpha: Any
    alpha_rate: Any = None


@dataclass(frozen=True)
class Event:
    """Something that happens at one time of a motion."""

    t: float
    kind: str
    name: str
    text: str


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
        return array(self._native.times())

    @cached_property
    def q(self) -> Any:
        """q, a row a time, a column a coordinate.   [m, rad]"""
        return array(self._native.rows(0), len(self.names))

    @cached_property
    def qd(self) -> Any:
        """q̇   [m/s, rad/s]"""
        return array(self._native.rows(1), len(self.names))

    @cached_property
    def qdd(self) -> Any:
        """q̈   [m/s², rad/s²]"""
        return array(self._native.rows(2), len(self.names))

    @cached_property
    def qddd(self) -> Any:
        """q⃛, where the run was asked for the jerk (`run(times, jerk=True)`).   [m/s³, rad/s³]"""
        if not self._native.has_jerk():
            raise AttributeError("the motion holds no jerk: run(times, jerk=True) asks for it")
        return array(self._native.rows(3), len(self.names))

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

    def point(self, body: Union[PlanarBody, SpatialBody, Ground], local: Any = None) -> Point:
        """r, v and a of the point with local position `local` of a body, its origin where none is given.   [m, m/s, m/s²]"""
        if isinstance(body, Ground):
            fixed = np.tile(np.array(flat(local if local is not None else (0.0, 0.0))), (len(self), 1))
            return Point(self.times, fixed, np.zeros_like(fixed), np.zeros_like(fixed))
        if not isinstance(body, (PlanarBody, SpatialBody)):
            raise TypeError(f"`point` takes a body, not {body!r}")
        kind, n = ("spatial", 3) if isinstance(body, SpatialBody) else ("planar", 2)
        found = self._native.point(kind, body.name, flat(local) if local is not None else [0.0] * n)
        return Point(self.times, *(array(one, n) for one in found))

    def rotation(self, body: Union[SpatialBody, SpatialLink], *, in_body: bool = False) -> Rotation:
        """Angular velocity and acceleration of a spatial body, in global components or those of the body."""
        found = self._native.rotation(body.name, in_body)
        return Rotation(self.times, *(array(one, 3) for one in found))

    def relative_angle(self, a: PlanarBody, b: PlanarBody) -> Quantity:
        """θ_a − θ_b, any number of turns.   [rad]"""
        return Quantity._of(self._native.relative_angle(a.name, b.name), self.times)

    def transmission_angle(self, coupler: PlanarBody, driven: PlanarBody) -> Quantity:
        """The angle between the x-axes of two bodies, such as coupler and rocker, between 0 and π/2.   [rad]"""
        return Quantity._of(self._native.transmission_angle(coupler.name, driven.name), self.times)

    @property
    def summary(self) -> str:
        """Counts, Newton steps, the largest residual, and how far the first position is from the drawn one."""
        return self._native.summary()

    @property
    def events(self) -> list[Event]:
        """What happened on the way: ends of slots, limits, toggles, change points, kinks."""
        return [Event(*one) for one in self._native.events()]

    @property
    def singular_positions(self) -> list[dict[str, Any]]:
        """Change points, and at last a toggle, in the order of time."""
        found: list[dict[str, Any]] = json.loads(self._native.singular_positions())
        return found

    @property
    def engine(self) -> tuple[int, int]:
        """How many times a program has computed (`run(times, engine="compiled")`), and how often it has handed back."""
        return self._native.engine()

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
    def from_json(text: str) -> "Motion":
        """The motion that such a text says."""
        return Motion(_native.Motion.from_json(text))

    @staticmethod
    def read_json(path: Union[str, "os.PathLike[str]"]) -> "Motion":
        """The motion of such a file."""
        with open(path, encoding="utf-8") as file:
            return Motion.from_json(file.read())

    def __reduce__(self) -> Any:
        return (Motion.from_json, (self.to_json(),))

    def __copy__(self) -> "Motion":
        return self

    def __repr__(self) -> str:
        return f"<motion of {self.name}, {len(self)} times>"


_SHORT = {"x": "R_x", "y": "R_y", "z": "R_z"}


def coordinate_name(names: Any, name: str) -> str:
    """The name as it is, or `slider.R_y` for `slider.y`."""
    if name in names or "." not in name:
        return name
    body, axis = name.rsplit(".", 1)
    longer = f"{body}.{_SHORT.get(axis, axis)}"
    return longer if longer in names else name
