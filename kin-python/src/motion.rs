//! The motion that a run has given.

use std::sync::Arc;

use kin::data::MotionData;
use kin::{Quantity, Series};
use kin_view::{Figure, Panel};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::fault::{or_raise, unreadable, wrong_type};
use crate::numbers;

/// A motion.
#[pyclass(frozen, module = "kin._native")]
pub struct Motion(pub Arc<kin::Motion>);

impl From<kin::Motion> for Motion {
    fn from(motion: kin::Motion) -> Self {
        Motion(Arc::new(motion))
    }
}

/// A number over time: name, unit, and up to four lists, the number and its rates.
pub type Orders<'py> = (String, String, Vec<Bound<'py, PyBytes>>);

/// A quantity with its rates, those that there are.
pub fn quantity<'py>(py: Python<'py>, quantity: &Quantity) -> PyResult<Orders<'py>> {
    let orders = [&quantity.value, &quantity.rate, &quantity.second_rate, &quantity.third_rate];
    let kept = orders.into_iter().filter(|series| !series.values().is_empty());
    let lists = kept.map(|series| numbers::list(py, series.values())).collect::<PyResult<_>>()?;
    Ok((quantity.value.name().to_owned(), quantity.value.unit().to_owned(), lists))
}

/// A number over time without rates.
pub fn series<'py>(py: Python<'py>, series: &Series) -> PyResult<Orders<'py>> {
    let lists = vec![numbers::list(py, series.values())?];
    Ok((series.name().to_owned(), series.unit().to_owned(), lists))
}

#[pymethods]
impl Motion {
    #[staticmethod]
    fn from_json(py: Python<'_>, text: &str) -> PyResult<Motion> {
        or_raise(py, MotionData::read(text).and_then(|data| kin::Motion::from_data(&data))).map(Motion::from)
    }

    fn to_json(&self) -> PyResult<String> {
        serde_json::to_string(&self.0.data()).map_err(|error| unreadable(&error))
    }

    fn write_json(&self, py: Python<'_>, path: &str) -> PyResult<()> {
        or_raise(py, self.0.write_json(path))
    }

    fn write_csv(&self, py: Python<'_>, path: &str) -> PyResult<()> {
        or_raise(py, self.0.write_csv(path))
    }

    fn name(&self) -> &str {
        self.0.name()
    }

    fn names(&self) -> Vec<String> {
        self.0.names().to_vec()
    }

    fn units(&self) -> Vec<String> {
        self.0.units()
    }

    fn unit_words(&self) -> (String, String) {
        let words = self.0.unit_words();
        (words.length().to_owned(), words.time().to_owned())
    }

    fn len(&self) -> usize {
        self.0.len()
    }

    fn times<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        numbers::list(py, self.0.times())
    }

    /// q (0), q̇ (1), q̈ (2) or q⃛ (3) of all times, row by row.
    fn rows<'py>(&self, py: Python<'py>, order: usize) -> PyResult<Bound<'py, PyBytes>> {
        let motion = &self.0;
        let row = |k| match order {
            0 => motion.q(k),
            1 => motion.qd(k),
            2 => motion.qdd(k),
            _ => motion.qddd(k),
        };
        let count = (0..motion.len()).map(|k| row(k).len()).sum();
        numbers::written(py, count, (0..motion.len()).map(row))
    }

    fn has_jerk(&self) -> bool {
        self.0.has_jerk()
    }

    fn iterations(&self) -> Vec<usize> {
        self.0.iterations().to_vec()
    }

    fn residuals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        numbers::list(py, self.0.residuals())
    }

    fn summary(&self) -> String {
        self.0.summary()
    }

    /// How many times a program has computed, and how often it has handed back.
    fn engine(&self) -> (usize, usize) {
        (self.0.engine().compiled, self.0.engine().handed_back)
    }

    /// Each event: time, kind, name, sentence.
    fn events(&self) -> Vec<(f64, String, String, String)> {
        let events = self.0.events().iter();
        events
            .map(|event| (event.t, event.kind.to_string(), event.name.clone(), event.text.clone()))
            .collect()
    }

    /// Singular positions as JSON.
    fn singular_positions(&self) -> PyResult<String> {
        serde_json::to_string(self.0.singular_positions()).map_err(|error| unreadable(&error))
    }

    /// A coordinate over time.
    fn named<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Orders<'py>> {
        quantity(py, &or_raise(py, self.0.named(name))?)
    }

    /// A chart of coordinates over time, as SVG.
    fn chart(&self, py: Python<'_>, title: &str, names: Vec<String>) -> PyResult<String> {
        let mut panel = Panel::over_time(title, "").in_units(self.0.unit_words());
        for name in &names {
            panel = panel.series(name, &or_raise(py, self.0.named(name))?.value);
        }
        Ok(Figure::new([panel]).svg())
    }

    /// r, v, a and the jerk (if there is one) of a point of a body, row by row.
    fn point<'py>(
        &self,
        py: Python<'py>,
        kind: &str,
        name: &str,
        local: Vec<f64>,
    ) -> PyResult<Vec<Bound<'py, PyBytes>>> {
        match (kind, &local[..]) {
            ("planar", &[x, y]) => {
                let body = self.0.planar_named(name).ok_or_else(|| unknown(name))?;
                let point = or_raise(py, self.0.point(body, numbers::vec2([x, y])))?;
                rows(py, [point.r(), point.v(), point.a(), point.jerk()], |v| v.to_array())
            }
            ("spatial", &[x, y, z]) => {
                let body = self.0.spatial_named(name).ok_or_else(|| unknown(name))?;
                let point = or_raise(py, self.0.point(body, numbers::vec3([x, y, z])))?;
                rows(py, [point.r(), point.v(), point.a(), point.jerk()], |v| v.to_array())
            }
            _ => Err(wrong_type("a point of a planar body has two numbers, of a spatial one three")),
        }
    }

    /// ω, α and (if there is a jerk) α̇ of a spatial body, global or in the body, row by row.
    fn rotation<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        in_body: bool,
    ) -> PyResult<Vec<Bound<'py, PyBytes>>> {
        let body = self.0.spatial_named(name).ok_or_else(|| unknown(name))?;
        let turn = or_raise(py, self.0.rotation(body))?;
        let turn = if in_body { turn.in_body() } else { turn };
        rows(py, [turn.omega(), turn.alpha(), turn.alpha_rate()], |v| v.to_array())
    }

    /// θ of one planar body less that of another, with its rates.
    fn relative_angle<'py>(&self, py: Python<'py>, a: &str, b: &str) -> PyResult<Orders<'py>> {
        let body = |name: &str| self.0.planar_named(name).ok_or_else(|| unknown(name));
        quantity(py, &or_raise(py, self.0.relative_angle(body(a)?, body(b)?))?)
    }

    fn transmission_angle<'py>(&self, py: Python<'py>, coupler: &str, driven: &str) -> PyResult<Orders<'py>> {
        let line = |name: &str| self.0.planar_named(name).ok_or_else(|| unknown(name));
        let along = kin::Vec2::x();
        let found = self.0.transmission_angle((line(coupler)?, along), (line(driven)?, along));
        quantity(py, &or_raise(py, found)?)
    }
}

fn unknown(name: &str) -> PyErr {
    wrong_type(format!("there is no body `{name}` of that kind in this motion"))
}

/// Lists of vectors, those that there are, component by component.
fn rows<'py, V: Copy, const N: usize, const M: usize>(
    py: Python<'py>,
    lists: [&[V]; M],
    components: impl Fn(V) -> [f64; N],
) -> PyResult<Vec<Bound<'py, PyBytes>>> {
    let kept = lists.into_iter().filter(|list| !list.is_empty());
    let bytes = kept.map(|list| {
        let flat: Vec<f64> = list.iter().flat_map(|v| components(*v)).collect();
        numbers::list(py, &flat)
    });
    bytes.collect()
}
