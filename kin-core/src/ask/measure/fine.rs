//! Refines a motion until quintic polynomials describe it between its times.
//!
//! The quintic polynomials go through values, velocities and accelerations of all coordinates, and
//! of the measure, at both ends of a step.
//!
//! A grid of times may be coarse. Kin detects what happens between two of its times in three ways:
//!
//! * *Time*: the bounds and breaks of laws and other functions of time ([`clock`]).
//! * *Profiles*: laws of coordinates are compared with quintics over the range of their argument.
//! * *Path*: the pose in the middle of a step is compared with the quintics, in value and velocity,
//!   and no body may rotate by more than [`REACH`].
//!
//! Kin halves a step that fails. If the grid of times is fine enough, Kin solves no pose. Kin
//! divides a step at a change point, where a motion may change to another branch.

pub(super) mod clock;
pub(super) mod quintic;

use super::Measure;
use super::changes::Changes;
use crate::coordinates::units::Unit;
use crate::law::Law;
use crate::outcome::error::{Error, FailureKind, Result, UnfollowedReason};
use crate::solve::follow::REACH;
use crate::solve::motion::{EventKind, Motion, Quantity};
use crate::solve::newton::Outcome;
use crate::solve::options::SolverOptions;
use crate::solve::run::Run;
use crate::system::System;
use clock::Clock;
use quintic::Quintic;

/// The permitted error of a quintic, as a share of the range of a coordinate or measure over the
/// whole motion. Velocities times the length of the step may have [`RATES`] times this error. \[-\]
const MISS: f64 = 1e-6;
const RATES: f64 = 30.0;

/// The permitted error for a law of a coordinate, as a share of the change of the law. \[-\]
const PROFILE: f64 = 1e-5;

/// A number that moves by less than this share of its largest value is constant. \[-\]
const STILL: f64 = 1e-9;

/// The accuracy of values as a share of their characteristic size. A smaller error is no motion.
/// \[-\]
const ROUNDING: f64 = 1e-11;

/// The shortest part of a step, as a share of the step. \[-\]
const SHORTEST: f64 = 1e-7;

/// The largest number of added times.
const MOST: usize = 100_000;

/// A motion with enough additional times to show everything between its times.
pub(super) struct Fine {
    pub motion: Motion,
    pub changes: Changes,
}

impl System {
    /// Adds times to a motion until they show everything between its times.
    ///
    /// Errors: those of the measure and of a run, too many times.
    pub(super) fn fine(&self, motion: &Motion, what: Option<&dyn Measure>) -> Result<Fine> {
        let options = SolverOptions::new().jerk(motion.has_jerk());
        let mut refining = Refining::new(self, motion, what, &options)?;
        let mut fine = Motion::new(self, motion.len());
        for k in 0..motion.len() {
            match k.checked_sub(1) {
                None => add(&rows(self, motion, 0..1), &mut fine),
                Some(before) => refining.step(before, &mut fine)?,
            }
        }
        Ok(Fine { motion: fine, changes: refining.changes })
    }
}

/// A motion that is being refined.
struct Refining<'a> {
    system: &'a System,
    motion: &'a Motion,
    what: Option<&'a dyn Measure>,
    /// The measure at the times of the motion.
    grid: Option<Quantity>,
    run: Run<'a>,
    clock: Clock<'a>,
    changes: Changes,
    /// The range of each coordinate; the last entry is that of the measure.
    sizes: Vec<f64>,
    /// The rounding error of each coordinate; the last entry is that of the measure.
    rounding: Vec<f64>,
    profiles: Vec<Profile>,
    added: usize,
}

/// Times between kinks that follow one another within a step: without one of them the ends of the
/// step show nothing of the kinks.
fn between_kinks(motion: &Motion, [begin, end]: [f64; 2]) -> Vec<f64> {
    let inside = |t: f64| (t - begin) * (end - t) > 0.0;
    let kinks = motion.events().iter().filter(|event| event.kind == EventKind::Kink);
    let times: Vec<f64> = kinks.map(|event| event.t).filter(|t| inside(*t)).collect();
    times.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect()
}

/// A law of a coordinate.
struct Profile {
    block: usize,
    /// The index of the law in its constraint. `size` is the change of the law over the motion.
    number: usize,
    size: f64,
}

impl<'a> Refining<'a> {
    fn new(
        system: &'a System,
        motion: &'a Motion,
        what: Option<&'a dyn Measure>,
        options: &'a SolverOptions,
    ) -> Result<Self> {
        let grid = what.map(|what| what.of(system, motion)).transpose()?;
        let mut refining = Refining {
            system,
            motion,
            what,
            grid,
            run: Run::new(system, options, None)?,
            clock: Clock::new(system, motion),
            changes: Changes::of(system, motion),
            sizes: Vec::new(),
            rounding: rounding(system, motion),
            profiles: profiles(system, motion),
            added: 0,
        };
        let count = system.n_coordinates() + usize::from(what.is_some());
        refining.sizes = (0..count)
            .map(|j| size((0..motion.len()).map(|k| refining.on_grid(k, j)[0])))
            .collect();
        Ok(refining)
    }

    /// Returns x, ẋ and ẍ of a coordinate, or of the measure, at a time of the motion.
    fn on_grid(&self, k: usize, j: usize) -> [f64; 3] {
        orders(self.motion, self.grid.as_ref(), k, j)
    }

    /// Appends all times after time k of the motion, up to the next one.
    fn step(&mut self, k: usize, fine: &mut Motion) -> Result<()> {
        let next = rows(self.system, self.motion, k + 1..k + 2);
        let begin = self.motion.times()[k];
        let end = self.motion.times()[k + 1];
        let mut cuts: Vec<f64> = self.changes.cuts([begin, end]).collect();
        cuts.extend(between_kinks(self.motion, [begin, end]));
        if cuts.is_empty() && self.clock.is_plain(k) && self.is_seen(k) {
            add(&next, fine);
            return Ok(());
        }
        let shortest = SHORTEST * (end - begin).abs();
        let mut from = rows(self.system, self.motion, k..k + 1);
        cuts.extend(self.clock.cuts(k)?);
        cuts.sort_by(|a, b| (a - begin).abs().total_cmp(&(b - begin).abs()));
        cuts.dedup();
        for t in cuts {
            let to = self.between(&from, &next, t)?;
            self.fill(&from, &to, shortest, fine)?;
            from = to;
        }
        self.fill(&from, &next, shortest, fine)
    }

    /// Returns true if the neighbouring times show that quintics follow the motion in a step.
    fn is_seen(&self, k: usize) -> bool {
        let times = self.motion.times();
        if !self.is_short(self.motion, [k, k + 1]) {
            return false;
        }
        let fits = |first: usize| {
            let at = |place: usize, j: usize| self.on_grid(first + place, j);
            first + 2 < times.len()
                && self.fits([times[first], times[first + 1], times[first + 2]], &at)
        };
        fits(k) || k.checked_sub(1).is_some_and(fits)
    }

    /// Appends the necessary times between two poses, and the later pose.
    fn fill(&mut self, from: &Motion, to: &Motion, shortest: f64, fine: &mut Motion) -> Result<()> {
        let a = from.times()[0];
        let b = to.times()[0];
        let resolution = 64.0 * f64::EPSILON * a.abs().max(b.abs());
        if (b - a).abs() <= shortest.max(resolution) {
            add(to, fine);
            return Ok(());
        }
        self.added += 1;
        if self.added > MOST {
            return Err(too_many(self.motion, a));
        }
        // A pose in the middle may be singular; the next candidates are beside it.
        let places = [0.5, 0.461, 0.573].map(|share| a + share * (b - a));
        let middle = match self.between(from, to, places[0]) {
            Ok(middle) => middle,
            Err(_) => {
                self.between(from, to, places[1]).or_else(|_| self.between(from, to, places[2]))?
            }
        };
        let three = joined(self.system, [from, &middle, to]);
        let grid = self.what.map(|what| what.of(self.system, &three)).transpose()?;
        let at = |place: usize, j: usize| orders(&three, grid.as_ref(), place, j);
        (0..self.sizes.len()).for_each(|j| {
            let moved = (at(1, j)[0] - at(0, j)[0]).abs().max((at(2, j)[0] - at(0, j)[0]).abs());
            self.sizes[j] = self.sizes[j].max(if moved.is_finite() { moved } else { 0.0 });
        });
        let times = [a, middle.times()[0], b];
        if self.is_short(&three, [0, 1]) && self.is_short(&three, [1, 2]) && self.fits(times, &at) {
            add(&middle, fine);
            add(to, fine);
            return Ok(());
        }
        self.fill(from, &middle, shortest, fine)?;
        self.fill(&middle, to, shortest, fine)
    }

    /// Returns true if the pose at the middle time agrees with the quintics through the others.
    fn fits(&self, [a, middle, b]: [f64; 3], at: &dyn Fn(usize, usize) -> [f64; 3]) -> bool {
        self.sizes.iter().zip(&self.rounding).enumerate().all(|(j, (size, rounding))| {
            let curve = Quintic::between([a, b], [at(0, j), at(2, j)]);
            let u = (middle - a) / (b - a);
            let [x, rate, _] = at(1, j);
            let value = curve.at(u);
            let slope = curve.slope(u);
            let allowed = (MISS * size).max(*rounding);
            // A NaN cannot be improved by more times.
            let off = |miss: f64, allowed: f64| miss > allowed;
            !off((value - x).abs(), allowed)
                && !off((slope - (b - a) * rate).abs(), RATES * allowed)
        })
    }

    /// Returns true if no body rotates far between two times, and quintics follow the laws of
    /// coordinates there.
    fn is_short(&self, motion: &Motion, [k, next]: [usize; 2]) -> bool {
        let h = motion.times()[next] - motion.times()[k];
        let units = &self.system.layout().units;
        let turns =
            units.iter().enumerate().filter(|(_, unit)| **unit != Unit::Metre).all(|(j, _)| {
                let by_rates = (h * motion.qd(k)[j]).abs().max((h * motion.qd(next)[j]).abs());
                (motion.q(next)[j] - motion.q(k)[j]).abs() <= REACH && by_rates <= 2.0 * REACH
            });
        turns && (self.profiles.is_empty() || self.follows_profiles(motion, [k, next]))
    }

    fn follows_profiles(&self, motion: &Motion, ends: [usize; 2]) -> bool {
        let [from, to] = ends.map(|k| arguments(self.system, motion, k, &self.profiles));
        self.profiles.iter().zip(from.into_iter().zip(to)).all(|(profile, ((law, a), (_, b)))| {
            let jets = [law.jet(a), law.jet(b)];
            let h = b - a;
            let curve = Quintic::between([a, b], jets.map(|[f, f1, f2, _]| [f, f1, f2]));
            h == 0.0
                || places(7)
                    .all(|u| (curve.at(u) - law.at(a + u * h)).abs() <= PROFILE * profile.size)
        })
    }

    /// Returns the pose at a time between two poses, on their branch.
    fn between(&mut self, from: &Motion, to: &Motion, t: f64) -> Result<Motion> {
        let mut pose = Motion::new(self.system, 1);
        if self.changes.add(self.system, t, from.has_jerk(), &mut pose)? {
            return Ok(pose);
        }
        let mut tried = |known: &Motion| {
            let mut pose = Motion::new(self.system, 1);
            self.run.go_from(known, 0, t, &mut pose).map(|()| pose)
        };
        tried(from).or_else(|_| tried(to)).or_else(|_| {
            let h = t - from.times()[0];
            let along = from.q(0).iter().zip(from.qd(0).iter().zip(from.qdd(0)));
            let q: Vec<f64> = along.map(|(q, (qd, qdd))| q + h * (qd + 0.5 * h * qdd)).collect();
            self.system.pose_near(t, &q, from.has_jerk())
        })
    }
}

/// Returns the rounding error of each coordinate, and at the end that of the measure.
fn rounding(system: &System, motion: &Motion) -> Vec<f64> {
    if motion.is_empty() {
        return vec![0.0; system.n_coordinates() + 1];
    }
    let sizes = system.model().measure(motion.q(0), motion.times()[0]).sizes;
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    sizes.into_iter().chain([largest]).map(|size| ROUNDING * size).collect()
}

/// Returns the laws whose arguments depend on coordinates.
fn profiles(system: &System, motion: &Motion) -> Vec<Profile> {
    let Some(last) = motion.len().checked_sub(1) else { return Vec::new() };
    let t = motion.times()[0];
    let q = motion.q(0);
    let equations = system.equations();
    let moved: Vec<f64> = q.iter().zip(places(q.len())).map(|(q, u)| q + 0.1 + 0.1 * u).collect();
    let instants = [q, &moved].map(|q| equations.instant_at(t, q));
    let mut found = Vec::new();
    for (block, known) in equations.blocks.iter().enumerate() {
        let [mut here, mut there] = [Vec::new(), Vec::new()];
        for (all, instant) in [&mut here, &mut there].into_iter().zip(&instants) {
            known.constraint.laws(&equations.at(known, instant), &mut |_, _, x| all.push(x));
        }
        let differs = here.iter().zip(&there).enumerate().filter(|(_, (a, b))| a != b);
        found.extend(differs.map(|(number, _)| Profile { block, number, size: 0.0 }));
    }
    if found.is_empty() {
        return found;
    }
    let mut reach = vec![[f64::INFINITY, f64::NEG_INFINITY]; found.len()];
    for k in 0..=last {
        for ([low, high], (_, x)) in reach.iter_mut().zip(arguments(system, motion, k, &found)) {
            (*low, *high) = (low.min(x), high.max(x));
        }
    }
    let laws = arguments(system, motion, 0, &found);
    for ((profile, (law, _)), [low, high]) in found.iter_mut().zip(laws).zip(reach) {
        profile.size = size(places(64).map(|u| law.at(low + u * (high - low))));
    }
    found
}

/// Returns these laws with their arguments at a time of a motion.
fn arguments(system: &System, motion: &Motion, k: usize, profiles: &[Profile]) -> Vec<(Law, f64)> {
    let equations = system.equations();
    let instant = equations.instant_at(motion.times()[k], motion.q(k));
    let mut all = Vec::new();
    for profile in profiles {
        let block = &equations.blocks[profile.block];
        let mut number = 0;
        block.constraint.laws(&equations.at(block, &instant), &mut |_, law, x| {
            if number == profile.number {
                all.push((law.clone(), x));
            }
            number += 1;
        });
    }
    all
}

/// Returns irregular places between 0 and 1 (multiples of the golden ratio).
fn places(count: usize) -> impl Iterator<Item = f64> {
    (1..=count).map(|k| (k as f64 * 0.618_033_988_749_894_9).fract())
}

/// Returns the range of a number. It is never zero, so rounding does not count.
fn size(all: impl Iterator<Item = f64>) -> f64 {
    let mut low = f64::INFINITY;
    let mut high = f64::NEG_INFINITY;
    all.filter(|x| x.is_finite()).for_each(|x| (low, high) = (low.min(x), high.max(x)));
    (high - low).max(STILL * low.abs().max(high.abs())).max(f64::MIN_POSITIVE)
}

/// Returns x, ẋ and ẍ of coordinate j, or of the measure.
fn orders(motion: &Motion, asked: Option<&Quantity>, k: usize, j: usize) -> [f64; 3] {
    match (motion.q(k).get(j), asked) {
        (Some(q), _) => [*q, motion.qd(k)[j], motion.qdd(k)[j]],
        (None, Some(asked)) => {
            let [x, rate, second, _] = asked.orders();
            [x, rate, second].map(|all| all.get(k).copied().unwrap_or(f64::NAN))
        }
        (None, None) => [0.0; 3],
    }
}

/// Returns a motion with only these times.
pub(super) fn rows(system: &System, motion: &Motion, range: std::ops::Range<usize>) -> Motion {
    let mut found = Motion::new(system, range.len());
    for k in range {
        let outcome =
            Outcome { iterations: motion.iterations()[k], residual: motion.residuals()[k] };
        found.append(motion.times()[k], motion.orders(k, 0..system.n_coordinates()), outcome, 0);
    }
    found
}

/// Appends a pose.
fn add(pose: &Motion, to: &mut Motion) {
    let outcome = Outcome { iterations: pose.iterations()[0], residual: pose.residuals()[0] };
    to.append(pose.times()[0], [pose.q(0), pose.qd(0), pose.qdd(0), pose.qddd(0)], outcome, 0);
}

fn joined(system: &System, poses: [&Motion; 3]) -> Motion {
    let mut all = Motion::new(system, poses.len());
    poses.into_iter().for_each(|pose| add(pose, &mut all));
    all
}

fn too_many(motion: &Motion, t: f64) -> Error {
    let reason = UnfollowedReason::TooManyTimes;
    FailureKind::CannotFollow { reason }.at(t, motion.unit_words())
}
