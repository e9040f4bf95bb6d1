"""Computes masses of bodies: mass, centre and inertia, from numbers or from shapes with a density."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Sequence

from . import _native
from ._values import euler_of, flat, items
from ._vectors import VectorLike

Mass = tuple[float, tuple[float, ...], tuple[tuple[float, ...], ...]]


@dataclass(frozen=True)
class Solid:
    """The mass, the centre of mass in the body frame, and the inertia about the centre of mass in the axes of the body.
    [kg, m, kg m²]

    The products of inertia have the sign of J = ∫ (r² I − r rᵀ) dm. A planar body uses only J_zz.
    """

    mass: float
    centre: tuple[float, ...]
    inertia: tuple[tuple[float, ...], ...]

    #: Densities, in kilogram and metre.   [kg/m³]
    STEEL = 7850.0
    ALUMINIUM = 2700.0

    @staticmethod
    def _shape(shape: str, sizes: Sequence[float], density: float) -> "Solid":
        return _solid(_native.solid_of(shape, sizes, density))

    @staticmethod
    def cuboid(a: float, b: float, c: float, density: float) -> "Solid":
        """Creates a box with these sizes along x, y and z and its centre at the origin: J_xx = m (b² + c²)/12. [m,
        kg/m³]
        """
        return Solid._shape("cuboid", [a, b, c], density)

    @staticmethod
    def bar(length: float, height: float, width: float, density: float) -> "Solid":
        """Creates a bar along x with its centre at the origin, like the frame of a link. [m, kg/m³]"""
        return Solid._shape("cuboid", [length, height, width], density)

    @staticmethod
    def cylinder(radius: float, length: float, density: float) -> "Solid":
        """Creates a cylinder along x with its centre at the origin: J_xx = m r²/2, J_yy = J_zz = m (3 r² + l²)/12. [m,
        kg/m³]
        """
        return Solid._shape("cylinder", [radius, length], density)

    @staticmethod
    def disc(radius: float, thickness: float, density: float) -> "Solid":
        """Creates a disc in the xy-plane with its axis along z and its centre at the origin. [m, kg/m³]"""
        return Solid._shape("disc", [radius, thickness], density)

    @staticmethod
    def sphere(radius: float, density: float) -> "Solid":
        """Creates a ball with its centre at the origin: J = 2/5 m r². [m, kg/m³]"""
        return Solid._shape("sphere", [radius], density)

    @staticmethod
    def plate(corners: Any, thickness: float, density: float) -> "Solid":
        """Creates a plate from the corners of its outline in the xy-plane, with z = 0 in its middle. [m, kg/m³]

        The corners are in order, in either direction.
        """
        return Solid._shape("plate", [thickness, *flat(corners)], density)

    def at(self, centre: VectorLike) -> "Solid":
        """Moves the solid so that its centre of mass is at another point of the body. [m]"""
        return Solid(self.mass, tuple(in_space(flat(centre))), self.inertia)

    def turned(self, p: Any) -> "Solid":
        """Rotates the solid about the origin of the body by Euler parameters: c̄ → A c̄, J → A J Aᵀ."""
        return _solid(_native.solid_turned(self._tuple(), euler_of(p)))

    def and_(self, other: "Solid") -> "Solid":
        """Joins two solids to one solid."""
        return _solid(_native.solid_joined(self._tuple(), other._tuple(), False))

    def without(self, hole: "Solid") -> "Solid":
        """Cuts another solid out of this solid."""
        return _solid(_native.solid_joined(self._tuple(), hole._tuple(), True))

    def _tuple(self) -> Mass:
        return self.mass, self.centre, self.inertia


def _solid(made: tuple[float, list[float], list[list[float]]]) -> Solid:
    return Solid(made[0], tuple(made[1]), tuple(tuple(row) for row in made[2]))


def in_space(vector: Any) -> list[Any]:
    """Converts a vector of the plane or of space to a vector of space."""
    found = items(vector)
    if len(found) not in (2, 3):
        raise TypeError(f"a vector has two or three components, not {len(found)}")
    return found + [0.0] * (3 - len(found))


def inertia_of(inertia: Any, in_plane: bool) -> list[Any]:
    """Returns the inertia by rows: from a moment in the plane, or from a tensor or its diagonal in space."""
    found = items(inertia)
    if in_plane and len(found) == 1:
        return [0.0] * 8 + found
    if not in_plane and len(found) == 3:
        a, b, c = found
        return [a, 0.0, 0.0, 0.0, b, 0.0, 0.0, 0.0, c]
    if not in_plane and len(found) == 9:
        return found
    wanted = "one moment about its centre" if in_plane else "a tensor of three rows, or its diagonal"
    raise TypeError(f"the inertia of a body in {'the plane' if in_plane else 'space'} is {wanted}, not {inertia!r}")
