//! The circuit of a mechanism: positions by arc length, past dead centres.

use kin::solver::{Circuit as Native, CircuitPoint};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::fault::or_raise;
use crate::motion::Motion;
use crate::numbers;

/// A circuit.
#[pyclass(frozen, module = "kin._native")]
pub struct Circuit(Native);

/// Arc length, value of the input, q, value of the quantity.
type Point<'py> = (f64, f64, Bound<'py, PyBytes>, f64);

impl From<Native> for Circuit {
    fn from(circuit: Native) -> Self {
        Circuit(circuit)
    }
}

fn points<'py>(py: Python<'py>, all: &[CircuitPoint]) -> PyResult<Vec<Point<'py>>> {
    all.iter()
        .map(|one| Ok((one.length, one.input, numbers::list(py, &one.q)?, one.value)))
        .collect()
}

#[pymethods]
impl Circuit {
    fn is_closed(&self) -> bool {
        self.0.is_closed()
    }

    fn length(&self) -> f64 {
        self.0.length()
    }

    fn motion(&self) -> Motion {
        Motion::from(self.0.motion().clone())
    }

    fn inputs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        numbers::list(py, self.0.inputs())
    }

    fn dead_centres<'py>(&self, py: Python<'py>) -> PyResult<Vec<Point<'py>>> {
        points(py, self.0.dead_centres())
    }

    fn crossings<'py>(&self, py: Python<'py>) -> PyResult<Vec<Point<'py>>> {
        points(py, self.0.crossings())
    }

    fn extremes<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Vec<Point<'py>>> {
        points(py, or_raise(py, self.0.extremes(name))?)
    }

    fn range(&self, py: Python<'_>, name: &str) -> PyResult<[f64; 2]> {
        or_raise(py, self.0.range(name))
    }
}
