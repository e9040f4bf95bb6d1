//! Curves and surfaces: involutes, clothoids, splines, implicit surfaces.

use crate::twice;

twice! { Symbolic involute_contact(planar planar (0.5) (0.3)): fn f(i: Planar, j: Planar, base: f64, tooth: f64) -> (f64, f64) {
    let d = j.r - i.r;
    let distance = (d.x * d.x + d.y * d.y).sqrt() + 2.0;
    let alpha = (2.0 * base / distance).acos();
    let involute = |phi: f64| phi.tan() - phi;
    let line = (d.x * alpha.cos() + d.y * alpha.sin()) - base * (i.theta + j.theta);
    (line + involute(alpha) * tooth, (1.0 + alpha * alpha).sqrt() - base)
} }

twice! { Symbolic clothoid_by_simpson(coord coord): fn f(s: Coord, y: Coord) -> f64 {
    const N: usize = 4;
    let h = s / (2 * N) as f64;
    let mut sum = 0.0;
    for k in 0..=2 * N {
        let weight = if k == 0 || k == 2 * N {
            1.0
        } else if k % 2 == 1 {
            4.0
        } else {
            2.0
        };
        let u = k as f64 * h;
        sum += weight * (0.5 * u * u).sin();
    }
    y - sum * h / 3.0
} }

twice! { Symbolic de_casteljau(coord coord): fn f(t: Coord, y: Coord) -> f64 {
    let mut p = [0.0, 1.5, -0.5, 2.0, 1.0];
    let n = p.len();
    for level in 1..n {
        for k in 0..n - level {
            p[k] = (1.0 - t) * p[k] + t * p[k + 1];
        }
    }
    y - p[0]
} }

twice! { Symbolic de_boor(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    const T: [f64; 10] = [-2.0, -2.0, -2.0, -2.0, -0.5, 0.75, 2.0, 2.0, 2.0, 2.0];
    const C: [f64; 6] = [0.0, 1.0, -1.0, 0.5, 2.0, 1.0];
    const P: usize = 3;
    let mut span = P;
    while span < 5 && x >= T[span + 1] {
        span += 1;
    }
    let mut d = [0.0; P + 1];
    for j in 0..=P {
        d[j] = C[span - P + j];
    }
    for r in 1..=P {
        for j in (r..=P).rev() {
            let left = T[span - P + j];
            let alpha = (x - left) / (T[span + 1 + j - r] - left);
            d[j] = (1.0 - alpha) * d[j - 1] + alpha * d[j];
        }
    }
    y - d[P]
} }

twice! { Symbolic torus(spatial (2.0) (0.5)): fn f(i: Spatial, big: f64, small: f64) -> f64 {
    let [x, y, z] = i.r.to_array();
    let ring = (x * x + y * y).sqrt() - big;
    ring * ring + z * z - small * small
} }

twice! { Symbolic superellipse(coord coord ((2.0, 1.0, 3.0))): fn f(x: Coord, y: Coord, shape: (f64, f64, f64)) -> f64 {
    let (a, b, n) = shape;
    (x / a).abs().powf(n) + (y / b).abs().powf(n) - 1.0
} }

twice! { Symbolic smoothed_maximum(coords (4.0)): fn f(q: [Coord; 5], sharp: f64) -> f64 {
    let top = q.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = q.iter().map(|x| ((x - top) * sharp).exp()).sum();
    top + sum.ln() / sharp - 1.0
} }

twice! { Symbolic catenary(coord coord coord): fn f(a: Coord, x: Coord, y: Coord) -> f64 {
    let c = 1.0 + a * a;
    c * ((x / c).cosh() - 1.0) - y
} }

twice! { Symbolic piecewise_cubic(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    struct Segment {
        from: f64,
        c: [f64; 4],
    }
    let segments = [
        Segment { from: -3.0, c: [0.0, 1.0, 0.0, -0.1] },
        Segment { from: -1.0, c: [1.2, 0.4, -0.2, 0.05] },
        Segment { from: 1.0, c: [0.5, -0.3, 0.1, 0.0] },
    ];
    let mut value = 0.0;
    for s in segments.iter().rev() {
        if x >= s.from {
            let u = x - s.from;
            value = s.c.iter().rev().fold(0.0, |sum, c| sum * u + c);
            break;
        }
    }
    y - value
} }

twice! { Symbolic legendre_series(coord): fn f(x: Coord) -> f64 {
    let weights = [0.5, 1.0, -0.25, 0.125, 0.0625];
    let mut a = 1.0;
    let mut b = x;
    let mut sum = weights[0] * a + weights[1] * b;
    for (n, w) in weights.iter().enumerate().skip(2) {
        let n = n as f64;
        let next = ((2.0 * n - 1.0) * x * b - (n - 1.0) * a) / n;
        a = b;
        b = next;
        sum += w * b;
    }
    sum
} }

twice! { Symbolic rational_bezier(coord coord ([1.0, 0.7, 1.0])): fn f(t: Coord, y: Coord, w: [f64; 3]) -> f64 {
    let p = [(0.0, 0.0), (1.0, 2.0), (2.0, 0.5)];
    let u = 1.0 - t;
    let basis = [u * u, 2.0 * u * t, t * t];
    let (top, bottom) = basis.iter().zip(w).zip(p).fold((0.0, 0.0), |(top, bottom), ((b, w), (_, y))| (top + b * w * y, bottom + b * w));
    y - top / bottom
} }

twice! { Symbolic epicycloid(planar coord (3)): fn f(i: Planar, phi: Coord, lobes: i32) -> Vec2 {
    let k = lobes as f64;
    let curve = vec2((k + 1.0) * phi.cos() - ((k + 1.0) * phi).cos(), (k + 1.0) * phi.sin() - ((k + 1.0) * phi).sin());
    i.r - curve
} }

twice! { Symbolic signed_distance_of_a_box(coord coord coord): fn f(x: Coord, y: Coord, d: Coord) -> f64 {
    let qx = x.abs() - 1.0;
    let qy = y.abs() - 0.5;
    let outside = qx.max(0.0).hypot(qy.max(0.0));
    let inside = qx.max(qy).min(0.0);
    outside + inside - d
} }

twice! { Symbolic smooth_step(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    let t = ((x + 1.0) / 2.0).clamp(0.0, 1.0);
    y - t * t * (3.0 - 2.0 * t)
} }
