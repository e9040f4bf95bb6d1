//! Stores values that other modules derive from a system once, until the user sets a value of the
//! system.

use std::any::Any;
use std::sync::{Arc, Mutex, PoisonError};

type Thing = Arc<dyn Any + Send + Sync>;

/// One value of each type. A copy of a system shares them.
#[derive(Default)]
pub(crate) struct Cache(Mutex<Vec<Thing>>);

impl Cache {
    /// Returns the value of this type, if there is one.
    pub(crate) fn get<T: Any + Send + Sync>(&self) -> Option<Arc<T>> {
        let all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let known = all.iter().find(|known| (***known).is::<T>()).cloned();
        known.and_then(|known| known.downcast().ok())
    }

    /// Stores a value and replaces the one of the same type.
    pub(crate) fn put<T: Any + Send + Sync>(&self, thing: Arc<T>) {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.retain(|known| !(**known).is::<T>());
        all.push(thing);
    }

    /// Discards all values.
    pub(super) fn forget(&mut self) {
        *self = Cache::default();
    }

    fn now(&self) -> Vec<Thing> {
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
        cache.put(Arc::new(2_u8));
        cache.put(Arc::new(3_u8));
        cache.put(Arc::new(4_u32));
        let copy = cache.clone();
        assert_eq!((cache.get::<u8>().as_deref(), cache.get::<u16>()), (Some(&3), None));
        assert_eq!(cache.get::<u32>().as_deref(), Some(&4));
        cache.forget();
        assert_eq!((cache.get::<u8>(), copy.get::<u8>().as_deref()), (None, Some(&3)));
    }
}
