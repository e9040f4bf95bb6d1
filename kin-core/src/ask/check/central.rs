//! Central differences of the function as the user wrote it.

use nalgebra::{DMatrix, DVector};

use super::{DIFFERENCES_TOLERANCE, column};
use crate::model::dual_route::Equation;
use crate::model::terms::dual_terms;

/// Central differences of the plain function: C_q and C_t from C, and Q_d from C_q q̇ + C_t along
/// the motion.
pub(super) struct Central {
    /// C from the plain function.
    pub c: DMatrix<f64>,
    pub c_q: DMatrix<f64>,
    pub c_t: DMatrix<f64>,
    pub q_d: DMatrix<f64>,
    /// True if two step sizes agree. False near a kink or a singularity, where central differences
    /// are meaningless.
    pub reliable: bool,
}

impl Central {
    pub(super) fn new<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
        equation: &E,
        q: &[f64; N],
        qd: &[f64; N],
        t: f64,
    ) -> Self {
        let fine = Self::with_step::<E, N, M>(equation, q, qd, t, 1e-5);
        let coarse = Self::with_step::<E, N, M>(equation, q, qd, t, 4e-5);
        let agree = |a: &DMatrix<f64>, b: &DMatrix<f64>| {
            (a - b).amax() <= 0.3 * DIFFERENCES_TOLERANCE * (1.0 + a.amax())
        };
        let reliable = agree(&fine.c_q, &coarse.c_q)
            && agree(&fine.c_t, &coarse.c_t)
            && agree(&fine.q_d, &coarse.q_d);
        Central { reliable, ..fine }
    }

    fn with_step<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
        equation: &E,
        q: &[f64; N],
        qd: &[f64; N],
        t: f64,
        h: f64,
    ) -> Self {
        let slope = |direction: &[f64; N], along_t: f64| -> DVector<f64> {
            let value = |s: f64| {
                let moved = std::array::from_fn(|k| q[k] + s * direction[k]);
                DVector::from_row_slice(&equation.plain(&moved, t + s * along_t))
            };
            (value(h) - value(-h)) / (2.0 * h)
        };
        let columns: Vec<DVector<f64>> = (0..N)
            .map(|k| slope(&std::array::from_fn(|i| f64::from(u8::from(i == k))), 0.0))
            .collect();
        let c_q = if N == 0 { DMatrix::zeros(M, 0) } else { DMatrix::from_columns(&columns) };
        // −d/ds (C_q q̇ + C_t) along (q̇, 1), from the first derivatives by dual numbers.
        let rate = |s: f64| {
            let moved: [f64; N] = std::array::from_fn(|k| q[k] + s * qd[k]);
            let at = dual_terms::<E, N, M>(equation, &moved, qd, t + s);
            at.c_q * DVector::from_row_slice(qd) + at.c_t
        };
        let q_d = -(rate(h) - rate(-h)) / (2.0 * h);
        let c = column(&DVector::from_row_slice(&equation.plain(q, t)));
        Central { c, c_q, c_t: column(&slope(&[0.0; N], 1.0)), q_d: column(&q_d), reliable: true }
    }
}
