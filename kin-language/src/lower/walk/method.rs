//! Calls of methods: finds the row of the table by the kind of the receiver and the name, and
//! applies its rule.

use quote::{ToTokens, quote};
use syn::{Expr, ExprMethodCall};

use super::Reader;
use super::rules::{Body, Holder, List};
use super::table::{Method, Receiver, Rule, method};
use crate::lower::methods::Call;
use crate::lower::methods::components::{body_name, vector_cure};
use crate::lower::methods::lists::{count, count_in};
use crate::lower::methods::numbers::{OTHER_METHODS_OF_F64, cure};
use crate::lower::values::{
    Adt, Branching, Components, Endless, IntegerType, Place, Read, Template, Unreadable, Value,
    Values, integer, is_order, takes_itself,
};
use crate::parse::Shape;
use crate::vocabulary::{is_among, is_scalar_method, is_underived, is_vector_method, strip};
use kin_graph::{Function, Function2, Node};

impl Reader {
    pub fn method_call(&mut self, whole: &ExprMethodCall) -> Read {
        let name = whole.method.to_string();
        if let ("contains", Expr::Range(range)) = (name.as_str(), strip(&whole.receiver)) {
            return self.range_contains(range, whole);
        }
        if let Some(value) = self.changing_method(&name, whole)? {
            return Ok(value);
        }
        let receiver = self.raw_expression(&whole.receiver)?;
        let arguments = self.expressions(whole.args.iter())?;
        self.method_with(whole, std::iter::once(receiver).chain(arguments).collect())
    }

    /// Calls a method with the first value as the receiver and the others as arguments.
    pub fn method_with(&mut self, whole: &ExprMethodCall, mut all: Vec<Value>) -> Read {
        let name = whole.method.to_string();
        let places = whole.args.iter().collect::<Vec<_>>();
        if let Some(receiver) = all.first_mut() {
            let old = std::mem::replace(receiver, Value::Poison);
            *receiver = match old {
                Value::Reference(_) if name == "iter" || name == "into_iter" => old,
                Value::Place(_) if matches!(name.as_str(), "iter_mut" | "into_iter") => old,
                old => self.loaded(old),
            };
        }
        self.each_list(all, &whole.method, &mut |reader, mut all| {
            let arguments = all.split_off(1);
            let call = Call { name: name.clone(), arguments, places: places.clone(), whole };
            reader.method_of(all.pop().unwrap_or(Value::Poison), call)
        })
    }

    /// Calls a method of a value of one kind.
    fn method_of(&mut self, receiver: Value, call: Call) -> Read {
        let whole = call.whole;
        match (receiver, call.name.as_str(), &call.arguments[..]) {
            (value @ (Value::Poison | Value::Never | Value::Left), ..) => Ok(value),
            (Value::Opaque(template), ..) => self.opaque_method(template, call),
            (Value::Iterator(all), ..) => self.list_method(List { all, is_array: false }, &call),
            (Value::Endless(endless), ..) => self.endless_method(endless, &call),
            (Value::Reference(inner), "into_iter", []) => {
                self.method_of(*inner, Call { name: "iter".into(), ..call })
            }
            (Value::Reference(inner), ..) => self.method_of(*inner, call),
            (value @ Value::Place(_), ..) => match self.elements(value, &whole.receiver)? {
                Some(all) => Ok(Value::Iterator(all)),
                None => Ok(Value::Poison),
            },
            (Value::Adt(adt), ..)
                if matches!(adt.name.as_str(), "Some" | "None" | "Ok" | "Err") =>
            {
                self.holder_method(Holder(adt), &call)
            }
            (Value::Adt(adt), ..) if is_order(&adt.name) => self.order_method(&adt, &call),
            (value @ Value::Adt(_), ..) => self.method_of_own(value, call),
            (
                value,
                "clone" | "to_owned" | "borrow" | "as_ref" | "as_slice" | "as_mut" | "by_ref"
                | "each_ref" | "copied" | "cloned",
                [],
            ) if !matches!(value, Value::Scalar(_)) || call.name != "copied" => Ok(value),
            (value, "into", []) => Ok(Value::Into(Box::new(value))),
            (Value::Scalar(n), ..) => {
                let arguments =
                    std::iter::once(Value::Scalar(n)).chain(call.arguments.iter().cloned());
                match self.own_method("f64", &call.name, arguments.collect(), &call)? {
                    Some(value) => Ok(value),
                    None => self.scalar_method(n, &call),
                }
            }
            (Value::Integer(k, ty), ..) => self.integer_method(k, ty, &call),
            (value @ (Value::Vector(_) | Value::Matrix(..) | Value::Euler(_)), ..) => {
                self.component_method(&value, &call)
            }
            (Value::Planar(slot), ..) => self.body_method(Body { slot, dimension: 2 }, &call),
            (Value::Spatial(slot), ..) => self.body_method(Body { slot, dimension: 3 }, &call),
            (Value::Law(law), ..) => self.law_method(law, &call),
            (Value::Array(all), ..) => self.list_method(List { all, is_array: true }, &call),
            (Value::Into(_) | Value::Generator(_), ..) => {
                Err(Unreadable::new(&whole.method, "a method of a value of unknown type"))
            }
            (Value::Condition(holds), ..) => self.condition_method(holds, &call),
            (other, ..) => Ok(self.unknown(&call, &other.name(), "")),
        }
    }

    /// Calls a method of a struct or an enum.
    fn method_of_own(&mut self, value: Value, call: Call) -> Read {
        let Value::Adt(adt) = &value else { return Ok(Value::Poison) };
        if call.name == "clone" && call.arguments.is_empty() {
            return Ok(value);
        }
        let arguments =
            std::iter::once(value.clone()).chain(call.arguments.iter().cloned()).collect();
        if let Some(value) = self.own_method(&adt.type_name(), &call.name, arguments, &call)? {
            return Ok(value);
        }
        if let Some(told) = self.no_such_method(&adt.type_name(), &call.whole.method) {
            return Ok(told);
        }
        let template = self.template(value, &call.whole.receiver)?;
        self.opaque_method(template, call)
    }

    /// Reads `(low..=high).contains(&x)`.
    fn range_contains(&mut self, range: &syn::ExprRange, whole: &ExprMethodCall) -> Read {
        let (Some(x), 1) = (whole.args.first(), whole.args.len()) else {
            return Err(Unreadable::new(&whole.method, "this `contains`"));
        };
        let lower =
            range.start.as_ref().map(|bound| (&**bound, syn::BinOp::Ge(syn::token::Ge::default())));
        let upper = range.end.as_ref().map(|bound| match range.limits {
            syn::RangeLimits::Closed(_) => (&**bound, syn::BinOp::Le(syn::token::Le::default())),
            syn::RangeLimits::HalfOpen(_) => (&**bound, syn::BinOp::Lt(syn::token::Lt::default())),
        });
        let mut all = self.graph.bool(true);
        for (bound, op) in [lower, upper].into_iter().flatten() {
            let comparison = syn::ExprBinary {
                attrs: vec![],
                left: Box::new(x.clone()),
                op,
                right: Box::new(bound.clone()),
            };
            let value = self.binary(&comparison)?;
            let one = self.condition(value, whole);
            all = self.graph.and(all, one);
        }
        Ok(Value::Condition(all))
    }

    /// Calls a method of a value that only rustc knows.
    ///
    /// If the interpreter needs the type of the receiver, a method name of f64 makes the receiver a
    /// number, and a vector as argument makes it a vector. A receiver that is itself a parameter is
    /// an exception: the user's program decides its type.
    pub fn opaque_method(&mut self, template: Template, call: Call) -> Read {
        if matches!(call.name.as_str(), "iter" | "into_iter" | "len" | "windows" | "chunks" | "map")
            && let Some(all) = self.integers_of(&template)
        {
            return self.list_method(List { all, is_array: true }, &call);
        }
        let own = matches!(template, Template::Parameter(_));
        let applies = call.arguments.iter().any(|value| matches!(value, Value::Function(_)));
        if self.is_option(&template) || applies && is_among(WITH_CLOSURES, &call.name) {
            return self.option_at_run_time(template, &call);
        }
        if applies || call.arguments.iter().any(|value| matches!(value, Value::Iterator(_))) {
            return Err(call.unreadable("a closure passed to a user-defined function"));
        }
        let numbers = !template.nodes().is_empty()
            || call.arguments.iter().any(|value| value.numbers().is_some());
        match (call.name.as_str(), call.arguments.first().map(|value| value.clone().referent())) {
            ("sin_cos", None) if !own => self.number_method(template, &call),
            (name, _) if is_scalar_method(name) && numbers && !own => {
                self.number_method(template, &call)
            }
            (name, Some(Value::Vector(v))) if is_vector_method(name) && !own => {
                let receiver = self.vector(Value::Opaque(template), v.len(), &call.whole.receiver);
                self.component_method(&Value::Vector(receiver), &call)
            }
            _ => {
                let templates = call
                    .arguments
                    .into_iter()
                    .zip(call.places)
                    .map(|(value, place)| self.template(value, place));
                let templates = templates.collect::<Read<Vec<_>>>()?;
                let method = &call.whole.method;
                let turbofish = &call.whole.turbofish;
                let name = quote!(#method #turbofish);
                Ok(Value::Opaque(template.each(&|part| {
                    Template::Method(Box::new(part), name.clone(), templates.clone())
                })))
            }
        }
    }

    /// Calls a method of an `Option` that only rustc knows: once with `Some` and the inner value,
    /// and once with `None`.
    fn option_at_run_time(&mut self, template: Template, call: &Call) -> Read {
        let held: syn::Pat = syn::parse_quote!(Some(held));
        self.scopes.push();
        let matched = self.test(&held, &Value::Opaque(template));
        let value = self.named("held").cloned().unwrap_or(Value::Poison);
        self.scopes.pop();
        let matched = matched?;
        let some = Value::some(value);
        let none = Value::none();
        let option = self.joined(matched, &some, &none, call)?;
        self.each(option, call, &mut |reader, value| match value {
            Value::Adt(adt) => reader.holder_method(Holder(adt), call),
            value => Ok(value),
        })
    }

    /// Calls a method that changes its receiver. The function returns `None` if the method does
    /// not, or if the receiver is no variable with a known value.
    pub fn changing_method(&mut self, name: &str, whole: &ExprMethodCall) -> Read<Option<Value>> {
        let is_variable = matches!(
            strip(&whole.receiver),
            Expr::Path(_) | Expr::Field(_) | Expr::Index(_) | Expr::Unary(_)
        );
        if !is_variable {
            return Ok(None);
        }
        let own = self.own.changes(name);
        let row = |receiver: Receiver| method(receiver, name);
        let next = row(Receiver::IteratorVariable);
        let exchange = row(Receiver::HolderVariable);
        let is_read = next.is_some() || exchange.is_some() || row(Receiver::ListVariable).is_some();
        if !is_read && !own {
            return Ok(None);
        }
        let Some(place) = self.looked_into(&whole.receiver)? else { return Ok(None) };
        match self.at_place(&place).map(Value::referent) {
            Some(Value::Array(all)) if is_read => {
                self.change(&whole.receiver, &place);
                let arguments = self.expressions(whole.args.iter())?;
                self.change_list(&place, all, arguments, whole)
            }
            Some(Value::Iterator(all)) => {
                self.change(&whole.receiver, &place);
                match next {
                    Some(next) => self.next_of(next, &place, all, whole),
                    None => Ok(None),
                }
            }
            Some(value @ Value::Adt(_))
                if exchange.is_some_and(|row| row.takes() == Some(whole.args.len())) =>
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

    /// Takes a value from an iterator in a variable.
    fn next_of(
        &mut self,
        row: &Method,
        place: &Place,
        mut all: Vec<Value>,
        whole: &ExprMethodCall,
    ) -> Read<Option<Value>> {
        let k = match whole.args.first() {
            None => 0,
            Some(k) if row.takes() == Some(1) => self.known_count(k)?,
            Some(_) => return Ok(None),
        };
        let Rule::Next(rule) = row.rule else { return Ok(None) };
        if row.takes() == Some(1) && whole.args.is_empty() {
            return Ok(None);
        }
        let before = all.len();
        let found = rule(&mut all, k);
        if all.len() != before {
            let _ = self.put_at(place, Value::Iterator(all), whole);
        }
        Ok(Some(found))
    }

    fn known_count(&mut self, at: &Expr) -> Read<usize> {
        let count = self.expression(at)?;
        Values::index_of(&count, at, COUNTS)
    }

    pub fn scalar_method(&mut self, n: Node, call: &Call) -> Read {
        let name = call.name.as_str();
        if let Some(row) = method(Receiver::Number, name)
            && let Rule::Node(rule) = row.rule
        {
            return if self.is_counted(row, call) {
                rule(self, n, call)
            } else {
                Ok(Value::Poison)
            };
        }
        if is_underived(name) {
            return self.underived(n, call);
        }
        let Some(count) = numbers_beside(name) else {
            if is_among(OTHER_METHODS_OF_F64, name) {
                return Err(call.unreadable(format!("`{name}`")));
            }
            return Ok(self.unknown(call, "a number", cure(name)));
        };
        let Some(arguments) = self.scalars_of(count, call) else { return Ok(Value::Poison) };
        Ok(self.scalar_function(n, name, &arguments, call.whole))
    }

    /// Returns true if a call has the number of arguments that a method takes, else reports a
    /// mistake.
    fn is_counted(&mut self, row: &Method, call: &Call) -> bool {
        row.takes().is_none_or(|count| self.counted(count, call))
    }

    /// Returns f(x, …) for a function of f64, if the number of arguments is right.
    pub fn scalar_function(
        &mut self,
        x: Node,
        name: &str,
        arguments: &[Node],
        at: &dyn ToTokens,
    ) -> Value {
        let g = &mut self.graph;
        match (Function::from_method(name), Function2::from_method(name), arguments) {
            (Some(f), _, []) => return Value::Scalar(g.call(f, x)),
            (_, Some(f), [y]) => return Value::Scalar(g.call2(f, x, *y)),
            _ => {}
        }
        let row = method(Receiver::Number, name);
        match row.and_then(|row| row.rule_for(arguments.len())) {
            Some(Rule::Numbers(rule)) => rule(g, &[&[x], arguments].concat()),
            _ => {
                let takes = 1 + numbers_beside(name).unwrap_or(0);
                self.miscounted(name, takes, 1 + arguments.len(), at)
            }
        }
    }

    pub fn number_method(&mut self, template: Template, call: &Call) -> Read {
        match self.shaped(Value::Opaque(template), &Shape::Scalar, &call.whole.receiver) {
            Value::Scalar(n) => self.scalar_method(n, call),
            other => Ok(other),
        }
    }

    pub fn integer_method(&mut self, k: i64, ty: Option<IntegerType>, call: &Call) -> Read {
        let unreadable = || call.unreadable("this method of an integer");
        let argument = match &call.arguments[..] {
            [] => None,
            [one] => match one.clone().referent() {
                Value::Integer(n, _) => Some(n),
                _ => {
                    return Err(Unreadable::new(
                        call.places[0],
                        "integer arithmetic with an unknown value",
                    ));
                }
            },
            _ => return Err(unreadable()),
        };
        let ty = if call.name == "abs_diff" { None } else { ty };
        let row = method(Receiver::Integer, &call.name);
        let n = argument.unwrap_or_default();
        let value = match row.and_then(|row| row.rule_for(call.arguments.len())) {
            Some(Rule::OfInteger(rule)) => rule(&mut self.graph, k, n),
            // The smaller operand decides if a negative result may have an unsigned type.
            Some(Rule::Integer(rule)) => {
                rule(k, n, ty).and_then(|value| integer::made(value, ty, &[n.min(k)]))
            }
            _ if Function::from_method(&call.name).is_some() => {
                return Ok(self.mistake(
                    &call.whole.receiver,
                    crate::error::integer_for_a_number(&call.whole.receiver, k),
                ));
            }
            _ => None,
        };
        value.ok_or_else(unreadable)
    }

    pub fn condition_method(&mut self, holds: Node, call: &Call) -> Read {
        let row = method(Receiver::Condition, &call.name);
        match row.and_then(|row| row.rule_for(call.arguments.len())) {
            Some(Rule::Node(rule)) => rule(self, holds, call),
            _ => Ok(self.unknown(
                call,
                "a condition",
                ": write `if … { 1.0 } else { 0.0 }` for a number",
            )),
        }
    }

    /// Calls a method of a vector, a matrix or Euler parameters.
    pub fn component_method(&mut self, value: &Value, call: &Call) -> Read {
        let Some((kind, nodes)) = value.components() else { return Ok(Value::Poison) };
        let (receiver, cure) = match kind {
            Components::Vector(2) => (Receiver::Vector2, vector_cure(&call.name)),
            Components::Vector(_) => (Receiver::Vector3, vector_cure(&call.name)),
            Components::Matrix(_) => (
                Receiver::Matrix,
                ": the methods are `transpose`, `determinant`, `trace`, `column(k)`, `row(k)`",
            ),
            Components::Euler => (
                Receiver::Euler,
                ": the methods are `norm`, `norm_squared`, `dot`, `vector`, `conjugate`",
            ),
        };
        let Some(row) = method(receiver, &call.name) else {
            return Ok(self.unknown(call, &value.name(), cure));
        };
        match row.rule {
            _ if !self.is_counted(row, call) => Ok(Value::Poison),
            Rule::Alone(rule) => Ok(rule(self, kind, nodes)),
            Rule::Pair(rule) => {
                let other = self.other(kind, call);
                Ok(rule(self, kind, nodes, &other))
            }
            Rule::Components(rule) => rule(self, kind, nodes, call),
            _ => Ok(Value::Poison),
        }
    }

    pub fn body_method(&mut self, body: Body, call: &Call) -> Read {
        let name = call.name.as_str();
        let Some(row) = method(Receiver::Body, name) else {
            let cure = match self.state_field(body.slot, body.dimension, name) {
                Some(_) => format!(": write the field `{name}` without `()`"),
                None => ": the methods are `a()`, `point(u)`, `direction(h)`, `local(p)`".into(),
            };
            let body = body_name(body.dimension);
            return Ok(self.unknown(call, &format!("the state of {body}"), &cure));
        };
        match row.rule {
            Rule::Body(rule) if self.is_counted(row, call) => rule(self, body, call),
            _ => Ok(Value::Poison),
        }
    }

    /// Reads `law.at(x)` and `law.slope(x)`.
    pub fn law_method(&mut self, law: Template, call: &Call) -> Read {
        let Some(Rule::Law(order)) = method(Receiver::Law, &call.name).map(|row| row.rule) else {
            return Ok(self.unknown(
                call,
                "a Law",
                ": write `.at(x)` for a value and `.slope(x)` for a derivative",
            ));
        };
        let Some(x) = self.scalars_of(1, call) else { return Ok(Value::Poison) };
        let number = self.parts.law(law);
        let value = self.graph.law(number, x[0], order);
        Ok(Value::Scalar(value))
    }

    /// Calls a method of an array or of an iterator.
    pub fn list_method(&mut self, list: List, call: &Call) -> Read {
        let row = method(Receiver::List, &call.name);
        match row.and_then(|row| row.rule_for(call.arguments.len())) {
            Some(Rule::Elements(rule)) => Ok(rule(self, list.all)),
            Some(Rule::List(rule)) => rule(self, list, call),
            Some(Rule::Picked(rule)) => rule(list.all, count_in(call)?)
                .ok_or_else(|| call.unreadable("an index out of range")),
            Some(Rule::Parts(rule)) => {
                let count = call.arguments[0].clone().referent();
                let count = Values::index_of(&count, call.places[0], COUNTS)?;
                let parts = rule(&list.all, count).map(Value::Iterator);
                parts.ok_or_else(|| call.unreadable("a step of zero"))
            }
            Some(Rule::Results(rule)) => {
                let f = self.function(call.arguments[0].clone(), call.places[0])?;
                let mut each = |value: &Value| self.apply(&f, vec![value.clone()], &[], call);
                let results = list.all.iter().map(&mut each).collect::<Read<Vec<Value>>>()?;
                rule(self, list, results, call)
            }
            Some(Rule::Function(rule)) => {
                let Some(k) = call.arguments.len().checked_sub(1) else {
                    return Err(call.unreadable("this method"));
                };
                let f = self.function(call.arguments[k].clone(), call.places[k])?;
                rule(self, list.all, &f, call)
            }
            _ => Err(call.not_of_a_list()),
        }
    }

    /// Calls a method that changes a list in a variable.
    pub fn change_list(
        &mut self,
        place: &Place,
        mut all: Vec<Value>,
        arguments: Vec<Value>,
        whole: &ExprMethodCall,
    ) -> Read<Option<Value>> {
        let unknown = || Unreadable::new(&whole.method, "an unknown index");
        let arguments: Vec<Value> = arguments.into_iter().map(|value| self.loaded(value)).collect();
        let counts: Vec<usize> = arguments.iter().map_while(count).collect();
        let name = whole.method.to_string();
        let row = method(Receiver::ListVariable, &name);
        let result = match row.and_then(|row| row.rule_for(arguments.len())) {
            Some(Rule::Places(rule)) => {
                return rule(place, all.len(), &counts).map(Some).ok_or_else(unknown);
            }
            Some(Rule::Change(rule)) => {
                rule(&mut all, &arguments);
                Some(Value::unit())
            }
            Some(Rule::Edit(rule)) => rule(&mut all, &arguments, &counts).map(|()| Value::unit()),
            Some(Rule::Taken(rule)) => rule(&mut all, &counts),
            Some(Rule::Extend) => match &arguments[0] {
                Value::Array(more) | Value::Iterator(more) => {
                    all.extend(more.iter().map(|value| self.loaded(value.clone())));
                    Some(Value::unit())
                }
                _ => None,
            },
            Some(Rule::Sort) => {
                self.sort(&mut all, arguments[0].clone(), whole)?;
                Some(Value::unit())
            }
            _ => None,
        };
        match (result, name.as_str(), &counts[..]) {
            (Some(result), ..) => match self.put_at(place, Value::Array(all), whole) {
                Some(()) => Ok(Some(result)),
                None => Err(Unreadable::new(
                    &whole.method,
                    "a change of a part of an array of this length",
                )),
            },
            (None, "swap" | "insert" | "remove" | "rotate_left" | "rotate_right", [k, ..]) => {
                let k = counts.iter().find(|k| **k >= all.len()).unwrap_or(k);
                let text =
                    format!("index {k} is out of range: the value is an array of {}", all.len());
                Ok(Some(self.mistake(&whole.method, text)))
            }
            _ => Err(unknown()),
        }
    }

    /// Calls a method of an iterator without an end.
    pub fn endless_method(&mut self, endless: Endless, call: &Call) -> Read {
        // The name as the user wrote it, also behind a reference.
        let name = call.whole.method.to_string();
        let argument = call.arguments.first().cloned().map(Value::referent);
        let row = method(Receiver::Endless, &name)
            .filter(|row| (row.takes() == Some(0)) == argument.is_none());
        match (row.map(|row| row.rule), argument) {
            (Some(Rule::Endless(rule)), argument) => {
                rule(self, endless, argument.unwrap_or(Value::Poison), call)
            }
            (Some(Rule::EndlessPart(rule)), Some(count @ Value::Integer(..))) => {
                let k = Values::index_of(&count, call.places[0], COUNTS)?;
                rule(self, endless, k, call)
            }
            _ => Err(call.unreadable(format!("`{name}` of an iterator without an end"))),
        }
    }

    /// Calls a method of `Some(x)`, `None`, `Ok(x)` or `Err(e)`.
    pub fn holder_method(&mut self, holder: Holder, call: &Call) -> Read {
        let row = method(Receiver::Holder, &call.name);
        match row.and_then(|row| row.rule_for(call.arguments.len())) {
            Some(Rule::Holder(rule)) => rule(self, holder, call),
            Some(Rule::IsHeld(wanted)) => Ok(self.truth(holder.is_held() == wanted)),
            Some(Rule::HeldAnd(otherwise)) => match holder.held() {
                Some(inner) => self.applied(0, vec![inner], call),
                None => Ok(self.truth(otherwise)),
            },
            _ => self.no_such_holder_method(call),
        }
    }

    pub fn no_such_holder_method(&mut self, call: &Call) -> Read {
        let row = method(Receiver::Holder, &call.name);
        let takes = row.filter(|_| !is_among(GIVES_ON, &call.name));
        let takes = takes.map(|row| row.takes().unwrap_or(0));
        let given = call.arguments.len();
        let told = takes.and_then(|takes| self.other_count(&call.whole.method, takes, given));
        told.ok_or_else(|| call.unreadable(format!("`{}` of an `Option` or `Result`", call.name)))
    }

    /// Calls a method of an order.
    pub fn order_method(&mut self, adt: &Adt, call: &Call) -> Read {
        match method(Receiver::Order, &call.name).map(|row| row.rule) {
            Some(Rule::IsOrder(names)) => Ok(self.truth(names.contains(&adt.name.as_str()))),
            Some(Rule::Order(rule)) => rule(self, &adt.name, call),
            _ => Err(call.unreadable("this method of an order")),
        }
    }
}

const COUNTS: [&str; 2] = ["a count out of range", "an unknown count"];

/// Methods of `Option` with a closure as argument. The interpreter takes a receiver that only rustc
/// knows for an `Option` if it has one of these.
const WITH_CLOSURES: &str = "\
    map map_or map_or_else and_then unwrap_or_else is_some_and is_none_or filter or_else";

/// Methods of `Option` that give the value on. Rustc knows them with other arguments too.
const GIVES_ON: &str = "copied cloned as_ref as_mut clone as_deref take iter into_iter";

/// Returns how many numbers a function of f64 takes beside its receiver.
pub fn numbers_beside(name: &str) -> Option<usize> {
    if Function::from_method(name).is_some() {
        return Some(0);
    }
    if Function2::from_method(name).is_some() {
        return Some(1);
    }
    let row = method(Receiver::Number, name)?;
    row.takes().filter(|_| matches!(row.rule, Rule::Numbers(_)))
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
    fn a_method_is_found_by_its_receiver() {
        let (reader, value) = read(syn::parse_quote!(2.0_f64.mul_add(3.0, 1.0)));
        let Some(Value::Scalar(x)) = value else { panic!("a number") };
        assert_eq!(reader.graph.constant_value(x), Some(7.0));
        let (reader, value) = read(syn::parse_quote!(2.0_f64.arctan2(1.0)));
        assert!(matches!(value, Some(Value::Poison)) && !reader.mistakes.is_empty());
        let (reader, _) = read(syn::parse_quote!(2.0_f64.clamp(1.0)));
        assert!(!reader.mistakes.is_empty());
    }
}
