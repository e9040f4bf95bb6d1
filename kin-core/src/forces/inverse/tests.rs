//! Forces by a tape against those by the walk, on the gallery with masses and loads of the tests'
//! own; faults that are planted have to show.

use std::sync::Arc;

use super::tape_with;
use crate::coordinates::Target;
use crate::coordinates::layout::{Kind, Place};
use crate::forces::Forces;
use crate::model::loads::{Acting, Load, Loads, OnBody, Solid};
use crate::numbers::algebra::{Mat3, Vec3};
use crate::program::tests::models::systems;
use crate::solve::motion::Motion;
use crate::solve::options::{Engine, SolverOptions};
use crate::{Law, System, linspace};
use kin_graph::{Graph, Node};

/// A system with mass on every body, weight, and a force and a torque on the last body.
fn massed(mut system: System) -> System {
    let rows = [[0.2, 0.02, -0.01], [0.02, 0.24, 0.014], [-0.01, 0.014, 0.18]];
    let mut solids = Vec::new();
    let arguments = system.equations().blocks.iter().flat_map(|block| block.constraint.arguments());
    let is_moving = |target: &Target| {
        let body = matches!(target, Target::Planar(_) | Target::Spatial(_));
        body && matches!(system.layout().place(target), Some(Place::Own { .. }))
    };
    let on = arguments.map(|argument| argument.target).filter(is_moving).last();
    for (number, item) in system.layout().items.iter().enumerate() {
        if matches!(item.kind, Kind::Angle | Kind::Length) {
            continue;
        }
        let mass = 1.0 + 0.3 * number as f64;
        let centre = Vec3::new(0.03, -0.02, 0.01);
        solids.push((number, Solid { mass, centre, inertia: Mat3::from(rows) }));
    }
    let loads = on.map(|target| {
        let law = |x: f64| Law::sine(x, 1.3, 0.2) + Law::constant(0.4);
        let part = |fixed| {
            let force = [law(3.0), law(-2.0), law(0.5)];
            let torque = [law(0.1), law(0.2), law(0.3)];
            let point = [0.2, -0.1, 0.0];
            Load(Acting::OnBody(Box::new(OnBody {
                point,
                force,
                torque,
                ..OnBody::on(target, fixed)
            })))
        };
        vec![("push".to_string(), part(false)), ("tool".to_string(), part(true))]
    });
    let gravity = [0.4, -7.31, 0.0];
    system.loads =
        Arc::new(Loads { solids, gravity, loads: loads.unwrap_or_default(), ..Loads::default() });
    system
}

/// The largest difference of λ, and the largest λ.
fn apart(a: &Forces<'_>, b: &Forces<'_>, motion: &Motion) -> f64 {
    let mut off = 0.0_f64;
    let mut most = 0.0_f64;
    for k in 0..motion.len() {
        for (a, b) in a.multipliers.at(k).iter().zip(b.multipliers.at(k)) {
            off = if (a - b).abs() <= off { off } else { (a - b).abs() };
            most = most.max(b.abs());
        }
    }
    off / most
}

/// The largest difference of energies and powers, by the largest of them.
fn powers_apart(a: &Forces<'_>, b: &Forces<'_>) -> f64 {
    let of = |forces: &Forces<'_>| {
        let energy = forces.energy();
        let balance = forces.balance();
        let own =
            [&energy.kinetic, &energy.potential, &balance.drives, &balance.loads, &balance.kinetic];
        own.map(|series| series.values().to_vec())
    };
    let largest = a.balance().largest / b.balance().largest - 1.0;
    of(a).iter().zip(of(b)).fold(largest.abs(), |off, (a, b)| {
        let most = b.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        a.iter().zip(b).fold(off, |off, (a, b)| off.max((a - b).abs() / most))
    })
}

#[test]
fn tape_and_walk_have_the_same_forces() {
    let mut compared = 0;
    let mut without = Vec::new();
    for (name, system) in systems() {
        let system = massed(system);
        let Ok(motion) = system.run(linspace(0.0, 0.5, 26)) else { continue };
        let Ok(plain) = system
            .solver()
            .options(SolverOptions::new().engine(Engine::StepByStep))
            .forces(&motion)
        else {
            continue;
        };
        assert_eq!(plain.engine().compiled, 0);
        let compiled = match system
            .solver()
            .options(SolverOptions::new().engine(Engine::Compiled))
            .forces(&motion)
        {
            Ok(forces) => forces,
            Err(error) => {
                without.push(format!("{name}: {error}"));
                continue;
            }
        };
        let off = apart(&compiled, &plain, &motion);
        let powers = powers_apart(&compiled, &plain);
        let counts = compiled.engine();
        let energy = plain.energy();
        let [kinetic, potential] =
            super::energies(&system, &motion, &compiled.loads).expect("a tape");
        let sizes = [&energy.kinetic, &energy.potential].map(|one| one.peak().value.abs() + 1.0);
        let off = [kinetic, potential]
            .iter()
            .zip([&energy.kinetic, &energy.potential])
            .zip(sizes)
            .fold(off, |off, ((tape, walk), size)| {
                tape.iter()
                    .zip(walk.values())
                    .fold(off, |off, (a, b)| off.max((a - b).abs() / size))
            });
        assert!(off < 1e-11 && powers < 1e-11, "{name}: {off:e} {powers:e}");
        assert!(counts.compiled > 22 && compiled.balance().worst() < 1e-11, "{name}: {counts:?}");
        compared += 1;
    }
    assert!(compared > 15, "{compared}, none of {without:?}");
}

/// Faults in λ: a lost sign, a wrong column.
type Spoil = fn(&mut Graph, &mut [Node], usize);
const FAULTS: [Spoil; 2] = [
    |graph, lambda, k| lambda[k] = graph.neg(lambda[k]),
    |_, lambda, k| lambda[k] = lambda[(k + 1) % lambda.len()],
];

#[test]
fn a_fault_in_a_program_leaves_its_forces_to_the_walk() {
    let mut planted = 0;
    let mut noticed = 0;
    for (name, system) in systems().filter(|(name, _)| name == "four-bar") {
        let system = massed(system);
        let Ok(motion) = system.run(linspace(0.0, 0.5, 60)) else { continue };
        let Ok(plain) = system
            .solver()
            .options(SolverOptions::new().engine(Engine::StepByStep))
            .forces(&motion)
        else {
            continue;
        };
        let loads = super::Laid::all(&system, &motion).expect("loads");
        for (spoil, k) in (0..system.n_equations()).flat_map(|k| FAULTS.map(|spoil| (spoil, k))) {
            let begin = super::Begin::of(&system, &motion).expect("times");
            let tape = tape_with(&system, &begin, &loads, |graph, lambda| spoil(graph, lambda, k));
            super::cache(&system, begin, tape.map(Arc::new));
            let forces = system.forces(&motion).expect("forces");
            let off = apart(&forces, &plain, &motion);
            // A multiplier that is zero has no sign.
            assert!(off < 1e-11, "{name} {k}: {off:e}");
            (planted, noticed) =
                (planted + 1, noticed + usize::from(forces.why_not_compiled().is_some()));
        }
    }
    assert!(planted > 15 && 10 * noticed > 8 * planted, "{noticed} of {planted}");
}
