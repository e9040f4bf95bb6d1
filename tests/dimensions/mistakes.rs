//! Mistakes in dimensions are told by name.

use kin::Error;
use kin::error::DimensionError;
use kin::prelude::*;

use super::NOMINAL;
use crate::engines::Engines;

/// A crank on a dimension, and the message of what goes wrong.
fn told(change: impl FnOnce(&mut Mechanism, Dimension) -> kin::Result<()>) -> String {
    let build = || {
        let mut m = Mechanism::new("crank");
        let a = m.dimension("crank", 0.12)?;
        let crank = m.link("crank", a)?;
        m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0)))?;
        m.add("motor", drive_angle(crank, Law::ramp(1.0)))?;
        change(&mut m, a)?;
        m.build()
    };
    build().expect_err("it was accepted").to_string()
}

fn done(_: Dimension) -> kin::Result<()> {
    Ok(())
}

#[test]
fn what_makes_no_sense_is_told_by_name() {
    for (found, expected) in [
        (
            told(|m, _| m.dimension("spare", 1.0).map(|_| ())),
            "no number of the mechanism depends on the dimension `spare`",
        ),
        (
            told(|m, _| m.dimension("crank", 1.0).map(|_| ())),
            "two dimensions have the name `crank`",
        ),
        (
            told(|m, _| m.dimension(" ", 1.0).map(|_| ())),
            "a dimension has an empty name. Give the dimension a name",
        ),
        (
            told(|m, _| m.dimension("b", f64::NAN).map(|_| ())),
            "`b`: the value is NaN. Give a finite number",
        ),
        (
            told(|_, a| done(a.within(0.2, 0.3))),
            "`crank`: the range 0.2 … 0.3 excludes the value 0.12",
        ),
        (told(|_, a| done(a.within(f64::NAN, 0.3))), "`crank`: the range NaN … 0.3 excludes"),
        (told(|_, a| done(a.tolerance(-0.1))), "`crank`: the tolerance is ± -0.1"),
        (
            told(|_, a| done((a / 2.0).tolerance(0.1))),
            "`crank / 2.0`: an expression has no range, tolerance or unit",
        ),
        (told(|m, a| m.link("neg", a - 1.0).map(|_| ())), "the link `neg` has the length -0.88"),
    ] {
        assert!(found.contains(expected), "{found}\n  for {expected}");
    }
}

/// A law of which one number is set by hand keeps the others where they hang.
#[test]
fn a_law_that_is_set_keeps_its_dimensions() {
    let mut m = Mechanism::new("law");
    let a = m.dimension("a", 1.0).unwrap();
    let mut law = Law::linear(a, 2.0);
    assert!(law.set_parameter("rate", 3.0));
    let x = m.length("x", 0.0).unwrap();
    m.add("x drive", drive(x, law)).unwrap();
    let mut system = m.build().unwrap();
    system.set("a", 5.0).unwrap();
    let numbers =
        ["x drive.law.f0", "x drive.law.rate"].map(|name| system.parameter(name).unwrap());
    assert_eq!(numbers, [5.0, 3.0]);
}

#[test]
fn a_name_that_something_else_has_is_told() {
    let mut m = NOMINAL.described().unwrap();
    let taken = m.dimension("B.u_i.x", 1.0).unwrap();
    let slider = m.planar_named("slider").unwrap();
    m.add("more", drive(slider.x(), Law::constant(taken))).unwrap();
    assert!(
        m.build()
            .unwrap_err()
            .to_string()
            .contains("`B.u_i.x`: a coordinate or parameter has the same name")
    );
}

#[test]
fn a_dimension_of_another_mechanism_is_told_wherever_it_is_given() {
    let mut other = Mechanism::new("other");
    let far = other.dimension("far", 1.0).unwrap();
    let mut m = Mechanism::new("this");
    let own = m.dimension("own", 1.0).unwrap();
    let body = m.planar("body", pose(0.0, 0.0, 0.0)).unwrap();
    let short_lived = Mechanism::new("gone").dimension("gone", 2.0).unwrap();
    for wrong in [far, far + own, own * far, short_lived, short_lived / 2.0 + own] {
        let link = m.link("link", wrong).err();
        let pose = m.planar("posed", pose(wrong, 0.0, 0.0)).err();
        let pin = m.add("pin", revolute(body, Ground, (wrong, 0.0), (own, 0.0))).err();
        let law = m.add("law", drive(body.x(), Law::ramp(2.0) + Law::ramp(wrong))).err();
        let named = m.dimension("named", wrong).err();
        for error in [link, pose, pin, law, named] {
            let error = error.expect("it was accepted");
            assert!(
                matches!(&error, Error::Dimension(e) if matches!(**e, DimensionError::Foreign { .. })),
                "{error}"
            );
            assert!(error.to_string().contains("\"this\""), "{error}");
        }
    }
    // Nothing of what was refused is left behind.
    m.add("pin", revolute(body, Ground, (own, 0.0), (0.0, 0.0))).unwrap();
    m.add("motor", drive_angle(body, Law::ramp(1.0))).unwrap();
    assert!(m.build().unwrap().run_both([0.0, 1.0]).is_ok());
}

#[test]
fn a_value_that_cannot_be_set_leaves_the_old_one() {
    let mut system = NOMINAL.described().unwrap().build().unwrap();
    let before = (system.dimensions(), system.parameters());
    for (name, value, told) in [
        ("crank", f64::NAN, "`crank`: the value is NaN"),
        ("crank", 0.3, "`crank`: the value 0.3 is outside the range 0.05 … 0.2"),
        ("ratio", -1.0, "the link `rod` has the length -0.1"),
        ("ratio", f64::INFINITY, "the value is inf"),
        ("cranc", 0.1, "`cranc`"),
    ] {
        let error = system.set(name, value).unwrap_err().to_string();
        assert!(error.contains(told), "{error}");
        assert_eq!((system.dimensions(), system.parameters()), before);
    }
    let mut m = Mechanism::new("derived");
    let a = m.dimension("a", 1.0).unwrap();
    let half = m.dimension("half", a / 2.0).unwrap();
    let x = m.length("x", 0.0).unwrap();
    m.add("motor", drive(x, Law::constant(half) + Law::ramp((a - 1.0).sqrt()))).unwrap();
    let mut system = m.build().unwrap();
    assert!(
        system
            .set("half", 2.0)
            .unwrap_err()
            .to_string()
            .contains("`half`: the dimension is an expression of other dimensions")
    );
    assert!(system.sweep(["half"]).err().unwrap().to_string().contains("`half`"));
    let error = system.set("a", 0.5).unwrap_err().to_string();
    assert!(
        error.contains("`a`: with the value 0.5 the parameter `motor.law.second.rate` is NaN"),
        "{error}"
    );
    system.set("a", 2.0).unwrap();
    assert_eq!(system.dimensions(), [("a".to_string(), 2.0), ("half".to_string(), 1.0)]);
}
