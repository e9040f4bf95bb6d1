"""Loads of spatial bodies.

Made from docs/library.md by `python tools/library.py`; do not edit.
"""

from __future__ import annotations

from ._dimension import NumberLike
from ._handles import SpatialLike
from ._joint import AxisLike, EulerLike, Joint, Vec3Like, joint
from ._load import Load, of_library


def length(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like) -> Joint:
    """Returns the distance of two points, |r_Pi − r_Pj|, as a length along which a load can act. [m] `u_i` and
    `u_j` are the local positions of the points in body i and body j [m]. If the points coincide, the
    distance has no derivative. Signs: a positive force along the distance pushes the points apart.
    """
    return joint("length", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j", "Vec3",
        u_j)])


def spring(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    stiffness: NumberLike,
    free: NumberLike,
) -> Load:
    """Acts as a spring between two points: V = ½ k (|r_Pi − r_Pj| − l0)². [J] `u_i` and `u_j` are the local
    positions of the points in body i and body j [m]. `stiffness` is k [N/m]. `free` is l0, the length
    without force [m]. Shabana, Computational Dynamics, section 5.2. Signs: a spring longer than l0 pulls
    the points together.
    """
    return of_library("spring", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("stiffness", "f64", stiffness), ("free", "f64", free)])


def slide(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like, h_j: AxisLike) -> Joint:
    """Returns the displacement of P_i along a direction of body j, h_j · (r_Pi − r_Pj), as a length along
    which a load can act. [m] `u_i` and `u_j` are the local positions of the points in body i and body j
    [m]. `h_j` is the direction in body j, such as the axis of a cylinder. Signs: a positive force along the
    displacement pushes P_i along h_j and body j in the opposite direction.
    """
    return joint("slide", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j", "Vec3",
        u_j), ("h_j", "Axis", h_j)])


def turn(i: SpatialLike, j: SpatialLike, h_i: AxisLike, h_j: AxisLike) -> Joint:
    """Returns the angle of body i relative to body j about an axis, from f_j to f_i, as an angle along which a
    load can act. [rad] `h_i` and `h_j` are the common axis in body i and body j. A joint must keep both
    axes parallel. The angle is between −π and π. For a spring that turns further, use a separate coordinate
    (`spatial.relative_angle`). Signs: a positive torque along the angle turns i right-handed about h_j, and
    j in the opposite direction.
    """
    return joint("turn", [("i", "Spatial", i), ("j", "Spatial", j), ("h_i", "Axis", h_i), ("h_j", "Axis",
        h_j)])


def torsion_spring(
    i: SpatialLike,
    j: SpatialLike,
    h_i: AxisLike,
    h_j: AxisLike,
    stiffness: NumberLike,
    free: NumberLike,
) -> Load:
    """Acts as a torsion spring about an axis: V = ½ k (φ − φ0)², where φ is the angle of i relative to j. [J]
    `h_i` and `h_j` are the common axis in body i and body j. `stiffness` is k [N m/rad]. `free` is φ0
    [rad]. Kin uses the value of φ − φ0 between −π and π. Signs: the spring turns body i back towards the
    angle φ0.
    """
    return of_library("torsion_spring", [("i", "Spatial", i), ("j", "Spatial", j), ("h_i", "Axis", h_i),
        ("h_j", "Axis", h_j), ("stiffness", "f64", stiffness), ("free", "f64", free)])


def bushing(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    p_j: EulerLike,
    stiffness: Vec3Like,
    torsion: Vec3Like,
) -> Load:
    """Acts as an elastic bushing: V = ½ Σ k d² + 2 Σ κ e², where d is the vector from P_j to P_i in the frame
    of j and e the rotation of i. [J] The vector e is the vector part of the Euler parameters of i relative
    to j; for small rotations 2 e is the rotation vector. `u_i` and `u_j` are the local positions of the
    points in body i and body j [m]. `p_j` are the Euler parameters of i relative to j without torque.
    `stiffness` is k along the axes of j [N/m]. `torsion` is κ about the axes of j [N m/rad]. Signs: the
    bushing pulls P_i back to P_j and turns i back to the orientation `p_j`.
    """
    return of_library("bushing", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("p_j", "EulerParameters", p_j), ("stiffness", "Vec3", stiffness), ("torsion", "Vec3",
        torsion)])


def small_turn(i: SpatialLike, j: SpatialLike, p_j: EulerLike, h_j: AxisLike) -> Joint:
    """Returns a component of a small rotation of body i in body j, 2 e · h_j, as an angle along which a load
    can act. [rad] The vector e is the vector part of the Euler parameters of i relative to j. `p_j` are the
    Euler parameters of i relative to j where the angle is zero. `h_j` is the direction in body j. Signs: a
    positive torque along the angle turns i right-handed about h_j, and j in the opposite direction.
    """
    return joint("small_turn", [("i", "Spatial", i), ("j", "Spatial", j), ("p_j", "EulerParameters", p_j),
        ("h_j", "Axis", h_j)])
