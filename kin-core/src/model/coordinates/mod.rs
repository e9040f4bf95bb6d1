//! Handles: what a mechanism gives out for its bodies and coordinates, and what constraints hold of
//! them.

mod given;

use crate::numbers::algebra::{Scalar, Vec2, Vec3};

pub use given::{IntoAxis, IntoCoordinate, IntoPlanarBody, IntoSpatialBody};

/// Marker in the signature of a `#[constraint]` function: the state of a planar body. The
/// constructor takes a [`PlanarBody`].
pub enum Planar {}
/// Marker in the signature of a `#[constraint]` function: the state of a spatial body. The
/// constructor takes a [`SpatialBody`].
pub enum Spatial {}
/// Marker in the signature of a `#[constraint]` function: a bare generalized coordinate. The
/// constructor takes a [`Coordinate`].
pub enum Coord {}
/// Marker in the signature of a `#[constraint]` function: the time t.   \[s\] It is no argument of
/// the constructor.
pub enum Time {}
/// Marker in the signature of a `#[force]` function: the rate of the length or angle that the force
/// acts along.   \[m/s, rad/s\] It is no argument of the constructor.
pub enum Rate {}

/// Which mechanism a handle belongs to. Handles of the ground and placeholders belong to all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct MechanismId(pub(crate) u64);

impl MechanismId {
    /// Belongs to every mechanism.
    pub(crate) const ANY: MechanismId = MechanismId(0);

    /// One that no mechanism has had.
    pub(crate) fn fresh() -> MechanismId {
        use std::sync::atomic::{AtomicU64, Ordering};
        static NEXT: AtomicU64 = AtomicU64::new(1);
        MechanismId(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

/// A planar body of a mechanism (or the ground): coordinates (R_x, R_y, θ).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PlanarBody {
    pub(crate) mechanism: MechanismId,
    /// `None`: the ground.
    pub(crate) index: Option<usize>,
}

/// A spatial body of a mechanism (or the ground): coordinates (R, e0, e1, e2, e3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SpatialBody {
    pub(crate) mechanism: MechanismId,
    /// `None`: the ground.
    pub(crate) index: Option<usize>,
}

/// A bare generalized coordinate: one of its own, or one of a body's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Coordinate {
    /// A coordinate declared on its own ([`crate::Mechanism::angle`],
    /// [`crate::Mechanism::length`]).
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

/// A planar body between two pins, frame at the middle, x-axis from start to end. Its length is a
/// number, or a [`crate::Dimension`], of which its pins then are expressions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link<L = f64> {
    pub(crate) body: PlanarBody,
    pub(crate) length: L,
}

/// A spatial body between two joints, frame at the middle, x-axis from start to end. Its length is
/// a number, or a [`crate::Dimension`], of which its joints then are expressions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialLink<L = f64> {
    pub(crate) body: SpatialBody,
    pub(crate) length: L,
}

impl<L: Scalar> SpatialLink<L> {
    /// The body itself.
    pub fn body(self) -> SpatialBody {
        self.body
    }

    /// Length between the joints.   \[m\]
    pub fn length(self) -> L {
        self.length
    }

    /// Local position of the first joint, (−l/2, 0, 0).   \[m\]
    pub fn start(self) -> Vec3<L> {
        Vec3::new(L::from(-0.5) * self.length, L::from(0.0), L::from(0.0))
    }

    /// Local position of the second joint, (l/2, 0, 0).   \[m\]
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
    /// R_x as a bare coordinate.   \[m\]
    pub fn x(self) -> Coordinate {
        Coordinate::Planar(self, 0)
    }

    /// R_y as a bare coordinate.   \[m\]
    pub fn y(self) -> Coordinate {
        Coordinate::Planar(self, 1)
    }

    /// θ as a bare coordinate.   \[rad\]
    pub fn theta(self) -> Coordinate {
        Coordinate::Planar(self, 2)
    }
}

impl SpatialBody {
    /// R_x as a bare coordinate.   \[m\]
    pub fn x(self) -> Coordinate {
        Coordinate::Spatial(self, 0)
    }

    /// R_y as a bare coordinate.   \[m\]
    pub fn y(self) -> Coordinate {
        Coordinate::Spatial(self, 1)
    }

    /// R_z as a bare coordinate.   \[m\]
    pub fn z(self) -> Coordinate {
        Coordinate::Spatial(self, 2)
    }
}

impl<L: Scalar> Link<L> {
    /// The body itself.
    pub fn body(self) -> PlanarBody {
        self.body
    }

    /// Length between the pins.   \[m\]
    pub fn length(self) -> L {
        self.length
    }

    /// Local position of the first pin, (−l/2, 0).   \[m\]
    pub fn start(self) -> Vec2<L> {
        Vec2::new(L::from(-0.5) * self.length, L::from(0.0))
    }

    /// Local position of the second pin, (l/2, 0).   \[m\]
    pub fn end(self) -> Vec2<L> {
        Vec2::new(L::from(0.5) * self.length, L::from(0.0))
    }

    /// R_x as a bare coordinate.   \[m\]
    pub fn x(self) -> Coordinate {
        self.body.x()
    }

    /// R_y as a bare coordinate.   \[m\]
    pub fn y(self) -> Coordinate {
        self.body.y()
    }

    /// θ as a bare coordinate.   \[rad\]
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

/// A planar body of no mechanism, for checking a constraint on its own; each call gives another
/// one.
pub fn any_planar() -> PlanarBody {
    PlanarBody { mechanism: MechanismId::ANY, index: Some(placeholder()) }
}

/// A spatial body of no mechanism, for checking a constraint on its own; each call gives another
/// one.
pub fn any_spatial() -> SpatialBody {
    SpatialBody { mechanism: MechanismId::ANY, index: Some(placeholder()) }
}

/// A bare coordinate of no mechanism, for checking a constraint on its own; each call gives another
/// one.
pub fn any_coord() -> Coordinate {
    Coordinate::Own { mechanism: MechanismId::ANY, index: placeholder() }
}

/// Numbers that no mechanism gives out, counted from above.
fn placeholder() -> usize {
    use std::sync::atomic::{AtomicUsize, Ordering};
    static NEXT: AtomicUsize = AtomicUsize::new(usize::MAX);
    NEXT.fetch_sub(1, Ordering::Relaxed)
}

/// One argument of a constraint: its name in the signature, and what it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Argument {
    /// Name in the signature of the constraint.
    pub name: &'static str,
    /// The body or coordinate.
    pub target: Target,
}

/// The body or coordinate that an argument of a constraint stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Target {
    /// A planar body: 3 columns.
    Planar(PlanarBody),
    /// A spatial body: 7 columns.
    Spatial(SpatialBody),
    /// A bare coordinate: 1 column; `trig` if the constraint reads its sine or cosine.
    Coord(Coordinate, Trig),
}

/// The sine and cosine of a bare coordinate, which a constraint reads or does not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Trig {
    /// Only the value.
    Unused,
    /// Sine and cosine too.
    Used,
}

impl Target {
    /// Number of columns: 3, 7 or 1.
    pub fn columns(&self) -> usize {
        match self {
            Target::Planar(_) => 3,
            Target::Spatial(_) => 7,
            Target::Coord(..) => 1,
        }
    }
}
