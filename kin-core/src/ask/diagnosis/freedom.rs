//! Finds the remaining freedoms: which bodies move, and how.

mod second_order;

use crate::outcome::verdict::{BodyMotion, Freedom, How, Persistence};

use super::examined::{Examined, Side};
use crate::coordinates::layout::{Item, Kind, Place};
use crate::linear::{Sparse, dense};
use crate::model::constraint::{Attached, Attachment};
use crate::model::state::SpatialState;
use crate::numbers::algebra::Vec3;

/// A component below this share of the largest one does not move. \[-\]
const STILL: f64 = 1e-6;

/// Freedoms beyond this number are not examined one by one.
const LOOKED_AT: usize = 24;

/// The directions are stored as long as all of them together need at most this many numbers.
const MOST_NUMBERS: usize = 1 << 22;

/// Returns all freedoms at the pose, with their persistence.
pub(super) fn all(examined: &Examined<'_>, persistence: &[Persistence]) -> Vec<Freedom> {
    let n = examined.model().n();
    let free = &examined.here.free;
    let keeps = n.saturating_mul(free.len()) <= MOST_NUMBERS;
    let found = free.iter().zip(persistence).enumerate();
    found
        .map(|(k, ((column, _), persistence))| {
            let direction = direction(examined, k);
            let (items, motions) = motions(examined, &direction);
            let play = match persistence {
                Persistence::Infinitesimal => second_order::play(examined, &dense(&direction, n)),
                _ => None,
            };
            Freedom {
                persistence: *persistence,
                idle: is_idle(examined, &items, &motions),
                motions,
                coordinate: examined.model().layout.names[*column].clone(),
                direction: if keeps { dense(&direction, n) } else { Vec::new() },
                play,
            }
        })
        .collect()
}

/// Returns true if a motion is a rotation of one body, or of several together, about a line through
/// all points at which others hold them.
fn is_idle(examined: &Examined<'_>, items: &[usize], motions: &[BodyMotion]) -> bool {
    let [BodyMotion { how: How::Screws { point, axis, pitch, .. }, .. }] = motions else {
        return false;
    };
    let model = examined.model();
    let point = Vec3::new(point[0], point[1], point[2]);
    let axis = Vec3::new(axis[0], axis[1], axis[2]);
    let length = examined.measures().sizes[0];
    let mut acting: Vec<usize> =
        items.iter().flat_map(|item| examined.acting[*item].iter().copied()).collect();
    acting.sort_unstable();
    acting.dedup();
    let mut holds = 0;
    for block in acting.into_iter().map(|block| &model.equations.blocks[block]) {
        let arguments = block.constraint.arguments();
        let places: Vec<Option<Place>> =
            arguments.iter().map(|argument| model.layout.place(&argument.target)).collect();
        let of_it = |k: usize| matches!(places.get(k), Some(Some(Place::Own { item, .. })) if items.contains(item));
        let moving = (0..places.len()).filter(|k| of_it(*k)).count();
        if moving == 0 || moving == places.len() {
            continue;
        }
        let attachments = block.constraint.attachments();
        let on_line =
            |attachment: &Attachment| match (attachment.what, places.get(attachment.argument)) {
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

/// Returns the motions that are possible to first order only.
pub(super) fn infinitesimal(examined: &Examined<'_>, persistence: &[Persistence]) -> Vec<Vec<f64>> {
    let all = persistence.iter().enumerate();
    let stiff = all.filter(|(_, persistence)| **persistence == Persistence::Infinitesimal);
    stiff.map(|(k, _)| dense(&direction(examined, k), examined.model().n())).collect()
}

/// Returns the persistence of each freedom.
///
/// A freedom that remains at nearby poses of higher rank is at least of first order. The
/// second-order test shows which of these freedoms are of first order only. If the test does not
/// decide, a step along the freedom and back onto C = 0 does.
pub(super) fn persistences(examined: &Examined<'_>) -> Vec<Persistence> {
    let free = &examined.here.free;
    let lasting: Vec<usize> =
        (0..free.len()).filter(|k| examined.persists(*k, Side::Columns)).collect();
    let n = examined.model().n();
    let looked_at = lasting.iter().take(LOOKED_AT);
    let directions: Vec<Vec<f64>> = looked_at.map(|k| dense(&direction(examined, *k), n)).collect();
    let is_stiff = lasting.len() <= LOOKED_AT && second_order::holds(examined, &directions);
    let of = |k: usize| {
        if !examined.persists(k, Side::Columns) {
            return Persistence::OnlyHere;
        }
        if is_stiff {
            return Persistence::Infinitesimal;
        }
        let sizes = &examined.measures().sizes;
        let moves = |v: &Vec<f64>| {
            let v: Vec<f64> = v.iter().zip(sizes).map(|(v, size)| v / size).chain([0.0]).collect();
            examined.walk.moves(examined.q, examined.t, &v)
        };
        let nothing_holds = free[k].1.iter().all(|(column, _)| {
            examined
                .model()
                .layout
                .owner_index(*column)
                .is_some_and(|item| examined.acting[item].is_empty())
        });
        let looked_at =
            lasting.iter().position(|other| *other == k).and_then(|at| directions.get(at));
        match looked_at.filter(|_| !nothing_holds) {
            Some(v) if !moves(v) => Persistence::Infinitesimal,
            _ => Persistence::Always,
        }
    };
    (0..free.len()).map(of).collect()
}

/// Returns the k-th null vector in coordinates, with a largest scaled entry of 1.
fn direction(examined: &Examined<'_>, k: usize) -> Sparse {
    let vector = &examined.here.free[k].1;
    let largest = vector.iter().fold(0.0_f64, |m, (_, x)| m.max(x.abs()));
    let sizes = &examined.measures().sizes;
    vector.iter().map(|(column, x)| (*column, x / largest * sizes[*column])).collect()
}

/// Returns the bodies and coordinates that move, and their motions. Bodies that move together share
/// an entry.
fn motions(examined: &Examined<'_>, v: &Sparse) -> (Vec<usize>, Vec<BodyMotion>) {
    let layout = examined.model().layout;
    let sizes = &examined.measures().sizes;
    let length = layout.items.iter().find_map(|item| match item.kind {
        Kind::Planar | Kind::Spatial | Kind::Length => Some(sizes[item.first]),
        Kind::Angle => None,
    });
    let length = length.unwrap_or(1.0);
    let mut touched: Vec<usize> =
        v.iter().filter_map(|(column, _)| layout.owner_index(*column)).collect();
    touched.dedup();
    let mut all: Vec<BodyMotion> = Vec::new();
    let mut items = Vec::new();
    for index in touched {
        let item = &layout.items[index];
        let columns = item.first..item.first + item.kind.coordinates().len();
        let mut own = vec![0.0; columns.len()];
        let of_it = v.iter().skip(v.partition_point(|(column, _)| *column < columns.start));
        of_it
            .take_while(|(column, _)| columns.contains(column))
            .for_each(|(column, x)| own[column - item.first] = *x);
        let share = own.iter().zip(&sizes[columns.clone()]).map(|(v, size)| (v / size).abs());
        if share.fold(0.0, f64::max) <= STILL {
            continue;
        }
        items.push(index);
        let how = how(item, &examined.q[columns], &own, length);
        match all.iter_mut().find(|known| same(&known.how, &how, length)) {
            Some(known) => known.names.push(item.name.clone()),
            None => all.push(BodyMotion { names: vec![item.name.clone()], how }),
        }
    }
    (items, all)
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
            let e = Vec3::new(*e1, *e2, *e3);
            let d = Vec3::new(*d1, *d2, *d3);
            // ω = 2 (e0 ė − ė0 e + e × ė), the global angular velocity.
            let w = (d * *e0 - e * *d0 + e.cross(d)) * 2.0;
            screw(Vec3::new(*x, *y, *z), Vec3::new(*vx, *vy, *vz), w, length)
        }
        _ => How::Changes { rate: v.first().copied().unwrap_or_default() },
    }
}

fn screw(r: Vec3, v: Vec3, w: Vec3, length: f64) -> How {
    let speed = v.norm();
    let turn = w.norm();
    if turn * length <= STILL * speed || turn == 0.0 {
        return match speed > 0.0 {
            true => How::SlidesInSpace { along: numbers(v * speed.recip()), rate: speed },
            false => How::Changes { rate: 0.0 },
        };
    }
    let axis = w * turn.recip();
    let square = turn * turn;
    let pitch = w.dot(v) / square;
    let pitch = if pitch.abs() > STILL * length { pitch } else { 0.0 };
    How::Screws {
        point: numbers(r + w.cross(v) * square.recip()),
        axis: numbers(axis),
        rate: turn,
        pitch,
    }
}

fn numbers(v: Vec3) -> [f64; 3] {
    [v.x, v.y, v.z]
}

/// Returns true if two motions are equal.
fn same(a: &How, b: &How, length: f64) -> bool {
    let near = |a: &[f64], b: &[f64], size: f64| {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-5 * size)
    };
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
            let a = Vec3::new(a[0], a[1], a[2]);
            let b = Vec3::new(b[0], b[1], b[2]);
            let axis = Vec3::new(p[0], p[1], p[2]);
            near(p, q, 1.0)
                && near(&[*w], &[*v], 1.0)
                && near(&[*h], &[*g], length)
                && (b - a).cross(axis).norm() <= 1e-5 * length
        }
        _ => false,
    }
}
