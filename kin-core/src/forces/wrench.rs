//! Converts generalised forces to force and torque, and moves them to other points and axes.

use super::body::torque;
use crate::model::state::{PlanarState, SpatialState};
use crate::numbers::algebra::{EulerParameters, Mat3, Vec3};

/// A force and its moment about a point, in some axes. \[N, N m\]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Wrench {
    pub force: Vec3,
    pub torque: Vec3,
}

/// The position of a body: its origin and its axes. \[m\]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stand {
    pub r: Vec3,
    pub a: Mat3,
}

impl Stand {
    /// Returns the position from the body's coordinates; the ground has none.
    pub(super) fn of(q: &[f64]) -> Stand {
        if let Some(q) = q.first_chunk::<7>() {
            let state = SpatialState::new(*q);
            return Stand { r: state.r, a: state.a };
        }
        let Some(q) = q.first_chunk::<3>() else {
            return Stand { r: Vec3::zeros(), a: Mat3::identity() };
        };
        let state = PlanarState::new(*q);
        let a = state.a();
        let a = Mat3::from([[a.m11, a.m12, 0.0], [a.m21, a.m22, 0.0], [0.0, 0.0, 1.0]]);
        Stand { r: Vec3::new(state.r.x, state.r.y, 0.0), a }
    }

    /// Returns r + A ū.
    pub(super) fn point(&self, u: Vec3) -> Vec3 {
        self.r + self.a * u
    }
}

impl Wrench {
    /// Converts the generalised forces on the coordinates of a planar or spatial body to force and
    /// torque about its origin, in global axes.
    pub(super) fn of(q: &[f64], by_q: &[f64]) -> Wrench {
        match (q.first_chunk::<7>(), by_q.first_chunk::<7>(), by_q.first_chunk::<3>()) {
            (Some(q), Some(by_q), _) => {
                let state = SpatialState::new(*q);
                let by_p = EulerParameters::new(by_q[3], by_q[4], by_q[5], by_q[6]);
                let force = Vec3::new(by_q[0], by_q[1], by_q[2]);
                Wrench { force, torque: state.a * torque(state.p, by_p) }
            }
            (None, _, Some([x, y, turn])) => {
                Wrench { force: Vec3::new(*x, *y, 0.0), torque: Vec3::new(0.0, 0.0, *turn) }
            }
            _ => Wrench::default(),
        }
    }

    /// Returns the wrench about another point: T + (r_from − r_to) × F.
    pub(super) fn moved(self, from: Vec3, to: Vec3) -> Wrench {
        Wrench { torque: self.torque + (from - to).cross(self.force), ..self }
    }

    /// Converts the wrench to the axes of a body.
    pub(super) fn seen_from(self, a: Mat3) -> Wrench {
        let back = a.transpose();
        Wrench { force: back * self.force, torque: back * self.torque }
    }

    /// Returns force, then torque.
    pub(super) fn components(self) -> [f64; 6] {
        let [x, y, z] = self.force.to_array();
        let [a, b, c] = self.torque.to_array();
        [x, y, z, a, b, c]
    }

    pub(super) fn plus(self, other: Wrench) -> Wrench {
        Wrench { force: self.force + other.force, torque: self.torque + other.torque }
    }

    pub(super) fn times(self, factor: f64) -> Wrench {
        Wrench { force: self.force * factor, torque: self.torque * factor }
    }
}
