//! Writes expressions in infix form: `crank / 2.0`, `hypot(dx, dy)`.

use crate::{Function2, Graph, Node, Op};

/// Writes a node as text, or returns `None` if the text needs more than `longest` bytes.
///
/// The function `named` gives the names of inputs, and of other nodes. The text of an expression
/// that shares parts can have any length.
pub fn infix(
    graph: &Graph,
    node: Node,
    named: impl Fn(Node) -> Option<String>,
    longest: usize,
) -> Option<String> {
    let mut texts: Vec<(String, u8)> = vec![(String::new(), 0); graph.len()];
    for node in graph.reachable_from(&[node], |node| named(node).is_some()) {
        let text = named(node).map_or_else(|| text(graph, node, &texts), |name| (name, ATOM));
        if text.0.len() > longest {
            return None;
        }
        texts[node.index()] = text;
    }
    texts.get(node.index()).map(|(text, _)| text.clone())
}

/// How tightly operators hold together.
const SUM: u8 = 1;
const PRODUCT: u8 = 2;
const SIGN: u8 = 3;
const ATOM: u8 = 4;

/// A node as text of those of its operands, and how tightly it holds together.
fn text(graph: &Graph, node: Node, texts: &[(String, u8)]) -> (String, u8) {
    let within = |node: Node, least: u8| {
        let (text, tight) = &texts[node.index()];
        if *tight >= least { text.clone() } else { format!("({text})") }
    };
    let two = |a, sign: &str, b, left, right, tight| {
        (format!("{} {sign} {}", within(a, left), within(b, right)), tight)
    };
    match graph.op(node) {
        Op::Constant(bits) => match f64::from_bits(bits) {
            x if x < 0.0 => (format!("{x:?}"), SIGN),
            x => (format!("{x:?}"), ATOM),
        },
        Op::Add(a, b) => two(a, "+", b, SUM, PRODUCT, SUM),
        Op::Sub(a, b) => two(a, "-", b, SUM, PRODUCT, SUM),
        Op::Mul(a, b) => two(a, "*", b, PRODUCT, SIGN, PRODUCT),
        Op::Div(a, b) => two(a, "/", b, PRODUCT, SIGN, PRODUCT),
        Op::Call2(Function2::Rem, a, b) => two(a, "%", b, PRODUCT, SIGN, PRODUCT),
        Op::Neg(a) => (format!("-{}", within(a, SIGN)), SIGN),
        Op::Call(f, a) => (format!("{}({})", f.method(), within(a, 0)), ATOM),
        Op::Call2(f, a, b) => (format!("{}({}, {})", f.method(), within(a, 0), within(b, 0)), ATOM),
        Op::Powi(a, n) => (format!("powi({}, {n})", within(a, 0)), ATOM),
        _ => (String::new(), ATOM),
    }
}
