//! Finds the changes that remove a freedom: a joint, a pin, a driver, a constraint that holds the
//! body, or a longer body.

use std::collections::HashSet;

use super::super::examined::Examined;
use super::super::order;
use super::dimension::{self, Of};
use super::trial::Trial;
use crate::coordinates::layout::{Kind, Place};
use crate::outcome::verdict::{Change, Freedom, How, Persistence, Resize, Size};
use crate::system::evaluate::Block;
use crate::system::scaled::Model;

/// Returns the change for each lasting freedom: a joint for a body that nothing holds, a driver, or
/// something that holds it.
pub(crate) fn for_freedoms(examined: &Examined<'_>, freedoms: &[Freedom]) -> Vec<Change> {
    let mut changes: Vec<Change> = Vec::new();
    let mut known: HashSet<(u8, String)> = HashSet::new();
    let mut moved = vec![0_usize; examined.model().n()];
    for freedom in freedoms {
        let columns = freedom.direction.iter().enumerate().filter(|(_, v)| **v != 0.0);
        columns.for_each(|(column, _)| moved[column] += 1);
    }
    let all = examined.here.free.iter().map(|(column, _)| *column).zip(freedoms);
    for (column, freedom) in all.filter(|(_, freedom)| freedom.persistence == Persistence::Always) {
        let moves: Vec<String> =
            freedom.motions.iter().flat_map(|motion| motion.names.iter().cloned()).collect();
        let owner = examined.model().layout.owner_index(column);
        let is_held = owner.is_some_and(|item| !examined.acting[item].is_empty());
        let (key, change) = match &moves[..] {
            [body] if !is_held => ((0, body.clone()), Change::Join { body: body.clone() }),
            _ if freedom.idle => ((1, format!("{moves:?}")), Change::HoldIdle { bodies: moves }),
            _ => {
                let change = drive(examined, (column, freedom), &moved, moves);
                ((2, format!("{change:?}")), change)
            }
        };
        if known.insert(key) {
            changes.push(change);
        }
    }
    pinned(examined, changes)
}

/// Returns the changes, but a single pin if only two links with one joint each are free: a pin
/// between them is probably missing.
fn pinned(examined: &Examined<'_>, changes: Vec<Change>) -> Vec<Change> {
    let [
        Change::Drive { coordinate: x, moves: a, turn: None },
        Change::Drive { coordinate: y, moves: b, turn: None },
    ] = &changes[..]
    else {
        return changes;
    };
    match (&a[..], &b[..]) {
        ([a], [b]) if a != b && hangs(examined, a) && hangs(examined, b) => {
            let mut bodies = [a.clone(), b.clone()];
            let mut coordinates = [x.clone(), y.clone()];
            if order::natural(&bodies[0], &bodies[1]) == std::cmp::Ordering::Greater {
                bodies.reverse();
                coordinates.reverse();
            }
            vec![Change::Pin { bodies, coordinates }]
        }
        _ => changes,
    }
}

/// Returns true if exactly one constraint acts on a planar body.
fn hangs(examined: &Examined<'_>, name: &str) -> bool {
    let model = examined.model();
    let of_it = |place: Place| matches!(place, Place::Own { item, .. } if model.layout.items[item].name == name);
    let speaks = |block: &&Block| {
        block
            .constraint
            .arguments()
            .iter()
            .any(|argument| model.layout.place(&argument.target).is_some_and(of_it))
    };
    let planar =
        model.layout.items.iter().any(|item| item.name == name && item.kind == Kind::Planar);
    planar && model.equations.blocks.iter().filter(speaks).count() == 1
}

/// Returns the coordinate to drive: the angle of a planar body that rotates, the rotation of a
/// spatial body. `moved` says in how many freedoms each coordinate changes.
fn drive(
    examined: &Examined<'_>,
    (column, freedom): (usize, &Freedom),
    moved: &[usize],
    moves: Vec<String>,
) -> Change {
    let layout = examined.model().layout;
    let item = layout.owner(column);
    let motion = item
        .and_then(|item| freedom.motions.iter().find(|motion| motion.names.contains(&item.name)));
    let turns = motion
        .is_some_and(|motion| matches!(motion.how, How::TurnsAbout { .. } | How::Screws { .. }));
    let mut coordinate = freedom.coordinate.clone();
    let mut turn = None;
    match item.map(|item| (item, item.kind)) {
        Some((item, Kind::Spatial)) if turns => turn = Some(item.name.clone()),
        Some((item, Kind::Planar)) if turns => {
            let theta = item.first + 2;
            let own = freedom.direction.get(theta).is_some_and(|v| *v != 0.0) && moved[theta] == 1;
            if own {
                coordinate.clone_from(&layout.names[theta]);
            }
        }
        _ => {}
    }
    Change::Drive { coordinate, turn, moves }
}

/// Returns, for bodies with a freedom of first order only, slightly larger lengths at which they
/// have none.
pub(crate) fn out_of_line(examined: &Examined<'_>, freedoms: &[Freedom]) -> Option<Change> {
    const LONGER: f64 = 1.05;
    let model = examined.model();
    let stiff = freedoms.iter().filter(|freedom| freedom.persistence == Persistence::Infinitesimal);
    let names: Vec<&String> =
        stiff.flat_map(|freedom| &freedom.motions).flat_map(|motion| &motion.names).collect();
    let mut any = Vec::new();
    for dimension in dimension::all(model) {
        let Of::Length(item) = dimension.of else { continue };
        let body = model.layout.items[item].name.clone();
        let value = vec![LONGER * dimension.value[0]];
        let mut equations = model.equations.clone();
        if !names.contains(&&body) || !dimension.put(&mut equations, &value) {
            continue;
        }
        let trial = Trial {
            model: Model { equations: &equations, ..*model },
            t: examined.t,
            without: &[],
            steps: examined.walk.steps,
        };
        let stands = trial.closed_beside(examined.q).is_some_and(|found| {
            trial.model.rank(&found.place.point.values, &found.measures) == model.n()
        });
        if stands {
            any.push(Resize {
                of: Size::Length { body },
                is: dimension.value,
                fits: value,
                exact: true,
            });
        }
    }
    (!any.is_empty()).then_some(Change::Resize { any })
}
