//! Crossings whose branches are known.

use super::*;
use crate::{Mechanism, System, constraint};

/// Two curves x = 0.5 u + 0.7 u² and x = b u + 0.2 u² with u = t − 0.3, or −x so, that cross at x =
/// 1.7, in units far from 1, and y = 3 x + 2 t beside them; they part by `gap`.
#[constraint]
fn crossing(x: Coord, y: Coord, t: Time, gap: f64, unit: f64, b: f64, side: f64) -> [f64; 2] {
    let u = t - 0.3;
    let v = side * (x - 1.7);
    [
        unit * ((v - 0.5 * u - 0.7 * u * u) * (v - b * u - 0.2 * u * u) - gap),
        0.01 * (y - 3.0 * x - 2.0 * t),
    ]
}

/// An ellipse, and nothing inside.
#[constraint]
fn ellipse(x: Coord, t: Time, radius: f64) -> f64 {
    x * x + 100.0 * t * t - radius * radius
}

fn system(gap: f64, unit: f64) -> System {
    with_slope(gap, unit, -2.0, 1.0)
}

fn with_slope(gap: f64, unit: f64, b: f64, side: f64) -> System {
    let mut m = Mechanism::new("crossing");
    let [x, y] =
        [("x", 1.7), ("y", 5.7)].map(|(name, guess)| m.length(name, guess).expect("a new name"));
    m.add("c", crossing(x, y, gap, unit, b, side)).expect("adds");
    m.build().expect("builds")
}

/// Places before and behind the crossing on the branch x = slope u + bend u²/2, and how far they
/// are apart.
fn places(
    curve: &mut Curve<'_>,
    [slope, bend]: [f64; 2],
    [before, behind]: [f64; 2],
) -> (CurvePoint, CurvePoint, f64) {
    let mut at = |u: f64| {
        let x = 1.7 + slope * u + 0.5 * bend * u * u;
        let mut q = vec![x, 3.0 * x + 2.0 * (0.3 + u), 0.3 + u];
        let along = [slope, 3.0 * slope + 2.0, 1.0];
        curve.correct(&mut q, &along).expect("settles");
        curve.place(q, &along).expect("is regular")
    };
    let here = at(before);
    let next = at(behind);
    let gone: Vec<f64> = here.x.iter().zip(&next.x).map(|(a, b)| b - a).collect();
    let s = curve.dot(&gone, &gone).sqrt();
    (here, next, s)
}

fn near(found: &[f64], exact: &[f64], off: f64) {
    assert!(
        found.len() == exact.len()
            && found.iter().zip(exact).all(|(a, b)| (a - b).abs() <= off * (1.0 + b.abs())),
        "{found:?} {exact:?}"
    );
}

/// Where they cross, along which tangents, and with which rates on both: from either side, along
/// either branch, in time and against it.
#[test]
fn curves_that_cross() {
    let sizes = [2.0, 0.5];
    let cases = [
        (1e3, -2.0, 1.0),
        (-1e-3, -2.0, 1.0),
        (1e9, -2.0, -1.0),
        (1e-9, -2.0, 1.0),
        (1.0, 4.0, 1.0),
        (1.0, 4.0, -1.0),
        (-1.0, -0.7, -1.0),
    ];
    let systems = cases.map(|(unit, b, side)| (with_slope(0.0, unit, b, side), b, side));
    let all = systems.iter().flat_map(|(system, b, side)| {
        [(0.5, *b, [1.4, 0.4]), (*b, 0.5, [0.4, 1.4])].map(|(slope, other, bend)| {
            (system, (side * slope, side * other, bend.map(|bend| side * bend)))
        })
    });
    for (system, (slope, other, bend)) in all {
        for (ends, sign) in [
            ([-0.02, 0.03], 1.0),
            ([-0.05, 0.01], 1.0),
            ([-0.001, 0.06], 1.0),
            ([0.02, -0.03], -1.0),
        ] {
            let mut curve = Curve::new(system, &sizes, 3.0);
            let (here, next, s) = places(&mut curve, [slope, bend[0]], ends);
            // Along the curve on which time goes on as asked.
            let here = if sign < 0.0 {
                curve
                    .place(here.x.clone(), &here.dx.iter().map(|dx| -dx).collect::<Vec<_>>())
                    .expect("is regular")
            } else {
                here
            };
            let next = if sign < 0.0 {
                curve.place(next.x.clone(), &here.dx).expect("is regular")
            } else {
                next
            };
            let again = curve.place(here.x.clone(), &here.dx).expect("is regular");
            let found = find(&mut curve, &again, &next, s, sign).expect("they cross");
            near(&found.x, &[1.7, 5.7, 0.3], 1e-9);
            for (k, slope) in [(0, slope), (1, other)] {
                let tangent = &found.tangents[k];
                let dt = tangent[2];
                assert!(dt * sign > 0.0 && (curve.dot(tangent, tangent) - 1.0).abs() < 1e-12);
                near(&[tangent[0] / dt, tangent[1] / dt], &[slope, 3.0 * slope + 2.0], 1e-7);
                let rates = found.rates[k].as_ref().expect("the drivers move");
                near(&rates.qd, &[slope, 3.0 * slope + 2.0], 1e-7);
                near(&rates.qdd, &[bend[k], 3.0 * bend[k]], 1e-5);
            }
        }
    }
}

/// Curves that come near one another and part do not cross, on whichever side they pass; nor does
/// what is far off count, or a point alone.
#[test]
fn curves_that_do_not_cross() {
    for (gap, crosses) in [
        (1e-6, false),
        (-1e-6, false),
        (1e-9, false),
        (-1e-9, false),
        (1e-15, true),
        (-1e-15, true),
    ] {
        let system = system(gap, 1e3);
        let mut curve = Curve::new(&system, &[2.0, 0.5], 3.0);
        let (here, next, s) = places(&mut curve, [0.5, 1.4], [-0.02, 0.03]);
        let here = curve.place(here.x.clone(), &here.dx).expect("is regular");
        assert_eq!(find(&mut curve, &here, &next, s, 1.0).is_some(), crosses, "{gap}");
    }
    let system = system(0.0, 1e3);
    let mut curve = Curve::new(&system, &[2.0, 0.5], 3.0);
    let (here, next, s) = places(&mut curve, [0.5, 1.4], [0.2, 0.21]);
    let here = curve.place(here.x.clone(), &here.dx).expect("is regular");
    assert!(find(&mut curve, &here, &next, s, 1.0).is_none());
    // Neither branch goes on as it came.
    let (here, next, s) = places(&mut curve, [0.5, 1.4], [-0.01, 0.01]);
    let mut here = curve.place(here.x.clone(), &here.dx).expect("is regular");
    let found = find(&mut curve, &here, &next, s, 1.0).expect("they cross");
    let [one, other] = &found.tangents;
    let share = curve.dot(one, other);
    let across: Vec<f64> = one.iter().zip(other).map(|(a, b)| b - share * a).collect();
    let length = curve.dot(&across, &across).sqrt();
    here.dx =
        one.iter().zip(&across).map(|(a, b)| 0.5 * a + 0.75_f64.sqrt() / length * b).collect();
    assert!(
        (curve.dot(&here.dx, one) - 0.5).abs() < 1e-12 && curve.dot(&here.dx, other).abs() < 0.75
    );
    curve.place(here.x.clone(), &here.dx).expect("is regular");
    assert!(find(&mut curve, &here, &next, s, 1.0).is_none());

    let mut m = Mechanism::new("ellipse");
    let x = m.length("x", 1.0).expect("a new name");
    m.add("c", ellipse(x, 1e-8)).expect("adds");
    let system = m.build().expect("builds");
    let mut curve = Curve::new(&system, &[1.0], 1.0);
    for along in [1.0, -1.0] {
        let here = curve.place(vec![0.0, -1e-9], &[along, 0.0]).expect("is regular");
        let next = curve.place(vec![0.0, 1e-9], &[along, 0.0]).expect("is regular");
        let here = curve.place(here.x, &here.dx).expect("is regular");
        assert!(find(&mut curve, &here, &next, 1e-7, 1.0).is_none());
    }
}

/// On a branch along which the drivers stand still there are no rates.
#[test]
fn a_branch_on_which_time_stands() {
    let mut m = Mechanism::new("still");
    let [x, y] =
        [("x", 0.0), ("y", 0.0)].map(|(name, guess)| m.length(name, guess).expect("a new name"));
    m.add("c", standing(x, y)).expect("adds");
    let system = m.build().expect("builds");
    let mut curve = Curve::new(&system, &[1.0, 1.0], 1.0);
    let along = [1.0, 0.0, 1.0];
    let here = curve.place(vec![-0.01, 0.0, -0.01], &along).expect("is regular");
    let next = curve.place(vec![0.01, 0.0, 0.01], &along).expect("is regular");
    let here = curve.place(here.x, &here.dx).expect("is regular");
    let found = find(&mut curve, &here, &next, 0.03, 1.0).expect("they cross");
    assert!(found.rates[0].is_some() && found.rates[1].is_none());
    near(&found.tangents[1].iter().map(|x| x.abs()).collect::<Vec<_>>(), &[1.0, 0.0, 0.0], 1e-9);
}

/// (x − t) t = 0: along t = 0 x may be anything.
#[constraint]
fn standing(x: Coord, y: Coord, t: Time) -> [f64; 2] {
    [(x - t) * t, y - t * t * (x - t)]
}
