//! An engine with gas in its cylinder, balanced and not. Lengths in mm, angles in rad, time in ms,
//! masses in g: forces are in N, torques in N mm, pressures in MPa.
//!
//! What to see: a four-stroke engine of one cylinder at 3000 turns a minute. The gas pushes the
//! piston down once in two turns, but shakes nothing: it pushes the head up as hard. What shakes
//! the frame is what turns and what goes up and down; a counterweight on the crank, which takes the
//! first and half of the second, leaves a quarter of the force. The torque at the crank is that of
//! the gas and of the piston's inertia.
//!
//! `cargo run --release --example 26_engine`

use kin::forces::Forces;
use kin::loads;
use kin::loads::Solid;
use kin::prelude::*;
use kin_view::{Figure, Outline, Panel, Scene};

const OUT: &str = "out/26_engine";

const CRANK: f64 = 45.0; // mm
const ROD: f64 = 150.0; // mm
const OMEGA: f64 = TAU / 20.0; // rad/ms, 3000 turns a minute
const AREA: f64 = 5027.0; // mm², a bore of 80 mm

/// Bodies of an engine, for those who ask for forces on them.
pub struct Engine {
    pub mechanism: Mechanism,
    pub bodies: [PlanarBody; 3],
    pub solids: [Solid; 3],
}

/// Pressure in the cylinder above that outside, over the crank's angle after the dead centre at
/// which it fires. [MPa, rad]
pub fn pressure() -> Law {
    let table = [
        (0.0, 2.1), // fires
        (10.0, 3.9),
        (17.0, 4.4),
        (25.0, 3.7),
        (40.0, 2.1),
        (60.0, 1.05),
        (90.0, 0.46),
        (130.0, 0.2),
        (180.0, 0.06), // blows out
        (230.0, 0.015),
        (300.0, 0.01),
        (360.0, 0.0), // sucks in
        (430.0, -0.02),
        (500.0, -0.015),
        (550.0, 0.0), // compresses
        (600.0, 0.06),
        (640.0, 0.2),
        (670.0, 0.46),
        (690.0, 0.86),
        (705.0, 1.4),
        (720.0, 2.1),
    ];
    Law::spline(&table.map(|(degrees, p)| (f64::to_radians(degrees), p)), Ends::Periodic)
}

/// Mass, centre on the x-axis and moment of inertia about it.   [g, mm, g mm²]
fn solid(mass: f64, centre: f64, moment: f64) -> Solid {
    let inertia = Mat3::from([[0.0; 3], [0.0; 3], [0.0, 0.0, moment]]);
    Solid { mass, centre: vec3(centre, 0.0, 0.0), inertia }
}

/// The engine; a counterweight balances what turns, and half of what goes up and down.
pub fn engine(counterweight: bool) -> kin::Result<Engine> {
    let mut m = Mechanism::new("engine");
    m.units("mm", "ms").mass("g");
    let ground = m.ground();
    let crank = m.link("crank", CRANK)?;
    let rod = m.link("rod", ROD)?;
    let piston = m.planar("piston", pose(0.0, CRANK + ROD, 0.0))?;
    let origin = vec2(0.0, 0.0);
    m.add("shaft", revolute(ground, crank, origin, crank.start()))?;
    m.add("crank pin", revolute(crank, rod, crank.end(), rod.start()))?;
    m.add("piston pin", revolute(rod, piston, rod.end(), origin))?;
    m.add("bore", prismatic(piston, ground, origin, origin, vec2(1.0, 0.0), 0.0))?;
    m.add("turning", drive_angle(crank, Law::linear(PI / 2.0, OMEGA)))?; // from the dead centre
    m.set_pose(crank, pose(0.0, CRANK / 2.0, PI / 2.0))?;
    m.set_pose(rod, pose(0.0, CRANK + ROD / 2.0, PI / 2.0))?;

    // Two webs with the pin between them; the rod's centre is nearer to the crank.
    let web = Solid::bar(CRANK + 40.0, 60.0, 30.0, 7.85e-3); // g/mm³
    let rod_solid = solid(560.0, -0.2 * ROD, 1.9e6);
    let piston_solid = solid(430.0, 0.0, 2.4e5);
    let mut crank_solid = web;
    if counterweight {
        // The rod as two masses: 0.3 of it goes up and down with the piston, 0.7 turns with the
        // pin.
        let turns = 0.7 * rod_solid.mass + 0.5 * (piston_solid.mass + 0.3 * rod_solid.mass);
        let moment = web.mass * CRANK / 2.0 + turns * CRANK;
        let away = 55.0;
        let radius = 40.0;
        let disc = Solid::disc(radius, 1.0, 7.85e-3);
        let thickness = moment / (away * disc.mass);
        let weight = Solid::disc(radius, thickness, 7.85e-3);
        crank_solid = crank_solid.and(weight.at((-CRANK / 2.0 - away, 0.0, 0.0)));
    }
    m.solid(crank, crank_solid)?;
    m.solid(rod, rod_solid)?;
    m.solid(piston, piston_solid)?;

    // The table is over the crank's angle, which is ω t from the dead centre.
    let height = loads::slide(piston, ground, origin, origin, vec2(0.0, 1.0));
    let push = pressure().compose(&Law::ramp(OMEGA)) * -AREA;
    m.load("gas", loads::force_in_time(height, push))?;
    let bodies = [crank.into(), rod.into(), piston];
    Ok(Engine { mechanism: m, bodies, solids: [crank_solid, rod_solid, piston_solid] })
}

/// By hand at time t: the shaking force on the frame, the shaking moment about the shaft, and the
/// torque that keeps the crank turning evenly: −Σ m a, −Σ (r × m a + J α), (Σ (m a · v + J α θ̇) +
/// p A v)/ω.
pub fn by_hand([crank, rod, piston]: [Solid; 3], t: f64) -> (Vec2, f64, f64) {
    let theta = PI / 2.0 + OMEGA * t;
    let e = |angle: f64| (vec2(angle.cos(), angle.sin()), vec2(-angle.sin(), angle.cos()));
    let (along, across) = e(theta);
    let psi = (-CRANK / ROD * theta.cos()).acos(); // of the rod; its end is over the shaft
    let rate = -CRANK / ROD * OMEGA * theta.sin() / psi.sin();
    let second = -(CRANK / ROD * OMEGA * OMEGA * theta.cos() + psi.cos() * rate * rate) / psi.sin();
    let (along_rod, across_rod) = e(psi);
    // Position, velocity and acceleration of a point of the crank by its distance from the shaft,
    // and of the rod by that from the pin.
    let on_crank = |d: f64| [along * d, across * (d * OMEGA), along * (-d * OMEGA * OMEGA)];
    let on_rod = |d: f64| {
        let [r, v, a] = on_crank(CRANK);
        let turned = across_rod * (d * second) - along_rod * (d * rate * rate);
        [r + along_rod * d, v + across_rod * (d * rate), a + turned]
    };
    let centres =
        [on_crank(CRANK / 2.0 + crank.centre.x), on_rod(ROD / 2.0 + rod.centre.x), on_rod(ROD)];
    let turning = [0.0, rod.inertia.m33 * second, 0.0];
    let mut force = vec2(0.0, 0.0);
    let mut moment = 0.0;
    let mut power = rod.inertia.m33 * second * rate;
    for ((solid, [r, v, a]), due) in [crank, rod, piston].iter().zip(centres).zip(turning) {
        force -= a * solid.mass;
        moment -= solid.mass * (r.x * a.y - r.y * a.x) + due;
        power += solid.mass * a.dot(v);
    }
    power += pressure().at(OMEGA * t) * AREA * centres[2][1].y;
    (force, moment, power / OMEGA)
}

/// The force and moment that shake the frame: all that joints put on it, and the gas on the head.
pub fn shaking(forces: &Forces<'_>) -> kin::Result<(Vec<Vec2>, Vec<f64>)> {
    let frame = PlanarBody::from(Ground);
    let joints = forces.on_ground().on(frame)?;
    let gas = forces.load("gas")?.on(frame)?;
    let gas = gas.about(vec2(0.0, 0.0));
    let force = joints.force()?.into_iter().zip(gas.force()?).map(|(a, b)| a + b).collect();
    let moment = joints.torque()?.into_iter().zip(gas.torque()?).map(|(a, b)| a + b).collect();
    Ok((force, moment))
}

#[allow(dead_code)] // Tests take the engine and its closed form from here.
fn main() -> kin::Result<()> {
    // 1. Both engines run two turns.
    let times = linspace(0.0, 40.0, 721);
    let mut shaken = Vec::new();
    for counterweight in [false, true] {
        let Engine { mechanism, solids, .. } = engine(counterweight)?;
        let system = mechanism.build()?;
        let motion = system.run(&times)?;
        let forces = system.forces(&motion)?;
        let (force, moment) = shaking(&forces)?;
        let effort = forces.drive("turning")?;
        let off = (0..motion.len()).map(|k| {
            let (by_hand, ..) = by_hand(solids, times[k]);
            (force[k] - by_hand).norm()
        });
        let largest = force.iter().fold(0.0_f64, |m, f| m.max(f.norm()));
        println!(
            "{}: shakes with {largest:.0} N at most, off the closed form by {:.0e} N; torque {}",
            if counterweight { "with counterweight" } else { "without          " },
            off.fold(0.0, f64::max),
            effort.peak()
        );
        shaken.push((force, moment));
    }

    // 2. The balanced one in files: its motion, its forces, the shaking of both.
    let Engine { mechanism: m, bodies: [crank, _, piston], .. } = engine(true)?;
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(&times)?;
    println!("{}", motion.summary());
    let names = ["without counterweight", "with counterweight"];
    for (name, (force, moment)) in names.iter().zip(&shaken) {
        motion.add_output(
            &format!("shaking force {name}"),
            "N",
            force.iter().map(|f| f.norm()).collect(),
        )?;
        motion.add_output(&format!("shaking moment {name}"), "N mm", moment.clone())?;
    }
    motion.add_point("piston pin", piston, vec2(0.0, 0.0))?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;
    let forces = system.forces(&motion)?;
    println!("{}", forces.balance());
    forces.write_csv(format!("{OUT}/forces.csv"))?;

    // 3. Pictures: the shaking force as the curve of its end, and over time.
    let outputs = motion.outputs().to_vec();
    let mut polar = Panel::numbers("Shaking force on the frame", "to the side [N]", "up [N]");
    for (name, (force, _)) in names.iter().zip(&shaken) {
        polar = polar.path(name, force);
    }
    let over_time = |title: &str, quantity: &str, k: usize| {
        Panel::over_time(title, quantity)
            .series(names[0], &outputs[k])
            .series(names[1], &outputs[k + 2])
    };
    let drive = forces.drive("turning")?;
    let torque = Panel::over_time("At the crank", "torque").series("torque", drive.effort());
    Figure::new([
        polar,
        over_time("Shaking force", "force", 0),
        over_time("Shaking moment", "moment", 1),
        torque,
    ])
    .save(format!("{OUT}/shaking.svg"))?;
    let box_of = |x: f64, low: f64, high: f64| {
        Outline::polygon([vec2(-x, low), vec2(x, low), vec2(x, high), vec2(-x, high)])
    };
    let wall = |x: f64| {
        Outline::polygon([
            vec2(x, 100.0),
            vec2(x * 1.2, 100.0),
            vec2(x * 1.2, 240.0),
            vec2(x, 240.0),
        ])
    };
    let web = [
        vec2(-95.0, -40.0),
        vec2(-60.0, -45.0),
        vec2(35.0, -14.0),
        vec2(35.0, 14.0),
        vec2(-60.0, 45.0),
    ];
    let web = web.into_iter().chain([vec2(-95.0, 40.0)]);
    let scene = Scene::new(&system)
        .outline(crank, Outline::polygon(web.collect::<Vec<_>>()))
        .outline(piston, box_of(39.0, -25.0, 30.0))
        .outline(Ground, wall(41.0))
        .outline(Ground, wall(-41.0))
        .hide_joint("bore");
    scene.animated(&motion, 3.0)?.save(format!("{OUT}/animated.svg"))?;
    let scene = scene.forces(&forces);
    let pressures: Vec<f64> = times.iter().map(|t| pressure().at(OMEGA * t)).collect();
    motion.add_output("pressure", "MPa", pressures)?;
    let gas = motion.outputs().last().cloned();
    let mut page = scene
        .page(&motion)?
        .chart("Shaking force", [(names[0], &outputs[0]), (names[1], &outputs[2])])
        .chart("Shaking moment", [(names[0], &outputs[1]), (names[1], &outputs[3])])
        .chart("Torque at the crank", [("torque", drive.effort())]);
    if let Some(gas) = &gas {
        page = page.chart("Pressure in the cylinder", [("pressure", gas)]);
    }
    page.save(format!("{OUT}/index.html"))?;
    println!("wrote {OUT}/: motion.csv, forces.csv, index.html, animated.svg, shaking.svg");
    Ok(())
}
