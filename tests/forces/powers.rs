//! The balance of powers: its largest power, what is left of it, and how it is printed.

use kin::SolverOptions;
use kin::loads::Friction;
use kin::prelude::*;
use kin::{Engine, Error, Load, Mechanism};

use crate::both::Engines;

const O: Vec2 = Vec2::new(0.0, 0.0);
const MASS: f64 = 3.0;

/// A block without weight on a guide that leans by 45°, pulled along it: each of its coordinates
/// has half of the power of the winch.
fn block(law: Law) -> (Mechanism, PlanarBody) {
    let mut m = Mechanism::new("block");
    let block = m.planar("block", pose(0.0, 0.0, PI / 4.0)).expect("a body");
    m.add("guide", prismatic(block, m.ground(), O, O, vec2(0.0, 2.0), PI / 4.0)).expect("a joint");
    m.add("winch", drive_point_along(block, O, vec2(1.0, 1.0), law)).expect("a driver");
    m.mass(block, MASS, O, 0.1).expect("a mass");
    (m, block)
}

/// The winch pulls and brakes; its largest power comes early, or late, above zero or below.
#[test]
fn the_largest_power_is_that_of_the_drive_whenever_it_comes() {
    for (law, count) in [
        // The power grows, falls, grows below zero, and falls below zero.
        (Law::polynomial(&[0.0, 1.0, 0.5]), 21),
        (Law::polynomial(&[0.0, 1.0, 0.5]), 16),
        (Law::polynomial(&[0.0, 3.0, 0.5, -0.1]), 21),
        (Law::polynomial(&[0.0, 3.0, -0.5, 0.02]), 21),
        (Law::polynomial(&[0.0, 3.0, 0.0, -0.1]), 19),
        (Law::sine(0.5, 7.0, 0.4), 64),
    ] {
        let system = block(law.clone()).0.build().expect("a system");
        let motion = system.run_both(linspace(0.0, 2.0, count)).expect("a motion");
        let power = |t: &f64| {
            let [_, v, a, _] = law.jet(*t);
            MASS * a * v
        };
        let due = motion.times().iter().map(power).fold(0.0_f64, |most, x| most.max(x.abs()));
        for engine in [Engine::StepByStep, Engine::Compiled] {
            let forces = system
                .solver()
                .options(SolverOptions::new().engine(engine))
                .forces(&motion)
                .expect("forces");
            let balance = forces.balance();
            assert!((balance.largest / due - 1.0).abs() < 1e-12, "{} {due}", balance.largest);
            for (t, found) in motion.times().iter().zip(balance.drives.values()) {
                assert!((found - power(t)).abs() < 1e-12 * due, "{t}: {found}");
            }
            assert_eq!(balance.drives.values().len(), count);
        }
    }
}

/// Powers of loads that cancel each other, and of friction, may be larger than any other.
#[test]
fn powers_of_loads_and_friction_may_be_the_largest() {
    let (mut m, body) = block(Law::ramp(2.0));
    m.load("there", Load::force(body, O, vec2(50.0, 10.0))).expect("a load");
    m.load("back", Load::force(body, O, vec2(-50.0, -10.0))).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 1.0, 11)).expect("a motion");
    for engine in [Engine::StepByStep, Engine::Compiled] {
        let balance = system
            .solver()
            .options(SolverOptions::new().engine(engine))
            .forces(&motion)
            .expect("forces")
            .balance()
            .clone();
        assert!((balance.largest - 100.0 * 0.5_f64.sqrt()).abs() < 1e-12, "{}", balance.largest);
        assert!(balance.drives.values().iter().all(|x| x.abs() < 1e-12));
    }
    // Downwards: friction takes half as much again as the weight gives along the way, and the winch
    // the rest.
    let (mut m, _) = block(Law::ramp(-2.0));
    m.gravity(vec2(0.0, -10.0));
    m.friction("guide", Friction::slide(1.5, [0.4, 0.0], 1e-3)).expect("friction");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 1.0, 11)).expect("a motion");
    let balance = system.forces(&motion).expect("forces").balance().clone();
    let weight = MASS * 10.0 * 0.5_f64.sqrt() * 2.0;
    for (found, due) in [
        (balance.largest, 1.5 * weight),
        (balance.friction.min(), -1.5 * weight),
        (balance.loads.max(), weight),
        (balance.drives.max(), 0.5 * weight),
    ] {
        assert!((found / due - 1.0).abs() < 1e-12, "{found} {due}");
    }
}

/// The balance gives power that is left as a share of the largest power, on either side of zero.
#[test]
fn what_is_left_is_told_as_a_share_of_the_largest_power() {
    let worst = |law: Law| {
        let system = block(law).0.build().expect("a system");
        let motion = system.run_both(linspace(0.0, 1.0, 11)).expect("a motion");
        let mut balance = system.forces(&motion).expect("forces").balance().clone();
        let sizes = balance.left.values().iter().map(|x| x.abs());
        let rounding = sizes.fold(0.0, f64::max) / balance.largest;
        assert!(balance.worst() == rounding && rounding < 1e-13, "{}", balance.worst());
        balance.left = balance.drives.clone();
        balance.worst()
    };
    // All of the power is left: the drive pulls, brakes, and does one before the other.
    for (law, what) in [
        (Law::polynomial(&[0.0, 1.0, 0.5]), "pulls"),
        (Law::polynomial(&[0.0, 3.0, -0.5]), "brakes"),
        (Law::polynomial(&[0.0, -1.0, 2.0]), "brakes a little, then pulls"),
        (Law::polynomial(&[0.0, 3.0, -2.0]), "brakes, then pulls a little"),
    ] {
        assert!((worst(law) - 1.0).abs() < 1e-14, "{what}");
    }
    let system = block(Law::constant(0.3)).0.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 1.0, 11)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let balance = forces.balance();
    assert_eq!((balance.worst(), balance.largest), (0.0, 0.0));
    assert_eq!(
        balance.to_string(),
        "power balance: drives + loads − kinetic energy's rate = 0e0 of 0.000 W at most."
    );
}

/// Friction is a part of the balance where it takes power at some time.
#[test]
fn friction_is_named_where_it_takes_power() {
    let told = |law: Law| {
        let mut m = block(law).0;
        m.friction("guide", Friction::slide(0.2, [0.4, 0.0], 1e-3)).expect("friction");
        m.gravity(vec2(0.0, -9.81));
        let system = m.build().expect("a system");
        let motion = system.run_both(linspace(0.0, 1.0, 11)).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        (forces.balance().to_string(), forces.balance().friction.max())
    };
    // From rest on.
    let (moving, max) = told(Law::polynomial(&[0.0, 0.0, 1.0]));
    assert!(
        moving.starts_with("power balance: drives + loads + friction −") && max == 0.0,
        "{moving}"
    );
    let (still, _) = told(Law::constant(0.3));
    assert!(still.starts_with("power balance: drives + loads −"), "{still}");
}

/// Forces that no number can hold are an error that names the first equation, with friction or
/// without.
#[test]
fn forces_beyond_all_numbers_are_an_error_by_name() {
    let told = |push: f64, friction: bool| {
        let (mut m, block) = block(Law::ramp(1.0));
        if friction {
            m.friction("guide", Friction::slide(0.2, [0.4, 0.0], 1e-3)).expect("friction");
        }
        m.load("push", Load::force(block, O, vec2(push, push))).expect("a load");
        m.load("too", Load::force(block, O, vec2(push, -push))).expect("a load");
        let system = m.build().expect("a system");
        let motion = system.run_both([0.0, 1.0]).expect("a motion");
        system.forces(&motion).map(drop)
    };
    assert!(told(1e9, false).is_ok() && told(1e9, true).is_ok());
    for friction in [false, true] {
        match told(1.7e308, friction) {
            Err(Error::OutputNotFinite { output, t, .. }) => {
                assert_eq!((output.as_str(), t), ("force of `guide.turn`", 0.0), "{friction}");
            }
            other => panic!("{friction}: {other:?}"),
        }
    }
    // Friction alone is beyond them.
    assert!(told(1e306, false).is_ok());
    assert!(matches!(told(1e306, true), Err(Error::OutputNotFinite { .. })));
}

#[test]
fn names_are_in_the_order_of_adding() {
    let (mut m, _) = block(Law::ramp(1.0));
    let trolley = m.spatial("trolley", SpatialPose::at(vec3(0.0, 0.0, 0.0))).expect("a body");
    let zero = vec3(0.0, 0.0, 0.0);
    let x = vec3(1.0, 0.0, 0.0);
    let same = EulerParameters::identity();
    m.add("rail", spatial::prismatic(trolley, m.ground(), zero, zero, x, same)).expect("a joint");
    m.add("jack", spatial::drive_slide(trolley, m.ground(), zero, zero, x, Law::ramp(1.0)))
        .expect("a driver");
    m.load("b", Load::force(trolley, zero, x)).expect("a load");
    m.load("a", Load::force(trolley, zero, x * 2.0)).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 1.0]).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    assert_eq!(forces.constraints(), ["guide", "winch", "rail", "jack"]);
    assert_eq!((forces.drives(), forces.loads()), (vec!["winch", "jack"], vec!["b", "a"]));
    let none: [&str; 0] = [];
    assert!(matches!(forces.sum(none).map(drop), Err(Error::EmptyName { .. })));
}
