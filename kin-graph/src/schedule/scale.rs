//! Moves powers of two inwards: 2 (a b + c d) becomes (2 a) b + (2 c) d, which costs less if other
//! sums also need 2 a and 2 c.

use super::{Branches, Lists};
use crate::{Graph, Input, Node, Op, is_power_of_two};

/// Returns the outputs with all powers of two moved inwards as far as possible, or `None` without
/// powers of two.
pub fn powers_inwards(g: &mut Graph, outputs: &[Node]) -> Option<Vec<Node>> {
    let nodes = g.reachable(outputs);
    if !nodes.iter().any(|&node| power_of_two(g, node).is_some()) {
        return None;
    }
    let mut scaling = Scaling::new(g, outputs, &nodes);
    for &output in outputs {
        scaling.demand(output, 0);
    }
    for &node in nodes.iter().rev() {
        scaling.plan(g, node);
    }
    for &node in &nodes {
        scaling.build(g, node);
    }
    Some(outputs.iter().map(|&output| scaling.of(output, 0)).collect())
}

/// (k, x) if `node` is 2ᵏ x, k ≠ 0.
fn power_of_two(g: &Graph, node: Node) -> Option<(i32, Node)> {
    let Op::Mul(c, x) = g.op(node) else { return None };
    let c = g
        .constant_value(c)
        .filter(|c| is_power_of_two(*c) && (2f64.powi(-8)..=256.0).contains(c))?;
    Some((c.log2() as i32, x))
}

/// How 2ᵏ times a node is made.
#[derive(Clone, Copy)]
enum Plan {
    /// Multiplied when all is done.
    Outside,
    /// From its first two operands scaled by these powers.
    Operands(i32, i32),
    /// `node` is 2ʲ x: x scaled by k + j.
    Absorbed(Node, i32),
    /// `node` is c x with any constant c, which is scaled.
    Constant(f64, Node),
}

/// 2ᵏ times a node, as it is asked for and as it is made.
#[derive(Clone, Copy)]
struct Demand {
    k: i32,
    plan: Plan,
    built: Node,
}

struct Scaling {
    /// Nodes whose own value is needed: a power had better go elsewhere.
    firm: Vec<bool>,
    uses: Vec<usize>,
    demands: Lists<Demand>,
}

impl Scaling {
    fn new(g: &Graph, outputs: &[Node], nodes: &[Node]) -> Self {
        let mut firm = vec![false; g.len()];
        outputs.iter().for_each(|output| firm[output.index()] = true);
        for &node in nodes.iter().rev() {
            let passes = matches!(g.op(node), Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Neg(_));
            if power_of_two(g, node).is_none() && (!passes || firm[node.index()]) {
                g.each_operand(node, |operand| firm[operand.index()] = true);
            }
        }
        Scaling {
            firm,
            uses: super::uses(g, &Branches::none(), nodes, outputs),
            demands: Lists::new(g.len()),
        }
    }

    fn demand(&mut self, node: Node, k: i32) {
        let demands = self.demands.to(node);
        if !demands.iter().any(|demand| demand.k == k) {
            demands.push(Demand { k, plan: Plan::Outside, built: node });
        }
    }

    /// 2ᵏ times `node`, which has been built.
    fn of(&self, node: Node, k: i32) -> Node {
        self.demands
            .of(node)
            .iter()
            .find(|demand| demand.k == k)
            .map_or(node, |demand| demand.built)
    }

    /// Decides how each power that is asked of `node` is made, and asks its operands for what that
    /// takes.
    fn plan(&mut self, g: &Graph, node: Node) {
        let mut done = 0;
        while let Some(&Demand { k, .. }) = self.demands.of(node).get(done) {
            let plan = self.choose(g, node, k);
            self.demands.to(node)[done].plan = plan;
            done += 1;
            match plan {
                Plan::Outside => self.demand(node, 0),
                Plan::Absorbed(x, k) => self.demand(x, k),
                Plan::Constant(_, x) => self.demand(x, 0),
                Plan::Operands(first, second) => {
                    let mut powers = [first, second].into_iter();
                    g.each_operand(node, |operand| {
                        self.demand(operand, powers.next().unwrap_or(0))
                    });
                }
            }
        }
    }

    fn choose(&self, g: &Graph, node: Node, k: i32) -> Plan {
        if let Some((j, x)) = power_of_two(g, node) {
            return Plan::Absorbed(x, k + j);
        }
        match g.op(node) {
            _ if k == 0 => Plan::Operands(0, 0),
            Op::Add(..) | Op::Sub(..) | Op::Neg(_) => Plan::Operands(k, k),
            Op::Div(..) => Plan::Operands(k, 0),
            Op::Mul(a, b) => match g.constant_value(a) {
                Some(c) => Plan::Constant(c * 2f64.powi(k), b),
                None if self.rank(g, a, k) >= self.rank(g, b, k) => Plan::Operands(k, 0),
                None => Plan::Operands(0, k),
            },
            _ => Plan::Outside,
        }
    }

    /// How well 2ᵏ goes to a factor: where it is asked for anyway, to sums that are shared and not
    /// needed as such, to coordinates.
    fn rank(&self, g: &Graph, node: Node, k: i32) -> (bool, bool, bool) {
        let asked = self.demands.of(node).iter().any(|demand| demand.k == k);
        let (input, moves) = match g.op(node) {
            Op::Input(input) => (true, matches!(input, Input::State(..) | Input::Rate(..))),
            _ => (false, false),
        };
        let pliant = !input && !self.firm[node.index()];
        (asked, pliant, moves || pliant && self.uses[node.index()] > 1)
    }

    fn build(&mut self, g: &mut Graph, node: Node) {
        // A demand that is multiplied outside starts from the plain value: that one first.
        self.demands.to(node).sort_by_key(|demand| demand.k != 0);
        for place in 0..self.demands.of(node).len() {
            let Demand { k, plan, .. } = self.demands.of(node)[place];
            let built = match plan {
                Plan::Outside => times(g, 2f64.powi(k), self.of(node, 0)),
                Plan::Absorbed(x, k) => self.of(x, k),
                Plan::Constant(c, x) => times(g, c, self.of(x, 0)),
                Plan::Operands(first, second) => self.rebuilt(g, node, first, second),
            };
            self.demands.to(node)[place].built = built;
        }
    }

    fn rebuilt(&self, g: &mut Graph, node: Node, first: i32, second: i32) -> Node {
        match g.op(node) {
            Op::Add(a, b) => g.raw(Op::Add(self.of(a, first), self.of(b, second))),
            Op::Sub(a, b) => g.raw(Op::Sub(self.of(a, first), self.of(b, second))),
            Op::Mul(a, b) => g.raw(Op::Mul(self.of(a, first), self.of(b, second))),
            Op::Div(a, b) => g.raw(Op::Div(self.of(a, first), self.of(b, second))),
            Op::Neg(a) => g.raw(Op::Neg(self.of(a, first))),
            _ => g.with_operands(node, |operand| self.of(operand, 0)),
        }
    }
}

fn times(g: &mut Graph, factor: f64, node: Node) -> Node {
    if factor == 1.0 {
        return node;
    }
    let factor = g.constant(factor);
    g.raw(Op::Mul(factor, node))
}
