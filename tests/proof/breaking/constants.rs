//! Numbers that are not those of f64: decimals, constants that f64 rounds, and the library's
//! functions at their worst arguments.

use super::{Case, lengths, moved};
use crate::wide::{Wide, dec, w};
use kin::prelude::*;

/// z = f(k)
macro_rules! functions {
    ($($name:ident $f:ident [$($k:expr),*])*) => {
        $(#[constraint]
        fn $name(z: Coord, k: f64) -> f64 {
            z - k.$f()
        })*

        fn of_one() -> Vec<Case> {
            let mut all = Vec::new();
            $(for k in [$($k),*] {
                all.push(case(format!("{} of {k:e}", stringify!($f)), |m, z| m.add("z", $name(z, k)).map(|_| ()), w(k).$f()));
            })*
            all
        }
    };
}

functions! {
    sine sin [1.0, 22.0, 355.0, 1e15, 3.0, 1e22, 5.319372648326541e255]
    cosine cos [1.0, 11.0, 1e15, 1.5707963267948966, 5.319372648326541e255]
    tangent tan [1.5707963267948966, 11.0, 1e9, 4.71238898038469]
    arc_sine asin [1.0 - 1e-16, -1.0 + 1e-16, 0.5, 1e-9]
    arc_cosine acos [1.0 - 1e-16, 1.0 - 1e-12, -1.0 + 1e-15, 0.9999]
    arc_tangent atan [1e-9, 1e9, 1e300]
    hyperbolic_sine sinh [1e-9, 0.3, 30.0, 700.0]
    hyperbolic_cosine cosh [1e-9, 1.0, 700.0]
    hyperbolic_tangent tanh [1e-9, 0.5, 19.0]
    area_sine asinh [1e-9, -1e-5, 1e10, -3.0]
    area_cosine acosh [1.0 + 1e-15, 1.0 + 1e-12, 1.0 + 1e-9, 1.0001, 1e10, 1.5]
    area_tangent atanh [-1.0 + 1e-9, 1.0 - 1e-16, -1.0 + 1e-15, 1e-9, -0.5, 0.999]
    exponential exp [700.0, -700.0, 1e-9, 0.5]
    logarithm ln [1.0 + 1e-15, 1.0 - 1e-16, 1e-300, 0.999]
    binary_logarithm log2 [1.0 + 1e-15, 1e300, 0.7]
    decimal_logarithm log10 [1.0 + 1e-15, 1e-300, 999.0]
    square_root sqrt [2.0, 1e-300, 0.1]
    cubic_root cbrt [2.0, 1e-300, 0.1]
}

/// Each expression once for the compiler and once, or as a decimal, in 77 digits.
macro_rules! numbers {
    ($($name:ident { $f:expr } { $wide:expr })*) => {
        $(#[constraint]
        fn $name(z: Coord) -> f64 {
            z - ($f)
        })*

        fn of_none() -> Vec<Case> {
            vec![$(case(stringify!($name).to_string(), |m, z| m.add("z", $name(z)).map(|_| ()), $wide)),*]
        }
    };
}

numbers! {
    three_tenths { 0.1 * 3.0 } { dec("0.3") }
    a_third { 1.0 / 3.0 } { w(1.0) / w(3.0) }
    lost_and_found { (1e16 + 1.0) - 1e16 } { w(1.0) }
    lost_in_a_product { (1e8 + 1e-8) * (1e8 - 1e-8) - 1e16 } { -dec("1e-16") }
    sum_of_tenths { (0.1 + 0.2 - 0.3) * 1e16 } { w(0.0) }
    the_same_number { (0.30000000000000001 - 0.3) * 1e20 } { dec("1e3") }
    root_of_two { 2.0_f64.sqrt() * 2.0_f64.sqrt() } { w(2.0) }
    power { 1.1_f64.powi(30) } { (0..30).fold(w(1.0), |p, _| p * dec("1.1")) }
    half_turn { 180.0_f64.to_radians() } { Wide::pi() }
    in_degrees { 1.0_f64.to_degrees() } { 180.0 / Wide::pi() }
    tiny { 1e-400 * 1e200 } { dec("1e-200") }
    nested { (0.1 + (0.2 + (0.3 + 1e10))) - 1e10 } { dec("0.6") }
    of_functions { 0.1_f64.sin().hypot(0.1_f64.cos()) } { w(1.0) }
    exponential_of_ten { 10.0_f64.exp().ln() } { w(10.0) }
}

#[constraint]
fn step_of_a_decimal(z: Coord) -> f64 {
    z - (0.3_f64 * 10.0).floor()
}

#[constraint]
fn step_of_a_rounded_product(z: Coord, k: f64) -> f64 {
    z - (k * 10.0).floor()
}

#[constraint]
fn branch_of_decimals(z: Coord) -> f64 {
    z - if 0.1 + 0.2 > 0.3 { 1.0 } else { 0.0 }
}

#[constraint]
fn branch_of_a_root(z: Coord) -> f64 {
    z - if 2.0_f64.sqrt() * 2.0_f64.sqrt() > 2.0 { 1.0 } else { 0.0 }
}

/// z is a number.
fn case(
    name: String,
    add: impl FnOnce(&mut Mechanism, Coordinate) -> kin::Result<()>,
    exact: Wide,
) -> Case {
    let system = lengths([exact.show().parse().unwrap_or(0.0)], |m, [z]| add(m, z));
    let motion = moved(&system, &[0.0, 1.0]).unwrap_or_else(|| panic!("{name} has a position"));
    Case {
        name,
        honest: true,
        system,
        motion,
        solutions: Box::new(move |_| vec![(0, vec![exact.clone()])]),
    }
}

pub fn cases() -> Vec<Case> {
    let mut all = of_one();
    all.extend(of_none());
    // steps and branches of what no f64 is: where f64 is on the other side there is no proof
    let mut trap =
        |name: &str, add: fn(&mut Mechanism, Coordinate) -> kin::Result<()>, exact: f64| {
            all.push(Case { honest: false, ..case(name.to_string(), add, w(exact)) });
        };
    trap("step of a decimal", |m, z| m.add("z", step_of_a_decimal(z)).map(|_| ()), 3.0);
    // 0.3 as f64 is below 3/10
    trap(
        "step of a rounded product",
        |m, z| m.add("z", step_of_a_rounded_product(z, 0.3)).map(|_| ()),
        2.0,
    );
    trap("branch of decimals", |m, z| m.add("z", branch_of_decimals(z)).map(|_| ()), 0.0);
    trap("branch of a root", |m, z| m.add("z", branch_of_a_root(z)).map(|_| ()), 0.0);
    all
}
