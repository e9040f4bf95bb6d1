//! Derivatives that do not exist, or are not known, are refused by name, never given as a number.

use kin::Mechanism;
use kin::design::{Feature, Sampling};
use kin::extend::{LawFunction, by_dual};
use kin::law::Break;
use kin::prelude::*;
use kin::results::Extreme;

use crate::engines::Engines;

/// A crank of length 1 with θ = the law.
fn crank(law: Law) -> System {
    let mut m = Mechanism::new("crank");
    let crank = m.link("crank", 1.0).unwrap();
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("motor", drive_angle(crank, law)).unwrap();
    m.build().unwrap()
}

/// The error of a derivative by that parameter, forward and backward alike.
fn said(system: &System, times: &[f64], name: &str) -> String {
    let motion = system.run_both(times).expect("a motion");
    let forward = system.sensitivities(&motion, [name]).err().expect("an error").to_string();
    let what = system.coordinate_names()[0].clone();
    let backward =
        system.gradient(&motion, [name], &what, |_| [1.0, 0.0, 0.0]).expect_err("an error");
    assert_eq!(forward, backward.to_string());
    forward
}

#[test]
fn a_name_that_is_no_parameter() {
    let text = said(&crank(Law::ramp(1.0)), &[0.0, 1.0], "motor.law.speed");
    assert!(text.contains("motor.law.speed") && text.contains("motor.law.rate"), "{text}");
}

/// θ − k = 0, and a parameter that nothing hangs on.      [rad]
#[constraint]
fn held(body: Planar, k: f64, spare: f64) -> f64 {
    body.theta - k + (spare - spare)
}

#[test]
fn a_parameter_that_nothing_hangs_on() {
    let mut m = Mechanism::new("held");
    let crank = m.link("crank", 1.0).unwrap();
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("held", held(crank, 0.5, 2.0)).unwrap();
    let text = said(&m.build().unwrap(), &[0.0], "held.spare");
    assert_eq!(
        text,
        "Kin cannot compute a derivative by `held.spare`: no equation depends on the parameter"
    );
}

/// A parallelogram with a third crank: one length of its own is one too many.
fn three_cranks() -> System {
    let mut m = Mechanism::new("three cranks");
    let cranks = ["first", "second", "third"].map(|name| m.link(name, 1.0).unwrap());
    let beam = m.link("beam", 4.0).unwrap();
    for (crank, (x, name)) in cranks.into_iter().zip([(0.0, "1"), (4.0, "2"), (2.0, "3")]) {
        let ground = m.ground();
        m.add(&format!("O{name}"), revolute(ground, crank, vec2(x, 0.0), crank.start())).unwrap();
        m.add(&format!("A{name}"), revolute(crank, beam, crank.end(), vec2(x - 2.0, 0.0))).unwrap();
    }
    m.add("motor", drive_angle(cranks[0], Law::linear(0.5, 1.0))).unwrap();
    m.build().unwrap()
}

#[test]
fn a_redundant_mechanism_that_closes_at_one_value_only() {
    let system = three_cranks();
    let text = said(&system, &[0.0, 0.1], "O3.u_i.x");
    assert!(
        text.starts_with(
            "Kin cannot compute a derivative by `O3.u_i.x`: the redundant mechanism closes"
        ),
        "{text}"
    );
}

#[test]
fn a_redundant_mechanism_has_the_derivatives_that_leave_it_closed() {
    let system = three_cranks();
    let motion = system.run_both([0.0, 0.4]).unwrap();
    let found = system.sensitivities(&motion, ["motor.law.rate"]).unwrap();
    let [theta, beam] = ["second.theta", "beam.R_x"]
        .map(|name| system.coordinate_names().iter().position(|known| known == name).unwrap());
    let by = &found.all()[0];
    let angle = 0.5_f64 + 0.4;
    assert!((by.q(1)[theta] - 0.4).abs() < 1e-13 && (by.qd(1)[theta] - 1.0).abs() < 1e-13);
    // x = 2 + cos(0.5 + ω t)
    assert!((by.q(1)[beam] + 0.4 * angle.sin()).abs() < 1e-13);
    let gradient =
        system.gradient(&motion, ["motor.law.rate"], "second.theta", |k| [k as f64, 0.0, 0.0]);
    assert!((gradient.unwrap()[0] - 0.4).abs() < 1e-13);
}

#[test]
fn a_constraint_on_the_dual_route() {
    let mut m = Mechanism::new("crank");
    let crank = m.link("crank", 1.0).unwrap();
    m.add("O", by_dual(revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start()))).unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(1.0))).unwrap();
    let text = said(&m.build().unwrap(), &[0.0, 1.0], "motor.law.rate");
    assert!(text.contains("of `O`") && text.contains("dual numbers"), "{text}");
}

/// x |x| / 2 · scale, whose second derivative jumps at 0.
#[derive(Clone)]
struct Bent(f64);

impl LawFunction for Bent {
    fn jet(&self, x: f64) -> [f64; 4] {
        [
            0.5 * self.0 * x * x.abs(),
            self.0 * x.abs(),
            self.0 * if x < 0.0 { -1.0 } else { 1.0 },
            0.0,
        ]
    }

    fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
        if from <= 0.0 && 0.0 <= to { vec![Break { x: 0.0, order: 2 }] } else { Vec::new() }
    }

    fn is_smooth(&self) -> bool {
        false
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        visit("scale", self.0);
    }

    fn by_parameter(&self, name: &str) -> Option<Law> {
        (name == "scale").then(|| Law::new(Bent(1.0)))
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        (name == "scale").then(|| Law::new(Bent(value)))
    }
}

#[test]
fn a_break_of_a_law_at_a_time_and_none_beside_it() {
    let system = crank(Law::new(Bent(3.0)));
    let text = said(&system, &[-0.5, 0.0, 0.5], "motor.law.scale");
    assert!(text.contains("at t = 0 s the law `law` of `motor` has a break"), "{text}");
    let motion = system.run_both([-0.5, 0.5]).unwrap();
    let found = system.sensitivities(&motion, ["motor.law.scale"]).unwrap();
    assert_eq!([0, 1].map(|k| found.all()[0].q(k)[2]), [-0.125, 0.125]);
}

#[test]
fn a_law_of_which_no_derivative_by_its_parameter_is_known() {
    let text = said(&crank(Law::fourier(0.1, 1.0, &[(0.2, 0.3)])), &[0.0, 1.0], "motor.law.omega");
    assert_eq!(
        text,
        "Kin cannot compute a derivative by `motor.law.omega`: Kin does not know how the law depends on the parameter"
    );
}

#[test]
fn a_kink_at_a_time() {
    /// θ − k |θ′ − 1| = 0, θ′ being that of the other body      [rad]
    #[constraint]
    fn bounce(body: Planar, other: Planar, k: f64) -> f64 {
        other.theta - k * (body.theta - 1.0).abs()
    }
    let mut m = Mechanism::new("bounce");
    let crank = m.link("crank", 1.0).unwrap();
    let other = m.link("other", 1.0).unwrap();
    for (name, link) in [("O", crank), ("P", other)] {
        let ground = m.ground();
        m.add(name, revolute(ground, link, vec2(0.0, 0.0), link.start())).unwrap();
    }
    m.add("motor", drive_angle(crank, Law::ramp(1.0))).unwrap();
    m.add("bounce", bounce(crank, other, 2.0)).unwrap();
    let text = said(&m.build().unwrap(), &[0.0, 0.5, 1.0, 1.5], "bounce.k");
    assert!(
        text.starts_with(
            "Kin cannot compute a derivative by `bounce.k`: at t = 1 s there is a kink of `bounce`"
        ),
        "{text}"
    );
}

#[test]
fn a_motion_through_a_change_point() {
    let mut m = Mechanism::new("parallelogram");
    let a = m.link("a", 1.0).unwrap();
    let b = m.link("b", 1.0).unwrap();
    let coupler = m.link("coupler", 2.0).unwrap();
    m.add("O", revolute(m.ground(), a, vec2(0.0, 0.0), a.start())).unwrap();
    m.add("A", revolute(a, coupler, a.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, b, coupler.end(), b.end())).unwrap();
    m.add("P", revolute(m.ground(), b, vec2(2.0, 0.0), b.start())).unwrap();
    m.add("motor", drive_angle(a, Law::linear(1.0, 1.0))).unwrap();
    let text = said(&m.build().unwrap(), &linspace(0.0, 4.0, 41), "P.u_i.x");
    assert!(
        text.contains("`P.u_i.x`: the motion passes a singular position at t = 2.14"),
        "{text}"
    );
}

/// An extreme by hand, with its time and kind.
fn by_hand(t: f64, is_max: bool) -> Extreme {
    if is_max { Extreme::maximum(t, 0.3) } else { Extreme::minimum(t, 0.3) }
}

#[test]
fn an_extreme_that_is_not_of_the_motion_is_refused() {
    let mut m = Mechanism::new("m");
    let a = m.dimension("a", 1.0).unwrap().tolerance(0.01);
    let x = m.length("x", 0.0).unwrap();
    m.add("d", drive(x, Law::sine(a, 2.0, 0.0))).unwrap();
    let system = m.build().unwrap();
    let motion = system.run(linspace(0.0, 4.0, 41)).unwrap();
    let by = system.sensitivities(&motion, ["a"]).unwrap();
    let found = system.extremes(&motion, x).unwrap();
    for own in found.all() {
        let exact = if own.is_max { 1.0 } else { -1.0 };
        // A time that was written down with twelve digits is enough.
        let written = by_hand((own.t * 1e11).round() / 1e11, own.is_max);
        for extreme in [own, &written] {
            let [by] = &by.extreme(x, extreme).unwrap()[..] else { panic!() };
            assert!((by.value - exact).abs() < 1e-12 && by.t.abs() < 1e-12, "{by:?}");
        }
    }
    let first = found.all()[0];
    for (wrong, word) in [
        (by_hand(1.0, true), "maximum"),
        (by_hand(first.t, !first.is_max), "minimum"),
        (by_hand(99.0, false), "minimum"),
        (by_hand(f64::NAN, true), "maximum"),
    ] {
        let stroke = Feature::Stroke([first, wrong]);
        for error in [
            by.extreme(x, &wrong).unwrap_err(),
            by.between(x, &first, &wrong).unwrap_err(),
            system.tolerance_of(&motion, x, wrong).unwrap_err(),
            system.tolerance_of(&motion, x, stroke).unwrap_err(),
            system.tolerance_proved(&motion, x, wrong).unwrap_err(),
            system
                .samples(&motion, x, wrong, &Sampling { count: 10, ..Sampling::default() })
                .unwrap_err(),
        ] {
            let text = error.to_string();
            for part in [
                "`x`",
                &format!("the measure has no {word} at t = "),
                &format!("The nearest {word} is at t = "),
                "Choose an extreme",
            ] {
                assert!(text.contains(part), "{part}: {text}");
            }
        }
    }
}

/// The largest value at the end of a run, where the measure does not turn round, stays at that
/// time.
#[test]
fn the_largest_value_at_an_end_has_no_derivative_of_its_time() {
    let mut m = Mechanism::new("m");
    let a = m.dimension("a", 1.0).unwrap();
    let x = m.length("x", 0.0).unwrap();
    m.add("d", drive(x, Law::sine(a, 2.0, 0.0))).unwrap();
    let system = m.build().unwrap();
    let motion = system.run(linspace(0.0, 0.5, 11)).unwrap();
    let most = system.extremes(&motion, x).unwrap().max();
    let by = &system.sensitivities(&motion, ["a"]).unwrap().extreme(x, &most).unwrap()[0];
    assert!(by.t == 0.0 && (by.value - 1.0_f64.sin()).abs() < 1e-12, "{by:?}");
}
