//! A run stays on its branch, or says that it cannot: coarse grids, toggles, change points.

mod campaign;
mod change_points;
mod coarse;
mod models;
mod toggles;
