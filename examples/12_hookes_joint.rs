//! Hooke's joint and the double Cardan shaft. Lengths in m, angles in rad, time in s.
//!
//! What to see: the first shaft turns evenly, the middle one does not: one Hooke's joint at an
//! angle β makes its speed swing between cos β and 1/cos β, twice a turn. The second joint, its
//! forks in line with those of the first, takes all of that back, and the last shaft turns evenly
//! again. Drag the picture to go round it.
//!
//! `cargo run --release --example 12_hookes_joint`

use kin::Axis;
use kin::joints::drivers::spatial::drive_turn;
use kin::prelude::*;
use kin_view::{Figure, Outline, Panel, Scene};

const OUT: &str = "out/12_hookes_joint";

/// A shaft along its x-axis with a fork of half-width w at one end (s = 1 or −1), whose tips carry
/// the bar of the cross along `bar`.
fn fork(half: f64, s: f64, w: f64, bar: Vec3) -> [Outline; 2] {
    let at = |x: f64, side: f64| vec3(s * x, 0.0, 0.0) + bar * (side * w);
    [
        Outline::line([at(half, 1.0), at(half - w, 1.0), at(half - w, -1.0), at(half, -1.0)]),
        Outline::line([at(half, 1.0), at(half, -1.0)]),
    ]
}

fn main() -> kin::Result<()> {
    // 1. Geometry: three shafts in a plane, the middle one at an angle β to the others; frames in
    //    the middle of each.
    let beta = deg(40.0);
    let half = 0.2; // rad, m
    let x = Vec3::x();
    let y = Vec3::y();
    let z = Vec3::z();
    let along = vec3(beta.cos(), 0.0, beta.sin());
    let a = x * half;
    let b = x * half + along * (2.0 * half); // centres of the joints
    let mut m = Mechanism::new("double Cardan shaft");
    let ground = m.ground();
    let first = m.spatial("first shaft", SpatialPose::at(vec3(0.0, 0.0, 0.0)))?;
    let middle = m.spatial("middle shaft", SpatialPose::turned(a + along * half, -y, beta))?;
    let last = m.spatial("last shaft", SpatialPose::at(b + x * half))?;

    // 2. Constraints: 5 + 4 + 4 + 4 equations, the motor's, and one norm a body, for 21
    //    coordinates. The last shaft may slide in its bearing.
    let axis = Axis::along(x);
    m.add("bearing", spatial::revolute(first, ground, x * -half, x * -half, axis, x))?;
    m.add("A", spatial::universal(first, middle, x * half, x * -half, y, z))?;
    m.add("B", spatial::universal(middle, last, x * half, x * -half, z, y))?;
    m.add(
        "sliding bearing",
        spatial::cylindrical(last, ground, x * half, b + x * (2.0 * half), axis, x),
    )?;
    m.add("motor", drive_turn(first, ground, axis, axis, Law::ramp(PI)))?; // half a turn a second

    // 3. Motion: speeds about each shaft's own axis, from the rates of its Euler parameters.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 4.0, 1201))?;
    let mut speeds = Vec::new();
    for (name, body) in [("first", first), ("middle", middle), ("last", last)] {
        speeds.push((name, motion.rotation(body)?.in_body().about(x).values().to_vec()));
    }
    motion.add_point("A", first, x * half)?;
    motion.add_point("tip", middle, x * -half + z * 0.06)?;
    for (name, values) in speeds {
        motion.add_output(&format!("{name} shaft"), "rad/s", values)?;
    }
    motion.write_csv(format!("{OUT}/motion.csv"))?;
    println!("{}", motion.summary());
    let turning: Vec<Series> = motion.outputs().iter().rev().take(3).rev().cloned().collect();
    for shaft in &turning {
        println!("{:13} {:.4} to {:.4} rad/s", shaft.name(), shaft.min(), shaft.max());
    }
    println!("one joint alone: {:.4} to {:.4} rad/s", PI * beta.cos(), PI / beta.cos());

    // 4. Pictures: shafts with forks.
    let shaft = |from: f64, to: f64| Outline::line([x * from, x * to]);
    let w = 0.06;
    let mut scene =
        Scene::new(&system).trace("tip", middle, x * -half + z * w).seen_from(-1.1, 0.3);
    for (body, outlines) in [
        (
            first,
            vec![shaft(-half, half - w)]
                .into_iter()
                .chain(fork(half, 1.0, w, y))
                .collect::<Vec<_>>(),
        ),
        (
            middle,
            vec![shaft(w - half, half - w)]
                .into_iter()
                .chain(fork(half, 1.0, w, z))
                .chain(fork(half, -1.0, w, z))
                .collect(),
        ),
        (last, vec![shaft(w - half, half)].into_iter().chain(fork(half, -1.0, w, y)).collect()),
    ] {
        scene = outlines.into_iter().fold(scene, |scene, outline| scene.outline(body, outline));
    }
    scene.pose(&motion, 0.3)?.save(format!("{OUT}/pose.svg"))?;
    scene.animated(&motion, 6.0)?.save(format!("{OUT}/animated.svg"))?;
    let panel =
        turning.iter().fold(Panel::over_time("Shafts", "angular velocity"), |panel, shaft| {
            panel.series(shaft.name(), shaft)
        });
    Figure::new([panel]).save(format!("{OUT}/speeds.svg"))?;
    let page = scene
        .page(&motion)?
        .chart("Angular velocities", turning.iter().map(|shaft| (shaft.name(), shaft)));
    page.save(format!("{OUT}/index.html"))
}
