//! Properties of every joint of the table.

use kin::extend::Route;
use kin::extend::terms;
use kin::prelude::*;
use nalgebra::DVector;

use crate::sample::{Argument, Random, arguments, columns, on_manifold, with_norms};
use crate::table::{Joint, all};

/// Each joint some times over, with other parameters each time.
fn each(seed: u64, mut test: impl FnMut(&Joint, &str, &mut Random)) {
    for joint in all() {
        let name = joint.name();
        (0..4).for_each(|k| test(&joint, &name, &mut Random::new(seed + k)));
    }
}

#[test]
fn symbolic_is_dual_is_central_difference() {
    let mut worst = [0.0_f64; 2];
    each(100, |joint, name, random| {
        let sample = (joint.make)(random);
        assert_eq!(sample.constraint().route(), Route::Symbolic, "{name}");
        let report = sample.compare(7).unwrap_or_else(|mismatch| panic!("{mismatch}"));
        assert!(report.states >= 20, "{name}: {} states", report.states);
        // bounds hold at all of them, and are known where nothing jumps
        assert!(report.bounded >= 20, "{name}: bounds at {} states", report.bounded);
        worst = [worst[0].max(report.routes), worst[1].max(report.differences)];
    });
    println!(
        "{} joints: routes within {:.1e}, central differences within {:.1e}",
        all().len(),
        worst[0],
        worst[1]
    );
}

/// Drivers that are linear in the coordinates tell a solver with their numbers of the time all that
/// it wants to know: that it is right is among what the comparison above compares.
#[test]
fn linear_drivers_tell_their_sides() {
    let mut telling = Vec::new();
    each(100, |joint, name, random| {
        let sample = (joint.make)(random);
        if sample.constraint().facts().sides_of_time.is_some()
            && !telling.contains(&name.to_owned())
        {
            telling.push(name.to_owned());
        }
    });
    for name in ["drive", "drive_angle", "drive_relative_angle"] {
        assert!(telling.iter().any(|told| told == name), "{name} is not among {telling:?}");
    }
}

/// Bodies that coincide, angles of whole quarters, axes along the frames': where products vanish
/// and square roots stand at zero.
#[test]
fn routes_agree_at_degenerate_poses() {
    let half = 0.5_f64.sqrt();
    let turns = [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [half, 0.0, half, 0.0],
        [0.5, -0.5, 0.5, -0.5],
        [0.0, 0.0, half, half],
    ];
    let mut compared = 0;
    each(200, |joint, _, random| {
        let sample = (joint.make)(random);
        let n = columns(sample.constraint());
        for (k, turn) in turns.iter().enumerate() {
            let mut q = vec![0.0; n];
            for (number, argument) in arguments(sample.constraint()).into_iter().enumerate() {
                match argument {
                    Argument::Planar(first) => {
                        q[first + 2] = (k * number) as f64 * std::f64::consts::FRAC_PI_2
                    }
                    Argument::Spatial(first) => q[first + 3..first + 7]
                        .copy_from_slice(if number == 0 { &turns[0] } else { turn }),
                    Argument::Coord(first) => q[first] = k as f64 * std::f64::consts::FRAC_PI_2,
                }
            }
            for qd in [random.numbers(n), vec![0.0; n]] {
                let report =
                    sample.at(&q, &qd, 0.0).unwrap_or_else(|mismatch| panic!("{mismatch}"));
                compared += report.states;
            }
        }
    });
    assert!(compared > 2000, "{compared}");
}

/// As many independent rows as the documentation says freedoms are removed, at every pose with
/// C = 0.
#[test]
fn rank_is_the_number_of_rows() {
    let mut worst = (f64::INFINITY, String::new());
    each(300, |joint, name, random| {
        let sample = (joint.make)(random);
        for _ in 0..3 {
            let t = random.between(0.0, 2.0);
            let q = on_manifold(sample.constraint(), random, t);
            let (_, c_q) = with_norms(sample.constraint(), &q, t);
            let values = c_q.clone().svd(false, false).singular_values;
            let share = values.min() / values.max();
            assert!(
                share > 1e-7 && values.len() == c_q.nrows(),
                "{name}: rank below {} at {q:?}: {values}",
                c_q.nrows()
            );
            if share < worst.0 {
                worst = (share, name.to_owned());
            }
        }
    });
    println!("smallest singular value beside the largest: {:.1e}, of `{}`", worst.0, worst.1);
}

#[test]
fn documentation_says_how_many_freedoms_are_removed() {
    for joint in all() {
        let sample = (joint.make)(&mut Random::new(1));
        let text = sample.constraint().facts().description;
        let rows = sample.constraint().facts().rows.len();
        if joint.group.ends_with("drivers") {
            continue;
        }
        let (_, rest) = text
            .split_once("Removes ")
            .unwrap_or_else(|| panic!("`{}` does not say what it removes", joint.name()));
        let said: usize =
            rest.split_whitespace().next().and_then(|word| word.parse().ok()).expect("a number");
        assert_eq!(said, rows, "`{}`", joint.name());
    }
}

/// Joints between bodies do not know where in the world they are.
#[test]
fn a_rigid_motion_of_all_bodies_keeps_the_joint_closed() {
    let mut moved = 0;
    each(400, |joint, name, random| {
        let sample = (joint.make)(random);
        let bodies: Vec<Argument> = arguments(sample.constraint())
            .into_iter()
            .filter(|a| !matches!(a, Argument::Coord(_)))
            .collect();
        if bodies.len() < 2 {
            return;
        }
        let t = random.between(0.0, 2.0);
        let mut q = on_manifold(sample.constraint(), random, t);
        let angle = random.number();
        let shift = random.v3();
        let turn = random.turn();
        for body in bodies {
            match body {
                Argument::Planar(first) => {
                    let r = Mat2::rotation(angle) * vec2(q[first], q[first + 1])
                        + vec2(shift.x, shift.y);
                    (q[first], q[first + 1], q[first + 2]) = (r.x, r.y, q[first + 2] + angle);
                }
                Argument::Spatial(first) => {
                    let r = turn.rotation() * vec3(q[first], q[first + 1], q[first + 2]) + shift;
                    let p = turn.product(EulerParameters::new(
                        q[first + 3],
                        q[first + 4],
                        q[first + 5],
                        q[first + 6],
                    ));
                    q[first..first + 7].copy_from_slice(&[r.x, r.y, r.z, p.e0, p.e1, p.e2, p.e3]);
                }
                Argument::Coord(_) => {}
            }
        }
        let c = terms(sample.constraint(), &q, &[], t).c.amax();
        assert!(c < 1e-11, "{name}: |C| = {c:e} after a rigid motion");
        moved += 1;
    });
    assert!(moved > 100, "{moved}");
}

#[test]
fn bodies_exchanged_with_their_parameters_close_at_the_same_poses() {
    let mut exchanged = 0;
    for (joint, seed) in all().into_iter().zip(500..) {
        let Some(other) = joint.exchanged else { continue };
        let sample = (joint.make)(&mut Random::new(seed));
        let other = other(&mut Random::new(seed));
        let mut random = Random::new(seed + 1000);
        for _ in 0..5 {
            let t = random.between(0.0, 2.0);
            let q = on_manifold(sample.constraint(), &mut random, t);
            let (first, second) = q.split_at(q.len() / 2);
            let c = terms(other.constraint(), &[second, first].concat(), &[], t).c.amax();
            assert!(c < 1e-10, "`{}`: |C| = {c:e} with its bodies exchanged", joint.name());
        }
        // and it is no accident: with other parameters the same pose does not close
        let stranger = (joint.make)(&mut Random::new(seed + 77));
        let t = 1.0;
        let q = on_manifold(sample.constraint(), &mut random, t);
        assert!(
            terms(stranger.constraint(), &q, &[], t).c.amax() > 1e-6,
            "`{}` does not depend on its parameters",
            joint.name()
        );
        exchanged += 1;
    }
    assert!(exchanged >= 20, "{exchanged}");
}

/// −g‴(0), from the table of the equation's steps, against the body with dual numbers and a central
/// difference of g″ = C_q q̈ − Q_d along the motion q + s q̇ + ½ s² q̈.
#[test]
fn jerk_right_side_is_the_rate_of_the_acceleration_equation() {
    let mut worst = 0.0_f64;
    each(600, |joint, name, random| {
        let sample = (joint.make)(random);
        let n = columns(sample.constraint());
        let qd = random.numbers(n);
        let qdd = random.numbers(n);
        let t = random.between(0.0, 2.0);
        let q = on_manifold(sample.constraint(), random, t);
        let second = |s: f64| -> DVector<f64> {
            let at: Vec<f64> = (0..n).map(|k| q[k] + s * qd[k] + 0.5 * s * s * qdd[k]).collect();
            let rate: Vec<f64> = (0..n).map(|k| qd[k] + s * qdd[k]).collect();
            let all = terms(sample.constraint(), &at, &rate, t + s);
            all.c_q * DVector::from_row_slice(&qdd) - all.q_d
        };
        // of two steps the one that is farther from the truth by 16 times: Richardson
        let slope = |h: f64| (second(h) - second(-h)) / (2.0 * h);
        let difference = (slope(1e-4) * 4.0 - slope(2e-4)) / 3.0;
        let jerk = kin::extend::jerk_rhs(sample.constraint(), &q, &qd, &qdd, t)
            .expect("the library knows it");
        let by_dual = kin::extend::jerk_rhs(sample.by_dual().as_ref(), &q, &qd, &qdd, t)
            .expect("dual numbers know it");
        assert!(
            (&jerk - &by_dual).amax() < 1e-12 * (1.0 + jerk.amax()),
            "{name}: jerk right side {jerk} by dual numbers {by_dual}"
        );
        let error = (&jerk + &difference).amax() / (1.0 + jerk.amax());
        assert!(error < 1e-6, "{name}: jerk right side {jerk} by differences {}", -difference);
        worst = worst.max(error);
    });
    println!("jerk right side: worst {worst:.1e}");
}

/// Measures by `Dual3_64` against central differences of the value and of the first two derivatives
/// along a motion.
#[test]
fn measures_have_the_rates_of_their_values() {
    let mut worst = 0.0_f64;
    let mut seen = std::collections::BTreeSet::new();
    each(600, |joint, name, random| {
        let sample = (joint.make)(random);
        let n = columns(sample.constraint());
        let [qd, qdd, qddd] = [random.numbers(n), random.numbers(n), random.numbers(n)];
        let q = on_manifold(sample.constraint(), random, 0.0);
        for (k, told) in sample.constraint().facts().measures.iter().enumerate() {
            seen.insert(format!("{} {name}.{}", joint.group, told.name));
            let at = |s: f64| {
                let along = |x: [&[f64]; 4]| -> Vec<f64> {
                    (0..n)
                        .map(|j| x[0][j] + s * (x[1][j] + s * (0.5 * x[2][j] + s / 6.0 * x[3][j])))
                        .collect()
                };
                let zero = vec![0.0; n];
                let [q, v, a] = [
                    along([&q, &qd, &qdd, &qddd]),
                    along([&qd, &qdd, &qddd, &zero]),
                    along([&qdd, &qddd, &zero, &zero]),
                ];
                kin::extend::measure(
                    sample.constraint(),
                    k,
                    kin::extend::Moving { q: &q, qd: &v, qdd: &a, qddd: &qddd },
                    s,
                )
            };
            let here = at(0.0);
            let h = 1e-4;
            let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|s| at(s * h));
            for order in 0..3 {
                // over the cut of an angle its value jumps by a turn
                let near = |x: f64| {
                    if order == 0 && told.turns {
                        x - TAU * ((x - here[0]) / TAU).round()
                    } else {
                        x
                    }
                };
                let slope = (near(a[order]) - 8.0 * near(b[order]) + 8.0 * near(c[order])
                    - near(d[order]))
                    / (12.0 * h);
                let error = (slope - here[order + 1]).abs()
                    / (1.0 + here.iter().fold(0.0_f64, |m, x| m.max(x.abs())));
                assert!(
                    error < 1e-6,
                    "{name}.{}: derivative {} is {}, by differences {slope}",
                    told.name,
                    order + 1,
                    here[order + 1]
                );
                worst = worst.max(error);
            }
            assert!(!told.unit.is_empty());
        }
    });
    println!("rates of measures: worst {worst:.1e}; {seen:?}");
    assert!(seen.len() >= 20, "{seen:?}");
}

/// The table holds every constraint of the library: a joint that is added without a line here is
/// found by its name.
#[test]
fn the_table_is_complete() {
    let listed: Vec<(bool, String)> =
        all().iter().map(|joint| (joint.group.starts_with("spatial"), joint.name())).collect();
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("kin-core/src/joints");
    let mut files = vec![root];
    let mut missing = Vec::new();
    while let Some(path) = files.pop() {
        if path.is_dir() {
            files.extend(
                std::fs::read_dir(path)
                    .expect("readable")
                    .map(|entry| entry.expect("an entry").path()),
            );
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("readable");
        let spatial = path.to_string_lossy().contains("spatial");
        for name in
            text.lines().filter_map(|line| line.strip_prefix("pub fn ")?.split(['(', '<']).next())
        {
            let name = name.to_owned();
            // the norm of Euler parameters comes with every body by itself, a held turn with
            // `hold_idle_turns`
            if !["euler_norm", "held_turn"].contains(&name.as_str())
                && !listed.contains(&(spatial, name.clone()))
            {
                missing.push(name);
            }
        }
    }
    assert!(missing.is_empty(), "not in the table: {missing:?}");
}
