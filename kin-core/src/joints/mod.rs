//! Defines the library of joints, couplings and drivers.
//!
//! Each joint is a function whose body is its equation. Kin derives all derivatives from this
//! equation.
//!
//! `docs/library.md` lists every joint with its equation, rows and freedoms. The prelude contains
//! the planar joints and drivers. The module [`spatial`] contains the joints and drivers of spatial
//! bodies, under the same names.
//!
//! A constructor always returns a joint, also for invalid parameters.
//! [`Mechanism::add`](crate::Mechanism::add) checks the joint and returns an error that names the
//! mistake: a negative length, an axis without direction, a law whose parts do not meet.

pub mod drivers;
pub mod planar;
pub mod spatial;
