//! The values that a constraint makes of the time alone: laws, sines and calls in which no
//! coordinate stands. They are evaluated once a time (`at_time`), and every other function of the
//! constraint reads them.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::kernel::{Kernel, is_condition};
use kin_graph::differentiate::Derivatives;
use kin_graph::{Graph, Input, Node, Op, Part};
use kin_language::lower::Lowered;

/// The numbers of a constraint that are evaluated once a time.
pub struct Timed {
    /// The nodes that the other functions read (sorted).
    read: Vec<Node>,
    /// C(0, t) of all rows, −C_t and −C_tt, of a constraint that is linear for good: all that a
    /// solver wants to know of it.
    sides: Vec<Node>,
}

impl Timed {
    pub fn new(
        lowered: &mut Lowered,
        outputs: &[Node],
        derived: &Derivatives,
        linear: bool,
    ) -> Self {
        let rows = &derived.rows;
        let on_t = rows.iter().any(|row| lowered.graph.depends(*row).on_t);
        let sides = if linear && on_t { sides(&mut lowered.graph, rows, derived) } else { None };
        Timed { read: select(lowered, outputs), sides: sides.unwrap_or_default() }
    }

    pub fn len(&self) -> usize {
        self.read.len() + self.sides.len()
    }
}

/// C(0, t) of all rows, −C_t and −C_tt, if that can be told.
fn sides(g: &mut Graph, rows: &[Node], derived: &Derivatives) -> Option<Vec<Node>> {
    let zero = g.zero();
    let side = |side: &[Node], k: usize| side.get(k).copied().unwrap_or(zero);
    let sides = [&derived.velocity_rhs, &derived.acceleration_rhs]
        .into_iter()
        .flat_map(|own| (0..rows.len()).map(|k| side(own, k)));
    let all: Vec<Node> = rows.iter().copied().chain(sides).collect();
    // Each node once: parts may be shared many times over.
    let mut known: Vec<Option<Node>> = vec![None; g.len()];
    for node in g.reachable(&all) {
        known[node.index()] = at_origin(g, node, |operand| known[operand.index()]);
    }
    all.into_iter().map(|node| known[node.index()]).collect()
}

/// A part of a linear row where all coordinates and their rates are zero, and ṫ = 1; `of` tells
/// what its operands are there.
fn at_origin(g: &mut Graph, node: Node, of: impl Fn(Node) -> Option<Node>) -> Option<Node> {
    let op = g.op(node);
    if g.operands(node).into_iter().all(|operand| of(operand) == Some(operand))
        && !matches!(op, Op::Input(_))
    {
        return Some(node);
    }
    Some(match op {
        Op::Input(Input::State(_, Part::Sin | Part::Cos)) => return None,
        Op::Input(Input::State(..) | Input::Rate(..)) => g.zero(),
        Op::Input(Input::TimeRate) => g.constant(1.0),
        Op::Input(_) => node,
        Op::Neg(a) => g.neg(of(a)?),
        Op::Powi(a, n) => g.powi(of(a)?, n),
        Op::Add(a, b) => g.add(of(a)?, of(b)?),
        Op::Sub(a, b) => g.sub(of(a)?, of(b)?),
        Op::Mul(a, b) => g.mul(of(a)?, of(b)?),
        _ => return None,
    })
}

/// Of what `outputs` need, the largest parts that depend on t and parameters alone and call a
/// function. Conditions are computed where they are used.
fn select(lowered: &Lowered, outputs: &[Node]) -> Vec<Node> {
    let g = &lowered.graph;
    let order = g.reachable(outputs);
    let found = |list: &[Node], node: &Node| list.binary_search(node).is_ok();
    let mut moving = Vec::new();
    let mut calling = Vec::new();
    for &node in &order {
        let operands = g.operands(node);
        let any = |list: &[Node]| operands.iter().any(|n| found(list, n));
        if matches!(
            g.op(node),
            Op::Input(Input::State(..) | Input::Rate(..) | Input::TimeRate | Input::Column(_))
        ) || any(&moving)
        {
            moving.push(node);
        } else if any(&calling)
            || matches!(
                g.op(node),
                Op::Call(..) | Op::Call2(..) | Op::Law(..) | Op::Opaque(..) | Op::Leaf(_)
            )
        {
            calling.push(node);
        }
    }
    let read = moving.iter().flat_map(|&node| g.operands(node)).chain(outputs.iter().copied());
    let mut timed: Vec<Node> =
        read.filter(|node| found(&calling, node) && !is_condition(lowered, *node)).collect();
    timed.sort_unstable();
    timed.dedup();
    timed
}

/// The outputs with what was evaluated once a time read where it stands.
pub fn read(g: &mut Graph, timed: &Timed, outputs: &[Node]) -> Vec<Node> {
    if timed.read.is_empty() {
        outputs.to_vec()
    } else {
        read_at(g, |node| timed.read.binary_search(&node).ok(), outputs)
    }
}

/// The outputs with nodes that were evaluated before read where they stand.
pub fn read_at(
    g: &mut Graph,
    place: impl Fn(Node) -> Option<usize>,
    outputs: &[Node],
) -> Vec<Node> {
    let nodes = g.reachable_from(outputs, |node| place(node).is_some());
    let mut read: Vec<Option<Node>> = vec![None; g.len()];
    for node in nodes {
        let built = match place(node) {
            Some(k) => g.input(Input::Timed(k)),
            None => g.with_operands(node, |operand| read[operand.index()].unwrap_or(operand)),
        };
        read[node.index()] = Some(built);
    }
    outputs.iter().map(|output| read[output.index()].unwrap_or(*output)).collect()
}

/// `n_timed` and `sides_of_time` of `Facts`; nothing where there is nothing of the kind.
pub fn facts(timed: &Timed) -> TokenStream {
    if timed.len() == 0 {
        return quote!();
    }
    let [n, first] = [timed.len(), timed.read.len()].map(Literal::usize_unsuffixed);
    let sides = (!timed.sides.is_empty())
        .then(|| quote!(sides_of_time: ::core::option::Option::Some(#first),));
    quote!(n_timed: #n, #sides)
}

/// `at_time`; nothing where there is nothing of the kind.
pub fn function(lowered: &Lowered, timed: &Timed) -> TokenStream {
    if timed.len() == 0 {
        return quote!();
    }
    let all: Vec<Node> = timed.read.iter().chain(&timed.sides).copied().collect();
    let (code, values) = Kernel::plain(lowered, &[]).values(&all);
    let doc = format!(" What depends on t and parameters alone: {} operations", code.operations);
    let code = code.tokens;
    quote! {
        #[doc = #doc]
        fn at_time(&self, t: f64, timed: &mut [f64]) {
            let ::core::option::Option::Some(timed) = timed.first_chunk_mut() else { return };
            let at = ::kin::emitted::At::new(t, &[], &[]);
            #code
            *timed = [#(#values),*];
        }
    }
}

/// The list that the other functions read; computed on the spot where nobody has asked before.
pub fn binding(timed: usize) -> TokenStream {
    let n = Literal::usize_unsuffixed(timed);
    quote! {
        let own: [f64; #n];
        let timed = match at.timed().first_chunk() {
            ::core::option::Option::Some(timed) => timed,
            ::core::option::Option::None => {
                own = ::kin::emitted::timed(self, at.t);
                &own
            }
        };
    }
}
