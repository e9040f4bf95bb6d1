//! The circuit of a position: the whole curve of positions that a mechanism reaches while one
//! driver moves, past dead centres, by arc length.

use std::f64::consts::TAU;

use crate::coordinates::Target;
use crate::coordinates::layout::Place;
use crate::coordinates::units::Unit;
use crate::outcome::error::Result;
use crate::solve::follow::{Curve, CurvePoint, crossing_between, root};
use crate::solve::newton::{Newton, first_position};
use crate::solve::options::SolverOptions;
use crate::system::System;

/// The first step, the longest and the shortest step of the walk, in units of the sizes of
/// coordinates. \[-\]
const FIRST: f64 = 0.02;
const LONGEST: f64 = 0.1;
const SHORTEST: f64 = 1e-7;

/// Two halves of a step and the whole step lead to the same place, to this share of the step. \[-\]
const SAME: f64 = 1e-3;

/// The value of the driver counts this much less than the coordinates in the length of the curve:
/// it is a function of them. \[-\]
const LIGHT: f64 = 1e6;

/// A closed curve comes back to its first place to this distance. \[-\]
const CLOSED: f64 = 1e-8;

/// The longest circuit; a longer one does not end. \[-\]
const LONGEST_CURVE: f64 = 1e3;

/// A walk ends after so many steps.
const MOST_STEPS: usize = 100_000;

/// Why a circuit ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CircuitEnd {
    /// The curve goes on beyond a thousand sizes of the mechanism.
    Unbounded,
    /// Kin cannot follow the curve beyond this place: an equation is not defined there, or not
    /// smooth.
    Lost,
}

/// The curve as a list of places. The last number of each place is the value of the driver.
pub(crate) struct Traced<'a> {
    curve: Curve<'a>,
    /// The places, in order.
    pub places: Vec<CurvePoint>,
    /// The arc length at each place. \[-\]
    pub lengths: Vec<f64>,
    /// The two ends; `None` if the curve is closed.
    pub ends: Option<[CircuitEnd; 2]>,
    /// Where circuits cross: arc length and place.
    pub crossings: Vec<(f64, Vec<f64>)>,
}

/// Walks along the curve through q, a position of the system at time t.
///
/// Errors: q is no position, or C_q is singular there.
pub(crate) fn trace<'a>(
    system: &'a System,
    options: &SolverOptions,
    (q, t): (&[f64], f64),
    is_angle: bool,
) -> Result<Traced<'a>> {
    let mut newton = Newton::new(system, options);
    newton.q.copy_from_slice(q);
    first_position::resume(&mut newton, t)?;
    let turns = turns(system, is_angle);
    let mut curve = Curve::new(system, &newton.sizes, LIGHT).without_blocks();
    let along: Vec<f64> = newton.qd.iter().copied().chain([1.0]).collect();
    let x: Vec<f64> = newton.q.iter().copied().chain([t]).collect();
    let Some(start) = curve.place(x, &along) else {
        return Err(system.singular(t, &newton.q, None));
    };
    let forth = Walk::new(&start, 1.0, &turns).walked(&mut curve);
    let Some(end) = forth.end else {
        let Walk { places, lengths, crossings, .. } = forth;
        return Ok(Traced { curve, places, lengths, ends: None, crossings });
    };
    let back = Walk::new(&start, -1.0, &turns).walked(&mut curve);
    let first = back.lengths.last().copied().unwrap_or_default();
    let mut places: Vec<CurvePoint> = back.places.into_iter().skip(1).rev().collect();
    for place in &mut places {
        place.dx.iter_mut().for_each(|dx| *dx = -*dx);
        place.negative = !place.negative;
    }
    let mut lengths: Vec<f64> =
        back.lengths.iter().skip(1).rev().map(|length| first - length).collect();
    places.extend(forth.places);
    lengths.extend(forth.lengths.iter().map(|length| first + length));
    let mut crossings: Vec<(f64, Vec<f64>)> =
        back.crossings.into_iter().rev().map(|(length, x)| (first - length, x)).collect();
    crossings.extend(forth.crossings.into_iter().map(|(length, x)| (first + length, x)));
    let ends = Some([back.end.unwrap_or(CircuitEnd::Lost), end]);
    Ok(Traced { curve, places, lengths, ends, crossings })
}

impl Traced<'_> {
    /// Returns the place at an arc length. Where two circuits cross, the equations do not determine
    /// the place; there it is the known place before it.
    pub fn at(&mut self, length: f64) -> CurvePoint {
        let k = self.lengths.partition_point(|known| *known <= length).saturating_sub(1);
        let here = &self.places[k];
        let s = length - self.lengths[k];
        let middle =
            self.lengths.get(k + 1).is_some_and(|next| length > 0.5 * (self.lengths[k] + next));
        let found = if middle {
            self.curve.at(&self.places[k + 1], length - self.lengths[k + 1])
        } else if s == 0.0 {
            None
        } else {
            self.curve.at(here, s)
        };
        found.map_or_else(|| here.clone(), |(place, _)| place)
    }

    /// Returns the places at which a function of a place changes its sign, with their arc lengths.
    /// It has to be continuous.
    pub fn zeros(&mut self, f: impl Fn(&CurvePoint) -> f64) -> Vec<(f64, CurvePoint)> {
        let mut found = Vec::new();
        for k in 1..self.places.len() {
            let [here, next] = [&self.places[k - 1], &self.places[k]];
            let values = [f(here), f(next)];
            if !(values[0] * values[1] <= 0.0 && values[1] != 0.0) {
                continue;
            }
            let h = self.lengths[k] - self.lengths[k - 1];
            let curve = &mut self.curve;
            let s = root((0.0, values[0]), (h, values[1]), 0.0, |s| Some(f(&curve.at(here, s)?.0)));
            let place = s.and_then(|s| Some((s, curve.at(here, s)?.0)));
            found.extend(place.map(|(s, place)| (self.lengths[k - 1] + s, place)));
        }
        found
    }
}

/// How a coordinate counts when two positions are compared.
#[derive(Clone, Copy, PartialEq)]
enum Turns {
    No,
    /// An angle: whole turns do not count.
    Whole,
    /// One of four Euler parameters, the first of which has this index: their sign does not count.
    Sign(usize),
}

/// Returns how each coordinate and the driver count.
fn turns(system: &System, is_angle: bool) -> Vec<Turns> {
    let layout = system.layout();
    let mut turns: Vec<Turns> = layout
        .units
        .iter()
        .map(|unit| if *unit == Unit::Radian { Turns::Whole } else { Turns::No })
        .collect();
    for (_, body) in system.bodies() {
        if let Target::Spatial(_) = body
            && let Some(Place::Own { first, .. }) = layout.place(&body)
        {
            let first = first + 3;
            (first..first + 4).for_each(|k| turns[k] = Turns::Sign(first));
        }
    }
    turns.push(if is_angle { Turns::Whole } else { Turns::No });
    turns
}

/// A walk along the curve in one direction.
struct Walk<'s> {
    turns: &'s [Turns],
    places: Vec<CurvePoint>,
    lengths: Vec<f64>,
    crossings: Vec<(f64, Vec<f64>)>,
    /// Why the walk ended; `None` if it came back to its first place.
    end: Option<CircuitEnd>,
}

impl<'s> Walk<'s> {
    fn new(start: &CurvePoint, sense: f64, turns: &'s [Turns]) -> Self {
        let mut start = start.clone();
        start.dx.iter_mut().for_each(|dx| *dx *= sense);
        start.negative ^= sense < 0.0;
        Walk { turns, places: vec![start], lengths: vec![0.0], crossings: Vec::new(), end: None }
    }

    fn walked(mut self, curve: &mut Curve<'_>) -> Self {
        let mut s = FIRST;
        for _ in 0..MOST_STEPS {
            let here = self.here().clone();
            let Some((next, taken)) = step(curve, &here, &mut s) else {
                self.end = Some(CircuitEnd::Lost);
                return self;
            };
            if let Some(closing) = self.closing(curve, &here, taken) {
                let length = self.length() + closing;
                if let Some((last, _)) = curve.at(&here, closing) {
                    self.places.push(last);
                    self.lengths.push(length);
                }
                return self;
            }
            let length = self.length();
            if next.negative != here.negative {
                let at = crossing(curve, &here, taken);
                let place = crossing_between(curve, &here, &next, taken);
                let place = place.unwrap_or_else(|| middle(&here, &next, at / taken));
                self.crossings.push((length + at, place));
            }
            self.places.push(next);
            self.lengths.push(length + taken);
            if length > LONGEST_CURVE {
                break;
            }
        }
        self.end = Some(CircuitEnd::Unbounded);
        self
    }

    fn here(&self) -> &CurvePoint {
        &self.places[self.places.len() - 1]
    }

    fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// Returns the way from `here` to the first place, if the curve comes back to it within a step.
    fn closing(&self, curve: &mut Curve<'_>, here: &CurvePoint, step: f64) -> Option<f64> {
        if self.places.len() < 4 {
            return None;
        }
        let start = &self.places[0];
        let sign = self.signs(here, start);
        let target = self.image(start, here, &sign);
        let gone: Vec<f64> = target.iter().zip(&here.x).map(|(a, b)| a - b).collect();
        let ahead = curve.dot(&gone, &here.dx);
        if !(0.0..=1.5 * step).contains(&ahead) || curve.dot(&gone, &gone).sqrt() > 2.0 * step {
            return None;
        }
        let mut s = ahead;
        for _ in 0..8 {
            let (place, _) = curve.at(here, s)?;
            let left: Vec<f64> = target.iter().zip(&place.x).map(|(a, b)| a - b).collect();
            let more = curve.dot(&left, &place.dx);
            s += more;
            if curve.dot(&left, &left).sqrt() <= CLOSED {
                return (s <= step && s > 0.0).then_some(s);
            }
        }
        None
    }

    /// Returns the signs of Euler parameters that bring `start` near `here`, one for each
    /// coordinate.
    fn signs(&self, here: &CurvePoint, start: &CurvePoint) -> Vec<f64> {
        let product =
            |first: usize| -> f64 { (first..first + 4).map(|k| here.x[k] * start.x[k]).sum() };
        self.turns
            .iter()
            .map(|turns| match turns {
                Turns::Sign(first) if product(*first) < 0.0 => -1.0,
                _ => 1.0,
            })
            .collect()
    }

    /// Returns the same position as `start`, with whole turns and signs as near to `here` as
    /// possible.
    fn image(&self, start: &CurvePoint, here: &CurvePoint, sign: &[f64]) -> Vec<f64> {
        let image = |k: usize| match self.turns[k] {
            Turns::Whole => start.x[k] + TAU * ((here.x[k] - start.x[k]) / TAU).round(),
            Turns::No | Turns::Sign(_) => sign[k] * start.x[k],
        };
        (0..start.x.len()).map(image).collect()
    }
}

/// Makes one tested step, as long as the curve allows it. Returns the next place and the length of
/// the step.
fn step(curve: &mut Curve<'_>, here: &CurvePoint, s: &mut f64) -> Option<(CurvePoint, f64)> {
    while *s >= SHORTEST {
        if let Some(next) = tested(curve, here, *s) {
            let taken = *s;
            *s = (1.4 * taken).min(LONGEST);
            return Some((next, taken));
        }
        *s *= 0.5;
    }
    // Where circuits cross the equations are singular: the step leads over the place.
    let mut over = 8.0 * SHORTEST;
    while over <= LONGEST {
        if let Some(next) = curve.step(here, over)
            && next.negative != here.negative
        {
            *s = over.max(1e-4);
            return Some((next, over));
        }
        over *= 2.0;
    }
    None
}

/// Returns the place after a step, if two halves of the step lead to it too.
fn tested(curve: &mut Curve<'_>, here: &CurvePoint, s: f64) -> Option<CurvePoint> {
    let next = curve.step(here, s)?;
    let half = curve.step(here, 0.5 * s)?;
    let left: Vec<f64> = next.x.iter().zip(&half.x).map(|(a, b)| a - b).collect();
    let rest = curve.dot(&left, &half.dx);
    let (again, _) = curve.at(&half, rest)?;
    let off: Vec<f64> = next.x.iter().zip(&again.x).map(|(a, b)| a - b).collect();
    (curve.dot(&off, &off).sqrt() <= SAME * s).then_some(next)
}

/// Returns the way from `here` to the place at which the sign of the determinant changes.
fn crossing(curve: &mut Curve<'_>, here: &CurvePoint, step: f64) -> f64 {
    let [mut low, mut high] = [0.0, step];
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        match curve.at(here, middle) {
            Some((place, _)) if place.negative == here.negative => low = middle,
            Some(_) => high = middle,
            None => break,
        }
    }
    0.5 * (low + high)
}

/// Returns the place between two neighbours at a share of the step, by interpolation.
fn middle(here: &CurvePoint, next: &CurvePoint, share: f64) -> Vec<f64> {
    here.x.iter().zip(&next.x).map(|(a, b)| a + share * (b - a)).collect()
}
