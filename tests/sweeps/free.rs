//! Sweeps by one program: what differs from case to case is left free in it, whatever it is, and
//! each case is what its own system does.

use kin::extend::Lanes;
use kin::joints::spatial;
use kin::prelude::*;
use kin::{Engine, SolverOptions};

use crate::{far, numbers};

/// A dent that only rustc can read, of the depth and of the time.
fn dent<D: Dual>(t: Real<D>, depth: Real<D>) -> Real<D> {
    depth * (1.0 - (-t * t).exp())
}

/// The share of a load that a seal takes; only rustc can read it.
fn grade(k: f64) -> f64 {
    let table = [0.2, 0.5, 0.9];
    table[(k.abs() as usize).min(2)] + 0.01 * k
}

/// A rod that creeps: its length hangs on time by functions of the user's.
#[constraint]
fn creeping(
    i: Planar,
    j: Planar,
    t: Time,
    u_i: Vec2,
    u_j: Vec2,
    l: f64,
    depth: f64,
    k: f64,
    wave: Law,
) -> f64 {
    let d = i.point(u_i) - j.point(u_j);
    let own = l + dent(t, depth) + 0.01 * grade(k) + wave.at(2.0 * t);
    d.dot(d) - own * own
}

/// A crank, and a block on a guide behind a rod that creeps.
fn guided() -> kin::Result<System> {
    let mut m = Mechanism::new("guided");
    let a = m.dimension("a", 0.1)?;
    let crank = m.link("crank", a)?;
    let block = m.planar("block", pose(0.4, 0.0, 0.0))?;
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("guide", prismatic(block, Ground, vec2(0.0, 0.0), vec2(0.0, 0.0), vec2(1.0, 0.2), 0.0))?;
    let rod = creeping(
        crank,
        block,
        crank.end(),
        vec2(0.0, 0.0),
        0.3,
        0.02,
        1.0,
        Law::sine(0.01, 3.0, 0.2),
    );
    m.add("rod", rod)?;
    m.add("motor", drive_angle(crank, Law::sine(0.8, 2.0, 0.3)))?;
    m.build()
}

/// A spatial arm that a hinge along a sloping axis turns.
fn hinged() -> kin::Result<System> {
    let mut m = Mechanism::new("hinged");
    let arm = m.spatial("arm", SpatialPose::at(Vec3::zeros()))?;
    let axis = vec3(0.3, 0.2, 1.0);
    m.add("hinge", spatial::revolute(m.ground(), arm, Vec3::zeros(), Vec3::zeros(), axis, axis))?;
    let motor =
        kin::joints::drivers::spatial::drive_turn(m.ground(), arm, axis, axis, Law::ramp(1.3));
    m.add("motor", motor)?;
    m.build()
}

/// The motions of the cases by a sweep with that engine, and by a system of its own each.
fn motions(
    system: &System,
    names: &[&str],
    cases: &[Vec<f64>],
    options: &SolverOptions,
) -> [Vec<Motion>; 2] {
    let times = linspace(0.0, 2.0, 301);
    let swept = system.sweep(names).unwrap().options(options.clone());
    let swept = swept.run(cases, &times, |_, motion| motion.unwrap()).unwrap();
    let plain = options.clone().engine(Engine::StepByStep);
    let own = |case: &Vec<f64>| {
        let mut own = system.clone();
        names.iter().zip(case).for_each(|(name, value)| own.set(name, *value).unwrap());
        own.solver().options(plain.clone()).run(&times).unwrap()
    };
    [swept, cases.iter().map(own).collect()]
}

/// Asserts that all cases are computed by a program, and are what their own systems do.
fn assert_same(system: &System, names: &[&str], cases: &[Vec<f64>]) {
    for jerk in [false, true] {
        let options = SolverOptions::new().jerk(jerk);
        let [swept, own] = motions(system, names, cases, &options);
        for (k, (swept, own)) in swept.iter().zip(&own).enumerate() {
            let engine = swept.engine();
            assert!(engine.compiled > 270 && engine.handed_back < 10, "{names:?} {k}: {engine:?}");
            let off = far(&numbers(swept), &numbers(own));
            assert!(off < 1e-9, "{names:?}, case {k}: {off:e}");
            if jerk {
                let jerk = |motion: &Motion| {
                    (0..301).flat_map(|k| motion.qddd(k).to_vec()).collect::<Vec<f64>>()
                };
                let off = far(&jerk(swept), &jerk(own));
                assert!(off < 1e-7, "{names:?}, jerk of case {k}: {off:e}");
            }
        }
    }
}

#[test]
fn parameters_laws_and_values_of_the_users_own_functions_are_free() -> kin::Result<()> {
    let system = guided()?;
    let spread = |k: usize, values: [f64; 2]| values[0] + 0.1 * k as f64 * (values[1] - values[0]);
    for (name, values) in [
        ("rod.l", [0.3, 0.35]),
        ("rod.u_j.y", [0.0, 0.02]),
        ("rod.depth", [0.0, 0.03]),
        ("rod.k", [-2.0, 2.0]),
        ("rod.wave.amplitude", [0.0, 0.02]),
        ("rod.wave.omega", [2.0, 4.0]),
        ("motor.law.amplitude", [0.3, 0.9]),
        ("guide.h_i.x", [1.0, 1.2]),
        ("a", [0.08, 0.11]),
    ] {
        let cases: Vec<Vec<f64>> = (0..9).map(|k| vec![spread(k, values)]).collect();
        assert_same(&system, &[name], &cases);
    }
    let all = ["rod.k", "motor.law.amplitude", "a", "rod.depth", "guide.h_i.y"];
    let cases = (0..9).map(|k| {
        let [grade, swing, a, depth, slope] =
            [[0.0, 3.0], [0.3, 0.9], [0.08, 0.11], [0.0, 0.03], [-0.2, 0.2]];
        [grade, swing, a, depth, slope].map(|values| spread(k, values)).to_vec()
    });
    assert_same(&system, &all, &cases.collect::<Vec<_>>());
    Ok(())
}

#[test]
fn directions_along_axes_are_free() -> kin::Result<()> {
    let cases: Vec<Vec<f64>> = (0..12).map(|k| 0.1 * f64::from(k)).map(|x| vec![x, x]).collect();
    assert_same(&hinged()?, &["hinge.h_i.x", "motor.h_i.x"], &cases);
    Ok(())
}

/// The digits of a case do not hang on which others there are, nor on how many threads.
#[test]
fn cases_do_not_hang_on_one_another() -> kin::Result<()> {
    let system = guided()?;
    let cases: Vec<[f64; 2]> =
        (0..40).map(|k| 1e-3 * f64::from(k)).map(|x| [0.3 + x, 0.4 + x]).collect();
    let run = |cases: &[[f64; 2]], threads| {
        let sweep = system.sweep(["rod.l", "motor.law.amplitude"])?.threads(threads);
        sweep.run(cases, linspace(0.0, 2.0, 301), |_, motion| {
            motion.map(|motion| (numbers(&motion), motion.engine()))
        })
    };
    let all = run(&cases, 2)?;
    let some = run(&cases[20..35], 1)?;
    for (one, other) in all[20..35].iter().zip(&some) {
        let (Ok((one, engine)), Ok((other, _))) = (one, other) else { panic!("{one:?} {other:?}") };
        assert!(one == other && engine.compiled > 270, "{engine:?}");
    }
    Ok(())
}

/// The program is made where the system as it is begins, or the first case that can be assembled.
#[test]
fn cases_that_cannot_be_assembled_do_not_keep_others_from_a_program() -> kin::Result<()> {
    let system = guided()?;
    let lengths = [-0.3, 0.01, 0.3, 0.31, 0.05, 0.32];
    let sweep = system.sweep(["rod.l"])?;
    let found = sweep.run(&lengths.map(|l| [l]), linspace(0.0, 2.0, 301), |_, motion| motion)?;
    for (l, found) in lengths.iter().zip(found) {
        match found {
            Ok(motion) => {
                assert!(
                    l.abs() > 0.2 && motion.engine().compiled > 270,
                    "{l}: {:?}",
                    motion.engine()
                )
            }
            Err(error) => assert!(*l < 0.2 && *l > 0.0, "{l}: {error}"),
        }
    }
    Ok(())
}

/// Few times of a case do not pay, nor do lanes that are turned off.
#[test]
fn short_cases_and_cases_without_lanes_are_plain() -> kin::Result<()> {
    let system = guided()?;
    let cases = (0..200).map(|k| [0.3 + 1e-4 * f64::from(k)]).collect::<Vec<_>>();
    for (lanes, count) in [(Lanes::Best, 5), (Lanes::Off, 301)] {
        let sweep = system.sweep(["rod.l"])?.lanes(lanes);
        let found = sweep.run(&cases, linspace(0.0, 2.0, count), |_, motion| {
            motion.map(|m| m.engine().compiled)
        });
        assert!(found?.into_iter().all(|compiled| compiled.is_ok_and(|compiled| compiled == 0)));
    }
    Ok(())
}
