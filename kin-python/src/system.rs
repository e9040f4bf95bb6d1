//! A mechanism made ready for solving, and what is asked of it. A run works on a system of its own,
//! without Python's lock; `set` changes the one that the next run takes.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use kin::SolverOptions;
use kin::diagnosis::Diagnosis;
use kin::results::{Extremes, Proof, Solution};
use kin::solver::Start;
use kin_view::Scene;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use serde_json::json;

use crate::fault::{or_raise, unreadable};
use crate::measured::What;
use crate::motion::{Motion, Orders, quantity, series};
use crate::numbers;
use crate::options::{assembly_options, options};
use crate::watch::Watch;

/// A system.
#[pyclass(frozen, module = "kin._native")]
pub struct System(Mutex<Arc<kin::System>>);

impl From<kin::System> for System {
    fn from(system: kin::System) -> Self {
        System(Mutex::new(Arc::new(system)))
    }
}

/// Time, q, q̇, q̈, Newton steps, residual, the equation that has it, whether a program has found
/// it.
type Solved<'py> =
    (f64, Bound<'py, PyBytes>, Bound<'py, PyBytes>, Bound<'py, PyBytes>, usize, f64, String, bool);

/// A proof in words, whether it is complete; of each step its times, the tube (how near the
/// solution is, how far the next one at least) or the doubt (its time, in words); laws that are
/// trusted; bounds of each position's error.
pub type Proved = (String, bool, Vec<Step>, Vec<String>, Vec<Option<Vec<f64>>>);
type Step = (f64, f64, Option<(Vec<f64>, Vec<f64>)>, Option<(f64, String)>);

/// The label and the pose of each assembly; whether these are all, and the reason.
type Listed<'py> = (Vec<(String, Bound<'py, PyBytes>)>, String, String);

/// A program: in words, coordinates that are given and left, blocks, steps.
type Program = (String, Vec<String>, Vec<String>, Vec<usize>, usize);

/// Name, unit; time, value and kind of each extreme; stroke; time ratio.
type Turns = (String, String, Vec<(f64, f64, bool)>, f64, Option<f64>, (f64, f64), (f64, f64));

/// A diagnosis: as text, as JSON, and what follows of it as JSON.
pub type Verdict = (String, String, String);

/// A diagnosis as it is handed over.
pub fn diagnosis(found: &Diagnosis) -> PyResult<Verdict> {
    let answers = json!({
        "can_be_driven": found.can_be_driven(),
        "is_exactly_constrained": found.is_exactly_constrained(),
        "count_misleads": found.count_misleads(),
        "redundancies": found.redundancies().collect::<Vec<_>>(),
        "contradictions": found.contradictions().collect::<Vec<_>>(),
        "lasting_freedoms": found.lasting_freedoms().collect::<Vec<_>>(),
    });
    let data = serde_json::to_string(found).map_err(|error| unreadable(&error))?;
    Ok((found.to_string(), data, answers.to_string()))
}

fn solved<'py>(py: Python<'py>, at: &Solution) -> PyResult<Solved<'py>> {
    let list = |numbers: &[f64]| numbers::list(py, numbers);
    let report = &at.report;
    Ok((
        at.t,
        list(&at.q)?,
        list(&at.qd)?,
        list(&at.qdd)?,
        report.iterations,
        report.residual,
        report.worst.clone(),
        report.compiled,
    ))
}

fn turns(found: &Extremes) -> Turns {
    let all = found.all().iter().map(|one| (one.t, one.value, one.is_max)).collect();
    let end = |extreme: kin::results::Extreme| (extreme.t, extreme.value);
    let name = (found.name().to_owned(), found.unit().to_owned());
    (name.0, name.1, all, found.stroke(), found.time_ratio(), end(found.min()), end(found.max()))
}

impl System {
    /// The system as it is now.
    pub fn now(&self) -> Arc<kin::System> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// A proof over so many positions: as text, whether it is complete, its steps, trusted laws and
/// errors.
pub fn proved(proof: &Proof, positions: usize) -> Proved {
    let tubes = proof.steps().iter().map(|step| {
        let tube = step.tube.as_ref().map(|tube| (tube.radius.clone(), tube.alone.clone()));
        (
            step.from,
            step.to,
            tube.as_ref().ok().cloned(),
            tube.err().map(|doubt| (doubt.t, doubt.to_string())),
        )
    });
    let errors = (0..positions).map(|k| proof.error(k).map(<[f64]>::to_vec)).collect();
    (proof.to_string(), proof.is_complete(), tubes.collect(), proof.trusted().to_vec(), errors)
}

#[pymethods]
impl System {
    fn name(&self) -> String {
        self.now().name().to_owned()
    }

    fn names(&self) -> Vec<String> {
        self.now().coordinate_names().to_vec()
    }

    fn equations(&self) -> Vec<String> {
        self.now().equation_names()
    }

    fn units(&self) -> Vec<String> {
        self.now().coordinate_units()
    }

    fn initial<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        numbers::list(py, self.now().initial())
    }

    fn parameters(&self) -> Vec<(String, f64)> {
        self.now().parameters()
    }

    /// Names and values of the dimensions.
    fn dimensions(&self) -> Vec<(String, f64)> {
        self.now().dimensions()
    }

    /// The same system, to be set by itself.
    fn copy(&self) -> System {
        System(Mutex::new(self.now()))
    }

    fn parameter(&self, py: Python<'_>, name: &str) -> PyResult<f64> {
        or_raise(py, self.now().parameter(name))
    }

    /// Names of constraints, of loads, of bodies and bare coordinates.
    fn parts(&self) -> [Vec<String>; 3] {
        let system = self.now();
        let list = |names: Vec<&str>| names.into_iter().map(str::to_owned).collect();
        let bodies = system.bodies().into_iter().map(|(name, _)| name.to_owned()).collect();
        [list(system.constraint_names()), list(system.load_names()), bodies]
    }

    fn measures(&self) -> Vec<String> {
        self.now().measures()
    }

    /// The mechanism as a file of C.
    fn emit(
        &self,
        py: Python<'_>,
        language: &str,
        name: Option<String>,
        free: Vec<String>,
        measures: Vec<String>,
        t0: f64,
    ) -> PyResult<String> {
        let system = self.now();
        let options = kin::emit::Options { name, free, measures, t0 };
        let printed = match language {
            "c" => py.detach(|| kin::emit::c(&system, &options)),
            _ => Err(kin::Error::InvalidOptions {
                reason: format!("Kin does not print the language `{language}`. Use \"c\""),
            }),
        };
        or_raise(py, printed)
    }

    fn has_forces(&self) -> bool {
        self.now().has_forces()
    }

    fn set(&self, py: Python<'_>, name: &str, value: f64) -> PyResult<()> {
        let changed = Arc::make_mut(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
            .set(name, value);
        or_raise(py, changed)
    }

    fn set_initial(&self, py: Python<'_>, q: &[u8]) -> PyResult<()> {
        let q = numbers::read(q)?;
        let mut system = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let changed = Arc::make_mut(&mut system).set_initial(&q);
        or_raise(py, changed)
    }

    /// The run; `progress` is called with the times that are done and all of them.
    #[pyo3(signature = (times, keywords = None, progress = None, start = None))]
    fn run(
        &self,
        py: Python<'_>,
        times: &[u8],
        keywords: Option<&Bound<'_, PyDict>>,
        progress: Option<Py<PyAny>>,
        start: Option<(String, f64)>,
    ) -> PyResult<Motion> {
        let system = self.now();
        let times = numbers::read(times)?;
        let options = options(keywords)?;
        let mut watch = Watch::new(progress, times.len());
        let stop = AtomicBool::new(false);
        let run = py.detach(|| {
            let look = |done, _| {
                if !watch.look(done) {
                    stop.store(true, Ordering::Relaxed);
                }
            };
            let solver = system.solver().options(options).progress(look).stop_when(&stop);
            match start {
                Some((name, sign)) => solver.start(Start::towards(name, sign)).run(&times),
                None => { solver }.run(&times),
            }
        });
        watch.end(run.is_ok())?;
        or_raise(py, run).map(Motion::from)
    }

    #[pyo3(signature = (t, q = None, keywords = None))]
    fn position<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        q: Option<&[u8]>,
        keywords: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Solved<'py>> {
        let system = self.now();
        let options = options(keywords)?;
        let start = q.map(numbers::read).transpose()?;
        let found = py.detach(|| match start {
            Some(q) => system.solver().options(options).solve_at(t, &q),
            None => system.solver().options(options).position(t),
        });
        solved(py, &or_raise(py, found)?)
    }

    /// C (0), C_t (1), q̇ (2) at q and t.
    fn at_position<'py>(
        &self,
        py: Python<'py>,
        which: usize,
        q: &[u8],
        t: f64,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let system = self.now();
        let q = numbers::read(q)?;
        let found = match which {
            0 => system.residual(&q, t),
            1 => system.c_t(&q, t),
            _ => system.velocity(&q, t),
        };
        numbers::list(py, &or_raise(py, found)?)
    }

    /// C_q at q and t, row by row.
    fn jacobian<'py>(&self, py: Python<'py>, q: &[u8], t: f64) -> PyResult<Bound<'py, PyBytes>> {
        let found = or_raise(py, self.now().jacobian(&numbers::read(q)?, t))?;
        numbers::list(py, found.transpose().as_slice())
    }

    /// Q_d (0) or q̈ (1) at q, q̇ and t.
    fn at_velocity<'py>(
        &self,
        py: Python<'py>,
        which: usize,
        q: &[u8],
        qd: &[u8],
        t: f64,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let system = self.now();
        let q = numbers::read(q)?;
        let qd = numbers::read(qd)?;
        let found = match which {
            0 => system.acceleration_rhs(&q, &qd, t),
            _ => system.acceleration(&q, &qd, t),
        };
        numbers::list(py, &or_raise(py, found)?)
    }

    /// The right side of C_q q⃛ (0) or q⃛ (1) at q, q̇, q̈ and t.
    fn at_acceleration<'py>(
        &self,
        py: Python<'py>,
        which: usize,
        state: [Vec<f64>; 3],
        t: f64,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let system = self.now();
        let [q, qd, qdd] = state;
        let found = match which {
            0 => system.jerk_rhs(&q, &qd, &qdd, t),
            _ => system.jerk(&q, &qd, &qdd, t),
        };
        numbers::list(py, &or_raise(py, found)?)
    }

    #[pyo3(signature = (t, q = None))]
    fn diagnose(&self, py: Python<'_>, t: f64, q: Option<&[u8]>) -> PyResult<Verdict> {
        let system = self.now();
        let q = q.map(numbers::read).transpose()?;
        let found = py.detach(|| match q {
            Some(q) => system.diagnose((t, &q)),
            None => system.diagnose(t),
        });
        diagnosis(&or_raise(py, found)?)
    }

    /// Each assembly, its label and its pose; whether these are all, and the reason.
    fn assemblies<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        keywords: &Bound<'py, PyDict>,
    ) -> PyResult<Listed<'py>> {
        let system = self.now();
        let options = assembly_options(keywords)?;
        let found = or_raise(
            py,
            py.detach(|| {
                system
                    .solver()
                    .options(SolverOptions::new().assemblies(options.clone()))
                    .assemblies(t)
            }),
        )?;
        let one =
            |one: &kin::solver::Assembly| Ok((one.label.to_string(), numbers::list(py, &one.q)?));
        let all: PyResult<Vec<_>> = found.iter().map(one).collect();
        Ok((all?, found.complete.to_string(), found.reason))
    }

    /// The pose of the assembly of a label.
    fn assembly<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        label: &str,
        keywords: &Bound<'py, PyDict>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let system = self.now();
        let options = assembly_options(keywords)?;
        let label: kin::solver::Label = or_raise(py, label.parse())?;
        let found = or_raise(
            py,
            py.detach(|| {
                system
                    .solver()
                    .options(SolverOptions::new().assemblies(options.clone()))
                    .assembly(t, &label)
            }),
        )?;
        numbers::list(py, &found.q)
    }

    /// The assembly with a measure nearest to a value: its label, its pose.
    fn assembly_near<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        what: &str,
        value: f64,
    ) -> PyResult<(String, Bound<'py, PyBytes>)> {
        let system = self.now();
        let found = or_raise(py, py.detach(|| system.assembly_near(t, what, value)))?;
        Ok((found.label.to_string(), numbers::list(py, &found.q)?))
    }

    fn measure<'py>(&self, py: Python<'py>, motion: &Motion, what: What) -> PyResult<Orders<'py>> {
        let system = self.now();
        let motion = &motion.0;
        quantity(py, &what.ask(py, |what| system.measure(motion, what))?)
    }

    fn extremes(&self, py: Python<'_>, motion: &Motion, what: What) -> PyResult<Turns> {
        let system = self.now();
        let motion = &motion.0;
        what.ask(py, |what| system.extremes(motion, what)).map(|found| turns(&found))
    }

    /// Times at which a measure passes a value, and whether it rises there.
    fn crossings(
        &self,
        py: Python<'_>,
        motion: &Motion,
        what: What,
        value: f64,
    ) -> PyResult<Vec<(f64, bool)>> {
        let system = self.now();
        let motion = &motion.0;
        let found = what.ask(py, |what| system.crossings(motion, what, value))?;
        Ok(found.into_iter().map(|one| (one.t, one.rises)).collect())
    }

    /// The motion of one time.
    fn at(&self, py: Python<'_>, motion: &Motion, t: f64) -> PyResult<Motion> {
        let system = self.now();
        let motion = &motion.0;
        or_raise(py, py.detach(|| system.at(motion, t))).map(Motion::from)
    }

    fn smallest_singular_value<'py>(
        &self,
        py: Python<'py>,
        motion: &Motion,
    ) -> PyResult<Orders<'py>> {
        let system = self.now();
        let motion = &motion.0;
        series(py, &or_raise(py, py.detach(|| system.smallest_singular_value(motion)))?)
    }

    fn condition<'py>(&self, py: Python<'py>, motion: &Motion) -> PyResult<Orders<'py>> {
        let system = self.now();
        let motion = &motion.0;
        series(py, &or_raise(py, py.detach(|| system.condition(motion)))?)
    }

    fn mechanical_advantage<'py>(
        &self,
        py: Python<'py>,
        motion: &Motion,
        drive: &str,
        output: &str,
    ) -> PyResult<Orders<'py>> {
        let system = self.now();
        let motion = &motion.0;
        let found = py.detach(|| system.mechanical_advantage(motion, drive, output));
        series(py, &or_raise(py, found)?)
    }

    fn prove(&self, py: Python<'_>, motion: &Motion) -> PyResult<Proved> {
        let system = self.now();
        let motion = &motion.0;
        let proof = or_raise(py, py.detach(|| system.prove(motion)))?;
        Ok(proved(&proof, motion.len()))
    }

    /// Its program in words; the coordinates that rows give, those that are left, the blocks in
    /// which they are solved, and how many steps it has.
    fn compile(&self, py: Python<'_>) -> PyResult<Program> {
        let system = self.now();
        let found = or_raise(py, py.detach(|| system.compile()))?;
        let given = found.substituted().to_vec();
        let left = found.unknowns().to_vec();
        Ok((found.to_string(), given, left, found.blocks().to_vec(), found.steps()))
    }

    /// The mechanism at a time, or so many poses of the motion on one another, as SVG.
    #[pyo3(signature = (motion, t = None, poses = 12))]
    fn picture(
        &self,
        py: Python<'_>,
        motion: &Motion,
        t: Option<f64>,
        poses: usize,
    ) -> PyResult<String> {
        let system = self.now();
        let motion = &motion.0;
        let drawn = py.detach(|| match t {
            Some(t) => Scene::new(&system).pose(motion, t),
            None => Scene::new(&system).sequence(motion, poses),
        });
        or_raise(py, drawn).map(|picture| picture.svg().to_owned())
    }
}
