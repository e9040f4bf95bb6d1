//! A joint nobody ships, declared, checked and used: a pin in a parabolic slot. Lengths in m,
//! angles in rad, time in s.
//!
//! What to see: the slot is milled into a disc that a motor turns; the pin sits at the end of an
//! arm and is dragged round by it, slowly and then quickly: a quick-return drive. The constraint is
//! five lines of this file, and the slot on the page comes from it. Copy this one.
//!
//! `cargo run --release --example 03_custom_constraint`

use kin::check;
use kin::check::any_planar;
use kin::prelude::*;
use kin::state::PlanarState;
use kin_view::{Figure, Panel, Scene};

const OUT: &str = "out/03_custom_constraint";
const K: f64 = 4.0; // 1/m: the slot is y = K x²

// 1. The constraint: its equation, and nothing else.
/// Pin in a parabolic slot: P of body i stays on y = k x², the slot being fixed in body j.      [m]
#[constraint]
fn parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - k * s.x * s.x
}

fn main() -> kin::Result<()> {
    // 2. The check: C_q, C_t and Q_d of the compiled constraint, by dual numbers, and by central
    //    differences.
    let any = parabolic_slot(any_planar(), any_planar(), vec2(0.06, 0.01), K);
    let report = check::compare(&any)?;
    println!("{}: {} route, compared at {} states", any.facts().kind, any.route(), report.states);
    println!(
        "  from dual numbers {:.0e}, from central differences {:.0e} (relative, at most)\n",
        report.routes, report.differences
    );

    // 3. Geometry: the disc turns about the vertex of its slot; the arm about C, nearer than its
    //    own length.
    let c = vec2(0.05, 0.0); // m
    let mut m = Mechanism::new("quick return");
    let ground = m.ground();
    let disc = m.planar("disc", pose(0.0, 0.0, 0.0))?;
    let arm = m.link("arm", 0.12)?; // m

    // 4. Constraints: two pins and the slot.
    m.add("O", revolute(ground, disc, vec2(0.0, 0.0), vec2(0.0, 0.0)))?;
    m.add("C", revolute(ground, arm, c, arm.start()))?;
    m.add("slot", parabolic_slot(arm, disc, arm.end(), K))?;

    // 5. Motion: the motor turns once a second; of the two assemblies, the one with the pin in the
    //    right half of the slot.
    m.add("motor", drive_angle(disc, Law::ramp(TAU)))?; // rad/s
    m.prefer(arm, 0.0); // rad
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 1.0, 1001))?;
    println!("{}", motion.summary());

    // 6. Results: how unevenly the arm turns, and whether the pin has stayed in the slot.
    let pin = motion.point(arm, arm.end())?;
    let disc_angle = motion.coordinate(disc.theta())?.value;
    let disc_at = |angle: &f64| PlanarState::new([0.0, 0.0, *angle]);
    let in_disc: Vec<Vec2> = pin
        .r()
        .iter()
        .zip(disc_angle.values())
        .map(|(p, angle)| disc_at(angle).local(*p))
        .collect();
    let off_slot: Vec<f64> = in_disc.iter().map(|s| s.y - K * s.x * s.x).collect();
    let arm_turns = motion.coordinate(arm.theta())?;
    println!(
        "{:28} {:>9} {:>10} {:>9} {:>10}",
        "over one turn of the disc", "least", "at t [s]", "greatest", "at t [s]"
    );
    for q in [&arm_turns.rate, &arm_turns.second_rate, &pin.speed()] {
        let name = format!("{} [{}]", q.name(), q.unit());
        println!(
            "{name:28} {:9.3} {:10.3} {:9.3} {:10.3}",
            q.min(),
            q.at_min(),
            q.max(),
            q.at_max()
        );
    }
    motion.add_point("pin", arm, arm.end())?;
    motion.add_output("pin off the slot", "m", off_slot)?;
    let Some(off_slot) = motion.outputs().last() else { return Ok(()) };
    println!("pin off the slot: at most {:.0e} m", off_slot.max().max(-off_slot.min()));
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 7. Figures: the slot and the arm eight times a turn; the pin as the disc sees it.
    let slot: Vec<Vec2> = linspace(0.0, 0.16, 81).iter().map(|&x| vec2(x, K * x * x)).collect();
    let mut on_ground = Panel::plane("On the ground: slot and arm every 0.125 s");
    for (p, angle) in pin.r().iter().zip(disc_angle.values()).step_by(125).take(8) {
        let turned: Vec<Vec2> = slot.iter().map(|s| disc_at(angle).point(*s)).collect();
        on_ground = on_ground.sketch(&turned).sketch(&[c, *p]);
    }
    let on_disc = Panel::plane("On the disc: pin and slot").sketch(&slot).path("pin", &in_disc);
    Figure::new(vec![on_ground.path("pin", pin.r()), on_disc]).save(format!("{OUT}/paths.svg"))?;
    let over_time = vec![
        Panel::over_time("Disc and arm", "angular velocity")
            .series("arm", &arm_turns.rate)
            .series("disc", &motion.coordinate(disc.theta())?.rate),
        Panel::over_time("Pin off the slot", "y − k x²").series("residual", off_slot),
    ];
    Figure::new(over_time).save(format!("{OUT}/motion.svg"))?;
    let scene = Scene::new(&system).trace("pin", arm, arm.end());
    scene.animated(&motion, 3.0)?.save(format!("{OUT}/animated.svg"))?;
    let page = scene.page(&motion)?.coordinate("Arm", &arm_turns);
    page.chart("Pin off the slot", [("residual", off_slot)]).save(format!("{OUT}/index.html"))?;
    println!("wrote {OUT}/: motion.csv, index.html, animated.svg, motion.svg, paths.svg");
    Ok(())
}
