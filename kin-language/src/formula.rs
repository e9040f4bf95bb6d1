//! The formula of a function as data. Each value that only the user's program can compute has a
//! number in it.

use std::collections::HashMap;

use proc_macro2::TokenStream;

use crate::lower::Expression;
use crate::lower::Lowered;
use crate::parse::{Argument, Kind};
use kin_graph::{Column, Formula, Function, Input, LeafUse, Node, Op, Part};

/// A value that only the user's program can compute.
#[derive(Clone, Copy, PartialEq)]
pub enum Outside {
    Law(usize),
    Opaque(usize),
    Leaf(usize),
}

/// The formula of a function, as the user wrote it.
pub struct Written<'a> {
    /// The interpreted body, with the constants as the user wrote them.
    pub lowered: &'a Lowered,
    pub formula: Formula,
    /// The numbers of the parameters in the formula.
    pub parameters: Vec<usize>,
    /// The values behind [`Op::Law`] and [`Op::Opaque`] in the formula, by their number.
    pub outside: Vec<Outside>,
    arguments: &'a [Argument],
    /// From a node of the rows to its node in the formula.
    nodes: HashMap<Node, Node>,
}

impl<'a> Written<'a> {
    /// Makes the formula with the constants as the user wrote them, or else with the folded ones.
    pub fn of(arguments: &'a [Argument], folded: &'a Lowered) -> Self {
        let lowered = folded.as_written.as_deref().unwrap_or(folded);
        let rows: Vec<Node> = lowered.rows.iter().map(|row| row.node).collect();
        let mut formula = Formula::default();
        formula.is_rounded = lowered.graph.is_rounded() && !lowered.graph.keeps_constants();
        let mut written = Written {
            arguments,
            lowered,
            formula,
            nodes: HashMap::new(),
            parameters: vec![],
            outside: vec![],
        };
        for node in lowered.graph.reachable(&rows) {
            let same = written.node(node);
            written.nodes.insert(node, same);
        }
        written.formula.rows = rows.iter().map(|&row| written.of_node(row)).collect();
        let names =
            written.parameters.iter().map(|&k| parameter_name(&lowered.parameters[k], arguments));
        written.formula.parameters = names.collect();
        written
    }

    /// Returns the formula's node for a node that is already in the formula.
    fn of_node(&self, node: Node) -> Node {
        self.nodes.get(&node).copied().unwrap_or_default()
    }

    /// Adds a node whose operands are already in the formula.
    fn node(&mut self, node: Node) -> Node {
        let graph = &self.lowered.graph;
        let op = match graph.op(node) {
            Op::Input(input) => self.input(node, input),
            Op::Law(law, x, order) => {
                Op::Law(place(&mut self.outside, Outside::Law(law)), self.of_node(x), order)
            }
            Op::Opaque(number, component) => {
                return self.foreign(node, Outside::Opaque(number), component);
            }
            Op::Leaf(LeafUse { leaf, output, .. }) => {
                return self.foreign(node, Outside::Leaf(leaf), output);
            }
            Op::Decimal(k) => {
                let decimal = &graph.decimals[k];
                let expression = self.expression(node);
                return self.formula.push_decimal(decimal.nearest, decimal.above, expression);
            }
            op => op.with_operands(|operand| self.of_node(operand)),
        };
        let expression = self.expression(node);
        self.formula.push(op, expression)
    }

    fn foreign(&mut self, node: Node, what: Outside, component: usize) -> Node {
        let number = place(&mut self.outside, what);
        let operands = self
            .lowered
            .graph
            .operands(node)
            .into_iter()
            .map(|operand| self.of_node(operand))
            .collect();
        let expression = self.expression(node);
        self.formula.push_opaque(number, component, operands, expression)
    }

    fn input(&mut self, node: Node, input: Input) -> Op {
        let not_of_a_formula = Op::Constant(f64::NAN.to_bits());
        match input {
            Input::Parameter(k) => Op::Input(Input::Parameter(place(&mut self.parameters, k))),
            Input::State(argument, part) => {
                let function = match part {
                    Part::Sin => Some(Function::Sin),
                    Part::Cos => Some(Function::Cos),
                    _ => None,
                };
                let coordinate = if function.is_some() { Part::Theta } else { part };
                let column = Op::Input(Input::Column(local_column(
                    self.arguments,
                    Column { argument, part: coordinate },
                )));
                let Some(function) = function else { return column };
                let expression = self.expression(node);
                Op::Call(function, self.formula.push(column, expression))
            }
            Input::Time | Input::Column(_) => Op::Input(input),
            Input::Rate(..) | Input::TimeRate | Input::Timed(_) => not_of_a_formula,
        }
    }

    /// Returns the number, in the formula, of the expression to which a node belongs.
    fn expression(&mut self, node: Node) -> Option<usize> {
        let Expression { text, line, column } =
            &self.lowered.expressions.all[self.lowered.expressions.of(node)?];
        let expression = kin_graph::Expression {
            text: text.clone(),
            line: *line as u32,
            column: *column as u32,
        };
        Some(place(&mut self.formula.expressions, expression))
    }
}

/// Returns the name of a parameter in `set_parameter`.
pub fn parameter_name(path: &TokenStream, arguments: &[Argument]) -> String {
    let text = path.to_string().replace(' ', "");
    let name = text.trim_start_matches("self.").replace("r#", "");
    let is_axis = |argument: &Argument| {
        argument.kind == Kind::Axis && name.starts_with(&format!("{}.h.", argument.name))
    };
    if arguments.iter().any(is_axis) { name.replacen(".h.", ".", 1) } else { name }
}

/// Returns the position of an item in a list, and appends the item if it is absent.
fn place<T: PartialEq>(list: &mut Vec<T>, item: T) -> usize {
    list.iter().position(|known| *known == item).unwrap_or_else(|| {
        list.push(item);
        list.len() - 1
    })
}

/// Returns the number of a column among those of all arguments.
pub fn local_column(arguments: &[Argument], column: Column) -> usize {
    let mut slot = 0;
    let mut first = 0;
    for argument in arguments {
        let slots = argument.kind.slots();
        if column.argument < slot + slots {
            return first
                + match (&argument.kind, column.part) {
                    (Kind::Planar, Part::Theta) => 2,
                    (Kind::Planars(_), part) => {
                        3 * (column.argument - slot) + if let Part::R(k) = part { k } else { 2 }
                    }
                    (Kind::Spatials(_), Part::R(k)) => 7 * (column.argument - slot) + k,
                    (Kind::Spatials(_), Part::P(k)) => 7 * (column.argument - slot) + 3 + k,
                    (_, Part::R(k)) => k,
                    (_, Part::P(k)) => 3 + k,
                    _ => column.argument - slot,
                };
        }
        slot += slots;
        first += argument.kind.columns();
    }
    first
}
