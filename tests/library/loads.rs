//! The lists of loads on the page, read from the library's own source.

use std::fmt::Write;
use std::path::Path;

use crate::page::paragraphs;

const HEAD: &str =
    "The kinds of loads are:

* A *length* is a length or an angle that a load can act along. Any constraint of one row is a length.
* A *force* acts along its argument `x`: a length, or a measure of a joint by its name.
* An *energy* V acts with the forces −V_q.
* A *load* combines forces and energies.\n\n";

/// A function of the library of loads.
pub struct LoadFunction {
    /// Its kind: `length` of a constraint to act along, `energy`, `force`, or `load` of others.
    pub kind: &'static str,
    pub name: String,
    /// Its arguments as a caller gives them; of a force without the rate and the time.
    pub arguments: String,
    pub documentation: String,
}

/// The loads of a file of kin-core/src/forces.
pub fn of_file(file: &str) -> Vec<LoadFunction> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("kin-core/src/forces").join(file);
    let text = std::fs::read_to_string(path).expect("readable");
    let mut before = String::new();
    let mut at = 0;
    let mut all = Vec::new();
    for line in text.split_inclusive('\n') {
        if line.starts_with("pub fn ") {
            all.push(function(&before, &text[at..]));
        }
        match line.starts_with("///") || line.starts_with("#[") {
            true => before += line,
            false => before.clear(),
        }
        at += line.len();
    }
    all
}

fn function(before: &str, text: &str) -> LoadFunction {
    let (name, rest) = text["pub fn ".len()..].split_once('(').expect("arguments");
    let arguments = rest.split_once(") ->").expect("a value").0;
    let is = |mark: &str| before.contains(&format!("#[{mark}"));
    let kind = match (is("constraint"), is("potential"), is("force")) {
        (true, ..) => "length",
        (_, true, _) => "energy",
        (.., true) => "force",
        _ => "load",
    };
    let documentation = before.lines().filter_map(|line| line.strip_prefix("///"));
    let documentation: Vec<&str> =
        documentation.map(str::trim).take_while(|line| !line.starts_with("```")).collect();
    let name = name.to_owned();
    let documentation = documentation.join("\n");
    LoadFunction { kind, name, arguments: given(arguments), documentation }
}

fn given(arguments: &str) -> String {
    let mut line = arguments.split_whitespace().collect::<Vec<_>>().join(" ");
    for (is, told) in [
        ("impl IntoPlanarBody", "Planar"),
        ("impl IntoSpatialBody", "Spatial"),
        ("impl IntoCoordinate", "Coord"),
        ("impl Into<Vec2>", "Vec2"),
        ("impl Into<Vec3>", "Vec3"),
    ] {
        line = line.replace(is, told);
    }
    let all = line.trim_end_matches(',').split(", ");
    let own = all.filter(|one| !one.ends_with(": Rate") && !one.ends_with(": Time"));
    own.map(|one| one.trim_start_matches('_')).collect::<Vec<_>>().join(", ")
}

/// The sections of the page.
pub fn sections() -> String {
    let mut text = String::new();
    for (file, title) in [
        ("library.rs", "Loads of planar bodies and coordinates (`loads::…`)"),
        ("library/spatial.rs", "Loads of spatial bodies (`loads::spatial::…`)"),
    ] {
        let _ = write!(text, "\n## {title}\n\n{HEAD}");
        for LoadFunction { kind, name, arguments, documentation } in of_file(file) {
            let (equation, more, signs) = paragraphs(&documentation);
            let more = if more.is_empty() { String::new() } else { format!(" {more}") };
            let signs = if signs.is_empty() { String::new() } else { format!(" *Signs:* {signs}") };
            let _ =
                writeln!(text, "* **`{name}`** `({arguments})`, {kind}: {equation}{more}{signs}");
        }
    }
    text
}
