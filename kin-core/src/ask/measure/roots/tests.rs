use super::*;

/// A coordinate that goes by a law.
fn driven(law: crate::Law, times: &[f64]) -> (System, Motion, crate::Coordinate) {
    let mut m = crate::Mechanism::new("slider");
    let x = m.length("x", law.at(times[0])).unwrap();
    m.add("motor", crate::joints::drivers::drive(x, law)).unwrap();
    let system = m.build().unwrap();
    let motion = system.run(times).unwrap();
    (system, motion, x)
}

/// The crossings of a level by a law, on a grid.
fn crossings(law: crate::Law, times: &[f64], level: f64) -> Vec<(f64, bool)> {
    let (system, motion, x) = driven(law, times);
    let all = system.crossings(&motion, x, level).unwrap();
    all.into_iter().map(|Crossing { t, rises }| (t, rises)).collect()
}

/// A zero at a time of the grid is told once and at that time, where the sign differs on either
/// side; at the ends and where the function only touches zero it is not.
#[test]
fn zeros_at_times_of_the_grid() {
    let line = crate::Law::linear(-2.0, 1.0);
    for times in [vec![0.0, 1.0, 2.0, 3.0], vec![3.0, 2.0, 1.0, 0.0], vec![1.0, 2.0, 2.5]] {
        let found = crossings(line.clone(), &times, 0.0);
        assert!(
            found.len() == 1 && (found[0].0 - 2.0).abs() < 1e-12 && found[0].1,
            "{times:?}: {found:?}"
        );
    }
    assert_eq!(crossings(line.clone(), &[2.0, 3.0, 4.0], 0.0), []);
    assert_eq!(crossings(line, &[0.0, 1.0, 2.0], 0.0), []);
    // (t − 2)², at a time of the grid
    let touching = crate::Law::polynomial(&[4.0, -4.0, 1.0]);
    assert_eq!(crossings(touching, &[0.0, 1.0, 2.0, 3.0], 0.0), []);
    // down through 0 at 1, up again at 3
    let bowl = crate::Law::polynomial(&[3.0, -4.0, 1.0]);
    let found = crossings(bowl, &[0.0, 1.0, 2.0, 3.0, 4.0], 0.0);
    let near = |k: usize, t: f64, rises: bool| {
        found.get(k).is_some_and(|f| (f.0 - t).abs() < 1e-12 && f.1 == rises)
    };
    assert!(found.len() == 2 && near(0, 1.0, false) && near(1, 3.0, true), "{found:?}");
}

/// Of a rest on the level the first time is told, if the sign differs on either side.
#[test]
fn rests_on_the_level() {
    let rise = |first: f64, second: f64| {
        let up = crate::Law::cycloidal(first, 1.0);
        crate::Law::constant(-1.0) + up + crate::Law::cycloidal(second, 1.0).shifted(4.0)
    };
    let times: Vec<f64> = (0..=12).map(|k| 0.5 * f64::from(k)).collect();
    let found = crossings(rise(1.0, 1.0), &times, 0.0);
    assert!(found.len() == 1 && (found[0].0 - 1.0).abs() < 1e-12 && found[0].1, "{found:?}");
    // back to where it came from
    assert_eq!(crossings(rise(1.0, -0.5), &times, 0.0), []);
    // one time of the grid within the rest, two, and three
    for (count, step) in [(1, 2.5), (2, 1.5), (3, 1.0)] {
        let times: Vec<f64> = (0..=6).map(|k| step * f64::from(k)).filter(|t| *t < 8.0).collect();
        let resting = times.iter().filter(|t| (1.0..=4.0).contains(*t)).count();
        let found = crossings(rise(1.0, 1.0), &times, 0.0);
        assert!(found.len() <= 1 && resting >= count.min(1), "{found:?}");
        assert!(
            found.iter().all(|found| (1.0..=4.0).contains(&found.0) && found.1),
            "{step}: {found:?}"
        );
        assert_eq!(found.len(), 1, "{step}");
    }
}

/// Twice within one step, upwards or downwards, on a step of any length; also where one of both is
/// at a time of the grid.
#[test]
fn two_crossings_within_a_step() {
    use crate::Law;
    // (t − 1.1) (t − 1.2)
    for sign in [1.0, -1.0] {
        let law = Law::polynomial(&[sign * 1.32, sign * -2.3, sign]);
        for (times, backwards) in [
            (vec![0.0, 1.0, 1.25, 3.0], false),
            (vec![0.5, 4.5], false),
            (vec![1.25, 1.0, 0.0], true),
            (vec![3.0, 2.0, 0.0], true),
        ] {
            let found = crossings(law.clone(), &times, 0.0);
            let expected = if backwards { [1.2, 1.1] } else { [1.1, 1.2] };
            assert_eq!(found.len(), 2, "{times:?}");
            for ((t, rises), exact) in found.iter().zip(expected) {
                assert!(
                    (t - exact).abs() < 1e-13 && *rises == ((exact > 1.15) == (sign > 0.0)),
                    "{times:?}: {found:?}"
                );
            }
        }
        // (t − 1) (t − 1.25)
        let law = Law::polynomial(&[sign * 1.25, sign * -2.25, sign]);
        for times in [[0.5, 1.0, 1.5], [0.75, 1.25, 1.5]] {
            let found = crossings(law.clone(), &times, 0.0);
            assert!(
                found.len() == 2
                    && (found[0].0 - 1.0).abs() < 1e-13
                    && (found[1].0 - 1.25).abs() < 1e-13,
                "{times:?}: {found:?}"
            );
        }
        // The cubic would cross zero where the function itself does not: 16 (t − 1.5)⁴ ± …
        let fourth = |off: f64| {
            let power = Law::polynomial(&[sign * off, 0.0, 0.0, 0.0, sign * 16.0])
                .compose(&Law::linear(-1.5, 1.0));
            crossings(power, &[1.0, 2.0], 0.0)
        };
        assert_eq!((fourth(0.01), fourth(0.0), fourth(-0.8e-13)), (vec![], vec![], vec![]));
        let found = fourth(-1.2e-13);
        let half = (1.2e-13_f64 / 16.0).powf(0.25);
        assert!(
            found.len() == 2
                && (found[0].0 - 1.5 + half).abs() < 1e-6
                && (found[1].0 - 1.5 - half).abs() < 1e-6,
            "{found:?}"
        );
    }
}

/// A value of 1e-13 of the largest counts as zero, and one a little larger does not; the same holds
/// for rates.
#[test]
fn what_is_zero_but_for_rounding() {
    use crate::Law;
    for size in [1.0, 1e6, 1e-6] {
        for sign in [size, -size] {
            let value = |c: f64| {
                crossings(Law::polynomial(&[c * sign, 0.0, -sign]), &[-1.0, 0.0, 1.0], 0.0).len()
            };
            let level = |c: f64| {
                crossings(Law::polynomial(&[sign + c * sign, 0.0, -sign]), &[-1.5, 0.0, 1.0], sign)
                    .len()
            };
            assert_eq!(
                (value(0.8e-13), value(1.2e-13), level(0.8e-13), level(2e-13)),
                (0, 2, 0, 2),
                "{sign}"
            );
            let rate = |c: f64| {
                let law = Law::polynomial(&[0.0, c * sign, 0.0, -sign / 3.0]);
                let (system, motion, x) = driven(law, &[-1.0, 0.0, 1.0]);
                system.extremes(&motion, x).unwrap().all().len()
            };
            assert_eq!((rate(0.8e-13), rate(1.2e-13)), (0, 2), "{sign}");
        }
    }
}

/// Where Newton's step would leave the interval, where it is slow, and where it is at once there.
#[test]
fn roots_of_every_kind() {
    use crate::Law;
    let root = |law: Law, times: &[f64]| {
        let found = crossings(law, times, 0.0);
        assert_eq!(found.len(), 1, "{found:?}");
        found[0]
    };
    assert_eq!(root(Law::linear(-2.0, 1.0), &[0.0, 5.0]), (2.0, true));
    assert_eq!(root(Law::linear(2.0, -1.0), &[-3.0, 2.5]), (2.0, false));
    // a cube is slow, and a steep step sends Newton far away
    let cube = |at: f64| Law::polynomial(&[0.0, 0.0, 0.0, 1.0]).compose(&Law::linear(-at, 1.0));
    assert!((root(cube(1.3), &[0.0, 4.0]).0 - 1.3).abs() < 1e-5);
    for (at, from, to) in [
        (0.3, -10.0, 9.0),
        (-7.0, -10.0, 9.0),
        (8.5, -10.0, 9.0),
        (102.0, 100.0, 110.0),
        (-102.0, -110.0, -100.0),
    ] {
        // x/√(1 + x²)-like: 20 (t − at) beside a bounded rise
        let steep = Law::harmonic_rise(2.0, 0.5).shifted(at - 0.25) - Law::constant(1.0)
            + 1e-3 * Law::linear(-at, 1.0);
        for (times, rises) in [([from, to], true), ([to, from], true)] {
            let found = root(steep.clone(), &times);
            assert!(
                (found.0 - at).abs() < 1e-13 * (1.0 + at.abs()) && found.1 == rises,
                "{at}: {found:?}"
            );
        }
        let falling = root(-1.0 * steep, &[from, to]);
        assert!((falling.0 - at).abs() < 1e-13 * (1.0 + at.abs()) && !falling.1);
    }
}

/// Turns of an angle that a pose alone does not show are counted on from the grid; another system's
/// motion is refused.
#[test]
fn angles_are_counted_on_between_times() {
    use crate::Law;
    let (system, motion, x) = driven(Law::ramp(2.0), &[0.0, 1.0, 3.0, 5.0]);
    // as an angle that begins between −π and π, and goes on from there
    let wound = |m: &Motion| {
        let mut quantity = m.coordinate(x)?;
        let first = quantity.value.values()[0];
        let turns = (first / std::f64::consts::TAU).round() * std::f64::consts::TAU;
        quantity.orders_mut()[0].iter_mut().for_each(|x| *x -= turns);
        Ok(quantity)
    };
    for level in [0.5, 5.0, 7.0, 9.5] {
        let found = system.crossings(&motion, wound, level).unwrap();
        assert!(
            found.len() == 1 && (found[0].t - 0.5 * level).abs() < 1e-13 && found[0].rises,
            "{level} {found:?}"
        );
    }
    let mut m = crate::Mechanism::new("two");
    let z = m.length("z", 0.0).unwrap();
    let y = m.length("y", 0.0).unwrap();
    m.add("motor", crate::joints::drivers::drive(y, Law::ramp(2.0))).unwrap();
    m.add("still", crate::joints::drivers::drive(z, Law::constant(0.0))).unwrap();
    let other = m.build().unwrap();
    assert!(
        other.crossings(&motion, wound, 1.0).is_err() && other.extremes(&motion, wound).is_err()
    );
}
