//! Describes motions that no constraint holds or drives.

use serde::{Deserialize, Serialize};

use crate::numbers::algebra::Vec3;

/// Says whether a freedom exists at nearby poses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Persistence {
    /// The freedom exists at this pose and at nearby poses: no constraint holds or drives the
    /// freedom.
    Always,
    /// The freedom exists at this pose only: the pose is a toggle or a change point.
    OnlyHere,
    /// The freedom is of first order only: the structure is shaky, but cannot move.
    Infinitesimal,
}

/// The motion of a body at one instant.
///
/// Only the ratios of the velocities of the bodies of a freedom are meaningful.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum How {
    /// A planar body rotates about a point. \[m; rad\]
    TurnsAbout {
        /// The global point at rest.
        point: [f64; 2],
        /// The angular velocity.
        rate: f64,
    },
    /// A planar body slides.   \[m\]
    Slides {
        /// The global direction, a unit vector.
        along: [f64; 2],
        /// The speed.
        rate: f64,
    },
    /// A spatial body rotates about an axis and slides along it. \[m; rad; m/rad\]
    Screws {
        /// The point of the axis nearest to the origin of the body frame, in global components.
        point: [f64; 3],
        /// The global direction, a unit vector.
        axis: [f64; 3],
        /// The angular velocity.
        rate: f64,
        /// The displacement per radian; 0 if the body only rotates.
        pitch: f64,
    },
    /// A spatial body slides.   \[m\]
    SlidesInSpace {
        /// The global direction, a unit vector.
        along: [f64; 3],
        /// The speed.
        rate: f64,
    },
    /// A scalar coordinate changes, or the Euler parameters of a body lose their norm.
    Changes {
        /// The velocity.
        rate: f64,
    },
}

/// Bodies that move together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct BodyMotion {
    /// The bodies, or the scalar coordinate.
    pub names: Vec<String>,
    /// The motion of the bodies.
    pub how: How,
}

/// One motion that no constraint holds or drives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Freedom {
    /// Says whether the freedom exists at nearby poses.
    pub persistence: Persistence,
    /// The motions of the bodies.
    pub motions: Vec<BodyMotion>,
    /// A coordinate that takes part in this freedom and in no other freedom. A driver of this
    /// coordinate removes the freedom.
    pub coordinate: String,
    /// The motion in coordinates, C_q q̇ = 0 (length n). \[m, rad\] The list is empty if all
    /// freedoms together need more than 2²² numbers. [`Freedom::motions`] describes the motion in
    /// every case.
    pub direction: Vec<f64>,
    /// True if the freedom moves no other body: points of one line hold the bodies, which rotate
    /// about that line, like a rod between two ball joints.
    #[serde(default)]
    pub idle: bool,
    /// For an infinitesimal freedom, the distance that play in the joints allows; otherwise `None`.
    #[serde(default)]
    pub play: Option<Play>,
}

/// The distance by which play lets a shaky structure move.
///
/// Without play the structure is rigid.
///
/// The structure moves by about √(2 ε Λ / κ) along the motion n of first order. The length ε is the
/// play of every joint. The number κ = l · (C_q n)_q n with lᵀ C_q = 0 is the holding term of
/// second order, and Λ is the sum of the forces |l| in the joints.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Play {
    /// The body or scalar coordinate that moves furthest.
    pub body: String,
    /// The assumed play of every joint. With four times the play the body moves twice as far. \[m\]
    pub play: f64,
    /// The displacement of the body's origin in each direction. \[m\]
    pub moves: f64,
    /// The rotation of the body in each direction. \[rad\]
    pub turns: f64,
}

impl Freedom {
    /// Returns the first body that rotates, and the global axis of its rotation.
    pub(crate) fn turn(&self) -> Option<(&str, Vec3)> {
        self.motions.iter().find_map(|motion| match motion.how {
            How::Screws { axis: [x, y, z], .. } => {
                Some((motion.names.first()?.as_str(), Vec3::new(x, y, z)))
            }
            _ => None,
        })
    }
}
