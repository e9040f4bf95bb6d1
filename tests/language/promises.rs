//! The promises of a constraint to its solver before the program runs: which terms never change
//! with t, and which are always zero.

use kin::check::{any_coord as c, any_planar as p};
use kin::emitted::{At, Rates};
use kin::extend::coordinates::Argument;
use kin::extend::dual_route::{ArgumentKind, Equation};
use kin::extend::{Dependence, Entry, Facts};
use kin::prelude::*;

/// C depends on t, C_q does, C_t can be other than zero, Q_d can, C is not linear.
fn promised(constraint: &impl Constraint) -> [bool; 5] {
    let Dependence { c_on_t, c_q_on_t, c_t, q_d, curved } = constraint.facts().dependence;
    [c_on_t, c_q_on_t, c_t, q_d, curved]
}

#[constraint]
pub fn geared(a: Coord, b: Coord, ratio: f64) -> f64 {
    a - ratio * b
}

#[constraint]
pub fn stepped(a: Coord, t: Time) -> f64 {
    a * a - t.floor()
}

#[constraint]
pub fn wrapped(a: Coord, t: Time) -> f64 {
    a - (a / 2.0).floor() * 2.0 - t
}

#[constraint]
pub fn growing(a: Coord, t: Time) -> f64 {
    (1.0 + t) * a
}

#[constraint]
pub fn searched(a: Coord) -> f64 {
    let mut x = a;
    while x > 1.0 {
        x = x / 2.0;
    }
    x
}

#[test]
fn terms_that_vanish_and_terms_without_time_are_promised() {
    assert_eq!(
        promised(&revolute(p(), p(), vec2(1.0, 0.0), vec2(0.0, 1.0))),
        [false, false, false, true, true]
    );
    assert_eq!(promised(&geared(c(), c(), 3.0)), [false, false, false, false, true]);
    assert_eq!(promised(&drive(c(), Law::ramp(2.0))), [true, false, true, true, false]);
    assert!(!promised(&fixed(p(), vec2(1.0, 0.0), 0.5))[4] && promised(&wrapped(c()))[4]);
    assert_eq!(promised(&stepped(c())), [true, false, false, true, true]);
    assert_eq!(promised(&growing(c())), [true, true, true, true, true]);
}

#[test]
fn the_dual_route_promises_what_the_graph_knows_and_nothing_without_one() {
    let own = revolute(p(), p(), vec2(1.0, 0.0), vec2(0.0, 1.0));
    let dual = kin::extend::by_dual(revolute(p(), p(), vec2(1.0, 0.0), vec2(0.0, 1.0)));
    assert_eq!(
        (own.facts().dependence, own.facts().constants),
        (dual.facts().dependence, dual.facts().constants)
    );
    assert_eq!(searched(c()).route(), Route::Dual);
    assert_eq!(searched(c()).facts().dependence, Dependence::default());
}

#[test]
fn what_is_promised_holds() {
    kin::check::derivatives(geared(c(), c(), 3.0));
    kin::check::derivatives(stepped(c()));
    kin::check::derivatives(growing(c()));
}

/// a² (1 + t) with promises of one's own choice.
#[derive(Clone)]
struct Claims(Dependence, [Option<f64>; 1], Option<usize>, Coordinate);

impl Constraint for Claims {
    fn facts(&self) -> Facts<'_> {
        let Claims(dependence, constants, sides_of_time, _) = self;
        Facts {
            rows: &["1"],
            pattern: &[Entry { row: 0, column: 0 }],
            constants,
            dependence: *dependence,
            sides_of_time: *sides_of_time,
            ..Facts::of("claims")
        }
    }
    fn arguments(&self) -> Vec<Argument> {
        growing(self.3).arguments()
    }
    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        kin::extend::dual_route::residual(self, at, c);
        // Of an argument that is not its own it sees nothing.
        c[0] += at.coord(1).value;
    }
    fn jacobian(&self, at: &At<'_>, c_q: &mut [f64]) {
        kin::extend::dual_route::jacobian(self, at, c_q);
    }
    fn velocity_rhs(&self, at: &At<'_>, rhs: &mut [f64]) {
        kin::extend::dual_route::velocity_rhs(self, at, rhs);
    }
    fn acceleration_rhs(&self, at: &At<'_>, qd: &Rates<'_>, t_dot: f64, q_d: &mut [f64]) {
        kin::extend::dual_route::acceleration_rhs(self, at, qd, t_dot, q_d);
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
    let told = |depends, constant, sides| match kin::check::compare(&Claims(
        depends,
        [constant],
        sides,
        c(),
    )) {
        Ok(_) => String::new(),
        Err(mismatch) => mismatch.to_string(),
    };
    let broken = |depends, constant| told(depends, constant, None);
    assert_eq!(broken(all, None), "");
    let said = |text: String, promise: &str| assert!(text.contains(promise), "{text}");
    said(broken(Dependence { c_on_t: false, ..all }, None), "C, promised not to change with t");
    said(broken(Dependence { c_q_on_t: false, ..all }, None), "C_q, promised not to change with t");
    said(broken(Dependence { c_t: false, ..all }, None), "C_t, promised to be zero");
    said(broken(Dependence { q_d: false, ..all }, None), "Q_d, promised to be zero");
    said(broken(Dependence { curved: false, ..all }, None), "C, promised to be linear");
    said(broken(all, Some(1.0)), "an entry of C_q, promised to be constant");
    said(told(all, None, Some(0)), "given the numbers of the time");
}

#[test]
fn a_constraint_sees_its_own_arguments_and_is_believed_what_can_be() {
    let straight = Dependence { curved: false, ..Dependence::default() };
    for (depends, sides, c) in [
        (Dependence::default(), None, 8.0),
        (straight, None, 2.0),
        (straight, Some(5), 2.0),
        (straight, Some(usize::MAX), 2.0),
    ] {
        let mut m = Mechanism::new("claims");
        let x = m.length("x", 1.0).unwrap();
        let y = m.length("y", 1.0).unwrap();
        m.add("claims", Claims(depends, [Some(1.0)], sides, x)).unwrap();
        m.add("hold", drive(y, Law::constant(7.0))).unwrap();
        let system = m.build().unwrap();
        assert_eq!(system.residual(&[2.0, 7.0], 1.0).unwrap(), [c, 0.0], "{depends:?} {sides:?}");
    }
}

/// Motor and cam: laws of the time, and functions of the time and of parameters.
#[constraint]
pub fn timed_pair(body: Planar, t: Time, f: Law, k: f64, floor: f64) -> [f64; 2] {
    let w = k.sqrt() * t;
    let gate = if w.sin() > floor { w.cos() } else { 2.0 };
    [body.theta - f.at(t) * body.r.x, body.r.y * gate - w.exp()]
}

#[test]
fn what_depends_on_time_alone_is_evaluated_once_and_is_the_same() {
    let constraint = timed_pair(kin::check::any_planar(), Law::harmonic(0.3, 2.0), 1.7, 0.1);
    assert!(constraint.facts().n_timed > 0);
    kin::check::derivatives(constraint);

    let mut m = Mechanism::new("timed");
    let body = m.planar("body", pose(0.2, 0.1, 0.4)).unwrap();
    let own = timed_pair(body, Law::harmonic(0.3, 2.0), 1.7, 0.1);
    m.add("timed", own.clone()).unwrap();
    m.add("level", hold_x(body, 0.2)).unwrap();
    let system = m.build().unwrap();
    for (k, t) in linspace(-2.0, 3.0, 41).into_iter().enumerate() {
        let q = [0.2 + 0.01 * k as f64, -0.3, 0.5];
        let qd = [0.7, -0.2, 1.1];
        // Alone the constraint is asked without the numbers of the time; in a system with them.
        let alone = kin::extend::terms(&own, &q, &qd, t);
        assert_eq!(system.residual(&q, t).unwrap()[..2], alone.c.as_slice()[..]);
        assert_eq!(system.c_t(&q, t).unwrap()[..2], alone.c_t.as_slice()[..]);
        assert_eq!(system.acceleration_rhs(&q, &qd, t).unwrap()[..2], alone.q_d.as_slice()[..]);
        assert_eq!(system.jacobian(&q, t).unwrap().rows(0, 2), alone.c_q);
    }
}

#[constraint]
pub fn hold_x(body: Planar, x: f64) -> f64 {
    body.r.x - x
}
