//! The constraint library, written in the product's own language: each joint is its equation, no derivative is written by hand.
//!
//! | joint | rows | freedoms left | where |
//! |---|---|---|---|
//! | [`fixed`](planar::fixed()) | 3 | 0 | lecture, "Constraint Equations" |
//! | [`revolute`](planar::revolute()) | 2 | 1 | lecture, "Constraint Library: Revolute" |
//! | [`prismatic`](planar::prismatic()) | 2 | 1 | lecture, "Constraint Library: Prismatic" |
//! | [`drive_angle`](drivers::drive_angle()), [`drive`](drivers::drive()) | 1 | – | lecture, "Driving Constraints" |
//! | [`drive_point`](drivers::drive_point()) | 2 | – | lecture, "Driving Constraints": complex driver |

pub mod drivers;
pub mod planar;
pub mod spatial;
