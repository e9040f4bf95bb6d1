//! Finds the singular position near a solution that rounding cannot distinguish from it.
//!
//! Where two solutions coincide, C = 0 is already satisfied within rounding when only half of the
//! digits of q are correct. So the rank can be full at the given pose although it is not full at
//! the solution.

use crate::linear::{Echelon, LeastSquares, Sparse, dense};
use crate::system::scaled::{Measures, Model, Point};

/// The residual of a row at the singular position, relative to its norm and its terms, that counts
/// as rounding in addition to the permitted closure error. \[-\]
const ROUNDING: f64 = 4e-15;

/// Pivots below this value are examined, or below 30 times the root of the permitted closure error:
/// a solution at the distance ε from a double one has a pivot of about √ε. \[-\]
const NEAR: f64 = 1e-5;

/// The largest number of null vectors of either side to examine.
const LOOKED_AT: usize = 8;

/// Returns the pose, or the singular pose of lower rank near it at which C = 0 holds too.
///
/// l and n are the nearly null vectors of C_q. The coordinates s with l · C_q(q + Σ s n) n = 0
/// follow from linear equations with the matrix l · (C_q n)_q n. Afterwards all other rows are
/// satisfied again.
pub(super) fn settled(model: &Model<'_>, q: Vec<f64>, t: f64, measures: &Measures) -> Vec<f64> {
    let tolerance = ROUNDING.max(model.misfit);
    let near = NEAR.max(30.0 * model.misfit.sqrt());
    let Ok(point) = model.linearize(&q, t) else { return q };
    let echelon = |point: &Point, least: f64| {
        Echelon::new(model.scaled(&point.values, measures, &|_| true), model.n(), least)
    };
    let found = echelon(&point, crate::linear::RANK);
    if found.smallest > near {
        return q;
    }
    let rank = found.rank();
    let mut here = q.clone();
    let mut at = point;
    for _ in 0..4 {
        let close = echelon(&at, near);
        let free = close.null_space();
        let dependent = close.left_null_space();
        if free.is_empty() || dependent.is_empty() || free.len().max(dependent.len()) > LOOKED_AT {
            return q;
        }
        let Some(moved) = onto(model, (&here, &at), t, measures, [&free, &dependent]) else {
            return q;
        };
        let Some((next, point)) = met_again(model, moved, t, measures, near) else { return q };
        (here, at) = (next, point);
    }
    let mut allowed: Vec<f64> = measures.norms.iter().map(|norm| tolerance * norm).collect();
    for (row, column, value) in model.entries(&at.values) {
        allowed[row] += ROUNDING * (value * here[column]).abs();
    }
    let is_met = at.c.iter().zip(&allowed).all(|(c, allowed)| c.abs() <= *allowed);
    let beside = here
        .iter()
        .zip(&q)
        .zip(&measures.sizes)
        .all(|((a, b), size)| (a - b).abs() <= 10.0 * near * size);
    if is_met && beside && echelon(&at, crate::linear::RANK).rank() < rank { here } else { q }
}

/// Returns q + Σ s n with l · C_q n = 0 to first order.
fn onto(
    model: &Model<'_>,
    (q, at): (&[f64], &Point),
    t: f64,
    measures: &Measures,
    [free, dependent]: [&[Sparse]; 2],
) -> Option<Vec<f64>> {
    let n = model.n();
    let m = model.m();
    let unit = |vector: &Sparse, size: usize| {
        let largest = vector.iter().fold(f64::MIN_POSITIVE, |m, (_, x)| m.max(x.abs()));
        dense(vector, size).into_iter().map(|x| x / largest).collect::<Vec<f64>>()
    };
    let free: Vec<Vec<f64>> = free.iter().map(|v| unit(v, n)).collect();
    let dependent: Vec<Vec<f64>> = dependent.iter().map(|y| unit(y, m)).collect();
    // (C_q v)_q v for v in units of the sizes, with rows of order 1.
    let curvature = |v: &[f64]| -> Option<Vec<f64>> {
        let v: Vec<f64> = v.iter().zip(&measures.sizes).map(|(v, size)| v * size).collect();
        let rhs = model.second_order(q, t, &v, 0.0).ok()?;
        Some(rhs.iter().zip(&measures.norms).map(|(x, norm)| -x / norm).collect())
    };
    let along = |v: &[f64]| -> Vec<f64> {
        let mut c = vec![0.0; m];
        for (row, column, value) in model.entries(&at.values) {
            c[row] += value * measures.sizes[column] / measures.norms[row] * v[column];
        }
        c
    };
    let own = free.iter().map(|v| curvature(v)).collect::<Option<Vec<_>>>()?;
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut matrix = Vec::new();
    let mut rhs = Vec::new();
    for (b, v) in free.iter().enumerate() {
        let mixed = free
            .iter()
            .enumerate()
            .map(|(j, u)| {
                if j == b {
                    return Some(own[b].clone());
                }
                let sum: Vec<f64> = u.iter().zip(v).map(|(u, v)| u + v).collect();
                let whole = curvature(&sum)?;
                Some(
                    whole
                        .iter()
                        .zip(&own[j])
                        .zip(&own[b])
                        .map(|((w, x), y)| 0.5 * (w - x - y))
                        .collect(),
                )
            })
            .collect::<Option<Vec<Vec<f64>>>>()?;
        let stretched = along(v);
        for y in &dependent {
            matrix.extend(mixed.iter().map(|mixed| dot(y, mixed)));
            rhs.push(-dot(y, &stretched));
        }
    }
    let s = shortest(rhs.len(), free.len(), &matrix, &rhs)?;
    let mut moved = q.to_vec();
    for (s, v) in s.iter().zip(&free) {
        moved.iter_mut().zip(v).zip(&measures.sizes).for_each(|((q, v), size)| *q += s * v * size);
    }
    Some(moved)
}

/// Returns the least-squares solution of a small dense system, row after row.
fn shortest(rows: usize, columns: usize, matrix: &[f64], rhs: &[f64]) -> Option<Vec<f64>> {
    let places: Vec<Option<(usize, usize)>> =
        (0..rows).flat_map(|row| (0..columns).map(move |column| Some((row, column)))).collect();
    let mut solver = LeastSquares::new(rows, columns, &places);
    if !solver.factor(matrix.iter().copied(), 1e-12) {
        return None;
    }
    let s = solver.solve(rhs.iter().copied()).to_vec();
    s.iter().all(|s| s.is_finite()).then_some(s)
}

/// Returns the pose moved back onto C = 0, without a motion along the nearly free directions.
fn met_again(
    model: &Model<'_>,
    mut q: Vec<f64>,
    t: f64,
    Measures { sizes, norms, .. }: &Measures,
    near: f64,
) -> Option<(Vec<f64>, Point)> {
    const STEPS: usize = 3;
    let mut solver = LeastSquares::new(model.m(), model.n(), &model.equations.entries);
    let mut point = model.linearize(&q, t).ok()?;
    for _ in 0..STEPS {
        let scale = |entry: &Option<(usize, usize)>| {
            entry.map_or(0.0, |(row, column)| sizes[column] / norms[row])
        };
        let entries = model.equations.entries.iter().zip(&point.values);
        let values: Vec<f64> = entries.map(|(entry, value)| scale(entry) * value).collect();
        // The squared damping is far above the squares of the nearly free directions and far below
        // all others.
        if !solver.factor(values.into_iter(), near) {
            return None;
        }
        let y = solver.solve(point.c.iter().zip(norms).map(|(c, norm)| -c / norm));
        q.iter_mut().zip(y).zip(sizes).for_each(|((q, y), size)| *q += y * size);
        point = model.linearize(&q, t).ok()?;
    }
    Some((q, point))
}
