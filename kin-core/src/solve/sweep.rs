//! Runs many cases of one system, with different parameters and initial values, on all cores of the
//! machine.
//!
//! One compiled program computes all cases: the numbers that differ between cases are inputs of the
//! program.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use crate::numbers::lanes::Lanes;
use crate::outcome::error::{Error, Result};
use crate::solve::compiled::{Cases, Varied};
use crate::solve::explain::Explain;
use crate::solve::motion::Motion;
use crate::solve::options::SolverOptions;
use crate::solve::run::times;
use crate::solve::whole_run;
use crate::system::System;
use crate::system::parameters::CasePlace;

/// Cases that are handed to a thread at once.
const BATCH: usize = 16;

/// Threads of a sweep at most.
const THREADS: usize = 256;

/// Many cases of one [`System`]. Each case is a row of numbers, one number for each name.
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
///     kin::Result::Ok(motion?.point(rod, vec2(1.0, 0.0))?.speed().max())
/// })?;
/// assert!(fastest.iter().all(|speed| speed.as_ref().is_ok_and(|speed| *speed > 1.0)));
/// # Ok(())
/// # }
/// ```
///
/// The results are in the order of the cases and do not depend on the number of threads. The sweep
/// stores only the results of the closure, so memory does not grow with the motions.
///
/// If possible and faster, one compiled program of the whole mechanism computes all cases
/// ([`Engine`](crate::Engine)). The named values are inputs of the program. The program computes
/// many times of a case at once, in two SIMD registers (16 times with AVX-512). Kin compiles the
/// program at the first position of the system with its present values. If the system cannot be
/// assembled with these values, Kin compiles the program at the first case that can be assembled.
/// Only then do the results depend on the list of cases, within the tolerance of the stop rule. The
/// motion of a case has the same events as a run of this case, such as limits of joints and kinks.
pub struct Sweep<'a> {
    system: &'a System,
    names: Vec<String>,
    places: Vec<CasePlace>,
    options: SolverOptions,
    lanes: Lanes,
    noted: Noted,
    pub(crate) explain: Option<Explain>,
    threads: Option<usize>,
    progress: Mutex<Option<Progress<'a>>>,
    stop: Option<&'a AtomicBool>,
}

/// Adds the events of a run to its motion. The room above finds them.
type Noted = fn(&System, Result<Motion>) -> Result<Motion>;

/// Receives how many cases are done, of how many.
type Progress<'a> = Box<dyn FnMut(usize, usize) + Send + 'a>;

impl<'a> Sweep<'a> {
    /// `noted` adds the events of a run to its motion.
    pub(crate) fn new(
        system: &'a System,
        names: impl IntoIterator<Item = impl AsRef<str>>,
        noted: Noted,
    ) -> Result<Self> {
        let names: Vec<String> = names.into_iter().map(|name| name.as_ref().to_string()).collect();
        let places = system.places(&names)?;
        let lanes = Lanes::default();
        let progress = Mutex::new(None);
        let options = SolverOptions::default();
        Ok(Sweep {
            system,
            names,
            places,
            options,
            lanes,
            noted,
            explain: None,
            threads: None,
            progress,
            stop: None,
        })
    }

    /// Sets the options of all cases. The default is [`SolverOptions::default`].
    #[must_use]
    pub fn options(mut self, options: SolverOptions) -> Self {
        self.options = options;
        self
    }

    /// Sets the SIMD lanes in which a program computes the times of a case; [`Lanes::Off`] disables
    /// programs.
    #[must_use]
    pub fn lanes(mut self, lanes: Lanes) -> Self {
        self.lanes = lanes;
        self
    }

    /// Sets the number of separate threads of the sweep, at most 256 and at most the number of
    /// cases.
    ///
    /// By default the sweep uses the threads of rayon: one thread for each core, or the threads of
    /// the pool that calls the sweep.
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = Some(threads.max(1));
        self
    }

    /// Calls `progress` during the sweep with the number of finished cases and the number of all
    /// cases.
    ///
    /// The first call has the number 0; then a call follows after every few cases. Only one thread
    /// at a time calls `progress`, and the number never decreases.
    #[must_use]
    pub fn progress(mut self, progress: impl FnMut(usize, usize) + Send + 'a) -> Self {
        self.progress = Mutex::new(Some(Box::new(progress)));
        self
    }

    /// Stops the sweep with [`Error::Stopped`] soon after the flag `stop` becomes true.
    #[must_use]
    pub fn stop_when(mut self, stop: &'a AtomicBool) -> Self {
        self.stop = Some(stop);
        self
    }

    /// Runs every case over the times, and returns the results of `keep` in the order of the cases.
    ///
    /// Several threads call `keep` at the same time, with the index of a case and its motion, or
    /// with the error that ended the case. [`Error::motion`] contains the motion before the error.
    /// The error has a diagnosis only if [`Sweep::diagnose`] requests a diagnosis.
    ///
    /// Errors of the whole sweep:
    ///
    /// * A case has the wrong length.
    /// * A number is not finite.
    /// * The times do not only increase or only decrease.
    /// * An option is out of its range.
    /// * The motions that the threads compute at the same time need too much memory.
    /// * The flag of [`Sweep::stop_when`] stopped the sweep ([`Error::Stopped`]).
    ///
    /// Except for the last error, Kin finds these errors before it computes a case.
    pub fn run<R: Send>(
        &self,
        cases: &[impl AsRef<[f64]> + Sync],
        times: impl AsRef<[f64]>,
        keep: impl Fn(usize, Result<Motion>) -> R + Sync,
    ) -> Result<Vec<R>> {
        self.run_each(cases, times, |case, _, motion| keep(case, motion))
    }

    /// The same, with the system of each case: the one with its numbers.
    pub(crate) fn run_each<R: Send>(
        &self,
        cases: &[impl AsRef<[f64]> + Sync],
        times: impl AsRef<[f64]>,
        keep: impl Fn(usize, &System, Result<Motion>) -> R + Sync,
    ) -> Result<Vec<R>> {
        let times = times.as_ref();
        self.options.check()?;
        times::check(times)?;
        self.check(cases)?;
        if matches!(self.lanes, Lanes::Only(_)) && !self.lanes.are_there() {
            return Err(not_there(self.lanes));
        }
        let means = self.means(cases, times)?;
        let job = Job { sweep: self, cases, times, means, keep: &keep, done: Mutex::new(0) };
        job.report(0);
        match self.threads {
            None => job.run(),
            Some(threads) => pool(threads.min(cases.len().div_ceil(BATCH)).clamp(1, THREADS))?
                .install(|| job.run()),
        }
    }

    /// The means that compute all cases.
    fn means(&self, cases: &[impl AsRef<[f64]>], times: &[f64]) -> Result<Cases> {
        let set = |system: &mut System, case: usize| self.set(system, cases[case].as_ref());
        let Sweep { system, names, places, .. } = self;
        let varied = Varied { system, names, places, count: cases.len(), times, set: &set };
        Cases::new(&varied, &self.options, self.lanes)
    }

    /// Gives the system the numbers of a case; an error where one of them could not be set
    /// ([`System::set`]).
    fn set(&self, system: &mut System, case: &[f64]) -> Result<()> {
        for (place, value) in self.places.iter().zip(case) {
            system.put(*place, *value);
        }
        system.check_put(&self.places)
    }

    /// Each case must have one finite number for each name.
    fn check(&self, cases: &[impl AsRef<[f64]>]) -> Result<()> {
        for (case, values) in cases.iter().map(AsRef::as_ref).enumerate() {
            if values.len() != self.names.len() {
                return Err(Error::WrongLength {
                    what: format!("case {case}"),
                    expected: self.names.len(),
                    found: values.len(),
                });
            }
            if let Some((name, value)) =
                self.names.iter().zip(values).find(|(_, value)| !value.is_finite())
            {
                return Err(Error::CaseNotFinite { case, name: name.clone(), value: *value });
            }
        }
        Ok(())
    }
}

/// One run of a sweep.
struct Job<'j, 'a, C, K> {
    sweep: &'j Sweep<'a>,
    cases: &'j [C],
    times: &'j [f64],
    means: Cases,
    keep: &'j K,
    /// How many cases are done.
    done: Mutex<usize>,
}

impl<C: AsRef<[f64]> + Sync, R: Send, K: Fn(usize, &System, Result<Motion>) -> R + Sync>
    Job<'_, '_, C, K>
{
    /// All batches, on the threads of this pool.
    fn run(&self) -> Result<Vec<R>> {
        let at_once = self.cases.len().min(rayon::current_num_threads());
        self.sweep.options.check_memory(
            at_once,
            self.times.len(),
            self.sweep.system.n_coordinates(),
        )?;
        let batch = |system: &mut System, (number, cases): (usize, &[C])| {
            if self.sweep.stop.is_some_and(|stop| stop.load(Ordering::Relaxed)) {
                let done = *lock(&self.done);
                let all = self.cases.len();
                return Err(Error::Stopped { done, all, motion: None });
            }
            let each = cases.iter().enumerate();
            let kept: Vec<R> = each
                .map(|(k, case)| {
                    let set = self.sweep.set(system, case.as_ref());
                    let motion = set.and_then(|()| self.motion(system));
                    (self.keep)(number * BATCH + k, system, motion)
                })
                .collect();
            self.report(cases.len());
            Ok(kept)
        };
        let batches = self.cases.par_chunks(BATCH).enumerate();
        let kept: Result<Vec<Vec<R>>> =
            batches.map_init(|| self.sweep.system.clone(), batch).collect();
        Ok(kept?.into_iter().flatten().collect())
    }

    /// The motion of a case whose numbers the system has.
    fn motion(&self, system: &System) -> Result<Motion> {
        let options = &self.sweep.options;
        let explain = self.sweep.explain;
        let computing = self.means.computing(system, self.times.len(), options)?;
        let motion = whole_run::run_by(system, self.times, (options, explain), computing);
        (self.sweep.noted)(system, motion)
    }

    /// Counts more cases as done and tells; the count is held meanwhile, so it is told in order.
    fn report(&self, more: usize) {
        let mut done = lock(&self.done);
        *done += more;
        if let Some(progress) = lock(&self.sweep.progress).as_mut() {
            progress(*done, self.cases.len());
        }
    }
}

fn not_there(lanes: Lanes) -> Error {
    Error::InvalidOptions {
        reason: format!(
            "this machine does not have the registers for {lanes:?}. Choose `Lanes::Best`"
        ),
    }
}

/// The value behind a lock; that another thread has panicked is that thread's matter.
fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn pool(threads: usize) -> Result<rayon::ThreadPool> {
    let built = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    built.map_err(|why| Error::InvalidOptions {
        reason: format!("Kin cannot start {threads} threads: {why}"),
    })
}
