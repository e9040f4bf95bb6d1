//! Motors and laws of motion: cam profiles, jerk-limited moves, planned paths, controllers.

use std::f64::consts::{PI, TAU};

use kin::prelude::*;

use crate::twice;

twice! { Symbolic modified_trapezoid(coord time): fn f(x: Coord, t: Time) -> f64 {
    let beta = 3.0;
    let h = 0.5;
    let u = t / beta;
    let y = if u <= 0.0 {
        0.0
    } else if u <= 0.125 {
        0.389 * u - 0.031 * (4.0 * PI * u).sin()
    } else if u < 1.0 {
        u * u * (3.0 - 2.0 * u)
    } else {
        1.0
    };
    x - h * y
} }

twice! { Symbolic seven_segments(coord time ((0.8, 1.0, 2.0))): fn f(x: Coord, t: Time, limits: (f64, f64, f64)) -> f64 {
    let (v, a, j) = limits;
    let tj = a / j;
    let ta = v / a + tj;
    let phases = [(tj, j), (ta - 2.0 * tj, 0.0), (tj, -j), (0.6, 0.0), (tj, -j), (ta - 2.0 * tj, 0.0), (tj, j)];
    let mut s = 0.0;
    let mut speed = 0.0;
    let mut acc = 0.0;
    let mut left = t;
    for (duration, jerk) in phases {
        let dt = left.clamp(0.0, duration);
        s += speed * dt + acc * dt * dt / 2.0 + jerk * dt * dt * dt / 6.0;
        speed += acc * dt + jerk * dt * dt / 2.0;
        acc += jerk * dt;
        left -= dt;
    }
    x - s
} }

twice! { Symbolic polynomial_345(coord time (1.5)): fn f(x: Coord, t: Time, duration: f64) -> f64 {
    let u = ((t - 0.5) / duration).clamp(0.0, 1.0);
    x - u.powi(3) * (10.0 + u * (-15.0 + 6.0 * u))
} }

twice! { Symbolic figure_of_eight(planar time): fn f(tool: Planar, t: Time) -> (Vec2, f64) {
    let phase = 0.7 * t;
    let p = vec2(phase.sin(), phase.sin() * phase.cos());
    let v = vec2(phase.cos(), (2.0 * phase).cos());
    (tool.r - p, tool.theta - v.y.atan2(v.x + 2.0))
} }

twice! { Symbolic circle_then_line(planar time): fn f(pen: Planar, t: Time) -> Vec2 {
    let quarter = PI / 2.0;
    let target = if t < quarter { vec2(t.cos(), t.sin()) } else { vec2(-(t - quarter), 1.0) };
    pen.r - target
} }

twice! { Symbolic chirp(coord time (0.5) (3.0)): fn f(x: Coord, t: Time, from: f64, to: f64) -> f64 {
    let rate = (to - from) / 4.0;
    x - 0.1 * (TAU * (from * t + 0.5 * rate * t * t)).sin()
} }

twice! { Symbolic decaying_oscillation(coord time): fn f(x: Coord, t: Time) -> f64 {
    let zeta = 0.15_f64;
    let omega = 4.0;
    let damped = omega * (1.0 - zeta.powi(2)).sqrt();
    let envelope = (-zeta * omega * t).exp();
    x - (1.0 - envelope * ((damped * t).cos() + zeta / (1.0 - zeta * zeta).sqrt() * (damped * t).sin()))
} }

twice! { Symbolic waypoints_with_times(coord time): fn f(x: Coord, t: Time) -> f64 {
    struct Waypoint {
        time: f64,
        at: f64,
    }
    let plan = [
        Waypoint { time: 0.0, at: 0.0 },
        Waypoint { time: 1.0, at: 1.0 },
        Waypoint { time: 2.5, at: -0.5 },
        Waypoint { time: 4.5, at: 0.25 },
    ];
    let target = plan
        .windows(2)
        .find(|w| t >= w[0].time && t < w[1].time)
        .map(|w| {
            let u = (t - w[0].time) / (w[1].time - w[0].time);
            w[0].at + (w[1].at - w[0].at) * u * u * (3.0 - 2.0 * u)
        })
        .unwrap_or(0.25);
    x - target
} }

twice! { Symbolic square_wave_by_series(coord time (0.5)): fn f(x: Coord, t: Time, gain: f64) -> f64 {
    let mut sum = 0.0;
    let mut n = 1;
    while n <= 7 {
        sum += (n as f64 * t).sin() / n as f64;
        n += 2;
    }
    x - gain * 4.0 / PI * sum
} }

twice! { Symbolic sawtooth(coord time): fn f(x: Coord, t: Time) -> f64 {
    let period = 1.5;
    let u = t.rem_euclid(period) / period;
    x - if u < 0.8 { u / 0.8 } else { (1.0 - u) / 0.2 }
} }

twice! { Symbolic phases_of_three_drives(coords time): fn f(q: [Coord; 3], t: Time) -> [f64; 3] {
    let mut k = -1.0;
    q.map(|x| {
        k += 1.0;
        x - 0.3 * (2.0 * t + k * TAU / 3.0).cos()
    })
} }

twice! { Symbolic follow_a_law_of_two_variables(coord coord time (Law::harmonic(0.2, 3.0)) (Law::polynomial(&[0.0, 1.0, 0.5]))):
fn f(a: Coord, b: Coord, t: Time, shake: Law, scale: Law) -> (f64, f64) {
    let wobble = shake.at(t) * scale.at(b);
    (a - wobble, b - shake.slope(t) + scale.slope(a))
} }

twice! { Symbolic winch_in_layers(coord coord (0.1) (0.02) (8)): fn f(turns: Coord, rope: Coord, core: f64, d: f64, per_layer: u32) -> f64 {
    let n = f64::from(per_layer);
    let total = 4.0 * (turns + 2.0);
    let mut left = total;
    let mut length = 0.0;
    for layer in 0..4 {
        let radius = core + d * (layer as f64 + 0.5);
        let here = left.min(n).max(0.0);
        length += TAU * radius * here;
        left -= here;
    }
    rope - length
} }
