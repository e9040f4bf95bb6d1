//! Collects the parameters of one constraint to write them as data.

use serde_json::{Map, Value};

/// Collects the parameters of one constraint.
#[derive(Default)]
pub struct Describer {
    pub(crate) parameters: Map<String, Value>,
    pub(crate) refusal: Option<String>,
    text: Option<String>,
    beside: Vec<String>,
    lacking: Vec<String>,
}

/// The modules of the library. Their constraints and loads need no text, because every reader has
/// them.
const LIBRARY: [&str; 2] = ["kin_core::joints", "kin_core::forces::library"];

impl Describer {
    /// Records the reason why the constraint cannot be described.
    pub fn refuse(&mut self, reason: impl Into<String>) {
        self.refusal.get_or_insert(reason.into());
    }

    /// Returns the parameters by name, as JSON.
    pub fn parameters(&self) -> &Map<String, Value> {
        &self.parameters
    }

    /// Records the equation of the constraint as text for the file.
    pub fn put_equation(&mut self, text: impl Into<String>) {
        self.text = Some(text.into());
    }

    /// Records the text of a function of this module, unless the module belongs to the library.
    pub fn put_text(&mut self, module: &str, text: &str) {
        if !LIBRARY.iter().any(|library| module.starts_with(library)) {
            self.put_equation(text);
        }
    }

    /// Records the text of a constant or function that the equation uses.
    pub fn put_beside(&mut self, text: &str) {
        if !self.beside.iter().any(|known| known == text) {
            self.beside.push(text.to_string());
        }
    }

    /// Records a name in the text whose definition the file cannot contain.
    pub fn lacks(&mut self, what: &str) {
        self.lacking.push(what.to_string());
    }

    /// Returns the equation with the definitions that it uses, if these are complete.
    pub fn equation(&self) -> Option<String> {
        let text = self.text.as_ref().filter(|_| self.lacking.is_empty())?;
        Some(self.beside.iter().map(|part| format!("{part}\n")).collect::<String>() + text)
    }

    /// Returns true if the equation does not belong to the library.
    pub(crate) fn is_own(&self) -> bool {
        self.text.is_some()
    }

    /// Returns the names in the text whose definitions the file cannot contain.
    ///
    /// The list is empty if the constraint has no text.
    pub fn lacking(&self) -> &[String] {
        if self.text.is_some() { &self.lacking } else { &[] }
    }

    /// Records a parameter under its name, or the reason why it cannot be written.
    pub fn put_value(&mut self, name: &str, value: Result<Value, String>) {
        match value {
            Ok(value) => {
                self.parameters.insert(name.to_string(), value);
            }
            Err(reason) => self.refuse(format!("the parameter `{name}`: {reason}")),
        }
    }
}
