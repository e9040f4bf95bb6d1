//! The Rust side of `times.py`, which starts it: `beside_python JOB` reads the job, then for each
//! line of standard input, a number of repeats, does the work so often and prints one line: CPU
//! time of all threads in seconds, and a number that the results come to, which has to be Python's
//! own.

use std::hint::black_box;
use std::io::BufRead;

use kin::extend::Lanes;
use kin::{Engine, SolverOptions};
use rustix::time::{ClockId, clock_gettime};
use serde::Deserialize;

/// The work of both sides: a run over the times, or where there are cases a sweep that keeps the
/// largest value of one coordinate.
#[derive(Deserialize)]
struct Job {
    mechanism: kin::data::MechanismData,
    times: Vec<f64>,
    /// By plain steps.
    plain: bool,
    names: Vec<String>,
    cases: Vec<Vec<f64>>,
    keep: String,
    lanes: bool,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // `cargo bench` hands its own word on; without a job there is nothing to compare with.
    let Some(path) = std::env::args().skip(1).find(|word| !word.starts_with("--")) else {
        eprintln!("this is started by benches/python/times.py");
        return Ok(());
    };
    let job: Job = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    let system = kin::Mechanism::from_data(&job.mechanism, &kin_text::registry())?.build()?;
    for line in std::io::stdin().lock().lines() {
        let repeats: usize = line?.trim().parse()?;
        let begun = cpu();
        let mut number = 0.0;
        for _ in 0..repeats {
            number = black_box(if job.cases.is_empty() {
                run(&system, &job)
            } else {
                sweep(&system, &job)
            })?;
        }
        println!("{:e} {number:e}", cpu() - begun);
    }
    Ok(())
}

/// The last acceleration of the last coordinate.
fn run(system: &kin::System, job: &Job) -> kin::Result<f64> {
    let motion = system.solver().options(job.options()).run(&job.times)?;
    Ok(motion.qdd(motion.len() - 1).last().copied().unwrap_or_default())
}

/// The sum of all that is kept.
fn sweep(system: &kin::System, job: &Job) -> kin::Result<f64> {
    let lanes = if job.lanes { Lanes::Best } else { Lanes::Off };
    let kept = system.sweep(&job.names)?.options(job.options()).lanes(lanes).run(
        &job.cases,
        &job.times,
        |_, motion| motion.and_then(|motion| Ok(motion.named(&job.keep)?.value.max())),
    )?;
    kept.into_iter().sum()
}

impl Job {
    fn options(&self) -> SolverOptions {
        SolverOptions::new().engine(if self.plain { Engine::StepByStep } else { Engine::Auto })
    }
}

/// CPU time of all threads.   \[s\]
fn cpu() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}
