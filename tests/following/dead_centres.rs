//! Runs that begin or end at a dead centre of their driver, against closed forms.

use kin::error::FailureKind;
use kin::prelude::*;
use kin::results::SingularKind;
use kin::solver::Start;

use crate::models::FourBar;

/// A press: a cylinder moves the slider, crank and rod are in line where the slider is at 3.
fn press(law: Law) -> System {
    let mut m = Mechanism::new("press");
    let crank = m.link("crank", 1.0).unwrap();
    let rod = m.link("rod", 2.0).unwrap();
    let slider = m.planar("slider", pose(2.9, 0.0, 0.0)).unwrap();
    let zero = vec2(0.0, 0.0);
    m.add("O", revolute(Ground, crank, zero, crank.start())).unwrap();
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).unwrap();
    m.add("B", revolute(rod, slider, rod.end(), zero)).unwrap();
    m.add("guide", prismatic(slider, Ground, zero, zero, vec2(0.0, 1.0), 0.0)).unwrap();
    m.add("cylinder", drive(slider.x(), law)).unwrap();
    m.prefer(crank, 0.5);
    m.build().unwrap()
}

/// The angle of the crank where the slider is at x.
fn angle(x: f64) -> f64 {
    ((x * x - 3.0) / (2.0 * x)).clamp(-1.0, 1.0).acos()
}

/// θ, θ̇ and θ̈ of the crank, the first body.
fn crank(motion: &Motion) -> [Vec<f64>; 3] {
    let all = |row: &dyn Fn(usize) -> f64| (0..motion.len()).map(row).collect();
    [all(&|k| motion.q(k)[2]), all(&|k| motion.qd(k)[2]), all(&|k| motion.qdd(k)[2])]
}

/// From the dead centre in both directions: position at each time, and velocity and acceleration at
/// the dead centre itself.
#[test]
fn a_run_leaves_a_dead_centre_in_the_stated_direction() {
    let c = [3.0, 0.0, -0.5, 0.1];
    let times = linspace(0.0, 1.0, 41);
    for sign in [1.0, -1.0] {
        let system = press(Law::polynomial(&c));
        let mut solver = system.solver().start(Start::towards("crank", sign));
        let motion = solver.run(&times).unwrap();
        let [value, velocity, acceleration] = crank(&motion);
        for (t, found) in times.iter().zip(&value) {
            let x = 3.0 - 0.5 * t * t + 0.1 * t * t * t;
            let exact = sign * angle(x);
            // Next to the dead centre the closed form itself loses digits.
            let near = 1e-11 + 1e-15 / t.max(1e-6);
            assert!((found - exact).abs() < near, "{sign} {t}: {found} {exact}");
        }
        // ¾ θ² = ½ t² − 0.1 t³, to the third order.
        let rate = sign * (2.0_f64 / 3.0).sqrt();
        assert!((velocity[0] - rate).abs() < 1e-12, "{}", velocity[0]);
        assert!((acceleration[0] + 0.2 * rate).abs() < 1e-8, "{}", acceleration[0]);
        let singular = &motion.singular_positions()[0];
        assert_eq!((singular.t, singular.kind), (0.0, SingularKind::TurningPoint));
        assert!(singular.movable.contains(&"crank".to_string()), "{:?}", singular.movable);
        assert!(motion.qd(0).iter().all(|x| x.is_finite()));
    }
}

/// A law of the fourth order leaves it with velocity zero.
#[test]
fn a_run_leaves_a_dead_centre_with_a_jounce() {
    let system = press(Law::polynomial(&[3.0, 0.0, 0.0, 0.0, -0.5]));
    let mut solver = system.solver().start(Start::towards("crank.theta", 1));
    let motion = solver.run(linspace(0.0, 1.0, 21)).unwrap();
    let [value, velocity, acceleration] = crank(&motion);
    assert_eq!(velocity[0], 0.0);
    // ¾ θ² = ½ t⁴.
    let exact = 2.0 * (2.0_f64 / 3.0).sqrt();
    assert!((acceleration[0] - exact).abs() < 1e-10, "{}", acceleration[0]);
    assert!((value[20] - angle(2.5)).abs() < 1e-11);
}

/// Without a direction the error asks for it; a wrong one is named.
#[test]
fn a_run_from_a_dead_centre_asks_for_the_direction() {
    let system = press(Law::polynomial(&[3.0, 0.0, -0.5]));
    let times = linspace(0.0, 1.0, 11);
    let asked = system.run(&times).unwrap_err().to_string();
    assert!(asked.contains("begins at a dead centre of `cylinder` at t = 0"), "{asked}");
    assert!(asked.contains("Start::towards(\"crank."), "{asked}");
    let text = |start: Start| system.solver().start(start).run(&times).unwrap_err().to_string();
    let still = text(Start::towards("slider.R_x", 1));
    assert!(still.contains("`slider.R_x` gives no direction"), "{still}");
    assert!(still.contains("`crank.theta`"), "{still}");
    let unknown = text(Start::towards("handle", 1));
    assert!(unknown.contains("`handle`") && unknown.contains("`crank.theta`"), "{unknown}");
    let none = text(Start::towards("crank", 0));
    assert!(none.contains("gives no direction"), "{none}");

    let text = |law: Law| {
        let system = press(law);
        let start = Start::towards("crank", 1);
        system.solver().start(start).run(linspace(0.0, 1.0, 11)).unwrap_err().to_string()
    };
    let elsewhere = text(Law::polynomial(&[2.5, 0.0, -0.5]));
    assert!(elsewhere.contains("does not begin at a dead centre at t = 0"), "{elsewhere}");
    let fast = text(Law::linear(3.0, -0.5));
    assert!(fast.contains("velocities of the other links have no bound"), "{fast}");
    let rough = text(Law::polynomial(&[3.0, 0.0, 0.0, -0.5]));
    assert!(rough.contains("accelerations of the other links have no bound"), "{rough}");
}

/// A run ends at a dead centre at which its driver comes to rest; one that arrives with a velocity
/// does not.
#[test]
fn a_run_ends_at_a_dead_centre() {
    // x = 3 − ½ (1 − t)².
    let system = press(Law::polynomial(&[2.5, 1.0, -0.5]));
    let times = linspace(0.0, 1.0, 41);
    let motion = system.run(&times).unwrap();
    assert_eq!(motion.len(), 41);
    let [value, velocity, acceleration] = crank(&motion);
    let rate = -(2.0_f64 / 3.0).sqrt();
    assert!(value[40].abs() < 1e-9, "{}", value[40]);
    assert!((velocity[40] - rate).abs() < 1e-8 && acceleration[40].abs() < 1e-7);
    assert!((velocity[39] - rate).abs() < 1e-3);
    assert!((motion.q(40)[6] - 3.0).abs() < 1e-12);
    assert_eq!(motion.singular_positions().len(), 1);

    let system = press(Law::linear(2.5, 0.5));
    let error = system.run(&times).unwrap_err();
    assert!(
        matches!(error.kind(), Some(FailureKind::Toggle { .. } | FailureKind::SingularAt { .. })),
        "{error}"
    );
}

/// Random four-bars from a toggle of their crank, either way.
#[test]
fn random_four_bars_leave_their_toggles() {
    let mut random = fastrand::Rng::with_seed(7);
    let mut tried = 0;
    while tried < 12 {
        let mut length = || 0.5 + 1.5 * random.f64();
        let [driven, next, last, ground] = [length(), length(), length(), length()];
        let bar = FourBar { driven, next, last, ground, by_coupler: false };
        let cosine = (driven * driven + ground * ground - (next + last) * (next + last))
            / (2.0 * driven * ground);
        if bar.clearance() > -0.05 || cosine.abs() > 0.8 {
            continue;
        }
        tried += 1;
        // The crank goes back from where coupler and rocker are in line.
        let toggle = cosine.acos();
        let law = Law::polynomial(&[toggle, 0.0, -0.5]);
        for sign in [1.0, -1.0] {
            let (system, _) = bar.system(law.clone(), toggle - 0.1, 1.0).unwrap();
            let start = Start::towards("coupler", sign);
            let motion = system.solver().start(start).run(linspace(0.0, 0.4, 9)).unwrap();
            let k = motion.len() - 1;
            let errors = [1.0, -1.0].map(|side| bar.error(motion.q(k), side));
            assert!(errors[0].min(errors[1]) < 1e-9, "{bar:?} {errors:?}");
            assert!((motion.q(k)[5] - motion.q(0)[5]) * sign > 0.0, "{bar:?}");
            assert!((motion.q(0)[2] - toggle).abs() < 1e-12);
        }
    }
}
