//! Random mechanisms, closed by construction at a known pose: assembled from a poor guess and driven; a planted fault is named.

use std::time::{Duration, Instant};

use kin::algebra::Vec3;
use kin::diagnosis::Class;
use kin::prelude::*;
use kin::{Error, SpatialPose};

use crate::models::*;

/// Numbers in (−1, 1), the same for the same seed.
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn below(&mut self, n: usize) -> usize {
        ((self.number() + 1.0) * 0.5 * n as f64) as usize % n
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    None,
    Contradiction,
    Redundancy,
    MissingDriver,
}

const FAULTS: [Fault; 4] = [Fault::None, Fault::Contradiction, Fault::Redundancy, Fault::MissingDriver];

/// How far guesses are off, in lengths and radians.
const OFF: f64 = 0.08;

/// Links driven one by one and dyads between them (two links, three pins), of about the length 1.
fn planar(seed: u64, fault: Fault) -> Mechanism {
    let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let mut m = Mechanism::new("random");
    let mut bodies: Vec<(PlanarBody, [f64; 3])> = Vec::new();
    let mut drivers = Vec::new();
    let units = 2 + random.below(4);
    for unit in 0..units {
        let new = if unit == 0 || random.below(2) == 0 { 1 } else { 2 };
        let first = bodies.len();
        for k in 0..new {
            let exact = [random.number(), random.number(), 3.0 * random.number()];
            let guess = pose(exact[0] + OFF * random.number(), exact[1] + OFF * random.number(), exact[2] + OFF * random.number());
            bodies.push((m.planar(&format!("body {unit}{}", ["", "b"][k]), guess).unwrap(), exact));
        }
        // A world point, and where it is in a body.
        let local = |(_, [x, y, a]): (PlanarBody, [f64; 3]), p: [f64; 2]| {
            let (s, c) = a.sin_cos();
            vec2(c * (p[0] - x) + s * (p[1] - y), -s * (p[0] - x) + c * (p[1] - y))
        };
        let pin = |m: &mut Mechanism, name: &str, other: usize, own: usize, at: [f64; 2]| {
            let (own, u) = (bodies[own].0, local(bodies[own], at));
            match bodies.get(other) {
                Some(&body) => m.add(name, revolute(body.0, own, local(body, at), u)).unwrap(),
                None => m.add(name, revolute(m.ground(), own, vec2(at[0], at[1]), u)).unwrap(),
            };
        };
        let mut earlier = || if first == 0 { usize::MAX } else { random.below(first + 1).wrapping_sub(1) };
        let (i, j) = (earlier(), earlier());
        // Three pins that are far from a line: the dyad is far from its toggles.
        let pins: [[f64; 2]; 3] = std::iter::from_fn(|| Some([0; 3].map(|_| [0.8 * random.number(), 0.8 * random.number()])))
            .find(|[a, b, c]| ((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])).abs() > 0.3)
            .unwrap();
        pin(&mut m, &format!("pin {unit}"), i, first, pins[0]);
        if new == 1 {
            drivers.push((unit, first));
        } else {
            pin(&mut m, &format!("pin {unit}b"), first, first + 1, pins[1]);
            pin(&mut m, &format!("pin {unit}c"), j, first + 1, pins[2]);
        }
    }
    let chosen = drivers[random.below(drivers.len())];
    for &(unit, k) in &drivers {
        if fault == Fault::MissingDriver && chosen.1 == k {
            continue;
        }
        m.add(&format!("motor {unit}"), drive_angle(bodies[k].0, Law::linear(bodies[k].1[2], 0.5))).unwrap();
    }
    let angle = bodies[chosen.1].1[2];
    match fault {
        Fault::Contradiction => m.add("motor x", drive_angle(bodies[chosen.1].0, Law::linear(angle + 0.4, 0.5))).unwrap(),
        Fault::Redundancy => m.add("motor x", drive(bodies[chosen.1].0.theta(), Law::linear(angle, 0.5))).unwrap(),
        Fault::None | Fault::MissingDriver => return m,
    };
    m
}

/// The distance of a point of body i from a point of body j is l.      [m]
#[constraint]
fn rod(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, l: f64) -> f64 {
    (i.point(u_i) - j.point(u_j)).norm() - l
}

/// Hinged bodies with motors, and platforms on six rods.
fn spatial(seed: u64, fault: Fault) -> Mechanism {
    let mut random = Random(seed.wrapping_mul(0xD1B5_4A32_D192_ED03) | 1);
    let mut m = Mechanism::new("random in space");
    let mut bodies: Vec<SpatialBody> = Vec::new();
    let mut poses: Vec<SpatialPose> = Vec::new();
    let mut drivers = Vec::new();
    let vector = |random: &mut Random| Vec3::new(random.number(), random.number(), random.number());
    let inside = |pose: &SpatialPose, p: Vec3| pose.p.rotation().transpose() * (p - pose.r);
    for unit in 0..2 + random.below(2) {
        let (r, axis, angle) = (vector(&mut random), vector(&mut random), 2.0 * random.number());
        let exact = SpatialPose::turned(r, axis, angle);
        let guess = SpatialPose::turned(r + vector(&mut random) * OFF, axis + vector(&mut random) * OFF, angle + OFF * random.number());
        let body = m.spatial(&format!("body {unit}"), guess).unwrap();
        let other = random.below(bodies.len() + 1).checked_sub(1);
        let base = other.map_or(SpatialPose::at(Vec3::new(0.0, 0.0, 0.0)), |k| poses[k]);
        let carrier = other.map_or(SpatialBody::from(m.ground()), |k| bodies[k]);
        if unit == 0 || random.below(2) == 0 {
            let at = vector(&mut random);
            let z = vector(&mut random);
            let z = z * z.norm().recip();
            let x = z.cross(vector(&mut random));
            let x = x * x.norm().recip();
            let turned = |p: Vec3| base.p.rotation().transpose() * p;
            let own = |p: Vec3| exact.p.rotation().transpose() * p;
            let joint = hinge(body, carrier, inside(&exact, at), inside(&base, at), own(z), turned(x), turned(z.cross(x)));
            m.add(&format!("hinge {unit}"), joint).unwrap();
            drivers.push((unit, body, own(x), x, z.cross(x), carrier == SpatialBody::from(m.ground())));
        } else {
            for k in 0..6 {
                let (p, q) = (r + vector(&mut random), vector(&mut random) * 1.5);
                let joint = rod(body, carrier, inside(&exact, p), inside(&base, q), (p - q).norm());
                m.add(&format!("rod {unit}{k}"), joint).unwrap();
            }
        }
        bodies.push(body);
        poses.push(exact);
    }
    let chosen = random.below(drivers.len());
    for (k, &(unit, body, h, x, y, _)) in drivers.iter().enumerate() {
        let motor = |angle: f64| turn(body, h, x, y, Law::linear(angle, 0.2));
        if k != chosen || fault != Fault::MissingDriver {
            m.add(&format!("motor {unit}"), motor(0.0)).unwrap();
        }
        if k == chosen && matches!(fault, Fault::Contradiction | Fault::Redundancy) {
            m.add("motor x", motor(if fault == Fault::Contradiction { 0.4 } else { 0.0 })).unwrap();
        }
    }
    m
}

/// Whether the mechanism does what it should: it runs, or its fault is named.
fn right(mechanism: Mechanism, fault: Fault) -> Result<(), String> {
    let run = mechanism.build().and_then(|system| {
        let motion = system.run([0.0, 0.005, 0.01])?;
        Ok((system.diagnose(0.0)?, motion))
    });
    match (fault, run) {
        (Fault::None, Ok((found, motion))) => {
            let finite = (0..3).all(|k| motion.q(k).iter().chain(motion.qd(k)).chain(motion.qdd(k)).all(|x| x.is_finite()));
            (finite && found.is_exactly_constrained()).then_some(()).ok_or(found.to_string())
        }
        (Fault::Redundancy, Ok((found, _))) => {
            let named = found.redundancies().any(|set| set.terms.iter().any(|term| term.constraint == "motor x"));
            (named && found.can_be_driven()).then_some(()).ok_or(found.to_string())
        }
        (Fault::Contradiction, Err(error)) => {
            let Some(found) = error.diagnosis() else { return Err(error.to_string()) };
            let named = found.gaps.iter().any(|gap| gap.constraint.starts_with("motor"));
            let set = found
                .dependencies
                .iter()
                .any(|set| matches!(set.class, Class::Contradictory { .. }) && set.terms.iter().any(|term| term.constraint == "motor x"));
            (named && set).then_some(()).ok_or(error.to_string())
        }
        (Fault::MissingDriver, Err(Error::CannotBeDriven { diagnosis, .. })) => {
            (diagnosis.lasting_freedoms().count() == 1).then_some(()).ok_or(diagnosis.to_string())
        }
        (_, Ok((found, _))) => Err(format!("ran: {found}")),
        (_, Err(error)) => Err(error.to_string()),
    }
}

/// At least 99 of 100 do, within the time.
fn all_right(name: &str, count: u64, make: fn(u64, Fault) -> Mechanism) {
    let begun = Instant::now();
    let mut wrong = Vec::new();
    for fault in FAULTS {
        for seed in 0..count {
            if let Err(text) = right(make(seed, fault), fault) {
                wrong.push(format!("{name} {seed} {fault:?}: {text}"));
            }
        }
    }
    println!("{name}: {} of {} wrong in {:?}\n{}", wrong.len(), 4 * count, begun.elapsed(), wrong.join("\n"));
    assert!(wrong.len() as u64 * 100 <= 4 * count, "{} of {}\n{}", wrong.len(), 4 * count, wrong.join("\n"));
    assert!(begun.elapsed() < Duration::from_secs(240));
}

#[test]
fn planar_mechanisms_run_or_their_fault_is_named() {
    all_right("planar", 25, planar);
}

#[test]
fn spatial_mechanisms_run_or_their_fault_is_named() {
    all_right("spatial", 8, spatial);
}
