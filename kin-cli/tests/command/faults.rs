//! Every class of faults: its exit code, its words on the standard error, nothing on the standard
//! output.

use serde_json::{Value, json};

use crate::{code, done, example, fed, file, four_bar, words};

/// The four-bar without one of its constraints.
fn without(name: &str) -> String {
    let mut data = four_bar();
    data["constraints"].as_array_mut().expect("a list").retain(|one| one["name"] != name);
    file(&format!("without_{name}.json"), &data.to_string())
}

/// Runs, and asserts code and words; nothing may stand on the standard output.
fn fails(arguments: &[&str], wanted: i32, told: &str) {
    let output = done(arguments);
    assert_eq!(code(&output), wanted, "{arguments:?}: {}", words(&output));
    assert!(words(&output).contains(told), "{arguments:?}: {}", words(&output));
    assert!(output.stdout.is_empty(), "{arguments:?}");
}

#[test]
fn a_mechanism_that_cannot_be_driven_is_its_own_fault() {
    let free = without("motor");
    let told = "Nothing drives";
    fails(&["run", &free, "--times", "0:1:3", "--csv", "-"], 1, told);
    fails(&["check", &free], 1, told);
    fails(&["diagnose", &free], 1, told);
}

#[test]
fn a_command_line_that_makes_no_sense_is_usage() {
    let m = &example("04_four_bar");
    fails(&[], 2, "Usage: kin");
    fails(&["rum"], 2, "unrecognized subcommand 'rum'");
    fails(&["run", m], 2, "--times");
    fails(&["run", m, "--times", "0:1"], 2, "write FROM:TO:COUNT");
    fails(&["run", m, "--times", "0,1,0.5"], 2, "times");
    fails(
        &["run", m, "--times", "0:1:3", "--set", "O.u_k.x=1"],
        2,
        "there is no parameter `O.u_k.x`",
    );
    let twice = ["run", m, "--times", "0:1:3", "--set", "O.u_i.x=0", "--set", "O.u_i.x=1"];
    fails(&twice, 2, "`--set` names `O.u_i.x` twice. Remove one of the two");
    let all = "and 9 more. `kin check FILE --names` lists all";
    fails(&["run", m, "--times", "0:1:3", "--set", "crank=1"], 2, all);
    fails(
        &["run", m, "--times", "0:1:3", "--point", "P=cuppler:0,0"],
        2,
        "there is no body `cuppler`",
    );
    fails(&["run", m, "--times", "0:1:3", "--point", "P=coupler:0,0,0"], 2, "Give 2 numbers");
    fails(&["run", m, "--times", "0:1:3", "--measure", "A.slide"], 2, "A.slide");
    fails(&["measure", m, "B.length", "--times", "0:1:3"], 2, "B.length");
    fails(&["sensitivities", m, "--times", "0:1:3", "--by", "O.u_k.x"], 2, "O.u_k.x");
    fails(&["watch", "-", "--times", "0:1:3"], 2, "Give a file to watch");
    let turning = |file: &str, numbers: &str, told: &str| {
        fails(&["run", file, "--times", "0:2:241", "--other-branch-at", numbers], 2, told);
        fails(&["forces", file, "--times", "0:2:241", "--other-branch-at", numbers], 2, told);
    };
    turning(m, "99", "`--other-branch-at 99`: the motion passes no change point");
    turning(
        &example("16_change_points"),
        "0,99",
        "`--other-branch-at 99`: the motion passes 4 change points, numbers 0 to 3",
    );
    turning(m, "a", "`a` is no number of a change point. Count change points 0, 1, 2");
    fails(&["manual", "rum"], 2, "no command `rum`");
    fails(&["completions", "shish"], 2, "shish");
}

/// The error for an option that needs a number names the option, the text that Kin read, an example
/// of a number, and the unit.
#[test]
fn a_number_that_is_none_is_told_with_its_option_and_unit() {
    let m = &example("04_four_bar");
    let times = ["--times", "0:1:3"];
    let told = |arguments: &[&str], all: &[&str]| {
        let output = done(arguments);
        let words = words(&output);
        assert_eq!(code(&output), 2, "{words}");
        for wanted in all {
            assert!(words.contains(wanted), "{words}\nexpected: {wanted}");
        }
        for word in ["invalid float literal", "invalid digit"] {
            assert!(!words.contains(word), "{words}");
        }
    };
    told(
        &["check", m, "--at", "1s"],
        &["'--at <AT>'", "`1s` is no number. Write the number alone, without `s`: 1", "in s, or"],
    );
    told(&["diagnose", m, "--at", "0,5"], &["'--at <AT>'", "Write a decimal point, 0.5"]);
    told(&["assemblies", m, "--at", "now"], &["'--at <AT>'", "Write it like 0.5, -2 or 1e-3"]);
    told(
        &["run", m, "--times", "0:1:0.1s"],
        &["'--times <TIMES>'", "`0.1s` is no number of times", "for this step it is 11"],
    );
    let set = [&["run", m][..], &times, &["--set", "crank=abc"]].concat();
    told(
        &set,
        &[
            "'--set <NAME=VALUE>'",
            "the value of `crank`: `abc` is no number. Write it like 0.5, -2 or 1e-3",
            "lengths are in m and angles in rad",
        ],
    );
    let set = [&["run", m][..], &times, &["--set", "O.u_i.x=30deg"]].concat();
    told(&set, &["Angles are in radians: write 0.5235987755982988"]);
    let effort = [&["run", m][..], &times, &["--effort", "much"]].concat();
    told(&effort, &["'--effort <MULTIPLE>'", "`much` is no number", "This number has no unit"]);
    let misfit = ["check", m, "--allowed-misfit", "1%"];
    told(&misfit, &["'--allowed-misfit <SHARE>'", "`1%` is no number. Write it like"]);
    let samples = [&["tolerance", m, "rocker.theta"][..], &times, &["--samples", "1e3"]].concat();
    told(&samples, &["'--samples <COUNT>'", "`1e3` is no whole number. Write one from 0 on"]);
    let point = [&["run", m][..], &times, &["--point", "P=crank:a,0"]].concat();
    told(&point, &["the point of `crank`: `a` is no number"]);
}

/// A slip in a mechanism file: line and column, the path, the key, what is known there, the cure.
#[test]
fn a_slip_in_a_file_is_told_with_its_place_and_the_known_names() {
    let slip = |name: &str, from: &str, to: &str, told: &str| {
        let text = std::fs::read_to_string(example("04_four_bar")).expect("readable");
        assert!(text.contains(from), "{from}");
        fails(&["check", &file(name, &text.replacen(from, to, 1))], 5, told);
    };
    slip(
        "key.json",
        "\"guess\"",
        "\"gues\"",
        "`/bodies/0` has the unknown key `gues`. Did you mean `guess`? Use",
    );
    slip(
        "word.json",
        "\"planar\"",
        "\"planer\"",
        "cannot be `planer`. Did you mean `planar`? Use one of",
    );
    slip(
        "comma.json",
        "\"bodies\"",
        ", \"bodies\"",
        "a comma has no key before it. Remove the comma",
    );
    let mut data = four_bar();
    data["constraints"][0]["arguments"][1] = json!({ "planar": "crnk" });
    let told = "no planar body `crnk`. Did you mean `crank`? Use one of `crank`, ";
    fails(&["check", &file("body.json", &data.to_string())], 5, told);
    let mut data = four_bar();
    data["bodies"][0]["name"] = json!("ground");
    let told = "a body cannot have the name `ground`: every mechanism has the ground already. Use \
                `{\"planar\": null}`";
    fails(&["check", &file("ground.json", &data.to_string())], 1, told);
}

/// A table of another form is named as that.
#[test]
fn a_table_of_cases_of_another_form_is_named_as_that() {
    let m = &example("04_four_bar");
    let told = |name: &str, text: &str, told: &str| {
        fails(&["sweep", m, &file(name, text), "--times", "0:1:3"], 5, told);
    };
    let semicolons = "columns are separated by semicolons. Separate them by commas, and write decimal \
                      points, as in 0.5,1.25";
    told("semicolons.csv", "O.u_i.x;O.u_i.y\n0,1;0,2\n", semicolons);
    told(
        "mixed.csv",
        "O.u_i.x,O.u_i.y\n0.1;0.2,0\n",
        "line 2: columns are separated by semicolons",
    );
    told(
        "commas.csv",
        "O.u_i.x,O.u_i.y\n0,1,0,2\n",
        "line 2 has 4 numbers, where the first line names 2. If these are decimal commas, write \
         decimal points, such as 0.5",
    );
    told(
        "bare.csv",
        "0.1,0.2\n0.1,0.3\n",
        "its first line has numbers, 0.1,0.2, but no names. Name",
    );
    told("one.csv", "O.u_i.x,O.u_i.y\n", "it has a first line of names, but no case");
}

#[test]
fn a_run_that_ends_early_has_written_what_came_before() {
    let arguments =
        ["run", &example("04_four_bar"), "--times", "0:1:101", "--set", "C.u_i.x=6", "--csv", "-"];
    let output = done(&arguments);
    assert_eq!(code(&output), 3, "{}", words(&output));
    assert!(words(&output).contains("no position exists beyond the toggle"), "{}", words(&output));
    let rows = String::from_utf8(output.stdout).expect("text").lines().count();
    assert!((20..60).contains(&rows), "{rows} rows");
}

#[test]
fn what_is_not_proved_has_its_own_code() {
    fails(
        &["prove", &example("16_change_points"), "--times", "0:1:31"],
        4,
        "Kin proved 26 of 30 steps.",
    );
    let told = "Kin cannot prove";
    let mut data = four_bar();
    let mut again = data["constraints"][0].clone();
    again["name"] = json!("O again");
    data["constraints"].as_array_mut().expect("a list").push(again);
    fails(&["prove", &file("redundant.json", &data.to_string()), "--times", "0:1:3"], 4, told);
}

#[test]
fn files_that_are_missing_or_none_are_told() {
    let m = &example("04_four_bar");
    fails(&["check", "missing.json"], 5, "cannot read missing.json");
    fails(
        &["check", &file("none.json", "{\"name\": 3}")],
        5,
        "none.json cannot be read as a mechanism: ",
    );
    fails(&["check", &file("text.json", "hello")], 5, "line 1, column 1: `hello` is no value");
    let unknown = four_bar().to_string().replace("\"drive_angle\"", "\"drive_angel\"");
    fails(&["check", &file("unknown.json", &unknown)], 5, "unknown constraint `drive_angel`");
    // Members that a later format has are no mistakes: the format is what is wrong.
    let mut data = four_bar();
    (data["format"], data["bodies"][0]["colour"]) = (json!(99), json!("red"));
    let told =
        "later.json cannot be read as a mechanism: a newer Kin has written its format 99, but Kin ";
    fails(&["check", &file("later.json", &data.to_string())], 5, told);
    fails(
        &["run", m, "--times", "0:1:3", "--csv", "/dev/null/motion.csv"],
        5,
        "cannot write /dev/null/motion.csv",
    );
    let short = file("short.csv", "O.u_i.x,O.u_i.y\n0.1,0.2\n0.1\n");
    fails(
        &["sweep", m, &short, "--times", "0:1:3"],
        5,
        "line 3 has 1 numbers, where the first line names 2",
    );
    let text = std::fs::read_to_string(m).expect("readable");
    let text = text.replacen("\"u_i\":", "\"u_i\": [5.0, 5.0], \"u_i\":", 1);
    fails(&["check", &file("key_twice.json", &text)], 5, "the key `u_i` appears twice");
    let twice = file("twice.csv", "O.u_i.x,O.u_i.x\n0.1,0.2\n");
    fails(&["sweep", m, &twice, "--times", "0:1:3"], 5, "its first line names `O.u_i.x` twice");
    let cases = file("none.csv", "O.u_i.x\n0.1\nblue\n");
    fails(&["sweep", m, "missing.csv", "--times", "0:1:3"], 5, "cannot read missing.csv");
    let mistake = crate::SLOT.replace("s.y - k", "s.w - k");
    fails(&["check", &file("mistake.json", &mistake)], 5, "a Vec2 has no field `w`");
    let output = done(&["sweep", m, &cases, "--times", "0:1:3"]);
    assert_eq!(code(&output), 5);
    assert!(
        words(&output).contains("line 3: `O.u_i.x`: `blue` is no number"),
        "{}",
        words(&output)
    );
}

#[test]
fn a_mistake_in_the_standard_input_is_told_as_such() {
    let output = fed(&["check", "-"], "{");
    assert_eq!(code(&output), 5);
    assert!(
        words(&output).contains("standard input cannot be read as a mechanism"),
        "{}",
        words(&output)
    );
}

#[test]
fn faults_as_json_are_one_object_a_line() {
    for (arguments, code_wanted, kind) in [
        (vec!["check".to_string(), without("motor")], 1, "mechanism"),
        (vec!["rum".to_string()], 2, "usage"),
        (vec!["check".to_string(), "missing.json".to_string()], 5, "file"),
    ] {
        let mut all: Vec<&str> = arguments.iter().map(String::as_str).collect();
        all.extend(["--error-format", "json"]);
        let output = done(&all);
        assert_eq!(code(&output), code_wanted);
        let told = words(&output);
        let last: Value = serde_json::from_str(told.lines().last().expect("a line")).expect("JSON");
        assert_eq!(last["error"]["code"], json!(code_wanted), "{told}");
        assert_eq!(last["error"]["kind"], json!(kind), "{told}");
        assert!(last["error"]["message"].as_str().is_some_and(|text| !text.is_empty()), "{told}");
        assert_eq!(last["error"]["diagnosis"].is_object(), kind == "mechanism", "{told}");
    }
}
