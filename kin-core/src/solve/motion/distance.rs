//! Computes the distance of two points over time.

use num_dual::{Dual3_64, DualNum};

use super::{Body, Motion, PointMotion, Quantity, Vector};
use crate::outcome::error::{Error, Result};

impl Motion {
    /// Returns the distance |r_P − r_Q| of two points over time, with its derivatives. \[m\]
    ///
    /// P is the point with local position `p` of body `a`, and Q is the point with local position
    /// `q` of body `b`. Use the distance for the length of a spring or a cylinder, or for the
    /// clearance of two edges. For the ground pass `PlanarBody::from(ground)` or
    /// `SpatialBody::from(ground)`.
    ///
    /// To find extremes and crossings of the distance, write
    /// `system.extremes(&motion, |m: &Motion| m.distance(arm, (0.4, 0.0), frame, (0.0, 0.3)))?`.
    ///
    /// Errors: a body belongs to another mechanism; the points meet, so the distance has no
    /// derivative.
    pub fn distance<A: Body, B: Body<Vector = A::Vector>>(
        &self,
        a: A,
        p: impl Into<A::Vector>,
        b: B,
        q: impl Into<A::Vector>,
    ) -> Result<Quantity> {
        let p = self.point(a, p)?;
        let q = self.point(b, q)?;
        let mut orders: [Vec<f64>; 4] = Default::default();
        for (k, &t) in self.times().iter().enumerate() {
            let components = (0..<A::Vector as Vector>::NAMES.len())
                .map(|c| component(&p, k, c) - component(&q, k, c));
            // The largest component is factored out, so no square overflows.
            let components: Vec<Dual3_64> = components.collect();
            let size = components.iter().fold(0.0_f64, |m, x| m.max(x.re.abs()));
            let distance =
                components.iter().map(|x| (*x / size).powi(2)).sum::<Dual3_64>().sqrt() * size;
            let all = [distance.re, distance.v1, distance.v2, distance.v3];
            if all.iter().any(|x| !x.is_finite()) {
                return Err(Error::OutputNotFinite {
                    output: "velocity of a distance of zero".to_string(),
                    t,
                    units: self.unit_words().clone(),
                    value: distance.v1,
                });
            }
            let known = if self.has_jerk() { 4 } else { 3 };
            orders.iter_mut().zip(all).take(known).for_each(|(order, x)| order.push(x));
        }
        Ok(Quantity::new("distance", self.unit_words().length(), self.clock(), orders))
    }
}

/// Returns component c of a point at time k as a dual number along the motion.
fn component<V: Vector>(point: &PointMotion<V>, k: usize, c: usize) -> Dual3_64 {
    let at = |all: &[V]| all.get(k).map_or(0.0, |x| x.component(c));
    Dual3_64::new(at(point.r()), at(point.v()), at(point.a()), at(point.jerk()))
}
