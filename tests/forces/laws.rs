//! Efforts of drivers by their laws, where rows are not x(q) − f(t): against closed forms, and
//! effort · ḟ against the power.

use kin::Mechanism;
use kin::forces::{Drive, Forces};
use kin::prelude::*;

const O: Vec2 = Vec2::new(0.0, 0.0);
const MASS: f64 = 2.5;

fn at(law: &Law, t: f64) -> [f64; 3] {
    let [f, f1, f2, _] = law.jet(t);
    [f, f1, f2]
}

/// Names and units, and that effort · ḟ of all laws is the power of the driver.
fn checked(drive: &Drive, laws: &[Law], named: &[(&str, &str)]) {
    let told: Vec<(&str, &str)> =
        drive.efforts().iter().map(|one| (one.name(), one.unit())).collect();
    assert_eq!(told, named);
    let size = drive.power().max().abs().max(drive.power().min().abs());
    assert!(size > 0.1, "{size}");
    for (k, t) in drive.power().times().iter().enumerate() {
        let each = drive
            .efforts()
            .iter()
            .zip(laws)
            .map(|(effort, law)| effort.values()[k] * law.jet(*t)[1]);
        let off = (each.sum::<f64>() - drive.power().values()[k]).abs();
        assert!(off < 1e-12 * (1.0 + size), "{t}: {off:e} of {size}");
    }
}

/// A load that is moved on a table which turns itself.
#[test]
fn a_point_that_moves_in_a_body_has_an_effort_for_each_of_its_laws() {
    let turn = Law::sine(0.8, 1.3, 0.2);
    let x = Law::sine(0.3, 2.0, 0.0) + Law::constant(0.7);
    let y = Law::sine(0.4, 1.1, 0.5);
    let mut m = Mechanism::new("table");
    let table = m.planar("table", pose(0.0, 0.0, 0.0)).unwrap();
    let load = m.planar("load", pose(0.7, 0.2, 0.0)).unwrap();
    m.add("pin", revolute(table, m.ground(), O, O)).unwrap();
    m.add("motor", drive_angle(table, turn.clone())).unwrap();
    m.add("tip", moving_point(table, load, x.clone(), y.clone(), O)).unwrap();
    m.add("held", drive_angle(load, Law::constant(0.3))).unwrap();
    m.mass(load, MASS, O, 0.2).unwrap();
    m.gravity(vec2(0.0, -9.81));
    let system = m.build().unwrap();
    let motion = system.run(linspace(0.0, 3.0, 61)).unwrap();
    let forces = system.forces(&motion).unwrap();
    let drive = forces.drive("tip").unwrap();
    checked(&drive, &[x.clone(), y.clone()], &[("tip.x_i", "N"), ("tip.y_i", "N")]);
    let mut off = 0.0_f64;
    for (k, &t) in motion.times().iter().enumerate() {
        let [a, w, alpha] = at(&turn, t);
        let [x, vx, ax] = at(&x, t);
        let [y, vy, ay] = at(&y, t);
        // Lagrange's equations of x and y as seen from the table, with the weight turned into its
        // axes.
        let f_x = MASS * (ax - w * w * x - 2.0 * w * vy - alpha * y + 9.81 * a.sin());
        let f_y = MASS * (ay - w * w * y + 2.0 * w * vx + alpha * x + 9.81 * a.cos());
        let found = [0, 1].map(|law| drive.efforts()[law].values()[k]);
        off = off.max((found[0] - f_x).abs()).max((found[1] - f_y).abs());
    }
    println!("off by {off:.1e}");
    assert!(off < 1e-11 && forces.balance().worst() < 1e-12, "{off:e} {}", forces.balance());
    assert_eq!(drive.effort().name(), "tip.x_i");
    assert!(forces.columns().iter().any(|column| column.name() == "tip.y_i"));
}

/// The same point in space.
#[test]
fn a_point_that_moves_in_space_too() {
    let laws = [
        Law::sine(0.3, 2.0, 0.0) + Law::constant(0.7),
        Law::sine(0.4, 1.1, 0.5),
        Law::sine(0.2, 1.7, 1.0),
    ];
    let mut m = Mechanism::new("crane");
    let load = m.spatial("load", SpatialPose::at(vec3(0.7, 0.2, 0.2))).unwrap();
    let o = vec3(0.0, 0.0, 0.0);
    let z = vec3(0.0, 0.0, 1.0);
    let ground = m.ground();
    let post = m.spatial("post", SpatialPose::at(o)).unwrap();
    m.add("pin", spatial::revolute(post, ground, o, o, z, z)).unwrap();
    m.add("motor", spatial::drive_turn(post, ground, z, z, Law::constant(0.4))).unwrap();
    let [x, y, h] = laws.clone();
    m.add("tip", spatial::moving_point(post, load, x, y, h, o)).unwrap();
    m.add("upright", spatial::parallel(load, ground, z, z)).unwrap();
    m.add("held", spatial::drive_turn(load, ground, z, z, Law::constant(0.0))).unwrap();
    let inertia = [[0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]];
    m.mass(load, MASS, o, inertia).unwrap();
    m.gravity(vec3(0.0, 0.0, -9.81));
    let system = m.build().unwrap();
    let motion = system.run(linspace(0.0, 3.0, 31)).unwrap();
    let forces = system.forces(&motion).unwrap();
    let drive = forces.drive("tip").unwrap();
    checked(&drive, &laws, &[("tip.x_i", "N"), ("tip.y_i", "N"), ("tip.z_i", "N")]);
    for (k, &t) in motion.times().iter().enumerate() {
        // The post stands still: each law moves the load along one of its axes.
        let exact =
            [0, 1, 2].map(|n| MASS * (at(&laws[n], t)[2] + if n == 2 { 9.81 } else { 0.0 }));
        for (n, exact) in exact.into_iter().enumerate() {
            assert!((drive.efforts()[n].values()[k] - exact).abs() < 1e-11, "{t} {n}");
        }
    }
}

/// A leg by its square: |d|² − l(t)² = 0.      [m²]
#[constraint]
fn leg(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, length: Law, t: Time) -> f64 {
    let l = length.at(t);
    (i.point(u_i) - j.point(u_j)).norm_squared() - l * l
}

/// A rack by a wheel: the way along h is r f(t).      [m]
#[constraint]
fn by_wheel(i: Planar, u_i: Vec2, h: Vec2, radius: f64, turn: Law, t: Time) -> f64 {
    h.dot(i.point(u_i)) - radius * turn.at(t)
}

/// A crank that a leg, or a wheel, drives.
fn crank(driver: &dyn Fn(&mut Mechanism, Link)) -> System {
    let mut m = Mechanism::new("crank");
    let crank = m.link("crank", 1.0).unwrap();
    m.add("pin", revolute(crank, m.ground(), crank.start(), O)).unwrap();
    driver(&mut m, crank);
    m.prefer(crank, 0.8);
    m.mass(crank, MASS, vec2(0.1, 0.05), 0.3).unwrap();
    m.gravity(vec2(0.0, -9.81));
    m.build().unwrap()
}

fn asked(system: &System) -> Drive {
    let motion = system.run(linspace(0.0, 3.0, 31)).unwrap();
    let forces: Forces<'_> = system.forces(&motion).unwrap();
    forces.drive("driver").unwrap()
}

#[test]
fn a_leg_by_its_square_gives_the_force_of_one_by_its_length() {
    let law = Law::constant(1.1) + Law::sine(0.2, 2.0, 0.0);
    let foot = vec2(1.5, -0.3);
    let by_square = crank(&|m, crank| {
        let leg = leg(crank, m.ground(), crank.end(), foot, law.clone());
        m.add("driver", leg).map(drop).unwrap();
    });
    let by_length = crank(&|m, crank| {
        let drive = drive_distance(crank, m.ground(), crank.end(), foot, law.clone());
        m.add("driver", drive).map(drop).unwrap();
    });
    let square = asked(&by_square);
    let length = asked(&by_length);
    let laws = [law];
    checked(&square, &laws, &[("driver", "N")]);
    checked(&length, &laws, &[("driver", "N")]);
    for (a, b) in square.effort().values().iter().zip(length.effort().values()) {
        assert!((a - b).abs() < 1e-11 * (1.0 + b.abs()), "{a} {b}");
    }
}

#[test]
fn a_law_whose_kind_no_formula_decides_has_the_unit_of_energy() {
    let law = Law::constant(2.0) + Law::sine(0.5, 2.0, 0.0);
    let system = crank(&|m, crank| {
        let wheel = by_wheel(crank, crank.end(), vec2(1.0, 0.0), 0.25, law.clone());
        m.add("driver", wheel).map(drop).unwrap();
    });
    checked(&asked(&system), &[law], &[("driver", "J per unit of its law")]);
}
