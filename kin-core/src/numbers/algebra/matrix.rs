//! Implements the operations that all square matrices share.

/// Implements the index (row, column), counted from 0, and conversions of square matrices, from
/// rows of components.
macro_rules! matrix {
    ($kind:ident, $vector:ident, $n:literal { $(($($c:ident = $i:tt, $j:tt);*)),* }) => {
        componentwise!($kind { $($($c),*),* });

        impl<T> Index<(usize, usize)> for $kind<T> {
            type Output = T;

            /// Returns the entry in row `i` and column `j`, both counted from 0. Panics beyond the
            /// last.
            #[inline]
            fn index(&self, (i, j): (usize, usize)) -> &T {
                match (i, j) {
                    $($(($i, $j) => &self.$c,)*)*
                    _ => panic!(concat!("entry ({}, {}) of ", stringify!($kind)), i, j),
                }
            }
        }

        impl<T> IndexMut<(usize, usize)> for $kind<T> {
            #[inline]
            fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut T {
                match (i, j) {
                    $($(($i, $j) => &mut self.$c,)*)*
                    _ => panic!(concat!("entry ({}, {}) of ", stringify!($kind)), i, j),
                }
            }
        }

        impl<T: Scalar> From<[[T; $n]; $n]> for $kind<T> {
            /// Creates the matrix from its rows.
            #[inline]
            fn from([$([$($c),*]),*]: [[T; $n]; $n]) -> Self {
                $kind { $($($c),*),* }
            }
        }

        impl<T: Scalar> From<$kind<T>> for [[T; $n]; $n] {
            /// Returns the rows.
            #[inline]
            fn from(a: $kind<T>) -> Self {
                a.to_array()
            }
        }

        impl<T> $kind<T> {
            /// Creates the matrix from its entries, row by row.
            #[inline]
            #[allow(clippy::too_many_arguments)]
            pub const fn new($($($c: T),*),*) -> Self
            where
                T: Copy,
            {
                $kind { $($($c),*),* }
            }

            /// Returns the entries, row by row.
            #[inline]
            pub fn to_array(self) -> [[T; $n]; $n] {
                [$([$(self.$c),*]),*]
            }
        }

        impl $kind {
            /// Returns the unit matrix in `f64`, which mixes with `Real<D>`.
            #[inline]
            pub const fn identity() -> Self {
                $kind { $($($c: if $i == $j { 1.0 } else { 0.0 }),*),* }
            }

            /// Creates the matrix from its rows.
            #[inline]
            pub fn from_rows<V: Components<$n>>(rows: [V; $n]) -> $kind<V::Scalar> {
                $kind::from(rows.map(V::components))
            }

            /// Creates the matrix from its columns.
            #[inline]
            pub fn from_columns<V: Components<$n>>(columns: [V; $n]) -> $kind<V::Scalar> {
                Self::from_rows(columns).transpose()
            }
        }

        impl<T: Scalar> $kind<T> {
            /// Returns row `i`, counted from 0. Panics if `i` is beyond the last row.
            #[inline]
            pub fn row(self, i: usize) -> $vector<T> {
                $vector::from(self.to_array()[i])
            }

            /// Returns column `j`, counted from 0. Panics if `j` is beyond the last column.
            #[inline]
            pub fn column(self, j: usize) -> $vector<T> {
                $vector::from(self.to_array().map(|row| row[j]))
            }
        }
    };
}

pub(super) use matrix;
