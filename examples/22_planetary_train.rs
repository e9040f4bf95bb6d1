//! A planetary train with two inputs: sun and ring turn, the carrier adds them up. Lengths in mm,
//! angles in rad, time in s.
//!
//! What to see: the sun turns evenly. The ring stands at first, then turns with the sun until all
//! goes round as one block, and then against it until the carrier stands and the planets only turn
//! on their axles. Nothing tells the carrier: the meshes of one planet do, and its speed is what
//! Willis's equation says. Follow the mark on a planet.
//!
//! `cargo run --release --example 22_planetary_train`

use kin::prelude::*;
use kin_view::{Figure, Outline, Panel, Scene};

const OUT: &str = "out/22_planetary_train";

const MODULE: f64 = 2.0; // mm
// sun, planet, ring: 30 + 2 · 21 = 72, and 30 + 72 in three equal parts
const TEETH: [usize; 3] = [30, 21, 72];
const OMEGA: f64 = TAU / 4.0; // of the sun

/// The angle of something that turns at one speed after the other for two seconds, with a second
/// between to change, and at the last one for good.
fn at_speeds(speeds: &[f64]) -> Law {
    let mut angle = 0.0;
    let mut parts = Vec::new();
    for (k, &speed) in speeds.iter().enumerate() {
        let time = if k + 1 < speeds.len() { 2.0 } else { 1e3 };
        parts.push((time, Law::linear(angle, speed)));
        angle += 2.0 * speed;
        if let Some(next) = speeds.get(k + 1) {
            let more = next - speed; // the speed goes by 3 t² − 2 t³
            parts.push((1.0, Law::polynomial(&[angle, speed, 0.0, more, -0.5 * more])));
            angle += speed + 0.5 * more;
        }
    }
    Law::sequence(0.0, parts)
}

fn main() -> kin::Result<()> {
    // 1. Sun, ring and carrier on one axle.
    let [r_sun, r_planet, r_ring] = TEETH.map(|z| 0.5 * MODULE * z as f64);
    let mut m = Mechanism::new("planetary train");
    m.units("mm", "s");
    let ground = m.ground();
    let origin = vec2(0.0, 0.0);
    let sun = m.planar("sun", pose(0.0, 0.0, 0.0))?;
    let ring = m.planar("ring", pose(0.0, 0.0, 0.0))?;
    let carrier = m.planar("carrier", pose(0.0, 0.0, 0.0))?;
    for (name, wheel) in [("sun", sun), ("ring", ring), ("carrier", carrier)] {
        m.add(&format!("axle of the {name}"), revolute(ground, wheel, origin, origin))?;
    }

    // 2. Three planets in the ring. The first meshes with the sun too, which decides how the
    //    carrier turns; the others then do so by themselves.
    let mut planets = Vec::new();
    for k in 0..3 {
        let place = TAU / 3.0 * k as f64;
        let at = vec2(place.cos(), place.sin()) * (r_sun + r_planet);
        let planet = m.planar(&format!("planet {}", k + 1), pose(at.x, at.y, place))?;
        m.add(&format!("axle {}", k + 1), revolute(carrier, planet, at, origin))?;
        m.add(
            &format!("ring mesh {}", k + 1),
            internal_gear(planet, ring, carrier, r_planet, r_ring, place),
        )?;
        planets.push(planet);
    }
    m.add("sun mesh", gear(planets[0], sun, carrier, r_planet, r_sun, 0.0))?;
    m.add("sun motor", drive_angle(sun, Law::ramp(OMEGA)))?;
    m.add("ring motor", drive_angle(ring, at_speeds(&[0.0, OMEGA, -OMEGA * r_sun / r_ring])))?;

    // 3. Motion, and Willis's equation: z_s (ω_s − ω_c) + z_r (ω_r − ω_c) = 0.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 8.0, 1601))?;
    println!("{}", motion.summary());
    let rate = |wheel: PlanarBody| motion.coordinate(wheel.theta()).map(|angle| angle.rate);
    let [w_sun, w_ring, w_carrier] = [rate(sun)?, rate(ring)?, rate(carrier)?];
    let [z_sun, _, z_ring] = TEETH.map(|z| z as f64);
    for k in [200, 800, 1400] {
        let [s, r, c] = [&w_sun, &w_ring, &w_carrier].map(|rate| rate.values()[k]);
        println!(
            "sun {s:+.4}, ring {r:+.4}: carrier {c:+.4}, by Willis {:+.4} rad/s",
            (z_sun * s + z_ring * r) / (z_sun + z_ring)
        );
    }
    let mark = vec2(0.7 * r_planet, 0.0);
    motion.add_point("mark", planets[0], mark)?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 4. Pictures: the joints know the pitch circles; here the program draws the wheels with their
    //    teeth, the ring by its edges.
    let mut scene = Scene::new(&system)
        .outline(sun, Outline::gear(r_sun, TEETH[0]))
        .trace("mark", planets[0], mark)
        .color(carrier, "#e69f00");
    scene = scene
        .outline(ring, Outline::gear(r_ring, TEETH[2]).hollow())
        .outline(ring, Outline::disc(origin, 1.12 * r_ring).hollow());
    for planet in &planets {
        scene = scene.outline(*planet, Outline::gear(r_planet, TEETH[1])).color(*planet, "#009e73");
    }
    scene.pose(&motion, 4.0)?.save(format!("{OUT}/pose.svg"))?;
    scene.animated(&motion, 8.0)?.save(format!("{OUT}/animated.svg"))?;
    let speeds = [("sun", &w_sun), ("ring", &w_ring), ("carrier", &w_carrier)];
    let panel = speeds
        .iter()
        .fold(Panel::over_time("Speeds", "angular velocity"), |panel, (name, rate)| {
            panel.series(name, rate)
        });
    Figure::new([panel]).save(format!("{OUT}/speeds.svg"))?;
    scene.page(&motion)?.chart("Angular velocities", speeds).save(format!("{OUT}/index.html"))
}
