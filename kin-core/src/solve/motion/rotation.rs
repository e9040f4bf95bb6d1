//! Computes the angular velocity and acceleration of spatial bodies over time.

use super::{Motion, Series};
use crate::coordinates::units::Unit;
use crate::coordinates::units::Units;
use crate::coordinates::{SpatialBody, Target};
use crate::model::state::SpatialState;
use crate::numbers::algebra::Vec3;
use crate::outcome::error::Result;

/// The angular velocity ω and acceleration α of a spatial body at each time, and α̇ if the run
/// computed the jerk.
#[derive(Clone, Debug, PartialEq)]
pub struct RotationMotion {
    times: Vec<f64>,
    units: Units,
    omega: Vec<Vec3>,
    alpha: Vec<Vec3>,
    alpha_rate: Vec<Vec3>,
    /// (e0, e) of the body, to convert global components to the body frame.
    p: Vec<[f64; 4]>,
}

impl Motion {
    /// Returns the angular velocity and acceleration of a spatial body over time, in global
    /// components. \[rad/s, rad/s²\]
    ///
    /// Kin computes both vectors from the Euler parameters: ω = 2 (e0 ė − ė0 e + e × ė), α = 2 (e0
    /// ë − ë0 e + e × ë).
    ///
    /// For a planar body use θ̇ and θ̈ of [`Motion::coordinate`].
    ///
    /// Errors: the body belongs to another mechanism.
    pub fn rotation(&self, body: impl Into<SpatialBody>) -> Result<RotationMotion> {
        let columns = self.columns(&Target::Spatial(body.into()), "rotation")?;
        let times = self.times().to_vec();
        let units = self.unit_words().clone();
        let mut all = RotationMotion {
            times,
            units,
            omega: vec![],
            alpha: vec![],
            alpha_rate: vec![],
            p: vec![],
        };
        for k in 0..self.len() {
            let orders = self
                .orders(k, columns.clone())
                .map(|row| row.get(3..).and_then(|p| p.first_chunk::<4>()).copied());
            // The ground has no coordinates and is at rest.
            let p = orders[0].unwrap_or([1.0, 0.0, 0.0, 0.0]);
            let [pd, pdd, pddd] = [orders[1], orders[2], orders[3]].map(Option::unwrap_or_default);
            all.p.push(p);
            all.omega.push(turn(p, pd));
            all.alpha.push(turn(p, pdd));
            if self.has_jerk() {
                all.alpha_rate.push(turn(p, pddd) + turn(pd, pdd));
            }
        }
        Ok(all)
    }

    /// Adds the angular velocity ω and acceleration α of a spatial body to the motion, as the
    /// columns `NAME.omega_x`, …, `NAME.alpha_z`.
    ///
    /// Errors: the body belongs to another mechanism, the name is empty or taken.
    pub fn add_rotation(&mut self, name: &str, body: impl Into<SpatialBody>) -> Result<()> {
        for component in self.rotation(body)?.components() {
            self.add_output(
                &format!("{name}.{}", component.name()),
                component.unit(),
                component.values().to_vec(),
            )?;
        }
        Ok(())
    }
}

/// Returns 2 (a0 b − b0 a + a × b), twice the vector part of b a*.
fn turn([a0, a1, a2, a3]: [f64; 4], [b0, b1, b2, b3]: [f64; 4]) -> Vec3 {
    let a = Vec3::new(a1, a2, a3);
    let b = Vec3::new(b1, b2, b3);
    (b * a0 - a * b0 + a.cross(b)) * 2.0
}

impl RotationMotion {
    /// Returns the times. \[s\]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Returns the angular velocity ω at each time. \[rad/s\]
    pub fn omega(&self) -> &[Vec3] {
        &self.omega
    }

    /// Returns the angular acceleration α = ω̇ at each time. \[rad/s²\]
    pub fn alpha(&self) -> &[Vec3] {
        &self.alpha
    }

    /// Returns the derivative α̇ of the angular acceleration at each time. \[rad/s³\]
    ///
    /// The slice is empty if the run did not compute the jerk ([`crate::SolverOptions::jerk`]).
    pub fn alpha_rate(&self) -> &[Vec3] {
        &self.alpha_rate
    }

    /// Returns the vectors with components in the frame of the body: Aᵀ ω, Aᵀ α.
    #[must_use]
    pub fn in_body(&self) -> RotationMotion {
        let local = |all: &[Vec3]| {
            let turned = all.iter().zip(&self.p).map(|(v, [e0, e1, e2, e3])| {
                let state = SpatialState::new([0.0, 0.0, 0.0, *e0, *e1, *e2, *e3]);
                state.a().transpose() * *v
            });
            turned.collect()
        };
        RotationMotion {
            times: self.times.clone(),
            units: self.units.clone(),
            omega: local(&self.omega),
            alpha: local(&self.alpha),
            alpha_rate: local(&self.alpha_rate),
            // The components are already in the frame of the body.
            p: vec![[1.0, 0.0, 0.0, 0.0]; self.p.len()],
        }
    }

    /// Returns the unit of a derivative of an angle.
    fn unit(&self, order: usize) -> String {
        self.units.text(Unit::Radian, order)
    }

    /// Returns the magnitude |ω| of the angular velocity over time. \[rad/s\]
    pub fn speed(&self) -> Series {
        Series::new(
            "angular speed",
            self.unit(1),
            (&self.times, &self.units),
            self.omega.iter().map(|omega| omega.norm()).collect(),
        )
    }

    /// Returns the angular velocity ω · h/|h| about the direction h over time. \[rad/s\]
    ///
    /// The direction h has components in the same frame as ω.
    ///
    /// For the speed of a shaft about its axis write `in_body().about(axis)`.
    pub fn about(&self, h: impl Into<Vec3>) -> Series {
        let h = h.into();
        let h = h / h.norm();
        Series::new(
            "angular velocity",
            self.unit(1),
            (&self.times, &self.units),
            self.omega.iter().map(|omega| omega.dot(h)).collect(),
        )
    }

    /// Returns each component of ω and α over time, with the names `omega_x`, …, `alpha_z`.
    pub fn components(&self) -> Vec<Series> {
        let quantities = [("omega", 1, &self.omega), ("alpha", 2, &self.alpha)];
        let axes = [("x", 0), ("y", 1), ("z", 2)];
        let component = |(name, order, all): (&str, usize, &Vec<Vec3>),
                         (axis, k): (&str, usize)| {
            let values = all.iter().map(|v| v.to_array()[k]).collect();
            Series::new(
                format!("{name}_{axis}"),
                self.unit(order),
                (&self.times, &self.units),
                values,
            )
        };
        quantities
            .into_iter()
            .flat_map(|quantity| axes.map(|axis| component(quantity, axis)))
            .collect()
    }
}
