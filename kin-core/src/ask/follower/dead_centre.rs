//! Runs that begin or end at a dead centre of their driver, where the driver is at rest.
//!
//! At a dead centre C_q is singular, but the curve of positions through (q, u) is regular, where u
//! is the value of the driver. Its arc length s follows from u(s) = f(t): with u′ = 0 there,
//! ṡ² = f̈ / u″ and s̈ = (f⃛ − u‴ ṡ³) / (3 u″ ṡ). So q̇ = q′ ṡ and q̈ = q″ ṡ² + q′ s̈ are finite if
//! the law comes to rest there, with an acceleration that is not zero.

use super::small::Small;
use super::{Follower, drivers};
use crate::ask::diagnosis::explain::EXPLAIN;
use crate::law::Law;
use crate::outcome::error::surface::Surface;
use crate::outcome::error::{Error, FailureKind, Result};
use crate::outcome::motion::{Branch, Motion, SingularKind, SingularPosition};
use crate::outcome::words::{list, time as written};
use crate::solve::follow::{Curve, CurvePoint, root};
use crate::solve::newton::{Newton, Outcome, first_position};
use crate::solve::options::SolverOptions;
use crate::solve::run::Run;
use crate::system::System;

/// The value of the driver counts this much less than the coordinates in the length of the curve.
/// \[-\]
const LIGHT: f64 = 1e6;

/// The first step along the curve, the longest and the shortest, and the number of steps. \[-\]
const FIRST: f64 = 0.02;
const LONGEST: f64 = 0.1;
const SHORTEST: f64 = 1e-7;
const STEPS: usize = 2000;

/// A value of the driver that differs by less than this share from that of the dead centre is at
/// the dead centre. \[-\]
const THERE: f64 = 1e-9;

/// A derivative of the law that moves less than this share of the others over a step of time is
/// zero. \[-\]
const STILL: f64 = 1e-9;

/// The first time after a dead centre is at most this far along the curve. \[-\]
const NEAR: f64 = 0.07;

/// The distance of the places from which u‴ is computed. \[-\]
const APART: f64 = 2e-3;

/// A direction in which nothing moves by more than this is none. \[-\]
const MOVES: f64 = 1e-6;

/// The direction in which a run leaves the dead centre at which it begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    name: String,
    sign: f64,
}

impl Start {
    /// States that a coordinate (`rocker.theta`) or the angle of a planar body (`rocker`) grows at
    /// first if `sign` is positive, and falls if it is negative.
    pub fn towards(name: impl Into<String>, sign: impl Into<f64>) -> Self {
        Start { name: name.into(), sign: sign.into() }
    }

    /// Returns the coordinate.
    fn column(&self, system: &System) -> Result<usize> {
        let names = system.coordinate_names();
        let angle = format!("{}.theta", self.name);
        let found = names.iter().position(|known| *known == self.name || *known == angle);
        found.ok_or_else(|| Error::UnknownName {
            what: "coordinate or planar body",
            name: self.name.clone(),
            known: names.to_vec(),
        })
    }
}

/// The beginning of the error that asks for a direction.
const ASKED: &str = "the run begins at a dead centre of";

/// True for the error that asks for a direction.
fn is_asked(error: &Error) -> bool {
    matches!(error, Error::InvalidOptions { reason } if reason.starts_with(ASKED))
}

fn refused(reason: String) -> Error {
    Error::InvalidOptions { reason }
}

/// The only driver that moves, with its law.
struct Moving {
    name: String,
    law: Law,
}

impl Moving {
    /// Finds it. Errors: none or several move; time enters in another way.
    fn of(system: &System, times: &[f64]) -> Result<Self> {
        let [first, ..] = times else { return Err(refused("there is no time".to_string())) };
        let q = system.initial();
        let (all, frozen) = drivers::take(&mut system.clone(), *first, q);
        if !frozen.is_empty() {
            return Err(refused(format!(
                "at a dead centre Kin needs laws of time alone, but {} reads time in another way. \
                 Begin and end the run elsewhere",
                list(&frozen)
            )));
        }
        let equations = system.equations();
        let instant = equations.instant_at(*first, q);
        let mut moving = Vec::new();
        for driver in all {
            let block = &equations.blocks[driver.block];
            let at = equations.at(block, &instant);
            block.constraint.laws(&at, &mut |parameter, law, _| {
                let begin = law.at(*first);
                if parameter == driver.parameter && times.iter().any(|t| law.at(*t) != begin) {
                    moving.push(Moving { name: driver.value.name.clone(), law: law.clone() });
                }
            });
        }
        match moving.pop() {
            Some(only) if moving.is_empty() => Ok(only),
            other => Err(refused(format!(
                "at a dead centre exactly one driver moves, not {}. Keep the others at rest",
                moving.len() + usize::from(other.is_some())
            ))),
        }
    }

    /// Returns f, ḟ, f̈, f⃛ and f⁗ at a time. Derivatives that move next to nothing over the time
    /// `h` are zero.
    fn jet(&self, t: f64, h: f64) -> [f64; 5] {
        let [value, a, b, c] = self.law.jet(t);
        let d = self.law.fourth(t);
        let parts = [a * h, b * h * h / 2.0, c * h.powi(3) / 6.0, d * h.powi(4) / 24.0];
        let largest = parts.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let kept = |x: f64, part: f64| if part.abs() <= STILL * largest { 0.0 } else { x };
        [value, kept(a, parts[0]), kept(b, parts[1]), kept(c, parts[2]), kept(d, parts[3])]
    }
}

/// A dead centre, with the curve of positions through it.
struct Centre<'a> {
    curve: Curve<'a>,
    place: CurvePoint,
}

/// q̇ and q̈ at a dead centre.
type Rates = [Vec<f64>; 2];

/// Returns a follower at a position of the system at time t, whose named driver has the value t at
/// time t.
fn running(
    system: &System,
    options: &SolverOptions,
    (t, q): (f64, &[f64]),
    name: &str,
) -> Result<(Follower, f64)> {
    let mut system = system.clone();
    let (drivers, frozen) = drivers::take(&mut system, t, q);
    let mut own = Follower {
        system,
        options: options.clone(),
        t0: t,
        drivers,
        frozen,
        q: q.to_vec(),
        regular: None,
        whole: None,
        small: Small::default(),
    };
    let value = own.let_run(name)?.value;
    Ok((own, value))
}

impl<'a> Centre<'a> {
    /// Walks from the position of the follower, at this value of the driver that runs, to the dead
    /// centre at the value `goal`. Returns `None` if there is none.
    fn find(own: &'a Follower, value: f64, goal: f64) -> Option<Self> {
        let mut newton = Newton::new(&own.system, &own.options);
        newton.q.copy_from_slice(&own.q);
        first_position::resume(&mut newton, value).ok()?;
        let mut curve = Curve::new(&own.system, &newton.sizes, LIGHT).without_blocks();
        let sign = (goal - value).signum();
        let along: Vec<f64> = newton.qd.iter().chain([&1.0]).map(|x| sign * x).collect();
        let x = newton.q.iter().copied().chain([value]).collect();
        let mut here = curve.place(x, &along)?;
        let near = THERE * goal.abs().max((goal - value).abs()).max(1.0);
        let mut s = FIRST;
        for _ in 0..STEPS {
            let Some(next) = curve.step(&here, s) else {
                s *= 0.5;
                if s < SHORTEST {
                    return None;
                }
                continue;
            };
            if here.dt() * next.dt() <= 0.0 {
                let turn = root((0.0, here.dt()), (s, next.dt()), 0.0, |s| {
                    Some(curve.at(&here, s)?.0.dt())
                })?;
                let (place, _) = curve.at(&here, turn)?;
                return ((place.t() - goal).abs() <= near).then_some(Centre { curve, place });
            }
            if sign * (next.t() - goal) > near {
                return None;
            }
            here = next;
            s = (1.4 * s).min(LONGEST);
        }
        None
    }

    /// Returns the place at a distance along the curve.
    fn at(&mut self, s: f64) -> Option<CurvePoint> {
        Some(self.curve.at(&self.place, s)?.0)
    }

    /// Returns u″ and u‴ by the arc length.
    fn bends(&mut self) -> Option<[f64; 2]> {
        let bend = |place: &CurvePoint| place.ddx.last().copied().unwrap_or_default();
        let second = bend(&self.place);
        let mut slope = |h: f64| Some((bend(&self.at(h)?) - bend(&self.at(-h)?)) / (2.0 * h));
        let third = (4.0 * slope(APART)? - slope(2.0 * APART)?) / 3.0;
        (second != 0.0).then_some([second, third])
    }

    /// Returns ṡ and s̈ if the law has these derivatives while it passes. `sense` is 1 if the
    /// position moves along the tangent and −1 if it moves against it; `leaves` is false where a
    /// run ends.
    ///
    /// Errors: velocities or accelerations have no bound; the law leads beyond the dead centre.
    fn speeds(
        &mut self,
        moving: &Moving,
        (t, jet): (f64, [f64; 5]),
        (sense, leaves): (f64, bool),
    ) -> Result<[f64; 2]> {
        let name = &moving.name;
        let t = written(t);
        let unbounded = |what: &str| {
            Err(refused(format!(
                "`{name}` is at a dead centre at t = {t}. There the {what} of the other links have \
                 no bound, because the law of `{name}` does not come to rest smoothly. Give a law \
                 with velocity zero and an acceleration other than zero"
            )))
        };
        let Some([second, third]) = self.bends() else { return unbounded("accelerations") };
        let [_, first, force, jerk, fourth] = jet;
        if first != 0.0 {
            return unbounded("velocities");
        }
        let beyond = || {
            Err(refused(format!(
                "`{name}` moves beyond its dead centre at t = {t}, where no position exists. Let \
                 the law turn the other way"
            )))
        };
        if force != 0.0 {
            if force / second <= 0.0 {
                return beyond();
            }
            let speed = sense * (force / second).sqrt();
            return Ok([speed, (jerk - third * speed.powi(3)) / (3.0 * second * speed)]);
        }
        if jerk != 0.0 || !fourth.is_finite() {
            return unbounded("accelerations");
        }
        if fourth / second < 0.0 {
            return beyond();
        }
        let side = if leaves { sense } else { -sense };
        Ok([0.0, side * 2.0 * (fourth / (12.0 * second)).sqrt()])
    }

    /// Returns q̇ and q̈ at these ṡ and s̈.
    fn rates(&self, [speed, gain]: [f64; 2]) -> Rates {
        let CurvePoint { x, dx, ddx, .. } = &self.place;
        let n = x.len() - 1;
        let qd = dx[..n].iter().map(|dx| dx * speed).collect();
        let qdd = dx[..n].iter().zip(ddx).map(|(dx, ddx)| ddx * speed * speed + dx * gain);
        [qd, qdd.collect()]
    }

    /// Returns the dead centre as a singular position of the system at time t.
    fn singular(&self, system: &System, t: f64, [qd, qdd]: &Rates) -> SingularPosition {
        let q = &self.place.x[..self.place.x.len() - 1];
        let (movable, dependent) = match system.singular(t, q, None).kind() {
            Some(FailureKind::SingularAt { movable, dependent, .. }) => {
                (movable.clone(), dependent.clone())
            }
            _ => Default::default(),
        };
        let branches = vec![Branch { qd: qd.clone(), qdd: qdd.clone() }];
        let kind = SingularKind::TurningPoint;
        SingularPosition { t, kind, q: q.to_vec(), movable, dependent, branches }
    }
}

const NO_STEPS: Outcome = Outcome { iterations: 0, residual: 0.0 };

/// Runs from a dead centre, at the first of the times, in the stated direction. Without one, the
/// error asks for it. Returns `None` if the run does not begin at a dead centre.
pub(in crate::ask) fn begun(
    system: &System,
    options: &SolverOptions,
    times: &[f64],
    start: Option<&Start>,
) -> Result<Option<Motion>> {
    let &[t0, t1, ..] = times else { return Ok(None) };
    let column = start.map(|start| start.column(system)).transpose()?;
    if system.is_redundant() || options.jerk {
        return Ok(None);
    }
    let moving = Moving::of(system, times)?;
    let solver = system.solver().options(options.clone());
    let aside = (0..12).find_map(|k| {
        let t = t0 + (t1 - t0) * 0.5_f64.powi(k);
        solver.position(t).ok()
    });
    let Some(aside) = aside else { return Ok(None) };
    let (own, value) = running(system, options, (aside.t, &aside.q), &moving.name)?;
    let jet = moving.jet(t0, t1 - t0);
    let Some(mut centre) = Centre::find(&own, value, jet[0]) else { return Ok(None) };
    let names = system.coordinate_names();
    let moves = |k: usize| (centre.place.dx[k] / centre.curve.sizes[k]).abs() > MOVES;
    let can: Vec<String> =
        (0..names.len()).filter(|k| moves(*k)).map(|k| names[k].clone()).collect();
    let (Some(start), Some(column)) = (start, column) else {
        return Err(refused(format!(
            "{ASKED} `{}` at t = {}, from which two motions lead. Say \
             which way one of {} moves at first, such as {}",
            moving.name,
            written(t0),
            list(&can),
            Surface::chosen().start(can.first().map_or("", String::as_str)),
        )));
    };
    if !moves(column) || start.sign == 0.0 || !start.sign.is_finite() {
        return Err(refused(format!(
            "`{}` gives no direction at the dead centre of `{}` at t = {}, because it does not \
             move there at first. Name one of {} with a positive or negative sign",
            start.name,
            moving.name,
            written(t0),
            list(&can)
        )));
    }
    let sense = (centre.place.dx[column] * start.sign).signum();
    let speeds = centre.speeds(&moving, (t0, jet), (sense, true))?;
    let rates = centre.rates(speeds);
    let mut motion = Motion::new(system, times.len());
    let q = centre.place.x[..names.len()].to_vec();
    motion.append(t0, [&q, &rates[0], &rates[1], &[]], NO_STEPS, 0);
    motion.add_singular(centre.singular(system, t0, &rates));
    let Some((t, q)) = centre.after(&moving, [t0, t1], sense) else { return Ok(None) };
    let mut run = Run::new(system, options, Some(EXPLAIN))?;
    let mut reached = run.begin_from(t, &q);
    let mut rest = &times[1..];
    if reached.is_ok() && t == t1 {
        reached = solver.solve_at(t1, &q).map(|found| {
            motion.append(t1, [&found.q, &found.qd, &found.qdd, &[]], NO_STEPS, 0);
        });
        rest = &times[2..];
    }
    let reached = reached.and_then(|()| rest.iter().try_for_each(|t| run.reach(*t, &mut motion)));
    match reached {
        Ok(()) => Ok(Some(motion)),
        Err(error) => Err(run.failed(error, motion)),
    }
}

impl Centre<'_> {
    /// Returns a time between both, the later one if possible, and the position there, a little
    /// along the curve.
    fn after(
        &mut self,
        moving: &Moving,
        [t0, t1]: [f64; 2],
        sense: f64,
    ) -> Option<(f64, Vec<f64>)> {
        let centre = self.place.t();
        let bend = self.place.ddx.last().copied()?;
        for k in 0..60 {
            let t = t0 + (t1 - t0) * 0.5_f64.powi(k);
            let value = moving.law.at(t);
            let s = 1.2 * (2.0 * (value - centre) / bend).sqrt();
            if !(s > 0.0 && s <= NEAR) {
                continue;
            }
            let end = self.at(sense * s)?.t() - value;
            let found = root((0.0, centre - value), (s, end), 0.0, |s| {
                Some(self.at(sense * s)?.t() - value)
            })?;
            let mut x = self.at(sense * found)?.x;
            x.pop();
            return Some((t, x));
        }
        None
    }
}

/// Builds the error of a run with a direction that begins elsewhere.
pub(in crate::ask) fn elsewhere(times: &[f64]) -> Error {
    let place = match times {
        [first, _, ..] => {
            format!("the run does not begin at a dead centre at t = {}", written(*first))
        }
        _ => "a run from a dead centre has at least two times".to_string(),
    };
    refused(format!(
        "{place}, so a direction of the start has no meaning. Leave it out; it also has none with \
         redundant equations or with the jerk"
    ))
}

/// Returns what becomes of a run that fails where it begins or where it ends, if that is a dead
/// centre.
pub(in crate::ask) fn at_an_end(
    system: &System,
    options: &SolverOptions,
    times: &[f64],
    error: Error,
) -> Result<Motion> {
    let done = error.motion().map_or(0, Motion::len);
    let is_singular = matches!(
        error.kind(),
        Some(
            FailureKind::SingularAt { .. }
                | FailureKind::Toggle { .. }
                | FailureKind::NoConvergence { .. }
                | FailureKind::CannotFollow { .. }
        )
    );
    if !is_singular {
        return Err(error);
    }
    if done == 0 {
        return match begun(system, options, times, None) {
            // It asks for the direction.
            Err(asked @ Error::InvalidOptions { .. }) if times.len() > 1 => {
                if is_asked(&asked) {
                    Err(asked)
                } else {
                    Err(error)
                }
            }
            _ => Err(error),
        };
    }
    let ended = error.motion().and_then(|before| ended(system, options, times, before));
    ended.ok_or(error)
}

/// Adds the last of the times to a run that has reached all others, if it is a dead centre at which
/// the driver comes to rest. Returns `None` if it is not.
pub(in crate::ask) fn ended(
    system: &System,
    options: &SolverOptions,
    times: &[f64],
    before: &Motion,
) -> Option<Motion> {
    let [.., t0, t1] = *times else { return None };
    if before.len() + 1 != times.len() || system.is_redundant() || options.jerk {
        return None;
    }
    let moving = Moving::of(system, times).ok()?;
    let q = before.q(before.len() - 1);
    let (own, value) = running(system, options, (t0, q), &moving.name).ok()?;
    let jet = moving.jet(t1, t1 - t0);
    let mut centre = Centre::find(&own, value, jet[0])?;
    let speeds = centre.speeds(&moving, (t1, jet), (1.0, false)).ok()?;
    let speeds = if t1 < t0 { [-speeds[0], speeds[1]] } else { speeds };
    let rates = centre.rates(speeds);
    let mut motion = before.clone();
    let q = &centre.place.x[..q.len()];
    motion.append(t1, [q, &rates[0], &rates[1], &[]], NO_STEPS, 0);
    motion.add_singular(centre.singular(system, t1, &rates));
    Some(motion)
}
