//! Creates pictures of a mechanism as SVG: at one time, as a sequence of poses, and animated.

mod animated;
mod arrows;
mod svg;
mod view;

use std::path::Path;

use kin::{Motion, Result, Vec3};

use crate::drawing::{Drawing, LineKind, Mark, Style};
use crate::file;
use crate::scene::Scene;
use svg::Svg;
pub(crate) use svg::{digits, escaped, short};
use view::View;

/// A picture of a mechanism, which [`Picture::save`] writes to a file.
pub struct Picture {
    svg: String,
}

impl Picture {
    /// Writes the picture to a file and creates missing folders.
    ///
    /// The format is PNG if the name of the file ends with `.png`, otherwise SVG. PNG needs the
    /// feature `png`.
    ///
    /// Errors: Kin cannot write the file; the error contains the path.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        file::save_picture(path.as_ref(), &self.svg)
    }

    /// Returns the picture as SVG.
    pub fn svg(&self) -> &str {
        &self.svg
    }
}

impl Scene {
    /// Draws the mechanism in its pose at the time of the motion that is nearest to t. \[s\]
    ///
    /// The picture contains the traced paths, and the forces if the scene has forces
    /// ([`Scene::forces`]).
    ///
    /// Errors: the motion belongs to another system.
    pub fn pose(&self, motion: &Motion, t: f64) -> Result<Picture> {
        let distance = |k: &usize| (motion.times()[*k] - t).abs();
        let nearest = (0..motion.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        self.pictured(motion, &nearest.map(|k| (k, 1.0)).into_iter().collect::<Vec<_>>())
    }

    /// Draws the mechanism at `count` evenly spaced times of the motion, with the traced paths.
    ///
    /// Later poses are darker.
    ///
    /// Errors: the motion belongs to another system.
    pub fn sequence(&self, motion: &Motion, count: usize) -> Result<Picture> {
        let last = motion.len().saturating_sub(1);
        let gaps = count.clamp(1, motion.len().max(1)).max(2) - 1;
        let at = |k: usize| {
            (k * last / gaps, if k == gaps { 1.0 } else { 0.16 + 0.34 * k as f64 / gaps as f64 })
        };
        self.pictured(motion, &(0..=gaps).map(at).collect::<Vec<_>>())
    }

    /// Draws the motion as an animated SVG of a few kilobytes, which repeats every `seconds`
    /// seconds.
    ///
    /// The animation has about 48 poses for each revolution, with linear interpolation between
    /// poses. If a body rotates by more than 0.6 rad from one time of the motion to the next, the
    /// animation does not interpolate between these poses. A viewer without animation shows the
    /// first pose.
    ///
    /// Errors: the motion belongs to another system.
    pub fn animated(&self, motion: &Motion, seconds: f64) -> Result<Picture> {
        Ok(Picture { svg: animated::animated(&Drawing::new(self, motion)?, seconds) })
    }

    fn pictured(&self, motion: &Motion, frames: &[(usize, f64)]) -> Result<Picture> {
        let drawing = Drawing::new(self, motion)?;
        Ok(Picture { svg: pictured(&drawing, frames) })
    }
}

/// The mechanism at some times, each with its opacity.
fn pictured(drawing: &Drawing, frames: &[(usize, f64)]) -> String {
    let mut view = View::new(drawing, 720.0, 560.0);
    if frames.len() == 1 {
        view.height += arrows::room(drawing);
    }
    let mut svg = Svg::new(view.width, view.height, &drawing.name);
    svg.background();
    ground(drawing, &view, &mut svg);
    for trace in &drawing.traces {
        let path: Vec<_> = (0..drawing.times.len())
            .map(|k| view.point(drawing.tracks[trace.track].frame(k).point(trace.local)))
            .collect();
        svg.path(&path, &trace.color, 1.4);
    }
    for &(k, opacity) in frames {
        svg.open(opacity);
        moving(drawing, &view, k, &mut svg);
        svg.close();
    }
    if let [(k, _)] = frames {
        arrows::arrows(drawing, &view, *k, &mut svg);
        svg.caption(&format!("t = {} {}", digits(drawing.times[*k]), drawing.units.time()));
    }
    svg.finish()
}

/// Draws everything that stands still.
fn ground(drawing: &Drawing, view: &View, svg: &mut Svg) {
    for line in view.floor(drawing) {
        svg.line(&line, "#e4e4e4", 1.0);
    }
    for shape in drawing.shapes.iter().filter(|shape| shape.track == 0) {
        let points: Vec<_> = shape.points.iter().map(|p| view.point(*p)).collect();
        shape_of(&points, shape.style, &shape.color, svg);
    }
}

/// Shapes that a list of points is drawn as.
#[derive(Clone, Copy)]
enum Drawn {
    Shape(Style),
    Line(LineKind),
}

/// Draws everything that moves, as it stands at time k; in space the farther first.
fn moving(drawing: &Drawing, view: &View, k: usize, svg: &mut Svg) {
    let frames: Vec<_> = drawing.tracks.iter().map(|track| track.frame(k)).collect();
    let placed = |points: &[(usize, Vec3)]| {
        points.iter().map(|(track, p)| frames[*track].point(*p)).collect::<Vec<Vec3>>()
    };
    let shapes = drawing.shapes.iter().filter(|shape| shape.track != 0);
    let shapes = shapes.map(|shape| {
        (
            shape.points.iter().map(|p| frames[shape.track].point(*p)).collect(),
            Drawn::Shape(shape.style),
            &shape.color,
        )
    });
    let lines = drawing
        .lines
        .iter()
        .map(|line| (placed(&line.points), Drawn::Line(line.kind), &line.color));
    let mut all: Vec<(Vec<Vec3>, Drawn, &String)> = shapes.chain(lines).collect();
    if !drawing.planar {
        let depth = |points: &[Vec3]| {
            points.iter().map(|p| view.depth(*p)).sum::<f64>() / points.len().max(1) as f64
        };
        all.sort_by(|a, b| depth(&a.0).total_cmp(&depth(&b.0)));
    }
    for (points, style, color) in all {
        let points: Vec<_> = points.into_iter().map(|p| view.point(p)).collect();
        match style {
            Drawn::Shape(style) => shape_of(&points, style, color, svg),
            Drawn::Line(kind) => svg.line(&points, color, kind.width()),
        }
    }
    for mark in drawing.marks.iter().chain(&drawing.traces) {
        mark_at(view.point(frames[mark.track].point(mark.local)), mark, drawing, svg);
    }
}

fn shape_of(points: &[kin::Vec2], style: Style, color: &str, svg: &mut Svg) {
    match style {
        Style::Plate => svg.polygon(points, color),
        _ => svg.line(points, color, line_width(style)),
    }
}

/// How wide the line or edge of a shape is.   [px]
fn line_width(style: Style) -> f64 {
    match style {
        Style::Plate => 1.6,
        Style::Bar => 6.0,
        Style::Slot => 2.0,
        Style::Guide => 2.5,
    }
}

fn mark_at(p: kin::Vec2, mark: &Mark, drawing: &Drawing, svg: &mut Svg) {
    let is_trace = drawing.traces.iter().any(|trace| std::ptr::eq(trace, mark));
    if is_trace {
        return svg.dot(p, 3.0, &mark.color);
    }
    if mark.grounded && drawing.planar {
        svg.support(p);
    }
    svg.pin(p, if mark.grounded { "#333333" } else { "#222222" });
}
