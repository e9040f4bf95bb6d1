//! Values of time that only rustc can read, and laws that are written by hand: a program asks the
//! user's own code for them.

use kin::SolverOptions;
use kin::error::FailureKind;
use kin::extend::LawFunction;
use kin::prelude::*;

use crate::engines::Engines;
use crate::{USUAL, compiled, differences};

/// √x by a library that rustc alone can read.
fn root<D: kin::extend::Dual>(x: kin::extend::Real<D>) -> kin::extend::Real<D> {
    x.sqrt()
}

/// A turn that swings, with a pulse of height `a` and width `w` at the time `at`.
fn swing<D: kin::extend::Dual>(
    t: kin::extend::Real<D>,
    from: f64,
    [a, w, at]: [f64; 3],
) -> kin::extend::Real<D> {
    let s = (t - at) / w;
    t * -0.3 + (t * 5.0).sin() * 0.1 + from + (-(s * s)).exp() * a
}

#[constraint]
fn by_a_root(b: Planar, t: Time, k: f64) -> f64 {
    b.theta - root(k + t * t)
}

#[constraint]
fn by_a_swing(b: Planar, t: Time, from: f64, a: f64, w: f64, at: f64) -> f64 {
    b.theta - swing(t, from, [a, w, at])
}

/// A four-bar, its crank or its rocker driven.
fn four_bar(by_rocker: bool, motor: impl Fn(&mut Mechanism, Link)) -> System {
    crate::four_bar(USUAL, |m, crank, rocker| motor(m, if by_rocker { rocker } else { crank }))
}

#[test]
fn a_value_of_time_is_the_user_s_own() {
    let mut m = Mechanism::new("crank");
    let crank = m.link("crank", 1.0).expect("a link");
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).expect("adds");
    m.add("motor", by_a_root(crank, 1.0)).expect("adds");
    let mut system = m.build().expect("builds");
    let times = linspace(0.0, 2.0, 301);
    for k in [1.0, 2.0] {
        system.set("motor.k", k).expect("is set");
        system.run_both_with(&times, &SolverOptions::new().jerk(true)).expect("runs");
        let program = system.solver().options(compiled()).run(&times).expect("runs");
        assert!(program.engine().compiled > 280, "{:?}", program.engine());
        for (n, t) in times.iter().enumerate() {
            // √(k + t²), and its first two derivatives
            let root = (k + t * t).sqrt();
            let exact = [root, t / root, k / root.powi(3)];
            let found = [program.q(n)[2], program.qd(n)[2], program.qdd(n)[2]];
            assert!(
                found.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-13),
                "{t}: {found:?} {exact:?}"
            );
        }
    }
}

/// Of a loop what the value does between two times is sampled, by a program as by plain steps.
#[test]
fn most_times_of_a_loop_are_computed_by_the_program() {
    let system = four_bar(false, |m, crank| {
        m.add("motor", by_a_swing(crank, 0.4, 0.2, 0.3, 0.5)).expect("adds");
    });
    let times = linspace(0.0, 1.0, 1001);
    let plain = system.run_both_with(&times, &SolverOptions::new().jerk(true)).expect("runs");
    let program = system.solver().options(compiled()).run(&times).expect("runs");
    assert!(
        program.engine().compiled > 900 && program.engine().handed_back < 5,
        "{:?}",
        program.engine()
    );
    assert!(differences(&plain, &program).iter().all(|off| *off < 1e-9));
}

/// A pulse between two times that neither of them tells: it leads the rocker past its toggle and
/// back.
#[test]
fn a_pulse_between_two_times_is_seen_by_both() {
    let law = [-1.5, 1e-4, 0.5005];
    let system = four_bar(true, |m, rocker| {
        m.add("motor", by_a_swing(rocker, 2.2, law[0], law[1], law[2])).expect("adds");
    });
    let times = linspace(0.0, 1.0, 1001);
    let error = system.run_both(&times).expect_err("a toggle");
    assert!(matches!(error.kind(), Some(FailureKind::Toggle { .. })), "{error}");
    let program = system.solver().options(compiled()).run(&times).expect_err("a toggle");
    let motion = program.motion().expect("a motion");
    assert!(
        motion.len() == 501 && motion.engine().compiled > 400,
        "{} {:?}",
        motion.len(),
        motion.engine()
    );
}

/// A law by hand, of which no bounds are known.
struct Swing;

impl LawFunction for Swing {
    fn jet(&self, t: f64) -> [f64; 4] {
        let (sin, cos) = (3.0 * t).sin_cos();
        [0.3 + 0.2 * sin, 0.6 * cos, -1.8 * sin, -5.4 * cos]
    }
}

#[test]
fn laws_by_hand_are_asked() {
    let system = four_bar(false, |m, crank| {
        m.add("motor", drive_angle(crank, Law::new(Swing))).expect("adds");
    });
    let times = linspace(0.0, 1.0, 1001);
    system.run_both_with(&times, &SolverOptions::new().jerk(true)).expect("runs");
    let program = system.solver().options(compiled()).run(&times).expect("runs");
    assert!(
        program.engine().compiled > 900 && program.engine().handed_back < 5,
        "{:?}",
        program.engine()
    );
}

#[constraint]
fn by_what_ends(b: Planar, t: Time, end: f64) -> f64 {
    b.theta - root(end - t)
}

/// Both runs end with the same words where the user's own value is no number.
#[test]
fn a_value_that_is_no_number_is_told_by_both() {
    let system = four_bar(false, |m, crank| {
        m.add("motor", by_what_ends(crank, 0.64)).expect("adds");
    });
    let times = linspace(0.0, 1.0, 1001);
    let error = system.run_both(&times).expect_err("no number");
    let program = system.solver().options(compiled()).run(&times).expect_err("no number");
    assert_eq!(error.to_string(), program.to_string());
    let motion = program.motion().expect("a motion");
    assert!(motion.len() > 600 && motion.engine().compiled > 500, "{:?}", motion.engine());
}

/// True from half a second on.
fn is_late<D: kin::extend::Dual>(t: kin::extend::Real<D>) -> bool {
    t > 0.5
}

#[constraint]
fn by_halves(x: Coord, t: Time, rate: f64) -> f64 {
    if is_late(t) { x - rate * (1.0 - t) } else { x - rate * t }
}

/// A condition of time that only rustc can read.
#[test]
fn conditions_of_time_are_the_user_s_own_too() {
    let mut m = Mechanism::new("there and back");
    let x = m.length("x", 0.0).expect("a length");
    m.add("motor", by_halves(x, 1e-3)).expect("adds");
    let system = m.build().expect("builds");
    let times = linspace(0.0, 1.0, 1001);
    system.run_both(&times).expect("runs");
    let program = system.solver().options(compiled()).run(&times).expect("runs");
    assert!(program.engine().compiled > 800, "{:?}", program.engine());
    for (k, t) in times.iter().enumerate() {
        let exact = 1e-3 * t.min(1.0 - t);
        assert!((program.q(k)[0] - exact).abs() < 1e-15, "{t}: {} {exact}", program.q(k)[0]);
    }
}
