//! The mechanisms of all numbered examples.

use kin::data::Registry;
use kin::emit::{self, Options};
use kin::prelude::*;
use kin::solver::Follower;

use crate::own;
use crate::programs::{checks, compiled, there_is_a_compiler};

pub fn system(path: &std::path::Path) -> System {
    let registry = Registry::new()
        .with::<own::slider_crank>()
        .with::<own::parabolic_slot>()
        .with::<own::geneva>();
    Mechanism::read_json(path, &registry).expect("reads").build().expect("builds")
}

/// Returns all mechanisms with their names.
pub fn mechanisms() -> Vec<(String, System)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/examples");
    let files = std::fs::read_dir(folder).expect("the examples");
    let mut paths: Vec<_> = files.map(|file| file.expect("a file").path()).collect();
    paths.sort();
    let name = |path: &std::path::Path| {
        path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    };
    paths.iter().map(|path| (name(path), system(path))).collect()
}

/// Reproducible random numbers in −1 … 1 (SplitMix64).
pub struct Random(pub u64);

impl Random {
    /// Returns a number below n.
    pub fn below(&mut self, n: usize) -> usize {
        ((0.5 * self.next() + 0.5) * n as f64) as usize % n
    }

    /// Returns a number in −1 … 1.
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Returns the largest difference in units of 1 + the largest number, which is at least `size`.
fn off(found: &[f64], expected: &[f64], size: f64) -> f64 {
    let size = 1.0 + expected.iter().fold(size, |most, x| most.max(x.abs()));
    found.iter().zip(expected).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs() / size))
}

/// Mechanisms that are compiled with the checks of memory and arithmetic: for large ones this takes
/// a minute.
const WITH_CHECKS: [&str; 4] =
    ["04_four_bar", "06_scotch_yoke", "16_change_points", "20_geneva_drive"];

/// A mechanism whose way leads to a singular position, where the file stops; the library goes on.
const STOPS: [&str; 1] = ["16_change_points"];

/// The library along the same way as a file.
enum Library<'a> {
    Follower(Box<Follower>),
    ByTime(&'a System, Vec<f64>),
}

impl Library<'_> {
    /// Returns q, q̇ and q̈ at these values, for these velocities and accelerations, or `None` if
    /// there is no such position.
    fn to(&mut self, names: &[String], u: &[f64], rates: &[[f64; 2]]) -> Option<[Vec<f64>; 3]> {
        match self {
            Library::Follower(follower) => {
                let before = follower.clone();
                let names = || names.iter().cloned();
                if follower.to(names().zip(u.iter().copied())).is_err() {
                    *follower = before;
                    return None;
                }
                let found = follower.rates(names().zip(rates.iter().copied())).expect("rates");
                Some([follower.here().q().to_vec(), found.qd, found.qdd])
            }
            Library::ByTime(system, q) => {
                let found = system.solve_at(u[0], q).expect("a position");
                let [ud, udd] = rates[0];
                q.clone_from(&found.q);
                let both = found.qd.iter().zip(&found.qdd);
                let qdd = both.map(|(qd, qdd)| ud * ud * qdd + udd * qd).collect();
                Some([found.q, found.qd.iter().map(|qd| ud * qd).collect(), qdd])
            }
        }
    }
}

/// Compares a compiled file with the library along random steps.
fn compare(name: &str, system: &System, text: &str, steps: usize) {
    let flags: &[&str] = if WITH_CHECKS.contains(&name) { checks() } else { &[] };
    let program =
        compiled(name, text, flags).unwrap_or_else(|messages| panic!("{name}: {messages}"));
    assert_eq!(program.selftest(), "0", "{name}");
    let (mut library, drivers): (_, Vec<(String, Option<String>, f64)>) = match system.follower(0.0)
    {
        Ok(follower) => {
            let own = follower.drivers().into_iter();
            let drivers = own.map(|own| (own.name, own.unit, own.value)).collect();
            (Library::Follower(Box::new(follower)), drivers)
        }
        Err(_) => {
            let start = system.position(0.0).expect("a position").q;
            (Library::ByTime(system, start), vec![("t".to_string(), None, 0.0)])
        }
    };
    let names: Vec<String> = drivers.iter().map(|(name, ..)| name.clone()).collect();
    let length = |k: usize| if drivers[k].1.as_deref() == Some("rad") { 0.02 } else { 0.002 };
    let seed = name.bytes().fold(7, |sum, byte| (31 * sum + u64::from(byte)) % 1_000_003);
    let mut random = Random(seed);
    let mut heading: Vec<f64> = names.iter().map(|_| random.next().signum()).collect();
    let mut u: Vec<f64> = drivers.iter().map(|(_, _, value)| *value).collect();
    let mut lines: Vec<Vec<f64>> = Vec::new();
    let mut expected = Vec::new();
    let mut turned = 0;
    while lines.len() < steps {
        let step = |(k, u): (usize, &f64)| u + length(k) * heading[k] * (0.6 + 0.4 * random.next());
        let next: Vec<f64> = u.iter().enumerate().map(step).collect();
        let rates: Vec<[f64; 2]> = u.iter().map(|_| [random.next(), random.next()]).collect();
        let Some(found) = library.to(&names, &next, &rates) else {
            // The end of the way: back.
            heading.iter_mut().for_each(|heading| *heading = -*heading);
            turned += 1;
            assert!(turned < steps, "{name} does not move");
            continue;
        };
        let both = |k: usize| rates.iter().map(move |rate| rate[k]);
        lines.push(next.iter().copied().chain(both(0)).chain(both(1)).collect());
        expected.push(found);
        u = next;
    }
    let found = program.run(&[], &lines);
    let n = system.coordinate_names().len();
    // Coordinates round as the numbers do from which they are computed.
    let own = system.parameters().into_iter().fold(0.0_f64, |most, (_, x)| most.max(x.abs()));
    let mut most = [0.0_f64; 3];
    for (k, orders) in expected.iter().enumerate() {
        let line = found.get(k).unwrap_or_else(|| panic!("{name}: no step {k}"));
        if line[0] == 3.0 && STOPS.contains(&name) && k > 50 {
            break;
        }
        assert_eq!(line[0], 0.0, "{name}, step {k}");
        for (order, numbers) in orders.iter().enumerate() {
            let size = if order == 0 { own } else { 0.0 };
            most[order] = most[order].max(off(&line[order * n + 1..][..n], numbers, size));
        }
    }
    println!("{name}: {:.0e} {:.0e} {:.0e}", most[0], most[1], most[2]);
    let within = most.iter().zip([1e-12, 1e-11, 1e-9]).all(|(off, bound)| *off <= bound);
    assert!(within, "{name}: {most:?}");
}

/// The number of steps of each mechanism.
fn steps() -> usize {
    std::env::var("KIN_EMIT_STEPS").ok().and_then(|n| n.parse().ok()).unwrap_or(200)
}

#[test]
fn every_example_is_printed_and_agrees() -> kin::Result<()> {
    let there = there_is_a_compiler();
    for (name, system) in mechanisms() {
        let text = emit::c(&system, &Options::default())?;
        if there {
            compare(&name, &system, &text, steps());
        }
    }
    Ok(())
}
