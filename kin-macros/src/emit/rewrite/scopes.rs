//! The variables of a body while it is rewritten: which name means which binding, and what each
//! binding can hold.
//!
//! The value of a binding is known only when the whole body has been seen (a loop feeds a variable
//! from below), so the body is gone through until nothing changes any more. Bindings are numbered
//! in the order in which they are met, the same each time.

use std::collections::HashMap;

/// The natures that a value may have.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug)]
pub struct Nature {
    /// It may depend on coordinates or time.
    pub varies: bool,
    /// It may be of a type that only rustc knows, or hold f64 in one.
    pub foreign: bool,
}

impl Nature {
    pub const ANY: Nature = Nature { varies: true, foreign: true };

    pub fn or(self, other: Nature) -> Nature {
        Nature { varies: self.varies || other.varies, foreign: self.foreign || other.foreign }
    }
}

/// Numbers of the bindings in each argument of a function.
pub type Inputs = Vec<Vec<usize>>;

/// The meaning of a name.
#[derive(Clone, Debug)]
pub enum Name {
    Variable(Variable),
    /// A function inside the body; `lifted` if numbers go in or out.
    Function {
        inputs: Inputs,
        lifted: bool,
    },
    /// Any other item inside the body.
    Item,
}

#[derive(Clone, Debug)]
pub struct Variable {
    pub number: usize,
    /// A parameter whose type is the user's.
    pub own: bool,
    /// Of the closure that is bound to it.
    pub inputs: Option<Inputs>,
}

#[derive(Default)]
pub struct Scopes {
    stack: Vec<HashMap<String, Name>>,
    natures: Vec<Nature>,
    next: usize,
    changed: bool,
}

impl Scopes {
    /// Begins another pass; what was found about bindings is kept.
    pub fn restart(&mut self) {
        self.stack = vec![HashMap::new()];
        self.next = 0;
        self.changed = false;
    }

    /// True if this pass found out something that earlier ones did not know.
    pub fn changed(&self) -> bool {
        self.changed
    }

    pub fn push(&mut self) {
        self.stack.push(HashMap::new());
    }

    pub fn pop(&mut self) {
        self.stack.pop();
    }

    /// Inside of a function no variable around it is seen; gives what was seen outside.
    pub fn enter_function(&mut self) -> Vec<HashMap<String, Name>> {
        let items = |scope: &HashMap<String, Name>| {
            let items = scope.iter().filter(|(_, name)| !matches!(name, Name::Variable(_)));
            items.map(|(text, name)| (text.clone(), name.clone())).collect()
        };
        let inside = self.stack.iter().map(items).collect();
        std::mem::replace(&mut self.stack, inside)
    }

    pub fn leave_function(&mut self, outside: Vec<HashMap<String, Name>>) {
        self.stack = outside;
    }

    /// A new binding; its number.
    pub fn binding(&mut self, nature: Nature) -> usize {
        let number = self.next;
        self.next += 1;
        if number == self.natures.len() {
            self.natures.push(Nature::default());
        }
        self.add(number, nature);
        number
    }

    pub fn declare(&mut self, text: String, name: Name) {
        if let Some(scope) = self.stack.last_mut() {
            scope.insert(text, name);
        }
    }

    pub fn get(&self, text: &str) -> Option<&Name> {
        self.stack.iter().rev().find_map(|scope| scope.get(text))
    }

    pub fn nature(&self, number: usize) -> Nature {
        self.natures.get(number).copied().unwrap_or(Nature::ANY)
    }

    /// A binding may hold this too.
    pub fn add(&mut self, number: usize, nature: Nature) {
        if let Some(known) = self.natures.get_mut(number) {
            let all = known.or(nature);
            self.changed |= all != *known;
            *known = all;
        }
    }
}
