//! Computes the friction of one joint at one time: where friction acts, and the normal forces at
//! the contacts.

use super::super::acting::Now;
use super::super::body::generalised;
use super::super::wrench::{Stand, Wrench};
use crate::coordinates::Target;
use crate::coordinates::layout::Place;
use crate::model::constraint::Constraint;
use crate::model::loads::{Friction, Seat, Shape};
use crate::model::state::SpatialState;
use crate::numbers::algebra::{Vec3, vec3};
use crate::outcome::error::Result;
use crate::system::System;

/// A joint with friction.
#[derive(Clone, Debug)]
pub(in crate::forces) struct Rubbing {
    /// The name of the joint, and its index.
    pub name: String,
    pub block: usize,
    pub friction: Friction,
    seat: Seat,
}

/// The friction of a joint at one time.
#[derive(Clone, Debug)]
pub(in crate::forces) struct Rub {
    /// The first coordinates of bodies i and j with their number; `None` for the ground.
    first: [Option<(usize, usize)>; 2],
    /// The coordinates of bodies i and j.
    q: [Vec<f64>; 2],
    /// The joint's point and the axis of the pin or slide, in global components.
    point: Vec3,
    pub axis: Vec3,
    /// The directions across the axis about which the friction of a slide, off its line, turns the
    /// body.
    across: Vec<Vec3>,
    slides: bool,
    /// The slip velocity of i in j about or along the axis. \[rad/s, m/s\]
    pub rate: f64,
    /// The friction on body i: a torque about the axis or a force along it. `turning` is a torque
    /// across the axis.
    pub amount: f64,
    pub torque: Vec3,
}

impl Rubbing {
    pub(super) fn new(
        name: &str,
        friction: &Friction,
        block: usize,
        constraint: &dyn Constraint,
    ) -> Result<Rubbing> {
        let seat = friction.seat_in(name, constraint)?;
        Ok(Rubbing { name: name.to_string(), block, friction: *friction, seat })
    }

    /// Returns bodies i and j.
    pub(in crate::forces) fn bodies(&self) -> [Target; 2] {
        self.seat.bodies
    }

    /// Returns the joint's point on body i.
    pub(in crate::forces) fn point(&self) -> (Target, Vec3) {
        (self.seat.bodies[0], self.seat.point)
    }

    /// Returns the place of the friction at one time, with zero amounts.
    pub(super) fn at(&self, system: &System, now: Now<'_>) -> Rub {
        let first = self.seat.bodies.map(|body| place(system, &body));
        let part = |of: &[f64], k: usize| {
            first[k].map_or(Vec::new(), |(first, n)| of[first..first + n].to_vec())
        };
        let q = [0, 1].map(|k| part(now.q, k));
        let stands = [Stand::of(&q[0]), Stand::of(&q[1])];
        let point = stands[0].point(self.seat.point);
        let axis = stands[self.seat.axis_of].a * self.seat.axis;
        let slides = matches!(self.friction.shape, Shape::Slide { .. });
        let planar = matches!(self.seat.bodies[0], Target::Planar(_));
        let z = vec3(0.0, 0.0, 1.0);
        let across = match (slides, planar) {
            (false, _) => Vec::new(),
            (true, true) => vec![z.cross(axis)],
            (true, false) => {
                let other = if axis.z.abs() < 0.8 { z } else { vec3(1.0, 0.0, 0.0) };
                let f = axis.cross(other);
                let f = f * (1.0 / f.norm());
                vec![f, axis.cross(f)]
            }
        };
        let mut rub = Rub {
            first,
            q,
            point,
            axis,
            across,
            slides,
            rate: 0.0,
            amount: 0.0,
            torque: Vec3::zeros(),
        };
        // By virtual work: the power of one unit of friction.
        let unit = rub.spread(system.n_coordinates(), rub.along());
        rub.rate = unit.iter().zip(now.qd).map(|(q, qd)| q * qd).sum();
        rub
    }

    /// Returns the number of contacts.
    pub(super) fn n_contacts(&self) -> usize {
        match self.friction.shape {
            Shape::Pin { length: 0.0, .. } => 1,
            Shape::Slide { .. } if self.seat.holds_turn => 3,
            _ => 2,
        }
    }

    /// Returns the friction along the axis for one newton of normal forces, and across it for one
    /// newton of force across.
    pub(super) fn by_normal_force(&self, rate: f64) -> [f64; 2] {
        let share = self.friction.coefficient * (rate / self.friction.rate).tanh();
        match self.friction.shape {
            Shape::Pin { radius, .. } => [-share * radius, 0.0],
            Shape::Slide { width, .. } => [-share, 0.5 * share * width],
        }
    }

    /// Returns the normal forces at the contacts from the force and torque of the joint on body i
    /// about its point.
    pub(super) fn contacts(&self, rub: &Rub, held: Wrench) -> Vec<Vec3> {
        let h = rub.axis;
        let across = |v: Vec3| v - h * h.dot(v);
        let force = across(held.force);
        let torque = across(held.torque);
        let ends = |length: f64| {
            let bent = torque.cross(h) * (1.0 / length);
            vec![force * 0.5 + bent, force * 0.5 - bent]
        };
        match self.friction.shape {
            Shape::Pin { length: 0.0, .. } => vec![force],
            Shape::Pin { length, .. } => ends(length),
            Shape::Slide { length, width } => {
                let mut all = ends(length);
                if self.seat.holds_turn {
                    // Only the magnitude matters, for friction and for uniqueness. The other sign
                    // would mirror everything without changing a result.
                    all.push(h * (2.0 * h.dot(held.torque) / width));
                }
                all
            }
        }
    }
}

impl Rub {
    /// Returns the number of amounts: along the axis, and across it.
    pub(super) fn n_amounts(&self) -> usize {
        1 + self.across.len()
    }

    /// Returns one unit of friction along the axis.
    fn along(&self) -> Wrench {
        let zero = Vec3::zeros();
        match self.slides {
            true => Wrench { force: self.axis, torque: zero },
            false => Wrench { force: zero, torque: self.axis },
        }
    }

    /// Returns the generalised forces of one unit of each amount.
    pub(super) fn units(&self, n: usize) -> Vec<Vec<f64>> {
        let turned =
            self.across.iter().map(|u| Wrench { force: Vec3::zeros(), torque: u.cross(self.axis) });
        std::iter::once(self.along()).chain(turned).map(|unit| self.spread(n, unit)).collect()
    }

    /// Returns the directions across the axis.
    pub(super) fn across(&self) -> &[Vec3] {
        &self.across
    }

    /// Stores the computed amounts.
    pub(super) fn take(&mut self, amounts: &[f64]) {
        let Some((along, across)) = amounts.split_first() else { return };
        self.amount = *along;
        let turned = self.across.iter().zip(across).map(|(u, amount)| u.cross(self.axis) * *amount);
        self.torque = turned.fold(Vec3::zeros(), |all, turned| all + turned);
    }

    /// Adds the generalised forces of the friction to those of the mechanism.
    pub(in crate::forces) fn scatter(&self, by_q: &mut [f64]) {
        let along = self.along();
        let whole = Wrench {
            force: along.force * self.amount,
            torque: along.torque * self.amount + self.torque,
        };
        let own = self.spread(by_q.len(), whole);
        by_q.iter_mut().zip(own).for_each(|(all, own)| *all += own);
    }

    /// Returns the generalised forces of a force and a torque at the point on body i, and of their
    /// opposite on body j.
    fn spread(&self, n: usize, on_i: Wrench) -> Vec<f64> {
        let mut all = vec![0.0; n];
        for (k, sign) in [(0, 1.0), (1, -1.0)] {
            let Some((first, _)) = self.first[k] else { continue };
            let stand = Stand::of(&self.q[k]);
            let own = on_i.times(sign).moved(self.point, stand.r);
            match self.q[k].first_chunk::<7>() {
                Some(q) => {
                    let p = SpatialState::new(*q).p;
                    let by_q = generalised(p, own.force, stand.a.transpose() * own.torque);
                    all[first..first + 7].copy_from_slice(&by_q);
                }
                None => {
                    all[first..first + 3].copy_from_slice(&[own.force.x, own.force.y, own.torque.z])
                }
            }
        }
        all
    }

    /// Returns the force and torque on body i about the point, from the generalised forces of the
    /// joint.
    pub(super) fn held(&self, by_q: &[f64]) -> Wrench {
        let of = |k: usize| {
            let (first, n) = self.first[k]?;
            let own = Wrench::of(&self.q[k], &by_q[first..first + n]);
            Some(own.moved(Stand::of(&self.q[k]).r, self.point))
        };
        // The ground gets the opposite of the force on the other body.
        of(0).or_else(|| of(1).map(|other| other.times(-1.0))).unwrap_or_default()
    }
}

/// Returns the first coordinate of a body and the number of its coordinates; `None` for the ground.
fn place(system: &System, body: &Target) -> Option<(usize, usize)> {
    match system.layout().place(body) {
        Some(Place::Own { first, .. }) => Some((first, body.columns())),
        _ => None,
    }
}
