//! Reports the rank of C_q, the free coordinates and the dependent equations, after a solver found
//! no pivot.

use crate::linear::{Echelon, RANK};
use crate::system::scaled::{Measures, Model};

/// Rank and dependencies of a singular matrix.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Singular {
    /// The number of independent rows; n if the matrix is singular only within rounding.
    pub rank: usize,
    /// The largest pivot that counted as zero, in scaled rows and columns. \[-\]
    pub pivot: f64,
    /// Bodies and scalar coordinates that move in the null space.
    pub movable: Vec<String>,
    /// Equations in a vanishing combination.
    pub dependent: Vec<String>,
}

/// A component of a null vector below this share is rounding. \[-\]
const SHARE: f64 = 1e-6;

/// Reports on C_q at a pose, from its values there.
pub(crate) fn singular(model: &Model<'_>, values: &[f64], measures: &Measures) -> Singular {
    singular_within(model, values, measures, RANK)
}

/// Reports on C_q with pivots below `least` counted as zero, for a position that is known with that
/// error.
pub(crate) fn singular_within(
    model: &Model<'_>,
    values: &[f64],
    measures: &Measures,
    least: f64,
) -> Singular {
    let n = model.n();
    let found = Echelon::of_rank_at_most(
        model.scaled(values, measures, &|_| true),
        n,
        least,
        n.saturating_sub(1),
    );
    let shared = |space: Vec<Vec<(usize, f64)>>| {
        let mut all: Vec<usize> = Vec::new();
        for vector in space {
            let largest = vector.iter().fold(0.0_f64, |m, (_, x)| m.max(x.abs()));
            all.extend(vector.iter().filter(|(_, x)| x.abs() > SHARE * largest).map(|(k, _)| *k));
        }
        all.sort_unstable();
        all.dedup();
        all
    };
    let owner = |k: usize| Some(model.layout.owner(k)?.name.clone());
    let mut movable: Vec<String> =
        shared(found.null_space()).into_iter().filter_map(owner).collect();
    movable.dedup();
    let dependent = shared(found.left_null_space())
        .into_iter()
        .map(|row| model.equations.equation(row))
        .collect();
    let rank = if found.left > least && found.rank() + 1 == n { n } else { found.rank() };
    Singular { rank, pivot: found.left, movable, dependent }
}
