//! Methods of arrays, and of iterators over a known list of values.

use syn::{BinOp, GenericArgument};

use super::Call;
use crate::lower::function::Function;
use crate::lower::integer::{self, IntegerType};
use crate::lower::value::Value;
use crate::lower::{Read, Reader, Unreadable};
use crate::vocabulary::is_integer;
use kin_graph::{Comparison, Graph, Node};

impl Reader {
    /// Calls a method of an array (if `array`) or of an iterator.
    pub(super) fn list_method(&mut self, all: Vec<Value>, array: bool, call: Call) -> Read {
        let call = &call;
        let iterator = |all: Vec<Value>| Ok(Value::Iterator(all));
        match (call.name.as_str(), &call.arguments[..]) {
            ("len", []) => Ok(Value::Integer(all.len() as i64, Some(IntegerType::SIZE))),
            ("is_empty", []) => Ok(Value::Condition(self.graph.bool(all.is_empty()))),
            ("iter", []) => {
                iterator(all.into_iter().map(|value| Value::Reference(Box::new(value))).collect())
            }
            ("into_iter", []) => iterator(all),
            ("copied" | "cloned", []) => {
                iterator(all.into_iter().map(|value| self.loaded(value)).collect())
            }
            ("rev", []) => iterator(all.into_iter().rev().collect()),
            ("enumerate", []) => iterator(
                (0..)
                    .zip(all)
                    .map(|(k, value)| {
                        Value::Tuple(vec![Value::Integer(k, Some(IntegerType::SIZE)), value])
                    })
                    .collect(),
            ),
            (
                "to_vec" | "collect" | "as_slice" | "by_ref" | "fuse" | "peekable"
                | "into_boxed_slice",
                [],
            ) if call.name != "collect" && !array => iterator(all),
            ("to_vec" | "collect" | "as_slice" | "into_boxed_slice", []) => {
                Ok(Value::Array(all.into_iter().map(|value| self.loaded(value)).collect()))
            }
            ("concat", []) => self.flattened(all, call).map(Value::Array),
            ("flatten", []) => self.flattened(all, call).map(Value::Iterator),
            ("sum", []) => self.folded(all, true, call),
            ("product", []) => self.folded(all, false, call),
            (
                "map" | "flat_map" | "filter" | "partition" | "filter_map" | "find_map" | "any"
                | "all",
                [f],
            ) => {
                let f = self.function(f.clone(), call.places[0])?;
                self.list_method_with(all, array, &f, call)
            }
            (
                "cycle" | "first" | "last" | "next" | "nth" | "get" | "count" | "split_at"
                | "split_first" | "split_last" | "try_into" | "unzip",
                _,
            ) => self.picked(all, call),
            (
                "reduce" | "min_by" | "max_by" | "scan" | "for_each" | "position"
                | "partition_point" | "find" | "take_while" | "skip_while" | "map_while",
                _,
            ) => self.gone_over(all, call),
            ("fold", [start, f]) => {
                let f = self.function(f.clone(), call.places[1])?;
                all.into_iter().try_fold(start.clone(), |sum, value| {
                    self.apply(&f, vec![sum, value], &[], call)
                })
            }
            ("zip" | "chain", [other]) => self.with_another(all, other.clone(), call),
            ("contains", [one]) => self.contains(all, one.clone().referent(), call),
            ("skip" | "take" | "step_by" | "windows" | "chunks" | "chunks_exact", [count]) => {
                self.counted_part(all, count.clone().referent(), call)
            }
            _ => Err(Unreadable::new(
                &call.whole.method,
                format!("`{}` of an array or iterator", call.name),
            )),
        }
    }

    fn with_another(&mut self, all: Vec<Value>, other: Value, call: &Call) -> Read {
        let iterator = |all: Vec<Value>| Ok(Value::Iterator(all));
        if let ("zip", Value::Endless(endless)) = (call.name.as_str(), &other) {
            let others = self.first_of_endless(endless, all.len(), call)?;
            return iterator(
                all.into_iter().zip(others).map(|(a, b)| Value::Tuple(vec![a, b])).collect(),
            );
        }
        let Some(items) = self.elements(other, call.places[0])? else {
            return Ok(Value::Poison);
        };
        match call.name.as_str() {
            "zip" => iterator(
                all.into_iter().zip(items).map(|(a, b)| Value::Tuple(vec![a, b])).collect(),
            ),
            _ => iterator(all.into_iter().chain(items).collect()),
        }
    }

    fn list_method_with(
        &mut self,
        all: Vec<Value>,
        array: bool,
        f: &Function,
        call: &Call,
    ) -> Read {
        let mut each = |value: &Value| self.apply(f, vec![value.clone()], &[], call);
        let results = all.iter().map(&mut each).collect::<Read<Vec<Value>>>()?;
        match call.name.as_str() {
            "map" if array => Ok(Value::Array(results)),
            "map" => Ok(Value::Iterator(results)),
            "flat_map" => self.flattened(results, call).map(Value::Iterator),
            "filter" | "partition" => {
                let conditions: Vec<Node> =
                    results.into_iter().map(|result| self.condition(result, call)).collect();
                let kept = self.filtered(&all, &conditions, call)?;
                if call.name == "filter" {
                    return Ok(kept);
                }
                let others: Vec<Node> =
                    conditions.into_iter().map(|holds| self.graph.not(holds)).collect();
                let rest = self.filtered(&all, &others, call)?;
                Ok(Value::Tuple(vec![collected(kept), collected(rest)]))
            }
            "filter_map" => {
                results.into_iter().try_fold(Value::Iterator(vec![]), |kept, result| {
                    let result = self.loaded(result);
                    self.each(result, call, &mut |_, result| match result {
                        Value::Adt(adt) if adt.name == "Some" => Ok(adt
                            .fields
                            .iter()
                            .fold(kept.clone(), |kept, (_, value)| lengthened(kept, value))),
                        Value::Adt(adt) if adt.name == "None" => Ok(kept.clone()),
                        _ => {
                            Err(Unreadable::new(&call.whole.method, "`filter_map` of these values"))
                        }
                    })
                })
            }
            "find_map" => results.into_iter().rev().try_fold(Value::none(), |found, result| {
                let result = self.loaded(result);
                self.each(result, call, &mut |_, result| match result {
                    Value::Adt(adt) if adt.name == "None" => Ok(found.clone()),
                    some @ Value::Adt(_) => Ok(some),
                    _ => Err(Unreadable::new(&call.whole.method, "`find_map` of these values")),
                })
            }),
            name => {
                let any = name == "any";
                let join = if any { Graph::or } else { Graph::and };
                let start = self.graph.bool(!any);
                let joined = results.into_iter().fold(start, |sum, result| {
                    let condition = self.condition(result, call);
                    join(&mut self.graph, sum, condition)
                });
                Ok(Value::Condition(joined))
            }
        }
    }

    /// Returns the elements whose conditions hold.
    fn filtered(&mut self, all: &[Value], conditions: &[Node], call: &Call) -> Read {
        let mut kept = Value::Iterator(vec![]);
        for (value, &condition) in all.iter().zip(conditions) {
            let longer = lengthened(kept.clone(), value);
            kept = match self.graph.truth(condition) {
                Some(true) => longer,
                Some(false) => kept,
                // The result is one of several lists; those of equal length join element by
                // element.
                None => self.joined(condition, &longer, &kept, call)?,
            };
        }
        Ok(kept)
    }

    fn flattened(&mut self, all: Vec<Value>, call: &Call) -> Read<Vec<Value>> {
        let mut flat = Vec::new();
        for part in all {
            match self.loaded(part) {
                Value::Array(inner) | Value::Iterator(inner) => flat.extend(inner),
                Value::Adt(adt) if matches!(adt.name.as_str(), "Some" | "None") => {
                    flat.extend(adt.fields.into_iter().map(|(_, value)| value))
                }
                _ => {
                    return Err(Unreadable::new(
                        &call.whole.method,
                        format!("`{}` of these values", call.name),
                    ));
                }
            }
        }
        Ok(flat)
    }

    fn counted_part(&mut self, all: Vec<Value>, count: Value, call: &Call) -> Read {
        let count = match count {
            Value::Integer(k, _) => usize::try_from(k)
                .map_err(|_| Unreadable::new(call.places[0], "a count out of range"))?,
            _ => return Err(Unreadable::new(call.places[0], "an unknown count")),
        };
        let lists = |parts: Vec<Vec<Value>>| parts.into_iter().map(Value::Array).collect();
        Ok(Value::Iterator(match (call.name.as_str(), count) {
            ("skip", k) => all.into_iter().skip(k).collect(),
            ("take", k) => all.into_iter().take(k).collect(),
            (_, 0) => return Err(Unreadable::new(&call.whole.method, "a step of zero")),
            ("step_by", k) => all.into_iter().step_by(k).collect(),
            ("windows", k) => lists(all.windows(k).map(<[Value]>::to_vec).collect()),
            ("chunks", k) => lists(all.chunks(k).map(<[Value]>::to_vec).collect()),
            (_, k) => lists(all.chunks_exact(k).map(<[Value]>::to_vec).collect()),
        }))
    }

    fn contains(&mut self, all: Vec<Value>, one: Value, call: &Call) -> Read {
        let mut any = self.graph.bool(false);
        for value in all {
            let same = match (value.referent(), &one) {
                (Value::Integer(a, _), Value::Integer(b, _)) => self.graph.bool(a == *b),
                (Value::Scalar(a), Value::Scalar(b)) => {
                    self.graph.compare(Comparison::Equal, a, *b)
                }
                _ => return Err(Unreadable::new(&call.whole.method, "`contains` of these values")),
            };
            any = self.graph.or(any, same);
        }
        Ok(Value::Condition(any))
    }

    /// Returns the sum (if `plus`) or the product of integers, numbers, or vectors.
    fn folded(&mut self, all: Vec<Value>, plus: bool, call: &Call) -> Read {
        let given = call.whole.turbofish.as_ref().and_then(|given| match given.args.first() {
            Some(GenericArgument::Type(ty)) => Some(ty),
            _ => None,
        });
        let integer =
            given.is_some_and(|ty| is_integer(&quote::ToTokens::to_token_stream(ty).to_string()));
        let all: Vec<Value> = all.into_iter().map(|value| self.loaded(value)).collect();
        if let Some(Value::Adt(adt)) = all.first() {
            let ty = adt.type_name();
            let name = if plus { "sum" } else { "product" };
            let sum = self.own_method(&ty, name, vec![Value::Iterator(all)], call)?;
            return sum
                .ok_or_else(|| Unreadable::new(&call.whole.method, format!("`{name}` of `{ty}`")));
        }
        if integer || matches!(all.first(), Some(Value::Integer(..))) {
            let given = given.and_then(|ty| {
                IntegerType::named(&quote::ToTokens::to_token_stream(ty).to_string())
            });
            let op: BinOp = if plus { syn::parse_quote!(+) } else { syn::parse_quote!(*) };
            let sum = all.iter().try_fold(Value::Integer(i64::from(!plus), given), |sum, value| {
                match (sum, value) {
                    (Value::Integer(a, x), Value::Integer(b, y)) => {
                        integer::operate(&op, (a, x), (*b, *y))
                    }
                    _ => None,
                }
            });
            return sum
                .ok_or_else(|| Unreadable::new(&call.whole.method, "a sum of unknown integers"));
        }
        let shape = given
            .and_then(crate::parse::shape)
            .or_else(|| Some(all.first()?.numbers()?.1))
            .unwrap_or(crate::parse::Shape::Scalar);
        let components = Value::from_numbers(&shape, &mut std::iter::repeat(self.graph.zero()));
        match components.as_ref().and_then(Value::components) {
            Some((kind, zeros)) if plus => {
                let mut sum = zeros.to_vec();
                for value in all {
                    let value = self.shaped(value, &shape, call);
                    let Some((_, nodes)) = value.components() else { return Ok(Value::Poison) };
                    sum = sum.iter().zip(nodes).map(|(&a, &b)| self.graph.add(a, b)).collect();
                }
                Ok(kind.value(sum))
            }
            _ => {
                let mut sum = self.graph.constant(if plus { 0.0 } else { 1.0 });
                for value in all {
                    let x = self.scalar(value, call);
                    sum = if plus { self.graph.add(sum, x) } else { self.graph.mul(sum, x) };
                }
                Ok(Value::Scalar(sum))
            }
        }
    }
}

/// Returns an iterator, or each of several, as an array.
fn collected(list: Value) -> Value {
    match list {
        Value::Iterator(all) => Value::Array(all),
        Value::Choice(all) => {
            Value::Choice(all.into_iter().map(|(taken, list)| (taken, collected(list))).collect())
        }
        other => other,
    }
}

/// Returns a list, or each of several, with one more element.
fn lengthened(list: Value, value: &Value) -> Value {
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
