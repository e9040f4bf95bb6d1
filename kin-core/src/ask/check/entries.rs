//! The entries on which routes disagree.

use nalgebra::DMatrix;

use super::{DIFFERENCES_TOLERANCE, ROUTES_TOLERANCE};
use crate::coordinates::Target;
use crate::model::constraint::Constraint;
use crate::outcome::mismatch::{Disagreement, Mismatch};

impl Mismatch {
    pub(super) fn new(
        constraint: &dyn Constraint,
        mut entries: Vec<Disagreement>,
        q: &[f64],
        qd: &[f64],
        t: f64,
    ) -> Self {
        entries.sort_by(|a, b| b.worst().total_cmp(&a.worst()));
        let q = columns(constraint).into_iter().zip(q.iter().copied()).collect();
        let kind = constraint.facts().kind.to_owned();
        let route = constraint.facts().route();
        Mismatch {
            kind,
            route,
            place: "the requested state".to_owned(),
            entries,
            q,
            qd: qd.to_vec(),
            t,
        }
    }
}

/// Returns the entries of one term that differ.
pub(super) fn differing(
    constraint: &dyn Constraint,
    term: &str,
    own: &DMatrix<f64>,
    dual: &DMatrix<f64>,
    central: Option<&DMatrix<f64>>,
    scale: f64,
) -> Vec<Disagreement> {
    let rows = constraint.facts().rows;
    let columns = columns(constraint);
    let mut all = Vec::new();
    for row in 0..own.nrows() {
        for column in 0..own.ncols() {
            let a = own[(row, column)];
            let b = dual[(row, column)];
            let c = central.map(|c| c[(row, column)]);
            let difference = (a - b).abs() / scale;
            let apart = c.map_or(0.0, |c| (a - c).abs() / scale);
            if difference <= ROUTES_TOLERANCE && apart <= DIFFERENCES_TOLERANCE {
                continue;
            }
            let row = rows.get(row).copied().unwrap_or_default();
            let name = match term {
                "C_q" => format!("C_q[{row}, {}]", columns.get(column).map_or("", String::as_str)),
                term => format!("{term}[{row}]"),
            };
            all.push(Disagreement { name, own: a, dual: b, central: c, difference });
        }
    }
    all
}

/// Returns the names of the local columns, such as `crank.theta`.
fn columns(constraint: &dyn Constraint) -> Vec<String> {
    let of = |argument: &crate::coordinates::Argument| -> Vec<String> {
        let parts: &[&str] = match argument.target {
            Target::Planar(_) => &[".R_x", ".R_y", ".theta"],
            Target::Spatial(_) => &[".R_x", ".R_y", ".R_z", ".e0", ".e1", ".e2", ".e3"],
            Target::Coord(..) => &[""],
        };
        parts.iter().map(|part| format!("{}{part}", argument.name)).collect()
    };
    constraint.arguments().iter().flat_map(of).collect()
}
