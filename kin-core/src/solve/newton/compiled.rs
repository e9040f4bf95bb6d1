//! Runs in which a program computes most times, many at once; every time is judged as single steps are.
//!
//! Plain steps and blocks of the program take turns: a block begins at a plain step, which the program has to
//! give the same q, q̇ and q̈ for, and ends at another one, which is judged from the block's last time. Any
//! objection hands the rest of the block to plain steps, so halving, toggles, change points and errors have
//! one implementation.

mod block;
mod curve;
mod holds;

use super::Options;
use super::run::Run;
use crate::model::error::{Error, Result};
use crate::numbers::lanes::{Lanes, Level, WithLevel};
use crate::program::times::ORDERS;
use crate::program::{Pose, REDUNDANT, Refusal, Tape, UNREAD, program, schedule};
use crate::solve::motion::Motion;
use crate::system::System;
use block::Block;

/// After blocks that came to nothing so many times more are left to plain steps, up to this many.
const PATIENCE: usize = 64;

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

/// The program of a system, its elimination chosen at a pose.
pub(crate) fn tape(system: &System, t: f64, q: &[f64], sizes: &[f64]) -> std::result::Result<Tape, Refusal> {
    can_be(system)?;
    program(system, Pose { t, q, sizes }).map(schedule)
}

/// The error for what cannot be compiled.
pub(crate) fn refused(Refusal { constraint, reason }: Refusal) -> Error {
    let what = if constraint.is_empty() { "the mechanism".to_string() } else { format!("`{constraint}`") };
    Error::InvalidOptions {
        reason: format!("{what} cannot be compiled: {reason}; leave `Options::engine` at `Engine::Plain`"),
    }
}

/// Position, velocity and acceleration at each of the times, into the motion.
pub(super) fn run(run: &mut Run<'_>, times: &[f64], motion: &mut Motion) -> Result<()> {
    let Some(first) = times.first() else { return Ok(()) };
    can_be(run.system()).map_err(refused)?;
    run.reach(*first, motion)?;
    let Some(stepper) = run.stepper() else { return Ok(()) };
    let newton = &stepper.newton;
    let tape = tape(newton.system, *first, &newton.q, &newton.sizes).map_err(refused)?;
    replay(run, times, motion, &tape)
}

/// All times beyond the first one by a tape, where the machine has lanes.
fn replay(run: &mut Run<'_>, times: &[f64], motion: &mut Motion, tape: &Tape) -> Result<()> {
    match Lanes::Best.dispatch(Work { run, times, motion, tape }) {
        Ok(done) => done,
        Err(Work { run, motion, .. }) => times[1..].iter().try_for_each(|t| run.reach(*t, motion)),
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

/// True if a program is asked for at all with these options.
pub(super) fn is_wanted(options: &Options) -> Result<bool> {
    if options.engine == super::Engine::Plain {
        return Ok(false);
    }
    let reason = match options {
        Options { jerk: true, .. } => "the jerk is computed by plain steps",
        Options { predict: false, .. } => "a program always predicts; leave `Options::predict` as it is",
        _ => return Ok(true),
    };
    Err(Error::InvalidOptions { reason: format!("{reason}, or leave `Options::engine` at `Engine::Plain`") })
}

#[cfg(test)]
mod tests;
