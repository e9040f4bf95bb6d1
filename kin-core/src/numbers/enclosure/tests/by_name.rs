//! The functions of the list as methods of intervals, for tests that write formulas.

use crate::numbers::enclosure::interval::Interval;

macro_rules! of_one {
    ($($(#[$doc:meta])* $variant:ident $method:ident $written:literal $entry:tt)*) => {
        #[allow(dead_code)]
        impl Interval {
            $(of_one! { @ $method $variant })*
        }
    };
    // These are operations of intervals.
    (@ abs $variant:ident) => {};
    (@ sqrt $variant:ident) => {};
    (@ $method:ident $variant:ident) => {
        pub(crate) fn $method(self) -> Self {
            self.call(kin_graph::Function::$variant)
        }
    };
}

kin_graph::functions_of_one!(of_one);
