//! States of bodies and bare coordinates: evaluated once an iterate, and copied to every constraint that reads them.

mod lanes;

pub(crate) use lanes::WidePlan;

use crate::coordinates::{Target, Trig};
use crate::layout::Place;
use crate::state::{CoordState, PlanarState, SPATIAL_STATE, SpatialState};

/// Which coordinates make up each state, and who reads it.
#[derive(Clone, Debug, Default)]
pub(crate) struct StatePlan {
    planar: Shared,
    spatial: Shared,
    coords: Shared,
    /// The states where all coordinates are zero; those of the ground are there for good.
    states: Vec<f64>,
    /// The coordinate whose rate each local column has; `GROUND` on the ground.
    pub(super) columns: Vec<u32>,
}

/// Stands for the coordinates that the ground does not have.
pub(super) const GROUND: u32 = u32::MAX;

/// All states of one kind, in the order of their coordinates.
#[derive(Clone, Debug, Default)]
struct Shared {
    states: Vec<State>,
    /// Where states and their rates are copied to, state by state (32 bits: no sum of them overflows, so one check a copy will do).
    copies: Vec<Copies>,
    /// Who reads what, until it is sorted: first coordinate, whether its sine or cosine is wanted, where to.
    asked: Vec<(u32, bool, Copies)>,
}

/// A state that several constraints read.
#[derive(Clone, Copy, Debug)]
struct State {
    /// First coordinate.
    first: u32,
    /// How many read it: at least one.
    readers: u32,
    /// Whether someone reads its sine or cosine (bare coordinates only).
    trig: bool,
}

/// Where a reader has the state, and its rates.
type Copies = [u32; 2];

impl Shared {
    /// Puts together who reads the same state: counts, then places, for systems can be large.
    fn sort(&mut self) {
        let asked = std::mem::take(&mut self.asked);
        let n = asked.iter().map(|(first, ..)| first + 1).max().unwrap_or(0);
        let mut states: Vec<State> = (0..n).map(|first| State { first, readers: 0, trig: false }).collect();
        for (first, trig, _) in &asked {
            let state = &mut states[*first as usize];
            state.readers += 1;
            state.trig |= trig;
        }
        let next = |end: &mut usize, state: &State| Some(std::mem::replace(end, *end + state.readers as usize));
        let mut places: Vec<usize> = states.iter().scan(0, next).collect();
        self.copies = vec![[0; 2]; asked.len()];
        for (first, _, copies) in asked {
            let place = &mut places[first as usize];
            self.copies[*place] = copies;
            *place += 1;
        }
        states.retain(|state| state.readers > 0);
        self.states = states;
    }
}

impl StatePlan {
    /// Plans for one more argument: where its state begins, and its first column.
    pub(super) fn argument(&mut self, target: &Target, place: Place) -> (usize, usize) {
        let begin = (self.states.len(), self.columns.len());
        let zero = if let Place::Ground(value) = place { value } else { 0.0 };
        let (kind, trig) = match target {
            Target::Planar(_) => {
                self.states.extend(PlanarState::ground().to_array());
                (&mut self.planar, false)
            }
            Target::Spatial(_) => {
                let own = matches!(place, Place::Own { .. });
                self.states.extend(if own { [0.0; SPATIAL_STATE] } else { SpatialState::ground().to_array() });
                (&mut self.spatial, false)
            }
            Target::Coord(_, trig) => {
                self.states.extend(CoordState::new(zero, true).to_array());
                (&mut self.coords, *trig == Trig::Used)
            }
        };
        if let Place::Own { first, .. } = place {
            kind.asked.push((first as u32, trig, [begin.0 as u32, begin.1 as u32]));
        }
        self.columns.extend((0..target.columns()).map(|k| match place {
            Place::Own { first, .. } => (first + k) as u32,
            Place::Ground(_) => GROUND,
        }));
        begin
    }

    /// To be called after the last argument.
    pub(super) fn finish(&mut self) {
        [&mut self.planar, &mut self.spatial, &mut self.coords].into_iter().for_each(Shared::sort);
    }

    /// How many numbers states are.
    pub(super) fn len(&self) -> usize {
        self.states.len()
    }

    /// The states where all coordinates are zero; those of the ground are there for good.
    pub(super) fn origin(&self) -> &[f64] {
        &self.states
    }

    /// The states at coordinates q.
    pub(super) fn set_states(&self, q: &[f64], states: &mut [f64]) {
        let mut copies = &self.planar.copies[..];
        for state in &self.planar.states {
            let own = take(&mut copies, state.readers);
            let (&[x, y, theta], &[_, _, known, sin, cos]) = (from(q, state.first), from(states, own[0][0]));
            // An angle that has not moved, as a driven one in Newton's last step, keeps its sine and cosine.
            let (sin, cos) = if known == theta { (sin, cos) } else { theta.sin_cos() };
            copy::<_, _, 0>(&[x, y, theta, sin, cos], own, states);
        }
        self.spatial.copy::<_, SPATIAL_STATE, 0>(q, states);
        let mut copies = &self.coords.copies[..];
        for state in &self.coords.states {
            let own = take(&mut copies, state.readers);
            let (&[value], &[known, sin, cos]) = (from(q, state.first), from(states, own[0][0]));
            let now = if known == value { [value, sin, cos] } else { CoordState::new(value, state.trig).to_array() };
            copy::<_, _, 0>(&now, own, states);
        }
    }

    /// The rates of each local column at q̇; those of the ground stay as they are.
    #[inline(always)]
    pub(super) fn set_rates<T: Copy>(&self, qd: &[T], rates: &mut [T]) {
        self.planar.copy::<_, 3, 1>(qd, rates);
        self.spatial.copy::<_, 7, 1>(qd, rates);
        self.coords.copy::<_, 1, 1>(qd, rates);
    }
}

impl Shared {
    /// Copies N numbers of each state (`WHAT` 0), or of its rates (1), to all who read them.
    #[inline(always)]
    fn copy<T: Copy, const N: usize, const WHAT: usize>(&self, numbers: &[T], all: &mut [T]) {
        let mut copies = &self.copies[..];
        for state in &self.states {
            let own = take(&mut copies, state.readers);
            copy::<_, _, WHAT>(from::<_, N>(numbers, state.first), own, all);
        }
    }
}

/// The N numbers that begin there (32 bits: the end does not overflow, so one check will do).
#[inline(always)]
fn from<T, const N: usize>(all: &[T], first: u32) -> &[T; N] {
    let own = &all[first as usize..first as usize + N];
    own.first_chunk().unwrap_or_else(|| unreachable!("a slice of that length"))
}

/// The copies of the next state.
#[inline(always)]
fn take<'a>(copies: &mut &'a [Copies], readers: u32) -> &'a [Copies] {
    let (own, rest) = copies.split_at(readers as usize);
    *copies = rest;
    own
}

/// Copies a state (`WHAT` 0) or its rates (1) to all its readers.
#[inline(always)]
fn copy<T: Copy, const N: usize, const WHAT: usize>(numbers: &[T; N], copies: &[Copies], all: &mut [T]) {
    for places in copies {
        let begin = places[WHAT] as usize;
        all[begin..begin + N].copy_from_slice(numbers);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coordinates::{Coordinate, any_planar};

    #[test]
    fn one_coordinate_has_one_state_with_sine_if_anyone_asks() {
        let mut plan = StatePlan::default();
        let target = |trig| Target::Coord(Coordinate::Planar(any_planar(), 2), trig);
        let place = Place::Own { item: 0, first: 2 };
        assert_eq!(plan.argument(&target(Trig::Unused), place), (0, 0));
        assert_eq!(plan.argument(&target(Trig::Unused), Place::Ground(1.0)), (3, 1));
        assert_eq!(plan.argument(&target(Trig::Used), place), (6, 2));
        plan.finish();
        let mut states = plan.origin().to_vec();
        plan.set_states(&[0.0, 0.0, 0.5], &mut states);
        let half = CoordState::new(0.5, true).to_array();
        assert_eq!((&states[..3], &states[6..]), (&half[..], &half[..]));
        assert_eq!(states[3], 1.0);
        let mut rates = vec![0.0; plan.columns.len()];
        plan.set_rates(&[0.0, 0.0, 7.0], &mut rates);
        assert_eq!(rates, [7.0, 0.0, 7.0]);
    }

    #[test]
    fn an_angle_that_comes_back_has_its_own_sine_again() {
        let mut plan = StatePlan::default();
        plan.argument(&Target::Planar(any_planar()), Place::Own { item: 0, first: 0 });
        plan.finish();
        let mut states = plan.origin().to_vec();
        for theta in [0.0, 0.5, 0.5, -0.0, f64::NAN, f64::NAN, 0.5, 1e300] {
            plan.set_states(&[1.0, 2.0, theta], &mut states);
            let expected = PlanarState::new([1.0, 2.0, theta]).to_array();
            assert!(states.iter().zip(expected).all(|(a, b)| *a == b || (a.is_nan() && b.is_nan())), "{theta}: {states:?}");
        }
    }
}
