//! The parameters of one constraint, being collected to be written as data.

use serde_json::{Map, Value};

/// The parameters of one constraint, being collected.
#[derive(Default)]
pub struct Describer {
    pub(crate) parameters: Map<String, Value>,
    pub(crate) refusal: Option<String>,
}

impl Describer {
    /// The constraint cannot be described, and why.
    pub fn refuse(&mut self, reason: impl Into<String>) {
        self.refusal.get_or_insert(reason.into());
    }

    /// A parameter under its name, or why it cannot be written.
    pub(crate) fn put_value(&mut self, name: &str, value: Result<Value, String>) {
        match value {
            Ok(value) => {
                self.parameters.insert(name.to_string(), value);
            }
            Err(reason) => self.refuse(format!("its parameter `{name}`: {reason}")),
        }
    }
}
