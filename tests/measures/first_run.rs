//! Warnings of a first run: each usual slip is reported, and what is right is not.

use kin::error::FailureKind;
use kin::prelude::*;
use kin::results::{Warning, WarningKind};
use kin::{Follow, SolverOptions};

use crate::engines::Engines;

/// A crank on the ground with a driver of its angle.
fn driven_crank(law: Law) -> Mechanism {
    let mut m = Mechanism::new("crank");
    let crank = m.link("crank", 1.0).unwrap();
    m.add("O", revolute(crank, Ground, crank.start(), vec2(0.0, 0.0))).unwrap();
    m.add("motor", drive_angle(crank, law)).unwrap();
    m
}

fn four_bar(law: Law) -> Mechanism {
    let mut m = Mechanism::new("four-bar");
    let crank = m.link("crank", 1.0).unwrap();
    let coupler = m.link("coupler", 3.5).unwrap();
    let rocker = m.link("rocker", 3.0).unwrap();
    m.add("O", revolute(crank, Ground, crank.start(), vec2(0.0, 0.0))).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(rocker, Ground, rocker.start(), vec2(4.0, 0.0))).unwrap();
    m.add("motor", drive_angle(crank, law)).unwrap();
    m
}

/// A cart on a line, whose position follows the law.
fn cart(law: Law) -> Mechanism {
    let mut m = Mechanism::new("cart");
    let cart = m.planar("cart", pose(0.0, 0.0, 0.0)).unwrap();
    let across = vec2(0.0, 1.0);
    m.add("guide", prismatic(cart, Ground, vec2(0.0, 0.0), vec2(0.0, 0.0), across, 0.0)).unwrap();
    m.add("push", drive(cart.x(), law)).unwrap();
    m
}

/// A spatial body that turns about z.
fn shaft(law: Law) -> Mechanism {
    let mut m = Mechanism::new("shaft");
    let o = vec3(0.0, 0.0, 0.0);
    let z = vec3(0.0, 0.0, 1.0);
    let shaft = m.spatial("shaft", SpatialPose::at(o)).unwrap();
    m.add("bearing", spatial::revolute(shaft, m.ground(), o, o, z, z)).unwrap();
    m.add("motor", drivers::drive_turn(shaft, m.ground(), z, z, law)).unwrap();
    m
}

mod drivers {
    pub use kin::joints::drivers::spatial::drive_turn;
}

fn warned(m: Mechanism) -> Vec<Warning> {
    warned_at(m, &linspace(0.0, 1.0, 11))
}

fn warned_at(m: Mechanism, times: &[f64]) -> Vec<Warning> {
    let motion = m.build().unwrap().run_both(times).unwrap();
    let text = motion.summary();
    for warning in motion.warnings() {
        assert!(text.contains(&format!("\n  warning: {warning}")), "{text}");
    }
    assert_eq!(text.contains("warning"), !motion.warnings().is_empty(), "{text}");
    motion.warnings().to_vec()
}

/// The only warning.
fn only(m: Mechanism) -> Warning {
    let found = warned(m);
    let [one] = &found[..] else { panic!("{found:?}") };
    one.clone()
}

#[test]
fn speeds_in_degrees_are_asked_about() {
    let found = only(driven_crank(Law::ramp(360.0)));
    assert_eq!(
        (found.kind, &found.names[..]),
        (WarningKind::Degrees, &["motor", "crank"].map(String::from)[..])
    );
    assert_eq!(
        found.text,
        "`motor` turns `crank` at 360 rad/s (57 turns/s): the law of the driver is `Law::ramp(360.0)`. Angles are \
         in radians; if degrees are meant, give `Law::ramp(TAU)`."
    );
    let found = only(four_bar(Law::linear(0.0, -90.0)));
    assert_eq!(
        found.text,
        "`motor` turns `crank` at -90 rad/s (14 turns/s): `motor.law.rate` is -90. Angles are in \
         radians; if degrees are meant, give `deg(-90.0)`."
    );
    for law in [Law::ramp(180.0), -Law::ramp(720.0), Law::constant(1.0) + Law::ramp(45.0)] {
        for m in [driven_crank(law.clone()), shaft(law)] {
            assert_eq!(only(m).kind, WarningKind::Degrees);
        }
    }
}

#[test]
fn usual_speeds_in_radians_are_not_asked_about() {
    let speeds = [1.0, 10.0, 30.0, 50.0, 60.0, 100.0, 120.0, 150.0, 300.0, 314.16, 500.0, 1000.0];
    for speed in speeds.into_iter().chain([TAU, 10.0 * PI, 100.0 * PI, 90.5, 3000.0 * TAU / 60.0]) {
        for law in [Law::ramp(speed), Law::linear(0.3, -speed)] {
            assert_eq!(warned(driven_crank(law.clone())), [], "{speed}");
            assert_eq!(warned(shaft(law)), [], "{speed}");
        }
    }
    // A speed of a length, and a ratio between two angles, are no angles a second.
    assert_eq!(warned(cart(Law::ramp(360.0))), []);
    assert_eq!(warned(cart(Law::constant(90.0) + Law::sine(45.0, TAU, 0.0))), []);
}

#[test]
fn angles_in_degrees_are_asked_about() {
    let table = [(0.0, 30.0), (0.5, 60.0), (1.0, 45.0)];
    for law in [
        Law::constant(90.0),
        Law::linear(90.0, 1.0),
        Law::sine(45.0, TAU, 0.0),
        Law::constant(1.0) + Law::sine(-30.0, TAU, 0.0),
        Law::sine(0.3, TAU, 90.0),
        Law::harmonic(60.0, 0.2),
        Law::fourier(0.1, 1.0, &[(30.0, 0.0)]),
        Law::spline(&table, Ends::Natural),
        Law::spline(&table, Ends::Natural).shifted(0.0),
        Law::sequence(0.0, [(1.0, Law::cycloidal(90.0, 1.0))]),
    ] {
        for m in [driven_crank(law.clone()), four_bar(law.clone()), shaft(law.clone())] {
            let name = m.name().to_string();
            let found = warned(m);
            let [found] = &found[..] else { panic!("{name} {law:?}: {found:?}") };
            assert_eq!(found.kind, WarningKind::Degrees, "{name} {law:?}");
            assert!(found.names.contains(&"motor".to_string()), "{found:?}");
            let expected = "Angles are in radians; if degrees are meant, give `";
            assert!(found.text.ends_with("`.") && found.text.contains(expected), "{found}");
        }
    }
    // The phase of a sine is an angle whatever it drives.
    let found = only(cart(Law::sine(0.1, TAU, 90.0)));
    assert!(found.text.contains("`push.law.phase` is 90") && found.text.contains("`deg(90.0)`"));
    let found = only(cart(Law::sine(0.1, 360.0, 0.0)));
    assert!(found.text.contains("57 periods/s") && found.text.contains("`TAU`"), "{found}");
}

#[test]
fn angles_in_radians_and_scaled_degrees_are_not_asked_about() {
    let table = [(0.0, 30.0), (0.5, 60.0), (1.0, 45.0)];
    for law in [
        deg(1.0) * Law::spline(&table, Ends::Natural),
        Law::constant(deg(90.0)),
        Law::linear(deg(45.0), TAU),
        Law::sine(deg(30.0), TAU, deg(90.0)),
        Law::linear(600.0 * PI, 1.0),
        Law::linear(1.0, 30.0),
    ] {
        for m in [driven_crank(law.clone()), four_bar(law.clone()), shaft(law.clone())] {
            assert_eq!(warned(m), [], "{law:?}");
        }
    }
}

/// The slip in the guess, in what is preferred, in a limit, and in a number of a joint.
#[test]
fn guesses_preferences_limits_and_joints_in_degrees_are_asked_about() {
    let mut m = Mechanism::new("plate");
    let plate = m.planar("plate", pose(1.0, 0.5, 90.0)).unwrap();
    m.add("O", revolute(plate, Ground, vec2(0.0, 0.0), vec2(1.0, 0.5))).unwrap();
    m.add("motor", drive_angle(plate, Law::ramp(1.0))).unwrap();
    let found = only(m);
    assert_eq!(
        found.text,
        "The guess of `plate.theta` is 90 rad (14 turns). Angles are in radians; if degrees are meant, give \
         `deg(90.0)`."
    );
    let mut m = four_bar(Law::ramp(TAU));
    m.limit("C.angle", deg(30.0), 150.0).unwrap();
    m.limit("crank.R_x", -90.0, 90.0).unwrap();
    let found = only(m);
    assert_eq!(found.names, ["C.angle"]);
    assert!(found.text.starts_with("A limit of `C.angle` is 150 rad (24 turns)."), "{found}");
    let mut m = four_bar(Law::ramp(TAU));
    m.prefer("C.angle", 45.0);
    assert!(only(m).text.starts_with("The preferred value of `C.angle` is 45 rad (7.2 turns)."));
    let mut m = four_bar(Law::ramp(TAU));
    m.prefer("rocker.theta", 45.0);
    let found = warned(m);
    assert!(found[0].text.starts_with("The preferred value of `rocker.theta` is 45 rad"));
    // A number of a joint: added to an angle, added to one times a radius.
    let mut m = driven_crank(Law::ramp(1.0));
    let hand = m.planar("hand", pose(0.1, 0.0, deg(60.0))).unwrap();
    m.add("weld", weld(hand, Ground, vec2(0.0, 0.0), vec2(90.0, 30.0), 60.0)).unwrap();
    let found = warned(m);
    assert_eq!(found[0].names, ["weld", "weld.theta0"]);
    assert!(found[0].text.starts_with("`weld.theta0` is 60 rad (9.5 turns)."), "{found:?}");
    let mut m = driven_crank(Law::ramp(1.0));
    let [small, large] = [0.0, 0.3].map(|x| {
        let wheel = m.planar(&format!("wheel at {x}"), pose(x, 0.0, 0.0)).unwrap();
        m.add(&format!("pin at {x}"), revolute(wheel, Ground, vec2(0.0, 0.0), vec2(x, 0.0)))
            .unwrap();
        wheel
    });
    m.add("second motor", drive_angle(small, Law::ramp(1.0))).unwrap();
    m.add("mesh", gear(small, large, Ground, 0.1, 0.2, 90.0)).unwrap();
    let found = warned(m);
    assert_eq!(found[0].names, ["mesh", "mesh.phase"], "{found:?}");
}

#[test]
fn what_is_usual_in_guesses_and_limits_is_not_asked_about() {
    let mut m = four_bar(Law::ramp(TAU));
    m.limit("C.angle", deg(75.0), deg(150.0)).unwrap();
    m.limit("A.angle", -20.0 * TAU, 100.0).unwrap();
    m.limit("crank.R_y", -15.0, 15.0).unwrap();
    m.prefer("rocker.theta", deg(100.0));
    assert_eq!(warned(m), []);
    // Lengths may be any number: here in millimetres.
    let mut m = Mechanism::new("slider-crank");
    let crank = m.link("crank", 45.0).unwrap();
    let rod = m.link("rod", 150.0).unwrap();
    m.add("O", revolute(crank, Ground, crank.start(), vec2(30.0, 60.0))).unwrap();
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).unwrap();
    m.add("slide", point_on_line(rod, Ground, rod.end(), vec2(30.0, 60.0), vec2(15.0, 0.0)))
        .unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(TAU))).unwrap();
    assert_eq!(warned(m), []);
    // Teeth, radii and ratios are no angles.
    let mut m = driven_crank(Law::ramp(TAU));
    let [small, large] = [0.0, 90.0].map(|x| {
        let wheel = m.planar(&format!("wheel at {x}"), pose(x, 0.0, 0.0)).unwrap();
        m.add(&format!("pin at {x}"), revolute(wheel, Ground, vec2(0.0, 0.0), vec2(x, 0.0)))
            .unwrap();
        wheel
    });
    m.add("second motor", drive_angle(small, Law::ramp(TAU))).unwrap();
    m.add("mesh", gear(small, large, Ground, 30.0, 60.0, deg(15.0))).unwrap();
    let pinion = m.angle("pinion", 0.0).unwrap();
    m.add("belt", linear_coupling([small.theta(), pinion], [15.0, 45.0], 0.0)).unwrap();
    assert_eq!(warned(m), []);
}

/// A shaft that has turned for a while begins far from its guess, and that is no slip.
#[test]
fn a_run_that_begins_later_is_not_asked_about_its_turns() {
    for law in [Law::ramp(10.0), Law::linear(0.5, 7.3)] {
        for m in [driven_crank(law.clone()), four_bar(law.clone()), shaft(law)] {
            assert_eq!(warned_at(m, &linspace(11.0, 12.0, 11)), []);
        }
    }
    // 98.6 rad from the beginning on is not explained by turns.
    for m in [driven_crank(Law::linear(98.6, 1.0)), shaft(Law::linear(98.6, 1.0))] {
        let found = warned_at(m, &linspace(11.0, 12.0, 11));
        assert!(found.len() == 1 && found[0].kind == WarningKind::Degrees, "{found:?}");
    }
}

/// A pose of a later time, and a motion that was measured, were not assembled from a guess.
#[test]
fn only_the_begin_of_a_run_is_far_from_its_guess() {
    let mut m = Mechanism::new("plate");
    let plate = m.planar("plate", pose(1.0, 0.0, 0.0)).unwrap();
    m.add("O", revolute(plate, Ground, vec2(1.0, 0.0), vec2(0.0, 0.0))).unwrap();
    m.add("motor", drive_angle(plate, Law::ramp(PI))).unwrap();
    let system = m.build().unwrap();
    let motion = system.run(linspace(0.0, 1.0, 11)).unwrap();
    let kinds: Vec<_> = motion.warnings().iter().map(|warning| warning.kind).collect();
    assert_eq!(kinds, [WarningKind::FarFromDrawn]);
    assert_eq!(motion.displaced().len(), 1);
    assert!(motion.warnings()[0].text.contains("`m.local(plate, point)`"));
    let at = system.at(&motion, 0.5).unwrap();
    assert!(at.warnings().is_empty() && at.displaced().is_empty(), "{}", at.summary());
    let (q, qd, qdd) = (motion.q(3), motion.qd(3), motion.qdd(3));
    let measured = Motion::from_states(&system, &[0.3], &[q], &[qd], &[qdd]).unwrap();
    assert!(measured.warnings().is_empty() && measured.displaced().is_empty());
    let mut parts = Vec::new();
    let times = linspace(0.0, 1.0, 12);
    system
        .solver()
        .run_in_parts(times, 4, |part| {
            parts.push((part.warnings().len(), part.displaced().len()));
            Ok(())
        })
        .unwrap();
    assert_eq!(parts, [(1, 1), (0, 0), (0, 0)]);
}

#[test]
fn a_table_that_ends_before_the_run_is_a_warning() {
    let table = Law::spline(&[(0.0, 0.0), (1.0, 0.4), (2.0, 0.3)], Ends::Natural);
    let found = warned_at(driven_crank(table), &linspace(0.0, 3.0, 31));
    let [one] = &found[..] else { panic!("{found:?}") };
    assert_eq!((one.kind, &one.names[..]), (WarningKind::BeyondRange, &["motor".to_string()][..]));
    assert_eq!(
        one.text,
        "t = 2 s: `law` of `motor` ends at 2, but the run continues to 3. Beyond 2 the law is a \
         straight line."
    );
}

/// The slider drives: at its end, where crank and rod are in line, C_q is singular.
fn driven_by_the_slider(from: f64) -> Mechanism {
    let mut m = Mechanism::new("press");
    let crank = m.link("crank", 1.0).unwrap();
    let rod = m.link("rod", 3.0).unwrap();
    let block = m.planar("block", pose(4.0, 0.0, 0.0)).unwrap();
    m.add("O", revolute(crank, Ground, crank.start(), vec2(0.0, 0.0))).unwrap();
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).unwrap();
    m.add("B", revolute(rod, block, rod.end(), vec2(0.0, 0.0))).unwrap();
    let across = vec2(0.0, 1.0);
    m.add("guide", prismatic(block, Ground, vec2(0.0, 0.0), vec2(0.0, 0.0), across, 0.0)).unwrap();
    let angle = ((1.0 + from * from - 9.0) / (2.0 * from)).clamp(-1.0, 1.0).acos();
    m.set_pose(crank, pose(0.5 * angle.cos(), 0.5 * angle.sin(), angle)).unwrap();
    let tilt = (-angle.sin()).atan2(from - angle.cos());
    let middle = vec2(angle.cos(), angle.sin()) + vec2(tilt.cos(), tilt.sin()) * 1.5;
    m.set_pose(rod, pose(middle.x, middle.y, tilt)).unwrap();
    m.set_pose(block, pose(from, 0.0, 0.0)).unwrap();
    m.add("press", drive(block.x(), Law::linear(from, -0.5))).unwrap();
    m
}

#[test]
fn a_start_near_a_singular_position_is_a_warning() {
    for off in [1e-9, 1e-8, 1e-7] {
        let found = warned(driven_by_the_slider(4.0 - off));
        let [one] = &found[..] else { panic!("{off}: {found:?}") };
        assert_eq!(one.kind, WarningKind::SingularStart);
        assert!(one.names.iter().any(|name| name == "crank"), "{one:?}");
        assert!(one.text.starts_with("The run begins at t = 0 s near a singular position."));
    }
    for off in [1e-3, 0.01, 0.3] {
        assert_eq!(warned(driven_by_the_slider(4.0 - off)), [], "{off}");
    }
    // A motor at the crank is regular there.
    assert_eq!(warned(four_bar(Law::ramp(TAU))), []);
}

/// A long chain is badly conditioned wherever it is: its start is no singular position.
#[test]
fn a_long_chain_does_not_begin_at_a_singular_position() {
    let mut m = Mechanism::new("chain");
    let mut last = m.link("link 0", 1.0).unwrap();
    m.add("O", revolute(last, Ground, last.start(), vec2(0.0, 0.0))).unwrap();
    m.add("motor 0", drive_angle(last, Law::ramp(0.1))).unwrap();
    for k in 1..200 {
        let next = m.link(&format!("link {k}"), 1.0).unwrap();
        m.add(&format!("J{k}"), revolute(last, next, last.end(), next.start())).unwrap();
        m.add(&format!("motor {k}"), drive_relative_angle(next, last, Law::ramp(0.1))).unwrap();
        last = next;
    }
    assert_eq!(m.build().unwrap().run(linspace(0.0, 1.0, 3)).unwrap().warnings(), []);
}

/// A run that ends early has warned before: its motion has them.
#[test]
fn the_motion_of_a_run_that_ends_early_has_its_warnings() {
    let mut m = driven_by_the_slider(3.5);
    m.limit("O.angle", -90.0, 90.0).unwrap();
    let options = SolverOptions::new().follow(Follow::Smooth);
    let error = m
        .build()
        .unwrap()
        .solver()
        .options(options.clone())
        .run(linspace(0.0, 9.0, 181))
        .unwrap_err();
    assert!(matches!(error.kind(), Some(FailureKind::Toggle { .. })), "{error}");
    let kinds: Vec<_> =
        error.motion().unwrap().warnings().iter().map(|warning| warning.kind).collect();
    assert_eq!(kinds, [WarningKind::Degrees]);
}

/// Warnings are in the JSON of a motion, and come back.
#[test]
fn warnings_are_written_and_read_with_the_motion() {
    let table = Law::spline(&[(0.0, 0.0), (1.0, 0.4)], Ends::Natural) + Law::constant(45.0);
    let motion = driven_crank(table).build().unwrap().run(linspace(0.0, 2.0, 5)).unwrap();
    assert_eq!(motion.warnings().len(), 2);
    let back = Motion::from_data(&motion.data()).unwrap();
    assert_eq!((back.warnings(), back.summary()), (motion.warnings(), motion.summary()));
}

/// Setting the number right ends the warning; cases of a sweep are not checked.
#[test]
fn a_number_that_is_set_right_is_asked_about_no_more() {
    let mut system = driven_crank(Law::ramp(360.0)).build().unwrap();
    let times = linspace(0.0, 1.0, 11);
    assert_eq!(system.run(&times).unwrap().warnings().len(), 1);
    let cases = [[360.0]];
    let kept = |_: usize, motion: kin::Result<Motion>| motion.unwrap().warnings().len();
    let found = system.sweep(["motor.law.rate"]).unwrap().run(&cases, &times, kept);
    assert_eq!(found.unwrap(), [0]);
    // Nor are angles of cases far from their guesses for a reason that nobody has looked at.
    let later = system
        .sweep(["motor.law.rate"])
        .unwrap()
        .run(&cases, [7.0, 7.1], |_, motion| motion.unwrap().warnings().len());
    assert_eq!(later.unwrap(), [0]);
    system.set("motor.law.rate", TAU).unwrap();
    assert_eq!(system.run(&times).unwrap().warnings(), []);
}

/// A hundred bodies with one slip have one cure.
#[test]
fn of_one_kind_there_are_at_most_four_warnings() {
    let mut m = Mechanism::new("plates");
    for k in 0..100 {
        let plate = m.planar(&format!("plate {k}"), pose(1.0, 0.5, 90.0)).unwrap();
        m.add(&format!("weld {k}"), weld(plate, Ground, vec2(0.0, 0.0), vec2(1.0, 0.5), 0.1))
            .unwrap();
    }
    let motion = m.build().unwrap().run([0.0]).unwrap();
    assert_eq!(motion.warnings().len(), 4);
}
