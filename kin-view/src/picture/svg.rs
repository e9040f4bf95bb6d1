//! Writes the SVG elements of a drawing, with escaped names and only finite numbers.

use std::fmt::Write;

use kin::{Vec2, vec2};

pub(super) struct Svg {
    pub text: String,
    width: f64,
    height: f64,
}

impl Svg {
    pub fn new(width: f64, height: f64, title: &str) -> Svg {
        let w = short(width);
        let h = short(height);
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" \
             font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\
             <title>{}</title>\n",
            escaped(title)
        );
        Svg { text, width, height }
    }

    /// Creates a piece without a frame.
    pub fn piece() -> Svg {
        Svg { text: String::new(), width: 0.0, height: 0.0 }
    }

    pub fn background(&mut self) {
        self.push("<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>");
    }

    pub fn push(&mut self, text: &str) {
        self.text.push_str(text);
        self.text.push('\n');
    }

    /// Draws a filled shape with an edge.
    pub fn polygon(&mut self, points: &[Vec2], color: &str) {
        if let Some(points) = list(points) {
            self.push(&format!(
                "<polygon points=\"{points}\" fill=\"{color}\" fill-opacity=\".28\" stroke=\"{color}\" stroke-width=\"1.6\"/>"
            ));
        }
    }

    /// Draws a line through all points.
    pub fn line(&mut self, points: &[Vec2], color: &str, width: f64) {
        if let Some(points) = list(points) {
            self.push(&format!(
                "<polyline points=\"{points}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\"/>"
            ));
        }
    }

    /// Draws a path over time, with gaps at points that are not finite and without points that do
    /// not change the picture.
    pub fn path(&mut self, points: &[Vec2], color: &str, width: f64) {
        let d = path_data(points);
        if !d.is_empty() {
            self.push(&format!(
                "<path d=\"{d}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\"/>"
            ));
        }
    }

    pub fn dot(&mut self, p: Vec2, radius: f64, color: &str) {
        if finite(&p) {
            self.push(&format!(
                "<circle cx=\"{}\" cy=\"{}\" r=\"{radius}\" fill=\"{color}\"/>",
                short(p.x),
                short(p.y)
            ));
        }
    }

    pub fn pin(&mut self, p: Vec2, color: &str) {
        if finite(&p) {
            let x = short(p.x);
            let y = short(p.y);
            self.push(&format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"4\" fill=\"#ffffff\" stroke=\"{color}\" stroke-width=\"1.6\"/>"));
        }
    }

    /// Draws a triangle on hatched ground.
    pub fn support(&mut self, p: Vec2) {
        if finite(&p) {
            self.push(&format!(
                "<g transform=\"translate({} {})\" stroke=\"#808080\" fill=\"none\" stroke-width=\"1.2\">{SUPPORT}</g>",
                short(p.x),
                short(p.y)
            ));
        }
    }

    pub fn open(&mut self, opacity: f64) {
        self.push(&if opacity < 1.0 {
            format!("<g opacity=\"{opacity:.2}\">")
        } else {
            "<g>".to_string()
        });
    }

    pub fn close(&mut self) {
        self.push("</g>");
    }

    pub fn caption(&mut self, text: &str) {
        let x = self.width - 10.0;
        let y = self.height - 8.0;
        self.push(&format!(
            "<text x=\"{}\" y=\"{}\" font-size=\"11\" fill=\"#666666\" text-anchor=\"end\">{}</text>",
            short(x),
            short(y),
            escaped(text)
        ));
    }

    /// Writes a text that begins at a point.
    pub fn note(&mut self, p: Vec2, text: &str) {
        let x = short(p.x);
        let y = short(p.y);
        let text = escaped(text);
        self.push(&format!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"11\" fill=\"#444444\">{text}</text>"
        ));
    }

    pub fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }
}

/// A support about the origin.
pub(super) const SUPPORT: &str = "<path d=\"M0 0L-8 13H8Z\" fill=\"#ececec\"/><path d=\"M-12 13H12M-10 13l-4 5M-4 13l-4 5M2 13l-4 5M8 13l-4 5\"/>";

/// Points of a path, thinned to a tenth of a pixel, one `M` for each run.
pub(super) fn path_data(points: &[Vec2]) -> String {
    let mut d = String::new();
    for run in points.split(|p| !finite(p)).filter(|run| run.len() > 1) {
        for (k, p) in crate::figure::thinned_path(run, 0.1).iter().enumerate() {
            // Writing to a String does not fail.
            let _ = write!(d, "{}{} {}", if k == 0 { "M" } else { "L" }, short(p.x), short(p.y));
        }
    }
    d
}

/// Points as an attribute; `None` if one of them is not known.
pub(super) fn list(points: &[Vec2]) -> Option<String> {
    let text: Vec<String> =
        points.iter().map(|p| format!("{},{}", short(p.x), short(p.y))).collect();
    points.iter().all(finite).then(|| text.join(" "))
}

fn finite(p: &Vec2) -> bool {
    p.x.is_finite() && p.y.is_finite()
}

/// Two digits after the point, none where there is nothing to say; 0 for what is no number, which
/// has no place in a picture.
pub(crate) fn short(x: f64) -> String {
    let x = if x.is_finite() { x } else { 0.0 };
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_string() } else { text.to_string() }
}

/// Five digits, however small or large.
pub(crate) fn digits(x: f64) -> String {
    format!("{x:.4e}").parse::<f64>().unwrap_or(x).to_string()
}

/// Text that cannot become markup; what XML forbids is left out.
pub(crate) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            '\t' | '\n' => safe.push(c),
            c if c.is_control() || matches!(c, '\u{FFFE}' | '\u{FFFF}') => {}
            c => safe.push(c),
        }
    }
    safe
}

/// The local points of a shape about another origin, turned upside down as pictures are.
pub(super) fn flipped(p: Vec2, scale: f64) -> Vec2 {
    vec2(scale * p.x, -scale * p.y)
}
