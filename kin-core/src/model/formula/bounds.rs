//! Evaluates a formula on series: bounds of an equation's rows over a box, and of a law over an
//! interval.

use crate::numbers::real::Dual3_64;
use kin_graph::{Comparison, Formula, Input, LeafUse, Node, Number, Op, Possibly, Results, Source};

use crate::law::Law;
use crate::model::blame;
use crate::model::formula::{Given, Outside, Table};
use crate::numbers::enclosure::interval::{Interval, ONE, ZERO};
use crate::numbers::enclosure::series::{ORDER, Series, UNKNOWN};
use crate::outcome::error::surface::Surface;

/// The inputs of an evaluation.
pub(crate) struct Inputs<'a> {
    pub columns: &'a [Series],
    pub t: Series,
    pub parameters: &'a [f64],
    pub outside: Outside<'a>,
}

impl Source<Series> for Inputs<'_> {
    fn input(&self, input: Input) -> Series {
        let given = match input {
            Input::Column(k) => self.columns.get(k).copied(),
            Input::Time => Some(self.t),
            Input::Parameter(k) => {
                self.parameters.get(k).map(|x| Series::constant(Interval::from(*x)))
            }
            _ => None,
        };
        given.unwrap_or(UNKNOWN)
    }

    fn law(&self, law: usize, x: Series, order: u8) -> Series {
        Given::by(self.outside, law, &[]).law().map_or(UNKNOWN, |law| law_of(law, x, order))
    }

    /// Bounds a function of parameters that only the user's program can compute. Its operands are
    /// known up to rounding, so Kin evaluates it at both ends and in the middle of their intervals.
    /// It does not see a jump between these three.
    fn opaque(&self, number: usize, component: usize, operands: Vec<Series>) -> Series {
        if !operands.iter().all(|x| x.is_constant() && !x.is_open()) {
            return UNKNOWN;
        }
        let at = |place: fn(Interval) -> f64| {
            let operands: Vec<Dual3_64> =
                operands.iter().map(|x| Dual3_64::from_re(place(x.value()))).collect();
            Interval::from(Given::by(self.outside, number, &operands).number(component).re)
        };
        let all = [at(Interval::lo), at(Interval::mid), at(Interval::hi)];
        let value = all[0].hull(all[1]).hull(all[2]);
        if value.is_finite() { Series::constant(value) } else { UNKNOWN }
    }

    fn leaf(&self, _: LeafUse, _: Vec<Series>) -> Series {
        UNKNOWN
    }
}

impl Number for Series {
    type Condition = Possibly;

    fn constant(x: f64) -> Self {
        Series::constant(Interval::from(x))
    }

    fn decimal(nearest: f64, above: bool) -> Self {
        let other = if above { nearest.next_up() } else { nearest.next_down() };
        Series::constant(Interval::new(nearest.min(other), nearest.max(other)))
    }

    fn logarithm_of(x: f64) -> Self {
        Series::constant(Interval::from(x).call(kin_graph::Function::Ln))
    }

    fn call(self, f: kin_graph::Function) -> Self {
        Series::call(self, f)
    }

    fn call2(self, f: kin_graph::Function2, other: Self) -> Self {
        Series::call2(self, f, other)
    }

    fn powi(self, n: i32) -> Self {
        Series::powi(self, n)
    }

    fn squared(self) -> Self {
        self.sqr()
    }

    fn compare(comparison: Comparison, a: &Self, b: &Self) -> Possibly {
        let [never, always] = compared(comparison, a.all_values(), b.all_values());
        Possibly { never, always }
    }

    fn select(condition: &Possibly, a: Self, b: Self) -> Self {
        match condition {
            Possibly { never: true, .. } => b,
            Possibly { always: true, .. } => a,
            _ => UNKNOWN,
        }
    }

    fn of_condition(condition: &Possibly) -> Self {
        Series::constant(match condition {
            Possibly { never: true, .. } => ZERO,
            Possibly { always: true, .. } => ONE,
            _ => ZERO.hull(ONE),
        })
    }

    fn holds(&self) -> Possibly {
        Possibly { never: self.all_values() == ZERO, always: !self.all_values().contains(0.0) }
    }
}

impl Series {
    /// Returns all numbers that the value may be; everything if it is known only up to full
    /// revolutions.
    pub(crate) fn all_values(&self) -> Interval {
        if self.is_open() { UNKNOWN.value() } else { self.value() }
    }
}

/// Returns the series of a row. A row that is known only up to full revolutions counts as unknown.
pub(crate) fn row(formula: &Formula, row: usize, results: &Results<Series>) -> Series {
    let y = formula.rows.get(row).and_then(|row| results.number(*row)).unwrap_or(UNKNOWN);
    if y.is_open() { UNKNOWN } else { y }
}

/// Returns the reason why the rows of a formula have no bounds at any position, if there is one.
pub(crate) fn opaque(formula: &Formula, outside: Outside<'_>) -> Option<String> {
    if formula.is_rounded {
        return Some(
            "rustc rounds the constants of the equation before Kin reads them".to_string(),
        );
    }
    let graph = &formula.graph;
    graph.reachable(&formula.rows).into_iter().find_map(|node| match graph.op(node) {
        Op::Law(law, ..) => {
            let law = Given::by(outside, law, &[]);
            let law = law.law()?;
            law.over(&Series::constant(ZERO)).is_none().then(|| {
                format!(
                    "Kin has no bounds of the law `{}` over an interval. To give bounds, {}use a law of the library",
                    law.kind(),
                    Surface::chosen().readable_law()
                )
            })
        }
        Op::Opaque(..) if graph.depends(node).varies() => {
            Some("the equation calls a user-defined function, and Kin has no bounds of this function over an interval. Write the expression of the function in the equation".to_string())
        }
        _ => None,
    })
}

/// Returns the laws of a formula whose stated bounds Kin relies on.
pub(crate) fn trusted(formula: &Formula, outside: Outside<'_>) -> Vec<String> {
    let law = |node: Node| match formula.graph.op(node) {
        Op::Law(law, ..) => Given::by(outside, law, &[]).law().map(Law::trusted),
        _ => None,
    };
    formula.graph.reachable(&formula.rows).into_iter().filter_map(law).flatten().collect()
}

impl Table {
    /// Returns the expression, as the user wrote it, because of which fewer than `len` coefficients
    /// of a row are known.
    pub(crate) fn unknown(
        &self,
        row: usize,
        results: &Results<Series>,
        len: usize,
    ) -> Option<(String, Option<blame::Source>)> {
        let formula = self.formula();
        let known = |node: &Node| results.number(*node).is_some_and(|y| y.len() >= len);
        let holds = |node: Node| results.condition(node).is_some_and(|condition| !condition.never);
        let mut node = *formula.rows.get(row)?;
        while let Some(next) =
            formula.graph.numbers_behind(node, holds).into_iter().find(|node| !known(node))
        {
            node = next;
        }
        let expression = formula.expression(node)?;
        Some((expression.text.clone(), Some(self.source(expression))))
    }
}

/// Returns two answers about a comparison: it never holds, and it always holds.
fn compared(comparison: Comparison, a: Interval, b: Interval) -> [bool; 2] {
    let less = [a.lo() >= b.hi(), a.hi() < b.lo()];
    let greater = [b.lo() >= a.hi(), b.hi() < a.lo()];
    let equal = [!a.meets(b), a.is_thin() && a == b];
    let not = |[never, always]: [bool; 2]| [always, never];
    match comparison {
        Comparison::Less => less,
        Comparison::LessEqual => not(greater),
        Comparison::Greater => greater,
        Comparison::GreaterEqual => not(less),
        Comparison::Equal => equal,
        Comparison::NotEqual => not(equal),
    }
}

/// Returns the law of x (order 0) or its slope (order 1). If x is known only up to full
/// revolutions, the result is unknown, unless the law repeats.
fn law_of(law: &Law, x: Series, order: u8) -> Series {
    let f =
        law.over(&Series::variable(x.value(), ONE, ORDER + 1).up_to(x.turns())).unwrap_or(UNKNOWN);
    if order == 0 {
        return x.compose(f.known()).up_to(f.turns());
    }
    let slope: Vec<Interval> = (1..f.len()).map(|k| Interval::from(k as f64) * f.at(k)).collect();
    // The last known coefficient may jump. A slope that is the last coefficient is then no
    // continuous function.
    if slope.len() < 2 { UNKNOWN } else { x.compose(&slope) }
}
