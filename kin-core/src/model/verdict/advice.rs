//! Writes changes to a mechanism, and their reasons, as sentences.

use std::fmt::{Display, Formatter, Result};

use super::change::{Change, GlobalPoint, Resize, Size};
use super::gap::{Asks, Step};
use super::text::SHOWN;
use crate::model::error::surface::Surface;
use crate::model::words::{apart, different, list, number, value};

/// The cause that a change gives, where the change has been tried; the report names it first.
/// Lengths have this unit; none where it is empty.
pub(super) fn cause(change: &Change, unit: &str) -> Option<String> {
    match change {
        Change::Resize { any } if any.len() == 1 => {
            any.first().map(|only| Is { resize: only, unit }.alone())
        }
        Change::Resize { any } => {
            let all: Vec<String> =
                any.iter().map(|resize| Is { resize, unit }.to_string()).collect();
            Some(format!("One of these does not fit: {}.", all.join(", ")))
        }
        Change::Allow { .. } => Some(
            "The redundant equations are nearly consistent: their contradiction is within the accuracy of ordinary parts."
                .to_string(),
        ),
        Change::Pin { bodies: [a, b], .. } => Some(format!(
            "Only one joint holds each of `{a}` and `{b}`, and nothing drives them."
        )),
        Change::Swap { constraint, bodies: [i, j], points: [u, v] } => Some(format!(
            "The points of `{constraint}` are exchanged: in `{i}` it has {}, a point of `{j}`, and in `{j}` it has {}, a point of `{i}`.",
            Point::of(u),
            Point::of(v)
        )),
        Change::Local { points } => points.first().map(|first| {
            let others = match points.len() - 1 {
                0 => String::new(),
                more => format!(" (and {more} more)"),
            };
            format!(
                "`{}` has the global point {} in `{}`, but needs a local point{others}.",
                first.constraint,
                Point::of(&first.given),
                first.body
            )
        }),
        Change::Join { body } => Some(format!("No constraint holds `{body}`.")),
        Change::OtherEnd { constraints: [a, b], body, point } => Some(format!(
            "`{a}` and `{b}` hold the same end of `{body}`, {}, and nothing holds its other end.",
            Point::of(point)
        )),
        _ => None,
    }
}

/// "`crank 3` is 1.100 m long", with digits that tell it from the value that fits.
struct Is<'a> {
    resize: &'a Resize,
    unit: &'a str,
}

impl Is<'_> {
    /// The same where only this dimension can be at fault.
    fn alone(&self) -> String {
        let text = self.to_string();
        let (name, is) = text.rsplit_once("` is ").unwrap_or((&text, ""));
        format!("{name}` does not fit: it is {is}.")
    }
}

impl Display for Is<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let Is { resize, unit } = self;
        let [is, _] = resize.both();
        let blank = if unit.is_empty() { "" } else { " " };
        match &resize.of {
            Size::Length { body } => write!(f, "`{body}` is {is}{blank}{unit} long"),
            Size::Number { constraint, parameter } => {
                write!(f, "`{constraint}.{parameter}` is {is}")
            }
            Size::Point { constraint, body, .. } => {
                write!(f, "`{constraint}` is at {is}{blank}{unit} {}", frame(body))
            }
        }
    }
}

/// "on the ground", "in `rod`"
fn frame(body: &Option<String>) -> String {
    body.as_ref().map_or("on the ground".to_string(), |body| format!("in `{body}`"))
}

impl Resize {
    /// The present value and the one that fits, with digits that tell them apart.
    fn both(&self) -> [Point; 2] {
        apart(&self.is, &self.fits).map(Point)
    }

    /// "make `crank 3` 1.000 m long"
    fn advice(&self, unit: &str) -> String {
        let bound = match (self.exact, self.fits.first() > self.is.first()) {
            (true, _) => "",
            (false, true) => "at least ",
            (false, false) => "at most ",
        };
        let [is, fits] = self.both();
        let x = self.fits.first().copied().unwrap_or_default();
        let up = (!self.exact).then_some(self.fits.first() > self.is.first());
        let value =
            Value { x, up, digits: 4 }.apart_from(self.is.first().copied().unwrap_or_default());
        let blank = if unit.is_empty() { "" } else { " " };
        match &self.of {
            Size::Length { body } => format!("make `{body}` {bound}{value}{blank}{unit} long"),
            Size::Number { constraint, parameter } => {
                format!("make `{constraint}.{parameter}` {bound}{value}")
            }
            Size::Point { constraint, body, .. } => {
                format!("move `{constraint}` from {is} to {fits}{blank}{unit} {}", frame(body))
            }
        }
    }
}

impl Display for Resize {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(&self.advice(""))
    }
}

/// A number to so many digits; a bound is rounded to its safe side.
struct Value {
    x: f64,
    up: Option<bool>,
    digits: i32,
}

impl Value {
    /// With four digits, or as many as tell it from the present value.
    fn apart_from(self, is: f64) -> Value {
        let Value { x, up, .. } = self;
        let with = |digits: i32| Value { x, up, digits };
        let differs = |value: &Value| {
            let shown: f64 = value.to_string().parse().unwrap_or(f64::NAN);
            let share = (shown - is) / (x - is);
            share >= 0.5 && (share <= 1.5 || up.is_some())
        };
        (4..16).map(with).find(differs).unwrap_or_else(|| with(4))
    }
}

impl Display for Value {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let Value { x, digits, .. } = *self;
        let step = 10.0_f64.powf(x.abs().log10().floor() - f64::from(digits - 1));
        if !(x.is_finite() && step.is_finite() && step > 0.0) {
            return write!(f, "{}", number(x));
        }
        let rounded = match self.up {
            // A value that equals a step except for rounding stays there.
            Some(true) => (x / step - 1e-6).ceil() * step,
            Some(false) => (x / step + 1e-6).floor() * step,
            None => x,
        };
        if (1e-4..1e7).contains(&rounded.abs()) {
            let decimals = (f64::from(digits - 1) - rounded.abs().log10().floor()).max(0.0);
            let decimals = decimals as usize;
            return write!(f, "{rounded:.decimals$}");
        }
        let decimals = (digits - 1) as usize;
        write!(f, "{rounded:.decimals$e}")
    }
}

/// "(0.500, 0)", or the number alone.
struct Point(Vec<String>);

impl Point {
    fn of(point: &[f64]) -> Point {
        let [texts, _] = apart(point, point);
        Point(texts)
    }
}

impl Display for Point {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match &self.0[..] {
            [one] => f.write_str(one),
            all => write!(f, "({})", all.join(", ")),
        }
    }
}

/// A change whose lengths have a unit; none where it is empty.
pub(super) struct In<'a> {
    pub change: &'a Change,
    pub unit: &'a str,
}

impl Display for Change {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        In { change: self, unit: "" }.fmt(f)
    }
}

impl Display for In<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let surface = Surface::chosen();
        match self.change {
            Change::Remove { constraint, or } => remove(f, constraint, or),
            Change::Fit { constraint, missing, or_drop, of } => {
                fit(f, constraint, *missing, or_drop, *of)
            }
            Change::Limit { constraint, asks, or } => {
                limit(f, constraint, asks.as_ref(), (or, self.unit))
            }
            Change::Allow { misfit } => {
                let call = surface.allowed_misfit(*misfit);
                write!(f, "allow the contradiction by {call}, a fraction of the mechanism's size")
            }
            Change::Resize { any } => {
                let all: Vec<String> = any.iter().map(|one| one.advice(self.unit)).collect();
                f.write_str(&all.join(", or "))
            }
            Change::Smooth { step: Step { equation, coordinate, at, .. } } => {
                write!(
                    f,
                    "replace the jump of `{equation}` by a smooth function, or keep {coordinate} away from {}",
                    value(*at)
                )
            }
            Change::Swap { constraint, bodies: [i, j], .. } => {
                write!(
                    f,
                    "give `{constraint}` its bodies in the order of its points: first `{j}`, then `{i}`"
                )
            }
            Change::Local { points } => local(f, points),
            Change::OtherEnd { constraints: [a, b], body, .. } => {
                write!(f, "let `{a}` or `{b}` hold the other end of `{body}`")
            }
            Change::Drop { constraint, rows, instead: Some(joint) } => {
                write!(f, "make `{constraint}` {joint}, which drops {}", rows_named(rows))
            }
            Change::Drop { constraint, rows, instead: None } => {
                write!(f, "drop {} of `{constraint}`", rows_named(rows))
            }
            Change::Drive { turn: Some(body), .. } => {
                write!(f, "drive or hold the turn of `{body}`")
            }
            Change::Drive { coordinate, .. } => write!(f, "drive or hold `{coordinate}`"),
            Change::Pin { bodies: [a, b], coordinates: [x, y] } => {
                write!(f, "join `{a}` and `{b}` by a pin, or drive or hold `{x}` and `{y}`")
            }
            Change::Loosen { constraints } => {
                let all = quoted(constraints.iter().take(SHOWN));
                write!(
                    f,
                    "to let it move, replace one of {all} by a joint that holds less, and add a motor"
                )
            }
            Change::Join { body } => {
                write!(f, "join `{body}` to another body or the ground, or leave it out")
            }
            Change::HoldIdle { bodies } => {
                let all = list(bodies);
                write!(
                    f,
                    "hold the idle turn of {all} {}, or replace the body by a `distance`",
                    surface.hold_idle()
                )
            }
        }
    }
}

fn quoted<'a>(names: impl Iterator<Item = &'a String>) -> String {
    names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

fn remove(f: &mut Formatter<'_>, constraint: &str, or: &[String]) -> Result {
    write!(f, "remove `{constraint}`")?;
    if or.is_empty() {
        return Ok(());
    }
    write!(f, ", or {}", quoted(or.iter().take(SHOWN)))?;
    match or.len().saturating_sub(SHOWN) {
        0 => {}
        more => write!(f, " or {more} more")?,
    }
    f.write_str(", or replace one by a measurement")
}

fn fit(
    f: &mut Formatter<'_>,
    constraint: &str,
    missing: f64,
    or_drop: &[String],
    of: usize,
) -> Result {
    write!(
        f,
        "change a dimension so that the gap of {} at `{constraint}` closes",
        number(missing)
    )?;
    match or_drop.len() {
        0 => Ok(()),
        all if all == of => write!(f, ", or remove `{constraint}`"),
        _ => write!(f, ", or drop its {}", rows_named(or_drop)),
    }
}

fn local(f: &mut Formatter<'_>, points: &[GlobalPoint]) -> Result {
    let one = |GlobalPoint { point, constraint, local, body, .. }: &GlobalPoint| {
        format!("`{point}` of `{constraint}` the point {} of `{body}`", Point::of(local))
    };
    let all: Vec<String> = points.iter().take(SHOWN).map(one).collect();
    let call = Surface::chosen().local("local", "body", "point");
    write!(f, "give {}{call}", all.join(", "))
}

/// "keep `motor` within reach, which ends near crank.theta = 0.7638, or make `coupler` at least
/// 0.5607 m long"
fn limit(
    f: &mut Formatter<'_>,
    constraint: &str,
    asks: Option<&Asks>,
    (or, unit): (&[Resize], &str),
) -> Result {
    match asks.filter(|asks| asks.is_more_than_a_turn()) {
        Some(asks) => {
            let radians = Surface::chosen().radians(asks.asked);
            write!(
                f,
                "give `{constraint}` an angle in radians ({radians}), or keep it within reach"
            )?;
        }
        None => write!(f, "keep `{constraint}` within reach")?,
    }
    if let Some(Asks { coordinate, asked, stands, .. }) = asks {
        let [_, stands] = different(*asked, *stands);
        write!(f, ", which ends near {coordinate} = {stands}")?;
    }
    or.iter().try_for_each(|resize| write!(f, ", or {}", resize.advice(unit)))
}

/// Writes "row x", "rows x, y".
fn rows_named(rows: &[String]) -> String {
    format!("{} {}", if rows.len() == 1 { "row" } else { "rows" }, rows.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pin(is: [f64; 2], fits: [f64; 2]) -> Resize {
        let of =
            Size::Point { constraint: "T2".to_string(), parameter: "u_i".to_string(), body: None };
        Resize { of, is: is.to_vec(), fits: fits.to_vec(), exact: true }
    }

    fn length(is: f64, fits: f64, exact: bool) -> Resize {
        Resize {
            of: Size::Length { body: "rod".to_string() },
            is: vec![is],
            fits: vec![fits],
            exact,
        }
    }

    /// The present value and the one that fits never read alike, however near they are.
    #[test]
    fn advice_has_the_digits_of_its_difference() {
        let told = |resize: Resize| {
            let change = Change::Resize { any: vec![resize] };
            [cause(&change, "m").unwrap(), In { change: &change, unit: "m" }.to_string()]
        };
        assert_eq!(
            told(pin([4.0, 0.0], [4.0001, 0.0])),
            [
                "`T2` does not fit: it is at (4.0000, 0) m on the ground.",
                "move `T2` from (4.0000, 0) to (4.0001, 0) m on the ground"
            ]
        );
        assert_eq!(
            told(length(1.0 + 5e-9, 1.0, true)),
            ["`rod` does not fit: it is 1.000000005 m long.", "make `rod` 1.000 m long"]
        );
        // A bound keeps to its safe side.
        assert_eq!(
            told(length(0.1496, 0.15, false)),
            ["`rod` does not fit: it is 0.1496 m long.", "make `rod` at least 0.1500 m long"]
        );
        assert_eq!(
            told(length(6.1, 5.99964, false)),
            ["`rod` does not fit: it is 6.100 m long.", "make `rod` at most 5.999 m long"]
        );
        assert_eq!(
            told(length(0.150000012, 0.15000002366, false))[1],
            "make `rod` at least 0.1501 m long"
        );
    }
}
