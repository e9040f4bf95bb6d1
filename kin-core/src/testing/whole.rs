//! Whole mechanisms: against closed forms, in awkward positions, and wrongly built.

use std::f64::consts::{FRAC_PI_6, PI, TAU};

use super::*;
use crate::algebra::Vec2;
use crate::coordinates::{Ground, Link, any_planar};
use crate::error::Error;
use crate::mechanism::{Mechanism, SpatialPose, deg, linspace, pose};
use crate::newton::{Options, Stop};
use crate::system::System;

fn v(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

/// The lecture's two-link manipulator, lengths in units of `u` metres, from a rough guess.
fn two_link(u: f64) -> System {
    let (l2, l3) = (0.2 / u, 0.35 / u);
    let mut m = Mechanism::new("two-link manipulator");
    let body1 = m.planar("body1", pose(0.0168 / u, -0.00559 / u, -0.02)).unwrap();
    let body2 = m.planar("body2", pose(0.0808 / u, 0.0667 / u, 0.539)).unwrap();
    let body3 = m.planar("body3", pose(0.334 / u, 0.125 / u, 0.259)).unwrap();
    m.add("ground", Fixed { b: body1, pose: pose(0.0, 0.0, 0.0) }).unwrap();
    m.add("O", revolute(body1, body2, v(0.0, 0.0), v(-0.5 * l2, 0.0))).unwrap();
    m.add("A", revolute(body2, body3, v(0.5 * l2, 0.0), v(-0.5 * l3, 0.0))).unwrap();
    m.add("link2", drive_angle(body2, Law::linear(FRAC_PI_6, 0.5))).unwrap();
    m.add("link3", drive_angle(body3, Law::linear(0.5 * FRAC_PI_6, 0.75))).unwrap();
    m.build().unwrap()
}

/// R3, its velocity and its acceleration in closed form.
fn two_link_exact(t: f64) -> [[f64; 2]; 3] {
    let (a, b, w, o) = (0.5 * t + FRAC_PI_6, 0.75 * t + 0.5 * FRAC_PI_6, 0.5, 0.75);
    let e = |k: usize, angle: f64| [[angle.cos(), angle.sin()], [-angle.sin(), angle.cos()], [-angle.cos(), -angle.sin()]][k];
    std::array::from_fn(|k| std::array::from_fn(|i| 0.2 * w_pow(w, k) * e(k, a)[i] + 0.175 * w_pow(o, k) * e(k, b)[i]))
}

fn w_pow(w: f64, k: usize) -> f64 {
    w.powi(k as i32)
}

#[test]
fn two_link_manipulator_is_the_closed_form() {
    let motion = two_link(1.0).run(linspace(0.0, 24.0, 2401)).unwrap();
    for (k, t) in motion.times().iter().enumerate() {
        let exact = two_link_exact(*t);
        for (found, (exact, tolerance)) in
            [motion.q(k), motion.qd(k), motion.qdd(k)].into_iter().zip(exact.into_iter().zip([1e-14, 1e-13, 1e-13]))
        {
            assert!((found[6] - exact[0]).abs() < tolerance && (found[7] - exact[1]).abs() < tolerance, "t = {t}");
        }
    }
    assert!(motion.residuals().iter().all(|r| *r < 1e-14));
    assert!(motion.iterations()[1..].iter().all(|n| *n == 1));
    assert!(motion.summary().starts_with("two-link manipulator: 9 coordinates, 9 equations, 2401 times, 1 Newton step a time"));
}

#[test]
fn two_link_manipulator_is_the_reference_at_one_second() {
    // tests/data/two_link_25.json, t = 1.
    let motion = two_link(1.0).run(linspace(0.0, 24.0, 25)).unwrap();
    let q = [0.05202960232131906, 0.08539859765994633, 1.023598775598299, 0.196868019041525, 0.3191600072704383, 1.0117993877991494];
    let qdd = [-0.013007400580329766, -0.02134964941498658, 0.0, -0.0782197592600334, -0.12615338055215508, 0.0];
    for k in 0..6 {
        assert!((motion.q(1)[3 + k] - q[k]).abs() < 1e-14 && (motion.qdd(1)[3 + k] - qdd[k]).abs() < 1e-14);
    }
}

#[test]
fn unit_of_length_changes_nothing() {
    let metres = two_link(1.0).run(linspace(0.0, 3.0, 31)).unwrap();
    for u in [1e-3, 1e3, 1e9] {
        let other = two_link(u).run(linspace(0.0, 3.0, 31)).unwrap();
        assert_eq!(metres.iterations(), other.iterations(), "u = {u}");
        for k in 0..31 {
            assert!((metres.q(k)[6] - u * other.q(k)[6]).abs() < 1e-14);
        }
    }
}

#[test]
fn backwards_is_the_same_motion() {
    let system = two_link(1.0);
    let (forth, back) = (system.run(linspace(0.0, 2.0, 21)).unwrap(), system.run(linspace(2.0, 0.0, 21)).unwrap());
    for k in 0..21 {
        assert!(forth.q(k).iter().zip(back.q(20 - k)).all(|(a, b)| (a - b).abs() < 1e-14));
    }
}

#[test]
fn published_protocol_takes_two_steps_a_time() {
    let options = Options { stop: Stop::ResidualOnly(1e-10), predict: false, ..Options::default() };
    let motion = two_link(1.0).run_with(linspace(0.0, 1.0, 101), &options).unwrap();
    assert!(motion.iterations()[1..].iter().all(|n| *n == 2), "{:?}", motion.iterations());
}

fn slider_crank(l: [f64; 3], omega: f64, guess: [f64; 2]) -> System {
    let mut m = Mechanism::new("slider-crank");
    let (theta3, x) = (m.angle("theta3", guess[0]).unwrap(), m.length("x", guess[1]).unwrap());
    m.add("loop", SliderCrank { theta3, x, l, omega }).unwrap();
    m.build().unwrap()
}

#[test]
fn slider_crank_is_the_elimination() {
    let [l2, l3, h] = [1.0, 3.5, 0.2];
    for branch in [1.0, -1.0] {
        let guess = if branch > 0.0 { [0.1, 4.0] } else { [PI, -2.0] };
        let motion = slider_crank([l2, l3, h], 10.0, guess).run(linspace(0.0, 2.0, 2001)).unwrap();
        for (k, t) in motion.times().iter().enumerate() {
            let s = (h - l2 * (10.0 * t).sin()) / l3;
            let theta3 = if branch > 0.0 { s.asin() } else { PI - s.asin() };
            let (c, x) = (theta3.cos(), l2 * (10.0 * t).cos() + l3 * theta3.cos());
            let rate = -10.0 * l2 * (10.0 * t).cos() / (l3 * c);
            assert!((motion.q(k)[0] - theta3).abs() < 1e-13 && (motion.q(k)[1] - x).abs() < 1e-13, "{branch} {t}");
            assert!((motion.qd(k)[0] - rate).abs() < 1e-11);
        }
    }
}

/// The page's four-bar: everything from zero poses.
fn four_bar(preferred: f64) -> (System, Link, Link) {
    let mut m = Mechanism::new("four-bar");
    let ground = m.ground();
    let crank = m.link("crank", 1.0).unwrap();
    let coupler = m.link("coupler", 3.5).unwrap();
    let rocker = m.link("rocker", 3.0).unwrap();
    m.add("O", revolute(ground, crank, v(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(ground, rocker, v(4.0, 0.0), rocker.start())).unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(TAU))).unwrap();
    m.prefer(rocker, deg(preferred));
    (m.build().unwrap(), coupler, rocker)
}

#[test]
fn four_bar_assembles_from_nothing_as_preferred() {
    let (d, b, c) = (3.0_f64, 3.5_f64, 3.0_f64);
    let along = (b * b - c * c + d * d) / (2.0 * d);
    let across = (b * b - along * along).sqrt();
    for (preferred, side) in [(100.0, 1.0), (-100.0, -1.0), (130.0, 1.0), (60.0, 1.0)] {
        let (system, _, rocker) = four_bar(preferred);
        let motion = system.run(linspace(0.0, 1.0, 1001)).unwrap();
        let exact = (side * across).atan2(along - d);
        let theta = motion.coordinate(rocker.theta());
        assert!((theta.value.values()[0] - exact).abs() < 1e-13, "{preferred}: {} {exact}", theta.value.values()[0]);
        assert!((theta.value.values()[1000] - exact).abs() < 1e-12);
        assert!(motion.iterations()[1..].iter().all(|n| *n <= 2), "{:?}", motion.iterations());
    }
}

#[test]
fn coupler_point_moves_as_its_position_does() {
    let (system, coupler, _) = four_bar(100.0);
    let motion = system.run(linspace(0.0, 1.0, 1001)).unwrap();
    let p = motion.point(coupler, v(0.0, 0.5));
    let h = 2e-3;
    for k in 1..1000 {
        let v = (p.r()[k + 1].x - p.r()[k - 1].x) / h;
        let a = (p.v()[k + 1].y - p.v()[k - 1].y) / h;
        assert!((v - p.v()[k].x).abs() < 2e-3 && (a - p.a()[k].y).abs() < 2e-2, "{k}");
    }
    assert_eq!(p.speed().max(), p.speed().values().iter().fold(0.0, |m: f64, x| m.max(*x)));
    assert!(motion.try_point(any_planar(), v(0.0, 0.0)).is_err());
    assert!(motion.point(any_planar(), v(0.0, 0.0)).r().is_empty());
    assert_eq!(motion.point(PlanarBody::from(Ground), v(1.0, 2.0)).r()[5], v(1.0, 2.0));
}

/// Four-bar with opposite links alike, flat at t = 0.
fn parallelogram(law: Law) -> System {
    let mut m = Mechanism::new("parallelogram");
    let ground = m.ground();
    let crank = m.link_between("crank", v(0.0, 0.0), v(1.0, 0.0)).unwrap();
    let coupler = m.link_between("coupler", v(1.0, 0.0), v(4.0, 0.0)).unwrap();
    let rocker = m.link_between("rocker", v(3.0, 0.0), v(4.0, 0.0)).unwrap();
    m.add("O", revolute(ground, crank, v(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(ground, rocker, v(3.0, 0.0), rocker.start())).unwrap();
    m.add("motor", drive_angle(crank, law)).unwrap();
    m.build().unwrap()
}

#[test]
fn flat_parallelogram_is_singular_by_name() {
    let error = parallelogram(Law::ramp(1.0)).run([0.0, 0.1]).unwrap_err();
    let Error::SingularAt { t, n, rank, movable, .. } = &error else { panic!("{error}") };
    assert_eq!((*t, *n, *rank), (0.0, 9, 8));
    assert_eq!(movable, &["coupler", "rocker"]);
    assert!(error.motion().is_none());
    assert!(error.to_string().contains("`coupler`, `rocker`"), "{error}");
}

#[test]
fn failing_run_keeps_what_it_computed() {
    // Flat at t = 0, which the sweep reaches from above.
    let error = parallelogram(Law::linear(0.0, 1.0)).run([0.3, 0.2, 0.1, 0.0]).unwrap_err();
    assert!(matches!(error, Error::SingularAt { t: 0.0, .. }), "{error}");
    assert_eq!(error.motion().unwrap().times(), [0.3, 0.2, 0.1]);
    assert!(error.to_string().contains("`error.motion()`"), "{error}");
}

#[test]
fn toggle_is_no_convergence_with_the_last_time() {
    // l2 = 1, l3 = 0.8: sin t = 0.8 is the end.
    let end = 0.8_f64.asin();
    let error = slider_crank([1.0, 0.8, 0.0], 1.0, [0.0, 1.8]).run(linspace(0.0, 2.0, 21)).unwrap_err();
    let Error::NoConvergence { constraint, row, last: Some(last), .. } = &error else { panic!("{error}") };
    assert_eq!((constraint.as_str(), row.as_str()), ("loop", "y"));
    assert!(*last <= end && *last > end - 1e-3, "{last} {end}");
    assert_eq!(error.motion().unwrap().len(), 10);
}

#[test]
fn loop_that_cannot_close_is_no_convergence() {
    let error = slider_crank([1.0, 0.5, 2.0], 1.0, [0.0, 1.0]).run([0.0]).unwrap_err();
    assert!(matches!(&error, Error::NoConvergence { constraint, last: None, .. } if constraint == "loop"), "{error}");
}

#[test]
fn turning_through_a_passed_change_point_needs_no_luck() {
    // Times straddle the flat position: the predictor carries the parallelogram through.
    let system = parallelogram(Law::linear(-0.105, 1.0));
    let motion = system.solve_at(0.0, &{
        let (s, c) = (-0.105_f64).sin_cos();
        [0.5 * c, 0.5 * s, -0.105, 1.5 + c, s, 0.0, 3.0 + 0.5 * c, 0.5 * s, -0.105]
    });
    assert!(motion.is_ok_and(|solution| (solution.q[8] + 0.105).abs() < 1e-14 && (solution.qd[8] - 1.0).abs() < 1e-12));
}

#[test]
fn not_square_names_what_is_untouched() {
    let mut m = Mechanism::new("arm");
    let a = m.link("a", 1.0).unwrap();
    m.link("spare", 1.0).unwrap();
    m.add("O", revolute(Ground, a, v(0.0, 0.0), a.start())).unwrap();
    m.add("motor", drive_angle(a, Law::ramp(1.0))).unwrap();
    let error = m.build().unwrap_err();
    assert!(matches!(&error, Error::NotSquare { coordinates: 6, equations: 3, untouched, .. } if untouched == &["spare"]), "{error}");
}

#[test]
fn spatial_bodies_bring_their_norm() {
    let mut m = Mechanism::new("space");
    let p = crate::algebra::Vec3::new(1.0, 2.0, 3.0);
    m.spatial("platform", SpatialPose::at(p)).unwrap();
    let error = m.build().unwrap_err();
    assert!(matches!(&error, Error::NotSquare { coordinates: 7, equations: 1, untouched, .. } if untouched == &["platform"]), "{error}");
}

#[test]
fn not_finite_names_the_constraint_and_keeps_the_motion() {
    let mut m = Mechanism::new("root");
    let x = m.length("x", 1.0).unwrap();
    m.add("slot", Root(x)).unwrap();
    let system = m.build().unwrap();
    let motion = system.run(linspace(0.0, 1.5, 16)).unwrap();
    assert!((motion.q(15)[0] - 6.25).abs() < 1e-13 && (motion.qdd(15)[0] - 2.0).abs() < 1e-12);

    let error = system.run(linspace(0.0, 3.0, 4)).unwrap_err();
    assert!(matches!(&error, Error::NotFinite { t: 2.0, quantity: "C_t", constraint, .. } if constraint == "slot"), "{error}");
    assert_eq!(error.motion().unwrap().len(), 2);

    let error = system.residual(&[-1.0], 0.0).unwrap_err();
    assert!(matches!(&error, Error::NotFinite { quantity: "C", expression: Some(text), .. } if text == "x.sqrt()"), "{error}");
    assert!(matches!(system.jacobian(&[0.0], 0.0), Err(Error::NotFinite { quantity: "C_q", .. })));
}

#[test]
fn constraints_are_refused_by_name() {
    let mut m = Mechanism::new("m");
    let a = m.link("a", 1.0).unwrap();
    let o = v(0.0, 0.0);
    assert!(matches!(m.add("O", revolute(a, a, o, o)), Err(Error::RepeatedBody { name, .. }) if name == "a"));
    let same = Follow { x: a.x(), other: a.x(), law: Law::ramp(1.0) };
    assert!(matches!(m.add("O", same), Err(Error::RepeatedBody { name, .. }) if name == "a.R_x"));
    assert!(matches!(m.add("O", revolute(Ground, Ground, o, o)), Err(Error::NoCoordinates { row, .. }) if row == "x"));
    assert!(matches!(m.add("O", revolute(any_planar(), a, o, o)), Err(Error::ForeignBody { argument, .. }) if argument == "i"));
    let nan = m.add("O", revolute(Ground, a, o, v(0.0, f64::NAN)));
    assert!(matches!(nan, Err(Error::ParameterNotFinite { parameter, .. }) if parameter == "u_j.y"));
    let nan = m.add("O", drive_angle(a, Law::ramp(f64::INFINITY)));
    assert!(matches!(nan, Err(Error::ParameterNotFinite { parameter, .. }) if parameter == "law.rate"));
    assert!(matches!(m.add("", drive_angle(a, Law::ramp(1.0))), Err(Error::EmptyName { .. })));
    m.add("O", drive_angle(a, Law::ramp(1.0))).unwrap();
    assert!(matches!(m.add("O", drive_angle(a, Law::ramp(1.0))), Err(Error::DuplicateName { .. })));
    assert!(matches!(m.link("b", 0.0), Err(Error::InvalidLength { .. })));
    assert!(matches!(m.planar("b", pose(0.0, f64::NAN, 0.0)), Err(Error::InitialNotFinite { coordinate, .. }) if coordinate == "b.R_y"));
    m.prefer(a, f64::NAN);
    assert!(matches!(m.build(), Err(Error::InitialNotFinite { .. })));
}

#[test]
fn handles_of_another_mechanism_are_foreign() {
    let (mut m, mut other) = (Mechanism::new("m"), Mechanism::new("other"));
    let (a, b) = (m.link("a", 1.0).unwrap(), other.link("a", 1.0).unwrap());
    let error = m.add("A", revolute(a, b, a.end(), b.start())).unwrap_err();
    assert!(matches!(&error, Error::ForeignBody { argument, .. } if argument == "j"), "{error}");
    assert!(m.set_pose(b, pose(0.0, 0.0, 0.0)).is_err() && m.guess(b.theta(), 1.0).is_err());
}

#[test]
fn times_and_options_are_checked() {
    let system = two_link(1.0);
    for times in [vec![], vec![0.0, f64::NAN], vec![0.0, 0.0], vec![0.0, 1.0, 0.5], vec![f64::INFINITY]] {
        assert!(matches!(system.run(&times), Err(Error::InvalidTimes { .. })), "{times:?}");
    }
    let options = Options { stop: Stop::Converged { tolerance: f64::NAN }, ..Options::default() };
    assert!(matches!(system.run_with([0.0], &options), Err(Error::InvalidOptions { .. })));
    assert!(matches!(system.residual(&[0.0], 0.0), Err(Error::WrongLength { expected: 9, found: 1, .. })));
    assert!(system.position(f64::NAN).is_err());
}

#[test]
fn parameters_are_read_and_set_by_name() {
    let (mut system, _, _) = four_bar(100.0);
    assert_eq!(system.parameter("C.u_i.x").unwrap(), 4.0);
    let before = system.position(0.0).unwrap();
    system.set("C.u_i.x", 4.5).unwrap();
    let after = system.position(0.0).unwrap();
    assert!((after.q[8] - before.q[8]).abs() > 1e-3 && after.report.residual < 1e-14);
    assert!(matches!(system.set("C.u_i.x", f64::NAN), Err(Error::ParameterNotFinite { .. })));
    assert!(matches!(system.set("C.k", 1.0), Err(Error::UnknownName { known, .. }) if known.len() == 4));
    assert!(system.set("nothing", 1.0).is_err() && system.set("motor.law.rate", 1.0).is_err());
}

#[test]
fn names_follow_the_order_of_declaration_and_addition() {
    let system = two_link(1.0);
    assert_eq!(system.coordinate_names()[3..6], ["body2.R_x", "body2.R_y", "body2.theta"]);
    let names = ["ground.x", "ground.y", "ground.theta", "O.x", "O.y", "A.x", "A.y", "link2", "link3"];
    assert_eq!(system.equation_names(), names);
    assert_eq!(system.constraint_names(), ["ground", "O", "A", "link2", "link3"]);
}

#[test]
fn velocity_and_acceleration_are_those_of_the_run() {
    let system = two_link(1.0);
    let motion = system.run([0.0, 0.4]).unwrap();
    let (q, qd) = (motion.q(1), motion.qd(1));
    let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-14);
    assert!(close(&system.velocity(q, 0.4).unwrap(), qd) && close(&system.acceleration(q, qd, 0.4).unwrap(), motion.qdd(1)));
    assert_eq!(system.c_t(q, 0.4).unwrap()[7..], [-0.5, -0.75]);
    assert_eq!(system.jacobian(q, 0.4).unwrap()[(3, 0)], 1.0);
}

#[test]
fn file_has_every_digit_and_its_headers() {
    let mut motion = two_link(1.0).run([0.0, 0.1]).unwrap();
    motion.add_output("power", "W", vec![1.0, 2.0]).unwrap();
    assert!(motion.add_output("power", "W", vec![1.0, 2.0]).is_err() && motion.add_output("x", "m", vec![f64::NAN, 0.0]).is_err());
    assert!(motion.add_output("x", "m", vec![0.0]).is_err());
    let folder = std::env::temp_dir().join(format!("kin-motion-{}", std::process::id()));
    let path = folder.join("deep/motion.csv");
    motion.write_csv(&path).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines[0][0], "t [s]");
    assert_eq!((lines[0][3], lines[0][10], lines[0][19]), ("body1.theta [rad]", "body1.R_x' [m/s]", "body1.R_x'' [m/s^2]"));
    assert_eq!((lines[0].len(), lines[0][28]), (29, "power [W]"));
    let read: Vec<f64> = lines[2].iter().map(|x| x.parse().unwrap()).collect();
    assert_eq!(read[1..10], *motion.q(1));
    assert_eq!(read[19..28], *motion.qdd(1));
    let error = motion.write_csv(path.join("below a file.csv")).unwrap_err();
    assert!(error.to_string().contains("below a file.csv"), "{error}");
    std::fs::remove_dir_all(folder).unwrap();
}
