//! Mutants of Kin's proofs, of following and of laws: changes of their code that a test should notice.
//! `.ci/mutants` runs this.
//!
//! All mutants are compiled at once into a copy of the workspace, as alternatives that an environment
//! variable chooses from (mutant schemata: Untch, Offutt, Harrold 1993). Each test is run once to see which
//! places it comes to; then every mutant is run against the tests that come to it, until one fails. Those
//! that live have to be in `listed.txt`, with a reason.

mod finder;
mod listed;
mod operators;
mod results;
mod source;
mod tests;
mod tree;

use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use source::{Mutant, Source};
use tests::{Fate, Tests};
use tree::Tree;

type Result<T> = std::result::Result<T, Box<dyn Error + Send + Sync>>;

/// The code that is changed: folders and files of `kin-core/src`.
const CODE: [&str; 11] = [
    "ask/proof.rs",
    "ask/proof",
    "numbers/enclosure",
    "model/formula/bounds.rs",
    "model/formula/time.rs",
    "solve/follow",
    "model/law",
    "model/law/spline",
    "ask/measure/roots.rs",
    "ask/measure/extremes.rs",
    "linear/condition.rs",
];

/// The tests that are run against it.
const TESTS: [&str; 15] = [
    "-p",
    "kin-core",
    "-p",
    "kin",
    "--lib",
    "--test",
    "proof",
    "--test",
    "following",
    "--test",
    "library",
    "--test",
    "measures",
    "--test",
    "jerk",
];

const UNIT_TESTS: [&str; 3] = ["-p", "kin-core", "--lib"];

struct Options {
    /// Only mutants whose line of the list has one of these in it.
    only: Vec<String>,
    jobs: usize,
    /// How long the tests of one mutant may take together, the fastest first.   \[s\]
    longest: f64,
    /// Only those that no run before this one has killed.
    again: bool,
    /// Only the unit tests of kin-core are run, which are compiled soonest.
    unit: bool,
    list: bool,
}

fn main() -> Result<()> {
    let options = options()?;
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).ok_or("no repository around this")?;
    let folder = root.join("target/mutants");
    let mut sources = sources(root)?;
    if options.list {
        source::mutants(&sources).iter().for_each(|mutant| println!("{}", mutant.key()));
        return Ok(());
    }
    // two at a time would write to one copy
    fs::create_dir_all(&folder)?;
    let lock = fs::File::create(folder.join("lock"))?;
    lock.try_lock()?;
    let tree = Tree::new(root, &folder, &sources)?;
    let known = folder.join("refused.json");
    source::refuse(
        &mut sources,
        &fs::read(&known).ok().and_then(|text| serde_json::from_slice::<Vec<String>>(&text).ok()).unwrap_or_default(),
    );
    tree.settle(&mut sources)?;
    fs::write(known, serde_json::to_vec_pretty(&source::refused(&sources))?)?;
    let all: Vec<Mutant> = source::mutants(&sources);
    let mut chosen: Vec<Mutant> = all
        .iter()
        .filter(|mutant| options.only.is_empty() || options.only.iter().any(|only| mutant.key().contains(only)))
        .cloned()
        .collect();
    let before = killers(&folder);
    if options.again {
        chosen.retain(|mutant| !before.contains_key(&mutant.key()));
    }
    // in the order in which they were asked for
    chosen.sort_by_key(|mutant| options.only.iter().position(|only| mutant.key().contains(only)));
    println!("{} mutants compile, {} are run", all.len(), chosen.len());
    let tests = Tests::new(tree.programs(if options.unit { &UNIT_TESTS } else { &TESTS })?, &folder, options.longest, options.jobs)?;
    let (count, seconds) = tests.size();
    println!("{count} tests come to them, {seconds:.0} s together; the slowest:\n{}", tests.slowest(12).join("\n"));
    let fates = judged(&tests, &chosen, before, &folder, options.jobs)?;
    verdict(&all, &chosen, &fates, root)
}

fn options() -> Result<Options> {
    let jobs = std::thread::available_parallelism().map_or(1, usize::from);
    let mut options = Options { only: Vec::new(), jobs, longest: f64::INFINITY, again: false, unit: false, list: false };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} wants a value"));
        match argument.as_str() {
            "--only" => options.only.push(value()?),
            "--jobs" => options.jobs = value()?.parse()?,
            "--longest" => options.longest = value()?.parse()?,
            "--again" => options.again = true,
            "--unit" => options.unit = true,
            "--list" => options.list = true,
            _ => {
                return Err(format!(
                    "unknown: {argument}; there are --only <text>, --jobs <number>, --longest <seconds>, --again, --unit, --list"
                )
                .into());
            }
        }
    }
    Ok(options)
}

/// The files that are changed, with their places.
fn sources(root: &Path) -> Result<Vec<Source>> {
    let code = root.join("kin-core/src");
    let mut paths: Vec<PathBuf> = Vec::new();
    for path in CODE.map(|path| code.join(path)) {
        if path.is_dir() {
            fs::read_dir(&path)?.try_for_each(|entry| entry.map(|entry| paths.push(entry.path())))?;
        } else {
            paths.push(path);
        }
    }
    paths.sort();
    let (mut files, mut constants) = (Vec::new(), BTreeMap::new());
    for path in paths.iter().filter(|path| path.extension().is_some_and(|end| end == "rs")) {
        let name = path.strip_prefix(root)?.to_string_lossy().replace('\\', "/");
        let text = fs::read_to_string(path)?;
        let file = syn::parse_file(&text)?;
        finder::constants(&name, &file, &mut constants);
        files.push((name, text, file));
    }
    let tests: Vec<String> = files.iter().flat_map(|(_, _, file)| finder::test_modules(file)).map(|name| format!("/{name}.rs")).collect();
    files.retain(|(name, ..)| !tests.iter().any(|test| name.ends_with(test)));
    let mut sources: Vec<Source> = files.into_iter().map(|(name, text, file)| finder::source(&name, text, &file, &constants)).collect();
    source::number(&mut sources);
    Ok(sources)
}

/// The tests that mutants have died of in other runs.
fn killers(folder: &Path) -> BTreeMap<String, String> {
    fs::read(folder.join("killers.json")).ok().and_then(|text| serde_json::from_slice(&text).ok()).unwrap_or_default()
}

/// Runs mutants; those that live are told at once, and what is known is kept should this be ended early.
fn judged(tests: &Tests, mutants: &[Mutant], before: BTreeMap<String, String>, folder: &Path, jobs: usize) -> Result<Vec<Fate>> {
    const KEPT_EVERY: usize = 100;
    let killers = Mutex::new((0_usize, before.clone()));
    let keep = |killers: &BTreeMap<String, String>| -> Result<()> {
        Ok(fs::write(folder.join("killers.json"), serde_json::to_vec_pretty(killers)?)?)
    };
    let fates = side_by_side(jobs, mutants, |_, mutant| {
        let fate = tests.judge(mutant, before.get(&mutant.key()).map(String::as_str))?;
        let mut known = killers.lock().map_err(|_| "a thread failed")?;
        known.0 += 1;
        match &fate {
            Fate::Killed(test) => drop(known.1.insert(mutant.key(), test.clone())),
            Fate::Alive => println!("lives: {}:{} {}", mutant.path, mutant.line, mutant.key()),
            Fate::NotReached => println!("not reached: {}:{} {}", mutant.path, mutant.line, mutant.key()),
        }
        if known.0.is_multiple_of(KEPT_EVERY) {
            println!("{} of {}", known.0, mutants.len());
            keep(&known.1)?;
        }
        Ok(fate)
    });
    keep(&killers.lock().map_err(|_| "a thread failed")?.1)?;
    fates.into_iter().collect()
}

/// Compares with the list: an error if a mutant lives that is not in it.
fn verdict(all: &[Mutant], chosen: &[Mutant], fates: &[Fate], root: &Path) -> Result<()> {
    let listed = listed::read(&fs::read_to_string(root.join("tests/mutants/listed.txt"))?)?;
    let is_listed = |mutant: &Mutant| listed.contains_key(&mutant.key()) || listed.contains_key(&mutant.place());
    let lives: Vec<&Mutant> =
        chosen.iter().zip(fates).filter(|(_, fate)| !matches!(fate, Fate::Killed(_))).map(|(mutant, _)| mutant).collect();
    for line in listed.keys() {
        let is_meant = |mutant: &&Mutant| *line == mutant.key() || *line == mutant.place();
        if !all.iter().any(|mutant| is_meant(&mutant)) {
            println!("listed, but there is none such: {line}");
        } else if chosen.iter().any(|mutant| is_meant(&mutant)) && !lives.iter().any(|mutant| is_meant(mutant)) {
            println!("listed, but killed: {line}");
        }
    }
    let unlisted = lives.iter().filter(|mutant| !is_listed(mutant)).map(|mutant| format!("{}\n", mutant.key()));
    let unlisted: Vec<String> = unlisted.collect();
    println!("{} mutants run, {} live, {} of them listed", chosen.len(), lives.len(), lives.len() - unlisted.len());
    if unlisted.is_empty() {
        Ok(())
    } else {
        print!("{}", unlisted.concat());
        Err(format!("{} mutants live that are not listed", unlisted.len()).into())
    }
}

/// Does something with each item, on so many threads.
fn side_by_side<T: Sync, R: Send>(jobs: usize, items: &[T], f: impl Fn(usize, &T) -> R + Sync) -> Vec<R> {
    let (next, results) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..jobs.max(1) {
            scope.spawn(|| {
                while let Some((k, item)) = Some(next.fetch_add(1, Ordering::Relaxed)).and_then(|k| items.get(k).map(|item| (k, item))) {
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
