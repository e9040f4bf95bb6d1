//! Defines the handles of bodies and coordinates, which a mechanism returns and constraints store.

mod given;
pub(crate) mod layout;
pub(crate) mod units;

use crate::numbers::algebra::{Scalar, Vec2, Vec3};

pub use given::{IntoCoordinate, IntoPlanarBody, IntoSpatialBody};

/// Marks a planar body in the signature of a `#[constraint]` function.
///
/// The constructor of the constraint accepts a [`PlanarBody`] for this argument.
pub enum Planar {}
/// Marks a spatial body in the signature of a `#[constraint]` function.
///
/// The constructor of the constraint accepts a [`SpatialBody`] for this argument.
pub enum Spatial {}
/// Marks a scalar generalised coordinate in the signature of a `#[constraint]` function.
///
/// The constructor of the constraint accepts a [`Coordinate`] for this argument.
pub enum Coord {}
/// Marks the time t in the signature of a `#[constraint]` function. \[s\]
///
/// The constructor of the constraint has no argument for the time.
pub enum Time {}
/// Marks the velocity of the length or angle along which a force acts, in the signature of a
/// `#[force]` function. \[m/s, rad/s\]
///
/// The constructor of the force has no argument for the velocity.
pub enum Rate {}

/// The mechanism to which a handle belongs.
///
/// A handle of the ground or a placeholder belongs to all mechanisms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct MechanismId(pub(crate) u64);

impl MechanismId {
    /// The identity that belongs to every mechanism.
    pub(crate) const ANY: MechanismId = MechanismId(0);

    /// Returns an identity that no mechanism has used.
    pub(crate) fn fresh() -> MechanismId {
        use std::sync::atomic::{AtomicU64, Ordering};
        static NEXT: AtomicU64 = AtomicU64::new(1);
        MechanismId(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

/// A planar body of a mechanism, or the ground, with the coordinates (R_x, R_y, θ).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PlanarBody {
    pub(crate) mechanism: MechanismId,
    /// The index of the body; `None` for the ground.
    pub(crate) index: Option<usize>,
}

/// A spatial body of a mechanism, or the ground, with the coordinates (R, e0, e1, e2, e3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SpatialBody {
    pub(crate) mechanism: MechanismId,
    /// The index of the body; `None` for the ground.
    pub(crate) index: Option<usize>,
}

/// A scalar generalised coordinate: a separate coordinate, or a coordinate of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Coordinate {
    /// A separate coordinate ([`crate::Mechanism::angle`], [`crate::Mechanism::length`]).
    Own {
        #[doc(hidden)]
        mechanism: MechanismId,
        #[doc(hidden)]
        index: usize,
    },
    /// Coordinate `axis` (0: R_x, 1: R_y, 2: θ) of a planar body.
    Planar(PlanarBody, usize),
    /// Coordinate `axis` (0..3: R, 3..7: e0..e3) of a spatial body.
    Spatial(SpatialBody, usize),
}

/// The ground: a planar and a spatial body without coordinates, the global frame itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Ground;

/// A planar body between two pins, with its frame in the middle and its x-axis from the first pin
/// to the second.
///
/// The length is a number or a [`crate::Dimension`]. If the length is a dimension, the local
/// positions of both ends are expressions of that dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link<L = f64> {
    pub(crate) body: PlanarBody,
    pub(crate) length: L,
}

/// A spatial body between two joints, with its frame in the middle and its x-axis from the first
/// joint to the second.
///
/// The length is a number or a [`crate::Dimension`]. If the length is a dimension, the local
/// positions of both ends are expressions of that dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialLink<L = f64> {
    pub(crate) body: SpatialBody,
    pub(crate) length: L,
}

impl<L: Scalar> SpatialLink<L> {
    /// Returns the body.
    pub fn body(self) -> SpatialBody {
        self.body
    }

    /// Returns the length between the joints. \[m\]
    pub fn length(self) -> L {
        self.length
    }

    /// Returns the local position of the first joint, (−l/2, 0, 0). \[m\]
    pub fn start(self) -> Vec3<L> {
        Vec3::new(L::from(-0.5) * self.length, L::from(0.0), L::from(0.0))
    }

    /// Returns the local position of the second joint, (l/2, 0, 0). \[m\]
    pub fn end(self) -> Vec3<L> {
        Vec3::new(L::from(0.5) * self.length, L::from(0.0), L::from(0.0))
    }
}

impl<L> From<SpatialLink<L>> for SpatialBody {
    fn from(link: SpatialLink<L>) -> Self {
        link.body
    }
}

impl PlanarBody {
    /// Returns R_x as a scalar coordinate. \[m\]
    pub fn x(self) -> Coordinate {
        Coordinate::Planar(self, 0)
    }

    /// Returns R_y as a scalar coordinate. \[m\]
    pub fn y(self) -> Coordinate {
        Coordinate::Planar(self, 1)
    }

    /// Returns θ as a scalar coordinate. \[rad\]
    pub fn theta(self) -> Coordinate {
        Coordinate::Planar(self, 2)
    }
}

impl SpatialBody {
    /// Returns R_x as a scalar coordinate. \[m\]
    pub fn x(self) -> Coordinate {
        Coordinate::Spatial(self, 0)
    }

    /// Returns R_y as a scalar coordinate. \[m\]
    pub fn y(self) -> Coordinate {
        Coordinate::Spatial(self, 1)
    }

    /// Returns R_z as a scalar coordinate. \[m\]
    pub fn z(self) -> Coordinate {
        Coordinate::Spatial(self, 2)
    }
}

impl<L: Scalar> Link<L> {
    /// Returns the body.
    pub fn body(self) -> PlanarBody {
        self.body
    }

    /// Returns the length between the pins. \[m\]
    pub fn length(self) -> L {
        self.length
    }

    /// Returns the local position of the first pin, (−l/2, 0). \[m\]
    pub fn start(self) -> Vec2<L> {
        Vec2::new(L::from(-0.5) * self.length, L::from(0.0))
    }

    /// Returns the local position of the second pin, (l/2, 0). \[m\]
    pub fn end(self) -> Vec2<L> {
        Vec2::new(L::from(0.5) * self.length, L::from(0.0))
    }

    /// Returns R_x as a scalar coordinate. \[m\]
    pub fn x(self) -> Coordinate {
        self.body.x()
    }

    /// Returns R_y as a scalar coordinate. \[m\]
    pub fn y(self) -> Coordinate {
        self.body.y()
    }

    /// Returns θ as a scalar coordinate. \[rad\]
    pub fn theta(self) -> Coordinate {
        self.body.theta()
    }
}

impl<L> From<Link<L>> for PlanarBody {
    fn from(link: Link<L>) -> Self {
        link.body
    }
}

impl From<Ground> for PlanarBody {
    fn from(_: Ground) -> Self {
        PlanarBody { mechanism: MechanismId::ANY, index: None }
    }
}

impl From<Ground> for SpatialBody {
    fn from(_: Ground) -> Self {
        SpatialBody { mechanism: MechanismId::ANY, index: None }
    }
}

/// Returns a planar body that belongs to no mechanism, to check a constraint alone.
///
/// Each call returns a new body.
pub fn any_planar() -> PlanarBody {
    PlanarBody { mechanism: MechanismId::ANY, index: Some(placeholder()) }
}

/// Returns a spatial body that belongs to no mechanism, to check a constraint alone.
///
/// Each call returns a new body.
pub fn any_spatial() -> SpatialBody {
    SpatialBody { mechanism: MechanismId::ANY, index: Some(placeholder()) }
}

/// Returns a scalar coordinate that belongs to no mechanism, to check a constraint alone.
///
/// Each call returns a new coordinate.
pub fn any_coord() -> Coordinate {
    Coordinate::Own { mechanism: MechanismId::ANY, index: placeholder() }
}

/// Returns an index that no mechanism uses, counted down from the largest number.
fn placeholder() -> usize {
    use std::sync::atomic::{AtomicUsize, Ordering};
    static NEXT: AtomicUsize = AtomicUsize::new(usize::MAX);
    NEXT.fetch_sub(1, Ordering::Relaxed)
}

/// An argument of a constraint: its name in the signature, and its body or coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Argument {
    /// The name in the signature of the constraint.
    pub name: &'static str,
    /// The body or coordinate.
    pub target: Target,
}

/// The body or coordinate of an argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Target {
    /// A planar body: 3 columns.
    Planar(PlanarBody),
    /// A spatial body: 7 columns.
    Spatial(SpatialBody),
    /// A scalar coordinate: 1 column. `trig` says whether the constraint reads its sine or cosine.
    Coord(Coordinate, Trig),
}

/// Says whether a constraint reads the sine and cosine of a scalar coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Trig {
    /// The constraint reads only the value.
    Unused,
    /// The constraint reads sine and cosine too.
    Used,
}

impl Target {
    /// Returns the number of columns: 3, 7 or 1.
    pub fn columns(&self) -> usize {
        match self {
            Target::Planar(_) => 3,
            Target::Spatial(_) => 7,
            Target::Coord(..) => 1,
        }
    }
}
