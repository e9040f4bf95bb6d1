//! The changes that take a freedom away: a joint, a pin, a drive, something that holds the body, or a longer
//! body.

use super::super::examined::Examined;
use super::super::order;
use super::dimension::{self, Of};
use super::trial::Trial;
use crate::model::layout::{Kind, Place};
use crate::model::verdict::{Change, Freedom, How, Persistence, Resize, Size};
use crate::system::evaluate::Block;
use crate::system::scaled::Model;

/// The change for each lasting freedom: a joint for a body that nothing holds, a drive, or something that
/// holds it.
pub(crate) fn for_freedoms(examined: &Examined<'_>, freedoms: &[Freedom]) -> Vec<Change> {
    let mut changes: Vec<Change> = Vec::new();
    for freedom in freedoms.iter().filter(|freedom| freedom.persistence == Persistence::Always) {
        let moves: Vec<String> =
            freedom.motions.iter().flat_map(|motion| motion.names.iter().cloned()).collect();
        let change = match &moves[..] {
            [body] if !is_held(examined, body) => Change::Join { body: body.clone() },
            _ if freedom.idle => Change::HoldIdle { bodies: moves },
            _ => drive(examined, freedom, freedoms, moves),
        };
        if !changes.contains(&change) {
            changes.push(change);
        }
    }
    pinned(examined, changes)
}

/// The same, where two links that hang on one joint each are all that is free: a pin between them is likely
/// to be missing.
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
            let (mut bodies, mut coordinates) = ([a.clone(), b.clone()], [x.clone(), y.clone()]);
            if order::natural(&bodies[0], &bodies[1]) == std::cmp::Ordering::Greater {
                bodies.reverse();
                coordinates.reverse();
            }
            vec![Change::Pin { bodies, coordinates }]
        }
        _ => changes,
    }
}

/// True if exactly one constraint acts on a planar body.
fn hangs(examined: &Examined<'_>, name: &str) -> bool {
    let model = examined.model();
    let of_it =
        |place: Place| matches!(place, Place::Own { item, .. } if model.layout.items[item].name == name);
    let speaks = |block: &&Block| {
        block
            .constraint
            .arguments()
            .iter()
            .any(|argument| model.layout.place(&argument.target).is_some_and(of_it))
    };
    let planar = model.layout.items.iter().any(|item| item.name == name && item.kind == Kind::Planar);
    planar && model.equations.blocks.iter().filter(speaks).count() == 1
}

/// True if any constraint but the norm of its Euler parameters acts on a body or coordinate.
fn is_held(examined: &Examined<'_>, name: &str) -> bool {
    let model = examined.model();
    let of_it =
        |place: Place| matches!(place, Place::Own { item, .. } if model.layout.items[item].name == name);
    let blocks = model.equations.blocks.iter().filter(|block| block.constraint.facts().kind != "euler_norm");
    blocks
        .flat_map(|block| block.constraint.arguments())
        .any(|argument| model.layout.place(&argument.target).is_some_and(of_it))
}

/// The coordinate to drive; where its body turns, its angle, and of a spatial body its turn.
fn drive(examined: &Examined<'_>, freedom: &Freedom, all: &[Freedom], moves: Vec<String>) -> Change {
    let layout = examined.model().layout;
    let column = layout.names.iter().position(|known| *known == freedom.coordinate);
    let item = column.and_then(|column| layout.owner(column));
    let motion =
        item.and_then(|item| freedom.motions.iter().find(|motion| motion.names.contains(&item.name)));
    let turns =
        motion.is_some_and(|motion| matches!(motion.how, How::TurnsAbout { .. } | How::Screws { .. }));
    let (mut coordinate, mut turn) = (freedom.coordinate.clone(), None);
    match item.map(|item| (item, item.kind)) {
        Some((item, Kind::Spatial)) if turns => turn = Some(item.name.clone()),
        Some((item, Kind::Planar)) if turns => {
            let theta = item.first + 2;
            let own = all
                .iter()
                .all(|other| other.coordinate == freedom.coordinate || other.direction[theta] == 0.0);
            if own && freedom.direction[theta] != 0.0 {
                coordinate.clone_from(&layout.names[theta]);
            }
        }
        _ => {}
    }
    Change::Drive { coordinate, turn, moves }
}

/// For bodies that give to first order only: lengths of theirs with which they do not, a little longer than
/// they are.
pub(crate) fn out_of_line(examined: &Examined<'_>, freedoms: &[Freedom]) -> Option<Change> {
    const LONGER: f64 = 1.05;
    let model = examined.model();
    let stiff = freedoms.iter().filter(|freedom| freedom.persistence == Persistence::Infinitesimal);
    let names: Vec<&String> =
        stiff.flat_map(|freedom| &freedom.motions).flat_map(|motion| &motion.names).collect();
    let mut any = Vec::new();
    for dimension in dimension::all(model) {
        let Of::Length(item) = dimension.of else { continue };
        let (body, value) = (model.layout.items[item].name.clone(), vec![LONGER * dimension.value[0]]);
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
        let stands = trial
            .closed_beside(examined.q)
            .is_some_and(|found| trial.model.rank(&found.place.point.values, &found.measures) == model.n());
        if stands {
            any.push(Resize { of: Size::Length { body }, is: dimension.value, fits: value, exact: true });
        }
    }
    (!any.is_empty()).then_some(Change::Resize { any })
}
