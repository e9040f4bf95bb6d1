//! Names, and values that are refused by name.

use super::models::*;
use super::*;
use crate::coordinates::{Ground, any_planar};
use crate::model::mechanism::{Mechanism, SpatialPose, pose};
use crate::outcome::error::Error;
use crate::solve::options::{SolverOptions, Stop};
use crate::system::System;

#[test]
fn systems_cross_threads() {
    fn sent<T: Send + Sync + 'static>() {}
    sent::<System>();
    sent::<crate::solve::motion::Motion>();
}

#[test]
fn not_square_names_what_is_untouched() {
    let mut m = Mechanism::new("arm");
    let a = m.link("a", 1.0).unwrap();
    m.link("spare", 1.0).unwrap();
    m.add("O", revolute(Ground, a, v(0.0, 0.0), a.start())).unwrap();
    m.add("motor", drive_angle(a, Law::ramp(1.0))).unwrap();
    let error = m.build().unwrap_err();
    let found = error.diagnosis().unwrap();
    assert_eq!(
        (found.coordinates, found.equations, found.rank, found.freedoms.len()),
        (6, 3, 3, 3)
    );
    assert!(
        found
            .freedoms
            .iter()
            .all(|freedom| freedom.motions.len() == 1 && freedom.motions[0].names == ["spare"]),
        "{error}"
    );
}

#[test]
fn spatial_bodies_bring_their_norm() {
    let mut m = Mechanism::new("space");
    let p = crate::numbers::algebra::Vec3::new(1.0, 2.0, 3.0);
    m.spatial("platform", SpatialPose::at(p)).unwrap();
    let error = m.build().unwrap_err();
    let found = error.diagnosis().unwrap();
    assert_eq!((found.coordinates, found.equations, found.freedoms.len()), (7, 1, 6), "{error}");
}

#[test]
fn constraints_are_refused_by_name() {
    let mut m = Mechanism::new("m");
    let a = m.link("a", 1.0).unwrap();
    let o = v(0.0, 0.0);
    assert!(
        matches!(m.add("O", revolute(a, a, o, o)), Err(Error::RepeatedBody { name, .. }) if name == "a")
    );
    let same = Follow { x: a.x(), other: a.x(), law: Law::ramp(1.0) };
    assert!(matches!(m.add("O", same), Err(Error::RepeatedBody { name, .. }) if name == "a.R_x"));
    assert!(
        matches!(m.add("O", revolute(Ground, Ground, o, o)), Err(Error::NoCoordinates { row, .. }) if row == "x")
    );
    assert!(
        matches!(m.add("O", revolute(any_planar(), a, o, o)), Err(Error::ForeignBody { argument, .. }) if argument == "i")
    );
    let nan = m.add("O", revolute(Ground, a, o, v(0.0, f64::NAN)));
    assert!(
        matches!(nan, Err(Error::ParameterNotFinite { parameter, .. }) if parameter == "u_j.y")
    );
    let nan = m.add("O", drive_angle(a, Law::ramp(f64::INFINITY)));
    assert!(
        matches!(nan, Err(Error::ParameterNotFinite { parameter, .. }) if parameter == "law.rate")
    );
    assert!(matches!(m.add("", drive_angle(a, Law::ramp(1.0))), Err(Error::EmptyName { .. })));
    m.add("O", drive_angle(a, Law::ramp(1.0))).unwrap();
    assert!(matches!(m.add("O", drive_angle(a, Law::ramp(1.0))), Err(Error::DuplicateName { .. })));
    assert!(matches!(m.link("b", 0.0), Err(Error::InvalidLength { .. })));
    assert!(
        matches!(m.planar("b", pose(0.0, f64::NAN, 0.0)), Err(Error::InitialNotFinite { coordinate, .. }) if coordinate == "b.R_y")
    );
    m.prefer(a, f64::NAN);
    assert!(matches!(m.build(), Err(Error::InitialNotFinite { .. })));
}

#[test]
fn handles_of_another_mechanism_are_foreign() {
    let mut m = Mechanism::new("m");
    let mut other = Mechanism::new("other");
    let a = m.link("a", 1.0).unwrap();
    let b = other.link("a", 1.0).unwrap();
    let error = m.add("A", revolute(a, b, a.end(), b.start())).unwrap_err();
    assert!(matches!(&error, Error::ForeignBody { argument, .. } if argument == "j"), "{error}");
    assert!(m.set_pose(b, pose(0.0, 0.0, 0.0)).is_err() && m.guess(b.theta(), 1.0).is_err());
}

#[test]
fn times_and_options_are_checked() {
    let system = two_link(1.0);
    for times in
        [vec![], vec![0.0, f64::NAN], vec![0.0, 0.0], vec![0.0, 1.0, 0.5], vec![f64::INFINITY]]
    {
        assert!(matches!(system.run(&times), Err(Error::InvalidTimes { .. })), "{times:?}");
    }
    let options = SolverOptions::new().stop(Stop::Converged { tolerance: f64::NAN });
    assert!(matches!(
        system.solver().options(options.clone()).run([0.0]),
        Err(Error::InvalidOptions { .. })
    ));
    assert!(matches!(
        system.residual(&[0.0], 0.0),
        Err(Error::WrongLength { expected: 9, found: 1, .. })
    ));
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
    assert!(
        matches!(system.set("C.k", 1.0), Err(Error::UnknownName { known, .. }) if known.len() == 4)
    );
    assert!(system.set("nothing", 1.0).is_err() && system.set("motor.law.rate", 1.0).is_err());
}

#[test]
fn names_follow_the_order_of_declaration_and_addition() {
    let system = two_link(1.0);
    assert_eq!(system.coordinate_names()[3..6], ["body2.R_x", "body2.R_y", "body2.theta"]);
    let names =
        ["ground.x", "ground.y", "ground.theta", "O.x", "O.y", "A.x", "A.y", "link2", "link3"];
    assert_eq!(system.equation_names(), names);
    assert_eq!(system.constraint_names(), ["ground", "O", "A", "link2", "link3"]);
}

#[test]
fn file_has_every_digit_and_its_headers() {
    let mut motion = two_link(1.0).run([0.0, 0.1]).unwrap();
    motion.add_output("power", "W", vec![1.0, 2.0]).unwrap();
    assert!(
        motion.add_output("power", "W", vec![1.0, 2.0]).is_err()
            && motion.add_output("x", "m", vec![f64::NAN, 0.0]).is_err()
    );
    assert!(motion.add_output("x", "m", vec![0.0]).is_err());
    let folder = std::env::temp_dir().join(format!("kin-motion-{}", std::process::id()));
    let path = folder.join("deep/motion.csv");
    motion.write_csv(&path).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines[0][0], "t [s]");
    assert_eq!(
        (lines[0][3], lines[0][10], lines[0][19]),
        ("body1.theta [rad]", "body1.R_x' [m/s]", "body1.R_x'' [m/s^2]")
    );
    assert_eq!((lines[0].len(), lines[0][28]), (29, "power [W]"));
    let read: Vec<f64> = lines[2].iter().map(|x| x.parse().unwrap()).collect();
    assert_eq!(read[1..10], *motion.q(1));
    assert_eq!(read[19..28], *motion.qdd(1));
    let error = motion.write_csv(path.join("below a file.csv")).unwrap_err();
    assert!(error.to_string().contains("below a file.csv"), "{error}");
    std::fs::remove_dir_all(folder).unwrap();
}
