//! Mechanism files name dimensions.

use kin::data::MechanismData;
use kin::data::Registry;
use kin::prelude::*;

use super::{NOMINAL, SliderCrank, same_bits, times};
use crate::engines::Engines;

fn through_text(m: &Mechanism) -> Mechanism {
    let text = serde_json::to_string_pretty(&m.data().unwrap()).unwrap();
    let data: MechanismData = serde_json::from_str(&text).unwrap();
    let back = Mechanism::from_data(&data, &Registry::new()).unwrap();
    assert_eq!(back.data().unwrap(), data, "{text}");
    back
}

#[test]
fn a_mechanism_comes_back_with_what_hangs_on_its_dimensions() {
    let m = NOMINAL.described().unwrap();
    let text = serde_json::to_string(&m.data().unwrap()).unwrap();
    for part in
        [r#""ratio * crank""#, r#""-0.5 * crank""#, r#""0.1 * speed""#, r#""tolerance":0.0001"#]
    {
        assert!(text.contains(part), "{part} in {text}");
    }
    let mut one = m.clone().build().unwrap();
    let mut other = through_text(&m).build().unwrap();
    for (crank, speed) in [(0.1, 2.0), (0.14, -1.0)] {
        for system in [&mut one, &mut other] {
            system.set("crank", crank).unwrap();
            system.set("speed", speed).unwrap();
        }
        assert_eq!(one.parameters(), other.parameters());
        assert!(same_bits(&one.run_both(times()).unwrap(), &other.run_both(times()).unwrap()));
    }
    assert!(other.set("crank", 0.3).unwrap_err().to_string().contains("outside the range"));
}

#[test]
fn distributions_and_clearances_come_back() {
    let mut m = Mechanism::new("loose");
    let a = m
        .dimension("a", 0.3)
        .unwrap()
        .tolerance(0.1)
        .distributed(kin::design::Distribution::TruncatedNormal);
    let gap = m.clearance("gap", 0.01).unwrap();
    let crank = m.link("crank", a).unwrap();
    m.add("O", revolute(crank, Ground, crank.start(), gap)).unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(1.0))).unwrap();
    let text = serde_json::to_string(&m.data().unwrap()).unwrap();
    for part in
        [r#""distribution":"truncated_normal""#, r#""name":"gap.x""#, r#""clearance":"gap""#]
    {
        assert!(text.contains(part), "{part} in {text}");
    }
    let one = m.clone().build().unwrap();
    let other = through_text(&m).build().unwrap();
    let tolerance = |system: &System| {
        let motion = system.run_both([0.5]).unwrap();
        system.tolerance(&motion, "crank.R_x").unwrap()
    };
    assert_eq!(tolerance(&one), tolerance(&other));
}

#[test]
fn laws_lists_and_odd_names_come_back() {
    let mut m = Mechanism::new("odd");
    let a = m.dimension("link 2", 3.0).unwrap();
    let b = m.dimension("sin", 4.0).unwrap();
    let both = m.dimension("O.x", a.hypot(b) - (a - (b - 1.0)) / (a * b)).unwrap();
    let x = m.length("x", 0.0).unwrap();
    let y = m.length("y", -both).unwrap();
    let parts = [(b * b, Law::ramp(a)), (2.0 * a, Law::constant(a * b * b))];
    m.add("x drive", drive(x, Law::sequence(0.0, parts).compose(&Law::linear(0.0, both.powi(2)))))
        .unwrap();
    m.add("y drive", drive(y, Law::spline(&[(0.0, a), (1.0, -a % b)], Ends::Natural))).unwrap();
    let mut one = m.clone().build().unwrap();
    let mut other = through_text(&m).build().unwrap();
    for system in [&mut one, &mut other] {
        system.set("link 2", 7.0).unwrap();
        system.set("sin", -2.0).unwrap();
    }
    assert_eq!((one.dimensions(), one.parameters()), (other.dimensions(), other.parameters()));
    assert_eq!(one.initial(), other.initial());
    assert_eq!(one.parameter("y drive.law.y[1]").unwrap(), -7.0 % -2.0);
}

fn file(dimensions: &str, c: &str) -> kin::Result<Mechanism> {
    let text = format!(
        r#"{{"name": "file", "dimensions": [{dimensions}], "bodies": [{{"name": "x", "kind": "length", "guess": [0]}}],
            "constraints": [{{"name": "motor", "kind": "drive", "arguments": [{{"coord": "x"}}],
            "parameters": {{"law": {{"kind": "constant", "numbers": {{"c": {c}}}}}}}}}]}}"#
    );
    Mechanism::from_data(&serde_json::from_str(&text).unwrap(), &Registry::new())
}

#[test]
fn the_order_of_a_file_changes_nothing() {
    let (a, b) = (r#"{"name": "a", "value": 2}"#, r#"{"name": "b", "value": "a * a"}"#);
    for order in [format!("{a}, {b}"), format!("{b}, {a}")] {
        let mut system = file(&order, r#""b + 1""#).unwrap().build().unwrap();
        system.set("a", 3.0).unwrap();
        assert_eq!(system.parameter("motor.law.c").unwrap(), 10.0);
    }
}

#[test]
fn slips_in_a_file_are_told_by_name() {
    let circle = r#"{"name": "a", "value": "b"}, {"name": "b", "value": "c + 1"}, {"name": "c", "value": "b / 2"}"#;
    for (dimensions, c, told) in [
        (circle, r#""a""#, "they depend on one another in a circle, `b` → `c` → `b`"),
        (r#"{"name": "a", "value": "a"}"#, r#""a""#, "in a circle, `a` → `a`"),
        (
            r#"{"name": "a", "value": 1}"#,
            r#""2 * b""#,
            "constraint `motor`: its parameter `law`: the expression `2 * b`: there is no dimension `b`",
        ),
        (
            r#"{"name": "a", "value": "1 +"}"#,
            "1",
            "dimension `a`: the expression `1 +`: a number must follow at the end of the expression",
        ),
        (
            r#"{"name": "a", "value": 1}, {"name": "a", "value": 1}"#,
            "1",
            "two dimensions have the name `a`",
        ),
    ] {
        let error = file(dimensions, c).map(|_| ()).unwrap_err().to_string();
        assert!(error.contains(told), "{error}\n  for {told}");
    }
    let unused =
        file(r#"{"name": "a", "value": 1}"#, "1").unwrap().build().unwrap_err().to_string();
    assert!(unused.contains("no number of the mechanism depends on the dimension `a`"), "{unused}");
    let within = r#"{"name": "a", "value": 1, "within": [2, 3]}"#;
    assert!(
        file(within, r#""a""#)
            .unwrap()
            .build()
            .unwrap_err()
            .to_string()
            .contains("excludes the value 1")
    );
}

/// Without dimensions a file is what it was.
#[test]
fn a_mechanism_without_dimensions_says_nothing_of_them() {
    let plain = SliderCrank { crank: 0.1, rod: 0.3, offset: 0.0, speed: 1.0 }.plain().unwrap();
    assert!(!serde_json::to_string(&plain.data().unwrap()).unwrap().contains("dimension"));
}
