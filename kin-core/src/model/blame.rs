//! Who is to blame where something of a constraint is infinite or not a number: the sub-expression as the user wrote it, its place, and the
//! values that went into it. Looked for when a run has failed and never before, so that kernels pay nothing for it.
//!
//! On the symbolic route the equation is kept as a formula (`formula.rs`) and evaluated with second-order jets; on the dual
//! route the user's body runs once more with numbers that know where they went wrong (`trace.rs`).

mod interpret;
mod jet;
pub(crate) mod trace;

use std::fmt;

use crate::model::coordinates::Argument;
use crate::model::layout::{Layout, Place};
use crate::model::state::{At, Rates};
use crate::system::evaluate::Block;

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

/// Which of an expression's numbers is not finite, its value being looked at first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Part {
    /// The value itself.
    Value,
    /// A first derivative.
    Slope,
    /// A second derivative.
    Curvature,
}

/// What a constraint is asked for: why a term of one of its rows is not finite at an instant.
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input {
    /// The coordinate of a local column.
    Column(usize),
    /// A parameter, by its name in the constraint.
    Parameter(&'static str, f64),
    /// The time t.
    Time,
}

/// Where something stands in the user's program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Source {
    /// The file as the compiler was given it.
    pub file: &'static str,
    /// Line, counted from 1.
    pub line: u32,
    /// Column, counted from 1.
    pub column: u32,
}

/// What a constraint answers: the first expression that is not finite though everything it is made of is.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Blame {
    /// The expression as the user wrote it.
    pub expression: String,
    /// Where it stands.
    pub source: Option<Source>,
    /// What of it is not finite.
    pub part: Part,
    /// Its value, which is finite where only a derivative is not.
    pub value: f64,
    /// The numbers it is computed from directly.
    pub operands: Vec<f64>,
    /// The coordinates and parameters behind these.
    pub inputs: Vec<Input>,
}

/// The expression that is to blame, in the names of the mechanism: what an error tells.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Culprit {
    /// The expression with its place and its part; `None` where only the constraint is known.
    pub found: Option<Found>,
    /// The coordinates (`slider.R_x`), parameters (`slot.k`) and the time (`t`) that it is computed from; where the expression is not known,
    /// all of the constraint's coordinates.
    pub inputs: Vec<(String, f64)>,
}

/// The expression that is to blame.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Found {
    /// The expression as the user wrote it.
    pub expression: String,
    /// Where it stands.
    pub source: Option<Source>,
    /// What of it is not finite.
    pub part: Part,
    /// Its value, which is finite where only a derivative is not.
    pub value: f64,
    /// The numbers it is computed from directly.
    pub operands: Vec<f64>,
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
    /// The directions to look into: that of each coordinate for C_q, that of t for C_t, the motion for Q_d; for C any that takes in all.
    fn directions(&self) -> Vec<Direction> {
        let n = self.moves.len();
        match self.term {
            Term::Residual => vec![Direction { columns: vec![Some(1.0); n], time: Some(1.0) }],
            Term::ByTime => vec![Direction { columns: vec![None; n], time: Some(1.0) }],
            Term::RightSide => {
                let rate = |column: usize| self.moves[column].then(|| self.qd.get(column).copied().unwrap_or_default());
                vec![Direction { columns: (0..n).map(rate).collect(), time: Some(1.0) }]
            }
            Term::Jacobian => {
                let along = |column: usize| Direction { columns: (0..n).map(|k| (k == column).then_some(1.0)).collect(), time: None };
                (0..n).filter(|&column| self.moves[column]).map(along).collect()
            }
        }
    }
}

impl Culprit {
    /// Asks a constraint of a system why a term of its local row `row` is not finite.
    pub(crate) fn of(block: &Block, layout: &Layout, at: At<'_>, rates: Rates<'_>, row: usize, term: Option<Term>) -> Culprit {
        let arguments = block.constraint.arguments();
        let columns: Vec<Option<usize>> = arguments.iter().flat_map(|argument| columns(argument, layout)).collect();
        let moves: Vec<bool> = columns.iter().map(Option::is_some).collect();
        let counts = || arguments.iter().map(|argument| argument.target.columns()).enumerate();
        let q: Vec<f64> = counts().flat_map(|(k, n)| at.coordinates(k, n)).copied().collect();
        let qd: Vec<f64> = counts().flat_map(|(k, n)| rates.columns(k, n)).copied().collect();
        let asked = |term| Asked { t: at.t, q: &q, qd: &qd, row, term, moves: &moves };
        let blame = term.and_then(|term| block.constraint.blame(&asked(term)));
        let coordinate = |column: usize| Some((layout.names.get((*columns.get(column)?)?)?.clone(), *q.get(column)?));
        let Some(blame) = blame else {
            return Culprit { found: None, inputs: (0..columns.len()).filter_map(coordinate).collect() };
        };
        let named = |input: &Input| match *input {
            Input::Column(column) => coordinate(column),
            Input::Parameter(name, value) => Some((format!("{}.{name}", block.name), value)),
            Input::Time => Some(("t".to_string(), at.t)),
        };
        let inputs = blame.inputs.iter().filter_map(named).collect();
        let Blame { expression, source, part, value, operands, .. } = blame;
        Culprit { found: Some(Found { expression, source, part, value, operands }), inputs }
    }
}

/// The coordinates of a mechanism behind an argument's columns; `None` on the ground.
pub(crate) fn columns(argument: &Argument, layout: &Layout) -> Vec<Option<usize>> {
    let first = match layout.place(&argument.target) {
        Some(Place::Own { first, .. }) => Some(first),
        _ => None,
    };
    (0..argument.target.columns()).map(|k| first.map(|first| first + k)).collect()
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file, self.line, self.column)
    }
}

/// The end of a sentence that has said what is not finite: why, where, with which values, and what to do.
impl fmt::Display for Culprit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let values = list(self.inputs.iter().map(|(name, value)| format!("{name} = {}", short(*value))).collect());
        let Some(found) = &self.found else {
            return if values.is_empty() { f.write_str(".") } else { write!(f, ", at {values}.") };
        };
        let operands = match &found.operands[..] {
            [] => String::new(),
            [one] => format!(" (operand {})", short(*one)),
            all => format!(" (operands {})", list(all.iter().map(|x| short(*x)).collect())),
        };
        let expression = &found.expression;
        match found.part {
            Part::Value if found.value.is_nan() => write!(f, ": `{expression}` is not a number{operands}.")?,
            Part::Value => write!(f, ": `{expression}` is {}{operands}.", short(found.value))?,
            Part::Slope => write!(f, ": `{expression}` has no finite slope{operands}.")?,
            Part::Curvature => write!(f, ": `{expression}` has no finite second derivative{operands}.")?,
        }
        let place = found.source.map(|source| source.to_string());
        let told: Vec<String> = place.into_iter().chain((!values.is_empty()).then(|| format!("at {values}"))).collect();
        if !told.is_empty() {
            write!(f, "\n  {}.", told.join(", "))?;
        }
        f.write_str(match found.part {
            Part::Value => "\n  Begin at another pose, change the parameters, or write `if` around it.",
            _ => "\n  Stay clear of that pose, or write the equation without this edge: d·d - l*l instead of d.norm() - l.",
        })
    }
}

/// A number to nine digits.
fn short(x: f64) -> String {
    if x.is_infinite() {
        return if x > 0.0 { "infinite" } else { "minus infinite" }.to_string();
    }
    crate::model::error::text::time(x).to_string()
}

/// "a, b and c"; of very many the first ones.
fn list(mut all: Vec<String>) -> String {
    const SHOWN: usize = 12;
    let more = all.len().saturating_sub(SHOWN);
    all.truncate(SHOWN);
    if more > 0 {
        return format!("{} and {more} more", all.join(", "));
    }
    match all.pop() {
        Some(last) if !all.is_empty() => format!("{} and {last}", all.join(", ")),
        last => last.unwrap_or_default(),
    }
}
