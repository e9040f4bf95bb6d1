//! Bounds C and its derivatives by coordinates, dimensions and time, over boxes of coordinates,
//! dimensions and times.

use kin_graph::{
    Formula, Graph, Input, LeafUse, Node, Op, Source, evaluate, evaluate_along, evaluate_beyond,
};

use crate::ask::proof::{Bounds, Column, Entry, Part, Unknown};
use crate::dimensions::{Bound, Holder};
use crate::model::formula::Outside;
use crate::model::formula::bounds::Inputs;
use crate::numbers::enclosure::Series;
use crate::numbers::enclosure::interval::{Interval, ONE, ZERO};
use crate::outcome::error::{Error, Result};
use crate::system::System;

/// The number of coefficients of a series with values and slopes.
const SLOPES: usize = 2;

/// The equations of a system as functions of coordinates, the dimensions with tolerances, and time.
pub(super) struct Equations<'a> {
    bounds: Bounds<'a>,
    names: &'a [String],
    /// For each constraint the parameters of its formula that depend on these dimensions, as
    /// (parameter, index among all numbers that depend on dimensions).
    hung: Vec<Vec<(usize, usize)>>,
}

/// Positions, and dimensions with the time as the last entry.
pub(super) struct Region<'a> {
    pub q: &'a [Interval],
    pub d: &'a [Interval],
}

/// Bounds of C_q and of the derivatives by dimensions and time, except those that are always zero.
#[derive(Default)]
pub(super) struct Slopes {
    pub by_q: Vec<Entry>,
    pub by_d: Vec<Entry>,
}

impl<'a> Equations<'a> {
    /// Prepares the equations. Errors: those of [`System::prove`]; by name a law or a function of
    /// the user's program that depends on one of the dimensions, because it has no known bounds.
    pub(super) fn new(system: &'a System, names: &'a [String]) -> Result<Self> {
        system.provable()?;
        let bounds = Bounds::new(system)?;
        let mut equations = Equations { hung: vec![Vec::new(); bounds.parts.len()], bounds, names };
        let now = system.hung_over(names, &equations.nominal(None)?);
        let mut moves = vec![false; now.len()];
        for k in 0..names.len() {
            let moved = system.hung_over(names, &equations.nominal(Some(k))?);
            moves.iter_mut().zip(moved).for_each(|(moves, (_, x))| *moves |= !x.is_constant());
        }
        for (number, (at, value)) in now.iter().enumerate().filter(|(number, _)| moves[*number]) {
            let (constraint, name) = match at {
                Bound::Parameter { of: Holder::Constraint(constraint), name, .. } => {
                    (constraint, name)
                }
                Bound::Axis { of: Holder::Constraint(constraint), name, .. } => {
                    let own = format!("{}.{name}", system.equations().blocks[*constraint].name);
                    return Err(refused(
                        &own,
                        "is an axis that depends on dimensions, and Kin has no bounds of such an axis",
                    ));
                }
                _ => continue,
            };
            let part = &equations.bounds.parts[*constraint];
            let own = format!("{}.{name}", system.equations().blocks[*constraint].name);
            let found = parameter(part, name, value).map_err(|reason| refused(&own, reason))?;
            equations.hung[*constraint].push((found, number));
        }
        Ok(equations)
    }

    pub(super) fn system(&self) -> &'a System {
        self.bounds.system
    }

    /// Returns the laws whose stated bounds Kin relies on, each with its constraint.
    pub(super) fn trusted(&self) -> Vec<String> {
        self.bounds.trusted()
    }

    /// Returns the nominal dimensions as series; dimension `moving` is the variable.
    fn nominal(&self, moving: Option<usize>) -> Result<Vec<Series>> {
        let of = |(k, name): (usize, &String)| {
            let x = Interval::from(self.system().parameter(name)?);
            Ok(if moving == Some(k) {
                Series::variable(x, ONE, SLOPES)
            } else {
                Series::constant(x)
            })
        };
        self.names.iter().enumerate().map(of).collect()
    }

    /// Returns all numbers that depend on dimensions; dimension `moving` is the variable.
    fn numbers(&self, d: &[Interval], moving: Option<usize>) -> Vec<Series> {
        let of = |(k, x): (usize, &Interval)| match moving {
            Some(moving) if moving == k => Series::variable(*x, ONE, SLOPES),
            _ => Series::constant(*x),
        };
        let all: Vec<Series> = d.iter().enumerate().take(self.names.len()).map(of).collect();
        self.system().hung_over(self.names, &all).into_iter().map(|(_, number)| number).collect()
    }

    /// Returns bounds of every row of C.
    pub(super) fn residual(
        &self,
        region: &Region<'_>,
    ) -> std::result::Result<Vec<Interval>, Unknown> {
        let numbers = self.numbers(region.d, None);
        let q = constants(region.q);
        let t = Series::constant(time(region.d));
        let mut c = Vec::with_capacity(self.system().n_equations());
        for (part, hung) in self.bounds.parts.iter().zip(&self.hung) {
            let columns: Vec<Series> = part.columns.iter().map(|column| column.of(&q)).collect();
            part.with(&mut |table, parameters, outside| {
                let Formula { graph, rows, .. } = table.formula();
                let parameters = &given(parameters, hung, &numbers);
                let results = evaluate(graph, rows, &Walk::of(&columns, t, parameters, outside));
                c.extend(part.rows(table, &results, 1)?.iter().map(Series::value));
                Ok(())
            })?;
        }
        Ok(c)
    }

    /// Returns bounds of the derivatives of every row. As in [`Part::jacobian`], each row is
    /// evaluated along every variable on which it may depend, because a jump has no slope that
    /// would show it.
    pub(super) fn slopes(&self, region: &Region<'_>) -> std::result::Result<Slopes, Unknown> {
        let still = self.numbers(region.d, None);
        let moved: Vec<Vec<Series>> =
            (0..self.names.len()).map(|k| self.numbers(region.d, Some(k))).collect();
        let mut slopes = Slopes::default();
        for (part, hung) in self.bounds.parts.iter().zip(&self.hung) {
            self.of_part((part, hung), region, (&still, &moved), &mut slopes)?;
        }
        Ok(slopes)
    }

    fn of_part(
        &self,
        (part, hung): (&Part<'_>, &[(usize, usize)]),
        region: &Region<'_>,
        (still, moved): (&[Series], &[Vec<Series>]),
        slopes: &mut Slopes,
    ) -> std::result::Result<(), Unknown> {
        let q = constants(region.q);
        let t = Series::constant(time(region.d));
        let columns: Vec<Series> = part.columns.iter().map(|column| column.of(&q)).collect();
        part.with(&mut |table, parameters, outside| {
            let Formula { graph, rows, .. } = table.formula();
            let own = given(parameters, hung, still);
            let known = evaluate(graph, rows, &Walk::of(&columns, t, &own, outside));
            let entries = |along, column: usize, to: &mut Vec<Entry>| {
                let along = part.rows(table, &along, SLOPES)?;
                let all =
                    along.iter().enumerate().map(|(row, y)| (part.first + row, column, y.at(1)));
                to.extend(all.filter(|entry| entry.2 != ZERO));
                Ok(())
            };
            for (k, column) in part.columns.iter().enumerate() {
                let Column::Own(column) = *column else { continue };
                let mut along = columns.clone();
                along[k] = Series::variable(columns[k].value(), ONE, SLOPES);
                let walk = Walk::of(&along, t, &own, outside);
                let found = evaluate_along(graph, rows, Input::Column(k), &known, &walk);
                entries(found, column, &mut slopes.by_q)?;
            }
            for (k, moved) in moved.iter().enumerate() {
                if hung.iter().all(|(_, number)| moved[*number].is_constant()) {
                    continue;
                }
                let own = given(parameters, hung, moved);
                let moves = |node| match graph.op(node) {
                    Op::Input(Input::Parameter(k)) => {
                        own.get(k).copied().filter(|x| !x.is_constant())
                    }
                    _ => None,
                };
                let walk = Walk::of(&columns, t, &own, outside);
                let found = evaluate_beyond(graph, rows, moves, &known, &walk);
                entries(found, k, &mut slopes.by_d)?;
            }
            let later = Series::variable(t.value(), ONE, SLOPES);
            let walk = Walk::of(&columns, later, &own, outside);
            let found = evaluate_along(graph, rows, Input::Time, &known, &walk);
            entries(found, self.names.len(), &mut slopes.by_d)
        })
    }
}

fn constants(all: &[Interval]) -> Vec<Series> {
    all.iter().map(|x| Series::constant(*x)).collect()
}

/// Returns the time of a box.
fn time(d: &[Interval]) -> Interval {
    d.last().copied().unwrap_or(ZERO)
}

/// Returns the parameters of a formula, including those that depend on dimensions.
fn given(parameters: &[f64], hung: &[(usize, usize)], numbers: &[Series]) -> Vec<Series> {
    let mut all: Vec<Series> = parameters.iter().map(|x| Series::number(*x)).collect();
    hung.iter().for_each(|(own, number)| all[*own] = numbers[*number]);
    all
}

fn refused(parameter: &str, reason: &str) -> Error {
    Error::CannotBeProved {
        what: "a worst case".to_string(),
        reason: format!("`{parameter}` {reason}"),
    }
}

/// Returns the index in the formula of the parameter with this name and value, or the reason why it
/// cannot be followed.
fn parameter(
    part: &Part<'_>,
    name: &str,
    value: &Series,
) -> std::result::Result<usize, &'static str> {
    let found = part.constraint.formula(|table, values, _| {
        let Formula { graph, rows, parameters, .. } = table.formula();
        let k = parameters.iter().position(|known| known == name);
        let law =
            "is a coefficient of a law, and Kin has bounds of this law at one value only. Remove the tolerance of the coefficient";
        let k = k.ok_or(law)?;
        if graph.reachable(rows).into_iter().any(|node| is_foreign(graph, node, k)) {
            return Err(
                "is an argument of a user-defined function, and Kin has bounds of this function at one value only. Write the expression of the function in the equation",
            );
        }
        let held = values.get(k).is_some_and(|held| value.value().contains(*held));
        held.then_some(k).ok_or("differs from the value of its dimensions")
    });
    found.unwrap_or(Err("is in no equation that Kin knows as a formula"))
}

/// Returns true if a function that only the user's program can compute reads that parameter.
fn is_foreign(graph: &Graph, node: Node, parameter: usize) -> bool {
    let Op::Opaque(number, _) = graph.op(node) else { return false };
    let read =
        graph.opaques.get(number).map(|operands| graph.reachable(operands)).unwrap_or_default();
    read.into_iter().any(|node| graph.op(node) == Op::Input(Input::Parameter(parameter)))
}

/// Inputs whose parameters are series too.
struct Walk<'a> {
    inputs: Inputs<'a>,
    parameters: &'a [Series],
}

impl<'a> Walk<'a> {
    fn of(
        columns: &'a [Series],
        t: Series,
        parameters: &'a [Series],
        outside: Outside<'a>,
    ) -> Self {
        Walk { inputs: Inputs { columns, t, parameters: &[], outside }, parameters }
    }
}

impl Source<Series> for Walk<'_> {
    fn input(&self, input: Input) -> Series {
        match input {
            Input::Parameter(k) if k < self.parameters.len() => self.parameters[k],
            input => self.inputs.input(input),
        }
    }

    fn law(&self, law: usize, x: Series, order: u8) -> Series {
        self.inputs.law(law, x, order)
    }

    fn opaque(&self, number: usize, component: usize, operands: Vec<Series>) -> Series {
        self.inputs.opaque(number, component, operands)
    }

    fn leaf(&self, used: LeafUse, operands: Vec<Series>) -> Series {
        self.inputs.leaf(used, operands)
    }
}
