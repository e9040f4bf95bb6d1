//! The step that serves wishes level by level: a later level moves only within the freedom that the
//! earlier ones leave.

use nalgebra::{DMatrix, DVector};

/// A direction in which the wishes of a level change less than this is free for the next one. \[-\]
const FREE: f64 = 1e-7;

/// A level whose linear model leaves more than this share of its residual cannot be met nearby: the
/// curvature counts then. \[-\]
const UNMET: f64 = 0.1;

/// The wishes of one level at a position, in units of their scales. The columns of `slopes` and
/// `bends` belong to the tangents.
pub(super) struct Level {
    /// The distances from the wishes: target − value.
    pub residual: DVector<f64>,
    /// The slopes of the values.
    pub slopes: DMatrix<f64>,
    /// The second derivatives of each value; empty if they are not known.
    pub bends: Vec<DMatrix<f64>>,
}

impl Level {
    /// Returns the distance from the wishes.
    pub(super) fn distance(&self) -> f64 {
        self.residual.norm()
    }
}

/// Returns the step of least length among the steps that serve the levels in order, and the
/// directions that no level determines, as orthonormal columns. `damping` shortens the step.
pub(super) fn step(
    levels: &[&Level],
    freedoms: usize,
    damping: f64,
) -> (DVector<f64>, DMatrix<f64>) {
    let mut y = DVector::zeros(freedoms);
    let mut free = DMatrix::identity(freedoms, freedoms);
    for (k, level) in levels.iter().enumerate() {
        if free.ncols() == 0 {
            break;
        }
        let within = Within { earlier: &levels[..k], y: &y, free: &free, damping };
        let Some((z, next)) = within.serve(level) else { break };
        y += &free * z;
        free = next;
    }
    (y, free)
}

/// The freedom that earlier levels leave to one level.
struct Within<'l> {
    earlier: &'l [&'l Level],
    /// The step of the earlier levels.
    y: &'l DVector<f64>,
    /// The directions that they leave free.
    free: &'l DMatrix<f64>,
    damping: f64,
}

impl Within<'_> {
    /// Returns the step of one level within the free directions, and the directions that remain.
    fn serve(&self, level: &Level) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let slopes = &level.slopes * self.free;
        let residual = &level.residual - &level.slopes * self.y;
        let columns = self.free.ncols();
        // With as many rows as columns the singular vectors are complete.
        let rows = slopes.nrows().max(columns);
        let padded = slopes.clone().resize(rows, columns, 0.0);
        let svd = padded.try_svd(true, true, f64::EPSILON, 1000)?;
        let u = svd.u?;
        let v = svd.v_t?.transpose();
        let sigma = svd.singular_values;
        let right = u.transpose() * residual.clone().resize_vertically(rows, 0.0);
        let moves = |k: usize| sigma[k] > FREE;
        let share =
            |k: usize| if moves(k) { sigma[k] / (sigma[k] * sigma[k] + self.damping) } else { 0.0 };
        let along = DVector::from_fn(columns, |k, _| share(k) * right[k]);
        let z = &v * along;
        let left = (&residual - &slopes * &z).norm();
        if !level.bends.is_empty() && left > UNMET * residual.norm() {
            return self.curved(level, &slopes, &residual);
        }
        Some((z, self.free * columns_of(&v, |k| !moves(k))))
    }

    /// Returns the step to the least sum of squares, with the second derivatives of the values, and
    /// the directions in which the sum does not change.
    fn curved(
        &self,
        level: &Level,
        slopes: &DMatrix<f64>,
        residual: &DVector<f64>,
    ) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let freedoms = self.y.len();
        let mut bent = DMatrix::zeros(freedoms, freedoms);
        for (bend, r) in level.bends.iter().zip(residual.iter()) {
            bent -= bend * *r;
        }
        // The values that earlier levels hold bend too, by their multipliers.
        let pull = level.slopes.transpose() * residual;
        for (bend, multiplier) in self.multipliers(&pull)? {
            bent += bend * multiplier;
        }
        let hessian = slopes.transpose() * slopes + self.free.transpose() * bent * self.free;
        let gradient = slopes.transpose() * residual;
        let eigen = hessian.try_symmetric_eigen(f64::EPSILON, 1000)?;
        let moves = |k: usize| eigen.eigenvalues[k].abs() > FREE;
        let along = eigen.eigenvectors.transpose() * gradient;
        let share = |k: usize| 1.0 / (eigen.eigenvalues[k].abs() + self.damping);
        // Towards a saddle or a maximum the step goes downhill.
        let of = |k: usize| if moves(k) { share(k) * along[k] } else { 0.0 };
        let z = &eigen.eigenvectors * DVector::from_fn(along.len(), |k, _| of(k));
        Some((z, self.free * columns_of(&eigen.eigenvectors, |k| !moves(k))))
    }

    /// Returns the curvature of each value of the earlier levels with its multiplier μ: Wᵀ μ =
    /// pull, with their slopes W.
    fn multipliers(&self, pull: &DVector<f64>) -> Option<Vec<(&DMatrix<f64>, f64)>> {
        let bends: Vec<&DMatrix<f64>> =
            self.earlier.iter().flat_map(|level| &level.bends).collect();
        let rows: usize = self.earlier.iter().map(|level| level.slopes.nrows()).sum();
        if bends.len() != rows || rows == 0 {
            return Some(Vec::new());
        }
        let mut slopes = DMatrix::zeros(rows, self.y.len());
        let mut first = 0;
        for level in self.earlier {
            let count = level.slopes.nrows();
            slopes.rows_mut(first, count).copy_from(&level.slopes);
            first += count;
        }
        let svd = slopes.transpose().try_svd(true, true, f64::EPSILON, 1000)?;
        let multipliers = svd.solve(pull, FREE).ok()?;
        Some(bends.into_iter().zip(multipliers.iter().copied()).collect())
    }
}

/// Returns the columns of a matrix that fulfil a condition.
fn columns_of(all: &DMatrix<f64>, is_kept: impl Fn(usize) -> bool) -> DMatrix<f64> {
    let columns: Vec<usize> = (0..all.ncols()).filter(|k| is_kept(*k)).collect();
    all.select_columns(&columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn level(residual: &[f64], slopes: &[f64]) -> Level {
        let rows = residual.len();
        Level {
            residual: DVector::from_column_slice(residual),
            slopes: DMatrix::from_row_slice(rows, slopes.len() / rows, slopes),
            bends: Vec::new(),
        }
    }

    /// The first level fixes the sum of two numbers, the second wants one of them elsewhere: both
    /// are served, and the third number is free.
    #[test]
    fn a_later_level_moves_what_the_earlier_ones_leave() {
        let levels = [level(&[1.0], &[1.0, 1.0, 0.0]), level(&[3.0], &[1.0, 0.0, 0.0])];
        let (y, free) = step(&[&levels[0], &levels[1]], 3, 0.0);
        let expected = DVector::from_column_slice(&[3.0, -2.0, 0.0]);
        assert!((y - expected).norm() < 1e-14);
        assert_eq!(free.shape(), (3, 1));
        assert!(free[(2, 0)].abs() > 1.0 - 1e-14);
    }

    /// A wish that contradicts an earlier one does nothing.
    #[test]
    fn a_contradiction_is_decided_by_the_order() {
        let (y, free) = step(&[&level(&[1.0], &[2.0]), &level(&[-5.0], &[1.0])], 1, 0.0);
        assert!((y[0] - 0.5).abs() < 1e-15 && free.ncols() == 0);
    }

    /// If many steps serve a wish, `step` returns the shortest one.
    #[test]
    fn the_step_is_the_shortest() {
        let (y, _) = step(&[&level(&[5.0], &[3.0, 4.0])], 2, 0.0);
        assert!((y - DVector::from_column_slice(&[0.6, 0.8])).norm() < 1e-14);
    }

    /// The nearest point of a circle to a place outside: with the curvature one step is as good as
    /// Newton's, without it the step of least squares is 3 times too long.
    #[test]
    fn curvature_counts_where_a_wish_cannot_be_met() {
        // The point (cos s, sin s) at s = 0.01 towards (3, 0).
        let (sin, cos) = 0.01_f64.sin_cos();
        let mut one = level(&[3.0 - cos, -sin], &[-sin, cos]);
        one.bends = vec![DMatrix::from_element(1, 1, -cos), DMatrix::from_element(1, 1, -sin)];
        let (y, free) = step(&[&one], 1, 0.0);
        assert!((y[0] + 0.01).abs() < 1e-6, "{y}");
        assert_eq!(free.ncols(), 0);
    }
}
