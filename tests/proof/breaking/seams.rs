//! Laws over their seams, at huge arguments, by angles over their cuts, and their slopes.

use super::{Case, lengths, moved, posed};
use crate::wide::{Wide, w};
use kin::prelude::*;

#[constraint]
fn follows(x: Coord, z: Coord, law: Law) -> f64 {
    z - law.at(x)
}

#[constraint]
fn inclined(x: Coord, z: Coord, law: Law) -> f64 {
    z - law.slope(x)
}

#[constraint]
fn by_angle(x: Coord, z: Coord, law: Law) -> f64 {
    z - law.at(x.atan2(-1.0))
}

#[constraint]
fn by_angle_back(x: Coord, z: Coord, law: Law) -> f64 {
    z - law.at(0.5 - x.atan2(-1.0))
}

#[constraint]
fn by_two_angles(x: Coord, z: Coord, law: Law) -> f64 {
    z - law.at(x.atan2(-1.0) + x.atan2(-3.0))
}

#[constraint]
fn by_thrice_the_angle(x: Coord, z: Coord, law: Law) -> f64 {
    z - law.at(-3.0 * x.atan2(-1.0))
}

type F = std::rc::Rc<dyn Fn(&Wide) -> Wide>;

/// A law in 77 digits, by its pieces.
fn pieces(seams: &'static [f64], f: &'static [fn(&Wide) -> Wide]) -> F {
    std::rc::Rc::new(move |x| f[seams.iter().filter(|seam| *x >= **seam).count()](x))
}

fn cycloid(x: &Wide) -> Wide {
    let turn = 2.0 * Wide::pi();
    x - (&turn * x).sin() / turn
}

/// Laws with their exact values and a range over their seams.
fn laws() -> Vec<(&'static str, Law, F, [f64; 2])> {
    [rises(), sequences(), splines()].concat()
}

fn rises() -> Vec<(&'static str, Law, F, [f64; 2])> {
    let poly345 = |x: &Wide| x * x * x * (10.0 + x * (6.0 * x - 15.0));
    vec![
        (
            "cycloid",
            Law::cycloidal(1.0, 1.0),
            pieces(&[0.0, 1.0], &[|_| w(0.0), cycloid, |_| w(1.0)]),
            [-0.3, 1.2],
        ),
        (
            "harmonic",
            Law::harmonic_rise(2.0, 1.0),
            pieces(&[0.0, 1.0], &[|_| w(0.0), |x| 1.0 - (Wide::pi() * x).cos(), |_| w(2.0)]),
            [-0.3, 1.2],
        ),
        (
            "3-4-5",
            Law::polynomial_345(1.0, 1.0),
            std::rc::Rc::new(move |x: &Wide| {
                if *x < 0.0 {
                    w(0.0)
                } else if *x > 1.0 {
                    w(1.0)
                } else {
                    poly345(x)
                }
            }),
            [-0.2, 1.3],
        ),
        (
            "trapezoid",
            Law::trapezoidal(2.0, 1.0, 1.0),
            pieces(
                &[0.0, 1.0, 2.0, 3.0],
                &[
                    |_| w(0.0),
                    |x| 0.5 * (x * x),
                    |x| x - 0.5,
                    |x| 2.0 - 0.5 * ((3.0 - x) * (3.0 - x)),
                    |_| w(2.0),
                ],
            ),
            [-0.5, 3.5],
        ),
    ]
}

fn sequences() -> Vec<(&'static str, Law, F, [f64; 2])> {
    vec![
        (
            "corner",
            Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, -1.0))]),
            pieces(&[0.0, 1.0, 2.0], &[|_| w(0.0), Wide::clone, |x| 2.0 - x, |_| w(0.0)]),
            [0.5, 1.7],
        ),
        (
            "there and back",
            Law::sequence(
                0.0,
                [
                    (1.0, Law::cycloidal(1.0, 1.0)),
                    (1.0, Law::constant(1.0) - Law::cycloidal(1.0, 1.0)),
                ],
            )
            .periodic(2.0),
            std::rc::Rc::new(|x: &Wide| {
                let x = x.rem_euclid(&w(2.0));
                if x < 1.0 { cycloid(&x) } else { 1.0 - cycloid(&(x - 1.0)) }
            }),
            [0.2, 5.1],
        ),
    ]
}

fn splines() -> Vec<(&'static str, Law, F, [f64; 2])> {
    vec![
        (
            "line between points",
            Law::spline(&[(0.0, 0.0), (1.0, 1.0), (3.0, 3.0)], Ends::Natural),
            std::rc::Rc::new(Wide::clone),
            [-0.4, 2.2],
        ),
        (
            "parabola by a spline",
            Law::spline(&[(0.0, 0.0), (1.0, 0.1), (2.0, 0.0)], Ends::Natural),
            // m = −0.3 at the middle
            std::rc::Rc::new(|x: &Wide| {
                let x = if *x > 1.0 { 2.0 - x } else { x.clone() };
                if x < 0.0 {
                    1.5 * w(0.1) * x
                } else {
                    1.5 * w(0.1) * &x - 0.5 * w(0.1) * &x * &x * &x
                }
            }),
            [-0.5, 2.5],
        ),
    ]
}

fn followed(
    name: String,
    law: Law,
    f: F,
    [from, to]: [f64; 2],
    steps: usize,
    honest: bool,
) -> Option<Case> {
    let system = lengths([from, 0.0], |m, [x, z]| {
        m.add("x", drive(x, Law::linear(from, to - from)))?;
        m.add("z", follows(x, z, law)).map(|_| ())
    });
    let motion = moved(&system, &linspace(0.0, 1.0, steps + 1))?;
    let solutions = move |t: &Wide| {
        let x = w(from) + w(to - from) * t;
        vec![(0, vec![x.clone(), f(&x)])]
    };
    Some(Case { name, honest, system, motion, solutions: Box::new(solutions) })
}

/// The slope of a corner jumps, that of a curve with a corner in its slope does not.
fn slopes() -> Vec<Case> {
    let corner = Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, -1.0))]);
    let mut all = Vec::new();
    for (name, law, f, honest) in [
        (
            "slope of a corner",
            corner,
            pieces(&[0.0, 1.0, 2.0], &[|_| w(0.0), |_| w(1.0), |_| w(-1.0), |_| w(0.0)]),
            false,
        ),
        (
            "slope of a trapezoid",
            Law::trapezoidal(2.0, 1.0, 1.0),
            pieces(
                &[0.0, 1.0, 2.0, 3.0],
                &[|_| w(0.0), Wide::clone, |_| w(1.0), |x| 3.0 - x, |_| w(0.0)],
            ),
            true,
        ),
    ] {
        for steps in [1, 3, 8] {
            let system = lengths([0.6, 0.0], |m, [x, z]| {
                m.add("x", drive(x, Law::linear(0.6, 1.0)))?;
                m.add("z", inclined(x, z, law.clone())).map(|_| ())
            });
            let Some(motion) = posed(&system, &linspace(0.0, 1.0, steps + 1)) else { continue };
            let f = f.clone();
            let solutions = move |t: &Wide| {
                let x = t + w(0.6);
                vec![(0, vec![x.clone(), f(&x)])]
            };
            all.push(Case {
                name: format!("{name} in {steps}"),
                honest,
                system,
                motion,
                solutions: Box::new(solutions),
            });
        }
    }
    all
}

type Adds = fn(&mut Mechanism, Coordinate, Coordinate, Law) -> kin::Result<()>;

/// Laws with their values; true of those that repeat with each turn.
fn laws_of_angles() -> [(&'static str, Law, fn(&Wide) -> Wide, bool); 9] {
    [
        ("sine", Law::sine(0.5, 2.0, 0.25), |x| 0.5 * (2.0 * x + 0.25).sin(), true),
        ("harmonic", Law::harmonic(1.0, 0.5), |x| 1.0 + 0.5 * x.sin(), true),
        (
            "product",
            Law::harmonic(1.0, 0.5) * Law::sine(0.5, 2.0, 0.25),
            |x| (1.0 + 0.5 * x.sin()) * (0.5 * (2.0 * x + 0.25).sin()),
            true,
        ),
        ("shifted", Law::harmonic(1.0, 0.5).shifted(0.75), |x| 1.0 + 0.5 * (x - 0.75).sin(), true),
        ("line", Law::linear(0.5, 0.25), |x| 0.5 + 0.25 * x, false),
        ("half sine", Law::sine(0.5, 0.5, 0.25), |x| 0.5 * (0.5 * x + 0.25).sin(), false),
        ("square", Law::polynomial(&[0.0, 0.0, 0.125]), |x| 0.125 * x * x, false),
        (
            "nearly",
            Law::sine(0.5, 2.0 + 1e-9, 0.25),
            |x| 0.5 * (w(2.0 + 1e-9) * x + 0.25).sin(),
            false,
        ),
        (
            "rise",
            Law::cycloidal(1.0, 4.0),
            |x| {
                if *x < 0.0 {
                    w(0.0)
                } else if *x > 4.0 {
                    w(1.0)
                } else {
                    cycloid(&(x / w(4.0)))
                }
            },
            false,
        ),
    ]
}

/// x from −0.2 to 0.3: the angle of (−1, x) over its cut.
fn angles() -> Vec<Case> {
    let by: [(&str, Adds, fn(&Wide) -> Wide); 4] = [
        (
            "angle",
            |m, x, z, law| m.add("z", by_angle(x, z, law)).map(|_| ()),
            |x| x.atan2(&w(-1.0)),
        ),
        (
            "angle back",
            |m, x, z, law| m.add("z", by_angle_back(x, z, law)).map(|_| ()),
            |x| 0.5 - x.atan2(&w(-1.0)),
        ),
        (
            "two angles",
            |m, x, z, law| m.add("z", by_two_angles(x, z, law)).map(|_| ()),
            |x| x.atan2(&w(-1.0)) + x.atan2(&w(-3.0)),
        ),
        (
            "thrice",
            |m, x, z, law| m.add("z", by_thrice_the_angle(x, z, law)).map(|_| ()),
            |x| -3.0 * x.atan2(&w(-1.0)),
        ),
    ];
    let mut all = Vec::new();
    for (angle, add, turned) in by {
        for (name, law, f, honest) in laws_of_angles() {
            for steps in [1, 4] {
                let system = lengths([-0.2, 0.0], |m, [x, z]| {
                    m.add("x", drive(x, Law::linear(-0.2, 0.5)))?;
                    add(m, x, z, law.clone())
                });
                let Some(motion) = posed(&system, &linspace(0.0, 1.0, steps + 1)) else { continue };
                let solutions = move |t: &Wide| {
                    let x = w(-0.2) + 0.5 * t;
                    vec![(0, vec![x.clone(), f(&turned(&x))])]
                };
                all.push(Case {
                    name: format!("{name} by {angle} in {steps}"),
                    honest,
                    system,
                    motion,
                    solutions: Box::new(solutions),
                });
            }
        }
    }
    all
}

/// A constant after a sine of so many turns that its end is not known: it jumps by what is not
/// seen.
fn hidden_jumps() -> Vec<Case> {
    let mut all = Vec::new();
    for omega in [1e3, 1e6, 1e8, 1e9, 1e10, 1e12, 1e15] {
        for gap in [0.0, 1e-12, 1e-8, 0.3] {
            let end = f64::sin(omega) + gap;
            let law =
                Law::sequence(0.0, [(1.0, Law::sine(1.0, omega, 0.0)), (1.0, Law::constant(end))]);
            if law.refusal().is_some() {
                continue;
            }
            let f: F = std::rc::Rc::new(
                move |x: &Wide| if *x < 1.0 { (w(omega) * x).sin() } else { w(end) },
            );
            let range = [1.0 - 0.25 / omega, 1.0 + 0.25 / omega];
            all.extend(followed(
                format!("sine of {omega:e} and a gap of {gap:e}"),
                law,
                f,
                range,
                1,
                false,
            ));
        }
    }
    all
}

pub fn cases() -> Vec<Case> {
    let mut all = Vec::new();
    for (name, law, f, range) in laws() {
        all.extend([3, 12].into_iter().filter_map(|steps| {
            followed(format!("{name} in {steps}"), law.clone(), f.clone(), range, steps, true)
        }));
        // the same long after
        let later: F = std::rc::Rc::new({
            let f = f.clone();
            move |x: &Wide| f(&(x - 4096.0))
        });
        let range = range.map(|x| x + 4096.0);
        all.extend(followed(format!("{name}, later"), law.shifted(4096.0), later, range, 6, true));
    }
    all.extend(slopes());
    all.extend(angles());
    all.extend(hidden_jumps());
    all
}
