//! Pages on which a mechanism moves.

use kin_view::Scene;
use pyo3::prelude::*;

use crate::fault::{or_raise, wrong_type};
use crate::forces::Forces;
use crate::motion::{Motion, NOT_A_POINT, unknown};
use crate::numbers;
use crate::system::System;

/// A point whose path a page shows: its name, "planar" or "spatial", the body, the local position.
type Trace = (String, String, String, Vec<f64>);

/// A chart of a page: its title, its unit, and lists of numbers by name.
type Charted = (String, String, Vec<(String, Vec<f64>)>);

/// A page on which the mechanism moves, as HTML.
#[pyfunction]
pub fn page(
    py: Python<'_>,
    system: &System,
    motion: &Motion,
    title: Option<&str>,
    traces: Vec<Trace>,
    forces: Option<&Forces>,
    charts: Vec<Charted>,
) -> PyResult<String> {
    let system = system.now();
    let mut scene = Scene::new(&system);
    for (name, kind, body, local) in &traces {
        scene = match (kind.as_str(), &local[..]) {
            ("planar", &[x, y]) => {
                let body = motion.0.planar_named(body).ok_or_else(|| unknown(body))?;
                scene.trace(name, body, numbers::vec2([x, y]))
            }
            ("spatial", &[x, y, z]) => {
                let body = motion.0.spatial_named(body).ok_or_else(|| unknown(body))?;
                scene.trace(name, body, numbers::vec3([x, y, z]))
            }
            _ => return Err(wrong_type(NOT_A_POINT)),
        };
    }
    let forces = forces.map(Forces::forces);
    if let Some(forces) = forces {
        scene = scene.forces(forces);
    }
    let mut page = or_raise(py, scene.page(&motion.0))?;
    if let Some(title) = title {
        page = page.title(title);
    }
    for (title, unit, series) in charts {
        let series = series.iter().map(|(name, values)| (name.as_str(), values.clone()));
        page = page.values(&title, &unit, series);
    }
    if let Some(forces) = forces {
        page = page.forces(forces);
    }
    Ok(page.html())
}
