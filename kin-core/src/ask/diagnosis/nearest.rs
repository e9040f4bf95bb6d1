//! Finds the pose at which the residuals of equations that cannot be satisfied are as small as the
//! other equations allow.

use crate::solve::assembly::levenberg_marquardt::LevenbergMarquardt;
use crate::system::scaled::{Measures, Model};

/// Returns the pose near the given one at which these rows have the smallest residuals that the
/// other active rows allow. First the weights of the rows decrease against the others. Then the
/// others are shifted by their remaining residuals until they are satisfied (method of multipliers;
/// J. Nocedal, S. J. Wright, Numerical Optimization, section 17.3). At the smallest gap the
/// equations that hold it open therefore depend on one another to at least half of the digits.
pub(super) fn nearest(
    model: &Model<'_>,
    measures: &Measures,
    from: &[f64],
    t: f64,
    active: &dyn Fn(usize) -> bool,
    rows: &[usize],
    steps: usize,
) -> Vec<f64> {
    /// The weights of the rows against the others, stage by stage, and the number of rounds of
    /// shifts after that. Each round gives about five digits. \[-\]
    const WEIGHTS: [f64; 3] = [3e-1, 3e-2, 3e-3];
    const ROUNDS: usize = 3;
    let mut q = from.to_vec();
    let mut minimiser = LevenbergMarquardt::new(*model, measures, Vec::new(), false);
    (0..model.m()).filter(|row| !active(*row)).for_each(|row| minimiser.weights[row] = 0.0);
    for round in 0..WEIGHTS.len() + ROUNDS {
        match WEIGHTS.get(round) {
            Some(weight) => rows.iter().for_each(|row| minimiser.weights[*row] = *weight),
            None => {
                let Ok(point) = model.linearize(&q, t) else { break };
                let others = (0..model.m()).filter(|row| !rows.contains(row));
                others.for_each(|row| minimiser.shifts[row] += point.c[row]);
            }
        }
        let Some(place) = minimiser.place(&q, t) else { break };
        q = minimiser.minimise(place, steps).q;
    }
    q
}
