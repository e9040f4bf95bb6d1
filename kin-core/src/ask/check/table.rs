//! The entries on which routes do not agree, as a table to read.

use std::fmt;

use nalgebra::DMatrix;

use super::{DIFFERENCES_TOLERANCE, ROUTES_TOLERANCE};
use crate::model::constraint::{Constraint, Route};
use crate::model::coordinates::Target;

/// So many lines of a table are shown.
const SHOWN: usize = 16;

/// The terms of a constraint on which its routes do not agree, at one state.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub struct Mismatch {
    /// Kind of the constraint.
    pub kind: String,
    /// The route it takes by itself.
    pub route: Route,
    /// Which state it is.
    pub place: String,
    /// What differs, the largest difference first.
    pub entries: Vec<Entry>,
    /// Local coordinates, with their names.
    pub q: Vec<(String, f64)>,
    /// Local rates.
    pub qd: Vec<f64>,
    /// Time.   \[s\]
    pub t: f64,
}

/// One number of a term, on all routes.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub struct Entry {
    /// Such as `C_q[x, crank.theta]`.
    pub name: String,
    /// By the constraint itself.
    pub own: f64,
    /// By dual numbers.
    pub dual: f64,
    /// By central differences, for C, C_q, C_t and Q_d.
    pub central: Option<f64>,
    /// The difference between the first two, relative to 1 + the largest entry of the term.
    pub difference: f64,
}

impl Mismatch {
    pub(super) fn new(constraint: &dyn Constraint, mut entries: Vec<Entry>, q: &[f64], qd: &[f64], t: f64) -> Self {
        entries.sort_by(|a, b| b.worst().total_cmp(&a.worst()));
        let q = columns(constraint).into_iter().zip(q.iter().copied()).collect();
        let (kind, route) = (constraint.kind().to_owned(), constraint.route());
        Mismatch { kind, route, place: "the state asked for".to_owned(), entries, q, qd: qd.to_vec(), t }
    }
}

impl Entry {
    fn worst(&self) -> f64 {
        let central = self.central.map_or(0.0, |c| (self.own - c).abs() / (1.0 + c.abs()));
        let worst = self.difference.max(central);
        if worst.is_nan() { f64::INFINITY } else { worst }
    }
}

/// The entries of one term that differ.
pub(super) fn entries(
    constraint: &dyn Constraint,
    term: &str,
    own: &DMatrix<f64>,
    dual: &DMatrix<f64>,
    central: Option<&DMatrix<f64>>,
    scale: f64,
) -> Vec<Entry> {
    let (rows, columns) = (constraint.rows(), columns(constraint));
    let mut all = Vec::new();
    for row in 0..own.nrows() {
        for column in 0..own.ncols() {
            let (a, b, c) = (own[(row, column)], dual[(row, column)], central.map(|c| c[(row, column)]));
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
            all.push(Entry { name, own: a, dual: b, central: c, difference });
        }
    }
    all
}

/// Names of the local columns, such as `crank.theta`.
fn columns(constraint: &dyn Constraint) -> Vec<String> {
    let of = |argument: &crate::model::coordinates::Argument| -> Vec<String> {
        let parts: &[&str] = match argument.target {
            Target::Planar(_) => &[".R_x", ".R_y", ".theta"],
            Target::Spatial(_) => &[".R_x", ".R_y", ".R_z", ".e0", ".e1", ".e2", ".e3"],
            Target::Coord(..) => &[""],
        };
        parts.iter().map(|part| format!("{}{part}", argument.name)).collect()
    };
    constraint.arguments().iter().flat_map(of).collect()
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "`{}`: its {} route, dual numbers and central differences do not agree at {}:", self.kind, self.route, self.place)?;
        let width = self.entries.iter().take(SHOWN).map(|entry| entry.name.chars().count()).max().unwrap_or(0).max(5);
        writeln!(f, "  {:width$}  {:>22}  {:>22}  {:>14}  {:>10}", "entry", self.route.to_string(), "dual", "central", "difference")?;
        for entry in self.entries.iter().take(SHOWN) {
            let central = entry.central.map_or("-".to_owned(), |c| format!("{c:.7e}"));
            writeln!(f, "  {:width$}  {:22.14e}  {:22.14e}  {central:>14}  {:10.1e}", entry.name, entry.own, entry.dual, entry.worst())?;
        }
        if self.entries.len() > SHOWN {
            writeln!(f, "  and {} more", self.entries.len() - SHOWN)?;
        }
        for (k, (name, q)) in self.q.iter().enumerate() {
            writeln!(f, "  {name} = {q}, rate {}", self.qd.get(k).copied().unwrap_or(0.0))?;
        }
        write!(
            f,
            "  t = {}\n  Derivatives are taken from one side at kinks: look at the state; or the equation reads what is no number of its arguments; \
             or report the constraint.",
            self.t
        )
    }
}

impl fmt::Debug for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for Mismatch {}
