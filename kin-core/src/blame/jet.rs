//! Value and derivatives along one direction, where a derivative that vanishes by its structure is told from one that happens to be zero:
//! √(x² + y²) has no slope at (0, 0), though x² + y² has the slope 0 there.

use std::ops::{Add, Div, Mul, Neg, Sub};

use kin_graph::{Function, Function2, Number, compared_by_value};
use num_dual::Dual2_64;

use super::Part;
use crate::real::Real;

/// g(s), g′(s) and g″(s); `None` where g does not depend on s at all.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jet {
    pub value: f64,
    pub slopes: Option<[f64; 2]>,
}

impl Jet {
    pub(super) fn still(value: f64) -> Jet {
        Jet { value, slopes: None }
    }

    /// The first part up to `last` that is not finite.
    pub(super) fn fault(&self, last: Part) -> Option<Part> {
        let [first, second] = self.slopes.unwrap_or_default();
        let parts = [(Part::Value, self.value), (Part::Slope, first), (Part::Curvature, second)];
        parts.into_iter().take_while(|(part, _)| *part <= last).find(|(_, x)| !x.is_finite()).map(|(part, _)| part)
    }

    /// f(self), where f is its value and first two derivatives there.
    pub(super) fn chain(self, [value, f1, f2]: [f64; 3]) -> Jet {
        Jet { value, slopes: self.slopes.map(|[x1, x2]| [f1 * x1, f2 * x1 * x1 + f1 * x2]) }
    }

    /// f(self, other): Σ f_k x_k′ and Σ f_kl x_k′ x_l′ + f_k x_k″, partial derivatives by those that depend on s only.
    fn with(self, other: Jet, f: impl Fn(Real<Dual2_64>, Real<Dual2_64>) -> Real<Dual2_64>) -> Jet {
        let at = |a: f64, b: f64| f(Real(along(self.value, a)), Real(along(other.value, b))).0;
        let value = at(0.0, 0.0).re;
        let slopes = match (self.slopes, other.slopes) {
            (None, None) => None,
            (Some(_), None) => self.chain(parts(value, at(1.0, 0.0))).slopes,
            (None, Some(_)) => other.chain(parts(value, at(0.0, 1.0))).slopes,
            (Some([a1, a2]), Some([b1, b2])) => {
                let (by_a, by_b, by_both) = (at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0));
                let mixed = 0.5 * (by_both.v2 - by_a.v2 - by_b.v2);
                let second = by_a.v2 * a1 * a1 + 2.0 * mixed * a1 * b1 + by_b.v2 * b1 * b1 + by_a.v1 * a2 + by_b.v1 * b2;
                Some([by_a.v1 * a1 + by_b.v1 * b1, second])
            }
        };
        Jet { value, slopes }
    }

    /// Its numbers as num-dual has them.
    pub(super) fn dual(self) -> Dual2_64 {
        let [first, second] = self.slopes.unwrap_or_default();
        Dual2_64::new(self.value, first, second)
    }
}

impl Neg for Jet {
    type Output = Jet;

    fn neg(self) -> Jet {
        self.chain([-self.value, -1.0, 0.0])
    }
}

macro_rules! operator {
    ($($trait:ident $method:ident),*) => {$(
        impl $trait for Jet {
            type Output = Jet;

            fn $method(self, other: Jet) -> Jet {
                self.with(other, $trait::$method)
            }
        }
    )*};
}

operator!(Add add, Sub sub, Mul mul, Div div);

impl Number for Jet {
    compared_by_value!(|jet| jet.value);

    fn constant(x: f64) -> Self {
        Jet::still(x)
    }

    fn call(self, f: Function) -> Jet {
        let y = Real(along(self.value, 1.0)).call(f).0;
        self.chain([y.re, y.v1, y.v2])
    }

    fn call2(self, f: Function2, other: Jet) -> Jet {
        self.with(other, |x, y| x.call2(f, y))
    }

    fn powi(self, n: i32) -> Jet {
        let y = Real(along(self.value, 1.0)).powi(n).0;
        self.chain([y.re, y.v1, y.v2])
    }
}

fn along(x: f64, tangent: f64) -> Dual2_64 {
    Dual2_64::new(x, tangent, 0.0)
}

fn parts(value: f64, y: Dual2_64) -> [f64; 3] {
    [value, y.v1, y.v2]
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: Jet = Jet { value: 0.0, slopes: Some([1.0, 0.0]) };

    #[test]
    fn length_of_nothing_has_no_slope_though_its_square_has() {
        let square = X * X;
        assert_eq!((square.fault(Part::Curvature), square.slopes), (None, Some([0.0, 2.0])));
        assert_eq!(square.call(Function::Sqrt).fault(Part::Value), None);
        assert_eq!(square.call(Function::Sqrt).fault(Part::Slope), Some(Part::Slope));
        assert_eq!(Jet::still(0.0).call(Function::Sqrt).fault(Part::Curvature), None);
    }

    #[test]
    fn chain_of_two_is_that_of_second_order_dual_numbers() {
        let (a, b) = (Jet { value: 0.7, slopes: Some([0.3, -0.2]) }, Jet { value: 1.9, slopes: Some([-1.1, 0.4]) });
        let (x, y) = (Real(a.dual()), Real(b.dual()));
        let functions = [Function2::Powf, Function2::Atan2, Function2::Hypot].map(|f| (a.call2(f, b), x.call2(f, y)));
        for (f, (ours, dual)) in functions.into_iter().chain([(a * b, x * y), (a / b, x / y), (a - b, x - y)]).enumerate() {
            let (ours, dual) = (ours.dual(), dual.0);
            assert_eq!(ours.re, dual.re);
            assert!((ours.v1 - dual.v1).abs() < 1e-14 && (ours.v2 - dual.v2).abs() < 1e-13, "{f}: {ours} is not {dual}");
        }
    }

    #[test]
    fn second_derivative_alone_can_fail() {
        let power = X.call2(Function2::Powf, Jet::still(1.5));
        assert_eq!((power.fault(Part::Slope), power.fault(Part::Curvature)), (None, Some(Part::Curvature)));
    }
}
