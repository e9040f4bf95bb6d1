//! Several loops that turn round or cross at once.

use super::*;

/// Several loops that turn round together: told between two places that are near one another,
/// unless the time asked for comes before.
#[test]
fn turning_round_together() {
    let system = one(|m, name, x| assert!(m.add(name, arc(x)).is_ok()));
    walking(&system, [0.02, -25.0, (4.0 - 4.0 * 4e-4_f64).sqrt(), 3.0], false, |mut walk| {
        // to just before the toggle, and over it
        let mut s = 0.5 * TOGETHER;
        let mut next = walk.curve.step(&walk.here, s).expect("is followed");
        while next.dt() > 0.0 {
            (walk.here, s) = (next, 0.5 * TOGETHER);
            next = walk.curve.step(&walk.here, s).expect("is followed");
        }
        let turn = *turning::between(&walk.here, &next, s).expect("turns").last().unwrap();
        assert!((turn - 2.0).abs() < 1e-9);
        let ends = |walk: &mut Walk<'_, '_>, to: f64| {
            walk.to = to;
            match walk.turn_together(&next, s) {
                Err(Lost::Turned(place)) => (place.t - 2.0).abs() < 1e-9,
                Ok(None) => false,
                _ => panic!("is lost"),
            }
        };
        let time = walk.time;
        let found = [3.0, turn, turn - 5e-13 * time, turn - 5e-12 * time, 1.5]
            .map(|to| ends(&mut walk, to));
        assert_eq!(found, [true, true, true, false, false]);
        walk.to = 3.0;
        assert!(matches!(walk.turn_together(&next, 2.0 * TOGETHER), Ok(None)));
    });
}

/// The other branch is taken where it is met as it was foreseen: not too far off, along its
/// tangent, and with time going on.
#[test]
fn turning_into_a_branch() {
    let system = one(|m, name, x| assert!(m.add(name, crossing(x)).is_ok()));
    walking(&system, [-0.132, 0.38, 0.0, 1.0], true, |mut walk| {
        let s = 0.05;
        let tangent = |walk: &Walk<'_, '_>, slope: f64| {
            let length = walk.curve.dot(&[slope, 1.0], &[slope, 1.0]).sqrt();
            vec![slope / length, 1.0 / length]
        };
        let dx = tangent(&walk, 0.5);
        let h = s * dx[1];
        let into = |walk: &mut Walk<'_, '_>, dx: &[f64], off: f64| {
            // so far beside the branch, by the measures
            let qdd = 0.4 + 2.0 * off * walk.curve.sizes[0] / (h * h);
            walk.turn_into(&[0.0, 0.3], dx, &Branch { qd: vec![0.5], qdd: vec![qdd] }, s)
        };
        let place = into(&mut walk, &dx, 0.0).expect("is taken");
        let u = place.t() - 0.3;
        assert!((place.x[0] - 0.5 * u - 0.2 * u * u).abs() < 1e-12 && (u - h).abs() < 0.2 * h);
        assert!(
            into(&mut walk, &dx, 0.03 * s).is_some()
                && into(&mut walk, &dx, 0.1 * s).is_none()
                && into(&mut walk, &dx, -0.1 * s).is_none()
        );
        // asked for along a direction that is not its own
        let across = [
            dx[1] * walk.curve.sizes[0] / walk.curve.sizes[1],
            -dx[0] * walk.curve.sizes[1] / walk.curve.sizes[0],
        ];
        let turned = |angle: f64| [0, 1].map(|k| angle.cos() * dx[k] + angle.sin() * across[k]);
        let skew = |walk: &mut Walk<'_, '_>, angle: f64| {
            let dx = turned(angle);
            let h = s * dx[1];
            walk.turn_into(&[0.0, 0.3], &dx, &Branch { qd: vec![0.5], qdd: vec![0.4] }, s)
                .map(|_| h)
        };
        assert!(
            skew(&mut walk, 0.2).is_some()
                && skew(&mut walk, 0.7).is_none()
                && skew(&mut walk, -0.7).is_none()
        );
        walk.sign = -1.0;
        assert!(into(&mut walk, &dx, 0.0).is_none());
    });
}

/// An even number of loops that turn over in a short step: rates are those of the place between
/// both ends; the time asked for may be before it, at it, or behind.
#[test]
fn crossing_together() {
    let system = one(|m, name, x| assert!(m.add(name, arc(x)).is_ok()));
    let at = |t: f64| (1.0 - 0.25 * t * t).sqrt();
    walking(&system, [at(1.0), -0.25 / at(1.0), 1.0, 3.0], false, |walk| {
        let time = walk.time;
        let sizes = walk.curve.sizes.clone();
        let s = 0.01;
        let cross = |to: f64, share: f64| {
            walking(&system, [at(1.0), -0.25 / at(1.0), 1.0, 3.0], false, |mut walk| {
                let next = walk.curve.step(&walk.here, s).expect("is followed");
                (walk.to, walk.time) = (to, time);
                let here = walk.here.rates();
                let behind = next.rates();
                let stepped = walk.cross_together(next, s, share * s).expect("is followed");
                (stepped, walk.passed, here, behind)
            })
        };
        let next = walking(&system, [at(1.0), -0.25 / at(1.0), 1.0, 3.0], false, |mut walk| {
            walk.curve.step(&walk.here, s).expect("is followed")
        });
        let t = |share: f64| *walk.here.ahead(share * s).last().unwrap();
        // behind it, at the end of the step and on the way there
        let (stepped, passed, here, behind) = cross(3.0, 0.25);
        assert!(
            matches!(stepped, Stepped::On(_))
                && passed.len() == 1
                && (passed[0].t - t(0.25)).abs() < 1e-12,
            "{time} {sizes:?}"
        );
        for k in 0..2 {
            let found = [&passed[0].branches[0].qd, &passed[0].branches[0].qdd][k][0];
            let a = here[k][0];
            let b = behind[k][0];
            assert!(
                (found - a - 0.25 * (b - a)).abs() < 1e-9 * (b - a).abs(),
                "{k}: {found} {a} {b}"
            );
        }
        let regular = |to: f64, share: f64| match cross(to, share) {
            (Stepped::Landed(Landed::Regular(q)), passed, ..) => (q[0], passed.len()),
            _ => panic!("lands on the curve"),
        };
        assert_eq!(regular(next.t(), 0.25), (next.x[0], 1));
        for (share, asked, count) in [(0.25, 0.75, 1), (0.75, 0.25, 0)] {
            let (found, passed) = regular(t(asked), share);
            assert!((found - at(t(asked))).abs() < 1e-12 && passed == count, "{share} {asked}");
        }
        // at it, but for a ten-millionth of the measure of time
        for off in [0.0, 5e-8, -5e-8] {
            let (stepped, passed, ..) = cross(t(0.5) + off * time, 0.5);
            let Stepped::Landed(Landed::Singular(q, _)) = stepped else { panic!("lands there") };
            assert!((q[0] - at(t(0.5) + off * time)).abs() < 1e-7 && passed.len() == 1);
        }
    });
}
