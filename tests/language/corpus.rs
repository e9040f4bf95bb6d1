//! Constraints as textbooks and other people's programs write them, each compiled twice.

mod chains;
mod curves;
mod idioms;
mod machines;
mod tables;
