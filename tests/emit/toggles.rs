//! Random four-bars along steps of any length: the file never accepts another position than the
//! library.

use kin::Error;
use kin::emit::{self, Options};
use kin::prelude::*;

use crate::examples::Random;
use crate::programs::{compiled, there_is_a_compiler};

/// A four-bar with these lengths, driven at the crank.
fn four_bar([a, b, c, d]: [f64; 4], start: f64) -> kin::Result<System> {
    let mut m = Mechanism::new("random");
    let crank = m.link("crank", a)?;
    let coupler = m.link("coupler", b)?;
    let rocker = m.link("rocker", c)?;
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
    m.add("C", revolute(Ground, rocker, vec2(d, 0.0), rocker.start()))?;
    m.add("motor", drive_angle(crank, Law::linear(start, 1.0)))?;
    m.prefer(rocker, deg(100.0));
    m.build()
}

/// The outcomes of all steps.
#[derive(Debug, Default)]
struct Counts {
    accepted: usize,
    refused: usize,
    /// Steps that the file refuses although the library reaches the values.
    cautious: usize,
}

#[test]
fn no_step_ends_on_another_branch_than_that_of_the_library() -> kin::Result<()> {
    if !there_is_a_compiler() {
        return Ok(());
    }
    let many = std::env::var("KIN_EMIT_BARS").ok().and_then(|n| n.parse().ok()).unwrap_or(6);
    let mut random = Random(2);
    let mut counts = Counts::default();
    let mut done = 0;
    while done < many {
        let lengths = [0; 4].map(|_| 2.25 + 1.75 * random.next());
        let start = 3.0 * random.next();
        let Ok(system) = four_bar(lengths, start) else { continue };
        let Ok(mut follower) = system.follower(0.0) else { continue };
        done += 1;
        let text = emit::c(&system, &Options::default())?;
        let program = compiled("bar", &text, &[]).expect("compiles");
        let targets: Vec<Vec<f64>> = (0..40)
            .scan(start, |u, _| {
                *u += 0.8 * random.next().powi(3);
                Some(vec![*u, 0.3, 0.1])
            })
            .collect();
        // Each step by itself, and back to the last good position after a refused one.
        let found = program.run(&["steps"], &targets);
        assert_eq!(found.len(), targets.len());
        for (target, found) in targets.iter().zip(&found) {
            let before = follower.clone();
            let moved = follower.to([("motor", target[0])]).map(|here| here.q().to_vec());
            let is_accepted = found[0] == 0.0;
            match moved {
                Ok(q) if is_accepted => {
                    let off = q.iter().zip(&found[1..]).map(|(a, b)| (a - b).abs());
                    let off = off.fold(0.0, f64::max);
                    assert!(off < 1e-9, "{lengths:?} from {start}, to {target:?}: {off}");
                    counts.accepted += 1;
                }
                Err(Error::CannotReach(stop)) if is_accepted => {
                    panic!("{lengths:?} from {start}, to {target:?}: {stop}")
                }
                Err(error) if is_accepted => panic!("{error}"),
                moved => {
                    counts.cautious += usize::from(moved.is_ok());
                    counts.refused += 1;
                    follower = before;
                }
            }
        }
    }
    println!("{counts:?}");
    assert!(counts.accepted > 10 * many && counts.refused > many, "{counts:?}");
    Ok(())
}
