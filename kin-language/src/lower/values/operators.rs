//! Operators between values of the graph, for every pair of kinds for which Rust has them.

use quote::ToTokens;
use syn::spanned::Spanned;
use syn::{BinOp, ExprBinary};

use super::{IntegerType, Read, Template, Unreadable, Value, Values, integer, is_arithmetic};
use crate::parse::Shape;
use kin_graph::{Comparison, Function2, Graph, Node};

impl Values {
    /// Returns −value of a number or of components.
    pub fn negated(&mut self, value: Value) -> Value {
        match (value.components(), &value) {
            (Some((kind, nodes)), _) => {
                kind.value(nodes.iter().map(|&n| self.graph.neg(n)).collect())
            }
            (None, Value::Scalar(n)) => Value::Scalar(self.graph.neg(*n)),
            _ => Value::Poison,
        }
    }

    /// Computes `left op right` for an operator that exists for both kinds.
    pub fn combined(&mut self, op: BinOp, left: &Value, right: &Value, at: &dyn ToTokens) -> Value {
        if matches!(left, Value::Poison) || matches!(right, Value::Poison) {
            return Value::Poison;
        }
        self.arithmetic(op, left, right).unwrap_or_else(|| {
            self.mistake(
                at,
                format!(
                    "`{}` does not apply to {} and {}",
                    op.to_token_stream(),
                    left.name(),
                    right.name()
                ),
            )
        })
    }

    /// Computes `left op right` for numbers, vectors and matrices; returns `None` if Rust has no
    /// such operator.
    pub fn arithmetic(&mut self, op: BinOp, left: &Value, right: &Value) -> Option<Value> {
        Some(match (op, left, right) {
            (op, Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(self.scalars(op, *a, *b)?),
            (BinOp::Mul(_), Value::Matrix(n, m), Value::Vector(v)) if *n == v.len() => {
                Value::Vector(self.matrix_vector(m, v))
            }
            (BinOp::Mul(_), Value::Matrix(n, a), Value::Matrix(m, b)) if n == m => {
                Value::Matrix(*n, self.matrix_matrix(*n, a, b))
            }
            (BinOp::Mul(_), Value::Euler(p), Value::Euler(q)) => {
                Value::Euler(self.euler_product(p, q))
            }
            (BinOp::Mul(_), Value::Scalar(s), other) | (BinOp::Mul(_), other, Value::Scalar(s)) => {
                self.each_with(other, *s, Graph::mul)?
            }
            (BinOp::Div(_), left, Value::Scalar(s)) => self.each_with(left, *s, Graph::div)?,
            (BinOp::Add(_), left, right) => self.pairs(left, right, Graph::add)?,
            (BinOp::Sub(_), left, right) => self.pairs(left, right, Graph::sub)?,
            _ => return None,
        })
    }

    pub fn scalars(&mut self, op: BinOp, a: Node, b: Node) -> Option<Node> {
        let g = &mut self.graph;
        Some(match op {
            BinOp::Add(_) => g.add(a, b),
            BinOp::Sub(_) => g.sub(a, b),
            BinOp::Mul(_) => g.mul(a, b),
            BinOp::Div(_) => g.div(a, b),
            BinOp::Rem(_) => g.call2(Function2::Rem, a, b),
            _ => return None,
        })
    }

    pub fn each_with(
        &mut self,
        value: &Value,
        s: Node,
        f: fn(&mut Graph, Node, Node) -> Node,
    ) -> Option<Value> {
        let (kind, nodes) = value.components()?;
        Some(kind.value(nodes.iter().map(|&n| f(&mut self.graph, n, s)).collect()))
    }

    pub fn pairs(
        &mut self,
        left: &Value,
        right: &Value,
        f: fn(&mut Graph, Node, Node) -> Node,
    ) -> Option<Value> {
        let (kind, a) = left.components()?;
        let (other, b) = right.components()?;
        (kind == other)
            .then(|| kind.value(a.iter().zip(b).map(|(&a, &b)| f(&mut self.graph, a, b)).collect()))
    }

    /// Combines values that only rustc knows. Their place decides their type, but the operands of a
    /// comparison are numbers.
    pub fn operate_opaque(&mut self, op: BinOp, a: Template, b: Template, at: &ExprBinary) -> Read {
        let open = a.has_choice() || b.has_choice();
        let known = [&a, &b].iter().any(|template| self.varies(template));
        match (comparison(&op), op) {
            (Some(comparison), _) if open || known => {
                let a = self.scalar(Value::Opaque(a), &at.left);
                let b = self.scalar(Value::Opaque(b), &at.right);
                Ok(Value::Condition(self.graph.compare(comparison, a, b)))
            }
            (None, BinOp::And(_) | BinOp::Or(_)) if open => {
                let a = self.condition(Value::Opaque(a), &at.left);
                let b = self.condition(Value::Opaque(b), &at.right);
                self.conditions(op, a, b, at)
            }
            _ if open && !is_arithmetic(&op) => {
                Err(Unreadable::new(at, "this operator on one of two values of unknown type"))
            }
            _ => Ok(Value::Opaque(Template::Binary(Box::new(a), op, Box::new(b)))),
        }
    }

    pub fn integers(
        &mut self,
        op: BinOp,
        a: (i64, Option<IntegerType>),
        b: (i64, Option<IntegerType>),
        at: &ExprBinary,
    ) -> Read {
        if let Some(comparison) = comparison(&op) {
            return Ok(self.truth(comparison.holds(&a.0, &b.0)));
        }
        // Rustc computes an operation that may overflow, and reports it at this token.
        integer::operate(&op, a, b)
            .ok_or_else(|| Unreadable::new(&at.op, "integer arithmetic that may overflow"))
    }

    pub fn operator_mistake(
        &mut self,
        op: BinOp,
        left: &Value,
        right: &Value,
        at: &ExprBinary,
    ) -> Value {
        let sign = op.to_token_stream().to_string();
        for (value, other, place) in [(left, right, &at.left), (right, left, &at.right)] {
            let name = crate::error::tidy_text(place);
            let text = match value {
                Value::Law(_) => {
                    format!("`{name}` is a Law: get a value with `{name}.at(x)`")
                }
                Value::Planar(_) | Value::Spatial(_) => {
                    format!(
                        "`{name}` is the state of a body: use `{name}.r`, `{name}.point(u)`, `{name}.direction(h)`, …"
                    )
                }
                Value::Integer(k, _) if name == k.to_string() => {
                    format!("`{k}` is an integer: beside {} write `{k}.0`", other.name())
                }
                Value::Integer(k, _) => crate::error::integer_for_a_number(place, *k),
                _ => continue,
            };
            return self.mistake(place, text);
        }
        let cure = match (left, right) {
            (Value::Vector(_), Value::Vector(_)) if matches!(op, BinOp::Mul(_)) => {
                ": write `a.dot(b)` for the scalar product, `a.cross(b)` for the vector product"
            }
            (Value::Condition(_), _) | (_, Value::Condition(_)) => ": use a condition in an `if`",
            _ => "",
        };
        let text = format!("`{sign}` does not apply to {} and {}{cure}", left.name(), right.name());
        self.mistakes.push(syn::Error::new(at.op.span(), text));
        Value::Poison
    }

    pub fn conditions(&mut self, op: BinOp, a: Node, b: Node, at: &ExprBinary) -> Read {
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
    pub fn compared(
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
        let all = self.all_equal(&a, &b);
        Ok(self.equality(comparison, all))
    }

    /// Returns a condition that is known here.
    pub fn truth(&mut self, holds: bool) -> Value {
        Value::Condition(self.graph.bool(holds))
    }

    /// Returns the condition that numbers are equal in pairs.
    pub fn all_equal(&mut self, a: &[Node], b: &[Node]) -> Node {
        let always = self.graph.bool(true);
        a.iter().zip(b).fold(always, |all, (&a, &b)| {
            let one = self.graph.compare(Comparison::Equal, a, b);
            self.graph.and(all, one)
        })
    }

    /// Returns the value of `==` or `!=` from the condition that two values are equal.
    pub fn equality(&mut self, comparison: Comparison, same: Node) -> Value {
        Value::Condition(if comparison == Comparison::Equal { same } else { self.graph.not(same) })
    }
}

pub fn comparison(op: &BinOp) -> Option<Comparison> {
    Some(match op {
        BinOp::Lt(_) => Comparison::Less,
        BinOp::Le(_) => Comparison::LessEqual,
        BinOp::Gt(_) => Comparison::Greater,
        BinOp::Ge(_) => Comparison::GreaterEqual,
        BinOp::Eq(_) => Comparison::Equal,
        BinOp::Ne(_) => Comparison::NotEqual,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use crate::lower::values::{Value, Values};
    use kin_graph::{Comparison, Graph};
    use quote::quote;

    #[test]
    fn vectors_add_and_do_not_multiply() {
        let mut values = Values::new(Graph::default());
        let [a, b] = [[1.0, 2.0], [3.0, 4.0]]
            .map(|v| Value::Vector(v.map(|x| values.graph.constant(x)).to_vec()));
        let sum = values.combined(syn::parse_quote!(+), &a, &b, &quote!(a + b));
        let Value::Vector(sum) = sum else { panic!("a sum of vectors is a vector") };
        assert_eq!(
            sum.iter().map(|&n| values.graph.constant_value(n)).collect::<Vec<_>>(),
            [Some(4.0), Some(6.0)]
        );
        assert!(values.mistakes.is_empty());
        assert!(matches!(
            values.combined(syn::parse_quote!(*), &a, &b, &quote!(a * b)),
            Value::Poison
        ));
        assert!(!values.mistakes.is_empty());
    }

    #[test]
    fn equality_is_decided_for_all_numbers() {
        let mut values = Values::new(Graph::default());
        let [one, two] = [1.0, 2.0].map(|x| values.graph.constant(x));
        let same = values.all_equal(&[one, two], &[one, two]);
        let other = values.all_equal(&[one, two], &[one, one]);
        assert_eq!(values.graph.truth(same), Some(true));
        assert_eq!(values.graph.truth(other), Some(false));
        let differ = values.equality(Comparison::NotEqual, same);
        let truth = |value| match value {
            crate::lower::values::Value::Condition(node) => values.graph.truth(node),
            _ => None,
        };
        assert_eq!(truth(differ), Some(false));
    }
}
