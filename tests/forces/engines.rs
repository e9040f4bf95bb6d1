//! Forces by a program against those one time after the other: the same numbers, and told by name
//! what has no program.

use kin::SolverOptions;
use kin::forces::Forces;
use kin::loads::Friction;
use kin::prelude::*;
use kin::{Engine, Load, Mechanism, loads};

/// f(x, ẋ, t) of a damper with a seal that grows tired.
#[force]
fn seal(x: Coord, rate: Rate, t: Time, k: f64) -> f64 {
    -k * (x - 0.3) - 2.0 * rate.abs() * rate * (1.0 + 0.1 * t)
}

/// A force that is none from a time on.
#[force]
fn torn(x: Coord, rate: Rate, t: Time, until: f64) -> f64 {
    (until - t).sqrt() * x - rate
}

/// The distance of two points.      [m]
#[constraint]
fn strut(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> f64 {
    (i.point(u_i) - j.point(u_j)).norm()
}

/// A four-bar with masses, weight and loads of all kinds that are read.
fn four_bar() -> (Mechanism, Link) {
    let mut m = Mechanism::new("four-bar");
    let [crank, coupler, rocker] = [("crank", 0.4), ("coupler", 1.2), ("rocker", 0.9)]
        .map(|(name, l)| m.link(name, l).expect("a link"));
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).expect("a pin");
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).expect("a pin");
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).expect("a pin");
    m.add("C", revolute(m.ground(), rocker, vec2(1.1, 0.0), rocker.start())).expect("a pin");
    m.add("motor", drive_angle(crank, Law::ramp(5.0))).expect("a driver");
    m.prefer(rocker, deg(100.0));
    for (k, link) in [crank, coupler, rocker].into_iter().enumerate() {
        m.mass(link, 1.0 + k as f64, vec2(0.05, 0.02 * k as f64), 0.03).expect("a mass");
    }
    m.gravity(vec2(0.0, -9.81));
    let spring = loads::spring(m.ground(), coupler, vec2(0.2, -1.0), vec2(0.1, 0.1), 40.0, 0.5);
    m.load("spring", spring).expect("a load");
    let along = strut(m.ground(), rocker, vec2(0.5, 1.5), rocker.end());
    m.load("seal", seal(along, 30.0)).expect("a load");
    m.load("tool", Load::force_in_body(rocker, rocker.end(), vec2(-20.0, 3.0))).expect("a load");
    m.load(
        "wind",
        Load::force(coupler, vec2(0.0, 0.1), [Law::sine(5.0, 3.0, 0.0), Law::constant(1.0)]),
    )
    .expect("a load");
    m.load("brake", Load::torque(crank, -2.0)).expect("a load");
    (m, crank)
}

/// All that is told of forces as series.
fn told(forces: &Forces<'_>) -> Vec<Vec<f64>> {
    let energy = forces.energy();
    let balance = forces.balance();
    let own =
        [&energy.kinetic, &energy.potential, &balance.drives, &balance.loads, &balance.kinetic];
    let mut all: Vec<Vec<f64>> = own.iter().map(|series| series.values().to_vec()).collect();
    for name in forces.drives() {
        let drive = forces.drive(name).expect("a drive");
        all.extend([drive.effort().values().to_vec(), drive.power().values().to_vec()]);
    }
    all
}

/// The largest difference of two, each series by its largest number.
fn apart(a: &Forces<'_>, b: &Forces<'_>) -> f64 {
    told(a).iter().zip(told(b)).fold(0.0, |off, (a, b)| {
        let most = b.iter().fold(1e-3_f64, |m, x| m.max(x.abs()));
        a.iter().zip(b).fold(off, |off: f64, (a, b)| {
            if (a - b).abs() / most <= off { off } else { (a - b).abs() / most }
        })
    })
}

#[test]
fn loads_of_all_kinds_are_in_the_program() {
    let (m, crank) = four_bar();
    let mut system = m.build().expect("a system");
    let motion = system.run(linspace(0.0, 2.0, 201)).expect("a motion");
    let plain = system
        .solver()
        .options(SolverOptions::new().engine(Engine::StepByStep))
        .forces(&motion)
        .expect("forces");
    let compiled = system.forces(&motion).expect("forces");
    assert_eq!((plain.engine().compiled, plain.why_not_compiled()), (0, None));
    assert_eq!((compiled.engine().compiled, compiled.why_not_compiled()), (200, None));
    let off = apart(&compiled, &plain);
    assert!(off < 1e-11 && compiled.balance().worst() < 1e-12, "{off:e}, {}", compiled.balance());
    for name in ["O", "A", "motor"] {
        let on = |forces: &Forces<'_>| {
            let acted = forces.reaction(name).expect("a joint").on(crank).expect("its body");
            acted.components().iter().map(|series| series.values().to_vec()).collect::<Vec<_>>()
        };
        let largest = on(&plain).into_iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
        let off = on(&plain).into_iter().flatten().zip(on(&compiled).into_iter().flatten());
        assert!(off.into_iter().all(|(a, b)| (a - b).abs() < 1e-11 * largest), "{name}");
    }
    // A tape is of the values that it was made of.
    system.set("B.u_i.x", 0.5).expect("a parameter");
    let motion = system.run(linspace(0.0, 2.0, 201)).expect("a motion");
    let again = system.forces(&motion).expect("forces");
    let plain = system
        .solver()
        .options(SolverOptions::new().engine(Engine::StepByStep))
        .forces(&motion)
        .expect("forces");
    assert!(again.engine().compiled > 190 && apart(&again, &plain) < 1e-11);
}

#[test]
fn few_times_are_not_worth_a_program() {
    let system = four_bar().0.build().expect("a system");
    let motion = system.run(linspace(0.0, 0.3, 31)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    assert_eq!((forces.engine().compiled, forces.why_not_compiled()), (0, None));
}

/// Both answers about forces that have no program: by Compiled an error, by Auto the reason.
fn reasons(m: Mechanism) -> [String; 2] {
    let system = m.build().expect("a system");
    let motion = system.run(linspace(0.0, 0.6, 61)).expect("a motion");
    let refused = system
        .solver()
        .options(SolverOptions::new().engine(Engine::Compiled))
        .forces(&motion)
        .map(|_| ())
        .expect_err("an error")
        .to_string();
    let forces = system.forces(&motion).expect("forces");
    assert_eq!(forces.engine().compiled, 0);
    [refused, forces.why_not_compiled().unwrap_or_default().to_string()]
}

#[test]
fn a_closure_and_friction_are_told_by_name() {
    let (mut m, crank) = four_bar();
    let along = strut(m.ground(), crank, vec2(2.0, 0.0), crank.end());
    m.load("rope", Load::along(along, |x, _, _| -10.0 * x)).expect("a load");
    for told in reasons(m) {
        assert!(told.contains("Kin cannot compile `rope`: the force is a closure"), "{told}");
    }
    let (mut m, _) = four_bar();
    for joint in ["C", "O"] {
        m.friction(joint, Friction::pin(0.1, 0.02, 0.1)).expect("friction");
    }
    for told in reasons(m) {
        assert!(
            told.contains("Kin cannot compile `C`: Kin solves friction and the force"),
            "{told}"
        );
    }
}

#[test]
fn redundant_equations_are_told() {
    let mut m = Mechanism::new("parallelogram");
    let [a, b, c] = ["a", "b", "c"].map(|name| m.link(name, 1.0).expect("a link"));
    let beam = m.link("beam", 4.0).expect("a link");
    for (k, (name, link)) in [("a", a), ("b", b), ("c", c)].into_iter().enumerate() {
        let x = 2.0 * k as f64;
        m.add(&format!("{name}.O"), revolute(m.ground(), link, vec2(x, 0.0), link.start()))
            .expect("a pin");
        m.add(&format!("{name}.A"), revolute(link, beam, link.end(), vec2(x - 2.0, 0.0)))
            .expect("a pin");
    }
    m.add("motor", drive_angle(a, Law::linear(0.4, 1.0))).expect("a driver");
    m.mass(beam, 3.0, vec2(0.0, 0.0), 0.2).expect("a mass");
    for told in reasons(m) {
        assert!(
            told.contains("Kin cannot compile the mechanism: the mechanism has more equations"),
            "{told}"
        );
    }
}

/// A load that is no number from some time on is the same error, with the same time.
#[test]
fn what_is_not_finite_is_told_as_by_the_walk() {
    let (mut m, crank) = four_bar();
    let along = strut(m.ground(), crank, vec2(2.0, 0.0), crank.end());
    m.load("rope", torn(along, 0.355)).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run(linspace(0.0, 0.6, 61)).expect("a motion");
    let told = [Engine::StepByStep, Engine::Compiled, Engine::Auto].map(|engine| {
        system
            .solver()
            .options(SolverOptions::new().engine(engine))
            .forces(&motion)
            .map(|_| ())
            .expect_err("an error")
            .to_string()
    });
    assert!(told[0].contains("force of `rope`") && told[0].contains("t = 0.36"), "{told:?}");
    assert!(told[1] == told[0] && told[2] == told[0], "{told:?}");
}

/// Each case has the forces of its own mechanism, and its own error: of a crank that locks, of a
/// rope that is torn.
#[test]
fn cases_of_a_sweep_have_their_own_forces_and_errors() {
    let (mut m, crank) = four_bar();
    let along = strut(m.ground(), crank, vec2(2.0, 0.0), crank.end());
    m.load("rope", torn(along, 0.9)).expect("a load");
    let mut system = m.build().expect("a system");
    let cases: Vec<[f64; 2]> = [0.55, 0.6, 0.15, 0.65, 0.5].iter().map(|u| [-u, *u]).collect();
    let times = linspace(0.0, 0.8, 81);
    let names = ["A.u_j.x", "B.u_i.x"];
    let keep = |_: usize, forces: kin::Result<Forces<'_>>| {
        forces.map(|forces| told(&forces)).map_err(|error| error.to_string())
    };
    let swept =
        system.sweep(names).expect("a sweep").forces(&cases, &times, keep).expect("a sweep");
    assert!(swept.iter().filter(|found| found.is_ok()).count() == 4 && swept[2].is_err());
    for (case, found) in cases.iter().zip(swept) {
        names
            .iter()
            .zip(case)
            .for_each(|(name, x)| system.set(name, *x).map(|_| ()).expect("a parameter"));
        let own = system.run(&times).and_then(|motion| {
            let forces = system
                .solver()
                .options(SolverOptions::new().engine(Engine::StepByStep))
                .forces(&motion)?;
            Ok(told(&forces))
        });
        match (found, own) {
            (Ok(found), Ok(own)) => {
                for (found, own) in found.iter().zip(&own) {
                    let most = own.iter().fold(1e-3_f64, |m, x| m.max(x.abs()));
                    let far = |(a, b): (&f64, &f64)| (a - b).abs() > 1e-9 * most;
                    assert!(!found.iter().zip(own).any(far), "{case:?}");
                }
            }
            // That of a run tells more: what is wrong with the mechanism there.
            (Err(found), Err(own)) => {
                assert_eq!(found.lines().next(), own.to_string().lines().next())
            }
            (found, own) => panic!("{case:?}: {found:?} {own:?}"),
        }
    }
}
