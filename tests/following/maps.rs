//! Maps between given and wanted values, both ways.

use kin::prelude::*;
use kin::solver::{Map, Mapped};

use crate::ankle::ANKLE;
use crate::models::{FourBar, slider_crank};

const MOTORS: [&str; 2] = ["left motor", "right motor"];
const ANGLES: [&str; 2] = ["pitch.angle", "roll.angle"];

fn ankle() -> System {
    ANKLE.system().unwrap()
}

fn inverse() -> Map {
    ankle().map(ANGLES, MOTORS).unwrap()
}

fn values(all: &[kin::solver::NamedValue]) -> Vec<f64> {
    all.iter().map(|one| one.value).collect()
}

fn random_angles(seed: u64) -> [f64; 2] {
    let mut random = fastrand::Rng::with_seed(seed);
    [0; 2].map(|_| 0.8 * random.f64() - 0.4)
}

fn at(map: &mut Map, names: [&str; 2], to: [f64; 2]) -> Mapped {
    map.to(names.into_iter().zip(to)).unwrap()
}

/// Values and slopes agree with the closed form, and the way back is the identity.
#[test]
fn a_map_and_its_inverse_are_the_identity() {
    let mut inverse = inverse();
    let mut forward = inverse.inverse().unwrap();
    for seed in 0..30 {
        let angles = random_angles(seed);
        let exact = ANKLE.motors(angles[0], angles[1]).unwrap();
        let slopes = ANKLE.slopes(angles[0], angles[1]).unwrap();
        let here = at(&mut inverse, ANGLES, angles);
        for k in 0..2 {
            assert!(
                (here.wanted()[k].value - exact[k]).abs() < 1e-13,
                "{seed}: {here:?} {exact:?}"
            );
            for (j, slope) in slopes[k].iter().enumerate() {
                let off = here.jacobian()[(k, j)] - slope;
                assert!(off.abs() < 1e-13 * (1.0 + slope.abs()), "{seed} {k} {j}: {off:e}");
            }
        }
        let motors = [here.wanted()[0].value, here.wanted()[1].value];
        let back = at(&mut forward, MOTORS, motors);
        for (found, angle) in back.wanted().iter().zip(angles) {
            assert!((found.value - angle).abs() < 1e-13, "{seed}: {found} {angle}");
        }
        let one = here.jacobian() * back.jacobian();
        assert!((one - kin::nalgebra::DMatrix::identity(2, 2)).amax() < 1e-12);
    }
}

/// The slopes agree with differences of moves, and so does their rate.
#[test]
fn slopes_and_their_rates_agree_with_differences_of_moves() {
    for seed in 0..10 {
        let mut map = inverse();
        let angles = random_angles(seed);
        let rates = random_angles(seed + 100);
        let h = 1e-4;
        let here = at(&mut map, ANGLES, angles);
        let pairs = || ANGLES.into_iter().zip(rates);
        let rate = map.jacobian_rate(pairs()).unwrap();
        let velocity = values(&here.velocities(pairs()).unwrap());
        let beside = |map: &mut Map, s: f64| {
            at(map, ANGLES, std::array::from_fn(|k| angles[k] + s * rates[k]))
        };
        let [back, forth] = [-h, h].map(|s| beside(&mut map, s));
        for k in 0..2 {
            let slope = (forth.wanted()[k].value - back.wanted()[k].value) / (2.0 * h);
            assert!((velocity[k] - slope).abs() < 1e-7, "{seed}: {} {slope}", velocity[k]);
            for j in 0..2 {
                let bend = (forth.jacobian()[(k, j)] - back.jacobian()[(k, j)]) / (2.0 * h);
                assert!((rate[(k, j)] - bend).abs() < 1e-6, "{seed}: {} {bend}", rate[(k, j)]);
            }
        }
    }
}

/// The efforts on both sides have the same power.
#[test]
fn power_is_the_same_on_both_sides() {
    let mut map = inverse();
    for seed in 0..50 {
        let here = at(&mut map, ANGLES, random_angles(seed));
        let rates = random_angles(seed + 1000);
        let efforts = random_angles(seed + 2000);
        let velocities = here.velocities(ANGLES.into_iter().zip(rates)).unwrap();
        let torques = here.efforts(MOTORS.into_iter().zip(efforts)).unwrap();
        let given: f64 = torques.iter().zip(rates).map(|(one, rate)| one.value * rate).sum();
        let wanted: f64 = velocities.iter().zip(efforts).map(|(one, tau)| one.value * tau).sum();
        assert!((given - wanted).abs() < 1e-14, "{seed}: {given} {wanted}");
    }
}

/// The torques of the motors that hold the foot's weight, by forces and by Jᵀ.
#[test]
fn efforts_of_masses_agree_with_the_transposed_slopes() {
    let system = ankle();
    let mut inverse = system.map(ANGLES, MOTORS).unwrap();
    let here = at(&mut inverse, ANGLES, [0.2, -0.1]);
    let mut by_angles = inverse.follower().clone();
    let mut by_motors = by_angles.given(MOTORS).unwrap();
    let rest: [(&str, [f64; 2]); 0] = [];
    let torques = by_motors.efforts(rest).unwrap();
    assert_eq!(torques[0].unit.as_deref(), Some("N m"));
    let pairs = torques.iter().map(|one| (one.name.as_str(), one.value));
    let through = here.efforts(pairs).unwrap();
    let direct = by_angles.efforts(rest).unwrap();
    for (a, b) in through.iter().zip(&direct) {
        assert!((a.value - b.value).abs() < 1e-12 && b.value.abs() > 1e-3, "{a} {b}");
    }
}

/// Coordinates, measures and drivers of a slider-crank: the slope is the closed form, and at the
/// dead centre of the slider the way back ends.
#[test]
fn a_slider_crank_maps_both_ways() {
    let system = slider_crank(1.0, 2.0, Law::linear(1.0, 1.0), 1.0).unwrap();
    let mut map = system.map(["motor"], ["slider.R_x", "A.angle", "motor"]).unwrap();
    let here = map.to([("motor", 0.7)]).unwrap();
    let [sin, cos] = [0.7_f64.sin(), 0.7_f64.cos()];
    let root = (4.0 - sin * sin).sqrt();
    let exact = [cos + root, 0.7 + (sin / 2.0).asin(), 0.7];
    let slopes = [-sin - sin * cos / root, 1.0 + cos / root, 1.0];
    for k in 0..3 {
        assert!((here.wanted()[k].value - exact[k]).abs() < 1e-13, "{here:?}");
        assert!((here.jacobian()[(k, 0)] - slopes[k]).abs() < 1e-13, "{here:?}");
    }
    assert_eq!(here.wanted()[0].unit.as_deref(), Some("m"));
    let mut back = system.map(["slider.R_x"], ["motor"]).unwrap();
    let there = back.to([("slider.R_x", exact[0])]).unwrap();
    assert!((there.wanted()[0].value - 0.7).abs() < 1e-13, "{there:?}");
    let stop = back.to([("slider.R_x", 3.5)]).unwrap_err().to_string();
    assert!(stop.contains("stops at `slider.R_x` = 3"), "{stop}");
    back.to([("slider.R_x", exact[0])]).unwrap();
}

/// Limits of the motors, drawn in the space of pitch and roll.
#[test]
fn limits_of_one_space_are_drawn_in_the_other() {
    let map = ankle().map(MOTORS, ANGLES).unwrap();
    let ranges = [("left motor", [-0.3, 0.25]), ("right motor", [-0.2, 0.3])];
    let border = map.border(ranges, 5).unwrap();
    assert_eq!(border.len(), 20);
    for one in &border {
        let [pitch, roll] = [one.wanted()[0].value, one.wanted()[1].value];
        let motors = ANKLE.motors(pitch, roll).unwrap();
        for ((motor, given), (_, [from, to])) in motors.iter().zip(one.given()).zip(ranges) {
            assert!((motor - given.value).abs() < 1e-12);
            assert!((from - 1e-12..=to + 1e-12).contains(motor));
        }
    }
    let [first, last] = [border.first(), border.last()].map(|one| values(one.unwrap().wanted()));
    assert!(first.iter().zip(&last).all(|(a, b)| (a - b).abs() < 1e-12));
    let one = map.border([("left motor", [0.0, 1.0])], 5).unwrap_err().to_string();
    assert!(one.contains("`right motor` has no range"), "{one}");
    let few = map.border(ranges, 1).unwrap_err().to_string();
    assert!(few.contains("at least 2 points"), "{few}");
}

/// The way of a crank to its rocker stays on the branch over a large move.
#[test]
fn a_map_follows_its_branch() {
    let bar = FourBar { driven: 1.0, next: 2.5, last: 2.0, ground: 2.2, by_coupler: false };
    let (system, _) = bar.system(Law::linear(0.4, 1.0), 0.4, 1.0).unwrap();
    let mut map = system.map(["motor"], ["rocker.theta"]).unwrap();
    for angle in [3.0, 20.0, -7.0] {
        let here = map.to([("motor", angle)]).unwrap();
        let [_, rocker] = bar.angles(angle, 1.0).unwrap();
        let off = here.wanted()[0].value - rocker;
        assert!((off - TAU * (off / TAU).round()).abs() < 1e-11, "{angle}: {off}");
    }
    let unknown = system.map(["motor"], ["rocker"]).unwrap_err().to_string();
    assert!(unknown.contains("`rocker`") && unknown.contains("crank.theta"), "{unknown}");
    let here = map.here().unwrap();
    let wrong = here.efforts([("motor", 1.0)]).unwrap_err().to_string();
    assert!(wrong.contains("there is no wanted value `motor`"), "{wrong}");
    let bad = here.velocities([("motor", f64::NAN)]).unwrap_err().to_string();
    assert!(bad.contains("`motor`") || bad.contains("motor"), "{bad}");
}
