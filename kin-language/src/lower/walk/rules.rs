//! Rules of methods that apply a function: to elements of arrays and iterators, to components, to
//! the value in an `Option`.

use quote::ToTokens;
use syn::{BinOp, Expr, ExprMethodCall, GenericArgument, ItemFn, parse_quote};

use super::Reader;
use crate::lower::methods::lists::reference;
use crate::lower::methods::{Call, lists};
use crate::lower::values::{
    Adt, Branching, Components, Endless, Function, IntegerType, MOST_TURNS, Place, Read,
    Unreadable, Value, integer,
};
use crate::vocabulary::is_integer;
use kin_graph::Node;

impl Reader {
    /// Returns the sum (if `plus`) or the product of integers, numbers, or vectors.
    pub fn folded(&mut self, all: Vec<Value>, plus: bool, call: &Call) -> Read {
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
            return sum.ok_or_else(|| call.unreadable(format!("`{name}` of `{ty}`")));
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
            return sum.ok_or_else(|| call.unreadable("a sum of unknown integers"));
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

    /// Returns the values before the first one for which a condition does not hold; the condition
    /// must be known during the reading.
    pub fn taken_while(
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

    /// Sorts a list: exchanges neighbours wherever the first one is greater, as often as may be
    /// necessary.
    pub fn sort(&mut self, all: &mut [Value], by: Value, whole: &ExprMethodCall) -> Read<()> {
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

    /// Reads `scan`: the function changes a variable from element to element.
    pub fn scanned(&mut self, all: Vec<Value>, f: &Function, call: &Call) -> Read {
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
                    return Err(call.unreadable("a `scan` whose end is open here"));
                }
            }
        }
        Ok(Value::Iterator(found))
    }

    pub fn mapped_while(&mut self, all: Vec<Value>, f: &Function, call: &Call) -> Read {
        let mut kept = Vec::new();
        for value in all {
            match self.apply(f, vec![value], &[], call)? {
                Value::Adt(adt) if adt.name == "Some" => {
                    kept.extend(adt.fields.into_iter().map(|(_, value)| value))
                }
                Value::Adt(_) => break,
                _ => return Err(call.unreadable("an end that is open here")),
            }
        }
        Ok(Value::Iterator(kept))
    }

    /// Applies the function in argument `k` to other values.
    pub fn applied(&mut self, k: usize, inputs: Vec<Value>, call: &Call) -> Read {
        let f = self.function(call.arguments[k].clone(), call.places[k])?;
        self.apply(&f, inputs, &[], call)
    }

    /// Reads `condition.then(|| value)`.
    pub fn some_where(&mut self, holds: Node, call: &Call) -> Read {
        let f = self.function(call.arguments[0].clone(), call.places[0])?;
        let some = |reader: &mut Self| Ok(Value::some(reader.apply(&f, vec![], &[], call)?));
        self.choose(holds, some, |_| Ok(Value::none()), call)
    }

    /// Applies the function in the first argument to each component.
    pub fn mapped(&mut self, kind: Components, nodes: &[Node], call: &Call) -> Read {
        let f = self.function(call.arguments[0].clone().referent(), call.places[0])?;
        let each = nodes.iter().map(|&n| {
            let value = self.apply(&f, vec![Value::Scalar(n)], &[], call.whole)?;
            Ok(self.scalar(value, call.whole))
        });
        each.collect::<Read<_>>().map(|nodes| kind.value(nodes))
    }

    /// Reads `h.axis()` and `h.axis_near(f)`: an axis along a direction that does not move.
    pub fn axis_of(&mut self, _: Components, h: &[Node], call: &Call) -> Read {
        let mut vectors = vec![Value::Vector(h.to_vec())];
        vectors.extend(call.arguments.first().map(|f| f.clone().referent()));
        if vectors.iter().any(|vector| self.value_varies(vector)) {
            return Ok(self.no_derivative(&call.name, &call.whole.method));
        }
        let function = if call.name == "axis_near" { axis_near() } else { axis() };
        let value = self.apply_inner(&function, 0, (vectors, &call.places), None, call.whole)?;
        let Value::Array(all) = value else { return Ok(Value::Poison) };
        let mut parts = all.into_iter().map(|part| match part {
            Value::Vector(v) => v,
            _ => vec![],
        });
        let mut next = || parts.next().unwrap_or_default();
        Ok(Value::Axis([next(), next(), next()]))
    }

    /// Pairs the elements of a list with those of another iterator.
    pub fn zipped_lists(&mut self, all: Vec<Value>, call: &Call) -> Read {
        if let Value::Endless(endless) = &call.arguments[0] {
            let others = self.first_of_endless(endless, all.len(), call)?;
            return Ok(lists::pairs(all, others));
        }
        let others = self.elements(call.arguments[0].clone(), call.places[0])?;
        Ok(others.map_or(Value::Poison, |others| lists::pairs(all, others)))
    }

    /// Returns the element that no other one exceeds. `pick` returns what to take if the first of
    /// two elements is greater, and else.
    pub fn best_of(
        &mut self,
        all: Vec<Value>,
        f: &Function,
        call: &Call,
        pick: for<'v> fn(&'v Value, &'v Value) -> [&'v Value; 2],
    ) -> Read {
        let mut all = all.into_iter();
        let Some(first) = all.next() else { return Ok(Value::none()) };
        let best = all.try_fold(first, |best, value| {
            let order = self.apply(f, vec![reference(&best), reference(&value)], &[], call)?;
            // Among equal elements, the first one is the minimum and the last one the maximum.
            let worse = self.is_ordered(order, "Greater", given(call.whole))?;
            let [held, other] = pick(&best, &value);
            self.joined(worse, held, other, call)
        });
        best.map(Value::some)
    }

    /// Returns the conditions that a function gives for the elements.
    pub fn holds_for(
        &mut self,
        all: &[Value],
        f: &Function,
        call: &Call,
        input: fn(&Value) -> Value,
    ) -> Read<Vec<Node>> {
        let each = all.iter().map(|value| {
            let holds = self.apply(f, vec![input(value)], &[], call)?;
            Ok(self.condition(holds, call))
        });
        each.collect()
    }
}

/// An array, or an iterator over a known list of values.
pub struct List {
    pub all: Vec<Value>,
    pub is_array: bool,
}

/// The state of a body.
#[derive(Clone, Copy)]
pub struct Body {
    pub slot: usize,
    pub dimension: usize,
}

/// `Some(x)`, `None`, `Ok(x)` or `Err(e)`.
pub struct Holder(pub Adt);

impl Holder {
    pub fn is_held(&self) -> bool {
        matches!(self.0.name.as_str(), "Some" | "Ok")
    }

    /// Returns the value in the variant, if there is one.
    pub fn inner(&self) -> Option<Value> {
        self.0.fields.first().map(|(_, value)| value.clone())
    }

    /// Returns x of `Some(x)` and `Ok(x)`.
    pub fn held(&self) -> Option<Value> {
        self.is_held().then(|| self.inner().unwrap_or(Value::Unassigned))
    }

    /// Returns e of `Err(e)`, as the arguments of a function.
    pub fn error(&self) -> Vec<Value> {
        self.inner().filter(|_| self.0.name == "Err").into_iter().collect()
    }

    pub fn same(&self) -> Value {
        Value::Adt(self.0.clone())
    }

    /// Returns the variant with another value in it.
    pub fn with(&self, value: Value) -> Value {
        Value::Adt(Adt { fields: vec![("0".into(), value)], ..self.0.clone() })
    }

    /// Returns `Ok(x)` for a variant with a value x.
    pub fn ok(&self) -> Option<Value> {
        self.is_held().then(|| variant("Ok", self.inner()))
    }
}

/// Returns `name(value)`, or `name` alone.
pub fn variant(name: &str, value: Option<Value>) -> Value {
    Value::Adt(Adt::new(name, value))
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

/// Returns the steps of `Axis::along`.
fn axis() -> ItemFn {
    parse_quote! {
        fn axis(h: Vec3) -> [Vec3; 3] {
            fn unit(v: Vec3) -> Vec3 {
                let v = v / v.x.abs().max(v.y.abs()).max(v.z.abs());
                v / v.norm()
            }
            let h = unit(h);
            let x = h.x.abs();
            let y = h.y.abs();
            let z = h.z.abs();
            let f = if x > y && !(z >= x) {
                vec3(0.0, 1.0, 0.0)
            } else if !(x > y) && y > z {
                vec3(0.0, 0.0, 1.0)
            } else {
                vec3(1.0, 0.0, 0.0)
            };
            let f = unit(f - h * h.dot(f));
            [h, f, h.cross(f)]
        }
    }
}

/// Returns the steps of `Axis::new`, and those of `Axis::along` where f is along h.
fn axis_near() -> ItemFn {
    let along = axis();
    parse_quote! {
        fn axis_near(h: Vec3, f: Vec3) -> [Vec3; 3] {
            #along
            fn unit(v: Vec3) -> Vec3 {
                let v = v / v.x.abs().max(v.y.abs()).max(v.z.abs());
                v / v.norm()
            }
            let [own, other, _] = axis(h);
            let f = unit(f);
            let part = f - own * own.dot(f);
            let f = if part.norm() > 1e-9 { unit(part) } else { other };
            [own, f, own.cross(f)]
        }
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
    fn functions_are_applied_to_elements() {
        let (_, value) =
            read(syn::parse_quote!((1..5).filter(|k| k % 2 == 0).map(|k| k * k).sum::<i64>()));
        assert!(matches!(value, Some(Value::Integer(20, _))));
        let (_, value) =
            read(syn::parse_quote!([3, 1, 2].iter().position(|k| *k == 1).map_or(9, |k| k)));
        assert!(matches!(value, Some(Value::Integer(1, _))));
        let (_, value) = read(syn::parse_quote!((1..).map(|k| 2 * k).take(3).last().unwrap()));
        assert!(matches!(value, Some(Value::Integer(6, _))));
        let (_, value) = read(syn::parse_quote!((&(1..)).into_iter().take(3).sum::<i64>()));
        assert!(matches!(value, Some(Value::Integer(6, _))));
    }
}
