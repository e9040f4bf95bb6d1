//! The values of variables. A log records the changes in a branch: the interpreter undoes them
//! before it reads the other branch, and then joins both.

use std::collections::BTreeMap;

use super::places::Slot;

/// The values of all variables, and a log of their earlier values.
#[derive(Default)]
pub struct Store<V> {
    /// The present value of each variable, indexed by slot.
    values: Vec<V>,
    /// The slot and the earlier value of each changed variable, in the order of the changes.
    log: Vec<(Slot, V)>,
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
pub type Changes<V> = BTreeMap<Slot, V>;

impl<V: Clone> Store<V> {
    pub fn declare(&mut self, value: V) -> Slot {
        self.values.push(value);
        self.values.len() - 1
    }

    pub fn get(&self, slot: Slot) -> &V {
        &self.values[slot]
    }

    pub fn set(&mut self, slot: Slot, value: V) {
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
    pub fn changes(&self, since: Mark) -> Changes<V> {
        let slots =
            self.log[since.log..].iter().map(|(slot, _)| *slot).filter(|slot| *slot < since.slots);
        slots.map(|slot| (slot, self.values[slot].clone())).collect()
    }

    /// Returns the value that a variable had at a mark.
    pub fn before(&self, since: Mark, slot: Slot) -> &V {
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

#[cfg(test)]
mod tests {
    use super::Store;

    #[test]
    fn a_branch_is_taken_back() {
        let mut store = Store::default();
        let x = store.declare(1);
        let since = store.begin();
        store.set(x, 2);
        let inner = store.declare(5);
        store.set(inner, 6);
        assert_eq!(store.changes(since).into_iter().collect::<Vec<_>>(), [(x, 2)]);
        assert_eq!(*store.before(since, x), 1);
        store.take_back(since);
        store.end();
        assert_eq!(*store.get(x), 1);
    }
}
