//! Finds all assemblies of a mechanism at one time.
//!
//! The equations form groups that follow one another ([`groups`]). For each combination of
//! solutions of the preceding groups, Kin searches all solutions of a group by Newton's method from
//! many starts. If an early start leads to a known solution, Kin repeats the start with deflation,
//! which pushes steps away from known solutions (P. E. Farrell, Á. Birkisson, S. W. Funke,
//! Deflation techniques for finding distinct solutions of nonlinear partial differential equations,
//! SIAM J. Sci. Comput. 37, 2015). With M = Π (1 + ρ²/d_k²) the step of M C = 0 is Newton's step
//! times 1 / (1 − ∇ln M · Δq). A statistical rule ends the search ([`Known::is_settled`]).

use rayon::prelude::*;

use super::complete::{Account, Assemblies, Assembly};
use super::finder::Finder;
use super::groups::{Group, groups};
use super::known::{Known, OFTEN};
use super::label::labelled;
use super::levenberg_marquardt::LevenbergMarquardt;
use super::options::{AssemblyOptions, Clock, at_least_one};
use super::{turn, turned_over};
use crate::coordinates::units::Unit;
use crate::numbers::random::Random;
use crate::outcome::error::{Error, Result};
use crate::system::scaled::{Measures, Model};

/// More solutions of one group than this are no assemblies but poses of something that moves; more
/// assemblies than this are not listed.
const MOST: usize = 2000;

/// The number of first starts of a group that are deflated if they lead to a known solution.
const DEFLATED: usize = 64;

/// The number of starts that run one after the other. Most loops need no more, so they need no
/// other core.
const FIRST: usize = 128;

/// The number of later starts that run at once, on all cores.
const AT_ONCE: usize = 256;

/// Returns all assemblies that it finds, in the order of their labels.
pub(crate) fn all(
    model: Model<'_>,
    guess: &[f64],
    t: f64,
    options: &AssemblyOptions,
) -> Result<Assemblies> {
    at_least_one(options.starts, "starts")?;
    at_least_one(options.steps, "steps")?;
    let measures = model.measure(guess, t);
    let groups = groups(&model);
    let clock = Clock::new(options.time_limit);
    let mut search =
        Search { model, measures: &measures, t, options, clock, account: Account::new() };
    let mut poses = vec![guess.to_vec()];
    for (number, group) in groups.iter().enumerate() {
        let mut finder = Finder::new(model, &measures, group, t);
        let mut next = Vec::new();
        for base in &poses {
            next.extend(search.solutions((number, group), base, &mut finder)?);
            if next.len() > MOST {
                next.truncate(MOST);
                search.account.doubt(|| {
                    format!("the mechanism has more than {MOST} assemblies. Kin lists only {MOST} assemblies")
                });
                break;
            }
        }
        poses = next;
    }
    let found = search.closed(poses);
    let found = labelled(&model, &measures, found, t);
    let assemblies: Vec<Assembly> =
        found.into_iter().map(|(label, q)| Assembly { label, q }).collect();
    for Assembly { label, q } in &assemblies {
        search.doubt_where_singular(&label.to_string(), q);
    }
    let (complete, reason) = search.account.verdict(assemblies.len());
    Ok(Assemblies { assemblies, complete, reason })
}

struct Search<'a> {
    model: Model<'a>,
    measures: &'a Measures,
    t: f64,
    options: &'a AssemblyOptions,
    clock: Clock,
    account: Account,
}

impl<'a> Search<'a> {
    /// Returns all solutions of a group, on the right branch, for given solutions of the preceding
    /// groups.
    fn solutions(
        &mut self,
        (number, group): (usize, &Group),
        base: &[f64],
        finder: &mut Finder<'a>,
    ) -> Result<Vec<Vec<f64>>> {
        if !group.is_affine {
            self.account.is_affine = false;
            return self.search((number, group), base, finder);
        }
        self.account.starts += 1;
        if !finder.affine(base) {
            let row = self.model.equations.equation(group.rows[0]);
            self.account.doubt(|| format!("the equation `{row}` does not determine a coordinate"));
            return Ok(Vec::new());
        }
        let is_meant = !turned_over::any(&self.model, &finder.q, self.t, &group.branches);
        Ok(if is_meant { vec![finder.q.clone()] } else { Vec::new() })
    }

    /// Runs start after start until more are not worth their time.
    fn search(
        &mut self,
        (number, group): (usize, &Group),
        base: &[f64],
        finder: &mut Finder<'a>,
    ) -> Result<Vec<Vec<f64>>> {
        let most = most_starts(group, self.options.starts);
        finder.measure(base);
        let extent = finder.extent;
        let mut known = Known::new(self.model, self.measures);
        let mut start = 0;
        let mut ahead = std::collections::VecDeque::new();
        while !known.is_settled(self.options.patience) {
            if start == most || (start > 0 && self.clock.is_up()) {
                self.doubt_of(&known, start == most, start);
                break;
            }
            if start < FIRST {
                let from = self.start((number, group), base, extent, start);
                let first =
                    finder.newton(&from, self.options.steps, None).then(|| finder.q.clone());
                let again = (start < DEFLATED).then_some(&from[..]);
                self.absorb(&mut known, finder, first.as_deref(), again);
            } else {
                if ahead.is_empty() {
                    ahead = self
                        .at_once((number, group), base, extent, start..(start + AT_ONCE).min(most))
                        .into();
                }
                let found: Option<Vec<f64>> = ahead.pop_front().flatten();
                self.absorb(&mut known, finder, found.as_deref(), None);
            }
            start += 1;
            if known.poses.len() > MOST {
                let reason = format!(
                    "the mechanism has more than {MOST} assemblies, because the mechanism can move. Drive or hold each freedom"
                );
                return Err(Error::InvalidOptions { reason });
            }
        }
        let account = &mut self.account;
        account.starts += start;
        if !known.poses.is_empty() {
            account.missing = account.missing.max(known.missing());
            account.rarest = account.rarest.min(known.rarest());
        }
        Ok(known.poses.into_iter().map(|pose| pose.q).collect())
    }

    /// Runs independent starts in parallel.
    fn at_once(
        &self,
        (number, group): (usize, &Group),
        base: &[f64],
        extent: f64,
        starts: std::ops::Range<usize>,
    ) -> Vec<Option<Vec<f64>>> {
        let new = || Finder::new(self.model, self.measures, group, self.t).within(extent);
        let find = |finder: &mut Finder<'_>, start: usize| {
            let from = self.start((number, group), base, extent, start);
            finder.newton(&from, self.options.steps, None).then(|| finder.q.clone())
        };
        starts.into_par_iter().map_init(new, find).collect()
    }

    /// Counts the result of a start. If the pose was known, `again` is the start for a deflated
    /// attempt.
    fn absorb(
        &self,
        known: &mut Known<'a>,
        finder: &mut Finder<'_>,
        found: Option<&[f64]>,
        again: Option<&[f64]>,
    ) {
        /// The largest number of deflated steps.
        const STEPS: usize = 20;
        known.idle += 1;
        let Some(q) = found else { return };
        match self.known_as(known, finder, q) {
            Some(Ok(place)) => known.hit(place),
            Some(Err(new)) => return known.keep(new, true),
            None => {}
        }
        if let Some(from) = again
            && finder.newton(from, STEPS.min(self.options.steps), Some(known))
        {
            let q = finder.q.clone();
            if let Some(Err(new)) = self.known_as(known, finder, &q) {
                known.keep(new, false);
            }
        }
    }

    /// Returns the index of a pose among the known ones, or stores it as a new one with all digits.
    /// Returns `None` for a pose with an axis turned by 180°, which does not count.
    fn known_as(
        &self,
        known: &Known<'a>,
        finder: &mut Finder<'_>,
        q: &[f64],
    ) -> Option<std::result::Result<usize, Vec<f64>>> {
        if let Some(place) = known.find(q) {
            return Some(Ok(place));
        }
        if turned_over::any(&self.model, q, self.t, finder.branches()) {
            return None;
        }
        finder.refine(q);
        Some(known.find(&finder.q).ok_or_else(|| finder.q.clone()))
    }

    /// Returns a start. The first one is the present pose. In others the group's angles and Euler
    /// parameters are arbitrary, and its lengths are near the present pose.
    fn start(
        &self,
        (number, group): (usize, &Group),
        base: &[f64],
        extent: f64,
        start: usize,
    ) -> Vec<f64> {
        /// The distances of starts, in extents of the group, in turn.
        const REACH: [f64; 3] = [0.5, 1.0, 2.0];
        let mut q = base.to_vec();
        if start > 0 {
            let own = self.options.seed.wrapping_mul(0x9E37_79B9_7F4A_7C15);
            let mut random = Random::new(own.wrapping_add(((number as u64) << 32) + start as u64));
            let reach = REACH[start % REACH.len()] * extent;
            for &column in &group.columns {
                q[column] = match self.model.layout.units[column] {
                    Unit::Metre => q[column] + reach * random.number(),
                    Unit::Radian => std::f64::consts::PI * random.number(),
                    Unit::One => random.number(),
                };
            }
            for &first in &group.turns {
                within_the_ball(&mut q[first..first + 4], &mut random);
            }
            q = turned_over::righted(&self.model, q, self.t, &group.branches, &|first| {
                group.turns_body(first)
            });
        }
        if group.is_square() { q } else { turn::turned(&self.model, &q, self.t, &|_| true) }
    }

    /// Moves the poses onto C = 0 with all digits, removes duplicates, and omits those that do not
    /// close.
    fn closed(&mut self, poses: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        let mut known = Known::new(self.model, self.measures);
        let mut onto_equations =
            LevenbergMarquardt::new(self.model, self.measures, Vec::new(), false);
        for q in poses {
            let Some(place) = onto_equations.place(&q, self.t) else { continue };
            let found = onto_equations.minimise(place, self.options.steps);
            let is_met = self.model.met(&found.point, &found.q, self.measures, &|_| true);
            if is_met && known.find(&found.q).is_none() {
                known.keep(found.q, true);
            }
        }
        known.poses.into_iter().map(|pose| pose.q).collect()
    }

    /// Records that a search ended too early.
    fn doubt_of(&mut self, known: &Known<'_>, is_exhausted: bool, starts: usize) {
        self.account.doubt(|| {
            let w = known.poses.len();
            let missing = known.missing();
            let rarest = known.rarest();
            match (is_exhausted, w) {
                (false, _) => "the time limit ended the search".to_string(),
                (true, 0) => format!("none of {starts} starting poses led to an assembly"),
                (true, _) if rarest < OFTEN => {
                    let times = match rarest {
                        1 => "once".to_string(),
                        _ => format!("{rarest} times"),
                    };
                    format!("{starts} starting poses led to {w} assemblies, to one assembly only {times}. Allow more starting poses")
                }
                (true, _) => {
                    format!("{starts} starting poses led to {w} assemblies. By the estimate {missing:.1} assemblies are missing. Allow more starting poses")
                }
            }
        });
    }

    /// Records that a singular pose may belong to a family, which is no list.
    fn doubt_where_singular(&mut self, label: &str, q: &[f64]) {
        let model = self.model;
        let t = self.t;
        let is_regular = model
            .linearize(q, t)
            .is_ok_and(|point| model.rank(&point.values, &model.measure(q, t)) == model.n());
        if !is_regular {
            self.account.doubt(|| {
                format!("the assembly `{label}` is singular. The assembly may belong to a family of poses, and the list shows only some of these poses")
            });
        }
    }
}

/// Returns the largest number of starts for one group. Large groups cost more and get fewer.
fn most_starts(group: &Group, starts: usize) -> usize {
    let share = (7.0 / group.columns.len().max(7) as f64).powi(2).max(0.2);
    ((starts as f64 * share).ceil() as usize).max(1)
}

/// Draws four numbers of norm 1, with uniform directions.
fn within_the_ball(p: &mut [f64], random: &mut Random) {
    let norm = loop {
        let norm = p.iter().map(|e| e * e).sum::<f64>().sqrt();
        if (0.1..1.0).contains(&norm) {
            break norm;
        }
        p.fill_with(|| random.number());
    };
    p.iter_mut().for_each(|e| *e /= norm);
}
