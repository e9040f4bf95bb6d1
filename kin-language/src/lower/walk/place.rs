//! Places, which can be assigned to and borrowed, and assignments to them.

use quote::ToTokens;
use syn::{Expr, ExprPath, Member, UnOp};

use super::Reader;
use crate::lower::values::{Branching, Name, Place, Read, Unreadable, Value};

impl Reader {
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

/// Returns true if an expression names a variable or a part of one, without a call.
fn is_place(expression: &Expr) -> bool {
    match expression {
        Expr::Path(_) => true,
        Expr::Paren(inner) => is_place(&inner.expr),
        Expr::Field(field) => is_place(&field.base),
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
    fn a_part_is_assigned_to_through_a_reference() {
        let (_, value) = read(syn::parse_quote!({
            let mut all = [[1, 2], [3, 4]];
            let row = &mut all[1];
            row[0] = 7;
            (all[0][0], _) = (5, 0);
            all[1][0] + all[0][0]
        }));
        assert!(matches!(value, Some(Value::Integer(12, _))));
        assert!(!read(syn::parse_quote!(x = 1.0)).0.mistakes.is_empty());
    }
}
