//! Creates one self-contained HTML file with a moving mechanism and charts.
//!
//! The file loads no other file, and the browser runs only the script in the file.

mod column;

use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use kin::forces::Forces;
use kin::results::{Quantity, Series};
use kin::{Motion, Result, Vec3};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use crate::color::PALETTE;
use crate::drawing::{Drawing, LineKind, Mark, Push, Scale, Style, Track};
use crate::figure::groups;
use crate::file;
use crate::picture::{digits, escaped};
use crate::scene::{Acting, Scene};
use column::packed;

const PAGE: &str = include_str!("assets/page.html");
const STYLE: &str = include_str!("assets/page.css");
const SCRIPT: [&str; 5] = [
    include_str!("assets/data.js"),
    include_str!("assets/arrows.js"),
    include_str!("assets/stage.js"),
    include_str!("assets/charts.js"),
    include_str!("assets/main.js"),
];

/// Positions on the page are right to this share of the mechanism's size, angles to this many
/// radians.
const FINE: f64 = 1e-7;

/// Forces on the page are right to this share of the largest of each.
const FINE_FORCE: f64 = 1e-5;

/// A page that shows a motion. [`Scene::page`] creates a page.
pub struct Page {
    title: String,
    drawing: Drawing,
    charts: Vec<Chart>,
    /// The last of the times asked for, where the motion has not reached it.
    unreached: Option<f64>,
    /// Why it has not.
    why: String,
}

struct Chart {
    title: String,
    unit: String,
    series: Vec<(String, Vec<f64>)>,
}

impl Scene {
    /// Creates a page that shows the motion.
    ///
    /// Errors: the motion belongs to another system.
    pub fn page(&self, motion: &Motion) -> Result<Page> {
        Ok(Page {
            title: self.name.clone(),
            drawing: Drawing::new(self, motion)?,
            charts: Vec::new(),
            unreached: None,
            why: String::new(),
        })
    }
}

impl Page {
    /// Sets the title of the page. The default is the name of the mechanism.
    pub fn title(mut self, title: &str) -> Page {
        self.title = title.to_string();
        self
    }

    /// Adds a chart of quantities over time, each with a name.
    ///
    /// The unit of the chart is the unit of the first quantity. At values that are not finite the
    /// lines have gaps.
    pub fn chart<'a>(
        self,
        title: &str,
        series: impl IntoIterator<Item = (&'a str, &'a Series)>,
    ) -> Page {
        let series: Vec<(&str, &Series)> = series.into_iter().collect();
        let unit = series.first().map(|(_, series)| series.unit().to_string()).unwrap_or_default();
        let series = series.into_iter().map(|(name, series)| (name, series.values().to_vec()));
        self.values(title, &unit, series)
    }

    /// Adds a chart of numbers over time, in a unit.
    ///
    /// Each name has a list with one number for each time of the motion. At values that are not
    /// finite the lines have gaps.
    pub fn values<'a>(
        mut self,
        title: &str,
        unit: &str,
        series: impl IntoIterator<Item = (&'a str, Vec<f64>)>,
    ) -> Page {
        let unit = if unit == "-" { String::new() } else { unit.replace("^2", "²") };
        let series = series.into_iter().map(|(name, values)| (name.to_string(), values)).collect();
        self.charts.push(Chart { title: title.to_string(), unit, series });
        self
    }

    /// Adds three charts of one coordinate: q, q̇ and q̈.
    pub fn coordinate(self, title: &str, motion: &Quantity) -> Page {
        self.chart(title, [("q", &motion.value)])
            .chart(&format!("{title}, velocity"), [("q̇", &motion.rate)])
            .chart(&format!("{title}, acceleration"), [("q̈", &motion.second_rate)])
    }

    /// Adds charts of the efforts of drivers and of the forces in joints.
    ///
    /// To show forces as arrows, call [`Scene::forces`].
    pub fn forces(self, forces: &Forces<'_>) -> Page {
        groups(forces).iter().fold(self, |page, group| {
            page.chart(
                group.title,
                group.series.iter().map(|(name, series)| (name.as_str(), series)),
            )
        })
    }

    /// Sets the requested times of the run. \[s\]
    ///
    /// If the motion has only a part of the times (as the motion in an error,
    /// [`kin::Error::motion`]), the page shows this part and says that the run ended before its
    /// last time.
    pub fn asked(mut self, times: &[f64]) -> Page {
        self.unreached = times.last().copied().filter(|_| times.len() > self.drawing.times.len());
        self
    }

    /// Sets the reason why the run ended early, such as [`kin::Error::reason`].
    ///
    /// The page shows the reason if the motion does not have all requested times.
    pub fn ended(mut self, why: &str) -> Page {
        self.why = why.to_string();
        self
    }

    /// Writes the page to a file and creates missing folders.
    ///
    /// Errors: Kin cannot write the file; the error contains the path.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        file::save(path.as_ref(), &self.html())
    }

    /// Returns the page as HTML.
    pub fn html(&self) -> String {
        let script = format!("(() => {{\n\"use strict\";\n{}}})();\n", SCRIPT.join("\n"));
        let policy = format!(
            "default-src 'none'; script-src '{}'; style-src '{}'; base-uri 'none'; form-action 'none'",
            fingerprint(&script),
            fingerprint(STYLE)
        );
        // Inside a script `<` is the only character that could end it.
        let data = self.data().to_string().replace('<', "\\u003c");
        let parts = [
            ("policy", policy),
            ("title", escaped(&self.title)),
            ("ended", self.note()),
            ("style", STYLE.into()),
            ("data", data),
            ("script", script),
        ];
        filled(PAGE, &parts)
    }

    /// The note of a run that ended early.
    fn note(&self) -> String {
        let (Some(asked), Some(last)) = (self.unreached, self.drawing.times.last()) else {
            return String::new();
        };
        let time = self.drawing.units.time();
        let (first, rest) = self.why.split_once('\n').unwrap_or((&self.why, ""));
        let more = "<details><summary>more</summary><p>";
        let rest = if rest.is_empty() {
            String::new()
        } else {
            format!("{more}{}</p></details>", escaped(rest))
        };
        let why =
            if first.is_empty() { String::new() } else { format!("<p>{}</p>", escaped(first)) };
        format!(
            "<aside id=\"ended\" role=\"note\"><b>The run ended early: the page shows it up to t = {} {time}, of {} {time}.</b>{why}{rest}</aside>",
            digits(*last),
            digits(asked),
            time = escaped(time)
        )
    }

    /// Everything the script needs.
    fn data(&self) -> Value {
        let drawing = &self.drawing;
        let fine = FINE * drawing.size;
        let tracks = drawing.tracks.iter().map(|track| {
            let (kind, lengths) = match track {
                Track::Ground => ("ground", 0),
                Track::Planar(_) => ("planar", 2),
                Track::Spatial(_) => ("spatial", 3),
                Track::Point(_) => ("point", 3),
            };
            let columns = track.columns().iter().enumerate();
            let columns: Vec<Value> = columns
                .map(|(k, column)| packed(column, if k < lengths { fine } else { FINE }))
                .collect();
            json!({ "kind": kind, "columns": columns })
        });
        let shapes = drawing.shapes.iter().map(|shape| {
            let points: Vec<Value> = shape.points.iter().map(|p| place(*p, drawing.size)).collect();
            json!({ "name": shape.name, "track": shape.track, "style": style(shape.style), "color": shape.color, "points": points })
        });
        let lines = drawing.lines.iter().map(|line| {
            let points: Vec<Value> = line.points.iter().map(|(track, p)| json!([track, place(*p, drawing.size)])).collect();
            json!({ "name": line.name, "style": line_style(line.kind), "color": line.color, "points": points })
        });
        let mark = |mark: &Mark| json!({ "name": mark.name, "track": mark.track, "local": place(mark.local, drawing.size), "color": mark.color, "grounded": mark.grounded });
        let times = self.drawing.times.as_slice();
        let leaps: Vec<f64> =
            drawing.leaps().map(|leaps| f64::from(u8::from(leaps))).chain([0.0]).collect();
        let leaps = leaps.contains(&1.0).then(|| packed(&leaps[..times.len()], 1.0));
        let pushes: Vec<Value> = drawing.pushes.iter().map(|push| self.push_data(push)).collect();
        let scale = |scale: &Scale| json!({ "length": scale.length, "turn": scale.turn, "unit": scale.unit });
        json!({
            "planar": drawing.planar,
            "units": [drawing.units.length(), drawing.units.time()],
            "eye": [drawing.eye.0, drawing.eye.1],
            "bounds": drawing.bounds.map(|p| place(p, drawing.size)),
            "size": drawing.size,
            "frames": times.len(),
            "leaps": leaps,
            "times": packed(times, 1e-7 * span(times)),
            "tracks": tracks.collect::<Vec<_>>(),
            "shapes": shapes.collect::<Vec<_>>(),
            "lines": lines.collect::<Vec<_>>(),
            "marks": drawing.marks.iter().map(mark).collect::<Vec<_>>(),
            "traces": drawing.traces.iter().map(mark).collect::<Vec<_>>(),
            "pushes": pushes,
            "scales": drawing.scales.iter().map(scale).collect::<Vec<_>>(),
            "longest": drawing.longest,
            "charts": self.charts.iter().map(|chart| self.chart_data(chart)).collect::<Vec<_>>(),
        })
    }

    /// A force or torque; in the plane what is not zero.
    fn push_data(&self, push: &Push) -> Value {
        let axes: &[usize] = match (self.drawing.planar, push.is_torque) {
            (true, true) => &[2],
            (true, false) => &[0, 1],
            (false, _) => &[0, 1, 2],
        };
        let largest = push.vectors.iter().map(|vector| vector.norm()).filter(|x| x.is_finite());
        let step = FINE_FORCE * largest.fold(0.0, f64::max);
        let column = |axis: &usize| {
            let values: Vec<f64> =
                push.vectors.iter().map(|vector| vector.to_array()[*axis]).collect();
            packed(&values, step)
        };
        json!({
            "name": push.name,
            "acting": acting(push.acting),
            "torque": push.is_torque,
            "track": push.track,
            "local": place(push.local, self.drawing.size),
            "columns": axes.iter().map(column).collect::<Vec<_>>(),
        })
    }

    fn chart_data(&self, chart: &Chart) -> Value {
        let series = chart.series.iter().enumerate().map(|(k, (name, values))| {
            let values = packed(values, 2e-6 * span(values));
            json!({ "name": name, "color": PALETTE[k % PALETTE.len()], "values": values })
        });
        json!({ "title": chart.title, "unit": chart.unit, "series": series.collect::<Vec<_>>() })
    }
}

/// Greatest less least of the finite values; 1 if there is no difference.
fn span(values: &[f64]) -> f64 {
    let known = values.iter().filter(|x| x.is_finite());
    let (low, high) =
        known.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(*x), high.max(*x)));
    if high > low && (high - low).is_finite() { high - low } else { 1.0 }
}

/// A point, rounded to what can be seen.
fn place(p: Vec3, size: f64) -> Value {
    let unit = 10.0_f64.powf((size * FINE).log10().floor());
    let round = |x: f64| {
        if (x / unit).abs() < 1e15 {
            format!("{:.8e}", (x / unit).round() * unit).parse().unwrap_or(x)
        } else {
            x
        }
    };
    json!([round(p.x), round(p.y), round(p.z)])
}

fn style(style: Style) -> &'static str {
    match style {
        Style::Plate => "plate",
        Style::Bar => "bar",
        Style::Slot => "slot",
        Style::Guide => "guide",
    }
}

fn acting(acting: Acting) -> &'static str {
    match acting {
        Acting::Joint => "joint",
        Acting::Drive => "drive",
        Acting::Load => "load",
    }
}

fn line_style(kind: LineKind) -> &'static str {
    match kind {
        LineKind::Outline | LineKind::Rod => "rod",
        LineKind::Barrel => "barrel",
    }
}

/// How a content policy names a script or style.
pub(crate) fn fingerprint(text: &str) -> String {
    format!("sha256-{}", STANDARD.encode(Sha256::digest(text)))
}

/// The page with each `{{name}}` replaced once, in one pass: what is put in is not looked at again.
pub(crate) fn filled(page: &str, parts: &[(&str, String)]) -> String {
    let mut filled = String::new();
    let mut rest = page;
    while let Some((before, after)) = rest.split_once("{{") {
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        filled.push_str(before);
        filled
            .extend(parts.iter().find(|(known, _)| *known == name).map(|(_, part)| part.as_str()));
        rest = after;
    }
    filled + rest
}
