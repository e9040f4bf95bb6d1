//! Charts as SVG: lines over time, and paths in the plane with equal axes.

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

/// Several panels side by side.
pub struct Figure {
    panels: Vec<Panel>,
    columns: usize,
}

impl Figure {
    /// The panels row by row, two in a row (one alone if there is only one).
    pub fn new(panels: impl IntoIterator<Item = Panel>) -> Figure {
        let panels: Vec<Panel> = panels.into_iter().collect();
        Figure { columns: panels.len().clamp(1, 2), panels }
    }

    /// One coordinate with its rates over time, one panel each.
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

    /// Another number of panels in a row.
    pub fn columns(mut self, columns: usize) -> Figure {
        self.columns = columns.clamp(1, self.panels.len().max(1));
        self
    }

    /// Writes the figure, making folders that are missing; as PNG if the file is called so (with
    /// the feature `png`), else as SVG.
    ///
    /// Errors: a file that cannot be written, by its path.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        file::save_picture(path.as_ref(), &self.svg())
    }

    /// The figure as SVG.
    pub fn svg(&self) -> String {
        let height = if self.panels.iter().any(Panel::is_plane) { 460 } else { 330 };
        draw::page(&self.panels, self.columns, height)
    }
}
