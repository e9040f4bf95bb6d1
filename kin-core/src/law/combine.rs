//! Combines laws to sums, products, multiples and compositions, with exact derivatives up to the
//! third.

use std::ops::{Add, Div, Mul};

use kin_graph::{Graph, Node};

mod composed;

use super::breaks::{merged, sharpest};
use super::parts::{by_part, set, show};
use super::{Break, Law, LawFunction, LawRange, trusted_parts};
use crate::dimensions::IntoNumber;
use crate::numbers::enclosure::Series;
use composed::Composed;

impl Law {
    /// Returns the composition f(g(x)), where `inner` is g and this law is f.
    pub fn compose(&self, inner: &Law) -> Law {
        Law::new(Composed { outer: self.clone(), inner: inner.clone() })
    }

    /// Returns the law f(x − x0), where this law is f: the same curve, shifted by x0.
    pub fn shifted(&self, x0: impl IntoNumber) -> Law {
        self.compose(&Law::linear(-x0, 1.0))
    }
}

impl Add for Law {
    type Output = Law;

    fn add(self, other: Law) -> Law {
        Law::new(Sum { first: self, second: other })
    }
}

impl Mul<Law> for f64 {
    type Output = Law;

    fn mul(self, law: Law) -> Law {
        Law::new(Multiple { factor: self, law })
    }
}

impl Mul for Law {
    type Output = Law;

    fn mul(self, other: Law) -> Law {
        Law::new(Product { first: self, second: other })
    }
}

impl Mul<f64> for Law {
    type Output = Law;

    fn mul(self, factor: f64) -> Law {
        factor * self
    }
}

impl Div<f64> for Law {
    type Output = Law;

    /// Returns f(x)/divisor, as the multiple of the law by 1/divisor.
    fn div(self, divisor: f64) -> Law {
        Law::new(Multiple { factor: divisor.recip(), law: self })
    }
}

/// The methods of a law of two parts that query both parts in the same way.
macro_rules! two_parts {
    ($first:ident, $second:ident) => {
        fn parts(&self) -> Vec<(String, Law)> {
            vec![
                (stringify!($first).to_string(), self.$first.clone()),
                (stringify!($second).to_string(), self.$second.clone()),
            ]
        }

        fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
            merged([self.$first.breaks(from, to), self.$second.breaks(from, to)].concat())
        }

        fn sharpest_break(&self, from: f64, to: f64) -> Option<Break> {
            sharpest(
                [&self.$first, &self.$second]
                    .into_iter()
                    .filter_map(|law| law.sharpest_break(from, to)),
            )
        }

        fn is_smooth(&self) -> bool {
            self.$first.is_smooth() && self.$second.is_smooth()
        }

        fn range(&self) -> Option<LawRange> {
            LawRange::common(self.$first.range(), self.$second.range())
        }

        fn table_range(&self) -> Option<LawRange> {
            LawRange::common(self.$first.table_range(), self.$second.table_range())
        }

        fn refusal(&self) -> Option<String> {
            self.$first.refusal().or_else(|| self.$second.refusal())
        }

        fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
            show(&self.$first, stringify!($first), visit);
            show(&self.$second, stringify!($second), visit);
        }
    };
}

/// The law f + g.
struct Sum {
    first: Law,
    second: Law,
}

impl LawFunction for Sum {
    fn jet(&self, x: f64) -> [f64; 4] {
        let f = self.first.jet(x);
        let g = self.second.jet(x);
        std::array::from_fn(|k| f[k] + g[k])
    }

    fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        let first = self.first.written(graph, x)?;
        let second = self.second.written(graph, x)?;
        Some(graph.add(first, second))
    }

    fn kind(&self) -> &str {
        "sum"
    }

    fn description(&self) -> &str {
        "Sum of two laws: f(x) + g(x)."
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        Some(self.first.over(x)? + self.second.over(x)?)
    }

    fn fourth(&self, x: f64) -> f64 {
        self.first.fourth(x) + self.second.fourth(x)
    }

    two_parts!(first, second);

    fn by_parameter(&self, name: &str) -> Option<Law> {
        by_part(&self.first, "first", name).or_else(|| by_part(&self.second, "second", name))
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let mut first = self.first.clone();
        let mut second = self.second.clone();
        (set(&mut first, "first", name, value) || set(&mut second, "second", name, value))
            .then(|| first + second)
    }
}

/// The law f · g.
struct Product {
    first: Law,
    second: Law,
}

impl LawFunction for Product {
    /// Leibniz's rule.
    fn jet(&self, x: f64) -> [f64; 4] {
        let [f, f1, f2, f3] = self.first.jet(x);
        let [g, g1, g2, g3] = self.second.jet(x);
        [
            f * g,
            f1 * g + f * g1,
            f2 * g + 2.0 * f1 * g1 + f * g2,
            f3 * g + 3.0 * (f2 * g1 + f1 * g2) + f * g3,
        ]
    }

    fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        let first = self.first.written(graph, x)?;
        let second = self.second.written(graph, x)?;
        Some(graph.mul(first, second))
    }

    fn kind(&self) -> &str {
        "product"
    }

    fn description(&self) -> &str {
        "Product of two laws: f(x) · g(x)."
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        Some(self.first.over(x)? * self.second.over(x)?)
    }

    fn fourth(&self, x: f64) -> f64 {
        let [f, f1, f2, f3] = self.first.jet(x);
        let [g, g1, g2, g3] = self.second.jet(x);
        self.first.fourth(x) * g
            + 4.0 * (f3 * g1 + f1 * g3)
            + 6.0 * f2 * g2
            + f * self.second.fourth(x)
    }

    two_parts!(first, second);

    fn by_parameter(&self, name: &str) -> Option<Law> {
        let first = by_part(&self.first, "first", name).map(|first| first * self.second.clone());
        first.or_else(|| Some(self.first.clone() * by_part(&self.second, "second", name)?))
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let mut first = self.first.clone();
        let mut second = self.second.clone();
        (set(&mut first, "first", name, value) || set(&mut second, "second", name, value))
            .then(|| first * second)
    }
}

/// The law factor · f.
pub(super) struct Multiple {
    pub factor: f64,
    pub law: Law,
}

impl LawFunction for Multiple {
    fn jet(&self, x: f64) -> [f64; 4] {
        self.law.jet(x).map(|f| self.factor * f)
    }

    fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        let factor = graph.constant(self.factor);
        let law = self.law.written(graph, x)?;
        Some(graph.mul(factor, law))
    }

    fn kind(&self) -> &str {
        "multiple"
    }

    fn description(&self) -> &str {
        "Multiple of a law: factor · f(x)."
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        Some(self.law.over(x)?.times(self.factor))
    }

    fn fourth(&self, x: f64) -> f64 {
        self.factor * self.law.fourth(x)
    }

    fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
        self.law.breaks(from, to)
    }

    fn sharpest_break(&self, from: f64, to: f64) -> Option<Break> {
        self.law.sharpest_break(from, to)
    }

    fn is_smooth(&self) -> bool {
        self.law.is_smooth()
    }

    fn range(&self) -> Option<LawRange> {
        self.law.range()
    }

    fn table_range(&self) -> Option<LawRange> {
        self.law.table_range()
    }

    fn refusal(&self) -> Option<String> {
        self.law.refusal()
    }

    fn parts(&self) -> Vec<(String, Law)> {
        vec![("law".to_string(), self.law.clone())]
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        visit("factor", self.factor);
        show(&self.law, "law", visit);
    }

    fn by_parameter(&self, name: &str) -> Option<Law> {
        let factor = (name == "factor").then(|| self.law.clone());
        factor.or_else(|| Some(self.factor * by_part(&self.law, "law", name)?))
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        if name == "factor" {
            return Some(value * self.law.clone());
        }
        let mut law = self.law.clone();
        set(&mut law, "law", name, value).then(|| self.factor * law)
    }
}

#[cfg(test)]
mod tests;
