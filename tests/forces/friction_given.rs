//! Friction as it is given: what makes no sense, and files.

use kin::data::Registry;
use kin::loads::Friction;
use kin::prelude::*;

use crate::both::Engines;
use crate::friction::{O, X, inclined, pushed};

#[test]
fn friction_that_makes_no_sense_is_refused_by_name() {
    let (mut m, block) = inclined(0.1, 0.4, 1.0, Law::ramp(1.0));
    m.add("rod", distance(block, m.ground(), O, vec2(3.0, 3.0), 4.0)).expect("a joint");
    let mut told =
        |joint: &str, friction: Friction| m.friction(joint, friction).unwrap_err().to_string();
    let slide =
        |mu: f64, length: f64, width: f64, rate: f64| Friction::slide(mu, [length, width], rate);
    for (friction, due) in [
        (
            slide(-0.1, 0.4, 0.0, 1.0),
            "the coefficient of friction is -0.1. Give a value of at least zero",
        ),
        (
            slide(f64::NAN, 0.4, 0.0, 1.0),
            "the coefficient of friction is NaN. Give a value of at least zero",
        ),
        (slide(0.1, 0.0, 0.0, 1.0), "the length of the guide is 0. Give a value above zero"),
        (
            slide(0.1, f64::INFINITY, 0.0, 1.0),
            "the length of the guide is inf. Give a value above zero",
        ),
        (
            slide(0.1, 0.4, -0.1, 1.0),
            "the width of the guide is -0.1. Give a value of at least zero",
        ),
        (
            slide(0.1, 0.4, 0.1, 0.0),
            "the velocity at which friction reaches its full size is 0. Give a value above zero",
        ),
        (
            slide(0.1, 0.4, 0.1, -1.0),
            "the velocity at which friction reaches its full size is -1. Give a value above zero",
        ),
        (
            slide(0.1, 0.4, 0.1, f64::NAN),
            "the velocity at which friction reaches its full size is NaN. Give a value above zero",
        ),
        (Friction::pin(0.1, 0.0, 1.0), "the radius of the pin is 0. Give a value above zero"),
        (
            Friction::pin(0.1, 0.02, 1.0),
            "friction of a pin needs one of the joints `revolute` and `cylindrical`, but the joint is `prismatic`",
        ),
    ] {
        assert_eq!(told("incline", friction), format!("`incline` (friction): {due}"));
    }
    assert!(told("rod", slide(0.1, 0.4, 0.1, 1.0)).contains("but the joint is `distance`"));
    assert!(told("slide", slide(0.1, 0.4, 0.1, 1.0)).starts_with("there is no constraint `slide`"));
    let body = m.spatial("body", SpatialPose::at(Vec3::zeros())).expect("a body");
    let o = Vec3::zeros();
    let own = EulerParameters::new(1.0, 0.0, 0.0, 0.0);
    m.add("rail", spatial::prismatic(body, m.ground(), o, o, X, own)).expect("a joint");
    let told = m.friction("rail", slide(0.1, 0.4, 0.0, 1.0)).unwrap_err().to_string();
    assert!(told.contains("by its width. Give a width above zero"), "{told}");
    let (m, _) = inclined(0.1, 0.4, 1.0, Law::ramp(1.0));
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 1.0]).expect("a motion");
    let told = system
        .forces(&motion)
        .expect("forces")
        .friction("winch")
        .map(|_| ())
        .unwrap_err()
        .to_string();
    assert_eq!(told, "there is no joint with friction `winch`. Use `incline`");
}

/// Pin joint by the name of the library's, whose first vector is another thing.
#[constraint]
fn revolute(i: Planar, j: Planar, u_j: Vec2, u_i: Vec2) -> Vec2 {
    i.point(u_j) - j.point(u_i)
}

#[test]
fn friction_of_a_joint_of_ones_own_is_refused_whatever_its_name() {
    let mut m = Mechanism::new("drum");
    let drum = m.planar("drum", pose(0.0, 0.0, 0.0)).expect("a body");
    m.add("shaft", revolute(drum, m.ground(), vec2(0.1, 0.0), O)).expect("a joint");
    let told = m.friction("shaft", Friction::pin(0.1, 0.02, 1.0)).unwrap_err().to_string();
    let due = "`shaft` (friction): friction of a pin needs one of the joints `revolute` and `cylindrical`, but the joint is `revolute`, which is user-defined";
    assert_eq!(told, due);
}

#[test]
fn friction_comes_back_from_a_file_and_stands_in_the_table() {
    let mut m = pushed(0.3, [0.2, 0.1], 0.3, [0.2, 0.5]);
    let arm = m.link("arm", 0.4).expect("a link");
    m.add("O", kin::prelude::revolute(arm, m.ground(), arm.start(), O)).expect("a joint");
    m.friction("O", Friction::pin(0.2, 0.03, 0.5)).expect("friction");
    m.add("motor", drive_angle(arm, Law::ramp(1.0))).expect("a driver");
    m.mass(arm, 3.0, O, 0.1).expect("a mass");
    let data = m.data().expect("data");
    let text = serde_json::to_string(&data).expect("writes");
    assert!(
        text.contains(r#""frictions":[{"joint":"guide","coefficient":0.3,"rate":1e-6,"slide":{"length":0.2,"width":0.1}},{"joint":"O","coefficient":0.2,"rate":0.5,"pin":{"radius":0.03}}]"#),
        "{text}"
    );
    let again: kin::data::MechanismData = serde_json::from_str(&text).expect("reads");
    assert_eq!(again, data);
    let columns = |m: Mechanism| {
        let system = m.build().expect("a system");
        let motion = system.run_both(linspace(0.0, 0.5, 6)).expect("a motion");
        system.forces(&motion).expect("forces").columns()
    };
    let back = columns(Mechanism::from_data(&again, &Registry::new()).expect("the same"));
    assert_eq!(back, columns(m));
    let names: Vec<&str> = back.iter().map(|column| column.name()).collect();
    for due in ["guide.friction on block.F_x", "O.friction on arm.T", "O.friction.power"] {
        assert!(names.contains(&due), "{names:?}");
    }
    let reject = |text: &str| serde_json::from_str::<kin::data::MechanismData>(text).is_err();
    assert!(reject(&text.replace("\"radius\":0.03", "\"radius\":0.03,\"rad\":1")));
    assert!(reject(&text.replace("\"rate\":0.5", "\"rate\":0.5,\"v\":1")));
    assert!(reject(&text.replace(",\"pin\":{\"radius\":0.03}", "")));
    let wrong =
        serde_json::from_str(&text.replace("\"rate\":0.5", "\"rate\":-0.5")).expect("reads");
    let told = Mechanism::from_data(&wrong, &Registry::new()).map(|_| ()).unwrap_err().to_string();
    assert_eq!(
        told,
        "`O` (friction): the velocity at which friction reaches its full size is -0.5. Give a value above zero"
    );
}
