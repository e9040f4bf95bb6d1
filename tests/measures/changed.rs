//! Extremes, crossings and poses exactly at a change point, where the equations are singular.

use kin::prelude::*;
use kin::{Follow, SolverOptions};

use crate::near;

/// A parallelogram with cranks of 1 and a coupler of 2, its first crank by a law: flat at 0 and π.
fn parallelogram(law: Law, from: f64) -> (System, Link, Link) {
    let mut m = Mechanism::new("parallelogram");
    let [a, b, c] = [("crank", 1.0), ("coupler", 2.0), ("rocker", 1.0)]
        .map(|(name, length)| m.link(name, length).unwrap());
    m.add("O", revolute(Ground, a, vec2(0.0, 0.0), a.start())).unwrap();
    m.add("A", revolute(a, b, a.end(), b.start())).unwrap();
    m.add("B", revolute(b, c, b.end(), c.end())).unwrap();
    m.add("C", revolute(c, Ground, c.start(), vec2(2.0, 0.0))).unwrap();
    m.add("motor", drive_angle(a, law)).unwrap();
    let x = from.cos();
    let y = from.sin();
    m.set_pose(a, pose(0.5 * x, 0.5 * y, from)).unwrap();
    m.set_pose(b, pose(x + 1.0, y, 0.0)).unwrap();
    m.set_pose(c, pose(2.0 + 0.5 * x, 0.5 * y, from)).unwrap();
    (m.build().unwrap(), b, c)
}

/// A slider-crank with links of 1: at 90° the slider is at the crank's bearing.
fn equal_links(law: Law) -> System {
    let mut m = Mechanism::new("equal links");
    let [crank, rod] =
        [("crank", 1.0), ("rod", 1.0)].map(|(name, length)| m.link(name, length).unwrap());
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).unwrap();
    m.add("g", point_on_line(rod, m.ground(), rod.end(), vec2(0.0, 0.0), vec2(1.0, 0.0))).unwrap();
    m.add("motor", drive_angle(crank, law)).unwrap();
    m.prefer(rod, -0.1);
    m.build().unwrap()
}

/// The coupler of a parallelogram is furthest left and right where it is flat.
#[test]
fn extremes_at_the_change_points_of_a_parallelogram() {
    for (count, start) in [(7, 0.3), (31, 0.3), (31, 0.4 * PI), (62, 0.3), (721, 0.4 * PI)] {
        let (system, coupler, rocker) = parallelogram(Law::linear(start, TAU), start);
        let motion = system.run(linspace(0.0, 3.0, count)).unwrap();
        for (what, mean) in [(coupler.x(), 1.0), (rocker.x(), 2.0)] {
            let found = system.extremes(&motion, what).unwrap();
            let size = if what == coupler.x() { 1.0 } else { 0.5 };
            assert_eq!(found.all().len(), 6, "{count} {found:?}");
            for (k, extreme) in found.all().iter().enumerate() {
                near(extreme.t, ((k + 1) as f64 * PI - start) / TAU, 1e-9);
                near(extreme.value, mean + if k % 2 == 0 { -size } else { size }, 1e-11);
                assert_eq!(extreme.is_max, k % 2 == 1);
            }
            near(found.time_ratio().unwrap(), 1.0, 1e-8);
        }
    }
}

/// The crank's end is highest, the rod is in the middle of its turn, and the slider passes zero,
/// all of them at the change point; and the same where the run turns into the other branch.
#[test]
fn extremes_and_crossings_at_the_change_point_of_equal_links() {
    // θ = π/2 at 1.2 t + 0.3 t²
    let at = (-1.2 + (1.44 + 0.6 * PI).sqrt()) / 0.6;
    let system = equal_links(Law::polynomial(&[0.0, 1.2, 0.3]));
    let turning = SolverOptions::new().follow(Follow::OtherBranchAt(vec![0]));
    for times in [linspace(0.0, 1.9, 5), linspace(0.0, 1.9, 400), linspace(0.0, 1.5 * at, 4)] {
        for (options, goes_on) in [(SolverOptions::default(), true), (turning.clone(), false)] {
            let motion = system.solver().options(options.clone()).run(&times).unwrap();
            let found = system.extremes(&motion, "crank.R_y").unwrap();
            let [top] = found.all() else { panic!("{found:?}") };
            near(top.t, at, 1e-9);
            near(top.value, 0.5, 1e-12);
            assert!(top.is_max);
            let half = system.extremes(&motion, "rod.R_y").unwrap();
            if goes_on {
                // the rod's middle is as high as the crank's
                let [top] = half.all() else { panic!("{half:?}") };
                near(top.t, at, 1e-9);
                near(top.value, 0.5, 1e-10);
                let [crossing] = system.crossings(&motion, "g.slide", 0.0).unwrap()[..] else {
                    panic!()
                };
                near(crossing.t, at, 1e-9);
                assert!(!crossing.rises);
                let [crossing] = system.crossings(&motion, "crank.theta", 0.5 * PI).unwrap()[..]
                else {
                    panic!()
                };
                near(crossing.t, at, 1e-12);
            }
            let pose = system.at(&motion, at).unwrap();
            near(pose.named("rod.theta").unwrap().value.values()[0], -0.5 * PI, 1e-9);
            let rate = pose.named("rod.theta").unwrap().rate.values()[0];
            let turn = 1.2 + 0.6 * at;
            near(rate, if goes_on { -turn } else { turn }, 1e-7);
        }
    }
}
