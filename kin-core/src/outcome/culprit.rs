//! Describes, for an error message, the expression that caused an infinite value or NaN.

use std::fmt;

use crate::outcome::error::surface::Surface;
use crate::outcome::words::time;

/// The part of an expression that is not finite: its value or a derivative.
///
/// Kin checks the value first, then the derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Part {
    /// The value.
    Value,
    /// A first derivative.
    Slope,
    /// A second derivative.
    Curvature,
}

/// A place in the user's program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Source {
    /// The path of the file, as the compiler received it.
    pub file: &'static str,
    /// The line, counted from 1.
    pub line: u32,
    /// The column, counted from 1.
    pub column: u32,
}

/// The expression that caused the failure, with the names of the mechanism.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Culprit {
    /// The expression with its place; `None` if only the constraint is known.
    pub found: Option<Found>,
    /// The inputs of the expression: coordinates (`slider.R_x`), parameters (`slot.k`) and the time
    /// (`t`). If the expression is unknown, the list contains all coordinates of the constraint.
    pub inputs: Vec<(String, f64)>,
}

/// The expression that caused the failure.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Found {
    /// The expression as the user wrote it.
    pub expression: String,
    /// The place of the expression; `None` if it is unknown.
    pub source: Option<Source>,
    /// The part of the expression that is not finite.
    pub part: Part,
    /// The value of the expression. The value is finite if only a derivative is infinite or NaN.
    pub value: f64,
    /// The values of the direct operands.
    pub operands: Vec<f64>,
    /// The kind of the law that the expression evaluates; `None` if the expression is not a law.
    pub law: Option<String>,
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file, self.line, self.column)
    }
}

/// Writes the end of a sentence that has named the failed quantity: the cause, the place, the
/// values, and what to do.
impl fmt::Display for Culprit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let values = list(
            self.inputs.iter().map(|(name, value)| format!("{name} = {}", short(*value))).collect(),
        );
        let Some(found) = &self.found else {
            return if values.is_empty() {
                f.write_str(".")
            } else {
                write!(f, ", with {values}.")
            };
        };
        let operands = match &found.operands[..] {
            [] => String::new(),
            [one] => format!(" (operand {})", short(*one)),
            all => format!(" (operands {})", list(all.iter().map(|x| short(*x)).collect())),
        };
        let expression = &found.expression;
        match found.part {
            Part::Value if found.value.is_nan() => {
                write!(f, ": `{expression}` is not a number{operands}.")?
            }
            Part::Value => write!(f, ": `{expression}` is {}{operands}.", short(found.value))?,
            Part::Slope => write!(f, ": `{expression}` has no finite slope{operands}.")?,
            Part::Curvature => {
                write!(f, ": `{expression}` has no finite second derivative{operands}.")?
            }
        }
        // The texts of Kin's library, and those that Python's functions become, are not the user's.
        let surface = Surface::chosen();
        let source = found.source.filter(|source| {
            !source.file.contains("kin-core/src") && !matches!(surface, Surface::Python)
        });
        let place = source.map(|source| source.to_string());
        let told: Vec<String> =
            place.into_iter().chain((!values.is_empty()).then(|| format!("at {values}"))).collect();
        if !told.is_empty() {
            write!(f, "\n  {}.", told.join(", "))?;
        }
        if let Some(law) = &found.law {
            return write!(
                f,
                "\n  This expression is the law `{law}`. Use arguments where the law has a value and slopes, or give another law."
            );
        }
        f.write_str(match found.part {
            Part::Value if matches!(surface, Surface::Python) => {
                "\n  Begin at another pose, change the parameters, or avoid the value by `kin.where`."
            }
            Part::Value => "\n  Begin at another pose, change the parameters, or write an `if` around the expression.",
            _ => "\n  Avoid this pose, or write a smooth equation: `d.dot(d) - l * l` instead of `d.norm() - l`.",
        })
    }
}

/// Writes a number to nine digits.
fn short(x: f64) -> String {
    if x.is_infinite() {
        return if x > 0.0 { "infinite" } else { "minus infinite" }.to_string();
    }
    time(x).to_string()
}

/// Writes "a, b and c"; of a long list only the first names.
fn list(mut all: Vec<String>) -> String {
    const SHOWN: usize = 12;
    let more = all.len().saturating_sub(SHOWN);
    all.truncate(SHOWN);
    if more > 0 {
        return format!("{} and {more} more", all.join(", "));
    }
    match all.pop() {
        Some(last) if !all.is_empty() => format!("{} and {last}", all.join(", ")),
        last => last.unwrap_or_default(),
    }
}
