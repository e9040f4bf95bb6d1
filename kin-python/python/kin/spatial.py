"""Joints, couplings and drivers of spatial bodies.

Made from docs/library.md by `python tools/library.py`; do not edit.
"""

from __future__ import annotations

from typing import Sequence

from ._dimension import NumberLike
from ._handles import CoordinateLike, PlanarLike, SpatialLike
from ._joint import AxisLike, EulerLike, Joint, LawLike, Vec2Like, Vec3Like, joint


def spherical(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like) -> Joint:
    """Holds point P of body i on point P of body j, as a ball joint does: R_i + A_i ū_i − R_j − A_j ū_j = 0.
    [m]

    Removes 3 freedoms. `u_i` and `u_j` are the local positions of P in body i and body j [m]. The name of
    this primitive is at-point. Source: lecture notes, "Spherical Joint Constraint". Signs: the rows are the
    global components of the vector from P_j to P_i.
    """
    return joint("spherical", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j)])


def distance(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like, length: NumberLike) -> Joint:
    """Holds two points at a constant distance, as a rod without mass does: (|r_Pi − r_Pj|² − l²)/(2 l) = 0.
    [m]

    Removes 1 freedom. `u_i` and `u_j` are the local positions of the points in body i and body j [m].
    `length` is the positive length l of the rod [m]. A rod between a ball joint and a universal joint has
    the same equation. Near the solution the row is |r_Pi − r_Pj| − l, but the derivative of the row also
    exists where the points coincide. Source: Haug, section 9.4. Signs: the rod may point in any direction.
    """
    return joint("distance", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("length", "f64", length)])


def point_on_line(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like, h_j: AxisLike) -> Joint:
    """Keeps a point of body i on a line of body j: f_j · d = g_j · d = 0 with d = r_Pi − r_Pj. [m, m]

    Removes 2 freedoms. `u_i` is the local position of the point in body i [m]. `u_j` is a point of the line
    [m] and `h_j` the direction of the line in body j. f_j and g_j are two directions perpendicular to h_j.
    Source: Haug, section 9.4. Measure: `slide`, h_j · d. Signs: the slide grows as i moves along h_j in j.
    """
    return joint("point_on_line", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("h_j", "Axis", h_j)])


def point_in_plane(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like, h_j: Vec3Like) -> Joint:
    """Keeps a point of body i in a plane of body j: h_j · (r_Pi − r_Pj) = 0. [m]

    Removes 1 freedom. `u_i` is the local position of the point in body i [m]. `u_j` is a point of the plane
    [m] and `h_j` the normal of the plane in body j; its length scales the row. As a primitive this joint
    has the name dot-2. Source: Haug, section 9.4. Signs: the row is positive where the point is on the side
    to which h_j points.
    """
    return joint("point_in_plane", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("h_j", "Vec3", h_j)])


def point_coordinate(body: SpatialLike, u: Vec3Like, n: Vec3Like, value: NumberLike) -> Joint:
    """Holds one global coordinate of a point at a constant value: n · r_P − c = 0. [m]

    Removes 1 freedom. `u` is the local position of P [m]. `n` is the global direction of the coordinate;
    its length scales the row and c. `value` is c [m]. Source: Haug, section 9.4. Signs: c grows along `n`.
    """
    return joint("point_coordinate", [("body", "Spatial", body), ("u", "Vec3", u), ("n", "Vec3", n),
        ("value", "f64", value)])


def parallel(i: SpatialLike, j: SpatialLike, h_i: AxisLike, h_j: Vec3Like) -> Joint:
    """Keeps an axis of body i parallel to an axis of body j: f_i · h_j = g_i · h_j = 0. [–, –]

    Removes 2 freedoms. `h_i` and `h_j` are the axes. f_i and g_i are the two directions across h_i; the
    length of h_j scales the rows. Opposite axes satisfy the equations too, so a position found with h_i ·
    h_j < 0 is an error. Source: Haug, section 9.4. Signs: h_i and h_j point in the same direction.
    """
    return joint("parallel", [("i", "Spatial", i), ("j", "Spatial", j), ("h_i", "Axis", h_i), ("h_j",
        "Vec3", h_j)])


def perpendicular(i: SpatialLike, j: SpatialLike, h_i: Vec3Like, h_j: Vec3Like) -> Joint:
    """Keeps a direction of body i perpendicular to a direction of body j: h_i · h_j = 0. [–]

    Removes 1 freedom. `h_i` and `h_j` are the directions; their lengths scale the row. As a primitive this
    joint has the name dot-1. Source: Haug, section 9.4. Signs: the row is positive where the angle between
    h_i and h_j is less than 90°.
    """
    return joint("perpendicular", [("i", "Spatial", i), ("j", "Spatial", j), ("h_i", "Vec3", h_i), ("h_j",
        "Vec3", h_j)])


def angle(i: SpatialLike, j: SpatialLike, h_i: AxisLike, h_j: AxisLike, alpha: NumberLike) -> Joint:
    """Holds a direction of body i at a constant angle to a direction of body j: h_i · h_j − cos α = 0. [–]

    Removes 1 freedom. `h_i` and `h_j` are the directions. `alpha` is the angle α between the directions,
    strictly between 0 and π [rad]. At 0 and π the derivative of the row is zero; use `parallel` instead.
    Source: Haug, section 9.4. Signs: the angle has no sign, so h_i can be anywhere on a cone about h_j. The
    row is positive where the angle is less than α.
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
    """Holds a point that moves in body i by laws of time on a point of body j: R_i + A_i ū_i(t) − R_j − A_j
    ū_j = 0. [m]

    Removes 3 freedoms. `x_i`, `y_i` and `z_i` are the laws of the local position ū_i(t) in body i [m].
    `u_j` is the local position in body j [m]. Source: lecture notes, "Moving Point on Rigid Body". Signs:
    the laws give coordinates in the frame of body i.
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
    """Holds a point that moves along a path in body i on a point of body j: R_i + A_i ū_i(s) − R_j − A_j ū_j =
    0. [m]

    Removes 3 freedoms and adds one coordinate, `s` along the path, so the joint removes 2 freedoms in
    total. `x_i`, `y_i` and `z_i` are the laws of the local position ū_i(s) in body i [m]. `u_j` is the
    local position in body j [m]. Source: lecture notes, "Moving Point on Rigid Body". Signs: the laws give
    coordinates in the frame of body i. `s` grows in the direction of the path.
    """
    return joint("point_on_path", [("i", "Spatial", i), ("j", "Spatial", j), ("s", "Coord", s), ("x_i",
        "Law", x_i), ("y_i", "Law", y_i), ("z_i", "Law", z_i), ("u_j", "Vec3", u_j)])


def fixed(j: SpatialLike, r: Vec3Like, p0: EulerLike) -> Joint:
    """Holds a body at a given pose: R − r = 0 and vec(p0 p) = 0, where vec is the vector part of the product.
    [m, –]

    Removes 6 freedoms. `r` is the global position of the origin of the body frame [m]. `p0` are the Euler
    parameters of the orientation; p0 is their conjugate. There is no second solution, because a rotation by
    180° has a vector part of length 1. Nikravesh, Computer-Aided Analysis of Mechanical Systems, section
    7.2. Signs: `p0` rotates the global frame into the frame of the body. p0 and −p0 are the same rotation.
    """
    return joint("fixed", [("j", "Spatial", j), ("r", "Vec3", r), ("p0", "EulerParameters", p0)])


def weld(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like, p_ij: EulerLike) -> Joint:
    """Holds body i rigidly on body j: r_Pi − r_Pj = 0 and vec(p_ij p_j p_i) = 0, where vec is the vector part
    of the product. [m, –]

    Removes 6 freedoms. `u_i` and `u_j` are the local positions of a common point P in body i and body j
    [m]. `p_ij` are the Euler parameters of body i relative to body j; is the conjugate. There is no second
    solution, because a rotation by 180° has a vector part of length 1. Nikravesh, Computer-Aided Analysis
    of Mechanical Systems, section 7.2. Signs: `p_ij` rotates the frame of j into the frame of i.
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
    """Joins two bodies by a hinge: r_Pi − r_Pj = 0 (at-point) and f_i · h_j = g_i · h_j = 0 (two dot-1). [m,
    –, –]

    Removes 5 freedoms. `u_i` and `u_j` are the local positions of a point P of the axis in body i and body
    j [m]. `h_i` and `h_j` are the axis in body i and body j; f_i and g_i are the directions across h_i.
    Opposite axes satisfy the equations too, so a position found with h_i · h_j < 0 is an error. Haug,
    section 9.4. Measure: `angle`, the angle from f_j to f_i. Signs: the angle is the rotation of i relative
    to j, right-handed about h_j. `.zero(f_i, f_j)` sets the zero of the angle: there f_i of body i lies
    along f_j of body j. By default f_i and f_j are the directions that `Axis.along` chooses for h_i and h_j
    (x for z, y for x, z for y).
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
    """Lets body i slide along an axis of body j without rotation: vec(p_ij p_j p_i) = 0 and f_i · d = g_i · d
    = 0 (two dot-2) with d = r_Pi − r_Pj. [–, m, m]

    Removes 5 freedoms. The function vec gives the vector part of a product of Euler parameters, and is the
    conjugate. `u_i` and `u_j` are points of the axis in body i and body j [m]. `h_i` is the direction of
    the axis in body i; f_i and g_i are the directions across h_i. `p_ij` are the Euler parameters of body i
    relative to body j. The equations have no second solution. Source: Haug, section 9.4. Measure: `slide`,
    h_i · d. Signs: the slide grows as i moves along h_i in j. `p_ij` rotates the frame of j into the frame
    of i.
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
    """Lets body i slide along an axis of body j and rotate about it: f_i · h_j = g_i · h_j = 0 (two dot-1) and
    f_i · d = g_i · d = 0 (two dot-2) with d = r_Pi − r_Pj. [–, –, m, m]

    Removes 4 freedoms. `u_i` and `u_j` are points of the axis in body i and body j [m]. `h_i` and `h_j` are
    the axis in body i and body j. The equations h_i × h_j = 0 and h_i × d = 0 describe the same joint
    (lecture notes, "Cylindrical Joint Constraint"). Kin uses the components of these equations along f_i
    and g_i, the two directions across h_i, which keep full rank at every pose. Opposite axes satisfy the
    equations too, so a position found with h_i · h_j < 0 is an error. Measures: `angle`, the angle from f_j
    to f_i; `slide`, h_j · d. Signs: the angle is the rotation of i relative to j, right-handed about h_j.
    `.zero(f_i, f_j)` sets the zero of the angle, as for `revolute`. The slide grows as i moves along h_j in
    j.
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
    """Joins two bodies by a universal joint: r_Pi − r_Pj = 0 (at-point) and h_i · h_j = 0 (dot-1). [m, –]

    Removes 4 freedoms. `u_i` and `u_j` are the local positions of the centre P of the cross in body i and
    body j [m]. `h_i` and `h_j` are the two bars of the cross, each in the body in which it rotates; their
    lengths scale the row. Source: lecture notes, "Universal Joint Constraint". Measures: `angle_j`, the
    angle of the cross relative to body j about h_j; `angle_i`, the angle of body i relative to the cross
    about h_i. Signs: both angles are right-handed about their bars. Both angles are zero where the axes of
    both frames are parallel. From this pose body i rotates by `angle_i` about its bar, and then together
    with the cross by `angle_j` about the bar of j. If h_i and h_j are not perpendicular in that pose,
    `kin.Axis(h, f)` gives the reference directions.
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
    """Keeps a plane of body i on a plane of body j: f_i · h_j = g_i · h_j = 0 (two dot-1) and h_j · (r_Pi −
    r_Pj) = 0 (dot-2). [–, –, m]

    Removes 3 freedoms. `u_i` and `u_j` are points of the common plane in body i and body j [m]. `h_i` and
    `h_j` are the normal of the plane in body i and body j. Opposite normals satisfy the equations too, so a
    position found with h_i · h_j < 0 is an error. Haug, section 9.4. Measure: `angle`, the angle from f_j
    to f_i. Signs: the angle is the rotation of i relative to j, right-handed about h_j. `.zero(f_i, f_j)`
    sets the zero of the angle, as for `revolute`. The last row is positive where P_i is on the side to
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
    """Joins two bodies by a screw: f_j · h_i = g_j · h_i = 0, f_j · d = g_j · d = 0 and φ − 2π h_j · d/lead =
    0 with d = r_Pi − r_Pj. [–, –, m, m, rad]

    Removes 5 freedoms. φ is the angle from f_j to f_i about h_j. `u_i` and `u_j` are points of the axis in
    body i and body j [m]. `h_i` and `h_j` are the axis in body i and body j, with f_i along f_j where the
    points coincide. `lead` is the displacement of i along h_j for one revolution about h_j [m]. Kin rotates
    f_i back by 2π h_j · d/lead and holds the remaining angle at zero. The joint therefore counts full
    revolutions without a jump. Opposite axes satisfy the equations too, so a position found with h_i · h_j
    < 0 is an error. If another joint holds the axes in line, use `thread`. Source: Haug, section 9.4.
    Measures: `angle`, φ; `slide`, h_j · d. Signs: the angle is the rotation of i relative to j, right-
    handed about h_j. The slide grows as i moves along h_j in j. `lead` is positive for a right-hand thread.
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
    """Joins two shafts by a constant-velocity joint: r_Pi − r_Pj = 0 (at-point) and f_i · g_j − g_i · f_j = 0.
    [m, –]

    Removes 4 freedoms. `u_i` and `u_j` are the local positions of the centre P in body i and body j [m].
    `h_i` and `h_j` are the shafts; where the shafts are in line, h_i equals h_j and f_i equals f_j. The
    second equation allows i to bend against j about an axis across the shafts, without twist. Both shafts
    therefore rotate by the same angle at every time. Shafts twisted by 180° satisfy the equation too, so a
    position found with f_i · f_j + g_i · g_j < 0 is an error. Source: Hunt, Kinematic Geometry of
    Mechanisms. Signs: h_i and h_j point in the same direction along the drive line, from one shaft to the
    other. With these directions both shafts rotate in the same direction.
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
    """Introduces a coordinate φ for the angle of body i relative to body j: φ_ij − φ = 0, where φ_ij is the
    angle from f_j to f_i about h_j. [rad]

    Removes 1 freedom and adds one coordinate, the angle `phi`, which counts full revolutions. `h_i` and
    `h_j` are the common axis in body i and body j. Another joint must keep both axes parallel. f_i and f_j
    are the reference directions of the angle. Use the coordinate to drive a rotation, or to couple the
    rotation by `coupling`. Source: Haug, section 9.4. Signs: φ is the rotation of i relative to j, right-
    handed about h_j. The angle is zero where f_i is along f_j.
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
    """Meshes two gears on a frame by their numbers of teeth: z_i φ_i + z_j φ_j − z_i φ0 = 0, up to whole
    teeth. [rad]

    Removes 1 freedom. φ_i and φ_j are the angles of the wheels relative to the frame. `i` and `j` are the
    wheels. `h_i` and `h_j` are their axes; `a_i` and `a_j` are the same axes in the frame. Other joints
    must keep the axes parallel. The direction f of an axis is the reference direction of its angle.
    `teeth_i` and `teeth_j` are z_i and z_j, whole numbers; for a ring with internal teeth the number is
    negative. `phase` is φ0, the angle of i when the angle of j is zero [rad]. The equation has no jump
    after a full revolution, because a wheel then looks the same. The first position decides which teeth
    mesh. To use radii instead, use `gear_by_radii`. Source: Norton, Design of Machinery, ch. 9. Signs:
    angles are right-handed about a_i and a_j. If both axes point out of the frame (or from the apex of
    bevel gears), the wheels turn in opposite directions.
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
    """Meshes two gears on a frame by their radii: φ_i − φ0 − s/r_i = 0 and φ_j + s/r_j = 0, where φ is the
    angle of a wheel relative to the frame. [rad, rad]

    Removes 2 freedoms and adds one coordinate, the length `s` that has rolled through the mesh [m], so the
    joint removes 1 freedom in total. `i` and `j` are the wheels. `h_i` and `h_j` are their axes; `a_i` and
    `a_j` are the same axes in the frame. Other joints must keep the axes parallel. The direction f of an
    axis is the reference direction of its angle. `r_i` and `r_j` are the pitch radii [m]; for a ring with
    internal teeth the radius is negative. Measure the radii of bevel gears at the same distance from the
    apex. Friction wheels may have any ratio. `phase` is φ0, the angle of i when the angle of j is zero
    [rad]. `s` counts full revolutions, and you can drive `s`. Source: Norton, Design of Machinery, ch. 9.
    Signs: angles are right-handed about a_i and a_j; `s` grows with the angle of i. If both axes point out
    of the frame (or from the apex of bevel gears), the wheels turn in opposite directions.
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
    """Couples the rotation of body i in body j to its displacement, as a thread does: φ − 2π h_j · (r_Pi −
    r_Pj)/lead = 0, where φ is the angle from f_j to f_i about h_j. [rad]

    Removes 1 freedom. The row turns a cylindrical joint into a `screw`. The row also couples a slide to a
    shaft that other joints hold. `u_i` and `u_j` are points of the axis in body i and body j [m]. `h_i` and
    `h_j` are the axis in body i and body j, with f_i along f_j where the points coincide. Another joint
    must keep both axes parallel. `lead` is the displacement of i along h_j for one revolution about h_j
    [m]. The thread counts full revolutions. Source: Haug, section 9.4. The joint that holds the axes
    measures the angle and the slide. Signs: φ is the rotation of i relative to j, right-handed about h_j.
    The displacement is the displacement of i along h_j in j. `lead` is positive for a right-hand thread.
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
    """Meshes a pinion with a rack: φ − φ0 + f_j · (r_Pi − r_Pj)/r = 0, where φ is the angle of the pinion
    relative to the rack about h_j. [rad]

    Removes 1 freedom. `i` is the pinion, `u_i` its centre [m], `h_i` its axis and `radius` its pitch radius
    r [m]. `j` is the rack and `u_j` a point of its pitch line [m]. `h_j` is the direction of the pinion's
    axis in the rack, with f_j along the rack (`kin.Axis(h, f)`). Other joints must keep the axes parallel.
    `phase` is φ0, the angle from f_j to f_i where the centre is over `u_j` [rad]. Source: Haug, section
    3.4, in space. Signs: the pinion is on the side of g_j = h_j × f_j; with a negative radius it is on the
    other side. When the pinion moves along f_j, it turns clockwise about h_j.
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
    """Replaces a link with a hinge on body i and a ball joint on body j: h_i · d = 0 and (|d|² − l²)/(2 l) = 0
    with d = r_Pj − r_Pi. [m, m]

    Removes 2 freedoms. `u_i` is a point of the hinge [m] and `h_i` its direction in body i; the length of
    h_i scales the first row. `u_j` is the centre of the ball in body j [m]. `length` is l, from the hinge
    to the ball [m]. The ball is in the plane through u_i perpendicular to the hinge. Source: Haug, section
    9.4. Signs: the first row is positive where the ball is on the side to which h_i points.
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
    """Replaces a link with a hinge at each end: h_i · d = 0, h_j · d = 0, (|d|² − l²)/(2 l) = 0 and h_j · (b
    cos α − h_i sin α) = 0 with d = r_Pj − r_Pi and b = d × h_i / l. [m, m, m, –]

    Removes 4 freedoms. `u_i`, `h_i` and `u_j`, `h_j` are a point [m] and the direction of each hinge.
    `length` is l, the length of the common normal [m]. `twist` is α, the angle from h_i to h_j about d
    [rad]; the twist is zero for parallel hinges (the link of Denavit and Hartenberg). An opposite h_j
    satisfies the equations too, so a position with an opposite h_j is an error. Source: Haug, section 9.4.
    Signs: d points from i to j. `twist` is right-handed about d and rotates h_i into h_j.
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
    """Replaces a link with a hinge on body i and a sleeve on body j: h_i · d = 0, (|d|² − l²)/(2 l) = 0 and
    h_j · (b cos α − h_i sin α) = 0 with b = d × h_i / l. [m, m, –]

    Removes 3 freedoms. The vector d is the part of r_Pj − r_Pi perpendicular to h_j. `u_i` and `h_i` are a
    point [m] and the direction of the hinge in body i. `u_j` and `h_j` are a point [m] and the direction of
    the axis in body j on which the sleeve rotates and slides. `length` is l, the length of the common
    normal [m]. `twist` is α, the angle from h_i to h_j about d [rad]. An opposite h_j satisfies the
    equations too, so a position with an opposite h_j is an error. Source: Haug, section 9.4. Signs: d
    points from i to the axis of j. `twist` is right-handed about d and rotates h_i into h_j.
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
    """Keeps a point of body i at a constant distance from an axis of body j: ((f_j · d)² + (g_j · d)² − l²)/(2
    l) = 0 with d = r_Pi − r_Pj. [m]

    Removes 1 freedom. The joint replaces a link with a ball joint on body i and a sleeve on body j. `u_i`
    is the centre of the ball in body i [m]. `u_j` and `h_j` are a point [m] and the direction of the axis
    in body j. `length` is the distance l [m]. Use this joint also for a point on a cylinder of radius l.
    Source: Haug, section 9.4. Signs: the row is positive outside the cylinder.
    """
    return joint("spherical_cylindrical", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i),
        ("u_j", "Vec3", u_j), ("h_j", "Axis", h_j), ("length", "f64", length)])


def drive_turn(i: SpatialLike, j: SpatialLike, h_i: AxisLike, h_j: AxisLike, law: LawLike) -> Joint:
    """Makes the angle of body i relative to body j follow a law of time: φ − f(t) = 0, where φ is the angle
    from f_j to f_i about h_j. [rad]

    `h_i` and `h_j` are the common axis in body i and body j. A joint must keep both axes parallel. f_i and
    f_j are the reference directions of the angle. `law` is f [rad]. Kin rotates f_i back by the law and
    holds the remaining angle at zero, so the law can count full revolutions. Source: Haug, section 9.5.
    Signs: the angle is the rotation of i relative to j, right-handed about h_j. The angle is zero where f_i
    is along f_j.
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
    """Makes a displacement along an axis of body j follow a law of time: h_j · (r_Pi − r_Pj) − f(t) = 0. [m]

    `u_i` is the local position of P_i in body i [m]. `u_j` is the point P_j of body j where the
    displacement is zero [m]. `h_j` is the direction of the axis in body j. `law` is f [m]. Use this driver
    for a cylinder or a linear motor. Source: Haug, section 9.5. Signs: the displacement grows as P_i moves
    along h_j in j.
    """
    return joint("drive_slide", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("h_j", "Axis", h_j), ("law", "Law", law)])


def drive_distance(i: SpatialLike, j: SpatialLike, u_i: Vec3Like, u_j: Vec3Like, law: LawLike) -> Joint:
    """Makes the distance of two points follow a law of time: |r_Pi − r_Pj| − f(t) = 0. [m]

    `u_i` and `u_j` are the local positions of the points in body i and body j [m]. `law` is f [m]. The law
    must remain positive, because the distance has no derivative where the points coincide. Use this driver
    for a leg of a Stewart platform. Source: Haug, section 9.5. Signs: the distance is always positive.
    """
    return joint("drive_distance", [("i", "Spatial", i), ("j", "Spatial", j), ("u_i", "Vec3", u_i), ("u_j",
        "Vec3", u_j), ("law", "Law", law)])


def drive_point(body: SpatialLike, u: Vec3Like, path_x: LawLike, path_y: LawLike, path_z: LawLike) -> Joint:
    """Makes a point of a body follow a path: r_P − (f1(t), f2(t), f3(t)) = 0. [m]

    `u` is the local position of P [m]. `path_x`, `path_y` and `path_z` are f1, f2 and f3 [m]. Source:
    lecture notes, "Driving Constraints". Signs: the laws give global coordinates.
    """
    return joint("drive_point", [("body", "Spatial", body), ("u", "Vec3", u), ("path_x", "Law", path_x),
        ("path_y", "Law", path_y), ("path_z", "Law", path_z)])


def drive_point_along(body: SpatialLike, u: Vec3Like, n: AxisLike, law: LawLike) -> Joint:
    """Makes one coordinate of a point follow a law of time: n · r_P − f(t) = 0. [m]

    `u` is the local position of P [m]. `n` is the global direction of the coordinate. `law` is f [m].
    Source: Haug, section 9.5. Signs: the coordinate grows along `n`, from the global origin.
    """
    return joint("drive_point_along", [("body", "Spatial", body), ("u", "Vec3", u), ("n", "Axis", n),
        ("law", "Law", law)])


def drive_rotation(i: SpatialLike, j: SpatialLike, h_j: AxisLike, law: LawLike) -> Joint:
    """Makes body i rotate relative to body j about an axis by a law of time: vec(p(t) p_j p_i) = 0 with p(t) =
    (cos f/2, h_j sin f/2). [–]

    The driver has three rows. The function vec gives the vector part of a product of Euler parameters, and
    is the conjugate. `h_j` is the axis in body j. `law` is f [rad]; the law can count full revolutions.
    Source: Nikravesh, Computer-Aided Analysis of Mechanical Systems, ch. 6. Signs: the rotation of i
    relative to j is right-handed about h_j. At zero the axes of both frames are parallel.
    """
    return joint("drive_rotation", [("i", "Spatial", i), ("j", "Spatial", j), ("h_j", "Axis", h_j), ("law",
        "Law", law)])


def drive_orientation(i: SpatialLike, j: SpatialLike, yaw: LawLike, pitch: LawLike, roll: LawLike) -> Joint:
    """Makes the orientation of body i in body j follow laws of yaw, pitch and roll: vec(p(t) p_j p_i) = 0 with
    p = p_z(yaw) p_y(pitch) p_x(roll). [–]

    The driver has three rows. The function vec gives the vector part of a product of Euler parameters, and
    is the conjugate. The body first rolls about the x-axis of body j, then pitches about the y-axis of body
    j, then yaws about the z-axis of body j. The result equals yaw, pitch and roll about the moving axes.
    `yaw`, `pitch` and `roll` are angles [rad] and can count full revolutions. Source: Shabana,
    Computational Dynamics, section 7.2. Signs: each rotation is right-handed about its axis. At zero the
    axes of both frames are parallel.
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
    """Makes a frame of body i follow six laws in a frame of body j: r_Pi − r_Pj − A_j (x, y, z)(t) = 0 and
    vec(p(t) p_j p_i) = 0 with p = p_z(yaw) p_y(pitch) p_x(roll). [m, –]

    The driver has six rows. A_j, p_i and p_j belong to the two frames. The function vec gives the vector
    part of a product of Euler parameters, and is the conjugate. `u_i`, `p_i` and `u_j`, `p_j` are the
    origin [m] and the Euler parameters of the frame in body i and in body j. `kin.EulerParameters()`
    selects the axes of the body itself. `x`, `y`, `z` are displacements [m] and `yaw`, `pitch`, `roll` are
    angles [rad]. The frame in i first rolls about x, then pitches about y, then yaws about z of the frame
    in j. For another order of rotations choose other frames. The angles can count full revolutions. Source:
    Shabana, Computational Dynamics, section 7.2. Signs: x, y and z grow along the axes of the frame in j.
    Each rotation is right-handed about its axis. At zero the axes of both frames are parallel.
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
