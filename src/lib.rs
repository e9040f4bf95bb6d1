#![doc = include_str!("../README.md")]
//!
//! # Contents of this documentation
//!
//! | subject | items |
//! |---|---|
//! | the description of a mechanism | [`Mechanism`], [`joints`], [`Law`], [`pose`], [`SpatialPose`], [`loads`] |
//! | a user-defined constraint or law | [`macro@constraint`], [`macro@law`], [`check`] |
//! | the solution of a mechanism | [`System`], [`Solver`], [`SolverOptions`], [`solver`] |
//! | forces of joints and drives | [`forces`] |
//! | derivatives by parameters, tolerances | [`design`] |
//! | a motion and its results | [`Motion`], [`results`] |
//! | errors | [`Error`], [`diagnosis`] |
//! | files | [`data`] |
//! | hand-written constraints, numbers with derivatives, emitted code | [`extend`] |
//!
//! Ordinary programs use all modules except [`extend`].
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub use kin_core::*;

/// Reads equations as text while the program runs, and mechanism files that contain equations.
#[cfg(feature = "text")]
pub use kin_text as text;

/// Exports all names that a program with a mechanism usually needs: `use kin::prelude::*;`.
pub mod prelude {
    pub use kin_core::extend::{Dual, Real, Route, Routed};
    pub use kin_core::joints::drivers::*;
    pub use kin_core::joints::planar::*;
    pub use kin_core::joints::spatial;
    pub use kin_core::law::Ends;
    pub use kin_core::mechanism::Marker;
    pub use kin_core::results::Series;
    pub use kin_core::{
        Axis, Constraint, Coord, Coordinate, Dimension, EulerParameters, Ground, Law, Link, Mat2,
        Mat3, Mechanism, Motion, Planar, PlanarBody, Pose, Rate, Spatial, SpatialBody, SpatialLink,
        SpatialPose, System, Time, Vec2, Vec3, constraint, deg, force, law, linspace, pose,
        potential, vec2, vec3,
    };
    pub use std::f64::consts::{PI, TAU};
}

/// The pages of `docs/guide/`: their programs are compiled as tests.
#[cfg(doctest)]
mod guide {
    macro_rules! pages {
        ($($page:ident $file:literal;)*) => { $(#[doc = include_str!($file)] struct $page;)* };
    }

    pages! {
        Mechanisms "../docs/guide/mechanisms.md";
        Assemblies "../docs/guide/assemblies.md";
        Constraints "../docs/guide/constraints.md";
        ConstraintByHand "../docs/guide/constraint-by-hand.md";
        Motions "../docs/guide/motions.md";
        Positions "../docs/guide/positions.md";
        Dragging "../docs/guide/dragging.md";
        Ankle "../docs/guide/ankle.md";
        DeadCentres "../docs/guide/dead-centres.md";
        LongRuns "../docs/guide/long-runs.md";
        Proofs "../docs/guide/proofs.md";
        Sweeps "../docs/guide/sweeps.md";
        Diagnosis "../docs/guide/diagnosis.md";
        Redundant "../docs/guide/redundant.md";
        Forces "../docs/guide/forces.md";
        Loads "../docs/guide/loads.md";
        Friction "../docs/guide/friction.md";
        Design "../docs/guide/design.md";
        Gradients "../docs/guide/gradients.md";
        Tolerances "../docs/guide/tolerances.md";
        Pictures "../docs/guide/pictures.md";
        Text "../docs/guide/text.md";
        Firmware "../docs/guide/firmware.md";
        Renamed "../docs/guide/renamed.md";
    }
}
