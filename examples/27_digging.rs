//! The forces of an excavator's cylinders while it digs. Lengths in m, angles in rad, time in s,
//! masses in t: forces are in kN, powers in kW.
//!
//! What to see: the machine of the excavator's example pulls its bucket through the ground, against
//! a resistance at its edge, and lifts it full. Lowering the boom, its cylinder holds the weight of
//! all; the stick's cylinder pushes hardest in the ground, and the boom's is then pulled. Virtual
//! power, with lever arms by hand, gives the same forces to the last digits.
//!
//! `cargo run --release --example 27_digging`

use kin::Load;
use kin::loads::Solid;
use kin::prelude::*;
use kin_view::{Figure, Outline, Panel, Scene};

const OUT: &str = "out/27_digging";

/// Pins: on the machine, and on each body in its own frame, which stands at its lower pin with x to
/// the next one.      [m]
const MACHINE: [Vec2; 2] = [Vec2::new(0.0, 1.8), Vec2::new(0.55, 1.15)]; // of the boom, of its cylinder
// of the stick, of the boom's cylinder, of the stick's
const BOOM: [Vec2; 3] = [Vec2::new(5.4, 0.0), Vec2::new(2.35, 0.55), Vec2::new(2.6, 1.25)];
const STICK: [Vec2; 4] =
    // bucket, both cylinders, lever
    [Vec2::new(2.7, 0.0), Vec2::new(-0.75, 0.25), Vec2::new(-0.1, 0.6), Vec2::new(2.3, 0.05)];
const BUCKET: [Vec2; 2] = [Vec2::new(0.12, 0.38), Vec2::new(1.35, -0.25)]; // of the rod, and the edge
const SOIL: Vec2 = Vec2::new(0.6, -0.25); // the middle of what is in the bucket
const LEVER: f64 = 0.55;
const ROD: f64 = 0.5;
const G: Vec2 = Vec2::new(0.0, -9.81); // m/s²

/// Boom, stick, bucket, lever, rod, and their masses.
pub struct Digger {
    pub mechanism: Mechanism,
    pub bodies: [PlanarBody; 5],
    pub solids: [Solid; 5],
}

pub const CYLINDERS: [&str; 3] = ["boom cylinder", "stick cylinder", "bucket cylinder"];

/// The length of a cylinder: moves of three seconds each from one length to the next.
fn moves(lengths: [f64; 4]) -> Law {
    let three =
        |ends: &[f64]| (3.0, Law::constant(ends[0]) + Law::polynomial_345(ends[1] - ends[0], 3.0));
    Law::sequence(0.0, lengths.windows(2).map(three))
}

/// A force that comes, from 3.3 s on, and has gone at 5.9 s.   [kN]
fn resistance(most: f64) -> Law {
    let none = Law::constant(0.0);
    let all = Law::constant(most);
    let back = all.clone() + Law::polynomial_345(-most, 0.8);
    Law::sequence(
        0.0,
        [
            (3.3, none.clone()),
            (1.0, Law::polynomial_345(most, 1.0)),
            (0.8, all),
            (0.8, back),
            (3.1, none),
        ],
    )
}

/// The weight of the soil as the bucket fills, from 3.5 s to 5.9 s.   [kN]
fn soil(weight: f64) -> Law {
    let fills = Law::polynomial_345(-weight, 2.4);
    Law::sequence(0.0, [(3.5, Law::constant(0.0)), (2.4, fills), (3.1, Law::constant(-weight))])
}

/// The machine with its masses and what the ground does.
pub fn digger() -> kin::Result<Digger> {
    let mut m = Mechanism::new("digging");
    m.units("m", "s").mass("t");
    let ground = m.ground();
    let boom = m.planar("boom", pose(0.0, 1.8, deg(35.0)))?;
    let stick = m.planar("stick", pose(4.4, 4.9, deg(-40.0)))?;
    let bucket = m.planar("bucket", pose(6.5, 3.2, deg(-40.0)))?;
    let lever = m.link("lever", LEVER)?;
    let rod = m.link("rod", ROD)?;
    m.set_pose(lever, pose(6.4, 3.6, deg(40.0)))?;
    m.set_pose(rod, pose(6.7, 3.5, deg(-60.0)))?;
    let origin = vec2(0.0, 0.0);
    m.add("boom pin", revolute(ground, boom, MACHINE[0], origin))?;
    m.add("stick pin", revolute(boom, stick, BOOM[0], origin))?;
    m.add("bucket pin", revolute(stick, bucket, STICK[0], origin))?;
    m.add("lever pin", revolute(stick, lever, STICK[3], lever.start()))?;
    m.add("upper rod pin", revolute(lever, rod, lever.end(), rod.start()))?;
    m.add("lower rod pin", revolute(rod, bucket, rod.end(), BUCKET[0]))?;
    // lower the boom; pull the stick and curl the bucket; lift
    let lengths =
        [[2.67, 2.27, 2.3, 2.7], [2.85, 2.85, 3.45, 3.45], [2.45, 2.45, 2.85, 2.9]].map(moves);
    let [of_boom, of_stick, of_bucket] = lengths;
    m.add(CYLINDERS[0], drive_distance(ground, boom, MACHINE[1], BOOM[1], of_boom))?;
    m.add(CYLINDERS[1], drive_distance(boom, stick, BOOM[2], STICK[1], of_stick))?;
    m.add(CYLINDERS[2], drive_distance(stick, lever, STICK[2], lever.end(), of_bucket))?;

    // Masses in t, inertias in t m²; lever and rod are of steel.
    let solid = |mass: f64, x: f64, y: f64, moment: f64| {
        let inertia = Mat3::from([[0.0; 3], [0.0; 3], [0.0, 0.0, moment]]);
        Solid { mass, centre: vec3(x, y, 0.0), inertia }
    };
    let bar = |length: f64| Solid::bar(length, 0.14, 0.1, Solid::STEEL * 1e-3);
    let bodies: [PlanarBody; 5] = [boom, stick, bucket, lever.into(), rod.into()];
    let solids = [
        solid(1.9, 2.55, 0.6, 5.2),
        solid(0.85, 0.9, 0.2, 0.8),
        solid(0.75, 0.55, -0.2, 0.19),
        bar(LEVER),
        bar(ROD),
    ];
    for (body, solid) in bodies.into_iter().zip(solids) {
        m.solid(body, solid)?;
    }
    m.gravity(G);
    // The ground pushes the edge back along the bucket, and up.
    m.load(
        "ground",
        Load::force_in_body(bucket, BUCKET[1], [resistance(-45.0), resistance(20.0)]),
    )?;
    m.load("soil", Load::force(bucket, SOIL, [Law::constant(0.0), soil(9.0)]))?;
    Ok(Digger { mechanism: m, bodies, solids })
}

/// The forces of the cylinders at each time by virtual power: cylinder k grows by a unit a second
/// alone, boom, stick and bucket turn about their pins as lever arms say, and its force is the
/// power that all others take.      [kN]
pub fn by_hand(
    motion: &Motion,
    bodies: [PlanarBody; 5],
    solids: [Solid; 5],
) -> kin::Result<Vec<[f64; 3]>> {
    let [boom, stick, bucket, lever, _] = bodies;
    let path = |body: PlanarBody, u: Vec2| motion.point(body, u).map(|point| point.r().to_vec());
    let half = vec2(LEVER / 2.0, 0.0);
    let pins =
        [path(boom, vec2(0.0, 0.0))?, path(stick, vec2(0.0, 0.0))?, path(bucket, vec2(0.0, 0.0))?];
    let lower = [vec![MACHINE[1]; motion.len()], path(boom, BOOM[2])?, path(stick, STICK[2])?];
    let upper = [path(boom, BOOM[1])?, path(stick, STICK[1])?, path(lever, half)?];
    let lever_pin = path(lever, -half)?;
    let rod_end = path(bucket, BUCKET[0])?;
    let edge = path(bucket, BUCKET[1])?;
    let tip = path(bucket, SOIL)?;
    let mut centres = Vec::new();
    for (body, solid) in bodies.into_iter().zip(solids) {
        let point = motion.point(body, vec2(solid.centre.x, solid.centre.y))?;
        let turning = motion.coordinate(body.theta())?.second_rate;
        centres.push((point.r().to_vec(), point.a().to_vec(), turning.values().to_vec()));
    }
    let across = |r: Vec2| vec2(-r.y, r.x);
    let unit = |r: Vec2| r / r.norm();
    let heading = motion.coordinate(bucket.theta())?.value;
    let at = |k: usize| {
        let t = motion.times()[k];
        let (sin, cos) = heading.values()[k].sin_cos();
        let push = vec2(resistance(-45.0).at(t), resistance(20.0).at(t));
        let push = vec2(cos * push.x - sin * push.y, sin * push.x + cos * push.y);
        let weight = vec2(0.0, soil(9.0).at(t));
        // A body that turns with ω takes the power (m (a − g)) · v + J α ω.
        let takes = |body: usize, v: &dyn Fn(Vec2) -> Vec2, rate: f64| {
            let (r, a, turning) = &centres[body];
            let solid = solids[body];
            ((a[k] - G) * solid.mass).dot(v(r[k])) + solid.inertia.m33 * turning[k] * rate
        };
        let loads = |v: &dyn Fn(Vec2) -> Vec2| push.dot(v(edge[k])) + weight.dot(v(tip[k]));
        let force = |cylinder: usize| {
            let along = unit(upper[cylinder][k] - lower[cylinder][k]);
            if cylinder < 2 {
                // All that is beyond the pin turns about it.
                let rate = 1.0 / along.dot(across(upper[cylinder][k] - pins[cylinder][k]));
                let v = |p: Vec2| across(p - pins[cylinder][k]) * rate;
                (cylinder..5).map(|body| takes(body, &v, rate)).sum::<f64>() - loads(&v)
            } else {
                // The lever turns about its pin, the bucket so that the rod keeps its length.
                let from = upper[2][k];
                let to = rod_end[k];
                let of_lever = 1.0 / along.dot(across(from - lever_pin[k]));
                let lever_at = |p: Vec2| across(p - lever_pin[k]) * of_lever;
                let line = unit(to - from);
                let of_bucket = line.dot(lever_at(from)) / line.dot(across(to - pins[2][k]));
                let bucket_at = |p: Vec2| across(p - pins[2][k]) * of_bucket;
                let of_rod = across(to - from).dot(bucket_at(to) - lever_at(from))
                    / (to - from).dot(to - from);
                let rod_at = |p: Vec2| lever_at(from) + across(p - from) * of_rod;
                takes(2, &bucket_at, of_bucket)
                    + takes(3, &lever_at, of_lever)
                    + takes(4, &rod_at, of_rod)
                    - loads(&bucket_at)
            }
        };
        [force(0), force(1), force(2)]
    };
    Ok((0..motion.len()).map(at).collect())
}

#[allow(dead_code)] // Tests take the machine and virtual power from here.
fn main() -> kin::Result<()> {
    // 1. Motion and forces.
    let Digger { mechanism: m, bodies, solids } = digger()?;
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 9.0, 901))?;
    println!("{}", motion.summary());
    let [boom, stick, bucket, lever, rod] = bodies;
    motion.add_point("edge", bucket, BUCKET[1])?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;
    let forces = system.forces(&motion)?;
    forces.write_csv(format!("{OUT}/forces.csv"))?;

    // 2. The cylinders beside virtual power.
    let mut efforts = Vec::new();
    for name in CYLINDERS {
        let drive = forces.drive(name)?;
        println!("{name:15}: at most {}, {}", drive.peak(), drive.power().peak());
        efforts.push(drive);
    }
    let by_hand = by_hand(&motion, bodies, solids)?;
    let off = by_hand.iter().enumerate().flat_map(|(k, row)| {
        efforts
            .iter()
            .zip(row)
            .map(move |(drive, by_hand)| (drive.effort().values()[k] - by_hand).abs())
    });
    println!("off virtual power by {:.0e} kN at most", off.fold(0.0, f64::max));
    println!("boom pin: at most {}", forces.reaction("boom pin")?.on(boom)?.magnitude()?.peak());
    println!("{}", forces.balance());

    // 3. Pictures.
    let at = |points: &[(f64, f64)]| points.iter().map(|(x, y)| vec2(*x, *y)).collect::<Vec<_>>();
    let shell = [
        (-0.12, 0.3),
        (0.2, 0.5),
        (0.85, 0.32),
        (1.35, -0.25),
        (1.05, -0.62),
        (0.5, -0.78),
        (0.05, -0.5),
    ];
    let arm = [
        (-0.15, -0.15),
        (2.4, 0.5),
        (5.45, -0.16),
        (5.5, 0.16),
        (2.75, 1.35),
        (2.2, 1.3),
        (-0.2, 0.2),
    ];
    let dipper = [
        (-0.85, 0.15),
        (0.0, -0.2),
        (2.75, -0.14),
        (2.78, 0.14),
        (0.1, 0.7),
        (-0.2, 0.7),
        (-0.85, 0.35),
    ];
    let line = |length: f64| Outline::line([vec2(-length / 2.0, 0.0), vec2(length / 2.0, 0.0)]);
    let tracks = at(&[(-3.3, 0.0), (0.9, 0.0), (1.15, 0.4), (0.9, 0.8), (-3.3, 0.8), (-3.55, 0.4)]);
    let house = at(&[
        (-3.2, 0.95),
        (0.75, 0.95),
        (0.75, 1.3),
        (0.25, 2.0),
        (-0.3, 2.0),
        (-0.3, 3.3),
        (-3.2, 2.1),
    ]);
    let scene = Scene::new(&system)
        .outline(boom, Outline::polygon(at(&arm)))
        .outline(stick, Outline::polygon(at(&dipper)))
        .outline(bucket, Outline::polygon(at(&shell)))
        .outline(lever, line(LEVER))
        .outline(rod, line(ROD))
        .outline(Ground, Outline::polygon(tracks))
        .outline(Ground, Outline::polygon(house))
        .outline(Ground, Outline::line([vec2(-4.2, 0.0), vec2(9.2, 0.0)]))
        .color(boom, "#e69f00")
        .color(stick, "#e69f00")
        .color(bucket, "#8c6239")
        .trace("edge", bucket, BUCKET[1]);
    scene.animated(&motion, 8.0)?.save(format!("{OUT}/animated.svg"))?;
    let mut panels =
        [Panel::over_time("Cylinders", "force"), Panel::over_time("Cylinders", "power")];
    let [mut force, mut power] = [Vec::new(), Vec::new()];
    for (name, drive) in CYLINDERS.iter().zip(&efforts) {
        let short = name.trim_end_matches(" cylinder");
        let [first, second] = panels;
        panels = [first.series(short, drive.effort()), second.series(short, drive.power())];
        force.push((short, drive.effort()));
        power.push((short, drive.power()));
    }
    Figure::new(panels).save(format!("{OUT}/cylinders.svg"))?;
    let page = scene.forces(&forces).page(&motion)?.chart("Forces of the cylinders", force);
    page.chart("Powers of the cylinders", power).save(format!("{OUT}/index.html"))?;
    println!("wrote {OUT}/: motion.csv, forces.csv, index.html, animated.svg, cylinders.svg");
    Ok(())
}
