//! The core of Kin: numbers and vectors, bodies and coordinates, constraints and joints, the solver
//! and its results.
//!
//! Use it through the facade crate `kin`.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
// Where `lanes` knows no SIMD registers (WebAssembly, among others), everything runs by plain
// steps, and programs are idle.
#![cfg_attr(not(any(target_arch = "x86_64", target_arch = "aarch64")), allow(dead_code))]

extern crate self as kin;

// Items that are hidden here are listed in `extend`: ordinary programs do not call them.

mod ask;
pub mod data;
mod design;
#[doc(hidden)]
pub mod emitted;
pub mod extend;
mod forces;
pub mod joints;
mod linear;
mod model;
mod numbers;
mod program;
mod solve;
pub mod system;
#[cfg(test)]
mod testing;

pub use ask::{check, diagnosis, measure, proof};
#[doc(hidden)]
pub use model::{blame, coordinates, dual_route, state, terms};
pub use model::{constraint, dimension, error, law, mechanism};
pub use numbers::algebra;
#[doc(hidden)]
pub use numbers::real;
pub use solve::{motion, newton, sweep};

#[cfg(feature = "argmin")]
pub use argmin;
pub use constraint::{Constraint, Route, RouteReason, Routed};
pub use coordinates::{
    Coord, Coordinate, Ground, IntoAxis, IntoCoordinate, IntoPlanarBody, IntoSpatialBody, Link,
    Planar, PlanarBody, Rate, Spatial, SpatialBody, SpatialLink, Time, any_coord, any_planar,
    any_spatial,
};
pub use data::Registry;
pub use design::{
    Contribution, ExtremeSensitivity, Feature, LookedAt, MeasureSensitivity, Objective, Off,
    Proved, Samples, Sampling, SecondOrder, Sensitivities, Sensitivity, Tolerance,
};
pub use dimension::{
    Dimension, DimensionError, Distribution, IntoGravity, IntoNumber, IntoParameter, IntoVector,
};
pub use error::{Error, OtherMotion, Result};
pub use forces::library as loads;
pub use forces::{Acted, Balance, Drive, Energy, Forces, Peak, Reaction, Sharing};
pub use joints::spatial;
pub use kin_macros::{constraint, force, helper, law, potential};
pub use law::{Beyond, Break, Ends, Law, LawRange};
pub use measure::{Crossing, Extreme, Extremes, Measure};
pub use mechanism::{
    ConstraintId, Direction, Facing, IntoConstraint, IntoSpatialPose, Marker, Mechanism, Pose,
    Preferred, SpatialPose, deg, linspace, pose,
};
pub use model::error::surface::Surface;
pub use model::growth::{Growth, Unbounded};
pub use model::jammed::Jammed;
pub use model::loads::{
    Along, ByLaws, Friction, IntoAlong, IntoLoad, Load, Massive, Potential, Solid, Turning,
};
pub use model::no_derivative::NoDerivative;
pub use model::not_unique::NotUnique;
pub use model::units::Units;
pub use motion::{
    Displaced, EngineCounts, Event, EventKind, Line, Motion, PointMotion, Quantity, QuantityValues,
    RotationMotion, Series,
};
pub use nalgebra;
pub use newton::{CrossedBreak, Engine, Follow, Options, Report, Stop};
pub use numbers::algebra::{Axis, EulerParameters, Mat2, Mat3, Vec2, Vec3, vec2, vec3};
pub use proof::{Doubt, DoubtReason, Proof, StepProof, Tube};
pub use solve::assembly::{Assemblies, Assembly, AssemblyOptions, Complete, Label, SearchOptions};
pub use solve::compile::Compiled;
pub use solve::follow::{Branch, SingularKind, SingularPosition};
pub use sweep::Sweep;
pub use system::{Solution, System};
