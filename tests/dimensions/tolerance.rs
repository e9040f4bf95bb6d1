//! How far measures may be off, against references of 60 digits (`tests/data/README.md`).

use std::f64::consts::TAU;

use kin::Coordinate;
use kin::design::{Distribution, Feature, Samples, Sampling, Tolerance};
use kin::prelude::*;
use serde_json::Value;

use crate::engines::Engines;

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

/// Compares the second-order term with its reference. The clutch's was made by differences that are
/// right to four digits only; closed forms of its own are in `the_second_order_of_the_clutch`.
fn compare_second_order(found: &Tolerance, case: &Value) {
    let id = case["id"].as_str().expect("a name");
    let limit = if case["family"] == "clutch" { 3e-4 } else { 1e-6 };
    let second = found.second_order.as_ref().expect("a second order");
    let relative = |found: f64, exact: f64, size: f64, what: &str| {
        assert!((found - exact).abs() <= limit * size, "{id}: {what} {found} {exact}");
    };
    let all = case["dimensions"].as_array().expect("a list");
    let place = |name: &str| all.iter().position(|own| own["name"] == name).expect("a dimension");
    let exact = |i: usize, j: usize| number(&case["hessian"][i][j]);
    let size = (0..all.len()).flat_map(|i| (0..all.len()).map(move |j| (i, j)));
    let size = size.map(|(i, j)| exact(i, j).abs()).fold(0.0, f64::max);
    for (i, name) in second.names.iter().enumerate() {
        for (j, other) in second.names.iter().enumerate() {
            relative(second.hessian[i][j], exact(place(name), place(other)), size, name);
        }
    }
    let [shift, sigma] =
        ["mean_shift_second_order", "sigma_second_order"].map(|name| number(&case[name]));
    relative(second.mean_shift, shift, shift.abs(), "mean");
    relative(second.sigma, sigma, sigma, "sigma");
    relative(found.sigma(), number(&case["sigma_first_order"]), 1e-6 * sigma, "first order");
}

/// Compares a stack with its reference; the corners too, which are the worst in all of them.
fn compare(found: &Tolerance, case: &Value) {
    let id = case["id"].as_str().expect("a name");
    near(found.nominal, number(&case["nominal"]), 1e-12, id);
    near(found.worst_case(), number(&case["linear_worst_case"]), 1e-12, id);
    near(found.rss(), number(&case["rss_of_tolerances"]), 1e-12, id);
    let mut sum = 0.0;
    for own in case["dimensions"].as_array().expect("a list") {
        let one =
            found.contributions.iter().find(|one| own["name"] == one.name.as_str()).expect("told");
        near(one.slope, number(&own["sensitivity"]), 1e-12, id);
        assert_eq!(one.distribution, Distribution::Normal);
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
    compare_second_order(found, case);
}

/// Compares samples with those of the reference, which are a million, closed form by closed form.
fn compare_samples(found: &Samples, case: &Value) {
    let id = case["id"].as_str().expect("a name");
    let exact = &case["monte_carlo"];
    assert_eq!(found.missing(), 0, "{id}");
    let n = found.values().len() as f64;
    let all = number(&exact["samples"]);
    // Both have an error of their own.
    let wider = (1.0 + all / n).sqrt();
    for (what, own) in [("mean", found.mean()), ("sigma", found.sigma())] {
        let off = (own - number(&exact[what])).abs();
        let limit = 5.0 * wider * number(&exact["standard_error"][what]);
        assert!(off <= limit, "{id}: {what} {own} is off by {off:e}, more than {limit:e}");
    }
    let sigma = number(&exact["sigma"]);
    for (p, value) in exact["quantiles"].as_object().expect("quantiles") {
        let (p, value): (f64, f64) = (p.parse().expect("a number"), number(value));
        let limit = if (0.04..0.96).contains(&p) { 0.01 } else { 0.03 };
        // Of fewer samples five standard errors of a quantile of a normal distribution.
        let density =
            (-0.5 * ((value - number(&exact["mean"])) / sigma).powi(2)).exp() / TAU.sqrt();
        let error = 5.0 * wider * (p * (1.0 - p) / all).sqrt() / density;
        let off = (found.quantile(p) - value).abs() / sigma;
        assert!(off <= f64::max(limit, error), "{id}: quantile {p} is off by {off} σ");
    }
}

/// Compares a proved worst case with its reference: it holds the true one and every sample of the
/// box, and is little wider where the mechanism is nearly linear.
fn compare_proved(found: &Tolerance, case: &Value) {
    let id = case["id"].as_str().expect("a name");
    let proved = found.proved.as_ref().expect("a proof");
    for (name, low, high) in
        [("true_worst_case", "minimum", "maximum"), ("box_sample", "minimum", "maximum")]
    {
        let [low, high] = [low, high].map(|end| number(&case[name][end]));
        assert!(proved.low <= low && high <= proved.high, "{id}: {proved:?} {low} {high}");
    }
    let [low, high] = ["minimum", "maximum"].map(|end| number(&case["true_worst_case"][end]));
    let width = (proved.high - proved.low) / (high - low) - 1.0;
    let stack = 2.0 * number(&case["linear_worst_case"]) / (high - low) - 1.0;
    println!("{id}: {:.2} % wider", 100.0 * width);
    if stack.abs() < 0.02 {
        assert!(width < 0.05, "{id}: {width}");
    }
}

/// `KIN_SAMPLES=1000000` for as many as the reference has.
fn sampling() -> Sampling {
    let count = std::env::var("KIN_SAMPLES").ok().and_then(|count| count.parse().ok());
    Sampling { count: count.unwrap_or(800), seed: 7, ..Sampling::default() }
}

/// The slider-crank of a case, and its slider.
fn slider_crank(case: &Value, law: Law, degrees: f64) -> kin::Result<(System, PlanarBody)> {
    let mut m = Mechanism::new("slider-crank");
    let [r, l, e] = ["r", "l", "e"].map(|name| dimension(&mut m, case, name));
    let r = r?;
    let l = l?;
    let e = e?;
    let crank = m.link("crank", r)?;
    let rod = m.link("rod", l)?;
    let slider = m.planar("slider", pose(r * degrees.to_radians().cos() + l, e, 0.0))?;
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0)))?;
    m.add("A", revolute(crank, rod, crank.end(), rod.start()))?;
    m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0)))?;
    m.add("guide", prismatic(slider, Ground, (0.0, 0.0), (0.0, e), (0.0, 1.0), 0.0))?;
    m.add("motor", drive_angle(crank, law))?;
    Ok((m.build()?, slider))
}

/// Compares all that is told of a feature with its reference.
fn compare_all(
    system: &System,
    motion: &Motion,
    what: impl kin::results::Measure + Sync + Copy,
    of: impl Into<Feature>,
    case: &Value,
) {
    let of = of.into();
    compare(&system.tolerance_of(motion, what, of).expect("a tolerance"), case);
    if what.coordinate(system).is_some() {
        compare_proved(&system.tolerance_proved(motion, what, of).expect("a proof"), case);
    }
    compare_samples(&system.samples(motion, what, of, &sampling()).expect("samples"), case);
}

#[test]
fn positions_of_a_slider_crank() {
    let mut count = 0;
    for case in cases("slider_crank") {
        let id = case["id"].as_str().expect("a name");
        if let Some(degrees) = id.strip_prefix("slider_crank_position_") {
            let degrees: f64 = degrees.parse().expect("degrees");
            let law = Law::constant(degrees.to_radians());
            let (system, slider) = slider_crank(&case, law, degrees).expect("a slider-crank");
            let motion = system.run_both([0.0]).expect("a motion");
            compare(&system.tolerance(&motion, slider.x()).expect("a tolerance"), &case);
            compare_all(&system, &motion, slider.x(), 0.0, &case);
            count += 1;
        }
    }
    assert_eq!(count, 6);
}

/// The open four-bar of a case with its coupler and rocker; its frame is turned by g where the case
/// says so.
fn four_bar(case: &Value, law: Law, rocker_at: f64) -> kin::Result<(System, [PlanarBody; 2])> {
    let mut m = Mechanism::new("four-bar");
    let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| dimension(&mut m, case, name));
    let a = a?;
    let b = b?;
    let c = c?;
    let d = d?;
    let crank = m.link("crank", a)?;
    let coupler = m.link("coupler", b)?;
    let rocker = m.link("rocker", c)?;
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
            let (system, [_, rocker]) =
                four_bar(&case, law, number(&case["nominal"])).expect("a four-bar");
            let motion = system.run_both([0.0]).expect("a motion");
            compare_all(&system, &motion, rocker.theta(), 0.0, &case);
            count += 1;
        }
    }
    assert_eq!(count, 3);
}

#[test]
fn the_least_transmission_angle_of_a_four_bar() {
    let all = cases("fourbar");
    let case =
        all.iter().find(|case| case["id"] == "fourbar_transmission_minimum").expect("a case");
    let (system, [coupler, rocker]) =
        four_bar(case, Law::linear(-0.5, 1.0), 0.9).expect("a four-bar");
    let motion = system.run_both(linspace(0.0, 1.0, 21)).expect("a motion");
    let x = vec2(1.0, 0.0);
    let angle = |motion: &Motion| motion.transmission_angle((coupler, x), (rocker, x));
    let least = system.extremes(&motion, angle).expect("extremes").min();
    compare_all(&system, &motion, angle, least, case);
}

/// A stroke is the difference of two extremes, each of which moves in time by itself.
#[test]
fn the_stroke_of_a_slider_crank() {
    let all = cases("slider_crank");
    let case = all.iter().find(|case| case["id"] == "slider_crank_stroke").expect("a case");
    let (system, slider) =
        slider_crank(case, Law::linear(-0.5, 1.0), -28.0).expect("a slider-crank");
    let motion = system.run_both(linspace(0.0, 6.5, 66)).expect("a motion");
    let extremes = system.extremes(&motion, slider.x()).expect("extremes");
    compare_all(&system, &motion, slider.x(), &extremes, case);
    let told =
        system.tolerance_of(&motion, slider.x(), &extremes).expect("a tolerance").to_string();
    assert!(told.starts_with("stroke of slider.R_x (0.10042 m): ± 0.000211 worst case"), "{told}");
}

/// The crank shaper: a block on the crank slides in the rocker, whose rod moves the ram at the
/// height H.
#[test]
fn the_stroke_of_a_crank_shaper() {
    let case = &cases("quick_return")[0];
    let mut m = Mechanism::new("shaper");
    let [r, d, l4, l5, h] =
        ["r", "d", "L4", "L5", "H"].map(|name| dimension(&mut m, case, name).expect("a dimension"));
    let build = || {
        let crank = m.link("crank", r)?;
        let rocker = m.link("rocker", l4)?;
        let rod = m.link("rod", l5)?;
        let block = m.planar("block", pose(0.1, 0.25, 1.2))?;
        let ram = m.planar("ram", pose(0.0, h, 0.0))?;
        m.add("O2", revolute(crank, Ground, crank.start(), (0.0, d)))?;
        m.add("O4", revolute(rocker, Ground, rocker.start(), (0.0, 0.0)))?;
        m.add("A", revolute(crank, block, crank.end(), (0.0, 0.0)))?;
        m.add("slot", prismatic(block, rocker, (0.0, 0.0), (0.0, 0.0), (0.0, 1.0), 0.0))?;
        m.add("B", revolute(rocker, rod, rocker.end(), rod.start()))?;
        m.add("C", revolute(rod, ram, rod.end(), (0.0, 0.0)))?;
        m.add("guide", prismatic(ram, Ground, (0.0, 0.0), (0.0, h), (0.0, 1.0), 0.0))?;
        m.add("motor", drive_angle(crank, Law::ramp(1.0)))?;
        m.prefer(rod, 0.1);
        kin::Result::Ok((m.build()?, ram))
    };
    let (system, ram) = build().expect("a shaper");
    let motion = system.run_both(linspace(0.0, 6.3, 127)).expect("a motion");
    let extremes = system.extremes(&motion, ram.x()).expect("extremes");
    compare_all(&system, &motion, ram.x(), &extremes, case);
}

/// cage − roller at the angle φ is hub + roller, the roller being the mean of two.
#[constraint]
fn wedged(phi: Coord, hub: f64, roller1: f64, roller2: f64, cage: f64) -> f64 {
    let roller = 0.5 * (roller1 + roller2);
    (cage - roller) * phi.cos() - (hub + roller)
}

/// The clutch and the angle at which its rollers touch.
fn clutch() -> (System, Coordinate) {
    let case = &cases("clutch")[0];
    let mut m = Mechanism::new("clutch");
    let [hub, one, two, cage] = ["hub", "roller1", "roller2", "cage"]
        .map(|name| dimension(&mut m, case, name).expect("a dimension"));
    let phi = m.angle("phi", 0.12).expect("an angle");
    m.add("wedge", wedged(phi, hub, one, two, cage)).expect("a constraint");
    (m.build().expect("a system"), phi)
}

#[test]
fn the_clutch_is_told_to_mislead_the_stack() {
    let case = &cases("clutch")[0];
    let (system, phi) = clutch();
    let motion = system.run_both([0.0]).expect("a motion");
    let found = system.tolerance(&motion, phi).expect("a tolerance");
    compare(&found, case);
    compare_samples(&system.samples(&motion, phi, 0.0, &sampling()).expect("samples"), case);
    compare_proved(&system.tolerance_proved(&motion, phi, 0.0).expect("a proof"), case);
    assert!((found.misled().expect("a share") - 0.44).abs() < 0.01, "{found}");
    let told = found.to_string();
    assert!(told.contains("the larger deviation is 44 % above the linear stack"), "{told}");
    assert_eq!(
        told.lines().next(),
        Some(
            "phi (0.12249 rad at 0 s): -0.075 to +0.0439 worst case (linear stack ± 0.0519), ± 0.0349 RSS."
        ),
        "{told}"
    );
}

/// φ = acos x, x = (hub + R)/(cage − R), R the mean of both rollers: by hub and cage.
#[test]
fn the_second_order_of_the_clutch() {
    let (system, phi) = clutch();
    let found =
        system.tolerance(&system.run_both([0.0]).expect("a motion"), phi).expect("a tolerance");
    let second = found.second_order.as_ref().expect("a second order");
    let place = |name: &str| second.names.iter().position(|own| own == name).expect("a dimension");
    let hub = place("hub");
    let cage = place("cage");
    let d = 101.6_f64 - 22.86;
    let phi = ((55.29_f64 + 22.86) / (101.6 - 22.86)).acos();
    let (sin, cos) = phi.sin_cos();
    let by_x = [-1.0 / sin, -cos / sin.powi(3)];
    let x_hub = 1.0 / d;
    let x_cage = -cos / d;
    for (i, j, exact) in [
        (hub, hub, by_x[1] * x_hub * x_hub),
        (hub, cage, by_x[1] * x_hub * x_cage - by_x[0] / (d * d)),
        (cage, cage, by_x[1] * x_cage * x_cage + by_x[0] * 2.0 * cos / (d * d)),
    ] {
        let off = (second.hessian[i][j] - exact).abs() / exact.abs();
        assert!(off < 1e-8 && second.hessian[i][j] == second.hessian[j][i], "{i} {j}: {off:e}");
    }
    assert!(found.to_string().contains("Second order: the mean shifts by -0.000558"), "{found}");
}

/// Of the slider-crank's dead centre: crank and rod in line, √((l + r)² − e²).
#[test]
fn an_extreme_is_off_where_it_moves_to() {
    let mut m = Mechanism::new("press");
    let r = m.dimension("r", 0.05).expect("a dimension").tolerance(1e-4);
    let l = m.dimension("l", 0.12).expect("a dimension").tolerance(2e-4);
    let e = m.dimension("e", 0.01).expect("a dimension").tolerance(3e-4);
    let crank = m.link("crank", r).expect("a link");
    let rod = m.link("rod", l).expect("a link");
    let slider = m.planar("slider", pose(r + l, e, 0.0)).expect("a body");
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0))).expect("adds");
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).expect("adds");
    m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0))).expect("adds");
    m.add("guide", prismatic(slider, Ground, (0.0, 0.0), (0.0, e), (0.0, 1.0), 0.0)).expect("adds");
    m.add("motor", drive_angle(crank, Law::linear(-1.0, 1.0))).expect("adds");
    let system = m.build().expect("builds");
    let motion = system.run_both(linspace(0.0, 2.0, 21)).expect("a motion");
    let outer = system.extremes(&motion, slider.x()).expect("extremes").max();
    let found = system.tolerance_of(&motion, slider.x(), outer).expect("a tolerance");
    let value = |[r, l, e]: [f64; 3]| ((l + r).powi(2) - e * e).sqrt();
    let x = value([0.05, 0.12, 0.01]);
    let by =
        |name: &str| found.contributions.iter().find(|one| one.name == name).expect("told").slope;
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
    let crank = m.link("crank", 1.0).expect("a link");
    let rod = m.link("rod", b).expect("a link");
    let slider = m.planar("slider", pose(1.1, 0.99, 0.0)).expect("a body");
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0))).expect("adds");
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).expect("adds");
    m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0))).expect("adds");
    m.add("guide", prismatic(slider, Ground, (0.0, 0.0), (0.0, -0.99), (0.0, 1.0), 0.0))
        .expect("adds");
    m.add("motor", drive_angle(crank, Law::constant(0.0))).expect("adds");
    let system = m.build().expect("builds");
    let motion = system.run_both([0.0]).expect("a motion");
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
    let motion = system.run_both([0.0, 1.0]).expect("a motion");
    let told = system.tolerance(&motion, crank.x()).expect_err("no tolerance").to_string();
    assert!(told.contains("no dimension that changes the motion has a tolerance"), "{told}");
}
