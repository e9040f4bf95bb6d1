//! Random mechanisms, closed by construction at a known pose: assembled from a poor guess and
//! driven; a planted fault is named.

mod planar;
mod spatial;

use std::time::{Duration, Instant};

use kin::diagnosis::Class;
use kin::error::FailureKind;
use kin::prelude::*;

use crate::engines::Engines;

/// Random numbers, the same for the same seed.
struct Random(fastrand::Rng);

impl Random {
    fn new(seed: u64) -> Self {
        Random(fastrand::Rng::with_seed(seed))
    }

    /// In (−1, 1).
    fn number(&mut self) -> f64 {
        2.0 * self.0.f64() - 1.0
    }

    fn below(&mut self, n: usize) -> usize {
        self.0.usize(..n)
    }

    /// A law that begins at a value: straight, bent, or swinging.
    fn law(&mut self, value: f64) -> Law {
        let a = 0.3 * self.number();
        let b = 0.3 * self.number();
        match self.below(3) {
            0 => Law::linear(value, a),
            1 => Law::polynomial(&[value, a, b]),
            _ => Law::constant(value) + Law::sine(a, 1.0 + b, 0.0),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    None,
    Contradiction,
    Redundancy,
    MissingDriver,
}

const FAULTS: [Fault; 4] =
    [Fault::None, Fault::Contradiction, Fault::Redundancy, Fault::MissingDriver];

/// How far guesses are off, in lengths and radians.
const OFF: f64 = 0.08;

/// Adds a driver by its name, what it asks for moved by so much.
type Driver = Box<dyn Fn(&mut Mechanism, &str, f64)>;

/// Drivers that are kept until it is known which of them is at fault.
#[derive(Default)]
struct Drivers(Vec<Driver>);

impl Drivers {
    fn push<C: Constraint + Clone + 'static>(
        &mut self,
        law: Law,
        make: impl Fn(Law) -> C + 'static,
    ) {
        self.0.push(Box::new(move |m, name, moved| {
            m.add(name, make(law.clone() + Law::constant(moved))).unwrap();
        }));
    }

    /// Adds them, with the fault at one of them.
    fn add(self, m: &mut Mechanism, fault: Fault, random: &mut Random) {
        let chosen = random.below(self.0.len());
        for (k, driver) in
            self.0.iter().enumerate().filter(|(k, _)| fault != Fault::MissingDriver || *k != chosen)
        {
            driver(m, &format!("motor {k}"), 0.0);
        }
        match fault {
            Fault::Contradiction => self.0[chosen](m, "motor x", 0.3),
            Fault::Redundancy => self.0[chosen](m, "motor x", 0.0),
            Fault::None | Fault::MissingDriver => {}
        }
    }
}

/// The smallest singular value of C_q where a mechanism is called far from its toggles; lengths and
/// speeds are of order 1.
const FAR: f64 = 0.08;

/// Mechanisms from one seed after the other until one is far from singular at the pose by which it
/// was made.
fn regular(
    seed: u64,
    fault: Fault,
    make: impl Fn(u64, Fault) -> (Mechanism, Vec<f64>),
) -> Mechanism {
    for k in 0.. {
        let seed = (seed << 8) + k;
        let (whole, exact) = make(seed, Fault::None);
        let system = whole.build().unwrap();
        let values = system.jacobian(&exact, 0.0).unwrap().singular_values();
        assert!(system.residual(&exact, 0.0).unwrap().iter().all(|c| c.abs() < 1e-9), "{seed}");
        if values.min() > FAR {
            return make(seed, fault).0;
        }
    }
    unreachable!()
}

/// Tests that the mechanism does what it should: it runs, or its fault is named.
fn right(mechanism: Mechanism, fault: Fault) -> Result<(), String> {
    let named = |name: &str| name.starts_with("motor");
    let run = mechanism.build().and_then(|system| {
        let motion = system.run_both([0.0, 0.005, 0.01])?;
        Ok((system.diagnose(0.0)?, motion))
    });
    match (fault, run) {
        (Fault::None, Ok((found, motion))) => {
            let finite = (0..3).all(|k| {
                motion.q(k).iter().chain(motion.qd(k)).chain(motion.qdd(k)).all(|x| x.is_finite())
            });
            (finite && found.is_exactly_constrained()).then_some(()).ok_or(found.to_string())
        }
        (Fault::Redundancy, Ok((found, _))) => {
            let told = found
                .redundancies()
                .any(|set| set.terms.iter().any(|term| term.constraint == "motor x"));
            (told && found.can_be_driven()).then_some(()).ok_or(found.to_string())
        }
        (Fault::Contradiction, Err(error)) => {
            let Some(found) = error.diagnosis() else { return Err(error.to_string()) };
            let told = found.gaps.iter().any(|gap| named(&gap.constraint));
            let set = found.dependencies.iter().any(|set| {
                matches!(set.class, Class::Contradictory { .. })
                    && set.terms.iter().any(|term| term.constraint == "motor x")
            });
            (told && set).then_some(()).ok_or(error.to_string())
        }
        (Fault::MissingDriver, Err(error))
            if matches!(error.kind(), Some(FailureKind::CannotBeDriven)) =>
        {
            let Some(diagnosis) = error.diagnosis() else { return Err(error.to_string()) };
            (diagnosis.lasting_freedoms().count() == 1).then_some(()).ok_or(diagnosis.to_string())
        }
        (_, Ok((found, _))) => Err(format!("ran: {found}")),
        (_, Err(error)) => Err(error.to_string()),
    }
}

/// At least 99 of 100 do, within the time.
fn all_right(name: &str, seeds: std::ops::Range<u64>, make: fn(u64, Fault) -> Mechanism) {
    let begun = Instant::now();
    let cases = 4 * (seeds.end - seeds.start);
    let mut wrong = Vec::new();
    for fault in FAULTS {
        for seed in seeds.clone() {
            if let Err(text) = right(make(seed, fault), fault) {
                println!("{name} {seed} {fault:?}: {text}");
                wrong.push(format!("{name} {seed} {fault:?}: {text}"));
            }
        }
    }
    println!("{name}: {} of {cases} wrong in {:?}", wrong.len(), begun.elapsed());
    assert!(wrong.len() as u64 * 100 <= cases, "{} of {cases}\n{}", wrong.len(), wrong.join("\n"));
    assert!(begun.elapsed() < Duration::from_secs(240).mul_f64((cases as f64 / 100.0).max(1.0)));
}

#[test]
fn planar_mechanisms_run_or_their_fault_is_named() {
    all_right("planar", 0..20, planar::mechanism);
}

#[test]
fn spatial_mechanisms_run_or_their_fault_is_named() {
    all_right("spatial", 0..8, spatial::mechanism);
}

#[test]
#[ignore = "takes its time: `cargo test --release -- --ignored`"]
fn thousands_of_mechanisms_run_or_their_fault_is_named() {
    all_right("planar", 1000..1500, planar::mechanism);
    all_right("spatial", 1000..1250, spatial::mechanism);
}
