//! Names while the body is read, and the values of variables. A name means a slot of the store, so
//! that closures and references see what becomes of a variable later; what a branch did to slots is
//! taken back from a log, and joined with what the other one did.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::value::Value;

/// The number of a variable.
pub type Slot = usize;

/// A variable, or a part of one.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Place {
    pub slot: Slot,
    pub steps: Vec<Step>,
}

/// On the way to a part.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Step {
    Field(String),
    Index(usize),
    /// From the first to before the second.
    Slice(usize, usize),
}

impl Place {
    /// All of a variable.
    pub fn whole(slot: Slot) -> Place {
        Place { slot, steps: vec![] }
    }

    fn to(&self, step: Step) -> Place {
        let steps = self.steps.iter().cloned().chain([step]).collect();
        Place { steps, ..self.clone() }
    }

    pub fn field(&self, name: &str) -> Place {
        self.to(Step::Field(name.into()))
    }

    pub fn index(&self, k: usize) -> Place {
        self.to(Step::Index(k))
    }

    pub fn slice(&self, from: usize, to: usize) -> Place {
        self.to(Step::Slice(from, to))
    }
}

/// Nested scopes, innermost last.
#[derive(Clone, Default)]
pub struct Scopes {
    scopes: Vec<Scope>,
}

#[derive(Clone, Default)]
pub struct Scope {
    variables: HashMap<String, Slot>,
    /// Functions and constants, which are seen from before their own line, and from inside of other
    /// functions.
    items: HashMap<String, Value>,
}

/// The meaning of a name.
pub enum Name<'a> {
    Variable(Slot),
    Item(&'a Value),
}

impl Scopes {
    pub fn push(&mut self) {
        self.scopes.push(Scope::default());
    }

    pub fn pop(&mut self) {
        self.scopes.pop();
    }

    /// The innermost scope, taken off.
    pub fn take(&mut self) -> Scope {
        self.scopes.pop().unwrap_or_default()
    }

    /// The scope put on again.
    pub fn put(&mut self, scope: Scope) {
        self.scopes.push(scope);
    }

    /// How many scopes there are.
    pub fn depth(&self) -> usize {
        self.scopes.len()
    }

    /// The names that a function sees which is declared in scope number `depth`: the items around
    /// it, and none of the variables.
    pub fn around_function(&self, depth: usize) -> Scopes {
        let items = self
            .scopes
            .iter()
            .take(depth)
            .map(|scope| Scope { variables: HashMap::new(), items: scope.items.clone() });
        Scopes { scopes: items.collect() }
    }

    pub fn declare(&mut self, name: String, slot: Slot) {
        self.innermost().variables.insert(name, slot);
    }

    pub fn declare_item(&mut self, name: String, value: Value) {
        self.innermost().items.insert(name, value);
    }

    fn innermost(&mut self) -> &mut Scope {
        if self.scopes.is_empty() {
            self.push();
        }
        let last = self.scopes.len() - 1;
        &mut self.scopes[last]
    }

    /// The names of all variables that are seen, each once.
    pub fn variables(&self) -> BTreeSet<&str> {
        self.scopes.iter().flat_map(|scope| scope.variables.keys().map(String::as_str)).collect()
    }

    pub fn get(&self, name: &str) -> Option<Name<'_>> {
        self.scopes.iter().rev().find_map(|scope| match scope.variables.get(name) {
            Some(&slot) => Some(Name::Variable(slot)),
            None => scope.items.get(name).map(Name::Item),
        })
    }
}

impl Scope {
    /// Its variables, by name.
    pub fn variables(&self) -> BTreeMap<String, Slot> {
        self.variables.iter().map(|(name, &slot)| (name.clone(), slot)).collect()
    }
}

/// The values of all variables, and a log of what they were before.
#[derive(Default)]
pub struct Store {
    values: Vec<Value>,
    log: Vec<(Slot, Value)>,
    /// Where each branch or loop that is being read began.
    marks: Vec<Mark>,
}

/// A place in the log, and how many variables there were.
#[derive(Clone, Copy)]
pub struct Mark {
    log: usize,
    slots: usize,
}

/// Values of variables by their slots.
pub type Changes = BTreeMap<Slot, Value>;

impl Store {
    pub fn declare(&mut self, value: Value) -> Slot {
        self.values.push(value);
        self.values.len() - 1
    }

    pub fn get(&self, slot: Slot) -> &Value {
        &self.values[slot]
    }

    pub fn set(&mut self, slot: Slot, value: Value) {
        let old = std::mem::replace(&mut self.values[slot], value);
        if self.marks.last().is_some_and(|mark| slot < mark.slots) {
            self.log.push((slot, old));
        }
    }

    /// From here on changes are told apart.
    pub fn begin(&mut self) -> Mark {
        let mark = Mark { log: self.log.len(), slots: self.values.len() };
        self.marks.push(mark);
        mark
    }

    /// The variables that have changed since a mark, as they are now.
    pub fn changes(&self, since: Mark) -> Changes {
        let slots =
            self.log[since.log..].iter().map(|(slot, _)| *slot).filter(|slot| *slot < since.slots);
        slots.map(|slot| (slot, self.values[slot].clone())).collect()
    }

    /// The value that a variable had at a mark.
    pub fn before(&self, since: Mark, slot: Slot) -> &Value {
        self.log[since.log..]
            .iter()
            .find(|(logged, _)| *logged == slot)
            .map_or(&self.values[slot], |(_, old)| old)
    }

    /// The changes since the mark taken back.
    pub fn take_back(&mut self, since: Mark) {
        while self.log.len() > since.log {
            if let Some((slot, old)) = self.log.pop() {
                self.values[slot] = old;
            }
        }
    }

    /// Changes are no longer told apart.
    pub fn end(&mut self) {
        self.marks.pop();
        if self.marks.is_empty() {
            self.log.clear();
        }
    }
}
