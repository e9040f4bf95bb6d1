//! Contact of curves: involutes, cycloids, cams, gears, wheels on rails.

use std::f64::consts::{FRAC_PI_2, PI};

use kin::prelude::*;

use crate::twice;

/// A tooth's flank by its base circle.   [m, rad]
#[derive(Clone, Debug)]
pub struct Flank {
    pub base: f64,
    pub start: f64,
    pub right: bool,
}

impl Flank {
    fn sign(&self) -> f64 {
        if self.right { 1.0 } else { -1.0 }
    }
}

twice! { Symbolic point_on_an_involute(planar coord (Flank { base: 0.8, start: 0.2, right: true })):
fn f(gear: Planar, roll: Coord, flank: Flank) -> Vec2 {
    let phi = flank.start + flank.sign() * roll;
    let radial = vec2(phi.cos(), phi.sin());
    let tangent = radial.perp() * -flank.sign();
    gear.local(vec2(1.0, 0.5)) - (radial + tangent * roll) * flank.base
} }

twice! { Symbolic two_involutes_touch(planar planar coord coord (0.7) (1.1)):
fn f(i: Planar, j: Planar, u: Coord, v: Coord, base_i: f64, base_j: f64) -> [f64; 3] {
    let involute = |base: f64, u: f64| vec2(u.cos() + u * u.sin(), u.sin() - u * u.cos()) * base;
    let normal = |u: f64| vec2(u.sin(), -u.cos());
    let gap = i.point(involute(base_i, u)) - j.point(involute(base_j, v));
    let parallel = i.direction(normal(u)).cross(j.direction(normal(v)));
    [gap.x, gap.y, parallel]
} }

twice! { Symbolic inverse_involute_by_newton(coord coord): fn f(inv: Coord, phi: Coord) -> f64 {
    let target = 0.05 + 0.01 * inv * inv;
    let mut alpha = (3.0 * target).cbrt();
    for _ in 0..5 {
        let tan = alpha.tan();
        alpha += (target - tan + alpha) / (tan * tan);
    }
    phi - alpha
} }

twice! { Symbolic over_pins(coord (20) (2.0) (3.5)): fn f(size: Coord, teeth: u32, module: f64, pin: f64) -> f64 {
    let z = f64::from(teeth);
    let pressure = 20f64.to_radians();
    let inv = |a: f64| a.tan() - a;
    let right = inv(pressure) + pin / (module * z * pressure.cos()) - FRAC_PI_2 / z;
    let over = |alpha: f64| module * z * pressure.cos() / alpha.cos() + pin;
    let mut alpha = pressure;
    for _ in 0..6 {
        alpha -= (inv(alpha) - right) / alpha.tan().powi(2);
    }
    over(alpha) * (if teeth % 2 == 0 { 1.0 } else { (FRAC_PI_2 / z).cos() }) - size
} }

twice! { Symbolic cycloid_on_a_line(planar coord): fn f(wheel: Planar, s: Coord) -> (Vec2, f64) {
    const R: f64 = 0.35;
    let trace = vec2(R * (s - s.sin()), R * (1.0 - s.cos()));
    let rolled = wheel.r.x - R * s;
    (wheel.point(vec2(0.0, -R)) - trace, rolled)
} }

twice! { Symbolic hypocycloid_with_three_cusps(coord coord coord): fn f(x: Coord, y: Coord, phi: Coord) -> Vec2 {
    let c = phi.cos();
    let s = phi.sin();
    let c2 = c * c - s * s;
    let s2 = 2.0 * s * c;
    vec2(x, y) - vec2(2.0 * c + c2, 2.0 * s - s2) / 3.0
} }

twice! { Symbolic wheel_on_an_uneven_rail(planar coord (0.46)): fn f(wheel: Planar, u: Coord, radius: f64) -> [f64; 2] {
    let height = |x: f64| 0.05 * (1.5 * x).sin() + 0.02 * (4.0 * x).cos();
    let slope = |x: f64| 0.075 * (1.5 * x).cos() - 0.08 * (4.0 * x).sin();
    let length = (1.0 + slope(u).powi(2)).sqrt();
    let [cx, cy] = [u - radius * slope(u) / length, height(u) + radius / length];
    [wheel.r.x - cx, wheel.r.y - cy]
} }

twice! { Symbolic disc_cam_with_a_roller(planar planar (0.1) (vec2(0.0, -0.2))):
fn f(cam: Planar, follower: Planar, roller: f64, axle: Vec2) -> f64 {
    let p = cam.local(follower.point(axle));
    let phi = p.y.atan2(p.x);
    let radius = 1.0 + 0.3 * (2.0 * phi).cos();
    let slope = -0.6 * (2.0 * phi).sin();
    p.norm() - radius - roller * (1.0 + (slope / radius).powi(2)).sqrt()
} }

twice! { Symbolic eccentric_and_flat(planar planar (0.15) (0.5)): fn f(eccentric: Planar, tappet: Planar, e: f64, r: f64) -> f64 {
    let centre = eccentric.point(Vec2::new(e, 0.0));
    let face = tappet.direction(Vec2::new(0.0, 1.0));
    (tappet.r - centre).dot(face) - r
} }

twice! { Symbolic circle_in_a_circle(planar planar (1.5) (0.4)): fn f(pin: Planar, hole: Planar, outer: f64, inner: f64) -> f64 {
    let Vec2 { x, y } = pin.r - hole.r;
    f64::hypot(x, y) - (outer - inner)
} }

twice! { Symbolic ellipse_rolling_on_its_twin(coord coord coord): fn f(a: Coord, b: Coord, d: Coord) -> [f64; 2] {
    let e = 0.5;
    let p = 1.0 - e * e;
    let polar = |phi: f64| p / (1.0 + e * phi.cos());
    let first = polar(a);
    let second = polar(PI - b);
    let true_to_mean = |phi: f64| 2.0 * (((1.0 - e) / (1.0 + e)).sqrt() * (0.5 * phi).tan()).atan();
    [first + second - d, true_to_mean(a) + true_to_mean(b)]
} }

twice! { Symbolic worm_flank(spatial (0.3) (4)): fn f(worm: Spatial, lead: f64, starts: usize) -> f64 {
    let p = worm.local(vec3(0.4, 0.1, 0.2));
    let turn = p.y.atan2(p.x);
    let pitch = lead * starts as f64 / (2.0 * PI);
    p.z - pitch * turn
} }

twice! { Symbolic bevel_pitch_cones(spatial spatial (0.5)): fn f(i: Spatial, j: Spatial, half: f64) -> (f64, f64) {
    let axis = Vec3::new(0.0, 0.0, 1.0);
    let hi = i.direction(axis);
    let hj = j.direction(axis);
    let angle = hi.dot(hj) - (2.0 * half).cos();
    (angle, (i.r - j.r).dot(hi.cross(hj)))
} }

twice! { Symbolic pin_in_a_geneva_slot(planar planar (1.0) (6)): fn f(driver: Planar, wheel: Planar, arm: f64, slots: i32) -> f64 {
    let half = PI / slots as f64;
    let pin = driver.point(vec2(arm * half.sin(), 0.0));
    let slot = wheel.direction(vec2((half).cos(), half.sin()));
    slot.cross(pin - wheel.r)
} }

twice! { Symbolic chain_over_two_sprockets(coord coord coord (17) (42) (0.0127)):
fn f(front: Coord, rear: Coord, distance: Coord, z1: i32, z2: i32, pitch: f64) -> [f64; 2] {
    let radius = |z: i32| pitch / (2.0 * (PI / z as f64).sin());
    let r1 = radius(z1);
    let r2 = radius(z2);
    let c = 0.4 + 0.05 * distance;
    let lean = ((r2 - r1) / c).asin();
    let length = 2.0 * c * lean.cos() + (PI - 2.0 * lean) * r1 + (PI + 2.0 * lean) * r2;
    [front * z1 as f64 - rear * z2 as f64, length - 114.0 * pitch]
} }

twice! { Symbolic crossed_belt(coord (0.5) (0.25) (6.0)): fn f(c: Coord, r: f64, s: f64, length: f64) -> f64 {
    let distance = 2.0 + 0.5 * c;
    let wrap = ((r + s) / distance).acos();
    let straight = ((distance + r + s) * (distance - r - s)).sqrt();
    let arc = PI - wrap;
    2.0 * (straight + (r + s) * arc) - length
} }

twice! { Symbolic parabola_against_a_circle(coord coord coord): fn f(u: Coord, x: Coord, y: Coord) -> (f64, f64) {
    let foot = (u, u * u);
    let normal = (-2.0 * u, 1.0);
    let size = f64::sqrt(normal.0 * normal.0 + normal.1 * normal.1);
    (x - foot.0 - normal.0 / size, y - foot.1 - normal.1 / size)
} }
