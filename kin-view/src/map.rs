//! Draws maps: one number for each cell of a grid, as a colour.

use std::path::Path;

use kin::Result;

use crate::file;
use crate::picture::{escaped, short};

/// Viridis: the same order of brightness for every eye and in grey.
const COLORS: [[f64; 3]; 5] = [
    [68.0, 1.0, 84.0],
    [59.0, 82.0, 139.0],
    [33.0, 145.0, 140.0],
    [94.0, 201.0, 98.0],
    [253.0, 231.0, 37.0],
];
/// How many colours are told apart.
const LEVELS: usize = 40;
/// The square of the map, and the room round it.   [px]
const SIDE: f64 = 420.0;
const ROOM: [f64; 4] = [78.0, 44.0, 130.0, 58.0];

/// A map of numbers over a grid, as colours.
pub struct Map {
    title: String,
    x: Axis,
    y: Axis,
    quantity: String,
    values: Vec<f64>,
}

struct Axis {
    label: String,
    ends: (f64, f64),
    count: usize,
}

impl Map {
    /// Creates a map of a quantity, with the label and unit of its colours.
    pub fn new(title: &str, quantity: &str) -> Map {
        let axis = || Axis { label: String::new(), ends: (0.0, 1.0), count: 0 };
        Map {
            title: title.to_string(),
            x: axis(),
            y: axis(),
            quantity: quantity.to_string(),
            values: Vec::new(),
        }
    }

    /// Sets the horizontal axis: `count` cells whose centres go from `first` to `last`.
    pub fn along_x(mut self, label: &str, first: f64, last: f64, count: usize) -> Map {
        self.x = Axis { label: label.to_string(), ends: (first, last), count };
        self
    }

    /// Sets the vertical axis: `count` cells whose centres go from `first` to `last`.
    pub fn along_y(mut self, label: &str, first: f64, last: f64, count: usize) -> Map {
        self.y = Axis { label: label.to_string(), ends: (first, last), count };
        self
    }

    /// Sets the values, row by row from the lowest row, each row from left to right.
    ///
    /// A cell without a value, or with a value that is not finite, remains blank.
    pub fn values(mut self, values: impl IntoIterator<Item = f64>) -> Map {
        self.values = values.into_iter().collect();
        self
    }

    /// Writes the map to a file and creates missing folders.
    ///
    /// The format is PNG if the name of the file ends with `.png`, otherwise SVG. PNG needs the
    /// feature `png`.
    ///
    /// Errors: Kin cannot write the file; the error contains the path.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        file::save_picture(path.as_ref(), &self.svg())
    }

    /// Returns the map as SVG.
    pub fn svg(&self) -> String {
        let [left, top, right, bottom] = ROOM;
        let width = left + SIDE + right;
        let height = top + SIDE + bottom;
        let (low, high) = self.range();
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" role=\"img\" \
             font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\" font-size=\"12\" fill=\"#222222\"><title>{0}</title>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
             <text x=\"{1}\" y=\"24\" font-size=\"15\" text-anchor=\"middle\">{0}</text>\n",
            escaped(&self.title),
            left + 0.5 * SIDE
        );
        svg += &format!(
            "<rect x=\"{left}\" y=\"{top}\" width=\"{SIDE}\" height=\"{SIDE}\" fill=\"#f2f2f2\" stroke=\"#888888\"/>\n"
        );
        let wide = SIDE / self.x.count.max(1) as f64;
        let tall = SIDE / self.y.count.max(1) as f64;
        svg += &format!(
            "<g transform=\"translate({left} {}) scale({wide:.4} {:.4})\" shape-rendering=\"crispEdges\">\n",
            top + SIDE,
            -tall
        );
        for (level, path) in
            self.levels(low, high).iter().enumerate().filter(|(_, path)| !path.is_empty())
        {
            svg += &format!(
                "<path fill=\"{}\" d=\"{path}\"/>\n",
                color(level as f64 / (LEVELS - 1) as f64)
            );
        }
        svg += "</g>\n";
        svg += &self.axes();
        svg += &self.legend(low, high);
        svg + "</svg>\n"
    }

    /// Least and greatest finite value.
    fn range(&self) -> (f64, f64) {
        let finite = self.values.iter().filter(|x| x.is_finite());
        let (low, high) =
            finite.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(*x), high.max(*x)));
        if low <= high { (low, high) } else { (0.0, 1.0) }
    }

    /// Cells of each colour, runs along x as one: each a path in units of cells.
    fn levels(&self, low: f64, high: f64) -> Vec<String> {
        let mut paths = vec![String::new(); LEVELS];
        let level = |k: usize| {
            let x = self.values.get(k).copied().filter(|x| x.is_finite())?;
            // Halves: the range may be too large for a number.
            let share = (0.5 * x - 0.5 * low) / (0.5 * high - 0.5 * low);
            Some(if high > low { (share * (LEVELS - 1) as f64).round() as usize } else { 0 })
        };
        for row in 0..self.y.count {
            let mut from = 0;
            while from < self.x.count {
                let here = level(row * self.x.count + from);
                let run = (from..self.x.count)
                    .take_while(|k| level(row * self.x.count + k) == here)
                    .count();
                if let Some(path) = here.and_then(|level| paths.get_mut(level)) {
                    *path += &format!("M{from} {row}h{run}v1h-{run}z");
                }
                from += run;
            }
        }
        paths
    }

    /// Labels and five ticks on either axis.
    fn axes(&self) -> String {
        let [left, top, ..] = ROOM;
        let mut text = format!(
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n<text transform=\"translate(20 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
            left + 0.5 * SIDE,
            top + SIDE + 44.0,
            escaped(&self.x.label),
            top + 0.5 * SIDE,
            escaped(&self.y.label)
        );
        for k in 0..5 {
            let share = k as f64 / 4.0;
            let (x, label) = self.x.tick(share);
            let (y, other) = self.y.tick(share);
            text += &format!(
                "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{label}</text>\n",
                short(left + SIDE * x),
                top + SIDE + 20.0
            );
            text += &format!(
                "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{other}</text>\n",
                left - 8.0,
                short(top + SIDE * (1.0 - y) + 4.0)
            );
        }
        text
    }

    /// The colours with their values.
    fn legend(&self, low: f64, high: f64) -> String {
        let [left, top, ..] = ROOM;
        let x = left + SIDE + 24.0;
        let step = SIDE / LEVELS as f64;
        let mut text = String::new();
        for level in 0..LEVELS {
            let y = top + SIDE - step * (level + 1) as f64;
            text += &format!(
                "<rect x=\"{x}\" y=\"{}\" width=\"16\" height=\"{}\" fill=\"{}\"/>\n",
                short(y),
                short(step + 0.5),
                color(level as f64 / (LEVELS - 1) as f64)
            );
        }
        for k in 0..5 {
            let share = k as f64 / 4.0;
            let value = number(low * (1.0 - share) + high * share);
            text += &format!(
                "<text x=\"{}\" y=\"{}\">{value}</text>\n",
                x + 22.0,
                short(top + SIDE * (1.0 - share) + 4.0)
            );
        }
        text + &format!(
            "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n",
            left + SIDE + 120.0,
            top + SIDE + 44.0,
            escaped(&self.quantity)
        )
    }
}

impl Axis {
    /// Where a tick stands, as a share of the side, and what it says: middles of the first and last
    /// cells are its ends.
    fn tick(&self, share: f64) -> (f64, String) {
        let n = self.count.max(1) as f64;
        ((0.5 + share * (n - 1.0)) / n, number(self.ends.0 * (1.0 - share) + self.ends.1 * share))
    }
}

/// Three digits; nothing for what is no number.
fn number(x: f64) -> String {
    if !x.is_finite() {
        return String::new();
    }
    let text = format!("{x:.2e}");
    // Rounded up, the largest numbers are none.
    match text.parse::<f64>() {
        Ok(x) if x != 0.0 && !(1e-6..1e9).contains(&x.abs()) => {
            if x.is_finite() {
                format!("{x:e}")
            } else {
                text
            }
        }
        Ok(x) => x.to_string(),
        Err(_) => String::new(),
    }
}

/// The colour at a share from 0 to 1.
fn color(share: f64) -> String {
    let at = share.clamp(0.0, 1.0) * (COLORS.len() - 1) as f64;
    let k = (at as usize).min(COLORS.len() - 2);
    let mix = |c: usize| {
        (COLORS[k][c] + (COLORS[k + 1][c] - COLORS[k][c]) * (at - k as f64)).round() as u8
    };
    format!("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2))
}
