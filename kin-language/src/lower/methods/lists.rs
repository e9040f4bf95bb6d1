//! Methods of arrays, of iterators over a known list of values, and of `Option`.

use super::Call;
use crate::lower::values::{Branching, Place, Read, Value, Values};
use kin_graph::{Comparison, Graph, Node};

impl Values {
    /// Returns the elements whose conditions hold.
    pub fn filtered(&mut self, all: &[Value], conditions: &[Node], call: &Call) -> Read {
        let mut kept = Value::Iterator(vec![]);
        for (value, &condition) in all.iter().zip(conditions) {
            let longer = lengthened(kept.clone(), value);
            // If the condition is unknown, the result is one of several lists; those of equal
            // length join element by element.
            kept = self.one_of(condition, longer, kept, call)?;
        }
        Ok(kept)
    }

    pub fn flattened(&mut self, all: Vec<Value>, call: &Call) -> Read<Vec<Value>> {
        let mut flat = Vec::new();
        for part in all {
            match self.loaded(part) {
                Value::Array(inner) | Value::Iterator(inner) => flat.extend(inner),
                Value::Adt(adt) if matches!(adt.name.as_str(), "Some" | "None") => {
                    flat.extend(adt.fields.into_iter().map(|(_, value)| value))
                }
                _ => {
                    return Err(call.unreadable(format!("`{}` of these values", call.name)));
                }
            }
        }
        Ok(flat)
    }

    pub fn contains(&mut self, all: Vec<Value>, one: Value, call: &Call) -> Read {
        let mut any = self.graph.bool(false);
        for value in all {
            let same = match (value.referent(), &one) {
                (Value::Integer(a, _), Value::Integer(b, _)) => self.graph.bool(a == *b),
                (Value::Scalar(a), Value::Scalar(b)) => {
                    self.graph.compare(Comparison::Equal, a, *b)
                }
                _ => return Err(call.unreadable("`contains` of these values")),
            };
            any = self.graph.or(any, same);
        }
        Ok(Value::Condition(any))
    }

    /// Returns how many conditions hold before the first one that does not.
    pub fn count_before(&mut self, conditions: &[Node], call: &Call) -> Read {
        let mut count = Value::count(conditions.len());
        for (k, &condition) in conditions.iter().enumerate().rev() {
            let ends = self.graph.not(condition);
            count = self.joined(ends, &Value::count(k), &count, call)?;
        }
        Ok(count)
    }

    /// Returns the elements of a list as an array of the values behind them.
    pub fn array_of(&self, all: Vec<Value>) -> Value {
        Value::Array(all.into_iter().map(|value| self.loaded(value)).collect())
    }

    /// Returns values as conditions.
    pub fn conditions_of(&mut self, all: Vec<Value>, call: &Call) -> Vec<Node> {
        all.into_iter().map(|value| self.condition(value, call)).collect()
    }

    /// Joins conditions by `or` or `and`.
    pub fn folded_conditions(
        &mut self,
        start: Node,
        all: Vec<Value>,
        join: fn(&mut Graph, Node, Node) -> Node,
        call: &Call,
    ) -> Read {
        let joined = all.into_iter().fold(start, |sum, value| {
            let condition = self.condition(value, call);
            join(&mut self.graph, sum, condition)
        });
        Ok(Value::Condition(joined))
    }

    /// Returns the elements whose conditions hold, and the others.
    pub fn partitioned(&mut self, all: &[Value], conditions: Vec<Node>, call: &Call) -> Read {
        let kept = self.filtered(all, &conditions, call)?;
        let others: Vec<Node> = conditions.into_iter().map(|holds| self.graph.not(holds)).collect();
        let rest = self.filtered(all, &others, call)?;
        Ok(Value::Tuple(vec![collected(kept), collected(rest)]))
    }

    /// Returns the values x of those results that are `Some(x)`.
    pub fn kept_values(&mut self, results: Vec<Value>, call: &Call) -> Read {
        results.into_iter().try_fold(Value::Iterator(vec![]), |kept, result| {
            let result = self.loaded(result);
            self.each(result, call, &mut |_, result| match result {
                Value::Adt(adt) if adt.name == "Some" => Ok(adt
                    .fields
                    .iter()
                    .fold(kept.clone(), |kept, (_, value)| lengthened(kept, value))),
                Value::Adt(adt) if adt.name == "None" => Ok(kept.clone()),
                _ => Err(call.unreadable("`filter_map` of these values")),
            })
        })
    }

    /// Returns the first result that is `Some(x)`.
    pub fn first_value(&mut self, results: Vec<Value>, call: &Call) -> Read {
        results.into_iter().rev().try_fold(Value::none(), |found, result| {
            let result = self.loaded(result);
            self.each(result, call, &mut |_, result| match result {
                Value::Adt(adt) if adt.name == "None" => Ok(found.clone()),
                some @ Value::Adt(_) => Ok(some),
                _ => Err(call.unreadable("`find_map` of these values")),
            })
        })
    }

    /// Returns a list of pairs as a pair of lists.
    pub fn unzipped(&mut self, all: Vec<Value>, call: &Call) -> Read {
        let mut left = Vec::new();
        let mut right = Vec::new();
        for pair in all {
            match self.loaded(pair) {
                Value::Tuple(mut pair) if pair.len() == 2 => {
                    right.extend(pair.pop());
                    left.extend(pair.pop());
                }
                _ => return Err(call.unreadable("`unzip` of these values")),
            }
        }
        Ok(Value::Tuple(vec![Value::Array(left), Value::Array(right)]))
    }

    /// Returns the first value whose condition holds.
    pub fn first_of(&mut self, all: &[Value], conditions: &[Node], call: &Call) -> Read {
        let mut found = Value::none();
        for (value, &condition) in all.iter().zip(conditions).rev() {
            found = self.one_of(condition, Value::some(value.clone()), found, call)?;
        }
        Ok(found)
    }

    /// Returns the one of `cuts` that belongs to the first condition that fails, or else `whole`.
    /// If the position depends on coordinates, the result is one of several lists.
    pub fn cut(&mut self, whole: Value, cuts: &[Value], conditions: &[Node], call: &Call) -> Read {
        let mut cut = whole;
        for (here, &condition) in cuts.iter().zip(conditions).rev() {
            cut = match self.graph.truth(condition) {
                Some(true) => cut,
                Some(false) => here.clone(),
                None => {
                    let ends = self.graph.not(condition);
                    self.joined(ends, here, &cut, call)?
                }
            };
        }
        Ok(cut)
    }

    /// Reads `option.zip(other)`.
    pub fn zipped(&mut self, one: &Value, other: Value, call: &Call) -> Read {
        let other = self.loaded(other);
        self.each(other, call, &mut |_, other| match (one, other) {
            (Value::Adt(a), Value::Adt(b)) => Ok(match (a.fields.first(), b.fields.first()) {
                (Some((_, a)), Some((_, b))) => {
                    Value::some(Value::Tuple(vec![a.clone(), b.clone()]))
                }
                _ => Value::none(),
            }),
            _ => Err(call.unreadable("`zip` of these values")),
        })
    }
}

/// Returns the number in the first argument, or 0 without arguments.
pub fn count_in(call: &Call) -> Read<usize> {
    let remarks = ["an index out of range", "an unknown index"];
    let given = call.arguments.first();
    given.map_or(Ok(0), |given| Values::index_of(given, call.places[0], remarks))
}

/// Returns `Some(value)` or `None`.
pub fn option(value: Option<Value>) -> Value {
    value.map_or(Value::none(), Value::some)
}

/// Returns a reference to a value.
pub fn borrowed(value: Value) -> Value {
    Value::Reference(Box::new(value))
}

/// Returns a reference to a copy of a value.
pub fn reference(value: &Value) -> Value {
    borrowed(value.clone())
}

/// Returns an array of numbers.
pub fn numbers(nodes: &[Node]) -> Value {
    Value::Array(nodes.iter().copied().map(Value::Scalar).collect())
}

pub fn array(all: &[Value]) -> Value {
    Value::Array(all.to_vec())
}

pub fn iterator(all: &[Value]) -> Value {
    Value::Iterator(all.to_vec())
}

/// Returns an iterator over pairs, as long as the shorter list.
pub fn pairs(left: Vec<Value>, right: Vec<Value>) -> Value {
    let pair = |(a, b)| Value::Tuple(vec![a, b]);
    Value::Iterator(left.into_iter().zip(right).map(pair).collect())
}

/// Returns the place of element k of a list of n elements, if the list has it.
pub fn place_of(list: &Place, n: usize, k: Option<usize>) -> Value {
    option(k.filter(|k| *k < n).map(|k| Value::Place(list.index(k))))
}

/// Returns the places of parts of a list, each from an index to before another one.
pub fn slices(list: &Place, ranges: &[(usize, usize)]) -> Vec<Value> {
    ranges.iter().map(|&(from, to)| Value::Place(list.slice(from, to))).collect()
}

/// Returns the places of parts with k elements in the first n elements of a list.
pub fn chunks(list: &Place, n: usize, k: usize) -> Option<Vec<Value>> {
    let ranges = |k| (0..n).step_by(k).map(|from| (from, n.min(from + k))).collect::<Vec<_>>();
    (k > 0).then(|| slices(list, &ranges(k)))
}

/// Returns an iterator, or each of several, as an array.
pub fn collected(list: Value) -> Value {
    match list {
        Value::Iterator(all) => Value::Array(all),
        Value::Choice(all) => {
            Value::Choice(all.into_iter().map(|(taken, list)| (taken, collected(list))).collect())
        }
        other => other,
    }
}

/// Returns a list, or each of several, with one more element.
pub fn lengthened(list: Value, value: &Value) -> Value {
    match list {
        Value::Iterator(mut all) => {
            all.push(value.clone());
            Value::Iterator(all)
        }
        Value::Choice(all) => Value::Choice(
            all.into_iter().map(|(taken, list)| (taken, lengthened(list, value))).collect(),
        ),
        other => other,
    }
}

pub fn count(value: &Value) -> Option<usize> {
    match value {
        Value::Integer(k, _) => usize::try_from(*k).ok(),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lower::scope::Step;

    #[test]
    fn chunks_are_places_in_the_list() {
        let parts = chunks(&Place::whole(0), 5, 2).unwrap_or_default();
        let ends = parts.iter().map(|part| match part {
            Value::Place(Place { steps, .. }) => steps[0].clone(),
            _ => Step::Index(0),
        });
        assert_eq!(
            ends.collect::<Vec<_>>(),
            [(0, 2), (2, 4), (4, 5)].map(|(from, to)| Step::Slice(from, to))
        );
        assert!(chunks(&Place::whole(0), 5, 0).is_none());
    }

    #[test]
    fn the_shorter_list_ends_the_pairs() {
        let list = |n| (0..n).map(Value::count).collect::<Vec<_>>();
        assert!(matches!(pairs(list(3), list(2)), Value::Iterator(all) if all.len() == 2));
        assert!(
            matches!(place_of(&Place::whole(0), 2, Some(2)), Value::Adt(adt) if adt.name == "None")
        );
    }
}
