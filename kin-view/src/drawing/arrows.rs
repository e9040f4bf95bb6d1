//! Draws arrows of forces on tracks, and chooses the scale of the arrows.

use kin::{Motion, Vec3};

use super::{Drawing, Track};
use crate::scene::{Acting, Arrow, Scene};

/// A force or torque, its foot fixed in a track.
pub(crate) struct Push {
    pub name: String,
    pub acting: Acting,
    pub is_torque: bool,
    pub track: usize,
    pub local: Vec3,
    /// The components of the force, a vector for each time.
    pub vectors: Vec<Vec3>,
}

/// How forces, or torques, are drawn; zeros where there are none.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scale {
    /// Length of a unit.   \[m/N, m/(N m)\]
    pub length: f64,
    /// Turn of a unit of torque in the plane.   \[rad/(N m)\]
    pub turn: f64,
    pub unit: String,
}

/// The largest force is drawn this long, as a share of the size of the mechanism.
const LONG: f64 = 0.22;

/// A peak does not shrink all others: one that is larger by this than all forces but at this share
/// of the times is cut there.   \[-\]
const CUT: f64 = 1.5;
const BUT: f64 = 0.03;

/// Half a turn is a round number of units, and at least this share of the largest torque.   \[-\]
const HALF: f64 = 0.85;

/// A foot stays where it is in a body to this share of the size of the mechanism.
const FIXED: f64 = 1e-9;

impl Drawing {
    /// Takes the arrows of a scene, if they are of this motion.
    pub(super) fn push(&mut self, scene: &Scene, motion: &Motion) {
        for arrow in scene.arrows.iter().filter(|arrow| arrow.vectors.len() == motion.len()) {
            let (track, local) = self.foot(scene, arrow);
            self.pushes.push(Push {
                name: arrow.name.clone(),
                acting: arrow.acting,
                is_torque: arrow.is_torque,
                track,
                local,
                vectors: arrow.vectors.clone(),
            });
        }
        self.scales = [false, true].map(|is_torque| self.scale(scene, is_torque));
        self.longest = CUT * LONG * self.size;
        self.make_room();
    }

    /// A place in the body, or a track of its own where the point moves in the body.
    fn foot(&mut self, scene: &Scene, arrow: &Arrow) -> (usize, Vec3) {
        let body = self.track(scene, arrow.body).unwrap_or(0);
        let local =
            arrow.points.first().map_or(Vec3::zeros(), |p| self.tracks[body].frame(0).local(*p));
        let stays = |(k, p): (usize, &Vec3)| {
            (self.tracks[body].frame(k).point(local) - *p).norm() <= FIXED * self.size
        };
        if arrow.points.iter().enumerate().all(stays) {
            return (body, local);
        }
        self.tracks.push(Track::of_point(&arrow.points, arrow.points.len()));
        (self.tracks.len() - 1, Vec3::zeros())
    }

    fn scale(&self, scene: &Scene, is_torque: bool) -> Scale {
        let all = || self.pushes.iter().filter(|push| push.is_torque == is_torque);
        let largest_at = |k: usize| all().map(|push| push.vectors[k].norm()).fold(0.0, f64::max);
        let mut sizes: Vec<f64> =
            (0..self.times.len()).map(largest_at).filter(|x| x.is_finite()).collect();
        sizes.sort_by(f64::total_cmp);
        let usual = sizes.len().saturating_sub(1 + (BUT * sizes.len() as f64) as usize);
        let Some(size) = sizes.get(usual).copied().filter(|size| *size > 0.0) else {
            return Scale::default();
        };
        let unit = scene.arrows.iter().find(|arrow| arrow.is_torque == is_torque);
        Scale {
            length: LONG * self.size / size,
            turn: std::f64::consts::PI / round_above(HALF * size),
            unit: unit.map_or(String::new(), |arrow| arrow.unit.clone()),
        }
    }

    /// Widens the bounds to all tips.
    fn make_room(&mut self) {
        let [mut low, mut high] = self.bounds;
        for push in self.pushes.iter().filter(|push| !(push.is_torque && self.planar)) {
            for k in self.sampled() {
                let tip = self.tracks[push.track].frame(k).point(push.local) + self.shown(push, k);
                if tip.norm().is_finite() {
                    low = Vec3::new(low.x.min(tip.x), low.y.min(tip.y), low.z.min(tip.z));
                    high = Vec3::new(high.x.max(tip.x), high.y.max(tip.y), high.z.max(tip.z));
                }
            }
        }
        self.bounds = [low, high];
        self.size = (high - low).norm();
    }

    /// An arrow as it is drawn at time k, no longer than the longest.   \[m\]
    pub(crate) fn shown(&self, push: &Push, k: usize) -> Vec3 {
        let vector = push.vectors.get(k).copied().unwrap_or(Vec3::zeros());
        let whole = vector * self.scales[usize::from(push.is_torque)].length;
        whole * (self.longest / whole.norm()).min(1.0)
    }
}

/// Two numbers that differ by this share are one.   \[-\]
const ROUNDING: f64 = 1e-12;

/// The largest of 1, 2 and 5 times a power of ten that is at most x.
pub(crate) fn round_below(x: f64) -> f64 {
    let fits = |round: &f64| *round <= x * (1.0 + ROUNDING);
    round_numbers(x).into_iter().rev().find(fits).unwrap_or(x)
}

/// The smallest of them that is at least x.
fn round_above(x: f64) -> f64 {
    let fits = |round: &f64| *round >= x * (1.0 - ROUNDING);
    round_numbers(x).into_iter().find(fits).unwrap_or(x)
}

/// Round numbers about x, the smallest first.
fn round_numbers(x: f64) -> [f64; 5] {
    let power = 10.0_f64.powf(x.log10().floor());
    // By its digits, so that 0.05 is not 0.05000000000000001.
    [0.5, 1.0, 2.0, 5.0, 10.0]
        .map(|first| format!("{:.0e}", first * power).parse().unwrap_or(first * power))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_round_numbers() {
        let below = [0.07, 0.05, 1.0, 1.99, 2.0, 4.9, 7e5, 9.99].map(round_below);
        assert_eq!(below, [0.05, 0.05, 1.0, 1.0, 2.0, 2.0, 5e5, 5.0]);
        let above = [0.07, 0.05, 1.0, 1.01, 2.1, 4.9, 7e5, 9.99].map(round_above);
        assert_eq!(above, [0.1, 0.05, 1.0, 2.0, 5.0, 5.0, 1e6, 10.0]);
    }
}
