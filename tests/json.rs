//! Mechanisms and motions as JSON: what is written reads back.

use kin::data::Registry;
use kin::data::{LawData, MechanismData, MotionData};
use kin::law::Ends;
use kin::prelude::*;
use kin::{Error, vec2};
use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::engines::Engines;

#[path = "data/engines.rs"]
mod engines;
#[path = "data/own.rs"]
mod own;

/// How a slot is bent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Bend {
    Up(f64),
    Flat,
}

impl Bend {
    fn curvature(&self) -> f64 {
        match self {
            Bend::Up(k) => *k,
            Bend::Flat => 0.0,
        }
    }
}

/// A parameter that serde knows nothing of.
#[derive(Clone)]
struct Secret(f64);

impl Secret {
    fn value(&self) -> f64 {
        self.0
    }
}

/// Pin in a parabolic slot that a law raises.      [m]
#[constraint]
fn bent_slot(i: Planar, j: Planar, u_i: Vec2, bend: Bend, rise: Law, t: Time) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - bend.curvature() * s.x * s.x - rise.at(t)
}

/// Several coordinates together.      [rad]
#[constraint]
fn mean_angle(
    q: [Coord; 2],
    weights: [f64; 2],
    pair: (f64, Vec2),
    turn: Mat2,
    whole: usize,
    law: Law,
    t: Time,
) -> f64 {
    weights[0] * q[0] + weights[1] * q[1] - law.at(t) - pair.0 * pair.1.x * turn.m12 - whole as f64
}

/// Cannot be written.      [m]
#[constraint]
fn secret_height(b: Planar, height: Secret) -> f64 {
    b.r.y - height.value()
}

/// amplitude · x³
#[law]
fn cubic(x: f64, amplitude: f64) -> f64 {
    amplitude * x.powi(3)
}

fn registry() -> Registry {
    Registry::new()
        .with::<bent_slot>()
        .with::<mean_angle>()
        .with_law("cubic", |law| Ok(cubic(law.number("amplitude")?)))
}

fn model() -> kin::Result<Mechanism> {
    let mut m = Mechanism::new("model \"in\" quotes, <with> ünicode");
    let ground = m.ground();
    let slider = m.planar("slider", pose(0.2, 0.1, 0.0))?;
    let arm = m.link("arm", 0.1 + 0.2)?;
    let a = m.angle("a", 0.1)?;
    let b = m.angle("b", 1.0 / 3.0)?;
    let plate =
        m.spatial("plate", SpatialPose::turned(vec3(0.0, 0.0, 0.5), vec3(1.0, 2.0, 3.0), 0.3))?;
    m.add(
        "slot",
        bent_slot(
            slider,
            ground,
            vec2(0.0, 0.0),
            Bend::Up(2.0),
            0.1 * (cubic(0.5) + Law::sine(0.3, 1.0, 0.2)),
        ),
    )?;
    m.add("upright", drive_angle(slider, Law::constant(0.0).compose(&Law::ramp(2.0))))?;
    m.add("motor", drive(slider.x(), Law::sine(0.3, 1.0, 0.0)))?;
    m.add("pin", revolute(slider, arm, vec2(0.0, 0.0), arm.start()))?;
    m.add("a = arm's", kin::joints::planar::coupling(a, arm.theta(), 1.0, -1.0, 0.0))?;
    m.add(
        "mean",
        mean_angle(
            [a, b],
            [1.0, 0.5],
            (2.0, vec2(0.125, 0.0)),
            Mat2::new(1.0, 0.1, -0.1, 1.0),
            1,
            Law::polynomial(&[0.1, 0.2, 1e-300]),
        ),
    )?;
    m.add("a itself", drive(a, Law::linear(0.1, 2.0)))?;
    m.add(
        "plate",
        spatial::fixed(plate, vec3(0.0, 0.0, 0.5), EulerParameters::new(1.0, 0.1, 0.2, 0.3)),
    )?;
    m.prefer(arm, 0.1);
    Ok(m)
}

#[test]
fn a_motion_comes_back_without_loss() -> kin::Result<()> {
    let system = model()?.build()?;
    comes_back(&system, &kin::SolverOptions::default())?;
    comes_back(&system, &kin::SolverOptions::new().engine(kin::Engine::Compiled))
}

fn comes_back(system: &kin::System, options: &kin::SolverOptions) -> kin::Result<()> {
    let mut motion = system.solver().options(options.clone()).run(linspace(0.0, 1.0, 37))?;
    motion.add_output("tiny", "m/s", (0..37).map(|k| 1e-310 * f64::from(k) - 0.1).collect())?;
    let text = serde_json::to_string(&motion.data()).unwrap();
    let back = kin::Motion::from_data(&serde_json::from_str::<MotionData>(&text).unwrap())?;
    assert_eq!(back.data(), motion.data());
    for k in 0..motion.len() {
        let bits = |row: &[f64]| row.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(
            (bits(back.q(k)), bits(back.qd(k)), bits(back.qdd(k))),
            (bits(motion.q(k)), bits(motion.qd(k)), bits(motion.qdd(k)))
        );
    }
    assert_eq!(
        (back.summary(), back.worst(), back.units(), back.engine()),
        (motion.summary(), motion.worst(), motion.units(), motion.engine())
    );
    let arm = back.planar_named("arm").unwrap();
    assert!(back.point(arm, vec2(0.1, 0.0))?.speed().max() > 0.1);
    assert!(back.spatial_named("plate").is_some() && back.planar_named("plate").is_none());
    Ok(())
}

#[test]
fn a_mechanism_comes_back_and_moves_the_same_to_the_last_bit() -> kin::Result<()> {
    let folder = std::env::temp_dir().join(format!("kin-data-{}", std::process::id()));
    let path = folder.join("mechanism.json");
    model()?.write_json_for(&path, &registry())?;
    let back = Mechanism::read_json(&path, &registry())?;
    std::fs::remove_dir_all(&folder).unwrap();
    assert_eq!(back.data()?, model()?.data()?);
    let one = model()?.build()?;
    let other = back.build()?;
    assert_eq!(one.parameters(), other.parameters());
    let times = linspace(0.0, 1.0, 21);
    assert_eq!(one.run_both(&times)?.data(), other.run_both(&times)?.data());
    Ok(())
}

/// The model with one thing in its text changed, read back.
fn changed(from: &str, to: &str) -> String {
    let text = serde_json::to_string(&model().unwrap().data().unwrap()).unwrap();
    assert!(text.contains(from), "{from} is not in {text}");
    match MechanismData::read(&text.replacen(from, to, 1)) {
        Ok(data) => Mechanism::from_data(&data, &registry())
            .err()
            .map(|error| error.to_string())
            .unwrap_or_default(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn mistakes_in_data_are_told_by_name() {
    for (from, to, expected) in [
        (
            r#""kind":"revolute""#,
            r#""kind":"revolut""#,
            "constraint `pin`: unknown constraint `revolut`. Did you mean `revolute`? Use one of \
             `revolute`, ",
        ),
        (
            r#"{"planar":"arm"}"#,
            r#"{"spatial":"arm"}"#,
            "constraint `pin`: no `revolute` is known with these 2 arguments, (planar body, spatial \
             body). `revolute` takes (planar body, planar body) or (spatial body, spatial body)",
        ),
        (r#"{"planar":"arm"}"#, r#"{"planar":"leg"}"#, "constraint `pin`: no planar body `leg`"),
        (
            r#""u_j":[-0"#,
            r#""u_k":[-0"#,
            "constraint `pin`: its parameter `u_j` is missing. Is it meant by `u_k`?",
        ),
        (r#""u_j":[-0"#, r#""k":1,"u_j":[-0"#, "constraint `pin`: `revolute` has no parameter `k`"),
        (
            r#""u_i":[0.0,0.0]"#,
            r#""u_i":[0.0]"#,
            "constraint `slot`: its parameter `u_i`: [0.0] is not a list of 2. ",
        ),
        (r#""kind":"cubic""#, r#""kind":"quartic""#, "unknown law `quartic`. Use one of `c"),
        (
            r#""amplitude":0.5"#,
            r#""size":0.5"#,
            "the law `cubic` lacks the number `amplitude`. Is it meant by `size`?",
        ),
        (
            r#"{"Up":2.0}"#,
            r#"{"Down":2.0}"#,
            "constraint `slot`: its parameter `bend`: it cannot be `Down`. Use one of `Up` and `Flat`",
        ),
        (r#""format":1"#, r#""format":2"#, "a newer Kin has written its format 2, but Kin "),
        (r#""format":1"#, r#""format":2,"colour":3"#, " reads format 1. Update Kin"),
        (r#""format":1"#, r#""format":0"#, "format 0 does not exist. Kin reads format 1"),
        (
            r#""guess":[0.2,0.1,0.0]"#,
            r#""guess":[0.2,0.1]"#,
            "body `slider`: it has 3 coordinates; its guess has 2",
        ),
        (
            r#""guess":[0.2,"#,
            r#""guess":[null,"#,
            "`/bodies/0/guess/0` is `null`. Write a number, or an expression of dimensions",
        ),
    ] {
        let message = changed(from, to);
        assert!(message.contains(expected), "{message}\nexpected: {expected}");
    }
    let unknown = Mechanism::from_data(&model().unwrap().data().unwrap(), &Registry::new());
    assert!(matches!(unknown, Err(Error::Data { place, .. }) if place == "constraint `slot`"));
}

/// The error for an unknown name suggests the most similar name. The error lists at most eight
/// known names, the most similar name first.
#[test]
fn unknown_names_in_data_are_told_with_the_known_ones() -> kin::Result<()> {
    let mut m = Mechanism::new("names");
    let crank = m.link("crank", 0.1)?;
    let mut rods = Vec::new();
    for k in 0..10 {
        rods.push(m.link(&format!("rod {k}"), 0.2)?);
    }
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("A", revolute(crank, rods[0], crank.end(), rods[0].start()))?;
    m.add("hold", coupling(rods[1].theta(), rods[2].theta(), 1.0, -1.0, 0.0))?;
    m.add("motor", drive_angle(crank, Law::ramp(1.0)))?;
    m.spatial("cube", SpatialPose::at(vec3(0.0, 0.0, 0.0)))?;
    let told = |change: &dyn Fn(&mut serde_json::Value)| -> String {
        let mut file = serde_json::to_value(m.data().expect("data")).expect("JSON");
        change(&mut file);
        let data = MechanismData::read(&file.to_string());
        let read = data.and_then(|data| Mechanism::from_data(&data, &Registry::new()));
        read.err().map(|error| error.to_string()).unwrap_or_default()
    };
    let argument = |constraint: usize, argument: serde_json::Value| {
        told(&move |file| file["constraints"][constraint]["arguments"][1] = argument.clone())
    };
    assert_eq!(
        argument(0, json!({ "planar": "carnk" })),
        "constraint `O`: no planar body `carnk`. Did you mean `crank`? Use one of `crank`, `rod 0`, \
         `rod 1`, `rod 2`, `rod 3`, `rod 4`, `rod 5`, `rod 6` and 3 more"
    );
    assert_eq!(
        argument(0, json!({ "planar": "cube" })),
        "constraint `O`: no planar body `cube`: `cube` is a spatial body, as an argument {\"spatial\": \
         \"cube\"}"
    );
    assert_eq!(
        argument(0, json!({ "planar": "ground" })),
        "constraint `O`: no planar body `ground`. The ground is null: {\"planar\": null}"
    );
    let told_coordinate = argument(2, json!({ "coord": "crank.tehta" }));
    let expected = "constraint `hold`: no coordinate `crank.tehta`. Did you mean `crank.theta`? Use \
                    one of `crank.theta`, `crank.R_x`, ";
    assert!(told_coordinate.starts_with(expected), "{told_coordinate}");
    let kind = told(&|file| file["constraints"][3]["kind"] = json!("drive_angel"));
    let expected = "constraint `motor`: unknown constraint `drive_angel`. Did you mean \
                    `drive_angle`? Use one of `drive_angle`, ";
    assert!(kind.starts_with(expected) && kind.contains(" more, or add a "), "{kind}");
    assert_eq!(kind.matches('`').count(), 2 * (1 + 1 + 1 + 8 + 1), "{kind}");
    let parameter = told(&|file| file["constraints"][0]["parameters"]["u_k"] = json!(1.0));
    let expected =
        "constraint `O`: `revolute` has no parameter `u_k`. Use one of `u_i` and `u_j`".to_string();
    assert_eq!(parameter, expected);
    let law = told(&|file| file["constraints"][3]["parameters"]["law"]["kind"] = json!("rampe"));
    assert!(law.contains("unknown law `rampe`. Did you mean `ramp`? Use one of `ramp`, "), "{law}");
    let load = json!([{ "name": "push", "parts": [{ "on_body": { "body": "cranc" } }] }]);
    let load = told(&|file| file["loads"] = load.clone());
    assert!(load.starts_with("load `push`: no body `cranc`. Did you mean `crank`? Use "), "{load}");
    let mut sized = Mechanism::new("dimensions");
    sized.dimension("crank", 0.1)?;
    sized.dimension("rod", 0.3)?;
    let expression = sized.expression("2 * crnk").map(|_| ()).map_err(|error| error.to_string());
    let expected = "dimensions: the expression `2 * crnk`: there is no dimension `crnk`. Did you \
                    mean `crank`? Use one of `crank` and `rod`";
    assert_eq!(expression, Err(expected.to_string()));
    Ok(())
}

/// A body cannot take the name of the ground: the error says how to use the ground.
#[test]
fn a_body_named_ground_is_refused_with_the_cure() {
    let expected = "a body cannot have the name `ground`: every mechanism has the ground already. Use \
                    `Ground` in joints, or choose another name for a body that moves";
    let mut m = Mechanism::new("ground");
    let told = |error: Error| error.to_string();
    assert_eq!(m.link("ground", 0.1).map(|_| ()).map_err(told), Err(expected.to_string()));
    let pose = SpatialPose::at(vec3(0.0, 0.0, 0.0));
    assert!(matches!(m.spatial("ground", pose), Err(Error::DuplicateName { .. })));
    assert!(m.angle("ground", 0.1).is_ok(), "a coordinate is no body");
    let file = json!({ "name": "ground", "constraints": [],
        "bodies": [{ "name": "ground", "kind": "planar", "guess": [0, 0, 0] }] });
    let data = MechanismData::read(&file.to_string()).expect("data");
    let read = Mechanism::from_data(&data, &Registry::new()).map(|_| ()).map_err(told);
    assert_eq!(read, Err(expected.to_string()));
}

/// The error for a mistake in the text of a file has line, column and path, the key, the known keys
/// and the cure, in Kin's words and not in those of serde.
#[test]
fn a_slip_in_the_text_of_a_file_names_its_place_and_the_cure() {
    let text = "{ \"name\": \"arm\",\n  \"bodies\": [\n    { \"name\": \"crank\", \"kind\": \"planar\", \
                \"guess\": [0, 0, 0] } ],\n  \"constraints\": [\n    { \"name\": \"motor\", \"kind\": \
                \"drive_angle\",\n      \"arguments\": [{ \"planar\": \"crank\" }],\n      \"parameters\": {} } ] }";
    assert!(MechanismData::read(text).is_ok());
    let slips = [
        (
            "\"guess\"",
            "\"gues\"",
            "line 3, column 42: `/bodies/0` has the unknown key `gues`. Did you mean `guess`? Use one of `guess`, `name`, \
             `kind`, `preferred`, `length`, `between` and `facing`",
        ),
        (
            ", \"kind\": \"planar\"",
            "",
            "line 3, column 5: `/bodies/0` lacks the key `kind`. Add it",
        ),
        (
            "\"planar\": \"crank\"",
            "\"planer\": \"crank\"",
            "line 6, column 21: `/constraints/0/arguments/0` cannot be `planer`. Did you mean `planar`? \
             Use one of `planar`, `spatial`, `coord`, `ground_coord` and `spatial_ground_coord`",
        ),
        (
            "{ \"planar\": \"crank\" }",
            "\"crank\"",
            "`/constraints/0/arguments/0` cannot be `crank`. Use one of `planar`, ",
        ),
        (
            "{ \"planar\": \"crank\" }",
            "3",
            "line 6, column 21: `/constraints/0/arguments/0` is the number 3. Write a known word in \
             quotes, or an object with one known key",
        ),
        (
            "[0, 0, 0]",
            "[0, true, 0]",
            "line 3, column 55: `/bodies/0/guess/1` is `true`. Write a number, or an expression of dimensions",
        ),
        ("[0, 0, 0]", "0", "`/bodies/0/guess` is the number 0. Write a list in [ ]"),
        ("{} }", "[] }", "`/constraints/0/parameters` is a list. Write an object in { }"),
        ("\"arm\"", "7", "line 1, column 11: `/name` is the number 7. Write a text in quotes"),
        (
            "0] } ],",
            "0], } ],",
            "line 3, column 62: in `/bodies/0` a comma has nothing behind it. Remove the comma",
        ),
        (
            "{} } ] }",
            "{} }",
            "line 7, column 24: in `/constraints` the text ends inside a list. Close",
        ),
        ("\"arm\",", "\"arm\"", "an object goes on without a comma, or has no end. Add `,` or `}`"),
        (
            "[0, 0",
            "[0 0",
            "in `/bodies/0/guess` a list goes on without a comma, or has no end. Add",
        ),
        ("\"arm\"", "'arm'", "column 11: a text has single quotes. Write it in double quotes"),
        ("[0, 0", "[NaN, 0", "in `/bodies/0/guess` JSON has no `NaN`. Write a number, or leave"),
        ("[0, 0", "[.5, 0", "`.5` is no number of JSON. Write it like 0.5, -2 or 1e-3"),
        ("\"bodies\": [", "// bodies\n \"bodies\": [", "JSON has no comments"),
        ("\"name\": \"arm\"", "name: \"arm\"", "a key has no quotes. Write \"key\": value"),
        ("} ] }", "} ] } }", "the text goes on after its last `}`. Remove what follows"),
    ];
    let mut failed = String::new();
    for (from, to, told) in slips {
        assert!(text.contains(from), "{from}");
        let slip = match from {
            "{} } ] }" | "} ] }" => {
                let at = text.rfind(from).unwrap_or_default();
                format!("{}{to}", &text[..at])
            }
            _ => text.replacen(from, to, 1),
        };
        let error = MechanismData::read(&slip).expect_err(told).to_string();
        if !error.contains(told) {
            failed += &format!("{error}\nexpected: {told}\n");
        }
        for word in ["field", "variant", "EOF", "invalid", "expected", " at line", "struct", "map"]
        {
            assert!(!error.contains(word), "{error}: {word}");
        }
    }
    assert!(failed.is_empty(), "{failed}");
    let empty = MechanismData::read(" \n").expect_err("empty").to_string();
    assert!(empty.contains("the file is empty"), "{empty}");
    let along = json!([{ "name": "push", "parts": [{ "along": { "x": { "measure": "A.slide", "arguments": [] },
        "force": { "kind": "gas" } } }] }]);
    let end = text.rfind(" }").unwrap_or_default();
    let loads = format!("{}, \"loads\": {along} }}", &text[..end]);
    let error = MechanismData::read(&loads).expect_err("two forms").to_string();
    let expected =
        "`/loads/0/parts/0/along/x`: with `measure` there is no key `arguments`. Remove one";
    assert!(error.contains(expected), "{error}");
}

/// Files of the first days, without equations and dimensions, give the motion of those of today.
/// A number or a part that a law does not have is told, and not left out.
#[test]
fn numbers_that_a_law_does_not_have_are_told_by_name() {
    let law = |text: &str| {
        let data: kin::data::LawData = serde_json::from_str(text).expect("reads");
        kin::data::Registry::new().law(&data).map(|law| law.at(1.0))
    };
    assert_eq!(law(r#"{"kind": "ramp", "numbers": {"rate": 2}}"#), Ok(2.0));
    for (text, told) in [
        (
            r#"{"kind": "ramp", "numbers": {"rate": 2, "f0": 0.5}}"#,
            "the law `ramp` has no number `f0`; it has `rate`",
        ),
        (
            r#"{"kind": "ramp", "numbers": {"rate": 2}, "parts": {"base": {"kind": "ramp", "numbers": {"rate": 1}}}}"#,
            "the law `ramp` has no part `base`",
        ),
        (
            r#"{"kind": "polynomial", "numbers": {"c[0]": 1, "c[2]": 1}}"#,
            "the law `polynomial` has no number `c[2]`",
        ),
        (
            r#"{"kind": "spline", "numbers": {"x[0]": 0, "y[0]": 0, "x[1]": 1, "y[1]": 0, "x[2]": 2}}"#,
            "the law `spline` has 3 numbers `x` and 2 numbers `y`",
        ),
    ] {
        let error = law(text).expect_err("refused");
        assert!(error.contains(told), "{error}");
    }
}

/// Of a key that stands twice one value would be lost without a word, at whatever depth.
#[test]
fn a_key_twice_in_a_file_is_an_error_that_names_it() {
    for (from, twice, told) in [
        (r#""u_i":[0.0,0.0]"#, r#""u_i":[5.0,5.0]"#, "the key `u_i` appears twice"),
        (
            r#""Up":2.0"#,
            r#""Up":3.0"#,
            "the key `Up` appears twice in `constraints[0].parameters.bend`",
        ),
        (r#""rate":2.0"#, r#""rate":3.0"#, "parameters.law.parts.inner.numbers`"),
        (r#""kind":"cubic""#, r#""kind":"ramp""#, "parameters.rise.parts.law.parts."),
        (r#""name":"slider""#, r#""name":"other""#, "the key `name` appears twice in `bodies[0]`"),
        (r#""format":1"#, r#""format":1"#, "the key `format` appears twice. Remove "),
    ] {
        let message = changed(from, &format!("{from},{twice}"));
        assert!(message.contains(told) && message.contains("line 1, column "), "{message}: {told}");
    }
    let law: Result<LawData, _> =
        serde_json::from_str(r#"{"kind": "ramp", "numbers": {"rate": 2, "rate": 3}}"#);
    assert!(law.is_err_and(|error| error.to_string().contains("the key `rate` appears twice")));
    let motion = model().and_then(|m| m.build()?.run_both([0.0])).expect("a motion");
    let text = serde_json::to_string(&motion.data()).expect("data");
    let twice = text.replacen(r#""times":"#, r#""times":[1.0],"times":"#, 1);
    assert!(
        MotionData::read(&twice)
            .is_err_and(|error| error.to_string().contains("the key `times` appears twice"))
    );
    let load = r#"{"name": "l", "parts": [{"on_body": {"body": "arm", "force": [{"numbers": {"c": 1, "c": 2}}, {}, {}]}}]}"#;
    let load: Result<kin::data::LoadData, _> = serde_json::from_str(load);
    assert!(
        load.is_err_and(|error| error
            .to_string()
            .contains("the key `c` appears twice in `numbers`"))
    );
    let friction: Result<kin::data::FrictionData, _> = serde_json::from_str(
        r#"{"joint": "O", "coefficient": 0.1, "rate": 1, "pin": {"radius": 1}, "pin": {"radius": 2}}"#,
    );
    assert!(friction.is_err(), "{friction:?}");
}

#[test]
fn the_first_files_are_still_read() -> kin::Result<()> {
    let registry = Registry::new().with::<own::slider_crank>().with::<own::parabolic_slot>();
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let mut count = 0;
    for entry in std::fs::read_dir(folder.join("first_files")).unwrap() {
        let path = entry.unwrap().path();
        let run = |path: &std::path::Path| -> kin::Result<kin::data::MotionData> {
            Ok(Mechanism::read_json(path, &registry)?
                .build()?
                .run_both(linspace(0.0, 0.5, 26))?
                .data())
        };
        let today = folder.join("examples").join(path.file_name().unwrap());
        assert_eq!(run(&path)?, run(&today)?, "{}", path.display());
        count += 1;
    }
    assert_eq!(count, 5);
    Ok(())
}

#[test]
fn a_motion_of_a_newer_format_is_told() -> kin::Result<()> {
    let text = serde_json::to_string(&model()?.build()?.run_both([0.0])?.data()).unwrap();
    let read = |text: &str| MotionData::read(text).and_then(|data| kin::Motion::from_data(&data));
    assert!(read(&text).is_ok());
    let newer = text.replacen(r#""format":1"#, r#""format":7"#, 1);
    for text in [newer.replacen(r#""times":"#, r#""instants":"#, 1), newer] {
        let error = read(&text).unwrap_err().to_string();
        assert!(error.contains("a newer Kin has written its format 7"), "{error}");
    }
    Ok(())
}

#[test]
fn what_cannot_be_written_is_told_by_name() -> kin::Result<()> {
    let mut m = Mechanism::new("secret");
    let b = m.planar("b", pose(0.0, 0.0, 0.0))?;
    m.add("height", secret_height(b, Secret(1.0)))?;
    let message = m.data().unwrap_err().to_string();
    assert!(
        message.starts_with(
            "constraint `height`: its parameter `height` is of the type `json::Secret`"
        ),
        "{message}"
    );
    Ok(())
}

#[test]
fn spoiled_files_are_errors_and_not_panics() -> kin::Result<()> {
    let system = model()?.build()?;
    let text = serde_json::to_string(&system.run_both([0.0, 0.5])?.data()).unwrap();
    for cut in (0..text.len()).filter(|cut| text.is_char_boundary(*cut)) {
        assert!(serde_json::from_str::<MotionData>(&text[..cut]).is_err());
    }
    let data: MotionData = serde_json::from_str(&text).unwrap();
    let spoilt = |spoil: fn(&mut MotionData)| {
        let mut copy = data.clone();
        spoil(&mut copy);
        kin::Motion::from_data(&copy).unwrap_err().to_string()
    };
    assert!(spoilt(|data| data.times.push(2.0)).contains("q needs 3 rows of 15 numbers"));
    assert!(spoilt(|data| data.q[1].clear()).contains("q needs 2 rows"));
    assert!(spoilt(|data| data.qd[1][0] = f64::NAN).contains("NaN is among its numbers"));
    assert!(spoilt(|data| data.worst = Some(99)).contains("none of the equations"));
    assert!(spoilt(|data| data.bodies[0].0.clear()).contains("name"));
    assert!(spoilt(|data| data.iterations.clear()).contains("iterations"));
    Ok(())
}

#[test]
fn laws_come_back_as_they_are() {
    let table: Vec<(f64, f64)> =
        (0..9).map(|k| 0.25 * f64::from(k)).map(|x| (x, (3.0 * x).sin())).collect();
    let ring: Vec<(f64, f64)> =
        (0..=8).map(|k| (f64::from(k) / 8.0 * TAU, f64::from(k % 8) * 0.1)).collect();
    let rises = [
        Law::harmonic_rise,
        Law::cycloidal,
        Law::polynomial_345,
        Law::polynomial_4567,
        Law::modified_sine,
        Law::modified_trapezoid,
    ];
    let mut all = vec![
        (2.0 * (Law::harmonic(0.3, 0.05) + Law::ramp(1.0)) - 0.5 * Law::sine(1.0, 2.0, 0.0))
            .shifted(0.25),
        Law::constant(0.1) * Law::linear(0.2, 3.0) + Law::polynomial(&[1.0, 0.0, 1.0 / 3.0]),
        Law::fourier(0.1, 2.0, &[(1.0, 0.5), (0.0, -0.25)]),
        Law::trapezoidal(2.0, 1.0, 3.0),
        Law::s_curve(2.0, 1.0, 3.0, 10.0),
        Law::spline(&table, Ends::Natural),
        Law::spline(&table, Ends::Clamped { start: 3.0, end: -1.0 }),
        Law::spline(&ring, Ends::Periodic),
        Law::polynomial(&[0.0; 0]),
    ];
    all.extend(rises.map(|rise| rise(0.3, 1.5)));
    all.push(Law::sequence(
        0.1,
        [
            (1.5, Law::cycloidal(0.3, 1.5)),
            (0.5, Law::constant(0.3)),
            (1.0, Law::constant(0.3) - Law::cycloidal(0.3, 1.0)),
        ],
    ));
    all.push(all[all.len() - 1].periodic(3.0));
    for law in all {
        let data = LawData::of(&law);
        let back = Registry::new()
            .law(&serde_json::from_str(&serde_json::to_string(&data).unwrap()).unwrap())
            .unwrap();
        assert_eq!(LawData::of(&back), data);
        for x in [-1.0, 0.0, 0.7, 1.9, 7.0] {
            assert_eq!(law.jet(x), back.jet(x), "{law:?} at {x}");
        }
    }
}

/// A number where a law belongs: the message shows how a law is written.
#[test]
fn a_number_is_no_law() {
    let mut m = Mechanism::new("crank");
    let crank = m.link("crank", 1.0).unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(6.25))).unwrap();
    let mut text = serde_json::to_value(m.data().unwrap()).unwrap();
    text["constraints"][0]["parameters"]["law"] = serde_json::json!(6.25);
    let data: MechanismData = serde_json::from_value(text).unwrap();
    let error = Mechanism::from_data(&data, &Registry::new()).err().expect("no law").to_string();
    assert!(error.contains("6.25 is not a law. Write an object"), "{error}");
    assert!(!error.contains("struct"), "{error}");
}
