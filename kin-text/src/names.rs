//! Names that live as long as the program, as facts of constraints ask for: each is kept once, and
//! all of them together take a bounded part of memory.

use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

/// Bytes of all names together.
const MOST: usize = 1 << 20;

struct Interned {
    names: BTreeSet<&'static str>,
    bytes: usize,
}

static INTERNED: Mutex<Interned> = Mutex::new(Interned { names: BTreeSet::new(), bytes: 0 });

/// The name, kept. Errors: names of all texts together have become too many.
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
