//! All assemblies of a loop, with labels.

use kin::algebra::Vec3;
use kin::prelude::*;
use kin::{AssemblyOptions, Label};

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
    let (dx, dy) = (1.0_f64.cos() - 4.0, 1.0_f64.sin());
    let d = dx.hypot(dy);
    let half = ((9.0 + d * d - 3.5 * 3.5) / (6.0 * d)).acos();
    let exact = [dy.atan2(dx) - half, dy.atan2(dx) + half].map(f64::sin);
    for assembly in &all {
        assert!(exact.iter().any(|exact| (assembly.q[8].sin() - exact).abs() < 1e-9), "{assembly:?}");
        assert_eq!(assembly.label.ordinal, 1);
    }
    assert!(all[0].label != all[1].label);
    // Asked for again, and run from.
    let label: Label = all[1].label.to_string().parse().unwrap();
    let again = system.assembly(0.0, &label).unwrap();
    assert_eq!(again, all[1]);
    system.set_initial(&again.q).unwrap();
    let motion = system.run_both([0.0, 0.01]).unwrap();
    assert!((motion.coordinate(rocker.theta()).unwrap().value.values()[0] - again.q[8]).abs() < 1e-9);
    assert!(
        system
            .assembly(0.0, &Label { signs: vec![1], ordinal: 9 })
            .unwrap_err()
            .to_string()
            .contains(&all[0].label.to_string())
    );
}

/// The distance of a point of the platform from a point of the base is l.      [m]
#[constraint]
fn leg(platform: Spatial, u: Vec3, base: Vec3, l: f64) -> f64 {
    let d = platform.point(u) - base;
    d.dot(d) - l * l
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
        m.add(&format!("leg {}", k + 1), leg(platform, v(PLATFORM[k]), v(BASE[k]), LEGS[k])).unwrap();
    }
    let system = m.build().unwrap();
    let begun = std::time::Instant::now();
    let all = system.assemblies_with(0.0, &AssemblyOptions::default()).unwrap();
    println!("{} in {:?}", all.len(), begun.elapsed());
    for assembly in &all {
        println!("{}", assembly.label);
        assert!(system.residual(&assembly.q, 0.0).unwrap().iter().all(|c| c.abs() < 1e-10));
    }
    assert_eq!(all.len(), 40);
    for (k, a) in all.iter().enumerate() {
        for b in &all[k + 1..] {
            assert_ne!(a.label, b.label);
            let turned = a.q[3..].iter().zip(&b.q[3..]).map(|(a, b)| a * b).sum::<f64>().abs();
            let moved = (0..3).map(|k| (a.q[k] - b.q[k]).powi(2)).sum::<f64>().sqrt();
            assert!(moved > 1e-3 || turned < 1.0 - 1e-6, "{a:?} {b:?}");
        }
    }
}
