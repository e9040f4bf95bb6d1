//! Evaluates C_q and C_p along a motion, with first and second time derivatives.

use std::collections::HashMap;
use std::rc::Rc;

use kin_graph::{Input, LeafUse, Results, Source, evaluate_all};

use super::asked::{Asked, Hangs};
use super::equation::Equation;
use crate::model::formula::{Given, Outside};
use crate::numbers::real::{Dual2_64, Dual3_64, Real};
use crate::numbers::rounded::Rounded;
use crate::numbers::with_rate::WithRate;
use crate::outcome::error::{Error, Result};
use crate::system::System;

type Number = Real<Dual2_64>;

/// Numbers with time derivatives and bounds of their errors.
type Bounded = WithRate<WithRate<Rounded>>;

/// All equations of a system, prepared for evaluation along its motions.
pub(super) struct Prepared<'a> {
    pub system: &'a System,
    pub blocks: Vec<Rc<Equation>>,
    /// For each constraint and column the coordinate; `None` for the ground.
    columns: Vec<Vec<Option<usize>>>,
    pub asked: Vec<Asked>,
    /// The number of requested names.
    pub names: usize,
    /// The memory of an evaluation, reused by the next.
    results: Results<Number>,
}

/// C_q as (row, column, jet), and for each name C_p as (row, jet), at one time. A jet is a number
/// with its first and second time derivatives.
pub(super) struct Along<N = f64> {
    pub by_q: Vec<(usize, usize, [N; 3])>,
    pub by_p: Vec<Vec<(usize, [N; 3])>>,
}

impl<'a> Prepared<'a> {
    /// Prepares the equations for these parameters and dimensions. Returns an error with the name
    /// of an unknown derivative.
    pub(super) fn new(system: &'a System, names: &[String]) -> Result<Self> {
        let mut blocks = Vec::new();
        let mut columns = Vec::new();
        let mut kinds = HashMap::new();
        for block in &system.equations().blocks {
            let own: Vec<Option<usize>> = block
                .constraint
                .arguments()
                .iter()
                .flat_map(|argument| system.layout().columns(argument))
                .collect();
            // The derivatives of one kind of constraint are computed once.
            let equation = block.constraint.formula(|table, _, _| {
                let kind = kinds.entry((std::ptr::from_ref(table) as usize, own.len()));
                let made = || Equation::of(table.formula(), own.len()).map(Rc::new);
                kind.or_insert_with(made).clone()
            });
            let unknown = Err(
                "Kin differentiates the constraint by dual numbers, or the constraint is hand-written",
            );
            let equation = equation.unwrap_or(unknown).map_err(|reason| {
                let by = names.first().map_or("", String::as_str);
                Error::no_derivative(
                    by,
                    format!(
                        "Kin does not know the derivative of `{}` by this parameter: {reason}",
                        block.name
                    ),
                )
            })?;
            blocks.push(equation);
            columns.push(own);
        }
        let mut asked = Vec::new();
        for name in names.iter().enumerate() {
            asked.extend(Asked::all(system, &blocks, name)?);
        }
        Ok(Prepared {
            system,
            blocks,
            columns,
            asked,
            names: names.len(),
            results: Results::default(),
        })
    }

    /// Returns C_q and C_p at the time t of a motion with these q, q̇ and q̈.
    pub(super) fn at(&mut self, t: f64, orders: [&[f64]; 3]) -> Along {
        let mut results = std::mem::take(&mut self.results);
        let moving = |j: usize| Real(Dual2_64::new(orders[0][j], orders[1][j], orders[2][j]));
        let along = self.walked(t, orders[0], moving, &mut results);
        self.results = results;
        along
    }

    /// Returns C_q and C_p with bounds of their errors, where `off` bounds the errors of q, q̇ and
    /// q̈.
    pub(super) fn bounded(&self, t: f64, orders: [&[f64]; 3], off: [&[f64]; 3]) -> Along<Rounded> {
        let moving = |j: usize| {
            let [x, v, a] = [0, 1, 2].map(|order| Rounded::new(orders[order][j], off[order][j]));
            WithRate {
                x: WithRate { x, rate: Some(v) },
                rate: Some(WithRate { x: v, rate: Some(a) }),
            }
        };
        self.walked(t, orders[0], moving, &mut Results::<Bounded>::default())
    }

    /// Returns C_q and C_p in numbers of one kind.
    fn walked<N: InTime>(
        &self,
        t: f64,
        q: &[f64],
        moving: impl Fn(usize) -> N,
        results: &mut Results<N>,
    ) -> Along<N::Part> {
        let equations = self.system.equations();
        let instant = equations.instant_at(t, q);
        let mut along = Along { by_q: Vec::new(), by_p: vec![Vec::new(); self.names] };
        for (number, block) in equations.blocks.iter().enumerate() {
            let equation = &self.blocks[number];
            let behind = &self.columns[number];
            let at = equations.at(block, &instant);
            let fixed = block.constraint.arguments();
            let fixed = fixed.iter().map(|argument| argument.target.columns()).enumerate();
            let fixed = fixed.flat_map(|(k, n)| at.coordinates(k, n).to_vec());
            let column =
                |(behind, x): (&Option<usize>, f64)| behind.map_or_else(|| N::constant(x), &moving);
            let columns: Vec<N> = behind.iter().zip(fixed).map(column).collect();
            block.constraint.formula(|_, parameters, outside| {
                let walk = Walk { equation, columns: &columns, t, parameters, outside };
                // Every node of the graph is needed.
                evaluate_all(&equation.graph, &walk, results);
                walk.add(block.rows().start, behind, (number, &self.asked), (results, &mut along));
            });
        }
        along
    }
}

/// A number with two time derivatives.
trait InTime: kin_graph::Number {
    /// The type of its value and derivatives.
    type Part: Copy;

    /// Returns the value and the derivatives, times a constant.
    fn jet(self, factor: f64) -> [Self::Part; 3];

    /// Returns the value.
    fn value(&self) -> f64;

    /// Returns f(self), from f and its first three derivatives at the value.
    fn through(self, f: [f64; 4]) -> Self;

    /// Creates the time t.
    fn time(t: f64) -> Self;
}

impl InTime for Number {
    type Part = f64;

    fn jet(self, factor: f64) -> [f64; 3] {
        [self.0.re, self.0.v1, self.0.v2].map(|x| factor * x)
    }

    fn value(&self) -> f64 {
        (*self).value()
    }

    fn through(self, f: [f64; 4]) -> Self {
        self.chain(f)
    }

    fn time(t: f64) -> Self {
        Real(Dual2_64::new(t, 1.0, 0.0))
    }
}

impl InTime for Bounded {
    type Part = Rounded;

    fn jet(self, factor: f64) -> [Rounded; 3] {
        let zero = Rounded::new(0.0, 0.0);
        let rate = self.rate.map_or([zero; 2], |rate| [rate.x, rate.rate.unwrap_or(zero)]);
        [self.x.x, rate[0], rate[1]].map(|x| Rounded::new(factor, 0.0) * x)
    }

    fn value(&self) -> f64 {
        self.x.x.x
    }

    fn through(self, f: [f64; 4]) -> Self {
        let at = self.x.x;
        let f = [0, 1, 2].map(|order| at.through(f[order], f[order + 1]));
        let [value, slope] = [0, 1].map(|order| self.x.chain(f[order], || f[order + 1]));
        self.chain(value, || slope)
    }

    fn time(t: f64) -> Self {
        let once = |x, rate| WithRate { x: Rounded::new(x, 0.0), rate };
        let one = Rounded::new(1.0, 0.0);
        WithRate { x: once(t, Some(one)), rate: Some(once(1.0, None)) }
    }
}

/// One equation at one time.
struct Walk<'a, N> {
    equation: &'a Equation,
    columns: &'a [N],
    t: f64,
    parameters: &'a [f64],
    outside: Outside<'a>,
}

impl<N: InTime> Walk<'_, N> {
    /// Adds the derivatives of its rows. `first` is the index of its first row in the system.
    fn add(
        &self,
        first: usize,
        behind: &[Option<usize>],
        asked: (usize, &[Asked]),
        (results, to): (&Results<N>, &mut Along<N::Part>),
    ) {
        let number = |node| results.number(node).unwrap_or_else(|| N::constant(f64::NAN));
        let slope = |list: &[(usize, kin_graph::Node)], k: usize| {
            list.iter().find(|(known, _)| *known == k).map(|(_, node)| number(*node))
        };
        for (row, slopes) in (first..).zip(&self.equation.rows) {
            for (column, node) in &slopes.by_column {
                if let Some(Some(j)) = behind.get(*column) {
                    to.by_q.push((row, *j, number(*node).jet(1.0)));
                }
            }
            for asked in asked.1.iter().filter(|own| own.block == asked.0) {
                let by_p = &mut to.by_p[asked.name];
                let jet = |number: N| number.jet(asked.slope);
                match &asked.hangs {
                    Hangs::Parameter(k) => {
                        by_p.extend(slope(&slopes.by_parameter, *k).map(|by| (row, jet(by))));
                    }
                    Hangs::Law { number: law, by } => {
                        let calls = self.equation.calls.iter().enumerate();
                        for (k, call) in calls.filter(|(_, call)| call.law == *law) {
                            let Some(slope) = slope(&slopes.by_call, k) else { continue };
                            let x = number(call.x);
                            by_p.push((
                                row,
                                jet(slope
                                    * x.clone().through(derivatives(by, x.value(), call.order))),
                            ));
                        }
                    }
                }
            }
        }
    }
}

/// Returns derivative `order` of a law at x and the two derivatives that follow.
fn derivatives(law: &crate::law::Law, x: f64, order: u8) -> [f64; 4] {
    let [f, f1, f2, f3] = law.jet(x);
    match order {
        0 => [f, f1, f2, f3],
        1 => [f1, f2, f3, f64::NAN],
        2 => [f2, f3, law.fourth(x), f64::NAN],
        _ => [f64::NAN; 4],
    }
}

impl<N: InTime> Source<N> for Walk<'_, N> {
    fn input(&self, input: Input) -> N {
        let columns = self.equation.columns;
        let parameters = self.equation.parameters;
        match input {
            Input::State(k, _) if k < columns => {
                self.columns.get(k).cloned().unwrap_or_else(|| N::constant(f64::NAN))
            }
            Input::State(k, _) if k < columns + parameters => {
                N::constant(self.parameters.get(k - columns).copied().unwrap_or(f64::NAN))
            }
            Input::State(..) => N::constant(0.0),
            Input::Time => N::time(self.t),
            _ => N::constant(f64::NAN),
        }
    }

    fn law(&self, law: usize, x: N, order: u8) -> N {
        let given = Given::by(self.outside, law, &[]);
        let f = given.law().map_or([f64::NAN; 4], |law| derivatives(law, x.value(), order));
        x.through(f)
    }

    /// A result of the user's functions depends on parameters alone, so it is constant.
    fn opaque(&self, number: usize, component: usize, operands: Vec<N>) -> N {
        let operands: Vec<Dual3_64> =
            operands.iter().map(|x| Dual3_64::from_re(x.value())).collect();
        N::constant(Given::by(self.outside, number, &operands).number(component).re)
    }

    fn leaf(&self, _: LeafUse, _: Vec<N>) -> N {
        N::constant(f64::NAN)
    }
}
