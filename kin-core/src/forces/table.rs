//! Returns all forces as columns, and writes them as a table to a file.

use std::io::Write;
use std::path::Path;

use super::calls::Forces;
use super::reaction::{Reaction, Source};
use crate::coordinates::layout::Kind;
use crate::coordinates::{PlanarBody, SpatialBody};
use crate::outcome::error::{Error, Result};
use crate::outcome::motion::Series;
use crate::solve::motion::csv::{as_text, reason, to_file};
use crate::system::System;

/// A force below this share of the largest one counts as zero. \[-\]
const NOTHING: f64 = 1e-9;

impl System {
    /// Returns an error for the first name that is not a measure, a coordinate or a column of
    /// forces ([`Forces::columns`]).
    ///
    /// Call this function before a sweep over many cases. Kin uses the columns at time t. If Kin
    /// cannot compute the forces at time t, it does not check names that may be columns.
    ///
    /// Errors: no measure, coordinate or column has a name ([`Error::UnknownName`], with the
    /// existing names).
    pub fn check_columns(&self, names: &[impl AsRef<str>], t: f64) -> Result<()> {
        let mut known: Vec<String> = self.measures();
        known.extend(self.coordinate_names().iter().cloned());
        let unknown = |known: &[String]| {
            names.iter().map(AsRef::as_ref).find(|name| !known.iter().any(|known| known == name))
        };
        if unknown(&known).is_some() && self.has_forces() {
            let columns = || -> Result<Vec<Series>> { Ok(self.forces(&self.run([t])?)?.columns()) };
            let Ok(columns) = columns() else { return Ok(()) };
            known.extend(columns.iter().map(|column| column.name().to_string()));
        }
        match unknown(&known) {
            None => Ok(()),
            Some(name) => {
                let what = "measure, coordinate or column of forces";
                Err(Error::UnknownName { what, name: name.to_string(), known })
            }
        }
    }
}

impl Forces<'_> {
    /// Returns every unique quantity over time as a column:
    ///
    /// * the effort and power of each driver,
    /// * the components of each constraint on each of its bodies, about its point in global axes
    ///   (`A on crank.F_x`),
    /// * the components and the power of each friction (`A.friction on crank.T`),
    /// * the kinetic and the potential energy.
    ///
    /// The norm constraints of Euler parameters carry no force, so the list has no columns for
    /// them.
    pub fn columns(&self) -> Vec<Series> {
        let mut all = Vec::new();
        for name in self.drives() {
            if let Ok(drive) = self.drive(name) {
                all.extend(drive.efforts().iter().cloned());
                all.push(drive.power().clone());
            }
        }
        for (number, block) in self.system.equations().blocks.iter().enumerate() {
            if block.constraint.facts().kind == "euler_norm" {
                continue;
            }
            let reaction = Reaction::new(self, &block.name, vec![Source::Constraint(number)]);
            all.extend(self.on_bodies(&reaction));
        }
        for rubbing in &self.frictions.all {
            if let Ok(friction) = self.friction(&rubbing.name) {
                all.extend(self.on_bodies(&friction));
                all.push(friction.power());
            }
        }
        all.extend([self.energy().kinetic.clone(), self.energy().potential.clone()]);
        all
    }

    /// Returns the column with this name, such as `motor` or `A on crank.F_x`.
    ///
    /// Errors: no column has the name; the error lists the existing names. A component that is not
    /// unique has no column.
    pub fn named(&self, name: &str) -> Result<Series> {
        let mut all = self.columns();
        if let Some(found) = all.iter().position(|column| column.name() == name) {
            return Ok(all.swap_remove(found));
        }
        let known = all.iter().map(|column| column.name().to_string()).collect();
        Err(Error::UnknownName { what: "column of forces", name: name.to_string(), known })
    }

    /// Returns |F| of each constraint that is not a driver, on its first body (`A on crank.force`).
    ///
    /// The list omits forces that are not unique, and forces that are always zero.
    pub fn magnitudes(&self) -> Vec<Series> {
        let layout = self.system.layout();
        let drives = self.drives();
        let of = |name: &&str| {
            let reaction = self.reaction(name).ok()?;
            let item = *reaction.touched().first()?;
            let mechanism = layout.mechanism;
            let index = Some(item);
            let found = match layout.items[item].kind {
                Kind::Planar => {
                    reaction.on(PlanarBody { mechanism, index }).and_then(|on| on.magnitude())
                }
                _ => reaction.on(SpatialBody { mechanism, index }).and_then(|on| on.magnitude()),
            };
            found.ok()
        };
        let found = self.constraints().into_iter().filter(|name| !drives.contains(name));
        let mut all: Vec<Series> = found.filter_map(|name| of(&name)).collect();
        let largest = all.iter().map(Series::max).fold(0.0, f64::max);
        all.retain(|series| series.max() > NOTHING * largest);
        all
    }

    /// Returns the unique components of a reaction on each of its bodies.
    fn on_bodies(&self, reaction: &Reaction<'_>) -> Vec<Series> {
        let layout = self.system.layout();
        let mut all = Vec::new();
        for item in reaction.touched() {
            let mechanism = layout.mechanism;
            let index = Some(item);
            let components = match layout.items[item].kind {
                Kind::Planar => {
                    reaction.on(PlanarBody { mechanism, index }).map(|on| on.components())
                }
                _ => reaction.on(SpatialBody { mechanism, index }).map(|on| on.components()),
            };
            all.extend(components.unwrap_or_default());
        }
        all
    }

    /// Writes [`Forces::columns`] as a CSV file and creates missing folders.
    ///
    /// The first column is t. Headers have the form `A on crank.F_x [N]`; numbers have 17
    /// significant digits.
    ///
    /// Errors: Kin cannot write the folder or file; the error contains the path.
    pub fn write_csv(&self, path: impl AsRef<Path>) -> Result<()> {
        to_file(path.as_ref(), |to| self.write_csv_to(to))
    }

    /// Writes the table of [`Forces::write_csv`] to a writer, such as standard output.
    ///
    /// Errors: those of the writer.
    pub fn write_csv_to(&self, to: impl Write) -> std::io::Result<()> {
        let columns = self.columns();
        let mut table = csv::Writer::from_writer(to);
        let time = format!("t [{}]", self.motion.unit_words().time());
        let names = columns.iter().map(|column| format!("{} [{}]", column.name(), column.unit()));
        table.write_record(std::iter::once(time).chain(names).map(as_text)).map_err(reason)?;
        for (k, t) in self.motion.times().iter().enumerate() {
            let values = columns.iter().map(|column| column.values()[k]);
            // −0 + 0 is 0, which reads better.
            let row = std::iter::once(*t).chain(values).map(|x| format!("{:.16e}", x + 0.0));
            table.write_record(row).map_err(reason)?;
        }
        table.flush()
    }
}
