"""Positions by values of drivers instead of by time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, Optional, Sequence

import numpy as np

from . import _native
from ._motion import Motion, array
from ._results import Proof


class Configuration:
    """The position of a mechanism at given values of its drivers, with all drivers at rest. `here["rocker.theta"]` is a coordinate or a
    measure of a joint by name."""

    q: Any
    """The coordinates in the order of `system.names`, read-only.   [m, rad]"""
    drivers: dict[str, float]
    """The values that the follower moves, by name: those of all drivers, or the given ones."""
    left_out: dict[str, float]
    """The values of the drivers that are left out because other values are given, by name."""
    measures: dict[str, float]
    """The measures of all joints by name."""
    motion: Motion
    """The configuration as a motion of one time, for points and pictures."""

    def __init__(self, native: "_native.Follower", names: list[str]) -> None:
        self.q = array(native.q())
        self.drivers = {name: value for name, _, value in native.drivers()}
        self.left_out = {name: value for name, _, value in native.left_out()}
        self.measures = dict(native.measures())
        self.motion = Motion(native.motion())
        self._names = names

    def __getitem__(self, name: str) -> float:
        if name in self._names:
            return float(self.q[self._names.index(name)])
        if name in self.measures:
            return self.measures[name]
        raise KeyError(f"there is no coordinate or measure `{name}`; known: {', '.join([*self._names, *self.measures])}")

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value:.6g}" for name, value in self.drivers.items())
        return f"Configuration({values})"


class Configurations:
    """Positions of a mechanism at many values of its drivers. `all["rocker.theta"]` holds a coordinate or a measure of each position."""

    q: Any
    """The coordinates, a row for each position, read-only.   [m, rad]"""
    drivers: dict[str, Any]
    """The values of the drivers that were moved, by name."""

    def __init__(self, q: Any, measured: Any, names: list[str], measures: list[str], drivers: dict[str, Any]) -> None:
        self.q, self._measured, self.drivers = q, measured, drivers
        self._names, self._measures = names, measures

    def __len__(self) -> int:
        return len(self.q)

    def __getitem__(self, name: str) -> Any:
        if name in self._names:
            return self.q[:, self._names.index(name)]
        if name in self._measures:
            return self._measured[:, self._measures.index(name)]
        raise KeyError(f"there is no coordinate or measure `{name}`; known: {', '.join([*self._names, *self._measures])}")

    def __repr__(self) -> str:
        return f"Configurations({len(self)} of {', '.join(self.drivers)})"


@dataclass(frozen=True)
class CircuitPoint:
    """A position on a circuit: its arc `length`, the value of the `input`, the coordinates `q`, and the `value` of the quantity of which
    it is an extreme."""

    length: float
    input: float
    q: Any
    value: float


class Circuit:
    """The whole connected curve of positions that a mechanism reaches while one driver moves, past dead centres, by arc length. The arc
    length counts each coordinate divided by its characteristic size, so it has no unit."""

    q: Any
    """The coordinates, a row for each position, read-only.   [m, rad]"""
    inputs: Any
    """The values of the input, one for each position."""
    motion: Motion
    """The positions as a motion whose times are arc lengths, for points, tables and pictures."""

    def __init__(self, native: "_native.Circuit") -> None:
        self._native = native
        self.motion = Motion(native.motion())
        self.q = self.motion.q
        self.inputs = array(native.inputs())

    @property
    def is_closed(self) -> bool:
        """True if the circuit comes back to its first position."""
        return self._native.is_closed()

    @property
    def length(self) -> float:
        """The whole arc length."""
        return self._native.length()

    @property
    def dead_centres(self) -> list[CircuitPoint]:
        """Where the input turns back: a motor cannot drive the mechanism past."""
        return _points(self._native.dead_centres())

    @property
    def crossings(self) -> list[CircuitPoint]:
        """Where another circuit crosses this one."""
        return _points(self._native.crossings())

    def extremes(self, coordinate: str) -> list[CircuitPoint]:
        """The extremes of a coordinate such as `rocker.theta`: the dead centres of a driver of this coordinate."""
        return _points(self._native.extremes(coordinate))

    def range(self, coordinate: str) -> tuple[float, float]:
        """The least and the largest value of a coordinate over the circuit."""
        least, most = self._native.range(coordinate)
        return least, most

    def __repr__(self) -> str:
        return f"Circuit({'closed' if self.is_closed else 'open'}, {len(self.q)} positions, {len(self.dead_centres)} dead centres)"


def _points(found: list[tuple[float, float, bytes, float]]) -> list[CircuitPoint]:
    return [CircuitPoint(length, value, array(q), of) for length, value, q, of in found]


class Follower:
    """Stands on one branch of a mechanism and moves along it by values of its drivers.

        follower = system.follower()
        here = follower.to(motor=0.63)
        here["rocker.theta"]

    A driver is a law whose argument is time. Its name is the name of the constraint, or `NAME.LAW` if the constraint has several such
    laws. Each move goes along the straight line from the present values, over any distance, and is checked as a run is.
    """

    def __init__(self, native: "_native.Follower", system: "_native.System") -> None:
        self._native, self._system = native, system

    def to(self, values: Optional[Mapping[str, Any]] = None, **named: Any) -> Any:
        """Moves the named drivers to these values and returns the `Configuration` there; the other drivers stand still. Names with a dot
        or a space are given in a dict: `to({"left motor": 0.3})`. With arrays it moves through all of their values in turn, in one call,
        and returns `Configurations`.

        Raises an error by name: no such driver, a value that is not finite; then the follower has not moved. Raises `kin.CannotReach` if a
        singular position is on the way: its `reached` holds the values there, its `movable` and `dependent` name what is in line, its `motion` is
        the configuration there. The follower stands there, and can be moved back.
        """
        given = {**(values or {}), **named}
        if any(np.ndim(value) > 0 for value in given.values()):
            return self._to_by(given)
        self._native.to([(name, float(value)) for name, value in given.items()])
        return self.here

    def _to_by(self, given: Mapping[str, Any]) -> Configurations:
        columns = np.broadcast_arrays(*[np.asarray(value, dtype=np.float64) for value in given.values()])
        if columns[0].ndim != 1:
            raise ValueError(f"values of drivers are numbers or lists of numbers, not arrays of {columns[0].ndim} dimensions")
        names, measures = self._system.names(), self._system.measures()
        path = np.ascontiguousarray(np.stack(columns, axis=1))
        q, measured = self._native.to_by(list(given), path.tobytes(), measures)
        drivers = {name: column.copy() for name, column in zip(given, columns)}
        rows = array(measured).reshape(len(path), len(measures))
        return Configurations(array(q).reshape(len(path), len(names)), rows, names, measures, drivers)

    def prove_to(self, values: Mapping[str, float], steps: int = 100) -> Proof:
        """Moves the named drivers as `to` does, over so many equal steps, and proves by interval bounds that each step stays on its branch.
        The times of the proof go from -1 to 0. The follower moves also where a step is not proved.

        Raises the errors of `to` and of `System.prove`; then the follower is where it was.
        """
        return Proof._of(self._native.prove_to([(name, float(value)) for name, value in values.items()], steps))

    @property
    def here(self) -> Configuration:
        """The configuration where the follower is."""
        return Configuration(self._native, self._system.names())

    @property
    def drivers(self) -> dict[str, float]:
        """The present values of all drivers by name."""
        return {name: value for name, _, value in self._native.drivers()}

    @property
    def units(self) -> dict[str, Optional[str]]:
        """The units of the drivers by name, such as `rad`; None if a unit is unknown."""
        return {name: unit for name, unit, _ in self._native.drivers()}

    def given(self, names: Sequence[str]) -> "Follower":
        """A follower at the same configuration that is moved by other values than those of the drivers: measures of joints, coordinates
        or drivers, by name, as many as there are freedoms. The drivers that are not named are left out.

        Raises an error by name: unknown, twice, too many or too few, or dependent on one another.
        """
        return Follower(self._native.given(_names(names)), self._system)

    @property
    def frozen(self) -> list[str]:
        """Names of the constraints that read time in another way than by a law of time alone. Time stands still in them."""
        return self._native.frozen()

    def circuit(self, input: str, points: int = 361) -> Circuit:
        """The circuit through the configuration where the follower is, as so many positions, equally spaced by arc length. The named driver
        is the input; the others are at rest. The follower does not move.

        Raises an error by name: no such driver, redundant equations, a singular position.
        """
        return Circuit(self._native.circuit(input, points))

    def rates(self, velocities: Mapping[str, float], accelerations: Optional[Mapping[str, float]] = None) -> tuple[Any, Any]:
        """q̇ and q̈ where the follower is, for these velocities and accelerations of the drivers; the others are at rest."""
        qd, qdd = self._native.rates(_rates(velocities, accelerations or {}))
        return array(qd), array(qdd)

    def efforts(self, velocities: Optional[Mapping[str, float]] = None, accelerations: Optional[Mapping[str, float]] = None) -> dict[str, float]:
        """The efforts that masses and loads require of the values that the follower moves, for these velocities and accelerations of the
        values; the others are at rest. The effort of an angle is a torque, that of a length a force.

        Raises the errors of `System.forces`.
        """
        return {name: value for name, _, value in self._native.efforts(_rates(velocities or {}, accelerations or {}))}

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value:.6g}" for name, value in self.drivers.items())
        return f"Follower({values})"


def _names(names: Sequence[str]) -> list[str]:
    return [names] if isinstance(names, str) else list(names)


def _rates(velocities: Mapping[str, float], accelerations: Mapping[str, float]) -> list[tuple[str, list[float]]]:
    names = list(dict.fromkeys([*velocities, *accelerations]))
    return [(name, [float(velocities.get(name, 0.0)), float(accelerations.get(name, 0.0))]) for name in names]
