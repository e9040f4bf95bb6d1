//! What cannot be proved, by name; and what stands in the way of a step.

use kin::prelude::*;
use kin::{DoubtReason, Error, LawFunction, by_dual};

/// A law of which only values are known.
struct Opaque;

impl LawFunction for Opaque {
    fn jet(&self, x: f64) -> [f64; 4] {
        [x, 1.0, 0.0, 0.0]
    }
    fn kind(&self) -> &str {
        "opaque"
    }
}

fn helper<D: Dual>(x: Real<D>) -> Real<D> {
    x.sin()
}

#[constraint]
fn by_helper(x: Coord, t: Time) -> f64 {
    x - helper(t)
}

/// x = |t − 1| as a corner, and by `if`.
#[constraint]
fn corner(x: Coord, t: Time) -> f64 {
    x - (t - 1.0).abs()
}

#[constraint]
fn stairs(x: Coord, t: Time) -> f64 {
    x - if t < 1.0 { 0.0 } else { t - 1.0 }
}

#[constraint]
fn root(x: Coord, t: Time) -> f64 {
    x - (t - 1.0).powi(2).sqrt()
}

#[law]
fn bump(x: f64, height: f64, width: f64) -> f64 {
    height * (-(x / width).powi(2)).exp()
}

fn slider(add: impl FnOnce(&mut Mechanism, Coordinate) -> kin::Result<()>) -> System {
    let mut m = Mechanism::new("slider");
    let x = m.length("x", 0.0).unwrap();
    add(&mut m, x).unwrap();
    m.build().unwrap()
}

fn refusal(system: &System) -> String {
    let motion = system.run(linspace(0.0, 2.0, 11)).unwrap();
    match system.prove(&motion) {
        Err(error @ Error::CannotBeProved { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn constraints_and_laws_without_bounds() {
    let with_law = |law: Law| slider(|m, x| m.add("motor", drive(x, law)).map(|_| ()));
    for law in [Law::new(Opaque), 2.0 * Law::new(Opaque) + Law::ramp(1.0), Law::sine(1.0, 1.0, 0.0).compose(&Law::new(Opaque))] {
        let text = refusal(&with_law(law));
        assert!(text.starts_with("a motion with `motor` (drive) cannot be proved: of its law `"), "{text}");
    }
    let text = refusal(&slider(|m, x| m.add("motor", by_dual(drive(x, Law::ramp(1.0)))).map(|_| ())));
    assert!(text.contains("`motor`") && text.contains("dual route"), "{text}");
    let text = refusal(&slider(|m, x| m.add("motor", by_helper(x)).map(|_| ())));
    assert!(text.contains("`motor` (by_helper)") && text.contains("function of yours"), "{text}");
}

/// A law of one's own under `#[law]` has bounds, alone and within others.
#[test]
fn a_law_of_ones_own() {
    for law in [bump(0.4, 0.7), 2.0 * bump(0.4, 0.7).shifted(1.0) * Law::cycloidal(1.0, 1.0)] {
        let system = slider(|m, x| m.add("motor", drive(x, law)).map(|_| ()));
        let motion = system.run(linspace(-1.0, 2.0, 31)).unwrap();
        let proof = system.prove(&motion).unwrap();
        assert!(proof.is_complete(), "{proof}");
    }
}

#[test]
fn superfluous_equations_and_motions_of_others() {
    let mut m = Mechanism::new("twice");
    let x = m.length("x", 0.0).unwrap();
    m.add("one", drive(x, Law::ramp(1.0))).unwrap();
    m.add("two", drive(x, Law::ramp(1.0))).unwrap();
    let text = refusal(&m.build().unwrap());
    assert!(text.contains("\"twice\" cannot be proved: it has 2 equations for 1 coordinates"), "{text}");
    let one = slider(|m, x| m.add("motor", drive(x, Law::ramp(1.0))).map(|_| ()));
    let mut m = Mechanism::new("other");
    let y = m.length("y", 0.0).unwrap();
    m.add("motor", drive(y, Law::ramp(1.0))).unwrap();
    let other = m.build().unwrap();
    assert!(other.prove(&one.run([0.0, 1.0]).unwrap()).is_err());
}

/// A corner is continuous, so a step over it is proved; where two branches of an `if` meet is not known, so one over that is not; nor is one over a root at 0.
#[test]
fn corners_and_branches() {
    let over = |system: &System| {
        let motion = system.run(linspace(0.1, 1.9, 10)).unwrap();
        system.prove(&motion).unwrap()
    };
    let proof = over(&slider(|m, x| m.add("motor", corner(x)).map(|_| ())));
    assert!(proof.is_complete(), "{proof}");
    let proof = over(&slider(|m, x| m.add("motor", root(x)).map(|_| ())));
    assert!(proof.is_complete(), "{proof}");
    let proof = over(&slider(|m, x| m.add("motor", stairs(x)).map(|_| ())));
    assert_eq!(proof.steps().len() - proof.proved(), 1, "{proof}");
    let doubt = proof.first_unproved().unwrap().tube.as_ref().unwrap_err();
    let DoubtReason::Unbounded { equation, expression, source } = &doubt.reason else { panic!("{proof}") };
    assert!(equation == "motor" && (doubt.t - 1.0).abs() < 1e-3, "{proof}");
    assert!(expression.as_deref().is_some_and(|text| text.contains("if t < 1.0")), "{proof}");
    assert!(source.is_some_and(|source| source.file.ends_with("refused.rs")), "{proof}");
}

/// Parameters changed after the run: the positions are no longer those of the mechanism.
#[test]
fn another_mechanism_than_that_of_the_run() {
    let bar = crate::models::FourBar { driven: 1.0, next: 3.5, last: 3.0, ground: 4.0, by_coupler: false };
    let (mut system, _) = bar.system(Law::linear(0.3, TAU), 0.3, 1.0).unwrap();
    let motion = system.run(linspace(0.0, 1.0, 37)).unwrap();
    system.set("C.u_j.x", 4.6).unwrap();
    let proof = system.prove(&motion).unwrap();
    assert!(!proof.is_complete(), "{proof}");
    println!("{proof}");
}
