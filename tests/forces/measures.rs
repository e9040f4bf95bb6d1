//! Forces along measures of joints by their names: against closed forms, and against the same force
//! along a length of the library or of one's own.

use kin::SolverOptions;
use kin::forces::Forces;
use kin::prelude::*;
use kin::{Error, Load, Mechanism, loads};

use crate::both::Engines;

const O: Vec2 = Vec2::new(0.0, 0.0);
const ORIGIN: Vec3 = Vec3::new(0.0, 0.0, 0.0);

/// A block on a guide that is turned by half a radian and that a motor pushes along.
fn block(law: Law) -> (Mechanism, PlanarBody) {
    let mut m = Mechanism::new("block");
    let block = m.planar("block", pose(0.0, 0.0, 0.5)).expect("a body");
    let h = vec2(0.5_f64.cos(), 0.5_f64.sin());
    m.add("guide", prismatic(block, m.ground(), O, vec2(0.1, 0.2), vec2(0.0, 1.0), 0.5))
        .expect("a joint");
    m.add("motor", drive_point_along(block, O, h, law)).expect("a driver");
    m.mass(block, 3.0, vec2(0.02, 0.1), 0.4).expect("a mass");
    (m, block)
}

/// The largest difference of two lists, which must have the same length.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter()
        .zip(b)
        .fold(0.0, |most: f64, (a, b)| if (a - b).abs() <= most { most } else { (a - b).abs() })
}

fn efforts(forces: &Forces<'_>, name: &str) -> Vec<f64> {
    forces.drive(name).expect("a driver").effort().values().to_vec()
}

#[test]
fn a_spring_and_damper_along_a_slide_is_what_its_motor_holds_against() {
    let law = Law::constant(0.8) + Law::sine(0.3, 2.0, 0.4);
    let (mut m, body) = block(law.clone());
    m.load("buffer", loads::spring_damper("guide.slide", 70.0, 0.2, 5.0)).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 3.0, 61)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    // The guide begins at P_j = (0.1, 0.2), the law counts from the global origin along the same
    // direction.
    let begin = 0.1 * 0.5_f64.cos() + 0.2 * 0.5_f64.sin();
    let at = |t: &f64| {
        let [x, v, a, _] = law.jet(*t);
        3.0 * a + 70.0 * (x - begin - 0.2) + 5.0 * v
    };
    let exact: Vec<f64> = motion.times().iter().map(at).collect();
    let off = apart(&efforts(&forces, "motor"), &exact);
    println!("off by {off:.1e}");
    assert!(off < 1e-12 && forces.balance().worst() < 1e-12, "{off:e} {}", forces.balance());
    let pushed = forces
        .load("buffer")
        .expect("a load")
        .on(body)
        .expect("its body")
        .magnitude()
        .expect("unique");
    assert!(pushed.max() > 10.0);
}

#[test]
fn the_same_force_along_a_measure_and_along_a_length_of_the_library() {
    let push = |x: f64, v: f64, t: f64| -80.0 * (x - 0.4) - 12.0 * v * v.abs() + 3.0 * t;
    let run = |by_name: bool| {
        let (mut m, body) = block(Law::constant(0.8) + Law::sine(0.3, 2.0, 0.4));
        let load = match by_name {
            true => Load::along("guide.slide", push),
            // The slide of the joint is that of P_i along h_i, which is fixed in both bodies.
            false => {
                let h = vec2(0.5_f64.cos(), 0.5_f64.sin());
                Load::along(loads::slide(body, m.ground(), O, vec2(0.1, 0.2), h), push)
            }
        };
        m.load("load", load).expect("a load");
        let system = m.build().expect("a system");
        let motion = system.run_both(linspace(0.0, 3.0, 31)).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        assert!(forces.balance().worst() < 1e-12, "{}", forces.balance());
        efforts(&forces, "motor")
    };
    let off = apart(&run(true), &run(false));
    assert!(off < 1e-12, "{off:e}");
}

/// A rotor on a spatial hinge, whose angle has a cut at half a turn, over five turns either way.
#[test]
fn a_torsion_spring_counts_the_turns_of_its_joint() {
    for speed in [2.0, -2.0] {
        let mut m = Mechanism::new("winch");
        let drum = m.spatial("drum", SpatialPose::at(ORIGIN)).expect("a body");
        let h = vec3(0.0, 0.6, 0.8);
        let ground = m.ground();
        m.add("hinge", spatial::revolute(drum, ground, ORIGIN, ORIGIN, h, h)).expect("a joint");
        let law = Law::constant(0.3) + Law::ramp(speed) + Law::sine(0.2, 3.0, 0.0);
        m.add("motor", spatial::drive_turn(drum, ground, h, h, law.clone())).expect("a driver");
        m.load("spring", loads::spring_damper("hinge.angle", 7.0, 0.2, 1.5)).expect("a load");
        let system = m.build().expect("a system");
        let motion = system.run(linspace(0.0, 15.7, 158)).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        let at = |t: &f64| 7.0 * (law.at(*t) - 0.2) + 1.5 * law.jet(*t)[1];
        let exact: Vec<f64> = motion.times().iter().map(at).collect();
        let off = apart(&efforts(&forces, "motor"), &exact);
        println!("{speed}: off by {off:.1e}");
        assert!(off < 1e-11 && forces.balance().worst() < 1e-11, "{off:e} {}", forces.balance());
        // A crossing is found between the times, where the turns are counted on.
        let crossings =
            forces.drive("motor").expect("a driver").effort().crossings(100.0 * speed.signum());
        assert_eq!(crossings.len(), 1, "{crossings:?}");
        // Backwards in time turns count from where the run begins.
        let back: Vec<f64> = motion.times().iter().rev().copied().collect();
        let motion = system.run(&back).expect("a motion");
        let found = efforts(&system.forces(&motion).expect("forces"), "motor");
        let a_turn = 7.0 * TAU;
        let turns = ((found[0] - exact[157]) / a_turn).round();
        let exact: Vec<f64> = exact.iter().rev().map(|x| x + a_turn * turns).collect();
        assert!(apart(&found, &exact) < 1e-11, "{speed}: {found:?} {exact:?}");
    }
}

/// A hinge in the plane, with a stop that pushes from an angle on.
#[test]
fn a_force_of_ones_own_along_the_angle_of_a_pin() {
    /// A stop with play: nothing up to an angle, then a spring.      [N m]
    #[force]
    fn stop(x: Coord, stiffness: f64, from: f64) -> f64 {
        -stiffness * (x - from).max(0.0)
    }
    let mut m = Mechanism::new("flap");
    let frame = m.link("frame", 1.0).expect("a body");
    let flap = m.link("flap", 0.5).expect("a body");
    m.add("wall", fixed(frame, vec2(0.3, 0.0), 0.4)).expect("a joint");
    m.add("pin", revolute(flap, frame, flap.start(), frame.end())).expect("a joint");
    m.add("motor", drive_relative_angle(flap, frame, Law::ramp(1.0))).expect("a driver");
    m.load("stop", stop("pin.angle", 40.0, 0.5)).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 1.5, 16)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let exact: Vec<f64> = motion.times().iter().map(|t| 40.0 * (t - 0.5).max(0.0)).collect();
    assert!(apart(&efforts(&forces, "motor"), &exact) < 1e-12);
    let on = |body| {
        forces.load("stop").expect("a load").on(body).expect("its body").torque().expect("unique")
    };
    let flap = on(PlanarBody::from(flap));
    let frame = on(PlanarBody::from(frame));
    assert!(apart(&flap, &frame.iter().map(|t| -t).collect::<Vec<f64>>()) < 1e-12);
    assert!((flap[15] + 40.0).abs() < 1e-12);
}

#[test]
fn a_coordinate_by_its_name_is_that_coordinate_in_a_program_too() {
    let of = |named: bool, engine| {
        let mut m = Mechanism::new("arm");
        let arm = m.link("arm", 0.5).expect("a body");
        m.mass(arm, 1.2, vec2(0.1, 0.0), 0.03).expect("a mass");
        m.gravity(vec2(0.0, -9.81));
        m.add("O", revolute(m.ground(), arm, O, arm.start())).expect("a joint");
        m.add("motor", drive_angle(arm, Law::sine(0.8, 2.0, 0.0))).expect("a driver");
        let load = match named {
            true => loads::spring_damper("arm.theta", 7.0, 0.2, 1.5),
            false => loads::spring_damper(loads::along(arm.theta()), 7.0, 0.2, 1.5),
        };
        m.load("spring", load).expect("a load");
        let system = m.build().expect("a system");
        let motion = system.run(linspace(0.0, 3.0, 61)).expect("a motion");
        let forces = system
            .solver()
            .options(SolverOptions::new().engine(engine))
            .forces(&motion)
            .expect("forces");
        assert_eq!(forces.engine().compiled > 0, engine == kin::Engine::Compiled);
        let on =
            forces.load("spring").expect("a load").on(PlanarBody::from(arm)).expect("its body");
        assert!((on.torque().expect("unique")[0] + 7.0 * -0.2 + 1.5 * 1.6).abs() < 1e-12);
        efforts(&forces, "motor")
    };
    for engine in [kin::Engine::StepByStep, kin::Engine::Compiled] {
        assert!(apart(&of(true, engine), &of(false, engine)) < 1e-13);
    }
}

#[test]
fn a_measure_follows_the_numbers_of_its_joint_in_a_sweep() {
    let (mut m, _) = block(Law::constant(0.8));
    m.load("buffer", loads::spring_damper("guide.slide", 70.0, 0.2, 5.0)).expect("a load");
    let system = m.build().expect("a system");
    let cases = [[0.1], [0.3]];
    let sweep = system.sweep(["guide.u_j.x"]).expect("a sweep");
    let found =
        sweep.forces(&cases, [0.0, 1.0], |_, forces| efforts(&forces.expect("forces"), "motor")[1]);
    let found = found.expect("all");
    for ([x], effort) in cases.iter().zip(found) {
        let exact = 70.0 * (0.8 - x * 0.5_f64.cos() - 0.2 * 0.5_f64.sin() - 0.2);
        assert!((effort - exact).abs() < 1e-11, "{x}: {effort} {exact}");
    }
}

#[test]
fn a_force_along_a_measure_comes_back_from_a_file() {
    let (mut m, _) = block(Law::constant(0.8) + Law::sine(0.3, 2.0, 0.4));
    m.load("buffer", loads::spring_damper("guide.slide", 70.0, 0.2, 5.0)).expect("a load");
    let data = m.data().expect("data");
    let text = serde_json::to_string(&data).expect("writes");
    assert!(text.contains(r#""x":{"measure":"guide.slide"}"#), "{text}");
    let read = serde_json::from_str(&text).expect("reads");
    assert_eq!(data, read);
    let again = Mechanism::from_data(&read, &kin_text::registry()).expect("the same");
    let effort = |m: Mechanism| {
        let system = m.build().expect("a system");
        let motion = system.run(linspace(0.0, 3.0, 7)).expect("a motion");
        efforts(&system.forces(&motion).expect("forces"), "motor")
    };
    assert_eq!(effort(m), effort(again));
    let wrong = text
        .replace(r#"{"measure":"guide.slide"}"#, r#"{"measure":"guide.slide","kind":"length"}"#);
    let told =
        serde_json::from_str::<kin::data::MechanismData>(&wrong).err().map(|e| e.to_string());
    assert!(told.as_deref().unwrap_or_default().contains("there is no key `kind`"), "{told:?}");
}

#[test]
fn names_that_no_measure_has_are_told_with_those_there_are() {
    let told = |name: &str| {
        let (mut m, _) = block(Law::constant(0.8));
        m.load("buffer", loads::viscous(name, 5.0)).expect("a load");
        match m.build() {
            Err(error @ Error::InvalidParameters { .. }) => error.to_string(),
            other => panic!("{other:?}"),
        }
    };
    let slid = told("guide.slid");
    assert!(slid.contains("`buffer` (load): the load acts along `guide.slid`"), "{slid}");
    assert!(slid.contains("This joint has the measures `guide.slide`"), "{slid}");
    assert!(told("motor.angle").contains("has no measure"), "{}", told("motor.angle"));
    assert!(told("lid.angle").contains("guide.slide"), "{}", told("lid.angle"));
    assert!(told("").contains("the load acts along ``"));
}

/// Between the times of a coarse grid, where a step is more than half a turn, turns are counted
/// from the nearer end. A length is not counted at all.
#[test]
fn forces_between_coarse_times_follow_turns_and_lengths() {
    let mut m = Mechanism::new("winch");
    let drum = m.spatial("drum", SpatialPose::at(ORIGIN)).expect("a body");
    let h = vec3(0.0, 0.6, 0.8);
    let ground = m.ground();
    m.add("sleeve", spatial::cylindrical(drum, ground, ORIGIN, ORIGIN, h, h)).expect("a joint");
    m.add("motor", spatial::drive_turn(drum, ground, h, h, Law::ramp(1.0))).expect("a driver");
    let along = spatial::drive_slide(drum, ground, ORIGIN, ORIGIN, h, Law::ramp(3.0));
    m.add("rack", along).expect("a driver");
    m.load("coil", loads::spring_damper("sleeve.angle", 7.0, 0.0, 0.0)).expect("a load");
    m.load("spring", loads::spring_damper("sleeve.slide", 3.0, 0.0, 0.0)).expect("a load");
    let system = m.build().expect("a system");
    for times in [linspace(0.0, 40.0, 11), linspace(0.0, 40.0, 11).into_iter().rev().collect()] {
        let motion = system.run(times).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        let first = system.measure(&motion, "sleeve.angle").expect("a measure").value.values()[0];
        // Backwards in time turns count from where the run begins.
        let turns = first - motion.times()[0];
        for at in [1.0, 3.0, 13.5, 22.9, 37.2] {
            let level = [("motor", 7.0 * (at + turns)), ("rack", 9.0 * at)];
            for (name, level) in level {
                let found = forces.drive(name).expect("a driver").effort().crossings(level);
                assert_eq!(found.len(), 1, "{name} at {at}: {found:?}");
                assert!((found[0].t - at).abs() < 1e-9, "{name} at {at}: {found:?}");
            }
        }
    }
}

/// A measure that changes by itself: its damper takes its whole rate, and pushes the body along it.
#[test]
fn a_damper_along_a_measure_of_time() {
    /// A rail, and how far the body is ahead of a belt that runs at 3 m/s.      [m]
    #[constraint]
    #[measure(ahead = i.point(u).x - 3.0 * t, "m")]
    fn on_rail(i: Planar, u: Vec2, t: Time) -> f64 {
        i.point(u).y
    }
    let mut m = Mechanism::new("belt");
    let body = m.planar("body", pose(0.0, 0.0, 0.0)).expect("a body");
    m.add("rail", on_rail(body, O)).expect("a joint");
    m.add("jack", drive(body.x(), Law::ramp(2.0))).expect("a driver");
    m.add("level", drive_angle(body, Law::ramp(0.3))).expect("a driver");
    m.load("belt", loads::viscous("rail.ahead", 4.0)).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 1.0]).expect("a motion");
    let found = efforts(&system.forces(&motion).expect("forces"), "jack");
    assert!(apart(&found, &[-4.0, -4.0]) < 1e-12, "{found:?}");
}

/// Dampers between a body that slides and turns and points of the ground off its origin.
#[test]
fn dampers_against_the_ground_in_space_take_rates_of_the_body_alone() {
    let damper = |along: bool| {
        let mut m = Mechanism::new("sleeve");
        let body = m.spatial("body", SpatialPose::at(ORIGIN)).expect("a body");
        let h = vec3(0.0, 0.6, 0.8);
        let ground = m.ground();
        let far = vec3(0.3, 1.2, 1.6);
        m.add("sleeve", spatial::cylindrical(body, ground, ORIGIN, far, h, h)).expect("a joint");
        m.add("turn", spatial::drive_turn(body, ground, h, h, Law::ramp(2.0))).expect("a driver");
        let law = Law::constant(0.4) + Law::ramp(0.7);
        m.add("rack", spatial::drive_slide(body, ground, ORIGIN, far, h, law)).expect("a driver");
        let load = match along {
            true => loads::viscous("sleeve.slide", 5.0),
            false => loads::viscous(loads::spatial::slide(body, ground, ORIGIN, far, h), 5.0),
        };
        m.load("damper", load).expect("a load");
        let system = m.build().expect("a system");
        let motion = system.run(linspace(0.0, 1.0, 11)).expect("a motion");
        efforts(
            &system
                .solver()
                .options(SolverOptions::new().engine(kin::Engine::StepByStep))
                .forces(&motion)
                .expect("forces"),
            "rack",
        )
    };
    for along in [true, false] {
        assert!(apart(&damper(along), &[3.5; 11]) < 1e-12, "{along}: {:?}", damper(along));
    }
}
