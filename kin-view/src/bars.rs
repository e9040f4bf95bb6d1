//! Draws bars that show the share of each dimension in a tolerance.

use std::fmt::Write;
use std::path::Path;

use kin::Result;
use kin::design::{Feature, Tolerance};

use crate::color::PALETTE;
use crate::file;
use crate::picture::escaped;

const WIDTH: f64 = 640.0;
const LEFT: f64 = 170.0; // names
const RIGHT: f64 = 150.0; // numbers
const TOP: f64 = 62.0;
const ROW: f64 = 34.0;
const BOTTOM: f64 = 30.0;
/// Characters of a name that have room beside its bar.
const LONGEST: usize = 22;

/// A chart of the shares of the dimensions in a tolerance, the largest first.
///
/// A broad bar shows the share in the worst case, and a narrow bar below it shows the share in the
/// variance. A blue bar means that the measure grows with the dimension; a vermilion bar means that
/// the measure decreases.
pub struct Bars {
    title: String,
    summary: String,
    rows: Vec<Row>,
}

/// One dimension.
struct Row {
    name: String,
    share: f64,
    of_variance: f64,
    off: f64,
    number: String,
}

impl Bars {
    /// Creates the bars of a tolerance.
    ///
    /// `time_unit` is the unit of the tolerance's time in the title.
    pub fn new(tolerance: &Tolerance, time_unit: &str) -> Bars {
        let Tolerance { name, unit, .. } = tolerance;
        let when = match tolerance.feature {
            Feature::Stroke(_) => String::new(),
            _ => format!(" at t = {} {time_unit}", short(tolerance.t)),
        };
        let row = |one: &kin::design::Contribution| Row {
            name: one.name.clone(),
            share: tolerance.share(one),
            of_variance: tolerance.share_of_variance(one),
            off: one.off(),
            number: format!(
                "{:.0} %   {}{} {unit}",
                100.0 * tolerance.share(one),
                if one.off() < 0.0 { "−" } else { "+" },
                short(one.off().abs())
            ),
        };
        Bars {
            title: format!("{name} = {} {unit}{when}", short(tolerance.nominal)),
            summary: format!(
                "± {} {unit} worst case, ± {} {unit} RSS",
                short(tolerance.worst_case()),
                short(tolerance.rss())
            ),
            rows: tolerance.contributions.iter().map(row).collect(),
        }
    }

    /// Writes the picture to a file and creates missing folders.
    ///
    /// The format is PNG if the name of the file ends with `.png`, otherwise SVG. PNG needs the
    /// feature `png`.
    ///
    /// Errors: Kin cannot write the file; the error contains the path.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        file::save_picture(path.as_ref(), &self.svg())
    }

    /// Returns the picture as SVG.
    pub fn svg(&self) -> String {
        let height = TOP + ROW * self.rows.len() as f64 + BOTTOM;
        let most =
            self.rows.iter().flat_map(|row| [row.share, row.of_variance]).fold(1e-12, f64::max);
        let scale = (WIDTH - LEFT - RIGHT) / most;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" viewBox=\"0 0 {WIDTH} \
             {height}\" font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"{WIDTH}\" height=\"{height}\" \
             fill=\"#fff\"/>\n"
        );
        let mut text = |x: f64, y: f64, style: &str, text: &str| {
            let _ =
                writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" {style}>{}</text>", escaped(text));
        };
        text(16.0, 26.0, "font-size=\"16\" font-weight=\"bold\"", &self.title);
        text(16.0, 46.0, "fill=\"#444\"", &self.summary);
        for (k, row) in self.rows.iter().enumerate() {
            let y = TOP + ROW * k as f64;
            text(LEFT - 10.0, y + 17.0, "text-anchor=\"end\"", &fitted(&row.name));
            text(LEFT + scale * row.share.max(row.of_variance) + 8.0, y + 17.0, "", &row.number);
        }
        let key = "narrow bar: fraction of the variance; blue: the result grows with the dimension, vermilion: the result falls";
        text(16.0, height - 10.0, "font-size=\"11\" fill=\"#666\"", key);
        for (k, row) in self.rows.iter().enumerate() {
            let y = TOP + ROW * k as f64;
            let color = PALETTE[usize::from(row.off < 0.0)];
            for (share, from, thick, opacity) in
                [(row.share, 3.0, 15.0, 1.0), (row.of_variance, 20.0, 6.0, 0.5)]
            {
                let _ = writeln!(
                    svg,
                    "<rect x=\"{LEFT}\" y=\"{:.1}\" width=\"{:.2}\" height=\"{thick}\" fill=\"{color}\" \
                     fill-opacity=\"{opacity}\"/>",
                    y + from,
                    scale * share.max(0.0)
                );
            }
        }
        svg + "</svg>\n"
    }
}

/// A name as far as there is room for it.
fn fitted(name: &str) -> String {
    match name.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &name[..end]),
        None => name.to_string(),
    }
}

/// A number with four digits, as short as it can be.
fn short(x: f64) -> String {
    let number: f64 = format!("{x:.3e}").parse().unwrap_or(x);
    number.to_string()
}
