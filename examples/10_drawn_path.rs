//! A two-link arm that follows a drawn path: inverse kinematics by a driver of two equations. Lengths in m, angles in rad, time in s.
//!
//! What to see: nobody says how the joints are to turn. The pen at the end of the arm is driven along a heart, r_P = (f1(t), f2(t)), and the
//! solver finds the angles; their rates and accelerations, which motors would need, come with them. Watch the elbow hurry at the sharp tip.
//!
//! `cargo run --release --example 10_drawn_path`

use kin::prelude::*;
use kin_view::{Figure, Panel, Scene};

const OUT: &str = "out/10_drawn_path";

fn main() -> kin::Result<()> {
    // 1. The drawing, as sums of harmonics of one turn in six seconds: x = 12 sin s − 4 sin 3s, y = 13 cos s − 5 cos 2s − 2 cos 3s − cos 4s.
    let (omega, scale, middle) = (TAU / 6.0, 0.02, vec2(0.55, 0.35)); // rad/s, m, m
    let harmonic = |amplitude: f64, k: f64, phase: f64| Law::sine(scale * amplitude, k * omega, phase);
    let x = Law::constant(middle.x) + harmonic(12.0, 1.0, 0.0) + harmonic(-4.0, 3.0, 0.0);
    let cosine = |amplitude: f64, k: f64| harmonic(amplitude, k, 0.5 * PI);
    let y = Law::constant(middle.y) + cosine(13.0, 1.0) + cosine(-5.0, 2.0) + cosine(-2.0, 3.0) + cosine(-1.0, 4.0);

    // 2. The arm: two links, two pins, and the pen.
    let mut m = Mechanism::new("arm that draws a heart");
    let ground = m.ground();
    let upper = m.link("upper arm", 0.6)?;
    let fore = m.link("forearm", 0.5)?;
    m.add("shoulder", revolute(ground, upper, vec2(0.0, 0.0), upper.start()))?;
    m.add("elbow", revolute(upper, fore, upper.end(), fore.start()))?;
    m.add("pen", drive_point(fore, fore.end(), x.clone(), y.clone()))?;
    m.prefer(upper, deg(80.0)); // elbow up

    // 3. Motion: what the motors would have to do.
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 6.0, 1201))?;
    let (shoulder, elbow) = (motion.coordinate(upper.theta()), motion.coordinate(fore.theta()));
    let relative: Vec<f64> = elbow.value.values().iter().zip(shoulder.value.values()).map(|(fore, upper)| fore - upper).collect();
    println!("{}", motion.summary());
    println!("shoulder: at most {:.2} rad/s and {:.1} rad/s²", shoulder.rate.max(), shoulder.second_rate.max());
    motion.add_point("pen", fore, fore.end())?;
    motion.add_point("elbow", upper, upper.end())?;
    motion.add_output("elbow angle", "rad", relative)?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 4. Pictures.
    let scene = Scene::new(&system).trace("pen", fore, fore.end());
    scene.sequence(&motion, 9)?.save(format!("{OUT}/sequence.svg"))?;
    scene.animated(&motion, 6.0)?.save(format!("{OUT}/animated.svg"))?;
    let rates = Panel::over_time("Joints", "angular velocity").series("shoulder", &shoulder.rate).series("forearm", &elbow.rate);
    Figure::new([rates]).save(format!("{OUT}/rates.svg"))?;
    let page = scene.page(&motion)?.chart("Angles", [("shoulder", &shoulder.value), ("forearm", &elbow.value)]);
    let page = page.chart("Angular velocities", [("shoulder", &shoulder.rate), ("forearm", &elbow.rate)]);
    let page = page.chart("Angular accelerations", [("shoulder", &shoulder.second_rate), ("forearm", &elbow.second_rate)]);
    page.save(format!("{OUT}/index.html"))
}
