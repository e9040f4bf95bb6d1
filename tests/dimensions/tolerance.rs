//! How far measures may be off, against references of 60 digits (`tests/data/README.md`).

use kin::Tolerance;
use kin::prelude::*;
use serde_json::Value;

fn cases(family: &str) -> Vec<Value> {
    let text = include_str!("../data/design/tolerance_cases.json");
    let all: Vec<Value> = serde_json::from_str(text).expect("JSON");
    all.into_iter().filter(|case| case["family"] == family).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// A dimension of a case, with its tolerance.
fn dimension(m: &mut Mechanism, case: &Value, name: &str) -> kin::Result<Dimension> {
    let all = case["dimensions"].as_array().expect("a list");
    let own = all.iter().find(|own| own["name"] == name).expect("a dimension");
    Ok(m.dimension(name, number(&own["nominal"]))?.tolerance(number(&own["tolerance"])))
}

fn near(found: f64, exact: f64, limit: f64, what: &str) {
    assert!((found - exact).abs() <= limit * (1.0 + exact.abs()), "{what}: {found} {exact}");
}

/// Compares a stack with its reference; the corners too where the reference says that they are the worst.
fn compare(found: &Tolerance, case: &Value) {
    let id = case["id"].as_str().expect("a name");
    near(found.nominal, number(&case["nominal"]), 1e-12, id);
    near(found.worst_case(), number(&case["linear_worst_case"]), 1e-12, id);
    near(found.rss(), number(&case["rss_of_tolerances"]), 1e-12, id);
    let mut sum = 0.0;
    for own in case["dimensions"].as_array().expect("a list") {
        let one = found.contributions.iter().find(|one| own["name"] == one.name.as_str()).expect("told");
        near(one.slope, number(&own["sensitivity"]), 1e-12, id);
        // All of them have σ = T/3.
        near(found.share_of_variance(one), number(&own["contribution_to_variance"]), 1e-10, id);
        sum += found.share(one);
    }
    near(sum, 1.0, 1e-14, id);
    assert!(found.contributions.windows(2).all(|two| two[0].off().abs() >= two[1].off().abs()));
    let worst = &case["true_worst_case"];
    let [low, high] = ["minimum", "maximum"].map(|end| number(&worst[end]));
    for (corner, exact) in found.corners.into_iter().zip([low, high]) {
        let off = (corner.expect("assembled") - exact).abs();
        assert!(off <= 1e-9 * (high - low), "{id}: {corner:?} {exact}");
    }
}

fn slider_crank(case: &Value, degrees: f64) -> kin::Result<()> {
    let mut m = Mechanism::new("slider-crank");
    let [r, l, e] = ["r", "l", "e"].map(|name| dimension(&mut m, case, name));
    let (r, l, e) = (r?, l?, e?);
    let (crank, rod) = (m.link("crank", r)?, m.link("rod", l)?);
    let slider = m.planar("slider", pose(r * degrees.to_radians().cos() + l, e, 0.0))?;
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0)))?;
    m.add("A", revolute(crank, rod, crank.end(), rod.start()))?;
    m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0)))?;
    m.add("guide", prismatic(slider, Ground, (0.0, 0.0), (0.0, e), (0.0, 1.0), 0.0))?;
    m.add("motor", drive_angle(crank, Law::constant(degrees.to_radians())))?;
    let system = m.build()?;
    compare(&system.tolerance(&system.run([0.0])?, slider.x())?, case);
    Ok(())
}

#[test]
fn positions_of_a_slider_crank() {
    let mut count = 0;
    for case in cases("slider_crank") {
        let id = case["id"].as_str().expect("a name");
        if let Some(degrees) = id.strip_prefix("slider_crank_position_") {
            slider_crank(&case, degrees.parse().expect("degrees")).expect("a tolerance");
            count += 1;
        }
    }
    assert_eq!(count, 6);
}

/// The open four-bar of a case with its coupler and rocker; its frame is turned by g where the case says so.
fn four_bar(case: &Value, law: Law, rocker_at: f64) -> kin::Result<(System, [PlanarBody; 2])> {
    let mut m = Mechanism::new("four-bar");
    let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| dimension(&mut m, case, name));
    let (a, b, c, d) = (a?, b?, c?, d?);
    let (crank, coupler, rocker) = (m.link("crank", a)?, m.link("coupler", b)?, m.link("rocker", c)?);
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0)))?;
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
    if case["dimensions"].as_array().expect("a list").len() == 5 {
        let g = dimension(&mut m, case, "g")?;
        m.add("C", revolute(rocker, Ground, rocker.start(), (d * g.cos(), d * g.sin())))?;
    } else {
        m.add("C", revolute(rocker, Ground, rocker.start(), (d, 0.0)))?;
    }
    m.add("motor", drive_angle(crank, law))?;
    m.prefer(rocker, rocker_at);
    Ok((m.build()?, [coupler.into(), rocker.into()]))
}

#[test]
fn rocker_angles_of_a_four_bar() {
    let mut count = 0;
    for case in cases("fourbar") {
        let id = case["id"].as_str().expect("a name");
        if let Some(degrees) = id.strip_prefix("fourbar_rocker_") {
            let degrees: f64 = degrees.parse().expect("degrees");
            let law = Law::constant(degrees.to_radians());
            let (system, [_, rocker]) = four_bar(&case, law, number(&case["nominal"])).expect("a four-bar");
            let motion = system.run([0.0]).expect("a motion");
            compare(&system.tolerance(&motion, rocker.theta()).expect("a tolerance"), &case);
            count += 1;
        }
    }
    assert_eq!(count, 3);
}

#[test]
fn the_least_transmission_angle_of_a_four_bar() {
    let all = cases("fourbar");
    let case = all.iter().find(|case| case["id"] == "fourbar_transmission_minimum").expect("a case");
    let (system, [coupler, rocker]) = four_bar(case, Law::linear(-0.5, 1.0), 0.9).expect("a four-bar");
    let motion = system.run(linspace(0.0, 1.0, 21)).expect("a motion");
    let x = vec2(1.0, 0.0);
    let angle = |motion: &Motion| motion.transmission_angle((coupler, x), (rocker, x));
    let least = system.extremes(&motion, angle).expect("extremes").min();
    compare(&system.tolerance_of(&motion, angle, &least).expect("a tolerance"), case);
}

/// cage − roller at the angle φ is hub + roller, the roller being the mean of two.
#[constraint]
fn wedged(phi: Coord, hub: f64, roller1: f64, roller2: f64, cage: f64) -> f64 {
    let roller = 0.5 * (roller1 + roller2);
    (cage - roller) * phi.cos() - (hub + roller)
}

#[test]
fn the_clutch_is_told_to_mislead_the_stack() {
    let case = &cases("clutch")[0];
    let mut m = Mechanism::new("clutch");
    let [hub, one, two, cage] =
        ["hub", "roller1", "roller2", "cage"].map(|name| dimension(&mut m, case, name).expect("a dimension"));
    let phi = m.angle("phi", 0.12).expect("an angle");
    m.add("wedge", wedged(phi, hub, one, two, cage)).expect("a constraint");
    let system = m.build().expect("a system");
    let found = system.tolerance(&system.run([0.0]).expect("a motion"), phi).expect("a tolerance");
    compare(&found, case);
    assert!((found.misled().expect("a share") - 0.44).abs() < 0.01, "{found}");
    let told = found.to_string();
    assert!(told.contains("the stack misleads by 44 %"), "{told}");
    assert_eq!(
        told.lines().next(),
        Some("phi (0.12249 rad at 0 s): ± 0.0519 worst case, ± 0.0349 RSS."),
        "{told}"
    );
}

/// Of the slider-crank's dead centre: crank and rod in line, √((l + r)² − e²).
#[test]
fn an_extreme_is_off_where_it_moves_to() {
    let mut m = Mechanism::new("press");
    let r = m.dimension("r", 0.05).expect("a dimension").tolerance(1e-4);
    let l = m.dimension("l", 0.12).expect("a dimension").tolerance(2e-4);
    let e = m.dimension("e", 0.01).expect("a dimension").tolerance(3e-4);
    let (crank, rod) = (m.link("crank", r).expect("a link"), m.link("rod", l).expect("a link"));
    let slider = m.planar("slider", pose(r + l, e, 0.0)).expect("a body");
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0))).expect("adds");
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).expect("adds");
    m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0))).expect("adds");
    m.add("guide", prismatic(slider, Ground, (0.0, 0.0), (0.0, e), (0.0, 1.0), 0.0)).expect("adds");
    m.add("motor", drive_angle(crank, Law::linear(-1.0, 1.0))).expect("adds");
    let system = m.build().expect("builds");
    let motion = system.run(linspace(0.0, 2.0, 21)).expect("a motion");
    let outer = system.extremes(&motion, slider.x()).expect("extremes").max();
    let found = system.tolerance_of(&motion, slider.x(), &outer).expect("a tolerance");
    let value = |[r, l, e]: [f64; 3]| ((l + r).powi(2) - e * e).sqrt();
    let x = value([0.05, 0.12, 0.01]);
    let by = |name: &str| found.contributions.iter().find(|one| one.name == name).expect("told").slope;
    for (name, exact) in [("r", 0.17 / x), ("l", 0.17 / x), ("e", -0.01 / x)] {
        near(by(name), exact, 1e-12, name);
    }
    let corners = [[0.0499, 0.1198, 0.0103], [0.0501, 0.1202, 0.0097]].map(value);
    for (found, exact) in found.corners.into_iter().zip(corners) {
        near(found.expect("assembled"), exact, 1e-12, "corner");
    }
}

#[test]
fn corners_that_cannot_be_assembled_are_told() {
    let mut m = Mechanism::new("stretched");
    let b = m.dimension("b", 1.0).expect("a dimension").tolerance(0.02);
    let (crank, rod) = (m.link("crank", 1.0).expect("a link"), m.link("rod", b).expect("a link"));
    let slider = m.planar("slider", pose(1.1, 0.99, 0.0)).expect("a body");
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0))).expect("adds");
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).expect("adds");
    m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0))).expect("adds");
    m.add("guide", prismatic(slider, Ground, (0.0, 0.0), (0.0, -0.99), (0.0, 1.0), 0.0)).expect("adds");
    m.add("motor", drive_angle(crank, Law::constant(0.0))).expect("adds");
    let system = m.build().expect("builds");
    let motion = system.run([0.0]).expect("a motion");
    let found = system.tolerance(&motion, slider.x()).expect("a tolerance");
    assert!(found.corners.contains(&None) && found.misled().is_none(), "{found}");
    assert!(found.to_string().contains("cannot be assembled"), "{found}");
}

#[test]
fn without_tolerances_there_is_no_stack() {
    let mut m = Mechanism::new("crank");
    let a = m.dimension("a", 1.0).expect("a dimension");
    let crank = m.link("crank", a).expect("a link");
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0))).expect("adds");
    m.add("motor", drive_angle(crank, Law::ramp(1.0))).expect("adds");
    let system = m.build().expect("builds");
    let motion = system.run([0.0, 1.0]).expect("a motion");
    let told = system.tolerance(&motion, crank.x()).expect_err("no tolerance").to_string();
    assert!(told.contains("none of them has a tolerance"), "{told}");
}
