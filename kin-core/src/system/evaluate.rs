//! Evaluates a whole system.
//!
//! Kin computes the states once for each iterate; then each constraint writes its block of rows and
//! values.

mod block;
mod culprit;
mod held;
mod laid_out;
mod linear;
mod named;
mod sides;

use std::sync::OnceLock;

use crate::model::state::{At, Rates};
use crate::system::states::StatePlan;
pub(crate) use block::Block;
use block::from;
use linear::LinearRows;

/// The arguments of all constraints at one instant: the time, the values computed from the time
/// alone, states and velocities.
#[derive(Clone, Debug)]
pub(crate) struct Instant {
    t: f64,
    timed: Vec<f64>,
    states: Vec<f64>,
    rates: Vec<f64>,
    /// The second derivatives of the columns for the jerk; empty if the jerk is not computed.
    second_rates: Vec<f64>,
}

impl Instant {
    /// Returns the time, or NaN before a time was set.
    pub(crate) fn t(&self) -> f64 {
        self.t
    }

    /// Discards the numbers of the time, because laws have changed.
    pub(crate) fn forget_time(&mut self) {
        self.t = f64::NAN;
    }
}

/// The name of the right side for the jerk in errors.
pub(crate) const JERK_RHS: &str = "the right side for the jerk";

/// An entry of a constraint's terms that is not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bad {
    /// The global row.
    pub row: usize,
    /// The quantity: `C`, `C_q`, `C_t`, `Q_d`, `q'`, `q''`, `q'''`, or [`JERK_RHS`].
    pub quantity: &'static str,
}

/// All constraints of a system, with the places where they write.
#[derive(Clone)]
pub(crate) struct Equations {
    pub blocks: Vec<Block>,
    plan: StatePlan,
    /// The row and column of each value of C_q; `None` for columns of the ground.
    pub entries: Vec<Option<(usize, usize)>>,
    /// One item for each value of C_q: `Some(number)` if the value is constant, `None` otherwise.
    pub constants: Vec<Option<f64>>,
    pub rows: usize,
    /// The number of values that constraints compute from the time alone.
    timed: usize,
    linear: LinearRows,
    asked: Asked,
    /// The indices of constraints that can jump, computed at the first use.
    jumping: OnceLock<Vec<usize>>,
    /// The constraints with conditions or other kinks, once that has been asked.
    switching: OnceLock<Vec<usize>>,
    /// True if rows give all coordinates one after the other, once that has been asked.
    explicit: OnceLock<bool>,
}

/// The constraints that must be evaluated, grouped by term.
#[derive(Clone, Default)]
struct Asked {
    /// Constraints that compute numbers from the time alone.
    timed: Vec<usize>,
    /// Nonlinear constraints, and those of them whose C depends on t.
    curved: Vec<usize>,
    c: Vec<usize>,
    /// Linear constraints: those whose C depends on t, and the others.
    linear: Vec<Straight>,
    steady: Vec<Straight>,
    /// Nonlinear constraints whose C_t, or whose Q_d, can be nonzero.
    c_t: Vec<usize>,
    q_d: Vec<usize>,
    /// Constraints that can be satisfied on the wrong branch.
    branches: Vec<usize>,
    /// True if some C_q depends on t.
    c_q_on_t: bool,
}

/// A constraint that is always linear in the coordinates.
#[derive(Clone, Copy)]
struct Straight {
    block: usize,
    /// The index of its C(0, t), −C_t and −C_tt among the numbers of the time, and whether the
    /// constraint writes them itself.
    sides: usize,
    by_constraint: bool,
}

impl Equations {
    /// Creates an instant with all coordinates at zero and no time.
    pub(crate) fn instant(&self) -> Instant {
        let mut instant = Instant {
            t: f64::NAN,
            timed: vec![0.0; self.timed],
            states: self.plan.origin().to_vec(),
            rates: self.plan.no_rates(),
            second_rates: vec![],
        };
        for steady in &self.asked.steady {
            let block = &self.blocks[steady.block];
            block.constraint.at_time(0.0, &mut instant.timed[block.timed.range()]);
            self.ask_sides(*steady, 0.0, &mut instant);
        }
        instant
    }

    /// Returns the instant from the view of a constraint.
    pub(crate) fn at<'a>(&'a self, block: &Block, instant: &'a Instant) -> At<'a> {
        let mut at = At::new(instant.t, &instant.states, &[]);
        self.show(block, instant, &mut at);
        at
    }

    /// Switches the view from one constraint to another. This writes less than a new view.
    #[inline(always)]
    fn show<'a>(&'a self, block: &Block, instant: &'a Instant, at: &mut At<'a>) {
        at.turn(
            &self.plan.arguments()[block.arguments.range()],
            from(&instant.timed, block.timed.first),
        );
    }

    /// Returns the view of a constraint with all coordinates at zero.
    fn origin(&self, t: f64, block: &Block) -> At<'_> {
        At::new(t, self.plan.origin(), &self.plan.arguments()[block.arguments.range()])
    }

    /// Returns the derivatives of all coordinates from the view of a constraint.
    #[inline(always)]
    fn rates<'a>(&'a self, block: &Block, rates: &'a [f64]) -> Rates<'a> {
        Rates::new(rates, &self.plan.arguments()[block.arguments.range()])
    }

    /// Creates the instant at coordinates q and time t.
    pub(crate) fn instant_at(&self, t: f64, q: &[f64]) -> Instant {
        let mut instant = self.instant();
        self.set_time(t, &mut instant);
        self.set_position(q, &mut instant);
        instant
    }

    /// Sets the time and evaluates all values that depend only on time and parameters.
    pub(crate) fn set_time(&self, t: f64, instant: &mut Instant) {
        for block in self.asked.timed.iter().map(|&k| &self.blocks[k]) {
            block.constraint.at_time(t, &mut instant.timed[block.timed.range()]);
        }
        self.asked
            .linear
            .iter()
            .filter(|linear| !linear.by_constraint)
            .for_each(|linear| self.ask_sides(*linear, t, instant));
        instant.t = t;
    }

    /// Evaluates C(0, t), −C_t and −C_tt of a linear constraint that does not write them itself.
    /// Its Q_d does not depend on velocities.
    fn ask_sides(&self, Straight { block, sides, .. }: Straight, t: f64, instant: &mut Instant) {
        let block = &self.blocks[block];
        let (timed, asked) = instant.timed.split_at_mut(sides);
        let at = self.origin(t, block).with_timed(&timed[block.timed.range()]);
        let m = block.rows().len();
        block.constraint.residual(&at, &mut asked[..m]);
        block.constraint.velocity_rhs(&at, &mut asked[m..2 * m]);
        block.constraint.acceleration_rhs(
            &at,
            &self.rates(block, &instant.rates),
            1.0,
            &mut asked[2 * m..3 * m],
        );
    }

    pub(crate) fn set_position(&self, q: &[f64], instant: &mut Instant) {
        self.plan.set_states(q, &mut instant.states);
    }

    pub(crate) fn set_rates(&self, qd: &[f64], instant: &mut Instant) {
        self.plan.set_rates(qd, &mut instant.rates);
    }

    /// Evaluates C(q, t) at an instant with this q.
    pub(crate) fn residual(&self, q: &[f64], instant: &Instant, c: &mut [f64]) -> Result<(), Bad> {
        for block in self.asked.curved.iter().map(|&k| &self.blocks[k]) {
            block.constraint.residual(&self.at(block, instant), &mut c[block.rows.range()]);
        }
        self.linear.write(q, &instant.timed, c);
        finite(c, "C")
    }

    /// Writes the constant values of C_q. [`Equations::linearize`] does not overwrite them.
    pub(crate) fn set_constants(&self, values: &mut [f64]) {
        values
            .iter_mut()
            .zip(&self.constants)
            .for_each(|(value, constant)| *value = constant.unwrap_or(*value));
    }

    /// Evaluates C(q, t) and C_q at an instant with this q, and does not check whether they are
    /// finite.
    pub(crate) fn linearize(
        &self,
        q: &[f64],
        instant: &Instant,
        c: &mut [f64],
        values: &mut [f64],
    ) {
        let mut at = At::new(instant.t, &instant.states, &[]);
        for block in self.asked.curved.iter().map(|&k| &self.blocks[k]) {
            let c = &mut c[block.rows.range()];
            self.show(block, instant, &mut at);
            if block.constant {
                block.constraint.residual(&at, c);
            } else {
                block.constraint.linearize(&at, c, &mut values[block.values.range()]);
            }
        }
        self.linear.write(q, &instant.timed, c);
    }

    /// Updates C and C_q after only the time has changed. Returns false if C_q has not changed.
    pub(crate) fn relinearize(
        &self,
        q: &[f64],
        instant: &Instant,
        c: &mut [f64],
        values: &mut [f64],
    ) -> bool {
        for block in self.asked.c.iter().map(|&k| &self.blocks[k]) {
            let c = &mut c[block.rows.range()];
            if self.asked.c_q_on_t {
                block.constraint.linearize(
                    &self.at(block, instant),
                    c,
                    &mut values[block.values.range()],
                );
            } else {
                block.constraint.residual(&self.at(block, instant), c);
            }
        }
        self.linear.write(q, &instant.timed, c);
        self.asked.c_q_on_t
    }

    /// Returns an error if C or a value of C_q is not finite. Entries on columns of the ground do
    /// not matter.
    pub(crate) fn finite(&self, c: &[f64], values: &[f64]) -> Result<(), Bad> {
        finite(c, "C")?;
        let mut own = values
            .iter()
            .zip(&self.entries)
            .filter_map(|(value, entry)| entry.map(|(row, _)| (row, value)));
        own.find(|(_, value)| !value.is_finite())
            .map_or(Ok(()), |(row, _)| Err(Bad { row, quantity: "C_q" }))
    }
}

/// Returns an error for the first row that is not finite.
pub(crate) fn finite(rows: &[f64], quantity: &'static str) -> Result<(), Bad> {
    if rows.iter().fold(true, |finite, x| finite & x.is_finite()) {
        return Ok(());
    }
    match rows.iter().position(|x| !x.is_finite()) {
        Some(row) => Err(Bad { row, quantity }),
        None => Ok(()),
    }
}
