//! States over lanes: the same plan for several mechanisms at once.

use super::{GROUND, StatePlan};
use crate::lanes::{Level, Wide};

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
        for shared in &self.planar {
            let (first, own) = (shared.first as usize, shared.copies[0][0] as usize);
            let (x, y, theta) = (q[first], q[first + 1], q[first + 2]);
            let (mut sin, mut cos) = (states[own + 3], states[own + 4]);
            // Angles that have not moved in any lane, as driven ones in Newton's last step, keep their sine and cosine.
            if theta.differ(states[own + 2]).any() {
                (sin, cos) = theta.sin_cos();
            }
            for &[begin, _] in &shared.copies {
                let Some(state) = states.get_mut(begin as usize..).and_then(|states| states.first_chunk_mut()) else { continue };
                *state = [x, y, theta, sin, cos];
            }
        }
        for shared in &self.spatial {
            let Some(&q) = q.get(shared.first as usize..).and_then(|q| q.first_chunk::<7>()) else { continue };
            super::copy::<_, _, 0>(&spatial(q), &shared.copies, states);
        }
        for shared in &self.coords {
            let value = q[shared.first as usize];
            let (sin, cos) = if shared.trig { value.sin_cos() } else { (value.all(0.0), value.all(0.0)) };
            super::copy::<_, _, 0>(&[value, sin, cos], &shared.copies, states);
        }
    }

    /// The rates of each local column at q̇; those of the ground stay as they are.
    #[inline(always)]
    pub(crate) fn set_wide_rates<S: Level>(&self, qd: &[Wide<S>], rates: &mut [Wide<S>]) {
        for (rate, &column) in rates.iter_mut().zip(&self.columns) {
            if column != GROUND {
                *rate = qd[column as usize];
            }
        }
    }
}

/// R, p and A = (2 e0² − 1) I + 2 e eᵀ + 2 e0 ẽ, as a constraint reads them.
#[inline(always)]
fn spatial<S: Level>([x, y, z, e0, e1, e2, e3]: [Wide<S>; 7]) -> [Wide<S>; 16] {
    let one = x.all(1.0);
    let [a11, a22, a33] = [twice(e0 * e0 + e1 * e1) - one, twice(e0 * e0 + e2 * e2) - one, twice(e0 * e0 + e3 * e3) - one];
    let (a12, a21) = (twice(e1 * e2 - e0 * e3), twice(e1 * e2 + e0 * e3));
    let (a13, a31) = (twice(e1 * e3 + e0 * e2), twice(e1 * e3 - e0 * e2));
    let (a23, a32) = (twice(e2 * e3 - e0 * e1), twice(e2 * e3 + e0 * e1));
    [x, y, z, e0, e1, e2, e3, a11, a12, a13, a21, a22, a23, a31, a32, a33]
}

#[inline(always)]
fn twice<S: Level>(x: Wide<S>) -> Wide<S> {
    x + x
}
