//! Runs in which a program computes most times, many at once; every time is judged as single steps are.
//!
//! Plain steps and blocks of the program take turns: a block begins at a plain step, which the program has to
//! give the same q, q̇ and q̈ for, and ends at another one, which is judged from the block's last time. Any
//! objection hands the rest of the block to plain steps, so halving, toggles, change points and errors have
//! one implementation.

mod block;
mod curve;
mod holds;
pub(crate) mod programs;

use std::collections::HashMap;

use super::run::Run;
use super::{Engine, Options, Stop};
use crate::model::error::{Error, Result};
use crate::model::formula::Table;
use crate::numbers::lanes::{Lanes, Level, WithLevel};
use crate::program::times::ORDERS;
use crate::program::{REDUNDANT, Refusal, Tape, UNREAD};
use crate::solve::motion::Motion;
use crate::system::System;
use block::Block;

/// After blocks that came to nothing so many times more are left to plain steps, up to this many.
const PATIENCE: usize = 64;

/// From so many times on a program may pay, and so many times a node of a constraint's equation: compiling
/// takes what 1200 plain steps of a four-bar take more than those of its program, and 4000 of a platform.
const ENOUGH: usize = 1000;
const A_NODE: usize = 20;

/// From so many times on a program pays that was compiled before.
const FEWEST: usize = 32;

const JUMPS: &str = "its equation can jump where coordinates move";

/// True if anything is known to stand in the way of a program, before a pose is.
pub(crate) fn can_be(system: &System) -> std::result::Result<(), Refusal> {
    if system.n_equations() != system.n_coordinates() {
        return Err(Refusal { constraint: String::new(), reason: REDUNDANT });
    }
    let equations = system.equations();
    if let Some(block) =
        equations.blocks.iter().find(|block| block.constraint.formula(|_, _, _| ()).is_none())
    {
        return Err(Refusal { constraint: block.name.clone(), reason: UNREAD });
    }
    match equations.jumping().first() {
        Some(block) => Err(Refusal { constraint: equations.blocks[*block].name.clone(), reason: JUMPS }),
        None => Ok(()),
    }
}

/// The sentence about a mechanism that cannot be compiled.
fn sentence(Refusal { constraint, reason }: &Refusal) -> String {
    let what = if constraint.is_empty() { "the mechanism".to_string() } else { format!("`{constraint}`") };
    format!("{what} cannot be compiled: {reason}")
}

/// The error for it.
pub(crate) fn refused(refusal: &Refusal) -> Error {
    let reason = format!("{}; leave `Options::engine` at `Engine::Auto`", sentence(refusal));
    Error::InvalidOptions { reason }
}

/// Position, velocity and acceleration at each of the times, into the motion.
pub(super) fn run(run: &mut Run<'_>, times: &[f64], motion: &mut Motion, wanted: Wanted) -> Result<()> {
    let (Some((first, rest)), true) = (times.split_first(), wanted != Wanted::Plain) else {
        return run.reach_all(times, motion);
    };
    let plain = |refusal: &Refusal, motion: &mut Motion| match wanted {
        Wanted::Compiled => Err(refused(refusal)),
        _ => {
            motion.plain = Some(sentence(refusal).into());
            Ok(())
        }
    };
    if let Err(refusal) = can_be(run.system()) {
        plain(&refusal, motion)?;
        return run.reach_all(times, motion);
    }
    run.reach(*first, motion)?;
    let Some(stepper) = run.stepper() else { return Ok(()) };
    match programs::cached(&stepper.newton, *first) {
        Ok(tape) => replay(run, times, motion, &tape),
        Err(refusal) => plain(&refusal, motion).and_then(|()| run.reach_all(rest, motion)),
    }
}

/// All times beyond the first one by a tape, where the machine has lanes.
fn replay(run: &mut Run<'_>, times: &[f64], motion: &mut Motion, tape: &Tape) -> Result<()> {
    match Lanes::Best.dispatch(Work { run, times, motion, tape }) {
        Ok(done) => done,
        Err(Work { run, motion, .. }) => run.reach_all(&times[1..], motion),
    }
}

/// A run beyond its first time, on its way to the lanes of the machine.
struct Work<'x, 'a> {
    run: &'x mut Run<'a>,
    times: &'x [f64],
    motion: &'x mut Motion,
    tape: &'x Tape,
}

impl WithLevel for Work<'_, '_> {
    type Output = Result<()>;

    fn run<S: Level>(self, simd: S) -> Result<()> {
        let Work { run, times, motion, tape } = self;
        let mut block = Block::new(simd, tape, run);
        let (mut pause, mut patience) = (0_usize, 1);
        while let Some(&t) = times.get(motion.len()) {
            run.reach(t, motion)?;
            if pause > 0 || motion.len() < ORDERS {
                pause = pause.saturating_sub(1);
                continue;
            }
            let taken = block.take(run, times, motion)?;
            motion.engine.compiled += taken;
            (pause, patience) = if taken > 0 { (0, 1) } else { (patience - 1, (2 * patience).min(PATIENCE)) };
        }
        motion.engine.handed_back = block.objections;
        Ok(())
    }
}

/// The way that a run is computed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Wanted {
    Plain,
    /// By a program where there can be one.
    Tried,
    Compiled,
}

/// The way that these options ask for, for so many times. Errors: options that a program does not know, where
/// one is asked for.
pub(super) fn wanted(system: &System, times: &[f64], options: &Options) -> Result<Wanted> {
    let stands_in_the_way = match options {
        Options { jerk: true, .. } => Some("the jerk is computed by plain steps"),
        Options { predict: false, .. } => {
            Some("a program always predicts; leave `Options::predict` as it is")
        }
        _ => None,
    };
    match (options.engine, stands_in_the_way) {
        (Engine::Plain, _) => Ok(Wanted::Plain),
        (Engine::Compiled, None) => Ok(Wanted::Compiled),
        (Engine::Compiled, Some(reason)) => Err(Error::InvalidOptions {
            reason: format!("{reason}, or leave `Options::engine` at `Engine::Auto`"),
        }),
        // The protocol of published comparisons is that of single steps.
        (Engine::Auto, None) if !matches!(options.stop, Stop::ResidualOnly(_)) && pays(system, times) => {
            Ok(Wanted::Tried)
        }
        (Engine::Auto, _) => Ok(Wanted::Plain),
    }
}

/// True if so many times take longer by plain steps than to be compiled and computed by a program.
fn pays(system: &System, times: &[f64]) -> bool {
    if programs::is_asked(system) {
        return times.len() >= FEWEST;
    }
    if times.len() < ENOUGH {
        return false;
    }
    // Constraints of one kind share their table.
    let mut known: HashMap<*const Table, usize> = HashMap::new();
    let blocks = &system.equations().blocks;
    let nodes: usize = blocks
        .iter()
        .filter_map(|block| {
            block.constraint.formula(|table, _, _| {
                let length = || table.formula().graph.len();
                *known.entry(std::ptr::from_ref(table)).or_insert_with(length)
            })
        })
        .sum();
    times.len() * blocks.len() >= A_NODE * nodes
}

#[cfg(test)]
mod tests;
