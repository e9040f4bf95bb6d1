//! All that is told of a motion, and of a run that ends early, is the same whichever engine ran.

use kin::error::{FailureKind, RunFailure};
use kin::prelude::*;
use kin::{Engine, SolverOptions};

use crate::{USUAL, compiled};

fn both(system: &System, times: &[f64]) -> [kin::Result<Motion>; 2] {
    let plain = SolverOptions::new().engine(Engine::StepByStep);
    [plain, compiled()].map(|options| system.solver().options(options.clone()).run(times))
}

fn motions(system: &System, times: &[f64]) -> [Motion; 2] {
    let found = both(system, times).map(|motion| motion.expect("runs"));
    assert!(found[0].engine().compiled == 0 && 2 * found[1].engine().compiled > times.len());
    found
}

/// The four-bar with its crank, or else its rocker, driven; its rocker.
fn four_bar(law: Law, by_rocker: bool) -> (System, Link) {
    let mut held = None;
    let system = crate::four_bar(USUAL, |m, crank, rocker| {
        m.add("motor", drive_angle(if by_rocker { rocker } else { crank }, law)).expect("adds");
        held = Some(rocker);
    });
    (system, held.expect("a rocker"))
}

#[test]
fn proofs_are_the_same() {
    let (system, _) = four_bar(Law::linear(0.3, 2.0) + Law::sine(0.2, 3.0, 0.0), false);
    let texts = motions(&system, &linspace(0.0, 1.0, 101)).map(|motion| {
        let proof = system.prove(&motion).expect("a proof");
        assert!(proof.is_complete(), "{proof}");
        proof.to_string()
    });
    // The last line is how far the computed positions themselves are off, which is rounding.
    let verdict = |text: &str| text.lines().take(2).map(str::to_string).collect::<Vec<String>>();
    assert_eq!(verdict(&texts[0]), verdict(&texts[1]));
    assert!(
        texts.iter().all(|text| text.contains("computed positions deviate by at most")
            && text.contains("e-15 rad"))
    );
}

#[test]
fn extremes_and_conditions_are_the_same() {
    let (system, rocker) = four_bar(Law::ramp(TAU), false);
    let [plain, program] = motions(&system, &linspace(0.0, 1.0, 361));
    let told = |motion: &Motion| {
        let swing = system.extremes(motion, rocker.theta()).expect("extremes");
        let all = swing.all().iter().map(|found| format!("{found:.6?}")).collect::<Vec<_>>();
        let condition = system.condition(motion).expect("conditions");
        (all, format!("{:.6e}", condition.values().iter().fold(0.0_f64, |most, x| most.max(*x))))
    };
    assert_eq!(told(&plain), told(&program));
}

/// A toggle in the middle of a run, with the diagnosis of what is wrong there.
#[test]
fn toggles_are_told_in_the_same_words() {
    let (system, _) = four_bar(Law::linear(2.2, -1.0), true);
    let [plain, program] =
        both(&system, &linspace(0.0, 1.0, 1001)).map(|run| run.expect_err("a toggle"));
    assert_eq!(plain.to_string(), program.to_string());
    let both = [&plain, &program].map(|error| match error.failure() {
        Some(RunFailure { t, kind: FailureKind::Toggle { .. }, .. }) => *t,
        _ => panic!("{plain} {program}"),
    });
    let [t, other] = both;
    assert!((t - other).abs() < 1e-9, "{t} {other}");
    let diagnoses = [&plain, &program].map(|error| error.diagnosis().map(ToString::to_string));
    assert_eq!(diagnoses[0], diagnoses[1]);
    assert!(program.motion().is_some_and(|motion| motion.engine().compiled > 300), "{program}");
}

/// √ is no number beyond t = 0.64 s.
#[constraint]
fn shrinking(x: Coord, t: Time, depth: f64) -> f64 {
    x - 2.0 * (depth - t).sqrt()
}

#[test]
fn what_is_no_number_is_blamed_in_the_same_words() {
    let mut m = Mechanism::new("wedge");
    let x = m.length("wedge", 1.6).expect("a length");
    m.add("slot", shrinking(x, 0.64)).expect("adds");
    let system = m.build().expect("builds");
    let [plain, program] =
        both(&system, &linspace(0.0, 1.0, 1001)).map(|run| run.expect_err("no number"));
    assert_eq!(plain.to_string(), program.to_string());
    assert!(program.to_string().contains("(depth - t).sqrt()"), "{program}");
    let lengths = [&plain, &program].map(|error| error.motion().map(Motion::len));
    assert!(lengths[0] == lengths[1] && lengths[0] > Some(600), "{lengths:?}");
}
