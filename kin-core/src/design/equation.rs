//! Builds a graph of one equation and its derivatives by its coordinates, its parameters and the
//! values of its laws.

use kin_graph::differentiate::Partial;
use kin_graph::{Column, Formula, Graph, Input, Node, Op, Part};

/// For the passes of `kin_graph` every variable of differentiation is a coordinate of a separate
/// argument. The columns come first, then the parameters, then one number for each call of a law,
/// which is added to the value of the law.
const SELF: Part = Part::R(0);

/// The derivatives of the rows of an equation.
pub(super) struct Equation {
    pub graph: Graph,
    pub rows: Vec<Slopes>,
    /// The calls of laws, in the order of their indices.
    pub calls: Vec<Call>,
    /// The parameters that the user's functions read; their derivatives are unknown.
    pub foreign: Vec<usize>,
    /// The number of columns; `parameters` is the number of parameters.
    pub columns: usize,
    pub parameters: usize,
}

/// One row, and its nonzero derivatives.
pub(super) struct Slopes {
    pub residual: Node,
    pub by_column: Vec<(usize, Node)>,
    pub by_parameter: Vec<(usize, Node)>,
    pub by_call: Vec<(usize, Node)>,
}

/// One call of a law: derivative `order` of law `law` at x.
pub(super) struct Call {
    pub law: usize,
    pub order: u8,
    pub x: Node,
}

/// Why an equation has no derivatives by parameters.
const MOVING: &str = "a function that only rustc can read depends on a coordinate or on time";
const EMPTY: &str = "Kin does not know the equation as a formula";

impl Equation {
    /// Differentiates a formula with this number of columns.
    pub(super) fn of(formula: &Formula, columns: usize) -> Result<Equation, &'static str> {
        let parameters = formula.parameters.len();
        let mut reader =
            Reader { graph: Graph::default(), calls: Vec::new(), foreign: Vec::new(), columns };
        let mut places = vec![Node::default(); formula.graph.len()];
        for node in formula.graph.reachable(&formula.rows) {
            places[node.index()] = reader.read(&formula.graph, node, &places, parameters)?;
        }
        let Reader { mut graph, calls, mut foreign, .. } = reader;
        foreign.sort_unstable();
        foreign.dedup();
        let residuals: Vec<Node> = formula.rows.iter().map(|row| places[row.index()]).collect();
        let none = |residual: &Node| {
            let [by_column, by_parameter, by_call] = [(); 3].map(|()| Vec::new());
            Slopes { residual: *residual, by_column, by_parameter, by_call }
        };
        let mut rows: Vec<Slopes> = residuals.iter().map(none).collect();
        for column in graph.columns(&residuals) {
            let mut partial = Partial::by_column(column);
            for (row, residual) in rows.iter_mut().zip(&residuals) {
                let slope = partial.of(&mut graph, *residual);
                if graph.is_zero(slope) {
                    continue;
                }
                let (to, first) = match column.argument {
                    k if k < columns => (&mut row.by_column, 0),
                    k if k < columns + parameters => (&mut row.by_parameter, columns),
                    _ => (&mut row.by_call, columns + parameters),
                };
                to.push((column.argument - first, slope));
            }
        }
        Equation { graph, rows, calls, foreign, columns, parameters }.compact()
    }

    /// Removes unnecessary nodes from the graph, so that operands of differentiation alone are not
    /// computed.
    fn compact(mut self) -> Result<Equation, &'static str> {
        let from = std::mem::take(&mut self.graph);
        let mut to = Graph::default();
        let mut places = vec![Node::default(); from.len()];
        for node in from.reachable(&self.outputs()) {
            let of = |node: Node| places[node.index()];
            places[node.index()] = match from.op(node) {
                Op::Input(input) => to.input(input),
                Op::Law(law, x, order) => to.law(law, of(x), order),
                Op::Opaque(number, component) => {
                    if to.opaques.len() <= number {
                        to.opaques.resize(number + 1, Vec::new());
                    }
                    to.opaques[number] =
                        from.opaques[number].iter().map(|operand| of(*operand)).collect();
                    to.opaque(number, component)
                }
                op => to.rebuilt(op, of).ok_or(EMPTY)?,
            };
        }
        let moved = |node: &mut Node| *node = places[node.index()];
        for row in &mut self.rows {
            let slopes =
                row.by_column.iter_mut().chain(&mut row.by_parameter).chain(&mut row.by_call);
            slopes.for_each(|(_, node)| moved(node));
            moved(&mut row.residual);
        }
        self.calls.iter_mut().for_each(|call| moved(&mut call.x));
        Ok(Equation { graph: to, ..self })
    }

    /// Returns all nodes that must be computed.
    pub(super) fn outputs(&self) -> Vec<Node> {
        let slopes = self.rows.iter().flat_map(|row| row.by_column.iter().chain(&row.by_parameter));
        let by_call = self.rows.iter().flat_map(|row| &row.by_call);
        let others =
            self.calls.iter().map(|call| call.x).chain(self.rows.iter().map(|row| row.residual));
        slopes.chain(by_call).map(|(_, node)| *node).chain(others).collect()
    }

    /// Returns true if everything is known: the equation contains no function of the user.
    pub(super) fn is_read(&self) -> bool {
        self.graph.opaques.is_empty()
    }

    /// Returns true if a row depends on parameter k.
    pub(super) fn reads(&self, k: usize) -> bool {
        self.foreign.contains(&k)
            || self.rows.iter().any(|row| row.by_parameter.iter().any(|(known, _)| *known == k))
    }
}

/// Converts a formula to a graph that can be differentiated by more than coordinates.
struct Reader {
    graph: Graph,
    calls: Vec<Call>,
    foreign: Vec<usize>,
    columns: usize,
}

impl Reader {
    /// Converts one operation of the formula.
    fn read(
        &mut self,
        from: &Graph,
        node: Node,
        places: &[Node],
        parameters: usize,
    ) -> Result<Node, &'static str> {
        let of = |node: Node| places[node.index()];
        let to = &mut self.graph;
        Ok(match from.op(node) {
            Op::Input(Input::Column(k)) => to.input(Input::State(k, SELF)),
            Op::Input(Input::Parameter(k)) => to.input(Input::State(self.columns + k, SELF)),
            Op::Input(Input::Time) => to.input(Input::Time),
            Op::Law(law, x, order) => {
                let x = of(x);
                let own = self.columns + parameters + self.calls.len();
                let value = to.law(law, x, order);
                let change = to.input(Input::State(own, SELF));
                self.calls.push(Call { law, order, x });
                to.add(value, change)
            }
            // The nearest f64, as in compiled kernels.
            Op::Decimal(k) => {
                from.decimals.get(k).map(|decimal| to.constant(decimal.nearest)).ok_or(EMPTY)?
            }
            Op::Opaque(number, component) => {
                let operands: Vec<Node> =
                    from.opaques[number].iter().map(|operand| of(*operand)).collect();
                let read: Vec<Column> = to.columns(&operands);
                let own = self.columns..self.columns + parameters;
                let moves = |operand: &Node| to.depends(*operand).on_t;
                if operands.iter().any(moves)
                    || read.iter().any(|column| !own.contains(&column.argument))
                {
                    return Err(MOVING);
                }
                self.foreign.extend(read.iter().map(|column| column.argument - self.columns));
                if to.opaques.len() <= number {
                    to.opaques.resize(number + 1, Vec::new());
                }
                to.opaques[number] = operands;
                to.opaque(number, component)
            }
            op => to.rebuilt(op, of).ok_or(EMPTY)?,
        })
    }
}
