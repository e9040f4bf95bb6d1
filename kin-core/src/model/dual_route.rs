//! Evaluates the user's equation with dual numbers: the dual route.
//!
//! `Dual64` along each column gives C_q, and `Dual64` along t gives C_t. `Dual2_64` along (q̇, ṫ)
//! gives the right side −g″(0). `HyperDual64` along q̇ and t gives the mixed term C_qt q̇.
//! `Dual3_64` along the motion gives the right side for the jerk.

use crate::numbers::real::{Dual2_64, Dual3_64, Dual64, HyperDual64};

use crate::coordinates::Argument;
use crate::law::Law;
use crate::model::blame::{Asked, Blame};
use crate::model::constraint::{
    Attachment, Constraint, Facts, Parameters, Parts, RouteReason, Written,
};
use crate::model::state::{At, Rates};
use crate::numbers::real::{Dual, Real};

/// A constraint whose equation works with any numbers, with N local coordinates and M rows.
/// `#[constraint]` implements it.
pub trait Equation<const N: usize, const M: usize>: Constraint + Clone + 'static {
    /// The kinds of the arguments, in order.
    const ARGUMENTS: &'static [ArgumentKind];

    /// Evaluates C(q, t) with dual numbers.
    fn evaluate<D: Dual>(&self, q: &[Real<D>; N], t: Real<D>) -> [Real<D>; M];

    /// Evaluates measure k of [`Facts::measures`] with dual numbers.
    fn measured<D: Dual>(&self, k: usize, q: &[Real<D>; N], t: Real<D>) -> Real<D> {
        let _ = (k, q, t);
        Real::from(f64::NAN)
    }

    /// Evaluates C(q, t) in `f64` by the function as the user wrote it.
    ///
    /// Central differences use this function as a reference.
    fn plain(&self, q: &[f64; N], t: f64) -> [f64; M];
}

/// The kind of an argument of a constraint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ArgumentKind {
    /// A planar body: 3 columns.
    Planar,
    /// A spatial body: 7 columns.
    Spatial,
    /// A scalar coordinate: 1 column.
    Coord,
}

impl ArgumentKind {
    /// Returns the number of columns: 3, 7 or 1.
    pub fn columns(self) -> usize {
        match self {
            ArgumentKind::Planar => 3,
            ArgumentKind::Spatial => 7,
            ArgumentKind::Coord => 1,
        }
    }
}

/// A constraint that takes the dual route, independently of the route of its `impl Constraint`.
#[derive(Clone, Debug)]
pub struct ByDual<E, const N: usize, const M: usize>(E);

/// Returns the constraint on the dual route, to check the symbolic route against the dual route.
pub fn by_dual<E: Equation<N, M>, const N: usize, const M: usize>(equation: E) -> ByDual<E, N, M> {
    ByDual(equation)
}

impl<E: Equation<N, M>, const N: usize, const M: usize> Constraint for ByDual<E, N, M> {
    fn facts(&self) -> Facts<'_> {
        let reason = RouteReason::Asked { source: None };
        Facts { reason, n_timed: 0, sides_of_time: None, ..self.0.facts() }
    }

    fn arguments(&self) -> Vec<Argument> {
        self.0.arguments()
    }

    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        residual(&self.0, at, c);
    }

    fn jacobian(&self, at: &At<'_>, c_q: &mut [f64]) {
        jacobian(&self.0, at, c_q);
    }

    fn velocity_rhs(&self, at: &At<'_>, rhs: &mut [f64]) {
        velocity_rhs(&self.0, at, rhs);
    }

    fn acceleration_rhs(&self, at: &At<'_>, qd: &Rates<'_>, t_dot: f64, q_d: &mut [f64]) {
        acceleration_rhs(&self.0, at, qd, t_dot, q_d);
    }

    fn jerk_rhs(&self, at: &At<'_>, qd: &Rates<'_>, qdd: &Rates<'_>, rhs: &mut [f64]) -> bool {
        jerk_rhs(&self.0, at, qd, qdd, rhs)
    }

    fn measure(&self, k: usize, at: &At<'_>, rates: &[Rates<'_>; 3]) -> [f64; 4] {
        self.0.measure(k, at, rates)
    }

    fn wrong_branch(&self, at: &At<'_>) -> Option<&str> {
        self.0.wrong_branch(at)
    }

    fn parts(&self) -> Parts<'_> {
        Parts { written: Some(self), ..self.0.parts() }
    }

    fn parameters_mut(&mut self) -> Option<&mut dyn Parameters> {
        self.0.parameters_mut()
    }
}

/// Delegates to the route of the constraint, except for the formula: a run on the dual route
/// evaluates the user's function.
impl<E: Equation<N, M>, const N: usize, const M: usize> Written for ByDual<E, N, M> {
    fn attachments(&self) -> Vec<Attachment> {
        self.0.parts().written.map(|own| own.attachments()).unwrap_or_default()
    }

    /// A term that is not finite on one route is not finite on the other.
    fn blame(&self, asked: &Asked<'_>) -> Option<Blame> {
        self.0.parts().written?.blame(asked)
    }

    fn laws(&self, at: &At<'_>, visit: &mut dyn FnMut(&str, &Law, f64)) {
        if let Some(own) = self.0.parts().written {
            own.laws(at, visit);
        }
    }
}

/// Evaluates C(q, t) with plain numbers.
pub fn residual<E: Equation<N, M>, const N: usize, const M: usize>(
    equation: &E,
    at: &At<'_>,
    c: &mut [f64],
) {
    let q = coordinates::<N>(E::ARGUMENTS, at).map(Real::<f64>::from);
    write(c, equation.evaluate(&q, Real::from(at.t)).map(|x| x.0));
}

/// Evaluates C_q with one `Dual64` evaluation for each column.
pub fn jacobian<E: Equation<N, M>, const N: usize, const M: usize>(
    equation: &E,
    at: &At<'_>,
    c_q: &mut [f64],
) {
    let q = coordinates::<N>(E::ARGUMENTS, at);
    let pattern = equation.facts().pattern;
    for column in 0..N {
        let seeded = std::array::from_fn(|k| {
            if k == column { Real(Dual64::new(q[k], 1.0)) } else { Real::from(q[k]) }
        });
        let c = equation.evaluate(&seeded, Real::from(at.t));
        for (value, entry) in
            c_q.iter_mut().zip(pattern).filter(|(_, entry)| entry.column == column)
        {
            *value = c[entry.row].0.eps;
        }
    }
}

/// Evaluates −C_t with one `Dual64` evaluation along t.
pub fn velocity_rhs<E: Equation<N, M>, const N: usize, const M: usize>(
    equation: &E,
    at: &At<'_>,
    rhs: &mut [f64],
) {
    let q = coordinates::<N>(E::ARGUMENTS, at).map(Real::<Dual64>::from);
    write(rhs, equation.evaluate(&q, Real(Dual64::new(at.t, 1.0))).map(|x| -x.0.eps));
}

/// Evaluates −g″(0) with g(s) = C(q + s q̇, t + s ṫ) by one `Dual2_64` evaluation.
pub fn acceleration_rhs<E: Equation<N, M>, const N: usize, const M: usize>(
    equation: &E,
    at: &At<'_>,
    qd: &Rates<'_>,
    t_dot: f64,
    q_d: &mut [f64],
) {
    let q = coordinates::<N>(E::ARGUMENTS, at);
    let qd = self::rates::<N>(E::ARGUMENTS, qd);
    let seeded = std::array::from_fn(|k| Real(Dual2_64::new(q[k], qd[k], 0.0)));
    write(q_d, equation.evaluate(&seeded, Real(Dual2_64::new(at.t, t_dot, 0.0))).map(|x| -x.0.v2));
}

/// Evaluates C_qt q̇ by one `HyperDual64` evaluation along q̇ and t. \[row/s²\]
pub fn mixed<E: Equation<N, M>, const N: usize, const M: usize>(
    equation: &E,
    q: &[f64; N],
    qd: &[f64; N],
    t: f64,
) -> [f64; M] {
    let seeded = std::array::from_fn(|k| Real(HyperDual64::along_first(q[k], qd[k])));
    equation.evaluate(&seeded, Real(HyperDual64::along_second(t, 1.0))).map(|x| x.0.eps1eps2)
}

/// Evaluates −g‴(0) with g(s) = C(q + s q̇ + ½ s² q̈, t + s) by one `Dual3_64` evaluation.
/// \[row/s³\]
///
/// The function always returns a result, because every equation works with dual numbers.
pub fn jerk_rhs<E: Equation<N, M>, const N: usize, const M: usize>(
    equation: &E,
    at: &At<'_>,
    qd: &Rates<'_>,
    qdd: &Rates<'_>,
    rhs: &mut [f64],
) -> bool {
    let q = coordinates::<N>(E::ARGUMENTS, at);
    let [qd, qdd] = [qd, qdd].map(|rates| self::rates::<N>(E::ARGUMENTS, rates));
    let seeded = std::array::from_fn(|k| Real(Dual3_64::new(q[k], qd[k], qdd[k], 0.0)));
    write(
        rhs,
        equation.evaluate(&seeded, Real(Dual3_64::new(at.t, 1.0, 0.0, 0.0))).map(|x| -x.0.v3),
    );
    true
}

/// Evaluates measure k and its first three derivatives along q̇, q̈ and q⃛ by one `Dual3_64`
/// evaluation.
pub fn measure<E: Equation<N, M>, const N: usize, const M: usize>(
    equation: &E,
    k: usize,
    at: &At<'_>,
    rates: &[Rates<'_>; 3],
) -> [f64; 4] {
    let q = coordinates::<N>(E::ARGUMENTS, at);
    let [qd, qdd, qddd] = rates.map(|rates| self::rates::<N>(E::ARGUMENTS, &rates));
    let moving = std::array::from_fn(|j| Real(Dual3_64::new(q[j], qd[j], qdd[j], qddd[j])));
    let x = equation.measured(k, &moving, Real(Dual3_64::new(at.t, 1.0, 0.0, 0.0))).0;
    [x.re, x.v1, x.v2, x.v3]
}

/// Returns the local coordinates of a constraint, argument after argument.
fn coordinates<const N: usize>(arguments: &[ArgumentKind], at: &At<'_>) -> [f64; N] {
    gather(arguments, |k, n| at.coordinates(k, n))
}

/// Returns the local velocities of a constraint, argument after argument.
fn rates<const N: usize>(arguments: &[ArgumentKind], qd: &Rates<'_>) -> [f64; N] {
    gather(arguments, |k, n| qd.columns(k, n))
}

/// Collects the numbers of all arguments, one argument after the other. `numbers` returns the n
/// numbers of argument k; missing numbers are zero.
fn gather<'a, const N: usize>(
    arguments: &[ArgumentKind],
    numbers: impl Fn(usize, usize) -> &'a [f64],
) -> [f64; N] {
    let mut all = [0.0; N];
    let mut rest = &mut all[..];
    for (k, kind) in arguments.iter().enumerate() {
        let n = kind.columns();
        let Some((own, others)) = std::mem::take(&mut rest).split_at_mut_checked(n) else { break };
        own.iter_mut().zip(numbers(k, n)).for_each(|(place, number)| *place = *number);
        rest = others;
    }
    all
}

fn write<const M: usize>(out: &mut [f64], values: [f64; M]) {
    out.iter_mut().zip(values).for_each(|(place, value)| *place = value);
}
