//! Handles the parameters of laws that contain other laws, and implements the operators on laws.

use std::ops::{Mul, Neg, Sub};

use super::combine::Multiple;
use super::{Law, LawFunction, LawRange};
use crate::dimensions::Dimension;

/// Passes the parameters of a part to `visit`, with the name of the part as a prefix.
pub(super) fn show(law: &Law, part: &str, visit: &mut dyn FnMut(&str, f64)) {
    law.parameters(&mut |name, value| visit(&format!("{part}.{name}"), value));
}

/// Sets a parameter of a part, if the name begins with the prefix of the part.
pub(super) fn set(law: &mut Law, part: &str, name: &str, value: f64) -> bool {
    name.strip_prefix(part)
        .and_then(|rest| rest.strip_prefix('.'))
        .is_some_and(|rest| law.set_parameter(rest, value))
}

/// Returns ∂/∂p of a part, where `name` is the name of p in the whole law.
pub(super) fn by_part(law: &Law, part: &str, name: &str) -> Option<Law> {
    law.by_parameter(name.strip_prefix(part)?.strip_prefix('.')?)
}

/// Returns f′ as a law.
pub(super) fn slope(law: &Law) -> Law {
    Law::new(Slope(law.clone()))
}

/// Returns a range of f(g(x)), where f is the outer law. It is the range of g. If g is a straight
/// line, it also respects the range of f.
pub(super) fn range_of_composed(
    [outer, inner]: [&Law; 2],
    range: impl Fn(&Law) -> Option<LawRange>,
) -> Option<LawRange> {
    let [c0, c1, ..] = inner.jet(0.0);
    let is_line = matches!(inner.kind(), "linear" | "ramp" | "polynomial")
        && c1 != 0.0
        && [1.0, 2.0].iter().all(|x| inner.jet(*x) == [c0 + c1 * x, c1, 0.0, 0.0]);
    let of_outer = range(outer).filter(|_| is_line).map(|range| range.before(c0, c1));
    LawRange::common(of_outer, range(inner))
}

impl Law {
    /// Returns the range of the tables in the law ([`LawFunction::table_range`]).
    pub(crate) fn table_range(&self) -> Option<LawRange> {
        self.0.table_range()
    }
}

struct Slope(Law);

impl LawFunction for Slope {
    fn jet(&self, x: f64) -> [f64; 4] {
        let [_, f1, f2, f3] = self.0.jet(x);
        [f1, f2, f3, self.0.fourth(x)]
    }
}

impl Mul<Law> for Dimension {
    type Output = Law;

    fn mul(self, law: Law) -> Law {
        Law::hanging(|to| Multiple { factor: to.number("factor", self), law })
    }
}

impl Sub for Law {
    type Output = Law;

    fn sub(self, other: Law) -> Law {
        self + (-other)
    }
}

impl Neg for Law {
    type Output = Law;

    fn neg(self) -> Law {
        -1.0 * self
    }
}
