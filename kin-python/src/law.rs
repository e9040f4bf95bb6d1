//! Laws, made by the registry from what `kin.Law` says of them.

use kin::Axis;
use kin::data::{Datum, LawData};
use pyo3::prelude::*;

use crate::fault::{unreadable, value};
use crate::numbers::vec3;

/// A law.
#[pyclass(frozen, module = "kin._native")]
#[derive(Clone)]
pub struct Law(pub kin::Law);

#[pymethods]
impl Law {
    /// The law that this JSON says.
    #[new]
    fn new(json: &str) -> PyResult<Law> {
        let data: LawData = serde_json::from_str(json).map_err(|error| unreadable(&error))?;
        let law = kin::text::registry().law(&data).map_err(value)?;
        law.refusal().map_or(Ok(Law(law)), |why| Err(value(why)))
    }

    /// f, f′, f″ and f‴ at x.
    fn jet(&self, x: f64) -> [f64; 4] {
        self.0.jet(x)
    }

    /// The first and the last argument that the law is made for, and the kind of its course beyond
    /// them.
    fn range(&self) -> Option<(f64, f64, &'static str)> {
        let range = self.0.range()?;
        let beyond = if range.beyond == kin::law::Beyond::Line { "line" } else { "held" };
        Some((range.from, range.to, beyond))
    }

    fn description(&self) -> String {
        self.0.description().to_owned()
    }

    /// The law as JSON.
    fn json(&self) -> PyResult<String> {
        Ok(self.0.to_value().map_err(value)?.to_string())
    }
}

/// The nine numbers of an axis along h, with f of Kin's choice where none is given.
#[pyfunction]
#[pyo3(signature = (h, f = None))]
pub fn axis(h: [f64; 3], f: Option<[f64; 3]>) -> [[f64; 3]; 3] {
    let Axis { h, f, g } = match f {
        Some(f) => Axis::new(vec3(h), vec3(f)),
        None => Axis::along(vec3(h)),
    };
    [h, f, g].map(|v| v.to_array())
}

/// Euler parameters of a frame with its x-axis along the h of an axis, its y-axis along f.
#[pyfunction]
pub fn euler_facing(axis: [[f64; 3]; 3]) -> [f64; 4] {
    let [h, f, g] = axis.map(vec3);
    let axis = Axis { h, f, g };
    let p = kin::SpatialPose::facing(vec3([0.0; 3]), axis).p;
    [p.e0, p.e1, p.e2, p.e3]
}

/// Euler parameters of a turn by an angle about an axis through the origin.
#[pyfunction]
pub fn euler_turned(axis: [f64; 3], angle: f64) -> [f64; 4] {
    let p = kin::SpatialPose::turned(vec3([0.0; 3]), vec3(axis), angle).p;
    [p.e0, p.e1, p.e2, p.e3]
}
