//! Prints the equations of a mechanism as formulas.

use kin_graph::text::{Kin, print};
use kin_graph::{Input, Op};

use crate::law::Law;
use crate::program::Refusal;
use crate::program::gather::{Differences, gather};
use crate::system::System;

/// The longest formula. \[bytes\]
const LONGEST: usize = 240;

/// Returns the formula of each row of a system, or `None` if the formula is long. `drivers` are
/// laws with their names, and `parameters` the names of free parameters.
pub(crate) fn equations(
    system: &System,
    differences: Differences,
    drivers: &[(String, Law)],
    parameters: &[String],
) -> Result<Vec<Option<String>>, Refusal> {
    let whole = gather(system, false, differences)?;
    let names = system.coordinate_names();
    let named = |node| match whole.graph.op(node) {
        Op::Input(Input::State(column, _)) => names.get(column).cloned(),
        Op::Input(Input::Parameter(k)) => parameters.get(k).cloned(),
        Op::Input(Input::Time) => Some("t".to_string()),
        Op::Law(law, _, order) => {
            let own = whole.laws.get(law)?;
            let driver = drivers.iter().find(|(_, driver)| driver.is(own));
            let name = driver.map_or("law", |(name, _)| name);
            Some(format!("{name}{}", "'".repeat(usize::from(order))))
        }
        _ => None,
    };
    let row =
        |row: &super::super::gather::Row| print(&whole.graph, row.residual, &Kin, named, LONGEST);
    Ok(whole.rows.iter().map(row).collect())
}
