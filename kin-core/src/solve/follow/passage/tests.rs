//! Positions that are passed, or at which a motion ends, where several loops come to them at once: on equations whose solutions are known.

use crate::model::error::Error;
use crate::model::mechanism::linspace;
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

fn loops(count: usize, guess: f64, add: impl Fn(&mut Mechanism, &str, crate::model::coordinates::Coordinate)) -> System {
    let mut m = Mechanism::new("loops");
    for k in 0..count {
        let name = format!("x{k}");
        let x = m.length(&name, guess * (1.0 - 2.0 * (k % 2) as f64).powi(i32::from(guess == 1.0))).expect("a new name");
        add(&mut m, &format!("c{k}"), x);
    }
    m.build().expect("builds")
}

/// Loops that come to their toggles together end there, whether on a coarse grid or a fine one, and one that ends at the toggle comes to it.
#[test]
fn loops_that_toggle_together() {
    for count in [1, 2, 3] {
        let system = loops(count, 1.0, |m, name, x| assert!(m.add(name, arc(x)).is_ok()));
        for points in [3, 7, 40] {
            let error = system.run(linspace(0.0, 3.0, points)).unwrap_err();
            let Error::Toggle { t, movable, .. } = &error else { panic!("{count} {points}: {error}") };
            assert!((t - 2.0).abs() < 1e-9 && movable.contains(&"x0".to_string()), "{count} {points}: {t} {movable:?}");
        }
        let motion = system.run(linspace(0.0, 1.99, 12)).expect("comes so far");
        for k in 0..count {
            let sense = if k % 2 == 0 { 1.0 } else { -1.0 };
            assert!((motion.q(11)[k] - sense * (1.0 - 0.25 * 1.99 * 1.99_f64).sqrt()).abs() < 1e-12);
        }
    }
}

/// Loops whose branches cross together go on smoothly, whether the crossing is a time of the grid or not, and in both senses of time.
#[test]
fn loops_that_cross_together() {
    for count in [1, 2, 4] {
        let system = loops(count, -0.13, |m, name, x| assert!(m.add(name, crossing(x)).is_ok()));
        for times in [linspace(0.0, 1.0, 6), linspace(0.0, 1.0, 11), linspace(0.0, 0.3, 4), linspace(0.0, 0.6, 3), linspace(0.0, 1.0, 101)]
        {
            let motion = system.run(times.clone()).unwrap_or_else(|error| panic!("{count} {times:?}: {error}"));
            let places = motion.singular_positions();
            assert!(places.len() == 1 && (places[0].t - 0.3).abs() < 1e-6, "{count} {times:?}: {places:?}");
            let branch = &places[0].branches[0];
            for k in 0..count {
                assert!((branch.qd[k] - 0.5).abs() < 1e-5 && (branch.qdd[k] - 0.4).abs() < 1e-3, "{count} {times:?}: {branch:?}");
                for (at, t) in times.iter().enumerate() {
                    let u = t - 0.3;
                    assert!((motion.q(at)[k] - 0.5 * u - 0.2 * u * u).abs() < 1e-8, "{count} {t} of {times:?}: {:?}", motion.q(at));
                    assert!((motion.qd(at)[k] - 0.5 - 0.4 * u).abs() < 1e-5, "{count} {t} of {times:?}: {:?}", motion.qd(at));
                }
            }
        }
    }
}
