//! Things that upper rooms make of a system once and keep beside it, until anything in it is set.

use std::any::Any;
use std::sync::{Arc, Mutex, PoisonError};

/// One thing of whatever type, or nothing. A copy of a system has the same.
#[derive(Default)]
pub(crate) struct Cache(Mutex<Option<Arc<dyn Any + Send + Sync>>>);

impl Cache {
    /// The thing that is kept, if it is of that type.
    pub(crate) fn get<T: Any + Send + Sync>(&self) -> Option<Arc<T>> {
        self.now().and_then(|known| known.downcast().ok())
    }

    /// Keeps this from now on.
    pub(crate) fn put<T: Any + Send + Sync>(&self, thing: Arc<T>) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(thing);
    }

    /// Nothing is kept any more.
    pub(super) fn forget(&mut self) {
        *self = Cache::default();
    }

    fn now(&self) -> Option<Arc<dyn Any + Send + Sync>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Clone for Cache {
    fn clone(&self) -> Self {
        Cache(Mutex::new(self.now()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_is_found_by_its_type_and_by_copies_until_it_is_forgotten() {
        let mut cache = Cache::default();
        cache.put(Arc::new(3_u8));
        let copy = cache.clone();
        assert_eq!((cache.get::<u8>().as_deref(), cache.get::<u16>()), (Some(&3), None));
        cache.forget();
        assert_eq!((cache.get::<u8>(), copy.get::<u8>().as_deref()), (None, Some(&3)));
    }
}
