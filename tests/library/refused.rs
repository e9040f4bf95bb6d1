//! Refusals and their words, and notes about a position that has been found.

use kin::SpatialPose;
use kin::error::FailureKind;
use kin::prelude::*;

use crate::engines::Engines;

/// The words with which a constraint is refused.
fn refusal(m: &mut Mechanism, constraint: impl Constraint + 'static) -> String {
    match m.add("it", constraint) {
        Ok(_) => "let in".to_owned(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn bad_parameters_of_planar_joints() {
    let mut m = Mechanism::new("m");
    let a = m.link("a", 1.0).expect("a link");
    let b = m.link("b", 1.0).expect("a link");
    let o = vec2(0.0, 0.0);
    let x = vec2(1.0, 0.0);
    let zero = Law::constant(1.0);
    let cases = [
        (
            refusal(&mut m, distance(a, b, o, o, -1.0)),
            "`it` (distance): the length of the rod must be above zero; for pins at the same point use `revolute` (length = -1)",
        ),
        (
            refusal(&mut m, distance(a, b, o, o, f64::NAN)),
            "`it` has NaN as its parameter `length`. Give a finite number",
        ),
        (
            refusal(&mut m, prismatic(a, b, o, o, o, 0.0)),
            "`it` (prismatic): the direction across the slide must not be zero (h_i.x = 0, h_i.y = 0)",
        ),
        (
            refusal(&mut m, pin_in_slot(a, b, o, x, x)),
            "the ends of the slot must be different points",
        ),
        (
            refusal(&mut m, point_on_circle(a, b, o, o, 0.0)),
            "the radius of the circle must be above zero (radius = 0)",
        ),
        (
            refusal(&mut m, point_on_line(a, b, o, o, o)),
            "the direction of the line must not be zero",
        ),
        (
            refusal(&mut m, gear(a, b, Ground, -1.0, 2.0, 0.0)),
            "the pitch radii must be above zero (r_i = -1, r_j = 2)",
        ),
        (refusal(&mut m, internal_gear(a, b, Ground, 2.0, 1.0, 0.0)), "pitch radius of the ring"),
        (
            refusal(&mut m, belt(a, b, Ground, 0.0, 1.0, 0.0)),
            "the radius of a pulley must not be zero",
        ),
        (
            refusal(&mut m, rack_and_pinion(a, b, o, o, x, 0.0, 0.0)),
            "the radius of the pinion must not be zero",
        ),
        (
            refusal(&mut m, rolling(a, b, o, o, o, 1.0, 0.0)),
            "the direction of the track must not be zero",
        ),
        (
            refusal(&mut m, coupling(a.theta(), b.theta(), 0.0, 1.0, 0.0)),
            "the factors must not be zero",
        ),
        (refusal(&mut m, parallel(a, b, o, x)), "the directions must not be zero"),
        (refusal(&mut m, cam_knife_edge(a, b, o, Law::ramp(0.1))), "must repeat after 2π"),
        (
            refusal(&mut m, cam_flat_face(a, b, o, x, Law::sine(0.1, 0.5, 0.0))),
            "must repeat after 2π",
        ),
        (refusal(&mut m, cam_flat_face(a, b, o, o, zero)), "the normal of the face"),
        (
            refusal(&mut m, drive_slide(a, b, o, o, o, Law::ramp(1.0))),
            "the direction of the slide must not be zero",
        ),
        (
            refusal(&mut m, drive_angle(a, Law::trapezoidal(1.0, 0.0, 1.0))),
            "`it` (drive_angle): law: trapezoidal: speed, acceleration and jerk must be above zero",
        ),
        (
            refusal(
                &mut m,
                drive_angle(
                    a,
                    Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::constant(0.0))]),
                ),
            ),
            "do not meet",
        ),
        (
            refusal(
                &mut m,
                drive_point(
                    a,
                    o,
                    Law::spline(&[(1.0, 0.0), (0.5, 0.0)], Ends::Natural),
                    Law::ramp(1.0),
                ),
            ),
            "path_x: spline: the values of x must increase, but x = 1 is followed by 0.5 (point 2)",
        ),
    ];
    for (found, said) in cases {
        assert!(found.contains(said), "{found}\n  should say: {said}");
    }
}

#[test]
fn bad_parameters_of_spatial_joints() {
    let mut m = Mechanism::new("m");
    let origin = SpatialPose::at(vec3(0.0, 0.0, 0.0));
    let a = m.spatial("a", origin).expect("a body");
    let b = m.spatial("b", origin).expect("a body");
    let o = vec3(0.0, 0.0, 0.0);
    let z = vec3(0.0, 0.0, 1.0);
    let none = EulerParameters::new(0.0, 0.0, 0.0, 0.0);
    let cases = [
        (
            refusal(&mut m, spatial::revolute(a, b, o, o, o, z)),
            "`it` has NaN as its parameter `h_i.x`",
        ),
        (
            refusal(&mut m, spatial::revolute(a, b, o, o, z, o)),
            "`it` (revolute): the axis in body j must not be zero (h_j.x = 0, h_j.y = 0, h_j.z = 0)",
        ),
        (
            refusal(&mut m, spatial::revolute(a, b, o, o, Axis::new(z, z), z)),
            "h_i: the axis has no direction",
        ),
        (
            refusal(&mut m, spatial::weld(a, b, o, o, none)),
            "at least one Euler parameter must differ from zero",
        ),
        (
            refusal(&mut m, spatial::universal(a, b, o, o, o, z)),
            "the bars of the cross must not be zero",
        ),
        (refusal(&mut m, spatial::angle(a, b, z, z, 0.0)), "above 0 and below π"),
        (
            refusal(&mut m, spatial::screw(a, b, o, o, z, z, 0.0)),
            "the lead of the screw must not be zero",
        ),
        (
            refusal(&mut m, spatial::gear(a, b, Ground, z, z, z, z, 12.5, 20.0, 0.0)),
            "the numbers of teeth must be whole numbers",
        ),
        (
            refusal(&mut m, spatial::revolute_spherical(a, b, o, o, z, 0.0)),
            "the length of the link must be above zero",
        ),
        (
            refusal(&mut m, spatial::point_in_plane(a, b, o, o, o)),
            "the normal of the plane must not be zero",
        ),
    ];
    for (found, said) in cases {
        assert!(found.contains(said), "{found}\n  should say: {said}");
    }
}

/// A parameter that is set later is looked at too, and the old one stays.
#[test]
fn a_parameter_that_makes_no_sense_cannot_be_set() {
    let mut m = Mechanism::new("m");
    let a = m.planar("a", pose(2.0, 0.0, 0.0)).expect("a body");
    m.add("rod", distance(a, Ground, vec2(0.0, 0.0), vec2(0.0, 0.0), 2.0)).expect("let in");
    m.add("y", drive(a.y(), Law::ramp(1.0))).expect("let in");
    m.add("theta", drive_angle(a, Law::ramp(1.0))).expect("let in");
    let mut system = m.build().expect("square");
    let error = system.set("rod.length", -2.0).expect_err("refused").to_string();
    let expected = "`rod` (distance): the length of the rod must be above zero; for pins at the \
                    same point use `revolute` (length = -2)";
    assert!(error.contains(expected), "{error}");
    assert_eq!(system.parameter("rod.length").expect("known"), 2.0);
    system.set("rod.length", 3.0).expect("good");
    assert!((system.position(0.0).expect("a position").q[0] - 3.0).abs() < 1e-14);
}

/// A door on a hinge, driven, from a guess of its pose.
fn door(guess: SpatialPose, h_j: Vec3) -> kin::Result<kin::Motion> {
    let mut m = Mechanism::new("door");
    let body = m.spatial("door", guess)?;
    let o = vec3(0.0, 0.0, 0.0);
    let z = vec3(0.0, 0.0, 1.0);
    m.add("hinge", spatial::revolute(body, Ground, o, o, z, h_j))?;
    m.add("motor", spatial::drive_turn(body, Ground, z, z, Law::ramp(1.0)))?;
    m.build()?.run_both(linspace(0.0, 1.0, 11))
}

#[test]
fn an_axis_the_wrong_way_round_is_told() {
    let upright = SpatialPose::at(vec3(0.0, 0.0, 0.0));
    assert!(door(upright, vec3(0.0, 0.0, 2.0)).is_ok());
    // from upside down the equations close, but not the hinge: the door is turned over
    let upside_down = door(
        SpatialPose::turned(vec3(0.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0), PI),
        vec3(0.0, 0.0, 1.0),
    );
    assert!(upside_down.is_ok(), "{upside_down:?}");
    // the hinge asks for the opposite of what the motor turns about
    let error = door(upright, vec3(0.0, 0.0, -1.0)).expect_err("flipped");
    let text = error.to_string();
    assert!(matches!(error.kind(), Some(FailureKind::WrongBranch { .. })), "{text}");
    assert!(
        text.contains(
            "`hinge` (revolute) is assembled the wrong way round at t = 0 s: the axes point in opposite directions: h_i · h_j < 0."
        ),
        "{text}"
    );
}

/// A point driven along x by a law; y and θ stand still.
fn driven(law: Law, times: &[f64]) -> kin::Result<kin::Motion> {
    let mut m = Mechanism::new("slide");
    let body = m.planar("block", pose(0.0, 0.0, 0.0))?;
    m.add("motor", drive(body.x(), law))?;
    m.add("y", drive(body.y(), Law::constant(0.0)))?;
    m.add("theta", drive_angle(body, Law::constant(0.0)))?;
    m.build()?.run_both(times)
}

#[test]
fn a_run_lists_the_breaks_it_crosses() {
    let motion = driven(Law::trapezoidal(2.0, 1.0, 2.0), &linspace(-1.0, 4.0, 51)).expect("runs");
    let found: Vec<(f64, usize)> =
        motion.breaks().iter().map(|crossed| (crossed.found.x, crossed.found.order)).collect();
    assert_eq!(found, [(0.0, 2), (0.5, 2), (2.0, 2), (2.5, 2)]);
    let first = &motion.breaks()[0];
    assert_eq!((first.constraint.as_str(), first.law.as_str()), ("motor", "law"));
    assert!(first.between.0 < 0.0 && first.between.1 >= 0.0);
    assert!(
        motion.summary().contains("4 breaks of laws crossed (derivative 2 jumps)"),
        "{}",
        motion.summary()
    );
    // at a break the acceleration is that of its right side
    assert!(
        (motion.qdd(15)[0] - 0.0).abs() < 1e-12 && (motion.qdd(10)[0] - 2.0).abs() < 1e-12,
        "{:?}",
        motion.qdd(10)
    );
    // the same backwards
    let back = driven(Law::trapezoidal(2.0, 1.0, 2.0), &linspace(4.0, -1.0, 51)).expect("runs");
    assert_eq!(back.breaks().len(), 4);
    assert!(
        driven(Law::cycloidal(1.0, 1.0), &linspace(0.1, 0.9, 9)).expect("runs").breaks().is_empty()
    );
}

#[test]
fn a_jump_of_slope_where_motion_is_driven_is_an_error() {
    let corner = Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, -1.0))]);
    assert!(driven(corner.clone(), &linspace(0.1, 0.9, 9)).is_ok());
    let error = driven(corner, &linspace(0.1, 1.9, 10)).expect_err("a corner");
    let text = error.to_string();
    assert!(matches!(error.kind(), Some(FailureKind::LawJumps { order: 1, .. })), "{text}");
    assert!(text.contains("the slope of the law changes suddenly at 1,"), "{text}");
    let before = error.motion().expect("the motion before");
    assert_eq!((before.len(), before.breaks().len()), (5, 0), "it ends before the corner");
    // a value that jumps, in a law of one's own that says so
    struct Step;
    impl kin::extend::LawFunction for Step {
        fn jet(&self, x: f64) -> [f64; 4] {
            [if x < 0.5 { 0.0 } else { 1.0 }, 0.0, 0.0, 0.0]
        }
        fn breaks(&self, from: f64, to: f64) -> Vec<kin::law::Break> {
            if (from..=to).contains(&0.5) {
                vec![kin::law::Break { x: 0.5, order: 0 }]
            } else {
                vec![]
            }
        }
        fn is_smooth(&self) -> bool {
            false
        }
    }
    let text = driven(Law::new(Step), &[0.0, 1.0]).expect_err("a step").to_string();
    assert!(text.contains("the value of the law changes suddenly"), "{text}");
}

/// Breaks of a cam's profile are crossed by the angle at which it is asked, also over the cut of
/// that angle.
#[test]
fn a_cam_lists_the_breaks_of_its_profile() {
    let rise = Law::constant(1.0) + Law::cycloidal(0.2, 2.0);
    let fall = Law::constant(1.2) - Law::cycloidal(0.2, 2.0);
    let profile = Law::sequence(
        0.0,
        [(2.0, rise), (1.0, Law::constant(1.2)), (2.0, fall), (TAU - 5.0, Law::constant(1.0))],
    )
    .periodic(TAU);
    let mut m = Mechanism::new("cam");
    let cam = m.planar("cam", pose(0.0, 0.0, 0.0)).expect("a body");
    let rod = m.planar("rod", pose(0.0, 1.0, 0.0)).expect("a body");
    m.add("O", revolute(cam, Ground, vec2(0.0, 0.0), vec2(0.0, 0.0))).expect("let in");
    m.add("guide", prismatic(rod, Ground, vec2(0.0, 0.0), vec2(0.0, 0.0), vec2(1.0, 0.0), 0.0))
        .expect("let in");
    m.add("contact", cam_knife_edge(cam, rod, vec2(0.0, 0.0), profile)).expect("let in");
    m.add("motor", drive_angle(cam, Law::ramp(-1.0))).expect("let in");
    let motion = m.build().expect("square").run_both(linspace(0.0, 2.0 * TAU, 401)).expect("runs");
    // the tip stands over the cam's angle π/2 + t: two turns, four breaks each
    assert_eq!(motion.breaks().len(), 8, "{:?}", motion.breaks());
    assert!(
        motion.breaks().iter().all(|crossed| crossed.found.order == 3 && crossed.law == "profile")
    );
}
