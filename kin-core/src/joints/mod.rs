//! The constraint library, written in the product's own language: each joint is its equation, no
//! derivative is written by hand.
//!
//! `docs/library.md` shows all of them with their equations, rows and freedoms. Planar joints and
//! drivers are in the prelude; those of spatial bodies live in the module [`spatial`], where they
//! have the same names.
//!
//! Constructors give values, not results. A constraint that makes no sense (a length below zero, an
//! axis without direction, a law whose parts do not meet) is refused by name where a constraint is
//! added: [`Mechanism::add`](crate::Mechanism::add).

pub mod drivers;
pub mod planar;
pub mod spatial;
