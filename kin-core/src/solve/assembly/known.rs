//! Counts how often starts have led to each known pose of a group, and estimates the number of
//! missing poses.

use super::label::canonical;
use crate::coordinates::layout::Kind;
use crate::coordinates::units::Unit;
use crate::system::scaled::{Measures, Model};

/// Two poses are equal if no coordinate differs by more than this. \[-\]
const SAME: f64 = 1e-5;

/// The expected number of missing poses at which a search ends. \[-\]
const MISSING: f64 = 0.1;

/// The smallest number of hits of each pose. If only one start leads to a pose, there are probably
/// others like it.
pub(super) const OFTEN: usize = 4;

/// A pose, and how often starts without knowledge of it have led there.
pub(super) struct Pose {
    pub q: Vec<f64>,
    canonical: Vec<f64>,
    hits: usize,
}

pub(super) struct Known<'a> {
    model: Model<'a>,
    measures: &'a Measures,
    pub poses: Vec<Pose>,
    /// The number of starts that have led to a pose, and the number of starts since the last new
    /// pose.
    hits: usize,
    pub idle: usize,
}

impl<'a> Known<'a> {
    pub(super) fn new(model: Model<'a>, measures: &'a Measures) -> Self {
        Known { model, measures, poses: Vec::new(), hits: 0, idle: 0 }
    }

    /// Returns the index of a pose among the known poses.
    pub(super) fn find(&self, q: &[f64]) -> Option<usize> {
        let pose = canonical(self.model.layout, self.measures, q);
        self.poses.iter().position(|known| self.difference(&known.canonical, &pose).0 < SAME)
    }

    /// Records that a start has led to a known pose.
    pub(super) fn hit(&mut self, place: usize) {
        self.hits += 1;
        self.poses[place].hits += 1;
    }

    /// Stores a new pose. `is_chance` is false if its start was pushed away from the others.
    pub(super) fn keep(&mut self, q: Vec<f64>, is_chance: bool) {
        let canonical = canonical(self.model.layout, self.measures, &q);
        self.poses.push(Pose { q, canonical, hits: usize::from(is_chance) });
        self.hits += usize::from(is_chance);
        self.idle = 0;
    }

    /// Returns the expected number of missing poses: w (w + 1) / (N − w − 2) for w poses and N
    /// hits, if nothing is known about the probability of each pose (C. G. E. Boender, A. H. G.
    /// Rinnooy Kan, Bayesian stopping rules for multistart global optimization methods, Math.
    /// Programming 37, 1987).
    pub(super) fn missing(&self) -> f64 {
        let w = self.poses.len() as f64;
        let n = self.hits as f64;
        if n > w + 2.0 { w * (w + 1.0) / (n - w - 2.0) } else { f64::INFINITY }
    }

    /// Returns the number of hits of the rarest pose.
    pub(super) fn rarest(&self) -> usize {
        self.poses.iter().map(|pose| pose.hits).min().unwrap_or(0)
    }

    /// Returns true if more starts are not worth their time: no new pose for a while, few missing
    /// poses by the estimate, and no pose with hardly any hits.
    pub(super) fn is_settled(&self, patience: usize) -> bool {
        let w = self.poses.len();
        self.idle >= patience + 10 * w
            && (w == 0 || (self.missing() <= MISSING && self.rarest() >= OFTEN))
    }

    /// Returns ∇ln M · Δ for a step y in units of the sizes, with M = Π (1 + ρ²/d_k²) over the
    /// known poses.
    pub(super) fn repulsion(&self, q: &[f64], mut y: Vec<f64>) -> f64 {
        /// ρ², the square of the range of the repulsion. \[-\]
        const RANGE: f64 = 0.05;
        let pose = canonical(self.model.layout, self.measures, q);
        // If the canonical pose has the opposite Euler parameters, the step gets the opposite signs
        // too.
        for item in self.model.layout.items.iter().filter(|item| item.kind == Kind::Spatial) {
            let own = item.first + 3..item.first + 7;
            if q[own.clone()].iter().zip(&pose[own.clone()]).any(|(q, pose)| q * pose < 0.0) {
                y[own].iter_mut().for_each(|y| *y = -*y);
            }
        }
        let gradient = |known: &Pose| {
            let (_, difference, square) = self.difference(&known.canonical, &pose);
            let along: f64 = difference.iter().zip(&y).map(|(d, y)| d * y).sum();
            // ∂ ln(1 + ρ²/d²) = −2 d·∂d / (d² (d²/ρ² + 1)).
            -2.0 * along / (square * (square / RANGE + 1.0)).max(f64::MIN_POSITIVE)
        };
        self.poses.iter().map(gradient).sum()
    }

    /// Returns b − a, with angles by the shorter way and Euler parameters by the nearer sign: the
    /// largest component, all components, and the sum of squares.
    fn difference(&self, a: &[f64], b: &[f64]) -> (f64, Vec<f64>, f64) {
        let mut d: Vec<f64> = a.iter().zip(b).map(|(a, b)| b - a).collect();
        for (d, _) in
            d.iter_mut().zip(&self.model.layout.units).filter(|(_, unit)| **unit == Unit::Radian)
        {
            *d -= std::f64::consts::TAU * (*d / std::f64::consts::TAU).round();
        }
        for item in self.model.layout.items.iter().filter(|item| item.kind == Kind::Spatial) {
            let own = item.first + 3..item.first + 7;
            if a[own.clone()].iter().zip(&b[own.clone()]).map(|(a, b)| a * b).sum::<f64>() < 0.0 {
                own.for_each(|k| d[k] = b[k] + a[k]);
            }
        }
        let largest = d.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
        let square = d.iter().map(|d| d * d).sum();
        (largest, d, square)
    }
}
