//! Solves single positions with the compiled program, from nearby coordinates.

use std::sync::{Arc, Mutex, PoisonError};

use super::block::{LEAST, is_meant};
use super::holds::{Look, Sums, holds};
use crate::numbers::lanes::{Lanes, Level, WithLevel};
use crate::program::Tape;
use crate::program::alone::Alone;
use crate::program::times::Limits;
use crate::solve::newton::{DOUBTFUL, Newton, SIMILAR};
use crate::solve::options::{Engine, SolverOptions, Stop};
use crate::system::evaluate::Instant;
use crate::system::{Report, Solution, System, stop};

/// The largest number of Newton steps: a nearby start needs few, and other starts need damped
/// steps.
const STEPS: usize = 4;

/// The largest distance of a coordinate from its start, unless rows determine all coordinates. From
/// further away the program's steps may lead to another assembly than those of all coordinates.
/// \[-\]
const NEAR: f64 = 0.1;

/// The largest tolerance of the stop rule: see [`Stop::Converged`]. \[-\]
const TOLERANCE: f64 = 1e-13;

/// The constraints' kernels check the first position of a workspace, and then one of every `LOOKS`
/// positions.
const LOOKS: usize = 64;

/// A program for single positions, with data from the position at which its elimination was chosen.
pub(super) struct Positions {
    tape: Arc<Tape>,
    t: f64,
    q: Vec<f64>,
    sizes: Vec<f64>,
    /// The smallest pivot, the norms of rows and the values of C_q at that position.
    pivot: f64,
    norms: Vec<f64>,
    values: Vec<f64>,
    /// A workspace that no call uses, with a link to the next one.
    rooms: Mutex<Option<Box<Room>>>,
}

/// The workspace of a call. Data from earlier calls do not change the numbers.
struct Room {
    alone: Alone,
    tolerance: f64,
    limits: Limits,
    instant: Instant,
    c: Vec<f64>,
    values: Vec<f64>,
    rhs: Vec<f64>,
    sums: Sums,
    calls: usize,
    /// Another workspace that no call uses.
    next: Option<Box<Room>>,
}

/// A requested position, passed to the SIMD lanes of the machine.
struct Asked<'a> {
    positions: &'a Positions,
    system: &'a System,
    t: f64,
    from: &'a [f64],
    tolerance: f64,
    steps: usize,
}

/// Returns position, velocity and acceleration at time t from nearby coordinates, with the program
/// of [`System::compile`]. Returns `None` if the step-by-step solver must find them.
pub(crate) fn position(
    system: &System,
    t: f64,
    from: &[f64],
    options: &SolverOptions,
) -> Option<Solution> {
    let programs = system.cache().get::<super::programs::Programs>()?;
    programs.positions()?.position(system, t, from, options)
}

impl Positions {
    /// Creates the positions for a program whose elimination was chosen at the present position.
    pub(super) fn new(tape: Arc<Tape>, newton: &Newton<'_>, t: f64) -> Self {
        Positions {
            tape,
            t,
            q: newton.q.to_vec(),
            sizes: newton.sizes.clone(),
            pivot: newton.linear.smallest_pivot(),
            norms: newton.linear.norms().to_vec(),
            values: newton.linear.values().to_vec(),
            rooms: Mutex::default(),
        }
    }

    /// Returns the position at time t from nearby coordinates.
    pub(super) fn position(
        &self,
        system: &System,
        t: f64,
        from: &[f64],
        options: &SolverOptions,
    ) -> Option<Solution> {
        let Stop::Converged { tolerance } = options.stop else { return None };
        if options.engine == Engine::StepByStep || !options.predict || options.jerk {
            return None;
        }
        // Velocities belong to the position before the last correction, which must be negligible.
        let tolerance = tolerance.min(TOLERANCE);
        let steps = options.max_iterations.min(STEPS);
        Lanes::Best.dispatch(Asked { positions: self, system, t, from, tolerance, steps }).ok()?
    }

    /// Returns true if rows determine all coordinates: there is one position at each time, from any
    /// start.
    fn is_given(&self) -> bool {
        self.tape.torn().is_empty() && !self.tape.jumps()
    }

    /// Returns the limits for positions, with the allowance of each row at the position of the
    /// program.
    fn limits(&self, system: &System, tolerance: f64, steps: usize) -> Limits {
        let sizes: Vec<f64> = self.tape.torn().iter().map(|column| self.sizes[*column]).collect();
        let entries = system.equations().entries.iter().zip(&self.values);
        let entries =
            entries.filter_map(|(entry, value)| entry.map(|(row, column)| (row, column, *value)));
        let mut rows = Vec::new();
        stop::allowances(tolerance, &self.norms, entries, &self.q, &mut rows);
        Limits {
            correction: sizes.iter().map(|size| tolerance * size).collect(),
            rounding: tolerance * stop::rounding(tolerance),
            sizes,
            rows,
            steps,
            pivot: LEAST,
            ..Limits::default()
        }
    }

    /// Returns a workspace that no call uses.
    fn room<S: Level>(&self, simd: S, system: &System) -> Box<Room> {
        let mut rooms = self.rooms.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(mut room) = rooms.take() else {
            drop(rooms);
            return Box::new(self.new_room(simd, system));
        };
        *rooms = room.next.take();
        room
    }

    /// Returns a workspace for later calls.
    fn keep(&self, mut room: Box<Room>) {
        let mut rooms = self.rooms.lock().unwrap_or_else(PoisonError::into_inner);
        room.next = rooms.take();
        *rooms = Some(room);
    }

    fn new_room<S: Level>(&self, simd: S, system: &System) -> Room {
        let n = self.q.len();
        let equations = system.equations();
        let case = self.tape.case(system).unwrap_or_default();
        let mut room = Room {
            alone: Alone::new(simd, Arc::clone(&self.tape), case),
            tolerance: f64::NAN,
            limits: Limits::default(),
            instant: equations.instant(),
            c: vec![0.0; n],
            values: vec![0.0; equations.entries.len()],
            rhs: vec![0.0; n],
            sums: Sums::default(),
            calls: 0,
            next: None,
        };
        equations.set_constants(&mut room.values);
        // Pivots are relative to those at the position where the program was chosen.
        room.alone.solve(simd, self.t, &self.q, &self.limits(system, TOLERANCE, STEPS));
        room.alone.mark();
        room
    }
}

impl WithLevel for Asked<'_> {
    type Output = Option<Solution>;

    fn run<S: Level>(self, simd: S) -> Option<Solution> {
        let mut room = self.positions.room(simd, self.system);
        let found = self.find(simd, &mut room);
        self.positions.keep(room);
        found
    }
}

impl Asked<'_> {
    fn find<S: Level>(&self, simd: S, room: &mut Room) -> Option<Solution> {
        let Asked { positions, system, t, from, tolerance, steps } = *self;
        if room.tolerance != tolerance || room.limits.steps != steps {
            (room.limits, room.tolerance) = (positions.limits(system, tolerance, steps), tolerance);
        }
        let found = room.alone.solve(simd, t, from, &room.limits)?;
        let smallest_pivot = found.pivot * positions.pivot;
        let [q, qd, qdd] = room.alone.numbers();
        let near = |(q, (from, size)): (&f64, (&f64, &f64))| (q - from).abs() <= NEAR * size;
        let is_near =
            positions.is_given() || q.iter().zip(from.iter().zip(&positions.sizes)).all(near);
        // 0 · x is 0 for a finite x, otherwise NaN.
        let finite =
            [&q, &qd, &qdd].iter().all(|list| list.iter().fold(0.0, |sum, x| sum + 0.0 * x) == 0.0);
        // The step-by-step solver decides whether a position is singular.
        let fits = finite && is_near && smallest_pivot >= SIMILAR * DOUBTFUL;
        if !(fits && self.is_meant(room, &q) && self.is_believed(room, [&q, &qd, &qdd])) {
            return None;
        }
        let worst = system.names_of_equations().get(found.worst).cloned().unwrap_or_default();
        let report = Report {
            iterations: found.steps,
            residual: found.residual,
            worst,
            smallest_pivot,
            compiled: true,
        };
        Some(Solution { t, q, qd, qdd, report })
    }

    /// Returns true if a position is on the right branch of all constraints.
    fn is_meant(&self, room: &mut Room, q: &[f64]) -> bool {
        let equations = self.system.equations();
        equations.branches().is_empty() || is_meant(equations, (self.t, q), &mut room.instant)
    }

    /// Returns false if the constraints' kernels check the position and contradict it. Then they
    /// check the next position too.
    fn is_believed(&self, room: &mut Room, [q, qd, qdd]: [&[f64]; 3]) -> bool {
        if !room.calls.is_multiple_of(LOOKS) {
            room.calls += 1;
            return true;
        }
        let equations = self.system.equations();
        let Room { instant, c, values, rhs, sums, limits, .. } = &mut *room;
        equations.set_time(self.t, instant);
        equations.set_position(q, instant);
        equations.linearize(q, instant, c, values);
        let look = Look { equations, instant, c, values, rhs };
        let believed = holds(look, [qd, qdd, &[]], (&limits.rows, sums));
        room.calls += usize::from(believed);
        believed
    }
}
