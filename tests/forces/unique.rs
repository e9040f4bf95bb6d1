//! Which forces of redundant mechanisms are unique, by name: decided by balances, not by how it is
//! solved.

use kin::SolverOptions;
use kin::forces::{Forces, LoadSharing};
use kin::prelude::*;
use kin::{Mechanism, System};

use crate::both::Engines;

const Z: Vec3 = Vec3::new(0.0, 0.0, 1.0);

fn tensor(x: f64, y: f64, z: f64) -> [[f64; 3]; 3] {
    [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]
}

/// A door on two hinges, in metres or in other units of length (`scale` to the metre), turned in
/// space, with its hinges in either order.
fn door(scale: f64, tilt: f64, swapped: bool) -> (System, SpatialBody) {
    let turn = EulerParameters::from_axis_angle(vec3(1.0, 2.0, -0.5), tilt);
    let a = turn.rotation();
    let mut m = Mechanism::new("door");
    let door = m
        .spatial("door", SpatialPose::new(a * vec3(0.5 * scale, 0.0, scale), turn))
        .expect("a body");
    let mut hinges = [("hinge 1", 0.3), ("hinge 2", 1.7)];
    if swapped {
        hinges.reverse();
    }
    for (name, height) in hinges {
        let u = vec3(-0.5, 0.0, height - 1.0) * scale;
        let p = a * vec3(0.0, 0.0, height * scale);
        m.add(name, spatial::revolute(door, m.ground(), u, p, Z, a * Z)).expect("a hinge");
    }
    let own = Axis::new(Z, vec3(1.0, 0.0, 0.0));
    let fixed = Axis::new(a * Z, a * vec3(1.0, 0.0, 0.0));
    m.add("hand", spatial::drive_turn(door, m.ground(), own, fixed, Law::sine(0.5, 2.0, 0.0)))
        .expect("a driver");
    let square = scale * scale;
    m.mass(
        door,
        20.0,
        vec3(0.01, 0.02, 0.0) * scale,
        tensor(8.0 * square, 7.0 * square, 2.0 * square),
    )
    .expect("a mass");
    m.gravity(a * vec3(0.0, 0.0, -9.81 * scale));
    (m.build().expect("a system"), door)
}

#[test]
fn two_hinges_of_a_door_share_its_weight_in_every_unit_order_and_pose() {
    for (scale, tilt, swapped) in
        [(1.0, 0.0, false), (1000.0, 0.0, true), (0.001, 1.1, false), (1.0, 2.3, true)]
    {
        let (system, door) = door(scale, tilt, swapped);
        let motion = system.run_both(linspace(0.0, 2.0, 11)).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        for hinge in ["hinge 1", "hinge 2"] {
            let acted =
                forces.reaction(hinge).expect("a hinge").on(door).expect("its door").in_body();
            // Along the axis, and the bending that each of them alone could hold.
            assert_eq!(
                acted.not_unique(),
                ["F_x", "F_y", "F_z", "T_x", "T_y"],
                "{scale} {tilt} {swapped}"
            );
            let told = acted.component("F_z").unwrap_err().to_string();
            assert!(told.starts_with(&format!("`{hinge}`: F_z on `door` is not unique")), "{told}");
            assert!(
                told.contains("`hinge 1`") && told.contains("`hinge 2`") && !told.contains("hand"),
                "{told}"
            );
        }
        let both =
            forces.sum(["hinge 1", "hinge 2"]).expect("both").on(door).expect("the door").in_body();
        assert_eq!(both.not_unique(), [""; 0]);
        let weight = both.component("F_z").expect("unique");
        assert!(
            weight.values().iter().all(|f| (f / (196.2 * scale) - 1.0).abs() < 1e-9),
            "{:?}",
            weight.values()
        );
        let hand = forces.drive("hand").expect("a driver");
        let due = (2.0 + 20.0 * (0.51_f64.powi(2) + 0.02_f64.powi(2))) * scale * scale;
        for (effort, qdd) in
            hand.effort().values().iter().zip(motion.times().iter().map(|t| -2.0 * (2.0 * t).sin()))
        {
            assert!((effort - due * qdd).abs() < 1e-9 * due, "{effort} {}", due * qdd);
        }
    }
}

#[test]
fn a_rule_that_is_asked_for_makes_numbers_and_keeps_all_balances() {
    let (system, door) = door(1.0, 0.0, false);
    let motion = system.run_both(linspace(0.0, 2.0, 11)).expect("a motion");
    let thrust = |forces: &Forces<'_>, hinge: &str| {
        let acted = forces.reaction(hinge).expect("a hinge").on(door).expect("its door");
        acted.component("F_z").expect("unique").values().to_vec()
    };
    let least = system
        .solver()
        .options(SolverOptions::new().sharing(LoadSharing::LeastNorm))
        .forces(&motion)
        .expect("forces");
    for (a, b) in thrust(&least, "hinge 1").iter().zip(thrust(&least, "hinge 2")) {
        assert!((a - 98.1).abs() < 1e-10 && (b - 98.1).abs() < 1e-10, "{a} {b}");
    }
    assert!(least.balance().worst() < 1e-12);
    let rows = ["hinge 2.point.z", "hinge 2.point.x", "hinge 2.point.y", "hinge 2.f", "hinge 2.g"];
    let rows: Vec<String> = rows.into_iter().map(str::to_string).collect();
    let without = system
        .solver()
        .options(SolverOptions::new().sharing(LoadSharing::Without(rows)))
        .forces(&motion)
        .expect("forces");
    for (a, b) in thrust(&without, "hinge 1").iter().zip(thrust(&without, "hinge 2")) {
        assert!((a - 196.2).abs() < 1e-10 && b.abs() < 1e-10, "{a} {b}");
    }
    let told = |rows: &[&str]| {
        let rows = rows.iter().map(|row| row.to_string()).collect();
        system
            .solver()
            .options(SolverOptions::new().sharing(LoadSharing::Without(rows)))
            .forces(&motion)
            .map(|_| ())
            .unwrap_err()
            .to_string()
    };
    assert!(told(&["hinge 2.z"]).contains("there is no equation `hinge 2.z`"));
    assert!(
        told(&["hinge 2.point.z"])
            .contains("the rule leaves out 1 equations, but 5 equations are redundant")
    );
    let both = ["hinge 1.point.z", "hinge 2.point.z", "hinge 1.f", "hinge 1.g", "hinge 2.f"];
    assert!(told(&both).contains("a body or coordinate can move"), "{}", told(&both));
    let hand = ["hand", "hinge 2.point.z", "hinge 1.f", "hinge 1.g", "hinge 2.f"];
    assert!(told(&hand).contains("`hand` is not redundant"), "{}", told(&hand));
}

/// One end of a joint: the spatial body, the planar one, and the point in both.
type End = (SpatialBody, PlanarBody, Vec3);

/// The same four-bar of bodies in space and in the plane, without its motor, and its joints.
fn four_bars() -> (Mechanism, Mechanism, [(&'static str, End, End); 4]) {
    let mut m = Mechanism::new("four-bar in space");
    let lengths = [("crank", 1.0, 0.4), ("coupler", 3.5, 0.5), ("rocker", 3.0, 1.7)];
    let mut planar = Mechanism::new("four-bar");
    let mut links = Vec::new();
    let a = vec2(0.4_f64.cos(), 0.4_f64.sin());
    let d = 4.0;
    // B where circles about A and C meet.
    let way = vec2(d, 0.0) - a;
    let l = way.norm();
    let along = (3.5_f64.powi(2) - 9.0 + l * l) / (2.0 * l);
    let across = (3.5_f64.powi(2) - along * along).sqrt();
    let b = a + way * (along / l) + vec2(-way.y, way.x) * (across / l);
    let ends = [(vec2(0.0, 0.0), a), (a, b), (vec2(d, 0.0), b)];
    for ((name, _, _), (from, to)) in lengths.iter().zip(ends) {
        let middle = (from + to) * 0.5;
        let turn = (to - from).y.atan2((to - from).x);
        let pose3 = SpatialPose::turned(vec3(middle.x, middle.y, 0.0), Z, turn);
        let body = m.spatial(name, pose3).expect("a body");
        m.mass(body, 1.3, vec3(0.1, 0.05, 0.0), tensor(0.2, 0.3, 0.4)).expect("a mass");
        let flat = planar.planar(name, pose(middle.x, middle.y, turn)).expect("a body");
        planar.mass(flat, 1.3, vec2(0.1, 0.05), 0.4).expect("a mass");
        links.push((body, flat, 0.5 * (to - from).norm()));
    }
    let end = |k: usize, sign: f64| vec3(sign * links[k].2, 0.0, 0.0);
    let ground = SpatialBody::from(m.ground());
    let flat = PlanarBody::from(planar.ground());
    let c = vec3(d, 0.0, 0.0);
    let joints = [
        ("O", (links[0].0, links[0].1, end(0, -1.0)), (ground, flat, vec3(0.0, 0.0, 0.0))),
        ("A", (links[0].0, links[0].1, end(0, 1.0)), (links[1].0, links[1].1, end(1, -1.0))),
        ("B", (links[1].0, links[1].1, end(1, 1.0)), (links[2].0, links[2].1, end(2, 1.0))),
        ("C", (links[2].0, links[2].1, end(2, -1.0)), (ground, flat, c)),
    ];
    for (name, (i, fi, ui), (j, fj, uj)) in joints {
        m.add(name, spatial::revolute(i, j, ui, uj, Z, Z)).expect("a joint");
        planar.add(name, revolute(fi, fj, vec2(ui.x, ui.y), vec2(uj.x, uj.y))).expect("a joint");
    }
    (m, planar, joints)
}

/// A planar four-bar whose bodies are spatial ones with five-row hinges: three equations too many.
/// In the plane everything is unique, across it nothing of a single joint is.
#[test]
fn a_planar_four_bar_in_space() {
    let (mut m, mut planar, joints) = four_bars();
    let link = joints[0].1.0;
    let flat_link = joints[0].1.1;
    let ground = SpatialBody::from(m.ground());
    let axis = Axis::new(Z, vec3(1.0, 0.0, 0.0));
    m.add("motor", spatial::drive_turn(link, ground, axis, axis, Law::linear(0.4, 3.0)))
        .expect("a driver");
    planar.add("motor", drive_angle(flat_link, Law::linear(0.4, 3.0))).expect("a driver");
    m.gravity(vec3(0.0, -9.81, 0.0));
    planar.gravity(vec2(0.0, -9.81));
    let system = m.build().expect("a system");
    let flat = planar.build().expect("a system");
    let times = linspace(0.0, 2.0, 21);
    let motion = system.run_both(&times).expect("a motion");
    let flat_motion = flat.run_both(&times).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let flat_forces = flat.forces(&flat_motion).expect("forces");
    let near = |a: &Series, b: &Series| {
        let size = b.max().abs().max(b.min().abs());
        let off = a.values().iter().zip(b.values()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-9 * (1.0 + size), "{}: {off:e} of {size}", a.name());
    };
    for (name, (body, flat_body, _), _) in joints {
        let acted = forces.reaction(name).expect("a joint").on(body).expect("its body");
        let flat = flat_forces.reaction(name).expect("a joint").on(flat_body).expect("its body");
        assert_eq!(acted.not_unique(), ["F_z", "T_x", "T_y"], "{name}");
        for component in ["F_x", "F_y"] {
            near(
                &acted.component(component).expect("unique"),
                &flat.component(component).expect("unique"),
            );
        }
        assert!(acted.component("T_z").expect("unique").max().abs() < 1e-9);
    }
    near(
        forces.drive("motor").expect("a driver").effort(),
        flat_forces.drive("motor").expect("a driver").effort(),
    );
}
