//! Peaucellier's linkage: seven bars that draw a straight line. Lengths in m, angles in rad, time
//! in s.
//!
//! What to see: every point of this linkage goes on a circle or a bent curve, but D goes straight
//! up and down. The bars make D the inverse of C in a circle about O; C runs on a circle through O,
//! and the inverse of such a circle is a line. In 1864 it was the first exact one.
//!
//! `cargo run --release --example 08_peaucellier`

use kin::prelude::*;
use kin_view::{Figure, Panel, Scene};

const OUT: &str = "out/08_peaucellier";

fn main() -> kin::Result<()> {
    // 1. Geometry at mid-stroke: O, C and D in line, the rhombus A C B D upright.
    let arm = 0.5;
    let side = 0.2;
    let crank = 0.17_f64; // m
    let c = vec2(2.0 * crank, 0.0);
    let d = vec2((arm * arm - side * side) / c.x, 0.0); // OC · OD = arm² − side²
    let middle = 0.5 * (c.x + d.x);
    let half = (arm * arm - middle * middle).sqrt();
    let o = vec2(0.0, 0.0);
    let q = vec2(crank, 0.0);
    let a = vec2(middle, half);
    let b = vec2(middle, -half);

    // 2. Bars between these points, pins where they meet: 21 equations for 21 coordinates.
    let mut m = Mechanism::new("Peaucellier's linkage");
    let ground = m.ground();
    let qc = m.link_between("crank", q, c)?;
    let [oa, ob] = [m.link_between("OA", o, a)?, m.link_between("OB", o, b)?];
    let [ac, bc] = [m.link_between("AC", a, c)?, m.link_between("BC", b, c)?];
    let [ad, bd] = [m.link_between("AD", a, d)?, m.link_between("BD", b, d)?];
    m.add("Q", revolute(ground, qc, q, qc.start()))?;
    m.add("O", revolute(ground, oa, o, oa.start()))?;
    m.add("O of OB", revolute(ground, ob, o, ob.start()))?;
    m.add("A", revolute(oa, ac, oa.end(), ac.start()))?;
    m.add("A of AD", revolute(oa, ad, oa.end(), ad.start()))?;
    m.add("B", revolute(ob, bc, ob.end(), bc.start()))?;
    m.add("B of BD", revolute(ob, bd, ob.end(), bd.start()))?;
    m.add("C", revolute(qc, ac, qc.end(), ac.end()))?;
    m.add("C of BC", revolute(qc, bc, qc.end(), bc.end()))?;
    m.add("D", revolute(ad, bd, ad.end(), bd.end()))?;
    m.add("motor", drive_angle(qc, Law::sine(0.8, PI, 0.0)))?; // ±46°, two seconds a swing

    // 3. Motion: how straight is it?
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 2.0, 801))?;
    let drawn = motion.point(ad, ad.end())?;
    let off = drawn.r().iter().map(|p| (p.x - d.x).abs()).fold(0.0, f64::max);
    let height = drawn.r().iter().map(|p| p.y).fold(0.0, f64::max);
    println!("{}", motion.summary());
    println!("D goes {:.3} m up and down and leaves its line by {off:.0e} m at most", 2.0 * height);
    motion.add_point("D", ad, ad.end())?;
    motion.add_point("C", qc, qc.end())?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 4. Pictures.
    let scene = Scene::new(&system).trace("D", ad, ad.end()).trace("C", qc, qc.end());
    scene.sequence(&motion, 5)?.save(format!("{OUT}/sequence.svg"))?;
    scene.animated(&motion, 4.0)?.save(format!("{OUT}/animated.svg"))?;
    let [x, y, vx, vy, ..] = &drawn.components()[..] else { return Ok(()) };
    let condition = system.condition(&motion)?;
    Figure::new([Panel::log_over_time("Condition of C_q", "κ").series("κ", &condition)])
        .save(format!("{OUT}/condition.svg"))?;
    let page = scene
        .page(&motion)?
        .chart("Position of D", [("x", x), ("y", y)])
        .chart("Velocity of D", [("x'", vx), ("y'", vy)]);
    page.chart("Condition number of C_q", [("κ", &condition)]).save(format!("{OUT}/index.html"))
}
