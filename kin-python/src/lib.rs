//! The native part of the Python package `kin`: thin classes over Kin's public API. Users meet the
//! Python around it in `python/kin`, with its words and types.
//!
//! Numbers pass as bytes, descriptions as the JSON of Kin's files, bodies by their names; all that
//! takes long gives up Python's lock.

mod circuit;
mod design;
mod equation;
mod fault;
mod follower;
mod forces;
mod given;
mod held;
mod law;
mod map;
mod measured;
mod mechanism;
mod motion;
mod numbers;
mod options;
mod page;
mod released;
mod sweep;
mod system;
mod watch;

#[pyo3::pymodule]
mod _native {
    use pyo3::prelude::*;

    /// Messages name what Python calls them.
    #[pymodule_init]
    fn init(_module: &Bound<'_, PyModule>) -> PyResult<()> {
        kin::error::Surface::Python.choose();
        Ok(())
    }

    #[pymodule_export]
    use crate::circuit::Circuit;
    #[pymodule_export]
    use crate::design::{Derivatives, gradient, samples, toggle_by, tolerance};
    #[pymodule_export]
    use crate::equation::Equation;
    #[pymodule_export]
    use crate::fault::unknown;
    #[pymodule_export]
    use crate::follower::Follower;
    #[pymodule_export]
    use crate::forces::{Forces, solid_joined, solid_of, solid_turned};
    #[pymodule_export]
    use crate::law::{Law, axis, euler_facing, euler_turned};
    #[pymodule_export]
    use crate::map::Map;
    #[pymodule_export]
    use crate::mechanism::Mechanism;
    #[pymodule_export]
    use crate::motion::Motion;
    #[pymodule_export]
    use crate::page::page;
    #[pymodule_export]
    use crate::released::{ReachedPosition, Released, Wish, WishResult};
    #[pymodule_export]
    use crate::sweep::sweep;
    #[pymodule_export]
    use crate::system::System;
}
