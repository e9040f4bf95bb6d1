//! A Stewart platform: six legs of changing length carry a plate. Lengths in m, angles in rad, time
//! in s.
//!
//! What to see: each leg follows a sine of its own, a sixth of a turn after its neighbour, and the
//! plate rolls, pitches and rises. Where the plate stands is not in the program: six lengths decide
//! it, and the solver finds it (the forward problem, which has no formula). The condition number
//! tells how far the plate is from a pose that the legs cannot hold. Drag the picture to go round
//! it.
//!
//! `cargo run --release --example 13_stewart_platform`

use kin::joints::drivers::spatial::drive_distance;
use kin::prelude::*;
use kin_view::{Figure, Outline, Panel, Scene};

const OUT: &str = "out/13_stewart_platform";

/// Six points on a circle in pairs: `spread` on either side of each third of a turn, which begin at
/// `first`.
fn hexagon(radius: f64, first: f64, spread: f64) -> Vec<Vec3> {
    let angle =
        |k: usize| first + TAU / 3.0 * (k / 2) as f64 + if k % 2 == 1 { spread } else { -spread };
    (0..6).map(angle).map(|a| vec3(radius * a.cos(), radius * a.sin(), 0.0)).collect()
}

fn main() -> kin::Result<()> {
    // 1. Geometry: feet on the ground in pairs, heads on the plate in pairs between them.
    let height = 0.8; // m
    let feet = hexagon(0.6, deg(60.0), deg(12.0));
    let heads = hexagon(0.35, 0.0, deg(12.0));
    let mut m = Mechanism::new("Stewart platform");
    let ground = m.ground();
    let plate = m.spatial("plate", SpatialPose::at(vec3(0.0, 0.0, height)))?;

    // 2. Constraints: six legs, one equation each; heads go to the next foot, counted round from
    //    the first.
    for k in 0..6 {
        let foot = feet[(k + 5) % 6];
        let head = heads[k];
        let length = (head + vec3(0.0, 0.0, height) - foot).norm();
        // four seconds a wave
        let law = Law::constant(length) + Law::sine(0.09, TAU / 4.0, TAU / 6.0 * k as f64);
        m.add(&format!("leg {}", k + 1), drive_distance(plate, ground, head, foot, law))?;
    }

    // 3. Motion.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 8.0, 1601))?;
    let centre = motion.point(plate, vec3(0.0, 0.0, 0.0))?;
    let condition = system.condition(&motion)?;
    let tilt: Vec<f64> = motion
        .point(plate, Vec3::z())?
        .r()
        .iter()
        .zip(centre.r())
        .map(|(tip, r)| (tip.z - r.z).clamp(-1.0, 1.0).acos())
        .collect();
    println!("{}", motion.summary());
    motion.add_point("centre", plate, vec3(0.0, 0.0, 0.0))?;
    motion.add_point("head", plate, heads[0])?;
    motion.add_output("tilt", "rad", tilt)?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;
    let Some(tilt) = motion.outputs().last() else { return Ok(()) };
    println!(
        "the plate tilts by up to {:.1}°, condition number up to {:.0}",
        tilt.max().to_degrees(),
        condition.max()
    );

    // 4. Pictures: the plate's frame stands at its middle, the ground is told to be a plate too.
    let scene = Scene::new(&system)
        .trace("centre", plate, vec3(0.0, 0.0, 0.0))
        .trace("head", plate, heads[0]);
    let scene = scene.outline(ground, Outline::polygon(feet)).seen_from(-0.8, 0.45);
    scene.sequence(&motion, 4)?.save(format!("{OUT}/sequence.svg"))?;
    scene.animated(&motion, 8.0)?.save(format!("{OUT}/animated.svg"))?;
    let components = centre.components();
    Figure::new([Panel::over_time("Tilt of the plate", "angle").series("tilt", tilt)])
        .save(format!("{OUT}/tilt.svg"))?;
    let page = scene
        .page(&motion)?
        .chart("Centre", [("x", &components[0]), ("y", &components[1]), ("z", &components[2])]);
    page.chart("Tilt", [("tilt", tilt)])
        .chart("Condition number of C_q", [("κ", &condition)])
        .save(format!("{OUT}/index.html"))
}
