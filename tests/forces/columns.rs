//! All forces as columns: their names, in their order, and names that none has.

use kin::loads::Friction;
use kin::prelude::*;
use kin::{Error, Load, Mechanism};

use crate::both::Engines;

const O: Vec2 = Vec2::new(0.0, 0.0);

/// An arm in the plane, a wheel in space, and a bar that nothing loads.
fn machine() -> Mechanism {
    let mut m = Mechanism::new("machine");
    let arm = m.planar("arm", pose(0.0, 0.0, 0.3)).expect("a body");
    m.mass(arm, 2.0, vec2(0.3, 0.1), 0.05).expect("a mass");
    m.add("pin", revolute(arm, m.ground(), O, O)).expect("a joint");
    m.friction("pin", Friction::pin(0.1, 0.01, 0.1)).expect("friction");
    m.add("motor", drive_angle(arm, Law::linear(0.3, 2.0))).expect("a driver");
    let zero = vec3(0.0, 0.0, 0.0);
    let x = vec3(1.0, 0.0, 0.0);
    let wheel = m.spatial("wheel", SpatialPose::at(zero)).expect("a body");
    m.add("hub", spatial::revolute(wheel, m.ground(), zero, zero, x, x)).expect("a joint");
    m.add("spin", spatial::drive_turn(wheel, m.ground(), x, x, Law::ramp(2.0))).expect("a driver");
    m.load("push", Load::force(wheel, zero, vec3(0.0, 3.0, 4.0))).expect("a load");
    let bar = m.planar("bar", pose(0.0, 0.0, 0.0)).expect("a body");
    m.add("idle", revolute(bar, arm, O, vec2(0.5, 0.0))).expect("a joint");
    m.add("level", drive_angle(bar, Law::constant(0.0))).expect("a driver");
    m.gravity(vec2(0.0, -9.81));
    m
}

const NAMES: [&str; 38] = [
    "motor",
    "motor.power",
    "spin",
    "spin.power",
    "level",
    "level.power",
    "pin on arm.F_x",
    "pin on arm.F_y",
    "pin on arm.T",
    "motor on arm.F_x",
    "motor on arm.F_y",
    "motor on arm.T",
    "hub on wheel.F_x",
    "hub on wheel.F_y",
    "hub on wheel.F_z",
    "hub on wheel.T_x",
    "hub on wheel.T_y",
    "hub on wheel.T_z",
    "spin on wheel.F_x",
    "spin on wheel.F_y",
    "spin on wheel.F_z",
    "spin on wheel.T_x",
    "spin on wheel.T_y",
    "spin on wheel.T_z",
    "idle on bar.F_x",
    "idle on bar.F_y",
    "idle on bar.T",
    "idle on arm.F_x",
    "idle on arm.F_y",
    "idle on arm.T",
    "level on bar.F_x",
    "level on bar.F_y",
    "level on bar.T",
    "pin.friction on arm.F_x",
    "pin.friction on arm.F_y",
    "pin.friction on arm.T",
    "pin.friction.power",
    "T",
];

#[test]
fn every_number_has_a_column_in_order() {
    let system = machine().build().expect("a system");
    let motion = system.run_both(linspace(0.0, 1.0, 5)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let columns = forces.columns();
    let names: Vec<&str> = columns.iter().map(|column| column.name()).collect();
    assert_eq!(names, [&NAMES[..], &["V"]].concat());
    for column in &columns {
        assert_eq!(column.values().len(), 5);
        assert_eq!(forces.named(column.name()).expect("a column"), *column);
    }
    match forces.named("pin on bar.F_x") {
        Err(Error::UnknownName { what, name, known }) => {
            assert_eq!(
                (what, name.as_str(), known.len()),
                ("column of forces", "pin on bar.F_x", 39)
            );
        }
        other => panic!("{other:?}"),
    }
    // Of joints that hold something, on the first of their bodies.
    let sizes = forces.magnitudes();
    let told: Vec<(&str, &str)> = sizes.iter().map(|one| (one.name(), one.unit())).collect();
    assert_eq!(told, [("pin on arm.force", "N"), ("hub on wheel.force", "N")]);
    assert!(sizes[1].values().iter().all(|size| (size - 5.0).abs() < 1e-12));
}

/// A joint whose force is small beside the others, but no rounding, is named, whichever unit forces
/// have.
#[test]
fn small_forces_are_told_beside_large_ones() {
    for scale in [1.0, 1e6, 1e-6] {
        let mut m = Mechanism::new("bars");
        for (name, push) in [("light", 1e-6), ("heavy", 1.0), ("idle", 0.0)] {
            let bar = m.planar(name, pose(0.0, 0.0, 0.0)).expect("a body");
            m.add(&format!("{name} pin"), revolute(bar, m.ground(), O, O)).expect("a joint");
            m.add(&format!("{name} motor"), drive_angle(bar, Law::ramp(1.0))).expect("a driver");
            m.load(
                name,
                Load::force(bar, O, [Law::sine(push * scale, 2.0, 0.0), Law::constant(0.0)]),
            )
            .expect("a load");
        }
        let system = m.build().expect("a system");
        let motion = system.run_both(linspace(0.0, 1.0, 5)).expect("a motion");
        let sizes = system.forces(&motion).expect("forces").magnitudes();
        let told: Vec<&str> = sizes.iter().map(|one| one.name()).collect();
        assert_eq!(told, ["light pin on light.force", "heavy pin on heavy.force"], "{scale}");
    }
}

#[test]
fn names_are_checked_before_a_run() {
    let system = machine().build().expect("a system");
    let told = |names: &[&str]| match system.check_columns(names, 0.0) {
        Ok(()) => String::new(),
        Err(Error::UnknownName { what, name, known }) => {
            assert_eq!(what, "measure, coordinate or column of forces");
            for own in ["pin.angle", "arm.R_x", "wheel.e0", "motor", "V"] {
                assert!(known.iter().any(|known| known == own), "{own}: {known:?}");
            }
            name
        }
        Err(other) => panic!("{other}"),
    };
    assert_eq!(told(&["pin.angle", "arm.R_x", "motor", "pin on arm.F_y", "V"]), "");
    assert_eq!(told(&["arm.theta"]), "");
    assert_eq!(told(&["arm.R_x", "pin on bar.F_x", "nothing"]), "pin on bar.F_x");
    assert_eq!(told(&["nothing", "motor"]), "nothing");
    // Where nothing has forces, only what can be measured has a name.
    let mut m = Mechanism::new("arm");
    let arm = m.planar("arm", pose(0.0, 0.0, 0.3)).expect("a body");
    m.add("pin", revolute(arm, m.ground(), O, O)).expect("a joint");
    m.add("motor", drive_angle(arm, Law::linear(0.3, 2.0))).expect("a driver");
    let system = m.build().expect("a system");
    assert!(system.check_columns(&["arm.theta", "pin.angle"], 0.0).is_ok());
    match system.check_columns(&["motor"], 0.0) {
        Err(Error::UnknownName { name, .. }) => assert_eq!(name, "motor"),
        other => panic!("{other:?}"),
    }
}
