//! Finds the failed expression on the dual route: runs the user's function with numbers that record
//! where they failed.

use super::{Asked, Blame, Input, Part, Source};
use crate::model::constraint::Constraint;
use crate::model::dual_route::Equation;
use crate::numbers::real::{Fault, Real, TIME, Traced, fault_of};

/// An expression of the user's program: its text, line and column, both counted from 1.
pub type Expression = (&'static str, u32, u32);

/// The expressions of a function that runs on dual numbers, and the file that contains the
/// function.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// The file that contains the expressions.
    pub file: &'static str,
    /// The expressions, by their indices.
    pub expressions: &'static [Expression],
}

/// Returns the expression that made a term of an equation not finite.
pub fn blame<E: Equation<N, M>, const N: usize, const M: usize>(
    equation: &E,
    asked: &Asked<'_>,
    body: Body,
) -> Option<Blame> {
    let part = asked.term.part() as usize;
    asked.directions().into_iter().find_map(|direction| {
        let fault = fault_of(part, || {
            let rate = |k: usize| direction.columns.get(k).copied().flatten();
            let value = |k: usize| asked.q.get(k).copied().unwrap_or(f64::NAN);
            let seeded = std::array::from_fn(|k| Real(Traced::input(value(k), rate(k), k as u32)));
            let t = Real(Traced::input(asked.t, direction.time, TIME));
            equation.evaluate(&seeded, t).get(asked.row).map(|row| row.0)
        });
        fault.map(|fault| blame_of(equation, &fault, body, N))
    })
}

fn blame_of(constraint: &dyn Constraint, fault: &Fault, body: Body, columns: usize) -> Blame {
    let expression = fault.expression.and_then(|k| body.expressions.get(k));
    let behind = |bit: u32| fault.inputs & (1 << bit) != 0;
    let coordinates = (0..columns).filter(|&k| behind((k as u32).min(TIME))).map(Input::Column);
    let time = behind(TIME).then_some(Input::Time);
    Blame {
        expression: expression
            .map_or(constraint.facts().kind, |expression| expression.0)
            .to_string(),
        source: expression.map(|&(_, line, column)| Source { file: body.file, line, column }),
        part: [Part::Value, Part::Slope, Part::Curvature][fault.part.min(2)],
        value: fault.value,
        operands: fault.operands.into_iter().flatten().collect(),
        inputs: coordinates.chain(time).collect(),
    }
}
