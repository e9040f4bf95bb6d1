//! All that is asked of the gallery's motions, and of runs that fail, by plain steps, by a program,
//! and by what chooses itself: the same texts, and numbers that rounding alone tells apart.

use std::sync::atomic::{AtomicBool, Ordering};

use kin::extend::LawFunction;
use kin::prelude::*;
use kin::{Engine, Error, SolverOptions};

use crate::USUAL;
use crate::engines::Engines;
use crate::gallery::mechanisms;

/// Numbers of texts that differ by less than this, by their size or 1, are one.
const NEAR: f64 = 1e-8;

fn by(engine: Engine) -> SolverOptions {
    SolverOptions::new().engine(engine)
}

/// The same run by each engine; what chooses itself has a program at hand, where there can be one.
fn all(system: &System, times: &[f64]) -> [kin::Result<Motion>; 3] {
    let _ = system.compile();
    [Engine::StepByStep, Engine::Compiled, Engine::Auto]
        .map(|engine| system.solver().options(by(engine)).run(times))
}

/// A text as its words and its numbers.
fn taken_apart(text: &str) -> (Vec<&str>, Vec<f64>) {
    let mut words = Vec::new();
    let mut numbers = Vec::new();
    for word in text
        .split(|c: char| c.is_whitespace() || "(),;:[]|".contains(c))
        .filter(|word| !word.is_empty())
    {
        match word.trim_end_matches('.').parse() {
            Ok(number) => numbers.push(number),
            Err(_) => words.push(word),
        }
    }
    (words, numbers)
}

/// Fails unless two texts have the same words, and numbers that rounding alone tells apart.
#[track_caller]
fn alike(name: &str, one: &str, other: &str) {
    let ([words, others], [numbers, further]) = {
        let a = taken_apart(one);
        let b = taken_apart(other);
        ([a.0, b.0], [a.1, b.1])
    };
    assert_eq!(words, others, "{name}");
    let near = |(a, b): (&f64, &f64)| a == b || (a - b).abs() <= NEAR * (1.0 + a.abs());
    assert!(
        numbers.len() == further.len() && numbers.iter().zip(&further).all(near),
        "{name}:\n{one}\n{other}"
    );
}

/// All that is told of a motion.
fn told(system: &System, motion: &Motion) -> Vec<String> {
    let mut told = vec![match system.prove(motion) {
        // How far the computed positions themselves are off is rounding.
        Ok(proof) => proof.to_string().lines().take(2).collect::<Vec<&str>>().join("\n"),
        Err(error) => error.to_string(),
    }];
    told.extend(
        motion.events().iter().map(|event| format!("{} {} {}", event.t, event.name, event.text)),
    );
    told.extend(motion.singular_positions().iter().map(|found| format!("{found:?}")));
    told.extend(motion.breaks().iter().map(|found| format!("{found:?}")));
    let condition =
        system.condition(motion).map(|series| series.values().iter().copied().fold(0.0, f64::max));
    // Rounding changes a condition in proportion to it.
    told.push(
        condition.map_or_else(|error| error.to_string(), |most| format!("{:.6}", most.log10())),
    );
    for name in motion.names().iter().take(6) {
        told.push(match system.extremes(motion, name.as_str()) {
            Ok(extremes) => format!("{name} {} {}", extremes.min().value, extremes.max().value),
            Err(error) => error.to_string(),
        });
    }
    told
}

#[test]
fn all_that_is_told_of_the_gallery_is_the_same() {
    for (name, system) in mechanisms() {
        let [plain, program, chosen] =
            all(&system, &linspace(0.0, 0.25, 51)).map(|run| run.expect("runs"));
        assert_eq!(plain.engine().compiled, 0, "{name}");
        assert!(
            program.engine().compiled > 25 && chosen.engine() == program.engine(),
            "{name}: {:?}",
            chosen.engine()
        );
        let [plain, others @ ..] = [&plain, &program, &chosen].map(|motion| told(&system, motion));
        for other in others {
            assert_eq!(plain.len(), other.len(), "{name}: {plain:?} {other:?}");
            plain.iter().zip(&other).for_each(|(one, other)| alike(&name, one, other));
        }
    }
}

/// The engine that is chosen by itself, beside plain steps, where a program pays and where it does
/// not.
#[test]
fn the_engine_that_is_chosen_gives_the_verdicts_and_numbers_of_plain_steps() {
    for (name, system) in mechanisms() {
        let few = system.run_both_by_auto(linspace(0.0, 1.0, 101)).expect("runs");
        let many = system.run_both_by_auto(linspace(0.0, 2.0, 4001)).expect("runs");
        assert_eq!((few.len(), many.len()), (101, 4001), "{name}");
    }
}

/// A four-bar of these lengths, one of its links driven.
fn four_bar(lengths: [f64; 4], by_rocker: bool, law: Law) -> System {
    crate::four_bar(lengths, |m, crank, rocker| {
        m.add("motor", drive_angle(if by_rocker { rocker } else { crank }, law)).expect("adds");
    })
}

/// A law that is no number from 0.6 on.
struct Ends;

impl LawFunction for Ends {
    fn jet(&self, t: f64) -> [f64; 4] {
        if t < 0.6 { [t, 1.0, 0.0, 0.0] } else { [f64::NAN; 4] }
    }
}

/// √ is no number beyond t = 0.64 s.
#[constraint]
fn shrinking(x: Coord, t: Time, depth: f64) -> f64 {
    x - 2.0 * (depth - t).sqrt()
}

fn wedge() -> System {
    let mut m = Mechanism::new("wedge");
    let x = m.length("wedge", 1.6).expect("a length");
    m.add("slot", shrinking(x, 0.64)).expect("adds");
    m.build().expect("builds")
}

/// Runs that end early, by each engine: the same texts, diagnoses, blame, and as many times.
#[test]
fn runs_that_fail_do_so_in_the_same_words() {
    let failing = [
        ("toggle", four_bar(USUAL, true, Law::linear(2.2, -1.0)), 300),
        ("does not close", four_bar([1.0, 1.2, 1.1, 4.0], false, Law::ramp(1.0)), 0),
        ("comes apart", four_bar([1.0, 2.0, 1.5, 4.0], false, Law::linear(0.2, 3.0)), 100),
        ("a law that ends", four_bar(USUAL, false, Law::new(Ends)), 500),
        (
            "a law that jumps",
            four_bar(
                USUAL,
                false,
                Law::sequence(0.0, [(0.7, Law::ramp(1.0)), (2.0, Law::linear(0.7, -0.5))]),
            ),
            600,
        ),
        ("no number", wedge(), 500),
    ];
    for (name, system, least) in failing {
        let [plain, others @ ..] =
            all(&system, &linspace(0.0, 1.0, 1001)).map(|run| run.expect_err(name));
        for other in others {
            assert_eq!(std::mem::discriminant(&plain), std::mem::discriminant(&other), "{name}");
            alike(name, &plain.to_string(), &other.to_string());
            let [one, another] =
                [&plain, &other].map(|error| error.diagnosis().map(ToString::to_string));
            assert_eq!(one.is_some(), another.is_some(), "{name}");
            alike(name, &one.unwrap_or_default(), &another.unwrap_or_default());
            let lengths = [&plain, &other].map(|error| error.motion().map(Motion::len));
            assert_eq!(lengths[0], lengths[1], "{name}");
            let compiled = other.motion().map_or(0, |motion| motion.engine().compiled);
            assert!(compiled >= least, "{name}: {compiled} {other}");
        }
    }
}

/// A parallelogram that passes its change points, or turns there, and one that is not to do either.
#[test]
fn change_points_are_told_in_the_same_words() {
    let system = four_bar([1.0, 3.0, 1.0, 3.0], false, Law::linear(0.5, 4.0));
    for follow in [kin::Follow::Smooth, kin::Follow::OtherBranchAt(vec![0])] {
        let times = linspace(0.0, 2.0, 2001);
        let [plain, others @ ..] =
            [Engine::StepByStep, Engine::Compiled, Engine::Auto].map(|engine| {
                system
                    .solver()
                    .options(by(engine).follow(follow.clone()))
                    .run(&times)
                    .expect("runs")
            });
        assert_eq!(plain.singular_positions().len(), 2);
        for other in others {
            assert!(other.engine().compiled > 1000, "{:?}", other.engine());
            let words = |motion: &Motion| {
                motion
                    .singular_positions()
                    .iter()
                    .map(|found| format!("{found:?}"))
                    .collect::<Vec<String>>()
            };
            for (one, other) in words(&plain).iter().zip(words(&other)) {
                alike("change point", one, &other);
            }
            assert_eq!(plain.singular_positions().len(), other.singular_positions().len());
        }
    }
}

/// A run that is stopped from outside stops by each engine.
#[test]
fn runs_that_are_stopped_say_so() {
    let system = four_bar(USUAL, false, Law::ramp(1.0));
    for engine in [Engine::StepByStep, Engine::Compiled, Engine::Auto] {
        let stop = AtomicBool::new(false);
        let watch = |done, _| stop.store(done >= 700, Ordering::Relaxed);
        let mut solver = system.solver().options(by(engine)).progress(watch).stop_when(&stop);
        let stopped = solver.run(linspace(0.0, 1.0, 2001));
        let error = stopped.expect_err("stopped");
        assert!(matches!(error, Error::Stopped { all: 2001, .. }), "{error}");
    }
}
