//! Many cases of one system: other parameters and initial values in each, spread over the cores of the
//! machine.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;

use crate::model::error::{Error, Result};
use crate::numbers::lanes::{Lanes, Level, Mask, Wide, WithLevel};
use crate::solve::explain::Explain;
use crate::solve::motion::Motion;
use crate::solve::newton::lanes::Lockstep;
use crate::solve::newton::{self, Engine, Options};
use crate::system::System;
use crate::system::evaluate::lanes::LaneSystems;
use crate::system::parameters::CasePlace;

/// Cases that are handed to a thread at once: as many as there are lanes, or a multiple.
const BATCH: usize = 16;

/// Threads of a sweep at most.
const THREADS: usize = 256;

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
///     kin::Result::Ok(motion?.point(rod, vec2(1.0, 0.0))?.speed().max())
/// })?;
/// assert!(fastest.iter().all(|speed| speed.as_ref().is_ok_and(|speed| *speed > 1.0)));
/// # Ok(())
/// # }
/// ```
///
/// Results come in the order of the cases and do not depend on the number of threads. Of a motion only what
/// the closure gives back is kept, so memory grows with the results alone.
///
/// Where constraints have kernels over lanes (the library's joints and drivers, and your own with
/// `#[constraint(lanes)]`), two SIMD registers of cases advance together (16 with AVX-512); the others' are
/// evaluated lane by lane. Lanes, and the company of other cases in them, change results by rounding only: by
/// no more than the tolerance of the stop rule. A case that fails in its lane is run again alone. Limits of
/// joints are not looked at: ask a run of the case for them.
pub struct Sweep<'a> {
    system: &'a System,
    names: Vec<String>,
    places: Vec<CasePlace>,
    options: Options,
    lanes: Lanes,
    pub(crate) explain: Option<Explain>,
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
        let (lanes, progress) = (Lanes::default(), Mutex::new(None));
        let options = Options { engine: Engine::Plain, ..Options::default() };
        Ok(Sweep {
            system,
            names,
            places,
            options,
            lanes,
            explain: None,
            threads: None,
            progress,
            stop: None,
        })
    }

    /// Other options than [`Options::default`]. The engine is plain whatever they say: a program is of one
    /// case only.
    #[must_use]
    pub fn options(mut self, options: Options) -> Self {
        self.options = Options { engine: Engine::Plain, ..options };
        self
    }

    /// How many cases advance together; [`Lanes::Off`] turns lanes off.
    #[must_use]
    pub fn lanes(mut self, lanes: Lanes) -> Self {
        self.lanes = lanes;
        self
    }

    /// On so many threads of its own, and no more than can have cases, nor than 256. Without it the threads
    /// are rayon's: one a core, or those of the pool that the sweep is run in.
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = Some(threads.max(1));
        self
    }

    /// Calls this with the number of cases done and of all cases, at the start with 0 and then every few
    /// cases, by one thread at a time and never with less than before.
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
    /// `keep` is called with the number of the case and its motion, or with the error that ended it
    /// ([`Error::motion`] holds what was computed before; what is wrong with the mechanism is looked for only
    /// if [`Sweep::diagnose`] asks), by several threads at once.
    ///
    /// Errors of the sweep as a whole, before anything is computed: a case of the wrong length, a number that
    /// is not finite, times that do not only increase or only decrease, options out of range, motions under
    /// way that take too much memory; and [`Error::Stopped`].
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
        newton::run::check(times)?;
        self.check(cases)?;
        let job = Job { sweep: self, cases, times, keep: &keep, done: Mutex::new(0) };
        job.report(0);
        let all = || match self.lanes {
            Lanes::Off => job.one_by_one(),
            _ if self.options.jerk || self.system.n_coordinates() == 0 || self.system.is_redundant() => {
                job.one_by_one()
            }
            Lanes::Best if !self.system.has_lanes() => job.one_by_one(),
            Lanes::Best => Lanes::Best.dispatch(&job).unwrap_or_else(|job| job.one_by_one()),
            lanes => lanes.dispatch(&job).unwrap_or_else(|_| Err(not_there(lanes))),
        };
        match self.threads {
            None => all(),
            Some(threads) => pool(threads.min(cases.len().div_ceil(BATCH)).clamp(1, THREADS))?.install(all),
        }
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
            if let Some((name, value)) = self.names.iter().zip(values).find(|(_, value)| !value.is_finite()) {
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
    keep: &'j K,
    /// How many cases are done.
    done: Mutex<usize>,
}

impl<C: AsRef<[f64]> + Sync, R: Send, K: Fn(usize, &System, Result<Motion>) -> R + Sync> Job<'_, '_, C, K> {
    /// Each case by itself.
    fn one_by_one(&self) -> Result<Vec<R>> {
        self.check_memory(1)?;
        self.batches(
            || self.sweep.system.clone(),
            |system, first, cases| {
                let run = |(k, case): (usize, &C)| {
                    let set = self.sweep.set(system, case.as_ref());
                    let motion = set.and_then(|()| self.alone(system));
                    (self.keep)(first + k, system, motion)
                };
                cases.iter().enumerate().map(run).collect()
            },
        )
    }

    /// One case by itself.
    fn alone(&self, system: &System) -> Result<Motion> {
        newton::run::run(system, self.times, &self.sweep.options, self.sweep.explain, None)
    }

    /// An error if the motions that are under way at once, so many a thread, take more memory than is
    /// allowed.
    fn check_memory(&self, lanes: usize) -> Result<()> {
        let at_once = self.cases.len().min(rayon::current_num_threads().saturating_mul(lanes));
        self.sweep.options.check_memory(at_once, self.times.len(), self.sweep.system.n_coordinates())
    }

    /// All batches, on the threads of this pool.
    fn batches<W>(
        &self,
        worker: impl Fn() -> W + Sync + Send,
        run: impl Fn(&mut W, usize, &[C]) -> Vec<R> + Sync + Send,
    ) -> Result<Vec<R>> {
        let batch = |worker: &mut W, (number, cases): (usize, &[C])| {
            if self.sweep.stop.is_some_and(|stop| stop.load(Ordering::Relaxed)) {
                let (done, all) = (*lock(&self.done), self.cases.len());
                return Err(Error::Stopped { done, all, motion: None });
            }
            let kept = run(worker, number * BATCH, cases);
            self.report(cases.len());
            Ok(kept)
        };
        let kept: Result<Vec<Vec<R>>> =
            self.cases.par_chunks(BATCH).enumerate().map_init(worker, batch).collect();
        Ok(kept?.into_iter().flatten().collect())
    }

    /// Counts more cases as done and tells; the count is held meanwhile, so it is told in order.
    fn report(&self, more: usize) {
        let mut done = lock(&self.done);
        *done += more;
        if let Some(progress) = lock(&self.sweep.progress).as_mut() {
            progress(*done, self.cases.len());
        }
    }

    /// As many cases as there are lanes, together.
    fn together<S: Level>(
        &self,
        simd: S,
        (systems, lockstep): &mut Worker<'_, S>,
        first: usize,
        cases: &[C],
    ) -> Vec<R> {
        // Lanes without a case have the first one's numbers, so that nothing odd is computed there.
        let all = systems.iter_mut().enumerate();
        let set: Vec<Result<()>> = all
            .map(|(lane, system)| {
                let case = cases.get(lane).or(cases.first());
                case.map_or(Ok(()), |case| self.sweep.set(system, case.as_ref()))
            })
            .collect();
        let wanted =
            Mask::from_fn(simd, |lane| lane < cases.len() && set.get(lane).is_some_and(Result::is_ok));
        let motions = self.motions(lockstep, &LaneSystems::new(systems), wanted, cases.len());
        let each = motions.into_iter().zip(systems.iter()).zip(set).enumerate();
        each.map(|(lane, ((motion, system), set))| {
            let motion = set.and_then(|()| motion.map_or_else(|| self.alone(system), Ok));
            (self.keep)(first + lane, system, motion)
        })
        .collect()
    }

    /// The motions of one group of lanes; none for those that fail.
    fn motions<S: Level>(
        &self,
        lockstep: &mut Lockstep<'_, S>,
        batch: &LaneSystems<'_>,
        wanted: Mask<S>,
        count: usize,
    ) -> Vec<Option<Motion>> {
        let mut motions: Vec<Motion> =
            batch.systems.iter().take(count).map(|system| Motion::new(system, self.times.len())).collect();
        let mut active = wanted;
        for (k, &t) in self.times.iter().enumerate() {
            let before = active;
            active =
                if k == 0 { lockstep.first(batch, active, t) } else { lockstep.advance(batch, active, t) };
            if !active.any() {
                break;
            }
            if (before & !active).any() {
                lockstep.fill(active);
            }
            if lockstep.keep() {
                lockstep.flush(&mut motions);
            }
        }
        lockstep.flush(&mut motions);
        lockstep.complete(self.times, &mut motions);
        let done = |lane: usize, motion: &Motion| {
            active.lane(lane)
                && batch.systems[lane].all_meant((0..motion.len()).map(|k| (motion.times()[k], motion.q(k))))
        };
        motions.into_iter().enumerate().map(|(lane, motion)| done(lane, &motion).then_some(motion)).collect()
    }
}

/// The systems of all lanes, and their common steps.
type Worker<'o, S> = (Vec<System>, Lockstep<'o, S>);

impl<C: AsRef<[f64]> + Sync, R: Send, K: Fn(usize, &System, Result<Motion>) -> R + Sync> WithLevel
    for &Job<'_, '_, C, K>
{
    type Output = Result<Vec<R>>;

    fn run<S: Level>(self, simd: S) -> Self::Output {
        let (sweep, lanes) = (self.sweep, Wide::<S>::LANES);
        self.check_memory(lanes)?;
        let worker = || {
            let mut typical = sweep.system.clone();
            if let Some(case) = self.cases.first() {
                // Its numbers may be none that can be set: then its lane is not asked.
                let _ = sweep.set(&mut typical, case.as_ref());
            }
            let varied = sweep.system.varied(&sweep.places);
            let ends = [self.times[0], self.times[self.times.len() - 1]];
            let lockstep = Lockstep::new(simd, &typical, &varied, &sweep.options, ends);
            (vec![typical; lanes], lockstep)
        };
        self.batches(worker, |worker, first, cases| {
            let groups = cases.chunks(lanes).enumerate();
            groups.flat_map(|(k, group)| self.together(simd, worker, first + k * lanes, group)).collect()
        })
    }
}

fn not_there(lanes: Lanes) -> Error {
    Error::InvalidOptions {
        reason: format!("this machine does not have {lanes:?}; Lanes::Best takes what there is"),
    }
}

/// The value behind a lock; that another thread has panicked is that thread's matter.
fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn pool(threads: usize) -> Result<rayon::ThreadPool> {
    let built = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    built.map_err(|why| Error::InvalidOptions { reason: format!("{threads} threads cannot be had: {why}") })
}
