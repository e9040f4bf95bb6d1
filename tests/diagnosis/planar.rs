use kin::diagnosis::{Change, Class, Diagnosis, How, Level, Persistence};
use kin::error::FailureKind;
use kin::linspace;
use kin::prelude::*;

use crate::engines::Engines;
use crate::models::*;

fn report(found: &Diagnosis) {
    println!("{found}\n");
}

#[test]
fn third_crank_of_a_parallelogram_is_redundant() {
    let mut p = parallelogram(1.0, 1.0);
    p.mechanism.add("motor", drive_angle(p.cranks[0], Law::linear(1.0, 1.0))).unwrap();
    let found = p.mechanism.diagnose(0.0).unwrap();
    report(&found);
    assert_eq!(
        (found.coordinates, found.equations, found.rank, found.nearby_rank),
        (12, 13, 12, 12)
    );
    assert_eq!((found.gruebler, found.mobility, found.drivers), (0, 1, 1));
    assert!(found.can_be_driven() && !found.is_exactly_constrained());
    let [only] = &found.dependencies[..] else { panic!("{found}") };
    assert_eq!(only.class, Class::Redundant);
    // Forces in the three cranks and the coupler alone: no motor takes part.
    let mut names = only.constraints();
    names.sort_unstable();
    assert_eq!(names, ["A1", "A2", "A3", "O1", "O2", "O3"]);
    assert!(
        matches!(&found.changes[..], [Change::Drop { constraint, rows, .. }] if constraint == "O3" && rows.len() == 1),
        "{found}"
    );
}

#[test]
fn parallelogram_runs_through_whole_turns() {
    let mut p = parallelogram(1.0, 1.0);
    p.mechanism.add("motor", drive_angle(p.cranks[0], Law::linear(1.0, 2.0))).unwrap();
    let coupler = p.coupler;
    let times = linspace(0.0, 7.0, 701);
    let motion = p.mechanism.build().unwrap().run_both(&times).unwrap();
    let x = motion.coordinate(coupler.x()).unwrap();
    let theta = motion.coordinate(coupler.theta()).unwrap();
    for (k, t) in times.iter().enumerate() {
        let angle = 1.0 + 2.0 * t;
        assert!((x.value.values()[k] - angle.cos()).abs() < 1e-12, "position at {t}");
        assert!((x.rate.values()[k] + 2.0 * angle.sin()).abs() < 1e-11, "velocity at {t}");
        assert!(
            (x.second_rate.values()[k] + 4.0 * angle.cos()).abs() < 1e-11,
            "acceleration at {t}"
        );
        assert!(
            theta.value.values()[k].abs() < 1e-12 && theta.second_rate.values()[k].abs() < 1e-11
        );
    }
}

#[test]
fn contradictory_third_crank_is_named_with_its_gap() {
    let mut p = parallelogram(1.1, 1.0);
    p.mechanism.add("motor", drive_angle(p.cranks[0], Law::linear(1.0, 1.0))).unwrap();
    let error = p.mechanism.build().unwrap().run_both([0.0, 0.1]).unwrap_err();
    let found = error.diagnosis().unwrap();
    report(found);
    let [gap] = &found.gaps[..] else { panic!("{found}") };
    assert_eq!(gap.constraint, "O3");
    // The tip of the third crank moves on a circle of radius 1 about its pivot: 0.1 is missing at
    // every angle.
    assert!((gap.size() - 0.1).abs() < 1e-6, "{}", gap.size());
    let conflict = found.contradictions().next().unwrap();
    assert!(matches!(conflict.class, Class::Contradictory { level: Level::Position, .. }));
    assert!(
        conflict.constraints().contains(&"A3") && !conflict.constraints().contains(&"motor"),
        "{found}"
    );
    assert!(error.to_string().contains("`O3` contradicts"), "{error}");
}

/// A guide that is off by a ten-thousandth: the old place and the new one never read alike.
#[test]
fn advice_has_the_digits_of_what_it_changes() {
    let mut m = Mechanism::new("slider");
    let slider = m.planar("slider", pose(0.3, 4.0, 0.0)).unwrap();
    for (name, at) in [("guide 1", vec2(0.0, 4.0)), ("guide 2", vec2(1.0, 4.0001))] {
        m.add(name, prismatic(slider, m.ground(), vec2(0.0, 0.0), at, vec2(0.0, 1.0), 0.0))
            .unwrap();
    }
    m.add("motor", drive(slider.x(), Law::linear(0.3, 1.0))).unwrap();
    let error = m.build().unwrap().run([0.0]).unwrap_err().to_string();
    let place = error.split_once("ove `guide 2` from (").expect("advised").1;
    let (from, to) = place.split_once(" to (").expect("two places");
    assert!(from.contains(", 4.0001") && to.contains(", 4.0000"), "{error}");
}

#[test]
fn slider_in_two_guides_repeats_one_of_them() {
    let mut m = Mechanism::new("slider");
    let slider = m.planar("slider", pose(0.2, 0.1, 0.0)).unwrap();
    for (name, at) in [("guide 1", 0.0), ("guide 2", 1.0)] {
        m.add(
            name,
            prismatic(slider, m.ground(), vec2(0.0, 0.0), vec2(at, 0.0), vec2(0.0, 1.0), 0.0),
        )
        .unwrap();
    }
    m.add("motor", drive(slider.x(), Law::sine(0.3, 1.0, 0.0))).unwrap();
    let system = m.build().unwrap();
    let found = system.diagnose(0.0).unwrap();
    report(&found);
    assert_eq!((found.coordinates, found.equations, found.rank, found.mobility), (3, 5, 3, 1));
    assert_eq!(found.redundancies().count(), 2);
    for dependency in found.redundancies() {
        assert_eq!(dependency.terms[0].constraint, "guide 2");
        assert!(dependency.terms[1..].iter().all(|term| term.constraint == "guide 1"), "{found}");
    }
    assert_eq!(
        found.changes,
        [Change::Remove { constraint: "guide 2".into(), or: vec![] }].to_vec()
    );
    let motion = system.run_both(linspace(0.0, 6.0, 61)).unwrap();
    let x = motion.coordinate(slider.x()).unwrap();
    assert!(
        x.second_rate
            .values()
            .iter()
            .zip(linspace(0.0, 6.0, 61))
            .all(|(a, t)| (a + 0.3 * t.sin()).abs() < 1e-12)
    );
}

#[test]
fn two_drivers_that_contradict_in_position() {
    let (mut m, [crank, _, rocker]) = four_bar();
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    m.add("motor 2", drive_angle(rocker, Law::constant(2.0))).unwrap();
    let error = m.build().unwrap().run_both([0.0]).unwrap_err();
    let found = error.diagnosis().unwrap();
    report(found);
    assert_eq!((found.coordinates, found.equations, found.rank), (9, 10, 9));
    let [gap] = &found.gaps[..] else { panic!("{found}") };
    assert_eq!(gap.constraint, "motor 2");
    let asks = gap.asks.as_ref().unwrap();
    assert_eq!((asks.coordinate.as_str(), asks.asked), ("rocker.theta", 2.0));
    // Where the rocker stands by the law of cosines.
    let ax = 1.0_f64.cos();
    let ay = 1.0_f64.sin();
    let dx = ax - 4.0;
    let dy = ay;
    let d = dx.hypot(dy);
    let stands = dy.atan2(dx) - ((9.0 + d * d - 3.5 * 3.5) / (6.0 * d)).acos();
    assert!((asks.stands - stands).abs() < 1e-9, "{} {stands}", asks.stands);
    assert!(
        matches!(&found.changes[..], [Change::Remove { constraint, or }] if constraint == "motor 2" && or == &["motor"]),
        "{found}"
    );
    let text = error.to_string();
    assert!(
        text.contains(
            "`motor 2` requires rocker.theta = 2.0000 rad, which contradicts `motor` (crank.theta = 1.0000 rad), "
        ),
        "{text}"
    );
}

/// Where the other motor asks for what cannot be reached, it is not offered to keep it alone.
#[test]
fn of_two_drivers_the_one_that_cannot_be_kept_is_not_offered() {
    let (mut m, [crank, _, rocker]) = four_bar();
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    m.add("motor 2", drive_angle(rocker, Law::constant(1.2))).unwrap();
    let found = m.diagnose(0.0).unwrap();
    assert!(
        matches!(&found.changes[..], [Change::Remove { constraint, or }] if constraint == "motor 2" && or.is_empty()),
        "{found}"
    );
}

#[test]
fn two_drivers_that_contradict_in_velocity_only() {
    let (mut m, [crank, ..]) = four_bar();
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    m.add("motor 2", drive_angle(crank, Law::linear(1.0, 1.5))).unwrap();
    let error = m.build().unwrap().run_both([0.0, 0.1]).unwrap_err();
    let found = error.diagnosis().unwrap();
    report(found);
    assert!(found.gaps.is_empty());
    let [only] = &found.dependencies[..] else { panic!("{found}") };
    let Class::Contradictory { level: Level::Velocity, residual } = only.class else {
        panic!("{found}")
    };
    assert!((residual.abs() - 0.5).abs() < 1e-12);
    assert_eq!(only.constraints(), ["motor 2", "motor"]);
}

#[test]
fn two_drivers_that_contradict_in_acceleration_only() {
    let (mut m, [crank, ..]) = four_bar();
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    m.add("motor 2", drive_angle(crank, Law::polynomial(&[1.0, 1.0, 0.25]))).unwrap();
    let error = m.build().unwrap().run_both([0.0, 0.1]).unwrap_err();
    let found = error.diagnosis().unwrap();
    let [only] = &found.dependencies[..] else { panic!("{found}") };
    let Class::Contradictory { level: Level::Acceleration, residual } = only.class else {
        panic!("{found}")
    };
    assert!((residual.abs() - 0.5).abs() < 1e-12);
}

#[test]
fn missing_driver_is_a_freedom_with_its_centre() {
    let (m, _) = four_bar();
    let error = m.build().unwrap_err();
    let found = error.diagnosis().unwrap();
    report(found);
    assert_eq!(
        (found.coordinates, found.equations, found.rank, found.gruebler, found.mobility),
        (9, 8, 8, 1, 1)
    );
    let [freedom] = &found.freedoms[..] else { panic!("{found}") };
    assert_eq!((freedom.persistence, freedom.motions.len()), (Persistence::Always, 3));
    let How::TurnsAbout { point, .. } = freedom.motions[0].how else { panic!("{found}") };
    assert!(point[0].abs() < 1e-9 && point[1].abs() < 1e-9);
    let How::TurnsAbout { point, .. } = freedom.motions[2].how else { panic!("{found}") };
    assert!((point[0] - 4.0).abs() < 1e-9 && point[1].abs() < 1e-9);
    assert!(
        matches!(&found.changes[..], [Change::Drive { coordinate, .. }] if coordinate.ends_with(".theta"))
    );
    assert!(matches!(error.kind(), Some(FailureKind::CannotBeDriven)));
}

/// A double pendulum whose first angle is driven twice and whose second is not.
#[test]
fn square_count_that_hides_a_missing_driver() {
    let mut m = Mechanism::new("arm");
    let a = m.link("upper arm", 1.0).unwrap();
    let b = m.link("fore arm", 1.0).unwrap();
    m.set_pose(a, pose(0.4, 0.3, 0.6)).unwrap();
    m.set_pose(b, pose(1.2, 0.9, 0.7)).unwrap();
    m.add("shoulder", revolute(m.ground(), a, vec2(0.0, 0.0), a.start())).unwrap();
    m.add("elbow", revolute(a, b, a.end(), b.start())).unwrap();
    m.add("motor", drive_angle(a, Law::linear(0.6, 1.0))).unwrap();
    m.add("motor 2", drive(a.theta(), Law::linear(0.6, 1.0))).unwrap();
    m.add("reach", drive(a.x(), Law::constant(0.5 * 0.6_f64.cos()))).unwrap();
    // Nine coordinates would be three links: here there are six, six equations but one, and rank 5.
    let mut three = Mechanism::new("arm and hand");
    let links = ["upper arm", "fore arm", "hand"].map(|name| three.link(name, 1.0).unwrap());
    three
        .add("shoulder", revolute(three.ground(), links[0], vec2(0.0, 0.0), links[0].start()))
        .unwrap();
    three.add("elbow", revolute(links[0], links[1], links[0].end(), links[1].start())).unwrap();
    three.add("wrist", revolute(links[1], links[2], links[1].end(), links[2].start())).unwrap();
    three.add("motor 1", drive_angle(links[0], Law::linear(0.6, 1.0))).unwrap();
    three.add("motor 2", drive_angle(links[1], Law::linear(0.9, 1.0))).unwrap();
    three.add("motor 3", drive(links[0].theta(), Law::linear(0.6, 1.0))).unwrap();
    let system = three.build().unwrap();
    let found = system.diagnose(0.0).unwrap();
    report(&found);
    assert_eq!((found.coordinates, found.equations, found.rank, found.nearby_rank), (9, 9, 8, 8));
    assert!(found.count_misleads() && !found.can_be_driven());
    assert_eq!(found.redundancies().next().unwrap().constraints(), ["motor 3", "motor 1"]);
    let freedom = found.lasting_freedoms().next().unwrap();
    assert_eq!(freedom.motions[0].names, ["hand"]);
    assert_eq!(found.changes.len(), 2);
    let text = found.to_string();
    assert!(text.contains("only by chance") && text.contains("`hand` turns about"), "{text}");
}

/// Two bars between fixed pins that are just as far apart as the bars are long together.
#[test]
fn collinear_two_bar_gives_only_to_first_order() {
    let mut m = Mechanism::new("two bars");
    let a = m.link("left", 1.0).unwrap();
    let b = m.link("right", 1.0).unwrap();
    m.set_pose(a, pose(0.5, 0.0, 0.0)).unwrap();
    m.set_pose(b, pose(1.5, 0.0, 0.0)).unwrap();
    m.add("A", revolute(m.ground(), a, vec2(0.0, 0.0), a.start())).unwrap();
    m.add("B", revolute(a, b, a.end(), b.start())).unwrap();
    m.add("C", revolute(m.ground(), b, vec2(2.0, 0.0), b.end())).unwrap();
    let found = m.diagnose(0.0).unwrap();
    report(&found);
    assert_eq!((found.coordinates, found.equations, found.rank, found.nearby_rank), (6, 6, 5, 5));
    assert!(!found.moves && !found.can_be_driven());
    assert_eq!((found.gruebler, found.mobility), (0, 0));
    assert_eq!(found.freedoms[0].persistence, Persistence::Infinitesimal);
    assert_eq!(found.dependencies[0].class, Class::OnlyHere);
    // Either of them could be another length.
    assert!(
        matches!(&found.changes[..], [Change::Resize { any }, Change::Loosen { constraints }] if any.len() == 2 && constraints == &["A", "B", "C"]),
        "{found}"
    );
    let text = found.to_string();
    assert!(text.contains("rigid but shaky: `left` and `right`"), "{text}");
}

/// Crank and coupler in line: the rocker is at its end, and a motor on it cannot drive.
#[test]
fn toggle_is_singular_only_here() {
    let (mut m, [crank, coupler, rocker]) = four_bar();
    // O, A, B in line at the distance 4.5, C at (4, 0), rocker 3.
    let angle = ((4.5_f64.powi(2) + 16.0 - 9.0) / (2.0 * 4.5 * 4.0)).acos();
    let along = |r: f64| (r * angle.cos(), r * angle.sin());
    let tip = along(4.5);
    m.set_pose(crank, pose(along(0.5).0, along(0.5).1, angle)).unwrap();
    m.set_pose(coupler, pose(along(2.75).0, along(2.75).1, angle)).unwrap();
    m.set_pose(rocker, pose(0.5 * (4.0 + tip.0), 0.5 * tip.1, tip.1.atan2(tip.0 - 4.0))).unwrap();
    m.add("motor", drive_angle(rocker, Law::linear(tip.1.atan2(tip.0 - 4.0), -1.0))).unwrap();
    let found = m.diagnose(0.0).unwrap();
    report(&found);
    assert_eq!((found.rank, found.nearby_rank), (8, 9));
    assert_eq!(found.dependencies[0].class, Class::OnlyHere);
    assert_eq!(found.freedoms[0].persistence, Persistence::OnlyHere);
    assert!(found.changes.is_empty());
}

/// The motor asks for an angle that the rocker cannot reach.
#[test]
fn run_beyond_a_toggle_ends_with_what_is_asked_and_what_can_be() {
    let (mut m, [_, _, rocker]) = four_bar();
    m.add("motor", drive_angle(rocker, Law::linear(2.2, -1.0))).unwrap();
    let error = m.build().unwrap().run_both(linspace(0.0, 2.0, 201)).unwrap_err();
    println!("{error}");
    let found = error.diagnosis().unwrap();
    let motion = error.motion().unwrap();
    assert!(motion.len() > 20);
    // Crank and coupler in line: the rocker's least angle.
    let least = std::f64::consts::PI - ((16.0 + 9.0 - 4.5_f64.powi(2)) / 24.0).acos();
    match &found.gaps[..] {
        [gap] => {
            let asks = gap.asks.as_ref().unwrap();
            assert_eq!(
                (gap.constraint.as_str(), asks.coordinate.as_str()),
                ("motor", "rocker.theta")
            );
            assert!((asks.stands - least).abs() < 1e-6, "{} {least}", asks.stands);
        }
        [] => assert!(found.rank < found.nearby_rank),
        _ => panic!("{found}"),
    }
}

#[test]
fn loop_that_cannot_close_is_told_with_its_gap() {
    let mut m = Mechanism::new("short coupler");
    let ground = m.ground();
    let crank = m.link("crank", 1.0).unwrap();
    let coupler = m.link("coupler", 0.5).unwrap();
    let rocker = m.link("rocker", 1.5).unwrap();
    m.add("O", revolute(ground, crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(ground, rocker, vec2(4.0, 0.0), rocker.start())).unwrap();
    m.add("motor", drive_angle(crank, Law::constant(0.5))).unwrap();
    let error = m.build().unwrap().run_both([0.0]).unwrap_err();
    println!("{error}");
    let found = error.diagnosis().unwrap();
    let [gap] = &found.gaps[..] else { panic!("{found}") };
    // With the crank at 0.5 rad the rest spans 2 of the distance from its tip to C.
    let missing = (4.0 - 0.5_f64.cos()).hypot(0.5_f64.sin()) - 2.0;
    match gap.constraint.as_str() {
        "motor" => assert!(gap.asks.is_some()),
        name => {
            assert!(["A", "B", "C", "O"].contains(&name));
            assert!((gap.size() - missing).abs() < 1e-5, "{} {missing}", gap.size());
        }
    }
}
