//! The parts of the code that are changed, each with the tests that are run against it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::source::{self, Source};
use crate::{Result, finder};

/// Rooms of `kin-core/src` that are mutated together, in a copy of the workspace of their own.
pub struct Part {
    pub name: &'static str,
    /// Folders, with all that is in them, and files of `kin-core/src`.
    code: &'static [&'static str],
    /// Test programs of the package `kin`; the unit tests of kin-core are always run.
    tests: &'static [&'static str],
}

/// Every part; one compiles, and its tests run once, in a few minutes.
pub const PARTS: [Part; 6] = [
    Part {
        name: "proofs",
        code: &[
            "ask/proof.rs",
            "ask/proof",
            "numbers/enclosure",
            "model/formula/bounds.rs",
            "model/formula/time.rs",
        ],
        tests: &["proof", "library"],
    },
    Part {
        name: "following",
        code: &[
            "solve/follow",
            "ask/measure/roots.rs",
            "ask/measure/extremes.rs",
            "linear/condition.rs",
        ],
        tests: &["following", "measures", "proof", "jerk"],
    },
    Part { name: "laws", code: &["law"], tests: &["library", "measures", "jerk", "proof"] },
    Part {
        name: "programs",
        code: &["program", "solve/compiled"],
        tests: &["program", "sweeps", "jerk"],
    },
    Part { name: "forces", code: &["forces"], tests: &["forces"] },
    Part { name: "design", code: &["design"], tests: &["design", "dimensions"] },
];

impl Part {
    /// The part of that name. Errors: names the parts there are.
    pub fn named(name: &str) -> Result<&'static Part> {
        let names = || PARTS.iter().map(|part| part.name).collect::<Vec<_>>().join(", ");
        Ok(PARTS
            .iter()
            .find(|part| part.name == name)
            .ok_or_else(|| format!("no part `{name}`; there are {}", names()))?)
    }

    /// The arguments by which cargo builds and runs the tests of this part.
    pub fn arguments(&self) -> Vec<&'static str> {
        let programs = self.tests.iter().flat_map(|test| ["--test", test]);
        ["-p", "kin-core", "-p", "kin", "--lib"].into_iter().chain(programs).collect()
    }

    /// The files that are changed, with their places. Errors: a file that cannot be read or parsed.
    pub fn sources(&self, root: &Path) -> Result<Vec<Source>> {
        let code = root.join("kin-core/src");
        let mut paths: Vec<PathBuf> = Vec::new();
        self.code.iter().try_for_each(|path| collect(&code.join(path), &mut paths))?;
        paths.sort();
        let mut files = Vec::new();
        let mut constants = BTreeMap::new();
        let mut tests: Vec<PathBuf> = Vec::new();
        for path in paths.iter().filter(|path| path.extension().is_some_and(|end| end == "rs")) {
            let name = path.strip_prefix(root)?.to_string_lossy().replace('\\', "/");
            let text = fs::read_to_string(path)?;
            let file = syn::parse_file(&text)?;
            finder::constants(&name, &file, &mut constants);
            tests.extend(
                finder::test_modules(&file).iter().map(|module| children(path).join(module)),
            );
            files.push((path, name, text, file));
        }
        files.retain(|(path, ..)| {
            !tests.iter().any(|test| path.starts_with(test) || path.with_extension("") == *test)
        });
        let mut sources: Vec<Source> = files
            .into_iter()
            .map(|(_, name, text, file)| finder::source(&name, text, &file, &constants))
            .collect();
        source::number(&mut sources);
        Ok(sources)
    }
}

/// Adds a file, or all files below a folder.
fn collect(path: &Path, paths: &mut Vec<PathBuf>) -> Result<()> {
    if path.is_dir() {
        return fs::read_dir(path)?.try_for_each(|entry| collect(&entry?.path(), paths));
    }
    paths.push(path.to_path_buf());
    Ok(())
}

/// The folder in which the modules that a file declares are.
fn children(file: &Path) -> PathBuf {
    let is_own_folder = file.file_stem().is_some_and(|stem| stem == "mod" || stem == "lib");
    if is_own_folder {
        file.parent().unwrap_or(file).to_path_buf()
    } else {
        file.with_extension("")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_have_code_that_is_there_and_leave_tests_out() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap();
        for part in &PARTS {
            for path in part.code {
                assert!(root.join("kin-core/src").join(path).exists(), "{}: {path}", part.name);
            }
            for test in part.tests {
                let program = root.join("tests").join(test);
                assert!(
                    program.join("main.rs").exists() || program.with_extension("rs").exists(),
                    "{}: {test}",
                    part.name
                );
            }
            let sources = part.sources(root).unwrap();
            assert!(!source::mutants(&sources).is_empty(), "{}", part.name);
            assert!(sources.iter().all(|source| !source.path.contains("tests")), "{}", part.name);
        }
        assert!(Part::named("nothing").is_err());
    }
}
