//! Positions by wishes: points that are dragged, measures and coordinates that are wanted, limits.

use kin::data::Registry;
use kin::prelude::*;
use kin::solver::{Released, Wish};

#[path = "../data/own.rs"]
mod own;

/// An arm of links in the plane, hinged to the ground at the origin.
fn arm(lengths: &[f64], angles: &[f64]) -> (Mechanism, Vec<Link>) {
    let mut m = Mechanism::new("arm");
    let mut links: Vec<Link> = Vec::new();
    for (k, (length, angle)) in lengths.iter().zip(angles).enumerate() {
        let link = m.link(&format!("link {k}"), *length).unwrap();
        match links.last() {
            None => m.add("joint 0", revolute(Ground, link, vec2(0.0, 0.0), link.start())),
            Some(before) => {
                m.add(&format!("joint {k}"), revolute(*before, link, before.end(), link.start()))
            }
        }
        .unwrap();
        m.guess(link.theta(), *angle).unwrap();
        links.push(link);
    }
    (m, links)
}

fn tip(released: &Released, link: Link) -> Vec2 {
    released.motion().point(link, link.end()).unwrap().r()[0]
}

/// The largest residual of the equations without drivers.
fn residual_of_joints(released: &Released) -> f64 {
    let system = released.system();
    let c = system.residual(released.q(), released.t0()).unwrap();
    let rows = system.constraints().flat_map(|(_, constraint)| {
        let facts = constraint.facts();
        facts.rows.iter().map(move |_| facts.dependence.c_on_t)
    });
    let joints = c.iter().zip(rows).filter(|(_, is_driver)| !is_driver);
    joints.fold(0.0, |most, (c, _)| c.abs().max(most))
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// A point within reach is reached, with the elbow on its side: the angles are those of the closed
/// form.
#[test]
fn an_arm_reaches_a_point_on_its_branch() {
    let (m, links) = arm(&[0.5, 0.4], &[0.4, 1.2]);
    let mut random = fastrand::Rng::with_seed(1);
    for _ in 0..200 {
        let mut arm = m.released(0.0).unwrap();
        let radius = 0.15 + 0.7 * random.f64();
        let angle = 0.4 + 2.0 * (random.f64() - 0.5);
        let to = vec2(radius * angle.cos(), radius * angle.sin());
        let reached = arm.drag(links[1], links[1].end(), to).unwrap();
        assert!(reached.wishes[0].is_met, "{reached:?}");
        assert!(reached.freedoms.is_empty());
        // The law of cosines, elbow on the left of the lower link's way back.
        let elbow = ((radius * radius + 0.25 - 0.16) / (2.0 * radius * 0.5)).acos();
        let upper = angle - elbow;
        let theta = arm.coordinate("link 0.theta").unwrap();
        assert!((theta - upper).abs() < 1e-9, "{theta} {upper}");
        assert!(residual_of_joints(&arm) < 1e-12);
    }
}

/// A point out of reach: the arm is stretched towards it, the wish is missed by the rest, and the
/// answer never says that it was met.
#[test]
fn an_arm_stretches_towards_what_it_cannot_reach() {
    let (m, links) = arm(&[0.5, 0.4], &[0.4, 1.2]);
    for distance in [0.95, 1.5, 10.0] {
        let mut arm = m.released(0.0).unwrap();
        let to = vec2(0.0, distance);
        let reached = arm.drag(links[1], links[1].end(), to).unwrap();
        let wish = &reached.wishes[0];
        assert!(!wish.is_met);
        assert!((wish.missed - (distance - 0.9)).abs() < 1e-9, "{wish}");
        assert_eq!(wish.unit, "m");
        assert!((tip(&arm, links[1]) - vec2(0.0, 0.9)).norm() < 1e-5, "{distance}");
        // Back within reach it bends again.
        let again = arm.drag(links[1], links[1].end(), vec2(0.1, 0.6)).unwrap();
        assert!(again.wishes[0].is_met, "{again:?}");
    }
}

/// Wishes of a smaller priority count first: the later one gets what the earlier ones leave.
#[test]
fn later_wishes_get_what_earlier_ones_leave() {
    let (m, links) = arm(&[0.5, 0.4, 0.3], &[0.4, 1.2, 0.1]);
    let last = links[2];
    let mut arm = m.released(0.0).unwrap();
    let to = vec2(0.2, 0.7);
    let reached = arm
        .reach([Wish::measure("link 2.theta", 0.5).priority(1), Wish::point(last, last.end(), to)]);
    let reached = reached.unwrap();
    assert!(reached.wishes.iter().all(|wish| wish.is_met), "{reached:?}");
    assert!((arm.coordinate("link 2.theta").unwrap() - 0.5).abs() < 1e-9);
    assert!((tip(&arm, last) - to).norm() < 1e-9);

    // Two wishes for one point contradict each other: the first one wins.
    let other = vec2(-0.3, 0.4);
    let first = Wish::point(last, last.end(), other);
    let second = Wish::point(last, last.end(), to).priority(7);
    let reached = arm.reach([second, first]).unwrap();
    assert!(reached.wishes[0].is_met && !reached.wishes[1].is_met, "{reached:?}");
    assert!((reached.wishes[1].missed - (to - other).norm()).abs() < 1e-9);
    assert_eq!(reached.freedoms.len(), 1);

    // Of equal wishes the middle is the answer.
    let reached = arm.reach([other, to].map(|to| Wish::point(last, last.end(), to))).unwrap();
    assert!((tip(&arm, last) - 0.5 * (to + other)).norm() < 1e-7, "{reached:?}");
}

fn four_bar(lengths: [f64; 4]) -> (Mechanism, Link, Link, Link) {
    let mut m = Mechanism::new("four-bar");
    let [crank, coupler, rocker] =
        [("crank", lengths[0]), ("coupler", lengths[1]), ("rocker", lengths[2])]
            .map(|(name, length)| m.link(name, length).unwrap());
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(Ground, rocker, vec2(lengths[3], 0.0), rocker.start())).unwrap();
    (m, crank, coupler, rocker)
}

/// One freedom and a point of the plane: the mechanism goes to the nearest position of its curve,
/// also through the dead centres of its crank.
#[test]
fn a_four_bar_follows_the_hand_to_the_nearest_point_of_its_curve() {
    const BESIDE: f64 = 0.02;
    let (mut m, crank, coupler, _) = four_bar([2.0, 1.5, 2.2, 3.5]);
    m.add("motor", drive_angle(crank, Law::constant(0.3))).unwrap();
    let system = m.build().unwrap();
    let circuit = system.circuit("motor", 4001).unwrap();
    assert_eq!(circuit.dead_centres().len(), 2);
    let mut followed = 0;
    for local in [vec2(0.7, 0.3), vec2(0.7, 1.5), vec2(0.2, -1.0), vec2(2.5, 0.4), vec2(1.6, 1.1)] {
        let curve = circuit.motion().point(coupler, local).unwrap();
        // The nearest point is the one that the hand is beside, if the curve bends gently.
        let radius = |k: usize| {
            let [v, a] = [curve.v()[k], curve.a()[k]];
            v.norm().powi(3) / (v.x * a.y - v.y * a.x).abs()
        };
        if (0..4001).any(|k| radius(k) < 3.0 * BESIDE) {
            continue;
        }
        followed += 1;
        let mut released = system.released(0.0).unwrap();
        assert_eq!(released.freedoms(), ["crank.theta"]);
        for k in (0..4001).step_by(10) {
            let r = curve.r()[k];
            let v = curve.v()[k];
            let hand = r + vec2(-v.y, v.x) * (BESIDE / v.norm());
            let reached = released.drag(coupler, local, hand).unwrap();
            let now = released.motion().point(coupler, local).unwrap().r()[0];
            assert!((now - r).norm() < 1e-7, "{k}: {reached:?}");
            assert!((reached.wishes[0].missed - BESIDE).abs() < 1e-9, "{k}: {reached:?}");
            assert!(residual_of_joints(&released) < 1e-12);
        }
    }
    assert!(followed >= 2, "{followed}");
}

/// Limits are kept, and the answer names those at which the mechanism stands.
#[test]
fn limits_are_kept() {
    let (mut m, links) = arm(&[0.5, 0.4, 0.3], &[0.4, 1.2, 0.1]);
    m.limit("link 0.theta", 0.2, 0.9).unwrap();
    m.limit("joint 1.angle", -1.5, 1.5).unwrap();
    let last = links[2];
    let mut random = fastrand::Rng::with_seed(3);
    let mut arm = m.released(0.0).unwrap();
    let mut stood = 0;
    for _ in 0..200 {
        let to = vec2(2.0 * random.f64() - 1.0, 2.0 * random.f64() - 1.0);
        let reached = arm.drag(last, last.end(), to).unwrap();
        let theta = arm.coordinate("link 0.theta").unwrap();
        let bend = arm.measure("joint 1.angle").unwrap();
        assert!((0.2 - 1e-9..=0.9 + 1e-9).contains(&theta), "{theta}");
        assert!((-1.5 - 1e-9..=1.5 + 1e-9).contains(&bend), "{bend}");
        stood += reached.limits.len();
        if !reached.wishes[0].is_met {
            let far = (tip(&arm, last) - to).norm();
            assert!((far - reached.wishes[0].missed).abs() < 1e-9);
        }
    }
    assert!(stood > 50, "{stood}");
}

/// Every example with its drivers released: coordinates are pulled about at random. The equations
/// hold, each wish that is called met is met, the rank tells as many freedoms as there are, and
/// where nothing else is free the way back ends at the start.
#[test]
fn every_example_is_dragged() {
    let root = env!("CARGO_MANIFEST_DIR");
    let registry = Registry::new()
        .with::<own::slider_crank>()
        .with::<own::parabolic_slot>()
        .with::<own::geneva>();
    let mut files: Vec<_> = std::fs::read_dir(format!("{root}/tests/data/examples"))
        .unwrap()
        .map(|file| file.unwrap().path())
        .collect();
    files.sort();
    let each: usize = std::env::var("KIN_CAMPAIGN").map_or(4, |n| n.parse::<usize>().unwrap() / 25);
    let mut back = 0;
    for (seed, file) in (0..).zip(&files) {
        let system = Mechanism::read_json(file, &registry).unwrap().build().unwrap();
        let mut released = system.released(0.0).unwrap();
        let mut random = fastrand::Rng::with_seed(seed);
        let names = system.coordinate_names().to_vec();
        let own = residual_of_joints(&released);
        for _ in 0..each {
            let name = &names[random.usize(..names.len())];
            let before = released.clone();
            let from = released.q().to_vec();
            let value = released.coordinate(name).unwrap();
            let to = value + 0.4 * (random.f64() - 0.5);
            let reached = released.reach([Wish::measure(name, to)]).unwrap();
            let off = residual_of_joints(&released);
            assert!(off < 1e-10 + 2.0 * own, "{file:?}, {name}: {off:e}");
            let wish = &reached.wishes[0];
            let now = released.coordinate(name).unwrap();
            assert!(((now - to).abs() - wish.missed).abs() < 1e-12, "{file:?}: {wish}");
            assert_eq!(wish.is_met, (now - to).abs() < 1e-8, "{file:?}: {wish}");
            if wish.is_met && reached.freedoms.is_empty() && reached.limits.is_empty() {
                // A drag in ten parts leads to the same place.
                let mut slow = before.clone();
                for part in 1..=10 {
                    let value = value + (to - value) * f64::from(part) / 10.0;
                    slow.reach([Wish::measure(name, value)]).unwrap();
                }
                let other = apart(slow.q(), released.q());
                assert!(other < 1e-7, "{file:?}, {name}: {other:e}");
                let again = released.reach([Wish::measure(name, value)]).unwrap();
                assert!(again.wishes[0].is_met, "{file:?}, {name}: {again:?}");
                let apart = apart(released.q(), &from);
                assert!(apart < 1e-7, "{file:?}, {name}: {apart:e}");
                back += 1;
            }
        }
        let rank = released.freedoms().len();
        let known = system.diagnose((0.0, released.q())).unwrap().mobility;
        println!("{}: {rank} freedoms", file.file_name().unwrap().to_string_lossy());
        assert_eq!(rank, known, "{file:?}");
    }
    assert!(back > 20, "{back}");
}

/// A dimension that is set a thousand times larger is followed, and wishes are met at its scale.
#[test]
fn a_dimension_is_set_while_the_mechanism_is_released() {
    let mut m = Mechanism::new("crank and slider");
    let length = m.dimension("length", 0.5).unwrap();
    let crank = m.link("crank", length).unwrap();
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).unwrap();
    let mut released = m.released(0.0).unwrap();
    released.set("length", 500.0).unwrap();
    let to = vec2(300.0, 400.0);
    let reached = released.drag(crank, (250.0, 0.0), to).unwrap();
    assert!(reached.wishes[0].is_met, "{reached:?}");
    assert!((released.coordinate("crank.theta").unwrap() - 0.8_f64.asin()).abs() < 1e-9);
    assert!(released.set("length", -1.0).is_err());
    assert!(reached == released.drag(crank, (250.0, 0.0), to).unwrap());
}

#[test]
fn mistakes_leave_it_where_it_was() {
    let (m, links) = arm(&[0.5, 0.4], &[0.4, 1.2]);
    let mut arm = m.released(0.0).unwrap();
    let before = arm.q().to_vec();
    let stranger = arm_of_another();
    let wishes = [
        Wish::measure("no such", 0.1),
        Wish::hold("no such"),
        Wish::measure("link 0.theta", f64::NAN),
        Wish::measure("link 0.theta", f64::INFINITY),
        Wish::point(links[1], links[1].end(), vec2(f64::INFINITY, 0.0)),
        Wish::point(stranger, vec2(0.0, 0.0), vec2(0.0, 0.0)),
    ];
    for wish in wishes {
        let error = arm.reach([wish.clone()]).unwrap_err();
        assert!(!error.to_string().is_empty(), "{wish:?}");
        assert!(apart(arm.q(), &before) == 0.0);
    }
    let reached = arm.reach([]).unwrap();
    assert_eq!(reached.freedoms.len(), 2);
    assert!(apart(arm.q(), &before) < 1e-12);
}

fn arm_of_another() -> Link {
    let mut m = Mechanism::new("another");
    m.link("stranger", 1.0).unwrap()
}
