//! Forces that redundant constraints share: powers and rules, bare coordinates, and points of a
//! joint.

use kin::SolverOptions;
use kin::forces::LoadSharing;
use kin::prelude::*;
use kin::{Error, Load, Mechanism, loads};

use crate::both::Engines;

const O: Vec2 = Vec2::new(0.0, 0.0);

/// Two motors on one bare angle, which comes before all lengths, and an arm on a motor of its own.
fn twins() -> (System, PlanarBody) {
    let mut m = Mechanism::new("twins");
    let dial = m.angle("dial", 0.0).expect("a coordinate");
    m.add("motor 1", drive(dial, Law::ramp(2.0))).expect("a driver");
    m.add("motor 2", drive(dial, Law::ramp(2.0))).expect("a driver");
    m.load("brake", loads::force_along(dial, Law::constant(-6.0))).expect("a load");
    let arm = m.planar("arm", pose(0.0, 0.0, 0.0)).expect("a body");
    m.mass(arm, 2.0, vec2(0.3, 0.0), 0.1).expect("a mass");
    m.gravity(vec2(0.0, -10.0));
    m.add("pin", revolute(arm, m.ground(), O, O)).expect("a joint");
    m.add("hand", drive_angle(arm, Law::ramp(3.0))).expect("a driver");
    (m.build().expect("a system"), arm)
}

#[test]
fn motors_of_a_bare_angle_share_by_a_rule() {
    let (system, arm) = twins();
    let motion = system.run_both([0.0, 0.5]).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    for name in ["motor 1", "motor 2"] {
        match forces.drive(name) {
            Err(error @ Error::NotUnique(_)) => {
                let told = error.to_string();
                assert!(told.contains("`motor 1`") && told.contains("`motor 2`"), "{told}");
                assert!(!told.contains("hand") && !told.contains("pin"), "{told}");
            }
            other => panic!("{other:?}"),
        }
    }
    // A unique effort has its power, by the drive and by its reaction.
    let power = forces.reaction("hand").expect("a driver").power();
    let exact: Vec<f64> =
        motion.times().iter().map(|t| 3.0 * 20.0 * 0.3 * (3.0 * t).cos()).collect();
    for found in [&power, forces.drive("hand").expect("a driver").power()] {
        assert!(found.values().iter().zip(&exact).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
    }
    // No rule leaves them open; the least norm halves, and what is left out gives nothing.
    let open = system
        .solver()
        .options(SolverOptions::new().sharing(LoadSharing::NotGiven))
        .forces(&motion)
        .expect("forces");
    assert!(open.drive("motor 1").is_err());
    let left_out = LoadSharing::Without(vec!["motor 1".to_string()]);
    for (sharing, due) in [(LoadSharing::LeastNorm, [3.0, 3.0]), (left_out, [0.0, 6.0])] {
        let forces = system
            .solver()
            .options(SolverOptions::new().sharing(sharing.clone()))
            .forces(&motion)
            .expect("forces");
        let found = ["motor 1", "motor 2"]
            .map(|name| forces.drive(name).expect("unique").effort().values()[1]);
        assert!(
            (found[0] - due[0]).abs() + (found[1] - due[1]).abs() < 1e-12,
            "{sharing:?}: {found:?}"
        );
        assert!(forces.balance().worst() < 1e-13, "{sharing:?}");
        let held = forces.reaction("pin").expect("a joint").on(arm).expect("its body").magnitude();
        assert!(held.is_ok());
    }
}

/// Where nothing is redundant a rule changes nothing, and there is nothing to leave out.
#[test]
fn rules_of_sharing_without_redundant_equations() {
    let mut m = Mechanism::new("arm");
    let arm = m.planar("arm", pose(0.0, 0.0, 0.0)).expect("a body");
    m.mass(arm, 2.0, vec2(0.3, 0.0), 0.1).expect("a mass");
    m.add("pin", revolute(arm, m.ground(), O, O)).expect("a joint");
    m.add("hand", drive_angle(arm, Law::sine(1.0, 3.0, 0.2))).expect("a driver");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 1.0, 5)).expect("a motion");
    let own = system.forces(&motion).expect("forces").columns();
    for sharing in [LoadSharing::NotGiven, LoadSharing::LeastNorm, LoadSharing::Without(Vec::new())]
    {
        assert_eq!(
            system
                .solver()
                .options(SolverOptions::new().sharing(sharing.clone()))
                .forces(&motion)
                .expect("forces")
                .columns(),
            own,
            "{sharing:?}"
        );
    }
    let told = system
        .solver()
        .options(SolverOptions::new().sharing(LoadSharing::Without(vec!["hand".to_string()])))
        .forces(&motion)
        .map(drop);
    let told = told.expect_err("nothing is redundant").to_string();
    assert!(
        told.contains("the rule leaves out 1 equations, but 0 equations are redundant"),
        "{told}"
    );
}

/// A door on three hinges: what they hold together along its axis is its weight, and a rule shares
/// it.
#[test]
fn three_hinges_of_a_door() {
    let mut m = Mechanism::new("door");
    let z = vec3(0.0, 0.0, 1.0);
    let door = m.spatial("door", SpatialPose::at(vec3(0.5, 0.0, 1.0))).expect("a body");
    let names = ["low", "middle", "high"];
    for (name, height) in names.into_iter().zip([0.3, 0.9, 1.7]) {
        let u = vec3(-0.5, 0.0, height - 1.0);
        let p = vec3(0.0, 0.0, height);
        m.add(name, spatial::revolute(door, m.ground(), u, p, z, z)).expect("a hinge");
    }
    m.add("hand", spatial::drive_turn(door, m.ground(), z, z, Law::ramp(0.5))).expect("a driver");
    let inertia = [[8.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, 2.0]];
    m.mass(door, 20.0, vec3(0.0, 0.0, 0.0), inertia).expect("a mass");
    m.gravity(z * -9.81);
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 0.5]).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    for name in names {
        let acted = forces.reaction(name).expect("a hinge").on(door).expect("the door").in_body();
        assert_eq!(acted.not_unique(), ["F_x", "F_y", "F_z", "T_x", "T_y"], "{name}");
        assert!(acted.component("T_z").expect("unique").values().iter().all(|t| t.abs() < 1e-10));
    }
    let two = forces.sum(["low", "high"]).expect("two").on(door).expect("the door");
    assert!(two.component("F_z").is_err());
    let all = forces.sum(names).expect("all").on(door).expect("the door");
    assert!(
        all.component("F_z").expect("unique").values().iter().all(|f| (f - 196.2).abs() < 1e-9)
    );
    assert!(forces.drive("hand").is_ok() && forces.balance().worst() < 1e-12);
    let shared = system
        .solver()
        .options(SolverOptions::new().sharing(LoadSharing::LeastNorm))
        .forces(&motion)
        .expect("forces");
    for name in names {
        let acted = shared.reaction(name).expect("a hinge").on(door).expect("the door");
        assert!(
            acted
                .component("F_z")
                .expect("unique")
                .values()
                .iter()
                .all(|f| (f - 65.4).abs() < 1e-9)
        );
    }
}

/// A rod between a point of a body and one of the ground: each body has its own end, and no torque
/// about it.
#[test]
fn a_rod_has_a_point_on_each_body() {
    let mut m = Mechanism::new("strut");
    let slider = m.planar("slider", pose(0.4, 0.0, 0.0)).expect("a body");
    let ground = m.ground();
    let u = vec2(0.1, 0.2);
    let foot = vec2(0.5, -0.6);
    let arm = m.planar("arm", pose(0.0, 1.0, 0.0)).expect("a body");
    m.add("guide", prismatic(slider, ground, O, O, vec2(0.0, 1.0), 0.0)).expect("a joint");
    m.add("rack", drive(slider.x(), Law::linear(0.4, 0.1))).expect("a driver");
    m.add("pin", revolute(arm, ground, O, vec2(0.0, 1.0))).expect("a joint");
    m.add("rod", distance(slider, arm, u, foot, 1.2)).expect("a rod");
    m.load("push", Load::torque(arm, 4.0)).expect("a load");
    m.load("spring", loads::spring(slider, ground, u, foot, 30.0, 0.2)).expect("a load");
    let two = Load::force(slider, u, vec2(3.0, 0.0)).and(Load::force(slider, foot, vec2(0.0, 5.0)));
    m.load("two", two).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 1.0, 5)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let points = |body: PlanarBody, u: Vec2| motion.point(body, u).expect("a point").r().to_vec();
    let rod = forces.reaction("rod").expect("a rod");
    for (body, u) in [(slider, u), (arm, foot)] {
        let on = rod.on(body).expect("its body");
        let found = on.points();
        let due = points(body, u);
        assert!(found.iter().zip(&due).all(|(a, b)| (*a - *b).norm() < 1e-12), "{found:?} {due:?}");
        assert!(on.torque().expect("unique").iter().all(|torque| torque.abs() < 1e-11));
        assert!(on.magnitude().expect("unique").min() > 1.0);
    }
    // A load of two parts has its torque about the point of its first part.
    let two = forces.load("two").expect("a load").on(slider).expect("its body");
    assert!(two.points().iter().zip(points(slider, u)).all(|(a, b)| (*a - b).norm() < 1e-12));
    let torque = two.torque().expect("unique");
    assert!(torque.iter().all(|torque| (torque - (foot.x - u.x) * 5.0).abs() < 1e-12));
    let spring = forces.load("spring").expect("a load");
    assert_eq!(spring.on(PlanarBody::from(ground)).expect("the ground").points(), [foot; 5]);
    let on = spring.on(slider).expect("its body").points();
    assert!(on.iter().zip(points(slider, u)).all(|(a, b)| (*a - b).norm() < 1e-12));
}

/// A rack drives a body by a bare angle: that has no force on a body, and is not one of its bodies.
#[test]
fn bodies_of_a_joint_are_told_without_its_bare_coordinates() {
    /// A pinion of radius r on a rack: x − r φ = 0.      [m]
    #[constraint]
    fn pinion(turn: Coord, rack: Planar, r: f64) -> f64 {
        rack.r.x - r * turn
    }
    let mut m = Mechanism::new("rack");
    let turn = m.angle("turn", 0.0).expect("a coordinate");
    let ground = m.ground();
    let rack = m.planar("rack", pose(0.0, 0.0, 0.0)).expect("a body");
    let other = m.planar("other", pose(0.0, 0.0, 0.0)).expect("a body");
    m.add("teeth", pinion(turn, rack, 0.2)).expect("a joint");
    m.add("motor", drive(turn, Law::ramp(1.0))).expect("a driver");
    m.add("y", drive(rack.y(), Law::constant(0.0))).expect("a driver");
    m.add("theta", drive(rack.theta(), Law::constant(0.0))).expect("a driver");
    m.add("wall", fixed(other, O, 0.0)).expect("a joint");
    m.load("work", Load::force(rack, O, vec2(-7.0, 0.0))).expect("a load");
    m.load("brake", loads::viscous("rack.R_x", 3.0)).expect("a load");
    m.load("clutch", loads::viscous("turn", 0.2)).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 0.5]).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let teeth = forces.reaction("teeth").expect("a joint");
    let push = teeth.on(rack).expect("its body").component("F_x").expect("unique");
    assert!(push.values().iter().all(|f| (f - 7.6).abs() < 1e-12));
    let told = teeth.on(other).map(drop).expect_err("not its body").to_string();
    assert_eq!(
        told,
        "`teeth` (reaction): the constraint does not act on `other`. Choose a body on which the constraint acts: rack"
    );
    let ground = teeth.on(PlanarBody::from(ground)).expect("the ground").force().expect("unique");
    assert!(ground.iter().all(|f| (*f - vec2(-7.6, 0.0)).norm() < 1e-12));
    assert!((forces.drive("motor").expect("a driver").effort().values()[1] - 1.72).abs() < 1e-12);
    // Loads along coordinates by their names act on the body of the coordinate, if it is one of a
    // body.
    let brake = forces.load("brake").expect("a load");
    let slowed = brake.on(rack).expect("its body").force().expect("unique");
    assert!(slowed.iter().all(|f| (*f - vec2(-0.6, 0.0)).norm() < 1e-12));
    let told = brake.on(other).map(drop).expect_err("not its body").to_string();
    assert_eq!(
        told,
        "`brake` (reaction): the constraint does not act on `other`. Choose a body on which the constraint acts: rack"
    );
    let clutch = forces.load("clutch").expect("a load");
    let told = clutch.on(rack).map(drop).expect_err("not its body").to_string();
    assert_eq!(
        told,
        "`clutch` (reaction): the constraint does not act on `rack`. The constraint acts on no body"
    );
    // The first of its bodies is the rack.
    let sizes = forces.magnitudes();
    assert!(sizes.iter().any(|one| one.name() == "teeth on rack.force"), "{sizes:?}");
}
