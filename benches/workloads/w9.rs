//! W9: positions by values: small steps of a follower (`W9-W1`, `W9-W3`), beside single positions
//! of the compiled program at the same times, and the circuit of a four-bar (`W9-circuit`).

use std::hint::black_box;
use std::time::Duration;

use kin::prelude::*;
use kin::solver::Follower;

use crate::measure::{Contestant, Figure, race};
use crate::{w1, w3};

const NAMES: [&str; 3] = ["W9-W1", "W9-W3", "W9-circuit"];

/// The length of a step of time, whose values the follower takes. \[s\]
const DT: f64 = 1e-3;
const STEPS: usize = 1000;

pub fn names() -> impl Iterator<Item = String> {
    NAMES.into_iter().map(str::to_string)
}

/// A follower, its drivers, and their values at each time.
struct Moves {
    system: System,
    follower: Follower,
    names: Vec<String>,
    values: Vec<Vec<f64>>,
}

impl Moves {
    fn of(name: &str) -> Self {
        let workload = if name == NAMES[0] { w1::workload() } else { w3::workload() };
        let system = (workload.build)();
        let at = |k: usize| {
            let follower = system.follower(k as f64 * DT).unwrap_or_else(|error| panic!("{error}"));
            follower.drivers().into_iter().map(|driver| driver.value).collect()
        };
        let ends: [Vec<f64>; 2] = [at(0), at(1)];
        let value = |k: usize| {
            let ends = ends[0].iter().zip(&ends[1]);
            ends.map(|(first, second)| first + k as f64 * (second - first)).collect()
        };
        let follower = system.follower(0.0).unwrap_or_else(|error| panic!("{error}"));
        let names = follower.drivers().into_iter().map(|driver| driver.name).collect();
        system.compile().unwrap_or_else(|error| panic!("{error}"));
        Moves { values: (0..STEPS).map(value).collect(), system, follower, names }
    }

    /// There and back.
    fn follow(&mut self) {
        let there = (0..STEPS).chain((0..STEPS).rev());
        for k in there {
            let values = self.names.iter().zip(self.values[k].iter().copied());
            let moved = self.follower.to(values).unwrap_or_else(|error| panic!("{error}"));
            black_box(moved.q());
        }
    }

    fn singly(&self) {
        let mut q = self.system.initial().to_vec();
        for k in (0..STEPS).chain((0..STEPS).rev()) {
            let found = self.system.solve_at(k as f64 * DT, &q);
            q = black_box(found.unwrap_or_else(|error| panic!("{error}"))).q;
        }
    }
}

fn four_bar() -> kin::Result<System> {
    let mut m = Mechanism::new("four-bar");
    let [crank, coupler, rocker] = [m.link("a", 1.0)?, m.link("b", 3.5)?, m.link("c", 3.0)?];
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
    m.add("C", revolute(Ground, rocker, vec2(4.0, 0.0), rocker.start()))?;
    m.add("motor", drive_angle(crank, Law::constant(0.0)))?;
    m.prefer(rocker, 1.75);
    m.build()
}

pub fn run(name: &str, budget: Duration) -> Vec<Figure> {
    NAMES
        .iter()
        .filter(|own| name == "W9" || name == **own)
        .flat_map(|own| one(own, budget))
        .collect()
}

fn one(name: &'static str, budget: Duration) -> Vec<Figure> {
    if name == "W9-circuit" {
        let mut follower = four_bar()
            .and_then(|system| system.follower(0.0))
            .unwrap_or_else(|error| panic!("{error}"));
        let run = Box::new(move || drop(black_box(circuit(&mut follower))));
        return printed(name, 1.0, &mut [Contestant { peer: "hand", run }], budget);
    }
    let mut moves = Moves::of(name);
    let single = Moves::of(name);
    let steps = 2.0 * STEPS as f64;
    let mut contestants = [
        Contestant { peer: "kin-singly", run: Box::new(move || single.singly()) },
        Contestant { peer: "kin-follower", run: Box::new(move || moves.follow()) },
    ];
    printed(name, steps, &mut contestants, budget)
}

fn circuit(follower: &mut Follower) -> kin::solver::Circuit {
    follower.circuit("motor", 721).unwrap_or_else(|error| panic!("{error}"))
}

fn printed(
    name: &'static str,
    steps: f64,
    contestants: &mut [Contestant<'_>],
    budget: Duration,
) -> Vec<Figure> {
    let results = race(contestants, budget);
    let figures = results.into_iter().map(|result| {
        let step = result.nanoseconds / steps;
        let ratio = result.ratio;
        eprintln!("{name:>10} {:<14} {step:>12.1} ns, {ratio:.2} of the first", result.peer);
        Figure::new(name, result.peer, "ns_per_step", step)
    });
    figures.collect()
}

/// One route so many times and nothing else, for counting instructions.
pub fn once(name: &str, route: &str, repeats: usize) -> Option<()> {
    if name == "W9-circuit" {
        let mut follower = four_bar().and_then(|system| system.follower(0.0)).ok()?;
        (0..repeats).for_each(|_| drop(black_box(circuit(&mut follower))));
        return Some(());
    }
    let mut moves = Moves::of(name);
    match route {
        "kin-follower" => (0..repeats).for_each(|_| moves.follow()),
        "kin-singly" => (0..repeats).for_each(|_| moves.singly()),
        _ => return None,
    }
    Some(())
}
