//! HasTorque points: the time beyond which there is no position.

use kin::error::{FailureKind, RunFailure};
use kin::prelude::*;
use kin::results::SingularKind;

use crate::engines::Engines;
use crate::models::{FourBar, slider_crank};

/// The time of the toggle that ends a run, with the motion before it.
fn toggle(error: &kin::Error) -> (f64, &Motion) {
    let Some(RunFailure { t, kind: FailureKind::Toggle { .. }, motion: Some(motion), .. }) =
        error.failure()
    else {
        panic!("{error}")
    };
    (*t, motion)
}

/// Four-bars whose driven link cannot turn round, on grids from coarse to fine, both ways and in
/// both assemblies.
#[test]
fn non_grashof_four_bar_ends_at_its_toggle() {
    for bar in [
        FourBar { driven: 2.0, next: 1.5, last: 2.2, ground: 3.5, by_coupler: false },
        FourBar { driven: 1.0, next: 0.8, last: 0.95, ground: 1.1, by_coupler: false },
        FourBar { driven: 3.0, next: 1.0, last: 2.0, ground: 3.1, by_coupler: false },
    ] {
        for (side, sense) in [(1.0, 1.0), (-1.0, -1.0), (-1.0, 1.0)] {
            let start = (0..60)
                .map(|k| 0.1 * f64::from(k))
                .find(|angle| bar.angles(*angle, side).is_some())
                .unwrap()
                + 0.05;
            let expected = sense * (bar.toggle(start, sense).unwrap() - start);
            let (system, _) = bar.system(Law::linear(start, sense), start, side).unwrap();
            for points in [9, 41, 721] {
                let times = linspace(0.0, 8.0, points);
                let error = system.run_both(&times).unwrap_err();
                let (found, motion) = toggle(&error);
                assert!(
                    (found - expected).abs() < 1e-10,
                    "{bar:?} {points}: {found} {expected} {:e}",
                    found - expected
                );
                assert_eq!(
                    motion.len(),
                    times.iter().filter(|t| **t < expected).count(),
                    "{error}"
                );
                assert!((0..motion.len()).all(|k| bar.error(motion.q(k), side) < 1e-8));
                assert_eq!(motion.singular_positions().len(), 1);
            }
        }
    }
}

/// A slider-crank driven by its slider, to both dead centres.
#[test]
fn slider_drives_a_slider_crank_to_its_dead_centres() {
    let a = 1.0;
    let b = 2.5;
    for (speed, end) in [(0.4, a + b), (-0.4, b - a)] {
        let mut m = Mechanism::new("pump");
        let crank = m.link("crank", a).unwrap();
        let rod = m.link("rod", b).unwrap();
        let slider = m.planar("slider", pose(2.4, 0.0, 0.0)).unwrap();
        m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).unwrap();
        m.add("A", revolute(crank, rod, crank.end(), rod.start())).unwrap();
        m.add("B", revolute(rod, slider, rod.end(), vec2(0.0, 0.0))).unwrap();
        m.add(
            "guide",
            prismatic(slider, Ground, vec2(0.0, 0.0), vec2(0.0, 0.0), vec2(0.0, 1.0), 0.0),
        )
        .unwrap();
        m.add("motor", drive(slider.x(), Law::linear(2.4, speed))).unwrap();
        m.prefer(crank, deg(60.0));
        let system = m.build().unwrap();
        for points in [11, 501] {
            let error = system.run_both(linspace(0.0, 5.0, points)).unwrap_err();
            let (found, motion) = toggle(&error);
            assert!((found - (end - 2.4) / speed).abs() < 1e-10, "{found} {}", (end - 2.4) / speed);
            assert!(motion.times().last().unwrap() < &found);
            let at = motion.singular_positions().last().unwrap();
            assert_eq!(
                (at.kind, &at.movable[..]),
                (SingularKind::TurningPoint, &["crank".to_string(), "rod".to_string()][..]),
                "{at:?}"
            );
            println!("{error}");
        }
    }
}

/// The crank of a slider-crank with a rod that is too short stops where the rod stands upright; the
/// same in millimetres and in kilometres.
#[test]
fn verdict_does_not_depend_on_the_unit_of_length() {
    for scale in [1e-3, 1.0, 1e3] {
        let error = slider_crank(scale, 0.8 * scale, Law::ramp(1.0), 0.0)
            .unwrap()
            .run_both(linspace(0.0, 2.0, 21))
            .unwrap_err();
        let (found, motion) = toggle(&error);
        assert!((found - 0.8_f64.asin()).abs() < 1e-10, "{found}");
        assert_eq!(motion.len(), 10);
    }
}

/// Neither does it depend on the order in which parts are declared: the slider-driven slider-crank,
/// its bodies and constraints in many orders.
#[test]
fn verdict_does_not_depend_on_the_order_of_the_parts() {
    let a = 1.0;
    let b = 2.5;
    let speed = 0.4;
    let orders = [[0, 1, 2, 3, 4], [4, 3, 2, 1, 0], [2, 4, 0, 3, 1], [3, 0, 4, 1, 2]];
    for (bodies, joints) in [[0, 1, 2], [2, 1, 0], [1, 2, 0]]
        .into_iter()
        .flat_map(|bodies| orders.map(|joints| (bodies, joints)))
    {
        let mut m = Mechanism::new("pump");
        let mut crank = None;
        let mut rod = None;
        let mut slider = None;
        for body in bodies {
            match body {
                0 => crank = Some(m.link("crank", a).unwrap()),
                1 => rod = Some(m.link("rod", b).unwrap()),
                _ => slider = Some(m.planar("slider", pose(2.4, 0.0, 0.0)).unwrap()),
            }
        }
        let crank = crank.unwrap();
        let rod = rod.unwrap();
        let slider = slider.unwrap();
        let zero = vec2(0.0, 0.0);
        for joint in joints {
            match joint {
                0 => m.add("O", revolute(Ground, crank, zero, crank.start())),
                1 => m.add("A", revolute(crank, rod, crank.end(), rod.start())),
                2 => m.add("B", revolute(rod, slider, rod.end(), zero)),
                3 => m.add("guide", prismatic(slider, Ground, zero, zero, vec2(0.0, 1.0), 0.0)),
                _ => m.add("motor", drive(slider.x(), Law::linear(2.4, speed))),
            }
            .unwrap();
        }
        m.prefer(crank, deg(60.0));
        let error = m.build().unwrap().run_both(linspace(0.0, 5.0, 11)).unwrap_err();
        let (found, motion) = toggle(&error);
        assert!((found - (a + b - 2.4) / speed).abs() < 1e-10, "{bodies:?} {joints:?}: {found}");
        let mut movable = motion.singular_positions()[0].movable.clone();
        movable.sort();
        assert_eq!(
            (motion.len(), &movable[..]),
            (6, &["crank".to_string(), "rod".to_string()][..]),
            "{bodies:?} {joints:?}"
        );
    }
}

/// A motor that comes to rest at the toggle: the grid reaches t* or the run ends there, and nothing
/// turns over.
#[test]
fn driver_that_swings_beyond_the_toggle_and_back_does_not_hide_it() {
    let bar = FourBar { driven: 2.0, next: 1.5, last: 2.2, ground: 3.5, by_coupler: false };
    let end = bar.toggle(0.2, 1.0).unwrap();
    for amplitude in [1.001, 1.05, 1.3] {
        let swing = amplitude * (end - 0.2);
        let (system, _) =
            bar.system(Law::sine(swing, 1.0, 0.0) + Law::constant(0.2), 0.2, 1.0).unwrap();
        let expected = amplitude.recip().asin();
        for points in [5, 9, 17, 101] {
            let error = system.run_both(linspace(0.0, 3.0, points)).unwrap_err();
            let (found, _) = toggle(&error);
            assert!((found - expected).abs() < 1e-10, "{amplitude} {points}: {found} {expected}");
        }
    }
    // Just short of it the run goes on, and comes back on the same side.
    let (system, _) = bar
        .system(Law::sine(0.999 * (end - 0.2), 1.0, 0.0) + Law::constant(0.2), 0.2, 1.0)
        .unwrap();
    for points in [5, 9, 101] {
        let motion = system.run_both(linspace(0.0, 3.0, points)).unwrap();
        assert!((0..points).all(|k| bar.error(motion.q(k), 1.0) < 1e-9));
    }
}

/// A time of the grid so near before the toggle that the curve has turned round when the next one
/// is met: the position is that of the way there.
#[test]
fn time_just_before_a_toggle_is_met_before_the_curve_turns() {
    let bar = FourBar { driven: 0.7, next: 1.0, last: 1.8, ground: 2.3, by_coupler: false };
    let end = bar.toggle(0.2, 1.0).unwrap();
    for gap in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10] {
        let (system, _) = bar.system(Law::linear(0.2, 1.0), 0.2, -1.0).unwrap();
        let error = system.run_both([0.0, end - 0.4, end - 0.2 - gap, end]).unwrap_err();
        let (found, motion) = toggle(&error);
        assert!((found - end + 0.2).abs() < 1e-12, "{gap}: {found}");
        assert!(
            motion.len() == 3 && bar.error(motion.q(2), -1.0) < 1e-14 / gap.sqrt() * 10.0,
            "{gap}: {:e}",
            bar.error(motion.q(2), -1.0)
        );
    }
}

/// Four-bars that are mirror images of one another on one crank: all come to their toggle at once,
/// and all of them are named.
#[test]
fn loops_that_toggle_together_end_in_one_toggle_that_names_them_all() {
    for (lengths, start, sense) in [
        ([1.2, 1.3, 0.9, 1.7], 0.4, 1.0),
        ([2.0, 1.5, 2.2, 3.5], 0.3, 1.0),
        ([0.8, 0.96, 0.7, 1.34], 0.9, -1.0),
    ] {
        let [driven, next, last, ground] = lengths;
        let bar = FourBar { driven, next, last, ground, by_coupler: false };
        let expected = sense * (bar.toggle(start, sense).unwrap() - start);
        for loops in [2, 3, 4] {
            let mut m = Mechanism::new("loops on one crank");
            let crank = m.link("crank", driven).unwrap();
            m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).unwrap();
            m.add("motor", drive_angle(crank, Law::linear(start, sense))).unwrap();
            let mut guess = bar.pose(start, 1.0).unwrap()[..3].to_vec();
            for k in 0..loops {
                let b = m.link(&format!("coupler {k}"), next).unwrap();
                let c = m.link(&format!("rocker {k}"), last).unwrap();
                m.add(&format!("A{k}"), revolute(crank, b, crank.end(), b.start())).unwrap();
                m.add(&format!("B{k}"), revolute(b, c, b.end(), c.end())).unwrap();
                m.add(&format!("C{k}"), revolute(c, Ground, c.start(), vec2(ground, 0.0))).unwrap();
                guess.extend_from_slice(
                    &bar.pose(start, if k % 2 == 0 { 1.0 } else { -1.0 }).unwrap()[3..],
                );
            }
            m.set_initial(&guess).unwrap();
            let system = m.build().unwrap();
            for points in [2, 11, 301] {
                let error = system.run_both(linspace(0.0, 3.0, points)).unwrap_err();
                let Some(RunFailure { t, kind: FailureKind::Toggle { movable, .. }, .. }) =
                    error.failure()
                else {
                    panic!("{loops} {points}: {error}")
                };
                assert!((t - expected).abs() < 1e-9, "{loops} {points}: {t} {expected}");
                // Each loop alone is locked by the others, and all of them together follow the
                // motor.
                let text = error.to_string();
                assert!(text.contains("`motor` requires crank.theta"), "{loops} {points}: {text}");
                assert!(!text.contains("does not fit"), "{loops} {points}: {text}");
                for k in 0..loops {
                    for part in ["coupler", "rocker"] {
                        assert!(
                            movable.contains(&format!("{part} {k}")),
                            "{loops} {points}: {movable:?}"
                        );
                    }
                }
            }
        }
    }
}
