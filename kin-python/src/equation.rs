//! Equations from text, and constraints that are not in a mechanism yet.

use kin::Constraint;
use kin::extend::dual_route::ArgumentKind;
use pyo3::prelude::*;

use crate::numbers;

/// An equation that was read.
#[pyclass(frozen, module = "kin._native")]
#[derive(Clone)]
pub struct Equation(pub kin::text::Equation);

/// The mistakes of a text: message, line, column, excerpt.
type Mistakes = Vec<(String, usize, usize, String)>;

#[pymethods]
impl Equation {
    /// Reads a text; gives the equation, or its mistakes.
    #[staticmethod]
    fn read(py: Python<'_>, text: &str) -> (Option<Equation>, Mistakes) {
        match py.detach(|| kin::text::Equation::read(text)) {
            Ok(equation) => (Some(Equation(equation)), vec![]),
            Err(mistakes) => {
                let told = mistakes
                    .0
                    .into_iter()
                    .map(|one| (one.message, one.line, one.column, one.excerpt));
                (None, told.collect())
            }
        }
    }

    fn name(&self) -> &str {
        self.0.name()
    }

    fn text(&self) -> &str {
        self.0.text()
    }

    /// Kinds of its bodies and coordinates in order.
    fn kinds(&self) -> Vec<&'static str> {
        let name = |kind| match kind {
            ArgumentKind::Planar => "planar",
            ArgumentKind::Spatial => "spatial",
            ArgumentKind::Coord => "coord",
        };
        self.0.arguments().into_iter().map(name).collect()
    }
}

/// The value of a parameter: a law as JSON, or numbers in order.
#[derive(FromPyObject)]
pub enum Given {
    Law(String),
    Numbers(Vec<Number>),
}

/// A number, or an expression of dimensions.
#[derive(FromPyObject)]
pub enum Number {
    Plain(f64),
    Expression(String),
}

/// Every term of a constraint: C, C_q row by row, C_t, Q_d.
pub type Terms<'py> = (Vec<f64>, Vec<Vec<f64>>, Vec<f64>, Vec<f64>);

/// The terms of a constraint where its own coordinates, their rates and the time are these.
pub fn terms<'py>(
    constraint: &dyn Constraint,
    q: &[u8],
    qd: &[u8],
    t: f64,
) -> PyResult<Terms<'py>> {
    let terms = kin::extend::terms(constraint, &numbers::read(q)?, &numbers::read(qd)?, t);
    let rows = terms.c_q.row_iter().map(|row| row.iter().copied().collect()).collect();
    let list = |v: &[f64]| v.to_vec();
    Ok((list(terms.c.as_slice()), rows, list(terms.c_t.as_slice()), list(terms.q_d.as_slice())))
}
