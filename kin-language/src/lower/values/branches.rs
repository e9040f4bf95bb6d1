//! The flow of control: branches by conditions that depend on coordinates, and exits before the
//! end. `return`, `break` and `continue` share one mechanism: an exit from a frame, with the
//! condition under which the code takes it, its value, and the variables at that point. The end of
//! the frame joins all exits.

use quote::ToTokens;

use super::{Read, Unreadable, Value, Values};
use crate::lower::scope::{Changes, Exit, Frame, Guard, Kind, Mark};
use kin_graph::{Node, Op};

/// The most exits of one frame: a body with more of them takes the dual route.
const MOST_EXITS: usize = 256;

impl Values {
    /// Begins a frame.
    pub fn enter(&mut self, kind: Kind, label: Option<String>) {
        let since = self.store.begin();
        self.flow.frames.push(Frame {
            kind,
            label,
            exits: vec![],
            path: self.flow.path.len(),
            since,
        });
    }

    /// Leaves a frame with a value.
    pub fn leave(&mut self, number: usize, value: Value, at: &dyn ToTokens) -> Read {
        let frame = &self.flow.frames[number];
        if frame.exits.len() == MOST_EXITS {
            return Err(Unreadable::new(at, "a loop or function with so many exits"));
        }
        let on_the_way: Vec<Node> = self.flow.path[frame.path..]
            .iter()
            .filter(|guard| guard.left.is_none_or(|left| left > number))
            .map(|guard| guard.holds)
            .collect();
        // No code reads the variables after the end of the function.
        let changes = if number == 0 { Changes::new() } else { self.store.changes(frame.since) };
        let always = self.graph.bool(true);
        let condition = on_the_way.into_iter().fold(always, |all, one| self.graph.and(all, one));
        self.flow.frames[number].exits.push(Exit { condition, value, changes });
        let never = self.graph.bool(false);
        self.flow.path.push(Guard { holds: never, left: Some(number) });
        Ok(Value::Left)
    }

    /// Ends the innermost frame, whose end gives `value`, and joins all exits from it.
    pub fn exit(&mut self, value: Value, at: &dyn ToTokens) -> Read {
        let Some(Frame { exits, path, since, .. }) = self.flow.frames.pop() else {
            return Ok(value);
        };
        let outside = self.flow.frames.len();
        let others: Vec<Guard> = self
            .flow
            .path
            .split_off(path)
            .into_iter()
            .filter(|guard| guard.left.is_some_and(|left| left < outside))
            .collect();
        self.flow.path.extend(others);
        let mut value = value;
        for Exit { condition, value: given, changes } in exits.into_iter().rev() {
            let reached = !matches!(value, Value::Left);
            let now = self.store.changes(since);
            for slot in
                changes.keys().chain(now.keys()).copied().collect::<std::collections::BTreeSet<_>>()
            {
                let then = changes
                    .get(&slot)
                    .cloned()
                    .unwrap_or_else(|| self.store.before(since, slot).clone());
                let joined = match reached {
                    true => {
                        self.variable_of_both(condition, &then, &self.store.get(slot).clone(), at)?
                    }
                    false => then,
                };
                self.store.set(slot, joined);
            }
            value = match (reached, self.select(condition, &given, &value)) {
                (false, _) => given,
                (true, Some(joined)) => joined,
                (true, None) if matches!(given, Value::Poison) => value,
                (true, None) => self.mistake(
                    at,
                    format!(
                        "the loop or function gives {} in one place, and {} in another",
                        given.name(),
                        value.name()
                    ),
                ),
            };
        }
        self.store.end();
        Ok(value)
    }

    /// Joins the changes of variables in two branches; the store holds those of the second branch.
    pub fn variables_of_both(
        &mut self,
        condition: Node,
        values: [&Value; 2],
        after_yes: Changes<Value>,
        since: Mark,
        at: &dyn ToTokens,
    ) -> Read<()> {
        let after_no = self.store.changes(since);
        let slots: std::collections::BTreeSet<usize> =
            after_yes.keys().chain(after_no.keys()).copied().collect();
        for slot in slots {
            let before = self.store.before(since, slot).clone();
            let a = after_yes.get(&slot).unwrap_or(&before);
            let b = after_no.get(&slot).unwrap_or(&before);
            let joined = match values {
                [Value::Left, Value::Left] => continue,
                [Value::Left, _] => continue,
                [_, Value::Left] => a.clone(),
                // No code after `panic!` reads a variable.
                [Value::Never, _] if matches!(a, Value::Unassigned) => b.clone(),
                [_, Value::Never] if matches!(b, Value::Unassigned) => a.clone(),
                _ => self.variable_of_both(condition, a, b, at)?,
            };
            self.store.set(slot, joined);
        }
        Ok(())
    }

    pub fn variable_of_both(
        &mut self,
        condition: Node,
        a: &Value,
        b: &Value,
        at: &dyn ToTokens,
    ) -> Read {
        match (a, b) {
            (Value::Unassigned, other) | (other, Value::Unassigned) => {
                Ok(self.perhaps(other.clone()))
            }
            (Value::Perhaps(a), b) | (b, Value::Perhaps(a)) => {
                let b = if let Value::Perhaps(b) = b { b } else { b };
                let joined = self.select(condition, a, b).unwrap_or(Value::Poison);
                Ok(self.perhaps(joined))
            }
            _ => self.select(condition, a, b).ok_or_else(|| {
                Unreadable::new(at, "a variable of different types in two branches")
            }),
        }
    }

    /// Adds a condition that holds after two branches: the code has left none of the frames that
    /// one of the branches leaves.
    pub fn not_left(&mut self, condition: Node, yes: &[Guard], no: &[Guard]) {
        let frames: std::collections::BTreeSet<usize> =
            yes.iter().chain(no).filter_map(|guard| guard.left).collect();
        let otherwise = self.graph.not(condition);
        for frame in frames {
            let mut holds = self.graph.bool(true);
            for (guards, unless) in [(yes, otherwise), (no, condition)] {
                let always = self.graph.bool(true);
                let stays = guards
                    .iter()
                    .filter(|guard| guard.left == Some(frame))
                    .fold(always, |all, guard| self.graph.and(all, guard.holds));
                let one = self.graph.or(unless, stays);
                holds = self.graph.and(holds, one);
            }
            self.flow.path.push(Guard { holds, left: Some(frame) });
        }
    }

    /// Returns the part of a condition that is not known at the present position. The condition of
    /// an alternative begins with the negation of those before it, which the path already contains.
    pub fn left_open(&mut self, condition: Node) -> Node {
        match self.graph.op(condition) {
            Op::And(a, b) if self.flow.path.iter().any(|guard| guard.holds == a) => {
                self.left_open(b)
            }
            _ => condition,
        }
    }
}

/// Reads both branches of a condition, and each of several possible values.
pub trait Branching: AsMut<Values> {
    /// Reads both branches, unless the condition is known, and joins their values and their changes
    /// of variables.
    fn choose(
        &mut self,
        condition: Node,
        yes: impl FnOnce(&mut Self) -> Read,
        no: impl FnOnce(&mut Self) -> Read,
        at: &dyn ToTokens,
    ) -> Read {
        let values = self.as_mut();
        match values.graph.truth(condition) {
            Some(true) => return yes(self),
            Some(false) => return no(self),
            None => {}
        }
        let depth = values.flow.path.len();
        let since = values.store.begin();
        values.flow.path.push(Guard::branch(condition));
        let a = yes(self)?;
        let values = self.as_mut();
        let left_by_yes = values.flow.path.split_off(depth + 1);
        let after_yes = values.store.changes(since);
        values.store.take_back(since);
        let otherwise = values.graph.not(condition);
        values.flow.path.truncate(depth);
        values.flow.path.push(Guard::branch(otherwise));
        let b = no(self)?;
        let values = self.as_mut();
        let left_by_no = values.flow.path.split_off(depth + 1);
        values.flow.path.truncate(depth);
        values.variables_of_both(condition, [&a, &b], after_yes, since, at)?;
        values.store.end();
        values.not_left(condition, &left_by_yes, &left_by_no);
        values.joined(condition, &a, &b, at)
    }

    /// Applies `f` to each of several possible values and joins the results.
    fn each(
        &mut self,
        value: Value,
        at: &dyn ToTokens,
        f: &mut dyn FnMut(&mut Self, Value) -> Read,
    ) -> Read {
        match value {
            Value::Choice(all) => self.each_of(&all, at, f),
            value => f(self, value),
        }
    }

    fn each_of(
        &mut self,
        all: &[(Node, Value)],
        at: &dyn ToTokens,
        f: &mut dyn FnMut(&mut Self, Value) -> Read,
    ) -> Read {
        match all {
            [] => Ok(Value::Never),
            [(_, last)] => f(self, last.clone()),
            [(condition, first), rest @ ..] => {
                let both = std::cell::RefCell::new(f);
                let condition = self.as_mut().left_open(*condition);
                self.choose(
                    condition,
                    |reader| (both.borrow_mut())(reader, first.clone()),
                    |reader| reader.each_of(rest, at, *both.borrow_mut()),
                    at,
                )
            }
        }
    }

    /// Applies `f` to each combination of several possible values and joins the results.
    fn each_list(
        &mut self,
        mut values: Vec<Value>,
        at: &dyn ToTokens,
        f: &mut dyn FnMut(&mut Self, Vec<Value>) -> Read,
    ) -> Read {
        let Some(k) = values.iter().position(|value| matches!(value, Value::Choice(_))) else {
            return f(self, values);
        };
        let choice = std::mem::replace(&mut values[k], Value::Poison);
        self.each(choice, at, &mut |reader, one| {
            let mut values = values.clone();
            values[k] = one;
            reader.each_list(values, at, f)
        })
    }
}

impl<W: AsMut<Values>> Branching for W {}

#[cfg(test)]
mod tests {
    use super::*;
    use kin_graph::{Comparison, Graph, Input};
    use quote::quote;

    #[test]
    fn a_variable_joins_what_both_branches_give_it() {
        let mut values = Values::new(Graph::default());
        let k = values.graph.input(Input::Parameter(0));
        let zero = values.graph.zero();
        let holds = values.graph.compare(Comparison::Less, k, zero);
        let one = values.graph.constant(1.0);
        values.declare("x".into(), Value::Scalar(zero));
        let set = |values: &mut Values| {
            values.store.set(0, Value::Scalar(one));
            Ok(Value::unit())
        };
        let read = values.choose(holds, set, |_| Ok(Value::unit()), &quote!(x));
        assert!(read.is_ok());
        let joined = values.graph.select(holds, one, zero);
        assert!(matches!(values.named("x"), Some(Value::Scalar(x)) if *x == joined));
        assert!(values.flow.path.is_empty());
    }

    #[test]
    fn a_known_condition_leaves_one_branch() {
        let mut values = Values::new(Graph::default());
        let never = values.graph.bool(false);
        let yes = |_: &mut Values| panic!("this branch is not taken");
        let read = values.choose(never, yes, |_| Ok(Value::count(7)), &quote!(x));
        assert!(matches!(read, Ok(Value::Integer(7, _))));
    }
}
