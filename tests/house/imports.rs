//! Imports of `kin-core` go from the bottom up: each file of it is read, each `use` and each path
//! in it followed to the file where it leads.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use syn::visit::Visit;

use crate::reading::{File, Module, Reader, module};
use crate::{ROOT, rust_files, sources};

/// The rooms, each a folder that may import from those before it and from its own.
const ROOMS: [&str; 16] = [
    "numbers",
    "coordinates",
    "outcome",
    "dimensions",
    "law",
    "model",
    "emitted",
    "joints",
    "linear",
    "system",
    "program",
    "solve",
    "ask",
    "design",
    "forces",
    "data",
];

/// The rooms of `solve/`, folders and files, each of which may import from those before it and from
/// its own. `motion` derives results from a motion; the types of a motion are in an earlier room.
const ROOMS_OF_SOLVE: [&str; 16] = [
    "setters",
    "assembly",
    "options",
    "explain",
    "newton",
    "motion",
    "first_run",
    "follow",
    "step",
    "redundant",
    "run",
    "compiled",
    "whole_run",
    "sweep",
    "circuit",
    "free",
];

pub struct House {
    files: BTreeMap<Module, File>,
}

impl House {
    pub fn read(folder: &str) -> Self {
        let root = &Path::new(ROOT).join(folder);
        let mut files = BTreeMap::new();
        let mut tests = Vec::new();
        for path in rust_files(folder) {
            let text = std::fs::read_to_string(&path).expect("readable");
            let here = module(root, &path);
            let mut reader = Reader { here: &here, file: File::default(), tests: Vec::new() };
            reader.visit_file(
                &syn::parse_file(&text)
                    .unwrap_or_else(|error| panic!("{}: {error}", path.display())),
            );
            let file = reader.file;
            let own = reader.tests;
            tests.extend(own);
            files.insert(here, file);
        }
        files.retain(|module: &Module, _| !tests.iter().any(|test| module.starts_with(test)));
        House { files }
    }

    /// The file in which a path ends, after all that is given on.
    fn end(&self, path: &[String], depth: usize) -> Option<&Module> {
        let (module, file) =
            (0..=path.len()).rev().find_map(|k| self.files.get_key_value(&path[..k]))?;
        match path.get(module.len()).and_then(|name| file.gives_on.get(name)) {
            Some(further) if depth < 8 && further != path => self
                .end(&[&further[..], &path[module.len() + 1..]].concat(), depth + 1)
                .or(Some(module)),
            _ => Some(module),
        }
    }

    /// All pairs of a file and one that it imports from.
    pub fn edges(&self) -> BTreeSet<(&Module, &Module)> {
        let of = |(here, file)| file_edges(self, here, file);
        self.files.iter().flat_map(of).collect()
    }

    /// Sets of files each of which leads to all others of its set.
    fn cycles(&self) -> Vec<Vec<String>> {
        rings(&self.edges())
    }
}

/// Sets of files each of which leads to all others of its set by the pairs `edges`.
pub fn rings(edges: &BTreeSet<(&Module, &Module)>) -> Vec<Vec<String>> {
    let reached = |from: &Module| -> BTreeSet<Module> {
        let mut seen = BTreeSet::new();
        let mut open = vec![from];
        while let Some(here) = open.pop() {
            let next = edges.iter().filter(|(from, _)| *from == here).map(|(_, to)| *to);
            open.extend(next.filter(|to| seen.insert((*to).clone())));
        }
        seen
    };
    let files: BTreeSet<&Module> = edges.iter().map(|(from, _)| *from).collect();
    let leads: BTreeMap<&Module, BTreeSet<Module>> =
        files.into_iter().map(|file| (file, reached(file))).collect();
    let set = |file: &Module| -> Vec<String> {
        let leads_back = |other: &&Module| leads.get(*other).is_some_and(|all| all.contains(file));
        leads[file].iter().filter(leads_back).map(|module| module.join("/")).collect()
    };
    let all: BTreeSet<Vec<String>> =
        leads.keys().map(|file| set(file)).filter(|set| set.len() > 1).collect();
    all.into_iter().collect()
}

fn file_edges<'a>(
    house: &'a House,
    here: &'a Module,
    file: &'a File,
) -> impl Iterator<Item = (&'a Module, &'a Module)> {
    let ends = file.imports.iter().filter_map(|path| house.end(path, 0));
    ends.filter(move |there| *there != here).map(move |there| (here, there))
}

/// The number of a module's room; `None` of the crate's own root and of what is for all.
fn room(module: &Module) -> Option<usize> {
    let first = module.first()?;
    ROOMS.iter().position(|room| room == first)
}

fn house() -> House {
    House::read("kin-core/src")
}

/// Returns the imports from a room with a smaller number into one with a larger number.
fn upward(house: &House, room: impl Fn(&Module) -> Option<usize>) -> Vec<String> {
    let up = |(from, to): &(&Module, &Module)| {
        room(from).zip(room(to)).is_some_and(|(from, to)| from < to)
    };
    let found = house.edges().into_iter().filter(up);
    found.map(|(from, to)| format!("{} -> {}", from.join("/"), to.join("/"))).collect()
}

#[test]
fn imports_go_down() {
    let found = upward(&house(), room);
    assert!(found.is_empty(), "these import from a room above their own: {found:#?}");
}

/// The number of a module's room in `solve/`.
fn room_of_solve(module: &Module) -> Option<usize> {
    let [first, second, ..] = &module[..] else { return None };
    ROOMS_OF_SOLVE.iter().position(|room| first == "solve" && room == second)
}

#[test]
fn imports_of_the_solver_go_down() {
    let house = house();
    let found = upward(&house, room_of_solve);
    assert!(found.is_empty(), "these import from a room above their own: {found:#?}");
    let homeless: Vec<String> = house
        .files
        .keys()
        .filter(|module| module.len() > 1 && module[0] == "solve")
        .filter(|module| room_of_solve(module).is_none())
        .map(|module| module.join("/"))
        .collect();
    assert!(homeless.is_empty(), "in no room of solve: {homeless:?}");
}

/// The crates, each of which depends on those before it only.
const CRATES: [&str; 9] = [
    "kin-graph",
    "kin-language",
    "kin-macros",
    "kin-core",
    "kin-text",
    "kin-view",
    "kin",
    "kin-import",
    "kin-cli",
];

#[test]
fn crates_depend_on_those_before_them() {
    for (k, name) in CRATES.iter().enumerate() {
        let folder = if *name == "kin" { "." } else { name };
        let text = std::fs::read_to_string(Path::new(ROOT).join(folder).join("Cargo.toml"))
            .expect("readable");
        // The facade's own manifest holds the workspace's versions too.
        let own = text.split("\n[").filter(|part| part.starts_with("dependencies]"));
        let lines: Vec<&str> = own.flat_map(str::lines).collect();
        let needs = |other: &str| {
            let is_it = |line: &&str| {
                line.strip_prefix(other).is_some_and(|rest| rest.starts_with([' ', '.', '=']))
                    && !line.contains("package =")
            };
            lines.iter().any(is_it)
        };
        for later in &CRATES[k + 1..] {
            assert!(!needs(later), "{name} depends on {later}");
        }
        let foreign = match *name {
            "kin-graph" => &["syn", "quote", "nalgebra", "num-dual"][..],
            "kin-language" => &["nalgebra", "num-dual"],
            "kin-core" => &["syn", "quote", "kin-language"],
            _ => &[],
        };
        for other in foreign {
            assert!(!needs(other), "{name} depends on {other}");
        }
    }
}

/// No folder of a crate leads to another one that leads back; of the core the order of rooms says
/// more.
#[test]
fn folders_import_one_way() {
    for folder in sources() {
        let house = House::read(&folder);
        let mut leads: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        for (from, to) in house.edges() {
            // A file beside the folder of its name is the folder's own.
            if let (Some(from), Some(to)) = (from.first(), to.first())
                && from != to
            {
                leads.entry(from).or_default().insert(to);
            }
        }
        let is_folder = |name: &str| Path::new(ROOT).join(&folder).join(name).is_dir();
        leads.retain(|from, to| {
            to.retain(|to| is_folder(to));
            is_folder(from)
        });
        let round = rounds(&leads);
        assert!(round.is_empty(), "{folder}: these folders lead back to themselves: {round:?}");
    }
}

/// Those that lead back to themselves, by however many others.
fn rounds<'a>(leads: &BTreeMap<&'a str, BTreeSet<&'a str>>) -> Vec<&'a str> {
    let leads_back = |start: &&&str| {
        let mut seen = BTreeSet::new();
        let mut open = vec![**start];
        while let Some(here) = open.pop() {
            open.extend(leads.get(here).into_iter().flatten().filter(|to| seen.insert(**to)));
        }
        seen.contains(**start)
    };
    leads.keys().filter(leads_back).copied().collect()
}

#[test]
fn rounds_of_three_are_seen() {
    let leads = [("a", "b"), ("b", "c"), ("c", "a"), ("d", "a")];
    let leads = leads.into_iter().map(|(from, to)| (from, BTreeSet::from([to]))).collect();
    assert_eq!(rounds(&leads), ["a", "b", "c"]);
}

/// Files that import one another, straight or by others: the largest set of them in each crate.
#[test]
fn few_files_import_one_another() {
    const MOST: usize = 6;
    for folder in sources() {
        let house = House::read(&folder);
        for cycle in house.cycles() {
            assert!(
                cycle.len() <= MOST,
                "{folder}: these {} files import one another: {cycle:#?}",
                cycle.len()
            );
        }
    }
}

#[test]
fn every_module_has_a_room() {
    let known = ["extend", "testing", "lib"];
    let homeless: BTreeSet<String> = house()
        .files
        .keys()
        .filter(|module| !module.is_empty() && room(module).is_none())
        .map(|module| module[0].clone())
        .collect();
    let homeless: Vec<&String> =
        homeless.iter().filter(|name| !known.contains(&name.as_str())).collect();
    assert!(homeless.is_empty(), "in no room: {homeless:?}");
}

/// Paths that are given on lead to where things are, and tests do not count.
#[test]
fn paths_are_followed_to_their_files() {
    let house = house();
    let end = |path: &str| {
        house
            .end(&path.split("::").map(str::to_string).collect::<Vec<_>>(), 0)
            .map(|module| module.join("/"))
    };
    assert_eq!(end("linear::Echelon").as_deref(), Some("linear/echelon"));
    assert_eq!(end("Mechanism").as_deref(), Some("model/mechanism"));
    assert_eq!(end("solve::motion::Series").as_deref(), Some("outcome/motion/series"));
    assert!(house.files.keys().all(|module| module.first().is_none_or(|first| first != "testing")));
}

/// Imports are seen as all names of a module, within the call of a macro, and not in `$crate`.
#[test]
fn imports_of_every_kind_are_seen() {
    let text = "use crate::solve::*; fn f() { vec![crate::ask::g(super::h)]; }
        macro_rules! m { () => { $crate::data::k() }; } #[cfg(test)] mod tests { use crate::joints::*; }";
    let here = vec!["model".to_string(), "law".to_string()];
    let mut reader = Reader { here: &here, file: File::default(), tests: Vec::new() };
    reader.visit_file(&syn::parse_file(text).expect("Rust"));
    let found: Vec<String> = reader.file.imports.iter().map(|path| path.join("::")).collect();
    assert_eq!(found, ["ask::g", "model::h", "solve"]);
}
