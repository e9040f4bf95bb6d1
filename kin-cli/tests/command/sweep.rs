//! Sweeps: shards are the whole, bit for bit; a row is what a run with its numbers set gives.

use std::sync::OnceLock;

use crate::{code, data, example, fed, file, words};

/// Cranks of many lengths, some too long to turn.
fn cases() -> String {
    static FILE: OnceLock<String> = OnceLock::new();
    FILE.get_or_init(written).clone()
}

fn written() -> String {
    let rows = (0..41).map(|k| {
        let half = 0.25 + 0.04 * f64::from(k);
        format!("{},{half}\n", -half)
    });
    file(
        "cranks.csv",
        &["O.u_j.x,A.u_i.x\n".to_string()].into_iter().chain(rows).collect::<String>(),
    )
}

const ASKED: [&str; 6] = ["--times", "0:1:91", "--keep", "rocker.theta", "--keep", "A.angle"];

fn swept(more: &[&str]) -> Vec<String> {
    let m = example("04_four_bar");
    let cases = cases();
    let table = data(&[&["sweep", &m, &cases][..], &ASKED, more].concat());
    table.lines().map(str::to_string).collect()
}

#[test]
fn shards_are_the_whole_bit_for_bit() {
    let whole = swept(&[]);
    assert_eq!(whole.len(), 42);
    for of in [1, 3, 7] {
        let mut rows = Vec::new();
        for number in 1..=of {
            let part = swept(&["--shard", &format!("{number}/{of}")]);
            assert_eq!(part[0], whole[0]);
            rows.extend(part[1..].to_vec());
        }
        assert_eq!(rows, whole[1..], "{of} shards");
    }
}

#[test]
fn a_row_is_the_run_of_its_case() {
    let whole = swept(&[]);
    let wanted = [
        "case,O.u_j.x,A.u_i.x,status,rocker.theta min,t of rocker.theta min,rocker.theta max",
        "t of rocker.theta max,A.angle min,t of A.angle min,A.angle max,t of A.angle max",
    ];
    assert_eq!(whole[0], wanted.join(","));
    for k in [0, 7, 12] {
        let row: Vec<&str> = whole[k + 1].split(',').collect();
        let set = [format!("O.u_j.x={}", row[1]), format!("A.u_i.x={}", row[2])];
        let m = example("04_four_bar");
        let motion = ["--times", "0:1:91"];
        let asked = ["measure", &m, "rocker.theta", "--set", &set[0], "--set", &set[1]];
        let output = crate::done(&[&asked[..], &motion].concat());
        let told = words(&output);
        for cell in &row[4..8] {
            let number: f64 = cell.parse().expect("a number");
            assert!(told.contains(&format!("{number}")), "{number} of {told}");
        }
    }
}

#[test]
fn a_case_that_fails_is_a_row_that_says_why() {
    let whole = swept(&[]);
    let (done, failed): (Vec<&String>, Vec<&String>) =
        whole[1..].iter().partition(|row| row.contains(",done,"));
    assert!(done.len() > 20 && failed.len() > 5, "{failed:?}");
    assert!(
        failed.iter().any(|row| row.contains("no position exists beyond the toggle")),
        "{failed:?}"
    );
    assert!(failed.iter().all(|row| row.ends_with(",,,,,,,,")), "{failed:?}");
}

#[test]
fn cases_come_from_the_standard_input_and_rows_go_to_a_file() {
    let out = crate::place("rows/part.csv").to_string_lossy().into_owned();
    let m = example("04_four_bar");
    let arguments = [&["sweep", &m, "-"][..], &ASKED, &["--out", &out]].concat();
    let output = fed(&arguments, "rocker.theta\n1.5\n-1.5\n");
    assert_eq!((code(&output), output.stdout.len()), (0, 0), "{}", words(&output));
    let rows = std::fs::read_to_string(&out).expect("readable");
    assert_eq!(rows.lines().count(), 3);
    let unknown = fed(&arguments, "rocker.tehta\n1.5\n");
    assert!(code(&unknown) == 2 && words(&unknown).contains("rocker.tehta"), "{}", words(&unknown));
}

#[test]
fn columns_of_forces_are_kept_like_measures() {
    let arm = example("25_arm_torque");
    let times = ["--times", "0:1:41"];
    let cases = file("arms.csv", "elbow.u_j.x\n-0.175\n-0.16\n");
    let rows = data(&[&["sweep", &arm, &cases], &times[..], &["--keep", "elbow motor"]].concat());
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9 * (1.0 + b.abs());
    for row in rows.lines().skip(1) {
        let row: Vec<&str> = row.split(',').collect();
        let set = format!("elbow.u_j.x={}", row[1]);
        let values = column(&data(&[&["forces", &arm, "--set", &set], &times[..]].concat()));
        let [least, most] = [3, 5].map(|k| row[k].parse::<f64>().expect("a number"));
        assert!(
            near(least, values.iter().copied().fold(f64::INFINITY, f64::min)),
            "{row:?} of {values:?}"
        );
        assert!(
            near(most, values.iter().copied().fold(f64::NEG_INFINITY, f64::max)),
            "{row:?} of {values:?}"
        );
    }
    assert_eq!(rows.lines().count(), 3);
    let wrong =
        crate::done(&[&["sweep", &arm, &cases], &times[..], &["--keep", "elbow motr"]].concat());
    let told = words(&wrong);
    assert!(
        code(&wrong) == 2 && told.contains("`elbow motr`") && told.contains("kin forces FILE"),
        "{told}"
    );
}

/// The efforts of the elbow's motor, of a table of forces.
fn column(table: &str) -> Vec<f64> {
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<&str>>());
    let header = lines.next().expect("a header");
    let number = header.iter().position(|name| *name == "elbow motor [N m]").expect("a column");
    lines.map(|cells| cells[number].parse().expect("a number")).collect()
}
