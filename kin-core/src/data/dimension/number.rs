//! Defines a number of a mechanism file, which can be an expression.

use std::fmt;

use serde::de::{Deserializer, Visitor};
use serde::{Deserialize, Serialize};

/// A number, or an expression of dimensions such as `"crank / 2"`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum NumberData {
    /// A number.
    Number(f64),
    /// An expression.
    Expression(String),
}

impl<'de> Deserialize<'de> for NumberData {
    fn deserialize<D: Deserializer<'de>>(from: D) -> std::result::Result<Self, D::Error> {
        from.deserialize_any(OfNumber)
    }
}

/// Reads a number or an expression, and reports any other value.
struct OfNumber;

impl Visitor<'_> for OfNumber {
    type Value = NumberData;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or an expression of dimensions")
    }

    fn visit_f64<E>(self, x: f64) -> std::result::Result<NumberData, E> {
        Ok(NumberData::Number(x))
    }

    fn visit_i64<E>(self, x: i64) -> std::result::Result<NumberData, E> {
        Ok(NumberData::Number(x as f64))
    }

    fn visit_u64<E>(self, x: u64) -> std::result::Result<NumberData, E> {
        Ok(NumberData::Number(x as f64))
    }

    fn visit_str<E>(self, text: &str) -> std::result::Result<NumberData, E> {
        Ok(NumberData::Expression(text.to_string()))
    }
}
