//! A function p → (value, gradient) for an optimiser.

use kin::prelude::*;
use kin::results::Quantity;

/// A slider-crank of two dimensions; its slider should go as x(t) of one with 0.1 and 0.3 does.
fn system() -> (System, PlanarBody) {
    let mut m = Mechanism::new("slider-crank");
    let [a, b] = [("crank", 0.12), ("rod", 0.25)]
        .map(|(name, x)| m.dimension(name, x).expect("a dimension"));
    let crank = m.link("crank", a.within(0.02, 0.2)).expect("a link");
    let rod = m.link("rod", b).expect("a link");
    let slider = m.planar("slider", pose(a + b, 0.0, 0.0)).expect("a body");
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0))).expect("adds");
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).expect("adds");
    m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0))).expect("adds");
    m.add("guide", prismatic(slider, Ground, (0.0, 0.0), (0.0, 0.0), (0.0, 1.0), 0.0))
        .expect("adds");
    m.add("motor", drive_angle(crank, Law::linear(0.2, 1.0))).expect("adds");
    (m.build().expect("a slider-crank"), slider)
}

/// Σ (x − x*)² + 0.1 (ẋ − ẋ*)², the target in closed form.
fn cost(x: &Quantity) -> (f64, Vec<[f64; 3]>) {
    let target = |t: f64| {
        let (sin, cos) = (0.2 + t).sin_cos();
        let [r, l] = [0.1_f64, 0.3];
        let root = (l * l - r * r * sin * sin).sqrt();
        [r * cos + root, -r * sin - r * r * sin * cos / root]
    };
    let mut sum = 0.0;
    let all = x.value.values().iter().zip(x.rate.values()).zip(x.value.times());
    let weights = all.map(|((x, rate), t)| {
        let off = [x - target(*t)[0], rate - target(*t)[1]];
        sum += off[0] * off[0] + 0.1 * off[1] * off[1];
        [2.0 * off[0], 0.2 * off[1], 0.0]
    });
    let weights = weights.collect();
    (sum, weights)
}

/// The gradient is that of differences, and vanishes where the target is met.
#[test]
fn value_and_gradient_are_those_of_the_motion() {
    let (system, slider) = system();
    let objective =
        system.objective(["crank", "rod"], linspace(0.0, 6.0, 41), slider.x(), cost).expect("one");
    assert_eq!((objective.start(), objective.names().len()), (vec![0.12, 0.25], 2));
    let at = |p: [f64; 2]| objective.at(&p).expect("a value");
    let (value, gradient) = at([0.12, 0.26]);
    assert_eq!(value, objective.value(&[0.12, 0.26]).expect("a value"));
    for k in 0..2 {
        let beside = |h: f64| {
            let mut p = [0.12, 0.26];
            p[k] += h;
            at(p).0
        };
        let central = |h: f64| (beside(h) - beside(-h)) / (2.0 * h);
        let exact = (4.0 * central(5e-4) - central(1e-3)) / 3.0;
        assert!((gradient[k] - exact).abs() < 1e-8 * exact.abs(), "{} {exact}", gradient[k]);
    }
    let (value, gradient) = at([0.1, 0.3]);
    assert!(
        value < 1e-26 && gradient.iter().all(|slope| slope.abs() < 1e-12),
        "{value} {gradient:?}"
    );
    // The system that it was made of has not moved.
    assert_eq!(system.parameter("crank").expect("a number"), 0.12);
}

/// Newton's method on the gradient, as anybody would write it, finds the lengths of the target.
#[test]
fn a_plain_descent_finds_the_target() {
    let (system, slider) = system();
    let objective =
        system.objective(["crank", "rod"], linspace(0.0, 6.0, 41), slider.x(), cost).expect("one");
    let mut p = objective.start();
    let mut step = 1e-3;
    let (mut value, mut gradient) = objective.at(&p).expect("a value");
    for _ in 0..4000 {
        let next: Vec<f64> = p.iter().zip(&gradient).map(|(p, slope)| p - step * slope).collect();
        match objective.at(&next) {
            Ok((better, slopes)) if better < value => {
                (p, value, gradient, step) = (next, better, slopes, 1.3 * step)
            }
            _ => step *= 0.5,
        }
        if value < 1e-20 {
            break;
        }
    }
    assert!((p[0] - 0.1).abs() < 1e-8 && (p[1] - 0.3).abs() < 1e-7, "{p:?} {value}");
}

#[test]
fn where_there_is_no_value_there_is_an_error() {
    let (system, slider) = system();
    let times = linspace(0.0, 6.0, 41);
    let error = |p: &[f64]| {
        let objective = system.objective(["crank", "rod"], &times, slider.x(), cost).expect("one");
        objective.at(p).expect_err("an error").to_string()
    };
    assert!(error(&[0.3, 0.25]).contains("outside the range"));
    assert!(error(&[0.15, 0.1]).contains("t = ")); // a toggle on the way
    assert!(error(&[0.1]).contains("point of an objective"));
    let unknown = system.objective(["crunk"], &times, slider.x(), cost).err().expect("an error");
    assert!(unknown.to_string().contains("crunk"));
    assert!(system.objective(["crank"], [0.0, 0.0], slider.x(), cost).is_err());
    let short = |_: &Quantity| (0.0, Vec::new());
    let short = system.objective(["crank"], &times, slider.x(), short).expect("one");
    assert!(
        short.at(&[0.1]).expect_err("an error").to_string().contains("weights of an objective")
    );
    let infinite = |y: &Quantity| (f64::NAN, vec![[0.0; 3]; y.value.values().len()]);
    let infinite = system.objective(["crank"], &times, slider.x(), infinite).expect("one");
    assert!(infinite.at(&[0.1]).is_err());
}
