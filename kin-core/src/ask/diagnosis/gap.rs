//! What cannot be met, by how much, and what its drivers ask for.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::model::layout::{Layout, Unit};
use crate::solve::assembly::search::Found;
use crate::system::scaled::Model;

/// A constraint that cannot be met together with all others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Gap {
    /// The constraint.
    pub constraint: String,
    /// Its equations, as they are counted in the system.
    pub rows: Vec<usize>,
    /// Names of its equations, such as `B.x`.
    pub equations: Vec<String>,
    /// What is missing in each equation where all other constraints are met and this one as nearly as was found.   \[unit of the row\]
    pub residual: Vec<f64>,
    /// For a driver of one coordinate: the coordinate, what is asked of it, and where it stands at the nearest.   \[m or rad\]
    pub asks: Option<Asks>,
    /// Whether its equations depend on the others at nearby poses too: then they contradict one another. If not, something does not reach.
    pub lasting: bool,
    /// From how many starts a pose was looked for.
    pub starts: usize,
    /// The other drivers, and what those of one coordinate ask for.
    #[serde(default)]
    pub against: Vec<Against>,
}

/// Another driver where one cannot be met.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Against {
    /// The driver.
    pub constraint: String,
    /// What it asks for, where it is one of one coordinate.
    pub asks: Option<Asks>,
}

/// What a driver asks for and does not get.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Asks {
    /// The coordinate.
    pub coordinate: String,
    /// What is asked.   \[m or rad\]
    pub asked: f64,
    /// Where it stands.   \[m or rad\]
    pub stands: f64,
    /// By how much an angle that is asked of a first position lies beyond its guess; `None` of lengths and of later positions.   \[rad\]
    #[serde(default)]
    pub beyond_guess: Option<f64>,
}

impl Asks {
    pub(super) fn new(coordinate: String, asked: f64, stands: f64) -> Self {
        Asks { coordinate, asked, stands, beyond_guess: None }
    }

    /// Whether an angle is asked for that is more than a turn from its guess, as degrees in the place of radians are.
    pub(super) fn is_more_than_a_turn(&self) -> bool {
        self.beyond_guess.is_some_and(|beyond| beyond.abs() > TAU)
    }

    fn seen_from(&mut self, layout: &Layout, guess: &[f64]) {
        let column = layout.names.iter().position(|name| *name == self.coordinate);
        self.beyond_guess = column.filter(|column| layout.units[*column] == Unit::Radian).map(|column| self.asked - guess[column]);
    }
}

impl Gap {
    /// Notes how far angles that are asked for are from their guess.
    pub(super) fn seen_from(&mut self, layout: &Layout, guess: &[f64]) {
        let others = self.against.iter_mut().filter_map(|other| other.asks.as_mut());
        self.asks.iter_mut().chain(others).for_each(|asks| asks.seen_from(layout, guess));
    }

    /// |C| of the constraint: the length of the gap for a joint that holds two points together.   \[unit of the row\]
    pub fn size(&self) -> f64 {
        self.residual.iter().map(|c| c * c).sum::<f64>().sqrt()
    }
}

pub(super) fn gap(model: &Model<'_>, found: &Found, t: f64, block: usize, starts: usize) -> Gap {
    let block = &model.equations.blocks[block];
    let (rows, point) = (block.rows(), &found.place.point);
    Gap {
        constraint: block.name.clone(),
        equations: rows.clone().map(|row| model.equations.equation(row)).collect(),
        residual: point.c[rows.clone()].to_vec(),
        asks: asks(model, found, t, rows.clone()),
        rows: rows.collect(),
        lasting: false,
        starts,
        against: against(model, found, t, block.name.as_str()),
    }
}

/// The drivers but one.
fn against(model: &Model<'_>, found: &Found, t: f64, but: &str) -> Vec<Against> {
    let drivers = model.equations.blocks.iter().filter(|block| block.drives && block.name != but);
    drivers.map(|block| Against { constraint: block.name.clone(), asks: asks(model, found, t, block.rows()) }).collect()
}

/// For a driver a q_j − f(t) = 0: where the coordinate should be.
fn asks(model: &Model<'_>, found: &Found, t: f64, rows: std::ops::Range<usize>) -> Option<Asks> {
    if rows.len() != 1 || !model.drives(rows.start) {
        return None;
    }
    let mut own = model.entries(&found.place.point.values).filter(|(row, _, value)| *row == rows.start && *value != 0.0);
    let (Some((_, column, value)), None) = (own.next(), own.next()) else { return None };
    let (stands, c) = (found.place.q[column], found.place.point.c[rows.start]);
    let mut q = found.place.q.clone();
    q[column] -= c / value;
    let rounding = 1e-9 * c.abs() + 1e-12 * (value * found.measures.sizes[column]).abs();
    let reached = model.linearize(&q, t).is_ok_and(|point| point.c[rows.start].abs() <= rounding);
    reached.then(|| Asks::new(model.layout.names[column].clone(), q[column], stands))
}
