//! Every class of errors that the library has: the command line that leads there, its exit code,
//! its words.

use std::collections::BTreeSet;

use kin::Load;
use kin::loads::Friction;
use kin::prelude::*;
use serde_json::{Value, json};

use crate::{SLOT, code, done, example, file, four_bar, words};

/// A class of errors, the exit code that it has, words of its sentence, and the command line.
type Line = (&'static str, i32, &'static str, Vec<String>);

/// Classes that no command line leads to: a program has bodies and motions of two mechanisms,
/// numbers that are none, tables and files of its own, stops its runs, compares routes to
/// derivatives.
const OF_PROGRAMS: [&str; 10] = [
    "ForeignBody",
    "InitialNotFinite",
    "ParameterNotFinite",
    "CaseNotFinite",
    "WrongLength",
    "OtherMotion",
    "Stopped",
    "Mismatch",
    "Table",
    "File",
];

/// The names of all classes, as the library's sources list them: the errors, and the kinds of a
/// failure of a run.
fn classes() -> BTreeSet<String> {
    let mut all = listed("mod.rs", "pub enum Error {");
    assert!(all.remove("Run"), "the failures of a run");
    all.extend(listed("failure.rs", "pub enum FailureKind {"));
    all
}

fn listed(file: &str, head: &str) -> BTreeSet<String> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../kin-core/src/outcome/error/");
    let source = std::fs::read_to_string(format!("{folder}{file}")).expect("readable");
    let (_, list) = source.split_once(head).expect("the list");
    let (list, _) = list.split_once("\n}\n").expect("the end of the list");
    let name = |line: &str| {
        let name = line.strip_prefix("    ").filter(|line| line.starts_with(char::is_uppercase))?;
        name.split([' ', '(', '{', ',']).next().map(str::to_owned)
    };
    list.lines().filter_map(name).collect()
}

fn asked(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| (*word).to_owned()).collect()
}

/// `kin run` of a file with this content.
fn run(name: &str, content: &Value, times: &str) -> Vec<String> {
    asked(&[
        "run",
        &file(&format!("class_{name}.json"), &content.to_string()),
        "--times",
        times,
        "--csv",
        "-",
    ])
}

/// The four-bar with something changed.
fn changed(change: impl Fn(&mut Value)) -> Value {
    let mut data = four_bar();
    change(&mut data);
    data
}

/// A mechanism as data.
fn written(make: impl Fn(&mut Mechanism) -> kin::Result<()>) -> Value {
    let mut m = Mechanism::new("made for a mistake");
    make(&mut m).expect("a mechanism");
    serde_json::to_value(m.data().expect("data")).expect("JSON")
}

/// A block that slides along a law.
fn driven(law: &Law) -> Value {
    written(|m| {
        let x = m.length("x", 0.0)?;
        m.add("motor", drive(x, law.clone())).map(drop)
    })
}

/// A door whose hinge asks for the opposite of the axis about which it is turned.
fn door() -> Value {
    written(|m| {
        let body = m.spatial("door", SpatialPose::at(vec3(0.0, 0.0, 0.0)))?;
        let o = vec3(0.0, 0.0, 0.0);
        let z = vec3(0.0, 0.0, 1.0);
        m.add("hinge", spatial::revolute(body, Ground, o, o, z, -z))?;
        m.add("motor", spatial::drive_turn(body, Ground, z, z, Law::ramp(1.0))).map(drop)
    })
}

/// A drawer that is pushed so far beside its guide that it jams.
fn drawer() -> Value {
    written(|m| {
        let o = vec2(0.0, 0.0);
        let block = m.planar("block", pose(0.3, 0.0, 0.0))?;
        let hand = m.planar("hand", pose(-0.2, -0.4, 0.0))?;
        m.add("guide", prismatic(block, Ground, o, o, vec2(0.0, 1.0), 0.0))?;
        m.friction("guide", Friction::slide(0.8, [0.1, 0.0], 1e-6))?;
        m.add("rod", distance(hand, block, o, vec2(-0.3, 0.0), 0.5))?;
        m.add("hand.x", drive(hand.x(), Law::linear(-0.2, 0.1)))?;
        m.add("hand.y", drive(hand.y(), Law::constant(-0.4)))?;
        m.add("hand.theta", drive(hand.theta(), Law::constant(0.0)))?;
        m.load("work", Load::force(block, o, vec2(-50.0, 0.0)))
    })
}

/// An arm with a mass that hangs in the same pin twice, which rubs.
fn pinned_twice() -> Value {
    written(|m| {
        let arm = m.link("arm", 1.0)?;
        m.add("O", revolute(Ground, arm, vec2(0.0, 0.0), arm.start()))?;
        m.add("O again", revolute(Ground, arm, vec2(0.0, 0.0), arm.start()))?;
        m.add("motor", drive_angle(arm, Law::ramp(1.0)))?;
        m.mass(arm, 1.0, vec2(0.0, 0.0), 0.1)?;
        m.gravity(vec2(0.0, -9.81));
        m.friction("O", Friction::pin(0.1, 0.05, 1e-6))
    })
}

/// An arm whose length has a tolerance.
fn reach() -> Value {
    written(|m| {
        let reach = m.dimension("reach", 0.5)?.tolerance(0.001).unit("m");
        let arm = m.link("arm", reach)?;
        m.add("O", revolute(arm, Ground, arm.start(), (0.0, 0.0)))?;
        m.add("motor", drive_angle(arm, Law::linear(-1.0, 1.0))).map(drop)
    })
}

/// A parallelogram with a mass, which passes through its change point.
fn weighed() -> Value {
    let text = std::fs::read_to_string(example("16_change_points")).expect("readable");
    let mut data: Value = serde_json::from_str(&text).expect("JSON");
    let centre = [0.0; 3];
    let inertia = [[0.0; 3], [0.0; 3], [0.0, 0.0, 0.1]];
    data["masses"] =
        json!([{ "body": "rocker", "mass": 1.0, "centre": centre, "inertia": inertia }]);
    data["gravity"] = json!([0.0, -9.81, 0.0]);
    data
}

/// Errors of what a file says.
fn of_files() -> Vec<Line> {
    let slot = |from: &str, to: &str| -> Value {
        assert!(SLOT.contains(from));
        serde_json::from_str(&SLOT.replace(from, to)).expect("JSON")
    };
    let (bodies, constraints) = ("bodies", "constraints");
    let twice = changed(|data| data[constraints][1]["name"] = json!("O"));
    let nameless = changed(|data| data[bodies][0]["name"] = json!(""));
    let lengthless = changed(|data| data[bodies][0]["length"] = json!(0.0));
    let same = changed(|data| data[constraints][1]["arguments"][1] = json!({ "planar": "crank" }));
    let nothing = changed(|data| data[constraints][0]["arguments"][1] = json!({ "planar": null }));
    let unused = changed(|data| data["dimensions"] = json!([{ "name": "reach", "value": 1.0 }]));
    let huge = changed(|data| {
        data["dimensions"] = json!([{ "name": "reach", "value": 1e200 }]);
        data[constraints][0]["parameters"]["u_i"][0] = json!("reach * reach");
    });
    let unmet = slot("[\"fn", "[\"#[require(k < 1.0, \\\"a slot this flat\\\")]\\nfn");
    let undefined = slot("s.y - k * s.x * s.x", "s.y - (s.x - k).sqrt()");
    vec![
        ("DuplicateName", 1, "two constraints have the name `O`", run("twice", &twice, "0")),
        ("EmptyName", 1, "a body", run("nameless", &nameless, "0")),
        ("InvalidLength", 1, "above zero", run("lengthless", &lengthless, "0")),
        ("RepeatedBody", 1, "`crank`", run("same", &same, "0")),
        ("NoCoordinates", 1, "depends on no coordinate", run("nothing", &nothing, "0")),
        ("Dimension", 1, "`reach`", run("unused", &unused, "0")),
        (
            "Data",
            5,
            "`reach * reach` is inf. Give numbers that make it finite",
            run("huge", &huge, "0"),
        ),
        ("InvalidParameters", 1, "a slot this flat", run("unmet", &unmet, "0")),
        ("NotFinite", 1, "is not finite", run("undefined", &undefined, "0")),
        ("Data", 5, "cannot be read as a mechanism", run("none", &json!({ "name": 3 }), "0")),
    ]
}

/// Errors of a motion.
fn of_motions() -> Vec<Line> {
    let m = &example("04_four_bar");
    let change_points = &example("16_change_points");
    let mut free = four_bar();
    free["constraints"].as_array_mut().expect("a list").retain(|one| one["name"] != "motor");
    let corner = Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, -1.0))]);
    vec![
        ("CannotBeDriven", 1, "Nothing drives", run("free", &free, "0:1:3")),
        (
            "NoConvergence",
            1,
            "cannot be assembled at t = 0 s",
            asked(&["check", m, "--set", "C.u_i.x=20"]),
        ),
        (
            "SingularAt",
            1,
            "rank 8 here",
            asked(&["check", change_points, "--set", "motor.law.f0=0"]),
        ),
        (
            "Toggle",
            3,
            "no position exists beyond the toggle",
            asked(&["run", m, "--times", "0:1:101", "--set", "C.u_i.x=6"]),
        ),
        (
            "CannotReach",
            3,
            "the follower stops at `motor` = 2.0236",
            asked(&["pose", m, "--to", "motor=6", "--set", "C.u_i.x=6"]),
        ),
        ("CannotFollow", 3, "Give closer times", asked(&["run", m, "--times", "0,1e9"])),
        ("WrongBranch", 1, "is assembled the wrong way round", run("door", &door(), "0:1:3")),
        (
            "LawJumps",
            3,
            "the slope of the law changes suddenly",
            run("corner", &driven(&corner), "0.1:1.9:10"),
        ),
        (
            "CannotBeProved",
            4,
            "Kin cannot prove",
            asked(&[
                "prove",
                &file("class_proof.json", &pinned_twice().to_string()),
                "--times",
                "0:1:3",
            ]),
        ),
    ]
}

/// Errors of what is asked.
fn of_questions() -> Vec<Line> {
    let m = &example("04_four_bar");
    let made =
        |name: &str, content: &Value| file(&format!("class_{name}.json"), &content.to_string());
    let measured = SLOT.replace(
        "\"equations\":[\"fn",
        "\"equations\":[\"#[measure(root = (j.local(i.point(u_i)).x - 1.0).sqrt(), \\\"m\\\")]\\nfn",
    );
    let measured = file("class_measured.json", &measured);
    let samples = asked(&["--times", "0:1:3", "--of", "max", "--samples", "0"]);
    vec![
        ("UnknownName", 2, "there is no", asked(&["check", m, "--set", "O.u_k.x=1"])),
        (
            "InvalidConstraint",
            2,
            "`A.slide`",
            asked(&["measure", m, "A.slide", "--times", "0:1:3"]),
        ),
        ("InvalidTimes", 2, "times: ", asked(&["run", m, "--times", "0,1,0.5"])),
        (
            "InvalidOptions",
            2,
            "options: ",
            [&asked(&["tolerance", &made("reach", &reach()), "arm.R_x"])[..], &samples].concat(),
        ),
        (
            "InvalidLength",
            2,
            "above zero",
            asked(&["check", &made("length", &reach()), "--set", "reach=-1"]),
        ),
        (
            "CannotEmit",
            2,
            "more equations than coordinates",
            asked(&["emit", &made("printed", &pinned_twice()), "--c"]),
        ),
        ("NeedsMemory", 2, "GB", asked(&["run", m, "--times", "0:1:6000000"])),
        (
            "OutputNotFinite",
            1,
            "slot.root",
            asked(&["measure", &measured, "slot.root", "--times", "0:1:3"]),
        ),
        (
            "NoDerivative",
            2,
            "O.u_k.x",
            asked(&["sensitivities", m, "--times", "0:1:3", "--by", "O.u_k.x"]),
        ),
        (
            "NotUnique",
            1,
            "not unique",
            asked(&["forces", &made("shared", &pinned_twice()), "--times", "0:1:3"]),
        ),
        (
            "Jammed",
            1,
            "already requires infinite",
            asked(&["forces", &made("drawer", &drawer()), "--times", "0:1:3"]),
        ),
        (
            "Unbounded",
            1,
            "grow",
            asked(&["forces", &made("weighed", &weighed()), "--times", "0:2:7"]),
        ),
    ]
}

#[test]
fn every_class_of_errors_has_its_exit_code_and_words() {
    let all = [of_files(), of_motions(), of_questions()].concat();
    let known: BTreeSet<String> =
        all.iter().map(|(class, ..)| *class).chain(OF_PROGRAMS).map(str::to_owned).collect();
    assert_eq!(known, classes());
    let mut wrong = Vec::new();
    for (class, wanted, told, arguments) in all {
        let all: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let output = done(&all);
        let is_silent = output.stdout.is_empty() || wanted == 3;
        if code(&output) != wanted || !words(&output).contains(told) || !is_silent {
            wrong.push(format!("{class}: {} {}", code(&output), words(&output)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
