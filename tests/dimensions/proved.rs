//! Worst cases that are proved: they hold every sample, are hardly wider than what is attained, and
//! are refused where a mechanism within the tolerances may not be assembled.

use kin::Coordinate;
use kin::design::{Distribution, Feature, Sampling, Tolerance};
use kin::prelude::*;

use crate::engines::Engines;

const UNIFORM: Sampling = Sampling { count: 1500, seed: 3, distribution: Distribution::Uniform };

/// Checks a bound against samples of the whole box, and gives how far they are apart beside the
/// bound.
fn holds_samples(
    system: &System,
    motion: &Motion,
    what: impl kin::results::Measure + Sync + Copy,
    of: impl Into<Feature>,
) -> Tolerance {
    let of = of.into();
    let found = system.tolerance_proved(motion, what, of).expect("a proof");
    let proved = found.proved.as_ref().expect("bounds");
    let samples = system.samples(motion, what, of, &UNIFORM).expect("samples");
    assert_eq!(samples.missing(), 0);
    let [least, most] = [samples.values()[0], samples.values()[samples.values().len() - 1]];
    assert!(proved.low <= least && most <= proved.high, "{proved:?}: {least} {most}");
    for (corner, bound) in found.corners.iter().zip([proved.low, proved.high]) {
        let corner = corner.expect("assembled");
        assert!(
            (corner - bound).abs() <= 0.006 * (bound - found.nominal).abs(),
            "{found}: {corner} {bound}"
        );
    }
    found
}

/// A four-bar with play in its pin A and dimensions in its lengths; `mu` is the angle between
/// coupler and rocker.
fn four_bar() -> (System, [PlanarBody; 2], Coordinate) {
    let mut m = Mechanism::new("four-bar");
    let [a, b, c, d] = [("a", 0.04, 5e-5), ("b", 0.12, 1e-4), ("c", 0.08, 8e-5), ("d", 0.1, 1e-4)]
        .map(|(name, x, t)| m.dimension(name, x).expect("a dimension").tolerance(t));
    let gap = m.clearance("gap", 1e-4).expect("a clearance");
    let [crank, coupler, rocker] = [("crank", a), ("coupler", b), ("rocker", c)]
        .map(|(name, l)| m.link(name, l).expect("a link"));
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0))).expect("adds");
    m.add("A", revolute(crank, coupler, crank.end() + gap, coupler.start())).expect("adds");
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).expect("adds");
    m.add("C", revolute(rocker, Ground, rocker.start(), (d, 0.0))).expect("adds");
    m.add("motor", drive_angle(crank, Law::linear(-0.5, 1.0))).expect("adds");
    let mu = m.angle("mu", 0.5).expect("an angle");
    m.add("between", between(mu, coupler, rocker)).expect("adds");
    m.prefer(rocker, 0.9);
    (m.build().expect("a four-bar"), [coupler.into(), rocker.into()], mu)
}

/// μ is the angle from the coupler to the rocker.      [rad]
#[constraint]
fn between(mu: Coord, coupler: Planar, rocker: Planar) -> f64 {
    mu - (rocker.theta - coupler.theta)
}

/// At a time, of an extreme, of a stroke; with a disc among the dimensions.
#[test]
fn bounds_hold_every_sample_and_are_hardly_wider() {
    let (system, [_, rocker], mu) = four_bar();
    let motion = system.run_both(linspace(0.0, 4.0, 81)).expect("a motion");
    holds_samples(&system, &motion, rocker.theta(), 0.7);
    let extremes = system.extremes(&motion, mu).expect("extremes");
    let least = holds_samples(&system, &motion, mu, extremes.min());
    let told = least.to_string();
    assert!(told.contains("worst case (proved: "), "{told}");
    let swing = system.extremes(&motion, rocker.theta()).expect("extremes");
    holds_samples(&system, &motion, rocker.theta(), swing.min());
    let text = system.tolerance_of(&motion, mu, extremes.min()).expect("a tolerance");
    assert!(text.proved.is_none() && !text.to_string().contains("proved"));
}

/// μ = acos((b² + c² − (d − a)²)/(2 b c)), its least value, at the corners that are the worst.
#[test]
fn the_least_transmission_angle_as_a_coordinate() {
    let mut m = Mechanism::new("four-bar");
    let values = [("a", 0.04, 5e-5), ("b", 0.12, 1e-4), ("c", 0.08, 8e-5), ("d", 0.1, 1e-4)];
    let [a, b, c, d] =
        values.map(|(name, x, t)| m.dimension(name, x).expect("a dimension").tolerance(t));
    let [crank, coupler, rocker] = [("crank", a), ("coupler", b), ("rocker", c)]
        .map(|(name, l)| m.link(name, l).expect("a link"));
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0))).expect("adds");
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).expect("adds");
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).expect("adds");
    m.add("C", revolute(rocker, Ground, rocker.start(), (d, 0.0))).expect("adds");
    m.add("motor", drive_angle(crank, Law::linear(-0.5, 1.0))).expect("adds");
    let mu = m.angle("mu", 0.5).expect("an angle");
    m.add("between", between(mu, coupler, rocker)).expect("adds");
    m.prefer(rocker, 0.9);
    let system = m.build().expect("a four-bar");
    let motion = system.run_both(linspace(0.0, 1.0, 21)).expect("a motion");
    let least = system.extremes(&motion, mu).expect("extremes").min();
    let found = system.tolerance_proved(&motion, mu, least).expect("a proof");
    let proved = found.proved.expect("bounds");
    let exact = |side: f64| {
        let [a, b, c, d] = [1.0, 1.0, -1.0, -1.0].map(|sign| -side * sign);
        let [a, b, c, d] = [0.04 + a * 5e-5, 0.12 + b * 1e-4, 0.08 + c * 8e-5, 0.1 + d * 1e-4];
        ((b * b + c * c - (d - a) * (d - a)) / (2.0 * b * c)).acos()
    };
    let [low, high] = [exact(-1.0), exact(1.0)];
    assert!(proved.low <= low && high <= proved.high, "{proved:?} {low} {high}");
    assert!(proved.high - proved.low < 1.006 * (high - low), "{proved:?} {low} {high}");
    assert!((low - 0.456_719_192_200_879_7).abs() < 1e-12, "{low}"); // `fourbar_transmission_minimum`
}

/// x = √p far from where that is linear: bounds on both sides, and of what is not at a corner,
/// x = |p| + p² being least in the middle.
#[test]
fn bounds_of_what_is_not_linear_at_all() {
    let build = |bowl: bool| {
        let mut m = Mechanism::new("bent");
        let p = m.dimension("p", if bowl { 0.1 } else { 1.0 }).expect("a dimension").tolerance(0.9);
        let x = m.length("x", 1.0).expect("a length");
        if bowl {
            m.add("bowl", in_bowl(x, p)).expect("adds");
        } else {
            m.add("root", root(x, p)).expect("adds");
        }
        let system = m.build().expect("a system");
        let motion = system.run_both([0.0]).expect("a pose");
        system.tolerance_proved(&motion, x, 0.0).expect("a proof").proved.expect("bounds")
    };
    for (bowl, low, high) in [(false, 0.1_f64.sqrt(), 1.9_f64.sqrt()), (true, 1.0, 2.0)] {
        let found = build(bowl);
        assert!(found.low <= low && high <= found.high, "{found:?}");
        assert!(found.low > low - 0.01 && found.high < high + 0.01, "{found:?}");
    }
}

#[constraint]
fn root(x: Coord, p: f64) -> f64 {
    x * x - p
}

#[constraint]
fn in_bowl(x: Coord, p: f64) -> f64 {
    x - (1.0 + p * p)
}

/// A rod from the origin to a slider at the height h; of `share` of the box it does not reach so
/// far.
fn reach(h: f64) -> (System, Motion, PlanarBody) {
    let mut m = Mechanism::new("reach");
    let rod = m.dimension("rod", 1.0).expect("a dimension").tolerance(0.02);
    let h = m.dimension("h", h).expect("a dimension").tolerance(0.1);
    let rod = m.link("rod", rod).expect("a link");
    let slider = m.planar("slider", pose(0.35, h, 0.0)).expect("a body");
    m.add("O", revolute(rod, Ground, rod.start(), (0.0, 0.0))).expect("adds");
    m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0))).expect("adds");
    m.add("upright", drive_angle(slider, Law::constant(0.0))).expect("adds");
    m.add("height", level(slider, h)).expect("adds");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0]).expect("a motion");
    (system, motion, slider)
}

/// The slider is at the height h.      [m]
#[constraint]
fn level(slider: Planar, h: f64) -> f64 {
    slider.r.y - h
}

#[test]
fn a_box_of_which_a_fifth_cannot_be_assembled_is_no_proof() {
    let (system, motion, slider) = reach(0.94);
    let told = system.tolerance_proved(&motion, slider.x(), 0.0).expect_err("no proof").to_string();
    assert!(
        told.starts_with("Kin cannot prove the worst case of slider.R_x: near rod = "),
        "{told}"
    );
    assert!(told.contains("may not assemble") && told.contains("h = "), "{told}");
    // A little lower all of it can, by a hair: √(0.98² − 0.975²) = 0.0989 is the least.
    let (system, motion, slider) = reach(0.875);
    let found =
        system.tolerance_proved(&motion, slider.x(), 0.0).expect("a proof").proved.expect("bounds");
    let [low, high] =
        [(0.98_f64, 0.975_f64), (1.02, 0.775)].map(|(rod, h)| (rod * rod - h * h).sqrt());
    assert!(
        found.low <= low && high <= found.high && found.low > low - 0.01,
        "{found:?} {low} {high}"
    );
}

#[constraint]
fn stepped(x: Coord, p: f64) -> f64 {
    x - p - p.floor()
}

#[constraint]
fn told_by(x: Coord, p: f64) -> f64 {
    x - odd(p)
}

fn odd<D: kin::extend::Dual>(p: kin::extend::Real<D>) -> kin::extend::Real<D> {
    p * p
}

/// Each by name, with its reason.
#[test]
fn of_what_no_bounds_are_known_there_is_no_proof() {
    let (system, [coupler, rocker], _) = four_bar();
    let motion = system.run_both(linspace(0.0, 1.0, 21)).expect("a motion");
    let x = vec2(1.0, 0.0);
    let angle = |motion: &Motion| motion.transmission_angle((coupler, x), (rocker, x));
    let told = system.tolerance_proved(&motion, angle, 0.5).expect_err("a function").to_string();
    assert!(told.contains("of coordinates only. Add a coordinate for the measure"), "{told}");
    let told = |of: &dyn Fn(&mut Mechanism, Coordinate, Dimension)| {
        let mut m = Mechanism::new("odd");
        let p = m.dimension("p", 0.5).expect("a dimension").tolerance(0.6);
        let x = m.length("x", 1.0).expect("a length");
        of(&mut m, x, p);
        let system = m.build().expect("a system");
        let motion = system.run_both([0.0]).expect("a pose");
        system.tolerance_proved(&motion, x, 0.0).expect_err("no proof").to_string()
    };
    let law = told(&|m, x, p| {
        m.add("motor", drive(x, Law::constant(p))).expect("adds");
    });
    assert!(law.contains("`motor.law.c` is a coefficient of a law"), "{law}");
    let jump = told(&|m, x, p| {
        m.add("step", stepped(x, p)).expect("adds");
    });
    assert!(
        jump.contains("Kin knows no bounds of `step`: `p.floor()` jumps near this value"),
        "{jump}"
    );
    let odd = told(&|m, x, p| {
        m.add("odd", told_by(x, p)).expect("adds");
    });
    assert!(odd.contains("`odd"), "{odd}");
}

/// An axis is worked out of its directions beside the equations, where no bounds are known of it: a
/// tolerance on one is refused by name, and one on another dimension of the same mechanism is not.
#[test]
fn an_axis_that_hangs_on_a_toleranced_dimension_is_refused_by_name() {
    let build = |tilted: bool| {
        let mut m = Mechanism::new("door");
        let out = m.dimension("out", 0.4).expect("a dimension");
        let tilt = m.dimension("tilt", 0.1).expect("a dimension");
        if tilted {
            tilt.tolerance(1e-3)
        } else {
            out.tolerance(1e-3)
        };
        let zero = kin::Dimension::from(0.0);
        let z = vec3(0.0, 0.0, 1.0);
        let door = m.spatial("door", SpatialPose::at((0.4, 0.0, 0.0))).expect("a body");
        let along = [tilt, zero, 1.0.into()];
        let at = [-out, zero, zero];
        m.add("hinge", spatial::revolute(door, Ground, at, (0.0, 0.0, 0.0), z, along))
            .expect("adds");
        m.add("motor", spatial::drive_turn(door, Ground, z, along, Law::linear(0.2, 1.0)))
            .expect("adds");
        let system = m.build().expect("a door");
        let motion = system.run_both([0.0, 0.5]).expect("a motion");
        system.tolerance_proved(&motion, "door.R_x", 0.5).map(|found| found.proved.expect("bounds"))
    };
    let error = build(true).expect_err("an axis").to_string();
    assert!(error.contains("`motor.h_j` is an axis that depends on dimensions"), "{error}");
    let proved = build(false).expect("a proof");
    assert!(proved.low < proved.high && proved.high - proved.low < 2.1e-3, "{proved:?}");
}
