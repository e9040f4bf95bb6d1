//! Implements the operations that all vectors and matrices share.

/// Implements `a ∘ b` for two kinds over the same number, and for one over `Real<D>` with one over
/// `f64`, in both orders.
macro_rules! mixed {
    ($op:ident::$f:ident, $l:ident, $r:ident => $out:ident, |$a:ident, $b:ident| $e:expr) => {
        by_ref!([T: Scalar] $op::$f, $l<T>, $r<T> => $out<T>, |$a, $b| $e);
        by_ref!([D: Dual] $op::$f, $l<Real<D>>, $r<f64> => $out<Real<D>>, |$a, $b| $e);
        by_ref!([D: Dual] $op::$f, $l<f64>, $r<Real<D>> => $out<Real<D>>, |$a, $b| $e);
    };
}

/// Implements arithmetic component by component: ±, negation, products with and quotients by a
/// number, sums, conversions of the components.
macro_rules! componentwise {
    ($kind:ident { $($c:ident),* }) => {
        mixed!(Add::add, $kind, $kind => $kind, |a, b| $kind { $($c: a.$c + b.$c),* });
        mixed!(Sub::sub, $kind, $kind => $kind, |a, b| $kind { $($c: a.$c - b.$c),* });

        by_ref!([T: Scalar] Mul::mul, $kind<T>, T => $kind<T>, |a, s| $kind { $($c: a.$c * s),* });
        by_ref!([D: Dual] Mul::mul, $kind<Real<D>>, f64 => $kind<Real<D>>, |a, s| $kind { $($c: a.$c * s),* });
        by_ref!([D: Dual] Mul::mul, $kind<f64>, Real<D> => $kind<Real<D>>, |a, s| $kind { $($c: a.$c * s),* });
        by_ref!([] Mul::mul, f64, $kind<f64> => $kind<f64>, |s, a| a * s);
        by_ref!([D: Dual] Mul::mul, Real<D>, $kind<Real<D>> => $kind<Real<D>>, |s, a| a * s);
        by_ref!([D: Dual] Mul::mul, Real<D>, $kind<f64> => $kind<Real<D>>, |s, a| a * s);
        by_ref!([D: Dual] Mul::mul, f64, $kind<Real<D>> => $kind<Real<D>>, |s, a| a * s);

        by_ref!([T: Scalar] Div::div, $kind<T>, T => $kind<T>, |a, s| $kind { $($c: a.$c / s),* });
        by_ref!([D: Dual] Div::div, $kind<Real<D>>, f64 => $kind<Real<D>>, |a, s| $kind { $($c: a.$c / s),* });
        by_ref!([D: Dual] Div::div, $kind<f64>, Real<D> => $kind<Real<D>>, |a, s| $kind { $($c: a.$c / s),* });

        assign!([T: Scalar] AddAssign::add_assign by Add::add, $kind<T>, $kind<T>);
        assign!([D: Dual] AddAssign::add_assign by Add::add, $kind<Real<D>>, $kind<f64>);
        assign!([T: Scalar] SubAssign::sub_assign by Sub::sub, $kind<T>, $kind<T>);
        assign!([D: Dual] SubAssign::sub_assign by Sub::sub, $kind<Real<D>>, $kind<f64>);
        assign!([T: Scalar] MulAssign::mul_assign by Mul::mul, $kind<T>, T);
        assign!([D: Dual] MulAssign::mul_assign by Mul::mul, $kind<Real<D>>, f64);
        assign!([T: Scalar] DivAssign::div_assign by Div::div, $kind<T>, T);
        assign!([D: Dual] DivAssign::div_assign by Div::div, $kind<Real<D>>, f64);

        impl<T: Scalar> Neg for $kind<T> {
            type Output = $kind<T>;

            #[inline]
            fn neg(self) -> $kind<T> {
                $kind { $($c: -self.$c),* }
            }
        }

        impl<T: Scalar> Neg for &$kind<T> {
            type Output = $kind<T>;

            #[inline]
            fn neg(self) -> $kind<T> {
                -*self
            }
        }

        impl<T: Scalar> Sum for $kind<T> {
            fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
                terms.fold(Self { $($c: T::default()),* }, Add::add)
            }
        }

        impl<T: Scalar> From<&$kind<T>> for $kind<T> {
            #[inline]
            fn from(a: &$kind<T>) -> Self {
                *a
            }
        }

        impl<D: Dual> From<$kind<f64>> for $kind<Real<D>> {
            /// Returns the components without derivatives.
            #[inline]
            fn from(a: $kind<f64>) -> Self {
                a.map(Real::from)
            }
        }

        impl<D: Dual> From<&$kind<f64>> for $kind<Real<D>> {
            /// Returns the components without derivatives.
            #[inline]
            fn from(a: &$kind<f64>) -> Self {
                a.map(Real::from)
            }
        }

        impl $kind {
            /// Returns the value with all components zero, in `f64`, which mixes with `Real<D>`.
            #[inline]
            pub const fn zeros() -> Self {
                $kind { $($c: 0.0),* }
            }
        }

        impl<T: Scalar> $kind<T> {
            /// Applies `f` to each component: `v.map(Scalar::value)` drops derivatives.
            #[inline]
            pub fn map<U>(self, f: impl Fn(T) -> U) -> $kind<U> {
                $kind { $($c: f(self.$c)),* }
            }
        }
    };
}

pub(super) use {componentwise, mixed};
