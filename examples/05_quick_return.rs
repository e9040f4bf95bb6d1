//! A crank-shaper: a slotted lever that goes slowly one way and quickly back. Lengths in m, angles
//! in rad, time in s.
//!
//! What to see: the crank turns evenly and its pin slides in the slot of the lever. While the pin
//! is far from the lever's pivot the ram creeps to the left, cutting; when it passes near the pivot
//! the ram is thrown back. The path of the pin in the lever is the slot itself: nobody told the
//! page to draw it.
//!
//! `cargo run --release --example 05_quick_return`

use kin::prelude::*;
use kin_view::{Figure, Panel, Scene};

const OUT: &str = "out/05_quick_return";

fn main() -> kin::Result<()> {
    // 1. Geometry: crank about O, lever about C below it, ram on a line above.
    let r = 0.1;
    let depth = 0.25;
    let lever_length = 0.62;
    let height = 0.35; // m
    let c = vec2(0.0, -depth);
    let mut m = Mechanism::new("crank-shaper");
    let ground = m.ground();
    let crank = m.link_between("crank", vec2(0.0, 0.0), vec2(r, 0.0))?;
    let lever = m.link_between("lever", c, vec2(0.23, 0.32))?;
    let rod = m.link_between("rod", vec2(0.23, 0.32), vec2(0.42, height))?;
    let ram = m.planar("ram", pose(0.42, height, 0.0))?;
    let lever_end = lever.start() + vec2(lever_length, 0.0);

    // 2. Constraints: 12 equations for 12 coordinates.
    m.add("O", revolute(ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("C", revolute(ground, lever, c, lever.start()))?;
    m.add("slot", pin_in_slot(crank, lever, crank.end(), lever.start(), lever_end))?;
    m.add("D", revolute(lever, rod, lever_end, rod.start()))?;
    m.add("E", revolute(rod, ram, rod.end(), vec2(0.0, 0.0)))?;
    m.add("guide", prismatic(ram, ground, vec2(0.0, 0.0), vec2(0.0, height), vec2(0.0, 1.0), 0.0))?;
    m.add("motor", drive_angle(crank, Law::ramp(TAU)))?; // one turn a second

    // 3. Motion, and how uneven it is: the ram turns round where its rate is zero, found by solving
    //    the pose there.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 1.0, 721))?;
    let x = motion.coordinate(ram.x())?;
    let ram_turns = system.extremes(&motion, ram.x())?;
    let by_angles = (0.5 * PI + (r / depth).asin()) / (0.5 * PI - (r / depth).asin());
    println!("{}", motion.summary());
    if let Some(ratio) = ram_turns.time_ratio() {
        println!(
            "cutting takes {ratio:.9} times as long as the way back, by the angles {by_angles:.9}"
        );
    }
    println!(
        "ram: stroke {:.6} m, fastest {:.2} m/s one way and {:.2} m/s back",
        ram_turns.stroke(),
        x.rate.min(),
        x.rate.max()
    );
    let pin = system.measure(&motion, "slot.slide")?.value;
    println!(
        "the pin moves in the slot from {:.3} m to {:.3} m of {lever_length} m",
        pin.min(),
        pin.max()
    );
    motion.add_point("E", ram, vec2(0.0, 0.0))?;
    motion.add_point("D", lever, lever_end)?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 4. Pictures.
    let scene = Scene::new(&system).trace("D", lever, lever_end);
    scene.sequence(&motion, 8)?.save(format!("{OUT}/sequence.svg"))?;
    scene.animated(&motion, 3.0)?.save(format!("{OUT}/animated.svg"))?;
    scene.page(&motion)?.coordinate("Ram", &x).save(format!("{OUT}/index.html"))?;
    Figure::new([Panel::over_time("Ram", "velocity").series("ram", &x.rate)])
        .save(format!("{OUT}/ram.svg"))
}
