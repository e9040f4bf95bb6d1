//! The map from given values to wanted ones.

use std::sync::{Mutex, PoisonError};

use kin::solver::{Map as Native, Mapped, NamedValue};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::fault::or_raise;
use crate::follower::Follower;
use crate::numbers;

/// A map. Python's lock is given up while it moves.
#[pyclass(frozen, module = "kin._native")]
pub struct Map(Mutex<Native>);

/// The name, unit and value of a number.
type Value = (String, Option<String>, f64);

/// Given values, wanted values and J, row by row.
type There<'py> = (Vec<Value>, Vec<Value>, Bound<'py, PyBytes>);

fn values(all: &[NamedValue]) -> Vec<Value> {
    all.iter().map(|one| (one.name.clone(), one.unit.clone(), one.value)).collect()
}

fn there<'py>(py: Python<'py>, found: &Mapped) -> PyResult<There<'py>> {
    let rows: Vec<f64> = found.jacobian().transpose().iter().copied().collect();
    Ok((values(found.given()), values(found.wanted()), numbers::list(py, &rows)?))
}

impl Map {
    fn with<T>(&self, act: impl FnOnce(&mut Native) -> T) -> T {
        act(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

#[pymethods]
impl Map {
    /// The map on the branch of the follower.
    #[new]
    fn new(
        py: Python<'_>,
        follower: &Follower,
        given: Vec<String>,
        wanted: Vec<String>,
    ) -> PyResult<Self> {
        let found = py.detach(|| follower.with(|native| native.map(given, wanted)));
        Ok(Map(Mutex::new(or_raise(py, found)?)))
    }

    /// Moves the given values.
    fn to<'py>(&self, py: Python<'py>, values: Vec<(String, f64)>) -> PyResult<There<'py>> {
        let found = py.detach(|| self.with(|native| native.to(values)));
        there(py, &or_raise(py, found)?)
    }

    /// The map where it is.
    fn here<'py>(&self, py: Python<'py>) -> PyResult<There<'py>> {
        there(py, &or_raise(py, self.with(|native| native.here()))?)
    }

    /// J̇ for rates of the given values, row by row.
    fn jacobian_rate<'py>(
        &self,
        py: Python<'py>,
        rates: Vec<(String, f64)>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let found = or_raise(py, self.with(|native| native.jacobian_rate(rates)))?;
        numbers::list(py, &found.transpose().iter().copied().collect::<Vec<f64>>())
    }

    /// The map the other way round.
    fn inverse(&self, py: Python<'_>) -> PyResult<Self> {
        let found = or_raise(py, self.with(|native| native.inverse()))?;
        Ok(Map(Mutex::new(found)))
    }

    /// The map along the border of ranges of the given values.
    fn border<'py>(
        &self,
        py: Python<'py>,
        ranges: Vec<(String, [f64; 2])>,
        points: usize,
    ) -> PyResult<Vec<There<'py>>> {
        let found = py.detach(|| self.with(|native| native.border(ranges, points)));
        or_raise(py, found)?.iter().map(|one| there(py, one)).collect()
    }

    /// The follower that moves the given values.
    fn follower(&self) -> Follower {
        Follower::from(self.with(|native| native.follower().clone()))
    }
}
