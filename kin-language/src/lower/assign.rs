//! Assignments: to variables, and to parts of them.

use quote::ToTokens;
use syn::{Expr, Member};

use super::expression::{entry, position};
use super::scope::OutsideClosure;
use super::value::Value;
use super::{Read, Reader, Unreadable};

impl Reader {
    pub fn assignment(&mut self, assign: &syn::ExprAssign) -> Read {
        let value = self.expression(&assign.right)?;
        self.assign(&assign.left, value).map(|()| Value::unit())
    }

    /// `place = value`
    pub fn assign(&mut self, place: &Expr, value: Value) -> Read<()> {
        match place {
            Expr::Paren(inner) => self.assign(&inner.expr, value),
            Expr::Infer(_) => Ok(()),
            Expr::Tuple(tuple) => self.assign_all(place, tuple.elems.iter(), value, "a tuple"),
            Expr::Array(array) => self.assign_all(place, array.elems.iter(), value, "an array"),
            Expr::Path(path) => self.assign_variable(path, value),
            Expr::Field(field) => {
                let mut whole = self.expression(&field.base)?;
                match self.put_field(&mut whole, &field.member, value) {
                    Some(()) => self.assign(&field.base, whole),
                    None => Err(Unreadable::new(place, "an assignment to this place")),
                }
            }
            Expr::Index(index) => {
                let mut whole = self.expression(&index.expr)?;
                let at = self.expression(&index.index)?;
                match self.put_element(&mut whole, &at, value, index) {
                    Some(()) => self.assign(&index.expr, whole),
                    None => Err(Unreadable::new(place, "an assignment to this place")),
                }
            }
            other => Err(Unreadable::new(other, "an assignment to this place")),
        }
    }

    fn assign_all<'a>(&mut self, at: &Expr, places: impl ExactSizeIterator<Item = &'a Expr>, value: Value, what: &str) -> Read<()> {
        let values = match value {
            Value::Tuple(all) if what == "a tuple" && all.len() == places.len() => all,
            Value::Array(all) if what == "an array" && all.len() == places.len() => all,
            Value::Poison => return Ok(()),
            Value::Opaque(_) => return Err(Unreadable::new(at, "taking apart a value of unknown type")),
            other => {
                self.mistake(at, format!("this takes {what} apart, but the value is {}", other.name()));
                return Ok(());
            }
        };
        let mut pairs = places.zip(values);
        pairs.try_for_each(|(place, value)| self.assign(place, value))
    }

    fn put_field(&mut self, whole: &mut Value, member: &Member, value: Value) -> Option<()> {
        let name = member.to_token_stream().to_string();
        match whole {
            Value::Tuple(all) => name.parse::<usize>().ok().and_then(|k| all.get_mut(k)).map(|place| *place = value),
            Value::Vector(v) => {
                let node = self.scalar(value, member);
                position(&name, &["x", "y", "z"][..v.len()]).map(|k| v[k] = node)
            }
            Value::Euler(p) => {
                let node = self.scalar(value, member);
                position(&name, &["e0", "e1", "e2", "e3"]).map(|k| p[k] = node)
            }
            Value::Matrix(n, m) => {
                let node = self.scalar(value, member);
                entry(&name, *n).map(|k| m[k] = node)
            }
            Value::Poison => Some(()),
            _ => None,
        }
    }

    fn put_element(&mut self, whole: &mut Value, at: &Value, value: Value, index: &syn::ExprIndex) -> Option<()> {
        let place = |k: &i64| usize::try_from(*k).ok();
        match (whole, at) {
            (Value::Array(all), Value::Integer(k, _)) => all.get_mut(place(k)?).map(|place| *place = value),
            (Value::Vector(v) | Value::Euler(v), Value::Integer(k, _)) => {
                let node = self.scalar(value, index);
                v.get_mut(place(k)?).map(|place| *place = node)
            }
            (Value::Matrix(n, m), Value::Tuple(pair)) => {
                let [Value::Integer(row, _), Value::Integer(column, _)] = &pair[..] else { return None };
                let (row, column) = (place(row)?, place(column)?);
                let node = self.scalar(value, index);
                (column < *n).then_some(())?;
                m.get_mut(row * *n + column).map(|place| *place = node)
            }
            (Value::Poison, _) | (_, Value::Poison) => Some(()),
            _ => None,
        }
    }

    fn assign_variable(&mut self, path: &syn::ExprPath, value: Value) -> Read<()> {
        let name = path.path.get_ident().map(ToString::to_string).unwrap_or_default();
        let place = match self.scopes.get_mut(&name) {
            Ok(place) => place,
            Err(OutsideClosure) => return Err(Unreadable::new(path, "a closure that changes a variable around it")),
        };
        match place {
            Some(Value::Reference(_)) => return Err(Unreadable::new(path, "an assignment through a reference")),
            Some(place) => *place = value,
            None => drop(self.mistake(path, format!("there is no variable `{name}` to assign to"))),
        }
        Ok(())
    }
}
