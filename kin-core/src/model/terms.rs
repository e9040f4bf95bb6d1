//! Computes every term of one constraint at one state, to compare routes with each other or with a
//! derivation by hand.

use nalgebra::{DMatrix, DVector};

use crate::coordinates::{Argument, Target, Trig};
use crate::model::constraint::Constraint;
use crate::model::dual_route::{self, Equation};
use crate::model::state::{At, CoordState, Offsets, PlanarState, Rates, SpatialState};

/// Every term of C(q, t) and its derivatives at one state. Columns are local to the constraint, and
/// units are those of the row.
#[derive(Clone, Debug, PartialEq)]
pub struct Terms {
    /// C(q, t), length m.
    pub c: DVector<f64>,
    /// C_q, m × n, zero outside the pattern.
    pub c_q: DMatrix<f64>,
    /// C_t, length m.
    pub c_t: DVector<f64>,
    /// (C_q q̇)_q q̇, length m.
    pub c_qqd_qd: DVector<f64>,
    /// C_qt q̇, length m.
    pub c_qt_qd: DVector<f64>,
    /// C_tt, length m.
    pub c_tt: DVector<f64>,
    /// Q_d = −(C_q q̇)_q q̇ − 2 C_qt q̇ − C_tt, length m.
    pub q_d: DVector<f64>,
}

impl Terms {
    /// Returns true if every entry of every term is finite.
    pub fn is_finite(&self) -> bool {
        let vectors = [&self.c, &self.c_t, &self.c_qqd_qd, &self.c_qt_qd, &self.c_tt, &self.q_d];
        vectors.iter().all(|v| v.iter().all(|x| x.is_finite()))
            && self.c_q.iter().all(|x| x.is_finite())
    }
}

/// Returns every term of `constraint` at local coordinates `q`, velocities `qd` and time `t`, on
/// the route of the constraint.
///
/// Kin computes the terms from r(q̇, ṫ) = −\[(C_q q̇)_q q̇ + 2 ṫ C_qt q̇ + ṫ² C_tt\]. The first
/// term is −r(q̇, 0) and the last term is −r(0, 1). The mixed term is the remainder of r(q̇, 1);
/// its error is the rounding error of the largest of the three terms. `q` and `qd` contain the
/// coordinates and velocities of the arguments in order. Kin takes zero for a missing number.
pub fn terms(constraint: &dyn Constraint, q: &[f64], qd: &[f64], t: f64) -> Terms {
    let arguments = constraint.arguments();
    let facts = constraint.facts();
    let m = facts.rows.len();
    let local = Local::new(&arguments, q, qd);
    let still = Local::new(&arguments, q, &[]);
    let at = local.at(t);

    let mut c = DVector::zeros(m);
    constraint.residual(&at, c.as_mut_slice());

    let mut values = vec![0.0; facts.pattern.len()];
    constraint.jacobian(&at, &mut values);
    let n = arguments.iter().map(|a| a.target.columns()).sum();
    let mut c_q = DMatrix::zeros(m, n);
    for (entry, value) in facts.pattern.iter().zip(values) {
        c_q[(entry.row, entry.column)] += value;
    }

    let mut c_t = DVector::zeros(m);
    constraint.velocity_rhs(&at, c_t.as_mut_slice());
    c_t.neg_mut();

    let right_side = |rates: &Local, t_dot: f64| {
        let mut r = DVector::zeros(m);
        constraint.acceleration_rhs(&at, &rates.rates(), t_dot, r.as_mut_slice());
        r
    };
    let q_d = right_side(&local, 1.0);
    let c_qqd_qd = -right_side(&local, 0.0);
    let c_tt = -right_side(&still, 1.0);
    let c_qt_qd = (-&q_d - &c_qqd_qd - &c_tt) * 0.5;
    Terms { c, c_q, c_t, c_qqd_qd, c_qt_qd, c_tt, q_d }
}

/// Returns every term on the dual route, each from the matching kind of dual number, such as
/// `HyperDual64` for the mixed term.
pub fn dual_terms<E, const N: usize, const M: usize>(
    equation: &E,
    q: &[f64],
    qd: &[f64],
    t: f64,
) -> Terms
where
    E: Equation<N, M> + Clone,
{
    let mut all = terms(&dual_route::by_dual::<E, N, M>(equation.clone()), q, qd, t);
    let fixed = |values: &[f64]| std::array::from_fn(|k| values.get(k).copied().unwrap_or(0.0));
    all.c_qt_qd =
        DVector::from_row_slice(&dual_route::mixed::<E, N, M>(equation, &fixed(q), &fixed(qd), t));
    all
}

/// Returns −g‴(0) with g(s) = C(q + s q̇ + ½ s² q̈, t + s), the right side of C_q q⃛ for the jerk.
/// \[row/s³\]
///
/// Returns `None` if the constraint does not know its right side.
pub fn jerk_rhs(
    constraint: &dyn Constraint,
    q: &[f64],
    qd: &[f64],
    qdd: &[f64],
    t: f64,
) -> Option<DVector<f64>> {
    let arguments = constraint.arguments();
    let local = Local::new(&arguments, q, qd);
    let second = Local::new(&arguments, q, qdd);
    let mut rhs = DVector::zeros(constraint.facts().rows.len());
    constraint
        .jerk_rhs(&local.at(t), &local.rates(), &second.rates(), rhs.as_mut_slice())
        .then_some(rhs)
}

/// The coordinates of one constraint and their derivatives at one time of a motion, argument after
/// argument.
///
/// Kin takes zero for a missing number.
#[derive(Clone, Copy, Debug, Default)]
pub struct Moving<'a> {
    /// q   \[m, rad\]
    pub q: &'a [f64],
    /// q̇   \[m/s, rad/s\]
    pub qd: &'a [f64],
    /// q̈   \[m/s², rad/s²\]
    pub qdd: &'a [f64],
    /// q⃛   \[m/s³, rad/s³\]
    pub qddd: &'a [f64],
}

/// Returns measure k of a constraint ([`Facts::measures`](crate::constraint::Facts::measures)) and
/// its first three derivatives at time t of a motion.
pub fn measure(constraint: &dyn Constraint, k: usize, moving: Moving<'_>, t: f64) -> [f64; 4] {
    let arguments = constraint.arguments();
    let Moving { q, qd, qdd, qddd } = moving;
    let [first, second, third] = [qd, qdd, qddd].map(|rates| Local::new(&arguments, q, rates));
    constraint.measure(k, &first.at(t), &[first.rates(), second.rates(), third.rates()])
}

/// The states and velocities of the arguments of a single constraint.
pub(crate) struct Local {
    pub states: Vec<f64>,
    pub rates: Vec<f64>,
    /// The place of the state and of the velocities of each argument.
    pub arguments: Vec<Offsets>,
}

impl Local {
    pub(crate) fn new(arguments: &[Argument], q: &[f64], qd: &[f64]) -> Self {
        let mut local = Local { states: Vec::new(), rates: Vec::new(), arguments: Vec::new() };
        for argument in arguments {
            let column = local.rates.len();
            local.arguments.push(Offsets::new(local.states.len() as u32, column as u32));
            let q = |k: usize| q.get(column + k).copied().unwrap_or(0.0);
            match argument.target {
                Target::Planar(_) => {
                    local.states.extend(PlanarState::new(std::array::from_fn(q)).to_array())
                }
                Target::Spatial(_) => {
                    local.states.extend(SpatialState::new(std::array::from_fn(q)).to_array())
                }
                Target::Coord(..) => {
                    local.states.extend(CoordState::new(q(0), Trig::Used).to_array())
                }
            }
            local.rates.extend(
                (column..column + argument.target.columns())
                    .map(|k| qd.get(k).copied().unwrap_or(0.0)),
            );
        }
        local
    }

    pub(crate) fn at(&self, t: f64) -> At<'_> {
        At::new(t, &self.states, &self.arguments)
    }

    pub(crate) fn rates(&self) -> Rates<'_> {
        Rates::new(&self.rates, &self.arguments)
    }
}
