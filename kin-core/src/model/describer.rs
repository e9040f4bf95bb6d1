//! The parameters of one constraint, being collected to be written as data.

use serde_json::{Map, Value};

/// The parameters of one constraint, being collected.
#[derive(Default)]
pub struct Describer {
    pub(crate) parameters: Map<String, Value>,
    pub(crate) refusal: Option<String>,
    pub(crate) equation: Option<String>,
}

impl Describer {
    /// The constraint cannot be described, and why.
    pub fn refuse(&mut self, reason: impl Into<String>) {
        self.refusal.get_or_insert(reason.into());
    }

    /// The parameters by name, as JSON.
    pub fn parameters(&self) -> &Map<String, Value> {
        &self.parameters
    }

    /// The equation of the constraint as text, which the file then carries.
    pub fn put_equation(&mut self, text: impl Into<String>) {
        self.equation = Some(text.into());
    }

    /// A parameter under its name, or why it cannot be written.
    pub fn put_value(&mut self, name: &str, value: Result<Value, String>) {
        match value {
            Ok(value) => {
                self.parameters.insert(name.to_string(), value);
            }
            Err(reason) => self.refuse(format!("its parameter `{name}`: {reason}")),
        }
    }
}
