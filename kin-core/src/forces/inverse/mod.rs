//! Computes inverse dynamics with one tape of the whole mechanism, for several times of a motion at
//! once.
//!
//! The tape contains M q̈ and Q_v of all bodies, loads, and C_qᵀ λ = Q by a transposed elimination
//! of nodes.
//!
//! The outputs of the tape are λ and the balances. Kin records no tape for redundant mechanisms,
//! friction, and closures as loads. In these cases Kin computes one time after the other and
//! reports the reason. Kin also computes a time separately if a pivot is small relative to the
//! pivot at the first time, or if a number is not finite.

mod acting;
mod bodies;
mod cases;
mod frame;
#[cfg(test)]
mod tests;
mod vectors;

use std::sync::Arc;

use kin_graph::{Graph, Node};

use super::acting::Laid;
use super::balance::Powers;
use crate::program::{Guarded, IntoRows, Obstacle, Refusal, Whole, gather_where};
use crate::solve::motion::Motion;
use crate::system::System;
use acting::Acts;

/// The number of times from which compiling saves more than it costs.
const LEAST: usize = 50;

/// Returns true if a motion has enough times for a tape.
pub(super) fn pays(motion: &Motion) -> bool {
    motion.len() >= LEAST
}

/// Writes λ and the powers of all times, and returns the times that remain for the computation time
/// by time.
pub(super) fn fill(
    system: &System,
    motion: &Motion,
    loads: &[(&str, Laid<'_>)],
    (lambda, powers): (&mut [f64], &mut Powers),
) -> Result<Vec<usize>, Refusal> {
    let tape = cached(system, motion, loads)?;
    let rows = [(lambda, system.n_equations())].into_iter();
    let series = powers.of_tape().into_iter().map(|list| (list.as_mut_slice(), 1));
    let sink = IntoRows(rows.chain(series).collect());
    tape.run(motion, &|_| None, sink).ok_or(Refusal::whole(Obstacle::NoLanes))
}

/// Returns T and V of all times, or `None` if they have no tape, or if a number is not finite.
pub(super) fn energies(
    system: &System,
    motion: &Motion,
    loads: &[(&str, Laid<'_>)],
) -> Option<[Vec<f64>; 2]> {
    let mut whole = Whole::new(system.n_coordinates());
    let Acts { kinetic, potential, .. } = Acts::new(&mut whole, system, loads).ok()?;
    let tape = Guarded::of(whole.graph, whole.laws, &[kinetic, potential]);
    let mut all = [(); 2].map(|()| vec![f64::NAN; motion.len()]);
    let sink = IntoRows(all.iter_mut().map(|list| (list.as_mut_slice(), 1)).collect());
    tape.run(motion, &|_| None, sink)?.is_empty().then_some(all)
}

/// A tape, or the reason why there is none, with the data from which it was made. A tape from
/// another position has other last digits, and these must not depend on earlier calls.
struct Cached {
    begin: Begin,
    tape: Result<Arc<Guarded>, Refusal>,
}

/// All data from which a tape is made, as bits: the first time, the coordinates there, and which
/// coordinates are constant along the motion.
#[derive(Clone, PartialEq)]
struct Begin {
    t: u64,
    q: Vec<u64>,
    still: Vec<bool>,
}

impl Begin {
    /// Returns `None` for a motion without times.
    fn of(system: &System, motion: &Motion) -> Option<Begin> {
        let t = motion.times().first()?.to_bits();
        Some(Begin {
            t,
            q: motion.q(0).iter().map(|x| x.to_bits()).collect(),
            still: still(system, motion),
        })
    }

    fn t(&self) -> f64 {
        f64::from_bits(self.t)
    }

    fn q(&self) -> Vec<f64> {
        self.q.iter().map(|bits| f64::from_bits(*bits)).collect()
    }
}

/// Returns the coordinates that a single row without time holds, such as those of frames and of
/// guided blocks. The compiled program has checked this row at each time of its motion, so
/// everything that depends on these coordinates alone is constant. For other motions nothing is
/// assumed.
fn still(system: &System, motion: &Motion) -> Vec<bool> {
    let equations = system.equations();
    let mut still = vec![false; system.n_coordinates()];
    let Some(last) = motion.len().checked_sub(1).filter(|_| motion.engine().compiled > 0) else {
        return still;
    };
    let mut alone: Vec<Option<Option<usize>>> = vec![None; system.n_equations()];
    for (entry, constant) in equations.entries.iter().zip(&equations.constants) {
        let Some((row, column)) = entry else { continue };
        let held = constant.is_some_and(|x| x != 0.0).then_some(*column);
        // A second entry excludes the row.
        alone[*row] = Some(if alone[*row].is_none() { held } else { None });
    }
    let steady =
        equations.blocks.iter().filter(|block| !block.constraint.facts().dependence.c_on_t);
    let held = steady.flat_map(|block| alone[block.rows()].iter().flatten().flatten());
    let rests =
        |k: usize, column: usize| motion.qd(k)[column] == 0.0 && motion.qdd(k)[column] == 0.0;
    for &column in held {
        let same = motion.q(0)[column].to_bits() == motion.q(last)[column].to_bits();
        still[column] = same && rests(0, column) && rests(last, column);
    }
    still
}

/// Returns the tape for motions that begin like this one. It is made once and kept with the system.
fn cached(
    system: &System,
    motion: &Motion,
    loads: &[(&str, Laid<'_>)],
) -> Result<Arc<Guarded>, Refusal> {
    let begin = Begin::of(system, motion).ok_or_else(|| Refusal::whole(Obstacle::SingularStart))?;
    if let Some(known) = system.cache().get::<Cached>().filter(|known| known.begin == begin) {
        return known.tape.clone();
    }
    let tape = tape(system, &begin, loads).map(Arc::new);
    cache(system, begin, tape.clone());
    tape
}

fn cache(system: &System, begin: Begin, tape: Result<Arc<Guarded>, Refusal>) {
    system.cache().put(Arc::new(Cached { begin, tape }));
}

/// Makes the tape of a system: λ, and the list of [`Powers::of_tape`].
fn tape(system: &System, begin: &Begin, loads: &[(&str, Laid<'_>)]) -> Result<Guarded, Refusal> {
    tape_with(system, begin, loads, |_, _| ())
}

/// Makes the tape with λ changed by `spoil`, which tests use to plant faults.
fn tape_with(
    system: &System,
    begin: &Begin,
    loads: &[(&str, Laid<'_>)],
    spoil: impl FnOnce(&mut Graph, &mut [Node]),
) -> Result<Guarded, Refusal> {
    if system.is_redundant() || system.n_equations() != system.n_coordinates() {
        return Err(Refusal::whole(Obstacle::Redundant));
    }
    if let Some((joint, _)) = system.loads.frictions.first() {
        return Err(Refusal::one(joint, Obstacle::Friction));
    }
    let q = begin.q();
    let held = |(still, x): (&bool, &f64)| still.then_some(*x);
    let mut whole = gather_where(system, begin.still.iter().zip(&q).map(held).collect())?;
    let Acts { by_q, rate, loads, largest, .. } = Acts::new(&mut whole, system, loads)?;
    let (cells, by_time): (Vec<_>, Vec<Node>) =
        whole.rows.into_iter().map(|row| (row.slopes, row.by_time)).unzip();
    let at = (begin.t(), q.as_slice());
    let made =
        Guarded::new(system, at, (whole.graph, whole.laws), &cells, |graph, elimination, masks| {
            let by_q = masks.all(graph, &by_q);
            let lambda = elimination.solve_transposed(graph, &by_q);
            let mut lambda = masks.all(graph, &lambda);
            spoil(graph, &mut lambda);
            let drives = along(graph, &lambda, &by_time);
            lambda.into_iter().chain([rate, drives, loads, largest]).collect()
        });
    made.ok_or(Refusal::whole(Obstacle::SingularStart))
}

/// Returns λ · C_t.
fn along(graph: &mut Graph, lambda: &[Node], by_time: &[Node]) -> Node {
    let zero = graph.zero();
    lambda.iter().zip(by_time).fold(zero, |sum, (lambda, by_time)| {
        let product = graph.mul(*lambda, *by_time);
        graph.add(sum, product)
    })
}
