//! Stores the dimensions of a mechanism while the user describes the mechanism.
//!
//! Operators write expressions into the graph of the mechanism, but the operands are only handles
//! that are `Copy`. An operator finds the graph by the number of the mechanism, in a table of all
//! existing mechanisms with dimensions.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

use kin_graph::{Graph, Node};

use super::{Distribution, Of};
use crate::coordinates::MechanismId;

/// The dimensions of one mechanism and of its copies.
#[derive(Default)]
pub(crate) struct Store {
    pub graph: Graph,
    pub entries: Vec<Entry>,
    /// An expression that received a range, a tolerance or a unit, which only a dimension can have.
    /// `None` if there is no such mistake.
    pub misplaced: Option<Node>,
}

/// A dimension and its properties.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    pub name: String,
    pub node: Node,
    /// True for a named expression of other dimensions.
    pub is_derived: bool,
    pub value: f64,
    pub unit: String,
    pub range: Option<[f64; 2]>,
    pub tolerance: Option<f64>,
    pub distribution: Option<Distribution>,
    /// The clearance of which this is one of two dimensions; `None` for any other dimension.
    pub clearance: Option<String>,
}

/// A store that the number of its mechanism finds as long as somebody holds the store.
pub(crate) struct Shared {
    mechanism: MechanismId,
    store: Mutex<Store>,
}

static STORES: Mutex<BTreeMap<u64, Weak<Shared>>> = Mutex::new(BTreeMap::new());

impl Shared {
    /// Creates an empty store.
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

/// Calls `act` with the store and the node of an expression. Returns `None` if the store no longer
/// exists.
pub(super) fn with<T>(of: Of, act: impl FnOnce(&mut Store, Node) -> T) -> Option<T> {
    let Of::Expression(mechanism, node) = of else { return None };
    let shared = lock(&STORES).get(&mechanism.0).and_then(Weak::upgrade)?;
    let made = act(&mut shared.store(), node);
    Some(made)
}

/// Locks a mutex. A panic in another thread does not invalidate the value.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
