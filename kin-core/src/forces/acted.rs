//! Computes force and torque on one body over time, about a point and in given axes.

use std::marker::PhantomData;

use super::calls::Forces;
use super::multipliers::LOOSE;
use super::wrench::{Stand, Wrench};
use crate::model::loads::HasTorque;
use crate::numbers::algebra::Vec3;
use crate::outcome::error::{Error, Result};
use crate::outcome::motion::Series;

/// The force and torque on a body over time, about a point and in axes that you choose.
///
/// The default point is the constraint's point on this body. If the constraint has no point on this
/// body, the default is its point on the other body, or else the origin of this body. On the ground
/// the origin is the global origin. The default axes are the global axes.
///
/// If a component is not unique because equations are redundant, each method that needs the
/// component returns an error with its name.
#[derive(Clone)]
pub struct BodyWrench<'f, V: HasTorque> {
    pub(super) forces: &'f Forces<'f>,
    pub(super) name: String,
    pub(super) on: String,
    pub(super) wrenches: Vec<Wrench>,
    /// The wrenches of the vectors of the null space, at each time.
    pub(super) open: Vec<Vec<Wrench>>,
    pub(super) stands: Vec<Stand>,
    pub(super) points: Vec<Vec3>,
    /// True if components are in the axes of the body.
    pub(super) fixed: bool,
    pub(super) kind: PhantomData<V>,
}

impl<'f, V: HasTorque> BodyWrench<'f, V> {
    /// Moves the torque to another point ū of the body. \[m\]
    ///
    /// The torque changes by the moment of the force. On the ground ū is a global point.
    #[must_use]
    pub fn at(self, u: impl Into<V>) -> Self {
        let u = u.into().lifted();
        let points = self.stands.iter().map(|stand| stand.point(u)).collect();
        self.moved(points)
    }

    /// Moves the torque to a fixed global point. \[m\]
    ///
    /// The torque changes by the moment of the force.
    #[must_use]
    pub fn about(self, point: impl Into<V>) -> Self {
        let points = vec![point.into().lifted(); self.points.len()];
        self.moved(points)
    }

    fn moved(mut self, points: Vec<Vec3>) -> Self {
        for (k, to) in points.iter().enumerate() {
            // The vector between the points, in the axes of the components.
            let way = self.points[k] - *to;
            let way = if self.fixed { self.stands[k].a.transpose() * way } else { way };
            let all = self.open[k].iter_mut().chain([&mut self.wrenches[k]]);
            all.for_each(|wrench| *wrench = wrench.moved(way, Vec3::zeros()));
        }
        self.points = points;
        self
    }

    /// Converts the components from global axes to the axes of the body.
    #[must_use]
    pub fn in_body(mut self) -> Self {
        if std::mem::replace(&mut self.fixed, true) {
            return self;
        }
        for (k, stand) in self.stands.iter().enumerate() {
            self.wrenches[k] = self.wrenches[k].seen_from(stand.a);
            self.open[k].iter_mut().for_each(|open| *open = open.seen_from(stand.a));
        }
        self
    }

    /// Returns the global position, at each time, of the point about which the torque acts. \[m\]
    pub fn points(&self) -> Vec<V> {
        self.points.iter().map(|point| V::vector(*point)).collect()
    }

    /// Returns the force at each time. \[N\]
    ///
    /// Errors: a component is not unique.
    pub fn force(&self) -> Result<Vec<V>> {
        self.all(0..3)?;
        Ok(self.wrenches.iter().map(|wrench| V::vector(wrench.force)).collect())
    }

    /// Returns the torque about the point at each time: a number in the plane, a vector in space.
    /// \[N m\]
    ///
    /// Errors: a component is not unique.
    pub fn torque(&self) -> Result<Vec<V::Torque>> {
        self.all(3..6)?;
        Ok(self.wrenches.iter().map(|wrench| V::torque(wrench.torque)).collect())
    }

    /// Returns the magnitude |F| of the force over time. \[N\]
    ///
    /// Errors: a component is not unique.
    pub fn magnitude(&self) -> Result<Series> {
        self.all(0..3)?;
        Ok(self.series("force", 0, |wrench| wrench.force.norm()))
    }

    /// Returns the magnitude |T| of the torque over time. \[N m\]
    ///
    /// Errors: a component is not unique.
    pub fn torque_magnitude(&self) -> Result<Series> {
        self.all(3..6)?;
        Ok(self.series("torque", 3, |wrench| wrench.torque.norm()))
    }

    /// Returns one component over time, by its name. \[N, N m\]
    ///
    /// The names are `F_x`, `F_y`, `T` in the plane and `F_x`, `F_y`, `F_z`, `T_x`, `T_y`, `T_z` in
    /// space.
    ///
    /// Errors: no component has the name; the component is not unique.
    pub fn component(&self, name: &str) -> Result<Series> {
        let Some((name, number)) = V::COMPONENTS.iter().find(|(known, _)| *known == name) else {
            return Err(Error::UnknownName {
                what: "component",
                name: name.to_string(),
                known: V::COMPONENTS.iter().map(|(name, _)| name.to_string()).collect(),
            });
        };
        self.one(*number)?;
        Ok(self.series(name, *number, |wrench| part(wrench, *number)))
    }

    /// Returns the components that are unique at all times.
    pub fn components(&self) -> Vec<Series> {
        V::COMPONENTS.iter().filter_map(|(name, _)| self.component(name).ok()).collect()
    }

    /// Returns the names of the components that are not unique because equations are redundant.
    ///
    /// At some time of the motion another value of such a component also satisfies all equations of
    /// equilibrium.
    pub fn not_unique(&self) -> Vec<&'static str> {
        let open = |number: usize| self.first_open(number).is_some();
        V::COMPONENTS.iter().filter(|(_, number)| open(*number)).map(|(name, _)| *name).collect()
    }

    /// Returns an error unless these components are unique.
    fn all(&self, numbers: std::ops::Range<usize>) -> Result<()> {
        numbers.into_iter().try_for_each(|number| self.one(number))
    }

    fn one(&self, number: usize) -> Result<()> {
        let Some(k) = self.first_open(number) else { return Ok(()) };
        let name =
            V::COMPONENTS.iter().find(|(_, known)| *known == number).map_or("", |(name, _)| *name);
        let sharing = self.forces.sharing(k, |open| self.is_loose(k, number, open));
        Err(Error::not_unique(&self.name, &format!("{name} on {}", self.on), sharing))
    }

    /// Returns the first time at which one of the six components is not unique.
    fn first_open(&self, number: usize) -> Option<usize> {
        let is_open =
            |k: &usize| (0..self.open[*k].len()).any(|open| self.is_loose(*k, number, open));
        (0..self.open.len()).find(is_open)
    }

    /// Returns true if a vector of the null space at time k changes one of the six components.
    fn is_loose(&self, k: usize, number: usize, open: usize) -> bool {
        let scale = if number < 3 { self.forces.multipliers.beside(k).length } else { 1.0 };
        part(&self.open[k][open], number).abs() * scale > LOOSE
    }

    fn series(&self, name: &str, number: usize, of: impl Fn(&Wrench) -> f64) -> Series {
        let motion = self.forces.motion;
        let units = motion.unit_words();
        let unit = if number < 3 { units.force() } else { units.torque() };
        let on = self.on.replace('`', "");
        let name = format!("{} on {on}.{name}", self.name);
        Series::new(name, unit, motion.clock(), self.wrenches.iter().map(of).collect())
    }
}

/// Returns one of the six components.
fn part(wrench: &Wrench, number: usize) -> f64 {
    wrench.components().get(number).copied().unwrap_or(f64::NAN)
}
