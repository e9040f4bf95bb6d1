//! The poses of one group that are known, how often starts have led to each, and how many may be
//! missing.

use super::label::canonical;
use crate::model::layout::Kind;
use crate::model::units::Unit;
use crate::system::scaled::{Measures, Model};

/// Two poses are one where no coordinate differs by more.   \[-\]
const SAME: f64 = 1e-5;

/// So many poses, on average, may be missing where a search ends.   \[-\]
const MISSING: f64 = 0.1;

/// Each pose is met this often at least: one that is met by one start only has others of its kind.
pub(super) const OFTEN: usize = 4;

/// A pose, and how often starts that knew nothing of it have led there.
pub(super) struct Pose {
    pub q: Vec<f64>,
    canonical: Vec<f64>,
    hits: usize,
}

pub(super) struct Known<'a> {
    model: Model<'a>,
    measures: &'a Measures,
    pub poses: Vec<Pose>,
    /// Starts that have led to a pose, and starts since the last one that led to a new pose.
    hits: usize,
    pub idle: usize,
}

impl<'a> Known<'a> {
    pub(super) fn new(model: Model<'a>, measures: &'a Measures) -> Self {
        Known { model, measures, poses: Vec::new(), hits: 0, idle: 0 }
    }

    /// The place of a pose among those that are known.
    pub(super) fn find(&self, q: &[f64]) -> Option<usize> {
        let pose = canonical(self.model.layout, self.measures, q);
        self.poses.iter().position(|known| self.difference(&known.canonical, &pose).0 < SAME)
    }

    /// A start has led to a known pose.
    pub(super) fn hit(&mut self, place: usize) {
        self.hits += 1;
        self.poses[place].hits += 1;
    }

    /// Keeps a new pose; `is_chance` unless its start was led away from the others.
    pub(super) fn keep(&mut self, q: Vec<f64>, is_chance: bool) {
        let canonical = canonical(self.model.layout, self.measures, &q);
        self.poses.push(Pose { q, canonical, hits: usize::from(is_chance) });
        self.hits += usize::from(is_chance);
        self.idle = 0;
    }

    /// The number of poses that are missing, as it is to be expected of as many hits if nothing is
    /// known of how likely each pose is: w (w + 1) / (N − w − 2) of w poses by N hits (C. G. E.
    /// Boender, A. H. G. Rinnooy Kan, Bayesian stopping rules for multistart global optimization
    /// methods, Math. Programming 37, 1987).
    pub(super) fn missing(&self) -> f64 {
        let w = self.poses.len() as f64;
        let n = self.hits as f64;
        if n > w + 2.0 { w * (w + 1.0) / (n - w - 2.0) } else { f64::INFINITY }
    }

    /// How often the pose that was met least was met.
    pub(super) fn rarest(&self) -> usize {
        self.poses.iter().map(|pose| pose.hits).min().unwrap_or(0)
    }

    /// True if more starts are not worth it: nothing new for a while, few poses missing by the
    /// estimate, and none that chance has hardly led to.
    pub(super) fn is_settled(&self, patience: usize) -> bool {
        let w = self.poses.len();
        self.idle >= patience + 10 * w
            && (w == 0 || (self.missing() <= MISSING && self.rarest() >= OFTEN))
    }

    /// ∇ln M · Δ for a step of shares y, M = Π (1 + ρ²/d_k²) over the known poses.
    pub(super) fn repulsion(&self, q: &[f64], mut y: Vec<f64>) -> f64 {
        /// ρ², how far it reaches.   \[-\]
        const RANGE: f64 = 0.05;
        let pose = canonical(self.model.layout, self.measures, q);
        // Where the canonical pose has the other signs of Euler parameters, the step has them too.
        for item in self.model.layout.items.iter().filter(|item| item.kind == Kind::Spatial) {
            let own = item.first + 3..item.first + 7;
            if q[own.clone()].iter().zip(&pose[own.clone()]).any(|(q, pose)| q * pose < 0.0) {
                y[own].iter_mut().for_each(|y| *y = -*y);
            }
        }
        let gradient = |known: &Pose| {
            let (_, difference, square) = self.difference(&known.canonical, &pose);
            let along: f64 = difference.iter().zip(&y).map(|(d, y)| d * y).sum();
            // ∂ ln(1 + ρ²/d²) = −2 d·∂d / (d² (d²/ρ² + 1))
            -2.0 * along / (square * (square / RANGE + 1.0)).max(f64::MIN_POSITIVE)
        };
        self.poses.iter().map(gradient).sum()
    }

    /// b − a, angles by the shorter way, Euler parameters by the nearer of the two signs: the
    /// largest, all, and the sum of squares.
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
