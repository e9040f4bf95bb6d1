//! Differentiates the time of a toggle by parameters.

use nalgebra::DMatrix;

use super::along::Prepared;
use super::smooth;
use crate::outcome::error::{Error, Result};
use crate::outcome::motion::{SingularKind, SingularPosition};
use crate::solve::motion::Motion;
use crate::solve::newton::Outcome;
use crate::system::System;

/// Singular values below this share of the largest one are zero. \[-\]
const VANISHES: f64 = 1e-7;

/// A driver takes part in the singularity if λ has more than this share in its row, for rows and
/// columns of order 1 and |λ| = 1. The drivers that take part must push with more than this share
/// of their possible sum.
///
/// A run knows a change point to about 1e-8 of its sizes, and λ has the same error, so 1e-6 is a
/// hundred times that. Both are shares in units of the sizes, so they are the same in mm and in km.
/// The speed of a driver that takes no part does not matter. \[-\]
const PUSHES: f64 = 1e-6;

impl System {
    /// Returns the exact derivatives of the time t* of a toggle by parameters and dimensions. \[s
    /// per unit of p\]
    ///
    /// At a toggle one combination λ of the equations depends on no coordinate, λᵀ C_q = 0. So C(q,
    /// t, p) = 0 gives
    ///
    /// ```text
    /// dt*/dp = −λᵀ C_p / λᵀ C_t
    /// ```
    ///
    /// for any motion of the coordinates. A run must have ended at the toggle: the toggle is the
    /// last of [`Motion::singular_positions`] in [`crate::Error::motion`].
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("reach");
    /// let length = m.dimension("rod", 0.5)?;
    /// let rod = m.link("rod", length)?;
    /// let slider = m.planar("slider", pose(0.4, 0.3, 0.0))?;
    /// m.add("O", revolute(rod, Ground, rod.start(), (0.0, 0.0)))?;
    /// m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0)))?;
    /// m.add("upright", drive_angle(slider, Law::constant(0.0)))?;
    /// m.add("lift", drive(slider.y(), Law::linear(0.3, 0.1)))?;
    /// let system = m.build()?;
    /// let error = system.run(linspace(0.0, 4.0, 41)).expect_err("rod and slider are in line");
    /// let motion = error.motion().expect("a motion");
    /// let toggle = motion.singular_positions().last().expect("a toggle");
    /// let by_rod = system.toggle_by(toggle, ["rod"])?[0];
    /// assert!((toggle.t - 2.0).abs() < 1e-9 && (by_rod - 10.0).abs() < 1e-9); // 0.3 + 0.1 t = rod
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Errors: the singular position is a change point, whose branches cross only at the present
    /// value of the parameter; the mechanism is redundant; several parts of the mechanism are
    /// singular at the same time; those of [`System::sensitivities`], except the error for a
    /// singular position.
    pub fn toggle_by(
        &self,
        toggle: &SingularPosition,
        names: impl IntoIterator<Item = impl AsRef<str>>,
    ) -> Result<Vec<f64>> {
        let names: Vec<String> = names.into_iter().map(|name| name.as_ref().to_string()).collect();
        let by = names.first().map_or("", String::as_str);
        let t = toggle.t;
        let q = &toggle.q[..];
        let s = self.unit_words().time();
        self.check(q, "position")?;
        let refused = |reason: String| Err(Error::no_derivative(by, reason));
        if toggle.kind != SingularKind::TurningPoint {
            return refused(format!(
                "the position at t = {t} {s} is a change point, whose branches cross at these values only. Request the time of a toggle instead"
            ));
        }
        if self.is_redundant() {
            return refused(
                "Kin does not follow the time of a toggle in redundant mechanisms".to_string(),
            );
        }
        let still = vec![0.0; q.len()];
        let mut pose = Motion::new(self, 1);
        pose.append(t, [q, &still, &still, &[]], Outcome { iterations: 0, residual: 0.0 }, 0);
        smooth::check(self, &pose, by)?;
        let Some(Combination { lambda, norms }) = self.combination(q, t)? else {
            return refused(format!("at t = {t} {s} several parts are singular at once"));
        };
        let c_t = self.c_t(q, t)?;
        // In rows of order 1 no entry of λ is above 1.
        let [mut pushes, mut could] = [0.0; 2];
        for ((l, norm), x) in lambda
            .iter()
            .zip(&norms)
            .zip(&c_t)
            .filter(|((l, norm), _)| (*l * **norm).abs() > PUSHES)
        {
            pushes += l * x;
            could += (x / norm).abs();
        }
        if pushes.abs() <= PUSHES * could {
            return refused(format!("at t = {t} {s} no driver moves the singular parts"));
        }
        let along = Prepared::new(self, &names)?.at(t, [q, &still, &still]);
        let of = |(by_p, name): (&Vec<(usize, [f64; 3])>, &String)| {
            let found = -by_p.iter().map(|(row, jet)| lambda[*row] * jet[0]).sum::<f64>() / pushes;
            let reason = "a term of the equations has no finite derivative";
            if found.is_finite() { Ok(found) } else { Err(Error::no_derivative(name, reason)) }
        };
        along.by_p.iter().zip(&names).map(of).collect()
    }

    /// Returns λ with λᵀ C_q = 0, or `None` if there is none or several.
    fn combination(&self, q: &[f64], t: f64) -> Result<Option<Combination>> {
        let measures = self.model().measure(q, t);
        let mut c_q: DMatrix<f64> = self.jacobian(q, t)?;
        c_q.column_iter_mut().zip(&measures.sizes).for_each(|(mut column, size)| column *= *size);
        let norms: Vec<f64> = c_q.row_iter().map(|row| row.amax().max(f64::MIN_POSITIVE)).collect();
        c_q.row_iter_mut().zip(&norms).for_each(|(mut row, norm)| row /= *norm);
        let Some(svd) = c_q.try_svd(true, false, f64::EPSILON, 10_000) else { return Ok(None) };
        let values = &svd.singular_values;
        let vanish = values.iter().filter(|value| **value <= VANISHES * values.max()).count();
        let Some(u) = svd.u.as_ref().filter(|_| vanish == 1) else { return Ok(None) };
        let column = u.column(values.imin());
        let lambda = column.iter().zip(&norms).map(|(l, norm)| l / norm).collect();
        Ok(Some(Combination { lambda, norms }))
    }
}

/// λ with λᵀ C_q = 0. Multiplied by the norms of the rows it has the length 1.
struct Combination {
    lambda: Vec<f64>,
    norms: Vec<f64>,
}
