//! Loads written as energies against the same ones by hand, on both routes; the library against
//! closed forms.

use kin::extend::by_dual;
use kin::law::Ends;
use kin::prelude::*;
use kin::{Load, Mechanism, loads};

use crate::both::Engines;

/// A spring as an energy; its own, not the library's.      [J]
#[potential]
fn own_spring(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, k: f64, free: f64) -> f64 {
    let stretch = (i.point(u_i) - j.point(u_j)).norm() - free;
    0.5 * k * stretch * stretch
}

/// The same as a constraint, to be put on dual numbers.      [J]
#[constraint]
fn by_numbers(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, k: f64, free: f64) -> f64 {
    let stretch = (i.point(u_i) - j.point(u_j)).norm() - free;
    0.5 * k * stretch * stretch
}

/// Where a load pushes: body i against j, points P and Q.
const U: [Vec2; 2] = [Vec2::new(0.3, 0.1), Vec2::new(-0.2, 0.15)];

/// Two bodies of which everything is driven, with one load between them.
fn driven(
    load: impl FnOnce(&mut Mechanism, PlanarBody, PlanarBody) -> kin::Result<()>,
) -> (System, [PlanarBody; 2]) {
    let mut m = Mechanism::new("two bodies");
    let bodies = [("a", 0.9, 0.2), ("b", -0.4, 1.0)].map(|(name, x, y)| {
        let body = m.planar(name, pose(x, y, 0.0)).expect("a body");
        for (axis, coordinate, mean) in
            [("x", body.x(), x), ("y", body.y(), y), ("theta", body.theta(), 0.3)]
        {
            let law = Law::constant(mean) + Law::sine(0.2 * mean, 1.7, 0.4 * x);
            m.add(&format!("{name}.{axis}"), drive(coordinate, law)).expect("a driver");
        }
        body
    });
    load(&mut m, bodies[0], bodies[1]).expect("a load");
    (m.build().expect("a system"), bodies)
}

/// The force on body i at its point and the torque there, at each time.
fn on_first(system: &System, bodies: [PlanarBody; 2]) -> Vec<[f64; 3]> {
    let motion = system.run_both(linspace(0.0, 3.0, 31)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let acted = forces.load("load").expect("a load").on(bodies[0]).expect("its body").at(U[0]);
    let force = acted.force().expect("unique");
    let torque = acted.torque().expect("unique");
    // The drives take up all of it.
    let [x, y] =
        ["a.x", "a.y"].map(|name| forces.drive(name).expect("a driver").effort().values().to_vec());
    for (k, f) in force.iter().enumerate() {
        let off = (x[k] + f.x).abs().max((y[k] + f.y).abs());
        assert!(off < 1e-12 * (1.0 + f.norm()), "{off:e}");
    }
    force.iter().zip(torque).map(|(f, t)| [f.x, f.y, t]).collect()
}

/// The same by hand: `push` is the force apart along the line between the points, from l and l̇.
fn by_hand(
    system: &System,
    bodies: [PlanarBody; 2],
    push: impl Fn(f64, f64) -> f64,
) -> Vec<[f64; 3]> {
    let motion = system.run_both(linspace(0.0, 3.0, 31)).expect("a motion");
    let points = [0, 1].map(|k| motion.point(bodies[k], U[k]).expect("a point"));
    let at = |k: usize| {
        let d = points[0].r()[k] - points[1].r()[k];
        let v = points[0].v()[k] - points[1].v()[k];
        let l = d.norm();
        let f = d * (push(l, d.dot(v) / l) / l);
        [f.x, f.y, 0.0]
    };
    (0..motion.len()).map(at).collect()
}

fn near(found: &[[f64; 3]], exact: &[[f64; 3]], what: &str) {
    let size = exact.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let off = found
        .iter()
        .flatten()
        .zip(exact.iter().flatten())
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    println!("{what}: off by {off:.1e} of {size:.3}");
    assert!(size > 0.1 && off <= 1e-13 * (1.0 + size), "{what}: {off:e}");
}

#[test]
fn a_spring_as_an_energy_is_a_spring_by_hand_on_both_routes() {
    let k = 80.0;
    let free = 0.4;
    let push = |l: f64, _: f64| -k * (l - free);
    let own = driven(|m, i, j| m.load("load", own_spring(i, j, U[0], U[1], k, free)));
    let exact = by_hand(&own.0, own.1, push);
    near(&on_first(&own.0, own.1), &exact, "own");
    let library = driven(|m, i, j| m.load("load", loads::spring(i, j, U[0], U[1], k, free)));
    near(&on_first(&library.0, library.1), &exact, "library");
    let dual = driven(|m, i, j| {
        m.load("load", Load::along(by_dual(by_numbers(i, j, U[0], U[1], k, free)), |_, _, _| -1.0))
    });
    near(&on_first(&dual.0, dual.1), &exact, "dual numbers");
    kin::check::derivatives(own_spring(
        kin::check::any_planar(),
        kin::check::any_planar(),
        U[0],
        U[1],
        k,
        free,
    ));
}

#[test]
fn dampers_struts_and_gas_springs_push_along_their_lines() {
    let damper = driven(|m, i, j| m.load("load", loads::damper(i, j, U[0], U[1], 12.0)));
    near(
        &on_first(&damper.0, damper.1),
        &by_hand(&damper.0, damper.1, |_, rate| -12.0 * rate),
        "damper",
    );
    let table = Law::spline(&[(0.5, 90.0), (1.2, 40.0), (2.5, 25.0)], Ends::Natural);
    let strut = driven(|m, i, j| m.load("load", loads::strut(i, j, U[0], U[1], table.clone())));
    near(&on_first(&strut.0, strut.1), &by_hand(&strut.0, strut.1, |l, _| table.at(l)), "strut");
    let gas = driven(|m, i, j| m.load("load", loads::gas_spring(i, j, U, 200.0, [2.0, 3.0], 1.3)));
    let push = |l: f64, _: f64| 200.0 * (3.0 / (3.0 - (2.0 - l))).powf(1.3);
    near(&on_first(&gas.0, gas.1), &by_hand(&gas.0, gas.1, push), "gas spring");
    let both = driven(|m, i, j| {
        m.load(
            "load",
            Load::along(loads::length(i, j, U[0], U[1]), |_, _, t| 5.0 * t)
                .and(loads::spring(i, j, U[0], U[1], 80.0, 0.4)),
        )
    });
    let found = on_first(&both.0, both.1);
    let times = linspace(0.0, 3.0, 31);
    let springs = by_hand(&both.0, both.1, |l, _| -80.0 * (l - 0.4));
    let units = by_hand(&both.0, both.1, |_, _| 5.0);
    let exact: Vec<[f64; 3]> =
        (0..31).map(|k| [0, 1, 2].map(|c| springs[k][c] + times[k] * units[k][c])).collect();
    near(&found, &exact, "a spring and a force by time under one name");
}

#[test]
fn torsion_springs_and_bushings_turn_back() {
    let (system, bodies) = driven(|m, i, j| m.load("load", loads::torsion_spring(i, j, 7.0, 0.2)));
    let motion = system.run_both(linspace(0.0, 3.0, 31)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let torque = forces
        .load("load")
        .expect("a load")
        .on(bodies[1])
        .expect("its body")
        .torque()
        .expect("unique");
    let [a, b] = bodies
        .map(|body| motion.coordinate(body.theta()).expect("an angle").value.values().to_vec());
    for (k, torque) in torque.iter().enumerate() {
        assert!((torque - 7.0 * (a[k] - b[k] - 0.2)).abs() < 1e-13);
    }
    let stiff = vec2(300.0, 500.0);
    let (system, bodies) =
        driven(|m, i, j| m.load("load", loads::bushing(i, j, U[0], U[1], stiff, 9.0, 0.1)));
    let motion = system.run_both(linspace(0.0, 3.0, 31)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let acted = forces.load("load").expect("a load").on(bodies[0]).expect("its body").at(U[0]);
    let force = acted.force().expect("unique");
    let torque = acted.torque().expect("unique");
    let points = [0, 1].map(|k| motion.point(bodies[k], U[k]).expect("a point"));
    let theta = bodies
        .map(|body| motion.coordinate(body.theta()).expect("an angle").value.values().to_vec());
    for k in 0..motion.len() {
        let (sin, cos) = theta[1][k].sin_cos();
        let d = points[0].r()[k] - points[1].r()[k];
        let local = vec2(cos * d.x + sin * d.y, cos * d.y - sin * d.x);
        let back = vec2(-stiff.x * local.x, -stiff.y * local.y);
        let due = vec2(cos * back.x - sin * back.y, sin * back.x + cos * back.y);
        assert!((force[k] - due).norm() < 1e-12 * (1.0 + due.norm()));
        assert!((torque[k] + 9.0 * (theta[0][k] - theta[1][k] - 0.1)).abs() < 1e-12);
    }
}

#[test]
fn forces_in_body_axes_turn_with_it() {
    let (system, bodies) = driven(|m, i, _| {
        m.load(
            "load",
            Load::force_in_body(i, U[0], vec2(3.0, -2.0)).and(Load::torque_in_body(i, 0.5)),
        )
    });
    let motion = system.run_both(linspace(0.0, 3.0, 31)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let acted =
        forces.load("load").expect("a load").on(bodies[0]).expect("its body").at(U[0]).in_body();
    for (f, t) in acted.force().expect("unique").iter().zip(acted.torque().expect("unique")) {
        assert!((*f - vec2(3.0, -2.0)).norm() < 1e-14 && (t - 0.5).abs() < 1e-14);
    }
}

/// A pendulum in one bare coordinate, by a point with mass, against the same one as a body.
#[test]
fn a_point_with_mass_is_a_body_without_inertia() {
    /// The bob.      [m]
    #[constraint]
    fn bob(theta: Coord, l: f64, t: Time) -> (f64, f64) {
        let lift = 0.1 * (3.0 * t).sin();
        let x = l * theta.cos();
        let y = l * theta.sin() + lift;
        (x, y)
    }
    let swing = || Law::sine(0.7, 2.0, 0.3);
    let mut bare = Mechanism::new("bare");
    let theta = bare.angle("theta", 0.2).expect("an angle");
    bare.add("motor", drive(theta, swing())).expect("a driver");
    bare.point_mass("bob", bob(theta, 0.4), 2.5).expect("a mass");
    bare.gravity(vec2(0.0, -9.81));
    let mut m = Mechanism::new("body");
    let slide = m.planar("slide", pose(0.0, 0.0, 0.0)).expect("a body");
    let arm = m.planar("arm", pose(0.0, 0.0, 0.2)).expect("a body");
    let path = [Law::constant(0.0), Law::sine(0.1, 3.0, 0.0)];
    m.add("upright", drive_angle(slide, Law::constant(0.0))).expect("a driver");
    let [x, y] = path;
    m.add("lift", drive_point(slide, vec2(0.0, 0.0), x, y)).expect("a driver");
    m.add("pin", revolute(arm, slide, vec2(0.0, 0.0), vec2(0.0, 0.0))).expect("a pin");
    m.add("motor", drive_angle(arm, swing())).expect("a driver");
    m.mass(arm, 2.5, vec2(0.4, 0.0), 0.0).expect("a mass");
    m.gravity(vec2(0.0, -9.81));
    // Its file carries the point.
    let data = bare.data().expect("data");
    assert_eq!((data.point_masses.len(), data.equations.len()), (1, 1));
    let read = Mechanism::from_data(&data, &kin_text::registry()).expect("the same mechanism");
    assert_eq!(read.data().expect("data"), data);
    let efforts = [bare, m, read].map(|m| {
        let system = m.build().expect("a system");
        let motion = system.run_both(linspace(0.0, 3.0, 31)).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        assert_eq!(forces.drive("motor").expect("a driver").effort().unit(), "N m");
        let kinetic = forces.energy().kinetic.values().to_vec();
        (forces.drive("motor").expect("a driver").effort().values().to_vec(), kinetic)
    });
    let [(a, t), others @ ..] = efforts;
    for (x, y) in others.iter().flat_map(|(b, u)| a.iter().zip(b).chain(t.iter().zip(u))) {
        assert!((x - y).abs() < 1e-12 * (1.0 + y.abs()), "{x} {y}");
    }
}

#[test]
fn columns_and_files_have_names_and_units() {
    let (system, _) = driven(|m, i, j| m.load("load", loads::spring(i, j, U[0], U[1], 80.0, 0.4)));
    let motion = system.run_both([0.0, 0.5]).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let names: Vec<String> =
        forces.columns().iter().map(|c| format!("{} [{}]", c.name(), c.unit())).collect();
    assert_eq!(names[..4], ["a.x [N]", "a.x.power [W]", "a.y [N]", "a.y.power [W]"]);
    assert!(names.contains(&"a.theta [N m]".to_string()), "{names:?}");
    let path = std::env::temp_dir().join(format!("kin-forces-{}.csv", std::process::id()));
    forces.write_csv(&path).expect("writes");
    let text = std::fs::read_to_string(&path).expect("reads");
    std::fs::remove_file(&path).expect("removes");
    assert_eq!(text.lines().count(), 3);
    assert!(text.starts_with("t [s],a.x [N],a.x.power [W],"), "{text}");
    forces.write_json(&path).expect("writes");
    let text = std::fs::read_to_string(&path).expect("reads");
    std::fs::remove_file(&path).expect("removes");
    let data: kin::data::ForcesData = serde_json::from_str(&text).expect("forces");
    assert_eq!(data, forces.data());
    assert_eq!((data.mechanism.as_str(), data.times.as_slice()), ("two bodies", &[0.0, 0.5][..]));
    for (column, series) in data.columns.iter().zip(forces.columns()) {
        assert_eq!((column.name.as_str(), column.unit.as_str()), (series.name(), series.unit()));
        assert_eq!(column.values, series.values());
    }
}

#[test]
fn given_states_are_refused_by_name_and_taken_as_they_are() {
    let (system, _) = driven(|m, i, j| m.load("load", loads::spring(i, j, U[0], U[1], 80.0, 0.4)));
    let run = system.run_both(linspace(0.0, 1.0, 5)).expect("a motion");
    let rows = |of: &dyn Fn(usize) -> Vec<f64>| (0..5).map(of).collect::<Vec<_>>();
    let q = rows(&|k| run.q(k).to_vec());
    let qd = rows(&|k| run.qd(k).to_vec());
    let qdd = rows(&|k| run.qdd(k).to_vec());
    let given = Motion::from_states(&system, run.times(), &q, &qd, &qdd).expect("a motion");
    let efforts = [&run, &given].map(|motion| {
        let forces = system.forces(motion).expect("forces");
        forces.drive("a.x").expect("a driver").effort().values().to_vec()
    });
    assert_eq!(efforts[0], efforts[1]);
    let told = |times: &[f64], q: &[Vec<f64>]| {
        Motion::from_states(&system, times, q, &qd, &qdd).unwrap_err().to_string()
    };
    assert!(told(run.times(), &q[..4]).contains("q of a motion has 4 values, but Kin needs 5"));
    assert!(told(&[0.0, 1.0, 0.5, 2.0, 3.0], &q).contains("must only increase"));
    let mut bad = q.clone();
    bad[2][1] = f64::NAN;
    assert!(told(run.times(), &bad).contains("NaN"));
}

#[test]
fn masses_and_gravity_come_back_from_a_file_and_closures_are_refused() {
    let mut m = Mechanism::new("arm");
    m.units("mm", "s").mass("t");
    let arm = m.link("arm", 0.5).expect("a link");
    m.add("O", revolute(arm, m.ground(), arm.start(), vec2(0.0, 0.0))).expect("a pin");
    m.add("motor", drive_angle(arm, Law::ramp(2.0))).expect("a driver");
    m.mass(arm, 1.2, vec2(0.1, 0.02), 0.03).expect("a mass");
    m.gravity(vec2(0.0, -9810.0));
    let data = serde_json::to_string(&m.data().expect("data")).expect("writes");
    let data = serde_json::from_str(&data).expect("reads");
    let again = Mechanism::from_data(&data, &kin::data::Registry::new()).expect("the same");
    assert_eq!(again.data().expect("data"), data);
    let peaks = [m.clone(), again].map(|m| {
        let system = m.build().expect("a system");
        let motion = system.run_both(linspace(0.0, 1.0, 5)).expect("a motion");
        system.forces(&motion).expect("forces").drive("motor").expect("a driver").peak()
    });
    assert_eq!(peaks[0], peaks[1]);
    assert!(peaks[0].to_string().contains(" N mm at "), "{}", peaks[0]);
    m.load("push", Load::along(loads::turn(arm, m.ground()), |_, _, _| 1.0)).expect("a load");
    let told = m.data().unwrap_err().to_string();
    assert!(
        told.starts_with("load `push`: its force is a closure, which no file can store"),
        "{told}"
    );
}
