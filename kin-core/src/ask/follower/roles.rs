//! Roles: any measures and coordinates as the given values of a follower, in place of its drivers.

use super::drivers::{Driver, install, values_at};
use super::path::Path;
use super::prescribed::Prescribed;
use super::small::Small;
use super::{Follower, Whole};
use crate::coordinates::layout::{Kind, Layout};
use crate::coordinates::{Coordinate, PlanarBody, SpatialBody};
use crate::joints::drivers::drive;
use crate::linear::{Echelon, RANK, Sparse};
use crate::model::constraint::Constraint;
use crate::outcome::error::{Error, Result};
use crate::outcome::named_value::NamedValue;
use crate::outcome::words::list;
use crate::system::System;

/// A component of a combination below this share of its largest one is rounding. \[-\]
const SHARE: f64 = 1e-6;

/// Something that is given.
enum Role {
    /// A driver of the mechanism, by its number.
    Driver(usize),
    /// A measure or coordinate, as a constraint.
    Other { value: NamedValue, constraint: Box<dyn Constraint>, parameter: &'static str },
}

impl System {
    /// Returns a follower on the branch of the assembled position at time 0 that is moved by other
    /// values than those of the drivers: measures of joints, coordinates, or drivers, by name.
    ///
    /// The drivers that are not named are left out. So the same mechanism answers forward and
    /// inverse. The given values must be as many as the freedoms that are then left, and must
    /// determine the rest. An angle of a joint counts up to whole turns.
    ///
    /// Errors: those of [`System::follower`]; an unknown name, with the known ones; a name twice;
    /// too many or too few names; names that depend on one another, with these names.
    pub fn follower_given<N: AsRef<str>>(
        &self,
        names: impl IntoIterator<Item = N>,
    ) -> Result<Follower> {
        self.follower(0.0)?.given(names)
    }
}

impl Follower {
    /// Returns a follower at the same configuration that is moved by other values, as
    /// [`System::follower_given`] does. This follower does not move.
    ///
    /// Errors: those of [`System::follower_given`].
    pub fn given<N: AsRef<str>>(&self, names: impl IntoIterator<Item = N>) -> Result<Follower> {
        let whole = self.whole_here();
        let names: Vec<String> = names.into_iter().map(|name| name.as_ref().to_string()).collect();
        if let Some(k) = (1..names.len()).find(|k| names[..*k].contains(&names[*k])) {
            return Err(Error::DuplicateName { what: "given values", name: names[k].clone() });
        }
        let roles: Vec<Role> = names
            .iter()
            .map(|name| role(&whole, (self.t0, &self.q), name))
            .collect::<Result<_>>()?;
        let out = left_out(&whole, &roles)?;
        let mut drivers = Vec::new();
        let mut others = Vec::new();
        for role in roles {
            match role {
                Role::Driver(k) => drivers.push(whole.drivers[k].clone()),
                Role::Other { value, constraint, parameter } => {
                    others.push((value.name.clone(), constraint));
                    let path = Path::at(value.value);
                    let parameter = parameter.into();
                    drivers.push(Driver { block: usize::MAX, parameter, value, path });
                }
            }
        }
        let count = others.len();
        let mut system = whole.system.with_others(&out, others);
        system.set_initial(&self.q)?;
        place_blocks(&mut drivers, &out, count, &whole.system);
        install(&mut drivers, &mut system);
        check(&system, &self.q, &drivers)?;
        Ok(Follower {
            system,
            options: self.options.clone(),
            t0: self.t0,
            drivers,
            frozen: self.frozen.clone(),
            q: self.q.clone(),
            regular: None,
            whole: Some(Box::new(whole)),
            small: Small::default(),
        })
    }

    /// Returns the mechanism with all of its drivers, at rest at the values that they have here.
    pub(super) fn whole_here(&self) -> Whole {
        match &self.whole {
            Some(whole) => (**whole).clone(),
            None => Whole::of(&self.system, &self.drivers),
        }
    }

    /// Notes the values of the drivers that are left out, after a move.
    pub(super) fn follow_left_out(&mut self) {
        if let Some(Whole { system, drivers }) = self.whole.as_deref_mut() {
            values_at(drivers, system, &self.q);
        }
    }
}

/// Returns what a name means.
fn role(whole: &Whole, (t0, q): (f64, &[f64]), name: &str) -> Result<Role> {
    let system = &whole.system;
    if let Some(k) = whole.drivers.iter().position(|driver| driver.value.name == name) {
        return Ok(Role::Driver(k));
    }
    let layout = system.layout();
    if let Some(place) = system.place_of(name) {
        let block = &system.equations().blocks[place.block];
        let still = vec![0.0; q.len()];
        let [value, ..] =
            system.equations().measure(block, place.number, t0, [q, &still, &still, &[]]);
        if !value.is_finite() {
            return Err(Error::OutputNotFinite {
                output: name.to_string(),
                t: t0,
                units: layout.words.clone(),
                value,
            });
        }
        let unit = Some(layout.words.in_own_words(place.measured.unit).to_string());
        let joint = block.constraint.clone();
        let constraint = Box::new(Prescribed::new(joint, place.number, place.measured));
        let value = NamedValue { name: name.to_string(), unit, value };
        return Ok(Role::Other { value, constraint, parameter: super::prescribed::LAW });
    }
    if let Some(column) = layout.names.iter().position(|known| known == name)
        && let Some(coordinate) = coordinate(layout, column)
    {
        let constraint = Box::new(drive(coordinate, crate::Law::constant(0.0)));
        let unit = Some(layout.unit(column, 0));
        let value = NamedValue { name: name.to_string(), unit, value: q[column] };
        return Ok(Role::Other { value, constraint, parameter: "law" });
    }
    let drivers = whole.drivers.iter().map(|driver| driver.value.name.clone());
    let known = drivers.chain(system.measures()).chain(layout.names.iter().cloned()).collect();
    Err(Error::UnknownName { what: "driver, measure or coordinate", name: name.to_string(), known })
}

/// Returns the coordinate of a column.
fn coordinate(layout: &Layout, column: usize) -> Option<Coordinate> {
    let index = layout.owner_index(column)?;
    let item = &layout.items[index];
    let axis = column - item.first;
    let mechanism = layout.mechanism;
    Some(match item.kind {
        Kind::Planar => Coordinate::Planar(PlanarBody { mechanism, index: Some(index) }, axis),
        Kind::Spatial => Coordinate::Spatial(SpatialBody { mechanism, index: Some(index) }, axis),
        Kind::Angle | Kind::Length => Coordinate::Own { mechanism, index },
    })
}

/// Returns the constraints of the drivers that are not given.
///
/// Errors: of several laws of one constraint some are given and others are not.
fn left_out(whole: &Whole, roles: &[Role]) -> Result<Vec<usize>> {
    let is_given =
        |k: usize| roles.iter().any(|role| matches!(role, Role::Driver(own) if *own == k));
    let given: Vec<usize> =
        (0..whole.drivers.len()).filter(|k| is_given(*k)).map(|k| whole.drivers[k].block).collect();
    let mut out = Vec::new();
    for (k, driver) in whole.drivers.iter().enumerate().filter(|(k, _)| !is_given(*k)) {
        if given.contains(&driver.block) {
            return Err(Error::InvalidOptions {
                reason: format!(
                    "`{}` is not given, but another law of the same constraint is. Give all laws \
                     of a constraint, or none",
                    whole.drivers[k].value.name
                ),
            });
        }
        out.push(driver.block);
    }
    out.dedup();
    Ok(out)
}

/// Sets the constraint of each driver in a system without the constraints `out`, and with `count`
/// others in place of the first one.
fn place_blocks(drivers: &mut [Driver], out: &[usize], count: usize, whole: &System) {
    let blocks = &whole.equations().blocks;
    let norm = blocks.iter().position(|block| block.constraint.facts().kind == "euler_norm");
    let first = out.iter().min().copied().or(norm).unwrap_or(blocks.len());
    let before = out.iter().filter(|k| **k < first).count();
    let mut next = first - before;
    for driver in drivers {
        if driver.block == usize::MAX {
            driver.block = next;
            next += 1;
            continue;
        }
        let gone = out.iter().filter(|k| **k < driver.block).count();
        let added = if driver.block >= first { count } else { 0 };
        driver.block = driver.block - gone + added;
    }
}

/// Returns the constraints of these drivers, each once.
fn blocks(drivers: &[Driver]) -> Vec<usize> {
    let mut all: Vec<usize> = drivers.iter().map(|driver| driver.block).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Checks that the given values are as many as the freedoms of the rest, and fix them.
fn check(system: &System, q: &[f64], drivers: &[Driver]) -> Result<()> {
    let model = system.model();
    let point = model.linearize(q, 0.0).map_err(|bad| model.not_finite(bad, q, 0.0))?;
    let measures = model.measure(q, 0.0);
    let rows: Vec<usize> = blocks(drivers)
        .into_iter()
        .flat_map(|block| system.equations().blocks[block].rows())
        .collect();
    let n = model.n();
    let all = model.scaled(&point.values, &measures, &|_| true);
    let rest: Vec<Sparse> =
        (0..all.len()).filter(|k| !rows.contains(k)).map(|k| all[k].clone()).collect();
    let free = Echelon::new(rest, n, RANK);
    let freedoms = n - free.rank();
    let names =
        || list(&drivers.iter().map(|driver| driver.value.name.clone()).collect::<Vec<_>>());
    let fail = |reason: String| Err(Error::InvalidOptions { reason });
    if rows.len() != freedoms {
        let mut movable: Vec<String> = Vec::new();
        for (column, _) in free.null_space().into_iter().flatten() {
            let name = system.layout().owner(column).map(|item| item.name.clone());
            movable.extend(name.filter(|name| !movable.contains(name)));
        }
        return fail(format!(
            "{} {} given, but without the other drivers {} has {freedoms} freedom{}: {} can move. \
             Give as many values as there are freedoms",
            names(),
            if drivers.len() == 1 { "is" } else { "are" },
            system.name(),
            if freedoms == 1 { "" } else { "s" },
            list(&movable),
        ));
    }
    let whole = Echelon::new(all, n, RANK);
    if whole.rank() == n {
        return Ok(());
    }
    let dependent =
        dependent(system, drivers, &free.null_space(), (&point.values, &measures.sizes));
    fail(format!(
        "the given values do not fix the rest: {} depend{} on one another at this position. Give \
         other values",
        list(&dependent),
        if dependent.len() == 1 { "s" } else { "" },
    ))
}

/// Returns the names of the drivers whose rows depend on one another along the freedoms of the
/// rest.
fn dependent(
    system: &System,
    drivers: &[Driver],
    freedoms: &[Sparse],
    (values, sizes): (&[f64], &[f64]),
) -> Vec<String> {
    let model = system.model();
    let mut rows: Vec<(usize, Vec<f64>)> = Vec::new();
    for block in blocks(drivers) {
        for row in system.equations().blocks[block].rows() {
            let own: Vec<(usize, f64)> = model
                .entries(values)
                .filter(|(known, _, _)| *known == row)
                .map(|(_, column, value)| (column, value * sizes[column]))
                .collect();
            let slope = |freedom: &Sparse| -> f64 {
                let along = |column: usize| freedom.iter().find(|(known, _)| *known == column);
                own.iter().map(|(column, value)| value * along(*column).map_or(0.0, |x| x.1)).sum()
            };
            rows.push((block, freedoms.iter().map(slope).collect()));
        }
    }
    let size = |row: &[f64]| row.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let scaled = rows.iter().map(|(_, row)| {
        let size = size(row).max(RANK);
        row.iter().enumerate().map(|(k, x)| (k, x / size)).collect::<Sparse>()
    });
    let found = Echelon::new(scaled.collect(), freedoms.len(), RANK);
    let mut blocks: Vec<usize> = Vec::new();
    for combination in found.left_null_space() {
        let largest = combination.iter().fold(0.0_f64, |m, (_, x)| m.max(x.abs()));
        let own = combination.iter().filter(|(_, x)| x.abs() > SHARE * largest);
        blocks.extend(own.map(|(row, _)| rows[*row].0));
    }
    let own = drivers.iter().filter(|driver| blocks.contains(&driver.block));
    own.map(|driver| driver.value.name.clone()).collect()
}
