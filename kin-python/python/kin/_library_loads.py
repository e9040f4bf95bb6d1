"""Loads of planar bodies and coordinates.

Made from docs/library.md by `python tools/library.py`; do not edit.
"""

from __future__ import annotations

from ._dimension import NumberLike
from ._handles import CoordinateLike, PlanarLike
from ._joint import Joint, LawLike, Vec2Like, joint
from ._load import FORCED, Along, Load, along_library, of_library


def length(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like) -> Joint:
    """Returns the distance of two points, |r_Pi − r_Pj|, as a length along which a load can act. [m] `u_i` and
    `u_j` are the local positions of the points in body i and body j [m]. If the points coincide, the
    distance has no derivative. Signs: a positive force along the distance pushes the points apart.
    """
    return joint("length", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j", "Vec2",
        u_j)])


def turn(i: PlanarLike, j: PlanarLike) -> Joint:
    """Returns the angle of body i relative to body j, θ_i − θ_j, as an angle along which a load can act. [rad]
    Signs: a positive torque along the angle turns i counter-clockwise and j clockwise.
    """
    return joint("turn", [("i", "Planar", i), ("j", "Planar", j)])


def slide(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like, h_j: Vec2Like) -> Joint:
    """Returns the displacement of P_i along a direction of body j, h_j · (Aⱼᵀ(r_Pi − r_j) − ū_j)/|h_j|, as a
    length along which a load can act. [m] `u_i` and `u_j` are the local positions of the points in body i
    and body j [m]. `h_j` is the direction in body j, such as the axis of a cylinder. Signs: a positive
    force along the displacement pushes P_i along h_j and body j in the opposite direction.
    """
    return joint("slide", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j", "Vec2",
        u_j), ("h_j", "Vec2", h_j)])


def along(q: CoordinateLike) -> Joint:
    """Returns the coordinate q itself as a length or angle along which a load can act. [unit of q] Signs: a
    positive force or torque increases q.
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
    """Acts as a spring between two points: V = ½ k (|r_Pi − r_Pj| − l0)². [J] `u_i` and `u_j` are the local
    positions of the points in body i and body j [m]. `stiffness` is k [N/m]. `free` is l0, the length
    without force [m]. Shabana, Computational Dynamics, section 5.2. Signs: a spring longer than l0 pulls
    the points together.
    """
    return of_library("spring", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j",
        "Vec2", u_j), ("stiffness", "f64", stiffness), ("free", "f64", free)])


def torsion_spring(i: PlanarLike, j: PlanarLike, stiffness: NumberLike, free: NumberLike) -> Load:
    """Acts as a torsion spring between two bodies: V = ½ k (θ_i − θ_j − θ0)². [J] `stiffness` is k [N m/rad].
    `free` is θ0, the angle of i relative to j without torque [rad]. Signs: the spring turns body i back
    towards the angle θ0.
    """
    return of_library("torsion_spring", [("i", "Planar", i), ("j", "Planar", j), ("stiffness", "f64",
        stiffness), ("free", "f64", free)])


def coordinate_spring(q: CoordinateLike, stiffness: NumberLike, free: NumberLike) -> Load:
    """Acts as a spring along a coordinate: V = ½ k (q − q0)². [J] `stiffness` is k [N/m or N m/rad]. `free` is
    q0, the coordinate without force [unit of q]. Signs: the spring pulls the coordinate back towards q0.
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
    """Acts as an elastic bushing: V = ½ (k_x d_x² + k_y d_y² + k_θ φ²) with φ = θ_i − θ_j − θ0, where d is the
    vector from P_j to P_i in the frame of j. [J] `u_i` and `u_j` are the local positions of the points in
    body i and body j [m]. `stiffness` is (k_x, k_y) [N/m]. `torsion` is k_θ [N m/rad]. `free` is θ0, the
    angle without torque [rad]. Signs: the bushing pulls P_i back to P_j and turns i back to θ0.
    """
    return of_library("bushing", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j",
        "Vec2", u_j), ("stiffness", "Vec2", stiffness), ("torsion", "f64", torsion), ("free", "f64", free)])


def spring_damper(x: Along, stiffness: NumberLike, free: NumberLike, damping: NumberLike) -> Load:
    """Acts as a spring and a damper along x: f = −k (x − x0) − c ẋ. [N, N m] `x` is any length or angle.
    `stiffness` is k [N/m or N m/rad]. `free` is x0, the length or angle without force. `damping` is c [N
    s/m or N m s]. Signs: the spring pulls x back towards x0, and the damper acts against ẋ.
    """
    return along_library("spring_damper", x, [("x", "Coord", FORCED), ("stiffness", "f64", stiffness),
        ("free", "f64", free), ("damping", "f64", damping)])


def viscous(x: Along, damping: NumberLike) -> Load:
    """Acts as a damper along x: f = −c ẋ. [N, N m] `x` is any length or angle. `damping` is c [N s/m or N m
    s]. Signs: the force acts against ẋ.
    """
    return along_library("viscous", x, [("x", "Coord", FORCED), ("damping", "f64", damping)])


def force_by(x: Along, law: LawLike) -> Load:
    """Applies a force that depends on x, such as a measured characteristic: f = F(x). [N, N m] `x` is any
    length or angle. `law` is F, a law of x. Signs: a positive force increases x.
    """
    return along_library("force_by", x, [("x", "Coord", FORCED), ("law", "Law", law)])


def force_in_time(x: Along, law: LawLike) -> Load:
    """Applies a force along x that depends on time: f = F(t). [N, N m] `x` is any length or angle. `law` is F,
    a law of t. Signs: a positive force increases x.
    """
    return along_library("force_in_time", x, [("x", "Coord", FORCED), ("law", "Law", law)])


def pressure(x: Along, table: LawLike, area: NumberLike) -> Load:
    """Applies the pressure in a cylinder along the length of its chamber: f = p(x) A. [N] `x` is the length of
    the chamber [m]. `table` is p as a law of the length of the chamber, such as `Law.spline` of an
    indicator diagram [Pa]. `area` is the area A of the piston [m²]. Signs: a positive p pushes the chamber
    to a greater length; p is the pressure above the outside pressure.
    """
    return along_library("pressure", x, [("x", "Coord", FORCED), ("table", "Law", table), ("area", "f64",
        area)])


def gas(x: Along, push: NumberLike, there: NumberLike, column: NumberLike, exponent: NumberLike) -> Load:
    """Acts as the gas in a closed chamber along a length x: f = F (a/(a + x − x0))ⁿ. [N] `push` is F, the
    force at x0 [N]. `there` is x0 [m]. `column` is a, the length of the column of gas at x0 [m]. `exponent`
    is n of the gas: 1 for slow, 1.4 for fast changes. Signs: a positive F increases x.
    """
    return along_library("gas", x, [("x", "Coord", FORCED), ("push", "f64", push), ("there", "f64", there),
        ("column", "f64", column), ("exponent", "f64", exponent)])
