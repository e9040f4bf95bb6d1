//! Computes the mechanical advantage from virtual power.

use nalgebra::DVector;

use crate::ask::measure::Measure;
use crate::outcome::error::{Error, Result};
use crate::outcome::motion::Series;
use crate::solve::motion::Motion;
use crate::solve::newton::Outcome;
use crate::system::System;
use crate::system::evaluate::Block;

/// Rows of a redundant mechanism with a residual above this value, in units of order 1, contradict
/// each other. \[-\]
const LEFT: f64 = 1e-8;

impl System {
    /// Returns the mechanical advantage of an output over a driver at each time of a motion. \[-,
    /// 1/m, m\]
    ///
    /// The mechanical advantage is the force or torque along the output x for a unit of the
    /// driver's effort. Kin computes df/dx, where f is the law of the driver and all other drivers
    /// are at rest. The result is positive if x grows with f. Kin ignores masses, loads and
    /// friction. At a dead centre of the output the mechanical advantage is infinite.
    ///
    /// ```
    /// # use kin::prelude::*;
    /// # fn main() -> kin::Result<()> {
    /// let mut m = Mechanism::new("jack");
    /// let (lower, upper) = (m.link("lower arm", 0.2)?, m.link("upper arm", 0.2)?);
    /// let table = m.planar("table", pose(0.0, 0.35, 0.0))?;
    /// m.add("foot", revolute(lower, m.ground(), lower.start(), vec2(0.0, 0.0)))?;
    /// m.add("knee", revolute(lower, upper, lower.end(), upper.start()))?;
    /// m.add("head", revolute(upper, table, upper.end(), vec2(0.0, 0.0)))?;
    /// let (origin, along) = (vec2(0.0, 0.0), vec2(1.0, 0.0));
    /// m.add("guide", prismatic(table, m.ground(), origin, origin, along, 0.0))?;
    /// let advance = Law::linear(0.1, -0.04);
    /// m.add("spindle", drive_point_along(lower, lower.end(), along, advance))?;
    /// m.prefer(lower, deg(60.0));
    /// let system = m.build()?;
    /// let motion = system.run(linspace(0.0, 2.0, 21))?;
    /// let advantage = system.mechanical_advantage(&motion, "spindle", table.y())?;
    /// // With the knee at x the table is at y = 2 √(l² − x²).
    /// let by_hand = -0.5 * (0.2_f64.powi(2) - 0.01).sqrt() / 0.1;
    /// assert!((advantage.values()[0] - by_hand).abs() < 1e-12);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// The output can be any [`Measure`].
    ///
    /// Errors: no driver has the name; the driver has several rows; redundant equations prevent the
    /// driver from moving alone; the motion has a singular position; those of [`System::measure`].
    pub fn mechanical_advantage(
        &self,
        motion: &Motion,
        drive: &str,
        output: impl Measure,
    ) -> Result<Series> {
        self.own_as_it_is(motion)?;
        let block = self.driver_of_one_row(drive)?;
        let row = block.rows().start;
        let [mut moved, mut still] = [0, 1].map(|_| Motion::new(self, motion.len()));
        let zero = vec![0.0; self.n_coordinates()];
        for (k, &t) in motion.times().iter().enumerate() {
            let q = motion.q(k);
            let outcome = Outcome { iterations: 0, residual: motion.residuals()[k] };
            moved.append(t, [q, &self.moved_by(row, drive, q, t)?, &zero, &[]], outcome, 0);
            still.append(t, [q, &zero, &zero, &[]], outcome, 0);
        }
        let moved = output.of(self, &moved)?;
        let still = output.of(self, &still)?;
        // A measure that depends on time has a velocity even if nothing moves.
        let slopes =
            moved.rate.values().iter().zip(still.rate.values()).map(|(all, own)| all - own);
        let values =
            slopes.map(|slope| if slope == 0.0 { f64::INFINITY } else { slope.recip() }).collect();
        let units = motion.unit_words();
        let name = format!("{drive}.advantage on {}", moved.value.name());
        let input = self.unit_of_row(block, 0).map(|unit| units.in_own_words(&unit));
        let unit = unit(input.as_deref().unwrap_or("-"), moved.value.unit());
        Ok(Series::new(name, unit, motion.clock(), values))
    }

    /// Returns the driver with this name, which must have one row.
    fn driver_of_one_row(&self, drive: &str) -> Result<&Block> {
        let drives = || self.equations().blocks.iter().filter(|block| block.drives);
        let block =
            drives().find(|block| block.name == drive).ok_or_else(|| Error::UnknownName {
                what: "driver",
                name: drive.to_string(),
                known: drives().map(|block| block.name.clone()).collect(),
            })?;
        match block.rows().len() {
            1 => Ok(block),
            rows => Err(refused(
                drive,
                format!("the driver drives {rows} numbers at once, so its input is ambiguous"),
            )),
        }
    }

    /// Returns dq/df: the motion for one unit of the law of that row.
    fn moved_by(&self, row: usize, drive: &str, q: &[f64], t: f64) -> Result<Vec<f64>> {
        if !self.is_redundant() {
            let mut linear = self.linearized(q, t)?;
            if !linear.factor() {
                return Err(self.singular(t, q, None));
            }
            linear.rhs_mut().fill(0.0);
            linear.rhs_mut()[row] = 1.0;
            linear.solve();
            return Ok(linear.solution().to_vec());
        }
        let mut c_q = self.jacobian(q, t)?;
        let measures = self.model().measure(q, t);
        c_q.column_iter_mut().zip(&measures.sizes).for_each(|(mut column, size)| column *= *size);
        c_q.row_iter_mut().zip(&measures.norms).for_each(|(mut row, norm)| row /= *norm);
        let mut rhs = DVector::zeros(self.n_equations());
        rhs[row] = 1.0 / measures.norms[row];
        let solved = c_q.clone().svd(true, true).solve(&rhs, LEFT);
        let shares = solved.map_err(|reason| refused(drive, reason.to_string()))?;
        if (c_q * &shares - &rhs).amax() > LEFT * rhs.amax() {
            let reason = "the driver cannot move alone, because other drivers and redundant equations hold the same parts";
            return Err(refused(drive, reason.to_string()));
        }
        Ok(shares.iter().zip(&measures.sizes).map(|(share, size)| share * size).collect())
    }
}

/// Returns the unit of df/dx with angles as numbers: force per force, force per torque or torque
/// per force.
fn unit(input: &str, output: &str) -> String {
    match (input, output) {
        _ if input == output => "-".to_string(),
        (_, "rad" | "-") => input.replace("rad", "-"),
        ("rad" | "-", _) => format!("1/{output}"),
        _ => format!("{input}/{output}"),
    }
}

fn refused(drive: &str, reason: String) -> Error {
    Error::InvalidParameters {
        constraint: drive.to_string(),
        kind: "mechanical advantage".to_string(),
        reason,
    }
}

#[cfg(test)]
mod tests {
    use super::unit;

    #[test]
    fn angles_have_no_unit() {
        let all = [
            ("mm", "mm"),
            ("rad", "rad"),
            ("rad", "mm"),
            ("mm", "rad"),
            ("rad", "-"),
            ("mm", "m^2"),
        ];
        assert_eq!(all.map(|(f, x)| unit(f, x)), ["-", "-", "1/mm", "mm", "-", "mm/m^2"]);
    }
}
