//! Stores nodes that Kin evaluates together in a separate graph, which the evaluator computes from
//! the first node to the last.

use std::cell::Cell;

use kin::Law;
use kin::extend::state::{At, Rates};
use kin_graph::{Graph, Input, LeafUse, Node, Op, Part, Results, Source, evaluate_all};

thread_local! {
    /// The results of the call before, for their memory.
    static MEMORY: Cell<Results<f64>> = Cell::default();
}

/// Outputs that one call computes.
#[derive(Default)]
pub struct Stage {
    graph: Graph,
    outputs: Vec<Node>,
}

impl Stage {
    /// Creates a stage with the `outputs` of the graph `from`.
    ///
    /// The function `parameter` maps the indices of parameters, and the function `law` maps the
    /// indices of laws.
    pub fn of(
        from: &Graph,
        outputs: &[Node],
        parameter: impl Fn(usize) -> usize,
        law: impl Fn(usize) -> usize,
    ) -> Self {
        let mut graph = Graph::default();
        let mut places: Vec<Node> = vec![Node::default(); from.len()];
        for node in from.reachable(outputs) {
            let op = match from.op(node).with_operands(|operand| places[operand.index()]) {
                Op::Input(Input::Parameter(k)) => Op::Input(Input::Parameter(parameter(k))),
                Op::Law(number, x, order) => Op::Law(law(number), x, order),
                Op::Decimal(k) => {
                    let nearest = from.decimals.get(k).map_or(f64::NAN, |decimal| decimal.nearest);
                    Op::Constant(nearest.to_bits())
                }
                op => op,
            };
            places[node.index()] = graph.raw(op);
        }
        Stage { graph, outputs: outputs.iter().map(|output| places[output.index()]).collect() }
    }

    /// Computes the outputs and writes them to these places.
    ///
    /// Kin reuses memory from call to call. A law that evaluates another stage during the call
    /// allocates separate memory.
    pub fn compute<'t>(&self, seen: &Seen<'_>, to: impl IntoIterator<Item = &'t mut f64>) {
        let mut results = MEMORY.take();
        evaluate_all(&self.graph, seen, &mut results);
        for (place, output) in to.into_iter().zip(&self.outputs) {
            *place = results.number(*output).unwrap_or(f64::NAN);
        }
        MEMORY.set(results);
    }

    /// Returns the largest absolute value of all intermediate results of the outputs.
    pub fn largest(&self, seen: &Seen<'_>) -> f64 {
        let mut results = Results::default();
        evaluate_all(&self.graph, seen, &mut results);
        let numbers = self.graph.nodes().filter_map(|node| results.number(node));
        numbers.map(f64::abs).filter(|x| x.is_finite()).fold(0.0, f64::max)
    }
}

/// The state, time and parameters from which a stage reads its inputs.
pub struct Seen<'a> {
    pub at: &'a At<'a>,
    pub rates: Option<&'a Rates<'a>>,
    pub t_dot: f64,
    pub kinds: &'a [(&'static str, kin::extend::dual_route::ArgumentKind)],
    pub parameters: &'a [f64],
    pub laws: &'a [Law],
}

impl Seen<'_> {
    fn state(&self, slot: usize, part: Part) -> Option<f64> {
        use kin::extend::dual_route::ArgumentKind::{Coord, Planar, Spatial};
        match (self.kinds.get(slot)?.1, part) {
            (Planar, Part::R(k)) => self.at.state::<5>(slot)?.get(k).copied(),
            (Planar, part) => Some(self.at.state::<5>(slot)?[trig(part, 2)]),
            (Spatial, Part::R(k)) => self.at.state::<7>(slot)?.get(k).copied(),
            (Spatial, Part::P(k)) => self.at.state::<7>(slot)?.get(3 + k).copied(),
            (Coord, part) => Some(self.at.state::<3>(slot)?[trig(part, 0)]),
            _ => None,
        }
    }

    fn rate(&self, slot: usize, part: Part) -> Option<f64> {
        use kin::extend::dual_route::ArgumentKind::{Coord, Planar, Spatial};
        let rates = self.rates?;
        match (self.kinds.get(slot)?.1, part) {
            (Planar, Part::R(k)) => rates.of::<3>(slot)?.get(k).copied(),
            (Planar, _) => Some(rates.of::<3>(slot)?[2]),
            (Spatial, Part::R(k)) => rates.of::<7>(slot)?.get(k).copied(),
            (Spatial, Part::P(k)) => rates.of::<7>(slot)?.get(3 + k).copied(),
            (Coord, _) => Some(rates.of::<1>(slot)?[0]),
            _ => None,
        }
    }
}

/// Where an angle, its sine or its cosine stands in a state, the angle being number `theta`.
fn trig(part: Part, theta: usize) -> usize {
    match part {
        Part::Sin => theta + 1,
        Part::Cos => theta + 2,
        _ => theta,
    }
}

impl Source<f64> for Seen<'_> {
    fn input(&self, input: Input) -> f64 {
        let found = match input {
            Input::State(slot, part) => self.state(slot, part),
            Input::Rate(slot, part) => self.rate(slot, part),
            Input::Time => Some(self.at.t),
            Input::TimeRate => Some(self.t_dot),
            Input::Parameter(k) => self.parameters.get(k).copied(),
            Input::Column(_) | Input::Timed(_) => None,
        };
        found.unwrap_or(f64::NAN)
    }

    fn law(&self, law: usize, x: f64, order: u8) -> f64 {
        let Some(law) = self.laws.get(law) else { return f64::NAN };
        match order {
            0..=3 => law.jet(x)[usize::from(order)],
            4 => law.fourth(x),
            _ => f64::NAN,
        }
    }

    /// There are none in an equation from text.
    fn opaque(&self, _: usize, _: usize, _: Vec<f64>) -> f64 {
        f64::NAN
    }

    /// There are none in an equation from text.
    fn leaf(&self, _: LeafUse, _: Vec<f64>) -> f64 {
        f64::NAN
    }
}
