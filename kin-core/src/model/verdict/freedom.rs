//! Motions that nothing holds or drives.

use serde::{Deserialize, Serialize};

use crate::numbers::algebra::Vec3;

/// Persistence of a freedom at nearby poses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Persistence {
    /// The freedom is there at this pose and at nearby ones: nothing holds or drives it.
    Always,
    /// The freedom is there at this pose, not at nearby ones: a toggle or a change point.
    OnlyHere,
    /// The freedom is one of first order only: the structure gives, but it cannot move.
    Infinitesimal,
}

/// How a body moves at this instant. Rates are relative to those of the other bodies in the same
/// freedom.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum How {
    /// A planar body turns about a point.   \[m; rad\]
    TurnsAbout {
        /// The global point that stands still.
        point: [f64; 2],
        /// The angular rate.
        rate: f64,
    },
    /// A planar body slides.   \[m\]
    Slides {
        /// The global direction, of length 1.
        along: [f64; 2],
        /// The speed.
        rate: f64,
    },
    /// A spatial body turns about an axis, and slides along it.   \[m; rad; m/rad\]
    Screws {
        /// The point of the axis nearest the origin of the body frame, global.
        point: [f64; 3],
        /// The global direction, of length 1.
        axis: [f64; 3],
        /// The angular rate.
        rate: f64,
        /// How far it slides a radian; 0: it only turns.
        pitch: f64,
    },
    /// A spatial body slides.   \[m\]
    SlidesInSpace {
        /// The global direction, of length 1.
        along: [f64; 3],
        /// The speed.
        rate: f64,
    },
    /// A bare coordinate changes, or the Euler parameters of a body lose their norm.
    Changes {
        /// Its rate.
        rate: f64,
    },
}

/// Bodies that move as one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct BodyMotion {
    /// The bodies, or the bare coordinate.
    pub names: Vec<String>,
    /// How they move.
    pub how: How,
}

/// One motion that is left free.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Freedom {
    /// Its persistence at nearby poses.
    pub persistence: Persistence,
    /// The motions of the bodies that move.
    pub motions: Vec<BodyMotion>,
    /// A coordinate that takes part and in no other of the freedoms: drive it, and the freedom is
    /// gone.
    pub coordinate: String,
    /// The motion in coordinates, C_q q̇ = 0 (length n); empty where all freedoms together would
    /// take more than 2²² numbers: [`Freedom::motions`] says the same.   \[m, rad\]
    pub direction: Vec<f64>,
    /// True if nothing depends on it: bodies that are held by points of one line turn about that
    /// line, a rod between two balls.
    #[serde(default)]
    pub idle: bool,
    /// Of an infinitesimal freedom: how far play in the joints lets it move.
    #[serde(default)]
    pub play: Option<Play>,
}

/// How far play lets a shaky structure move, which without play is rigid: by about √(2 ε Λ / κ)
/// along the motion n of first order, with ε the play of every joint, κ = l · (C_q n)_q n the
/// second order that holds it, lᵀ C_q = 0, and Λ the sum of the forces |l| in the joints.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Play {
    /// The body or bare coordinate that moves furthest.
    pub body: String,
    /// The play of every joint that is looked at: four times as much lets the body move twice as
    /// far.   \[m\]
    pub play: f64,
    /// How far the origin of the body moves, to either side.   \[m\]
    pub moves: f64,
    /// How far the body turns, to either side.   \[rad\]
    pub turns: f64,
}

impl Freedom {
    /// The first body that turns, and the global axis about which it does.
    pub(crate) fn turn(&self) -> Option<(&str, Vec3)> {
        self.motions.iter().find_map(|motion| match motion.how {
            How::Screws { axis: [x, y, z], .. } => {
                Some((motion.names.first()?.as_str(), Vec3::new(x, y, z)))
            }
            _ => None,
        })
    }
}
