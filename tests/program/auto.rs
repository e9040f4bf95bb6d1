//! Who decides: programs where they pay, plain steps without a word where there can be none.

use kin::extend::by_dual;
use kin::prelude::*;
use kin::solver::Stop;
use kin::{Engine, Follow, SolverOptions};

use crate::{USUAL, compiled, differences};

fn four_bar(motor: impl Fn(Link) -> Box<dyn kin::Constraint>) -> System {
    crate::four_bar(USUAL, |m, crank, _| {
        m.add("motor", motor(crank)).expect("adds");
    })
}

fn driven() -> System {
    four_bar(|crank| Box::new(drive_angle(crank, Law::ramp(TAU))))
}

fn auto() -> SolverOptions {
    SolverOptions::new().engine(Engine::Auto)
}

fn by_auto(system: &System, times: usize) -> Motion {
    system.solver().options(auto()).run(linspace(0.0, 1.0, times)).expect("runs")
}

#[test]
fn a_program_is_made_where_there_are_times_enough_for_it() {
    let system = driven();
    let few = by_auto(&system, 500);
    let many = by_auto(&system, 2001);
    assert_eq!((few.engine().compiled, few.why_not_compiled()), (0, None));
    assert!(
        many.engine().compiled > 1900 && many.why_not_compiled().is_none(),
        "{:?}",
        many.engine()
    );
    assert!(many.summary().contains(" of 2001 times compiled"), "{}", many.summary());
    assert!(!few.summary().contains("program"), "{}", few.summary());
    let plain = SolverOptions::new().engine(Engine::StepByStep);
    let plain = system.solver().options(plain.clone()).run(linspace(0.0, 1.0, 2001)).expect("runs");
    assert!(differences(&plain, &many).iter().all(|off| *off < 1e-10));
    assert_eq!(plain.engine().compiled, 0);
}

/// A long run keeps its program, but what a short one gives does not depend on what was run before.
#[test]
fn numbers_do_not_depend_on_what_was_run_before() {
    let fresh = driven();
    let used = driven();
    by_auto(&used, 3001);
    for times in [200, 2001] {
        let fresh = by_auto(&fresh, times);
        let used = by_auto(&used, times);
        assert_eq!(fresh.engine(), used.engine());
        assert_eq!(differences(&fresh, &used), [0.0; 3]);
    }
    let begun_later = |system: &System| {
        system.solver().options(auto()).run(linspace(0.3, 1.0, 1501)).expect("runs")
    };
    assert_eq!(differences(&begun_later(&driven()), &begun_later(&used)), [0.0; 3]);
}

#[test]
fn what_was_compiled_is_used_for_short_runs_until_something_is_set() {
    let mut system = driven();
    system.compile().expect("compiles");
    assert!(by_auto(&system, 200).engine().compiled > 150);
    assert_eq!(by_auto(&system, 20).engine().compiled, 0);
    // The program that was asked for has no jerk.
    let jerk = auto().jerk(true);
    assert_eq!(
        system
            .solver()
            .options(jerk.clone())
            .run(linspace(0.0, 1.0, 200))
            .expect("runs")
            .engine()
            .compiled,
        0
    );
    let copy = system.clone();
    system.set("A.u_j.x", -1.7).expect("is set");
    assert_eq!(by_auto(&system, 200).engine().compiled, 0);
    assert!(by_auto(&copy, 200).engine().compiled > 150);
}

/// Every parameter of every constraint is folded into the program, and none of them is ever stale.
#[test]
fn no_folded_parameter_is_ever_stale() {
    let mut system = driven();
    let mut set = 0;
    let plain = SolverOptions::new().engine(Engine::StepByStep);
    let times = linspace(0.0, 0.5, 1201);
    for (name, value) in system.parameters() {
        by_auto(&system, 1201);
        if system.set(&name, value + 0.01).is_err() {
            continue;
        }
        let before = by_auto(&system, 1201);
        let again = system.solver().options(plain.clone()).run(&times).expect("runs");
        let program = system.solver().options(auto()).run(&times).expect("runs");
        assert!(program.engine().compiled > 1000 && before.engine().compiled > 1000, "{name}");
        assert!(differences(&again, &program).iter().all(|off| *off < 1e-10), "{name}");
        set += 1;
    }
    assert!(set > 15, "{set}");
}

#[test]
fn what_cannot_be_compiled_runs_plainly_and_says_why() {
    let system = four_bar(|crank| Box::new(by_dual(drive_angle(crank, Law::ramp(TAU)))));
    let motion = by_auto(&system, 2001);
    let reason = motion.why_not_compiled().expect("a reason");
    assert!(
        reason.contains("Kin cannot compile `motor`") && reason.contains("dual numbers"),
        "{reason}"
    );
    assert!(
        motion.summary().contains(&format!("step by step, because {reason}")),
        "{}",
        motion.summary()
    );
    let plain = SolverOptions::new().engine(Engine::StepByStep);
    let plain = system.solver().options(plain.clone()).run(linspace(0.0, 1.0, 2001)).expect("runs");
    assert!(plain.why_not_compiled().is_none() && differences(&plain, &motion) == [0.0; 3]);
    assert!(system.solver().options(compiled()).run(linspace(0.0, 1.0, 2001)).is_err());
}

#[test]
fn options_that_a_program_does_not_know_are_those_of_plain_steps() {
    let system = driven();
    let all = [
        (auto().predict(false), "compiled runs always predict the next position"),
        (
            auto().stop(Stop::ResidualOnly(1e-10)),
            "only the step-by-step solver can stop by the residual alone",
        ),
    ];
    for (options, reason) in all {
        let motion =
            system.solver().options(options.clone()).run(linspace(0.0, 1.0, 2001)).expect("runs");
        assert_eq!(
            (motion.engine().compiled, motion.why_not_compiled()),
            (0, Some(reason)),
            "{options:?}"
        );
        // Of so few times no program was looked for.
        let motion =
            system.solver().options(options.clone()).run(linspace(0.0, 1.0, 201)).expect("runs");
        assert_eq!((motion.engine().compiled, motion.why_not_compiled()), (0, None), "{options:?}");
    }
    // Following and the jerk are asked of programs too.
    for options in [auto().follow(Follow::Unchecked), auto().jerk(true)] {
        let motion =
            system.solver().options(options.clone()).run(linspace(0.0, 1.0, 2001)).expect("runs");
        assert!(
            motion.engine().compiled > 1900 && motion.has_jerk() == options.jerk,
            "{options:?}"
        );
    }
}

/// Parts are plain to the last digit, unless a program is asked for: then each of them is computed
/// by the one that was made at the beginning.
#[test]
fn runs_in_parts_are_plain_unless_a_program_is_asked_for() {
    let system = driven();
    let times = linspace(0.0, 2.0, 4000);
    let whole = system
        .solver()
        .options(SolverOptions::new().engine(Engine::StepByStep))
        .run(&times)
        .expect("runs");
    for (options, least) in [(auto(), 0), (compiled(), 900)] {
        let mut k = 0;
        let mut off = [0.0_f64; 3];
        let keep = |part: &Motion| {
            assert!(
                part.engine().compiled >= least && part.why_not_compiled().is_none(),
                "{:?}",
                part.engine()
            );
            assert!(least > 0 || part.engine().compiled == 0);
            for own in 0..part.len() {
                let pairs = [
                    (part.q(own), whole.q(k)),
                    (part.qd(own), whole.qd(k)),
                    (part.qdd(own), whole.qdd(k)),
                ];
                for (off, (a, b)) in off.iter_mut().zip(pairs) {
                    let most = a.iter().zip(b).map(|(a, b)| (a - b).abs() / (1.0 + b.abs()));
                    *off = most.fold(*off, f64::max);
                }
                k += 1;
            }
            Ok(())
        };
        system
            .solver()
            .options(options.clone())
            .run_in_parts(times.iter().copied(), 1000, keep)
            .expect("runs");
        let bound = if least > 0 { 1e-10 } else { 0.0 };
        assert!(k == times.len() && off.iter().all(|off| *off <= bound), "{off:?}");
    }
    let refused = four_bar(|crank| Box::new(by_dual(drive_angle(crank, Law::ramp(TAU)))));
    let error = refused
        .solver()
        .options(compiled())
        .run_in_parts([0.0, 0.1], 1, |_| Ok(()))
        .expect_err("refused");
    assert!(error.to_string().contains("Kin cannot compile `motor`"), "{error}");
}

/// Cases of a sweep are computed by the engine that is asked for.
#[test]
fn sweeps_heed_the_engine() {
    let system = driven();
    let times = linspace(0.0, 1.0, 1501);
    let by = |options: SolverOptions| {
        let sweep = system.sweep(["coupler.theta"]).expect("a sweep").options(options);
        let found = sweep.run(&[[0.6]], &times, |_, motion| motion.expect("runs"));
        found.expect("runs").remove(0)
    };
    let plain = by(SolverOptions::new().engine(Engine::StepByStep));
    for found in [by(compiled()), by(SolverOptions::default())] {
        assert!(
            plain.engine().compiled == 0 && found.engine().compiled > 1400,
            "{:?}",
            found.engine()
        );
        assert!(differences(&plain, &found).iter().all(|off| *off < 1e-10));
    }
    let refused = four_bar(|crank| Box::new(by_dual(drive_angle(crank, Law::ramp(TAU)))));
    let sweep = refused.sweep(["coupler.theta"]).expect("a sweep").options(compiled());
    let error = sweep.run(&[[0.6]], &times, |_, _| ()).expect_err("refused");
    assert!(error.to_string().contains("Kin cannot compile `motor`"), "{error}");
    let sweep = refused.sweep(["coupler.theta"]).expect("a sweep");
    let found = sweep.run(&[[0.6]], &times, |_, motion| motion.expect("runs")).expect("runs");
    assert!(
        found[0].why_not_compiled().is_some_and(|why| why.contains("Kin cannot compile `motor`"))
    );
}
