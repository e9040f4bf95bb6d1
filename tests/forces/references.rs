//! Reactions, efforts, powers and energies against 60 digits (`tests/data/forces/`).

use kin::forces::{BodyWrench, Forces};
use kin::loads::HasTorque;
use kin::{Mechanism, Motion};
use serde_json::Value;

use super::data::{numbers, read, rows};
use super::file::{Bodies, build, find, text};
use crate::both::Engines;

/// Whatever differs is compared with this share of the largest number of its kind in the file.
const FORCE: f64 = 1e-11;
const POWER: f64 = 1e-12;

/// The largest difference of forces, torques and efforts, and the largest of them.
#[derive(Default)]
struct Compared {
    off: f64,
    largest: f64,
}

impl Compared {
    fn take(&mut self, found: f64, exact: f64) {
        let off = (found - exact).abs();
        self.off = if off.is_nan() { f64::INFINITY } else { self.off.max(off) };
        self.largest = self.largest.max(exact.abs());
    }

    fn check(&self, what: &str, tolerance: f64) {
        println!("{what}: off by {:.1e} of {:.3}", self.off, self.largest);
        assert!(self.largest > 0.0, "{what}: nothing is compared");
        assert!(self.off <= tolerance * (1.0 + self.largest), "{what}: off by {:e}", self.off);
    }
}

/// The wrench that the files list of a joint or a load, on body i or on another one.
fn compare<V: HasTorque>(acted: &BodyWrench<'_, V>, exact: &Value, sign: f64, of: &mut Compared) {
    let names: &[&str] =
        if exact["torque"][0].is_array() { &["T_x", "T_y", "T_z"] } else { &["T"] };
    let unique = |k: usize| exact["unique_always"].get(k).is_none_or(|unique| unique == true);
    let force = rows(exact, "force");
    for (k, name) in ["F_x", "F_y", "F_z"].iter().enumerate().take(force[0].len()) {
        series(acted, name, unique(k), |t| sign * force[t][k], of);
    }
    let n = force[0].len();
    for (k, name) in names.iter().enumerate() {
        let torque = |t: usize| {
            let torque = &exact["torque"][t];
            sign * torque.as_f64().or_else(|| torque[k].as_f64()).expect("a torque")
        };
        series(acted, name, unique(n + k), torque, of);
    }
}

fn series<V: HasTorque>(
    acted: &BodyWrench<'_, V>,
    name: &str,
    unique: bool,
    exact: impl Fn(usize) -> f64,
    of: &mut Compared,
) {
    let found = acted.component(name);
    assert_eq!(found.is_ok(), unique, "{name}: {:?}", found.err());
    let Ok(found) = found else { return };
    found.values().iter().enumerate().for_each(|(t, found)| of.take(*found, exact(t)));
}

/// All that a file says, at its own times.
fn check(name: &str) {
    let file = read(&format!("forces/{name}"));
    let (mechanism, bodies) = build(&file).expect("a mechanism");
    check_built(&file, mechanism, &bodies, name);
}

fn check_built(file: &Value, mechanism: Mechanism, bodies: &Bodies, name: &str) {
    let system = mechanism.build().expect("a system");
    let motion = system.run_both(numbers(file, "time")).expect("a motion");
    moves(&motion, file);
    let forces = system.forces(&motion).expect("forces");
    let reference = &file["reference"];
    let mut compared = Compared::default();
    let object = |field: &str| reference[field].as_object().expect("an object").iter();
    for (joint, exact) in object("reactions") {
        on_both(&forces, bodies, joint, exact, 1.0, &mut compared);
    }
    across_cranks(&forces, bodies, reference, &mut compared);
    compared.check(&format!("{name}: reactions"), FORCE);
    let mut efforts = Compared::default();
    for (driver, exact) in object("drivers") {
        let drive = forces.drive(driver).expect("a driver");
        let effort = numbers(exact, "effort");
        let rate = numbers(exact, "rate");
        for (k, (effort, rate)) in effort.iter().zip(rate).enumerate() {
            efforts.take(drive.effort().values()[k], *effort);
            assert!(
                (drive.power().values()[k] - effort * rate).abs()
                    < 1e-10 * (1.0 + compared.largest)
            );
        }
    }
    efforts.check(&format!("{name}: efforts"), FORCE);
    ground(&forces, bodies, &rows(reference, "on_ground"), &compared);
    for (load, exact) in object("elements") {
        loads(&forces, bodies, load, exact);
    }
    let kinetic = numbers(reference, "kinetic_energy");
    let mut energies = Compared::default();
    forces
        .energy()
        .kinetic
        .values()
        .iter()
        .zip(kinetic)
        .for_each(|(t, exact)| energies.take(*t, exact));
    energies.check(&format!("{name}: kinetic energy"), POWER);
    let balance = forces.balance();
    println!("{name}: {balance}");
    assert!(balance.worst() <= POWER, "{name}: {balance}");
}

/// The part of each pin force across its crank, the only one that the third crank leaves unique.
fn across_cranks(forces: &Forces<'_>, bodies: &Bodies, reference: &Value, of: &mut Compared) {
    let (Some(across), Bodies::Planar(bodies)) = (reference["across_crank"].as_object(), bodies)
    else {
        return;
    };
    for (joint, exact) in across {
        let crank = find(bodies, &format!("crank{}", &joint[1..]));
        let acted = forces.reaction(joint).expect("a joint").on(crank).expect("on it").in_body();
        // The files say what is put on body i: the ground at O, the crank at A.
        let sign = if joint.starts_with('O') { -1.0 } else { 1.0 };
        assert_eq!(acted.not_unique(), ["F_x"], "{joint}");
        let told = acted.force().unwrap_err().to_string();
        assert!(
            told.contains("`O1`, `A1`, `O2`, `A2`, `O3` and `A3` carry this force together"),
            "{told}"
        );
        let exact: Vec<f64> = numbers_of(exact);
        series(&acted, "F_y", true, |t| sign * exact[t], of);
    }
}

/// The motion itself, without which nothing is compared.
fn moves(motion: &Motion, file: &Value) {
    for (k, exact) in rows(&file["reference"], "qdd").iter().enumerate() {
        assert!(super::data::error(motion.qdd(k), exact) < 1e-9, "time {k}");
    }
}

/// On body i and, opposite, on body j at the same point.
fn on_both(
    forces: &Forces<'_>,
    bodies: &Bodies,
    joint: &str,
    exact: &Value,
    sign: f64,
    of: &mut Compared,
) {
    let reaction = forces.reaction(joint).expect("a joint");
    let at = |k: usize| numbers_of(&exact["point"][k]);
    for (field, sign) in [("i", sign), ("j", -sign)] {
        match bodies {
            Bodies::Planar(bodies) => {
                let acted = reaction.on(find(bodies, text(exact, field))).expect("a body of it");
                let points = acted.points();
                let near =
                    |k: usize| (points[k].x - at(k)[0]).hypot(points[k].y - at(k)[1]) < 1e-12;
                assert!((0..points.len()).all(near), "{joint} on {field}");
                compare(&acted, exact, sign, of);
            }
            Bodies::Spatial(bodies) => {
                let acted = reaction.on(find(bodies, text(exact, field))).expect("a body of it");
                let points = acted.points();
                let near = |k: usize| {
                    let [x, y, z] = [0, 1, 2].map(|c| points[k].to_array()[c] - at(k)[c]);
                    x.hypot(y).hypot(z) < 1e-12
                };
                assert!((0..points.len()).all(near), "{joint} on {field}");
                compare(&acted, exact, sign, of);
            }
        }
    }
}

fn numbers_of(value: &Value) -> Vec<f64> {
    value.as_array().expect("numbers").iter().map(|x| x.as_f64().expect("a number")).collect()
}

/// The shaking force and moment.
fn ground(forces: &Forces<'_>, bodies: &Bodies, exact: &[Vec<f64>], of: &Compared) {
    let all: Vec<Vec<f64>> = match bodies {
        Bodies::Planar(bodies) => {
            let acted = forces.on_ground().on(find(bodies, "ground")).expect("the ground");
            let force = acted.force().expect("unique");
            let torque = acted.torque().expect("unique");
            force.iter().zip(torque).map(|(f, t)| vec![f.x, f.y, t]).collect()
        }
        Bodies::Spatial(bodies) => {
            let acted = forces.on_ground().on(find(bodies, "ground")).expect("the ground");
            let force = acted.force().expect("unique");
            let torque = acted.torque().expect("unique");
            force.iter().zip(torque).map(|(f, t)| [f.to_array(), t.to_array()].concat()).collect()
        }
    };
    for (found, exact) in all.iter().flatten().zip(exact.iter().flatten()) {
        assert!(
            (found - exact).abs() < FORCE * (1.0 + of.largest),
            "on the ground {found} {exact}"
        );
    }
}

fn loads(forces: &Forces<'_>, bodies: &Bodies, load: &str, exact: &Value) {
    let mut compared = Compared::default();
    let reaction = forces.load(load).expect("a load");
    match bodies {
        Bodies::Planar(bodies) => compare(
            &reaction.on(find(bodies, text(exact, "on"))).expect("on it"),
            exact,
            1.0,
            &mut compared,
        ),
        Bodies::Spatial(bodies) => compare(
            &reaction.on(find(bodies, text(exact, "on"))).expect("on it"),
            exact,
            1.0,
            &mut compared,
        ),
    }
    compared.check(load, FORCE);
    for (found, exact) in reaction.power().values().iter().zip(numbers(exact, "power")) {
        assert!(
            (found - exact).abs() < FORCE * (1.0 + compared.largest),
            "power of {load}: {found} {exact}"
        );
    }
}

#[test]
fn two_link_arm_with_gravity() {
    check("two_link_gravity");
}

#[test]
fn slider_crank_with_a_load_on_the_slider() {
    check("slider_crank_load");
}

#[test]
fn boom_with_a_cylinder_and_a_spring() {
    check("boom_cylinder_spring");
}

#[test]
fn spatial_four_bar_with_full_inertia() {
    check("rssr_full_inertia");
}

#[test]
fn rotor_on_a_precessing_yoke() {
    check("gyro_rotor_steady");
}

#[test]
fn parallelogram_with_a_third_crank() {
    check("parallelogram_third_crank");
}
