//! All assemblies of a loop, with labels.

use kin::SolverOptions;
use kin::Vec3;
use kin::joints::drivers::spatial::drive_turn;
use kin::prelude::*;
use kin::solver::{AssemblyOptions, Complete, Label};

use crate::engines::Engines;
use crate::models::*;

#[test]
fn four_bar_has_two_assemblies() {
    let (mut m, [crank, _, rocker]) = four_bar();
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    let mut system = m.build().unwrap();
    let all = system.assemblies(0.0).unwrap();
    assert_eq!(all.len(), 2);
    // By the law of cosines.
    let dx = 1.0_f64.cos() - 4.0;
    let dy = 1.0_f64.sin();
    let d = dx.hypot(dy);
    let half = ((9.0 + d * d - 3.5 * 3.5) / (6.0 * d)).acos();
    let exact = [dy.atan2(dx) - half, dy.atan2(dx) + half].map(f64::sin);
    for assembly in &all {
        assert!(
            exact.iter().any(|exact| (assembly.q[8].sin() - exact).abs() < 1e-9),
            "{assembly:?}"
        );
        assert_eq!(assembly.label.ordinal, 1);
    }
    assert!(all[0].label != all[1].label);
    // Asked for again, and run from.
    let label: Label = all[1].label.to_string().parse().unwrap();
    let again = system.assembly(0.0, &label).unwrap();
    assert_eq!(again, all[1]);
    system.set_initial(&again.q).unwrap();
    let motion = system.run_both([0.0, 0.01]).unwrap();
    assert!(
        (motion.coordinate(rocker.theta()).unwrap().value.values()[0] - again.q[8]).abs() < 1e-9
    );
    assert!(
        system
            .assembly(0.0, &Label { signs: vec![1], ordinal: 9 })
            .unwrap_err()
            .to_string()
            .contains(&all[0].label.to_string())
    );
}

const BASE: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [1.107915, 0.0, 0.0],
    [0.549094, 0.756063, 0.0],
    [0.735077, -0.223935, 0.525991],
    [0.514188, -0.526063, -0.368418],
    [0.590473, 0.094733, -0.205018],
];
const PLATFORM: [[f64; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [0.542805, 0.0, 0.0],
    [0.956919, -0.528915, 0.0],
    [0.665885, -0.353482, 1.402538],
    [0.478359, 1.158742, 0.107672],
    [-0.137087, -0.235121, 0.353913],
];
const LEGS: [f64; 6] = [1.0, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071];

/// The platform of P. Dietmaier (1998), of whose 40 poses all are real.
#[test]
fn stewart_gough_platform_has_40_poses() {
    let mut m = Mechanism::new("Stewart-Gough platform");
    let platform = m.spatial("platform", SpatialPose::at(Vec3::new(0.5, 0.5, 0.5))).unwrap();
    for k in 0..6 {
        let v = |p: [f64; 3]| Vec3::new(p[0], p[1], p[2]);
        let leg = spatial::distance(platform, m.ground(), v(PLATFORM[k]), v(BASE[k]), LEGS[k]);
        m.add(&format!("leg {}", k + 1), leg).unwrap();
    }
    let system = m.build().unwrap();
    let begun = std::time::Instant::now();
    let all = system
        .solver()
        .options(SolverOptions::new().assemblies(AssemblyOptions::default()))
        .assemblies(0.0)
        .unwrap();
    println!("{} in {:?}", all.len(), begun.elapsed());
    for assembly in &all {
        println!("{}", assembly.label);
        assert!(system.residual(&assembly.q, 0.0).unwrap().iter().all(|c| c.abs() < 1e-10));
    }
    assert_eq!(all.len(), 40);
    assert_eq!(all.complete, Complete::Believed, "{}", all.reason);
    for (k, a) in all.iter().enumerate() {
        for b in &all[k + 1..] {
            assert_ne!(a.label, b.label);
            let turned = a.q[3..].iter().zip(&b.q[3..]).map(|(a, b)| a * b).sum::<f64>().abs();
            let moved = (0..3).map(|k| (a.q[k] - b.q[k]).powi(2)).sum::<f64>().sqrt();
            assert!(moved > 1e-3 || turned < 1.0 - 1e-6, "{a:?} {b:?}");
        }
    }
}

/// Points on a ring, two beside each of three directions.
fn ring(radius: f64, beside: f64) -> Vec<Vec3> {
    let directions = [30.0, -90.0, 150.0].into_iter().map(deg);
    directions
        .flat_map(|angle| [angle + beside, angle - beside])
        .map(|angle| Vec3::new(radius * angle.cos(), radius * angle.sin(), 0.0))
        .collect()
}

/// A plate on six rods, whose feet stand at different heights.
fn six_rods() -> System {
    let plate_points = ring(49.8, deg(48.41));
    let feet = ring(77.0, deg(22.95));
    let mut m = Mechanism::new("six rods");
    let plate = m.spatial("plate", SpatialPose::at((5.0, 3.0, -120.0))).unwrap();
    for k in 0..6 {
        let foot = Vec3::new(feet[k].x, feet[k].y, 2.0 * k as f64);
        let rod =
            spatial::distance(plate, m.ground(), plate_points[k], foot, 140.0 + 1.5 * k as f64);
        m.add(&format!("rod {k}"), rod).unwrap();
    }
    m.build().unwrap()
}

#[test]
fn all_poses_of_a_plate_on_six_rods() {
    let system = six_rods();
    for seed in 0..3 {
        let begun = std::time::Instant::now();
        let all = system
            .solver()
            .options(SolverOptions::new().assemblies(AssemblyOptions::new().seed(seed)))
            .assemblies(0.0)
            .unwrap();
        println!("{} in {:?}: {}", all.len(), begun.elapsed(), all.reason);
        assert_eq!((all.len(), all.complete), (14, Complete::Believed), "{}", all.reason);
    }
    // A search that is cut short does not claim to be complete.
    let few = AssemblyOptions::new().starts(40);
    let some = system
        .solver()
        .options(SolverOptions::new().assemblies(few.clone()))
        .assemblies(0.0)
        .unwrap();
    assert!(some.len() < 14);
    assert_eq!(some.complete, Complete::Unknown);
    assert!(some.reason.contains("40 starting poses led to"), "{}", some.reason);
}

/// Six motors turn cranks on the ground; rods join the ends of the cranks to the plate. With the
/// cranks where the motors hold them it is a plate on six rods.
#[test]
fn six_cranks_and_rods_have_the_poses_of_their_plate() {
    let plate_points = ring(40.0, deg(48.0));
    let feet = ring(70.0, deg(20.0));
    let crank_angle = |k: usize| 0.3 + 0.2 * k as f64;
    let place = SpatialPose::at((3.0, 2.0, 90.0));
    let mut cranked = Mechanism::new("six cranks");
    let mut fixed = Mechanism::new("six feet");
    let plates = [&mut cranked, &mut fixed].map(|m| m.spatial("plate", place).unwrap());
    let arm = Vec3::new(20.0, 0.0, 0.0);
    for k in 0..6 {
        let crank = cranked.spatial(&format!("crank {k}"), SpatialPose::at(feet[k])).unwrap();
        let axis = Vec3::y();
        let ground = cranked.ground();
        let rod = 95.0 + 2.0 * k as f64;
        let hinge = spatial::revolute(crank, ground, Vec3::zeros(), feet[k], axis, axis);
        cranked.add(&format!("hinge {k}"), hinge).unwrap();
        let h = Axis::new(axis, Vec3::x());
        let angle = crank_angle(k);
        let motor = drive_turn(crank, ground, h, h, Law::constant(angle));
        cranked.add(&format!("motor {k}"), motor).unwrap();
        let name = format!("rod {k}");
        cranked.add(&name, spatial::distance(crank, plates[0], arm, plate_points[k], rod)).unwrap();
        let end = feet[k] + Vec3::new(20.0 * angle.cos(), 0.0, -20.0 * angle.sin());
        fixed
            .add(&name, spatial::distance(plates[1], fixed.ground(), plate_points[k], end, rod))
            .unwrap();
    }
    let [all, exact] = [cranked, fixed].map(|m| m.build().unwrap().assemblies(0.0).unwrap());
    println!("{}: {}", all.len(), all.reason);
    assert_eq!(exact.complete, Complete::Believed, "{}", exact.reason);
    assert_eq!((all.len(), all.complete), (exact.len(), Complete::Believed), "{}", all.reason);
    assert!(exact.len() >= 4);
    for one in &exact {
        let near = |q: &[f64]| q[..3].iter().zip(&one.q[..3]).all(|(a, b)| (a - b).abs() < 1e-6);
        assert_eq!(all.iter().filter(|found| near(&found.q)).count(), 1, "{one:?}");
    }
}

#[test]
fn no_pose_with_a_hinge_turned_over() {
    let mut m = Mechanism::new("arm");
    let arm = m.spatial("arm", SpatialPose::at((0.0, 0.0, 0.0))).unwrap();
    let ground = m.ground();
    let z = Vec3::z();
    m.add("hinge", spatial::revolute(arm, ground, Vec3::zeros(), Vec3::zeros(), z, z)).unwrap();
    let h = Axis::new(z, Vec3::x());
    m.add("motor", drive_turn(arm, ground, h, h, Law::constant(0.5))).unwrap();
    let all = m.build().unwrap().assemblies(0.0).unwrap();
    assert_eq!(all.len(), 1, "{all:?}");
    assert!(
        (all[0].q[6] - 0.25_f64.sin()).abs() < 1e-9 || (all[0].q[6] + 0.25_f64.sin()).abs() < 1e-9
    );
}

#[test]
fn an_open_chain_has_one_assembly_and_that_is_proved() {
    let mut m = Mechanism::new("arm");
    let upper = m.link("upper", 1.0).unwrap();
    let fore = m.link("fore", 0.7).unwrap();
    m.add("shoulder", revolute(upper, m.ground(), upper.start(), (0.0, 0.0))).unwrap();
    m.add("elbow", revolute(fore, upper, fore.start(), upper.end())).unwrap();
    m.add("motor", drive_angle(upper, Law::linear(0.4, 1.0))).unwrap();
    m.add("elbow motor", drive_relative_angle(fore, upper, Law::constant(2.0))).unwrap();
    let all = m.build().unwrap().assemblies(0.0).unwrap();
    assert_eq!((all.len(), all.complete), (1, Complete::Proved), "{}", all.reason);
    assert!((all[0].q[5] - 2.4).abs() < 1e-12);
}

/// A parallelogram drawn flat is at its change point: one singular pose, of which nobody knows from
/// a list whether it stands alone.
#[test]
fn a_singular_assembly_is_not_said_to_be_all() {
    let mut m = Mechanism::new("parallelogram");
    let [a, b, c] = [("a", 0.5, 0.0), ("b", 2.0, 0.0), ("c", 2.5, 0.0)]
        .map(|(name, x, y)| m.planar(name, pose(x, y, 0.0)).unwrap());
    m.add("O", revolute(a, m.ground(), (-0.5, 0.0), (0.0, 0.0))).unwrap();
    m.add("A", revolute(a, b, (0.5, 0.0), (-1.0, 0.0))).unwrap();
    m.add("B", revolute(b, c, (1.0, 0.0), (0.5, 0.0))).unwrap();
    m.add("C", revolute(c, m.ground(), (-0.5, 0.0), (2.0, 0.0))).unwrap();
    m.add("motor", drive_angle(a, Law::linear(0.0, 1.0))).unwrap();
    let system = m.build().unwrap();
    let all = system.assemblies(0.0).unwrap();
    assert_eq!((all.len(), all.complete), (1, Complete::Unknown), "{}", all.reason);
    assert!(all.reason.contains("singular"), "{}", all.reason);
    let begun = system.run([0.0]).unwrap_err().to_string();
    assert!(begun.contains("change point"), "{begun}");
}

#[test]
fn a_list_of_assemblies_says_in_json_whether_it_is_complete() {
    let (mut m, [crank, ..]) = four_bar();
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    let system = m.build().unwrap();
    let begun = std::time::Instant::now();
    let all = system.assemblies(0.0).unwrap();
    println!("a four-bar in {:?}: {}", begun.elapsed(), all.reason);
    assert_eq!(all.complete, Complete::Believed);
    let json = serde_json::to_value(&all).unwrap();
    assert_eq!(json["complete"], "believed");
    assert_eq!(json["assemblies"][1]["label"], all[1].label.to_string());
    assert_eq!(json["assemblies"][0]["q"].as_array().unwrap().len(), 9);
    assert!(json["reason"].as_str().unwrap().contains("starting poses led to each assembly"));
    // a four-bar that cannot close: nothing is found, and that is no proof that there is nothing
    let (mut m, [crank, ..]) = four_bar();
    m.add("motor", drive_angle(crank, Law::constant(1.0))).unwrap();
    m.add("rod", distance(crank, m.ground(), (0.0, 0.0), (9.0, 9.0), 1.0)).unwrap();
    let none = m.build().unwrap().assemblies(0.0).unwrap();
    assert_eq!((none.len(), none.complete), (0, Complete::Unknown), "{}", none.reason);
}

/// A delta robot whose motors hold its arms, and the same plate on its six rods alone.
fn delta() -> [System; 2] {
    let mut driven = Mechanism::new("delta");
    let mut fixed = Mechanism::new("six rods of a delta");
    let place = SpatialPose::at((0.0, 0.0, -560.0));
    let plates = [&mut driven, &mut fixed].map(|m| m.spatial("plate", place).unwrap());
    for k in 0..3 {
        let azimuth = TAU / 3.0 * k as f64;
        let out = Vec3::new(azimuth.cos(), azimuth.sin(), 0.0);
        let across = Vec3::new(-azimuth.sin(), azimuth.cos(), 0.0);
        let shoulder = out * 200.0;
        let elbow =
            |angle: f64| shoulder + out * 250.0 * angle.cos() - Vec3::z() * 250.0 * angle.sin();
        let arm =
            driven.spatial_link_between(&format!("arm {k}"), shoulder, elbow(deg(20.0))).unwrap();
        let axis = driven.local_direction(arm, across).unwrap();
        let hinge = spatial::revolute(arm, driven.ground(), arm.start(), shoulder, axis, across);
        driven.add(&format!("hinge {k}"), hinge).unwrap();
        // From the horizontal down: right-handed about `across`.
        let own = Axis::new(axis, arm.end() - arm.start());
        let down = 0.3 + 0.05 * k as f64;
        let motor =
            drive_turn(arm, driven.ground(), own, Axis::new(across, out), Law::constant(down));
        driven.add(&format!("motor {k}"), motor).unwrap();
        for (name, side) in [("left", -40.0), ("right", 40.0)] {
            let upper = arm.end() + axis * side;
            let lower = out * 60.0 + across * side;
            let name = format!("{name} rod {k}");
            driven.add(&name, spatial::distance(arm, plates[0], upper, lower, 560.0)).unwrap();
            let upper = elbow(down) + across * side;
            fixed.add(&name, spatial::distance(Ground, plates[1], upper, lower, 560.0)).unwrap();
        }
    }
    [driven.build().unwrap(), fixed.build().unwrap()]
}

/// An arm that is driven has one pose: one with its hinge turned over is none. With eight of such
/// arms for each pose of the plate a delta would have 128.
#[test]
fn a_delta_robot_has_the_poses_of_its_plate_on_six_rods() {
    let [driven, fixed] = delta();
    let [robot, plate] = [&driven, &fixed].map(|system| system.assemblies(0.0).unwrap());
    assert_eq!((robot.len(), robot.complete), (16, Complete::Believed), "{}", robot.reason);
    assert_eq!((plate.len(), plate.complete), (16, Complete::Believed), "{}", plate.reason);
    for own in &robot {
        let is_same = |q: &[f64]| {
            let far = own.q[..3].iter().zip(q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let turned: f64 = own.q[3..7].iter().zip(&q[3..]).map(|(a, b)| a * b).sum();
            far < 1e-6 && turned.abs() > 1.0 - 1e-9
        };
        assert_eq!(plate.iter().filter(|plate| is_same(&plate.q)).count(), 1, "{own:?}");
    }
}
