//! Sign conventions by example: one pose each, worked out by hand, that closes, and the same with
//! the sign turned, that does not.

use kin::check::{any_coord as c, any_planar as p, any_spatial as s};
use kin::extend::terms;
use kin::prelude::*;

fn size(joint: &dyn Constraint, q: &[f64], t: f64) -> f64 {
    terms(joint, q, &[], t).c.amax()
}

/// Closes at one pose, and not at the other.
fn closes(joint: &dyn Constraint, q: &[f64], other: &[f64], t: f64) {
    let c = size(joint, q, t);
    let away = size(joint, other, t);
    assert!(c < 1e-14, "`{}` is off by {c:e} at {q:?}", joint.facts().kind);
    assert!(away > 1e-3, "`{}` closes at {other:?} too", joint.facts().kind);
}

const O: Vec2 = Vec2::new(0.0, 0.0);

#[test]
fn planar_angles_are_counter_clockwise_of_i_in_j() {
    let q = |theta_i: f64, theta_j: f64| [0.0, 0.0, theta_i, 0.0, 0.0, theta_j];
    closes(&angle(p(), p(), 0.3), &q(0.5, 0.2), &q(0.2, 0.5), 0.0);
    closes(&weld(p(), p(), O, O, 0.3), &q(0.5, 0.2), &q(0.2, 0.5), 0.0);
    closes(&drive_relative_angle(p(), p(), Law::ramp(2.0)), &q(7.0, 1.0), &q(1.0, 7.0), 3.0);
    // wheels turn against each other, a wheel and its ring the same way, both with the arm as what
    // stands still
    let three = |i: f64, j: f64, arm: f64| [0.0, 0.0, i, 0.0, 0.0, j, 0.0, 0.0, arm];
    closes(&gear(p(), p(), p(), 1.0, 2.0, 0.0), &three(1.1, -0.4, 0.1), &three(1.1, 0.6, 0.1), 0.0);
    closes(
        &internal_gear(p(), p(), p(), 1.0, 2.0, 0.0),
        &three(1.1, 0.6, 0.1),
        &three(1.1, -0.4, 0.1),
        0.0,
    );
    closes(&belt(p(), p(), p(), 1.0, 2.0, 0.0), &three(1.1, 0.6, 0.1), &three(1.1, -0.4, 0.1), 0.0);
    // the phase is the turn of i where j is in line with the arm
    closes(
        &gear(p(), p(), p(), 1.0, 2.0, 0.25),
        &three(0.35, 0.1, 0.1),
        &three(-0.15, 0.1, 0.1),
        0.0,
    );
}

#[test]
fn planar_slides_go_along_their_direction() {
    // P_i at (3, 4); body j at (1, 1), turned by 90°, so that its x-axis is the global y-axis
    let q = |x: f64| [x, 4.0, 0.0, 1.0, 1.0, PI / 2.0];
    closes(
        &drive_slide(p(), p(), O, O, vec2(5.0, 0.0), Law::constant(3.0)),
        &q(3.0),
        &[3.0, -2.0, 0.0, 1.0, 1.0, PI / 2.0],
        0.0,
    );
    // the left of a line along global y is −x
    let line = point_on_line(p(), p(), O, O, vec2(1.0, 0.0));
    assert!((terms(&line, &q(-1.0), &[], 0.0).c[0] - 2.0).abs() < 1e-15);
    // a wheel that rolls along +x over the track turns clockwise
    let wheel = |x: f64, theta: f64| [x, 0.5, theta, 0.0, 0.0, 0.0];
    closes(
        &rolling(p(), p(), O, O, vec2(2.0, 0.0), 0.5, 0.0),
        &wheel(1.0, -2.0),
        &wheel(1.0, 2.0),
        0.0,
    );
    closes(
        &rack_and_pinion(p(), p(), O, O, vec2(2.0, 0.0), 0.5, 0.1),
        &wheel(1.0, -1.9),
        &wheel(1.0, 1.9),
        0.0,
    );
    closes(
        &rack_and_pinion(p(), p(), O, O, vec2(2.0, 0.0), -0.5, 0.0),
        &wheel(1.0, 2.0),
        &wheel(1.0, -2.0),
        0.0,
    );
    closes(&coupling(c(), c(), 2.0, -1.0, 3.0), &[2.0, 1.0], &[2.0, -1.0], 0.0);
    closes(
        &drive_point_along(p(), vec2(1.0, 0.0), vec2(0.0, 3.0), Law::ramp(1.0)),
        &[0.0, 1.0, PI / 2.0],
        &[0.0, 3.0, PI / 2.0],
        2.0,
    );
    closes(
        &moving_point(p(), p(), Law::ramp(2.0), Law::constant(1.0), O),
        &[0.0, 0.0, PI / 2.0, -1.0, 4.0, 0.0],
        &[0.0, 0.0, 0.0, -1.0, 4.0, 0.0],
        2.0,
    );
}

#[test]
fn cams_are_measured_from_their_own_x_axis() {
    // a cam turned by 30°, its tip of ρ = 1.5 at 90° of its own: at 120° in the world
    let profile = Law::fourier(1.0, 1.0, &[(0.0, 0.5)]);
    let x = 1.5 * deg(120.0).cos();
    let y = 1.5 * deg(120.0).sin();
    closes(
        &cam_knife_edge(p(), p(), O, profile.clone()),
        &[0.0, 0.0, deg(30.0), x, y, 0.0],
        &[0.0, 0.0, deg(-30.0), x, y, 0.0],
        0.0,
    );
    // a face over the cam at y = 1.5 with its normal upwards, 90° in a cam that is not turned
    closes(
        &cam_flat_face(p(), p(), O, vec2(0.0, 2.0), profile.clone()),
        &[0.0, 0.0, 0.0, 7.0, 1.5, 0.0],
        &[0.0, 0.0, PI, 7.0, 1.5, 0.0],
        0.0,
    );
    // a roller of radius 0.25 over the cam's tip
    let roller = cam_roller(p(), p(), c(), O, 0.25, profile);
    closes(
        &roller,
        &[0.0, 0.0, 0.0, 0.0, 1.75, 0.0, PI / 2.0],
        &[0.0, 0.0, 0.0, 0.0, 1.25, 0.0, PI / 2.0],
        0.0,
    );
}

/// A spatial body at r, turned by an angle about an axis.
fn body(r: Vec3, axis: Vec3, angle: f64) -> Vec<f64> {
    let p = EulerParameters::from_axis_angle(axis, angle);
    [r.to_array().as_slice(), &p.to_array()].concat()
}

#[test]
fn spatial_turns_follow_the_right_hand() {
    let o = vec3(0.0, 0.0, 0.0);
    let x = Vec3::x();
    let z = Vec3::z();
    let two = |i: Vec<f64>, j: Vec<f64>| [i, j].concat();
    let turned = |angle: f64| two(body(o, z, angle), body(o, z, 0.2));
    // f of z is x: the turn of i in j is 0.5, and may be any number of turns more
    closes(
        &spatial::drive_turn(s(), s(), z, z, Law::constant(0.5)),
        &turned(0.7),
        &turned(-0.3),
        0.0,
    );
    closes(
        &spatial::drive_turn(s(), s(), z, z, Law::constant(0.5 + 40.0 * TAU)),
        &turned(0.7),
        &turned(-0.3),
        0.0,
    );
    closes(
        &spatial::drive_rotation(s(), s(), z, Law::constant(0.5)),
        &turned(0.7),
        &turned(-0.3),
        0.0,
    );
    closes(
        &spatial::relative_angle(s(), s(), c(), z, z),
        &[turned(0.7), vec![0.5]].concat(),
        &[turned(0.7), vec![-0.5]].concat(),
        0.0,
    );
    // p_ij is body i as body j sees it
    let p_ij = EulerParameters::from_axis_angle(z, 0.5);
    closes(&spatial::weld(s(), s(), o, o, p_ij), &turned(0.7), &turned(-0.3), 0.0);
    closes(&spatial::prismatic(s(), s(), o, o, x, p_ij), &turned(0.7), &turned(-0.3), 0.0);
    // a right-hand screw goes along its axis as it turns by the right hand
    let screwed = |height: f64| two(body(vec3(0.0, 0.0, height), z, PI / 2.0), body(o, z, 0.0));
    closes(&spatial::screw(s(), s(), o, o, z, z, 0.4), &screwed(0.1), &screwed(-0.1), 0.0);
    // yaw about z, then pitch about the new y, then roll about the new x: after a yaw of 90° the
    // pitch is about −x
    let orientation = spatial::drive_orientation(
        s(),
        s(),
        Law::constant(PI / 2.0),
        Law::constant(0.3),
        Law::constant(0.0),
    );
    let yaw = EulerParameters::from_axis_angle(z, PI / 2.0);
    let pitch = EulerParameters::from_axis_angle(x, -0.3);
    let p = pitch.product(yaw);
    let q = |p: EulerParameters| [vec![0.0; 3], p.to_array().to_vec(), body(o, z, 0.0)].concat();
    closes(&orientation, &q(p), &q(yaw.product(pitch)), 0.0);
}

#[test]
fn spatial_gears_and_links() {
    let o = vec3(0.0, 0.0, 0.0);
    let x = Vec3::x();
    let z = Vec3::z();
    let turned = |i: f64, j: f64| [body(o, z, i), body(o, z, j), body(o, z, 0.0)].concat();
    // 10 and 20 teeth: 0.4 one way, 0.2 the other; a ring the same way
    closes(
        &spatial::gear(s(), s(), s(), z, z, z, z, 10.0, 20.0, 0.0),
        &turned(0.4, -0.2),
        &turned(0.4, 0.25),
        0.0,
    );
    closes(
        &spatial::gear(s(), s(), s(), z, z, z, z, 10.0, -20.0, 0.0),
        &turned(0.4, 0.2),
        &turned(0.4, -0.25),
        0.0,
    );
    // the pinion on the side of g goes along f and turns backwards
    let rack = |angle: f64| [body(vec3(0.1, 0.5, 0.0), z, angle), body(o, z, 0.0)].concat();
    closes(
        &spatial::rack_and_pinion(s(), s(), o, o, z, Axis::new(z, x), 0.5, 0.0),
        &rack(-0.2),
        &rack(0.2),
        0.0,
    );
    // a link along x whose second hinge is turned by 0.5 about it
    let link = |twist: f64| [body(o, z, 0.0), body(x * 2.0, x, twist)].concat();
    closes(
        &spatial::revolute_revolute(s(), s(), o, o, z, z, 2.0, 0.5),
        &link(0.5),
        &link(-0.5),
        0.0,
    );
    let sleeve = |twist: f64| {
        [body(o, z, 0.0), body(x * 2.0 + vec3(0.0, -twist.sin(), twist.cos()) * 3.0, x, twist)]
            .concat()
    };
    closes(
        &spatial::revolute_cylindrical(s(), s(), o, o, z, z, 2.0, 0.5),
        &sleeve(0.5),
        &sleeve(-0.5),
        0.0,
    );
    closes(
        &spatial::drive_slide(s(), s(), o, o, z, Law::constant(3.0)),
        &link_height(3.0),
        &link_height(-3.0),
        0.0,
    );
    // h_i · d and h_j · d point the ways that are written
    let plane = spatial::point_in_plane(s(), s(), o, o, z * 2.0);
    assert_eq!(terms(&plane, &link_height(3.0), &[], 0.0).c[0], 6.0);
}

fn link_height(height: f64) -> Vec<f64> {
    [body(vec3(0.0, 0.0, height), Vec3::z(), 0.0), body(vec3(0.0, 0.0, 0.0), Vec3::z(), 0.0)]
        .concat()
}
