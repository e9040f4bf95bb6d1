//! The library: every joint, driver and law, in one table each, and every test loops over the tables.

mod composed;
mod joints;
mod laws;
mod page;
mod refused;
mod sample;
mod signs;
mod sketch;
mod table;
