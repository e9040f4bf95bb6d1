//! Random four-bars against their closed form: what is proved is true.

use kin::error::FailureKind;
use kin::prelude::*;
use kin::results::{StepProof, Tube};
use kin::{Follow, SolverOptions};

use crate::engines::Engines;
use crate::hermite::interpolated;
use crate::models::FourBar;

/// How many a test run takes; `KIN_CAMPAIGN=10000` is the whole campaign, for a release build.
fn count() -> usize {
    std::env::var("KIN_CAMPAIGN").ok().and_then(|count| count.parse().ok()).unwrap_or(200)
}

/// A four-bar that can be driven from `start`, an assembly of it, and the time of its toggle at one
/// turn a second.
struct Case {
    bar: FourBar,
    start: f64,
    side: f64,
    sense: f64,
    end: Option<f64>,
}

impl Case {
    fn random(random: &mut fastrand::Rng) -> Case {
        loop {
            let within =
                |random: &mut fastrand::Rng, low: f64, high: f64| low + (high - low) * random.f64();
            let [driven, next, last, ground] = std::array::from_fn(|_| within(random, 0.3, 3.0));
            let bar = FourBar { driven, next, last, ground, by_coupler: random.bool() };
            let start = within(random, 0.0, TAU);
            let side = sign(random);
            let sense = sign(random);
            let end = bar.toggle(start, sense).map(|angle| sense * (angle - start) / TAU);
            if bar.angles(start, side).is_some() && end.is_none_or(|end| end > 0.05) {
                return Case { bar, start, side, sense, end };
            }
        }
    }

    fn system(&self) -> System {
        self.bar
            .system(Law::linear(self.start, self.sense * TAU), self.start, self.side)
            .expect("builds")
            .0
    }

    /// Some turns, or as far as its toggle.
    fn run(&self, random: &mut fastrand::Rng) -> Motion {
        let times = linspace(0.0, 0.6, random.usize(8..20));
        match self.system().run_both(times) {
            Ok(motion) => motion,
            Err(error) => {
                let is_toggle = matches!(error.kind(), Some(FailureKind::Toggle { .. }));
                assert!(is_toggle, "{:?}: {error}", self.bar);
                error.into_motion().expect("the motion before")
            }
        }
    }
}

fn sign(random: &mut fastrand::Rng) -> f64 {
    if random.bool() { 1.0 } else { -1.0 }
}

/// Tests that the closed form is in the tube at 9 times of a step, and that the other assembly is
/// not where nothing else is said to be.
fn judge(case: &Case, motion: &Motion, step: &StepProof, tube: &Tube) {
    for j in 0..=8 {
        let u = f64::from(j) / 8.0;
        let t = step.from + u * (step.to - step.from);
        let p = interpolated(motion, step.step, u);
        let angle = case.start + case.sense * TAU * t;
        let name = || {
            format!(
                "{:?} from {} to {} on side {}, t = {t}",
                case.bar, case.start, case.sense, case.side
            )
        };
        let pose = case
            .bar
            .pose(angle, case.side)
            .unwrap_or_else(|| panic!("{}: proved, but there is no position", name()));
        let away = |pose: &[f64; 9], k: usize| {
            let d = p[k] - pose[k];
            if k % 3 == 2 { (d + PI).rem_euclid(TAU) - PI } else { d }.abs()
        };
        // the closed form has an error of its own, which grows towards the toggle
        let other = case.bar.pose(angle, -case.side).expect("the same position");
        let apart = (0..9).map(|k| (pose[k] - other[k]).abs()).fold(0.0, f64::max);
        for (k, radius) in tube.radius.iter().enumerate() {
            assert!(
                away(&pose, k) <= radius + 1e-13 + 1e-14 / apart,
                "{}: off by {:e}, tube {radius:e}",
                name(),
                away(&pose, k)
            );
        }
        assert!(
            (0..9).any(|k| away(&other, k) > tube.alone[k]),
            "{}: the other assembly is in the tube",
            name()
        );
        let between = |k: usize| {
            let d = pose[k] - other[k];
            if k % 3 == 2 { (d + PI).rem_euclid(TAU) - PI } else { d }.abs()
        };
        assert!(
            (0..9).any(|k| between(k) > tube.free[k]),
            "{}: the other assembly is where nothing else is said to be",
            name()
        );
    }
}

/// A step of nearly half a turn is proved in pieces, and what is interpolated over it is far from
/// the motion. Whatever else is near is still at a positive distance from the motion.
#[test]
fn the_free_distance_of_a_step_in_many_pieces_is_positive() {
    let bar = FourBar { driven: 1.0, next: 3.5, last: 3.0, ground: 4.0, by_coupler: false };
    let (system, _) = bar.system(Law::linear(0.3, 1.0), 0.3, 1.0).expect("builds");
    let motion = system.run([0.0, 3.0]).expect("runs");
    let proof = system.prove(&motion).expect("can be proved");
    assert!(proof.is_complete(), "{proof}");
    let tube = proof.steps()[0].tube.as_ref().expect("is proved");
    assert!(tube.free.iter().all(|free| *free > 0.0), "{:?}", tube.free);
    assert!(tube.radius.iter().zip(&tube.alone).any(|(radius, alone)| radius > alone));
    let text = proof.to_string();
    assert!(!text.contains("within -"), "{text}");
}

#[test]
fn what_is_proved_is_the_closed_form() {
    let mut random = fastrand::Rng::with_seed(7);
    let mut all = 0;
    let mut proved = 0;
    let mut regular = 0;
    let mut regular_proved = 0;
    for _ in 0..count() {
        let case = Case::random(&mut random);
        let motion = case.run(&mut random);
        let proof = case.system().prove(&motion).expect("can be proved");
        for step in proof.steps() {
            let done = step.tube.as_ref().is_ok_and(|tube| {
                judge(&case, &motion, step, tube);
                true
            });
            all += 1;
            proved += usize::from(done);
            if case.bar.clearance() > 0.02 || case.end.is_some_and(|end| end - step.to > 0.01) {
                regular += 1;
                regular_proved += usize::from(done);
            }
        }
    }
    println!("{proved} of {all} steps, {regular_proved} of {regular} regular ones");
    assert!(
        regular > all / 2 && regular_proved * 100 >= regular * 99,
        "{regular_proved} of {regular}"
    );
}

/// A motion that is in the other assembly from some time on: the step into it is not proved; all
/// others are, but for a few that turn too fast for their grid.
#[test]
fn a_change_of_assembly_is_found() {
    let mut random = fastrand::Rng::with_seed(8);
    let mut found = 0;
    let mut others = 0;
    for _ in 0..count() / 4 {
        let case = Case::random(&mut random);
        if case.end.is_some() || case.bar.clearance() < 0.05 {
            continue;
        }
        let other = Case { side: -case.side, ..case };
        let times = linspace(0.0, 1.0, 31);
        let [one, two] =
            [&case, &other].map(|case| case.system().run_both(&times).expect("runs").data());
        let mut forged = one;
        let at = random.usize(1..30);
        for (to, from) in
            [(&mut forged.q, two.q), (&mut forged.qd, two.qd), (&mut forged.qdd, two.qdd)]
        {
            to.splice(at.., from[at..].iter().cloned());
        }
        let proof = case
            .system()
            .prove(&Motion::from_data(&forged).expect("reads"))
            .expect("can be proved");
        let unproved: Vec<usize> =
            proof.steps().iter().filter(|step| step.tube.is_err()).map(|step| step.step).collect();
        assert!(unproved.contains(&(at - 1)), "{:?}: {proof}", case.bar);
        assert!(
            unproved[0] != at - 1
                || proof
                    .to_string()
                    .contains(&format!("The first step without proof is step {at}, from t = ")),
            "{proof}"
        );
        found += 1;
        others += unproved.len() - 1;
    }
    assert!(found * 40 > count() && others <= found / 20, "{others} others in {found}");
}

/// Coarse grids with nothing checked and nothing predicted, on which Newton's method comes to
/// whatever assembly: steps that change it are never proved.
#[test]
fn careless_runs_are_not_proved_where_they_jump() {
    let careless = SolverOptions::new().follow(Follow::Unchecked).predict(false).rescue(false);
    let mut random = fastrand::Rng::with_seed(9);
    let mut jumps = 0;
    let mut stays = 0;
    for _ in 0..count() / 2 {
        let case = Case::random(&mut random);
        let points = random.usize(4..8);
        let system = case.system();
        let times = linspace(0.0, 2.0, 2 * points + 1);
        // The position that such a run comes to hangs on the last digits: one engine is enough.
        let Ok(motion) = system.solver().options(careless.clone()).run(times) else { continue };
        let side = |k: usize| {
            if case.bar.error(motion.q(k), case.side) < 1e-6 { case.side } else { -case.side }
        };
        let proof = system.prove(&motion).expect("can be proved");
        for step in proof.steps() {
            let jump = side(step.step) != side(step.step + 1);
            jumps += usize::from(jump);
            if let Ok(tube) = &step.tube {
                assert!(!jump, "{:?}: step {} changes its assembly: {proof}", case.bar, step.step);
                judge(&Case { side: side(step.step), ..case }, &motion, step, tube);
                stays += 1;
            }
        }
    }
    println!("{jumps} jumps, {stays} steps proved");
    assert!(jumps * 20 > count() && stays > count());
}
