//! Runs of more times than memory holds: refused before they begin, and possible in parts.

#[path = "data/engines.rs"]
mod engines;

use std::sync::atomic::{AtomicBool, Ordering};

use kin::error::{FailureKind, RunFailure};
use kin::prelude::*;
use kin::results::Event;
use kin::{Error, SolverOptions};

use crate::engines::Engines;

/// A four-bar driven at a rate.
fn four_bar(limited: bool) -> kin::Result<System> {
    let mut m = Mechanism::new("four-bar");
    let crank = m.link("crank", 1.0)?;
    let coupler = m.link("coupler", 3.5)?;
    let rocker = m.link("rocker", 3.0)?;
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
    m.add("C", revolute(m.ground(), rocker, vec2(4.0, 0.0), rocker.start()))?;
    m.add("motor", drive_angle(crank, Law::trapezoidal(6.0 * PI, TAU, TAU)))?;
    m.prefer(rocker, deg(100.0));
    if limited {
        m.limit("rocker.theta", deg(85.0), deg(120.0))?;
    }
    m.build()
}

/// Ten million times took gigabytes without a word.
#[test]
fn a_run_that_needs_too_much_memory_is_refused_before_it_begins() {
    let system = four_bar(false).unwrap();
    let times: Vec<f64> = (0..10_000_000).map(|k| 1e-6 * f64::from(k)).collect();
    let begun = std::time::Instant::now();
    let error = system.run_both(&times).expect_err("too much");
    assert!(begun.elapsed().as_secs_f64() < 2.0);
    assert!(
        matches!(error, Error::NeedsMemory { motions: 1, times: 10_000_000, coordinates: 9, .. }),
        "{error}"
    );
    let text = error.to_string();
    assert!(
        text.contains(
            "10000000 times of 9 coordinates need 2.40 GB, but `SolverOptions::memory` allows 1.07 GB."
        ),
        "{text}"
    );
    assert!(text.contains("Solver::run_in_parts") && text.contains("allow more"), "{text}");
    let few = SolverOptions::new().memory(8 * 11 * (3 + 4 * 9)).jerk(true);
    assert!(system.run_both_with(linspace(0.0, 0.1, 11), &few).is_ok());
    assert!(matches!(
        system.run_both_with(linspace(0.0, 0.1, 12), &few),
        Err(Error::NeedsMemory { .. })
    ));
    assert!(matches!(
        system.solver().options(few.clone()).run_in_parts(times, 12, |_| Ok(())),
        Err(Error::NeedsMemory { .. })
    ));
}

fn numbers(motion: &Motion) -> Vec<f64> {
    (0..motion.len())
        .flat_map(|k| {
            [&[motion.times()[k]], motion.q(k), motion.qd(k), motion.qdd(k), motion.qddd(k)]
                .concat()
        })
        .collect()
}

/// The events, each as its time and text.
fn happened(events: &[Event]) -> Vec<String> {
    events.iter().map(|event| format!("{:.6} {}", event.t, event.text)).collect()
}

#[test]
fn a_run_in_parts_is_the_run_in_one() {
    let system = four_bar(true).unwrap();
    let options = SolverOptions::new().jerk(true);
    let times = linspace(0.0, 4.2, 200);
    let whole = system.run_both_with(&times, &options).unwrap();
    assert!(whole.events().len() >= 6 && whole.breaks().len() == 3, "{:?}", whole.events());
    for size in [1, 3, 64, 199, 200, 1000, 0] {
        let mut all = Vec::new();
        let mut parts = 0;
        let mut breaks = Vec::new();
        let mut events = Vec::new();
        let keep = |part: &Motion| {
            assert!(!part.is_empty() && part.len() <= size.max(1));
            all.extend(numbers(part));
            breaks.extend_from_slice(part.breaks());
            events.extend_from_slice(part.events());
            parts += 1;
            Ok(())
        };
        system
            .solver()
            .options(options.clone())
            .run_in_parts(times.iter().copied(), size, keep)
            .unwrap();
        assert_eq!(parts, 200_usize.div_ceil(size.max(1)));
        assert_eq!(all, numbers(&whole), "parts of {size}: the same to the last bit");
        assert_eq!(breaks, whole.breaks());
        let mut a = happened(&events);
        let mut b = happened(whole.events());
        a.sort();
        b.sort();
        assert_eq!(a, b, "parts of {size}");
    }
}

#[test]
fn a_run_in_parts_ends_as_the_run_in_one() {
    let mut m = Mechanism::new("crank longer than its rod");
    let crank = m.link("crank", 1.0).unwrap();
    let rod = m.link("rod", 0.8).unwrap();
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).unwrap();
    m.add("slide", point_on_line(rod, Ground, rod.end(), vec2(0.0, 0.0), vec2(1.0, 0.0))).unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(1.0))).unwrap();
    let system = m.build().unwrap();
    let times = linspace(0.0, 2.0, 101);
    let whole = system.run_both(&times).expect_err("a toggle");
    let mut kept = 0;
    let error = system.solver().run_in_parts(times, 10, |part| {
        kept += part.len();
        Ok(())
    });
    let error = error.expect_err("a toggle");
    let t = |error: &Error| match error.failure() {
        Some(RunFailure { t, kind: FailureKind::Toggle { .. }, .. }) => *t,
        _ => f64::NAN,
    };
    assert_eq!(t(&error), t(&whole), "{error}");
    assert_eq!(kept + error.motion().map_or(0, Motion::len), whole.motion().unwrap().len());
    // The closure ends it, too; times are looked at as they come.
    let mut shown = 0;
    let ended = system.solver().run_in_parts((0..).map(f64::from).map(|k| 0.01 * k), 5, |_| {
        shown += 1;
        if shown == 3 { Err(Error::EmptyName { what: "test" }) } else { Ok(()) }
    });
    assert!(matches!(ended, Err(Error::EmptyName { .. })) && shown == 3);
    for times in [
        vec![],
        vec![0.0, 0.1, 0.1],
        vec![0.0, 0.1, 0.05],
        vec![0.0, f64::NAN],
        vec![f64::INFINITY],
    ] {
        let in_one = system.run_both(&times).expect_err("no times");
        let in_parts = system
            .solver()
            .run_in_parts(times.iter().copied(), 2, |_| Ok(()))
            .expect_err("no times");
        assert!(
            matches!(
                (&in_one, &in_parts),
                (Error::InvalidTimes { .. }, Error::InvalidTimes { .. })
            ),
            "{times:?}: {in_parts}"
        );
    }
}

#[test]
fn redundant_mechanisms_run_in_parts_too() {
    let mut m = Mechanism::new("twice");
    let x = m.length("x", 0.0).unwrap();
    let y = m.length("y", 0.0).unwrap();
    m.add("x", drive(x, Law::sine(1.0, 1.0, 0.0))).unwrap();
    m.add("y", drive(y, Law::constant(0.5))).unwrap();
    m.add("y again", drive(y, Law::constant(0.5))).unwrap();
    let system = m.build().unwrap();
    let whole = system.run_both(linspace(0.0, 1.0, 50)).unwrap();
    let mut all = Vec::new();
    let keep = |part: &Motion| {
        all.extend(numbers(part));
        Ok(())
    };
    system.solver().run_in_parts(linspace(0.0, 1.0, 50), 7, keep).unwrap();
    assert_eq!(all, numbers(&whole));
}

/// A watched run has the numbers of the run; one that is told to stop keeps what it has computed.
#[test]
fn a_run_is_watched_and_stopped() {
    let system = four_bar(false).unwrap();
    let times = linspace(0.0, 3.0, 301);
    let mut seen = Vec::new();
    let whole = system.run_both(&times).unwrap();
    let watched = system.solver().progress(|done, all| seen.push((done, all))).run(&times);
    assert_eq!(watched.unwrap().qdd(300), whole.qdd(300));
    assert_eq!(seen, (0..301).map(|done| (done, 301)).collect::<Vec<_>>());
    let stop = AtomicBool::new(false);
    let watch = |done, _| stop.store(done >= 100, Ordering::Relaxed);
    let stopped = system.solver().progress(watch).stop_when(&stop).run(&times).unwrap_err();
    assert!(matches!(stopped, Error::Stopped { done: 100, all: 301, .. }), "{stopped}");
    let text = stopped.to_string();
    assert!(
        text.starts_with(
            "your program stopped the run after 100 of 301 times\n  The motion up to t = 0.99 s"
        ),
        "{text}"
    );
    assert_eq!(stopped.motion().map(kin::Motion::len), Some(100));
    let mut parts = Vec::new();
    let stop = AtomicBool::new(false);
    let watch = |done, all| {
        parts.push((done, all));
        stop.store(done >= 100, Ordering::Relaxed);
    };
    let mut solver = system.solver().progress(watch).stop_when(&stop);
    let stopped = solver.run_in_parts(times.iter().copied(), 50, |_| Ok(())).unwrap_err();
    assert!(matches!(stopped, Error::Stopped { done: 100, all: 301, .. }), "{stopped}");
    drop(solver);
    assert_eq!(parts, [(0, 301), (50, 301), (100, 301)]);
    let never = system.solver().stop_when(&AtomicBool::new(true)).run(&times).unwrap_err();
    assert_eq!(never.to_string(), "your program stopped the run after 0 of 301 times");
}
