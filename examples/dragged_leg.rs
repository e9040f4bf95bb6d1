//! Theo Jansen's leg with its motor released: its foot is dragged by hand. Lengths in m, angles in
//! rad.
//!
//! What to see: the foot follows the hand along its own curve, round the whole circuit and back.
//! The crank turns by itself, also past the places where a driver of the foot would be at a dead
//! centre.
//!
//! `cargo run --release --example dragged_leg`

use std::time::Instant;

use kin::data::Registry;
use kin::prelude::*;
use kin_view::Scene;

const OUT: &str = "out/dragged_leg";

fn main() -> kin::Result<()> {
    // 1. The mechanism of example 09, with its motor, and the foot in the frame of the shin.
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/mechanisms/09_jansen_leg.json");
    let system = Mechanism::read_json(file, &Registry::new())?.build()?;
    let circuit = system.circuit("motor", 361)?;
    let shin = circuit.motion().planar_named("shin").expect("a body of this name");
    let foot = vec2(-0.016208, -0.046242);
    let path = circuit.motion().point(shin, foot)?;

    // 2. The hand goes round beside the foot's curve, in 3600 small pulls.
    let mut leg = system.released(0.0)?;
    println!("free to move: {}", leg.freedoms().join(", "));
    let start = leg.coordinate("crank.theta").expect("a coordinate of this name");
    let begin = Instant::now();
    let mut farthest = 0.0_f64;
    for k in 0..3600 {
        let from = path.r()[k / 10];
        let to = path.r()[k / 10 + 1];
        let share = (k % 10) as f64 / 10.0;
        let hand = from + (to - from) * share + vec2(0.0, 1e-3);
        let reached = leg.drag(shin, foot, hand)?;
        farthest = farthest.max(reached.wishes[0].missed);
    }
    let each = begin.elapsed().as_secs_f64() / 3600.0;
    let turned = leg.coordinate("crank.theta").expect("a coordinate of this name") - start;
    println!("the hand is at most {:.2} mm from the foot", 1e3 * farthest);
    println!(
        "the crank has turned by {:.1}°; a pull takes {:.0} µs",
        turned.to_degrees(),
        1e6 * each
    );

    // 3. A picture of the leg where the hand has let it go.
    let scene = Scene::new(&system).trace("foot", shin, foot);
    scene.pose(&leg.motion(), 0.0)?.save(format!("{OUT}/dragged.svg"))?;
    Ok(())
}
