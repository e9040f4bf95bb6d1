//! The dimensions of one mechanism while it is described. Expressions are written into its graph by
//! operators that see no mechanism, only handles that can be copied: so that the graph is found by
//! the mechanism's number, among those of all mechanisms that have dimensions and still exist.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

use kin_graph::{Graph, Node};

use super::{Distribution, Of};
use crate::model::coordinates::MechanismId;

/// The dimensions of one mechanism and of its copies.
#[derive(Default)]
pub(crate) struct Store {
    pub graph: Graph,
    pub entries: Vec<Entry>,
    /// An expression that was given a range, a tolerance or a unit, which only a dimension has.
    pub misplaced: Option<Node>,
}

/// A dimension as it is described.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    pub name: String,
    pub node: Node,
    /// True if it is an expression of others, with a name.
    pub is_derived: bool,
    pub value: f64,
    pub unit: String,
    pub range: Option<[f64; 2]>,
    pub tolerance: Option<f64>,
    pub distribution: Option<Distribution>,
    /// The clearance that it is one of the two dimensions of.
    pub clearance: Option<String>,
}

/// A store that can be found by the number of its mechanism as long as somebody holds it.
pub(crate) struct Shared {
    mechanism: MechanismId,
    store: Mutex<Store>,
}

static STORES: Mutex<BTreeMap<u64, Weak<Shared>>> = Mutex::new(BTreeMap::new());

impl Shared {
    /// An empty one.
    pub(crate) fn new(mechanism: MechanismId) -> Arc<Shared> {
        let shared = Arc::new(Shared { mechanism, store: Mutex::default() });
        lock(&STORES).insert(mechanism.0, Arc::downgrade(&shared));
        shared
    }

    pub(crate) fn store(&self) -> MutexGuard<'_, Store> {
        lock(&self.store)
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        lock(&STORES).remove(&self.mechanism.0);
    }
}

/// The result of `act` with the store and the node of an expression; `None` if there is no store
/// any more.
pub(super) fn with<T>(of: Of, act: impl FnOnce(&mut Store, Node) -> T) -> Option<T> {
    let Of::Expression(mechanism, node) = of else { return None };
    let shared = lock(&STORES).get(&mechanism.0).and_then(Weak::upgrade)?;
    let made = act(&mut shared.store(), node);
    Some(made)
}

/// The value behind a lock; that another thread has panicked is that thread's matter.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
