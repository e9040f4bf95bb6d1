//! Laws that end: the values at their ends, and what a run says that goes beyond.

use kin::Motion;
use kin::prelude::*;
use kin::results::EventKind;

use crate::engines::Engines;
use crate::near;

const CLAMPED: Ends = Ends::Clamped { start: 0.0, end: 1.5 };
const TABLE: [(f64, f64); 4] = [(0.0, 0.0), (0.5, 0.4), (1.2, -0.3), (2.0, 1.0)];

fn driven(law: Law) -> (System, Coordinate) {
    let mut m = Mechanism::new("table");
    let x = m.length("x", 0.0).unwrap();
    m.add("d", drive(x, law)).unwrap();
    (m.build().unwrap(), x)
}

fn warned(motion: &Motion) -> Vec<(f64, &str)> {
    let told = motion.events().iter().filter(|event| event.kind == EventKind::BeyondRange);
    told.map(|event| (event.t, event.text.as_str())).collect()
}

#[test]
fn a_spline_beyond_its_table_is_not_silent() {
    let spline = || Law::spline(&TABLE, Ends::Natural);
    let run = |law: Law, times: &[f64]| driven(law).0.run(times).unwrap();
    let motion = run(spline(), &[0.0, 3.0]);
    let [(t, text)] = warned(&motion)[..] else { panic!("{:?}", motion.events()) };
    near(t, 2.0, 1e-12);
    assert_eq!(
        text,
        "`law` of `d` ends at 2, but the run continues to 3. Beyond 2 the law is a straight line"
    );
    assert!(
        motion.summary().contains("warning: t = 2 s: `law` of `d` ends at 2"),
        "{}",
        motion.summary()
    );
    let again = Motion::from_data(&motion.data()).unwrap();
    assert_eq!(again.events(), motion.events());
    let motion = run(spline(), &[1.0, -0.5, -1.0]);
    let [(t, text)] = warned(&motion)[..] else { panic!("{:?}", motion.events()) };
    near(t, 0.0, 1e-12);
    assert_eq!(
        text,
        "`law` of `d` begins at 0, but the run continues to -1. Before 0 the law is a straight line"
    );
    // Both ends, each once; a law that is made of it, later and faster.
    assert_eq!(warned(&run(spline(), &linspace(-1.0, 3.0, 41))).len(), 2);
    for law in [
        Law::quintic_spline(&TABLE, Ends::Natural),
        2.0 * spline() + Law::ramp(1.0),
        // Beside a law that holds its last value before and after the end of the table.
        spline() + Law::sequence(0.5, [(1.0, Law::cycloidal(1.0, 1.0))]),
        Law::sequence(0.5, [(3.0, Law::cycloidal(1.0, 3.0))]) + spline(),
        // A part that is longer than its table.
        Law::sequence(0.0, [(2.6, spline()), (1.0, Law::constant(spline().at(2.6)))]),
    ] {
        assert!(warned(&run(law.clone(), &[0.5, 1.0, 2.0])).is_empty());
        assert_eq!(warned(&run(law, &[0.5, 1.9, 2.1])).len(), 1);
    }
    let shifted = spline().compose(&Law::linear(-1.0, 2.0));
    assert!(warned(&run(shifted.clone(), &[0.5, 1.5])).is_empty());
    near(warned(&run(shifted, &[0.5, 2.0]))[0].0, 1.5, 1e-12);
    let repeated = Law::spline(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)], Ends::Periodic);
    assert!(warned(&run(repeated, &[0.0, 5.0])).is_empty());
}

/// A law that comes to rest and stays there is meant to do so.
#[test]
fn a_sequence_that_holds_its_last_value_is_not_warned_of() {
    let up = || Law::cycloidal(1.0, 1.0);
    for law in [
        Law::sequence(0.5, [(1.0, up())]),
        2.0 * Law::sequence(0.5, [(1.0, up())]) + Law::ramp(1.0),
        Law::sequence(0.5, [(1.0, up())]).compose(&Law::linear(-1.0, 2.0)),
        // Its table is as long as its part.
        Law::sequence(0.5, [(2.0, Law::spline(&TABLE, Ends::Clamped { start: 0.0, end: 0.0 }))]),
        up(),
    ] {
        let motion = driven(law).0.run([0.0, 1.0, 3.0, 9.0]).unwrap();
        assert!(warned(&motion).is_empty(), "{:?}", motion.events());
        assert!(!motion.summary().contains("warning"));
    }
}

/// At the last time the law is that of its table, not what comes after it.
#[test]
fn the_last_acceleration_of_a_table_is_its_own() {
    let sequence = Law::sequence(
        0.0,
        [(1.0, Law::cycloidal(1.0, 1.0)), (1.0, Law::polynomial(&[1.0, 0.0, 0.5, -0.7]))],
    );
    for law in [Law::spline(&TABLE, CLAMPED), Law::quintic_spline(&TABLE, CLAMPED), sequence] {
        let before = law.jet(2.0 - 1e-9);
        let [at, beyond] = [2.0, 2.0 + 1e-9].map(|x| law.jet(x));
        let near_by = |a: f64, b: f64| (a - b).abs() <= 1e-6 * (1.0 + a.abs());
        assert!((0..4).all(|k| near_by(at[k], before[k])), "{at:?} {before:?}");
        assert!(beyond[3] == 0.0 && beyond[2] == 0.0 && at[3] != 0.0);
        let (system, x) = driven(law.clone());
        let motion = system.run(linspace(0.0, 2.0, 11)).unwrap();
        assert_eq!(motion.coordinate(x).unwrap().second_rate.values()[10], at[2]);
        assert!(warned(&motion).is_empty());
    }
}

/// A slope that jumps at the end of a sequence stops a run that goes on, not one that ends there.
#[test]
fn a_run_may_end_where_a_sequence_does() {
    let (system, _) = driven(Law::sequence(0.0, [(2.0, Law::polynomial(&[0.0, 0.0, 0.5]))]));
    for times in [vec![0.0, 1.0, 2.0], vec![2.0, 1.0, 0.0]] {
        assert!(system.run_both(times).is_ok());
    }
    for times in [vec![0.0, 1.0, 2.0, 3.0], vec![1.0, 3.0], vec![3.0, 2.0, 1.0], vec![2.0, 3.0]] {
        let text = system.run_both(&times).unwrap_err().to_string();
        assert!(text.contains("the slope of the law changes suddenly"), "{text}");
    }
}

/// Derivatives by the values of a table are there at its last time.
#[test]
fn a_tolerance_at_the_end_of_a_table() {
    let (system, _) = driven(Law::spline(&TABLE, CLAMPED));
    let motion = system.run(linspace(0.0, 2.0, 11)).unwrap();
    let found = system.sensitivities(&motion, ["d.law.y[3]"]).unwrap();
    near(found.all()[0].q(10)[0], 1.0, 1e-12);
    let motion = system.run(linspace(0.0, 2.5, 6)).unwrap();
    assert!(system.sensitivities(&motion, ["d.law.y[3]"]).is_err());
}
