//! The map from given values to wanted ones: values, slopes and efforts, both ways.

use nalgebra::{DMatrix, DVector};

use super::drivers::{Driver, Laws, laws_at, least_squares, values_at};
use super::{Follower, Whole};
use crate::outcome::error::{Error, Result};
use crate::outcome::named_value::NamedValue;
use crate::system::System;
use crate::system::measures::MeasurePlace;

/// The map from some values of a mechanism to others, on one branch: from motor angles to the
/// angles of an ankle, or back.
///
/// Given and wanted values are drivers, measures of joints and coordinates, by name. The
/// given values are those of [`System::follower_given`]; the wanted values are any number of any.
/// [`Map::to`] moves along the branch, as a follower does, so the map stays on its branch.
///
/// ```
/// use kin::prelude::*;
///
/// # fn main() -> kin::Result<()> {
/// let mut m = Mechanism::new("slider-crank");
/// let crank = m.link("crank", 1.0)?;
/// let rod = m.link("rod", 2.0)?;
/// let slider = m.planar("slider", pose(2.5, 0.0, 0.0))?;
/// m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
/// m.add("A", revolute(crank, rod, crank.end(), rod.start()))?;
/// m.add("B", revolute(rod, slider, rod.end(), vec2(0.0, 0.0)))?;
/// let (zero, up) = (vec2(0.0, 0.0), vec2(0.0, 1.0));
/// m.add("guide", prismatic(slider, Ground, zero, zero, up, 0.0))?;
/// m.add("motor", drive_angle(crank, Law::constant(1.0)))?;
/// let system = m.build()?;
///
/// let mut map = system.map(["motor"], ["slider.R_x"])?;
/// let here = map.to([("motor", 1.2)])?;
/// // A force of 10 N on the slider is held by this torque of the motor.
/// let torque = here.efforts([("slider.R_x", 10.0)])?;
/// assert!((torque[0].value - 10.0 * here.jacobian()[(0, 0)]).abs() < 1e-12);
/// // The same the other way round: where is the motor for this slider?
/// let back = map.inverse()?.here()?;
/// assert!((back.wanted()[0].value - 1.2).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Map {
    follower: Follower,
    /// The mechanism with all of its drivers, for the values of drivers that are wanted.
    whole: Whole,
    wanted: Vec<Wanted>,
}

/// Something that is wanted.
#[derive(Clone, Debug)]
struct Wanted {
    /// Name, unit and last value.
    value: NamedValue,
    what: What,
}

#[derive(Clone, Copy, Debug)]
enum What {
    Coordinate(usize),
    Measure(MeasurePlace),
    /// A driver, by its number among all.
    Driver(usize),
}

/// The values of a map at one configuration, and their slopes.
#[derive(Clone, Debug)]
pub struct Mapped {
    given: Vec<NamedValue>,
    wanted: Vec<NamedValue>,
    jacobian: DMatrix<f64>,
}

impl System {
    /// Returns the map from given values to wanted ones, on the branch of the assembled position at
    /// time 0.
    ///
    /// Errors: those of [`System::follower_given`]; an unknown name among the wanted ones.
    pub fn map<G: AsRef<str>, W: AsRef<str>>(
        &self,
        given: impl IntoIterator<Item = G>,
        wanted: impl IntoIterator<Item = W>,
    ) -> Result<Map> {
        self.follower(0.0)?.map(given, wanted)
    }
}

impl Follower {
    /// Returns the map from given values to wanted ones, on the branch of the configuration where
    /// the follower is, as [`System::map`] does. The follower does not move.
    ///
    /// Errors: those of [`System::map`].
    pub fn map<G: AsRef<str>, W: AsRef<str>>(
        &self,
        given: impl IntoIterator<Item = G>,
        wanted: impl IntoIterator<Item = W>,
    ) -> Result<Map> {
        let follower = self.given(given)?;
        let whole = self.whole_here();
        let wanted = wanted.into_iter().map(|name| named(&follower, &whole, name.as_ref()));
        let wanted = wanted.collect::<Result<_>>()?;
        let mut map = Map { follower, whole, wanted };
        map.follow()?;
        Ok(map)
    }
}

impl Map {
    /// Moves the given values, along the straight line from where they are, and returns the map
    /// there.
    ///
    /// Errors: those of [`Follower::to`]; a position where the given values do not fix the wanted
    /// ones.
    pub fn to(
        &mut self,
        values: impl IntoIterator<Item = (impl AsRef<str>, f64)>,
    ) -> Result<Mapped> {
        let moved = self.follower.to(values).map(|_| ());
        self.follow()?;
        moved?;
        self.here()
    }

    /// Returns the map at the present configuration: given values, wanted values and J = ∂wanted /
    /// ∂given.
    ///
    /// Errors: the position is singular for the given values.
    pub fn here(&self) -> Result<Mapped> {
        let count = self.follower.drivers.len();
        let mut jacobian = DMatrix::zeros(self.wanted.len(), count);
        let mut own = self.clone();
        for k in 0..count {
            let mut along = vec![0.0; count];
            along[k] = 1.0;
            let [slopes, _] = own.along(&along)?;
            jacobian.set_column(k, &DVector::from_vec(slopes));
        }
        let wanted = self.wanted.iter().map(|one| one.value.clone()).collect();
        Ok(Mapped { given: self.follower.drivers(), wanted, jacobian })
    }

    /// Returns the follower that moves the given values.
    pub fn follower(&self) -> &Follower {
        &self.follower
    }

    /// Returns the map the other way round, at the same configuration: what was wanted is given.
    ///
    /// Errors: those of [`System::follower_given`], if the wanted values do not fix the rest.
    pub fn inverse(&self) -> Result<Map> {
        let names = |all: Vec<NamedValue>| all.into_iter().map(|one| one.name);
        let wanted: Vec<NamedValue> = self.wanted.iter().map(|one| one.value.clone()).collect();
        self.follower.map(names(wanted), names(self.follower.drivers()))
    }

    /// Returns J̇, the rate of the slopes while the given values move at these rates. It has a row
    /// for each wanted value and a column for each given one. The other given values are at rest.
    ///
    /// Errors: an unknown name; a rate that is not finite; a singular position.
    pub fn jacobian_rate(
        &self,
        rates: impl IntoIterator<Item = (impl AsRef<str>, f64)>,
    ) -> Result<DMatrix<f64>> {
        let mut own = self.clone();
        let count = own.follower.drivers.len();
        let mut velocity = vec![0.0; count];
        for (name, rate) in rates {
            let k = own.follower.number(name.as_ref())?;
            own.follower.check_finite(name.as_ref(), "velocity", rate)?;
            velocity[k] = rate;
        }
        let mut found = DMatrix::zeros(own.wanted.len(), count);
        let size = velocity.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        if size == 0.0 {
            return Ok(found);
        }
        // The second derivative along a direction is a quadratic form; its mixed terms follow from
        // sums and differences of two directions.
        for k in 0..count {
            let mut both = || -> Result<[Vec<f64>; 2]> {
                let mut ahead = velocity.iter().map(|x| x / size).collect::<Vec<_>>();
                ahead[k] += 1.0;
                let [_, sum] = own.along(&ahead)?;
                ahead[k] -= 2.0;
                let [_, difference] = own.along(&ahead)?;
                Ok([sum, difference])
            };
            let [sum, difference] = both()?;
            for row in 0..found.nrows() {
                found[(row, k)] = 0.25 * size * (sum[row] - difference[row]);
            }
        }
        Ok(found)
    }

    /// Returns the map along the border of these ranges of the given values, as so many
    /// configurations for each side: limits of the given values, drawn in the space of the wanted
    /// ones. One given value has one side, from one end of its range to the other. Two given values
    /// have four sides, which return to the first corner. The map itself does not move.
    ///
    /// Errors: not one range for each given value; more than two given values; fewer than two
    /// points; those of [`Map::to`], such as a toggle on the border.
    pub fn border(
        &self,
        ranges: impl IntoIterator<Item = (impl AsRef<str>, [f64; 2])>,
        points: usize,
    ) -> Result<Vec<Mapped>> {
        let count = self.follower.drivers.len();
        let mut all = vec![None; count];
        for (name, range) in ranges {
            all[self.follower.number(name.as_ref())?] = Some(range);
        }
        let fail = |reason: String| Err(Error::InvalidOptions { reason });
        if points < 2 {
            return fail(format!("a side has at least 2 points, not {points}. Request more"));
        }
        if let Some(k) = all.iter().position(Option::is_none) {
            let name = &self.follower.drivers[k].value.name;
            return fail(format!("`{name}` has no range. Give a range for each given value"));
        }
        let ranges: Vec<[f64; 2]> = all.into_iter().flatten().collect();
        let corners: Vec<Vec<f64>> = match ranges[..] {
            [[from, to]] => vec![vec![from], vec![to]],
            [[a, b], [c, d]] => {
                [[a, c], [b, c], [b, d], [a, d], [a, c]].map(|corner| corner.to_vec()).to_vec()
            }
            _ => {
                return fail(format!(
                    "a border has one or two given values, not {count}. Hold the others with \
                     drivers"
                ));
            }
        };
        let names: Vec<String> = self.follower.drivers().into_iter().map(|one| one.name).collect();
        let mut own = self.clone();
        let mut found = Vec::new();
        for side in corners.windows(2) {
            for k in 0..points {
                let share = k as f64 / (points - 1) as f64;
                let at = |(from, to): (&f64, &f64)| (1.0 - share) * from + share * to;
                let values = side[0].iter().zip(&side[1]).map(at);
                found.push(own.to(names.iter().zip(values))?);
            }
        }
        Ok(found)
    }

    /// Reads the wanted values where the follower is.
    fn follow(&mut self) -> Result<()> {
        values_at(&mut self.whole.drivers, &self.whole.system, &self.follower.q);
        let q = &self.follower.q;
        let still = vec![0.0; q.len()];
        for one in &mut self.wanted {
            let value = match one.what {
                What::Coordinate(column) => q[column],
                What::Measure(place) => {
                    let [value, ..] = measured(&self.follower.system, place, [q, &still, &still]);
                    let turn = std::f64::consts::TAU;
                    let turns = ((one.value.value - value) / turn).round();
                    if place.measured.turns { value + turn * turns } else { value }
                }
                What::Driver(k) => self.whole.drivers[k].value.value,
            };
            if !value.is_finite() {
                return Err(Error::OutputNotFinite {
                    output: one.value.name.clone(),
                    t: self.follower.t0,
                    units: self.follower.system.unit_words().clone(),
                    value,
                });
            }
            one.value.value = value;
        }
        Ok(())
    }

    /// Returns the first and second derivatives of the wanted values while the given ones move at
    /// these constant rates.
    fn along(&mut self, rates: &[f64]) -> Result<[Vec<f64>; 2]> {
        let Follower { system, drivers, q, .. } = &mut self.follower;
        for (driver, rate) in drivers.iter().zip(rates) {
            driver.run(*rate);
        }
        let qd = system.velocity(q, 0.0)?;
        let qdd = system.acceleration(q, &qd, 0.0)?;
        let orders: [&[f64]; 3] = [q, &qd, &qdd];
        let mut led: Vec<Option<[f64; 2]>> = vec![None; self.whole.drivers.len()];
        let mut found = [Vec::new(), Vec::new()];
        for one in &self.wanted {
            let [first, second] = match one.what {
                What::Coordinate(column) => [qd[column], qdd[column]],
                What::Measure(place) => {
                    let [_, first, second] = measured(system, place, orders);
                    [first, second]
                }
                What::Driver(k) => {
                    if led[k].is_none() {
                        lead(&self.whole, k, orders, &mut led)?;
                    }
                    led[k].unwrap_or([f64::NAN; 2])
                }
            };
            found[0].push(first);
            found[1].push(second);
        }
        for (values, order) in found.iter().zip(["velocity", "acceleration"]) {
            for (one, value) in self.wanted.iter().zip(values) {
                self.follower.check_finite(&one.value.name, order, *value)?;
            }
        }
        Ok(found)
    }
}

impl Mapped {
    /// Returns the given values.
    pub fn given(&self) -> &[NamedValue] {
        &self.given
    }

    /// Returns the wanted values.
    pub fn wanted(&self) -> &[NamedValue] {
        &self.wanted
    }

    /// Returns J = ∂wanted / ∂given: a row for each wanted value, a column for each given one.
    pub fn jacobian(&self) -> &DMatrix<f64> {
        &self.jacobian
    }

    /// Returns the velocities of the wanted values, J u̇, for these velocities of the given ones.
    /// The other given values are at rest.
    ///
    /// Errors: an unknown name; a velocity that is not finite.
    pub fn velocities(
        &self,
        given: impl IntoIterator<Item = (impl AsRef<str>, f64)>,
    ) -> Result<Vec<NamedValue>> {
        let rates = numbers(&self.given, "given value", given)?;
        Ok(with_values(&self.wanted, &self.jacobian * rates))
    }

    /// Returns the efforts of the given values that do the same virtual work as these efforts of
    /// the wanted ones: Jᵀ τ. The power on both sides is the same. An effort is a torque if its
    /// value is an angle, and a force if it is a length, positive in the direction in which the
    /// value grows. The other wanted values have no effort.
    ///
    /// Errors: an unknown name; an effort that is not finite.
    pub fn efforts(
        &self,
        wanted: impl IntoIterator<Item = (impl AsRef<str>, f64)>,
    ) -> Result<Vec<NamedValue>> {
        let efforts = numbers(&self.wanted, "wanted value", wanted)?;
        Ok(with_values(&self.given, self.jacobian.transpose() * efforts))
    }
}

/// Returns the given numbers in the order of these names, and zero for the others.
fn numbers(
    known: &[NamedValue],
    what: &'static str,
    given: impl IntoIterator<Item = (impl AsRef<str>, f64)>,
) -> Result<DVector<f64>> {
    let mut found = DVector::zeros(known.len());
    for (name, value) in given {
        let name = name.as_ref().to_string();
        let Some(k) = known.iter().position(|one| one.name == name) else {
            let known = known.iter().map(|one| one.name.clone()).collect();
            return Err(Error::UnknownName { what, name, known });
        };
        if !value.is_finite() {
            let coordinate = "the number for it".to_string();
            return Err(Error::InitialNotFinite { name, coordinate, value });
        }
        found[k] = value;
    }
    Ok(found)
}

/// Returns these numbers with the names. Their units are not those of the values.
fn with_values(names: &[NamedValue], values: DVector<f64>) -> Vec<NamedValue> {
    let named = |(one, value): (&NamedValue, &f64)| NamedValue {
        name: one.name.clone(),
        unit: None,
        value: *value,
    };
    names.iter().zip(values.iter()).map(named).collect()
}

/// Returns what a wanted name means.
fn named(follower: &Follower, whole: &Whole, name: &str) -> Result<Wanted> {
    let system = &follower.system;
    let layout = system.layout();
    let wanted = |what: What, unit: Option<String>, value: f64| {
        Ok(Wanted { value: NamedValue { name: name.to_string(), unit, value }, what })
    };
    if let Some(k) = whole.drivers.iter().position(|driver| driver.value.name == name) {
        let NamedValue { unit, value, .. } = whole.drivers[k].value.clone();
        return wanted(What::Driver(k), unit, value);
    }
    if let Some(place) = system.place_of(name) {
        let unit = layout.words.in_own_words(place.measured.unit).to_string();
        return wanted(What::Measure(place), Some(unit), 0.0);
    }
    if let Some(column) = layout.names.iter().position(|known| known == name) {
        return wanted(What::Coordinate(column), Some(layout.unit(column, 0)), 0.0);
    }
    let drivers = whole.drivers.iter().map(|driver| driver.value.name.clone());
    let known = drivers.chain(system.measures()).chain(layout.names.iter().cloned()).collect();
    let what = "driver, measure or coordinate";
    Err(Error::UnknownName { what, name: name.to_string(), known })
}

/// Returns a measure and its first two derivatives along q̇ and q̈ while time stands still.
fn measured(system: &System, place: MeasurePlace, [q, qd, qdd]: [&[f64]; 3]) -> [f64; 3] {
    let equations = system.equations();
    let block = &equations.blocks[place.block];
    let at =
        |qd: &[f64], qdd: &[f64]| equations.measure(block, place.number, 0.0, [q, qd, qdd, &[]]);
    let [value, first, second, _] = at(qd, qdd);
    if !block.drives && !block.constraint.facts().dependence.c_on_t {
        return [value, first, second];
    }
    let still = vec![0.0; q.len()];
    let back: Vec<f64> = qd.iter().map(|x| -x).collect();
    let [_, by_time, by_time_twice, _] = at(&still, &still);
    let [_, _, reverse, _] = at(&back, qdd);
    [value, first - by_time, 0.5 * (second + reverse) - by_time_twice]
}

/// Computes u̇ and ü of all laws of the constraint of driver k along a motion.
fn lead(
    whole: &Whole,
    k: usize,
    [q, qd, qdd]: [&[f64]; 3],
    led: &mut [Option<[f64; 2]>],
) -> Result<()> {
    let block = whole.drivers[k].block;
    let own: Vec<usize> =
        (0..whole.drivers.len()).filter(|j| whole.drivers[*j].block == block).collect();
    let laws: Vec<(&str, f64)> = own
        .iter()
        .map(|j| (whole.drivers[*j].parameter.as_str(), whole.drivers[*j].value.value))
        .collect();
    let singular = |system: &System| system.singular(0.0, q, None);
    let Some(Laws { values, c_u }) = laws_at(&whole.system, block, &laws, q) else {
        return Err(singular(&whole.system));
    };
    let run = |drivers: &[Driver], rates: &[f64]| {
        for ((j, value), rate) in own.iter().zip(&values).zip(rates) {
            drivers[*j].path.lead([*value, *rate, 0.0]);
        }
    };
    let Whole { system, drivers } = whole;
    run(drivers, &vec![0.0; own.len()]);
    let rows = system.equations().blocks[block].rows();
    let model = system.model();
    let point = model.linearize(q, 0.0).map_err(|bad| model.not_finite(bad, q, 0.0))?;
    let along = |rates: &[f64]| {
        let mut found = DVector::zeros(rows.len());
        for (row, column, value) in model.entries(&point.values) {
            if rows.contains(&row) {
                found[row - rows.start] += value * rates[column];
            }
        }
        found
    };
    let [first, last] = [along(qd), along(qdd)];
    let Some(velocity) = least_squares(&c_u, &-first) else { return Err(singular(system)) };
    run(drivers, velocity.as_slice());
    let model = system.model();
    let bend = model.second_order(q, 0.0, qd, 1.0).map_err(|bad| model.not_finite(bad, q, 0.0))?;
    let bend = DVector::from_column_slice(&bend[rows]);
    let Some(acceleration) = least_squares(&c_u, &(bend - last)) else {
        return Err(singular(system));
    };
    for (row, j) in own.iter().enumerate() {
        led[*j] = Some([velocity[row], acceleration[row]]);
    }
    Ok(())
}
