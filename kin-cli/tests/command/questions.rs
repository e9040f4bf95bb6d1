//! Questions: assemblies, measures, proofs, sensitivities, diagnoses, names.

use serde_json::Value;

use crate::{code, data, done, example, words};

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
fn a_list_of_assemblies_says_whether_it_is_complete() {
    let arguments =
        ["assemblies", &example("04_four_bar"), "--at", "0.1", "--csv", "/dev/null", "--json", "-"];
    let told = words(&done(&arguments));
    assert!(told.contains("2 assemblies found") && told.contains("complete: believed ("), "{told}");
    let json: Value = serde_json::from_str(&data(&arguments)).expect("JSON");
    assert_eq!(json["complete"], "believed");
    assert_eq!(json["assemblies"].as_array().map(Vec::len), Some(2));
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
    assert!(
        told.contains("rocker.theta: from 1.77") && told.contains("to 2.467462146922"),
        "{told}"
    );
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
        let at = [std::f64::consts::TAU, 4.0][column];
        let h = 1e-5;
        let more = value(at + h);
        let less = value(at - h);
        for (k, row) in by.iter().enumerate() {
            let difference = (more[k][1] - less[k][1]) / (2.0 * h);
            assert!(
                (row[column + 1] - difference).abs() < 1e-6,
                "{name}: {} {difference}",
                row[column + 1]
            );
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
    assert_eq!(
        kinds.into_iter().collect::<Vec<_>>(),
        [("coordinate", 9), ("measure", 4), ("parameter", 17)]
    );
}

/// An arm that turns at a constant rate under its weight: the motor holds m g l cos θ.
#[test]
fn forces_of_an_arm_are_those_of_its_weight() {
    use kin::prelude::*;
    let mut m = Mechanism::new("arm");
    let arm = m.link("arm", 0.5).expect("a link");
    m.add("O", revolute(m.ground(), arm, vec2(0.0, 0.0), arm.start())).expect("a joint");
    m.add("motor", drive_angle(arm, Law::ramp(2.0))).expect("a driver");
    m.mass(arm, 3.0, vec2(0.0, 0.0), 0.1).expect("a mass");
    m.gravity(vec2(0.0, -9.81));
    let file =
        crate::file("arm.json", &serde_json::to_string(&m.data().expect("data")).expect("JSON"));
    let arguments = ["forces", &file, "--times", "0:3:31"];
    let table = data(&arguments);
    let header: Vec<&str> = table.lines().next().expect("a header").split(',').collect();
    let column = |name: &str| header.iter().position(|known| *known == name).expect(name);
    let effort = column("motor [N m]");
    let up = column("O on arm.F_y [N]");
    for row in numbers(&table) {
        let theta = 2.0 * row[0];
        let radius = 0.25;
        let exact = 3.0 * 9.81 * radius * theta.cos();
        assert!((row[effort] - exact).abs() < 1e-11, "{} {exact}", row[effort]);
        let exact = 3.0 * (9.81 - 4.0 * radius * theta.sin());
        assert!((row[up] - exact).abs() < 1e-11, "{} {exact}", row[up]);
    }
    let told = words(&done(&arguments));
    assert!(
        told.contains("motor: at most 7.3575 N m at 0 s, ") && told.contains("power balance"),
        "{told}"
    );
    // √(1/3 ∫ cos² 2t dt) over 3 s, but for the trapezia.
    let rms = 7.3575 * ((1.5 + 12.0_f64.sin() / 8.0) / 3.0_f64).sqrt();
    let found =
        told.split("0 s, ").nth(1).and_then(|rest| rest.split(' ').next()).expect("a number");
    assert!((found.parse::<f64>().expect("a number") / rms - 1.0).abs() < 1e-3, "{found} {rms}");
    let table = std::env::temp_dir().join(format!("kin-forces-{}.csv", std::process::id()));
    let table = table.to_str().expect("a path");
    let whole = data(&["forces", &file, "--times", "0:3:31", "--csv", table, "--json", "-"]);
    let whole: kin::data::ForcesData = serde_json::from_str(&whole).expect("forces");
    std::fs::remove_file(table).expect("a table");
    let motor = whole.columns.iter().find(|column| column.name == "motor").expect("a column");
    assert!(
        (motor.values[0] - 7.3575).abs() < 1e-11 && motor.unit == "N m" && whole.left_over < 1e-12
    );
    let drawn = |what: &str, kind: &str| {
        let to = std::env::temp_dir().join(format!("kin-forces-{}.{kind}", std::process::id()));
        let to = to.to_str().expect("a path");
        data(&["forces", &file, "--times", "0:3:31", what, to]);
        let text = std::fs::read_to_string(to).expect("a picture");
        std::fs::remove_file(to).expect("a picture");
        text
    };
    // The motor gives most at the beginning, so that time is drawn, with the scale that arrows are
    // read by.
    let svg = drawn("--svg", "svg");
    assert!(
        svg.contains("<title>O on arm</title>")
            && svg.contains("t = 0 s")
            && svg.contains(" N</text>")
    );
    assert!(drawn("--chart", "chart.svg").contains("effort [N m]"));
    let page = drawn("--page", "html");
    assert!(page.contains("motor on arm") && page.contains("forces in joints"));
    let output = done(&["forces", &example("04_four_bar"), "--times", "0:1:3"]);
    assert!(
        code(&output) == 1 && words(&output).contains("no body of the mechanism has mass"),
        "{}",
        words(&output)
    );
    assert!(
        words(&output).contains("under `masses` and `loads` in the file"),
        "{}",
        words(&output)
    );
}

/// A slider-crank that is pulled by its slider to its dead centre, with a torque on its crank.
#[test]
fn forces_that_grow_without_bound_are_told_and_so_is_what_a_drive_gains() {
    use kin::prelude::*;
    let mut m = Mechanism::new("pump");
    let crank = m.link("crank", 1.0).expect("a link");
    let rod = m.link("rod", 2.5).expect("a link");
    let piston = m.planar("piston", pose(2.4, 0.0, 0.0)).expect("a body");
    let zero = vec2(0.0, 0.0);
    m.add("O", revolute(crank, Ground, crank.start(), zero)).expect("a pin");
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).expect("a pin");
    m.add("B", revolute(rod, piston, rod.end(), zero)).expect("a pin");
    m.add("guide", prismatic(piston, Ground, zero, zero, vec2(0.0, 1.0), 0.0)).expect("a guide");
    m.add("push", drive(piston.x(), Law::linear(2.4, 0.4))).expect("a driver");
    m.prefer(crank, deg(60.0));
    m.load("brake", kin::Load::torque(crank, 3.0)).expect("a load");
    let file =
        crate::file("pump.json", &serde_json::to_string(&m.data().expect("data")).expect("JSON"));
    let output = done(&["forces", &file, "--times", "0:5:51"]);
    let told = words(&output);
    let expected =
        "the forces of `push` grow without bound towards t* = 2.75 s, like |t − t*|^(−1/2)";
    assert!(
        code(&output) == 3
            && told.contains(expected)
            && !told.contains("the forces of `guide` grow"),
        "{told}"
    );
    // The push for the torque 3 is 3 over the advantage of the crank's turn.
    let forces = numbers(&String::from_utf8(output.stdout).expect("CSV"));
    let table = done(&["measure", &file, "crank.theta", "--over", "push", "--times", "0:2.7:28"]);
    let table = String::from_utf8(table.stdout).expect("CSV");
    assert!(table.starts_with("t [s],crank.theta [rad],crank.theta' [rad/s],crank.theta'' [rad/s^2],push.advantage on crank.theta [m]"), "{table}");
    for (row, forces) in numbers(&table).iter().zip(&forces) {
        assert!((row[4] * forces[1] / -3.0 - 1.0).abs() < 1e-10, "{row:?} {}", forces[1]);
    }
}

/// A damper by the square of the rate, beside a spring.      [N m]
#[kin::force]
fn closer(x: Coord, rate: Rate, stiffness: f64, rest: f64, damping: f64) -> f64 {
    -stiffness * (x - rest) - damping * rate * rate.abs()
}

/// A force of the user's own goes into the file as text, and the command reads it: the motor of a
/// door holds against a closer that it has never seen.
#[test]
fn a_force_of_ones_own_is_read_from_the_text_in_the_file() {
    use kin::prelude::*;
    let mut m = Mechanism::new("door");
    let door = m.link("door", 1.0).expect("a link");
    m.add("hinge", revolute(door, Ground, door.start(), vec2(0.0, 0.0))).expect("a joint");
    m.add("hand", drive_angle(door, Law::sine(0.8, 2.0, 0.0))).expect("a driver");
    let turn = drive_angle(door, Law::constant(0.0));
    m.load("closer", closer(turn, 7.0, -0.2, 3.0)).expect("a load");
    let text = serde_json::to_string(&m.data().expect("data")).expect("JSON");
    assert!(text.contains("fn closer("), "{text}");
    let file = crate::file("door.json", &text);
    for row in numbers(&data(&["forces", &file, "--times", "0:3:31"])) {
        let x = 0.8 * (2.0 * row[0]).sin();
        let rate = 1.6 * (2.0 * row[0]).cos();
        let held = 7.0 * (x + 0.2) + 3.0 * rate * rate.abs();
        assert!((row[1] - held).abs() < 1e-12, "{} {held}", row[1]);
    }
    let spoiled = crate::file("spoiled.json", &text.replace("rate.abs()", "rate.abz()"));
    let output = done(&["forces", &spoiled, "--times", "0:3:31"]);
    assert!(code(&output) != 0 && words(&output).contains("no method `abz`"), "{}", words(&output));
}

/// The reach of an arm is off by half of what its length is off: its frame is in the middle.
#[test]
fn tolerances_of_an_arm_are_those_of_its_length() {
    use kin::prelude::*;
    let mut m = Mechanism::new("arm");
    let reach = m.dimension("reach", 0.5).expect("a dimension").tolerance(0.001).unit("m");
    let arm = m.link("arm", reach).expect("a link");
    m.add("O", revolute(arm, Ground, arm.start(), (0.0, 0.0))).expect("a joint");
    m.add("motor", drive_angle(arm, Law::linear(-1.0, 1.0))).expect("a driver");
    let file =
        crate::file("reach.json", &serde_json::to_string(&m.data().expect("data")).expect("JSON"));
    let arguments = ["tolerance", &file, "arm.R_x", "--times", "0:3:31", "--of", "max"];
    let table = data(&arguments);
    let row: Vec<&str> = table.lines().nth(1).expect("a row").split(',').collect();
    assert_eq!(row[0], "reach");
    let numbers: Vec<f64> = row[1..].iter().map(|x| x.parse().expect("a number")).collect();
    for (found, exact) in numbers.iter().zip([0.001, 0.5, 0.0005, 1.0, 1.0]) {
        assert!((found - exact).abs() < 1e-12, "{found} {exact}");
    }
    let told = words(&done(&arguments));
    assert!(told.contains("arm.R_x (0.25 m at 1 s): ± 0.0005 worst case, ± 0.0005 RSS."), "{told}");
    let told = words(&done(&[&arguments[..], &["--proved"]].concat()));
    assert!(
        told.contains("worst case (proved: 0.0005") && told.contains("arm.R_x: proved from 0.249"),
        "{told}"
    );
    let stroke = ["tolerance", &file, "arm.R_x", "--times", "0:3:31", "--of", "stroke"];
    let told = words(&done(&stroke));
    assert!(told.contains("stroke of arm.R_x (0.35404 m): ± 0.000708 worst case"), "{told}"); // 0.25 (1 − cos 2)
    let samples = ["--samples", "3000", "--seed", "5", "--distribution", "uniform"];
    let told = words(&done(&[&arguments[..], &samples[..]].concat()));
    assert!(told.contains("arm.R_x (m), 3000 samples of seed 5: mean 0.2"), "{told}");
    assert!(told.contains("All samples can be assembled."), "{told}");
    let out = format!("{file}.csv");
    done(&[&arguments[..], &samples[..], &["--samples-csv", &out]].concat());
    let table = std::fs::read_to_string(&out).expect("a file");
    let values: Vec<f64> = table.lines().skip(1).map(|x| x.parse().expect("a number")).collect();
    assert_eq!(values.len(), 3000);
    let within = |x: &f64| (x - 0.25).abs() < 0.0005;
    assert!(values.is_sorted() && values.iter().all(within) && values[2999] - values[0] > 0.00099);
    let names = data(&["check", &file, "--names"]);
    assert!(names.lines().any(|line| line == "dimension,reach,0.5"), "{names}");
    let output = done(&["tolerance", &example("04_four_bar"), "rocker.theta", "--times", "0:1:3"]);
    assert!(
        words(&output).contains("no dimension that changes the motion has a tolerance"),
        "{}",
        words(&output)
    );
}

/// A door of three hinges that are off by some nanometres: the advice names the flag, and with it
/// the door turns.
#[test]
fn closure_is_allowed_by_a_flag() {
    use kin::prelude::*;

    let z = vec3(0.0, 0.0, 1.0);
    let mut m = Mechanism::new("door");
    let door = m.spatial("door", SpatialPose::at(vec3(0.0, 0.0, 0.0))).expect("a body");
    for (k, off) in [0.0, 5e-9, -4e-9].into_iter().enumerate() {
        let at = z * (0.8 * k as f64);
        let beside = at + vec3(off, 0.5 * off, 0.0);
        let hinge = spatial::revolute(door, m.ground(), at, beside, z, z);
        m.add(&format!("hinge {k}"), hinge).expect("a hinge");
    }
    let motor = kin::joints::drivers::spatial::drive_turn(door, m.ground(), z, z, Law::ramp(1.0));
    m.add("motor", motor).expect("a motor");
    let text = serde_json::to_string(&m.data().expect("data")).expect("JSON");
    let file = crate::file("door.json", &text);
    let refused = done(&["run", &file, "--times", "0:1:11"]);
    let said = words(&refused);
    let flag = said.split("`--allowed-misfit ").nth(1).and_then(|rest| rest.split('`').next());
    let flag = flag.unwrap_or_else(|| panic!("{said}"));
    assert!(code(&refused) != 0 && !said.contains("SolverOptions::"), "{said}");
    data(&["run", &file, "--times", "0:1:11", "--allowed-misfit", flag, "--csv", "-"]);
    data(&["check", &file, "--allowed-misfit", flag]);
}

/// A pose by the value of a driver is that of a run at the time at which the driver has this value.
#[test]
fn a_pose_is_found_by_the_value_of_its_driver() {
    let m = example("04_four_bar");
    let json: Value = serde_json::from_str(&data(&[
        "pose",
        &m,
        "--to",
        "motor=2.5",
        "--csv",
        "/dev/null",
        "--json",
        "-",
    ]))
    .expect("JSON");
    assert_eq!(json["drivers"]["motor"], 2.5);
    let angle = json["coordinates"]["rocker.theta"].as_f64().expect("a number");
    let start: Value = serde_json::from_str(&data(&[
        "pose",
        &m,
        "--to",
        "motor=0",
        "--csv",
        "/dev/null",
        "--json",
        "-",
    ]))
    .expect("JSON");
    let rate = std::f64::consts::TAU;
    let t = format!("0,{}", 2.5 / rate);
    let table = data(&["measure", &m, "rocker.theta", "--times", &t]);
    let rows = numbers(&table);
    assert!((rows[1][1] - angle).abs() < 1e-9, "{rows:?} {angle}");
    assert!(
        (rows[0][1] - start["coordinates"]["rocker.theta"].as_f64().expect("a number")).abs()
            < 1e-9
    );
    let table = data(&["pose", &m, "--to", "motor=2.5"]);
    assert!(
        table.starts_with("what,name,value,unit\ndriver,motor,2.5000000000000000e0,rad\n"),
        "{table}"
    );
    assert!(table.contains("measure,O.angle,"), "{table}");
}

#[test]
fn a_move_to_a_pose_is_proved() {
    let m = example("04_four_bar");
    let told = done(&["pose", &m, "--to", "motor=0.3", "--prove", "30", "--csv", "/dev/null"]);
    assert_eq!(code(&told), 0, "{}", words(&told));
    assert!(words(&told).contains("30"), "{}", words(&told));
    let coarse = done(&["pose", &m, "--to", "motor=40", "--prove", "1", "--csv", "/dev/null"]);
    assert_eq!(code(&coarse), 4, "{}", words(&coarse));
}

#[test]
fn a_pose_with_a_wrong_driver_names_the_known_ones() {
    let m = example("04_four_bar");
    let output = done(&["pose", &m, "--to", "crank=1"]);
    let told = words(&output);
    assert_eq!(code(&output), 2);
    assert!(told.contains("there is no driver `crank`") && told.contains("`motor`"), "{told}");
}

/// A point of a mechanism with its motor released is dragged; what cannot be met is said.
#[test]
fn a_point_is_dragged_with_the_motor_released() {
    let m = example("04_four_bar");
    let output = done(&[
        "drag",
        &m,
        "--point",
        "coupler:0.5,0.5=1.0,2.0",
        "--json",
        "-",
        "--csv",
        "/dev/null",
    ]);
    assert_eq!(code(&output), 0);
    let said = words(&output);
    assert!(said.contains("`coupler (0.5, 0.5)` is missed by"), "{said}");
    let json: Value = serde_json::from_str(&String::from_utf8_lossy(&output.stdout)).expect("JSON");
    assert_eq!(json["wishes"][0]["met"], false);
    assert_eq!(json["freedoms"].as_array().map(Vec::len), Some(0));
    let table = data(&["drag", &m, "--wish", "rocker.theta=1.9"]);
    let row = table.lines().find_map(|line| line.strip_prefix("coordinate,rocker.theta,"));
    let angle: f64 = row.and_then(|row| row.split(',').next()?.parse().ok()).expect("a number");
    assert!((angle - 1.9).abs() < 1e-9, "{table}");
    let refused = done(&["drag", &m]);
    assert_eq!(code(&refused), 2);
    assert!(words(&refused).contains("`crank.theta`"), "{}", words(&refused));
    let unknown = done(&["drag", &m, "--point", "couple:0,0=1,1"]);
    assert_eq!(code(&unknown), 2);
    assert!(words(&unknown).contains("`coupler`"), "{}", words(&unknown));
}

/// A coordinate is given in place of the driver, and the way leads back.
#[test]
fn a_pose_and_a_map_are_found_by_other_given_values() {
    let m = example("04_four_bar");
    let json = |of: &[&str]| -> Value {
        let all: Vec<&str> =
            of.iter().copied().chain(["--csv", "/dev/null", "--json", "-"]).collect();
        serde_json::from_str(&data(&all)).expect("JSON")
    };
    let number = |of: &Value| of.as_f64().expect("a number");
    let forward = json(&["pose", &m, "--to", "motor=0.9"]);
    let rocker = number(&forward["coordinates"]["rocker.theta"]);
    let given = format!("rocker.theta={rocker:?}");
    let back = json(&["pose", &m, "--given", &given]);
    assert_eq!(number(&back["given"]["rocker.theta"]), rocker);
    let motor = number(&back["drivers"]["motor"]);
    let map = json(&["map", &m, "--given", &given, "--wanted", "motor"]);
    assert_eq!(number(&map["wanted"]["motor"]), motor);
    let slope = number(&map["jacobian"]["motor"]["rocker.theta"]);
    let there = format!("motor={motor:?}");
    let other = json(&["map", &m, "--given", &there, "--wanted", "rocker.theta"]);
    assert!((number(&other["wanted"]["rocker.theta"]) - rocker).abs() < 1e-11, "{other}");
    assert!((number(&other["jacobian"]["rocker.theta"]["motor"]) * slope - 1.0).abs() < 1e-9);
    let table = data(&["map", &m, "--given", "motor", "--wanted", "O.angle"]);
    assert!(table.starts_with("name,value,unit,by motor [rad]\nO.angle,0"), "{table}");
    let border = data(&[
        "map",
        &m,
        "--given",
        "motor",
        "--wanted",
        "rocker.theta",
        "--csv",
        "/dev/null",
        "--range",
        "motor=-0.2:0.3",
        "--points",
        "6",
        "--border",
        "-",
    ]);
    let rows = numbers(&border);
    assert_eq!((rows.len(), rows[0][0], rows[5][0]), (6, -0.2, 0.3));
    let wrong = done(&["pose", &m, "--given", "crank.theta=1", "--given", "rocker.theta=1"]);
    let told = words(&wrong);
    assert_eq!(code(&wrong), 2, "{told}");
    assert!(told.contains("has 1 freedom") && told.contains("`rocker.theta`"), "{told}");
}

/// A press begins at its dead centre, in the stated direction; without one the command asks for it.
#[test]
fn a_run_leaves_a_dead_centre_in_the_stated_direction() {
    use kin::prelude::*;
    let mut m = Mechanism::new("press");
    let crank = m.link("crank", 1.0).expect("a link");
    let rod = m.link("rod", 2.0).expect("a link");
    let slider = m.planar("slider", pose(2.9, 0.0, 0.0)).expect("a body");
    let zero = vec2(0.0, 0.0);
    let guide = prismatic(slider, Ground, zero, zero, vec2(0.0, 1.0), 0.0);
    let law = Law::polynomial(&[3.0, 0.0, -0.5]);
    m.add("O", revolute(Ground, crank, zero, crank.start())).expect("adds");
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).expect("adds");
    m.add("B", revolute(rod, slider, rod.end(), zero)).expect("adds");
    m.add("guide", guide).expect("adds");
    m.add("cylinder", drive(slider.x(), law)).expect("adds");
    let file =
        crate::file("press.json", &serde_json::to_string(&m.data().expect("data")).expect("JSON"));
    let run = ["measure", &file, "crank.theta", "--times", "0:1:11"];
    let table = data(&[&run[..], &["--start", "crank=-1"]].concat());
    let last = numbers(&table)[10][1];
    assert!((last + (3.25_f64 / 5.0).acos()).abs() < 1e-11, "{last}");
    let told = words(&done(&run));
    assert!(told.contains("a dead centre of `cylinder`") && told.contains("`--start "), "{told}");
}

#[test]
fn a_mechanism_is_printed_as_c() {
    let m = example("04_four_bar");
    let text = data(&["emit", &m, "--c", "--name", "bar", "--measures", "rocker.theta"]);
    assert!(text.contains("int bar_to(bar_state *s, const double u[]);"), "{text}");
    assert!(text.contains("m[0] = q[8]; /* rocker.theta */"), "{text}");
    let output = done(&["emit", &m, "--c", "--free", "crank"]);
    let told = words(&output);
    assert_eq!(code(&output), 2);
    assert!(told.contains("there is no dimension `crank`"), "{told}");
}

/// The circuit of a crank that turns round: the rocker swings, the motor never turns back.
#[test]
fn a_circuit_is_written_by_arc_length() {
    let m = example("04_four_bar");
    let table = data(&["circuit", &m, "--input", "motor", "--points", "91"]);
    assert!(table.starts_with("s,motor [rad],crank.R_x [m],"), "{table}");
    let rows = numbers(&table);
    assert_eq!(rows.len(), 91);
    assert!((rows[90][1] - rows[0][1] - std::f64::consts::TAU).abs() < 1e-7, "{:?}", rows[90]);
    let told = words(&done(&["circuit", &m, "--input", "motor", "--csv", "/dev/null"]));
    assert!(told.contains("a closed circuit of the driver `motor`"), "{told}");
}
