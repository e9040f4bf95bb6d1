//! Summaries of programs.

use kin::prelude::*;

use crate::{USUAL, compiled, differences};

fn four_bar(law: Law) -> System {
    crate::four_bar(USUAL, |m, crank, _| {
        m.add("motor", drive_angle(crank, law)).expect("adds");
    })
}

#[test]
fn of_a_four_bar_two_angles_are_left() {
    let compiled = four_bar(Law::ramp(TAU)).compile().expect("compiles");
    assert_eq!(
        (compiled.substituted().len(), compiled.unknowns(), compiled.blocks()),
        (7, &names()[..], &[2][..])
    );
    let text = compiled.to_string();
    assert!(
        text.starts_with("four-bar: 7 of 9 coordinates have an explicit equation, Newton's method solves 2 coordinates in blocks of 2: coupler.theta"),
        "{text}"
    );
}

fn names() -> [String; 2] {
    ["coupler.theta", "rocker.theta"].map(String::from)
}

#[test]
fn parameters_that_are_set_count_in_the_next_run() {
    let mut system = four_bar(Law::ramp(TAU));
    let times = linspace(0.0, 1.0, 501);
    for x in [-0.5, -0.4] {
        system.set("O.u_j.x", x).expect("is set");
        let plain = system.run(&times).expect("runs");
        let program = system.solver().options(compiled()).run(&times).expect("runs");
        assert!(program.engine().compiled > 480, "{:?}", program.engine());
        assert!(differences(&plain, &program).iter().all(|off| *off < 1e-10));
    }
}

/// A law with breaks: both engines tell them, between the same times; one that jumps ends both runs
/// with the same words.
#[test]
fn breaks_and_jumps_of_laws_are_told_by_both() {
    let times = linspace(0.0, 2.0, 801);
    let system = four_bar(Law::harmonic_rise(1.0, 1.1));
    let plain = system.run(&times).expect("runs");
    let program = system.solver().options(compiled()).run(&times).expect("runs");
    assert!(!plain.breaks().is_empty() && plain.breaks() == program.breaks());
    assert!(program.engine().compiled > 700, "{:?}", program.engine());
    // A corner: a jump of speed.
    let system =
        four_bar(Law::sequence(0.0, [(0.7, Law::ramp(1.0)), (2.0, Law::linear(0.7, -0.5))]));
    let plain = system.run(&times).expect_err("jumps");
    let program = system.solver().options(compiled()).run(&times).expect_err("jumps");
    assert_eq!(plain.to_string(), program.to_string());
    let lengths = [plain, program].map(|error| error.motion().map(|motion| motion.len()));
    assert_eq!(lengths[0], lengths[1]);
}
