//! Kinetic and potential energy: closed forms, and their rate against the power of the drives.

use kin::SolverOptions;
use kin::prelude::*;
use kin::results::Series;
use kin::{Mechanism, loads};

use crate::both::Engines;

const O: Vec2 = Vec2::new(0.0, 0.0);

/// A point of a body.      [m]
#[constraint]
fn of_body(i: Planar, u_i: Vec2) -> (f64, f64) {
    let r = i.point(u_i);
    (r.x, r.y)
}

/// The largest difference of a series from an exact one.
fn off(found: &Series, exact: impl Fn(f64) -> f64) -> f64 {
    found.times().iter().zip(found.values()).map(|(t, x)| (x - exact(*t)).abs()).fold(0.0, f64::max)
}

/// A bar that swings, with a point that has mass, a torsion spring and a spring to the ground. Its
/// damper has no energy.
#[test]
fn a_bar_with_springs_has_the_energy_of_its_closed_form() {
    let law = Law::constant(0.4) + Law::sine(0.8, 2.0, 0.3);
    let mut m = Mechanism::new("bar");
    let bar = m.planar("bar", pose(0.0, 0.0, 0.4)).expect("a body");
    m.gravity(vec2(0.0, -9.81));
    m.mass(bar, 2.0, vec2(0.3, 0.0), 0.05).expect("a mass");
    m.point_mass("tip", of_body(bar, vec2(0.6, 0.0)), 0.5).expect("a point");
    m.add("O", revolute(m.ground(), bar, O, O)).expect("a joint");
    m.add("motor", drive_angle(bar, law.clone())).expect("a driver");
    let tip = vec2(0.6, 0.0);
    let anchor = vec2(0.9, 0.2);
    let ground = m.ground();
    m.load("coil", loads::torsion_spring(bar, ground, 7.0, 0.1)).expect("a load");
    m.load("spring", loads::spring(bar, ground, tip, anchor, 80.0, 0.25)).expect("a load");
    m.load("damper", loads::damper(bar, ground, tip, anchor, 3.0)).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 3.0, 61)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let kinetic = |t: f64| {
        let rate = law.jet(t)[1];
        0.5 * (0.05 + 2.0 * 0.3 * 0.3 + 0.5 * 0.6 * 0.6) * rate * rate
    };
    let potential = |t: f64| {
        let theta = law.at(t);
        let end = vec2(0.6 * theta.cos(), 0.6 * theta.sin());
        let stretch = (end - anchor).norm() - 0.25;
        let weight = 9.81 * (2.0 * 0.3 + 0.5 * 0.6) * theta.sin();
        weight + 3.5 * (theta - 0.1) * (theta - 0.1) + 40.0 * stretch * stretch
    };
    let energy = forces.energy();
    let found = [off(&energy.kinetic, kinetic), off(&energy.potential, potential)];
    assert!(energy.potential.max() > 10.0 && found.iter().all(|off| *off < 1e-12), "{found:?}");
    assert_eq!([energy.kinetic.unit(), energy.potential.unit()], ["J", "J"]);
    // Masses of points are in both balances of powers.
    for engine in [kin::Engine::StepByStep, kin::Engine::Compiled] {
        let forces = system
            .solver()
            .options(SolverOptions::new().engine(engine))
            .forces(&motion)
            .expect("forces");
        let balance = forces.balance();
        assert!(balance.worst() < 1e-13, "{engine:?}: {balance}");
        let rate = |t: f64| {
            let [_, rate, second, _] = law.jet(t);
            (0.05 + 2.0 * 0.3 * 0.3 + 0.5 * 0.6 * 0.6) * rate * second
        };
        assert!(off(&balance.kinetic, rate) < 1e-12);
    }
}

/// Without friction and dampers the drives put in what energy gains: the power is the rate of T +
/// V, here by differences of the fourth order.
fn gains_what_drives_put_in(m: Mechanism, what: &str) {
    const STEP: f64 = 1e-3;
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 0.4, 401)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let energy = forces.energy();
    let all: Vec<f64> =
        energy.kinetic.values().iter().zip(energy.potential.values()).map(|(t, v)| t + v).collect();
    let mut power = vec![0.0; motion.len()];
    for name in forces.drives() {
        let drive = forces.drive(name).expect("a driver");
        power.iter_mut().zip(drive.power().values()).for_each(|(all, one)| *all += one);
    }
    let size = power.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    for k in 2..all.len() - 2 {
        let rate = (8.0 * (all[k + 1] - all[k - 1]) - (all[k + 2] - all[k - 2])) / (12.0 * STEP);
        let off = (rate - power[k]).abs();
        assert!(off < 1e-8 * (1.0 + size), "{what}, time {k}: {rate} {}", power[k]);
    }
    assert!(size > 1.0, "{what}: {size}");
}

#[test]
fn planar_drives_put_in_what_energy_gains() {
    let mut m = Mechanism::new("two bodies");
    m.gravity(vec2(0.7, -9.81));
    let bodies = [("a", 0.9, 0.2), ("b", -0.4, 1.0)].map(|(name, x, y)| {
        let body = m.planar(name, pose(x, y, 0.0)).expect("a body");
        m.mass(body, 1.5 + x, vec2(0.1, -0.2), 0.2).expect("a mass");
        for (axis, coordinate, mean) in
            [("x", body.x(), x), ("y", body.y(), y), ("theta", body.theta(), 0.3)]
        {
            let law = Law::constant(mean) + Law::sine(0.4 * mean, 3.7, 0.4 * x);
            m.add(&format!("{name}.{axis}"), drive(coordinate, law)).expect("a driver");
        }
        body
    });
    let [a, b] = bodies;
    m.load("bush", loads::bushing(a, b, vec2(0.1, 0.2), O, vec2(300.0, 500.0), 9.0, 0.1))
        .expect("a load");
    m.load("coil", loads::torsion_spring(a, m.ground(), 7.0, 0.2)).expect("a load");
    m.load("along", loads::coordinate_spring(b.x(), 60.0, 0.2)).expect("a load");
    m.point_mass("point", of_body(b, vec2(0.3, 0.1)), 0.7).expect("a point");
    gains_what_drives_put_in(m, "planar");
}

#[test]
fn spatial_drives_put_in_what_energy_gains() {
    let mut m = Mechanism::new("rotor");
    m.gravity(vec3(0.3, -0.2, -9.81));
    let zero = vec3(0.0, 0.0, 0.0);
    let h = vec3(0.0, 0.6, 0.8);
    let rotor = m.spatial("rotor", SpatialPose::at(zero)).expect("a body");
    let ground = m.ground();
    m.add("screw", spatial::cylindrical(rotor, ground, zero, zero, h, h)).expect("a joint");
    m.add("turn", spatial::drive_turn(rotor, ground, h, h, Law::sine(0.8, 5.0, 0.2)))
        .expect("a driver");
    let along = spatial::drive_slide(rotor, ground, zero, zero, h, Law::sine(0.2, 4.0, 0.0));
    m.add("slide", along).expect("a driver");
    let u = vec3(0.4, 0.1, -0.2);
    let v = vec3(-0.3, 0.5, 0.6);
    m.load("spring", loads::spatial::spring(rotor, ground, u, v, 90.0, 0.3)).expect("a load");
    m.load("coil", loads::spatial::torsion_spring(rotor, ground, h, h, 7.0, 0.2)).expect("a load");
    let stiff = vec3(300.0, 200.0, 400.0);
    let turning = vec3(9.0, 8.0, 7.0);
    let none = EulerParameters::identity();
    m.load("bush", loads::spatial::bushing(rotor, ground, u, u, none, stiff, turning))
        .expect("a load");
    gains_what_drives_put_in(m, "spatial");
}
