//! Stores the formula of an equation in compiled code as one text.
//!
//! A text adds nothing to compile times. Kin reads the text at the first use. A function of the
//! user's program computes the values that only the program knows.

pub(crate) mod bounds;
pub(crate) mod jerk;
mod law;
pub(crate) mod laws;
pub(crate) mod sides;
pub(crate) mod time;

pub(crate) use law::copied;

use std::borrow::Cow;
use std::sync::OnceLock;

use crate::numbers::real::Dual3_64;
use kin_graph::{Expression, Formula};

use crate::coordinates::Argument;
use crate::law::Law;
use crate::model::blame::Source;
use crate::model::state::{At, Rates};

/// The file name of an equation that was read as text.
const READ: &str = "text";

/// The formula of one constraint or law.
pub struct Table {
    file: &'static str,
    text: Cow<'static, str>,
    formula: OnceLock<Formula>,
    switches: OnceLock<bool>,
}

impl Table {
    /// Creates a formula from its text and the file that contains its expressions.
    pub const fn new(file: &'static str, text: &'static str) -> Self {
        Table {
            file,
            text: Cow::Borrowed(text),
            formula: OnceLock::new(),
            switches: OnceLock::new(),
        }
    }

    /// Creates a formula that was read at run time.
    pub fn read(formula: Formula) -> Self {
        let text = Cow::Owned(formula.to_string());
        Table { file: READ, text, formula: formula.into(), switches: OnceLock::new() }
    }

    /// Returns the formula with the values of the parameters.
    pub fn with(&self, parameters: &[f64]) -> Option<(&Table, Vec<f64>)> {
        Some((self, parameters.to_vec()))
    }

    /// Returns the value of row 0 at q and t and its first three derivatives along the motion.
    ///
    /// If velocities are missing, only the value is meaningful.
    pub fn measured(
        &self,
        arguments: &[Argument],
        at: &At<'_>,
        rates: Option<&[Rates<'_>; 3]>,
        parameters: &[f64],
        outside: Outside<'_>,
    ) -> [f64; 4] {
        let rates = std::array::from_fn(|k| rates.map(|rates| &rates[k]));
        jerk::Along::new(arguments, at, rates, parameters, outside).first(self.formula())
    }

    /// Returns the formula. Kin reads its text once; an invalid text has no rows.
    pub(crate) fn formula(&self) -> &Formula {
        self.formula.get_or_init(|| self.text.parse().unwrap_or_default())
    }

    /// Returns true if an operation of the formula can change its branch. Kin searches the words of
    /// the text and does not read the formula.
    pub(crate) fn may_switch(&self) -> bool {
        *self
            .switches
            .get_or_init(|| sides::Kink::WORDS.iter().any(|word| self.text.contains(word)))
    }

    /// Returns the place of an expression.
    pub(crate) fn source(&self, expression: &Expression) -> Source {
        Source { file: self.file, line: expression.line, column: expression.column }
    }
}

/// A function that computes a value that only the user's program knows.
///
/// The function receives the index and the operands of the value, and writes the results to
/// `Given`.
pub type Outside<'a> = &'a dyn Fn(usize, &[Dual3_64], &mut Given);

/// The results of the user's program for a formula: numbers, or a law.
#[derive(Default)]
pub struct Given {
    numbers: Vec<Dual3_64>,
    law: Option<Law>,
}

impl Given {
    /// Returns the results of outside function `number` for these operands.
    pub(crate) fn by(outside: Outside<'_>, number: usize, operands: &[Dual3_64]) -> Given {
        let mut given = Given::default();
        outside(number, operands, &mut given);
        given
    }

    /// Appends a number.
    pub fn push(&mut self, number: Dual3_64) {
        self.numbers.push(number);
    }

    /// Returns number k, or NaN if it is missing.
    pub(crate) fn number(&self, k: usize) -> Dual3_64 {
        self.numbers.get(k).copied().unwrap_or(Dual3_64::from_re(f64::NAN))
    }

    /// Returns the law.
    pub(crate) fn law(&self) -> Option<&Law> {
        self.law.as_ref()
    }
}

/// Returns derivative `order` of a law at x and the next three derivatives; unknown derivatives are
/// NaN.
pub(crate) fn jet_of_law(outside: Outside<'_>, number: usize, x: f64, order: u8) -> [f64; 4] {
    let Some(law) = Given::by(outside, number, &[]).law else { return [f64::NAN; 4] };
    let [f, f1, f2, f3] = law.jet(x);
    if order == 0 { [f, f1, f2, f3] } else { [f1, f2, f3, law.fourth(x)] }
}

/// Does nothing: the function for an equation that needs no value from the user's program.
pub fn nothing_outside(_: usize, _: &[Dual3_64], _: &mut Given) {}

/// Writes a law to `Given`.
pub fn give_law(law: &Law, _: &[Dual3_64], to: &mut Given) {
    to.law = Some(law.clone());
}

/// Writes plain numbers to `Given`.
pub fn give(numbers: &[f64], to: &mut Given) {
    numbers.iter().for_each(|number| to.push(Dual3_64::from_re(*number)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_read_once_and_one_that_is_no_formula_has_no_rows() {
        static TIME: Table = Table::new("slot.rs", "\nparameters\nrows 0\n- Time");
        static NONSENSE: Table = Table::new("slot.rs", "nonsense");
        assert_eq!((TIME.formula().rows.len(), NONSENSE.formula().rows.len()), (1, 0));
        assert!(std::ptr::eq(TIME.formula(), TIME.formula()));
    }
}
