//! Parameters by name, such as `slot.k`: read and changed without a rebuild.

use super::System;
use crate::error::{Error, Result};
use crate::mechanism::admission::sensible_parameters;

impl System {
    /// Names and values of all numeric parameters, such as (`slot.k`, 2.0), in the order of the constraints.
    pub fn parameters(&self) -> Vec<(String, f64)> {
        let mut all = Vec::new();
        for block in &self.equations.blocks {
            block.constraint.parameters(&mut |name, value| all.push((format!("{}.{name}", block.name), value)));
        }
        all
    }

    /// The value of one parameter, such as `slot.k`. Errors: no such parameter.
    pub fn parameter(&self, name: &str) -> Result<f64> {
        self.find(name).map(|(_, _, value)| value)
    }

    /// Sets one parameter, such as `slot.k`; pattern, order and guesses stay. Errors: no such parameter, not finite, or what makes no sense with
    /// the others; the old value stays.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        let (index, parameter, _) = self.find(name)?;
        let block = &mut self.equations.blocks[index];
        if !value.is_finite() {
            return Err(Error::ParameterNotFinite { constraint: block.name.clone(), parameter, value });
        }
        let before = self.parameter(name)?;
        let block = &mut self.equations.blocks[index];
        if block.constraint.set_parameter(&parameter, value) {
            return sensible_parameters(&block.name, block.constraint.as_ref()).inspect_err(|_| {
                block.constraint.set_parameter(&parameter, before);
            });
        }
        Err(Error::UnknownName { what: "parameter that can be set", name: name.to_string(), known: Vec::new() })
    }

    /// The constraint, the parameter's name in it, and its value; names may have dots themselves.
    fn find(&self, name: &str) -> Result<(usize, String, f64)> {
        for (index, block) in self.equations.blocks.iter().enumerate() {
            let Some(wanted) = name.strip_prefix(block.name.as_str()).and_then(|rest| rest.strip_prefix('.')) else { continue };
            let mut found = None;
            block.constraint.parameters(&mut |parameter, value| {
                if parameter == wanted {
                    found = Some(value);
                }
            });
            if let Some(value) = found {
                return Ok((index, wanted.to_string(), value));
            }
        }
        Err(Error::UnknownName { what: "parameter", name: name.to_string(), known: self.near(name) })
    }

    /// The parameters of the constraint that the name begins with, else all.
    fn near(&self, name: &str) -> Vec<String> {
        let all: Vec<String> = self.parameters().into_iter().map(|(name, _)| name).collect();
        let constraint = name.split('.').next().unwrap_or_default();
        let own: Vec<String> =
            all.iter().filter(|known| known.strip_prefix(constraint).is_some_and(|rest| rest.starts_with('.'))).cloned().collect();
        if own.is_empty() { all } else { own }
    }
}
