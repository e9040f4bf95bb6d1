//! Computes runs in which a compiled program computes most times, many times at once.
//!
//! Kin tests every time in the same way as a single step.
//!
//! Single steps and blocks of the program alternate. A block begins at a single step, for which the
//! program must give the same q, q̇ and q̈. The block ends at another single step, which Kin tests
//! from the block's last time. If a test fails, the step-by-step solver computes the rest of the
//! block. So halving, toggles, change points and errors have one implementation.

mod block;
mod cases;
mod curve;
pub(crate) mod description;
mod holds;
mod position;
mod programs;

use std::collections::HashMap;
use std::sync::Arc;

use crate::model::formula::Table;
use crate::numbers::lanes::{Lanes, Level, WithLevel};
use crate::outcome::error::surface::Surface;
use crate::outcome::error::{Error, Result};
use crate::program::{Case, Obstacle, Refusal, Tape};
use crate::solve::first_run;
use crate::solve::motion::Motion;
use crate::solve::options::{Engine, SolverOptions, Stop};
use crate::solve::run::Run;
use crate::system::System;
use block::Block;
pub(crate) use cases::{Cases, Varied};
pub(crate) use position::position;

/// After blocks without a result, this many times more are left to single steps, up to this limit.
const PATIENCE: usize = 64;

/// The number of times from which a program is faster, and the number of times for each node of a
/// constraint's equation. Measured: compiling costs as much as the program saves in 1200 single
/// steps of a four-bar, and in 4000 of a platform.
const ENOUGH: usize = 1000;
const A_NODE: usize = 20;

/// The number of times from which an existing program is faster.
const FEWEST: usize = 32;

/// Returns a known obstacle to a program, before a pose exists.
pub(crate) fn can_be(system: &System) -> std::result::Result<(), Refusal> {
    if system.n_equations() != system.n_coordinates() {
        return Err(Refusal::whole(Obstacle::Redundant));
    }
    let mut blocks = system.equations().blocks.iter();
    match blocks.find(|block| block.constraint.formula(|_, _, _| ()).is_none()) {
        Some(block) => Err(Refusal::one(&block.name, Obstacle::NoFormula)),
        None => Ok(()),
    }
}

/// Builds the error for a mechanism that cannot be compiled.
pub(crate) fn refused(refusal: &Refusal) -> Error {
    let reason =
        format!("{refusal}. To let Kin choose the engine, {}", Surface::chosen().any_engine());
    Error::InvalidOptions { reason }
}

/// The engine that computes the times of a run. It is selected at the first time and serves all
/// parts of the run.
pub(crate) struct Computing {
    wanted: Wanted,
    lanes: Lanes,
    begun: bool,
    /// True of a run in parts: the first one begins the run, and is checked as a first run is.
    in_parts: bool,
    tape: Option<(Arc<Tape>, Case)>,
    /// Why there is no program, if the run looked for one.
    plain: Option<Arc<str>>,
}

impl Computing {
    /// Selects the engine for these options and this number of times. Errors: options that a
    /// program does not support, if the user requires one.
    pub(crate) fn new(system: &System, times: usize, options: &SolverOptions) -> Result<Self> {
        let (wanted, plain) = wanted(system, times, options)?;
        Ok(Computing {
            wanted,
            lanes: Lanes::Best,
            begun: false,
            in_parts: false,
            tape: None,
            plain: plain.map(|why| why.to_string().into()),
        })
    }

    /// Runs with this tape, or with the step-by-step solver for the given reason.
    fn by(tape: Option<(Arc<Tape>, Case)>, plain: Option<Arc<str>>, lanes: Lanes) -> Self {
        Computing { wanted: Wanted::Plain, lanes, begun: false, in_parts: false, tape, plain }
    }

    /// Selects the engine of a run in parts. Results must not depend on where parts end, so a
    /// program is used only if the user names it.
    pub(crate) fn in_parts(system: &System, options: &SolverOptions) -> Result<Self> {
        let times = if options.engine == Engine::Compiled { usize::MAX } else { 0 };
        Ok(Computing { in_parts: true, ..Self::new(system, times, options)? })
    }

    /// Computes position, velocity and acceleration at the next times of the run and appends them
    /// to the motion, which does not contain them yet.
    pub(crate) fn run(
        &mut self,
        run: &mut Run<'_>,
        times: &[f64],
        motion: &mut Motion,
    ) -> Result<()> {
        let begins = !self.begun && !times.is_empty();
        self.begun |= begins;
        if let (Some(first), true) = (times.first(), begins) {
            self.begin(run, *first, motion)?;
        }
        motion.plain.clone_from(&self.plain);
        let done = match &self.tape {
            Some((tape, case)) => replay(run, times, motion, (tape, case), self.lanes),
            None => run.reach_all(&times[motion.len()..], motion),
        };
        if begins && self.in_parts {
            first_run::note(run.system(), motion, run.first_pivot());
        }
        done
    }

    /// Makes the program at the first position.
    fn begin(&mut self, run: &mut Run<'_>, first: f64, motion: &mut Motion) -> Result<()> {
        if self.wanted == Wanted::Plain {
            return Ok(());
        }
        let missing = || Err(Refusal::whole(Obstacle::NoLanes));
        let here = if self.lanes.are_there() { can_be(run.system()) } else { missing() };
        let made = match here {
            Ok(()) => {
                run.reach(first, motion)?;
                let Some(stepper) = run.stepper() else { return Ok(()) };
                programs::cached(&stepper.newton, first)
            }
            Err(refusal) => Err(refusal),
        };
        match made {
            Ok(tape) => self.tape = tape.case(run.system()).map(|case| (tape, case)),
            Err(refusal) if self.wanted == Wanted::Compiled => return Err(refused(&refusal)),
            Err(refusal) => self.plain = Some(refusal.to_string().into()),
        }
        Ok(())
    }
}

/// Computes all remaining times with a tape, if the machine has SIMD.
fn replay(
    run: &mut Run<'_>,
    times: &[f64],
    motion: &mut Motion,
    (tape, case): (&Arc<Tape>, &Case),
    lanes: Lanes,
) -> Result<()> {
    match lanes.dispatch(Work { run, times, motion, tape, case }) {
        Ok(done) => done,
        Err(Work { run, motion, .. }) => run.reach_all(&times[motion.len()..], motion),
    }
}

/// Times of a run, passed to the SIMD lanes of the machine.
struct Work<'x, 'a> {
    run: &'x mut Run<'a>,
    times: &'x [f64],
    motion: &'x mut Motion,
    tape: &'x Arc<Tape>,
    case: &'x Case,
}

impl WithLevel for Work<'_, '_> {
    type Output = Result<()>;

    fn run<S: Level>(self, simd: S) -> Result<()> {
        let Work { run, times, motion, tape, case } = self;
        let mut block = Block::new(simd, Arc::clone(tape), case.clone(), run);
        let mut pause = 0_usize;
        let mut patience = 1;
        while let Some(&t) = times.get(motion.len()) {
            run.reach(t, motion)?;
            if pause > 0 || motion.len() < block.begins_after() {
                pause = pause.saturating_sub(1);
                continue;
            }
            let taken = block.take(run, times, motion)?;
            motion.engine.compiled += taken;
            (pause, patience) =
                if taken > 0 { (0, 1) } else { (patience - 1, (2 * patience).min(PATIENCE)) };
        }
        motion.engine.handed_back = block.objections;
        Ok(())
    }
}

/// The required engine.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Wanted {
    Plain,
    /// A program if possible.
    Tried,
    Compiled,
}

/// Returns the engine for these options and this number of times, with the obstacle to a program
/// that would be faster. Errors: options that a program does not support, if the user requires one.
fn wanted(
    system: &System,
    times: usize,
    options: &SolverOptions,
) -> Result<(Wanted, Option<Obstacle>)> {
    let stands_in_the_way = (!options.predict).then_some(Obstacle::NoPrediction);
    match (options.engine, stands_in_the_way) {
        (Engine::StepByStep, _) => Ok((Wanted::Plain, None)),
        (Engine::Compiled, None) => Ok((Wanted::Compiled, None)),
        (Engine::Compiled, Some(reason)) => Err(Error::InvalidOptions {
            reason: format!(
                "{reason}. To let Kin choose the engine, {}",
                Surface::chosen().any_engine()
            ),
        }),
        (Engine::Auto, _) if !pays(system, times, options) => Ok((Wanted::Plain, None)),
        // The protocol of published comparisons is that of single steps.
        (Engine::Auto, None) if matches!(options.stop, Stop::ResidualOnly(_)) => {
            Ok((Wanted::Plain, Some(Obstacle::ResidualStop)))
        }
        (Engine::Auto, None) => Ok((Wanted::Tried, None)),
        (Engine::Auto, reason) => Ok((Wanted::Plain, reason)),
    }
}

/// Returns true if this number of times takes longer with single steps than compiling and running a
/// program.
fn pays(system: &System, times: usize, options: &SolverOptions) -> bool {
    if !options.jerk && programs::is_asked(system) {
        return times >= FEWEST;
    }
    if times < ENOUGH {
        return false;
    }
    // Constraints of one kind share their formula.
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
    times.saturating_mul(blocks.len()) >= A_NODE * nodes
}

#[cfg(test)]
mod tests;
