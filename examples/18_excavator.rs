//! An excavator with three cylinders. Lengths in m, angles in rad, time in s.
//!
//! What to see: the machine digs, lifts and empties its bucket. The program gives the lengths
//! of the three cylinders only. Boom and stick follow by triangles, the bucket by the four-bar
//! linkage behind it. The velocity of the bucket's edge shows the three moves.
//!
//! `cargo run --release --example 18_excavator`

use kin::prelude::*;
use kin_view::{Figure, Outline, Panel, Scene};

const OUT: &str = "out/18_excavator";

/// Pins: on the machine, and on each body in its own frame, which stands at its lower pin with x to
/// the next one.      [m]
const MACHINE: [Vec2; 2] = [Vec2::new(0.0, 1.8), Vec2::new(0.55, 1.15)]; // of the boom, of its cylinder
// of the stick, of the boom's cylinder, of the stick's
const BOOM: [Vec2; 3] = [Vec2::new(5.4, 0.0), Vec2::new(2.35, 0.55), Vec2::new(2.6, 1.25)];
const STICK: [Vec2; 4] =
    // bucket, both cylinders, lever
    [Vec2::new(2.7, 0.0), Vec2::new(-0.75, 0.25), Vec2::new(-0.1, 0.6), Vec2::new(2.3, 0.05)];
const BUCKET: [Vec2; 2] = [Vec2::new(0.12, 0.38), Vec2::new(1.35, -0.25)]; // of the rod, and the edge
const LEVER: f64 = 0.55;
const ROD: f64 = 0.5;

/// The length of a cylinder: moves of three seconds each from one length to the next.
fn moves(lengths: [f64; 5]) -> Law {
    let three =
        |ends: &[f64]| (3.0, Law::constant(ends[0]) + Law::polynomial_345(ends[1] - ends[0], 3.0));
    Law::sequence(0.0, lengths.windows(2).map(three))
}

fn main() -> kin::Result<()> {
    // 1. Bodies, about where they stand at first.
    let mut m = Mechanism::new("excavator");
    let ground = m.ground();
    let boom = m.planar("boom", pose(0.0, 1.8, deg(35.0)))?;
    let stick = m.planar("stick", pose(4.4, 4.9, deg(-40.0)))?;
    let bucket = m.planar("bucket", pose(6.5, 3.2, deg(-40.0)))?;
    let lever = m.link("lever", LEVER)?;
    let rod = m.link("rod", ROD)?;
    m.set_pose(lever, pose(6.4, 3.6, deg(40.0)))?;
    m.set_pose(rod, pose(6.7, 3.5, deg(-60.0)))?;
    let origin = vec2(0.0, 0.0);

    // 2. Pins, and three cylinders.
    m.add("boom pin", revolute(ground, boom, MACHINE[0], origin))?;
    m.add("stick pin", revolute(boom, stick, BOOM[0], origin))?;
    m.add("bucket pin", revolute(stick, bucket, STICK[0], origin))?;
    m.add("lever pin", revolute(stick, lever, STICK[3], lever.start()))?;
    m.add("upper rod pin", revolute(lever, rod, lever.end(), rod.start()))?;
    m.add("lower rod pin", revolute(rod, bucket, rod.end(), BUCKET[0]))?;
    // lower the boom; pull the stick and curl the bucket; lift; stretch out and empty
    m.add(
        "boom cylinder",
        drive_distance(ground, boom, MACHINE[1], BOOM[1], moves([2.67, 2.27, 2.3, 2.7, 2.67])),
    )?;
    m.add(
        "stick cylinder",
        drive_distance(boom, stick, BOOM[2], STICK[1], moves([2.85, 2.85, 3.45, 3.45, 2.85])),
    )?;
    m.add(
        "bucket cylinder",
        drive_distance(stick, lever, STICK[2], lever.end(), moves([2.45, 2.45, 2.85, 2.9, 2.45])),
    )?;

    // 3. Motion.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 12.0, 1201))?;
    let edge = motion.point(bucket, BUCKET[1])?;
    let deepest = edge.r().iter().map(|p| p.y).fold(f64::MAX, f64::min);
    println!("{}", motion.summary());
    println!(
        "the edge digs {:.2} m deep and moves at {:.2} m/s at most",
        -deepest,
        edge.speed().max()
    );
    motion.add_point("edge", bucket, BUCKET[1])?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 4. Pictures: outlines of boom, stick and bucket in their frames, of the machine on the
    //    ground; cylinders are drawn by themselves.
    let at = |points: &[(f64, f64)]| points.iter().map(|(x, y)| vec2(*x, *y)).collect::<Vec<_>>();
    let shell = at(&[
        (-0.12, 0.3),
        (0.2, 0.5),
        (0.85, 0.32),
        (1.35, -0.25),
        (1.05, -0.62),
        (0.5, -0.78),
        (0.05, -0.5),
        (-0.15, -0.05),
    ]);
    let mut scene = Scene::new(&system)
        .outline(
            boom,
            Outline::polygon(at(&[
                (-0.15, -0.15),
                (2.4, 0.5),
                (5.45, -0.16),
                (5.5, 0.16),
                (2.75, 1.35),
                (2.2, 1.3),
                (-0.2, 0.2),
            ])),
        )
        .outline(
            stick,
            Outline::polygon(at(&[
                (-0.85, 0.15),
                (0.0, -0.2),
                (2.75, -0.14),
                (2.78, 0.14),
                (0.1, 0.7),
                (-0.2, 0.7),
                (-0.85, 0.35),
            ])),
        )
        .outline(bucket, Outline::polygon(shell))
        .outline(lever, Outline::line([lever.start(), lever.end()]))
        .outline(rod, Outline::line([rod.start(), rod.end()]))
        .color(lever, "#8c6239")
        .color(rod, "#8c6239")
        .color(boom, "#e69f00")
        .color(stick, "#e69f00")
        .color(bucket, "#8c6239");
    let tracks = at(&[(-3.3, 0.0), (0.9, 0.0), (1.15, 0.4), (0.9, 0.8), (-3.3, 0.8), (-3.55, 0.4)]);
    let house = at(&[
        (-3.2, 0.95),
        (0.75, 0.95),
        (0.75, 1.3),
        (0.25, 2.0),
        (-0.3, 2.0),
        (-0.3, 3.3),
        (-1.4, 3.3),
        (-1.6, 2.1),
        (-3.2, 2.1),
    ]);
    for outline in [
        Outline::polygon(tracks),
        Outline::polygon(house),
        Outline::line([vec2(-4.2, 0.0), vec2(9.2, 0.0)]),
    ] {
        scene = scene.outline(ground, outline);
    }
    let scene = scene.trace("edge", bucket, BUCKET[1]);
    scene.sequence(&motion, 5)?.save(format!("{OUT}/sequence.svg"))?;
    scene.pose(&motion, 6.0)?.save(format!("{OUT}/pose.svg"))?;
    scene.animated(&motion, 10.0)?.save(format!("{OUT}/animated.svg"))?;
    let angles = [boom, stick, bucket].map(|body| motion.coordinate(body.theta()).unwrap().value);
    let panel = Panel::over_time("Angles", "angle")
        .series("boom", &angles[0])
        .series("stick", &angles[1])
        .series("bucket", &angles[2]);
    Figure::new([panel]).save(format!("{OUT}/angles.svg"))?;
    let page = scene
        .page(&motion)?
        .chart("Angles", [("boom", &angles[0]), ("stick", &angles[1]), ("bucket", &angles[2])]);
    page.chart("Speed of the edge", [("edge", &edge.speed())]).save(format!("{OUT}/index.html"))
}
