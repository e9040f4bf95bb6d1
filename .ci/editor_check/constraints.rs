//! Fifty constraints, of every kind of argument and with most of what a body can hold: what an
//! editor is shown.

use kin::prelude::*;

/// Most lift of the cam.   [m]
const MOST_LIFT: f64 = 0.02;

/// A parameter of one's own.
#[derive(Clone)]
pub struct Gains {
    pub k: f64,
    pub offset: Vec2,
}

impl Gains {
    pub fn scaled<D: Dual>(&self, x: Real<D>) -> Real<D> {
        x * self.k
    }
}

#[derive(Clone, Copy, PartialEq)]
pub enum Side {
    Left,
    Right,
}

fn wear<D: Dual>(phi: Real<D>, most: f64) -> Real<D> {
    most * phi.sin().powi(2)
}

fn table(x: f64) -> f64 {
    x * x
}

/// Pin joint.      [m]
#[constraint(symbolic)]
pub fn pin(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> Vec2 {
    i.point(u_i) - j.point(u_j)
}

#[constraint]
pub fn parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - k * s.x * s.x
}

#[constraint]
#[require(reach > 0.0, "a slot has a length")]
#[measure(along = j.local(i.point(u_i)).x, "m", ends = (-reach, reach))]
#[branch(i.theta < j.theta + 10.0, "it is turned over")]
pub fn slot(i: Planar, j: Planar, u_i: Vec2, reach: f64) -> f64 {
    j.local(i.point(u_i)).y
}

#[constraint]
pub fn slider_crank(theta3: Coord, x: Coord, t: Time, l2: f64, l3: f64, h: f64, omega: f64) -> [f64; 2] {
    let theta2 = omega * t;
    [l2 * theta2.cos() + l3 * theta3.cos() - x, l2 * theta2.sin() + l3 * theta3.sin() - h]
}

#[constraint]
pub fn on_cam(cam: Planar, follower: Planar, tip: Vec2, profile: Law) -> f64 {
    let p = cam.local(follower.point(tip));
    let phi = p.y.atan2(p.x);
    p.norm() - profile.at(phi) + wear(phi, MOST_LIFT) + profile.slope(phi)
}

#[constraint]
pub fn own_type(i: Planar, gains: Gains, t: Time) -> (f64, f64) {
    let r = i.point(gains.offset);
    (gains.scaled(r.x) - t, r.y - gains.k)
}

#[constraint]
pub fn by_series(x: Coord, h: f64) -> f64 {
    let (mut term, mut sum) = (x, x);
    while term.abs() > 1e-12 {
        term = -term * x * x;
        sum += term;
    }
    sum - h
}

#[constraint(dual)]
pub fn by_request(x: Coord, h: f64) -> f64 {
    (x - h) / MOST_LIFT
}

#[constraint]
pub fn chain(angles: [Coord; 4], lengths: [f64; 4], end: Vec2) -> Vec2 {
    let mut tip = vec2(0.0, 0.0);
    for (angle, length) in angles.iter().zip(lengths) {
        tip += vec2(angle.cos(), angle.sin()) * length;
    }
    tip - end
}

#[constraint]
pub fn sum_of_all(angles: [Coord; 3], n: usize, total: f64) -> f64 {
    let mut sum = 0.0;
    for k in 0..n.min(3) {
        sum += angles[k];
    }
    sum - total
}

#[constraint]
pub fn one_side(i: Planar, side: Side, width: f64) -> f64 {
    match side {
        Side::Left => i.r.x - width,
        Side::Right => i.r.x + width,
    }
}

#[constraint]
pub fn stop(i: Planar, at: f64) -> f64 {
    if i.r.x > at { i.r.x - at } else { i.r.y.max(0.0) }
}

#[constraint]
pub fn cylindrical(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_i: Axis, h_j: Vec3) -> (f64, f64, f64, f64) {
    let (f, g, h) = (i.direction(h_i.f), i.direction(h_i.g), j.direction(h_j));
    let d = i.point(u_i) - j.point(u_j);
    (f.dot(h), g.dot(h), f.dot(d), g.dot(d))
}

#[constraint]
pub fn turned(i: Spatial, by: Mat3) -> [f64; 3] {
    let a = i.a() * by;
    [a.m12, a.m23, a.m31]
}

#[constraint]
pub fn squared(i: Spatial, e: EulerParameters) -> f64 {
    let p = i.p;
    p.e0 * e.e0 + p.vector().dot(e.vector()) - 1.0
}

#[constraint]
pub fn closures(i: Planar, points: [Vec2; 3]) -> f64 {
    let reach = |u: Vec2| i.point(u).norm_squared();
    points.iter().map(|u| reach(*u)).sum::<f64>() - f64::hypot(i.r.x, 1.0)
}

#[constraint]
pub fn plain_function(i: Planar, k: f64) -> f64 {
    i.theta - table(k) * 2.0_f64.sqrt()
}

#[constraint]
pub fn inner_function(x: Coord, y: Coord) -> (f64, f64) {
    fn square(x: f64) -> f64 {
        x * x
    }
    let (sin, cos) = x.sin_cos();
    (square(sin) - y, square(cos) + y - 1.0)
}

#[constraint]
pub fn optional(i: Planar, limit: Option<f64>) -> f64 {
    match limit {
        Some(limit) => i.r.x - limit,
        None => i.r.x,
    }
}

#[constraint]
pub fn listed(i: Planar, weights: Vec<f64>) -> f64 {
    let all: f64 = weights.iter().map(|w| w * i.r.x).sum();
    all - 1.0
}

#[law]
pub fn rise(x: f64, h: f64, beta: f64) -> f64 {
    0.5 * h * (1.0 - (PI * x / beta).cos())
}

pub fn mechanism() -> kin::Result<Mechanism> {
    let mut m = Mechanism::new("shown");
    let slider = m.planar("slider", pose(0.2, 0.1, 0.0))?;
    m.add("slot", parabolic_slot(slider, m.ground(), vec2(0.0, 0.0), 2.0))?;
    m.add("upright", drive_angle(slider, rise(0.1, 1.0)))?;
    m.add("own", own_type(slider, Gains { k: 1.0, offset: vec2(0.0, 0.0) }))?;
    Ok(m)
}

#[constraint]
pub fn prismatic_1(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 1.0)
}

#[constraint]
pub fn cylindrical_2(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 2.0]
}

#[constraint]
pub fn prismatic_3(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 3.0)
}

#[constraint]
pub fn cylindrical_4(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 4.0]
}

#[constraint]
pub fn prismatic_5(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 5.0)
}

#[constraint]
pub fn cylindrical_6(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 6.0]
}

#[constraint]
pub fn prismatic_7(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 7.0)
}

#[constraint]
pub fn cylindrical_8(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 8.0]
}

#[constraint]
pub fn prismatic_9(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 9.0)
}

#[constraint]
pub fn cylindrical_10(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 10.0]
}

#[constraint]
pub fn prismatic_11(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 11.0)
}

#[constraint]
pub fn cylindrical_12(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 12.0]
}

#[constraint]
pub fn prismatic_13(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 13.0)
}

#[constraint]
pub fn cylindrical_14(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 14.0]
}

#[constraint]
pub fn prismatic_15(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 15.0)
}

#[constraint]
pub fn cylindrical_16(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 16.0]
}

#[constraint]
pub fn prismatic_17(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 17.0)
}

#[constraint]
pub fn cylindrical_18(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 18.0]
}

#[constraint]
pub fn prismatic_19(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 19.0)
}

#[constraint]
pub fn cylindrical_20(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 20.0]
}

#[constraint]
pub fn prismatic_21(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 21.0)
}

#[constraint]
pub fn cylindrical_22(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 22.0]
}

#[constraint]
pub fn prismatic_23(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 23.0)
}

#[constraint]
pub fn cylindrical_24(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 24.0]
}

#[constraint]
pub fn prismatic_25(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 25.0)
}

#[constraint]
pub fn cylindrical_26(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 26.0]
}

#[constraint]
pub fn prismatic_27(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 27.0)
}

#[constraint]
pub fn cylindrical_28(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 28.0]
}

#[constraint]
pub fn prismatic_29(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * 29.0)
}

#[constraint]
pub fn cylindrical_30(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * 30.0]
}
