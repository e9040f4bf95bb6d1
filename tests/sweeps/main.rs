//! Sweeps over many cases: a status each, the same results on any number of threads, mistakes by
//! name, progress; several cases in lanes. User code needs no `unsafe`.
#![forbid(unsafe_code)]

mod campaign;
#[path = "../data/engines.rs"]
mod engines;
mod free;
mod own;
#[path = "../data/steps.rs"]
mod steps;

use std::sync::atomic::{AtomicBool, Ordering};

use kin::extend::Lanes;
use kin::prelude::*;
use kin::{Error, SolverOptions};

use crate::engines::Engines;

/// A four-bar with links of lengths a, b, c and ground pins d apart, the crank at θ = t.
fn four_bar([a, b, c, d]: [f64; 4]) -> System {
    let mut m = Mechanism::new("four-bar");
    let crank = m.link("crank", a).unwrap();
    let coupler = m.link("coupler", b).unwrap();
    let rocker = m.link("rocker", c).unwrap();
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(m.ground(), rocker, vec2(d, 0.0), rocker.start())).unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(1.0))).unwrap();
    m.prefer(rocker, deg(100.0));
    m.build().unwrap()
}

const NAMES: [&str; 8] =
    ["O.u_j.x", "A.u_i.x", "A.u_j.x", "B.u_i.x", "B.u_j.x", "C.u_j.x", "C.u_i.x", "rocker.theta"];

/// The numbers of one four-bar under those names.
fn case([a, b, c, d]: [f64; 4]) -> [f64; 8] {
    let a = 0.5 * a;
    let b = 0.5 * b;
    let c = 0.5 * c;
    [-a, a, -b, b, c, -c, d, deg(100.0)]
}

/// Four-bars whose crank turns all the way round.
fn links(count: usize) -> Vec<[f64; 4]> {
    let part = |k: usize, step: f64| (k as f64 * step).fract();
    (0..count)
        .map(|k| {
            [
                0.5 + 0.4 * part(k, 0.618),
                3.0 + part(k, 0.414),
                2.7 + part(k, 0.732),
                3.5 + part(k, 0.236),
            ]
        })
        .collect()
}

fn times() -> Vec<f64> {
    linspace(0.0, TAU, 61)
}

/// All numbers of a motion.
fn numbers(motion: &Motion) -> Vec<f64> {
    (0..motion.len()).flat_map(|k| [motion.q(k), motion.qd(k), motion.qdd(k)].concat()).collect()
}

#[test]
fn each_case_is_what_its_own_mechanism_does() {
    let links = links(11);
    let cases: Vec<[f64; 8]> = links.iter().copied().map(case).collect();
    let swept = four_bar([1.0, 3.5, 3.0, 4.0])
        .sweep(NAMES)
        .unwrap()
        .run(&cases, times(), |_, motion| motion.unwrap())
        .unwrap();
    for (swept, links) in swept.iter().zip(links) {
        let own = four_bar(links).run_both(times()).unwrap();
        assert_eq!(swept.len(), own.len());
        let far = numbers(swept)
            .iter()
            .zip(numbers(&own))
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        assert!(far < 1e-9, "{links:?}: {far}");
    }
}

#[test]
fn a_case_that_fails_has_its_error_and_what_was_computed_before() {
    let system = four_bar([1.0, 3.5, 3.0, 4.0]);
    // The third one's crank is too long to turn round: it locks when crank and coupler are in line.
    let mut links = links(12);
    let locked = 2;
    links[locked] = [2.0, 2.5, 2.2, 4.0];
    let cases: Vec<[f64; 8]> = links.iter().copied().map(case).collect();
    let status = system
        .sweep(NAMES)
        .unwrap()
        .run(&cases, times(), |k, motion| (k, motion.map(|motion| motion.len())))
        .unwrap();
    assert!(status.iter().map(|(k, _)| *k).eq(0..12));
    for (k, found) in &status {
        match found {
            Ok(count) => assert!(*k != locked && *count == 61),
            Err(error) => {
                assert_eq!(*k, locked, "{error}");
                let before = error.motion().unwrap();
                assert!(before.len() > 3 && before.len() < 61, "{}", before.len());
                let own = four_bar(links[locked]).run_both(times()).unwrap_err();
                assert_eq!(own.motion().unwrap().len(), before.len());
            }
        }
    }
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let system = four_bar([1.0, 3.5, 3.0, 4.0]);
    let cases: Vec<[f64; 8]> = links(37).into_iter().map(case).collect();
    let run = |threads| {
        let sweep = system.sweep(NAMES).unwrap().threads(threads);
        sweep.run(&cases, times(), |_, motion| numbers(&motion.unwrap())).unwrap()
    };
    let one = run(1);
    let two = run(2);
    for (k, (one, two)) in one.iter().zip(&two).enumerate() {
        let far = one.iter().zip(two).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(one == two, "case {k}: off by {far:e}");
    }
}

#[test]
fn mistakes_are_told_by_name_before_anything_is_computed() {
    let system = four_bar([1.0, 3.5, 3.0, 4.0]);
    let error = system.sweep(["A.u_i.x", "A.length"]).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("`A.length`") && error.contains("`A.u_j.x`"), "{error}");
    let none = |_: usize, _: kin::Result<Motion>| panic!("nothing is run");
    let run = |cases: &[Vec<f64>], times: &[f64]| {
        system.sweep(["A.u_i.x", "rocker.theta"]).unwrap().run(cases, times, none).unwrap_err()
    };
    let good = vec![0.5, 1.0];
    let error = run(&[good.clone(), vec![0.5, f64::NAN]], &[0.0]).to_string();
    assert!(error.contains("case 1") && error.contains("`rocker.theta` is NaN"), "{error}");
    let error = run(&[good.clone(), vec![0.5]], &[0.0]).to_string();
    assert!(error.contains("case 1") && error.contains("Kin needs 2"), "{error}");
    assert!(matches!(run(std::slice::from_ref(&good), &[0.0, 0.0]), Error::InvalidTimes { .. }));
    let sweep = system
        .sweep(NAMES)
        .unwrap()
        .options(SolverOptions::new().stop(kin::solver::Stop::ResidualOnly(-1.0)));
    assert!(matches!(
        sweep.run(&[case([1.0, 3.5, 3.0, 4.0])], [0.0], none),
        Err(Error::InvalidOptions { .. })
    ));
}

#[test]
fn progress_counts_up_to_all() {
    let system = four_bar([1.0, 3.5, 3.0, 4.0]);
    let cases: Vec<[f64; 8]> = links(50).into_iter().map(case).collect();
    let mut told = Vec::new();
    let sweep = system.sweep(NAMES).unwrap().progress(|done, all| told.push((done, all)));
    sweep.run(&cases, [0.0, 0.1], |_, _| ()).unwrap();
    drop(sweep);
    assert_eq!((told[0], told[told.len() - 1]), ((0, 50), (50, 50)));
    assert!(told.len() > 3 && told.windows(2).all(|pair| pair[0].0 < pair[1].0));
}

#[test]
fn a_sweep_can_be_stopped() {
    let system = four_bar([1.0, 3.5, 3.0, 4.0]);
    let cases: Vec<[f64; 8]> = links(400).into_iter().map(case).collect();
    let stop = AtomicBool::new(false);
    let sweep = system
        .sweep(NAMES)
        .unwrap()
        .threads(1)
        .stop_when(&stop)
        .progress(|done, _| stop.store(done >= 16, Ordering::Relaxed));
    let stopped = sweep.run(&cases, [0.0, 0.1], |_, _| ());
    assert!(
        matches!(stopped, Err(Error::Stopped { done: 16, all: 400, motion: None })),
        "{stopped:?}"
    );
    // The flag of a solver is that of its sweeps.
    let sweep = system.solver().stop_when(&stop).sweep(NAMES).unwrap();
    let stopped = sweep.run(&cases, [0.0, 0.1], |_, _| ());
    assert!(matches!(stopped, Err(Error::Stopped { all: 400, .. })), "{stopped:?}");
}

#[test]
fn no_case_at_all_is_a_sweep_too() {
    let none: [[f64; 8]; 0] = [];
    assert!(
        four_bar([1.0, 3.5, 3.0, 4.0])
            .sweep(NAMES)
            .unwrap()
            .run(&none, times(), |_, _| ())
            .unwrap()
            .is_empty()
    );
}

/// How many kinds of machine with lanes this one is: none, if it is old.
fn kinds_of_machine() -> usize {
    let most = match std::env::var("KIN_LANES").as_deref() {
        Ok("off") => 0,
        Ok("4") => 2,
        Ok("8") => 4,
        _ => 8,
    };
    #[cfg(target_arch = "x86_64")]
    let kinds = {
        let has_avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        let has_avx512 = is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("avx512dq");
        [(2, has_avx2), (4, has_avx2), (8, has_avx512)]
    };
    #[cfg(not(target_arch = "x86_64"))]
    let kinds = [(2, cfg!(target_arch = "aarch64"))];
    kinds.into_iter().filter(|(lanes, has)| *has && *lanes <= most).count()
}

fn with_lanes(
    system: &System,
    cases: &[[f64; 8]],
    options: &SolverOptions,
    lanes: Lanes,
) -> Option<Vec<Result<Vec<f64>, String>>> {
    let sweep = system.sweep(NAMES).unwrap().options(options.clone()).lanes(lanes);
    let found = sweep.run(cases, times(), |_, motion| {
        motion.map(|motion| numbers(&motion)).map_err(|error| error.to_string())
    });
    match found {
        Err(Error::InvalidOptions { .. }) => None,
        found => Some(found.unwrap()),
    }
}

/// Largest difference relative to 1 + |x|.
fn far(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / (1.0 + b.abs())).fold(0.0, f64::max)
}

#[test]
fn lanes_change_results_by_rounding_only_and_failing_lanes_not_at_all() {
    let system = four_bar([1.0, 3.5, 3.0, 4.0]);
    let mut links = links(13);
    // Two that lock, one of them in the last, incomplete group.
    (links[3], links[11]) = ([2.0, 2.5, 2.2, 4.0], [2.2, 2.5, 2.2, 4.0]);
    let cases: Vec<[f64; 8]> = links.into_iter().map(case).collect();
    let protocol = SolverOptions::new().stop(kin::solver::Stop::ResidualOnly(1e-10)).predict(false);
    for (options, tolerance) in [(SolverOptions::default(), 1e-10), (protocol, 1e-8)] {
        let alone = with_lanes(&system, &cases, &options, Lanes::Off).unwrap();
        assert!(alone.iter().enumerate().all(|(k, found)| found.is_err() == [3, 11].contains(&k)));
        let mut tried = 0;
        let kinds = kinds_of_machine();
        for lanes in [Lanes::Best, Lanes::Only(2), Lanes::Only(4), Lanes::Only(8)] {
            let Some(found) = with_lanes(&system, &cases, &options, lanes) else { continue };
            tried += 1;
            for (k, (found, alone)) in found.iter().zip(&alone).enumerate() {
                match (found, alone) {
                    (Ok(found), Ok(alone)) => {
                        assert!(
                            far(found, alone) < tolerance,
                            "{lanes:?}, case {k}: {:e}",
                            far(found, alone)
                        )
                    }
                    (found, alone) => assert_eq!(found, alone, "{lanes:?}, case {k}"),
                }
            }
        }
        assert_eq!(tried, 1 + kinds);
    }
}

/// Which cases there are besides, and in which order, changes the last digits alone.
#[test]
fn company_does_not_matter() {
    let system = four_bar([1.0, 3.5, 3.0, 4.0]);
    let cases: Vec<[f64; 8]> = links(24).into_iter().map(case).collect();
    let shuffled: Vec<usize> = (0..24).map(|k| (7 * k + 5) % 24).collect();
    let other: Vec<[f64; 8]> = shuffled.iter().map(|k| cases[*k]).collect();
    let [one, two] = [&cases, &other]
        .map(|cases| with_lanes(&system, cases, &SolverOptions::default(), Lanes::Best).unwrap());
    for (place, k) in shuffled.into_iter().enumerate() {
        let a = one[k].as_ref().unwrap();
        let b = two[place].as_ref().unwrap();
        assert!(far(a, b) < 1e-10, "case {k}: {:e}", far(a, b));
    }
}

#[test]
fn newton_steps_and_residuals_are_those_of_each_case_alone() {
    let system = four_bar([1.0, 3.5, 3.0, 4.0]);
    let cases: Vec<[f64; 8]> = links(8).into_iter().map(case).collect();
    let run = |lanes| {
        let sweep = system.sweep(NAMES).unwrap().lanes(lanes);
        sweep
            .run(&cases, times(), |_, motion| {
                motion
                    .map(|m| (m.iterations().to_vec(), m.residuals().to_vec(), m.times().to_vec()))
                    .unwrap()
            })
            .unwrap()
    };
    for ((steps, residuals, times), (own_steps, _, own_times)) in
        run(Lanes::Best).into_iter().zip(run(Lanes::Off))
    {
        let (steps, own_steps): (usize, usize) = (steps.iter().sum(), own_steps.iter().sum());
        assert!(steps.abs_diff(own_steps) <= 3, "{steps} and {own_steps}");
        assert!(residuals.iter().all(|residual| *residual < 1e-11));
        assert_eq!(times, own_times);
    }
}

#[test]
fn lanes_that_are_not_there_are_told() {
    let system = four_bar([1.0, 3.5, 3.0, 4.0]);
    let sweep = system.sweep(NAMES).unwrap().lanes(Lanes::Only(3));
    let error = sweep.run(&[case([1.0, 3.5, 3.0, 4.0])], [0.0], |_, _| ()).unwrap_err().to_string();
    assert!(error.contains("Only(3)") && error.contains("Lanes::Best"), "{error}");
}

#[constraint]
#[require(l > 0.0, "the length of the rod must be above zero")]
fn rod(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, l: f64) -> f64 {
    let d = i.point(u_i) - j.point(u_j);
    d.dot(d) - l * l
}

/// A crank of a length that is a dimension, and a block on a guide behind a rod.
fn guided(law: Law) -> kin::Result<System> {
    let mut m = Mechanism::new("guided");
    let a = m.dimension("a", 0.1)?.within(0.05, 0.2);
    let crank = m.link("crank", a)?;
    let block = m.planar("block", pose(0.4, 0.0, 0.0))?;
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("guide", prismatic(block, Ground, vec2(0.0, 0.0), vec2(0.0, 0.0), vec2(1.0, 0.0), 0.0))?;
    m.add("rod", rod(crank, block, crank.end(), vec2(0.0, 0.0), 0.3))?;
    m.add("motor", drive_angle(crank, law))?;
    m.build()
}

/// Numbers that `set` refuses are refused in the cases of a sweep too, by the same words, and the
/// others are none the worse for it.
#[test]
fn cases_that_cannot_be_set_are_refused_as_set_refuses_them() -> kin::Result<()> {
    let system = guided(Law::s_curve(0.3, 0.4, 0.8, 3.0))?;
    for (name, good, bad) in [
        ("rod.l", 0.3, -0.3),
        ("a", 0.1, 0.9),
        ("a", 0.1, -0.1),
        ("motor.law.acceleration", 0.8, -0.8),
        ("guide.h_i.x", 1.0, 0.0),
    ] {
        let told = system.clone().set(name, bad).expect_err("refused").to_string();
        for lanes in [Lanes::Off, Lanes::Best] {
            let cases = [[good], [bad], [good]];
            let found =
                system.sweep([name])?.lanes(lanes).run(&cases, [0.0, 0.5], |_, motion| {
                    motion.map(|motion| motion.q(1).to_vec())
                })?;
            let [Ok(first), Err(error), Ok(last)] = &found[..] else {
                panic!("{name} {lanes:?}: {found:?}");
            };
            assert!(first == last && error.to_string() == told, "{name} {lanes:?}: {error} {told}");
        }
    }
    Ok(())
}

/// No more threads than there can be work for.
#[test]
fn a_million_threads_are_no_more_than_there_are_cases() -> kin::Result<()> {
    let system = guided(Law::ramp(1.0))?;
    let sweep = system.sweep(["rod.l"])?.threads(1_000_000);
    assert!(sweep.run(&[[0.3]], [0.0, 0.5], |_, motion| motion.is_ok())?[0]);
    Ok(())
}

/// Names of what is to be kept are looked at before anything is computed.
#[test]
fn names_that_nothing_has_are_told_before_a_sweep() -> kin::Result<()> {
    let system = guided(Law::ramp(1.0))?;
    system.check_columns(&["block.R_x", "guide.slide"], 0.0)?;
    let told = system.check_columns(&["block.R_x", "motor"], 0.0).unwrap_err().to_string();
    assert!(told.contains("`motor`") && told.contains("`guide.slide`"), "{told}");
    Ok(())
}
