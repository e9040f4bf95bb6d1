//! Whole mechanisms against closed forms.

use std::f64::consts::{FRAC_PI_6, PI, TAU};

use super::models::*;
use super::*;
use crate::coordinates::{Ground, any_planar};
use crate::joints::{drivers, planar};
use crate::model::mechanism::{Mechanism, SpatialPose, linspace, pose};
use crate::solve::options::{SolverOptions, Stop};

/// R3, its velocity and its acceleration in closed form.
fn two_link_exact(t: f64) -> [[f64; 2]; 3] {
    let a = 0.5 * t + FRAC_PI_6;
    let b = 0.75 * t + 0.5 * FRAC_PI_6;
    let w = 0.5;
    let o = 0.75;
    let e = |k: usize, angle: f64| {
        [[angle.cos(), angle.sin()], [-angle.sin(), angle.cos()], [-angle.cos(), -angle.sin()]][k]
    };
    std::array::from_fn(|k| {
        std::array::from_fn(|i| 0.2 * w_pow(w, k) * e(k, a)[i] + 0.175 * w_pow(o, k) * e(k, b)[i])
    })
}

fn w_pow(w: f64, k: usize) -> f64 {
    w.powi(k as i32)
}

#[test]
fn two_link_manipulator_is_the_closed_form() {
    let motion = two_link(1.0).run(linspace(0.0, 24.0, 2401)).unwrap();
    for (k, t) in motion.times().iter().enumerate() {
        let exact = two_link_exact(*t);
        for (found, (exact, tolerance)) in [motion.q(k), motion.qd(k), motion.qdd(k)]
            .into_iter()
            .zip(exact.into_iter().zip([1e-14, 1e-13, 1e-13]))
        {
            assert!(
                (found[6] - exact[0]).abs() < tolerance && (found[7] - exact[1]).abs() < tolerance,
                "t = {t}"
            );
        }
    }
    assert!(motion.residuals().iter().all(|r| *r < 1e-14));
    // Prediction from one time takes one step, prediction from three takes none.
    assert!(
        motion.iterations()[1..3].iter().all(|n| *n == 1)
            && motion.iterations()[3..].iter().all(|n| *n == 0)
    );
    assert!(motion.summary().starts_with(
        "two-link manipulator: 9 coordinates, 9 equations, 2401 times, predictions satisfied the equations"
    ));
}

#[test]
fn two_link_manipulator_is_the_reference_at_one_second() {
    // tests/data/two_link_25.json, t = 1.
    let motion = two_link(1.0).run(linspace(0.0, 24.0, 25)).unwrap();
    let q = [
        0.05202960232131906,
        0.08539859765994633,
        1.023598775598299,
        0.196868019041525,
        0.3191600072704383,
        1.0117993877991494,
    ];
    let qdd = [
        -0.013007400580329766,
        -0.02134964941498658,
        0.0,
        -0.0782197592600334,
        -0.12615338055215508,
        0.0,
    ];
    for k in 0..6 {
        assert!(
            (motion.q(1)[3 + k] - q[k]).abs() < 1e-14
                && (motion.qdd(1)[3 + k] - qdd[k]).abs() < 1e-14
        );
    }
}

#[test]
fn unit_of_length_changes_nothing() {
    let metres = two_link(1.0).run(linspace(0.0, 3.0, 31)).unwrap();
    for u in [1e-3, 1e3, 1e9] {
        let other = two_link(u).run(linspace(0.0, 3.0, 31)).unwrap();
        assert_eq!(metres.iterations(), other.iterations(), "u = {u}");
        for k in 0..31 {
            assert!((metres.q(k)[6] - u * other.q(k)[6]).abs() < 1e-14);
        }
    }
}

#[test]
fn backwards_is_the_same_motion() {
    let system = two_link(1.0);
    let forth = system.run(linspace(0.0, 2.0, 21)).unwrap();
    let back = system.run(linspace(2.0, 0.0, 21)).unwrap();
    for k in 0..21 {
        assert!(forth.q(k).iter().zip(back.q(20 - k)).all(|(a, b)| (a - b).abs() < 1e-14));
    }
}

#[test]
fn published_protocol_takes_two_steps_a_time() {
    let options = SolverOptions::new().stop(Stop::ResidualOnly(1e-10)).predict(false);
    let motion =
        two_link(1.0).solver().options(options.clone()).run(linspace(0.0, 1.0, 101)).unwrap();
    assert!(motion.iterations()[1..].iter().all(|n| *n == 2), "{:?}", motion.iterations());
}

#[test]
fn slider_crank_is_the_elimination() {
    let [l2, l3, h] = [1.0, 3.5, 0.2];
    for branch in [1.0, -1.0] {
        let guess = if branch > 0.0 { [0.1, 4.0] } else { [PI, -2.0] };
        let motion = slider_crank([l2, l3, h], 10.0, guess).run(linspace(0.0, 2.0, 2001)).unwrap();
        for (k, t) in motion.times().iter().enumerate() {
            let s = (h - l2 * (10.0 * t).sin()) / l3;
            let theta3 = if branch > 0.0 { s.asin() } else { PI - s.asin() };
            let c = theta3.cos();
            let x = l2 * (10.0 * t).cos() + l3 * theta3.cos();
            let rate = -10.0 * l2 * (10.0 * t).cos() / (l3 * c);
            assert!(
                (motion.q(k)[0] - theta3).abs() < 1e-13 && (motion.q(k)[1] - x).abs() < 1e-13,
                "{branch} {t}"
            );
            assert!((motion.qd(k)[0] - rate).abs() < 1e-11);
        }
    }
}

#[test]
fn four_bar_assembles_from_nothing_as_preferred() {
    let d = 3.0_f64;
    let b = 3.5_f64;
    let c = 3.0_f64;
    let along = (b * b - c * c + d * d) / (2.0 * d);
    let across = (b * b - along * along).sqrt();
    for (preferred, side) in [(100.0, 1.0), (-100.0, -1.0), (130.0, 1.0), (60.0, 1.0)] {
        let (system, _, rocker) = four_bar(preferred);
        let motion = system.run(linspace(0.0, 1.0, 1001)).unwrap();
        let exact = (side * across).atan2(along - d);
        let theta = motion.coordinate(rocker.theta()).unwrap();
        assert!(
            (theta.value.values()[0] - exact).abs() < 1e-13,
            "{preferred}: {} {exact}",
            theta.value.values()[0]
        );
        assert!((theta.value.values()[1000] - exact).abs() < 1e-12);
        assert!(motion.iterations()[1..].iter().all(|n| *n <= 2), "{:?}", motion.iterations());
    }
}

#[test]
fn coupler_point_moves_as_its_position_does() {
    let (system, coupler, _) = four_bar(100.0);
    let motion = system.run(linspace(0.0, 1.0, 1001)).unwrap();
    let p = motion.point(coupler, v(0.0, 0.5)).unwrap();
    let h = 2e-3;
    for k in 1..1000 {
        let v = (p.r()[k + 1].x - p.r()[k - 1].x) / h;
        let a = (p.v()[k + 1].y - p.v()[k - 1].y) / h;
        assert!((v - p.v()[k].x).abs() < 2e-3 && (a - p.a()[k].y).abs() < 2e-2, "{k}");
    }
    assert_eq!(p.speed().max(), p.speed().values().iter().fold(0.0, |m: f64, x| m.max(*x)));
    assert!(motion.point(any_planar(), v(0.0, 0.0)).is_err());
    assert_eq!(motion.point(PlanarBody::from(Ground), v(1.0, 2.0)).unwrap().r()[5], v(1.0, 2.0));
}

/// Slider-crank in absolute coordinates, hand-written and compiled constraints side by side, near
/// its singular position.
#[test]
fn compiled_and_hand_written_constraints_run_together() {
    let l2 = 0.2;
    let l3 = 0.205;
    let h = 0.004;
    let mut m = Mechanism::new("slider-crank");
    let crank = m.link("crank", l2).unwrap();
    let rod = m.link("rod", l3).unwrap();
    let slider = m.planar("slider", pose(0.4, 0.0, 0.0)).unwrap();
    m.add("O", revolute(Ground, crank, v(0.0, 0.0), crank.start())).unwrap();
    m.add("A", planar::revolute(crank, rod, crank.end(), rod.start())).unwrap();
    m.add("B", revolute(rod, slider, rod.end(), v(0.0, 0.0))).unwrap();
    m.add("slide", planar::prismatic(Ground, slider, v(0.0, h), v(0.0, 0.0), v(0.0, 1.0), 0.0))
        .unwrap();
    m.add("motor", drivers::drive_angle(crank, Law::linear(0.1, 2.0))).unwrap();
    let motion = m.build().unwrap().run(linspace(0.0, 3.2, 65)).unwrap();
    for (k, t) in motion.times().iter().enumerate() {
        let theta2 = 0.1 + 2.0 * t;
        let theta3 = ((h - l2 * theta2.sin()) / l3).asin();
        let x = l2 * theta2.cos() + l3 * theta3.cos();
        assert!(
            (motion.q(k)[5] - theta3).abs() < 1e-12 && (motion.q(k)[6] - x).abs() < 1e-12,
            "t = {t}"
        );
    }
}

/// A leg of a platform: |r + A u − b| − l(t) = 0.   \[m\]
#[kin_macros::constraint]
fn leg(
    p: crate::coordinates::Spatial,
    u: crate::numbers::algebra::Vec3,
    b: crate::numbers::algebra::Vec3,
    l: Law,
    t: crate::coordinates::Time,
) -> f64 {
    (p.point(u) - b).norm() - l.at(t)
}

/// Gough–Stewart platform (workload W5): six legs, seven coordinates, the norm by itself.
#[test]
fn stewart_platform_keeps_its_legs_and_its_norm() {
    use crate::numbers::algebra::{EulerParameters, Vec3};
    let mut m = Mechanism::new("platform");
    let tilted =
        SpatialPose::new(Vec3::new(0.1, -0.2, 0.7), EulerParameters::new(2.0, 0.3, 0.2, -0.4));
    let platform = m.spatial("platform", tilted).unwrap();
    let corner = |i: usize, size: f64, spread: f64, z: f64| {
        let angle = TAU * (i / 2) as f64 / 3.0 + if i.is_multiple_of(2) { -spread } else { spread };
        Vec3::new(size * angle.cos(), size * angle.sin(), z)
    };
    let laws: Vec<Law> = (0..6)
        .map(|i| {
            let length = (corner(i, 0.5, PI / 4.0, 1.0) - corner(i, 1.0, PI / 12.0, 0.0)).norm();
            let phase = i as f64 * PI / 3.0;
            Law::constant(length - 0.1 * phase.sin()) + Law::sine(0.1, PI, phase)
        })
        .collect();
    for (i, law) in laws.iter().enumerate() {
        m.add(
            &format!("leg {i}"),
            leg(
                platform,
                corner(i, 0.5, PI / 4.0, 0.0),
                corner(i, 1.0, PI / 12.0, 0.0),
                law.clone(),
            ),
        )
        .unwrap();
    }
    let system = m.build().unwrap();
    assert_eq!(system.equation_names()[6], "platform.p");
    let motion = system.run(linspace(0.0, 2.0, 201)).unwrap();
    assert!((motion.q(0)[2] - 1.0).abs() < 1e-14 && (motion.q(0)[3] - 1.0).abs() < 1e-14);
    for (i, law) in laws.iter().enumerate() {
        let p = motion.point(platform, corner(i, 0.5, PI / 4.0, 0.0)).unwrap();
        for (k, t) in motion.times().iter().enumerate() {
            let d = p.r()[k] - corner(i, 1.0, PI / 12.0, 0.0);
            let [l, rate, ..] = law.jet(*t);
            assert!(
                (d.norm() - l).abs() < 1e-13 && (d.dot(p.v()[k]) / l - rate).abs() < 1e-12,
                "leg {i}, t = {t}: {:e} {:e}",
                d.norm() - l,
                d.dot(p.v()[k]) / l - rate
            );
        }
    }
}

#[test]
fn velocity_and_acceleration_are_those_of_the_run() {
    let system = two_link(1.0);
    let motion = system.run([0.0, 0.4]).unwrap();
    let q = motion.q(1);
    let qd = motion.qd(1);
    let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-14);
    assert!(
        close(&system.velocity(q, 0.4).unwrap(), qd)
            && close(&system.acceleration(q, qd, 0.4).unwrap(), motion.qdd(1))
    );
    assert_eq!(system.c_t(q, 0.4).unwrap()[7..], [-0.5, -0.75]);
    assert_eq!(system.jacobian(q, 0.4).unwrap()[(3, 0)], 1.0);
}
