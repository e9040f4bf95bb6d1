//! Determines the rotation of bodies: between two times, about their length, and in a common plane.

use std::f64::consts::FRAC_PI_2;

use kin::{Coordinate, Motion, Result, Vec3};

use super::Drawing;
use super::joints::Samples;
use super::track::Track;
use crate::scene::{Body, Kind, Scene};

/// Between two poses that are farther apart nothing is drawn: a straight way between them would
/// take bodies apart that a joint holds together.      [rad]
pub(crate) const LEAP: f64 = 0.6;
/// A body that turns about its own length by less shows no mark.   [rad]
const SEEN: f64 = 0.05;
/// Directions that differ by less are one, and lengths by this share of the size of all.
const SAME: f64 = 1e-6;

/// The largest angle by which a body turns from each time to the next. A planar body whose origin
/// stands still counts for nothing: its angle alone changes, and a straight way between two angles
/// is its true way.
pub(super) fn turns(scene: &Scene, motion: &Motion) -> Result<Vec<f64>> {
    let mut most = vec![0.0_f64; motion.len().saturating_sub(1)];
    for look in scene.looks.iter().filter(|look| !look.body.is_ground()) {
        let own = match look.body.0 {
            Kind::Planar(_) => planar(&Track::of(motion, look.body)?),
            Kind::Spatial(_) => spatial(motion, look.body)?,
        };
        for (most, turn) in most.iter_mut().zip(own) {
            *most = most.max(turn);
        }
    }
    Ok(most)
}

fn planar(track: &Track) -> Vec<f64> {
    let Track::Planar([x, y, theta]) = track else { return Vec::new() };
    let stays = |values: &[f64]| values.windows(2).all(|w| w[0] == w[1]);
    if stays(x) && stays(y) {
        return Vec::new();
    }
    theta.windows(2).map(|w| (w[1] - w[0]).abs()).collect()
}

/// From Euler parameters, and from their rates: two whole turns leave the parameters as they were.
fn spatial(motion: &Motion, body: Body) -> Result<Vec<f64>> {
    let Kind::Spatial(body) = body.0 else { return Ok(Vec::new()) };
    let all = (3..7)
        .map(|k| motion.coordinate(Coordinate::Spatial(body, k)))
        .collect::<Result<Vec<_>>>()?;
    let dot =
        |k: usize| all.iter().map(|e| e.value.values()[k] * e.value.values()[k + 1]).sum::<f64>();
    let speed = |k: usize| 2.0 * all.iter().map(|e| e.rate.values()[k].powi(2)).sum::<f64>().sqrt();
    let times = motion.times();
    let turn = |k: usize| {
        let by_rate = 0.5 * (speed(k) + speed(k + 1)) * (times[k + 1] - times[k]).abs();
        by_rate.max(2.0 * dot(k).clamp(-1.0, 1.0).acos())
    };
    Ok((0..times.len().saturating_sub(1)).map(turn).collect())
}

impl Drawing {
    /// True for each time from which the next one is not reached by a straight way.
    pub fn leaps(&self) -> impl Iterator<Item = bool> + '_ {
        self.turns.iter().map(|turn| *turn > LEAP)
    }

    /// Azimuth and elevation of an eye that looks straight at the plane in which everything moves;
    /// `None` where there is no such plane, or nothing turns in it.   \[rad\]
    pub(super) fn face(&self) -> Option<(f64, f64)> {
        let sampled = self.sampled();
        let moving = || self.tracks.iter().filter(|track| !matches!(track, Track::Ground));
        let turned = moving().flat_map(|track| {
            let first = track.frame(0).a.transpose();
            sampled.iter().map(move |k| {
                let [[_, a, b], [c, _, d], [e, f, _]] = (track.frame(*k).a * first).to_array();
                // sin θ times the axis.
                Vec3::new(f - d, b - e, c - a) * 0.5
            })
        });
        let axis = turned
            .filter(|axis| axis.norm() > SEEN)
            .max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        let normal = axis / axis.norm();
        let in_plane = |track: &Track| {
            let first = track.frame(0);
            sampled.iter().all(|k| {
                let frame = track.frame(*k);
                let tilt = (frame.a * (first.a.transpose() * normal) - normal).norm();
                tilt <= SAME && (frame.r - first.r).dot(normal).abs() <= SAME * self.size
            })
        };
        moving().all(in_plane).then(|| eye_along(normal))
    }
}

/// An eye on the line of a normal, on that side from which x points to the right; y where x is not
/// seen.
fn eye_along(normal: Vec3) -> (f64, f64) {
    if normal.x.hypot(normal.y) <= SAME {
        return (-FRAC_PI_2, FRAC_PI_2);
    }
    // To the right of the eye is (−n_y, n_x, 0).
    let is_right = if normal.y.abs() > SAME { normal.y < 0.0 } else { normal.x > 0.0 };
    let eye = if is_right { normal } else { -normal };
    (eye.y.atan2(eye.x), eye.z.clamp(-1.0, 1.0).asin())
}

impl Samples {
    /// True if a body turns about a direction in it, and farther than this direction swings.
    pub(super) fn turns_about(&self, track: usize, along: Vec3) -> bool {
        let across = perpendicular(along);
        let Some(first) = self.frame(track, 0) else { return false };
        let h = first.a * along;
        let g = first.a * across;
        let twist = |k: usize| {
            let frame = self.frame(track, k)?;
            let to = frame.a * along;
            let now = frame.a * across;
            // g swung along by the least turn that takes h to where it points now.
            let v = h.cross(to);
            let c = h.dot(to);
            let swung = g * c + v.cross(g) + v * (v.dot(g) / (1.0 + c));
            Some([to.dot(swung.cross(now)).atan2(swung.dot(now)).abs(), v.norm().atan2(c)])
        };
        let all = (1..self.len()).filter_map(twist);
        let [turned, swung] =
            all.fold([SEEN, 0.0], |most, [a, b]: [f64; 2]| [most[0].max(a), most[1].max(b)]);
        turned > SEEN && turned > swung
    }

    /// The direction in a body about which it turns, as far as it keeps to one.
    pub(super) fn axis(&self, track: usize) -> Option<Vec3> {
        let first = self.frame(track, 0)?.a.transpose();
        let axis = |k: usize| {
            let [[_, a, b], [c, _, d], [e, f, _]] = (first * self.frame(track, k)?.a).to_array();
            Some(Vec3::new(f - d, b - e, c - a))
        };
        let all = (1..self.len()).filter_map(axis).filter(|axis| axis.norm() > SEEN);
        let most = all.max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        Some(most / most.norm())
    }
}

/// A direction of length 1 across another.
pub(super) fn perpendicular(h: Vec3) -> Vec3 {
    let least = [h.x.abs(), h.y.abs(), h.z.abs()];
    let e = match least {
        [x, y, z] if x <= y && x <= z => Vec3::x(),
        [_, y, z] if y <= z => Vec3::y(),
        _ => Vec3::z(),
    };
    let across = h.cross(e);
    across / across.norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The directions to the right and upwards as an eye sees them.
    fn seen((azimuth, elevation): (f64, f64)) -> [Vec3; 2] {
        let (sin, cos) = azimuth.sin_cos();
        let (high, flat) = elevation.sin_cos();
        let right = Vec3::new(-sin, cos, 0.0);
        let eye = Vec3::new(flat * cos, flat * sin, high);
        [right, eye.cross(right)]
    }

    #[test]
    fn an_eye_straight_before_a_plane_sees_x_to_the_right() {
        for (normal, right, up) in [
            (Vec3::z(), Vec3::x(), Vec3::y()),
            (-Vec3::z(), Vec3::x(), Vec3::y()),
            (Vec3::y(), Vec3::x(), Vec3::z()),
            (-Vec3::y(), Vec3::x(), Vec3::z()),
            (Vec3::x(), Vec3::y(), Vec3::z()),
            (-Vec3::x(), Vec3::y(), Vec3::z()),
        ] {
            let [to_right, upwards] = seen(eye_along(normal));
            assert!(
                (to_right - right).norm() < 1e-12 && (upwards - up).norm() < 1e-12,
                "{normal:?}"
            );
        }
        let normal = Vec3::new(0.48, -0.6, 0.64);
        let [right, up] = seen(eye_along(normal));
        assert!(right.dot(normal).abs() < 1e-12 && up.dot(normal).abs() < 1e-12 && right.x > 0.0);
    }
}
