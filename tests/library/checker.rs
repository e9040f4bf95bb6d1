//! The public checker: one line in a test, a table to read where something is wrong.

use kin::check;
use kin::check::any_planar;
use kin::extend::coordinates::Argument;
use kin::extend::dual_route::{ArgumentKind, Equation};
use kin::extend::state::{At, Rates};
use kin::extend::{Entry, Facts};
use kin::prelude::*;

/// A crank's pin at a height, with derivatives by hand and a slip in one of them.
#[derive(Clone)]
struct ByHand(PlanarBody);

impl Constraint for ByHand {
    fn facts(&self) -> Facts<'_> {
        const FACTS: Facts<'static> = Facts {
            rows: &["height"],
            pattern: &[Entry::new(0, 1), Entry::new(0, 2)],
            ..Facts::of("pin_height")
        };
        FACTS
    }
    fn arguments(&self) -> Vec<Argument> {
        vec![Argument { name: "crank", target: kin::extend::coordinates::Target::Planar(self.0) }]
    }
    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        let b = at.planar(0);
        c[0] = b.r.y + 0.5 * b.sin;
    }
    fn jacobian(&self, at: &At<'_>, c_q: &mut [f64]) {
        // the slip: it should be 0.5 cos θ
        c_q.copy_from_slice(&[1.0, -0.5 * at.planar(0).cos]);
    }
    fn velocity_rhs(&self, _: &At<'_>, rhs: &mut [f64]) {
        rhs[0] = 0.0;
    }
    fn acceleration_rhs(&self, at: &At<'_>, qd: &Rates<'_>, _: f64, q_d: &mut [f64]) {
        q_d[0] = 0.5 * at.planar(0).sin * qd.planar(0).theta.powi(2);
    }
}

impl Equation<3, 1> for ByHand {
    const ARGUMENTS: &'static [ArgumentKind] = &[ArgumentKind::Planar];
    fn evaluate<D: Dual>(&self, q: &[Real<D>; 3], _: Real<D>) -> [Real<D>; 1] {
        [q[1] + q[2].sin() * 0.5]
    }
    fn plain(&self, q: &[f64; 3], _: f64) -> [f64; 1] {
        [q[1] + q[2].sin() * 0.5]
    }
}

#[test]
fn a_slip_is_shown_as_a_table_with_names() {
    let mismatch = check::compare(&ByHand(any_planar())).expect_err("a slip");
    let text = mismatch.to_string();
    println!("{text}");
    let lines: Vec<&str> = text.lines().collect();
    assert!(
        lines[0].starts_with("the derivatives of `pin_height` differ at state 1 of 24, seed 0x")
    );
    assert!(
        lines[1].split_whitespace().eq(["entry", "hand-written", "dual", "central", "difference"]),
        "{}",
        lines[1]
    );
    assert!(lines[2].trim_start().starts_with("C_q[height, crank.theta]"), "{}", lines[2]);
    assert!(text.contains("\n  crank.theta = ") && text.contains(", velocity "), "{text}");
    // the same entry on all routes, so that one sees which of them is alone
    let entry = &mismatch.entries[0];
    assert!(
        (entry.own + entry.dual).abs() < 1e-12
            && (entry.dual - entry.central.expect("central")).abs() < 1e-8
    );
    assert_eq!(mismatch.entries.len(), 1, "what agrees is not shown");
}

#[test]
fn states_are_the_same_in_every_run_and_others_for_another_seed() {
    let of = |seed: u64| check::compare_from(&ByHand(any_planar()), seed).expect_err("a slip");
    assert!(*of(5) == *of(5) && of(5).q != of(6).q);
    assert!(of(5).to_string().contains("seed 0x5"));
}
