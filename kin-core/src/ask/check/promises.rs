//! Compares the promises of a constraint about its terms with the values of the terms.

use nalgebra::DMatrix;

use super::{Disagreement, ROUTES_TOLERANCE, column, distance};
use crate::model::dual_route::Equation;
use crate::model::terms::{Terms, dual_terms};

/// Returns the terms that violate [`Facts::dependence`](crate::constraint::Facts::dependence),
/// `constants` or `sides_of_time`, with their differences.
pub(super) fn broken<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
    equation: &E,
    q: &[f64; N],
    qd: &[f64; N],
    t: f64,
    now: &Terms,
) -> Vec<Disagreement> {
    let facts = equation.facts();
    let depends = facts.dependence;
    let later = dual_terms::<E, N, M>(equation, q, qd, t + 1.0);
    let mut all = Vec::new();
    let mut promise = |name: &str, may: bool, promised: &DMatrix<f64>, found: &DMatrix<f64>| {
        let difference = distance(promised, found) / (1.0 + found.amax());
        if !may && difference > ROUTES_TOLERANCE {
            all.push(Disagreement {
                name: name.to_owned(),
                own: promised.amax(),
                dual: found.amax(),
                central: None,
                difference,
            });
        }
    };
    let zero = DMatrix::zeros(M, 1);
    promise("C, promised not to change with t", depends.c_on_t, &column(&now.c), &column(&later.c));
    promise("C_q, promised not to change with t", depends.c_q_on_t, &now.c_q, &later.c_q);
    promise("C_t, promised to be zero", depends.c_t, &zero, &column(&now.c_t));
    promise("Q_d, promised to be zero", depends.q_d, &zero, &column(&now.q_d));
    let origin = dual_terms::<E, N, M>(equation, &[0.0; N], qd, t);
    let linear = column(&origin.c) + &now.c_q * DMatrix::from_column_slice(N, 1, q);
    promise("C, promised to be linear", depends.curved, &linear, &column(&now.c));
    let told = facts.sides_of_time.map(|first| {
        let mut timed = vec![f64::INFINITY; facts.n_timed];
        equation.at_time(t, &mut timed);
        timed
            .get(first..first.saturating_add(3 * M))
            .map_or(DMatrix::from_element(M, 3, f64::INFINITY), |sides| {
                DMatrix::from_column_slice(M, 3, sides)
            })
    });
    if let Some(told) = told {
        let sides = DMatrix::from_columns(&[origin.c.clone(), -&now.c_t, -&now.c_tt]);
        promise("C(0, t), -C_t and -C_tt, given the numbers of the time", false, &told, &sides);
    }
    for (entry, constant) in facts.pattern.iter().zip(facts.constants) {
        let Some(constant) = *constant else { continue };
        let promised = DMatrix::from_element(1, 1, constant);
        let found = DMatrix::from_element(1, 1, now.c_q[(entry.row, entry.column)]);
        promise("an entry of C_q, promised to be constant", false, &promised, &found);
    }
    all
}
