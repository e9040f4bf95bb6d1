//! W7: a sweep over ten thousand four-bars with random links, on two threads.

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::{Duration, Instant};

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

/// One way through a group of mechanisms.
type Route = (&'static str, fn(&[FourBar]) -> Sums);

const ROUTES: [Route; 2] = [("hand", by_hand), ("kin", by_kin)];

/// Time on the wall and of all threads.
type Times = (Duration, Duration);

/// Rounds of all routes in turn.
const ROUNDS: usize = 3;

pub fn run() -> Vec<Figure> {
    let models = models();
    let samples: Vec<Vec<Times>> = (0..ROUNDS).map(|_| ROUTES.iter().map(|route| timed(route, &models)).collect()).collect();
    let mut figures = Vec::new();
    for (k, (peer, _)) in ROUTES.iter().enumerate() {
        let column = |unit: &dyn Fn(&Vec<Times>) -> f64| median(samples.iter().map(unit).collect());
        let per_second = MECHANISMS as f64 / column(&|round| round[k].0.as_secs_f64());
        let step = column(&|round| round[k].1.as_nanos() as f64) / (MECHANISMS * STEPS) as f64;
        let ratio = column(&|round| round[0].0.as_secs_f64() / round[k].0.as_secs_f64());
        eprintln!("{:>10} {peer:<14} {per_second:>12.0} mechanisms a second, {step:.1} ns of CPU a step, {ratio:.2} of hand-written", "W7");
        figures.push(Figure::new("W7", *peer, "mechanisms_per_s", per_second));
        figures.push(Figure::new("W7", *peer, "ns_per_step", step));
        figures.extend((*peer != "hand").then(|| Figure::new("W7", *peer, "ratio_to_hand", ratio)));
    }
    figures
}

/// One route alone on the first hundred mechanisms and one thread, for counting instructions.
pub fn once(peer: &str, repeats: usize) -> Option<()> {
    let (_, route) = ROUTES.iter().find(|route| route.0 == peer)?;
    let models = models();
    (0..repeats).for_each(|_| {
        black_box(route(&models[..100]));
    });
    Some(())
}

/// The mechanisms that are kept of those drawn: the crank turns all the way round.
fn models() -> Vec<FourBar> {
    let mut random = SplitMix64(20_240_607);
    let mut draw = |from: f64, range: f64| from + range * random.unit();
    let mut models = Vec::with_capacity(MECHANISMS);
    while models.len() < MECHANISMS {
        let (a, b, c, d) = (draw(0.5, 0.5), draw(2.0, 2.0), draw(2.0, 2.0), draw(2.0, 2.0));
        let longest = b.max(c).max(d);
        if a + longest < 0.95 * (b + c + d - longest) {
            models.push(FourBar { a, b, c, d, omega: 1.0 });
        }
    }
    models
}

/// Time on the wall and of all threads; the check sum is verified each time.
fn timed((peer, route): &Route, models: &[FourBar]) -> Times {
    let (wall, all) = (Instant::now(), cpu_of_all_threads());
    let share = models.len().div_ceil(THREADS);
    let sums: Vec<Sums> = std::thread::scope(|scope| {
        let threads: Vec<_> = models.chunks(share).map(|part| scope.spawn(|| route(part))).collect();
        threads.into_iter().map(|thread| thread.join().unwrap_or((f64::NAN, 0))).collect()
    });
    let times = (wall.elapsed(), cpu_of_all_threads() - all);
    let sum: f64 = sums.iter().map(|sums| sums.0).sum();
    assert!((sum / CHECK_SUM - 1.0).abs() < 1e-5, "W7 by {peer}: check sum {sum}, expected {CHECK_SUM}");
    let iterations = sums.iter().map(|sums| sums.1).sum::<usize>() as f64 / (models.len() * STEPS) as f64;
    assert!((iterations - ITERATIONS).abs() < 0.01, "W7 by {peer}: {iterations} iterations a step, expected {ITERATIONS}");
    times
}

fn by_hand(models: &[FourBar]) -> Sums {
    models.iter().fold((0.0, 0), |(sum, iterations), model| {
        let table = run_by_hand(model, STEPS, DT);
        let own: f64 = (0..STEPS).map(|k| table.at(k).2[8].powi(2)).sum();
        (sum + own, iterations + table.iterations)
    })
}

/// One system for all mechanisms of a thread; the lengths are set before each run.
fn by_kin(models: &[FourBar]) -> Sums {
    let times: Vec<f64> = (0..STEPS).map(|k| k as f64 * DT).collect();
    let Some(first) = models.first() else { return (0.0, 0) };
    let mut system = w3::model(first, false);
    models.iter().fold((0.0, 0), |(sum, iterations), model| {
        let motion = set(&mut system, model).and_then(|()| system.run_with(&times, &as_defined()));
        let motion = motion.unwrap_or_else(|error| panic!("{model:?}: {error}"));
        let own: f64 = (0..STEPS).map(|k| motion.qdd(k)[8].powi(2)).sum();
        (sum + own, iterations + motion.iterations().iter().sum::<usize>())
    })
}

/// Gives a four-bar other lengths, and the start that goes with them.
fn set(system: &mut System, model: &FourBar) -> kin::Result<()> {
    let (a, b, c) = (0.5 * model.a, 0.5 * model.b, 0.5 * model.c);
    let lengths = [("O.u_i.x", -a), ("A.u_i.x", a), ("A.u_j.x", -b), ("B.u_i.x", b), ("B.u_j.x", c), ("C.u_i.x", -c), ("C.u_j.x", model.d)];
    lengths.iter().try_for_each(|(name, value)| system.set(name, *value))?;
    system.set_initial(&model.position(0.0))
}
