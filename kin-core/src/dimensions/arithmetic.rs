//! Implements the operators and functions of dimensions.
//!
//! Each operator and function computes the value and records the operation.

use std::fmt;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, Sub, SubAssign};

use kin_graph::{Function, Function2, Graph, Node, Op, functions_of_one, functions_of_two};

use super::{Dimension, Of, store};
use crate::numbers::algebra::{Mix, Scalar, sealed};
use crate::numbers::real::{assign, by_ref};

impl Dimension {
    /// Records an operation on some numbers, with its `value`.
    fn made<const N: usize>(
        value: f64,
        from: [Dimension; N],
        op: impl FnOnce([Node; N]) -> Op,
    ) -> Self {
        let mut of = Of::Nothing;
        for one in from {
            of = match (of, one.of) {
                (of, Of::Nothing) => of,
                (Of::Nothing, of) => of,
                (Of::Expression(a, _), Of::Expression(b, _)) if a == b => of,
                _ => Of::Several,
            };
        }
        let node = store::with(of, |store, _| {
            let nodes = from.map(|one| one.node(&mut store.graph));
            store.graph.raw(op(nodes))
        });
        match (of, node) {
            (Of::Nothing, _) => Dimension { value, of },
            (Of::Expression(mechanism, _), Some(node)) => Dimension::new(value, mechanism, node),
            _ => Dimension { value, of: Of::Several },
        }
    }

    /// Returns the node of the number in the graph of its expression.
    fn node(self, graph: &mut Graph) -> Node {
        match self.of {
            Of::Expression(_, node) => node,
            _ => graph.raw(Op::Constant(self.value.to_bits())),
        }
    }

    pub(crate) fn call(self, f: Function) -> Self {
        Dimension::made(f.value()(self.value), [self], |[a]| Op::Call(f, a))
    }

    pub(crate) fn call2(self, f: Function2, other: Self) -> Self {
        Dimension::made(f.value()(self.value, other.value), [self, other], |[a, b]| {
            Op::Call2(f, a, b)
        })
    }

    /// Returns xⁿ.
    pub fn powi(self, n: i32) -> Self {
        Dimension::made(self.value.powi(n), [self], |[a]| Op::Powi(a, n))
    }

    /// Returns (sin x, cos x), with x in rad.
    pub fn sin_cos(self) -> (Self, Self) {
        (self.sin(), self.cos())
    }
}

macro_rules! of_one {
    ($($(#[$doc:meta])* $variant:ident $method:ident $written:literal $entry:tt)*) => {
        impl Dimension {
            $(
                $(#[$doc])*
                pub fn $method(self) -> Self {
                    self.call(Function::$variant)
                }
            )*
        }
    };
}

functions_of_one!(of_one);

/// The methods of two numbers, except the operator `%`.
macro_rules! of_two {
    ($($(#[$doc:meta])* $variant:ident $method:ident $written:literal $entry:tt)*) => {
        $(of_two!(@ $variant $method $(#[$doc])*);)*
    };
    (@ Rem $method:ident $(#[$doc:meta])*) => {};
    (@ $variant:ident $method:ident $(#[$doc:meta])*) => {
        impl Dimension {
            $(#[$doc])*
            pub fn $method(self, other: impl Into<Dimension>) -> Self {
                self.call2(Function2::$variant, other.into())
            }
        }
    };
}

functions_of_two!(of_two);

macro_rules! operator {
    ($op:ident::$f:ident, $assign:ident::$g:ident, |$a:ident, $b:ident| $e:expr) => {
        by_ref!([] $op::$f, Dimension, Dimension => Dimension, |$a, $b| $e);
        by_ref!([] $op::$f, Dimension, f64 => Dimension, |a, b| $op::$f(a, Dimension::from(b)));
        by_ref!([] $op::$f, f64, Dimension => Dimension, |a, b| $op::$f(Dimension::from(a), b));
        assign!([] $assign::$g by $op::$f, Dimension, Dimension);
        assign!([] $assign::$g by $op::$f, Dimension, f64);
    };
}

operator!(Add::add, AddAssign::add_assign, |a, b| Dimension::made(
    a.value + b.value,
    [a, b],
    |[a, b]| { Op::Add(a, b) }
));
operator!(Sub::sub, SubAssign::sub_assign, |a, b| Dimension::made(
    a.value - b.value,
    [a, b],
    |[a, b]| { Op::Sub(a, b) }
));
operator!(Mul::mul, MulAssign::mul_assign, |a, b| Dimension::made(
    a.value * b.value,
    [a, b],
    |[a, b]| { Op::Mul(a, b) }
));
operator!(Div::div, DivAssign::div_assign, |a, b| Dimension::made(
    a.value / b.value,
    [a, b],
    |[a, b]| { Op::Div(a, b) }
));
by_ref!([] Rem::rem, Dimension, Dimension => Dimension, |a, b| a.call2(Function2::Rem, b));
by_ref!([] Rem::rem, Dimension, f64 => Dimension, |a, b| a.call2(Function2::Rem, b.into()));

impl Neg for Dimension {
    type Output = Dimension;

    fn neg(self) -> Dimension {
        Dimension::made(-self.value, [self], |[a]| Op::Neg(a))
    }
}

impl Neg for &Dimension {
    type Output = Dimension;

    fn neg(self) -> Dimension {
        -*self
    }
}

impl Sum for Dimension {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.reduce(Add::add).unwrap_or_default()
    }
}

impl From<f64> for Dimension {
    /// Makes a constant.
    fn from(value: f64) -> Self {
        Dimension { value, of: Of::Nothing }
    }
}

impl Default for Dimension {
    fn default() -> Self {
        Dimension::from(0.0)
    }
}

impl PartialEq for Dimension {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl PartialEq<f64> for Dimension {
    fn eq(&self, other: &f64) -> bool {
        self.value == *other
    }
}

impl PartialOrd for Dimension {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl PartialOrd<f64> for Dimension {
    fn partial_cmp(&self, other: &f64) -> Option<std::cmp::Ordering> {
        self.value.partial_cmp(other)
    }
}

impl fmt::Debug for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Dimension").field(&self.value).finish()
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value.fmt(f)
    }
}

impl Mix<f64> for Dimension {
    type Mixed = Dimension;
}

impl Mix<Dimension> for f64 {
    type Mixed = Dimension;
}

impl Mix<Dimension> for Dimension {
    type Mixed = Dimension;
}

impl sealed::Sealed for Dimension {}

impl Scalar for Dimension {
    fn value(self) -> f64 {
        self.value
    }

    fn sqrt(self) -> Self {
        self.call(Function::Sqrt)
    }

    fn abs(self) -> Self {
        self.call(Function::Abs)
    }

    fn sin_cos(self) -> (Self, Self) {
        (self.sin(), self.cos())
    }

    fn atan2(self, x: Self) -> Self {
        self.call2(Function2::Atan2, x)
    }

    fn hypot(self, y: Self) -> Self {
        self.call2(Function2::Hypot, y)
    }

    fn length<const N: usize>(components: [Self; N]) -> Self {
        components.into_iter().map(|x| x * x).sum::<Dimension>().call(Function::Sqrt)
    }
}
