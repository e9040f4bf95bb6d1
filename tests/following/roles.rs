//! Roles: any measures and coordinates are given in place of the drivers.

use kin::prelude::*;

use crate::ankle::ANKLE;
use crate::models::{FourBar, slider_crank};

fn random(seed: u64) -> fastrand::Rng {
    fastrand::Rng::with_seed(seed)
}

/// The pitch and the roll of an ankle are given: the cranks turn as the closed form says, and the
/// motors lead back.
#[test]
fn an_ankle_answers_forward_and_inverse() {
    let system = ANKLE.system().unwrap();
    let mut inverse = system.follower_given(["pitch.angle", "roll.angle"]).unwrap();
    let mut forward = system.follower(0.0).unwrap();
    let names: Vec<String> = inverse.drivers().into_iter().map(|one| one.name).collect();
    assert_eq!(names, ["pitch.angle", "roll.angle"]);
    assert_eq!(inverse.drivers()[1].unit.as_deref(), Some("rad"));
    for seed in 0..30 {
        let mut random = random(seed);
        let [pitch, roll] = [0; 2].map(|_| 0.8 * random.f64() - 0.4);
        let exact = ANKLE.motors(pitch, roll).unwrap();
        let here = inverse.to([("pitch.angle", pitch), ("roll.angle", roll)]).unwrap();
        assert!((here.measure("pitch.angle").unwrap() - pitch).abs() < 1e-13);
        let motors = here.left_out();
        assert_eq!(motors[0].name, "left motor");
        assert!(motors.iter().zip(exact).all(|(a, b)| (a.value - b).abs() < 1e-12), "{motors:?}");
        for (name, exact) in ["left axis.angle", "right axis.angle"].iter().zip(exact) {
            let off = here.measure(*name).unwrap() - exact;
            assert!(off.abs() < 1e-12, "{seed} {name}: {off:e}");
        }
        let there = forward.to([("left motor", exact[0]), ("right motor", exact[1])]).unwrap();
        for (name, exact) in [("pitch.angle", pitch), ("roll.angle", roll)] {
            let off = there.measure(name).unwrap() - exact;
            assert!(off.abs() < 1e-12, "{seed} {name}: {off:e}");
        }
    }
}

/// A coordinate of a four-bar in place of its motor: the rocker's angle gives the crank's.
#[test]
fn a_coordinate_is_given_in_place_of_a_driver() {
    let bar = FourBar { driven: 1.0, next: 2.5, last: 2.0, ground: 2.2, by_coupler: false };
    let (system, _) = bar.system(Law::linear(1.2, 1.0), 1.2, 1.0).unwrap();
    let mut forward = system.follower(0.0).unwrap();
    let mut inverse = forward.given(["rocker.theta"]).unwrap();
    assert_eq!(inverse.drivers()[0].unit.as_deref(), Some("rad"));
    for angle in [1.0, 2.0, 3.0] {
        let rocker = forward.to([("motor", angle)]).unwrap().coordinate("rocker.theta").unwrap();
        let here = inverse.to([("rocker.theta", rocker)]).unwrap();
        assert!((here.coordinate("crank.theta").unwrap() - angle).abs() < 1e-11, "{angle}");
    }
    // The driver itself is one of the values, and the roles change at any position.
    let mut again = inverse.given(["motor"]).unwrap();
    assert!((again.drivers()[0].value - 3.0).abs() < 1e-11);
    let here = again.to([("motor", 2.4)]).unwrap();
    assert!(bar.error(here.q(), 1.0) < 1e-11);
    // An angle of a joint counts whole turns.
    let mut turned = forward.given(["O.angle"]).unwrap();
    let here = turned.to([("O.angle", -9.0)]).unwrap();
    let crank = here.coordinate("crank.theta").unwrap();
    assert!((crank - 9.0).abs() < 1e-11 || (crank + 9.0).abs() < 1e-11, "{crank}");
}

/// A slide of a joint is given, with its unit; where the rod and the crank are in line, it ends.
#[test]
fn a_slide_is_given_up_to_its_dead_centre() {
    let system = slider_crank(1.0, 2.0, Law::linear(1.0, 1.0), 1.0).unwrap();
    let mut follower = system.follower_given(["slider.R_x"]).unwrap();
    assert_eq!(follower.drivers()[0].unit.as_deref(), Some("m"));
    let here = follower.to([("slider.R_x", 2.5)]).unwrap();
    let cosine = (1.0_f64 + 2.5 * 2.5 - 4.0) / (2.0 * 2.5);
    assert!((here.coordinate("crank.theta").unwrap() - cosine.acos()).abs() < 1e-12);
    let stop = follower.to([("slider.R_x", 4.0)]).unwrap_err().to_string();
    assert!(stop.contains("the follower stops at `slider.R_x` = 3"), "{stop}");
    assert!((follower.drivers()[0].value - 3.0).abs() < 1e-12);
    follower.to([("slider.R_x", 2.0)]).unwrap();
}

/// Given values that depend on one another, too many or too few, unknown or twice: errors by name.
#[test]
fn given_values_that_do_not_fix_the_rest_are_named() {
    let system = ANKLE.system().unwrap();
    let text = |names: &[&str]| system.follower_given(names).unwrap_err().to_string();
    let few = text(&["pitch.angle"]);
    assert!(few.contains("`pitch.angle` is given, but") && few.contains("2 freedoms"), "{few}");
    assert!(few.contains("`foot`") && few.contains("`left crank`"), "{few}");
    let many = text(&["pitch.angle", "roll.angle", "left axis.angle"]);
    assert!(many.contains("2 freedoms"), "{many}");
    let dependent = text(&["left axis.angle", "left motor"]);
    let both = "`left axis.angle` and `left motor` depend on one another";
    assert!(dependent.contains(both), "{dependent}");
    let still = text(&["pitch.angle", "foot.R_x"]);
    assert!(still.contains("`foot.R_x`") && !still.contains("`pitch.angle` and"), "{still}");
    let unknown = text(&["pitch.angle", "yaw.angle"]);
    assert!(unknown.contains("`yaw.angle`") && unknown.contains("`left motor`"), "{unknown}");
    let twice = text(&["roll.angle", "roll.angle"]);
    assert!(twice.contains("`roll.angle`"), "{twice}");
}

/// q̇ and q̈ for given rates of measures agree with differences of moves.
#[test]
fn rates_of_given_measures_agree_with_differences() {
    let system = ANKLE.system().unwrap();
    let mut follower = system.follower_given(["pitch.angle", "roll.angle"]).unwrap();
    let at = |s: f64| {
        [
            ("pitch.angle", 0.2 + 0.7 * s - 0.2 * s * s),
            ("roll.angle", -0.1 + 0.4 * s + 0.15 * s * s),
        ]
    };
    follower.to(at(0.0)).unwrap();
    let found = follower.rates([("pitch.angle", [0.7, -0.4]), ("roll.angle", [0.4, 0.3])]).unwrap();
    let h = 1e-4;
    let [back, here, forth] = [-h, 0.0, h].map(|s| follower.to(at(s)).unwrap().q().to_vec());
    for k in 0..here.len() {
        let first = (forth[k] - back[k]) / (2.0 * h);
        let second = (forth[k] - 2.0 * here[k] + back[k]) / (h * h);
        assert!((found.qd[k] - first).abs() < 1e-7, "{k}: {} {first}", found.qd[k]);
        assert!((found.qdd[k] - second).abs() < 1e-5, "{k}: {} {second}", found.qdd[k]);
    }
}
