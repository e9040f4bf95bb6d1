//! Laws made of laws: sums, products, multiples and compositions, exact to the third derivative.

use std::ops::{Add, Div, Mul};

use kin_graph::{Graph, Node};

use super::breaks::{MOST_BREAKS, Samples, left_jet, merged, sharpest};
use super::parts::{by_part, range_of_composed, set, show, slope};
use super::{Break, Law, LawFunction, LawRange, trusted_parts};
use crate::model::dimension::IntoNumber;
use crate::numbers::enclosure::Series;

impl Law {
    /// f(g(x)), this law after `inner`.
    pub fn compose(&self, inner: &Law) -> Law {
        Law::new(Composed { outer: self.clone(), inner: inner.clone() })
    }

    /// f(x − x0): the same curve, x0 later.
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

    /// f(x)/divisor, as the multiple of the law by 1/divisor.
    fn div(self, divisor: f64) -> Law {
        divisor.recip() * self
    }
}

/// The methods in which a law of two parts side by side asks both.
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
            sharpest([&self.$first, &self.$second].into_iter().filter_map(|law| law.sharpest_break(from, to)))
        }

        fn is_smooth(&self) -> bool {
            self.$first.is_smooth() && self.$second.is_smooth()
        }

        fn range(&self) -> Option<LawRange> {
            LawRange::common(self.$first.range(), self.$second.range())
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

/// f + g
struct Sum {
    first: Law,
    second: Law,
}

impl LawFunction for Sum {
    fn jet(&self, x: f64) -> [f64; 4] {
        let (f, g) = (self.first.jet(x), self.second.jet(x));
        std::array::from_fn(|k| f[k] + g[k])
    }

    fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        let (first, second) = (self.first.written(graph, x)?, self.second.written(graph, x)?);
        Some(graph.add(first, second))
    }

    fn kind(&self) -> &str {
        "sum"
    }

    fn description(&self) -> &str {
        "The sum of two laws: f(x) + g(x)."
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
        let (mut first, mut second) = (self.first.clone(), self.second.clone());
        (set(&mut first, "first", name, value) || set(&mut second, "second", name, value))
            .then(|| first + second)
    }
}

/// f · g
struct Product {
    first: Law,
    second: Law,
}

impl LawFunction for Product {
    /// Leibniz's rule.
    fn jet(&self, x: f64) -> [f64; 4] {
        let ([f, f1, f2, f3], [g, g1, g2, g3]) = (self.first.jet(x), self.second.jet(x));
        [f * g, f1 * g + f * g1, f2 * g + 2.0 * f1 * g1 + f * g2, f3 * g + 3.0 * (f2 * g1 + f1 * g2) + f * g3]
    }

    fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        let (first, second) = (self.first.written(graph, x)?, self.second.written(graph, x)?);
        Some(graph.mul(first, second))
    }

    fn kind(&self) -> &str {
        "product"
    }

    fn description(&self) -> &str {
        "The product of two laws: f(x) · g(x)."
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        Some(self.first.over(x)? * self.second.over(x)?)
    }

    fn fourth(&self, x: f64) -> f64 {
        let ([f, f1, f2, f3], [g, g1, g2, g3]) = (self.first.jet(x), self.second.jet(x));
        self.first.fourth(x) * g + 4.0 * (f3 * g1 + f1 * g3) + 6.0 * f2 * g2 + f * self.second.fourth(x)
    }

    two_parts!(first, second);

    fn by_parameter(&self, name: &str) -> Option<Law> {
        let first = by_part(&self.first, "first", name).map(|first| first * self.second.clone());
        first.or_else(|| Some(self.first.clone() * by_part(&self.second, "second", name)?))
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let (mut first, mut second) = (self.first.clone(), self.second.clone());
        (set(&mut first, "first", name, value) || set(&mut second, "second", name, value))
            .then(|| first * second)
    }
}

/// factor · f
pub(super) struct Multiple {
    pub factor: f64,
    pub law: Law,
}

impl LawFunction for Multiple {
    fn jet(&self, x: f64) -> [f64; 4] {
        self.law.jet(x).map(|f| self.factor * f)
    }

    fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        let (factor, law) = (graph.constant(self.factor), self.law.written(graph, x)?);
        Some(graph.mul(factor, law))
    }

    fn kind(&self) -> &str {
        "multiple"
    }

    fn description(&self) -> &str {
        "A multiple of a law: factor · f(x)."
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

/// f(g(x))
struct Composed {
    outer: Law,
    inner: Law,
}

impl Composed {
    /// The outer law's jet, that of its left side where a break of it is passed backwards: the right side is
    /// that of x.
    fn outer_jet(&self, [g, g1, g2, g3]: [f64; 4]) -> [f64; 4] {
        let falls = [g1, g2, g3].into_iter().find(|d| *d != 0.0).is_some_and(|d| d < 0.0);
        let begins = || self.outer.range().is_some_and(|range| range.from == g);
        if falls && !self.outer.breaks(g, g).is_empty() && !begins() {
            return left_jet(&self.outer, g, 1e-9 * g.abs().max(1e-3));
        }
        self.outer.jet(g)
    }

    /// The breaks of the inner law, and those of the outer one, by `list`, where the inner law takes their
    /// places.
    fn with_outer<I: IntoIterator<Item = Break>>(
        &self,
        mut all: Vec<Break>,
        from: f64,
        to: f64,
        list: impl Fn(&Law, f64, f64) -> I,
    ) -> Vec<Break> {
        if self.outer.is_smooth() {
            return all;
        }
        let places: Vec<f64> = [from].into_iter().chain(all.iter().map(|b| b.x)).chain([to]).collect();
        let least = all.len();
        for pair in places.windows(2) {
            let samples = Samples::between(&self.inner, pair[0], pair[1]);
            let (low, high) = samples.range();
            for outer in list(&self.outer, low, high) {
                all.extend(samples.preimages(outer.x).into_iter().map(|x| Break { x, order: outer.order }));
            }
            if all.len() - least > MOST_BREAKS {
                break;
            }
        }
        merged(all)
    }
}

impl LawFunction for Composed {
    /// The chain rule to the third order (Faà di Bruno).
    fn jet(&self, x: f64) -> [f64; 4] {
        let [g, g1, g2, g3] = self.inner.jet(x);
        let [f, f1, f2, f3] = self.outer_jet([g, g1, g2, g3]);
        [f, f1 * g1, f2 * g1 * g1 + f1 * g2, f3 * g1 * g1 * g1 + 3.0 * f2 * g1 * g2 + f1 * g3]
    }

    fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        let inner = self.inner.written(graph, x)?;
        self.outer.written(graph, inner)
    }

    fn kind(&self) -> &str {
        "composed"
    }

    fn description(&self) -> &str {
        "A law of a law: f(g(x))."
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        self.outer.over(&self.inner.over(x)?)
    }

    fn fourth(&self, x: f64) -> f64 {
        let ([g, g1, g2, g3], g4) = (self.inner.jet(x), self.inner.fourth(x));
        let ([_, f1, f2, f3], f4) = (self.outer.jet(g), self.outer.fourth(g));
        f4 * g1.powi(4) + 6.0 * f3 * g1 * g1 * g2 + f2 * (3.0 * g2 * g2 + 4.0 * g1 * g3) + f1 * g4
    }

    fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
        self.with_outer(self.inner.breaks(from, to), from, to, |outer, low, high| outer.breaks(low, high))
    }

    fn sharpest_break(&self, from: f64, to: f64) -> Option<Break> {
        let inner = self.inner.breaks(from, to);
        sharpest(self.with_outer(inner, from, to, |outer, low, high| outer.sharpest_break(low, high)))
    }

    fn is_smooth(&self) -> bool {
        self.inner.is_smooth() && self.outer.is_smooth()
    }

    fn range(&self) -> Option<LawRange> {
        range_of_composed(&self.outer, &self.inner)
    }

    fn refusal(&self) -> Option<String> {
        self.inner.refusal().or_else(|| self.outer.refusal())
    }

    fn parts(&self) -> Vec<(String, Law)> {
        vec![("outer".to_string(), self.outer.clone()), ("inner".to_string(), self.inner.clone())]
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        show(&self.outer, "outer", visit);
        show(&self.inner, "inner", visit);
    }

    fn by_parameter(&self, name: &str) -> Option<Law> {
        let outer = by_part(&self.outer, "outer", name).map(|outer| outer.compose(&self.inner));
        outer.or_else(|| Some(slope(&self.outer).compose(&self.inner) * by_part(&self.inner, "inner", name)?))
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let (mut outer, mut inner) = (self.outer.clone(), self.inner.clone());
        (set(&mut outer, "outer", name, value) || set(&mut inner, "inner", name, value))
            .then(|| outer.compose(&inner))
    }
}

#[cfg(test)]
mod tests;
