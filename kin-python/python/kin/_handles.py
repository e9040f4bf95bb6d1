"""Defines the handles of bodies and coordinates, which methods of a mechanism return."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Optional, Union

from ._dimension import NumberLike
from ._mistakes import values
from ._vectors import Vec2, Vec3


@dataclass(frozen=True)
class Coordinate:
    """A coordinate: a scalar coordinate, or a coordinate of a body such as `crank.theta`."""

    name: str
    _of: str = field(repr=False)
    _kind: str = field(default="coord", repr=False)


@values
@dataclass(frozen=True)
class _Body:
    name: str
    _of: str = field(repr=False)
    _length: Optional[NumberLike] = field(default=None, repr=False)

    def _coordinate(self, axis: str) -> Coordinate:
        return Coordinate(f"{self.name}.{axis}", self._of)

    @property
    def x(self) -> Coordinate:
        """R_x   [m]"""
        return self._coordinate("R_x")

    @property
    def y(self) -> Coordinate:
        """R_y   [m]"""
        return self._coordinate("R_y")


@values
@dataclass(frozen=True)
class PlanarBody(_Body):
    """A planar body."""

    @property
    def theta(self) -> Coordinate:
        """θ, counter-clockwise from the global x-axis.   [rad]"""
        return self._coordinate("theta")


@values
@dataclass(frozen=True)
class SpatialBody(_Body):
    """A spatial body."""

    @property
    def z(self) -> Coordinate:
        """R_z   [m]"""
        return self._coordinate("R_z")


@values
@dataclass(frozen=True)
class Link(PlanarBody):
    """A planar body between two pins, with its frame in the middle."""

    @property
    def length(self) -> NumberLike:
        """The distance of the pins: a number or a dimension. [m]"""
        return 0.0 if self._length is None else self._length

    @property
    def start(self) -> Vec2:
        """The local position of the first pin, (−l/2, 0). [m]"""
        return Vec2(-0.5 * self.length, 0.0)

    @property
    def end(self) -> Vec2:
        """The local position of the second pin, (l/2, 0). [m]"""
        return Vec2(0.5 * self.length, 0.0)


@values
@dataclass(frozen=True)
class SpatialLink(SpatialBody):
    """A spatial body between two points, with its frame in the middle and its x-axis from the first point to the
    second.
    """

    @property
    def length(self) -> NumberLike:
        """The distance of the two points. [m]"""
        return 0.0 if self._length is None else self._length

    @property
    def start(self) -> Vec3:
        """The local position of the first point, (−l/2, 0, 0). [m]"""
        return Vec3(-0.5 * self.length, 0.0, 0.0)

    @property
    def end(self) -> Vec3:
        """The local position of the second point, (l/2, 0, 0). [m]"""
        return Vec3(0.5 * self.length, 0.0, 0.0)


@values
@dataclass(frozen=True)
class Ground:
    """The ground: the global frame, a planar and a spatial body without coordinates."""

    name = "ground"

    @property
    def x(self) -> Coordinate:
        """0"""
        return Coordinate("0", "", "ground_coord")

    @property
    def y(self) -> Coordinate:
        """0"""
        return Coordinate("1", "", "ground_coord")

    @property
    def theta(self) -> Coordinate:
        """0"""
        return Coordinate("2", "", "ground_coord")


Handle = Union[PlanarBody, SpatialBody, Ground]
PlanarLike = Union[PlanarBody, Ground]
SpatialLike = Union[SpatialBody, Ground]
CoordinateLike = Coordinate

ground = Ground()

_KINDS: dict[str, tuple[Any, str]] = {
    "Planar": (PlanarBody, "planar"),
    "Spatial": (SpatialBody, "spatial"),
    "Coord": (Coordinate, "coord"),
}


def place_of(constraint: str, argument: str, kind: str, value: Any) -> tuple[str, Optional[str], str]:
    """Returns the kind, name and mechanism of a body or coordinate that an argument requires."""
    known, short = _KINDS[kind]
    if isinstance(value, Ground) and kind != "Coord":
        return short, None, ""
    if not isinstance(value, known):
        wanted = {"Planar": "a planar body", "Spatial": "a spatial body", "Coord": "a coordinate"}[kind]
        raise TypeError(f"`{constraint}`: its argument `{argument}` is {wanted}, not {value!r}")
    return (value._kind if kind == "Coord" else short), value.name, value._of
