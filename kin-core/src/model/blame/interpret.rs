//! Evaluates a formula again with derivatives, and searches from the failed row back to the node
//! where the failure began.

use std::collections::BTreeSet;

use kin_graph::{Formula, LeafUse, Node, Op, Results, evaluate};

use super::jet::Jet;
use super::{Asked, Blame, Direction, Input, Part};
use crate::model::formula::{Given, Outside, Table, jet_of_law};
use crate::numbers::real::Dual3_64;

impl Table {
    /// Returns the expression that made a term not finite. `parameters` are the values of the
    /// parameters.
    pub(crate) fn blame(
        &self,
        asked: &Asked<'_>,
        parameters: &[f64],
        outside: Outside<'_>,
    ) -> Option<Blame> {
        let formula = self.formula();
        let row = *formula.rows.get(asked.row)?;
        let part = asked.term.part();
        asked.directions().into_iter().find_map(|direction| {
            let source =
                Source { q: asked.q, t: asked.t, parameters, direction: &direction, outside };
            let run = Run {
                table: self,
                formula,
                jets: evaluate(&formula.graph, &[row], &source),
                parameters,
            };
            let (node, part) = run.origin(row, part)?;
            Some(run.blame_at(node, part))
        })
    }
}

/// The results along one direction.
struct Run<'a> {
    table: &'a Table,
    formula: &'a Formula,
    jets: Results<Jet>,
    parameters: &'a [f64],
}

impl Run<'_> {
    /// Goes back from a result that is not finite to the node whose operands are all finite.
    fn origin(&self, row: Node, last: Part) -> Option<(Node, Part)> {
        let mut node = row;
        let mut part = self.fault(row, last)?;
        // Operands come before their results, so the search ends.
        while let Some(next) = self
            .operands(node)
            .into_iter()
            .find_map(|operand| Some((operand, self.fault(operand, part)?)))
        {
            (node, part) = next;
        }
        Some((node, part))
    }

    fn fault(&self, node: Node, last: Part) -> Option<Part> {
        self.jets.number(node)?.fault(last)
    }

    /// Returns the operands of a node; for a selection only the operand that is taken.
    fn operands(&self, node: Node) -> Vec<Node> {
        self.formula
            .graph
            .numbers_behind(node, |condition| self.jets.condition(condition).unwrap_or_default())
    }

    fn blame_at(&self, node: Node, part: Part) -> Blame {
        let expression = self.formula.expression(node);
        let name = match self.formula.graph.op(node) {
            Op::Input(kin_graph::Input::Parameter(k)) => {
                self.formula.parameters.get(k).map(String::as_str)
            }
            _ => None,
        };
        let text =
            name.or(expression.map(|expression| expression.text.as_str())).unwrap_or_default();
        let value = |node: &Node| self.jets.number(*node).map_or(f64::NAN, |jet| jet.value);
        Blame {
            expression: text.to_string(),
            source: expression
                .filter(|_| name.is_none())
                .map(|expression| self.table.source(expression)),
            part,
            value: value(&node),
            operands: self.operands(node).iter().map(value).collect(),
            inputs: self.inputs(node),
        }
    }

    /// Returns the coordinates, parameters and the time on which a result depends: coordinates
    /// first, the time last.
    fn inputs(&self, node: Node) -> Vec<Input> {
        let mut seen = BTreeSet::new();
        let mut open = vec![node];
        while let Some(node) = open.pop() {
            if seen.insert(node) {
                open.extend(self.operands(node));
            }
        }
        let mut columns = BTreeSet::new();
        let mut named = Vec::new();
        let mut time = None;
        for node in seen {
            match self.formula.graph.op(node) {
                Op::Input(kin_graph::Input::Column(k)) => drop(columns.insert(k)),
                Op::Input(kin_graph::Input::Time) => time = Some(Input::Time),
                Op::Input(kin_graph::Input::Parameter(k)) => {
                    named.extend(
                        self.formula
                            .parameters
                            .get(k)
                            .zip(self.parameters.get(k))
                            .map(|(name, x)| Input::Parameter(name.clone(), *x)),
                    );
                }
                _ => {}
            }
        }
        columns.into_iter().map(Input::Column).chain(named).chain(time).collect()
    }
}

/// The inputs of an evaluation along one direction.
struct Source<'a> {
    q: &'a [f64],
    t: f64,
    parameters: &'a [f64],
    direction: &'a Direction,
    outside: Outside<'a>,
}

impl kin_graph::Source<Jet> for Source<'_> {
    fn input(&self, input: kin_graph::Input) -> Jet {
        let moving = |value: f64, rate: Option<f64>| {
            rate.map_or(Jet::still(value), |rate| Jet::moving(value, [rate, 0.0]))
        };
        let constant = |x: Option<&f64>| Jet::still(x.copied().unwrap_or(f64::NAN));
        match input {
            kin_graph::Input::Column(k) => moving(
                self.q.get(k).copied().unwrap_or(f64::NAN),
                self.direction.columns.get(k).copied().flatten(),
            ),
            kin_graph::Input::Time => moving(self.t, self.direction.time),
            kin_graph::Input::Parameter(k) => constant(self.parameters.get(k)),
            _ => constant(None),
        }
    }

    fn law(&self, law: usize, x: Jet, order: u8) -> Jet {
        let [f, f1, f2, _] = jet_of_law(self.outside, law, x.value, order);
        x.chain([f, f1, f2])
    }

    /// Evaluates the user's function: its derivatives by each argument, and its second derivative
    /// along the direction.
    fn opaque(&self, number: usize, component: usize, operands: Vec<Jet>) -> Jet {
        let call =
            |operands: Vec<Dual3_64>| Given::by(self.outside, number, &operands).number(component);
        let still = |operand: &Jet| Dual3_64::from_re(operand.value);
        let value = call(operands.iter().map(still).collect()).re;
        if operands.iter().all(|operand| operand.slopes.is_none()) {
            return Jet::still(value);
        }
        let mut first = 0.0;
        for (k, operand) in operands.iter().enumerate() {
            let Some([rate, _]) = operand.slopes else { continue };
            let mut seeded: Vec<_> = operands.iter().map(still).collect();
            seeded[k] = Dual3_64::new(operand.value, 1.0, 0.0, 0.0);
            first += call(seeded).v1 * rate;
        }
        let along = |operand: &Jet| {
            let moved =
                |[first, second]: [f64; 2]| Dual3_64::new(operand.value, first, second, 0.0);
            operand.slopes.map_or(still(operand), moved)
        };
        let second = call(operands.iter().map(along).collect()).v2;
        Jet::moving(value, [first, second])
    }

    /// A formula contains calls as values of the user's program.
    fn leaf(&self, _: LeafUse, _: Vec<Jet>) -> Jet {
        Jet::still(f64::NAN)
    }
}
