//! Converts a motion to data, and data to a motion.

use std::sync::OnceLock;

use serde::{Deserialize, Serialize};

use super::format::BodyKind;
use super::mechanism::read_units;
use super::names::plain;
use super::{FORMAT, is_first, understood};
use crate::coordinates::MechanismId;
use crate::coordinates::layout::Layout;
use crate::coordinates::units::Units;
use crate::law::Break;
use crate::outcome::error::{Error, Result};
use crate::outcome::motion::CrossedBreak;
use crate::solve::follow::SingularPosition;
use crate::solve::motion::{EngineCounts, Event, Motion, Series, Warning};

/// A motion as data, without loss.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct MotionData {
    /// The version of the data format.
    #[serde(default = "is_first")]
    pub format: u32,
    /// The name of the mechanism.
    pub name: String,
    /// The names of the units of the motion.
    #[serde(default, skip_serializing_if = "Units::is_default")]
    pub units: Units,
    /// The bodies and scalar coordinates in order, with their kinds.
    pub bodies: Vec<(String, BodyKind)>,
    /// The names of the equations.
    pub equations: Vec<String>,
    /// The index of the equation with the largest residual of all times; `None` for a motion
    /// without times.
    pub worst: Option<usize>,
    /// The times.   \[s\]
    pub times: Vec<f64>,
    /// q at each time.   \[m, rad\]
    pub q: Vec<Vec<f64>>,
    /// q̇ at each time.   \[m/s, rad/s\]
    pub qd: Vec<Vec<f64>>,
    /// q̈ at each time.   \[m/s², rad/s²\]
    pub qdd: Vec<Vec<f64>>,
    /// q⃛ at each time; empty if the run did not compute the jerk. \[m/s³, rad/s³\]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub qddd: Vec<Vec<f64>>,
    /// The number of Newton steps at each time.
    pub iterations: Vec<usize>,
    /// The largest residual max |C_i| at each time.
    pub residuals: Vec<f64>,
    /// The breaks of laws that the run has crossed.
    #[serde(default)]
    pub breaks: Vec<BreakData>,
    /// The events of the motion.
    #[serde(default)]
    pub events: Vec<Event>,
    /// The singular positions of the run.
    #[serde(default)]
    pub singular_positions: Vec<SingularPosition>,
    /// The warnings of the motion.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Warning>,
    /// The guess from which the run found the first position; empty if the motion does not begin a
    /// run. \[m, rad\]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub guess: Vec<f64>,
    /// The contradiction of redundant equations as a share of their norms; 0 unless the options of
    /// the run allow a contradiction. \[-\]
    #[serde(default)]
    pub misfit: f64,
    /// The number of times that a compiled program has computed, and the number of returns to the
    /// step-by-step solver.
    #[serde(default, skip_serializing_if = "is_plain")]
    pub engine: EngineCounts,
    /// The reason why the step-by-step solver computed everything although a compiled program would
    /// have been faster; otherwise `None`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why_not_compiled: Option<String>,
    /// The derived quantities.
    pub outputs: Vec<OutputData>,
}

/// A break of a law that a run has crossed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct BreakData {
    /// The last time before the break, and the first time at or after the break. \[s\]
    pub between: (f64, f64),
    /// The constraint that contains the law.
    pub constraint: String,
    /// The name of the law in the constraint.
    pub law: String,
    /// The argument of the law at the break.
    pub x: f64,
    /// The order of the lowest derivative that jumps.
    pub order: usize,
}

/// A derived quantity of a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct OutputData {
    /// The name.
    pub name: String,
    /// The unit.
    pub unit: String,
    /// The values, one for each time.
    pub values: Vec<f64>,
}

impl Motion {
    /// Returns the motion as data for serde.
    pub fn data(&self) -> MotionData {
        let rows = |row: fn(&Motion, usize) -> &[f64]| {
            (0..self.len()).map(|k| row(self, k).to_vec()).collect()
        };
        let output = |series: &Series| OutputData {
            name: series.name().into(),
            unit: series.unit().into(),
            values: series.values().to_vec(),
        };
        MotionData {
            format: FORMAT,
            name: self.name().to_string(),
            units: self.layout.words.clone(),
            bodies: self
                .layout
                .items
                .iter()
                .map(|item| (item.name.clone(), item.kind.into()))
                .collect(),
            equations: self.equations.to_vec(),
            worst: self.worst.map(|(_, row)| row),
            times: self.times().to_vec(),
            q: rows(Motion::q),
            qd: rows(Motion::qd),
            qdd: rows(Motion::qdd),
            qddd: if self.has_jerk() { rows(Motion::qddd) } else { Vec::new() },
            iterations: self.iterations().to_vec(),
            residuals: self.residuals().to_vec(),
            breaks: self.breaks.iter().map(BreakData::of).collect(),
            events: self.events.clone(),
            singular_positions: self.singular.clone(),
            guess: self.guess.clone(),
            warnings: self.warnings().to_vec(),
            misfit: self.misfit,
            engine: self.engine,
            why_not_compiled: self.plain.as_deref().map(str::to_string),
            outputs: self.outputs().iter().map(output).collect(),
        }
    }

    /// Creates a motion from data. [`Motion::named`], [`Motion::planar_named`] and
    /// [`Motion::spatial_named`] find its coordinates and bodies by name.
    ///
    /// Errors: a name is empty or taken; lists have different lengths; a number is not finite.
    pub fn from_data(data: &MotionData) -> Result<Motion> {
        let fail =
            |reason: String| Error::Data { place: format!("motion of `{}`", data.name), reason };
        understood(data.format, FORMAT).map_err(fail)?;
        let mut layout = Layout::new(MechanismId::fresh());
        layout.words = read_units(&data.units)?;
        data.check_names()?;
        for (name, kind) in &data.bodies {
            layout.declare(name, (*kind).into())?;
        }
        let times = data.times.len();
        let width = layout.len();
        let flat = |what: &str, rows: &[Vec<f64>]| match rows.len() == times
            && rows.iter().all(|row| row.len() == width)
        {
            true => Ok(rows.concat()),
            false => Err(fail(format!("{what} needs {times} rows of {width} numbers"))),
        };
        let q = flat("q", &data.q)?;
        let qd = flat("qd", &data.qd)?;
        let qdd = flat("qdd", &data.qdd)?;
        let qddd = if data.qddd.is_empty() { Vec::new() } else { flat("qddd", &data.qddd)? };
        if data.iterations.len() != times || data.residuals.len() != times {
            return Err(fail(format!("iterations and residuals need {times} numbers")));
        }
        if data.worst.is_some_and(|row| row >= data.equations.len()) {
            return Err(fail("the worst equation is none of the equations".to_string()));
        }
        if !(data.guess.is_empty() || data.guess.len() == width) {
            return Err(fail(format!("the guess needs {width} numbers")));
        }
        if let Some(value) = data.numbers().find(|x| !x.is_finite()) {
            return Err(fail(format!("{value} is among its numbers")));
        }
        let largest = data.residuals.iter().copied().fold(0.0, f64::max);
        let mut motion = Motion {
            name: data.name.clone(),
            layout: layout.into(),
            equations: data.equations.as_slice().into(),
            times: data.times.clone(),
            q,
            qd,
            qdd,
            qddd,
            iterations: data.iterations.clone(),
            residuals: data.residuals.clone(),
            worst: data.worst.map(|row| (largest, row)),
            breaks: data.breaks.iter().map(BreakData::crossed).collect(),
            events: data.events.clone(),
            singular: data.singular_positions.clone(),
            guess: data.guess.clone(),
            begun: Vec::new(),
            turned_before: false,
            warnings: OnceLock::from(data.warnings.clone()),
            misfit: data.misfit,
            engine: data.engine,
            plain: data.why_not_compiled.as_deref().map(Into::into),
            outputs: Vec::new(),
        };
        for output in &data.outputs {
            motion.add_output(&output.name, &output.unit, output.values.clone())?;
        }
        Ok(motion)
    }
}

fn is_plain(counts: &EngineCounts) -> bool {
    *counts == EngineCounts::default()
}

impl MotionData {
    /// Returns an error for a name that moves the cursor of a terminal.
    fn check_names(&self) -> Result<()> {
        let bodies = self.bodies.iter().map(|(name, _)| ("body", name));
        let equations = self.equations.iter().map(|name| ("equation", name));
        let outputs =
            self.outputs.iter().flat_map(|one| [("output", &one.name), ("unit", &one.unit)]);
        let all =
            [("motion", &self.name)].into_iter().chain(bodies).chain(equations).chain(outputs);
        for (what, name) in all {
            plain(what, name)?;
        }
        Ok(())
    }

    /// Returns all numbers that must be finite.
    fn numbers(&self) -> impl Iterator<Item = f64> {
        let rows = [&self.q, &self.qd, &self.qdd, &self.qddd].into_iter().flatten().flatten();
        let happened = self.events.iter().map(|event| &event.t);
        let singular = self.singular_positions.iter().flat_map(SingularPosition::numbers);
        let alone =
            self.guess.iter().chain([&self.misfit]).chain(&self.times).chain(&self.residuals);
        alone.chain(rows).chain(happened).chain(singular).copied()
    }
}

impl BreakData {
    fn of(CrossedBreak { between, constraint, law, found }: &CrossedBreak) -> BreakData {
        BreakData {
            between: *between,
            constraint: constraint.clone(),
            law: law.clone(),
            x: found.x,
            order: found.order,
        }
    }

    fn crossed(&self) -> CrossedBreak {
        let found = Break { x: self.x, order: self.order };
        CrossedBreak {
            between: self.between,
            constraint: self.constraint.clone(),
            law: self.law.clone(),
            found,
        }
    }
}
