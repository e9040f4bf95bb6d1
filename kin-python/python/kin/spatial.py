"""Joints, couplings and drivers of spatial bodies.

Made from docs/library.md by `python tools/library.py`; do not edit.
"""

from __future__ import annotations

from typing import Sequence

from ._dimension import NumberLike
from ._handles import CoordinateLike, PlanarLike, SpatialLike
from ._joint import AxisLike, EulerLike, Joint, LawLike, Vec2Like, Vec3Like, joint


def spherical(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like) -> Joint:
    """Ball joint: point P is common to both bodies, R_i + A_i ū_i − R_j − A_j ū_j = 0. [m]

    Removes 3 freedoms. `u_i`, `u_j`: local position of P in either body. As a primitive it is called at-
    point. Lecture, "Spherical Joint Constraint". Signs: none; the rows are global components of the way
    from P_j to P_i.
    """
    return joint("spherical", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j)])


def distance(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like, length: NumberLike) -> Joint:
    """Rod without mass between two balls: (|r_Pi − r_Pj|² − l²)/(2 l) = 0. [m]

    Removes 1 freedom. `u_i`, `u_j`: the balls; a rod between a ball and a universal joint has the same
    equation. Near the solution this is |r_Pi − r_Pj| − l, but it has no singular slope where the points
    meet. Haug, section 9.4. Signs: none; `length` is above zero, and the rod may point anywhere.
    """
    return joint("distance", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("length", "f64", length)])


def point_on_line(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like, h_j: AxisLike) -> Joint:
    """Ball on a line: f_j · d = g_j · d = 0 with d = r_Pi − r_Pj. [m, m]

    Removes 2 freedoms. `u_i`: the ball; `u_j`: a point of the line, `h_j`: its direction; f_j and g_j are
    across it. Haug, section 9.4. Measure: `slide`, h_j · d. Signs: the slide grows as i moves along h_j in
    j.
    """
    return joint("point_on_line", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("h_j", "Axis", h_j)])


def point_in_plane(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like, h_j: Vec3Like) -> Joint:
    """Ball in a plane: h_j · (r_Pi − r_Pj) = 0. [m]

    Removes 1 freedom. `u_i`: the ball; `u_j`: a point of the plane, `h_j`: its normal, whose length scales
    the row. As a primitive it is called dot-2. Haug, section 9.4. Signs: the row is positive where the ball
    is on the side to which h_j points.
    """
    return joint("point_in_plane", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("h_j", "Vec3", h_j)])


def point_coordinate(body: SpatialLike, u: Vec3Like, n: Vec3Like, value: NumberLike) -> Joint:
    """One coordinate of a point: n · r_P − c = 0. [m]

    Removes 1 freedom. `u`: local position of P; `n`: the global direction along which it is measured, whose
    length scales the row and `value`: c. Haug, section 9.4. Signs: c grows along `n`.
    """
    return joint("point_coordinate", [("body", "Spatial", body), ("u", "Vec3", u), ("n", "Vec3", n),
        ("value", "f64", value)])


def parallel(i: SpatialLike, j: SpatialLike, h_i: AxisLike, h_j: Vec3Like) -> Joint:
    """Parallel axes: f_i · h_j = g_i · h_j = 0. [–, –]

    Removes 2 freedoms. `h_i`, `h_j`: the axes; f_i and g_i are across h_i, the length of h_j scales the
    rows. The equations hold for opposite axes too; a position found with h_i · h_j < 0 is an error. Haug,
    section 9.4. Signs: h_i and h_j point the same way.
    """
    return joint("parallel", [("i", "Spatial", i), ("j", "Spatial", j), ("h_i", "Axis", h_i), ("h_j",
        "Vec3", h_j)])


def perpendicular(i: SpatialLike, j: SpatialLike, h_i: Vec3Like, h_j: Vec3Like) -> Joint:
    """Perpendicular directions: h_i · h_j = 0. [–]

    Removes 1 freedom. `h_i`, `h_j`: the directions, whose lengths scale the row. As a primitive it is
    called dot-1. Haug, section 9.4. Signs: the row is positive where the angle between h_i and h_j is less
    than 90°.
    """
    return joint("perpendicular", [("i", "Spatial", i), ("j", "Spatial", j), ("h_i", "Vec3", h_i), ("h_j",
        "Vec3", h_j)])


def angle(i: SpatialLike, j: SpatialLike, h_i: AxisLike, h_j: AxisLike, alpha: NumberLike) -> Joint:
    """Directions at an angle: h_i · h_j − cos α = 0. [–]

    Removes 1 freedom. `h_i`, `h_j`: the directions; `alpha`: the angle between them, strictly between 0 and
    π: at the ends the row has no slope, and `parallel` is meant. Haug, section 9.4. Signs: the angle has
    none: h_i may stand anywhere on a cone about h_j. The row is positive where it is less than α.
    """
    return joint("angle", [("i", "Spatial", i), ("j", "Spatial", j), ("h_i", "Axis", h_i), ("h_j", "Axis",
        h_j), ("alpha", "f64", alpha)])


def moving_point(
    i: SpatialLike,
    j: SpatialLike,
    x_i: LawLike,
    y_i: LawLike,
    z_i: LawLike,
    u_j: Vec3Like,
) -> Joint:
    """A point that moves in body i by laws of time is a point of body j: R_i + A_i ū_i(t) − R_j − A_j ū_j = 0.
    [m]

    Removes 3 freedoms. `x_i`, `y_i`, `z_i`: ū_i(t); `u_j`: local position in body j. Lecture, "Moving Point
    on Rigid Body". Signs: the laws are coordinates in the frame of body i.
    """
    return joint("moving_point", [("i", "Spatial", i), ("j", "Spatial", j), ("x_i", "Law", x_i), ("y_i",
        "Law", y_i), ("z_i", "Law", z_i), ("u_j", "Vec3", u_j)])


def point_on_path(
    i: SpatialLike,
    j: SpatialLike,
    s: CoordinateLike,
    x_i: LawLike,
    y_i: LawLike,
    z_i: LawLike,
    u_j: Vec3Like,
) -> Joint:
    """A point that moves along a path in body i is a point of body j: R_i + A_i ū_i(s) − R_j − A_j ū_j = 0.
    [m]

    Removes 3 freedoms and adds one, the coordinate `s` along the path: 2 in all. `x_i`, `y_i`, `z_i`:
    ū_i(s); `u_j`: local position in body j. Lecture, "Moving Point on Rigid Body". Signs: the laws are
    coordinates in the frame of body i; `s` grows the way they run.
    """
    return joint("point_on_path", [("i", "Spatial", i), ("j", "Spatial", j), ("s", "Coord", s), ("x_i",
        "Law", x_i), ("y_i", "Law", y_i), ("z_i", "Law", z_i), ("u_j", "Vec3", u_j)])


def fixed(j: SpatialLike, r: Vec3Like, p0: EulerLike) -> Joint:
    """A body that does not move: R − r = 0 and the vector part of p0 p is zero. [m, –]

    Removes 6 freedoms. `r`: position; `p0`: Euler parameters. There is no second solution: a turn by 180°
    has a vector part of length 1. Nikravesh, Computer-Aided Analysis of Mechanical Systems, section 7.2.
    Signs: `p0` turns the global frame into the body's; p0 and −p0 are one turn.
    """
    return joint("fixed", [("j", "Spatial", j), ("r", "Vec3", r), ("p0", "EulerParameters", p0)])


def weld(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like, p_ij: EulerLike) -> Joint:
    """Rigid connection: r_Pi − r_Pj = 0 and the vector part of p_ij p_j p_i is zero. [m, –]

    Removes 6 freedoms. `u_i`, `u_j`: local position of P in either body; `p_ij`: Euler parameters of body i
    as body j sees it. There is no second solution: a turn by 180° has a vector part of length 1. Nikravesh,
    Computer-Aided Analysis of Mechanical Systems, section 7.2. Signs: `p_ij` turns the frame of j into that
    of i.
    """
    return joint("weld", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j", "Vec3",
        u_j), ("p_ij", "EulerParameters", p_ij)])


def revolute(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    h_i: AxisLike,
    h_j: Vec3Like,
) -> Joint:
    """Hinge: r_Pi − r_Pj = 0 (at-point) and f_i · h_j = g_i · h_j = 0 (two dot-1). [m, –, –]

    Removes 5 freedoms. `u_i`, `u_j`: local position of P on the axis; `h_i`, `h_j`: the axis in either
    body. The equations hold for opposite axes too; a position found with h_i · h_j < 0 is an error. Haug,
    section 9.4. Measure: `angle`, the turn of f_i from f_j. Signs: the angle is the turn of i in j, right-
    handed about h_j. Where it is zero is chosen by `.zero(f_i, f_j)`: where f_i of body i lies along f_j of
    body j; unchosen these are the f that `Axis.along` gives h_i and h_j (x for z, y for x, z for y).
    """
    return joint("revolute", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("h_i", "Axis", h_i), ("h_j", "Vec3", h_j)])


def prismatic(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    h_i: AxisLike,
    p_ij: EulerLike,
) -> Joint:
    """Sliding joint: the vector part of p_ij p_j p_i is zero, and f_i · d = g_i · d = 0 (two dot-2) with d =
    r_Pi − r_Pj. [–, m, m]

    Removes 5 freedoms. `u_i`, `u_j`: points on the slide; `h_i`: its direction in body i; `p_ij`: Euler
    parameters of body i as body j sees it. There is no second solution. Haug, section 9.4. Measure:
    `slide`, h_i · d. Signs: the slide grows as i moves along h_i in j; `p_ij` turns the frame of j into
    that of i.
    """
    return joint("prismatic", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("h_i", "Axis", h_i), ("p_ij", "EulerParameters", p_ij)])


def cylindrical(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    h_i: AxisLike,
    h_j: Vec3Like,
) -> Joint:
    """Cylindrical joint: f_i · h_j = g_i · h_j = 0 (two dot-1) and f_i · d = g_i · d = 0 (two dot-2) with d =
    r_Pi − r_Pj. [–, –, m, m]

    Removes 4 freedoms. `u_i`, `u_j`: points on the axis; `h_i`, `h_j`: the axis in either body. These are
    h_i × h_j = 0 and h_i × d = 0 of the lecture ("Cylindrical Joint Constraint") in the two directions
    across h_i, which keep full rank at every pose. The equations hold for opposite axes too; a position
    found with h_i · h_j < 0 is an error. Measures: `angle`, the turn of f_i from f_j; `slide`, h_j · d.
    Signs: the angle is the turn of i in j, right-handed about h_j, its zero chosen as of `revolute`. The
    slide grows as i moves along h_j in j.
    """
    return joint("cylindrical", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("h_i", "Axis", h_i), ("h_j", "Vec3", h_j)])


def universal(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    h_i: Vec3Like,
    h_j: Vec3Like,
) -> Joint:
    """Universal joint: r_Pi − r_Pj = 0 (at-point) and h_i · h_j = 0 (dot-1). [m, –]

    Removes 4 freedoms. `u_i`, `u_j`: the centre P of the cross; `h_i`, `h_j`: the bars of the cross, each
    in the body that it turns in; their lengths scale the row. Lecture, "Universal Joint Constraint".
    Measures: `angle_j`, the turn of the cross in body j about h_j; `angle_i`, the turn of body i on the
    cross about h_i. Signs: both angles are right-handed about their bars, and zero where both frames have
    the same directions: body i is turned by `angle_i` about its bar, and then with the cross by `angle_j`
    about that of j. Bars that are not perpendicular as they are written: see `kin.Axis(h, f)`.
    """
    return joint("universal", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("h_i", "Vec3", h_i), ("h_j", "Vec3", h_j)])


def planar(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    h_i: AxisLike,
    h_j: Vec3Like,
) -> Joint:
    """Planar joint: f_i · h_j = g_i · h_j = 0 (two dot-1) and h_j · (r_Pi − r_Pj) = 0 (dot-2). [–, –, m]

    Removes 3 freedoms. `u_i`, `u_j`: points of the common plane; `h_i`, `h_j`: its normal in either body.
    The equations hold for opposite normals too; a position found with h_i · h_j < 0 is an error. Haug,
    section 9.4. Measure: `angle`, the turn of f_i from f_j. Signs: the angle is the turn of i in j, right-
    handed about h_j, its zero chosen as of `revolute`. The last row is positive where P_i is on the side to
    which h_j points.
    """
    return joint("planar", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j", "Vec3",
        u_j), ("h_i", "Axis", h_i), ("h_j", "Vec3", h_j)])


def screw(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    h_i: AxisLike,
    h_j: AxisLike,
    lead: NumberLike,
) -> Joint:
    """Screw: f_j · h_i = g_j · h_i = 0, f_j · d = g_j · d = 0 with d = r_Pi − r_Pj, and body i turns by 2π h_j
    · d / lead. [–, –, m, m, rad]

    Removes 5 freedoms. `u_i`, `u_j`: points on the axis; `h_i`, `h_j`: the axis in either body, with f_i
    over f_j where the points meet; `lead`: way of i along h_j per turn about h_j. The turn of f_i is taken
    back by 2π h_j · d / lead and what is left is zero, so that any number of turns is counted without a
    jump. The equations hold for opposite axes too; a position found with h_i · h_j < 0 is an error. Where
    another joint holds the axes in line: `thread`. Haug, section 9.4. Measures: `angle`, the turn of f_i
    from f_j; `slide`, h_j · d. Signs: the angle is the turn of i in j, right-handed about h_j; the slide
    grows as i moves along h_j in j; `lead` is above zero for a right-hand thread.
    """
    return joint("screw", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j", "Vec3",
        u_j), ("h_i", "Axis", h_i), ("h_j", "Axis", h_j), ("lead", "f64", lead)])


def constant_velocity(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    h_i: AxisLike,
    h_j: AxisLike,
) -> Joint:
    """Constant-velocity joint: r_Pi − r_Pj = 0 (at-point) and f_i · g_j − g_i · f_j = 0. [m, –]

    Removes 4 freedoms. `u_i`, `u_j`: the centre P; `h_i`, `h_j`: the shafts, with the same direction where
    they are in line, f_i over f_j. The second equation says that i is bent against j about an axis across
    the shafts, without twist: both turn by the same angle at every moment. It holds for shafts twisted by
    180° too; a position found with f_i · f_j + g_i · g_j < 0 is an error. Hunt, Kinematic Geometry of
    Mechanisms. Signs: h_i and h_j point the same way along the drive line, from one shaft to the other;
    then both turn the same way about them.
    """
    return joint("constant_velocity", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i),
        ("u_j", "Vec3", u_j), ("h_i", "Axis", h_i), ("h_j", "Axis", h_j)])


def relative_angle(
    i: SpatialLike,
    j: SpatialLike,
    phi: CoordinateLike,
    h_i: AxisLike,
    h_j: AxisLike,
) -> Joint:
    """A separate coordinate for the turn of body i in body j: the turn of f_i from f_j about h_j, taken back
    by φ, is zero. [rad]

    Removes 1 freedom and adds one, the coordinate `phi`, which counts any number of turns. `h_i`, `h_j`:
    the common axis in either body, held parallel by another joint; f_i and f_j are where the angle counts
    from. With it turns can be driven, and coupled by `coupling`. Haug, section 9.4. Signs: φ is the turn of
    i in j, right-handed about h_j, zero where f_i lies along f_j.
    """
    return joint("relative_angle", [("i", "Spatial", i), ("j", "Spatial", j), ("phi", "Coord", phi), ("h_i",
        "Axis", h_i), ("h_j", "Axis", h_j)])


def gear(
    i: SpatialLike,
    j: SpatialLike,
    frame: SpatialLike,
    h_i: AxisLike,
    h_j: AxisLike,
    a_i: AxisLike,
    a_j: AxisLike,
    teeth_i: NumberLike,
    teeth_j: NumberLike,
    phase: NumberLike,
) -> Joint:
    """Pair of gears on a frame: z_i φ_i + z_j φ_j − z_i φ0 = 0, up to whole teeth, φ the turns of the wheels
    in the frame. [rad]

    Removes 1 freedom. `i`, `j`: the wheels, each with its axis `h_i`, `h_j` and the same axis in the frame,
    `a_i`, `a_j`, held parallel by other joints; f is where a turn counts from. `teeth_i`, `teeth_j`: z,
    whole numbers, one below zero for a ring with inner teeth; `phase`: φ0, the turn of i when that of j is
    zero. A wheel looks the same after a whole turn, so the equation has no jump; which teeth mesh is
    decided by the first position. By radii: `gear_by_radii`. Norton, Design of Machinery, ch. 9. Signs:
    turns are right-handed about a_i and a_j. With axes that point out of the frame alike (from the apex of
    bevel gears) the wheels turn against each other.
    """
    return joint("gear", [("i", "Spatial", i), ("j", "Spatial", j), ("frame", "Spatial", frame), ("h_i",
        "Axis", h_i), ("h_j", "Axis", h_j), ("a_i", "Axis", a_i), ("a_j", "Axis", a_j), ("teeth_i", "f64",
        teeth_i), ("teeth_j", "f64", teeth_j), ("phase", "f64", phase)])


def gear_by_radii(
    i: SpatialLike,
    j: SpatialLike,
    frame: SpatialLike,
    s: CoordinateLike,
    h_i: AxisLike,
    h_j: AxisLike,
    a_i: AxisLike,
    a_j: AxisLike,
    r_i: NumberLike,
    r_j: NumberLike,
    phase: NumberLike,
) -> Joint:
    """Pair of gears on a frame by their radii: the turns of the wheels in the frame, taken back by φ0 + s/r_i
    and by −s/r_j, are zero. [rad, rad]

    Removes 2 freedoms and adds one, the length `s` that has rolled through the mesh: 1 in all. `i`, `j`:
    the wheels, each with its axis `h_i`, `h_j` and the same axis in the frame, `a_i`, `a_j`, held parallel
    by other joints; f is where a turn counts from. `r_i`, `r_j`: pitch radii (of bevel gears at the same
    distance from the apex, of friction wheels of any ratio), one below zero for a ring with inner teeth;
    `phase`: φ0, the turn of i when that of j is zero. `s` counts any number of turns, and can be driven.
    Norton, Design of Machinery, ch. 9. Signs: turns are right-handed about a_i and a_j; `s` grows with the
    turn of i. With axes that point out of the frame alike (from the apex of bevel gears) the wheels turn
    against each other.
    """
    return joint("gear_by_radii", [("i", "Spatial", i), ("j", "Spatial", j), ("frame", "Spatial", frame),
        ("s", "Coord", s), ("h_i", "Axis", h_i), ("h_j", "Axis", h_j), ("a_i", "Axis", a_i), ("a_j", "Axis",
        a_j), ("r_i", "f64", r_i), ("r_j", "f64", r_j), ("phase", "f64", phase)])


def thread(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    h_i: AxisLike,
    h_j: AxisLike,
    lead: NumberLike,
) -> Joint:
    """Thread: the turn of f_i from f_j about h_j, taken back by 2π h_j · (r_Pi − r_Pj)/lead, is zero. [rad]

    Removes 1 freedom: the one row that makes a `screw` of a cylindrical joint, or of a slide and a shaft
    that other joints hold. `u_i`, `u_j`: points on the axis; `h_i`, `h_j`: the axis in either body, held
    parallel by another joint, with f_i over f_j where the points meet; `lead`: way of i along h_j per turn
    about h_j. Any number of turns is counted. Haug, section 9.4. Angle and slide are measures of the joint
    that holds the axes. Signs: the turn is that of i in j, right-handed about h_j, the way is that of i
    along h_j in j; `lead` is above zero for a right-hand thread.
    """
    return joint("thread", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j", "Vec3",
        u_j), ("h_i", "Axis", h_i), ("h_j", "Axis", h_j), ("lead", "f64", lead)])


def rack_and_pinion(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    h_i: AxisLike,
    h_j: AxisLike,
    radius: NumberLike,
    phase: NumberLike,
) -> Joint:
    """Rack and pinion: the turn of the pinion in the rack about h_j, taken back by φ0 − f_j · (r_Pi − r_Pj)/r,
    is zero. [rad]

    Removes 1 freedom. `i`: the pinion, centre `u_i`, axis `h_i`, pitch radius `radius`: r; `j`: the rack, a
    point `u_j` of its pitch line and `h_j`, the direction of the pinion's axis with f_j along the rack
    (`kin.Axis(h, f)`); the axes are held parallel by other joints. `phase`: φ0, the turn of f_i from f_j
    where the centre stands over `u_j`. Haug, section 3.4, in space. Signs: the pinion is on the side of g_j
    = h_j × f_j (a negative radius: on the other) and turns clockwise about h_j as it goes along f_j.
    """
    return joint("rack_and_pinion", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("h_i", "Axis", h_i), ("h_j", "Axis", h_j), ("radius", "f64", radius), ("phase",
        "f64", phase)])


def revolute_spherical(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    h_i: Vec3Like,
    length: NumberLike,
) -> Joint:
    """Link with a hinge on body i and a ball on body j: h_i · d = 0 and (|d|² − l²)/(2 l) = 0 with d = r_Pj −
    r_Pi. [m, m]

    Removes 2 freedoms. `u_i`, `h_i`: the hinge, whose length scales the first row; `u_j`: the ball;
    `length`: l. The ball is in the hinge's plane. Haug, section 9.4. Signs: the first row is positive where
    the ball is on the side to which h_i points.
    """
    return joint("revolute_spherical", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i),
        ("u_j", "Vec3", u_j), ("h_i", "Vec3", h_i), ("length", "f64", length)])


def revolute_revolute(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    h_i: AxisLike,
    h_j: AxisLike,
    length: NumberLike,
    twist: NumberLike,
) -> Joint:
    """Link with a hinge at either end: h_i · d = 0, h_j · d = 0, (|d|² − l²)/(2 l) = 0 and h_j · (b cos α −
    h_i sin α) = 0, d = r_Pj − r_Pi, b = d × h_i / l. [m, m, m, –]

    Removes 4 freedoms. `u_i`, `h_i`, `u_j`, `h_j`: the hinges; `length`: l of the common normal; `twist`:
    α, from h_i to h_j about d by the right-hand rule, zero for parallel hinges (Denavit and Hartenberg's
    link). The equations hold for an opposite h_j too; a position found so is an error. Haug, section 9.4.
    Signs: d points from i to j; `twist` is right-handed about d and turns h_i into h_j.
    """
    return joint("revolute_revolute", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i),
        ("u_j", "Vec3", u_j), ("h_i", "Axis", h_i), ("h_j", "Axis", h_j), ("length", "f64", length),
        ("twist", "f64", twist)])


def revolute_cylindrical(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    h_i: AxisLike,
    h_j: AxisLike,
    length: NumberLike,
    twist: NumberLike,
) -> Joint:
    """Link with a hinge on body i and a sleeve on an axis of body j: h_i · d = 0, (|d|² − l²)/(2 l) = 0 and
    h_j · (b cos α − h_i sin α) = 0, d the part of r_Pj − r_Pi across h_j, b = d × h_i / l. [m, m, –]

    Removes 3 freedoms. `u_i`, `h_i`: the hinge; `u_j`, `h_j`: the axis on which the sleeve turns and
    slides; `length`: l of the common normal; `twist`: α, from h_i to h_j about d. The equations hold for an
    opposite h_j too; a position found so is an error. Haug, section 9.4. Signs: d points from i to the axis
    of j; `twist` is right-handed about d and turns h_i into h_j.
    """
    return joint("revolute_cylindrical", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i),
        ("u_j", "Vec3", u_j), ("h_i", "Axis", h_i), ("h_j", "Axis", h_j), ("length", "f64", length),
        ("twist", "f64", twist)])


def spherical_cylindrical(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    h_j: AxisLike,
    length: NumberLike,
) -> Joint:
    """Link with a ball on body i and a sleeve on an axis of body j: ((f_j · d)² + (g_j · d)² − l²)/(2 l) = 0
    with d = r_Pi − r_Pj. [m]

    Removes 1 freedom. `u_i`: the ball; `u_j`, `h_j`: the axis; `length`: l. A point on a cylinder of radius
    l. Haug, section 9.4. Signs: none; the row is positive outside of the cylinder.
    """
    return joint("spherical_cylindrical", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i),
        ("u_j", "Vec3", u_j), ("h_j", "Axis", h_j), ("length", "f64", length)])


def drive_turn(i: SpatialLike, j: SpatialLike, h_i: AxisLike, h_j: AxisLike, law: LawLike) -> Joint:
    """The turn of body i in body j follows a law of time: the turn of f_i from f_j about h_j, taken back by
    f(t), is zero. [rad]

    `h_i`, `h_j`: the common axis in either body, held parallel by a joint; f_i and f_j are where the angle
    counts from. What is measured is turned back by the law and what remains is driven to zero: any number
    of turns, and no jump where a measured angle has its cut. Haug, section 9.5. Signs: the turn of i in j
    is right-handed about h_j, zero where f_i lies along f_j.
    """
    return joint("drive_turn", [("i", "Spatial", i), ("j", "Spatial", j), ("h_i", "Axis", h_i), ("h_j",
        "Axis", h_j), ("law", "Law", law)])


def drive_slide(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    h_j: AxisLike,
    law: LawLike,
) -> Joint:
    """A slide follows a law of time: h_j · (r_Pi − r_Pj) − f(t) = 0. [m]

    `u_i`: P_i; `u_j`: from where, `h_j`: along which direction in body j. A cylinder or a linear motor.
    Haug, section 9.5. Signs: the slide grows as P_i moves along h_j in j.
    """
    return joint("drive_slide", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("h_j", "Axis", h_j), ("law", "Law", law)])


def drive_distance(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like, law: LawLike) -> Joint:
    """The distance of two points follows a law of time: |r_Pi − r_Pj| − f(t) = 0. [m]

    `u_i`, `u_j`: the points. The law must stay above zero: where the points meet there is no slope. A leg
    of a Stewart platform. Haug, section 9.5. Signs: none; a distance is above zero.
    """
    return joint("drive_distance", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("law", "Law", law)])


def drive_point(body: SpatialLike, u: Vec3Like, path_x: LawLike, path_y: LawLike, path_z: LawLike) -> Joint:
    """A point of a body follows a path: r_P − (f1(t), f2(t), f3(t)) = 0. [m]

    `u`: local position of P. Lecture, "Driving Constraints": complex driver. Signs: the laws are global
    coordinates.
    """
    return joint("drive_point", [("body", "Spatial", body), ("u", "Vec3", u), ("path_x", "Law", path_x),
        ("path_y", "Law", path_y), ("path_z", "Law", path_z)])


def drive_point_along(body: SpatialLike, u: Vec3Like, n: AxisLike, law: LawLike) -> Joint:
    """One coordinate of a point follows a law of time: n · r_P − f(t) = 0. [m]

    `u`: local position of P; `n`: the global direction along which it is measured. Haug, section 9.5.
    Signs: the coordinate grows along `n`, from the global origin.
    """
    return joint("drive_point_along", [("body", "Spatial", body), ("u", "Vec3", u), ("n", "Axis", n),
        ("law", "Law", law)])


def drive_rotation(i: SpatialLike, j: SpatialLike, h_j: AxisLike, law: LawLike) -> Joint:
    """Body i turns in body j about an axis by a law of time: the vector part of p(t) p_j p_i is zero, p(t) =
    (cos f/2, h_j sin f/2). [–]

    Three rows. `h_j`: the axis in body j. Any number of turns. Nikravesh, Computer-Aided Analysis of
    Mechanical Systems, ch. 6. Signs: the turn of i in j is right-handed about h_j; at zero both frames have
    the same directions.
    """
    return joint("drive_rotation", [("i", "Spatial", i), ("j", "Spatial", j), ("h_j", "Axis", h_j), ("law",
        "Law", law)])


def drive_orientation(i: SpatialLike, j: SpatialLike, yaw: LawLike, pitch: LawLike, roll: LawLike) -> Joint:
    """Body i is turned in body j by yaw, pitch and roll, laws of time: the vector part of p(t) p_j p_i is
    zero, p = p_z(yaw) p_y(pitch) p_x(roll). [–]

    Three rows: an orientation path. First roll about x, then pitch about y, then yaw about z, all axes
    those of body j; the same as yaw, pitch and roll about the axes as they move along. Any number of turns.
    Shabana, Computational Dynamics, section 7.2. Signs: each turn is right-handed about its axis; at zero
    both frames have the same directions.
    """
    return joint("drive_orientation", [("i", "Spatial", i), ("j", "Spatial", j), ("yaw", "Law", yaw),
        ("pitch", "Law", pitch), ("roll", "Law", roll)])


def drive_motion(
    i: SpatialLike,
    j: SpatialLike,
    u_i: Vec3Like,
    u_j: Vec3Like,
    p_i: EulerLike,
    p_j: EulerLike,
    x: LawLike,
    y: LawLike,
    z: LawLike,
    yaw: LawLike,
    pitch: LawLike,
    roll: LawLike,
) -> Joint:
    """General motion: a frame of body i moves in a frame of body j by six laws: r_Pi − r_Pj − A_j (x, y, z)(t)
    = 0, and the vector part of p(t) p_j p_i is zero, p = p_z(yaw) p_y(pitch) p_x(roll), A_j, p_i and p_j
    those of the frames. [m, –]

    Six rows. `u_i`, `p_i`, `u_j`, `p_j`: origin and Euler parameters of the frame in either body
    (`kin.EulerParameters()`: the axes of the body itself). First roll about x, then pitch about y, then yaw
    about z, all axes those of the frame in j; any number of turns. Another order of turns is this one
    between other frames. Shabana, Computational Dynamics, section 7.2. Signs: x, y, z grow along the axes
    of the frame in j; each turn is right-handed about its axis; at zero both frames have the same
    directions.
    """
    return joint("drive_motion", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("p_i", "EulerParameters", p_i), ("p_j", "EulerParameters", p_j), ("x", "Law", x),
        ("y", "Law", y), ("z", "Law", z), ("yaw", "Law", yaw), ("pitch", "Law", pitch), ("roll", "Law",
        roll)])


__all__ = [
    "angle",
    "constant_velocity",
    "cylindrical",
    "distance",
    "drive_distance",
    "drive_motion",
    "drive_orientation",
    "drive_point",
    "drive_point_along",
    "drive_rotation",
    "drive_slide",
    "drive_turn",
    "fixed",
    "gear",
    "gear_by_radii",
    "moving_point",
    "parallel",
    "perpendicular",
    "planar",
    "point_coordinate",
    "point_in_plane",
    "point_on_line",
    "point_on_path",
    "prismatic",
    "rack_and_pinion",
    "relative_angle",
    "revolute",
    "revolute_cylindrical",
    "revolute_revolute",
    "revolute_spherical",
    "screw",
    "spherical",
    "spherical_cylindrical",
    "thread",
    "universal",
    "weld",
]
