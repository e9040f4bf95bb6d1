//! The mistakes of `tests/ui` of which rustc speaks in a program: in a text the reader has a
//! sentence of its own with a cure, at the place at which rustc points. `NAME.text` is the picture,
//! which `KIN_BLESS=1 cargo test --test text` writes anew, for review.

use std::path::{Path, PathBuf};

use kin_text::{Equation, Mistakes};

/// Programs whose mistake no text can have, with the reason.
const OF_PROGRAMS: [(&str, &str); 14] = [
    ("body_handed_to_a_driver_of_a_coordinate", IN_MAIN),
    ("coordinate_handed_to_a_joint", IN_MAIN),
    ("name_of_a_body_handed_to_a_joint", IN_MAIN),
    ("own_constraint_given_a_body_of_the_other_family", IN_MAIN),
    ("planar_body_handed_to_a_spatial_joint", IN_MAIN),
    ("planar_direction_taken_for_an_axis", IN_MAIN),
    ("spatial_body_handed_to_a_planar_driver", IN_MAIN),
    ("spatial_body_handed_to_a_planar_joint", IN_MAIN),
    (
        "f64_only_helper",
        "a text has one kind of number, whose derivatives every function of the text carries",
    ),
    (
        "plain_array_in_a_struct",
        "the same of fields; and `macro_rules!` is refused where it stands",
    ),
    ("bits_of_a_coordinate_beside_a_while", WHILE),
    ("helper_called_with_too_many_arguments_beside_a_while", WHILE),
    ("text_constant_beside_a_while", WHILE),
    ("link_as_argument", "rustc can point at the attribute only, the reader points at the type"),
];

const IN_MAIN: &str = "a program hands it over in `main`; a file is told by kinds of arguments";
const WHILE: &str = "a `while` without known bounds is refused before, where it stands";

/// Programs with a parameter of a type that no text knows, which is told first: the same mistake in
/// a text that has the value from elsewhere, its place, and the sentence.
const WITHOUT_THE_PARAMETER: [(&str, &str, &str, &str); 8] = [
    (
        "let_else_that_goes_on",
        "fn stop(x: Coord) -> f64 {\n    let Some(y) = (x > 0.0).then(|| 2.0 * x) else { 0.0; };\n    x - y\n}",
        "2:51",
        "the block after `else` must leave the function: `return`, `break`, `continue` or `panic!`",
    ),
    (
        "map_or_without_its_function",
        "fn stop(x: Coord) -> f64 {\n    x - (x > 0.0).then(|| 2.0 * x).map_or(0.0)\n}",
        "2:36",
        "`map_or` takes 2 arguments, not 1",
    ),
    (
        "unknown_field_of_a_parameter",
        "fn spring(x: Coord, k: f64) -> f64 {\n    struct Gains { k: f64 }\n    let gains = Gains { k };\n    gains.stiffness * x\n}",
        "4:11",
        "a `Gains` has no field `stiffness`",
    ),
    (
        "unknown_variant_in_a_pattern",
        "fn follower(x: Coord) -> f64 {\n    enum Profile { Flat, Round(f64) }\n    let p = if x > 0.0 { Profile::Flat } else { Profile::Round(1.0) };\n    match p { Profile::Flat => x, Profile::Rond(r) => x - r }\n}",
        "4:44",
        "`Profile` has no variant `Rond`: the variants are `Flat`, `Round`",
    ),
    (
        "vector_from_a_field_of_three_numbers",
        "fn mounted(i: Planar) -> Vec2 {\n    struct Mount { at: [f64; 3] }\n    let mount = Mount { at: [0.0; 3] };\n    i.r - Vec2::from(mount.at)\n}",
        "4:22",
        "expected Vec2, but found an array of 3",
    ),
    (
        "bits_of_a_coordinate_beside_a_while",
        "fn truncated(a: Coord, k: f64) -> f64 {\n    k - f64::from_bits(f64::to_bits(a))\n}",
        "2:37",
        "`to_bits` has no derivative, but the value depends on coordinates or time",
    ),
    (
        "helper_called_with_too_many_arguments_beside_a_while",
        "fn square(x: f64) -> f64 { x * x }\n#[constraint]\nfn squared(a: Coord, k: f64) -> f64 {\n    let mut sum = a;\n    for _ in 0..2 { sum -= 1.0; }\n    square(sum, k) - k\n}",
        "6:5",
        "`square` takes 1 argument, not 2",
    ),
    (
        "text_constant_beside_a_while",
        "const NAME: &str = \"slot\";\nfn series(x: Coord) -> f64 {\n    x - NAME\n}",
        "3:9",
        "`NAME` is a constant of type `&str`: write a number in place of `NAME`",
    ),
];

/// Programs of which reader and rustc see the same mistake from two sides: the place of the reader.
const FROM_ANOTHER_SIDE: [(&str, &str, &str); 1] = [(
    "vector_constant_used_as_a_number",
    "7:7",
    "of a vector and a number the sign between them is told, as `sum_of_a_number_and_a_vector` has it",
)];

fn places(mistakes: &Mistakes) -> Vec<String> {
    mistakes.0.iter().map(|one| format!("{}:{}", one.line, one.column)).collect()
}

/// Each program of whose mistakes rustc speaks, and the places at which it does.
fn programs() -> Vec<(String, PathBuf, Vec<String>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/ui");
    let files =
        std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("a file").path());
    let mut all: Vec<_> = files
        .filter(|path| path.extension().is_some_and(|end| end == "message"))
        .filter_map(|path| {
            let told = std::fs::read_to_string(&path).expect("messages");
            let of_rustc = told.lines().filter(|line| line.contains("`: [E"));
            let places: Vec<String> = of_rustc
                .map(|line| line.split(' ').next().unwrap_or_default().to_string())
                .collect();
            let name = path.file_stem()?.to_string_lossy().into_owned();
            (!places.is_empty()).then_some((name, path, places))
        })
        .collect();
    all.sort();
    all
}

#[test]
fn where_rustc_speaks_the_reader_has_its_own_sentence_at_the_place() {
    let all = programs();
    let mut wrong = Vec::new();
    assert!(all.len() > 44, "only {}", all.len());
    for (name, path, places_of_rustc) in all {
        let text = std::fs::read_to_string(path.with_extension("rs")).expect("readable");
        let read = Equation::read(&text);
        let found = read.as_ref().err().map(places).unwrap_or_default();
        let picture = read.err().map(|mistakes| format!("{mistakes}\n")).unwrap_or_default();
        let other_side = FROM_ANOTHER_SIDE.iter().find(|(known, ..)| *known == name);
        let places = match other_side {
            Some((_, place, _)) => vec![(*place).to_string()],
            None => places_of_rustc.clone(),
        };
        let is_told = places.iter().all(|place| found.contains(place));
        let without_parameter = WITHOUT_THE_PARAMETER.iter().any(|(known, ..)| *known == name);
        let is_listed = without_parameter || OF_PROGRAMS.iter().any(|(known, _)| *known == name);
        // A list says the truth: a program that is told at its place is no longer in it.
        if is_told == is_listed || other_side.is_some() && places_of_rustc == found {
            wrong.push(format!(
                "{name}: {places_of_rustc:?} of rustc, listed: {is_listed}\n{picture}"
            ));
        }
        if is_told {
            wrong.extend(compared(&path.with_extension("text"), &picture));
        }
    }
    assert!(wrong.is_empty(), "{}\n{}", wrong.len(), wrong.join("\n\n"));
}

#[test]
fn mistakes_behind_parameters_that_no_text_knows_are_told_where_the_value_is_known() {
    let names: Vec<String> = programs().into_iter().map(|(name, ..)| name).collect();
    for (name, text, _, _) in WITHOUT_THE_PARAMETER {
        println!(
            "{name}: {}",
            Equation::read(text).err().map(|e| e.to_string()).unwrap_or_default()
        );
    }
    for (name, text, place, sentence) in WITHOUT_THE_PARAMETER {
        assert!(names.iter().any(|known| known == name), "{name} is no program any more");
        let mistakes = Equation::read(text).err().unwrap_or_else(|| panic!("{name} is read"));
        assert_eq!(places(&mistakes), [place], "{name}:\n{mistakes}");
        assert_eq!(mistakes.0[0].message, sentence, "{name}");
    }
    let listed = OF_PROGRAMS
        .iter()
        .map(|(name, _)| name)
        .chain(FROM_ANOTHER_SIDE.iter().map(|(name, ..)| name));
    for name in listed {
        assert!(names.iter().any(|known| known == name), "{name} is no program any more");
    }
}

/// Bodies that rustc lets pass are read.
#[test]
fn variables_that_change_as_they_may_are_no_mistakes() {
    for body in [
        "let y; if x > k { y = x; } else { y = k; } y - 1.0",
        "let y; if x > k { y = x; } else { panic!(\"never\") } y - 1.0",
        "let (y, z); (y, z) = (x, k); y - z",
        "let mut y = x; y += k; y = y * y; y - 1.0",
        "let mut all = [x, k]; for one in all.iter_mut() { *one *= 2.0; } all[0] - all[1]",
        "let mut v = vec2(x, k); let w = &mut v; w.x += 1.0; v.x - v.y",
        "fn twice(all: &mut [f64; 2]) { all[0] *= 2.0; } let mut all = [x, k]; twice(&mut all); all[0] - all[1]",
        "struct Sum { s: f64 } impl Sum { fn add(&mut self, y: f64) { self.s += y; } fn got(&self) -> f64 { self.s } }
         let mut sum = Sum { s: 0.0 }; sum.add(x); sum.got() - k",
        "let mut s = 0.0; let mut add = |y: f64| s += y; add(x); add(k); s - 1.0",
        "let mut all = [x, k].into_iter(); let first = all.next(); first.unwrap_or(0.0) - k",
        "assert!(k > 0.0, \"{k} is no length\"); x - k",
        "let n = 2; match n { 0 => x, 1 => k, _ => x - k }",
        "match x > k { true => x - 1.0, false => x - k }",
        "'rows: for i in 0..3 { for j in 0..3 { if j > i { continue 'rows; } } } x - k",
        "let Some(y) = (x > k).then_some(x) else { return x - k; }; y - 2.0 * k",
    ] {
        let text = format!("fn f(x: Coord, k: f64) -> f64 {{ {body} }}");
        assert!(Equation::read(&text).is_ok(), "{}", Equation::read(&text).err().expect("mistakes"));
    }
}

/// Mistakes of which no program of `tests/ui` is an example, each with its column.
#[test]
fn other_mistakes_of_which_rustc_speaks_are_told_too() {
    for (body, column, told) in [
        (
            "match x { 0.0 => x, 1.0 => k }",
            39,
            "this `match` may have no matching arm: add the arm `_ => …`",
        ),
        ("let v = vec2(x, k); v.x += 1.0; v.x - v.y", 53, "declare `mut v`"),
        ("let all = [x, k]; all[0] = 1.0; all[0] - all[1]", 51, "declare `mut all`"),
        ("let v = vec2(x, k); let w = &mut v; w.x += 1.0; v.x - v.y", 66, "declare `mut v`"),
        ("k = 2.0; x - k", 33, "declare `mut k`"),
        ("let y; y = x; y = k; y - 1.0", 47, "declare `mut y`"),
        ("let y: f64; y - x", 45, "the variable has no value yet"),
        ("let all = [x, k].into_iter(); all.next().unwrap_or(0.0) - k", 63, "declare `mut all`"),
        ("assert!(x); x - k", 33, "expected a condition (bool)"),
        ("for _ in 0..3 { break 'out; } x - k", 55, "no enclosing loop has the label"),
    ] {
        let text = format!("fn f(x: Coord, k: f64) -> f64 {{ {body} }}");
        let mistakes = Equation::read(&text).err().unwrap_or_else(|| panic!("{text} is read"));
        assert!(mistakes.0[0].message.contains(told), "{body}: {mistakes}");
        assert_eq!(mistakes.0[0].column, column, "{mistakes}");
    }
}

/// The difference from the stored text; with `KIN_BLESS=1` none, and the text is stored.
fn compared(path: &Path, found: &str) -> Option<String> {
    if std::env::var_os("KIN_BLESS").is_some() {
        std::fs::write(path, found).expect("a reference can be written");
    }
    let expected = std::fs::read_to_string(path).unwrap_or_default();
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    (expected != found).then(|| format!("{name}\nexpected:\n{expected}\nfound:\n{found}"))
}
