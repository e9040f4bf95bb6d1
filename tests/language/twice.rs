//! Functions that are compiled twice: by `#[constraint]`, and by rustc alone over f64. Both give
//! the same C, and the constraint's derivatives agree with dual numbers and with differences of
//! rustc's reading.

use std::panic::{AssertUnwindSafe, catch_unwind};

use kin::Constraint;
use kin::emitted::{PlanarState, SpatialState};
use kin::extend::dual_route::Equation;
use kin::extend::{Route, Routed};
use kin::nalgebra::DVector;

use crate::differences::{Estimate, LONGEST, apart, derivatives_by};

/// The coordinates of all arguments, taken one after the other.
pub struct Columns<'a>(&'a [f64], f64);

impl Columns<'_> {
    pub fn coord(&mut self) -> f64 {
        let (first, rest) = self.0.split_first().expect("a coordinate is left");
        self.0 = rest;
        *first
    }

    pub fn coords<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.coord())
    }

    pub fn planar(&mut self) -> PlanarState {
        PlanarState::new(self.coords())
    }

    pub fn time(&mut self) -> f64 {
        self.1
    }

    pub fn spatial(&mut self) -> SpatialState {
        SpatialState::new(self.coords())
    }
}

fn vector(seed: &mut u64, n: usize) -> Vec<f64> {
    (0..n).map(|_| number(seed)).collect()
}

/// Numbers spread over ±2.
fn number(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 53) as f64 * 4.0 - 2.0
}

/// Rustc's reading: C at local coordinates and a time.
type Plain<'a> = &'a dyn Fn(&[f64], f64) -> Vec<f64>;

/// Relative difference of C from rustc's reading, and of derivatives from extrapolated differences
/// of it.
const ROUNDING: f64 = 1e-12;
const DIFFERENCES: f64 = 1e-6;

/// States at which C is compared, and at which derivatives are; of so many that are tried for each.
const VALUES: usize = 80;
const DERIVATIVES: usize = 60;
const TRIED: usize = 15;

/// The facts that are known beforehand of a constraint.
pub enum Expected {
    /// It takes this route, with a reason if it is the slow one, and its function is finite nearly
    /// everywhere.
    Route(Route, Option<&'static str>),
    /// Nothing: where the function panics, or differences of it are no good, there is nothing to
    /// compare.
    Nothing,
}

/// The route is the expected one. C equals rustc's reading, C_q, C_t, Q_d and the right side for
/// the jerk equal differences of it, and both routes of the constraint agree.
pub fn agree<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
    constraint: E,
    expected: Expected,
    plain: impl Fn(&mut Columns) -> [f64; M],
) {
    let known = if let Expected::Route(route, reason) = expected {
        let explained = constraint.explain_route().to_string();
        assert_eq!(constraint.route(), route, "{explained}");
        assert_eq!(reason.is_some(), route == Route::Dual, "a reason belongs to the slow route");
        assert!(explained.contains(reason.unwrap_or_default()), "{explained}");
        true
    } else {
        false
    };
    let plain = |q: &[f64], t: f64| -> Vec<f64> {
        if known {
            return plain(&mut Columns(q, t)).to_vec();
        }
        catch_unwind(AssertUnwindSafe(|| plain(&mut Columns(q, t))))
            .unwrap_or([f64::NAN; M])
            .to_vec()
    };
    let finite = values_agree(&constraint, N, &plain, known);
    // A function that nobody knows may jump among the steps of its differences.
    let steps: &[f64] = if known { &[LONGEST] } else { &[LONGEST, LONGEST / 20.0] };
    let smooth = derivatives_agree(&constraint, N, &plain, steps);
    assert!(!known || finite == VALUES, "the function is finite at {finite} states only");
    assert!(
        !known || smooth == DERIVATIVES,
        "differences of the function are good at {smooth} states only"
    );
    // Of other functions differences at states without a choice say too little.
    for seed in (1..4).take_while(|_| known) {
        if let Err(mismatch) = kin::check::compare_from::<E, N, M>(&constraint, seed) {
            panic!("{mismatch}");
        }
    }
}

/// At how many states the function is finite. If it may panic, only these are compared.
fn values_agree(constraint: &dyn Constraint, n: usize, plain: Plain, known: bool) -> usize {
    let mut seed = 7;
    let mut finite = 0;
    for _ in 0..TRIED * VALUES {
        let q = vector(&mut seed, n);
        let t = 2.0 + number(&mut seed);
        let expected = plain(&q, t);
        if !known && expected.iter().any(|x| x.is_nan()) {
            continue;
        }
        let c = kin::extend::terms(constraint, &q, &[], t).c;
        for (row, (got, expected)) in c.iter().zip(&expected).enumerate() {
            let same = (got - expected).abs() <= ROUNDING * (1.0 + expected.abs())
                || !got.is_finite() && !expected.is_finite();
            assert!(same, "row {row} at {q:?}, t = {t}: {got}, and {expected} by rustc alone");
        }
        finite += usize::from(expected.iter().all(|x| x.is_finite()));
        if finite == VALUES {
            break;
        }
    }
    finite
}

/// At how many states the derivatives were compared, with differences by steps of these lengths.
/// States beside a kink are left out: differences say nothing there, and know it.
fn derivatives_agree(constraint: &dyn Constraint, n: usize, plain: Plain, steps: &[f64]) -> usize {
    let mut seed = 11;
    let mut compared = 0;
    for _ in 0..TRIED * DERIVATIVES {
        let [q, qd, qdd] = std::array::from_fn(|_| vector(&mut seed, n));
        let t = 2.0 + number(&mut seed);
        let along = |direction: &[f64], bend: &[f64], by: f64, s: f64| {
            let moved: Vec<f64> =
                (0..n).map(|k| q[k] + s * direction[k] + 0.5 * s * s * bend[k]).collect();
            plain(&moved, t + by * s)
        };
        let still = vec![0.0; n];
        let by_steps = |longest: f64| -> Vec<Estimate> {
            let [first, second, third] = derivatives_by(longest, &|s| along(&qd, &qdd, 1.0, s));
            let [c_t] = derivatives_by(longest, &|s| along(&still, &still, 1.0, s));
            let column = |k: usize| {
                let unit: Vec<f64> = (0..n).map(|j| f64::from(u8::from(j == k))).collect();
                let [column] = derivatives_by(longest, &|s| along(&unit, &still, 0.0, s));
                column
            };
            let columns: Vec<Estimate> = (0..n).map(column).collect();
            [c_t].into_iter().chain(columns).chain([first, second, third]).collect()
        };
        let mut all: Vec<Vec<Estimate>> = steps.iter().map(|&longest| by_steps(longest)).collect();
        let known = all.swap_remove(0);
        let is_good = |estimate: &Estimate| estimate.error < 0.1 * DIFFERENCES;
        let is_known = |(k, estimate): (usize, &Estimate)| {
            is_good(estimate)
                && all.iter().all(|other| apart(&estimate.value, &other[k].value) < DIFFERENCES)
        };
        if !known.iter().enumerate().all(is_known) {
            continue;
        }
        let own = kin::extend::terms(constraint, &q, &qd, t);
        let jerk = kin::extend::jerk_rhs(constraint, &q, &qd, &qdd, t).expect("the jerk is known");
        let rates = [&qd, &qdd].map(|rates| &own.c_q * DVector::from_column_slice(rates));
        let columns = own.c_q.column_iter().map(DVector::from);
        let found: Vec<DVector<f64>> = std::iter::once(own.c_t.clone())
            .chain(columns)
            .chain([&rates[0] + &own.c_t, &rates[1] - &own.q_d, -jerk])
            .collect();
        for (k, (found, known)) in found.iter().zip(&known).enumerate() {
            // A function that nobody knows may have teeth finer than any difference, as x % ε has.
            if steps.len() > 1 && known.value.iter().all(|x| *x == 0.0) {
                continue;
            }
            let apart = apart(&known.value, found.as_slice());
            assert!(
                apart < DIFFERENCES,
                "{} at {q:?}, {qd:?}, {qdd:?}, t = {t}: {found}, and {:?} by differences",
                term(k, n),
                known.value
            );
        }
        compared += 1;
        if compared == DERIVATIVES {
            break;
        }
    }
    compared
}

/// The name of derivative number `k`, in the order in which they are compared.
fn term(k: usize, n: usize) -> String {
    match k {
        0 => "C_t".to_owned(),
        k if k <= n => format!("column {} of C_q", k - 1),
        k => ["C_q q̇ + C_t", "C_q q̈ − Q_d", "−(right side for the jerk)"][k - n - 1].to_owned(),
    }
}

/// Compiles a function twice and compares. Behind it stand what its arguments are: `planar`,
/// `spatial`, `coord`, `coords`, `time`, or a value in parentheses; behind `Dual` stands why, and
/// of `Any` nothing is known.
#[macro_export]
macro_rules! twice {
    ($route:ident $($reason:literal)? $name:ident($($given:tt)*): $(#[$attribute:meta])* fn $($function:tt)*) => {
        mod $name {
            #[allow(unused_imports)]
            use super::*;
            pub mod compiled {
                #[allow(unused_imports)]
                use super::*;
                #[allow(unused_imports)]
                use kin::prelude::*;
                #[constraint]
                $(#[$attribute])*
                pub fn $($function)*
            }
            #[allow(clippy::all, clippy::pedantic, clippy::nursery)]
            pub mod plain {
                #[allow(unused_imports)]
                use super::*;
                #[allow(unused_imports)]
                use kin::prelude::*;
                #[allow(dead_code)]
                type Planar = kin::emitted::PlanarState;
                #[allow(dead_code)]
                type Spatial = kin::emitted::SpatialState;
                #[allow(dead_code)]
                type Coord = f64;
                #[allow(dead_code)]
                type Time = f64;
                pub fn $($function)*
            }
            #[test]
            fn is_read_as_rustc_reads_it() {
                let constraint = $crate::made!(compiled::f; []; $($given)*);
                let expected = $crate::expected!($route $($reason)?);
                $crate::twice::agree(constraint, expected, |q| kin::emitted::rows($crate::called!(plain::f; q; []; $($given)*)));
            }
            $crate::from_text! { $route $($given)* }
        }
    };
}

/// The test that the text which the constraint keeps is read as it is compiled; none of `Any`.
#[macro_export]
macro_rules! from_text {
    (Any $($given:tt)*) => {};
    ($route:ident $($given:tt)*) => {
        #[test]
        fn is_the_same_from_its_text() {
            $crate::text::agrees(module_path!(), &$crate::made!(compiled::f; []; $($given)*));
        }
    };
}

/// The facts that are known beforehand: the route, or nothing.
#[macro_export]
macro_rules! expected {
    (Any) => {
        $crate::twice::Expected::Nothing
    };
    ($route:ident) => {
        $crate::twice::Expected::Route(kin::extend::Route::$route, None)
    };
    ($route:ident $reason:literal) => {
        $crate::twice::Expected::Route(kin::extend::Route::$route, Some($reason))
    };
}

/// The constructor's call.
#[macro_export]
macro_rules! made {
    ($f:path; [$($done:expr,)*];) => { $f($($done),*) };
    ($f:path; [$($done:expr,)*]; planar $($rest:tt)*) => { $crate::made!($f; [$($done,)* kin::check::any_planar(),]; $($rest)*) };
    ($f:path; [$($done:expr,)*]; spatial $($rest:tt)*) => { $crate::made!($f; [$($done,)* kin::check::any_spatial(),]; $($rest)*) };
    ($f:path; [$($done:expr,)*]; coord $($rest:tt)*) => { $crate::made!($f; [$($done,)* kin::check::any_coord(),]; $($rest)*) };
    ($f:path; [$($done:expr,)*]; coords $($rest:tt)*) => {
        $crate::made!($f; [$($done,)* std::array::from_fn(|_| kin::check::any_coord()),]; $($rest)*)
    };
    ($f:path; [$($done:expr,)*]; planars $($rest:tt)*) => {
        $crate::made!($f; [$($done,)* std::array::from_fn(|_| kin::check::any_planar()),]; $($rest)*)
    };
    ($f:path; [$($done:expr,)*]; spatials $($rest:tt)*) => {
        $crate::made!($f; [$($done,)* std::array::from_fn(|_| kin::check::any_spatial()),]; $($rest)*)
    };
    ($f:path; [$($done:expr,)*]; time $($rest:tt)*) => { $crate::made!($f; [$($done,)*]; $($rest)*) };
    ($f:path; [$($done:expr,)*]; ($value:expr) $($rest:tt)*) => { $crate::made!($f; [$($done,)* $value,]; $($rest)*) };
}

/// The call of the function itself.
#[macro_export]
macro_rules! called {
    ($f:path; $q:ident; [$($done:expr,)*];) => { $f($($done),*) };
    ($f:path; $q:ident; [$($done:expr,)*]; planar $($rest:tt)*) => { $crate::called!($f; $q; [$($done,)* $q.planar(),]; $($rest)*) };
    ($f:path; $q:ident; [$($done:expr,)*]; spatial $($rest:tt)*) => { $crate::called!($f; $q; [$($done,)* $q.spatial(),]; $($rest)*) };
    ($f:path; $q:ident; [$($done:expr,)*]; coord $($rest:tt)*) => { $crate::called!($f; $q; [$($done,)* $q.coord(),]; $($rest)*) };
    ($f:path; $q:ident; [$($done:expr,)*]; coords $($rest:tt)*) => { $crate::called!($f; $q; [$($done,)* $q.coords(),]; $($rest)*) };
    ($f:path; $q:ident; [$($done:expr,)*]; planars $($rest:tt)*) => {
        $crate::called!($f; $q; [$($done,)* std::array::from_fn(|_| $q.planar()),]; $($rest)*)
    };
    ($f:path; $q:ident; [$($done:expr,)*]; spatials $($rest:tt)*) => {
        $crate::called!($f; $q; [$($done,)* std::array::from_fn(|_| $q.spatial()),]; $($rest)*)
    };
    ($f:path; $q:ident; [$($done:expr,)*]; time $($rest:tt)*) => { $crate::called!($f; $q; [$($done,)* $q.time(),]; $($rest)*) };
    ($f:path; $q:ident; [$($done:expr,)*]; ($value:expr) $($rest:tt)*) => { $crate::called!($f; $q; [$($done,)* $value,]; $($rest)*) };
}
