//! Random moves of followers over many linkages: each ends where a run of 500 times along its path
//! ends, and the way back leads to where it began.

use kin::Error;
use kin::data::{MechanismData, Registry};
use kin::error::FailureKind;
use kin::prelude::*;
use kin::solver::{Follower, NamedValue};
use serde_json::{Value, json};

use crate::ankle::ANKLE;
use crate::own;

/// Times of the run that judges a move.
const TIMES: usize = 501;

/// How many moves a test makes; `KIN_CAMPAIGN=1000000` is the whole campaign, for a release build.
fn count() -> u64 {
    std::env::var("KIN_CAMPAIGN").map_or(120, |count| count.parse().expect("a number"))
}

/// A mechanism as a file, so that its laws can be replaced.
struct Linkage {
    name: String,
    file: Value,
    start: Follower,
}

fn registry() -> Registry {
    Registry::new().with::<own::slider_crank>().with::<own::parabolic_slot>().with::<own::geneva>()
}

fn built(file: &Value) -> kin::Result<System> {
    let data = MechanismData::read(&file.to_string())?;
    Mechanism::from_data(&data, &registry())?.build()
}

/// The drivers of a five-bar, and of three cranks on one rod, of which one is superfluous.
fn others() -> Vec<Mechanism> {
    let mut five = Mechanism::new("five-bar");
    let [a, b] = ["left", "right"].map(|name| five.link(name, 1.0).unwrap());
    let [c, d] = ["left rod", "right rod"].map(|name| five.link(name, 1.4).unwrap());
    five.add("O", revolute(Ground, a, vec2(0.0, 0.0), a.start())).unwrap();
    five.add("Q", revolute(Ground, b, vec2(1.5, 0.0), b.start())).unwrap();
    five.add("A", revolute(a, c, a.end(), c.start())).unwrap();
    five.add("B", revolute(b, d, b.end(), d.start())).unwrap();
    five.add("P", revolute(c, d, c.end(), d.end())).unwrap();
    five.add("left motor", drive_angle(a, Law::constant(deg(120.0)))).unwrap();
    five.add("right motor", drive_angle(b, Law::constant(deg(60.0)))).unwrap();
    five.prefer(c, deg(40.0));
    let mut three = Mechanism::new("three cranks");
    let rod = three.link("rod", 2.0).unwrap();
    let cranks = ["a", "b", "c"].map(|name| three.link(name, 1.0).unwrap());
    for (k, crank) in cranks.into_iter().enumerate() {
        let x = k as f64;
        three.add(&format!("O{k}"), revolute(Ground, crank, vec2(x, 0.0), crank.start())).unwrap();
        three.add(&format!("A{k}"), revolute(crank, rod, crank.end(), vec2(x - 1.0, 0.0))).unwrap();
        three.prefer(crank, 0.8);
    }
    three.add("motor", drive_angle(cranks[0], Law::constant(0.8))).unwrap();
    vec![five, three, ANKLE.mechanism().unwrap()]
}

fn linkages() -> Vec<Linkage> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/examples");
    let mut files: Vec<Value> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| std::fs::read_to_string(entry.unwrap().path()).unwrap())
        .map(|text| serde_json::from_str(&text).unwrap())
        .collect();
    files.sort_by_key(|file| file["name"].as_str().map(str::to_string));
    for mechanism in others() {
        files.push(serde_json::to_value(mechanism.data().unwrap()).unwrap());
    }
    let mut all = Vec::new();
    for file in files {
        let name = file["name"].as_str().unwrap().to_string();
        // At the first of these times at which it can be followed: some begin at a dead centre.
        let system = built(&file).unwrap();
        if let Some(start) = [0.0, 0.137, 0.31].iter().find_map(|t| system.follower(*t).ok()) {
            all.push(Linkage { name, file, start });
        }
    }
    all
}

impl Linkage {
    /// The system whose drivers go along the straight line from one to the other configuration in
    /// a second.
    fn along(&self, q: &[f64], from: &[NamedValue], to: &[f64]) -> System {
        let mut file = self.file.clone();
        for (driver, to) in from.iter().zip(to) {
            let all = file["constraints"].as_array_mut().unwrap();
            let own = |name: &str| all.iter().position(|one| one["name"] == name);
            let (k, law) = match own(&driver.name) {
                Some(k) => (k, "law"),
                None => {
                    let (constraint, law) = driver.name.rsplit_once('.').unwrap();
                    (own(constraint).unwrap(), law)
                }
            };
            let numbers = json!({ "f0": driver.value, "rate": to - driver.value });
            all[k]["parameters"][law] = json!({ "kind": "linear", "numbers": numbers });
        }
        for body in file["bodies"].as_array_mut().unwrap() {
            body.as_object_mut().unwrap().remove("preferred");
        }
        let mut system = built(&file).unwrap();
        system.set_initial(q).unwrap();
        system
    }

    /// A move of all drivers, short or long.
    fn target(&self, random: &mut fastrand::Rng) -> Vec<f64> {
        let drivers = self.start.drivers();
        let alone = random.usize(0..2 * drivers.len());
        let far = 10_f64.powf(4.3 * random.f64() - 3.0);
        let value = |(k, driver): (usize, &NamedValue)| {
            if alone < drivers.len() && alone != k {
                return driver.value;
            }
            let is_angle = driver.unit.as_deref() == Some("rad");
            let size = if is_angle { 1.0 } else { 0.1 * self.size(driver) };
            driver.value + far * size * (2.0 * random.f64() - 1.0)
        };
        drivers.iter().enumerate().map(value).collect()
    }

    /// How far out and back may end from where it began. Rounding moves suspensions by a few times
    /// as much as others: their rods are long beside the distances that they hold.
    fn rounding(&self) -> f64 {
        let is_suspension = ["toe", "double wishbone suspension"].contains(&&*self.name);
        if is_suspension { 4e-12 } else { 1e-12 }
    }

    /// A length of the mechanism.
    fn size(&self, driver: &NamedValue) -> f64 {
        let q = self.start.here().q();
        q.iter().fold(driver.value.abs(), |most, x| most.max(x.abs()))
    }
}

/// How far two positions are apart, as a share of their size.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let size = a.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
    a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs())) / size
}

/// How many moves ended in each way, and the largest deviations.
#[derive(Debug, Default)]
struct Counts {
    ended: u64,
    stopped: u64,
    stayed: u64,
    by_steps: u64,
    proved: u64,
    worst: f64,
    back: f64,
}

fn judge(linkage: &Linkage, seed: u64, counts: &mut Counts) {
    let mut random = fastrand::Rng::with_seed(seed);
    let mut follower = linkage.start.clone();
    let from = follower.drivers();
    let q = follower.here().q().to_vec();
    let to = linkage.target(&mut random);
    let names: Vec<&str> = from.iter().map(|driver| driver.name.as_str()).collect();
    let values = |to: &[f64]| names.iter().copied().zip(to.to_vec()).collect::<Vec<_>>();
    let moved = follower.to(values(&to)).map(|here| here.q().to_vec());
    let run = linkage.along(&q, &from, &to).run(linspace(0.0, 1.0, TIMES));
    let place = || format!("{}, move {seed} from {from:?} to {to:?}", linkage.name);
    match (moved, run) {
        (Ok(end), Ok(motion)) => {
            counts.ended += 1;
            let off = apart(&end, motion.q(TIMES - 1));
            counts.worst = counts.worst.max(off);
            assert!(off < 1e-7, "{}: off the branch by {off:e}", place());
            if seed.is_multiple_of(16) {
                by_small_steps(linkage, &to, &end, &place());
                counts.by_steps += 1;
            }
            if seed % 64 == 1 {
                counts.proved += u64::from(is_proved(linkage, values(&to), &end, &place()));
            }
            let start: Vec<f64> = from.iter().map(|driver| driver.value).collect();
            let back = follower.to(values(&start)).unwrap_or_else(|error| {
                panic!("{}: on the way back, {error}", place());
            });
            let off = apart(back.q(), &q);
            counts.back = counts.back.max(off);
            assert!(off < linkage.rounding(), "{}: back with {off:e}", place());
        }
        (Err(Error::CannotReach(stop)), Err(Error::Run(failure)))
            if stop.singular.is_some() && matches!(failure.kind, FailureKind::Toggle { .. }) =>
        {
            let t = failure.t;
            counts.stopped += 1;
            for (driver, to) in from.iter().zip(&to).filter(|(driver, to)| driver.value != **to) {
                let reached = stop.reached.iter().find(|one| one.name == driver.name).unwrap();
                let exact = driver.value + t * (to - driver.value);
                let near = 1e-9 * (1.0 + exact.abs());
                assert!((reached.value - exact).abs() < near, "{}: {stop}, {exact}", place());
            }
            let start: Vec<f64> = from.iter().map(|driver| driver.value).collect();
            follower.to(values(&start)).unwrap_or_else(|error| {
                panic!("{}: on the way back from a stop, {error}", place());
            });
        }
        // Both stop on the way: where an equation is not defined, or redundant ones are singular.
        (Err(Error::CannotReach(_)), Err(_)) => counts.stayed += 1,
        (moved, run) => {
            let run = run.map(|motion| motion.q(TIMES - 1).to_vec());
            panic!("{}: {moved:?}, {run:?}", place());
        }
    }
}

/// Many small steps along the path lead to the same end.
fn by_small_steps(linkage: &Linkage, to: &[f64], end: &[f64], place: &str) {
    const STEPS: usize = 1000;
    let mut follower = linkage.start.clone();
    let from = follower.drivers();
    for k in 1..=STEPS {
        let share = k as f64 / STEPS as f64;
        let at = |(driver, to): (&NamedValue, &f64)| {
            (driver.name.clone(), driver.value + share * (to - driver.value))
        };
        let step: Vec<(String, f64)> = from.iter().zip(to).map(at).collect();
        follower.to(step).unwrap_or_else(|error| panic!("{place}: step {k}, {error}"));
    }
    let off = apart(follower.here().q(), end);
    assert!(off < 1e-7, "{place}: small steps end {off:e} away");
}

/// True if the whole way is proved; then it ends at the same position.
fn is_proved(linkage: &Linkage, to: Vec<(&str, f64)>, end: &[f64], place: &str) -> bool {
    let mut follower = linkage.start.clone();
    let Ok(proof) = follower.prove_to(to, 200) else { return false };
    let off = apart(follower.here().q(), end);
    assert!(off < 1e-7, "{place}: the proved way ends {off:e} away");
    proof.first_unproved().is_none()
}

#[test]
fn random_moves_end_where_runs_along_their_paths_end() {
    let all = linkages();
    assert!(all.len() >= 20, "{} linkages", all.len());
    assert!(all.iter().filter(|one| one.start.drivers().len() > 1).count() >= 5);
    let mut counts = Counts::default();
    for seed in 0..count() {
        judge(&all[seed as usize % all.len()], seed, &mut counts);
    }
    println!("{} linkages, {counts:?}", all.len());
    let few = counts.ended + counts.stopped;
    assert!(counts.ended > count() / 2 && few > count() * 4 / 5, "{counts:?}");
    assert!(counts.by_steps > 0 && counts.proved > 0, "{counts:?}");
}

/// A proved move, and errors that leave the follower where it was.
#[test]
fn a_move_is_proved_step_by_step() {
    let mut follower = linkages().swap_remove(0).start;
    let name = follower.drivers()[0].name.clone();
    let value = follower.drivers()[0].value;
    let proof = follower.prove_to([(name.as_str(), value + 0.05)], 20).unwrap();
    assert_eq!((proof.proved(), proof.trusted().len()), (20, 0));
    assert_eq!(follower.drivers()[0].value, value + 0.05);
    let none = follower.prove_to([(name.as_str(), value)], 0).unwrap_err().to_string();
    assert!(none.contains("at least 1 step"), "{none}");
    let unknown = follower.prove_to([("nothing", value)], 3).unwrap_err().to_string();
    assert!(unknown.contains("`nothing`"), "{unknown}");
    assert_eq!(follower.drivers()[0].value, value + 0.05);
}
