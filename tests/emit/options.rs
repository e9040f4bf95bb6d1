//! Free dimensions, measures, laws of time, and verdicts.

use kin::Error;
use kin::emit::{self, Options};
use kin::extend::LawFunction;
use kin::law::Ends;
use kin::prelude::*;

use crate::programs::{compiled, there_is_a_compiler};

/// A four-bar with named lengths: crank, coupler, rocker and base.
fn four_bar(lengths: [f64; 4], law: Law) -> kin::Result<System> {
    let mut m = Mechanism::new("four bar");
    let [a, b, c, d] = lengths;
    let a = m.dimension("crank", a)?.unit("m");
    let b = m.dimension("coupler", b)?.unit("m");
    let c = m.dimension("rocker", c)?.unit("m");
    let d = m.dimension("base", d)?.unit("m");
    let crank = m.link("crank", a)?;
    let coupler = m.link("coupler", b)?;
    let rocker = m.link("rocker", c)?;
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
    m.add("C", revolute(Ground, rocker, (d, 0.0), rocker.start()))?;
    m.add("motor", drive_angle(crank, law))?;
    m.prefer(rocker, deg(100.0));
    m.build()
}

fn turning() -> kin::Result<System> {
    four_bar([1.0, 3.5, 3.0, 4.0], Law::sine(0.7, 3.0, 0.4))
}

/// Returns the largest difference.
fn off(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

#[test]
fn a_file_with_free_dimensions_is_assembled_with_others() -> kin::Result<()> {
    let mut system = turning()?;
    let free = ["crank", "base"].map(str::to_string).to_vec();
    let text = emit::c(&system, &Options { free, ..Options::default() })?;
    assert!(text.contains("double crank; /* crank [m] */"), "{text}");
    assert!(text.contains("coupler [m]  3.5"), "{text}");
    if !there_is_a_compiler() {
        return Ok(());
    }
    let program = compiled("free", &text, &["-DCHANGE=d.crank=1.1,d.base=3.9"]).expect("compiles");
    assert_eq!(program.selftest(), "0");
    system.set("crank", 1.1)?;
    system.set("base", 3.9)?;
    let mut follower = system.follower(0.0)?;
    let start = follower.drivers()[0].value;
    let lines: Vec<Vec<f64>> =
        (1..40).map(|k| vec![start + 0.03 * f64::from(k), 0.7, -0.2]).collect();
    let found = program.run(&[], &lines);
    for (line, found) in lines.iter().zip(&found) {
        let q = follower.to([("motor", line[0])])?.q().to_vec();
        let rates = follower.rates([("motor", [line[1], line[2]])])?;
        let expected = [vec![0.0], q, rates.qd, rates.qdd].concat();
        assert!(off(found, &expected) < 1e-12, "{found:?} {expected:?}");
    }
    assert_eq!(found.len(), lines.len());
    Ok(())
}

#[test]
fn a_file_follows_the_laws_of_time() -> kin::Result<()> {
    let system = turning()?;
    let text = emit::c(&system, &Options::default())?;
    assert!(text.contains("int four_bar_at(four_bar_state *s, double t);"));
    if !there_is_a_compiler() {
        return Ok(());
    }
    let program = compiled("time", &text, &[]).expect("compiles");
    let times = linspace(0.0, 2.0, 101);
    let lines: Vec<Vec<f64>> = times.iter().map(|t| vec![*t]).collect();
    let motion = system.run(&times)?;
    for (k, found) in program.run(&["time"], &lines).iter().enumerate() {
        let expected = [&[0.0], motion.q(k), motion.qd(k), motion.qdd(k)].concat();
        assert!(off(found, &expected) < 1e-11, "{k}: {found:?} {expected:?}");
    }
    Ok(())
}

#[test]
fn a_file_stops_short_of_a_toggle() -> kin::Result<()> {
    let system = four_bar([3.0, 2.5, 2.0, 4.0], Law::linear(0.5, 1.0))?;
    let mut follower = system.follower(0.0)?;
    let toggle = match follower.to([("motor", 3.0)]) {
        Err(Error::CannotReach(stop)) => stop.reached[0].value,
        other => panic!("{other:?}"),
    };
    let text = emit::c(&system, &Options::default())?;
    if !there_is_a_compiler() {
        return Ok(());
    }
    let program = compiled("toggle", &text, &[]).expect("compiles");
    assert_eq!(program.selftest(), "0");
    let found = program.run(&[], &[vec![3.0, 0.0, 0.0]]);
    let column = system.coordinate_names().iter().position(|name| name == "crank.theta");
    let angle = found[0][1 + column.expect("the crank")];
    assert!(found[0][0] != 0.0, "{found:?}");
    assert!(angle <= toggle && angle > toggle - 0.01, "{angle} {toggle}");
    Ok(())
}

#[test]
fn measures_are_coordinates_by_name() -> kin::Result<()> {
    let system = turning()?;
    let with = |name: &str| {
        let measures = vec![name.to_string()];
        emit::c(&system, &Options { measures, ..Options::default() })
    };
    assert!(with("rocker.theta")?.contains("m[0] = q[8]; /* rocker.theta */"));
    assert!(matches!(with("rocker.thta"), Err(Error::UnknownName { .. })));
    assert_eq!(
        with("C.angle").map_err(|error| error.to_string()),
        Err("Kin cannot print `C.angle` as C: Kin knows no formula of the measure. Name a \
             coordinate, such as `rocker.theta`"
            .to_string())
    );
    let free = |names: &[&str]| {
        let free = names.iter().map(|name| name.to_string()).collect();
        emit::c(&system, &Options { free, ..Options::default() })
    };
    for name in ["crnk", "O.u_i.x", "crank.theta"] {
        assert!(matches!(free(&[name]), Err(Error::UnknownName { what: "dimension", .. })));
    }
    assert_eq!(
        free(&["crank", "crank"]).map_err(|error| error.to_string()),
        Err("options: the free dimensions name `crank` twice. Remove one of the two".to_string())
    );
    Ok(())
}

/// A law that is neither a formula nor a table.
struct Own;

impl LawFunction for Own {
    fn jet(&self, x: f64) -> [f64; 4] {
        [x.sin(), x.cos(), -x.sin(), -x.cos()]
    }
}

#[test]
fn a_law_of_the_program_is_refused_by_name() -> kin::Result<()> {
    let mut m = Mechanism::new("cam");
    let cam = m.link("cam", 0.1)?;
    let rod = m.planar("rod", pose(0.0, 0.5, 0.0))?;
    m.add("O", revolute(Ground, cam, vec2(0.0, 0.0), cam.start()))?;
    m.add("guide", prismatic(rod, Ground, vec2(0.0, 0.0), vec2(0.0, 0.0), vec2(0.0, 1.0), 0.0))?;
    m.add("lift", cam_knife_edge(cam, rod, vec2(0.0, 0.0), Law::new(Own) + Law::constant(2.0)))?;
    m.add("motor", drive_angle(cam, Law::ramp(1.0)))?;
    let error = emit::c(&m.build()?, &Options::default()).unwrap_err();
    assert!(matches!(error, Error::CannotEmit { .. }), "{error}");
    assert!(error.to_string().contains("Kin cannot print `lift` as C: Kin does not know the law"));
    Ok(())
}

/// A height over an angle.      \[m\]
#[constraint]
fn lifted(height: Coord, angle: Coord, profile: Law) -> f64 {
    height - profile.at(angle)
}

/// A cam with a spline that does not repeat turns beyond its ends, where the law is straight.
#[test]
fn a_spline_is_printed_as_a_table() -> kin::Result<()> {
    let table = [(-0.3, 0.5), (0.1, 0.55), (0.4, 0.7), (0.9, 0.65)];
    for ends in [Ends::Natural, Ends::Clamped { start: 0.1, end: -0.2 }] {
        let mut m = Mechanism::new("cam");
        let cam = m.link("cam", 0.1)?;
        let rod = m.planar("rod", pose(0.0, 0.5, 0.0))?;
        let o = vec2(0.0, 0.0);
        m.add("O", revolute(Ground, cam, o, cam.start()))?;
        m.add("lift", prismatic(rod, Ground, o, o, vec2(1.0, 0.0), 0.0))?;
        let profile = Law::spline(&table, ends);
        m.add("profile", lifted(rod.y(), cam.theta(), profile))?;
        m.add("motor", drive_angle(cam, Law::ramp(1.0)))?;
        let system = m.build()?;
        let text = emit::c(&system, &Options::default())?;
        if !there_is_a_compiler() {
            return Ok(());
        }
        let program = compiled("spline", &text, &[]).expect("compiles");
        assert_eq!(program.selftest(), "0");
        let way = (0..60)
            .map(|k| 0.03 * f64::from(k))
            .chain((0..130).map(|k| 1.77 - 0.03 * f64::from(k)));
        let lines: Vec<Vec<f64>> = way.map(|u| vec![u, 0.7, 0.2]).collect();
        let mut follower = system.follower(0.0)?;
        let found = program.run(&[], &lines);
        assert_eq!(found.len(), lines.len());
        for (line, found) in lines.iter().zip(&found) {
            let q = follower.to([("motor", line[0])])?.q().to_vec();
            let rates = follower.rates([("motor", [line[1], line[2]])])?;
            let expected = [vec![0.0], q, rates.qd, rates.qdd].concat();
            assert!(off(found, &expected) < 1e-12, "{ends:?} {line:?}: {found:?} {expected:?}");
        }
    }
    Ok(())
}

#[test]
fn a_redundant_mechanism_is_refused() -> kin::Result<()> {
    let mut m = Mechanism::new("twice");
    let crank = m.link("crank", 1.0)?;
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("P", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("motor", drive_angle(crank, Law::ramp(1.0)))?;
    let error = emit::c(&m.build()?, &Options::default()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "Kin cannot print \"twice\" as C: the mechanism has more equations than coordinates. \
         Remove the redundant equations that a diagnosis names"
    );
    Ok(())
}
