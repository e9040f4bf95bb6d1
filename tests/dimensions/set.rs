//! A dimension that is set moves all that hangs on it.

use kin::Constraint;
use kin::prelude::*;

use super::{NOMINAL, SliderCrank, apart, same_bits, times};
use crate::engines::Engines;

const OTHER: SliderCrank = SliderCrank { crank: 0.13, rod: 0.39, offset: -0.01, speed: 2.5 };

fn set(system: &mut System, order: [usize; 3]) {
    let all = [("crank", OTHER.crank), ("offset", OTHER.offset), ("speed", OTHER.speed)];
    for k in order {
        system.set(all[k].0, all[k].1).unwrap();
    }
}

#[test]
fn set_equals_a_mechanism_built_with_that_number() {
    let mut system = NOMINAL.described().unwrap().build().unwrap();
    let nominal = system.run_both(times()).unwrap();
    assert!(
        apart(&nominal, &NOMINAL.plain().unwrap().build().unwrap().run_both(times()).unwrap())
            < 1e-13
    );
    set(&mut system, [0, 1, 2]);
    let moved = system.run_both(times()).unwrap();
    assert!(apart(&moved, &nominal) > 0.01);
    for built in [OTHER.plain(), OTHER.described()] {
        let built = built.unwrap().build().unwrap();
        assert!(apart(&moved, &built.run_both(times()).unwrap()) < 1e-13);
    }
    // The length that pictures and scales go by, too.
    let link = system.bodies()[1].1;
    assert!((system.link_length(&link).unwrap() - 0.39).abs() < 1e-15);
}

#[test]
fn any_way_there_gives_the_same_bits() {
    let fresh = || NOMINAL.described().unwrap().build().unwrap();
    let mut straight = fresh();
    set(&mut straight, [0, 1, 2]);
    let expected = straight.run_both(times()).unwrap();
    // In another order, and by detours.
    let mut other = fresh();
    other.set("crank", 0.09).unwrap();
    set(&mut other, [2, 1, 0]);
    assert!(same_bits(&other.run_both(times()).unwrap(), &expected));
    // Parameter by parameter, on the same system.
    let mut each = fresh();
    each.set_initial(straight.initial()).unwrap();
    for (name, value) in straight.parameters() {
        each.set(&name, value).unwrap();
    }
    assert!(same_bits(&each.run_both(times()).unwrap(), &expected));
    // And back again.
    let mut back = straight;
    for (name, value) in fresh().dimensions() {
        back.set(&name, value).unwrap();
    }
    assert!(same_bits(&back.run_both(times()).unwrap(), &fresh().run_both(times()).unwrap()));
}

#[test]
fn sweeps_name_dimensions() {
    let system = NOMINAL.described().unwrap().build().unwrap();
    let cases: Vec<[f64; 2]> =
        (0..40).map(|k| [0.06 + 0.002 * k as f64, 0.0005 * k as f64]).collect();
    let keep = |_: usize, motion: kin::Result<Motion>| motion.unwrap();
    let sweep = |lanes| system.sweep(["crank", "offset"]).unwrap().lanes(lanes);
    let wide = kin::extend::Lanes::Best;
    let single = kin::extend::Lanes::Off;
    let wide = sweep(wide).run(&cases, times(), keep).unwrap();
    let single = sweep(single).run(&cases, times(), keep).unwrap();
    for ((case, wide), single) in cases.iter().zip(wide).zip(single) {
        let mut alone = system.clone();
        alone.set("crank", case[0]).unwrap();
        alone.set("offset", case[1]).unwrap();
        let alone = alone.run_both(times()).unwrap();
        assert!(same_bits(&single, &alone), "{case:?}");
        assert!(apart(&wide, &alone) < 1e-10, "{case:?}");
    }
}

#[test]
fn expressions_have_their_values_wherever_numbers_stand() {
    let mut m = Mechanism::new("everywhere");
    let a = m.dimension("a", 3.0).unwrap();
    let b = m.dimension("b", 4.0).unwrap();
    let arm = m.planar("arm", pose(0.0, a, b)).unwrap();
    let other = m.planar("other", pose(0.0, 0.0, 0.0)).unwrap();
    let x = m.length("x", a / 2.0).unwrap();
    let point = vec2(a, 1.0) + vec2(b, 0.0) * a;
    m.add("pin", revolute(arm, other, point, [a.hypot(b), -a])).unwrap();
    m.add("turn", drive(x, (a * 2.0) * Law::polynomial(&[a.sqrt(), b.powi(2)]).shifted(b / 8.0)))
        .unwrap();
    m.add(
        "table",
        drive_angle(arm, Law::spline(&[(0.0, a), (1.0, b), (2.0, a - b)], Ends::Natural)),
    )
    .unwrap();
    m.add("slope", drive_angle(other, Law::sequence(a, [(b, Law::ramp(a.max(b)))]))).unwrap();
    let diagnosis = m.diagnose(0.0);
    assert!(diagnosis.is_ok());
    m.add("height", drive(arm.y(), Law::constant(0.0))).unwrap();
    m.add("width", drive(arm.x(), Law::constant(0.0))).unwrap();
    let mut system = m.build().unwrap();
    for (a, b) in [(3.0, 4.0), (5.0, 12.0)] {
        system.set("a", a).unwrap();
        system.set("b", b).unwrap();
        for (name, value) in [
            ("pin.u_i.x", a + b * a),
            ("pin.u_i.y", 1.0 + 0.0 * a),
            ("pin.u_j.x", a.hypot(b)),
            ("pin.u_j.y", -a),
            ("turn.law.factor", a * 2.0),
            ("turn.law.law.outer.c[0]", a.sqrt()),
            ("turn.law.law.outer.c[1]", b * b),
            ("turn.law.law.inner.f0", -(b / 8.0)),
            ("table.law.y[0]", a),
            ("table.law.y[2]", a - b),
            ("slope.law.start", a),
            ("slope.law.part[0].length", b),
            ("slope.law.part[0].law.rate", a.max(b)),
        ] {
            assert_eq!(system.parameter(name).unwrap(), value, "{name}");
        }
        assert_eq!(system.initial()[1..3], [a, b]);
        assert_eq!(system.initial()[6], a / 2.0);
    }
}

/// Rows of all kinds of parameters.
#[constraint]
fn many(
    i: Planar,
    k: f64,
    v: Vec2,
    list: [f64; 3],
    points: [Vec2; 2],
    pair: (f64, Vec2),
    grid: [[f64; 2]; 2],
) -> f64 {
    let sum = list[0] + list[1] * list[2] + grid[0][1] - grid[1][0];
    i.point(points[1]).x * k + v.dot(points[0]) + pair.0 * pair.1.y + sum
}

/// A law of one's own.
#[law]
fn bump(x: f64, height: f64, widths: [f64; 2], under: Law) -> f64 {
    height / (widths[0] + x * x * widths[1]) + under.at(x)
}

#[test]
fn constraints_and_laws_of_ones_own_take_them() {
    let mut m = Mechanism::new("own");
    let a = m.dimension("a", 2.0).unwrap();
    let body = m.planar("body", pose(0.0, 0.0, 0.0)).unwrap();
    let own = many(
        body,
        a,
        (a, 1.0),
        [a, 1.0.into(), -a],
        [vec2(1.0, 2.0), vec2(3.0, 4.0)],
        (1.0, vec2(0.0, a * a)),
        [[0.0, 1.0], [2.0, 3.0]],
    );
    assert_eq!(own.facts().kind, "many");
    m.add("own", own).unwrap();
    m.add("y", drive(body.y(), bump(a / 4.0, [1.0, 2.0], Law::ramp(a)))).unwrap();
    m.add("theta", drive_angle(body, Law::constant(0.0))).unwrap();
    let mut system = m.build().unwrap();
    system.set("a", 6.0).unwrap();
    let parameters = system.parameters();
    let value = |name: &str| parameters.iter().find(|(known, _)| known == name).map(|(_, x)| *x);
    for (name, expected) in [
        ("own.k", 6.0),
        ("own.v.x", 6.0),
        ("own.v.y", 1.0),
        ("own.list[0]", 6.0),
        ("own.list[1]", 1.0),
        ("own.list[2]", -6.0),
        ("own.pair.1.y", 36.0),
        ("y.law.height", 1.5),
        ("y.law.under.rate", 6.0),
    ] {
        assert_eq!(value(name), Some(expected), "{name}");
    }
}

#[test]
fn a_copy_of_a_mechanism_has_the_same_dimensions() {
    let first = NOMINAL.described().unwrap();
    let mut second = first.clone();
    let a = second.dimension_named("crank").unwrap();
    let slider = second.planar_named("slider").unwrap();
    second
        .add("stop", point_on_line(slider, Ground, (0.0, 0.0), (0.0, a / 1e3), (1.0, 0.0)))
        .unwrap();
    drop(first);
    assert_eq!((a * 2.0).value(), 0.2);
}
