//! The motion that a run has given.

use std::sync::Arc;

use kin::data::MotionData;
use kin::results::{Quantity, Series};
use kin::{Ground, PlanarBody, SpatialBody};
use kin_view::{Figure, Panel};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::fault::{or_raise, unreadable, wrong_type};
use crate::numbers;
use crate::system::System;

/// A motion.
#[pyclass(frozen, module = "kin._native")]
pub struct Motion(pub Arc<kin::Motion>);

impl From<kin::Motion> for Motion {
    fn from(motion: kin::Motion) -> Self {
        Motion(Arc::new(motion))
    }
}

/// A list of a motion's numbers that NumPy reads where it lies: nothing is copied, and the array
/// keeps the motion.
#[pyclass(frozen, module = "kin._native")]
pub struct Rows {
    motion: Arc<kin::Motion>,
    which: usize,
}

/// True where the most significant byte of a number comes first.
const BIG: bool = cfg!(target_endian = "big");

#[pymethods]
impl Rows {
    /// NumPy's array interface, version 3: where the numbers begin, how many there are, that nobody
    /// may write there. The motion behind the `Arc` never changes, and NumPy keeps this object as
    /// long as the array.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let motion = &self.motion;
        let (numbers, columns) = match self.which {
            0 => (motion.q_rows(), motion.names().len()),
            1 => (motion.qd_rows(), motion.names().len()),
            2 => (motion.qdd_rows(), motion.names().len()),
            3 => (motion.qddd_rows(), motion.names().len()),
            _ => (motion.times(), 1),
        };
        let interface = PyDict::new(py);
        interface.set_item(intern!(py, "version"), 3)?;
        interface.set_item(
            intern!(py, "typestr"),
            if BIG { intern!(py, ">f8") } else { intern!(py, "<f8") },
        )?;
        interface.set_item(intern!(py, "shape"), (numbers.len() / columns.max(1), columns))?;
        interface.set_item(intern!(py, "data"), (numbers.as_ptr().addr(), true))?;
        Ok(interface)
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

/// A local position of the wrong length.
pub const NOT_A_POINT: &str = "a point of a planar body has two numbers, of a spatial one three";

#[pymethods]
impl Motion {
    #[staticmethod]
    fn from_json(py: Python<'_>, text: &str) -> PyResult<Motion> {
        or_raise(py, MotionData::read(text).and_then(|data| kin::Motion::from_data(&data)))
            .map(Motion::from)
    }

    /// A motion that was measured, or comes from elsewhere: q, q̇ and q̈ row by row.
    #[staticmethod]
    fn from_states(
        py: Python<'_>,
        system: &System,
        times: &[u8],
        states: [Vec<u8>; 3],
    ) -> PyResult<Motion> {
        let system = system.now();
        let times = numbers::read(times)?;
        let n = system.n_coordinates().max(1);
        let rows = |bytes: &Vec<u8>| {
            Ok::<_, PyErr>(numbers::read(bytes)?.chunks(n).map(<[f64]>::to_vec).collect::<Vec<_>>())
        };
        let [q, qd, qdd] = &states;
        let q = rows(q)?;
        let qd = rows(qd)?;
        let qdd = rows(qdd)?;
        or_raise(py, kin::Motion::from_states(&system, &times, &q, &qd, &qdd)).map(Motion::from)
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

    /// The times (4), and q (0), q̇ (1), q̈ (2) or q⃛ (3) of all of them row by row, where they
    /// lie.
    fn rows(&self, which: usize) -> Rows {
        Rows { motion: self.0.clone(), which }
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

    /// Why there was no program; name of the equation with the largest residual; the misfit of
    /// redundant equations.
    fn facts(&self) -> (Option<String>, Option<String>, f64) {
        let own = |text: Option<&str>| text.map(str::to_owned);
        (own(self.0.why_not_compiled()), own(self.0.worst()), self.0.misfit())
    }

    /// How far each body is at the first time from its guess: name, way, turn, hint.
    fn displaced(&self) -> Vec<Displacement> {
        self.0
            .displaced()
            .into_iter()
            .map(|one| (one.name, one.moved, one.turned, one.hint))
            .collect()
    }

    /// Breaks of laws that were crossed: times before and after, constraint, law; where in the law
    /// it is, which derivative jumps.
    fn breaks(&self) -> Vec<Crossed> {
        let crossed = |one: &kin::results::CrossedBreak| {
            (one.between, one.constraint.clone(), one.law.clone(), one.found.x, one.found.order)
        };
        self.0.breaks().iter().map(crossed).collect()
    }

    /// Each event: time, kind, name, sentence.
    fn events(&self) -> Vec<(f64, String, String, String)> {
        let events = self.0.events().iter();
        events
            .map(|event| (event.t, event.kind.to_string(), event.name.clone(), event.text.clone()))
            .collect()
    }

    /// Each warning: kind, names, sentences.
    fn warnings(&self) -> Vec<(String, Vec<String>, String)> {
        let all = self.0.warnings().iter();
        all.map(|one| (one.kind.to_string(), one.names.clone(), one.text.clone())).collect()
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
            _ => Err(wrong_type(NOT_A_POINT)),
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
    fn relative_angle<'py>(&self, py: Python<'py>, a: Planar, b: Planar) -> PyResult<Orders<'py>> {
        quantity(py, &or_raise(py, self.0.relative_angle(self.planar(a)?, self.planar(b)?))?)
    }

    /// The angle between two directions in planar bodies.
    fn transmission_angle<'py>(
        &self,
        py: Python<'py>,
        coupler: Line,
        driven: Line,
    ) -> PyResult<Orders<'py>> {
        let line = |(name, h): Line| Ok::<_, PyErr>((self.planar(name)?, numbers::vec2(h)));
        let found = self.0.transmission_angle(line(coupler)?, line(driven)?);
        quantity(py, &or_raise(py, found)?)
    }

    /// The instant centre of two planar bodies at each time, `None` where they do not turn against
    /// each other.
    fn instant_centre(
        &self,
        py: Python<'_>,
        a: Planar,
        b: Planar,
    ) -> PyResult<Vec<Option<[f64; 2]>>> {
        let found = or_raise(py, self.0.instant_centre(self.planar(a)?, self.planar(b)?))?;
        Ok(found.into_iter().map(|point| point.map(|v| v.to_array())).collect())
    }

    /// The distance of two points of bodies, of the plane or of space.
    fn distance<'py>(
        &self,
        py: Python<'py>,
        in_plane: bool,
        a: (Option<String>, Vec<f64>),
        b: (Option<String>, Vec<f64>),
    ) -> PyResult<Orders<'py>> {
        let (a, u, b, v) = (a.0, a.1, b.0, b.1);
        let found = match (in_plane, &u[..], &v[..]) {
            (true, &[ux, uy], &[vx, vy]) => {
                let u = numbers::vec2([ux, uy]);
                let v = numbers::vec2([vx, vy]);
                self.0.distance(self.planar(a)?, u, self.planar(b)?, v)
            }
            (false, &[ux, uy, uz], &[vx, vy, vz]) => {
                let u = numbers::vec3([ux, uy, uz]);
                let v = numbers::vec3([vx, vy, vz]);
                self.0.distance(self.spatial(a)?, u, self.spatial(b)?, v)
            }
            _ => {
                return Err(wrong_type(
                    "a point of a planar body has two numbers, of a spatial one three",
                ));
            }
        };
        quantity(py, &or_raise(py, found)?)
    }
}

/// A body: its name, how far it was moved and turned, a hint.
type Displacement = (String, Option<f64>, Option<f64>, Option<String>);

/// A break of a law: the times around it, its constraint, the law, the argument, the derivative
/// that jumps.
type Crossed = ((f64, f64), String, String, f64, usize);

/// Name of a planar body, none of the ground.
type Planar = Option<String>;

/// A planar body, and a direction in it.
type Line = (Planar, [f64; 2]);

impl Motion {
    fn planar(&self, name: Option<String>) -> PyResult<PlanarBody> {
        let find = |name: String| self.0.planar_named(&name).ok_or_else(|| unknown(&name));
        name.map_or(Ok(PlanarBody::from(Ground)), find)
    }

    fn spatial(&self, name: Option<String>) -> PyResult<SpatialBody> {
        let find = |name: String| self.0.spatial_named(&name).ok_or_else(|| unknown(&name));
        name.map_or(Ok(SpatialBody::from(Ground)), find)
    }
}

pub fn unknown(name: &str) -> PyErr {
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
