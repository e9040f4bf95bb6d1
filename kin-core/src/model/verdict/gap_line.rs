//! Writes the line of a report about a constraint that cannot be satisfied.

use std::fmt::{Display, Formatter, Result};

use super::diagnosis::Diagnosis;
use super::gap::{Against, Gap, Step};
use super::text::{SHOWN, number};
use crate::model::words::list;

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
        let with = match others.is_empty() {
            true => "with all others met".to_string(),
            false => format!("with {}", self.named(&others)),
        };
        let name = &gap.constraint;
        // Near a step there may be a solution that the search does not find.
        let (what, cannot) = match (gap.lasting, gap.steps.is_empty()) {
            (true, _) => ("contradictory", "cannot be"),
            (false, true) => ("out of reach", "cannot be"),
            (false, false) => ("beside a step", "is not"),
        };
        match &gap.asks {
            Some(asks) => {
                let coordinate = &asks.coordinate;
                let [asked, stands] = different(asks.asked, asks.stands);
                let turn = if asks.is_more_than_a_turn() {
                    ", more than a turn from its guess"
                } else {
                    ""
                };
                write!(
                    f,
                    "{what}: `{name}` asks for {coordinate} = {asked}{turn}; {with} it stands at {stands}."
                )
            }
            None => {
                let least = if gap.can_jump { "" } else { " at the least" };
                write!(
                    f,
                    "{what}: `{name}` {cannot} met; {with} it is off by {}{least}.",
                    number(gap.size())
                )
            }
        }?;
        gap.steps.iter().try_for_each(|step| write!(f, " {step}"))?;
        match gap.starts {
            0 | 1 => Ok(()),
            starts => write!(f, " (The nearest of {starts} starts.)"),
        }
    }
}

/// Writes "`stair` jumps at x = 1.0000, from −0.400 to 0.600."
impl Display for Step {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let Step { equation, coordinate, at, from, to, .. } = self;
        let [from, to] = [from, to].map(|x| number(*x));
        write!(f, "`{equation}` jumps at {coordinate} = {at:.4}, from {from} to {to}.")
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
                    format!("`{constraint}` ({} = {:.4}{turn})", asks.coordinate, asks.asked)
                }
                None => format!("`{constraint}`"),
            });
        let drivers: Vec<String> = drivers.collect();
        let others: Vec<String> =
            names.iter().filter(|name| asks(name).is_none()).cloned().collect();
        let others = if others.is_empty() { None } else { Some(list(&others)) };
        let more = drivers.len().saturating_sub(SHOWN);
        let more = (more > 0).then(|| format!("{more} more"));
        drivers.into_iter().take(SHOWN).chain(more).chain(others).collect::<Vec<_>>().join(", ")
    }
}

/// Writes two numbers with enough decimals to distinguish them, at least four.
fn different(a: f64, b: f64) -> [String; 2] {
    let with = |decimals: usize| [format!("{a:.decimals$}"), format!("{b:.decimals$}")];
    (4..12).map(with).find(|[a, b]| a != b).unwrap_or_else(|| with(12))
}
