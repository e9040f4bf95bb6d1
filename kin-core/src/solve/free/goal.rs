//! The numbers of a position that wishes and limits are about.

use std::f64::consts::TAU;

use crate::coordinates::{PlanarBody, SpatialBody};
use crate::model::body::{Body, Course};
use crate::numbers::algebra::{Vec2, Vec3};
use crate::system::scaled::Model;

/// A place of a point, a coordinate or a measure of a joint.
#[derive(Clone, Debug)]
pub(crate) enum Wanted {
    /// The point of a planar body whose coordinates begin at `first`.
    Planar {
        first: usize,
        local: [f64; 2],
    },
    /// The point of a spatial body whose coordinates begin at `first`.
    Spatial {
        first: usize,
        local: [f64; 3],
    },
    /// A point of the ground: it does not move.
    Fixed(Vec<f64>),
    Coordinate(usize),
    /// A measure of a joint: its constraint, its number, and whether whole turns are unknown.
    Measure {
        block: usize,
        number: usize,
        turns: bool,
    },
}

/// A wanted number with its scale, or the numbers of a point.
#[derive(Clone, Debug)]
pub(crate) struct Goal {
    pub wanted: Wanted,
    /// The size of each number: 1 for an angle, a typical length for a length.
    pub scale: f64,
    /// The values at the position where the way began, and now: an angle keeps its whole turns.
    pub start: Vec<f64>,
    pub now: Vec<f64>,
}

impl Goal {
    pub(crate) fn new(model: &Model<'_>, t: f64, q: &[f64], wanted: Wanted, scale: f64) -> Self {
        let mut goal = Goal { wanted, scale, start: Vec::new(), now: Vec::new() };
        goal.start = goal.values(model, t, q);
        goal.now.clone_from(&goal.start);
        goal
    }

    /// Returns the values at q.
    pub(crate) fn values(&self, model: &Model<'_>, t: f64, q: &[f64]) -> Vec<f64> {
        let still = vec![0.0; q.len()];
        self.orders(model, t, q, &still, &still).into_iter().map(|[value, ..]| value).collect()
    }

    /// Returns each value at q with its first and second derivative along a motion with velocities
    /// v and accelerations a.
    pub(crate) fn orders(
        &self,
        model: &Model<'_>,
        t: f64,
        q: &[f64],
        v: &[f64],
        a: &[f64],
    ) -> Vec<[f64; 3]> {
        let course = |columns: std::ops::Range<usize>| {
            let [q, qd, qdd] = [q, v, a].map(|all| all.get(columns.clone()).unwrap_or_default());
            Course { q, qd, qdd, qddd: &[] }
        };
        match &self.wanted {
            Wanted::Planar { first, local: [x, y] } => {
                let [r, v, a, _] = PlanarBody::point(Vec2::new(*x, *y), course(*first..*first + 3));
                vec![[r.x, v.x, a.x], [r.y, v.y, a.y]]
            }
            Wanted::Spatial { first, local: [x, y, z] } => {
                let local = Vec3::new(*x, *y, *z);
                let [r, v, a, _] = SpatialBody::point(local, course(*first..*first + 7));
                vec![[r.x, v.x, a.x], [r.y, v.y, a.y], [r.z, v.z, a.z]]
            }
            Wanted::Fixed(place) => place.iter().map(|x| [*x, 0.0, 0.0]).collect(),
            Wanted::Coordinate(column) => vec![[q[*column], v[*column], a[*column]]],
            Wanted::Measure { block, number, turns } => {
                let equations = model.equations;
                let block = &equations.blocks[*block];
                let [mut x, v, a, _] = equations.measure(block, *number, t, [q, v, a, &[]]);
                if let (true, Some(now)) = (turns, self.now.first()) {
                    x += TAU * ((now - x) / TAU).round();
                }
                vec![[x, v, a]]
            }
        }
    }
}
