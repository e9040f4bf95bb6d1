//! Machines of textbooks: linkages, cams, gears, hoists, as their loop equations are written.

use kin::prelude::*;

use crate::twice;

twice! { Symbolic slider_crank_offset(coord coord time (1.0) (3.0) (0.2)):
fn f(phi: Coord, x: Coord, t: Time, crank: f64, rod: f64, offset: f64) -> [f64; 2] {
    let theta = 2.0 * t;
    let (s, c) = theta.sin_cos();
    [crank * c + rod * phi.cos() - x, crank * s + rod * phi.sin() - offset]
} }

twice! { Symbolic freudenstein(coord coord ([4.0, 1.0, 3.5, 3.0])): fn f(a: Coord, b: Coord, l: [f64; 4]) -> f64 {
    let [d, r, c, k] = l;
    let k1 = d / r;
    let k2 = d / k;
    let k3 = (r * r - c * c + k * k + d * d) / (2.0 * r * k);
    k1 * b.cos() - k2 * a.cos() + k3 - (a - b).cos()
} }

twice! { Symbolic five_link_arm(coords): fn f(q: [Coord; 5]) -> Vec2 {
    let lengths = [1.0, 0.9, 0.8, 0.7, 0.6];
    let tip = q.iter().zip(lengths).scan(0.0, |angle, (q, l)| {
        *angle += *q;
        Some(vec2(l * angle.cos(), l * angle.sin()))
    });
    tip.fold(vec2(0.0, 0.0), |sum, v| sum + v) - vec2(1.0, 1.0)
} }

twice! { Symbolic stewart_leg(spatial ([vec3(1.0, 0.0, 0.0), vec3(-0.5, 0.8, 0.0)]) ([vec3(2.0, 0.0, -3.0), vec3(-1.0, 1.5, -3.0)]) (3.0)):
fn f(top: Spatial, upper: [Vec3; 2], lower: [Vec3; 2], length: f64) -> [f64; 2] {
    let mut rows = [0.0; 2];
    for (row, (u, l)) in rows.iter_mut().zip(upper.iter().zip(&lower)) {
        let d = top.point(*u) - *l;
        *row = d.norm_squared() - length * length;
    }
    rows
} }

twice! { Symbolic planetary_gear(coord coord coord (24) (60)): fn f(sun: Coord, ring: Coord, carrier: Coord, s: i32, r: i32) -> f64 {
    let ratio = r as f64 / s as f64;
    sun + ratio * ring - (1.0 + ratio) * carrier
} }

twice! { Symbolic worm_with_play(coord coord): fn f(worm: Coord, wheel: Coord) -> f64 {
    const STARTS: u32 = 2;
    const TEETH: u32 = 40;
    let ratio = f64::from(STARTS) / f64::from(TEETH);
    let slack = worm * ratio - wheel;
    if slack.abs() < 0.01 { 0.1 * slack } else { slack - 0.009 * slack.signum() }
} }

twice! { Symbolic scotch_yoke(coord time (Some(0.5))): fn f(x: Coord, t: Time, phase: Option<f64>) -> f64 {
    let phase = match phase {
        Some(p) => p,
        None => 0.0,
    };
    x - 0.8 * (3.0 * t + phase).sin()
} }

twice! { Symbolic geneva_wheel(coord time): fn f(wheel: Coord, t: Time) -> f64 {
    use std::f64::consts::{FRAC_PI_4, SQRT_2};
    let phi = t - 2.0;
    let engaged = phi.abs() < FRAC_PI_4;
    let angle = if engaged { (phi.sin() / (SQRT_2 - phi.cos())).atan() } else { FRAC_PI_4 * phi.signum() };
    wheel - angle
} }

twice! { Symbolic flat_faced_cam(planar coord ([0.5, 0.2, 0.05])): fn f(cam: Planar, lift: Coord, c: [f64; 3]) -> f64 {
    let support = |phi: f64| c.iter().enumerate().map(|(n, c)| c * (n as f64 * phi).cos()).sum::<f64>();
    lift - support(-cam.theta) - cam.r.y
} }

twice! { Symbolic double_universal(coord coord coord (0.3) (0.3)): fn f(a: Coord, b: Coord, c: Coord, first: f64, second: f64) -> (f64, f64) {
    let joint = |input: f64, output: f64, bend: f64| output.sin() * input.cos() * bend.cos() - input.sin() * output.cos();
    (joint(a, b, first), joint(b, c, second))
} }

twice! { Symbolic differential(coords): fn f(q: [Coord; 3]) -> f64 {
    let [left, right, cage] = q;
    (left + right) / 2.0 - cage
} }

twice! { Symbolic pantograph(planar planar planar (2.5)): fn f(a: Planar, b: Planar, c: Planar, k: f64) -> Vec2 {
    (c.r - a.r) - (b.r - a.r) * k
} }

twice! { Symbolic block_and_tackle(coords (4)): fn f(q: [Coord; 2], falls: usize) -> f64 {
    let n = falls as f64;
    n * q[0] + q[1] - 6.0
} }

twice! { Symbolic rolling_without_slip(planar coord (0.5)): fn f(wheel: Planar, s: Coord, r: f64) -> [f64; 3] {
    let contact = wheel.r - vec2(0.0, r);
    let arc = wheel.theta * r;
    [contact.y, wheel.r.x + arc, s - arc.abs()]
} }

twice! { Symbolic camus_tooth(coord coord): fn f(a: Coord, b: Coord) -> (f64, f64) {
    enum Side {
        Drive,
        Coast,
    }
    let side = if a >= b { Side::Drive } else { Side::Coast };
    let sign = match side {
        Side::Drive => 1.0,
        Side::Coast => -1.0,
    };
    let pressure = 20.0_f64.to_radians();
    (sign * (a - b) * pressure.cos() - 0.1, a * pressure.tan() + b)
} }

twice! { Symbolic elbow_up(coord coord coord coord): fn f(x: Coord, y: Coord, shoulder: Coord, elbow: Coord) -> (f64, f64) {
    let l1 = 1.5;
    let l2 = 1.25;
    let d2 = x * x + y * y;
    let cosine = ((d2 - l1 * l1 - l2 * l2) / (2.0 * l1 * l2)).clamp(-0.999, 0.999);
    let bend = cosine.acos();
    let lean = y.atan2(x) - (l2 * bend.sin()).atan2(l1 + l2 * cosine);
    (shoulder - lean, elbow - bend)
} }

twice! { Symbolic parallel_rods(planars): fn f(rods: [Planar; 2]) -> (f64, f64) {
    let [first, second] = &rods;
    let u = vec2(1.0, 0.0);
    let across = first.direction(u).perp();
    (across.dot(second.direction(u)), across.dot(second.r - first.r) - 0.5)
} }

twice! { Symbolic bellcrank(planar (vec![(1.0, 0.0), (0.0, 1.0)])): fn f(crank: Planar, arms: Vec<(f64, f64)>) -> f64 {
    let (x, y) = arms[0];
    let tip = crank.point(vec2(x, y));
    tip.x - arms[1].1 * tip.y
} }

twice! { Dual "a loop with an unknown end" wrapped_angle(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    use std::f64::consts::{PI, TAU};
    let mut d = a - b;
    while d > PI {
        d -= TAU;
    }
    while d < -PI {
        d += TAU;
    }
    d
} }
