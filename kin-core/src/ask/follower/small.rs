//! Small moves: one step of the solver that the last move has left.

use super::Follower;
use crate::solve::step::moves::{Move, Moves};

/// Two directions of moves that differ by less than this are the same. \[-\]
const SAME: f64 = 1e-9;

/// The solver between two small moves, with workspace buffers.
#[derive(Default)]
pub(super) struct Small {
    /// `None` before the first small move, and after another move.
    moves: Option<Box<Moves>>,
    /// The velocities of the drivers in the last move.
    direction: Vec<f64>,
    /// The values of the next move, and which of them the call has given.
    pub targets: Vec<f64>,
    pub given: Vec<bool>,
}

impl Follower {
    /// Moves all drivers to these values by one tested step. Returns false if the move needs more
    /// than one step; the follower is then where it was.
    pub(super) fn step_to(&mut self, targets: &[f64]) -> bool {
        if self.regular.is_some() {
            self.small.moves = None;
            return false;
        }
        let gone = |(driver, target): (&super::Driver, &f64)| target - driver.value.value;
        let all = || self.drivers.iter().zip(targets).map(gone);
        let h = all().fold(0.0_f64, |most, gone| most.max(gone.abs()));
        if h == 0.0 {
            return true;
        }
        if !h.is_normal() {
            return false;
        }
        let mut goes_on = self.small.direction.len() == self.drivers.len();
        self.small.direction.resize(self.drivers.len(), f64::NAN);
        for ((driver, target), last) in
            self.drivers.iter().zip(targets).zip(&mut self.small.direction)
        {
            let velocity = (target - driver.value.value) / h;
            goes_on &= (velocity - *last).abs() <= SAME;
            *last = velocity;
        }
        if self.small.moves.is_none() {
            self.begin_small(h);
            goes_on = false;
        }
        for ((driver, target), velocity) in
            self.drivers.iter().zip(targets).zip(&self.small.direction)
        {
            driver.path.lead([*target, *velocity, 0.0]);
        }
        let Some(moves) = &mut self.small.moves else { return false };
        match moves.step(&self.system, &self.options, Move { h, goes_on }) {
            Some(q) => {
                self.q.copy_from_slice(q);
                self.rest_at(targets);
                self.follow_left_out();
                true
            }
            None => {
                self.small.moves = None;
                self.drivers.iter().for_each(super::Driver::rest);
                false
            }
        }
    }

    /// Begins small moves at the present position.
    #[cold]
    fn begin_small(&mut self, h: f64) {
        // No two drivers have the same velocity, so that no difference of them seems to be still.
        for (k, driver) in self.drivers.iter().enumerate() {
            let velocity = ((k + 2) as f64).sqrt();
            driver.path.lead([driver.value.value + velocity * h, velocity, 0.0]);
        }
        self.small.moves = Moves::begin(&self.system, &self.options, &self.q, h).map(Box::new);
    }
}
