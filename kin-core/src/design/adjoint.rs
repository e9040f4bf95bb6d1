//! Computes the gradient of one number by all parameters at once, through the transposed factors of
//! C_q.

use super::agreement::{self, Agreement};
use super::along::{Along, Prepared};
use super::measured::refuse_own;
use super::partials::partials;
use super::solver::SlopeSolver;
use super::{smooth, variation};
use crate::ask::measure::Measure;
use crate::outcome::error::{Error, Result};
use crate::solve::motion::Motion;
use crate::system::System;

/// ∂F/∂q, ∂F/∂q̇ and ∂F/∂q̈, each with a row for each time.
pub(super) type Weights = [Vec<f64>; 3];

impl System {
    /// Returns the derivatives of one number F by parameters, where F is a function of a measure y,
    /// ẏ and ÿ over a motion.
    ///
    /// The function `weights` receives the index of a time and returns ∂F/∂y, ∂F/∂ẏ and ∂F/∂ÿ at
    /// this time. Kin needs one backward solve for all parameters together. With J = C_q:
    ///
    /// ```text
    /// Jᵀ λ₂ = F_q̈      Jᵀ λ₁ = F_q̇ − 2 J̇ᵀ λ₂      Jᵀ λ₀ = F_q − J̇ᵀ λ₁ − J̈ᵀ λ₂
    /// F_p = −Σ (λ₀ · C_p + λ₁ · Ċ_p + λ₂ · C̈_p)
    /// ```
    ///
    /// The gradient omits a direct dependence of the measure on p. For a redundant mechanism Kin
    /// uses as many independent rows of C_q as the mechanism has coordinates. Kin checks for all
    /// parameters at once that the other equations agree.
    ///
    /// Errors: those of [`System::sensitivities`] and [`crate::design::Sensitivities::of`].
    pub fn gradient(
        &self,
        motion: &Motion,
        names: impl IntoIterator<Item = impl AsRef<str>>,
        what: impl Measure,
        weights: impl Fn(usize) -> [f64; 3],
    ) -> Result<Vec<f64>> {
        self.own_as_it_is(motion)?;
        let names: Vec<String> = names.into_iter().map(|name| name.as_ref().to_string()).collect();
        names.iter().try_for_each(|name| refuse_own(self, &what, name))?;
        let weights = self.weights(motion, &what, weights)?;
        smooth::check(self, motion, names.first().map_or("", String::as_str))?;
        let mut prepared = Prepared::new(self, &names)?;
        let gradient = terms(&mut prepared, motion, &names, &weights)?;
        match gradient.iter().zip(&names).find(|(sum, _)| !sum.is_finite()) {
            Some((_, name)) => {
                Err(Error::no_derivative(name, "a term of the equations has no finite derivative"))
            }
            None => Ok(gradient),
        }
    }

    /// Returns the weights of F at each time, from y_q and its time derivatives.
    fn weights(
        &self,
        motion: &Motion,
        what: &dyn Measure,
        weights: impl Fn(usize) -> [f64; 3],
    ) -> Result<Weights> {
        let n = self.n_coordinates();
        let mut found = [(); 3].map(|()| vec![0.0; n * motion.len()]);
        let [by_q, by_qd, by_qdd] = &mut found;
        let partials = partials(self, motion, what)?;
        for k in 0..motion.len() {
            let [a, b, c] = weights(k);
            for (j, [y_q, first, second]) in &partials {
                let place = k * n + j;
                let [y0, y1, y2] = [y_q[k], first[k], second[k]];
                by_q[place] = a * y0 + b * y1 + c * y2;
                by_qd[place] = b * y0 + 2.0 * c * y1;
                by_qdd[place] = c * y0;
            }
        }
        Ok(found)
    }
}

/// Returns the gradient as a sum over all times: with a tape if that is faster, otherwise time by
/// time.
fn terms(
    prepared: &mut Prepared<'_>,
    motion: &Motion,
    names: &[String],
    weights: &Weights,
) -> Result<Vec<f64>> {
    let system = prepared.system;
    let n = system.n_coordinates();
    let mut gradient = vec![0.0; names.len()];
    let mut left = None;
    if variation::pays(motion) {
        let agreement =
            if system.is_redundant() { Agreement::along(prepared, motion, names)? } else { None };
        left = variation::adjoint(prepared, agreement.as_ref(), motion, weights, &mut gradient);
    }
    let mut solver = SlopeSolver::new(system);
    for k in left.unwrap_or_else(|| (0..motion.len()).collect()) {
        let t = motion.times()[k];
        let orders = [motion.q(k), motion.qd(k), motion.qdd(k)];
        let along = prepared.at(t, orders);
        solver.go_to(t, orders)?;
        agreement::check(&mut solver, prepared, &along, names)?;
        let own = weights.each_ref().map(|all| all[k * n..][..n].to_vec());
        let adjoint = adjoint(&solver, &along, vec![0.0; system.n_equations()], own);
        for (sum, by_p) in gradient.iter_mut().zip(&along.by_p) {
            for (row, jet) in by_p {
                *sum -=
                    adjoint.iter().zip(jet).map(|(adjoint, c_p)| adjoint[*row] * c_p).sum::<f64>();
            }
        }
    }
    Ok(gradient)
}

/// Returns λ₀, λ₁ and λ₂. `fixed` is λ₂ in the rows that are not in use, and zero in the others.
pub(super) fn adjoint(
    solver: &SlopeSolver<'_>,
    along: &Along,
    fixed: Vec<f64>,
    [mut w0, mut w1, mut w2]: Weights,
) -> Weights {
    for (row, column, jet) in &along.by_q {
        w2[*column] -= jet[0] * fixed[*row];
    }
    let second: Vec<f64> =
        solver.transposed(&w2).iter().zip(&fixed).map(|(own, fixed)| own + fixed).collect();
    for (row, column, jet) in &along.by_q {
        w1[*column] -= 2.0 * jet[1] * second[*row];
        w0[*column] -= jet[2] * second[*row];
    }
    let first = solver.transposed(&w1);
    along.by_q.iter().for_each(|(row, column, jet)| w0[*column] -= jet[1] * first[*row]);
    [solver.transposed(&w0), first, second]
}
