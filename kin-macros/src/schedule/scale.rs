//! Powers of two: 2 (a b + c d) is (2 a) b + (2 c) d, which costs less where 2 a and 2 c serve other sums too.

use std::collections::HashMap;

use crate::graph::{Graph, Input, Node, Op, is_power_of_two};

/// The nodes 2ᵏ x, in groups that share something: of a group all go inwards or none.
pub struct Factors {
    groups: Vec<Vec<Node>>,
}

/// More groups than this are decided together.
const MOST_GROUPS: usize = 6;

impl Factors {
    pub fn new(g: &Graph, outputs: &[Node]) -> Self {
        let nodes = g.reachable(outputs);
        let mut owner: HashMap<Node, usize> = HashMap::new();
        let mut groups: Vec<Vec<Node>> = Vec::new();
        for &node in &nodes {
            let Some((_, inner)) = power_of_two(g, node) else { continue };
            let mine = groups.len();
            groups.push(vec![node]);
            for reached in reach(g, inner) {
                let other = *owner.get(&reached).unwrap_or(&mine);
                if other != mine {
                    let moved = std::mem::take(&mut groups[other]);
                    groups[mine].extend(moved);
                    owner.values_mut().filter(|owner| **owner == other).for_each(|owner| *owner = mine);
                }
                owner.insert(reached, mine);
            }
        }
        groups.retain(|group| !group.is_empty());
        Factors { groups }
    }

    /// Which factors to push inwards: none, all, and each group alone left out or alone pushed.
    pub fn choices(&self) -> Vec<Vec<Node>> {
        let all: Vec<Node> = self.groups.concat();
        let mut choices = vec![vec![], all];
        if (2..=MOST_GROUPS).contains(&self.groups.len()) {
            choices = (0..1 << self.groups.len()).map(|mask: usize| self.chosen(mask)).collect();
        }
        if self.groups.is_empty() {
            choices.truncate(1);
        }
        choices
    }

    fn chosen(&self, mask: usize) -> Vec<Node> {
        self.groups.iter().enumerate().filter(|(k, _)| mask >> k & 1 == 1).flat_map(|(_, group)| group.clone()).collect()
    }

    /// The outputs with the factors `pushed` inwards as far as they go.
    pub fn apply(&self, g: &mut Graph, outputs: &[Node], pushed: &[Node]) -> Vec<Node> {
        let nodes = g.reachable(outputs);
        let mut scaling = Scaling::new(g, outputs, &nodes, pushed);
        for &output in outputs {
            scaling.demand(output, 0);
        }
        for &node in nodes.iter().rev() {
            scaling.plan(g, node);
        }
        for &node in &nodes {
            scaling.build(g, node);
        }
        outputs.iter().map(|&output| scaling.built[&(output, 0)]).collect()
    }
}

/// (k, x) if `node` is 2ᵏ x, k ≠ 0.
fn power_of_two(g: &Graph, node: Node) -> Option<(i32, Node)> {
    let Op::Mul(c, x) = g.op(node) else { return None };
    let c = g.constant_value(c).filter(|c| is_power_of_two(*c) && (2f64.powi(-8)..=256.0).contains(c))?;
    Some((c.log2() as i32, x))
}

/// What a factor of `node` can meet on its way inwards.
fn reach(g: &Graph, node: Node) -> Vec<Node> {
    let mut seen = std::collections::BTreeSet::new();
    let mut open = vec![node];
    while let Some(node) = open.pop() {
        let passes = matches!(g.op(node), Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Neg(_) | Op::Div(..));
        if passes && seen.insert(node) {
            open.extend(g.operands(node));
        }
    }
    seen.into_iter().collect()
}

/// How 2ᵏ times a node is made.
#[derive(Clone, Copy)]
enum Plan {
    /// Multiplied when all is done.
    Outside,
    /// From operands that are scaled by these powers.
    Operands(i32, i32),
    /// `node` is 2ʲ x: x scaled by k + j.
    Absorbed(Node, i32),
    /// `node` is c x with any constant c: the constant is scaled.
    Constant(f64, Node),
}

struct Scaling {
    pushed: std::collections::HashSet<Node>,
    /// Nodes whose own value is needed too: a factor had better go elsewhere.
    firm: Vec<bool>,
    shared: Vec<bool>,
    demands: HashMap<Node, Vec<i32>>,
    plans: HashMap<(Node, i32), Plan>,
    built: HashMap<(Node, i32), Node>,
}

impl Scaling {
    fn new(g: &Graph, outputs: &[Node], nodes: &[Node], pushed: &[Node]) -> Self {
        let pushed = pushed.iter().copied().collect();
        let mut scaling = Scaling {
            pushed,
            firm: vec![false; g.len()],
            shared: super::uses(g, outputs).into_iter().map(|uses| uses > 1).collect(),
            demands: HashMap::new(),
            plans: HashMap::new(),
            built: HashMap::new(),
        };
        outputs.iter().for_each(|output| scaling.firm[output.index()] = true);
        for &node in nodes.iter().rev() {
            let passes = matches!(g.op(node), Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Neg(_));
            if !scaling.pushed.contains(&node) && (!passes || scaling.firm[node.index()]) {
                g.operands(node).iter().for_each(|operand| scaling.firm[operand.index()] = true);
            }
        }
        scaling
    }

    fn demand(&mut self, node: Node, k: i32) {
        let demands = self.demands.entry(node).or_default();
        if !demands.contains(&k) {
            demands.push(k);
        }
    }

    /// Decides how each power that is asked of `node` is made, and asks its operands for what that takes.
    fn plan(&mut self, g: &Graph, node: Node) {
        let mut done = 0;
        while let Some(&k) = self.demands.get(&node).and_then(|demands| demands.get(done)) {
            done += 1;
            let plan = self.choose(g, node, k);
            self.plans.insert((node, k), plan);
            match (plan, g.operands(node).as_slice()) {
                (Plan::Outside, _) => self.demand(node, 0),
                (Plan::Absorbed(x, k), _) => self.demand(x, k),
                (Plan::Constant(_, x), _) => self.demand(x, 0),
                (Plan::Operands(first, second), operands) => {
                    for (operand, k) in operands.iter().zip([first, second].into_iter().chain(std::iter::repeat(0))) {
                        self.demand(*operand, k);
                    }
                }
            }
        }
    }

    fn choose(&self, g: &Graph, node: Node, k: i32) -> Plan {
        if let Some((j, x)) = power_of_two(g, node) {
            let absorbed = self.pushed.contains(&node);
            return if absorbed { Plan::Absorbed(x, k + j) } else { Plan::Constant(2f64.powi(k + j), x) };
        }
        match g.op(node) {
            _ if k == 0 => Plan::Operands(0, 0),
            Op::Add(..) | Op::Sub(..) | Op::Neg(_) => Plan::Operands(k, k),
            Op::Div(..) => Plan::Operands(k, 0),
            Op::Mul(a, b) => match g.constant_value(a) {
                Some(c) => Plan::Constant(c * 2f64.powi(k), b),
                None if self.better(g, a, b, k) => Plan::Operands(k, 0),
                None => Plan::Operands(0, k),
            },
            _ => Plan::Outside,
        }
    }

    /// Whether 2ᵏ goes to `a` rather than to `b`: where it is asked for anyway, where nothing else is, to sums that are shared, to coordinates.
    fn better(&self, g: &Graph, a: Node, b: Node, k: i32) -> bool {
        let rank = |n: Node| {
            let asked = self.demands.get(&n).is_some_and(|demands| demands.contains(&k));
            let moves = matches!(g.op(n), Op::Input(Input::State(..) | Input::Rate(..)));
            let input = matches!(g.op(n), Op::Input(_));
            (asked, !input && !self.firm[n.index()], !input && self.shared[n.index()] && !self.firm[n.index()], moves)
        };
        rank(a) >= rank(b)
    }

    fn build(&mut self, g: &mut Graph, node: Node) {
        let mut demands = self.demands.get(&node).cloned().unwrap_or_default();
        demands.sort_by_key(|k| k.abs());
        for k in demands {
            let value = match self.plans[&(node, k)] {
                Plan::Outside => {
                    let (factor, value) = (g.constant(2f64.powi(k)), self.built[&(node, 0)]);
                    g.raw(Op::Mul(factor, value))
                }
                Plan::Absorbed(x, k) => self.built[&(x, k)],
                Plan::Constant(c, x) => {
                    let (factor, value) = (g.constant(c), self.built[&(x, 0)]);
                    if c == 1.0 { value } else { g.raw(Op::Mul(factor, value)) }
                }
                Plan::Operands(first, second) => self.rebuilt(g, node, first, second),
            };
            self.built.insert((node, k), value);
        }
    }

    fn rebuilt(&self, g: &mut Graph, node: Node, first: i32, second: i32) -> Node {
        let of = |n: Node, k: i32| self.built[&(n, k)];
        match g.op(node) {
            Op::Add(a, b) => g.raw(Op::Add(of(a, first), of(b, second))),
            Op::Sub(a, b) => g.raw(Op::Sub(of(a, first), of(b, second))),
            Op::Mul(a, b) => g.raw(Op::Mul(of(a, first), of(b, second))),
            Op::Div(a, b) => g.raw(Op::Div(of(a, first), of(b, second))),
            Op::Neg(a) => g.raw(Op::Neg(of(a, first))),
            _ => g.with_operands(node, |n| of(n, 0)),
        }
    }
}
