//! W7: a sweep over ten thousand four-bars with random links, on two threads.

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::{Duration, Instant};

use kin::SolverOptions;
use kin::extend::Lanes;
use kin::prelude::*;

use crate::hand::four_bar::{FourBar, run as run_by_hand};
use crate::measure::{Figure, SplitMix64, cpu_of_all_threads, median};
use crate::sweep::as_defined;
use crate::w3;

const MECHANISMS: usize = 10_000;
const STEPS: usize = 360;
const DT: f64 = TAU / 360.0;
const THREADS: usize = 2;
const CHECK_SUM: f64 = 284_299.0;
const ITERATIONS: f64 = 2.99;

/// Σ θ̈4² and the Newton steps of a group of mechanisms.
type Sums = (f64, usize);

/// One way through mechanisms on so many threads.
type Route = (&'static str, fn(&[FourBar], usize) -> Sums);

/// By hand; as defined; by `SolverOptions::default()`, by plain steps and by a program of all cases
/// (`-4`: of a machine without AVX-512).
const ROUTES: [Route; 5] = [
    ("hand", by_hand),
    ("kin", by_kin),
    ("kin-plain", by_plain_steps),
    ("kin-default-4", by_default_in_four),
    ("kin-default", by_default),
];

/// Time on the wall and of all threads.
type Times = (Duration, Duration);

/// Rounds of all routes in turn.
const ROUNDS: usize = 3;

pub fn run() -> Vec<Figure> {
    let models = models();
    let samples: Vec<Vec<Times>> =
        (0..ROUNDS).map(|_| ROUTES.iter().map(|route| timed(route, &models)).collect()).collect();
    let mut figures = Vec::new();
    for (k, (peer, _)) in ROUTES.iter().enumerate() {
        let column = |unit: &dyn Fn(&Vec<Times>) -> f64| median(samples.iter().map(unit).collect());
        let per_second = MECHANISMS as f64 / column(&|round| round[k].0.as_secs_f64());
        let step = column(&|round| round[k].1.as_nanos() as f64) / (MECHANISMS * STEPS) as f64;
        let ratio = column(&|round| round[0].1.as_secs_f64() / round[k].1.as_secs_f64());
        eprintln!(
            "{:>10} {peer:<14} {per_second:>12.0} mechanisms a second, {step:.1} ns of CPU a step, {ratio:.2} of hand-written",
            "W7"
        );
        figures.push(Figure::new("W7", *peer, "mechanisms_per_s", per_second));
        figures.push(Figure::new("W7", *peer, "ns_per_step", step));
        figures.extend((*peer != "hand").then(|| Figure::new("W7", *peer, "ratio_to_hand", ratio)));
    }
    figures
}

/// One route alone on the first 104 mechanisms and one thread, for counting instructions.
pub fn once(peer: &str, repeats: usize) -> Option<()> {
    let (_, route) = ROUTES.iter().find(|route| route.0 == peer)?;
    let models = models();
    (0..repeats).for_each(|_| {
        black_box(route(&models[..104], 1));
    });
    Some(())
}

/// The mechanisms that are kept of those drawn: the crank turns all the way round.
fn models() -> Vec<FourBar> {
    let mut random = SplitMix64(20_240_607);
    let mut draw = |from: f64, range: f64| from + range * random.unit();
    let mut models = Vec::with_capacity(MECHANISMS);
    while models.len() < MECHANISMS {
        let a = draw(0.5, 0.5);
        let b = draw(2.0, 2.0);
        let c = draw(2.0, 2.0);
        let d = draw(2.0, 2.0);
        let longest = b.max(c).max(d);
        if a + longest < 0.95 * (b + c + d - longest) {
            models.push(FourBar { a, b, c, d, omega: 1.0 });
        }
    }
    models
}

/// Time on the wall and of all threads; the check sum is verified each time.
fn timed((peer, route): &Route, models: &[FourBar]) -> Times {
    let wall = Instant::now();
    let all = cpu_of_all_threads();
    let (sum, iterations) = route(models, THREADS);
    let times = (wall.elapsed(), cpu_of_all_threads() - all);
    assert!(
        (sum / CHECK_SUM - 1.0).abs() < 1e-5,
        "W7 by {peer}: check sum {sum}, expected {CHECK_SUM}"
    );
    let iterations = iterations as f64 / (models.len() * STEPS) as f64;
    let is_predicted = peer.starts_with("kin-");
    assert!(
        is_predicted || (iterations - ITERATIONS).abs() < 0.01,
        "W7 by {peer}: {iterations} iterations a step, expected {ITERATIONS}"
    );
    times
}

fn by_hand(models: &[FourBar], threads: usize) -> Sums {
    let group = |models: &[FourBar]| {
        models.iter().fold((0.0, 0), |(sum, iterations), model| {
            let table = run_by_hand(model, STEPS, DT);
            let own: f64 = (0..STEPS).map(|k| table.at(k).2[8].powi(2)).sum();
            (sum + own, iterations + table.iterations)
        })
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> = models
            .chunks(models.len().div_ceil(threads))
            .map(|part| scope.spawn(move || group(part)))
            .collect();
        threads.into_iter().map(|thread| thread.join().unwrap_or((f64::NAN, 0))).fold((0.0, 0), add)
    })
}

/// Parameters that differ from case to case: where pins sit, and the start.
const NAMES: [&str; 16] = [
    "O.u_i.x",
    "A.u_i.x",
    "A.u_j.x",
    "B.u_i.x",
    "B.u_j.x",
    "C.u_i.x",
    "C.u_j.x",
    "crank.R_x",
    "crank.R_y",
    "crank.theta",
    "coupler.R_x",
    "coupler.R_y",
    "coupler.theta",
    "rocker.R_x",
    "rocker.R_y",
    "rocker.theta",
];

/// The numbers of one four-bar under those names.
fn case(model: &FourBar) -> Vec<f64> {
    let a = 0.5 * model.a;
    let b = 0.5 * model.b;
    let c = 0.5 * model.c;
    [-a, a, -b, b, c, -c, model.d].into_iter().chain(model.position(0.0)).collect()
}

fn by_kin(models: &[FourBar], threads: usize) -> Sums {
    by_sweep(models, threads, Lanes::Off, as_defined())
}

fn by_plain_steps(models: &[FourBar], threads: usize) -> Sums {
    by_sweep(models, threads, Lanes::Off, SolverOptions::default())
}

fn by_default_in_four(models: &[FourBar], threads: usize) -> Sums {
    by_sweep(models, threads, Lanes::Only(4), SolverOptions::default())
}

fn by_default(models: &[FourBar], threads: usize) -> Sums {
    by_sweep(models, threads, Lanes::Best, SolverOptions::default())
}

/// One system for all mechanisms.
fn by_sweep(models: &[FourBar], threads: usize, lanes: Lanes, options: SolverOptions) -> Sums {
    let times: Vec<f64> = (0..STEPS).map(|k| k as f64 * DT).collect();
    let Some(first) = models.first() else { return (0.0, 0) };
    let cases: Vec<Vec<f64>> = models.iter().map(case).collect();
    let keep = |_, motion: kin::Result<Motion>| {
        let motion = motion.unwrap_or_else(|error| panic!("{error}"));
        let own: f64 = (0..STEPS).map(|k| motion.qdd(k)[8].powi(2)).sum();
        (own, motion.iterations().iter().sum())
    };
    let system = w3::model(first, false);
    let sums = system.sweep(NAMES).and_then(|sweep| {
        sweep.options(options).threads(threads).lanes(lanes).run(&cases, &times, keep)
    });
    sums.unwrap_or_else(|error| panic!("{error}")).into_iter().fold((0.0, 0), add)
}

fn add(a: Sums, b: Sums) -> Sums {
    (a.0 + b.0, a.1 + b.1)
}
