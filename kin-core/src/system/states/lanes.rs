//! States over lanes: each stands in one place, and constraints read it there.
//!
//! A copy for every reader, as the scalar plan has it, would be more stores than all else that is written in a step.

use super::{GROUND, State, StatePlan, from};
use crate::lanes::{Level, Wide};
use crate::state::{COORD_STATE, PLANAR_STATE, SPATIAL_STATE};

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
            let place = wide.room(PLANAR_STATE);
            wide.planar.push([state.first, place]);
            moved.put(state, place, &mut copies);
        }
        let mut copies = &plan.spatial.copies[..];
        for state in &plan.spatial.states {
            let place = wide.room(SPATIAL_STATE);
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

    /// Room for one more state.
    fn room(&mut self, length: usize) -> u32 {
        let place = self.states.len() as u32;
        self.states.resize(self.states.len() + length, 0.0);
        place
    }

    /// Where a bare coordinate stands: the angle of a planar body has its sine and cosine in the body's state.
    fn coordinate(&mut self, state: &State) -> u32 {
        let angle = state.first.checked_sub(2).and_then(|first| self.planar.binary_search_by_key(&first, |[first, _]| *first).ok());
        if let Some(body) = angle {
            return self.planar[body][1] + 2;
        }
        let place = self.room(COORD_STATE);
        self.coords.push(([state.first, place], state.trig));
        place
    }

    /// Where the state stands that the scalar plan has there; the ground's gets a place of its own.
    pub(crate) fn place(&mut self, plan: &StatePlan, moved: &Moved, scalar: usize, length: usize) -> u32 {
        if moved.0[scalar] != NOWHERE {
            return moved.0[scalar];
        }
        let place = self.states.len() as u32;
        self.states.extend_from_slice(&plan.states[scalar..scalar + length]);
        place
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
