//! The parameters of one constraint, being collected to be written as data.

use serde_json::{Map, Value};

/// The parameters of one constraint, being collected.
#[derive(Default)]
pub struct Describer {
    pub(crate) parameters: Map<String, Value>,
    pub(crate) refusal: Option<String>,
    text: Option<String>,
    beside: Vec<String>,
    lacking: Vec<String>,
}

/// The constraints and loads of the library need no text: every reader has them.
const LIBRARY: [&str; 2] = ["kin_core::joints", "kin_core::forces::library"];

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
        self.text = Some(text.into());
    }

    /// The same of a function of this module.
    pub fn put_text(&mut self, module: &str, text: &str) {
        if !LIBRARY.iter().any(|library| module.starts_with(library)) {
            self.put_equation(text);
        }
    }

    /// A constant or function that the text of the equation speaks of, as text.
    pub fn put_beside(&mut self, text: &str) {
        if !self.beside.iter().any(|known| known == text) {
            self.beside.push(text.to_string());
        }
    }

    /// The text speaks of something that it cannot take along.
    pub fn lacks(&mut self, what: &str) {
        self.lacking.push(what.to_string());
    }

    /// The equation with what stands beside it, where that is all that it needs.
    pub fn equation(&self) -> Option<String> {
        let text = self.text.as_ref().filter(|_| self.lacking.is_empty())?;
        Some(self.beside.iter().map(|part| format!("{part}\n")).collect::<String>() + text)
    }

    /// True of an equation that is not the library's.
    pub(crate) fn is_own(&self) -> bool {
        self.text.is_some()
    }

    /// Parts that the text of the equation speaks of and cannot take along; none where there is no
    /// text.
    pub fn lacking(&self) -> &[String] {
        if self.text.is_some() { &self.lacking } else { &[] }
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
