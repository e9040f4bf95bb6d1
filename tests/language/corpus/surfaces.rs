//! Implicit surfaces and fields of distance, and what lies on them.

use kin::prelude::*;

use crate::twice;

twice! { Symbolic ellipsoid(spatial ([1.0, 2.0, 0.5])): fn f(i: Spatial, axes: [f64; 3]) -> f64 {
    let p = i.r.to_array();
    let mut sum = -1.0;
    for k in 0..p.len() {
        sum += (p[k] / axes[k]).powi(2);
    }
    sum
} }

twice! { Symbolic tangent_sphere_and_plane(spatial (vec3(0.0, 0.6, 0.8)) (0.3)): fn f(ball: Spatial, n: Vec3, r: f64) -> f64 {
    debug_assert!((n.norm() - 1.0).abs() < 1e-9);
    ball.r.dot(n) - r
} }

twice! { Symbolic capsule(coord coord coord): fn f(x: Coord, y: Coord, d: Coord) -> f64 {
    let a = vec2(-1.0, 0.0);
    let b = vec2(1.0, 0.5);
    let p = vec2(x, y);
    let pa = p - a;
    let ba = b - a;
    let h = (pa.dot(ba) / ba.dot(ba)).clamp(0.0, 1.0);
    (pa - ba * h).norm() - 0.25 - d
} }

twice! { Symbolic smooth_union_of_two_balls(spatial): fn f(i: Spatial) -> f64 {
    fn smin(a: f64, b: f64, k: f64) -> f64 {
        let h = (0.5 + 0.5 * (b - a) / k).clamp(0.0, 1.0);
        b * (1.0 - h) + a * h - k * h * (1.0 - h)
    }
    let ball = |x: f64, r: f64| (i.r - vec3(x, 0.0, 0.0)).norm() - r;
    smin(ball(-0.8, 0.7), ball(0.9, 0.5), 0.6)
} }

twice! { Symbolic gyroid(spatial (2.0)): fn f(i: Spatial, k: f64) -> f64 {
    let Vec3 { x, y, z } = i.r * k;
    x.sin() * y.cos() + y.sin() * z.cos() + z.sin() * x.cos()
} }

twice! { Symbolic metaballs(coord coord (vec![(0.0, 0.0, 1.0), (1.0, 0.5, 0.5)])): fn f(x: Coord, y: Coord, _given: Vec<(f64, f64, f64)>) -> f64 {
    const BALLS: [(f64, f64, f64); 3] = [(0.0, 0.0, 1.0), (1.0, 0.5, 0.5), (-1.0, 0.25, 0.75)];
    BALLS.iter().map(|&(a, b, r)| r * r / ((x - a).powi(2) + (y - b).powi(2) + 0.01)).sum::<f64>() - 1.0
} }

twice! { Symbolic polygon_distance(coord coord coord): fn f(x: Coord, y: Coord, d: Coord) -> f64 {
    let corners = [(-1.0, -1.0), (1.5, -0.5), (0.5, 1.25)];
    let mut nearest = f64::MAX;
    let mut inside = true;
    for k in 0..corners.len() {
        let (ax, ay) = corners[k];
        let (bx, by) = corners[(k + 1) % corners.len()];
        let ex = bx - ax;
        let ey = by - ay;
        let px = x - ax;
        let py = y - ay;
        let s = ((px * ex + py * ey) / (ex * ex + ey * ey)).max(0.0).min(1.0);
        nearest = nearest.min((px - s * ex).powi(2) + (py - s * ey).powi(2));
        inside &= ex * py - ey * px > 0.0;
    }
    d - if inside { -nearest.sqrt() } else { nearest.sqrt() }
} }

twice! { Symbolic point_in_a_cone(spatial (0.4)): fn f(i: Spatial, half: f64) -> f64 {
    let p = i.r;
    let along = p.z;
    let across = p.x.hypot(p.y);
    across * half.cos() - along * half.sin()
} }

twice! { Symbolic helicoid(spatial (0.5)): fn f(i: Spatial, pitch: f64) -> f64 {
    let [x, y, z] = [i.r.x, i.r.y, i.r.z];
    let (s, c) = f64::sin_cos(z / pitch);
    y * c - x * s
} }

twice! { Symbolic saddle_with_a_wheel(spatial): fn f(i: Spatial) -> [f64; 2] {
    let height = |x: f64, y: f64| 0.1 * (x * x - y * y);
    let p = i.point(vec3(0.0, 0.0, -0.3));
    let normal = vec3(-0.2 * p.x, 0.2 * p.y, 1.0).normalize();
    [p.z - height(p.x, p.y), i.direction(vec3(1.0, 0.0, 0.0)).dot(normal)]
} }

twice! { Symbolic superquadric(coords ((0.8, 1.2)) ): fn f(p: [Coord; 3], shape: (f64, f64)) -> f64 {
    let (e1, e2) = shape;
    let [x, y, z] = p.map(f64::abs);
    (x.powf(2.0 / e2) + y.powf(2.0 / e2)).powf(e2 / e1) + z.powf(2.0 / e1) - 1.0
} }

twice! { Symbolic terrain_by_bilinear_cells(coord coord coord): fn f(x: Coord, y: Coord, z: Coord) -> f64 {
    const H: [[f64; 5]; 5] = [
        [0.0, 0.1, 0.2, 0.1, 0.0],
        [0.1, 0.3, 0.4, 0.2, 0.1],
        [0.2, 0.5, 0.9, 0.4, 0.0],
        [0.1, 0.2, 0.3, 0.1, -0.1],
        [0.0, 0.0, 0.1, -0.1, -0.2],
    ];
    let cell = |u: f64| {
        let k = (u + 2.0).floor().clamp(0.0, 3.0);
        (k as usize, u + 2.0 - k)
    };
    let (i, s) = cell(x);
    let (j, t) = cell(y);
    let lerp = |a: f64, b: f64, w: f64| a + (b - a) * w;
    z - lerp(lerp(H[i][j], H[i][j + 1], t), lerp(H[i + 1][j], H[i + 1][j + 1], t), s)
} }

twice! { Symbolic rope_on_a_capstan(coord coord (0.3)): fn f(tight: Coord, slack: Coord, mu: f64) -> f64 {
    let wraps = 2.5;
    tight - slack * (mu * wraps * std::f64::consts::TAU).exp().recip() - 0.1
} }

twice! { Symbolic hanging_chain_of_two_spans(coord coord): fn f(a: Coord, b: Coord) -> [f64; 2] {
    let c = 1.0 + a.abs();
    let sag = |span: f64| c * ((span / (2.0 * c)).cosh() - 1.0);
    let length = |span: f64| 2.0 * c * (span / (2.0 * c)).sinh();
    [sag(1.5) - b, length(1.5) + length(1.0) - 4.0]
} }

twice! { Symbolic rope_around_a_post(coord coord (0.4) (5.0)): fn f(x: Coord, y: Coord, r: f64, rope: f64) -> f64 {
    let start = (-3.0_f64, 0.5_f64);
    let end = (x + 4.0, y);
    let tangent = |(px, py): (f64, f64)| (px * px + py * py - r * r).sqrt();
    let half = |(px, py): (f64, f64)| (r / px.hypot(py)).acos();
    let between = {
        let dot = start.0 * end.0 + start.1 * end.1;
        let cross = start.0 * end.1 - start.1 * end.0;
        cross.atan2(dot).abs()
    };
    let wrap = (between - half(start) - half(end)).max(0.0);
    let free = (end.0 - start.0).hypot(end.1 - start.1);
    (if wrap > 0.0 { tangent(start) + tangent(end) + r * wrap } else { free }) - rope
} }

twice! { Symbolic soft_maximum_by_p_norm(coords (6)): fn f(q: [Coord; 4], p: i32) -> f64 {
    let sum = q.iter().fold(0.0, |s, x| s + (x * x + 0.01).powi(p / 2));
    sum.powf(1.0 / p as f64) - 1.5
} }

twice! { Symbolic softplus_and_friends(coord coord): fn f(a: Coord, b: Coord) -> (f64, f64) {
    let softplus = |x: f64| if x > 20.0 { x } else { x.exp().ln_1p() };
    let smooth_abs = |x: f64| (x * x + 1e-2).sqrt();
    let sigmoid = |x: f64| 1.0 / (1.0 + (-x).exp());
    (softplus(4.0 * a) - softplus(-4.0 * a) - b, smooth_abs(b) * sigmoid(a) - 0.2)
} }
