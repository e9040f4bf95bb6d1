//! A parameter by which derivatives are asked for: where it is read.

use std::rc::Rc;

use super::equation::Equation;
use crate::model::constraint::Constraint;
use crate::model::error::Result;
use crate::model::formula::Given;
use crate::model::law::Law;
use crate::model::no_derivative::NoDerivative;
use crate::system::System;
use crate::system::dimensions::Moved;
use crate::system::evaluate::Block;

/// Why a parameter that is not read has no derivative worth asking for.
const NOTHING: &str = "no equation depends on it";

/// One parameter.
pub(super) struct Asked {
    /// The number of the name that was asked for: that of the parameter, or of a dimension that it
    /// hangs on.
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
    /// The parameters behind name number `number`, a parameter's (`motor.law.rate`) or a
    /// dimension's.
    pub(super) fn all(
        system: &System,
        equations: &[Rc<Equation>],
        (number, name): (usize, &String),
    ) -> Result<Vec<Asked>> {
        let mut all = Vec::new();
        for Moved { block, name: own, slope } in system.moving_with(name)? {
            let of = &system.equations().blocks[block];
            let parameter = format!("{}.{own}", of.name);
            if !slope.is_finite() {
                let reason = format!("`{parameter}` has no finite derivative by it here");
                return Err(NoDerivative::error(name, reason));
            }
            if let Some(hangs) = Hangs::on(of, &equations[block], (&own, &parameter))? {
                all.push(Asked { name: number, slope, block, hangs });
            }
        }
        if all.is_empty() { Err(NoDerivative::error(name, NOTHING)) } else { Ok(all) }
    }
}

impl Hangs {
    /// The part of a constraint's equation that hangs on the number of that name there, and in the
    /// system; `None` if there is none.
    fn on(block: &Block, equation: &Equation, (name, full): (&str, &str)) -> Result<Option<Hangs>> {
        let no = |reason: &str| NoDerivative::error(full, reason);
        // Formulas have those of an axis along it without the `h`.
        let known = name.replacen(".h.", ".", 1);
        let number = block
            .constraint
            .formula(|table, _, _| table.formula().parameters.iter().position(|own| *own == known));
        Ok(match number.flatten() {
            Some(k) if equation.foreign.contains(&k) => {
                return Err(no("a function of yours, which only rustc can read, is asked for it"));
            }
            Some(k) if !equation.reads(k) => None,
            Some(k) => Some(Hangs::Parameter(k)),
            None => match law(block, equation, name) {
                Some((number, law)) => {
                    let name = name.split_once('.').map_or(name, |(_, name)| name);
                    let by = law.by_parameter(name);
                    let by = by.ok_or_else(|| no("how its law depends on it is not known"))?;
                    Some(Hangs::Law { number, by })
                }
                None if equation.is_read() => None,
                None => {
                    return Err(no(
                        "a function of yours, which only rustc can read, may be asked for it",
                    ));
                }
            },
        })
    }
}

/// The law with a parameter of that name, and its number: the one that becomes another one where
/// the parameter is set.
fn law(block: &Block, equation: &Equation, name: &str) -> Option<(usize, Law)> {
    let law = |constraint: &dyn Constraint, number: usize| {
        constraint.formula(|_, _, outside| Given::by(outside, number, &[]).law().cloned()).flatten()
    };
    let mut value = None;
    block.constraint.parameters(&mut |known, x| value = value.or((known == name).then_some(x)));
    let mut set = block.constraint.clone();
    set.set_parameter(name, value?);
    equation.calls.iter().map(|call| call.law).find_map(|number| {
        let before = law(block.constraint.as_ref(), number)?;
        let after = law(set.as_ref(), number)?;
        (!before.is(&after)).then_some((number, before))
    })
}
