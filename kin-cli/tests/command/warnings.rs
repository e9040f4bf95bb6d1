//! Warnings of a first run: notes on the standard error, and in the JSON of a motion.

use serde_json::Value;

use crate::examples::{EXAMPLES, OWN};
use crate::{code, data, done, example, file, words};

/// A crank whose motor has that rate.
fn crank(rate: f64) -> String {
    let text = format!(
        r#"{{ "name": "crank",
  "bodies": [{{ "name": "crank", "kind": "planar", "guess": [0.5, 0, 0], "length": 1 }}],
  "constraints": [
    {{ "name": "O", "kind": "revolute", "arguments": [{{ "planar": null }}, {{ "planar": "crank" }}],
       "parameters": {{ "u_i": [0, 0], "u_j": [-0.5, 0] }} }},
    {{ "name": "motor", "kind": "drive_angle", "arguments": [{{ "planar": "crank" }}],
       "parameters": {{ "law": {{ "kind": "ramp", "numbers": {{ "rate": {rate} }} }} }} }}] }}"#
    );
    file(&format!("crank at {rate}.json"), &text)
}

const SENTENCE: &str = "`motor` turns `crank` at 360 rad/s (57 turns/s): `motor.law.rate` is 360. Angles are in \
                        radians; if degrees are meant, give 6.283185307179586 (360°).";

#[test]
fn degrees_are_asked_about_in_words_of_the_file() {
    let m = crank(360.0);
    let ended = done(&["run", &m, "--times", "0:1:11"]);
    assert_eq!(code(&ended), 0);
    assert_eq!(words(&ended).matches(SENTENCE).count(), 1, "{}", words(&ended));
    // Commands that write no summary say it too, once.
    for asked in [&["measure", "O.angle"][..], &["prove"], &["sensitivities", "motor.law.rate"]] {
        let mut arguments = vec![asked[0], &m];
        match asked {
            ["sensitivities", name] => arguments.extend(["--by", name]),
            _ => arguments.extend(&asked[1..]),
        }
        arguments.extend(["--times", "0:0.01:11"]);
        let told = words(&done(&arguments));
        assert_eq!(told.matches(SENTENCE).count(), 1, "{arguments:?}: {told}");
    }
    for rate in [1.0, 10.0, 100.0, 314.16] {
        let told = words(&done(&["run", &crank(rate), "--times", "0:1:11"]));
        assert!(!told.contains("warning"), "{told}");
    }
}

#[test]
fn warnings_are_objects_where_notes_are() {
    let ended = done(&["--error-format", "json", "run", &crank(360.0), "--times", "0:1:11"]);
    let told = words(&ended);
    let objects = told.lines().map(|line| serde_json::from_str::<Value>(line).expect("JSON"));
    let warnings: Vec<Value> =
        objects.filter_map(|object| object.get("warning").cloned()).collect();
    assert_eq!(warnings.len(), 1, "{told}");
    assert_eq!(warnings[0]["kind"], "degrees");
    assert_eq!(warnings[0]["names"], serde_json::json!(["motor", "crank"]));
    assert_eq!(warnings[0]["text"], SENTENCE);
    let json = data(&["run", &crank(360.0), "--times", "0:1:11", "--json", "-"]);
    let motion: Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(motion["warnings"], Value::from(warnings));
}

/// The cases of a sweep share their slips: the first one is asked about.
#[test]
fn a_sweep_asks_once() {
    let cases = file("rates.csv", "motor.law.rate\n360\n720\n1\n");
    let m = crank(1.0);
    let ended = done(&["sweep", &m, &cases, "--times", "0:0.1:11", "--keep", "crank.theta"]);
    let told = words(&ended);
    assert_eq!(told, format!("case 0: warning: {SENTENCE}\n"));
    let asked = ["sweep", &m, &cases, "--times", "0:0.1:11", "--keep", "crank.theta"];
    let told = words(&done(&[&asked[..], &["--shard", "3/3"]].concat()));
    assert_eq!(told, "");
}

/// No example has a slip.
#[test]
fn no_example_is_warned_of() {
    let examples = EXAMPLES.into_iter().map(|(name, ends, ..)| (name, ends));
    for (name, [from, to]) in examples.chain(OWN.map(|(name, ends, _)| (name, ends))) {
        let times = format!("{from}:{to}:101");
        let ended = done(&["run", &example(name), "--times", &times]);
        let told = words(&ended);
        assert!(code(&ended) == 0 && !told.contains("warning"), "{name}: {told}");
    }
}
