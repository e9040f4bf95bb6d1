//! Evaluates a formula with third-order dual numbers, for the jerk.
//!
//! Runs rarely compute the jerk, and separate code for every constraint would be a quarter of all
//! compiled code.

use kin_graph::{Formula, Input, LeafUse, Node, Source, evaluate};

use super::{Given, Outside, jet_of_law};
use crate::coordinates::Argument;
use crate::model::state::{At, Rates};
use crate::numbers::real::{Dual, Dual3_64, Real};
use crate::numbers::wide::Wide;
use crate::numbers::with_rate::WithRate;

type Number = Real<Dual3_64>;

/// The same numbers with unlimited exponents.
type Unbounded = WithRate<WithRate<WithRate<Wide>>>;

/// The motion of one constraint, q, q̇, q̈ by columns and the time, together with the other inputs
/// of its formula.
pub(crate) struct Along<'a> {
    columns: Vec<Number>,
    t: Number,
    parameters: &'a [f64],
    outside: Outside<'a>,
}

impl<'a> Along<'a> {
    /// Creates q + s q̇ + ½ s² q̈ + ⅙ s³ q⃛ at the time t + s; the last term is absent if q⃛ is
    /// unknown.
    pub(crate) fn new(
        arguments: &[Argument],
        at: &At<'_>,
        [qd, qdd, qddd]: [Option<&Rates<'_>>; 3],
        parameters: &'a [f64],
        outside: Outside<'a>,
    ) -> Self {
        let mut columns = Vec::new();
        for (k, n) in arguments.iter().map(|argument| argument.target.columns()).enumerate() {
            let rate = |rates: Option<&Rates<'_>>, column: usize| {
                rates.map_or(0.0, |rates| {
                    rates.columns(k, n).get(column).copied().unwrap_or(f64::NAN)
                })
            };
            let moving = at.coordinates(k, n).iter().enumerate().map(|(column, q)| {
                Real(Dual3_64::new(*q, rate(qd, column), rate(qdd, column), rate(qddd, column)))
            });
            columns.extend(moving);
        }
        Along { columns, t: Real(Dual3_64::new(at.t, 1.0, 0.0, 0.0)), parameters, outside }
    }

    /// Creates constant coordinates and a constant time.
    pub(crate) fn still(
        arguments: &[Argument],
        at: &At<'_>,
        parameters: &'a [f64],
        outside: Outside<'a>,
    ) -> Self {
        let t = Number::from(at.t);
        Along { t, ..Along::new(arguments, at, [None; 3], parameters, outside) }
    }

    /// Creates a single variable x with the derivative 1.
    pub(super) fn variable(x: f64, parameters: &'a [f64], outside: Outside<'a>) -> Self {
        let x = Real(Dual3_64::new(x, 1.0, 0.0, 0.0));
        Along { columns: vec![x], t: Number::from(f64::NAN), parameters, outside }
    }

    /// Creates the time t + s alone. Coordinates are NaN.
    pub(crate) fn of_time(t: f64, parameters: &'a [f64], outside: Outside<'a>) -> Self {
        let t = Real(Dual3_64::new(t, 1.0, 0.0, 0.0));
        Along { columns: Vec::new(), t, parameters, outside }
    }

    /// Returns the value of row 0 and its first three derivatives by s.
    pub(crate) fn first(&self, formula: &Formula) -> [f64; 4] {
        formula.rows.first().map_or([f64::NAN; 4], |row| self.of(formula, *row))
    }

    /// Returns the value of a node and its first three derivatives by s.
    pub(crate) fn of(&self, formula: &Formula, node: Node) -> [f64; 4] {
        let y = evaluate::<Number>(&formula.graph, &[node], self).number(node);
        let y = y.map_or([f64::NAN; 4], |Real(y)| [y.re, y.v1, y.v2, y.v3]);
        if y.iter().all(|y| y.is_finite()) || !y[0].is_finite() {
            return y;
        }
        self.unbounded(formula, &[node])
            .first()
            .copied()
            .filter(|y| y.iter().all(|y| y.is_finite()))
            .unwrap_or(y)
    }

    /// Returns the values of nodes and their first three derivatives by s, from numbers with
    /// unlimited exponents. The derivatives of an exponential can be too large for an `f64`
    /// although a result computed from them is small.
    #[cold]
    fn unbounded(&self, formula: &Formula, nodes: &[Node]) -> Vec<[f64; 4]> {
        let results = evaluate::<Unbounded>(&formula.graph, nodes, self);
        let jet = |node: &Node| results.number(*node).map_or([f64::NAN; 4], |number| jet(&number));
        nodes.iter().map(jet).collect()
    }

    /// Writes −g‴(0) of each row.
    pub(crate) fn jerk_rhs(&self, formula: &Formula, rhs: &mut [f64]) {
        let results = evaluate::<Number>(&formula.graph, &formula.rows, self);
        for (place, row) in rhs.iter_mut().zip(&formula.rows) {
            *place = results.number(*row).map_or(f64::NAN, |number| -number.0.v3);
        }
        if rhs.iter().any(|x| !x.is_finite()) {
            let unbounded = self.unbounded(formula, &formula.rows);
            for (place, [.., third]) in rhs.iter_mut().zip(unbounded) {
                if !place.is_finite() && third.is_finite() {
                    *place = -third;
                }
            }
        }
    }
}

impl Source<Number> for Along<'_> {
    fn input(&self, input: Input) -> Number {
        let given = match input {
            Input::Column(k) => self.columns.get(k).copied(),
            Input::Time => Some(self.t),
            Input::Parameter(k) => self.parameters.get(k).map(|value| Number::from(*value)),
            _ => None,
        };
        given.unwrap_or(Number::from(f64::NAN))
    }

    fn law(&self, law: usize, x: Number, order: u8) -> Number {
        let [f, f1, f2, f3] = jet_of_law(self.outside, law, x.value(), order);
        // A constant needs no third derivative, which may be unknown.
        x.chain([f, f1, f2, if x.0.is_at_rest() { 0.0 } else { f3 }])
    }

    fn opaque(&self, number: usize, component: usize, operands: Vec<Number>) -> Number {
        let operands: Vec<Dual3_64> = operands.iter().map(|operand| operand.0).collect();
        Real(Given::by(self.outside, number, &operands).number(component))
    }

    /// A formula contains calls as values of the user's program.
    fn leaf(&self, _: LeafUse, _: Vec<Number>) -> Number {
        Number::from(f64::NAN)
    }
}

/// Converts a number to unlimited exponents; a constant remains constant.
fn widened(Real(x): Number) -> Unbounded {
    if x.is_constant() {
        return kin_graph::Number::constant(x.re);
    }
    moving([x.re, x.v1, x.v2, x.v3])
}

fn moving(jet: [f64; 4]) -> Unbounded {
    let once = |k: usize| WithRate { x: Wide::new(jet[k]), rate: Some(Wide::new(jet[k + 1])) };
    let twice = |k: usize| WithRate { x: once(k), rate: Some(once(k + 1)) };
    WithRate { x: twice(0), rate: Some(twice(1)) }
}

/// Returns the value and its derivatives; those of a constant are zero.
fn jet(number: &Unbounded) -> [f64; 4] {
    let first = number.rate.as_ref();
    let second = first.and_then(|first| first.rate.as_ref());
    let third = second.and_then(|second| second.rate.as_ref());
    let value = |x: Option<Wide>| x.map_or(0.0, Wide::value);
    [
        number.x.x.x.value(),
        value(first.map(|first| first.x.x)),
        value(second.map(|second| second.x)),
        value(third.copied()),
    ]
}

impl Source<Unbounded> for Along<'_> {
    fn input(&self, input: Input) -> Unbounded {
        widened(Source::<Number>::input(self, input))
    }

    fn law(&self, law: usize, x: Unbounded, order: u8) -> Unbounded {
        let f = jet_of_law(self.outside, law, x.x.x.x.value(), order).map(Wide::new);
        let once = |k: usize| x.x.x.chain(f[k], || f[k + 1]);
        let twice = |k: usize| x.x.chain(once(k), || once(k + 1));
        x.chain(twice(0), || twice(1))
    }

    fn opaque(&self, number: usize, component: usize, operands: Vec<Unbounded>) -> Unbounded {
        let narrow = |x: &Unbounded| {
            let [re, v1, v2, v3] = jet(x);
            Real(if x.rate.is_some() {
                Dual3_64::new(re, v1, v2, v3)
            } else {
                Dual3_64::from_re(re)
            })
        };
        let operands: Vec<Number> = operands.iter().map(narrow).collect();
        widened(Source::<Number>::opaque(self, number, component, operands))
    }

    fn leaf(&self, _: LeafUse, _: Vec<Unbounded>) -> Unbounded {
        kin_graph::Number::constant(f64::NAN)
    }
}
