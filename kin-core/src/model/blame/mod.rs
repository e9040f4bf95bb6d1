//! Finds the subexpression that makes a term of a constraint infinite or NaN, with its place and
//! the values of its operands.
//!
//! Kin searches only after a failure, so the search does not slow down compiled code.
//!
//! On the symbolic route Kin evaluates the formula of the equation (`formula.rs`) with second-order
//! jets. On the dual route Kin runs the user's function again with numbers that record where they
//! failed (`trace.rs`).

mod interpret;
pub(crate) mod jet;
pub(crate) mod trace;

pub use crate::outcome::culprit::{Culprit, Found, Part, Source};

/// The terms of a constraint that can be infinite or NaN.
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

/// The input of the search: a term of a row that is not finite at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// The time t. \[s\]
    pub t: f64,
    /// The local coordinates, one for each column.
    pub q: &'a [f64],
    /// The local velocities, for [`Term::RightSide`].
    pub qd: &'a [f64],
    /// The local row of the term.
    pub row: usize,
    /// The term that is not finite.
    pub term: Term,
    /// For each local column, true if the column belongs to a coordinate, and false if the column
    /// belongs to the ground.
    pub moves: &'a [bool],
}

/// An input of an expression.
#[derive(Clone, Debug, PartialEq)]
pub enum Input {
    /// The coordinate of a local column.
    Column(usize),
    /// A parameter, by its name in the constraint.
    Parameter(String, f64),
    /// The time t.
    Time,
}

/// The result of the search: the first expression that is not finite although all its operands are.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Blame {
    /// The expression as the user wrote it.
    pub expression: String,
    /// The place of the expression; `None` if it is unknown.
    pub source: Option<Source>,
    /// The part of the expression that is not finite.
    pub part: Part,
    /// The value of the expression. The value is finite if only a derivative is infinite or NaN.
    pub value: f64,
    /// The values of the direct operands.
    pub operands: Vec<f64>,
    /// The coordinates and parameters on which the operands depend.
    pub inputs: Vec<Input>,
}

impl Term {
    /// Returns the term with this name in errors: `C`, `C_q`, `C_t` or `Q_d`.
    pub(crate) fn named(name: &str) -> Option<Term> {
        Some(match name {
            "C" => Term::Residual,
            "C_q" => Term::Jacobian,
            "C_t" => Term::ByTime,
            "Q_d" => Term::RightSide,
            _ => return None,
        })
    }

    /// Returns the last part of an expression that the term needs.
    fn part(self) -> Part {
        match self {
            Term::Residual => Part::Value,
            Term::Jacobian | Term::ByTime => Part::Slope,
            Term::RightSide => Part::Curvature,
        }
    }
}

/// A direction of differentiation, by local columns; `None` if nothing moves.
#[derive(Clone, Debug)]
pub(crate) struct Direction {
    columns: Vec<Option<f64>>,
    time: Option<f64>,
}

impl Asked<'_> {
    /// Returns the directions to search: each coordinate for C_q, t for C_t, the motion for Q_d.
    /// For C any direction that includes everything suffices.
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
