//! Creates charts of forces: the efforts of drivers and the forces in joints.

use kin::forces::Forces;
use kin::results::Series;

use super::{Figure, Panel};
use crate::color::PALETTE;

/// Lines of one unit for one chart.
pub(crate) struct Group {
    pub title: &'static str,
    pub label: &'static str,
    pub series: Vec<(String, Series)>,
}

/// Efforts of drives by their units, then the forces of joints; as many in one group as have
/// colours.
pub(crate) fn groups(forces: &Forces<'_>) -> Vec<Group> {
    let drives = forces.drives().into_iter().filter_map(|name| forces.drive(name).ok());
    let efforts: Vec<Series> = drives.flat_map(|drive| drive.efforts().to_vec()).collect();
    let mut units: Vec<&str> = Vec::new();
    for effort in &efforts {
        if !units.contains(&effort.unit()) {
            units.push(effort.unit());
        }
    }
    let of_unit =
        |unit: &&str| efforts.iter().filter(|effort| effort.unit() == *unit).cloned().collect();
    let efforts = units.iter().map(|unit| (["efforts of drives", "effort"], of_unit(unit)));
    let joints = std::iter::once((["forces in joints", "F"], forces.magnitudes()));
    let split = |([title, label], all): ([&'static str; 2], Vec<Series>)| -> Vec<Group> {
        let named = |series: &Series| (short(series.name()).to_string(), series.clone());
        let group =
            |some: &[Series]| Group { title, label, series: some.iter().map(named).collect() };
        all.chunks(PALETTE.len()).map(group).collect()
    };
    efforts.chain(joints).flat_map(split).collect()
}

/// The name of the constraint alone.
fn short(name: &str) -> &str {
    name.rsplit_once(" on ").map_or(name, |(constraint, _)| constraint)
}

impl Figure {
    /// Creates charts of the effort of each driver and of the magnitude of the force in each joint,
    /// over time.
    ///
    /// The charts omit forces that are not unique.
    pub fn of_forces(forces: &Forces<'_>) -> Figure {
        let panel = |group: &Group| {
            let empty = Panel::over_time(group.title, group.label);
            group.series.iter().fold(empty, |panel, (name, series)| panel.series(name, series))
        };
        Figure::new(groups(forces).iter().map(panel))
    }
}
