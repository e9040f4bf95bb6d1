//! Assignments: to variables, and to parts of them.

use quote::ToTokens;
use syn::{Expr, ExprPath};

use super::scope::{Name, Place};
use super::value::Value;
use super::{Read, Reader, Unreadable};

impl Reader {
    pub fn assignment(&mut self, assign: &syn::ExprAssign) -> Read {
        let value = self.raw_expression(&assign.right)?;
        if matches!(value, Value::Left) {
            return Ok(value);
        }
        self.assign(&assign.left, value).map(|()| Value::unit())
    }

    /// Reads `place = value`.
    pub fn assign(&mut self, place: &Expr, value: Value) -> Read<()> {
        match place {
            Expr::Paren(inner) => self.assign(&inner.expr, value),
            Expr::Infer(_) => Ok(()),
            Expr::Tuple(tuple) => self.assign_all(place, tuple.elems.iter(), value, "a tuple"),
            Expr::Array(array) => self.assign_all(place, array.elems.iter(), value, "an array"),
            Expr::Path(path) => self.assign_variable(path, value),
            Expr::Index(index) => self.assign_element(index, value),
            other => match self.place(other)? {
                Some(place) => {
                    self.change(other, &place);
                    let put = self.put_at(&place, value, other);
                    put.ok_or_else(|| Unreadable::new(other, "an assignment to this place"))
                }
                None => Err(Unreadable::new(other, "an assignment to this place")),
            },
        }
    }

    fn assign_all<'a>(
        &mut self,
        at: &Expr,
        places: impl ExactSizeIterator<Item = &'a Expr>,
        value: Value,
        what: &str,
    ) -> Read<()> {
        let values = match self.loaded(value) {
            Value::Tuple(all) if what == "a tuple" && all.len() == places.len() => all,
            Value::Array(all) if what == "an array" && all.len() == places.len() => all,
            Value::Poison => return Ok(()),
            Value::Opaque(_) => {
                return Err(Unreadable::new(at, "a pattern for a value of unknown type"));
            }
            other => {
                self.mistake(
                    at,
                    format!("the pattern takes {what} apart, but the value is {}", other.name()),
                );
                return Ok(());
            }
        };
        let mut pairs = places.zip(values);
        pairs.try_for_each(|(place, value)| self.assign(place, value))
    }

    /// Reads `whole[index] = value`, where the index may have several possible values.
    fn assign_element(&mut self, index: &syn::ExprIndex, value: Value) -> Read<()> {
        let left = Expr::Index(index.clone());
        if let Some(place) = self.place(&left)? {
            self.change(&left, &place);
            return self
                .put_at(&place, value, index)
                .ok_or_else(|| Unreadable::new(index, "an assignment to this place"));
        }
        let (Some(whole), Value::Choice(all)) =
            (self.place(&index.expr)?, self.expression(&index.index)?)
        else {
            return Err(Unreadable::new(index, "an assignment to this place"));
        };
        self.each(Value::Choice(all), index, &mut |reader, k| {
            let Value::Integer(k, _) = k else {
                return Err(Unreadable::new(&index.index, "an unknown index"));
            };
            let place = usize::try_from(k).ok().map(|k| whole.index(k));
            let put = place.and_then(|place| reader.put_at(&place, value.clone(), index));
            put.map(|()| Value::unit())
                .ok_or_else(|| Unreadable::new(index, "an assignment to this place"))
        })
        .map(drop)
    }

    fn assign_variable(&mut self, path: &ExprPath, value: Value) -> Read<()> {
        let name = path.to_token_stream().to_string();
        match path.path.get_ident().and_then(|name| self.scopes.get(&name.to_string())) {
            Some(Name::Variable(slot)) => {
                self.change(&Expr::Path(path.clone()), &Place::whole(slot));
                self.store.set(slot, value);
            }
            _ => drop(self.mistake(
                path,
                format!(
                    "no variable has the name `{name}`: declare the variable with `let mut {name}`"
                ),
            )),
        }
        Ok(())
    }
}
