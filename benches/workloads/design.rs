//! Derivatives of a workload's motion by its parameters, and its forces, for counting instructions:
//! `once W1 forward-3 10`, `once W1 adjoint 10`, `once W1 forces 10`, beside `once W1 motion 10`,
//! which is the run alone; `forces-walk`, with forces time by time; `motion-compiled` and
//! `forces-compiled`, where the run is computed by its program too.

use std::hint::black_box;

use kin::prelude::*;
use kin::{Engine, SolverOptions};

/// Runs by plain steps, then what the route asks for; `None` of a route that is another one.
pub fn once(system: &System, route: &str, times: &[f64], repeats: usize) -> Option<()> {
    let plain = SolverOptions::new().engine(Engine::StepByStep);
    let run = || {
        system.solver().options(plain.clone()).run(times).unwrap_or_else(|error| panic!("{error}"))
    };
    // Two times are enough to know which parameters have derivatives.
    let short = system
        .solver()
        .options(plain.clone())
        .run(&times[..2])
        .unwrap_or_else(|error| panic!("{error}"));
    let known = |name: &String| system.sensitivities(&short, [name]).is_ok();
    let names: Vec<String> =
        system.parameters().into_iter().map(|(name, _)| name).filter(known).collect();
    let what = system.coordinate_names()[0].clone();
    let compiled = SolverOptions::new().engine(Engine::Compiled);
    let run_compiled = || {
        system
            .solver()
            .options(compiled.clone())
            .run(times)
            .unwrap_or_else(|error| panic!("{error}"))
    };
    let forces = |motion: Motion, engine| {
        let found = system
            .solver()
            .options(SolverOptions::new().engine(engine))
            .forces(&motion)
            .unwrap_or_else(|error| panic!("{error}"));
        drop(black_box(found));
    };
    match route.split_once('-') {
        None if route == "forces" => (0..repeats).for_each(|_| forces(run(), Engine::Auto)),
        Some(("forces", "walk")) => (0..repeats).for_each(|_| forces(run(), Engine::StepByStep)),
        Some(("forces", "compiled")) => {
            (0..repeats).for_each(|_| forces(run_compiled(), Engine::Auto))
        }
        Some(("motion", "compiled")) => (0..repeats).for_each(|_| drop(black_box(run_compiled()))),
        None if route == "motion" => (0..repeats).for_each(|_| drop(black_box(run()))),
        None if route == "adjoint" => (0..repeats).for_each(|_| {
            let motion = run();
            drop(black_box(system.gradient(&motion, &names, &what, |_| [1.0, 0.5, 0.25])));
        }),
        Some(("forward", count)) => {
            let names = names.get(..count.parse().ok()?)?;
            (0..repeats).for_each(|_| {
                let motion = run();
                drop(black_box(system.sensitivities(&motion, names)));
            });
        }
        _ => return None,
    }
    Some(())
}
