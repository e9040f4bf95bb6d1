//! Culprits where a term of a constraint is infinite or not a number: the sub-expression as the
//! user wrote it, its place, and the values that went into it. Looked for when a run has failed and
//! never before, so that kernels pay nothing for it.
//!
//! On the symbolic route the equation is kept as a formula (`formula.rs`) and evaluated with
//! second-order jets; on the dual route the user's body runs once more with numbers that know where
//! they went wrong (`trace.rs`).

mod culprit;
mod interpret;
pub(crate) mod jet;
pub(crate) mod trace;

pub use culprit::{Culprit, Found, Part, Source};

/// The terms of a constraint that can fail to be finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Term {
    /// C
    Residual,
    /// C_q
    Jacobian,
    /// C_t
    ByTime,
    /// Q_d
    RightSide,
}

/// A question to a constraint: why is a term of one of its rows not finite at an instant?
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// Time t.   \[s\]
    pub t: f64,
    /// Its local coordinates, one a column.
    pub q: &'a [f64],
    /// Their rates, for [`Term::RightSide`].
    pub qd: &'a [f64],
    /// The local row.
    pub row: usize,
    /// The term that is not finite.
    pub term: Term,
    /// For each local column whether a coordinate stands behind it; false for those of the ground.
    pub moves: &'a [bool],
}

/// A value that an expression is computed from.
#[derive(Clone, Debug, PartialEq)]
pub enum Input {
    /// The coordinate of a local column.
    Column(usize),
    /// A parameter, by its name in the constraint.
    Parameter(String, f64),
    /// The time t.
    Time,
}

/// A constraint's answer: the first expression that is not finite though everything it is made of
/// is.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Blame {
    /// The expression as the user wrote it.
    pub expression: String,
    /// Where it stands.
    pub source: Option<Source>,
    /// The part of the expression that is not finite.
    pub part: Part,
    /// Its value, which is finite where only a derivative is not.
    pub value: f64,
    /// The numbers it is computed from directly.
    pub operands: Vec<f64>,
    /// The coordinates and parameters behind these.
    pub inputs: Vec<Input>,
}

impl Term {
    /// The term of that name in errors: `C`, `C_q`, `C_t` or `Q_d`.
    pub(crate) fn named(name: &str) -> Option<Term> {
        Some(match name {
            "C" => Term::Residual,
            "C_q" => Term::Jacobian,
            "C_t" => Term::ByTime,
            "Q_d" => Term::RightSide,
            _ => return None,
        })
    }

    /// The part of an expression that the term needs, beside those before it.
    fn part(self) -> Part {
        match self {
            Term::Residual => Part::Value,
            Term::Jacobian | Term::ByTime => Part::Slope,
            Term::RightSide => Part::Curvature,
        }
    }
}

/// A direction in which derivatives are taken, by local columns; `None` where nothing moves at all.
#[derive(Clone, Debug)]
pub(crate) struct Direction {
    columns: Vec<Option<f64>>,
    time: Option<f64>,
}

impl Asked<'_> {
    /// The directions to look into: that of each coordinate for C_q, that of t for C_t, the motion
    /// for Q_d; for C any that takes in all.
    fn directions(&self) -> Vec<Direction> {
        let n = self.moves.len();
        match self.term {
            Term::Residual => vec![Direction { columns: vec![Some(1.0); n], time: Some(1.0) }],
            Term::ByTime => vec![Direction { columns: vec![None; n], time: Some(1.0) }],
            Term::RightSide => {
                let rate = |column: usize| {
                    self.moves[column].then(|| self.qd.get(column).copied().unwrap_or_default())
                };
                vec![Direction { columns: (0..n).map(rate).collect(), time: Some(1.0) }]
            }
            Term::Jacobian => {
                let along = |column: usize| Direction {
                    columns: (0..n).map(|k| (k == column).then_some(1.0)).collect(),
                    time: None,
                };
                (0..n).filter(|&column| self.moves[column]).map(along).collect()
            }
        }
    }
}
