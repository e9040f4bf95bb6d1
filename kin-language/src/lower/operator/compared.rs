//! Comparisons, and operators on conditions.

use super::*;

impl Reader {
    pub(super) fn conditions(&mut self, op: BinOp, a: Node, b: Node, at: &ExprBinary) -> Read {
        let g = &mut self.graph;
        let differ = |g: &mut Graph| {
            let not_a = g.not(a);
            let not_b = g.not(b);
            let only_a = g.and(a, not_b);
            let only_b = g.and(not_a, b);
            g.or(only_a, only_b)
        };
        Ok(Value::Condition(match op {
            BinOp::And(_) | BinOp::BitAnd(_) => g.and(a, b),
            BinOp::Or(_) | BinOp::BitOr(_) => g.or(a, b),
            BinOp::BitXor(_) | BinOp::Ne(_) => differ(g),
            BinOp::Eq(_) => {
                let differ = differ(g);
                g.not(differ)
            }
            _ if comparison(&op).is_some() => {
                return Err(Unreadable::new(at, "an order of conditions"));
            }
            _ => {
                return Ok(self.operator_mistake(
                    op,
                    &Value::Condition(a),
                    &Value::Condition(b),
                    at,
                ));
            }
        }))
    }

    /// Compares numbers, or tests several of them for equality.
    pub(super) fn compared(
        &mut self,
        comparison: Comparison,
        op: BinOp,
        left: &Value,
        right: &Value,
        at: &ExprBinary,
    ) -> Read {
        if let (Value::Scalar(a), Value::Scalar(b)) = (left, right) {
            return Ok(Value::Condition(self.graph.compare(comparison, *a, *b)));
        }
        let (Some((a, shape)), Some((b, other))) = (left.numbers(), right.numbers()) else {
            return match (left, right) {
                (Value::Tuple(_) | Value::Array(_), Value::Tuple(_) | Value::Array(_)) => {
                    Err(Unreadable::new(at, "a comparison of these values"))
                }
                _ => Ok(self.operator_mistake(op, left, right, at)),
            };
        };
        if shape != other {
            return Ok(self.operator_mistake(op, left, right, at));
        }
        if !matches!(comparison, Comparison::Equal | Comparison::NotEqual) {
            return match shape {
                Shape::Tuple(_) | Shape::Array(..) => {
                    Err(Unreadable::new(at, "an order of tuples or arrays"))
                }
                _ => Ok(self.operator_mistake(op, left, right, at)),
            };
        }
        let always = self.graph.bool(true);
        let all = a.into_iter().zip(b).fold(always, |all, (a, b)| {
            let one = self.graph.compare(Comparison::Equal, a, b);
            self.graph.and(all, one)
        });
        Ok(Value::Condition(if comparison == Comparison::Equal {
            all
        } else {
            self.graph.not(all)
        }))
    }
}
