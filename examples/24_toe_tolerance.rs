//! The toe of a wheel, and which point of its suspension changes it most. Lengths in mm, angles in
//! rad, time in s.
//!
//! What to see: the wheel goes up and down by 60 mm. Each ball may be off by half a millimetre in
//! each direction, the tie rod by as much in its length. Of the toe, a metre out along the spindle,
//! the tie rod's length and where its ends are sideways take two thirds, and their heights hardly
//! anything: that is why toe is set by the tie rod. Drag the picture to go round it.
//!
//! `cargo run --release --example 24_toe_tolerance`

use kin::joints::drivers::spatial::drive_point_along;
use kin::prelude::*;
use kin_view::{Bars, Outline, Scene};

const OUT: &str = "out/24_toe_tolerance";

/// Points of the left side: front and rear axle of a wishbone, its ball; the tie rod at the rack
/// and at the upright.      [mm]
const LOWER: [Vec3; 3] =
    [Vec3::new(150.0, 350.0, 190.0), Vec3::new(-170.0, 350.0, 200.0), Vec3::new(5.0, 725.0, 175.0)];
const UPPER: [Vec3; 3] = [
    Vec3::new(110.0, 430.0, 470.0),
    Vec3::new(-130.0, 430.0, 455.0),
    Vec3::new(-20.0, 680.0, 500.0),
];
const TIE_ROD: [Vec3; 2] = [Vec3::new(-140.0, 390.0, 255.0), Vec3::new(-125.0, 705.0, 252.0)];
const HUB: Vec3 = Vec3::new(0.0, 780.0, 320.0);

/// A point whose three coordinates may be off, each by half a millimetre.
fn hard_point(m: &mut Mechanism, name: &str, at: Vec3) -> kin::Result<Vec3<Dimension>> {
    let mut part = |axis: &str, value: f64| {
        kin::Result::Ok(m.dimension(&format!("{name} {axis}"), value)?.tolerance(0.5).unit("mm"))
    };
    Ok(Vec3 { x: part("x", at.x)?, y: part("y", at.y)?, z: part("z", at.z)? })
}

fn main() -> kin::Result<()> {
    // 1. All frames stand at the origin, so that local points are those of the drawing. The points
    // of the upright are dimensions, and so is the tie rod; what is welded to the car is not.
    let mut m = Mechanism::new("toe");
    m.units("mm", "s");
    let still = SpatialPose::at(Vec3::new(0.0, 0.0, 0.0));
    let upright = m.spatial("upright", still)?;
    let mut arms = Vec::new();
    for (name, [front, rear, ball]) in [("lower", LOWER), ("upper", UPPER)] {
        let arm = m.spatial(&format!("{name} wishbone"), still)?;
        let middle = (front + rear) * 0.5;
        let axis = front - rear;
        m.add(
            &format!("{name} hinge"),
            spatial::revolute(arm, Ground, middle, middle, axis, axis),
        )?;
        let made = hard_point(&mut m, &format!("{name} ball"), ball)?;
        m.add(&format!("{name} ball"), spatial::spherical(arm, upright, ball, made))?;
        arms.push((arm, [front, rear, ball]));
    }
    let [inner, outer] = TIE_ROD;
    let length = m.dimension("tie rod", (outer - inner).norm())?.tolerance(0.5).unit("mm");
    let [rack, end] =
        [hard_point(&mut m, "rack end", inner)?, hard_point(&mut m, "tie rod end", outer)?];
    m.add("tie rod", spatial::distance(Ground, upright, rack, end, length))?;
    let travel = Law::constant(HUB.z) + Law::sine(60.0, TAU / 4.0, 0.0);
    m.add("travel", drive_point_along(upright, HUB, Vec3::z(), travel))?;

    // 2. The motion, and the toe as garages measure it: how far a point a metre out along the
    // spindle is ahead.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 4.0, 201))?;
    println!("{}", motion.summary());
    let toe = move |motion: &Motion| {
        let ahead = |local: Vec3| kin::Result::Ok(motion.point(upright, local)?.along(Vec3::x()));
        kin::Result::Ok((ahead(HUB + vec3(0.0, 1000.0, 0.0))? - ahead(HUB)?).renamed("toe"))
    };

    // 3. Where it may be off most, and at ride height.
    let worst = system.tolerance(&motion, toe)?;
    let ride = system.tolerance_of(&motion, toe, 0.0)?;
    println!(
        "{worst}\nat ride height ± {:.2} mm worst case, ± {:.2} mm RSS",
        ride.worst_case(),
        ride.rss()
    );
    Bars::new(&worst, "s").save(format!("{OUT}/tolerance.svg"))?;

    // 4. The table of the motion, and the wheel as it moves.
    let of_time = toe(&motion)?;
    motion.add_output("toe", "mm", of_time.value.values().to_vec())?;
    motion.add_point("hub", upright, HUB)?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;
    let mut scene = Scene::new(&system).seen_from(0.62, 0.32).color(upright, "#d55e00");
    for (arm, [front, rear, ball]) in arms {
        scene = scene.outline(arm, Outline::polygon([front, ball, rear])).color(arm, "#0072b2");
    }
    let rim =
        (0..48).map(|k| TAU * k as f64 / 48.0).map(|a| HUB + vec3(a.cos(), 0.0, a.sin()) * 320.0);
    scene = scene
        .outline(upright, Outline::polygon([LOWER[2], UPPER[2], TIE_ROD[1]]))
        .add_outline(upright, Outline::polygon(rim))
        .trace("hub", upright, HUB);
    scene.animated(&motion, 4.0)?.save(format!("{OUT}/animated.svg"))?;
    scene.page(&motion)?.chart("Toe", [("toe", &of_time.value)]).save(format!("{OUT}/index.html"))
}
