//! Mistakes with masses and loads are told by name.

use kin::prelude::*;
use kin::{Load, Mechanism};

use crate::both::Engines;

fn arm() -> (Mechanism, Link) {
    let mut m = Mechanism::new("arm");
    let arm = m.link("arm", 0.5).expect("a link");
    m.add("O", revolute(m.ground(), arm, vec2(0.0, 0.0), arm.start())).expect("a pin");
    m.add("motor", drive_angle(arm, Law::ramp(2.0))).expect("a driver");
    (m, arm)
}

fn told<T>(result: kin::Result<T>) -> String {
    result.err().map(|error| error.to_string()).unwrap_or_default()
}

#[test]
fn masses_that_no_body_can_have() {
    let (mut m, arm) = arm();
    assert_eq!(
        told(m.mass(arm, 0.0, vec2(0.0, 0.0), 0.1)),
        "`arm` (mass): the mass is 0. Give a value above zero"
    );
    assert!(told(m.mass(arm, f64::NAN, vec2(0.0, 0.0), 0.1)).contains("the mass is NaN"));
    assert!(told(m.mass(arm, 1.0, vec2(f64::INFINITY, 0.0), 0.1)).contains("the centre is inf"));
    assert!(told(m.mass(arm, 1.0, vec2(0.0, 0.0), -0.1)).contains("below zero"));
    let ground = PlanarBody::from(m.ground());
    assert!(
        told(m.mass(ground, 1.0, vec2(0.0, 0.0), 0.1))
            .starts_with("`ground` (mass): the ground does not move")
    );
    let other = Mechanism::new("other").link("arm", 1.0).expect("a link");
    assert!(told(m.mass(other, 1.0, vec2(0.0, 0.0), 0.1)).contains("does not belong to \"arm\""));
    let body = m.spatial("plate", SpatialPose::at(vec3(0.0, 0.0, 0.0))).expect("a body");
    let tensor = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 3.0]];
    assert!(
        told(m.mass(body, 1.0, vec3(0.0, 0.0, 0.0), tensor))
            .contains("more than the sum of the others")
    );
}

/// In a file each number of a mass can be missing.
#[test]
fn a_mass_without_a_centre_in_a_file() {
    let (mut m, arm) = arm();
    m.mass(arm, 1.0, vec2(0.1, 0.0), 0.1).expect("a mass");
    let whole = serde_json::to_value(m.data().expect("data")).expect("a value");
    for number in ["mass", "centre", "inertia", "body"] {
        let mut data = whole.clone();
        data["masses"][0].as_object_mut().expect("a mass").remove(number).expect("a number");
        let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"))
            .join(format!("without_{number}.json"));
        std::fs::write(&path, data.to_string()).expect("a file");
        let told = told(Mechanism::read_json(&path, &kin::data::Registry::new()));
        assert!(told.contains(&format!("`/masses/0` lacks the key `{number}`")), "{told}");
    }
}

#[test]
fn loads_that_make_no_sense() {
    let (mut m, arm) = arm();
    let ground = PlanarBody::from(m.ground());
    assert!(
        told(m.load("push", Load::force(ground, vec2(0.0, 0.0), vec2(1.0, 0.0))))
            .contains("on the ground")
    );
    assert!(
        told(m.load("push", Load::force(arm, vec2(f64::NAN, 0.0), vec2(1.0, 0.0))))
            .contains("a coordinate of the point of the load is NaN")
    );
    let push = || Load::force(arm, arm.end(), vec2(1.0, f64::NAN));
    assert!(
        told(m.load("push", push())).starts_with("`push` (load)"),
        "{}",
        told(m.load("push", push()))
    );
    let other = Mechanism::new("other").link("arm", 1.0).expect("a link");
    assert!(told(m.load("push", Load::torque(other, 1.0))).contains("does not belong to \"arm\""));
    m.load("push", Load::torque(arm, 1.0)).expect("a load");
    assert!(
        told(m.load("push", Load::torque(arm, 1.0))).contains("two loads have the name `push`")
    );
    assert!(
        told(m.load(" ", Load::torque(arm, 1.0)))
            .contains("a load has an empty name. Give the load a name")
    );
    let turn = Load::along(revolute(ground, arm, vec2(0.0, 0.0), arm.start()), |_, _, _| 1.0);
    assert!(
        told(m.load("both", turn))
            .contains("a load acts along one number, but this constraint has 2 rows")
    );
}

#[test]
fn an_energy_is_no_constraint() {
    let (mut m, arm) = arm();
    let spring = kin::loads::spring(m.ground(), arm, vec2(0.0, 1.0), arm.end(), 10.0, 0.2);
    assert_eq!(
        told(m.add("closer", spring.clone())),
        "`closer` (spring): an energy is a load, not a constraint. Add the energy by `m.load(…)`"
    );
    m.load("closer", spring).expect("a load");
}

#[test]
fn gravity_that_is_not_finite_is_told_at_build() {
    let (mut m, arm) = arm();
    m.mass(arm, 1.0, vec2(0.0, 0.0), 0.1).expect("a mass");
    m.gravity(vec2(0.0, f64::NAN));
    assert!(told(m.build()).contains("`gravity` (acceleration): a component is NaN"));
}

#[test]
fn forces_of_nothing_and_names_that_nothing_has() {
    let (m, _) = arm();
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 1.0]).expect("a motion");
    assert!(
        told(system.forces(&motion))
            .contains("no body of the mechanism has mass, and no load acts")
    );
    let (mut m, arm) = self::arm();
    m.mass(arm, 1.0, vec2(0.0, 0.0), 0.1).expect("a mass");
    let free = m.planar("weight", pose(1.0, 0.0, 0.0)).expect("a body");
    m.add("floor", fixed(free, vec2(1.0, 0.0), 0.0)).expect("a joint");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 1.0]).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    assert!(told(forces.reaction("A").map(|_| ())).contains("there is no constraint `A`"));
    assert!(told(forces.drive("O")).contains("there is no driver `O`"));
    assert!(told(forces.load("spring").map(|_| ())).contains("there is no load `spring`"));
    let on = forces.reaction("O").expect("a joint").on(free).map(|_| ());
    assert_eq!(
        told(on),
        "`O` (reaction): the constraint does not act on `weight`. Choose a body on which the constraint acts: arm"
    );
    let acted = forces.reaction("O").expect("a joint").on(arm).expect("its body");
    assert!(told(acted.component("F_z")).contains("there is no component `F_z`"));
}

#[test]
fn a_law_that_is_not_a_number_is_told_with_its_time() {
    let (mut m, arm) = arm();
    m.load("push", Load::along(drive_angle(arm, Law::constant(0.0)), |x, _, _| (1.0 - x).sqrt()))
        .expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 1.0]).expect("a motion");
    let told = told(system.forces(&motion));
    assert!(told.contains("force of `push`") && told.contains("t = 1 s"), "{told}");
}

#[test]
fn units_of_forces_are_told() {
    let (mut m, arm) = arm();
    m.units("mm", "s").mass("t");
    m.mass(arm, 1.0, vec2(100.0, 0.0), 0.1).expect("a mass");
    m.gravity(vec2(0.0, -9810.0));
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 1.0]).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    assert_eq!(forces.drive("motor").expect("a driver").effort().unit(), "N mm");
    let on = forces.reaction("O").expect("a joint").on(arm).expect("its body");
    assert_eq!((on.magnitude().expect("unique").unit(), forces.balance().left.unit()), ("N", "mW"));
    m = Mechanism::new("nameless");
    m.units("mm", "s").mass(" ");
    assert!(
        told(m.build()).contains("a unit of mass has an empty name. Give the unit of mass a name")
    );
}

/// Units that contradict one another are told at build, each by what contradicts what.
#[test]
fn contradictory_units() {
    let with = |describe: &dyn Fn(&mut Mechanism)| {
        let (mut m, arm) = arm();
        m.mass(arm, 1.0, vec2(0.0, 0.0), 0.1).expect("a mass");
        describe(&mut m);
        told(m.build())
    };
    let twice = with(&|m| {
        m.units("mm", "s").mass("t");
        m.units("m", "s");
    });
    assert_eq!(
        twice,
        "`units` (words): your code declares the units mm, s and t, and later the units m, s and t. Kin converts no units, so declare the units once"
    );
    let masses = with(&|m| {
        m.units("mm", "s").mass("t");
        m.units("mm", "s").mass("kg");
    });
    assert!(
        masses.contains("declares the units mm, s and t, and later the units mm, s and kg"),
        "{masses}"
    );
    let same = with(&|m| {
        m.units("mm", "s").mass("t");
        m.units("mm", "s").mass("t");
        m.gravity(vec2(0.0, -9810.0));
    });
    assert_eq!(same, "");
    let swapped = with(&|m| m.units("s", "mm").mass("kg"));
    assert!(
        swapped.contains("`s` is a unit of time, but your code gives it as the unit of length"),
        "{swapped}"
    );
    let force = with(&|m| m.units("mm", "s").mass("N"));
    assert!(
        force.contains("`N` is a unit of force, but your code gives it as the unit of mass"),
        "{force}"
    );
}

/// The number 9.81 is the earth's gravity in metres and seconds alone.
#[test]
fn gravity_in_other_units() {
    let with = |length: &str, time: &str, g: f64| {
        let (mut m, arm) = arm();
        m.mass(arm, 1.0, vec2(0.0, 0.0), 0.1).expect("a mass");
        m.units(length, time);
        m.gravity(vec2(0.6 * g, -0.8 * g));
        told(m.build())
    };
    assert_eq!(
        with("mm", "s", 9.81),
        "`gravity` (acceleration): 9.81 mm/s^2 is the earth's gravity in other units. In mm/s^2 the earth's gravity is 9806.65. Give gravity in the units of the mechanism, or declare the units by `m.units(length, time).mass(mass)`"
    );
    assert!(with("m", "s", 9810.0).contains("In m/s^2 the earth's gravity is 9.80665"));
    assert!(with("mm", "ms", 9.81).contains("In mm/ms^2 the earth's gravity is 0.00980665"));
    for (length, time, g) in [
        ("mm", "s", 9810.0),
        ("cm", "s", 981.0),
        ("mm", "ms", 9.81e-3),
        ("m", "s", 9.81),
        // The moon's, a centrifuge, a drop tower, units that are not known.
        ("m", "s", 1.62),
        ("m", "s", 5000.0),
        ("m", "s", 9.81e-6),
        ("in", "s", 386.1),
    ] {
        assert_eq!(with(length, time, g), "", "{length} {time} {g}");
    }
}

/// A dimension in another unit of length than the mechanism.
#[test]
fn dimensions_in_other_units() {
    let with = |unit: &str| {
        let mut m = Mechanism::new("arm");
        m.units("mm", "s");
        let length = m.dimension("reach", 0.5).expect("a dimension").unit(unit);
        let arm = m.link("arm", length).expect("a link");
        m.add("O", revolute(m.ground(), arm, vec2(0.0, 0.0), arm.start())).expect("a pin");
        m.add("motor", drive_angle(arm, Law::ramp(2.0))).expect("a driver");
        told(m.build())
    };
    assert_eq!(
        with("m"),
        "`reach` (dimension): the dimension is in m, but the mechanism has lengths in mm. Kin converts no units, so give the dimension in mm"
    );
    assert_eq!(
        (with("mm"), with("rad"), with("mm^2")),
        (String::new(), String::new(), String::new())
    );
}
