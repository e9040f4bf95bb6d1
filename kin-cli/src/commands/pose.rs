//! `kin pose`: the position at given values of drivers.

use kin::solver::{Configuration, NamedValue};
use kin::{Error, SolverOptions};
use kin_view::Scene;
use serde_json::{Value, json};

use crate::arguments::Pose;
use crate::fault::Fault;
use crate::output::{digits, put, table};
use crate::say::Say;
use crate::{model, output};

/// Moves the drivers to the values of the command line and writes the position there. Where a
/// singular position is on the way, the position there is written.
pub fn pose(asked: &Pose, say: &Say) -> Result<(), Fault> {
    let system = model::system(&asked.model)?;
    let options = SolverOptions::new().allowed_misfit(asked.misfit.share);
    let mut follower = system.solver().options(options).follower(asked.at)?;
    let is_given = !asked.given.is_empty();
    if is_given {
        let names = asked.given.iter().map(|setting| &setting.name);
        follower = follower.given(names).map_err(Fault::asked)?;
    }
    let values = asked.to.iter().chain(&asked.given).map(|setting| (&setting.name, setting.value));
    let mut proof = None;
    let moved = match asked.prove {
        Some(steps) => follower.prove_to(values, steps).map(|found| proof = Some(found)),
        None => follower.to(values).map(|_| ()),
    };
    let stopped = match moved {
        Ok(()) => None,
        Err(error @ Error::CannotReach(_)) => Some(Fault::Early(Box::new(error))),
        Err(error) => return Err(Fault::asked(error)),
    };
    if !follower.frozen().is_empty() {
        let names = follower.frozen().join("`, `");
        let time = system.unit_words().time();
        say.note(&format!("time stands at {} {time} in `{names}`", asked.at));
    }
    let here = follower.here();
    let all = rows(&system, here, is_given)?;
    if let Some(to) = &asked.json {
        put(to, |to| {
            serde_json::to_writer(&mut *to, &as_json(&all))?;
            to.write_all(b"\n")
        })?;
    }
    if let Some(to) = &asked.svg {
        let picture = Scene::new(&system).pose(&here.motion(), 0.0)?;
        output::put(to, |to| to.write_all(picture.svg().as_bytes()))?;
    }
    let header = ["what", "name", "value", "unit"].map(str::to_string);
    let cells = |row: &Row| {
        vec![row.what.to_string(), row.name.clone(), digits(row.value), row.unit.clone()]
    };
    table(&asked.csv, &header, all.iter().map(cells))?;
    match proof {
        Some(proof) if !proof.is_complete() => Err(Fault::NotProved(proof.to_string())),
        proof => {
            proof.into_iter().for_each(|proof| say.note(&proof.to_string()));
            stopped.map_or(Ok(()), Err)
        }
    }
}

/// One number of a configuration.
struct Row {
    what: &'static str,
    name: String,
    value: f64,
    unit: String,
}

/// All numbers of a configuration: given values, drivers, coordinates, measures of joints.
fn rows(system: &kin::System, here: Configuration<'_>, is_given: bool) -> Result<Vec<Row>, Fault> {
    let named = |what: &'static str| {
        move |one: NamedValue| Row {
            what,
            name: one.name,
            value: one.value,
            unit: one.unit.unwrap_or_default(),
        }
    };
    let moved = if is_given { "given" } else { "driver" };
    let mut rows: Vec<Row> = here.drivers().into_iter().map(named(moved)).collect();
    rows.extend(here.left_out().into_iter().map(named("driver")));
    let names = system.coordinate_names().iter().zip(system.coordinate_units());
    rows.extend(names.zip(here.q()).map(|((name, unit), value)| Row {
        what: "coordinate",
        name: name.clone(),
        value: *value,
        unit,
    }));
    rows.extend(here.measures()?.into_iter().map(named("measure")));
    Ok(rows)
}

fn as_json(rows: &[Row]) -> Value {
    let part = |what: &str| -> Value {
        let own = rows.iter().filter(|row| row.what == what);
        own.map(|row| (row.name.clone(), json!(row.value))).collect()
    };
    json!({
        "given": part("given"),
        "drivers": part("driver"),
        "coordinates": part("coordinate"),
        "measures": part("measure"),
    })
}
