//! How a motion changes with parameters, and what tolerances of dimensions make of it.

use std::collections::BTreeMap;

use kin::design::{Distribution, Feature, Off, Sampling, Sensitivities, Sensitivity, Tolerance};
use kin::results::Extreme;
use kin::results::SingularPosition;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::fault::{or_raise, value};
use crate::held::HeldSensitivities;
use crate::measured::{Measured, What};
use crate::motion::Motion;
use crate::numbers;
use crate::system::System;

/// The mistake of data that are no toggle.
const NO_TOGGLE: &str = "`toggle` is one of the singular positions of a motion, such as `error.motion.singular_positions[-1]`";

/// Names, each with the lists of its value and its rates.
type Derived<'py> = Vec<(String, Vec<Bound<'py, PyBytes>>)>;

/// The derivatives of a motion of a system by parameters.
#[pyclass(frozen, module = "kin._native")]
pub struct Derivatives(HeldSensitivities);

#[pymethods]
impl Derivatives {
    #[new]
    fn new(
        py: Python<'_>,
        system: &System,
        motion: &Motion,
        names: Vec<String>,
    ) -> PyResult<Derivatives> {
        let run = (system.now(), motion.0.clone());
        let found = py
            .detach(|| HeldSensitivities::try_new(run, |run| run.0.sensitivities(&run.1, &names)));
        or_raise(py, found).map(Derivatives)
    }

    /// ∂q/∂p, ∂q̇/∂p and ∂q̈/∂p, row by row.
    fn all<'py>(&self, py: Python<'py>) -> PyResult<Derived<'py>> {
        let found = self.0.borrow_dependent().all();
        let times = 0..self.0.borrow_owner().1.len();
        let lists = found.iter().map(|one| {
            let orders = [Sensitivity::q, Sensitivity::qd, Sensitivity::qdd];
            let rows = orders
                .map(|of| times.clone().flat_map(|k| of(one, k)).copied().collect::<Vec<f64>>());
            let lists = rows.iter().map(|rows| numbers::list(py, rows)).collect::<PyResult<_>>()?;
            Ok((one.name().to_owned(), lists))
        });
        lists.collect()
    }

    /// Those of a measure and its rates.
    fn of<'py>(&self, py: Python<'py>, what: What) -> PyResult<Derived<'py>> {
        let lists = self.with(py, what, |all, what| all.of(what))?.into_iter().map(|one| {
            let lists =
                [&one.value, &one.rate, &one.second_rate].map(|list| numbers::list(py, list));
            Ok((one.name, lists.into_iter().collect::<PyResult<_>>()?))
        });
        lists.collect()
    }

    /// Those of time and value of an extreme, or of its difference to a second one.
    #[pyo3(signature = (what, first, second = None))]
    fn extreme(
        &self,
        py: Python<'_>,
        what: What,
        first: Turn,
        second: Option<Turn>,
    ) -> PyResult<Vec<(String, f64, f64)>> {
        let found = self.with(py, what, |all, what| match second {
            None => all.extreme(what, &extreme(first)),
            Some(second) => all.between(what, &extreme(first), &extreme(second)),
        });
        Ok(found?.into_iter().map(|one| (one.name, one.t, one.value)).collect())
    }
}

impl Derivatives {
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        what: What,
        ask: impl FnOnce(&Sensitivities<'_>, &Measured) -> kin::Result<T> + Send,
    ) -> PyResult<T> {
        what.ask(py, |measured| ask(self.0.borrow_dependent(), measured))
    }
}

/// The derivatives of one number by parameters; `weights` are its derivatives by a measure and its
/// rates.
#[pyfunction]
pub fn gradient(
    py: Python<'_>,
    system: &System,
    motion: &Motion,
    names: Vec<String>,
    what: What,
    weights: &[u8],
) -> PyResult<Vec<f64>> {
    let system = system.now();
    let motion = &motion.0;
    let weights = numbers::read(weights)?;
    let at =
        |k: usize| std::array::from_fn(|order| weights.get(3 * k + order).copied().unwrap_or(0.0));
    what.ask(py, |measured| system.gradient(motion, names.iter(), measured, at))
}

/// The derivatives of the time of a toggle, told as JSON, by parameters.
#[pyfunction]
pub fn toggle_by(
    py: Python<'_>,
    system: &System,
    toggle: &str,
    names: Vec<String>,
) -> PyResult<Vec<f64>> {
    let toggle: SingularPosition = serde_json::from_str(toggle).map_err(|_| value(NO_TOGGLE))?;
    let system = system.now();
    or_raise(py, py.detach(|| system.toggle_by(&toggle, &names)))
}

/// A place where a measure turns round: its time and value, and true for a maximum.
type Turn = (f64, f64, bool);

fn extreme((t, value, is_max): Turn) -> Extreme {
    if is_max { Extreme::maximum(t, value) } else { Extreme::minimum(t, value) }
}

/// The number of a measure over a motion that is asked about.
#[derive(FromPyObject)]
pub enum Of {
    At(f64),
    /// `max`, `min` or `stroke`.
    Word(String),
    Turn(Turn),
}

impl Of {
    fn feature(
        &self,
        system: &kin::System,
        motion: &kin::Motion,
        what: &Measured,
    ) -> kin::Result<Feature> {
        let extremes = || system.extremes(motion, what);
        Ok(match self {
            Of::At(t) => (*t).into(),
            Of::Turn(turn) => extreme(*turn).into(),
            Of::Word(word) => match word.as_str() {
                "max" => extremes()?.max().into(),
                "min" => extremes()?.min().into(),
                _ => (&extremes()?).into(),
            },
        })
    }
}

/// How far a number of a measure may be off by the tolerances of dimensions; of `None` its value at
/// the time at which that is worst.
#[pyfunction]
#[pyo3(signature = (system, motion, what, of, proved))]
pub fn tolerance<'py>(
    py: Python<'py>,
    system: &System,
    motion: &Motion,
    what: What,
    of: Option<Of>,
    proved: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let system = system.now();
    let motion = &motion.0;
    let found = what.ask(py, |what| match of {
        None => system.tolerance(motion, what),
        Some(of) => {
            let feature = of.feature(&system, motion, what)?;
            if proved {
                system.tolerance_proved(motion, what, feature)
            } else {
                system.tolerance_of(motion, what, feature)
            }
        }
    });
    fields(py, &found?)
}

/// A tolerance by the names of the fields of Python's.
fn fields<'py>(py: Python<'py>, found: &Tolerance) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    let text = [("text", &found.to_string()), ("name", &found.name), ("unit", &found.unit)];
    text.into_iter().try_for_each(|(name, text)| all.set_item(name, text))?;
    let numbers = [
        ("t", found.t),
        ("nominal", found.nominal),
        ("worst_case", found.worst_case()),
        ("rss", found.rss()),
        ("sigma", found.sigma()),
    ];
    numbers.into_iter().try_for_each(|(name, number)| all.set_item(name, number))?;
    all.set_item("misled", found.misled())?;
    all.set_item("attained", found.attained())?;
    all.set_item("corners", (found.corners[0], found.corners[1]))?;
    let looked = &found.searched;
    let place = |all: &[Off]| -> BTreeMap<String, f64> {
        all.iter().map(|off| (off.name.clone(), off.by)).collect()
    };
    let counts = (looked.corners, looked.all_corners, looked.inside);
    let unassembled = looked.unassembled.as_deref().map(place);
    all.set_item("searched", (counts, place(&looked.lowest), place(&looked.highest), unassembled))?;
    let second = found.second_order.as_ref();
    all.set_item(
        "second_order",
        second.map(|one| (&one.names, &one.hessian, one.mean_shift, one.sigma)),
    )?;
    all.set_item("proved", found.proved.as_ref().map(|one| (one.low, one.high, &one.trusted)))?;
    let shares = found.contributions.iter().map(|one| {
        let text = (&one.name, &one.unit, distribution_name(one.distribution));
        let shares = (found.share(one), found.share_of_variance(one));
        (text, [one.tolerance, one.slope, one.off(), one.sigma(), shares.0, shares.1])
    });
    all.set_item("contributions", shares.collect::<Vec<_>>())?;
    Ok(all)
}

/// The words, name and unit of a sample of mechanisms, and its values.
type Sampled<'py> = (String, String, String, Bound<'py, PyBytes>);

/// A number of a measure in many mechanisms whose dimensions are off at random.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "the arguments of the Python method around it")]
pub fn samples<'py>(
    py: Python<'py>,
    system: &System,
    motion: &Motion,
    what: What,
    of: Of,
    count: usize,
    seed: u64,
    distribution: &str,
) -> PyResult<Sampled<'py>> {
    let sampling = Sampling { count, seed, distribution: distribution_of(distribution)? };
    let system = system.now();
    let motion = &motion.0;
    let found = what.ask(py, |what| {
        let feature = of.feature(&system, motion, what)?;
        system.samples(motion, what, feature, &sampling)
    })?;
    let values = numbers::list(py, found.values())?;
    Ok((found.to_string(), found.name().to_owned(), found.unit().to_owned(), values))
}

const DISTRIBUTIONS: [(&str, Distribution); 4] = [
    ("normal", Distribution::Normal),
    ("truncated normal", Distribution::TruncatedNormal),
    ("uniform", Distribution::Uniform),
    ("disc", Distribution::Disc),
];

/// The distribution of this name. Errors: another one.
pub fn distribution_of(name: &str) -> PyResult<Distribution> {
    let found = DISTRIBUTIONS.iter().find(|(known, _)| *known == name);
    let known = DISTRIBUTIONS.map(|(known, _)| known).join("\", \"");
    found
        .map(|(_, one)| *one)
        .ok_or_else(|| value(format!("distribution: \"{known}\", not {name:?}")))
}

fn distribution_name(one: Distribution) -> &'static str {
    DISTRIBUTIONS.iter().find(|(_, known)| *known == one).map_or("", |(name, _)| name)
}
