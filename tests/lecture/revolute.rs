//! "Constraint Library: Revolute".

use kin::check::any_planar;
use kin::prelude::*;

use crate::support::*;

/// The slide's formulas, body j's columns with the sign of the derivative (its first line repeats
/// the minus signs).
fn by_hand(q: &[f64; 6], qd: &[f64; 6], u_i: V2, u_j: V2) -> Hand {
    let [xi, yi, ti, xj, yj, tj] = *q;
    let [vxi, vyi, wi, vxj, vyj, wj] = *qd;
    let ai = a(ti) * u_i;
    let aj = a(tj) * u_j;
    let ti_u = a_theta(ti) * u_i;
    let tj_u = a_theta(tj) * u_j;
    let mut hand = Hand::new(2, 6);
    // R_i + A_i ū_i − R_j − A_j ū_j
    hand.c = column_of(V2::new(xi, yi) + ai - V2::new(xj, yj) - aj);
    // [I, A_θ^i ū_i, −I, −A_θ^j ū_j]
    hand.c_q = nalgebra::DMatrix::from_row_slice(
        2,
        6,
        &[1.0, 0.0, ti_u.x, -1.0, 0.0, -tj_u.x, 0.0, 1.0, ti_u.y, 0.0, -1.0, -tj_u.y],
    );
    hand.c_q_qd = column_of(V2::new(vxi, vyi) + wi * ti_u - V2::new(vxj, vyj) - wj * tj_u);
    // θ̇_j² A_j ū_j − θ̇_i² A_i ū_i; C_t, C_qt and C_tt are zero
    hand.c_qqd_qd = column_of(wj * wj * aj - wi * wi * ai);
    hand.q_d = column_of(wi * wi * ai - wj * wj * aj);
    hand
}

#[test]
fn revolute_terms_are_the_lectures() {
    let mut random = Random::new(1);
    let mut comparison = Comparison::of("revolute");
    for _ in 0..STATES {
        let (q, qd) = random.bodies();
        let u_i = random.vector(2.0);
        let u_j = random.vector(2.0);
        let joint = revolute(any_planar(), any_planar(), vec2(u_i.x, u_i.y), vec2(u_j.x, u_j.y));
        comparison.check(&joint, &q, &qd, random.within(5.0), &by_hand(&q, &qd, u_i, u_j));
    }
}
