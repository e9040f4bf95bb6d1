//! The lower dead centre of a press, and how far the shop may be off. Lengths in mm, angles in rad,
//! time in s.
//!
//! What to see: the ram comes down to the same height within 0.15 mm whoever makes the parts, and
//! the bars say whose tolerance that is: the frame's and the rod's, hardly that of the offset,
//! though it is the widest. Of a thousand presses made at random nine in ten are within 0.06 mm.
//!
//! `cargo run --release --example 23_press_tolerance`

use kin::design::{Distribution, Sampling};
use kin::prelude::*;
use kin_view::{Bars, Outline, Scene};

const OUT: &str = "out/23_press_tolerance";

fn main() -> kin::Result<()> {
    // 1. Dimensions with the tolerances of their drawings, and the play of the pin between crank
    //    and rod.
    let mut m = Mechanism::new("eccentric press");
    m.units("mm", "s");
    let crank = m.dimension("crank", 40.0)?.tolerance(0.02).unit("mm");
    let rod = m.dimension("rod", 220.0)?.tolerance(0.05).unit("mm");
    let height =
        m.dimension("frame", 420.0)?.tolerance(0.05).unit("mm").distributed(Distribution::Uniform);
    let offset = m.dimension("offset", 6.0)?.tolerance(0.1).unit("mm");
    let gap = m.clearance("gap", 0.03)?;

    // 2. The shaft stands above the table, the ram goes up and down beside its axis.
    let shaft = m.link("crank", crank)?;
    let link = m.link("rod", rod)?;
    let ram = m.planar("ram", pose(offset, 420.0 - 220.0, 0.0))?;
    m.add("shaft", revolute(shaft, Ground, shaft.start(), (0.0, height)))?;
    m.add("pin", revolute(shaft, link, shaft.end() + gap, link.start()))?;
    m.add("wrist", revolute(link, ram, link.end(), (0.0, 0.0)))?;
    m.add("guide", prismatic(ram, Ground, (0.0, 0.0), (offset, 0.0), (1.0, 0.0), 0.0))?;
    m.add("motor", drive_angle(shaft, Law::ramp(TAU)))?;
    m.prefer(link, -1.5);

    // 3. A turn; its lowest position is the lower dead centre, wherever in time dimensions move
    //    that.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 1.0, 361))?;
    println!("{}", motion.summary());
    let extremes = system.extremes(&motion, ram.y())?;
    let lowest = system.tolerance_of(&motion, ram.y(), extremes.min())?;
    let stroke = system.tolerance_of(&motion, ram.y(), &extremes)?;
    println!("{lowest}\n{stroke}");
    let sampling = Sampling { count: 1000, seed: 1, ..Sampling::default() };
    println!("{}", system.samples(&motion, ram.y(), extremes.min(), &sampling)?);

    // 4. The table of the motion, the bars, the press as it moves.
    motion.add_point("wrist", ram, (0.0, 0.0))?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;
    Bars::new(&lowest, "s").save(format!("{OUT}/tolerance.svg"))?;
    let scene = Scene::new(&system)
        .outline(
            ram,
            Outline::polygon([
                vec2(-30.0, 0.0),
                vec2(30.0, 0.0),
                vec2(30.0, 60.0),
                vec2(-30.0, 60.0),
            ]),
        )
        .outline(Ground, Outline::line([vec2(-90.0, 130.0), vec2(90.0, 130.0)]));
    scene.animated(&motion, 2.0)?.save(format!("{OUT}/animated.svg"))?;
    let height = motion.coordinate(ram.y())?;
    scene
        .page(&motion)?
        .chart("Height of the ram", [("ram", &height.value)])
        .save(format!("{OUT}/index.html"))
}
