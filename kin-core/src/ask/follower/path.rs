//! The law of a driver whose values a follower moves.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use crate::law::{Law, LawFunction};
use crate::numbers::enclosure::Series;

/// The polynomial c0 + c1 t + c2 t² whose coefficients change between the moves, without another
/// law for each move. Copies share the coefficients.
#[derive(Clone, Debug)]
pub(super) struct Path(Arc<[AtomicU64; 3]>);

impl Path {
    /// Creates a path that stands at this value.
    pub(super) fn at(value: f64) -> Self {
        let path = Path(Arc::default());
        path.lead([value, 0.0, 0.0]);
        path
    }

    /// Sets the coefficients.
    pub(super) fn lead(&self, c: [f64; 3]) {
        self.0.iter().zip(c).for_each(|(place, c)| place.store(c.to_bits(), Relaxed));
    }

    /// Returns the law that reads these coefficients.
    pub(super) fn law(&self) -> Law {
        Law::new(self.clone())
    }

    fn coefficients(&self) -> [f64; 3] {
        let [a, b, c] = &*self.0;
        [a, b, c].map(|place| f64::from_bits(place.load(Relaxed)))
    }
}

impl LawFunction for Path {
    fn jet(&self, x: f64) -> [f64; 4] {
        let [a, b, c] = self.coefficients();
        [a + x * (b + x * c), b + 2.0 * x * c, 2.0 * c, 0.0]
    }

    fn kind(&self) -> &str {
        "path"
    }

    fn trusted(&self) -> Vec<String> {
        Vec::new()
    }

    fn fourth(&self, _: f64) -> f64 {
        0.0
    }

    fn over(&self, x: &Series) -> Option<Series> {
        let [a, b, c] = self.coefficients();
        let law = if c == 0.0 { Law::linear(a, b) } else { Law::polynomial(&[a, b, c]) };
        law.over(x)
    }
}
