//! Whole mechanisms against the reference motions, from the files' rough initial guesses, on both
//! routes (`tests/data/README.md`).

mod data;
#[path = "data/engines.rs"]
mod engines;

use data::model::{BOTH, By, add, build, driver};
use data::{error, number, numbers, read, rows};
use engines::Engines;
use kin::prelude::*;
use kin::results::Series;
use kin::{Mechanism, Motion, linspace};
use serde_json::Value;

/// The lecture's loop closure: l2 e(θ2) + l3 e(θ3) = (x_B, h), θ2 given.      \[m\]
#[constraint]
fn loop_closure(
    theta3: Coord,
    x: Coord,
    crank: Law,
    l2: f64,
    l3: f64,
    h: f64,
    t: Time,
) -> (f64, f64) {
    let theta2 = crank.at(t);
    let along = l2 * theta2.cos() + l3 * theta3.cos() - x;
    let across = l2 * theta2.sin() + l3 * theta3.sin() - h;
    (along, across)
}

/// Worst errors of q, q̇ and q̈, each relative to 1 + the largest value of the motion.
#[derive(Debug, Default)]
struct Errors([f64; 3]);

impl Errors {
    /// Takes in one quantity of the given order of differentiation.
    fn take(&mut self, order: usize, found: &[f64], exact: &[f64]) {
        self.0[order] = self.0[order].max(error(found, exact));
    }

    /// Fails above the tolerances 1e-12, 1e-11, 1e-9 times `factor`.
    fn check(&self, what: &str, factor: f64) {
        println!(
            "{what}: worst error q {:.1e}, qd {:.1e}, qdd {:.1e}",
            self.0[0], self.0[1], self.0[2]
        );
        for ((name, error), tolerance) in
            ["q", "qd", "qdd"].iter().zip(self.0).zip([1e-12, 1e-11, 1e-9])
        {
            assert!(error <= tolerance * factor, "{what}: {name} is off by {error:.1e}");
        }
    }
}

#[test]
fn slider_crank_inline_moves_as_the_reference() {
    slider_crank("slider_crank_inline", 1.0);
}

#[test]
fn slider_crank_offset_moves_as_the_reference() {
    slider_crank("slider_crank_offset", 1.0);
}

#[test]
fn slider_crank_with_accelerating_crank_moves_as_the_reference() {
    slider_crank("slider_crank_offset_accel", 1.0);
}

#[test]
fn slider_crank_of_second_branch_moves_as_the_reference() {
    slider_crank("slider_crank_branch2", 1.0);
}

#[test]
fn slider_crank_near_singular_moves_as_the_reference() {
    slider_crank("slider_crank_near_singular", 10.0);
}

/// Every third, seventh, 20th of its times alone: the crank turns by up to 2 rad between them, past
/// positions where the rod nearly turns over.
#[test]
fn slider_crank_near_singular_moves_as_the_reference_on_coarse_grids() {
    let file = read("slider_crank_near_singular");
    let times = numbers(&file, "time");
    let exact = rows(&file["reference"], "q");
    let system = build(&file, BOTH[0]).expect("a mechanism").0.build().expect("a square system");
    for stride in [3, 7, 20] {
        let motion = system
            .run_both(times.iter().step_by(stride).copied().collect::<Vec<f64>>())
            .expect("a motion");
        assert!(motion.singular_positions().is_empty());
        for (k, exact) in exact.iter().step_by(stride).enumerate() {
            assert!(
                error(motion.q(k), exact) < 1e-11,
                "{stride} {k}: {:e}",
                error(motion.q(k), exact)
            );
        }
    }
}

#[test]
fn two_link_manipulator_moves_as_the_reference() {
    for name in ["two_link_25", "two_link_241"] {
        let file = read(name);
        for by in BOTH {
            let (mechanism, bodies) = build(&file, by).expect("a mechanism");
            let motion = run(mechanism, &file);
            absolute(&motion, &file).check(&format!("{name} by {by:?}"), 1.0);

            let end = motion
                .point(bodies[2], vec2(number(&file["parameters"], "l3") / 2.0, 0.0))
                .unwrap();
            let mut errors = Errors::default();
            for (order, vectors) in [end.r(), end.v(), end.a()].into_iter().enumerate() {
                let field = ["value", "d1", "d2"][order];
                let [x, y] = [|v: &Vec2| v.x, |v: &Vec2| v.y]
                    .map(|part| vectors.iter().map(part).collect::<Vec<_>>());
                errors.take(order, &x, &numbers(output(&file, "end_effector_x"), field));
                errors.take(order, &y, &numbers(output(&file, "end_effector_y"), field));
            }
            errors.check(&format!("{name} by {by:?}, end effector"), 1.0);
        }
    }
}

#[test]
fn two_link_manipulator_moves_as_its_closed_form() {
    let file = read("two_link_241");
    let p = |name: &str| number(&file["parameters"], name);
    let l2 = p("l2");
    let l3 = p("l3");
    let w2 = p("w2");
    let w3 = p("w3");
    for by in BOTH {
        let (mechanism, bodies) = build(&file, by).expect("a mechanism");
        let motion = mechanism
            .build()
            .expect("a square system")
            .run_both(linspace(0.0, 24.0, 2401))
            .expect("a motion");
        let end = motion.point(bodies[2], vec2(l3 / 2.0, 0.0)).unwrap();
        let mut errors = Errors::default();
        for (k, t) in motion.times().iter().enumerate() {
            let theta2 = w2 * t + p("th20");
            let theta3 = w3 * t + p("th30");
            // Derivatives of l e(θ) with θ̇ = ω constant: l e(θ), l ω n(θ), −l ω² e(θ).
            let arm = |l: f64, theta: f64, w: f64, order: usize| match order {
                0 => [l * theta.cos(), l * theta.sin()],
                1 => [-l * w * theta.sin(), l * w * theta.cos()],
                _ => [-l * w * w * theta.cos(), -l * w * w * theta.sin()],
            };
            for (order, found) in [motion.q(k), motion.qd(k), motion.qdd(k)].into_iter().enumerate()
            {
                let [ax, ay] = arm(l2, theta2, w2, order);
                let [bx, by] = arm(l3, theta3, w3, order);
                let angles = [[theta2, theta3], [w2, w3], [0.0, 0.0]][order];
                let r2 = [ax / 2.0, ay / 2.0];
                let r3 = [ax + bx / 2.0, ay + by / 2.0];
                errors.take(
                    order,
                    found,
                    &[0.0, 0.0, 0.0, r2[0], r2[1], angles[0], r3[0], r3[1], angles[1]],
                );
                let point = [end.r(), end.v(), end.a()][order][k];
                errors.take(order, &[point.x, point.y], &[ax + bx, ay + by]);
            }
        }
        errors.check(&format!("two-link closed form by {by:?}"), 1.0);
    }
}

/// One slider-crank in both models: absolute coordinates of four bodies, and the lecture's two loop
/// closure equations.
fn slider_crank(name: &str, factor: f64) {
    let file = read(name);
    for by in BOTH {
        let motion = run(build(&file, by).expect("a mechanism").0, &file);
        absolute(&motion, &file).check(&format!("{name} by {by:?}, 12 coordinates"), factor);
        let (motion, theta3, x) = loop_closed(&file, by).expect("a motion");
        let mut errors = Errors::default();
        outputs(&mut errors, &motion.coordinate(theta3).unwrap(), output(&file, "theta3"));
        outputs(&mut errors, &motion.coordinate(x).unwrap(), output(&file, "x_B4"));
        errors.check(&format!("{name} by {by:?}, loop closure"), factor);
    }
}

/// The motion of the loop closure, from the angle of the rod and the position of the slider in the
/// file's guess.
fn loop_closed(file: &Value, by: By) -> kin::Result<(Motion, Coordinate, Coordinate)> {
    let p = |name: &str| number(&file["parameters"], name);
    let guess = numbers(file, "initial_guess");
    let mut m = Mechanism::new("loop closure");
    let theta3 = m.angle("theta3", guess[8])?;
    let x = m.length("x_B", guess[9])?;
    let crank = driver(file, "th0 + w*t + al*t**2/2");
    add(&mut m, by, "loop", loop_closure(theta3, x, crank, p("l2"), p("l3"), p("h")))?;
    Ok((m.build()?.run_both(numbers(file, "time"))?, theta3, x))
}

/// The motion of a mechanism at the file's times.
fn run(mechanism: Mechanism, file: &Value) -> Motion {
    let system = mechanism.build().expect("a square system");
    assert_eq!(system.initial(), numbers(file, "initial_guess"));
    system.run_both(numbers(file, "time")).expect("a motion")
}

/// All coordinates against `reference`, coordinate by coordinate over time.
fn absolute(motion: &Motion, file: &Value) -> Errors {
    let mut errors = Errors::default();
    let transposed =
        |rows: &[Vec<f64>], column: usize| rows.iter().map(|row| row[column]).collect::<Vec<f64>>();
    for (order, field) in ["q", "qd", "qdd"].into_iter().enumerate() {
        let exact = rows(&file["reference"], field);
        for (column, name) in motion.names().iter().enumerate() {
            let found = motion.named(name).expect("a coordinate");
            let series = [&found.value, &found.rate, &found.second_rate][order];
            errors.take(order, series.values(), &transposed(&exact, column));
        }
    }
    errors
}

/// One coordinate against an output of the file.
fn outputs(errors: &mut Errors, found: &kin::results::Quantity, exact: &Value) {
    let series: [(&Series, &str); 3] =
        [(&found.value, "value"), (&found.rate, "d1"), (&found.second_rate, "d2")];
    for (order, (series, field)) in series.into_iter().enumerate() {
        errors.take(order, series.values(), &numbers(exact, field));
    }
}

fn output<'a>(file: &'a Value, name: &str) -> &'a Value {
    let all = file["outputs"].as_array().expect("outputs");
    all.iter().find(|output| output["name"] == name).unwrap_or_else(|| panic!("no output `{name}`"))
}
