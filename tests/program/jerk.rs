//! The jerk by a program: that of plain steps, wherever it is asked for.

use kin::prelude::*;
use kin::{Engine, SolverOptions};

use crate::compiled;
use crate::engines::Engines;
use crate::gallery::mechanisms;

fn with_jerk() -> SolverOptions {
    SolverOptions::new().jerk(true)
}

#[test]
fn mechanisms_of_the_gallery_have_it_by_both_engines() {
    for (name, system) in mechanisms() {
        let times = linspace(0.01, 0.21, 401);
        let motion = system.run_both_with(&times, &with_jerk()).expect("runs");
        assert!(motion.has_jerk(), "{name}");
        let program = system.solver().options(compiled().jerk(true)).run(&times).expect("runs");
        assert!(
            10 * program.engine().compiled >= 9 * times.len(),
            "{name}: {:?}",
            program.engine()
        );
        assert!((0..times.len()).all(|k| program.qddd(k).len() == program.q(k).len()), "{name}");
    }
}

/// x = f(t) alone has the third derivative of f; at the knots of a spline that of the part on the
/// right.
#[test]
fn a_slider_has_the_third_derivative_of_its_law() {
    let table = [(0.0, 0.0), (1.0, 0.3), (2.0, -0.1), (3.0, 0.4), (4.0, 0.0)];
    let laws = [
        Law::spline(&table, kin::law::Ends::Natural),
        Law::sine(0.3, 2.0, 0.1),
        Law::polynomial(&[0.1, 0.2, -0.3, 0.4, 0.05]),
        Law::cycloidal(0.2, 4.5),
    ];
    for law in laws {
        let mut m = Mechanism::new("slider");
        let x = m.length("x", 0.0).expect("a length");
        m.add("motor", drive(x, law.clone())).expect("adds");
        let system = m.build().expect("builds");
        let times = linspace(0.0, 4.0, 401);
        let options = compiled().jerk(true);
        let motion = system.solver().options(options.clone()).run(&times).expect("runs");
        assert!(motion.engine().compiled > 300, "{:?}", motion.engine());
        for (k, t) in times.iter().enumerate() {
            let found = motion.qddd(k)[0];
            let exact = law.jet(*t)[3];
            assert!(
                (found - exact).abs() < 1e-9 * (1.0 + exact.abs()),
                "{law:?} at {t}: {found} {exact}"
            );
        }
    }
}

/// A change point, where plain steps have a jerk of their own, and what lies behind it.
#[test]
fn behind_a_change_point_it_goes_on() {
    let system = crate::four_bar([1.0, 3.0, 1.0, 3.0], |m, crank, _| {
        m.add("motor", drive_angle(crank, Law::linear(0.5, 1.0))).expect("adds");
    });
    let motion = system.run_both_with(linspace(0.0, 4.0, 1201), &with_jerk()).expect("runs");
    assert_eq!(motion.singular_positions().len(), 1);
    assert!((0..motion.len()).all(|k| motion.qddd(k).iter().all(|x| x.is_finite())));
}

/// Runs in parts have it too, and an end that is an error leaves as many rows of it as of the
/// others.
#[test]
fn parts_and_ends_have_as_many_rows_of_it_as_of_the_others() {
    let mut m = Mechanism::new("slider");
    let x = m.length("x", 0.0).expect("a length");
    m.add(
        "motor",
        drive(x, Law::sequence(0.0, [(0.7, Law::ramp(1.0)), (2.0, Law::linear(0.7, -0.5))])),
    )
    .expect("adds");
    let system = m.build().expect("builds");
    for engine in [Engine::StepByStep, Engine::Compiled] {
        let options = with_jerk().engine(engine);
        let error = system
            .solver()
            .options(options.clone())
            .run(linspace(0.0, 2.0, 801))
            .expect_err("a corner");
        let motion = error.motion().expect("a motion");
        assert!(
            motion.len() > 250 && motion.qddd_rows().len() == motion.qdd_rows().len(),
            "{error}"
        );
        let mut parts = 0;
        let keep = |part: &Motion| {
            parts += 1;
            assert!(part.has_jerk() && part.qddd_rows().len() == part.qdd_rows().len());
            Ok(())
        };
        system
            .solver()
            .options(options.clone())
            .run_in_parts(linspace(0.0, 0.6, 301), 100, keep)
            .expect("runs");
        assert_eq!(parts, 4);
    }
}
