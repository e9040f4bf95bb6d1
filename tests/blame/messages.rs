//! The messages themselves.

use kin::prelude::*;

#[constraint]
fn slot(x: Coord, y: Coord, depth: f64) -> (f64, f64) {
    ((x - 0.2).sqrt() - depth, depth / y)
}

fn text(q: [f64; 2], jacobian: bool) -> String {
    let mut m = Mechanism::new("test");
    let x = m.length("slider", 1.0).unwrap();
    let y = m.length("wedge", 1.0).unwrap();
    m.add("slot", slot(x, y, 0.5)).unwrap();
    let system = m.build().unwrap();
    let error = if jacobian {
        system.jacobian(&q, 0.25).map(drop)
    } else {
        system.residual(&q, 0.25).map(drop)
    };
    error.unwrap_err().to_string()
}

#[test]
fn value_that_is_no_number() {
    let expected =
        "C of `slot` row 1 is not finite at t = 0.25 s: `(x - 0.2).sqrt()` is not a number (operand -0.1).
  tests/blame/messages.rs:7:6, at slider = 0.1.
  Begin at another pose, change the parameters, or write an `if` around the expression.";
    assert_eq!(text([0.1, 1.0], false), expected);
}

#[test]
fn value_that_is_infinite() {
    let expected =
        "C of `slot` row 2 is not finite at t = 0.25 s: `depth / y` is infinite (operands 0.5 and 0).
  tests/blame/messages.rs:7:32, at wedge = 0 and slot.depth = 0.5.
  Begin at another pose, change the parameters, or write an `if` around the expression.";
    assert_eq!(text([1.0, 0.0], false), expected);
}

#[test]
fn slope_that_is_infinite() {
    let expected =
        "C_q of `slot` row 1 is not finite at t = 0.25 s: `(x - 0.2).sqrt()` has no finite slope (operand 0).
  tests/blame/messages.rs:7:6, at slider = 0.2.
  Avoid this pose, or write a smooth equation: `d.dot(d) - l * l` instead of `d.norm() - l`.";
    assert_eq!(text([0.2, 1.0], true), expected);
}

#[law]
fn hop(t: f64, h: f64) -> f64 {
    h * (t - 1.0).sqrt()
}

/// A law that ends is told by the name of its function, whatever joint asks it.
#[test]
fn a_law_without_a_number_is_told_by_its_name() {
    let mut m = Mechanism::new("crank");
    let crank = m.link("crank", 1.0).expect("a link");
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).expect("adds");
    m.add("motor", drive_angle(crank, hop(0.5))).expect("adds");
    let system = m.build().expect("builds");
    for (t, told) in [
        (0.5, "`law.at(t)` is not a number (operand 0.5)"),
        (1.0, "has no finite slope (operand 1)"),
    ] {
        let error = system.position(t).unwrap_err().to_string();
        assert!(
            error.contains(told) && error.contains("the law `hop`") && !error.contains("d·d"),
            "{error}"
        );
    }
}
