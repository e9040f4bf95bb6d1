//! Poses, guesses and links between points that hang on dimensions: set, they are those of a
//! mechanism built so.

use kin::Mechanism;
use kin::data::Registry;
use kin::prelude::*;

use crate::engines::Engines;
use crate::{apart, times};

/// A door of two hinges whose frame is `out` from the axis, told by its pose: set by dimensions, or
/// built.
fn door<N: kin::dimension::IntoNumber>(
    m: &mut Mechanism,
    [out, angle]: [N; 2],
) -> kin::Result<SpatialBody> {
    let z = vec3(0.0, 0.0, 1.0);
    let pose = SpatialPose::turned([out, N::from(0.0), N::from(0.3)], z, angle);
    let door = m.spatial("door", pose)?;
    let at = (out, N::from(0.0), N::from(0.3));
    m.add(
        "hinge",
        spatial::revolute(Ground, door, (0.0, 0.0, 0.3), [-at.0, at.1, N::from(0.0)], z, z),
    )?;
    m.add("motor", spatial::drive_turn(door, Ground, z, z, Law::linear(0.2, 1.0)))?;
    Ok(door)
}

#[test]
fn the_pose_of_a_spatial_body_hangs_on_dimensions() -> kin::Result<()> {
    let mut m = Mechanism::new("door");
    let [out, angle] = [("out", 0.4), ("angle", 0.3)].map(|(name, x)| m.dimension(name, x));
    door(&mut m, [out?, angle?])?;
    let mut system = m.clone().build()?;
    system.set("out", 0.55)?;
    system.set("angle", 0.1)?;
    let mut plain = Mechanism::new("door");
    door(&mut plain, [0.55, 0.1])?;
    let built = plain.build()?;
    let off = system.initial().iter().zip(built.initial()).map(|(a, b)| (a - b).abs());
    assert!(off.fold(0.0, f64::max) < 1e-15, "{:?} {:?}", system.initial(), built.initial());
    assert!(apart(&system.run_both(times())?, &built.run_both(times())?) < 1e-13);
    // A file carries the expressions.
    let mut again = Mechanism::from_data(&m.data()?, &Registry::new())?.build()?;
    again.set("out", 0.55)?;
    again.set("angle", 0.1)?;
    assert_eq!(again.initial(), system.initial());
    Ok(())
}

#[test]
fn one_end_of_a_link_may_be_a_plain_point() -> kin::Result<()> {
    let mut m = Mechanism::new("rod");
    let reach = m.dimension("reach", 3.0)?;
    let rod = m.link_between("rod", (0.0, 0.0), (reach, 4.0))?;
    m.add("O", revolute(rod, Ground, rod.start(), (0.0, 0.0)))?;
    m.add("motor", drive_angle(rod, Law::ramp(1.0)))?;
    let mut system = m.build()?;
    system.set("reach", 7.5)?;
    assert_eq!(system.parameter("O.u_i.x")?, -4.25);
    assert_eq!(system.initial()[..2], [3.75, 2.0]);
    Ok(())
}

#[test]
fn guesses_that_are_given_later_hang_on_dimensions_too() -> kin::Result<()> {
    let mut m = Mechanism::new("crank");
    let [a, b] = [("a", 0.3), ("b", 0.1)].map(|(name, x)| m.dimension(name, x));
    let a = a?;
    let b = b?;
    let crank = m.link("crank", a)?;
    let shaft = m.spatial("shaft", SpatialPose::at((0.0, 0.0, 0.0)))?;
    let x = m.length("x", 0.0)?;
    m.set_pose(crank, pose(a / 2.0, b, 0.2))?;
    m.set_spatial_pose(shaft, SpatialPose::at((a, b, 0.0)))?;
    m.guess(x, a + b)?;
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0)))?;
    m.add("motor", drive_angle(crank, Law::ramp(1.0)))?;
    m.add(
        "held",
        spatial::fixed(shaft, (0.0, 0.0, 0.0), EulerParameters::new(1.0, 0.0, 0.0, 0.0)),
    )?;
    m.add("pump", drive(x, Law::ramp(1.0)))?;
    let mut system = m.clone().build()?;
    system.set("a", 0.5)?;
    let column = |name: &str| {
        let place = system.coordinate_names().iter().position(|known| known == name);
        system.initial()[place.expect("a coordinate")]
    };
    let all = ["crank.R_x", "crank.R_y", "crank.theta", "shaft.R_x", "shaft.R_y", "x"].map(column);
    assert_eq!(all, [0.25, 0.1, 0.2, 0.5, 0.1, 0.6]);
    // One that is given once more as a number stays.
    m.guess(x, 0.9)?;
    let mut system = m.build()?;
    system.set("a", 0.5)?;
    assert_eq!(system.initial().last(), Some(&0.9));
    Ok(())
}

/// A four-bar drawn by its points: B is at (bx, by).
fn drawn<N: kin::dimension::IntoNumber>(m: &mut Mechanism, b: [N; 2]) -> kin::Result<()> {
    let crank = m.link_between("crank", (0.0, 0.0), (0.1, 0.0))?;
    let coupler = m.link_between("coupler", [N::from(0.1), N::from(0.0)], b)?;
    let rocker = m.link_between("rocker", [N::from(0.4), N::from(0.0)], b)?;
    m.add("O", revolute(Ground, crank, (0.0, 0.0), crank.start()))?;
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
    m.add("C", revolute(Ground, rocker, (0.4, 0.0), rocker.start()))?;
    m.add("motor", drive_angle(crank, Law::ramp(2.0)))?;
    Ok(())
}

#[test]
fn a_link_between_points_hangs_on_them() -> kin::Result<()> {
    let mut m = Mechanism::new("four-bar");
    let [x, y] = [("x", 0.3), ("y", 0.25)].map(|(name, x)| m.dimension(name, x));
    drawn(&mut m, [x?, y?])?;
    let mut system = m.build()?;
    system.set("x", 0.34)?;
    system.set("y", 0.22)?;
    let mut plain = Mechanism::new("four-bar");
    drawn(&mut plain, [0.34, 0.22])?;
    let built = plain.build()?;
    assert!(apart(&system.run_both(times())?, &built.run_both(times())?) < 1e-13);
    let names: Vec<String> = system.parameters().into_iter().map(|(name, _)| name).collect();
    for name in ["A.u_j.x", "B.u_i.x", "B.u_j.x", "C.u_j.x"] {
        assert!(names.iter().any(|known| known == name), "{names:?}");
        assert!((system.parameter(name)? - built.parameter(name)?).abs() < 1e-16, "{name}");
    }
    Ok(())
}
