//! Measures of a motion: by a name, or by a function of Python.

use std::sync::{Mutex, PoisonError};

use kin::Error;
use kin::results::{Measure, Quantity, QuantityValues};
use pyo3::prelude::*;

use crate::fault::or_raise;
use crate::motion::Motion;

/// A name, or a function of a motion that gives name, unit, x, ẋ, ẍ and x⃛.
#[derive(FromPyObject)]
pub enum What {
    Name(String),
    Function(Py<PyAny>),
}

/// A measure, and the exception that its function has raised.
pub struct Measured {
    what: What,
    failed: Mutex<Option<PyErr>>,
}

impl What {
    /// Asks for something of this measure without Python's lock. Errors: Kin's, and the function's
    /// own.
    pub fn ask<T: Send>(
        self,
        py: Python<'_>,
        ask: impl FnOnce(&Measured) -> kin::Result<T> + Send,
    ) -> PyResult<T> {
        let measured = Measured { what: self, failed: Mutex::default() };
        let found = py.detach(|| ask(&measured));
        match measured.failed.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some(exception) => Err(exception),
            None => or_raise(py, found),
        }
    }
}

impl Measure for &Measured {
    fn of(&self, system: &kin::System, motion: &kin::Motion) -> kin::Result<Quantity> {
        match &self.what {
            What::Name(name) => name.as_str().of(system, motion),
            What::Function(function) => Python::attach(|py| self.called(py, function, motion)),
        }
    }

    fn name(&self) -> Option<&str> {
        match &self.what {
            What::Name(name) => Some(name),
            What::Function(_) => None,
        }
    }
}

impl Measured {
    fn called(
        &self,
        py: Python<'_>,
        function: &Py<PyAny>,
        motion: &kin::Motion,
    ) -> kin::Result<Quantity> {
        let given = Motion::from(motion.clone());
        let made = function
            .call1(py, (given,))
            .and_then(|made| made.extract::<(String, String, [Vec<f64>; 4])>(py));
        match made {
            Ok((name, unit, [value, rate, second_rate, third_rate])) => motion.quantity(
                &name,
                &unit,
                QuantityValues { value, rate, second_rate, third_rate },
            ),
            Err(exception) => {
                *self.failed.lock().unwrap_or_else(PoisonError::into_inner) = Some(exception);
                Err(Error::Stopped { done: 0, all: 0, motion: None })
            }
        }
    }
}
