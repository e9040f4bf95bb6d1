use kin::Vec3;
use kin::diagnosis::{How, Persistence};
use kin::prelude::*;
use kin::{SpatialPose, linspace};

use crate::engines::Engines;

use crate::models::*;

fn v(x: f64, y: f64, z: f64) -> Vec3 {
    Vec3::new(x, y, z)
}

/// Denavit–Hartenberg step: along x by a, then turned about x by alpha; from a frame with z its
/// joint axis, turned about z by theta first.
#[derive(Clone, Copy)]
struct Frame {
    r: Vec3,
    x: Vec3,
    z: Vec3,
}

impl Frame {
    fn y(&self) -> Vec3 {
        self.z.cross(self.x)
    }

    fn next(&self, theta: f64, a: f64, alpha: f64) -> Frame {
        let x = self.x * theta.cos() + self.y() * theta.sin();
        let y = self.z.cross(x);
        Frame { r: self.r + x * a, x, z: self.z * alpha.cos() + y * alpha.sin() }
    }
}

/// Bennett's four-bar: links a, b, a, b with twists α, β, α, β and a sin β = b sin α. The joint
/// angles follow from the first by tan(θ1/2) tan(θ2/2) = sin((α + β)/2) / sin((β − α)/2) and θ3 =
/// −θ1, θ4 = −θ2.
struct Bennett {
    system: kin::System,
    bodies: Vec<kin::SpatialBody>,
}

const A: f64 = 1.0;
const ALPHA: f64 = 0.6;
const BETA: f64 = 1.1;

fn b() -> f64 {
    A * BETA.sin() / ALPHA.sin()
}

fn second_angle(theta1: f64) -> f64 {
    let k = (0.5 * (BETA + ALPHA)).sin() / (0.5 * (BETA - ALPHA)).sin();
    2.0 * (k / (0.5 * theta1).tan()).atan()
}

/// The frames of the four joints when the first angle is theta1; the fifth is the first again.
fn frames(theta1: f64) -> [Frame; 5] {
    let theta2 = second_angle(theta1);
    let first = Frame { r: v(0.0, 0.0, 0.0), x: v(1.0, 0.0, 0.0), z: v(0.0, 0.0, 1.0) };
    let second = first.next(theta1, A, ALPHA);
    let third = second.next(theta2, b(), BETA);
    let fourth = third.next(-theta1, A, ALPHA);
    [first, second, third, fourth, fourth.next(-theta2, b(), BETA)]
}

fn bennett(error: f64) -> Bennett {
    let start = 1.0;
    let frames = frames(start);
    let mut m = Mechanism::new("Bennett");
    // Body k reaches from joint k to joint k + 1; at the start all body frames are the global one:
    // local positions are global ones.
    let wobble = |k: usize| error * (1.0 + k as f64).sin();
    let bodies: Vec<_> = (0..3)
        .map(|k| {
            m.spatial(
                &format!("link {}", k + 1),
                SpatialPose::turned(
                    v(wobble(k), wobble(k + 3), -wobble(k + 5)),
                    v(1.0, 2.0, 0.5),
                    wobble(k),
                ),
            )
            .unwrap()
        })
        .collect();
    for k in 0..4 {
        let Frame { r, x, z } = frames[k];
        let name = format!("J{}", k + 1);
        let y = z.cross(x);
        match k {
            0 => m.add(&name, hinge(bodies[0], m.ground(), r, r, z, x, y)).unwrap(),
            3 => m.add(&name, hinge(bodies[2], m.ground(), r, r, z, x, y)).unwrap(),
            _ => m.add(&name, hinge(bodies[k - 1], bodies[k], r, r, z, x, y)).unwrap(),
        };
    }
    // The x-axis of the first link turns by t.
    m.add(
        "motor",
        turn(bodies[0], v(1.0, 0.0, 0.0), v(1.0, 0.0, 0.0), v(0.0, 1.0, 0.0), Law::ramp(1.0)),
    )
    .unwrap();
    Bennett { system: m.build().unwrap(), bodies }
}

#[test]
fn frames_of_bennett_close() {
    for theta in [0.3, 1.0, 2.0, -1.5] {
        let [first, .., last] = frames(theta);
        assert!((first.r - last.r).norm() < 1e-12 && (first.z - last.z).norm() < 1e-12, "{theta}");
    }
}

#[test]
fn four_bar_of_five_row_revolutes_has_three_redundant_equations() {
    let found = bennett(0.0).system.diagnose(0.0).unwrap();
    println!("{found}");
    assert_eq!(
        (found.coordinates, found.equations, found.rank, found.nearby_rank),
        (21, 24, 21, 21)
    );
    assert_eq!((found.gruebler, found.mobility), (-2, 1));
    assert_eq!(found.redundancies().count(), 3);
    assert!(found.can_be_driven() && found.freedoms.is_empty());
}

/// Positions by Denavit–Hartenberg's frames; velocities and accelerations by their differences.
#[test]
fn bennett_runs_through_a_turn() {
    let Bennett { system, bodies } = bennett(0.05);
    let times = linspace(0.0, 5.0, 501);
    let motion = system.run_both(&times).unwrap();
    // A point of link 2 at its second joint, and one 0.5 along that joint's axis.
    let at = frames(1.0)[2];
    let point = |t: f64| {
        let frame = frames(1.0 + t)[2];
        frame.r + frame.z * 0.5
    };
    let u = at.r + at.z * 0.5;
    let h = 1e-4;
    for (k, t) in times.iter().enumerate() {
        let q = motion.q(k);
        let exact = point(*t);
        let first = 7;
        let state =
            kin::extend::state::SpatialState::<f64>::new(std::array::from_fn(|i| q[first + i]));
        assert!((state.point(u) - exact).norm() < 1e-10, "position at {t}");
        let rate = |q: &[f64], qd: &[f64], s: f64| {
            kin::extend::state::SpatialState::<f64>::new(std::array::from_fn(|i| {
                q[first + i] + s * qd[first + i]
            }))
            .point(u)
        };
        let velocity = (rate(q, motion.qd(k), h) - rate(q, motion.qd(k), -h)) * (0.5 / h);
        let exact = (point(t + h) - point(t - h)) * (0.5 / h);
        assert!((velocity - exact).norm() < 1e-6, "velocity at {t}");
    }
    // Accelerations are the differences of velocities.
    for k in (1..500).step_by(37) {
        for j in 0..21 {
            let difference =
                (motion.qd(k + 1)[j] - motion.qd(k - 1)[j]) / (times[k + 1] - times[k - 1]);
            assert!(
                (difference - motion.qdd(k)[j]).abs() < 2e-3 * (1.0 + difference.abs()),
                "acceleration {j} at {}",
                times[k]
            );
        }
    }
    let _ = bodies;
}

#[test]
fn rod_between_two_spherical_joints_spins_idly() {
    let mut m = Mechanism::new("rod");
    let crank = m.spatial("crank", SpatialPose::at(v(0.0, 0.0, 0.0))).unwrap();
    let rod = m.spatial("rod", SpatialPose::at(v(1.0, 0.5, 0.2))).unwrap();
    m.add(
        "O",
        hinge(
            crank,
            m.ground(),
            v(0.0, 0.0, 0.0),
            v(0.0, 0.0, 0.0),
            v(0.0, 0.0, 1.0),
            v(1.0, 0.0, 0.0),
            v(0.0, 1.0, 0.0),
        ),
    )
    .unwrap();
    m.add("A", ball(crank, rod, v(1.0, 0.0, 0.0), v(0.0, -0.5, -0.2))).unwrap();
    m.add("B", ball(rod, m.ground(), v(0.0, 0.5, 0.2), v(1.0, 1.0, 0.4))).unwrap();
    let found = m.diagnose(0.0).unwrap();
    println!("{found}");
    // O leaves one freedom, A and B take it (the point A must stay at its distance from B) but not
    // the spin of the rod.
    assert_eq!((found.coordinates, found.equations, found.rank), (14, 13, 13));
    let [spin] = &found.freedoms[..] else { panic!("{found}") };
    assert_eq!(spin.persistence, Persistence::Always);
    assert_eq!(spin.motions[0].names, ["rod"]);
    let How::Screws { axis, pitch, .. } = spin.motions[0].how else { panic!("{found}") };
    let exact = v(0.0, 1.0, 0.4) * v(0.0, 1.0, 0.4).norm().recip();
    assert!(v(axis[0], axis[1], axis[2]).cross(exact).norm() < 1e-9 && pitch == 0.0, "{axis:?}");
}
