//! Creates the animated picture: each moving part is a group with keyframes, without a script.

use kin::{Vec2, Vec3, vec2};

use super::svg::{SUPPORT, Svg, flipped, list, path_data, short};
use super::view::View;
use super::{Style, ground, line_width, shape_of};
use crate::drawing::{Drawing, LEAP, Mark, Shape, Track};

/// How many poses are shown, at least and at most. Between them everything moves straight, unless
/// bodies turn too far from one to the next: then one pose follows the other at once.
const POSES: [usize; 2] = [48, 960];
/// A body turns by less than this between two of them, if that many are enough.   [rad]
const TURN: f64 = 0.14;

/// Dark and light as the page around it is.
const STYLE: &str = "<style>.s{fill:none;stroke:#888}.p{fill:#fff;stroke:#333;stroke-width:1.6}\
                     @media(prefers-color-scheme:dark){.p{fill:#111;stroke:#ddd}}</style>";

pub(super) fn animated(drawing: &Drawing, seconds: f64) -> String {
    let view = View::new(drawing, 560.0, 400.0);
    let mut svg = Svg::new(view.width, view.height, &drawing.name);
    svg.push(STYLE);
    let poses = poses(drawing);
    let animation =
        Animation { drawing, view: &view, clock: clock(seconds, leaps(drawing, &poses)), poses };
    ground(drawing, &view, &mut svg);
    for trace in &drawing.traces {
        let path: Vec<Vec2> =
            (0..drawing.times.len()).map(|k| animation.at(trace.track, trace.local, k)).collect();
        svg.push(&format!(
            "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.4\" opacity=\".6\"/>",
            path_data(&path),
            trace.color
        ));
    }
    let lines = drawing.lines.iter().map(|line| {
        let style = format!(
            "fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"",
            line.color,
            line.kind.width()
        );
        animation.points(&line.points, &style, "polyline")
    });
    lines.for_each(|line| svg.push(&line));
    for track in 1..drawing.tracks.len() {
        svg.push(&animation.track(track));
    }
    for mark in drawing.marks.iter().filter(|mark| animation.stands(mark)) {
        let p = animation.at(mark.track, mark.local, 0);
        if mark.grounded && drawing.planar {
            svg.push(&format!(
                "<g class=\"s\" transform=\"translate({} {})\">{SUPPORT}</g>",
                short(p.x),
                short(p.y)
            ));
        }
        svg.push(&dot(p, PIN));
    }
    svg.finish()
}

/// Which frames are shown; the last is the end of the motion.
fn poses(drawing: &Drawing) -> Vec<usize> {
    let last = drawing.times.len().saturating_sub(1);
    let needed = drawing.turns.iter().filter(|turn| turn.is_finite()).sum::<f64>() / TURN;
    let count = (needed as usize).clamp(POSES[0], POSES[1]).min(last).max(1);
    (0..=count).map(|k| k * last / count).collect()
}

/// True if bodies turn too far between two poses for a straight way.
fn leaps(drawing: &Drawing, poses: &[usize]) -> bool {
    let turned = |w: &[usize]| drawing.turns[w[0]..w[1]].iter().sum::<f64>();
    poses.windows(2).any(|w| turned(w) > LEAP)
}

/// Attributes that all animations have in common.
fn clock(seconds: f64, leaps: bool) -> String {
    let seconds = if seconds.is_finite() && seconds > 0.0 { seconds } else { 4.0 };
    let mode = if leaps { " calcMode=\"discrete\"" } else { "" };
    format!("dur=\"{}s\" repeatCount=\"indefinite\"{mode}", short(seconds.max(0.01)))
}

struct Animation<'a> {
    drawing: &'a Drawing,
    view: &'a View,
    poses: Vec<usize>,
    clock: String,
}

impl Animation<'_> {
    /// Where a point of a track is drawn at frame k.
    fn at(&self, track: usize, local: Vec3, k: usize) -> Vec2 {
        self.view.point(self.drawing.tracks[track].frame(k).point(local))
    }

    /// A value for each pose.
    fn values(&self, value: impl Fn(usize) -> String) -> String {
        self.poses.iter().map(|&k| value(k)).collect::<Vec<_>>().join(";")
    }

    /// True if a mark needs no keyframes.
    fn stands(&self, mark: &Mark) -> bool {
        mark.grounded || mark.track == 0
    }

    /// All that moves with a track, with its moving marks on top.
    fn track(&self, track: usize) -> String {
        let drawing = self.drawing;
        let shapes = || drawing.shapes.iter().filter(|shape| shape.track == track);
        let marks = drawing
            .marks
            .iter()
            .filter(|mark| mark.track == track && !self.stands(mark))
            .map(|mark| (mark, PIN.to_string()));
        let traces = drawing.traces.iter().filter(|trace| trace.track == track);
        let marks: Vec<(&Mark, String)> = marks
            .chain(traces.map(|trace| (trace, format!("r=\"3\" fill=\"{}\"", trace.color))))
            .collect();
        let Track::Planar([_, _, theta]) = &drawing.tracks[track] else {
            return shapes()
                .map(|shape| self.shape(shape))
                .chain(marks.iter().map(|(mark, style)| self.mark(mark, style)))
                .collect();
        };
        let mut inner = Svg::piece();
        let local = |p: &Vec3| flipped(vec2(p.x, p.y), self.scale());
        for shape in shapes() {
            shape_of(
                &shape.points.iter().map(local).collect::<Vec<Vec2>>(),
                shape.style,
                &shape.color,
                &mut inner,
            );
        }
        for (mark, style) in &marks {
            inner.push(&dot(local(&mark.local), style));
        }
        if inner.text.is_empty() {
            return String::new();
        }
        let origin = |k: usize| self.at(track, Vec3::new(0.0, 0.0, 0.0), k);
        let place = |k: usize| format!("{} {}", tenth(origin(k).x), tenth(origin(k).y));
        let angle = |k: usize| tenth(-theta.get(k).copied().unwrap_or(0.0).to_degrees());
        let moved = self.values(place);
        let turned = self.values(angle);
        // The first pose, for viewers that show no motion.
        let first = self.poses[0];
        let rest = format!("translate({}) rotate({})", place(first), angle(first));
        let change = |kind: &str, values: &str, more: &str| {
            format!(
                "<animateTransform attributeName=\"transform\" type=\"{kind}\" values=\"{values}\" {}{more}/>",
                self.clock
            )
        };
        format!(
            "<g transform=\"{rest}\">{}{}{}</g>",
            inner.text.trim_end(),
            change("translate", &moved, ""),
            change("rotate", &turned, " additive=\"sum\"")
        )
    }

    /// Pixels a metre.
    fn scale(&self) -> f64 {
        (self.view.point(Vec3::x()) - self.view.point(Vec3::new(0.0, 0.0, 0.0))).norm()
    }

    /// A shape of a spatial body: its corners move one by one.
    fn shape(&self, shape: &Shape) -> String {
        let all: Vec<_> = shape.points.iter().map(|p| (shape.track, *p)).collect();
        let (style, tag) = match shape.style {
            Style::Plate => (
                format!(
                    "fill=\"{0}\" fill-opacity=\".28\" stroke=\"{0}\" stroke-width=\"1.6\"",
                    shape.color
                ),
                "polygon",
            ),
            style => {
                let color = &shape.color;
                let width = line_width(style);
                (format!("fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\""), "polyline")
            }
        };
        self.points(&all, &style, tag)
    }

    /// A line or shape whose corners move one by one.
    fn points(&self, points: &[(usize, Vec3)], style: &str, tag: &str) -> String {
        let listed = |k: usize| {
            let all: Vec<Vec2> = points
                .iter()
                .map(|(track, p)| self.at(*track, *p, k))
                .map(|p| vec2((p.x * 10.0).round() / 10.0, (p.y * 10.0).round() / 10.0))
                .collect();
            list(&all).unwrap_or_default()
        };
        let first = listed(self.poses[0]);
        let values = self.values(listed);
        format!(
            "<{tag} points=\"{first}\" {style}><animate attributeName=\"points\" values=\"{values}\" {}/></{tag}>",
            self.clock
        )
    }

    fn mark(&self, mark: &Mark, style: &str) -> String {
        let at = |k: usize| self.at(mark.track, mark.local, k);
        let change = |name: &str, pick: fn(Vec2) -> f64| {
            format!(
                "<animate attributeName=\"{name}\" values=\"{}\" {}/>",
                self.values(|k| tenth(pick(at(k)))),
                self.clock
            )
        };
        let rest = at(self.poses[0]);
        format!(
            "<circle cx=\"{}\" cy=\"{}\" {style}>{}{}</circle>",
            tenth(rest.x),
            tenth(rest.y),
            change("cx", |p| p.x),
            change("cy", |p| p.y)
        )
    }
}

/// How a pin looks.
const PIN: &str = "class=\"p\" r=\"4\"";

fn dot(p: Vec2, style: &str) -> String {
    format!("<circle cx=\"{}\" cy=\"{}\" {style}/>", short(p.x), short(p.y))
}

/// One digit after the point, which nobody can see.
fn tenth(x: f64) -> String {
    short((x * 10.0).round() / 10.0)
}
