//! A mechanism whose drivers are released: positions by wishes.

use std::sync::{Mutex, PoisonError};

use kin::solver::{Granted, Reached, Released as Native};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::fault::or_raise;
use crate::mechanism::Mechanism;
use crate::motion::Motion;
use crate::numbers;
use crate::system::System;

/// A wish, with bodies by name.
#[pyclass(frozen, module = "kin._native")]
pub struct Wish(kin::solver::Wish);

#[pymethods]
impl Wish {
    /// A point of a body at a target.
    #[staticmethod]
    fn point(body: &str, local: Vec<f64>, target: Vec<f64>, priority: u32) -> Self {
        Wish(kin::solver::Wish::point_of(body, &local, &target).priority(priority))
    }

    /// A value of a measure or coordinate.
    #[staticmethod]
    fn measure(name: &str, value: f64, priority: u32) -> Self {
        Wish(kin::solver::Wish::measure(name, value).priority(priority))
    }

    /// The present value of a measure or coordinate.
    #[staticmethod]
    fn hold(name: &str, priority: u32) -> Self {
        Wish(kin::solver::Wish::hold(name).priority(priority))
    }
}

/// How far a wish was met.
#[pyclass(frozen, get_all, module = "kin._native")]
pub struct WishResult {
    name: String,
    is_met: bool,
    missed: f64,
    unit: String,
}

impl From<Granted> for WishResult {
    fn from(granted: Granted) -> Self {
        let Granted { name, is_met, missed, unit, .. } = granted;
        WishResult { name, is_met, missed, unit }
    }
}

/// The end of a call.
#[pyclass(frozen, get_all, module = "kin._native")]
pub struct ReachedPosition {
    wishes: Vec<Py<WishResult>>,
    limits: Vec<String>,
    freedoms: Vec<String>,
}

/// A mechanism that is moved by wishes. Python's lock is given up while it moves.
#[pyclass(frozen, module = "kin._native")]
pub struct Released(Mutex<Native>);

impl Released {
    fn with<T>(&self, act: impl FnOnce(&mut Native) -> T) -> T {
        act(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

#[pymethods]
impl Released {
    /// The drivers of a system released at the position at time t.
    #[staticmethod]
    fn of_system(py: Python<'_>, system: &System, t: f64) -> PyResult<Self> {
        let system = system.now();
        let found = py.detach(|| system.released(t));
        Ok(Released(Mutex::new(or_raise(py, found)?)))
    }

    /// The drivers of a mechanism, which may have too few equations, released at time t.
    #[staticmethod]
    fn of_mechanism(py: Python<'_>, mechanism: &Mechanism, t: f64) -> PyResult<Self> {
        let mechanism = mechanism.0.clone();
        let found = py.detach(|| mechanism.released(t));
        Ok(Released(Mutex::new(or_raise(py, found)?)))
    }

    /// Moves the mechanism towards wishes.
    fn reach(&self, py: Python<'_>, wishes: Vec<PyRef<'_, Wish>>) -> PyResult<ReachedPosition> {
        let wishes: Vec<kin::solver::Wish> = wishes.iter().map(|wish| wish.0.clone()).collect();
        let found = py.detach(|| self.with(|native| native.reach(wishes)));
        let Reached { wishes, limits, freedoms, .. } = or_raise(py, found)?;
        let wishes: PyResult<Vec<Py<WishResult>>> =
            wishes.into_iter().map(|granted| Py::new(py, WishResult::from(granted))).collect();
        Ok(ReachedPosition { wishes: wishes?, limits, freedoms })
    }

    /// Takes the mechanism to the position near q.
    fn set_position(&self, py: Python<'_>, q: Vec<f64>) -> PyResult<()> {
        or_raise(py, self.with(|native| native.set_position(&q)))
    }

    /// Sets a parameter or dimension.
    fn set(&self, py: Python<'_>, name: &str, value: f64) -> PyResult<()> {
        or_raise(py, self.with(|native| native.set(name, value)))
    }

    /// A coordinate for each freedom.
    fn freedoms(&self) -> Vec<String> {
        self.with(Native::freedoms)
    }

    /// Names of the coordinates.
    fn names(&self) -> Vec<String> {
        self.with(|native| native.system().coordinate_names().to_vec())
    }

    /// q where it is.
    fn q<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        numbers::list(py, &self.with(|native| native.q().to_vec()))
    }

    /// The measures of joints with their values.
    fn measures(&self, py: Python<'_>) -> PyResult<Vec<(String, f64)>> {
        let all = or_raise(py, self.with(|native| native.measures()))?;
        Ok(all.into_iter().map(|one| (one.name, one.value)).collect())
    }

    /// The position as a motion of one time.
    fn motion(&self) -> Motion {
        Motion::from(self.with(|native| native.motion()))
    }
}
