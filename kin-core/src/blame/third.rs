//! The steps of an equation with third-order dual numbers, for the jerk: it is asked for seldom, and code of its own for every constraint would
//! be a quarter of all that is compiled.

use num_dual::Dual3_64;

use super::graph::{Given, Graph, Outside, Step, jet_of_law};
use crate::coordinates::Argument;
use crate::real::Real;
use crate::state::{At, Rates};

type Number = Real<Dual3_64>;

/// A motion of one constraint: its columns with q, q̇, q̈, and the time.
pub(crate) struct Along {
    columns: Vec<Number>,
    t: Number,
}

impl Along {
    /// q + s q̇ + ½ s² q̈ at the time t + s.
    pub(crate) fn new(arguments: &[Argument], at: &At<'_>, qd: &Rates<'_>, qdd: &Rates<'_>) -> Self {
        let mut columns = Vec::new();
        for (k, n) in arguments.iter().map(|argument| argument.target.columns()).enumerate() {
            let moving = at.coordinates(k, n).iter().zip(qd.columns(k, n)).zip(qdd.columns(k, n));
            columns.extend(moving.map(|((q, qd), qdd)| Real(Dual3_64::new(*q, *qd, *qdd, 0.0))));
        }
        Along { columns, t: Real(Dual3_64::new(at.t, 1.0, 0.0, 0.0)) }
    }
}

impl Graph {
    /// −g‴(0) of each row along a motion.
    pub(crate) fn jerk_rhs(&self, along: &Along, parameters: &[f64], outside: Outside<'_>, rhs: &mut [f64]) {
        let mut numbers: Vec<Number> = Vec::with_capacity(self.steps.len());
        for (_, step) in self.steps {
            let number = number(*step, &numbers, along, parameters, outside);
            numbers.push(number);
        }
        for (place, row) in rhs.iter_mut().zip(self.rows) {
            *place = numbers.get(usize::from(*row)).map_or(f64::NAN, |number| -number.0.v3);
        }
    }
}

/// The result of a step, from those before it.
fn number(step: Step, known: &[Number], along: &Along, parameters: &[f64], outside: Outside<'_>) -> Number {
    let missing = Number::from(f64::NAN);
    let of = |k: u16| known.get(usize::from(k)).copied().unwrap_or(missing);
    let holds = |k: u16| of(k).value() != 0.0;
    let truth = |holds: bool| Number::from(if holds { 1.0 } else { 0.0 });
    match step {
        Step::Column(k) => along.columns.get(usize::from(k)).copied().unwrap_or(missing),
        Step::Time => along.t,
        Step::Parameter(k) => parameters.get(usize::from(k)).map_or(missing, |value| Number::from(*value)),
        Step::Constant(value) | Step::Decimal(value, _) => Number::from(value),
        Step::Negated(a) => -of(a),
        Step::Call(f, a) => f.by_dual()(of(a)),
        Step::Call2(f, a, b) => f.by_dual()(of(a), of(b)),
        Step::Power(a, n) => of(a).powi(n),
        Step::Select(c, a, b) => of(if holds(c) { a } else { b }),
        Step::Compare(comparison, a, b) => truth(comparison.holds(of(a).value(), of(b).value())),
        Step::Both(a, b) => truth(holds(a) && holds(b)),
        Step::Either(a, b) => truth(holds(a) || holds(b)),
        Step::Not(a) => truth(!holds(a)),
        Step::Law(law, x, order) => of(x).chain(jet_of_law(outside, law, of(x).value(), order)),
        Step::Foreign(number, operands, component) => {
            let operands: Vec<Dual3_64> = operands.iter().map(|&k| of(k).0).collect();
            Real(Given::by(outside, number, &operands).number(component))
        }
    }
}
