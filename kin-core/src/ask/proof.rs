//! Proof that a computed motion is the motion of the mechanism:
//! [`System::prove`](crate::System::prove).
//!
//! # What a proof shows
//! For a step from t_k to t_(k+1) let p(t) be the quintic polynomial through the computed q, q̇ and
//! q̈ at both ends. A proof of the step shows the following:
//!
//! * At every t of the step C(q, t) = 0 has a solution within [`Tube::radius`] of p(t), and no
//!   other solution within [`Tube::alone`].
//! * This solution is continuous in t.
//! * At each end the solution is the one next to the computed position. [`Proof::error`] bounds the
//!   distance between the solution and the computed position.
//!
//! Solutions of neighbouring steps are equal where the steps meet, so consecutive proved steps are
//! one motion.
//!
//! # How
//! Kin divides the step into pieces. Let T be the times of a piece, A an approximation of C_q⁻¹ in
//! its middle, and Y the box |y_j| ≤ ρ s_j, where s_j is the characteristic size of a coordinate.
//!
//! * **C along the curve**, c(t) = C(p(t), t), has bounds over T by Taylor's formula Σ_(k<6) c_k
//!   σᵏ + c_6 σ⁶, with c_k at the middle of T and c_6 over all of T
//!   (`numbers/enclosure/series.rs`). The bound shrinks like the error of the interpolation, h⁶,
//!   and not like the step.
//! * **C_q over p(T) + Y** gives R ≥ |I − A C_q| entry by entry.
//! * **Krawczyk's test** (`krawczyk.rs`) needs b ≥ |A c(T)| and y > 0 with z = b + R y < y ≤ ρ s.
//!   The map y ↦ y − A C(p(t) + y, t) then maps the box of y into the box of z at each t of T, so a
//!   solution exists within z (Brouwer). The inequality R y < y implies that the spectral radius of
//!   R is less than 1 (Collatz and Wielandt). So every matrix between the bounds of C_q is regular,
//!   including the means of C_q along straight lines in the box. C therefore has no value twice in
//!   the box, and no second solution exists within ρ s. If a continuous C has exactly one solution
//!   in a closed box at every t, this solution is continuous in t. Krawczyk, *Computing* 4 (1969);
//!   Neumaier, *Interval Methods for Systems of Equations*, ch. 5.
//! * **Joins.** At the time at which two pieces meet, each piece has one solution. If the box z of
//!   the first piece is in the box ρ s of the second, the solution of the first piece is also in
//!   the box of the second. The box of the second piece contains only one solution, so both
//!   solutions are equal. At the ends of a step Kin adds the rounding of p. Each computed position
//!   is a piece without length. Kin joins each step to the positions at its ends, and so joins
//!   consecutive steps.
//!
//! Kin halves a piece that fails the test, at most 14 times, and tests at most 256 pieces in a
//! step. If a piece still fails, Kin reports the time and the reason. At a singular position (a
//! toggle, a change point) the bounds of C_q contain a singular matrix, so Kin never proves a step
//! over one.
//!
//! # Assumptions
//! * Interval arithmetic rounds outwards (`numbers/enclosure/interval.rs`). Kin allows the
//!   functions of `f64` an error of 8 units in the last place, far more than their observed worst
//!   errors (`numbers/enclosure/tests/accuracy.rs`).
//! * The equation is the one that the user wrote. A decimal number in its text has its exact value,
//!   and a parameter has its value in memory. Kin interprets the formula of the equation
//!   (`model/formula.rs`), not the compiled code. Kin relies on the values that the user's program
//!   computes from parameters alone.
//! * Every row is continuous over the whole box, not only along the curve. If an expression can
//!   jump in the box (floor, `%`, an `if`, an angle over its cut), Kin does not prove the step,
//!   even if C_q has no entry for the expression.
//! * Laws are exact formulas (π is π). If two pieces of a law meet within rounding, Kin assumes
//!   that they meet exactly (`numbers/enclosure/pieces.rs`). Where two pieces meet, Kin uses only
//!   derivatives that agree on both sides. An angle by `atan2` is continuous across its cut if its
//!   use (sine, cosine, a law whose formula repeats) does not depend on full revolutions.
//! * The bounds that user-defined laws state are correct; [`Proof::trusted`] names these laws.
//!
//! # Limits
//! Not supported:
//!
//! * mechanisms with redundant equations, because numbers do not show that the omitted equations
//!   are satisfied exactly;
//! * constraints on the dual route and hand-written constraints;
//! * laws without a formula or stated bounds;
//! * steps in which the condition of an `if` changes.

mod bounds;
mod krawczyk;
mod step;
mod text;

use std::fmt;

use rayon::prelude::*;

use crate::coordinates::units::Unit;
use crate::coordinates::units::Units;
use crate::model::blame::Source;
use crate::outcome::error::{Error, Result};
use crate::solve::motion::Motion;
use crate::system::{System, scale};
pub(crate) use bounds::{Bounds, Column, Entry, Part, Unknown};
pub(crate) use krawczyk::settled;
use krawczyk::{Around, Fault, Test};
use step::{Curve, Failure, step};

/// The largest number of coordinates. The inverse of C_q is a full matrix, which costs about 10 n³
/// operations for each piece.
const LARGEST: usize = 400;

/// The proof of a motion, step by step. `Display` writes the result of the proof.
#[derive(Clone, Debug)]
pub struct Proof {
    name: String,
    units: Vec<Unit>,
    words: Units,
    positions: Vec<std::result::Result<Tube, Unproved>>,
    steps: Vec<StepProof>,
    trusted: Vec<String>,
}

/// The proof of one step of a motion.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct StepProof {
    /// The index k of the step, counted from 0. Step k goes from time k of the motion to the next
    /// time.
    pub step: usize,
    /// The start of the step. \[s\]
    pub from: f64,
    /// The end of the step. \[s\]
    pub to: f64,
    /// The tube around the step in which the motion is the only solution, or the obstacle to the
    /// proof.
    pub tube: std::result::Result<Tube, Unproved>,
}

/// Bounds for each coordinate: the distance of the solution, and the smallest distance of the next
/// one. \[m, rad\]
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Tube {
    /// The largest distance, over all times of the step, of the solution from the position
    /// interpolated by q, q̇ and q̈ at both ends.
    pub radius: Vec<f64>,
    /// The distance from the interpolated position within which no other solution exists.
    pub alone: Vec<f64>,
    /// The distance from the solution within which no other solution exists at the same time.
    pub free: Vec<f64>,
}

/// An obstacle to a proof, and its time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Unproved {
    /// The time within the step. \[s\]
    pub t: f64,
    /// Names of the units of length and time.
    pub units: Units,
    /// The kind of the obstacle.
    pub reason: UnprovedReason,
}

/// The kinds of obstacles to a proof.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum UnprovedReason {
    /// C_q may be singular, so two solutions may meet.
    Singular {
        /// The coordinate that can move most while everything else is nearly satisfied.
        coordinate: String,
    },
    /// The interpolated positions between both ends are not near a solution: the ends may be on
    /// different branches, or the step is too large.
    Apart {
        /// The equation with the largest residual.
        equation: String,
        /// The residual, in the unit of the equation.
        by: f64,
    },
    /// An equation has no known bounds at this time: an expression in the equation jumps, or has no
    /// value or slope.
    Unbounded {
        /// The equation.
        equation: String,
        /// The expression in the equation, as the user wrote it; `None` if it is unknown.
        expression: Option<String>,
        /// The place of the expression; `None` if it is unknown.
        source: Option<Source>,
    },
}

impl System {
    /// Proves for each step of a motion that exactly one continuous motion leads from one computed
    /// position to the next.
    ///
    /// The proof uses interval bounds. If Kin cannot prove a step, the result contains the reason.
    /// [`crate::results::proof`] describes what a proof shows and what it assumes.
    ///
    /// A proof takes some hundred times as long as the run and uses all cores. The time of a proof
    /// grows like n³ with the number n of coordinates.
    ///
    /// Errors: the mechanism has redundant equations or more than 400 coordinates, or a constraint
    /// or law has no known bounds ([`Error::CannotBeProved`]); the motion belongs to another
    /// system.
    pub fn prove(&self, motion: &Motion) -> Result<Proof> {
        self.own(motion)?;
        self.provable()?;
        let bounds = Bounds::new(self)?;
        let sizes = self.sizes_of(motion);
        let failed = |failure: Failure| self.doubt(failure, &sizes);
        let all: Vec<std::result::Result<Around, Failure>> = (0..motion.len())
            .into_par_iter()
            .map(|k| {
                let t = motion.times()[k];
                Curve::still(motion.q(k), t)
                    .around(&Test { bounds: &bounds, sizes: &sizes }, [0.0, 1.0])
                    .map_err(|fault| (t, fault))
            })
            .collect();
        let times = motion.times();
        let ends = all
            .par_iter()
            .zip(all.get(1..).unwrap_or_default())
            .zip(times.par_iter().zip(times.get(1..).unwrap_or_default()));
        let steps = ends.enumerate().map(|(k, ((first, last), (from, to)))| {
            let both =
                first.as_ref().and_then(|first| Ok([first, last.as_ref()?])).map_err(Clone::clone);
            let around = both.and_then(|ends| step(&bounds, &sizes, motion, k, ends));
            StepProof {
                step: k,
                from: *from,
                to: *to,
                tube: around.map(Tube::from).map_err(&failed),
            }
        });
        let steps = steps.collect();
        Ok(Proof {
            name: self.name().to_string(),
            units: self.layout().units.clone(),
            words: self.unit_words().clone(),
            positions: all
                .into_iter()
                .map(|around| around.map(Tube::from).map_err(&failed))
                .collect(),
            steps,
            trusted: bounds.trusted(),
        })
    }

    /// Returns an error unless C_q is square and not too large.
    pub(crate) fn provable(&self) -> Result<()> {
        let n = self.n_coordinates();
        let m = self.n_equations();
        let reason = if m != n {
            format!(
                "the mechanism has {m} equations for {n} coordinates, and Kin cannot prove that redundant equations hold exactly. Remove the redundant equations, which `diagnose` names"
            )
        } else if n > LARGEST {
            format!(
                "the mechanism has {n} coordinates, but Kin proves motions of at most {LARGEST} coordinates"
            )
        } else {
            return Ok(());
        };
        Err(Error::CannotBeProved { what: format!("a motion of \"{}\"", self.name()), reason })
    }

    /// Returns the characteristic sizes of the coordinates of a motion.
    pub(crate) fn sizes_of(&self, motion: &Motion) -> Vec<f64> {
        let t = motion.times().first().copied().unwrap_or_default();
        let first = if motion.is_empty() { self.initial() } else { motion.q(0) };
        let values = self.model().linearize(first, t).map(|point| point.values).unwrap_or_default();
        scale::sizes(self.layout(), self.equations(), &values, (first, t), self.links())
    }

    fn doubt(&self, (t, fault): Failure, sizes: &[f64]) -> Unproved {
        let reason = match fault {
            Fault::Unknown(unknown) => {
                let (expression, source) = unknown.expression.unzip();
                UnprovedReason::Unbounded {
                    equation: self.equations().equation(unknown.row),
                    expression,
                    source: source.flatten(),
                }
            }
            Fault::Apart(row, by) => {
                UnprovedReason::Apart { equation: self.equations().equation(row), by }
            }
            Fault::Singular(q, t) => {
                UnprovedReason::Singular { coordinate: self.loosest(&q, t, sizes) }
            }
        };
        Unproved { t, units: self.unit_words().clone(), reason }
    }

    /// Returns the coordinate that moves most, relative to its characteristic size, in the
    /// direction that C_q nearly leaves free.
    pub(crate) fn loosest(&self, q: &[f64], t: f64, sizes: &[f64]) -> String {
        let found = self.jacobian(q, t).ok().and_then(|mut c_q| {
            c_q.column_iter_mut().zip(sizes).for_each(|(mut column, size)| column *= *size);
            c_q.row_iter_mut().for_each(|mut row| row /= row.amax().max(f64::MIN_POSITIVE));
            let svd = c_q.try_svd(false, true, f64::EPSILON, 10_000)?;
            let along = svd.v_t?.row(svd.singular_values.imin()).transpose();
            self.coordinate_names().get(along.icamax())
        });
        found.cloned().unwrap_or_default()
    }
}

impl From<Around> for Tube {
    fn from(around: Around) -> Self {
        Tube { radius: around.inner, alone: around.outer, free: around.free }
    }
}

impl Proof {
    /// Returns true if Kin proved every step. For a motion without steps, returns true if Kin
    /// proved every position.
    pub fn is_complete(&self) -> bool {
        self.steps.iter().all(|step| step.tube.is_ok())
            && self.positions.iter().all(std::result::Result::is_ok)
    }

    /// Returns all steps in order.
    pub fn steps(&self) -> &[StepProof] {
        &self.steps
    }

    /// Returns the number of proved steps.
    pub fn proved(&self) -> usize {
        self.steps.iter().filter(|step| step.tube.is_ok()).count()
    }

    /// Returns the names of the user-defined laws whose stated bounds
    /// ([`crate::law::LawFunction::over`]) the proof relies on.
    ///
    /// Each name contains the constraint of the law.
    pub fn trusted(&self) -> &[String] {
        &self.trusted
    }

    /// Returns the first step without a proof.
    pub fn first_unproved(&self) -> Option<&StepProof> {
        self.steps.iter().find(|step| step.tube.is_err())
    }

    /// Returns bounds of the distance of computed position k from the solution, for each
    /// coordinate. \[m, rad\]
    ///
    /// Returns `None` if Kin found no bounds, or if k is beyond the last time.
    pub fn error(&self, k: usize) -> Option<&[f64]> {
        Some(&self.positions.get(k)?.as_ref().ok()?.radius)
    }
}

impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        text::proof(self, f)
    }
}

#[cfg(test)]
mod tests {
    mod exact;
    mod formulas;
    mod inclusion;
    mod seams;

    use super::*;
    use crate::joints::drivers::drive;
    use crate::{Law, Mechanism};

    /// So many lengths, each with a motor.
    fn lengths(count: usize) -> System {
        let mut m = Mechanism::new("row");
        for k in 0..count {
            let x = m.length(&format!("x{k}"), 0.0).unwrap();
            m.add(&format!("motor {k}"), drive(x, Law::linear(0.1, 1.0))).unwrap();
        }
        m.build().unwrap()
    }

    #[test]
    fn the_largest_mechanism_that_is_proved() {
        let prove = |system: System| system.prove(&system.run([0.0]).unwrap());
        assert!(prove(lengths(110)).unwrap().is_complete());
        let error = prove(lengths(401)).unwrap_err().to_string();
        assert!(
            error.contains(
                "the mechanism has 401 coordinates, but Kin proves motions of at most 400"
            ),
            "{error}"
        );
    }

    /// Rows of sizes far apart, two of them nearly alike, another one of them without any slope.
    #[kin_macros::constraint]
    fn nearly_alike(x: Coord, y: Coord, z: Coord, w: Coord) -> [f64; 4] {
        [x + y, 1e-6 * (x - y), z + w, z + 1.001 * w]
    }

    #[kin_macros::constraint]
    fn flat(x: Coord, y: Coord) -> [f64; 2] {
        [x + y * y, y * y * y]
    }

    /// The loosest coordinate can move most, in its own size, while each equation in its own is
    /// nearly met.
    #[test]
    fn the_loosest_coordinate() {
        let mut m = Mechanism::new("loose");
        let [x, y, z, w] = ["x", "y", "z", "w"].map(|name| m.length(name, 0.0).unwrap());
        m.add("rows", nearly_alike(x, y, z, w)).unwrap();
        let system = m.build().unwrap();
        let loosest = |sizes: [f64; 4]| system.loosest(&[0.0; 4], 0.0, &sizes);
        assert_eq!([loosest([1.0, 1.0, 1.0, 10.0]), loosest([1.0, 1.0, 10.0, 1.0])], ["z", "w"]);
        let mut m = Mechanism::new("flat");
        let [x, y] = ["x", "y"].map(|name| m.length(name, 0.0).unwrap());
        m.add("rows", flat(x, y)).unwrap();
        assert_eq!(m.build().unwrap().loosest(&[0.0; 2], 0.0, &[1.0; 2]), "y");
    }
}
