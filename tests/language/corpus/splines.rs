//! Curves by their control points and tables: Bézier, Hermite, Catmull–Rom, natural splines,
//! clothoids.

use crate::twice;

twice! { Symbolic clothoid_by_series(coord coord coord): fn f(s: Coord, x: Coord, y: Coord) -> Vec2 {
    let mut cx = 0.0;
    let mut cy = 0.0;
    let mut term = s;
    for n in 0..9 {
        let order = (2 * n + 1) as f64;
        match n % 4 {
            0 => cx += term / order,
            1 => cy += term / order,
            2 => cx -= term / order,
            _ => cy -= term / order,
        }
        term *= 0.5 * s * s / (n + 1) as f64;
    }
    vec2(x - cx, y - cy)
} }

twice! { Symbolic clothoid_between_two_curvatures(coord coord (0.2) (1.4)): fn f(s: Coord, heading: Coord, from: f64, to: f64) -> [f64; 2] {
    let theta = |u: f64| from * u + 0.5 * (to - from) * u * u;
    let nodes = [0.069_431_844_202_973_7, 0.330_009_478_207_571_9];
    let weights = [0.173_927_422_568_726_9, 0.326_072_577_431_273_1];
    let mut x = 0.0;
    for (node, weight) in nodes.into_iter().zip(weights) {
        for u in [node * s, (1.0 - node) * s] {
            x += weight * s * theta(u).cos();
        }
    }
    [x - 0.5, heading - theta(s)]
} }

twice! { Symbolic bernstein(coord coord): fn f(t: Coord, y: Coord) -> f64 {
    fn binomial(n: u32, k: u32) -> u32 {
        if k == 0 || k == n { 1 } else { binomial(n - 1, k - 1) + binomial(n - 1, k) }
    }
    const POINTS: [f64; 6] = [0.0, 0.5, -1.0, 2.0, 1.0, 0.25];
    let n = POINTS.len() as u32 - 1;
    let sum: f64 = (0..=n)
        .map(|k| binomial(n, k) as f64 * t.powi(k as i32) * (1.0 - t).powi((n - k) as i32) * POINTS[k as usize])
        .sum();
    y - sum
} }

twice! { Symbolic hermite_segment(coord coord ((0.0, 1.0)) ((2.0, -0.5))): fn f(u: Coord, y: Coord, start: (f64, f64), end: (f64, f64)) -> f64 {
    let u2 = u * u;
    let u3 = u * u * u;
    let [h00, h10, h01, h11] = [2.0 * u3 - 3.0 * u2 + 1.0, u3 - 2.0 * u2 + u, 3.0 * u2 - 2.0 * u3, u3 - u2];
    y - (h00 * start.0 + h10 * start.1 + h01 * end.0 + h11 * end.1)
} }

twice! { Symbolic catmull_rom(coord coord (vec![0.0, 1.0, 0.5, 2.0, -1.0, 0.0])): fn f(x: Coord, y: Coord, given: Vec<f64>) -> f64 {
    let u = x + 2.0;
    let k = if u < 1.0 { 0 } else if u < 2.0 { 1 } else { 2 };
    let s = u - k as f64;
    let p0 = given[k];
    let p1 = given[k + 1];
    let p2 = given[k + 2];
    let p3 = given[k + 3];
    let value = 0.5
        * (2.0 * p1 + (p2 - p0) * s + (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) * s.powi(2)
            + (3.0 * (p1 - p2) + p3 - p0) * s.powi(3));
    y - value
} }

twice! { Symbolic natural_spline_by_thomas(coord coord ([0.0, 1.0, -0.5, 2.0, 0.0])): fn f(x: Coord, y: Coord, v: [f64; 5]) -> f64 {
    const N: usize = 5;
    let mut m = [0.0; N];
    let mut upper = [0.0; N];
    for k in 1..N - 1 {
        let pivot = 4.0 - upper[k - 1];
        upper[k] = 1.0 / pivot;
        m[k] = (6.0 * (v[k + 1] - 2.0 * v[k] + v[k - 1]) - m[k - 1]) / pivot;
    }
    for k in (1..N - 1).rev() {
        m[k] -= upper[k] * m[k + 1];
    }
    let at = x + 2.0;
    let mut value = 0.0;
    for k in 0..N - 1 {
        let a = k as f64 + 1.0 - at;
        let b = at - k as f64;
        if (0.0..1.0).contains(&b) {
            value = (m[k] * a * a * a + m[k + 1] * b * b * b) / 6.0
                + (v[k] - m[k] / 6.0) * a
                + (v[k + 1] - m[k + 1] / 6.0) * b;
        }
    }
    y - value
} }

twice! { Symbolic uniform_cubic_basis(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    fn b3(u: f64) -> f64 {
        let v = u.abs();
        if v >= 2.0 {
            0.0
        } else if v >= 1.0 {
            (2.0 - v).powi(3) / 6.0
        } else {
            2.0 / 3.0 - v * v + 0.5 * v * v * v
        }
    }
    let controls = [1.0, 0.0, -1.0, 0.5, 2.0];
    let curve = controls.iter().enumerate().fold(0.0, |sum, (k, c)| sum + c * b3(x - (k as f64 - 2.0)));
    curve - y
} }

twice! { Symbolic cox_de_boor_by_recursion(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    const KNOTS: [f64; 8] = [-3.0, -2.0, -1.0, -0.25, 0.5, 1.0, 2.0, 3.0];
    fn basis(i: usize, p: usize, x: f64) -> f64 {
        if p == 0 {
            return if KNOTS[i] <= x && x < KNOTS[i + 1] { 1.0 } else { 0.0 };
        }
        let rise = (x - KNOTS[i]) / (KNOTS[i + p] - KNOTS[i]);
        let fall = (KNOTS[i + p + 1] - x) / (KNOTS[i + p + 1] - KNOTS[i + 1]);
        rise * basis(i, p - 1, x) + fall * basis(i + 1, p - 1, x)
    }
    let weights = [0.5, 2.0, -1.0, 1.0, 0.25];
    y - (0..5).map(|i| weights[i] * basis(i, 2, x)).sum::<f64>()
} }

twice! { Symbolic nurbs_circle(coord coord coord): fn f(u: Coord, x: Coord, y: Coord) -> Vec2 {
    let w = std::f64::consts::FRAC_1_SQRT_2;
    let quarter = [(vec2(1.0, 0.0), 1.0), (vec2(1.0, 1.0), w), (vec2(0.0, 1.0), 1.0)];
    let b = [(1.0 - u) * (1.0 - u), 2.0 * u * (1.0 - u), u * u];
    let mut top = Vec2::zeros();
    let mut bottom = 0.0;
    for ((p, w), b) in quarter.iter().zip(b.iter()) {
        top += *p * (w * b);
        bottom += w * b;
    }
    vec2(x, y) - top / bottom
} }

twice! { Symbolic bezier_patch(coord coord coord): fn f(u: Coord, v: Coord, z: Coord) -> f64 {
    let heights = [[0.0, 1.0, 0.0], [0.5, 2.0, -0.5], [0.0, -1.0, 1.0]];
    let quadratic = |c: [f64; 3], t: f64| {
        let lower = (c[0] + (c[1] - c[0]) * t, c[1] + (c[2] - c[1]) * t);
        lower.0 + (lower.1 - lower.0) * t
    };
    let along = heights.map(|row| quadratic(row, u));
    z - quadratic(along, v)
} }

twice! { Symbolic lagrange_through_samples(coord coord ([-1.0, 0.5, 1.5, 2.5]) ([0.0, 1.0, -1.0, 2.0])):
fn f(x: Coord, y: Coord, at: [f64; 4], values: [f64; 4]) -> f64 {
    let mut sum = 0.0;
    for (i, &xi) in at.iter().enumerate() {
        let mut weight = 1.0;
        for (j, &xj) in at.iter().enumerate() {
            if i == j {
                continue;
            }
            weight *= (x - xj) / (xi - xj);
        }
        sum += weight * values[i];
    }
    y - sum
} }

twice! { Symbolic divided_differences(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    let nodes = [-1.5, -0.5, 0.25, 1.0, 2.0];
    let mut table = [1.0, 0.5, 2.0, -1.0, 0.0];
    for level in 1..nodes.len() {
        for k in (level..nodes.len()).rev() {
            table[k] = (table[k] - table[k - 1]) / (nodes[k] - nodes[k - level]);
        }
    }
    let newton = nodes.iter().zip(&table).rev().fold(0.0, |sum, (node, c)| sum * (x - node) + c);
    newton - y
} }

twice! { Symbolic neville(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    let samples = [(-2.0, 0.0), (-1.0, 1.0), (1.0, 0.5), (2.0, 3.0)];
    let mut p: Vec<f64> = samples.iter().map(|s| s.1).collect();
    for gap in 1..samples.len() {
        for i in 0..samples.len() - gap {
            let a = samples[i].0;
            let b = samples[i + gap].0;
            p[i] = ((x - b) * p[i] - (x - a) * p[i + 1]) / (a - b);
        }
    }
    y - p[0]
} }

twice! { Symbolic chebyshev_by_clenshaw(coord coord (vec![0.5, -1.0, 0.25, 0.125])): fn f(x: Coord, y: Coord, _unused: Vec<f64>) -> f64 {
    const C: &[f64] = &[0.5, -1.0, 0.25, 0.125, 0.0625];
    let u = x / 2.0;
    let mut b1 = 0.0;
    let mut b2 = 0.0;
    for c in C.iter().skip(1).rev() {
        (b1, b2) = (2.0 * u * b1 - b2 + c, b1);
    }
    y - (u * b1 - b2 + C[0])
} }

twice! { Symbolic fourier_profile(coord coord ([(0.3, 0.1), (0.05, -0.2), (0.0, 0.02)])): fn f(phi: Coord, r: Coord, harmonics: [(f64, f64); 3]) -> f64 {
    let mut sum = 1.0;
    for (n, (a, b)) in (1..).zip(harmonics.iter()) {
        let angle = n as f64 * phi;
        sum += a * angle.cos() + b * angle.sin();
    }
    r - sum
} }

twice! { Symbolic subdivision_of_a_polygon(coord): fn f(x: Coord) -> f64 {
    let mut corners = vec![(0.0, 0.0), (1.0, x), (2.0, -x), (3.0, 0.5)];
    for _ in 0..2 {
        let mut finer = Vec::with_capacity(2 * corners.len());
        for pair in corners.windows(2) {
            let (ax, ay) = pair[0];
            let (bx, by) = pair[1];
            finer.push((0.75 * ax + 0.25 * bx, 0.75 * ay + 0.25 * by));
            finer.push((0.25 * ax + 0.75 * bx, 0.25 * ay + 0.75 * by));
        }
        corners = finer;
    }
    corners.iter().map(|(a, b)| a * b * b).sum::<f64>() - 1.0
} }
