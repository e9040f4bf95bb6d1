//! Motions of before something was set: what is computed anew from them would be of two mechanisms
//! at once.

use kin::prelude::*;
use kin::solver::Stop;
use kin::{Error, Follow, SolverOptions};

/// A slider-crank with mass, its rail `h` above the crank's pin, in units of `scale` metres.
fn slider_crank(scale: f64, h: f64) -> (System, Link) {
    let mut m = Mechanism::new("slider-crank");
    let crank = m.link("crank", 0.2 * scale).expect("a link");
    let rod = m.link("rod", 0.5 * scale).expect("a link");
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).expect("adds");
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).expect("adds");
    m.add("rail", point_on_line(rod, Ground, rod.end(), vec2(0.0, h * scale), vec2(1.0, 0.0)))
        .expect("adds");
    m.add("motor", drive_angle(crank, Law::linear(0.3, 2.0))).expect("adds");
    m.mass(rod, 1.0, vec2(0.0, 0.0), 0.1 * scale * scale).expect("a mass");
    (m.build().expect("builds"), rod)
}

fn is_other<T>(answer: kin::Result<T>) -> bool {
    matches!(answer, Err(Error::OtherMotion(_)))
}

#[test]
fn a_motion_of_before_something_was_set_is_told() {
    for scale in [1.0, 1e3, 1e-3] {
        let (mut system, _) = slider_crank(scale, 0.0);
        let motion = system.run(linspace(0.0, 1.0, 51)).expect("runs");
        system.set("rail.u_j.y", 1e-5 * scale).expect("sets");
        assert!(is_other(system.forces(&motion)), "{scale}");
        assert!(is_other(system.sensitivities(&motion, ["rail.u_j.y"])));
        assert!(is_other(system.at(&motion, 0.333)));
        assert!(is_other(system.extremes(&motion, "rod.theta")));
        let told = system.forces(&motion).err().map(|error| error.to_string()).unwrap_or_default();
        assert!(
            told.contains("\"slider-crank\" with its present values")
                && told.contains("the equation `rail` has the residual"),
            "{told}"
        );
        // Run again, all is well.
        let motion = system.run(linspace(0.0, 1.0, 51)).expect("runs");
        assert!(system.forces(&motion).is_ok() && system.at(&motion, 0.333).is_ok());
        assert!(system.sensitivities(&motion, ["rail.u_j.y"]).is_ok());
        system.set("rail.u_j.y", 0.0).expect("sets");
        assert!(is_other(system.forces(&motion)));
    }
}

/// However loosely C = 0 is met, and wherever coordinates count from, a motion is that of its
/// system.
#[test]
fn a_motion_of_the_system_itself_is_none_of_another() {
    for scale in [1.0, 1e3, 1e-3] {
        let (system, _) = slider_crank(scale, 0.1);
        for stop in [
            Stop::Converged { tolerance: 1e-5 },
            Stop::Converged { tolerance: 1e-13 },
            Stop::ResidualOnly(1e-3 * scale),
        ] {
            for predict in [true, false] {
                let options =
                    SolverOptions::new().stop(stop).predict(predict).follow(Follow::Unchecked);
                let motion = system
                    .solver()
                    .options(options.clone())
                    .run(linspace(0.0, 300.0, 30_001))
                    .expect("runs");
                assert!(system.forces(&motion).is_ok(), "{scale} {stop:?} {predict}");
                assert!(system.at(&motion, 17.203).is_ok(), "{scale} {stop:?} {predict}");
            }
        }
    }
}
