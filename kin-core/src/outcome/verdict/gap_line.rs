//! Writes the line of a report about a constraint that cannot be satisfied.

use std::fmt::{Display, Formatter, Result};

use super::diagnosis::Diagnosis;
use super::gap::{Against, Asks, Gap, Step};
use super::text::SHOWN;
use crate::outcome::words::{apart, capital, different, joined, number, of_coordinate, value};

/// The largest number of constraints other than drivers in a list.
const NAMED: usize = 8;

/// Residuals below this part of the largest one are left out. \[-\]
const SMALL: f64 = 1e-2;

/// A gap, with the constraints that conflict with it.
pub(super) struct GapLine<'a>(pub &'a Gap, pub &'a Diagnosis);

impl Display for GapLine<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let GapLine(gap, diagnosis) = self;
        let sets = diagnosis
            .dependencies
            .iter()
            .filter(|found| found.terms.iter().any(|term| gap.rows.contains(&term.row)));
        let mut others: Vec<String> = Vec::new();
        for name in
            sets.flat_map(|found| found.constraints()).filter(|name| *name != gap.constraint)
        {
            if !others.iter().any(|known| known == name) {
                others.push(name.to_string());
            }
        }
        let name = &gap.constraint;
        let starts = match gap.starts {
            0 | 1 => String::new(),
            starts => format!(" (search from {starts} starting poses)"),
        };
        let others = match others.is_empty() {
            true => "all other constraints".to_string(),
            false => self.named(&others),
        };
        // Beside a step a solution may be near that no search finds.
        let (why, with) = match (gap.lasting, gap.steps.is_empty()) {
            (true, _) => (format!("contradicts {others}"), String::new()),
            (false, true) => ("is out of reach".to_string(), format!("with {others} satisfied, ")),
            (false, false) => {
                ("is not satisfied at this pose".to_string(), format!("with {others} satisfied, "))
            }
        };
        let length = diagnosis.units.length();
        let (requires, rest) = match &gap.asks {
            Some(asks) => {
                let coordinate = &asks.coordinate;
                let [asked, stands] =
                    different(asks.asked, asks.stands).map(|number| asks.with_unit(&number));
                let turn = beyond_a_turn(asks);
                (
                    format!("requires {coordinate} = {asked}{turn}, which "),
                    format!("the nearest value of {coordinate} that Kin found is {stands}"),
                )
            }
            None if gap.is_between_points() => {
                let size = number(gap.size());
                let smallest = format!("the smallest gap that Kin found at `{name}`");
                (String::new(), format!("{smallest} is {size} {length}"))
            }
            None => (String::new(), residual(gap, length)),
        };
        let rest = capital(&format!("{with}{rest}"));
        write!(f, "`{name}` {requires}{why}. {rest}{starts}.")?;
        gap.steps.iter().try_for_each(|step| write!(f, " {step}"))
    }
}

/// Writes "the smallest residual that Kin found for `guide` is 0.0200 m in the equation `guide.2`";
/// residuals of different units are one after the other.
fn residual(gap: &Gap, length: &str) -> String {
    let name = &gap.constraint;
    let largest = gap.residual.iter().fold(0.0_f64, |largest, c| largest.max(c.abs()));
    let shown: Vec<usize> =
        (0..gap.residual.len()).filter(|k| gap.residual[*k].abs() > SMALL * largest).collect();
    let unit = |k: usize| gap.row_units.get(k).and_then(Option::as_deref);
    let of = |k: usize| {
        let equation = gap.equations.get(k).map_or(name, |equation| equation);
        format!(
            "{} in the equation `{equation}`",
            with_unit(gap.residual[k].abs(), unit(k), length)
        )
    };
    match &shown[..] {
        [only] if gap.residual.len() > 1 => {
            format!("the smallest residual that Kin found for `{name}` is {}", of(*only))
        }
        [first, others @ ..] if others.iter().any(|k| unit(*k) != unit(*first)) => {
            let all: Vec<String> = shown.iter().map(|k| of(*k)).collect();
            format!(
                "the smallest residuals that Kin found for `{name}` are {}",
                joined(&all, "and")
            )
        }
        all => {
            let unit = all.first().and_then(|k| unit(*k));
            let size = with_unit(gap.size(), unit, length);
            format!("the smallest residual that Kin found for `{name}` is {size}")
        }
    }
}

/// Writes "0.0200 m". `unit` is that of the documentation of the constraint.
fn with_unit(x: f64, unit: Option<&str>, length: &str) -> String {
    let x = number(x);
    match unit {
        Some("m") => format!("{x} {length}"),
        Some("rad") => format!("{x} rad"),
        Some("-" | "–") => format!("{x} (without unit)"),
        _ => format!("{x} (in the unit of this equation)"),
    }
}

/// Says that a driver requires an angle that is more than a turn from its guess.
fn beyond_a_turn(asks: &Asks) -> &'static str {
    if asks.is_more_than_a_turn() { " (more than a turn from its guess)" } else { "" }
}

/// Writes "`stair` jumps at x = 1.0000, from −0.400 to 0.600."
impl Display for Step {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let Step { equation, coordinate, at, from, to, .. } = self;
        let [from, to] = apart(&[*from], &[*to]).map(|one| one.concat());
        let unit = of_coordinate(coordinate, "");
        write!(f, "`{equation}` jumps from {from} to {to} at {coordinate} = {}{unit}.", value(*at))
    }
}

impl GapLine<'_> {
    /// Writes "`motor` (crank.theta = 1.0000), `O` and `A`": drivers first, with their values.
    fn named(&self, names: &[String]) -> String {
        let asks =
            |name: &String| self.0.against.iter().find(|against| against.constraint == *name);
        let drivers =
            names.iter().filter_map(asks).map(|Against { constraint, asks }| match asks {
                Some(asks) => {
                    let turn = if asks.is_more_than_a_turn() {
                        ", more than a turn from its guess"
                    } else {
                        ""
                    };
                    format!(
                        "`{constraint}` ({} = {}{turn})",
                        asks.coordinate,
                        asks.with_unit(&value(asks.asked))
                    )
                }
                None => format!("`{constraint}`"),
            });
        let drivers: Vec<String> = drivers.collect();
        let others: Vec<String> = names
            .iter()
            .filter(|name| asks(name).is_none())
            .map(|name| format!("`{name}`"))
            .collect();
        let more = |count: usize, what: &str| (count > 0).then(|| format!("{count} {what}"));
        let more_drivers = more(drivers.len().saturating_sub(SHOWN), "more drivers");
        let more_others = more(others.len().saturating_sub(NAMED), "more constraints");
        let drivers = drivers.into_iter().take(SHOWN).chain(more_drivers);
        let others = others.into_iter().take(NAMED).chain(more_others);
        joined(&drivers.chain(others).collect::<Vec<_>>(), "and")
    }
}
