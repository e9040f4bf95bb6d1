//! Holds the dimensions of a system, and the numbers that depend on the dimensions, with values and
//! derivatives.

use kin_graph::text::{Dialect, print};
use kin_graph::{Graph, Input, LeafUse, Node, Number, Op, Source, evaluate};

use super::{Bound, Entry};
use crate::numbers::enclosure::series::{Series, UNKNOWN};
use crate::numbers::real::{Dual64, Real};

/// The longest text of an expression. \[bytes\]
const LONGEST: usize = 20_000;

/// The dimensions of a built mechanism, and the numbers that depend on them.
pub(crate) struct Snapshot {
    graph: Graph,
    /// The named numbers, in the order of their declaration.
    pub entries: Vec<Entry>,
    /// The numbers that depend on dimensions.
    pub hung: Vec<Hung>,
    /// For each number of [`Snapshot::hung`], the indices of the dimensions on which it depends.
    behind: Vec<Vec<usize>>,
}

/// A number that depends on dimensions.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Hung {
    pub at: Bound,
    pub node: Node,
}

impl Snapshot {
    pub(crate) fn new(graph: &Graph, entries: &[Entry], hung: Vec<Hung>) -> Self {
        let behind = |hung: &Hung| {
            let read = |node: Node| match graph.op(node) {
                Op::Input(Input::Parameter(k)) => Some(k),
                _ => None,
            };
            graph.reachable(&[hung.node]).into_iter().filter_map(read).collect()
        };
        let behind = hung.iter().map(behind).collect();
        Snapshot { graph: graph.clone(), entries: entries.to_vec(), hung, behind }
    }

    /// Returns a copy without the guesses that depend on dimensions.
    pub(crate) fn without_guesses(&self) -> Snapshot {
        let hung = self.hung.iter().filter(|hung| !hung.at.is_guess());
        Snapshot::new(&self.graph, &self.entries, hung.cloned().collect())
    }

    /// Returns the nominal values of the dimensions.
    pub(crate) fn nominal(&self) -> Vec<f64> {
        self.entries.iter().map(|entry| entry.value).collect()
    }

    /// Returns the indices in [`Snapshot::hung`] of the numbers that depend on dimension k.
    pub(crate) fn on(&self, k: usize) -> impl Iterator<Item = usize> {
        (0..self.hung.len()).filter(move |number| self.behind[*number].contains(&k))
    }

    /// Returns the indices of the numbers from which Kin computes an axis or a pose together with
    /// this number.
    pub(crate) fn with(&self, number: usize) -> Vec<usize> {
        let Some(Hung { at, .. }) = self.hung.get(number) else { return Vec::new() };
        (0..self.hung.len()).filter(|other| self.hung[*other].at.is_with(at)).collect()
    }

    /// Returns all numbers at these values of the dimensions.
    pub(crate) fn numbers(&self, values: &[f64]) -> Vec<f64> {
        self.walk(&Values(values))
    }

    /// Returns the values of all named numbers, including named expressions.
    pub(crate) fn named(&self, values: &[f64]) -> Vec<f64> {
        let nodes: Vec<Node> = self.entries.iter().map(|entry| entry.node).collect();
        let results = evaluate(&self.graph, &nodes, &Values(values));
        nodes.iter().map(|node| results.number(*node).unwrap_or(f64::NAN)).collect()
    }

    /// Returns all numbers with their derivatives by dimension k.
    pub(crate) fn along(&self, values: &[f64], k: usize) -> Vec<Real<Dual64>> {
        self.walk(&Along { values, k })
    }

    /// Returns a number as an expression, or `None` if the text is long; `named` gives the texts of
    /// dimensions by their indices.
    pub(crate) fn text(
        &self,
        node: Node,
        dialect: &dyn Dialect,
        named: &dyn Fn(usize) -> String,
    ) -> Option<String> {
        let of = |node| match self.graph.op(node) {
            Op::Input(Input::Parameter(k)) => Some(named(k)),
            _ => None,
        };
        print(&self.graph, node, dialect, of, LONGEST)
    }

    /// Returns bounds of all numbers for bounded dimensions.
    pub(crate) fn over(&self, values: &[Series]) -> Vec<Series> {
        self.walk(&Over(values))
    }

    fn walk<N: Number>(&self, source: &impl Source<N>) -> Vec<N> {
        let nodes: Vec<Node> = self.hung.iter().map(|hung| hung.node).collect();
        let results = evaluate(&self.graph, &nodes, source);
        let of = |node: &Node| results.number(*node).unwrap_or_else(|| N::constant(f64::NAN));
        nodes.iter().map(of).collect()
    }
}

/// The values of the dimensions.
struct Values<'a>(&'a [f64]);

/// The values of the dimensions, with dimension k as the variable.
struct Along<'a> {
    values: &'a [f64],
    k: usize,
}

/// The dimensions as bounded series.
struct Over<'a>(&'a [Series]);

/// An expression of dimensions has no inputs except dimensions.
macro_rules! source {
    ($name:ident, $number:ty, |$self:ident, $k:ident| $input:expr) => {
        impl Source<$number> for $name<'_> {
            fn input(&$self, input: Input) -> $number {
                match input {
                    Input::Parameter($k) => $input,
                    _ => Number::constant(f64::NAN),
                }
            }

            fn law(&self, _: usize, _: $number, _: u8) -> $number {
                Number::constant(f64::NAN)
            }

            fn opaque(&self, _: usize, _: usize, _: Vec<$number>) -> $number {
                Number::constant(f64::NAN)
            }

            fn leaf(&self, _: LeafUse, _: Vec<$number>) -> $number {
                Number::constant(f64::NAN)
            }
        }
    };
}

source!(Values, f64, |self, k| self.0.get(k).copied().unwrap_or(f64::NAN));
source!(Over, Series, |self, k| self.0.get(k).copied().unwrap_or(UNKNOWN));
source!(Along, Real<Dual64>, |self, k| {
    let moves = if k == self.k { 1.0 } else { 0.0 };
    Real(Dual64::new(self.values.get(k).copied().unwrap_or(f64::NAN), moves))
});
