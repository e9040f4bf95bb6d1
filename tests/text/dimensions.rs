//! Parameters of equations from text that hang on dimensions, and what files say of them.

use kin::prelude::*;
use kin_text::{Equation, registry};
use serde_json::json;

use crate::engines::Engines;

const RAISED: &str =
    "fn raised_slot(i: Planar, j: Planar, u_i: Vec2, c: [f64; 2], lift: Law, h: Axis) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - c[0] * s.x * s.x - c[1] * h.h.x - lift.at(s.x)
}";

/// A slider in the slot; `k` is everywhere.
fn slot() -> kin::Result<Mechanism> {
    let mut m = Mechanism::new("slot");
    let k = m.dimension("k", 2.0)?;
    let slider = m.planar("slider", pose(0.2, k / 20.0, 0.0))?;
    let equation =
        Equation::read(RAISED).map_err(|mistakes| mistakes.to_string()).expect("it reads");
    let making =
        equation.on(slider).on(m.ground()).with("u_i", (0.0, k / 10.0)).with("c", [k, k * k]);
    let lift = Law::ramp(k) + Law::constant(0.5);
    m.add("slot", making.with("lift", lift).with("h", (k, 1.0, 0.0)).constraint()?)?;
    m.add("upright", drive_angle(slider, Law::constant(0.0)))?;
    m.add("motor", drive(slider.x(), Law::sine(0.3, 1.0, 0.0)))?;
    Ok(m)
}

const HUNG: [(&str, f64, f64); 5] = [
    ("slot.u_i.y", 0.2, 0.3),
    ("slot.c[0]", 2.0, 3.0),
    ("slot.c[1]", 4.0, 9.0),
    ("slot.lift.first.rate", 2.0, 3.0),
    ("slot.lift.second.c", 0.5, 0.5),
];

#[test]
fn parameters_of_an_equation_follow_dimensions_in_programs_and_in_files() -> kin::Result<()> {
    let told = slot()?;
    let read = Mechanism::from_data(&told.data()?, &registry())?;
    for m in [told, read] {
        let mut system = m.build()?;
        for (name, before, _) in HUNG {
            assert_eq!(system.parameter(name)?, before, "{name}");
        }
        system.set("k", 3.0)?;
        for (name, _, after) in HUNG {
            assert_eq!(system.parameter(name)?, after, "{name}");
        }
        assert!((system.parameter("slot.h.x")? - 3.0 / 10.0_f64.sqrt()).abs() < 1e-16);
        let motion = system.run_both(linspace(0.0, 6.0, 31))?;
        let slopes = system.sensitivities(&motion, ["k"])?.of("slider.R_y")?;
        let at = |k: f64| -> kin::Result<f64> {
            let mut moved = system.clone();
            moved.set("k", k)?;
            Ok(moved.run_both(linspace(0.0, 6.0, 31))?.q(20)[1])
        };
        let expected = (at(3.0 + 1e-5)? - at(3.0 - 1e-5)?) / 2e-5;
        assert!(
            (slopes[0].value[20] - expected).abs() < 1e-7,
            "{} {expected}",
            slopes[0].value[20]
        );
    }
    Ok(())
}

#[test]
fn what_cannot_follow_a_dimension_is_told() -> kin::Result<()> {
    let mut m = slot()?;
    let k = m.dimension_named("k").expect("it is there");
    let slider = m.planar("other", pose(0.0, 0.0, 0.0))?;
    let equation = Equation::read(RAISED).expect("it reads");
    let making = equation.on(slider).on(m.ground()).with("u_i", (0.0, 0.0)).with("c", [0.0, 0.0]);
    let making = making.with("lift", k);
    let foreign = Mechanism::new("other").dimension("d", 1.0)?;
    let foreign = making.with("h", (1.0, 0.0, 0.0)).with("c", [foreign, foreign]).constraint()?;
    assert!(
        m.add("foreign", foreign)
            .is_err_and(|error| error.to_string().contains("does not belong to"))
    );
    Ok(())
}

#[test]
fn expressions_and_laws_are_read_as_files_have_them() -> kin::Result<()> {
    let m = slot()?;
    assert_eq!(m.expression("k / 4 + hypot(3, 4)")?.value(), 5.5);
    assert!(
        m.expression("j / 4")
            .is_err_and(|error| error.to_string().contains("there is no dimension `j`"))
    );
    let data = json!({ "kind": "sum", "parts": {
        "first": { "kind": "ramp", "numbers": { "rate": "2 * k" } },
        "second": { "kind": "constant", "numbers": { "c": 1.0 } },
    } });
    assert_eq!(m.law(&data, &registry())?.at(0.5), 3.0);
    for data in [
        json!({ "kind": "ramp", "numbers": { "rate": "2 * j" } }),
        json!(3),
        json!({ "kind": "rump" }),
    ] {
        assert!(m.law(&data, &registry()).is_err(), "{data}");
    }
    Ok(())
}
