//! The same run by plain steps and by a program: the same numbers, verdicts, names and events, most
//! times of a fine grid computed by the program, or the reason by name why there is none.

use kin::extend::Route;
use kin::extend::RouteReason;
use kin::prelude::*;
use kin::solver::Stop;
use kin::{Engine, Error, SolverOptions};

/// How far q, q̇, q̈ and q⃛ may be apart, by 1 and the largest number of their kind in the motion:
/// the tolerances of the references (`tests/data/README.md`), to which either engine is held alone,
/// and for q⃛, of which there are none, as much more as one derivative more takes there.
const APART: [f64; 4] = [1e-12, 1e-11, 1e-9, 1e-7];

/// So many times more with a singular position on the way, as the references allow near one.
const NEAR_SINGULAR: f64 = 10.0;

/// Rounding of positions beside a singular one is divided by how far away that is, as a share of
/// the motion's time, for C_q is as small there; and of each order of rates it is divided once
/// more. Nearer than `NEAREST` single steps compute rates.
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
                is_same(plain, &program, options.stop)
            }
            (Err(plain), Err(program)) => ends_the_same(plain, &program),
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
                is_near(plain, &chosen, SolverOptions::default().stop)
            }
            (Err(plain), Err(chosen)) => ends_the_same(plain, &chosen),
            (plain, chosen) => panic!("{:?} {:?}", plain.as_ref().err(), chosen.err()),
        }
        plain
    }

    #[track_caller]
    fn run_by_all(&self, times: impl AsRef<[f64]>, rounding: f64) -> kin::Result<Motion> {
        let by =
            |engine| self.solver().options(SolverOptions::new().engine(engine)).run(times.as_ref());
        let plain = by(Engine::StepByStep);
        for engine in [Engine::Compiled, Engine::Auto] {
            match (&plain, by(engine)) {
                (_, Err(error)) if is_refusal(&error) => is_right(self, &error.to_string()),
                (Ok(plain), Ok(other)) => {
                    is_near_but_for(rounding, plain, &other, SolverOptions::default().stop)
                }
                // Far off rounding decides which equation is said to be missed most.
                (Err(plain), Err(other)) if rounding <= f64::EPSILON => {
                    ends_the_same(plain, &other)
                }
                (Err(plain), Err(other)) => ends_at_once(plain, &other),
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
fn is_same(plain: &Motion, program: &Motion, stop: Stop) {
    is_told(plain, program);
    is_near(plain, program, stop);
}

/// The same verdicts, and numbers within the tolerances.
#[track_caller]
fn is_near(plain: &Motion, program: &Motion, stop: Stop) {
    is_near_but_for(0.0, plain, program, stop);
}

/// The same where rounding of lengths is this share of them.
#[track_caller]
fn is_near_but_for(rounding: f64, plain: &Motion, program: &Motion, stop: Stop) {
    assert_eq!(plain.times(), program.times());
    meets_the_same(plain, program);
    // A looser stop rule leaves that much of each engine's positions undecided.
    let (Stop::Converged { tolerance } | Stop::ResidualOnly(tolerance)) = stop;
    let loose = (tolerance / 1e-13).max(1.0).max(10.0 * rounding / APART[0]);
    let off = apart(plain, program, loose);
    assert!(off.iter().all(|off| *off <= 1.0), "{}: {off:?} {:?}", plain.name(), program.engine());
}

/// The largest differences of q, q̇, q̈ and q⃛ as shares of what is allowed; infinite where one is
/// no number. Where a law breaks rates are those of one side, and rounding decides which: beside
/// breaks q alone counts.
fn apart(a: &Motion, b: &Motion, loose: f64) -> [f64; 4] {
    assert_eq!(a.has_jerk(), b.has_jerk());
    let breaks =
        a.breaks().iter().flat_map(|own| [own.between.0, own.between.1]).collect::<Vec<f64>>();
    let rows = [Motion::q, Motion::qd, Motion::qdd, Motion::qddd];
    std::array::from_fn(|order| {
        let mut off = 0.0_f64;
        let mut size = 1.0_f64;
        for k in (0..a.len()).filter(|k| order == 0 || !breaks.contains(&a.times()[*k])) {
            let allowed = allowed(a, k, order, loose);
            for (a, b) in rows[order](a, k).iter().zip(rows[order](b, k)) {
                let own = if (a - b).is_nan() { f64::INFINITY } else { (a - b).abs() };
                (off, size) = (off.max(own / allowed), size.max(1.0 + a.abs()));
            }
        }
        off / size
    })
}

/// How far rates of an order may be apart at a time.
fn allowed(motion: &Motion, k: usize, order: usize, loose: f64) -> f64 {
    let times = motion.times();
    let span = (times[times.len() - 1] - times[0]).abs();
    let ways = motion
        .singular_positions()
        .iter()
        .map(|found| ((times[k] - found.t).abs() / span).max(NEAREST));
    match ways.reduce(f64::min) {
        None => loose * APART[order],
        Some(way) => {
            loose * (NEAR_SINGULAR * APART[order]).max(ROUNDING / way.powi(order as i32 + 1))
        }
    }
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
fn meets_the_same(plain: &Motion, program: &Motion) {
    let one = plain.singular_positions();
    let other = program.singular_positions();
    assert_eq!(one.len(), other.len(), "{one:?} {other:?}");
    for (a, b) in one.iter().zip(other) {
        assert_eq!(
            (a.kind, &a.movable, &a.branches.len()),
            (b.kind, &b.movable, &b.branches.len())
        );
        assert!((a.t - b.t).abs() < 1e-9 * (1.0 + a.t.abs()), "{a:?} {b:?}");
    }
    let one = plain.events();
    let other = program.events();
    assert_eq!(one.len(), other.len(), "{one:?} {other:?}");
    for (a, b) in one.iter().zip(other) {
        assert_eq!((a.kind, &a.name, words(&a.text)), (b.kind, &b.name, words(&b.text)));
        assert!((a.t - b.t).abs() < 1e-9 * (1.0 + a.t.abs()), "{a:?} {b:?}");
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
fn ends_the_same(plain: &Error, program: &Error) {
    assert_eq!(words(&verdict(&plain.to_string())), words(&verdict(&program.to_string())));
    ends_at_once(plain, program);
}

/// The same kind of end after as many times.
#[track_caller]
fn ends_at_once(plain: &Error, program: &Error) {
    let ends = [plain, program].map(std::mem::discriminant);
    assert_eq!(ends[0], ends[1], "{plain} {program}");
    if let (Error::Toggle { t, .. }, Error::Toggle { t: other, .. }) = (plain, program) {
        assert!((t - other).abs() < 1e-9 * (1.0 + t.abs()), "{t} {other}");
    }
    let [one, other] = [plain, program].map(Error::motion);
    assert_eq!(one.map(Motion::len), other.map(Motion::len), "{plain}");
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
