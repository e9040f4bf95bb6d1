"""Joints, couplings and drivers of planar bodies and coordinates.

Made from docs/library.md by `python tools/library.py`; do not edit.
"""

from __future__ import annotations

from typing import Sequence

from ._dimension import NumberLike
from ._handles import CoordinateLike, PlanarLike, SpatialLike
from ._joint import AxisLike, EulerLike, Joint, LawLike, Vec2Like, Vec3Like, joint


def fixed(j: PlanarLike, r: Vec2Like, theta: NumberLike) -> Joint:
    """Holds a body at a given position and angle: R − r = 0 and θ − θ0 = 0. [m, m, rad]

    Removes 3 freedoms. `r` is the global position of the origin of the body frame [m]. `theta` is the angle
    θ0 of the body [rad]. Use this joint for a second ground; the ground of Kin needs no joint. Source:
    lecture notes, "Constraint Equations". Signs: `theta` is counter-clockwise positive from the global
    x-axis.
    """
    return joint("fixed", [("j", "Planar", j), ("r", "Vec2", r), ("theta", "f64", theta)])


def revolute(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like) -> Joint:
    """Pins body i to body j at point P: R_i + A_i ū_i − R_j − A_j ū_j = 0. [m]

    Removes 2 freedoms. `u_i` and `u_j` are the local positions of P in body i and body j [m]. Source:
    lecture notes, "Constraint Library: Revolute"; Shabana, Computational Dynamics, 3rd ed., section 3.4.
    Measure: `angle`, θ_i − θ_j. Signs: the angle is the rotation of i relative to j, counter-clockwise
    positive. The angle is zero where the x-axes of both bodies are parallel, and counts full revolutions.
    """
    return joint("revolute", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j", "Vec2",
        u_j)])


def weld(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like, theta0: NumberLike) -> Joint:
    """Holds body i rigidly on body j: r_Pi − r_Pj = 0 and θ_i − θ_j − θ0 = 0. [m, rad]

    Removes 3 freedoms. `u_i` and `u_j` are the local positions of a common point P in body i and body j
    [m]. `theta0` is the angle θ0 between the bodies [rad]. Source: Shabana, section 3.4. Signs: `theta0` is
    the rotation of i relative to j, counter-clockwise positive.
    """
    return joint("weld", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j", "Vec2",
        u_j), ("theta0", "f64", theta0)])


def prismatic(
    i: PlanarLike,
    j: PlanarLike,
    u_i: Vec2Like,
    u_j: Vec2Like,
    h_i: Vec2Like,
    theta0: NumberLike,
) -> Joint:
    """Lets body i slide along a line of body j without rotation: θ_i − θ_j − θ0 = 0 and h_i · (r_Pi − r_Pj) =
    0. [rad, m]

    Removes 2 freedoms. `u_i` and `u_j` are local positions of a point on the line of sliding in body i and
    body j [m]. `h_i` is the local direction in body i perpendicular to the line; its length scales the
    second row. `theta0` is the angle θ0 between the bodies [rad]. Source: lecture notes, "Constraint
    Library: Prismatic". Measure: `slide`, the distance of P_i from P_j along the line. Signs: the slide
    grows as i moves in j with h_i on its left. If h_i is the y-axis of body i, the slide grows along the
    x-axis of body i. `theta0` is the rotation of i relative to j, counter-clockwise positive.
    """
    return joint("prismatic", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j", "Vec2",
        u_j), ("h_i", "Vec2", h_i), ("theta0", "f64", theta0)])


def distance(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like, length: NumberLike) -> Joint:
    """Holds two pins at a constant distance, as a rod without mass does: (|r_Pi − r_Pj|² − l²)/(2 l) = 0. [m]

    Removes 1 freedom. `u_i` and `u_j` are the local positions of the pins in body i and body j [m].
    `length` is the positive length l of the rod [m]. Near the solution the row is |r_Pi − r_Pj| − l, but
    the derivative of the row also exists where the pins coincide. Source: Haug, Computer Aided Kinematics
    and Dynamics, section 3.3. Signs: the rod may point in any direction.
    """
    return joint("distance", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j", "Vec2",
        u_j), ("length", "f64", length)])


def angle(i: PlanarLike, j: PlanarLike, theta0: NumberLike) -> Joint:
    """Holds body i at a constant angle to body j: θ_i − θ_j − θ0 = 0. [rad]

    Removes 1 freedom. `theta0` is the angle θ0 [rad]. Kin does not wrap the angle: θ0 and θ0 + 2π are
    different angles. Source: lecture notes, "Constraint Library: Prismatic", first row. Signs: `theta0` is
    the rotation of i relative to j, counter-clockwise positive.
    """
    return joint("angle", [("i", "Planar", i), ("j", "Planar", j), ("theta0", "f64", theta0)])


def parallel(i: PlanarLike, j: PlanarLike, h_i: Vec2Like, h_j: Vec2Like) -> Joint:
    """Keeps a direction of body i parallel to a direction of body j: h_i × h_j = 0. [–]

    Removes 1 freedom. `h_i` and `h_j` are the local directions; their lengths scale the row. Opposite
    directions satisfy the equation too, so a position found with h_i · h_j < 0 is an error. Source:
    Shabana, section 3.4. Signs: h_i and h_j point in the same direction. The row is positive where h_j is
    counter-clockwise of h_i.
    """
    return joint("parallel", [("i", "Planar", i), ("j", "Planar", j), ("h_i", "Vec2", h_i), ("h_j", "Vec2",
        h_j)])


def point_on_line(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like, h_j: Vec2Like) -> Joint:
    """Keeps a point of body i on a line of body j: h_j × (s − ū_j) = 0, where s is the point in the frame of
    j. [m]

    Removes 1 freedom. `u_i` is the local position of the point in body i [m]. `u_j` is a point of the line
    in body j [m]. `h_j` is the direction of the line; its length scales the row. Source: Haug, section 3.3,
    revolute–translational joint. Measures: `slide`, the distance of the point from ū_j along h_j; `angle`,
    θ_i − θ_j. Signs: the slide grows along h_j. The row is positive to the left of h_j. The angle is the
    rotation of i relative to j, counter-clockwise positive.
    """
    return joint("point_on_line", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j",
        "Vec2", u_j), ("h_j", "Vec2", h_j)])


def pin_in_slot(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, a_j: Vec2Like, b_j: Vec2Like) -> Joint:
    """Keeps a pin of body i in a straight slot of body j from A to B: (B − A) × (s − A)/|B − A| = 0, where s
    is the pin in the frame of j. [m]

    Removes 1 freedom. `u_i` is the local position of the pin in body i [m]. `a_j` and `b_j` are the ends A
    and B of the slot's centre line in body j [m]. The ends do not stop the pin: a run reports an event
    where the pin passes an end. Measures: `slide`, the distance of the pin from A; `angle`, θ_i − θ_j.
    Signs: the slide grows from A towards B. The row is positive to the left of the direction from A to B.
    The angle is the rotation of i relative to j, counter-clockwise positive.
    """
    return joint("pin_in_slot", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("a_j",
        "Vec2", a_j), ("b_j", "Vec2", b_j)])


def point_on_circle(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, c_j: Vec2Like, radius: NumberLike) -> Joint:
    """Keeps a point of body i on a circle of body j: (|s − c_j|² − ρ²)/(2 ρ) = 0, where s is the point in the
    frame of j. [m]

    Removes 1 freedom. `u_i` is the local position of the point in body i [m]. `c_j` is the centre of the
    circle in body j [m]. `radius` is the radius ρ [m]. Use this joint for a circular slot. Source: Haug,
    section 3.3. Measure: `angle`, the direction from the centre to the point. Signs: the angle is counter-
    clockwise positive from the x-axis of body j. The row is positive outside the circle.
    """
    return joint("point_on_circle", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("c_j",
        "Vec2", c_j), ("radius", "f64", radius)])


def point_on_curve(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, curve: LawLike) -> Joint:
    """Keeps a point of body i on the curve y = f(x) of body j: s_y − f(s_x) = 0, where s is the point in the
    frame of j. [m]

    Removes 1 freedom. `u_i` is the local position of the point in body i [m]. `curve` is the law f [m]. Use
    this joint for a curved slot. Measures: `slide`, s_x; `angle`, θ_i − θ_j. Signs: the slide grows along
    the x-axis of body j, the row along its y-axis. The angle is the rotation of i relative to j, counter-
    clockwise positive.
    """
    return joint("point_on_curve", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("curve",
        "Law", curve)])


def cam_knife_edge(cam: PlanarLike, follower: PlanarLike, tip: Vec2Like, profile: LawLike) -> Joint:
    """Keeps the tip of a knife-edge follower on a cam: |s| − ρ(φ) = 0, where s is the tip in the cam's frame
    and φ the angle of s. [m]

    Removes 1 freedom. `tip` is the local position of the tip in the follower [m]. `profile` is the law ρ:
    the distance of the cam's edge from the origin of the cam's frame at the angle φ [m]. The profile must
    be 2π-periodic. Source: Norton, Cam Design and Manufacturing Handbook. Measure: `contact`, φ. Signs: φ
    is counter-clockwise positive from the x-axis of the cam. When the cam turns counter-clockwise under a
    tip at rest, φ decreases. The row is positive outside the cam.
    """
    return joint("cam_knife_edge", [("cam", "Planar", cam), ("follower", "Planar", follower), ("tip",
        "Vec2", tip), ("profile", "Law", profile)])


def cam_flat_face(cam: PlanarLike, follower: PlanarLike, u: Vec2Like, n: Vec2Like, support: LawLike) -> Joint:
    """Keeps the face of a flat-faced follower on a cam: n · (r_P − R_cam) − h(ψ) = 0, where ψ is the angle of
    the face's normal n in the cam's frame. [m]

    Removes 1 freedom. `u` is the local position of a point P of the face in the follower [m]. `n` is the
    normal of the face in the follower, pointing away from the cam. `support` is the law h: the distance
    from the origin of the cam's frame to the tangent of the edge with a normal at the angle ψ [m]. The law
    must be 2π-periodic. For a sliding follower h is the base radius plus the lift (Norton, Cam Design and
    Manufacturing Handbook). The equation does not need the point of contact, which moves on the face by h′.
    Signs: ψ is counter-clockwise positive from the x-axis of the cam. The row is positive where a gap
    separates the face from the cam.
    """
    return joint("cam_flat_face", [("cam", "Planar", cam), ("follower", "Planar", follower), ("u", "Vec2",
        u), ("n", "Vec2", n), ("support", "Law", support)])


def cam_roller(
    cam: PlanarLike,
    follower: PlanarLike,
    phi: CoordinateLike,
    centre: Vec2Like,
    radius: NumberLike,
    profile: LawLike,
) -> Joint:
    """Keeps a roller follower on a cam: s − ρ e(φ) − r n(φ) = 0, where s is the roller's centre in the cam's
    frame and n the normal of the edge at φ. [m, m]

    Removes 2 freedoms and adds one coordinate, the angle `phi` of the point of contact in the cam's frame,
    so the joint removes 1 freedom in total. `centre` is the local position of the roller's centre in the
    follower [m]. `radius` is the radius r of the roller [m]. `profile` is the law ρ(φ): the distance of the
    edge from the origin of the cam's frame [m]. The profile must be 2π-periodic. The normal is n = (ρ,
    −ρ′)/|(ρ, ρ′)| in the directions e(φ) and across. The radius of curvature of a concave edge must be
    larger than the radius of the roller. Source: Norton, Cam Design and Manufacturing Handbook. Signs: φ is
    counter-clockwise positive from the x-axis of the cam. The normal n points out of the cam, towards the
    roller.
    """
    return joint("cam_roller", [("cam", "Planar", cam), ("follower", "Planar", follower), ("phi", "Coord",
        phi), ("centre", "Vec2", centre), ("radius", "f64", radius), ("profile", "Law", profile)])


def gear(
    i: PlanarLike,
    j: PlanarLike,
    arm: PlanarLike,
    r_i: NumberLike,
    r_j: NumberLike,
    phase: NumberLike,
) -> Joint:
    """Meshes two external gears on an arm: r_i (θ_i − θ_arm − φ) + r_j (θ_j − θ_arm) = 0. [m]

    Removes 1 freedom. `i` and `j` are the wheels. `arm` is the body that carries both axles; use the ground
    for axles at rest. `r_i` and `r_j` are the pitch radii [m]. `phase` is φ, the angle of i relative to the
    arm when j is in line with the arm [rad]. Source: Norton, Design of Machinery, ch. 9. Signs: relative to
    the arm the wheels turn in opposite directions. All angles are counter-clockwise positive.
    """
    return joint("gear", [("i", "Planar", i), ("j", "Planar", j), ("arm", "Planar", arm), ("r_i", "f64",
        r_i), ("r_j", "f64", r_j), ("phase", "f64", phase)])


def internal_gear(
    i: PlanarLike,
    j: PlanarLike,
    arm: PlanarLike,
    r_i: NumberLike,
    r_j: NumberLike,
    phase: NumberLike,
) -> Joint:
    """Meshes a gear with a ring on an arm: r_i (θ_i − θ_arm − φ) − r_j (θ_j − θ_arm) = 0. [m]

    Removes 1 freedom. `i` is the wheel with the pitch radius `r_i` [m]. `j` is the ring with internal teeth
    and the pitch radius `r_j` [m]. `arm` is the body that carries both axles. `phase` is φ, the angle of i
    relative to the arm when j is in line with the arm [rad]. Source: Norton, ch. 9. Signs: relative to the
    arm the wheel and the ring turn in the same direction. All angles are counter-clockwise positive.
    """
    return joint("internal_gear", [("i", "Planar", i), ("j", "Planar", j), ("arm", "Planar", arm), ("r_i",
        "f64", r_i), ("r_j", "f64", r_j), ("phase", "f64", phase)])


def belt(
    i: PlanarLike,
    j: PlanarLike,
    frame: PlanarLike,
    r_i: NumberLike,
    r_j: NumberLike,
    phase: NumberLike,
) -> Joint:
    """Couples two pulleys by a belt or chain: r_i (θ_i − θ_frame − φ) − r_j (θ_j − θ_frame) = 0. [m]

    Removes 1 freedom. `i` and `j` are the pulleys. `frame` is the body that carries both axles. `r_i` and
    `r_j` are the pitch radii [m]; for a crossed belt give one negative radius. `phase` is φ, the angle of i
    relative to the frame when j is in line with the frame [rad]. The belt neither slips nor stretches.
    Source: Norton, ch. 9. Signs: relative to the frame an open belt turns both pulleys in the same
    direction, a crossed belt in opposite directions. All angles are counter-clockwise positive.
    """
    return joint("belt", [("i", "Planar", i), ("j", "Planar", j), ("frame", "Planar", frame), ("r_i", "f64",
        r_i), ("r_j", "f64", r_j), ("phase", "f64", phase)])


def rack_and_pinion(
    i: PlanarLike,
    j: PlanarLike,
    u_i: Vec2Like,
    u_j: Vec2Like,
    h_j: Vec2Like,
    radius: NumberLike,
    phase: NumberLike,
) -> Joint:
    """Meshes a pinion with a rack: h_j · (s − ū_j) + r (θ_i − θ_j − φ) = 0, where s is the pinion's centre in
    the rack's frame. [m]

    Removes 1 freedom. `i` is the pinion, `u_i` its centre [m] and `radius` its pitch radius r [m]. `j` is
    the rack, `u_j` a point of its pitch line [m] and `h_j` the direction of the pitch line, of any length.
    `phase` is φ, the angle of the pinion relative to the rack when the pinion's centre is over `u_j` [rad].
    Source: Norton, ch. 9. Measures: `slide`, the displacement of the centre along h_j; `angle`, θ_i − θ_j.
    Signs: the pinion is to the left of h_j; with a negative radius it is to the right. When the pinion
    moves along h_j in the rack, it turns clockwise. A pinion that turns counter-clockwise in place moves
    the rack along h_j. The angle is counter-clockwise positive.
    """
    return joint("rack_and_pinion", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j",
        "Vec2", u_j), ("h_j", "Vec2", h_j), ("radius", "f64", radius), ("phase", "f64", phase)])


def rolling(
    i: PlanarLike,
    j: PlanarLike,
    u_i: Vec2Like,
    u_j: Vec2Like,
    h_j: Vec2Like,
    radius: NumberLike,
    phase: NumberLike,
) -> Joint:
    """Rolls a wheel on a straight track without slip: h_j × (s − ū_j) − r = 0 and h_j · (s − ū_j) + r (θ_i −
    θ_j − φ) = 0. [m, m]

    Removes 2 freedoms: the first row keeps contact, the second prevents slip. The vector s is the wheel's
    centre in the frame of the track. `i` is the wheel, `u_i` its centre [m] and `radius` its radius r [m].
    `j` is the track, `u_j` a point of its line [m] and `h_j` the direction of the line, of any length.
    `phase` is φ, the angle of the wheel relative to the track when the wheel's centre is over `u_j` [rad].
    Source: Haug, section 3.4. Measures: `slide`, the displacement of the centre along h_j; `angle`, θ_i −
    θ_j. Signs: the wheel is to the left of h_j. When the wheel moves along h_j, it turns clockwise. The
    angle is counter-clockwise positive.
    """
    return joint("rolling", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j", "Vec2",
        u_j), ("h_j", "Vec2", h_j), ("radius", "f64", radius), ("phase", "f64", phase)])


def coupling(a: CoordinateLike, b: CoordinateLike, k_a: NumberLike, k_b: NumberLike, c: NumberLike) -> Joint:
    """Couples two coordinates linearly: k_a a + k_b b − c = 0. [unit of c]

    Removes 1 freedom. `a` and `b` are scalar coordinates or coordinates of bodies (`wheel.theta()`,
    `rack.x()`). `k_a` and `k_b` are the factors, and `c` is the sum. For more than two coordinates use
    `linear_coupling`. Source: Norton, ch. 9. Signs: with k_a = k_b the coordinates move in opposite
    directions.
    """
    return joint("coupling", [("a", "Coord", a), ("b", "Coord", b), ("k_a", "f64", k_a), ("k_b", "f64",
        k_b), ("c", "f64", c)])


def linear_coupling(q: Sequence[CoordinateLike], k: Sequence[NumberLike], c: NumberLike) -> Joint:
    """Couples two to six coordinates linearly: Σ k_n q_n − c = 0. [unit of c]

    Removes 1 freedom. `q` are scalar coordinates or coordinates of bodies (`wheel.theta()`, `rack.x()`).
    `k` contains one factor for each coordinate, and `c` is the sum. Use this coupling for a differential, a
    planetary train or a platform on ropes and pulleys. To drive a sum, couple the sum with a separate
    coordinate and drive the separate coordinate. Source: Norton, Design of Machinery, ch. 9. Signs: each
    coordinate has its usual sign.
    """
    return joint("linear_coupling", [("q", "[Coord; N]", q), ("k", "[f64; N]", k), ("c", "f64", c)])


def moving_point(i: PlanarLike, j: PlanarLike, x_i: LawLike, y_i: LawLike, u_j: Vec2Like) -> Joint:
    """Holds a point that moves in body i by laws of time on a point of body j: R_i + A_i ū_i(t) − R_j − A_j
    ū_j = 0. [m]

    Removes 2 freedoms. `x_i` and `y_i` are the laws of the local position ū_i(t) in body i [m]. `u_j` is
    the local position in body j [m]. The derivatives of the equation contain the relative velocity A ū̇ and
    the Coriolis term 2 θ̇ A_θ ū̇. Source: lecture notes, "Moving Point on Rigid Body". Signs: the laws give
    coordinates in the frame of body i.
    """
    return joint("moving_point", [("i", "Planar", i), ("j", "Planar", j), ("x_i", "Law", x_i), ("y_i",
        "Law", y_i), ("u_j", "Vec2", u_j)])


def point_on_path(
    i: PlanarLike,
    j: PlanarLike,
    s: CoordinateLike,
    x_i: LawLike,
    y_i: LawLike,
    u_j: Vec2Like,
) -> Joint:
    """Holds a point that moves along a path in body i on a point of body j: R_i + A_i ū_i(s) − R_j − A_j ū_j =
    0. [m]

    Removes 2 freedoms and adds one coordinate, `s` along the path, so the joint removes 1 freedom in total.
    `x_i` and `y_i` are the laws of the local position ū_i(s) in body i [m]. `u_j` is the local position in
    body j [m]. Use this joint for a block in a curved slot. Source: lecture notes, "Moving Point on Rigid
    Body". Signs: the laws give coordinates in the frame of body i. `s` grows in the direction of the path.
    """
    return joint("point_on_path", [("i", "Planar", i), ("j", "Planar", j), ("s", "Coord", s), ("x_i", "Law",
        x_i), ("y_i", "Law", y_i), ("u_j", "Vec2", u_j)])


def drive(q: CoordinateLike, law: LawLike) -> Joint:
    """Makes a coordinate follow a law of time: q − f(t) = 0. [unit of q]

    `q` is a scalar coordinate or a coordinate of a body: `body.theta()`, `body.x()`. `law` is f. Source:
    lecture notes, "Driving Constraints". Signs: each coordinate has its usual sign. R_x and R_y of a body
    are global coordinates, and θ of a body is positive counter-clockwise.
    """
    return joint("drive", [("q", "Coord", q), ("law", "Law", law)])


def drive_angle(body: PlanarLike, law: LawLike) -> Joint:
    """Makes the angle of a body follow a law of time: θ − f(t) = 0. [rad]

    `law` is f [rad]. Kin does not wrap angles, so the law can count full revolutions. Source: lecture
    notes, "Driving Constraints". Signs: θ is counter-clockwise positive, from the global x-axis to the
    x-axis of the body.
    """
    return joint("drive_angle", [("body", "Planar", body), ("law", "Law", law)])


def drive_relative_angle(i: PlanarLike, j: PlanarLike, law: LawLike) -> Joint:
    """Makes the angle between two bodies follow a law of time: θ_i − θ_j − f(t) = 0. [rad]

    `law` is f [rad]; the law can count full revolutions. Use this driver for a motor on body j that turns
    body i. Source: Haug, section 3.5. Signs: the angle is the rotation of i relative to j, counter-
    clockwise positive.
    """
    return joint("drive_relative_angle", [("i", "Planar", i), ("j", "Planar", j), ("law", "Law", law)])


def drive_slide(
    i: PlanarLike,
    j: PlanarLike,
    u_i: Vec2Like,
    u_j: Vec2Like,
    h_j: Vec2Like,
    law: LawLike,
) -> Joint:
    """Makes a displacement along a line of body j follow a law of time: h_j · (s − ū_j) − f(t) = 0, where s is
    P_i in the frame of j. [m]

    `u_i` is the local position of P_i in body i [m]. `u_j` is the point of body j where the displacement is
    zero [m]. `h_j` is the direction of the line in body j, of any length. `law` is f [m]. Use this driver
    for a cylinder or a linear motor. Source: Haug, section 3.5. Signs: the displacement grows as P_i moves
    along h_j in j.
    """
    return joint("drive_slide", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j",
        "Vec2", u_j), ("h_j", "Vec2", h_j), ("law", "Law", law)])


def drive_distance(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like, law: LawLike) -> Joint:
    """Makes the distance of two points follow a law of time: |r_Pi − r_Pj| − f(t) = 0. [m]

    `u_i` and `u_j` are the local positions of the points in body i and body j [m]. `law` is f [m]. The law
    must remain positive, because the distance has no derivative where the points coincide. Use this driver
    for a hydraulic cylinder. Source: Haug, section 3.5. Signs: the distance is always positive.
    """
    return joint("drive_distance", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j",
        "Vec2", u_j), ("law", "Law", law)])


def drive_point(body: PlanarLike, u: Vec2Like, path_x: LawLike, path_y: LawLike) -> Joint:
    """Makes a point of a body follow a path: r_P − (f1(t), f2(t)) = 0. [m]

    `u` is the local position of P [m]. `path_x` and `path_y` are f1 and f2 [m]. Source: lecture notes,
    "Driving Constraints". Signs: the laws give global coordinates.
    """
    return joint("drive_point", [("body", "Planar", body), ("u", "Vec2", u), ("path_x", "Law", path_x),
        ("path_y", "Law", path_y)])


def drive_point_along(body: PlanarLike, u: Vec2Like, n: Vec2Like, law: LawLike) -> Joint:
    """Makes one coordinate of a point follow a law of time: n · r_P − f(t) = 0. [m]

    `u` is the local position of P [m]. `n` is the global direction of the coordinate, of any length. `law`
    is f [m]. Source: Haug, section 3.5. Signs: the coordinate grows along `n`, from the global origin.
    """
    return joint("drive_point_along", [("body", "Planar", body), ("u", "Vec2", u), ("n", "Vec2", n), ("law",
        "Law", law)])


__all__ = [
    "angle",
    "belt",
    "cam_flat_face",
    "cam_knife_edge",
    "cam_roller",
    "coupling",
    "distance",
    "drive",
    "drive_angle",
    "drive_distance",
    "drive_point",
    "drive_point_along",
    "drive_relative_angle",
    "drive_slide",
    "fixed",
    "gear",
    "internal_gear",
    "linear_coupling",
    "moving_point",
    "parallel",
    "pin_in_slot",
    "point_on_circle",
    "point_on_curve",
    "point_on_line",
    "point_on_path",
    "prismatic",
    "rack_and_pinion",
    "revolute",
    "rolling",
    "weld",
]
