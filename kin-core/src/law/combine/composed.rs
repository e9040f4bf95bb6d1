//! Implements the composition of two laws.

use kin_graph::{Graph, Node};

use crate::law::breaks::{MOST_BREAKS, Samples, left_jet, merged, sharpest};
use crate::law::parts::{by_part, range_of_composed, set, show, slope};
use crate::law::{Break, Law, LawFunction, LawRange, trusted_parts};
use crate::numbers::enclosure::Series;

/// The law f(g(x)).
pub(super) struct Composed {
    pub outer: Law,
    pub inner: Law,
}

impl Composed {
    /// Returns the jet of the outer law. If the inner law decreases through a break of the outer
    /// law, the jet is that of the left side, because that side is on the right in x.
    fn outer_jet(&self, [g, g1, g2, g3]: [f64; 4]) -> [f64; 4] {
        let falls = [g1, g2, g3].into_iter().find(|d| *d != 0.0).is_some_and(|d| d < 0.0);
        let begins = || self.outer.range().is_some_and(|range| range.from == g);
        if falls && !self.outer.breaks(g, g).is_empty() && !begins() {
            return left_jet(&self.outer, g, 1e-9 * g.abs().max(1e-3));
        }
        self.outer.jet(g)
    }

    /// Returns the breaks of the inner law, and the places where the inner law reaches a break of
    /// the outer law. `list` lists breaks of one law.
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
        let places: Vec<f64> =
            [from].into_iter().chain(all.iter().map(|b| b.x)).chain([to]).collect();
        let least = all.len();
        for pair in places.windows(2) {
            let samples = Samples::between(&self.inner, pair[0], pair[1]);
            let (low, high) = samples.range();
            for outer in list(&self.outer, low, high) {
                all.extend(
                    samples.preimages(outer.x).into_iter().map(|x| Break { x, order: outer.order }),
                );
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
        "Composition of two laws: f(g(x))."
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        self.outer.over(&self.inner.over(x)?)
    }

    fn fourth(&self, x: f64) -> f64 {
        let [g, g1, g2, g3] = self.inner.jet(x);
        let g4 = self.inner.fourth(x);
        let [_, f1, f2, f3] = self.outer.jet(g);
        let f4 = self.outer.fourth(g);
        f4 * g1.powi(4) + 6.0 * f3 * g1 * g1 * g2 + f2 * (3.0 * g2 * g2 + 4.0 * g1 * g3) + f1 * g4
    }

    fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
        self.with_outer(self.inner.breaks(from, to), from, to, |outer, low, high| {
            outer.breaks(low, high)
        })
    }

    fn sharpest_break(&self, from: f64, to: f64) -> Option<Break> {
        let inner = self.inner.breaks(from, to);
        sharpest(
            self.with_outer(inner, from, to, |outer, low, high| outer.sharpest_break(low, high)),
        )
    }

    fn is_smooth(&self) -> bool {
        self.inner.is_smooth() && self.outer.is_smooth()
    }

    fn range(&self) -> Option<LawRange> {
        range_of_composed([&self.outer, &self.inner], Law::range)
    }

    fn table_range(&self) -> Option<LawRange> {
        range_of_composed([&self.outer, &self.inner], Law::table_range)
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
        outer.or_else(|| {
            Some(slope(&self.outer).compose(&self.inner) * by_part(&self.inner, "inner", name)?)
        })
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let mut outer = self.outer.clone();
        let mut inner = self.inner.clone();
        (set(&mut outer, "outer", name, value) || set(&mut inner, "inner", name, value))
            .then(|| outer.compose(&inner))
    }
}
