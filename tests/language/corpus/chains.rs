//! Chains and rotations: Denavit–Hartenberg by loops, complex numbers, rotation vectors, ropes over
//! pulleys.

use crate::twice;

twice! { Symbolic denavit_hartenberg(coords ([(0.0, 0.3, 1.5), (0.4, 0.0, 0.0), (0.1, 0.2, -1.5)])):
fn f(q: [Coord; 3], links: [(f64, f64, f64); 3]) -> [f64; 3] {
    let mut t = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    for (angle, (a, d, alpha)) in q.into_iter().zip(links) {
        let (s, c) = angle.sin_cos();
        let (sa, ca) = alpha.sin_cos();
        let step = [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0.0, sa, ca, d], [0.0, 0.0, 0.0, 1.0]];
        let mut next = [[0.0; 4]; 3];
        for i in 0..3 {
            for j in 0..4 {
                for k in 0..4 {
                    next[i][j] += t[i].get(k).copied().unwrap_or(0.0) * step[k][j];
                }
            }
        }
        t = next;
    }
    [t[0][3] - 0.5, t[1][3], t[2][3] - 0.2]
} }

twice! { Symbolic planar_chain(coords ([1.0, 0.8, 0.6])): fn f(q: [Coord; 3], l: [f64; 3]) -> (f64, f64) {
    let mut x = 0.0;
    let mut y = 0.0;
    let mut phi = 0.0;
    for (q, l) in q.iter().zip(&l) {
        phi += q;
        x += l * phi.cos();
        y += l * phi.sin();
    }
    (x - 1.0, y - 0.5)
} }

twice! { Symbolic four_bar_by_complex_numbers(coords): fn f(q: [Coord; 3]) -> (f64, f64) {
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct C {
        re: f64,
        im: f64,
    }
    impl C {
        fn cis(phi: f64) -> Self {
            C { re: phi.cos(), im: phi.sin() }
        }
    }
    impl std::ops::Add for C {
        type Output = C;
        fn add(self, o: C) -> C {
            C { re: self.re + o.re, im: self.im + o.im }
        }
    }
    impl std::ops::Mul<f64> for C {
        type Output = C;
        fn mul(self, k: f64) -> C {
            C { re: self.re * k, im: self.im * k }
        }
    }
    let [a, b, c] = q;
    let sum = C::cis(a) * 1.0 + C::cis(b) * 2.5 + C::cis(c) * -1.75;
    (sum.re - 1.5, sum.im)
} }

twice! { Symbolic rotation_vector(spatial): fn f(i: Spatial) -> Vec3 {
    let p = i.p;
    let v = p.vector();
    let size = v.norm();
    let angle = 2.0 * size.atan2(p.e0);
    let scale = if size > 1e-6 { angle / size } else { 2.0 };
    v * scale - vec3(0.1, 0.2, 0.3)
} }

twice! { Symbolic rodrigues(coord coord coord): fn f(x: Coord, y: Coord, z: Coord) -> Vec3 {
    let w = vec3(x, y, z);
    let angle = w.norm();
    let axis = w / angle;
    let v = vec3(1.0, 0.5, -0.25);
    let (s, c) = angle.sin_cos();
    v * c + axis.cross(v) * s + axis * (axis.dot(v) * (1.0 - c)) - vec3(0.0, 1.0, 0.0)
} }

twice! { Symbolic rope_over_pulleys(coords ([(0.0, 2.0, 0.2), (3.0, 2.5, 0.3)]) (9.0)): fn f(q: [Coord; 4], pulleys: [(f64, f64, f64); 2], length: f64) -> f64 {
    let ends = [(q[0] - 4.0, q[1] - 4.0), (q[2] + 6.0, q[3] - 4.0)];
    let mut points = vec![(ends[0].0, ends[0].1, 0.0)];
    points.extend(pulleys.iter().copied());
    points.push((ends[1].0, ends[1].1, 0.0));
    let mut total = 0.0;
    for pair in points.windows(2) {
        let (x0, y0, r0) = pair[0];
        let (x1, y1, r1) = pair[1];
        let d = (x1 - x0).hypot(y1 - y0);
        total += (d * d - (r1 - r0).powi(2)).sqrt() + (r0 + r1) * ((r1 - r0) / d).asin();
    }
    total - length
} }

twice! { Symbolic open_belt(coord (1.0) (0.4) (8.0)): fn f(x: Coord, r: f64, s: f64, length: f64) -> f64 {
    let c = x + 4.0;
    let beta = ((r - s) / c).asin();
    2.0 * c * beta.cos() + r * (std::f64::consts::PI + 2.0 * beta) + s * (std::f64::consts::PI - 2.0 * beta) - length
} }

twice! { Symbolic quaternion_product(spatial spatial): fn f(i: Spatial, j: Spatial) -> [f64; 3] {
    fn hamilton(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
        let [a0, a1, a2, a3] = a;
        let [b0, b1, b2, b3] = b;
        [
            a0 * b0 - a1 * b1 - a2 * b2 - a3 * b3,
            a0 * b1 + a1 * b0 + a2 * b3 - a3 * b2,
            a0 * b2 - a1 * b3 + a2 * b0 + a3 * b1,
            a0 * b3 + a1 * b2 - a2 * b1 + a3 * b0,
        ]
    }
    let conjugate = [i.p.e0, -i.p.e1, -i.p.e2, -i.p.e3];
    let [_, x, y, z] = hamilton(conjugate, [j.p.e0, j.p.e1, j.p.e2, j.p.e3]);
    [x, y, z]
} }

twice! { Symbolic universal_joint(coord coord (0.4)): fn f(a: Coord, b: Coord, bend: f64) -> f64 {
    (b.tan() * bend.cos() - a.tan()) * a.cos() * b.cos()
} }

twice! { Symbolic distances_to_anchors(planar (vec![1.0])): fn f(i: Planar, weights: Vec<f64>) -> f64 {
    let anchors = [vec2(0.0, 0.0), vec2(2.0, 1.0), vec2(-1.0, 2.0)];
    let nearest = anchors.iter().map(|a| (i.r - *a).norm()).min_by(|a, b| a.partial_cmp(b).unwrap()).unwrap();
    nearest * weights[0] - 0.5
} }

twice! { Symbolic polygon_area(coords): fn f(q: [Coord; 6]) -> f64 {
    let points: Vec<(f64, f64)> = q.chunks(2).map(|c| (c[0], c[1])).collect();
    let n = points.len();
    let twice: f64 = (0..n).map(|k| (points[k], points[(k + 1) % n])).map(|((x0, y0), (x1, y1))| x0 * y1 - x1 * y0).sum();
    0.5 * twice - 1.0
} }

twice! { Symbolic determinant_by_elimination(coords): fn f(q: [Coord; 4]) -> f64 {
    let mut m = [[q[0] + 4.0, q[1], 0.5], [q[2], 5.0, q[3]], [0.25, q[0], 6.0]];
    let mut det = 1.0;
    for k in 0..3 {
        det *= m[k][k];
        for i in k + 1..3 {
            let factor = m[i][k] / m[k][k];
            for j in k..3 {
                let above = m[k][j];
                m[i][j] -= factor * above;
            }
        }
    }
    det - 100.0
} }

twice! { Symbolic gram_schmidt(spatial): fn f(i: Spatial) -> (f64, f64) {
    let start = [i.r, vec3(1.0, 0.5, 0.0), vec3(0.0, 1.0, 2.0)];
    let mut basis: Vec<Vec3> = Vec::new();
    for v in start {
        let mut w = v;
        for b in &basis {
            w -= *b * b.dot(v);
        }
        basis.push(w.normalize());
    }
    (basis[2].x - 0.5, basis[1].dot(basis[2]) + basis[0].y)
} }
