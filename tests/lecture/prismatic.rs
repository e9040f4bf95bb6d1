//! "Constraint Library: Prismatic", with the blocks D1 to D4 of (C_q q̇)_q.

use kin::check::any_planar;
use kin::extend::by_dual;
use kin::extend::state::{At, Offsets, PLANAR_STATE, PlanarState, Rates};
use kin::prelude::*;
use nalgebra::DMatrix;
use proptest::prelude::*;

use crate::support::*;

/// ū_P^i, ū_P^j, h̄^i and θ0.
#[derive(Clone, Copy, Debug)]
struct Slide {
    u_i: V2,
    u_j: V2,
    h_i: V2,
    theta0: f64,
}

impl Slide {
    fn random(random: &mut Random) -> Self {
        let u_p = random.vector(2.0);
        let u_q = random.vector(2.0);
        // h̄^i = ū_P^i − ū_Q^i
        Slide { u_i: u_p, u_j: random.vector(2.0), h_i: u_p - u_q, theta0: random.within(1.0) }
    }

    fn joint(&self) -> prismatic {
        let vec = |v: V2| vec2(v.x, v.y);
        prismatic(
            any_planar(),
            any_planar(),
            vec(self.u_i),
            vec(self.u_j),
            vec(self.h_i),
            self.theta0,
        )
    }

    /// D1, D2, D3, D4: the second row of (C_q q̇)_q ("Prismatic 3"; in D2 the transpose that the
    /// slide has lost).
    fn blocks(&self, q: &[f64; 6], qd: &[f64; 6]) -> (V2, f64, V2, f64) {
        let Slide { u_i, u_j, h_i, .. } = *self;
        let wi = qd[2];
        let wj = qd[5];
        let h = a(q[2]) * h_i;
        let h_theta = a_theta(q[2]) * h_i;
        let u_theta = a_theta(q[5]) * u_j;
        let relative = V2::new(qd[0] - qd[3], qd[1] - qd[4]);
        let d1 = wi * h_theta;
        let d2 = h_theta.dot(&relative) + wi * (u_i.dot(&h_i) - self.r_ij(q).dot(&h))
            - wj * h_theta.dot(&u_theta);
        let d4 = -wi * u_theta.dot(&h_theta) + wj * h.dot(&(a(q[5]) * u_j));
        (d1, d2, -d1, d4)
    }

    /// r_P^ij = R_i + A_i ū_P^i − R_j − A_j ū_P^j
    fn r_ij(&self, q: &[f64; 6]) -> V2 {
        V2::new(q[0], q[1]) + a(q[2]) * self.u_i - V2::new(q[3], q[4]) - a(q[5]) * self.u_j
    }

    fn by_hand(&self, q: &[f64; 6], qd: &[f64; 6]) -> Hand {
        let wi = qd[2];
        let wj = qd[5];
        let h = a(q[2]) * self.h_i;
        let r = self.r_ij(q);
        let h_theta = a_theta(q[2]) * self.h_i;
        let ui_theta = a_theta(q[2]) * self.u_i;
        let uj_theta = a_theta(q[5]) * self.u_j;
        let turn = r.dot(&h_theta) + h.dot(&ui_theta);
        let mut hand = Hand::new(2, 6);
        hand.c = column(&[q[2] - q[5] - self.theta0, h.dot(&r)]);
        // [0ᵀ, 1, 0ᵀ, −1;  hᵀ, rᵀ A_θ h̄ + hᵀ A_θ ū_P, −hᵀ, −hᵀ A_θ^j ū_P^j]
        let second = [h.x, h.y, turn, -h.x, -h.y, -h.dot(&uj_theta)];
        hand.c_q =
            DMatrix::from_row_slice(2, 6, &[[0.0, 0.0, 1.0, 0.0, 0.0, -1.0], second].concat());
        // "Prismatic 2"
        let relative = V2::new(qd[0] - qd[3], qd[1] - qd[4]);
        hand.c_q_qd = column(&[wi - wj, h.dot(&relative) + wi * turn - wj * h.dot(&uj_theta)]);
        // Q_d2 = −(D1ᵀ Ṙ_i + θ̇_i D2 + D3ᵀ Ṙ_j + θ̇_j D4)
        let (d1, d2, d3, d4) = self.blocks(q, qd);
        let quadratic =
            d1.dot(&V2::new(qd[0], qd[1])) + wi * d2 + d3.dot(&V2::new(qd[3], qd[4])) + wj * d4;
        hand.c_qqd_qd = column(&[0.0, quadratic]);
        hand.q_d = column(&[0.0, -quadratic]);
        hand
    }
}

#[test]
fn prismatic_right_side_is_minus_d1_to_d4() {
    let mut random = Random::new(2);
    let mut comparison = Comparison::of("prismatic");
    for _ in 0..STATES {
        let (q, qd) = random.bodies();
        let slide = Slide::random(&mut random);
        comparison.check(&slide.joint(), &q, &qd, random.within(5.0), &slide.by_hand(&q, &qd));
    }
}

/// Both rows of r(q̇, 0) at q, straight from the constraint.
fn right_side(constraint: &dyn Constraint, q: &[f64; 6], qd: &[f64; 6]) -> [f64; 2] {
    let states = [[q[0], q[1], q[2]], [q[3], q[4], q[5]]]
        .map(|body| PlanarState::new(body).to_array())
        .concat();
    let mut r = [f64::NAN; 2];
    let arguments = [Offsets::new(0, 0), Offsets::new(PLANAR_STATE as u32, 3)];
    constraint.acceleration_rhs(
        &At::new(0.0, &states, &arguments),
        &Rates::new(qd, &arguments),
        0.0,
        &mut r,
    );
    r
}

/// Row `row` of (C_q q̇)_q by polarisation: entry k is −[r(q̇ + e_k, 0) − r(q̇ − e_k, 0)] / 4. Also
/// the largest right side met.
fn polarised(
    constraint: &dyn Constraint,
    q: &[f64; 6],
    qd: &[f64; 6],
    row: usize,
) -> ([f64; 6], f64) {
    let mut largest = 0.0_f64;
    let entries = std::array::from_fn(|k| {
        let [plus, minus] = [1.0, -1.0].map(|side| {
            let moved = std::array::from_fn(|n| qd[n] + if n == k { side } else { 0.0 });
            let r = right_side(constraint, q, &moved)[row];
            largest = largest.max(r.abs());
            r
        });
        -(plus - minus) / 4.0
    });
    (entries, largest)
}

#[test]
fn polarised_right_side_gives_the_blocks_d1_to_d4() {
    let mut random = Random::new(3);
    let mut worst = [0.0_f64; 2];
    for _ in 0..STATES {
        let (q, qd) = random.bodies();
        let slide = Slide::random(&mut random);
        let joint = slide.joint();
        let dual = by_dual(slide.joint());
        assert_eq!((joint.route(), dual.route()), (Route::Symbolic, Route::Dual));
        let (d1, d2, d3, d4) = slide.blocks(&q, &qd);
        let hand = [d1.x, d1.y, d2, d3.x, d3.y, d4];
        for (constraint, worst) in [&joint as &dyn Constraint, &dual].into_iter().zip(&mut worst) {
            // The first row, θ_i − θ_j − θ0, has no second derivative at all.
            assert_eq!(polarised(constraint, &q, &qd, 0).0, [0.0; 6]);
            let (found, largest) = polarised(constraint, &q, &qd, 1);
            for (k, (found, hand)) in found.iter().zip(hand).enumerate() {
                let error = (found - hand).abs() / (1.0 + largest);
                assert!(error <= TOLERANCE, "column {k}: {found} by polarisation, {hand} by hand");
                *worst = worst.max(error);
            }
        }
    }
    println!("D1 to D4 by polarisation: worst {:.1e} symbolic, {:.1e} dual", worst[0], worst[1]);
}

proptest! {
    /// The conditions under which polarisation is right: r(·, 0) is a quadratic form, so the block
    /// along v is symmetric in q̇ and v, and linear in each.
    #[test]
    fn right_side_is_a_quadratic_form_of_the_velocities(
        q in prop::array::uniform6(-3.0..3.0),
        u in prop::array::uniform6(-3.0..3.0),
        v in prop::array::uniform6(-3.0..3.0),
        factor in -4.0..4.0,
        seed in any::<u64>(),
    ) {
        let slide = Slide::random(&mut Random::new(seed));
        let joint = slide.joint();
        let r = |qd: [f64; 6]| right_side(&joint, &q, &qd)[1];
        let combine = |a: f64, b: f64| std::array::from_fn(|k| a * u[k] + b * v[k]);
        let plus = r(combine(1.0, 1.0));
        let minus = r(combine(1.0, -1.0));
        let ru = r(u);
        let rv = r(v);
        let scaled = r(combine(factor, 0.0));
        let size = 1.0 + [plus, minus, ru, rv, scaled].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        // parallelogram law, homogeneity of degree two
        prop_assert!((plus + minus - 2.0 * ru - 2.0 * rv).abs() <= TOLERANCE * size);
        prop_assert!((scaled - factor * factor * ru).abs() <= TOLERANCE * size);
        // and the block of q̇ = u along v, by the formulas: vᵀ (C_q u)_q = [r(u − v) − r(u + v)] /
        // 4
        let (d1, d2, d3, d4) = slide.blocks(&q, &u);
        let along = d1.dot(&V2::new(v[0], v[1])) + d2 * v[2] + d3.dot(&V2::new(v[3], v[4])) + d4 * v[5];
        prop_assert!(((minus - plus) / 4.0 - along).abs() <= TOLERANCE * size);
    }
}
