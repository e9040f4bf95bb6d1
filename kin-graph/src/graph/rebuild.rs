//! Rebuilds operations of one graph in another graph, and folds and simplifies values that are
//! known by then.

use super::{Graph, Node, Op};

impl Graph {
    /// Rebuilds the operation with other operands by the constructors of this graph.
    ///
    /// Returns `None` for inputs, laws and foreign values, which the caller handles.
    pub fn rebuilt(&mut self, op: Op, of: impl Fn(Node) -> Node) -> Option<Node> {
        Some(match op {
            Op::Input(_) | Op::Opaque(..) | Op::Leaf(_) | Op::Law(..) | Op::Decimal(_) => {
                return None;
            }
            Op::Constant(bits) => self.constant(f64::from_bits(bits)),
            Op::Truth(holds) => self.bool(holds),
            Op::Add(a, b) => self.add(of(a), of(b)),
            Op::Sub(a, b) => self.sub(of(a), of(b)),
            Op::Mul(a, b) => self.mul(of(a), of(b)),
            Op::Div(a, b) => self.div(of(a), of(b)),
            Op::Fma(a, b, c) => {
                let product = self.mul(of(a), of(b));
                self.add(product, of(c))
            }
            Op::Neg(a) => self.neg(of(a)),
            Op::Call(f, a) => self.call(f, of(a)),
            Op::Call2(f, a, b) => self.call2(f, of(a), of(b)),
            Op::Powi(a, n) => self.powi(of(a), n),
            Op::Select(c, a, b) => self.select(of(c), of(a), of(b)),
            Op::Compare(comparison, a, b) => self.compare(comparison, of(a), of(b)),
            Op::And(a, b) => self.and(of(a), of(b)),
            Op::Or(a, b) => self.or(of(a), of(b)),
            Op::Not(a) => self.not(of(a)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Input;

    #[test]
    fn what_has_become_a_number_folds() {
        let mut from = Graph::default();
        let mut to = Graph::default();
        let x = from.input(Input::Column(0));
        let y = from.input(Input::Column(1));
        let product = from.mul(x, y);
        let own = to.input(Input::Time);
        let zero = to.zero();
        let of =
            |zero_for_x: bool| move |node: Node| if node == x && zero_for_x { zero } else { own };
        assert_eq!(to.rebuilt(from.op(product), of(true)), Some(zero));
        let square = to.mul(own, own);
        assert_eq!(
            (to.rebuilt(from.op(product), of(false)), to.rebuilt(from.op(x), of(false))),
            (Some(square), None)
        );
    }
}
