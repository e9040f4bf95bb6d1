//! Forces that grow without bound towards toggles and change points: their powers against closed
//! forms.

use kin::SolverOptions;
use kin::error::{FailureKind, RunFailure};
use kin::forces::Growth;
use kin::prelude::*;
use kin::results::SingularKind;
use kin::{Error, Load, Mechanism};

use crate::both::Engines;

/// A slider-crank that its slider drives, its crank of length 1 at the angle `start`, with a torque
/// on it.
struct Pump {
    rod: f64,
    start: f64,
    law: Law,
    torque: Law,
    mass: f64,
}

impl Pump {
    fn system(self) -> System {
        self.mechanism().build().expect("a system")
    }

    fn mechanism(self) -> Mechanism {
        let Pump { rod, start, law, torque, mass } = self;
        let mut m = Mechanism::new("pump");
        let a = m.link("crank", 1.0).expect("a link");
        let b = m.link("rod", rod).expect("a link");
        let zero = vec2(0.0, 0.0);
        let x = start.cos();
        let y = start.sin();
        let phi = (-y / rod).asin();
        let slider = m.planar("slider", pose(x + rod * phi.cos(), 0.0, 0.0)).expect("a body");
        m.add("O", revolute(Ground, a, zero, a.start())).expect("a pin");
        m.add("A", revolute(a, b, a.end(), b.start())).expect("a pin");
        m.add("B", revolute(b, slider, b.end(), zero)).expect("a pin");
        m.add("guide", prismatic(slider, Ground, zero, zero, vec2(0.0, 1.0), 0.0))
            .expect("a guide");
        m.add("push", drive(slider.x(), law)).expect("a driver");
        let u = 0.5 * rod * phi.cos();
        let v = 0.5 * rod * phi.sin();
        m.set_initial(&[0.5 * x, 0.5 * y, start, x + u, y + v, phi, x + 2.0 * u, 0.0, 0.0])
            .expect("a guess");
        m.load("torque", Load::torque(a, torque)).expect("a load");
        if mass > 0.0 {
            m.mass(a, mass, zero, 0.1 * mass).expect("a mass");
            m.mass(b, 0.5 * mass, zero, 0.2 * mass).expect("a mass");
        }
        m
    }
}

/// Powers by name.
fn powers(growth: &[Growth]) -> Vec<(&str, f64)> {
    growth.iter().map(|one| (one.constraint.as_str(), one.power)).collect()
}

/// The motion before the toggle that ends a run.
fn stopped(system: &System, times: &[f64]) -> (Motion, f64) {
    let error = system.run_both(times).expect_err("a toggle");
    let Some(RunFailure { t, kind: FailureKind::Toggle { .. }, .. }) = error.failure() else {
        panic!("{error}")
    };
    let t = *t;
    (error.into_motion().expect("the motion before"), t)
}

/// Driven at its slider with the speed v to the dead centre at r + l, with the torque T on its
/// crank: there x = r + l − ½ k φ², k = r + r²/l, so that the force is T / |dx/dφ| = T / √(2 v k |t
/// − t*|). The rod's side force is bounded. With masses φ̈ goes as the power −3/2, and forces along
/// the rod as −2.
#[test]
fn a_dead_centre_that_is_driven_to() {
    let rod = 2.5;
    let speed = 0.4;
    let torque = 3.0;
    let pump = |mass: f64| {
        let law = Law::linear(2.4, speed);
        Pump { rod, start: 1.2, law, torque: Law::constant(torque), mass }.system()
    };
    let k = 1.0 + 1.0 / rod;
    let dead = (1.0 + rod - 2.4) / speed;
    for points in [12, 101] {
        let system = pump(0.0);
        let (motion, t) = stopped(&system, &linspace(0.0, 5.0, points));
        assert!((t - dead).abs() < 1e-10, "{t}");
        let growth = system.forces(&motion).expect("forces").growth().expect("growth");
        assert_eq!(
            powers(&growth),
            [("O", -0.5), ("A", -0.5), ("B", -0.5), ("push", -0.5)],
            "{points}"
        );
        assert!(growth.iter().all(|one| one.t == t));
        assert_eq!(
            growth[3].to_string(),
            "the forces of `push` grow without bound towards t* = 2.75 s, like |t − t*|^(−1/2)"
        );
    }
    // The same by forces at times that come near.
    let system = pump(0.0);
    for left in [1e-4_f64, 1e-6] {
        let motion = system.run_both([0.0, dead - left]).expect("a motion");
        let push = system.forces(&motion).expect("forces").drive("push").expect("a driver");
        let share = push.effort().values()[1].abs() * (2.0 * speed * k * left).sqrt() / torque;
        assert!((share - 1.0).abs() < 2.0 * left.sqrt(), "{left}: {share}");
    }
    let system = pump(0.7);
    let (motion, _) = stopped(&system, &linspace(0.0, 5.0, 51));
    let growth = system.forces(&motion).expect("forces").growth().expect("growth");
    let expected = [("O", -2.0), ("A", -2.0), ("B", -2.0), ("guide", -1.5), ("push", -2.0)];
    assert_eq!(powers(&growth), expected);
}

/// A four-bar that cannot turn round, with a torque on its rocker: the coupler's force has no bound
/// where coupler and rocker are in line. Its power by the slope of logarithms of forces that come
/// near.
#[test]
fn a_four_bar_at_its_dead_centre() {
    let mut m = Mechanism::new("four-bar");
    let [a, b, c] = [("crank", 2.0), ("coupler", 1.5), ("rocker", 2.2)]
        .map(|(name, length)| m.link(name, length).expect("a link"));
    m.add("O", revolute(Ground, a, vec2(0.0, 0.0), a.start())).expect("a pin");
    m.add("A", revolute(a, b, a.end(), b.start())).expect("a pin");
    m.add("B", revolute(b, c, b.end(), c.end())).expect("a pin");
    m.add("C", revolute(c, Ground, c.start(), vec2(3.5, 0.0))).expect("a pin");
    m.add("motor", drive_angle(a, Law::linear(0.5, 0.8))).expect("a driver");
    m.load("brake", Load::torque(c, 4.0)).expect("a load");
    let system = m.build().expect("a system");
    let (motion, t) = stopped(&system, &linspace(0.0, 4.0, 41));
    // Coupler and rocker in line: 2² + 3.5² − 2 · 2 · 3.5 cos θ = (1.5 + 2.2)².
    let theta = ((4.0 + 12.25 - 3.7 * 3.7) / 14.0_f64).acos();
    assert!((t - (theta - 0.5) / 0.8).abs() < 1e-10, "{t}");
    let growth = system.forces(&motion).expect("forces").growth().expect("growth");
    let expected = [("O", -0.5), ("A", -0.5), ("B", -0.5), ("C", -0.5), ("motor", -0.5)];
    assert_eq!(powers(&growth), expected);
    let near = system.run_both([0.0, t - 4e-6, t - 1e-6]).expect("a motion");
    let forces = system.forces(&near).expect("forces");
    let coupler =
        forces.reaction("A").expect("a pin").on(b).expect("on it").magnitude().expect("unique");
    let slope = (coupler.values()[2] / coupler.values()[1]).ln() / 0.25_f64.ln();
    assert!((slope + 0.5).abs() < 2e-3, "{slope}");
}

/// Crank and rod of length 1, the slider led as the crank's even turning leads it, x = 2 cos t: a
/// change point at t = 0, and the force T / (2 sin t). A torque that vanishes there leaves it
/// bounded.
#[test]
fn a_dead_centre_that_is_passed() {
    let pump = |torque: Law| {
        let law = Law::sine(2.0, 1.0, 0.5 * PI);
        Pump { rod: 1.0, start: -0.5, law, torque, mass: 0.0 }.system()
    };
    let system = pump(Law::constant(3.0));
    for points in [4, 20, 100] {
        let motion = system.run_both(linspace(-0.5, 0.61, points)).expect("a motion");
        let [found] = motion.singular_positions() else {
            panic!("{:?}", motion.singular_positions())
        };
        assert_eq!(found.kind, SingularKind::Bifurcation);
        let forces = system.forces(&motion).expect("forces");
        let growth = forces.growth().expect("growth");
        assert_eq!(powers(&growth), [("O", -1.0), ("A", -1.0), ("B", -1.0), ("push", -1.0)]);
        assert!(growth.iter().all(|one| one.t.abs() < 1e-9), "{growth:?}");
        for (t, push) in
            motion.times().iter().zip(forces.drive("push").expect("a driver").effort().values())
        {
            assert!((push * 2.0 * t.sin() / 3.0 - 1.0).abs() < 1e-8, "{t}: {push}");
        }
    }
    let system = pump(Law::linear(0.0, 3.0));
    let motion = system.run_both(linspace(-0.5, 0.61, 20)).expect("a motion");
    assert_eq!(motion.singular_positions().len(), 1);
    assert_eq!(system.forces(&motion).expect("forces").growth().expect("growth"), []);
}

/// A piston between both of its dead centres, x = 2.5 + cos t: they are change points at every half
/// turn. It begins at the end of a motion, if one is given.
fn piston(torque: &Law, begin: Option<&Motion>) -> System {
    let law = Law::constant(2.5) + Law::sine(1.0, 1.0, 0.5 * PI);
    let mut m = Pump { rod: 2.5, start: -0.55, law, torque: torque.clone(), mass: 0.0 }.mechanism();
    begin.map_or(Ok(()), |motion| m.set_initial(motion.q(motion.len() - 1))).expect("a position");
    m.build().expect("a system")
}

/// Both ways in time; a torque that is none at one of the dead centres leaves forces there bounded.
#[test]
fn two_dead_centres_that_are_passed() {
    let names = ["O", "A", "B", "push"];
    let both = [0.0, PI].map(|t| names.map(|name| (name, t)));
    for (torque, due) in [
        (Law::constant(3.0), both.concat()),
        (Law::linear(0.0, 1.0), both[1].to_vec()),
        (Law::linear(-PI, 1.0), both[0].to_vec()),
    ] {
        for count in [25, 301] {
            let times = linspace(-0.5, 3.6, count);
            let back: Vec<f64> = times.iter().rev().copied().collect();
            let system = piston(&torque, None);
            let there = system.run_both(&times).expect("a motion");
            let end = piston(&torque, Some(&there));
            let again = end.run_both(&back).expect("a motion");
            for (system, motion) in [(&system, &there), (&end, &again)] {
                let forces = system.forces(motion).expect("forces");
                let mut growth = forces.growth().expect("growth");
                growth.sort_by(|a, b| a.t.total_cmp(&b.t));
                let told: Vec<(&str, f64)> =
                    growth.iter().map(|one| (one.constraint.as_str(), one.power)).collect();
                let names: Vec<(&str, f64)> = due.iter().map(|one| (one.0, -1.0)).collect();
                assert_eq!(told, names, "{count} {:?}", motion.times()[0]);
                let off = growth.iter().zip(&due).map(|(one, due)| (one.t - due.1).abs());
                assert!(off.fold(0.0, f64::max) < 1e-8, "{growth:?}");
            }
        }
    }
}

/// Beside a change point pivots are close to zero: a program hands these times back, and counts
/// them.
#[test]
fn times_beside_a_change_point_are_handed_back() {
    let system = piston(&Law::constant(3.0), None);
    let mut times = linspace(-0.5, 0.61, 100);
    times.extend([-1e-4, 1e-4]);
    times.sort_by(f64::total_cmp);
    let motion = system.run(times).expect("a motion");
    let [plain, compiled] = [kin::Engine::StepByStep, kin::Engine::Compiled].map(|engine| {
        system
            .solver()
            .options(SolverOptions::new().engine(engine))
            .forces(&motion)
            .expect("forces")
    });
    let counts = compiled.engine();
    assert!(counts.handed_back > 0 && counts.compiled > 50, "{counts:?}");
    assert_eq!(counts.compiled + counts.handed_back + 1, motion.len());
    let effort = |forces: &kin::forces::Forces<'_>| {
        forces.drive("push").expect("a driver").effort().values().to_vec()
    };
    let plain = effort(&plain);
    let compiled = effort(&compiled);
    assert!(
        plain.iter().zip(&compiled).all(|(a, b)| (a / b - 1.0).abs() < 1e-9),
        "{plain:?} {compiled:?}"
    );
}

/// A torque that begins, or ends, at a dead centre: forces grow without bound from one side alone.
#[test]
fn forces_that_grow_from_one_side() {
    for (before, after) in [(3.0, 0.0), (0.0, 3.0)] {
        let law = Law::constant(2.5) + Law::sine(1.0, 1.0, 0.5 * PI);
        let none = Law::constant(0.0);
        let push = move |_: f64, _: f64, t: f64| if t < 0.0 { before } else { after };
        let pump = Pump { rod: 2.5, start: -0.55, law, torque: none, mass: 0.0 };
        let mut m = pump.mechanism();
        m.load("one side", Load::along("crank.theta", push)).expect("a load");
        let system = m.build().expect("a system");
        let motion = system.run_both(linspace(-0.5, 0.61, 20)).expect("a motion");
        let growth = system.forces(&motion).expect("forces").growth().expect("growth");
        assert_eq!(
            powers(&growth),
            [("O", -1.0), ("A", -1.0), ("B", -1.0), ("push", -1.0)],
            "{before}"
        );
    }
}

/// An error at the second of two singular positions is about that one, both ways in time.
#[test]
fn forces_at_the_second_change_point() {
    let mut times = linspace(-3.6, 0.5, 42);
    times[36] = 0.0;
    let torque = Law::constant(3.0);
    let first = piston(&torque, None).run_both(linspace(-0.5, -3.6, 32)).expect("a motion");
    let system = piston(&torque, Some(&first));
    let there = system.run_both(&times).expect("a motion");
    let end = piston(&torque, Some(&there));
    times.reverse();
    let back = end.run_both(&times).expect("a motion");
    for (system, motion) in [(&system, &there), (&end, &back)] {
        assert_eq!(motion.singular_positions().len(), 2);
        match system.forces(motion).map(drop) {
            Err(Error::Unbounded(found)) => {
                assert_eq!((found.t, found.growth.len()), (0.0, 4));
                assert!(
                    found.growth.iter().all(|one| one.t.abs() < 1e-9 && one.power == -1.0),
                    "{found}"
                );
            }
            other => panic!("{other:?}"),
        }
    }
}

/// At the singular position itself there is no number, but an error that says who grows.
#[test]
fn forces_at_a_change_point_are_an_error_by_name() {
    let law = Law::sine(2.0, 1.0, 0.5 * PI);
    let system =
        Pump { rod: 1.0, start: -0.5, law, torque: Law::constant(3.0), mass: 0.0 }.system();
    let motion = system.run_both(linspace(-0.5, 0.5, 11)).expect("a motion");
    assert_eq!(motion.times()[5], 0.0);
    match system.forces(&motion).map(|_| ()) {
        Err(error @ Error::Unbounded(_)) => {
            let told = error.to_string();
            assert!(told.contains("the singular position at t* = 0 s"), "{told}");
            assert!(told.contains("like |t − t*|^(−1) at `O`, `A`, `B` and `push`"), "{told}");
        }
        other => panic!("{other:?}"),
    }
}

/// A motion that keeps away from singular positions has nothing to tell.
#[test]
fn a_regular_motion_has_no_growth() {
    let law = Law::linear(2.4, 0.4);
    let system = Pump { rod: 2.5, start: 1.2, law, torque: Law::constant(3.0), mass: 1.0 }.system();
    let motion = system.run_both(linspace(0.0, 2.0, 21)).expect("a motion");
    assert_eq!(system.forces(&motion).expect("forces").growth().expect("growth"), []);
}
