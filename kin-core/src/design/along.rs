//! C_q and C_p along a motion: their values with first and second derivatives by time.

use std::collections::HashMap;
use std::rc::Rc;

use kin_graph::{Input, LeafUse, Results, Source, evaluate_all};

use super::asked::{Asked, Hangs};
use super::equation::Equation;
use crate::model::error::Result;
use crate::model::formula::{Given, Outside};
use crate::model::no_derivative::NoDerivative;
use crate::numbers::real::{Dual2_64, Dual3_64, Real};
use crate::system::System;

type Number = Real<Dual2_64>;

/// A number with its first and second derivative by time.
pub(super) type Jet = [f64; 3];

/// All equations of a system, ready to be asked along its motions.
pub(super) struct Prepared<'a> {
    pub system: &'a System,
    pub blocks: Vec<Rc<Equation>>,
    /// The coordinate behind each column of each constraint.
    columns: Vec<Vec<Option<usize>>>,
    pub asked: Vec<Asked>,
    /// How many names were asked for.
    pub names: usize,
    /// The memory of one walk, for the next.
    results: Results<Number>,
}

/// C_q as (row, column, jet), and C_p of each name that was asked for as (row, jet), at one time.
#[derive(Default)]
pub(super) struct Along {
    pub by_q: Vec<(usize, usize, Jet)>,
    pub by_p: Vec<Vec<(usize, Jet)>>,
}

impl<'a> Prepared<'a> {
    /// For these parameters and dimensions; refuses by name what is not known.
    pub(super) fn new(system: &'a System, names: &[String]) -> Result<Self> {
        let (mut blocks, mut columns, mut kinds) = (Vec::new(), Vec::new(), HashMap::new());
        for block in &system.equations().blocks {
            let own: Vec<Option<usize>> = block
                .constraint
                .arguments()
                .iter()
                .flat_map(|argument| system.layout().columns(argument))
                .collect();
            // The derivatives of one kind of constraint are found once.
            let equation = block.constraint.formula(|table, _, _| {
                let kind = kinds.entry((std::ptr::from_ref(table) as usize, own.len()));
                let made = || Equation::of(table.formula(), own.len()).map(Rc::new);
                kind.or_insert_with(made).clone()
            });
            let unknown = Err("it takes the dual route or is written by hand");
            let equation = equation.unwrap_or(unknown).map_err(|reason| {
                let by = names.first().map_or("", String::as_str);
                NoDerivative::error(by, format!("of `{}` no such derivative is known: {reason}", block.name))
            })?;
            blocks.push(equation);
            columns.push(own);
        }
        let mut asked = Vec::new();
        for name in names.iter().enumerate() {
            asked.extend(Asked::all(system, &blocks, name)?);
        }
        Ok(Prepared { system, blocks, columns, asked, names: names.len(), results: Results::default() })
    }

    /// C_q and C_p at the time t of a motion with these q, q̇ and q̈.
    pub(super) fn at(&mut self, t: f64, orders: [&[f64]; 3]) -> Along {
        let equations = self.system.equations();
        let instant = equations.instant_at(t, orders[0]);
        let mut along = Along { by_q: Vec::new(), by_p: vec![Vec::new(); self.names] };
        for (number, block) in equations.blocks.iter().enumerate() {
            let (equation, behind) = (&self.blocks[number], &self.columns[number]);
            let at = equations.at(block, &instant);
            let fixed = block.constraint.arguments();
            let fixed = fixed.iter().map(|argument| argument.target.columns()).enumerate();
            let fixed = fixed.flat_map(|(k, n)| at.coordinates(k, n).to_vec());
            let column = |(behind, x): (&Option<usize>, f64)| match *behind {
                Some(j) => Real(Dual2_64::new(orders[0][j], orders[1][j], orders[2][j])),
                None => Number::from(x),
            };
            let columns: Vec<Number> = behind.iter().zip(fixed).map(column).collect();
            block.constraint.formula(|_, parameters, outside| {
                let walk = Walk { equation, columns: &columns, t, parameters, outside };
                walk.results(&mut self.results);
                walk.add(block.rows().start, behind, (number, &self.asked), (&self.results, &mut along));
            });
        }
        along
    }
}

/// One equation at one time.
struct Walk<'a> {
    equation: &'a Equation,
    columns: &'a [Number],
    t: f64,
    parameters: &'a [f64],
    outside: Outside<'a>,
}

impl Walk<'_> {
    /// All numbers of the equation. Its graph has no node too many.
    fn results(&self, memory: &mut Results<Number>) {
        evaluate_all(&self.equation.graph, self, memory);
    }

    /// Adds the derivatives of its rows, the first of which is row `first` of the system.
    fn add(
        &self,
        first: usize,
        behind: &[Option<usize>],
        asked: (usize, &[Asked]),
        (results, to): (&Results<Number>, &mut Along),
    ) {
        let number = |node| results.number(node).unwrap_or(Number::from(f64::NAN));
        let slope = |list: &[(usize, kin_graph::Node)], k: usize| {
            list.iter().find(|(known, _)| *known == k).map(|(_, node)| number(*node))
        };
        for (row, slopes) in (first..).zip(&self.equation.rows) {
            for (column, node) in &slopes.by_column {
                if let Some(Some(j)) = behind.get(*column) {
                    to.by_q.push((row, *j, jet(number(*node))));
                }
            }
            for asked in asked.1.iter().filter(|own| own.block == asked.0) {
                let by_p = &mut to.by_p[asked.name];
                let jet = |number: Number| jet(number).map(|x| asked.slope * x);
                match &asked.hangs {
                    Hangs::Parameter(k) => {
                        by_p.extend(slope(&slopes.by_parameter, *k).map(|by| (row, jet(by))));
                    }
                    Hangs::Law { number: law, by } => {
                        let calls = self.equation.calls.iter().enumerate();
                        for (k, call) in calls.filter(|(_, call)| call.law == *law) {
                            let Some(slope) = slope(&slopes.by_call, k) else { continue };
                            let x = number(call.x);
                            by_p.push((row, jet(slope * x.chain(derivatives(by, x.value(), call.order)))));
                        }
                    }
                }
            }
        }
    }
}

fn jet(number: Number) -> Jet {
    [number.0.re, number.0.v1, number.0.v2]
}

/// Derivative number `order` of a law at x, with the two that follow.
fn derivatives(law: &crate::model::law::Law, x: f64, order: u8) -> [f64; 4] {
    let [f, f1, f2, f3] = law.jet(x);
    match order {
        0 => [f, f1, f2, f3],
        1 => [f1, f2, f3, f64::NAN],
        2 => [f2, f3, law.fourth(x), f64::NAN],
        _ => [f64::NAN; 4],
    }
}

impl Source<Number> for Walk<'_> {
    fn input(&self, input: Input) -> Number {
        let (columns, parameters) = (self.equation.columns, self.equation.parameters);
        match input {
            Input::State(k, _) if k < columns => {
                self.columns.get(k).copied().unwrap_or(Number::from(f64::NAN))
            }
            Input::State(k, _) if k < columns + parameters => {
                Number::from(self.parameters.get(k - columns).copied().unwrap_or(f64::NAN))
            }
            Input::State(..) => Number::from(0.0),
            Input::Time => Real(Dual2_64::new(self.t, 1.0, 0.0)),
            _ => Number::from(f64::NAN),
        }
    }

    fn law(&self, law: usize, x: Number, order: u8) -> Number {
        let given = Given::by(self.outside, law, &[]);
        x.chain(given.law().map_or([f64::NAN; 4], |law| derivatives(law, x.value(), order)))
    }

    /// A number that the user's own functions make of parameters does not move.
    fn opaque(&self, number: usize, component: usize, operands: Vec<Number>) -> Number {
        let operands: Vec<Dual3_64> = operands.iter().map(|x| Dual3_64::from_re(x.value())).collect();
        Number::from(Given::by(self.outside, number, &operands).number(component).re)
    }

    fn leaf(&self, _: LeafUse, _: Vec<Number>) -> Number {
        Number::from(f64::NAN)
    }
}
