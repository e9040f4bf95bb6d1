//! A double wishbone suspension with a steering rack, both wheels. Lengths in mm, angles in rad,
//! time in s.
//!
//! What to see: for four seconds both wheels go up and down by 60 mm, and the camber follows, while
//! the toe stays within a fifth of a degree: the tie rods swing with the wishbones. Then the rack
//! goes to either side and the wheels steer, the inner one more. x is forwards, y to the left, z
//! up; drag the picture to go round it.
//!
//! `cargo run --release --example 17_double_wishbone`

use kin::joints::drivers::spatial::{drive_point_along, drive_slide};
use kin::prelude::*;
use kin_view::{Figure, Outline, Panel, Scene};

const OUT: &str = "out/17_double_wishbone";
const O: Vec3 = Vec3::new(0.0, 0.0, 0.0);

/// Points of the left side; those of the right have y the other way.   [mm]
const LOWER: [Vec3; 3] =
    // front and rear axle, ball
    [
        Vec3::new(150.0, 350.0, 190.0),
        Vec3::new(-170.0, 350.0, 200.0),
        Vec3::new(5.0, 725.0, 175.0),
    ];
const UPPER: [Vec3; 3] = [
    Vec3::new(110.0, 430.0, 470.0),
    Vec3::new(-130.0, 430.0, 455.0),
    Vec3::new(-20.0, 680.0, 500.0),
];
// at the rack, at the upright
const TIE_ROD: [Vec3; 2] = [Vec3::new(-140.0, 390.0, 255.0), Vec3::new(-125.0, 705.0, 252.0)];
const HUB: Vec3 = Vec3::new(0.0, 780.0, 320.0);
const RADIUS: f64 = 320.0; // of the wheel

/// To `a` within a second, to −a within two, and back, from the time `start` on.
fn to_and_fro(start: f64, a: f64) -> Law {
    let from_to = |from: f64, to: f64, time: f64| {
        (time, Law::constant(from) + Law::polynomial_345(to - from, time))
    };
    Law::sequence(start, [from_to(0.0, a, 1.0), from_to(a, -a, 2.0), from_to(-a, 0.0, 1.0)])
}

fn main() -> kin::Result<()> {
    // 1. The rack slides across. All frames stand at the origin, so that local points are the
    //    points of the drawing.
    let mut m = Mechanism::new("double wishbone suspension");
    m.units("mm", "s");
    let ground = m.ground();
    let rack = m.spatial("rack", SpatialPose::at(O))?;
    let middle = vec3(TIE_ROD[0].x, 0.0, TIE_ROD[0].z);
    m.add(
        "rack guide",
        spatial::prismatic(rack, ground, middle, middle, Vec3::y(), EulerParameters::identity()),
    )?;
    m.add("steering", drive_slide(rack, ground, middle, middle, Vec3::y(), to_and_fro(4.0, 35.0)))?;

    // 2. Each side: two wishbones on hinges, the upright on two balls, a tie rod without mass.
    let mut sides = Vec::new();
    for (name, side) in [("left", 1.0), ("right", -1.0)] {
        let at = |p: Vec3| vec3(p.x, side * p.y, p.z);
        let upright = m.spatial(&format!("{name} upright"), SpatialPose::at(O))?;
        let mut arms = Vec::new();
        for (which, [front, rear, ball]) in [("lower", LOWER.map(at)), ("upper", UPPER.map(at))] {
            let arm = m.spatial(&format!("{name} {which} wishbone"), SpatialPose::at(O))?;
            m.add(
                &format!("{name} {which} hinge"),
                spatial::revolute(
                    arm,
                    ground,
                    (front + rear) * 0.5,
                    (front + rear) * 0.5,
                    front - rear,
                    front - rear,
                ),
            )?;
            m.add(&format!("{name} {which} ball"), spatial::spherical(arm, upright, ball, ball))?;
            arms.push((arm, [front, rear, ball]));
        }
        let [inner, outer] = TIE_ROD.map(at);
        m.add(
            &format!("{name} tie rod"),
            spatial::distance(rack, upright, inner, outer, (outer - inner).norm()),
        )?;
        let travel = Law::constant(HUB.z) + to_and_fro(0.0, 60.0);
        m.add(&format!("{name} travel"), drive_point_along(upright, at(HUB), Vec3::z(), travel))?;
        sides.push((name, side, upright, at(HUB), arms));
    }

    // 3. Motion; camber and toe from the direction of the spindle, in degrees.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 8.0, 801))?;
    println!("{}", motion.summary());
    for &(name, side, upright, hub, _) in &sides {
        let wheel = motion.point(upright, hub)?;
        let spindle = motion.point(upright, hub + vec3(0.0, side, 0.0))?;
        let axes = spindle.r().iter().zip(wheel.r()).map(|(tip, r)| *tip - *r);
        let (camber, toe): (Vec<f64>, Vec<f64>) =
            axes.map(|s| (-s.z.asin().to_degrees(), s.x.atan2(side * s.y).to_degrees())).unzip();
        motion.add_output(&format!("{name} camber"), "°", camber)?;
        motion.add_output(&format!("{name} toe"), "°", toe)?;
        motion.add_point(&format!("{name} hub"), upright, hub)?;
    }
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 4. Curves over wheel travel, from the first four seconds.
    let output = |name: &str| {
        motion
            .outputs()
            .iter()
            .find(|output| output.name() == name)
            .map(Series::values)
            .unwrap_or_default()
    };
    let travel: Vec<f64> = output("left hub.z").iter().map(|z| z - HUB.z).collect();
    let curve = |name: &str| {
        travel.iter().zip(output(name)).take(401).map(|(x, y)| vec2(*x, *y)).collect::<Vec<_>>()
    };
    let camber = curve("left camber");
    let toe = curve("left toe");
    let range = |curve: &[Vec2]| {
        curve.iter().fold((f64::MAX, f64::MIN), |(low, high), p| (low.min(p.y), high.max(p.y)))
    };
    println!("over ±60 mm of travel: camber {:.2?}°, toe {:.2?}°", range(&camber), range(&toe));
    let steer = |side: &str| output(&format!("{side} toe"))[500];
    println!(
        "rack 35 mm to the left: left wheel {:.2}°, right wheel {:.2}°",
        steer("left"),
        steer("right")
    );
    let panel = |title: &str, label: &str, curve: &[Vec2]| {
        Panel::numbers(title, "wheel travel [mm]", &format!("{label} [°]")).path(label, curve)
    };
    Figure::new([panel("Camber", "camber", &camber), panel("Bump steer", "toe-in", &toe)])
        .save(format!("{OUT}/curves.svg"))?;

    // 5. Pictures: wishbones, uprights, wheels, the rack and the frame of the car are told.
    let mut scene =
        Scene::new(&system).seen_from(0.62, 0.32).color(rack, "#009e73").hide_joint("rack guide");
    let frame = [(LOWER[0], 1.0), (LOWER[1], 1.0), (LOWER[1], -1.0), (LOWER[0], -1.0)];
    scene =
        scene.outline(ground, Outline::polygon(frame.map(|(p, side)| vec3(p.x, side * p.y, p.z))));
    scene = scene.outline(
        rack,
        Outline::line(
            [-1.0, 1.0].map(|side| vec3(TIE_ROD[0].x, side * TIE_ROD[0].y, TIE_ROD[0].z)),
        ),
    );
    for (name, side, upright, hub, arms) in sides {
        let at = |p: Vec3| vec3(p.x, side * p.y, p.z);
        for (arm, [front, rear, ball]) in arms {
            scene = scene.outline(arm, Outline::polygon([front, ball, rear])).color(arm, "#0072b2");
        }
        let knuckle = [LOWER[2], UPPER[2], TIE_ROD[1]].map(at);
        let rim = |share: f64| {
            (0..48)
                .map(move |k| TAU * k as f64 / 48.0)
                .map(move |a| hub + vec3(a.cos(), 0.0, a.sin()) * (share * RADIUS))
        };
        scene = scene
            .outline(upright, Outline::polygon(knuckle))
            .add_outline(upright, Outline::polygon(rim(1.0)))
            .color(upright, "#d55e00");
        scene = scene.add_outline(upright, Outline::polygon(rim(0.62))).trace(
            &format!("{name} hub"),
            upright,
            hub,
        );
    }
    scene.pose(&motion, 1.0)?.save(format!("{OUT}/pose.svg"))?;
    scene.animated(&motion, 8.0)?.save(format!("{OUT}/animated.svg"))?;
    let series = |name: &str| motion.outputs().iter().find(|output| output.name() == name);
    let mut page = scene.page(&motion)?;
    for (title, what) in [("Camber", "camber"), ("Toe-in", "toe")] {
        let both = ["left", "right"]
            .into_iter()
            .filter_map(|side| Some((side, series(&format!("{side} {what}"))?)));
        page = page.chart(title, both);
    }
    page.save(format!("{OUT}/index.html"))
}
