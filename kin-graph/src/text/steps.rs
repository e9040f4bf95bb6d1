//! Converts a formula to text and back.
//!
//! Emitted code contains the text as one literal, which adds nothing to compile times.
//!
//! The text has a line `at LINE COLUMN TEXT` for each expression, the names of the parameters,
//! `rounded` if constants were rounded, and the steps of the rows. Then the text has a line for
//! each step: the index of its expression (`-` for none), its name, and the indices of its
//! operands, which are earlier steps.

use std::fmt;
use std::str::{FromStr, SplitWhitespace};

use crate::formula::{Expression, Formula};
use crate::{Comparison, Function, Function2, Graph, Input, Node, Op};

/// An operation made of two operands.
type OfTwo = fn(Node, Node) -> Op;

/// Operations of operands alone, by their names.
const ARITHMETIC: [(&str, OfTwo); 6] = [
    ("Sum", Op::Add),
    ("Difference", Op::Sub),
    ("Product", Op::Mul),
    ("Quotient", Op::Div),
    ("Both", Op::And),
    ("Either", Op::Or),
];

impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let nodes = self.graph.reachable(&self.rows);
        let mut steps = vec![0; self.graph.len()];
        nodes.iter().enumerate().for_each(|(step, node)| steps[node.index()] = step);
        for Expression { text, line, column } in &self.expressions {
            write!(f, "\nat {line} {column} {}", text.replace('\n', " "))?;
        }
        write!(f, "\nparameters{}", list(&self.parameters))?;
        if self.is_rounded {
            f.write_str("\nrounded")?;
        }
        write!(f, "\nrows{}", list(self.rows.iter().map(|row| steps[row.index()])))?;
        for node in nodes {
            let of = |node: &Node| steps[node.index()];
            match self.number_of_expression(node) {
                Some(number) => write!(f, "\n{number} ")?,
                None => f.write_str("\n- ")?,
            }
            let operands = self.graph.operands(node);
            f.write_str(&step(&self.graph, node, &list(operands.iter().map(of))))?;
        }
        Ok(())
    }
}

/// The items, each behind a space.
fn list<T: fmt::Display>(items: impl IntoIterator<Item = T>) -> String {
    items.into_iter().map(|item| format!(" {item}")).collect()
}

/// A node by its name, `operands` being the numbers of its operands.
fn step(graph: &Graph, node: Node, operands: &str) -> String {
    match graph.op(node) {
        Op::Input(Input::Column(k)) => format!("Column {k}"),
        Op::Input(Input::Time) => "Time".to_owned(),
        Op::Input(Input::Parameter(k)) => format!("Parameter {k}"),
        Op::Constant(bits) => format!("Constant {:?}", f64::from_bits(bits)),
        Op::Decimal(k) => {
            let decimal = &graph.decimals[k];
            format!("Decimal {:?} {}", decimal.nearest, u8::from(decimal.above))
        }
        Op::Truth(holds) => format!("Constant {}", u8::from(holds)),
        Op::Neg(_) => format!("Negated{operands}"),
        Op::Not(_) => format!("Not{operands}"),
        Op::Select(..) => format!("Select{operands}"),
        Op::Powi(_, n) => format!("Power{operands} {n}"),
        Op::Law(law, _, order) => format!("Law {law}{operands} {order}"),
        Op::Opaque(number, component) => format!("Foreign {number} {component}{operands}"),
        Op::Call(f, _) => format!("{}{operands}", f.name()),
        Op::Call2(f, ..) => format!("{}{operands}", f.name()),
        Op::Compare(comparison, ..) => format!("{comparison:?}{operands}"),
        Op::Add(a, b)
        | Op::Sub(a, b)
        | Op::Mul(a, b)
        | Op::Div(a, b)
        | Op::And(a, b)
        | Op::Or(a, b) => {
            let is = |made: OfTwo| made(a, b) == graph.op(node);
            let name = ARITHMETIC.iter().find(|(_, made)| is(*made)).map_or("", |(name, _)| name);
            format!("{name}{operands}")
        }
        // A formula is what the user wrote: rates, fused operations and calls of one direction come
        // later.
        Op::Input(_) | Op::Fma(..) | Op::Leaf(_) => "Constant NaN".to_owned(),
    }
}

/// The error for a line that is not a line of a formula.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Unreadable {
    /// The line.
    pub line: String,
}

impl FromStr for Formula {
    type Err = Unreadable;

    fn from_str(text: &str) -> Result<Self, Unreadable> {
        let mut reader = Reader::default();
        for line in text.lines().filter(|line| !line.is_empty()) {
            reader.line(line).ok_or_else(|| Unreadable { line: line.to_owned() })?;
        }
        let rows: Option<Vec<Node>> =
            reader.rows.iter().map(|row| reader.steps.get(*row).copied()).collect();
        reader.formula.rows =
            rows.ok_or_else(|| Unreadable { line: format!("rows{}", list(&reader.rows)) })?;
        Ok(reader.formula)
    }
}

#[derive(Default)]
struct Reader {
    formula: Formula,
    /// The node of each step. Equal steps are one node.
    steps: Vec<Node>,
    rows: Vec<usize>,
}

impl Reader {
    fn line(&mut self, line: &str) -> Option<()> {
        let (first, rest) = line.split_once(' ').unwrap_or((line, ""));
        match first {
            "at" => self.formula.expressions.push(expression(rest)?),
            "parameters" => {
                self.formula.parameters.extend(rest.split_whitespace().map(str::to_owned))
            }
            "rounded" => self.formula.is_rounded = true,
            "rows" => {
                self.rows =
                    rest.split_whitespace().map(|row| row.parse().ok()).collect::<Option<_>>()?
            }
            number => {
                let written = if number == "-" { None } else { Some(number.parse().ok()?) };
                let node = self.step(rest, written)?;
                self.steps.push(node);
            }
        }
        Some(())
    }

    /// `NAME OPERANDS`
    fn step(&mut self, text: &str, written: Option<usize>) -> Option<Node> {
        let mut words = text.split_whitespace();
        let name = words.next()?;
        if name == "Foreign" {
            let (number, component) = (number(&mut words)?, number(&mut words)?);
            let operands = words.map(|word| self.node(word)).collect::<Option<_>>()?;
            return Some(self.formula.push_opaque(number, component, operands, written));
        }
        if name == "Decimal" {
            let (nearest, above): (f64, u8) = (number(&mut words)?, number(&mut words)?);
            return Some(self.formula.push_decimal(nearest, above == 1, written));
        }
        let op = self.op(name, &mut words)?;
        Some(self.formula.push(op, written))
    }

    fn op(&self, name: &str, words: &mut SplitWhitespace<'_>) -> Option<Op> {
        Some(match name {
            "Column" => Op::Input(Input::Column(number(words)?)),
            "Time" => Op::Input(Input::Time),
            "Parameter" => Op::Input(Input::Parameter(number(words)?)),
            "Constant" => Op::Constant(number::<f64>(words)?.to_bits()),
            "Negated" => Op::Neg(self.next(words)?),
            "Not" => Op::Not(self.next(words)?),
            "Power" => Op::Powi(self.next(words)?, number(words)?),
            "Select" => Op::Select(self.next(words)?, self.next(words)?, self.next(words)?),
            "Law" => Op::Law(number(words)?, self.next(words)?, number(words)?),
            _ => return self.function(name, words),
        })
    }

    fn function(&self, name: &str, words: &mut SplitWhitespace<'_>) -> Option<Op> {
        let first = self.next(words)?;
        if let Some(f) = Function::named(name) {
            return Some(Op::Call(f, first));
        }
        let second = self.next(words)?;
        if let Some((_, made)) = ARITHMETIC.iter().find(|(known, _)| *known == name) {
            return Some(made(first, second));
        }
        let comparison =
            || Comparison::ALL.into_iter().find(|comparison| format!("{comparison:?}") == name);
        Function2::named(name)
            .map(|f| Op::Call2(f, first, second))
            .or_else(|| Some(Op::Compare(comparison()?, first, second)))
    }

    fn next(&self, words: &mut SplitWhitespace<'_>) -> Option<Node> {
        self.node(words.next()?)
    }

    /// The node of a step that was read before.
    fn node(&self, word: &str) -> Option<Node> {
        self.steps.get(word.parse::<usize>().ok()?).copied()
    }
}

/// `LINE COLUMN TEXT`
fn expression(text: &str) -> Option<Expression> {
    let (line, rest) = text.split_once(' ')?;
    let (column, text) = rest.split_once(' ')?;
    Some(Expression {
        text: text.to_owned(),
        line: line.parse().ok()?,
        column: column.parse().ok()?,
    })
}

fn number<T: FromStr>(words: &mut SplitWhitespace<'_>) -> Option<T> {
    words.next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLOT: &str = "\nat 3 5 k * x\nparameters k\nrounded\nrows 3\n- Parameter 0\n0 Column 2\n0 Product 0 1\n- Atan2 2 1";

    fn read(text: &str) -> Formula {
        text.parse().unwrap_or_else(|error| panic!("{error:?}"))
    }

    #[test]
    fn a_formula_is_read_and_written_as_it_was() {
        let formula = read(SLOT);
        let product = formula.graph.operands(formula.rows[0])[0];
        assert_eq!(
            formula.expression(product).map(|e| (e.text.as_str(), e.line, e.column)),
            Some(("k * x", 3, 5))
        );
        assert_eq!(
            (formula.parameters.join(","), formula.to_string()),
            ("k".to_owned(), SLOT.to_owned())
        );
    }

    #[test]
    fn every_operation_comes_back() {
        let steps = [
            "Column 0",
            "Time",
            "Parameter 1",
            "Constant -2.5e-3",
            "Decimal 0.1 0",
            "Negated 0",
            "Power 4 -3",
            "Not 5",
            "Select 5 1 2",
        ];
        let others = [
            "Law 0 5 1",
            "Foreign 1 2 7 8",
            "Foreign 2 0",
            "Both 5 6",
            "Either 5 6",
            "Sum 0 1",
            "Difference 0 1",
            "Quotient 0 1",
        ];
        let ones = Function::ALL.iter().map(|f| format!("{} 0", f.name()));
        let twos = Function2::ALL.iter().map(|f| format!("{} 0 1", f.name()));
        let comparisons = Comparison::ALL.iter().map(|c| format!("{c:?} 0 1"));
        let all: Vec<String> = steps
            .into_iter()
            .chain(others)
            .map(str::to_owned)
            .chain(ones)
            .chain(twos)
            .chain(comparisons)
            .collect();
        let rows: String = (0..all.len()).map(|k| format!(" {k}")).collect();
        let text = format!(
            "\nparameters\nrows{rows}{}",
            all.iter().map(|step| format!("\n- {step}")).collect::<String>()
        );
        let once = read(&text).to_string();
        let canonical = text.replace("-2.5e-3", "-0.0025");
        assert_eq!(once, canonical);
        assert_eq!(read(&once).to_string(), once);
    }

    #[test]
    fn what_is_no_formula_is_refused_with_its_line() {
        let broken = [
            "nonsense",
            "0 Column",
            "- Column -1",
            "at 1 x y",
            "rows a",
            "- Sin 0",
            "- Sideways",
            "- Time\n- Select 0 0",
            "rows 0",
        ];
        for text in broken {
            let refused = text.parse::<Formula>().err();
            assert!(refused.is_some_and(|error| text.ends_with(&error.line)), "{text}");
        }
    }
}
