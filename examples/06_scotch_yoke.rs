//! A Scotch yoke: a turning crank becomes a pure sine. Lengths in m, angles in rad, time in s.
//!
//! What to see: the pin of the crank slides up and down in the yoke, the yoke slides sideways, and
//! its position is the cosine of the crank's angle exactly; a slider-crank, with its rod of finite
//! length, only comes near to that. The charts are sine, cosine and sine.
//!
//! `cargo run --release --example 06_scotch_yoke`

use kin::prelude::*;
use kin_view::{Outline, Scene};

const OUT: &str = "out/06_scotch_yoke";

fn main() -> kin::Result<()> {
    // 1. Geometry and constraints: 6 equations for 6 coordinates.
    let r = 0.1;
    let slot = 0.13;
    let rod = 0.3; // m
    let mut m = Mechanism::new("Scotch yoke");
    let ground = m.ground();
    let crank = m.link("crank", r)?;
    let yoke = m.planar("yoke", pose(r, 0.0, 0.0))?;
    m.add("O", revolute(ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("pin", pin_in_slot(crank, yoke, crank.end(), vec2(0.0, -slot), vec2(0.0, slot)))?;
    m.add("guide", prismatic(yoke, ground, vec2(rod, 0.0), vec2(rod, 0.0), vec2(0.0, 1.0), 0.0))?;
    m.add("motor", drive_angle(crank, Law::ramp(TAU)))?; // one turn a second

    // 2. Motion, beside the formula.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 2.0, 721))?;
    let x = motion.coordinate(yoke.x())?;
    let off = motion
        .times()
        .iter()
        .zip(x.value.values())
        .map(|(t, x)| (x - r * (TAU * t).cos()).abs())
        .fold(0.0, f64::max);
    println!("{}", motion.summary());
    println!("yoke: at most {off:.0e} m from {r} cos(2π t)");
    motion.add_point("A", crank, crank.end())?;
    motion.add_point("yoke", yoke, vec2(rod, 0.0))?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 3. Pictures: the yoke is told to look like one.
    let frame = [
        vec2(-0.03, -slot - 0.02),
        vec2(0.03, -slot - 0.02),
        vec2(0.03, slot + 0.02),
        vec2(-0.03, slot + 0.02),
    ];
    let scene = Scene::new(&system)
        .outline(yoke, Outline::polygon(frame))
        .outline(yoke, Outline::line([vec2(0.03, 0.0), vec2(rod, 0.0)]));
    let scene = scene.trace("yoke", yoke, vec2(rod, 0.0));
    scene.sequence(&motion, 5)?.save(format!("{OUT}/sequence.svg"))?;
    scene.animated(&motion, 4.0)?.save(format!("{OUT}/animated.svg"))?;
    scene.page(&motion)?.coordinate("Yoke", &x).save(format!("{OUT}/index.html"))
}
