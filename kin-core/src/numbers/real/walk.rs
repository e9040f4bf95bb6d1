//! Evaluates a graph with numbers that carry derivatives: each function of the list is the method
//! with the same name.

use std::ops::Rem;

use kin_graph::{
    Function, Function2, Number, compared_by_value, functions_of_one, functions_of_two,
};

use super::{Dual, Real};

macro_rules! of_one {
    ($($(#[$doc:meta])* $variant:ident $method:ident $written:literal $entry:tt)*) => {
        fn of_one<D: Dual>(f: Function, x: Real<D>) -> Real<D> {
            match f { $(Function::$variant => x.$method()),* }
        }
    };
}

macro_rules! of_two {
    ($($(#[$doc:meta])* $variant:ident $method:ident $written:literal $entry:tt)*) => {
        fn of_two<D: Dual>(f: Function2, x: Real<D>, y: Real<D>) -> Real<D> {
            match f { $(Function2::$variant => x.$method(y)),* }
        }
    };
}

functions_of_one!(of_one);
functions_of_two!(of_two);

impl<D: Dual> Number for Real<D> {
    compared_by_value!(|x| x.value());

    fn constant(x: f64) -> Self {
        Real::from(x)
    }

    fn call(self, f: Function) -> Self {
        of_one(f, self)
    }

    fn call2(self, f: Function2, other: Self) -> Self {
        of_two(f, self, other)
    }

    fn powi(self, n: i32) -> Self {
        Real::powi(self, n)
    }
}
