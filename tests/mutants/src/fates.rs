//! The record of mutants from earlier runs, so that a run that was ended goes on where it stopped.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::Result;
use crate::source::{Mutant, Source};
use crate::tests::Fate;

/// Killed mutants by their names. Mutants that live are judged again in each run: a test may have
/// come for them.
pub struct Fates {
    path: PathBuf,
    killed: BTreeMap<String, Killed>,
    /// A number for the text of each file, by its path.
    texts: BTreeMap<String, u64>,
}

struct Killed {
    test: String,
    /// The number of the file's text at that time.
    text: u64,
}

impl Fates {
    /// The record in the folder of a part; empty if there is none, or if it cannot be read.
    pub fn read(folder: &Path, sources: &[Source]) -> Fates {
        let path = folder.join("killed.json");
        let record = fs::read(&path)
            .ok()
            .and_then(|text| serde_json::from_slice::<BTreeMap<String, (String, u64)>>(&text).ok());
        let killed = record
            .unwrap_or_default()
            .into_iter()
            .map(|(key, (test, text))| (key, Killed { test, text }))
            .collect();
        let texts =
            sources.iter().map(|source| (source.path.clone(), number(&source.text))).collect();
        Fates { path, killed, texts }
    }

    /// The test that a mutant died of last time.
    pub fn killer(&self, mutant: &Mutant) -> Option<&str> {
        self.killed.get(&mutant.key()).map(|killed| killed.test.as_str())
    }

    /// True if a mutant was killed in the file as it is now.
    pub fn is_settled(&self, mutant: &Mutant) -> bool {
        self.killed
            .get(&mutant.key())
            .is_some_and(|killed| self.texts.get(&mutant.path) == Some(&killed.text))
    }

    /// Notes how a mutant ended.
    pub fn note(&mut self, mutant: &Mutant, fate: &Fate) {
        let Fate::Killed(test) = fate else {
            self.killed.remove(&mutant.key());
            return;
        };
        let text = self.texts.get(&mutant.path).copied().unwrap_or_default();
        self.killed.insert(mutant.key(), Killed { test: test.clone(), text });
    }

    /// Keeps the record. Errors: as of writing a file.
    pub fn write(&self) -> Result<()> {
        let record: BTreeMap<&String, (&String, u64)> =
            self.killed.iter().map(|(key, killed)| (key, (&killed.test, killed.text))).collect();
        Ok(fs::write(&self.path, serde_json::to_vec_pretty(&record)?)?)
    }
}

/// A number that another text hardly has (FNV-1a).
fn number(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(text: &str) -> Source {
        Source { path: "a.rs".to_string(), text: text.to_string(), sites: Vec::new() }
    }

    fn mutant() -> Mutant {
        let text = || "x".to_string();
        Mutant {
            number: 1,
            site: 1,
            path: "a.rs".to_string(),
            line: 1,
            function: text(),
            code: text(),
            label: text(),
        }
    }

    #[test]
    fn a_killed_mutant_is_settled_until_its_file_changes() {
        let folder = std::env::temp_dir().join(format!("mutants-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let mut fates = Fates::read(&folder, &[source("one")]);
        assert!(!fates.is_settled(&mutant()));
        fates.note(&mutant(), &Fate::Killed("a test".to_string()));
        fates.write().unwrap();
        let again = Fates::read(&folder, &[source("one")]);
        assert!(again.is_settled(&mutant()) && again.killer(&mutant()) == Some("a test"));
        let changed = Fates::read(&folder, &[source("two")]);
        assert!(!changed.is_settled(&mutant()) && changed.killer(&mutant()) == Some("a test"));
        fates.note(&mutant(), &Fate::Alive);
        assert!(fates.killer(&mutant()).is_none());
        fs::remove_dir_all(folder).unwrap();
    }
}
