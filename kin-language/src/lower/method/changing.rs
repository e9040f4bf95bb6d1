//! Methods that change their receiver: of arrays and lists, of iterators, of options, and of types
//! that the body declares.

use syn::{Expr, ExprMethodCall, FnArg};

use crate::lower::scope::Place;
use crate::lower::value::Value;
use crate::lower::{Read, Reader, Unreadable};

/// The methods that the interpreter reads.
const READ: &[&str] = &[
    "swap",
    "reverse",
    "fill",
    "push",
    "pop",
    "insert",
    "remove",
    "truncate",
    "clear",
    "extend",
    "extend_from_slice",
    "copy_from_slice",
    "clone_from_slice",
    "rotate_left",
    "rotate_right",
    "iter_mut",
    "first_mut",
    "last_mut",
    "get_mut",
    "split_at_mut",
    "chunks_mut",
    "chunks_exact_mut",
    "sort_by",
    "sort_unstable_by",
    "next",
    "peek",
    "next_back",
    "nth",
    "take",
    "replace",
];

impl Reader {
    /// Calls a method that changes its receiver. The function returns `None` if the method does
    /// not, or if the receiver is no variable with a known value.
    pub(super) fn changing_method(
        &mut self,
        name: &str,
        whole: &ExprMethodCall,
    ) -> Read<Option<Value>> {
        let is_variable = matches!(
            strip(&whole.receiver),
            Expr::Path(_) | Expr::Field(_) | Expr::Index(_) | Expr::Unary(_)
        );
        if !is_variable {
            return Ok(None);
        }
        let own = self.own.changes(name);
        if !READ.contains(&name) && !own {
            return Ok(None);
        }
        let Some(place) = self.looked_into(&whole.receiver)? else { return Ok(None) };
        match self.at_place(&place).map(Value::referent) {
            Some(Value::Array(all)) if READ.contains(&name) => {
                self.change(&whole.receiver, &place);
                let arguments = self.expressions(whole.args.iter())?;
                self.change_list(&place, all, arguments, whole)
            }
            Some(Value::Iterator(mut all)) => {
                self.change(&whole.receiver, &place);
                let k = match (name, whole.args.first()) {
                    ("peek", None) => {
                        let first =
                            all.first().cloned().map(|value| Value::Reference(Box::new(value)));
                        return Ok(Some(first.map_or(Value::none(), Value::some)));
                    }
                    ("next", None) => 0,
                    ("next_back", None) => all.len().saturating_sub(1),
                    ("nth", Some(k)) => self.known_count(k)?,
                    _ => return Ok(None),
                };
                let found = (k < all.len()).then(|| all[k].clone());
                match name {
                    "next_back" => drop(all.pop()),
                    _ => drop(all.drain(..all.len().min(k + 1))),
                }
                let _ = self.put_at(&place, Value::Iterator(all), whole);
                Ok(Some(found.map_or(Value::none(), Value::some)))
            }
            Some(value @ Value::Adt(_))
                if matches!((name, whole.args.len()), ("take", 0) | ("replace", 1)) =>
            {
                self.change(&whole.receiver, &place);
                let new = match whole.args.first() {
                    Some(new) => Value::some(self.expression(new)?),
                    None => Value::none(),
                };
                let _ = self.put_at(&place, new, whole);
                Ok(Some(value))
            }
            Some(Value::Adt(adt)) if own => {
                let arguments = self.expressions(whole.args.iter())?;
                let arguments: Vec<Value> =
                    std::iter::once(Value::Place(place.clone())).chain(arguments).collect();
                self.change_by(&whole.receiver, &place, (&adt.type_name(), name), &arguments);
                self.own_method(&adt.type_name(), name, arguments, whole)
            }
            _ => Ok(None),
        }
    }

    /// Checks that the receiver may change, if a method of a type of the body takes `&mut self`.
    fn change_by(
        &mut self,
        receiver: &Expr,
        place: &Place,
        (ty, name): (&str, &str),
        arguments: &[Value],
    ) {
        if self
            .own
            .function(ty, name, arguments)
            .is_some_and(|(function, _)| takes_itself(&function))
        {
            self.change(receiver, place);
        }
    }

    fn known_count(&mut self, at: &Expr) -> Read<usize> {
        match self.expression(at)? {
            Value::Integer(k, _) => {
                usize::try_from(k).map_err(|_| Unreadable::new(at, "a count out of range"))
            }
            _ => Err(Unreadable::new(at, "an unknown count")),
        }
    }

    fn change_list(
        &mut self,
        place: &Place,
        mut all: Vec<Value>,
        arguments: Vec<Value>,
        whole: &ExprMethodCall,
    ) -> Read<Option<Value>> {
        let unknown = || Unreadable::new(&whole.method, "an unknown index");
        let arguments: Vec<Value> = arguments.into_iter().map(|value| self.loaded(value)).collect();
        let counts: Vec<usize> = arguments.iter().map_while(count).collect();
        if let Some(places) = places_in(place, all.len(), &arguments, &counts, whole) {
            return Ok(Some(places));
        }
        let mut result = Value::unit();
        match (whole.method.to_string().as_str(), &arguments[..], &counts[..]) {
            ("swap", [_, _], &[a, b]) if a < all.len() && b < all.len() => all.swap(a, b),
            ("reverse", [], _) => all.reverse(),
            ("fill", [value], _) => all.fill(value.clone()),
            ("push", [value], _) => all.push(value.clone()),
            ("pop", [], _) => result = all.pop().map_or(Value::none(), Value::some),
            ("insert", [_, value], &[k, ..]) if k <= all.len() => all.insert(k, value.clone()),
            ("remove", [_], &[k]) if k < all.len() => result = all.remove(k),
            ("truncate", [_], &[k]) => all.truncate(k),
            ("clear", [], _) => all.clear(),
            ("extend" | "extend_from_slice", [Value::Array(more) | Value::Iterator(more)], _) => {
                let more: Vec<Value> =
                    more.iter().map(|value| self.loaded(value.clone())).collect();
                all.extend(more);
            }
            ("copy_from_slice" | "clone_from_slice", [Value::Array(more)], _)
                if more.len() == all.len() =>
            {
                all.clone_from(more)
            }
            ("rotate_left", [_], &[k]) if k <= all.len() => all.rotate_left(k),
            ("rotate_right", [_], &[k]) if k <= all.len() => all.rotate_right(k),
            ("sort_by" | "sort_unstable_by", [_], _) => {
                self.sort(&mut all, arguments[0].clone(), whole)?
            }
            ("swap" | "insert" | "remove" | "rotate_left" | "rotate_right", _, [k, ..]) => {
                let k = counts.iter().find(|k| **k >= all.len()).unwrap_or(k);
                let text =
                    format!("index {k} is out of range: the value is an array of {}", all.len());
                return Ok(Some(self.mistake(&whole.method, text)));
            }
            _ => return Err(unknown()),
        }
        match self.put_at(place, Value::Array(all), whole) {
            Some(()) => Ok(Some(result)),
            None => {
                Err(Unreadable::new(&whole.method, "a change of a part of an array of this length"))
            }
        }
    }

    /// Sorts a list: exchanges neighbours wherever the first one is greater, as often as may be
    /// necessary.
    fn sort(&mut self, all: &mut [Value], by: Value, whole: &ExprMethodCall) -> Read<()> {
        let f = self.function(by, &whole.args[0])?;
        for end in (1..all.len()).rev() {
            for k in 0..end {
                let a = all[k].clone();
                let b = all[k + 1].clone();
                let inputs =
                    [&a, &b].map(|value| Value::Reference(Box::new(value.clone()))).to_vec();
                let order = self.apply(&f, inputs, &[], whole)?;
                let greater = self.is_ordered(order, "Greater", given(whole))?;
                let joined = (self.select(greater, &b, &a), self.select(greater, &a, &b));
                let (Some(first), Some(second)) = joined else {
                    return Err(Unreadable::new(&whole.method, "an order of these values"));
                };
                (all[k], all[k + 1]) = (first, second);
            }
        }
        Ok(())
    }
}

/// Returns the first argument of a method, or its body if it is a closure; returns the whole call
/// if it has no arguments.
pub fn given(whole: &ExprMethodCall) -> &dyn quote::ToTokens {
    match whole.args.first() {
        Some(Expr::Closure(closure)) => &*closure.body,
        Some(other) => other,
        None => whole,
    }
}

fn count(value: &Value) -> Option<usize> {
    match value {
        Value::Integer(k, _) => usize::try_from(*k).ok(),
        _ => None,
    }
}

fn strip(expression: &Expr) -> &Expr {
    match expression {
        Expr::Paren(inner) => strip(&inner.expr),
        Expr::Group(inner) => strip(&inner.expr),
        other => other,
    }
}

/// Returns true if a method takes `&mut self`.
pub fn takes_itself(function: &syn::ItemFn) -> bool {
    matches!(function.sig.inputs.first(), Some(FnArg::Receiver(receiver)) if receiver.reference.is_some() && receiver.mutability.is_some())
}

/// Calls a method that returns changeable places in a list of n elements: references, halves,
/// chunks.
fn places_in(
    place: &Place,
    n: usize,
    arguments: &[Value],
    counts: &[usize],
    whole: &ExprMethodCall,
) -> Option<Value> {
    let parts = |ranges: Vec<(usize, usize)>| {
        ranges.into_iter().map(|(from, to)| Value::Place(place.slice(from, to))).collect()
    };
    let one = |k: usize| Value::some(Value::Place(place.index(k)));
    Some(match (whole.method.to_string().as_str(), arguments, counts) {
        ("iter_mut", [], _) => {
            Value::Iterator((0..n).map(|k| Value::Place(place.index(k))).collect())
        }
        ("first_mut", [], _) if n > 0 => one(0),
        ("last_mut", [], _) if n > 0 => one(n - 1),
        ("get_mut", [_], &[k]) if k < n => one(k),
        ("get_mut", [_], &[_]) | ("first_mut" | "last_mut", [], _) => Value::none(),
        ("split_at_mut", [_], &[k]) if k <= n => Value::Tuple(parts(vec![(0, k), (k, n)])),
        ("chunks_mut" | "chunks_exact_mut", [_], &[k]) if k > 0 => {
            let exact = whole.method == "chunks_exact_mut";
            let starts = (0..n).step_by(k).filter(|from| !exact || from + k <= n);
            Value::Iterator(parts(starts.map(|from| (from, n.min(from + k))).collect()))
        }
        _ => return None,
    })
}
