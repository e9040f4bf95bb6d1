//! Places: variables and parts of them, which can be assigned to and borrowed.

use quote::ToTokens;
use syn::{Expr, Member, UnOp};

use super::scope::{Name, Place, Step};
use super::value::{Value, entry, position};
use super::{Read, Reader};

impl Reader {
    /// Declares a variable in the innermost scope.
    pub fn declare(&mut self, name: String, value: Value) {
        let slot = self.store.declare(value);
        self.scopes.declare(name, slot);
    }

    /// Returns the value of a name.
    pub fn named(&self, name: &str) -> Option<&Value> {
        match self.scopes.get(name)? {
            Name::Variable(slot) => Some(self.store.get(slot)),
            Name::Item(value) => Some(value),
        }
    }

    /// Returns the value behind a reference, or any other value unchanged.
    pub fn loaded(&self, value: Value) -> Value {
        match value.referent() {
            Value::Place(place) => {
                self.at_place(&place).map_or(Value::Poison, |value| self.loaded(value))
            }
            Value::Choice(all) => Value::Choice(
                all.into_iter().map(|(taken, value)| (taken, self.loaded(value))).collect(),
            ),
            other => other,
        }
    }

    /// Returns the value at a place.
    pub fn at_place(&self, place: &Place) -> Option<Value> {
        let mut value = self.store.get(place.slot);
        for (k, step) in place.steps.iter().enumerate() {
            value = match (through(value), step) {
                (Value::Place(inner), _) => {
                    let inner = Place {
                        slot: inner.slot,
                        steps: inner.steps.iter().chain(&place.steps[k..]).cloned().collect(),
                    };
                    return self.at_place(&inner);
                }
                (Value::Array(all), Step::Index(k)) => all.get(*k)?,
                (Value::Tuple(all), Step::Field(name)) => all.get(name.parse::<usize>().ok()?)?,
                (Value::Adt(adt), Step::Field(name)) => adt.field(name)?,
                (other, _) => return part(other.clone(), &place.steps[k..]),
            };
        }
        Some(value.clone())
    }

    /// Stores a value at a place, and returns `None` if the place does not exist.
    pub fn put_at(&mut self, place: &Place, value: Value, at: &dyn ToTokens) -> Option<()> {
        let mut whole = self.store.get(place.slot).clone();
        if let (Value::Place(inner), true) = (through(&whole), !place.steps.is_empty()) {
            let inner = Place {
                slot: inner.slot,
                steps: inner.steps.iter().chain(&place.steps).cloned().collect(),
            };
            return self.put_at(&inner, value, at);
        }
        self.put(&mut whole, &place.steps, value, at)?;
        self.store.set(place.slot, whole);
        Some(())
    }

    fn put(
        &mut self,
        whole: &mut Value,
        steps: &[Step],
        value: Value,
        at: &dyn ToTokens,
    ) -> Option<()> {
        let Some((step, rest)) = steps.split_first() else {
            if let Value::Place(inner) = whole {
                let inner = inner.clone();
                return self.put_at(&inner, value, at);
            }
            *whole = value;
            return Some(());
        };
        if let Value::Place(inner) = whole {
            let inner = Place {
                slot: inner.slot,
                steps: inner.steps.iter().chain(steps).cloned().collect(),
            };
            return self.put_at(&inner, value, at);
        }
        match (whole, step) {
            (Value::Reference(inner), _) => self.put(inner, steps, value, at),
            (Value::Choice(all), _) => {
                all.iter_mut().try_for_each(|(_, one)| self.put(one, steps, value.clone(), at))
            }
            (Value::Tuple(all), Step::Field(name)) => {
                self.put(all.get_mut(name.parse::<usize>().ok()?)?, rest, value, at)
            }
            (Value::Array(all), Step::Index(k)) => self.put(all.get_mut(*k)?, rest, value, at),
            (Value::Adt(adt), Step::Field(name)) => self.put(adt.field_mut(name)?, rest, value, at),
            (Value::Array(all), Step::Slice(from, to)) => {
                let mut part = Value::Array(all.get(*from..*to)?.to_vec());
                self.put(&mut part, rest, value, at)?;
                let Value::Array(part) = part else { return None };
                (part.len() == to - from).then(|| all.splice(*from..*to, part).for_each(drop))
            }
            (Value::Matrix(n, m), Step::Index(k)) => {
                // Row and column are two steps.
                let [Step::Index(column)] = rest else { return None };
                let node = self.scalar(value, at);
                (*column < *n).then_some(())?;
                m.get_mut(k * *n + column).map(|place| *place = node)
            }
            (Value::Poison, _) => Some(()),
            (whole, step) => {
                rest.is_empty().then_some(())?;
                let node = self.scalar(value, at);
                let (nodes, k) = component(whole, step)?;
                nodes.get_mut(k).map(|place| *place = node)
            }
        }
    }

    /// Returns the place of an expression, if it has one with a known value.
    pub fn place(&mut self, expression: &Expr) -> Read<Option<Place>> {
        Ok(match expression {
            Expr::Paren(inner) => self.place(&inner.expr)?,
            Expr::Group(inner) => self.place(&inner.expr)?,
            Expr::Path(path) => {
                match path.path.get_ident().and_then(|name| self.scopes.get(&name.to_string())) {
                    Some(Name::Variable(slot)) => Some(Place { slot, steps: vec![] }),
                    _ => None,
                }
            }
            Expr::Field(field) => self
                .looked_into(&field.base)?
                .map(|base| base.field(&field.member.to_token_stream().to_string())),
            Expr::Index(index) => return self.indexed_place(index),
            Expr::Unary(unary) if matches!(unary.op, UnOp::Deref(_)) => {
                self.looked_into(&unary.expr)?
            }
            Expr::MethodCall(call)
                if matches!(
                    call.method.to_string().as_str(),
                    "as_mut" | "as_mut_slice" | "borrow_mut" | "by_ref"
                ) =>
            {
                self.looked_into(&call.receiver)?
            }
            Expr::MethodCall(_) | Expr::Call(_) => match self.raw_expression(expression)? {
                Value::Place(place) => Some(place),
                _ => None,
            },
            Expr::Reference(inner) => self.looked_into(&inner.expr)?,
            _ => None,
        })
    }

    /// Returns the place of an expression whose part is read, following references.
    pub fn looked_into(&mut self, expression: &Expr) -> Read<Option<Place>> {
        let Some(place) = self.place(expression)? else { return Ok(None) };
        Ok(Some(match self.at_place(&place) {
            Some(Value::Place(inner)) => inner,
            _ => place,
        }))
    }

    fn indexed_place(&mut self, index: &syn::ExprIndex) -> Read<Option<Place>> {
        let Some(base) = self.looked_into(&index.expr)? else { return Ok(None) };
        if let Expr::Range(range) = &*index.index {
            let Some(Value::Array(all)) = self.at_place(&base) else { return Ok(None) };
            let (from, to) = self.bounds_of(range, all.len())?;
            return Ok((from <= to && to <= all.len()).then(|| base.slice(from, to)));
        }
        let at = self.expression(&index.index)?;
        if let Some(Value::Adt(adt)) = self.at_place(&base) {
            let arguments = vec![Value::Place(base), at];
            return Ok(match self.own_method(&adt.type_name(), "index_mut", arguments, index)? {
                Some(Value::Place(place)) => Some(place),
                _ => None,
            });
        }
        let known = |value: &Value| {
            if let Value::Integer(k, _) = value { usize::try_from(*k).ok() } else { None }
        };
        Ok(match at {
            Value::Tuple(pair) => {
                match pair.iter().map(known).collect::<Option<Vec<usize>>>().as_deref() {
                    Some([row, column]) => Some(base.index(*row).index(*column)),
                    _ => None,
                }
            }
            value => known(&value).map(|k| base.index(k)),
        })
    }

    /// Returns `base.member` if the base is a place.
    pub fn field_of_place(&mut self, base: &Expr, member: &Member) -> Read<Option<Value>> {
        let Some(place) = (if is_place(base) { self.looked_into(base)? } else { None }) else {
            return Ok(None);
        };
        let name = member.to_token_stream().to_string();
        // Only a composite value has parts here. For any other value the caller reads the field
        // from the whole.
        Ok(match self.at_place(&place) {
            Some(Value::Tuple(_) | Value::Adt(_)) => self.at_place(&place.field(&name)),
            _ => None,
        })
    }
}

/// Returns true if an expression names a variable or a part of one, without a call.
fn is_place(expression: &Expr) -> bool {
    match expression {
        Expr::Path(_) => true,
        Expr::Paren(inner) => is_place(&inner.expr),
        Expr::Field(field) => is_place(&field.base),
        _ => false,
    }
}

fn through(value: &Value) -> &Value {
    match value {
        Value::Reference(inner) => through(inner),
        value => value,
    }
}

/// Returns the part of a value at the end of some steps.
fn part(value: Value, steps: &[Step]) -> Option<Value> {
    let Some((step, rest)) = steps.split_first() else { return Some(value) };
    match (value.referent(), step) {
        (Value::Array(all), Step::Slice(from, to)) => {
            part(Value::Array(all.get(*from..*to)?.to_vec()), rest)
        }
        (Value::Array(all), Step::Index(k)) => part(all.get(*k)?.clone(), rest),
        (Value::Matrix(n, m), Step::Index(row)) => match rest {
            [Step::Index(column)] if *column < n => {
                m.get(row * n + column).copied().map(Value::Scalar)
            }
            _ => None,
        },
        (Value::Choice(all), _) => {
            let parts = all.into_iter().map(|(taken, value)| Some((taken, part(value, steps)?)));
            parts.collect::<Option<Vec<_>>>().map(Value::Choice)
        }
        (mut value, step) => {
            let (nodes, k) = component(&mut value, step)?;
            nodes.get(k).copied().filter(|_| rest.is_empty()).map(Value::Scalar)
        }
    }
}

/// Returns the numbers of a value with components, and the index of the selected one.
fn component<'a>(
    value: &'a mut Value,
    step: &Step,
) -> Option<(&'a mut Vec<kin_graph::Node>, usize)> {
    match (value, step) {
        (Value::Vector(v), Step::Field(name)) => {
            let k = position(name, &["x", "y", "z"][..v.len()])?;
            Some((v, k))
        }
        (Value::Euler(p), Step::Field(name)) => {
            position(name, &["e0", "e1", "e2", "e3"]).map(|k| (p, k))
        }
        (Value::Matrix(n, m), Step::Field(name)) => entry(name, *n).map(|k| (m, k)),
        (Value::Vector(v) | Value::Euler(v), Step::Index(k)) => Some((v, *k)),
        _ => None,
    }
}
