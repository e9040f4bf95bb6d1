//! The freedoms that are left: which bodies move, and how.

use crate::model::verdict::{BodyMotion, Freedom, How, Persistence};

use super::examined::{Examined, Side};
use crate::model::constraint::{Attached, Attachment};
use crate::model::layout::{Item, Kind, Place};
use crate::model::state::SpatialState;
use crate::numbers::algebra::Vec3;

/// A share of the largest below this does not move.   \[-\]
const STILL: f64 = 1e-6;

/// Freedoms beyond this many are not looked at one by one.
const LOOKED_AT: usize = 24;

/// All freedoms at the pose.
pub(super) fn all(examined: &Examined<'_>) -> Vec<Freedom> {
    let found = examined.here.free.iter().enumerate();
    found
        .map(|(k, (column, _))| {
            let direction = direction(examined, k);
            let motions = motions(examined, &direction);
            Freedom {
                persistence: persistence(examined, k, &direction),
                idle: is_idle(examined, &motions),
                motions,
                coordinate: examined.model().layout.names[*column].clone(),
                direction,
            }
        })
        .collect()
}

/// True if a motion is a turn of one body, or of several as one, about a line through all points by which
/// others hold them.
fn is_idle(examined: &Examined<'_>, motions: &[BodyMotion]) -> bool {
    let [BodyMotion { names, how: How::Screws { point, axis, pitch, .. } }] = motions else { return false };
    let model = examined.model();
    let (point, axis) = (Vec3::new(point[0], point[1], point[2]), Vec3::new(axis[0], axis[1], axis[2]));
    let length = examined.measures().sizes[0];
    let moves = |item: usize| names.contains(&model.layout.items[item].name);
    let mut holds = 0;
    for block in model.equations.blocks.iter().filter(|block| block.constraint.facts().kind != "euler_norm") {
        let arguments = block.constraint.arguments();
        let places: Vec<Option<Place>> =
            arguments.iter().map(|argument| model.layout.place(&argument.target)).collect();
        let of_it = |k: usize| matches!(places.get(k), Some(Some(Place::Own { item, .. })) if moves(*item));
        let moving = (0..places.len()).filter(|k| of_it(*k)).count();
        if moving == 0 || moving == places.len() {
            continue;
        }
        let attachments = block.constraint.attachments();
        let on_line = |attachment: &Attachment| match (attachment.what, places.get(attachment.argument)) {
            (Attached::Point(u), Some(Some(Place::Own { first, .. }))) => {
                let q = examined.q.get(*first..).and_then(|q| q.first_chunk::<7>());
                q.is_some_and(|q| {
                    (SpatialState::new(*q).point(u) - point).cross(axis).norm() <= 1e-6 * length
                })
            }
            _ => false,
        };
        let own: Vec<&Attachment> =
            attachments.iter().filter(|attachment| of_it(attachment.argument)).collect();
        if own.is_empty() || !own.into_iter().all(on_line) {
            return false;
        }
        holds += 1;
    }
    holds > 1 && *pitch == 0.0
}

/// Motions that are possible to first order only.
pub(super) fn infinitesimal(examined: &Examined<'_>) -> Vec<Vec<f64>> {
    let all = (0..examined.here.free.len()).map(|k| (k, direction(examined, k)));
    all.filter(|(k, v)| persistence(examined, *k, v) == Persistence::Infinitesimal).map(|(_, v)| v).collect()
}

fn persistence(examined: &Examined<'_>, k: usize, direction: &[f64]) -> Persistence {
    if !examined.persists(k, Side::Columns) {
        return Persistence::OnlyHere;
    }
    let v: Vec<f64> =
        direction.iter().zip(&examined.measures().sizes).map(|(v, size)| v / size).chain([0.0]).collect();
    if k >= LOOKED_AT || examined.walk.moves(examined.q, examined.t, &v) {
        Persistence::Always
    } else {
        Persistence::Infinitesimal
    }
}

/// The k-th vector in coordinates, the largest scaled entry 1.
fn direction(examined: &Examined<'_>, k: usize) -> Vec<f64> {
    let vector = &examined.here.free[k].1;
    let largest = vector.iter().fold(0.0_f64, |m, (_, x)| m.max(x.abs()));
    let mut v = vec![0.0; examined.model().n()];
    vector.iter().for_each(|(column, x)| v[*column] = x / largest * examined.measures().sizes[*column]);
    v
}

/// The motion of each body; bodies that move as one stand together.
fn motions(examined: &Examined<'_>, v: &[f64]) -> Vec<BodyMotion> {
    let length = examined.model().layout.items.iter().find_map(|item| match item.kind {
        Kind::Planar | Kind::Spatial | Kind::Length => Some(examined.measures().sizes[item.first]),
        Kind::Angle => None,
    });
    let length = length.unwrap_or(1.0);
    let mut all: Vec<BodyMotion> = Vec::new();
    for item in &examined.model().layout.items {
        let columns = item.first..item.first + item.kind.coordinates().len();
        let share = columns.clone().map(|k| (v[k] / examined.measures().sizes[k]).abs()).fold(0.0, f64::max);
        if share <= STILL {
            continue;
        }
        let how = how(item, &examined.q[columns.clone()], &v[columns], length);
        match all.iter_mut().find(|known| same(&known.how, &how, length)) {
            Some(known) => known.names.push(item.name.clone()),
            None => all.push(BodyMotion { names: vec![item.name.clone()], how }),
        }
    }
    all
}

fn how(item: &Item, q: &[f64], v: &[f64], length: f64) -> How {
    match (item.kind, q, v) {
        (Kind::Planar, [x, y, _], [vx, vy, w]) => {
            let speed = vx.hypot(*vy);
            if w.abs() * length > STILL * speed {
                How::TurnsAbout { point: [x - vy / w, y + vx / w], rate: *w }
            } else {
                How::Slides { along: [vx / speed, vy / speed], rate: speed }
            }
        }
        (Kind::Spatial, [x, y, z, e0, e1, e2, e3], [vx, vy, vz, d0, d1, d2, d3]) => {
            let (e, d) = (Vec3::new(*e1, *e2, *e3), Vec3::new(*d1, *d2, *d3));
            // ω = 2 (e0 ė − ė0 e + e × ė), the global angular velocity.
            let w = (d * *e0 - e * *d0 + e.cross(d)) * 2.0;
            screw(Vec3::new(*x, *y, *z), Vec3::new(*vx, *vy, *vz), w, length)
        }
        _ => How::Changes { rate: v.first().copied().unwrap_or_default() },
    }
}

fn screw(r: Vec3, v: Vec3, w: Vec3, length: f64) -> How {
    let (speed, turn) = (v.norm(), w.norm());
    if turn * length <= STILL * speed || turn == 0.0 {
        return match speed > 0.0 {
            true => How::SlidesInSpace { along: numbers(v * speed.recip()), rate: speed },
            false => How::Changes { rate: 0.0 },
        };
    }
    let (axis, square) = (w * turn.recip(), turn * turn);
    let pitch = w.dot(v) / square;
    let pitch = if pitch.abs() > STILL * length { pitch } else { 0.0 };
    How::Screws { point: numbers(r + w.cross(v) * square.recip()), axis: numbers(axis), rate: turn, pitch }
}

fn numbers(v: Vec3) -> [f64; 3] {
    [v.x, v.y, v.z]
}

/// True if two motions are one and the same.
fn same(a: &How, b: &How, length: f64) -> bool {
    let near = |a: &[f64], b: &[f64], size: f64| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-5 * size);
    match (a, b) {
        (How::TurnsAbout { point: p, rate: w }, How::TurnsAbout { point: q, rate: v }) => {
            near(p, q, length) && near(&[*w], &[*v], 1.0)
        }
        (How::Slides { along: p, rate: w }, How::Slides { along: q, rate: v }) => {
            near(p, q, 1.0) && near(&[*w], &[*v], length)
        }
        (How::SlidesInSpace { along: p, rate: w }, How::SlidesInSpace { along: q, rate: v }) => {
            near(p, q, 1.0) && near(&[*w], &[*v], length)
        }
        (
            How::Screws { axis: p, rate: w, pitch: h, point: a },
            How::Screws { axis: q, rate: v, pitch: g, point: b },
        ) => {
            let (a, b) = (Vec3::new(a[0], a[1], a[2]), Vec3::new(b[0], b[1], b[2]));
            let axis = Vec3::new(p[0], p[1], p[2]);
            near(p, q, 1.0)
                && near(&[*w], &[*v], 1.0)
                && near(&[*h], &[*g], length)
                && (b - a).cross(axis).norm() <= 1e-5 * length
        }
        _ => false,
    }
}
