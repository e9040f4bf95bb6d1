//! Near-parallelograms, their couplers off by 1e-12 to 1e-6: the verdict does not depend on the
//! grid.

use kin::error::FailureKind;
use kin::prelude::*;
use kin::{Engine, Error, SolverOptions};

use crate::families::{Frame, Random, near_parallelogram, parallelogram_off_by};

/// How many a test run takes; `KIN_CAMPAIGN=10000` is the whole campaign, for a release build.
fn count() -> usize {
    std::env::var("KIN_CAMPAIGN").ok().and_then(|count| count.parse().ok()).unwrap_or(30)
}

/// The number of the first one; `KIN_FIRST=5000` runs a campaign in parts.
fn first() -> usize {
    std::env::var("KIN_FIRST").ok().and_then(|first| first.parse().ok()).unwrap_or(540)
}

/// The end of a run in words, with the times at which something happens.
fn verdict(system: &System, steps: usize, engine: Engine) -> (String, Vec<f64>) {
    let options = SolverOptions::new().engine(engine);
    let passed =
        |motion: &Motion| motion.singular_positions().iter().map(|at| at.t).collect::<Vec<f64>>();
    match system.solver().options(options.clone()).run(linspace(0.0, 1.0, steps + 1)) {
        Ok(motion) => ("moves".to_string(), passed(&motion)),
        Err(Error::Run(failure)) if matches!(failure.kind, FailureKind::Toggle { .. }) => {
            let before = failure.motion.iter().flat_map(passed);
            ("toggle".to_string(), before.chain([failure.t]).collect())
        }
        Err(error) => {
            (error.to_string().lines().next().unwrap_or_default().to_string(), Vec::new())
        }
    }
}

fn is_same((one, times): &(String, Vec<f64>), (other, expected): &(String, Vec<f64>)) -> bool {
    let near = times.iter().zip(expected).all(|(t, expected)| (t - expected).abs() < 1e-6);
    one == other && times.len() == expected.len() && near
}

#[test]
fn near_parallelograms_end_alike_on_coarse_and_fine_grids() {
    let mut wrong = Vec::new();
    let mut toggles = 0;
    let mut apart = 0;
    for number in first()..first() + count() {
        let mut random = Random::of(number);
        let (mut system, off) = near_parallelogram(&mut random, Frame::default()).expect("builds");
        // A coupler that is too short leaves no position where the run would begin with all links
        // in line.
        let Ok(begin) = system.position(0.0) else {
            apart += 1;
            continue;
        };
        system.set_initial(&begin.q).expect("sets");
        let steps = random.one_of(&[1, 3, 5, 9, 10, 36]);
        let fine = random.one_of(&[90, 180, 360]);
        let found =
            [(steps, Engine::StepByStep), (fine, Engine::StepByStep), (fine, Engine::Compiled)]
                .map(|(steps, engine)| verdict(&system, steps, engine));
        toggles += usize::from(found[0].0 == "toggle");
        let is_told = ["moves", "toggle"].contains(&found[0].0.as_str());
        if !is_told || !found.iter().all(|own| is_same(own, &found[0])) {
            wrong.push(format!("{number}, off by {off:e}, {steps} and {fine} steps: {found:?}"));
        }
    }
    println!("{} near-parallelograms, {toggles} of them end in a toggle", count());
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), count(), wrong.join("\n"));
    assert!(toggles > count() / 10 && apart <= 1 + count() / 100, "{toggles} {apart}");
}

/// The motor of the first one goes 0.0016 rad beyond the line of all links and back within 1 ms, so
/// that a step over it begins and ends on the same side, and begins much nearer to the line than it
/// ends. That of the second one begins 0.0016 rad before the line, at rest.
#[test]
fn a_toggle_that_a_motor_passes_there_and_back_is_found_on_every_grid() {
    for (number, expected) in [(3040, 0.027_315_136_9), (3841, 0.002_435_080_9)] {
        let (mut system, _) =
            near_parallelogram(&mut Random::of(number), Frame::default()).expect("builds");
        let begin = system.position(0.0).expect("closes");
        system.set_initial(&begin.q).expect("sets");
        for steps in [1, 3, 5, 9, 10, 36, 90, 180] {
            let (end, times) = verdict(&system, steps, Engine::StepByStep);
            let is_there = times.iter().all(|t| (t - expected).abs() < 1e-8);
            let what = format!("{number}, {steps} steps: {end} {times:?}");
            assert!(end == "toggle" && is_there && times.len() == 2, "{what}");
        }
    }
}

/// How many far from the origin a test run takes.
fn count_of_moved() -> usize {
    if count() >= 1000 { count() / 10 } else { 8 }
}

/// Far from the origin rounding of points is a thousand times smaller than what the coupler is off
/// by: it hides neither a toggle nor that there is none.
#[test]
fn near_parallelograms_far_from_the_origin_end_alike_on_coarse_and_fine_grids() {
    for (place, off) in [(1e6, 1e-6), (1e6, 1e-5), (1e4, 1e-6), (1e3, 1e-8)] {
        for number in 0..count_of_moved() {
            let mut random = Random::of(number);
            let off = off * random.one_of(&[1.0, -1.0]);
            let steps = random.one_of(&[1, 3, 5, 9, 10, 36]);
            let frame = Frame { place, ..Frame::default() };
            let mut system = parallelogram_off_by(&mut random, off, frame).expect("builds");
            let Ok(begin) = system.position(0.0) else { continue };
            system.set_initial(&begin.q).expect("sets");
            let all =
                [(steps, Engine::StepByStep), (90, Engine::StepByStep), (90, Engine::Compiled)]
                    .map(|(steps, engine)| verdict(&system, steps, engine));
            let is_told = ["moves", "toggle"].contains(&all[0].0.as_str());
            assert!(
                is_told && all.iter().all(|own| is_same(own, &all[0])),
                "{number}, off by {off:e} at {place:e}, {steps} steps: {all:?}"
            );
        }
    }
}
