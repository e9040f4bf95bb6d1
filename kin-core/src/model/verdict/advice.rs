//! Writes changes to a mechanism, and their reasons, as sentences.

use std::fmt::{Display, Formatter, Result};

use super::change::{Change, GlobalPoint, Resize, Size};
use super::gap::{Asks, Step};
use super::text::{SHOWN, number};
use crate::model::error::surface::Surface;
use crate::model::words::list;

/// Returns the cause that a tested change reveals. The report begins with it.
pub(super) fn cause(change: &Change) -> Option<String> {
    match change {
        Change::Resize { any } if any.len() == 1 => {
            any.first().map(|only| format!("does not fit: {}.", Is(only)))
        }
        Change::Resize { any } => {
            let all: Vec<String> = any.iter().map(|resize| Is(resize).to_string()).collect();
            Some(format!("one of these does not fit: {}.", all.join(", ")))
        }
        Change::Allow { misfit } => Some(format!(
            "nearly consistent: redundant equations contradict one another by no more than parts of ordinary accuracy do; {} allows it.",
            Surface::chosen().allowed_misfit(*misfit)
        )),
        Change::Pin { bodies: [a, b], .. } => Some(format!(
            "freedoms left: `{a}` and `{b}` are held by one joint each, and nothing drives them."
        )),
        Change::Swap { constraint, bodies: [i, j], points: [u, v] } => Some(format!(
            "exchanged: `{constraint}` takes {} in `{i}`, which is a point of `{j}`, and {} in `{j}`, which is one of `{i}`.",
            Point(u),
            Point(v)
        )),
        Change::Local { points } => points.first().map(|first| {
            let others = if points.len() > 1 {
                format!(" (and {} more)", points.len() - 1)
            } else {
                String::new()
            };
            format!(
                "global point: `{}` takes {} in `{}`, where a local point is wanted{others}.",
                first.constraint,
                Point(&first.given),
                first.body
            )
        }),
        Change::Join { body } => {
            Some(format!("freedom left: `{body}` is free in every way; no constraint holds it."))
        }
        Change::OtherEnd { constraints: [a, b], body, point } => Some(format!(
            "same end: `{a}` and `{b}` both hold `{body}` at {}, and nothing its other end.",
            Point(point)
        )),
        _ => None,
    }
}

/// Writes "`crank 3` is 1.100 long".
struct Is<'a>(&'a Resize);

impl Display for Is<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match &self.0.of {
            Size::Length { body } => write!(f, "`{body}` is {} long", Point(&self.0.is)),
            Size::Number { constraint, parameter } => {
                write!(f, "`{constraint}.{parameter}` is {}", Point(&self.0.is))
            }
            Size::Point { constraint, body, .. } => {
                let body =
                    body.as_ref().map_or("the ground".to_string(), |body| format!("`{body}`"));
                write!(f, "`{constraint}` is at {} of {body}", Point(&self.0.is))
            }
        }
    }
}

/// Writes "make `crank 3` 1.000 long".
impl Display for Resize {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let bound = match (self.exact, self.fits.first() > self.is.first()) {
            (true, _) => "",
            (false, true) => "at least ",
            (false, false) => "at most ",
        };
        let value = Value {
            x: self.fits.first().copied().unwrap_or_default(),
            up: (!self.exact).then_some(self.fits.first() > self.is.first()),
        };
        match &self.of {
            Size::Length { body } => write!(f, "make `{body}` {bound}{value} long"),
            Size::Number { constraint, parameter } => {
                write!(f, "make `{constraint}.{parameter}` {bound}{value}")
            }
            Size::Point { constraint, body, .. } => {
                let body =
                    body.as_ref().map_or("the ground".to_string(), |body| format!("`{body}`"));
                write!(f, "move `{constraint}` to {} of {body}", Point(&self.fits))
            }
        }
    }
}

/// A number to four digits; a bound is rounded to its safe side.
struct Value {
    x: f64,
    up: Option<bool>,
}

impl Display for Value {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let x = self.x;
        let step = 10.0_f64.powf(x.abs().log10().floor() - 3.0);
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
            let decimals = (3.0 - rounded.abs().log10().floor()).max(0.0) as usize;
            return write!(f, "{rounded:.decimals$}");
        }
        write!(f, "{rounded:.3e}")
    }
}

/// Writes "(0.500, 0.000)", or a single number.
struct Point<'a>(&'a [f64]);

impl Display for Point<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let largest = self.0.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let all: Vec<String> = self
            .0
            .iter()
            .map(|x| number(if x.abs() < 1e-6 * largest { 0.0 } else { *x }))
            .collect();
        match &all[..] {
            [one] => f.write_str(one),
            all => write!(f, "({})", all.join(", ")),
        }
    }
}

impl Display for Change {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Change::Remove { constraint, or } => remove(f, constraint, or),
            Change::Fit { constraint, missing, or_drop, of } => {
                fit(f, constraint, *missing, or_drop, *of)
            }
            Change::Limit { constraint, asks, or } => limit(f, constraint, asks.as_ref(), or),
            Change::Allow { misfit } => {
                let call = Surface::chosen().allowed_misfit(*misfit);
                write!(f, "allow it by {call}, a share of the mechanism's size")
            }
            Change::Resize { any } => {
                let all: Vec<String> = any.iter().map(ToString::to_string).collect();
                f.write_str(&all.join(", or "))
            }
            Change::Smooth { step: Step { equation, coordinate, at, .. } } => {
                write!(
                    f,
                    "put a smooth function in the place of the step of `{equation}`, or keep {coordinate} away from {at:.4}"
                )
            }
            Change::Swap { constraint, bodies: [i, j], .. } => {
                write!(
                    f,
                    "give `{constraint}` its bodies in the order of its points, first `{j}`, then `{i}`"
                )
            }
            Change::Local { points } => local(f, points),
            Change::OtherEnd { constraints: [a, b], body, .. } => {
                write!(f, "let `{a}` or `{b}` hold the other end of `{body}`")
            }
            Change::Drop { constraint, rows, instead: Some(joint) } => {
                write!(f, "make `{constraint}` {joint} (drops {})", rows_named(rows))
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
                write!(f, "for a mechanism that moves let one of {all} hold less, and add a motor")
            }
            Change::Join { body } => {
                write!(f, "join `{body}` to another body or the ground, or leave it out")
            }
            Change::HoldIdle { bodies } => hold_idle(f, bodies),
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
        "change a dimension by which `{constraint}` can be met, {} is missing",
        number(missing)
    )?;
    match or_drop.len() {
        0 => Ok(()),
        all if all == of => f.write_str(", or remove it"),
        _ => write!(f, ", or drop {} of it", rows_named(or_drop)),
    }
}

fn local(f: &mut Formatter<'_>, points: &[GlobalPoint]) -> Result {
    let one = |GlobalPoint { point, constraint, local, body, .. }: &GlobalPoint| {
        format!("`{point}` of `{constraint}` the point {} of `{body}`", Point(local))
    };
    let all: Vec<String> = points.iter().take(SHOWN).map(one).collect();
    write!(f, "give {} (`m.local(body, point)` finds them)", all.join(", "))
}

fn hold_idle(f: &mut Formatter<'_>, bodies: &[String]) -> Result {
    let all = list(bodies);
    write!(
        f,
        "hold the turn of {all} about its own axis, which moves nothing else, by `m.hold_idle_turns()`, or put a `distance` \
         in its place"
    )
}

/// Writes "let `motor` stay within reach, which ends near crank.theta = 0.7638, or make `coupler`
/// at least 0.5607 long".
fn limit(f: &mut Formatter<'_>, constraint: &str, asks: Option<&Asks>, or: &[Resize]) -> Result {
    match asks.filter(|asks| asks.is_more_than_a_turn()) {
        Some(asks) => {
            write!(
                f,
                "give `{constraint}` radians, which `deg({:.1})` makes of degrees, or let it stay within reach",
                asks.asked
            )?;
        }
        None => write!(f, "let `{constraint}` stay within reach")?,
    }
    if let Some(Asks { coordinate, stands, .. }) = asks {
        write!(f, ", which ends near {coordinate} = {stands:.4}")?;
    }
    or.iter().try_for_each(|resize| write!(f, ", or {resize}"))
}

/// Writes "row x", "rows x, y".
fn rows_named(rows: &[String]) -> String {
    format!("{} {}", if rows.len() == 1 { "row" } else { "rows" }, rows.join(", "))
}
