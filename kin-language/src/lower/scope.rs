//! Names during the reading of the body, and the values of variables. A name refers to a slot of
//! the store, so that closures and references see later changes of a variable. A log records the
//! changes in a branch: the interpreter undoes them before it reads the other branch, and then
//! joins both.

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

/// A step from a value to one of its parts.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Step {
    Field(String),
    Index(usize),
    /// The range from the first index to before the second.
    Slice(usize, usize),
}

impl Place {
    /// Returns the place of a whole variable.
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

/// Nested scopes; the innermost one is the last.
#[derive(Clone, Default)]
pub struct Scopes {
    scopes: Vec<Scope>,
}

#[derive(Clone, Default)]
pub struct Scope {
    variables: HashMap<String, Slot>,
    /// Functions and constants by name. They are visible before their declaration, and inside other
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

    /// Removes the innermost scope and returns it.
    pub fn take(&mut self) -> Scope {
        self.scopes.pop().unwrap_or_default()
    }

    /// Adds a scope as the innermost one.
    pub fn put(&mut self, scope: Scope) {
        self.scopes.push(scope);
    }

    /// Returns how many scopes there are.
    pub fn depth(&self) -> usize {
        self.scopes.len()
    }

    /// Returns the names that a function declared in scope number `depth` sees: the items around
    /// it, but no variables.
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

    /// Returns the names of all visible variables, each once.
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
    /// Returns the variables of this scope, by name.
    pub fn variables(&self) -> BTreeMap<String, Slot> {
        self.variables.iter().map(|(name, &slot)| (name.clone(), slot)).collect()
    }
}

/// The values of all variables, and a log of their earlier values.
#[derive(Default)]
pub struct Store {
    /// The present value of each variable, indexed by slot.
    values: Vec<Value>,
    /// The slot and the earlier value of each changed variable, in the order of the changes.
    log: Vec<(Slot, Value)>,
    /// The beginning of each branch or loop that the interpreter is reading, outermost first.
    marks: Vec<Mark>,
}

/// A position in the log, and the number of variables at that time. Changes of younger variables
/// are not logged.
#[derive(Clone, Copy)]
pub struct Mark {
    log: usize,
    slots: usize,
}

/// The values of variables by slot.
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

    /// Begins to log changes, and returns a mark.
    pub fn begin(&mut self) -> Mark {
        let mark = Mark { log: self.log.len(), slots: self.values.len() };
        self.marks.push(mark);
        mark
    }

    /// Returns the variables that have changed since a mark, with their present values.
    pub fn changes(&self, since: Mark) -> Changes {
        let slots =
            self.log[since.log..].iter().map(|(slot, _)| *slot).filter(|slot| *slot < since.slots);
        slots.map(|slot| (slot, self.values[slot].clone())).collect()
    }

    /// Returns the value that a variable had at a mark.
    pub fn before(&self, since: Mark, slot: Slot) -> &Value {
        self.log[since.log..]
            .iter()
            .find(|(logged, _)| *logged == slot)
            .map_or(&self.values[slot], |(_, old)| old)
    }

    /// Undoes the changes since the mark.
    pub fn take_back(&mut self, since: Mark) {
        while self.log.len() > since.log {
            if let Some((slot, old)) = self.log.pop() {
                self.values[slot] = old;
            }
        }
    }

    /// Ends the logging that the last [`Store::begin`] began.
    pub fn end(&mut self) {
        self.marks.pop();
        if self.marks.is_empty() {
            self.log.clear();
        }
    }
}
