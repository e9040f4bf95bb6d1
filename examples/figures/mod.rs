//! The figures of the examples, as SVG: lines over time, and paths in the plane with equal axes.
#![allow(dead_code)] // each example uses its part

use std::path::Path;

use kin::{Series, Vec2};
use kuva::plot::{LegendPosition, LinePlot};
use kuva::render::figure::Figure;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;

/// Blue, vermilion, green, purple: told apart by every eye (Okabe and Ito).
const COLORS: [&str; 4] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"];
/// A point that a straight line misses by less than this share of the picture is left out: a tenth of a pixel or so.
const INVISIBLE: f64 = 2e-4;

/// One pair of axes with lines in it.
pub struct Panel {
    title: String,
    x_label: String,
    y_label: String,
    equal: bool,
    lines: Vec<LinePlot>,
}

impl Panel {
    /// Quantities over time; the vertical axis takes its unit from them.
    pub fn over_time(title: &str, quantity: &str) -> Panel {
        Panel { title: title.to_string(), x_label: "t [s]".to_string(), y_label: quantity.to_string(), equal: false, lines: Vec::new() }
    }

    /// The plane of motion, one metre as long upwards as to the right.
    pub fn plane(title: &str) -> Panel {
        Panel { title: title.to_string(), x_label: "x [m]".to_string(), y_label: "y [m]".to_string(), equal: true, lines: Vec::new() }
    }

    /// One quantity over time.
    pub fn series(mut self, label: &str, series: &Series) -> Panel {
        let unit = format!(" [{}]", series.unit().replace("^2", "²"));
        if !self.y_label.ends_with(']') {
            self.y_label += &unit;
        }
        let points = series.times().iter().copied().zip(series.values().iter().copied()).collect();
        self.line(label, points)
    }

    /// A path in the plane.
    pub fn path(self, label: &str, points: &[Vec2]) -> Panel {
        self.line(label, points.iter().map(|p| (p.x, p.y)).collect())
    }

    /// Bodies as they stand at one time: thin grey lines without a name.
    pub fn sketch(mut self, points: &[Vec2]) -> Panel {
        let points = points.iter().map(|p| (p.x, p.y));
        self.lines.push(LinePlot::new().with_data(points).with_color("#888888").with_stroke_width(1.0));
        self
    }

    fn line(mut self, label: &str, points: Vec<(f64, f64)>) -> Panel {
        let color = COLORS[self.lines.iter().filter(|line| line.legend_label.is_some()).count() % COLORS.len()];
        self.lines.push(LinePlot::new().with_data(thinned(&points)).with_color(color).with_stroke_width(1.5).with_legend(label));
        self
    }
}

/// Writes the panels under one another in columns, making folders that are missing; a file that cannot be written is named.
pub fn save(path: impl AsRef<Path>, columns: usize, panels: Vec<Panel>) -> kin::Result<()> {
    let path = path.as_ref();
    let svg = svg(columns, panels);
    let write = || {
        path.parent().map_or(Ok(()), std::fs::create_dir_all)?;
        std::fs::write(path, svg)
    };
    write().map_err(|source| kin::Error::File { path: path.to_path_buf(), source })
}

fn svg(columns: usize, panels: Vec<Panel>) -> String {
    let mut plots = Vec::new();
    let mut layouts = Vec::new();
    let rows = panels.len().div_ceil(columns);
    for panel in panels {
        let lines: Vec<Plot> = panel.lines.into_iter().map(Plot::Line).collect();
        let layout = Layout::auto_from_plots(&lines)
            .with_title(panel.title)
            .with_title_size(15)
            .with_x_label(panel.x_label)
            .with_y_label(panel.y_label)
            .with_legend_position(LegendPosition::OutsideRightTop)
            .with_legend_box(false);
        layouts.push(if panel.equal { layout.with_equal_aspect() } else { layout });
        plots.push(lines);
    }
    let figure = Figure::new(rows, columns).with_plots(plots).with_layouts(layouts).with_cell_size(560.0, 360.0);
    kuva::backend::svg::SvgBackend.render_scene(&figure.render())
}

/// The points without those that nobody would miss (Douglas and Peucker), the picture taken as one unit high and wide.
fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let extent = |pick: fn(&(f64, f64)) -> f64| {
        let (low, high) = points.iter().map(pick).fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
        (high - low).max(f64::MIN_POSITIVE)
    };
    let (width, height) = (extent(|p| p.0), extent(|p| p.1));
    let unit: Vec<Vec2> = points.iter().map(|p| kin::vec2(p.0 / width, p.1 / height)).collect();
    let mut keep = vec![false; points.len()];
    let mut spans = vec![(0, points.len().saturating_sub(1))];
    while let Some((first, last)) = spans.pop() {
        let (a, chord) = (unit[first], unit[last] - unit[first]);
        let miss = |p: Vec2| {
            let along = if chord.norm() > 0.0 { ((p - a).dot(chord) / chord.dot(chord)).clamp(0.0, 1.0) } else { 0.0 };
            (p - a - chord * along).norm()
        };
        let worst = (first + 1..last).max_by(|&i, &j| miss(unit[i]).total_cmp(&miss(unit[j])));
        keep[first] = true;
        keep[last] = true;
        if let Some(middle) = worst.filter(|&k| miss(unit[k]) > INVISIBLE) {
            spans.extend([(first, middle), (middle, last)]);
        }
    }
    points.iter().zip(keep).filter(|(_, keep)| *keep).map(|(point, _)| *point).collect()
}
