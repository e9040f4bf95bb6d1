"""Joints of the library written again in Python, each with the joint that it is and values for its arguments."""

from typing import Annotated, Sequence

import numpy as np

import kin
from kin import Axis, Coord, EulerParameters, Law, Planar, Spatial, Time, Vec2, Vec3, constraint

A2, B2, C2 = (0.3, -0.2), (-0.15, 0.25), (0.8, 0.6)
A3, B3, C3 = (0.3, -0.2, 0.1), (-0.15, 0.25, 0.4), (0.6, 0.8, -0.3)
H, K = Axis((0.2, 0.3, 0.9), (1, 0, 0)), Axis((0.1, -0.4, 0.8))
P = (0.9, 0.1, -0.3, 0.2)
LAW, OTHER, THIRD = Law.sine(0.4, 1.3, 0.2), Law.polynomial([0.1, 0.3, -0.2, 0.05]), Law.linear(0.2, 0.7)
PROFILE = Law.harmonic(0.5, 0.1)


@constraint
def py_gear(i: Planar, j: Planar, arm: Planar, r_i: float, r_j: float, phase: float):
    """Pair of gears on an arm.   [m]"""
    return r_i * (i.theta - arm.theta - phase) + r_j * (j.theta - arm.theta)


@constraint
def py_belt(i: Planar, j: Planar, frame: Planar, r_i, r_j, phase):
    return r_i * (i.theta - frame.theta - phase) - r_j * (j.theta - frame.theta)


@constraint
def py_rack_and_pinion(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_j: Vec2, radius: float, phase: float):
    s = j.local(i.point(u_i)) - u_j
    return h_j.normalize() @ s + radius * (i.theta - j.theta - phase)


@constraint
def py_rolling(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_j: Vec2, radius: float, phase: float):
    s, h = j.local(i.point(u_i)) - u_j, h_j.normalize()
    return np.cross(h, s) - radius, np.dot(h, s) + radius * (i.theta - j.theta - phase)


@constraint
def py_coupling(a: Coord, b: Coord, k_a: float, k_b: float, c: float):
    return k_a * a + k_b * b - c


@constraint
def py_linear_coupling(q: Annotated[Sequence[Coord], 3], k: Annotated[Sequence[float], 3], c: float):
    return sum(x * y for x, y in zip(k, q)) - c


@constraint
def py_point_on_curve(i: Planar, j: Planar, u_i: Vec2, curve: Law):
    s = j.local(i.point(u_i))
    return s.y - curve.at(s.x)


@constraint
def py_cam_knife_edge(cam: Planar, follower: Planar, tip: Vec2, profile: Law):
    s = cam.local(follower.point(tip))
    return s.norm() - profile.at(kin.atan2(s.y, s.x))


@constraint
def py_cam_flat_face(cam: Planar, follower: Planar, u: Vec2, n: Vec2, support: Law):
    normal = n / kin.hypot(n.x, n.y)
    psi = follower.theta - cam.theta + np.arctan2(normal.y, normal.x)
    return follower.direction(normal).dot(follower.point(u) - cam.r) - support.at(psi)


@constraint
def py_cam_roller(cam: Planar, follower: Planar, phi: Coord, centre: Vec2, radius: float, profile: Law):
    s = cam.local(follower.point(centre))
    e = kin.vec2(np.cos(phi), np.sin(phi))
    rho, slope = profile.at(phi), profile.slope(phi)
    share = radius / (rho**2 + slope**2) ** 0.5
    return s.dot(e) - rho - share * rho, e.cross(s) + share * slope


@constraint
def py_moving_point(i: Planar, j: Planar, x_i: Law, y_i: Law, u_j: Vec2, t: Time):
    return i.point((x_i.at(t), y_i.at(t))) - j.point(u_j)


@constraint
def py_point_on_path(i: Planar, j: Planar, s: Coord, x_i: Law, y_i: Law, u_j: Vec2):
    return i.point([x_i.at(s), y_i.at(s)]) - j.point(u_j)


@constraint
def py_fixed(j: Planar, r: Vec2, theta: float):
    return [*(j.r - r), j.theta - theta]


@constraint
def py_revolute(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2):
    return i.point(u_i) - j.point(u_j)


@constraint
def py_weld(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, theta0: float):
    return i.point(u_i) - j.point(u_j), i.theta - j.theta - theta0


@constraint
def py_distance(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, length: float):
    kin.require(length > 0, "the length of the rod must be above zero")
    d = i.point(u_i) - j.point(u_j)
    return 0.5 * (d.norm_squared() / length - length)


@constraint
def py_angle(i: Planar, j: Planar, theta0: float):
    return i.theta - j.theta - theta0


@constraint
def py_parallel(i: Planar, j: Planar, h_i: Vec2, h_j: Vec2):
    return i.direction(h_i).cross(j.direction(h_j))


@constraint
def py_prismatic(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: float):
    return i.theta - j.theta - theta0, i.direction(h_i) @ (i.point(u_i) - j.point(u_j))


@constraint
def py_point_on_line(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_j: Vec2):
    return h_j.cross(j.local(i.point(u_i)) - u_j)


@constraint
def py_pin_in_slot(i: Planar, j: Planar, u_i: Vec2, a_j: Vec2, b_j: Vec2):
    kin.measure("slide", (b_j - a_j).dot(j.local(i.point(u_i)) - a_j) / (b_j - a_j).norm(), "m")
    return (b_j - a_j).normalize().cross(j.local(i.point(u_i)) - a_j)


@constraint
def py_point_on_circle(i: Planar, j: Planar, u_i: Vec2, c_j: Vec2, radius: float):
    s = i.point(u_i) - j.point(c_j)
    return 0.5 * ((s.x**2 + s.y**2) / radius - radius)


@constraint
def py_drive(q: Coord, law: Law, t: Time):
    return q - law.at(t)


@constraint
def py_drive_relative_angle(i: Planar, j: Planar, law: Law, t: Time):
    return i.theta - j.theta - law(t)


@constraint
def py_drive_slide(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_j: Vec2, law: Law, t: Time):
    return h_j.normalize().dot(j.local(i.point(u_i)) - u_j) - law.at(t)


@constraint
def py_drive_distance(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, law: Law, t: Time):
    return np.hypot(*(i.point(u_i) - j.point(u_j))) - law.at(t)


@constraint
def py_drive_point(body: Planar, u: Vec2, path_x: Law, path_y: Law, t: Time):
    return body.point(u) - (path_x.at(t), path_y.at(t))


@constraint
def py_drive_point_along(body: Planar, u: Vec2, n: Vec2, law: Law, t: Time):
    return n.normalize().dot(body.point(u)) - law.at(t)


@constraint
def py_s_spherical(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3):
    return i.point(u_i) - j.point(u_j)


@constraint
def py_s_distance(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, length: float):
    d = i.point(u_i) - j.point(u_j)
    return 0.5 * (sum(x * x for x in d) / length - length)


@constraint
def py_s_point_on_line(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_j: Axis):
    d = i.point(u_i) - j.point(u_j)
    return [j.direction(across).dot(d) for across in (h_j.f, h_j.g)]


@constraint
def py_s_point_in_plane(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_j: Vec3):
    return j.direction(h_j).dot(i.point(u_i) - j.point(u_j))


@constraint
def py_s_point_coordinate(body: Spatial, u: Vec3, n: Vec3, value: float):
    return n.dot(body.point(u)) - value


@constraint
def py_s_parallel(i: Spatial, j: Spatial, h_i: Axis, h_j: Vec3):
    h = j.direction(h_j)
    return i.direction(h_i.f).dot(h), i.direction(h_i.g).dot(h)


@constraint
def py_s_perpendicular(i: Spatial, j: Spatial, h_i: Vec3, h_j: Vec3):
    return np.dot(i.a() @ h_i, j.a() @ h_j)


@constraint
def py_s_angle(i: Spatial, j: Spatial, h_i: Axis, h_j: Axis, alpha: float):
    return i.direction(h_i.h).dot(j.direction(h_j.h)) - kin.cos(alpha)


@constraint
def py_s_moving_point(i: Spatial, j: Spatial, x_i: Law, y_i: Law, z_i: Law, u_j: Vec3, t: Time):
    return i.point((x_i.at(t), y_i.at(t), z_i.at(t))) - j.point(u_j)


@constraint
def py_s_fixed(j: Spatial, r: Vec3, p0: EulerParameters):
    return j.r - r, p0.conjugate().product(j.p).vector()


@constraint
def py_s_weld(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, p_ij: EulerParameters):
    return i.point(u_i) - j.point(u_j), p_ij.conjugate().product(j.p.conjugate().product(i.p)).vector()


@constraint
def py_s_revolute(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_i: Axis, h_j: Vec3):
    h = j.direction(h_j)
    return i.point(u_i) - j.point(u_j), i.direction(h_i.f).dot(h), i.direction(h_i.g).dot(h)


@constraint
def py_s_prismatic(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_i: Axis, p_ij: EulerParameters):
    d = i.point(u_i) - j.point(u_j)
    turn = p_ij.conjugate().product(j.p.conjugate().product(i.p)).vector()
    return turn, i.direction(h_i.f).dot(d), i.direction(h_i.g).dot(d)


@constraint
def py_s_cylindrical(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_i: Axis, h_j: Vec3):
    f, g, h = i.direction(h_i.f), i.direction(h_i.g), j.direction(h_j)
    d = i.point(u_i) - j.point(u_j)
    return np.array([f.dot(h), g.dot(h), f.dot(d), g.dot(d)])


@constraint
def py_s_universal(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_i: Vec3, h_j: Vec3):
    return i.point(u_i) - j.point(u_j), i.direction(h_i).dot(j.direction(h_j))


@constraint
def py_s_planar(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_i: Axis, h_j: Vec3):
    h = j.direction(h_j)
    return i.direction(h_i.f).dot(h), i.direction(h_i.g).dot(h), h.dot(i.point(u_i) - j.point(u_j))


def turned_back(x, y, angle):
    """The angle of (x, y), taken back by another: a helper that is traced with its caller."""
    sin, cos = np.sin(angle), np.cos(angle)
    return kin.atan2(y * cos - x * sin, x * cos + y * sin)


@constraint
def py_s_screw(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_i: Axis, h_j: Axis, lead: float):
    f, g, h = j.direction(h_j.f), j.direction(h_j.g), i.direction(h_i.h)
    d = i.point(u_i) - j.point(u_j)
    turn = i.direction(h_i.f)
    way = 2 * np.pi / lead * j.direction(h_j.h).dot(d)
    return [f.dot(h), g.dot(h), f.dot(d), g.dot(d), turned_back(f.dot(turn), g.dot(turn), way)]


@constraint
def py_s_constant_velocity(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_i: Axis, h_j: Axis):
    twist = i.direction(h_i.f).dot(j.direction(h_j.g)) - i.direction(h_i.g).dot(j.direction(h_j.f))
    return i.point(u_i) - j.point(u_j), twist


@constraint
def py_s_relative_angle(i: Spatial, j: Spatial, phi: Coord, h_i: Axis, h_j: Axis):
    f = i.direction(h_i.f)
    return turned_back(f.dot(j.direction(h_j.f)), f.dot(j.direction(h_j.g)), phi)


@constraint
def py_s_drive_rotation(i: Spatial, j: Spatial, h_j: Axis, law: Law, t: Time):
    half = 0.5 * law.at(t)
    sin, cos = kin.sin(half), kin.cos(half)
    back = EulerParameters(cos, *(-sin * one for one in h_j.h))
    return back.product(j.p.conjugate().product(i.p)).vector()


@constraint
def py_s_spherical_cylindrical(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_j: Axis, length: float):
    d = i.point(u_i) - j.point(u_j)
    f, g = j.direction(h_j.f).dot(d), j.direction(h_j.g).dot(d)
    return 0.5 * ((f * f + g * g) / length - length)


@constraint
def py_s_revolute_spherical(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_i: Vec3, length: float):
    d = j.point(u_j) - i.point(u_i)
    return i.direction(h_i).dot(d), 0.5 * (d.norm_squared() / length - length)


@constraint
def py_s_drive_distance(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, law: Law, t: Time):
    return (i.point(u_i) - j.point(u_j)).norm() - law.at(t)


# The function, the joint that it is, and the values of its parameters.
REWRITTEN = [
    (py_gear, kin.gear, [0.1, 0.2, 0.05]),
    (py_belt, kin.belt, [0.1, 0.2, 0.05]),
    (py_rack_and_pinion, kin.rack_and_pinion, [A2, B2, C2, 0.3, 0.1]),
    (py_rolling, kin.rolling, [A2, B2, C2, 0.3, 0.1]),
    (py_coupling, kin.coupling, [0.7, -1.2, 0.3]),
    (py_linear_coupling, kin.linear_coupling, [[0.7, -1.2, 0.4], 0.3]),
    (py_point_on_curve, kin.point_on_curve, [A2, OTHER]),
    (py_cam_knife_edge, kin.cam_knife_edge, [A2, PROFILE]),
    (py_cam_flat_face, kin.cam_flat_face, [A2, C2, PROFILE]),
    (py_cam_roller, kin.cam_roller, [A2, 0.1, PROFILE]),
    (py_moving_point, kin.moving_point, [LAW, OTHER, A2]),
    (py_point_on_path, kin.point_on_path, [LAW, OTHER, A2]),
    (py_fixed, kin.fixed, [A2, 0.4]),
    (py_revolute, kin.revolute, [A2, B2]),
    (py_weld, kin.weld, [A2, B2, 0.4]),
    (py_distance, kin.distance, [A2, B2, 0.9]),
    (py_angle, kin.angle, [0.4]),
    (py_parallel, kin.parallel, [C2, (0.9, 0.3)]),
    (py_prismatic, kin.prismatic, [A2, B2, C2, 0.4]),
    (py_point_on_line, kin.point_on_line, [A2, B2, C2]),
    (py_pin_in_slot, kin.pin_in_slot, [A2, B2, C2]),
    (py_point_on_circle, kin.point_on_circle, [A2, B2, 0.9]),
    (py_drive, kin.drive, [LAW]),
    (py_drive_relative_angle, kin.drive_relative_angle, [LAW]),
    (py_drive_slide, kin.drive_slide, [A2, B2, C2, LAW]),
    (py_drive_distance, kin.drive_distance, [A2, B2, LAW]),
    (py_drive_point, kin.drive_point, [A2, LAW, OTHER]),
    (py_drive_point_along, kin.drive_point_along, [A2, C2, LAW]),
    (py_s_spherical, kin.spatial.spherical, [A3, B3]),
    (py_s_distance, kin.spatial.distance, [A3, B3, 0.9]),
    (py_s_point_on_line, kin.spatial.point_on_line, [A3, B3, K]),
    (py_s_point_in_plane, kin.spatial.point_in_plane, [A3, B3, C3]),
    (py_s_point_coordinate, kin.spatial.point_coordinate, [A3, C3, 0.4]),
    (py_s_parallel, kin.spatial.parallel, [H, C3]),
    (py_s_perpendicular, kin.spatial.perpendicular, [C3, B3]),
    (py_s_angle, kin.spatial.angle, [H, K, 0.7]),
    (py_s_moving_point, kin.spatial.moving_point, [LAW, OTHER, THIRD, A3]),
    (py_s_fixed, kin.spatial.fixed, [A3, P]),
    (py_s_weld, kin.spatial.weld, [A3, B3, P]),
    (py_s_revolute, kin.spatial.revolute, [A3, B3, H, C3]),
    (py_s_prismatic, kin.spatial.prismatic, [A3, B3, H, P]),
    (py_s_cylindrical, kin.spatial.cylindrical, [A3, B3, H, C3]),
    (py_s_universal, kin.spatial.universal, [A3, B3, C3, (0.3, 0.1, 0.9)]),
    (py_s_planar, kin.spatial.planar, [A3, B3, H, C3]),
    (py_s_screw, kin.spatial.screw, [A3, B3, H, K, 0.9]),
    (py_s_constant_velocity, kin.spatial.constant_velocity, [A3, B3, H, K]),
    (py_s_relative_angle, kin.spatial.relative_angle, [H, K]),
    (py_s_drive_rotation, kin.spatial.drive_rotation, [K, LAW]),
    (py_s_spherical_cylindrical, kin.spatial.spherical_cylindrical, [A3, B3, K, 0.9]),
    (py_s_revolute_spherical, kin.spatial.revolute_spherical, [A3, B3, C3, 0.9]),
    (py_s_drive_distance, kin.spatial.drive_distance, [A3, B3, LAW]),
]
