//! The mistakes of `tests/ui` in texts: the same place, the same cure; and hostile texts.

use std::path::Path;

use kin_text::{Equation, LawText};

#[path = "../data/campaign.rs"]
mod campaign;

/// Places and messages of a text's mistakes, ``line:column message``.
fn told(text: &str) -> Vec<String> {
    let mistakes = Equation::read(text).err().map(|mistakes| mistakes.0).unwrap_or_default();
    mistakes.into_iter().map(|one| format!("{}:{} {}", one.line, one.column, one.message)).collect()
}

/// The messages that the macro gives, but rustc's own (`[E0308]`).
fn stored(path: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(path.with_extension("message")).expect("messages");
    let without_token = |line: &str| {
        let (place, rest) = line.split_once(" `")?;
        let (_, message) = rest.split_once("`: ")?;
        (!message.starts_with("[E")).then(|| format!("{place} {message}"))
    };
    text.lines().filter_map(without_token).collect()
}

/// Programs with parameters of types that a text does not know: this is what is told of them.
const PROGRAMS: [&str; 5] = [
    "branches_of_different_types",
    "condition_parameter_used_as_a_number",
    "integer_parameter_used_as_a_number",
    "part_of_an_option_that_is_a_vector",
    "symbolic_asked_of_a_loop_of_unknown_length",
];

#[test]
fn mistakes_are_told_as_the_macro_tells_them() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/ui");
    let mut compared = 0;
    let mut others = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("a file").path();
        if path.extension().is_none_or(|extension| extension != "rs") {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("readable");
        let wanted = stored(&path);
        if wanted.is_empty()
            || text.contains("macro_rules!")
            || text.matches("#[constraint").count() != 1
        {
            continue;
        }
        compared += 1;
        let found = told(&text);
        // A text has one route: what only dual numbers could take is a mistake at the same place.
        let is_told = |wanted: &String| match wanted.split_once("but Kin cannot read ") {
            Some((before, told)) => {
                let place = before.split(' ').next().unwrap_or_default();
                let told = told.split(". Rewrite").next().unwrap_or_default();
                found.contains(&format!("{place} Kin cannot read {told} in a text"))
            }
            None => found.contains(wanted),
        };
        let of_type = found.iter().any(|found| found.contains("write a parameter as an `f64`"));
        let is_of_program =
            PROGRAMS.iter().any(|name| path.file_stem().is_some_and(|stem| stem == *name));
        if is_of_program != of_type || !is_of_program && !wanted.iter().all(is_told) {
            others.push(format!("{}:\n  wanted {wanted:?}\n  found  {found:?}", path.display()));
        }
    }
    assert!(compared > 90, "only {compared} compared");
    assert!(others.is_empty(), "{} of {compared}\n{}", others.len(), others.join("\n"));
}

/// Texts of `tests/ui` and of the library's joints.
fn texts() -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = ["tests/ui", "kin-core/src/joints/planar", "kin-core/src/joints/spatial"];
    let files =
        folders.iter().flat_map(|folder| std::fs::read_dir(root.join(folder)).expect("a folder"));
    let mut paths: Vec<_> = files.map(|entry| entry.expect("a file").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "rs"));
    paths.sort();
    let mut all = Vec::new();
    for path in paths {
        let text = std::fs::read_to_string(&path).expect("readable");
        let pieces = text.split("\n#[constraint").skip(1).map(|rest| {
            let lines: Vec<&str> = rest.lines().collect();
            let last = lines.iter().rposition(|line| line.starts_with('}')).unwrap_or(0);
            format!("#[constraint{}", lines[..=last].join("\n"))
        });
        all.extend(pieces);
    }
    // Laws, a tenth of all.
    let laws = crate::laws::TEXTS.iter().map(|text| (*text).to_string());
    let count = all.len() / 10;
    all.extend(laws.cycle().take(count));
    all
}

/// A text with one or two small changes: a piece left out, put in twice, moved, or replaced by a
/// piece of another text or by something hostile.
fn mutated(texts: &[String], random: &mut fastrand::Rng) -> String {
    const HOSTILE: [&str; 12] = [
        "(",
        "}",
        "\"",
        "'",
        "/*",
        "1e999",
        "0x",
        "\u{1b}[2J",
        "𝛼",
        "((((((((((",
        "4294967296",
        "\0",
    ];
    let mut text = texts[random.usize(..texts.len())].clone();
    for _ in 0..random.usize(1..3) {
        let place = |text: &str, random: &mut fastrand::Rng| {
            let mut k = random.usize(..=text.len());
            while !text.is_char_boundary(k) {
                k -= 1;
            }
            k
        };
        let a = place(&text, random);
        let b = place(&text, random);
        let (a, b) = (a.min(b), a.max(b).min(a.min(b) + random.usize(..20)));
        let b = (b..=text.len()).find(|&k| text.is_char_boundary(k)).unwrap_or(text.len());
        let piece = text[a..b].to_owned();
        let other = &texts[random.usize(..texts.len())];
        let c = place(other, random);
        let d = place(other, random);
        match random.usize(..5) {
            0 => text.replace_range(a..b, ""),
            1 => text.insert_str(a, &piece),
            2 => text.insert_str(a, HOSTILE[random.usize(..HOSTILE.len())]),
            3 => text.replace_range(a..b, HOSTILE[random.usize(..HOSTILE.len())]),
            _ => text.replace_range(a..b, &other[c.min(d)..c.max(d)]),
        }
    }
    text
}

/// `KIN_TEXTS=1000000` tries as many, on all cores.
#[test]
fn mutated_texts_are_read_or_refused_at_a_place() {
    let texts = texts();
    let tried = campaign::tried("KIN_TEXTS", 3_000, |number| {
        let text = mutated(&texts, &mut fastrand::Rng::with_seed(0x7E87 + number));
        let begun = std::time::Instant::now();
        let read = Equation::read(&text).map(drop).or_else(|_| LawText::read(&text).map(drop));
        let time = begun.elapsed();
        if let Err(mistakes) = &read {
            assert!(!mistakes.0.is_empty(), "{text}");
            for one in &mistakes.0 {
                assert!(one.message != "Kin cannot read the text", "a panic:\n{text}");
                let shown = one.to_string();
                assert!(!shown.chars().any(|c| c.is_control() && c != '\n'), "{shown:?}");
                assert!(
                    one.line >= 1 && one.line <= text.lines().count().max(1),
                    "{shown}\n{text}"
                );
            }
        }
        campaign::One { read: read.is_ok(), time, text }
    });
    println!("{tried}");
    assert!(tried.read > tried.count / 100, "only {} of {} are read", tried.read, tried.count);
    tried.are_bounded();
}

#[test]
fn texts_that_are_too_much_are_refused() {
    let nested =
        format!("fn f(x: Coord) -> f64 {{ {}x{} }}", "(".repeat(20_000), ")".repeat(20_000));
    let long = format!("fn f(x: Coord) -> f64 {{ x{} }}", " + x".repeat(20_000));
    let sums = format!("fn f(x: Coord) -> f64 {{ x{} }}", " + x".repeat(9_000));
    let loops = "fn f(x: Coord) -> f64 { let mut s = x; for _ in 0..4000 { for _ in 0..4000 { for _ in 0..4000 { s += x; } } } s }";
    let itself = "fn f(x: Coord) -> f64 { fn g(x: f64) -> f64 { g(x) + g(x) } g(x) }";
    let wide = "fn f(q: [Coord; 4000000000]) -> f64 { q[0] }";
    let empty = "fn f(x: Coord, c: [[f64; 0]; 10000000000]) -> f64 { x - c[0][0] }";
    for text in
        [&nested, &long, &sums, loops, itself, wide, empty, "", "fn", "42", "fn main() {}", "\u{0}"]
    {
        let start = std::time::Instant::now();
        let told = told(text);
        assert!(!told.is_empty() && !told[0].contains("Kin cannot read the text"), "{told:?}");
        assert!(start.elapsed().as_secs() < 10, "{told:?} after {:?}", start.elapsed());
    }
}

#[test]
fn a_mistake_is_shown_with_a_caret() {
    let text = "fn on_cam(cam: Planar, follower: Planar, tip: Vec2, profile: Law) -> f64 {
    let p = cam.local(follower.point(tip));
    p.norm() - profile
}";
    let shown = Equation::read(text).err().expect("a mistake").to_string();
    let wanted = "`profile` is a Law: get a value with `profile.at(x)`
 --> text:3:16
  |
3 |     p.norm() - profile
  |                ^^^^^^^";
    assert_eq!(shown, wanted);
}

#[test]
fn a_let_within_an_expression_is_told_at_its_word() {
    let text = "fn f(x: Coord) -> f64 { let a = 2.0 * x * let b = x + 1.0; a - 1.0 }";
    let [one] = &told(text)[..] else { panic!("{:?}", told(text)) };
    assert!(
        one.starts_with("1:43 `let` begins a statement")
            && one.contains("write `;` before this `let`"),
        "{one}"
    );
}

/// Texts of newcomers, each with the message that names the mistake.
#[test]
fn mistakes_of_newcomers_are_named() {
    let found = told("def slot(i: Planar, k: f64) -> f64 { k }").join("\n");
    assert!(found.contains("write a function, such as `fn slot("), "{found}");
    let found = told("fn slot(i: Planar, k: f64) -> f64 { r.x - k * i.theta }").join("\n");
    assert!(found.contains("Kin does not know `r` in this text"), "{found}");
}

/// Powers and functions as other languages write them: the error has the expression of this one.
#[test]
fn powers_and_functions_of_other_languages_are_told_as_methods() {
    for (body, expected) in [
        ("x ** 2", "`**` is no power: write `x.powi(2)`"),
        ("x**2 - k", "`**` is no power: write `x.powi(2)`"),
        ("2.0 * x ** 2", "`**` is no power: write `x.powi(2)`"),
        ("-x ** 0.5", "`**` is no power: write `x.powf(0.5)`"),
        ("x ** k", "`**` is no power: write `x.powf(k)`"),
        ("x ** -2", "`**` is no power: write `x.powi(-2)`"),
        ("(x + k) ** 2", "`**` is no power: write `(x + k).powi(2)`"),
        ("sin(x)", "`sin` is a method of a number here: write `x.sin()`"),
        ("k - sin(x)", "`sin` is a method of a number here: write `x.sin()`"),
        ("sqrt(x + k)", "`sqrt` is a method of a number here: write `(x + k).sqrt()`"),
        ("atan2(x, k)", "`atan2` is a method of a number here: write `x.atan2(k)`"),
        ("pow(x, 2)", "`pow` is a method of a number here: write `x.powi(2)`"),
        ("pow(x, k)", "`pow` is a method of a number here: write `x.powf(k)`"),
    ] {
        let text = format!("fn f(x: Coord, k: f64) -> f64 {{ {body} }}");
        let told = told(&text);
        assert!(told.iter().any(|one| one.ends_with(expected)), "{body}: {told:?}");
    }
    // A product with what a reference refers to is no power.
    let text = "fn f(x: Coord) -> f64 { let y = 2.0; let z = &y; x * *z }";
    assert!(told(text).is_empty(), "{:?}", told(text));
    assert!(Equation::read("fn f(x: Coord, k: f64) -> f64 { x.powi(2) + k.sin() }").is_ok());
}
