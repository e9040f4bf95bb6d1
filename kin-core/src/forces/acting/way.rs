//! Evaluates lengths and angles along which forces act: the row of a constraint, a measure of a
//! joint, a coordinate.

use std::f64::consts::TAU;

use super::{Beside, Now};
use crate::ask::measure::Measure;
use crate::coordinates::{Argument, Target};
use crate::model::loads::{Along, Line};
use crate::model::terms::{Moving, measure};
use crate::numbers::algebra::Vec3;
use crate::outcome::error::Result;
use crate::solve::motion::Motion;
use crate::system::System;

/// A length or an angle x, prepared for evaluation.
pub(in crate::forces) enum Way<'a> {
    Row(Beside<'a>),
    Measure(Measured<'a>),
    /// The coordinate in that column, and its body or coordinate.
    Coordinate(usize, Option<Target>),
}

/// A measure of a joint.
pub(in crate::forces) struct Measured<'a> {
    joint: Beside<'a>,
    number: usize,
    /// The times of the motion, with the angle that counts revolutions; empty for a measure that is
    /// no angle.
    counted: Vec<(f64, f64)>,
}

/// The value of a length or an angle at one time.
pub(in crate::forces) struct Seen {
    pub x: f64,
    pub rate: f64,
    /// x_q, as (column of the mechanism, slope).
    pub slopes: Vec<(usize, f64)>,
}

impl<'a> Way<'a> {
    /// Prepares a length or angle. Errors: a name that nothing has, an angle of a joint that is not
    /// finite.
    pub(in crate::forces) fn new(
        system: &'a System,
        motion: &Motion,
        along: &'a Along,
    ) -> Result<Way<'a>> {
        let layout = system.layout();
        let name = match &along.0 {
            Line::Row(x) => return Ok(Way::Row(Beside::new(layout, x.as_ref()))),
            Line::Named(name) => name.as_str(),
        };
        if let Some(place) = system.place_of(name) {
            let joint =
                Beside::new(layout, system.equations().blocks[place.block].constraint.as_ref());
            let mut counted = Vec::new();
            if place.measured.turns {
                let angle = name.of(system, motion)?.value;
                counted.extend(motion.times().iter().copied().zip(angle.values().iter().copied()));
            }
            return Ok(Way::Measure(Measured { joint, number: place.number, counted }));
        }
        let column = name.coordinate(system).ok_or_else(|| system.no_measure(name))?;
        let item = layout.items.iter().rposition(|item| item.first <= column);
        Ok(Way::Coordinate(column, item.map(|item| layout.target(item))))
    }

    pub(in crate::forces) fn seen(&self, now: Now<'_>) -> Seen {
        match self {
            Way::Row(row) => {
                let valued = row.valued(now);
                let pattern = row.constraint.facts().pattern;
                let mut slopes = Vec::new();
                for (entry, value) in pattern.iter().zip(&valued.c_q) {
                    slopes.extend(row.columns[entry.column].map(|column| (column, *value)));
                }
                Seen { x: valued.c[0], rate: valued.rate[0], slopes }
            }
            Way::Measure(measured) => measured.seen(now),
            Way::Coordinate(column, _) => {
                Seen { x: now.q[*column], rate: now.qd[*column], slopes: vec![(*column, 1.0)] }
            }
        }
    }

    /// Returns the bodies and coordinates on which it depends.
    pub(in crate::forces) fn targets(&self) -> Vec<Target> {
        match self {
            Way::Row(beside) | Way::Measure(Measured { joint: beside, .. }) => beside.targets(),
            Way::Coordinate(_, body) => body.iter().copied().collect(),
        }
    }

    /// Returns its arguments, and their points.
    pub(in crate::forces) fn points(&self) -> (Vec<Argument>, Vec<(usize, Vec3)>) {
        match self {
            Way::Row(beside) | Way::Measure(Measured { joint: beside, .. }) => beside.own_points(),
            Way::Coordinate(..) => (Vec::new(), Vec::new()),
        }
    }
}

impl Measured<'_> {
    /// Each slope is the velocity along its coordinate alone, minus the velocity from time.
    fn seen(&self, now: Now<'_>) -> Seen {
        let joint = &self.joint;
        let q = joint.local(now.q, true);
        let mut qd = joint.local(now.qd, false);
        let at = |qd: &[f64]| {
            let moving = Moving { q: &q, qd, ..Moving::default() };
            measure(joint.constraint, self.number, moving, now.t)
        };
        let [x, rate, ..] = at(&qd);
        qd.fill(0.0);
        let [_, still, ..] = at(&qd);
        let mut slopes = Vec::new();
        for (local, column) in joint.columns.iter().enumerate() {
            let Some(column) = column else { continue };
            qd[local] = 1.0;
            slopes.push((*column, at(&qd)[1] - still));
            qd[local] = 0.0;
        }
        Seen { x: self.counted_on(x, now.t), rate, slopes }
    }

    /// Returns the angle x with the number of revolutions at the nearest time of the motion.
    fn counted_on(&self, x: f64, t: f64) -> f64 {
        let falls = matches!(&self.counted[..], [first, .., last] if last.0 < first.0);
        let after =
            self.counted.partition_point(|(time, _)| if falls { *time > t } else { *time < t });
        let near = [after.checked_sub(1), Some(after)]
            .into_iter()
            .flatten()
            .filter_map(|k| self.counted.get(k));
        let near = near.min_by(|a, b| (a.0 - t).abs().total_cmp(&(b.0 - t).abs()));
        near.map_or(x, |(_, angle)| x + TAU * ((angle - x) / TAU).round())
    }
}
