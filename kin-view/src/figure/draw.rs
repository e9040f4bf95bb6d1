//! Draws panels with the crate `plotters`: axes, lines, dots, and the names beside the lines.

use std::ops::Range;

use plotters::backend::SVGBackend;
use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::ranged1d::{AsRangedCoord, Ranged, ValueFormatter};
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::{Circle, PathElement, Text};
use plotters::prelude::IntoLogRange;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{BLACK, Color, IntoTextStyle, RGBColor, TextStyle, WHITE};

use super::measure::Measure;
use super::panel::{Axes, Mark, Panel, Style};

/// Plotters rounds to whole units: ten of them are one of the picture.
pub const FINE: u32 = 10;

/// The width of a panel with the labels beside its axes: numbers and names of axes, names of lines.
pub const WIDTH: u32 = 590;
const LEFT: u32 = 78;
const EDGE: u32 = 10;
const RIGHT: u32 = 140;
const TOP: u32 = 48;
const BOTTOM: u32 = 54;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<
    (),
    DrawingAreaErrorKind<<SVGBackend<'static> as plotters::backend::DrawingBackend>::ErrorType>,
>;

/// Draws panels row by row, each panel with this height.
pub fn page(panels: &[Panel], columns: usize, height: u32) -> String {
    let rows = panels.len().div_ceil(columns).max(1);
    let [across, down] = [WIDTH * columns as u32, height * rows as u32];
    let mut svg = String::new();
    // A picture in memory cannot fail to be written; what plotters refuses to draw is left out.
    let _ = draw_all(
        SVGBackend::with_string(&mut svg, (across * FINE, down * FINE)),
        panels,
        [rows, columns],
    );
    // Seen at its size where nothing else is said; the view box lets a page show it at any width.
    let fine = format!("width=\"{}\" height=\"{}\"", across * FINE, down * FINE);
    svg.replacen(&fine, &format!("width=\"{across}\" height=\"{down}\""), 1)
}

fn draw_all(backend: SVGBackend<'_>, panels: &[Panel], [rows, columns]: [usize; 2]) -> Drawn {
    let root = backend.into_drawing_area();
    root.fill(&WHITE)?;
    for (panel, area) in panels.iter().zip(root.split_evenly((rows, columns))) {
        panel.draw(&area)?;
    }
    root.present()
}

impl Panel {
    fn draw(&self, area: &Area<'_>) -> Drawn {
        let (x, y) = self.measures();
        let (across, up) = self.ranges(x, y, area);
        let log = matches!(self.axes, Axes::Time { log: true, .. }) && y == Measure::Plain;
        let some = self.marks.iter().any(|mark| !mark.points.is_empty());
        if log && some {
            self.on(area, [across, up.clone()], up.log_scale())
        } else {
            self.on(area, [across, up.clone()], up)
        }
    }

    /// The panel with its ranges, the vertical one as an axis of some kind.
    fn on<Y>(&self, area: &Area<'_>, [across, up]: [Range<f64>; 2], axis: Y) -> Drawn
    where
        Y: AsRangedCoord<Value = f64>,
        Y::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        let (x, y) = self.measures();
        let mut chart = ChartBuilder::on(area)
            .margin_top(TOP * FINE)
            .margin_left(EDGE * FINE)
            .margin_right(RIGHT * FINE)
            .x_label_area_size(BOTTOM * FINE)
            .y_label_area_size((LEFT - EDGE) * FINE)
            .build_cartesian_2d(across.clone(), axis)?;
        chart
            .configure_mesh()
            .max_light_lines(1)
            .light_line_style(WHITE.mix(0.0))
            .bold_line_style(RGBColor(208, 208, 208).stroke_width(FINE))
            .axis_style(BLACK.stroke_width(FINE))
            .set_all_tick_mark_size(5 * FINE)
            .x_labels(7)
            .y_labels(7)
            .x_label_formatter(&tick(&across))
            .y_label_formatter(&tick(&up))
            .label_style(letters(12, area))
            .axis_desc_style(letters(14, area))
            .x_desc(x.label(&self.x_label))
            .y_desc(y.label(&self.y_label))
            .draw()?;
        for mark in &self.marks {
            mark.draw(&mut chart, x, y)?;
        }
        self.title(area)?;
        self.names(area)
    }

    /// The heading, over the middle of the axes.
    fn title(&self, area: &Area<'_>) -> Drawn {
        let middle = (LEFT + (WIDTH - LEFT - RIGHT) / 2) * FINE;
        let style = letters(15, area).pos(Pos::new(HPos::Center, VPos::Center));
        area.draw(&Text::new(
            self.title.as_str(),
            (middle as i32, ((TOP - 18) * FINE) as i32),
            style,
        ))
    }

    /// Names of lines and dots, right of the axes.
    fn names(&self, area: &Area<'_>) -> Drawn {
        let left = ((WIDTH - RIGHT + 15) * FINE) as i32;
        let named =
            self.marks.iter().filter_map(|mark| mark.label.as_ref().map(|label| (mark, label)));
        for (k, (mark, label)) in named.enumerate() {
            let y = ((TOP + 6 + 18 * k as u32) * FINE) as i32;
            let [from, to, text] = [0, 12, 20].map(|across| left + across * FINE as i32);
            let color = color(mark.color);
            if mark.style == Style::Dots {
                area.draw(&Circle::new(((from + to) / 2, y), 3 * FINE, color.filled()))?;
            } else {
                area.draw(&PathElement::new(
                    [(from, y), (to, y)],
                    color.stroke_width(mark.width()),
                ))?;
            }
            let style = letters(12, area).pos(Pos::new(HPos::Left, VPos::Center));
            area.draw(&Text::new(label.as_str(), (text, y), style))?;
        }
        Ok(())
    }

    /// From where to where the axes go.
    fn ranges(&self, x: Measure, y: Measure, area: &Area<'_>) -> (Range<f64>, Range<f64>) {
        let of = |numbers: &dyn Fn(&(f64, f64)) -> f64| {
            let points = self.marks.iter().flat_map(|mark| &mark.points);
            points.map(numbers).fold(None, |range: Option<Range<f64>>, x| {
                Some(range.map_or(x..x, |range| range.start.min(x)..range.end.max(x)))
            })
        };
        let across = of(&|p| x.of_number(p.0));
        let up = of(&|p| y.of_number(p.1));
        match self.axes {
            Axes::Time { span, log } => {
                let span = span
                    .filter(|(first, last)| first.is_finite() && last.is_finite() && first < last);
                let across = span.map_or_else(
                    || widened(across),
                    |(first, last)| x.of_number(first)..x.of_number(last),
                );
                (across, if log && y == Measure::Plain { powers(up) } else { widened(up) })
            }
            Axes::Plane => equal(widened(across), widened(up), area),
            Axes::Numbers => (widened(across), widened(up)),
        }
    }
}

impl Mark {
    fn width(&self) -> u32 {
        if self.style == Style::Thin { FINE } else { FINE * 9 / 5 }
    }

    fn draw<X, Y>(
        &self,
        chart: &mut ChartContext<'_, SVGBackend<'_>, Cartesian2d<X, Y>>,
        x: Measure,
        y: Measure,
    ) -> Drawn
    where
        X: Ranged<ValueType = f64>,
        Y: Ranged<ValueType = f64>,
    {
        let points = self.points.iter().map(|p| (x.of_number(p.0), y.of_number(p.1)));
        let color = color(self.color);
        if self.style == Style::Dots {
            chart.draw_series(points.map(|p| Circle::new(p, 3 * FINE, color.filled())))?;
        } else {
            let line =
                PathElement::new(points.collect::<Vec<_>>(), color.stroke_width(self.width()));
            chart.draw_series([line])?;
        }
        Ok(())
    }
}

/// A range with some room at both ends; of no number or of one a range round it.
fn widened(range: Option<Range<f64>>) -> Range<f64> {
    let range = range.unwrap_or(0.0..1.0);
    let size = range.start.abs().max(range.end.abs());
    // Ticks of a narrower range could not be told apart.
    let least = if size == 0.0 { 1.0 } else { 1e-9 * size };
    let span = range.end - range.start;
    let room =
        if span < least { if span == 0.0 { 0.1 * size } else { least } } else { 0.05 * span };
    let room = if room == 0.0 { 1.0 } else { room };
    range.start - room..range.end + room
}

/// Powers of ten round numbers above zero.
fn powers(range: Option<Range<f64>>) -> Range<f64> {
    let range = range.unwrap_or(1.0..10.0);
    let [low, high] =
        [range.start.log10().floor(), range.end.log10().ceil()].map(|power| power as i32);
    // A little more, so that the powers at both ends have their numbers.
    10f64.powi(low) * (1.0 - 1e-6)..10f64.powi(high.max(low + 1)) * (1.0 + 1e-6)
}

/// Ranges of one scale on both axes: the narrower one grows on both sides.
fn equal(across: Range<f64>, up: Range<f64>, area: &Area<'_>) -> (Range<f64>, Range<f64>) {
    let (width, height) = area.dim_in_pixel();
    let [width, height] = [
        f64::from(width.saturating_sub((LEFT + RIGHT) * FINE).max(1)),
        f64::from(height.saturating_sub((TOP + BOTTOM) * FINE).max(1)),
    ];
    let scale = ((across.end - across.start) / width).max((up.end - up.start) / height);
    let grown = |range: Range<f64>, pixels: f64| {
        let middle = 0.5 * range.start + 0.5 * range.end;
        let half = 0.5 * scale * pixels;
        middle - half..middle + half
    };
    (grown(across, width), grown(up, height))
}

/// Letters of this height.
fn letters<'a>(size: u32, area: &Area<'_>) -> TextStyle<'a> {
    // Plotters divides by it: its sizes are those of lines of text.
    ("sans-serif", f64::from(size * FINE) * 1.24).into_text_style(area)
}

/// A colour from its digits, `#rrggbb`.
fn color(hex: &str) -> RGBColor {
    let part = |k: usize| {
        hex.get(k..k + 2).and_then(|digits| u8::from_str_radix(digits, 16).ok()).unwrap_or(0)
    };
    RGBColor(part(1), part(3), part(5))
}

/// Numbers beside an axis: four digits are enough, and zero is zero though steps from the end miss
/// it.
fn tick(range: &Range<f64>) -> impl Fn(&f64) -> String {
    let nothing = if range.contains(&0.0) { 1e-9 * (range.end - range.start) } else { 0.0 };
    move |&value| {
        let value = if value.abs() < nothing { 0.0 } else { value };
        let short = format!("{value:.3e}").parse().unwrap_or(value);
        let far = short != 0.0 && !(1e-3..1e5).contains(&short.abs());
        if far { format!("{short:e}") } else { short.to_string() }
    }
}
