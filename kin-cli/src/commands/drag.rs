//! `kin drag`: the position with the drivers released, moved by wishes.

use kin::error::FailureKind;
use kin::solver::{Reached, Released, Wish};
use kin_view::Scene;
use serde_json::{Value, json};

use crate::arguments::{Drag, Model};
use crate::fault::Fault;
use crate::model;
use crate::output::{digits, put, table};
use crate::say::Say;

/// Moves the mechanism by the wishes of the command line and writes the position there.
pub fn drag(asked: &Drag, say: &Say) -> Result<(), Fault> {
    let mut released = released(&asked.model, asked.at)?;
    if asked.points.is_empty() && asked.wishes.is_empty() {
        let names = released.freedoms().join("`, `");
        return Err(Fault::Usage(format!(
            "nothing moves the mechanism, whose freedoms are `{names}`. Give `--point` or `--wish`"
        )));
    }
    let points =
        asked.points.iter().map(|pull| Wish::point_of(&pull.body, &pull.local, &pull.target));
    let values = asked.wishes.iter().map(|wish| Wish::measure(&wish.name, wish.value));
    let holds = asked.holds.iter().map(|name| Wish::hold(name));
    let wishes: Vec<Wish> = points
        .chain(values.map(|wish| wish.priority(1)))
        .chain(holds.map(|wish| wish.priority(2)))
        .collect();
    let reached = released.reach(wishes).map_err(Fault::asked)?;
    for wish in reached.wishes.iter().filter(|wish| !wish.is_met) {
        say.note(&wish.to_string());
    }
    for name in &reached.limits {
        say.note(&format!("`{name}` is at the end of its limits"));
    }
    if !reached.freedoms.is_empty() {
        say.note(&format!("free to move: `{}`", reached.freedoms.join("`, `")));
    }
    if let Some(to) = &asked.json {
        let found = as_json(&released, &reached)?;
        put(to, |to| {
            serde_json::to_writer(&mut *to, &found)?;
            to.write_all(b"\n")
        })?;
    }
    if let Some(to) = &asked.svg {
        let picture = Scene::new(released.system()).pose(&released.motion(), 0.0)?;
        put(to, |to| to.write_all(picture.svg().as_bytes()))?;
    }
    let header = ["what", "name", "value", "unit"].map(str::to_string);
    table(&asked.csv, &header, rows(&released, &reached)?.into_iter())
}

/// The mechanism of a file with its drivers released. Of one with too few equations only parameters
/// can be set.
fn released(asked: &Model, at: f64) -> Result<Released, Fault> {
    let mechanism = model::mechanism(&asked.file)?;
    match mechanism.clone().build() {
        Ok(_) => Ok(model::system(asked)?.released(at)?),
        Err(error) if matches!(error.kind(), Some(FailureKind::CannotBeDriven)) => {
            let mut released = mechanism.released(at)?;
            for setting in &asked.settings {
                released.set(&setting.name, setting.value).map_err(Fault::asked)?;
            }
            Ok(released)
        }
        Err(error) => Err(error.into()),
    }
}

/// The numbers of the position: how far wishes are missed, coordinates, measures of joints.
fn rows(released: &Released, reached: &Reached) -> Result<Vec<Vec<String>>, Fault> {
    let row = |what: &str, name: &str, value: f64, unit: &str| {
        vec![what.to_string(), name.to_string(), digits(value), unit.to_string()]
    };
    let system = released.system();
    let units = system.coordinate_units();
    let names = system.coordinate_names().iter().zip(&units).zip(released.q());
    let wishes = reached.wishes.iter();
    let mut all: Vec<Vec<String>> =
        wishes.map(|wish| row("missed", &wish.name, wish.missed, &wish.unit)).collect();
    all.extend(names.map(|((name, unit), value)| row("coordinate", name, *value, unit)));
    let measures = released.measures()?;
    all.extend(
        measures.iter().map(|one| {
            row("measure", &one.name, one.value, one.unit.as_deref().unwrap_or_default())
        }),
    );
    Ok(all)
}

fn as_json(released: &Released, reached: &Reached) -> Result<Value, Fault> {
    let wish = |wish: &kin::solver::Granted| json!({ "name": wish.name, "met": wish.is_met, "missed": wish.missed, "unit": wish.unit });
    let names = released.system().coordinate_names().iter().zip(released.q());
    let coordinates: Value = names.map(|(name, value)| (name.clone(), json!(value))).collect();
    let measures = released.measures()?;
    let measures: Value = measures.into_iter().map(|one| (one.name, json!(one.value))).collect();
    Ok(json!({
        "wishes": reached.wishes.iter().map(wish).collect::<Vec<_>>(),
        "limits": reached.limits,
        "freedoms": reached.freedoms,
        "coordinates": coordinates,
        "measures": measures,
    }))
}
