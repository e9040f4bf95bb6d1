//! Evaluation of a whole system: states once an iterate, then each constraint into its own block of rows and values.

use std::collections::HashMap;
use std::ops::Range;

use crate::constraint::Constraint;
use crate::coordinates::{Target, Trig};
use crate::error::Error;
use crate::layout::{Layout, Place};
use crate::state::{At, CoordState, PlanarState, Rates, SPATIAL_STATE, SpatialState};

/// One constraint in a system.
pub(crate) struct Block {
    pub name: String,
    pub constraint: Box<dyn Constraint>,
    /// Where its arguments' states, its rows, its values and its columns' rates stand.
    pub states: Range<usize>,
    pub rows: Range<usize>,
    pub values: Range<usize>,
    pub rates: Range<usize>,
    /// Where each argument's state begins among its states, and its first column.
    first_state: Vec<usize>,
    first_column: Vec<usize>,
}

impl Block {
    /// The instant as this constraint sees it.
    pub(crate) fn at<'a>(&'a self, t: f64, states: &'a [f64]) -> At<'a> {
        At::new(t, &states[self.states.clone()], &self.first_state)
    }

    fn rates<'a>(&'a self, rates: &'a [f64]) -> Rates<'a> {
        Rates::new(&rates[self.rates.clone()], &self.first_column)
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

/// Which coordinates make up each state, and who reads it: states are evaluated once an iterate and copied to every constraint on them.
#[derive(Clone, Debug, Default)]
pub(crate) struct StatePlan {
    planar: Vec<Shared>,
    spatial: Vec<Shared>,
    coords: Vec<Shared>,
    /// Places of a state among those of its kind, by its first coordinate.
    known: HashMap<(Kind, usize), usize>,
    /// States of the ground in their places, zero elsewhere.
    states: Vec<f64>,
    /// The coordinate whose rate each local column has; `GROUND` on the ground.
    rates: Vec<u32>,
}

/// Stands for the coordinates that the ground does not have.
const GROUND: u32 = u32::MAX;

/// A state that several constraints read.
#[derive(Clone, Debug)]
struct Shared {
    /// First coordinate.
    first: usize,
    /// Whether someone reads its sine or cosine (bare coordinates only).
    trig: bool,
    /// Where it is copied to (32 bits: no sum of them overflows, so one check a copy will do).
    copies: Vec<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Kind {
    Planar,
    Spatial,
    Coord,
}

impl StatePlan {
    /// Plans for one more argument: where its state begins, and its first column.
    pub(crate) fn argument(&mut self, target: &Target, place: Place) -> (usize, usize) {
        let begin = (self.states.len(), self.rates.len());
        let (kind, ground, trig): (_, Vec<f64>, _) = match (target, place) {
            (Target::Planar(_), _) => (Kind::Planar, PlanarState::ground().to_array().into(), false),
            (Target::Spatial(_), _) => (Kind::Spatial, SpatialState::ground().to_array().into(), false),
            (Target::Coord(_, trig), Place::Ground(value)) => {
                (Kind::Coord, CoordState::new(value, true).to_array().into(), *trig == Trig::Used)
            }
            (Target::Coord(_, trig), _) => (Kind::Coord, CoordState::new(0.0, true).to_array().into(), *trig == Trig::Used),
        };
        self.states.extend(ground);
        if let Place::Own { first, .. } = place {
            self.share(kind, first, trig, begin.0);
        }
        self.rates.extend((0..target.columns()).map(|k| match place {
            Place::Own { first, .. } => (first + k) as u32,
            Place::Ground(_) => GROUND,
        }));
        begin
    }

    fn share(&mut self, kind: Kind, first: usize, trig: bool, copy: usize) {
        let list = match kind {
            Kind::Planar => &mut self.planar,
            Kind::Spatial => &mut self.spatial,
            Kind::Coord => &mut self.coords,
        };
        let k = *self.known.entry((kind, first)).or_insert(list.len());
        match list.get_mut(k) {
            Some(shared) => {
                shared.trig |= trig;
                shared.copies.push(copy as u32);
            }
            None => list.push(Shared { first, trig, copies: vec![copy as u32] }),
        }
    }

    /// States of the right number; those of the ground are there for good.
    pub(crate) fn states(&self) -> Vec<f64> {
        self.states.clone()
    }

    /// Rates of the right number, at zero.
    pub(crate) fn rates(&self) -> Vec<f64> {
        vec![0.0; self.rates.len()]
    }

    /// The states at coordinates q.
    pub(crate) fn set_states(&self, q: &[f64], states: &mut [f64]) {
        for Shared { first, copies, .. } in &self.planar {
            let Some(q) = q.get(*first..).and_then(|q| q.first_chunk()) else { continue };
            copy(&PlanarState::new(*q).to_array(), copies, states);
        }
        for Shared { first, copies, .. } in &self.spatial {
            let Some(q) = q.get(*first..).and_then(|q| q.first_chunk::<SPATIAL_STATE>()) else { continue };
            copy(q, copies, states);
        }
        for Shared { first, trig, copies } in &self.coords {
            copy(&CoordState::new(q[*first], *trig).to_array(), copies, states);
        }
    }

    /// The rates at q̇.
    pub(crate) fn set_rates(&self, qd: &[f64], rates: &mut [f64]) {
        for (rate, source) in rates.iter_mut().zip(&self.rates) {
            *rate = qd.get(*source as usize).copied().unwrap_or(0.0);
        }
    }
}

#[inline(always)]
fn copy<const N: usize>(state: &[f64; N], copies: &[u32], states: &mut [f64]) {
    for &begin in copies {
        let begin = begin as usize;
        states[begin..begin + N].copy_from_slice(state);
    }
}

/// What of a constraint is not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bad {
    /// Global row.
    pub row: usize,
    /// `C`, `C_q`, `C_t`, `Q_d`, `q'` or `q''`.
    pub quantity: &'static str,
}

/// All constraints of a system, and where they write.
pub(crate) struct Equations {
    pub blocks: Vec<Block>,
    pub plan: StatePlan,
    /// Row and column of each value; `None` on the ground.
    pub entries: Vec<Option<(usize, usize)>>,
    /// Values of C_q that never change.
    pub constants: Vec<Option<f64>>,
    pub rows: usize,
}

impl Equations {
    /// Lays the constraints out one after the other. Their arguments must be of this layout.
    pub(crate) fn new(layout: &Layout, constraints: Vec<(String, Box<dyn Constraint>)>) -> Self {
        let mut all = Equations { blocks: Vec::new(), plan: StatePlan::default(), entries: Vec::new(), constants: Vec::new(), rows: 0 };
        for (name, constraint) in constraints {
            all.append(layout, name, constraint);
        }
        all
    }

    fn append(&mut self, layout: &Layout, name: String, constraint: Box<dyn Constraint>) {
        let (first_state, first_rate) = (self.plan.states.len(), self.plan.rates.len());
        let (mut states, mut columns) = (Vec::new(), Vec::new());
        for argument in constraint.arguments() {
            let place = layout.place(&argument.target).unwrap_or(Place::Ground(0.0));
            let (state, column) = self.plan.argument(&argument.target, place);
            states.push(state - first_state);
            columns.push(column - first_rate);
        }
        let first = self.entries.len();
        let own = &self.plan.rates[first_rate..];
        let place = |column: usize| own.get(column).filter(|place| **place != GROUND).map(|place| *place as usize);
        let global = |&(row, column): &(usize, usize)| Some((self.rows + row, place(column)?));
        self.entries.extend(constraint.pattern().iter().map(global));
        self.constants.extend_from_slice(constraint.constants());
        self.constants.resize(self.entries.len(), None);
        let rows = self.rows..self.rows + constraint.rows().len();
        self.rows = rows.end;
        self.blocks.push(Block {
            name,
            constraint,
            states: first_state..self.plan.states.len(),
            rows,
            values: first..self.entries.len(),
            rates: first_rate..self.plan.rates.len(),
            first_state: states,
            first_column: columns,
        });
    }

    /// C(q, t).
    pub(crate) fn residual(&self, t: f64, states: &[f64], c: &mut [f64]) -> Result<(), Bad> {
        for block in &self.blocks {
            block.constraint.residual(&block.at(t, states), &mut c[block.rows.clone()]);
        }
        finite(c, "C")
    }

    /// C(q, t) and the values of C_q, whether they are finite or not.
    pub(crate) fn linearize(&self, t: f64, states: &[f64], c: &mut [f64], values: &mut [f64]) {
        let (mut c, mut values, mut states) = (c, values, states);
        for block in &self.blocks {
            // Blocks lie one after the other: one check for each slice.
            let (own_c, own_values, own_states);
            (own_c, c) = c.split_at_mut(block.rows.len());
            (own_values, values) = values.split_at_mut(block.values.len());
            (own_states, states) = states.split_at(block.states.len());
            block.constraint.linearize(&At::new(t, own_states, &block.first_state), own_c, own_values);
        }
    }

    /// Whether C and the values of C_q are finite. What stands on the ground's coordinates does not matter.
    pub(crate) fn finite(&self, c: &[f64], values: &[f64]) -> Result<(), Bad> {
        finite(c, "C")?;
        let mut own = values.iter().zip(&self.entries).filter_map(|(value, entry)| entry.map(|(row, _)| (row, value)));
        own.find(|(_, value)| !value.is_finite()).map_or(Ok(()), |(row, _)| Err(Bad { row, quantity: "C_q" }))
    }

    /// −C_t.
    pub(crate) fn velocity_rhs(&self, t: f64, states: &[f64], rhs: &mut [f64]) -> Result<(), Bad> {
        for block in &self.blocks {
            block.constraint.velocity_rhs(&block.at(t, states), &mut rhs[block.rows.clone()]);
        }
        finite(rhs, "C_t")
    }

    /// Q_d.
    pub(crate) fn acceleration_rhs(&self, t: f64, states: &[f64], rates: &[f64], q_d: &mut [f64]) -> Result<(), Bad> {
        for block in &self.blocks {
            let (at, rates) = (block.at(t, states), block.rates(rates));
            block.constraint.acceleration_rhs(&at, &rates, 1.0, &mut q_d[block.rows.clone()]);
        }
        finite(q_d, "Q_d")
    }

    /// The constraint that a global row belongs to, and its local row.
    pub(crate) fn block_of(&self, row: usize) -> Option<(&Block, usize)> {
        let block = self.blocks.get(self.blocks.partition_point(|block| block.rows.end <= row))?;
        Some((block, row - block.rows.start))
    }

    /// Name of the equation in a global row, such as `A.x`.
    pub(crate) fn equation(&self, row: usize) -> String {
        self.block_of(row).map(|(block, local)| block.equation(local)).unwrap_or_default()
    }

    /// The error for what is not finite at a time and states.
    pub(crate) fn not_finite(&self, bad: Bad, t: f64, states: &[f64]) -> Error {
        let found = self.block_of(bad.row);
        let expression = found.and_then(|(block, _)| block.constraint.not_finite(&block.at(t, states)));
        Error::NotFinite {
            t,
            constraint: found.map(|(block, _)| block.name.clone()).unwrap_or_default(),
            row: found.map(|(block, local)| block.row(local).to_string()).unwrap_or_default(),
            quantity: bad.quantity,
            expression: expression.map(str::to_string),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coordinates::Coordinate;

    #[test]
    fn one_coordinate_has_one_state_with_sine_if_anyone_asks() {
        let mut plan = StatePlan::default();
        let target = |trig| Target::Coord(Coordinate::Planar(crate::coordinates::any_planar(), 2), trig);
        let place = Place::Own { item: 0, first: 2 };
        assert_eq!(plan.argument(&target(Trig::Unused), place), (0, 0));
        assert_eq!(plan.argument(&target(Trig::Unused), Place::Ground(1.0)), (3, 1));
        assert_eq!(plan.argument(&target(Trig::Used), place), (6, 2));
        let mut states = plan.states();
        plan.set_states(&[0.0, 0.0, 0.5], &mut states);
        let half = CoordState::new(0.5, true).to_array();
        assert_eq!((&states[..3], &states[6..]), (&half[..], &half[..]));
        assert_eq!(states[3], 1.0);
        let mut rates = plan.rates();
        plan.set_rates(&[0.0, 0.0, 7.0], &mut rates);
        assert_eq!(rates, [7.0, 0.0, 7.0]);
    }
}
