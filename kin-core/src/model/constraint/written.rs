//! The equation of a constraint as it was written: its formula as data, its points, and the
//! expression that fails.

use super::Constraint;
use crate::model::blame::{Asked, Blame};
use crate::model::coordinates::Argument;
use crate::model::formula::jerk::Along;
use crate::model::formula::{Given, Outside, Table};
use crate::model::law::Law;
use crate::model::state::{At, Rates};
use crate::numbers::algebra::Vec3;
use crate::numbers::real::Dual3_64;

/// A point or direction fixed in a body that a constraint speaks of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// Which of [`Constraint::arguments`] the body is.
    pub argument: usize,
    /// The point or direction, by its components in the body's frame.
    pub what: Attached,
}

/// A local point or direction; z is 0 in planar bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Attached {
    /// ū of `b.point(u)`.   \[m\]
    Point(Vec3),
    /// h̄ of `b.direction(h)`, of any length.   \[-\]
    Direction(Vec3),
}

/// The equation as it was written. [`Constraint::parts`] shows it; emitted constraints have it.
pub trait Written {
    /// The points and directions of its bodies that its equation speaks of, `b.point(u)` and
    /// `b.direction(h)` with nothing that moves inside: for drawings and messages. Empty where that
    /// is not known (default).
    fn attachments(&self) -> Vec<Attachment> {
        Vec::new()
    }

    /// The reason why a term is not finite: the sub-expression that made it so, as the user wrote
    /// it. Asked only when a run has failed; `None` where that is not known.
    fn blame(&self, asked: &Asked<'_>) -> Option<Blame> {
        let (table, parameters) = self.table()?;
        table.blame(asked, &parameters, &|number, x, to| self.outside(number, x, to))
    }

    /// Shows each law that the equation asks, with its name and where it is asked; on the dual
    /// route that is not known.
    fn laws(&self, at: &At<'_>, visit: &mut dyn FnMut(&str, &Law, f64)) {
        let _ = (at, visit);
    }

    /// Its formula and the values of its parameters. Emitted on the symbolic route; default none.
    #[doc(hidden)]
    fn table(&self) -> Option<(&Table, Vec<f64>)> {
        None
    }

    /// A value that the formula cannot say and only the user's program can compute, by its number;
    /// default nothing. Emitted with the formula.
    #[doc(hidden)]
    fn outside(&self, number: usize, x: &[Dual3_64], to: &mut Given) {
        let _ = (number, x, to);
    }
}

/// The equation of any constraint, so far as it is known.
impl dyn Constraint + '_ {
    /// [`Written::attachments`]
    pub fn attachments(&self) -> Vec<Attachment> {
        self.parts().written.map(|own| own.attachments()).unwrap_or_default()
    }

    /// [`Written::blame`]
    pub fn blame(&self, asked: &Asked<'_>) -> Option<Blame> {
        self.parts().written?.blame(asked)
    }

    /// Hands its formula over, with the values of the parameters and what computes the rest; `None`
    /// where there is no formula.
    pub(crate) fn formula<T>(
        &self,
        with: impl FnOnce(&Table, &[f64], Outside<'_>) -> T,
    ) -> Option<T> {
        self.parts().written?.formula(with)
    }

    /// [`Written::laws`]
    pub fn laws(&self, at: &At<'_>, visit: &mut dyn FnMut(&str, &Law, f64)) {
        if let Some(own) = self.parts().written {
            own.laws(at, visit);
        }
    }
}

impl dyn Written + '_ {
    /// The formula of [`Written::table`].
    pub(super) fn formula<T>(
        &self,
        with: impl FnOnce(&Table, &[f64], Outside<'_>) -> T,
    ) -> Option<T> {
        let (table, parameters) = self.table()?;
        Some(with(table, &parameters, &|number, x, to| self.outside(number, x, to)))
    }

    /// [`Constraint::jerk_rhs`] by the formula. It is compiled once, not once a constraint.
    pub(super) fn jerk_rhs(
        &self,
        arguments: &[Argument],
        at: &At<'_>,
        [qd, qdd]: [&Rates<'_>; 2],
        rhs: &mut [f64],
    ) -> bool {
        let done = self.formula(|table, parameters, outside| {
            Along::new(arguments, at, [Some(qd), Some(qdd), None], parameters, outside)
                .jerk_rhs(table.formula(), rhs)
        });
        done.is_some()
    }
}
