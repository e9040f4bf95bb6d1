//! Numbers converted to integers. If the bounds of the number are known, the result is a choice
//! among several integers.

use super::*;
use kin_graph::{Comparison, Function2, Node, Op};

/// The most integers in such a choice.
const MOST_INTEGERS: i64 = 64;

impl Reader {
    /// Reads `x.clamp(0.0, 9.0) as usize`: the integer below x, as a choice among several.
    pub(super) fn whole_of(&mut self, x: Node, name: &str, cast: &syn::ExprCast) -> Read {
        let unknown = || Unreadable::new(&cast.as_token, "a cast of a number to an integer");
        let (low, high) = self.bounds(x).ok_or_else(unknown)?;
        // Below zero `as` rounds upwards.
        if !(low >= 0.0 && high <= 1e9 && fits(high as i64, name)) {
            return Err(unknown());
        }
        let low = low as i64;
        let high = high as i64;
        if high - low >= MOST_INTEGERS {
            return Err(unknown());
        }
        let integer = |k: i64| Value::Integer(k, IntegerType::named(name));
        let at_least = |reader: &mut Self, k: i64| {
            let k = reader.graph.constant(k as f64);
            reader.graph.compare(Comparison::GreaterEqual, x, k)
        };
        let mut all = Vec::new();
        let mut above = self.graph.bool(false);
        for k in (low + 1..=high).rev() {
            let reached = at_least(self, k);
            let not_above = self.graph.not(above);
            all.push((self.graph.and(reached, not_above), integer(k)));
            above = reached;
        }
        // The lowest integer comes last, because `as` makes it from NaN too if it is 0.
        all.push((self.graph.not(above), integer(low)));
        Ok(if all.len() == 1 { integer(low) } else { Value::Choice(all) })
    }

    /// Returns constants between which a number lies, from `clamp`, `min` and `max`.
    fn bounds(&self, x: Node) -> Option<(f64, f64)> {
        let constant = |node: Node| self.graph.constant_value(node);
        match self.graph.op(x) {
            Op::Call(kin_graph::Function::Floor, inner) => {
                let (low, high) = self.bounds(inner)?;
                Some((low.floor(), high.floor()))
            }
            Op::Call2(Function2::Min, inner, bound) | Op::Call2(Function2::Max, inner, bound) => {
                let is_min = matches!(self.graph.op(x), Op::Call2(Function2::Min, ..));
                let (inner, bound) = match (constant(inner), constant(bound)) {
                    (None, Some(bound)) => (inner, bound),
                    (Some(other), None) => (bound, other),
                    _ => return None,
                };
                let (low, high) = self.bounds(inner).unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
                Some(if is_min {
                    (low.min(bound), high.min(bound))
                } else {
                    (low.max(bound), high.max(bound))
                })
            }
            _ => None,
        }
    }
}
