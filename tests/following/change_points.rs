//! Bifurcations: positions at which branches of a motion cross.

use kin::data::MotionData;
use kin::prelude::*;
use kin::results::{SingularKind, SingularPosition};
use kin::{Follow, SolverOptions};

use crate::engines::Engines;
use crate::models::{FourBar, slider_crank};

/// Crank and rocker of length 1, coupler and ground of length 2: flat at 0 and π, where it can go
/// on as an antiparallelogram.
const PARALLELOGRAM: FourBar =
    FourBar { driven: 1.0, next: 2.0, last: 1.0, ground: 2.0, by_coupler: false };

fn turning(at: &[usize]) -> SolverOptions {
    SolverOptions::new().follow(Follow::OtherBranchAt(at.to_vec()))
}

/// How far what is found is from what is exact, by the largest of it.
fn off(found: &[f64], exact: &[f64]) -> f64 {
    assert_eq!(found.len(), exact.len());
    let largest = exact.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
    found.iter().zip(exact).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / largest
}

fn is_crossing(found: &SingularPosition, t: f64) {
    assert_eq!((found.kind, found.branches.len()), (SingularKind::Bifurcation, 2), "{found:?}");
    assert!((found.t - t).abs() < 1e-10, "{} {t} {:e}", found.t, found.t - t);
}

/// q, q̇, q̈ of the slider-crank with links of 1 whose crank is at θ(t), with the rod at the angle
/// φ and the slider at x, both functions of θ with their slopes.
fn equal_links([s, s1, s2]: [f64; 3], stays: bool) -> [Vec<f64>; 3] {
    let point = |x: f64, y: f64, angle: f64, rate: f64, second: f64, length: f64| {
        let (sin, cos) = angle.sin_cos();
        let value = [x + length * cos, y + length * sin];
        (
            value,
            [-length * sin * rate, length * cos * rate],
            [
                -length * (cos * rate * rate + sin * second),
                length * (cos * second - sin * rate * rate),
            ],
        )
    };
    let crank = point(0.0, 0.0, s, s1, s2, 0.5);
    let tip = point(0.0, 0.0, s, s1, s2, 1.0);
    let sense = if stays { 1.0 } else { -1.0 };
    let phi = if stays { s - PI } else { -s };
    let half = point(0.0, 0.0, phi, sense * s1, sense * s2, 0.5);
    let row = |a: [f64; 2], turn: f64, tip: [f64; 2], half: [f64; 2], phi: f64| {
        vec![
            a[0],
            a[1],
            turn,
            tip[0] + half[0],
            tip[1] + half[1],
            phi,
            tip[0] + 2.0 * half[0],
            0.0,
            0.0,
        ]
    };
    [
        row(crank.0, s, tip.0, half.0, phi),
        row(crank.1, s1, tip.1, half.1, sense * s1),
        row(crank.2, s2, tip.2, half.2, sense * s2),
    ]
}

/// Crank and rod of one length, the lecture's singular case: at 90° the slider is at the crank's
/// bearing. It goes on, or stays there and the rod turns with the crank. Driven by θ = 1.2 t + 0.3
/// t², so that second rates are none that vanish.
#[test]
fn slider_crank_with_equal_links_at_90_degrees() {
    let law = || Law::polynomial(&[0.0, 1.2, 0.3]);
    let theta = |t: f64| [1.2 * t + 0.3 * t * t, 1.2 + 0.6 * t, 0.6];
    // θ = π/2
    let at = (-1.2 + (1.44 + 0.6 * PI).sqrt()) / 0.6;
    let system = slider_crank(1.0, 1.0, law(), 0.0).unwrap();
    for points in [5, 12, 400] {
        for (options, stays) in [(SolverOptions::default(), false), (turning(&[0]), true)] {
            // a grid that straddles the position, and one that has it among its times
            for times in [linspace(0.0, 1.9, points), linspace(0.0, 2.0 * at, 2 * points + 1)] {
                let motion = system
                    .run_both_with(
                        times.iter().filter(|t| **t < 2.0).copied().collect::<Vec<_>>(),
                        &options,
                    )
                    .unwrap();
                let [found] = motion.singular_positions() else {
                    panic!("{:?}", motion.singular_positions())
                };
                is_crossing(found, at);
                for (branch, stays) in found.branches.iter().zip([stays, !stays]) {
                    let [_, qd, qdd] = equal_links(theta(at), stays);
                    assert!(
                        off(&branch.qd, &qd) < 1e-9 && off(&branch.qdd, &qdd) < 1e-7,
                        "{branch:?} {qd:?} {qdd:?}"
                    );
                }
                for (k, &t) in motion.times().iter().enumerate() {
                    // At the position itself rates are those of the branch that is taken.
                    let [q, qd, qdd] = equal_links(theta(t), stays && t > at - 1e-9);
                    let errors =
                        [off(motion.q(k), &q), off(motion.qd(k), &qd), off(motion.qdd(k), &qdd)];
                    assert!(
                        errors[0] < 1e-10 && errors[1] < 1e-8 && errors[2] < 1e-6,
                        "{points} {t}: {errors:?}"
                    );
                }
            }
        }
    }
}

/// A parallelogram stays one through all its flat positions, whatever the grid; that of whole
/// multiples of 36° has all of them among its times.
#[test]
fn parallelogram_stays_a_parallelogram() {
    for (start, points) in [(0.3, 31), (0.4 * PI, 31), (0.3, 62), (0.4 * PI, 721)] {
        let (system, [_, coupler, rocker]) =
            PARALLELOGRAM.system(Law::linear(start, TAU), start, 1.0).unwrap();
        let motion = system.run_both(linspace(0.0, 3.0, points)).unwrap();
        let flat: Vec<f64> = (1..=6).map(|k| (f64::from(k) * PI - start) / TAU).collect();
        assert_eq!(motion.singular_positions().len(), 6, "{:?}", motion.events());
        flat.iter().zip(motion.singular_positions()).for_each(|(t, found)| is_crossing(found, *t));
        let coupler = motion.coordinate(coupler.theta()).unwrap();
        let rocker = motion.coordinate(rocker.theta()).unwrap();
        for (k, t) in motion.times().iter().enumerate() {
            let errors = [coupler.value.values()[k], rocker.value.values()[k] - start - TAU * t]
                .map(f64::abs);
            assert!(errors[0].max(errors[1]) < 1e-10, "{t}: {errors:?}");
            let errors = [
                coupler.rate.values()[k],
                rocker.rate.values()[k] - TAU,
                coupler.second_rate.values()[k],
                rocker.second_rate.values()[k],
            ];
            assert!(off(&errors, &[0.0; 4]) < 1e-5, "{t}: {errors:?}");
        }
    }
}

/// The jerk where a grid has the position among its times, against that of times beside it.
#[test]
fn jerk_at_a_change_point_is_that_of_its_branch() {
    let law = Law::polynomial(&[0.0, 1.2, 0.3, 0.1]);
    let system = slider_crank(1.0, 1.0, law, 0.0).unwrap();
    let crossing = system.run_both([0.0, 1.5]).unwrap().singular_positions()[0].t;
    let times = [0.0, crossing - 0.2, crossing, crossing + 0.2];
    let motion = system.run_both_with(times, &SolverOptions::new().jerk(true)).unwrap();
    // The rod turns as much as the crank: φ = −θ, and the slider is at 2 cos θ.
    let qddd = motion.qddd(2);
    let theta = motion.q(2)[2];
    let rate = motion.qd(2)[2];
    let second = motion.qdd(2)[2];
    let third = 0.6;
    let slider = 2.0 * (theta.sin() * (rate.powi(3) - third) - 3.0 * theta.cos() * rate * second);
    assert!(
        (qddd[2] - third).abs() < 1e-6
            && (qddd[5] + third).abs() < 1e-4
            && (qddd[6] - slider).abs() < 1e-3,
        "{qddd:?} {slider}"
    );
}

/// Turned into the antiparallelogram at the first flat position and back at the third: the loop
/// does not turn over while it is one.
#[test]
fn parallelogram_becomes_an_antiparallelogram_where_it_is_asked_to() {
    let start = 0.3;
    let (system, _) = PARALLELOGRAM.system(Law::linear(start, TAU), start, 1.0).unwrap();
    for points in [31, 97, 721] {
        let motion = system.run_both_with(linspace(0.0, 2.5, points), &turning(&[0, 2])).unwrap();
        let found = motion.singular_positions();
        assert_eq!(found.len(), 5);
        (1..=5)
            .zip(found)
            .for_each(|(k, found)| is_crossing(found, (f64::from(k) * PI - start) / TAU));
        for k in 0..points {
            let theta = motion.q(k)[2];
            let flat = (theta / PI).floor() as i32;
            // A parallelogram turns over at each flat position, the other one too: at those at
            // which it is changed it does not.
            let side = [1.0, 1.0, -1.0, -1.0, 1.0, -1.0][flat as usize];
            assert!(
                PARALLELOGRAM.error(motion.q(k), side) < 1e-8,
                "{theta}: {:e}",
                PARALLELOGRAM.error(motion.q(k), side)
            );
        }
        // Both branches near the first one, by the closed form: what the rates there leave over is
        // of third order.
        for (branch, side) in found[0].branches.iter().zip([1.0, -1.0]) {
            for h in [1e-3, -1e-3] {
                let q: Vec<f64> = (0..9)
                    .map(|j| found[0].q[j] + h * (branch.qd[j] + 0.5 * h * branch.qdd[j]))
                    .collect();
                let side = if h > 0.0 { side } else { -side };
                let exact = PARALLELOGRAM.pose(start + TAU * (found[0].t + h), side).unwrap();
                let turn = |d: f64| (d + PI).rem_euclid(TAU) - PI;
                let error = (0..9).fold(0.0_f64, |most, j| most.max(turn(q[j] - exact[j]).abs()));
                assert!(error < 3e-6, "{h} {side}: {error:e}");
            }
        }
    }
}

/// A singular position is told as an event, and nothing of it is lost as data.
#[test]
fn change_points_are_events_by_name_and_data() {
    let (system, _) = PARALLELOGRAM.system(Law::linear(0.3, 1.0), 0.3, 1.0).unwrap();
    let motion = system.run_both(linspace(0.0, 4.0, 9)).unwrap();
    let [found] = motion.singular_positions() else { panic!() };
    assert_eq!(found.movable, ["coupler", "rocker"]);
    assert!(found.dependent.contains(&"C.x".to_string()), "{:?}", found.dependent);
    let [event] = motion.events() else { panic!("{:?}", motion.events()) };
    assert_eq!(
        (event.kind, event.name.as_str(), event.t),
        (kin::results::EventKind::Bifurcation, "coupler, rocker", found.t)
    );
    println!("{event}");
    let json = serde_json::to_string(&motion.data()).unwrap();
    let data: MotionData = serde_json::from_str(&json).unwrap();
    assert_eq!(Motion::from_data(&data).unwrap().singular_positions(), motion.singular_positions());
}

/// The same mechanism in other units of length, with its parts declared in other orders, gives the
/// same singular positions.
#[test]
fn verdicts_depend_neither_on_units_nor_on_the_order_of_declaration() {
    let build = |scale: f64, order: usize, angle: f64| {
        let mut m = Mechanism::new("parallelogram");
        let lengths = [("crank", 1.0), ("coupler", 2.0), ("rocker", 1.0)];
        let mut links = [None; 3];
        for k in 0..3 {
            let k = (k + order) % 3;
            links[k] = Some(m.link(lengths[k].0, lengths[k].1 * scale).unwrap());
        }
        let [a, b, c] = links.map(Option::unwrap);
        for k in 0..5 {
            let added = match (2 * k + order) % 5 {
                0 => m.add("O", revolute(Ground, a, vec2(0.0, 0.0), a.start())),
                1 => m.add("A", revolute(a, b, a.end(), b.start())),
                2 => m.add("B", revolute(b, c, b.end(), c.end())),
                3 => m.add("C", revolute(c, Ground, c.start(), vec2(2.0 * scale, 0.0))),
                _ => m.add("motor", drive_angle(a, Law::linear(angle, 1.0))),
            };
            added.unwrap();
        }
        let x = scale * angle.cos();
        let y = scale * angle.sin();
        m.set_pose(a, pose(0.5 * x, 0.5 * y, angle)).unwrap();
        m.set_pose(b, pose(x + scale, y, 0.0)).unwrap();
        m.set_pose(c, pose(2.0 * scale + 0.5 * x, 0.5 * y, angle)).unwrap();
        m.build().unwrap()
    };
    for scale in [1e-3, 1.0, 1e3] {
        for order in 0..5 {
            let system = build(scale, order, 0.3);
            let motion = system.run_both(linspace(0.0, 7.0, 13)).unwrap();
            let found = motion.singular_positions();
            assert_eq!(found.len(), 2, "{scale} {order}");
            found.iter().zip([PI - 0.3, TAU - 0.3]).for_each(|(found, t)| is_crossing(found, t));
            let mut movable = found[0].movable.clone();
            movable.sort();
            assert_eq!(movable, ["coupler", "rocker"]);
            let last = motion.named("rocker.theta").unwrap();
            assert!(
                (last.value.values()[12] - 7.3).abs() < 1e-10
                    && motion.named("coupler.theta").unwrap().value.values()[12].abs() < 1e-10
            );
        }
    }
}

/// Two parallelograms on one crank go flat together: C_q loses two ranks at once, and each goes on
/// as it is.
#[test]
fn two_loops_that_change_at_once_are_passed() {
    let mut m = Mechanism::new("two parallelograms");
    let crank = m.link("crank", 1.0).unwrap();
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("motor", drive_angle(crank, Law::linear(0.3, 1.0))).unwrap();
    for (k, ground) in [2.0, -3.0].into_iter().enumerate() {
        let b = m.link(&format!("coupler {k}"), f64::abs(ground)).unwrap();
        let c = m.link(&format!("rocker {k}"), 1.0).unwrap();
        let x = 0.3_f64.cos();
        let y = 0.3_f64.sin();
        m.set_pose(b, pose(x + 0.5 * ground, y, if ground > 0.0 { 0.0 } else { PI })).unwrap();
        m.set_pose(c, pose(ground + 0.5 * x, 0.5 * y, 0.3)).unwrap();
        m.add(&format!("A {k}"), revolute(crank, b, crank.end(), b.start())).unwrap();
        m.add(&format!("B {k}"), revolute(b, c, b.end(), c.end())).unwrap();
        m.add(&format!("C {k}"), revolute(c, Ground, c.start(), vec2(ground, 0.0))).unwrap();
    }
    let system = m.build().unwrap();
    for points in [13, 301] {
        let motion = system.run_both(linspace(0.0, 7.0, points)).unwrap();
        for name in ["rocker 0.theta", "rocker 1.theta"] {
            assert!((motion.named(name).unwrap().value.values()[points - 1] - 7.3).abs() < 1e-9);
        }
        let found = motion.singular_positions();
        assert_eq!(found.len(), 2, "{:?}", motion.events());
        for (found, t) in found.iter().zip([PI - 0.3, TAU - 0.3]) {
            assert!(
                found.kind == SingularKind::Bifurcation && (found.t - t).abs() < 1e-7,
                "{} {t}",
                found.t
            );
        }
    }
}
