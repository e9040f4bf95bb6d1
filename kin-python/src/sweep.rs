//! Many cases of one system: rows of numbers in, rows of results and statuses out.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::Duration;

use kin::extend::Lanes;
use kin::results::Series;
use kin::{Result, SolverOptions};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::fault::{or_raise, value};
use crate::numbers;
use crate::options::options;
use crate::system::System;

/// The number that is kept of a measure over a motion.
#[derive(Clone, Copy)]
enum Feature {
    Max,
    Min,
    Range,
    First,
    Last,
    MaxRate,
    MaxSecondRate,
}

fn feature(name: &str) -> PyResult<Feature> {
    Ok(match name {
        "max" => Feature::Max,
        "min" => Feature::Min,
        "range" => Feature::Range,
        "first" => Feature::First,
        "last" => Feature::Last,
        "max_rate" => Feature::MaxRate,
        "max_second_rate" => Feature::MaxSecondRate,
        _ => {
            let known = "max, min, range, first, last, max_rate, max_second_rate";
            return Err(value(format!(
                "`{name}` is nothing that a sweep keeps of a measure. Use one of {known}"
            )));
        }
    })
}

impl Feature {
    fn of(self, x: &kin::results::Quantity) -> f64 {
        let largest = |all: &Series| all.values().iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        match self {
            Feature::MaxRate => largest(&x.rate),
            Feature::MaxSecondRate => largest(&x.second_rate),
            _ => self.of_values(&x.value),
        }
    }

    /// Of values alone; those of forces have no rates.
    fn of_values(self, x: &Series) -> f64 {
        let end = |v: Option<&f64>| v.copied().unwrap_or(f64::NAN);
        match self {
            Feature::Max => x.max(),
            Feature::Min => x.min(),
            Feature::Range => x.max() - x.min(),
            Feature::First => end(x.values().first()),
            Feature::Last => end(x.values().last()),
            Feature::MaxRate | Feature::MaxSecondRate => f64::NAN,
        }
    }

    fn is_of_rates(self) -> bool {
        matches!(self, Feature::MaxRate | Feature::MaxSecondRate)
    }
}

/// Results row by row, and the status of each case: empty where it has succeeded.
type Rows<'py> = (Bound<'py, PyBytes>, Vec<String>);

/// Python is looked at so often while the cases are computed.
const EVERY: Duration = Duration::from_millis(50);

/// Runs all cases: `cases` row by row, a number for each of `names`; of each motion the numbers
/// `wanted`.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "the arguments of the Python function around it")]
#[pyo3(signature = (system, names, cases, times, wanted, keywords, lanes, threads = None, progress = None))]
pub fn sweep<'py>(
    py: Python<'py>,
    system: &System,
    names: Vec<String>,
    cases: &[u8],
    times: &[u8],
    wanted: Vec<(String, String)>,
    keywords: &Bound<'py, PyDict>,
    lanes: bool,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Rows<'py>> {
    let system = system.now();
    let wanted = wanted
        .into_iter()
        .map(|(name, what)| Ok((name, feature(&what)?)))
        .collect::<PyResult<Vec<_>>>()?;
    let times = numbers::read(times)?;
    let kept: Vec<&str> = wanted.iter().map(|(name, _)| name.as_str()).collect();
    or_raise(py, times.first().map_or(Ok(()), |t| system.check_columns(&kept, *t)))?;
    let asked = Asked {
        wanted: of_forces(&system, wanted)?,
        system,
        cases: rows(numbers::read(cases)?, names.len())?,
        names,
        times,
        options: options(Some(keywords))?,
        lanes,
        threads,
    };
    let all = asked.cases.len();
    let found = py.detach(|| asked.watched(|done| tell(progress.as_ref(), done, all)))?;
    let (numbers, states): (Vec<Vec<f64>>, Vec<String>) = or_raise(py, found)?.into_iter().unzip();
    tell(progress.as_ref(), all, all)?;
    Ok((numbers::list(py, &numbers.concat())?, states))
}

/// Each name with what is kept of it, and true where it is one of forces: neither a coordinate nor
/// a measure. Errors: a rate of those.
fn of_forces(
    system: &kin::System,
    wanted: Vec<(String, Feature)>,
) -> PyResult<Vec<(String, Feature, bool)>> {
    let measures = system.measures();
    let told = |(name, kept): (String, Feature)| {
        let of_motion = system.coordinate_names().contains(&name) || measures.contains(&name);
        let is_force = system.has_forces() && !of_motion;
        if is_force && kept.is_of_rates() {
            return Err(value(format!(
                "`{name}` is no measure or coordinate, and only these have rates"
            )));
        }
        Ok((name, kept, is_force))
    };
    wanted.into_iter().map(told).collect()
}

/// The cases, one after the other.
fn rows(cases: Vec<f64>, width: usize) -> PyResult<Vec<Vec<f64>>> {
    match width {
        0 => Err(value("a sweep needs the name of at least one parameter")),
        _ if !cases.len().is_multiple_of(width) => {
            Err(value(format!("a case has {width} numbers, one for each name")))
        }
        _ => Ok(cases.chunks_exact(width).map(<[f64]>::to_vec).collect()),
    }
}

/// Looks at signals, and tells of progress. Errors: the exception that is to end the sweep.
fn tell(progress: Option<&Py<PyAny>>, done: usize, all: usize) -> PyResult<()> {
    Python::attach(|py| {
        py.check_signals()?;
        progress.map_or(Ok(()), |progress| progress.call1(py, (done, all)).map(drop))
    })
}

/// A sweep that was asked for.
struct Asked {
    system: Arc<kin::System>,
    names: Vec<String>,
    cases: Vec<Vec<f64>>,
    times: Vec<f64>,
    wanted: Vec<(String, Feature, bool)>,
    options: SolverOptions,
    lanes: bool,
    threads: Option<usize>,
}

/// The results of a case, and its status.
type Row = (Vec<f64>, String);

impl Asked {
    /// Runs all cases on other threads, while this one goes on calling `look`: it may be the one
    /// that Python tells of signals.
    fn watched(&self, look: impl Fn(usize) -> PyResult<()>) -> PyResult<Result<Vec<Row>>> {
        let stop = AtomicBool::new(false);
        let done = AtomicUsize::new(0);
        let (sender, finished) = mpsc::channel();
        std::thread::scope(|scope| {
            let stop = &stop;
            let done = &done;
            let worker = scope.spawn(move || {
                let found = self.run(stop, done);
                // Whoever waits may have gone.
                let _ = sender.send(());
                found
            });
            let mut seen = Ok(());
            while matches!(finished.recv_timeout(EVERY), Err(RecvTimeoutError::Timeout)) {
                if seen.is_ok() {
                    seen = look(done.load(Ordering::Relaxed));
                    stop.store(seen.is_err(), Ordering::Relaxed);
                }
            }
            let found = worker
                .join()
                .map_err(|_| PyRuntimeError::new_err("a thread of the sweep has failed"));
            seen.and(found)
        })
    }

    fn run(&self, stop: &AtomicBool, done: &AtomicUsize) -> Result<Vec<Row>> {
        let mut sweep =
            self.system.sweep(&self.names)?.options(self.options.clone()).stop_when(stop);
        sweep = sweep.progress(|cases, _| done.store(cases, Ordering::Relaxed));
        if !self.lanes {
            sweep = sweep.lanes(Lanes::Off);
        }
        if let Some(threads) = self.threads {
            sweep = sweep.threads(threads);
        }
        sweep.run(&self.cases, &self.times, |case, motion| {
            match motion.and_then(|motion| self.results(case, &motion)) {
                Ok(results) => (results, String::new()),
                Err(error) => (vec![f64::NAN; self.wanted.len()], error.reason()),
            }
        })
    }

    /// The numbers that are wanted of the motion of a case.
    fn results(&self, case: usize, motion: &kin::Motion) -> Result<Vec<f64>> {
        let is_coordinate = |name: &String| motion.names().contains(name);
        if self.wanted.iter().all(|(name, ..)| is_coordinate(name)) {
            return self
                .wanted
                .iter()
                .map(|(name, kept, _)| Ok(kept.of(&motion.named(name)?)))
                .collect();
        }
        // Measures of joints and forces read parameters: those of the case.
        let mut system = kin::System::clone(&self.system);
        for (name, value) in self.names.iter().zip(&self.cases[case]) {
            if !is_coordinate(name) {
                system.set(name, *value)?;
            }
        }
        let has_forces = self.wanted.iter().any(|(.., is_force)| *is_force);
        let forces = has_forces.then(|| system.forces(motion)).transpose()?;
        let number = |(name, kept, is_force): &(String, Feature, bool)| match &forces {
            Some(forces) if *is_force => Ok(kept.of_values(&forces.named(name)?)),
            _ => Ok(kept.of(&system.measure(motion, name)?)),
        };
        self.wanted.iter().map(number).collect()
    }
}
