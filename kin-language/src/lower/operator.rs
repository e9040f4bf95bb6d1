//! Operators, for every pair of kinds for which Rust has them.

mod compared;

use quote::ToTokens;
use syn::spanned::Spanned;
use syn::{BinOp, Expr, ExprBinary, UnOp};

use super::coerce::is_arithmetic;
use super::integer::{self, IntegerType};
use super::template::Template;
use super::value::{Components, Value};
use super::{Read, Reader, Unreadable};
use crate::error::tidy;
use crate::parse::Shape;
use kin_graph::{Comparison, Function2, Graph, Node};

/// Returns the power that `x ** 2` means, or `None` for any other product. Rust reads `x * (*2)`,
/// with a number behind a reference; formatted Rust has a space between the two signs.
fn taken_for_a_power(binary: &ExprBinary) -> Option<String> {
    let (BinOp::Mul(times), Expr::Unary(right)) = (&binary.op, &*binary.right) else {
        return None;
    };
    let UnOp::Deref(star) = right.op else { return None };
    let end = times.span.end();
    let is_literal = matches!(*right.expr, Expr::Lit(_));
    if !is_literal && (end.line == 0 || end != star.span.start()) {
        return None;
    }
    // `2 * x ** n` is read as (2 x) (*n), and `-x ** n` as (−x) (*n).
    let mut base = &*binary.left;
    loop {
        base = match base {
            Expr::Binary(inner) => &inner.right,
            Expr::Unary(inner) if matches!(inner.op, UnOp::Neg(_)) => &inner.expr,
            _ => break,
        };
    }
    let (sign, exponent) = match &*right.expr {
        Expr::Unary(inner) if matches!(inner.op, UnOp::Neg(_)) => ("-", &*inner.expr),
        other => ("", other),
    };
    let is_whole = matches!(exponent, Expr::Lit(lit) if matches!(lit.lit, syn::Lit::Int(_)));
    let method = if is_whole { "powi" } else { "powf" };
    let [base, exponent] = [base, exponent].map(|part| tidy(&part.to_token_stream().to_string()));
    Some(format!("{base}.{method}({sign}{exponent})"))
}

impl Reader {
    pub fn unary(&mut self, op: &UnOp, inner: &Expr) -> Read {
        let value = match op {
            UnOp::Deref(_) => self.dereferenced(inner)?,
            _ => self.expression(inner)?,
        };
        self.each(value, inner, &mut |reader, value| reader.unary_of(op, value, inner))
    }

    /// Reads `*value`: the value behind a reference, which may be a reference again.
    fn dereferenced(&mut self, inner: &Expr) -> Read {
        Ok(match self.raw_expression(inner)? {
            Value::Reference(inner) => *inner,
            Value::Place(place) => self.at_place(&place).unwrap_or(Value::Poison),
            value => value,
        })
    }

    fn unary_of(&mut self, op: &UnOp, value: Value, inner: &Expr) -> Read {
        Ok(match (op, value) {
            (UnOp::Deref(_), value) => value,
            (_, value @ (Value::Poison | Value::Never | Value::Left)) => value,
            (UnOp::Neg(_), Value::Integer(k, ty)) => integer::negated(k, ty)
                .ok_or_else(|| Unreadable::new(op, "integer arithmetic that may overflow"))?,
            (UnOp::Not(_), Value::Integer(k, ty)) => integer::inverted(k, ty).ok_or_else(|| {
                Unreadable::new(op, "`!` of an integer whose type is not known here")
            })?,
            (UnOp::Not(_), Value::Condition(c)) => Value::Condition(self.graph.not(c)),
            (UnOp::Not(_), Value::Opaque(template)) if !template.nodes().is_empty() => {
                let condition = self.condition(Value::Opaque(template), inner);
                Value::Condition(self.graph.not(condition))
            }
            (op, Value::Opaque(template)) => {
                Value::Opaque(template.each(&|part| Template::Unary(*op, Box::new(part))))
            }
            (op, value @ Value::Adt(_)) => self.unary_of_own(*op, value, inner)?,
            (UnOp::Neg(_), value)
                if value.components().is_some() || matches!(value, Value::Scalar(_)) =>
            {
                self.negated(value)
            }
            (op, other) => self.mistake(
                op,
                format!("`{}` does not apply to {}", op.to_token_stream(), other.name()),
            ),
        })
    }

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

    pub fn binary(&mut self, binary: &ExprBinary) -> Read {
        if let Some(written) = taken_for_a_power(binary) {
            return Ok(self.mistake(binary, format!("`**` is no power: write `{written}`")));
        }
        if let Some(op) = simple(&binary.op) {
            let right = self.expression(&binary.right)?;
            let left = self.assigned_to(&binary.left)?;
            if self.compound_own(op, &left, &right, binary)?.is_some() {
                return Ok(Value::unit());
            }
            let value = self.operate_each(op, left, right, binary)?;
            if matches!(value, Value::Left) {
                return Ok(value);
            }
            self.assign(&binary.left, value)?;
            return Ok(Value::unit());
        }
        let left = self.expression(&binary.left)?;
        let right = match binary.op {
            BinOp::And(_) | BinOp::Or(_) => self.second_condition(&binary.op, &left, binary)?,
            _ => self.expression(&binary.right)?,
        };
        self.operate_each(binary.op, left, right, binary)
    }

    /// Returns the value that a compound assignment changes. For a type of the body it is the value
    /// from `index_mut`, which may differ from that of `index`.
    fn assigned_to(&mut self, left: &Expr) -> Read {
        if let Expr::Index(index) = left
            && let Some(base) = self.looked_into(&index.expr)?
            && matches!(self.at_place(&base), Some(Value::Adt(_)))
            && let Some(place) = self.place(left)?
            && let Some(value) = self.at_place(&place)
        {
            return Ok(value);
        }
        self.expression(left)
    }

    /// Computes `left op right` for each combination of possible values.
    fn operate_each(&mut self, op: BinOp, left: Value, right: Value, at: &ExprBinary) -> Read {
        self.each_list(vec![left, right], at, &mut |reader, mut sides| match (
            sides.pop(),
            sides.pop(),
        ) {
            (Some(right), Some(left)) => reader.operate(op, left, right, at),
            _ => Ok(Value::Poison),
        })
    }

    /// Reads the right side of `&&` and `||`, which emitted code does not compute where the left
    /// side decides.
    fn second_condition(&mut self, op: &BinOp, left: &Value, binary: &ExprBinary) -> Read {
        if !matches!(left, Value::Condition(_) | Value::Opaque(_)) {
            return self.expression(&binary.right);
        }
        let first = self.condition(left.clone(), &binary.left);
        let is_and = matches!(op, BinOp::And(_));
        let needed = if is_and { first } else { self.graph.not(first) };
        let mut right = Value::Condition(self.graph.bool(!is_and));
        let read = |reader: &mut Self| {
            let value = reader.expression(&binary.right)?;
            match value {
                Value::Left => return Ok(Value::Left),
                value => right = value,
            }
            Ok(Value::unit())
        };
        self.choose(needed, read, |_| Ok(Value::unit()), binary)?;
        Ok(right)
    }

    /// Computes `left op right`.
    fn operate(&mut self, op: BinOp, left: Value, right: Value, at: &ExprBinary) -> Read {
        let number = |value: &Value| matches!(value, Value::Scalar(_) | Value::Vector(_));
        Ok(match (left, right) {
            (Value::Poison, _) | (_, Value::Poison) => Value::Poison,
            (Value::Left, _) | (_, Value::Left) => Value::Left,
            (Value::Never, _) | (_, Value::Never) => Value::Never,
            (left @ Value::Adt(_), right) | (left, right @ Value::Adt(_)) => self.operate_own(op, left, right, at)?,
            (left, right) if matches!(op, BinOp::BitXor(_)) && (number(&left) || number(&right)) => {
                self.mistake(&at.op, "`^` is not a power: write `x.powi(2)`, or `x.powf(y)` for an exponent that is not a whole number")
            }
            (Value::Opaque(a), Value::Opaque(b)) => self.operate_opaque(op, a, b, at)?,
            (Value::Opaque(a), right) => self.operate_beside(op, a, right, false, at)?,
            (left, Value::Opaque(b)) => self.operate_beside(op, b, left, true, at)?,
            (Value::Integer(a, x), Value::Integer(b, y)) => return self.integers(op, (a, x), (b, y), at),
            (Value::Condition(a), Value::Condition(b)) => self.conditions(op, a, b, at)?,
            (left, right) => match comparison(&op) {
                Some(comparison) => self.compared(comparison, op, &left, &right, at)?,
                None => match self.arithmetic(op, &left, &right) {
                    Some(value) => value,
                    None => self.operator_mistake(op, &left, &right, at),
                },
            },
        })
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
    fn arithmetic(&mut self, op: BinOp, left: &Value, right: &Value) -> Option<Value> {
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

    fn scalars(&mut self, op: BinOp, a: Node, b: Node) -> Option<Node> {
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

    fn each_with(
        &mut self,
        value: &Value,
        s: Node,
        f: fn(&mut Graph, Node, Node) -> Node,
    ) -> Option<Value> {
        let (kind, nodes) = value.components()?;
        Some(kind.value(nodes.iter().map(|&n| f(&mut self.graph, n, s)).collect()))
    }

    fn pairs(
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

    pub fn matrix_matrix(&mut self, n: usize, a: &[Node], b: &[Node]) -> Vec<Node> {
        let columns = super::state::transpose(b);
        (0..n * n).map(|k| self.dot(&a[k / n * n..][..n], &columns[k % n * n..][..n])).collect()
    }

    /// Combines values that only rustc knows. Their place decides their type, but the operands of a
    /// comparison are numbers.
    fn operate_opaque(&mut self, op: BinOp, a: Template, b: Template, at: &ExprBinary) -> Read {
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

    /// Combines an opaque value with a known one; the opaque value is on the left unless `swapped`.
    fn operate_beside(
        &mut self,
        op: BinOp,
        opaque: Template,
        known: Value,
        swapped: bool,
        at: &ExprBinary,
    ) -> Read {
        let (place, other_place) =
            if swapped { (&at.right, &at.left) } else { (&at.left, &at.right) };
        let factor = matches!(op, BinOp::Mul(_)) || matches!(op, BinOp::Div(_)) && !swapped;
        let shape = match (&known, op) {
            (Value::Integer(..), _) => None,
            (Value::Scalar(_), _) if factor => None,
            (Value::Condition(_), _) => {
                let condition = Value::Condition(self.condition(Value::Opaque(opaque), place));
                let (left, right) = if swapped { (known, condition) } else { (condition, known) };
                return self.operate(op, left, right, at);
            }
            (known, BinOp::Add(_) | BinOp::Sub(_) | BinOp::Eq(_) | BinOp::Ne(_)) => {
                Some(known.numbers().map_or(Shape::Scalar, |(_, shape)| shape))
            }
            _ => Some(Shape::Scalar),
        };
        let Some(shape) = shape else {
            // A factor may apply to a number or to a vector, and an integer may have any integer
            // type.
            let known = self.template(known, other_place)?;
            let (left, right) = if swapped { (known, opaque) } else { (opaque, known) };
            return Ok(Value::Opaque(Template::Binary(Box::new(left), op, Box::new(right))));
        };
        let taken = self.shaped(Value::Opaque(opaque), &shape, place);
        let (left, right) = if swapped { (known, taken) } else { (taken, known) };
        self.operate(op, left, right, at)
    }

    fn integers(
        &mut self,
        op: BinOp,
        a: (i64, Option<IntegerType>),
        b: (i64, Option<IntegerType>),
        at: &ExprBinary,
    ) -> Read {
        if let Some(comparison) = comparison(&op) {
            return Ok(Value::Condition(self.graph.bool(comparison.holds(&a.0, &b.0))));
        }
        // Rustc computes an operation that may overflow, and reports it at this token.
        integer::operate(&op, a, b)
            .ok_or_else(|| Unreadable::new(&at.op, "integer arithmetic that may overflow"))
    }

    fn operator_mistake(
        &mut self,
        op: BinOp,
        left: &Value,
        right: &Value,
        at: &ExprBinary,
    ) -> Value {
        let sign = op.to_token_stream().to_string();
        for (value, other, place) in [(left, right, &at.left), (right, left, &at.right)] {
            let name = crate::error::tidy(&place.to_token_stream().to_string());
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

    /// Returns the quaternion product p q.
    pub fn euler_product(&mut self, p: &[Node], q: &[Node]) -> Vec<Node> {
        const TERMS: [[(usize, bool); 4]; 4] = [
            [(0, true), (1, false), (2, false), (3, false)],
            [(1, true), (0, true), (3, false), (2, true)],
            [(2, true), (3, true), (0, true), (1, false)],
            [(3, true), (2, false), (1, true), (0, true)],
        ];
        // Component k is Σ_j ± p_i q_j, with (i, sign) listed by j.
        let component = |reader: &mut Self, terms: &[(usize, bool); 4]| {
            let zero = reader.graph.zero();
            terms.iter().zip(q).fold(zero, |sum, (&(i, plus), &q)| {
                let product = reader.graph.mul(p[i], q);
                if plus { reader.graph.add(sum, product) } else { reader.graph.sub(sum, product) }
            })
        };
        TERMS.iter().map(|terms| component(self, terms)).collect()
    }
}

impl Components {
    pub fn len(self) -> usize {
        self.shape().count()
    }
}

fn comparison(op: &BinOp) -> Option<Comparison> {
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

/// Returns the operator of a compound assignment.
fn simple(op: &BinOp) -> Option<BinOp> {
    let span = op.span();
    Some(match op {
        BinOp::AddAssign(_) => BinOp::Add(syn::token::Plus(span)),
        BinOp::SubAssign(_) => BinOp::Sub(syn::token::Minus(span)),
        BinOp::MulAssign(_) => BinOp::Mul(syn::token::Star(span)),
        BinOp::DivAssign(_) => BinOp::Div(syn::token::Slash(span)),
        BinOp::RemAssign(_) => BinOp::Rem(syn::token::Percent(span)),
        BinOp::BitAndAssign(_) => BinOp::BitAnd(syn::token::And(span)),
        BinOp::BitOrAssign(_) => BinOp::BitOr(syn::token::Or(span)),
        BinOp::BitXorAssign(_) => BinOp::BitXor(syn::token::Caret(span)),
        BinOp::ShlAssign(_) => BinOp::Shl(syn::token::Shl(span)),
        BinOp::ShrAssign(_) => BinOp::Shr(syn::token::Shr(span)),
        _ => return None,
    })
}
