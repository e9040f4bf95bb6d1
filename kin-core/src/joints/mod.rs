//! The library of joints, couplings and drivers. Each joint is a function whose body is its
//! equation; Kin derives all derivatives from it.
//!
//! `docs/library.md` lists every joint with its equation, rows and freedoms. The prelude contains
//! the planar joints and drivers. The module [`spatial`] contains those of spatial bodies, under
//! the same names.
//!
//! A constructor returns a joint, never an error. [`Mechanism::add`](crate::Mechanism::add) checks
//! the joint and names what is wrong: a negative length, an axis without direction, a law whose
//! parts do not meet.

pub mod drivers;
pub mod planar;
pub mod spatial;
