"""Positions by wishes, with the drivers released."""

from __future__ import annotations

from typing import Any, Iterable, Union

from . import _native
from ._handles import PlanarBody, SpatialBody
from ._motion import Motion, array, place_of
from ._values import flat, local_of


class Wish:
    """A wish for a position: `Wish.point(coupler, (0.2, 0.1), (1.5, 0.8))`, `Wish.measure("rocker.theta", 0.4)`, or
    `Wish.hold("rocker.theta")`. Wishes of a smaller `priority` come first."""

    def __init__(self, native: "_native.Wish") -> None:
        self._native = native

    @staticmethod
    def point(body: Union[PlanarBody, SpatialBody], local: Any, target: Any, *, priority: int = 0) -> "Wish":
        """Wishes for the point `local` of a body to be at the target. [m]"""
        _, name, u = place_of("Wish.point", body, local)
        return Wish(_native.Wish.point(name, u, local_of("Wish.point", target), priority))

    @staticmethod
    def measure(name: str, value: float, *, priority: int = 0) -> "Wish":
        """Wishes for a measure of a joint or a coordinate, by its name, to have a value."""
        return Wish(_native.Wish.measure(str(name), float(value), priority))

    @staticmethod
    def hold(name: str, *, priority: int = 0) -> "Wish":
        """Wishes for a measure of a joint or a coordinate to keep its present value."""
        return Wish(_native.Wish.hold(str(name), priority))


class Granted:
    """How far a wish was met."""

    name: str
    """The measure or coordinate, or the body and its point."""
    is_met: bool
    """True if the wish is met within rounding."""
    missed: float
    """By how much the wish is missed: a distance for a point, in `unit`."""
    unit: str
    """The unit of `missed`."""

    def __init__(self, native: "_native.WishResult") -> None:
        self.name, self.is_met, self.missed, self.unit = native.name, native.is_met, native.missed, native.unit

    def __repr__(self) -> str:
        return f"Granted({self.name!r}, met)" if self.is_met else f"Granted({self.name!r}, missed by {self.missed:.6g} {self.unit})"


class Reached:
    """The position that wishes led to."""

    wishes: list[Granted]
    """How far each wish was met, in the order of priorities."""
    limits: list[str]
    """The limits at whose ends the mechanism stands, by the names of their measures."""
    freedoms: list[str]
    """The freedoms that the wishes and limits leave, by a coordinate for each."""

    def __init__(self, native: "_native.ReachedPosition") -> None:
        self.wishes = [Granted(one) for one in native.wishes]
        self.limits, self.freedoms = native.limits, native.freedoms

    @property
    def is_met(self) -> bool:
        """True if all wishes are met."""
        return all(one.is_met for one in self.wishes)

    def __repr__(self) -> str:
        return f"Reached({self.wishes}, limits={self.limits}, freedoms={self.freedoms})"


class Released:
    """A mechanism whose drivers are released, at one position. It moves by wishes:

        arm = m.released()
        arm.drag(hand, hand.end, (0.3, 0.6))
        arm["elbow.angle"]

    The mechanism follows each wish along a straight line in small steps of least change, within the limits of its measures. It neither
    jumps nor changes its assembly. `arm["rocker.theta"]` is a coordinate or a measure of a joint by name.
    """

    def __init__(self, native: "_native.Released") -> None:
        self._native = native
        self._names = native.names()

    def drag(self, body: Union[PlanarBody, SpatialBody], local: Any, target: Any) -> Reached:
        """Moves the mechanism so that the point `local` of a body comes to the target, or as near to it as the mechanism can follow. [m]

        Raises an error if a number is not finite; the mechanism then has not moved.
        """
        return self.reach(Wish.point(body, local, target))

    def reach(self, *wishes: Union[Wish, Iterable[Wish]]) -> Reached:
        """Moves the mechanism towards wishes. A wish of an earlier priority counts before all later ones; wishes of one priority share what
        they miss by least squares.

        Raises an error by name if no measure or coordinate has the name; the mechanism then has not moved.
        """
        all = [one for wish in wishes for one in ([wish] if isinstance(wish, Wish) else wish)]
        return Reached(self._native.reach([wish._native for wish in all]))

    def set_position(self, q: Any) -> None:
        """Takes the mechanism to the position near q that satisfies its equations."""
        self._native.set_position(flat(q))

    def set(self, name: str, value: float) -> None:
        """Sets a parameter or dimension, as `System.set` does, and takes the mechanism to the nearest position with this value.

        Raises an error if no position is near; the value is then the old one.
        """
        self._native.set(name, float(value))

    @property
    def freedoms(self) -> list[str]:
        """The freedoms of the mechanism where it stands, by a coordinate for each."""
        return self._native.freedoms()

    @property
    def q(self) -> Any:
        """The coordinates in the order of `names`, read-only. [m, rad]"""
        return array(self._native.q())

    @property
    def names(self) -> list[str]:
        """The names of the coordinates."""
        return list(self._names)

    @property
    def measures(self) -> dict[str, float]:
        """The measures of all joints by name."""
        return dict(self._native.measures())

    @property
    def motion(self) -> Motion:
        """The position as a motion of one time, for points and pictures."""
        return Motion(self._native.motion())

    def __getitem__(self, name: str) -> float:
        if name in self._names:
            return float(self.q[self._names.index(name)])
        measures = self.measures
        if name in measures:
            return measures[name]
        raise KeyError(f"there is no coordinate or measure `{name}`; known: {', '.join([*self._names, *measures])}")

    def __repr__(self) -> str:
        return f"Released({len(self._names)} coordinates, freedoms: {', '.join(self.freedoms)})"
