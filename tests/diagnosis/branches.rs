//! Joints that close with an axis turned by 180°, in square and in redundant mechanisms; laws that
//! break in redundant ones.

use kin::error::FailureKind;
use kin::joints::drivers::spatial as drivers;
use kin::joints::spatial;
use kin::prelude::*;

use crate::engines::Engines;

const O: Vec3 = Vec3 { x: 0.0, y: 0.0, z: 0.0 };
const X: Vec3 = Vec3 { x: 1.0, y: 0.0, z: 0.0 };
const Z: Vec3 = Vec3 { x: 0.0, y: 0.0, z: 1.0 };

/// A door on so many hinges along the global z-axis, from a guess.
fn door(hinges: usize, guess: SpatialPose, motor: Law) -> (Mechanism, SpatialBody) {
    let mut m = Mechanism::new("door");
    let body = m.spatial("door", guess).unwrap();
    for k in 0..hinges {
        let at = Z * k as f64;
        m.add(&format!("hinge {k}"), spatial::revolute(body, m.ground(), at, at, Z, Z)).unwrap();
    }
    m.add("motor", drivers::drive_turn(body, m.ground(), Z, Z, motor)).unwrap();
    (m, body)
}

/// True if the z-axis of the only body points up in a position.
fn upright(q: &[f64]) -> bool {
    let p = EulerParameters::new(q[3], q[4], q[5], q[6]);
    (p.rotation() * Z - Z).norm() < 1e-9
}

#[test]
fn guess_that_is_upside_down_is_turned_over() {
    for hinges in [1, 3] {
        for angle in [2.0, 3.0, PI, 4.0] {
            for axis in [X, vec3(1.0, 2.0, 0.3), vec3(-0.2, 1.0, 0.5)] {
                let (m, _) = door(
                    hinges,
                    SpatialPose::turned(vec3(0.2, -0.1, 0.1), axis, angle),
                    Law::ramp(1.0),
                );
                let motion = m.build().unwrap().run_both(linspace(0.0, 1.0, 11)).unwrap();
                assert!(
                    (0..motion.len()).all(|k| upright(motion.q(k))),
                    "{hinges} {angle} {axis:?}"
                );
            }
        }
    }
}

/// Two doors, one on the other, both guessed upside down: one is turned over after the other.
#[test]
fn bodies_of_a_chain_are_turned_over_one_by_one() {
    let mut m = Mechanism::new("two doors");
    let guess = SpatialPose::turned(O, X, 3.0);
    let a = m.spatial("a", guess).unwrap();
    let b = m.spatial("b", SpatialPose::turned(X, vec3(0.0, 1.0, 0.2), 3.1)).unwrap();
    m.add("hinge a", spatial::revolute(a, m.ground(), O, O, Z, Z)).unwrap();
    m.add("hinge b", spatial::revolute(b, a, O, X, X, X)).unwrap();
    m.add("motor a", drivers::drive_turn(a, m.ground(), Z, Z, Law::ramp(1.0))).unwrap();
    m.add("motor b", drivers::drive_turn(b, a, X, X, Law::ramp(0.5))).unwrap();
    let solution = m.build().unwrap().position(0.0).unwrap();
    let turned = |first: usize| {
        EulerParameters::new(
            solution.q[first],
            solution.q[first + 1],
            solution.q[first + 2],
            solution.q[first + 3],
        )
    };
    assert!(
        (turned(3).rotation() * Z - Z).norm() < 1e-9
            && (turned(10).rotation() * X - X).norm() < 1e-9
    );
}

/// An axis that cannot be mended is told, in redundant mechanisms too: the third hinge asks for the
/// opposite axis.
#[test]
fn axis_that_is_wrong_any_way_up_is_told() {
    let (mut m, body) = door(2, SpatialPose::at(O), Law::ramp(1.0));
    m.add("hinge 9", spatial::revolute(body, m.ground(), O, O, Z, vec3(0.0, 0.0, -1.0))).unwrap();
    let system = m.build().unwrap();
    for error in [system.run_both([0.0, 0.1]).unwrap_err(), system.position(0.0).unwrap_err()] {
        let text = error.to_string();
        assert!(matches!(error.kind(), Some(FailureKind::WrongBranch { .. })), "{text}");
        assert!(
            text.contains("`hinge 9` (revolute) is assembled the wrong way round")
                || text.contains("`hinge 0` (revolute) closes"),
            "{text}"
        );
    }
}

#[test]
fn redundant_runs_watch_their_laws() {
    let corner = Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, -1.0))]);
    let (m, _) = door(2, SpatialPose::at(O), corner);
    let error = m.build().unwrap().run_both(linspace(0.1, 1.9, 10)).unwrap_err();
    assert!(matches!(error.kind(), Some(FailureKind::LawJumps { order: 1, .. })), "{error}");
    assert_eq!(error.motion().unwrap().len(), 5);
    let (m, _) = door(2, SpatialPose::at(O), Law::trapezoidal(2.0, 1.0, 2.0));
    let motion = m.build().unwrap().run_both(linspace(-1.0, 4.0, 51)).unwrap();
    assert_eq!(motion.breaks().len(), 4);
}
