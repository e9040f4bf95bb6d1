//! The same run by plain steps and by a program: the same numbers, verdicts, names and events, most
//! times of a fine grid computed by the program, or the reason by name why there is none.

use kin::error::FailureKind;
use kin::extend::Route;
use kin::extend::RouteReason;
use kin::prelude::*;
use kin::solver::Stop;
use kin::{Engine, Error, SolverOptions};

#[path = "condition.rs"]
mod condition;
#[path = "undefined.rs"]
mod undefined;

use condition::Condition;
#[allow(unused_imports)]
pub use undefined::is_undefined;

/// How far q, q̇, q̈ and q⃛ may be apart, by 1 and the largest number of their kind in the motion:
/// the tolerances of the references (`tests/data/README.md`), to which either engine is held alone,
/// and for q⃛, of which there are none, as much more as one derivative more takes there. Where the
/// equations are nearly singular, rounding of them may take the engines further apart, but no more
/// than their [`Condition`] says.
const APART: [f64; 4] = [1e-12, 1e-11, 1e-9, 1e-7];

/// So many times more with a singular position on the way, as the references allow near one.
const NEAR_SINGULAR: f64 = 10.0;

/// However ill-conditioned equations are, so many digits must agree in a motion without singular
/// positions.
const DIGITS: f64 = 1e-6;

/// At a singular position C_q has no inverse. Rounding of positions beside one is divided by how
/// far away that is, as a share of the motion's time, for C_q is as small there; and of each order
/// of rates it is divided once more. Nearer than `NEAREST` single steps compute rates.
const ROUNDING: f64 = f64::EPSILON / 16.0;
const NEAREST: f64 = 2e-4;

/// Steps that change no angle and no Euler parameter by more than this are short: a program
/// computes them.
const SHORT: f64 = 0.1;

/// Runs by both engines. Each program of tests calls what it needs.
#[allow(dead_code)]
pub trait Engines {
    /// [`System::run`] by plain steps, after a run by a program has been compared with it.
    fn run_both(&self, times: impl AsRef<[f64]>) -> kin::Result<Motion>;

    /// The same with options, the engine apart.
    fn run_both_with(
        &self,
        times: impl AsRef<[f64]>,
        options: &SolverOptions,
    ) -> kin::Result<Motion>;

    /// [`System::run`] by plain steps, after one by the engine that is chosen by itself, a program
    /// where that pays, has been compared with it.
    fn run_both_by_auto(&self, times: impl AsRef<[f64]>) -> kin::Result<Motion>;

    /// [`System::run`] by plain steps, after runs by each other engine have been compared with it,
    /// however many times of them a program has computed. Rounding of lengths is this share of
    /// them.
    fn run_by_all(&self, times: impl AsRef<[f64]>, rounding: f64) -> kin::Result<Motion>;

    /// [`System::run`] by a program, or by plain steps where there is a reason for that.
    fn run_compiled(&self, times: impl AsRef<[f64]>) -> kin::Result<Motion>;
}

impl Engines for System {
    #[track_caller]
    fn run_both(&self, times: impl AsRef<[f64]>) -> kin::Result<Motion> {
        self.run_both_with(times, &SolverOptions::default())
    }

    #[track_caller]
    fn run_both_with(
        &self,
        times: impl AsRef<[f64]>,
        options: &SolverOptions,
    ) -> kin::Result<Motion> {
        let times = times.as_ref();
        let plain = options.clone().engine(Engine::StepByStep);
        // A program always predicts.
        let compiled = options.clone().engine(Engine::Compiled).predict(true);
        let plain = self.solver().options(plain.clone()).run(times);
        match (&plain, self.solver().options(compiled.clone()).run(times)) {
            (_, Err(error)) if is_refusal(&error) => is_right(self, &error.to_string()),
            (Ok(plain), Ok(program)) => {
                assert_eq!(stands_in_the_way(self), None, "{}", program.summary());
                is_same(self, plain, &program, options.stop)
            }
            (Err(plain), Err(program)) => ends_the_same(plain, &program, times),
            (plain, program) => panic!("{:?} {:?}", plain.as_ref().err(), program.err()),
        }
        plain
    }

    #[track_caller]
    fn run_both_by_auto(&self, times: impl AsRef<[f64]>) -> kin::Result<Motion> {
        let times = times.as_ref();
        let plain =
            self.solver().options(SolverOptions::new().engine(Engine::StepByStep)).run(times);
        match (&plain, self.run(times)) {
            (Ok(plain), Ok(chosen)) => {
                if let Some(reason) = chosen.why_not_compiled() {
                    is_right(self, reason);
                } else if chosen.engine().compiled > 0 {
                    is_told(plain, &chosen);
                }
                is_near(self, plain, &chosen, SolverOptions::default().stop)
            }
            (Err(plain), Err(chosen)) => ends_the_same(plain, &chosen, times),
            (plain, chosen) => panic!("{:?} {:?}", plain.as_ref().err(), chosen.err()),
        }
        plain
    }

    #[track_caller]
    fn run_by_all(&self, times: impl AsRef<[f64]>, rounding: f64) -> kin::Result<Motion> {
        let times = times.as_ref();
        let by = |engine| self.solver().options(SolverOptions::new().engine(engine)).run(times);
        let plain = by(Engine::StepByStep);
        for engine in [Engine::Compiled, Engine::Auto] {
            match (&plain, by(engine)) {
                (_, Err(error)) if is_refusal(&error) => is_right(self, &error.to_string()),
                (Ok(plain), Ok(other)) => {
                    let stop = SolverOptions::default().stop;
                    is_near_but_for(rounding, self, plain, &other, stop)
                }
                // Far off rounding decides which equation is said to be missed most.
                (Err(plain), Err(other)) if rounding <= f64::EPSILON => {
                    ends_the_same(plain, &other, times)
                }
                (Err(plain), Err(other)) => ends_at_once(rounding, plain, &other, times),
                (plain, other) => {
                    panic!("{engine:?}: {:?} {:?}", plain.as_ref().err(), other.err())
                }
            }
        }
        plain
    }

    #[track_caller]
    fn run_compiled(&self, times: impl AsRef<[f64]>) -> kin::Result<Motion> {
        let by = |engine: Engine| SolverOptions::new().engine(engine);
        match self.solver().options(by(Engine::Compiled)).run(&times) {
            Err(error) if is_refusal(&error) => {
                is_right(self, &error.to_string());
                self.solver().options(by(Engine::StepByStep)).run(times)
            }
            run => run,
        }
    }
}

fn is_refusal(error: &Error) -> bool {
    matches!(error, Error::InvalidOptions { reason } if reason.contains("Kin cannot compile"))
}

/// Why there can be no program, as a user sees it from outside: more equations than coordinates, or
/// else the first equation that the compiler has not read.
fn stands_in_the_way(system: &System) -> Option<String> {
    if system.n_equations() > system.n_coordinates() {
        return Some(
            "Kin cannot compile the mechanism: the mechanism has more equations than coordinates"
                .into(),
        );
    }
    let unread =
        system.constraints().find(|(_, constraint)| constraint.facts().route() != Route::Symbolic);
    unread.map(|(name, _)| {
        format!("Kin cannot compile `{name}`: Kin does not know the equation as a formula")
    })
}

/// Fails unless a refusal names what stands in the way.
fn is_right(system: &System, text: &str) {
    // Where lanes are turned off no equation is asked.
    if text.contains("this machine has no registers") {
        assert_eq!(std::env::var("KIN_LANES").as_deref(), Ok("off"), "{text}");
        return;
    }
    if let Some(reason) = stands_in_the_way(system) {
        assert!(text.contains(&reason), "{text}: {reason}");
        return;
    }
    let is_named = |(name, _): &(&str, &dyn Constraint)| {
        text.contains(&format!("Kin cannot compile `{name}`: "))
    };
    let named = system.constraints().find(is_named).map(|(_, constraint)| constraint.facts());
    let facts = named.unwrap_or_else(|| panic!("no constraint is named: {text}"));
    let reads_others = matches!(facts.reason, RouteReason::ReadBut { .. });
    assert!(reads_others && text.contains("only rustc can read"), "{text}");
}

#[track_caller]
fn is_same(system: &System, plain: &Motion, program: &Motion, stop: Stop) {
    is_told(plain, program);
    is_near(system, plain, program, stop);
}

/// The same verdicts, and numbers within the tolerances.
#[track_caller]
fn is_near(system: &System, plain: &Motion, program: &Motion, stop: Stop) {
    is_near_but_for(0.0, system, plain, program, stop);
}

/// The same where rounding of lengths is this share of them.
#[track_caller]
fn is_near_but_for(rounding: f64, system: &System, plain: &Motion, program: &Motion, stop: Stop) {
    assert_eq!(plain.times(), program.times());
    meets_the_same(rounding, plain, program);
    // A looser stop rule leaves that much of each engine's positions undecided.
    let (Stop::Converged { tolerance } | Stop::ResidualOnly(tolerance)) = stop;
    let loose = (tolerance / 1e-13).max(1.0).max(10.0 * rounding / APART[0]);
    let off = apart(system, plain, program, loose, rounding);
    assert!(off.iter().all(|off| *off <= 1.0), "{}: {off:?} {:?}", plain.name(), program.engine());
}

/// The largest differences of q, q̇, q̈ and q⃛ as shares of what is allowed; infinite where one is
/// no number. Where a law breaks, or an equation has a kink, rates are those of one side, and
/// rounding decides which: there q alone counts.
#[allow(dead_code)]
pub fn apart(system: &System, a: &Motion, b: &Motion, loose: f64, rounding: f64) -> [f64; 4] {
    assert_eq!(a.has_jerk(), b.has_jerk());
    let rows = [Motion::q, Motion::qd, Motion::qdd, Motion::qddd];
    std::array::from_fn(|order| {
        let of = rows[order];
        let size = (0..a.len()).flat_map(|k| of(a, k)).fold(1.0_f64, |m, x| m.max(1.0 + x.abs()));
        let shares = (0..a.len()).map(|k| {
            let usual = size * usual(a, order, loose);
            let off: Vec<f64> = of(a, k).iter().zip(of(b, k)).map(|(a, b)| (a - b).abs()).collect();
            if off.iter().all(|off| *off <= usual) {
                return off.iter().fold(0.0_f64, |most, off| most.max(off / usual));
            }
            if order > 0 && is_undefined(system, a.times(), k, late(rounding, a.times())) {
                return 0.0;
            }
            let beside = beside_singular(a, k, order).map(|share| size * loose * share);
            // Without a condition only a singular position explains more than the usual.
            let unknown = beside.unwrap_or(usual);
            let most = beside.unwrap_or(size * DIGITS);
            let by_condition = Condition::at(system, a, k).and_then(|own| own.apart(order));
            let by_condition = by_condition.unwrap_or_else(|| vec![unknown; off.len()]);
            let share = |(off, own): (&f64, &f64)| {
                let share = off / own.min(most).max(usual);
                if share.is_nan() { f64::INFINITY } else { share }
            };
            off.iter().zip(&by_condition).map(share).fold(0.0, f64::max)
        });
        shares.fold(0.0, f64::max)
    })
}

/// How far numbers of an order may be apart anywhere in a motion, as a share of the largest one.
fn usual(motion: &Motion, order: usize, loose: f64) -> f64 {
    let more = if motion.singular_positions().is_empty() { 1.0 } else { NEAR_SINGULAR };
    loose * more * APART[order]
}

/// How far numbers of an order may be apart at most at a time of a motion with singular positions,
/// as a share of the largest one.
fn beside_singular(motion: &Motion, k: usize, order: usize) -> Option<f64> {
    let times = motion.times();
    let span = (times[times.len() - 1] - times[0]).abs();
    let ways = motion
        .singular_positions()
        .iter()
        .map(|found| ((times[k] - found.t).abs() / span).max(NEAREST));
    ways.reduce(f64::min).map(|way| ROUNDING / way.powi(order as i32 + 1))
}

/// Counts and summaries tell which engine has run; on a fine grid that was the program.
#[track_caller]
fn is_told(plain: &Motion, program: &Motion) {
    let counts = program.engine();
    let [by_steps, by_program] = [plain, program].map(Motion::summary);
    assert!(plain.engine().compiled == 0 && !by_steps.contains("compiled"), "{by_steps}");
    let line = format!("{} of {} times compiled", counts.compiled, program.len());
    assert_eq!(by_program.contains(&line), counts.compiled > 0, "{by_program}");
    let times = format!("{} times", counts.handed_back);
    assert!(
        counts.compiled == 0 || counts.handed_back < 2 || by_program.contains(&times),
        "{by_program}"
    );
    if is_fine(plain) {
        // Of few times one that is handed back counts for more.
        let share = if plain.len() < 200 { 6 } else { 20 };
        let many = 4 * counts.compiled >= plain.len();
        let few = share * counts.handed_back <= plain.len();
        assert!(many && few, "{}: {counts:?} of {}", plain.name(), plain.len());
    }
}

/// True of many short steps, with nothing on the way that stops them. Of fewer times rates may
/// change by so much from one to the next that few blocks come to anything.
fn is_fine(motion: &Motion) -> bool {
    let turns =
        motion.units().iter().map(|unit| unit == "rad" || unit == "-").collect::<Vec<bool>>();
    let is_short = |k: usize| {
        let steps = motion.q(k).iter().zip(motion.q(k - 1)).map(|(a, b)| (a - b).abs());
        steps.zip(&turns).all(|(step, turns)| !turns || step <= SHORT)
    };
    let stops = motion.singular_positions().len() + motion.breaks().len();
    motion.len() >= 100 && stops == 0 && (1..motion.len()).all(is_short)
}

#[track_caller]
fn meets_the_same(rounding: f64, plain: &Motion, program: &Motion) {
    let late = late(rounding, plain.times());
    let one = plain.singular_positions();
    let other = program.singular_positions();
    assert_eq!(one.len(), other.len(), "{one:?} {other:?}");
    for (a, b) in one.iter().zip(other) {
        assert_eq!(
            (a.kind, &a.movable, &a.branches.len()),
            (b.kind, &b.movable, &b.branches.len())
        );
        assert!((a.t - b.t).abs() <= late, "{a:?} {b:?}");
    }
    let one = plain.events();
    let other = program.events();
    assert_eq!(one.len(), other.len(), "{one:?} {other:?}");
    for (a, b) in one.iter().zip(other) {
        assert_eq!((a.kind, &a.name, words(&a.text)), (b.kind, &b.name, words(&b.text)));
        assert!((a.t - b.t).abs() <= late, "{a:?} {b:?}");
    }
    let breaks = |motion: &Motion| {
        let named = motion.breaks().iter();
        named
            .map(|own| (own.constraint.clone(), own.law.clone(), own.found.order))
            .collect::<Vec<_>>()
    };
    assert_eq!(breaks(plain), breaks(program));
}

#[track_caller]
fn ends_the_same(plain: &Error, program: &Error, times: &[f64]) {
    assert_eq!(words(&verdict(&plain.to_string())), words(&verdict(&program.to_string())));
    ends_at_once(0.0, plain, program, times);
}

/// The same kind of end, at the same time but for rounding of lengths, with the same names, after
/// as many times.
#[track_caller]
fn ends_at_once(rounding: f64, plain: &Error, program: &Error, times: &[f64]) {
    assert_eq!(ends_apart(rounding, plain, program, times), None);
}

/// The first difference between the ends of two runs, in words.
#[allow(dead_code)]
pub fn ends_apart(rounding: f64, one: &Error, other: &Error, times: &[f64]) -> Option<String> {
    let [names, names_of_other] = [one, other].map(named);
    let off = names.t.zip(names_of_other.t).map_or(0.0, |(t, other)| (t - other).abs());
    let [passed, passed_by_other] = [one, other].map(|error| error.motion().map(Motion::len));
    let what = if std::mem::discriminant(one) != std::mem::discriminant(other) {
        "kinds".to_string()
    } else if names.names != names_of_other.names {
        format!("names {:?} and {:?}", names.names, names_of_other.names)
    } else if off.is_nan() || off > late(rounding, times) {
        format!("times {off:e} s apart")
    } else if passed != passed_by_other {
        format!("{passed:?} and {passed_by_other:?} times before them")
    } else {
        return None;
    };
    Some(format!("errors, their {what}: {one} | {other}"))
}

/// How far apart in time two engines may find the same.
fn late(rounding: f64, times: &[f64]) -> f64 {
    let [Some(first), Some(last)] = [times.first(), times.last()] else { return 0.0 };
    let rounded = 8.0 * f64::EPSILON * first.abs().max(last.abs());
    (1e-9 + 1e2 * rounding) * (last - first).abs() + rounded
}

/// When an error happens, and all names in it.
#[derive(Default)]
struct Named {
    t: Option<f64>,
    names: Vec<String>,
}

fn named(error: &Error) -> Named {
    let Some(failure) = error.failure() else { return Named::default() };
    let all = |names: &[&str]| names.iter().map(|name| name.to_string()).collect();
    let names = match &failure.kind {
        FailureKind::NoConvergence { constraint, row, .. } => all(&[constraint, row]),
        FailureKind::SingularAt { movable, dependent, .. }
        | FailureKind::Toggle { movable, dependent, .. } => {
            movable.iter().chain(dependent).cloned().collect()
        }
        FailureKind::CannotFollow { reason } => all(&[&reason.to_string()]),
        FailureKind::WrongBranch { constraint, reason, .. } => all(&[constraint, reason]),
        FailureKind::LawJumps { constraint, law, .. } => all(&[constraint, law]),
        FailureKind::NotFinite { constraint, row, quantity, .. } => {
            all(&[constraint, row, quantity])
        }
        _ => return Named::default(),
    };
    Named { t: Some(failure.t), names }
}

/// A text without the others beside the equation that cannot be met: which of them are named at a
/// singular position hangs on the last digits of the pose.
fn verdict(text: &str) -> String {
    let without = |line: &str| match (line.find("; with "), line.find(" it ")) {
        (Some(from), Some(to)) if from < to => format!("{}{}\n", &line[..from], &line[to..]),
        _ => format!("{line}\n"),
    };
    text.lines().map(without).collect()
}

/// A text without its numbers, the last digits of which may differ.
fn words(text: &str) -> String {
    text.split(|c: char| c.is_ascii_digit() || ".-+".contains(c))
        .filter(|word| !word.is_empty() && *word != "e")
        .collect()
}
