//! The equation of a constraint as static data: its steps in the order in which the compiler read them, each with the expression it is of.
//! Written by `#[constraint]` as text ([`super::table`]), read when something has failed, and for the jerk.

use num_dual::Dual3_64;

use crate::law::Law;

pub use super::function::{Function, Function2};

/// One step, from the results of steps before it. A condition counts as 1 or 0.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs)]
pub enum Step {
    /// The coordinate of a local column.
    Column(u16),
    Time,
    /// A parameter, by its number.
    Parameter(u16),
    Constant(f64),
    /// A decimal that no f64 is: the nearest one, and whether the decimal is above that.
    Decimal(f64, bool),
    Negated(u16),
    Call(Function, u16),
    Call2(Function2, u16, u16),
    /// xⁿ
    Power(u16, i32),
    /// The second if the first holds, else the third.
    Select(u16, u16, u16),
    Compare(Comparison, u16, u16),
    Both(u16, u16),
    Either(u16, u16),
    Not(u16),
    /// Number `component` of what only the user's program can compute: which, from what.
    Foreign(u16, &'static [u16], u16),
    /// Derivative number `order` of a law, 0 or 1: which, where.
    Law(u16, u16, u8),
}

impl Step {
    /// Whether any of the steps that it is computed from is such a one.
    pub(crate) fn reads(&self, such: &dyn Fn(u16) -> bool) -> bool {
        match *self {
            Step::Column(_) | Step::Time | Step::Parameter(_) | Step::Constant(_) | Step::Decimal(..) => false,
            Step::Negated(a) | Step::Call(_, a) | Step::Power(a, _) | Step::Not(a) | Step::Law(_, a, _) => such(a),
            Step::Call2(_, a, b) | Step::Compare(_, a, b) | Step::Both(a, b) | Step::Either(a, b) => such(a) || such(b),
            Step::Select(c, a, b) => such(c) || such(a) || such(b),
            Step::Foreign(_, operands, _) => operands.iter().any(|k| such(*k)),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Comparison {
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
}

impl Comparison {
    pub(super) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "Less" => Comparison::Less,
            "LessEqual" => Comparison::LessEqual,
            "Greater" => Comparison::Greater,
            "GreaterEqual" => Comparison::GreaterEqual,
            "Equal" => Comparison::Equal,
            "NotEqual" => Comparison::NotEqual,
            _ => return None,
        })
    }

    pub(super) fn holds(self, a: f64, b: f64) -> bool {
        match self {
            Comparison::Less => a < b,
            Comparison::LessEqual => a <= b,
            Comparison::Greater => a > b,
            Comparison::GreaterEqual => a >= b,
            Comparison::Equal => a == b,
            Comparison::NotEqual => a != b,
        }
    }
}

/// An expression of the user's: as it is written, line and column, both counted from 1.
pub type Expression = (&'static str, u32, u32);

/// The steps of a constraint's rows.
#[derive(Clone, Copy, Debug, Default)]
pub struct Graph {
    /// The file that the expressions stand in.
    pub file: &'static str,
    /// The expressions.
    pub expressions: &'static [Expression],
    /// Each step with the number of its expression.
    pub steps: &'static [(u16, Step)],
    /// The step of each row.
    pub rows: &'static [u16],
    /// The names of the parameters.
    pub parameters: &'static [&'static str],
    /// Whether constants in it have been rounded.
    pub is_rounded: bool,
}

/// Computes what only the user's program can: its number, the numbers it is made of, and where to put the results.
pub type Outside<'a> = &'a dyn Fn(usize, &[Dual3_64], &mut Given);

/// What only the user's program can compute: numbers, or the law that stands there.
#[derive(Default)]
pub struct Given {
    numbers: Vec<Dual3_64>,
    law: Option<Law>,
}

impl Given {
    /// What number `number` of the outside makes of these.
    pub(crate) fn by(outside: Outside<'_>, number: u16, operands: &[Dual3_64]) -> Given {
        let mut given = Given::default();
        outside(usize::from(number), operands, &mut given);
        given
    }

    /// One more number.
    pub fn push(&mut self, number: Dual3_64) {
        self.numbers.push(number);
    }

    /// Number k; not a number where there is none.
    pub(crate) fn number(&self, k: u16) -> Dual3_64 {
        self.numbers.get(usize::from(k)).copied().unwrap_or(Dual3_64::from_re(f64::NAN))
    }

    /// The law.
    pub(crate) fn law(&self) -> Option<&Law> {
        self.law.as_ref()
    }
}

/// Derivative number `order` of a law at x, with the three that follow; what is not known is not a number.
pub(crate) fn jet_of_law(outside: Outside<'_>, number: u16, x: f64, order: u8) -> [f64; 4] {
    let Some(law) = Given::by(outside, number, &[]).law else { return [f64::NAN; 4] };
    let [f, f1, f2, f3] = law.jet(x);
    if order == 0 { [f, f1, f2, f3] } else { [f1, f2, f3, law.fourth(x)] }
}

/// Of an equation in which everything is known.
pub fn nothing_outside(_: usize, _: &[Dual3_64], _: &mut Given) {}

/// Hands over a law.
pub fn give_law(law: &Law, _: &[Dual3_64], to: &mut Given) {
    to.law = Some(law.clone());
}

/// Hands over plain numbers.
pub fn give(numbers: &[f64], to: &mut Given) {
    numbers.iter().for_each(|number| to.push(Dual3_64::from_re(*number)));
}
