//! A cam with a roller on a lever, from a table. Lengths in mm, angles in rad, time in s.
//!
//! What to see: the table has the radius of the cam's edge at every fifteen degrees, as it is
//! measured, and a periodic spline goes through it. The roller stays on that edge wherever it
//! touches it, on the flanks beside the line to the axle. Cam and roller are not told to the
//! picture: the joint knows both.
//!
//! `cargo run --release --example 21_cam_with_roller`

use kin::law::Ends;
use kin::prelude::*;
use kin_view::{Figure, Outline, Panel, Scene};

const OUT: &str = "out/21_cam_with_roller";

/// Radius of the edge at 0°, 15°, …, 345°, in mm.
const EDGE: [f64; 24] = [
    40.0, 40.0, 40.3, 42.1, 45.9, 50.8, 55.2, 58.4, 59.8, 60.0, 60.0, 59.6, 57.9, 54.8, 51.2, 47.8,
    44.9, 42.7, 41.2, 40.4, 40.1, 40.0, 40.0, 40.0,
];
const ROLLER: f64 = 12.0; // its radius
const LEVER: f64 = 95.0; // from its pivot to the roller's axle
const PIVOT: Vec2 = Vec2::new(-90.0, 62.0); // from the cam's axle

fn main() -> kin::Result<()> {
    // 1. The edge as a law of the angle on the cam; the last entry is the first one again.
    let table: Vec<(f64, f64)> = (0..=24).map(|k| (deg(15.0 * k as f64), EDGE[k % 24])).collect();
    let edge = Law::spline(&table, Ends::Periodic);

    // 2. Cam, lever and roller: 7 equations for 7 coordinates, the last of which is where on the
    //    cam the roller touches it.
    let mut m = Mechanism::new("cam with a roller");
    m.units("mm", "s");
    let ground = m.ground();
    let cam = m.planar("cam", pose(0.0, 0.0, 0.0))?;
    let lever = m.link("lever", LEVER)?;
    m.set_pose(lever, pose(PIVOT.x + 0.5 * LEVER, PIVOT.y - 6.0, 0.0))?;
    let contact = m.angle("contact", deg(90.0))?;
    m.add("axle", revolute(ground, cam, vec2(0.0, 0.0), vec2(0.0, 0.0)))?;
    m.add("pivot", revolute(ground, lever, PIVOT, lever.start()))?;
    m.add("roller", cam_roller(cam, lever, contact, lever.end(), ROLLER, edge.clone()))?;
    m.add("motor", drive_angle(cam, Law::ramp(-PI)))?; // clockwise, a turn in two seconds

    // 3. Motion.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 2.0, 961))?;
    let swing = motion.coordinate(lever.theta())?;
    let touch = motion.coordinate(contact)?;
    // How far the normal of contact is from the way of the roller's middle: the pressure angle.
    let pressure: Vec<f64> = (0..motion.len())
        .map(|k| {
            let phi = touch.value.values()[k];
            let theta = swing.value.values()[k];
            let normal = phi - edge.slope(phi).atan2(edge.at(phi)) + motion.q(k)[2];
            let way = theta + 0.5 * PI;
            (normal - way).sin().asin()
        })
        .collect();
    motion.add_output("pressure angle", "rad", pressure)?;
    println!("{}", motion.summary());
    println!("the lever swings by {:.2}°", (swing.value.max() - swing.value.min()).to_degrees());
    let Some(pressure) = motion.outputs().last().cloned() else { return Ok(()) };
    println!(
        "pressure angle from {:.1}° to {:.1}°",
        pressure.min().to_degrees(),
        pressure.max().to_degrees()
    );
    motion.add_point("roller", lever, lever.end())?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 4. Pictures: what the joints know is enough; the bore of the cam is added.
    let bore = (0..=60)
        .map(|k| deg(110.0 + 320.0 / 60.0 * f64::from(k)))
        .map(|a| vec2(a.cos(), a.sin()) * 9.0);
    let keyway = bore.chain([vec2(3.08, 12.0), vec2(-3.08, 12.0)]);
    let scene = Scene::new(&system).add_outline(cam, Outline::polygon(keyway).hollow());
    let scene = scene.trace("roller", lever, lever.end());
    scene.pose(&motion, 0.55)?.save(format!("{OUT}/pose.svg"))?;
    scene.animated(&motion, 4.0)?.save(format!("{OUT}/animated.svg"))?;
    let panel = |title: &str, label: &str, series: &Series| {
        Panel::over_time(title, label).series("lever", series)
    };
    let panels = [
        panel("Lever", "angular acceleration", &swing.second_rate),
        panel("Pressure angle", "angle", &pressure),
    ];
    Figure::new(panels).save(format!("{OUT}/lever.svg"))?;
    let page = scene.page(&motion)?.chart("Pressure angle", [("pressure angle", &pressure)]);
    page.coordinate("Lever", &swing).save(format!("{OUT}/index.html"))
}
