//! Kernels over lanes against the constraint's own terms, in each lane by itself, for every kind of machine
//! that this one can be.

use nalgebra::{DMatrix, DVector};

use super::{ROUTES_TOLERANCE, Spread};
use crate::model::constraint::Constraint;
use crate::model::terms::{Local, terms};
use crate::numbers::lanes::{InLanes, LaneBlock, LaneInstant, Lanes, Level, Wide, WithLevel};

/// A term that a kernel over lanes and the constraint itself do not agree on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "`{kind}`: {term} by its kernel over lanes differs by {difference:.2e} (relative) from its own at q = {q:?}, qd = {qd:?}, t = {t}; \
     leave `lanes` out of its attribute, and report the constraint"
)]
pub struct LaneMismatch {
    /// Kind of the constraint.
    pub kind: String,
    /// The term, such as `C_q`.
    pub term: &'static str,
    /// Largest difference relative to 1 + the largest entry.
    pub difference: f64,
    /// Local coordinates.
    pub q: Vec<f64>,
    /// Local rates.
    pub qd: Vec<f64>,
    /// Time.   \[s\]
    pub t: f64,
}

/// Compares the kernels over lanes of `constraint` with its own terms at 24 states, by 2, 4 and 8 lanes where
/// the machine has them; gives how many of these it has, 0 for a constraint without such kernels.
///
/// States where a term is not finite are left out.
pub fn lanes(constraint: &dyn Constraint) -> Result<usize, Box<LaneMismatch>> {
    let Some(kernels) = constraint.parts().in_lanes else { return Ok(0) };
    let n = constraint.arguments().iter().map(|argument| argument.target.columns()).sum();
    let mut spread = Spread(0x6C62_272E_07BB_0142);
    let mut vector = || (0..n).map(|_| spread.next()).collect::<Vec<f64>>();
    let states: Vec<State> = (0..24).map(|_| (vector(), vector())).collect();
    let mut levels = 0;
    for lanes in [2, 4, 8] {
        let Ok(compared) = Lanes::Only(lanes).dispatch(Compare { constraint, kernels, states: &states })
        else {
            continue;
        };
        compared?;
        levels += 1;
    }
    Ok(levels)
}

/// Local coordinates and rates.
type State = (Vec<f64>, Vec<f64>);

struct Compare<'a> {
    constraint: &'a dyn Constraint,
    kernels: &'a dyn InLanes,
    states: &'a [State],
}

impl WithLevel for Compare<'_> {
    type Output = Result<(), Box<LaneMismatch>>;

    fn run<S: Level>(self, simd: S) -> Self::Output {
        let mut groups = self.states.chunks(Wide::<S>::LANES).enumerate();
        groups.try_for_each(|(k, group)| self.group(simd, 0.7 * k as f64, group))
    }
}

impl Compare<'_> {
    /// One state a lane; lanes that are left over have the first one.
    fn group<S: Level>(&self, simd: S, t: f64, group: &[State]) -> Result<(), Box<LaneMismatch>> {
        let arguments = self.constraint.arguments();
        let of_lane = |lane: usize| group.get(lane).unwrap_or(&group[0]);
        let locals: Vec<Local> =
            (0..Wide::<S>::LANES).map(of_lane).map(|(q, qd)| Local::new(&arguments, q, qd)).collect();
        let states = wide(simd, &locals, |local| &local.states);
        let rates = wide(simd, &locals, |local| &local.rates);
        let known = self.known(t).into_iter().map(|x| Wide::splat(simd, x)).collect::<Vec<_>>();
        let own = [vec![self.kernels; Wide::<S>::LANES]];
        let arguments = locals.first().map(|local| &local.arguments[..]).unwrap_or_default();
        let instant =
            LaneInstant { simd, states: &states, rates: &rates, known: &known, arguments, own: &own };
        let alone = [LaneBlock { number: 0, arguments: 0, known: 0, rows: 0, values: 0 }];
        let (table, rows) = (S::table(&self.kernels.kernels()), self.constraint.facts().rows.len());
        let zeros = || vec![Wide::splat(simd, 0.0); rows];
        let (mut c, mut rhs, mut q_d) = (zeros(), zeros(), zeros());
        let constant = |k: usize| self.constraint.facts().constants.get(k).copied().flatten().unwrap_or(0.0);
        let mut values: Vec<Wide<S>> =
            (0..self.constraint.facts().pattern.len()).map(|k| Wide::splat(simd, constant(k))).collect();
        table.linearize(&instant, &alone, &mut c, &mut values);
        table.velocity_rhs(&instant, &alone, &mut rhs);
        table.acceleration_rhs(&instant, &alone, &mut q_d);
        for (lane, state) in group.iter().enumerate() {
            let of_lane =
                |all: &[Wide<S>]| DVector::from_iterator(all.len(), all.iter().map(|x| x.as_slice()[lane]));
            self.compare(state, t, [of_lane(&c), of_lane(&values), -of_lane(&rhs), of_lane(&q_d)])?;
        }
        Ok(())
    }

    /// Values that the kernels read instead of computing them: those of the parameters, then those of the
    /// time.
    fn known(&self, t: f64) -> Vec<f64> {
        let [parameters, times] = self.kernels.n_known();
        let mut known = vec![0.0; parameters + times];
        self.kernels.of_parameters(&mut known[..parameters]);
        self.kernels.of_time(t, &mut known[parameters..]);
        known
    }

    /// C, values of C_q, C_t and Q_d of one lane.
    fn compare(
        &self,
        (q, qd): &State,
        t: f64,
        [c, values, c_t, q_d]: [DVector<f64>; 4],
    ) -> Result<(), Box<LaneMismatch>> {
        let own = terms(self.constraint, q, qd, t);
        if !own.is_finite() {
            return Ok(());
        }
        let mut c_q = DMatrix::zeros(own.c_q.nrows(), own.c_q.ncols());
        self.constraint
            .facts()
            .pattern
            .iter()
            .zip(values.iter())
            .for_each(|(entry, value)| c_q[(entry.row, entry.column)] += value);
        let column = |v: &DVector<f64>| DMatrix::from_column_slice(v.len(), 1, v.as_slice());
        let found = [
            ("C", column(&c), column(&own.c)),
            ("C_q", c_q, own.c_q.clone()),
            ("C_t", column(&c_t), column(&own.c_t)),
        ];
        // Q_d comes of parts that may cancel.
        let parts = [&own.c_qqd_qd, &own.c_tt, &own.c_qt_qd].iter().map(|v| v.amax()).fold(0.0, f64::max);
        let found = found.into_iter().map(|(term, a, b)| (term, (&a - &b).amax() / (1.0 + b.amax())));
        for (term, difference) in found.chain([("Q_d", (q_d - &own.q_d).amax() / (1.0 + parts))]) {
            if difference.is_nan() || difference > ROUTES_TOLERANCE {
                let kind = self.constraint.facts().kind.to_owned();
                return Err(Box::new(LaneMismatch {
                    kind,
                    term,
                    difference,
                    q: q.clone(),
                    qd: qd.clone(),
                    t,
                }));
            }
        }
        Ok(())
    }
}

/// The numbers of all lanes.
fn wide<S: Level>(simd: S, locals: &[Local], numbers: impl Fn(&Local) -> &Vec<f64>) -> Vec<Wide<S>> {
    let mut all = vec![Wide::splat(simd, 0.0); locals.first().map_or(0, |local| numbers(local).len())];
    for (lane, local) in locals.iter().enumerate() {
        all.iter_mut().zip(numbers(local)).for_each(|(x, own)| x.as_mut_slice()[lane] = *own);
    }
    all
}
