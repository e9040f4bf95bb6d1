//! Computes measures of planar bodies over time: angles between bodies, the transmission angle,
//! instant centres.

use std::f64::consts::{FRAC_PI_2, PI};

use super::{Motion, Quantity};
use crate::coordinates::units::Unit;
use crate::coordinates::{Link, PlanarBody, Target};
use crate::numbers::algebra::Vec2;
use crate::outcome::error::Result;

/// Angular velocities below this share of the largest one of the motion are rounding and count as
/// zero. \[-\]
const STILL: f64 = 1e-12;

/// A direction fixed in a planar body.
///
/// A link gives the direction of the line through its pins. A pair `(body, h)` gives the direction
/// h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    body: PlanarBody,
    h: Vec2,
}

impl<L> From<Link<L>> for Line {
    fn from(link: Link<L>) -> Self {
        Line { body: link.body, h: Vec2::x() }
    }
}

impl<B: Into<PlanarBody>, V: Into<Vec2>> From<(B, V)> for Line {
    fn from((body, h): (B, V)) -> Self {
        Line { body: body.into(), h: h.into() }
    }
}

impl Motion {
    /// Returns θ_a − θ_b over time: the angle of `a` relative to `b` or to the ground. \[rad\]
    ///
    /// The angle is positive counter-clockwise and counts full revolutions.
    ///
    /// Errors: a body belongs to another mechanism.
    pub fn relative_angle(
        &self,
        a: impl Into<PlanarBody>,
        b: impl Into<PlanarBody>,
    ) -> Result<Quantity> {
        let a = self.coordinate(a.into().theta())?;
        let b = self.coordinate(b.into().theta())?;
        let orders = [a.orders(), b.orders()];
        let difference =
            |k: usize| orders[0][k].iter().zip(orders[1][k]).map(|(a, b)| a - b).collect();
        Ok(Quantity::new("relative angle", "rad", self.clock(), [0, 1, 2, 3].map(difference)))
    }

    /// Returns the transmission angle over time: the angle between a coupler and the link that it
    /// drives, from 0 to π/2. \[rad\]
    ///
    /// The closer the angle is to π/2, the better the coupler transmits force. For a four-bar write
    /// `transmission_angle(coupler, rocker)`. For a slider give the direction perpendicular to its
    /// line: `transmission_angle(rod, (ground, vec2(0.0, 1.0)))`. At 0 and π/2 the angle has a
    /// kink, and the derivatives are those of one side.
    ///
    /// Errors: a body belongs to another mechanism.
    pub fn transmission_angle(
        &self,
        coupler: impl Into<Line>,
        driven: impl Into<Line>,
    ) -> Result<Quantity> {
        let coupler = coupler.into();
        let driven = driven.into();
        let mut all = self.relative_angle(coupler.body, driven.body)?;
        let between = coupler.h.y.atan2(coupler.h.x) - driven.h.y.atan2(driven.h.x);
        let [angles, rates, second, third] = all.orders_mut();
        for (k, angle) in angles.iter_mut().enumerate() {
            *angle = (*angle + between).rem_euclid(PI);
            if *angle > FRAC_PI_2 {
                *angle = PI - *angle;
                [&mut *rates, &mut *second, &mut *third]
                    .into_iter()
                    .filter_map(|rates| rates.get_mut(k))
                    .for_each(|rate| *rate = -*rate);
            }
        }
        Ok(all.renamed("transmission angle"))
    }

    /// Returns the instant centre of two planar bodies at each time, in the global frame: the point
    /// that has the same velocity in both bodies. \[m\]
    ///
    /// One body may be the ground. The result is `None` at times at which the bodies do not rotate
    /// relative to each other. The instant centre is (−v_y, v_x)/ω, where v is the relative
    /// velocity at the global origin and ω is the relative angular velocity. Source: Shabana,
    /// *Computational Dynamics*, section 2.4.
    ///
    /// Errors: a body belongs to another mechanism.
    pub fn instant_centre(
        &self,
        a: impl Into<PlanarBody>,
        b: impl Into<PlanarBody>,
    ) -> Result<Vec<Option<Vec2>>> {
        let [a, b] =
            [a.into(), b.into()].map(|body| self.columns(&Target::Planar(body), "instant_centre"));
        let a = a?;
        let b = b?;
        let still = STILL * self.fastest_turn();
        let centre = |k: usize| {
            // The velocity at the origin of the plane that is fixed in the body, and ω.
            let spin = |columns: &std::ops::Range<usize>| match self.orders(k, columns.clone()) {
                [&[x, y, _], &[vx, vy, omega], ..] => [vx + omega * y, vy - omega * x, omega],
                _ => [0.0; 3],
            };
            let a = spin(&a);
            let b = spin(&b);
            let [vx, vy, omega] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
            let centre = Vec2::new(-vy / omega, vx / omega);
            (omega.abs() > still && centre.x.is_finite() && centre.y.is_finite()).then_some(centre)
        };
        Ok((0..self.len()).map(centre).collect())
    }

    /// Returns the largest angular velocity of all planar bodies and times.
    fn fastest_turn(&self) -> f64 {
        let units = self.layout.units.iter().cycle();
        self.qd
            .iter()
            .zip(units)
            .filter(|(_, unit)| **unit == Unit::Radian)
            .fold(0.0, |m, (rate, _)| m.max(rate.abs()))
    }
}
