//! Computes the generalised forces of loads at one time.

mod way;

pub(super) use way::Way;

use super::body::generalised;
use super::wrench::Stand;
use crate::coordinates::layout::{Layout, Place};
use crate::coordinates::{Argument, Target};
use crate::model::constraint::{Attached, Constraint};
use crate::model::loads::{Acting, ForceAlong, Load, OnBody};
use crate::model::state::SpatialState;
use crate::model::terms::Local;
use crate::numbers::algebra::Vec3;
use crate::outcome::error::Result;
use crate::solve::motion::Motion;
use crate::system::System;

/// q, q̇ and q̈ of the whole mechanism at one time.
#[derive(Clone, Copy)]
pub(super) struct Now<'a> {
    pub t: f64,
    pub q: &'a [f64],
    pub qd: &'a [f64],
    pub qdd: &'a [f64],
}

/// The coordinates of the ground as a spatial body.
const GROUND: [f64; 7] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];

/// A constraint that is no equation: an energy, a length, a point with mass.
pub(super) struct Beside<'a> {
    pub constraint: &'a dyn Constraint,
    pub arguments: Vec<Argument>,
    /// The global column of each local one; `None` for the ground.
    pub columns: Vec<Option<usize>>,
    /// For each local column the value of the ground's coordinate, 0 for other columns.
    ground: Vec<f64>,
}

/// The values of such a constraint at one time.
pub(super) struct Valued {
    /// C, and the values of C_q by the pattern.
    pub c: Vec<f64>,
    pub c_q: Vec<f64>,
    /// The velocity C_q q̇ + C_t.
    pub rate: Vec<f64>,
    /// The acceleration C_q q̈ − Q_d.
    pub second: Vec<f64>,
}

impl<'a> Beside<'a> {
    /// Returns the points with mass of a system, with their names and masses.
    pub(super) fn points(system: &'a System) -> Vec<(&'a str, Beside<'a>, f64)> {
        let of = |point: &'a dyn Constraint| Beside::new(system.layout(), point);
        let points = system.loads.points.iter();
        points.map(|(name, point, mass)| (name.as_str(), of(point.as_ref()), *mass)).collect()
    }

    pub(super) fn new(layout: &Layout, constraint: &'a dyn Constraint) -> Self {
        let arguments = constraint.arguments();
        let mut columns = Vec::new();
        let mut ground = Vec::new();
        for argument in &arguments {
            let own = layout.columns(argument);
            let value = |k: usize| match (layout.place(&argument.target), argument.target) {
                (Some(Place::Ground(_)), Target::Spatial(_)) => GROUND[k],
                (Some(Place::Ground(value)), Target::Coord(..)) => value,
                _ => 0.0,
            };
            ground.extend((0..own.len()).map(value));
            columns.extend(own);
        }
        Beside { constraint, arguments, columns, ground }
    }

    /// Returns the local coordinates or velocities.
    pub(super) fn local(&self, all: &[f64], ground: bool) -> Vec<f64> {
        let value = |(column, fixed): (&Option<usize>, &f64)| match column {
            Some(column) => all[*column],
            None if ground => *fixed,
            None => 0.0,
        };
        self.columns.iter().zip(&self.ground).map(value).collect()
    }

    pub(super) fn valued(&self, now: Now<'_>) -> Valued {
        let facts = self.constraint.facts();
        let m = facts.rows.len();
        let pattern = facts.pattern;
        let q = self.local(now.q, true);
        let qd = self.local(now.qd, false);
        let qdd = self.local(now.qdd, false);
        let local = Local::new(&self.arguments, &q, &qd);
        let at = local.at(now.t);
        let mut c = vec![0.0; m];
        let mut c_q = vec![0.0; pattern.len()];
        self.constraint.residual(&at, &mut c);
        self.constraint.jacobian(&at, &mut c_q);
        let mut minus_c_t = vec![0.0; m];
        let mut q_d = vec![0.0; m];
        self.constraint.velocity_rhs(&at, &mut minus_c_t);
        self.constraint.acceleration_rhs(&at, &local.rates(), 1.0, &mut q_d);
        let mut rate: Vec<f64> = minus_c_t.iter().map(|x| -x).collect();
        let mut second: Vec<f64> = q_d.iter().map(|x| -x).collect();
        for (entry, value) in pattern.iter().zip(&c_q) {
            rate[entry.row] += value * qd[entry.column];
            second[entry.row] += value * qdd[entry.column];
        }
        Valued { c, c_q, rate, second }
    }

    /// Returns the bodies and coordinates on which it depends.
    pub(super) fn targets(&self) -> Vec<Target> {
        self.arguments.iter().map(|argument| argument.target).collect()
    }

    /// Returns its arguments, and their points.
    pub(super) fn own_points(&self) -> (Vec<Argument>, Vec<(usize, Vec3)>) {
        let points =
            self.constraint.attachments().into_iter().filter_map(|found| match found.what {
                Attached::Point(u) => Some((found.argument, u)),
                Attached::Direction(_) => None,
            });
        (self.arguments.clone(), points.collect())
    }

    /// Returns Σ f_row C_q of the rows, in local columns.
    pub(super) fn along(&self, valued: &Valued, f: &[f64]) -> Vec<f64> {
        let mut by_q = vec![0.0; self.columns.len()];
        for (entry, value) in self.constraint.facts().pattern.iter().zip(&valued.c_q) {
            by_q[entry.column] += f[entry.row] * value;
        }
        by_q
    }
}

/// A part of a load, prepared for evaluation.
pub(super) enum Part<'a> {
    Potential(Beside<'a>),
    Along(Way<'a>, &'a ForceAlong),
    OnBody { on: &'a OnBody, first: usize },
}

/// A load, prepared for evaluation.
pub(super) struct Laid<'a> {
    pub parts: Vec<Part<'a>>,
}

impl<'a> Laid<'a> {
    /// Prepares all loads of a system along a motion, with their names. Errors: an angle of a joint
    /// that is not finite.
    pub(super) fn all(system: &'a System, motion: &Motion) -> Result<Vec<(&'a str, Laid<'a>)>> {
        let loads = system.loads.loads.iter();
        loads.map(|(name, load)| Ok((name.as_str(), Laid::new(system, motion, load)?))).collect()
    }

    fn new(system: &'a System, motion: &Motion, load: &'a Load) -> Result<Self> {
        let layout = system.layout();
        let mut all = Vec::new();
        let mut parts = Vec::new();
        load.parts(&mut |part| all.push(part));
        for part in all {
            match part {
                Acting::Potential(energy) => {
                    parts.push(Part::Potential(Beside::new(layout, energy.as_ref())));
                }
                Acting::Along(x, force) => {
                    parts.push(Part::Along(Way::new(system, motion, x)?, force))
                }
                Acting::OnBody(on) => {
                    if let Some(Place::Own { first, .. }) = layout.place(&on.target) {
                        parts.push(Part::OnBody { on, first });
                    }
                }
                Acting::Sum(_) => {}
            }
        }
        Ok(Laid { parts })
    }

    /// Adds the generalised forces of the load to those of the mechanism.
    pub(super) fn add(&self, now: Now<'_>, all: &mut [f64]) {
        for part in &self.parts {
            match part {
                Part::Potential(energy) => {
                    scatter(&energy.columns, &energy.along(&energy.valued(now), &[-1.0]), all);
                }
                Part::Along(x, force) => {
                    let seen = x.seen(now);
                    let f = force.at(seen.x, seen.rate, now.t);
                    seen.slopes.iter().for_each(|(column, slope)| all[*column] += f * slope);
                }
                Part::OnBody { on, first } => {
                    let n = on.target.columns();
                    let columns: Vec<Option<usize>> = (*first..first + n).map(Some).collect();
                    scatter(&columns, &on_body(on, now.t, &now.q[*first..first + n]), all);
                }
            }
        }
    }

    /// Returns the bodies and coordinates on which the load acts.
    pub(super) fn targets(&self) -> Vec<Target> {
        let of = |part: &Part<'_>| match part {
            Part::Potential(beside) => beside.targets(),
            Part::Along(x, _) => x.targets(),
            Part::OnBody { on, .. } => vec![on.target],
        };
        self.parts.iter().flat_map(of).collect()
    }

    /// Returns the arguments of its first part and their points.
    pub(super) fn points(&self) -> (Vec<Argument>, Vec<(usize, Vec3)>) {
        match self.parts.first() {
            Some(Part::Potential(beside)) => beside.own_points(),
            Some(Part::Along(x, _)) => x.points(),
            Some(Part::OnBody { on, .. }) => (
                vec![Argument { name: "body", target: on.target }],
                vec![(0, Vec3::from(on.point))],
            ),
            None => (Vec::new(), Vec::new()),
        }
    }

    /// Returns V of its energies.
    pub(super) fn energy(&self, now: Now<'_>) -> f64 {
        let of = |part: &Part<'_>| match part {
            Part::Potential(energy) => energy.valued(now).c[0],
            _ => 0.0,
        };
        self.parts.iter().map(of).sum()
    }
}

/// Adds local generalised forces to those of the mechanism.
pub(super) fn scatter(columns: &[Option<usize>], by_q: &[f64], all: &mut [f64]) {
    for (column, value) in columns.iter().zip(by_q) {
        if let Some(column) = column {
            all[*column] += value;
        }
    }
}

/// Returns Q of a force at a point and a torque.
fn on_body(on: &OnBody, t: f64, q: &[f64]) -> Vec<f64> {
    let at = |laws: &[crate::law::Law; 3]| Vec3::new(laws[0].at(t), laws[1].at(t), laws[2].at(t));
    let stand = Stand::of(q);
    let mut force = at(&on.force);
    let mut torque = at(&on.torque);
    if on.fixed {
        (force, torque) = (stand.a * force, stand.a * torque);
    }
    let torque = torque + (stand.a * Vec3::from(on.point)).cross(force);
    match q.first_chunk::<7>() {
        Some(q) => {
            generalised(SpatialState::new(*q).p, force, stand.a.transpose() * torque).to_vec()
        }
        None => vec![force.x, force.y, torque.z],
    }
}
