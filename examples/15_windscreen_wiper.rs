//! A windscreen wiper, and what can be asked of a mechanism. Lengths in m, angles in rad, time in
//! s.
//!
//! What to see: a crank that goes round evenly swings the wiper to and fro. Where it turns round is
//! not read off the grid: the pose is solved at the very time at which the rate is zero. Beside
//! that the page has the angle at which the rod pushes the arm (the nearer to 90°, the better), the
//! jerk of the blade's tip, which is what one hears, and the list of what happened on the way: the
//! blade passes the edge of the glass.
//!
//! `cargo run --release --example 15_windscreen_wiper`

use kin::SolverOptions;
use kin::prelude::*;
use kin_view::{Figure, Outline, Panel, Scene};

const OUT: &str = "out/15_windscreen_wiper";

fn main() -> kin::Result<()> {
    // 1. Geometry and constraints: a crank-rocker whose arm carries the blade; one turn of the
    //    crank in a second. m: the ground pins; the blade's tip from the middle of the arm
    let apart = 0.26;
    let tip = vec2(0.45, 0.0);
    let mut m = Mechanism::new("windscreen wiper");
    let ground = m.ground();
    let crank = m.link("crank", 0.035)?;
    let rod = m.link("rod", 0.25)?;
    let arm = m.link("arm", 0.06)?;
    m.add("O", revolute(crank, ground, crank.start(), vec2(0.0, 0.0)))?;
    m.add("A", revolute(crank, rod, crank.end(), rod.start()))?;
    m.add("B", revolute(rod, arm, rod.end(), arm.end()))?;
    m.add("C", revolute(arm, ground, arm.start(), vec2(apart, 0.0)))?;
    m.add("motor", drive_angle(crank, Law::ramp(TAU)))?;
    m.prefer(arm, deg(110.0));
    m.limit("C.angle", deg(75.0), deg(150.0))?; // the edges of the glass: they stop nothing, but a run tells
    m.write_json(format!("{OUT}/mechanism.json"))?;

    // 2. Motion, with the jerk.
    let system = m.build()?;
    let mut motion =
        system.solver().options(SolverOptions::new().jerk(true)).run(linspace(0.0, 1.0, 361))?;
    println!("{}\n", motion.summary());

    // 3. Questions. A measure is a name, a coordinate or a function of a motion; its extremes come
    //    with their exact times.
    println!("what can be asked by name: {}", system.measures().join(", "));
    let swing = system.extremes(&motion, "C.angle")?;
    println!(
        "swing {:.2}°, time ratio {:.4}",
        swing.stroke().to_degrees(),
        swing.time_ratio().unwrap_or(f64::NAN)
    );
    for dead_centre in swing.all() {
        let pose = system.at(&motion, dead_centre.t)?; // a motion of one time: ask it anything
        let crank = pose.coordinate(crank.theta())?.value;
        let rod = pose.coordinate(rod.theta())?.value;
        println!(
            "  dead centre at {:.9} s: wiper at {:6.2}°, crank at {:6.2}°, rod at {:6.2}°",
            dead_centre.t,
            dead_centre.value.to_degrees(),
            crank.values()[0].to_degrees(),
            rod.values()[0].to_degrees()
        );
    }
    let worst = system.extremes(&motion, |m: &Motion| m.transmission_angle(rod, arm))?;
    println!(
        "transmission angle at least {:.2}°, at {:.6} s",
        worst.min().value.to_degrees(),
        worst.min().t
    );
    for event in motion.events() {
        println!("  {event}");
    }
    let point = motion.point(arm, tip)?;
    let jerk = point.jerk_magnitude();
    println!(
        "tip: at most {:.2} m/s, {:.1} m/s², {:.0} m/s³",
        point.speed().max(),
        point.acceleration_magnitude().max(),
        jerk.max()
    );
    let centres = motion.instant_centre(rod, ground)?;
    let nearest = centres.iter().flatten().map(|p| p.norm()).fold(f64::MAX, f64::min);
    println!("the rod's instant centre comes as near as {nearest:.3} m to the crank's axle\n");

    // 4. Files.
    let transmission = motion.transmission_angle(rod, arm)?;
    motion.add_point("tip", arm, tip)?;
    motion.add_output("transmission angle", "rad", transmission.value.values().to_vec())?;
    motion.write_csv(format!("{OUT}/motion.csv"))?; // with the jerk of all coordinates
    motion.write_json(format!("{OUT}/motion.json"))?; // with the events

    // 5. Pictures: the program draws the blade; the sequence shows the motion at its dead centres
    //    and between.
    let blade = [arm.start(), tip];
    let scene = Scene::new(&system).trace("tip", arm, tip).outline(arm, Outline::line(blade));
    for (side, dead_centre) in ["one", "other"].into_iter().zip(swing.all()) {
        scene
            .pose(&system.at(&motion, dead_centre.t)?, dead_centre.t)?
            .save(format!("{OUT}/dead_centre_{side}.svg"))?;
    }
    scene.sequence(&motion, 7)?.save(format!("{OUT}/sequence.svg"))?;
    scene.animated(&motion, 2.0)?.save(format!("{OUT}/animated.svg"))?;
    let angle = motion.coordinate(arm.theta())?;
    let panels = vec![
        Panel::over_time("Wiper", "angle").series("wiper", &angle.value),
        Panel::over_time("How well the rod pushes", "transmission angle")
            .series("μ", &transmission.value),
        Panel::over_time("Wiper", "angular jerk").series("wiper", &angle.third_rate),
        Panel::over_time("Tip", "jerk").series("tip", &jerk),
    ];
    Figure::new(panels).save(format!("{OUT}/measures.svg"))?;
    let page = scene
        .page(&motion)?
        .chart("Transmission angle", [("μ", &transmission.value)])
        .chart("Jerk of the tip", [("tip", &jerk)]);
    page.coordinate("Wiper", &angle).save(format!("{OUT}/index.html"))
}
