//! Describes the equation of a constraint as the user wrote it: the formula as data, the points,
//! and the expression that fails.

use super::Constraint;
use crate::coordinates::Argument;
use crate::law::Law;
use crate::model::blame::{Asked, Blame};
use crate::model::formula::jerk::Along;
use crate::model::formula::{Given, Outside, Table};
use crate::model::state::{At, Rates};
use crate::numbers::algebra::Vec3;
use crate::numbers::real::Dual3_64;

/// A point or direction fixed in a body, from the equation of a constraint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// The index of the body in [`Constraint::arguments`].
    pub argument: usize,
    /// The components of the point or direction in the frame of the body.
    pub what: Attached,
}

/// A point or direction in the frame of its body; z is 0 in planar bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Attached {
    /// ū of `b.point(u)`.   \[m\]
    Point(Vec3),
    /// h̄ of `b.direction(h)`, of any length.   \[-\]
    Direction(Vec3),
}

/// The equation of a constraint as the user wrote it.
///
/// Compiled constraints implement this trait. [`Constraint::parts`] returns the implementation.
pub trait Written {
    /// Returns the points and directions of bodies in the equation, for drawings and messages.
    ///
    /// The list contains `b.point(u)` and `b.direction(h)` with a constant u or h. The default list
    /// is empty, because the points and directions are unknown.
    fn attachments(&self) -> Vec<Attachment> {
        Vec::new()
    }

    /// Returns the subexpression that makes a term infinite or NaN, as the user wrote it.
    ///
    /// Returns `None` if the subexpression is unknown. Kin calls this method only after a failure.
    fn blame(&self, asked: &Asked<'_>) -> Option<Blame> {
        let (table, parameters) = self.table()?;
        table.blame(asked, &parameters, &|number, x, to| self.outside(number, x, to))
    }

    /// Passes each law of the equation to `visit`, with its name and its argument.
    ///
    /// The method passes no law on the dual route, because the laws are unknown.
    fn laws(&self, at: &At<'_>, visit: &mut dyn FnMut(&str, &Law, f64)) {
        let _ = (at, visit);
    }

    /// Returns the formula and the values of its parameters, or `None` without a formula.
    ///
    /// Compiled constraints on the symbolic route have a formula.
    #[doc(hidden)]
    fn table(&self) -> Option<(&Table, Vec<f64>)> {
        None
    }

    /// Computes a value that only the user's program knows, by the index of the value in the
    /// formula.
    ///
    /// The default implementation does nothing. The macro implements this method together with the
    /// formula.
    #[doc(hidden)]
    fn outside(&self, number: usize, x: &[Dual3_64], to: &mut Given) {
        let _ = (number, x, to);
    }
}

/// The equation of any constraint, as far as it is known.
impl dyn Constraint + '_ {
    /// Calls [`Written::attachments`].
    pub fn attachments(&self) -> Vec<Attachment> {
        self.parts().written.map(|own| own.attachments()).unwrap_or_default()
    }

    /// Calls [`Written::blame`].
    pub fn blame(&self, asked: &Asked<'_>) -> Option<Blame> {
        self.parts().written?.blame(asked)
    }

    /// Passes the formula, the values of the parameters and the outside functions to `act`. Returns
    /// `None` if there is no formula.
    pub(crate) fn formula<T>(
        &self,
        with: impl FnOnce(&Table, &[f64], Outside<'_>) -> T,
    ) -> Option<T> {
        self.parts().written?.formula(with)
    }

    /// Calls [`Written::laws`].
    pub fn laws(&self, at: &At<'_>, visit: &mut dyn FnMut(&str, &Law, f64)) {
        if let Some(own) = self.parts().written {
            own.laws(at, visit);
        }
    }
}

impl dyn Written + '_ {
    /// Returns the formula of [`Written::table`].
    pub(super) fn formula<T>(
        &self,
        with: impl FnOnce(&Table, &[f64], Outside<'_>) -> T,
    ) -> Option<T> {
        let (table, parameters) = self.table()?;
        Some(with(table, &parameters, &|number, x, to| self.outside(number, x, to)))
    }

    /// Computes [`Constraint::jerk_rhs`] from the formula. This code is compiled once for all
    /// constraints.
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
