//! The core of Kin: numbers and vectors, bodies and coordinates, constraints and joints, the solver and its results.
//!
//! Use it through the facade crate `kin`.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
// Where `lanes` knows no SIMD registers (WebAssembly, among others), cases of a sweep run one by one, and what advances several together is idle.
#![cfg_attr(not(any(target_arch = "x86_64", target_arch = "aarch64")), allow(dead_code))]

extern crate self as kin;

// What is hidden here is listed in `extend`: ordinary programs do not call it.

pub mod algebra;
mod ask;
mod assembly;
#[doc(hidden)]
pub mod blame;
pub mod check;
pub mod constraint;
#[doc(hidden)]
pub mod coordinates;
pub mod data;
pub mod diagnosis;
#[doc(hidden)]
pub mod dual_route;
pub mod error;
pub mod extend;
mod follow;
mod fours;
pub mod joints;
#[doc(hidden)]
pub mod lanes;
pub mod law;
mod layout;
mod linear;
pub mod measure;
pub mod mechanism;
mod model;
pub mod motion;
pub mod newton;
pub mod proof;
mod random;
#[doc(hidden)]
pub mod real;
#[doc(hidden)]
pub mod rt;
#[doc(hidden)]
pub mod state;
pub mod sweep;
pub mod system;
#[doc(hidden)]
pub mod terms;
#[cfg(test)]
mod testing;
mod units;

pub use algebra::{Axis, EulerParameters, Mat2, Mat3, Vec2, Vec3, vec2, vec3};
pub use assembly::{Assembly, AssemblyOptions, Label, SearchOptions};
pub use constraint::{Constraint, Route, RouteReason};
pub use coordinates::{
    Coord, Coordinate, Ground, IntoAxis, IntoCoordinate, IntoPlanarBody, IntoSpatialBody, Link, Planar, PlanarBody, Spatial, SpatialBody,
    SpatialLink, Time, any_coord, any_planar, any_spatial,
};
pub use data::Registry;
pub use error::{Error, Result};
pub use follow::{Branch, SingularKind, SingularPosition};
pub use joints::spatial;
pub use kin_macros::{constraint, law};
pub use law::{Break, Ends, Law};
pub use measure::{Crossing, Extreme, Extremes, Measure};
pub use mechanism::{ConstraintId, IntoConstraint, Marker, Mechanism, Pose, Preferred, SpatialPose, deg, linspace, pose};
pub use motion::{Displaced, Event, EventKind, Line, Motion, PointMotion, Quantity, RotationMotion, Series};
pub use nalgebra;
pub use newton::{CrossedBreak, Follow, Options, Report, Stop};
pub use proof::{Doubt, DoubtReason, Proof, StepProof, Tube};
pub use sweep::Sweep;
pub use system::{Solution, System};
pub use units::Units;
