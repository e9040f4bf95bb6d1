//! Variables while the body is read.

use std::collections::HashMap;

use super::value::Value;

/// Nested scopes, innermost last. Scopes below `floor` belong to the surroundings of a closure and cannot be assigned to.
#[derive(Clone, Default)]
pub struct Scopes {
    scopes: Vec<HashMap<String, Value>>,
    floor: usize,
}

impl Scopes {
    pub fn push(&mut self) {
        self.scopes.push(HashMap::new());
    }

    pub fn pop(&mut self) {
        self.scopes.pop();
    }

    /// From here on only new variables can be assigned to.
    pub fn raise_floor(&mut self) {
        self.floor = self.scopes.len();
    }

    pub fn declare(&mut self, name: String, value: Value) {
        match self.scopes.last_mut() {
            Some(scope) => drop(scope.insert(name, value)),
            None => self.scopes.push(HashMap::from([(name, value)])),
        }
    }

    pub fn get(&self, name: &str) -> Option<&Value> {
        self.scopes.iter().rev().find_map(|scope| scope.get(name))
    }

    /// The variable to assign to; `Err` if it lies outside of a closure.
    pub fn get_mut(&mut self, name: &str) -> Result<Option<&mut Value>, OutsideClosure> {
        let Some(level) = self.scopes.iter().rposition(|scope| scope.contains_key(name)) else { return Ok(None) };
        match level < self.floor {
            true => Err(OutsideClosure),
            false => Ok(self.scopes[level].get_mut(name)),
        }
    }

    /// Joins two outcomes of a branch, variable by variable; the name of the first that cannot be joined.
    pub fn merge(&mut self, other: &Scopes, mut join: impl FnMut(&Value, &Value) -> Option<Value>) -> Result<(), String> {
        for (mine, theirs) in self.scopes.iter_mut().zip(&other.scopes) {
            let mut names: Vec<String> = mine.keys().cloned().collect();
            names.sort();
            for name in names {
                if let (Some(a), Some(b)) = (mine.get(&name), theirs.get(&name)) {
                    let joined = join(a, b).ok_or_else(|| name.clone())?;
                    mine.insert(name, joined);
                }
            }
        }
        Ok(())
    }
}

/// A closure tries to change a variable around it.
pub struct OutsideClosure;
