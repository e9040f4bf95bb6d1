//! The gradient of one number by all parameters at once, through the transposed factors of C_q.

use super::along::{Along, Prepared};
use super::measured::{along, refuse_own};
use super::sensitivities::{Sensitivity, Solver};
use super::smooth;
use crate::ask::measure::Measure;
use crate::model::error::Result;
use crate::model::no_derivative::NoDerivative;
use crate::solve::motion::Motion;
use crate::system::System;

/// ∂F/∂q, ∂F/∂q̇ and ∂F/∂q̈ at one time.
type Slopes = [Vec<f64>; 3];

impl System {
    /// The derivatives of one number F by parameters, where F is a function of a measure y, ẏ and ÿ over a
    /// motion: `weights` gives ∂F/∂y, ∂F/∂ẏ and ∂F/∂ÿ at each time by its number. One backward solve serves
    /// all parameters. With J = C_q,
    ///
    /// ```text
    /// Jᵀ λ₂ = F_q̈      Jᵀ λ₁ = F_q̇ − 2 J̇ᵀ λ₂      Jᵀ λ₀ = F_q − J̇ᵀ λ₁ − J̈ᵀ λ₂
    /// F_p = −Σ (λ₀ · C_p + λ₁ · Ċ_p + λ₂ · C̈_p)
    /// ```
    ///
    /// A dependence of the measure on p itself is not in it. Of a redundant mechanism the sum is taken over
    /// [`System::sensitivities`].
    ///
    /// Errors: those of [`System::sensitivities`] and [`crate::Sensitivities::of`].
    pub fn gradient(
        &self,
        motion: &Motion,
        names: impl IntoIterator<Item = impl AsRef<str>>,
        what: impl Measure,
        weights: impl Fn(usize) -> [f64; 3],
    ) -> Result<Vec<f64>> {
        self.own(motion)?;
        let names: Vec<String> = names.into_iter().map(|name| name.as_ref().to_string()).collect();
        names.iter().try_for_each(|name| refuse_own(self, &what, name))?;
        let slopes = self.slopes(motion, &what, weights)?;
        if self.is_redundant() {
            return self.summed(motion, &names, slopes);
        }
        smooth::check(self, motion, names.first().map_or("", String::as_str))?;
        let mut prepared = Prepared::new(self, &names)?;
        let mut gradient = vec![0.0; names.len()];
        for ((k, &t), slopes) in motion.times().iter().enumerate().zip(slopes) {
            let along = prepared.at(t, [motion.q(k), motion.qd(k), motion.qdd(k)]);
            let solver = Solver::at(self, t, motion.q(k))?;
            let Some(adjoint) = adjoint(&solver, &along, slopes) else { continue };
            for (sum, by_p) in gradient.iter_mut().zip(&along.by_p) {
                for (row, jet) in by_p {
                    *sum -= adjoint.iter().zip(jet).map(|(adjoint, c_p)| adjoint[*row] * c_p).sum::<f64>();
                }
            }
        }
        match gradient.iter().zip(&names).find(|(sum, _)| !sum.is_finite()) {
            Some((_, name)) => {
                Err(NoDerivative::error(name, "a term of the equations has no finite derivative"))
            }
            None => Ok(gradient),
        }
    }

    /// The slopes of F at each time: y_p = y_q q_p and its derivatives by time, coordinate by coordinate.
    fn slopes(
        &self,
        motion: &Motion,
        what: &dyn Measure,
        weights: impl Fn(usize) -> [f64; 3],
    ) -> Result<Vec<Slopes>> {
        let n = self.n_coordinates();
        let mut slopes: Vec<Slopes> = (0..motion.len()).map(|_| [(); 3].map(|()| vec![0.0; n])).collect();
        for j in 0..n {
            let y = along(self, motion, what, &Sensitivity::of_coordinate(j, n, motion.len()))?;
            for (k, [by_q, by_qd, by_qdd]) in slopes.iter_mut().enumerate() {
                let ([a, b, c], [y0, y1, y2]) = (weights(k), [y.value[k], y.rate[k], y.second_rate[k]]);
                (by_q[j], by_qd[j], by_qdd[j]) = (a * y0 + b * y1 + c * y2, b * y0 + 2.0 * c * y1, c * y0);
            }
        }
        Ok(slopes)
    }

    /// F_p from the derivatives by each parameter.
    fn summed(&self, motion: &Motion, names: &[String], slopes: Vec<Slopes>) -> Result<Vec<f64>> {
        let sensitivities = self.sensitivities(motion, names)?;
        let sum = |one: &Sensitivity| {
            let at = |(k, slopes): (usize, &Slopes)| {
                let orders = [one.q(k), one.qd(k), one.qdd(k)].concat();
                slopes.iter().flatten().zip(orders).map(|(slope, by_p)| slope * by_p).sum::<f64>()
            };
            slopes.iter().enumerate().map(at).sum()
        };
        Ok(sensitivities.all().iter().map(sum).collect())
    }
}

/// λ₀, λ₁ and λ₂.
fn adjoint(solver: &Solver<'_>, along: &Along, [mut w0, mut w1, w2]: Slopes) -> Option<Slopes> {
    let second = solver.transposed(&w2)?;
    for (row, column, jet) in &along.by_q {
        w1[*column] -= 2.0 * jet[1] * second[*row];
        w0[*column] -= jet[2] * second[*row];
    }
    let first = solver.transposed(&w1)?;
    along.by_q.iter().for_each(|(row, column, jet)| w0[*column] -= jet[1] * first[*row]);
    Some([solver.transposed(&w0)?, first, second])
}
