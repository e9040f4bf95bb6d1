//! States over lanes: each stands in one place, and constraints read it there.
//!
//! A copy for every reader, as the scalar plan has it, would be more stores than all else that is written in a step.

use super::{GROUND, State, StatePlan, from};
use crate::lanes::{Level, Wide};
use crate::state::{CoordState, PlanarState, SPATIAL_STATE};

/// Where states stand over lanes, and which coordinates make them up.
pub(crate) struct WidePlan {
    /// First coordinate and place.
    planar: Vec<[u32; 2]>,
    spatial: Vec<[u32; 2]>,
    /// The same of bare coordinates, and whether someone reads sine or cosine.
    coords: Vec<([u32; 2], bool)>,
    /// The states where all coordinates are zero; those of the ground are there for good.
    states: Vec<f64>,
}

/// Where states stand that the scalar plan has in many places: by the place there.
pub(crate) struct Moved(Vec<u32>);

/// No place.
const NOWHERE: u32 = u32::MAX;

impl WidePlan {
    pub(crate) fn new(plan: &StatePlan) -> (Self, Moved) {
        let mut wide = WidePlan { planar: Vec::new(), spatial: Vec::new(), coords: Vec::new(), states: Vec::new() };
        let mut moved = Moved(vec![NOWHERE; plan.states.len()]);
        let mut copies = &plan.planar.copies[..];
        for state in &plan.planar.states {
            let place = wide.room(&PlanarState::ground().to_array());
            wide.planar.push([state.first, place]);
            moved.put(state, place, &mut copies);
        }
        let mut copies = &plan.spatial.copies[..];
        for state in &plan.spatial.states {
            let place = wide.room(&[0.0; SPATIAL_STATE]);
            wide.spatial.push([state.first, place]);
            moved.put(state, place, &mut copies);
        }
        let mut copies = &plan.coords.copies[..];
        for state in &plan.coords.states {
            let place = wide.coordinate(state);
            moved.put(state, place, &mut copies);
        }
        (wide, moved)
    }

    /// Room for one more state, which is this where all coordinates are zero.
    fn room(&mut self, state: &[f64]) -> u32 {
        let place = self.states.len() as u32;
        self.states.extend_from_slice(state);
        place
    }

    /// Where a bare coordinate stands: the angle of a planar body has its sine and cosine in the body's state.
    fn coordinate(&mut self, state: &State) -> u32 {
        let angle = state.first.checked_sub(2).and_then(|first| self.planar.binary_search_by_key(&first, |[first, _]| *first).ok());
        if let Some(body) = angle {
            return self.planar[body][1] + 2;
        }
        let place = self.room(&CoordState::new(0.0, true).to_array());
        self.coords.push(([state.first, place], state.trig));
        place
    }

    /// Where the state stands that the scalar plan has there; the ground's gets a place of its own.
    pub(crate) fn place(&mut self, plan: &StatePlan, moved: &Moved, scalar: usize, length: usize) -> u32 {
        if moved.0[scalar] != NOWHERE {
            return moved.0[scalar];
        }
        self.room(&plan.states[scalar..scalar + length])
    }

    /// The states where all coordinates are zero.
    pub(crate) fn states<S: Level>(&self, simd: S) -> Vec<Wide<S>> {
        self.states.iter().map(|x| Wide::splat(simd, *x)).collect()
    }

    /// The states at coordinates q.
    #[inline(always)]
    pub(crate) fn set_states<S: Level>(&self, q: &[Wide<S>], states: &mut [Wide<S>]) {
        for &[first, place] in &self.planar {
            let &[x, y, theta] = from(q, first);
            let Some(state) = own(states, place) else { continue };
            let [_, _, known, sin, cos] = *state;
            // Angles that have not moved in any lane, as driven ones in Newton's last step, keep their sine and cosine.
            let (sin, cos) = if theta.differ(known).any() { theta.sin_cos() } else { (sin, cos) };
            *state = [x, y, theta, sin, cos];
        }
        for &[first, place] in &self.spatial {
            let Some(state) = own::<_, SPATIAL_STATE>(states, place) else { continue };
            *state = *from(q, first);
        }
        for &([first, place], trig) in &self.coords {
            let Some(state) = own(states, place) else { continue };
            let value = q[first as usize];
            let (sin, cos) = if trig { value.sin_cos() } else { (value.all(0.0), value.all(0.0)) };
            *state = [value, sin, cos];
        }
    }
}

/// The N numbers that begin there.
#[inline(always)]
fn own<T, const N: usize>(all: &mut [T], place: u32) -> Option<&mut [T; N]> {
    all.get_mut(place as usize..place as usize + N)?.first_chunk_mut()
}

impl Moved {
    /// All readers of a state find it there.
    fn put(&mut self, state: &State, place: u32, copies: &mut &[super::Copies]) {
        super::take(copies, state.readers).iter().for_each(|[scalar, _]| self.0[*scalar as usize] = place);
    }
}

impl StatePlan {
    /// How many columns there are.
    pub(crate) fn n_columns(&self) -> usize {
        self.columns.len()
    }

    /// The coordinate whose rate a local column has, or `ground`.
    pub(crate) fn coordinate(&self, column: usize, ground: u32) -> u32 {
        if self.columns[column] == GROUND { ground } else { self.columns[column] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coordinates::{Coordinate, Target, Trig, any_planar, any_spatial};
    use crate::layout::Place;

    #[test]
    fn every_argument_finds_its_own_state_once() {
        let (own, ground) = (|first| Place::Own { item: 0, first }, Place::Ground(0.0));
        let coordinate = |trig| Target::Coord(Coordinate::Planar(any_planar(), 2), trig);
        let arguments = [
            (Target::Planar(any_planar()), own(0), 5),
            (Target::Planar(any_planar()), ground, 5),
            (coordinate(Trig::Used), own(2), 3),
            (Target::Spatial(any_spatial()), own(4), 7),
            (Target::Planar(any_planar()), own(0), 5),
            (coordinate(Trig::Used), own(3), 3),
            (coordinate(Trig::Used), Place::Ground(0.25), 3),
            (Target::Spatial(any_spatial()), ground, 7),
        ];
        let mut plan = StatePlan::default();
        let begins: Vec<usize> = arguments.iter().map(|(target, place, _)| plan.argument(target, *place).0).collect();
        plan.finish();
        let (mut wide, moved) = WidePlan::new(&plan);
        let places: Vec<u32> = begins.iter().zip(&arguments).map(|(begin, (.., n))| wide.place(&plan, &moved, *begin, *n)).collect();
        assert_eq!(places[0], places[4]);
        assert_eq!(places[2], places[0] + 2);
        let simd = pulp::Scalar::new();
        let (mut scalar, mut states) = (plan.origin().to_vec(), wide.states(simd));
        // An angle of zero first: its state is there before it has moved.
        for theta in [0.0, 0.7, 0.7, -2.0] {
            let q: Vec<f64> = [1.0, 2.0, theta, 0.3].into_iter().chain((0..7).map(|k| 0.1 * f64::from(k))).collect();
            plan.set_states(&q, &mut scalar);
            wide.set_states(&q.iter().map(|x| Wide::splat(simd, *x)).collect::<Vec<_>>(), &mut states);
            for ((begin, place), (.., length)) in begins.iter().zip(&places).zip(&arguments) {
                let found: Vec<f64> = states[*place as usize..][..*length].iter().map(|x| x.as_slice()[0]).collect();
                assert_eq!(found, scalar[*begin..begin + length]);
            }
        }
    }
}
