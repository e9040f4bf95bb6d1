//! The second room: expressions that only rustc understands, as templates of emitted code, and the
//! source of each number of an equation.

mod expressions;
mod parts;
mod template;

pub use expressions::{Expression, Expressions};
pub use parts::{OpaqueKind, OpaqueValue, Parts, guarded};
pub use template::Template;
