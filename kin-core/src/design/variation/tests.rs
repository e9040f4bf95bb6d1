//! By the tape and by the walk the same derivatives: two routes that share nothing but the
//! derivatives of each equation.

use super::{adjoint, backward, forward};
use crate::design::adjoint::{Weights, adjoint as walked};
use crate::design::along::Prepared;
use crate::design::solver::SlopeSolver;
use crate::numbers::random::Random;
use crate::program::schedule;
use crate::program::tests::{models::systems, reduced::compiled};
use crate::{Motion, System, linspace};

/// Names with derivatives by the walk.
fn names(system: &System) -> Vec<String> {
    let known = |name: &String| Prepared::new(system, std::slice::from_ref(name)).is_ok();
    let names = system.parameters().into_iter().map(|(name, _)| name).filter(known).take(9);
    names.collect()
}

/// The largest difference of each order beside the largest number of it or 1, and how many times
/// were left to the walk; `None` where there is no tape.
fn apart(system: &System, motion: &Motion, names: &[String]) -> Option<([f64; 3], usize)> {
    let n = system.n_coordinates();
    let mut prepared = Prepared::new(system, names).expect("prepared");
    let mut lists = vec![vec![f64::NAN; n * motion.len()]; 3 * names.len()];
    let left =
        forward::forward(&prepared, motion, lists.iter_mut().map(Vec::as_mut_slice).collect())?;
    let mut off = [0.0_f64; 3];
    let mut sizes = [1.0_f64; 3];
    for k in (0..motion.len()).filter(|k| !left.contains(k)) {
        let t = motion.times()[k];
        let orders = [motion.q(k), motion.qd(k), motion.qdd(k)];
        let along = prepared.at(t, orders);
        let mut solver = SlopeSolver::new(system);
        solver.go_to(t, orders).expect("factored");
        for (number, name) in names.iter().enumerate() {
            let orders = solver.forward(&prepared, &along, (number, name)).expect("solved");
            for (order, own) in orders.iter().enumerate() {
                for (own, x) in own.iter().zip(&lists[3 * number + order][k * n..]) {
                    let far = (own - x).abs();
                    off[order] = if far <= off[order] { off[order] } else { far };
                    sizes[order] = sizes[order].max(own.abs());
                }
            }
        }
    }
    Some(([0, 1, 2].map(|order| off[order] / sizes[order]), left.len()))
}

/// The largest difference of the gradients with random weights, beside the largest of its terms.
fn adjoints_apart(system: &System, motion: &Motion, names: &[String]) -> Option<f64> {
    let n = system.n_coordinates();
    let mut random = Random::new(3);
    let mut list = || (0..n * motion.len()).map(|_| random.number()).collect::<Vec<f64>>();
    let weights: Weights = [list(), list(), list()];
    let mut prepared = Prepared::new(system, names).expect("prepared");
    let mut found = vec![0.0; names.len()];
    let left = adjoint(&prepared, None, motion, &weights, &mut found)?;
    let mut expected = vec![0.0; names.len()];
    let mut size = 1.0_f64;
    for k in (0..motion.len()).filter(|k| !left.contains(k)) {
        let t = motion.times()[k];
        let orders = [motion.q(k), motion.qd(k), motion.qdd(k)];
        let along = prepared.at(t, orders);
        let mut solver = SlopeSolver::new(system);
        solver.go_to(t, orders).expect("factored");
        let own = weights.each_ref().map(|all| all[k * n..][..n].to_vec());
        let lambda = walked(&solver, &along, vec![0.0; system.n_equations()], own);
        for (sum, by_p) in expected.iter_mut().zip(&along.by_p) {
            for (row, jet) in by_p {
                let terms = lambda.iter().zip(jet).map(|(lambda, c_p)| lambda[*row] * c_p);
                terms.for_each(|term| {
                    *sum -= term;
                    size = size.max(term.abs());
                });
            }
        }
    }
    let far = |m: f64, (a, b): (&f64, &f64)| if (a - b).abs() <= m { m } else { (a - b).abs() };
    Some(found.iter().zip(&expected).fold(0.0, far) / size)
}

#[test]
fn tape_and_walk_have_the_same_derivatives() {
    let mut compared = 0;
    let mut without = Vec::new();
    for (name, system) in systems() {
        let Ok(motion) = system.run(linspace(0.0, 0.5, 26)) else { continue };
        let names = names(&system);
        if names.is_empty() {
            continue;
        }
        let Some((off, left)) = apart(&system, &motion, &names) else {
            without.push(name);
            continue;
        };
        let backward = adjoints_apart(&system, &motion, &names).expect("a tape too");
        assert!(left < 3, "{name}: {left} times have no tape");
        assert!(
            off.iter().all(|off| *off < 1e-11) && backward < 1e-11,
            "{name}: {off:?} {backward:e}"
        );
        compared += 1;
    }
    assert!(compared > 15, "{compared}, none of {without:?}");
}

/// Steps of the tapes of one name, of five, and of the gradient by all with weights of one
/// coordinate and its rates.
fn steps(system: &System, motion: &Motion, names: &[String]) -> Option<[usize; 3]> {
    let n = system.n_coordinates();
    let count = |names: &[String]| {
        let prepared = Prepared::new(system, names).expect("prepared");
        Some(forward::tape(&prepared, motion)?.tape.size())
    };
    let last = || (0..n * motion.len()).map(|k| if k % n == n - 1 { 1.0 } else { 0.0 }).collect();
    let prepared = Prepared::new(system, names).expect("prepared");
    let adjoint = backward::tape(&prepared, None, motion, &[last(), last(), last()])?.tape.size();
    Some([count(&names[..1])?, count(&names[..5])?, adjoint])
}

/// A run of fewer steps is a few sines in closed form, of which derivatives by parameters have more
/// terms.
const SMALL: usize = 50;

/// Steps of tapes take about the same time, by whichever tape. The worst is the cam with its
/// follower: 275 steps for one parameter where a run has 115.
#[test]
fn derivatives_take_no_more_steps_than_a_run() {
    let mut counted = 0;
    for (name, system) in systems() {
        let Ok(motion) = system.run(linspace(0.0, 0.1, 6)) else { continue };
        let names = names(&system);
        let Ok(run) = compiled(&system, 0.0, motion.q(0)) else { continue };
        let run = schedule(run).size()[0];
        let Some([one, five, all]) =
            (names.len() > 5).then(|| steps(&system, &motion, &names)).flatten()
        else {
            continue;
        };
        let [further, bound] = [(five - one) / 4, run.max(SMALL)];
        let most = 5 * bound / 2;
        assert!(
            one <= most && further <= bound && all <= most,
            "{name}: {run}, {one}, {further}, {all}"
        );
        counted += 1;
    }
    assert!(counted > 15, "{counted}");
}
