//! Checks the derivatives of a user-defined constraint or law in one line of a test.
//!
//! The check compares symbolic code with dual numbers, term by term. The check also compares both
//! with central differences of the function as you wrote it.
//!
//! ```
//! use kin::prelude::*;
//!
//! #[constraint]
//! fn parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
//!     let s = j.local(i.point(u_i));
//!     s.y - k * s.x * s.x
//! }
//!
//! let (i, j) = (kin::check::any_planar(), kin::check::any_planar());
//! kin::check::derivatives(parabolic_slot(i, j, vec2(0.1, 0.0), 2.0));
//! kin::check::law(&Law::sine(2.0, 3.0, 0.5), 0.0, 4.0);
//! ```

mod bounds;
mod central;
mod entries;
mod law;
mod promises;

pub use crate::coordinates::{any_coord, any_planar, any_spatial};
pub use crate::outcome::mismatch::{Disagreement, Mismatch};
pub use law::{LawMismatch, compare_law, law};

use nalgebra::{DMatrix, DVector};

use crate::model::dual_route::{ArgumentKind, Equation};
use crate::model::terms::{Terms, dual_terms, terms};
use central::Central;

/// The largest differences between the routes to the derivatives of a constraint.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// Largest difference of a term between the constraint's route and dual numbers, relative to 1
    /// + the largest entry of the term.
    pub routes: f64,
    /// Largest difference of C, C_q, C_t and Q_d from central differences, relative to 1 + the
    /// largest entry of the term.
    pub differences: f64,
    /// Number of states at which interval bounds of C and C_q are known over boxes around the
    /// state. All values are within their bounds. [`crate::System::prove`] uses the same bounds.
    pub bounded: usize,
    /// Number of compared states. The check omits a state at which the function or a derivative is
    /// not finite.
    pub states: usize,
}

/// The largest relative difference between routes that the check accepts as rounding.
pub const ROUTES_TOLERANCE: f64 = 1e-12;
/// The largest relative difference from central differences (step 1e-5) that the check accepts as
/// their error.
pub const DIFFERENCES_TOLERANCE: f64 = 1e-6;
/// The seed of the states of [`derivatives`] and [`compare`]. Every run uses the same states.
pub const SEED: u64 = 0x9E37_79B9_7F4A_7C15;

/// Asserts that all routes to the derivatives of `equation` agree and are within their interval
/// bounds.
///
/// The check compares 24 states, the same in every run. Coordinates are within ±2 m or rad,
/// velocities within ±2 m/s or rad/s, and t is in 0..4 s. Euler parameters have a length near one.
///
/// Use the function in a test. If entries disagree, the function panics with a table of the entries
/// and their state. [`compare`] returns the table as a value.
pub fn derivatives<E: Equation<N, M> + Clone, const N: usize, const M: usize>(equation: E) {
    if let Err(mismatch) = compare::<E, N, M>(&equation) {
        panic!("{mismatch}");
    }
}

/// Compares all routes to the derivatives of `equation` at 24 states.
///
/// Errors: the routes disagree at a state; the error describes the first one.
pub fn compare<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
    equation: &E,
) -> Result<Report, Box<Mismatch>> {
    compare_from::<E, N, M>(equation, SEED)
}

/// Compares all routes to the derivatives of `equation` at 24 states that `seed` selects.
pub fn compare_from<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
    equation: &E,
    seed: u64,
) -> Result<Report, Box<Mismatch>> {
    let mut report = Report { routes: 0.0, differences: 0.0, bounded: 0, states: 0 };
    let mut spread = Spread(seed);
    for number in 1..=24 {
        let mut q = spread.vector::<N>();
        let qd = spread.vector::<N>();
        let t = spread.next() + 2.0;
        near_one(E::ARGUMENTS, &mut q, &mut spread);
        at_state::<E, N, M>(equation, &q, &qd, t, &mut report).map_err(|mut mismatch| {
            mismatch.place = format!("state {number} of 24, seed {seed:#x}");
            mismatch
        })?;
    }
    Ok(report)
}

/// Brings Euler parameters to a length within a tenth of one. An iterate of Newton's method is not
/// further off.
fn near_one(arguments: &[ArgumentKind], q: &mut [f64], spread: &mut Spread) {
    let mut column = 0;
    for kind in arguments {
        if *kind == ArgumentKind::Spatial {
            let p = &mut q[column + 3..column + 7];
            let norm = p.iter().map(|e| e * e).sum::<f64>().sqrt();
            let length = 1.0 + 0.05 * spread.next();
            p.iter_mut().for_each(|e| *e *= length / norm);
        }
        column += kind.columns();
    }
}

/// Compares all routes to the derivatives of `equation` at one state that you choose.
pub fn at<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
    equation: &E,
    q: &[f64; N],
    qd: &[f64; N],
    t: f64,
) -> Result<Report, Box<Mismatch>> {
    let mut report = Report { routes: 0.0, differences: 0.0, bounded: 0, states: 0 };
    at_state::<E, N, M>(equation, q, qd, t, &mut report)?;
    Ok(report)
}

fn at_state<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
    equation: &E,
    q: &[f64; N],
    qd: &[f64; N],
    t: f64,
    report: &mut Report,
) -> Result<(), Box<Mismatch>> {
    let own = terms(equation, q, qd, t);
    let dual = dual_terms::<E, N, M>(equation, q, qd, t);
    if !own.is_finite() && !dual.is_finite() {
        return Ok(());
    }
    let central =
        Some(Central::new::<E, N, M>(equation, q, qd, t)).filter(|central| central.reliable);
    report.states += 1;
    let mut entries = Vec::new();
    for (term, a, b) in pairs(&own, &dual) {
        let scale = 1.0 + if of_the_right_side(term) { parts(&own) } else { b.amax() };
        let difference = distance(&a, &b) / scale;
        let c = central.as_ref().and_then(|central| central.term(term));
        let differs = c.map_or(0.0, |c| distance(&a, c) / (1.0 + c.amax()));
        report.routes = report.routes.max(difference);
        report.differences = report.differences.max(differs);
        if !(difference <= ROUTES_TOLERANCE && differs <= DIFFERENCES_TOLERANCE) {
            entries.extend(entries::differing(equation, term, &a, &b, c, scale));
        }
    }
    entries.extend(promises::broken::<E, N, M>(equation, q, qd, t, &dual));
    let (outside, bounded) = bounds::outside(equation, q, qd, t, &dual);
    report.bounded += usize::from(bounded);
    entries.extend(outside);
    match entries.is_empty() {
        true => Ok(()),
        false => Err(Box::new(Mismatch::new(equation, entries, q, qd, t))),
    }
}

impl Central {
    /// Returns the term from central differences, if they determine it.
    fn term(&self, term: &str) -> Option<&DMatrix<f64>> {
        match term {
            "C" => Some(&self.c),
            "C_q" => Some(&self.c_q),
            "C_t" => Some(&self.c_t),
            "Q_d" => Some(&self.q_d),
            _ => None,
        }
    }
}

/// Returns max |a − b|, or infinity if an entry is NaN.
fn distance(a: &DMatrix<f64>, b: &DMatrix<f64>) -> f64 {
    a.iter().zip(b.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, |m, d| {
        if d <= m {
            m
        } else if d.is_nan() {
            f64::INFINITY
        } else {
            d
        }
    })
}

/// Returns true for the three parts of Q_d. They come from one right side, so they are exact to
/// rounding of the largest of them.
fn of_the_right_side(term: &str) -> bool {
    matches!(term, "(C_q qd)_q qd" | "C_qt qd" | "C_tt" | "Q_d")
}

fn parts(own: &Terms) -> f64 {
    [&own.c_qqd_qd, &own.c_tt, &own.c_qt_qd, &own.q_d].iter().map(|v| v.amax()).fold(0.0, f64::max)
}

fn column(v: &DVector<f64>) -> DMatrix<f64> {
    DMatrix::from_column_slice(v.len(), 1, v.as_slice())
}

fn pairs(a: &Terms, b: &Terms) -> [(&'static str, DMatrix<f64>, DMatrix<f64>); 7] {
    [
        ("C", column(&a.c), column(&b.c)),
        ("C_q", a.c_q.clone(), b.c_q.clone()),
        ("C_t", column(&a.c_t), column(&b.c_t)),
        ("(C_q qd)_q qd", column(&a.c_qqd_qd), column(&b.c_qqd_qd)),
        ("C_qt qd", column(&a.c_qt_qd), column(&b.c_qt_qd)),
        ("C_tt", column(&a.c_tt), column(&b.c_tt)),
        ("Q_d", column(&a.q_d), column(&b.q_d)),
    ]
}

/// Reproducible random numbers within ±2 (SplitMix64).
struct Spread(u64);

impl Spread {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64 * 4.0 - 2.0
    }

    fn vector<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.next())
    }
}
