//! The way from a position towards wishes, within the limits.

use nalgebra::{DMatrix, DVector};

use super::goal::Goal;
use super::levels::{self, Level};
use super::manifold::Manifold;

/// The longest step, in units of the sizes. \[-\]
const REACH: f64 = 0.1;

/// The targets move by at most this much of their scales at a time, unless that are more than
/// `MOST_PARTS` parts. \[-\]
const PART: f64 = 0.1;
const MOST_PARTS: f64 = 200.0;

/// The correction after a step is at most this share of the step: otherwise it may lead to another
/// branch. \[-\]
const STRAY: f64 = 0.5;

/// A wish is met to this share of its scale; a limit is kept to it. \[-\]
const MET: f64 = 1e-10;

/// The search ends at a step below the first value; on the way to the targets below the second.
const SHORT: f64 = 1e-13;
const COARSE: f64 = 1e-4;

/// The number of steps for one place of the targets.
const STEPS: usize = 60;

/// The damping at the first failure, its growth, and its limit. \[-\]
const DAMPING: f64 = 1e-3;
const GROWTH: f64 = 10.0;
const MOST: f64 = 1e8;

/// Up to this number of freedoms the curvature of the wishes is computed.
const CURVED: usize = 6;

/// A wish that comes nearer by less than to this share in a step may be out of reach: the next step
/// reads the curvature. \[-\]
const SLOW: f64 = 0.5;

/// A step of this length that brings no wish nearer is the last one. \[-\]
const RESTS: f64 = 1e-9;

/// The wishes of one level, each with its target.
pub(super) type Goals = Vec<(Goal, Vec<f64>)>;

/// The limit of a measure or coordinate.
pub(crate) struct Bound {
    pub goal: Goal,
    pub ends: [f64; 2],
}

impl Bound {
    /// Moves the ends so that the present value is within them.
    fn give_way(&mut self) {
        let value = self.goal.now.first().copied().unwrap_or(f64::NAN);
        let [low, high] = self.ends;
        self.ends = [low.min(value), high.max(value)];
    }
}

/// The way towards wishes.
pub(crate) struct Descent<'a> {
    pub manifold: Manifold<'a>,
    /// The levels, the most important one first.
    pub levels: Vec<Goals>,
    pub bounds: Vec<Bound>,
    pub q: Vec<f64>,
}

/// A place that a step led to.
struct Accepted {
    levels: Vec<Level>,
    tangents: DMatrix<f64>,
    /// The directions that the step left free, by tangents.
    free: DMatrix<f64>,
}

/// A number that a step must not change: of a limit at its end, or of a wish that is met.
struct Held<'g> {
    goal: &'g Goal,
    target: Vec<f64>,
}

impl Descent<'_> {
    /// Comes back to the limits, then goes towards the targets, as far as the mechanism can follow.
    /// Returns the directions that the wishes and limits leave free, as columns in units of the
    /// sizes. Returns `None` if the position is singular.
    pub(crate) fn go(&mut self) -> Option<DMatrix<f64>> {
        let beyond = self.passed(&self.q, &[]);
        if !beyond.is_empty() {
            self.come_back(&beyond)?;
        }
        self.approach()
    }

    /// Comes back from beyond these limits. A limit that cannot be kept gives way as far as needed.
    fn come_back(&mut self, beyond: &[(usize, f64)]) -> Option<()> {
        let ends: Vec<[f64; 2]> = self.bounds.iter().map(|bound| bound.ends).collect();
        for (k, _) in beyond {
            self.bounds[*k].give_way();
        }
        let goal = |(k, end): &(usize, f64)| (self.bounds[*k].goal.clone(), vec![*end]);
        let wishes = std::mem::replace(&mut self.levels, vec![beyond.iter().map(goal).collect()]);
        let found = self.approach();
        self.levels = wishes;
        for (bound, ends) in self.bounds.iter_mut().zip(ends) {
            bound.ends = ends;
        }
        for (k, _) in self.passed(&self.q, &[]) {
            self.bounds[k].give_way();
        }
        self.note();
        let Descent { manifold: Manifold { model, t, .. }, levels, q, .. } = self;
        for (goal, _) in levels.iter_mut().flatten() {
            goal.start = goal.values(model, *t, q);
        }
        found.map(|_| ())
    }

    /// Goes towards the targets along straight lines.
    fn approach(&mut self) -> Option<DMatrix<f64>> {
        let distance = |(goal, target): &(Goal, Vec<f64>)| {
            let changes = target.iter().zip(&goal.start).map(|(to, from)| (to - from).powi(2));
            changes.sum::<f64>().sqrt() / goal.scale
        };
        let longest = self.levels.iter().flatten().map(distance).fold(0.0, f64::max);
        let parts = (longest / PART).ceil().clamp(1.0, MOST_PARTS);
        let mut k = 1.0;
        while k < parts {
            self.settle(k / parts, COARSE)?;
            k += 1.0;
        }
        self.settle(1.0, SHORT)
    }

    /// Serves the wishes at a share of the way to their targets, until the step is shorter than
    /// `end`.
    fn settle(&mut self, share: f64, end: f64) -> Option<DMatrix<f64>> {
        let mut damping = 0.0;
        let mut tangents = self.manifold.tangents(&self.q)?;
        let mut levels = self.levels_at(&tangents, share);
        let mut free = DMatrix::identity(tangents.ncols(), tangents.ncols());
        for _ in 0..STEPS {
            let before: Vec<f64> = levels.iter().map(Level::distance).collect();
            let tried = self.step(&tangents, &levels, share, damping);
            let length = tried.as_ref().map_or(f64::INFINITY, |(_, length, _)| *length);
            match tried.and_then(|(q, _, left)| self.accepted(q, left, &before, share)) {
                Some(Accepted { levels: found, tangents: next, free: left }) => {
                    damping = if damping < DAMPING { 0.0 } else { damping / GROWTH };
                    let is_slow = found.iter().zip(&before).any(|(level, before)| {
                        level.distance() > MET && level.distance() > SLOW * before
                    });
                    levels = found;
                    tangents = next;
                    free = left;
                    if is_slow {
                        self.bend(&mut levels, &tangents);
                    }
                }
                None if length <= end.max(RESTS) => break,
                None => {
                    if levels.iter().all(|level| level.bends.is_empty()) {
                        self.bend(&mut levels, &tangents);
                    }
                    damping = (GROWTH * damping).max(DAMPING);
                    if damping > MOST {
                        break;
                    }
                }
            }
            if length <= end {
                break;
            }
        }
        Some(tangents * free)
    }

    /// Moves to a place if the wishes are met better there, and returns what is known there.
    fn accepted(
        &mut self,
        q: Vec<f64>,
        free: DMatrix<f64>,
        before: &[f64],
        share: f64,
    ) -> Option<Accepted> {
        let tangents = self.manifold.tangents(&q)?;
        let kept = std::mem::replace(&mut self.q, q);
        self.note();
        let levels = self.levels_at(&tangents, share);
        let after: Vec<f64> = levels.iter().map(Level::distance).collect();
        if is_better(&after, before) {
            return Some(Accepted { levels, tangents, free });
        }
        self.q = kept;
        self.note();
        None
    }

    /// Makes one step that keeps the limits. Returns the position, the length of the step, and the
    /// directions that it left free. Returns `None` if the step strays too far.
    fn step(
        &mut self,
        tangents: &DMatrix<f64>,
        levels: &[Level],
        share: f64,
        damping: f64,
    ) -> Option<(Vec<f64>, f64, DMatrix<f64>)> {
        let mut at_end: Vec<(usize, f64)> = Vec::new();
        for _ in 0..=self.bounds.len() {
            let bounds = self.bounds_at(&at_end, tangents, levels);
            let all: Vec<&Level> = bounds.iter().chain(levels).collect();
            let (mut y, free) = levels::step(&all, tangents.ncols(), damping);
            let length = y.norm();
            if length > REACH {
                y *= REACH / length;
            }
            let dq = tangents * &y;
            let sizes = &self.manifold.measures.sizes;
            let step = dq.iter().zip(sizes).map(|(dq, size)| dq * size);
            let ahead: Vec<f64> = self.q.iter().zip(step).map(|(q, dq)| q + dq).collect();
            let mut q = ahead.clone();
            if !self.restore(&mut q, levels, &at_end, share) {
                return None;
            }
            let strayed = self.manifold.length(q.iter().zip(&ahead).map(|(q, ahead)| q - ahead));
            if strayed > STRAY * length.min(REACH) + MET {
                return None;
            }
            let passed = self.passed(&q, &at_end);
            if passed.is_empty() {
                return Some((q, length, free));
            }
            at_end.extend(passed);
        }
        None
    }

    /// Takes q back to the equations, to the limits at their ends and to the wishes that are met.
    fn restore(
        &mut self,
        q: &mut [f64],
        levels: &[Level],
        at_end: &[(usize, f64)],
        share: f64,
    ) -> bool {
        let Descent { manifold, bounds, levels: goals, .. } = self;
        let ends =
            at_end.iter().map(|(k, end)| Held { goal: &bounds[*k].goal, target: vec![*end] });
        let mut held: Vec<Held<'_>> = ends.collect();
        let met = levels.iter().zip(goals).take_while(|(level, _)| level.distance() <= MET);
        for (goal, target) in met.flat_map(|(_, goals)| goals.iter()) {
            held.push(Held { goal, target: part_of(goal, target, share) });
        }
        manifold.restore(q, |manifold, q| {
            if held.is_empty() {
                return Some(0.0);
            }
            let tangents = manifold.tangents(q)?;
            let level = level(manifold, q, &tangents, held.iter().map(|h| (h.goal, &h.target[..])));
            let (y, _) = levels::step(&[&level], tangents.ncols(), 0.0);
            let dq = &tangents * &y;
            let step = dq.iter().zip(&manifold.measures.sizes).map(|(dq, size)| dq * size);
            q.iter_mut().zip(step).for_each(|(q, dq)| *q += dq);
            Some(y.norm())
        })
    }

    /// Returns the limits that a position passes, each with its end.
    fn passed(&self, q: &[f64], known: &[(usize, f64)]) -> Vec<(usize, f64)> {
        let Manifold { model, t, .. } = &self.manifold;
        let mut all = Vec::new();
        for (k, Bound { goal, ends: [low, high] }) in self.bounds.iter().enumerate() {
            let Some(&value) = goal.values(model, *t, q).first() else { continue };
            let tolerance = MET * goal.scale;
            let end = if value < low - tolerance {
                *low
            } else if value > high + tolerance {
                *high
            } else {
                continue;
            };
            if !known.iter().any(|(known, _)| *known == k) {
                all.push((k, end));
            }
        }
        all
    }

    /// Returns the limits at whose ends the position is, by their places.
    pub(crate) fn at_bounds(&self) -> Vec<usize> {
        let is_at_end = |bound: &Bound| {
            let value = bound.goal.now.first().copied().unwrap_or(f64::NAN);
            let near = |end: &f64| (value - end).abs() <= 2.0 * MET * bound.goal.scale;
            bound.ends.iter().any(near)
        };
        (0..self.bounds.len()).filter(|k| is_at_end(&self.bounds[*k])).collect()
    }

    /// Returns the limits at their ends as a level before all others, with its curvature if the
    /// others have theirs.
    fn bounds_at(
        &mut self,
        at_end: &[(usize, f64)],
        tangents: &DMatrix<f64>,
        levels: &[Level],
    ) -> Vec<Level> {
        if at_end.is_empty() {
            return Vec::new();
        }
        let Descent { manifold, bounds, q, .. } = self;
        let ends: Vec<(&Goal, [f64; 1])> =
            at_end.iter().map(|(k, end)| (&bounds[*k].goal, [*end])).collect();
        let mut level =
            level(manifold, q, tangents, ends.iter().map(|(goal, end)| (*goal, &end[..])));
        let is_curved = levels.iter().any(|level| !level.bends.is_empty());
        if is_curved && manifold.tangents(q).is_some() {
            let goals = ends.iter().map(|(goal, _)| *goal);
            level.bends = bends(manifold, q, tangents, goals).unwrap_or_default();
        }
        vec![level]
    }

    /// Returns the levels at the present position, without their curvature.
    fn levels_at(&self, tangents: &DMatrix<f64>, share: f64) -> Vec<Level> {
        let Descent { manifold, levels, q, .. } = self;
        let at = |goals: &Goals| {
            let targets: Vec<Vec<f64>> =
                goals.iter().map(|(goal, target)| part_of(goal, target, share)).collect();
            let pairs = goals.iter().zip(&targets).map(|((goal, _), target)| (goal, &target[..]));
            level(manifold, q, tangents, pairs)
        };
        levels.iter().map(at).collect()
    }

    /// Adds the curvature to the levels at the present position.
    fn bend(&mut self, levels: &mut [Level], tangents: &DMatrix<f64>) {
        let Descent { manifold, levels: goals, q, .. } = self;
        if tangents.ncols() > CURVED || manifold.tangents(q).is_none() {
            return;
        }
        for (level, goals) in levels.iter_mut().zip(goals.iter()) {
            let goals = goals.iter().map(|(goal, _)| goal);
            level.bends = bends(manifold, q, tangents, goals).unwrap_or_default();
        }
    }

    /// Stores the present values, by which angles keep their whole turns.
    fn note(&mut self) {
        let Descent { manifold: Manifold { model, t, .. }, levels, bounds, q } = self;
        let goals = levels.iter_mut().flatten().map(|(goal, _)| goal);
        let bounds = bounds.iter_mut().map(|bound| &mut bound.goal);
        goals.chain(bounds).for_each(|goal| goal.now = goal.values(model, *t, q));
    }
}

/// Returns the target at a share of the way from the start.
fn part_of(goal: &Goal, target: &[f64], share: f64) -> Vec<f64> {
    if share == 1.0 {
        return target.to_vec();
    }
    goal.start.iter().zip(target).map(|(from, to)| from + share * (to - from)).collect()
}

/// Returns true if the distances are smaller, the first ones first. Rounding counts as no change.
fn is_better(after: &[f64], before: &[f64]) -> bool {
    /// Distances that differ by less than this share, or by this much, are the same. \[-\]
    const SHARE: f64 = 1e-13;
    const SAME: f64 = 1e-12;
    for (after, before) in after.iter().zip(before) {
        if *after > before * (1.0 + SHARE) + SAME {
            return false;
        }
        if *after < before * (1.0 - SHARE) - SAME {
            return true;
        }
    }
    true
}

/// Returns goals as one level at a position.
fn level<'g>(
    manifold: &Manifold<'_>,
    q: &[f64],
    tangents: &DMatrix<f64>,
    goals: impl Iterator<Item = (&'g Goal, &'g [f64])>,
) -> Level {
    let Manifold { model, t, measures, .. } = manifold;
    let freedoms = tangents.ncols();
    let still = vec![0.0; q.len()];
    let directions: Vec<Vec<f64>> = (0..freedoms)
        .map(|k| tangents.column(k).iter().zip(&measures.sizes).map(|(x, s)| x * s).collect())
        .collect();
    let mut residual = Vec::new();
    let mut slopes: Vec<f64> = Vec::new();
    for (goal, target) in goals {
        let values = goal.values(model, *t, q);
        residual.extend(values.iter().zip(target).map(|(value, to)| (to - value) / goal.scale));
        let along: Vec<Vec<[f64; 3]>> =
            directions.iter().map(|v| goal.orders(model, *t, q, v, &still)).collect();
        for row in 0..values.len() {
            slopes.extend(along.iter().map(|orders| orders[row][1] / goal.scale));
        }
    }
    let rows = residual.len();
    Level {
        residual: DVector::from_vec(residual),
        slopes: DMatrix::from_row_slice(rows, freedoms, &slopes),
        bends: Vec::new(),
    }
}

/// Returns the second derivatives of each value along the surface of positions, by pairs of
/// tangents.
fn bends<'g>(
    manifold: &mut Manifold<'_>,
    q: &[f64],
    tangents: &DMatrix<f64>,
    goals: impl Iterator<Item = &'g Goal>,
) -> Option<Vec<DMatrix<f64>>> {
    let freedoms = tangents.ncols();
    let sizes = manifold.measures.sizes.clone();
    let goals: Vec<&Goal> = goals.collect();
    let mut along = |direction: DVector<f64>| -> Option<Vec<f64>> {
        let v: Vec<f64> = direction.iter().zip(&sizes).map(|(x, size)| x * size).collect();
        let a = manifold.bend(q, &v)?;
        let Manifold { model, t, .. } = manifold;
        let of_goal = |goal: &&Goal| {
            let scale = goal.scale;
            let orders = goal.orders(model, *t, q, &v, &a);
            orders.into_iter().map(move |order| order[2] / scale)
        };
        Some(goals.iter().flat_map(of_goal).collect())
    };
    let mut own = Vec::with_capacity(freedoms);
    for k in 0..freedoms {
        own.push(along(tangents.column(k).into_owned())?);
    }
    let rows = own.first().map_or(0, Vec::len);
    let mut all = vec![DMatrix::zeros(freedoms, freedoms); rows];
    for j in 0..freedoms {
        for k in 0..j {
            let both = along(tangents.column(j) + tangents.column(k))?;
            for row in 0..rows {
                let mixed = 0.5 * (both[row] - own[j][row] - own[k][row]);
                all[row][(j, k)] = mixed;
                all[row][(k, j)] = mixed;
            }
        }
        for row in 0..rows {
            all[row][(j, j)] = own[j][row];
        }
    }
    Some(all)
}
