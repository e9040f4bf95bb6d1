//! A follower: positions by values of drivers.

use std::sync::{Mutex, PoisonError};

use kin::solver::Follower as Native;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::circuit::Circuit;
use crate::fault::or_raise;
use crate::motion::Motion;
use crate::numbers;
use crate::options::options;
use crate::system::{Proved, System, proved};

/// A follower. Python's lock is given up while it moves.
#[pyclass(frozen, module = "kin._native")]
pub struct Follower(Mutex<Native>);

/// The name, unit and value of a driver.
type Value = (String, Option<String>, f64);

impl From<Native> for Follower {
    fn from(native: Native) -> Self {
        Follower(Mutex::new(native))
    }
}

impl Follower {
    pub(crate) fn with<T>(&self, act: impl FnOnce(&mut Native) -> T) -> T {
        act(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

#[pymethods]
impl Follower {
    /// A follower on the branch of the position at time t.
    #[new]
    #[pyo3(signature = (system, t, keywords = None))]
    fn new(
        py: Python<'_>,
        system: &System,
        t: f64,
        keywords: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let system = system.now();
        let options = options(keywords)?;
        let found = py.detach(|| system.solver().options(options).follower(t));
        Ok(Follower(Mutex::new(or_raise(py, found)?)))
    }

    /// A follower at the same configuration that is moved by other values.
    fn given(&self, py: Python<'_>, names: Vec<String>) -> PyResult<Self> {
        let found = py.detach(|| self.with(|native| native.given(names)));
        or_raise(py, found).map(Follower::from)
    }

    /// The values of the drivers that are left out.
    fn left_out(&self) -> Vec<Value> {
        let all = self.with(|native| native.here().left_out());
        all.into_iter().map(|driver| (driver.name, driver.unit, driver.value)).collect()
    }

    /// The efforts of the values for rates of them.
    fn efforts(&self, py: Python<'_>, rates: Vec<(String, [f64; 2])>) -> PyResult<Vec<Value>> {
        let all = or_raise(py, self.with(|native| native.efforts(rates)))?;
        Ok(all.into_iter().map(|one| (one.name, one.unit, one.value)).collect())
    }

    /// Moves drivers to these values, and returns q there.
    fn to<'py>(
        &self,
        py: Python<'py>,
        values: Vec<(String, f64)>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let moved =
            py.detach(|| self.with(|native| native.to(values).map(|here| here.q().to_vec())));
        numbers::list(py, &or_raise(py, moved)?)
    }

    /// Moves drivers along a polyline: row by row of values. Returns the rows of q, one after the
    /// other, and the named measures in the same way.
    fn to_by<'py>(
        &self,
        py: Python<'py>,
        names: Vec<String>,
        values: &[u8],
        measures: Vec<String>,
    ) -> PyResult<(Bound<'py, PyBytes>, Bound<'py, PyBytes>)> {
        let values = numbers::read(values)?;
        let path: Vec<Vec<(String, f64)>> = values
            .chunks_exact(names.len().max(1))
            .map(|row| names.iter().cloned().zip(row.iter().copied()).collect())
            .collect();
        let mut all = Vec::new();
        let mut measured = Vec::new();
        let moved = py.detach(|| {
            self.with(|native| {
                native.to_by(path, |here| {
                    all.extend_from_slice(here.q());
                    for name in &measures {
                        measured.push(here.measure(name)?);
                    }
                    Ok(())
                })
            })
        });
        or_raise(py, moved)?;
        Ok((numbers::list(py, &all)?, numbers::list(py, &measured)?))
    }

    /// Moves drivers to these values over so many steps, with a proof of each.
    fn prove_to(
        &self,
        py: Python<'_>,
        values: Vec<(String, f64)>,
        steps: usize,
    ) -> PyResult<Proved> {
        let proof = py.detach(|| self.with(|native| native.prove_to(values, steps)));
        Ok(proved(&or_raise(py, proof)?, steps + 1))
    }

    /// q where it is.
    fn q<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        numbers::list(py, &self.with(|native| native.here().q().to_vec()))
    }

    /// The drivers with their values.
    fn drivers(&self) -> Vec<Value> {
        let all = self.with(|native| native.drivers());
        all.into_iter().map(|driver| (driver.name, driver.unit, driver.value)).collect()
    }

    /// The measures of joints with their values.
    fn measures(&self, py: Python<'_>) -> PyResult<Vec<(String, f64)>> {
        let all = or_raise(py, self.with(|native| native.here().measures()))?;
        Ok(all.into_iter().map(|one| (one.name, one.value)).collect())
    }

    /// The configuration as a motion of one time.
    fn motion(&self) -> Motion {
        Motion::from(self.with(|native| native.here().motion()))
    }

    /// The circuit through the configuration where it is.
    fn circuit(&self, py: Python<'_>, input: &str, points: usize) -> PyResult<Circuit> {
        let found = py.detach(|| self.with(|native| native.circuit(input, points)));
        or_raise(py, found).map(Circuit::from)
    }

    /// Constraints in which time stands still.
    fn frozen(&self) -> Vec<String> {
        self.with(|native| native.frozen().to_vec())
    }

    /// q̇ and q̈ for rates of drivers.
    fn rates<'py>(
        &self,
        py: Python<'py>,
        rates: Vec<(String, [f64; 2])>,
    ) -> PyResult<(Bound<'py, PyBytes>, Bound<'py, PyBytes>)> {
        let found = or_raise(py, self.with(|native| native.rates(rates)))?;
        Ok((numbers::list(py, &found.qd)?, numbers::list(py, &found.qdd)?))
    }
}
