//! Creates constraints and laws from text while a program runs.
//!
//! The text `fn parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 { … }` gives the
//! same constraint as `#[constraint]` at compile time.
//!
//! The modules, each built on the modules before it: `mistake`, `names`, `plain` and `stage` →
//! `signature` → `read` (text → graph with every derivative) → `constraint` (a constraint on bodies
//! of a mechanism) → `equation` and `law` (the types for users) → `files`.
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
