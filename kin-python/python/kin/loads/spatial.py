"""The library of loads of spatial bodies, `kin.loads.spatial.spring(…)`."""

from __future__ import annotations

from typing import Sequence

from .._dimension import NumberLike
from .._handles import SpatialLike
from .._joint import EulerLike, LawLike, Vec3Like
from .._library_loads import force_by, viscous
from .._library_spatial_loads import bushing, length, slide, small_turn, spring, torsion_spring, turn
from .._load import Load

_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def damper(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like, damping: NumberLike) -> Load:
    """A damper between two points: the force −c d|r_Pi − r_Pj|/dt along the line, apart positive.   [N s/m]"""
    return viscous(length(i, j, u_i, u_j), damping)


def strut(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like, force: LawLike) -> Load:
    """A strut or cylinder between two points whose force is a law of its length: positive pushes the points apart.   [N]"""
    return force_by(length(i, j, u_i, u_j), force)


def damped_bushing(
    i: SpatialLike,
    j: SpatialLike,
    u: Sequence[Vec3Like],
    p_j: EulerLike,
    stiffness: Sequence[Sequence[NumberLike]],
    damping: Sequence[Sequence[NumberLike]],
) -> Load:
    """A bushing with damping: the energy of `bushing`, and dampers along its way and its turns. `u`: P_i and P_j; `p_j`: the Euler
    parameters of i in j without torque; `stiffness`, `damping`: along the axes of body j, then about them.   [N, N m]"""
    (u_i, u_j), (along, about) = u, damping
    load = bushing(i, j, u_i, u_j, p_j, stiffness[0], stiffness[1])
    for axis, c, turned in zip(_AXES, along, about):
        load += viscous(slide(i, j, u_i, u_j, axis), c) + viscous(small_turn(i, j, p_j, axis), turned)
    return load


__all__ = [
    "bushing",
    "damped_bushing",
    "damper",
    "length",
    "slide",
    "small_turn",
    "spring",
    "strut",
    "torsion_spring",
    "turn",
]
