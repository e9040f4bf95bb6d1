//! Programs that cargo looks at in a scratch package over `kin`, and what it says of them.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// A package with a program, or a library, for each file.
pub struct Scratch {
    folder: PathBuf,
    /// Where it is built.
    target: PathBuf,
}

impl Scratch {
    /// A package whose programs are these files, by name.
    pub fn new(name: &str, programs: &BTreeMap<String, PathBuf>) -> Self {
        let bins = programs
            .iter()
            .map(|(name, path)| format!("[[bin]]\nname = {name:?}\npath = {path:?}\n"));
        Scratch::with_targets(name, &bins.collect::<String>())
    }

    /// A package with targets of one's own, as its manifest has them.
    pub fn with_targets(name: &str, targets: &str) -> Self {
        let root = env!("CARGO_MANIFEST_DIR");
        let tmp = Path::new(env!("CARGO_TARGET_TMPDIR"));
        let folder = tmp.join(name);
        fs::create_dir_all(&folder).expect("the scratch package can be made");
        let manifest = format!(
            "[package]\nname = \"{name}\"\nedition = \"2024\"\npublish = false\n[workspace]\n[profile.dev]\ndebug = false\n[dependencies]\nkin = {{ path = {root:?} }}\n{targets}"
        );
        fs::write(folder.join("Cargo.toml"), manifest).expect("the scratch package can be written");
        fs::copy(Path::new(root).join("Cargo.lock"), folder.join("Cargo.lock"))
            .expect("Cargo.lock can be copied");
        Scratch { folder, target: tmp.join("ui/target") }
    }

    /// The outcome of cargo with some arguments.
    pub fn cargo(&self, arguments: &[&str]) -> Output {
        let output = Command::new(env!("CARGO"))
            .args(arguments)
            .current_dir(&self.folder)
            .env("CARGO_TARGET_DIR", &self.target)
            .env_remove("RUSTFLAGS")
            .env_remove("KIN_WARN_DUAL")
            .output()
            .expect("cargo runs");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(
            output.status.code().is_some() && !said.contains("failed to parse manifest"),
            "{said}"
        );
        output
    }

    /// The messages of rustc with a place at a level, `error` or `warning`, by the name of the
    /// program.
    pub fn check(&self, level: &str) -> BTreeMap<String, Vec<Value>> {
        let output =
            self.cargo(&["check", "--offline", "--bins", "--keep-going", "--message-format=json"]);
        let mut said: BTreeMap<String, Vec<Value>> = BTreeMap::new();
        for line in String::from_utf8_lossy(&output.stdout).lines() {
            let Ok(mut report) = serde_json::from_str::<Value>(line) else { continue };
            let name = report["target"]["name"].as_str().unwrap_or_default().to_owned();
            let message = report["message"].take();
            if message["level"] == level
                && message["spans"].as_array().is_some_and(|spans| !spans.is_empty())
            {
                said.entry(name).or_default().push(message);
            }
        }
        said
    }
}
