//! Derivatives by dimensions are those of all that hangs on them.

use kin::prelude::*;

use crate::engines::Engines;

use super::{NOMINAL, times};

/// Differences of motions set to both sides, extrapolated: two steps of the fourth order.
fn differences(system: &System, name: &str, h: f64) -> Vec<f64> {
    let value = system.parameter(name).unwrap();
    let at = |step: f64| -> Vec<f64> {
        let mut moved = system.clone();
        moved.set(name, value + step).unwrap();
        let m = moved.run_both(times()).unwrap();
        (0..m.len()).flat_map(|k| [m.q(k), m.qd(k), m.qdd(k)].concat()).collect()
    };
    let central = |h: f64| -> Vec<f64> {
        at(h).iter().zip(at(-h)).map(|(a, b)| (a - b) / (2.0 * h)).collect()
    };
    central(h)
        .iter()
        .zip(central(h / 2.0))
        .map(|(wide, narrow)| (4.0 * narrow - wide) / 3.0)
        .collect()
}

#[test]
fn derivatives_by_dimensions_agree_with_differences() {
    let system = NOMINAL.described().unwrap().build().unwrap();
    let motion = system.run_both(times()).unwrap();
    let names = ["crank", "ratio", "offset", "speed"];
    let by = system.sensitivities(&motion, names).unwrap();
    for name in names {
        let one = by.by(name).unwrap();
        let exact: Vec<f64> =
            (0..motion.len()).flat_map(|k| [one.q(k), one.qd(k), one.qdd(k)].concat()).collect();
        let size = exact.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        let found = differences(&system, name, 1e-3 * system.parameter(name).unwrap());
        for (exact, found) in exact.iter().zip(found) {
            assert!((exact - found).abs() < 1e-8 * size, "{name}: {exact} {found}");
        }
    }
}

#[test]
fn forward_and_backward_agree_and_follow_the_chain_rule() {
    let system = NOMINAL.described().unwrap().build().unwrap();
    let motion = system.run_both(times()).unwrap();
    let slider = motion.names().iter().position(|name| name == "slider.R_x").unwrap();
    let names = ["crank", "ratio", "offset", "speed", "A.u_i.x"];
    let weights = |k: usize| [0.1 * k as f64, 1.0, -0.3];
    let what = || "slider.R_x";
    let backward = system.gradient(&motion, names, what(), weights).unwrap();
    let by = system.sensitivities(&motion, names).unwrap();
    for (name, backward) in names.iter().zip(backward) {
        let one = by.by(name).unwrap();
        let at = |k: usize| {
            let [a, b, c] = weights(k);
            a * one.q(k)[slider] + b * one.qd(k)[slider] + c * one.qdd(k)[slider]
        };
        let forward: f64 = (0..motion.len()).map(at).sum();
        assert!(
            (forward - backward).abs() < 1e-12 * (1.0 + forward.abs()),
            "{name}: {forward} {backward}"
        );
    }
    // crank stands in both pins of the crank and, times the ratio, in both of the rod.
    let parts = ["O.u_i.x", "A.u_i.x", "A.u_j.x", "B.u_i.x"];
    let slopes = [-0.5, 0.5, -1.5, 1.5];
    let parts = system.sensitivities(&motion, parts).unwrap();
    for k in 0..motion.len() {
        let sum: f64 =
            parts.all().iter().zip(slopes).map(|(part, slope)| slope * part.qdd(k)[slider]).sum();
        let whole = by.by("crank").unwrap().qdd(k)[slider];
        assert!((sum - whole).abs() < 1e-12 * (1.0 + whole.abs()), "{sum} {whole}");
    }
}

/// A parallelogram with a third crank closes only while all three are alike: no derivative by one
/// of them, one by the dimension that all of them hang on.
#[test]
fn of_a_redundant_mechanism_what_moves_together_has_a_derivative() {
    let mut m = Mechanism::new("parallelogram");
    let length = m.dimension("length", 0.5).unwrap();
    let own = m.dimension("own", 0.5).unwrap();
    let bar = m.planar("bar", pose(1.0, 0.5, 0.0)).unwrap();
    for (k, length) in [length, length, length + 0.0 * own].into_iter().enumerate() {
        let x = k as f64;
        let name = format!("crank {k}");
        let crank = m.link(&name, length).unwrap();
        m.add(&format!("O{k}"), revolute(crank, Ground, crank.start(), (x, 0.0))).unwrap();
        m.add(&format!("A{k}"), revolute(crank, bar, crank.end(), (x - 1.0, 0.0))).unwrap();
        m.prefer(crank, deg(80.0));
        if k == 0 {
            m.add("motor", drive_angle(crank, Law::linear(deg(80.0), 0.1))).unwrap();
        }
    }
    let system = m.build().unwrap();
    let motion = system.run_both(linspace(0.0, 1.0, 5)).unwrap();
    let refused = system.sensitivities(&motion, ["A2.u_i.x"]).map(|_| ()).unwrap_err().to_string();
    assert!(
        refused.contains(
            "Kin cannot compute a derivative by `A2.u_i.x`: the redundant mechanism closes"
        ),
        "{refused}"
    );
    let by = system.sensitivities(&motion, ["length"]).unwrap();
    // The bar's middle is at length · (cos θ, sin θ) from the middle pin.
    let x = by.all()[0].q(4)[0];
    let theta = deg(80.0) + 0.1;
    assert!((x - theta.cos()).abs() < 1e-12, "{x}");
}

#[test]
fn what_has_no_derivative_is_told_by_name() {
    let mut m = Mechanism::new("kinks");
    let a = m.dimension("a", 0.0).unwrap();
    let half = m.dimension("half", a / 2.0).unwrap();
    let guess = m.dimension("guess", 0.1).unwrap();
    let x = m.length("x", guess).unwrap();
    let y = m.length("y", 0.0).unwrap();
    m.add("x drive", drive(x, Law::constant(a.sqrt()))).unwrap();
    m.add("y drive", drive(y, Law::constant(half))).unwrap();
    let system = m.build().unwrap();
    let motion = system.run_both([0.0, 1.0]).unwrap();
    for (name, told) in [
        (
            "a",
            "Kin cannot compute a derivative by `a`: `x drive.law.c` has no finite derivative by `a`",
        ),
        ("half", "`half`: the dimension is an expression of other dimensions"),
        (
            "guess",
            "Kin cannot compute a derivative by `guess`: no equation depends on the parameter",
        ),
        ("z", "`z`"),
    ] {
        let error = system.sensitivities(&motion, [name]).map(|_| ()).unwrap_err().to_string();
        assert!(error.contains(told), "{error}");
    }
}
