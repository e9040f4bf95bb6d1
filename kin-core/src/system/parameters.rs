//! Reads and sets parameters by name, such as `slot.k`, without a rebuild of the system.

use super::System;
use crate::model::mechanism::admission::sensible_parameters;
use crate::outcome::error::{Error, Result};

/// The place of one number of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum CasePlace {
    /// Parameter `index` of a constraint.
    Parameter { block: usize, index: usize },
    /// Component `k` of the direction along an axis, which is parameter `index` of a constraint.
    Component { block: usize, index: usize, k: usize },
    /// The initial value of a coordinate, and its preferred value if it has one.
    Coordinate(usize),
    /// The value of a dimension, and all numbers that depend on it.
    Dimension(usize),
}

impl System {
    /// Returns the names and values of all numeric parameters, such as (`slot.k`, 2.0), in the
    /// order of the constraints.
    pub fn parameters(&self) -> Vec<(String, f64)> {
        let mut all = Vec::new();
        for (number, block) in self.equations.blocks.iter().enumerate() {
            block.constraint.parameters(&mut |name, value| {
                let value = self.given_component(number, name).unwrap_or(value);
                all.push((format!("{}.{name}", block.name), value));
            });
        }
        all
    }

    /// Returns the value of one parameter, such as `slot.k`, or of a dimension.
    ///
    /// Errors: no parameter or dimension has the name.
    pub fn parameter(&self, name: &str) -> Result<f64> {
        if let Some((_, value)) = self.dimensions().into_iter().find(|(known, _)| known == name) {
            return Ok(value);
        }
        let (block, own, value) = self.find(name)?;
        Ok(self.given_component(block, &own).unwrap_or(value))
    }

    /// Sets one dimension and all numbers that depend on it, or one parameter, such as `slot.k`.
    ///
    /// The pattern and the order of the equations do not change. You can also set a parameter that
    /// depends on a dimension. Such a parameter keeps its value until you set the dimension.
    ///
    /// Errors: no parameter or dimension has the name; the value is not finite; the value is
    /// outside the range of the dimension; the name is an expression of dimensions; the value
    /// contradicts other parameters. After an error the old value remains.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        if let Some(k) = self.dimension_number(name) {
            return self.set_dimension(k, value);
        }
        let (index, parameter, _) = self.find(name)?;
        let block = &mut self.equations.blocks[index];
        if !value.is_finite() {
            return Err(Error::ParameterNotFinite {
                constraint: block.name.clone(),
                parameter,
                value,
            });
        }
        let constraint = block.constraint.clone_boxed();
        let axes = self.axes.clone();
        self.forget();
        let set = match self.component(index, &parameter) {
            Some((axis, k)) => self.put_component(index, (&axis, k), value),
            None => self.equations.blocks[index].constraint.set_parameter(&parameter, value),
        };
        let block = &mut self.equations.blocks[index];
        let checked = if set {
            sensible_parameters(&block.name, block.constraint.as_ref())
        } else {
            Err(cannot_be_set(name))
        };
        if checked.is_err() {
            (block.constraint, self.axes) = (constraint, axes);
        }
        checked
    }

    /// Returns the places of the numbers of a case.
    pub(crate) fn places(
        &self,
        names: impl IntoIterator<Item = impl AsRef<str>>,
    ) -> Result<Vec<CasePlace>> {
        let parameters = self.parameters();
        let mut copy = self.clone();
        let mut place = |name: &str| {
            if let Some(k) = self.dimension_number(name) {
                self.settable_dimension(k)?;
                return Ok(CasePlace::Dimension(k));
            }
            if let Some(number) = parameters.iter().position(|(known, _)| known == name) {
                let place = self.numbered(number);
                // A number that cannot be set, such as one of a law without names, is an error now.
                return if copy.put(place, parameters[number].1) {
                    Ok(place)
                } else {
                    Err(cannot_be_set(name))
                };
            }
            let coordinate = self
                .coordinate_names()
                .iter()
                .position(|known| known == name)
                .map(CasePlace::Coordinate);
            coordinate.ok_or_else(|| {
                let known = self
                    .near(name)
                    .into_iter()
                    .chain(self.coordinate_names().iter().cloned())
                    .collect();
                Error::UnknownName {
                    what: "parameter or coordinate",
                    name: name.to_string(),
                    known,
                }
            })
        };
        names.into_iter().map(|name| place(name.as_ref())).collect()
    }

    /// Returns which constraints differ from case to case, if the numbers of a case have these
    /// places.
    pub(crate) fn varied(&self, places: &[CasePlace]) -> Vec<bool> {
        let has = |k: usize| {
            places.iter().any(|place| match place {
                CasePlace::Parameter { block, .. } | CasePlace::Component { block, .. } => {
                    *block == k
                }
                CasePlace::Dimension(dimension) => {
                    self.blocks_on(*dimension).any(|block| block == k)
                }
                CasePlace::Coordinate(_) => false,
            })
        };
        (0..self.equations.blocks.len()).map(has).collect()
    }

    /// Returns a copy in which each of these numbers has another value, to see what depends on
    /// them.
    pub(crate) fn nudged(&self, names: &[String], places: &[CasePlace]) -> System {
        let mut copy = self.clone();
        for (k, (name, place)) in names.iter().zip(places).enumerate() {
            let share = 0.01 * (k as f64 + std::f64::consts::SQRT_2);
            if let Ok(value) = self.parameter(name) {
                // Different shares, so that nothing cancels.
                copy.put(*place, value + share * (1.0 + value));
            }
        }
        copy
    }

    /// Returns the place of a parameter from its index among all of them.
    fn numbered(&self, mut number: usize) -> CasePlace {
        for (block, own) in self.equations.blocks.iter().enumerate() {
            let mut count = 0;
            let mut wanted = String::new();
            own.constraint.parameters(&mut |name, _| {
                if count == number {
                    wanted = name.to_string();
                }
                count += 1;
            });
            if number < count {
                let index = number;
                let component = self.component(block, &wanted);
                return component.map_or(CasePlace::Parameter { block, index }, |(_, k)| {
                    CasePlace::Component { block, index, k }
                });
            }
            number -= count;
        }
        CasePlace::Parameter { block: usize::MAX, index: 0 }
    }

    /// Writes one number of a case to its place. Returns false if that is impossible.
    pub(crate) fn put(&mut self, place: CasePlace, value: f64) -> bool {
        self.forget();
        match place {
            CasePlace::Parameter { block, index } => self
                .equations
                .blocks
                .get_mut(block)
                .is_some_and(|block| block.constraint.set_parameter_at(index, value)),
            CasePlace::Component { block, index, k } => self.put_numbered(block, index, k, value),
            CasePlace::Coordinate(column) => {
                self.initial[column] = value;
                self.preferred
                    .iter_mut()
                    .filter(|(preferred, _)| *preferred == column)
                    .for_each(|(_, preferred)| *preferred = value);
                true
            }
            CasePlace::Dimension(k) => self.put_dimension(k, value),
        }
    }

    /// Returns an error if numbers that were written to these places are not allowed.
    pub(crate) fn check_put(&self, places: &[CasePlace]) -> Result<()> {
        places.iter().try_for_each(|place| match place {
            CasePlace::Parameter { block, .. } | CasePlace::Component { block, .. } => {
                let block = self.equations.blocks.get(*block);
                block.map_or(Ok(()), |block| {
                    sensible_parameters(&block.name, block.constraint.as_ref())
                })
            }
            CasePlace::Coordinate(_) => Ok(()),
            CasePlace::Dimension(k) => self.check_dimension_as_put(*k),
        })
    }

    /// Returns the constraint, the parameter's name in it, and its value. Names can contain dots.
    pub(super) fn find(&self, name: &str) -> Result<(usize, String, f64)> {
        for (index, block) in self.equations.blocks.iter().enumerate() {
            let Some(wanted) =
                name.strip_prefix(block.name.as_str()).and_then(|rest| rest.strip_prefix('.'))
            else {
                continue;
            };
            let mut found = None;
            block.constraint.parameters(&mut |parameter, value| {
                if parameter == wanted {
                    found = Some(value);
                }
            });
            if let Some(value) = found {
                return Ok((index, wanted.to_string(), value));
            }
        }
        Err(Error::UnknownName {
            what: "parameter",
            name: name.to_string(),
            known: self.near(name),
        })
    }

    /// Returns the parameters of the constraint with which the name begins, otherwise all
    /// parameters.
    fn near(&self, name: &str) -> Vec<String> {
        let named = self.dimensions().into_iter().chain(self.parameters());
        let all: Vec<String> = named.map(|(name, _)| name).collect();
        let constraint = name.split('.').next().unwrap_or_default();
        let own: Vec<String> = all
            .iter()
            .filter(|known| {
                known.strip_prefix(constraint).is_some_and(|rest| rest.starts_with('.'))
            })
            .cloned()
            .collect();
        if own.is_empty() { all } else { own }
    }
}

fn cannot_be_set(name: &str) -> Error {
    Error::UnknownName {
        what: "parameter that can be set",
        name: name.to_string(),
        known: Vec::new(),
    }
}
