//! The language of constraints: small constraints in unusual but honest Rust, each on the route
//! that is promised for it, with derivatives that agree on both routes and with central differences
//! of the function as it is written.

#[path = "../data/as_text.rs"]
mod as_text;
mod bounded;
mod branches;
mod control;
mod corpus;
mod differences;
mod effects;
mod generics;
mod items;
mod own;
mod promises;
mod refused;
mod tables;
mod text;
mod twice;
mod values;

/// A constraint takes the route, all routes to its derivatives agree, and C at a state is the
/// number worked out by hand.
#[macro_export]
macro_rules! reads {
    ($name:ident, $route:ident, $constraint:expr, at $q:expr, $t:expr => $c:expr) => {
        #[test]
        fn $name() {
            let constraint = $constraint;
            assert_eq!(kin::Constraint::facts(&constraint).route(), kin::extend::Route::$route);
            let c = kin::extend::terms(&constraint, &$q, &[], $t).c;
            let expected: &[f64] = &$c;
            assert_eq!(c.len(), expected.len());
            for (got, expected) in c.iter().zip(expected) {
                assert!(
                    (got - expected).abs() < 1e-14 * (1.0 + expected.abs()),
                    "C is {c}, expected {expected}"
                );
            }
            $crate::text::agrees(concat!(module_path!(), "::", stringify!($name)), &constraint);
            kin::check::derivatives(constraint);
        }
    };
}
