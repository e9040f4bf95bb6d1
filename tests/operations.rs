//! Every operation of the language, one list: symbolic = dual at ordinary and at nasty points, =
//! central differences wherever the function is smooth nearby, and the documented one-sided value
//! at kinks.

use kin::check::any_coord;
use kin::extend::{dual_terms, terms};
use kin::prelude::*;

/// A point and the slope that is documented there; `None` where no derivative exists (both routes
/// must say so) or nothing special is promised.
type Nasty = &'static [(f64, Option<f64>)];

/// Smooth everywhere that `check` looks: no nasty points but these.
const ORDINARY: Nasty = &[
    (0.0, None),
    (-0.0, None),
    (PI, None),
    (-PI, None),
    (0.5 * PI, None),
    (1.0, None),
    (-1.0, None),
    (1e-300, None),
    (1e8, None),
];

macro_rules! operations {
    ($($name:ident = |$a:ident| $value:expr, $nasty:expr;)*) => {
        $(mod $name {
            use kin::prelude::*;
            #[constraint(symbolic)]
            pub fn operation($a: Coord, t: Time) -> f64 {
                let moved = $value;
                moved - t * t
            }
        })*

        #[test]
        fn routes_agree_at_ordinary_states() {
            $(compare(stringify!($name), &$name::operation(any_coord()));)*
        }

        #[test]
        fn routes_agree_at_nasty_points() {
            $(nasty(stringify!($name), &$name::operation(any_coord()), ORDINARY);
              nasty(stringify!($name), &$name::operation(any_coord()), $nasty);)*
        }

        /// The list and the vocabulary of the compiler are the same: a function without an entry
        /// here is found by its name.
        const LISTED: &[&str] = &[$(stringify!($name)),*];
    };
}

/// Both routes and central differences at states spread over ±2.
fn compare<E: kin::extend::dual_route::Equation<1, 1> + Clone>(name: &str, operation: &E) {
    let report = kin::check::compare::<E, 1, 1>(operation)
        .unwrap_or_else(|mismatch| panic!("{name}: {mismatch}"));
    assert!(report.states >= 6, "{name} was compared at {} states only", report.states);
}

/// Value, slope and curvature on both routes at chosen points: equal, or not finite on both.
fn nasty<E: kin::extend::dual_route::Equation<1, 1> + Clone>(
    name: &str,
    operation: &E,
    points: Nasty,
) {
    for &(at, slope) in points {
        let own = terms(operation, &[at], &[1.0], 0.0);
        let dual = dual_terms::<E, 1, 1>(operation, &[at], &[1.0], 0.0);
        // Outside of its domain the value itself is the error; derivatives are not asked for.
        if !own.c[0].is_finite() && !dual.c[0].is_finite() {
            continue;
        }
        let slopes = |all: &kin::extend::Terms| [all.c[0], all.c_q[(0, 0)], all.q_d[0]];
        for (what, (a, b)) in
            ["C", "C_q", "Q_d"].iter().zip(slopes(&own).into_iter().zip(slopes(&dual)))
        {
            let same =
                (a - b).abs() <= 1e-13 * (1.0 + b.abs()) || (!a.is_finite() && !b.is_finite());
            assert!(same, "{name} at {at:e}: {what} is {a} symbolic and {b} dual");
        }
        if let Some(slope) = slope {
            assert_eq!(own.c_q[(0, 0)], slope, "{name} at {at:e}: documented slope");
        }
    }
}

operations! {
    sin = |a| a.sin(), &[(0.0, Some(1.0))];
    cos = |a| a.cos(), &[(0.0, Some(0.0))];
    tan = |a| a.tan(), &[(0.0, Some(1.0))];
    asin = |a| (0.45 * a).asin(), &[(0.0, Some(0.45))];
    acos = |a| (0.45 * a).acos(), &[(0.0, Some(-0.45))];
    atan = |a| a.atan(), &[(0.0, Some(1.0))];
    sinh = |a| a.sinh(), &[(0.0, Some(1.0))];
    cosh = |a| a.cosh(), &[(0.0, Some(0.0))];
    tanh = |a| a.tanh(), &[(0.0, Some(1.0))];
    asinh = |a| a.asinh(), &[(0.0, Some(1.0))];
    acosh = |a| (a * a + 1.5).acosh(), &[(0.0, Some(0.0))];
    atanh = |a| (0.45 * a).atanh(), &[(0.0, Some(0.45))];
    exp = |a| a.exp(), &[(0.0, Some(1.0))];
    exp2 = |a| a.exp2(), &[(0.0, Some(std::f64::consts::LN_2))];
    exp_m1 = |a| a.exp_m1(), &[(0.0, Some(1.0))];
    ln = |a| a.ln(), &[(1.0, Some(1.0))];
    ln_1p = |a| (0.4 * a).ln_1p(), &[(0.0, Some(0.4))];
    log2 = |a| a.log2(), &[];
    log10 = |a| a.log10(), &[];
    log = |a| a.log(3.0), &[];
    sqrt = |a| a.sqrt(), &[(1.0, Some(0.5)), (4.0, Some(0.25))];
    cbrt = |a| a.cbrt(), &[(8.0, Some(1.0 / 12.0)), (-8.0, Some(1.0 / 12.0))];
    abs = |a| a.abs(), &[(0.0, Some(1.0)), (-0.0, Some(1.0)), (-1e-300, Some(-1.0))];
    signum = |a| a.signum() * a, &[];
    floor = |a| a.floor(), &[(1.0, Some(0.0)), (-1.0, Some(0.0))];
    ceil = |a| a.ceil(), &[(1.0, Some(0.0))];
    round = |a| a.round(), &[(0.5, Some(0.0)), (-0.5, Some(0.0))];
    trunc = |a| a.trunc(), &[(-1.0, Some(0.0))];
    fract = |a| a.fract(), &[(2.0, Some(1.0))];
    atan2 = |a| a.atan2(0.7), &[(0.0, Some(1.0 / 0.7))];
    atan2_of_x = |a| f64::atan2(0.7, a), &[(0.0, Some(-1.0 / 0.7))];
    hypot = |a| a.hypot(0.5), &[(0.0, Some(0.0))];
    powf = |a| (a * a + 0.1).powf(1.5), &[(0.0, Some(0.0))];
    power_at_zero = |a| a.powf(3.5), &[(0.0, Some(0.0))];
    power_with_a_moving_exponent = |a| 2.0f64.powf(a) + (a * a + 1.0).powf(a), &[];
    max = |a| a.max(0.5), &[(0.5, Some(1.0)), (0.4, Some(0.0))];
    max_of_two = |a| (2.0 * a).max(3.0 * a), &[(0.0, Some(2.0))];
    min = |a| a.min(0.5), &[(0.5, Some(1.0)), (0.6, Some(0.0))];
    min_of_two = |a| (2.0 * a).min(3.0 * a), &[(0.0, Some(2.0))];
    clamp = |a| a.clamp(-0.5, 0.5), &[(0.2, Some(1.0)), (0.7, Some(0.0))];
    rem = |a| a % 0.75, &[(0.75, Some(1.0)), (-0.75, Some(1.0))];
    rem_euclid = |a| a.rem_euclid(0.75), &[(0.75, Some(1.0)), (-0.1, Some(1.0))];
    div_euclid = |a| a.div_euclid(0.75) + a, &[(0.75, Some(1.0))];
    moving_divisor = |a| 5.0 % (a + 3.0) + 7.0f64.rem_euclid(a + 3.0), &[];
    recip = |a| a.recip(), &[(2.0, Some(-0.25))];
    copysign = |a| a.copysign(-1.0), &[(0.0, Some(-1.0)), (-2.0, Some(1.0))];
    mul_add = |a| a.mul_add(2.0, a), &[(0.0, Some(3.0))];
    to_radians = |a| a.to_radians(), &[];
    to_degrees = |a| a.to_degrees(), &[];
    sin_cos = |a| { let (s, c) = a.sin_cos(); s * c }, &[(0.0, Some(1.0))];
    powi_minus_4 = |a| a.powi(-4), &[];
    powi_minus_1 = |a| a.powi(-1), &[];
    powi_0 = |a| a.powi(0) + a, &[(0.0, Some(1.0))];
    powi_1 = |a| a.powi(1), &[(0.0, Some(1.0))];
    powi_2 = |a| a.powi(2), &[(0.0, Some(0.0))];
    powi_3 = |a| a.powi(3), &[(0.0, Some(0.0))];
    powi_6 = |a| a.powi(6), &[(0.0, Some(0.0))];
    add_sub_mul_div = |a| (a + 2.0) * (1.0 - a) / (a * a + 0.5) - -a, &[];
    quotient_at_zero = |a| 1.0 / a, &[(0.0, None)];
    selection = |a| if a > 0.5 { a * a } else { 0.5 * a }, &[(0.5, Some(0.5)), (0.6, Some(1.2))];
    selection_of_an_undefined_branch = |a| if a == 0.0 { 1.0 + a } else { a.sin() / a }, &[(0.0, Some(1.0))];
    conditions = |a| if (a >= 0.0 && a < 1.0) || !(a <= 1.5) { 2.0 * a } else { -a }, &[(0.0, Some(2.0)), (1.0, Some(-1.0)), (1.5, Some(-1.0))];
    dot_cross_norm = |a| { let v = vec3(a, 1.0, a * a); v.dot(vec3(1.0, 2.0, a)) + v.cross(vec3(a, 0.0, 1.0)).norm() + v.normalize().y }, &[];
    planar_vectors = |a| { let v = vec2(a, 2.0); v.perp().cross(v) + v.lerp(vec2(1.0, a), 0.3).norm_squared() + v.component_mul(v).norm() }, &[];
    matrices = |a| { let m = Mat2::rotation(a) * Mat2::new(1.0, a, 0.0, 2.0); m.determinant() + m.trace() + (m.transpose() * vec2(a, 1.0)).x }, &[];
    norm_of_a_constant = |a| a * vec2(0.0, 0.0).norm() + a, &[(0.0, Some(1.0))];
}

#[test]
fn every_function_of_f64_that_the_readme_speaks_of_is_listed() {
    let words = "sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh exp exp2 exp_m1 ln ln_1p log2 log10 log sqrt cbrt abs signum floor ceil \
                 round trunc fract atan2 hypot powf max min clamp rem rem_euclid div_euclid recip copysign mul_add to_radians to_degrees sin_cos";
    let missing: Vec<&str> =
        words.split_whitespace().filter(|word| !LISTED.contains(word)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// `log` and `copysign` are no functions of their own but other ways to write what the list has: to
/// the last bit the same as f64's.
#[constraint(symbolic)]
fn written_otherwise(a: Coord, b: Coord) -> [f64; 2] {
    [a.log(b), a.copysign(b)]
}

#[test]
fn logarithms_to_a_base_and_copied_signs_are_those_of_f64_to_the_last_bit() {
    const VALUES: [f64; 9] = [0.0, -0.0, 1e-300, 0.1, 1.0, -1.5, 7.3, 1e300, f64::INFINITY];
    for a in VALUES {
        for b in VALUES {
            let c = terms(&written_otherwise(any_coord(), any_coord()), &[a, b], &[], 0.0).c;
            for (own, expected) in c.iter().zip([a.log(b), a.copysign(b)]) {
                let same = own.to_bits() == expected.to_bits() || own.is_nan() && expected.is_nan();
                assert!(same, "{a} {b}: {own}, not {expected}");
            }
        }
    }
}
