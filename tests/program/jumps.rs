//! Equations that choose between sides where coordinates move: a block ends where one chooses
//! another side, and plain steps go on from the last time before.

use kin::SolverOptions;
use kin::prelude::*;
use kin::results::EventKind;

use crate::engines::Engines;
use crate::{compiled, differences};

/// y = a |x| as two sides, and a step of height s where x passes 0.
#[constraint]
fn sides(x: Coord, y: Coord, a: f64, s: f64) -> f64 {
    if x < 0.0 { y + a * x } else { y - a * x - s }
}

/// y + sin y = s ⌊x⌋: y hangs on x by its steps alone.
#[constraint]
fn stairs(x: Coord, y: Coord, s: f64) -> f64 {
    y + 0.5 * y.sin() - s * x.floor()
}

/// The same where y is given.
#[constraint]
fn given_stairs(x: Coord, y: Coord, s: f64) -> f64 {
    y - s * x.floor()
}

/// z in teeth of a saw: of three kinds of remainder.
#[constraint]
fn saw(x: Coord, y: Coord, s: f64) -> f64 {
    y - s * (x.fract() + x.rem_euclid(0.7) + x % 0.9)
}

fn driven(law: Law, add: impl Fn(&mut Mechanism, Coordinate, Coordinate)) -> System {
    let mut m = Mechanism::new("sides");
    // The driven coordinate comes last: no order of rows gives it by chance.
    let [y, x] = ["y", "x"].map(|name| m.length(name, 0.1).expect("a length"));
    add(&mut m, x, y);
    m.add("motor", drive(x, law)).expect("adds");
    m.build().expect("builds")
}

/// x crosses 0 twice a period: each time the block ends.
#[test]
fn a_block_ends_where_another_side_is_chosen() {
    for s in [0.0, 1e-5] {
        let system = driven(Law::sine(0.4, TAU, 0.3), |m, x, y| {
            m.add("sides", sides(x, y, 0.7, s)).expect("adds");
        });
        let times = linspace(0.0, 2.0, 2001);
        let plain = system.run_both(&times).expect("runs");
        let program = system.solver().options(compiled()).run(&times).expect("runs");
        let crossings =
            (1..plain.len()).filter(|k| plain.q(*k)[1] * plain.q(k - 1)[1] < 0.0).count();
        assert_eq!((crossings, program.engine().handed_back), (4, 4));
        assert!(program.engine().compiled > 1950, "{:?}", program.engine());
        assert!(differences(&plain, &program).iter().all(|off| *off < 1e-10));
    }
}

/// A coordinate that a row hangs on by steps alone is known before it.
#[test]
fn steps_of_coordinates_are_those_of_plain_steps() {
    for given in [true, false] {
        let system = driven(Law::ramp(1.0), |m, x, y| {
            if given {
                m.add("stairs", given_stairs(x, y, 1e-4))
            } else {
                m.add("stairs", stairs(x, y, 1e-4))
            }
            .expect("adds");
        });
        let times = linspace(0.05, 4.0, 1001);
        let plain = system.run_both(&times).expect("runs");
        let program = system.solver().options(compiled()).run(&times).expect("runs");
        assert_eq!(program.engine().handed_back, 4, "{:?}", program.engine());
        assert!(program.engine().compiled > 900, "{:?}", program.engine());
        assert!(differences(&plain, &program).iter().all(|off| *off < 1e-11));
        let last = plain.q(1000)[0];
        assert!(if given { last == 4e-4 } else { last > 2.6e-4 && last < 2.7e-4 }, "{last}");
    }
}

#[test]
fn remainders_are_those_of_plain_steps() {
    let system = driven(Law::linear(0.05, 0.4), |m, x, y| {
        m.add("saw", saw(x, y, 1e-4)).expect("adds");
    });
    let times = linspace(0.0, 5.0, 2001);
    let plain = system.run_both(&times).expect("runs");
    let program = system.solver().options(compiled()).run(&times).expect("runs");
    // 1 and 2 of whole numbers, 0.7 and 1.4, 0.9 and 1.8. Each of them is met at a time of the
    // grid, where rounding alone chooses: neither does a block reach it nor begin there.
    assert_eq!(program.engine().handed_back, 12, "{:?}", program.engine());
    assert!(differences(&plain, &program).iter().all(|off| *off < 1e-10));
}

/// A jump that no step can follow ends both runs with the same words.
#[test]
fn what_plain_steps_cannot_follow_no_program_can() {
    let system = driven(Law::sine(0.4, TAU, 0.3), |m, x, y| {
        m.add("sides", sides(x, y, 0.7, 5.0)).expect("adds");
    });
    let times = linspace(0.0, 2.0, 2001);
    let _ = system.run_both(&times);
    let ends = [SolverOptions::new().engine(kin::Engine::StepByStep), compiled()].map(|options| {
        system.solver().options(options.clone()).run(&times).map(|motion| motion.len())
    });
    match ends {
        [Ok(plain), Ok(program)] => assert_eq!(plain, program),
        [Err(plain), Err(program)] => assert_eq!(plain.to_string(), program.to_string()),
        ends => panic!("{ends:?}"),
    }
}

/// The Geneva drive of the gallery: its pin enters and leaves a slot eight times in four turns of
/// the driver.
#[test]
fn the_geneva_drive_is_handed_back_where_its_pin_enters_and_leaves() {
    let mut all = crate::gallery::mechanisms().into_iter();
    let (_, system) = all.find(|(name, _)| name.starts_with("20_")).expect("the Geneva drive");
    let times = linspace(0.0, 4.0, 4001);
    let plain = system.run_both_with(&times, &SolverOptions::new().jerk(true)).expect("runs");
    let program = system.solver().options(compiled()).run(&times).expect("runs");
    let counts = program.engine();
    assert!(counts.handed_back > 1 && 100 * counts.handed_back < times.len(), "{counts:?}");
    assert!(10 * counts.compiled > 9 * times.len(), "{counts:?}");
    assert!(plain.has_jerk());
}

/// Times that a program computes after a jump are led there by times after it: single steps come
/// first.
#[test]
fn times_after_a_jump_are_led_by_times_after_it() {
    let by = |s: f64| {
        let system = driven(Law::ramp(1.0), |m, x, y| {
            m.add("stairs", stairs(x, y, s)).expect("adds");
        });
        system.solver().options(compiled()).run(linspace(0.05, 4.0, 1001)).expect("runs")
    };
    let motion = by(0.4);
    let counts = motion.engine();
    // Three at the beginning, and three after each jump.
    let by_steps = motion.len() - counts.compiled;
    assert!(counts.handed_back >= 3 && by_steps >= 3 * (counts.handed_back + 1), "{counts:?}");
    assert!(by_steps < 6 * (counts.handed_back + 1), "{counts:?}");
}

/// y = x as long as x is below an edge.
#[constraint]
#[branch(x < edge, "x is beyond its edge")]
fn below(x: Coord, y: Coord, edge: f64) -> f64 {
    y - x
}

/// A program looks at each of its times whether the position is the one that is meant: the run ends
/// at the same time.
#[test]
fn a_position_that_is_not_meant_ends_a_block() {
    let system = driven(Law::ramp(1.0), |m, x, y| {
        m.add("below", below(x, y, 0.5003)).expect("adds");
    });
    let times = linspace(0.0, 1.0, 1001);
    let error = system.run_both(&times).expect_err("it is beyond its edge");
    assert_eq!(error.motion().map(|motion| motion.len()), Some(501), "{error}");
}

/// Near a position at which all links are in line the pivot of the loop falls to a small share of
/// what it was where a block began: steps that would be short enough there are left to plain steps.
#[test]
fn steps_are_judged_by_the_pivot_at_their_own_times() {
    let system = crate::four_bar([1.0, 3.0, 2.0003, 4.0], |m, crank, _| {
        m.add("motor", drive_angle(crank, Law::linear(1.5, 1.0))).expect("adds");
    });
    let motion = system.solver().options(compiled()).run(linspace(0.0, 4.0, 120)).expect("runs");
    assert!(motion.engine().handed_back >= 4, "{:?}", motion.engine());
}

/// 2 z = x and a tenth for each whole number of r x.
#[constraint]
fn stair(x: Coord, z: Coord, k: f64, r: f64) -> f64 {
    k * z - x - (x * r).floor() * 0.1
}

/// x comes to 1, where r x is a whole number, and rests there: every engine, and every case of a
/// sweep, is on the branch that the whole number belongs to.
#[test]
fn a_coordinate_may_rest_on_a_step() {
    for (r, n) in [(3.0, 24), (3.0, 121), (2.0, 60), (1.0, 300)] {
        let system = driven(Law::cycloidal(1.0, 0.5), |m, x, z| {
            m.add("z", stair(x, z, 2.0, r)).expect("adds");
        });
        let times = linspace(0.0, 1.0, n);
        let plain = system
            .solver()
            .options(SolverOptions::new().engine(kin::Engine::StepByStep))
            .run(&times);
        let program = system.solver().options(compiled()).run(&times).expect("runs");
        let plain = plain.expect("runs");
        assert!(differences(&plain, &program).iter().all(|off| *off < 1e-10));
        assert!((plain.q(n - 1)[0] - (0.5 + 0.05 * r)).abs() < 1e-12, "{}", plain.q(n - 1)[0]);
        let cases: Vec<[f64; 1]> = (0..60).map(|k| [1.5 + f64::from(k) / 59.0]).collect();
        let ends = system
            .sweep(["z.k"])
            .expect("sweeps")
            .run(&cases, &times, |_, motion| Ok(motion?.q(n - 1)[0]));
        for (case, z) in cases.iter().zip(ends.expect("runs")) {
            let z: kin::Result<f64> = z;
            assert!((z.expect("runs") - (1.0 + 0.1 * r) / case[0]).abs() < 1e-12, "{case:?}");
        }
    }
}

/// y = |x − 1|
#[constraint]
fn away(x: Coord, y: Coord) -> f64 {
    y - (x - 1.0).abs()
}

/// A motion that comes to a kink and rests there does not pass it; one that goes on passes it once.
#[test]
fn a_motion_at_rest_on_a_kink_does_not_pass_it() {
    for (height, n) in [(1.0, 24), (1.0, 121), (1.0, 1001), (2.0, 24), (2.0, 1001)] {
        let system = driven(Law::cycloidal(height, 0.5), |m, x, y| {
            m.add("away", away(x, y)).expect("adds");
        });
        let times = linspace(0.0, 1.0, n);
        for engine in [kin::Engine::StepByStep, kin::Engine::Compiled] {
            let motion = system
                .solver()
                .options(SolverOptions::new().engine(engine))
                .run(&times)
                .expect("runs");
            let kinks =
                motion.events().iter().filter(|event| event.kind == EventKind::Kink).count();
            assert_eq!(
                kinks,
                usize::from(height > 1.0),
                "{height} {n} {engine:?}: {:?}",
                motion.events()
            );
        }
    }
}
