//! Operators on structs and enums: those that the body declares, and those that only rustc knows.

use syn::{BinOp, Expr, ExprBinary, UnOp};

use crate::lower::template::Template;
use crate::lower::value::{Adt, Value};
use crate::lower::{Read, Reader, Unreadable};
use kin_graph::{Comparison, Node};

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

impl Reader {
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
            let is_same = comparison == Comparison::Equal;
            return Ok(Value::Condition(if is_same { same } else { self.graph.not(same) }));
        }
        if let (Value::Adt(a), Value::Adt(b), Some(comparison)) = (&left, &right, compared)
            && let Some(same) = self.same(a, b)
        {
            return Ok(Value::Condition(if comparison == Comparison::Equal {
                same
            } else {
                self.graph.not(same)
            }));
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

    /// Returns the condition that `Some(order)` is an order with one of these names.
    fn is_one_of(&mut self, order: Value, names: &[&str], at: &ExprBinary) -> Read {
        let mut any = self.graph.bool(false);
        if let Value::Adt(Adt { fields, .. }) = order
            && let Some((_, order)) = fields.into_iter().next()
        {
            for name in names {
                let one = self.is_ordered(order.clone(), name, at)?;
                any = self.graph.or(any, one);
            }
        }
        Ok(Value::Condition(any))
    }

    /// Returns the conditions that one value is less than another, and that both are equal, as
    /// `#[derive(PartialOrd)]` defines them: by the order of the variants, then by the fields in
    /// order.
    fn less(&mut self, a: &Adt, b: &Adt) -> Option<(Node, Node)> {
        let declared =
            self.own.declared(&a.type_name()).filter(|declared| declared.derives("PartialOrd"))?;
        let place =
            |adt: &Adt| declared.variants.iter().position(|variant| variant.name == adt.name);
        if place(a) != place(b) {
            let less = place(a) < place(b);
            let equal = false;
            return Some((self.graph.bool(less), self.graph.bool(equal)));
        }
        let named = declared.fields.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
        // The fields of a tuple variant have numbers as names.
        let names = if named.is_empty() {
            a.fields.iter().map(|(name, _)| name.clone()).collect()
        } else {
            named
        };
        let mut less = self.graph.bool(false);
        let mut equal = self.graph.bool(true);
        for name in names {
            let (x, y) = match (a.field(&name)?, b.field(&name)?) {
                (Value::Integer(x, _), Value::Integer(y, _)) => {
                    let (x, y) = (x < y, x == y);
                    (self.graph.bool(x), self.graph.bool(y))
                }
                (Value::Scalar(x), Value::Scalar(y)) => {
                    let x = *x;
                    let y = *y;
                    (
                        self.graph.compare(Comparison::Less, x, y),
                        self.graph.compare(Comparison::Equal, x, y),
                    )
                }
                (Value::Adt(x), Value::Adt(y)) => self.less(&x.clone(), &y.clone())?,
                _ => return None,
            };
            let here = self.graph.and(equal, x);
            less = self.graph.or(less, here);
            equal = self.graph.and(equal, y);
        }
        Some((less, equal))
    }

    /// Returns the condition that two values of one type are equal, part by part.
    fn same(&mut self, a: &Adt, b: &Adt) -> Option<Node> {
        if a.name != b.name || a.fields.len() != b.fields.len() {
            return Some(self.graph.bool(false));
        }
        let mut all = self.graph.bool(true);
        for ((_, a), (_, b)) in a.fields.iter().zip(&b.fields) {
            let one = match (a, b) {
                (Value::Integer(a, _), Value::Integer(b, _)) => self.graph.bool(a == b),
                (Value::Adt(a), Value::Adt(b)) => self.same(a, b)?,
                (a, b) => {
                    let (a, shape) = a.numbers()?;
                    let (b, other) = b.numbers()?;
                    (shape == other).then_some(())?;
                    let mut same = self.graph.bool(true);
                    for (a, b) in a.into_iter().zip(b) {
                        let one = self.graph.compare(Comparison::Equal, a, b);
                        same = self.graph.and(same, one);
                    }
                    same
                }
            };
            all = self.graph.and(all, one);
        }
        Some(all)
    }
}
