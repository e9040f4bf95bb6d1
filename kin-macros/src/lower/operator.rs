//! Operators, over every pair of kinds for which Rust has them.

use quote::ToTokens;
use syn::spanned::Spanned;
use syn::{BinOp, Expr, ExprBinary, UnOp};

use super::value::{Template, Value};
use super::{Read, Reader, Unreadable};
use crate::graph::{Comparison, Function2, Graph, Node};
use crate::parse::Shape;

impl Reader {
    pub fn unary(&mut self, op: &UnOp, inner: &Expr) -> Read {
        let value = self.expression(inner)?;
        Ok(match (op, value) {
            (UnOp::Deref(_), value) => value,
            (_, Value::Poison) => Value::Poison,
            (UnOp::Neg(_), Value::Integer(k)) => Value::Integer(k.wrapping_neg()),
            (UnOp::Neg(_), Value::Scalar(n)) => Value::Scalar(self.graph.neg(n)),
            (UnOp::Neg(_), Value::Vector(v)) => Value::Vector(self.each(&v, Graph::neg)),
            (UnOp::Neg(_), Value::Matrix(n, m)) => Value::Matrix(n, self.each(&m, Graph::neg)),
            (UnOp::Neg(_), Value::Combined(terms)) => {
                let minus = self.graph.constant(-1.0);
                self.scale_terms(terms, minus)
            }
            (UnOp::Not(_), Value::Condition(c)) => Value::Condition(self.graph.not(c)),
            (op, Value::Opaque(template)) => match template.nodes().is_empty() {
                true => Value::Opaque(Template::Unary(*op, Box::new(template))),
                false => {
                    let n = self.scalar(Value::Opaque(template), inner);
                    Value::Scalar(self.graph.neg(n))
                }
            },
            (op, other) => self.mistake(op, format!("`{}` does not apply to {}", op.to_token_stream(), other.name())),
        })
    }

    fn each(&mut self, all: &[Node], f: fn(&mut Graph, Node) -> Node) -> Vec<Node> {
        all.iter().map(|&n| f(&mut self.graph, n)).collect()
    }

    pub fn binary(&mut self, binary: &ExprBinary) -> Read {
        if let Some(op) = simple(&binary.op) {
            let right = self.expression(&binary.right)?;
            let left = self.expression(&binary.left)?;
            let value = self.operate(op, left, right, binary)?;
            self.assign(&binary.left, value)?;
            return Ok(super::statement::unit());
        }
        let left = self.expression(&binary.left)?;
        let right = self.expression(&binary.right)?;
        self.operate(binary.op, left, right, binary)
    }

    /// `left op right`.
    fn operate(&mut self, op: BinOp, left: Value, right: Value, at: &ExprBinary) -> Read {
        use Value::{Combined, Condition, Integer, Matrix, Opaque, Poison, Scalar, Vector};
        Ok(match (op, left, right) {
            (_, Poison, _) | (_, _, Poison) => Poison,
            (op, Opaque(a), Opaque(b)) => self.operate_opaque(op, a, b, at)?,
            (op, Opaque(a), Integer(k)) => {
                let b = self.template(Integer(k), at);
                self.operate_opaque(op, a, b, at)?
            }
            (op, Integer(k), Opaque(b)) => {
                let a = self.template(Integer(k), at);
                self.operate_opaque(op, a, b, at)?
            }
            (BinOp::Mul(_), Opaque(a), Scalar(n)) | (BinOp::Mul(_), Scalar(n), Opaque(a)) => Combined(vec![(a, n)]),
            (BinOp::Mul(_), Combined(terms), Scalar(n)) | (BinOp::Mul(_), Scalar(n), Combined(terms)) => self.scale_terms(terms, n),
            (BinOp::Div(_), Opaque(a), Scalar(n)) => Combined(vec![(a, self.reciprocal(n, at))]),
            (BinOp::Div(_), Combined(terms), Scalar(n)) => {
                let factor = self.reciprocal(n, at);
                self.scale_terms(terms, factor)
            }
            (BinOp::Add(_) | BinOp::Sub(_), a @ (Opaque(_) | Combined(_)), b @ (Opaque(_) | Combined(_))) => self.combine(op, a, b),
            (op, terms @ Combined(_), right) => {
                let shape = self.shape_beside(op, &right);
                let left = self.shaped(terms, &shape, &at.left);
                self.operate(op, left, right, at)?
            }
            (op, left, terms @ Combined(_)) => {
                let shape = self.shape_beside(op, &left);
                let right = self.shaped(terms, &shape, &at.right);
                self.operate(op, left, right, at)?
            }
            (op, Opaque(a), right) => {
                let left = self.beside(op, a, &right, &at.left);
                self.operate(op, left, right, at)?
            }
            (op, left, Opaque(b)) => {
                let right = self.beside(op, b, &left, &at.right);
                self.operate(op, left, right, at)?
            }
            (op, Integer(a), Integer(b)) => return self.integers(op, a, b, at),
            (op, Scalar(a), Scalar(b)) => self.scalars(op, a, b, at),
            (BinOp::And(_), Condition(a), Condition(b)) => Condition(self.graph.and(a, b)),
            (BinOp::Or(_), Condition(a), Condition(b)) => Condition(self.graph.or(a, b)),
            (BinOp::BitAnd(_), Condition(a), Condition(b)) => Condition(self.graph.and(a, b)),
            (BinOp::BitOr(_), Condition(a), Condition(b)) => Condition(self.graph.or(a, b)),
            (BinOp::Add(_), Vector(a), Vector(b)) if a.len() == b.len() => Vector(self.pairs(&a, &b, Graph::add)),
            (BinOp::Sub(_), Vector(a), Vector(b)) if a.len() == b.len() => Vector(self.pairs(&a, &b, Graph::sub)),
            (BinOp::Add(_), Matrix(n, a), Matrix(m, b)) if n == m => Matrix(n, self.pairs(&a, &b, Graph::add)),
            (BinOp::Sub(_), Matrix(n, a), Matrix(m, b)) if n == m => Matrix(n, self.pairs(&a, &b, Graph::sub)),
            (BinOp::Mul(_), Vector(v), Scalar(s)) | (BinOp::Mul(_), Scalar(s), Vector(v)) => Vector(self.scaled(&v, s, Graph::mul)),
            (BinOp::Mul(_), Matrix(n, m), Scalar(s)) | (BinOp::Mul(_), Scalar(s), Matrix(n, m)) => Matrix(n, self.scaled(&m, s, Graph::mul)),
            (BinOp::Div(_), Vector(v), Scalar(s)) => {
                let v = self.scaled(&v, s, Graph::div);
                v.iter().for_each(|&n| self.risk(n, at));
                Vector(v)
            }
            (BinOp::Mul(_), Matrix(n, m), Vector(v)) if n == v.len() => Vector(self.matrix_vector(&m, &v)),
            (BinOp::Mul(_), Matrix(n, a), Matrix(m, b)) if n == m => Matrix(n, self.matrix_matrix(n, &a, &b)),
            (op, left, right) => self.operator_mistake(op, &left, &right, at),
        })
    }

    /// What an opaque value is taken for beside a known one.
    fn beside(&mut self, op: BinOp, template: Template, known: &Value, at: &Expr) -> Value {
        if let BinOp::And(_) | BinOp::Or(_) = op {
            return Value::Condition(self.condition(Value::Opaque(template), at));
        }
        let shape = self.shape_beside(op, known);
        self.shaped(Value::Opaque(template), &shape, at)
    }

    fn scale_terms(&mut self, terms: Vec<(Template, Node)>, factor: Node) -> Value {
        Value::Combined(terms.into_iter().map(|(template, n)| (template, self.graph.mul(n, factor))).collect())
    }

    /// a ± b, where one of them is a sum of opaque values already.
    fn combine(&mut self, op: BinOp, a: Value, b: Value) -> Value {
        let one = self.graph.constant(1.0);
        let terms = |value| match value {
            Value::Combined(terms) => terms,
            Value::Opaque(template) => vec![(template, one)],
            _ => vec![],
        };
        let (mut all, b) = (terms(a), terms(b));
        let minus = matches!(op, BinOp::Sub(_));
        all.extend(b.into_iter().map(|(template, n)| (template, if minus { self.graph.neg(n) } else { n })));
        Value::Combined(all)
    }

    /// The shape that a value of unknown shape has beside a known one.
    fn shape_beside(&self, op: BinOp, known: &Value) -> Shape {
        match (op, known) {
            (BinOp::Add(_) | BinOp::Sub(_), Value::Vector(v)) => Shape::Vector(v.len()),
            (BinOp::Add(_) | BinOp::Sub(_), Value::Matrix(n, _)) => Shape::Matrix(*n),
            _ => Shape::Scalar,
        }
    }

    /// 1/n
    fn reciprocal(&mut self, n: Node, at: &ExprBinary) -> Node {
        let reciprocal = self.graph.powi(n, -1);
        self.risk(reciprocal, at);
        reciprocal
    }

    /// Between values that only rustc knows, unless one of them carries derivatives.
    fn operate_opaque(&mut self, op: BinOp, a: Template, b: Template, at: &ExprBinary) -> Read {
        let varies = |reader: &Self, t: &Template| t.nodes().iter().any(|&n| reader.graph.depends(n).varies());
        if varies(self, &a) || varies(self, &b) {
            if let BinOp::Add(_) | BinOp::Sub(_) = op {
                return Ok(self.combine(op, Value::Opaque(a), Value::Opaque(b)));
            }
            let (a, b) = (self.scalar(Value::Opaque(a), &at.left), self.scalar(Value::Opaque(b), &at.right));
            return Ok(self.scalars(op, a, b, at));
        }
        Ok(Value::Opaque(Template::Binary(Box::new(a), op, Box::new(b))))
    }

    fn integers(&mut self, op: BinOp, a: i64, b: i64, at: &ExprBinary) -> Read {
        let known = |value: Option<i64>| value.map(Value::Integer).ok_or_else(|| Unreadable::new(at, "integer arithmetic out of range"));
        let truth = |reader: &mut Self, value| Ok(Value::Condition(reader.graph.bool(value)));
        match op {
            BinOp::Add(_) => known(a.checked_add(b)),
            BinOp::Sub(_) => known(a.checked_sub(b)),
            BinOp::Mul(_) => known(a.checked_mul(b)),
            BinOp::Div(_) => known(a.checked_div(b)),
            BinOp::Rem(_) => known(a.checked_rem(b)),
            BinOp::Eq(_) => truth(self, a == b),
            BinOp::Ne(_) => truth(self, a != b),
            BinOp::Lt(_) => truth(self, a < b),
            BinOp::Le(_) => truth(self, a <= b),
            BinOp::Gt(_) => truth(self, a > b),
            BinOp::Ge(_) => truth(self, a >= b),
            BinOp::Shl(_) => known(u32::try_from(b).ok().and_then(|b| a.checked_shl(b))),
            BinOp::Shr(_) => known(u32::try_from(b).ok().and_then(|b| a.checked_shr(b))),
            BinOp::BitAnd(_) => known(Some(a & b)),
            BinOp::BitOr(_) => known(Some(a | b)),
            BinOp::BitXor(_) => known(Some(a ^ b)),
            _ => Err(Unreadable::new(at, "this operator on integers")),
        }
    }

    fn scalars(&mut self, op: BinOp, a: Node, b: Node, at: &ExprBinary) -> Value {
        let g = &mut self.graph;
        let comparison = match op {
            BinOp::Add(_) => return Value::Scalar(g.add(a, b)),
            BinOp::Sub(_) => return Value::Scalar(g.sub(a, b)),
            BinOp::Mul(_) => return Value::Scalar(g.mul(a, b)),
            BinOp::Div(_) => {
                let quotient = g.div(a, b);
                self.risk(quotient, at);
                return Value::Scalar(quotient);
            }
            BinOp::Rem(_) => {
                let rest = g.call2(Function2::Rem, a, b);
                self.risk(rest, at);
                return Value::Scalar(rest);
            }
            BinOp::Lt(_) => Comparison::Less,
            BinOp::Le(_) => Comparison::LessEqual,
            BinOp::Gt(_) => Comparison::Greater,
            BinOp::Ge(_) => Comparison::GreaterEqual,
            BinOp::Eq(_) => Comparison::Equal,
            BinOp::Ne(_) => Comparison::NotEqual,
            _ => return self.operator_mistake(op, &Value::Scalar(a), &Value::Scalar(b), at),
        };
        Value::Condition(g.compare(comparison, a, b))
    }

    fn pairs(&mut self, a: &[Node], b: &[Node], f: fn(&mut Graph, Node, Node) -> Node) -> Vec<Node> {
        a.iter().zip(b).map(|(&a, &b)| f(&mut self.graph, a, b)).collect()
    }

    pub fn scaled(&mut self, v: &[Node], s: Node, f: fn(&mut Graph, Node, Node) -> Node) -> Vec<Node> {
        v.iter().map(|&n| f(&mut self.graph, n, s)).collect()
    }

    pub fn matrix_matrix(&mut self, n: usize, a: &[Node], b: &[Node]) -> Vec<Node> {
        let columns = super::state::transpose(b);
        (0..n * n).map(|k| self.dot(&a[k / n * n..][..n], &columns[k % n * n..][..n])).collect()
    }

    fn operator_mistake(&mut self, op: BinOp, left: &Value, right: &Value, at: &ExprBinary) -> Value {
        let sign = op.to_token_stream().to_string();
        let place = |value: &Value| if std::ptr::eq(value, left) { &at.left } else { &at.right };
        for value in [left, right] {
            if let Value::Law(_) = value {
                let name = super::tidy(&place(value).to_token_stream().to_string());
                return self.mistake(place(value), format!("`{name}` is a Law: ask it for a value with `{name}.at(x)`"));
            }
            if let Value::Planar(_) | Value::Spatial(_) = value {
                let name = super::tidy(&place(value).to_token_stream().to_string());
                let text = format!("`{name}` is the state of a body: use `{name}.r`, `{name}.point(u)`, `{name}.direction(h)`, …");
                return self.mistake(place(value), text);
            }
            if let Value::Integer(k) = value {
                return self.mistake(place(value), format!("`{k}` is an integer; beside {} write `{k}.0`", other(left, right, value).name()));
            }
        }
        let cure = match (left, right) {
            (Value::Vector(_), Value::Vector(_)) if matches!(op, BinOp::Mul(_)) => "; the scalar product is `a.dot(b)`, the vector product `a.cross(b)`",
            (Value::Condition(_), _) | (_, Value::Condition(_)) => "; a condition belongs into `if`",
            _ => "",
        };
        self.mistakes.push(syn::Error::new(
            at.op.span(),
            format!("there is no `{sign}` between {} and {}{cure}", left.name(), right.name()),
        ));
        Value::Poison
    }
}

fn other<'a>(left: &'a Value, right: &'a Value, this: &Value) -> &'a Value {
    if std::ptr::eq(this, left) { right } else { left }
}

/// The operator of a compound assignment.
fn simple(op: &BinOp) -> Option<BinOp> {
    let span = op.span();
    Some(match op {
        BinOp::AddAssign(_) => BinOp::Add(syn::token::Plus(span)),
        BinOp::SubAssign(_) => BinOp::Sub(syn::token::Minus(span)),
        BinOp::MulAssign(_) => BinOp::Mul(syn::token::Star(span)),
        BinOp::DivAssign(_) => BinOp::Div(syn::token::Slash(span)),
        BinOp::RemAssign(_) => BinOp::Rem(syn::token::Percent(span)),
        _ => return None,
    })
}
