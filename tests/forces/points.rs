//! Force and torque of a joint about other points and in other axes, their units, and what is not
//! unique.

use kin::prelude::*;
use kin::{Error, Mechanism};

use crate::both::Engines;

const O: Vec2 = Vec2::new(0.0, 0.0);

/// The largest difference of two lists of vectors, which must have the same length.
fn apart(a: &[Vec3], b: &[Vec3]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (*a - *b).norm()).fold(0.0, f64::max)
}

/// An arm that turns about its start; all that holds it is the pin and its motor.
#[test]
fn torques_in_the_plane_follow_the_point() {
    let mut m = Mechanism::new("arm");
    let arm = m.planar("arm", pose(0.0, 0.0, 0.3)).expect("a body");
    let ground = PlanarBody::from(m.ground());
    m.mass(arm, 2.0, vec2(0.3, 0.1), 0.05).expect("a mass");
    m.gravity(vec2(0.0, -9.81));
    m.add("pin", revolute(arm, ground, O, O)).expect("a joint");
    m.add("motor", drive_angle(arm, Law::linear(0.3, 2.0))).expect("a driver");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 1.0, 7)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let on = |body| forces.reaction("pin").expect("a joint").on(body).expect("its body");
    let held = on(arm).force().expect("unique");
    assert_eq!(on(arm).points(), vec![O; 7]);
    // A pin has no torque about itself; about another point it is the moment of its force.
    let u = vec2(0.2, -0.4);
    let fixed = vec2(1.5, 0.7);
    let of_body = on(arm).at(u);
    let of_space = on(arm).about(fixed);
    // The ground takes the opposite, and its axes are the global ones.
    let of_ground = on(ground).at(fixed).in_body();
    assert_eq!(of_space.points(), vec![fixed; 7]);
    for (k, t) in motion.times().iter().enumerate() {
        let (sin, cos) = (0.3 + 2.0 * t).sin_cos();
        let point = vec2(cos * u.x - sin * u.y, sin * u.x + cos * u.y);
        assert!((of_body.points()[k] - point).norm() < 1e-14);
        let due = [-point.cross(held[k]), -fixed.cross(held[k]), fixed.cross(held[k])];
        let found =
            [&of_body, &of_space, &of_ground].map(|acted| acted.torque().expect("unique")[k]);
        assert!(
            due.iter().zip(found).all(|(due, found)| (due - found).abs() < 1e-12),
            "{due:?} {found:?}"
        );
        let turned = on(arm).in_body().force().expect("unique")[k];
        let own = vec2(cos * held[k].x + sin * held[k].y, cos * held[k].y - sin * held[k].x);
        assert!((turned - own).norm() < 1e-12);
        let opposite = of_ground.force().expect("unique")[k] + held[k];
        assert!(opposite.norm() < 1e-12);
    }
    let units = on(arm).components().iter().map(|one| one.unit().to_string()).collect::<Vec<_>>();
    assert_eq!(units, ["N", "N", "N m"]);
    assert_eq!(of_space.torque_magnitude().expect("unique").unit(), "N m");
    let size = of_space.torque_magnitude().expect("unique").values()[3];
    assert!((size - fixed.cross(held[3]).abs()).abs() < 1e-12);
}

/// A rotor on a hinge across a leaning axis, in whatever order points and axes are chosen.
#[test]
fn points_and_axes_in_space_in_any_order() {
    let mut m = Mechanism::new("rotor");
    let o = vec3(0.3, -0.2, 0.5);
    let h = vec3(0.0, 0.6, 0.8);
    let turn = EulerParameters::from_axis_angle(vec3(1.0, 2.0, -0.5), 0.7);
    let rotor = m.spatial("rotor", SpatialPose::new(o, turn)).expect("a body");
    let own = m.local_direction(rotor, h).expect("its axis");
    let ground = m.ground();
    let inertia = [[0.2, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0, 0.0, 0.4]];
    m.mass(rotor, 2.0, vec3(0.1, 0.2, -0.3), inertia).expect("a mass");
    m.gravity(vec3(0.2, -0.5, -9.81));
    let zero = vec3(0.0, 0.0, 0.0);
    m.add("hinge", spatial::revolute(rotor, ground, zero, o, own, h)).expect("a joint");
    m.add("motor", spatial::drive_turn(rotor, ground, own, h, Law::ramp(3.0))).expect("a driver");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 1.0, 5)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let on = || forces.reaction("hinge").expect("a joint").on(rotor).expect("its body");
    let u = vec3(0.2, -0.4, 0.6);
    let fixed = vec3(1.5, 0.7, -0.2);
    let force = on().force().expect("unique");
    let torque = on().torque().expect("unique");
    let axes = |k: usize| {
        let q = motion.q(k);
        EulerParameters::new(q[3], q[4], q[5], q[6]).rotation()
    };
    let place = |k: usize| o + axes(k) * u;
    let own = |v: &[Vec3]| {
        v.iter().enumerate().map(|(k, v)| axes(k).transpose() * *v).collect::<Vec<_>>()
    };
    let about: Vec<Vec3> =
        force.iter().zip(&torque).map(|(f, t)| *t + (o - fixed).cross(*f)).collect();
    let at: Vec<Vec3> = (0..5).map(|k| torque[k] + (o - place(k)).cross(force[k])).collect();
    for (found, due) in
        [(on().about(fixed), &about), (on().at(u), &at), (on().at(u).about(fixed), &about)]
    {
        assert!(apart(&found.force().expect("unique"), &force) < 1e-12);
        assert!(apart(&found.torque().expect("unique"), due) < 1e-11);
    }
    let own_force = own(&force);
    let own_about = own(&about);
    let own_at = own(&at);
    for (found, due) in [
        (on().about(fixed).in_body(), &own_about),
        (on().in_body().about(fixed), &own_about),
        (on().in_body().at(u).in_body(), &own_at),
        (on().at(u).in_body().about(fixed).at(u), &own_at),
    ] {
        assert!(apart(&found.force().expect("unique"), &own_force) < 1e-12);
        assert!(apart(&found.torque().expect("unique"), due) < 1e-11);
    }
    let moved = on().in_body().at(u);
    assert!(apart(&moved.points(), &(0..5).map(place).collect::<Vec<_>>()) < 1e-14);
    let units = moved.components().iter().map(|one| one.unit().to_string()).collect::<Vec<_>>();
    assert_eq!(units, ["N", "N", "N", "N m", "N m", "N m"]);
    let size = moved.torque_magnitude().expect("unique").values()[4];
    assert!((size - at[4].norm()).abs() < 1e-11);
}

/// Two hinges of a door, in units of a billionth of a metre and of a billion metres too.
#[test]
fn no_number_stands_for_what_is_not_unique_in_any_unit() {
    for scale in [1.0, 1e9, 1e-9] {
        let mut m = Mechanism::new("door");
        let z = vec3(0.0, 0.0, 1.0);
        let door = m.spatial("door", SpatialPose::at(vec3(0.5, 0.0, 1.0) * scale)).expect("a body");
        for (name, height) in [("hinge 1", 0.3), ("hinge 2", 1.7)] {
            let u = vec3(-0.5, 0.0, height - 1.0) * scale;
            let p = vec3(0.0, 0.0, height * scale);
            m.add(name, spatial::revolute(door, m.ground(), u, p, z, z)).expect("a hinge");
        }
        m.add("hand", spatial::drive_turn(door, m.ground(), z, z, Law::ramp(0.5)))
            .expect("a driver");
        let inertia = [8.0, 7.0, 2.0].map(|x| x * scale * scale);
        m.mass(
            door,
            20.0,
            vec3(0.0, 0.0, 0.0),
            [[inertia[0], 0.0, 0.0], [0.0, inertia[1], 0.0], [0.0, 0.0, inertia[2]]],
        )
        .expect("a mass");
        m.gravity(z * (-9.81 * scale));
        let system = m.build().expect("a system");
        let motion = system.run_both([0.0, 0.5]).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        let acted =
            forces.reaction("hinge 1").expect("a hinge").on(door).expect("its door").in_body();
        assert_eq!(acted.not_unique(), ["F_x", "F_y", "F_z", "T_x", "T_y"], "{scale}");
        assert_eq!(acted.components().len(), 1, "{scale}");
        let refused = [
            acted.force().map(drop),
            acted.torque().map(drop),
            acted.magnitude().map(drop),
            acted.torque_magnitude().map(drop),
            acted.component("T_x").map(drop),
        ];
        for told in refused {
            assert!(matches!(told, Err(Error::NotUnique(_))), "{scale}: {told:?}");
        }
        assert!(forces.drive("hand").is_ok(), "{scale}");
    }
}
