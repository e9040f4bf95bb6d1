//! Handles the named dimensions of a system: their values, and the numbers that depend on
//! dimensions.

use std::sync::Arc;

use kin_graph::text::{Binding, Dialect};

use super::parameters::CasePlace;
use super::{PreferredMeasure, System};
use crate::coordinates::layout::Kind;
use crate::dimensions::{Beside, Bound, Dimension, Distribution, Entry, Holder, Hung, Snapshot};
use crate::model::constraint::Constraint;
use crate::model::loads::{Acting, sensible_gravity, sensible_point_mass};
use crate::model::mechanism::SpatialPose;
use crate::model::mechanism::admission::sensible_parameters;
use crate::model::mechanism::place::{between, facing};
use crate::numbers::algebra::Axis;
use crate::numbers::enclosure::Series;
use crate::numbers::real::{Dual64, Real};
use crate::outcome::DimensionError;
use crate::outcome::error::{Error, Result};

/// The dimensions of a system and their values.
#[derive(Clone)]
pub(super) struct Dimensions {
    all: Arc<Snapshot>,
    values: Vec<f64>,
}

/// A dimension with a tolerance.
#[derive(Clone)]
pub(crate) struct Toleranced {
    pub name: String,
    pub unit: String,
    pub tolerance: f64,
    pub distribution: Option<Distribution>,
    pub clearance: Option<String>,
}

/// A number of a constraint that depends on the variable of a derivative.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Moved {
    /// The index of the constraint.
    pub block: usize,
    /// The name of the number in the constraint: a parameter, or one of the nine numbers of an
    /// axis.
    pub name: String,
    /// The derivative of the number by the variable.
    pub slope: f64,
}

impl System {
    /// Returns the names and values of the dimensions in the order of their declaration, including
    /// named expressions.
    pub fn dimensions(&self) -> Vec<(String, f64)> {
        let Some(Dimensions { all, values }) = &self.dimensions else { return Vec::new() };
        all.entries.iter().map(|entry| entry.name.clone()).zip(all.named(values)).collect()
    }

    /// Returns the dimensions with a tolerance. Dimensions of masses and loads alone are omitted,
    /// because they do not change the motion.
    pub(crate) fn toleranced(&self) -> Vec<Toleranced> {
        let Some(Dimensions { all, .. }) = &self.dimensions else { return Vec::new() };
        let moves = |k: usize| all.on(k).any(|number| !all.hung[number].at.is_beside());
        let off = |(k, entry): (usize, &Entry)| {
            let entry = Some(entry).filter(|_| moves(k))?;
            let tolerance =
                entry.tolerance.filter(|tolerance| *tolerance > 0.0 && !entry.is_derived)?;
            Some(Toleranced {
                name: entry.name.clone(),
                unit: entry.unit.clone(),
                tolerance,
                distribution: entry.distribution,
                clearance: entry.clearance.clone(),
            })
        };
        all.entries.iter().enumerate().filter_map(off).collect()
    }

    /// Returns the system with this pose as its guess, without preferences and without guesses that
    /// depend on dimensions.
    pub(crate) fn guessed(&self, q: &[f64]) -> System {
        let mut system = self.clone();
        system.forget();
        system.initial.copy_from_slice(q);
        system.preferred.clear();
        system.asked.clear();
        if let Some(own) = &mut system.dimensions {
            own.all = Arc::new(own.all.without_guesses());
        }
        system
    }

    /// Returns the system with dimensions that deviate by these values, also beyond their ranges.
    /// Returns `None` if a value makes the system invalid.
    pub(crate) fn off<'a>(
        &self,
        by: impl IntoIterator<Item = (&'a String, f64)>,
    ) -> Option<System> {
        let mut system = self.clone();
        for (name, off) in by {
            let k = system.dimension_number(name)?;
            let value = system.dimensions.as_ref()?.values[k] + off;
            let made = system.put_dimension(k, value) && system.check_dimension(k, value).is_ok();
            made.then_some(())?;
        }
        Some(system)
    }

    /// Returns bounds of all numbers that depend on dimensions, with their places. The named
    /// dimensions have these series; the others have their values.
    pub(crate) fn hung_over(&self, names: &[String], all: &[Series]) -> Vec<(Bound, Series)> {
        let Some(Dimensions { all: own, values }) = &self.dimensions else { return Vec::new() };
        let mut series: Vec<Series> = values.iter().map(|x| Series::number(*x)).collect();
        for (name, over) in names.iter().zip(all) {
            if let Some(k) = self.dimension_number(name) {
                series[k] = *over;
            }
        }
        own.hung.iter().map(|hung| hung.at.clone()).zip(own.over(&series)).collect()
    }

    /// Returns the unit of a dimension, or `-` if it has none.
    pub(crate) fn unit_of_dimension(&self, name: &str) -> String {
        let entry = self.dimension_number(name).and_then(|k| self.dimension_entry(k));
        let unit = entry.map(|entry| entry.unit.clone()).filter(|unit| !unit.is_empty());
        unit.unwrap_or_else(|| "-".to_string())
    }

    /// Returns a parameter of a constraint's formula as an expression of dimensions. `named` gives
    /// the texts of dimensions; the others are printed as numbers. Returns `None` if the parameter
    /// is no such expression.
    pub(crate) fn parameter_text(
        &self,
        block: usize,
        index: usize,
        dialect: &dyn Dialect,
        named: &dyn Fn(&str) -> Option<String>,
    ) -> Option<String> {
        let constraint = self.equations.blocks.get(block)?.constraint.as_ref();
        let wanted = constraint
            .formula(|table, _, _| table.formula().parameters.get(index).cloned())
            .flatten()?;
        let Dimensions { all, values } = self.dimensions.as_ref()?;
        let is_wanted = |hung: &&Hung| {
            matches!(&hung.at, Bound::Parameter { of: Holder::Constraint(k), name, .. }
                if *k == block && *name == wanted)
        };
        let node = all.hung.iter().find(is_wanted)?.node;
        all.text(node, dialect, &|k| match named(&all.entries[k].name) {
            Some(text) => text,
            None => dialect.number(values[k]).within(Binding::Atom, dialect.brackets()),
        })
    }

    /// Stores the dimensions of the mechanism from which the system was built.
    pub(crate) fn set_dimensions(&mut self, all: Option<Snapshot>) {
        self.dimensions = all.map(|all| Dimensions { values: all.nominal(), all: Arc::new(all) });
    }

    /// Returns the index of the dimension with this name.
    pub(super) fn dimension_number(&self, name: &str) -> Option<usize> {
        self.dimensions.as_ref()?.all.entries.iter().position(|entry| entry.name == name)
    }

    fn dimension_entry(&self, k: usize) -> Option<&Entry> {
        self.dimensions.as_ref()?.all.entries.get(k)
    }

    /// Returns an error unless a dimension can be set; an expression cannot.
    pub(super) fn settable_dimension(&self, k: usize) -> Result<()> {
        match self.dimension_entry(k) {
            Some(entry) if entry.is_derived => Err(DimensionError::invalid(
                &entry.name,
                "the dimension is an expression of other dimensions. Set the dimensions in the expression instead",
            )),
            _ => Ok(()),
        }
    }

    /// Sets a dimension and all numbers that depend on it. After an error the old value remains.
    pub(super) fn set_dimension(&mut self, k: usize, value: f64) -> Result<()> {
        self.settable_dimension(k)?;
        self.check_range(k, value)?;
        let before = self.clone();
        self.put_dimension(k, value);
        let checked = self.check_dimension(k, value);
        if checked.is_err() {
            *self = before;
        }
        checked
    }

    /// Returns an error if the stored value of a dimension is not allowed.
    pub(super) fn check_dimension_as_put(&self, k: usize) -> Result<()> {
        let value = self.dimensions.as_ref().and_then(|all| all.values.get(k).copied());
        value.map_or(Ok(()), |value| {
            self.check_range(k, value).and_then(|()| self.check_dimension(k, value))
        })
    }

    fn check_range(&self, k: usize, value: f64) -> Result<()> {
        let Some(entry) = self.dimension_entry(k) else { return Ok(()) };
        let fail = |reason: String| Err(DimensionError::invalid(&entry.name, reason));
        if !value.is_finite() {
            return fail(format!("the value is {value}. Give a finite number"));
        }
        match entry.range.filter(|[from, to]| !(*from <= value && value <= *to)) {
            Some([from, to]) => {
                fail(format!("the value {value} is outside the range {from} … {to}"))
            }
            None => Ok(()),
        }
    }

    /// Sets a dimension and all numbers that depend on it, without any check. Returns false if a
    /// number cannot be set.
    pub(super) fn put_dimension(&mut self, k: usize, value: f64) -> bool {
        let Some(Dimensions { all, values }) = &mut self.dimensions else { return false };
        let all = Arc::clone(all);
        values[k] = value;
        let numbers = all.numbers(values);
        self.forget();
        let mut done = true;
        for number in all.on(k) {
            let together = || all.with(number).into_iter().map(|other| numbers[other]);
            let value = numbers[number];
            match &all.hung[number].at {
                Bound::Parameter { of, index, .. } => done &= self.put_in(*of, *index, value),
                Bound::Guess(column) => self.initial[*column] = value,
                Bound::Length(link) => self.lengths[*link].1 = value,
                Bound::Axis { of, name, .. } => {
                    let axis = Axis::given(&together().collect::<Vec<f64>>()).numbers();
                    if let Holder::Constraint(block) = of {
                        self.forget_axis(*block, name);
                    }
                    let Some(constraint) = self.held_mut(*of) else { continue };
                    for (part, value) in axis.into_iter().enumerate() {
                        done &= constraint.set_parameter(&Axis::name_of(name, part), value);
                    }
                }
                Bound::Between { first, .. } => self.place(*first, between(together())),
                Bound::Facing { first, .. } => self.place(*first, facing(together())),
                Bound::Preferred(column) => {
                    done &= self.put(CasePlace::Coordinate(*column), value);
                }
                Bound::PreferredMeasure(name) => self.put_preferred(name, value),
                Bound::Beside { of, name } => {
                    done &= Arc::make_mut(&mut self.loads).put(of, name, value)
                }
            }
        }
        self.links = self.layout.planar(&self.lengths);
        done
    }

    /// Returns the constraint at this place, mutable.
    fn held_mut(&mut self, of: Holder) -> Option<&mut Box<dyn Constraint>> {
        match of {
            Holder::Constraint(k) => {
                self.equations.blocks.get_mut(k).map(|block| &mut block.constraint)
            }
            _ => Arc::make_mut(&mut self.loads).held_mut(of),
        }
    }

    /// Sets parameter `index` of a constraint. Returns false if it cannot be set.
    fn put_in(&mut self, of: Holder, index: usize, value: f64) -> bool {
        match of {
            Holder::Constraint(block) => self.put(CasePlace::Parameter { block, index }, value),
            _ => self
                .held_mut(of)
                .is_some_and(|constraint| constraint.set_parameter_at(index, value)),
        }
    }

    /// Sets the guess of the spatial body whose coordinates begin at `first`.
    fn place(&mut self, first: usize, pose: SpatialPose) {
        let pose = pose.coordinates().map(Dimension::value);
        self.initial[first..first + pose.len()].copy_from_slice(&pose);
    }

    /// Changes the value of a preferred measure.
    fn put_preferred(&mut self, name: &str, value: f64) {
        if let Some(column) = self.coordinate_names().iter().position(|known| known == name) {
            self.put(CasePlace::Coordinate(column), value);
        } else if let Some(place) = self.place_of(name) {
            let own = |asked: &&mut PreferredMeasure| {
                (asked.block, asked.number) == (place.block, place.number)
            };
            self.asked.iter_mut().filter(own).for_each(|asked| asked.value = value);
        }
    }

    /// Returns an error, by name, if a number that depends on a dimension is invalid.
    fn check_dimension(&self, k: usize, value: f64) -> Result<()> {
        let Some(Dimensions { all, values }) = &self.dimensions else { return Ok(()) };
        let name = &all.entries[k].name;
        let numbers = all.numbers(values);
        let invalid = |reason: String| Err(DimensionError::invalid(name, reason));
        for number in all.on(k) {
            let found = numbers[number];
            match &all.hung[number].at {
                Bound::Parameter { of, name: parameter, .. } if !found.is_finite() => {
                    let of = self.held(*of).map_or("", |(of, _)| of);
                    return invalid(format!(
                        "with the value {value} the parameter `{of}.{parameter}` is {found}"
                    ));
                }
                Bound::Length(link) if !(found.is_finite() && found > 0.0) => {
                    let (item, length) = self.lengths[*link];
                    return Err(Error::InvalidLength {
                        link: self.layout.items[item].name.clone(),
                        length,
                    });
                }
                at if at.is_guess() && !found.is_finite() => {
                    return invalid(format!("with the value {value} a guess is {found}"));
                }
                Bound::Facing { first, .. }
                    if self.initial[*first..*first + 7].iter().any(|x| !x.is_finite()) =>
                {
                    return invalid(format!(
                        "with the value {value} the direction of a body is zero"
                    ));
                }
                _ => {}
            }
        }
        all.on(k).try_for_each(|number| match &all.hung[number].at {
            Bound::Parameter { of, .. } | Bound::Axis { of, .. } => self
                .held(*of)
                .map_or(Ok(()), |(of, constraint)| sensible_parameters(of, constraint)),
            Bound::Beside { of, .. } => self
                .sensible_beside(of)
                .or_else(|error| invalid(format!("with the value {value} {error}"))),
            _ => Ok(()),
        })
    }

    /// Returns the name and the constraint at this place.
    fn held(&self, of: Holder) -> Option<(&str, &dyn Constraint)> {
        match of {
            Holder::Constraint(k) => self
                .equations
                .blocks
                .get(k)
                .map(|block| (block.name.as_str(), block.constraint.as_ref())),
            _ => self.loads.held(of),
        }
    }

    /// Returns an error, by name, if the numbers of a mass or load are invalid.
    fn sensible_beside(&self, of: &Beside) -> Result<()> {
        let loads = &self.loads;
        match of {
            Beside::Solid(item) => {
                let own = loads.solids.iter().find(|(known, _)| known == item);
                own.map_or(Ok(()), |(item, solid)| {
                    let item = &self.layout.items[*item];
                    solid.sensible(&item.name, item.kind == Kind::Planar)
                })
            }
            Beside::PointMass(k) => loads
                .points
                .get(*k)
                .map_or(Ok(()), |(name, _, mass)| sensible_point_mass(name, *mass)),
            Beside::Gravity => sensible_gravity(&loads.gravity),
            Beside::OnBody { load, part } => {
                let Some((name, load)) = loads.loads.get(*load) else { return Ok(()) };
                match load.part(*part) {
                    Some(Acting::OnBody(on)) => on.sensible(name),
                    _ => Ok(()),
                }
            }
            Beside::Friction(joint) => {
                let own = loads.frictions.iter().find(|(known, _)| known == joint);
                let block = self.equations.blocks.iter().find(|block| block.name == *joint);
                let (Some((_, friction)), Some(block)) = (own, block) else { return Ok(()) };
                friction.seat_in(joint, block.constraint.as_ref()).map(|_| ())
            }
        }
    }

    /// Returns the constraints with parameters that depend on dimension k.
    pub(super) fn blocks_on(&self, k: usize) -> impl Iterator<Item = usize> {
        let all = self.dimensions.as_ref().map(|own| Arc::clone(&own.all));
        all.into_iter().flat_map(move |all| {
            let on: Vec<usize> = all.on(k).collect();
            let block = |number: usize| match &all.hung[number].at {
                Bound::Parameter { of: Holder::Constraint(k), .. }
                | Bound::Axis { of: Holder::Constraint(k), .. } => Some(*k),
                _ => None,
            };
            on.into_iter().filter_map(block).collect::<Vec<_>>()
        })
    }

    /// Returns the numbers of constraints that depend on the dimension or parameter with this name.
    /// Errors: a named expression, or a name that does not exist.
    pub(crate) fn moving_with(&self, name: &str) -> Result<Vec<Moved>> {
        let (Some(k), Some(Dimensions { all, values })) =
            (self.dimension_number(name), &self.dimensions)
        else {
            let (block, own, _) = self.find(name)?;
            return Ok(self.moved_parameter(block, own));
        };
        self.settable_dimension(k)?;
        let numbers = all.along(values, k);
        let mut moved: Vec<Moved> = Vec::new();
        for number in all.on(k) {
            match &all.hung[number].at {
                Bound::Parameter { of: Holder::Constraint(block), name, .. } => moved.push(Moved {
                    block: *block,
                    name: name.clone(),
                    slope: numbers[number].0.eps,
                }),
                Bound::Axis { of: Holder::Constraint(block), name, .. } => {
                    let together = all.with(number);
                    // Handles the numbers of an axis or a pose once, at the first of them.
                    if all.on(k).find(|other| together.contains(other)) == Some(number) {
                        let given: Vec<Real<Dual64>> =
                            together.iter().map(|other| numbers[*other]).collect();
                        moved.extend(Moved::axis(*block, name, Axis::given(&given)));
                    }
                }
                _ => {}
            }
        }
        Ok(moved)
    }

    /// Returns the numbers that depend on a parameter: the parameter alone, or all numbers of its
    /// axis.
    fn moved_parameter(&self, block: usize, own: String) -> Vec<Moved> {
        let of_axis = self.component(block, &own).and_then(|(axis, k)| {
            let directions = self.directions(block, &axis)?;
            let mut given = directions.map(|x| Real(Dual64::new(x, 0.0)));
            given[k] = Real(Dual64::new(directions[k], 1.0));
            Some(Moved::axis(block, &axis, Axis::given(&given)).collect())
        });
        of_axis.unwrap_or_else(|| vec![Moved { block, name: own, slope: 1.0 }])
    }
}

impl Moved {
    fn axis(block: usize, name: &str, axis: Axis<Real<Dual64>>) -> impl Iterator<Item = Moved> {
        let name = name.to_string();
        (0..).zip(axis.numbers()).map(move |(part, x)| Moved {
            block,
            name: Axis::name_of(&name, part),
            slope: x.0.eps,
        })
    }
}
