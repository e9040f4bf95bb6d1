//! Named dimensions: numbers with a name that others hang on, and expressions of them.

mod arithmetic;
mod bindings;
mod bound;
mod distribution;
mod error;
mod given;
mod invalid;
mod snapshot;
mod store;
mod text;

use kin_graph::Node;

use crate::model::coordinates::MechanismId;

pub use bindings::{Bindings, Name};
pub(crate) use bound::{Beside, Bound, Holder};
pub use distribution::Distribution;
pub use error::DimensionError;
pub use given::{IntoGravity, IntoNumber, IntoParameter, IntoVector, vector};
pub(crate) use snapshot::{Hung, Snapshot};
pub(crate) use store::{Entry, Shared};
pub(crate) use text::text_of;

/// A named number that others hang on ([`crate::Mechanism::dimension`]), or an expression of such
/// numbers: `a / 2.0`, `a + b`, `dx.hypot(dy)`, `angle.sin()`. It is copied freely, and is accepted
/// wherever a parameter of a constraint, a length of a link, a coefficient of a law, a guess, a
/// mass or a number of a load is a number.
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
/// It compares with other numbers by its value where it was made. Its arithmetic is written down,
/// not done: [`crate::System::set`] does it again.
#[derive(Clone, Copy)]
pub struct Dimension {
    value: f64,
    of: Of,
}

/// The origin of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Of {
    /// A constant.
    Nothing,
    /// An expression of dimensions.
    Expression(MechanismId, Node),
    /// Dimensions of several mechanisms, or of one that is no more: whoever is given it refuses it.
    Several,
}

impl Dimension {
    /// Its value where it was made: that of the dimensions' nominal values.
    pub fn value(self) -> f64 {
        self.value
    }

    pub(crate) fn of(self) -> Of {
        self.of
    }

    pub(crate) fn new(value: f64, mechanism: MechanismId, node: Node) -> Self {
        Dimension { value, of: Of::Expression(mechanism, node) }
    }

    /// The range that [`crate::System::set`] keeps to, both ends included. One that excludes the
    /// nominal value is told when the mechanism is built.
    pub fn within(self, from: f64, to: f64) -> Self {
        self.describe(|entry| entry.range = Some([from, to]))
    }

    /// How far the shop may be off: the value is within ± `tolerance` of the nominal one. One that
    /// is negative or not finite is told when the mechanism is built.
    pub fn tolerance(self, tolerance: f64) -> Self {
        self.describe(|entry| entry.tolerance = Some(tolerance))
    }

    /// How it is distributed where it has a tolerance; normal if nothing is said.
    /// [`Distribution::Disc`] is that of clearances alone: of another dimension it is told when the
    /// mechanism is built.
    pub fn distributed(self, distribution: Distribution) -> Self {
        self.describe(|entry| entry.distribution = Some(distribution))
    }

    /// Its unit, for tables and files: a word, nothing is converted.
    pub fn unit(self, unit: &str) -> Self {
        self.describe(|entry| entry.unit = unit.to_string())
    }

    /// One of the two dimensions of a clearance.
    pub(crate) fn in_clearance(self, name: &str) -> Self {
        self.distributed(Distribution::Disc)
            .describe(|entry| entry.clearance = Some(name.to_string()))
    }

    /// Writes down what is known of a named dimension; of anything else it is told at build.
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
