//! Makes the states of a constraint's arguments from its columns, one after the other.

use crate::model::state::{PlanarState, SpatialState};
use crate::numbers::algebra::Scalar;

/// The columns that no argument has taken yet. A missing column at the end is NaN.
pub struct Columns<'a, T>(pub &'a [T]);

impl<T: Scalar> Columns<'_, T> {
    /// Takes a bare coordinate.
    pub fn coord(&mut self) -> T {
        let first = self.0.split_off_first();
        first.copied().unwrap_or_else(|| T::from(f64::NAN))
    }

    /// Takes several bare coordinates.
    pub fn coords<const N: usize>(&mut self) -> [T; N] {
        std::array::from_fn(|_| self.coord())
    }

    /// Takes the state of a planar body.
    pub fn planar(&mut self) -> PlanarState<T> {
        PlanarState::new(self.coords())
    }

    /// Takes the states of several planar bodies.
    pub fn planars<const N: usize>(&mut self) -> [PlanarState<T>; N] {
        std::array::from_fn(|_| self.planar())
    }

    /// Takes the states of several spatial bodies.
    pub fn spatials<const N: usize>(&mut self) -> [SpatialState<T>; N] {
        std::array::from_fn(|_| self.spatial())
    }

    /// Takes the state of a spatial body.
    pub fn spatial(&mut self) -> SpatialState<T> {
        SpatialState::new(self.coords())
    }
}
