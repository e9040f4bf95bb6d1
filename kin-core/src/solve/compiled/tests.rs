//! Faults of a generator are planted, and never come to a number.

mod cases;

use super::*;
use crate::program::plant::passes::{PASSES, Pass, WRONGS, Wrong, with_fault};
use crate::program::tests::models::{four_bar, systems};
use crate::program::{Pose, Program, plant, program, schedule};
use crate::{Engine, linspace};

/// A run that is asked for, with or without the jerk.
#[derive(Clone, Copy)]
struct Asked<'a> {
    system: &'a System,
    times: &'a [f64],
    jerk: bool,
}

impl Asked<'_> {
    fn options(&self) -> SolverOptions {
        SolverOptions::new().jerk(self.jerk).engine(Engine::Compiled)
    }

    /// By plain steps.
    fn plain(&self) -> Motion {
        let options = self.options();
        let mut motion = Motion::new(self.system, self.times.len());
        Run::new(self.system, &options, None)
            .expect("runs")
            .reach_all(self.times, &mut motion)
            .expect("runs");
        motion
    }
}

/// A run by a program that was made of another system, or changed.
fn run_with(asked: Asked<'_>, made_of: &System, change: impl Fn(&mut Program)) -> Motion {
    run_by(asked, made_of, |mut program| {
        change(&mut program);
        schedule(program)
    })
}

/// A run by the tape that is made of the program of a system.
fn run_by(asked: Asked<'_>, made_of: &System, tape: impl Fn(Program) -> Tape) -> Motion {
    run_made(asked, |pose| Some(tape(program(made_of, pose, asked.jerk).expect("compiles"))))
}

/// A run by the tape that is made where the first position is; by plain steps where there is none.
fn run_made(asked: Asked<'_>, tape: impl Fn(Pose<'_>) -> Option<Tape>) -> Motion {
    let Asked { system, times, .. } = asked;
    let options = asked.options();
    let mut run = Run::new(system, &options, None).expect("runs");
    let mut motion = Motion::new(system, times.len());
    run.reach(times[0], &mut motion).expect("reaches");
    let newton = &run.stepper().expect("plain steps").newton;
    let pose = Pose { t: times[0], q: &newton.q, sizes: &newton.sizes };
    match tape(pose) {
        Some(tape) => {
            let case = tape.case(system).expect("fits");
            replay(&mut run, times, &mut motion, (&Arc::new(tape), &case), Lanes::Best)
                .expect("runs");
        }
        None => run.reach_all(&times[1..], &mut motion).expect("runs"),
    }
    motion
}

fn difference(a: &Motion, b: &Motion) -> f64 {
    let of = |a: &[f64], b: &[f64]| {
        a.iter().zip(b).map(|(a, b)| (a - b).abs() / (1.0 + a.abs())).fold(0.0, f64::max)
    };
    (0..a.len())
        .map(|k| {
            let further = of(a.qdd(k), b.qdd(k)).max(of(a.qddd(k), b.qddd(k)));
            of(a.q(k), b.q(k)).max(of(a.qd(k), b.qd(k))).max(further)
        })
        .fold(0.0, f64::max)
}

/// Single positions by a tape that is made where the first one is, each from the one before; gives
/// how many there are, and fails where one is not that of plain steps.
fn singly(
    asked: Asked<'_>,
    plain: &Motion,
    tape: impl Fn(Pose<'_>) -> Option<Tape>,
) -> Option<usize> {
    let Asked { system, times, .. } = asked;
    let options = asked.options();
    let mut run = Run::new(system, &options, None).expect("runs");
    run.reach(times[0], &mut Motion::new(system, 1)).expect("reaches");
    let newton = &run.stepper().expect("plain steps").newton;
    let tape = tape(Pose { t: times[0], q: &newton.q, sizes: &newton.sizes })?;
    let positions = position::Positions::new(Arc::new(tape), newton, times[0]);
    let found = (1..times.len())
        .filter_map(|k| Some((k, positions.position(system, times[k], plain.q(k - 1), &options)?)));
    Some(
        found
            .inspect(|(k, found)| {
                let lists = [
                    (&found.q, plain.q(*k)),
                    (&found.qd, plain.qd(*k)),
                    (&found.qdd, plain.qdd(*k)),
                ];
                for (own, plain) in lists {
                    let off = own.iter().zip(plain).map(|(a, b)| (a - b).abs() / (1.0 + b.abs()));
                    assert!(off.fold(0.0, f64::max) < 1e-9, "{own:?} is not {plain:?}");
                }
            })
            .count(),
    )
}

/// The constraints' own kernels look at the first position, and no other one counts before that is
/// right.
#[test]
fn planted_faults_never_come_to_a_single_position() {
    let system = four_bar(1.0);
    let times = linspace(0.0, 0.2, 41);
    let asked = Asked { system: &system, times: &times, jerk: false };
    let plain = asked.plain();
    let by = |change: &dyn Fn(&mut Program)| {
        let made = singly(asked, &plain, |pose| {
            let mut program = program(&system, pose, false).expect("compiles");
            change(&mut program);
            Some(schedule(program))
        });
        made.expect("a tape")
    };
    assert_eq!(by(&|_| {}), 40);
    let all = plant::ALL
        .into_iter()
        .flat_map(|fault| (0..system.n_coordinates()).map(move |k| (fault, k)));
    let noticed =
        all.filter(|(fault, k)| by(&|program| plant::plant(program, *fault, *k)) == 0).count();
    assert!(noticed > 25, "{noticed} of the faults were noticed; the others changed nothing");
    // Single positions have no jerk.
    let passes = PASSES.into_iter().filter(|pass| *pass != Pass::ThirdRates);
    for (pass, wrong) in passes.flat_map(|pass| WRONGS.map(|wrong| (pass, wrong))) {
        let found = (0..).step_by(3).map_while(|k| {
            let there = std::cell::Cell::new(true);
            let found = singly(asked, &plain, |pose| {
                let made = with_fault(&system, pose, (pass, wrong), k);
                there.set(made.is_some());
                Some(schedule(made?.ok()?))
            });
            there.get().then_some(found)
        });
        let found: Vec<Option<usize>> = found.collect();
        let noticed = found.iter().filter(|found| found.unwrap_or(0) == 0).count();
        assert!(5 * noticed >= found.len(), "{pass:?} {wrong:?}: {noticed} of {}", found.len());
    }
}

#[test]
fn planted_faults_never_come_to_a_number() {
    let system = four_bar(1.0);
    let times = linspace(0.0, 1.0, 301);
    for (jerk, least) in [(false, 25), (true, 50)] {
        let asked = Asked { system: &system, times: &times, jerk };
        let plain = asked.plain();
        let whole = run_with(asked, &system, |_| {});
        assert!(whole.engine.compiled > 280 && difference(&plain, &whole) < 1e-11);
        let mut planted = 0;
        for fault in plant::ALL {
            for k in 0..system.n_coordinates() {
                let motion = run_with(asked, &system, |program| plant::plant(program, fault, k));
                assert_eq!(motion.len(), plain.len());
                let off = difference(&plain, &motion);
                assert!(off < 1e-11, "{fault:?} {k}: {off:e} {:?}", motion.engine);
                planted += usize::from(motion.engine.compiled == 0);
            }
        }
        assert!(
            planted > least,
            "{planted} of the faults were noticed; the others changed nothing"
        );
    }
}

/// The constraints' own kernels look at the last time of a block, where this fault is none: the
/// plain step that the block begins at has to notice it.
#[test]
fn a_program_that_is_right_where_a_block_ends_alone_is_noticed_where_it_begins() {
    let system = four_bar(1.0);
    let times = linspace(0.0, 0.2, 41);
    let asked = Asked { system: &system, times: &times, jerk: false };
    let plain = asked.plain();
    for k in 0..system.n_coordinates() {
        let motion = run_with(asked, &system, |program| plant::wrong_but_at(program, k, 0.2, 1e-3));
        assert!(difference(&plain, &motion) < 1e-11, "{k}: {:?}", motion.engine);
    }
}

/// Every step of the tape in turn, in each of three ways.
#[test]
fn a_tape_with_one_wrong_step_never_comes_to_a_number() {
    let system = four_bar(1.0);
    let times = linspace(0.0, 0.5, 101);
    for jerk in [false, true] {
        let asked = Asked { system: &system, times: &times, jerk };
        let plain = asked.plain();
        let mut steps = 0;
        let mut noticed = 0;
        for slip in plant::SLIPS {
            for k in 0.. {
                let wrong = std::cell::Cell::new(false);
                let motion = run_by(asked, &system, |program| {
                    let mut tape = schedule(program);
                    wrong.set(plant::spoil(&mut tape, slip, k));
                    tape
                });
                if !wrong.get() {
                    break;
                }
                let off = difference(&plain, &motion);
                assert!(off < 1e-11, "{slip:?} {k}: {off:e} {:?}", motion.engine);
                (steps, noticed) = (steps + 1, noticed + usize::from(motion.engine.compiled == 0));
            }
        }
        assert!(
            steps > 300 && 2 * noticed > steps,
            "{noticed} of {steps} were noticed; the others changed nothing"
        );
    }
}

/// Every node that a pass hands on, in each of four ways: of a loop, and of one with more rows than
/// cofactors are taken of. The third rates magnify most what the stop rule leaves of a position.
#[test]
fn a_fault_of_a_pass_never_comes_to_a_number() {
    let platform =
        systems().find(|(name, _)| name == "13_stewart_platform").expect("the platform").1;
    for (system, end, step, near) in [(four_bar(1.0), 0.2, 1, 1e-10), (platform, 0.1, 7, 1e-9)] {
        let times = linspace(0.0, end, 41);
        let asked = Asked { system: &system, times: &times, jerk: true };
        let plain = asked.plain();
        for (pass, wrong) in PASSES.into_iter().flat_map(|pass| WRONGS.map(|wrong| (pass, wrong))) {
            let mut planted = 0;
            let mut noticed = 0;
            for k in (0..).step_by(step) {
                let there = std::cell::Cell::new(true);
                let motion = run_made(asked, |pose| {
                    let made = with_fault(&system, pose, (pass, wrong), k);
                    there.set(made.is_some());
                    Some(schedule(made?.ok()?))
                });
                if !there.get() {
                    break;
                }
                let off = difference(&plain, &motion);
                assert!(off < near, "{pass:?} {wrong:?} {k}: {off:e} {:?}", motion.engine);
                (planted, noticed) =
                    (planted + 1, noticed + usize::from(motion.engine.compiled == 0));
            }
            println!("{pass:?} {wrong:?}: {noticed} of {planted} are noticed");
            // A fault that changes no number, such as the sign of a zero, is none.
            let few = if pass == Pass::Gather || wrong == Wrong::Slight { 5 } else { 3 };
            // No row of the platform gives anything.
            let are_there = planted > 0 || (pass == Pass::Substitute && step > 1);
            assert!(
                are_there && few * noticed >= planted,
                "{pass:?} {wrong:?}: {noticed} of {planted}"
            );
        }
    }
}

/// Every parameter of every constraint, folded as it was before it was set, to something far or
/// near.
#[test]
fn a_stale_parameter_never_comes_to_a_number() {
    let system = four_bar(1.0);
    let times = linspace(0.0, 0.2, 41);
    let mut noticed = 0;
    for ((name, value), change) in system
        .parameters()
        .into_iter()
        .flat_map(|own| [0.01, 1e-9].map(|change| (own.clone(), change)))
    {
        let mut set = system.clone();
        if set.set(&name, value + change).is_err() {
            continue;
        }
        let asked = Asked { system: &set, times: &times, jerk: false };
        let motion = run_with(asked, &system, |_| {});
        assert!(difference(&asked.plain(), &motion) < 1e-11, "{name}: {:?}", motion.engine);
        noticed += usize::from(motion.engine.compiled == 0);
    }
    assert!(noticed > 30, "{noticed}");
}

#[test]
fn a_program_of_another_length_is_not_believed() {
    let system = four_bar(1.0);
    let times = linspace(0.0, 1.0, 301);
    let plain = system.run(&times).expect("runs");
    for a in [1.0 + 1e-6, 0.9] {
        let asked = Asked { system: &system, times: &times, jerk: false };
        let motion = run_with(asked, &four_bar(a), |_| {});
        assert!(
            motion.engine.compiled == 0 && difference(&plain, &motion) == 0.0,
            "{a}: {:?}",
            motion.engine
        );
    }
}

/// A program that no register could run is not made: Auto says so, and Compiled is an error.
#[test]
fn a_machine_without_lanes_is_told_and_compiles_nothing() {
    let system = four_bar(1.0);
    let times = linspace(0.0, 1.0, 3001);
    let run = |engine: Engine| {
        let options = SolverOptions::new().engine(engine);
        let mut computing = Computing::new(&system, times.len(), &options).expect("options");
        computing.lanes = Lanes::Off;
        let mut run = Run::new(&system, &options, None).expect("runs");
        let mut motion = Motion::new(&system, times.len());
        computing.run(&mut run, &times, &mut motion).map(|()| motion)
    };
    let auto = run(Engine::Auto).expect("runs");
    let plain = run(Engine::StepByStep).expect("runs");
    assert!(
        auto.why_not_compiled().is_some_and(|reason| reason.contains("no registers")),
        "{:?}",
        auto.why_not_compiled()
    );
    assert!(
        auto.engine.compiled == 0
            && difference(&auto, &plain) == 0.0
            && plain.why_not_compiled().is_none()
    );
    let error = run(Engine::Compiled).expect_err("refused").to_string();
    assert!(error.contains("no registers") && error.contains("Engine::Auto"), "{error}");
    assert!(system.cache().get::<programs::Programs>().is_none());
}

/// A program whose pivots are faint beside what they were where they were chosen computes nothing,
/// for digits would be lost.
#[test]
fn an_elimination_that_was_chosen_elsewhere_is_not_believed_where_its_pivots_are_faint() {
    for (name, system) in
        systems().filter(|(name, _)| name.contains("stewart") || name == "04_four_bar")
    {
        let times = linspace(0.0, 0.1, 41);
        let asked = Asked { system: &system, times: &times, jerk: false };
        let compiled = |share: f64| {
            let motion = run_with(asked, &system, |program| {
                program.chosen.iter_mut().flatten().for_each(|chosen| *chosen *= share);
                assert!(program.chosen.iter().flatten().all(|chosen| chosen.is_finite()), "{name}");
            });
            motion.engine.compiled
        };
        assert!(compiled(1.0) > 30 && compiled(1e3) > 30, "{name}");
        assert_eq!(compiled(1e6), 0, "{name}");
    }
}
