//! W8, constraints as users write them, with loops, tables, branches and inverse functions: C, the
//! structural non-zeros of C_q, and Q_d of one constraint, from q, q̇ and run-time parameters.
//!
//! By `#[constraint]`, and by hand in the same two functions (`hand/kernels.rs`). Every number of
//! both is compared before they are timed.

use std::hint::black_box;
use std::time::Duration;

use kin::emitted::{At, Offsets, Rates};
use kin::prelude::*;

use crate::hand::kernels::{Arm, Belt, Chain, Kernel, Platform, Spline, Table};
use crate::measure::{Contestant, Figure, SplitMix64, race};

#[constraint(symbolic)]
fn spline(x: Coord, y: Coord, knots: [f64; 21], pieces: [[f64; 4]; 20]) -> f64 {
    let piece = |k: usize| {
        let [a, b, c, d] = pieces[k];
        let s = x - knots[k];
        a + s * (b + s * (c + s * d))
    };
    for k in 0..19 {
        if x < knots[k + 1] {
            return y - piece(k);
        }
    }
    y - piece(19)
}

/// A spline whose numbers stand in the function, of so many pieces.
macro_rules! table {
    ($name:ident, $n:literal) => {
        #[constraint(symbolic)]
        fn $name(x: Coord, y: Coord) -> f64 {
            let knots: [f64; $n] = std::array::from_fn(|k| 2.0 * k as f64 / $n as f64 - 1.0);
            let pieces: [[f64; 4]; $n] = std::array::from_fn(|k| {
                [37 * k % 101, 53 * k % 103, 29 * k % 97, 41 * k % 89]
                    .map(|c| c as f64 / 50.0 - 1.0)
            });
            let piece = |k: usize| {
                let [a, b, c, d] = pieces[k];
                let s = x - knots[k];
                a + s * (b + s * (c + s * d))
            };
            for k in 0..$n - 1 {
                if x < knots[k + 1] {
                    return y - piece(k);
                }
            }
            y - piece($n - 1)
        }
    };
}

table!(table20, 20);
table!(table200, 200);

#[constraint(symbolic)]
fn belt(x: Coord, r: f64, s: f64, length: f64) -> f64 {
    let c = x + 4.0;
    let beta = ((r - s) / c).asin();
    let pi = std::f64::consts::PI;
    let arcs = 2.0 * beta;
    2.0 * c * beta.cos() + r * (pi + arcs) + s * (pi - arcs) - length
}

#[constraint(symbolic)]
fn arm(q: [Coord; 5], lengths: [f64; 5], target: Vec2) -> Vec2 {
    let mut angle = 0.0;
    let mut tip = -target;
    for k in 0..5 {
        angle += q[k];
        tip += lengths[k] * vec2(angle.cos(), angle.sin());
    }
    tip
}

#[constraint(symbolic)]
fn chain(q: [Coord; 6], links: [[f64; 3]; 6], target: Vec3) -> Vec3 {
    let mut turn = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut tip = -target;
    for k in 0..6 {
        let [a, d, alpha] = links[k];
        let (s, c) = q[k].sin_cos();
        let (sa, ca) = alpha.sin_cos();
        let step = [[c, -s * ca, s * sa], [s, c * ca, -c * sa], [0.0, sa, ca]];
        let arm = [a * c, a * s, d];
        let mut next = [[0.0; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                tip[i] += turn[i][j] * arm[j];
                for l in 0..3 {
                    next[i][j] += turn[i][l] * step[l][j];
                }
            }
        }
        turn = next;
    }
    tip
}

#[constraint(symbolic)]
fn platform(body: Spatial, legs: [Coord; 6], pins: [Vec3; 6], bases: [Vec3; 6]) -> [f64; 6] {
    std::array::from_fn(|k| (body.point(pins[k]) - bases[k]).norm_squared() - legs[k].powi(2))
}

/// States of a batch.
const BATCH: usize = 256;

/// One constraint, by both routes.
struct Work {
    name: &'static str,
    /// The numbers of a state of each argument, and its coordinates.
    arguments: Vec<[usize; 2]>,
    by_macro: Box<dyn Constraint>,
    by_hand: Box<dyn Kernel>,
}

const COORD: [usize; 2] = [3, 1];
const SPATIAL: [usize; 2] = [7, 7];

fn works() -> Vec<Work> {
    tables().into_iter().chain(others()).collect()
}

/// Tables of constants.
fn tables() -> [Work; 2] {
    let of = |name, by_macro, by_hand| Work { name, arguments: vec![COORD; 2], by_macro, by_hand };
    let x = kin::check::any_coord;
    let y = kin::check::any_coord;
    [
        of("table20", Box::new(table20(x(), y())), Box::new(Table::<20>::new())),
        of("table200", Box::new(table200(x(), y())), Box::new(Table::<200>::new())),
    ]
}

fn others() -> [Work; 5] {
    let mut random = SplitMix64(77);
    let mut draw = move || random.unit() * 2.0 - 1.0;
    let coords = |n: usize| vec![COORD; n];
    let knots: [f64; 21] = std::array::from_fn(|k| k as f64 / 10.0 - 1.0);
    let pieces: [[f64; 4]; 20] = std::array::from_fn(|_| std::array::from_fn(|_| draw()));
    let lengths: [f64; 5] = std::array::from_fn(|_| 1.0 + draw() / 2.0);
    let links: [[f64; 3]; 6] = std::array::from_fn(|_| std::array::from_fn(|_| draw()));
    let [pins, bases]: [[[f64; 3]; 6]; 2] =
        std::array::from_fn(|_| std::array::from_fn(|_| std::array::from_fn(|_| draw())));
    let coord = kin::check::any_coord;
    let vectors = |all: [[f64; 3]; 6]| all.map(|[x, y, z]| vec3(x, y, z));
    [
        Work {
            name: "spline",
            arguments: coords(2),
            by_macro: Box::new(spline(coord(), coord(), knots, pieces)),
            by_hand: Box::new(Spline { knots, pieces }),
        },
        Work {
            name: "belt",
            arguments: coords(1),
            by_macro: Box::new(belt(coord(), 1.0, 0.4, 8.0)),
            by_hand: Box::new(Belt { r: 1.0, s: 0.4, length: 8.0 }),
        },
        Work {
            name: "arm",
            arguments: coords(5),
            by_macro: Box::new(arm([(); 5].map(|()| coord()), lengths, vec2(0.7, 0.4))),
            by_hand: Box::new(Arm { lengths, target: [0.7, 0.4] }),
        },
        Work {
            name: "chain",
            arguments: coords(6),
            by_macro: Box::new(chain([(); 6].map(|()| coord()), links, vec3(0.3, 0.2, 0.1))),
            by_hand: Box::new(Chain {
                links: links.map(|[a, d, alpha]| [a, d, alpha.cos(), alpha.sin()]),
                target: [0.3, 0.2, 0.1],
            }),
        },
        Work {
            name: "platform",
            arguments: [vec![SPATIAL], coords(6)].concat(),
            by_macro: Box::new(platform(
                kin::check::any_spatial(),
                [(); 6].map(|()| coord()),
                vectors(pins),
                vectors(bases),
            )),
            by_hand: Box::new(Platform { pins, bases }),
        },
    ]
}

/// States and rates of a batch, and where each argument is in them.
struct Input {
    states: Vec<Vec<f64>>,
    rates: Vec<Vec<f64>>,
    places: Vec<Offsets>,
    timed: Vec<f64>,
}

impl Input {
    fn new(work: &Work) -> Self {
        let mut random = SplitMix64(12345);
        let mut states = Vec::new();
        let mut rates = Vec::new();
        for _ in 0..BATCH {
            let mut state = Vec::new();
            let mut rate = Vec::new();
            for argument in &work.arguments {
                let q: Vec<f64> = (0..argument[1]).map(|_| random.unit() * 2.0 - 1.0).collect();
                state.extend(&q);
                if *argument == COORD {
                    state.extend([q[0].sin(), q[0].cos()]);
                }
                rate.extend((0..argument[1]).map(|_| random.unit() * 2.0 - 1.0));
            }
            states.push(state);
            rates.push(rate);
        }
        let places = work.arguments.iter().scan(Offsets::new(0, 0), |next, numbers| {
            let own = *next;
            *next = Offsets::new(own.state + numbers[0] as u32, own.rates + numbers[1] as u32);
            Some(own)
        });
        let places = places.collect();
        let mut timed = vec![0.0; work.by_macro.facts().n_timed];
        work.by_macro.at_time(0.0, &mut timed);
        Input { states, rates, places, timed }
    }
}

/// The numbers that one evaluation writes.
struct Output {
    c: Vec<f64>,
    c_q: Vec<f64>,
    q_d: Vec<f64>,
}

impl Output {
    fn new(work: &Work) -> Self {
        let facts = work.by_macro.facts();
        let [m, entries] = [facts.rows.len(), facts.pattern.len()];
        Output { c: vec![0.0; m], c_q: vec![0.0; entries], q_d: vec![0.0; m] }
    }
}

fn evaluate(work: &Work, by_hand: bool, input: &Input, k: usize, out: &mut Output) {
    let states = &input.states[k];
    let rates = &input.rates[k];
    if by_hand {
        work.by_hand.linearize(states, &mut out.c, &mut out.c_q);
        work.by_hand.right_side(states, rates, &mut out.q_d);
    } else {
        let at = At::new(0.0, states, &input.places).with_timed(&input.timed);
        work.by_macro.linearize(&at, &mut out.c, &mut out.c_q);
        work.by_macro.acceleration_rhs(&at, &Rates::new(rates, &input.places), 1.0, &mut out.q_d);
    }
}

/// Names of its parts.
pub fn names() -> impl Iterator<Item = String> {
    works().into_iter().map(|work| format!("W8-{}", work.name))
}

fn wanted(name: &str) -> impl Iterator<Item = Work> {
    works()
        .into_iter()
        .filter(move |work| name == "W8" || name.strip_prefix("W8-") == Some(work.name))
}

/// Both routes on every constraint, or on the one that is named: ns an evaluation, and their ratio.
pub fn run(name: &str, budget: Duration) -> Vec<Figure> {
    wanted(name).flat_map(|work| race_of(&work, budget)).collect()
}

fn race_of(work: &Work, budget: Duration) -> Vec<Figure> {
    let input = Input::new(work);
    let figure = |peer: &str, metric: &str, value| {
        Figure::new(format!("W8-{}", work.name), peer, metric, value)
    };
    let mut figures = vec![figure("kin", "max_error", difference(work, &input))];
    let contestant = |(peer, by_hand)| Contestant { peer, run: batch(work, by_hand, &input) };
    let mut contestants: Vec<Contestant<'_>> =
        [("hand", true), ("kin", false)].map(contestant).into();
    for result in race(&mut contestants, budget) {
        let time = result.nanoseconds / BATCH as f64;
        eprintln!(
            "{:>10} {:<14} {time:>12.1} ns an evaluation, {:.3} of hand-written ({})",
            "W8", result.peer, result.ratio, work.name
        );
        figures.push(figure(result.peer, "ns_per_eval", time));
        figures.extend(
            (result.peer != "hand").then(|| figure(result.peer, "ratio_to_hand", result.ratio)),
        );
    }
    figures
}

fn batch<'a>(work: &'a Work, by_hand: bool, input: &'a Input) -> Box<dyn FnMut() + 'a> {
    let mut output = Output::new(work);
    Box::new(move || {
        (0..BATCH).for_each(|k| {
            evaluate(black_box(work), by_hand, black_box(input), k, black_box(&mut output))
        });
    })
}

/// The largest difference of a number by both routes, relative to 1 and its size.
fn difference(work: &Work, input: &Input) -> f64 {
    let mut a = Output::new(work);
    let mut b = Output::new(work);
    let mut largest = 0.0_f64;
    for k in 0..BATCH {
        evaluate(work, true, input, k, &mut a);
        evaluate(work, false, input, k, &mut b);
        for (a, b) in [(&a.c, &b.c), (&a.c_q, &b.c_q), (&a.q_d, &b.q_d)] {
            for (a, b) in a.iter().zip(b) {
                let off = (a - b).abs() / (1.0 + a.abs());
                assert!(off < 1e-12, "W8 {}: {a} by hand, {b} by the macro", work.name);
                largest = largest.max(off);
            }
        }
    }
    largest
}

/// Batches of one route and nothing else, for counting instructions.
pub fn once(name: &str, peer: &str, batches: usize) -> Option<()> {
    let work = wanted(name).next()?;
    let input = Input::new(&work);
    let by_hand = match peer {
        "hand" => true,
        "kin" => false,
        _ => return None,
    };
    let mut run = batch(&work, by_hand, &input);
    (0..batches).for_each(|_| run());
    Some(())
}
