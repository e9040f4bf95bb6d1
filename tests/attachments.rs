//! The points and directions that a constraint speaks of are known without being told.

#[path = "data/engines.rs"]
mod engines;

use kin::check::{any_planar, any_spatial};
use kin::extend::{Attached, Parameters, by_dual};
use kin::prelude::*;
use kin::{vec2, vec3};

use crate::engines::Engines;

/// Pin in a slot at y = k, read through names, constants and a closure.      [m]
#[constraint]
fn pin_in_slot(i: Planar, j: Planar, u_i: Vec2, length: f64, t: Time) -> (f64, f64) {
    let end = |x: f64| vec2(x * length, 0.0);
    let h = j.direction(vec2(0.0, 1.0));
    let moving = j.point(vec2(t, 0.0));
    let d = i.point(2.0 * u_i) - j.point(end(0.5));
    (h.dot(d), (d - moving).x)
}

/// The same point through a loop of unknown length: dual route.      [m]
#[constraint]
fn unread(i: Spatial, j: Spatial, n: usize, u_i: Vec3, h_j: Vec3) -> f64 {
    let mut sum = 0.0;
    let mut k = 0;
    while k < n {
        sum += i.point(u_i).dot(j.direction(h_j));
        k += 1;
    }
    sum
}

fn shown(constraint: &dyn Constraint) -> Vec<(usize, &'static str, [f64; 3])> {
    let all = constraint.attachments();
    let each = all.iter().map(|a| match a.what {
        Attached::Point(u) => (a.argument, "point", [u.x, u.y, u.z]),
        Attached::Direction(h) => (a.argument, "direction", [h.x, h.y, h.z]),
    });
    each.collect()
}

#[test]
fn of_a_joint_of_the_library() {
    let joint = revolute(any_planar(), any_planar(), vec2(0.1, 0.2), vec2(-0.3, 0.4));
    let expected = [(0, "point", [0.1, 0.2, 0.0]), (1, "point", [-0.3, 0.4, 0.0])];
    assert_eq!(shown(&joint), expected);
    assert_eq!(shown(&by_dual(joint)), expected);
}

#[test]
fn whatever_they_are_computed_from_but_not_what_moves() {
    let mut joint = pin_in_slot(any_planar(), any_planar(), vec2(0.1, 0.2), 3.0);
    assert_eq!(joint.route(), Route::Symbolic);
    assert_eq!(
        shown(&joint),
        [
            (1, "direction", [0.0, 1.0, 0.0]),
            (0, "point", [0.2, 0.4, 0.0]),
            (1, "point", [1.5, 0.0, 0.0])
        ]
    );
    assert!(joint.set_parameter("length", 4.0));
    assert_eq!(shown(&joint)[2], (1, "point", [2.0, 0.0, 0.0]));
}

#[test]
fn on_the_dual_route_those_that_are_parameters() {
    let joint = unread(any_spatial(), any_spatial(), 2, vec3(1.0, 2.0, 3.0), vec3(0.0, 0.0, 1.0));
    assert_eq!(joint.route(), Route::Dual);
    assert_eq!(shown(&joint), [(0, "point", [1.0, 2.0, 3.0]), (1, "direction", [0.0, 0.0, 1.0])]);
}

#[test]
fn a_system_shows_its_bodies_its_constraints_and_its_condition() -> kin::Result<()> {
    let mut m = Mechanism::new("arm");
    let arm = m.link("arm", 2.0)?;
    m.add("O", revolute(m.ground(), arm, vec2(0.0, 0.0), arm.start()))?;
    m.add("motor", drive_angle(arm, Law::ramp(1.0)))?;
    let system = m.build()?;
    assert_eq!(system.bodies().iter().map(|(name, _)| *name).collect::<Vec<_>>(), ["arm"]);
    let constraints: Vec<_> = system
        .constraints()
        .map(|(name, c)| (name, c.facts().kind.to_string(), c.attachments().len()))
        .collect();
    assert_eq!(
        constraints,
        [("O", "revolute".to_string(), 2), ("motor", "drive_angle".to_string(), 0)]
    );
    let condition = system.condition(&system.run_both(linspace(0.0, 1.0, 5))?)?;
    assert!(condition.values().iter().all(|k| (1.0..10.0).contains(k)), "{condition:?}");
    Ok(())
}
