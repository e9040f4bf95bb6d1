//! The tables that the example programs have written, beside those that the command writes of their
//! files.

use std::path::Path;

use crate::{data, example};

/// Bit for bit, or within 1e-13 of the largest number of the column: of equations as text.
#[derive(PartialEq)]
enum Alike {
    Bits,
    Nearly,
}
use Alike::{Bits, Nearly};

/// An example, what it asks for beside its times, and the beginnings of the names of what it has
/// computed or placed by formulas of its own.
type Example = (&'static str, Alike, &'static [&'static str], &'static [&'static str]);

const EXAMPLES: [Example; 26] = [
    ("01_slider_crank", Nearly, &[], &["theta3 by elimination", "x by elimination", "slider."]),
    ("02_two_link_manipulator", Bits, &["end effector=link 3:0.175,0"], &[]),
    ("03_custom_constraint", Nearly, &["pin=arm:0.06,0"], &["pin off the slot"]),
    ("04_four_bar", Bits, &["A=crank:0.5,0", "P=coupler:0.2,1.4"], &[]),
    ("05_quick_return", Bits, &["E=ram:0,0", "D=lever:0.31267281278741377,0"], &[]),
    ("06_scotch_yoke", Bits, &["A=crank:0.05,0", "yoke=yoke:0.3,0"], &[]),
    ("07_cam_follower", Bits, &["tip=follower:0,0"], &[]),
    ("08_peaucellier", Bits, &["D=AD:0.10000000000000006,0", "C=crank:0.085,0"], &[]),
    ("09_jansen_leg", Bits, &["X=crank:0.0075,0"], &["foot."]),
    ("10_drawn_path", Bits, &["pen=forearm:0.25,0", "elbow=upper arm:0.3,0"], &["elbow angle"]),
    ("11_epicyclic_gears", Bits, &["edge=planet 1:0.06,0"], &[]),
    (
        "12_hookes_joint",
        Bits,
        &["A=first shaft:0.2,0,0", "tip=middle shaft:-0.2,0,0.06"],
        &["first shaft [", "middle shaft [", "last shaft ["],
    ),
    ("13_stewart_platform", Bits, &["centre=plate:0,0,0"], &["head.", "tilt"]),
    ("15_windscreen_wiper", Bits, &["--jerk", "tip=arm:0.45,0"], &["transmission angle"]),
    ("16_change_points", Bits, &["--other-branch-at=0,2", "A=crank:0.5,0", "B=rocker:0.5,0"], &[]),
    (
        "17_double_wishbone",
        Bits,
        &["left hub=left upright:0,780,320"],
        &["left camber", "left toe", "right "],
    ),
    ("18_excavator", Bits, &["edge=bucket:1.35,-0.25"], &[]),
    ("19_delta_robot", Bits, &["tool=plate:0,0,0"], &["motor 1", "motor 2", "motor 3"]),
    ("20_geneva_drive", Nearly, &["pin=driver:40,0"], &[]),
    ("21_cam_with_roller", Bits, &["roller=lever:47.5,0"], &["pressure angle"]),
    ("22_planetary_train", Bits, &["mark=planet 1:14.7,0"], &[]),
    ("23_press_tolerance", Bits, &["wrist=ram:0,0"], &[]),
    ("24_toe_tolerance", Bits, &["hub=upright:0,780,320"], &["toe"]),
    ("25_arm_torque", Bits, &["tool=forearm:0.175,0"], &[]),
    ("26_engine", Bits, &["piston pin=piston:0,0"], &["shaking "]),
    ("27_digging", Bits, &["edge=bucket:1.35,-0.25"], &[]),
];

/// A table by its columns: header and cells.
fn columns(table: &str) -> Vec<(String, Vec<String>)> {
    let mut rows = table.lines().map(|row| row.split(',').map(str::to_owned).collect::<Vec<_>>());
    let header = rows.next().expect("a header");
    let mut all: Vec<(String, Vec<String>)> =
        header.into_iter().map(|name| (name, Vec::new())).collect();
    for row in rows {
        assert_eq!(row.len(), all.len());
        all.iter_mut().zip(row).for_each(|((_, column), cell)| column.push(cell));
    }
    all
}

fn is_like(alike: &Alike, ours: &[String], theirs: &[String]) -> bool {
    if *alike == Bits {
        return ours == theirs;
    }
    let [ours, theirs] = [ours, theirs].map(|all| {
        all.iter().map(|cell| cell.parse::<f64>().expect("a number")).collect::<Vec<f64>>()
    });
    let size = theirs.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    ours.len() == theirs.len()
        && ours.iter().zip(&theirs).all(|(a, b)| (a - b).abs() <= 1e-13 * size)
}

/// After `cargo run --release --example gallery`, as `.ci/run` has it; doctests write beside it.
/// The table of `14_sweep_four_bars` is of another four-bar than its file, found by the sweep.
#[test]
#[ignore = "the examples have to be run before"]
fn tables_of_the_example_programs_are_the_commands() {
    let out = Path::new(env!("CARGO_MANIFEST_DIR")).join("../out");
    let mut names: Vec<String> = std::fs::read_dir(&out)
        .expect("the examples have been run")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .filter(|name| name.starts_with(|c: char| c.is_ascii_digit()) && !name.starts_with("14_"))
        .collect();
    names.sort();
    assert_eq!(names, EXAMPLES.map(|(name, ..)| name));
    for (name, alike, asked, computed) in &EXAMPLES {
        let table = std::fs::read_to_string(out.join(name).join("motion.csv")).expect("readable");
        let mut theirs = columns(&table);
        let t = &theirs[0].1;
        let times = format!("{}:{}:{}", t[0], t[t.len() - 1], t.len());
        let file = example(name);
        let mut arguments = vec!["run", &file, "--times", &times, "--csv", "-"];
        for one in *asked {
            arguments.extend((!one.starts_with("--")).then_some("--point"));
            arguments.push(one);
        }
        let ours = columns(&data(&arguments));
        for (header, cells) in &ours {
            let at = theirs.iter().position(|(known, _)| known == header);
            let (_, wanted) =
                theirs.remove(at.unwrap_or_else(|| panic!("{name}: no column {header}")));
            assert!(is_like(alike, cells, &wanted), "{name}: {header}");
        }
        let is_computed = |header: &str| computed.iter().any(|begin| header.starts_with(begin));
        let rest: Vec<&String> = theirs.iter().map(|(header, _)| header).collect();
        assert!(rest.iter().all(|header| is_computed(header)), "{name}: {rest:?}");
    }
}
