//! Equations with steps: a search that ends beside one proves nothing about what can be met.

use kin::diagnosis::Change;
use kin::prelude::*;

#[constraint]
fn cubic(x: Coord, y: Coord) -> f64 {
    y * y * y + 1.2 * y - x
}

#[constraint]
fn stair(y: Coord, z: Coord, k: f64) -> f64 {
    z - (y * k).floor() - y
}

#[constraint]
fn held(z: Coord, value: f64) -> f64 {
    z - value
}

/// z = ⌊6.5 y⌋ + y takes no value between 0.1538 and 1.1538: nothing is reached "at least", and
/// the step is told.
#[test]
fn step_that_leaves_values_out_is_told() {
    let mut m = Mechanism::new("steps");
    let y = m.length("y", 0.1).unwrap();
    let z = m.length("z", 0.5).unwrap();
    m.add("stair", stair(y, z, 6.5)).unwrap();
    m.add("held", held(z, 0.5)).unwrap();
    let error = m.build().unwrap().run([0.0]).unwrap_err();
    let said = error.to_string();
    let found = error.diagnosis().unwrap();
    let gap = &found.gaps[0];
    assert!(gap.can_jump && !gap.steps.is_empty(), "{said}");
    let step = &gap.steps[0];
    assert_eq!((step.constraint.as_str(), step.coordinate.as_str()), ("stair", "y"), "{said}");
    assert!(
        (step.at - 1.0 / 6.5).abs() < 1e-6 && ((step.to - step.from).abs() - 1.0).abs() < 1e-6,
        "{step:?}"
    );
    assert!(
        said.contains("`stair` jumps from 0.346 to -0.654 at y = 0.1538")
            && !said.contains("at least"),
        "{said}"
    );
    assert!(!said.contains("out of reach"), "{said}");
}

/// An equation that has a solution for every x is never said to be out of reach.
#[test]
fn out_of_reach_is_not_said_beside_a_step() {
    for j in [0, 7, 13, 20, 31, 44, 52] {
        let w = 1.0 + 8.0 * f64::from(j) / 59.0;
        let mut m = Mechanism::new("steps");
        let x = m.length("x", 0.1).unwrap();
        let y = m.length("y", 0.1).unwrap();
        let z = m.length("z", 0.1).unwrap();
        m.add("x", drive(x, Law::sine(0.9, w, 0.3))).unwrap();
        m.add("y", cubic(x, y)).unwrap();
        m.add("z", stair(y, z, 6.5)).unwrap();
        if let Err(error) = m.build().unwrap().run(linspace(0.0, 100.0, 1200)) {
            let said = error.to_string();
            println!("{w}: {said}");
            assert!(!said.contains("at least") && !said.contains("out of reach"), "{w}: {said}");
            let dimension = |change: &Change| matches!(change, Change::Fit { .. });
            assert!(
                !error.diagnosis().is_some_and(|found| found.changes.iter().any(dimension)),
                "{w}: {said}"
            );
        }
    }
}
