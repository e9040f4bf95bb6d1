//! Functions that are compiled twice: by `#[constraint]`, and by rustc alone over f64. Both give the same C,
//! and the constraint's derivatives agree with dual numbers and with central differences.

use kin::Route;
use kin::dual_route::Equation;
use kin::emitted::{PlanarState, SpatialState};

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

/// Numbers spread over ±2.
fn numbers(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 53) as f64 * 4.0 - 2.0
}

/// C equals rustc's reading at 80 states, and all routes to the derivatives agree at 72.
pub fn agree<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
    constraint: E,
    route: Route,
    plain: impl Fn(&mut Columns) -> [f64; M],
) {
    assert_eq!(constraint.route(), route, "{:?}", constraint.explain_route());
    let (mut seed, mut finite) = (7, 0);
    for _ in 0..80 {
        let q: [f64; N] = std::array::from_fn(|_| numbers(&mut seed));
        let t = 2.0 + numbers(&mut seed);
        let expected = plain(&mut Columns(&q, t));
        let c = kin::terms(&constraint, &q, &[], t).c;
        for (row, (got, expected)) in c.iter().zip(expected).enumerate() {
            let same = (got - expected).abs() <= 1e-12 * (1.0 + expected.abs())
                || !got.is_finite() && !expected.is_finite();
            assert!(same, "row {row} at {q:?}, t = {t}: {got}, and {expected} by rustc alone");
            finite += usize::from(expected.is_finite());
        }
    }
    assert!(finite > 20, "hardly a state at which the function is finite");
    for seed in [1, 2, 3] {
        if let Err(mismatch) = kin::check::compare_from::<E, N, M>(&constraint, seed) {
            panic!("{mismatch}");
        }
    }
}

/// Compiles a function twice and compares. Behind it stand what its arguments are: `planar`, `spatial`,
/// `coord`, `coords`, `time`, or a value in parentheses.
#[macro_export]
macro_rules! twice {
    ($route:ident $name:ident($($given:tt)*): $(#[$attribute:meta])* fn $($function:tt)*) => {
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
                $crate::twice::agree(constraint, kin::Route::$route, |q| kin::emitted::rows($crate::called!(plain::f; q; []; $($given)*)));
            }
        }
    };
}

/// The constructor's call.
#[macro_export]
macro_rules! made {
    ($f:path; [$($done:expr,)*];) => { $f($($done),*) };
    ($f:path; [$($done:expr,)*]; planar $($rest:tt)*) => { $crate::made!($f; [$($done,)* kin::any_planar(),]; $($rest)*) };
    ($f:path; [$($done:expr,)*]; spatial $($rest:tt)*) => { $crate::made!($f; [$($done,)* kin::any_spatial(),]; $($rest)*) };
    ($f:path; [$($done:expr,)*]; coord $($rest:tt)*) => { $crate::made!($f; [$($done,)* kin::any_coord(),]; $($rest)*) };
    ($f:path; [$($done:expr,)*]; coords $($rest:tt)*) => {
        $crate::made!($f; [$($done,)* std::array::from_fn(|_| kin::any_coord()),]; $($rest)*)
    };
    ($f:path; [$($done:expr,)*]; planars $($rest:tt)*) => {
        $crate::made!($f; [$($done,)* std::array::from_fn(|_| kin::any_planar()),]; $($rest)*)
    };
    ($f:path; [$($done:expr,)*]; spatials $($rest:tt)*) => {
        $crate::made!($f; [$($done,)* std::array::from_fn(|_| kin::any_spatial()),]; $($rest)*)
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
