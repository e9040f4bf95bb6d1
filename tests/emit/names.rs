//! Names that try to break out of the file, and files of which a line was changed.

use kin::emit::{self, Options};
use kin::prelude::*;

use crate::examples::{Random, mechanisms};
use crate::programs::{compiled, prefix, there_is_a_compiler};

/// Names that would end a comment or a literal, or that C does not allow.
const NAMES: [&str; 12] = [
    "*/ system(\"x\")",
    "/* \\",
    "??/",
    "while",
    "NAN",
    "a b",
    "a_b",
    "é\u{202e}λ",
    "\"; }",
    "#include <x>",
    "2nd%s%n",
    "//\\",
];

/// A crank with these names of the mechanism, body, joints and dimension.
fn crank(names: [&str; 4]) -> kin::Result<System> {
    let [title, body, joint, dimension] = names;
    let mut m = Mechanism::new(title);
    let length = m.dimension(dimension, 0.4)?;
    let other = m.dimension("a_b c", 0.1)?;
    let crank = m.link(body, length)?;
    m.add(joint, revolute(Ground, crank, (other, 0.0), crank.start()))?;
    m.add("motor", drive_angle(crank, Law::ramp(2.0)))?;
    m.build()
}

/// Returns a text without comments.
fn without_comments(text: &str) -> String {
    let mut rest = text;
    let mut code = String::new();
    while let Some((before, after)) = rest.split_once("/*") {
        code += before;
        rest = after.split_once("*/").expect("the end of a comment").1;
    }
    code + rest
}

#[test]
fn no_name_breaks_out_of_the_file() -> kin::Result<()> {
    for (k, name) in NAMES.iter().enumerate() {
        let next = NAMES[(k + 5) % NAMES.len()];
        let system = crank([name, next, NAMES[(k + 7) % NAMES.len()], name])?;
        let coordinate = system.coordinate_names()[2].clone();
        let options = Options {
            free: vec![name.to_string(), "a_b c".to_string()],
            measures: vec![coordinate],
            ..Options::default()
        };
        let text = emit::c(&system, &options)?;
        let code = without_comments(&text);
        for word in ["system(", "include <x>", "%n"] {
            assert!(!code.contains(word), "{name}: {word}");
        }
        if there_is_a_compiler() {
            let program = compiled(&format!("name {k}"), &text, &[]);
            let program = program.unwrap_or_else(|messages| panic!("{name}: {messages}"));
            assert_eq!(program.selftest(), "0", "{name}");
        }
    }
    Ok(())
}

#[test]
fn the_prefix_can_be_chosen() -> kin::Result<()> {
    let system = crank(["crank", "c", "O", "length"])?;
    let named = |name: &str| {
        let options = Options { name: Some(name.to_string()), ..Options::default() };
        emit::c(&system, &options).map(|text| prefix(&text).to_string())
    };
    assert_eq!(named("my crank")?, "my_crank");
    assert_eq!(named("int")?, "k_int");
    Ok(())
}

/// Changes one sign, operand or constant of a line of arithmetic. Returns `None` if there is
/// nothing to change.
fn changed(line: &str, random: &mut Random) -> Option<String> {
    let (left, right) = line.split_once(" = ")?;
    // The sign of an equation that is off by rounding alone means nothing.
    if left.contains("k->c[") {
        return None;
    }
    let (right, remark) = right.split_at(right.find(" /*").unwrap_or(right.len()));
    let words: Vec<&str> = right.split(' ').collect();
    let at = random.below(words.len());
    let word = words[at];
    let bare = word.trim_end_matches([',', ';', '}', ')']);
    let tail = &word[bare.len()..];
    let new = match word {
        "+" => "-".to_string(),
        "-" => "+".to_string(),
        "*" => "/".to_string(),
        _ => match bare.parse::<f64>() {
            Ok(x) => format!("{:?}{tail}", 1.01 * x + 0.01),
            Err(_) if bare.starts_with('-') => word[1..].to_string(),
            Err(_) => format!("-{word}"),
        },
    };
    let mut words: Vec<String> = words.iter().map(|word| word.to_string()).collect();
    words[at] = new;
    Some(format!("{left} = {}{remark}", words.join(" ")))
}

#[test]
fn the_self_test_notices_a_changed_line() {
    if !there_is_a_compiler() {
        return;
    }
    let wanted = ["04_four_bar", "05_quick_return", "01_slider_crank"];
    let mut random = Random(5);
    for (name, system) in mechanisms().into_iter().filter(|own| wanted.contains(&own.0.as_str())) {
        let text = emit::c(&system, &Options::default()).expect("emitted");
        let lines: Vec<&str> = text.lines().collect();
        let is_arithmetic = |line: &&str| {
            let line = line.trim_start();
            line.starts_with("const double x") || line.starts_with("k->") && line.contains("] = ")
        };
        let end = lines.iter().position(|line| line.contains("_size[")).expect("tables");
        let own: Vec<usize> = (0..end).filter(|k| is_arithmetic(&lines[*k])).collect();
        let mut survivors = Vec::new();
        for _ in 0..20 {
            let k = own[random.below(own.len())];
            let Some(line) = changed(lines[k], &mut random) else { continue };
            let mut mutant = lines.clone();
            mutant[k] = &line;
            let noticed = match compiled("mutant", &mutant.join("\n"), &[]) {
                Ok(program) => program.selftest() != "0",
                Err(_) => true,
            };
            if !noticed {
                survivors.push(format!("{name}: {} -> {line}", lines[k]));
            }
        }
        assert!(survivors.is_empty(), "{survivors:#?}");
    }
}
