//! Signatures of joints, read from the library's own source.

use std::collections::BTreeMap;
use std::path::Path;

use crate::table::Joint;

/// The arguments of each constructor, such as `i: Planar, j: Planar, u_i: Vec2, u_j: Vec2`, by
/// whether it is spatial and its name.
pub fn all() -> BTreeMap<(bool, String), String> {
    let mut signatures = BTreeMap::new();
    let mut files = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("kin-core/src/joints")];
    while let Some(path) = files.pop() {
        if path.is_dir() {
            files.extend(
                std::fs::read_dir(path)
                    .expect("readable")
                    .map(|entry| entry.expect("an entry").path()),
            );
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("readable");
        let spatial = path.to_string_lossy().contains("spatial");
        for item in text.split("\npub fn ").skip(1) {
            let (head, rest) = item.split_once('(').expect("arguments");
            let arguments = rest.split_once(") ->").expect("a value").0;
            let (name, generic) =
                head.split_once('<').map_or((head, false), |(name, _)| (name, true));
            // Of a constructor that takes any number of coordinates the kernel behind it has the
            // same name.
            if generic || !signatures.contains_key(&(spatial, name.to_owned())) {
                signatures.insert((spatial, name.to_owned()), plain(arguments));
            }
        }
    }
    signatures
}

/// The arguments that a caller gives, in one line: without the time, which a constraint has by
/// itself.
fn plain(arguments: &str) -> String {
    let line = arguments
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
        .replace("impl Into<Coordinate>", "Coord");
    let given =
        line.trim_end_matches(',').split(", ").filter(|argument| !argument.ends_with(": Time"));
    given.collect::<Vec<_>>().join(", ")
}

/// The signature of one joint.
pub fn of(all: &BTreeMap<(bool, String), String>, joint: &Joint) -> String {
    let key = (joint.group.starts_with("spatial"), joint.name());
    all.get(&key).unwrap_or_else(|| panic!("no function {key:?} in the source")).clone()
}
