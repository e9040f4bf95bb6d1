"""Loads of planar bodies and coordinates.

Made from docs/library.md by `python tools/library.py`; do not edit.
"""

from __future__ import annotations

from ._dimension import NumberLike
from ._handles import CoordinateLike, PlanarLike
from ._joint import Joint, LawLike, Vec2Like, joint
from ._load import FORCED, Along, Load, along_library, of_library


def length(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like) -> Joint:
    """The distance of two points, |r_Pi − r_Pj|: a length to act along. [m] `u_i`, `u_j`: the points. Where
    they meet it has no slope. Signs: none; a force along it pushes the points apart.
    """
    return joint("length", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j", "Vec2",
        u_j)])


def turn(i: PlanarLike, j: PlanarLike) -> Joint:
    """The turn of body i in body j, θ_i − θ_j: an angle to act along. [rad] Signs: a torque along it turns i
    counter-clockwise, and j the other way.
    """
    return joint("turn", [("i", "Planar", i), ("j", "Planar", j)])


def slide(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like, h_j: Vec2Like) -> Joint:
    """How far P_i is along a direction of body j: h_j · (Aⱼᵀ(r_Pi − r_j) − ū_j)/|h_j|, a length to act along.
    [m] `u_i`, `u_j`: the points; `h_j`: the direction in body j, such as the axis of a cylinder. Signs: a
    force along it pushes P_i along h_j, and j the other way.
    """
    return joint("slide", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j", "Vec2",
        u_j), ("h_j", "Vec2", h_j)])


def along(q: CoordinateLike) -> Joint:
    """The coordinate itself, to act along. [unit of q] Signs: those of the coordinate.
    """
    return joint("along", [("q", "Coord", q)])


def spring(
    i: PlanarLike,
    j: PlanarLike,
    u_i: Vec2Like,
    u_j: Vec2Like,
    stiffness: NumberLike,
    free: NumberLike,
) -> Load:
    """A spring between two points: V = ½ k (|r_Pi − r_Pj| − l0)². [J] `u_i`, `u_j`: the points; `stiffness`:
    k, `free`: l0, its length without force. Shabana, Computational Dynamics, section 5.2. Signs: longer
    than l0 it pulls the points together.
    """
    return of_library("spring", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j",
        "Vec2", u_j), ("stiffness", "f64", stiffness), ("free", "f64", free)])


def torsion_spring(i: PlanarLike, j: PlanarLike, stiffness: NumberLike, free: NumberLike) -> Load:
    """A torsion spring between two bodies: V = ½ k (θ_i − θ_j − θ0)². [J] `stiffness`: k, `free`: θ0, the turn
    of i in j without torque. Signs: turned beyond θ0, body i is turned back.
    """
    return of_library("torsion_spring", [("i", "Planar", i), ("j", "Planar", j), ("stiffness", "f64",
        stiffness), ("free", "f64", free)])


def coordinate_spring(q: CoordinateLike, stiffness: NumberLike, free: NumberLike) -> Load:
    """A spring along a coordinate: V = ½ k (q − q0)². [J] `stiffness`: k, `free`: q0. Signs: beyond q0 it
    pulls back.
    """
    return of_library("coordinate_spring", [("q", "Coord", q), ("stiffness", "f64", stiffness), ("free",
        "f64", free)])


def bushing(
    i: PlanarLike,
    j: PlanarLike,
    u_i: Vec2Like,
    u_j: Vec2Like,
    stiffness: Vec2Like,
    torsion: NumberLike,
    free: NumberLike,
) -> Load:
    """An elastic bushing: V = ½ (k_x d_x² + k_y d_y² + k_θ φ²), d the way from P_j to P_i as body j sees it, φ
    = θ_i − θ_j − θ0. [J] `u_i`, `u_j`: the points; `stiffness`: (k_x, k_y), `torsion`: k_θ, `free`: θ0.
    Signs: it pulls P_i back to P_j and turns i back.
    """
    return of_library("bushing", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j",
        "Vec2", u_j), ("stiffness", "Vec2", stiffness), ("torsion", "f64", torsion), ("free", "f64", free)])


def spring_damper(x: Along, stiffness: NumberLike, free: NumberLike, damping: NumberLike) -> Load:
    """A spring and a damper along x: f = −k (x − x0) − c ẋ. [N, N m] `x`: any length or angle; `stiffness`: k,
    `free`: x0, `damping`: c. Signs: beyond x0 it pulls back.
    """
    return along_library("spring_damper", x, [("x", "Coord", FORCED), ("stiffness", "f64", stiffness),
        ("free", "f64", free), ("damping", "f64", damping)])


def viscous(x: Along, damping: NumberLike) -> Load:
    """A damper along x: f = −c ẋ. [N, N m] `x`: any length or angle; `damping`: c. Signs: against ẋ.
    """
    return along_library("viscous", x, [("x", "Coord", FORCED), ("damping", "f64", damping)])


def force_by(x: Along, law: LawLike) -> Load:
    """A force by x, such as a measured characteristic: f = F(x). [N, N m] `x`: any length or angle; `law`: F,
    a law of x. Signs: positive pushes the way x grows.
    """
    return along_library("force_by", x, [("x", "Coord", FORCED), ("law", "Law", law)])


def force_in_time(x: Along, law: LawLike) -> Load:
    """A force by time along x: f = F(t). [N, N m] `x`: any length or angle; `law`: F, a law of t. Signs:
    positive pushes the way x grows.
    """
    return along_library("force_in_time", x, [("x", "Coord", FORCED), ("law", "Law", law)])


def pressure(x: Along, table: LawLike, area: NumberLike) -> Load:
    """Pressure in a cylinder along the length of its chamber: f = p(x) A. [N] `x`: the length of the chamber;
    `table`: p by that length, such as `Law.spline` of an indicator diagram [Pa]; `area`: A of the piston
    [m²]. Signs: pressure above that outside makes the chamber longer.
    """
    return along_library("pressure", x, [("x", "Coord", FORCED), ("table", "Law", table), ("area", "f64",
        area)])


def gas(x: Along, push: NumberLike, there: NumberLike, column: NumberLike, exponent: NumberLike) -> Load:
    """The gas in a closed chamber along a length x: f = F (a/(a + x − x0))ⁿ. [N] `push`: F, its force at x0 =
    `there`; `column`: a, the length of the column of gas there; `exponent`: n of the gas, 1 slow, 1.4 fast.
    Signs: F above zero makes x longer.
    """
    return along_library("gas", x, [("x", "Coord", FORCED), ("push", "f64", push), ("there", "f64", there),
        ("column", "f64", column), ("exponent", "f64", exponent)])
