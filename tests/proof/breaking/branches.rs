//! Equations with several solutions near one another, by jumps within the tube or without any;
//! conditions that the last bit decides.

use super::{Case, lengths, moved};
use crate::wide::{Wide, w};
use kin::prelude::*;

#[constraint]
fn gated(x: Coord, t: Time, c: f64, d: f64) -> f64 {
    (if x > c { x - d } else { x }) - t
}

#[constraint]
fn stepped(x: Coord, t: Time, c: f64, d: f64) -> f64 {
    x - d * (x - c).floor() - t
}

#[constraint]
fn wrapped(x: Coord, t: Time, c: f64) -> f64 {
    x % c - t
}

#[constraint]
fn folded_back(x: Coord, y: Coord, t: Time, c: f64) -> [f64; 2] {
    [x + y - t, y - if x > c { 1.0 } else { 0.0 }]
}

#[constraint]
fn squared(x: Coord, c: f64, t: Time) -> f64 {
    x * x - c * c * (1.0 + t)
}

#[constraint]
fn cubed(x: Coord, c: f64, t: Time) -> f64 {
    x * x * x - c * c * x - c * c * c * t * 0.25
}

#[constraint]
fn root_of(x: Coord, c: f64) -> f64 {
    x * x - c
}

#[constraint]
fn decided(x: Coord, z: Coord, at: f64) -> f64 {
    z - if x >= at { 1.0 } else { 0.0 }
}

#[constraint]
fn decided_by_step(x: Coord, z: Coord) -> f64 {
    z - (x * x).floor()
}

#[constraint]
fn decided_by_both(x: Coord, z: Coord, at: f64) -> f64 {
    z - if x >= at && x * 2.0 < 3.0 * at { 1.0 } else { 0.0 }
}

#[constraint]
fn decided_by_sign(x: Coord, z: Coord, at: f64) -> f64 {
    z - (x - at).signum()
}

#[constraint]
fn decided_by_rest(x: Coord, z: Coord, at: f64) -> f64 {
    z - x % at
}

/// x − d ⌊x > c⌋ = t has the solutions x = t where that is not above c, and x = t + d where that
/// is.
fn gates() -> Vec<Case> {
    let mut all = Vec::new();
    for (c, d, from, to, honest) in [
        (1.0, 0.3, 0.0, 0.94, false),
        (1.0, 0.3, 0.0, 0.6, false),
        (1.0, 0.01, 0.9, 0.98, false),
        (1.0, 1e-5, 0.9, 0.999, false),
        (1.0, -0.3, 0.0, 0.94, true),
        (5.0, 0.3, 0.0, 0.9, true),
        (-1.0, 0.2, 0.0, 1.0, true),
        (1.0, 0.3, 0.69, 0.71, false),
    ] {
        let solutions = move |t: &Wide| {
            let low = t.clone();
            let high = t + d;
            let mut found = Vec::new();
            if low <= c {
                found.push((0, vec![low]));
            }
            if high > c {
                found.push((1, vec![high]));
            }
            found
        };
        let start = if from + d > c && from > c { from + d } else { from };
        let system = lengths([start], |m, [x]| m.add("c", gated(x, c, d)).map(|_| ()));
        for steps in [1, 5] {
            let Some(motion) = moved(&system, &linspace(from, to, steps + 1)) else { continue };
            let name = format!("gate at {c} by {d} from {from} to {to} in {steps}");
            let system = lengths([start], |m, [x]| m.add("c", gated(x, c, d)).map(|_| ()));
            all.push(Case { name, honest, system, motion, solutions: Box::new(solutions) });
        }
    }
    all
}

/// x − d ⌊x − c⌋ = t: one solution for each whole number n with n ≤ x − c < n + 1.
fn stairs() -> Vec<Case> {
    let of = |c: f64, d: f64| {
        move |t: &Wide| {
            let whole = (-6..6).filter_map(|n| {
                let x = t + w(d) * w(f64::from(n));
                ((&x - c).floor() == f64::from(n)).then(|| ((n + 6) as usize, vec![x]))
            });
            whole.collect::<Vec<_>>()
        }
    };
    let mut all = Vec::new();
    for (c, d, from, to) in
        [(0.0, 0.9, 0.2, 0.7), (0.0, 1.0, 0.1, 0.8), (0.5, 0.5, 0.6, 0.9), (0.0, 1.1, 0.3, 0.6)]
    {
        let system = lengths([from], |m, [x]| m.add("c", stepped(x, c, d)).map(|_| ()));
        let Some(motion) = moved(&system, &[from, to]) else { continue };
        all.push(Case {
            name: format!("stairs {c} {d}"),
            honest: false,
            system,
            motion,
            solutions: Box::new(of(c, d)),
        });
    }
    all
}

/// x less its whole multiples of c: one solution for each of them.
fn rests() -> Vec<Case> {
    let mut all = Vec::new();
    for (c, from, to) in [(1.0, 0.1, 0.9), (1.0, 0.4, 0.6), (0.01, 0.001, 0.009)] {
        let solutions = move |t: &Wide| {
            (0..5).map(|n| (n as usize, vec![t + w(c) * w(f64::from(n))])).collect::<Vec<_>>()
        };
        let system = lengths([from], |m, [x]| m.add("c", wrapped(x, c)).map(|_| ()));
        let Some(motion) = moved(&system, &linspace(from, to, 3)) else { continue };
        all.push(Case {
            name: format!("rest after {c}"),
            honest: false,
            system,
            motion,
            solutions: Box::new(solutions),
        });
    }
    all
}

/// A line that goes on from a unit earlier beyond c.
fn folds() -> Vec<Case> {
    let mut all = Vec::new();
    for (c, from, to, honest) in
        [(0.5, 0.0, 0.45, false), (0.5, 0.1, 0.2, false), (2.0, 0.0, 0.9, true)]
    {
        let solutions = move |t: &Wide| {
            let low = t.clone();
            let high = t - 1.0;
            let mut found = Vec::new();
            if low <= c {
                found.push((0, vec![low, w(0.0)]));
            }
            if high > c {
                found.push((1, vec![high, w(1.0)]));
            }
            found
        };
        let system = lengths([from, 0.0], |m, [x, y]| m.add("c", folded_back(x, y, c)).map(|_| ()));
        let Some(motion) = moved(&system, &[from, to]) else { continue };
        all.push(Case {
            name: format!("folded back at {c}"),
            honest,
            system,
            motion,
            solutions: Box::new(solutions),
        });
    }
    all
}

/// Two solutions c apart, and three.
fn near_one_another() -> Vec<Case> {
    let mut all = Vec::new();
    for c in [1.0, 1e-3, 1e-6, 1e-9, 1e3] {
        let solutions = move |t: &Wide| {
            let x = w(c) * (1.0 + t).sqrt();
            vec![(0, vec![x.clone()]), (1, vec![-x])]
        };
        let system = lengths([c], |m, [x]| m.add("c", squared(x, c)).map(|_| ()));
        if let Some(motion) = moved(&system, &linspace(0.0, 1.0, 5)) {
            all.push(Case {
                name: format!("two solutions {c} apart"),
                honest: true,
                system,
                motion,
                solutions: Box::new(solutions),
            });
        }
        // x³ − c² x = c³ t/4 by Newton's method from each root
        let solutions = move |t: &Wide| {
            let root = |k: usize| {
                let mut y = w([0.0, 1.0, -1.0][k]);
                for _ in 0..10 {
                    let f = &y * &y * &y - &y - 0.25 * t;
                    y = &y - f / (3.0 * (&y * &y) - 1.0);
                }
                (k, vec![w(c) * y])
            };
            (0..3).map(root).collect::<Vec<_>>()
        };
        for start in [0.0, c, -c] {
            let system = lengths([start], |m, [x]| m.add("c", cubed(x, c)).map(|_| ()));
            if let Some(motion) = moved(&system, &linspace(0.0, 1.0, 6)) {
                let name = format!("three solutions {c} apart, from {start}");
                all.push(Case {
                    name,
                    honest: true,
                    system,
                    motion,
                    solutions: Box::new(solutions),
                });
            }
        }
    }
    all
}

type Adds = fn(&mut Mechanism, Coordinate, Coordinate, f64) -> kin::Result<()>;
type Decision = fn(&Wide, &Wide) -> Wide;

/// x² = c, and a z that jumps where x is the f64 next to √c: which side x is on is not for f64 to
/// say.
fn last_bits() -> Vec<Case> {
    let kinds: [(&str, Adds, Decision); 5] = [
        (
            "branch",
            |m, x, z, at| m.add("z", decided(x, z, at)).map(|_| ()),
            |x, at| w(if x >= at { 1.0 } else { 0.0 }),
        ),
        (
            "step",
            |m, x, z, _| m.add("z", decided_by_step(x, z)).map(|_| ()),
            |x, _| {
                // x² is a whole number here
                (x * x).round()
            },
        ),
        (
            "both",
            |m, x, z, at| m.add("z", decided_by_both(x, z, at)).map(|_| ()),
            |x, at| w(if x >= at && 2.0 * x < 3.0 * at { 1.0 } else { 0.0 }),
        ),
        (
            "sign",
            |m, x, z, at| m.add("z", decided_by_sign(x, z, at)).map(|_| ()),
            |x, at| (x - at).signum(),
        ),
        (
            "rest",
            |m, x, z, at| m.add("z", decided_by_rest(x, z, at)).map(|_| ()),
            |x, at| x.rem(at),
        ),
    ];
    let mut all = Vec::new();
    for c in [2.0, 3.0, 5.0, 6.0, 7.0, 10.0, 11.0, 13.0] {
        for (name, add, decision) in kinds {
            let root = w(c).sqrt();
            let at = f64::sqrt(c);
            let z = decision(&root, &w(at));
            // computed at the f64 next to the root
            for guess in [0.0, 1.0, c, c - 1.0, at] {
                let system = lengths([at, guess], |m, [x, z]| {
                    m.add("x", root_of(x, c))?;
                    add(m, x, z, at)
                });
                let Some(motion) = moved(&system, &[0.0]) else { continue };
                let exact = vec![root.clone(), z.clone()];
                let solutions = move |_: &Wide| vec![(0, exact.clone())];
                all.push(Case {
                    name: format!("{name} at the root of {c}"),
                    honest: false,
                    system,
                    motion,
                    solutions: Box::new(solutions),
                });
                break;
            }
        }
    }
    all
}

pub fn cases() -> Vec<Case> {
    [gates(), stairs(), rests(), folds(), near_one_another(), last_bits()]
        .into_iter()
        .flatten()
        .collect()
}
