//! All mechanisms of the gallery, by both engines.

use kin::data::Registry;
use kin::prelude::*;

use crate::{compiled, differences};

#[path = "../data/own.rs"]
mod own;

pub fn mechanisms() -> Vec<(String, System)> {
    let registry = Registry::new()
        .with::<own::slider_crank>()
        .with::<own::parabolic_slot>()
        .with::<own::geneva>();
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/examples");
    let mut paths: Vec<_> = std::fs::read_dir(folder)
        .expect("the gallery")
        .map(|file| file.expect("a file").path())
        .collect();
    paths.sort();
    let name = |path: &std::path::Path| {
        path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    };
    let read = |path: &std::path::PathBuf| {
        Mechanism::read_json(path, &registry).expect("reads").build().expect("builds")
    };
    paths.iter().map(|path| (name(path), read(path))).collect()
}

/// Near a singular position q̈ is what rounding makes of it: there both runs are off by more.
fn allowed(name: &str) -> [f64; 3] {
    if name == "16_change_points" { [1e-11, 1e-8, 1e-4] } else { [1e-11, 1e-10, 1e-9] }
}

#[test]
fn both_engines_give_the_same_motion_or_the_same_error() {
    for (name, system) in mechanisms() {
        for times in [linspace(0.0, 2.0, 101), linspace(0.0, 2.0, 1501), linspace(1.0, -0.5, 401)] {
            match (system.run(&times), system.solver().options(compiled()).run(&times)) {
                (Ok(plain), Ok(program)) => {
                    let off = differences(&plain, &program);
                    let bounds = allowed(&name);
                    let counts = program.engine();
                    assert!(
                        off.iter().zip(bounds).all(|(off, bound)| *off < bound),
                        "{name}: {off:?} {counts:?}"
                    );
                    assert_eq!(plain.events().len(), program.events().len(), "{name}");
                    same_breaks(&plain, &program, &name);
                    let singular = |motion: &Motion| {
                        motion
                            .singular_positions()
                            .iter()
                            .map(|found| found.t)
                            .collect::<Vec<f64>>()
                    };
                    let pairs = singular(&plain).into_iter().zip(singular(&program));
                    assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-9), "{name}");
                    assert_eq!(singular(&plain).len(), singular(&program).len(), "{name}");
                    // On a coarse grid a step now and then is too long for either engine.
                    let share = if times.len() > 200 { 0.05 } else { 0.15 };
                    assert!(
                        counts.handed_back as f64 <= share * times.len() as f64,
                        "{name}: {counts:?}"
                    );
                }
                (Err(plain), Err(program)) => {
                    assert_eq!(plain.to_string(), program.to_string(), "{name}")
                }
                (plain, program) => {
                    panic!("{name}: {:?} {:?}", plain.map(|_| ()), program.map(|_| ()))
                }
            }
        }
    }
}

/// The planetary train: its laws have a bound over all time that is too wide for a step to be told
/// by it, and a narrow one where it runs.
#[test]
fn most_times_of_fine_grids_are_computed_by_the_program() {
    for (name, system) in mechanisms() {
        let times = linspace(0.0, 2.0, 2001);
        let counts = system.solver().options(compiled()).run(&times).expect("runs").engine();
        assert!(10 * counts.compiled >= 9 * times.len(), "{name}: {counts:?}");
        assert!(20 * counts.handed_back <= times.len(), "{name}: {counts:?}");
    }
}

/// The same breaks in the same order; one that is at a time of the grid may be told on either side
/// of it.
fn same_breaks(plain: &Motion, program: &Motion, name: &str) {
    assert_eq!(plain.breaks().len(), program.breaks().len(), "{name}");
    let step = (plain.times()[1] - plain.times()[0]).abs();
    for (a, b) in plain.breaks().iter().zip(program.breaks()) {
        let near = (a.between.0 - b.between.0).abs() <= 1.001 * step
            && (a.found.x - b.found.x).abs() < 1e-12;
        assert!(
            near && (&a.constraint, &a.law, a.found.order)
                == (&b.constraint, &b.law, b.found.order),
            "{name}: {a:?} {b:?}"
        );
    }
}
