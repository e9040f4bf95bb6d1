//! Forces by a program of bodies in space, of coordinates that stand still, of no force and of
//! large ones.

use kin::forces::Forces;
use kin::prelude::*;
use kin::{Engine, Load, Mechanism, SolverOptions, loads};

const O: Vec2 = Vec2::new(0.0, 0.0);

/// A point of a body in space.      [m]
#[constraint]
fn of_body(i: Spatial, u_i: Vec3) -> Vec3 {
    i.point(u_i)
}

/// All numbers of forces: columns, powers, and the largest of these.
fn numbers(forces: &Forces<'_>) -> Vec<(String, Vec<f64>)> {
    let balance = forces.balance();
    let powers = [&balance.drives, &balance.loads, &balance.kinetic];
    let mut all: Vec<(String, Vec<f64>)> = forces
        .columns()
        .iter()
        .chain(powers)
        .map(|series| (series.name().to_string(), series.values().to_vec()))
        .collect();
    all.push(("largest".to_string(), vec![balance.largest]));
    all
}

/// Fails unless a program has the forces of all times but the first, and they are those one by one.
fn by_program(system: &System, motion: &Motion) -> Vec<(String, Vec<f64>)> {
    let plain = system
        .solver()
        .options(SolverOptions::new().engine(Engine::StepByStep))
        .forces(motion)
        .expect("forces");
    let compiled = system
        .solver()
        .options(SolverOptions::new().engine(Engine::Compiled))
        .forces(motion)
        .expect("forces");
    let counts = compiled.engine();
    assert_eq!((counts.compiled, counts.handed_back), (motion.len() - 1, 0), "{}", system.name());
    assert_eq!(compiled.why_not_compiled(), None);
    assert!(compiled.balance().worst() < 1e-11, "{}", compiled.balance());
    let plain = numbers(&plain);
    let compiled = numbers(&compiled);
    let size = plain.iter().flat_map(|one| &one.1).fold(0.0_f64, |most, x| most.max(x.abs()));
    for ((name, a), (_, b)) in plain.iter().zip(&compiled) {
        assert_eq!(a.len(), b.len(), "{name}");
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-11 * size), "{name}: {a:?} {b:?}");
    }
    compiled
}

/// A rotor that turns and slides, with everything that can act on it, and a body on a ball joint of
/// it.
fn rotor() -> System {
    let mut m = Mechanism::new("rotor");
    m.gravity(vec3(0.3, -0.2, -9.81));
    let zero = vec3(0.0, 0.0, 0.0);
    let h = vec3(0.0, 0.6, 0.8);
    let ground = m.ground();
    let turn = EulerParameters::from_axis_angle(vec3(1.0, 2.0, -0.5), 0.7);
    let rotor = m.spatial("rotor", SpatialPose::new(zero, turn)).expect("a body");
    let own = m.local_direction(rotor, h).expect("its axis");
    let inertia = [[0.3, 0.02, -0.01], [0.02, 0.4, 0.03], [-0.01, 0.03, 0.5]];
    m.mass(rotor, 2.5, vec3(0.1, -0.2, 0.15), inertia).expect("a mass");
    m.point_mass("tip", of_body(rotor, vec3(0.3, 0.1, 0.4)), 0.7).expect("a point");
    m.add("screw", spatial::cylindrical(rotor, ground, zero, zero, own, h)).expect("a joint");
    let law = Law::sine(0.8, 5.0, 0.2);
    m.add("turn", spatial::drive_turn(rotor, ground, own, h, law)).expect("a driver");
    let along = spatial::drive_slide(rotor, ground, zero, zero, h, Law::sine(0.2, 4.0, 0.1));
    m.add("slide", along).expect("a driver");
    let u = vec3(0.4, 0.1, -0.2);
    let v = vec3(-0.3, 0.5, 0.6);
    m.load("spring", loads::spatial::spring(rotor, ground, u, v, 90.0, 0.3)).expect("a load");
    m.load("coil", loads::spatial::torsion_spring(rotor, ground, own, h, 7.0, 0.2))
        .expect("a load");
    let stiff = vec3(300.0, 200.0, 400.0);
    let turning = vec3(9.0, 8.0, 7.0);
    let none = EulerParameters::identity();
    m.load("bush", loads::spatial::bushing(rotor, ground, u, u, none, stiff, turning))
        .expect("a load");
    let push = Load::force_in_body(rotor, v, vec3(3.0, -2.0, 5.0));
    m.load("push", push.and(Load::torque(rotor, vec3(0.3, 0.2, -0.4)))).expect("a load");
    m.build().expect("a system")
}

#[test]
fn bodies_and_loads_in_space_are_in_the_program() {
    let system = rotor();
    let motion = system.run(linspace(0.0, 1.2, 61)).expect("a motion");
    by_program(&system, &motion);
}

/// A slider-crank on a frame that stands still, moved and back again, and its slider led by hand.
fn press(law: Law) -> System {
    let mut m = Mechanism::new("press");
    m.gravity(vec2(0.0, -9.81));
    let frame = m.planar("frame", pose(0.2, 0.1, 0.3)).expect("a body");
    m.add("floor", fixed(frame, vec2(0.2, 0.1), 0.3)).expect("a joint");
    let crank = m.link("crank", 0.3).expect("a link");
    let rod = m.link("rod", 1.0).expect("a link");
    let ram = m.planar("ram", pose(1.3, 0.0, 0.0)).expect("a body");
    let base = m.local(frame, O).expect("a point");
    m.add("O", revolute(crank, frame, crank.start(), base)).expect("a pin");
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).expect("a pin");
    m.add("B", revolute(rod, ram, rod.end(), O)).expect("a pin");
    m.add("guide", prismatic(ram, m.ground(), O, O, vec2(0.0, 1.0), 0.0)).expect("a guide");
    m.add("motor", drive_angle(crank, law)).expect("a driver");
    for (k, body) in
        [PlanarBody::from(crank), PlanarBody::from(rod), ram, frame].into_iter().enumerate()
    {
        m.mass(body, 1.0 + k as f64, vec2(0.05, 0.02), 0.03).expect("a mass");
    }
    let spring = loads::spring(frame, ram, vec2(0.1, -0.2), vec2(0.0, 0.1), 40.0, 0.5);
    m.load("spring", spring).expect("a load");
    m.build().expect("a system")
}

#[test]
fn coordinates_that_stand_still_are_taken_for_that_alone() {
    // It begins and ends at rest, in one place, and turns in between.
    let there = Law::cycloidal(0.9, 0.8).shifted(0.2);
    let back = Law::cycloidal(-0.9, 0.8).shifted(1.2);
    for law in [Law::linear(0.4, 2.0), Law::constant(0.4) + there + back] {
        let system = press(law);
        let options = SolverOptions::new().engine(Engine::Compiled);
        let motion = system
            .solver()
            .options(options.clone())
            .run(linspace(0.0, 2.4, 481))
            .expect("a motion");
        assert!(
            motion.engine().compiled > 100,
            "{:?} {:?}",
            motion.engine(),
            motion.why_not_compiled()
        );
        by_program(&system, &motion);
    }
}

/// Numbers of a motion do not depend on what was asked before, to the last digit.
#[test]
fn forces_do_not_depend_on_other_motions() {
    let times = |from: f64| linspace(from, from + 1.0, 101);
    let made: [&dyn Fn() -> System; 2] = [&rotor, &|| press(Law::linear(0.4, 2.0))];
    for made in made {
        let before = made();
        let fresh = made();
        let other = before.run(times(0.0)).expect("a motion");
        let _ = before
            .solver()
            .options(SolverOptions::new().engine(Engine::Compiled))
            .forces(&other)
            .expect("forces");
        let [found, due] = [&before, &fresh].map(|system| {
            let motion = system.run(times(0.7)).expect("a motion");
            numbers(
                &system
                    .solver()
                    .options(SolverOptions::new().engine(Engine::Compiled))
                    .forces(&motion)
                    .expect("forces"),
            )
        });
        assert_eq!(found, due);
    }
}

/// A block on a guide, which needs no force at first.
#[test]
fn no_force_at_first_and_large_forces_have_a_program() {
    for push in [0.0, 1e9, 1e-9] {
        let mut m = Mechanism::new("block");
        let block = m.planar("block", pose(0.0, 0.0, 0.5)).expect("a body");
        let h = vec2(0.5_f64.cos(), 0.5_f64.sin());
        m.add("guide", prismatic(block, m.ground(), O, O, vec2(0.0, 1.0), 0.5)).expect("a joint");
        let law = Law::polynomial(&[0.0, 1.0, 0.0, 0.5]);
        m.add("motor", drive_point_along(block, O, h, law)).expect("a driver");
        m.mass(block, 3.0, vec2(0.02, 0.1), 0.4).expect("a mass");
        m.load("push", Load::force(block, vec2(0.1, 0.3), vec2(push, 0.3 * push))).expect("a load");
        let system = m.build().expect("a system");
        let motion = system.run(linspace(0.0, 1.0, 61)).expect("a motion");
        let found = by_program(&system, &motion);
        let effort = &found.iter().find(|one| one.0 == "motor").expect("its effort").1;
        let due = 3.0 * 3.0 - push * (h.x + 0.3 * h.y);
        assert!(
            (effort[60] - due).abs() < 1e-12 * (1.0 + due.abs()),
            "{push}: {} {due}",
            effort[60]
        );
    }
}
