//! Stores the diagnosis of a mechanism as data and writes its text.
//!
//! The module `ask/diagnosis/` computes the diagnosis.

mod advice;
mod change;
mod dependency;
mod diagnosis;
mod elsewhere;
mod freedom;
mod gap;
mod gap_line;
mod repeats;
mod text;
mod unbounded;

pub use change::{Change, GlobalPoint, Resize, Size};
pub use dependency::{Class, Dependency, Level, Term};
pub use diagnosis::Diagnosis;
pub use elsewhere::Elsewhere;
pub use freedom::{BodyMotion, Freedom, How, Persistence, Play};
pub use gap::{Against, Asks, Gap, Step};
