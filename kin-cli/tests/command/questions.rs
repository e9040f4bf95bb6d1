//! Questions: assemblies, measures, proofs, sensitivities, diagnoses, names.

use serde_json::Value;

use crate::{data, done, example, words};

/// The numbers of a table below its header.
fn numbers(table: &str) -> Vec<Vec<f64>> {
    let row = |row: &str| row.split(',').map(|x| x.parse().expect("a number")).collect();
    table.lines().skip(1).map(row).collect()
}

#[test]
fn both_assemblies_of_a_four_bar_are_found() {
    let table = data(&["assemblies", &example("04_four_bar"), "--at", "0.1"]);
    let mut rows = table.lines();
    assert_eq!(rows.next().map(|header| header.starts_with("label,crank.R_x,")), Some(true));
    let labels: Vec<&str> = rows.map(|row| row.split(',').next().expect("a label")).collect();
    assert_eq!(labels.len(), 2, "{labels:?}");
}

#[test]
fn a_measure_has_its_rates_and_extremes() {
    let m = example("04_four_bar");
    let arguments = ["measure", &m, "rocker.theta", "O.angle", "--times", "0:1:361"];
    let table = data(&arguments);
    let header = table.lines().next().expect("a header");
    assert_eq!(
        header,
        "t [s],rocker.theta [rad],rocker.theta' [rad/s],rocker.theta'' [rad/s^2],O.angle [rad],O.angle' [rad/s],O.angle'' [rad/s^2]"
    );
    for row in numbers(&table) {
        assert!((row[5] + std::f64::consts::TAU).abs() < 1e-9, "{row:?}");
    }
    let told = words(&done(&arguments));
    assert!(told.contains("rocker.theta: from 1.77") && told.contains("to 2.467462146922"), "{told}");
}

#[test]
fn sensitivities_are_central_differences() {
    let m = example("04_four_bar");
    let names = ["motor.law.rate", "C.u_i.x"];
    let asked = ["--times", "0:1:21", "--of", "rocker.theta", "--by", names[0], "--by", names[1]];
    let by = numbers(&data(&[&["sensitivities", &m][..], &asked].concat()));
    for (column, name) in names.iter().enumerate() {
        let value = |value: f64| {
            let set = format!("{name}={value}");
            numbers(&data(&["measure", &m, "rocker.theta", "--times", "0:1:21", "--set", &set]))
        };
        let (at, h) = ([std::f64::consts::TAU, 4.0][column], 1e-5);
        let (more, less) = (value(at + h), value(at - h));
        for (k, row) in by.iter().enumerate() {
            let difference = (more[k][1] - less[k][1]) / (2.0 * h);
            assert!((row[column + 1] - difference).abs() < 1e-6, "{name}: {} {difference}", row[column + 1]);
        }
    }
}

#[test]
fn a_proof_is_told_and_its_steps_are_a_table() {
    let steps = data(&["prove", &example("04_four_bar"), "--times", "0:1:181", "--csv", "-"]);
    assert_eq!(steps.lines().count(), 181);
    assert!(steps.lines().skip(1).all(|row| row.contains(",yes,")));
    let told = words(&done(&["prove", &example("04_four_bar"), "--times", "0:1:181"]));
    assert!(told.contains("all 180 steps are proved"), "{told}");
}

#[test]
fn a_diagnosis_is_words_and_data() {
    let arguments = ["diagnose", &example("04_four_bar"), "--json", "-"];
    let data: Value = serde_json::from_str(&data(&arguments)).expect("JSON");
    assert_eq!(data["rank"], 9);
    assert!(words(&done(&arguments)).contains("can be driven"));
}

#[test]
fn names_are_those_that_can_be_set_and_asked_for() {
    let m = example("04_four_bar");
    let table = data(&["check", &m, "--names"]);
    let mut kinds = std::collections::BTreeMap::<&str, usize>::new();
    for row in table.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        *kinds.entry(cells[0]).or_default() += 1;
        match cells[0] {
            "measure" => drop(data(&["measure", &m, cells[1], "--times", "0"])),
            _ => drop(data(&["check", &m, "--set", &format!("{}={}", cells[1], cells[2])])),
        }
    }
    assert_eq!(kinds.into_iter().collect::<Vec<_>>(), [("coordinate", 9), ("measure", 4), ("parameter", 17)]);
}
