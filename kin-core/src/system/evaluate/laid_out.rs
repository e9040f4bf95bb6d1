//! Lays constraints out one after the other: rows, values and states, and the lists of constraints
//! for each term.

use std::sync::OnceLock;

use super::block::Span;
use super::linear::LinearRows;
use super::{Asked, Block, Equations, Instant, Straight};
use crate::coordinates::layout::{Layout, Place};
use crate::model::constraint::{Constraint, Entry, Route};
use crate::system::states::{Planned, StatePlan};

impl Equations {
    /// Lays the constraints out one after the other. Their arguments must belong to this layout.
    pub(crate) fn new(layout: &Layout, constraints: Vec<(String, Box<dyn Constraint>)>) -> Self {
        let mut all = Equations {
            blocks: Vec::new(),
            plan: StatePlan::new(layout.len()),
            entries: Vec::new(),
            constants: Vec::new(),
            rows: 0,
            timed: 0,
            linear: LinearRows::default(),
            asked: Asked::default(),
            jumping: OnceLock::new(),
            switching: OnceLock::new(),
            explicit: OnceLock::new(),
        };
        let mut planned = Planned::new(layout.len());
        all.blocks.reserve_exact(constraints.len());
        // Copies made in a row are adjacent in memory, so a pass over all of them reads memory from
        // end to end.
        let copies: Vec<Box<dyn Constraint>> =
            constraints.iter().map(|(_, constraint)| constraint.clone()).collect();
        for ((name, _), constraint) in constraints.into_iter().zip(copies) {
            all.append(layout, name, constraint, &mut planned);
            all.ask(all.blocks.len() - 1);
        }
        all
    }

    /// Adds constraint `k` to the lists of the terms that it has.
    fn ask(&mut self, k: usize) {
        let block = &self.blocks[k];
        let asked = &mut self.asked;
        let facts = block.constraint.facts();
        let depends = facts.dependence;
        let mut linear = None;
        if !depends.curved {
            let entries = &self.entries[block.values()];
            let values = &self.constants[block.values()];
            // Constraints that write C(0, t) assume zero coordinates on the ground, which need not
            // be zero.
            let can_tell = depends.c_on_t && entries.iter().all(Option::is_some);
            let is_whole = |first: &usize| {
                first.saturating_add(3 * block.rows().len()) <= block.timed.len as usize
            };
            let told = facts.sides_of_time.filter(|first| can_tell && is_whole(first));
            let sides = told.map_or(self.timed, |first| block.timed.first as usize + first);
            if self.linear.append(block.rows(), entries, values, sides) {
                linear = Some(Straight { block: k, sides, by_constraint: told.is_some() });
                self.timed += if told.is_some() { 0 } else { 3 * block.rows().len() };
            }
        }
        let lists = [
            (block.timed.len > 0, &mut asked.timed),
            (linear.is_none(), &mut asked.curved),
            (linear.is_none() && depends.c_on_t, &mut asked.c),
            (linear.is_none() && depends.c_t, &mut asked.c_t),
            (linear.is_none() && depends.q_d, &mut asked.q_d),
            (facts.has_branches, &mut asked.branches),
        ];
        lists.into_iter().filter(|(asked, _)| *asked).for_each(|(_, list)| list.push(k));
        asked.c_q_on_t |= depends.c_q_on_t;
        if depends.c_on_t { asked.linear.extend(linear) } else { asked.steady.extend(linear) }
    }

    fn append(
        &mut self,
        layout: &Layout,
        name: String,
        constraint: Box<dyn Constraint>,
        planned: &mut Planned,
    ) {
        let first_argument = self.plan.arguments().len();
        let first = self.entries.len();
        planned.columns.clear();
        for argument in constraint.arguments() {
            let place = layout.place(&argument.target).unwrap_or(Place::Ground(0.0));
            self.plan.argument(&argument.target, place, planned);
        }
        let global =
            |entry: &Entry| Some((self.rows + entry.row, (*planned.columns.get(entry.column)?)?));
        let facts = constraint.facts();
        self.entries.extend(facts.pattern.iter().map(global));
        self.constants.extend_from_slice(facts.constants);
        self.constants.resize(self.entries.len(), None);
        let rows = self.rows..self.rows + facts.rows.len();
        self.rows = rows.end;
        let timed = self.timed..self.timed + facts.n_timed;
        self.timed = timed.end;
        self.blocks.push(Block {
            name,
            timed: Span::new(timed),
            arguments: Span::new(first_argument..self.plan.arguments().len()),
            rows: Span::new(rows),
            values: Span::new(first..self.entries.len()),
            constant: self.constants[first..].iter().all(Option::is_some),
            drives: facts.is_driver,
            constraint,
        });
    }

    /// Finds hand-written constraints that are drivers although they do not declare it: their
    /// values change with time.
    pub(crate) fn find_drivers(&mut self, q: &[f64]) {
        /// Times at which no usual law repeats its value. \[s\]
        const TIMES: [f64; 4] = [0.0, 0.073_205_08, 0.414_213_56, 1.732_050_8];
        let silent = |block: &Block| {
            let facts = block.constraint.facts();
            facts.route() == Route::Hand && !block.drives && facts.dependence.c_on_t
        };
        if !self.blocks.iter().any(silent) {
            return;
        }
        let instants = TIMES.map(|t| self.instant_at(t, q));
        let values = |block: &Block, instant: &Instant| {
            let mut c = vec![0.0; block.rows().len()];
            block.constraint.residual(&self.at(block, instant), &mut c);
            c
        };
        let changes = |block: &Block| {
            let first = values(block, &instants[0]);
            instants[1..].iter().any(|instant| values(block, instant) != first)
        };
        let drives: Vec<bool> = self
            .blocks
            .iter()
            .map(|block| block.drives || (silent(block) && changes(block)))
            .collect();
        self.blocks.iter_mut().zip(drives).for_each(|(block, drives)| block.drives = drives);
    }
}
