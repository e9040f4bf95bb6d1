//! Evaluation of a whole system: states once an iterate, then each constraint into its own block of
//! rows and values.

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

/// The arguments of constraints at one instant: the time, values computed from it alone, states and
/// rates.
#[derive(Clone, Debug)]
pub(crate) struct Instant {
    t: f64,
    timed: Vec<f64>,
    states: Vec<f64>,
    rates: Vec<f64>,
    /// Second rates of the columns, where the jerk is asked for; else empty.
    second_rates: Vec<f64>,
}

impl Instant {
    /// The time, not a number before one was set.
    pub(crate) fn t(&self) -> f64 {
        self.t
    }
}

/// Name of the right side for the jerk.
pub(crate) const JERK_RHS: &str = "the right side for the jerk";

/// The entry of a constraint's terms that is not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bad {
    /// Global row.
    pub row: usize,
    /// `C`, `C_q`, `C_t`, `Q_d`, `q'`, `q''`, `q'''` or the right side of the last.
    pub quantity: &'static str,
}

/// All constraints of a system, and where they write.
#[derive(Clone)]
pub(crate) struct Equations {
    pub blocks: Vec<Block>,
    plan: StatePlan,
    /// Row and column of each value; `None` on the ground.
    pub entries: Vec<Option<(usize, usize)>>,
    /// Values of C_q that never change.
    pub constants: Vec<Option<f64>>,
    pub rows: usize,
    /// How many numbers constraints make of the time alone.
    timed: usize,
    linear: LinearRows,
    asked: Asked,
    /// The constraints that can jump, once that has been asked.
    jumping: OnceLock<Vec<usize>>,
    /// The constraints with conditions or other kinks, once that has been asked.
    switching: OnceLock<Vec<usize>>,
    /// True if rows give all coordinates one after the other, once that has been asked.
    explicit: OnceLock<bool>,
}

/// The constraints that need to be asked at all, by what they are asked for.
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
    /// Nonlinear constraints whose C_t, or Q_d, can be other than zero.
    c_t: Vec<usize>,
    q_d: Vec<usize>,
    /// Constraints that can hold on a branch that is not meant.
    branches: Vec<usize>,
    /// True if some C_q depends on t.
    c_q_on_t: bool,
}

/// A constraint that is linear in the coordinates for good.
#[derive(Clone, Copy)]
struct Straight {
    block: usize,
    /// Where what its rows come to stands among the numbers of the time, and whether the constraint
    /// writes it there itself.
    sides: usize,
    by_constraint: bool,
}

impl Equations {
    /// Room for an instant: all coordinates at zero, no time set yet.
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

    /// The instant as a constraint sees it.
    pub(crate) fn at<'a>(&'a self, block: &Block, instant: &'a Instant) -> At<'a> {
        let mut at = At::new(instant.t, &instant.states, &[]);
        self.show(block, instant, &mut at);
        at
    }

    /// Turns what one constraint has seen to what another one sees: less to write than all of it.
    #[inline(always)]
    fn show<'a>(&'a self, block: &Block, instant: &'a Instant, at: &mut At<'a>) {
        at.turn(
            &self.plan.arguments()[block.arguments.range()],
            from(&instant.timed, block.timed.first),
        );
    }

    /// Where all coordinates are zero, as a constraint sees it.
    fn origin(&self, t: f64, block: &Block) -> At<'_> {
        At::new(t, self.plan.origin(), &self.plan.arguments()[block.arguments.range()])
    }

    /// The rates of all coordinates as a constraint sees them.
    #[inline(always)]
    fn rates<'a>(&'a self, block: &Block, rates: &'a [f64]) -> Rates<'a> {
        Rates::new(rates, &self.plan.arguments()[block.arguments.range()])
    }

    /// The instant at coordinates q and time t.
    pub(crate) fn instant_at(&self, t: f64, q: &[f64]) -> Instant {
        let mut instant = self.instant();
        self.set_time(t, &mut instant);
        self.set_position(q, &mut instant);
        instant
    }

    /// Values that depend on the time and on parameters alone are evaluated here, once a time.
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

    /// Asks a linear constraint that does not tell what its rows come to; its Q_d does not depend
    /// on the rates.
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

    /// C(q, t) at an instant of that q.
    pub(crate) fn residual(&self, q: &[f64], instant: &Instant, c: &mut [f64]) -> Result<(), Bad> {
        for block in self.asked.curved.iter().map(|&k| &self.blocks[k]) {
            block.constraint.residual(&self.at(block, instant), &mut c[block.rows.range()]);
        }
        self.linear.write(q, &instant.timed, c);
        finite(c, "C")
    }

    /// Writes the values of C_q that never change; [`Equations::linearize`] may leave them as they
    /// are.
    pub(crate) fn set_constants(&self, values: &mut [f64]) {
        values
            .iter_mut()
            .zip(&self.constants)
            .for_each(|(value, constant)| *value = constant.unwrap_or(*value));
    }

    /// C(q, t) and the values of C_q at an instant of that q, whether they are finite or not.
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

    /// The same where only the time has changed since; false if C_q has not changed with it.
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

    /// Refuses C and values of C_q that are not finite. Entries on the ground's coordinates do not
    /// matter.
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

/// The first row that is not finite.
pub(crate) fn finite(rows: &[f64], quantity: &'static str) -> Result<(), Bad> {
    if rows.iter().fold(true, |finite, x| finite & x.is_finite()) {
        return Ok(());
    }
    match rows.iter().position(|x| !x.is_finite()) {
        Some(row) => Err(Bad { row, quantity }),
        None => Ok(()),
    }
}
