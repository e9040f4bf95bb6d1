//! Inverse dynamics as one tape of the whole mechanism, replayed over several times of a motion at once: M q̈
//! and Q_v of all bodies, loads, and C_qᵀ λ = Q by an elimination of nodes, transposed.
//!
//! The balances are the tape's outputs beside λ. What cannot be a tape (redundant mechanisms, friction, loads
//! that are closures) is told by name and left to the walk over the times, as are times at which a pivot is
//! small beside that of the first one, or anything is not finite.

mod acting;
mod cases;
mod frame;
#[cfg(test)]
mod tests;
mod vectors;

use std::sync::Arc;

use kin_graph::{Graph, Node};

use super::acting::Laid;
use super::balance::Powers;
use crate::program::{Guarded, IntoRows, NO_LANES, REDUNDANT, Refusal, gather};
use crate::solve::motion::Motion;
use crate::system::System;
use acting::Acts;

/// Times from which on compiling saves more than it takes.
const LEAST: usize = 50;

const RUBS: &str = "friction and the force that it comes from are solved together at each time";
const SINGULAR: &str = "the first position is singular";

/// True if a motion has so many times that a tape is worth its while.
pub(super) fn pays(motion: &Motion) -> bool {
    motion.len() >= LEAST
}

/// λ and the powers of all times into these; gives the times that are left to the walk.
pub(super) fn fill(
    system: &System,
    motion: &Motion,
    loads: &[(&str, Laid<'_>)],
    (lambda, powers): (&mut [f64], &mut Powers),
) -> Result<Vec<usize>, Refusal> {
    let whole = |reason| Refusal { constraint: String::new(), reason };
    let tape = cached(system, motion, loads)?;
    let rows = [(lambda, system.n_equations())].into_iter();
    let series = powers.of_tape().into_iter().map(|list| (list.as_mut_slice(), 1));
    let sink = IntoRows(rows.chain(series).collect());
    tape.run(motion, &|_| None, sink).ok_or(whole(NO_LANES))
}

/// A tape, or why there is none, with the position that its elimination was chosen at. Of another one the
/// numbers would be the same but for the last digits, and those must not depend on what was asked before.
struct Cached {
    begin: Vec<u64>,
    tape: Result<Arc<Guarded>, Refusal>,
}

/// The tape for motions that begin like this one: made once, and cached beside the system.
fn cached(system: &System, motion: &Motion, loads: &[(&str, Laid<'_>)]) -> Result<Arc<Guarded>, Refusal> {
    let Some(t) = motion.times().first() else { return Err(refusal("", SINGULAR)) };
    if let Some(known) = system.cache().get::<Cached>().filter(|known| known.begin == begin(motion)) {
        return known.tape.clone();
    }
    let tape = tape(system, (*t, motion.q(0)), loads).map(Arc::new);
    cache(system, motion, tape.clone());
    tape
}

fn cache(system: &System, motion: &Motion, tape: Result<Arc<Guarded>, Refusal>) {
    system.cache().put(Arc::new(Cached { begin: begin(motion), tape }));
}

/// All that an elimination is chosen by.
fn begin(motion: &Motion) -> Vec<u64> {
    motion.times().iter().take(1).chain(motion.q(0)).map(|x| x.to_bits()).collect()
}

fn refusal(constraint: &str, reason: &'static str) -> Refusal {
    Refusal { constraint: constraint.to_string(), reason }
}

/// The tape of a system: λ, and what [`Powers::of_tape`] lists.
fn tape(system: &System, begin: (f64, &[f64]), loads: &[(&str, Laid<'_>)]) -> Result<Guarded, Refusal> {
    tape_with(system, begin, loads, |_, _| ())
}

/// The same, λ as `spoil` leaves it: tests plant faults by that.
fn tape_with(
    system: &System,
    begin: (f64, &[f64]),
    loads: &[(&str, Laid<'_>)],
    spoil: impl FnOnce(&mut Graph, &mut [Node]),
) -> Result<Guarded, Refusal> {
    if system.is_redundant() || system.n_equations() != system.n_coordinates() {
        return Err(refusal("", REDUNDANT));
    }
    if let Some((joint, _)) = system.loads.frictions.first() {
        return Err(refusal(joint, RUBS));
    }
    let mut whole = gather(system, false)?;
    let Acts { by_q, kinetic, rate, potential, loads, largest, .. } = Acts::new(&mut whole, system, loads)?;
    let (cells, by_time): (Vec<_>, Vec<Node>) =
        whole.rows.into_iter().map(|row| (row.slopes, row.by_time)).unzip();
    let made = Guarded::new(system, begin, (whole.graph, whole.laws), &cells, |graph, elimination, masks| {
        let by_q = masks.all(graph, &by_q);
        let lambda = elimination.solve_transposed(graph, &by_q);
        let mut lambda = masks.all(graph, &lambda);
        spoil(graph, &mut lambda);
        let drives = along(graph, &lambda, &by_time);
        lambda.into_iter().chain([kinetic, potential, rate, drives, loads, largest]).collect()
    });
    made.ok_or(refusal("", SINGULAR))
}

/// λ · C_t
fn along(graph: &mut Graph, lambda: &[Node], by_time: &[Node]) -> Node {
    let zero = graph.zero();
    lambda.iter().zip(by_time).fold(zero, |sum, (lambda, by_time)| {
        let product = graph.mul(*lambda, *by_time);
        graph.add(sum, product)
    })
}
