"""Loads of spatial bodies.

Made from docs/library.md by `python tools/library.py`; do not edit.
"""

from __future__ import annotations

from ._dimension import NumberLike
from ._handles import SpatialLike
from ._joint import AxisLike, EulerLike, Joint, Vec3Like, joint
from ._load import Load, of_library


def length(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like) -> Joint:
    """The distance of two points, |r_Pi − r_Pj|: a length to act along. [m] `u_i`, `u_j`: the points. Where
    they meet it has no slope. Signs: none; a force along it pushes the points apart.
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
    """A spring between two points: V = ½ k (|r_Pi − r_Pj| − l0)². [J] `u_i`, `u_j`: the points; `stiffness`:
    k, `free`: l0, its length without force. Shabana, Computational Dynamics, section 5.2. Signs: longer
    than l0 it pulls the points together.
    """
    return of_library("spring", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("stiffness", "f64", stiffness), ("free", "f64", free)])


def slide(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like, h_j: AxisLike) -> Joint:
    """How far P_i is along a direction of body j: h_j · (r_Pi − r_Pj), a length to act along. [m] `u_i`,
    `u_j`: the points; `h_j`: the direction in body j, such as the axis of a cylinder. Signs: a force along
    it pushes P_i along h_j, and j the other way.
    """
    return joint("slide", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j", "Vec3",
        u_j), ("h_j", "Axis", h_j)])


def turn(i: SpatialLike, j: SpatialLike, h_i: AxisLike, h_j: AxisLike) -> Joint:
    """The turn of body i in body j about an axis, from f_j to f_i: an angle to act along. [rad] `h_i`, `h_j`:
    the common axis in either body, held parallel by a joint. Between −π and π: a spring that is wound
    further belongs on a separate coordinate (`spatial.relative_angle`). Signs: a torque along it turns i
    right-handed about h_j, and j the other way.
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
    """A torsion spring about an axis: V = ½ k (φ − φ0)², φ the turn of i in j. [J] `h_i`, `h_j`: the common
    axis in either body; `stiffness`: k, `free`: φ0. It is wound by π at most to either side. Signs: turned
    beyond φ0, body i is turned back.
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
    """An elastic bushing: V = ½ Σ k d² + 2 Σ κ e², d the way from P_j to P_i as body j sees it, e the vector
    part of the Euler parameters of i in j; for small turns 2 e is the turn. [J] `u_i`, `u_j`: the points;
    `p_j`: the Euler parameters of i in j without torque; `stiffness`: k along the axes of j [N/m],
    `torsion`: κ about them [N m/rad]. Signs: it pulls P_i back to P_j and turns i back.
    """
    return of_library("bushing", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("p_j", "EulerParameters", p_j), ("stiffness", "Vec3", stiffness), ("torsion", "Vec3",
        torsion)])


def small_turn(i: SpatialLike, j: SpatialLike, p_j: EulerLike, h_j: AxisLike) -> Joint:
    """A component of the turn of body i in body j: 2 e · h_j, an angle to act along where it is small. [rad]
    `p_j`: the Euler parameters of i in j where it is zero, `h_j`: the direction in body j. Signs: a torque
    along it turns i right-handed about h_j, and j the other way.
    """
    return joint("small_turn", [("i", "Spatial", i), ("j", "Spatial", j), ("p_j", "EulerParameters", p_j),
        ("h_j", "Axis", h_j)])
