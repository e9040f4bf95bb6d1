//! Constraints from text: `fn parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 { …
//! }` becomes, while a program runs, what `#[constraint]` makes of it when the program is compiled.
//!
//! The rooms, in the order in which they stand on one another: `mistake`, `names`, `plain` and
//! `stage` → `signature` → `read` (text → graph with every derivative) → `constraint` (one on
//! bodies of a mechanism) → `equation` and `law` (what users hold) → `files`.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod constraint;
mod equation;
mod files;
mod law;
mod mistake;
mod names;
mod plain;
mod read;
mod signature;
mod stage;
mod unknown;

pub use constraint::ReadConstraint;
pub use equation::{Equation, Making, On, Parameter};
pub use files::registry;
pub use law::LawText;
pub use mistake::{Mistake, Mistakes};
