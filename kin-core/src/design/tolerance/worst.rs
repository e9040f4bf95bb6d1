//! Finds the worst points in the box of tolerances.
//!
//! Kin tests corners of the box, and points on faces and inside the box where the second-order term
//! suggests an extreme.

use super::super::feature::Followed;
use super::second::SecondOrder;
use super::source::Source;
use crate::ask::measure::Measure;
use crate::numbers::random::Random;

/// The largest number of dimensions for which all corners are tested: 2⁸ mechanisms.
const ALL: usize = 8;

/// The number of directions of a clearance, if all corners are tested.
const DIRECTIONS: usize = 8;

/// The largest number of tested mechanisms.
const MOST: usize = 600;

/// The largest number of rounds in which one dimension after the other changes.
const ROUNDS: usize = 16;

/// The number of random corners from which the second order is maximised.
const STARTS: usize = 8;

/// The largest number of steps from a worst place to a worse one, by the derivatives there.
const STEPS: usize = 12;

/// The deviation of one dimension from its nominal value.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Off {
    /// The name of the dimension, or of one of the two dimensions of a clearance.
    pub name: String,
    /// The difference from the nominal value. \[unit of the dimension\]
    pub by: f64,
}

/// The points of the box of tolerances that Kin tested in addition to the centre.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Searched {
    /// The number of tested corners. Each tested direction of a clearance counts as a corner.
    pub corners: usize,
    /// True if Kin tested all corners, with eight directions for each clearance. If false, Kin
    /// tested the corners that the derivatives and the second-order term suggest, and their
    /// neighbours, which differ in one dimension.
    pub all_corners: bool,
    /// The number of tested points on faces and inside the box.
    pub inside: usize,
    /// The tested point with the smallest value; empty if this point is the centre of the box.
    pub lowest: Vec<Off>,
    /// The tested point with the largest value; empty if this point is the centre of the box.
    pub highest: Vec<Off>,
    /// A tested point at which the mechanism cannot be assembled; `None` if the mechanism can be
    /// assembled at all tested points.
    pub unassembled: Option<Vec<Off>>,
}

/// Returns the smallest and the largest value, or `None` if a part of the box does not close, and
/// the tested places.
pub(super) fn worst<M: Measure>(
    followed: &Followed<'_, M>,
    sources: &[Source],
    names: &[String],
    slopes: &[f64],
    second: Option<&SecondOrder>,
) -> ([Option<f64>; 2], Searched) {
    let n = names.len();
    let bent = second.map(|second| second.hessian.clone());
    let centre = || Deviation { off: vec![0.0; n], value: followed.nominal };
    let mut walk = Walk {
        followed,
        sources,
        names,
        second: bent.unwrap_or_else(|| vec![vec![0.0; n]; n]),
        seen: vec![vec![0.0; n]],
        corners: 0,
        worst: [centre(), centre()],
        unassembled: None,
    };
    walk.by_the_model(slopes);
    let all_corners = sources.len() <= ALL && walk.every_corner(slopes);
    if !all_corners {
        walk.one_by_one();
    }
    walk.onward();
    walk.report(all_corners)
}

/// A place, given by the deviation of each dimension, and its value.
struct Deviation {
    off: Vec<f64>,
    value: f64,
}

/// The tested places.
struct Walk<'a, M> {
    followed: &'a Followed<'a, M>,
    sources: &'a [Source],
    names: &'a [String],
    /// The second derivatives at the centre; zero if they are unknown.
    second: Vec<Vec<f64>>,
    seen: Vec<Vec<f64>>,
    corners: usize,
    /// The places with the smallest and the largest value.
    worst: [Deviation; 2],
    unassembled: Option<Vec<f64>>,
}

/// The signs of the smallest and of the largest value.
const SIDES: [f64; 2] = [-1.0, 1.0];

impl<M: Measure> Walk<'_, M> {
    /// Returns true if no more places may be tested.
    fn is_over(&self) -> bool {
        self.unassembled.is_some() || self.seen.len() > MOST
    }

    /// Tests a place that has not been tested.
    fn look(&mut self, off: Vec<f64>) {
        if self.is_over() || self.seen.contains(&off) {
            return;
        }
        self.corners += usize::from(self.is_corner(&off));
        self.seen.push(off.clone());
        let moved = self.names.iter().zip(off.iter().copied());
        let value = self.followed.system.off(moved).and_then(|system| self.followed.value(&system));
        match value.filter(|value| value.is_finite()) {
            None => self.unassembled = Some(off),
            Some(value) => {
                for (worst, side) in self.worst.iter_mut().zip(SIDES) {
                    if side * value > side * worst.value {
                        *worst = Deviation { off: off.clone(), value };
                    }
                }
            }
        }
    }

    fn is_corner(&self, off: &[f64]) -> bool {
        self.sources.iter().all(|source| {
            let far = source.parts.iter().map(|k| off[*k].powi(2)).sum::<f64>().sqrt();
            far >= (1.0 - 1e-9) * source.tolerance
        })
    }

    /// Tests the places that first and second order suggest from the centre, from the corner of the
    /// derivatives' signs, and from some random corners.
    fn by_the_model(&mut self, slopes: &[f64]) {
        let mut random = Random::new(1);
        let mut starts = vec![vec![0.0; self.names.len()]];
        for _ in 0..STARTS {
            let direction: Vec<f64> = self.names.iter().map(|_| random.number()).collect();
            starts.push(self.corner(&direction, 1.0));
        }
        for side in SIDES {
            self.look(self.corner(slopes, side));
            for start in starts.clone() {
                let place = self.climbed(slopes, start, side);
                self.look(place);
            }
        }
    }

    /// Returns the corner in the direction of these slopes, times the side.
    fn corner(&self, slopes: &[f64], side: f64) -> Vec<f64> {
        let mut off = vec![0.0; self.names.len()];
        let worst = self.sources.iter().flat_map(|source| source.worst(slopes));
        worst.for_each(|(k, by)| off[k] = side * by);
        off
    }

    /// Maximises (or minimises) s·d + ½ dᵀ H d from a start, one dimension after the other.
    fn climbed(&self, slopes: &[f64], mut d: Vec<f64>, side: f64) -> Vec<f64> {
        for _ in 0..ROUNDS {
            let before = d.clone();
            for source in self.sources {
                let parts = &source.parts;
                let bend = |i: usize, j: usize| side * self.second[parts[i]][parts[j]];
                let slope = |i: usize| {
                    let others = (0..d.len()).filter(|j| !parts.contains(j));
                    side * (slopes[parts[i]]
                        + others.map(|j| self.second[parts[i]][j] * d[j]).sum::<f64>())
                };
                let here: Vec<f64> = parts.iter().map(|k| d[*k]).collect();
                let own: Vec<f64> = (0..parts.len()).map(slope).collect();
                let value = |d: &[f64]| {
                    let bent = |i: usize| (0..d.len()).map(|j| bend(i, j) * d[j]).sum::<f64>();
                    (0..d.len()).map(|i| d[i] * (own[i] + 0.5 * bent(i))).sum::<f64>()
                };
                let mut best = (here.clone(), value(&here));
                for place in source.places(&own, bend) {
                    let there = value(&place);
                    if there > best.1 {
                        best = (place, there);
                    }
                }
                parts.iter().zip(best.0).for_each(|(k, x)| d[*k] = x);
            }
            if d == before {
                break;
            }
        }
        d
    }

    /// Tests all corners. Returns false if there are too many.
    fn every_corner(&mut self, slopes: &[f64]) -> bool {
        let choices: Vec<Vec<Vec<f64>>> =
            self.sources.iter().map(|source| source.ends(slopes)).collect();
        let count = choices.iter().try_fold(1_usize, |count, own| count.checked_mul(own.len()));
        let Some(count) = count.filter(|count| *count <= 1 << ALL) else { return false };
        for mut number in 0..count {
            let mut off = vec![0.0; self.names.len()];
            for (source, own) in self.sources.iter().zip(&choices) {
                let end = &own[number % own.len()];
                source.parts.iter().zip(end).for_each(|(k, x)| off[*k] = *x);
                number /= own.len();
            }
            self.look(off);
        }
        true
    }

    /// Continues from the worst corners: it reverses one dimension after the other, as long as the
    /// result is worse.
    fn one_by_one(&mut self) {
        for (which, side) in SIDES.into_iter().enumerate() {
            for _ in 0..ROUNDS {
                let before = self.worst[which].value;
                for k in 0..self.sources.len() {
                    let mut off = self.worst[which].off.clone();
                    let parts = &self.sources[k].parts;
                    match parts.iter().all(|k| off[*k] == 0.0) {
                        true => off[parts[0]] = side * self.sources[k].tolerance,
                        false => parts.iter().for_each(|k| off[*k] = -off[*k]),
                    }
                    self.look(off);
                }
                if side * self.worst[which].value <= side * before || self.is_over() {
                    break;
                }
            }
        }
    }

    /// Continues from the worst places with the exact derivatives there and the second order of the
    /// centre.
    fn onward(&mut self) {
        for (which, side) in SIDES.into_iter().enumerate() {
            for _ in 0..STEPS {
                let Deviation { off, value } = &self.worst[which];
                let off = off.clone();
                let before = *value;
                let moved = self.names.iter().zip(off.iter().copied());
                let Some(system) = self.followed.system.off(moved) else { break };
                let Ok(Some(slopes)) = self.followed.gradient(&system, self.names) else { break };
                self.look(self.corner(&slopes, side));
                // The slopes s at the centre of the model that has these slopes here.
                let at_centre = |(row, slope): (&Vec<f64>, &f64)| {
                    slope - row.iter().zip(&off).map(|(bend, d)| bend * d).sum::<f64>()
                };
                let slopes: Vec<f64> = self.second.iter().zip(&slopes).map(at_centre).collect();
                let place = self.climbed(&slopes, off, side);
                self.look(place);
                if side * self.worst[which].value <= side * before || self.is_over() {
                    break;
                }
            }
        }
    }

    fn report(self, all_corners: bool) -> ([Option<f64>; 2], Searched) {
        let off = |off: &Vec<f64>| -> Vec<Off> {
            let moved = self.names.iter().zip(off).filter(|(_, by)| **by != 0.0);
            moved.map(|(name, by)| Off { name: name.clone(), by: *by }).collect()
        };
        let [low, high] = &self.worst;
        let searched = Searched {
            corners: self.corners,
            all_corners: all_corners && self.unassembled.is_none(),
            inside: self.seen.len() - 1 - self.corners,
            lowest: off(&low.off),
            highest: off(&high.off),
            unassembled: self.unassembled.as_ref().map(off),
        };
        let closes = self.unassembled.is_none();
        ([low.value, high.value].map(|value| closes.then_some(value)), searched)
    }
}

impl Source {
    /// Returns the ends of a source: both of a dimension; some around the disc of a clearance, the
    /// first one in the direction of the slopes.
    fn ends(&self, slopes: &[f64]) -> Vec<Vec<f64>> {
        let worst: Vec<f64> = self.worst(slopes).into_iter().map(|(_, by)| by).collect();
        match worst[..] {
            [x, y] => self.around(x.atan2(y), DIRECTIONS),
            _ => vec![vec![-self.tolerance], vec![self.tolerance]],
        }
    }

    /// Returns places around the disc; the first one is at (sin, cos) of the angle.
    fn around(&self, angle: f64, count: usize) -> Vec<Vec<f64>> {
        let place = |k: usize| {
            let (sin, cos) = (angle + std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
            vec![self.tolerance * sin, self.tolerance * cos]
        };
        (0..count).map(place).collect()
    }

    /// Returns the places of this source alone at which s·d + ½ dᵀ H d can be largest.
    fn places(&self, slopes: &[f64], bend: impl Fn(usize, usize) -> f64) -> Vec<Vec<f64>> {
        let inside =
            |d: &Vec<f64>| d.iter().map(|x| x * x).sum::<f64>() < self.tolerance * self.tolerance;
        match *slopes {
            [x, y] => {
                let mut all = self.around(x.atan2(y), 4 * DIRECTIONS);
                let xx = bend(0, 0);
                let xy = bend(0, 1);
                let yy = bend(1, 1);
                let determinant = xx * yy - xy * xy;
                all.push(vec![(xy * y - yy * x) / determinant, (xy * x - xx * y) / determinant]);
                all.retain(|d| d.iter().all(|x| x.is_finite()));
                let last = all.len() - 1;
                if last == 4 * DIRECTIONS && !inside(&all[last]) {
                    all.pop();
                }
                all
            }
            [x] => {
                let turn = vec![-x / bend(0, 0)];
                let ends = [-self.tolerance, self.tolerance].map(|end| vec![end]);
                ends.into_iter()
                    .chain(Some(turn).filter(|turn| turn[0].is_finite() && inside(turn)))
                    .collect()
            }
            _ => Vec::new(),
        }
    }
}
