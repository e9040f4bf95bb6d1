//! Following the motion: a sweep stays on its branch, or says that it cannot.
//!
//! Solutions of C(q, t) = 0 form curves; two of them come close, or meet, only at singular
//! positions. Each step of time is judged by what is at hand ([`check`]), and by what drives can do
//! in between ([`drive`]). A step that is objected to is taken in halves. Where short steps help no
//! more there is a singular position, or nearly one, and the curve itself is followed by its arc
//! length through (q, t) ([`curve`]), on which it is regular where time turns round: [`turning`]
//! finds that place. Where two curves cross, [`branching`] finds both tangents; [`passage`] puts
//! all of this together.

mod branching;
mod check;
mod curve;
mod drive;
mod passage;
mod root;
mod singular;
mod turning;

pub use crate::model::motion::{Branch, SingularKind, SingularPosition};
pub(crate) use check::{Check, Objection, REACH, misses_too_far, turns_too_far};
pub(crate) use drive::{Drive, Lever, Span};
pub(crate) use passage::{Landed, Lost, pass};
