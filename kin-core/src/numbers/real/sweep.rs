//! Tests a list of functions: compares each derivative with central differences of the derivative
//! below it.

use crate::numbers::real::{Dual2_64, Dual3_64, Dual64, HyperDual64};

use super::Real;

/// One function in every kind of number.
struct Function {
    name: &'static str,
    plain: fn(f64) -> f64,
    first: fn(Real<Dual64>) -> Real<Dual64>,
    second: fn(Real<Dual2_64>) -> Real<Dual2_64>,
    third: fn(Real<Dual3_64>) -> Real<Dual3_64>,
    mixed: fn(Real<HyperDual64>) -> Real<HyperDual64>,
}

macro_rules! list {
    ($($name:literal $x:ident => $e:expr),* $(,)?) => {
        [$(Function { name: $name, plain: |$x| $e, first: |$x| $e, second: |$x| $e, third: |$x| $e, mixed: |$x| $e }),*]
    };
}

#[rustfmt::skip]
fn everywhere() -> Vec<Function> {
    list![
        "sin" x => x.sin(), "cos" x => x.cos(), "tan" x => x.tan(), "sin_cos" x => x.sin_cos().0 * x.sin_cos().1,
        "atan" x => x.atan(), "sinh" x => x.sinh(), "cosh" x => x.cosh(), "tanh" x => x.tanh(), "asinh" x => x.asinh(),
        "exp" x => x.exp(), "exp2" x => x.exp2(), "exp_m1" x => x.exp_m1(), "cbrt" x => x.cbrt(), "recip" x => x.recip(),
        "abs" x => x.abs(), "fract" x => x.fract(), "to_radians" x => x.to_radians(), "to_degrees" x => x.to_degrees(),
        "signum" x => x.signum(), "floor" x => x.floor(), "ceil" x => x.ceil(), "round" x => x.round(), "trunc" x => x.trunc(),
        "powi 0" x => x.powi(0), "powi 1" x => x.powi(1), "powi 2" x => x.powi(2), "powi 5" x => x.powi(5), "powi -3" x => x.powi(-3),
        "+ - *" x => 2.0 * x * x - (x + 1.0) * (3.0 - x), "/" x => (x + 2.0) / (x * x + 1.0), "%" x => (x * x) % 0.9,
    ].into()
}

#[rustfmt::skip]
fn within() -> Vec<(Function, Vec<f64>)> {
    let on = |points: &[f64], functions: Vec<Function>| functions.into_iter().map(|f| (f, points.to_vec())).collect::<Vec<_>>();
    let mut all = on(&[-2.3, -0.7, 0.3, 0.8, 1.7], everywhere());
    all.extend(on(&[-0.8, 0.1, 0.7], list!["asin" x => x.asin(), "acos" x => x.acos(), "atanh" x => x.atanh()].into()));
    all.extend(on(&[1.2, 3.0], list!["acosh" x => x.acosh()].into()));
    all.extend(on(&[0.2, 1.0, 4.1], list![
        "ln" x => x.ln(), "ln_1p" x => x.ln_1p(), "log2" x => x.log2(), "log10" x => x.log10(), "log" x => x.log(3.0),
        "sqrt" x => x.sqrt(), "powf" x => x.powf(1.7), "x^x" x => x.powf(x),
    ].into()));
    all.extend(on(&[-1.3, 0.4, 2.1], list![
        "atan2" x => x.sin().atan2(x.cos() * 0.5), "hypot" x => (x + 0.1).hypot(x * x), "max" x => x.max(x * x), "min" x => x.min(1.0),
        "clamp" x => x.clamp(-1.0, 1.0), "mul_add" x => x.mul_add(x.sin(), x), "rem_euclid" x => x.rem_euclid(0.9),
        "div_euclid" x => x.div_euclid(0.9), "copysign" x => x.exp().copysign(x),
    ].into()));
    all
}

const H: f64 = 1e-5;

fn close(name: &str, x: f64, a: f64, b: f64) {
    assert!((a - b).abs() < 1e-7 * (1.0 + a.abs().max(b.abs())), "{name} at {x}: {a} is not {b}");
}

fn slope(f: impl Fn(f64) -> f64) -> f64 {
    (f(H) - f(-H)) / (2.0 * H)
}

#[test]
fn each_derivative_is_the_slope_of_the_one_below() {
    let a = 0.8;
    let b = -0.6;
    let c = 1.1;
    let p = move |s: f64| a * s + b * s * s / 2.0 + c * s.powi(3) / 6.0;
    let v = move |s: f64| a + b * s + c * s * s / 2.0;
    let w = move |s: f64| b + c * s;
    for (f, points) in within() {
        for x in points {
            let first = |s: f64| (f.first)(Real(Dual64::new(x + p(s), v(s)))).0;
            let second = |s: f64| (f.second)(Real(Dual2_64::new(x + p(s), v(s), w(s)))).0;
            let third = (f.third)(Real(Dual3_64::new(x, a, b, c))).0;
            close(f.name, x, first(0.0).eps, slope(|s| (f.plain)(x + p(s))));
            close(f.name, x, second(0.0).v2, slope(|s| first(s).eps));
            close(f.name, x, third.v3, slope(|s| second(s).v2));
            close(f.name, x, second(0.0).v1, first(0.0).eps);
        }
    }
}

#[test]
fn the_mixed_derivative_is_the_slope_of_a_slope() {
    let a = 0.8;
    let b = -0.6;
    let c = 1.1;
    for (f, points) in within() {
        for x in points {
            let mixed = (f.mixed)(Real(HyperDual64::new(x, a, b, c))).0;
            let first = |s: f64| (f.first)(Real(Dual64::new(x + b * s, a + c * s))).0;
            close(f.name, x, mixed.eps1, first(0.0).eps);
            close(f.name, x, mixed.eps2, slope(|s| (f.plain)(x + b * s)));
            close(f.name, x, mixed.eps1eps2, slope(|s| first(s).eps));
        }
    }
}

#[test]
fn values_are_those_of_f64_and_constants_stay_constant() {
    for (f, _) in within() {
        for x in [-0.0, 0.0, 1.0, -1.0, 0.3, -2.5, 7.0, f64::INFINITY, f64::NAN] {
            let y = (f.third)(Real::from(x));
            let plain = (f.plain)(x);
            assert!(
                y.value() == plain || y.is_nan() && plain.is_nan(),
                "{} at {x}: {} is not {plain}",
                f.name,
                y.value()
            );
            assert!(y.is_constant() || !x.is_finite(), "{} at {x}: {y}", f.name);
        }
    }
}
