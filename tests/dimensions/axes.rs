//! Axes, turns and spatial links that hang on dimensions: set, they are those of a mechanism built
//! so.

use kin::data::Registry;
use kin::dimension::IntoNumber;
use kin::extend::Lanes;
use kin::mechanism::IntoAxis;
use kin::prelude::*;
use kin::{Axis, Dimension, Mechanism};

use crate::engines::Engines;
use crate::{apart, same_bits, times};

const FROM: [f64; 2] = [0.2, 1.0];
/// The largest component is another one here, and with it the direction that angles count from by
/// default.
const TO: [f64; 2] = [1.1, 0.4];

/// A door that turns about `axis`, whose direction is `along`, turned about that at first.
fn door<N: IntoNumber>(
    m: &mut Mechanism,
    along: [N; 3],
    axis: impl IntoAxis + Copy,
) -> kin::Result<()> {
    let door = m.spatial("door", SpatialPose::turned((0.0, 0.0, 0.3), along, N::from(0.4)))?;
    m.add("hinge", spatial::revolute(Ground, door, (0.0, 0.0, 0.3), (0.0, 0.0, 0.0), axis, along))?;
    m.add("motor", spatial::drive_turn(door, Ground, axis, axis, Law::linear(0.2, 1.0)))?;
    Ok(())
}

fn with_dimensions(
    axis: impl Fn([Dimension; 3]) -> Axis<Dimension>,
    chosen: bool,
) -> kin::Result<Mechanism> {
    let mut m = Mechanism::new("door");
    let [x, z] = [m.dimension("x", FROM[0])?, m.dimension("z", FROM[1])?];
    let along = [x, 0.0.into(), z];
    if chosen {
        door(&mut m, along, axis(along))?
    } else {
        door(&mut m, along, along)?
    }
    Ok(m)
}

fn plain(axis: impl Fn([f64; 3]) -> Axis, [x, z]: [f64; 2], chosen: bool) -> kin::Result<System> {
    let mut m = Mechanism::new("door");
    let along = [x, 0.0, z];
    if chosen {
        door(&mut m, along, axis(along))?
    } else {
        door(&mut m, along, along)?
    }
    m.build()
}

fn through_a_file(m: &Mechanism) -> Mechanism {
    let text = serde_json::to_string(&m.data().unwrap()).unwrap();
    let again =
        Mechanism::from_data(&serde_json::from_str(&text).unwrap(), &Registry::new()).unwrap();
    assert_eq!(again.data().unwrap(), m.data().unwrap(), "{text}");
    again
}

fn set(system: &mut System, names: [&str; 2], values: [f64; 2]) {
    names.iter().zip(values).for_each(|(name, value)| system.set(name, value).unwrap());
}

#[test]
fn an_axis_hangs_on_dimensions() -> kin::Result<()> {
    let across = [0.3, 1.0, 0.0];
    for chosen in [false, true] {
        let m = with_dimensions(|along| Axis::new(along, across), chosen)?;
        let mut system = m.clone().build()?;
        let nominal = system.run_both(times())?;
        set(&mut system, ["x", "z"], TO);
        let moved = system.run_both(times())?;
        assert!(apart(&moved, &nominal) > 0.1);
        let built = plain(|along| Axis::new(along, across), TO, chosen)?;
        let expected = built.run_both(times())?;
        assert!(apart(&moved, &expected) < 1e-13, "{}", apart(&moved, &expected));
        // Angles count from the same direction.
        let angle =
            |system: &System, motion: &Motion| system.measure(motion, "hinge.angle").unwrap();
        let own = angle(&system, &moved);
        let other = angle(&built, &expected);
        let off = own.value.values().iter().zip(other.value.values()).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-13);
        // In the other order, by a detour, through a file, and by a sweep.
        for mut other in [m.clone().build()?, through_a_file(&m).build()?] {
            set(&mut other, ["z", "x"], [3.0, 0.1]);
            set(&mut other, ["z", "x"], [TO[1], TO[0]]);
            assert!(same_bits(&other.run_both(times())?, &moved));
        }
        let keep = |_: usize, motion: kin::Result<Motion>| motion.unwrap();
        let sweep = m.build()?.sweep(["x", "z"])?.lanes(kin::extend::Lanes::Off).run(
            &[TO],
            times(),
            keep,
        )?;
        assert!(same_bits(&sweep[0], &moved));
    }
    Ok(())
}

#[test]
fn a_spatial_link_between_points_hangs_on_them() -> kin::Result<()> {
    fn crank<N: IntoNumber>(m: &mut Mechanism, b: [N; 3]) -> kin::Result<()> {
        let z = vec3(0.0, 0.0, 1.0);
        let arm = m.spatial_link_between("arm", [0.0, 0.0, 0.1].map(N::from), b)?;
        m.mass(arm, 1.0, (0.0, 0.0, 0.0), Mat3::identity())?;
        m.add("O", spatial::revolute(Ground, arm, (0.0, 0.0, 0.1), arm.start(), z, z))?;
        m.add("motor", spatial::drive_turn(arm, Ground, z, z, Law::linear(0.2, 1.0)))?;
        Ok(())
    }
    let mut m = Mechanism::new("arm");
    let [x, y] = [m.dimension("x", 0.5)?, m.dimension("y", 0.1)?];
    crank(&mut m, [x, y, 0.1.into()])?;
    let mut system = m.clone().build()?;
    set(&mut system, ["x", "y"], [0.2, 0.7]);
    let mut built = Mechanism::new("arm");
    crank(&mut built, [0.2, 0.7, 0.1])?;
    let built = built.build()?;
    assert_eq!(system.initial(), built.initial());
    assert!((system.parameter("O.u_j.x")? - built.parameter("O.u_j.x")?).abs() < 1e-16);
    assert!(apart(&system.run_both(times())?, &built.run(times())?) < 1e-13);
    let mut again = through_a_file(&m).build()?;
    set(&mut again, ["y", "x"], [0.7, 0.2]);
    assert_eq!((again.initial(), again.parameters()), (system.initial(), system.parameters()));
    // A guess that is given later stands on its own.
    let arm = m.spatial_named("arm").expect("the arm");
    m.set_spatial_pose(arm, SpatialPose::at((0.0, 0.0, 0.0)))?;
    let mut system = m.build()?;
    system.set("x", 0.9)?;
    assert_eq!(system.initial()[..3], [0.0; 3]);
    Ok(())
}

/// Derivatives by what an axis hangs on, and by its own components, against differences of motions
/// of systems that are set there (Richardson's extrapolation, h and h/2).
#[test]
fn derivatives_by_an_axis_are_those_of_systems_set_there() -> kin::Result<()> {
    let system = with_dimensions(|along| Axis::new(along, [0.3, 1.0, 0.0]), true)?.build()?;
    let motion = system.run_both(times())?;
    let names = ["x", "z", "hinge.h_i.x", "hinge.h_j.y", "hinge.h_i.y"];
    let all = system.sensitivities(&motion, names)?;
    for name in names {
        let at = |off: f64| -> kin::Result<Vec<f64>> {
            let mut moved = system.clone();
            moved.set(name, system.parameter(name)? + off)?;
            let motion = moved.run_both(times())?;
            Ok((0..motion.len()).flat_map(|k| motion.q(k).to_vec()).collect())
        };
        let difference = |h: f64| -> kin::Result<Vec<f64>> {
            Ok(at(h)?.iter().zip(at(-h)?).map(|(a, b)| (a - b) / (2.0 * h)).collect())
        };
        let coarse = difference(2e-3)?;
        let fine = difference(1e-3)?;
        let by = all.by(name)?;
        let exact: Vec<f64> = (0..motion.len()).flat_map(|k| by.q(k).to_vec()).collect();
        assert!(exact.iter().any(|x| x.abs() > 0.1), "{name}");
        for ((a, b), exact) in coarse.iter().zip(&fine).zip(&exact) {
            let extrapolated = (4.0 * b - a) / 3.0;
            assert!((extrapolated - exact).abs() < 1e-8, "{name}: {extrapolated} {exact}");
        }
    }
    Ok(())
}

/// A turn that a joint takes as a parameter.
#[test]
fn euler_parameters_of_a_joint_hang_on_dimensions() -> kin::Result<()> {
    let mut m = Mechanism::new("plate");
    let angle = m.dimension("angle", 0.4)?;
    let plate = m.spatial("plate", SpatialPose::at((0.0, 0.0, 0.0)))?;
    let turn = SpatialPose::turned((0.0, 0.0, 0.0), (0.0, 0.6, 0.8), angle).p;
    m.add("held", spatial::fixed(plate, (0.0, 0.0, 0.0), turn))?;
    let mut system = m.build()?;
    system.set("angle", 1.0)?;
    let p = &system.run_both([0.0])?.q(0)[3..7].to_vec();
    let expected = [0.5_f64.cos(), 0.0, 0.6 * 0.5_f64.sin(), 0.8 * 0.5_f64.sin()];
    assert!(p.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{p:?}");
    Ok(())
}

#[test]
fn an_axis_without_a_direction_is_refused_and_the_old_one_stays() -> kin::Result<()> {
    let mut m = Mechanism::new("door");
    let z = m.dimension("z", 1.0)?;
    let door = m.spatial("door", SpatialPose::at((0.0, 0.0, 0.0)))?;
    let o = (0.0, 0.0, 0.0);
    let up = (0.0, 0.0, 1.0);
    m.add("hinge", spatial::revolute(Ground, door, o, o, (0.0, 0.0, z), up))?;
    m.add("motor", spatial::drive_turn(door, Ground, up, up, Law::ramp(1.0)))?;
    let mut system = m.build()?;
    let told = system.set("z", 0.0).unwrap_err().to_string();
    assert!(told.contains("hinge") && told.contains("no direction"), "{told}");
    assert_eq!((system.parameter("z")?, system.parameter("hinge.h_i.z")?), (1.0, 1.0));
    Ok(())
}

/// A door whose hinge and motor have plain axes.
fn plain_door(along: [f64; 3]) -> kin::Result<System> {
    let mut m = Mechanism::new("door");
    let door = m.spatial("door", SpatialPose::at((0.0, 0.0, 0.0)))?;
    let o = (0.0, 0.0, 0.0);
    let up = Axis::from((0.0, 0.0, 1.0));
    m.add(
        "hinge",
        spatial::revolute(door, Ground, o, o, Axis::new(along, (1.0, 0.0, 0.0)), (0.0, 0.0, 1.0)),
    )?;
    m.add("motor", spatial::drive_turn(door, Ground, up, up, Law::linear(0.3, 1.0)))?;
    m.build()
}

/// Components of an axis that are set one after the other are those of one direction, whatever was
/// set before.
#[test]
fn an_axis_does_not_remember_what_its_components_were() -> kin::Result<()> {
    let system = plain_door([0.0, 0.0, 1.0])?;
    let at = |system: &System| system.position(1.0).map(|found| found.q);
    let tilted = at(&plain_door([0.2, 0.0, 1.0])?)?;
    for values in [&[0.2][..], &[0.2, 0.2], &[5.0, -3.0, 0.2]] {
        let mut set = system.clone();
        for value in values {
            set.set("hinge.h_i.x", *value)?;
            assert_eq!(set.parameter("hinge.h_i.x")?, *value);
        }
        let off = at(&set)?.iter().zip(&tilted).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
        assert!(off < 1e-14, "{values:?}: {off:e}");
    }
    // All three, from anywhere: the direction is the one that they say.
    let mut set = system.clone();
    for (name, value) in [("x", 5.0), ("y", 1.0), ("z", 1.0), ("x", 0.3), ("y", -0.2), ("z", 2.0)] {
        set.set(&format!("hinge.h_i.{name}"), value)?;
    }
    let expected = at(&plain_door([0.3, -0.2, 2.0])?)?;
    assert!(at(&set)?.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-14));
    // The derivative is that by the component as it was given.
    let times = linspace(0.0, 1.0, 5);
    let motion = set.run(&times)?;
    let h = 1e-5;
    let by = set.sensitivities(&motion, ["hinge.h_i.x"])?;
    let moved = |off: f64| -> kin::Result<Motion> {
        let mut moved = set.clone();
        moved.set("hinge.h_i.x", 0.3 + off)?;
        moved.run(&times)
    };
    let more = moved(h)?;
    let less = moved(-h)?;
    for (k, x) in by.by("hinge.h_i.x")?.q(4).iter().enumerate() {
        let difference = (more.q(4)[k] - less.q(4)[k]) / (2.0 * h);
        assert!((difference - x).abs() < 1e-8, "{k}: {difference} {x}");
    }
    Ok(())
}

#[test]
fn a_component_that_is_refused_leaves_all_as_it_was() -> kin::Result<()> {
    let mut system = plain_door([0.0, 0.0, 1.0])?;
    let before = (system.position(1.0)?, system.parameters());
    let told = system.set("motor.h_i.z", 0.0).unwrap_err().to_string();
    assert!(told.contains("motor") && told.contains("no direction"), "{told}");
    assert_eq!((system.position(1.0)?, system.parameters()), before);
    Ok(())
}

/// Equal cases of a sweep are equal, whatever their neighbours are and wherever they are computed.
#[test]
fn sweeps_over_a_component_of_an_axis_give_equal_cases_equal_motions() -> kin::Result<()> {
    let system = plain_door([0.0, 0.0, 1.0])?;
    let cases: Vec<[f64; 1]> = (0..64).map(|k| [if k % 16 == 0 { 5.0 } else { 0.2 }]).collect();
    let expected = plain_door([0.2, 0.0, 1.0])?.run([0.0, 1.0])?.q(1)[4];
    for (lanes, threads) in [(Lanes::Off, 1), (Lanes::Off, 2), (Lanes::Best, 1), (Lanes::Best, 2)] {
        let sweep = system.sweep(["hinge.h_i.x"])?.lanes(lanes).threads(threads);
        let found =
            sweep.run(&cases, [0.0, 1.0], |_, motion| motion.map(|motion| motion.q(1)[4]))?;
        for (case, found) in cases.iter().zip(found).filter(|(case, _)| case[0] == 0.2) {
            let found = found?;
            assert!(
                (found - expected).abs() < 1e-13,
                "{lanes:?} {threads} {case:?}: {found} {expected}"
            );
        }
        // A case without a direction is told, and no other one is the worse for it.
        let sweep = system.sweep(["motor.h_i.z"])?.lanes(lanes).threads(threads);
        let told = sweep.run(&[[1.0], [0.0], [1.0]], [0.0, 1.0], |_, motion| motion.map(|_| ()))?;
        assert!(told[0].is_ok() && told[2].is_ok(), "{told:?}");
        assert!(
            told[1].as_ref().is_err_and(|error| error.to_string().contains("no direction")),
            "{told:?}"
        );
    }
    Ok(())
}
