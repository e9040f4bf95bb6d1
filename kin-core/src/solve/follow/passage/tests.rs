//! Positions that are passed, or at which a motion ends, where several loops come to them at once:
//! on equations whose solutions are known.

mod together;

use super::*;
use crate::model::mechanism::linspace;
use crate::outcome::error::{FailureKind, RunFailure};
use crate::solve::newton::Steps;
use crate::solve::options::SolverOptions;
use crate::{Mechanism, System, constraint};

/// x² = 1 − t²/4: a toggle at t = 2.
#[constraint]
fn arc(x: Coord, t: Time) -> f64 {
    x * x - 1.0 + 0.25 * t * t
}

/// x = u/2 + u²/5 and x = −2 u with u = t − 0.3 cross at x = 0.
#[constraint]
fn crossing(x: Coord, t: Time) -> f64 {
    let u = t - 0.3;
    (x - 0.5 * u - 0.2 * u * u) * (x + 2.0 * u)
}

fn loops(
    count: usize,
    guess: f64,
    add: impl Fn(&mut Mechanism, &str, crate::coordinates::Coordinate),
) -> System {
    let mut m = Mechanism::new("loops");
    for k in 0..count {
        let name = format!("x{k}");
        let x = m
            .length(&name, guess * (1.0 - 2.0 * (k % 2) as f64).powi(i32::from(guess == 1.0)))
            .expect("a new name");
        add(&mut m, &format!("c{k}"), x);
    }
    m.build().expect("builds")
}

/// Loops that come to their toggles together end there, whether on a coarse grid or a fine one, and
/// one that ends at the toggle comes to it.
#[test]
fn loops_that_toggle_together() {
    for count in [1, 2, 3] {
        let system = loops(count, 1.0, |m, name, x| assert!(m.add(name, arc(x)).is_ok()));
        for points in [3, 7, 40] {
            let error = system.run(linspace(0.0, 3.0, points)).unwrap_err();
            let Some(RunFailure { t, kind: FailureKind::Toggle { movable, .. }, .. }) =
                error.failure()
            else {
                panic!("{count} {points}: {error}")
            };
            assert!(
                (t - 2.0).abs() < 1e-9 && movable.contains(&"x0".to_string()),
                "{count} {points}: {t} {movable:?}"
            );
        }
        let motion = system.run(linspace(0.0, 1.99, 12)).expect("comes so far");
        for k in 0..count {
            let sense = if k % 2 == 0 { 1.0 } else { -1.0 };
            assert!(
                (motion.q(11)[k] - sense * (1.0 - 0.25 * 1.99 * 1.99_f64).sqrt()).abs() < 1e-12
            );
        }
    }
}

/// Loops whose branches cross together go on smoothly, whether the crossing is a time of the grid
/// or not, and in both senses of time.
#[test]
fn loops_that_cross_together() {
    for count in [1, 2, 4] {
        let system = loops(count, -0.13, |m, name, x| assert!(m.add(name, crossing(x)).is_ok()));
        for times in [
            linspace(0.0, 1.0, 6),
            linspace(0.0, 1.0, 11),
            linspace(0.0, 0.3, 4),
            linspace(0.0, 0.6, 3),
            linspace(0.0, 1.0, 101),
        ] {
            let motion = system
                .run(times.clone())
                .unwrap_or_else(|error| panic!("{count} {times:?}: {error}"));
            let places = motion.singular_positions();
            assert!(
                places.len() == 1 && (places[0].t - 0.3).abs() < 1e-6,
                "{count} {times:?}: {places:?}"
            );
            let branch = &places[0].branches[0];
            for k in 0..count {
                assert!(
                    (branch.qd[k] - 0.5).abs() < 1e-5 && (branch.qdd[k] - 0.4).abs() < 1e-3,
                    "{count} {times:?}: {branch:?}"
                );
                for (at, t) in times.iter().enumerate() {
                    let u = t - 0.3;
                    assert!(
                        (motion.q(at)[k] - 0.5 * u - 0.2 * u * u).abs() < 1e-8,
                        "{count} {t} of {times:?}: {:?}",
                        motion.q(at)
                    );
                    assert!(
                        (motion.qd(at)[k] - 0.5 - 0.4 * u).abs() < 1e-5,
                        "{count} {t} of {times:?}: {:?}",
                        motion.qd(at)
                    );
                }
            }
        }
    }
}

/// x = u/2 + u²/5 and x = −2 u + 4 u³ with u = t − 0.3 cross at x = 0.
#[constraint]
fn cubic_crossing(x: Coord, t: Time) -> f64 {
    let u = t - 0.3;
    (x - 0.5 * u - 0.2 * u * u) * (x + 2.0 * u - 4.0 * u * u * u)
}

/// Something of a walk that begins at x and t with a rate.
fn walking<R>(
    system: &System,
    [x, qd, t, to]: [f64; 4],
    other: bool,
    f: impl FnOnce(Walk<'_, '_>) -> R,
) -> R {
    let options = SolverOptions::default();
    let mut newton = Newton::new(system, &options);
    newton.q.iter_mut().for_each(|q| *q = x);
    newton.solve(t, Steps::Full).expect("solves");
    newton.qd.iter_mut().for_each(|rate| *rate = qd);
    let q = newton.q.to_vec();
    f(Walk::new(&newton, &q, t, to, &|_| other).expect("is regular"))
}

fn one(add: impl Fn(&mut Mechanism, &str, crate::coordinates::Coordinate)) -> System {
    loops(1, 0.5, add)
}

/// Where a walk ends, on which branch if there, and how many positions were passed.
fn ends(walk: Walk<'_, '_>) -> (f64, Option<Branch>, usize) {
    let Ok(Passage { landed, passed }) = walk.go(&mut 0) else { panic!("is lost") };
    match landed {
        Landed::Regular(q) => {
            assert_eq!(q.len(), 1);
            (q[0], None, passed.len())
        }
        Landed::Singular(q, branch) => (q[0], Some(branch), passed.len()),
    }
}

/// From before a crossing to times before, at and behind it, near and far, straight on or into the
/// other branch, in both senses of time.
#[test]
fn through_a_crossing_on_either_branch() {
    let system = one(|m, name, x| assert!(m.add(name, cubic_crossing(x)).is_ok()));
    let first = |u: f64| [0.5 * u + 0.2 * u * u, 0.5 + 0.4 * u, 0.4];
    let second = |u: f64| [-2.0 * u + 4.0 * u.powi(3), -2.0 + 12.0 * u * u, 24.0 * u];
    for (from, sense) in [(-0.2, 1.0), (0.2, -1.0), (-0.02, 1.0), (0.003, -1.0)] {
        for turns in [false, true] {
            for branches in [[first, second], [second, first]] {
                let [x, qd, _] = branches[0](from);
                for at in [-0.5 * sense * from.abs(), 0.0, 1e-4, 1e-3, 0.01, 0.1, 0.3] {
                    let u = sense * at;
                    let (found, branch, passed) =
                        walking(&system, [x, qd, 0.3 + from, 0.3 + u], turns, ends);
                    let beyond = at >= 0.0 && sense * (u - from) > 0.0 && u * from <= 0.0;
                    let exact = branches[usize::from(turns && beyond)](u);
                    let case = format!("{from} {turns} {u}: {found} {exact:?} {passed}");
                    assert!(
                        (found - exact[0]).abs() < 1e-9 && passed == usize::from(beyond),
                        "{case}"
                    );
                    assert_eq!(branch.is_some(), at == 0.0, "{case}");
                    branch.iter().for_each(|branch| {
                        assert!((branch.qd[0] - exact[1]).abs() < 1e-5, "{case} {branch:?}")
                    });
                }
            }
        }
    }
}

/// A toggle is the end of a motion that asks for it or for more, and is found as exactly as it is
/// known; what ends before it is reached.
#[test]
fn a_toggle_ends_a_passage() {
    let system = one(|m, name, x| assert!(m.add(name, arc(x)).is_ok()));
    let x = (1.0 - 0.25 * 1.9 * 1.9_f64).sqrt();
    let qd = -0.25 * 1.9 / (1.0 - 0.25 * 1.9 * 1.9_f64).sqrt();
    for sense in [1.0, -1.0] {
        for to in [2.5, 2.0, 2.0 - 1e-13] {
            let lost = walking(&system, [x, sense * qd, sense * 1.9, sense * to], false, |walk| {
                walk.go(&mut 0).map(|_| ()).expect_err("ends")
            });
            let Lost::Turned(place) = lost else { panic!("is lost") };
            assert!(
                (place.t - sense * 2.0).abs() < 1e-13
                    && place.q[0].abs() < 1e-6
                    && place.branches.is_empty(),
                "{} {:?}",
                place.t,
                place.q
            );
        }
        for to in [2.0 - 1e-9, 1.99, 1.95] {
            let (found, ..) =
                walking(&system, [x, sense * qd, sense * 1.9, sense * to], false, ends);
            assert!((found - (1.0 - 0.25 * to * to).sqrt()).abs() < 1e-9, "{to} {found}");
        }
    }
}

/// Times that differ by some last places are one, whatever the sign and the measure of time.
#[test]
fn how_long_before_the_time_that_is_asked_for() {
    let system = one(|m, name, x| assert!(m.add(name, arc(x)).is_ok()));
    for to in [5.0, -5.0] {
        walking(&system, [0.8, -0.1, 0.5, to], false, |mut walk| {
            walk.time = 2.0;
            let sense = to.signum();
            assert_eq!((walk.before(to - sense), walk.before(to + 3.0 * sense)), (0.5, -1.5));
            // an ulp of 5 is 4 ε: twice as many ε as ulps, beside 8 · 2.5
            let ulps = |k: f64| walk.before(to - sense * k * 4.0 * f64::EPSILON) / f64::EPSILON;
            assert_eq!([0.0, 9.0, -9.0, 11.0, -11.0].map(ulps), [0.0, 0.0, 0.0, 22.0, -22.0]);
        });
    }
}

#[test]
fn a_time_after_a_bifurcation() {
    let system = one(|m, name, x| assert!(m.add(name, arc(x)).is_ok()));
    walking(&system, [0.8, -0.1, 0.5, 1.0], false, |walk| {
        let branch = Branch { qd: vec![3.0, -1.0], qdd: vec![8.0, 4.0] };
        let (q, rates) = walk.moved(&[1.0, 2.0, 9.0], &branch, 0.5);
        assert_eq!((q, rates.qd, rates.qdd), (vec![3.5, 2.0], vec![7.0, 1.0], vec![8.0, 4.0]));
    });
    assert_eq!((unit_time(3), unit_time(1)), (vec![0.0, 0.0, 1.0], vec![1.0]));
}

/// Blocks are counted that differ, where both are known.
#[test]
fn blocks_that_turn_over() {
    let system = one(|m, name, x| assert!(m.add(name, arc(x)).is_ok()));
    walking(&system, [0.8, -0.1, 0.5, 1.0], false, |mut walk| {
        let mut next = walk.here.clone();
        walk.here.blocks = Some((vec![true, false, true, true], 1.0));
        next.blocks = Some((vec![true, true, true, false], 1.0));
        assert_eq!(walk.turned_over(&next), 2);
        next.blocks = None;
        assert_eq!(walk.turned_over(&next), 0);
    });
}

/// (x − t) t = 0: along t = 0 x may be anything.
#[constraint]
fn standing(x: Coord, t: Time) -> f64 {
    (x - t) * t
}

/// Where the drivers stand still on the other branch there is no turning into it.
#[test]
fn a_branch_on_which_time_stands_is_not_taken() {
    let system = one(|m, name, x| assert!(m.add(name, standing(x)).is_ok()));
    for other in [false, true] {
        let (found, branch, passed) = walking(&system, [-0.2, 1.0, -0.2, 0.3], other, ends);
        assert!(
            (found - 0.3).abs() < 1e-12 && branch.is_none() && passed == 1,
            "{other} {found} {passed}"
        );
    }
}

/// x² = 1 − t and x = 1/20 + 3 (t − 0.9975) cross just before the first one turns round.
#[constraint]
fn late_crossing(x: Coord, t: Time) -> f64 {
    (x * x + t - 1.0) * (x - 0.05 - 3.0 * (t - 0.9975))
}

#[test]
fn a_crossing_and_a_toggle_within_one_step() {
    let system = one(|m, name, x| assert!(m.add(name, late_crossing(x)).is_ok()));
    for x in (0..40).map(|k| 0.1 + 0.005 * f64::from(k)) {
        let lost = walking(&system, [x, -0.5 / x, 1.0 - x * x, 2.0], false, |walk| {
            walk.go(&mut 0).map(|_| ()).expect_err("ends")
        });
        assert!(
            matches!(lost, Lost::Turned(place) if (place.t - 1.0).abs() < 1e-12 && place.q[0].abs() < 1e-6),
            "{x}"
        );
    }
}

/// A crossing within a step: straight on only where time goes on behind it, and into the other
/// branch no further than the step.
#[test]
fn a_step_over_a_crossing() {
    let system = one(|m, name, x| assert!(m.add(name, crossing(x)).is_ok()));
    let from = [0.5 * -0.01 + 0.2 * 1e-4, 0.5 - 0.4 * 0.01, 0.29, 5.0];
    for (other, backwards) in [(false, false), (false, true), (true, false)] {
        walking(&system, from, other, |mut walk| {
            let s = 0.05;
            let mut next = walk.curve.step(&walk.here, s).expect("is followed");
            let found = branching::find(&mut walk.curve, &walk.here, &next, s, walk.sign)
                .expect("they cross");
            if backwards {
                next.dx.iter_mut().for_each(|dx| *dx = -*dx);
            }
            let stepped = walk.cross(found, next, s).unwrap_or_else(|_| panic!("is lost"));
            assert_eq!(matches!(stepped, Some(Stepped::On(_))), !backwards, "{other}");
            assert_eq!(
                (stepped.is_none(), walk.passed.len()),
                (backwards, usize::from(!backwards)),
                "{other}"
            );
        });
    }
}

/// 1.001 y + w = t, y + w = 0: a pivot of a thousandth beside entries of 1.
#[constraint]
fn weak(y: Coord, w: Coord, t: Time) -> [f64; 2] {
    [1.001 * y + w - t, y + w]
}

/// At a toggle what is weak is not what can move.
#[test]
fn what_moves_at_a_toggle() {
    let mut m = Mechanism::new("weak");
    let [x, y, w] = [("x", 1.0), ("y", 0.0), ("w", 0.0)]
        .map(|(name, guess)| m.length(name, guess).expect("a new name"));
    m.add("arc", arc(x)).expect("adds");
    m.add("weak", weak(y, w)).expect("adds");
    let system = m.build().expect("builds");
    let place = SingularPosition::new(
        &system,
        SingularKind::TurningPoint,
        2.0,
        &[0.0, 2000.0, -2000.0],
        Vec::new(),
    );
    assert_eq!(
        (&place.movable[..], place.dependent.len()),
        (&["x".to_string()][..], 1),
        "{place:?}"
    );
}
