//! A motor too many, begun at values at which bodies stand in line: the error names the motor, not
//! a length that would fit at that moment alone.

use kin::diagnosis::Change;
use kin::prelude::*;

use crate::models::*;

/// The constraints that could be removed; nothing else may be advised.
fn removed(m: Mechanism) -> Vec<String> {
    let error = m.build().unwrap().run([0.0]).unwrap_err();
    let found = error.diagnosis().unwrap_or_else(|| panic!("{error}")).clone();
    let [Change::Remove { constraint, or }] = &found.changes[..] else { panic!("{error}") };
    assert!(!error.to_string().contains("make `"), "{error}");
    let mut all: Vec<String> = [constraint.clone()].into_iter().chain(or.iter().cloned()).collect();
    all.sort();
    all
}

#[test]
fn two_motors_that_begin_alike() {
    for (first, second) in [(0.0, 0.0), (0.0, 0.1), (0.0, PI), (PI, 0.0), (PI, PI), (0.5, 0.0)] {
        for drawn in [true, false] {
            let (mut m, [crank, coupler, rocker]) = four_bar();
            if !drawn {
                for link in [crank, coupler, rocker] {
                    m.set_pose(link, pose(0.0, 0.0, 0.0)).unwrap();
                }
            }
            m.add("motor", drive_angle(crank, Law::linear(first, 1.0))).unwrap();
            m.add("motor 2", drive_angle(rocker, Law::linear(second, 1.0))).unwrap();
            let all = removed(m);
            assert!(all.contains(&"motor 2".to_string()), "{first} {second} {drawn}: {all:?}");
        }
    }
}

#[test]
fn two_motors_of_a_slider_crank_that_begin_alike() {
    for offset in [0.0, 0.2] {
        let mut m = Mechanism::new("slider-crank");
        let crank = m.link("crank", 1.0).unwrap();
        let rod = m.link("rod", 3.0).unwrap();
        m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
        m.add("A", revolute(crank, rod, crank.end(), rod.start())).unwrap();
        m.add(
            "guide",
            point_on_line(rod, m.ground(), rod.end(), vec2(0.0, offset), vec2(1.0, 0.0)),
        )
        .unwrap();
        m.add("motor", drive_angle(crank, Law::linear(0.3, 1.0))).unwrap();
        m.add("motor 2", drive_angle(rod, Law::linear(0.3, 1.0))).unwrap();
        assert!(removed(m).contains(&"motor 2".to_string()));
    }
}
