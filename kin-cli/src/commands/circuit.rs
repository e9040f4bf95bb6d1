//! `kin circuit`: all positions that are reached while one driver moves.

use kin_view::Scene;

use crate::arguments::Circuit;
use crate::fault::Fault;
use crate::model;
use crate::output::{digits, put, table};
use crate::say::Say;

/// Writes the positions by arc length, and notes where the input turns back.
pub fn circuit(asked: &Circuit, say: &Say) -> Result<(), Fault> {
    let system = model::system(&asked.model)?;
    let circuit = system.circuit(&asked.input, asked.points).map_err(Fault::asked)?;
    let input = circuit.input();
    let unit = input.unit.as_deref().unwrap_or_default();
    let kind = if circuit.is_closed() { "closed" } else { "open" };
    say.note(&format!("{}: a {kind} circuit of the driver `{}`", system.name(), input.name));
    for dead in circuit.dead_centres() {
        say.note(&format!("`{}` turns back at {} {unit}", input.name, dead.input));
    }
    for crossing in circuit.crossings() {
        say.note(&format!(
            "another circuit crosses at `{}` = {} {unit}",
            input.name, crossing.input
        ));
    }
    let units = system.coordinate_units();
    let named = system.coordinate_names().iter().zip(&units);
    let header: Vec<String> = ["s".to_string(), format!("{} [{unit}]", input.name)]
        .into_iter()
        .chain(named.map(|(name, unit)| format!("{name} [{unit}]")))
        .collect();
    let motion = circuit.motion();
    let rows = (0..motion.len()).map(|k| {
        let own = [motion.times()[k], circuit.inputs()[k]];
        own.iter().chain(motion.q(k)).map(|x| digits(*x)).collect()
    });
    table(&asked.csv, &header, rows)?;
    if let Some(to) = &asked.page {
        let page = Scene::new(&system).page(motion)?.html();
        put(to, |to| to.write_all(page.as_bytes()))?;
    }
    Ok(())
}
