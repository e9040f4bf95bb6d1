//! The table of an equation as emitted code holds it: one text, which costs nothing to compile and is read when somebody first asks for it.
//!
//! A line `at LINE COLUMN TEXT` for each expression, the names of the parameters, `rounded` where constants are not as they were written, the steps of
//! the rows, then a line for each step: the number of its expression (`-` for none), its name, and the numbers of its operands.

use std::str::FromStr;
use std::sync::OnceLock;

use super::graph::{Comparison, Expression, Function, Function2, Graph, Step};

/// The table of one constraint.
pub struct Table {
    file: &'static str,
    text: &'static str,
    graph: OnceLock<Graph>,
}

impl Table {
    /// The steps as text, and the file that the expressions stand in.
    pub const fn new(file: &'static str, text: &'static str) -> Self {
        Table { file, text, graph: OnceLock::new() }
    }

    /// The steps, with the values of the parameters.
    pub fn with(&'static self, parameters: &[f64]) -> Option<(&'static Graph, Vec<f64>)> {
        Some((self.graph(), parameters.to_vec()))
    }

    /// The steps. What is read stays for good, as if it had been compiled; a text that is no table has none.
    pub fn graph(&'static self) -> &'static Graph {
        self.graph.get_or_init(|| read(self.file, self.text).unwrap_or_else(|| Graph { file: self.file, ..Graph::default() }))
    }
}

fn read(file: &'static str, text: &'static str) -> Option<Graph> {
    let (mut expressions, mut steps) = (Vec::new(), Vec::new());
    let (mut rows, mut parameters, mut is_rounded) = (Vec::new(), Vec::new(), false);
    for line in text.lines().filter(|line| !line.is_empty()) {
        let (first, rest) = line.split_once(' ').unwrap_or((line, ""));
        match first {
            "at" => expressions.push(expression(rest)?),
            "parameters" => parameters.extend(rest.split_whitespace()),
            "rounded" => is_rounded = true,
            "rows" => rows = numbers(rest)?,
            number => steps.push((number.parse().unwrap_or(u16::MAX), step(rest)?)),
        }
    }
    Some(Graph { file, expressions: expressions.leak(), steps: steps.leak(), rows: rows.leak(), parameters: parameters.leak(), is_rounded })
}

/// `LINE COLUMN TEXT`
fn expression(text: &'static str) -> Option<Expression> {
    let (line, rest) = text.split_once(' ')?;
    let (column, text) = rest.split_once(' ')?;
    Some((text, line.parse().ok()?, column.parse().ok()?))
}

/// `NAME OPERANDS`
fn step(text: &str) -> Option<Step> {
    let (name, rest) = text.split_once(' ').unwrap_or((text, ""));
    let operand = |k: usize| number(rest, k);
    Some(match name {
        "Column" => Step::Column(operand(0)?),
        "Time" => Step::Time,
        "Parameter" => Step::Parameter(operand(0)?),
        "Constant" => Step::Constant(number(rest, 0)?),
        "Decimal" => Step::Decimal(number(rest, 0)?, operand(1)? == 1),
        "Negated" => Step::Negated(operand(0)?),
        "Power" => Step::Power(operand(0)?, number(rest, 1)?),
        "Select" => Step::Select(operand(0)?, operand(1)?, operand(2)?),
        "Both" => Step::Both(operand(0)?, operand(1)?),
        "Either" => Step::Either(operand(0)?, operand(1)?),
        "Not" => Step::Not(operand(0)?),
        "Law" => Step::Law(operand(0)?, operand(1)?, number(rest, 2)?),
        "Foreign" => Step::Foreign(operand(0)?, numbers(rest)?.get(2..)?.to_vec().leak(), operand(1)?),
        _ => match (Function::named(name), Function2::named(name)) {
            (Some(f), _) => Step::Call(f, operand(0)?),
            (_, Some(f)) => Step::Call2(f, operand(0)?, operand(1)?),
            _ => Step::Compare(Comparison::named(name)?, operand(0)?, operand(1)?),
        },
    })
}

/// Number k of a list.
fn number<T: FromStr>(text: &str, k: usize) -> Option<T> {
    text.split_whitespace().nth(k)?.parse().ok()
}

fn numbers(text: &str) -> Option<Vec<u16>> {
    text.split_whitespace().map(|number| number.parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    static SLOT: Table =
        Table::new("slot.rs", "\nat 3 5 k * x\nparameters k\nrows 3\n- Parameter 0\n0 Column 2\n0 Product 0 1\n- Atan2 2 1");

    #[test]
    fn a_table_is_read() {
        let graph = SLOT.graph();
        assert_eq!((graph.file, graph.rows, graph.parameters), ("slot.rs", &[3][..], &["k"][..]));
        assert_eq!(graph.expressions, [("k * x", 3, 5)]);
        let shown: Vec<String> = graph.steps.iter().map(|step| format!("{step:?}")).collect();
        let steps = ["(65535, Parameter(0))", "(0, Column(2))", "(0, Call2(Product, 0, 1))", "(65535, Call2(Atan2, 2, 1))"];
        assert_eq!(shown, steps);
        assert!(std::ptr::eq(graph, SLOT.graph()), "read once");
    }

    #[test]
    fn every_kind_of_step_is_read() {
        let said = |text: &str| step(text).map(|step| format!("{step:?}"));
        assert_eq!(said("Constant -2.5e-3").as_deref(), Some("Constant(-0.0025)"));
        assert_eq!(said("Constant NaN").as_deref(), Some("Constant(NaN)"));
        assert_eq!(said("Decimal 0.1 0").as_deref(), Some("Decimal(0.1, false)"));
        assert_eq!(said("Power 4 -3").as_deref(), Some("Power(4, -3)"));
        assert_eq!(said("Foreign 1 2 7 9").as_deref(), Some("Foreign(1, [7, 9], 2)"));
        assert_eq!(said("Foreign 1 2").as_deref(), Some("Foreign(1, [], 2)"));
        assert_eq!(said("Law 0 5 1").as_deref(), Some("Law(0, 5, 1)"));
        assert_eq!(said("NotEqual 5 6").as_deref(), Some("Compare(NotEqual, 5, 6)"));
        assert_eq!(said("Select 1 2 3").as_deref(), Some("Select(1, 2, 3)"));
        assert_eq!(said("Time").as_deref(), Some("Time"));
        for text in ["", "Column", "Column -1", "Column 70000", "Sideways 1", "Select 1 2", "Foreign 1"] {
            assert_eq!(said(text), None, "{text}");
        }
    }

    #[test]
    fn what_is_no_table_has_no_steps() {
        for text in ["nonsense", "0 Column", "at 1 x y", "rows a"] {
            assert!(read("", text).is_none(), "{text}");
        }
    }
}
