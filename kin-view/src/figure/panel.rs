//! Defines a panel: one pair of axes with lines.

use kin::results::{Series, Units};
use kin::{Vec2, vec2};

use super::measure::{Measure, SANE};
use super::thin::thinned;
use crate::color::PALETTE;

/// A panel with one pair of axes: quantities over time, or paths in the plane.
///
/// At values that are not finite the lines have gaps.
pub struct Panel {
    pub(super) title: String,
    pub(super) x_label: String,
    pub(super) y_label: String,
    pub(super) axes: Axes,
    pub(super) marks: Vec<Mark>,
    named: usize,
}

/// A mark in the panel: runs of points.
pub(super) struct Mark {
    pub points: Vec<(f64, f64)>,
    pub color: &'static str,
    pub label: Option<String>,
    pub style: Style,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Style {
    Line,
    Thin,
    Dots,
}

/// Kinds of axes.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Axes {
    /// First and last time, once known; powers of ten upwards or not.
    Time { span: Option<(f64, f64)>, log: bool },
    /// Both axes with one scale.
    Plane,
    /// Any two numbers.
    Numbers,
}

impl Panel {
    /// Creates a panel of quantities over time; the vertical axis has the unit of the quantities.
    pub fn over_time(title: &str, quantity: &str) -> Panel {
        Panel::new(title, "t [s]", quantity, Axes::Time { span: None, log: false })
    }

    /// Creates a panel of quantities over time with a logarithmic vertical axis, such as for a
    /// condition number.
    ///
    /// At values that are not positive the lines have gaps.
    pub fn log_over_time(title: &str, quantity: &str) -> Panel {
        Panel::new(title, "t [s]", quantity, Axes::Time { span: None, log: true })
    }

    /// Creates a panel of the plane of motion, with equal scales on both axes.
    ///
    /// [`Panel::in_units`] sets the name of the unit of length.
    pub fn plane(title: &str) -> Panel {
        Panel::new(title, "x [m]", "y [m]", Axes::Plane)
    }

    /// Creates a panel of any quantity over any other quantity, with the labels of both axes.
    pub fn numbers(title: &str, x_label: &str, y_label: &str) -> Panel {
        Panel::new(title, x_label, y_label, Axes::Numbers)
    }

    /// Sets the names of the units of length and time, such as [`kin::Motion::unit_words`].
    ///
    /// A panel with quantities over time uses the units of the quantities without this call.
    pub fn in_units(mut self, units: &Units) -> Panel {
        match self.axes {
            Axes::Time { .. } => self.x_label = format!("t [{}]", units.time()),
            Axes::Plane => {
                [self.x_label, self.y_label] =
                    ["x", "y"].map(|axis| format!("{axis} [{}]", units.length()))
            }
            Axes::Numbers => {}
        }
        self
    }

    fn new(title: &str, x_label: &str, y_label: &str, axes: Axes) -> Panel {
        let [title, x_label, y_label] = [title, x_label, y_label].map(str::to_string);
        Panel { title, x_label, y_label, axes, marks: Vec::new(), named: 0 }
    }

    /// Adds one quantity over time, as a line.
    pub fn series(mut self, label: &str, series: &Series) -> Panel {
        let points = self.points(series);
        self.line(label, &points)
    }

    /// Adds one quantity over time, as dots, one dot for every `every` times.
    pub fn dots(mut self, label: &str, series: &Series, every: usize) -> Panel {
        let points: Vec<Vec2> = self.points(series).into_iter().step_by(every.max(1)).collect();
        self.scatter(label, &points)
    }

    /// Adds a path in the plane, as a line.
    pub fn path(self, label: &str, points: &[Vec2]) -> Panel {
        self.line(label, points)
    }

    /// Adds points, as dots.
    pub fn scatter(mut self, label: &str, points: &[Vec2]) -> Panel {
        let points = points.iter().filter(|p| self.shown(p)).map(|p| (p.x, p.y)).collect();
        let mark = Mark {
            points,
            color: self.color(),
            label: Some(label.to_string()),
            style: Style::Dots,
        };
        self.marks.push(mark);
        self
    }

    /// Adds bodies in their pose at one time, as thin grey lines without a name.
    pub fn sketch(mut self, points: &[Vec2]) -> Panel {
        let points = points.iter().filter(|p| self.shown(p)).map(|p| (p.x, p.y)).collect();
        self.marks.push(Mark { points, color: "#999999", label: None, style: Style::Thin });
        self
    }

    /// One line for each run of finite points; the first one has the name.
    fn line(mut self, label: &str, points: &[Vec2]) -> Panel {
        let color = self.color();
        let runs = points.split(|p| !self.shown(p)).filter(|run| !run.is_empty()).enumerate();
        let marks: Vec<Mark> = runs
            .map(|(k, run)| {
                let points = thinned(run).into_iter().map(|p| (p.x, p.y)).collect();
                Mark {
                    points,
                    color,
                    label: (k == 0).then(|| label.to_string()),
                    style: Style::Line,
                }
            })
            .collect();
        self.marks.extend(marks);
        self
    }

    fn shown(&self, p: &Vec2) -> bool {
        let log = matches!(self.axes, Axes::Time { log: true, .. });
        p.x.is_finite() && p.y.is_finite() && (!log || p.y > 0.0)
    }

    fn points(&mut self, series: &Series) -> Vec<Vec2> {
        if !self.y_label.ends_with(']') {
            self.y_label += &format!(" [{}]", series.unit().replace("^2", "²"));
        }
        if let (Axes::Time { span, .. }, Some(first), Some(last)) =
            (&mut self.axes, series.times().first(), series.times().last())
        {
            let low = first.min(*last);
            let high = first.max(*last);
            *span = Some(span.map_or((low, high), |known| (known.0.min(low), known.1.max(high))));
            self.x_label = format!("t [{}]", series.unit_words().time());
        }
        series.times().iter().zip(series.values()).map(|(t, value)| vec2(*t, *value)).collect()
    }

    fn color(&mut self) -> &'static str {
        self.named += 1;
        PALETTE[(self.named - 1) % PALETTE.len()]
    }

    pub(super) fn is_plane(&self) -> bool {
        self.axes == Axes::Plane
    }

    /// How numbers are brought onto either axis; both axes of the plane have one measure.
    pub(super) fn measures(&self) -> (Measure, Measure) {
        let points = || self.marks.iter().flat_map(|mark| &mark.points);
        let span = match self.axes {
            Axes::Time { span: Some((first, last)), .. } => vec![first, last],
            _ => vec![],
        };
        let x = Measure::of(points().map(|p| p.0).chain(span));
        let y = Measure::of(points().map(|p| p.1));
        match self.axes {
            Axes::Plane => {
                let both = Measure::of(points().flat_map(|p| [p.0, p.1]));
                (both, both)
            }
            Axes::Time { log: true, .. } => {
                let far = points().any(|p| !(1e-100..=SANE).contains(&p.1));
                (x, if far { Measure::Logarithm } else { Measure::Plain })
            }
            _ => (x, y),
        }
    }
}
