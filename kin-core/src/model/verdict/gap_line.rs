//! Writes the line of a report about a constraint that cannot be satisfied.

use std::fmt::{Display, Formatter, Result};

use super::diagnosis::Diagnosis;
use super::gap::{Against, Asks, Gap, Step};
use super::text::SHOWN;
use crate::model::words::{apart, capital, different, list, number, of_coordinate, value};

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
            starts => format!(" (Kin searched from {starts} starting poses)"),
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
                ("is not satisfied here".to_string(), format!("with {others} satisfied, "))
            }
        };
        let length = diagnosis.units.length();
        let least = if gap.can_jump { "" } else { "at least " };
        let size = number(gap.size());
        let (requires, rest) = match &gap.asks {
            Some(asks) => {
                let coordinate = &asks.coordinate;
                let [asked, stands] = different(asks.asked, asks.stands);
                let unit = of_coordinate(coordinate, length);
                let turn = beyond_a_turn(asks);
                (
                    format!("requires {coordinate} = {asked}{unit}{turn}, which "),
                    format!("the nearest value of {coordinate} is {stands}{unit}"),
                )
            }
            None if gap.is_between_points() => {
                (String::new(), format!("a gap of {least}{size} {length} remains at `{name}`"))
            }
            None => (String::new(), format!("the residual of `{name}` is {least}{size}")),
        };
        let rest = capital(&format!("{with}{rest}"));
        write!(f, "`{name}` {requires}{why}. {rest}{starts}.")?;
        gap.steps.iter().try_for_each(|step| write!(f, " {step}"))
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
    /// Writes "`motor` (crank.theta = 1.0000), `O`, `A`": drivers first, with their values.
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
                    let coordinate = &asks.coordinate;
                    let unit = of_coordinate(coordinate, self.1.units.length());
                    format!("`{constraint}` ({coordinate} = {}{unit}{turn})", value(asks.asked))
                }
                None => format!("`{constraint}`"),
            });
        let drivers: Vec<String> = drivers.collect();
        let others: Vec<String> =
            names.iter().filter(|name| asks(name).is_none()).cloned().collect();
        let others = if others.is_empty() { None } else { Some(list(&others)) };
        let more = drivers.len().saturating_sub(SHOWN);
        let more = (more > 0).then(|| format!("{more} more drivers"));
        drivers.into_iter().take(SHOWN).chain(more).chain(others).collect::<Vec<_>>().join(", ")
    }
}
