//! The lecture's two-link manipulator: three planar bodies, 9 coordinates, 9 equations. Lengths in
//! m, angles in rad, time in s.
//!
//! What to see: both links turn evenly, the second three times for two turns of the first, and the
//! end effector draws a curve with loops that would close after 8π s, 25.1 s. The ground is a body
//! too, as in the lecture, held by three equations; since it stands still it is drawn as ground.
//!
//! `cargo run --release --example 02_two_link_manipulator`

use kin::prelude::*;
use kin_view::{Figure, Panel, Scene};

const OUT: &str = "out/02_two_link_manipulator";

fn main() -> kin::Result<()> {
    // 1. Geometry: body 1 is the ground, as a body; links 2 and 3 have their frames at the middle.
    let l2 = 0.2;
    let l3 = 0.35; // m
    let mut m = Mechanism::new("two-link manipulator");
    let body1 = m.planar("body 1", pose(0.0, 0.0, 0.0))?;
    let link2 = m.link("link 2", l2)?;
    let link3 = m.link("link 3", l3)?;

    // 2. Constraints: 3 + 2 + 2 equations.
    m.add("ground", fixed(body1, vec2(0.0, 0.0), 0.0))?;
    m.add("O", revolute(body1, link2, vec2(0.0, 0.0), link2.start()))?;
    m.add("A", revolute(link2, link3, link2.end(), link3.start()))?;

    // 3. Motion: θ2 = θ20 + ω2 t and θ3 = θ30 + ω3 t close the system.
    m.add("motor 2", drive_angle(link2, Law::linear(PI / 6.0, 0.5)))?; // rad, rad/s
    m.add("motor 3", drive_angle(link3, Law::linear(PI / 12.0, 0.75)))?;
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 24.0, 2401))?;

    // 4. Results: the end effector E is the free end of link 3.
    let e = motion.point(link3, link3.end())?;
    let speed = e.speed();
    let acceleration = e.acceleration_magnitude();
    println!("{}", motion.summary());
    println!(
        "end effector   max speed {:.4} m/s at {:.2} s    max acceleration {:.4} m/s² at {:.2} s",
        speed.max(),
        speed.at_max(),
        acceleration.max(),
        acceleration.at_max()
    );
    motion.add_point("end effector", link3, link3.end())?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 5. Figures: the lecture's.
    let r2 = motion.point(link2, vec2(0.0, 0.0))?;
    let r3 = motion.point(link3, vec2(0.0, 0.0))?;
    let origin = |title, link: Link| -> kin::Result<Panel> {
        let x = motion.coordinate(link.x())?;
        let y = motion.coordinate(link.y())?;
        Ok(Panel::over_time(title, "position").series("R_x", &x.value).series("R_y", &y.value))
    };
    let origins = vec![origin("Origin of link 2", link2)?, origin("Origin of link 3", link3)?];
    Figure::new(origins).save(format!("{OUT}/origins.svg"))?;

    let mut paths = Panel::plane("Paths, and the arm every 4 s");
    let elbow = motion.point(link3, link3.start())?;
    for k in (0..motion.len()).step_by(400) {
        paths = paths.sketch(&[vec2(0.0, 0.0), elbow.r()[k], e.r()[k]]);
    }
    let paths = paths
        .path("origin of link 2", r2.r())
        .path("origin of link 3", r3.r())
        .path("end effector", e.r());
    Figure::new(vec![paths]).save(format!("{OUT}/paths.svg"))?;

    let components = e.components(); // x, y, x', y', x'', y''
    let two = |title, quantity, k: usize| {
        vec![
            Panel::over_time(title, quantity)
                .series("along x", &components[k])
                .series("along y", &components[k + 1]),
        ]
    };
    Figure::new(two("Velocity of the end effector", "velocity", 2))
        .save(format!("{OUT}/velocities.svg"))?;
    Figure::new(two("Acceleration of the end effector", "acceleration", 4))
        .save(format!("{OUT}/accelerations.svg"))?;
    let scene = Scene::new(&system).trace("end effector", link3, link3.end());
    scene.animated(&motion, 12.0)?.save(format!("{OUT}/animated.svg"))?;
    let page = scene.page(&motion)?.chart("Speed of the end effector", [("speed", &speed)]);
    page.chart("Acceleration of the end effector", [("acceleration", &acceleration)])
        .save(format!("{OUT}/index.html"))?;
    println!(
        "wrote {OUT}/: motion.csv, index.html, animated.svg, origins.svg, paths.svg, velocities.svg, accelerations.svg"
    );
    Ok(())
}
