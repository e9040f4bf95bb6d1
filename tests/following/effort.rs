//! A run that cannot be followed says so soon, by counted work, and the work it may spend is an
//! option.

use std::time::{Duration, Instant};

use kin::error::{FailureKind, RunFailure};
use kin::prelude::*;
use kin::{Engine, Error, Follow, SolverOptions};

use crate::families::{FAMILIES, Frame, Random, system};
use crate::models::slider_crank;
use crate::steps;

#[constraint]
fn wavy(x: Coord, z: Coord) -> f64 {
    z + 0.3 * (2.0 * z).sin() - x
}

/// z of a wavy line is led so far in one second, in one step.
fn wave(far: f64, effort: f64) -> kin::Result<Motion> {
    let mut m = Mechanism::new("wavy");
    let x = m.length("x", 0.0)?;
    let z = m.length("z", 0.0)?;
    m.add("x", drive(x, Law::ramp(far)))?;
    m.add("z", wavy(x, z))?;
    m.build()?.solver().options(SolverOptions::new().effort(effort)).run([0.0, 1.0])
}

#[test]
fn effort_is_the_work_that_a_run_may_spend_on_smaller_steps() {
    // Some thousand smaller steps are a small share of the usual.
    assert!(wave(1e3, 1.0).is_ok());
    let mut last = -1.0;
    for effort in [1e-4, 1e-3, 1e-2] {
        let [error, again] = [(); 2].map(|()| wave(1e5, effort).expect_err("ends early"));
        let Some(RunFailure { t, kind: FailureKind::CannotFollow { reason }, .. }) =
            error.failure()
        else {
            panic!("{effort}: {error}")
        };
        assert!(
            reason.to_string().contains("`SolverOptions::effort`") && *t > last && *t < 1.0,
            "{effort}: {error}"
        );
        // It is counted, not timed.
        assert_eq!(error.to_string(), again.to_string());
        last = *t;
    }
    for effort in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = wave(1.0, effort).expect_err("no effort");
        assert!(
            matches!(&error, Error::InvalidOptions { reason } if reason.contains("effort")),
            "{error}"
        );
    }
}

/// The reasons of a failure are looked for with as much work. Of a search that is cut off nothing
/// is reported.
#[test]
fn effort_bounds_the_diagnosis_after_a_failure() {
    let system = slider_crank(1.0, 0.8, Law::ramp(1.0), 0.0).unwrap();
    let end = |effort: f64| {
        // Hardly any of it is spent on smaller steps.
        let options = SolverOptions::new().effort(effort).follow(Follow::Unchecked).halvings(3);
        system
            .solver()
            .options(options.clone())
            .run(linspace(0.0, 2.0, 2001))
            .expect_err("no position beyond a toggle")
    };
    let [full, cut] = [1.0, 1e-5].map(end);
    for error in [&full, &cut] {
        let Some(failure) = error.failure() else { panic!("{error}") };
        assert!(matches!(
            failure.kind,
            FailureKind::NoConvergence { .. } | FailureKind::SingularAt { .. }
        ));
        assert!((failure.t - 0.8_f64.asin()).abs() < 1e-2, "{error}");
    }
    assert!(full.diagnosis().is_some() && cut.diagnosis().is_none(), "{full} {cut}");
}

/// How many mechanisms of either kind a test run takes; `KIN_CAMPAIGN=2000` for a measurement, in a
/// release build.
fn count() -> usize {
    std::env::var("KIN_CAMPAIGN").ok().and_then(|count| count.parse().ok()).unwrap_or(12)
}

/// The longest that runs took.
#[derive(Default)]
struct Longest {
    failed: Duration,
    words: String,
    /// Of runs that succeeded, for each time.
    each: Duration,
    /// The most failures have taken, in runs of as many times that take the longest of those that
    /// succeeded.
    ratio: f64,
    failures: usize,
}

impl Longest {
    fn run(&mut self, system: &System, times: &[f64], engine: Engine, words: &str) {
        let begun = Instant::now();
        let result = system.solver().options(SolverOptions::new().engine(engine)).run(times);
        let took = begun.elapsed();
        if result.is_ok() {
            self.each = self.each.max(took / times.len() as u32);
            return;
        }
        self.failures += 1;
        if !self.each.is_zero() {
            let usual = self.each.as_secs_f64() * times.len() as f64;
            self.ratio = self.ratio.max(took.as_secs_f64() / usual);
        }
        if took > self.failed {
            (self.failed, self.words) = (took, words.to_string());
        }
    }
}

/// Every failure of random mechanisms comes soon.
#[test]
fn runs_that_cannot_be_followed_end_soon() {
    let mut longest = Longest::default();
    for number in 0..count() {
        let family = number % FAMILIES.len();
        let Ok(mechanism) = system(family, &mut Random::of(number), Frame::default()) else {
            continue;
        };
        for (points, engine) in
            [(2, Engine::StepByStep), (4, Engine::StepByStep), (37, Engine::Compiled)]
        {
            let words = format!("number {number}, {}, {points} times", FAMILIES[family]);
            longest.run(&mechanism, &linspace(0.0, 1.0, points), engine, &words);
        }
        let case = steps::random(number as u64);
        for engine in [Engine::StepByStep, Engine::Compiled] {
            longest.run(&case.system, &case.times, engine, &case.words);
        }
    }
    let Longest { failed, words, each, ratio, failures } = longest;
    println!(
        "{failures} failures, the longest {failed:?} ({words}); a time of others {each:?}; ratio {ratio:.1}"
    );
    assert!(failures > count() / 20);
    // Unoptimised, and on a machine with other work, it takes longer.
    let allowed = if cfg!(debug_assertions) { 60 } else { 5 };
    assert!(failed < Duration::from_secs(allowed), "{failed:?}: {words}");
}
