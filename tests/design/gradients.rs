//! Gradients of redundant mechanisms are the sums of their derivatives by each parameter, and the
//! time for a gradient grows with the number of times and no faster.

use std::time::Instant;

use kin::Mechanism;
use kin::prelude::*;

/// A four-bar whose hinges are those of space, all parallel: three equations are superfluous. Its
/// lengths are dimensions.
pub fn parallel_hinges() -> System {
    let mut m = Mechanism::new("four-bar in space");
    let [a, b, c, d] = [("a", 1.0), ("b", 2.2), ("c", 2.0), ("d", 2.5)]
        .map(|(name, length)| m.dimension(name, length).expect("a dimension"));
    let z = || Axis::along((0.0, 0.0, 1.0));
    let place = |x: f64, y: f64, turn: f64| {
        let (sin, cos) = (0.5 * turn).sin_cos();
        SpatialPose::new(vec3(x, y, 0.0), EulerParameters::new(cos, 0.0, 0.0, sin))
    };
    let mut body = |name, (x, y, turn)| m.spatial(name, place(x, y, turn)).expect("a body");
    let crank = body("crank", (0.0, 0.0, 1.0));
    let coupler = body("coupler", (0.54, 0.84, 0.48));
    let rocker = body("rocker", (2.5, 0.0, 1.55));
    let none = (0.0, 0.0, 0.0);
    let along = (0.0, 0.0, 1.0);
    m.add("O", spatial::revolute(crank, Ground, none, none, z(), along)).expect("adds");
    m.add("A", spatial::revolute(crank, coupler, (a, 0.0, 0.0), none, z(), along)).expect("adds");
    m.add("B", spatial::revolute(coupler, rocker, (b, 0.0, 0.0), (c, 0.0, 0.0), z(), along))
        .expect("adds");
    m.add("C", spatial::revolute(rocker, Ground, none, (d, 0.0, 0.0), z(), along)).expect("adds");
    m.add("motor", spatial::drive_turn(crank, Ground, z(), z(), Law::linear(1.0, 1.0)))
        .expect("adds");
    m.build().expect("a four-bar")
}

/// A slider-crank by a spline of many points, and a cam with a spline for its profile.
fn by_tables() -> [System; 2] {
    let table: Vec<(f64, f64)> =
        (0..13).map(|k| 0.5 * f64::from(k)).map(|x| (x, x + 0.1 * x.sin())).collect();
    let mut m = Mechanism::new("slider-crank");
    let crank = m.link("crank", 0.1).expect("a link");
    let rod = m.link("rod", 0.3).expect("a link");
    let slider = m.planar("slider", pose(0.4, 0.0, 0.0)).expect("a body");
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0))).expect("adds");
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).expect("adds");
    m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0))).expect("adds");
    m.add("guide", prismatic(slider, Ground, (0.0, 0.0), (0.0, 0.0), (0.0, 1.0), 0.0))
        .expect("adds");
    m.add("motor", drive_angle(crank, Law::spline(&table, Ends::Natural))).expect("adds");
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/examples");
    let cam =
        Mechanism::read_json(format!("{folder}/07_cam_follower.json"), &kin::data::Registry::new());
    [m.build().expect("a slider-crank"), cam.expect("a file").build().expect("a cam")]
}

/// The names of dimensions and parameters that leave a mechanism closed.
fn closing(system: &System, motion: &Motion) -> Vec<String> {
    let names = system.parameters().into_iter().map(|(name, _)| name);
    names.filter(|name| system.sensitivities(motion, [name]).is_ok()).collect()
}

#[test]
fn gradients_of_redundant_mechanisms_are_sums_of_their_derivatives() {
    let system = parallel_hinges();
    let names = closing(&system, &system.run([0.0, 0.1]).expect("a motion"));
    assert!(names.len() > 30, "{names:?}");
    // By the walk over the equations and by a tape; on the way round other equations become
    // superfluous.
    for times in [linspace(0.0, 1.0, 9), linspace(0.0, 1.0, 80), linspace(0.0, TAU, 300)] {
        let motion = system.run(times).expect("a motion");
        let by = system.sensitivities(&motion, &names).expect("derivatives");
        for j in [7, 8, 10, 20] {
            let what = system.coordinate_names()[j].clone();
            let weights = |k: usize| [1.0 + 0.1 * k as f64, 0.5, 0.25 - 0.01 * k as f64];
            let found = system.gradient(&motion, &names, &what, weights).expect("a gradient");
            for (found, by) in found.iter().zip(by.all()) {
                let mut sum = 0.0;
                let mut size = 1.0;
                for k in 0..motion.len() {
                    let all = weights(k).into_iter().zip([by.q(k)[j], by.qd(k)[j], by.qdd(k)[j]]);
                    all.map(|(weight, x)| weight * x).for_each(|term| {
                        sum += term;
                        size += term.abs();
                    });
                }
                assert!(
                    (found - sum).abs() < 1e-11 * size,
                    "{what} by {}: {found} {sum}",
                    by.name()
                );
            }
        }
    }
}

/// A parameter that opens a mechanism is refused wherever it is among others, with the words of the
/// derivatives themselves.
#[test]
fn a_gradient_by_a_parameter_that_opens_a_redundant_mechanism_is_refused() {
    let system = parallel_hinges();
    for count in [9, 80] {
        let motion = system.run(linspace(0.0, 1.0, count)).expect("a motion");
        for open in ["O.u_i.z", "A.h_i.x", "C.h_j.y"] {
            let said = system
                .sensitivities(&motion, ["a", open, "b"])
                .err()
                .expect("an error")
                .to_string();
            assert!(said.contains("closes at this value only"), "{said}");
            let what = system.coordinate_names()[7].clone();
            let backward = system.gradient(&motion, ["a", open, "b"], &what, |_| [1.0; 3]);
            assert_eq!(said, backward.expect_err("an error").to_string());
        }
    }
}

/// Of eight times as many times a gradient takes eight times as long, and not 64 times.
#[test]
fn the_time_of_a_gradient_grows_with_the_number_of_times() {
    for system in by_tables() {
        let what = system.coordinate_names()[0].clone();
        let seconds = |count: usize| {
            let motion = system.run(linspace(0.0, 5.9, count)).expect("a motion");
            let once = || {
                let begun = Instant::now();
                let names = ["motor.law.y[3]", "motor.law.rate"];
                let name =
                    names.iter().find(|name| system.parameter(name).is_ok()).expect("a parameter");
                system.gradient(&motion, [name], &what, |_| [1.0; 3]).expect("a gradient");
                begun.elapsed().as_secs_f64()
            };
            (0..3).map(|_| once()).fold(f64::INFINITY, f64::min)
        };
        let [few, many] = [3_000, 24_000].map(seconds);
        assert!(many < 20.0 * few, "{}: {many} s and {few} s", system.name());
    }
}
