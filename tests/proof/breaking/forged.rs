//! Motions that no run made: poses of several branches one after the other, rates that are not
//! theirs, times twice or backwards.

use super::{Case, Solutions, lengths, posed};
use crate::engines::Engines;
use crate::wide::{Wide, w};
use kin::prelude::*;

#[constraint]
fn circle(x: Coord, t: Time, c: f64) -> f64 {
    x * x - c * c * (1.0 + t * t)
}

#[constraint]
fn crossing(x: Coord, t: Time) -> f64 {
    x * x - t * t
}

#[constraint]
fn touching(x: Coord, t: Time) -> f64 {
    (x - t) * (x - t)
}

#[constraint]
fn flat(x: Coord, t: Time) -> f64 {
    x * x * x - t * t * t
}

#[constraint]
fn parabola(x: Coord, t: Time) -> f64 {
    x * x - t
}

/// x = ± c √(1 + t²)
fn two(c: f64) -> impl Fn(&Wide) -> Solutions {
    move |t| {
        let x = w(c) * (1.0 + t * t).sqrt();
        vec![(0, vec![x.clone()]), (1, vec![-x])]
    }
}

fn on(c: f64, side: f64) -> System {
    lengths([side * c], |m, [x]| m.add("c", circle(x, c)).map(|_| ()))
}

/// Poses of both branches, changed by `forge`.
fn forged(
    name: String,
    c: f64,
    times: &[f64],
    honest: bool,
    forge: impl FnOnce(&mut kin::data::MotionData, &kin::data::MotionData),
) -> Option<Case> {
    let [one, other] =
        [1.0, -1.0].map(|side| posed(&on(c, side), times).map(|motion| motion.data()));
    let mut one = one?;
    let other = other?;
    forge(&mut one, &other);
    let motion = Motion::from_data(&one).ok()?;
    Some(Case { name, honest, system: on(c, 1.0), motion, solutions: Box::new(two(c)) })
}

fn joined() -> Vec<Case> {
    let mut all = Vec::new();
    let times = linspace(-0.5, 1.0, 7);
    for c in [1.0, 1e-2, 1e-5, 1e3] {
        // into the other branch, at each time, with its rates or with those of before
        for at in 1..6 {
            all.extend(forged(
                format!("{c}: other branch from {at}"),
                c,
                &times,
                false,
                |one, other| {
                    for (to, from) in [
                        (&mut one.q, &other.q),
                        (&mut one.qd, &other.qd),
                        (&mut one.qdd, &other.qdd),
                    ] {
                        to.splice(at.., from[at..].iter().cloned());
                    }
                },
            ));
            all.extend(forged(
                format!("{c}: other branch at {at} alone"),
                c,
                &times,
                false,
                |one, other| one.q[at] = other.q[at].clone(),
            ));
        }
        // rates that are not its own: the tube is wide, and what is proved is true all the same
        for factor in [0.0, 2.0, -1.0, 1e3, 1e12, 1e200] {
            all.extend(forged(format!("{c}: rates by {factor:e}"), c, &times, false, |one, _| {
                one.qd.iter_mut().chain(&mut one.qdd).flatten().for_each(|rate| *rate *= factor);
            }));
        }
        for off in [1e-12, 1e-6, 0.3, 1.0, 2.0] {
            all.extend(forged(format!("{c}: off by {off:e}"), c, &times, false, |one, _| {
                one.q.iter_mut().flatten().for_each(|q| *q -= off * c)
            }));
        }
        all.extend(forged(format!("{c}: not a number"), c, &times, false, |one, _| {
            one.qd[2] = vec![f64::NAN]
        }));
        all.extend(forged(format!("{c}: infinite"), c, &times, false, |one, _| {
            one.qdd[2] = vec![f64::INFINITY]
        }));
        all.extend(forged(format!("{c}: as it is"), c, &times, true, |_, _| {}));
    }
    // both branches at one time; back in time; the same time twice
    let twice = [0.0, 0.5, 0.5, 1.0];
    all.extend(forged(
        "one time on both branches".to_string(),
        1.0,
        &twice,
        false,
        |one, other| one.q[2..].clone_from_slice(&other.q[2..]),
    ));
    all.extend(forged("back in time".to_string(), 1.0, &[1.0, 0.7, 0.3, -0.5], true, |_, _| {}));
    all
}

/// Singular positions: passed, touched, reached.
fn singular() -> Vec<Case> {
    let mut all = Vec::new();
    let both = |t: &Wide| vec![(0, vec![t.clone()]), (1, vec![-t])];
    for (name, times) in [
        ("crossing", [-0.5, 0.4]),
        ("crossing at its end", [-0.5, 0.0]),
        ("crossing in the middle", [-0.5, 0.5]),
    ] {
        for (from, to) in [(0, 0), (0, 1)] {
            let system = lengths([times[0]], |m, [x]| m.add("c", crossing(x)).map(|_| ()));
            let Some(motion) = posed(&system, &[-0.5, -0.4]) else { continue };
            let mut data = motion.data();
            let x = |t: f64, side: usize| if side == 0 { t } else { -t };
            data.times = times.to_vec();
            data.q = vec![vec![x(times[0], from)], vec![x(times[1], to)]];
            data.qd = vec![vec![x(1.0, from)], vec![x(1.0, to)]];
            data.qdd = vec![vec![0.0]; 2];
            let Ok(motion) = Motion::from_data(&data) else { continue };
            all.push(Case {
                name: format!("{name} {from} {to}"),
                honest: false,
                system,
                motion,
                solutions: Box::new(both),
            });
        }
    }
    let line = |t: &Wide| vec![(0, vec![t.clone()])];
    for (name, system) in [
        ("touching", lengths([0.0], |m, [x]| m.add("c", touching(x)).map(|_| ()))),
        ("flat", lengths([0.0], |m, [x]| m.add("c", flat(x)).map(|_| ()))),
    ] {
        let other = lengths([0.0], |m, [x]| m.add("c", drive(x, Law::ramp(1.0))).map(|_| ()));
        let data = other.run_both(linspace(-1.0, 1.0, 5)).expect("runs").data();
        let mut own = data.clone();
        own.name = system.name().to_string();
        let Ok(motion) = Motion::from_data(&own) else { continue };
        all.push(Case {
            name: name.to_string(),
            honest: false,
            system,
            motion,
            solutions: Box::new(line),
        });
    }
    // x² = t ends at t = 0: beyond it there is nothing
    let system = lengths([1.0], |m, [x]| m.add("c", parabola(x)).map(|_| ()));
    if let Some(motion) = posed(&system, &[1.0, 0.5, 1e-4]) {
        let mut data = motion.data();
        data.times[2] = -1e-4;
        let motion = Motion::from_data(&data).expect("reads");
        let solutions = |t: &Wide| {
            if *t < 0.0 { vec![] } else { vec![(0, vec![t.sqrt()]), (1, vec![-t.sqrt()])] }
        };
        all.push(Case {
            name: "over the end".to_string(),
            honest: false,
            system,
            motion,
            solutions: Box::new(solutions),
        });
    }
    all
}

pub fn cases() -> Vec<Case> {
    joined().into_iter().chain(singular()).collect()
}
