//! Motions that cannot be proved, by name, and the obstacles of their steps.

use kin::Error;
use kin::extend::Series;
use kin::extend::{LawFunction, by_dual};
use kin::prelude::*;
use kin::results::UnprovedReason;

use crate::engines::Engines;

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
    let motion = system.run_both(linspace(0.0, 2.0, 11)).unwrap();
    match system.prove(&motion) {
        Err(error @ Error::CannotBeProved { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn constraints_and_laws_without_bounds() {
    let with_law = |law: Law| slider(|m, x| m.add("motor", drive(x, law)).map(|_| ()));
    for law in [
        Law::new(Opaque),
        2.0 * Law::new(Opaque) + Law::ramp(1.0),
        Law::sine(1.0, 1.0, 0.0).compose(&Law::new(Opaque)),
    ] {
        let text = refusal(&with_law(law));
        assert!(
            text.starts_with(
                "Kin cannot prove a motion with `motor` (drive): Kin has no bounds of the law `"
            ),
            "{text}"
        );
    }
    let text =
        refusal(&slider(|m, x| m.add("motor", by_dual(drive(x, Law::ramp(1.0)))).map(|_| ())));
    assert!(text.contains("`motor`") && text.contains("dual numbers"), "{text}");
    let text = refusal(&slider(|m, x| m.add("motor", by_helper(x)).map(|_| ())));
    assert!(
        text.contains("`motor` (by_helper)") && text.contains("user-defined function"),
        "{text}"
    );
}

/// A law of one's own under `#[law]` has bounds, alone and within others.
#[test]
fn a_law_of_ones_own() {
    for law in [bump(0.4, 0.7), 2.0 * bump(0.4, 0.7).shifted(1.0) * Law::cycloidal(1.0, 1.0)] {
        let system = slider(|m, x| m.add("motor", drive(x, law)).map(|_| ()));
        let motion = system.run_both(linspace(-1.0, 2.0, 31)).unwrap();
        let proof = system.prove(&motion).unwrap();
        assert!(proof.is_complete(), "{proof}");
    }
}

/// x + x³/10 with its bounds: by its formula, by its derivatives, and by wrong ones.
struct Own {
    kind: &'static str,
    over: fn(&Series) -> Series,
}

impl LawFunction for Own {
    fn jet(&self, x: f64) -> [f64; 4] {
        [x + 0.1 * x.powi(3), 1.0 + 0.3 * x * x, 0.6 * x, 0.6]
    }
    fn kind(&self) -> &str {
        self.kind
    }
    fn over(&self, x: &Series) -> Option<Series> {
        Some((self.over)(x))
    }
}

fn by_formula(x: &Series) -> Series {
    *x + x.powi(3) / Series::number(10.0)
}

/// Its derivatives rise or fall between the ends of any interval that is not wide; rounding is
/// allowed for.
fn by_derivatives(x: &Series) -> Series {
    let [lo, hi] = x.values();
    let around = |f: fn(f64) -> f64| {
        let a = f(lo);
        let b = f(hi);
        let rounding = 1e-14 * (a.abs() + b.abs());
        [a.min(b) - rounding, a.max(b) + rounding]
    };
    let steepest = if lo <= 0.0 && hi >= 0.0 { 1.0 } else { f64::INFINITY };
    let slope = around(|x| 1.0 + 0.3 * x * x);
    x.chain(&[
        around(|x| x + 0.1 * x.powi(3)),
        [slope[0].min(steepest), slope[1]],
        around(|x| 0.6 * x),
        [0.6 - 1e-15, 0.6 + 1e-15],
        [0.0; 2],
        [0.0; 2],
        [0.0; 2],
    ])
}

/// A law of one's own may tell its bounds: what rests on them says so.
#[test]
fn a_law_that_tells_its_own_bounds() {
    for (kind, over) in
        [("by formula", by_formula as fn(&Series) -> Series), ("by derivatives", by_derivatives)]
    {
        let own = Law::new(Own { kind, over });
        kin::check::law(&own, -1.0, 2.0);
        for (law, trusted) in [
            (own.clone(), 1),
            (2.0 * own.clone() + bump(0.4, 0.7), 1),
            (bump(0.4, 0.7) * Law::ramp(1.0), 0),
        ] {
            let system = slider(|m, x| m.add("motor", drive(x, law)).map(|_| ()));
            let proof = system.prove(&system.run_both(linspace(-1.0, 2.0, 31)).unwrap()).unwrap();
            assert!(proof.is_complete() && proof.trusted().len() == trusted, "{proof}");
            let said = format!("This proof relies on the bounds of `{kind}` in `motor`.");
            assert_eq!(proof.to_string().contains(&said), trusted > 0, "{proof}");
        }
    }
}

/// Bounds that do not hold are found at random intervals: values that are off, slopes that are,
/// bounds of points alone, and jumps that are not told.
#[test]
fn wrong_bounds_of_a_law_are_found() {
    let wrong: [(&'static str, fn(&Series) -> Series); 4] = [
        ("value", |x| by_formula(x) + Series::number(1e-3)),
        ("slope", |x| {
            let [lo, hi] = by_formula(x).values();
            x.chain(&[[lo, hi], [1.0, 1.0]])
        }),
        ("middle alone", |x| {
            let [lo, hi] = x.values();
            by_formula(&Series::number(0.5 * (lo + hi)))
        }),
        ("nothing", |_| Series::number(0.0)),
    ];
    for (kind, over) in wrong {
        assert!(
            kin::check::compare_law(&Law::new(Own { kind, over }), -1.0, 2.0).is_err(),
            "{kind}"
        );
    }
    let kinked = Law::new(Kinked);
    let found = kin::check::compare_law(&kinked, -1.0, 1.0).unwrap_err().to_string();
    let expected = "the derivative of order 1 jumps at the break at x = 0, so over this break `over` \
                    must return at most 2 Taylor coefficients";
    assert!(found.contains(expected), "{found}");
}

/// |x|, whose bounds forget that its slope jumps.
struct Kinked;

impl LawFunction for Kinked {
    fn jet(&self, x: f64) -> [f64; 4] {
        [x.abs(), if x >= 0.0 { 1.0 } else { -1.0 }, 0.0, 0.0]
    }
    fn breaks(&self, from: f64, to: f64) -> Vec<kin::law::Break> {
        if from <= 0.0 && to >= 0.0 { vec![kin::law::Break { x: 0.0, order: 1 }] } else { vec![] }
    }
    fn over(&self, x: &Series) -> Option<Series> {
        let [lo, hi] = x.abs().values();
        Some(x.chain(&[[lo, hi], [-1.0, 1.0], [0.0, 0.0]]))
    }
}

#[test]
fn superfluous_equations_and_motions_of_others() {
    let mut m = Mechanism::new("twice");
    let x = m.length("x", 0.0).unwrap();
    m.add("one", drive(x, Law::ramp(1.0))).unwrap();
    m.add("two", drive(x, Law::ramp(1.0))).unwrap();
    let text = refusal(&m.build().unwrap());
    assert!(text.contains("\"twice\": the mechanism has 2 equations for 1 coordinates"), "{text}");
    let one = slider(|m, x| m.add("motor", drive(x, Law::ramp(1.0))).map(|_| ()));
    let mut m = Mechanism::new("other");
    let y = m.length("y", 0.0).unwrap();
    m.add("motor", drive(y, Law::ramp(1.0))).unwrap();
    let other = m.build().unwrap();
    assert!(other.prove(&one.run_both([0.0, 1.0]).unwrap()).is_err());
}

/// A corner is continuous, so a step over it is proved; where two branches of an `if` meet is not
/// known, so one over that is not; nor is one over a root at 0.
#[test]
fn corners_and_branches() {
    let over = |system: &System| {
        let motion = system.run_both(linspace(0.1, 1.9, 10)).unwrap();
        system.prove(&motion).unwrap()
    };
    let proof = over(&slider(|m, x| m.add("motor", corner(x)).map(|_| ())));
    assert!(proof.is_complete(), "{proof}");
    let proof = over(&slider(|m, x| m.add("motor", root(x)).map(|_| ())));
    assert!(proof.is_complete(), "{proof}");
    let proof = over(&slider(|m, x| m.add("motor", stairs(x)).map(|_| ())));
    assert_eq!(proof.steps().len() - proof.proved(), 1, "{proof}");
    let doubt = proof.first_unproved().unwrap().tube.as_ref().unwrap_err();
    let UnprovedReason::Unbounded { equation, expression, source } = &doubt.reason else {
        panic!("{proof}")
    };
    assert!(equation == "motor" && (doubt.t - 1.0).abs() < 1e-3, "{proof}");
    assert!(expression.as_deref().is_some_and(|text| text.contains("if t < 1.0")), "{proof}");
    assert!(source.is_some_and(|source| source.file.ends_with("refused.rs")), "{proof}");
}

/// Parameters changed after the run: the positions are no longer those of the mechanism.
#[test]
fn another_mechanism_than_that_of_the_run() {
    let bar = crate::models::FourBar {
        driven: 1.0,
        next: 3.5,
        last: 3.0,
        ground: 4.0,
        by_coupler: false,
    };
    let (mut system, _) = bar.system(Law::linear(0.3, TAU), 0.3, 1.0).unwrap();
    let motion = system.run_both(linspace(0.0, 1.0, 37)).unwrap();
    system.set("C.u_j.x", 4.6).unwrap();
    let proof = system.prove(&motion).unwrap();
    assert!(!proof.is_complete(), "{proof}");
    println!("{proof}");
}
