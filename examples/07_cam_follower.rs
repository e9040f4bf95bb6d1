//! A cam from a table, with a knife-edge follower. Lengths in m, angles in rad, time in s.
//!
//! What to see: the table has the lift at every fifteen degrees, and a periodic cubic spline goes
//! through it. The follower rests, rises, rests and falls as the table says; its velocity is
//! smooth, its acceleration only continuous. The outline of the cam on the page is not drawn by the
//! program: it is the path of the follower's tip as the cam sees it.
//!
//! `cargo run --release --example 07_cam_follower`

use kin::law::Ends;
use kin::prelude::*;
use kin_view::{Figure, Outline, Panel, Scene};

const OUT: &str = "out/07_cam_follower";

/// Lift in mm at 0°, 15°, …, 345°: at rest, a rise of 20 mm within 105°, at rest, and back within
/// 105°.
const LIFT: [f64; 24] = [
    0.0, 0.0, 0.0, 0.0, 0.7, 3.2, 7.6, 12.4, 16.8, 19.3, 20.0, 20.0, 20.0, 20.0, 19.3, 16.8, 12.4,
    7.6, 3.2, 0.7, 0.0, 0.0, 0.0, 0.0,
];
const BASE: f64 = 0.04; // m: radius of the cam where the follower rests

fn main() -> kin::Result<()> {
    // 1. The profile: distance of the edge from the axle at each angle of the cam; the last entry
    //    is the first one again.
    let table: Vec<(f64, f64)> =
        (0..=24).map(|k| (deg(15.0 * k as f64), BASE + 1e-3 * LIFT[k % 24])).collect();
    let profile = Law::spline(&table, Ends::Periodic);

    // 2. Cam and follower: 6 equations for 6 coordinates. The tip stands over the axle.
    let mut m = Mechanism::new("cam and follower");
    let ground = m.ground();
    let cam = m.planar("cam", pose(0.0, 0.0, 0.0))?;
    let follower = m.planar("follower", pose(0.0, BASE, 0.0))?;
    let tip = vec2(0.0, 0.0);
    m.add("axle", revolute(ground, cam, vec2(0.0, 0.0), vec2(0.0, 0.0)))?;
    m.add("guide", prismatic(follower, ground, tip, vec2(0.0, 0.12), vec2(1.0, 0.0), 0.0))?;
    m.add("edge", cam_knife_edge(cam, follower, tip, profile))?;
    m.add("motor", drive_angle(cam, Law::linear(deg(90.0), -PI)))?; // clockwise, a turn in two seconds

    // 3. Motion: the lift at the entries of the table.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 2.0, 961))?;
    let lift = motion.coordinate(follower.y())?;
    let off = LIFT
        .iter()
        .enumerate()
        .map(|(k, mm)| (lift.value.values()[40 * k] - BASE - 1e-3 * mm).abs())
        .fold(0.0, f64::max);
    println!("{}", motion.summary());
    println!(
        "lift {:.4} m, at the table's angles within {off:.0e} m of it",
        lift.value.max() - BASE
    );
    println!("follower: at most {:.3} m/s and {:.2} m/s²", lift.rate.max(), lift.second_rate.max());
    motion.add_point("tip", follower, tip)?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 4. Pictures: the follower is told to be a pointed rod.
    let rod = [
        vec2(0.0, 0.0),
        vec2(0.006, 0.015),
        vec2(0.006, 0.1),
        vec2(-0.006, 0.1),
        vec2(-0.006, 0.015),
    ];
    let scene = Scene::new(&system).outline(follower, Outline::polygon(rod));
    let scene = [-0.009, 0.009].into_iter().fold(scene, |scene, x| {
        scene.outline(ground, Outline::line([vec2(x, 0.095), vec2(x, 0.125)]))
    });
    let scene = scene.trace("tip", follower, tip).hide_joint("guide");
    scene.pose(&motion, 0.6)?.save(format!("{OUT}/pose.svg"))?;
    scene.animated(&motion, 4.0)?.save(format!("{OUT}/animated.svg"))?;
    Figure::new([
        Panel::over_time("Follower", "acceleration").series("follower", &lift.second_rate)
    ])
    .save(format!("{OUT}/acceleration.svg"))?;
    scene.page(&motion)?.coordinate("Follower", &lift).save(format!("{OUT}/index.html"))
}
