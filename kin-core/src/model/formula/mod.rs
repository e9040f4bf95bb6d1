//! The formula of an equation as emitted code holds it: one text, which costs nothing to compile
//! and is read when somebody first asks for it; and beside it what only the user's program can
//! compute.

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

use crate::model::blame::Source;
use crate::model::coordinates::Argument;
use crate::model::law::Law;
use crate::model::state::{At, Rates};

/// The file of an equation that comes as text.
const READ: &str = "text";

/// The formula of one constraint or law.
pub struct Table {
    file: &'static str,
    text: Cow<'static, str>,
    formula: OnceLock<Formula>,
    switches: OnceLock<bool>,
}

impl Table {
    /// The formula as text, and the file that its expressions stand in.
    pub const fn new(file: &'static str, text: &'static str) -> Self {
        Table {
            file,
            text: Cow::Borrowed(text),
            formula: OnceLock::new(),
            switches: OnceLock::new(),
        }
    }

    /// A formula that was read while the program runs.
    pub fn read(formula: Formula) -> Self {
        let text = Cow::Owned(formula.to_string());
        Table { file: READ, text, formula: formula.into(), switches: OnceLock::new() }
    }

    /// Itself, with the values of the parameters.
    pub fn with(&self, parameters: &[f64]) -> Option<(&Table, Vec<f64>)> {
        Some((self, parameters.to_vec()))
    }

    /// The value of row 0 at q and t with its first three derivatives along the rates; without
    /// rates the value alone is of use.
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

    /// The formula. It is read once; a text that is none has no rows.
    pub(crate) fn formula(&self) -> &Formula {
        self.formula.get_or_init(|| self.text.parse().unwrap_or_default())
    }

    /// True if an operation in it may switch from one side to another. The words of its text tell
    /// that, without reading the formula.
    pub(crate) fn may_switch(&self) -> bool {
        const WORDS: [&str; 5] = ["Select", "Abs", "Signum", "Max", "Min"];
        *self.switches.get_or_init(|| WORDS.iter().any(|word| self.text.contains(word)))
    }

    /// The place of one of its expressions.
    pub(crate) fn source(&self, expression: &Expression) -> Source {
        Source { file: self.file, line: expression.line, column: expression.column }
    }
}

/// Computes what only the user's program can: its number, the numbers it is made of, and where to
/// put the results.
pub type Outside<'a> = &'a dyn Fn(usize, &[Dual3_64], &mut Given);

/// Results that only the user's program can compute: numbers, or the law that stands there.
#[derive(Default)]
pub struct Given {
    numbers: Vec<Dual3_64>,
    law: Option<Law>,
}

impl Given {
    /// The results of function `number` of the outside for these operands.
    pub(crate) fn by(outside: Outside<'_>, number: usize, operands: &[Dual3_64]) -> Given {
        let mut given = Given::default();
        outside(number, operands, &mut given);
        given
    }

    /// One more number.
    pub fn push(&mut self, number: Dual3_64) {
        self.numbers.push(number);
    }

    /// Number k; not a number where there is none.
    pub(crate) fn number(&self, k: usize) -> Dual3_64 {
        self.numbers.get(k).copied().unwrap_or(Dual3_64::from_re(f64::NAN))
    }

    /// The law.
    pub(crate) fn law(&self) -> Option<&Law> {
        self.law.as_ref()
    }
}

/// Derivative number `order` of a law at x, with the three that follow; what is not known is not a
/// number.
pub(crate) fn jet_of_law(outside: Outside<'_>, number: usize, x: f64, order: u8) -> [f64; 4] {
    let Some(law) = Given::by(outside, number, &[]).law else { return [f64::NAN; 4] };
    let [f, f1, f2, f3] = law.jet(x);
    if order == 0 { [f, f1, f2, f3] } else { [f1, f2, f3, law.fourth(x)] }
}

/// The outside of an equation in which everything is known.
pub fn nothing_outside(_: usize, _: &[Dual3_64], _: &mut Given) {}

/// Hands over a law.
pub fn give_law(law: &Law, _: &[Dual3_64], to: &mut Given) {
    to.law = Some(law.clone());
}

/// Hands over plain numbers.
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
