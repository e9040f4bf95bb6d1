//! Tests: which places each of them reaches, and which mutants die of it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use crate::source::Mutant;
use crate::tree::Program;
use crate::{Result, side_by_side};

/// A test, how long it takes, and the places that it reaches.
pub struct Test {
    program: usize,
    pub name: String,
    seconds: f64,
    reached: BTreeSet<usize>,
}

pub struct Tests {
    programs: Vec<Program>,
    tests: Vec<Test>,
    /// How long the tests of one mutant may take together.   \[s\]
    longest: f64,
    /// The tests that mutants of a function died of, the last one first.
    killers: Mutex<BTreeMap<String, Vec<usize>>>,
}

/// How a mutant ended.
#[derive(Clone, PartialEq)]
pub enum Fate {
    /// Of a test.
    Killed(String),
    /// Nothing failed.
    Alive,
    /// Nothing comes to it.
    NotReached,
}

/// Tests that take less are run in one process.   \[s\]
const QUICK: f64 = 0.1;

/// How many cases tests with random ones take: a mutant that only the two hundredth finds is not
/// told from one that lives by what it costs.
const CASES: &str = "80";

impl Tests {
    /// Runs every test once, and sees where it comes. Tests that fail without a mutant, or take too
    /// long, are left out, and named.
    pub fn new(programs: Vec<Program>, folder: &Path, longest: f64, jobs: usize) -> Result<Tests> {
        let mut names = Vec::new();
        for (k, program) in programs.iter().enumerate() {
            let listed = command(program, 600.0).args(["--list", "--format", "terse"]).output()?;
            let listed = String::from_utf8(listed.stdout)?;
            names.extend(
                listed
                    .lines()
                    .filter_map(|line| line.strip_suffix(": test"))
                    .map(|name| (k, name.to_string())),
            );
        }
        let logs = folder.join("reached");
        std::fs::create_dir_all(&logs)?;
        let tests = side_by_side(jobs, &names, |k, (program, name)| {
            let log = logs.join(k.to_string());
            let _ = std::fs::remove_file(&log);
            let begin = Instant::now();
            let mut child = only(&programs[*program], &[name], longest.min(600.0))
                .env("KIN_MUTANTS_REACHED", &log)
                .spawn()?;
            // One that takes longer than all may together would not be run anyway.
            if !ends_well(&mut child, longest.min(600.0))? {
                println!(
                    "left out, for it fails without a mutant, or takes too long: {} {name}",
                    programs[*program].name
                );
                return Ok(None);
            }
            let seconds = begin.elapsed().as_secs_f64();
            let reached = std::fs::read_to_string(&log)
                .unwrap_or_default()
                .lines()
                .filter_map(|line| line.parse().ok())
                .collect();
            Ok(Some(Test { program: *program, name: name.clone(), seconds, reached }))
        });
        let tests = tests.into_iter().collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
        Ok(Tests { programs, tests, longest, killers: Mutex::default() })
    }

    /// How many tests come to any place, and how long they take together.   \[-, s\]
    pub fn size(&self) -> (usize, f64) {
        let come = self.tests.iter().filter(|test| !test.reached.is_empty());
        come.fold((0, 0.0), |(count, seconds), test| (count + 1, seconds + test.seconds))
    }

    /// The tests by the time that they take.
    pub fn slowest(&self, count: usize) -> Vec<String> {
        let mut all: Vec<&Test> =
            self.tests.iter().filter(|test| !test.reached.is_empty()).collect();
        all.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
        all.iter()
            .take(count)
            .map(|test| format!("{:7.2} s  {}", test.seconds, self.name(test)))
            .collect()
    }

    fn name(&self, test: &Test) -> String {
        format!("{} {}", self.programs[test.program].name, test.name)
    }

    /// Runs a mutant against the tests that reach it: first those that its neighbours died of, or
    /// itself another time, then the fastest.
    pub fn judge(&self, mutant: &Mutant, before: Option<&str>) -> Result<Fate> {
        let mut tests: Vec<usize> = (0..self.tests.len())
            .filter(|k| self.tests[*k].reached.contains(&mutant.site))
            .collect();
        if tests.is_empty() {
            return Ok(Fate::NotReached);
        }
        tests.sort_by(|a, b| self.tests[*a].seconds.total_cmp(&self.tests[*b].seconds));
        let mut together = 0.0;
        let affordable = tests.iter().take_while(|k| {
            together += self.tests[**k].seconds;
            together <= self.longest
        });
        tests = affordable.copied().collect();
        let killers = self
            .killers
            .lock()
            .map_err(|_| "a thread failed")?
            .get(&mutant.function)
            .cloned()
            .unwrap_or_default();
        let known = tests
            .iter()
            .copied()
            .filter(|k| before.is_some_and(|before| before == self.name(&self.tests[*k])));
        let near = killers
            .into_iter()
            .filter(|k| tests.contains(k) && self.tests[*k].seconds < 2.0)
            .take(4);
        let mut groups: Vec<Vec<usize>> = known.chain(near).map(|k| vec![k]).collect();
        for program in 0..self.programs.len() {
            let quick = tests
                .iter()
                .copied()
                .filter(|k| self.tests[*k].program == program && self.tests[*k].seconds < QUICK);
            groups.push(quick.collect());
        }
        groups.extend(tests.iter().filter(|k| self.tests[**k].seconds >= QUICK).map(|k| vec![*k]));
        for group in groups.iter().filter(|group| !group.is_empty()) {
            if !self.passes(group, mutant.number)? {
                return Ok(Fate::Killed(self.remember(group, mutant)?));
            }
        }
        Ok(Fate::Alive)
    }

    fn remember(&self, group: &[usize], mutant: &Mutant) -> Result<String> {
        let mut killer = group[0];
        for k in group.iter().filter(|_| group.len() > 1) {
            if !self.passes(&[*k], mutant.number)? {
                killer = *k;
                break;
            }
        }
        let mut killers = self.killers.lock().map_err(|_| "a thread failed")?;
        let near = killers.entry(mutant.function.clone()).or_default();
        near.retain(|k| *k != killer);
        near.insert(0, killer);
        Ok(self.name(&self.tests[killer]))
    }

    /// True if tests of one program pass with a mutant, in a time that is not far from what they
    /// take without it.
    fn passes(&self, group: &[usize], mutant: usize) -> Result<bool> {
        let names: Vec<&String> = group.iter().map(|k| &self.tests[*k].name).collect();
        let seconds: f64 = group.iter().map(|k| self.tests[*k].seconds).sum();
        let program = &self.programs[self.tests[group[0]].program];
        let limit = 2.0 + 3.0 * seconds;
        let mut child =
            only(program, &names, limit).env("KIN_MUTANT", mutant.to_string()).spawn()?;
        ends_well(&mut child, limit)
    }
}

/// A program of tests that may take so many seconds of a processor, and not all memory: some
/// mutants do not end. Seconds by the clock would kill mutants of what else the machine is doing.
fn command(program: &Program, seconds: f64) -> Command {
    let mut command = Command::new("sh");
    command
        .args(["-c", "ulimit -v 8000000; ulimit -t \"$0\"; exec \"$@\""])
        .arg(seconds.ceil().to_string())
        .arg(&program.path)
        .current_dir(&program.folder);
    // one process takes one core, and its random numbers are the same each time
    command
        .env("RAYON_NUM_THREADS", "1")
        .env("PROPTEST_DISABLE_FAILURE_PERSISTENCE", "true")
        .env("PROPTEST_RNG_SEED", "1");
    command.env("KIN_CAMPAIGN", CASES).env("PROPTEST_MAX_SHRINK_ITERS", "0").stderr(Stdio::null());
    command
}

fn only(program: &Program, names: &[impl AsRef<str>], seconds: f64) -> Command {
    let mut command = command(program, seconds);
    command
        .args(["--exact", "--test-threads=1"])
        .args(names.iter().map(AsRef::as_ref))
        .stdout(Stdio::null());
    command
}

/// True if a process ends well. One that waits takes no seconds of a processor, and is ended by the
/// clock.
fn ends_well(child: &mut Child, seconds: f64) -> Result<bool> {
    const CLOCK: f64 = 20.0;
    let begin = Instant::now();
    let mut pause = 1;
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(status.success());
        }
        if begin.elapsed().as_secs_f64() > CLOCK * seconds {
            child.kill()?;
            child.wait()?;
            return Ok(false);
        }
        std::thread::sleep(Duration::from_millis(pause));
        pause = (2 * pause).min(20);
    }
}
