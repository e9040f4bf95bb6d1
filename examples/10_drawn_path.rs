//! A two-link arm that follows a drawn path: inverse kinematics by a driver of two equations.
//! Lengths in m, angles in rad, time in s.
//!
//! What to see: nobody says how the joints are to turn. Fifteen points of a drawing become two
//! periodic splines of time, the pen at the end of the arm is driven along them, r_P = (f1(t),
//! f2(t)), and the solver finds the angles; their rates and accelerations, which motors would need,
//! come with them. Watch the elbow hurry at the tail of the fish.
//!
//! `cargo run --release --example 10_drawn_path`

use kin::law::Ends;
use kin::prelude::*;
use kin_view::{Figure, Panel, Scene};

const OUT: &str = "out/10_drawn_path";
const SECONDS: f64 = 6.0; // for the whole drawing

/// A fish, closed.      [m]
const DRAWING: [(f64, f64); 15] = [
    (0.30, 0.35),
    (0.36, 0.42),
    (0.45, 0.46),
    (0.55, 0.45),
    (0.63, 0.40),
    (0.69, 0.355),
    (0.76, 0.42),
    (0.77, 0.35),
    (0.76, 0.28),
    (0.69, 0.345),
    (0.63, 0.30),
    (0.55, 0.25),
    (0.45, 0.24),
    (0.36, 0.28),
    (0.30, 0.35),
];

fn main() -> kin::Result<()> {
    // 1. The drawing, evenly fast: the time of each point is its way along the straight lines
    //    between them.
    let mut t = vec![0.0];
    for pair in DRAWING.windows(2) {
        t.push(t[t.len() - 1] + (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1));
    }
    let whole = t[t.len() - 1];
    let spline = |pick: fn(&(f64, f64)) -> f64| {
        let table: Vec<(f64, f64)> =
            t.iter().zip(&DRAWING).map(|(t, p)| (SECONDS * t / whole, pick(p))).collect();
        Law::spline(&table, Ends::Periodic)
    };
    let x = spline(|p| p.0);
    let y = spline(|p| p.1);

    // 2. The arm: two links, two pins, and the pen.
    let mut m = Mechanism::new("arm that draws");
    let ground = m.ground();
    let upper = m.link("upper arm", 0.6)?;
    let fore = m.link("forearm", 0.5)?;
    m.add("shoulder", revolute(ground, upper, vec2(0.0, 0.0), upper.start()))?;
    m.add("elbow", revolute(upper, fore, upper.end(), fore.start()))?;
    m.add("pen", drive_point(fore, fore.end(), x, y))?;
    m.prefer(upper, deg(80.0)); // elbow up

    // 3. Motion: what the motors would have to do.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, SECONDS, 10_001))?;
    let shoulder = motion.coordinate(upper.theta())?;
    let elbow = motion.coordinate(fore.theta())?;
    let relative: Vec<f64> = elbow
        .value
        .values()
        .iter()
        .zip(shoulder.value.values())
        .map(|(fore, upper)| fore - upper)
        .collect();
    println!("{}", motion.summary());
    println!(
        "shoulder: at most {:.2} rad/s and {:.1} rad/s²",
        shoulder.rate.max(),
        shoulder.second_rate.max()
    );
    motion.add_point("pen", fore, fore.end())?;
    motion.add_point("elbow", upper, upper.end())?;
    motion.add_output("elbow angle", "rad", relative)?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 4. Pictures.
    let scene = Scene::new(&system).trace("pen", fore, fore.end());
    scene.sequence(&motion, 9)?.save(format!("{OUT}/sequence.svg"))?;
    scene.animated(&motion, SECONDS)?.save(format!("{OUT}/animated.svg"))?;
    let rates = Panel::over_time("Joints", "angular velocity")
        .series("shoulder", &shoulder.rate)
        .series("forearm", &elbow.rate);
    Figure::new([rates]).save(format!("{OUT}/rates.svg"))?;
    let page = scene
        .page(&motion)?
        .chart("Angles", [("shoulder", &shoulder.value), ("forearm", &elbow.value)]);
    let page =
        page.chart("Angular velocities", [("shoulder", &shoulder.rate), ("forearm", &elbow.rate)]);
    let page = page.chart(
        "Angular accelerations",
        [("shoulder", &shoulder.second_rate), ("forearm", &elbow.second_rate)],
    );
    page.save(format!("{OUT}/index.html"))
}
