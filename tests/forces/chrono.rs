//! Tables of Chrono's joint tests, which ADAMS computed: their positions, rates and accelerations
//! are given as states. They are another project's and not kept here: `KIN_OUTSIDE` names the
//! folder that holds them.

use kin::prelude::*;
use kin::{Mechanism, loads};
use serde_json::Value;

use super::data::{array, number, numbers, rows};

/// Six digits are printed of forces up to 28 N.
const PRINTED: f64 = 2e-4;

/// The torque of the second spring, and the damper.      [N m]
#[force]
fn progressive(x: Coord, rate: Rate) -> f64 {
    -(50.0 + 10.0 * x.abs()) * x - 10.0 * rate
}

/// The turn of the bar of the cross that body i holds, about that of body j.      [rad]
#[constraint]
fn turn_of_the_bar(i: Spatial, j: Spatial, h_i: Vec3, h_j: Axis) -> f64 {
    let bar = i.direction(h_i);
    bar.dot(j.direction(h_j.g)).atan2(bar.dot(j.direction(h_j.f)))
}

struct Table {
    file: Value,
    m: Mechanism,
    body: SpatialBody,
    /// The matrix of the body at the first time.
    a: Mat3,
}

fn v3(v: &[f64]) -> Vec3 {
    vec3(v[0], v[1], v[2])
}

fn p(v: &[f64]) -> EulerParameters {
    EulerParameters::new(v[0], v[1], v[2], v[3]).normalize()
}

fn table(name: &str) -> Option<Table> {
    let Some(folder) = std::env::var_os("KIN_OUTSIDE") else {
        println!("note: KIN_OUTSIDE names no folder of Chrono's tables: nothing is compared");
        return None;
    };
    let path = std::path::Path::new(&folder).join(format!("forces/chrono_{name}.json"));
    let text = std::fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let file: Value = serde_json::from_str(&text).expect("JSON");
    let r = v3(&rows(&file["series"], "r")[0]);
    let turn = p(&rows(&file["series"], "quaternion")[0]);
    let mut m = Mechanism::new(name);
    let body = m.spatial("body", SpatialPose::new(r, turn)).expect("a body");
    let [x, y, z] = array::<3>(&file, "inertia_principal");
    let inertia = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
    m.mass(body, number(&file, "mass"), vec3(0.0, 0.0, 0.0), inertia).expect("a mass");
    m.gravity(Vec3::from(array::<3>(&file, "gravity")));
    Some(Table { file, m, body, a: turn.rotation() })
}

impl Table {
    fn vector(&self, field: &str) -> Vec3 {
        Vec3::from(array::<3>(&self.file, field))
    }

    /// An axis along which the joint turns or slides: in the body, and on the ground.
    fn axes(&self) -> [Axis; 2] {
        let own = Axis::along(self.vector("axis"));
        [Axis::new(self.a.transpose() * own.h, self.a.transpose() * own.f), own]
    }

    /// The states as they were recorded: ṗ = ½ (0, ω) p.
    fn states(&self, system: &System) -> Motion {
        let series = |field: &str| rows(&self.file["series"], field);
        let [r, v, a, w, alpha] = ["r", "v", "a", "omega", "alpha"].map(series);
        let times = numbers(&self.file, "times");
        let turn = series("quaternion");
        let mut q = Vec::new();
        let mut qd = Vec::new();
        let mut qdd = Vec::new();
        for k in 0..times.len() {
            let half = |w: &[f64]| EulerParameters::new(0.0, 0.5 * w[0], 0.5 * w[1], 0.5 * w[2]);
            let p = p(&turn[k]);
            let pd = half(&w[k]).product(p);
            let pdd = half(&alpha[k]).product(p) + half(&w[k]).product(pd);
            let all = |r: &[f64], p: EulerParameters| [r, &[p.e0, p.e1, p.e2, p.e3]].concat();
            q.push(all(&r[k], p));
            qd.push(all(&v[k], pd));
            qdd.push(all(&a[k], pdd));
        }
        Motion::from_states(system, &times, &q, &qd, &qdd).expect("a motion")
    }

    /// The wrench of the joint, and of loads in it, on the ground; nothing that drives a free turn
    /// gives anything.
    fn check(&self, joint: &str, free: &[&str], loads: &[&str]) {
        let system = self.m.clone().build().expect("a system");
        let motion = self.states(&system);
        let forces = system.forces(&motion).expect("forces");
        let ground = SpatialBody::from(self.m.ground());
        let at = self.vector("joint_point");
        let on_ground = |reaction: kin::forces::Reaction<'_>| {
            let acted = reaction.on(ground).expect("the ground").about(at);
            (acted.force().expect("unique"), acted.torque().expect("unique"))
        };
        let mut all = vec![on_ground(forces.reaction(joint).expect("a joint"))];
        all.extend(loads.iter().map(|load| on_ground(forces.load(load).expect("a load"))));
        let exact = &self.file["reactions"][0];
        let force = rows(exact, "force");
        let torque = rows(exact, "torque");
        let mut off = 0.0_f64;
        let mut largest = 0.0_f64;
        for k in 0..motion.len() {
            let mut f = Vec3::zeros();
            let mut t = Vec3::zeros();
            for (force, torque) in &all {
                f += force[k];
                t += torque[k];
            }
            off = off.max((f - v3(&force[k])).norm()).max((t - v3(&torque[k])).norm());
            largest = largest.max(f.norm()).max(t.norm());
        }
        let effort = |name: &&str| forces.drive(name).expect("a driver").peak().value.abs();
        let free = free.iter().map(effort).fold(0.0, f64::max);
        if let Some(efforts) = self.file["drivers"][0]["effort"].as_array() {
            let found = forces.drive("drive").expect("a driver").effort().values().to_vec();
            for (found, exact) in found.iter().zip(efforts) {
                off = off.max((found - exact.as_f64().expect("a number")).abs());
                largest = largest.max(found.abs());
            }
        }
        println!("{}: off by {off:.1e} of {largest:.3}, free turns {free:.1e}", self.m.name());
        assert!(largest > 1.0 && off < PRINTED && free < PRINTED, "{off:e} {free:e}");
    }
}

#[test]
fn linear_actuators() {
    for name in ["linactuator_case01", "linactuator_case02"] {
        let Some(mut table) = table(name) else { return };
        let [own, fixed] = table.axes();
        let o = vec3(0.0, 0.0, 0.0);
        let ground = table.m.ground();
        let p_ij = EulerParameters::from_rotation(table.a);
        let at = table.vector("joint_point");
        let speed = number(&table.file, "speed");
        table
            .m
            .add("joint", spatial::prismatic(table.body, ground, o, at, own, p_ij))
            .expect("a joint");
        let drive = kin::joints::drivers::spatial::drive_slide(
            table.body,
            ground,
            o,
            at,
            fixed,
            Law::ramp(speed),
        );
        table.m.add("drive", drive).expect("a driver");
        table.check("joint", &[], &[]);
    }
}

/// A body on a hinge that nothing drives, with a load on its turn.
fn hinged(name: &str, load: Option<fn(loads::spatial::turn) -> kin::Load>) {
    let Some(mut table) = table(name) else { return };
    let [own, fixed] = table.axes();
    let ground = table.m.ground();
    let at = table.vector("joint_point");
    let u = table.m.local(table.body, at).expect("a point");
    table
        .m
        .add("joint", spatial::revolute(table.body, ground, u, at, own, fixed.h))
        .expect("a joint");
    let free = spatial::drive_turn(table.body, ground, own, fixed, Law::constant(0.0));
    table.m.add("free", free).expect("a driver");
    if let Some(load) = load {
        let turn = loads::spatial::turn(table.body, ground, own, fixed);
        table.m.load("spring", load(turn)).expect("a load");
    }
    table.check("joint", &["free"], if load.is_some() { &["spring"] } else { &[] });
}

#[test]
fn a_pendulum_on_a_hinge() {
    hinged("revolute_case02", None);
}

#[test]
fn torsion_springs() {
    hinged("rotspring_case01", Some(|x| loads::spring_damper(x, 200.0, 0.0, 10.0)));
    hinged("rotspring_case02", Some(progressive));
}

#[test]
fn a_pendulum_on_a_cross() {
    let Some(mut table) = table("universal_case03") else { return };
    let bar = table.vector("axis_body");
    let held = table.vector("axis_ground");
    let ground = table.m.ground();
    let o = vec3(0.0, 0.0, 0.0);
    let u = table.m.local(table.body, vec3(0.0, 0.0, 0.0)).expect("a point");
    let body = table.body;
    table.m.add("joint", spatial::universal(body, ground, u, o, bar, held)).expect("a joint");
    table.m.add("free", turn_of_the_bar(body, ground, bar, held)).expect("a turn");
    let other = turn_of_the_bar(ground, body, held, bar);
    table.m.add("free too", other).expect("a turn");
    table.check("joint", &[], &[]);
    let system = table.m.clone().build().expect("a system");
    let motion = table.states(&system);
    let forces = system.forces(&motion).expect("forces");
    for free in ["free", "free too"] {
        let torque =
            forces.reaction(free).expect("a turn").on(body).expect("on it").torque_magnitude();
        assert!(torque.expect("unique").max() < PRINTED);
    }
}
