//! Follows the curve up to the requested time where time cannot be the parameter of the curve.

use super::branching::{self, Branching};
use super::curve::{Curve, CurvePoint};
use super::singular::{self, Scales};
use super::turning;
use crate::outcome::motion::{Branch, SingularKind, SingularPosition};
use crate::solve::newton::Newton;

/// The largest number of steps along the curve.
const STEPS: usize = 4000;

/// The first step along the curve, the longest and the shortest. \[-\]
const FIRST: f64 = 0.01;
const LONGEST: f64 = 0.1;
const SHORTEST: f64 = 1e-8;

/// Loops that turn over within a step of this length do so at once. \[-\]
const TOGETHER: f64 = 1e-4;

/// A smallest pivot that stays above this share of its values at both ends of a step does not reach
/// zero in between. \[-\]
const CLEAR: f64 = 0.25;

/// Times that differ by less than this share of the scale of time are equal. \[-\]
const AT_ONCE: f64 = 1e-7;

/// Closer to a toggle than this, in the scale of time, q has fewer than half of its digits: the run
/// has reached the toggle. \[-\]
const AT_END: f64 = 1e-12;

/// The end of a passage.
pub(crate) enum Landed {
    /// A position near which C_q is regular.
    Regular(Vec<f64>),
    /// A bifurcation, with q, and q̇ and q̈ on the selected branch.
    Singular(Vec<f64>, Branch),
}

/// The result of a passage.
pub(crate) struct Passage {
    pub landed: Landed,
    pub passed: Vec<SingularPosition>,
}

/// The reason why there is no passage.
pub(crate) enum Lost {
    /// Time turns round before the requested time.
    Turned(Box<SingularPosition>),
    /// Kin cannot follow the curve.
    Lost,
}

/// Passes from the position q at time t, with the present velocities, to the time `to`. `other`
/// says for each bifurcation, counted from 0, whether to take the other branch.
///
/// Also returns the number of attempted steps along the curve.
pub(crate) fn pass(
    newton: &Newton<'_>,
    q: &[f64],
    t: f64,
    to: f64,
    other: &dyn Fn(usize) -> bool,
) -> (Result<Passage, Lost>, usize) {
    let mut steps = 0;
    (
        Walk::new(newton, q, t, to, other).ok_or(Lost::Lost).and_then(|walk| walk.go(&mut steps)),
        steps,
    )
}

/// A walk along the curve.
struct Walk<'w, 'a> {
    newton: &'w Newton<'a>,
    curve: Curve<'a>,
    sign: f64,
    to: f64,
    time: f64,
    other: &'w dyn Fn(usize) -> bool,
    here: CurvePoint,
    passed: Vec<SingularPosition>,
}

/// The result of one step along the curve.
enum Stepped {
    On(CurvePoint),
    Landed(Landed),
}

impl<'w, 'a> Walk<'w, 'a> {
    fn new(
        newton: &'w Newton<'a>,
        q: &[f64],
        t: f64,
        to: f64,
        other: &'w dyn Fn(usize) -> bool,
    ) -> Option<Self> {
        let Scales { sizes, time } = singular::scales(newton, q, t, to - t);
        let mut curve = Curve::new(newton.system, &sizes, time);
        let sign = (to - t).signum();
        let along: Vec<f64> = newton.qd.iter().chain([&1.0]).map(|x| sign * x).collect();
        let length = curve.dot(&along, &along).sqrt();
        let along: Vec<f64> = along.iter().map(|x| x / length).collect();
        let x = q.iter().copied().chain([t]).collect();
        let here = curve.place(x, &along)?;
        Some(Walk { newton, curve, sign, to, time, other, here, passed: Vec::new() })
    }

    fn go(mut self, steps: &mut usize) -> Result<Passage, Lost> {
        let mut s = FIRST;
        while *steps < STEPS {
            *steps += 1;
            let stepped =
                self.curve.step(&self.here, s).and_then(|next| self.judge(next, s).transpose());
            match stepped.transpose()? {
                Some(Stepped::On(place)) => {
                    self.here = place;
                    s = (1.5 * s).min(LONGEST);
                }
                Some(Stepped::Landed(landed)) => {
                    return Ok(Passage { landed, passed: self.passed });
                }
                None => s *= 0.5,
            }
            if s < SHORTEST {
                break;
            }
        }
        Err(Lost::Lost)
    }

    /// Returns the result of a step, or `None` if the step must be shorter.
    fn judge(&mut self, next: CurvePoint, s: f64) -> Result<Option<Stepped>, Lost> {
        let turns = self.sign * next.dt() <= 0.0;
        let together = turns && self.turned_over(&next) > 1;
        if next.negative != self.here.negative {
            match branching::find(&mut self.curve, &self.here, &next, s, self.sign) {
                // Time turns round on all branches.
                Some(found) if turns && found.rates.iter().all(Option::is_none) => {
                    return self.turn_together(&next, s);
                }
                Some(found) => return self.cross(found, next, s),
                None if together => return self.turn_together(&next, s),
                None => return Ok(None),
            }
        }
        if together {
            return self.turn_together(&next, s);
        }
        if turns {
            let Some((turn, s)) = turning::locate(&mut self.curve, &self.here, &next, s) else {
                return Ok(None);
            };
            return if self.before(turn.t()) > -AT_END {
                Err(self.turned(&turn.x))
            } else {
                Ok(self.land(&turn, s))
            };
        }
        if let (Some((before, from)), Some((after, to))) = (&self.here.blocks, &next.blocks)
            && before != after
            && before.len() == after.len()
        {
            // The pivot that vanishes on the way changes linearly.
            let at = s * from / (from + to);
            return Ok(if s > self.together() { None } else { self.cross_together(next, s, at) });
        }
        if s > self.together() && self.may_turn_over_twice(&next, s) {
            return Ok(None);
        }
        Ok(self.go_on(next, s, None))
    }

    /// Returns true if C_q may become singular and regular again within a step, which neither end
    /// shows: a driver that reverses leads through a singular position there and back.
    ///
    /// The smallest pivot of the middle and of both ends must not come near zero in between, by the
    /// parabola through these three.
    fn may_turn_over_twice(&mut self, next: &CurvePoint, s: f64) -> bool {
        let (Some((signs, from)), Some((_, to))) = (self.here.blocks.clone(), &next.blocks) else {
            return false;
        };
        let Some((middle, _)) = self.curve.at(&self.here, 0.5 * s) else { return true };
        let Some((signs_between, between)) = middle.blocks else { return true };
        if signs_between != signs {
            return true;
        }
        let slope = 4.0 * between - 3.0 * from - to;
        let bend = 2.0 * (from + to - 2.0 * between);
        let is_lowest_between = slope < 0.0 && slope + 2.0 * bend > 0.0;
        is_lowest_between && from - slope * slope / (4.0 * bend) < CLEAR * from.min(*to)
    }

    /// Returns the number of blocks of C_q that change their sign on the way to a place.
    fn turned_over(&self, next: &CurvePoint) -> usize {
        let (Some((before, _)), Some((after, _))) = (&self.here.blocks, &next.blocks) else {
            return 0;
        };
        before.iter().zip(after).filter(|(before, after)| before != after).count()
    }

    /// Handles several loops whose time turns round at once. The curve is singular there; the place
    /// is found between places on both sides.
    fn turn_together(&self, next: &CurvePoint, s: f64) -> Result<Option<Stepped>, Lost> {
        if s > self.together() {
            return Ok(None);
        }
        let Some(x) = turning::between(&self.here, next, s) else { return Ok(None) };
        if x.last().is_some_and(|t| self.before(*t) > -AT_END) {
            return Err(self.turned(&x));
        }
        Ok(None)
    }

    /// Returns the length of a step within which loops turn over at once. If the origin is far,
    /// shorter steps vanish in rounding.
    fn together(&self) -> f64 {
        TOGETHER.max(self.curve.rounding(&self.here.x).cbrt())
    }

    fn turned(&self, x: &[f64]) -> Lost {
        Lost::Turned(Box::new(self.singular_position(SingularKind::TurningPoint, x, Vec::new())))
    }

    /// Continues past a position, if there is one on the way. A step that must be shorter comes
    /// there again.
    fn go_on(
        &mut self,
        next: CurvePoint,
        s: f64,
        passed: Option<SingularPosition>,
    ) -> Option<Stepped> {
        let stepped =
            if self.before(next.t()) <= 0.0 { self.land(&next, s)? } else { Stepped::On(next) };
        self.passed.extend(passed);
        Some(stepped)
    }

    /// Handles an even number of loops that turn over in a short step: they cannot be
    /// distinguished, and all continue smoothly.
    fn cross_together(&mut self, next: CurvePoint, s: f64, at: f64) -> Option<Stepped> {
        let x = self.here.ahead(at);
        let between = |a: Vec<f64>, b: Vec<f64>| {
            a.iter().zip(&b).map(|(a, b)| a + at / s * (b - a)).collect()
        };
        let [qd, qdd] = self.here.rates();
        let [later, still_later] = next.rates();
        let branch = Branch { qd: between(qd, later), qdd: between(qdd, still_later) };
        let t = x.last().copied()?;
        if self.before(t).abs() <= AT_ONCE {
            let (q, rates) = self.moved(&x, &branch, self.to - t);
            self.passed.push(self.singular_position(SingularKind::Bifurcation, &x, vec![branch]));
            return Some(Stepped::Landed(Landed::Singular(q, rates)));
        }
        let passed = (self.before(t) > 0.0)
            .then(|| self.singular_position(SingularKind::Bifurcation, &x, vec![branch]));
        self.go_on(next, s, passed)
    }

    /// Returns the remaining time before the requested time, in the scale of time. Within rounding
    /// it is zero.
    fn before(&self, t: f64) -> f64 {
        let left = self.sign * (self.to - t) / self.time;
        if left.abs() <= 8.0 * f64::EPSILON * (self.to / self.time).abs() { 0.0 } else { left }
    }

    /// Handles a step that leads to the requested time, or beyond.
    fn land(&mut self, next: &CurvePoint, s: f64) -> Option<Stepped> {
        let place = if self.before(next.t()) == 0.0 {
            next.clone()
        } else {
            turning::at_time(&mut self.curve, &self.here, next, s, self.to)?
        };
        let (_, q) = place.x.split_last()?;
        Some(Stepped::Landed(Landed::Regular(q.to_vec())))
    }

    /// Handles a step that leads through a bifurcation.
    fn cross(
        &mut self,
        found: Branching,
        next: CurvePoint,
        s: f64,
    ) -> Result<Option<Stepped>, Lost> {
        let t = found.x.last().copied().unwrap_or_default();
        let before = self.before(t);
        if before < -AT_ONCE {
            return Ok(self.land(&next, s));
        }
        let turns = (self.other)(self.passed.len()) && found.rates[1].is_some();
        let Branching { x, mut tangents, mut rates } = found;
        if turns {
            tangents.swap(0, 1);
            rates.swap(0, 1);
        }
        let branches: Vec<Branch> = rates.iter().flatten().cloned().collect();
        let taken = rates[0].clone();
        if before <= AT_ONCE {
            let Some(branch) = taken else { return Ok(None) };
            self.passed.push(self.singular_position(SingularKind::Bifurcation, &x, branches));
            let (q, rates) = self.moved(&x, &branch, self.to - t);
            return Ok(Some(Stepped::Landed(Landed::Singular(q, rates))));
        }
        if !turns {
            if self.sign * next.dt() <= 0.0 {
                return Ok(None);
            }
            let passed = self.singular_position(SingularKind::Bifurcation, &x, branches);
            return Ok(self.go_on(next, s, Some(passed)));
        }
        let Some(branch) = taken else { return Ok(None) };
        let Some(place) = self.turn_into(&x, &tangents[0], &branch, s) else { return Ok(None) };
        self.passed.push(self.singular_position(SingularKind::Bifurcation, &x, branches));
        if self.before(place.t()) <= 0.0 {
            let (mut start, _) = self.moved(&x, &branch, self.to - t);
            start.push(self.to);
            let direction = unit_time(start.len());
            self.curve.correct(&mut start, &direction).ok_or(Lost::Lost)?;
            start.pop();
            return Ok(Some(Stepped::Landed(Landed::Regular(start))));
        }
        Ok(Some(Stepped::On(place)))
    }

    /// Returns the place about s beyond a bifurcation on the branch with that tangent.
    fn turn_into(&mut self, x: &[f64], dx: &[f64], branch: &Branch, s: f64) -> Option<CurvePoint> {
        let t = *x.last()?;
        let dt = *dx.last()?;
        let (mut start, _) = self.moved(x, branch, s * dt);
        start.push(t + s * dt);
        let off = self.curve.correct(&mut start, dx)?;
        let place = self.curve.place(start, dx)?;
        (off <= 0.05 * s && self.curve.dot(&place.dx, dx) > 0.9 && self.sign * place.dt() > 0.0)
            .then_some(place)
    }

    /// Returns q and the velocities a time h after the bifurcation on a branch.
    fn moved(&self, x: &[f64], branch: &Branch, h: f64) -> (Vec<f64>, Branch) {
        let q = x
            .iter()
            .zip(branch.qd.iter().zip(&branch.qdd))
            .map(|(x, (qd, qdd))| x + h * (qd + 0.5 * h * qdd))
            .collect();
        let qd = branch.qd.iter().zip(&branch.qdd).map(|(qd, qdd)| qd + h * qdd).collect();
        (q, Branch { qd, qdd: branch.qdd.clone() })
    }

    fn singular_position(
        &self,
        kind: SingularKind,
        x: &[f64],
        branches: Vec<Branch>,
    ) -> SingularPosition {
        let (t, q) = x.split_last().map(|(t, q)| (*t, q)).unwrap_or_default();
        SingularPosition::new(self.newton.system, kind, t, q, branches)
    }
}

/// Returns the direction of time.
fn unit_time(n: usize) -> Vec<f64> {
    let mut direction = vec![0.0; n];
    direction.iter_mut().last().into_iter().for_each(|last| *last = 1.0);
    direction
}

#[cfg(test)]
mod tests;
