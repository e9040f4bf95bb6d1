//! Mechanical advantage: closed forms, and efforts against a load at the output.

use kin::prelude::*;
use kin::{Error, Load, Mechanism};

use crate::both::Engines;

const ZERO: Vec2 = Vec2::new(0.0, 0.0);

/// A slider-crank in millimetres.
fn press(load: f64) -> (System, PlanarBody) {
    let r = 30.0;
    let l = 100.0;
    let mut m = Mechanism::new("press");
    m.units("mm", "s").mass("t");
    let crank = m.link("crank", r).expect("a link");
    let rod = m.link("rod", l).expect("a link");
    let ram = m.planar("ram", pose(r + l, 0.0, 0.0)).expect("a body");
    m.add("O", revolute(crank, Ground, crank.start(), ZERO)).expect("a pin");
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).expect("a pin");
    m.add("B", revolute(rod, ram, rod.end(), ZERO)).expect("a pin");
    m.add("guide", prismatic(ram, Ground, ZERO, ZERO, vec2(0.0, 1.0), 0.0)).expect("a guide");
    m.add("motor", drive_angle(crank, Law::linear(0.3, 1.5))).expect("a driver");
    m.load("work", Load::force(ram, ZERO, vec2(-load, 0.0))).expect("a load");
    (m.build().expect("a system"), ram)
}

/// dx/dφ of a slider-crank, and the drive's effort against a load: two routes.
#[test]
fn a_slider_crank_gives_force_by_torque() {
    let r = 30.0;
    let l = 100.0;
    let load = 250.0;
    let (system, ram) = press(load);
    let motion = system.run_both(linspace(0.0, 1.7, 35)).expect("a motion");
    let advantage = system.mechanical_advantage(&motion, "motor", ram.x()).expect("an advantage");
    assert_eq!((advantage.name(), advantage.unit()), ("motor.advantage on ram.R_x", "1/mm"));
    let forces = system.forces(&motion).expect("forces");
    let effort = forces.drive("motor").expect("a driver").effort().values().to_vec();
    assert_eq!((advantage.values().len(), effort.len()), (35, 35));
    for ((t, found), effort) in motion.times().iter().zip(advantage.values()).zip(effort) {
        let phi = 0.3 + 1.5 * t;
        let slope =
            -r * phi.sin() * (1.0 + r * phi.cos() / (l * l - (r * phi.sin()).powi(2)).sqrt());
        assert!((found * slope - 1.0).abs() < 1e-12, "{t}: {found} {}", 1.0 / slope);
        assert!((found * effort / load - 1.0).abs() < 1e-11, "{t}: {found} {}", load / effort);
    }
}

/// A toggle press whose knee is pulled across: with both arms at α to the line the advantage is
/// 1 / (2 tan α), whatever the rate of the drive, which stands still at one time.
#[test]
fn a_toggle_press_gives_force_by_force() {
    let arm = 0.4;
    let mut m = Mechanism::new("toggle press");
    let lower = m.link("lower", arm).expect("a link");
    let upper = m.link("upper", arm).expect("a link");
    let ram = m.planar("ram", pose(0.0, 0.75, 0.0)).expect("a body");
    m.add("foot", revolute(lower, Ground, lower.start(), ZERO)).expect("a pin");
    m.add("knee", revolute(lower, upper, lower.end(), upper.start())).expect("a pin");
    m.add("head", revolute(upper, ram, upper.end(), ZERO)).expect("a pin");
    m.add("guide", prismatic(ram, Ground, ZERO, ZERO, vec2(1.0, 0.0), 0.0)).expect("a guide");
    let law = Law::polynomial(&[0.2, 0.0, -0.05]);
    m.add("pull", drive_point_along(lower, lower.end(), vec2(1.0, 0.0), law)).expect("a driver");
    m.prefer(lower, deg(60.0));
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(-1.0, 1.5, 26)).expect("a motion");
    assert!(motion.qd(10).iter().all(|rate| rate.abs() < 1e-12), "it stands still at t = 0");
    let advantage = system.mechanical_advantage(&motion, "pull", "ram.R_y").expect("an advantage");
    assert_eq!((advantage.unit(), advantage.values().len()), ("-", 26));
    for (t, found) in motion.times().iter().zip(advantage.values()) {
        let tan = (0.2 - 0.05 * t * t) / (arm * arm - (0.2 - 0.05 * t * t).powi(2)).sqrt();
        assert!((found * -2.0 * tan - 1.0).abs() < 1e-12, "{t}: {found}");
    }
}

/// Two drives: each alone, the other standing still, though both move. An output that one of them
/// does not move is infinitely strong.
#[test]
fn of_several_drives_the_others_stand_still() {
    let mut m = Mechanism::new("arm");
    let upper = m.link("upper", 0.5).expect("a link");
    let fore = m.link("fore", 0.3).expect("a link");
    m.add("shoulder", revolute(upper, Ground, upper.start(), ZERO)).expect("a pin");
    m.add("elbow", revolute(fore, upper, fore.start(), upper.end())).expect("a pin");
    m.add("motor 1", drive_angle(upper, Law::linear(0.2, 0.7))).expect("a driver");
    m.add("motor 2", drive_relative_angle(fore, upper, Law::linear(0.4, -1.1))).expect("a driver");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 0.5, 6)).expect("a motion");
    for (drive, by) in [("motor 1", true), ("motor 2", false)] {
        let on_turn =
            system.mechanical_advantage(&motion, drive, fore.theta()).expect("an advantage");
        assert_eq!(on_turn.values().len(), 6);
        assert!(on_turn.values().iter().all(|x| (x - 1.0).abs() < 1e-12));
        let on_upper =
            system.mechanical_advantage(&motion, drive, "upper.R_x").expect("an advantage");
        for (t, found) in motion.times().iter().zip(on_upper.values()) {
            let slope = -0.25 * (0.2 + 0.7 * t).sin();
            let expected = if by { 1.0 / slope } else { f64::INFINITY };
            assert!(
                *found == expected || (found / expected - 1.0).abs() < 1e-12,
                "{drive} {t}: {found}"
            );
        }
    }
}

/// A planar mechanism in space is redundant: its advantage is that of the plane.
#[test]
fn of_redundant_mechanisms_too() {
    let mut m = Mechanism::new("press in space");
    let z = vec3(0.0, 0.0, 1.0);
    let r = 0.3;
    let l = 1.0;
    let o = vec3(0.0, 0.0, 0.0);
    let phi: f64 = 0.4;
    let beta = -(r * phi.sin() / l).asin();
    let at = vec3(r * phi.cos(), r * phi.sin(), 0.0);
    let slider = at.x + l * beta.cos();
    let crank = m.spatial("crank", SpatialPose::turned(o, z, phi)).expect("a body");
    let rod = m.spatial("rod", SpatialPose::turned(at, z, beta)).expect("a body");
    let ram = m.spatial("ram", SpatialPose::at(vec3(slider, 0.0, 0.0))).expect("a body");
    m.add("O", spatial::revolute(crank, Ground, o, o, z, z)).expect("a pin");
    m.add("A", spatial::revolute(rod, crank, o, vec3(r, 0.0, 0.0), z, z)).expect("a pin");
    m.add("B", spatial::revolute(ram, rod, o, vec3(l, 0.0, 0.0), z, z)).expect("a pin");
    let x = vec3(1.0, 0.0, 0.0);
    m.add("guide", spatial::prismatic(ram, Ground, o, o, x, EulerParameters::identity()))
        .expect("a guide");
    m.add("motor", spatial::drive_turn(crank, Ground, z, z, Law::linear(phi, 1.0)))
        .expect("a driver");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 1.0, 6)).expect("a motion");
    assert!(system.n_equations() > system.n_coordinates());
    let advantage = system.mechanical_advantage(&motion, "motor", "ram.R_x").expect("an advantage");
    assert_eq!(advantage.values().len(), 6);
    for (t, found) in motion.times().iter().zip(advantage.values()) {
        let phi = phi + t;
        let slope =
            -r * phi.sin() * (1.0 + r * phi.cos() / (l * l - (r * phi.sin()).powi(2)).sqrt());
        assert!((found * slope - 1.0).abs() < 1e-9, "{t}: {found} {}", 1.0 / slope);
    }
}

#[test]
fn mistakes_are_told_by_name() {
    let (system, ram) = press(1.0);
    let motion = system.run_both([0.0, 0.1]).expect("a motion");
    let told = |drive: &str, output: &str| {
        system.mechanical_advantage(&motion, drive, output).expect_err("a mistake").to_string()
    };
    assert!(
        told("A", "ram.R_x").contains("there is no driver `A`")
            && told("A", "ram.R_x").contains("motor")
    );
    assert!(told("motor", "ram.z").contains("ram.z"));
    let mut m = Mechanism::new("platform");
    let plate = m.planar("plate", pose(0.0, 0.0, 0.0)).expect("a body");
    let laws = [Law::ramp(1.0), Law::ramp(0.5)];
    let [x, y] = laws;
    m.add("point", moving_point(Ground, plate, x, y, ZERO)).expect("a driver");
    m.add("turn", drive_angle(plate, Law::ramp(0.1))).expect("a driver");
    let two = m.build().expect("a system");
    let motion = two.run_both([0.0, 0.1]).expect("a motion");
    match two.mechanical_advantage(&motion, "point", plate.x()) {
        Err(Error::InvalidParameters { constraint, reason, .. }) => {
            assert!(constraint == "point" && reason.contains("2 numbers"), "{reason}");
        }
        other => panic!("{other:?}"),
    }
    assert!(
        system.mechanical_advantage(&motion, "motor", ram.x()).is_err(),
        "another system's motion"
    );
}

/// Other dimensions make another mechanism: neither its forces nor its advantage are those of an
/// old motion.
#[test]
fn a_motion_of_other_dimensions_is_refused() {
    let (mut system, ram) = press(250.0);
    let motion = system.run_both([0.0, 0.1]).expect("a motion");
    system.set("B.u_i.x", 45.0).expect("a parameter");
    for told in [
        system.forces(&motion).map(drop),
        system.mechanical_advantage(&motion, "motor", ram.x()).map(drop),
    ] {
        assert!(matches!(told, Err(Error::OtherMotion(_))), "{told:?}");
    }
}

/// At its dead centres a ram is infinitely strong, along whichever axis and however the crank
/// turns.
#[test]
fn at_dead_centres_of_the_output_the_advantage_is_infinite() {
    let mut m = Mechanism::new("shaft");
    let ground = PlanarBody::from(m.ground());
    for (name, rate) in [("left", 1.0), ("right", -1.0)] {
        let shaft = m.planar(name, pose(0.0, 0.0, 0.0)).expect("a body");
        m.add(&format!("{name} pin"), revolute(shaft, ground, ZERO, ZERO)).expect("a pin");
        m.add(&format!("{name} motor"), drive_angle(shaft, Law::ramp(rate))).expect("a driver");
        let pan = m.planar(&format!("{name} pan"), pose(0.5, 0.0, 0.0)).expect("a body");
        m.add(&format!("{name} end"), revolute(pan, shaft, ZERO, vec2(0.5, 0.0))).expect("a pin");
        m.add(&format!("{name} level"), drive_angle(pan, Law::constant(0.0))).expect("a driver");
    }
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 1.0]).expect("a motion");
    for side in ["left", "right"] {
        for output in ["x", "theta", "other"] {
            let name = match (output, side) {
                ("x", _) => format!("{side} pan.R_x"),
                ("theta", _) => format!("{side} pan.theta"),
                (_, "left") => "right pan.R_y".to_string(),
                _ => "left pan.R_y".to_string(),
            };
            let found = system.mechanical_advantage(&motion, &format!("{side} motor"), &name);
            assert_eq!(found.expect("an advantage").values()[0], f64::INFINITY, "{side} {name}");
        }
    }
}

/// A measure that changes by itself: its own rate is nobody's advantage.
#[test]
fn what_time_itself_makes_of_an_output_does_not_count() {
    /// A point on a belt that runs away: x − 3 t.      [m]
    #[constraint]
    #[measure(ahead = i.point(u).x - 3.0 * t, "m")]
    fn on_rail(i: Planar, u: Vec2, t: Time) -> f64 {
        i.point(u).y
    }
    let mut m = Mechanism::new("belt");
    let body = m.planar("body", pose(0.0, 0.0, 0.0)).expect("a body");
    m.add("rail", on_rail(body, ZERO)).expect("a joint");
    m.add("jack", drive(body.x(), Law::ramp(2.0))).expect("a driver");
    m.add("level", drive_angle(body, Law::ramp(0.3))).expect("a driver");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 1.0]).expect("a motion");
    for (drive, due) in [("jack", 1.0), ("level", f64::INFINITY)] {
        let found =
            system.mechanical_advantage(&motion, drive, "rail.ahead").expect("an advantage");
        assert_eq!(found.values(), [due, due], "{drive}");
    }
}

/// Two jacks for one slide: neither moves it alone, in whatever unit of length.
#[test]
fn a_drive_that_another_one_holds_has_no_advantage() {
    for scale in [1.0, 1e9, 1e-9] {
        let mut m = Mechanism::new("twins");
        let ground = PlanarBody::from(m.ground());
        let slide = m.planar("slide", pose(0.0, 0.0, 0.0)).expect("a body");
        m.add("guide", prismatic(slide, ground, ZERO, ZERO, vec2(0.0, scale), 0.0))
            .expect("a joint");
        m.add("jack 1", drive(slide.x(), Law::ramp(scale))).expect("a driver");
        m.add("jack 2", drive_slide(slide, ground, ZERO, ZERO, vec2(1.0, 0.0), Law::ramp(scale)))
            .expect("a driver");
        let shaft = m.planar("shaft", pose(3.0 * scale, 0.0, 0.0)).expect("a body");
        m.add("bearing", revolute(shaft, ground, ZERO, vec2(3.0 * scale, 0.0))).expect("a joint");
        m.add("motor", drive_angle(shaft, Law::ramp(1.0))).expect("a driver");
        let system = m.build().expect("a system");
        let motion = system.run_both([0.0, 0.5]).expect("a motion");
        for jack in ["jack 1", "jack 2"] {
            match system.mechanical_advantage(&motion, jack, slide.x()) {
                Err(Error::InvalidParameters { constraint, reason, .. }) => {
                    assert!(constraint == jack && reason.contains("cannot move alone"), "{reason}");
                }
                other => panic!("{scale}, {jack}: {other:?}"),
            }
        }
        let alone =
            system.mechanical_advantage(&motion, "motor", shaft.theta()).expect("an advantage");
        assert!(alone.values().iter().all(|x| (x - 1.0).abs() < 1e-12), "{scale}");
    }
}
