//! Computes a value and its derivatives along one direction.
//!
//! A jet distinguishes a derivative that is zero for every input from a derivative that is zero at
//! one input. For example, √(x² + y²) has no slope at (0, 0), although x² + y² has the slope 0
//! there.

use std::ops::{Add, Div, Mul, Neg, Sub};

use kin_graph::{Function, Function2, Number, compared_by_value};

use super::Part;
use crate::numbers::real::{Dual, Dual2_64, Real};

/// g(s), g′(s) and g″(s). A derivative is `None` if g does not depend on s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Jet {
    pub value: f64,
    pub slopes: Option<[f64; 2]>,
    /// The growth that the number has recorded.
    growth: u8,
}

impl Jet {
    pub(super) fn still(value: f64) -> Jet {
        Jet { value, slopes: None, growth: 0 }
    }

    pub(crate) fn moving(value: f64, slopes: [f64; 2]) -> Jet {
        Jet { value, slopes: Some(slopes), growth: 0 }
    }

    /// Returns the first part up to `last` that is not finite.
    pub(super) fn fault(&self, last: Part) -> Option<Part> {
        let [first, second] = self.slopes.unwrap_or_default();
        let parts = [(Part::Value, self.value), (Part::Slope, first), (Part::Curvature, second)];
        parts
            .into_iter()
            .take_while(|(part, _)| *part <= last)
            .find(|(_, x)| !x.is_finite())
            .map(|(part, _)| part)
    }

    /// Returns f(self), where the array contains f and its first two derivatives at this value.
    pub(super) fn chain(self, [value, f1, f2]: [f64; 3]) -> Jet {
        Jet { value, slopes: self.slopes.map(|[x1, x2]| [f1 * x1, x1 * f2 * x1 + f1 * x2]), ..self }
    }

    /// Returns the result of a function for this number with the tangent 1.
    fn through(self, y: Real<Dual2_64>) -> Jet {
        let y = y.0;
        let slopes = if y.is_constant() { None } else { self.chain([y.re, y.v1, y.v2]).slopes };
        Jet { value: y.re, slopes, growth: y.marks() }
    }

    /// Returns f(self, other) with Σ f_k x_k′ and Σ f_kl x_k′ x_l′ + f_k x_k″. Only operands that
    /// depend on s have partial derivatives.
    fn with(self, other: Jet, f: impl Fn(Real<Dual2_64>, Real<Dual2_64>) -> Real<Dual2_64>) -> Jet {
        let at = |a: f64, b: f64| f(Real(self.along(a)), Real(other.along(b))).0;
        let tangent = |jet: &Jet| if jet.slopes.is_some() { 1.0 } else { 0.0 };
        let moved = at(tangent(&self), tangent(&other));
        let slopes = match (self.slopes, other.slopes) {
            (None, None) => None,
            _ if moved.is_constant() => None,
            (Some(_), None) => self.chain([moved.re, moved.v1, moved.v2]).slopes,
            (None, Some(_)) => other.chain([moved.re, moved.v1, moved.v2]).slopes,
            (Some([a1, a2]), Some([b1, b2])) => {
                let by_a = at(1.0, 0.0);
                let by_b = at(0.0, 1.0);
                let mixed = 0.5 * (moved.v2 - by_a.v2 - by_b.v2);
                let second = by_a.v2 * a1 * a1
                    + 2.0 * mixed * a1 * b1
                    + by_b.v2 * b1 * b1
                    + by_a.v1 * a2
                    + by_b.v1 * b2;
                Some([by_a.v1 * a1 + by_b.v1 * b1, second])
            }
        };
        Jet { value: moved.re, slopes, growth: moved.marks() }
    }

    /// Returns the value with a tangent; a tangent of 0 means a constant.
    fn along(self, tangent: f64) -> Dual2_64 {
        let x = if tangent == 0.0 {
            Dual2_64::from_re(self.value)
        } else {
            Dual2_64::new(self.value, tangent, 0.0)
        };
        x.with_growth_of(self.growth)
    }

    /// Converts to a dual number.
    #[cfg(test)]
    pub(super) fn dual(self) -> Dual2_64 {
        self.slopes.map_or(Dual2_64::from_re(self.value), |[first, second]| {
            Dual2_64::new(self.value, first, second)
        })
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
        self.through(Real(self.along(1.0)).call(f))
    }

    fn call2(self, f: Function2, other: Jet) -> Jet {
        // The result is the selected operand with its derivatives.
        let first = match f {
            Function2::Max => self.value >= other.value,
            Function2::Min => self.value <= other.value,
            _ => return self.with(other, |x, y| x.call2(f, y)),
        };
        if first || other.value.is_nan() { self } else { other }
    }

    fn powi(self, n: i32) -> Jet {
        self.through(Real(self.along(1.0)).powi(n))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: Jet = Jet { value: 0.0, slopes: Some([1.0, 0.0]), growth: 0 };

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
        let a = Jet::moving(0.7, [0.3, -0.2]);
        let b = Jet::moving(1.9, [-1.1, 0.4]);
        let x = Real(a.dual());
        let y = Real(b.dual());
        let functions = [Function2::Powf, Function2::Atan2, Function2::Hypot]
            .map(|f| (a.call2(f, b), x.call2(f, y)));
        for (f, (ours, dual)) in functions
            .into_iter()
            .chain([(a * b, x * y), (a / b, x / y), (a - b, x - y)])
            .enumerate()
        {
            let ours = ours.dual();
            let dual = dual.0;
            assert_eq!(ours.re, dual.re);
            assert!(
                (ours.v1 - dual.v1).abs() < 1e-14 && (ours.v2 - dual.v2).abs() < 1e-13,
                "{f}: {ours} is not {dual}"
            );
        }
    }

    #[test]
    fn second_derivative_alone_can_fail() {
        let power = X.call2(Function2::Powf, Jet::still(1.5));
        assert_eq!(
            (power.fault(Part::Slope), power.fault(Part::Curvature)),
            (None, Some(Part::Curvature))
        );
    }
}
