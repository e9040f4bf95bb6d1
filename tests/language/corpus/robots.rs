//! Robots and loops of bodies: Denavit–Hartenberg, products of exponentials, platforms,
//! calibration.

use kin::prelude::*;

use crate::twice;

twice! { Symbolic scara(coords (0.4) (0.3)): fn f(q: [Coord; 4], l1: f64, l2: f64) -> (Vec3, f64) {
    let [shoulder, elbow, lift, turn] = q;
    let tip = Vec3 {
        x: l1 * shoulder.cos() + l2 * (shoulder + elbow).cos(),
        y: l1 * shoulder.sin() + l2 * (shoulder + elbow).sin(),
        z: -lift,
    };
    (tip - vec3(0.5, 0.2, -0.1), shoulder + elbow + turn)
} }

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dh {
    pub a: f64,
    pub alpha: f64,
    pub d: f64,
    pub theta: f64,
}

const PUMA: [Dh; 3] = [
    Dh { a: 0.0, alpha: -std::f64::consts::FRAC_PI_2, d: 0.66, theta: 0.0 },
    Dh { a: 0.43, alpha: 0.0, d: 0.15, theta: 0.1 },
    Dh { a: 0.02, alpha: std::f64::consts::FRAC_PI_2, d: 0.0, theta: -0.2 },
];

twice! { Symbolic denavit_hartenberg_by_matrices(coords (PUMA)): fn f(q: [Coord; 3], table: [Dh; 3]) -> Vec3 {
    let mut rotation = Mat3::identity();
    let mut origin = Vec3::zeros();
    for k in 0..3 {
        let (st, ct) = (q[k] + table[k].theta).sin_cos();
        let (sa, ca) = table[k].alpha.sin_cos();
        origin += rotation * vec3(table[k].a * ct, table[k].a * st, table[k].d);
        rotation = rotation
            * Mat3::from_rows([vec3(ct, -st * ca, st * sa), vec3(st, ct * ca, -ct * sa), vec3(0.0, sa, ca)]);
    }
    origin - vec3(0.3, 0.1, 0.5)
} }

twice! { Symbolic six_revolutes(coords): fn f(q: [Coord; 6]) -> [f64; 3] {
    const A: [f64; 6] = [0.0, 0.4, 0.05, 0.0, 0.0, 0.0];
    const D: [f64; 6] = [0.3, 0.0, 0.1, 0.4, 0.0, 0.1];
    const QUARTERS: [i32; 6] = [1, 0, -1, 1, -1, 0];
    let mut p = [0.0, 0.0, 0.0];
    for k in (0..q.len()).rev() {
        let (s, c) = q[k].sin_cos();
        let [x, y, z] = match QUARTERS[k] {
            1 => [p[0] + A[k], -p[2], p[1] + D[k]],
            -1 => [p[0] + A[k], p[2], -p[1] + D[k]],
            _ => [p[0] + A[k], p[1], p[2] + D[k]],
        };
        p = [c * x - s * y, s * x + c * y, z];
    }
    [p[0] - 0.5, p[1], p[2] - 0.4]
} }

twice! { Symbolic product_of_exponentials(coords ([vec3(0.0, 0.0, 1.0), vec3(0.0, 1.0, 0.0)]) ([vec3(0.0, 0.0, 0.0), vec3(0.3, 0.0, 0.2)])):
fn f(q: [Coord; 2], axes: [Vec3; 2], points: [Vec3; 2]) -> Vec3 {
    let mut p = vec3(0.8, 0.0, 0.2);
    for i in (0..2).rev() {
        let w = axes[i];
        let o = points[i];
        let v = p - o;
        let (s, c) = q[i].sin_cos();
        p = o + v * c + w.cross(v) * s + w * (w.dot(v) * (1.0 - c));
    }
    p - vec3(0.5, 0.5, 0.1)
} }

twice! { Symbolic homogeneous_matrices_inside(coord coord): fn f(a: Coord, b: Coord) -> (f64, f64) {
    #[derive(Clone, Copy)]
    struct Se2([[f64; 3]; 3]);
    impl Se2 {
        const IDENTITY: Se2 = Se2([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        fn turn(angle: f64) -> Se2 {
            let (s, c) = angle.sin_cos();
            Se2([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        }
        fn shift(x: f64, y: f64) -> Se2 {
            Se2([[1.0, 0.0, x], [0.0, 1.0, y], [0.0, 0.0, 1.0]])
        }
    }
    impl std::ops::Mul for Se2 {
        type Output = Se2;
        fn mul(self, Se2(b): Se2) -> Se2 {
            let mut c = [[0.0; 3]; 3];
            for (i, row) in c.iter_mut().enumerate() {
                for (j, entry) in row.iter_mut().enumerate() {
                    *entry = (0..3).map(|k| self.0[i][k] * b[k][j]).sum();
                }
            }
            Se2(c)
        }
    }
    let end = [Se2::turn(a), Se2::shift(1.0, 0.0), Se2::turn(b), Se2::shift(0.8, 0.1)]
        .into_iter()
        .fold(Se2::IDENTITY, |all, step| all * step);
    (end.0[0][2] - 1.2, end.0[1][2] - 0.4)
} }

twice! { Symbolic delta_robot_arm(spatial coord (0.3) (0.8)): fn f(plate: Spatial, arm: Coord, upper: f64, lower: f64) -> f64 {
    let phi = 2.0 * std::f64::consts::PI / 3.0;
    let out = vec3(phi.cos(), phi.sin(), 0.0);
    let elbow = out * (0.2 + upper * arm.cos()) - vec3(0.0, 0.0, upper * arm.sin());
    (plate.point(out * 0.05) - elbow).norm_squared() - lower * lower
} }

twice! { Symbolic three_rrr_platform(planar coords ([(0.0, 0.0), (2.0, 0.0), (1.0, 1.7)])): fn f(plate: Planar, q: [Coord; 3], bases: [(f64, f64); 3]) -> [f64; 3] {
    let corner = |k: usize| {
        let angle = std::f64::consts::FRAC_PI_6 + k as f64 * 2.0 * std::f64::consts::FRAC_PI_3;
        plate.point(vec2(0.3 * angle.cos(), 0.3 * angle.sin()))
    };
    std::array::from_fn(|k| {
        let (bx, by) = bases[k];
        let elbow = vec2(bx + 0.7 * q[k].cos(), by + 0.7 * q[k].sin());
        (corner(k) - elbow).norm_squared() - 0.6_f64.powi(2)
    })
} }

twice! { Symbolic stewart_all_legs(spatial): fn f(top: Spatial) -> [f64; 6] {
    let mut c = [0.0; 6];
    for (k, c) in c.iter_mut().enumerate() {
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        let third = (k / 2) as f64 * 120f64.to_radians();
        let low = third + side * 0.2;
        let high = third + side * 0.9;
        let foot = vec3(2.0 * low.cos(), 2.0 * low.sin(), -1.5);
        let head = vec3(high.cos(), high.sin(), 0.0);
        *c = (top.point(head) - foot).norm() - 1.8;
    }
    c
} }

twice! { Symbolic agile_eye(coords): fn f(q: [Coord; 4]) -> (f64, f64) {
    let [a, b, u, v] = q;
    let first = vec3(-a.sin(), a.cos(), 0.0);
    let second = vec3(0.0, -b.sin(), b.cos());
    let plate = [vec3(v.cos(), u.sin() * v.sin(), -u.cos() * v.sin()), vec3(0.0, u.cos(), u.sin())];
    (first.dot(plate[0]), second.dot(plate[1]))
} }

twice! { Symbolic wheelbase_of_ackermann(coord coord (2.7) (1.5)): fn f(inner: Coord, outer: Coord, base: f64, track: f64) -> f64 {
    let cot = |x: f64| 1.0 / x.tan();
    (cot(outer) - cot(inner) - track / base) * inner.sin() * outer.sin()
} }

twice! { Symbolic cable_driven(planar (vec![(0.0, 2.0), (3.0, 2.0)])): fn f(plate: Planar, anchors: Vec<(f64, f64)>) -> (f64, f64) {
    let ends = [vec2(-0.2, 0.1), vec2(0.2, 0.1)];
    let cable = |k: usize| {
        let (x, y) = anchors[k];
        (plate.point(ends[k]) - vec2(x, y)).norm()
    };
    (cable(0) - 2.0, cable(1) - 2.5)
} }

twice! { Symbolic telescope_with_gears(coords): fn f(q: [Coord; 4]) -> [f64; 3] {
    let mut rows = [0.0; 3];
    for (row, pair) in rows.iter_mut().zip(q.windows(2)) {
        *row = pair[1] - pair[0];
    }
    rows[0] *= 2.0;
    rows
} }

twice! { Symbolic hand_eye(spatial spatial): fn f(hand: Spatial, eye: Spatial) -> [f64; 3] {
    let target = hand.point(vec3(0.1, 0.0, 0.3));
    let Vec3 { x, y, z } = eye.local(target);
    let depth = z + 6.0;
    [x / depth - 0.1, y / depth + 0.05, depth - 5.5]
} }

twice! { Symbolic distortion_of_a_camera(coord coord (-0.2) (0.03)): fn f(x: Coord, y: Coord, k1: f64, k2: f64) -> Vec2 {
    let p = vec2(x, y);
    let r2 = p.dot(p);
    p * (1.0 + r2 * (k1 + r2 * k2)) - vec2(0.3, 0.4)
} }

// Long enough that C_q is cheaper from each row inwards than column by column.
twice! { Symbolic six_revolute_joints_by_loops(
    coords ([[0.3, 0.1, 1.5], [0.5, 0.0, 0.2], [0.1, 0.4, -1.5], [0.0, 0.3, 1.2], [0.2, -0.1, -0.7], [0.1, 0.2, 0.4]])
    (vec3(0.3, 0.2, 0.1))
): fn f(q: [Coord; 6], links: [[f64; 3]; 6], target: Vec3) -> Vec3 {
    let mut turn = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut tip = -target;
    for (angle, [a, d, alpha]) in q.into_iter().zip(links) {
        let (s, c) = angle.sin_cos();
        let (sa, ca) = alpha.sin_cos();
        let step = [[c, -s * ca, s * sa], [s, c * ca, -c * sa], [0.0, sa, ca]];
        let arm = [a * c, a * s, d];
        let mut next = [[0.0; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                tip[i] += turn[i][j] * arm[j];
                for k in 0..3 {
                    next[i][j] += turn[i][k] * step[k][j];
                }
            }
        }
        turn = next;
    }
    tip
} }
