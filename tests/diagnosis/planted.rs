//! Faults planted in mechanisms that are no four-bars, each told by its cause.

use kin::joints::drivers::spatial as drivers;
use kin::prelude::*;

use crate::engines::Engines;

/// Faults of the six-bar.
#[derive(Clone, Copy, PartialEq)]
enum Fault {
    None,
    /// The bodies of D in the wrong order: a plate, whose points are no ends, and a link.
    Exchanged,
    Degrees,
    SecondMotor,
    LongCrank,
}

/// A four-bar O A B C whose coupler, a plate, moves a second rocker by a rod D E.
fn six_bar(fault: Fault) -> Mechanism {
    let mut m = Mechanism::new("six-bar");
    let ground = m.ground();
    let crank = m.link("crank", if fault == Fault::LongCrank { 0.3 } else { 0.03 }).unwrap();
    let plate = m.planar("plate", pose(0.06, 0.05, 0.3)).unwrap();
    let [rocker, rod, arm] = [("rocker", 0.08), ("rod", 0.09), ("arm", 0.07)]
        .map(|(name, length)| m.link(name, length).unwrap());
    m.add("O", revolute(ground, crank, (0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, plate, crank.end(), (-0.05, 0.0))).unwrap();
    m.add("B", revolute(plate, rocker, (0.05, 0.0), rocker.end())).unwrap();
    m.add("C", revolute(ground, rocker, (0.11, 0.0), rocker.start())).unwrap();
    match fault {
        Fault::Exchanged => m.add("D", revolute(rod, plate, (0.01, 0.04), rod.start())).unwrap(),
        _ => m.add("D", revolute(plate, rod, (0.01, 0.04), rod.start())).unwrap(),
    };
    m.add("E", revolute(rod, arm, rod.end(), arm.end())).unwrap();
    m.add("F", revolute(ground, arm, (0.16, 0.06), arm.start())).unwrap();
    m.prefer(rocker, deg(100.0));
    let begin = if fault == Fault::Degrees { 60.0 } else { deg(60.0) };
    m.add("motor", drive_angle(crank, Law::linear(begin, 1.0))).unwrap();
    if fault == Fault::SecondMotor {
        m.add("second motor", drive_angle(arm, Law::constant(2.0))).unwrap();
    }
    m
}

fn told(fault: Fault) -> String {
    six_bar(fault)
        .build()
        .and_then(|system| system.run_both(linspace(0.0, 1.0, 21)))
        .unwrap_err()
        .to_string()
}

#[test]
fn right_six_bar_runs() {
    let motion = six_bar(Fault::None).build().unwrap().run_both(linspace(0.0, 1.0, 21)).unwrap();
    assert!(!motion.summary().contains("warning"), "{}", motion.summary());
}

#[test]
fn exchanged_bodies_of_a_plate_and_a_link() {
    let text = told(Fault::Exchanged);
    assert!(
        text.contains(
            "\n  The points of `D` are exchanged: (0.0100, 0.0400) m belongs to the frame of"
        ),
        "{text}"
    );
    assert!(
        text.contains(
            "Give the bodies of `D` in the order of the points: first `plate`, then `rod`"
        ),
        "{text}"
    );
}

/// 60 rad is out of reach, and 59.5 rad, where the crank would stand, is no answer to somebody who
/// meant 60°.
#[test]
fn degrees_that_are_out_of_reach() {
    let text = told(Fault::Degrees);
    assert!(
        text.contains(
            "`motor` requires crank.theta = 60.0000 rad (more than a turn from its guess)"
        ),
        "{text}"
    );
    assert!(
        text.contains("Give `motor` an angle in radians (`deg(60.0)` converts degrees)"),
        "{text}"
    );
}

#[test]
fn second_motor_of_a_six_bar() {
    let text = told(Fault::SecondMotor);
    assert!(
        text.contains("\n  `second motor` requires arm.theta = 2.0000 rad, which contradicts ")
            && text.contains("Remove `second motor`"),
        "{text}"
    );
}

#[test]
fn crank_of_a_six_bar_that_is_ten_times_too_long() {
    let text = told(Fault::LongCrank);
    assert!(
        text.contains("\n  One of these dimensions does not fit: `crank` is 0.300 m long")
            && text.contains("Make `crank` at most 0.2"),
        "{text}"
    );
}

/// A body in space does not show how often it has turned; its driver does.
#[test]
fn degrees_given_to_a_hinge_in_space() {
    let o = vec3(0.0, 0.0, 0.0);
    let y = vec3(0.0, 1.0, 0.0);
    let z = vec3(0.0, 0.0, 1.0);
    let summary = |angle: f64| {
        let mut m = Mechanism::new("crane");
        let tower = m.spatial("tower", SpatialPose::at(o)).unwrap();
        let jib = m.spatial("jib", SpatialPose::at(z * 2.0)).unwrap();
        m.add("slew", spatial::revolute(tower, m.ground(), o, o, z, z)).unwrap();
        m.add("luff", spatial::revolute(jib, tower, o, z * 2.0, y, y)).unwrap();
        m.add("slewing", drivers::drive_turn(tower, m.ground(), z, z, Law::ramp(0.5))).unwrap();
        m.add("luffing", drivers::drive_turn(jib, tower, y, y, Law::linear(angle, 0.1))).unwrap();
        m.build().unwrap().run_both(linspace(0.0, 1.0, 11)).unwrap().summary()
    };
    assert!(!summary(-deg(30.0)).contains("warning"), "{}", summary(-deg(30.0)));
    let text = summary(-30.0);
    assert!(
        text.contains("warning: The law of `luffing` has an angle of -30 rad (4.8 turns): ")
            && text.contains("`deg(-30.0)`"),
        "{text}"
    );
    // A number that is not round is no degrees for certain, but more than a turn.
    let text = summary(-31.4);
    assert!(
        text.contains("warning: `luffing` begins at -31.4 rad, more than a turn.")
            && text.contains("`deg(-31.4)`"),
        "{text}"
    );
}
