//! Names, units and the order of dimensions change nothing.

use kin::prelude::*;

use super::{apart, same_bits, times};
use crate::engines::Engines;

/// The slider-crank with dimensions of these names, in one order or the other, lengths times
/// `scale`; its motion, and its tolerance by position.
fn made(
    names: [&str; 3],
    backwards: bool,
    scale: f64,
) -> (Motion, Vec<(String, f64)>, kin::design::Tolerance) {
    let mut m = Mechanism::new("slider-crank");
    if scale != 1.0 {
        m.units("mm", "s");
    }
    let values = [0.1, 0.3, 0.02].map(|x| scale * x);
    let mut all = [0, 1, 2].map(|k| (k, names[k], values[k]));
    if backwards {
        all.reverse();
    }
    let mut made: Vec<(usize, Dimension)> = Vec::new();
    for (k, name, value) in all {
        let unit = if scale == 1.0 { "m" } else { "mm" };
        let own = m.dimension(name, value).expect("a dimension").unit(unit);
        made.push((k, own.tolerance(1e-4 * scale * (1.0 + k as f64))));
    }
    made.sort_by_key(|(k, _)| *k);
    let [a, b, e] = [made[0].1, made[1].1, made[2].1];
    let crank = m.link("crank", a).expect("a link");
    let rod = m.link("rod", b).expect("a link");
    let slider = m.planar("slider", pose(a + b, e, 0.0)).expect("a body");
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0))).expect("adds");
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).expect("adds");
    m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0))).expect("adds");
    m.add("guide", prismatic(slider, Ground, (0.0, 0.0), (0.0, e), (0.0, 1.0), 0.0)).expect("adds");
    m.add("motor", drive_angle(crank, Law::linear(0.3, 2.0))).expect("adds");
    let mut system = m.build().expect("a system");
    system.set(names[0], 0.11 * scale).expect("sets");
    let motion = system.run_both(times()).expect("a motion");
    let by = system.sensitivities(&motion, names).expect("derivatives");
    let slopes = by.all().iter().map(|one| (one.name().to_string(), one.qdd(7)[6])).collect();
    let tolerance = system.tolerance(&motion, slider.x()).expect("a tolerance");
    (motion, slopes, tolerance)
}

const NAMES: [&str; 3] = ["crank", "rod", "offset"];

#[test]
fn other_names_and_another_order_give_the_same_bits() {
    let (motion, slopes, tolerance) = made(NAMES, false, 1.0);
    for (names, backwards) in
        [(NAMES, true), (["z", "a b", "R_x"], false), (["z", "a b", "R_x"], true)]
    {
        let (other, renamed, told) = made(names, backwards, 1.0);
        assert!(same_bits(&motion, &other), "{names:?}");
        for (k, (one, other)) in slopes.iter().zip(&renamed).enumerate() {
            assert_eq!((other.0.as_str(), other.1), (names[k], one.1));
        }
        for (one, other) in tolerance.contributions.iter().zip(&told.contributions) {
            let k = NAMES.iter().position(|name| *name == one.name).expect("a name");
            assert_eq!((other.name.as_str(), other.off()), (names[k], one.off()));
        }
        assert_eq!((tolerance.worst_case(), tolerance.t), (told.worst_case(), told.t));
    }
}

/// In millimetres all lengths are a thousand times as large, and angles and derivatives of lengths
/// by lengths what they are.
#[test]
fn other_units_give_the_same_mechanism() {
    let (motion, slopes, tolerance) = made(NAMES, false, 1.0);
    let (other, by, told) = made(NAMES, false, 1e3);
    assert!(apart(&motion, &other) > 0.5);
    for k in 0..motion.len() {
        for (j, name) in motion.names().iter().enumerate() {
            let scale = if name.ends_with("theta") { 1.0 } else { 1e3 };
            for (one, other) in [(motion.q(k), other.q(k)), (motion.qdd(k), other.qdd(k))] {
                let one = scale * one[j];
                let other = other[j];
                assert!((one - other).abs() < 1e-11 * (scale + one.abs()), "{name}: {one} {other}");
            }
        }
    }
    for (one, other) in slopes.iter().zip(&by) {
        assert!((one.1 - other.1).abs() < 1e-10 * (1.0 + one.1.abs()), "{one:?} {other:?}");
    }
    for (one, other) in tolerance.contributions.iter().zip(&told.contributions) {
        assert_eq!((&one.name, one.unit.as_str(), other.unit.as_str()), (&other.name, "m", "mm"));
        assert!((1e3 * one.off() - other.off()).abs() < 1e-10 * (1.0 + other.off().abs()));
    }
    assert!((1e3 * tolerance.rss() - told.rss()).abs() < 1e-10);
}
