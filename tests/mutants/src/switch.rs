//! Put into the copy of `kin-core` as its module `mutants`: which mutant runs, by the environment.

use std::fs::File;
use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{LazyLock, Mutex};

/// The number of the mutant that runs; 0 for none.
static ACTIVE: LazyLock<u32> = LazyLock::new(|| {
    let number = std::env::var("KIN_MUTANT").ok().and_then(|number| number.parse().ok());
    if LOG.is_some() { u32::MAX } else { number.unwrap_or(0) }
});

/// Where the places that are reached are written to, if that is asked for.
static LOG: LazyLock<Option<Mutex<File>>> =
    LazyLock::new(|| std::env::var_os("KIN_MUTANTS_REACHED").map(|path| Mutex::new(File::create(path).expect("a file for the places reached"))));

static REACHED: [AtomicBool; 1 << 16] = [const { AtomicBool::new(false) }; 1 << 16];

/// 0 for the code as it was written, k for the k-th of `count` mutants of a place, the first of
/// which has the number `first`.
#[inline]
pub(crate) fn at(first: u32, count: u32) -> u32 {
    let active = *ACTIVE;
    if active == u32::MAX {
        reached(first);
        return 0;
    }
    let k = active.wrapping_sub(first);
    if k < count { k + 1 } else { 0 }
}

/// A number that is one, or is borrowed: whatever else is compared does not compile.
#[allow(dead_code)]
pub(crate) fn number(x: impl std::borrow::Borrow<f64>) -> f64 {
    *x.borrow()
}

#[cold]
fn reached(first: u32) {
    if !REACHED[first as usize].swap(true, Ordering::Relaxed)
        && let Some(log) = &*LOG
    {
        writeln!(log.lock().expect("no writer has failed"), "{first}").expect("the place can be written down");
    }
}
