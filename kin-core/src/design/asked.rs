//! A parameter by which derivatives are asked for: where it is read.

use super::equation::Equation;
use crate::model::constraint::Constraint;
use crate::model::error::Result;
use crate::model::formula::Given;
use crate::model::law::Law;
use crate::model::no_derivative::NoDerivative;
use crate::system::System;
use crate::system::evaluate::Block;
use crate::system::parameters::CasePlace;

/// Why a parameter that is not read has no derivative worth asking for.
const NOTHING: &str = "no equation depends on it";

/// One parameter.
pub(super) struct Asked {
    /// The number of the name that was asked for: that of the parameter, or of a dimension that it hangs on.
    pub name: usize,
    /// Its own derivative by that.
    pub slope: f64,
    /// The constraint that reads it.
    pub block: usize,
    pub hangs: Hangs,
}

/// The part of the equation that hangs on it.
pub(super) enum Hangs {
    /// Itself, by its number in the formula.
    Parameter(usize),
    /// A law, by its number in the formula, of which this is the derivative.
    Law { number: usize, by: Law },
}

impl Asked {
    /// The parameters behind name number `number`, a parameter's (`motor.law.rate`) or a dimension's.
    pub(super) fn all(
        system: &System,
        equations: &[Equation],
        (number, name): (usize, &String),
    ) -> Result<Vec<Asked>> {
        let on = system.parameters_on(name)?.unwrap_or_else(|| vec![(name.clone(), 1.0)]);
        let mut all = Vec::new();
        for (parameter, slope) in on {
            if !slope.is_finite() {
                let reason = format!("`{parameter}` has no finite derivative by it here");
                return Err(NoDerivative::error(name, reason));
            }
            if let Some((block, hangs)) = Asked::of(system, equations, &parameter)? {
                all.push(Asked { name: number, slope, block, hangs });
            }
        }
        if all.is_empty() { Err(NoDerivative::error(name, NOTHING)) } else { Ok(all) }
    }

    /// The constraint of the parameter of that name, and the part of it that hangs on it; `None` if there is
    /// none.
    fn of(system: &System, equations: &[Equation], name: &str) -> Result<Option<(usize, Hangs)>> {
        let value = system.parameter(name)?;
        let no = |reason: &str| NoDerivative::error(name, reason);
        let place = system.places([name])?;
        let Some(CasePlace::Parameter { block, .. }) = place.first().copied() else {
            return Err(no("it is no parameter"));
        };
        let own = &system.equations().blocks[block];
        let local = name.get(own.name.len() + 1..).unwrap_or_default();
        let number = own
            .constraint
            .formula(|table, _, _| table.formula().parameters.iter().position(|known| known == local));
        let equation = &equations[block];
        let hangs = match number.flatten() {
            Some(k) if equation.foreign.contains(&k) => {
                return Err(no("a function of yours, which only rustc can read, is asked for it"));
            }
            Some(k) if !equation.reads(k) => return Ok(None),
            Some(k) => Hangs::Parameter(k),
            None => match law(own, equation, local, value) {
                Some((number, law)) => {
                    let name = local.split_once('.').map_or(local, |(_, name)| name);
                    let by = law.by_parameter(name);
                    let by = by.ok_or_else(|| no("how its law depends on it is not known"))?;
                    Hangs::Law { number, by }
                }
                None if equation.is_read() => return Ok(None),
                None => {
                    return Err(no("a function of yours, which only rustc can read, may be asked for it"));
                }
            },
        };
        Ok(Some((block, hangs)))
    }
}

/// The law with a parameter of that name, and its number: the one that becomes another one where the
/// parameter is set.
fn law(block: &Block, equation: &Equation, name: &str, value: f64) -> Option<(usize, Law)> {
    let law = |constraint: &dyn Constraint, number: usize| {
        constraint.formula(|_, _, outside| Given::by(outside, number, &[]).law().cloned()).flatten()
    };
    let mut set = block.constraint.clone();
    set.set_parameter(name, value);
    equation.calls.iter().map(|call| call.law).find_map(|number| {
        let (before, after) = (law(block.constraint.as_ref(), number)?, law(set.as_ref(), number)?);
        (!before.is(&after)).then_some((number, before))
    })
}
