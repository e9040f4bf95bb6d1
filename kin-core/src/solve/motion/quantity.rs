//! Stores one quantity over time with its derivatives.

use super::{Motion, Series};
use crate::coordinates::units::Units;
use crate::outcome::error::{Error, Result};

/// One quantity over time with its derivatives: a coordinate, the angle of a joint, a slide.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Quantity {
    /// x   \[m or rad\]
    pub value: Series,
    /// ẋ   \[m/s or rad/s\]
    pub rate: Series,
    /// ẍ   \[m/s² or rad/s²\]
    pub second_rate: Series,
    /// x⃛ \[m/s³ or rad/s³\]; empty if the run did not compute the jerk
    /// ([`crate::SolverOptions::jerk`]).
    pub third_rate: Series,
}

/// The values of a [`Quantity`], one for each time of a motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct QuantityValues {
    /// x
    pub value: Vec<f64>,
    /// ẋ
    pub rate: Vec<f64>,
    /// ẍ
    pub second_rate: Vec<f64>,
    /// x⃛; empty if x⃛ is unknown.
    pub third_rate: Vec<f64>,
}

/// The suffixes of derivatives in names: x, x', x'', x'''.
pub(crate) const MARKS: [&str; 4] = ["", "'", "''", "'''"];

impl Quantity {
    /// Creates a quantity from x in `unit`, ẋ, ẍ and x⃛ (empty, or one for each time), and the
    /// names of the units.
    pub(crate) fn new(
        name: &str,
        unit: &str,
        (times, units): (&[f64], &Units),
        orders: [Vec<f64>; 4],
    ) -> Self {
        let mut orders =
            orders.into_iter().zip(MARKS).enumerate().map(|(order, (values, mark))| {
                let times = if values.is_empty() { &[] } else { times };
                Series::new(
                    format!("{name}{mark}"),
                    units.rate(unit, order),
                    (times, units),
                    values,
                )
            });
        let mut next =
            || orders.next().unwrap_or_else(|| Series::new("", "", (&[], units), Vec::new()));
        Quantity { value: next(), rate: next(), second_rate: next(), third_rate: next() }
    }

    /// Returns x, ẋ, ẍ and x⃛ (or nothing).
    pub(crate) fn orders(&self) -> [&[f64]; 4] {
        [
            self.value.values(),
            self.rate.values(),
            self.second_rate.values(),
            self.third_rate.values(),
        ]
    }

    pub(crate) fn orders_mut(&mut self) -> [&mut [f64]; 4] {
        [&mut self.value, &mut self.rate, &mut self.second_rate, &mut self.third_rate]
            .map(Series::values_mut)
    }

    /// Changes the name of the quantity.
    #[must_use]
    pub fn renamed(mut self, name: &str) -> Self {
        let all = [&mut self.value, &mut self.rate, &mut self.second_rate, &mut self.third_rate];
        all.into_iter()
            .zip(MARKS)
            .for_each(|(series, mark)| series.rename(format!("{name}{mark}")));
        self
    }
}

impl Motion {
    /// Creates a quantity from `values` that the program computed from this motion, with x in
    /// `unit`.
    ///
    /// Kin does not check that the derivatives match the values.
    ///
    /// Call this function in a measure that is a function of a motion
    /// ([`crate::results::Measure`]).
    ///
    /// Errors: a list does not have one number for each time; a number is infinite or NaN.
    pub fn quantity(&self, name: &str, unit: &str, values: QuantityValues) -> Result<Quantity> {
        let QuantityValues { value, rate, second_rate, third_rate } = values;
        let orders = [value, rate, second_rate, third_rate];
        for (values, mark) in orders.iter().zip(MARKS) {
            let may_lack = mark == MARKS[3] && values.is_empty();
            if values.len() != self.len() && !may_lack {
                let what = format!("`{name}{mark}`, one number per time");
                return Err(Error::WrongLength { what, expected: self.len(), found: values.len() });
            }
            if let Some(k) = values.iter().position(|value| !value.is_finite()) {
                let output = format!("{name}{mark}");
                let value = values[k];
                let t = self.times()[k];
                return Err(Error::OutputNotFinite {
                    output,
                    value,
                    t,
                    units: self.unit_words().clone(),
                });
            }
        }
        Ok(Quantity::new(name, unit, (self.times(), self.unit_words()), orders))
    }
}

impl std::ops::Sub for Quantity {
    type Output = Quantity;

    /// Returns the difference of two measures of one motion, with its derivatives.
    fn sub(mut self, other: Quantity) -> Quantity {
        let name = format!("{} − {}", self.value.name(), other.value.name());
        for (own, less) in self.orders_mut().into_iter().zip(other.orders()) {
            own.iter_mut().zip(less).for_each(|(own, less)| *own -= less);
        }
        self.renamed(&name)
    }
}
