//! `kin map`: wanted values at given ones, with their slopes.

use kin::solver::{Mapped, NamedValue};
use serde_json::{Value, json};

use crate::arguments::Map;
use crate::fault::Fault;
use crate::model;
use crate::output::{digits, put, table};
use crate::say::Say;

/// Moves the given values to those of the command line and writes the wanted values there, with
/// their slopes; and, if ranges are given, all values along their border.
pub fn map(asked: &Map, say: &Say) -> Result<(), Fault> {
    let system = model::system(&asked.model)?;
    let given = asked.given.iter().map(|given| &given.name);
    let follower = system.follower(asked.at)?;
    let mut map = follower.map(given, &asked.wanted).map_err(Fault::asked)?;
    let values = asked.given.iter().filter_map(|given| Some((&given.name, given.value?)));
    let here = map.to(values).map_err(Fault::asked)?;
    for frozen in follower.frozen() {
        let time = system.unit_words().time();
        say.note(&format!("time stands at {} {time} in `{frozen}`", asked.at));
    }
    if let Some(to) = &asked.json {
        put(to, |to| {
            serde_json::to_writer(&mut *to, &as_json(&here))?;
            to.write_all(b"\n")
        })?;
    }
    let by = here.given().iter().map(|one| format!("by {}", titled(one)));
    let header: Vec<String> =
        ["name", "value", "unit"].map(str::to_string).into_iter().chain(by).collect();
    let rows = here.wanted().iter().enumerate().map(|(k, one)| {
        let unit = one.unit.clone().unwrap_or_default();
        let slopes = here.jacobian().row(k).iter().map(|slope| digits(*slope)).collect::<Vec<_>>();
        [one.name.clone(), digits(one.value), unit].into_iter().chain(slopes).collect()
    });
    table(&asked.csv, &header, rows)?;
    if let Some(to) = &asked.border {
        let ranges = asked.ranges.iter().map(|range| (&range.name, range.ends));
        let border = map.border(ranges, asked.points).map_err(Fault::asked)?;
        let header: Vec<String> = here.given().iter().chain(here.wanted()).map(titled).collect();
        let row = |one: &Mapped| {
            one.given().iter().chain(one.wanted()).map(|one| digits(one.value)).collect()
        };
        table(to, &header, border.iter().map(row))?;
    }
    Ok(())
}

/// A name with its unit.
fn titled(one: &NamedValue) -> String {
    match &one.unit {
        Some(unit) => format!("{} [{unit}]", one.name),
        None => one.name.clone(),
    }
}

fn as_json(here: &Mapped) -> Value {
    let part = |all: &[NamedValue]| -> Value {
        all.iter().map(|one| (one.name.clone(), json!(one.value))).collect()
    };
    let slopes = |k: usize| -> Value {
        let row = here.jacobian().row(k);
        let named = here.given().iter().zip(row.iter());
        named.map(|(one, slope)| (one.name.clone(), json!(slope))).collect()
    };
    let wanted = here.wanted().iter().enumerate();
    let jacobian: Value = wanted.map(|(k, one)| (one.name.clone(), slopes(k))).collect();
    json!({ "given": part(here.given()), "wanted": part(here.wanted()), "jacobian": jacobian })
}
