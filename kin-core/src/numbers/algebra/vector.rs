//! Implements the operations that all vectors share.

/// Adds terms from first to last.
macro_rules! sum {
    ($first:expr $(, $rest:expr)*) => { $first $(+ $rest)* };
}

/// Implements [`componentwise!`] and the operations of vectors alone: arrays and tuples, indices,
/// lengths and products. Its arguments are the components, their indices, and the tuple of
/// components over `T` and over `f64`.
macro_rules! vector {
    ($kind:ident, $n:literal { $($c:ident = $i:tt),* }, $tuple:ty, $constants:ty) => {
        componentwise!($kind { $($c),* });

        impl<T: Scalar> From<[T; $n]> for $kind<T> {
            #[inline]
            fn from([$($c),*]: [T; $n]) -> Self {
                $kind { $($c),* }
            }
        }

        impl<T: Scalar> From<$tuple> for $kind<T> {
            #[inline]
            fn from(($($c),*): $tuple) -> Self {
                $kind { $($c),* }
            }
        }

        impl<T: Scalar> From<$kind<T>> for [T; $n] {
            #[inline]
            fn from(a: $kind<T>) -> Self {
                a.to_array()
            }
        }

        impl<T: Scalar> Components<$n> for $kind<T> {
            type Scalar = T;

            #[inline]
            fn components(self) -> [T; $n] {
                self.to_array()
            }
        }

        impl<T: Scalar> Components<$n> for &$kind<T> {
            type Scalar = T;

            #[inline]
            fn components(self) -> [T; $n] {
                self.to_array()
            }
        }

        impl<T: Scalar> Components<$n> for $tuple {
            type Scalar = T;

            #[inline]
            fn components(self) -> [T; $n] {
                self.into()
            }
        }

        impl<T> Index<usize> for $kind<T> {
            type Output = T;

            /// Returns component `i`, counted from 0. Panics beyond the last.
            #[inline]
            fn index(&self, i: usize) -> &T {
                match i {
                    $($i => &self.$c,)*
                    _ => panic!(concat!("component {} of ", stringify!($kind), " with ", $n), i),
                }
            }
        }

        impl<T> IndexMut<usize> for $kind<T> {
            #[inline]
            fn index_mut(&mut self, i: usize) -> &mut T {
                match i {
                    $($i => &mut self.$c,)*
                    _ => panic!(concat!("component {} of ", stringify!($kind), " with ", $n), i),
                }
            }
        }

        impl<T> $kind<T> {
            /// Creates the vector from its components.
            #[inline]
            pub const fn new($($c: T),*) -> Self
            where
                T: Copy,
            {
                $kind { $($c),* }
            }

            /// Returns the components in order.
            #[inline]
            pub fn to_array(self) -> [T; $n] {
                [$(self.$c),*]
            }
        }

        impl<T: Scalar> $kind<T> {
            /// Returns the dot product a · b = Σ aₖ bₖ.
            #[inline]
            pub fn dot<V: Components<$n>>(self, other: V) -> Mixed<T, V::Scalar>
            where
                T: Mix<V::Scalar>,
            {
                let [$($c),*] = other.components();
                sum!($(self.$c * $c),*)
            }

            /// Returns the squared length |a|² = Σ aₖ².
            #[inline]
            pub fn norm_squared(self) -> T {
                sum!($(self.$c * self.$c),*)
            }

            /// Returns the length |a| = √(Σ aₖ²).
            ///
            /// At a = 0 the derivative of the length is NaN, or 0 if a is constant.
            #[inline]
            pub fn norm(self) -> T {
                T::length(self.to_array())
            }

            /// Returns the unit vector a/|a|, or NaN for a zero vector.
            #[inline]
            pub fn normalize(self) -> Self {
                self / self.norm()
            }

            /// Returns the vector of the products aₖ bₖ.
            #[inline]
            pub fn component_mul<V: Components<$n>>(self, other: V) -> $kind<Mixed<T, V::Scalar>>
            where
                T: Mix<V::Scalar>,
            {
                let [$($c),*] = other.components();
                $kind { $($c: self.$c * $c),* }
            }

            /// Returns the vector of the quotients aₖ/bₖ.
            #[inline]
            pub fn component_div<V: Components<$n>>(self, other: V) -> $kind<Mixed<T, V::Scalar>>
            where
                T: Mix<V::Scalar>,
            {
                let [$($c),*] = other.components();
                $kind { $($c: self.$c / $c),* }
            }

            /// Returns the linear interpolation (1 − t) a + t b.
            #[inline]
            pub fn lerp<V, S>(self, other: V, t: S) -> $kind<Mixed<Mixed<T, S>, Mixed<V::Scalar, S>>>
            where
                V: Components<$n>,
                S: Scalar,
                T: Mix<S>,
                V::Scalar: Mix<S>,
                Mixed<T, S>: Mix<Mixed<V::Scalar, S>>,
            {
                let [$($c),*] = other.components();
                let rest = S::from(1.0) - t;
                $kind { $($c: self.$c * rest + $c * t),* }
            }
        }
    };
}

pub(super) use {sum, vector};
