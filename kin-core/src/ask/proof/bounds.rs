//! Bounds of C and C_q of a whole system over boxes and intervals of time.

use kin_graph::{Formula, Input, Results, evaluate, evaluate_along};

use crate::model::blame::Source;
use crate::model::constraint::{Constraint, Route};
use crate::model::formula::bounds::{self as equation, Inputs};
use crate::model::formula::{Outside, Table};
use crate::numbers::enclosure::interval::{Interval, ONE, ZERO};
use crate::numbers::enclosure::series::Series;
use crate::outcome::error::Error;
use crate::system::System;
use crate::system::evaluate::Block;

/// An equation without known bounds over a box, and the expression that is responsible.
#[derive(Clone, Debug)]
pub(crate) struct Unknown {
    pub(crate) row: usize,
    pub(crate) expression: Option<(String, Option<Source>)>,
}

/// The equations of a system, for bounds.
pub(crate) struct Bounds<'a> {
    pub system: &'a System,
    pub parts: Vec<Part<'a>>,
}

/// One constraint, and the coordinates of its columns.
pub(crate) struct Part<'a> {
    pub constraint: &'a dyn Constraint,
    /// The index of its first row among all.
    pub first: usize,
    pub columns: Vec<Column>,
}

#[derive(Clone, Copy)]
pub(crate) enum Column {
    Own(usize),
    /// A coordinate of the ground, with its value.
    Fixed(f64),
}

impl<'a> Bounds<'a> {
    /// Creates the bounds of a system. Returns an error with the name of a constraint without a
    /// formula.
    pub(crate) fn new(system: &'a System) -> Result<Self, Error> {
        let equations = system.equations();
        let instant = equations.instant_at(0.0, system.initial());
        let part = |block: &'a Block| {
            let constraint = block.constraint.as_ref();
            let what = || format!("a motion with `{}` ({})", block.name, constraint.facts().kind);
            unreadable(constraint)
                .map_or(Ok(()), |reason| Err(Error::CannotBeProved { what: what(), reason }))?;
            let arguments = constraint.arguments();
            let at = equations.at(block, &instant);
            let values = arguments
                .iter()
                .enumerate()
                .flat_map(|(k, argument)| at.coordinates(k, argument.target.columns()));
            let places = arguments.iter().flat_map(|argument| system.layout().columns(argument));
            let columns = places
                .zip(values)
                .map(|(place, value)| place.map_or(Column::Fixed(*value), Column::Own))
                .collect();
            Ok(Part { constraint, first: block.rows().start, columns })
        };
        Ok(Bounds {
            system,
            parts: equations.blocks.iter().map(part).collect::<Result<_, Error>>()?,
        })
    }

    /// Returns the laws whose stated bounds Kin relies on, each with its constraint.
    pub(crate) fn trusted(&self) -> Vec<String> {
        let blocks = self.parts.iter().zip(&self.system.equations().blocks);
        let mut all: Vec<String> = blocks
            .flat_map(|(part, block)| {
                part.trusted().into_iter().map(|law| format!("`{law}` in `{}`", block.name))
            })
            .collect();
        all.sort();
        all.dedup();
        all
    }

    /// Bounds every row of C along q and t.
    pub(super) fn residual(&self, q: &[Series], t: Series) -> Result<Vec<Series>, Unknown> {
        let mut c = Vec::with_capacity(self.system.n_equations());
        self.parts.iter().try_for_each(|part| part.residual(q, t, &mut c))?;
        Ok(c)
    }

    /// Bounds the entries of C_q over a box of positions and an interval of time.
    pub(super) fn jacobian(&self, q: &[Interval], t: Interval) -> Result<Vec<Entry>, Unknown> {
        let mut entries = Vec::new();
        self.parts.iter().try_for_each(|part| part.jacobian(q, t, &mut entries))?;
        Ok(entries)
    }
}

/// The row, column and bounds of an entry of C_q.
pub(crate) type Entry = (usize, usize, Interval);

impl Column {
    pub(crate) fn of<T: Copy + From<Fixed>>(self, q: &[T]) -> T {
        match self {
            Column::Own(k) => q.get(k).copied().unwrap_or(T::from(Fixed(f64::NAN))),
            Column::Fixed(x) => T::from(Fixed(x)),
        }
    }
}

/// A constant.
pub(crate) struct Fixed(f64);

impl From<Fixed> for Interval {
    fn from(x: Fixed) -> Self {
        Interval::from(x.0)
    }
}

impl From<Fixed> for Series {
    fn from(x: Fixed) -> Self {
        Series::constant(Interval::from(x.0))
    }
}

/// A function that receives a formula, the values of its parameters and the function that computes
/// the outside values.
pub(crate) type Shown<'a> = dyn FnMut(&Table, &[f64], Outside<'_>) -> Result<(), Unknown> + 'a;

impl<'a> Part<'a> {
    /// Returns the bounds of a single constraint with its local columns, or `None` if it has no
    /// formula.
    pub(crate) fn alone(constraint: &'a dyn Constraint) -> Option<Self> {
        let columns = constraint.arguments().iter().map(|argument| argument.target.columns()).sum();
        unreadable(constraint).is_none().then(|| Part {
            constraint,
            first: 0,
            columns: (0..columns).map(Column::Own).collect(),
        })
    }

    /// Appends its rows of C along q and t.
    pub(crate) fn residual(
        &self,
        q: &[Series],
        t: Series,
        c: &mut Vec<Series>,
    ) -> Result<(), Unknown> {
        let columns: Vec<Series> = self.columns.iter().map(|column| column.of(q)).collect();
        self.with(&mut |table, parameters, outside| {
            let Formula { graph, rows, .. } = table.formula();
            let results =
                evaluate(graph, rows, &Inputs { columns: &columns, t, parameters, outside });
            c.extend(self.rows(table, &results, 1)?);
            Ok(())
        })
    }

    /// Appends its entries of C_q over a box and an interval of time, except those that are always
    /// zero.
    ///
    /// Every row is evaluated over the whole box along each column, whether it has an entry there
    /// or not, because floor, `if` and similar operations jump where their slopes are zero. The
    /// constants that the compiler knows are not used, because they are rounded.
    pub(crate) fn jacobian(
        &self,
        q: &[Interval],
        t: Interval,
        entries: &mut Vec<Entry>,
    ) -> Result<(), Unknown> {
        let columns: Vec<Series> =
            self.columns.iter().map(|column| Series::constant(column.of(q))).collect();
        self.with(&mut |table, parameters, outside| {
            let t = Series::constant(t);
            let Formula { graph, rows, .. } = table.formula();
            let still =
                evaluate(graph, rows, &Inputs { columns: &columns, t, parameters, outside });
            for (k, column) in self.columns.iter().enumerate() {
                let Column::Own(column) = *column else { continue };
                let mut moved = columns.clone();
                moved[k] = Series::variable(columns[k].value(), ONE, 2);
                let inputs = Inputs { columns: &moved, t, parameters, outside };
                let along = evaluate_along(graph, rows, Input::Column(k), &still, &inputs);
                let along = self.rows(table, &along, 2)?;
                let all =
                    along.iter().enumerate().map(|(row, y)| (self.first + row, column, y.at(1)));
                entries.extend(all.filter(|entry| entry.2 != ZERO));
            }
            Ok(())
        })
    }

    /// Returns its rows among the results, with at least `len` coefficients of each.
    pub(crate) fn rows(
        &self,
        table: &Table,
        results: &Results<Series>,
        len: usize,
    ) -> Result<Vec<Series>, Unknown> {
        let known = |row: usize| {
            let y = equation::row(table.formula(), row, results);
            let is_known = y.len() >= len && y.known().iter().all(|c| c.is_finite());
            is_known.then_some(y).ok_or_else(|| Unknown {
                row: self.first + row,
                expression: table.unknown(row, results, len),
            })
        };
        (0..table.formula().rows.len()).map(known).collect()
    }

    /// Returns the laws whose stated bounds Kin relies on.
    fn trusted(&self) -> Vec<String> {
        self.constraint
            .formula(|table, _, outside| equation::trusted(table.formula(), outside))
            .unwrap_or_default()
    }

    /// Passes the formula on.
    pub(crate) fn with(&self, of: &mut Shown<'_>) -> Result<(), Unknown> {
        self.constraint.formula(of).unwrap_or(Ok(()))
    }
}

/// Returns the reason why a constraint has no bounds at all, if there is one.
fn unreadable(constraint: &dyn Constraint) -> Option<String> {
    let facts = constraint.facts();
    let known = constraint.formula(|table, _, outside| {
        let formula = table.formula();
        if formula.rows.len() == facts.rows.len() {
            equation::opaque(formula, outside)
        } else {
            Some("the equation has too many operations".to_string())
        }
    });
    known.unwrap_or_else(|| {
        let how = match facts.route() {
            Route::Symbolic => "Kin does not know the equation as a formula",
            Route::Dual => "Kin differentiates the constraint by dual numbers",
            Route::Hand => "the constraint is hand-written",
        };
        Some(format!("{how}, so Kin has no bounds of the equation over an interval"))
    })
}

/// Returns Σ c_j σʲ over −1 ≤ σ ≤ 1, by Taylor's formula: the coefficients at σ = 0, and for the
/// remainder those over all σ.
pub(super) fn taylor(at: &Series, over: &Series) -> Interval {
    let Some(last) = over.len().checked_sub(1) else { return over.value() };
    let unit = |k: usize| {
        if k == 0 {
            ONE
        } else if k.is_multiple_of(2) {
            ZERO.hull(ONE)
        } else {
            Interval::ball(1.0)
        }
    };
    (0..last).map(|k| at.at(k) * unit(k)).fold(over.at(last) * unit(last), |sum, term| sum + term)
}
