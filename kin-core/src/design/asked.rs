//! Finds the equations that read the parameters by which Kin differentiates.

use std::rc::Rc;

use super::equation::Equation;
use crate::law::Law;
use crate::model::constraint::Constraint;
use crate::model::formula::Given;
use crate::outcome::error::{Error, Result};
use crate::system::System;
use crate::system::dimensions::Moved;
use crate::system::evaluate::Block;

/// The reason for refusing a parameter that no equation reads.
const NOTHING: &str = "no equation depends on the parameter";

/// One parameter that an equation reads.
pub(super) struct Asked {
    /// The index of the requested name: that of the parameter, or of a dimension on which the
    /// parameter depends.
    pub name: usize,
    /// The derivative of the parameter by that name.
    pub slope: f64,
    /// The index of the constraint that reads it.
    pub block: usize,
    pub hangs: Hangs,
}

/// The part of the equation that depends on the parameter.
pub(super) enum Hangs {
    /// A parameter, by its index in the formula.
    Parameter(usize),
    /// A law, by its index in the formula, with its derivative by the parameter.
    Law { number: usize, by: Law },
}

impl Asked {
    /// Returns the parameters that depend on name number `number`: a parameter (`motor.law.rate`)
    /// or a dimension.
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
                let reason =
                    format!("`{parameter}` has no finite derivative by `{name}` at these values");
                return Err(Error::no_derivative(name, reason));
            }
            if let Some(hangs) = Hangs::on(of, &equations[block], (&own, &parameter))? {
                all.push(Asked { name: number, slope, block, hangs });
            }
        }
        if all.is_empty() { Err(Error::no_derivative(name, NOTHING)) } else { Ok(all) }
    }
}

impl Hangs {
    /// Returns the part of a constraint's equation that depends on a number, given by its name in
    /// the constraint and in the system. Returns `None` if there is none.
    fn on(block: &Block, equation: &Equation, (name, full): (&str, &str)) -> Result<Option<Hangs>> {
        let no = |reason: &str| Error::no_derivative(full, reason);
        // Formulas name the numbers of an axis along it without the `h`.
        let known = name.replacen(".h.", ".", 1);
        let number = block
            .constraint
            .formula(|table, _, _| table.formula().parameters.iter().position(|own| *own == known));
        Ok(match number.flatten() {
            Some(k) if equation.foreign.contains(&k) => {
                return Err(no(
                    "the parameter is an argument of a user-defined function that only rustc can read",
                ));
            }
            Some(k) if !equation.reads(k) => None,
            Some(k) => Some(Hangs::Parameter(k)),
            None => match law(block, equation, name) {
                Some((number, law)) => {
                    let name = name.split_once('.').map_or(name, |(_, name)| name);
                    let by = law.by_parameter(name);
                    let by = by.ok_or_else(|| {
                        no("Kin does not know how the law depends on the parameter")
                    })?;
                    Some(Hangs::Law { number, by })
                }
                None if equation.is_read() => None,
                None => {
                    return Err(no(
                        "the parameter may be an argument of a user-defined function that only rustc can read",
                    ));
                }
            },
        })
    }
}

/// Returns the law with a parameter of this name, and its index in the formula: the law that
/// changes if the parameter is set.
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
