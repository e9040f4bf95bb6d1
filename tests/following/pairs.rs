//! The same motion on a coarse and on a fine grid: ten families of mechanisms under six kinds of
//! laws.

use kin::Error;
use kin::error::FailureKind;
use kin::prelude::*;

use crate::engines::Engines;
use crate::families::{FAMILIES, Frame, Random, system};

/// How many pairs a test run takes; `KIN_CAMPAIGN=1000` is the whole campaign, for a release build.
fn count() -> usize {
    std::env::var("KIN_CAMPAIGN").ok().and_then(|count| count.parse().ok()).unwrap_or(60)
}

/// Steps of the fine grid, a multiple of those of the coarse ones.
fn fine() -> usize {
    if count() < 1000 { 360 } else { 1980 }
}

/// Of each so many motions on the fine grid one is proved.
const PROVED: usize = 10;

/// The findings about a pair.
#[derive(Default, Debug)]
struct Tally {
    moved: usize,
    toggles: usize,
    proved: usize,
    refused: Vec<String>,
}

/// Both grids must give the same motion, or end in the same toggle; the fine one by a program.
fn compare(system: &System, steps: usize, name: &str, tally: &mut Tally) {
    let each = fine() / steps;
    let fine_times = linspace(0.0, 1.0, steps * each + 1);
    let coarse_times: Vec<f64> = fine_times.iter().step_by(each).copied().collect();
    let coarse = system.run_both(&coarse_times);
    let fine = system.run_compiled(&fine_times);
    let error = |coarse: &Motion, fine: &Motion| {
        let off = |k: usize| {
            coarse
                .q(k)
                .iter()
                .zip(fine.q(k * each))
                .fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()))
        };
        (0..coarse.len()).map(off).fold(0.0, f64::max)
    };
    match (&coarse, &fine) {
        (Ok(coarse), Ok(fine)) => {
            assert!(error(coarse, fine) < 1e-6, "{name}: apart by {:e}", error(coarse, fine));
            tally.moved += 1;
            if tally.moved.is_multiple_of(PROVED) {
                tally.proved +=
                    usize::from(system.prove(fine).is_ok_and(|proof| proof.is_complete()));
            }
        }
        (Err(Error::Run(failure)), Err(Error::Run(expected)))
            if [failure, expected]
                .iter()
                .all(|failure| matches!(failure.kind, FailureKind::Toggle { .. })) =>
        {
            let t = failure.t;
            let expected = expected.t;
            assert!((t - expected).abs() < 1e-6, "{name}: {t} {expected}");
            tally.toggles += 1;
        }
        (Err(error), Ok(_)) => {
            let finer: Vec<f64> = linspace(0.0, 1.0, 2 * steps + 1).to_vec();
            assert!(
                error.to_string().contains("t = ") && system.run_both(&finer).is_ok(),
                "{name}: {error}"
            );
            tally.refused.push(format!("{name}: {error}"));
        }
        (Ok(_), Err(error)) => panic!("{name}: passed in silence: {error}"),
        (Err(coarse), Err(fine)) => panic!("{name}: ends that differ: {coarse} {fine}"),
    }
}

#[test]
fn pairs_of_coarse_and_fine_grids_give_the_same_motion_or_the_same_end() {
    let mut tally = Tally::default();
    let mut tried = 0;
    let mut number = 0;
    let mut of_family = [0; FAMILIES.len()];
    while tried < count() {
        let family = number % FAMILIES.len();
        let mut random = Random::of(number);
        number += 1;
        let Ok(mut system) = system(family, &mut random, Frame::default()) else { continue };
        // Parts that do not go together are no motion.
        let Ok(first) = system.position(0.0) else { continue };
        if system.set_initial(&first.q).is_err() {
            continue;
        }
        tried += 1;
        of_family[family] += 1;
        let steps = random.one_of(&[1, 3, 5, 9, 10, 36]);
        compare(
            &system,
            steps,
            &format!("number {}, {} in {steps} steps", number - 1, FAMILIES[family]),
            &mut tally,
        );
    }
    println!(
        "{tried} pairs: {} motions, {} toggles, refused: {:#?}",
        tally.moved, tally.toggles, tally.refused
    );
    assert!(tally.refused.len() <= 2 * tried / 1000, "{:#?}", tally.refused);
    assert!(
        tally.moved > tried / 5
            && tally.toggles > tried / 10
            && of_family.iter().all(|pairs| *pairs >= tried / 40)
    );
    // Of a few the share says nothing.
    let asked = tally.moved / PROVED;
    assert!(asked < 8 || 2 * tally.proved >= asked, "{} of {asked} proved", tally.proved);
}
