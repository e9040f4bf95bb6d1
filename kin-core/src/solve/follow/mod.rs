//! Follows the motion, so that a run stays on its branch or reports that it cannot stay on its
//! branch.
//!
//! Solutions of C(q, t) = 0 form curves. Two curves approach each other, or meet, only at singular
//! positions. Kin tests each step of time with existing numbers ([`check`]) and with bounds of what
//! drivers can do in between ([`drive`]). Kin halves a step that fails the test. If short steps no
//! longer help, the motion is at or near a singular position. Kin then follows the curve by its arc
//! length through (q, t) ([`curve`]), because the curve is regular even where time changes its
//! direction. [`turning`] finds the point at which time changes its direction. Where two curves
//! cross, [`branching`] finds both tangents. [`passage`] combines [`curve`], [`turning`] and
//! [`branching`].

mod branching;
mod check;
mod curve;
mod drive;
mod passage;
mod root;
mod singular;
mod turning;

pub use crate::outcome::motion::{Branch, SingularKind, SingularPosition};
pub(crate) use branching::crossing_between;
pub(crate) use check::{Check, Objection, REACH, misses_too_far, turns_too_far};
pub(crate) use curve::{Curve, CurvePoint};
pub(crate) use drive::{Drive, Lever, Span};
pub(crate) use passage::{Landed, Lost, pass};
pub(crate) use root::root;
