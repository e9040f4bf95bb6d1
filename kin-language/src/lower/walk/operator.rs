//! Operators: their operands, and operators that the body declares.

use quote::ToTokens;
use syn::spanned::Spanned;
use syn::{BinOp, Expr, ExprBinary, UnOp};

use super::Reader;
use crate::error::tidy;
use crate::lower::values::{
    Adt, Branching, Read, Template, Unreadable, Value, comparison, integer,
};
use crate::parse::Shape;
use kin_graph::Comparison;

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
        let mut right = self.truth(!is_and);
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

    /// Computes an operator on a struct or an enum.
    pub fn operate_own(&mut self, op: BinOp, left: Value, right: Value, at: &ExprBinary) -> Read {
        if let Some(value) = self.ordered_own(op, &left, &right, at)? {
            return Ok(value);
        }
        let compared = match op {
            BinOp::Eq(_) => Some(Comparison::Equal),
            BinOp::Ne(_) => Some(Comparison::NotEqual),
            _ => None,
        };
        if let (Some(ty), Some([method, _])) = (type_of(&left), methods(&op))
            && let Some(value) =
                self.own_method(&ty, method, vec![left.clone(), right.clone()], at)?
        {
            return Ok(value);
        }
        if let (Value::Adt(adt), Some(comparison)) = (&left, compared)
            && let Some(value) =
                self.own_method(&adt.type_name(), "eq", vec![left.clone(), right.clone()], at)?
        {
            let same = self.condition(value, at);
            return Ok(self.equality(comparison, same));
        }
        if let (Value::Adt(a), Value::Adt(b), Some(comparison)) = (&left, &right, compared)
            && let Some(same) = self.same(a, b)
        {
            return Ok(self.equality(comparison, same));
        }
        for (value, other, place) in [(&left, &right, &at.left), (&right, &left, &at.right)] {
            let number = matches!(
                other,
                Value::Scalar(_) | Value::Vector(_) | Value::Matrix(..) | Value::Integer(..)
            );
            if let (Value::Adt(Adt { name, .. }), true) = (value, number)
                && matches!(name.as_str(), "Some" | "None" | "Ok" | "Err")
            {
                let text = "the value may be `None`: write `if let Some(x) = …`, or give a default by `.unwrap_or(0.0)`";
                return Ok(self.mistake(place, text));
            }
        }
        let a = self.template(left, &at.left)?;
        let b = self.template(right, &at.right)?;
        Ok(Value::Opaque(Template::Binary(Box::new(a), op, Box::new(b))))
    }

    /// Computes `-value` and `!value` of a struct or an enum.
    pub fn unary_of_own(&mut self, op: UnOp, value: Value, at: &Expr) -> Read {
        let method = if matches!(op, UnOp::Neg(_)) { "neg" } else { "not" };
        if let Value::Adt(adt) = &value
            && let Some(value) =
                self.own_method(&adt.type_name(), method, vec![value.clone()], at)?
        {
            return Ok(value);
        }
        Ok(Value::Opaque(Template::Unary(op, Box::new(self.template(value, at)?))))
    }

    /// Reads `left += right` if the left side is a struct or an enum, or if operators made it from
    /// one.
    pub fn compound_own(
        &mut self,
        op: BinOp,
        left: &Value,
        right: &Value,
        at: &ExprBinary,
    ) -> Read<Option<()>> {
        let Some([_, method]) = methods(&op) else { return Ok(None) };
        match left {
            Value::Adt(adt) if self.own.is_type(&adt.type_name()) => {
                let Some(place) = self.looked_into(&at.left)? else {
                    return Err(Unreadable::new(&at.left, "an assignment to this place"));
                };
                let arguments = vec![Value::Place(place), right.clone()];
                return Ok(self.own_method(&adt.type_name(), method, arguments, at)?.map(drop));
            }
            Value::Adt(_) => {}
            Value::Opaque(template) if is_of_struct(template) => {}
            _ => return Ok(None),
        }
        let a = self.template(left.clone(), &at.left)?;
        let b = self.template(right.clone(), &at.right)?;
        let value = Value::Opaque(Template::Binary(Box::new(a), at.op, Box::new(b)));
        self.assign(&at.left, value).map(Some)
    }

    /// Compares two values of one type of the body, as in `a < b`; returns `None` if the type has
    /// no known order.
    fn ordered_own(
        &mut self,
        op: BinOp,
        left: &Value,
        right: &Value,
        at: &ExprBinary,
    ) -> Read<Option<Value>> {
        let (Value::Adt(a), Value::Adt(b)) = (left, right) else { return Ok(None) };
        let (names, swapped, or_equal): (&[&str], _, _) = match op {
            BinOp::Lt(_) => (&["Less"], false, false),
            BinOp::Le(_) => (&["Less", "Equal"], false, true),
            BinOp::Gt(_) => (&["Greater"], true, false),
            BinOp::Ge(_) => (&["Greater", "Equal"], true, true),
            _ => return Ok(None),
        };
        let borrowed =
            [left, right].map(|value| Value::Reference(Box::new(value.clone()))).to_vec();
        if let Some(order) = self.own_method(&a.type_name(), "partial_cmp", borrowed, at)? {
            let order = self.loaded(order);
            return self
                .each(order, at, &mut |reader, order| reader.is_one_of(order, names, at))
                .map(Some);
        }
        let (first, second) = if swapped { (b, a) } else { (a, b) };
        Ok(self.less(first, second).map(|(less, equal)| {
            Value::Condition(if or_equal { self.graph.or(less, equal) } else { less })
        }))
    }
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

/// Returns the name of an operator's method, and of the method of its compound assignment.
fn methods(op: &BinOp) -> Option<[&'static str; 2]> {
    Some(match op {
        BinOp::Add(_) => ["add", "add_assign"],
        BinOp::Sub(_) => ["sub", "sub_assign"],
        BinOp::Mul(_) => ["mul", "mul_assign"],
        BinOp::Div(_) => ["div", "div_assign"],
        BinOp::Rem(_) => ["rem", "rem_assign"],
        _ => return None,
    })
}

/// Returns the name of the type whose operators apply to a value.
fn type_of(value: &Value) -> Option<String> {
    match value {
        Value::Adt(adt) => Some(adt.type_name()),
        Value::Scalar(_) => Some("f64".into()),
        _ => None,
    }
}

/// Returns true for a struct, and for a value that operators make from one: such a type may have
/// `+=` without `+`.
fn is_of_struct(template: &Template) -> bool {
    match template {
        Template::Struct(..) => true,
        Template::Unary(_, a) => is_of_struct(a),
        Template::Binary(a, _, b) => is_of_struct(a) || is_of_struct(b),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use crate::lower::values::Value;
    use crate::lower::walk::Reader;
    use kin_graph::Graph;

    fn read(expression: syn::Expr) -> (Reader, Option<Value>) {
        let mut reader = Reader::new(Graph::default());
        let value = reader.expression(&expression).ok();
        (reader, value)
    }

    #[test]
    fn a_type_of_the_body_has_its_operators() {
        let (_, value) = read(syn::parse_quote!({
            struct Turns(i64);
            impl std::ops::Add for Turns {
                type Output = Turns;
                fn add(self, other: Turns) -> Turns {
                    Turns(self.0 + other.0)
                }
            }
            (Turns(2) + Turns(3)).0
        }));
        assert!(matches!(value, Some(Value::Integer(5, _))));
        let (reader, _) = read(syn::parse_quote!(1.0 + 2));
        assert!(!reader.mistakes.is_empty());
    }
}
