//! Draws charts as SVG: lines over time, and paths in the plane with equal axes.

mod draw;
mod forces;
mod measure;
mod panel;
mod thin;

use std::path::Path;

use kin::Result;
use kin::results::Quantity;

pub(crate) use forces::groups;
pub use panel::Panel;
pub(crate) use thin::thinned_path;

use crate::file;

/// A figure with one or more panels.
pub struct Figure {
    panels: Vec<Panel>,
    columns: usize,
}

impl Figure {
    /// Creates a figure of panels, row by row with two panels in a row.
    pub fn new(panels: impl IntoIterator<Item = Panel>) -> Figure {
        let panels: Vec<Panel> = panels.into_iter().collect();
        Figure { columns: panels.len().clamp(1, 2), panels }
    }

    /// Creates a figure of one coordinate, its velocity and its acceleration over time, with one
    /// panel for each.
    pub fn of_coordinate(name: &str, motion: &Quantity) -> Figure {
        let panel =
            |title: &str, label: &str, series| Panel::over_time(title, label).series(label, series);
        Figure::new([
            panel(name, "q", &motion.value),
            panel(&format!("{name}, velocity"), "q̇", &motion.rate),
            panel(&format!("{name}, acceleration"), "q̈", &motion.second_rate),
        ])
        .columns(3)
    }

    /// Sets the number of panels in a row.
    pub fn columns(mut self, columns: usize) -> Figure {
        self.columns = columns.clamp(1, self.panels.len().max(1));
        self
    }

    /// Writes the figure to a file and creates missing folders.
    ///
    /// The format is PNG if the name of the file ends with `.png`, otherwise SVG. PNG needs the
    /// feature `png`.
    ///
    /// Errors: Kin cannot write the file; the error contains the path.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        file::save_picture(path.as_ref(), &self.svg())
    }

    /// Returns the figure as SVG.
    pub fn svg(&self) -> String {
        let height = if self.panels.iter().any(Panel::is_plane) { 460 } else { 330 };
        draw::page(&self.panels, self.columns, height)
    }
}
