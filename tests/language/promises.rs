//! What a constraint promises to its solver before the program runs: which terms never change with t, and which are always zero.

use kin::coordinates::Argument;
use kin::dual_route::{ArgumentKind, Equation};
use kin::prelude::*;
use kin::rt::{At, Rates};
use kin::{Dependence, any_coord as c, any_planar as p};

/// C depends on t, C_q does, C_t can be other than zero, Q_d can.
fn promised(constraint: &impl Constraint) -> [bool; 4] {
    let Dependence { c_on_t, c_q_on_t, c_t, q_d } = constraint.depends();
    [c_on_t, c_q_on_t, c_t, q_d]
}

#[constraint]
fn geared(a: Coord, b: Coord, ratio: f64) -> f64 {
    a - ratio * b
}

#[constraint]
fn stepped(a: Coord, t: Time) -> f64 {
    a * a - t.floor()
}

#[constraint]
fn growing(a: Coord, t: Time) -> f64 {
    (1.0 + t) * a
}

#[constraint]
fn searched(a: Coord) -> f64 {
    let mut x = a;
    while x > 1.0 {
        x = x / 2.0;
    }
    x
}

#[test]
fn terms_that_vanish_and_terms_without_time_are_promised() {
    assert_eq!(promised(&revolute(p(), p(), vec2(1.0, 0.0), vec2(0.0, 1.0))), [false, false, false, true]);
    assert_eq!(promised(&geared(c(), c(), 3.0)), [false, false, false, false]);
    assert_eq!(promised(&drive(c(), Law::ramp(2.0))), [true, false, true, true]);
    assert_eq!(promised(&stepped(c())), [true, false, false, true]);
    assert_eq!(promised(&growing(c())), [true, true, true, true]);
}

#[test]
fn the_dual_route_promises_what_the_graph_knows_and_nothing_without_one() {
    let (own, dual) =
        (revolute(p(), p(), vec2(1.0, 0.0), vec2(0.0, 1.0)), kin::by_dual(revolute(p(), p(), vec2(1.0, 0.0), vec2(0.0, 1.0))));
    assert_eq!((own.depends(), own.constants()), (dual.depends(), dual.constants()));
    assert_eq!(searched(c()).route(), Route::Dual);
    assert_eq!(searched(c()).depends(), Dependence::default());
}

#[test]
fn what_is_promised_holds() {
    kin::check::derivatives(geared(c(), c(), 3.0));
    kin::check::derivatives(stepped(c()));
    kin::check::derivatives(growing(c()));
}

/// a² (1 + t) with promises of one's own choice.
#[derive(Clone)]
struct Claims(Dependence, [Option<f64>; 1]);

impl Constraint for Claims {
    fn kind(&self) -> &str {
        "claims"
    }
    fn route(&self) -> Route {
        Route::Hand
    }
    fn arguments(&self) -> Vec<Argument> {
        growing(c()).arguments()
    }
    fn rows(&self) -> &[&str] {
        &["1"]
    }
    fn pattern(&self) -> &[(usize, usize)] {
        &[(0, 0)]
    }
    fn constants(&self) -> &[Option<f64>] {
        &self.1
    }
    fn depends(&self) -> Dependence {
        self.0
    }
    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        kin::dual_route::residual(self, at, c);
    }
    fn jacobian(&self, at: &At<'_>, c_q: &mut [f64]) {
        kin::dual_route::jacobian(self, at, c_q);
    }
    fn velocity_rhs(&self, at: &At<'_>, rhs: &mut [f64]) {
        kin::dual_route::velocity_rhs(self, at, rhs);
    }
    fn acceleration_rhs(&self, at: &At<'_>, qd: &Rates<'_>, t_dot: f64, q_d: &mut [f64]) {
        kin::dual_route::acceleration_rhs(self, at, qd, t_dot, q_d);
    }
}

impl Equation<1, 1> for Claims {
    const ARGUMENTS: &'static [ArgumentKind] = &[ArgumentKind::Coord];
    fn evaluate<D: Dual>(&self, q: &[Real<D>; 1], t: Real<D>) -> [Real<D>; 1] {
        [q[0] * q[0] * (t + 1.0)]
    }
    fn plain(&self, q: &[f64; 1], t: f64) -> [f64; 1] {
        [q[0] * q[0] * (t + 1.0)]
    }
}

#[test]
fn a_false_promise_is_found_by_the_check() {
    let all = Dependence::default();
    let broken = |depends, constant| kin::check::compare(&Claims(depends, [constant])).err().map(|mismatch| mismatch.term);
    assert_eq!(broken(all, None), None);
    assert_eq!(broken(Dependence { c_on_t: false, ..all }, None), Some("C at another t"));
    assert_eq!(broken(Dependence { c_q_on_t: false, ..all }, None), Some("C_q at another t"));
    assert_eq!(broken(Dependence { c_t: false, ..all }, None), Some("C_t"));
    assert_eq!(broken(Dependence { q_d: false, ..all }, None), Some("Q_d"));
    assert_eq!(broken(all, Some(1.0)), Some("a constant of C_q"));
}
