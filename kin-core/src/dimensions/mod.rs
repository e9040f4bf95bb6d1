//! Defines named dimensions and expressions of dimensions, on which other numbers of a mechanism
//! depend.

mod arithmetic;
mod axis;
mod bindings;
mod bound;
mod distribution;
mod given;
mod invalid;
mod snapshot;
mod store;
mod text;

use kin_graph::Node;

use crate::coordinates::MechanismId;

pub use axis::IntoAxis;
pub use bindings::{Bindings, Name};
pub(crate) use bound::{Beside, Bound, Holder};
pub use distribution::Distribution;
pub use given::{IntoGravity, IntoNumber, IntoParameter, IntoVector, vector};
pub(crate) use snapshot::{Hung, Snapshot};
pub(crate) use store::{Entry, Shared};
pub(crate) use text::text_of;

/// A named number of a mechanism ([`crate::Mechanism::dimension`]) or an expression of such
/// numbers: `a / 2.0`, `a + b`, `dx.hypot(dy)`, `angle.sin()`.
///
/// A `Dimension` is `Copy`. Use it instead of a number for a parameter of a constraint, a length of
/// a link, a coefficient of a law, a guess, a mass or a load.
///
/// ```
/// use kin::prelude::*;
///
/// # fn main() -> kin::Result<()> {
/// let mut m = Mechanism::new("crank");
/// let a = m.dimension("crank", 0.12)?.within(0.05, 0.2).tolerance(0.0001).unit("m");
/// let crank = m.link("crank", a)?;
/// m.add("O", revolute(m.ground(), crank, (0.0, a / 4.0), crank.start()))?;
/// m.add("motor", drive_angle(crank, Law::ramp(3.0)))?;
/// let mut system = m.build()?;
/// system.set("crank", 0.16)?; // the link and the pin move, without a rebuild
/// assert_eq!(system.parameter("O.u_i.y")?, 0.04);
/// assert_eq!(system.parameter("O.u_j.x")?, -0.08);
/// # Ok(())
/// # }
/// ```
///
/// Comparisons use the value at the nominal values of the dimensions. A `Dimension` records its
/// arithmetic, so [`crate::System::set`] can repeat the arithmetic with new values.
#[derive(Clone, Copy)]
pub struct Dimension {
    value: f64,
    of: Of,
}

/// Where a number comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Of {
    /// The number is a constant.
    Nothing,
    /// The number is an expression of dimensions of one mechanism.
    Expression(MechanismId, Node),
    /// The number uses dimensions of several mechanisms, or of a mechanism that no longer exists.
    /// Every call that receives it returns an error.
    Several,
}

impl Dimension {
    /// Returns the value of the expression at the nominal values of the dimensions.
    pub fn value(self) -> f64 {
        self.value
    }

    pub(crate) fn of(self) -> Of {
        self.of
    }

    pub(crate) fn new(value: f64, mechanism: MechanismId, node: Node) -> Self {
        Dimension { value, of: Of::Expression(mechanism, node) }
    }

    /// Sets the range of values that [`crate::System::set`] accepts, both ends included.
    ///
    /// [`Mechanism::build`](crate::Mechanism::build) returns an error if the range excludes the
    /// nominal value.
    pub fn within(self, from: f64, to: f64) -> Self {
        self.describe(|entry| entry.range = Some([from, to]))
    }

    /// Sets the tolerance: the actual value deviates from the nominal value by at most ±
    /// `tolerance`.
    ///
    /// [`Mechanism::build`](crate::Mechanism::build) returns an error if the tolerance is negative
    /// or not finite.
    pub fn tolerance(self, tolerance: f64) -> Self {
        self.describe(|entry| entry.tolerance = Some(tolerance))
    }

    /// Sets the distribution within the tolerance; the default is normal.
    ///
    /// [`Distribution::Disc`] is for clearances only: [`Mechanism::build`](crate::Mechanism::build)
    /// returns an error if any other dimension has this distribution.
    pub fn distributed(self, distribution: Distribution) -> Self {
        self.describe(|entry| entry.distribution = Some(distribution))
    }

    /// Sets the unit that tables and files show. Kin does not convert the value.
    pub fn unit(self, unit: &str) -> Self {
        self.describe(|entry| entry.unit = unit.to_string())
    }

    /// Marks one of the two dimensions of a clearance.
    pub(crate) fn in_clearance(self, name: &str) -> Self {
        self.distributed(Distribution::Disc)
            .describe(|entry| entry.clearance = Some(name.to_string()))
    }

    /// Records a property of a named dimension. On any other number the property becomes an error
    /// at build.
    fn describe(self, write: impl FnOnce(&mut Entry)) -> Self {
        store::with(self.of, |store, node| {
            match store.entries.iter_mut().find(|entry| entry.node == node) {
                Some(entry) if !entry.is_derived => write(entry),
                _ => store.misplaced = store.misplaced.or(Some(node)),
            }
        });
        self
    }
}
