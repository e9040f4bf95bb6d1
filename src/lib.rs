#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub use kin_core::*;

/// Everything a program with a mechanism in it needs: `use kin::prelude::*;`.
pub mod prelude {
    pub use kin_core::joints::drivers::*;
    pub use kin_core::joints::planar::*;
    pub use kin_core::joints::spatial;
    pub use kin_core::{
        Axis, Constraint, Coord, Coordinate, Dual, Ends, EulerParameters, Ground, Law, Link, Marker, Mat2, Mat3, Mechanism, Motion, Planar,
        PlanarBody, Pose, Real, Route, Series, Spatial, SpatialBody, SpatialLink, SpatialPose, System, Time, Vec2, Vec3, constraint, deg,
        law, linspace, pose, vec2, vec3,
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
        Constraints "../docs/guide/constraints.md";
        Mechanisms "../docs/guide/mechanisms.md";
        Motions "../docs/guide/motions.md";
        Sweeps "../docs/guide/sweeps.md";
        Diagnosis "../docs/guide/diagnosis.md";
        Pictures "../docs/guide/pictures.md";
    }
}
