//! Lists the entries on which the routes to a derivative disagree, as a table.

use std::fmt;

/// The largest number of lines in a table.
const SHOWN: usize = 16;

/// The way to obtain the derivatives of a constraint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Route {
    /// `#[constraint]` differentiates the equation at compile time to straight-line code.
    Symbolic,
    /// Kin evaluates the user's equation with dual numbers.
    Dual,
    /// The program computes the derivatives by hand-written code: an `impl Constraint` without the
    /// macro.
    Hand,
}

impl fmt::Display for Route {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Route::Symbolic => "symbolic",
            Route::Dual => "dual",
            Route::Hand => "hand-written",
        })
    }
}

/// The terms of a constraint on which its routes disagree, at one state.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub struct Mismatch {
    /// The kind of the constraint.
    pub kind: String,
    /// The route that the constraint takes by default.
    pub route: Route,
    /// A description of the state.
    pub place: String,
    /// The entries that differ, the largest difference first.
    pub entries: Vec<Disagreement>,
    /// The local coordinates, with their names.
    pub q: Vec<(String, f64)>,
    /// The local velocities.
    pub qd: Vec<f64>,
    /// The time. \[s\]
    pub t: f64,
}

/// One number of a term, computed by all routes.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub struct Disagreement {
    /// The name of the number, such as `C_q[x, crank.theta]`.
    pub name: String,
    /// The value from the route of the constraint.
    pub own: f64,
    /// The value from dual numbers.
    pub dual: f64,
    /// The value from central differences, for C, C_q, C_t and Q_d; `None` for other terms.
    pub central: Option<f64>,
    /// The difference of `own` and `dual`, relative to 1 + the largest entry of the term.
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
            "the derivatives of `{}` differ at {}. The columns are the {} derivatives, those by dual numbers and those by central differences:",
            self.kind, self.place, self.route
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
            writeln!(f, "  and {} more entries", self.entries.len() - SHOWN)?;
        }
        for (k, (name, q)) in self.q.iter().enumerate() {
            writeln!(f, "  {name} = {q}, velocity {}", self.qd.get(k).copied().unwrap_or(0.0))?;
        }
        write!(
            f,
            "  t = {}\n  At a kink, derivatives are one-sided, so choose another state. Otherwise correct the equation, which must depend only on the arguments of the constraint.",
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
