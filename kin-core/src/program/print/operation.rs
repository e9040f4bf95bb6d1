//! Prints one step of a tape in a dialect.

use kin_graph::text::{Dialect, Infix, Piece};
use kin_graph::{Comparison, Function, Function2};

use super::listing::{Line, Value};
use crate::program::tape::Kind;

/// Returns the operation of a line; `of` returns the text of an operand.
pub(super) fn operation(dialect: &dyn Dialect, line: &Line, of: impl Fn(Value) -> Piece) -> Piece {
    let [a, b, c] = line.operands.map(&of);
    let infix = |a: &Piece, operator, b: &Piece| dialect.infix(a, operator, b);
    match line.kind {
        Kind::Add => infix(&a, Infix::Sum, &b),
        Kind::Sub => infix(&a, Infix::Difference, &b),
        Kind::Mul | Kind::Both => infix(&a, Infix::Product, &b),
        Kind::Div => infix(&a, Infix::Quotient, &b),
        Kind::Neg => dialect.negative(&a),
        Kind::Fma | Kind::NegatedProduct | Kind::ProductLess | Kind::NegatedSum => {
            fused(dialect, line, &of)
        }
        Kind::LargerProduct => {
            let product = infix(&a, Infix::Product, &b);
            dialect.call2(Function2::Max, &c, &dialect.call(Function::Abs, &product))
        }
        Kind::SinCos => {
            dialect.call(if line.part == 1 { Function::Cos } else { Function::Sin }, &a)
        }
        Kind::One(f) => dialect.call(f, &a),
        Kind::Two(f) => dialect.call2(f, &a, &b),
        Kind::Power(n) => dialect.power(&a, n),
        Kind::Compare(comparison) => {
            let holds = infix(&a, Infix::Comparison(comparison), &b);
            dialect.choice(&holds, &dialect.number(1.0), &dialect.number(0.0))
        }
        Kind::Either => dialect.call2(Function2::Max, &a, &b),
        Kind::Not => infix(&dialect.number(1.0), Infix::Difference, &a),
        Kind::Select => {
            let zero = dialect.number(0.0);
            let holds = infix(&a, Infix::Comparison(Comparison::NotEqual), &zero);
            dialect.choice(&holds, &b, &c)
        }
        Kind::Law(law, order) => {
            let order = usize::from(order) + line.part;
            Piece::atom(format!("@N@_law{law}({}, {order})", a.text))
        }
    }
}

/// Returns a sum with a product, without factors 1 and terms 0.
fn fused(dialect: &dyn Dialect, line: &Line, of: &impl Fn(Value) -> Piece) -> Piece {
    let [a, b, c] = line.operands;
    let is = |value: Value, number: f64| matches!(value, Value::Number(x) if x == number);
    let alone = if is(b, 1.0) {
        Some(of(a))
    } else if is(a, 1.0) {
        Some(of(b))
    } else {
        None
    };
    let product = match alone {
        Some(factor) => factor,
        None => dialect.infix(&of(a), Infix::Product, &of(b)),
    };
    let without = is(c, 0.0);
    let c = of(c);
    match (line.kind, without) {
        (Kind::NegatedProduct | Kind::NegatedSum, true) => dialect.negative(&product),
        (_, true) => product,
        (Kind::NegatedProduct, false) => dialect.infix(&c, Infix::Difference, &product),
        (Kind::ProductLess, false) => dialect.infix(&product, Infix::Difference, &c),
        (Kind::NegatedSum, false) => dialect.negative(&dialect.infix(&product, Infix::Sum, &c)),
        _ => dialect.infix(&product, Infix::Sum, &c),
    }
}
