//! Answers about a motion do not depend on its grid of times: against the laws themselves, and
//! against fine grids.

use kin::prelude::*;

use crate::{crank_rocker, near};

/// A coordinate that follows a law.
fn followed(law: &Law, from: f64) -> (System, Coordinate) {
    let mut m = Mechanism::new("one");
    let x = m.length("x", law.at(from)).unwrap();
    m.add("motor", drive(x, law.clone())).unwrap();
    (m.build().unwrap(), x)
}

/// y = |x − c|   \[m\]
#[constraint]
fn distance(x: Coord, y: Coord, c: f64) -> f64 {
    y - (x - c).abs()
}

/// A coordinate whose distance from c is that of a coordinate that follows a law.
fn followed_at_a_distance(law: &Law, c: f64) -> (System, Coordinate) {
    let mut m = Mechanism::new("folded");
    let x = m.length("x", law.at(0.0)).unwrap();
    let y = m.length("y", (law.at(0.0) - c).abs()).unwrap();
    m.add("motor", drive(x, law.clone())).unwrap();
    m.add("distance", distance(x, y, c)).unwrap();
    (m.build().unwrap(), y)
}

/// A cam's follower: still, up by 1, still, down again.
fn dwell() -> Law {
    let up = Law::cycloidal(1.0, 1.0);
    let parts = [Law::constant(0.0), up.clone(), Law::constant(1.0), Law::constant(1.0) - up];
    Law::sequence(0.0, parts.map(|part| (1.0, part)))
}

#[test]
fn extremes_of_a_dwell_on_a_coarse_grid() {
    let (system, x) = followed(&dwell(), 0.0);
    for times in [
        linspace(0.0, 4.0, 5),
        linspace(0.0, 4.0, 3),
        vec![0.0, 4.0],
        vec![4.0, 0.0],
        vec![0.5, 3.9],
    ] {
        let found = system.extremes(&system.run(&times).unwrap(), x).unwrap();
        near(found.max().value, 1.0, 1e-12);
        near(found.stroke(), 1.0, 1e-6);
        assert!(times.len() < 3 || (found.stroke() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn extremes_of_a_sine_on_a_coarse_grid() {
    let (system, x) = followed(&Law::sine(1.0, TAU, 0.0), 0.05);
    for count in [2, 3, 5, 9, 30] {
        let motion = system.run(linspace(0.05, 4.05, count)).unwrap();
        let found = system.extremes(&motion, x).unwrap();
        assert_eq!(found.all().len(), 8, "{count} times");
        near(found.stroke(), 2.0, 1e-12);
        near(found.time_ratio().unwrap(), 1.0, 1e-9);
        assert_eq!(system.crossings(&motion, x, 0.0).unwrap().len(), 8, "{count} times");
        assert_eq!(system.crossings(&motion, x, 0.999_999).unwrap().len(), 8, "{count} times");
        assert_eq!(system.crossings(&motion, x, 1.000_001).unwrap().len(), 0, "{count} times");
    }
}

/// A crank that turns twice and more between two times.
#[test]
fn dead_centres_between_times_that_are_turns_apart() {
    let linkage = crank_rocker();
    let fine = linkage.system.run(linspace(0.0, 6.0, 2161)).unwrap();
    let asked = |m: &Motion| m.transmission_angle(linkage.coupler, linkage.rocker);
    let exact = linkage.system.extremes(&fine, linkage.rocker.theta()).unwrap();
    let angle = linkage.system.extremes(&fine, asked).unwrap();
    let slide = linkage.system.extremes(&fine, "B.angle").unwrap();
    assert_eq!(exact.all().len(), 12);
    for times in
        [linspace(0.0, 6.0, 4), linspace(0.0, 6.0, 3), linspace(0.0, 6.0, 13), vec![6.0, 0.0]]
    {
        let motion = linkage.system.run(&times).unwrap();
        let found = linkage.system.extremes(&motion, linkage.rocker.theta()).unwrap();
        assert_eq!(found.all().len(), 12, "{} times", times.len());
        near(found.stroke(), exact.stroke(), 1e-12);
        near(found.time_ratio().unwrap(), exact.time_ratio().unwrap(), 1e-9);
        let found = linkage.system.extremes(&motion, asked).unwrap();
        near(found.stroke(), angle.stroke(), 1e-11);
        assert_eq!(found.all().len(), angle.all().len());
        near(linkage.system.extremes(&motion, "B.angle").unwrap().stroke(), slide.stroke(), 1e-11);
    }
}

/// The strokes of one cycle, whatever the number of turns and wherever the run begins.
#[test]
fn time_ratio_over_several_turns() {
    let slide = |offset: f64, begin: f64| {
        let mut m = Mechanism::new("crank and slider");
        let [crank, rod] = [("crank", 1.0), ("rod", 3.0)].map(|(name, l)| m.link(name, l).unwrap());
        m.add("O", revolute(crank, m.ground(), crank.start(), vec2(0.0, offset))).unwrap();
        m.add("A", revolute(crank, rod, crank.end(), rod.start())).unwrap();
        m.add("g", point_on_line(rod, m.ground(), rod.end(), vec2(0.0, 0.0), vec2(1.0, 0.0)))
            .unwrap();
        m.add("w", drive_angle(crank, Law::linear(begin, TAU))).unwrap();
        m.prefer(rod, -0.1);
        m.build().unwrap()
    };
    // Dead centres where crank and rod are in line: sin of the angle is the offset over 4, and
    // over 2.
    let offset = 0.8_f64;
    let between = PI + (offset / 2.0).asin() - (offset / 4.0).asin();
    let exact = between.max(TAU - between) / between.min(TAU - between);
    for (offset, exact) in [(0.0, 1.0), (offset, exact)] {
        for begin in [0.3, 2.5, 5.0, -(offset / 4.0_f64).asin(), PI - (offset / 2.0_f64).asin()] {
            let system = slide(offset, begin);
            for (turns, count) in [(1.0, 181), (1.0, 7), (2.0, 361), (3.0, 50), (5.0, 901)] {
                let motion = system.run(linspace(0.0, turns, count)).unwrap();
                let ratio = system.extremes(&motion, "g.slide").unwrap().time_ratio();
                let ratio = ratio.unwrap_or_else(|| panic!("no ratio: {offset} {begin} {turns}"));
                near(ratio, exact, 1e-7);
            }
            let motion = system.run(linspace(0.0, 0.9, 50)).unwrap();
            let found = system.extremes(&motion, "g.slide").unwrap();
            assert!(found.all().len() > 2 || found.time_ratio().is_none());
        }
    }
}

/// A cam whose follower rises and rests more than once between two times; the cam is a law of the
/// crank's angle.
#[test]
fn a_cam_that_turns_over_between_two_times() {
    let mut m = Mechanism::new("cam");
    let angle = m.angle("angle", 0.0).unwrap();
    let lift = m.length("lift", 0.0).unwrap();
    m.add("motor", drive(angle, Law::linear(0.0, TAU))).unwrap();
    let profile = dwell().compose(&Law::linear(0.0, 4.0 / TAU)).periodic(TAU);
    m.add("cam", cam(angle, lift, profile)).unwrap();
    let system = m.build().unwrap();
    for count in [2, 3, 4, 7] {
        let motion = system.run(linspace(0.0, 3.0, count)).unwrap();
        let found = system.extremes(&motion, lift).unwrap();
        near(found.stroke(), 1.0, 1e-9);
        assert_eq!(system.crossings(&motion, lift, 0.5).unwrap().len(), 6, "{count} times");
    }
}

/// lift = f(angle)   \[m\]
#[constraint]
fn cam(angle: Coord, lift: Coord, f: Law) -> f64 {
    lift - f.at(angle)
}

/// A pin that leaves its slot and comes back within one step.
#[test]
fn limits_and_kinks_that_a_coarse_grid_hides() {
    let mut m = Mechanism::new("pin");
    let pin = m.planar("pin", pose(0.0, 0.0, 0.0)).unwrap();
    let slot = pin_in_slot(pin, m.ground(), vec2(0.0, 0.0), vec2(-0.1, 0.0), vec2(0.2, 0.0));
    m.add("slot", slot).unwrap();
    m.add("upright", drive_angle(pin, Law::constant(0.0))).unwrap();
    m.add("motor", drive(pin.x(), Law::sine(0.3, TAU, 0.0))).unwrap();
    let motion = m.build().unwrap().run(linspace(0.0, 3.0, 4)).unwrap();
    assert_eq!(motion.events().len(), 12, "{:?}", motion.events());
    let mut m = Mechanism::new("stop");
    let [x, y] = ["x", "y"].map(|name| m.length(name, 0.0).unwrap());
    m.add("motor", drive(x, Law::sine(0.3, TAU, 0.5))).unwrap();
    m.add("stop", stop(x, y)).unwrap();
    let motion = m.build().unwrap().run(linspace(0.0, 3.0, 4)).unwrap();
    assert_eq!(motion.events().len(), 6, "{:?}", motion.events());
}

/// y = max(x, 0.1)   \[m\]
#[constraint]
fn stop(x: Coord, y: Coord) -> f64 {
    y - x.max(0.1)
}

/// Small numbers that follow no pattern, always the same ones.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }

    fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }
}

/// A law over 0 … 4: rises and rests, many periods, tables, and sums of them.
fn random_law(random: &mut Random, depth: usize) -> Law {
    match random.below(if depth > 0 { 6 } else { 4 }) {
        0 => {
            let mut value = random.between(-1.0, 1.0);
            let mut parts = Vec::new();
            while parts.len() < 3 + random.below(8) {
                let h = random.between(-1.0, 1.0);
                let length = random.between(0.05, 0.9);
                let rise = match random.below(4) {
                    0 => Law::constant(0.0),
                    1 => Law::cycloidal(h, length),
                    2 => Law::harmonic_rise(h, length),
                    _ => Law::modified_sine(h, length),
                };
                let end = rise.at(length);
                parts.push((length, Law::constant(value) + rise));
                value += end;
            }
            Law::sequence(random.between(0.0, 0.5), parts)
        }
        1 => {
            Law::sine(random.between(0.1, 1.0), random.between(0.5, 60.0), random.between(0.0, 6.0))
        }
        2 => {
            let count = 4 + random.below(12);
            let table: Vec<(f64, f64)> = (0..=count)
                .map(|k| (4.0 * k as f64 / count as f64, random.between(-1.0, 1.0)))
                .collect();
            Law::spline(&table, Ends::Natural)
        }
        3 => {
            let h = random.between(0.2, 1.0);
            let length = random.between(0.05, 0.3);
            let up = Law::cycloidal(h, length);
            let down = Law::constant(h) - Law::cycloidal(h, length);
            let rest = random.between(0.05, 0.3);
            let parts = [
                (length, up),
                (rest, Law::constant(h)),
                (length, down),
                (rest, Law::constant(0.0)),
            ];
            Law::sequence(0.0, parts).periodic(2.0 * (length + rest))
        }
        4 => random_law(random, depth - 1) + random_law(random, depth - 1),
        _ => random.between(-2.0, 2.0) * random_law(random, depth - 1),
    }
}

/// The largest value of a function between 0 and 4 by itself: at many places, then by thirds about
/// the best ones.
fn largest(value: &impl Fn(f64) -> f64, sign: f64) -> f64 {
    const PLACES: usize = 8000;
    let at = |x: f64| sign * value(x);
    let x = |k: usize| 4.0 * k as f64 / PLACES as f64;
    let values: Vec<f64> = (0..=PLACES).map(|k| at(x(k))).collect();
    let best = values.iter().fold(f64::MIN, |m, v| m.max(*v));
    let near_best = (0..=PLACES).filter(|k| {
        let beside =
            [k.saturating_sub(1), (k + 1).min(PLACES)].map(|j| (values[j] - values[*k]).abs());
        values[*k] + beside[0].max(beside[1]) >= best
    });
    let refined = near_best.map(|k| {
        let mut a = x(k.saturating_sub(1));
        let mut b = x((k + 1).min(PLACES));
        for _ in 0..60 {
            let p = a + (b - a) / 3.0;
            let q = b - (b - a) / 3.0;
            if at(p) < at(q) { a = p } else { b = q }
        }
        at(0.5 * (a + b))
    });
    sign * refined.fold(best, f64::max)
}

/// 40 random laws, or as many as `KIN_CAMPAIGN` says from `KIN_FIRST` on, on grids of 3 to 30
/// times.
#[test]
fn extremes_of_random_laws_do_not_depend_on_the_grid() {
    let count: u64 = std::env::var("KIN_CAMPAIGN").ok().and_then(|n| n.parse().ok()).unwrap_or(40);
    let first: u64 = std::env::var("KIN_FIRST").ok().and_then(|n| n.parse().ok()).unwrap_or(0);
    for seed in first..first + count {
        let mut random = Random(seed.wrapping_mul(7919) + 17);
        let law = random_law(&mut random, 2);
        // A third of them have kinks: a second coordinate is the distance from a number.
        let folded_at = (random.below(3) == 0).then(|| law.at(random.between(0.0, 4.0)));
        let (system, x) = match folded_at {
            None => followed(&law, 0.0),
            Some(c) => followed_at_a_distance(&law, c),
        };
        let value = |t: f64| folded_at.map_or(law.at(t), |c| (law.at(t) - c).abs());
        let answer = |count: usize| {
            let motion = system.run(linspace(0.0, 4.0, count));
            let motion = motion.unwrap_or_else(|error| panic!("{seed}, {count} times: {error}"));
            system.extremes(&motion, x).expect("extremes")
        };
        let fine = answer(2001);
        let coarse = 3 + random.below(28);
        let found = answer(coarse);
        let [most, least] = [largest(&value, 1.0), largest(&value, -1.0)];
        let size = most.abs().max(least.abs());
        let said = |what: &str, a: f64, b: f64| {
            assert!(
                (a - b).abs() <= 1e-9 * size.max(1e-3),
                "{seed}, {coarse} times: {what} {a}, it is {b}; {law:?}"
            );
        };
        said("max", found.max().value, most);
        said("min", found.min().value, least);
        said("max of the fine grid", fine.max().value, most);
        said("stroke", found.stroke(), fine.stroke());
        match (found.time_ratio(), fine.time_ratio()) {
            (Some(a), Some(b)) => {
                assert!((a - b).abs() <= 1e-9 * b, "{seed}: ratio {a}, it is {b}; {law:?}")
            }
            (a, b) => assert_eq!(a, b, "{seed}; {law:?}"),
        }
    }
}

/// A stop that is touched for so short that no time of a grid sees it: its two kinks are events,
/// and its smallest value is found, on each grid.
#[test]
fn two_kinks_within_one_step_are_found_on_every_grid() {
    let law = Law::sine(0.3, 20.0, 0.7);
    for short in [1e-2, 1e-4] {
        let c = 0.3 * (1.0 - short);
        let (system, y) = followed_at_a_distance(&law, c);
        let periods = (0..40)
            .map(|k| (0.5 * PI - 0.7 + TAU * f64::from(k)) / 20.0)
            .filter(|t| *t < 4.0)
            .count();
        for count in [5, 30, 101, 333, 2001] {
            let motion = system.run(linspace(0.0, 4.0, count)).unwrap();
            assert_eq!(motion.events().len(), 2 * periods, "{short}, {count} times");
            let found = system.extremes(&motion, y).unwrap();
            near(found.min().value, 0.0, 1e-12);
            near(found.max().value, 0.3 + c, 1e-12);
        }
    }
}
