//! Converts the value of an equation to its rows.

use crate::numbers::algebra::{Scalar, Vec2, Vec3};

/// A value whose numbers are rows.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be the value of an equation",
    label = "not rows"
)]
pub trait Rows<T> {
    /// Passes each row to `row`.
    fn each(self, row: &mut dyn FnMut(T));
}

impl<T: Scalar> Rows<T> for T {
    fn each(self, row: &mut dyn FnMut(T)) {
        row(self);
    }
}

impl<T: Scalar> Rows<T> for Vec2<T> {
    fn each(self, row: &mut dyn FnMut(T)) {
        self.to_array().into_iter().for_each(row);
    }
}

impl<T: Scalar> Rows<T> for Vec3<T> {
    fn each(self, row: &mut dyn FnMut(T)) {
        self.to_array().into_iter().for_each(row);
    }
}

impl<T, R: Rows<T>, const N: usize> Rows<T> for [R; N] {
    fn each(self, row: &mut dyn FnMut(T)) {
        self.into_iter().for_each(|part| part.each(row));
    }
}

macro_rules! tuples {
    ($(($($t:ident $k:tt),*))*) => {$(
        impl<T, $($t: Rows<T>),*> Rows<T> for ($($t,)*) {
            fn each(self, row: &mut dyn FnMut(T)) {
                $(self.$k.each(row);)*
            }
        }
    )*};
}

tuples!((A 0) (A 0, B 1) (A 0, B 1, C 2) (A 0, B 1, C 2, D 3) (A 0, B 1, C 2, D 3, E 4) (A 0, B 1, C 2, D 3, E 4, F 5)
    (A 0, B 1, C 2, D 3, E 4, F 5, G 6) (A 0, B 1, C 2, D 3, E 4, F 5, G 6, H 7));

/// Returns the rows of a value. The macro has counted the M rows from the type.
pub fn rows<T: Scalar, R: Rows<T>, const M: usize>(value: R) -> [T; M] {
    let mut all = [T::from(0.0); M];
    let mut places = all.iter_mut();
    value.each(&mut |row| {
        if let Some(place) = places.next() {
            *place = row;
        }
    });
    all
}
