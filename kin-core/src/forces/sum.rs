//! Sums the generalised forces of everything except constraints at each time, with energies and
//! powers.

use super::acting::{Beside, Laid, Now, scatter};
use super::body::{self, Moved};
use super::friction::Rub;
use crate::coordinates::layout::Kind;
use crate::outcome::error::{Error, Result};
use crate::system::System;

/// The generalised forces of everything except constraints, and their powers.
pub(super) struct Sum<'a> {
    system: &'a System,
    loads: &'a [(&'a str, Laid<'a>)],
    points: &'a [(&'a str, Beside<'a>, f64)],
    /// Q_e + Q_v − M q̈, by coordinates of the mechanism.
    pub(super) by_q: Vec<f64>,
    /// The generalised forces of one load.
    own: Vec<f64>,
}

/// The energies and powers at one time.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct At {
    pub kinetic: f64,
    pub potential: f64,
    /// dT/dt, from differentiating T.
    pub rate: f64,
    pub drives: f64,
    pub loads: f64,
    pub weight: f64,
    pub friction: f64,
    /// The largest power of any force on any coordinate.
    pub largest: f64,
}

impl At {
    pub(super) fn take_friction(&mut self, rubs: &[Rub]) {
        for power in rubs.iter().map(|rub| rub.amount * rub.rate) {
            self.friction += power;
            self.raise(power);
        }
    }

    fn raise(&mut self, power: f64) {
        self.largest = self.largest.max(power.abs());
    }
}

impl<'a> Sum<'a> {
    pub(super) fn new(
        system: &'a System,
        loads: &'a [(&'a str, Laid<'a>)],
        points: &'a [(&'a str, Beside<'a>, f64)],
    ) -> Self {
        Sum { system, loads, points, by_q: Vec::new(), own: Vec::new() }
    }

    /// Returns Q_e + Q_v − M q̈ at one time. Errors: a load that is not finite.
    pub(super) fn generalised(&mut self, now: Now<'_>) -> Result<Vec<f64>> {
        self.at(now)?;
        Ok(self.by_q.clone())
    }

    /// Computes everything at one time. Errors: a load that is not finite.
    pub(super) fn at(&mut self, now: Now<'_>) -> Result<At> {
        let mut at = At::default();
        self.by_q.clear();
        self.by_q.resize(now.q.len(), 0.0);
        self.bodies(now, &mut at);
        self.weigh_points(now, &mut at)?;
        for (name, load) in self.loads {
            let own = &mut self.own;
            let qd = now.qd;
            own.clear();
            own.resize(qd.len(), 0.0);
            load.add(now, own);
            if let Some(bad) = own.iter().find(|x| !x.is_finite()) {
                return Err(not_finite(self.system, name, now.t, *bad));
            }
            for power in own.iter().zip(qd).map(|(q, qd)| q * qd) {
                at.loads += power;
                at.raise(power);
            }
            at.potential += load.energy(now);
            self.by_q.iter_mut().zip(own.iter()).for_each(|(all, own)| *all += own);
        }
        Ok(at)
    }

    fn bodies(&mut self, now: Now<'_>, at: &mut At) {
        let loads = &self.system.loads;
        for (item, solid) in &loads.solids {
            let Some(item) = self.system.layout().items.get(*item) else { continue };
            match item.kind {
                Kind::Planar => {
                    let Some(moved) = moved::<3>(now, item.first) else { continue };
                    self.take(item.first, &body::planar(solid, loads.gravity, moved), now, at)
                }
                Kind::Spatial => {
                    let Some(moved) = moved::<7>(now, item.first) else { continue };
                    self.take(item.first, &body::spatial(solid, loads.gravity, moved), now, at)
                }
                Kind::Angle | Kind::Length => {}
            }
        }
    }

    fn take<const N: usize>(
        &mut self,
        first: usize,
        body: &body::Body<N>,
        now: Now<'_>,
        at: &mut At,
    ) {
        for k in 0..N {
            self.by_q[first + k] += body.weight[k] - body.inertial[k];
            let rate = now.qd[first + k];
            at.weight += body.weight[k] * rate;
            at.raise(body.weight[k] * rate);
            at.raise(body.inertial[k] * rate);
        }
        at.kinetic += body.kinetic[0];
        at.rate += body.kinetic[1];
        at.potential += body.potential;
    }

    /// Adds points with mass: Q = −m r_qᵀ (r̈ − g).
    fn weigh_points(&mut self, now: Now<'_>, at: &mut At) -> Result<()> {
        let gravity = self.system.loads.gravity;
        for (name, point, mass) in self.points {
            let valued = point.valued(now);
            let of = |values: &[f64], f: &dyn Fn(usize, f64) -> f64| -> f64 {
                values.iter().enumerate().map(|(k, x)| f(k, *x)).sum()
            };
            let force: Vec<f64> =
                valued.second.iter().zip(gravity).map(|(second, g)| mass * (g - second)).collect();
            if let Some(bad) = force.iter().find(|x| !x.is_finite()) {
                return Err(not_finite(self.system, name, now.t, *bad));
            }
            scatter(&point.columns, &point.along(&valued, &force), &mut self.by_q);
            at.kinetic += 0.5 * mass * of(&valued.rate, &|_, v| v * v);
            at.rate += mass * of(&valued.rate, &|k, v| v * valued.second[k]);
            at.weight += mass * of(&valued.rate, &|k, v| v * gravity[k]);
            at.potential -= mass * of(&valued.c, &|k, r| r * gravity[k]);
            force.iter().zip(&valued.rate).for_each(|(f, v)| at.raise(f * v));
        }
        Ok(())
    }
}

/// Returns the coordinates of a body from index `first` on, or `None` if there are too few.
fn moved<const N: usize>(now: Now<'_>, first: usize) -> Option<Moved<'_, N>> {
    let [q, qd, qdd] = [now.q, now.qd, now.qdd].map(|all| all.get(first..)?.first_chunk());
    Some(Moved { q: q?, qd: qd?, qdd: qdd? })
}

pub(super) fn not_finite(system: &System, name: &str, t: f64, value: f64) -> Error {
    Error::OutputNotFinite {
        output: format!("force of `{name}`"),
        t,
        units: system.unit_words().clone(),
        value,
    }
}
