//! Very large and very small numbers, and long times.

use super::{Case, lengths, moved};
use crate::wide::{Wide, w};
use kin::prelude::*;

#[constraint]
fn scaled(x: Coord, t: Time, s: f64) -> f64 {
    s * (x * x) - s * (1.0 + t)
}

#[constraint]
fn of_size(x: Coord, t: Time, s: f64) -> f64 {
    x * x - s * s * (1.0 + t)
}

#[constraint]
fn line_of_size(x: Coord, t: Time, s: f64) -> f64 {
    x - s * (1.0 + t)
}

#[constraint]
fn pair(x: Coord, y: Coord, t: Time, s: f64) -> [f64; 2] {
    [s * x + y / s - 2.0 - t, s * x - y / s + 0.5 * t]
}

#[constraint]
fn wave(x: Coord, t: Time, omega: f64) -> f64 {
    x - (omega * t).sin()
}

#[constraint]
fn whole(x: Coord, t: Time) -> f64 {
    x - t.floor()
}

#[constraint]
fn rest(x: Coord, t: Time, k: f64) -> f64 {
    x - t.rem_euclid(k)
}

#[constraint]
fn since(x: Coord, t: Time, k: f64) -> f64 {
    x - if t < k { 0.0 } else { t - k }
}

fn case(
    name: String,
    honest: bool,
    system: System,
    times: &[f64],
    solutions: impl Fn(&Wide) -> Vec<Vec<Wide>> + 'static,
) -> Option<Case> {
    let motion = moved(&system, times)?;
    let solutions = move |t: &Wide| solutions(t).into_iter().enumerate().collect();
    Some(Case { name, honest, system, motion, solutions: Box::new(solutions) })
}

pub fn cases() -> Vec<Case> {
    [sizes(), waves(), long_times()].into_iter().flatten().collect()
}

/// Equations and coordinates from 1e-150 to 1e150.
fn sizes() -> Vec<Case> {
    let mut all = Vec::new();
    let times = linspace(0.0, 1.0, 5);
    for s in [1e-150, 1e-100, 1e-30, 1e-9, 1.0, 1e9, 1e30, 1e100, 1e150] {
        let root = |t: &Wide| (1.0 + t).sqrt();
        let system = lengths([1.0], |m, [x]| m.add("c", scaled(x, s)).map(|_| ()));
        all.extend(case(format!("an equation of size {s:e}"), true, system, &times, move |t| {
            vec![vec![root(t)], vec![-root(t)]]
        }));
        let system = lengths([s], |m, [x]| m.add("c", of_size(x, s)).map(|_| ()));
        all.extend(case(
            format!("a square of size {s:e}"),
            s.log10().abs() < 120.0,
            system,
            &times,
            move |t| vec![vec![s * root(t)], vec![-(s * root(t))]],
        ));
        let system = lengths([s], |m, [x]| m.add("c", line_of_size(x, s)).map(|_| ()));
        all.extend(case(format!("a line of size {s:e}"), true, system, &times, move |t| {
            vec![vec![s * (1.0 + t)]]
        }));
        let system = lengths([1.0 / s, s], |m, [x, y]| m.add("c", pair(x, y, s)).map(|_| ()));
        all.extend(case(
            format!("coordinates of sizes {s:e} and its inverse"),
            true,
            system,
            &times,
            move |t| vec![vec![(1.0 + 0.25 * t) / w(s), w(s) * (1.0 + 0.75 * t)]],
        ));
    }
    all
}

/// Waves after many turns.
fn waves() -> Vec<Case> {
    let mut all = Vec::new();
    for (start, omega) in
        [(0.0, 1.0), (1e3, 1.0), (1e6, 1.0), (1e9, 1.0), (1e3, 1e3), (1e6, 1e3), (1e12, 1e-9)]
    {
        let system = lengths([0.0], |m, [x]| m.add("c", wave(x, omega)).map(|_| ()));
        let times = linspace(start, start + 1.0 / omega, 9);
        all.extend(case(
            format!("a wave of {omega:e} at {start:e}"),
            start * omega < 1e8,
            system,
            &times,
            move |t| vec![vec![(w(omega) * t).sin()]],
        ));
    }
    all
}

/// Jumps a long time after t = 0.
fn long_times() -> Vec<Case> {
    let mut all = Vec::new();
    for start in [0.0, 1e3, 1e6, 1e9, 1e12] {
        for (from, to, honest) in
            [(0.2, 0.7, true), (0.7, 1.3, false), (0.5, 1.0, false), (1.0, 1.4, false)]
        {
            let times = [start + from, start + to];
            let system = lengths([0.0], |m, [x]| m.add("c", whole(x)).map(|_| ()));
            all.extend(case(
                format!("whole seconds at {start:e} from {from}"),
                honest,
                system,
                &times,
                |t| vec![vec![t.floor()]],
            ));
            let system = lengths([0.0], |m, [x]| m.add("c", rest(x, 1.0)).map(|_| ()));
            all.extend(case(
                format!("what is left at {start:e} from {from}"),
                honest,
                system,
                &times,
                |t| vec![vec![t.fract()]],
            ));
        }
        let k = start + 1.0;
        let system = lengths([0.0], |m, [x]| m.add("c", since(x, k)).map(|_| ()));
        all.extend(case(
            format!("since {k:e}"),
            false,
            system,
            &[start + 0.5, start + 1.5],
            move |t| vec![vec![if *t < k { w(0.0) } else { t - k }]],
        ));
    }
    all
}
