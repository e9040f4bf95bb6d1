//! Computes the path of a motion towards a singular position, and the forces along the path.

use super::super::acting::Now;
use super::super::multipliers::TransposedSolver;
use super::Acting;
use crate::outcome::error::Result;
use crate::solve::follow::{SingularKind, SingularPosition};
use crate::solve::motion::Motion;
use crate::solve::newton::Outcome;
use crate::solve::options::SolverOptions;
use crate::solve::run::Run;
use crate::system::System;
use crate::system::scaled::Measures;

/// The path begins at the last time of the motion that is at least this far from the singular
/// position, if there is such a time. The end of the path is no further than this. \[-\]
const FIRST: f64 = 0.125;
const LAST: f64 = 1.0 / 2048.0;

/// The largest number of places on the path. Each is half as far away as the preceding one.
const PLACES: usize = 40;

/// A part of the generalised forces below this share of all of them is rounding. The force of one
/// constraint below the second share of the largest one is rounding too. \[-\]
const ROUNDING: f64 = 1e-12;
const NOTHING: f64 = 1e-9;

/// The side of its time from which the motion approaches a singular position, in either direction
/// of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Side {
    Before,
    After,
}

/// The places on the path, the furthest first.
pub(super) struct Approach {
    /// |t − t*| of each place. \[s\]
    pub times: Vec<f64>,
    /// max |q_j − q_j*| of each place, in units of the coordinates' sizes. \[-\]
    pub ways: Vec<f64>,
    /// For each part of the forces and each constraint the size of its multipliers at each place,
    /// in units of order 1. `None` for a constraint without force from that part.
    pub sizes: Vec<Vec<Option<Vec<f64>>>>,
}

/// Returns the shares of q̇ and q̈ with which each part of the forces is computed. At a toggle
/// velocities have no bound. Forces of accelerations, of velocities and those at rest then grow
/// with different exponents.
fn parts(kind: SingularKind) -> &'static [[f64; 2]] {
    match kind {
        SingularKind::TurningPoint => &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]],
        SingularKind::Bifurcation => &[[1.0, 1.0]],
    }
}

impl Approach {
    /// Creates the path from the nearest time of the motion on that side. Returns `None` if there
    /// is no such time.
    ///
    /// Errors: those of a run and of forces on the path.
    pub(super) fn new(
        system: &System,
        motion: &Motion,
        (to, side): (&SingularPosition, Side),
        acting: Acting<'_>,
    ) -> Result<Option<Approach>> {
        let measures = system.model().measure(&to.q, to.t);
        let way = |q: &[f64]| {
            let shares = q.iter().zip(&to.q).zip(&measures.sizes);
            shares.fold(0.0_f64, |most, ((q, at), size)| most.max(((q - at) / size).abs()))
        };
        let Some(start) = start(motion, to.t, side, &way) else { return Ok(None) };
        let options = SolverOptions::default();
        let mut run = Run::new(system, &options, None)?;
        let mut near = Motion::new(system, PLACES);
        let row = [motion.q(start), motion.qd(start), motion.qdd(start), &[]];
        near.append(motion.times()[start], row, Outcome { iterations: 0, residual: 0.0 }, 0);
        run.go_on(&near, f64::INFINITY);
        // Half the distance along the path is a quarter of the time at a toggle.
        let nearer: f64 = if to.kind == SingularKind::TurningPoint { 0.25 } else { 0.5 };
        let mut from = motion.times()[start] - to.t;
        while near.len() < PLACES && way(near.q(near.len() - 1)) > LAST {
            from *= nearer;
            run.reach(to.t + from, &mut near)?;
        }
        let first = (0..near.len()).find(|k| way(near.q(*k)) <= 2.0 * FIRST).unwrap_or(near.len());
        let places = first..near.len();
        Ok(Some(Approach {
            times: places.clone().map(|k| (near.times()[k] - to.t).abs()).collect(),
            ways: places.clone().map(|k| way(near.q(k))).collect(),
            sizes: sizes(system, (&near, places), &measures, parts(to.kind), acting)?,
        }))
    }
}

/// Returns the index of the time of a motion at which the path begins.
fn start(motion: &Motion, at: f64, side: Side, way: &dyn Fn(&[f64]) -> f64) -> Option<usize> {
    let times = motion.times();
    let is_there = |t: f64| if side == Side::Before { t < at } else { t > at };
    let mut there: Vec<usize> = (0..times.len()).filter(|k| is_there(times[*k])).collect();
    there.sort_by(|a, b| (times[*a] - at).abs().total_cmp(&(times[*b] - at).abs()));
    let far = there.iter().find(|k| way(motion.q(**k)) >= FIRST);
    far.or(there.last()).copied()
}

/// Returns the sizes of multipliers at the places of a motion: for each part, constraint and place.
fn sizes(
    system: &System,
    (near, places): (&Motion, std::ops::Range<usize>),
    measures: &Measures,
    parts: &[[f64; 2]],
    acting: Acting<'_>,
) -> Result<Vec<Vec<Option<Vec<f64>>>>> {
    let mut solver = TransposedSolver::new(system);
    let blocks = &system.equations().blocks;
    let mut all = vec![vec![Some(Vec::new()); blocks.len()]; parts.len()];
    for k in places {
        let mut before = vec![0.0; system.n_coordinates()];
        let mut largest = 0.0_f64;
        for (part, [rate, second]) in parts.iter().enumerate() {
            let [qd, qdd] = [(near.qd(k), rate), (near.qdd(k), second)]
                .map(|(of, share)| of.iter().map(|x| share * x).collect::<Vec<f64>>());
            let now = Now { t: near.times()[k], q: near.q(k), qd: &qd, qdd: &qdd };
            let whole = acting(now)?;
            let own: Vec<f64> = whole.iter().zip(&before).map(|(all, less)| all - less).collect();
            before = whole;
            let size = |of: &[f64]| {
                of.iter()
                    .zip(&measures.sizes)
                    .fold(0.0_f64, |most, (q, size)| most.max((q * size).abs()))
            };
            largest = largest.max(size(&before));
            let acts = size(&own) > ROUNDING * largest;
            let lambda =
                if part == 0 { solver.solve(now, &own)?.lambda } else { solver.transposed(&own) };
            let of_block = |rows: std::ops::Range<usize>| {
                rows.map(|row| (lambda[row] * measures.norms[row]).powi(2)).sum::<f64>().sqrt()
            };
            let found: Vec<f64> = blocks.iter().map(|block| of_block(block.rows())).collect();
            let most = found.iter().fold(0.0_f64, |most, size| most.max(*size));
            for (known, size) in all[part].iter_mut().zip(found) {
                match known {
                    Some(known) if acts && size > NOTHING * most => known.push(size),
                    _ => *known = None,
                }
            }
        }
    }
    Ok(all)
}
