//! Wishes for a position, and how far they were met.

use std::fmt;

use crate::coordinates::Target;
use crate::coordinates::layout::Place;
use crate::coordinates::units::Unit;
use crate::model::body::{Body, Vector};
use crate::outcome::error::{Error, Result};
use crate::outcome::words::time;
use crate::solve::free::{Goal, Wanted};
use crate::system::System;
use crate::system::scaled::Measures;

/// A wish is met if it is missed by at most this share of its size. \[-\]
const MET: f64 = 1e-9;

/// A wish for a position: a point at a target, or a value of a measure or coordinate.
#[derive(Clone, Debug)]
pub struct Wish {
    what: What,
    /// Wishes of a smaller priority come first.
    pub(super) priority: u32,
}

#[derive(Clone, Debug)]
enum What {
    Point { body: Pulled, local: Vec<f64>, target: Vec<f64> },
    Value { name: String, value: f64 },
    Hold { name: String },
}

/// A body by its handle or its name.
#[derive(Clone, Debug)]
enum Pulled {
    Handle(Target),
    Named(String),
}

impl Pulled {
    fn target(&self, system: &System) -> Result<Target> {
        let name = match self {
            Pulled::Handle(target) => return Ok(*target),
            Pulled::Named(name) => name,
        };
        let bodies = system.bodies();
        let found = bodies.iter().find(|(known, _)| known == name).map(|(_, body)| *body);
        found.ok_or_else(|| Error::UnknownName {
            what: "body",
            name: name.clone(),
            known: bodies.iter().map(|(known, _)| (*known).to_string()).collect(),
        })
    }
}

/// The position that wishes led to.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Reached {
    /// The wishes in the order of their priorities, and how far they were met.
    pub wishes: Vec<Granted>,
    /// The limits at whose ends the mechanism stands, by the names of their measures.
    pub limits: Vec<String>,
    /// The freedoms that the wishes and limits leave, by a coordinate for each.
    pub freedoms: Vec<String>,
}

/// How far a wish was met.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Granted {
    /// The measure or coordinate, or the body and its point.
    pub name: String,
    /// True if the wish is met within rounding.
    pub is_met: bool,
    /// By how much the wish is missed: a distance for a point. \[`unit`\]
    pub missed: f64,
    /// The unit of `missed`.
    pub unit: String,
}

impl Wish {
    /// Wishes for the point `local` of a body to be at the target. \[m\]
    pub fn point<B: Body>(
        body: B,
        local: impl Into<B::Vector>,
        target: impl Into<B::Vector>,
    ) -> Wish {
        let list =
            |vector: B::Vector| (0..B::Vector::NAMES.len()).map(|k| vector.component(k)).collect();
        let local = list(local.into());
        let target = list(target.into());
        let body = Pulled::Handle(body.target());
        Wish { what: What::Point { body, local, target }, priority: 0 }
    }

    /// Wishes for the point `local` of a body, by its name, to be at the target: two numbers each
    /// for a planar body, three for a spatial one. \[m\]
    pub fn point_of(body: &str, local: &[f64], target: &[f64]) -> Wish {
        let what = What::Point {
            body: Pulled::Named(body.to_string()),
            local: local.to_vec(),
            target: target.to_vec(),
        };
        Wish { what, priority: 0 }
    }

    /// Wishes for a measure of a joint or a coordinate, by its name, to have a value.
    /// \[m or rad, the unit of the measure\]
    pub fn measure(name: &str, value: f64) -> Wish {
        Wish { what: What::Value { name: name.to_string(), value }, priority: 0 }
    }

    /// Wishes for a measure of a joint or a coordinate to keep its present value.
    pub fn hold(name: &str) -> Wish {
        Wish { what: What::Hold { name: name.to_string() }, priority: 0 }
    }

    /// Sets the priority. The default is 0, and wishes of a smaller number come first.
    #[must_use]
    pub fn priority(self, priority: u32) -> Wish {
        Wish { priority, ..self }
    }

    /// Returns the goal of the wish at a time and position, and its target.
    pub(super) fn goal(
        &self,
        system: &System,
        at: (f64, &[f64]),
        measures: &Measures,
    ) -> Result<(Goal, Vec<f64>)> {
        match &self.what {
            What::Point { body, local, target } => {
                let body = body.target(system)?;
                point(system, at, measures, &body, [local, target])
            }
            What::Value { name, value } => {
                if !value.is_finite() {
                    return Err(not_finite(name, *value));
                }
                Ok((named(system, at, measures, name)?, vec![*value]))
            }
            What::Hold { name } => {
                let goal = named(system, at, measures, name)?;
                let target = goal.start.clone();
                Ok((goal, target))
            }
        }
    }

    /// Returns the name of the wish.
    fn name(&self, system: &System) -> String {
        match &self.what {
            What::Value { name, .. } | What::Hold { name } => name.clone(),
            What::Point { body, local, .. } => {
                let bodies = system.bodies();
                let body = body.target(system).ok();
                let name = bodies.iter().find(|(_, known)| Some(*known) == body);
                let name = name.map(|(name, _)| *name);
                let local: Vec<String> = local.iter().map(|x| time(*x).to_string()).collect();
                format!("{} ({})", name.unwrap_or("ground"), local.join(", "))
            }
        }
    }

    /// Returns how far the wish is met at the place of its goal.
    pub(super) fn granted(&self, system: &System, goal: &Goal, target: &[f64]) -> Granted {
        let changes = goal.now.iter().zip(target).map(|(value, target)| (target - value).powi(2));
        let missed = changes.sum::<f64>().sqrt();
        let most = goal.now.iter().fold(goal.scale, |most, value| most.max(value.abs()));
        Granted {
            name: self.name(system),
            is_met: missed <= MET * most,
            missed,
            unit: unit(system, &goal.wanted),
        }
    }
}

impl fmt::Display for Granted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Granted { name, is_met, missed, unit } = self;
        if *is_met {
            write!(f, "`{name}` is met")
        } else {
            write!(f, "`{name}` is missed by {} {unit}", time(*missed))
        }
    }
}

/// Returns a measure of a joint or a coordinate at a time and position, as a goal.
pub(super) fn named(
    system: &System,
    (t, q): (f64, &[f64]),
    measures: &Measures,
    name: &str,
) -> Result<Goal> {
    let (wanted, scale) = if let Some(place) = system.place_of(name) {
        let turns = place.measured.turns;
        let wanted = Wanted::Measure { block: place.block, number: place.number, turns };
        (wanted, if place.measured.unit == "m" { typical_length(system, measures) } else { 1.0 })
    } else {
        let names = system.coordinate_names();
        let column = names.iter().position(|known| known == name);
        let column = column.ok_or_else(|| system.no_measure(name))?;
        (Wanted::Coordinate(column), measures.sizes[column])
    };
    Ok(Goal::new(&system.model(), t, q, wanted, scale))
}

fn point(
    system: &System,
    (t, q): (f64, &[f64]),
    measures: &Measures,
    body: &Target,
    [local, target]: [&Vec<f64>; 2],
) -> Result<(Goal, Vec<f64>)> {
    let place = system.layout().place(body).ok_or_else(|| Error::ForeignBody {
        mechanism: system.name().to_string(),
        place: "wish".to_string(),
        argument: "body".to_string(),
    })?;
    if let Some(value) = local.iter().chain(target).find(|x| !x.is_finite()) {
        return Err(not_finite("point", *value));
    }
    let expected = if matches!(body, Target::Spatial(_)) { 3 } else { 2 };
    if let Some(numbers) = [local, target].into_iter().find(|numbers| numbers.len() != expected) {
        let what = "a point of this body".to_string();
        return Err(Error::WrongLength { what, expected, found: numbers.len() });
    }
    let wanted = match (place, &local[..]) {
        (Place::Own { first, .. }, &[x, y]) => Wanted::Planar { first, local: [x, y] },
        (Place::Own { first, .. }, &[x, y, z]) => Wanted::Spatial { first, local: [x, y, z] },
        _ => Wanted::Fixed(local.clone()),
    };
    let scale = match wanted {
        Wanted::Planar { first, .. } | Wanted::Spatial { first, .. } => measures.sizes[first],
        _ => typical_length(system, measures),
    };
    Ok((Goal::new(&system.model(), t, q, wanted, scale), target.clone()))
}

fn not_finite(name: &str, value: f64) -> Error {
    Error::InitialNotFinite { name: name.to_string(), coordinate: "the wish".to_string(), value }
}

/// Returns the size of the first length among the coordinates, or 1.
fn typical_length(system: &System, measures: &Measures) -> f64 {
    let units = system.layout().units.iter();
    let length = units.zip(&measures.sizes).find(|(unit, _)| **unit == Unit::Metre);
    length.map_or(1.0, |(_, size)| *size)
}

fn unit(system: &System, wanted: &Wanted) -> String {
    let unit = match wanted {
        Wanted::Coordinate(column) => return system.coordinate_units()[*column].clone(),
        Wanted::Measure { block, number, .. } => {
            system.equations().blocks[*block].constraint.facts().measures[*number].unit
        }
        Wanted::Planar { .. } | Wanted::Spatial { .. } | Wanted::Fixed(_) => "m",
    };
    system.unit_words().in_own_words(unit).to_string()
}
