//! The entries on which routes to a derivative do not agree, as a table to read.

use std::fmt;

use crate::model::constraint::Route;

/// Lines of a table that are shown at most.
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
    /// The entries that differ, the largest difference first.
    pub entries: Vec<Disagreement>,
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
pub struct Disagreement {
    /// Name of the number, such as `C_q[x, crank.theta]`.
    pub name: String,
    /// Its value by the constraint itself.
    pub own: f64,
    /// Its value by dual numbers.
    pub dual: f64,
    /// Its value by central differences, for C, C_q, C_t and Q_d.
    pub central: Option<f64>,
    /// The difference between the first two, relative to 1 + the largest entry of the term.
    pub difference: f64,
}

impl Disagreement {
    pub(crate) fn worst(&self) -> f64 {
        let central = self.central.map_or(0.0, |c| (self.own - c).abs() / (1.0 + c.abs()));
        let worst = self.difference.max(central);
        if worst.is_nan() { f64::INFINITY } else { worst }
    }
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "`{}`: its {} route, dual numbers and central differences do not agree at {}:",
            self.kind, self.route, self.place
        )?;
        let width = self
            .entries
            .iter()
            .take(SHOWN)
            .map(|entry| entry.name.chars().count())
            .max()
            .unwrap_or(0)
            .max(5);
        writeln!(
            f,
            "  {:width$}  {:>22}  {:>22}  {:>14}  {:>10}",
            "entry",
            self.route.to_string(),
            "dual",
            "central",
            "difference"
        )?;
        for entry in self.entries.iter().take(SHOWN) {
            let central = entry.central.map_or("-".to_owned(), |c| format!("{c:.7e}"));
            writeln!(
                f,
                "  {:width$}  {:22.14e}  {:22.14e}  {central:>14}  {:10.1e}",
                entry.name,
                entry.own,
                entry.dual,
                entry.worst()
            )?;
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
