//! Automatic against hand derivation: the lecture's own formulas ("Kinematically Driven Systems",
//! 2023, its misprints corrected), written here by hand, against the terms that Kin gives from the
//! equations alone, on the symbolic and on the dual route.

mod drivers;
mod moving_point;
mod points;
mod prismatic;
mod revolute;
mod slider_crank;
mod spatial;
mod support;
mod two_link;
