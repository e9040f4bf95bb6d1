//! A four-bar linkage with the path of a point of its coupler. Lengths in m, angles in rad, time in
//! s.
//!
//! What to see: the crank goes round evenly, the rocker swings; the coupler point P draws a closed
//! curve of its own, straight on one side and round on the other. Such coupler curves pull film,
//! stir dough and walk; other lengths and another P give another curve.
//!
//! `cargo run --release --example 04_four_bar`

use kin::prelude::*;
use kin_view::{Figure, Panel, Scene};

const OUT: &str = "out/04_four_bar";

fn main() -> kin::Result<()> {
    // 1. Geometry and constraints: four pins, and a motor that turns once a second.
    let mut m = Mechanism::new("four-bar");
    let ground = m.ground();
    let crank = m.link("crank", 1.0)?;
    let coupler = m.link("coupler", 3.5)?;
    let rocker = m.link("rocker", 3.0)?;
    m.add("O", revolute(ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
    m.add("C", revolute(ground, rocker, vec2(4.0, 0.0), rocker.start()))?;
    m.add("motor", drive_angle(crank, Law::ramp(TAU)))?;
    m.prefer(rocker, deg(100.0));
    // reads back by Mechanism::read_json, a user's own constraints too
    m.write_json(format!("{OUT}/mechanism.json"))?;

    // 2. Motion.
    let p = vec2(0.2, 1.4);
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 1.0, 361))?;
    motion.add_point("A", crank, crank.end())?;
    motion.add_point("P", coupler, p)?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;
    motion.write_json(format!("{OUT}/motion.json"))?;
    println!("{}", motion.summary());
    println!("the coupler point reaches {:.3} m/s", motion.point(coupler, p)?.speed().max());

    println!("{}", system.prove(&motion)?); // by interval bounds: nothing else moves like this

    // 3. Figures.
    let scene = Scene::new(&system).trace("P", coupler, p);
    scene.pose(&motion, 0.2)?.save(format!("{OUT}/pose.svg"))?;
    scene.sequence(&motion, 9)?.save(format!("{OUT}/sequence.svg"))?;
    scene.animated(&motion, 3.0)?.save(format!("{OUT}/animated.svg"))?;
    let angles = motion.coordinate(rocker.theta())?;
    let speed = motion.point(coupler, p)?.speed();
    scene
        .page(&motion)?
        .chart("Speed of P", [("P", &speed)])
        .coordinate("Rocker", &angles)
        .save(format!("{OUT}/index.html"))?;
    Figure::of_coordinate("Rocker", &angles).save(format!("{OUT}/rocker.svg"))?;
    let condition = Panel::log_over_time("How well C_q can be solved", "condition number")
        .series("κ", &system.condition(&motion)?);
    Figure::new([condition]).save(format!("{OUT}/condition.svg"))
}
