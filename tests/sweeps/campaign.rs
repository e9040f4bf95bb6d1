//! Cases of sweeps of random mechanisms with steps and kinks: each is what a run of its own system
//! is.

use kin::{Engine, SolverOptions};

use crate::steps::{Case, difference, random};

/// How many cases a test run takes; `KIN_CAMPAIGN=30000` is the whole campaign, for a release
/// build.
fn count() -> usize {
    std::env::var("KIN_CAMPAIGN").ok().and_then(|count| count.parse().ok()).unwrap_or(60)
}

/// Cases of each sweep: enough of them for a program to pay.
const CASES: usize = 30;

#[test]
fn cases_of_random_mechanisms_with_steps_are_single_runs() {
    let mut wrong = Vec::new();
    let mut seed = 0;
    let mut looked = 0;
    while looked < count() {
        seed += 1;
        let Case { words, system, times, varied: (name, value), loose } = random(seed);
        if times.len() < 40 {
            continue;
        }
        looked += CASES;
        let cases: Vec<[f64; 1]> =
            (0..CASES).map(|k| [value * (0.9 + 0.2 * k as f64 / CASES as f64)]).collect();
        let swept = system
            .sweep([&name])
            .expect("a sweep")
            .run(&cases, &times, |_, motion| motion)
            .expect("runs");
        for (case, swept) in cases.iter().zip(swept) {
            let mut own = system.clone();
            own.set(&name, case[0]).expect("sets");
            let single =
                own.solver().options(SolverOptions::new().engine(Engine::StepByStep)).run(&times);
            let differ = difference(&own, &times, [&single, &swept], loose);
            wrong.extend(differ.map(|what| format!("{words}\n    {name} = {}: {what}", case[0])));
        }
    }
    println!("{looked} cases, {} are not what they are alone", wrong.len());
    assert!(
        wrong.is_empty(),
        "{} of {looked}:\n{}",
        wrong.len(),
        wrong.iter().take(12).cloned().collect::<Vec<_>>().join("\n")
    );
}
