//! Computes characteristic sizes, so that tolerances, ranks and the check of steps do not depend on
//! the unit of length or on the origin.

use std::f64::consts::FRAC_PI_2;

use crate::coordinates::layout::Layout;
use crate::coordinates::units::Unit;
use crate::numbers::random::Random;
use crate::system::evaluate::Equations;

/// The exponents of the ladder of distances, from the finest to the coarsest; each distance is
/// twice the one before. Twelve orders of ten on either side of 1 suffice for equations that
/// contain no length.
const LADDER: std::ops::RangeInclusive<i32> = -40..=40;

/// The number of steps of the ladder below a known length: down to a millionth of it.
const BELOW: i32 = 20;

/// An equation is bent where one of its slopes has changed by this share of the largest slope that
/// changes. \[-\]
const BENT: f64 = 0.5;

/// If a row bends at a distance of more than this multiple of the distance at which it was half
/// bent, it bends by chance: its slopes oscillate near the threshold. \[-\]
const BY_CHANCE: f64 = 8.0;

/// A slope that has changed by less than this share of it is constant except for rounding. \[-\]
const CONSTANT: f64 = 1e-3;

/// If slopes that change are smaller than this share of their row, the row decides instead of them.
/// \[-\]
const SLIGHT: f64 = 1e-3;

/// An equation that bends within a size divided by this number has a separate size. \[-\]
const WITHIN: f64 = 4.0;

/// A lever or a coordinate below this share of the largest length, or of the unit of length, is a
/// rounded zero. For example, a slider that starts at 0.3 sin π metres does not make a mechanism of
/// attometres. \[-\]
const ROUNDING: f64 = 1e-12;

/// Distances smaller than this share of the largest coordinate are rounding. \[-\]
const RESOLVED: f64 = 1e-9;

/// Returns the characteristic size s_j of every coordinate for ranks, tolerances and proofs. It is
/// 1 for angles and Euler parameters. For lengths it is one typical length of the model, because
/// ranks compare lengths with angles.
///
/// The typical length comes from rows in which the model compares lengths with angles. A row that
/// changes by |∂C/∂R| per metre and by |∂C/∂θ| per radian has the lever |∂C/∂θ| / |∂C/∂R|. The
/// typical length is the median lever of the constraints. Without levers it is the largest link, or
/// else the median distance within which equations are nearly straight; neither depends on the
/// origin. If all equations are straight, any length serves: the largest coordinate, or else 1.
pub(crate) fn sizes(
    layout: &Layout,
    equations: &Equations,
    values: &[f64],
    (q, t): (&[f64], f64),
    links: &[f64],
) -> Vec<f64> {
    let turned = Turned::new(layout, equations, (q, t));
    sizes_with(&turned, layout, equations, values, (q, t), links)
}

/// Returns the sizes from known slopes at angles a quarter revolution further on.
pub(crate) fn sizes_with(
    turned: &Turned,
    layout: &Layout,
    equations: &Equations,
    values: &[f64],
    (q, t): (&[f64], f64),
    links: &[f64],
) -> Vec<f64> {
    let known = || lengths(layout).map(|column| q[column]).chain(links.iter().copied());
    let floor = ROUNDING * known().fold(1.0_f64, |most, length| most.max(length.abs()));
    let is_length = |length: &f64| *length > floor;
    let length = lever(layout, equations, [values, &turned.values], floor)
        .or_else(|| largest(links.iter().copied()))
        .or_else(|| median(bends(layout, equations, (q, t), LADDER.map(power)).distances))
        .or_else(|| largest(lengths(layout).map(|column| q[column])).filter(is_length))
        .unwrap_or(1.0);
    layout.units.iter().map(|unit| if *unit == Unit::Metre { length } else { 1.0 }).collect()
}

/// Returns the sizes for the check of steps of time. They are those of [`sizes`], but for a length
/// at most the distance within which its equations are nearly straight.
///
/// The check assumes that the slopes of an equation change by at most their values within a size.
/// Long links elsewhere and the distance of the origin do not matter for this.
pub(crate) fn reaches(
    layout: &Layout,
    equations: &Equations,
    (q, t): (&[f64], f64),
    mut sizes: Vec<f64>,
) -> Vec<f64> {
    let Some(length) = lengths(layout).next().map(|column| sizes[column]) else { return sizes };
    let ladder = (-BELOW..=0).map(|k| length * power(k));
    let found = bends(layout, equations, (q, t), ladder).reaches;
    for (size, reach) in sizes.iter_mut().zip(found) {
        if reach < *size / WITHIN {
            *size = reach;
        }
    }
    sizes
}

fn power(k: i32) -> f64 {
    2.0_f64.powi(k)
}

/// Returns the columns of lengths.
fn lengths(layout: &Layout) -> impl Iterator<Item = usize> + '_ {
    layout
        .units
        .iter()
        .enumerate()
        .filter(|(_, unit)| **unit == Unit::Metre)
        .map(|(column, _)| column)
}

/// Returns the median lever of the constraints that have one above the floor.
///
/// Rows of angles alone, such as those of an axis, contain no length. A row with a length can
/// rotate with its angles until a lever vanishes (l cos θ = x at θ = 0). So slopes count at the
/// present angles and a quarter revolution further on.
fn lever(layout: &Layout, equations: &Equations, slopes: [&[f64]; 2], floor: f64) -> Option<f64> {
    let (mut levers, mut rows): (Vec<f64>, Vec<[f64; 2]>) = (Vec::new(), Vec::new());
    for block in &equations.blocks {
        rows.clear();
        rows.resize(block.rows().len(), [0.0; 2]);
        for place in block.values() {
            let Some((row, column)) = equations.entries[place] else { continue };
            let kind = usize::from(layout.units[column] != Unit::Metre);
            let most = &mut rows[row - block.rows().start][kind];
            // Where C was NaN there are no slopes.
            let slope = |all: &[f64]| all.get(place).map_or(0.0, |slope| slope.abs());
            *most = most.max(slope(slopes[0])).max(slope(slopes[1]));
        }
        let both = rows.iter().filter(|row| row[0] > 0.0);
        let [per_length, per_angle] =
            both.fold([0.0_f64; 2], |most, row| [most[0].max(row[0]), most[1].max(row[1])]);
        levers.push(per_angle / per_length);
    }
    levers.retain(|lever| lever.is_finite() && *lever > floor);
    median(levers)
}

/// C_q with every angle a quarter revolution further on.
#[derive(Debug, Default)]
pub(crate) struct Turned {
    /// The position before the rotation.
    q: Vec<f64>,
    values: Vec<f64>,
}

impl Turned {
    pub(crate) fn new(layout: &Layout, equations: &Equations, (q, t): (&[f64], f64)) -> Self {
        let turn =
            |(q, unit): (&f64, &Unit)| if *unit == Unit::Radian { q + FRAC_PI_2 } else { *q };
        let turned: Vec<f64> = q.iter().zip(&layout.units).map(turn).collect();
        let mut values = vec![0.0; equations.entries.len()];
        equations.set_constants(&mut values);
        let instant = equations.instant_at(t, &turned);
        equations.linearize(&turned, &instant, &mut vec![0.0; equations.rows], &mut values);
        Turned { q: q.to_vec(), values }
    }

    /// Returns true if these slopes are valid at q too: no coordinate has moved by more than half
    /// of its size since.
    pub(crate) fn serves(&self, q: &[f64], sizes: &[f64]) -> bool {
        const NEAR: f64 = 0.5;
        let moved = self.q.iter().zip(q).zip(sizes);
        self.q.len() == q.len()
            && moved.into_iter().all(|((from, to), size)| (to - from).abs() <= NEAR * size)
    }
}

fn median(mut all: Vec<f64>) -> Option<f64> {
    let middle = all.len() / 2;
    (middle < all.len()).then(|| *all.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// Returns the largest of some numbers, if it is not 0.
fn largest(numbers: impl Iterator<Item = f64>) -> Option<f64> {
    Some(numbers.fold(0.0_f64, |m, x| m.max(x.abs()))).filter(|largest| *largest > 0.0)
}

/// The distances by which lengths may move before equations bend.
struct Bends {
    /// For each row that bends, the distance.
    distances: Vec<f64>,
    /// For each coordinate the smallest distance of its rows; infinite if none bends.
    reaches: Vec<f64>,
}

/// Moves all lengths at random by the growing distances of a ladder, and compares the slopes of
/// each equation with those at q.
///
/// A row is bent where one of its slopes has changed by half of the largest slope that changes. The
/// size of each other coordinate of the row is then limited: it may not change the row by more than
/// the coordinate that bends it.
fn bends(
    layout: &Layout,
    equations: &Equations,
    (q, t): (&[f64], f64),
    ladder: impl Iterator<Item = f64>,
) -> Bends {
    let mut found = Bends { distances: Vec::new(), reaches: vec![f64::INFINITY; layout.len()] };
    let is_curved = |entry: usize| {
        equations.constants[entry].is_none()
            && equations.entries[entry]
                .is_some_and(|(_, column)| layout.units[column] == Unit::Metre)
    };
    let curved: Vec<usize> =
        (0..equations.entries.len()).filter(|entry| is_curved(*entry)).collect();
    if curved.is_empty() {
        return found;
    }
    let mut slopes = Slopes::new(layout, equations, t, curved);
    slopes.at(q);
    let here = slopes.values.clone();
    let mut moved = q.to_vec();
    let mut random = Random::new(0);
    let resolved = RESOLVED * largest(lengths(layout).map(|column| q[column])).unwrap_or(0.0);
    let mut change = vec![0.0_f64; here.len()];
    for distance in ladder.filter(|distance| *distance >= resolved) {
        let signs: Vec<f64> = q.iter().map(|_| random.number().signum()).collect();
        for way in [distance, -distance] {
            lengths(layout).for_each(|column| moved[column] = q[column] + way * signs[column]);
            slopes.at(&moved);
            slopes.changes(&here, &mut change);
        }
        slopes.judge(&here, &change, 0.5 * distance, &mut found);
        if slopes.straight == 0 {
            break;
        }
    }
    found
}

/// The slopes of all equations.
struct Slopes<'a> {
    layout: &'a Layout,
    equations: &'a Equations,
    t: f64,
    /// The entries of C_q in columns of lengths that are not constant, and their rows.
    curved: Vec<usize>,
    rows: Vec<Vec<usize>>,
    /// For each row the distance at which it was half bent; `None` if it was not.
    half: Vec<Option<f64>>,
    /// The number of rows that are not bent yet.
    straight: usize,
    c: Vec<f64>,
    values: Vec<f64>,
}

impl<'a> Slopes<'a> {
    fn new(layout: &'a Layout, equations: &'a Equations, t: f64, curved: Vec<usize>) -> Self {
        let mut values = vec![0.0; equations.entries.len()];
        let mut rows = vec![Vec::new(); equations.rows];
        equations.set_constants(&mut values);
        for entry in 0..values.len() {
            if let Some((row, _)) = equations.entries[entry] {
                rows[row].push(entry);
            }
        }
        let has_curved =
            |row: &mut Vec<usize>| row.iter().any(|entry| curved.binary_search(entry).is_ok());
        rows.iter_mut().filter_map(|row| (!has_curved(row)).then_some(row)).for_each(Vec::clear);
        let straight = rows.iter().filter(|row| !row.is_empty()).count();
        let c = vec![0.0; equations.rows];
        let half = vec![None; equations.rows];
        Slopes { layout, equations, t, curved, rows, half, straight, c, values }
    }

    fn at(&mut self, q: &[f64]) {
        let instant = self.equations.instant_at(self.t, q);
        self.equations.linearize(q, &instant, &mut self.c, &mut self.values);
    }

    /// Raises the recorded change of each slope. A slope that is NaN has an infinite change.
    fn changes(&self, here: &[f64], change: &mut [f64]) {
        for entry in &self.curved {
            let off = (self.values[*entry] - here[*entry]).abs();
            change[*entry] = change[*entry].max(if off.is_nan() { f64::INFINITY } else { off });
        }
    }

    /// Finds the rows that are bent within a distance.
    fn judge(&mut self, here: &[f64], change: &[f64], distance: f64, found: &mut Bends) {
        let rows = self.rows.iter_mut().zip(&mut self.half);
        for (row, half) in rows.filter(|(row, _)| !row.is_empty()) {
            let column =
                |entry: usize| self.equations.entries[entry].map_or(0, |(_, column)| column);
            let lengths =
                || row.iter().copied().filter(|k| self.layout.units[column(*k)] == Unit::Metre);
            let bends = |entry: &usize| change[*entry] > CONSTANT * here[*entry].abs();
            let most = lengths().filter(bends).fold(0.0_f64, |m, k| m.max(change[k]));
            let of_all = lengths().fold(0.0_f64, |m, k| m.max(here[k].abs()));
            let own = lengths().filter(bends).fold(0.0_f64, |m, k| m.max(here[k].abs()));
            let slope = if own > SLIGHT * of_all { own } else { of_all };
            if slope == 0.0 || most <= 0.5 * BENT * slope {
                continue;
            }
            let first = *half.get_or_insert(distance);
            if most <= BENT * slope {
                continue;
            }
            let distance = if distance > BY_CHANCE * first { first } else { distance };
            found.distances.push(distance);
            for entry in lengths() {
                // The limit is the change that the bending coordinate causes within the distance.
                let share = if bends(&entry) { 1.0 } else { slope / here[entry].abs() };
                let reach = &mut found.reaches[column(entry)];
                *reach = reach.min(distance * share);
            }
            self.straight -= 1;
            row.clear();
        }
    }
}
