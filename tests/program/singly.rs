//! Single positions by the program of `compile`: those of plain steps, from wherever they are
//! looked for.

use kin::prelude::*;
use kin::results::Solution;
use kin::solver::Stop;
use kin::{Engine, SolverOptions};

use crate::gallery::mechanisms;
use crate::{USUAL, four_bar};

fn plain() -> SolverOptions {
    SolverOptions::new().engine(Engine::StepByStep)
}

/// The largest differences of q, q̇ and q̈, by 1 and the size of the number.
fn apart(a: &Solution, b: &Solution) -> [f64; 3] {
    [(&a.q, &b.q), (&a.qd, &b.qd), (&a.qdd, &b.qdd)].map(|(a, b)| {
        a.iter().zip(b).map(|(a, b)| (a - b).abs() / (1.0 + a.abs())).fold(0.0, f64::max)
    })
}

/// How far a position is from where it was looked for.
fn moved(at: &Solution, start: &[f64]) -> f64 {
    at.q.iter().zip(start).map(|(q, start)| (q - start).abs()).fold(0.0, f64::max)
}

/// Along each motion of the gallery, from the position before, and from positions that are off by
/// some. From far off the steps of all coordinates may lead further away than those of a program.
#[test]
fn positions_of_the_gallery_are_those_of_plain_steps() {
    let mut asked = 0;
    let mut by_program = [0; 4];
    for (name, system) in mechanisms().into_iter().filter(|(_, system)| system.compile().is_ok()) {
        let motion = system.run(linspace(0.0, 1.0, 101)).expect("runs");
        let mut random = fastrand::Rng::with_seed(7);
        asked += motion.len() - 1;
        for (off, by_program) in [0.0, 0.01, 0.1, 1.0].into_iter().zip(&mut by_program) {
            for k in 1..motion.len() {
                let t = motion.times()[k];
                let beside = |q: &f64| q + off * (2.0 * random.f64() - 1.0);
                let start: Vec<f64> = motion.q(k - 1).iter().map(beside).collect();
                match (
                    system.solve_at(t, &start),
                    system.solver().options(plain()).solve_at(t, &start),
                ) {
                    (Ok(found), Ok(plain)) => {
                        let own = apart(&plain, &found);
                        let case = format!("{name} at {t}, {off} off");
                        let is_same =
                            own.iter().zip([1e-10, 1e-9, 1e-8]).all(|(own, bound)| *own < bound);
                        let is_nearer = off > 0.05 && moved(&found, &start) < moved(&plain, &start);
                        assert!(is_same || is_nearer, "{case}: {own:?}");
                        assert!(!plain.report.compiled && found.report.residual < 1e-9, "{case}");
                        *by_program += usize::from(found.report.compiled);
                    }
                    (Err(found), Err(plain)) => assert_eq!(found.to_string(), plain.to_string()),
                    (found, plain) => panic!("{name} at {t}, {off} off: {found:?}, {plain:?}"),
                }
            }
        }
    }
    // Percent; of positions that rows give wherever they are looked for from there are three in 27.
    let enough =
        by_program.iter().zip([95, 70, 20, 10]).all(|(own, least)| 100 * own >= least * asked);
    assert!(enough, "{by_program:?} of {asked} by the program");
}

/// A looser stop rule asks for less, and what it gives is the same whatever was asked before.
#[test]
fn a_loose_tolerance_gives_rates_of_its_own_position_each_time() {
    let system = four_bar(USUAL, |m, crank, _| {
        m.add("motor", drive_angle(crank, Law::linear(0.1, 1.0))).expect("adds");
    });
    system.compile().expect("compiles");
    let q = system.position(0.0).expect("solves").q;
    let loose = SolverOptions::new().stop(Stop::Converged { tolerance: 1e-4 });
    let exact = system.solver().options(plain()).solve_at(0.02, &q).expect("solves");
    let first = system.solver().options(loose.clone()).solve_at(0.02, &q).expect("solves");
    assert!(first.report.compiled && apart(&exact, &first).iter().all(|off| *off < 1e-11));
    for _ in 0..70 {
        assert_eq!(
            system.solver().options(loose.clone()).solve_at(0.02, &q).expect("solves"),
            first
        );
    }
}
