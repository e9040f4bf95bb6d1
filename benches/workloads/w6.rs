//! W6, derivatives of one joint: C, the structural non-zeros of C_q, and Q_d, from q, q̇ and run-time parameters.
//!
//! The library's way: `#[constraint]` functions called through the `Constraint` trait. By hand: `w6_hand.rs`, cut into the same functions.

use std::hint::black_box;

use kin::prelude::*;
use kin::rt::{At, PlanarState, Rates, SpatialState};

use crate::measure::{Figure, SplitMix64, compare};
use crate::w6_hand as hand;

#[constraint(symbolic)]
fn spherical(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3) -> Vec3 {
    i.point(u_i) - j.point(u_j)
}

#[constraint(symbolic)]
fn universal(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x: Vec3, y: Vec3) -> (Vec3, f64) {
    (i.point(u_i) - j.point(u_j), i.direction(x).dot(j.direction(y)))
}

#[constraint(symbolic)]
fn cylindrical(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d)]
}

/// States of a batch, array of structures.
const BATCH: usize = 1024;

/// One joint of the table: sizes, parameters and the check sum of everything written.
struct Joint {
    name: &'static str,
    n: usize,
    m: usize,
    entries: usize,
    parameters: usize,
    check_sum: f64,
}

/// q and q̇ of a batch one after the other, and the parameters common to all.
struct Input {
    states: Vec<f64>,
    parameters: Vec<f64>,
}

impl Input {
    fn new(joint: &Joint) -> Self {
        let mut random = SplitMix64(12345);
        let mut draw = |count: usize| (0..count).map(|_| random.unit() * 2.0 - 1.0).collect::<Vec<f64>>();
        let (q, qd, parameters) = (draw(BATCH * joint.n), draw(BATCH * joint.n), draw(joint.parameters));
        let states = q.chunks(joint.n).zip(qd.chunks(joint.n)).flat_map(|(q, qd)| q.iter().chain(qd).copied().collect::<Vec<_>>()).collect();
        Input { states, parameters }
    }
}

/// Kin's evaluations: states once, then the two emitted functions.
struct Library {
    constraint: Box<dyn Constraint>,
}

impl Library {
    fn new(constraint: impl Constraint + 'static) -> Self {
        Library { constraint: Box::new(constraint) }
    }

    fn planar(&mut self, input: &Input, output: &mut [f64], m: usize, entries: usize) {
        for (state, out) in input.states.as_chunks::<12>().0.iter().zip(output.chunks_exact_mut(2 * m + entries)) {
            let (q, qd) = state.split_at(6);
            let (i, j) = (PlanarState::new([q[0], q[1], q[2]]), PlanarState::new([q[3], q[4], q[5]]));
            let states = [i.r.x, i.r.y, i.theta, i.sin, i.cos, j.r.x, j.r.y, j.theta, j.sin, j.cos];
            self.evaluate(&At::new(0.0, &states, &[0, 5]), &Rates::new(qd, &[0, 3]), out, m, entries);
        }
    }

    fn spatial(&mut self, input: &Input, output: &mut [f64], m: usize, entries: usize) {
        for (state, out) in input.states.as_chunks::<28>().0.iter().zip(output.chunks_exact_mut(2 * m + entries)) {
            let (q, qd) = state.split_at(14);
            let mut states = [0.0; 32];
            for (place, q) in states.as_chunks_mut::<16>().0.iter_mut().zip(q.as_chunks::<7>().0) {
                *place = SpatialState::new(*q).to_array();
            }
            self.evaluate(&At::new(0.0, &states, &[0, 16]), &Rates::new(qd, &[0, 7]), out, m, entries);
        }
    }

    #[inline]
    fn evaluate(&self, at: &At<'_>, qd: &Rates<'_>, out: &mut [f64], m: usize, entries: usize) {
        let (c, rest) = out.split_at_mut(m);
        let (c_q, q_d) = rest.split_at_mut(entries);
        self.constraint.linearize(at, c, c_q);
        self.constraint.acceleration_rhs(at, qd, 1.0, q_d);
    }
}

fn vec2_at(p: &[f64], k: usize) -> Vec2 {
    vec2(p[k], p[k + 1])
}

fn vec3_at(p: &[f64], k: usize) -> Vec3 {
    vec3(p[k], p[k + 1], p[k + 2])
}

/// The batch by the library and by hand, the same output layout: C, values of C_q by rows, Q_d.
type Route = Box<dyn FnMut(&Input, &mut [f64])>;

fn library(joint: &Joint, parameters: &[f64]) -> Library {
    let p = parameters;
    let (i, j) = (kin::any_planar(), kin::any_planar());
    let (si, sj) = (kin::any_spatial(), kin::any_spatial());
    match joint.name {
        "planar_revolute" => Library::new(revolute(i, j, vec2_at(p, 0), vec2_at(p, 2))),
        "planar_prismatic" => Library::new(prismatic(i, j, vec2_at(p, 0), vec2_at(p, 2), vec2_at(p, 4), p[6])),
        "spherical" => Library::new(spherical(si, sj, vec3_at(p, 0), vec3_at(p, 3))),
        "universal" => Library::new(universal(si, sj, vec3_at(p, 0), vec3_at(p, 3), vec3_at(p, 6), vec3_at(p, 9))),
        _ => Library::new(cylindrical(si, sj, vec3_at(p, 0), vec3_at(p, 3), vec3_at(p, 6), vec3_at(p, 9), vec3_at(p, 12))),
    }
}

fn by_library(joint: &'static Joint, parameters: &[f64]) -> Route {
    let mut library = library(joint, parameters);
    let (m, entries) = (joint.m, joint.entries);
    match joint.n {
        6 => Box::new(move |input, output| library.planar(input, output, m, entries)),
        _ => Box::new(move |input, output| library.spatial(input, output, m, entries)),
    }
}

fn by_hand(joint: &Joint) -> Route {
    match joint.name {
        "planar_revolute" => Box::new(|input, output| hand::planar::<Revolute, 2, 8>(input_of(input), output)),
        "planar_prismatic" => Box::new(|input, output| hand::planar::<Prismatic, 2, 8>(input_of(input), output)),
        "spherical" => Box::new(|input, output| hand::spatial::<Spherical, 3, 30>(input_of(input), output)),
        "universal" => Box::new(|input, output| hand::spatial::<Universal, 4, 38>(input_of(input), output)),
        _ => Box::new(|input, output| hand::spatial::<Cylindrical, 4, 44>(input_of(input), output)),
    }
}

use hand::{Cylindrical, Prismatic, Revolute, Spherical, Universal};

fn input_of(input: &Input) -> (&[f64], &[f64]) {
    (&input.states, &input.parameters)
}

static JOINTS: [Joint; 5] = [
    Joint { name: "planar_revolute", n: 6, m: 2, entries: 8, parameters: 4, check_sum: 2813.75 },
    Joint { name: "planar_prismatic", n: 6, m: 2, entries: 8, parameters: 7, check_sum: -1681.08 },
    Joint { name: "spherical", n: 14, m: 3, entries: 30, parameters: 6, check_sum: 430.222 },
    Joint { name: "universal", n: 14, m: 4, entries: 38, parameters: 12, check_sum: 1153.20 },
    Joint { name: "cylindrical", n: 14, m: 4, entries: 44, parameters: 15, check_sum: -14155.7 },
];

/// Both routes on every joint, interleaved: ns an evaluation, and their ratio.
pub fn run() -> Vec<Figure> {
    let mut figures = Vec::new();
    for joint in &JOINTS {
        let input = Input::new(joint);
        let size = BATCH * (2 * joint.m + joint.entries);
        let (mut ours, mut theirs) = (by_library(joint, &input.parameters), by_hand(joint));
        for (name, route) in [("kin", &mut ours), ("hand", &mut theirs)] {
            let mut output = vec![0.0; size];
            route(&input, &mut output);
            let sum: f64 = output.iter().sum();
            let error = (sum - joint.check_sum).abs() / joint.check_sum.abs();
            assert!(error < 1e-5, "W6 {} by {name}: check sum {sum}, expected {}", joint.name, joint.check_sum);
            figures.push(Figure::new(format!("W6-{}", joint.name), name, "check_sum_error", error));
        }
        let (mut a, mut b) = (vec![0.0; size], vec![0.0; size]);
        let result = compare(
            BATCH,
            || {
                ours(black_box(&input), &mut a);
                black_box(&a);
            },
            || {
                theirs(black_box(&input), &mut b);
                black_box(&b);
            },
        );
        figures.extend(result.figures(&format!("W6-{}", joint.name), "ns_per_eval"));
    }
    figures
}

/// One batch of one route and nothing else, for counting instructions: `W6-planar_revolute kin`.
pub fn once(joint: &str, route: &str, batches: usize) -> Option<()> {
    let joint = JOINTS.iter().find(|j| j.name == joint)?;
    let input = Input::new(joint);
    let mut output = vec![0.0; BATCH * (2 * joint.m + joint.entries)];
    let mut route = if route == "hand" { by_hand(joint) } else { by_library(joint, &input.parameters) };
    (0..batches).for_each(|_| route(black_box(&input), black_box(&mut output)));
    Some(())
}
