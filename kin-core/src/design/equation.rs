//! One equation and its derivatives by its coordinates, its parameters and what its laws give, as a
//! graph.

use kin_graph::differentiate::Partial;
use kin_graph::{Column, Formula, Graph, Input, Node, Op, Part};

/// To the passes of `kin_graph` all that is differentiated by is a coordinate of an argument of its
/// own: first the columns, then the parameters, then one number for each call of a law, which is
/// added to what the law gives.
const SELF: Part = Part::R(0);

/// The derivatives of the rows of an equation.
pub(super) struct Equation {
    pub graph: Graph,
    pub rows: Vec<Slopes>,
    /// The calls of laws, in the order of their numbers.
    pub calls: Vec<Call>,
    /// Parameters that the user's own functions read: how is not known.
    pub foreign: Vec<usize>,
    /// Number of columns, and of parameters.
    pub columns: usize,
    pub parameters: usize,
}

/// One row, and its derivatives that are not zero.
pub(super) struct Slopes {
    pub residual: Node,
    pub by_column: Vec<(usize, Node)>,
    pub by_parameter: Vec<(usize, Node)>,
    pub by_call: Vec<(usize, Node)>,
}

/// One call of a law: derivative number `order` of law number `law` at x.
pub(super) struct Call {
    pub law: usize,
    pub order: u8,
    pub x: Node,
}

/// Why an equation has no derivatives by parameters.
const MOVING: &str = "a function that only rustc can read is asked for something that moves";
const EMPTY: &str = "its equation is not known as a formula";

impl Equation {
    /// Of a formula in so many columns.
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

    /// The same with a graph that has no node too many: what was differentiated is not computed
    /// again.
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

    /// All that has to be computed.
    pub(super) fn outputs(&self) -> Vec<Node> {
        let slopes = self.rows.iter().flat_map(|row| row.by_column.iter().chain(&row.by_parameter));
        let by_call = self.rows.iter().flat_map(|row| &row.by_call);
        let others =
            self.calls.iter().map(|call| call.x).chain(self.rows.iter().map(|row| row.residual));
        slopes.chain(by_call).map(|(_, node)| *node).chain(others).collect()
    }

    /// True if all of it is known: no function of the user's stands in it.
    pub(super) fn is_read(&self) -> bool {
        self.graph.opaques.is_empty()
    }

    /// True if any row depends on parameter k.
    pub(super) fn reads(&self, k: usize) -> bool {
        self.foreign.contains(&k)
            || self.rows.iter().any(|row| row.by_parameter.iter().any(|(known, _)| *known == k))
    }
}

/// A formula on its way into a graph that can be differentiated by more than coordinates.
struct Reader {
    graph: Graph,
    calls: Vec<Call>,
    foreign: Vec<usize>,
    columns: usize,
}

impl Reader {
    /// One step of the formula.
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
            // The nearest f64, as kernels have it.
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
