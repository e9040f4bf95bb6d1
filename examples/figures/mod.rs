//! The figures of the examples, as SVG: lines over time, and paths in the plane with equal axes.
#![allow(dead_code)] // each example uses its part

use std::path::Path;
use std::sync::Arc;

use kin::{Series, Vec2};
use kuva::backend::svg::SvgBackend;
use kuva::plot::{LinePlot, ScatterPlot};
use kuva::render::figure::Figure;
use kuva::render::layout::{Layout, TickFormat};
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
    /// First and last time; none in the plane.
    times: Option<(f64, f64)>,
    plots: Vec<Plot>,
    named: usize,
}

impl Panel {
    /// Quantities over time; the vertical axis takes its unit from them.
    pub fn over_time(title: &str, quantity: &str) -> Panel {
        Panel::new(title, "t [s]", quantity)
    }

    /// The plane of motion, one metre as long upwards as to the right.
    pub fn plane(title: &str) -> Panel {
        Panel::new(title, "x [m]", "y [m]")
    }

    fn new(title: &str, x_label: &str, y_label: &str) -> Panel {
        let [title, x_label, y_label] = [title, x_label, y_label].map(str::to_string);
        Panel { title, x_label, y_label, times: None, plots: Vec::new(), named: 0 }
    }

    /// One quantity over time, as a line.
    pub fn series(mut self, label: &str, series: &Series) -> Panel {
        let points = self.points(series);
        self.line(label, points)
    }

    /// One quantity over time, as a dot every so many times.
    pub fn dots(mut self, label: &str, series: &Series, every: usize) -> Panel {
        let points = self.points(series).into_iter().step_by(every);
        let dots = ScatterPlot::new().with_data(points).with_color(self.color()).with_size(3.0).with_legend(label);
        self.plots.push(Plot::Scatter(dots));
        self
    }

    /// A path in the plane.
    pub fn path(self, label: &str, points: &[Vec2]) -> Panel {
        self.line(label, points.iter().map(|p| (p.x, p.y)).collect())
    }

    /// Bodies as they stand at one time: thin grey lines without a name.
    pub fn sketch(mut self, points: &[Vec2]) -> Panel {
        let points = points.iter().map(|p| (p.x, p.y));
        self.plots.push(Plot::Line(LinePlot::new().with_data(points).with_color("#999999").with_stroke_width(1.0)));
        self
    }

    fn line(mut self, label: &str, points: Vec<(f64, f64)>) -> Panel {
        let line = LinePlot::new().with_data(thinned(&points)).with_color(self.color()).with_stroke_width(1.8).with_legend(label);
        self.plots.push(Plot::Line(line));
        self
    }

    fn points(&mut self, series: &Series) -> Vec<(f64, f64)> {
        if !self.y_label.ends_with(']') {
            self.y_label += &format!(" [{}]", series.unit().replace("^2", "²"));
        }
        self.times = series.times().first().copied().zip(series.times().last().copied());
        series.times().iter().copied().zip(series.values().iter().copied()).collect()
    }

    fn color(&mut self) -> &'static str {
        self.named += 1;
        COLORS[(self.named - 1) % COLORS.len()]
    }
}

/// Writes the panels row by row, making folders that are missing; a file that cannot be written is named.
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
    let height = if panels.iter().any(|panel| panel.times.is_none()) { 460.0 } else { 330.0 };
    let (mut plots, mut layouts) = (Vec::new(), Vec::new());
    for panel in panels {
        let layout = Layout::auto_from_plots(&panel.plots).with_title(panel.title).with_title_size(15).with_legend_box(false);
        let layout = layout.with_x_label(panel.x_label).with_y_label(panel.y_label).with_force_margins(78.0, 140.0);
        let layout = layout.with_tick_format(TickFormat::Custom(Arc::new(tick)));
        layouts.push(match panel.times {
            Some((first, last)) => layout.with_x_axis_min(first).with_x_axis_max(last),
            None => layout.with_equal_aspect(),
        });
        plots.push(panel.plots);
    }
    let figure = Figure::new(plots.len().div_ceil(columns), columns).with_cell_size(590.0, height);
    let scene = figure.with_plots(plots).with_layouts(layouts).render();
    // A view box lets a page show it at any width.
    let size = format!("<svg viewBox=\"0 0 {} {}\"", scene.width, scene.height);
    SvgBackend::new().render_scene(&scene).replacen("<svg", &size, 1)
}

/// Four digits are enough beside an axis.
fn tick(value: f64) -> String {
    let short = format!("{value:.3e}").parse().unwrap_or(value);
    if short != 0.0 && !(1e-3..1e5).contains(&short.abs()) { format!("{short:e}") } else { short.to_string() }
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
