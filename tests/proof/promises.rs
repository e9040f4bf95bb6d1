//! A word that may not be wrong once: constructions in which a proof would be one, each as small as
//! it can be made.

use kin::prelude::*;
use kin::results::{Proof, Unproved};

use crate::engines::Engines;

#[constraint]
fn gated(x: Coord, f: Law, t: Time) -> f64 {
    (if x > 1.0 { x - 0.3 } else { x }) - f.at(t)
}

#[constraint]
fn square(x: Coord, c: f64) -> f64 {
    x * x - c
}

#[constraint]
fn switched(x: Coord, z: Coord, at: f64) -> f64 {
    z - if x >= at { 1.0 } else { 0.0 }
}

#[constraint]
fn aimed(x: Coord, y: Coord, z: Coord, law: Law) -> f64 {
    z - law.at(-y.atan2(x))
}

#[constraint]
fn aimed_by_two(x: Coord, y: Coord, z: Coord, law: Law) -> f64 {
    z - law.at(y.atan2(x) + (2.0 * y).atan2(x))
}

#[constraint]
fn folded(x: Coord) -> f64 {
    x - ((1e16 + 1.0) - 1e16)
}

#[constraint]
fn folded_away(x: Coord, f: Law, t: Time) -> f64 {
    x * x * ((1e16 + 1.0) - 1e16) + x - f.at(t)
}

#[constraint]
fn decimal(x: Coord) -> f64 {
    x - 0.1 * 3.0
}

#[constraint]
fn tripled(x: Coord) -> f64 {
    (0.1 * 3.0) * x - 1.0
}

#[constraint]
fn inclined(z: Coord, law: Law, t: Time) -> f64 {
    z - law.slope(t)
}

#[constraint]
fn follows(x: Coord, y: Coord, law: Law) -> f64 {
    y - law.at(x)
}

/// A mechanism of lengths with these names and values.
pub fn lengths<const N: usize>(
    q: [f64; N],
    add: impl FnOnce(&mut Mechanism, [Coordinate; N]) -> kin::Result<()>,
) -> System {
    let mut m = Mechanism::new("lengths");
    let names = ["x", "y", "z", "w"];
    let all = std::array::from_fn(|k| m.length(names[k], q[k]).expect("a new name"));
    add(&mut m, all).expect("adds");
    m.build().expect("builds")
}

/// The obstacle to a proof of the first step, or of the only position.
pub fn doubt(proof: &Proof, what: &str) -> Unproved {
    assert!(!proof.is_complete(), "{what}: {proof}");
    let step = proof.first_unproved().and_then(|step| step.tube.clone().err());
    step.unwrap_or_else(|| panic!("{what}: {proof}"))
}

/// Where C_q is a constant, `if` jumps all the same: at f = 0.85 both 0.85 and 1.15 are solutions.
#[test]
fn a_jump_beside_the_curve_within_the_tube() {
    let system =
        lengths([0.01], |m, [x]| m.add("c", gated(x, Law::linear(0.01, 0.94))).map(|_| ()));
    let proof = system.prove(&system.run_both([0.0, 1.0]).unwrap()).unwrap();
    for step in proof.steps() {
        assert!(
            step.tube.as_ref().is_err()
                || step.tube.as_ref().is_ok_and(|tube| tube.alone[0] < 0.05),
            "{proof}"
        );
    }
}

/// √5 in f64 is above the root: x is below it, and z is 0.
#[test]
fn a_condition_that_the_last_bit_decides() {
    let system = lengths([5_f64.sqrt(), 1.0], |m, [x, z]| {
        m.add("x", square(x, 5.0))?;
        m.add("z", switched(x, z, 5_f64.sqrt())).map(|_| ())
    });
    let motion = system.run_both([0.0]).unwrap();
    let proof = system.prove(&motion).unwrap();
    assert!(motion.q(0)[1] == 1.0 && !proof.is_complete() && proof.error(0).is_none(), "{proof}");
}

type Adds = fn(&mut Mechanism, [Coordinate; 3], Law) -> kin::Result<()>;

fn turned(y: Law, law: Law, of: Adds) -> Proof {
    let system = lengths([-1.0, 0.03, 0.0], |m, [x, y_, z]| {
        m.add("x", drive(x, Law::constant(-1.0)))?;
        m.add("y", drive(y_, y))?;
        of(m, [x, y_, z], law)
    });
    system.prove(&system.run_both([-0.2, 0.2]).unwrap()).unwrap()
}

/// y dips below zero within the step: the angle jumps by a whole turn, up or down, and the law does
/// not repeat.
#[test]
fn an_angle_over_its_cut_in_a_law_that_does_not_repeat() {
    let dips = Law::polynomial(&[-0.01, 0.0, 1.0]);
    let once: Adds = |m, [x, y, z], law| m.add("z", aimed(x, y, z, law)).map(|_| ());
    let twice: Adds = |m, [x, y, z], law| m.add("z", aimed_by_two(x, y, z, law)).map(|_| ());
    for (what, law) in [
        ("rise", Law::cycloidal(1.0, 4.0)),
        ("line", Law::ramp(1.0)),
        ("of another period", Law::sine(1.0, 0.25, 0.3)),
    ] {
        doubt(&turned(dips.clone(), law.clone(), once), what);
        doubt(&turned(dips.clone(), law, twice), what);
    }
    // the same after two turns, but not after one
    doubt(&turned(dips.clone(), Law::sine(1.0, 0.5, 0.0), twice), "after two turns alone");
    // equal in the middle of the step, where it is asked, and nowhere else
    doubt(&turned(dips.clone(), Law::polynomial(&[0.0, 0.0, 1.0]), once), "even");
    for law in [
        Law::sine(0.1, 3.0, 0.4),
        Law::polynomial(&[0.3]),
        Law::cycloidal(0.1, TAU).compose(&Law::sine(1.0, 1.0, 0.0)),
        Law::spline(&[(0.0, 0.1), (2.0, 0.3), (TAU, 0.1)], Ends::Periodic),
    ] {
        for of in [once, twice] {
            let proof = turned(dips.clone(), law.clone(), of);
            assert!(proof.is_complete(), "{law:?}: {proof}");
        }
    }
}

/// Constants are what they mean, not what f64 makes of them.
#[test]
fn constants_are_not_rounded_before_they_are_read() {
    let system = lengths([0.0], |m, [x]| m.add("c", folded(x)).map(|_| ()));
    let motion = system.run_both([0.0]).unwrap();
    let error = system.prove(&motion).unwrap().error(0).map_or(f64::INFINITY, |e| e[0]);
    assert!((motion.q(0)[0] - 1.0).abs() <= error, "x = {}, proved to {error:e}", motion.q(0)[0]);
    // x² + x = f has two solutions, and they meet at f = −1/4; folded it is x = f
    let system = lengths([0.0], |m, [x]| m.add("c", folded_away(x, Law::ramp(-1.0))).map(|_| ()));
    let proof = system.prove(&system.run_both([0.0, 1.0]).unwrap()).unwrap();
    doubt(&proof, "a square that is folded away");
}

/// 0.3 as the nearest f64 is 1.1e-17 below 3/10, and 0.1 · 3 in f64 is 4.4e-17 above it.
#[test]
fn decimals_are_not_the_nearest_numbers() {
    let system = lengths([0.3], |m, [x]| m.add("c", decimal(x)).map(|_| ()));
    let motion = system.run_both([0.0]).unwrap();
    let error = system.prove(&motion).unwrap().error(0).map_or(f64::INFINITY, |e| e[0]);
    let off = if motion.q(0)[0] == 0.3 { 1.11e-17 } else { 4.44e-17 };
    assert!(off <= error && error < 1e-15, "{error:e}");
    let system = lengths([3.0], |m, [x]| m.add("c", tripled(x)).map(|_| ()));
    let motion = system.run_both([0.0]).unwrap();
    let error = system.prove(&motion).unwrap().error(0).map_or(f64::INFINITY, |e| e[0]);
    // 10/3 is 1.5e-16 above the nearest number
    let off = (motion.q(0)[0] - 10.0 / 3.0 - 1.48e-16).abs();
    assert!(off <= error && error < 1e-14, "{error:e}");
}

/// The slope of a law has its jumps where the law has kinks, though C_q is a constant.
#[test]
fn the_slope_of_a_law_over_its_kink() {
    let kink = Law::sequence(0.0, [(0.5, Law::ramp(1.0)), (0.5, Law::linear(0.5, -1.0))]);
    let system = lengths([1.0], |m, [z]| m.add("c", inclined(z, kink)).map(|_| ()));
    let motion = crate::breaking::posed(&system, &[0.45, 0.55]).unwrap();
    assert_eq!([motion.q(0)[0], motion.q(1)[0]], [1.0, -1.0]);
    doubt(&system.prove(&motion).unwrap(), "slope");
}

/// Over a large argument a sine may be anything between −1 and 1 as far as its bounds know: that
/// hides no jump.
#[test]
fn a_jump_of_a_law_behind_the_bounds_of_a_sine() {
    for omega in [1e5, 1e8, 1e10, 1e13] {
        // parts that meet as far as f64 can tell, and may be off by as much as the argument is
        // rounded
        let end = (omega * 1.0_f64).sin();
        for jump in [0.0, 0.3] {
            let law = Law::sequence(
                0.0,
                [(1.0, Law::sine(1.0, omega, 0.0)), (1.0, Law::constant(end + jump))],
            );
            let law = Law::ramp(0.0) + law.compose(&Law::linear(0.0, 1.0));
            if jump > 0.0 && law.refusal().is_some() {
                continue; // told where it is added
            }
            let system = lengths([0.0, 0.0], |m, [x, y]| {
                m.add("x", drive(x, Law::linear(1.0, 1e-16)))?;
                m.add("y", follows(x, y, law))?;
                Ok(())
            });
            let Ok(motion) = system.run_both([-1.0, 1.0]) else { continue };
            let proof = system.prove(&motion).unwrap();
            assert!(!proof.is_complete() || jump == 0.0 && omega < 1e9, "{omega} {jump}: {proof}");
        }
    }
}

/// A motion without times is no motion of which anything could be said.
#[test]
fn a_motion_without_times() {
    let system = lengths([0.0], |m, [x]| m.add("c", drive(x, Law::ramp(1.0))).map(|_| ()));
    let mut data = system.run_both([0.0]).unwrap().data();
    (data.times, data.q, data.qd, data.qdd, data.iterations, data.residuals) = Default::default();
    let proof = system.prove(&Motion::from_data(&data).unwrap()).unwrap();
    assert!(
        proof.is_complete()
            && proof.error(0).is_none()
            && proof.to_string().contains("0 of 0 positions"),
        "{proof}"
    );
}
