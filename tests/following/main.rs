//! A run stays on its branch, or says that it cannot: coarse grids, toggles, change points.

mod ankle;
mod between;
mod campaign;
mod change_points;
mod circuits;
mod coarse;
mod dead_centres;
mod effort;
mod failures;
mod follower;
mod maps;
mod models;
mod moved;
mod moves;
mod pairs;
mod parallelograms;
mod roles;
mod toggles;

#[path = "../data/engines.rs"]
mod engines;
#[path = "../data/families.rs"]
mod families;
#[allow(dead_code)]
#[path = "../data/own.rs"]
mod own;
#[allow(dead_code)]
#[path = "../data/steps.rs"]
mod steps;
