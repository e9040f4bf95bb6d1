//! The copy of the workspace that has all mutants in it, and what the compiler says of it.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::Result;
use crate::source::Source;

/// The copy, and what is built from it.
pub struct Tree {
    root: PathBuf,
    built: PathBuf,
}

/// A program of tests.
pub struct Program {
    pub name: String,
    pub path: PathBuf,
    /// The folder of its package, in which it runs.
    pub folder: PathBuf,
}

impl Tree {
    /// A copy of the repository at `from` in the folder `to`, but for the files that are changed.
    pub fn new(from: &Path, to: &Path, sources: &[Source]) -> Result<Tree> {
        let tree = Tree { root: to.join("tree"), built: to.join("build") };
        let library = from.join("kin-core/src/lib.rs");
        let own: Vec<PathBuf> =
            sources.iter().map(|source| from.join(&source.path)).chain([library.clone()]).collect();
        copy(from, &tree.root, &own)?;
        write(&tree.root.join("kin-core/src/mutants.rs"), include_str!("switch.rs"))?;
        write(
            &tree.root.join("kin-core/src/lib.rs"),
            &(fs::read_to_string(library)? + "\nmod mutants;\n"),
        )?;
        Ok(tree)
    }

    pub fn write(&self, sources: &[Source]) -> Result<()> {
        sources
            .iter()
            .try_for_each(|source| write(&self.root.join(&source.path), &source.instrumented()))
    }

    fn cargo(&self, arguments: &[&str]) -> Result<(bool, Vec<Value>)> {
        let output = Command::new("cargo")
            .args(arguments)
            .arg("--message-format=json")
            .current_dir(&self.root)
            .env("CARGO_TARGET_DIR", &self.built)
            .env("CARGO_PROFILE_DEV_OPT_LEVEL", "1")
            .env("CARGO_PROFILE_DEV_DEBUG", "0")
            .env("CARGO_INCREMENTAL", "0")
            .env("RUSTFLAGS", "--cap-lints=warn")
            .stderr(Stdio::inherit())
            .output()?;
        let lines = String::from_utf8(output.stdout)?;
        let messages = lines.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
        Ok((output.status.success(), messages))
    }

    /// Leaves out what does not compile, until the rest does.
    pub fn settle(&self, sources: &mut [Source]) -> Result<()> {
        for _ in 0..20 {
            self.write(sources)?;
            let (done, messages) = self.cargo(&["check", "--quiet", "-p", "kin-core", "--lib"])?;
            if done {
                return Ok(());
            }
            let errors: Vec<&Value> =
                messages.iter().map(|m| &m["message"]).filter(|m| m["level"] == "error").collect();
            println!("{} errors; what they stand in is left out", errors.len());
            let texts: Vec<String> = sources.iter().map(Source::instrumented).collect();
            let mut refused = 0;
            for error in &errors {
                let found = blame(error, sources, &texts);
                if found == 0 && error["spans"].as_array().is_some_and(|spans| !spans.is_empty()) {
                    println!(
                        "not blamed on any mutant: {}",
                        error["rendered"].as_str().unwrap_or_default()
                    );
                }
                refused += found;
            }
            if refused == 0 {
                return Err("the copy does not compile, and no mutant is to blame".into());
            }
        }
        Err("the copy does not compile after 20 rounds".into())
    }

    /// Compiles the tests.
    pub fn programs(&self, arguments: &[&str]) -> Result<Vec<Program>> {
        let (done, messages) =
            self.cargo(&[&["test", "--quiet", "--no-run"], arguments].concat())?;
        if !done {
            return Err("the tests do not compile".into());
        }
        let program = |message: &Value| {
            let manifest = Path::new(message["manifest_path"].as_str()?);
            let name = message["target"]["name"].as_str()?.to_string();
            Some(Program {
                name,
                path: message["executable"].as_str()?.into(),
                folder: manifest.parent()?.to_path_buf(),
            })
        };
        Ok(messages.iter().filter_map(program).collect())
    }
}

/// Leaves out the mutants in which an error stands, or those around it, or those between the places
/// that it names; gives how many.
fn blame(error: &Value, sources: &mut [Source], texts: &[String]) -> usize {
    let none = Vec::new();
    let spans = error["spans"].as_array().unwrap_or(&none);
    let (first, others): (Vec<&Value>, Vec<&Value>) =
        spans.iter().partition(|span| span["is_primary"] == true);
    let mut between: Option<(usize, Range<usize>)> = None;
    for span in first.into_iter().chain(others) {
        let number = |key: &str| span[key].as_u64().unwrap_or_default() as usize;
        let place = number("byte_start")..number("byte_end");
        let Some(file) =
            sources.iter().position(|source| span["file_name"] == source.path.as_str())
        else {
            continue;
        };
        let (mutants, sites) = marks(&texts[file]);
        let around = |(_, range): &&(usize, Range<usize>)| {
            range.start <= place.start && place.end <= range.end
        };
        if let Some((number, _)) = mutants.iter().find(around) {
            return refuse(&mut sources[file], |mutant, _| mutant == *number);
        }
        if let Some((site, _)) = sites.iter().filter(around).min_by_key(|(_, range)| range.len()) {
            return refuse(&mut sources[file], |_, first| first == *site);
        }
        between = match between {
            Some((known, range)) if known == file => {
                Some((file, range.start.min(place.start)..range.end.max(place.end)))
            }
            other => other.or(Some((file, place))),
        };
    }
    let Some((file, range)) = between else { return 0 };
    let (_, sites) = marks(&texts[file]);
    let inside: Vec<usize> = sites
        .iter()
        .filter(|(_, site)| range.start <= site.start && site.end <= range.end)
        .map(|(site, _)| *site)
        .collect();
    refuse(&mut sources[file], |_, first| inside.contains(&first))
}

fn refuse(source: &mut Source, is_meant: impl Fn(usize, usize) -> bool) -> usize {
    let mut count = 0;
    for site in &mut source.sites {
        let first = site.first;
        for (_, alternative) in
            site.alternatives.iter_mut().enumerate().filter(|(k, _)| is_meant(first + k, first))
        {
            alternative.compiles = false;
            count += 1;
        }
    }
    count
}

type Marks = Vec<(usize, Range<usize>)>;

/// Where mutants and places stand in an instrumented file.
fn marks(text: &str) -> (Marks, Marks) {
    let mut mutants = Vec::new();
    let mut sites = Vec::new();
    let mut open = Vec::new();
    for (at, _) in text.match_indices("/*") {
        let Some(kind) = text[at + 2..].chars().next() else { continue };
        match kind {
            '<' | '[' => {
                let digits: String =
                    text[at + 3..].chars().take_while(char::is_ascii_digit).collect();
                digits.parse::<usize>().into_iter().for_each(|number| open.push((number, at)));
            }
            '>' => mutants.extend(open.pop().map(|(number, from)| (number, from..at))),
            ']' => sites.extend(open.pop().map(|(number, from)| (number, from..at))),
            _ => {}
        }
    }
    (mutants, sites)
}

/// Writes a file unless it is as it should be: what has not changed is not compiled again.
fn write(path: &Path, text: &str) -> Result<()> {
    if fs::read(path).is_ok_and(|old| old == text.as_bytes()) {
        return Ok(());
    }
    fs::create_dir_all(path.parent().ok_or("a file without a folder")?)?;
    Ok(fs::write(path, text)?)
}

/// Copies a folder but for some files, for what is built and for what is hidden; takes away files
/// that are no longer there.
fn copy(from: &Path, to: &Path, except: &[PathBuf]) -> Result<()> {
    fs::create_dir_all(to)?;
    let mut kept = vec!["mutants.rs".into()];
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let name = entry.file_name();
        let path = entry.path();
        let there = to.join(entry.file_name());
        kept.push(name.clone());
        if name.to_string_lossy().starts_with('.')
            || name == "target"
            || name == "out"
            || except.contains(&path)
        {
            continue;
        }
        if entry.file_type()?.is_dir() {
            copy(&path, &there, except)?;
        } else if path.is_dir() {
            // a link, which leads to the same place in the copy
            if !there.exists() {
                std::os::unix::fs::symlink(fs::read_link(&path)?, &there)?;
            }
        } else {
            let bytes = fs::read(&path)?;
            if fs::read(&there).map_or(true, |old| old != bytes) {
                fs::write(&there, bytes)?;
            }
        }
    }
    for entry in fs::read_dir(to)? {
        let entry = entry?;
        if !kept.contains(&entry.file_name()) && entry.file_type()?.is_file() {
            fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}
