//! Combines many redundant equations of one constraint to one line.

use std::fmt::{Display, Formatter, Result};

use super::dependency::{Class, Dependency};
use crate::outcome::words::list;

/// A constraint that repeats others in more equations than this gets one line for all of them.
const MANY: usize = 2;

/// A line of the report.
pub(super) enum Line<'a> {
    One(&'a Dependency),
    Many(Vec<&'a Dependency>),
}

/// Returns the dependencies in order. Those of a constraint with many repeated equations share a
/// line.
pub(super) fn gathered<'a>(all: &[&'a Dependency]) -> Vec<Line<'a>> {
    let own = |found: &Dependency| {
        found
            .terms
            .first()
            .map(|term| term.constraint.clone())
            .filter(|_| found.class == Class::Redundant)
    };
    let mut lines: Vec<Line<'a>> = Vec::new();
    let mut done: Vec<String> = Vec::new();
    for &found in all {
        let Some(name) = own(found) else {
            lines.push(Line::One(found));
            continue;
        };
        if done.contains(&name) {
            continue;
        }
        let same: Vec<&Dependency> =
            all.iter().copied().filter(|other| own(other).as_ref() == Some(&name)).collect();
        if same.len() > MANY {
            lines.push(Line::Many(same));
            done.push(name);
        } else {
            lines.push(Line::One(found));
        }
    }
    lines
}

impl Display for Line<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let all = match self {
            Line::One(found) => return found.fmt(f),
            Line::Many(all) => all,
        };
        let mut others: Vec<String> = Vec::new();
        for name in all.iter().flat_map(|found| found.constraints().into_iter().skip(1)) {
            if !others.iter().any(|known| known == name) {
                others.push(name.to_string());
            }
        }
        let mut equations: Vec<(usize, String)> = all
            .iter()
            .filter_map(|found| found.terms.first())
            .map(|term| (term.row, term.equation.clone()))
            .collect();
        equations.sort_unstable();
        let equations: Vec<String> = equations.into_iter().map(|(_, name)| name).collect();
        write!(
            f,
            "{} are redundant but consistent: these equations repeat the equations of {}.",
            list(&equations),
            list(&others)
        )
    }
}
