//! Stores names that live as long as the program, because the facts of constraints require such
//! names.
//!
//! Kin stores each name once and limits the memory of all names.

use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

/// Bytes of all names together.
const MOST: usize = 1 << 20;

struct Interned {
    names: BTreeSet<&'static str>,
    bytes: usize,
}

static INTERNED: Mutex<Interned> = Mutex::new(Interned { names: BTreeSet::new(), bytes: 0 });

/// Returns the stored name.
///
/// Errors: all texts together have too many names.
pub fn interned(name: &str) -> Result<&'static str, String> {
    let mut interned = INTERNED.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = interned.names.get(name) {
        return Ok(known);
    }
    if interned.bytes + name.len() > MOST {
        return Err(format!("the names in all texts of this program need more than {MOST} bytes"));
    }
    interned.bytes += name.len();
    let name: &'static str = Box::leak(name.into());
    interned.names.insert(name);
    Ok(name)
}
