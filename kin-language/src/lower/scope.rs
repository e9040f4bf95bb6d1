//! Variables while the body is read.

use std::collections::{BTreeSet, HashMap};

use super::value::Value;

/// Nested scopes, innermost last. Scopes below `floor` belong to the surroundings of a closure and cannot be assigned to.
#[derive(Clone, Default)]
pub struct Scopes {
    scopes: Vec<Scope>,
    floor: usize,
}

#[derive(Clone, Default)]
struct Scope {
    variables: HashMap<String, Value>,
    /// Functions and constants, which are seen from before their own line, and from inside of other functions.
    items: HashMap<String, Value>,
}

impl Scopes {
    pub fn push(&mut self) {
        self.scopes.push(Scope::default());
    }

    pub fn pop(&mut self) {
        self.scopes.pop();
    }

    /// How many scopes there are.
    pub fn depth(&self) -> usize {
        self.scopes.len()
    }

    /// Forgets what the innermost scope declares.
    pub fn clear_innermost(&mut self) {
        if let Some(scope) = self.scopes.last_mut() {
            *scope = Scope::default();
        }
    }

    /// From here on only new variables can be assigned to.
    pub fn raise_floor(&mut self) {
        self.floor = self.scopes.len();
    }

    /// What a function sees that is declared in scope number `depth`: the items around it, and none of the variables.
    pub fn around_function(&self, depth: usize) -> Scopes {
        let items = self.scopes.iter().take(depth).map(|scope| Scope { variables: HashMap::new(), items: scope.items.clone() });
        Scopes { scopes: items.collect(), floor: 0 }
    }

    pub fn declare(&mut self, name: String, value: Value) {
        self.innermost().variables.insert(name, value);
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

    pub fn get(&self, name: &str) -> Option<&Value> {
        self.scopes.iter().rev().find_map(|scope| scope.variables.get(name).or_else(|| scope.items.get(name)))
    }

    /// The variable to assign to; `Err` if it lies outside of a closure.
    pub fn get_mut(&mut self, name: &str) -> Result<Option<&mut Value>, OutsideClosure> {
        let Some(level) = self.scopes.iter().rposition(|scope| scope.variables.contains_key(name)) else { return Ok(None) };
        match level < self.floor {
            true => Err(OutsideClosure),
            false => Ok(self.scopes[level].variables.get_mut(name)),
        }
    }

    /// Joins two outcomes of a branch, variable by variable; the name of the first that cannot be joined.
    pub fn merge(&mut self, other: &Scopes, mut join: impl FnMut(&Value, &Value) -> Option<Value>) -> Result<(), String> {
        for (mine, theirs) in self.scopes.iter_mut().zip(&other.scopes) {
            let mut names: Vec<String> = mine.variables.keys().cloned().collect();
            names.sort();
            for name in names {
                if let (Some(a), Some(b)) = (mine.variables.get(&name), theirs.variables.get(&name)) {
                    let joined = join(a, b).ok_or_else(|| name.clone())?;
                    mine.variables.insert(name, joined);
                }
            }
        }
        Ok(())
    }
}

/// A closure tries to change a variable around it.
pub struct OutsideClosure;
