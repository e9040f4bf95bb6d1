//! Evaluates a law that is a formula of column 0: its derivatives, its bounds, its nodes in another
//! graph, and its derivative by a parameter.

use super::bounds::{self, Inputs, opaque, row};
use super::jerk::Along;
use super::{Given, Outside, Table, nothing_outside};
use crate::law::{Law, LawFunction};
use crate::numbers::enclosure::Series;
use crate::numbers::enclosure::interval::ZERO;
use crate::numbers::real::Dual3_64;
use kin_graph::differentiate::Partial;
use kin_graph::{Formula, Graph, Input, Node, Op, evaluate};

impl Table {
    /// Returns f, f′, f″ and f‴ at x.
    pub fn law_jet(&self, x: f64, parameters: &[f64], outside: Outside<'_>) -> [f64; 4] {
        Along::variable(x, parameters, outside).first(self.formula())
    }

    /// Returns bounds of f over x, or `None` if the bounds are unknown.
    pub fn law_over(&self, x: &Series, parameters: &[f64], outside: Outside<'_>) -> Option<Series> {
        let formula = self.formula();
        if opaque(formula, outside).is_some() {
            return None;
        }
        let inputs = Inputs { columns: &[*x], t: Series::constant(ZERO), parameters, outside };
        Some(row(formula, 0, &evaluate(&formula.graph, &formula.rows, &inputs)))
    }

    /// Returns the kinds of the laws whose stated bounds the bounds of this formula rely on.
    pub fn law_trusted(&self, outside: Outside<'_>) -> Vec<String> {
        bounds::trusted(self.formula(), outside)
    }

    /// Adds f at x to a graph.
    ///
    /// Returns `None` if the formula contains a value that only the user's program can compute.
    pub fn law_in(
        &self,
        graph: &mut Graph,
        x: Node,
        parameters: &[f64],
        outside: Outside<'_>,
    ) -> Option<Node> {
        let formula = self.formula();
        let row = *formula.rows.first()?;
        copied(&formula.graph, row, graph, outside, &mut |graph, input| match input {
            Input::Column(0) => Some(x),
            Input::Parameter(k) => parameters.get(k).map(|value| graph.constant(*value)),
            _ => None,
        })
    }

    /// Returns ∂f/∂p as a law of x, where p is the parameter with this name.
    ///
    /// Returns `None` if the derivative is unknown. Also returns `None` if f contains a
    /// conditional, because the derivative does not exist where the branch changes.
    pub fn law_by(&self, name: &str, parameters: &[f64], outside: Outside<'_>) -> Option<Law> {
        let formula = self.formula();
        if self.may_switch() {
            return None;
        }
        let row = *formula.rows.first()?;
        let number = formula.parameters.iter().position(|known| known == name)?;
        let value = *parameters.get(number)?;
        // A graph is differentiated by column 0. So column 0 is p, and column 1 is x.
        let mut graph = Graph::default();
        let f =
            copied(&formula.graph, row, &mut graph, outside, &mut |graph, input| match input {
                Input::Column(0) => Some(graph.input(Input::Column(1))),
                Input::Parameter(k) if k == number => Some(graph.input(Input::Column(0))),
                Input::Parameter(k) => parameters.get(k).map(|value| graph.constant(*value)),
                _ => None,
            })?;
        let slope = Partial::by_variable().of(&mut graph, f);
        let mut found = Formula::default();
        let row =
            copied(&graph, slope, &mut found.graph, outside, &mut |graph, input| match input {
                Input::Column(1) => Some(graph.input(Input::Column(0))),
                Input::Column(0) => Some(graph.constant(value)),
                _ => None,
            })?;
        found.rows.push(row);
        Some(Law::new(Slope(Table::read(found))))
    }
}

/// Copies a node of one graph to another graph. `input` replaces its inputs.
pub(crate) fn copied(
    from: &Graph,
    row: Node,
    to: &mut Graph,
    outside: Outside<'_>,
    input: &mut dyn FnMut(&mut Graph, Input) -> Option<Node>,
) -> Option<Node> {
    let mut places = vec![Node::default(); from.len()];
    for node in from.reachable(&[row]) {
        let of = |operand: Node| places[operand.index()];
        places[node.index()] = match from.op(node) {
            Op::Input(read) => input(to, read)?,
            Op::Decimal(k) => to.constant(from.decimals.get(k)?.nearest),
            Op::Opaque(number, component) => {
                let operands =
                    from.opaques.get(number)?.iter().map(|operand| to.known_value(of(*operand)));
                let operands: Vec<Dual3_64> =
                    operands.map(|x| x.map(Dual3_64::from_re)).collect::<Option<_>>()?;
                to.constant(Given::by(outside, number, &operands).number(component).re)
            }
            Op::Law(number, x, 0) => Given::by(outside, number, &[]).law()?.written(to, of(x))?,
            op => to.rebuilt(op, of)?,
        };
    }
    Some(places[row.index()])
}

/// The law ∂f/∂p of a law f.
struct Slope(Table);

impl LawFunction for Slope {
    fn jet(&self, x: f64) -> [f64; 4] {
        self.0.law_jet(x, &[], &nothing_outside)
    }

    fn kind(&self) -> &str {
        "slope by a parameter"
    }

    fn over(&self, x: &Series) -> Option<Series> {
        self.0.law_over(x, &[], &nothing_outside)
    }

    fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        self.0.law_in(graph, x, &[], &nothing_outside)
    }

    fn trusted(&self) -> Vec<String> {
        Vec::new()
    }
}
