//! Every constraint says why it takes its route; what could not be read before is read now.

use kin::check;
use kin::check::{any_coord, any_planar};
use kin::error::FailureKind;
use kin::extend::{RouteReason, by_dual};
use kin::prelude::*;

#[constraint]
fn read(x: Coord, k: f64) -> f64 {
    x - k
}

#[constraint]
fn series(x: Coord, h: f64) -> f64 {
    let mut term = x;
    let mut sum = x;
    while term.abs() > 1e-12 {
        term = -term * x * x;
        sum += term;
    }
    sum - h
}

#[constraint]
fn sum_of_many(x: Coord, n: usize) -> f64 {
    let mut sum = x;
    for k in 0..n {
        sum += x / (k as f64 + 1.0);
    }
    sum
}

#[constraint(dual)]
fn asked(x: Coord, k: f64) -> f64 {
    x - k
}

/// The line, counted from 1, and the column of the first place behind `after` where `text` stands
/// in this file.
fn place(after: &str, text: &str) -> (u32, u32) {
    let file = include_str!("routes.rs");
    let from = file.find(after).unwrap();
    let at = from + file[from..].find(text).unwrap();
    let line_start = file[..at].rfind('\n').map_or(0, |k| k + 1);
    (file[..at].matches('\n').count() as u32 + 1, (at - line_start) as u32 + 1)
}

fn unread(constraint: &dyn Constraint) -> (&'static str, u32, u32) {
    match constraint.explain_route() {
        RouteReason::Unread { what, source } if source.file.ends_with("tests/routes.rs") => {
            (what, source.line, source.column)
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_dual_constraint_says_which_token_cannot_be_read() {
    let (line, column) = place("fn series", "while");
    assert_eq!(unread(&series(any_coord(), 1.0)), ("a loop with an unknown end", line, column));
    let text = series(any_coord(), 1.0).explain_route().to_string();
    assert!(text.ends_with(&format!("routes.rs:{line}:{column}")), "{text}");
    let (line, column) = place("fn sum_of_many", "0..n");
    let (what, found_line, found_column) = unread(&sum_of_many(any_coord(), 3));
    assert_eq!((found_line, found_column), (line, column), "{what}");
}

#[test]
fn other_routes_are_explained_too() {
    assert_eq!(read(any_coord(), 1.0).explain_route(), RouteReason::Read);
    let RouteReason::Asked { source: Some(source) } = asked(any_coord(), 1.0).explain_route()
    else {
        panic!("asked")
    };
    assert_eq!((source.line, source.column), place("#[constraint(dual)]\nfn asked", "dual"));
    assert_eq!(
        by_dual(read(any_coord(), 1.0)).explain_route(),
        RouteReason::Asked { source: None }
    );
    let joint: Box<dyn Constraint> =
        Box::new(revolute(any_planar(), any_planar(), vec2(0.0, 0.0), vec2(0.0, 0.0)));
    assert_eq!(joint.explain_route().to_string(), "symbolic: Kin has read the whole function");
}

fn horner<D: Dual>(x: Real<D>, k: f64) -> Real<D> {
    x * (x + k)
}

const GAIN: f64 = 2.5;

macro_rules! squared {
    ($x:expr) => {
        $x * $x
    };
}

#[constraint]
fn with_a_helper(x: Coord, y: Coord, k: f64) -> f64 {
    horner(x, GAIN) - k * y.sin() + horner(y, k)
}

#[constraint]
fn with_a_macro(x: Coord, k: f64) -> f64 {
    squared!(x) - k
}

mod shapes {
    pub const HEIGHTS: [f64; 2] = [0.5, 1.5];

    pub fn wide(k: f64) -> f64 {
        2.0 * k
    }
}

#[constraint]
fn with_constants(x: Coord, k: f64) -> f64 {
    const OWN: f64 = 2.0;
    x * shapes::HEIGHTS[1] - OWN * shapes::wide(k) * std::f64::consts::PI
        + f64::from_bits(k.to_bits())
}

/// So do constants and functions of parameters; what the function holds itself and the standard
/// library's are known.
#[test]
fn constants_outside_are_named() {
    let constraint = with_constants(any_coord(), 2.0);
    let RouteReason::ReadBut { outside } = constraint.explain_route() else {
        panic!("{:?}", constraint.explain_route())
    };
    let mut found: Vec<_> =
        outside.iter().map(|(name, source)| (*name, (source.line, source.column))).collect();
    found.sort();
    let at = |word: &str| place("fn with_constants", word);
    assert_eq!(
        found,
        [("shapes::HEIGHTS", at("shapes::HEIGHTS")), ("shapes::wide", at("shapes::wide"))]
    );
    let text = constraint.explain_route().to_string();
    assert!(
        text.starts_with("symbolic, except for functions that only rustc can read: `shapes::"),
        "{text}"
    );
    assert_eq!(constraint.route(), Route::Symbolic);
    check::derivatives(constraint);
}

/// Functions outside of the constraint stay the program's own, and so do its macros: both are
/// named.
#[test]
fn what_only_the_program_knows_is_named() {
    let constraint = with_a_helper(any_coord(), any_coord(), 2.0);
    let RouteReason::ReadBut { outside } = constraint.explain_route() else {
        panic!("{:?}", constraint.explain_route())
    };
    let found: Vec<_> =
        outside.iter().map(|(name, source)| (*name, (source.line, source.column))).collect();
    let at = |word: &str| place("fn with_a_helper", word);
    assert_eq!(
        found,
        [("horner", at("horner(x")), ("horner", at("horner(y")), ("GAIN", at("GAIN"))]
    );
    assert_eq!(constraint.route(), Route::Symbolic);
    let text = constraint.explain_route().to_string();
    assert!(
        text.starts_with("symbolic, except for functions that only rustc can read: `horner` at "),
        "{text}"
    );
    check::derivatives(constraint);

    let constraint = with_a_macro(any_coord(), 2.0);
    let (line, column) = place("fn with_a_macro", "squared!");
    assert_eq!(unread(&constraint), ("the macro `squared!`", line, column));
    check::derivatives(constraint);
}

type Length = f64;

#[constraint]
fn functions_by_path(a: Coord, k: f64) -> f64 {
    f64::cos(a) + [a, k].map(f64::sin)[0] + f64::atan2(a, k) - f64::max(a, 1.0)
}

#[constraint(dual)]
fn functions_by_path_on_dual_numbers(a: Coord, k: f64) -> f64 {
    let cosine = f64::cos;
    cosine(a) - k + f64::powi(a, 2) + f64::clamp(a, -9.0, 9.0)
}

#[constraint]
fn bits_of_a_parameter(a: Coord, k: f64, bits: u64) -> f64 {
    a - f64::from_bits(k.to_bits()) + f64::from_bits(bits) + k.next_up()
}

#[constraint(dual)]
fn bits_of_a_parameter_on_dual_numbers(a: Coord, k: f64) -> f64 {
    a * a - f64::from_bits(k.to_bits()) + k.next_up().midpoint(1.0)
}

#[constraint]
fn a_name_for_a_type(a: Coord, k: f64) -> f64 {
    type T = f64;
    type Pair = (T, T);
    fn square(x: T) -> T {
        x * x
    }
    let both: Pair = (a, k);
    let double = |x: T| -> T { x * 2.0 };
    T::cos(both.0) + square(a) + double(both.1)
}

#[constraint(dual)]
fn a_name_for_a_type_on_dual_numbers(a: Coord, k: f64) -> f64 {
    type T = f64;
    let all: Vec<T> = vec![a, k];
    all[0] * all[1]
}

#[constraint]
fn a_name_from_outside(a: Coord, k: Length) -> f64 {
    let x: Length = a * k;
    x * a
}

#[constraint]
fn ordered(a: Coord, k: f64) -> f64 {
    if a.total_cmp(&k).is_lt() || f64::total_cmp(&a, &k).is_gt() { a * a } else { k - a }
}

struct Pair<T> {
    a: T,
    b: T,
}

#[constraint]
fn a_generic_struct(i: Planar, k: f64) -> f64 {
    let pair: Pair<f64> = Pair { a: i.r.x, b: k };
    pair.a * pair.b
}

#[test]
fn what_f64_can_do_has_derivatives() {
    check::derivatives(functions_by_path(any_coord(), 0.7));
    check::derivatives(functions_by_path_on_dual_numbers(any_coord(), 0.7));
    check::derivatives(bits_of_a_parameter(any_coord(), 0.7, 0.3_f64.to_bits()));
    check::derivatives(bits_of_a_parameter_on_dual_numbers(any_coord(), 0.7));
    check::derivatives(a_name_for_a_type(any_coord(), 0.7));
    check::derivatives(a_name_for_a_type_on_dual_numbers(any_coord(), 0.7));
    check::derivatives(a_name_from_outside(any_coord(), 0.7));
    check::derivatives(ordered(any_coord(), 0.7));
    check::derivatives(a_generic_struct(any_planar(), 0.7));
    assert_eq!(functions_by_path(any_coord(), 0.7).route(), Route::Symbolic);
    assert_eq!(bits_of_a_parameter(any_coord(), 0.7, 1).route(), Route::Symbolic);
    assert_eq!(a_name_for_a_type(any_coord(), 0.7).route(), Route::Symbolic);
}

/// z = arsinh(s x) and y = arcosh(s x)
#[constraint]
fn area(x: Coord, z: Coord, y: Coord, s: f64) -> [f64; 2] {
    [z - (s * x).asinh(), y - (s * x).acosh()]
}

#[constraint(dual)]
fn area_by_dual(x: Coord, z: Coord, y: Coord, s: f64) -> [f64; 2] {
    [z - (s * x).asinh(), y - (s * x).acosh()]
}

/// The motion at x = 2 + v t.
fn run(s: f64, v: f64, dual: bool) -> kin::Result<Motion> {
    let mut m = Mechanism::new("area");
    let [x, z, y] = [("x", 2.0), ("z", (4.0 * s).ln()), ("y", (4.0 * s).ln())]
        .map(|(name, at)| m.length(name, at).unwrap());
    m.add("motor", drive(x, Law::linear(2.0, v))).unwrap();
    if dual {
        m.add("area", area_by_dual(x, z, y, s)).unwrap();
    } else {
        m.add("area", area(x, z, y, s)).unwrap();
    }
    m.build().unwrap().run([0.0, 0.1, 0.3])
}

/// arsinh u and arcosh u are ln 2u there, so that rates are v/x and −v²/x².
#[test]
fn area_functions_of_large_numbers_by_both_routes() {
    for s in [1e20, 1e150, 4e153, 1e155, 1e160, 1e200, 1e300, 2e307] {
        for v in [1e-12, 1e-3, 0.5] {
            for dual in [false, true] {
                let motion = match run(s, v, dual) {
                    Ok(motion) => motion,
                    // The square of the rate is too large, which an error says.
                    Err(error) => {
                        assert!(
                            matches!(error.kind(), Some(FailureKind::NotFinite { .. })),
                            "{s} {v} {dual}: {error}"
                        );
                        assert!((s * v).powi(2).is_infinite(), "{s} {v} {dual}: {error}");
                        continue;
                    }
                };
                for (k, t) in motion.times().iter().enumerate() {
                    let x = 2.0 + v * t;
                    let exact = [2.0_f64.ln() + s.ln() + x.ln(), v / x, -(v / x).powi(2)];
                    let found = [motion.q(k), motion.qd(k), motion.qdd(k)];
                    for (found, exact) in found.iter().zip(exact) {
                        let off = (found[1] - exact).abs().max((found[2] - exact).abs());
                        assert!(
                            off <= 1e-9 * exact.abs() + 1e-15,
                            "{s} {v} {dual} {k}: {found:?} {exact}"
                        );
                    }
                }
            }
        }
    }
}
