//! Circuits: the whole curve of positions by arc length, past dead centres.

use kin::prelude::*;
use kin::solver::Circuit;

use crate::models::FourBar;

/// A four-bar with links of random lengths that is no change-point mechanism, at an angle of its
/// driven link at which it can be assembled.
fn four_bar(random: &mut fastrand::Rng) -> (FourBar, f64, f64) {
    loop {
        let mut length = || 0.3 + 1.7 * random.f64();
        let [driven, next, last, ground] = [length(), length(), length(), length()];
        let bar = FourBar { driven, next, last, ground, by_coupler: false };
        let angle = TAU * random.f64() - PI;
        let side = if random.bool() { 1.0 } else { -1.0 };
        let mut sorted = [driven, next, last, ground];
        sorted.sort_by(f64::total_cmp);
        let excess = sorted[0] + sorted[3] - sorted[1] - sorted[2];
        let clear = |angle: f64| bar.angles(angle, side).is_some();
        if excess.abs() > 0.05 && [-0.05, 0.0, 0.05].iter().all(|d| clear(angle + d)) {
            return (bar, angle, side);
        }
    }
}

/// True if the shortest and the longest link together are shorter than the two others: the
/// mechanism has two circuits (Grashof), otherwise one.
fn is_grashof(bar: &FourBar) -> bool {
    let mut sorted = [bar.driven, bar.next, bar.last, bar.ground];
    sorted.sort_by(f64::total_cmp);
    sorted[0] + sorted[3] < sorted[1] + sorted[2]
}

/// The angles between −π and π at which a link of the length `own` on the ground reaches its dead
/// centre: the two links that follow are in line.
fn limits(own: f64, ground: f64, others: [f64; 2]) -> Vec<f64> {
    let mut all = Vec::new();
    for span in [others[0] + others[1], (others[0] - others[1]).abs()] {
        let cosine = (own * own + ground * ground - span * span) / (2.0 * own * ground);
        if cosine.abs() <= 1.0 {
            all.extend([cosine.acos(), -cosine.acos()]);
        }
    }
    all
}

fn wrapped(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}

fn circuit(bar: &FourBar, angle: f64, side: f64) -> Circuit {
    let (system, _) = bar.system(Law::linear(angle, 1.0), angle, side).unwrap();
    system.circuit("motor", 361).unwrap()
}

/// Every angle at which a link turns back on the circuit is a dead centre in closed form; of a
/// mechanism with one circuit all of them are on it, of one with two circuits half of them.
#[test]
fn dead_centres_of_random_four_bars_are_those_of_closed_forms() {
    let mut classes = [0; 2];
    for seed in 0..100 {
        let mut random = fastrand::Rng::with_seed(seed);
        let (bar, angle, side) = four_bar(&mut random);
        let circuit = circuit(&bar, angle, side);
        assert!(circuit.is_closed(), "{seed} {bar:?}: {:?}", circuit.ends());
        assert!(circuit.crossings().is_empty(), "{seed} {bar:?}");
        assert_eq!(circuit.motion().len(), 361);
        let FourBar { driven, next, last, ground, .. } = bar;
        let input = limits(driven, ground, [next, last]);
        // The rocker's angle goes from its pin on the ground; the crank is seen from there at the
        // other side.
        let output: Vec<f64> =
            limits(last, ground, [driven, next]).iter().map(|angle| PI - angle).collect();
        let share = if is_grashof(&bar) { 2 } else { 1 };
        classes[share - 1] += 1;
        let found = circuit.dead_centres();
        assert_eq!(found.len(), input.len() / share, "{seed} {bar:?} {found:?} {input:?}");
        for dead in found {
            let off = input.iter().map(|angle| wrapped(dead.value - angle).abs());
            assert!(off.fold(f64::INFINITY, f64::min) < 1e-12, "{seed} {bar:?} {dead:?} {input:?}");
        }
        let turned = circuit.extremes("rocker.theta").unwrap();
        assert_eq!(turned.len(), output.len() / share, "{seed} {bar:?} {turned:?} {output:?}");
        for dead in turned {
            let off = output.iter().map(|angle| wrapped(dead.value - angle).abs());
            assert!(
                off.fold(f64::INFINITY, f64::min) < 1e-11,
                "{seed} {bar:?} {dead:?} {output:?}"
            );
        }
        // All positions are positions of the linkage, on one of its two sides.
        for q in (0..361).map(|k| circuit.motion().q(k)) {
            let off = bar.error(q, 1.0).min(bar.error(q, -1.0));
            // Near a dead centre the closed form loses half of its digits.
            assert!(off < 1e-6, "{seed} {bar:?} {off:e}");
        }
        // A Grashof linkage stays on its circuit, on which the driven link of a crank turns round.
        let last = circuit.motion().q(360);
        let first = circuit.motion().q(0);
        for k in [2, 5, 8] {
            assert!(wrapped(last[k] - first[k]).abs() < 1e-7, "{seed} {bar:?} {k}");
        }
    }
    assert!(classes.iter().all(|count| *count > 20), "{classes:?}");
}

/// The coupler curve is closed and satisfies the loop: its points have the right distances from the
/// pins, and the whole curve has points beyond the dead centres.
#[test]
fn a_coupler_curve_is_one_closed_path() {
    let bar = FourBar { driven: 2.0, next: 1.5, last: 2.2, ground: 3.5, by_coupler: false };
    let (system, [_, coupler, _]) = bar.system(Law::constant(0.3), 0.3, 1.0).unwrap();
    let circuit = system.circuit("motor", 721).unwrap();
    let path = circuit.motion().point(coupler, vec2(0.75, 0.0)).unwrap();
    assert!((path.r()[0] - path.r()[720]).norm() < 1e-7);
    for r in path.r() {
        assert!(((r - vec2(3.5, 0.0)).norm() - 2.2).abs() < 1e-12);
    }
    let [least, most] = circuit.range("crank.theta").unwrap();
    let limit = bar.toggle(0.3, 1.0).unwrap();
    assert!(
        (most - limit).abs() < 1e-12 && (least + limit).abs() < 1e-12,
        "{least} {most} {limit}"
    );
    assert_eq!(circuit.dead_centres().len(), 2);
}

/// Where circuits cross the curve goes on, and the crossing is listed.
#[test]
fn crossings_are_listed() {
    let bar = FourBar { driven: 1.0, next: 2.0, last: 1.0, ground: 2.0, by_coupler: false };
    let (system, _) = bar.system(Law::linear(0.6, 1.0), 0.6, 1.0).unwrap();
    let circuit = system.circuit("motor", 361).unwrap();
    assert!(circuit.is_closed());
    let angles: Vec<f64> = circuit.crossings().iter().map(|at| wrapped(at.input).abs()).collect();
    assert_eq!(angles.len(), 2, "{angles:?}");
    assert!(angles.iter().all(|angle| angle.min(PI - angle) < 1e-6), "{angles:?}");
    assert!((circuit.inputs()[360] - circuit.inputs()[0]).abs() > 6.2);
}

/// A slider that goes on for ever has an open circuit.
#[test]
fn an_open_circuit_says_why_it_ends() {
    let mut m = Mechanism::new("feed");
    let x = m.length("x", 0.0).unwrap();
    m.add("motor", drive(x, Law::constant(0.5))).unwrap();
    let circuit = m.build().unwrap().circuit("motor", 11).unwrap();
    assert!(!circuit.is_closed() && circuit.ends().is_some());
    assert!(circuit.dead_centres().is_empty());
}

/// Wrong names and numbers are errors.
#[test]
fn mistakes_of_circuits_are_named() {
    let bar = FourBar { driven: 2.0, next: 1.5, last: 2.2, ground: 3.5, by_coupler: false };
    let (system, _) = bar.system(Law::constant(0.3), 0.3, 1.0).unwrap();
    let unknown = system.circuit("crank", 100).unwrap_err().to_string();
    assert!(unknown.contains("`crank`") && unknown.contains("`motor`"), "{unknown}");
    let few = system.circuit("motor", 1).unwrap_err().to_string();
    assert!(few.contains("at least 2 positions, not 1"), "{few}");
    let circuit = system.circuit("motor", 100).unwrap();
    assert!(circuit.range("nothing").unwrap_err().to_string().contains("`crank.theta`"));
}
