//! Evaluation of a whole system: states once an iterate, then each constraint into its own block of rows and values.

use std::collections::HashMap;
use std::ops::Range;

use crate::constraint::Constraint;
use crate::coordinates::{Target, Trig};
use crate::error::Error;
use crate::layout::{Layout, Place};
use crate::state::{At, CoordState, PlanarRate, PlanarState, RateStates, Rates, SpatialRate, SpatialState, States};

/// One constraint in a system: where its arguments' states, its rows and its values stand.
pub(crate) struct Block {
    pub name: String,
    pub constraint: Box<dyn Constraint>,
    pub slots: Vec<usize>,
    pub rows: Range<usize>,
    pub values: Range<usize>,
}

impl Block {
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

/// Which coordinates make up each state.
#[derive(Clone, Debug, Default)]
pub(crate) struct StatePlan {
    /// First coordinate of each planar body, from slot 1 on.
    planar: Vec<usize>,
    /// First coordinate of each spatial body, from slot 1 on.
    spatial: Vec<usize>,
    /// Each bare coordinate that is named somewhere, and whether someone reads its sine or cosine.
    coords: Vec<(Place, bool)>,
    /// Slots of bodies by their first coordinate, and of bare coordinates by theirs.
    bodies: HashMap<usize, usize>,
    named: HashMap<usize, usize>,
}

impl StatePlan {
    /// The slot of an argument's state; the same body or coordinate has the same slot everywhere.
    pub(crate) fn slot(&mut self, target: &Target, place: Place) -> usize {
        match (target, place) {
            (Target::Planar(_), Place::Own { first, .. }) => *self.bodies.entry(first).or_insert_with(|| push(&mut self.planar, first)),
            (Target::Spatial(_), Place::Own { first, .. }) => *self.bodies.entry(first).or_insert_with(|| push(&mut self.spatial, first)),
            (Target::Planar(_) | Target::Spatial(_), Place::Ground(_)) => 0,
            (Target::Coord(_, trig), place) => self.coord(place, *trig == Trig::Used),
        }
    }

    fn coord(&mut self, place: Place, trig: bool) -> usize {
        let next = self.coords.len();
        let slot = match place {
            Place::Own { first, .. } => *self.named.entry(first).or_insert(next),
            Place::Ground(_) => next,
        };
        match self.coords.get_mut(slot) {
            Some((_, known)) => *known |= trig,
            None => self.coords.push((place, trig)),
        }
        slot
    }

    /// States of the right number, at zero.
    pub(crate) fn states(&self) -> States {
        let mut states = States::default();
        states.planar.resize(1 + self.planar.len(), PlanarState::ground());
        states.spatial.resize(1 + self.spatial.len(), SpatialState::ground());
        states.coords.resize(self.coords.len(), CoordState::new(0.0, true));
        states
    }

    /// Rates of the right number, at zero.
    pub(crate) fn rates(&self) -> RateStates {
        let mut rates = RateStates::default();
        rates.planar.resize(1 + self.planar.len(), PlanarRate::default());
        rates.spatial.resize(1 + self.spatial.len(), SpatialRate::default());
        rates.coords.resize(self.coords.len(), 0.0);
        rates
    }

    /// The states at coordinates q.
    pub(crate) fn set_states(&self, q: &[f64], states: &mut States) {
        for (state, &k) in states.planar[1..].iter_mut().zip(&self.planar) {
            *state = PlanarState::new([q[k], q[k + 1], q[k + 2]]);
        }
        for (state, &k) in states.spatial[1..].iter_mut().zip(&self.spatial) {
            *state = SpatialState::new(std::array::from_fn(|i| q[k + i]));
        }
        for (state, &(place, trig)) in states.coords.iter_mut().zip(&self.coords) {
            *state = CoordState::new(value(q, place), trig);
        }
    }

    /// The rates at q̇.
    pub(crate) fn set_rates(&self, qd: &[f64], rates: &mut RateStates) {
        for (rate, &k) in rates.planar[1..].iter_mut().zip(&self.planar) {
            *rate = PlanarRate { r: [qd[k], qd[k + 1]], theta: qd[k + 2] };
        }
        for (rate, &k) in rates.spatial[1..].iter_mut().zip(&self.spatial) {
            *rate = SpatialRate { r: std::array::from_fn(|i| qd[k + i]), p: std::array::from_fn(|i| qd[k + 3 + i]) };
        }
        for (rate, &(place, _)) in rates.coords.iter_mut().zip(&self.coords) {
            *rate = if let Place::Own { first, .. } = place { qd[first] } else { 0.0 };
        }
    }
}

fn value(q: &[f64], place: Place) -> f64 {
    match place {
        Place::Own { first, .. } => q[first],
        Place::Ground(value) => value,
    }
}

/// Appends a body and gives its slot; slot 0 is the ground's.
fn push(list: &mut Vec<usize>, first: usize) -> usize {
    list.push(first);
    list.len()
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
    pub rows: usize,
}

impl Equations {
    /// Lays the constraints out one after the other. Their arguments must be of this layout.
    pub(crate) fn new(layout: &Layout, constraints: Vec<(String, Box<dyn Constraint>)>) -> Self {
        let mut all = Equations { blocks: Vec::new(), plan: StatePlan::default(), entries: Vec::new(), rows: 0 };
        for (name, constraint) in constraints {
            all.append(layout, name, constraint);
        }
        all
    }

    fn append(&mut self, layout: &Layout, name: String, constraint: Box<dyn Constraint>) {
        let (mut columns, mut slots) = (Vec::new(), Vec::new());
        for argument in constraint.arguments() {
            let place = layout.place(&argument.target).unwrap_or(Place::Ground(0.0));
            slots.push(self.plan.slot(&argument.target, place));
            columns.extend((0..argument.target.columns()).map(|k| match place {
                Place::Own { first, .. } => Some(first + k),
                Place::Ground(_) => None,
            }));
        }
        let first = self.entries.len();
        let global = |&(row, column): &(usize, usize)| Some((self.rows + row, columns.get(column).copied().flatten()?));
        self.entries.extend(constraint.pattern().iter().map(global));
        let rows = self.rows..self.rows + constraint.rows().len();
        self.rows = rows.end;
        self.blocks.push(Block { name, constraint, slots, rows, values: first..self.entries.len() });
    }

    /// C(q, t).
    pub(crate) fn residual(&self, t: f64, states: &States, c: &mut [f64]) -> Result<(), Bad> {
        for block in &self.blocks {
            block.constraint.residual(&At::new(t, states, &block.slots), &mut c[block.rows.clone()]);
        }
        finite(c, "C")
    }

    /// C(q, t) and the values of C_q.
    pub(crate) fn linearize(&self, t: f64, states: &States, c: &mut [f64], values: &mut [f64]) -> Result<(), Bad> {
        for block in &self.blocks {
            let at = At::new(t, states, &block.slots);
            block.constraint.linearize(&at, &mut c[block.rows.clone()], &mut values[block.values.clone()]);
        }
        finite(c, "C")?;
        if values.iter().all(|x| x.is_finite()) {
            return Ok(());
        }
        // What stands on the ground's coordinates does not matter.
        let mut own = values.iter().zip(&self.entries).filter_map(|(value, entry)| entry.map(|(row, _)| (row, value)));
        own.find(|(_, value)| !value.is_finite()).map_or(Ok(()), |(row, _)| Err(Bad { row, quantity: "C_q" }))
    }

    /// −C_t.
    pub(crate) fn velocity_rhs(&self, t: f64, states: &States, rhs: &mut [f64]) -> Result<(), Bad> {
        for block in &self.blocks {
            block.constraint.velocity_rhs(&At::new(t, states, &block.slots), &mut rhs[block.rows.clone()]);
        }
        finite(rhs, "C_t")
    }

    /// Q_d.
    pub(crate) fn acceleration_rhs(&self, t: f64, states: &States, rates: &RateStates, q_d: &mut [f64]) -> Result<(), Bad> {
        for block in &self.blocks {
            let (at, rates) = (At::new(t, states, &block.slots), Rates::new(rates, &block.slots));
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
    pub(crate) fn not_finite(&self, bad: Bad, t: f64, states: &States) -> Error {
        let found = self.block_of(bad.row);
        let expression = found.and_then(|(block, _)| block.constraint.not_finite(&At::new(t, states, &block.slots)));
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
fn finite(rows: &[f64], quantity: &'static str) -> Result<(), Bad> {
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
        assert_eq!(plan.slot(&target(Trig::Unused), place), 0);
        assert_eq!(plan.slot(&target(Trig::Unused), Place::Ground(1.0)), 1);
        assert_eq!(plan.slot(&target(Trig::Used), place), 0);
        let mut states = plan.states();
        plan.set_states(&[0.0, 0.0, 0.5], &mut states);
        assert_eq!((states.coords[0].value, states.coords[0].sin), (0.5, 0.5_f64.sin()));
        assert_eq!((states.coords[1].value, states.coords[1].sin), (1.0, 0.0));
        assert_eq!(states.coords.len(), 2);
    }
}
