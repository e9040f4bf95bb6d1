//! Iterators without an end. The interpreter makes as many values as another iterator or method
//! needs.

use std::rc::Rc;

use quote::ToTokens;
use syn::Expr;

use super::function::Function;
use super::integer::{self, IntegerType};
use super::value::Value;
use super::{MOST_TURNS, Read, Reader, Unreadable};

/// An iterator without an end.
#[derive(Clone)]
pub enum Endless {
    /// `3..`
    From(i64, Option<IntegerType>),
    /// `repeat(x)`, `list.iter().cycle()`
    Cycle(Vec<Value>),
    /// `successors(first, next)`
    Successors(Box<Value>, Function),
    /// `endless.map(f)`
    Mapped(Rc<Endless>, Function),
    /// `endless.skip(n)`
    Skipped(Rc<Endless>, usize),
    /// `endless.step_by(n)`
    Stepped(Rc<Endless>, usize),
}

impl Reader {
    /// Returns the first `n` values, or fewer if the iterator ends before.
    pub fn first_of_endless(
        &mut self,
        endless: &Endless,
        n: usize,
        at: &dyn ToTokens,
    ) -> Read<Vec<Value>> {
        if n as i64 > MOST_TURNS {
            return Err(Unreadable::new(at, format!("a loop of more than {MOST_TURNS} turns")));
        }
        match endless {
            Endless::From(start, ty) => (0..n as i64)
                .map(|k| {
                    start.checked_add(k).and_then(|value| integer::made(value, *ty, &[*start]))
                })
                .collect::<Option<_>>()
                .ok_or_else(|| Unreadable::new(at, "integer arithmetic that may overflow")),
            Endless::Cycle(all) => Ok(all.iter().cycle().take(n).cloned().collect()),
            Endless::Successors(first, next) => self.successors(first, next, n, at),
            Endless::Mapped(inner, f) => {
                let all = self.first_of_endless(inner, n, at)?;
                all.into_iter().map(|value| self.apply(f, vec![value], &[], at)).collect()
            }
            Endless::Skipped(inner, k) => {
                let all = self.first_of_endless(inner, n.saturating_add(*k), at)?;
                Ok(all.into_iter().skip(*k).collect())
            }
            Endless::Stepped(inner, k) => {
                let all = self.first_of_endless(inner, n.saturating_mul(*k), at)?;
                Ok(all.into_iter().step_by(*k).collect())
            }
        }
    }

    fn successors(
        &mut self,
        first: &Value,
        next: &Function,
        n: usize,
        at: &dyn ToTokens,
    ) -> Read<Vec<Value>> {
        let mut all = Vec::new();
        let mut value = first.clone();
        while all.len() < n {
            let found = match self.loaded(value) {
                Value::Adt(adt) if adt.name == "None" => break,
                Value::Adt(adt) if adt.name == "Some" => adt.fields.into_iter().next(),
                _ => None,
            };
            let Some((_, found)) = found else {
                return Err(Unreadable::new(at, "`successors` whose end is open here"));
            };
            value = self.apply(next, vec![Value::Reference(Box::new(found.clone()))], &[], at)?;
            all.push(found);
        }
        Ok(all)
    }

    /// Calls a method of an iterator without an end.
    pub fn endless_method(
        &mut self,
        endless: Endless,
        arguments: &[Value],
        whole: &syn::ExprMethodCall,
    ) -> Read {
        let name = whole.method.to_string();
        let place = whole.args.first().unwrap_or(&whole.receiver);
        let argument = arguments.first().cloned().map(Value::referent);
        Ok(match (name.as_str(), argument) {
            ("copied" | "cloned" | "fuse" | "by_ref" | "into_iter", None) => {
                Value::Endless(endless)
            }
            ("map", Some(f)) => {
                Value::Endless(Endless::Mapped(Rc::new(endless), self.function(f, place)?))
            }
            ("take" | "skip" | "step_by", Some(Value::Integer(k, _))) => {
                let k = usize::try_from(k)
                    .map_err(|_| Unreadable::new(place, "a count out of range"))?;
                match name.as_str() {
                    "take" => Value::Iterator(self.first_of_endless(&endless, k, whole)?),
                    "skip" => Value::Endless(Endless::Skipped(Rc::new(endless), k)),
                    _ if k == 0 => return Err(Unreadable::new(place, "a step of zero")),
                    _ => Value::Endless(Endless::Stepped(Rc::new(endless), k)),
                }
            }
            ("zip", Some(other)) => {
                let Some(other) = self.elements(other, place)? else { return Ok(Value::Poison) };
                let own = self.first_of_endless(&endless, other.len(), whole)?;
                Value::Iterator(
                    own.into_iter().zip(other).map(|(a, b)| Value::Tuple(vec![a, b])).collect(),
                )
            }
            ("take_while", Some(f)) => {
                let f = self.function(f, place)?;
                Value::Iterator(self.taken_while(&endless, &f, whole)?)
            }
            _ => {
                let what = format!("`{name}` of an iterator without an end");
                return Err(Unreadable::new(&whole.method, what));
            }
        })
    }

    /// Returns the values before the first one for which a condition does not hold; the condition
    /// must be known during the reading.
    fn taken_while(
        &mut self,
        endless: &Endless,
        f: &Function,
        at: &dyn ToTokens,
    ) -> Read<Vec<Value>> {
        let mut all = Vec::new();
        loop {
            let values = self.first_of_endless(endless, all.len() + 1, at)?;
            let Some(value) = values.into_iter().nth(all.len()) else { return Ok(all) };
            let holds = self.apply(f, vec![Value::Reference(Box::new(value.clone()))], &[], at)?;
            let holds = self.condition(holds, at);
            match self.graph.truth(holds) {
                Some(true) => all.push(value),
                Some(false) => return Ok(all),
                None => {
                    let what = "a loop over something of unknown length";
                    return Err(Unreadable::new(at, what));
                }
            }
        }
    }

    /// Reads `repeat(x)`, `repeat_n(x, n)`, `successors(first, next)`; returns `None` for any other
    /// function.
    pub fn endless_by_path(
        &mut self,
        name: &str,
        arguments: &[Value],
        places: &[&Expr],
        at: &dyn ToTokens,
    ) -> Read {
        Ok(match (name, arguments) {
            ("repeat", [value]) => Value::Endless(Endless::Cycle(vec![value.clone()])),
            ("repeat_n", [value, Value::Integer(n, _)]) if (0..=MOST_TURNS).contains(n) => {
                Value::Iterator(vec![value.clone(); *n as usize])
            }
            ("successors", [first, next]) if places.len() == 2 => {
                let next = self.function(next.clone(), &places[1])?;
                Value::Endless(Endless::Successors(Box::new(first.clone()), next))
            }
            _ => return Err(Unreadable::new(at, "this iterator")),
        })
    }
}
