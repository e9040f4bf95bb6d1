//! Mechanisms and numerics as they are written by people who have not read how the compiler reads
//! them.

use kin::prelude::*;

use crate::twice;

twice! { Symbolic involute_contact(planar planar (0.5) coord): fn f(i: Planar, j: Planar, rb: f64, phi: Coord) -> Vec2 {
    let involute = |t: f64| vec2(rb * (t.cos() + t * t.sin()), rb * (t.sin() - t * t.cos()));
    i.point(involute(phi)) - j.point(involute(-phi))
} }

twice! { Symbolic clothoid(coord coord coord (0.4)): fn f(s: Coord, x: Coord, y: Coord, a: f64) -> [f64; 2] {
    let mut px = 0.0;
    let mut py = 0.0;
    const N: usize = 8;
    let h = s / N as f64;
    for k in 0..N {
        let mid = (k as f64 + 0.5) * h;
        let phase = 0.5 * a * mid.powi(2);
        let (sin, cos) = phase.sin_cos();
        px += cos * h;
        py += sin * h;
    }
    [x - px, y - py]
} }

twice! { Symbolic de_boor(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    const KNOTS: [f64; 8] = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0];
    const POINTS: [f64; 5] = [0.0, 1.0, -1.0, 0.5, 2.0];
    const P: usize = 2;
    let mut k = P;
    while k + 1 < POINTS.len() && x >= KNOTS[k + 1] { k += 1; }
    let mut d: [f64; P + 1] = std::array::from_fn(|j| POINTS[j + k - P]);
    for r in 1..=P {
        for j in (r..=P).rev() {
            let low = KNOTS[j + k - P];
            let high = KNOTS[j + 1 + k - r];
            let alpha = (x - low) / (high - low);
            d[j] = (1.0 - alpha) * d[j - 1] + alpha * d[j];
        }
    }
    y - d[P]
} }

twice! { Symbolic rope(planar planar (3.0) ([(vec2(4.0, 3.0), 0.3), (vec2(6.0, -4.0), 0.2), (vec2(9.0, 5.0), 0.1)])): fn f(a: Planar, b: Planar, length: f64, pulleys: [(Vec2, f64); 3]) -> f64 {
    let mut total = 0.0;
    let mut from = a.point(Vec2::zeros());
    for &(centre, radius) in &pulleys {
        let d = centre - from;
        let l2 = d.norm_squared() - radius * radius;
        total += l2.max(0.0).sqrt();
        from = centre;
    }
    total += (b.r - from).norm();
    total - length
} }

twice! { Symbolic quaternion_log(spatial coords): fn f(body: Spatial, out: [Coord; 3]) -> Vec3 {
    let w = body.p.e0;
    let v = body.p.vector();
    let n = v.norm();
    let scale = if n > 1e-8 { 2.0 * n.atan2(w) / n } else { 2.0 / w };
    v * scale - Vec3::new(out[0], out[1], out[2])
} }

twice! { Symbolic dh_chain(coords coords): fn f(q: [Coord; 3], tip: [Coord; 3]) -> [f64; 3] {
    struct Link { a: f64, alpha: f64, d: f64 }
    let links = [Link { a: 0.5, alpha: 0.3, d: 0.1 }, Link { a: 0.4, alpha: -0.2, d: 0.0 }, Link { a: 0.3, alpha: 0.0, d: 0.2 }];
    impl Link {
        fn apply(&self, theta: f64, p: [f64; 3]) -> [f64; 3] {
            let (s, c) = theta.sin_cos();
            let (sa, ca) = self.alpha.sin_cos();
            let [x, y, z] = p;
            [c * x - s * ca * y + s * sa * z + self.a * c, s * x + c * ca * y - c * sa * z + self.a * s, sa * y + ca * z + self.d]
        }
    }
    let p = links.iter().zip(q).rev().fold([0.0; 3], |p, (link, theta)| link.apply(theta, p));
    std::array::from_fn(|k| p[k] - tip[k])
} }

twice! { Symbolic complex_loop(coord coord coord ([1.0, 2.0, 1.5, 2.5])): fn f(t2: Coord, t3: Coord, t4: Coord, r: [f64; 4]) -> (f64, f64) {
    #[derive(Clone, Copy)]
    struct C(f64, f64);
    impl std::ops::Add for C { type Output = C; fn add(self, o: C) -> C { C(self.0 + o.0, self.1 + o.1) } }
    impl std::ops::Sub for C { type Output = C; fn sub(self, o: C) -> C { C(self.0 - o.0, self.1 - o.1) } }
    impl std::ops::Mul<f64> for C { type Output = C; fn mul(self, k: f64) -> C { C(self.0 * k, self.1 * k) } }
    impl std::iter::Sum for C { fn sum<I: Iterator<Item = C>>(all: I) -> C { all.fold(C(0.0, 0.0), |a, b| a + b) } }
    fn cis(t: f64) -> C { C(t.cos(), t.sin()) }
    let closure: C = [cis(t2) * r[0], cis(t3) * r[1]].into_iter().sum();
    let C(re, im) = closure - cis(t4) * r[2] - C(r[3], 0.0);
    (re, im)
} }

twice! { Symbolic labelled(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    let grid = [[0.1, 0.2], [0.3, 0.9]];
    let found = 'search: {
        for row in &grid {
            for &cell in row {
                if x < cell { break 'search cell; }
            }
        }
        1.0
    };
    y - found * x
} }

twice! { Symbolic chebyshev(coord coord ([0.5, -1.0, 0.25, 0.1, -0.05, 0.02])): fn f(x: Coord, y: Coord, c: [f64; 6]) -> f64 {
    let mut b1 = 0.0;
    let mut b2 = 0.0;
    for &ck in c[1..].iter().rev() {
        (b1, b2) = (2.0 * x * b1 - b2 + ck, b1);
    }
    y - (c[0] + x * b1 - b2)
} }

twice! { Symbolic newton_inverse(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    let mut u = x;
    for _ in 0..6 {
        let f = u - 0.3 * u.sin() - x;
        let df = 1.0 - 0.3 * u.cos();
        u -= f / df;
    }
    y - u
} }

twice! { Symbolic gear_train(coords ([20, 40, 17, 51])): fn f(angles: [Coord; 4], teeth: [u32; 4]) -> [f64; 3] {
    let mut out = [0.0; 3];
    for (row, (pair, t)) in out.iter_mut().zip(angles.windows(2).zip(teeth.windows(2))) {
        *row = pair[0] * f64::from(t[0]) + pair[1] * f64::from(t[1]);
    }
    out
} }

twice! { Symbolic polygon_contact(planar ([vec2(1.0, 0.0), vec2(0.3, 0.9), vec2(-0.8, 0.6), vec2(-0.8, -0.6), vec2(0.3, -0.9)])): fn f(p: Planar, v: [Vec2; 5]) -> f64 {
    v.iter()
        .zip(v.iter().cycle().skip(1))
        .map(|(a, b)| { let e = *b - *a; let n = vec2(e.y, -e.x) / e.norm(); n.dot(&(p.r - *a)) })
        .fold(f64::MIN, |a, b| a.max(b))
} }

twice! { Symbolic sorted(coords coord): fn f(q: [Coord; 3], y: Coord) -> f64 {
    let mut v = q;
    v.sort_by(|a, b| a.partial_cmp(b).unwrap());
    y - v[1]
} }

twice! { Symbolic hinge_stack(planars): fn f(b: [Planar; 3]) -> [f64; 4] {
    let mut rows = vec![];
    for pair in b.windows(2) {
        let gap = pair[1].point(vec2(-0.5, 0.0)) - pair[0].point(vec2(0.5, 0.0));
        rows.extend([gap.x, gap.y]);
    }
    rows.try_into().unwrap()
} }

twice! { Symbolic trait_inside(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    trait Curve { fn at(&self, x: f64) -> f64; }
    struct Line(f64);
    impl Curve for Line { fn at(&self, x: f64) -> f64 { self.0 * x } }
    struct Arc { r: f64 }
    impl Curve for Arc { fn at(&self, x: f64) -> f64 { (self.r * self.r - x * x).sqrt() } }
    y - Line(2.0).at(x) - Arc { r: 9.0 }.at(x)
} }

twice! { Symbolic dyn_inside(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    let curves: [&dyn Fn(f64) -> f64; 2] = [&|x: f64| x.sin(), &|x: f64| x * x];
    y - curves.iter().map(|c| c(x)).sum::<f64>()
} }

twice! { Symbolic matrix_exp(coords (vec3(0.3, 0.2, 0.1)) (vec3(0.4, -0.2, 1.0))): fn f(w: [Coord; 3], u: Vec3, v: Vec3) -> Vec3 {
    let x = w[0];
    let y = w[1];
    let z = w[2];
    let skew = Mat3::new(0.0, -z, y, z, 0.0, -x, -y, x, 0.0);
    let mut term = Mat3::identity();
    let mut sum = Mat3::identity();
    for k in 1..6 { term = term * skew / k as f64; sum += term; }
    sum * u - v
} }

twice! { Symbolic nested_fn_recursive(coord): fn f(x: Coord) -> f64 {
    fn legendre(n: u32, x: f64) -> f64 {
        match n { 0 => 1.0, 1 => x, n => ((2 * n - 1) as f64 * x * legendre(n - 1, x) - (n - 1) as f64 * legendre(n - 2, x)) / n as f64 }
    }
    legendre(4, x) - 0.1
} }

twice! { Symbolic tuple_struct_newtype(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    #[derive(Clone, Copy, PartialEq, PartialOrd)]
    struct Metres(f64);
    impl From<f64> for Metres { fn from(x: f64) -> Self { Metres(x) } }
    impl std::ops::Neg for Metres { type Output = Self; fn neg(self) -> Self { Metres(-self.0) } }
    let (a, b): (Metres, Metres) = (x.into(), y.into());
    let far = if a > b { a } else { -b };
    far.0
} }

twice! { Symbolic generic_inner(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    fn lerp<T>(a: T, b: T, s: f64) -> T where T: std::ops::Mul<f64, Output = T> + std::ops::Add<Output = T> { a * (1.0 - s) + b * s }
    lerp(x, y, 0.3) - lerp(vec2(x, y), vec2(y, x), 0.5).x
} }

twice! { Symbolic biarc(coord coord ([(vec2(-1.0, -0.5), 3.0, 0.0), (vec2(1.0, 0.5), 4.0, 1.5), (vec2(0.0, 1.0), 5.0, 9.0)])): fn f(x: Coord, y: Coord, arcs: [(Vec2, f64, f64); 3]) -> f64 {
    for (centre, radius, until) in arcs {
        if x < until {
            let dx = x - centre.x;
            return y - centre.y - (radius.powi(2) - dx * dx).max(0.0).sqrt();
        }
    }
    y
} }

twice! { Symbolic step_by_rev(coord ([0.1, 0.2, -0.3, 0.4, 0.05, -0.2, 0.1])): fn f(x: Coord, c: [f64; 7]) -> f64 {
    let even: f64 = c.iter().step_by(2).rev().fold(0.0, |s, c| s * x * x + c);
    let odd: f64 = c.iter().skip(1).step_by(2).rev().fold(0.0, |s, &c| s * x * x + c);
    even + x * odd
} }

twice! { Symbolic shadowed_steps(coord time): fn f(x: Coord, t: Time) -> f64 {
    let phase = (t / 2.0).fract();
    let lift = match phase { p if (0.0..0.25).contains(&p) => 4.0 * p, p if p < 0.5 => 1.0, p if p < 0.75 => 1.0 - 4.0 * (p - 0.5), _ => 0.0 };
    x - lift
} }

twice! { Symbolic default_and_update(coord): fn f(x: Coord) -> f64 {
    #[derive(Default, Clone)]
    struct Setup { gain: f64, offset: f64, power: i32 }
    let s = Setup { gain: 2.0, power: 3, ..Default::default() };
    s.gain * x.powi(s.power) + s.offset - 1.0
} }

twice! { Symbolic associated_consts(coord): fn f(x: Coord) -> f64 {
    struct Cam;
    impl Cam { const BASE: f64 = 0.3; const LIFT: f64 = 0.1; fn radius(a: f64) -> f64 { Self::BASE + Self::LIFT * (1.0 - a.cos()) } }
    Cam::radius(x) - Cam::BASE - 0.05
} }

twice! { Symbolic smooth_max(coord coord coord (5.0)): fn f(x: Coord, y: Coord, z: Coord, k: f64) -> f64 {
    let m = [x, y].iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = [x, y].iter().map(|v| ((v - m) * k).exp()).sum();
    z - (m + sum.ln() / k)
} }
