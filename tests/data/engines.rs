//! The same run by plain steps and by a program: the same numbers, verdicts, names and events, most times
//! computed by the program, or a reason by name why there is none.

use kin::prelude::*;
use kin::{Engine, Error, Options};

/// How far q, q̇ and q̈ may be apart, by 1 and the largest number of their kind at that time.
const APART: [f64; 3] = [1e-10, 1e-8, 1e-6];

/// Runs by both engines. Each program of tests calls what it needs.
#[allow(dead_code)]
pub trait Engines {
    /// [`System::run`] by plain steps, after a run by a program has been compared with it.
    fn run_both(&self, times: impl AsRef<[f64]>) -> kin::Result<Motion>;

    /// [`System::run`] by a program, or by plain steps where there is a reason for that.
    fn run_compiled(&self, times: impl AsRef<[f64]>) -> kin::Result<Motion>;
}

fn by(engine: Engine) -> Options {
    Options { engine, ..Options::default() }
}

/// True of an error that names why there is no program.
fn is_refused(error: &Error) -> bool {
    let text = error.to_string();
    let named = text.contains('`') || text.contains("the mechanism cannot be compiled");
    text.contains("cannot be compiled: ") && named
}

impl Engines for System {
    fn run_both(&self, times: impl AsRef<[f64]>) -> kin::Result<Motion> {
        let times = times.as_ref();
        let plain = self.run_with(times, &by(Engine::Plain));
        match (&plain, self.run_with(times, &by(Engine::Compiled))) {
            (_, Err(error)) if is_refused(&error) => {}
            (Ok(plain), Ok(program)) => same(plain, &program),
            (Err(plain), Err(program)) => same_end(plain, &program),
            (plain, program) => panic!("{:?} {:?}", plain.as_ref().err(), program.err()),
        }
        plain
    }

    fn run_compiled(&self, times: impl AsRef<[f64]>) -> kin::Result<Motion> {
        let run = self.run_with(&times, &by(Engine::Compiled));
        match run {
            Err(error) if is_refused(&error) => self.run_with(times, &by(Engine::Plain)),
            run => run,
        }
    }
}

fn same(plain: &Motion, program: &Motion) {
    assert_eq!((plain.times(), plain.engine().compiled), (program.times(), 0));
    let singular =
        |motion: &Motion| motion.singular_positions().iter().map(|found| found.t).collect::<Vec<f64>>();
    let (one, other) = (singular(plain), singular(program));
    let near = one.iter().zip(&other).all(|(a, b)| (a - b).abs() < 1e-9 * (1.0 + a.abs()));
    assert!(one.len() == other.len() && near, "{one:?} {other:?}");
    let happened = |motion: &Motion| {
        motion.events().iter().map(|event| (event.kind, words(&event.text))).collect::<Vec<_>>()
    };
    assert_eq!(happened(plain), happened(program));
    let breaks = |motion: &Motion| {
        motion
            .breaks()
            .iter()
            .map(|known| (known.constraint.clone(), known.law.clone(), known.found.order))
            .collect::<Vec<_>>()
    };
    assert_eq!(breaks(plain), breaks(program));
    let counts = program.engine();
    if one.is_empty() {
        differ_by_little(plain, program);
        // On a coarse grid steps are too long for either engine.
        assert!(plain.len() < 200 || 20 * counts.handed_back <= plain.len(), "{}: {counts:?}", plain.name());
    }
}

fn differ_by_little(plain: &Motion, program: &Motion) {
    for k in 0..plain.len() {
        let orders =
            [(plain.q(k), program.q(k)), (plain.qd(k), program.qd(k)), (plain.qdd(k), program.qdd(k))];
        for ((a, b), allowed) in orders.into_iter().zip(APART) {
            let size = a.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
            let near = a.iter().zip(b).all(|(a, b)| (a - b).abs() <= allowed * size);
            assert!(near, "{} at {}: {a:?} {b:?}", plain.name(), plain.times()[k]);
        }
    }
}

fn same_end(plain: &Error, program: &Error) {
    assert_eq!(words(&verdict(&plain.to_string())), words(&verdict(&program.to_string())));
    if let (Error::Toggle { t, .. }, Error::Toggle { t: other, .. }) = (plain, program) {
        assert!((t - other).abs() < 1e-9 * (1.0 + t.abs()), "{t} {other}");
    }
    let lengths = [plain, program].map(|error| error.motion().map(Motion::len));
    assert_eq!(lengths[0], lengths[1], "{plain}");
}

/// A text without the others beside the equation that cannot be met: which of them are named at a singular
/// position hangs on the last digits of the pose.
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
