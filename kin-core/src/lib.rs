//! The core of Kin: numbers and vectors, bodies and coordinates, constraints and joints, the solver
//! and its results.
//!
//! Programs use this crate through the facade crate `kin`.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
// Where `lanes` knows no SIMD registers (WebAssembly, among others), everything runs by plain
// steps, and programs are idle.
#![cfg_attr(not(any(target_arch = "x86_64", target_arch = "aarch64")), allow(dead_code))]

extern crate self as kin;

// Items that are hidden here are listed in `extend`: ordinary programs do not call them.

mod ask;
#[doc(hidden)]
pub mod coordinates;
pub mod data;
pub mod design;
mod dimensions;
#[doc(hidden)]
pub mod emitted;
pub mod extend;
pub mod forces;
pub mod joints;
pub mod law;
mod linear;
mod model;
mod numbers;
mod outcome;
mod program;
mod solve;
mod system;
#[cfg(test)]
mod testing;

#[doc(hidden)]
pub use model::{blame, constraint, dual_route, state, terms};
#[doc(hidden)]
pub use numbers::real;

pub use ask::solver::Solver;
pub use ask::{check, diagnosis};
pub use constraint::Constraint;
pub use coordinates::{
    Coord, Coordinate, Ground, Link, Planar, PlanarBody, Rate, Spatial, SpatialBody, SpatialLink,
    Time,
};
pub use dimension::Dimension;
pub use error::{Error, Result};
pub use kin_macros::{constraint, force, helper, law, potential};
pub use law::Law;
pub use model::loads::Load;
pub use model::mechanism::{Mechanism, Pose, SpatialPose, deg, linspace, pose};
pub use nalgebra;
pub use numbers::algebra::{Axis, EulerParameters, Mat2, Mat3, Vec2, Vec3, vec2, vec3};
pub use solve::motion::Motion;
pub use solve::options::{Engine, Follow, SolverOptions};
pub use system::System;

/// Errors, and the data that they carry.
pub mod error {
    pub use crate::outcome::DimensionError;
    pub use crate::outcome::error::surface::Surface;
    pub use crate::outcome::error::{
        CannotReach, Error, FailureKind, OtherMotion, Result, RunFailure, UnfollowedReason,
    };
    pub use crate::outcome::growth::Unbounded;
    pub use crate::outcome::jammed::Jammed;
    pub use crate::outcome::no_derivative::NoDerivative;
    pub use crate::outcome::not_unique::NotUnique;
}

/// Numbers with a name, a unit, a range and a tolerance, and the traits of arguments that accept
/// them.
pub mod dimension {
    pub use crate::dimensions::{Dimension, IntoGravity, IntoNumber, IntoParameter, IntoVector};
}

/// Handles of a [`crate::Mechanism`], and the traits of its arguments.
pub mod mechanism {
    pub use crate::coordinates::{IntoCoordinate, IntoPlanarBody, IntoSpatialBody};
    pub use crate::dimensions::IntoAxis;
    pub use crate::model::body::Body;
    pub use crate::model::mechanism::{
        ConstraintId, Direction, Facing, IntoConstraint, IntoSpatialPose, Marker, Preferred,
        UnitWords,
    };
}

/// Prints a mechanism as a file of C, for a controller or another program.
pub mod emit {
    pub use crate::ask::emit::{Options, c};
}

/// Options and results of a [`crate::Solver`]: stop rules, searches, assemblies, sweeps.
pub mod solver {
    pub use crate::ask::circuit::{Circuit, CircuitPoint};
    pub use crate::ask::follower::{Configuration, Follower, Map, Mapped, Start};
    pub use crate::ask::released::{Granted, Reached, Released, Wish};
    pub use crate::ask::solver::At;
    pub use crate::outcome::named_value::NamedValue;
    pub use crate::solve::assembly::{
        Assemblies, Assembly, AssemblyOptions, Complete, Label, SearchOptions,
    };
    pub use crate::solve::circuit::CircuitEnd;
    pub use crate::solve::compiled::description::Compiled;
    pub use crate::solve::options::Stop;
    pub use crate::solve::sweep::Sweep;
}

/// Parts of a [`crate::Motion`], and results that Kin derives from a motion: quantities, events,
/// extremes, proofs.
pub mod results {
    pub use crate::ask::measure::{Crossing, Extreme, Extremes, Measure};
    pub use crate::ask::proof;
    pub use crate::ask::proof::{Proof, StepProof, Tube, Unproved, UnprovedReason};
    pub use crate::coordinates::units::Units;
    pub use crate::outcome::motion::CrossedBreak;
    pub use crate::solve::follow::{Branch, SingularKind, SingularPosition};
    pub use crate::solve::motion::{
        Displacement, EngineCounts, Event, EventKind, Line, PointMotion, Quantity, QuantityValues,
        RotationMotion, Series, Warning, WarningKind,
    };
    pub use crate::system::{Report, Solution};
}

/// The types of loads, and the library of springs, dampers, struts and similar loads.
pub mod loads {
    pub use crate::forces::library::*;
    pub use crate::model::loads::{
        Along, ByLaws, Friction, HasMass, HasTorque, IntoAlong, IntoLoad, Potential, Solid,
    };
}
