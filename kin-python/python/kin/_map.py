"""Maps between given and wanted values of a mechanism."""

from __future__ import annotations

from typing import Any, Mapping, Optional, Sequence

import numpy as np

from . import _native
from ._follower import Configuration
from ._motion import array


class Mapped:
    """A map at one configuration: values and slopes. `here["roll.angle"]` is a given or a wanted value by name."""

    given: dict[str, float]
    """The given values by name."""
    wanted: dict[str, float]
    """The wanted values by name."""
    units: dict[str, Optional[str]]
    """The units of all of these values by name; None if a unit is unknown."""
    jacobian: Any
    """J = ∂wanted / ∂given: a row for each wanted value, a column for each given one."""

    def __init__(self, found: tuple[Any, Any, bytes]) -> None:
        given, wanted, jacobian = found
        self.given = {name: value for name, _, value in given}
        self.wanted = {name: value for name, _, value in wanted}
        self.units = {name: unit for name, unit, _ in [*given, *wanted]}
        self.jacobian = array(jacobian).reshape(len(self.wanted), len(self.given))

    def __getitem__(self, name: str) -> float:
        for values in (self.wanted, self.given):
            if name in values:
                return values[name]
        raise KeyError(f"there is no given or wanted value `{name}`; known: {', '.join([*self.given, *self.wanted])}")

    def velocities(self, given: Mapping[str, float]) -> dict[str, float]:
        """The velocities of the wanted values, J u̇, for these velocities of the given ones; the others are at rest."""
        found = self.jacobian @ _numbers(self.given, "given", given)
        return dict(zip(self.wanted, found.tolist()))

    def efforts(self, wanted: Mapping[str, float]) -> dict[str, float]:
        """The efforts of the given values that do the same virtual work as these efforts of the wanted ones, Jᵀ τ. An effort is a torque
        if its value is an angle, and a force if it is a length."""
        found = self.jacobian.T @ _numbers(self.wanted, "wanted", wanted)
        return dict(zip(self.given, found.tolist()))

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value:.6g}" for name, value in {**self.given, **self.wanted}.items())
        return f"Mapped({values})"


class Map:
    """The map from given values of a mechanism to wanted ones, on one branch, such as from motor angles to the angles of an ankle.

        motors = system.map(["pitch.angle", "roll.angle"], ["left motor", "right motor"])
        here = motors.to({"pitch.angle": 0.2, "roll.angle": -0.1})
        here["left motor"], here.jacobian
    """

    def __init__(self, native: "_native.Map", system: "_native.System") -> None:
        self._native, self._system = native, system

    def to(self, values: Optional[Mapping[str, float]] = None, **named: float) -> Mapped:
        """Moves the given values along the straight line from where they are, and returns the map there.

        Raises the errors of `Follower.to`.
        """
        given = {**(values or {}), **named}
        return Mapped(self._native.to([(name, float(value)) for name, value in given.items()]))

    @property
    def here(self) -> Mapped:
        """The map where it is: values and slopes."""
        return Mapped(self._native.here())

    @property
    def configuration(self) -> Configuration:
        """The configuration where the map is."""
        return Configuration(self._native.follower(), self._system.names())

    @property
    def inverse(self) -> "Map":
        """The map the other way round, at the same configuration: what was wanted is given.

        Raises an error if the wanted values do not fix the rest.
        """
        return Map(self._native.inverse(), self._system)

    def jacobian_rate(self, velocities: Mapping[str, float]) -> Any:
        """J̇, the rate of the slopes while the given values move with these velocities; the others are at rest."""
        found = array(self._native.jacobian_rate([(name, float(rate)) for name, rate in velocities.items()]))
        here = self.here
        return found.reshape(len(here.wanted), len(here.given))

    def border(self, ranges: Mapping[str, Sequence[float]], points: int = 33) -> list[Mapped]:
        """The map along the border of these ranges of one or two given values, `points` configurations for each side: limits of one space
        drawn in the other. The map itself does not move."""
        pairs = [(name, [float(ends[0]), float(ends[1])]) for name, ends in ranges.items()]
        return [Mapped(found) for found in self._native.border(pairs, points)]

    def __repr__(self) -> str:
        here = self.here
        return f"Map({', '.join(here.given)} to {', '.join(here.wanted)})"


def _numbers(known: Mapping[str, float], what: str, given: Mapping[str, float]) -> Any:
    for name in given:
        if name not in known:
            raise KeyError(f"there is no {what} value `{name}`; known: {', '.join(known)}")
    return np.array([float(given.get(name, 0.0)) for name in known])
