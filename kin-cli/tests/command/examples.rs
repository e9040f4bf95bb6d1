//! Mechanism files of the examples: the command writes what a program writes, bit for bit.

use std::f64::consts::TAU;

use kin::data::Registry;
use kin::{Follow, Mechanism, Motion, SolverOptions, linspace};

use crate::own;
use crate::{SLOT, data, example, place};

/// Examples of the library's constraints with the times, and the change points at which they turn.
pub(crate) const EXAMPLES: [(&str, [f64; 2], usize, &[usize]); 24] = [
    ("02_two_link_manipulator", [0.0, 24.0], 2401, &[]),
    ("04_four_bar", [0.0, 1.0], 361, &[]),
    ("05_quick_return", [0.0, 1.0], 721, &[]),
    ("06_scotch_yoke", [0.0, 2.0], 721, &[]),
    ("07_cam_follower", [0.0, 2.0], 961, &[]),
    ("08_peaucellier", [0.0, 2.0], 801, &[]),
    ("09_jansen_leg", [0.0, 1.0], 721, &[]),
    ("10_drawn_path", [0.0, 6.0], 1001, &[]),
    ("11_epicyclic_gears", [0.0, 8.0], 1601, &[]),
    ("12_hookes_joint", [0.0, 4.0], 1201, &[]),
    ("13_stewart_platform", [0.0, 8.0], 401, &[]),
    ("14_sweep_four_bars", [0.0, TAU], 361, &[]),
    ("15_windscreen_wiper", [0.0, 1.0], 361, &[]),
    ("16_change_points", [0.0, 2.0], 241, &[0, 2]),
    ("17_double_wishbone", [0.0, 8.0], 201, &[]),
    ("18_excavator", [0.0, 12.0], 301, &[]),
    ("19_delta_robot", [0.0, 2.0], 201, &[]),
    ("21_cam_with_roller", [0.0, 2.0], 961, &[]),
    ("22_planetary_train", [0.0, 8.0], 401, &[]),
    ("23_press_tolerance", [0.0, 1.0], 361, &[]),
    ("24_toe_tolerance", [0.0, 4.0], 201, &[]),
    ("25_arm_torque", [0.0, 4.0], 401, &[]),
    ("26_engine", [0.0, 40.0], 361, &[]),
    ("27_digging", [0.0, 9.0], 301, &[]),
];

/// Examples with constraints of the program's own, whose equations stand in the file.
pub(crate) const OWN: [(&str, [f64; 2], usize); 3] = [
    ("01_slider_crank", [0.0, 1.0], 361),
    ("03_custom_constraint", [0.0, 1.0], 1001),
    ("20_geneva_drive", [0.0, 6.0], 1201),
];

/// All numbers of a table.
fn numbers(table: &str) -> Vec<Vec<f64>> {
    let row = |row: &str| row.split(',').map(|x| x.parse().expect("a number")).collect();
    table.lines().skip(1).map(row).collect()
}

#[test]
fn own_equations_as_text_are_the_compiled_ones() {
    let registry = Registry::new()
        .with::<own::slider_crank>()
        .with::<own::parabolic_slot>()
        .with::<own::geneva>();
    for (name, [from, to], count) in OWN {
        let mechanism = Mechanism::read_json(example(name), &registry).expect("reads");
        let options = SolverOptions::new().engine(kin::Engine::StepByStep);
        let times = linspace(from, to, count);
        let motion = mechanism
            .build()
            .expect("builds")
            .solver()
            .options(options.clone())
            .run(times)
            .expect("runs");
        let compiled = numbers(&String::from_utf8(written(&motion, name)).expect("text"));
        let times = format!("{from}:{to}:{count}");
        let asked = ["--times", &times, "--engine", "step-by-step", "--csv", "-"];
        let read = numbers(&data(&[&["run", &example(name)][..], &asked].concat()));
        assert_eq!(read.len(), count);
        let columns = compiled[0].len();
        for column in 0..columns {
            let size = compiled.iter().fold(1.0_f64, |size, row| size.max(row[column].abs()));
            let apart = read.iter().zip(&compiled).map(|(a, b)| (a[column] - b[column]).abs());
            let worst = apart.fold(0.0, f64::max);
            assert!(worst <= 1e-13 * size, "{name}, column {column}: {worst:e} of {size:e}");
        }
    }
}

/// The table that a program writes.
fn written(motion: &Motion, name: &str) -> Vec<u8> {
    let path = place(&format!("{name}.csv"));
    motion.write_csv(&path).expect("written");
    std::fs::read(path).expect("readable")
}

#[test]
fn file_to_command_to_csv_is_the_program_bit_for_bit() {
    for (name, [from, to], count, turning) in EXAMPLES {
        let mechanism = Mechanism::read_json(example(name), &Registry::new()).expect("reads");
        let mut options = SolverOptions::default();
        if !turning.is_empty() {
            options.follow = Follow::OtherBranchAt(turning.to_vec());
        }
        let system = mechanism.build().expect("builds");
        let motion =
            system.solver().options(options.clone()).run(linspace(from, to, count)).expect("runs");
        let times = format!("{from}:{to}:{count}");
        let turns: Vec<String> = turning.iter().map(usize::to_string).collect();
        let turns = format!("--other-branch-at={}", turns.join(","));
        let file = example(name);
        let mut arguments = vec!["run", &file, "--times", &times, "--csv", "-"];
        if !turning.is_empty() {
            arguments.push(&turns);
        }
        assert_eq!(data(&arguments).into_bytes(), written(&motion, name), "{name}");
    }
}

#[test]
fn points_measures_and_the_jerk_are_those_of_a_program() {
    let mechanism = Mechanism::read_json(example("04_four_bar"), &Registry::new()).expect("reads");
    let system = mechanism.build().expect("builds");
    let options = SolverOptions::new().jerk(true);
    let mut motion =
        system.solver().options(options.clone()).run(linspace(0.0, 1.0, 31)).expect("runs");
    let coupler = motion.planar_named("coupler").expect("a body");
    motion.add_point("P", coupler, kin::vec2(0.2, 1.4)).expect("a point");
    let angle = system.measure(&motion, "A.angle").expect("a measure");
    for (series, mark) in [(&angle.value, ""), (&angle.rate, "'"), (&angle.second_rate, "''")] {
        let values = series.values().to_vec();
        motion.add_output(&format!("A.angle{mark}"), series.unit(), values).expect("an output");
    }
    let file = example("04_four_bar");
    let asked =
        ["--times", "0:1:31", "--jerk", "--point", "P=coupler:0.2,1.4", "--measure", "A.angle"];
    let found = data(&[&["run", &file, "--csv", "-"][..], &asked].concat());
    assert_eq!(found.into_bytes(), written(&motion, "points"));
}

#[test]
fn a_motion_as_json_comes_back_without_loss() {
    let path = place("motion.json").to_string_lossy().into_owned();
    data(&["run", &example("04_four_bar"), "--times", "0:1:31", "--json", &path]);
    let mechanism = Mechanism::read_json(example("04_four_bar"), &Registry::new()).expect("reads");
    let motion = mechanism.build().expect("builds").run(linspace(0.0, 1.0, 31)).expect("runs");
    assert_eq!(Motion::read_json(path).expect("reads").data(), motion.data());
}

#[test]
fn a_file_that_stands_alone_runs() {
    let file = crate::file("slot.json", SLOT);
    let table = data(&["run", &file, "--times", "0:6:601", "--set", "slot.k=2.5", "--csv", "-"]);
    let mut rows = table.lines();
    assert!(
        rows.next().is_some_and(|header| header.starts_with("t [s],slider.R_x [m],slider.R_y [m]"))
    );
    assert_eq!(rows.clone().count(), 601);
    for row in rows {
        let numbers: Vec<f64> = row.split(',').map(|x| x.parse().expect("a number")).collect();
        let x = 0.3 * numbers[0].sin();
        assert!(
            (numbers[1] - x).abs() < 1e-13 && (numbers[2] - 2.5 * x * x).abs() < 1e-13,
            "{row}"
        );
    }
}

#[test]
fn pictures_and_pages_are_written() {
    let places =
        ["four_bar.svg", "page/index.html"].map(|name| place(name).to_string_lossy().into_owned());
    let [svg, page] = &places;
    let point = ["--point", "P=coupler:0.2,1.4"];
    let files = ["--svg", svg, "--page", page];
    data(&[&["run", &example("04_four_bar"), "--times", "0:1:61"][..], &point, &files].concat());
    let [svg, page] =
        places.each_ref().map(|path| std::fs::read_to_string(path).expect("readable"));
    assert!(svg.starts_with("<svg") && svg.contains("animate"), "{}", &svg[..200]);
    assert!(page.starts_with("<!doctype html>") && page.contains("four-bar"), "{}", &page[..200]);
}
