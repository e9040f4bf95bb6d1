//! States of bodies and bare coordinates: evaluated once an iterate, and copied to every constraint that reads them.

mod lanes;

use std::collections::HashMap;

use crate::coordinates::{Target, Trig};
use crate::layout::Place;
use crate::state::{CoordState, PlanarState, SPATIAL_STATE, SpatialState};

/// Which coordinates make up each state, and who reads it.
#[derive(Clone, Debug, Default)]
pub(crate) struct StatePlan {
    planar: Vec<Shared>,
    spatial: Vec<Shared>,
    coords: Vec<Shared>,
    /// Places of a state among those of its kind, by its first coordinate.
    known: HashMap<(Kind, usize), usize>,
    /// The states where all coordinates are zero; those of the ground are there for good.
    states: Vec<f64>,
    /// The coordinate whose rate each local column has; `GROUND` on the ground.
    pub(super) columns: Vec<u32>,
}

/// Stands for the coordinates that the ground does not have.
pub(super) const GROUND: u32 = u32::MAX;

/// A state that several constraints read.
#[derive(Clone, Debug)]
struct Shared {
    /// First coordinate.
    first: u32,
    /// Whether someone reads its sine or cosine (bare coordinates only).
    trig: bool,
    /// Where its state and its rates are copied to, one place or more.
    copies: Vec<[u32; 2]>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Kind {
    Planar,
    Spatial,
    Coord,
}

impl StatePlan {
    /// Plans for one more argument: where its state begins, and its first column.
    pub(super) fn argument(&mut self, target: &Target, place: Place) -> (usize, usize) {
        let begin = (self.states.len(), self.columns.len());
        let (kind, ground, trig): (_, Vec<f64>, _) = match (target, place) {
            (Target::Planar(_), _) => (Kind::Planar, PlanarState::ground().to_array().into(), false),
            (Target::Spatial(_), Place::Own { .. }) => (Kind::Spatial, vec![0.0; SPATIAL_STATE], false),
            (Target::Spatial(_), _) => (Kind::Spatial, SpatialState::ground().to_array().into(), false),
            (Target::Coord(_, trig), Place::Ground(value)) => {
                (Kind::Coord, CoordState::new(value, true).to_array().into(), *trig == Trig::Used)
            }
            (Target::Coord(_, trig), _) => (Kind::Coord, CoordState::new(0.0, true).to_array().into(), *trig == Trig::Used),
        };
        self.states.extend(ground);
        if let Place::Own { first, .. } = place {
            self.share(kind, first, trig, [begin.0 as u32, begin.1 as u32]);
        }
        self.columns.extend((0..target.columns()).map(|k| match place {
            Place::Own { first, .. } => (first + k) as u32,
            Place::Ground(_) => GROUND,
        }));
        begin
    }

    fn share(&mut self, kind: Kind, first: usize, trig: bool, copy: [u32; 2]) {
        let list = match kind {
            Kind::Planar => &mut self.planar,
            Kind::Spatial => &mut self.spatial,
            Kind::Coord => &mut self.coords,
        };
        let k = *self.known.entry((kind, first)).or_insert(list.len());
        match list.get_mut(k) {
            Some(shared) => {
                shared.trig |= trig;
                shared.copies.push(copy);
            }
            None => list.push(Shared { first: first as u32, trig, copies: vec![copy] }),
        }
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
        for Shared { first, copies, .. } in &self.planar {
            let ([x, y, theta], [_, _, known, sin, cos]) = (numbers(q, *first), numbers(states, copies[0][0]));
            // An angle that has not moved, as a driven one in Newton's last step, keeps its sine and cosine.
            let (sin, cos) = if known == theta { (sin, cos) } else { theta.sin_cos() };
            copy::<_, _, 0>(&[x, y, theta, sin, cos], copies, states);
        }
        for Shared { first, copies, .. } in &self.spatial {
            copy::<_, SPATIAL_STATE, 0>(&numbers(q, *first), copies, states);
        }
        for Shared { first, trig, copies } in &self.coords {
            let ([value], [known, sin, cos]) = (numbers(q, *first), numbers(states, copies[0][0]));
            let state = if known == value { [value, sin, cos] } else { CoordState::new(value, *trig).to_array() };
            copy::<_, _, 0>(&state, copies, states);
        }
    }

    /// The rates of each local column at q̇.
    pub(super) fn set_rates(&self, qd: &[f64], rates: &mut [f64]) {
        for Shared { first, copies, .. } in &self.planar {
            copy::<_, 3, 1>(&numbers(qd, *first), copies, rates);
        }
        for Shared { first, copies, .. } in &self.spatial {
            copy::<_, 7, 1>(&numbers(qd, *first), copies, rates);
        }
        for Shared { first, copies, .. } in &self.coords {
            copy::<_, 1, 1>(&numbers(qd, *first), copies, rates);
        }
    }
}

/// N numbers from there on (32 bits: the end does not overflow, so one check will do).
#[inline(always)]
fn numbers<const N: usize>(all: &[f64], first: u32) -> [f64; N] {
    let own = &all[first as usize..first as usize + N];
    std::array::from_fn(|k| own[k])
}

/// Copies a state (`WHAT` 0) or its rates (1) to all its readers.
#[inline(always)]
fn copy<T: Copy, const N: usize, const WHAT: usize>(numbers: &[T; N], copies: &[[u32; 2]], all: &mut [T]) {
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
        let mut states = plan.origin().to_vec();
        for theta in [0.0, 0.5, 0.5, -0.0, f64::NAN, f64::NAN, 0.5, 1e300] {
            plan.set_states(&[1.0, 2.0, theta], &mut states);
            let expected = PlanarState::new([1.0, 2.0, theta]).to_array();
            assert!(states.iter().zip(expected).all(|(a, b)| *a == b || (a.is_nan() && b.is_nan())), "{theta}: {states:?}");
        }
    }
}
