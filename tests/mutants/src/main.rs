//! Mutants of Kin's rooms: changes of their code that a test should notice. `.ci/mutants` runs
//! this.
//!
//! All mutants of a part of the code are compiled at once into a copy of the workspace, as
//! alternatives that an environment variable chooses from (mutant schemata: Untch, Offutt, Harrold
//! 1993). Each test is run once to see which places it comes to; then every mutant is run against
//! the tests that come to it, until one fails. Those that live have to be in `listed.txt`, with a
//! reason.

mod fates;
mod finder;
mod listed;
mod operators;
mod parts;
mod results;
mod source;
mod tests;
mod tree;

use std::error::Error;
use std::fs;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use fates::Fates;
use parts::{PARTS, Part};
use source::{Mutant, Source};
use tests::{Fate, Tests};
use tree::Tree;

type Result<T> = std::result::Result<T, Box<dyn Error + Send + Sync>>;

const UNIT_TESTS: [&str; 3] = ["-p", "kin-core", "--lib"];

const USAGE: &str = "\
usage: bash .ci/mutants [PART …] [options]     parts: proofs, following, laws, programs, forces, design

Runs the mutants of the parts, all of them if none is named. A run that was ended goes on where it stopped:
mutants that were killed are run again only after their file has changed.

  --minutes M   stop after so long for each part, and say how many are left (60)
  --only TEXT   only mutants whose line in the list has this text in it; may be given several times
  --longest S   at most so many seconds of tests for each mutant, the fastest first
  --afresh      run the killed ones too
  --unit        run the unit tests of kin-core only, which compile soonest
  --jobs N      so many at a time (the number of cores)
  --list        print the mutants and stop";

struct Options {
    parts: Vec<&'static Part>,
    /// Only mutants whose line of the list has one of these in it.
    only: Vec<String>,
    jobs: usize,
    /// How long the tests of one mutant may take together, the fastest first.   \[s\]
    longest: f64,
    /// How long the mutants of one part may take.
    longest_part: Duration,
    /// Those that were killed before are run too.
    afresh: bool,
    /// Only the unit tests of kin-core are run, which are compiled soonest.
    unit: bool,
    list: bool,
}

fn main() -> Result<()> {
    let Some(options) = options()? else {
        println!("{USAGE}");
        return Ok(());
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .nth(2)
        .ok_or("no repository around this")?;
    let mut failed = Vec::new();
    for part in &options.parts {
        if let Err(error) = run(part, &options, root) {
            println!("{}: {error}", part.name);
            failed.push(part.name);
        }
    }
    if failed.is_empty() { Ok(()) } else { Err(format!("not done: {}", failed.join(", ")).into()) }
}

/// Runs the mutants of one part. Errors: mutants live that are not listed, or some are left when
/// time is up.
fn run(part: &Part, options: &Options, root: &Path) -> Result<()> {
    let begin = Instant::now();
    let mut sources = part.sources(root)?;
    if options.list {
        source::mutants(&sources).iter().for_each(|mutant| println!("{}", mutant.key()));
        return Ok(());
    }
    let folder = root.join("target/mutants").join(part.name);
    fs::create_dir_all(&folder)?;
    // two at a time would write to one copy
    let lock = fs::File::create(folder.join("lock"))?;
    lock.try_lock()?;
    let tree = Tree::new(root, &folder, &sources)?;
    settle(&tree, &mut sources, &folder)?;
    let mut fates = Fates::read(&folder, &sources);
    let all: Vec<Mutant> = source::mutants(&sources);
    let is_meant = |mutant: &Mutant| {
        options.only.is_empty() || options.only.iter().any(|only| mutant.key().contains(only))
    };
    let mut chosen: Vec<Mutant> = all.iter().filter(|mutant| is_meant(mutant)).cloned().collect();
    if !options.afresh {
        chosen.retain(|mutant| !fates.is_settled(mutant));
    }
    // in the order in which they were asked for
    chosen.sort_by_key(|mutant| options.only.iter().position(|only| mutant.key().contains(only)));
    println!("{}: {} mutants compile, {} are run", part.name, all.len(), chosen.len());
    let arguments = part.arguments();
    let programs = tree.programs(if options.unit { &UNIT_TESTS } else { &arguments })?;
    let tests = Tests::new(programs, &folder, options.longest, options.jobs)?;
    let (count, seconds) = tests.size();
    println!(
        "{count} tests come to them, {seconds:.0} s together; the slowest:\n{}",
        tests.slowest(12).join("\n")
    );
    let judged = judged(&tests, &chosen, &mut fates, begin + options.longest_part, options.jobs)?;
    verdict(&sources, &all, &judged, root)?;
    match chosen.len() - judged.len() {
        0 => Ok(()),
        left => Err(format!("time is up, {left} mutants are left: run it again to go on").into()),
    }
}

/// Leaves out the mutants that do not compile, those that are known first.
fn settle(tree: &Tree, sources: &mut [Source], folder: &Path) -> Result<()> {
    let known = folder.join("refused.json");
    let refused =
        fs::read(&known).ok().and_then(|text| serde_json::from_slice::<Vec<String>>(&text).ok());
    source::refuse(sources, &refused.unwrap_or_default());
    tree.settle(sources)?;
    Ok(fs::write(known, serde_json::to_vec_pretty(&source::refused(sources))?)?)
}

/// The options of the command line; none if help is wanted.
fn options() -> Result<Option<Options>> {
    let mut options = Options {
        parts: Vec::new(),
        only: Vec::new(),
        jobs: std::thread::available_parallelism().map_or(1, usize::from),
        longest: f64::INFINITY,
        longest_part: Duration::from_secs(3600),
        afresh: false,
        unit: false,
        list: false,
    };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} wants a value"));
        match argument.as_str() {
            "--only" => options.only.push(value()?),
            "--jobs" => options.jobs = value()?.parse()?,
            "--longest" => options.longest = value()?.parse()?,
            "--minutes" => {
                options.longest_part = Duration::try_from_secs_f64(60.0 * value()?.parse::<f64>()?)?
            }
            "--afresh" => options.afresh = true,
            "--unit" => options.unit = true,
            "--list" => options.list = true,
            "--help" | "-h" => return Ok(None),
            _ if argument.starts_with('-') => {
                return Err(format!("unknown: {argument}\n{USAGE}").into());
            }
            name => options.parts.push(Part::named(name)?),
        }
    }
    if options.parts.is_empty() {
        options.parts.extend(&PARTS);
    }
    Ok(Some(options))
}

/// A mutant, and how it ended.
type Judged<'a> = (&'a Mutant, Fate);

/// Runs mutants until that time; those that live are named at once, and the record is kept should
/// this be ended early.
fn judged<'a>(
    tests: &Tests,
    mutants: &'a [Mutant],
    fates: &mut Fates,
    until: Instant,
    jobs: usize,
) -> Result<Vec<Judged<'a>>> {
    const KEPT_EVERY: usize = 100;
    let known = Mutex::new((0_usize, fates));
    let judged = side_by_side(jobs, mutants, |_, mutant| {
        if Instant::now() > until {
            return Ok(None);
        }
        let before =
            known.lock().map_err(|_| "a thread failed")?.1.killer(mutant).map(str::to_string);
        let fate = tests.judge(mutant, before.as_deref())?;
        match &fate {
            Fate::Killed(_) => {}
            Fate::Alive => println!("lives: {}:{} {}", mutant.path, mutant.line, mutant.key()),
            Fate::NotReached => {
                println!("not reached: {}:{} {}", mutant.path, mutant.line, mutant.key())
            }
        }
        let mut known = known.lock().map_err(|_| "a thread failed")?;
        known.0 += 1;
        known.1.note(mutant, &fate);
        if known.0.is_multiple_of(KEPT_EVERY) {
            println!("{} of {}", known.0, mutants.len());
            known.1.write()?;
        }
        Ok(Some((mutant, fate)))
    });
    known.lock().map_err(|_| "a thread failed")?.1.write()?;
    Ok(judged.into_iter().collect::<Result<Vec<_>>>()?.into_iter().flatten().collect())
}

/// Compares with the list: an error if a mutant lives that is not in it.
fn verdict(sources: &[Source], all: &[Mutant], judged: &[Judged<'_>], root: &Path) -> Result<()> {
    let listed = listed::read(&fs::read_to_string(root.join("tests/mutants/listed.txt"))?)?;
    let is_listed = |mutant: &Mutant| {
        listed.contains_key(&mutant.key()) || listed.contains_key(&mutant.place())
    };
    let lives: Vec<&Mutant> = judged
        .iter()
        .filter(|(_, fate)| !matches!(fate, Fate::Killed(_)))
        .map(|(mutant, _)| *mutant)
        .collect();
    let is_here = |line: &&String| {
        sources.iter().any(|source| line.starts_with(&format!("{} |", source.path)))
    };
    for line in listed.keys().filter(is_here) {
        let is_meant = |mutant: &Mutant| *line == mutant.key() || *line == mutant.place();
        if !all.iter().any(is_meant) {
            println!("listed, but there is none such: {line}");
        } else if judged.iter().any(|(mutant, _)| is_meant(mutant))
            && !lives.iter().any(|mutant| is_meant(mutant))
        {
            println!("listed, but killed: {line}");
        }
    }
    let unlisted = lives
        .iter()
        .filter(|mutant| !is_listed(mutant))
        .map(|mutant| format!("{}\n", mutant.key()));
    let unlisted: Vec<String> = unlisted.collect();
    println!(
        "{} mutants run, {} live, {} of them listed",
        judged.len(),
        lives.len(),
        lives.len() - unlisted.len()
    );
    if unlisted.is_empty() {
        Ok(())
    } else {
        print!("{}", unlisted.concat());
        Err(format!("{} mutants live that are not listed", unlisted.len()).into())
    }
}

/// Does something with each item, on so many threads.
fn side_by_side<'a, T: Sync, R: Send>(
    jobs: usize,
    items: &'a [T],
    f: impl Fn(usize, &'a T) -> R + Sync,
) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let results = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..jobs.max(1) {
            scope.spawn(|| {
                while let Some((k, item)) = Some(next.fetch_add(1, Ordering::Relaxed))
                    .and_then(|k| items.get(k).map(|item| (k, item)))
                {
                    let result = f(k, item);
                    results.lock().expect("no thread has failed").push((k, result));
                }
            });
        }
    });
    let mut results = results.into_inner().expect("no thread has failed");
    results.sort_by_key(|(k, _)| *k);
    results.into_iter().map(|(_, result)| result).collect()
}
