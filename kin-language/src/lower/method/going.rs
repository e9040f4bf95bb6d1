//! Methods of arrays and iterators that select elements, or that apply a function to each element.

use super::Call;
use super::changing::given;
use crate::lower::endless::Endless;
use crate::lower::function::Function;
use crate::lower::scope::Place;
use crate::lower::value::Value;
use crate::lower::{Read, Reader, Unreadable};
use kin_graph::Node;

impl Reader {
    /// Calls a method that returns one element, or some of them.
    pub(super) fn picked(&mut self, mut all: Vec<Value>, call: &Call) -> Read {
        let count = match call.arguments.first() {
            None => 0,
            Some(Value::Integer(k, _)) => usize::try_from(*k)
                .map_err(|_| Unreadable::new(call.places[0], "an index out of range"))?,
            Some(_) => {
                return Err(Unreadable::new(call.places[0], "an unknown index"));
            }
        };
        let option = |value: Option<Value>| Ok(value.map_or(Value::none(), Value::some));
        let borrowed = |value: Value| Value::Reference(Box::new(value));
        match call.name.as_str() {
            "cycle" if !all.is_empty() => Ok(Value::Endless(Endless::Cycle(all))),
            "first" => option(all.into_iter().next().map(borrowed)),
            "next" => option(all.into_iter().next()),
            "last" => option(all.pop()),
            "nth" => option(all.into_iter().nth(count)),
            "get" => option(all.into_iter().nth(count).map(borrowed)),
            "count" => Ok(Value::count(all.len())),
            "split_at" if count <= all.len() => {
                let rest = all.split_off(count);
                Ok(Value::Tuple(vec![Value::Array(all), Value::Array(rest)]))
            }
            "split_first" | "split_last" if all.is_empty() => Ok(Value::none()),
            "split_first" => {
                let rest = all.split_off(1);
                option(Some(Value::Tuple(vec![borrowed(all.remove(0)), Value::Array(rest)])))
            }
            "split_last" => {
                let last = all.pop().unwrap_or(Value::Poison);
                option(Some(Value::Tuple(vec![borrowed(last), Value::Array(all)])))
            }
            // The conversion into an array keeps the length, which rustc compares with the declared
            // one.
            "try_into" => {
                Ok(Value::Adt(crate::lower::value::Adt::new("Ok", Some(Value::Array(all)))))
            }
            "unzip" => {
                let mut left = Vec::new();
                let mut right = Vec::new();
                for pair in all {
                    match self.loaded(pair) {
                        Value::Tuple(mut pair) if pair.len() == 2 => {
                            right.extend(pair.pop());
                            left.extend(pair.pop());
                        }
                        _ => {
                            return Err(Unreadable::new(
                                &call.whole.method,
                                "`unzip` of these values",
                            ));
                        }
                    }
                }
                Ok(Value::Tuple(vec![Value::Array(left), Value::Array(right)]))
            }
            _ => Err(Unreadable::new(&call.whole.method, "an index out of range")),
        }
    }

    /// Calls a method that applies a function to the elements one by one.
    pub(super) fn gone_over(&mut self, all: Vec<Value>, call: &Call) -> Read {
        let Some(k) = call.arguments.len().checked_sub(1) else {
            return Err(Unreadable::new(&call.whole.method, "this method"));
        };
        let f = self.function(call.arguments[k].clone(), call.places[k])?;
        let borrowed = |value: &Value| Value::Reference(Box::new(value.clone()));
        match call.name.as_str() {
            "for_each" => {
                for value in all {
                    self.apply(&f, vec![value], &[], call)?;
                }
                Ok(Value::unit())
            }
            "reduce" => {
                let mut all = all.into_iter();
                let Some(first) = all.next() else { return Ok(Value::none()) };
                all.try_fold(first, |sum, value| self.apply(&f, vec![sum, value], &[], call))
                    .map(Value::some)
            }
            "min_by" | "max_by" => {
                let is_min = call.name == "min_by";
                let mut all = all.into_iter();
                let Some(first) = all.next() else { return Ok(Value::none()) };
                let best = all.try_fold(first, |best, value| {
                    let order =
                        self.apply(&f, vec![borrowed(&best), borrowed(&value)], &[], call)?;
                    // Among equal elements, the first one is the minimum and the last one the
                    // maximum.
                    let worse = self.is_ordered(order, "Greater", given(call.whole))?;
                    let (held, other) = if is_min { (&value, &best) } else { (&best, &value) };
                    self.joined(worse, held, other, call)
                });
                best.map(Value::some)
            }
            "scan" => self.scanned(all, &f, call),
            "position" | "find" | "partition_point" => {
                let mut conditions = Vec::new();
                for value in &all {
                    let input =
                        if call.name == "position" { value.clone() } else { borrowed(value) };
                    let holds = self.apply(&f, vec![input], &[], call)?;
                    conditions.push(self.condition(holds, call));
                }
                if call.name == "partition_point" {
                    return self.count_before(&conditions, call);
                }
                self.first_of(&all, &conditions, call)
            }
            _ => self.cut(all, &f, call),
        }
    }

    /// Reads `scan`: the function changes a variable from element to element.
    fn scanned(&mut self, all: Vec<Value>, f: &Function, call: &Call) -> Read {
        if !self.counted(2, call) {
            return Ok(Value::Poison);
        }
        let state = self.store.declare(call.arguments[0].clone());
        let place = Value::Place(Place::whole(state));
        let mut found = Vec::new();
        for value in all {
            match self.apply(f, vec![place.clone(), value], &[], call)? {
                Value::Adt(adt) if adt.name == "Some" => {
                    found.extend(adt.fields.into_iter().map(|(_, value)| value))
                }
                Value::Adt(adt) if adt.name == "None" => break,
                _ => {
                    return Err(Unreadable::new(
                        &call.whole.method,
                        "a `scan` whose end is open here",
                    ));
                }
            }
        }
        Ok(Value::Iterator(found))
    }

    /// Cuts a list at the first element that fails a condition. If the position depends on
    /// coordinates, the result is one of several lists.
    fn cut(&mut self, all: Vec<Value>, f: &Function, call: &Call) -> Read {
        let name = call.name.as_str();
        let takes = name == "take_while";
        if name == "map_while" {
            return self.mapped_while(all, f, call);
        }
        let mut conditions = Vec::new();
        for value in &all {
            let holds =
                self.apply(f, vec![Value::Reference(Box::new(value.clone()))], &[], call)?;
            conditions.push(self.condition(holds, call));
        }
        let mut cut = Value::Iterator(if takes { all.clone() } else { vec![] });
        for (k, &condition) in conditions.iter().enumerate().rev() {
            let here = Value::Iterator(if takes { all[..k].to_vec() } else { all[k..].to_vec() });
            cut = match self.graph.truth(condition) {
                Some(true) => cut,
                Some(false) => here,
                None => {
                    let ends = self.graph.not(condition);
                    self.joined(ends, &here, &cut, call)?
                }
            };
        }
        Ok(cut)
    }

    fn mapped_while(&mut self, all: Vec<Value>, f: &Function, call: &Call) -> Read {
        let mut kept = Vec::new();
        for value in all {
            match self.apply(f, vec![value], &[], call)? {
                Value::Adt(adt) if adt.name == "Some" => {
                    kept.extend(adt.fields.into_iter().map(|(_, value)| value))
                }
                Value::Adt(_) => break,
                _ => return Err(Unreadable::new(&call.whole.method, "an end that is open here")),
            }
        }
        Ok(Value::Iterator(kept))
    }

    /// Returns how many conditions hold before the first one that does not.
    fn count_before(&mut self, conditions: &[Node], call: &Call) -> Read {
        let mut count = Value::count(conditions.len());
        for (k, &condition) in conditions.iter().enumerate().rev() {
            let ends = self.graph.not(condition);
            count = self.joined(ends, &Value::count(k), &count, call)?;
        }
        Ok(count)
    }

    /// Returns the first element whose condition holds, or its position.
    fn first_of(&mut self, all: &[Value], conditions: &[Node], call: &Call) -> Read {
        let mut found = Value::none();
        for (k, (value, &condition)) in all.iter().zip(conditions).enumerate().rev() {
            let one =
                Value::some(if call.name == "find" { value.clone() } else { Value::count(k) });
            found = match self.graph.truth(condition) {
                Some(true) => one,
                Some(false) => found,
                None => self.joined(condition, &one, &found, call)?,
            };
        }
        Ok(found)
    }
}
