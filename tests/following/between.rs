//! Between two times of the grid: motors that go out and come back within one step.

use kin::error::{FailureKind, RunFailure};
use kin::extend::LawFunction;
use kin::prelude::*;
use kin::{Error, SolverOptions};

use crate::engines::Engines;
use crate::models::{FourBar, slider_crank};

/// Rest, out by `by` as a cycloid, back, rest: within one second.
fn out_and_back(from: f64, by: f64) -> Law {
    let out = Law::constant(from) + Law::cycloidal(by, 0.4);
    let back = Law::constant(from + by) - Law::cycloidal(by, 0.4);
    Law::sequence(0.1, [(0.4, out), (0.4, back)])
}

/// When a law that only grows between two times takes a value.
fn reached(law: &Law, value: f64, [mut low, mut high]: [f64; 2]) -> f64 {
    let rises = law.at(high) > law.at(low);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if (law.at(middle) < value) == rises { low = middle } else { high = middle }
    }
    low
}

/// The run must end in a toggle at that time.
fn ends_at(result: kin::Result<Motion>, expected: f64, what: &str) {
    match result {
        Err(Error::Run(failure)) if matches!(failure.kind, FailureKind::Toggle { .. }) => {
            let t = failure.t;
            assert!((t - expected).abs() < 1e-8, "{what}: found at {t}, expected at {expected}")
        }
        Err(error) => panic!("{what}: {error}"),
        Ok(_) => panic!("{what}: a run past its toggle at {expected}"),
    }
}

/// Grids on which the motor rests at every time, and such as have times of any kind.
fn grids() -> [Vec<f64>; 5] {
    [
        vec![0.0, 1.0],
        vec![0.0, 0.05, 0.95, 1.0],
        linspace(0.0, 1.0, 3),
        linspace(0.0, 1.0, 8),
        linspace(0.0, 1.0, 101),
    ]
}

#[test]
fn crank_that_goes_out_and_back_within_one_step_does_not_pass_its_toggle() {
    let law = out_and_back(0.0, PI);
    let expected = reached(&law, 0.8_f64.asin(), [0.1, 0.5]);
    assert!((expected - 0.257).abs() < 1e-3);
    for times in grids() {
        ends_at(
            slider_crank(1.0, 0.8, law.clone(), 0.0).unwrap().run_both(&times),
            expected,
            &format!("{times:?}"),
        );
        let backwards: Vec<f64> = times.iter().rev().copied().collect();
        ends_at(
            slider_crank(1.0, 0.8, law.clone(), 0.0).unwrap().run_both(&backwards),
            1.0 - expected,
            &format!("{backwards:?}"),
        );
    }
}

/// Cranks and couplers that reach their toggle or turn round before it, by how far the law goes.
#[test]
fn four_bars_that_go_out_and_back_end_at_their_toggle_or_come_back_where_they_were() {
    let mut random = fastrand::Rng::with_seed(11);
    let mut toggles = 0;
    let mut returns = 0;
    while toggles + returns < 60 {
        let mut within = |low: f64, high: f64| low + (high - low) * random.f64();
        let lengths = [0; 4].map(|_| within(0.3, 3.0));
        let start = within(0.0, TAU);
        let by = within(-6.0, 6.0);
        let by_coupler = random.bool();
        let side = if random.bool() { 1.0 } else { -1.0 };
        let bar = FourBar {
            driven: lengths[0],
            next: lengths[1],
            last: lengths[2],
            ground: lengths[3],
            by_coupler,
        };
        let ahead =
            bar.toggle(start, by.signum()).map_or(f64::INFINITY, |angle| (angle - start).abs());
        if bar.angles(start, side).is_none()
            || !(1e-3..).contains(&ahead)
            || (ahead - by.abs()).abs() < 1e-3
        {
            continue;
        }
        let law = out_and_back(start, by);
        let (system, _) = bar.system(law.clone(), start, side).unwrap();
        let times = &grids()[random.usize(0..4)];
        let what = format!("{bar:?} from {start} by {by}, {times:?}");
        if ahead < by.abs() {
            ends_at(
                system.run_both(times),
                reached(&law, start + ahead.copysign(by), [0.1, 0.5]),
                &what,
            );
            toggles += 1;
        } else {
            let motion = system.run_both(times).unwrap_or_else(|error| panic!("{what}: {error}"));
            assert!((0..motion.len()).all(|k| bar.error(motion.q(k), side) < 1e-9), "{what}");
            returns += 1;
        }
    }
    assert!(toggles > 10 && returns > 10, "{toggles} {returns}");
}

#[constraint]
fn beyond(x: Coord, law: Law, t: Time, by: f64) -> f64 {
    x - (law.at(t) + by)
}

#[constraint]
fn by_two(x: Coord, one: Law, other: Law, t: Time) -> f64 {
    x - one.at(t) * other.at(t)
}

#[constraint]
fn pulse(x: Coord, t: Time, amplitude: f64, omega: f64) -> f64 {
    x - amplitude * (omega * t).sin().powi(4)
}

#[constraint(dual)]
fn dual_pulse(x: Coord, t: Time, amplitude: f64, omega: f64) -> f64 {
    x - amplitude * (omega * t).sin().powi(4)
}

#[constraint]
fn squared(x: Coord, law: Law, t: Time) -> f64 {
    x * x - law.at(t) * law.at(t)
}

/// sin⁴ without bounds, as a law of one's own may be.
struct Silent;

impl LawFunction for Silent {
    fn jet(&self, x: f64) -> [f64; 4] {
        let w = 3.0 * PI;
        // sin⁴ u = (3 − 4 cos 2u + cos 4u) / 8
        let (s2, c2) = (2.0 * w * x).sin_cos();
        let (s4, c4) = (4.0 * w * x).sin_cos();
        let a = 2.0 * w;
        let b = 4.0 * w;
        [
            (3.0 - 4.0 * c2 + c4) / 8.0,
            (4.0 * a * s2 - b * s4) / 8.0,
            (4.0 * a * a * c2 - b * b * c4) / 8.0,
            (-4.0 * a.powi(3) * s2 + b.powi(3) * s4) / 8.0,
        ]
    }
}

/// The rod of a slider-crank whose crank stands at the angle x: beyond |sin x| = 0.8 there is no
/// position.
fn with_rod(
    name: &str,
    drive: impl FnOnce(&mut Mechanism, Coordinate) -> kin::Result<()>,
) -> kin::Result<System> {
    #[constraint]
    fn closed(x: Coord, phi: Coord) -> f64 {
        x.sin() - 0.8 * phi.sin()
    }
    let mut m = Mechanism::new(name);
    let x = m.angle("x", 0.0)?;
    let phi = m.angle("phi", 0.0)?;
    m.add("loop", closed(x, phi))?;
    drive(&mut m, x)?;
    m.build()
}

#[test]
fn a_driver_is_seen_in_whatever_constraint_it_stands() {
    let limit = 0.8_f64.asin();
    // Pulses of height 1 that are zero, with their first three derivatives, at every third of a
    // second.
    let sin4 = |t: f64| (3.0 * PI * t).sin().powi(4);
    let pulse_law = || Law::new(Silent);
    let first = |height: f64| {
        let mut low = 0.0;
        let mut high = 1.0 / 6.0;
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if height * sin4(middle) < limit { low = middle } else { high = middle }
        }
        low
    };
    for times in [vec![0.0, 1.0 / 3.0], vec![0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0]] {
        let what = |name: &str| format!("{name} over {times:?}");
        let swing = || out_and_back(0.0, 1.2).compose(&Law::linear(0.0, 3.0));
        let at = reached(&out_and_back(0.0, 1.2), limit, [0.1, 0.5]) / 3.0;
        let system = with_rod("beyond", |m, x| {
            m.add("d", beyond(x, swing() + Law::constant(-0.3), 0.3)).map(|_| ())
        });
        ends_at(system.unwrap().run_both(&times), at, &what("a law and a number"));
        let half = Law::constant(0.5);
        let system = with_rod("two", |m, x| m.add("d", by_two(x, 2.0 * swing(), half)).map(|_| ()));
        ends_at(system.unwrap().run_both(&times), at, &what("two laws"));
        let system = with_rod("pulse", |m, x| m.add("d", pulse(x, 1.1, 3.0 * PI)).map(|_| ()));
        ends_at(system.unwrap().run_both(&times), first(1.1), &what("an expression of t"));
        let system =
            with_rod("dual pulse", |m, x| m.add("d", dual_pulse(x, 1.1, 3.0 * PI)).map(|_| ()));
        ends_at(
            system.unwrap().run_both(&times),
            first(1.1),
            &what("an expression of t by dual numbers"),
        );
        let system = with_rod("silent", |m, x| m.add("d", drive(x, 1.1 * pulse_law())).map(|_| ()));
        ends_at(system.unwrap().run_both(&times), first(1.1), &what("a law without bounds"));
        let system = with_rod("squared", |m, x| {
            m.set_initial(&[0.5, 0.7])?;
            m.add("d", squared(x, Law::constant(0.5) + 0.6 * pulse_law())).map(|_| ())
        });
        let at = {
            let mut low = 0.0;
            let mut high = 1.0 / 6.0;
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                if 0.5 + 0.6 * sin4(middle) < limit { low = middle } else { high = middle }
            }
            low
        };
        ends_at(system.unwrap().run_both(&times), at, &what("the square of a law without bounds"));
        // A mechanism that stays short of the toggle runs, and is back.
        let system = with_rod("short", |m, x| m.add("d", pulse(x, 0.9, 3.0 * PI)).map(|_| ()));
        let motion = system.unwrap().run_both(&times).unwrap();
        assert!(
            motion.q(times.len() - 1).iter().all(|q| q.abs() < 1e-12),
            "{:?}",
            motion.q(times.len() - 1)
        );
    }
}

/// A parallelogram whose coupler is longer by 1e-9 has a toggle 3e-5 before it is flat. A crank
/// that swings past that and back within a step comes from and goes to positions that are as smooth
/// as those of the parallelogram, whose branches cross there.
#[test]
fn crank_that_swings_past_a_near_change_point_and_back_ends_at_its_toggle() {
    let bar = |excess: f64| FourBar {
        driven: 1.0,
        next: 2.0 + excess,
        last: 1.0,
        ground: 2.0,
        by_coupler: false,
    };
    for excess in [1e-6, 1e-9] {
        for (start, beyond) in [(-0.5, 0.1), (-0.3, 0.01), (-0.02, 0.3), (-0.1, 1e-3)] {
            let toggle = bar(excess).toggle(start, 1.0).unwrap();
            for law in [
                out_and_back(start, beyond - start),
                Law::constant(start) + Law::sine(beyond - start, PI, 0.0),
            ] {
                let expected = reached(&law, toggle, [0.0, 0.5]);
                let (system, _) = bar(excess).system(law, start, 1.0).unwrap();
                for times in grids() {
                    let result = system.run_both(&times);
                    let Err(Some(RunFailure { t, kind: FailureKind::Toggle { .. }, .. })) =
                        result.as_ref().map_err(Error::failure)
                    else {
                        panic!("{excess:e} {start} {beyond} {times:?}: {result:?}")
                    };
                    assert!(
                        (t - expected).abs() < 1e-6,
                        "{excess:e} {start} {beyond} {times:?}: {t} {expected}"
                    );
                }
            }
        }
    }
}

/// A slider-crank with its slider in two guides: one equation too many.
#[test]
fn redundant_mechanisms_are_followed_between_times_too() {
    let guided = |law: Law| {
        let mut m = Mechanism::new("two guides");
        let a = m.link("crank", 1.0)?;
        let b = m.link("rod", 0.8)?;
        let slider = m.planar("slider", pose(1.8, 0.0, 0.0))?;
        m.add("O", revolute(Ground, a, vec2(0.0, 0.0), a.start()))?;
        m.add("A", revolute(a, b, a.end(), b.start()))?;
        m.add("B", revolute(b, slider, b.end(), vec2(0.0, 0.0)))?;
        m.add(
            "guide",
            prismatic(slider, Ground, vec2(0.0, 0.0), vec2(0.0, 0.0), vec2(0.0, 1.0), 0.0),
        )?;
        m.add(
            "second guide",
            prismatic(slider, Ground, vec2(0.1, 0.0), vec2(0.0, 0.0), vec2(0.0, 1.0), 0.0),
        )?;
        m.add("motor", drive_angle(a, law))?;
        m.set_initial(&[0.5, 0.0, 0.0, 1.4, 0.0, 0.0, 1.8, 0.0, 0.0])?;
        m.build()
    };
    for times in grids() {
        let within = guided(out_and_back(0.0, 0.7)).unwrap().run_both(&times).unwrap();
        let last = within.q(times.len() - 1);
        assert!(last[2].abs() < 1e-9 && (last[6] - 1.8).abs() < 1e-9, "{last:?}");
        assert!(guided(out_and_back(0.0, PI)).unwrap().run_both(&times).is_err(), "{times:?}");
    }
}

#[test]
fn cases_of_a_sweep_are_followed_between_times_in_lanes_as_alone() {
    let system = slider_crank(1.0, 1.5, out_and_back(0.0, PI), 0.0).unwrap();
    let names = ["A.u_j.x", "B.u_i.x", "rod.R_x", "slider.R_x"];
    // Half the rod's length: those below ½ end in a toggle; at ½ itself branches cross.
    let cases: Vec<[f64; 4]> = (0..24)
        .map(|k| 0.29 + 0.02 * f64::from(k))
        .map(|u| [-u, u, 1.0 + u, 1.0 + 2.0 * u])
        .collect();
    for times in grids() {
        for options in [SolverOptions::default(), SolverOptions::new().predict(false)] {
            let found = system
                .sweep(names)
                .unwrap()
                .options(options)
                .run(&cases, &times, |_, motion| motion.map(|_| ()))
                .unwrap();
            for (case, found) in cases.iter().zip(found) {
                let passes = case[1] > 0.5;
                assert!(
                    matches!(
                        (found.as_ref().map_err(Error::kind), passes),
                        (Ok(()), true) | (Err(Some(FailureKind::Toggle { .. })), false)
                    ),
                    "{case:?} {times:?}: {found:?}"
                );
            }
        }
    }
}

/// Millions of turns between two times are not followed one by one, and that is said at once; what
/// is straight needs no steps.
#[test]
fn a_step_over_millions_of_swings_is_refused_or_needs_none() {
    let mut m = Mechanism::new("one");
    let x = m.length("x", 0.0).unwrap();
    m.add("motor", drive(x, Law::sine(0.3, PI, 0.0))).unwrap();
    assert!(m.build().unwrap().run_both([0.0, 1e6]).is_ok());
    let bar = FourBar { driven: 1.0, next: 3.5, last: 3.0, ground: 4.0, by_coupler: false };
    let law = Law::sine(1.2, TAU, 0.0);
    let (system, _) = bar.system(law, 0.0, 1.0).unwrap();
    assert!(system.run_both([0.0, 10.0]).is_ok());
    for end in [1e7, 1e9, 1e12] {
        let error = system.run_both([0.0, end]).unwrap_err();
        assert!(
            matches!(error.kind(), Some(FailureKind::CannotFollow { .. }))
                && error.to_string().contains("Give closer times"),
            "{end:e}: {error}"
        );
    }
}

/// A driver that rests with its first three derivatives at each time of the grid, and starts again
/// by the fourth power of time.
#[test]
fn a_driver_that_has_come_to_rest_is_not_refused() {
    let bar = FourBar { driven: 1.0, next: 3.5, last: 3.0, ground: 4.0, by_coupler: false };
    for (omega, amplitude) in [(9.0, 3.9), (10.0, 4.2), (18.0, 1.3)] {
        let law = Law::new(Silent).compose(&Law::linear(0.0, omega / 3.0));
        let (system, _) = bar.system(Law::constant(0.7) + amplitude * law, 0.7, 1.0).unwrap();
        for points in [4, 6, 10, 11, 37] {
            let motion = system
                .run_both(linspace(0.0, 1.0, points))
                .unwrap_or_else(|error| panic!("{omega} {points}: {error}"));
            assert!((0..points).all(|k| bar.error(motion.q(k), 1.0) < 1e-9));
        }
    }
}
