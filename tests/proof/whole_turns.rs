//! The examples' mechanisms, proved for as long as they run.

use kin::data::Registry;
use kin::prelude::*;

use crate::engines::Engines;

use crate::models::FourBar;
use crate::own;

/// Each example with its seconds and a number of steps that is not too large for a test.
const EXAMPLES: [(&str, f64, usize); 15] = [
    ("01_slider_crank", 1.0, 120),
    ("02_two_link_manipulator", 24.0, 120),
    ("03_custom_constraint", 1.0, 60),
    ("04_four_bar", 1.0, 90),
    ("05_quick_return", 1.0, 90),
    ("06_scotch_yoke", 2.0, 60),
    ("07_cam_follower", 2.0, 96),
    ("08_peaucellier", 2.0, 40),
    ("09_jansen_leg", 1.0, 60),
    ("10_drawn_path", 6.0, 60),
    ("11_epicyclic_gears", 8.0, 40),
    ("12_hookes_joint", 4.0, 40),
    ("13_stewart_platform", 8.0, 80),
    ("14_sweep_four_bars", 6.0, 90),
    ("15_windscreen_wiper", 1.0, 90),
];

fn example(name: &str) -> System {
    let path = format!("{}/tests/data/examples/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let registry = Registry::new().with::<own::slider_crank>().with::<own::parabolic_slot>();
    Mechanism::read_json(path, &registry).expect("reads").build().expect("builds")
}

/// Whole turns of every example, bare coordinates, planar and spatial bodies, cams and gears among
/// them: proved, and computed to rounding.
#[test]
fn every_example() {
    for (name, seconds, steps) in EXAMPLES {
        let system = example(name);
        let motion = system.run_both(linspace(0.0, seconds, steps + 1)).expect("runs");
        let proof = system.prove(&motion).expect("can be proved");
        println!("{proof}");
        assert!(
            proof.is_complete() && proof.proved() == steps && proof.first_unproved().is_none(),
            "{name}: {proof}"
        );
        let worst = (0..motion.len())
            .flat_map(|k| proof.error(k).expect("bounded"))
            .fold(0.0_f64, |m, x| m.max(*x));
        assert!(worst < 1e-11, "{name}: off by {worst:e}");
        assert!(proof.error(motion.len()).is_none());
    }
}

/// The tube shrinks like the error of the interpolation, with the sixth power of the step, and not
/// like the step.
#[test]
fn tube_is_as_narrow_as_the_interpolation_is_good() {
    let system = example("04_four_bar");
    let radius = |steps: usize| {
        let proof = system.prove(&system.run_both(linspace(0.0, 1.0, steps + 1)).unwrap()).unwrap();
        assert!(proof.is_complete(), "{proof}");
        proof.steps().iter().flat_map(|step| step.tube.clone().unwrap().radius).fold(0.0, f64::max)
    };
    let coarse = radius(40);
    let fine = radius(80);
    println!("{coarse:e} {fine:e}");
    assert!(coarse / fine > 40.0 && fine < 1e-5, "{coarse:e} {fine:e}");
}

/// 36° a step, backwards too; and a position that is off is told to be.
#[test]
fn coarse_grids_and_poor_positions() {
    let bar = FourBar { driven: 1.0, next: 3.5, last: 3.0, ground: 4.0, by_coupler: false };
    let (system, _) = bar.system(Law::linear(0.3, TAU), 0.3, 1.0).unwrap();
    for times in [linspace(0.0, 1.0, 11), linspace(1.0, 0.0, 11)] {
        let proof = system.prove(&system.run_both(times).unwrap()).unwrap();
        assert!(proof.is_complete(), "{proof}");
    }
    let motion = system.run_both(linspace(0.0, 1.0, 91)).unwrap();
    let mut data = motion.data();
    data.q[40].iter_mut().for_each(|q| *q += 1e-5);
    let proof = system.prove(&Motion::from_data(&data).unwrap()).unwrap();
    let error = |k: usize| proof.error(k).unwrap().iter().fold(0.0_f64, |m, x| m.max(*x));
    assert!(
        proof.is_complete() && error(39) < 1e-13 && error(40) >= 1e-5 && error(40) < 1e-4,
        "{proof}"
    );
}

/// A motion of one time is a position; one of none is nothing.
#[test]
fn positions_alone() {
    let system = example("04_four_bar");
    let proof = system.prove(&system.run_both([0.2]).unwrap()).unwrap();
    assert!(proof.is_complete() && proof.steps().is_empty());
    assert!(proof.to_string().contains("Kin proved 1 of 1 position."), "{proof}");
}

/// With all lengths in another unit the same steps are proved, those of a motion that cannot be
/// proved all along too.
#[test]
fn units_do_not_matter() {
    let verdicts = |unit: f64, bar: FourBar, to: f64, steps: usize| {
        let FourBar { driven, next, last, ground, by_coupler } = bar;
        let bar = FourBar {
            driven: unit * driven,
            next: unit * next,
            last: unit * last,
            ground: unit * ground,
            by_coupler,
        };
        let (system, _) = bar.system(Law::linear(0.5, 1.0), 0.5, 1.0).unwrap();
        let proof = system.prove(&system.run_both(linspace(0.0, to, steps + 1)).unwrap()).unwrap();
        let tubes: Vec<Option<f64>> = proof
            .steps()
            .iter()
            .map(|step| step.tube.as_ref().ok().map(|tube| tube.alone[2]))
            .collect();
        tubes
    };
    let parallelogram =
        FourBar { driven: 1.0, next: 2.0, last: 1.0, ground: 2.0, by_coupler: false };
    let crank_rocker =
        FourBar { driven: 1.0, next: 3.5, last: 3.0, ground: 4.0, by_coupler: false };
    for (bar, to, steps) in [(parallelogram, 6.0, 61), (crank_rocker, 7.0, 24)] {
        let metres = verdicts(1.0, bar, to, steps);
        for unit in [1e-3, 0.0254, 1e3] {
            let other = verdicts(unit, bar, to, steps);
            let same = |(a, b): (&Option<f64>, &Option<f64>)| match (a, b) {
                (Some(a), Some(b)) => (a / b - 1.0).abs() < 1e-6,
                (a, b) => a == b,
            };
            assert!(metres.iter().zip(&other).all(same), "{unit}: {metres:?} {other:?}");
        }
    }
}
