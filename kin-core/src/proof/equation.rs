//! The steps of an equation on series: the table that `#[constraint]` and `#[law]` leave, interpreted once more.

use num_dual::Dual3_64;

use super::interval::{Interval, ONE, ZERO};
use super::series::{ORDER, Series, UNKNOWN};
use crate::blame::Source;
use crate::blame::graph::{Comparison, Function2, Given, Graph, Outside, Step};
use crate::law::Law;

/// What the steps begin with.
pub(super) struct Inputs<'a> {
    pub columns: &'a [Series],
    pub t: Series,
    pub parameters: &'a [f64],
    pub outside: Outside<'a>,
}

impl Graph {
    /// The result of every step.
    pub(super) fn series(&self, inputs: &Inputs<'_>) -> Vec<Series> {
        let mut known = Vec::with_capacity(self.steps.len());
        for (_, step) in self.steps {
            let next = result(*step, &known, inputs);
            known.push(next);
        }
        known
    }

    /// The results of steps where only one column moves, `still` being those where none does.
    pub(super) fn series_along(&self, column: usize, still: &[Series], inputs: &Inputs<'_>) -> Vec<Series> {
        let (mut known, mut moves) = (still.to_vec(), Vec::with_capacity(self.steps.len()));
        for (k, (_, step)) in self.steps.iter().enumerate() {
            let moving = matches!(step, Step::Column(own) if usize::from(*own) == column)
                || step.reads(&|k| moves.get(usize::from(k)).copied().unwrap_or(false));
            moves.push(moving);
            if moving {
                known[k] = result(*step, &known, inputs);
            }
        }
        known
    }

    /// The result of a row.
    pub(super) fn row(&self, row: usize, results: &[Series]) -> Series {
        let y = self.rows.get(row).and_then(|step| results.get(usize::from(*step))).copied().unwrap_or(UNKNOWN);
        if y.is_open() { UNKNOWN } else { y }
    }

    /// The expression, as the user wrote it, because of which fewer than `len` coefficients of a row are known.
    pub(super) fn unknown(&self, row: usize, results: &[Series], len: usize) -> Option<(&'static str, Option<Source>)> {
        let known = |step: u16| results.get(usize::from(step)).is_some_and(|y| y.len() >= len);
        let holds = |step: u16| results.get(usize::from(step)).is_some_and(|y| y.value() != ZERO);
        let mut step = *self.rows.get(row)?;
        while let Some(next) = self.operands(step, &holds).into_iter().find(|step| !known(*step)) {
            step = next;
        }
        let (number, _) = self.steps.get(usize::from(step))?;
        let (text, line, column) = *self.expressions.get(usize::from(*number))?;
        Some((text, Some(Source { file: self.file, line, column })))
    }

    /// Why no bounds of its results can be had, whatever the position, if so.
    pub(super) fn opaque(&self, outside: Outside<'_>) -> Option<String> {
        if self.is_rounded {
            return Some("its constants are rounded before they can be read".to_string());
        }
        let mut moves = Vec::with_capacity(self.steps.len());
        for (_, step) in self.steps {
            let moving =
                matches!(step, Step::Column(_) | Step::Time) || step.reads(&|k| moves.get(usize::from(k)).copied().unwrap_or(false));
            match step {
                Step::Law(law, ..) => {
                    let law = Given::by(outside, *law, &[]);
                    let law = law.law()?;
                    if law.over(&Series::constant(ZERO)).is_none() {
                        return Some(format!(
                            "of its law `{}` no bounds over an interval are known; write it with `#[law]`, without a loop or call that only Rust can \
                             read, or take one of the library",
                            law.kind()
                        ));
                    }
                }
                Step::Foreign(..) if moving => {
                    return Some(
                        "it calls a function of yours, of which no bounds over an interval are known; write its expression out".to_string(),
                    );
                }
                _ => {}
            }
            moves.push(moving);
        }
        None
    }

    /// The laws in it whose bounds are taken on their own word.
    pub(super) fn trusted(&self, outside: Outside<'_>) -> Vec<String> {
        let law = |step: &Step| if let Step::Law(law, ..) = step { Given::by(outside, *law, &[]).law().map(Law::trusted) } else { None };
        self.steps.iter().filter_map(|(_, step)| law(step)).flatten().collect()
    }

    /// A law that is written as an expression of column 0.
    pub fn law_over(&self, x: &Series, parameters: &[f64], outside: Outside<'_>) -> Option<Series> {
        if self.opaque(outside).is_some() {
            return None;
        }
        let inputs = Inputs { columns: &[*x], t: Series::constant(ZERO), parameters, outside };
        Some(self.row(0, &self.series(&inputs)))
    }
}

fn result(step: Step, known: &[Series], inputs: &Inputs<'_>) -> Series {
    let of = |k: u16| known.get(usize::from(k)).copied().unwrap_or(UNKNOWN);
    let value = |k: u16| if of(k).is_open() { UNKNOWN.value() } else { of(k).value() };
    let parameter = |k: u16| inputs.parameters.get(usize::from(k)).map_or(UNKNOWN, |x| Series::constant(Interval::from(*x)));
    let truth = |[never, always]: [bool; 2]| {
        Series::constant(if never {
            ZERO
        } else if always {
            ONE
        } else {
            ZERO.hull(ONE)
        })
    };
    // a condition as [never, always]
    let held = |k: u16| [value(k) == ZERO, !value(k).contains(0.0)];
    match step {
        Step::Column(k) => inputs.columns.get(usize::from(k)).copied().unwrap_or(UNKNOWN),
        Step::Time => inputs.t,
        Step::Parameter(k) => parameter(k),
        Step::Constant(x) => Series::constant(Interval::from(x)),
        Step::Decimal(x, above) => Series::constant(if above { Interval::new(x, x.next_up()) } else { Interval::new(x.next_down(), x) }),
        Step::Negated(a) => -of(a),
        Step::Call(f, a) => of(a).call(f),
        Step::Call2(Function2::Product, a, b) if a == b => of(a).sqr(),
        Step::Call2(f, a, b) => of(a).call2(f, of(b)),
        Step::Power(a, n) => of(a).powi(n),
        Step::Select(c, a, b) => match held(c) {
            [true, _] => of(b),
            [_, true] => of(a),
            _ => UNKNOWN,
        },
        Step::Compare(comparison, a, b) => truth(compared(comparison, value(a), value(b))),
        Step::Both(a, b) => truth([held(a)[0] || held(b)[0], held(a)[1] && held(b)[1]]),
        Step::Either(a, b) => truth([held(a)[0] && held(b)[0], held(a)[1] || held(b)[1]]),
        Step::Not(a) => truth([held(a)[1], held(a)[0]]),
        Step::Law(number, x, order) => Given::by(inputs.outside, number, &[]).law().map_or(UNKNOWN, |law| law_of(law, of(x), order)),
        Step::Foreign(number, operands, component) => {
            let operands: Vec<Series> = operands.iter().map(|&k| of(k)).collect();
            given(inputs.outside, number, component, &operands)
        }
    }
}

/// What only the user's program can compute of parameters: the number that it gives. What it is computed from is known up to rounding, so it is asked at
/// both ends and in the middle of that: what jumps between them is not known.
fn given(outside: Outside<'_>, number: u16, component: u16, operands: &[Series]) -> Series {
    if !operands.iter().all(|x| x.is_constant() && !x.is_open()) {
        return UNKNOWN;
    }
    let at = |place: fn(Interval) -> f64| {
        let operands: Vec<Dual3_64> = operands.iter().map(|x| Dual3_64::from_re(place(x.value()))).collect();
        Interval::from(Given::by(outside, number, &operands).number(component).re)
    };
    let all = [at(Interval::lo), at(Interval::mid), at(Interval::hi)];
    let value = all[0].hull(all[1]).hull(all[2]);
    if value.is_finite() { Series::constant(value) } else { UNKNOWN }
}

/// Whether a comparison never holds, and whether it always does.
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

/// The law of x (order 0), or its slope (1). Where x is known up to whole turns, so is what the law makes of it: nothing, unless it repeats.
fn law_of(law: &Law, x: Series, order: u8) -> Series {
    if x.len() == 0 {
        return UNKNOWN;
    }
    let f = law.over(&Series::variable(x.value(), ONE, ORDER + 1).up_to(x.turns())).unwrap_or(UNKNOWN);
    if order == 0 {
        return x.compose(f.known()).up_to(f.turns());
    }
    let slope: Vec<Interval> = (1..f.len()).map(|k| Interval::from(k as f64) * f.at(k)).collect();
    // the last coefficient that is known may jump: a slope that is the last one is no continuous function
    if slope.len() < 2 { UNKNOWN } else { x.compose(&slope) }
}
