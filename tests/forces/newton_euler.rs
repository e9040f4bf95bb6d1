//! Newton's and Euler's equations of every body, by vectors: Σ F = m a_c and Σ M = J α + ω × J ω
//! about the centre, with the accelerations of points and none of what Kin's forces are made by.
//! Faults that are planted in them have to show.

use kin::System;
use kin::forces::Forces;
use kin::prelude::*;

use super::data::{array, number, numbers, read, rows};
use super::file::{Bodies, build, list};
use super::own;
use crate::both::Engines;

/// The mass of a body as a test gives it.
#[derive(Clone, Copy)]
pub struct Massed<B> {
    pub body: B,
    pub mass: f64,
    pub centre: Vec3,
    pub inertia: Mat3,
}

/// A mistake in the equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    None,
    InertiaAboutTheOrigin,
    NoGyroscopicTerm,
    GravityUpwards,
    BodiesSwapped,
    TorqueAboutTheOrigin,
}

/// Left of all equations at their worst, and the largest force or torque.
fn left(own: impl Iterator<Item = [Vec3; 2]>, largest: f64) -> f64 {
    let worst = own
        .flatten()
        .map(|left| left.norm())
        .fold(0.0, |m, x| if x.is_nan() { f64::INFINITY } else { f64::max(m, x) });
    worst / largest
}

/// Names of the constraints that act on bodies.
fn names(system: &System) -> Vec<String> {
    system
        .constraint_names()
        .into_iter()
        .filter(|name| !name.ends_with(".p"))
        .map(str::to_string)
        .collect()
}

/// The largest error of the equations of planar bodies, as a share of the largest force or torque.
pub fn planar(
    forces: &Forces<'_>,
    system: &System,
    massed: &[Massed<PlanarBody>],
    g: Vec2,
    fault: Fault,
) -> f64 {
    let motion = forces.motion();
    let mut all = Vec::new();
    let mut largest = 0.0_f64;
    for (k, own) in massed.iter().enumerate() {
        let masses =
            if fault == Fault::BodiesSwapped { &massed[(k + 1) % massed.len()] } else { own };
        let c = vec2(masses.centre.x, masses.centre.y);
        let about = if fault == Fault::TorqueAboutTheOrigin { vec2(0.0, 0.0) } else { c };
        let a = motion.point(own.body, c).expect("a point").a().to_vec();
        let alpha =
            motion.coordinate(own.body.theta()).expect("an angle").second_rate.values().to_vec();
        let mut inertia = masses.inertia.m33;
        if fault == Fault::InertiaAboutTheOrigin {
            inertia += masses.mass * c.dot(c);
        }
        let sign = if fault == Fault::GravityUpwards { -1.0 } else { 1.0 };
        let mut sums = vec![[Vec3::zeros(); 2]; motion.len()];
        let acting: Vec<String> = names(system)
            .into_iter()
            .filter(|name| forces.reaction(name).expect("a constraint").on(own.body).is_ok())
            .collect();
        for name in &acting {
            raise(
                &forces.reaction(name).expect("a constraint").on(own.body).expect("on it"),
                &mut largest,
            );
        }
        // Of redundant constraints the sum alone is unique.
        if !acting.is_empty() {
            let all = forces.sum(&acting).expect("constraints").on(own.body).expect("on it");
            add_planar(all.at(about), &mut sums, &mut largest);
        }
        for name in system.load_names() {
            let Ok(acted) = forces.load(name).expect("a load").on(own.body) else { continue };
            add_planar(acted.at(about), &mut sums, &mut largest);
        }
        all.extend(sums.iter().enumerate().map(|(t, [f, m])| {
            let due = a[t] * masses.mass - g * (sign * masses.mass);
            [*f - vec3(due.x, due.y, 0.0), *m - vec3(0.0, 0.0, inertia * alpha[t])]
        }));
    }
    left(all.into_iter(), largest)
}

fn add_planar(acted: kin::forces::BodyWrench<'_, Vec2>, sums: &mut [[Vec3; 2]], largest: &mut f64) {
    let force = acted.force().expect("unique");
    let torque = acted.torque().expect("unique");
    for ((sum, f), m) in sums.iter_mut().zip(force).zip(torque) {
        *largest = largest.max(f.norm()).max(m.abs());
        sum[0] += vec3(f.x, f.y, 0.0);
        sum[1] += vec3(0.0, 0.0, m);
    }
}

/// The same of spatial bodies.
pub fn spatial(
    forces: &Forces<'_>,
    system: &System,
    massed: &[Massed<SpatialBody>],
    g: Vec3,
    fault: Fault,
) -> f64 {
    let motion = forces.motion();
    let mut all = Vec::new();
    let mut largest = 0.0_f64;
    for (k, own) in massed.iter().enumerate() {
        let masses =
            if fault == Fault::BodiesSwapped { &massed[(k + 1) % massed.len()] } else { own };
        let c = masses.centre;
        let about = if fault == Fault::TorqueAboutTheOrigin { Vec3::zeros() } else { c };
        let a = motion.point(own.body, c).expect("a point").a().to_vec();
        let turning = motion.rotation(own.body).expect("a body");
        let axes = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)];
        let [o, x, y, z] = [Vec3::zeros(), axes[0], axes[1], axes[2]]
            .map(|u| motion.point(own.body, u).expect("a point").r().to_vec());
        let mut inertia = masses.inertia;
        if fault == Fault::InertiaAboutTheOrigin {
            inertia -= Mat3::skew(c) * Mat3::skew(c) * masses.mass;
        }
        let sign = if fault == Fault::GravityUpwards { -1.0 } else { 1.0 };
        let mut sums = vec![[Vec3::zeros(); 2]; motion.len()];
        let acting: Vec<String> = names(system)
            .into_iter()
            .filter(|name| forces.reaction(name).expect("a constraint").on(own.body).is_ok())
            .collect();
        for name in &acting {
            raise(
                &forces.reaction(name).expect("a constraint").on(own.body).expect("on it"),
                &mut largest,
            );
        }
        // Of redundant constraints the sum alone is unique.
        if !acting.is_empty() {
            let all = forces.sum(&acting).expect("constraints").on(own.body).expect("on it");
            add_spatial(all.at(about), &mut sums, &mut largest);
        }
        for name in system.load_names() {
            let Ok(acted) = forces.load(name).expect("a load").on(own.body) else { continue };
            add_spatial(acted.at(about), &mut sums, &mut largest);
        }
        all.extend(sums.iter().enumerate().map(|(t, [f, m])| {
            let rotation = Mat3::from_columns([x[t] - o[t], y[t] - o[t], z[t] - o[t]]);
            let global = rotation * inertia * rotation.transpose();
            let omega = turning.omega()[t];
            let alpha = turning.alpha()[t];
            let mut moment = global * alpha;
            if fault != Fault::NoGyroscopicTerm {
                moment += omega.cross(global * omega);
            }
            [*f - (a[t] * masses.mass - g * (sign * masses.mass)), *m - moment]
        }));
    }
    left(all.into_iter(), largest)
}

fn add_spatial(
    acted: kin::forces::BodyWrench<'_, Vec3>,
    sums: &mut [[Vec3; 2]],
    largest: &mut f64,
) {
    let force = acted.force().expect("unique");
    let torque = acted.torque().expect("unique");
    for ((sum, f), m) in sums.iter_mut().zip(force).zip(torque) {
        *largest = largest.max(f.norm()).max(m.norm());
        sum[0] += f;
        sum[1] += m;
    }
}

/// Takes in how large the components are that are unique.
fn raise<V: kin::loads::HasTorque>(acted: &kin::forces::BodyWrench<'_, V>, largest: &mut f64) {
    for component in acted.components() {
        *largest = largest.max(component.max().abs()).max(component.min().abs());
    }
}

const FAULTS: [Fault; 5] = [
    Fault::InertiaAboutTheOrigin,
    Fault::NoGyroscopicTerm,
    Fault::GravityUpwards,
    Fault::BodiesSwapped,
    Fault::TorqueAboutTheOrigin,
];

#[test]
fn every_body_of_the_files_is_in_balance_and_faults_show() {
    let mut seen = Vec::new();
    for name in [
        "two_link_gravity",
        "slider_crank_load",
        "boom_cylinder_spring",
        "rssr_full_inertia",
        "gyro_rotor_steady",
    ] {
        let file = read(&format!("forces/{name}"));
        let (mechanism, bodies) = build(&file).expect("a mechanism");
        let system = mechanism.build().expect("a system");
        let motion = system.run_both(numbers(&file, "time")).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        let masses = list(&file, "bodies");
        let off = |fault: Fault| match &bodies {
            Bodies::Planar(bodies) => {
                let moving = bodies.iter().zip(masses).filter(|(_, mass)| mass["mass"].is_number());
                let massed: Vec<_> = moving
                    .map(|((_, body), of)| {
                        let [x, y] = array(of, "centre");
                        let j = number(of, "inertia");
                        let inertia = Mat3::from([[0.0; 3], [0.0; 3], [0.0, 0.0, j]]);
                        Massed {
                            body: *body,
                            mass: number(of, "mass"),
                            centre: vec3(x, y, 0.0),
                            inertia,
                        }
                    })
                    .collect();
                let [x, y] = array(&file, "gravity");
                planar(&forces, &system, &massed, vec2(x, y), fault)
            }
            Bodies::Spatial(bodies) => {
                let moving = bodies.iter().zip(masses).filter(|(_, mass)| mass["mass"].is_number());
                let massed: Vec<_> = moving
                    .map(|((_, body), of)| {
                        let inertia: [[f64; 3]; 3] = std::array::from_fn(|k| {
                            rows(of, "inertia")[k].clone().try_into().expect("three")
                        });
                        let centre = Vec3::from(array::<3>(of, "centre"));
                        Massed {
                            body: *body,
                            mass: number(of, "mass"),
                            centre,
                            inertia: Mat3::from(inertia),
                        }
                    })
                    .collect();
                spatial(&forces, &system, &massed, Vec3::from(array::<3>(&file, "gravity")), fault)
            }
        };
        let right = off(Fault::None);
        println!("{name}: {right:.1e} of the largest force");
        assert!(right <= 1e-11, "{name}: {right:e}");
        for fault in FAULTS {
            let wrong = off(fault);
            println!("{name}: {fault:?}: {wrong:.1e}");
            if wrong > 1e-5 {
                seen.push(fault);
            } else {
                // In the plane nothing is gyroscopic; a centre at the origin has no other moments
                // there.
                assert!(wrong <= 1e-11, "{name}: {fault:?}: {wrong:e}");
            }
        }
    }
    assert!(
        FAULTS.iter().all(|fault| seen.iter().filter(|seen| *seen == fault).count() >= 1),
        "{seen:?}"
    );
}

/// The mechanisms of all examples, with masses of the test's own.
#[test]
fn every_body_of_every_example_is_in_balance() {
    let registry = kin::data::Registry::new()
        .with::<own::slider_crank>()
        .with::<own::parabolic_slot>()
        .with::<own::geneva>();
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/examples");
    let paths =
        std::fs::read_dir(folder).expect("the gallery").map(|file| file.expect("a file").path());
    let mut seen = 0;
    let mut bodies = 0;
    for path in paths {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let mut m = Mechanism::read_json(&path, &registry).expect("reads");
        let guess = m.data().expect("data").bodies;
        let numbers = guess.iter().flat_map(|body| &body.guess).filter_map(|guess| match guess {
            kin::data::NumberData::Number(x) => Some(x.abs().min(1e3)),
            kin::data::NumberData::Expression(_) => None,
        });
        let size = numbers.fold(0.1_f64, f64::max);
        let mut flat = Vec::new();
        let mut solid = Vec::new();
        for (k, body) in guess.iter().enumerate() {
            let x = 1.0 + 0.3 * k as f64;
            let c = vec3(0.03, -0.02, 0.01) * size;
            let j = 0.02 * x * size * size;
            if let Some(body) = m.planar_named(&body.name) {
                m.mass(body, x, vec2(c.x, c.y), j).expect("a mass");
                let inertia = Mat3::from([[0.0; 3], [0.0; 3], [0.0, 0.0, j]]);
                flat.push(Massed { body, mass: x, centre: c, inertia });
            } else if let Some(body) = m.spatial_named(&body.name) {
                let rows = [
                    [j, 0.1 * j, -0.05 * j],
                    [0.1 * j, 1.2 * j, 0.07 * j],
                    [-0.05 * j, 0.07 * j, 0.9 * j],
                ];
                m.mass(body, x, c, rows).expect("a mass");
                solid.push(Massed { body, mass: x, centre: c, inertia: Mat3::from(rows) });
            }
        }
        // Of bare coordinates there are no bodies.
        if flat.is_empty() && solid.is_empty() {
            continue;
        }
        let g = vec3(0.4, -7.31, 0.0) * size;
        m.gravity(g);
        let system = m.build().expect("builds");
        let motion = system
            .run_both(linspace(0.05, 1.95, 41))
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let forces = system.forces(&motion).unwrap_or_else(|error| panic!("{name}: {error}"));
        for off in [
            (!flat.is_empty())
                .then(|| planar(&forces, &system, &flat, vec2(g.x, g.y), Fault::None)),
            (!solid.is_empty()).then(|| spatial(&forces, &system, &solid, g, Fault::None)),
        ] {
            let off = off.unwrap_or(0.0);
            println!("{name}: {off:.1e} of the largest force; {}", forces.balance());
            assert!(off <= 1e-11, "{name}: {off:e}");
        }
        assert!(forces.balance().worst() <= 1e-11, "{name}: {}", forces.balance());
        (seen, bodies) = (seen + 1, bodies + flat.len() + solid.len());
    }
    assert!(seen >= 18 && bodies > 60, "{seen} mechanisms with {bodies} bodies");
}
