//! The torques of an arm that lifts a tool. Lengths in m, angles in rad, time in s, forces in N,
//! torques in N m.
//!
//! What to see: the arm swings from hanging low to reaching out and back. The shoulder carries both
//! links and the tool, so it works hardest where the arm is stretched out level, though nothing
//! moves fast there; the elbow's torque changes sign where the forearm begins to be braked.
//! Lagrange's equations, by hand, give the same torques to the last digits.
//!
//! `cargo run --release --example 25_arm_torque`

use kin::Load;
use kin::loads::Solid;
use kin::prelude::*;
use kin_view::{Figure, Panel, Scene};

const OUT: &str = "out/25_arm_torque";

const G: f64 = 9.81; // m/s²
const LENGTHS: [f64; 2] = [0.45, 0.35]; // m
const TOOL: f64 = 30.0; // N, the weight of what the arm carries at its end

/// An arm with its bodies: the links are bars of aluminium, the upper one has a gear box at the
/// elbow.
pub fn arm() -> kin::Result<(Mechanism, [Link; 2], [Solid; 2])> {
    let mut m = Mechanism::new("arm with a tool");
    let links = [m.link("upper arm", LENGTHS[0])?, m.link("forearm", LENGTHS[1])?];
    let [upper, fore] = links;
    m.add("shoulder", revolute(m.ground(), upper, vec2(0.0, 0.0), upper.start()))?;
    m.add("elbow", revolute(upper, fore, upper.end(), fore.start()))?;
    // rise from −70° to 20° in two seconds, bend the elbow meanwhile; a rest; back
    let rise = |from: f64, by: f64| {
        let parts = [
            (2.0, Law::constant(from) + Law::polynomial_4567(by, 2.0)),
            (0.5, Law::constant(from + by)),
            (1.5, Law::constant(from + by) + Law::polynomial_4567(-by, 1.5)),
        ];
        Law::sequence(0.0, parts)
    };
    m.add("shoulder motor", drive_angle(upper, rise(deg(-70.0), deg(90.0))))?;
    m.add("elbow motor", drive_relative_angle(fore, upper, rise(deg(40.0), deg(-55.0))))?;

    let gear_box = Solid::disc(0.05, 0.06, Solid::STEEL).at((LENGTHS[0] / 2.0, 0.0, 0.0));
    let solids = [
        Solid::bar(LENGTHS[0], 0.06, 0.04, Solid::ALUMINIUM).and(gear_box),
        Solid::bar(LENGTHS[1], 0.04, 0.03, Solid::ALUMINIUM),
    ];
    m.solid(upper, solids[0])?;
    m.solid(fore, solids[1])?;
    m.gravity(vec2(0.0, -G));
    m.load("tool", Load::force(fore, fore.end(), vec2(0.0, -TOOL)))?;
    Ok((m, links, solids))
}

/// Both torques at one time by Lagrange's equations: θ of the upper arm, φ of the forearm in it,
/// with their first and second rates.
pub fn lagrange([upper, fore]: [Solid; 2], theta: [f64; 3], phi: [f64; 3]) -> [f64; 2] {
    // Distances of the centres from shoulder and elbow; frames of links are at their middles.
    let l1 = LENGTHS[0];
    let l2 = LENGTHS[1];
    let c1 = 0.5 * l1 + upper.centre.x;
    let c2 = 0.5 * l2 + fore.centre.x;
    let j1 = upper.inertia.m33;
    let j2 = fore.inertia.m33;
    let m1 = upper.mass;
    let m2 = fore.mass;
    let (sin, cos) = phi[0].sin_cos();
    let coupling = m2 * l1 * c2;
    let m11 = j1 + j2 + m1 * c1 * c1 + m2 * (l1 * l1 + c2 * c2) + 2.0 * coupling * cos;
    let m12 = j2 + m2 * c2 * c2 + coupling * cos;
    let m22 = j2 + m2 * c2 * c2;
    let fore_weight = (m2 * G * c2 + TOOL * l2) * (theta[0] + phi[0]).cos();
    let upper_weight = (m1 * G * c1 + m2 * G * l1 + TOOL * l1) * theta[0].cos();
    [
        m11 * theta[2] + m12 * phi[2]
            - coupling * sin * (2.0 * theta[1] * phi[1] + phi[1] * phi[1])
            + upper_weight
            + fore_weight,
        m12 * theta[2] + m22 * phi[2] + coupling * sin * theta[1] * theta[1] + fore_weight,
    ]
}

/// The largest difference of torques over time from those by hand.   [N m]
pub fn off(
    motion: &Motion,
    [upper, fore]: [Link; 2],
    solids: [Solid; 2],
    torques: [&Series; 2],
) -> f64 {
    let rates =
        |body: Link| motion.coordinate(body.theta()).map(|q| [q.value, q.rate, q.second_rate]);
    let (Ok(theta), Ok(both)) = (rates(upper), rates(fore)) else { return f64::NAN };
    let at = |k: usize| {
        let theta: [f64; 3] = std::array::from_fn(|order| theta[order].values()[k]);
        let phi = std::array::from_fn(|order| both[order].values()[k] - theta[order]);
        let [shoulder, elbow] = lagrange(solids, theta, phi);
        (torques[0].values()[k] - shoulder).abs().max((torques[1].values()[k] - elbow).abs())
    };
    (0..motion.len())
        .map(at)
        .fold(0.0, |worst, off| if off > worst || off.is_nan() { off } else { worst })
}

#[allow(dead_code)] // Tests take the arm and Lagrange's equations from here.
fn main() -> kin::Result<()> {
    // 1. Motion, then forces: one more solve a time.
    let (m, links, solids) = arm()?;
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 4.0, 801))?;
    println!("{}", motion.summary());
    motion.add_point("tool", links[1], links[1].end())?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 2. What the motors give, the pins hold, and the balance of powers.
    let forces = system.forces(&motion)?;
    let shoulder = forces.drive("shoulder motor")?;
    let elbow = forces.drive("elbow motor")?;
    let torques = [shoulder.effort(), elbow.effort()];
    println!("shoulder: at most {}; elbow: at most {}", shoulder.peak(), elbow.peak());
    println!("power of the shoulder: at most {}", shoulder.power().peak());
    println!(
        "off Lagrange's equations by {:.0e} N m at most",
        off(&motion, links, solids, torques)
    );
    println!("{}", forces.balance());
    forces.write_csv(format!("{OUT}/forces.csv"))?;

    // 3. Charts, and the arm as it moves.
    let panel = |title: &str, quantity: &str, series: [&Series; 2]| {
        Panel::over_time(title, quantity).series("shoulder", series[0]).series("elbow", series[1])
    };
    let powers = [shoulder.power(), elbow.power()];
    Figure::new([panel("Motors", "torque", torques), panel("Motors", "power", powers)])
        .save(format!("{OUT}/torques.svg"))?;
    let scene = Scene::new(&system).trace("tool", links[1], links[1].end());
    scene.animated(&motion, 4.0)?.save(format!("{OUT}/animated.svg"))?;
    scene
        .forces(&forces)
        .page(&motion)?
        .chart("Torques of the motors", [("shoulder", torques[0]), ("elbow", torques[1])])
        .chart("Powers of the motors", [("shoulder", powers[0]), ("elbow", powers[1])])
        .save(format!("{OUT}/index.html"))?;
    println!("wrote {OUT}/: motion.csv, forces.csv, index.html, animated.svg, torques.svg");
    Ok(())
}
