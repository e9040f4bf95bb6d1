#![doc = include_str!("../README.md")]
//!
//! # Where things are in this documentation
//!
//! | for | see |
//! |---|---|
//! | describing a machine | [`Mechanism`], [`joints`], [`spatial`], [`Law`], [`pose`], [`SpatialPose`], [`Axis`] |
//! | a constraint or law of one's own | [`macro@constraint`], [`macro@law`], [`check`] |
//! | solving it | [`System`], [`Options`], [`Sweep`], [`Assembly`] |
//! | what joints hold and drives must give | [`Forces`], [`Solid`], [`Load`] |
//! | how it changes with parameters | [`Sensitivities`], [`System::gradient`] |
//! | what has come out | [`Motion`], [`Quantity`], [`Extremes`], [`Measure`], [`Proof`] |
//! | what is wrong | [`Error`], [`diagnosis`] |
//! | files | [`data`], [`Registry`] |
//! | constraints without the macro, the numbers behind derivatives, what emitted code stands on | [`extend`] |
//!
//! Everything outside of [`extend`] is for users to call.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub use kin_core::*;

/// Equations as text, read while the program runs, and mechanism files that carry them.
#[cfg(feature = "text")]
pub use kin_text as text;

// Listed under `extend`; these paths are shorter, and those that emitted code and constraints by
// hand have.
#[doc(hidden)]
pub use kin_core::extend::{
    Attached, Attachment, Dependence, Dual, Entry, Facts, Lanes, LawFunction, Measured, Moving,
    Parameters, Real, Target, Terms, Written, blame, by_dual, coordinates, dual_route, dual_terms,
    jerk_rhs, measure, real, state, terms,
};

/// Everything a program with a mechanism in it needs: `use kin::prelude::*;`.
pub mod prelude {
    pub use kin_core::extend::{Dual, Real};
    pub use kin_core::joints::drivers::*;
    pub use kin_core::joints::planar::*;
    pub use kin_core::joints::spatial;
    pub use kin_core::{
        Axis, Constraint, Coord, Coordinate, Dimension, Ends, EulerParameters, Ground, Law, Link,
        Marker, Mat2, Mat3, Mechanism, Motion, Planar, PlanarBody, Pose, Rate, Route, Routed,
        Series, Spatial, SpatialBody, SpatialLink, SpatialPose, System, Time, Vec2, Vec3,
        constraint, deg, force, law, linspace, pose, potential, vec2, vec3,
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
    }
}
