//! The circuit of a mechanism: all positions that it reaches while one driver moves, past dead
//! centres.

use crate::ask::follower::Follower;
use crate::outcome::error::{Error, Result};
use crate::outcome::motion::Motion;
use crate::outcome::named_value::NamedValue;
use crate::solve::circuit::{CircuitEnd, Traced, trace};
use crate::solve::follow::CurvePoint;
use crate::solve::newton::Outcome;
use crate::system::System;

/// A position on a circuit.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CircuitPoint {
    /// The arc length from the first position of the circuit. \[-\]
    pub length: f64,
    /// The value of the input, in the unit of the driver.
    pub input: f64,
    /// q. \[m, rad\]
    pub q: Vec<f64>,
    /// The value of the quantity whose extreme this is; the input for a dead centre of the input.
    pub value: f64,
}

/// The whole connected curve of positions that a mechanism with one freedom reaches, by arc length.
///
/// The arc length counts each coordinate divided by its characteristic size, so it has no unit. The
/// circuit passes the dead centres of the input smoothly. Where two circuits cross it goes on
/// smoothly too, and [`Circuit::crossings`] lists the place.
///
/// ```
/// use kin::prelude::*;
///
/// # fn main() -> kin::Result<()> {
/// let mut m = Mechanism::new("rocking four-bar");
/// let crank = m.link("crank", 2.0)?;
/// let coupler = m.link("coupler", 1.5)?;
/// let rocker = m.link("rocker", 2.2)?;
/// m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
/// m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
/// m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
/// m.add("C", revolute(Ground, rocker, vec2(3.5, 0.0), rocker.start()))?;
/// m.add("motor", drive_angle(crank, Law::constant(0.3)))?;
/// let system = m.build()?;
///
/// let circuit = system.circuit("motor", 721)?;
/// assert!(circuit.is_closed());
/// // The crank swings between its two dead centres.
/// assert_eq!(circuit.dead_centres().len(), 2);
/// let curve = circuit.motion().point(coupler, coupler.end())?;
/// assert_eq!(curve.r().len(), 721);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Circuit {
    system: System,
    input: NamedValue,
    /// Times are arc lengths, q̇ and q̈ are derivatives by arc length.
    motion: Motion,
    inputs: Vec<f64>,
    ends: Option<[CircuitEnd; 2]>,
    dead_centres: Vec<CircuitPoint>,
    extremes: Vec<Vec<CircuitPoint>>,
    crossings: Vec<CircuitPoint>,
}

impl System {
    /// Returns the circuit of the assembled position at time 0 as `points` positions, equally
    /// spaced by arc length. The named driver is the input; the other drivers are at rest.
    ///
    /// Errors: those of [`System::follower`]; an unknown driver, with the known ones; fewer than
    /// two points; redundant equations; a position that is singular.
    pub fn circuit(&self, input: &str, points: usize) -> Result<Circuit> {
        self.follower(0.0)?.circuit(input, points)
    }
}

impl Follower {
    /// Returns the circuit through the configuration where the follower is, as [`System::circuit`]
    /// does. The follower does not move.
    ///
    /// Errors: those of [`System::circuit`].
    pub fn circuit(&self, input: &str, points: usize) -> Result<Circuit> {
        if points < 2 {
            return Err(Error::InvalidOptions {
                reason: format!("a circuit has at least 2 positions, not {points}. Request more"),
            });
        }
        let mut own = self.clone();
        let input = own.let_run(input)?;
        if own.system.is_redundant() {
            return Err(Error::InvalidOptions {
                reason: "a circuit needs as many equations as coordinates. Remove the redundant \
                         equations that the diagnosis names"
                    .to_string(),
            });
        }
        let Follower { system, options, q, .. } = own;
        options.check_memory(1, points, system.n_coordinates())?;
        let is_angle = input.unit.as_deref() != Some(system.unit_words().length());
        let mut traced = trace(&system, &options, (&q, input.value), is_angle)?;
        let dead_centres = named(traced.zeros(CurvePoint::dt), |place| place.t());
        let extremes = (0..q.len())
            .map(|k| named(traced.zeros(|place| place.dx[k]), |place| place.x[k]))
            .collect();
        let crossings = traced.crossings.iter().map(|(length, x)| point(*length, x)).collect();
        let (motion, inputs) = sampled(&system, &mut traced, points);
        let ends = traced.ends;
        Ok(Circuit { system, input, motion, inputs, ends, dead_centres, extremes, crossings })
    }
}

impl Circuit {
    /// Returns true if the circuit comes back to its first position. Its last position is then the
    /// first one, with angles that may differ by whole turns.
    pub fn is_closed(&self) -> bool {
        self.ends.is_none()
    }

    /// Returns why an open circuit ends, at its first and its last position; `None` if it is
    /// closed.
    pub fn ends(&self) -> Option<[CircuitEnd; 2]> {
        self.ends
    }

    /// Returns the whole arc length. \[-\]
    pub fn length(&self) -> f64 {
        self.motion.times().last().copied().unwrap_or_default()
    }

    /// Returns the positions as a motion whose times are arc lengths, for points, tables and
    /// pictures. Its velocities and accelerations are the first and second derivatives by arc
    /// length.
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// Returns the name and unit of the input, with its value where the circuit was begun.
    pub fn input(&self) -> &NamedValue {
        &self.input
    }

    /// Returns the values of the input, one for each position.
    pub fn inputs(&self) -> &[f64] {
        &self.inputs
    }

    /// Returns the dead centres of the input, in the order of arc length: there it turns back, and
    /// a motor cannot drive the mechanism past.
    pub fn dead_centres(&self) -> &[CircuitPoint] {
        &self.dead_centres
    }

    /// Returns the extremes of a coordinate such as `rocker.theta`, in the order of arc length.
    /// They are the dead centres of a driver of this coordinate.
    ///
    /// Errors: an unknown coordinate, with the known ones.
    pub fn extremes(&self, coordinate: &str) -> Result<&[CircuitPoint]> {
        Ok(&self.extremes[self.column(coordinate)?])
    }

    /// Returns the range of a coordinate over the circuit, exact at its extremes. The range of an
    /// angle that turns round goes over all turns of the circuit.
    ///
    /// Errors: an unknown coordinate, with the known ones.
    pub fn range(&self, coordinate: &str) -> Result<[f64; 2]> {
        let k = self.column(coordinate)?;
        let ends = [0, self.motion.len() - 1].map(|at| self.motion.q(at)[k]);
        let values = self.extremes[k].iter().map(|point| point.value).chain(ends);
        Ok(values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], value| {
            [least.min(value), most.max(value)]
        }))
    }

    /// Returns the places where this circuit crosses another one, in the order of arc length.
    pub fn crossings(&self) -> &[CircuitPoint] {
        &self.crossings
    }

    fn column(&self, coordinate: &str) -> Result<usize> {
        let names = self.system.coordinate_names();
        let found = names.iter().position(|known| known == coordinate);
        found.ok_or_else(|| Error::UnknownName {
            what: "coordinate",
            name: coordinate.to_string(),
            known: names.to_vec(),
        })
    }
}

fn point(length: f64, x: &[f64]) -> CircuitPoint {
    let (input, q) = x.split_last().unwrap_or((&0.0, &[]));
    CircuitPoint { length, input: *input, q: q.to_vec(), value: *input }
}

fn named(found: Vec<(f64, CurvePoint)>, value: impl Fn(&CurvePoint) -> f64) -> Vec<CircuitPoint> {
    let named = |(length, place): (f64, CurvePoint)| CircuitPoint {
        value: value(&place),
        ..point(length, &place.x)
    };
    found.into_iter().map(named).collect()
}

/// Returns so many positions as a motion by arc length, and the values of the input.
fn sampled(system: &System, traced: &mut Traced<'_>, points: usize) -> (Motion, Vec<f64>) {
    let whole = traced.lengths.last().copied().unwrap_or_default();
    let mut motion = Motion::new(system, points);
    let mut inputs = Vec::with_capacity(points);
    let n = system.n_coordinates();
    for k in 0..points {
        let length = whole * k as f64 / (points - 1) as f64;
        let place = traced.at(length);
        let outcome = Outcome { iterations: 0, residual: 0.0 };
        let rows = [&place.x[..n], &place.dx[..n], &place.ddx[..n], &[]];
        motion.append(length, rows, outcome, 0);
        inputs.push(place.t());
    }
    (motion, inputs)
}
