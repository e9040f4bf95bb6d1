//! Derivatives where C is smooth though something on the way is not, or overflows: on both routes,
//! up to the jerk, against 80-digit values (`data/smooth.py`). And the other way round: a slope
//! that does not exist is told.

#[path = "data/engines.rs"]
mod engines;

use kin::check::any_coord;
use kin::error::FailureKind;
use kin::extend::{dual_terms, terms};
use kin::prelude::*;
use serde_json::Value;

use crate::engines::Engines;

/// A function of one's own, which the compiler calls as it is.
fn root<D: Dual>(x: Real<D>) -> Real<D> {
    x.sqrt()
}

/// The same, with the choice inside.
fn clipped<D: Dual>(x: Real<D>) -> Real<D> {
    x.max(0.0).sqrt()
}

fn sum_of_roots<D: Dual>(x: Real<D>, y: Real<D>) -> Real<D> {
    x.sqrt() + y.sqrt()
}

#[law]
fn rooted(x: f64, scale: f64) -> f64 {
    (scale * x).max(0.0).sqrt()
}

type Terms = [f64; 5];

/// C, both slopes, Q_d and the jerk's right side on the symbolic route and on the dual one.
fn by_both_routes<E: kin::extend::dual_route::Equation<2, 1> + Clone>(
    equation: &E,
    q: &[f64],
) -> [Terms; 2] {
    let qd = [0.7, -0.3];
    let qdd = [0.2, 0.5];
    assert_eq!(equation.route(), Route::Symbolic);
    let own = terms(equation, q, &qd, 0.0);
    let dual = dual_terms::<E, 2, 1>(equation, q, &qd, 0.0);
    let jerks = [
        kin::extend::jerk_rhs(equation, q, &qd, &qdd, 0.0).expect("known")[0],
        kin::extend::jerk_rhs(
            &kin::extend::by_dual::<E, 2, 1>(equation.clone()),
            q,
            &qd,
            &qdd,
            0.0,
        )
        .expect("known")[0],
    ];
    // Q_d is that of q̇ alone; the reference goes along q̈ too, which adds −C_q q̈.
    let all = [(own, jerks[0]), (dual, jerks[1])];
    all.map(|(terms, jerk)| {
        let [by_a, by_b] = [terms.c_q[(0, 0)], terms.c_q[(0, 1)]];
        [terms.c[0], by_a, by_b, terms.q_d[0] - by_a * qdd[0] - by_b * qdd[1], jerk]
    })
}

macro_rules! equations {
    ($($name:ident |$a:ident, $b:ident, $law:ident| $value:expr;)*) => {
        $(mod $name {
            #![allow(unused_variables, clippy::let_and_return)]
            #[allow(unused_imports)]
            use super::*;
            #[constraint(symbolic)]
            pub fn equation($a: Coord, $b: Coord, $law: Law) -> f64 { let value = $value; value }
        })*

        fn of_name(name: &str, q: &[f64]) -> [Terms; 2] {
            let law = || rooted(1.0);
            match name {
                $(stringify!($name) => by_both_routes(&$name::equation(any_coord(), any_coord(), law()), q),)*
                _ => panic!("no equation {name}"),
            }
        }

        const NAMES: &[&str] = &[$(stringify!($name)),*];
    };
}

equations! {
    clipped_root |a, b, law| (1.0 - a * a).max(0.0).sqrt();
    clamped_angle |a, b, law| (a * b).clamp(-1.0, 1.0).acos();
    clamped_root |a, b, law| a.clamp(0.0, 1.0).sqrt();
    chosen_root |a, b, law| (if a > 0.0 { a } else { 0.0 }).sqrt();
    log_of_root |a, b, law| (1.0 + a.max(0.0).sqrt()).ln();
    hertz |a, b, law| a.max(0.0).powf(1.5);
    corner |a, b, law| a.max(0.0).hypot(b.max(0.0));
    quadrant |a, b, law| a.max(0.0).atan2(b.max(0.0));
    root_not_taken |a, b, law| b.max(a.sqrt());
    pole_not_taken |a, b, law| (1.0 / a).min(b);
    matched |a, b, law| { let m = match a > 0.0 { true => a, false => 0.0 }; m.cbrt() + m.powf(0.5) * b };
    nested |a, b, law| (a.max(0.0).sqrt() - 1.0).max(0.0).sqrt();
    returned |a, b, law| { let mut m = 0.0; if a > 0.0 { m = a * a * a; } m.sqrt() };
    of_both |a, b, law| (a.max(0.0) + b.max(0.0)).sqrt();
    of_the_larger |a, b, law| a.max(b).max(0.0).sqrt();
    own_root |a, b, law| root(a.max(0.0)) + root(a.clamp(0.0, 100.0));
    own_inside |a, b, law| clipped(a);
    own_of_two |a, b, law| sum_of_roots(a.max(0.0), b.max(0.0));
    law_of_own |a, b, law| law.at(a);
    variable_power |a, b, law| a.max(0.0).powf(b);
    far_length |a, b, law| a.hypot(1.0);
    logistic |a, b, law| 1.0 / (1.0 + (-800.0 * a).exp());
    two_steps |a, b, law| 1.0 / (1.0 + (-800.0 * a).exp() + (900.0 * b).exp());
    soft_minimum |a, b, law| -((-500.0 * a).exp() + (-500.0 * b).exp()).ln() / 500.0;
    soft_maximum |a, b, law| { let m = a.max(b); m + ((a - m).exp() + (b - m).exp()).ln() };
    soliton |a, b, law| a.tanh() * (1.0 / a.cosh());
    bell |a, b, law| a.cosh().powi(-2);
    root_of_power |a, b, law| a.exp().sqrt();
    log_of_cosh |a, b, law| a.cosh().ln();
    area_of_sinh |a, b, law| a.sinh().asinh();
    gauss |a, b, law| (-(30.0 * a).powi(2)).exp();
    gompertz |a, b, law| (-a.exp()).exp();
    gudermann |a, b, law| 2.0 * a.exp().atan();
    saturated |a, b, law| a.exp().tanh();
    hill |a, b, law| 1.0 / (1.0 + a.powi(200));
    nested_quotient |a, b, law| b / (1.0 + (1.0 + a.exp()) * (1.0 + a.exp()));
    fourth_root |a, b, law| (1.0 + a.exp()).powf(0.25);
    mollifier |a, b, law| if a.abs() < 1.0 { (-1.0 / (1.0 - a * a)).exp() } else { 0.0 };
}

/// Where a divisor is finite but its tangents are not, the dual route gives no number: it carries
/// tangents as they are. The symbolic route has one, the jerk too.
fn tangents_overflow(name: &str, a: f64, b: f64) -> bool {
    match name {
        "logistic" => (-0.8873..-0.85).contains(&a),
        "two_steps" => (-0.8873..-0.85).contains(&a) || (0.75..0.789).contains(&b),
        "soft_minimum" => a < -1.37 || b < -1.37,
        "hill" => a == 34.0,
        _ => false,
    }
}

#[test]
fn derivatives_are_right_where_the_equation_is_smooth() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/smooth.json");
    let points: Vec<Value> = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let numbers = |value: &Value| {
        value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect::<Vec<f64>>()
    };
    let mut wrong = Vec::new();
    let mut seen = Vec::new();
    for point in &points {
        let name = point["name"].as_str().unwrap();
        let q = numbers(&point["at"]);
        let exact = numbers(&point["exact"]);
        seen.push(name);
        let size = exact.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        for (route, found) in ["symbolic", "dual"].into_iter().zip(of_name(name, &q)) {
            if route == "dual" && tangents_overflow(name, q[0], q[1]) {
                continue;
            }
            for (k, term) in ["C", "C_a", "C_b", "Q_d", "jerk"].into_iter().enumerate() {
                let close =
                    (found[k] - exact[k]).abs() <= 1e-9 * exact[k].abs() + 1e-10 * size + 1e-303;
                if !close {
                    wrong.push(format!(
                        "{name} at {q:?}, {route}: {term} is {:e} instead of {:e}",
                        found[k], exact[k]
                    ));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}\n{} wrong", wrong.join("\n"), wrong.len());
    assert!(NAMES.iter().all(|name| seen.contains(name)));
}

/// Where there is no slope, neither route gives one: a tangent that happens to be zero is no reason
/// to.
mod singular {
    use super::*;

    macro_rules! singular {
        ($($name:ident |$a:ident, $b:ident| $value:expr, $at:expr;)*) => {
            $(mod $name {
                #![allow(unused_variables, clippy::let_and_return)]
                #[allow(unused_imports)]
                use super::*;
                #[constraint(symbolic)]
                pub fn equation($a: Coord, $b: Coord) -> f64 { let value = $value; value }
            })*

            #[test]
            fn slopes_that_do_not_exist_are_not_numbers() {
                let mut wrong = Vec::new();
                $(for (route, found) in ["symbolic", "dual"].into_iter().zip(by_both_routes(&$name::equation(any_coord(), any_coord()), &$at)) {
                    assert!(found[0].is_finite(), "{}: C is {}", stringify!($name), found[0]);
                    if found[1].is_finite() {
                        wrong.push(format!("{}, {route}: the slope is {}", stringify!($name), found[1]));
                    }
                })*
                assert!(wrong.is_empty(), "{}", wrong.join("\n"));
            }
        };
    }

    singular! {
        root_of_square |a, b| (a * a).sqrt(), [0.0, 0.3];
        length_of_nothing |a, b| (a * a + b * b).sqrt(), [0.0, 0.0];
        norm_of_nothing |a, b| vec2(a, b).norm(), [0.0, 0.0];
        hypot_of_nothing |a, b| a.hypot(b), [0.0, 0.0];
        root |a, b| a.sqrt(), [0.0, 0.3];
        root_of_power |a, b| a.powi(6).sqrt(), [0.0, 0.3];
        cube_root |a, b| (a * b).cbrt(), [0.0, 0.3];
        angle_at_its_end |a, b| (a * b).acos(), [0.5, 2.0];
        half_power |a, b| (a * a).powf(0.25), [0.0, 0.3];
        taken_side |a, b| (a * a).max(0.0).sqrt(), [0.0, 0.3];
        tie |a, b| (a * a).clamp(0.0, 1.0).sqrt(), [0.0, 0.3];
        chosen_side |a, b| (if a >= 0.0 { a * a } else { 0.0 }).sqrt(), [0.0, 0.3];
        own |a, b| super::super::root(a * a), [0.0, 0.3];
        own_chosen |a, b| super::super::clipped(a * a), [0.0, 0.3];
        pole |a, b| (1.0 / a).atan(), [0.0, 0.3];
        pole_beside_an_exponential |a, b| (1.0 / (a * b.exp())).atan(), [0.0, 0.3];
        pole_of_an_exponential |a, b| (b.exp() / a).tanh(), [0.0, 0.3];
        angle_of_nothing |a, b| (a * a).atan2(b * b), [0.0, 0.0];
    }
}

#[constraint]
fn distance_by_hand(x: Coord, l: f64) -> f64 {
    (x * x).sqrt() - l
}

#[constraint(dual)]
fn distance_by_dual(x: Coord, l: f64) -> f64 {
    (x * x).sqrt() - l
}

/// The dual route gave the slope 0 without a word, and Newton's method a singular matrix.
#[test]
fn a_distance_of_zero_is_blamed_on_both_routes() {
    for dual in [false, true] {
        let mut m = Mechanism::new("distance");
        let x = m.length("x", 0.0).unwrap();
        if dual {
            m.add("rod", distance_by_dual(x, 0.0)).unwrap()
        } else {
            m.add("rod", distance_by_hand(x, 0.0)).unwrap()
        };
        // From this guess alone: the search for an assembly would begin elsewhere.
        let options = kin::SolverOptions::new().rescue(false);
        let error = m.build().unwrap().run_both_with([0.0], &options).expect_err("no slope");
        let text = error.to_string();
        assert!(
            matches!(error.kind(), Some(FailureKind::NotFinite { quantity: "C_q", .. })),
            "{text}"
        );
        assert!(text.contains("`(x * x).sqrt()` has no finite slope"), "{text}");
    }
}

/// A measure and a whole run over the edge: a stop that is out of touch has no force and no slope.
#[constraint]
#[measure(touch = (1.0 - x * x).max(0.0).sqrt(), "m")]
fn cushion(x: Coord, y: Coord) -> f64 {
    y - (1.0 - x * x).max(0.0).sqrt()
}

#[test]
fn a_run_goes_on_where_the_side_is_not_taken() {
    let mut m = Mechanism::new("cushion");
    let x = m.length("x", 0.5).unwrap();
    let y = m.length("y", 0.8).unwrap();
    m.add("cushion", cushion(x, y)).unwrap();
    m.add("motor", drive(x, Law::linear(0.5, 1.0))).unwrap();
    let system = m.build().unwrap();
    let options = kin::SolverOptions::new().jerk(true);
    let motion = system.run_both_with([0.75, 1.0, 2.0], &options).expect("smooth from 1.25 on");
    assert!((0..3).all(|k| motion.q(k)[1] == 0.0
        && motion.qd(k)[1] == 0.0
        && motion.qdd(k)[1] == 0.0
        && motion.qddd(k)[1] == 0.0));
    let touch = system.measure(&motion, "cushion.touch").unwrap();
    assert!(touch.rate.values().iter().chain(touch.second_rate.values()).all(|x| *x == 0.0));
}

/// Nothing, as the difference of two numbers of order 1.
#[law]
fn nothing(x: f64, scale: f64) -> f64 {
    scale * (x.sin() * x.sin() + x.cos() * x.cos() - 1.0)
}

/// The same with derivatives by hand; `wrong` is added to the slope.
#[derive(Clone)]
struct Nothing {
    wrong: f64,
}

impl kin::extend::LawFunction for Nothing {
    fn jet(&self, x: f64) -> [f64; 4] {
        let (s, c) = x.sin_cos();
        [s * s + c * c - 1.0, 2.0 * s * c - 2.0 * c * s + self.wrong, 0.0, 0.0]
    }
}

#[constraint]
fn nothing_but(x: Coord, y: Coord) -> f64 {
    x + (y.sin() * y.sin() + y.cos() * y.cos() - 1.0)
}

#[test]
fn check_does_not_cry_wolf_over_what_cancels() {
    for scale in [1e-9, 1.0, 1e9] {
        kin::check::law(&nothing(scale), -3.0, 4.0);
    }
    kin::check::law(&(nothing(1.0) + Law::constant(0.0)), -3.0, 4.0);
    kin::check::law(&Law::new(Nothing { wrong: 0.0 }), -3.0, 4.0);
    kin::check::derivatives(nothing_but(any_coord(), any_coord()));
    // Faults beyond rounding are found.
    for wrong in [1e-6, -1e-3, f64::NAN] {
        let told = kin::check::compare_law(&Law::new(Nothing { wrong }), -3.0, 4.0);
        let expected = "the derivative of order 1 at x = ";
        assert!(told.is_err_and(|told| told.to_string().contains(expected)), "{wrong}");
    }
}
