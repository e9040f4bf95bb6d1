//! The leg of Theo Jansen's beach animals, with his "holy numbers". Lengths in m, angles in rad,
//! time in s.
//!
//! What to see: one even turn of the crank makes a step. For half of the time the foot is on the
//! ground and runs almost straight and evenly; then it is lifted, thrown forward and set down
//! again. Seven bodies, twenty pins' equations, one motor.
//!
//! `cargo run --release --example 09_jansen_leg`

use kin::prelude::*;
use kin_view::{Outline, Scene};

const OUT: &str = "out/09_jansen_leg";

/// The point at distances `r_a` from A and `r_b` from B, to the left of the way from A to B.
fn apex(a: Vec2, b: Vec2, r_a: f64, r_b: f64) -> Vec2 {
    let d = b - a;
    let along = (d.norm_squared() + r_a * r_a - r_b * r_b) / (2.0 * d.norm_squared());
    a + d * along + d.perp() * (r_a * r_a / d.norm_squared() - along * along).sqrt()
}

fn main() -> kin::Result<()> {
    // 1. Jansen's lengths, in mm, and the points of the leg where the crank lies to the right, from
    //    circles about known points.
    let [a, b, c, d, e, f, g, h, i, j, k, l, m_] =
        [38.0, 41.5, 39.3, 40.1, 55.8, 39.4, 36.7, 65.7, 49.0, 50.0, 61.9, 7.8, 15.0]
            .map(|x| 1e-3 * x);
    let z = vec2(0.0, 0.0);
    let y = vec2(-a, -l);
    let x = vec2(m_, 0.0); // crank's axle, fixed pivot, crank pin
    let v = apex(y, x, b, j);
    let w = apex(y, v, d, e);
    let u = apex(x, y, k, c);
    let p = apex(u, w, g, f);
    let foot = apex(u, p, i, h);

    // 2. Bodies: five bars and two plates, whose frames stand at Y and at U.
    let mut m = Mechanism::new("Jansen's leg");
    let ground = m.ground();
    let crank = m.link_between("crank", z, x)?;
    let [upper_rod, lower_rod] = [m.link_between("j", x, v)?, m.link_between("k", x, u)?];
    let [rocker, tie] = [m.link_between("c", y, u)?, m.link_between("f", w, p)?];
    let hip = m.planar("hip", pose(y.x, y.y, 0.0))?;
    let shin = m.planar("shin", pose(u.x, u.y, 0.0))?;

    // 3. Pins: 20 equations, and the motor's.
    m.add("Z", revolute(ground, crank, z, crank.start()))?;
    m.add("X", revolute(crank, upper_rod, crank.end(), upper_rod.start()))?;
    m.add("X of k", revolute(crank, lower_rod, crank.end(), lower_rod.start()))?;
    m.add("Y", revolute(ground, hip, y, vec2(0.0, 0.0)))?;
    m.add("Y of c", revolute(ground, rocker, y, rocker.start()))?;
    m.add("V", revolute(upper_rod, hip, upper_rod.end(), v - y))?;
    m.add("W", revolute(tie, hip, tie.start(), w - y))?;
    m.add("U", revolute(lower_rod, rocker, lower_rod.end(), rocker.end()))?;
    m.add("U of shin", revolute(rocker, shin, rocker.end(), vec2(0.0, 0.0)))?;
    m.add("P", revolute(tie, shin, tie.end(), p - u))?;
    m.add("motor", drive_angle(crank, Law::ramp(-TAU)))?; // clockwise, one step a second

    // 4. Motion: how flat is the step?
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 1.0, 721))?;
    let path = motion.point(shin, foot - u)?;
    let (low, high) =
        path.r().iter().fold((f64::MAX, f64::MIN), |(low, high), p| (low.min(p.y), high.max(p.y)));
    let on_ground = path.r().iter().filter(|p| p.y < low + 0.1 * (high - low)).count() as f64
        / motion.len() as f64;
    println!("{}", motion.summary());
    println!(
        "the foot lifts by {:.1} mm and stays in the lowest tenth of that for {:.0} % of a turn",
        1e3 * (high - low),
        100.0 * on_ground
    );
    motion.add_point("foot", shin, foot - u)?;
    motion.add_point("X", crank, crank.end())?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 5. Pictures: the ground is told.
    let scene = Scene::new(&system).trace("foot", shin, foot - u);
    let scene = scene.outline(ground, Outline::line([vec2(-0.1, low), vec2(0.03, low)]));
    scene.sequence(&motion, 6)?.save(format!("{OUT}/sequence.svg"))?;
    scene.animated(&motion, 3.0)?.save(format!("{OUT}/animated.svg"))?;
    let [x, y, vx, vy, ..] = &path.components()[..] else { return Ok(()) };
    let page = scene
        .page(&motion)?
        .chart("Foot", [("x", x), ("y", y)])
        .chart("Velocity of the foot", [("x'", vx), ("y'", vy)]);
    page.save(format!("{OUT}/index.html"))
}
