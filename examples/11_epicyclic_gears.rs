//! An epicyclic gear: sun, three planets on a carrier, and a ring that stands still. Lengths in m,
//! angles in rad, time in s.
//!
//! What to see: the sun turns four times while the carrier goes round once, 1 + z_ring/z_sun = 4,
//! and the teeth stay in mesh all the way. A point on the edge of a planet draws a hypocycloid,
//! with its cusps on the pitch circle of the ring. The teeth are only drawn: the constraint is that
//! the pitch circles roll on each other.
//!
//! `cargo run --release --example 11_epicyclic_gears`

use kin::prelude::*;
use kin_view::{Outline, Scene};

const OUT: &str = "out/11_epicyclic_gears";

fn main() -> kin::Result<()> {
    // 1. Teeth and pitch radii, module 5 mm: the ring fits round sun and planets.
    let teeth_sun = 24;
    let teeth_planet = 24;
    let teeth_ring = teeth_sun + 2 * teeth_planet;
    let radius = |teeth: usize| 0.0025 * teeth as f64; // m
    let r_sun = radius(teeth_sun);
    let r_planet = radius(teeth_planet);
    let r_ring = radius(teeth_ring);

    // 2. Sun and carrier on the ground, planets on the carrier; the ring is the ground.
    let mut m = Mechanism::new("epicyclic gear");
    let ground = m.ground();
    let carrier = m.planar("carrier", pose(0.0, 0.0, 0.0))?;
    let sun = m.planar("sun", pose(0.0, 0.0, 0.0))?;
    let origin = vec2(0.0, 0.0);
    m.add("axle of the carrier", revolute(ground, carrier, origin, origin))?;
    m.add("axle of the sun", revolute(ground, sun, origin, origin))?;
    let mut scene_bodies = Vec::new();
    for k in 0..3 {
        let place = deg(120.0 * k as f64);
        let at = vec2(place.cos(), place.sin()) * (r_sun + r_planet);
        let planet = m.planar(&format!("planet {}", k + 1), pose(at.x, at.y, 0.0))?;
        m.add(&format!("axle {}", k + 1), revolute(carrier, planet, at, origin))?;
        m.add(
            &format!("ring mesh {}", k + 1),
            internal_gear(planet, ground, carrier, r_planet, r_ring, 0.0),
        )?;
        if k == 0 {
            m.add("sun mesh", gear(planet, sun, carrier, r_planet, r_sun, 0.0))?;
        }
        scene_bodies.push((planet, place));
    }
    m.add("motor", drive_angle(carrier, Law::ramp(TAU / 8.0)))?; // one turn in eight seconds

    // 3. Motion.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 8.0, 1601))?;
    let sun_turns = motion.coordinate(sun.theta())?;
    let (first, _) = scene_bodies[0];
    println!("{}", motion.summary());
    println!(
        "the sun turns {:.4} times, by Willis {:.4}",
        sun_turns.value.max() / TAU,
        1.0 + r_ring / r_sun
    );
    motion.add_point("edge", first, vec2(r_planet, 0.0))?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 4. Pictures: wheels with teeth, and a ring with its teeth inside.
    let mut scene = Scene::new(&system)
        .trace("edge", first, vec2(r_planet, 0.0))
        .outline(ground, Outline::disc(origin, 1.12 * r_ring).hollow());
    scene = scene
        .outline(ground, Outline::gear(r_ring, teeth_ring).hollow())
        .outline(sun, Outline::gear(r_sun, teeth_sun).turned(half_tooth(teeth_sun)));
    for (planet, _) in scene_bodies {
        scene = scene.outline(planet, Outline::gear(r_planet, teeth_planet));
    }
    scene.pose(&motion, 0.5)?.save(format!("{OUT}/pose.svg"))?;
    scene.animated(&motion, 8.0)?.save(format!("{OUT}/animated.svg"))?;
    let planet_turns = motion.coordinate(first.theta())?;
    let page = scene
        .page(&motion)?
        .chart("Angles", [("sun", &sun_turns.value), ("planet", &planet_turns.value)]);
    page.chart("Speed of the edge", [("edge", &motion.point(first, vec2(r_planet, 0.0))?.speed())])
        .save(format!("{OUT}/index.html"))
}

/// Half a pitch: where one wheel has a tooth, its partner has a gap.
fn half_tooth(teeth: usize) -> f64 {
    PI / teeth as f64
}
