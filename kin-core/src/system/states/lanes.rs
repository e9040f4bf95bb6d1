//! States over lanes: the same plan for several mechanisms at once.

use super::{COORD_STATE, Coord, PLANAR_STATE, SPATIAL_STATE, StatePlan, from, from_mut};
use crate::model::coordinates::Trig;
use crate::numbers::lanes::{Level, Wide};

impl StatePlan {
    /// The states where all coordinates are zero.
    pub(crate) fn wide_states<S: Level>(&self, simd: S) -> Vec<Wide<S>> {
        self.origin.iter().map(|x| Wide::splat(simd, *x)).collect()
    }

    /// The states at coordinates q.
    #[inline(always)]
    pub(crate) fn set_wide_states<S: Level>(&self, q: &[Wide<S>], states: &mut [Wide<S>]) {
        for &[first, begin] in &self.planar {
            let (&[x, y, theta], state) = (from(q, first), from_mut::<_, PLANAR_STATE>(states, begin));
            let [_, _, known, sin, cos] = *state;
            // Angles that have not moved in any lane, as driven ones in Newton's last step, keep their sine
            // and cosine.
            let (sin, cos) = if theta.differ(known).any() { theta.sin_cos() } else { (sin, cos) };
            *state = [x, y, theta, sin, cos];
        }
        for &[first, begin] in &self.spatial {
            *from_mut::<_, SPATIAL_STATE>(states, begin) = *from(q, first);
        }
        for &Coord { coordinate, begin, trig } in &self.coords {
            let &[value] = from(q, coordinate);
            let (sin, cos) =
                if trig == Trig::Used { value.sin_cos() } else { (value.all(0.0), value.all(0.0)) };
            *from_mut::<_, COORD_STATE>(states, begin) = [value, sin, cos];
        }
    }
}
