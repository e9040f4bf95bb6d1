//! "Moving Point on Rigid Body": a point that moves in its body, ū(t), on a point of another body.

use kin::check::any_planar;
use kin::extend::terms;
use kin::prelude::*;
use nalgebra::DMatrix;

use crate::support::*;

/// The block in a slot: P moves in body i as ū_i(t) and is pinned to body j.      \[m\]
#[constraint]
fn block_in_a_slot(i: Planar, j: Planar, u_j: Vec2, c: [f64; 6], t: Time) -> Vec2 {
    let u_i = vec2(c[0] + c[1] * t + c[2] * t * t, c[3] * (c[4] * t + c[5]).sin());
    i.point(u_i) - j.point(u_j)
}

/// ū_i(t), its first and its second derivative.
fn motion_in_body(c: &[f64; 6], t: f64) -> [V2; 3] {
    let (sin, cos) = (c[4] * t + c[5]).sin_cos();
    [
        V2::new(c[0] + c[1] * t + c[2] * t * t, c[3] * sin),
        V2::new(c[1] + 2.0 * c[2] * t, c[3] * c[4] * cos),
        V2::new(2.0 * c[2], -c[3] * c[4] * c[4] * sin),
    ]
}

fn by_hand(q: &[f64; 6], qd: &[f64; 6], [u, u_dot, u_ddot]: [V2; 3], u_j: V2) -> Hand {
    let [xi, yi, ti, xj, yj, tj] = *q;
    let [vxi, vyi, wi, vxj, vyj, wj] = *qd;
    let ti_u = a_theta(ti) * u;
    let tj_u = a_theta(tj) * u_j;
    let mut hand = Hand::new(2, 6);
    hand.c = column_of(V2::new(xi, yi) + a(ti) * u - V2::new(xj, yj) - a(tj) * u_j);
    hand.c_q = DMatrix::from_row_slice(
        2,
        6,
        &[1.0, 0.0, ti_u.x, -1.0, 0.0, -tj_u.x, 0.0, 1.0, ti_u.y, 0.0, -1.0, -tj_u.y],
    );
    hand.c_q_qd = column_of(V2::new(vxi, vyi) + wi * ti_u - V2::new(vxj, vyj) - wj * tj_u);
    // velocity  Ṙ + θ̇ A_θ ū + A ū̇: the last term is C_t
    hand.c_t = column_of(a(ti) * u_dot);
    // acceleration  R̈ + θ̈ A_θ ū − θ̇² A ū + 2 θ̇ A_θ ū̇ + A ü
    let quadratic = -wi * wi * (a(ti) * u) + wj * wj * (a(tj) * u_j);
    let coriolis = wi * (a_theta(ti) * u_dot);
    let relative = a(ti) * u_ddot;
    hand.c_qqd_qd = column_of(quadratic);
    hand.c_qt_qd = column_of(coriolis);
    hand.c_tt = column_of(relative);
    hand.q_d = column_of(-(quadratic + 2.0 * coriolis + relative));
    hand
}

#[test]
fn moving_point_terms_are_the_lectures_with_coriolis() {
    let mut random = Random::new(7);
    let mut comparison = Comparison::of("moving point");
    for _ in 0..STATES {
        let (q, qd) = random.bodies();
        let c = random.array(2.0);
        let u_j = random.vector(2.0);
        let t = 1.0 + random.within(1.0);
        let joint = block_in_a_slot(any_planar(), any_planar(), vec2(u_j.x, u_j.y), c);
        comparison.check(&joint, &q, &qd, t, &by_hand(&q, &qd, motion_in_body(&c, t), u_j));
        let shipped = moving_point(
            any_planar(),
            any_planar(),
            Law::polynomial(&c[..3]),
            Law::sine(c[3], c[4], c[5]),
            vec2(u_j.x, u_j.y),
        );
        comparison.check(&shipped, &q, &qd, t, &by_hand(&q, &qd, motion_in_body(&c, t), u_j));
    }
}

/// With body j the ground's frame, C is r_P itself: C_q q̇ + C_t is its velocity and C_q q̈ − Q_d
/// its acceleration.
#[test]
fn moving_point_has_the_lectures_velocity_and_acceleration() {
    let mut random = Random::new(8);
    let mut worst = 0.0_f64;
    for _ in 0..STATES {
        let [x, y, theta] = random.array(3.0);
        let [vx, vy, w] = random.array(3.0);
        let [ax, ay, alpha] = random.array(3.0);
        let c = random.array(2.0);
        let t = 1.0 + random.within(1.0);
        let [u, u_dot, u_ddot] = motion_in_body(&c, t);
        let velocity = V2::new(vx, vy) + w * (a_theta(theta) * u) + a(theta) * u_dot;
        let acceleration = V2::new(ax, ay) + alpha * (a_theta(theta) * u) - w * w * (a(theta) * u)
            + 2.0 * w * (a_theta(theta) * u_dot)
            + a(theta) * u_ddot;

        let joint = block_in_a_slot(any_planar(), Ground, vec2(0.0, 0.0), c);
        let found = terms(&joint, &[x, y, theta, 0.0, 0.0, 0.0], &[vx, vy, w, 0.0, 0.0, 0.0], t);
        let rates = &found.c_q * column(&[vx, vy, w, 0.0, 0.0, 0.0]) + &found.c_t;
        let second_rates = &found.c_q * column(&[ax, ay, alpha, 0.0, 0.0, 0.0]) - &found.q_d;
        for (found, hand) in [(rates, velocity), (second_rates, acceleration)] {
            let error = difference(&found, &column_of(hand));
            assert!(error <= TOLERANCE, "{found} {hand}");
            worst = worst.max(error);
        }
    }
    println!("moving point, velocity and acceleration: worst {worst:.1e}");
}
