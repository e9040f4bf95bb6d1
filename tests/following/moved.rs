//! Events of a motion do not depend on where the origin is and how large the mechanism is.

use kin::error::FailureKind;
use kin::prelude::*;
use kin::results::SingularKind;
use kin::{Engine, Error, SolverOptions};

use crate::families::{FAMILIES, Frame, Random, margin, system};

#[constraint]
fn implicit(x: Coord, z: Coord, place: f64, size: f64) -> f64 {
    z - place + 0.6 * size * (2.0 * (z - place) / size).sin() - (x - place)
}

#[constraint]
fn cubic(x: Coord, y: Coord, place: f64, size: f64) -> f64 {
    (y - place).powi(3) / (size * size) - 1.2 * (y - place) - (x - place)
}

#[constraint]
fn circle(x: Coord, y: Coord, place: f64, size: f64) -> f64 {
    (x - place).powi(2) + (y - place).powi(2) - size * size
}

#[constraint]
fn product(x: Coord, y: Coord, place: f64, size: f64) -> f64 {
    (y - place) * (y - place + x - place) - 0.3 * size * size
}

#[constraint]
fn periodic(x: Coord, z: Coord) -> f64 {
    z + 0.6 * (2.0 * z).sin() - x
}

/// A run by one engine.
fn run(system: &System, times: &[f64], engine: Engine) -> kin::Result<Motion> {
    system.solver().options(SolverOptions::new().engine(engine)).run(times)
}

/// The time of a toggle that ends a run.
fn toggle(error: &Error) -> Option<f64> {
    let failure = error.failure()?;
    matches!(failure.kind, FailureKind::Toggle { .. }).then_some(failure.t)
}

/// Kinds and times of what happens, the toggle at the end among them; the rest of errors by their
/// words.
fn happens(result: &kin::Result<Motion>) -> Result<Vec<(String, f64)>, String> {
    let of = |motion: &Motion| -> Vec<(String, f64)> {
        let singular =
            motion.singular_positions().iter().map(|at| (format!("{:?}", at.kind), at.t));
        singular.chain(motion.events().iter().map(|event| ("event".to_string(), event.t))).collect()
    };
    match result {
        Ok(motion) => Ok(of(motion)),
        Err(error) => {
            let t = toggle(error).ok_or_else(|| error.to_string())?;
            let before = error.motion().into_iter().flat_map(of);
            let at_end = [(format!("{:?} at the end", SingularKind::TurningPoint), t)];
            Ok(before.chain(at_end).collect())
        }
    }
}

/// The same must happen, at the same times but for rounding of this size.
fn alike(
    one: &kin::Result<Motion>,
    other: &kin::Result<Motion>,
    rounding: f64,
    what: &str,
) -> usize {
    let (Ok(one), Ok(other)) = (happens(one), happens(other)) else {
        panic!("{what}: {:?} {:?}", happens(one), happens(other))
    };
    let kinds =
        |all: &[(String, f64)]| all.iter().map(|(kind, _)| kind.clone()).collect::<Vec<_>>();
    assert_eq!(kinds(&one), kinds(&other), "{what}: {one:?} {other:?}");
    for ((kind, t), (_, expected)) in one.iter().zip(&other) {
        let allowed = 1e-9 + 1e2 * rounding;
        assert!((t - expected).abs() <= allowed, "{what}: {kind} at {t}, expected at {expected}");
    }
    one.len()
}

/// z + 0.6 sin 2z = x beside whole turns of it is the same curve, moved.
#[test]
fn a_fold_is_found_wherever_the_origin_is() {
    for (turns, points) in
        [(0.0, 50), (32.0, 50), (100.0, 50), (318.0, 50), (318.0, 20), (318.0, 7), (3183.0, 200)]
    {
        let far = turns * PI;
        let mut m = Mechanism::new("moved");
        let x = m.length("x", far).unwrap();
        let z = m.length("z", far).unwrap();
        m.add("x", drive(x, Law::sine(2.0, 3.0, 0.0) + Law::constant(far))).unwrap();
        m.add("z", periodic(x, z)).unwrap();
        let system = m.build().unwrap();
        for engine in [Engine::StepByStep, Engine::Compiled] {
            let found = run(&system, &linspace(0.0, 1.0, points), engine);
            let Err(Some(t)) = found.as_ref().map_err(toggle) else {
                panic!("{turns} {points} {engine:?}: {:?}", found.map(|motion| motion.summary()))
            };
            let at = 0.5 * (-1.0_f64 / 1.2).acos();
            let expected = ((at + 0.6 * (2.0 * at).sin()) / 2.0).asin() / 3.0;
            assert!((t - expected).abs() < 1e-9, "{turns} {points} {engine:?}: {t} {expected}");
        }
    }
}

/// The same beside a crank whose link is a thousand times as long.
#[test]
fn a_fold_is_found_beside_long_links() {
    for length in [1.0, 1e3, 1e6] {
        let mut m = Mechanism::new("long link");
        let crank = m.link("crank", length).unwrap();
        m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).unwrap();
        m.add("motor", drive_angle(crank, Law::linear(0.3, 0.1))).unwrap();
        let x = m.length("x", 0.0).unwrap();
        let z = m.length("z", 0.0).unwrap();
        m.add("x", drive(x, Law::sine(2.0, 3.0, 0.0))).unwrap();
        m.add("z", periodic(x, z)).unwrap();
        let system = m.build().unwrap();
        for engine in [Engine::StepByStep, Engine::Compiled] {
            for points in [8, 20, 50] {
                let found = run(&system, &linspace(0.0, 1.0, points), engine);
                let Err(Some(t)) = found.as_ref().map_err(toggle) else {
                    panic!("{length} {points} {engine:?}")
                };
                assert!((t - 0.311_783_3).abs() < 1e-6, "{length} {points} {engine:?}: {t}");
            }
        }
    }
}

/// Explicit equations in (x − K).
fn explicit(kind: usize, scale: f64, place: f64) -> kin::Result<System> {
    let mut m = Mechanism::new("explicit");
    let start = [0.0, 0.0, 0.2, 0.2][kind] * scale;
    let beside = [0.0, 0.0, -0.96_f64.sqrt(), 0.456_776][kind] * scale;
    let x = m.length("x", place + start)?;
    let y = m.length("y", place + beside)?;
    let law = Law::sine(2.0 * scale, 3.0, 0.0) + Law::constant(place + start);
    m.add("x", drive(x, law))?;
    match kind {
        0 => m.add("y", implicit(x, y, place, scale))?,
        1 => m.add("y", cubic(x, y, place, scale))?,
        2 => m.add("y", circle(x, y, place, scale))?,
        _ => m.add("y", product(x, y, place, scale))?,
    };
    m.build()
}

#[test]
fn explicit_equations_that_are_moved_and_scaled_do_the_same() {
    let mut seen = 0;
    for (kind, points) in (0..4).flat_map(|kind| [7, 20, 90].map(|points| (kind, points))) {
        let times = linspace(0.0, 1.0, points);
        let expected = run(&explicit(kind, 1.0, 0.0).unwrap(), &times, Engine::StepByStep);
        for (scale, place) in [
            (1.0, 1e6),
            (1.0, -1e6),
            (1.0, 777.7),
            (1e6, 0.0),
            (1e-6, 0.0),
            (1e-6, 1.0),
            (1e6, -1e12),
        ] {
            for engine in [Engine::StepByStep, Engine::Compiled] {
                let found = run(&explicit(kind, scale, place).unwrap(), &times, engine);
                let rounding = f64::EPSILON * place.abs() / scale;
                let what =
                    format!("equation {kind}, {points} times, by {scale} to {place}, {engine:?}");
                seen += alike(&found, &expected, rounding, &what);
            }
        }
    }
    assert!(seen > 100, "{seen}");
}

/// The mechanism at the origin and its like elsewhere, each from its own first position.
fn pair(number: usize, frame: Frame) -> Option<[System; 2]> {
    let build = |frame| system(number % FAMILIES.len(), &mut Random::of(number), frame).ok();
    // Where it is not moved it is compared with what is of order 1, else with what rounding leaves
    // of it.
    let scale = if frame.place == 0.0 { 1.0 } else { frame.scale };
    let mut here = build(Frame { scale, is_moved: false, ..frame })?;
    let mut there = build(frame)?;
    let q = here.position(0.0).ok()?.q;
    here.set_initial(&q).ok()?;
    let is_length = |name: &str| name.contains(".R_");
    let moved = here.coordinate_names().iter().zip(&q);
    let moved: Vec<f64> = moved
        .map(|(name, q)| if is_length(name) { q * (frame.scale / scale) + frame.place } else { *q })
        .collect();
    there.set_initial(&moved).ok()?;
    Some([here, there])
}

/// How many mechanisms a test run takes; `KIN_CAMPAIGN=1000` for many.
fn count() -> usize {
    std::env::var("KIN_CAMPAIGN").ok().and_then(|count| count.parse().ok()).unwrap_or(12)
}

#[test]
fn mechanisms_that_are_moved_and_scaled_do_the_same() {
    let mut seen = 0;
    let mut tried = 0;
    for number in 0..count() {
        let steps = Random::of(number + 7).one_of(&[3, 9, 36]);
        let times = linspace(0.0, 1.0, steps + 1);
        for (scale, place) in [(1.0_f64, 1e6_f64), (1e6, 0.0), (1e-6, 0.0), (1e-6, 1.0)] {
            // Rounding of the moved points, of which a loop has several, decides how links pass
            // their line.
            let family = number % FAMILIES.len();
            let rounding = f64::EPSILON * place.abs() / scale;
            let margin = margin(family, &mut Random::of(number));
            if margin <= 64.0 * rounding {
                continue;
            }
            let frame = Frame { scale, place, ..Frame::default() };
            // Branches come as near one another as the root of that margin, and turns within a
            // length of the cube root of rounding are not told from it: there a run may end and say
            // so.
            let may_end = margin <= (64.0 * rounding).powf(2.0 / 3.0);
            let Some([here, there]) = pair(number, frame) else { continue };
            let expected = run(&here, &times, Engine::StepByStep);
            for engine in [Engine::StepByStep, Engine::Compiled] {
                let found = run(&there, &times, engine);
                let what = format!(
                    "number {number}, {} in {steps} steps, by {scale} to {place}, {engine:?}",
                    FAMILIES[family]
                );
                tried += 1;
                if may_end && found.as_ref().is_err_and(|error| toggle(error).is_none()) {
                    continue;
                }
                seen += alike(&found, &expected, rounding, &what);
            }
        }
    }
    assert!(tried > count() && seen > tried / 5, "{tried} {seen}");
}

/// y = −x, then y = x/2, from the place on: two straight lines that meet.
#[constraint]
fn lines(x: Coord, y: Coord, place: f64, size: f64) -> f64 {
    let v = x - place;
    if v < 0.5 * size { y - place + v } else { y - place - 0.5 * v }
}

/// A slope that goes up and down by little more than what counts as bent, or a little less.
#[constraint]
fn wave(y: Coord, z: Coord, place: f64, size: f64) -> f64 {
    let w = (z - place) / size;
    z - place + 0.3 * size * w.sin() - (y - place)
}

/// Positions have their digits in any unit and at any place of a wave.
#[test]
fn numbers_have_their_digits_where_slopes_hardly_bend() {
    for size in [1e-6, 1.0, 1e6] {
        for k in 0..300 {
            let from = size * (-6.0 + 0.02 * f64::from(k) - 0.3);
            let mut m = Mechanism::new("wave");
            let [x, y, z] = ["x", "y", "z"].map(|name| m.length(name, 0.0).unwrap());
            m.add("motor", drive(x, Law::linear(from, 0.3 * size))).unwrap();
            m.add("lines", lines(x, y, 0.0, size)).unwrap();
            m.add("wave", wave(y, z, 0.0, size)).unwrap();
            let motion = m.build().unwrap().run(linspace(0.0, 1.0, 20)).unwrap();
            for k in 0..motion.len() {
                let [_, y, z] = motion.q(k) else { panic!() };
                let off = (z / size + 0.3 * (z / size).sin() - y / size).abs();
                assert!(off < 1e-11, "{size} from {from}, time {k}: off by {off} of the size");
            }
        }
    }
}

/// z + 0.6 sin 2z = x of distances from a carriage.
#[constraint]
fn riding(x: Coord, z: Coord, carriage: Coord, size: f64) -> f64 {
    let w = (z - carriage) / size;
    size * (w + 0.6 * (2.0 * w).sin()) - (x - carriage)
}

/// A fold of that size beside a carriage that moves, or on it.
fn carried(far: f64, size: f64, begin: f64, rides: bool) -> System {
    let mut m = Mechanism::new("carried");
    let carriage = m.length("carriage", begin).unwrap();
    m.add("feed", drive(carriage, Law::linear(begin, far))).unwrap();
    let own = Law::sine(2.0 * size, 3.0, 0.0);
    if rides {
        let x = m.length("x", begin).unwrap();
        let z = m.length("z", begin).unwrap();
        m.add("x", drive(x, Law::linear(begin, far) + own)).unwrap();
        m.add("z", riding(x, z, carriage, size)).unwrap();
    } else {
        let x = m.length("x", 0.0).unwrap();
        let z = m.length("z", 0.0).unwrap();
        m.add("x", drive(x, own)).unwrap();
        m.add("z", implicit(x, z, 0.0, size)).unwrap();
    }
    m.build().unwrap()
}

/// The same beside a carriage that goes far away during the run, and on it: sizes are those of the
/// first position.
///
/// Rounding of where the carriage is, ε v, moves what rides on it at the fold by the root of that,
/// and the fold turns within size² / v: from v = 1e5 sizes a second on rounding hides how it turns.
/// Then the run still ends there, with an error of another kind.
#[test]
fn a_fold_is_found_beside_what_is_carried_far_away() {
    let at = 0.5 * (-1.0_f64 / 1.2).acos();
    let expected = ((at + 0.6 * (2.0 * at).sin()) / 2.0).asin() / 3.0;
    let beside =
        [(1.0, 1.0), (1e3, 1.0), (1e6, 1.0), (1e6, 1e-3), (-1e9, 1.0), (1e12, 1e-3), (1e9, 1e3)];
    let riding = [(1.0, 1.0), (1e3, 1.0), (-1e4, 1.0), (10.0, 1e-3), (1e6, 1.0), (-1e9, 1e3)];
    let all = beside.map(|case| (case, false)).into_iter().chain(riding.map(|case| (case, true)));
    for (((far, size), rides), begin) in all.flat_map(|case| [(case, 0.0), (case, 1.0)]) {
        let system = carried(far, size, begin, rides);
        let pace = if rides { far.abs() / size } else { 0.0 };
        for engine in [Engine::StepByStep, Engine::Compiled] {
            for points in [8, 20, 50, 400] {
                let what = format!("{far} {size} {rides} from {begin}, {points} times, {engine:?}");
                let error = run(&system, &linspace(0.0, 1.0, points), engine).expect_err(&what);
                let text = error.to_string();
                let last = text.split_once("t = ").and_then(|(_, rest)| rest.split_once(" s"));
                let last: f64 = last.expect(&what).0.parse().expect(&what);
                assert!((last - expected).abs() < 1e-7, "{what}: {error}");
                let Some(t) = toggle(&error) else {
                    assert!(pace > 1e5, "{what}: {error}");
                    continue;
                };
                let allowed = 1e-9 + 1e2 * f64::EPSILON * pace;
                assert!((t - expected).abs() < allowed, "{what}: {t} {expected}");
            }
        }
    }
}

/// A slider whose first position is the rounding of zero has no length: its steps are not judged by
/// that rounding.
#[test]
fn a_slider_that_starts_at_the_rounding_of_zero_runs() {
    for phase in [0.0, 1e-18, 1e-15, 1e-14, 1e-12, 1e-9, 1e-3, std::f64::consts::PI] {
        for drawn in [0.0, 0.1] {
            let mut m = Mechanism::new("slider");
            let slider = m.planar("slider", pose(drawn, 0.0, 0.0)).unwrap();
            let o = vec2(0.0, 0.0);
            let up = vec2(0.0, 1.0);
            m.add("guide", prismatic(slider, m.ground(), o, o, up, 0.0)).unwrap();
            m.add("motor", drive(slider.x(), Law::sine(0.3, 1.0, phase))).unwrap();
            let system = m.build().unwrap();
            for engine in [Engine::StepByStep, Engine::Compiled] {
                let what = format!("{phase} {drawn} {engine:?}");
                let motion = run(&system, &linspace(0.0, 1.0, 5), engine).expect(&what);
                assert!((motion.q(4)[0] - 0.3 * (1.0 + phase).sin()).abs() < 1e-15, "{what}");
            }
        }
    }
}
