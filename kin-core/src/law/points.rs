//! Stores the tables of splines and the conditions at their ends.

use std::path::Path;

use super::sequence::within;
use super::{Beyond, Law, LawRange};
use crate::dimensions::{Bindings, IntoNumber};
use crate::outcome::error::{Error, Result};
use crate::outcome::words::count;

/// The conditions at the ends of a spline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ends {
    /// The curvature is zero at the ends; beyond the ends the spline continues as a straight line.
    Natural,
    /// The slopes at the ends are given; beyond the ends the spline continues as a straight line
    /// with the given slope.
    Clamped {
        /// Slope at the first x.
        start: f64,
        /// Slope at the last x.
        end: f64,
    },
    /// The spline repeats; the last y must equal the first y.
    Periodic,
}

/// Points (x, y) with increasing x, and the conditions at the ends.
#[derive(Clone)]
pub(super) struct Points {
    pub table: Vec<(f64, f64)>,
    pub ends: Ends,
}

impl Points {
    /// Reads a table, whose y values may depend on dimensions.
    pub fn new(table: &[(f64, impl IntoNumber)], ends: Ends, to: &mut Bindings) -> Points {
        let y = to.list("y", 0, table.iter().map(|(_, y)| *y));
        Points { table: table.iter().map(|(x, _)| *x).zip(y).collect(), ends }
    }

    /// Returns the width of interval k and the rise over it.
    pub fn step(&self, k: usize) -> (f64, f64) {
        let (x0, y0) = self.table[k];
        let (x1, y1) = self.table[k + 1];
        (x1 - x0, y1 - y0)
    }

    /// Returns the width of interval k and the slope of the straight line over it.
    pub fn interval(&self, k: usize) -> (f64, f64) {
        let (width, rise) = self.step(k);
        (width, rise / width)
    }

    /// Returns the first and the last x of a table that does not repeat.
    pub fn range(&self) -> Option<LawRange> {
        let (from, _) = self.table.first()?;
        let (to, _) = self.table.last()?;
        let range = LawRange { from: *from, to: *to, beyond: Beyond::Line };
        (self.ends != Ends::Periodic).then_some(range)
    }

    /// Maps x into the table and returns the mapped x with the number of its interval, or of the
    /// side outside the table.
    ///
    /// The last x belongs to the last interval.
    pub fn place(&self, x: f64) -> (f64, usize) {
        let first = self.table[0].0;
        let last = self.table[self.table.len() - 1].0;
        let turned =
            || Some(first + within(x - first, last - first)).filter(|x| *x < last).unwrap_or(first);
        let x = if self.ends == Ends::Periodic { turned() } else { x };
        let after = self.table.partition_point(|(knot, _)| *knot <= x);
        (x, if x == last { self.table.len() - 1 } else { after })
    }

    /// Returns the reason if no spline goes through the points.
    ///
    /// The text contains `kind`, the name of the law.
    pub fn refusal(&self, kind: &str) -> Option<String> {
        let least = if self.ends == Ends::Periodic { 3 } else { 2 };
        if self.table.len() < least {
            let points = count(self.table.len(), "point");
            return Some(format!("{kind}: the table has {points}. Give at least {least} points"));
        }
        if let Some(k) = self.table.iter().position(|(x, y)| !(x.is_finite() && y.is_finite())) {
            return Some(format!(
                "{kind}: point {} is ({}, {}). Give finite numbers",
                k + 1,
                self.table[k].0,
                self.table[k].1
            ));
        }
        if let Some(k) = self.table.windows(2).position(|pair| pair[1].0 <= pair[0].0) {
            let before = self.table[k].0;
            let after = self.table[k + 1].0;
            return Some(format!(
                "{kind}: the values of x must increase, but x = {before} is followed by {after} (point {})",
                k + 2
            ));
        }
        let first = self.table[0].1;
        let last = self.table[self.table.len() - 1].1;
        let size = self.table.iter().fold(0.0_f64, |m, (_, y)| m.max(y.abs()));
        (self.ends == Ends::Periodic && (first - last).abs() > 1e-9 * size).then(|| {
            format!(
                "{kind}: the first and the last y of a periodic table must be equal, but the first is {first} and the last is {last}"
            )
        })
    }

    /// Returns the x values of the table and the conditions at its ends, by name.
    ///
    /// The number `periodic` is 1 for a table that repeats. The numbers `start` and `end` are given
    /// slopes.
    pub fn fixed_numbers(&self) -> Vec<(String, f64)> {
        let ends = match self.ends {
            Ends::Natural => vec![],
            Ends::Clamped { start, end } => {
                vec![("start".to_string(), start), ("end".to_string(), end)]
            }
            Ends::Periodic => vec![("periodic".to_string(), 1.0)],
        };
        self.table
            .iter()
            .enumerate()
            .map(|(k, (x, _))| (format!("x[{k}]"), *x))
            .chain(ends)
            .collect()
    }

    /// Passes each y and its name to `visit`.
    pub fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        for (k, (_, y)) in self.table.iter().enumerate() {
            visit(&format!("y[{k}]"), *y);
        }
    }

    /// Returns the table with another value of one y, or `None` if no y has this name.
    ///
    /// In a table that repeats, the first and the last y change together.
    pub fn with_parameter(&self, name: &str, value: f64) -> Option<Points> {
        let k = (0..self.table.len()).find(|k| name == format!("y[{k}]"))?;
        let mut table = self.table.clone();
        table[k].1 = value;
        if self.ends == Ends::Periodic && (k == 0 || k + 1 == table.len()) {
            let last = table.len() - 1;
            (table[0].1, table[last].1) = (value, value);
        }
        Some(Points { table, ends: self.ends })
    }
}

/// Makes a law through the first two columns of a CSV file. A first line without numbers is a
/// header.
pub(super) fn from_csv(path: &Path, law: impl Fn(&[(f64, f64)]) -> Law) -> Result<Law> {
    let fail = |reason: String| Error::Table { path: path.to_path_buf(), reason };
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_path(path);
    let reader = reader.as_mut().map_err(|error| fail(error.to_string()))?;
    let mut table = Vec::new();
    for (k, record) in reader.records().enumerate() {
        let record = record.map_err(|error| fail(error.to_string()))?;
        let number = |column: usize| record.get(column).and_then(|text| text.parse::<f64>().ok());
        match (number(0), number(1)) {
            (Some(x), Some(y)) => table.push((x, y)),
            _ if record.iter().any(|text| text.contains(';')) => {
                return Err(fail(format!(
                    "line {}: columns are separated by semicolons. Separate them by commas, and write decimal points, as in 0.5,1.25",
                    k + 1
                )));
            }
            _ if k == 0 => {}
            _ => {
                return Err(fail(format!(
                    "line {}: `{}` is not two numbers",
                    k + 1,
                    record.iter().collect::<Vec<_>>().join(",")
                )));
            }
        }
    }
    let law = law(&table);
    law.refusal().map_or(Ok(law), |reason| Err(fail(reason)))
}

#[cfg(test)]
mod tests;
