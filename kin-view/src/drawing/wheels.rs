//! Draws wheels: a disc on the pitch circle, with marks at the places of teeth.
//!
//! The radius of a wheel does not determine its number of teeth. So Kin chooses one pitch for the
//! marks of wheels that mesh, and the marks of these wheels meet.

use std::f64::consts::TAU;

use kin::{Vec2, vec2};

use super::Style;
use crate::scene::circle;

/// How many marks the smallest wheel of all has, at least and at most; all others must have whole
/// numbers of them, too.
const MARKS: std::ops::RangeInclusive<usize> = 12..=48;
/// How many corners a wheel without marks has.
const CORNERS: usize = 96;
/// How long a mark is, as a share of the pitch.
const MARK: f64 = 0.35;

pub(super) struct Wheel {
    pub track: usize,
    pub centre: Vec2,
    /// Radius of the pitch circle.
    pub radius: f64,
    /// Teeth inside.
    pub ring: bool,
    pub toothed: bool,
    /// The direction in which a tooth (or the mark of a wheel without teeth) stands.   [rad]
    pub tooth: Option<f64>,
}

impl Wheel {
    /// Returns the shapes of the wheel, for the common pitch of all wheels with teeth, if they have
    /// one.
    pub fn drawn(&self, pitch: Option<f64>) -> Vec<(Vec<Vec2>, Style)> {
        let tooth = self.tooth.unwrap_or(0.0);
        let at = |share: f64, angle: f64| {
            self.centre + vec2(angle.cos(), angle.sin()) * (self.radius * share)
        };
        let marks = pitch
            .filter(|_| self.toothed)
            .map(|pitch| (TAU * self.radius / pitch).round() as usize);
        let Some(marks) = marks else {
            let rim: Vec<Vec2> =
                (0..CORNERS).map(|k| at(1.0, tooth + TAU * k as f64 / CORNERS as f64)).collect();
            let spoke = vec![at(if self.ring { 1.08 } else { 0.0 }, tooth), at(1.0, tooth)];
            return self.rim(rim).into_iter().chain([(spoke, Style::Slot)]).collect();
        };
        // Arcs between marks are no longer than those of a wheel without.
        let between = CORNERS.div_ceil(marks);
        let angle = |k: usize| tooth + TAU * k as f64 / (marks * between) as f64;
        let rim: Vec<Vec2> = (0..marks * between).map(|k| at(1.0, angle(k))).collect();
        let depth = MARK * TAU / marks as f64;
        let inside = if self.ring { 1.0 + depth } else { 1.0 - depth };
        let comb = (0..=marks * between).flat_map(|k| {
            let on = at(1.0, angle(k));
            let off = at(inside, angle(k));
            if k % between == 0 { vec![on, off, on] } else { vec![on] }
        });
        self.rim(rim).into_iter().chain([(comb.collect(), Style::Slot)]).collect()
    }

    /// The pitch circle as a disc, or that of a ring with its outer edge.
    fn rim(&self, rim: Vec<Vec2>) -> Vec<(Vec<Vec2>, Style)> {
        if !self.ring {
            return vec![(rim, Style::Plate)];
        }
        let closed = |points: Vec<Vec2>| {
            (points.iter().chain(points.first()).copied().collect(), Style::Slot)
        };
        let outer = rim.iter().map(|p| self.centre + (*p - self.centre) * 1.12).collect();
        vec![closed(rim), closed(outer)]
    }
}

/// A pitch of which the circumference of each wheel is a whole number; `None` if there is none that
/// is neither fine nor coarse.
pub(super) fn pitch(radii: &[f64]) -> Option<f64> {
    let least = radii.iter().copied().reduce(f64::min).filter(|r| *r > 0.0)?;
    let whole = |x: f64| (x - x.round()).abs() < 1e-6;
    let fits = |marks: &usize| {
        radii
            .iter()
            .all(|r| whole(r / least * *marks as f64) && r / least * (*marks as f64) < 400.0)
    };
    MARKS.into_iter().find(fits).map(|marks| TAU * least / marks as f64)
}

/// The edge of a disc.
pub(super) fn disc(centre: Vec2, radius: f64) -> Vec<Vec2> {
    circle(centre, radius, CORNERS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wheels_that_mesh_share_a_pitch_and_others_have_none() {
        let pitch = pitch(&[0.03, 0.05, 0.13]).expect("a pitch");
        for radius in [0.03, 0.05, 0.13] {
            let marks = TAU * radius / pitch;
            assert!((marks - marks.round()).abs() < 1e-6 && marks > 11.0, "{marks}");
        }
        assert!(
            super::pitch(&[1.0, std::f64::consts::SQRT_2]).is_none() && super::pitch(&[]).is_none()
        );
    }
}
