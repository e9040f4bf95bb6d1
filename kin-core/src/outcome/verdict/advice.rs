//! Writes changes to a mechanism, and their reasons, as sentences.

use std::fmt::{Display, Formatter, Result};

use super::change::{Change, GlobalPoint, Resize, Size};
use super::gap::{Asks, Step};
use super::text::SHOWN;
use crate::outcome::error::surface::Surface;
use crate::outcome::words::{
    apart, different, joined, list, number, of_coordinate, value, with_unit,
};

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
            Some(format!("One of these dimensions does not fit: {}.", joined(&all, "or")))
        }
        Change::Allow { .. } => Some(
            "The redundant equations contradict each other by less than the accuracy of ordinary parts."
                .to_string(),
        ),
        Change::Pin { bodies: [a, b], .. } => Some(format!(
            "Only one joint holds each of `{a}` and `{b}`, and nothing drives `{a}` or `{b}`."
        )),
        Change::Swap { constraint, bodies: [i, j], points: [u, v] } => Some(format!(
            "The points of `{constraint}` are exchanged: {}{} belongs to the frame of `{j}`, not of `{i}`, and {}{} to the frame of `{i}`, not of `{j}`.",
            Point::of(u),
            after(unit),
            Point::of(v),
            after(unit)
        )),
        Change::Local { points } => points.first().map(|first| {
            let others = match points.len() - 1 {
                0 => String::new(),
                1 => " (and so does 1 more point)".to_string(),
                more => format!(" (and so do {more} more points)"),
            };
            format!(
                "`{}` has the global point {}{} for `{body}`, but needs a point in the frame of `{body}`{others}.",
                first.constraint,
                Point::of(&first.given),
                after(unit),
                body = first.body
            )
        }),
        Change::Join { body } => Some(format!("No constraint holds `{body}`.")),
        Change::OtherEnd { constraints: [a, b], body, point } => Some(format!(
            "`{a}` and `{b}` hold the same end of `{body}`, at {}{} in the frame of `{body}`. Nothing holds the other end of `{body}`.",
            Point::of(point),
            after(unit)
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
        format!("{self} and does not fit.")
    }
}

impl Display for Is<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let Is { resize, unit } = self;
        let [is, _] = resize.both();
        let unit = after(unit);
        match &resize.of {
            Size::Length { body } => write!(f, "`{body}` is {is}{unit} long"),
            Size::Number { constraint, parameter } => {
                let is = with_unit(&is.to_string(), unit_of(parameter, self.unit));
                write!(f, "`{constraint}.{parameter}` is {is}")
            }
            Size::Point { constraint, body, .. } => {
                write!(f, "`{constraint}` is at {is}{unit} {}", frame(body))
            }
        }
    }
}

/// The unit behind a number, with a blank; nothing if it has no name.
fn after(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" {unit}") }
}

/// The unit of a parameter that is a length or an angle by its name, as in the joints of the
/// library. Lengths have this unit; if it is empty, no number has a unit.
fn unit_of<'a>(parameter: &str, unit: &'a str) -> &'a str {
    const LENGTHS: [&str; 4] = ["length", "distance", "offset", "radius"];
    const ANGLES: [&str; 4] = ["angle", "theta", "phi", "phase"];
    let of = |all: &[&str]| {
        let starts = |one: &&str| parameter.strip_prefix(one).is_some_and(is_end);
        all.iter().any(starts)
    };
    match (unit.is_empty(), of(&LENGTHS), of(&ANGLES)) {
        (false, true, _) => unit,
        (false, _, true) => "rad",
        _ => "",
    }
}

/// True for the end of a name behind its word: nothing, or the argument, as in `radius_i`.
fn is_end(rest: &str) -> bool {
    rest.is_empty() || rest.starts_with('_')
}

/// "on the ground", "in the frame of `rod`"
fn frame(body: &Option<String>) -> String {
    body.as_ref().map_or("on the ground".to_string(), |body| format!("in the frame of `{body}`"))
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
        let behind = after(unit);
        match &self.of {
            Size::Length { body } => format!("make `{body}` {bound}{value}{behind} long"),
            Size::Number { constraint, parameter } => {
                let value = with_unit(&value.to_string(), unit_of(parameter, unit));
                format!("make `{constraint}.{parameter}` {bound}{value}")
            }
            Size::Point { constraint, body, .. } => {
                format!("move `{constraint}` from {is} to {fits}{behind} {}", frame(body))
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
    /// The unit of the gap that the change closes; empty if the gap is no length.
    pub gap: &'a str,
}

impl Display for Change {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        In { change: self, unit: "", gap: "" }.fmt(f)
    }
}

impl Display for In<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let surface = Surface::chosen();
        match self.change {
            Change::Remove { constraint, or } => remove(f, constraint, or),
            Change::Fit { constraint, missing, or_drop, of } => {
                fit(f, constraint, &Gap { missing: *missing, unit: self.gap }, or_drop, *of)
            }
            Change::Limit { constraint, asks, or } => {
                limit(f, constraint, asks.as_ref(), (or, self.unit))
            }
            Change::Allow { misfit } => {
                let call = surface.allowed_misfit(*misfit);
                write!(
                    f,
                    "allow the contradiction of the equations by {call}, where the number is a fraction of the mechanism's size"
                )
            }
            Change::Resize { any } => {
                let all: Vec<String> = any.iter().map(|one| one.advice(self.unit)).collect();
                f.write_str(&all.join(", or "))
            }
            Change::Smooth { step: Step { equation, coordinate, at, .. } } => {
                write!(
                    f,
                    "replace the jump of `{equation}` by a smooth function, or keep {coordinate} away from {}{}",
                    value(*at),
                    of_coordinate(coordinate, self.unit)
                )
            }
            Change::Swap { constraint, bodies: [i, j], .. } => {
                write!(
                    f,
                    "give the bodies of `{constraint}` in the order of the points: first `{j}`, then `{i}`"
                )
            }
            Change::Local { points } => local(f, points, self.unit),
            Change::OtherEnd { constraints: [a, b], body, .. } => {
                write!(f, "let `{a}` or `{b}` hold the other end of `{body}`")
            }
            Change::Drop { constraint, rows, instead: Some(joint) } => {
                write!(f, "replace `{constraint}` by {joint}, which has no {}", rows_named(rows))
            }
            Change::Drop { constraint, rows, instead: None } => {
                write!(f, "remove {} of `{constraint}`", rows_named(rows))
            }
            Change::Drive { turn: Some(body), .. } => {
                write!(f, "drive or hold the rotation of `{body}`")
            }
            Change::Drive { coordinate, .. } => write!(f, "drive or hold `{coordinate}`"),
            Change::Pin { bodies: [a, b], coordinates: [x, y] } => {
                write!(f, "join `{a}` and `{b}` by a pin, or drive or hold `{x}` and `{y}`")
            }
            Change::Loosen { constraints } => {
                let all = joined(&quoted(constraints.iter().take(SHOWN)), "or");
                write!(
                    f,
                    "to let the mechanism move, replace one of the joints {all} by a joint with fewer rows, and add a motor"
                )
            }
            Change::Join { body } => {
                write!(f, "join `{body}` to another body or the ground, or remove `{body}`")
            }
            Change::HoldIdle { bodies } => {
                let all = list(bodies);
                write!(
                    f,
                    "hold the idle rotation of {all} {}, or replace {one} by a `distance`",
                    surface.hold_idle(),
                    one = if bodies.len() == 1 { all.as_str() } else { "the bodies" }
                )
            }
        }
    }
}

fn quoted<'a>(names: impl Iterator<Item = &'a String>) -> Vec<String> {
    names.map(|name| format!("`{name}`")).collect()
}

fn remove(f: &mut Formatter<'_>, constraint: &str, or: &[String]) -> Result {
    if or.is_empty() {
        return write!(f, "remove `{constraint}`");
    }
    let mut all = vec![format!("`{constraint}`")];
    all.extend(quoted(or.iter().take(SHOWN)));
    match or.len().saturating_sub(SHOWN) {
        0 => {}
        1 => all.push("1 more constraint".to_string()),
        more => all.push(format!("{more} more constraints")),
    }
    write!(f, "remove {}, or replace one of these constraints by a measurement", joined(&all, "or"))
}

/// The gap of a joint; without unit if its rows are no lengths.
struct Gap<'a> {
    missing: f64,
    unit: &'a str,
}

fn fit(
    f: &mut Formatter<'_>,
    constraint: &str,
    gap: &Gap<'_>,
    or_drop: &[String],
    of: usize,
) -> Result {
    write!(
        f,
        "change a dimension so that the gap of {}{} at `{constraint}` closes",
        number(gap.missing),
        after(gap.unit)
    )?;
    match or_drop.len() {
        0 => Ok(()),
        all if all == of => write!(f, ", or remove `{constraint}`"),
        _ => write!(f, ", or remove {} of `{constraint}`", rows_named(or_drop)),
    }
}

fn local(f: &mut Formatter<'_>, points: &[GlobalPoint], unit: &str) -> Result {
    let one = |GlobalPoint { point, constraint, local, body, .. }: &GlobalPoint| {
        let local = Point::of(local);
        format!("`{point}` of `{constraint}` the point {local}{} of `{body}`", after(unit))
    };
    let all: Vec<String> = points.iter().take(SHOWN).map(one).collect();
    let call = Surface::chosen().local("local", "body", "point");
    write!(f, "give {}{call}", joined(&all, "and"))
}

/// "keep crank.theta, which `motor` drives, below about 0.7638 rad, or make `coupler` at least
/// 0.5607 m long"
fn limit(
    f: &mut Formatter<'_>,
    constraint: &str,
    asks: Option<&Asks>,
    (or, unit): (&[Resize], &str),
) -> Result {
    if let Some(asks) = asks.filter(|asks| asks.is_more_than_a_turn()) {
        let radians = Surface::chosen().radians(asks.asked);
        write!(f, "give `{constraint}` an angle in radians ({radians}), or ")?;
    }
    match asks {
        Some(asks) => {
            let coordinate = &asks.coordinate;
            let side = if asks.asked > asks.stands { "below" } else { "above" };
            let [_, stands] = different(asks.asked, asks.stands);
            let stands = asks.with_unit(&stands);
            write!(f, "keep {coordinate}, which `{constraint}` drives, {side} about {stands}")?;
        }
        None => write!(f, "keep `{constraint}` within reach")?,
    }
    or.iter().try_for_each(|resize| write!(f, ", or {}", resize.advice(unit)))
}

/// Writes "row x", "rows x and y".
fn rows_named(rows: &[String]) -> String {
    format!("{} {}", if rows.len() == 1 { "row" } else { "rows" }, joined(rows, "and"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pin(is: [f64; 2], fits: [f64; 2]) -> Resize {
        let of =
            Size::Point { constraint: "T2".to_string(), parameter: "u_i".to_string(), body: None };
        Resize { of, is: is.to_vec(), fits: fits.to_vec(), exact: true }
    }

    #[test]
    fn numbers_of_constraints_have_their_unit_where_it_is_known() {
        let number = |parameter: &str| Resize {
            of: Size::Number { constraint: "rod".to_string(), parameter: parameter.to_string() },
            is: vec![0.1],
            fits: vec![0.6563],
            exact: true,
        };
        for (parameter, unit, told) in [
            ("length", "mm", "`rod.length` is 0.100 mm and does not fit."),
            ("radius_i", "m", "`rod.radius_i` is 0.100 m and does not fit."),
            ("angle", "mm", "`rod.angle` is 0.100 rad and does not fit."),
            ("k", "m", "`rod.k` is 0.100 and does not fit."),
            ("lengths", "m", "`rod.lengths` is 0.100 and does not fit."),
            ("length", "", "`rod.length` is 0.100 and does not fit."),
        ] {
            let change = Change::Resize { any: vec![number(parameter)] };
            assert_eq!(cause(&change, unit).as_deref(), Some(told));
        }
        assert_eq!(number("length").advice("m"), "make `rod.length` 0.6563 m");
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
            [cause(&change, "m").unwrap(), In { change: &change, unit: "m", gap: "" }.to_string()]
        };
        assert_eq!(
            told(pin([4.0, 0.0], [4.0001, 0.0])),
            [
                "`T2` is at (4.0000, 0) m on the ground and does not fit.",
                "move `T2` from (4.0000, 0) to (4.0001, 0) m on the ground"
            ]
        );
        assert_eq!(
            told(length(1.0 + 5e-9, 1.0, true)),
            ["`rod` is 1.000000005 m long and does not fit.", "make `rod` 1.000 m long"]
        );
        // A bound keeps to its safe side.
        assert_eq!(
            told(length(0.1496, 0.15, false)),
            ["`rod` is 0.1496 m long and does not fit.", "make `rod` at least 0.1500 m long"]
        );
        assert_eq!(
            told(length(6.1, 5.99964, false)),
            ["`rod` is 6.100 m long and does not fit.", "make `rod` at most 5.999 m long"]
        );
        assert_eq!(
            told(length(0.150000012, 0.15000002366, false))[1],
            "make `rod` at least 0.1501 m long"
        );
    }
}
