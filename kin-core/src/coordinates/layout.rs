//! The global coordinates: bodies and scalar coordinates in the order of their declaration, with
//! names and units.

use std::collections::HashSet;

use crate::coordinates::units::{Unit, Units};
use crate::coordinates::{Argument, Coordinate, MechanismId, PlanarBody, SpatialBody, Target};

/// The kinds of declared items.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Planar,
    Spatial,
    Angle,
    Length,
}

impl Kind {
    /// Returns the suffix of the name and the unit of each coordinate.
    pub(crate) fn coordinates(self) -> &'static [(&'static str, Unit)] {
        use Unit::*;
        match self {
            Kind::Planar => &[(".R_x", Metre), (".R_y", Metre), (".theta", Radian)],
            Kind::Spatial => &[
                (".R_x", Metre),
                (".R_y", Metre),
                (".R_z", Metre),
                (".e0", One),
                (".e1", One),
                (".e2", One),
                (".e3", One),
            ],
            Kind::Angle => &[("", Radian)],
            Kind::Length => &[("", Metre)],
        }
    }

    /// Returns the word for an item of this kind.
    pub(crate) fn noun(self) -> &'static str {
        match self {
            Kind::Planar | Kind::Spatial => "body",
            Kind::Angle | Kind::Length => "coordinate",
        }
    }
}

/// The reason why an item cannot be declared.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Undeclared {
    /// The name is empty.
    Empty(Kind),
    /// A body or coordinate has this name already.
    Taken(String),
}

/// A body or a scalar coordinate.
#[derive(Clone, Debug)]
pub(crate) struct Item {
    pub name: String,
    pub kind: Kind,
    /// The index of its first global coordinate.
    pub first: usize,
}

/// The place of a handle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Place {
    /// The global frame, or one of its coordinates, which has this constant value.
    Ground(f64),
    /// The coordinates of an item, from column `first` on.
    Own { item: usize, first: usize },
}

/// All items of one mechanism.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    pub mechanism: MechanismId,
    pub items: Vec<Item>,
    pub names: Vec<String>,
    pub units: Vec<Unit>,
    /// The names of the units.
    pub words: Units,
    /// Links as (item, length between the pins).   \[m\]
    pub links: Vec<(usize, f64)>,
    taken: HashSet<String>,
}

impl Layout {
    pub(crate) fn new(mechanism: MechanismId) -> Self {
        Layout {
            mechanism,
            items: Vec::new(),
            names: Vec::new(),
            units: Vec::new(),
            words: Units::default(),
            links: Vec::new(),
            taken: HashSet::new(),
        }
    }

    /// Returns the lengths of the planar links, from the lengths of all links.
    pub(crate) fn planar(&self, lengths: &[(usize, f64)]) -> Vec<f64> {
        let planar = |(item, _): &&(usize, f64)| self.items[*item].kind == Kind::Planar;
        lengths.iter().filter(planar).map(|(_, length)| *length).collect()
    }

    /// Returns the number of coordinates n.
    pub(crate) fn len(&self) -> usize {
        self.names.len()
    }

    /// Appends an item and returns its index.
    pub(crate) fn declare(&mut self, name: &str, kind: Kind) -> Result<usize, Undeclared> {
        if name.trim().is_empty() {
            return Err(Undeclared::Empty(kind));
        }
        let coordinates = kind.coordinates().iter().map(|(suffix, _)| format!("{name}{suffix}"));
        let fresh: Vec<String> = coordinates.collect();
        if let Some(known) = [name]
            .into_iter()
            .chain(fresh.iter().map(String::as_str))
            .find(|name| self.taken.contains(*name))
        {
            return Err(Undeclared::Taken(known.to_string()));
        }
        self.taken.insert(name.to_string());
        self.taken.extend(fresh.iter().cloned());
        self.items.push(Item { name: name.to_string(), kind, first: self.names.len() });
        self.names.extend(fresh);
        self.units.extend(kind.coordinates().iter().map(|(_, unit)| *unit));
        Ok(self.items.len() - 1)
    }

    /// Returns the bodies with their names.
    pub(crate) fn bodies(&self) -> Vec<(&str, Target)> {
        let mechanism = self.mechanism;
        let bodies = self.items.iter().enumerate().filter_map(|(index, item)| {
            let target = match item.kind {
                Kind::Planar => Target::Planar(PlanarBody { mechanism, index: Some(index) }),
                Kind::Spatial => Target::Spatial(SpatialBody { mechanism, index: Some(index) }),
                Kind::Angle | Kind::Length => return None,
            };
            Some((item.name.as_str(), target))
        });
        bodies.collect()
    }

    /// Returns the handle of a body from the index of its item.
    pub(crate) fn target(&self, item: usize) -> Target {
        let mechanism = self.mechanism;
        let index = Some(item);
        match self.items.get(item).map(|item| item.kind) {
            Some(Kind::Spatial) => Target::Spatial(SpatialBody { mechanism, index }),
            _ => Target::Planar(PlanarBody { mechanism, index }),
        }
    }

    /// Returns the unit of coordinate `column` (`order` 0) or of a derivative of it, with the
    /// mechanism's names.
    pub(crate) fn unit(&self, column: usize, order: usize) -> String {
        self.units.get(column).map(|unit| self.words.text(*unit, order)).unwrap_or_default()
    }

    /// Returns the units of all coordinates.
    pub(crate) fn unit_words(&self) -> Vec<String> {
        (0..self.len()).map(|column| self.unit(column, 0)).collect()
    }

    /// Returns the place of a body or coordinate, or `None` if it belongs to another mechanism.
    pub(crate) fn place(&self, target: &Target) -> Option<Place> {
        match target {
            Target::Planar(body) => self.body(body.mechanism, body.index, Kind::Planar),
            Target::Spatial(body) => self.body(body.mechanism, body.index, Kind::Spatial),
            Target::Coord(coordinate, _) => self.coordinate(coordinate),
        }
    }

    /// Returns the place of a scalar coordinate.
    pub(crate) fn coordinate(&self, coordinate: &Coordinate) -> Option<Place> {
        match *coordinate {
            Coordinate::Own { mechanism, index } => {
                let item = self
                    .items
                    .get(index)
                    .filter(|item| matches!(item.kind, Kind::Angle | Kind::Length))?;
                (mechanism == self.mechanism)
                    .then_some(Place::Own { item: index, first: item.first })
            }
            Coordinate::Planar(body, axis) if axis < 3 => {
                Some(self.body(body.mechanism, body.index, Kind::Planar)?.axis(axis, 0.0))
            }
            Coordinate::Spatial(body, axis) if axis < 7 => Some(
                self.body(body.mechanism, body.index, Kind::Spatial)?
                    .axis(axis, if axis == 3 { 1.0 } else { 0.0 }),
            ),
            _ => None,
        }
    }

    fn body(&self, mechanism: MechanismId, index: Option<usize>, kind: Kind) -> Option<Place> {
        let Some(index) = index else { return Some(Place::Ground(0.0)) };
        let item = self
            .items
            .get(index)
            .filter(|item| item.kind == kind && mechanism == self.mechanism)?;
        Some(Place::Own { item: index, first: item.first })
    }

    /// Returns the coordinates of the columns of an argument; `None` for a column of the ground.
    pub(crate) fn columns(&self, argument: &Argument) -> Vec<Option<usize>> {
        let first = match self.place(&argument.target) {
            Some(Place::Own { first, .. }) => Some(first),
            _ => None,
        };
        (0..argument.target.columns()).map(|k| first.map(|first| first + k)).collect()
    }

    /// Returns the item to which coordinate `column` belongs.
    pub(crate) fn owner(&self, column: usize) -> Option<&Item> {
        self.items.get(self.owner_index(column)?)
    }

    /// Returns the index of the item to which coordinate `column` belongs.
    pub(crate) fn owner_index(&self, column: usize) -> Option<usize> {
        self.items.partition_point(|item| item.first <= column).checked_sub(1)
    }
}

impl Place {
    /// Returns coordinate `axis` of a body at this place; `value` is the coordinate of the ground.
    fn axis(self, axis: usize, value: f64) -> Place {
        match self {
            Place::Ground(_) => Place::Ground(value),
            Place::Own { item, first } => Place::Own { item, first: first + axis },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coordinates::{Ground, any_planar};

    fn three() -> Layout {
        let mut layout = Layout::new(MechanismId(7));
        layout.declare("crank", Kind::Planar).unwrap();
        layout.declare("platform", Kind::Spatial).unwrap();
        layout.declare("theta3", Kind::Angle).unwrap();
        layout
    }

    #[test]
    fn coordinates_come_in_the_order_of_declaration() {
        let layout = three();
        assert_eq!(layout.names[..4], ["crank.R_x", "crank.R_y", "crank.theta", "platform.R_x"]);
        assert_eq!(
            layout.names[6..],
            ["platform.e0", "platform.e1", "platform.e2", "platform.e3", "theta3"]
        );
        assert_eq!(layout.owner(9).unwrap().name, "platform");
        assert_eq!(layout.owner(10).unwrap().name, "theta3");
    }

    #[test]
    fn names_are_unique_and_not_empty() {
        let mut layout = three();
        assert!(matches!(layout.declare("crank", Kind::Length), Err(Undeclared::Taken(_))));
        assert!(matches!(layout.declare("crank.theta", Kind::Angle), Err(Undeclared::Taken(_))));
        assert!(matches!(layout.declare(" ", Kind::Angle), Err(Undeclared::Empty(Kind::Angle))));
        assert_eq!(layout.len(), 11);
    }

    #[test]
    fn only_handles_of_this_mechanism_have_a_place() {
        let layout = three();
        let crank = PlanarBody { mechanism: MechanismId(7), index: Some(0) };
        assert_eq!(layout.place(&Target::Planar(crank)), Some(Place::Own { item: 0, first: 0 }));
        assert_eq!(layout.coordinate(&crank.theta()), Some(Place::Own { item: 0, first: 2 }));
        assert_eq!(layout.place(&Target::Planar(any_planar())), None);
        assert_eq!(
            layout.place(&Target::Planar(PlanarBody { mechanism: MechanismId(8), index: Some(0) })),
            None
        );
        assert_eq!(layout.coordinate(&Coordinate::Planar(crank, 3)), None);
        assert_eq!(layout.coordinate(&PlanarBody::from(Ground).x()), Some(Place::Ground(0.0)));
    }
}
