"""Joints, couplings and drivers of planar bodies and coordinates.

Made from docs/library.md by `python tools/library.py`; do not edit.
"""

from __future__ import annotations

from typing import Sequence

from ._dimension import NumberLike
from ._handles import CoordinateLike, PlanarLike, SpatialLike
from ._joint import AxisLike, EulerLike, Joint, LawLike, Vec2Like, Vec3Like, joint


def fixed(j: PlanarLike, r: Vec2Like, theta: NumberLike) -> Joint:
    """A body that does not move: R = r, θ = θ0. [m, m, rad]

    Removes 3 freedoms. `r`: R; `theta`: θ0. The lecture's ground is a body with this constraint at the
    origin ("Constraint Equations"). Signs: `theta` counter-clockwise from the global x-axis.
    """
    return joint("fixed", [("j", "Planar", j), ("r", "Vec2", r), ("theta", "f64", theta)])


def revolute(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like) -> Joint:
    """Pin joint: point P is common to both bodies, R_i + A_i ū_i − R_j − A_j ū_j = 0. [m]

    Removes 2 freedoms. `u_i`, `u_j`: local position of P in either body. Lecture, "Constraint Library:
    Revolute"; Shabana, Computational Dynamics, 3rd ed., section 3.4. Measure: `angle`, θ_i − θ_j. Signs:
    the angle is the turn of i in j, counter-clockwise positive, zero where their x-axes are parallel, and
    never wrapped.
    """
    return joint("revolute", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j", "Vec2",
        u_j)])


def weld(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like, theta0: NumberLike) -> Joint:
    """Rigid connection: r_Pi − r_Pj = 0 and θ_i − θ_j − θ0 = 0. [m, rad]

    Removes 3 freedoms. `u_i`, `u_j`: local position of P in either body; `theta0`: θ0. Shabana, section
    3.4. Signs: `theta0` is the turn of i in j, counter-clockwise positive.
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
    """Sliding joint: θ_i − θ_j − θ0 = 0 and h_i · (r_Pi − r_Pj) = 0. [rad, m]

    Removes 2 freedoms. `u_i`, `u_j`: local positions of a point on the slide in either body; `h_i`: local
    direction in body i perpendicular to the slide (its length scales the second row); `theta0`: θ0.
    Lecture, "Constraint Library: Prismatic". What is fixed in body i is written in its own frame, h_i · A_i
    ū_i = h̄_i · ū_i: the same equation, with a quarter less to compute. Measure: `slide`, how far P_i is
    from P_j along the slide. Signs: the slide grows as i moves in j with h_i to the left of its way (h_i
    along y: to the right, along x of body i). `theta0` is the turn of i in j, counter-clockwise positive.
    """
    return joint("prismatic", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j", "Vec2",
        u_j), ("h_i", "Vec2", h_i), ("theta0", "f64", theta0)])


def distance(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like, length: NumberLike) -> Joint:
    """Rod without mass between two pins: (|r_Pi − r_Pj|² − l²)/(2 l) = 0. [m]

    Removes 1 freedom. `u_i`, `u_j`: the pins; `length`: l. Near the solution this is |r_Pi − r_Pj| − l, but
    it has no singular slope where the pins meet. Haug, Computer Aided Kinematics and Dynamics, section 3.3.
    Signs: none; `length` is above zero, and the rod may point anywhere.
    """
    return joint("distance", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j", "Vec2",
        u_j), ("length", "f64", length)])


def angle(i: PlanarLike, j: PlanarLike, theta0: NumberLike) -> Joint:
    """Bodies at a fixed angle: θ_i − θ_j − θ0 = 0. [rad]

    Removes 1 freedom. `theta0`: θ0, which is not wrapped: a full turn is another angle. Lecture,
    "Constraint Library: Prismatic", its first row. Signs: `theta0` is the turn of i in j, counter-clockwise
    positive.
    """
    return joint("angle", [("i", "Planar", i), ("j", "Planar", j), ("theta0", "f64", theta0)])


def parallel(i: PlanarLike, j: PlanarLike, h_i: Vec2Like, h_j: Vec2Like) -> Joint:
    """Parallel directions: h_i × h_j = 0. [–]

    Removes 1 freedom. `h_i`, `h_j`: local directions, whose lengths scale the row. The equation holds for
    opposite directions too; a position found with h_i · h_j < 0 is an error. Shabana, section 3.4. Signs:
    h_i and h_j point the same way; the row is positive where h_j is counter-clockwise of h_i.
    """
    return joint("parallel", [("i", "Planar", i), ("j", "Planar", j), ("h_i", "Vec2", h_i), ("h_j", "Vec2",
        h_j)])


def point_on_line(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like, h_j: Vec2Like) -> Joint:
    """A point of body i stays on a line of body j: h_j × (s − ū_j) = 0, s the point as body j sees it. [m]

    Removes 1 freedom. `u_i`: the point; `u_j`: a point of the line, `h_j`: its direction, whose length
    scales the row. Haug, section 3.3: revolute–translational joint. Measures: `slide`, the point's way from
    ū_j along h_j; `angle`, θ_i − θ_j. Signs: the slide grows along h_j, the row to the left of it; the
    angle is the turn of i in j, counter-clockwise positive.
    """
    return joint("point_on_line", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j",
        "Vec2", u_j), ("h_j", "Vec2", h_j)])


def pin_in_slot(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, a_j: Vec2Like, b_j: Vec2Like) -> Joint:
    """A pin of body i in a straight slot of body j, from A to B: (B − A) × (s − A)/|B − A| = 0, s the pin as
    body j sees it. [m]

    Removes 1 freedom. `u_i`: the pin; `a_j`, `b_j`: the ends of the slot's centre line. The ends do not
    stop the pin: a run tells by an event when it passes one. Measures: `slide`, the pin's way from A;
    `angle`, θ_i − θ_j. Signs: the slide grows from A towards B, the row to the left of that; the angle is
    the turn of i in j, counter-clockwise positive.
    """
    return joint("pin_in_slot", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("a_j",
        "Vec2", a_j), ("b_j", "Vec2", b_j)])


def point_on_circle(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, c_j: Vec2Like, radius: NumberLike) -> Joint:
    """A point of body i stays on a circle of body j: (|s − c_j|² − ρ²)/(2 ρ) = 0, s the point as body j sees
    it. [m]

    Removes 1 freedom. `u_i`: the point; `c_j`: the centre, `radius`: ρ. A circular slot, or a rod of length
    ρ. Haug, section 3.3. Measure: `angle`, where the point stands on the circle. Signs: the angle is
    counter-clockwise positive from the x-axis of body j; the row is positive outside of the circle.
    """
    return joint("point_on_circle", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("c_j",
        "Vec2", c_j), ("radius", "f64", radius)])


def point_on_curve(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, curve: LawLike) -> Joint:
    """A point of body i stays on the curve y = f(x) of body j: s_y − f(s_x) = 0, s the point as body j sees
    it. [m]

    Removes 1 freedom. `u_i`: the point; `curve`: f. Measures: `slide`, s_x; `angle`, θ_i − θ_j. Signs: the
    slide grows along x of body j, the row along its y; the angle is the turn of i in j, counter-clockwise
    positive.
    """
    return joint("point_on_curve", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("curve",
        "Law", curve)])


def cam_knife_edge(cam: PlanarLike, follower: PlanarLike, tip: Vec2Like, profile: LawLike) -> Joint:
    """Cam with a knife-edge follower: |s| − ρ(φ) = 0, s the tip and φ its angle as the cam sees them. [m]

    Removes 1 freedom. `tip`: local to the follower; `profile`: ρ, the distance of the cam's edge from the
    origin of its frame at the angle φ; it has to be 2π-periodic. Norton, Cam Design and Manufacturing
    Handbook. Measure: `contact`, φ. Signs: φ is counter-clockwise positive from the cam's own x-axis: as
    the cam turns counter-clockwise under a tip that stands still, φ falls. The row is positive outside of
    the cam.
    """
    return joint("cam_knife_edge", [("cam", "Planar", cam), ("follower", "Planar", follower), ("tip",
        "Vec2", tip), ("profile", "Law", profile)])


def cam_flat_face(cam: PlanarLike, follower: PlanarLike, u: Vec2Like, n: Vec2Like, support: LawLike) -> Joint:
    """Cam with a flat-faced follower: n · (r_P − R_cam) − h(ψ) = 0, n the face's normal and ψ its angle as the
    cam sees it. [m]

    Removes 1 freedom. `u`: a point P of the face, `n`: the direction across the face away from the cam,
    both local to the follower; `support`: h, the distance from the origin of the cam's frame to the edge's
    tangent whose normal stands at ψ; it has to be 2π-periodic. For a follower that slides, h is base radius
    plus lift (Norton, Cam Design and Manufacturing Handbook). The point of contact, which moves on the face
    by h′, is not needed. Signs: ψ is counter-clockwise positive from the cam's own x-axis; the row is
    positive where the face is off the cam.
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
    """Cam with a roller: s − ρ e(φ) − r n(φ) = 0, s the roller's centre as the cam sees it, n the normal of
    the edge at φ. [m, m]

    Removes 2 freedoms and adds one, the angle `phi` of the point of contact as the cam sees it: 1 in all.
    `centre`: of the roller, local to the follower; `radius`: r; `profile`: ρ(φ), the distance of the edge
    from the origin of the cam's frame, 2π-periodic. With T = (ρ′, ρ) in the directions e(φ) and across, n =
    (ρ, −ρ′)/|T|. A hollow edge must be less curved than the roller. Norton. Signs: φ is counter-clockwise
    positive from the cam's own x-axis; n points out of the cam, to the roller's side.
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
    """Pair of gears on an arm: r_i (θ_i − θ_arm − φ) + r_j (θ_j − θ_arm) = 0. [m]

    Removes 1 freedom. `i`, `j`: the wheels, whose axles sit on `arm` (the ground for axles that stand
    still); `r_i`, `r_j`: their pitch radii; `phase`: φ, the angle of i beside the arm when j is in line
    with it. Norton, Design of Machinery, ch. 9. Signs: seen from the arm the wheels turn against each
    other; all angles are counter-clockwise positive.
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
    """Gear in a ring on an arm: r_i (θ_i − θ_arm − φ) − r_j (θ_j − θ_arm) = 0. [m]

    Removes 1 freedom. `i`: the wheel with pitch radius `r_i`; `j`: the ring with inner teeth, pitch radius
    `r_j`; `arm`, `phase`: as for `gear`. Norton, ch. 9. Signs: seen from the arm wheel and ring turn the
    same way; all angles are counter-clockwise positive.
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
    """Belt or chain over two pulleys: r_i (θ_i − θ_frame − φ) − r_j (θ_j − θ_frame) = 0. [m]

    Removes 1 freedom. `i`, `j`: the pulleys with axles on `frame`; `r_i`, `r_j`: their pitch radii, one
    below zero for a crossed belt; `phase`: as for `gear`. The belt neither slips nor stretches. Norton, ch.
    9. Signs: seen from the frame an open belt turns both pulleys the same way, a crossed one against each
    other; all angles are counter-clockwise positive.
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
    """Rack and pinion: h_j · (s − ū_j) + r (θ_i − θ_j − φ) = 0, s the pinion's centre as the rack sees it. [m]

    Removes 1 freedom. `i`: the pinion, centre `u_i`, pitch radius `radius`: r; `j`: the rack, a point `u_j`
    and the direction `h_j` of its pitch line, of any length; `phase`: φ, the angle of the pinion in the
    rack when its centre stands over `u_j`. Norton, ch. 9. Measures: `slide`, the way of the centre along
    h_j; `angle`, θ_i − θ_j. Signs: the pinion is to the left of h_j (a negative radius: to its right). As
    it goes along h_j in the rack it turns clockwise; a pinion that turns counter-clockwise in place sends
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
    """Wheel that rolls without slip: h_j × (s − ū_j) − r = 0 and h_j · (s − ū_j) + r (θ_i − θ_j − φ) = 0. [m,
    m]

    Removes 2 freedoms: contact, and slip. `i`: the wheel, centre `u_i`, `radius`: r; `j`: the track, a
    point `u_j` and the direction `h_j` of its line, of any length; `phase`: φ, the angle of the wheel in
    the track when its centre stands over `u_j`. Haug, section 3.4. Measures: `slide`, the way of the centre
    along h_j; `angle`, θ_i − θ_j. Signs: the wheel is to the left of h_j; along h_j it turns clockwise. The
    angle is counter-clockwise positive.
    """
    return joint("rolling", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j", "Vec2",
        u_j), ("h_j", "Vec2", h_j), ("radius", "f64", radius), ("phase", "f64", phase)])


def coupling(a: CoordinateLike, b: CoordinateLike, k_a: NumberLike, k_b: NumberLike, c: NumberLike) -> Joint:
    """Linear coupling of two coordinates: k_a a + k_b b − c = 0. [unit of c]

    Removes 1 freedom. `a`, `b`: bare coordinates or those of bodies (`wheel.theta()`, `rack.x()`). Of more
    than two: `linear_coupling`. Norton, ch. 9. Signs: those of the coordinates; with k_a = k_b they go
    against each other.
    """
    return joint("coupling", [("a", "Coord", a), ("b", "Coord", b), ("k_a", "f64", k_a), ("k_b", "f64",
        k_b), ("c", "f64", c)])


def linear_coupling(q: Sequence[CoordinateLike], k: Sequence[NumberLike], c: NumberLike) -> Joint:
    """Linear coupling of two to six coordinates: Σ k_n q_n − c = 0. [unit of c]

    Removes 1 freedom. `q`: bare coordinates or those of bodies (`wheel.theta()`, `rack.x()`); `k`: a factor
    for each; `c`: what they add up to. A differential, a planetary train by its turns, a platform held by
    ropes over pulleys. To drive a sum, couple it with a separate coordinate and drive that. Norton, Design
    of Machinery, ch. 9. Signs: those of the coordinates.
    """
    return joint("linear_coupling", [("q", "[Coord; N]", q), ("k", "[f64; N]", k), ("c", "f64", c)])


def moving_point(i: PlanarLike, j: PlanarLike, x_i: LawLike, y_i: LawLike, u_j: Vec2Like) -> Joint:
    """A point that moves in body i by laws of time is a point of body j: R_i + A_i ū_i(t) − R_j − A_j ū_j = 0.
    [m]

    Removes 2 freedoms. `x_i`, `y_i`: ū_i(t); `u_j`: local position in body j. Relative velocity A ū̇ and
    the Coriolis term 2 θ̇ A_θ ū̇ come from the equation. Lecture, "Moving Point on Rigid Body". Signs: the
    laws are coordinates in the frame of body i.
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
    """A point that moves along a path in body i is a point of body j: R_i + A_i ū_i(s) − R_j − A_j ū_j = 0.
    [m]

    Removes 2 freedoms and adds one, the coordinate `s` along the path: 1 in all. A block in a slot. `x_i`,
    `y_i`: ū_i(s); `u_j`: local position in body j. Lecture, "Moving Point on Rigid Body". Signs: the laws
    are coordinates in the frame of body i; `s` grows the way they run.
    """
    return joint("point_on_path", [("i", "Planar", i), ("j", "Planar", j), ("s", "Coord", s), ("x_i", "Law",
        x_i), ("y_i", "Law", y_i), ("u_j", "Vec2", u_j)])


def drive(q: CoordinateLike, law: LawLike) -> Joint:
    """A coordinate follows a law of time: q − f(t) = 0. [unit of q]

    Any bare coordinate, or one of a body's: `body.theta()`, `body.x()`. Lecture, "Driving Constraints":
    simple driver. Signs: those of the coordinate; a body's R_x, R_y are global, its θ is counter-clockwise
    positive.
    """
    return joint("drive", [("q", "Coord", q), ("law", "Law", law)])


def drive_angle(body: PlanarLike, law: LawLike) -> Joint:
    """The angle of a body follows a law of time: θ − f(t) = 0. [rad]

    Angles are not wrapped, so the law may go on for any number of turns. Lecture, "Driving Constraints".
    Signs: counter-clockwise positive, from the global x-axis to the body's.
    """
    return joint("drive_angle", [("body", "Planar", body), ("law", "Law", law)])


def drive_relative_angle(i: PlanarLike, j: PlanarLike, law: LawLike) -> Joint:
    """The angle between two bodies follows a law of time: θ_i − θ_j − f(t) = 0. [rad]

    Any number of turns. A motor on body j that turns body i. Haug, section 3.5. Signs: the turn of i in j,
    counter-clockwise positive.
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
    """A slide follows a law of time: h_j · (s − ū_j) − f(t) = 0, s the point P_i as body j sees it. [m]

    `u_i`: P_i; `u_j`: from where, `h_j`: along which direction in body j, of any length. A cylinder or a
    linear motor. Haug, section 3.5. Signs: the slide grows as P_i moves along h_j in j.
    """
    return joint("drive_slide", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j",
        "Vec2", u_j), ("h_j", "Vec2", h_j), ("law", "Law", law)])


def drive_distance(i: PlanarLike, j: PlanarLike, u_i: Vec2Like, u_j: Vec2Like, law: LawLike) -> Joint:
    """The distance of two points follows a law of time: |r_Pi − r_Pj| − f(t) = 0. [m]

    `u_i`, `u_j`: the points. The law must stay above zero: where the points meet there is no slope. A
    hydraulic cylinder. Haug, section 3.5. Signs: none; a distance is above zero.
    """
    return joint("drive_distance", [("i", "Planar", i), ("j", "Planar", j), ("u_i", "Vec2", u_i), ("u_j",
        "Vec2", u_j), ("law", "Law", law)])


def drive_point(body: PlanarLike, u: Vec2Like, path_x: LawLike, path_y: LawLike) -> Joint:
    """A point of a body follows a path: r_P − (f1(t), f2(t)) = 0. [m]

    `u`: local position of P. Lecture, "Driving Constraints": complex driver. Signs: the laws are global
    coordinates.
    """
    return joint("drive_point", [("body", "Planar", body), ("u", "Vec2", u), ("path_x", "Law", path_x),
        ("path_y", "Law", path_y)])


def drive_point_along(body: PlanarLike, u: Vec2Like, n: Vec2Like, law: LawLike) -> Joint:
    """One coordinate of a point follows a law of time: n · r_P − f(t) = 0. [m]

    `u`: local position of P; `n`: the global direction along which it is measured, of any length. Haug,
    section 3.5. Signs: the coordinate grows along `n`, from the global origin.
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
