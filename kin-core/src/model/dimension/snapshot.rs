//! The dimensions of a system: what hangs on them, at which values, and with which slopes.

use kin_graph::{Graph, Input, LeafUse, Node, Number, Op, Source, evaluate};

use super::{Bound, Entry};
use crate::numbers::enclosure::series::{Series, UNKNOWN};
use crate::numbers::real::{Dual64, Real};

/// The dimensions of a mechanism as it was built, and the numbers that hang on them.
pub(crate) struct Snapshot {
    graph: Graph,
    /// The named numbers, in the order in which they were made.
    pub entries: Vec<Entry>,
    /// The numbers that hang on them.
    pub hung: Vec<Hung>,
    /// The dimensions behind each of these, by their numbers.
    behind: Vec<Vec<usize>>,
}

/// A number that hangs on dimensions.
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

    /// The same where no guess hangs on them.
    pub(crate) fn without_guesses(&self) -> Snapshot {
        let hung = self.hung.iter().filter(|hung| !hung.at.is_guess());
        Snapshot::new(&self.graph, &self.entries, hung.cloned().collect())
    }

    /// The values that the dimensions were made with.
    pub(crate) fn nominal(&self) -> Vec<f64> {
        self.entries.iter().map(|entry| entry.value).collect()
    }

    /// The numbers, by their place among [`Snapshot::hung`], that hang on dimension k.
    pub(crate) fn on(&self, k: usize) -> impl Iterator<Item = usize> {
        (0..self.hung.len()).filter(move |number| self.behind[*number].contains(&k))
    }

    /// The numbers, by their place, that an axis or a pose is worked out of together with this one.
    pub(crate) fn with(&self, number: usize) -> Vec<usize> {
        let Some(Hung { at, .. }) = self.hung.get(number) else { return Vec::new() };
        (0..self.hung.len()).filter(|other| self.hung[*other].at.is_with(at)).collect()
    }

    /// The values of all numbers that hang on dimensions of these values.
    pub(crate) fn numbers(&self, values: &[f64]) -> Vec<f64> {
        self.walk(&Values(values))
    }

    /// The values of all named numbers, expressions with a name among them.
    pub(crate) fn named(&self, values: &[f64]) -> Vec<f64> {
        let nodes: Vec<Node> = self.entries.iter().map(|entry| entry.node).collect();
        let results = evaluate(&self.graph, &nodes, &Values(values));
        nodes.iter().map(|node| results.number(*node).unwrap_or(f64::NAN)).collect()
    }

    /// All numbers as they move with dimension k.
    pub(crate) fn along(&self, values: &[f64], k: usize) -> Vec<Real<Dual64>> {
        self.walk(&Along { values, k })
    }

    /// Bounds of all numbers where dimensions are these, as they move.
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

/// The dimensions at these values.
struct Values<'a>(&'a [f64]);

/// The same as they move with dimension k.
struct Along<'a> {
    values: &'a [f64],
    k: usize,
}

/// The dimensions over intervals.
struct Over<'a>(&'a [Series]);

/// An expression of dimensions reads nothing but dimensions.
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
