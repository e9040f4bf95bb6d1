//! A Delta robot that picks and places. Lengths in mm, angles in rad, time in s.
//!
//! What to see: the program gives the path of the tool: up, across, down and back. The turns of the
//! three motors follow. Each forearm is a pair of equal rods on balls, and the three pairs together
//! keep the plate level, without an equation for it. Drag the picture to go round it.
//!
//! `cargo run --release --example 19_delta_robot`

use kin::joints::drivers::spatial::drive_point;
use kin::prelude::*;
use kin_view::{Figure, Outline, Panel, Scene};

const OUT: &str = "out/19_delta_robot";

const BASE: f64 = 200.0; // mm: from the middle to the motors' axes
const PLATE: f64 = 60.0; // from the middle of the plate to its balls
const ARM: f64 = 250.0;
const FOREARM: f64 = 560.0;
const HALF: f64 = 40.0; // half the distance of the two rods of a forearm
const LOW: f64 = -560.0; // where the tool picks, below the motors

fn main() -> kin::Result<()> {
    // 1. The plate, and three arms on the base, drawn where the plate stands in the middle at the
    //    height z = LOW.
    let mut m = Mechanism::new("Delta robot");
    m.units("mm", "s");
    let ground = m.ground();
    let plate = m.spatial("plate", SpatialPose::at(vec3(0.0, 0.0, LOW)))?;
    let mut arms = Vec::new();
    for k in 0..3 {
        let azimuth = TAU / 3.0 * k as f64;
        let out = vec3(azimuth.cos(), azimuth.sin(), 0.0);
        let across = vec3(-azimuth.sin(), azimuth.cos(), 0.0);
        let shoulder = out * BASE;
        let elbow = shoulder + out * ARM * deg(20.0).cos() - Vec3::z() * ARM * deg(20.0).sin();
        let arm = m.spatial_link_between(&format!("arm {}", k + 1), shoulder, elbow)?;
        let axis = m.local_direction(arm, across)?;
        m.add(
            &format!("motor {}", k + 1),
            spatial::revolute(arm, ground, arm.start(), shoulder, axis, across),
        )?;
        for (name, side) in [("left", -HALF), ("right", HALF)] {
            let upper = arm.end() + axis * side;
            let lower = out * PLATE + across * side;
            m.add(
                &format!("{name} rod {}", k + 1),
                spatial::distance(arm, plate, upper, lower, FOREARM),
            )?;
        }
        arms.push((arm, axis, out, across));
    }

    // 2. The tool's path: 100 mm up, 300 mm across, down, and the same way back, in two seconds;
    //    the moves overlap.
    let lift = |begin: f64| {
        let up = Law::polynomial_345(100.0, 0.3);
        Law::sequence(
            begin,
            [(0.3, up.clone()), (0.4, Law::constant(100.0)), (0.3, Law::constant(100.0) - up)],
        )
    };
    let across = Law::sequence(
        0.15,
        [
            (0.7, Law::constant(-150.0) + Law::polynomial_345(300.0, 0.7)),
            (0.3, Law::constant(150.0)),
            (0.7, Law::constant(150.0) - Law::polynomial_345(300.0, 0.7)),
        ],
    );
    let path_z = Law::constant(LOW) + lift(0.0) + lift(1.0);
    m.add("path", drive_point(plate, vec3(0.0, 0.0, 0.0), across.clone(), across * 0.4, path_z))?;

    // 3. Motion; the turns of the motors are those of the arms, below the horizontal.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 2.0, 801))?;
    println!("{}", motion.summary());
    for (k, (arm, ..)) in arms.iter().enumerate() {
        let turn: Vec<f64> = motion
            .point(*arm, arm.end())?
            .r()
            .iter()
            .map(|elbow| (-elbow.z / ARM).clamp(-1.0, 1.0).asin())
            .collect();
        motion.add_output(&format!("motor {}", k + 1), "rad", turn)?;
    }
    let tool = motion.point(plate, vec3(0.0, 0.0, 0.0))?;
    for turn in motion.outputs() {
        println!(
            "{}: {:.2}° to {:.2}°",
            turn.name(),
            turn.min().to_degrees(),
            turn.max().to_degrees()
        );
    }
    println!(
        "tool: at most {:.0} mm/s and {:.0} mm/s²",
        tool.speed().max(),
        tool.acceleration_magnitude().max()
    );
    let motors = motion.outputs().to_vec();
    motion.add_point("tool", plate, vec3(0.0, 0.0, 0.0))?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 4. Pictures: base and plate are told, and the cross bars at the elbows.
    let corners = |radius: f64, half: f64| {
        let sides =
            arms.iter().flat_map(|(_, _, out, across)| [(out, across, -half), (out, across, half)]);
        sides.map(|(out, across, half)| *out * radius + *across * half).collect::<Vec<Vec3>>()
    };
    let scene = Scene::new(&system)
        .seen_from(-0.9, 0.3)
        .outline(ground, Outline::polygon(corners(BASE, 60.0)));
    let mut scene =
        scene.outline(plate, Outline::polygon(corners(PLATE, HALF))).color(plate, "#d55e00");
    for &(arm, axis, ..) in &arms {
        let bar = Outline::line([arm.end() - axis * HALF, arm.end() + axis * HALF]);
        scene = scene
            .outline(arm, Outline::line([arm.start(), arm.end()]))
            .outline(arm, bar)
            .color(arm, "#0072b2");
    }
    let scene = scene.trace("tool", plate, vec3(0.0, 0.0, 0.0));
    scene.pose(&motion, 0.2)?.save(format!("{OUT}/pose.svg"))?;
    scene.animated(&motion, 4.0)?.save(format!("{OUT}/animated.svg"))?;
    let panel = motors
        .iter()
        .fold(Panel::over_time("Motors", "turn below the horizontal"), |panel, turn| {
            panel.series(turn.name(), turn)
        });
    Figure::new([panel]).save(format!("{OUT}/motors.svg"))?;
    let page = scene
        .page(&motion)?
        .chart("Turns of the motors", motors.iter().map(|turn| (turn.name(), turn)));
    page.chart("Speed of the tool", [("tool", &tool.speed())]).save(format!("{OUT}/index.html"))
}
