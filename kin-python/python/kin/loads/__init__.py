"""The library of loads: springs, dampers, struts, and lengths and angles to act along, of planar bodies and coordinates; those of
spatial bodies are in `kin.loads.spatial`. A load acts on both of its bodies, and on the ground where one of them is that.

    m.load("closer", kin.loads.spring(door, m.ground, door.end, (0, 0.3), stiffness=80.0, free=0.4))
"""

from __future__ import annotations

from typing import Sequence

from .._dimension import NumberLike
from .._handles import CoordinateLike, PlanarLike
from .._joint import LawLike, Vec2Like
from .._library_loads import (
    along,
    bushing,
    coordinate_spring,
    force_by,
    force_in_time,
    gas,
    length,
    pressure,
    slide,
    spring,
    spring_damper,
    torsion_spring,
    turn,
    viscous,
)
from .._load import Load
from . import spatial


def damper(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like, damping: NumberLike) -> Load:
    """A damper between two points: the force −c d|r_Pi − r_Pj|/dt along the line, apart positive.   [N s/m]"""
    return viscous(length(i, j, u_i, u_j), damping)


def torsion_damper(i: PlanarLike, j: PlanarLike, damping: NumberLike) -> Load:
    """A damper between two bodies that turn: the torque −c (θ̇_i − θ̇_j) on body i.   [N m s]"""
    return viscous(turn(i, j), damping)


def damped_bushing(
    i: PlanarLike,
    j: PlanarLike,
    u: Sequence[Vec2Like],
    stiffness: Sequence[NumberLike],
    damping: Sequence[NumberLike],
    free: NumberLike,
) -> Load:
    """A bushing with damping: the energy of `bushing`, and −c_x ḋ_x, −c_y ḋ_y, −c_θ φ̇ along the same way and turn. `u`: P_i and
    P_j; `stiffness`, `damping`: along x and y of body j and about z; `free`: θ0.   [N, N m]"""
    (u_i, u_j), (k_x, k_y, k_turn) = u, stiffness
    elastic = bushing(i, j, u_i, u_j, (k_x, k_y), k_turn, free)
    lengths = slide(i, j, u_i, u_j, (1.0, 0.0)), slide(i, j, u_i, u_j, (0.0, 1.0)), turn(i, j)
    return sum((viscous(x, c) for x, c in zip(lengths, damping)), elastic)


def force_along(q: CoordinateLike, force: LawLike) -> Load:
    """A force or torque along a coordinate, by a law of time.   [N, N m]"""
    return force_in_time(along(q), force)


def strut(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like, force: LawLike) -> Load:
    """A strut or cylinder between two points whose force is a law of its length, such as a table of pressures times the area of
    its piston: positive pushes the points apart.   [N]"""
    return force_by(length(i, j, u_i, u_j), force)


def gas_spring(
    i: PlanarLike,
    j: PlanarLike,
    u: Sequence[Vec2Like],
    force: NumberLike,
    lengths: Sequence[NumberLike],
    exponent: NumberLike,
) -> Load:
    """A gas spring between two points, `u`: it pushes them apart with F (a/(a − (l0 − l)))ⁿ, F being its `force` at the length l0,
    a the length of its column of gas there, `lengths` both, n the exponent of the gas (1 slow, 1.4 fast).   [N, m]"""
    (u_i, u_j), (there, column) = u, lengths
    return gas(length(i, j, u_i, u_j), force, there, column, exponent)


__all__ = [
    "along",
    "bushing",
    "coordinate_spring",
    "damped_bushing",
    "damper",
    "force_along",
    "force_by",
    "force_in_time",
    "gas",
    "gas_spring",
    "length",
    "pressure",
    "slide",
    "spatial",
    "spring",
    "spring_damper",
    "strut",
    "torsion_damper",
    "torsion_spring",
    "turn",
    "viscous",
]
