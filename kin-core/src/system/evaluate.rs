//! Evaluation of a whole system: states once an iterate, then each constraint into its own block of rows and values.

pub(crate) mod lanes;

use std::ops::Range;
use std::sync::Arc;

use crate::blame::{Culprit, Term};
use crate::constraint::{Constraint, Route};
use crate::error::Error;
use crate::layout::{Layout, Place};
use crate::state::{At, Rates};
use crate::system::states::{GROUND, StatePlan};

/// One constraint in a system.
#[derive(Clone)]
pub(crate) struct Block {
    pub name: String,
    pub constraint: Box<dyn Constraint>,
    /// Where its numbers of time, its arguments' states, its rows, its values and its columns' rates stand.
    timed: Span,
    states: u32,
    rows: Span,
    values: Span,
    rates: u32,
    /// Whether all its values of C_q are the same for good.
    constant: bool,
    /// Whether it drives.
    pub drives: bool,
    arguments: Arc<Arguments>,
}

/// Where each argument's state begins among those of its constraint, and its first column: constraints of one kind share it.
#[derive(Debug, PartialEq)]
struct Arguments {
    first_state: Vec<usize>,
    first_column: Vec<usize>,
}

/// A stretch of a list. 32 bits: no sum of two overflows, so that taking it costs one check.
#[derive(Clone, Copy, Debug)]
struct Span {
    first: u32,
    len: u32,
}

impl Span {
    fn new(range: Range<usize>) -> Self {
        Span { first: range.start as u32, len: range.len() as u32 }
    }

    fn range(self) -> Range<usize> {
        self.first as usize..self.first as usize + self.len as usize
    }
}

impl Block {
    /// Where its rows stand among all rows.
    pub(crate) fn rows(&self) -> Range<usize> {
        self.rows.range()
    }

    /// Where its values stand among all values of C_q.
    pub(crate) fn values(&self) -> Range<usize> {
        self.values.range()
    }

    /// Name of local row `k`; empty for a constraint of one row.
    pub(crate) fn row(&self, k: usize) -> &str {
        match self.constraint.rows() {
            [_] => "",
            rows => rows.get(k).copied().unwrap_or(""),
        }
    }

    /// Name of the equation in local row `k`, such as `A.x`.
    pub(crate) fn equation(&self, k: usize) -> String {
        match self.row(k) {
            "" => self.name.clone(),
            row => format!("{}.{row}", self.name),
        }
    }
}

/// What constraints read at one instant: the time, what they make of it alone, states of their arguments and rates of their columns.
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

    /// The instant as the first constraint sees it; the others look further on.
    fn at(&self) -> At<'_> {
        At::new(self.t, &self.states, &[]).with_timed(&self.timed)
    }

    /// The instant as a constraint sees it.
    pub(crate) fn of<'a>(&'a self, block: &'a Block) -> At<'a> {
        block.at(self.at())
    }
}

impl Block {
    #[inline(always)]
    fn at<'a>(&'a self, at: At<'a>) -> At<'a> {
        at.further(self.states as usize, self.timed.first as usize, &self.arguments.first_state)
    }
}

/// What of a constraint is not finite.
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
    asked: Asked,
}

/// The constraints that need to be asked at all, by what they are asked for.
#[derive(Clone, Default)]
struct Asked {
    /// Those that make numbers of the time alone.
    timed: Vec<usize>,
    /// Those whose C depends on t.
    c: Vec<usize>,
    /// Those whose C_t, or Q_d, can be other than zero.
    c_t: Vec<usize>,
    q_d: Vec<usize>,
    /// Those that can hold and yet not be meant so.
    branches: Vec<usize>,
    /// Whether some C_q depends on t.
    c_q_on_t: bool,
}

impl Equations {
    /// Lays the constraints out one after the other. Their arguments must be of this layout.
    pub(crate) fn new(layout: &Layout, constraints: Vec<(String, Box<dyn Constraint>)>) -> Self {
        let (entries, constants, plan, asked) = (Vec::new(), Vec::new(), StatePlan::default(), Asked::default());
        let mut all = Equations { blocks: Vec::new(), plan, entries, constants, rows: 0, timed: 0, asked };
        let mut kinds: Vec<Arc<Arguments>> = Vec::new();
        all.blocks.reserve_exact(constraints.len());
        // Copies made in a row lie side by side in memory: a pass over all of them reads it from end to end.
        let copies: Vec<Box<dyn Constraint>> = constraints.iter().map(|(_, constraint)| constraint.clone()).collect();
        for ((name, _), constraint) in constraints.into_iter().zip(copies) {
            all.asked.note(all.blocks.len(), constraint.as_ref());
            all.append(layout, name, constraint, &mut kinds);
        }
        all.plan.finish();
        all
    }

    fn append(&mut self, layout: &Layout, name: String, constraint: Box<dyn Constraint>, kinds: &mut Vec<Arc<Arguments>>) {
        let (first_state, first_rate) = (self.plan.len(), self.plan.columns.len());
        let mut arguments = Arguments { first_state: Vec::new(), first_column: Vec::new() };
        for argument in constraint.arguments() {
            let place = layout.place(&argument.target).unwrap_or(Place::Ground(0.0));
            let (state, column) = self.plan.argument(&argument.target, place);
            arguments.first_state.push(state - first_state);
            arguments.first_column.push(column - first_rate);
        }
        let arguments = kinds.iter().find(|known| ***known == arguments).cloned().unwrap_or_else(|| {
            kinds.push(Arc::new(arguments));
            kinds[kinds.len() - 1].clone()
        });
        let first = self.entries.len();
        let own = &self.plan.columns[first_rate..];
        let place = |column: usize| own.get(column).filter(|place| **place != GROUND).map(|place| *place as usize);
        let global = |&(row, column): &(usize, usize)| Some((self.rows + row, place(column)?));
        self.entries.extend(constraint.pattern().iter().map(global));
        self.constants.extend_from_slice(constraint.constants());
        self.constants.resize(self.entries.len(), None);
        let rows = self.rows..self.rows + constraint.rows().len();
        self.rows = rows.end;
        let timed = self.timed..self.timed + constraint.n_timed();
        self.timed = timed.end;
        self.blocks.push(Block {
            name,
            timed: Span::new(timed),
            states: first_state as u32,
            rows: Span::new(rows),
            values: Span::new(first..self.entries.len()),
            rates: first_rate as u32,
            constant: self.constants[first..].iter().all(Option::is_some),
            drives: constraint.is_driver(),
            arguments,
            constraint,
        });
    }

    /// Room for an instant: all coordinates at zero, no time set yet.
    pub(crate) fn instant(&self) -> Instant {
        Instant {
            t: f64::NAN,
            timed: vec![0.0; self.timed],
            states: self.plan.states(),
            rates: vec![0.0; self.plan.columns.len()],
            second_rates: vec![],
        }
    }

    /// The instant at coordinates q and time t.
    pub(crate) fn instant_at(&self, t: f64, q: &[f64]) -> Instant {
        let mut instant = self.instant();
        self.set_time(t, &mut instant);
        self.set_position(q, &mut instant);
        instant
    }

    /// What depends on the time and on parameters alone is evaluated here, once a time.
    pub(crate) fn set_time(&self, t: f64, instant: &mut Instant) {
        instant.t = t;
        for &k in &self.asked.timed {
            let block = &self.blocks[k];
            block.constraint.at_time(t, &mut instant.timed[block.timed.range()]);
        }
    }

    pub(crate) fn set_position(&self, q: &[f64], instant: &mut Instant) {
        self.plan.set_states(q, &mut instant.states);
    }

    pub(crate) fn set_rates(&self, qd: &[f64], instant: &mut Instant) {
        self.plan.set_rates(qd, &mut instant.rates);
    }

    /// C(q, t).
    pub(crate) fn residual(&self, instant: &Instant, c: &mut [f64]) -> Result<(), Bad> {
        for block in &self.blocks {
            block.constraint.residual(&instant.of(block), &mut c[block.rows.range()]);
        }
        finite(c, "C")
    }

    /// Writes the values of C_q that never change; [`Equations::linearize`] may leave them as they are.
    pub(crate) fn set_constants(&self, values: &mut [f64]) {
        values.iter_mut().zip(&self.constants).for_each(|(value, constant)| *value = constant.unwrap_or(*value));
    }

    /// C(q, t) and the values of C_q, whether they are finite or not.
    pub(crate) fn linearize(&self, instant: &Instant, c: &mut [f64], values: &mut [f64]) {
        let at = instant.at();
        for block in &self.blocks {
            let (at, c) = (block.at(at), &mut c[block.rows.range()]);
            if block.constant {
                block.constraint.residual(&at, c);
            } else {
                block.constraint.linearize(&at, c, &mut values[block.values.range()]);
            }
        }
    }

    /// The same where only the time has changed since; false if C_q has not changed with it.
    pub(crate) fn relinearize(&self, instant: &Instant, c: &mut [f64], values: &mut [f64]) -> bool {
        for block in self.asked.c.iter().map(|&k| &self.blocks[k]) {
            let c = &mut c[block.rows.range()];
            if self.asked.c_q_on_t {
                block.constraint.linearize(&instant.of(block), c, &mut values[block.values.range()]);
            } else {
                block.constraint.residual(&instant.of(block), c);
            }
        }
        self.asked.c_q_on_t
    }

    /// Whether C and the values of C_q are finite. What stands on the ground's coordinates does not matter.
    pub(crate) fn finite(&self, c: &[f64], values: &[f64]) -> Result<(), Bad> {
        finite(c, "C")?;
        let mut own = values.iter().zip(&self.entries).filter_map(|(value, entry)| entry.map(|(row, _)| (row, value)));
        own.find(|(_, value)| !value.is_finite()).map_or(Ok(()), |(row, _)| Err(Bad { row, quantity: "C_q" }))
    }

    /// −C_t, whether it is finite or not.
    pub(crate) fn velocity_rhs(&self, instant: &Instant, rhs: &mut [f64]) {
        rhs.fill(0.0);
        for block in self.asked.c_t.iter().map(|&k| &self.blocks[k]) {
            block.constraint.velocity_rhs(&instant.of(block), &mut rhs[block.rows.range()]);
        }
    }

    /// Q_d, whether it is finite or not.
    pub(crate) fn acceleration_rhs(&self, instant: &Instant, q_d: &mut [f64]) {
        self.second_order(instant, 1.0, q_d);
    }

    /// −[(C_q v)_q v + 2 ṫ C_qt v + ṫ² C_tt] along the rates v of the instant, whether it is finite or not.
    pub(crate) fn second_order(&self, instant: &Instant, t_dot: f64, rhs: &mut [f64]) {
        rhs.fill(0.0);
        let (at, rates) = (instant.at(), Rates::new(&instant.rates, &[]));
        for block in self.asked.q_d.iter().map(|&k| &self.blocks[k]) {
            let rates = rates.further(block.rates as usize, &block.arguments.first_column);
            block.constraint.acceleration_rhs(&block.at(at), &rates, t_dot, &mut rhs[block.rows.range()]);
        }
    }

    /// −g‴(0) with g(s) = C(q + s q̇ + ½ s² q̈, t + s), along the rates of the instant and q̈, whether it is finite or not.
    ///
    /// Errors: the first row of a constraint that does not know it.
    pub(crate) fn jerk_rhs(&self, qdd: &[f64], instant: &mut Instant, rhs: &mut [f64]) -> Result<(), usize> {
        instant.second_rates.resize(self.plan.columns.len(), 0.0);
        self.plan.set_rates(qdd, &mut instant.second_rates);
        rhs.fill(0.0);
        let (at, qd, qdd) = (instant.at(), Rates::new(&instant.rates, &[]), Rates::new(&instant.second_rates, &[]));
        // A constraint without second derivatives has no third ones.
        for block in self.asked.q_d.iter().map(|&k| &self.blocks[k]) {
            let [qd, qdd] = [qd, qdd].map(|rates| rates.further(block.rates as usize, &block.arguments.first_column));
            if !block.constraint.jerk_rhs(&block.at(at), &qd, &qdd, &mut rhs[block.rows.range()]) {
                return Err(block.rows().start);
            }
        }
        Ok(())
    }

    /// The error for a constraint that does not know its part of the jerk, by one of its rows.
    pub(crate) fn no_jerk(&self, row: usize) -> Error {
        let reason = "its part of the jerk is not known; implement `Constraint::jerk_rhs`, or run without `Options::jerk`".to_string();
        let [constraint, kind] = match self.block_of(row) {
            Some((block, _)) => [block.name.clone(), block.constraint.kind().to_string()],
            None => Default::default(),
        };
        Error::InvalidConstraint { constraint, kind, reason }
    }

    /// The constraint that a global row belongs to, and its local row.
    pub(crate) fn block_of(&self, row: usize) -> Option<(&Block, usize)> {
        let block = self.blocks.get(self.blocks.partition_point(|block| block.rows().end <= row))?;
        Some((block, row - block.rows().start))
    }

    /// Name of the equation in a global row, such as `A.x`.
    pub(crate) fn equation(&self, row: usize) -> String {
        self.block_of(row).map(|(block, local)| block.equation(local)).unwrap_or_default()
    }

    /// The constraints that can close the wrong way.
    pub(crate) fn branches(&self) -> &[usize] {
        &self.asked.branches
    }

    /// What is wrong with how a constraint closes.
    pub(crate) fn wrong_branch(&self, block: usize, instant: &Instant) -> Option<&str> {
        let block = self.blocks.get(block)?;
        block.constraint.wrong_branch(&instant.of(block))
    }

    /// The first constraint that closes the wrong way, such as with an axis turned by 180°.
    pub(crate) fn first_wrong(&self, instant: &Instant) -> Option<usize> {
        self.asked.branches.iter().copied().find(|block| self.wrong_branch(*block, instant).is_some())
    }

    /// The error for it.
    pub(crate) fn closes_wrong(&self, block: usize, instant: &Instant) -> Error {
        let (name, kind) = self.blocks.get(block).map(|block| (block.name.as_str(), block.constraint.kind())).unwrap_or_default();
        let reason = self.wrong_branch(block, instant).unwrap_or_default().to_string();
        Error::WrongBranch { t: instant.t, constraint: name.to_string(), kind: kind.to_string(), reason, motion: None }
    }

    /// Hand-written constraints need not say that they drive: it is seen from their values at a few times.
    pub(crate) fn find_drivers(&mut self, q: &[f64]) {
        /// Times that no law repeats itself at.   \[s\]
        const TIMES: [f64; 4] = [0.0, 0.073_205_08, 0.414_213_56, 1.732_050_8];
        let silent = |block: &Block| block.constraint.route() == Route::Hand && !block.drives && block.constraint.depends().c_on_t;
        if !self.blocks.iter().any(silent) {
            return;
        }
        let instants = TIMES.map(|t| self.instant_at(t, q));
        let values = |block: &Block, instant: &Instant| {
            let mut c = vec![0.0; block.rows().len()];
            block.constraint.residual(&instant.of(block), &mut c);
            c
        };
        for block in self.blocks.iter_mut().filter(|block| silent(block)) {
            let first = values(block, &instants[0]);
            block.drives = instants[1..].iter().any(|instant| values(block, instant) != first);
        }
    }

    /// The error for what is not finite at an instant.
    pub(crate) fn not_finite(&self, bad: Bad, layout: &Layout, instant: &Instant) -> Error {
        let found = self.block_of(bad.row);
        let culprit = found.map(|(block, row)| {
            let rates = Rates::new(&instant.rates, &[]).further(block.rates as usize, &block.arguments.first_column);
            Culprit::of(block, layout, instant.of(block), rates, row, Term::named(bad.quantity))
        });
        Error::NotFinite {
            t: instant.t,
            constraint: found.map(|(block, _)| block.name.clone()).unwrap_or_default(),
            row: found.map(|(block, local)| block.row(local).to_string()).unwrap_or_default(),
            quantity: bad.quantity,
            culprit: Box::new(culprit.unwrap_or_default()),
            motion: None,
        }
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

impl Asked {
    /// Constraint `k` is asked for what it has.
    fn note(&mut self, k: usize, constraint: &dyn Constraint) {
        let depends = constraint.depends();
        let lists = [
            (constraint.n_timed() > 0, &mut self.timed),
            (depends.c_on_t, &mut self.c),
            (depends.c_t, &mut self.c_t),
            (depends.q_d, &mut self.q_d),
            (constraint.has_branches(), &mut self.branches),
        ];
        for (asked, list) in lists {
            if asked {
                list.push(k);
            }
        }
        self.c_q_on_t |= depends.c_q_on_t;
    }
}
