//! Programs of many cases: faults of what is left free are planted, and never come to a number.

use super::super::cases::By;
use super::*;
use crate::constraint;
use crate::joints::drivers::drive;
use crate::solve::whole_run;

fn compiled() -> SolverOptions {
    SolverOptions::new().engine(Engine::Compiled)
}

/// The means for cases that differ in these names.
fn cases_of(system: &System, names: &[&str], times: &[f64]) -> Cases {
    let names: Vec<String> = names.iter().map(|name| (*name).to_string()).collect();
    let places = system.places(&names).expect("places");
    let set = |_: &mut System, _: usize| Ok(());
    let varied = Varied { system, names: &names, places: &places, count: 4, times, set: &set };
    Cases::new(&varied, &compiled(), Lanes::Best).expect("compiles")
}

/// How many times a tape computes with these numbers of a case, and how far off they are from plain
/// steps.
fn computed(system: &System, times: &[f64], tape: &Arc<Tape>, case: &Case) -> (usize, f64) {
    let options = compiled();
    let mut run = Run::new(system, &options, None).expect("runs");
    let mut motion = Motion::new(system, times.len());
    replay(&mut run, times, &mut motion, (tape, case), Lanes::Best).expect("runs");
    let plain = Asked { system, times, jerk: false }.plain();
    (motion.engine.compiled, difference(&motion, &plain))
}

/// A number that was folded is looked at in each case: one in which it is another has other means.
#[test]
fn a_case_that_differs_in_what_was_folded_is_not_computed_by_the_program_of_others() {
    let system = four_bar(1.0);
    let times = linspace(0.0, 0.4, 41);
    let options = compiled();
    let cases = cases_of(&system, &["A.u_i.x"], &times);
    let By::Program(tape) = &cases.by else { panic!("a program") };
    let by_own = |name: &str, value: f64| {
        let mut case = system.clone();
        case.set(name, value).expect("sets");
        let shared = tape.case(&case).is_some();
        let computing = cases.computing(&case, times.len(), &options).expect("computes");
        let own = Asked { system: &case, times: &times, jerk: false }.plain();
        let found = whole_run::run_by(&case, &times, (&options, None), computing).expect("runs");
        assert!(difference(&found, &own) < 1e-9 && found.engine.compiled > 30, "{name}");
        shared
    };
    assert!(by_own("A.u_i.x", 0.45));
    assert!(!by_own("A.u_i.y", 0.05));
    // The planted fault: a number that is believed to be what it was.
    let mut case = system.clone();
    case.set("A.u_i.y", 0.05).expect("sets");
    assert_eq!(computed(&case, &times, tape, &tape.case(&system).expect("fits")), (0, 0.0));
}

/// A rod, whose length stands in its equation as a square: a step of parameters alone.
#[constraint]
fn rod(x: Coord, y: Coord, a: f64, l: f64) -> f64 {
    (x - a) * (x - a) + y * y - l * l
}

/// Every step of a tape of cases in turn, those of parameters too, and every number of a case.
#[test]
fn wrong_steps_and_numbers_of_a_program_of_cases_never_come_to_a_number() {
    let mut m = crate::Mechanism::new("slide");
    let [x, y] =
        [("x", 0.3), ("y", 0.95)].map(|(name, at)| m.length(name, at).expect("a new name"));
    m.add("rod", rod(x, y, 0.02, 1.0)).expect("adds");
    m.add("motor", drive(x, crate::Law::sine(0.3, 1.0, 0.5))).expect("adds");
    let system = m.build().expect("builds");
    let times = linspace(0.0, 0.4, 41);
    let cases = cases_of(&system, &["rod.l", "rod.a", "motor.law.amplitude"], &times);
    let By::Program(tape) = &cases.by else { panic!("a program") };
    let mut case = system.clone();
    for (name, value) in [("rod.l", 1.1), ("rod.a", 0.05), ("motor.law.amplitude", 0.25)] {
        case.set(name, value).expect("sets");
    }
    let own = tape.case(&case).expect("fits");
    assert_eq!((own.parameters.len(), own.laws.len()), (2, 1));
    let (count, off) = computed(&case, &times, tape, &own);
    assert!(count > 35 && off < 1e-11, "{count} {off:e}");
    for k in 0..own.parameters.len() {
        let mut wrong = own.clone();
        wrong.parameters[k] *= 1.0 + 1e-6;
        assert_eq!(computed(&case, &times, tape, &wrong), (0, 0.0), "parameter {k}");
    }
    let wrong = Case { laws: tape.case(&system).expect("fits").laws, ..own.clone() };
    assert_eq!(computed(&case, &times, tape, &wrong), (0, 0.0));
    let mut noticed = 0;
    for (slip, k) in plant::SLIPS.into_iter().flat_map(|slip| (0..200).map(move |k| (slip, k))) {
        let mut wrong = (**tape).clone();
        if plant::spoil(&mut wrong, slip, k) {
            let (count, off) = computed(&case, &times, &Arc::new(wrong), &own);
            assert!(off < 1e-11, "{slip:?} {k}: {off:e} of {count}");
            noticed += usize::from(count == 0);
        }
    }
    assert!(noticed > 20, "{noticed}");
}
