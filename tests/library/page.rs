//! Writes `docs/library.md` and its pictures from the code, or compares them with the code.
//! `KIN_BLESS=1 cargo test --test library page` writes them.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use crate::sample::{Argument, Random, arguments};
use crate::table::Joint;
use crate::{laws, loads, signature, sketch, table};

const HEAD: &str = "\
# The library

`KIN_BLESS=1 cargo test --test library page` writes this page from the code. A test compares the page with the code, so both always agree.

Each joint is a function whose body is its equation. Kin derives all derivatives from the equation. The equations use these symbols:

* `i` and `j` are bodies; the ground is a body too.
* `u_i` and `u_j` are local positions, `h_i` and `h_j` local directions: their components are in the frame of the body.
* R and A are the position and the rotation matrix of a body. The global position of a point P is r_P = R + A ū.
* The pictures show body i in blue, body j in grey, and driven motions in orange.

If you know the global position of a point in the initial guess (the pose at declaration), `m.local` returns its local position in a body. `m.local_direction` does the same for a
direction:

```rust
let arm = m.planar(\"arm\", pose(0.2, 0.1, 0.3))?;
m.add(\"pin\", revolute(arm, m.ground(), m.local(arm, (0.5, 0.4))?, (0.5, 0.4)))?;      // the pin is at (0.5, 0.4) in the initial guess
```

The lists below show the arguments of each joint by these types:

* `Planar` and `Spatial` accept a body, a link or the ground.
* `Coord` accepts a coordinate: `crank.theta()`, `m.angle(…)?`.
* `Vec2` and `Vec3` accept a vector, a tuple or an array.
* `Axis` accepts a direction, or `Axis::new(h, f)`. f is the direction from which angles about h count, by the right-hand rule.
* `EulerParameters` accepts (e0, e1, e2, e3) with the scalar first.
* `Law` accepts a law.

Angles of planar bodies are counter-clockwise positive.

The tables have these columns. *Rows* is the number of freedoms that the joint removes. *Left* is the number of freedoms that remain between two bodies,
or for one body in the world. *Ex.* marks joints whose bodies you can exchange together with their parameters. *Measures* are names for
`System::measure`, such as `\"slot.slide\"`.
";

/// A paragraph of a doc comment as one line of a table.
fn tidy(text: &str) -> String {
    let text = text.replace("\\[", "[").replace("\\]", "]").replace('|', "\\|").replace('\n', " ");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The doc comment's first paragraph, its equation and unit; the rest; what it says of signs and
/// directions.
pub fn paragraphs(text: &str) -> (String, String, String) {
    let (first, rest) = text.split_once("\n\n").unwrap_or((text, ""));
    let (rest, signs) = match rest.strip_prefix("Signs: ") {
        Some(signs) => ("", signs),
        None => rest.split_once("\n\nSigns: ").unwrap_or((rest, "")),
    };
    (links(&tidy(first)), links(&tidy(rest)), links(&tidy(signs)))
}

/// Names in documentation that link to code are plain names here.
fn links(text: &str) -> String {
    let mut text = text
        .replace("(fn@super::", "(fn@")
        .replace("[`Axis::along`]", "`Axis::along`")
        .replace("[`Vec3::axis_near`]", "`Vec3::axis_near`");
    while let (Some(from), Some(to)) = (
        text.find("](fn@"),
        text.find("](fn@").and_then(|from| Some(from + text[from..].find(')')?)),
    ) {
        text.replace_range(from..=to, "");
        if let Some(open) = text[..from].rfind('[') {
            text.remove(open);
        }
    }
    text
}

fn line(joint: &Joint) -> String {
    let sample = (joint.make)(&mut Random::new(1));
    let constraint = sample.constraint();
    let (equation, ..) = paragraphs(constraint.facts().description);
    let rows = constraint.facts().rows.len();
    let own = arguments(constraint);
    let coordinates = own.iter().filter(|argument| matches!(argument, Argument::Coord(_))).count();
    let all =
        if own.iter().any(|argument| matches!(argument, Argument::Spatial(_))) { 6 } else { 3 };
    let left = match own.len() - coordinates {
        1 | 2 => (all + coordinates - rows).to_string(),
        _ => "–".to_owned(),
    };
    let mut names: Vec<&str> =
        constraint.arguments().iter().map(|argument| argument.name).collect();
    names.dedup();
    let picture = format!("library/{}", file(joint));
    let exchanged = if joint.exchanged.is_some() { "✓" } else { "" };
    format!(
        "| ![{}]({picture}) | `{}` ({}) | {equation} | {rows} | {left} | {exchanged} |\n",
        joint.name(),
        joint.name(),
        names.join(", ")
    )
}

/// Name of the picture's file.
fn file(joint: &Joint) -> String {
    let space = if joint.group.starts_with("spatial") { "spatial_" } else { "" };
    format!("{space}{}.svg", joint.name())
}

fn page() -> String {
    let mut text = HEAD.to_owned();
    let signatures = signature::all();
    for (group, title) in [
        ("planar", "Planar joints and couplings (in the prelude)"),
        ("drivers", "Drivers of coordinates and planar bodies (in the prelude)"),
        ("spatial", "Spatial joints and couplings (`spatial::…`)"),
        ("spatial drivers", "Drivers of spatial bodies (`spatial::…`)"),
    ] {
        let _ = write!(
            text,
            "\n## {title}\n\n| | joint | equation | rows | left | ex. |\n|---|---|---|---|---|---|\n"
        );
        let own: Vec<Joint> =
            table::all().into_iter().filter(|joint| joint.group == group).collect();
        own.iter().for_each(|joint| text += &line(joint));
        text += "\n";
        for joint in &own {
            let sample = (joint.make)(&mut Random::new(1));
            let (_, more, signs) = paragraphs(sample.constraint().facts().description);
            let given = signature::of(&signatures, joint);
            let _ = writeln!(text, "* **`{}`** `({given})`: {more} *Signs:* {signs}", joint.name());
        }
    }
    text += &loads::sections();
    text += "\n## Laws\n\nA break is a point where a derivative jumps. At a break Kin uses the derivatives of the right side.\n\n";
    text += "| law | | parameters | lowest derivative that jumps |\n|---|---|---|---|\n";
    let mut known: Vec<&str> = Vec::new();
    for laws::Line { name, law, from, to } in laws::all() {
        if known.contains(&name) || name == "#[law]" {
            continue;
        }
        known.push(name);
        let mut parameters = Vec::new();
        law.parameters(&mut |name, _| parameters.push(name.to_owned()));
        let shown = if parameters.len() > 6 {
            format!("{}, …", parameters[..4].join(", "))
        } else {
            parameters.join(", ")
        };
        let order = match law.breaks(from, to).iter().map(|b| b.order).min() {
            Some(order) => order.to_string(),
            None => "none".to_owned(),
        };
        let _ = writeln!(text, "| `{name}` | {} | {shown} | {order} |", tidy(law.description()));
    }
    text += "\nFor a user-defined law, put `#[law]` on a function of one variable or implement `LawFunction`.\n";
    text
}

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs")
}

/// Compares a file with what it should hold, or writes it.
fn compare(path: &Path, expected: &str, different: &mut Vec<String>) {
    if std::env::var_os("KIN_BLESS").is_some() {
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        std::fs::write(path, expected).expect("written");
    }
    if std::fs::read_to_string(path).unwrap_or_default() != expected {
        different.push(path.display().to_string());
    }
}

/// A joint without a word on which way is positive would be tried both ways by everyone.
#[test]
fn every_joint_says_which_way_is_positive() {
    for joint in table::all() {
        let sample = (joint.make)(&mut Random::new(1));
        let (equation, _, signs) = paragraphs(sample.constraint().facts().description);
        assert!(
            !signs.is_empty(),
            "`{}` does not tell its signs in a paragraph of their own",
            joint.name()
        );
        assert!(
            equation.contains('[') && equation.ends_with(']'),
            "`{}` does not tell its units: {equation}",
            joint.name()
        );
    }
}

/// The signatures on the page, taken from the source, have the arguments and parameters that the
/// constraint itself tells.
#[test]
fn signatures_are_those_of_the_constraints() {
    let signatures = signature::all();
    for joint in table::all() {
        let sample = (joint.make)(&mut Random::new(1));
        let given = signature::of(&signatures, &joint);
        let names: Vec<&str> = given
            .split(", ")
            .filter_map(|argument| argument.split_once(": ").map(|(name, _)| name))
            .collect();
        let mut told: Vec<String> = sample
            .constraint()
            .arguments()
            .iter()
            .map(|argument| argument.name.to_owned())
            .collect();
        sample.constraint().parameters(&mut |name, _| {
            told.extend(name.split(['.', '[']).next().map(str::to_owned))
        });
        told.dedup();
        assert_eq!(told.len(), names.len(), "`{}`: {told:?} {given}", joint.name());
        assert!(
            told.iter().all(|name| names.contains(&name.as_str())),
            "`{}`: {told:?} {given}",
            joint.name()
        );
    }
}

#[test]
fn the_page_is_that_of_the_code() {
    let mut different = Vec::new();
    compare(&docs().join("library.md"), &page(), &mut different);
    let mut known = Vec::new();
    for joint in table::all() {
        let picture = sketch::svg(joint.group, &joint.name())
            .unwrap_or_else(|| panic!("nobody has drawn `{}` ({})", joint.name(), joint.group));
        compare(&docs().join("library").join(file(&joint)), &picture, &mut different);
        known.push(file(&joint));
    }
    for entry in std::fs::read_dir(docs().join("library")).expect("readable") {
        let name = entry.expect("an entry").file_name().to_string_lossy().into_owned();
        assert!(known.contains(&name), "docs/library/{name} belongs to no joint");
    }
    assert!(different.is_empty(), "write anew with KIN_BLESS=1: {different:?}");
}
