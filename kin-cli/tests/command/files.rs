//! Mechanism files: the schema of them, and files that somebody has spoilt.

use std::path::Path;
use std::time::Instant;

use kin::data::MechanismData;
use kin::prelude::*;
use serde_json::{Value, json};

use crate::{SLOT, campaign, data, four_bar};

/// Every mechanism file there is, with its name.
fn files() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data/examples");
    let mut all: Vec<(String, String)> = std::fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| {
            let path = entry.expect("an entry").path();
            (path.display().to_string(), std::fs::read_to_string(path).expect("readable"))
        })
        .collect();
    all.sort();
    all.push(("slot".to_string(), SLOT.to_string()));
    all
}

/// Tells whether a file is one by the schema that the command writes.
fn judge() -> impl Fn(&Value) -> Result<(), String> {
    let schema: Value = serde_json::from_str(&data(&["schema"])).expect("JSON");
    let mut schemas = boon::Schemas::new();
    let mut compiler = boon::Compiler::new();
    compiler.add_resource("mechanism.json", schema).expect("a schema");
    let index = compiler.compile("mechanism.json", &mut schemas).expect("a schema");
    move |value| schemas.validate(value, index).map_err(|error| error.to_string())
}

#[test]
fn every_file_is_one_by_the_schema() {
    let judge = judge();
    let all = files();
    assert!(all.len() > 20);
    for (name, text) in all {
        let value: Value = serde_json::from_str(&text).expect("JSON");
        judge(&value).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

/// A file with everything that a program can say, which is written and read.
#[test]
fn the_schema_has_every_member_that_is_written() {
    let mut m = Mechanism::new("everything");
    m.units("mm", "s");
    let link = m.link("link", 1.0).expect("a link");
    let body = m.spatial("body", kin::SpatialPose::at(Vec3::new(0.0, 0.0, 0.0))).expect("a body");
    m.add("O", revolute(m.ground(), link, vec2(0.0, 0.0), link.start())).expect("a joint");
    m.add("motor", drive(link.theta(), Law::ramp(1.0) + 2.0 * Law::sine(1.0, 2.0, 0.0)))
        .expect("a driver");
    m.add(
        "fixed",
        spatial::fixed(body, Vec3::new(0.0, 0.0, 0.0), EulerParameters::new(1.0, 0.0, 0.0, 0.0)),
    )
    .expect("a joint");
    m.limit("O.angle", -1.0, f64::INFINITY).expect("a limit");
    m.prefer(link, 0.3);
    m.prefer("O.angle", 0.3);
    let arm =
        m.dimension("arm", 2.0).expect("a dimension").within(1.0, 3.0).tolerance(0.1).unit("mm");
    m.link("bent", arm / 2.0).expect("a link");
    m.mass(link, 1.0, vec2(0.0, 0.0), 0.1).expect("a mass");
    m.gravity(vec2(0.0, -9.81));
    let value = serde_json::to_value(m.data().expect("data")).expect("JSON");
    judge()(&value).unwrap_or_else(|error| panic!("{error}\n{value}"));
}

/// Words of the reader's error, and a slip that makes it.
type Slip = (&'static str, fn(&mut Value));

/// The schema and the reader refuse the same slips.
#[test]
fn slips_are_refused_by_the_schema_and_by_the_reader() {
    let judge = judge();
    let slips: [Slip; 9] = [
        ("unknown field `limit`", |file| file["limit"] = json!([])),
        ("unknown field `lenght`", |file| file["bodies"][0]["lenght"] = json!(1.0)),
        ("unknown field `parametres`", |file| file["constraints"][0]["parametres"] = json!({})),
        ("missing field `kind`", |file| {
            drop(file["bodies"][0].as_object_mut().map(|body| body.remove("kind")))
        }),
        ("unknown variant `planer`", |file| file["bodies"][0]["kind"] = json!("planer")),
        ("invalid type", |file| file["bodies"][0]["guess"][0] = json!(true)),
        ("unknown field `tolerances`", |file| {
            file["dimensions"] = json!([{ "name": "a", "value": 1.0, "tolerances": 0.1 }]);
        }),
        ("unknown field `center`", |file| {
            let rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            file["masses"] = json!([{ "body": "crank", "mass": 1.0, "center": [0.0, 0.0, 0.0], "inertia": rows }]);
        }),
        ("unknown variant `body`", |file| {
            file["constraints"][0]["arguments"][0] = json!({ "body": null })
        }),
    ];
    for (told, slip) in slips {
        let mut file = four_bar();
        slip(&mut file);
        assert!(judge(&file).is_err(), "{told}");
        let error = serde_json::from_value::<MechanismData>(file).expect_err(told).to_string();
        assert!(error.contains(told), "{told}: {error}");
    }
}

/// A file with one or a few changes: of a byte, of a number, of a member, of a part by one of
/// another file.
fn spoilt(files: &[(String, String)], random: &mut fastrand::Rng) -> String {
    let pick = |random: &mut fastrand::Rng| files[random.usize(..files.len())].1.clone();
    let mut text = pick(random);
    for _ in 0..random.usize(1..4) {
        let at = |random: &mut fastrand::Rng, text: &str| {
            let mut at = random.usize(..=text.len());
            while !text.is_char_boundary(at) {
                at -= 1;
            }
            at
        };
        let a = at(random, &text);
        let b = at(random, &text);
        let from = a.min(b);
        let to = a.max(b).min(a.min(b) + 40);
        let to = (from..=to).rev().find(|k| text.is_char_boundary(*k)).unwrap_or(from);
        let other = pick(random);
        let c = at(random, &other);
        let d = at(random, &other);
        let part = &other[c.min(d)..c.max(d)];
        let part: String = part.chars().take(60).collect();
        let words = [
            "-1e999",
            "1e308",
            "null",
            "\"\"",
            "{}",
            "[]",
            "0",
            "-0.5",
            "\\u001b",
            "ground",
            "crank",
            "9e99",
            "\"planar\"",
        ];
        let new = if random.bool() { part } else { words[random.usize(..words.len())].to_string() };
        // A number or a name more often than a byte, so that most files stay JSON.
        match text[from..].find(|c: char| c.is_ascii_digit()).filter(|_| random.u8(..) < 200) {
            Some(number) => {
                let begin = from + number;
                let rest = &text[begin..];
                let length = rest
                    .find(|c: char| !(c.is_ascii_digit() || ".eE+-".contains(c)))
                    .unwrap_or(rest.len());
                text.replace_range(begin..begin + length, words[random.usize(..words.len())]);
            }
            None => text.replace_range(from..to, &new),
        }
    }
    text
}

/// `KIN_MUTANTS=100000` tries as many, on all cores.
#[test]
fn spoilt_files_are_read_or_refused_by_name() {
    let files = files();
    let tried = campaign::tried("KIN_MUTANTS", 1_500, |number| {
        let text = spoilt(&files, &mut fastrand::Rng::with_seed(19 + number));
        let begun = Instant::now();
        let made = MechanismData::read(&text)
            .and_then(|data| Mechanism::from_data(&data, &kin_text::registry())?.build());
        let time = begun.elapsed();
        if let Err(error) = &made {
            // A place of the text, the name of a part of the mechanism, or the one member without a
            // name.
            let told = error.to_string();
            let is_placed =
                ["line ", "`", "mechanism: format "].iter().any(|place| told.contains(place));
            assert!(is_placed, "{told}\n{text}");
        }
        campaign::One { read: made.is_ok(), time, text }
    });
    println!("{tried}");
    assert!(tried.read > tried.count / 20, "only {} of {} are read", tried.read, tried.count);
    tried.are_bounded();
}
