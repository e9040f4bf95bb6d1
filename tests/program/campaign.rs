//! Random mechanisms with steps and kinks: whichever engine runs them, their verdicts, positions
//! and events are the same.

use std::panic::{AssertUnwindSafe, catch_unwind};

use kin::prelude::*;
use kin::{Engine, SolverOptions};

use crate::engines::{Engines, apart};
use crate::families::{FAMILIES, Frame, system};
use crate::steps::{Case, difference, random};

/// How many a test run takes; `KIN_CAMPAIGN=20000` is the whole campaign, for a release build.
fn count() -> u64 {
    std::env::var("KIN_CAMPAIGN").ok().and_then(|count| count.parse().ok()).unwrap_or(16)
}

/// The number of the first one; `KIN_FIRST=5000` runs a campaign in parts.
fn first() -> u64 {
    std::env::var("KIN_FIRST").ok().and_then(|first| first.parse().ok()).unwrap_or(0)
}

#[test]
fn engines_agree_about_random_mechanisms_with_steps() {
    let mut wrong = Vec::new();
    let mut ran = 0;
    let mut failed = 0;
    for seed in (0..count()).map(|k| first() + k) {
        let Case { words, system, times, loose, .. } = random(seed);
        let by = |engine| system.solver().options(SolverOptions::new().engine(engine)).run(&times);
        let plain = by(Engine::StepByStep);
        ran += usize::from(plain.is_ok());
        failed += usize::from(plain.is_err());
        let mut differ = difference(&system, &times, [&plain, &by(Engine::Compiled)], loose)
            .map(|what| format!("compiled: {what}"));
        if differ.is_none() && system.compile().is_ok() {
            differ = difference(&system, &times, [&plain, &by(Engine::Auto)], loose)
                .map(|what| format!("auto: {what}"));
        }
        wrong.extend(differ.map(|what| format!("{words}\n    {what}")));
    }
    println!("{ran} run, {failed} end with an error, engines differ about {}", wrong.len());
    assert!(
        wrong.is_empty(),
        "{} of {}:\n{}",
        wrong.len(),
        count(),
        wrong.iter().take(12).cloned().collect::<Vec<_>>().join("\n")
    );
    assert!(2 * ran > failed, "{ran} run and {failed} do not");
}

/// A coordinate that other steps give rests on a step, which is small beside how far the origin is:
/// the position has to meet its equations all the same, on the side that is the same for all
/// engines.
#[test]
fn a_coordinate_at_rest_on_a_step_is_on_one_side_by_every_engine() {
    for seed in [682, 1024] {
        let Case { words, system, times, loose, .. } = random(seed);
        let by = |engine| system.solver().options(SolverOptions::new().engine(engine)).run(&times);
        let plain = by(Engine::StepByStep);
        for engine in [Engine::Compiled, Engine::Auto] {
            assert_eq!(
                difference(&system, &times, [&plain, &by(engine)], loose),
                None,
                "{words} {engine:?}"
            );
        }
    }
}

/// Where a prediction is on the other side of a kink, Newton's correction may grow once.
#[test]
fn a_step_over_a_kink_succeeds_by_every_engine() {
    for seed in [10_202, 17_114] {
        let Case { words, system, times, loose, .. } = random(seed);
        let by = |engine| system.solver().options(SolverOptions::new().engine(engine)).run(&times);
        let plain = by(Engine::StepByStep);
        assert!(plain.is_ok(), "{words}: {plain:?}");
        assert_eq!(
            difference(&system, &times, [&plain, &by(Engine::Compiled)], loose),
            None,
            "{words}"
        );
    }
}

/// Where, how large and when a mechanism is.
fn frame(random: &mut crate::families::Random, family: usize) -> Frame {
    let places = [(1.0, 0.0), (1e6, 0.0), (1e-6, 0.0), (1.0, 1e6), (1e-6, 1.0)];
    // Far away rounding hides near-equal links, and whether two loops toggle at once.
    let many = if [0, 2, 5].contains(&family) { 3 } else { places.len() };
    let (scale, place) = random.one_of(&places[..many]);
    let span = random.one_of(&[1.0, 1.0, 1e6, 1e-6]);
    let begin = span * random.one_of(&[0.0, 0.0, 1e3]);
    Frame { scale, place, begin, span, ..Frame::default() }
}

/// Even or jittered times, forwards or backwards.
fn times(random: &mut crate::families::Random, Frame { begin, span, .. }: Frame) -> Vec<f64> {
    let n = random.one_of(&[5, 24, 60, 121, 240]);
    let mut times = linspace(begin, begin + span, n);
    if random.one_of(&[true, false]) {
        times.iter_mut().skip(1).for_each(|t| *t += random.within(-0.3, 0.3) * span / n as f64);
    }
    if random.one_of(&[true, false, false, false]) {
        times.reverse();
    }
    times
}

/// Near-parallelograms and a near-equal slider-crank that come as near a singular position as
/// 1e-4 of their size, and pass no event there.
const NEARLY_SINGULAR: [usize; 5] = [582, 732, 1100, 1902, 1922];

/// The mechanism of a number, at its first position, and its times.
fn placed(number: usize) -> (System, Vec<f64>) {
    let family = number % FAMILIES.len();
    let mut random = crate::families::Random::of(number);
    let frame = frame(&mut random, family);
    let times = times(&mut random, frame);
    let mut system = system(family, &mut random, frame).expect("builds");
    let start = system.position(times[0]).expect("closes");
    system.set_initial(&start.q).expect("sets");
    (system, times)
}

#[test]
fn engines_agree_as_far_as_the_condition_of_nearly_singular_equations_allows() {
    for number in NEARLY_SINGULAR {
        let (system, times) = placed(number);
        let run = system.run_by_all(&times, f64::EPSILON);
        assert!(run.is_ok_and(|motion| motion.singular_positions().is_empty()), "{number}");
    }
}

/// A link that is longer by 1e-13 of its length is more than rounding, in the positions and in
/// every derivative.
#[test]
fn what_a_nearly_singular_condition_allows_is_no_more_than_rounding() {
    for number in NEARLY_SINGULAR {
        let (mut system, times) = placed(number);
        let by_steps = SolverOptions::new().engine(Engine::StepByStep);
        let motion = system.solver().options(by_steps.clone()).run(&times).expect("runs");
        let all = system.parameters();
        let (_, length) = all.iter().find(|(name, _)| name == "A.u_j.x").expect("a length");
        system.set("A.u_j.x", length * (1.0 + 1e-13)).expect("sets");
        let longer = system.solver().options(by_steps).run(&times).expect("runs");
        let off = apart(&system, &motion, &longer, 1.0, 0.0);
        assert!(off[0] > 1.0 && off[1] > 10.0 && off[2] > 10.0, "{number}: {off:?}");
    }
}

#[test]
fn engines_agree_about_ten_families_wherever_and_whenever_they_move() {
    let mut wrong = Vec::new();
    let mut ran = 0;
    let mut failed = 0;
    for number in (0..count()).map(|k| (first() + k) as usize) {
        let family = number % FAMILIES.len();
        let mut random = crate::families::Random::of(number);
        let frame = frame(&mut random, family);
        let times = times(&mut random, frame);
        let words = format!("{number}: {}, {frame:?}, {} times", FAMILIES[family], times.len());
        let Ok(mut system) = system(family, &mut random, frame) else { continue };
        // Parts that do not go together are no motion.
        let Ok(start) = system.position(times[0]) else { continue };
        system.set_initial(&start.q).expect("sets");
        let rounding = f64::EPSILON * (1.0 + frame.place / frame.scale);
        match catch_unwind(AssertUnwindSafe(|| system.run_by_all(&times, rounding))) {
            Ok(run) => {
                ran += usize::from(run.is_ok());
                failed += usize::from(run.is_err());
            }
            Err(panic) => {
                let text = panic.downcast_ref::<String>().cloned().unwrap_or_default();
                wrong.push(format!("{words}\n    {text}"));
            }
        }
    }
    println!("{ran} run, {failed} end with an error, engines differ about {}", wrong.len());
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), count(), wrong.join("\n"));
    assert!(3 * ran > failed, "{ran} run and {failed} do not");
}
