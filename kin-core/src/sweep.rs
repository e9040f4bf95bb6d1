//! Many cases of one system: other parameters and initial values in each, spread over the cores of the machine.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use crate::error::{Error, Result};
use crate::motion::Motion;
use crate::newton::{self, Options};
use crate::system::System;
use crate::system::parameters::CasePlace;

/// Cases that are handed to a thread at once.
const BATCH: usize = 8;

/// Many cases of one [`System`]: one row of numbers a case, one number for each name.
///
/// ```
/// use kin::prelude::*;
///
/// # fn main() -> kin::Result<()> {
/// let mut m = Mechanism::new("pendulum on a crank");
/// let crank = m.link("crank", 1.0)?;
/// let rod = m.link("rod", 2.0)?;
/// m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start()))?;
/// m.add("A", revolute(crank, rod, crank.end(), rod.start()))?;
/// m.add("motor", drive_angle(crank, Law::ramp(1.0)))?;
/// m.add("swing", drive_angle(rod, Law::sine(0.5, 3.0, 0.0)))?;
/// let (system, times) = (m.build()?, linspace(0.0, 6.0, 61));
///
/// // The crank's length is 2 u: half of it on either side of its middle.
/// let cases: Vec<[f64; 2]> = (1..=20).map(|k| 0.1 * k as f64).map(|u| [-u, u]).collect();
/// let fastest = system.sweep(["O.u_j.x", "A.u_i.x"])?.run(&cases, &times, |_, motion| {
///     motion.map(|motion| motion.point(rod, vec2(1.0, 0.0)).speed().max())
/// })?;
/// assert!(fastest.iter().all(|speed| speed.as_ref().is_ok_and(|speed| *speed > 1.0)));
/// # Ok(())
/// # }
/// ```
///
/// Results come in the order of the cases and do not depend on the number of threads. Of a motion only what the closure gives back is kept,
/// so memory grows with the results alone.
pub struct Sweep<'a> {
    system: &'a System,
    names: Vec<String>,
    places: Vec<CasePlace>,
    options: Options,
    threads: Option<usize>,
    progress: Mutex<Option<Progress<'a>>>,
    stop: Option<&'a AtomicBool>,
}

/// Told how many cases are done, of how many.
type Progress<'a> = Box<dyn FnMut(usize, usize) + Send + 'a>;

impl<'a> Sweep<'a> {
    pub(crate) fn new(system: &'a System, names: impl IntoIterator<Item = impl AsRef<str>>) -> Result<Self> {
        let names: Vec<String> = names.into_iter().map(|name| name.as_ref().to_string()).collect();
        let places = system.places(&names)?;
        Ok(Sweep { system, names, places, options: Options::default(), threads: None, progress: Mutex::new(None), stop: None })
    }

    /// Other options than [`Options::default`].
    #[must_use]
    pub fn options(mut self, options: Options) -> Self {
        self.options = options;
        self
    }

    /// On so many threads of its own. Without it the threads are rayon's: one a core, or those of the pool that the sweep is run in.
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = Some(threads.max(1));
        self
    }

    /// Calls this with the number of cases done and of all cases, at the start with 0 and then every few cases, by one thread at a time and
    /// never with less than before.
    #[must_use]
    pub fn progress(mut self, progress: impl FnMut(usize, usize) + Send + 'a) -> Self {
        self.progress = Mutex::new(Some(Box::new(progress)));
        self
    }

    /// Gives up with [`Error::Stopped`] soon after this has become true.
    #[must_use]
    pub fn stop_when(mut self, stop: &'a AtomicBool) -> Self {
        self.stop = Some(stop);
        self
    }

    /// Runs every case over the times and gives what `keep` makes of each, in the order of the cases.
    ///
    /// `keep` is called with the number of the case and its motion, or with the error that ended it ([`Error::motion`] holds what was
    /// computed before), by several threads at once.
    ///
    /// Errors of the sweep as a whole, before anything is computed: a case of the wrong length, a number that is not finite, times that do
    /// not only increase or only decrease, options out of range; and [`Error::Stopped`].
    pub fn run<R: Send>(
        &self,
        cases: &[impl AsRef<[f64]> + Sync],
        times: impl AsRef<[f64]>,
        keep: impl Fn(usize, Result<Motion>) -> R + Sync,
    ) -> Result<Vec<R>> {
        let times = times.as_ref();
        self.options.check()?;
        newton::sweep::check(times)?;
        self.check(cases)?;
        let done = Mutex::new(0);
        self.report(&done, 0, cases.len());
        let batch = |system: &mut System, (number, batch): (usize, &[_])| -> Result<Vec<R>> {
            if self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed)) {
                return Err(Error::Stopped { done: *lock(&done), cases: cases.len() });
            }
            let kept = self.batch(system, number * BATCH, batch, times, &keep);
            self.report(&done, batch.len(), cases.len());
            Ok(kept)
        };
        let all = || cases.par_chunks(BATCH).enumerate().map_init(|| self.system.clone(), batch).collect::<Result<Vec<Vec<R>>>>();
        let kept = match self.threads {
            None => all(),
            Some(threads) => pool(threads)?.install(all),
        };
        Ok(kept?.into_iter().flatten().collect())
    }

    /// Each case of a batch, one after the other.
    fn batch<R>(
        &self,
        system: &mut System,
        first: usize,
        batch: &[impl AsRef<[f64]>],
        times: &[f64],
        keep: &impl Fn(usize, Result<Motion>) -> R,
    ) -> Vec<R> {
        let run = |(k, case): (usize, _)| {
            self.set(system, case);
            keep(first + k, system.run_with(times, &self.options))
        };
        batch.iter().map(AsRef::as_ref).enumerate().map(run).collect()
    }

    /// Gives the system the numbers of a case.
    fn set(&self, system: &mut System, case: &[f64]) {
        for (place, value) in self.places.iter().zip(case) {
            system.put(*place, *value);
        }
    }

    /// Each case must have one finite number for each name.
    fn check(&self, cases: &[impl AsRef<[f64]>]) -> Result<()> {
        for (case, values) in cases.iter().map(AsRef::as_ref).enumerate() {
            if values.len() != self.names.len() {
                return Err(Error::WrongLength { what: format!("case {case}"), expected: self.names.len(), found: values.len() });
            }
            if let Some((name, value)) = self.names.iter().zip(values).find(|(_, value)| !value.is_finite()) {
                return Err(Error::CaseNotFinite { case, name: name.clone(), value: *value });
            }
        }
        Ok(())
    }

    /// Counts more cases as done and tells; the count is held meanwhile, so it is told in order.
    fn report(&self, done: &Mutex<usize>, more: usize, cases: usize) {
        let mut done = lock(done);
        *done += more;
        if let Some(progress) = lock(&self.progress).as_mut() {
            progress(*done, cases);
        }
    }
}

/// What is behind a lock; that another thread has panicked is that thread's matter.
fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn pool(threads: usize) -> Result<rayon::ThreadPool> {
    let built = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    built.map_err(|why| Error::InvalidOptions { reason: format!("{threads} threads cannot be had: {why}") })
}
