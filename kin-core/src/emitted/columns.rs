//! The states of a constraint's arguments made of its columns, one after the other.

use crate::model::state::{PlanarState, SpatialState};
use crate::numbers::algebra::Scalar;

/// Columns that no argument has had yet; what is missing at the end is not a number.
pub struct Columns<'a, T>(pub &'a [T]);

impl<T: Scalar> Columns<'_, T> {
    /// A bare coordinate.
    pub fn coord(&mut self) -> T {
        let first = self.0.split_off_first();
        first.copied().unwrap_or_else(|| T::from(f64::NAN))
    }

    /// Several of them.
    pub fn coords<const N: usize>(&mut self) -> [T; N] {
        std::array::from_fn(|_| self.coord())
    }

    /// A planar body.
    pub fn planar(&mut self) -> PlanarState<T> {
        PlanarState::new(self.coords())
    }

    /// Several planar bodies.
    pub fn planars<const N: usize>(&mut self) -> [PlanarState<T>; N] {
        std::array::from_fn(|_| self.planar())
    }

    /// Several spatial bodies.
    pub fn spatials<const N: usize>(&mut self) -> [SpatialState<T>; N] {
        std::array::from_fn(|_| self.spatial())
    }

    /// A spatial body.
    pub fn spatial(&mut self) -> SpatialState<T> {
        SpatialState::new(self.coords())
    }
}
