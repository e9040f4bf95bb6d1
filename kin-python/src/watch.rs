//! Looks at Python while a run goes on without its lock: an interrupt from the keyboard, and a call
//! that tells of progress.

use std::time::{Duration, Instant};

use pyo3::prelude::*;

/// The lock is taken no more often.
const EVERY: Duration = Duration::from_millis(50);
/// The clock is asked after so many times.
const STRIDE: usize = 16;

/// A look at Python now and then.
pub struct Watch {
    progress: Option<Py<PyAny>>,
    all: usize,
    last: Instant,
    seen: usize,
    /// The exception that ends the run.
    raised: Option<PyErr>,
}

impl Watch {
    pub fn new(progress: Option<Py<PyAny>>, all: usize) -> Watch {
        Watch { progress, all, last: Instant::now(), seen: 0, raised: None }
    }

    /// False if the run has to end.
    pub fn look(&mut self, done: usize) -> bool {
        if done < self.seen + STRIDE {
            return true;
        }
        self.seen = done;
        if self.last.elapsed() < EVERY {
            return true;
        }
        let asked = Python::attach(|py| {
            py.check_signals()?;
            self.tell(py, done)
        });
        self.last = Instant::now();
        self.raised = asked.err();
        self.raised.is_none()
    }

    fn tell(&self, py: Python<'_>, done: usize) -> PyResult<()> {
        self.progress
            .as_ref()
            .map_or(Ok(()), |progress| progress.call1(py, (done, self.all)).map(drop))
    }

    /// The exception that has ended the run; of one that has come to its end the last call.
    pub fn end(&mut self, complete: bool) -> PyResult<()> {
        match self.raised.take() {
            Some(raised) => Err(raised),
            None if complete => Python::attach(|py| self.tell(py, self.all)),
            None => Ok(()),
        }
    }
}
