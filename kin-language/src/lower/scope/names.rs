//! Names during the reading of the body. A name refers to a slot of the store, so that closures and
//! references see later changes of a variable.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::places::Slot;

/// Nested scopes; the innermost one is the last.
#[derive(Clone, Default)]
pub struct Scopes<V> {
    scopes: Vec<Scope<V>>,
}

#[derive(Clone, Default)]
pub struct Scope<V> {
    variables: HashMap<String, Slot>,
    /// Functions and constants by name. They are visible before their declaration, and inside other
    /// functions.
    items: HashMap<String, V>,
}

/// The meaning of a name.
pub enum Name<'a, V> {
    Variable(Slot),
    Item(&'a V),
}

impl<V: Clone + Default> Scopes<V> {
    pub fn push(&mut self) {
        self.scopes.push(Scope::default());
    }

    pub fn pop(&mut self) {
        self.scopes.pop();
    }

    /// Removes the innermost scope and returns it.
    pub fn take(&mut self) -> Scope<V> {
        self.scopes.pop().unwrap_or_default()
    }

    /// Adds a scope as the innermost one.
    pub fn put(&mut self, scope: Scope<V>) {
        self.scopes.push(scope);
    }

    /// Returns how many scopes there are.
    pub fn depth(&self) -> usize {
        self.scopes.len()
    }

    /// Returns the names that a function declared in scope number `depth` sees: the items around
    /// it, but no variables.
    pub fn around_function(&self, depth: usize) -> Scopes<V> {
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

    pub fn declare_item(&mut self, name: String, value: V) {
        self.innermost().items.insert(name, value);
    }

    fn innermost(&mut self) -> &mut Scope<V> {
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

    pub fn get(&self, name: &str) -> Option<Name<'_, V>> {
        self.scopes.iter().rev().find_map(|scope| match scope.variables.get(name) {
            Some(&slot) => Some(Name::Variable(slot)),
            None => scope.items.get(name).map(Name::Item),
        })
    }
}

impl<V> Scope<V> {
    /// Returns the variables of this scope, by name.
    pub fn variables(&self) -> BTreeMap<String, Slot> {
        self.variables.iter().map(|(name, &slot)| (name.clone(), slot)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{Name, Scopes};

    #[test]
    fn an_inner_name_hides_an_outer_one() {
        let mut scopes = Scopes::<f64>::default();
        scopes.push();
        scopes.declare("x".into(), 0);
        scopes.declare_item("g".into(), 9.81);
        scopes.push();
        scopes.declare("x".into(), 1);
        assert!(matches!(scopes.get("x"), Some(Name::Variable(1))));
        scopes.pop();
        assert!(matches!(scopes.get("x"), Some(Name::Variable(0))));
        let inside = scopes.around_function(1);
        assert!(inside.get("x").is_none());
        assert!(matches!(inside.get("g"), Some(Name::Item(g)) if *g == 9.81));
    }
}
