//! W6, derivatives of one joint: C, the structural non-zeros of C_q, and Q_d, from q, q̇ and
//! run-time parameters.
//!
//! The library's way: `#[constraint]` functions called through the `Constraint` trait. By hand:
//! `hand/`, cut into the same functions.

use std::hint::black_box;
use std::time::Duration;

use kin::emitted::{At, Offsets, PlanarState, Rates};
use kin::prelude::*;

use crate::hand::planar_joints::{self, Prismatic, Revolute};
use crate::hand::spatial_joints::{self, Cylindrical, Spherical, Universal};
use crate::measure::{Contestant, Figure, SplitMix64, race};

// The planar two are in the library too; here, like the others, they are compiled with the loop
// that calls them, as those by hand are.
#[constraint(symbolic)]
fn planar_revolute(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> Vec2 {
    i.point(u_i) - j.point(u_j)
}

#[constraint(symbolic)]
fn planar_prismatic(
    i: Planar,
    j: Planar,
    u_i: Vec2,
    u_j: Vec2,
    h_i: Vec2,
    theta0: f64,
) -> (f64, f64) {
    (i.theta - j.theta - theta0, h_i.dot(u_i) + i.direction(h_i).dot(i.r - j.point(u_j)))
}

#[constraint(symbolic)]
fn spherical(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3) -> Vec3 {
    i.point(u_i) - j.point(u_j)
}

#[constraint(symbolic)]
fn universal(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x: Vec3, y: Vec3) -> (Vec3, f64) {
    (i.point(u_i) - j.point(u_j), i.direction(x).dot(j.direction(y)))
}

#[constraint(symbolic)]
fn cylindrical(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    x1: Vec3,
    x2: Vec3,
    w: Vec3,
) -> [f64; 4] {
    let x1 = i.direction(x1);
    let x2 = i.direction(x2);
    let w = j.direction(w);
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

impl Joint {
    /// How many numbers a batch writes.
    fn outputs(&self) -> usize {
        BATCH * (2 * self.m + self.entries)
    }
}

/// q and q̇ of a batch one after the other, and the parameters common to all.
struct Input {
    states: Vec<f64>,
    parameters: Vec<f64>,
}

impl Input {
    fn new(joint: &Joint) -> Self {
        let mut random = SplitMix64(12345);
        let mut draw =
            |count: usize| (0..count).map(|_| random.unit() * 2.0 - 1.0).collect::<Vec<f64>>();
        let q = draw(BATCH * joint.n);
        let qd = draw(BATCH * joint.n);
        let parameters = draw(joint.parameters);
        let states = q
            .chunks(joint.n)
            .zip(qd.chunks(joint.n))
            .flat_map(|(q, qd)| q.iter().chain(qd).copied().collect::<Vec<_>>())
            .collect();
        Input { states, parameters }
    }
}

/// Kin's evaluations: states once, then the two emitted functions.
struct Library<C> {
    constraint: C,
}

impl<C: Constraint + 'static> Library<C> {
    fn planar<const M: usize, const E: usize>(&self, input: &Input, output: &mut [f64]) {
        for (state, out) in
            input.states.as_chunks::<12>().0.iter().zip(output.chunks_exact_mut(2 * M + E))
        {
            let Some((q, [qd])) = state.as_chunks::<6>().0.split_first() else { return };
            let i = PlanarState::new([q[0], q[1], q[2]]);
            let j = PlanarState::new([q[3], q[4], q[5]]);
            let states = [i.r.x, i.r.y, i.theta, i.sin, i.cos, j.r.x, j.r.y, j.theta, j.sin, j.cos];
            evaluate::<M, E, 10, 6>(&self.constraint, &states, qd, out);
        }
    }

    fn spatial<const M: usize, const E: usize>(&self, input: &Input, output: &mut [f64]) {
        for (state, out) in
            input.states.as_chunks::<28>().0.iter().zip(output.chunks_exact_mut(2 * M + E))
        {
            // The state of a spatial body is its coordinates.
            let Some((q, [qd])) = state.as_chunks::<14>().0.split_first() else { return };
            evaluate::<M, E, 14, 14>(&self.constraint, q, qd, out);
        }
    }
}

#[inline]
fn evaluate<const M: usize, const E: usize, const S: usize, const N: usize>(
    constraint: &impl Constraint,
    states: &[f64; S],
    qd: &[f64; N],
    out: &mut [f64],
) {
    let Some((c, rest)) = out.split_first_chunk_mut::<M>() else { return };
    let Some((c_q, q_d)) = rest.split_first_chunk_mut::<E>() else { return };
    let Some(q_d) = q_d.first_chunk_mut::<M>() else { return };
    linearize(constraint, states, c, c_q);
    right_side(constraint, states, qd, q_d);
}

/// Cut as by hand: two functions that are not inlined into the loop.
#[inline(never)]
fn linearize<const M: usize, const E: usize, const S: usize>(
    constraint: &impl Constraint,
    states: &[f64; S],
    c: &mut [f64; M],
    c_q: &mut [f64; E],
) {
    constraint.linearize(
        &At::new(0.0, states, &[Offsets::new(0, 0), Offsets::new(S as u32 / 2, 0)]),
        c,
        c_q,
    );
}

#[inline(never)]
fn right_side<const M: usize, const S: usize, const N: usize>(
    constraint: &impl Constraint,
    states: &[f64; S],
    qd: &[f64; N],
    q_d: &mut [f64; M],
) {
    let arguments = [Offsets::new(0, 0), Offsets::new(S as u32 / 2, N as u32 / 2)];
    constraint.acceleration_rhs(
        &At::new(0.0, states, &arguments),
        &Rates::new(qd, &arguments),
        1.0,
        q_d,
    );
}

fn vec2_at(p: &[f64], k: usize) -> Vec2 {
    vec2(p[k], p[k + 1])
}

fn vec3_at(p: &[f64], k: usize) -> Vec3 {
    vec3(p[k], p[k + 1], p[k + 2])
}

/// The batch by the library and by hand, the same output layout: C, values of C_q by rows, Q_d.
type Route = Box<dyn FnMut(&Input, &mut [f64])>;

fn planar<C: Constraint + 'static>(constraint: C) -> Route {
    let library = Library { constraint };
    Box::new(move |input, out| library.planar::<2, 8>(input, out))
}

fn spatial<C: Constraint + 'static, const M: usize, const E: usize>(constraint: C) -> Route {
    let library = Library { constraint };
    Box::new(move |input, out| library.spatial::<M, E>(input, out))
}

fn by_library(joint: &Joint, p: &[f64]) -> Route {
    let i = kin::check::any_planar();
    let j = kin::check::any_planar();
    let si = kin::check::any_spatial();
    let sj = kin::check::any_spatial();
    match joint.name {
        "planar_revolute" => planar(planar_revolute(i, j, vec2_at(p, 0), vec2_at(p, 2))),
        "planar_prismatic" => {
            planar(planar_prismatic(i, j, vec2_at(p, 0), vec2_at(p, 2), vec2_at(p, 4), p[6]))
        }
        "spherical" => spatial::<_, 3, 30>(spherical(si, sj, vec3_at(p, 0), vec3_at(p, 3))),
        "universal" => spatial::<_, 4, 38>(universal(
            si,
            sj,
            vec3_at(p, 0),
            vec3_at(p, 3),
            vec3_at(p, 6),
            vec3_at(p, 9),
        )),
        _ => spatial::<_, 4, 44>(cylindrical(
            si,
            sj,
            vec3_at(p, 0),
            vec3_at(p, 3),
            vec3_at(p, 6),
            vec3_at(p, 9),
            vec3_at(p, 12),
        )),
    }
}

fn by_hand(joint: &Joint) -> Route {
    match joint.name {
        "planar_revolute" => Box::new(|input, out| {
            planar_joints::batch::<Revolute>(&input.states, &input.parameters, out)
        }),
        "planar_prismatic" => Box::new(|input, out| {
            planar_joints::batch::<Prismatic>(&input.states, &input.parameters, out)
        }),
        "spherical" => Box::new(|input, out| {
            spatial_joints::batch::<Spherical, 3, 30>(&input.states, &input.parameters, out)
        }),
        "universal" => Box::new(|input, out| {
            spatial_joints::batch::<Universal, 4, 38>(&input.states, &input.parameters, out)
        }),
        _ => Box::new(|input, out| {
            spatial_joints::batch::<Cylindrical, 4, 44>(&input.states, &input.parameters, out)
        }),
    }
}

static JOINTS: [Joint; 5] = [
    Joint { name: "planar_revolute", n: 6, m: 2, entries: 8, parameters: 4, check_sum: 2813.75 },
    Joint { name: "planar_prismatic", n: 6, m: 2, entries: 8, parameters: 7, check_sum: -1681.08 },
    Joint { name: "spherical", n: 14, m: 3, entries: 30, parameters: 6, check_sum: 430.222 },
    Joint { name: "universal", n: 14, m: 4, entries: 38, parameters: 12, check_sum: 1153.20 },
    Joint { name: "cylindrical", n: 14, m: 4, entries: 44, parameters: 15, check_sum: -14155.7 },
];

/// Names of its parts.
pub fn names() -> impl Iterator<Item = String> {
    JOINTS.iter().map(|joint| format!("W6-{}", joint.name))
}

/// Both routes on every joint, or on the one that is named: check sums, ns an evaluation, and their
/// ratio.
pub fn run(name: &str, budget: Duration) -> Vec<Figure> {
    let wanted = |joint: &&Joint| name == "W6" || name.strip_prefix("W6-") == Some(joint.name);
    JOINTS.iter().filter(wanted).flat_map(|joint| run_joint(joint, budget)).collect()
}

fn run_joint(joint: &'static Joint, budget: Duration) -> Vec<Figure> {
    let input = Input::new(joint);
    let mut routes = [("hand", by_hand(joint)), ("kin", by_library(joint, &input.parameters))];
    let figure = |peer: &str, metric: &str, value| {
        Figure::new(format!("W6-{}", joint.name), peer, metric, value)
    };
    let mut figures: Vec<Figure> = routes
        .iter_mut()
        .map(|(peer, route)| figure(peer, "max_error", verify(joint, peer, route, &input)))
        .collect();
    let contestant = |(peer, route)| Contestant { peer, run: repeated(joint, route, &input) };
    let mut contestants: Vec<Contestant<'_>> = routes.into_iter().map(contestant).collect();
    for result in race(&mut contestants, budget) {
        let time = result.nanoseconds / BATCH as f64;
        eprintln!(
            "{:>10} {:<14} {time:>12.1} ns an evaluation, {:.3} of hand-written ({})",
            "W6", result.peer, result.ratio, joint.name
        );
        figures.push(figure(result.peer, "ns_per_eval", time));
        figures.extend(
            (result.peer != "hand").then(|| figure(result.peer, "ratio_to_hand", result.ratio)),
        );
    }
    figures
}

fn repeated<'a>(joint: &Joint, mut route: Route, input: &'a Input) -> Box<dyn FnMut() + 'a> {
    let mut output = vec![0.0; joint.outputs()];
    Box::new(move || route(black_box(input), black_box(&mut output)))
}

/// The relative error of the check sum.
fn verify(joint: &Joint, peer: &str, route: &mut Route, input: &Input) -> f64 {
    let mut output = vec![0.0; joint.outputs()];
    route(input, &mut output);
    let sum: f64 = output.iter().sum();
    let error = (sum - joint.check_sum).abs() / joint.check_sum.abs();
    assert!(
        error < 1e-5,
        "W6 {} by {peer}: check sum {sum}, expected {}",
        joint.name,
        joint.check_sum
    );
    error
}

/// Batches of one route and nothing else, for counting instructions.
pub fn once(name: &str, peer: &str, batches: usize) -> Option<()> {
    let joint = JOINTS.iter().find(|joint| name.strip_prefix("W6-") == Some(joint.name))?;
    let input = Input::new(joint);
    let route = match peer {
        "hand" => by_hand(joint),
        "kin" => by_library(joint, &input.parameters),
        _ => return None,
    };
    let mut run = repeated(joint, route, &input);
    (0..batches).for_each(|_| run());
    Some(())
}
