//! Builds the system of a mechanism, and diagnoses a mechanism that is not built.

use std::sync::Arc;

use crate::ask::solver::At;
use crate::coordinates::SpatialBody;
use crate::coordinates::layout::Kind;
use crate::joints::spatial;
use crate::model::loads::{Acting, Along, Line};
use crate::model::mechanism::Mechanism;
use crate::numbers::algebra::EulerParameters;
use crate::outcome::error::{Error, Result};
use crate::outcome::verdict::Diagnosis;
use crate::system::System;
use crate::system::evaluate::Equations;

impl Mechanism {
    /// Builds the system of the equations, with the norm constraints of spatial bodies at the end.
    ///
    /// The system may have more equations than coordinates.
    ///
    /// Errors: the mechanism has fewer equations than coordinates
    /// ([`CannotBeDriven`](crate::error::FailureKind::CannotBeDriven), with its diagnosis at
    /// t = 0); an earlier call that returns no result, such as [`Mechanism::prefer`], contained a
    /// mistake.
    pub fn build(self) -> Result<System> {
        let system = self.system()?;
        if system.n_equations() < system.n_coordinates() {
            return Err(Error::cannot_be_driven(system.diagnose(0.0)?));
        }
        Ok(system)
    }

    /// Diagnoses the mechanism at time t, after assembling it from its guess.
    ///
    /// Kin also diagnoses a mechanism that cannot be driven.
    ///
    /// Errors: those of [`Mechanism::build`], except the one for too few equations; t is not
    /// finite; the pose has the wrong length; Kin finds no nearby pose at which all equations are
    /// finite.
    pub fn diagnose<'q>(&self, at: impl Into<At<'q>>) -> Result<Diagnosis> {
        self.clone().system()?.diagnose(at)
    }

    /// Holds every idle rotation: a rotation of one body that moves no other body, such as the
    /// rotation of a rod between two ball joints about its axis.
    ///
    /// Kin adds one equation with the name `BODY.idle` for each idle rotation. The equation keeps
    /// the body at its angle at t = 0. The result lists the names of the held bodies; the list is
    /// empty if the mechanism has no idle rotation.
    ///
    /// Errors: those of [`Mechanism::diagnose`].
    pub fn hold_idle_turns(&mut self) -> Result<Vec<String>> {
        let found = self.diagnose(0.0)?;
        let mut held = Vec::new();
        for freedom in found.lasting_freedoms().filter(|freedom| freedom.idle) {
            let Some((name, axis)) = freedom.turn() else { continue };
            let Some(item) = self.layout.items.iter().position(|item| item.name == name) else {
                continue;
            };
            let first = self.layout.items[item].first;
            let Some([_, _, _, e0, e1, e2, e3]) =
                found.q.get(first..).and_then(|q| q.first_chunk::<7>()).copied()
            else {
                continue;
            };
            let turn = EulerParameters::new(e0, e1, e2, e3);
            let body = SpatialBody { mechanism: self.layout.mechanism, index: Some(item) };
            let h = turn.rotation().transpose() * axis;
            self.add(&format!("{name}.idle"), spatial::held_turn(body, turn, h))?;
            held.push(name.to_string());
        }
        Ok(held)
    }

    pub(in crate::ask) fn system(self) -> Result<System> {
        let mut mechanism = self.settled()?;
        let spatial = mechanism
            .layout
            .items
            .iter()
            .enumerate()
            .filter(|(_, item)| item.kind == Kind::Spatial);
        let norms: Vec<(String, usize)> =
            spatial.map(|(index, item)| (format!("{}.p", item.name), index)).collect();
        for (name, index) in norms {
            let body = SpatialBody { mechanism: mechanism.layout.mechanism, index: Some(index) };
            mechanism.add(&name, spatial::euler_norm(body))?;
        }
        let dimensions = mechanism.dimensions()?;
        let mut guess = mechanism.initial;
        for &(column, value) in &mechanism.preferred {
            guess[column] = value;
        }
        let equations = Equations::new(&mechanism.layout, mechanism.constraints);
        let mut system =
            System::new(mechanism.name, mechanism.layout, equations, guess, mechanism.preferred);
        system.loads = Arc::new(mechanism.loads);
        act_along_what_there_is(&system)?;
        system.set_dimensions(dimensions);
        system.set_limits(mechanism.limits)?;
        system.set_asked(&mechanism.asked)?;
        Ok(system)
    }
}

/// Returns an error unless every name along which a load acts exists.
fn act_along_what_there_is(system: &System) -> Result<()> {
    for (load, all) in &system.loads.loads {
        let mut unknown = None;
        all.parts(&mut |part| match part {
            Acting::Along(Along(Line::Named(name)), _) if !system.is_measure(name) => {
                unknown = Some(name)
            }
            _ => {}
        });
        if let Some(name) = unknown {
            let kind = "load".to_string();
            let reason = format!("the load acts along `{name}`: {}", system.no_measure(name));
            return Err(Error::InvalidParameters { constraint: load.clone(), kind, reason });
        }
    }
    Ok(())
}
