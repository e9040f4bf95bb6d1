//! Finds the expression that caused a value which is not finite, with the names of the mechanism.

use super::Block;
use crate::coordinates::layout::Layout;
use crate::model::blame::{Asked, Blame, Culprit, Found, Input, Term};
use crate::model::state::{At, Rates};

impl Culprit {
    /// Returns the reason why a term of local row `row` of a constraint is not finite.
    pub(crate) fn of(
        block: &Block,
        layout: &Layout,
        at: At<'_>,
        rates: Rates<'_>,
        row: usize,
        term: Option<Term>,
    ) -> Culprit {
        let arguments = block.constraint.arguments();
        let columns: Vec<Option<usize>> =
            arguments.iter().flat_map(|argument| layout.columns(argument)).collect();
        let moves: Vec<bool> = columns.iter().map(Option::is_some).collect();
        let counts = || arguments.iter().map(|argument| argument.target.columns()).enumerate();
        let q: Vec<f64> = counts().flat_map(|(k, n)| at.coordinates(k, n)).copied().collect();
        let qd: Vec<f64> = counts().flat_map(|(k, n)| rates.columns(k, n)).copied().collect();
        let asked = |term| Asked { t: at.t, q: &q, qd: &qd, row, term, moves: &moves };
        let blame = term.and_then(|term| block.constraint.blame(&asked(term)));
        let coordinate = |column: usize| {
            Some((layout.names.get((*columns.get(column)?)?)?.clone(), *q.get(column)?))
        };
        let Some(blame) = blame else {
            return Culprit {
                found: None,
                inputs: (0..columns.len()).filter_map(coordinate).collect(),
            };
        };
        let named = |input: &Input| match input {
            Input::Column(column) => coordinate(*column),
            Input::Parameter(name, value) => Some((format!("{}.{name}", block.name), *value)),
            Input::Time => Some(("t".to_string(), at.t)),
        };
        let inputs = blame.inputs.iter().filter_map(named).collect();
        let Blame { expression, source, part, value, operands, .. } = blame;
        let mut law = None;
        block.constraint.laws(&at, &mut |name, asked, x| {
            let is_it = operands[..] == [x] && expression.starts_with(&format!("{name}."));
            law = law.take().or_else(|| is_it.then(|| asked.kind().to_string()));
        });
        Culprit { found: Some(Found { expression, source, part, value, operands, law }), inputs }
    }
}
