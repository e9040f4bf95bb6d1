//! The norm constraint of Euler parameters, until it is written in the joint library.

use crate::constraint::{Constraint, Route};
use crate::coordinates::{Argument, SpatialBody, Target};
use crate::state::{At, Rates};

/// |p|² − 1 = 0 of a spatial body.   \[–\]
pub(crate) fn euler_norm(b: SpatialBody) -> impl Constraint {
    EulerNorm(b)
}

struct EulerNorm(SpatialBody);

impl Constraint for EulerNorm {
    fn kind(&self) -> &str {
        "euler_norm"
    }

    fn route(&self) -> Route {
        Route::Hand
    }

    fn arguments(&self) -> Vec<Argument> {
        vec![Argument { name: "b", target: Target::Spatial(self.0) }]
    }

    fn rows(&self) -> &[&str] {
        &["1"]
    }

    fn pattern(&self) -> &[(usize, usize)] {
        &[(0, 3), (0, 4), (0, 5), (0, 6)]
    }

    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        let p = at.spatial(0).p;
        c[0] = p.e0 * p.e0 + p.e1 * p.e1 + p.e2 * p.e2 + p.e3 * p.e3 - 1.0;
    }

    fn jacobian(&self, at: &At<'_>, c_q: &mut [f64]) {
        let p = at.spatial(0).p;
        c_q.copy_from_slice(&[2.0 * p.e0, 2.0 * p.e1, 2.0 * p.e2, 2.0 * p.e3]);
    }

    fn velocity_rhs(&self, _: &At<'_>, rhs: &mut [f64]) {
        rhs[0] = 0.0;
    }

    fn acceleration_rhs(&self, _: &At<'_>, qd: &Rates<'_>, _: f64, q_d: &mut [f64]) {
        q_d[0] = -2.0 * qd.spatial(0).p.iter().map(|e| e * e).sum::<f64>();
    }
}
