//! States over lanes: the same plan for several mechanisms at once.

use super::{StatePlan, from, take};
use crate::lanes::{Level, Wide};
use crate::state::SPATIAL_STATE;

impl StatePlan {
    /// States of the right number, those of the ground in all lanes.
    pub(crate) fn wide_states<S: Level>(&self, simd: S) -> Vec<Wide<S>> {
        self.states.iter().map(|x| Wide::splat(simd, *x)).collect()
    }

    /// How many columns there are.
    pub(crate) fn n_columns(&self) -> usize {
        self.columns.len()
    }

    /// The states at coordinates q.
    #[inline(always)]
    pub(crate) fn set_wide_states<S: Level>(&self, q: &[Wide<S>], states: &mut [Wide<S>]) {
        let mut copies = &self.planar.copies[..];
        for state in &self.planar.states {
            let own = take(&mut copies, state.readers);
            let (&[x, y, theta], &[_, _, known, sin, cos]) = (from(q, state.first), from(states, own[0][0]));
            // Angles that have not moved in any lane, as driven ones in Newton's last step, keep their sine and cosine.
            let (sin, cos) = if theta.differ(known).any() { theta.sin_cos() } else { (sin, cos) };
            for &[begin, _] in own {
                let Some(state) = states.get_mut(begin as usize..).and_then(|states| states.first_chunk_mut()) else { continue };
                *state = [x, y, theta, sin, cos];
            }
        }
        self.spatial.copy::<_, SPATIAL_STATE, 0>(q, states);
        let mut copies = &self.coords.copies[..];
        for state in &self.coords.states {
            let own = take(&mut copies, state.readers);
            let value = q[state.first as usize];
            let (sin, cos) = if state.trig { value.sin_cos() } else { (value.all(0.0), value.all(0.0)) };
            super::copy::<_, _, 0>(&[value, sin, cos], own, states);
        }
    }
}
