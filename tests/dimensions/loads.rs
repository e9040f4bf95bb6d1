//! Masses, gravity, loads and friction whose numbers hang on dimensions: set, they are those of a
//! mechanism built so.

use kin::data::Registry;
use kin::dimension::IntoNumber;
use kin::error::DimensionError;
use kin::loads::Friction;
use kin::prelude::*;
use kin::{Error, Load, loads};

use crate::engines::Engines;
use crate::times;

/// The numbers of a driven arm, by their names.
const NAMES: [&str; 10] = ["m", "c", "J", "g", "k", "free", "u", "f", "mu", "r"];
const NOMINAL: [f64; 10] = [1.2, 0.1, 0.03, -9.81, 80.0, 0.4, 0.25, 5.0, 0.2, 0.02];
const OTHER: [f64; 10] = [2.5, -0.05, 0.08, -1.62, 35.0, 0.7, 0.1, -12.0, 0.35, 0.05];

/// An arm on a motor with all that has mass and acts: a spring, a damper, forces and torques,
/// friction.
fn arm<S: IntoNumber>(m: &mut Mechanism, all: [S; 10]) -> kin::Result<()> {
    let [mass, c, j, g, k, free, u, f, mu, r] = all;
    let zero = S::from(0.0);
    let arm = m.link("arm", 0.5)?;
    m.add("O", revolute(arm, Ground, arm.start(), (0.0, 0.0)))?;
    m.add("motor", drive_angle(arm, Law::sine(0.5, 3.0, 0.2)))?;
    m.mass(arm, mass, [c, zero], j)?;
    m.gravity(Vec2 { x: zero, y: g });
    m.load("spring", loads::spring(arm, Ground, [u, zero], (0.3, 0.8), k, free))?;
    let length = loads::length(arm, Ground, [zero, u], (-1.0, 0.0));
    m.load("damper", loads::spring_damper(length, k, free, k * S::from(0.01)))?;
    let law = |x: S| Law::constant(x) + Law::sine(x, 2.0, 0.0);
    let hook = Load::force(arm, [u, zero], Vec2 { x: zero, y: f });
    m.load(
        "hook",
        hook.and(Load::torque(arm, law(f))).and(Load::force_in_body(arm, [u, u], [law(f), law(k)])),
    )?;
    m.friction("O", Friction::pin(mu, r, 1e-3))
}

fn described() -> kin::Result<Mechanism> {
    let mut m = Mechanism::new("arm");
    let mut all = Vec::new();
    for (name, x) in NAMES.into_iter().zip(NOMINAL) {
        all.push(m.dimension(name, x)?);
    }
    let all: [kin::Dimension; 10] = all.try_into().expect("ten dimensions");
    arm(&mut m, all)?;
    Ok(m)
}

/// All that a motion tells of its forces.
fn efforts(system: &System) -> Vec<f64> {
    let motion = system.run_both(times()).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let mut all = forces.drive("motor").expect("a drive").effort().values().to_vec();
    all.extend(forces.columns().iter().flat_map(|column| column.values().to_vec()));
    all
}

fn far(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / (1.0 + b.abs())).fold(0.0, f64::max)
}

fn bits(all: &[f64]) -> Vec<u64> {
    all.iter().map(|x| x.to_bits()).collect()
}

#[test]
fn numbers_that_are_set_are_those_of_a_mechanism_built_so() -> kin::Result<()> {
    let plain = |all| {
        let mut m = Mechanism::new("arm");
        arm(&mut m, all).and_then(|()| m.build())
    };
    let mut system = described()?.build()?;
    let before = efforts(&plain(NOMINAL)?);
    assert!(far(&efforts(&system), &before) < 1e-13);
    // One after the other, each of them noticed.
    let mut now = NOMINAL;
    for (k, name) in NAMES.into_iter().enumerate() {
        let last = efforts(&system);
        system.set(name, OTHER[k])?;
        now[k] = OTHER[k];
        let set = efforts(&system);
        let built = efforts(&plain(now)?);
        assert!(far(&set, &built) < 1e-13, "{name}");
        assert!(far(&set, &last) > 1e-6, "nothing hangs on {name}");
    }
    Ok(())
}

#[test]
fn any_way_there_gives_the_same_bits() -> kin::Result<()> {
    let fresh = described()?.build()?;
    let mut straight = fresh.clone();
    NAMES.iter().zip(OTHER).try_for_each(|(name, x)| straight.set(name, x))?;
    let expected = bits(&efforts(&straight));
    let mut other = fresh.clone();
    other.set("m", 7.0)?;
    NAMES.iter().zip(OTHER).rev().try_for_each(|(name, x)| other.set(name, x))?;
    assert_eq!(bits(&efforts(&other)), expected);
    // By a sweep, whose cases are independent of one another, on lanes and without.
    let cases: Vec<[f64; 10]> = (0..9).map(|k| if k % 3 == 1 { OTHER } else { NOMINAL }).collect();
    for lanes in [kin::extend::Lanes::Best, kin::extend::Lanes::Off] {
        let peaks = fresh.sweep(NAMES)?.lanes(lanes).forces(&cases, times(), |_, forces| {
            kin::Result::Ok(forces?.drive("motor")?.effort().max())
        })?;
        let peak = |system: &System| {
            let motion = system.run(times())?;
            Ok::<f64, Error>(system.forces(&motion)?.drive("motor")?.effort().max())
        };
        let nominal = peak(&fresh)?;
        let set = peak(&straight)?;
        for (k, found) in peaks.into_iter().enumerate() {
            let wanted = if k % 3 == 1 { set } else { nominal };
            assert!((found? - wanted).abs() < 1e-9 * wanted.abs(), "{k}");
        }
    }
    // And back again.
    NAMES.iter().zip(NOMINAL).try_for_each(|(name, x)| straight.set(name, x))?;
    assert_eq!(bits(&efforts(&straight)), bits(&efforts(&fresh)));
    Ok(())
}

/// A body in space with a tensor, gravity in three components, a force by laws.
fn rotor<S: IntoNumber>(m: &mut Mechanism, [mass, c, j, product]: [S; 4]) -> kin::Result<()> {
    let zero = S::from(0.0);
    let z = vec3(0.0, 0.0, 1.0);
    let rotor = m.spatial("rotor", SpatialPose::at((0.0, 0.0, 0.0)))?;
    m.add("shaft", spatial::revolute(rotor, Ground, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), z, z))?;
    m.add("motor", spatial::drive_turn(rotor, Ground, z, z, Law::linear(0.2, 4.0)))?;
    m.mass(rotor, mass, [c, zero, c], [[j, zero, product], [zero, j, zero], [product, zero, j]])?;
    m.gravity(Vec3 { x: zero, y: mass * S::from(-2.0), z: zero });
    m.load("push", Load::force(rotor, [zero, c, zero], Vec3 { x: mass, y: zero, z: c }))
}

#[test]
fn a_tensor_hangs_on_dimensions() -> kin::Result<()> {
    let mut m = Mechanism::new("rotor");
    let all = [("mass", 2.0), ("c", 0.1), ("j", 0.3), ("product", 0.05)]
        .map(|(name, x)| m.dimension(name, x));
    let [a, b, c, d] = all;
    rotor(&mut m, [a?, b?, c?, d?])?;
    let mut system = m.clone().build()?;
    let mut again = Mechanism::from_data(&m.data()?, &Registry::new())?.build()?;
    for (name, x) in [("mass", 3.0), ("c", -0.2), ("j", 0.5), ("product", -0.1)] {
        system.set(name, x)?;
        again.set(name, x)?;
    }
    let mut plain = Mechanism::new("rotor");
    rotor(&mut plain, [3.0, -0.2, 0.5, -0.1])?;
    let found = efforts(&system);
    assert!(far(&found, &efforts(&plain.build()?)) < 1e-13);
    assert_eq!(bits(&found), bits(&efforts(&again)));
    // A tensor that no body has is told, and the system stays as it was.
    for (name, x, told) in [
        ("product", 0.9, "`product`: with the value 0.9 `rotor`"),
        ("product", f64::NAN, "`product`: the value is NaN"),
        ("j", -0.1, "the principal moment"),
        ("mass", -1.0, "the mass is -1. Give a value above zero"),
    ] {
        let error = system.set(name, x).expect_err(name).to_string();
        assert!(error.contains(told), "{error}\n  for {told}");
        assert_eq!(bits(&efforts(&system)), bits(&found), "{name}");
    }
    Ok(())
}

/// The tip of a pendulum.      [m]
#[constraint]
fn tip(theta: Coord, l: f64) -> (f64, f64) {
    let (sin, cos) = theta.sin_cos();
    (l * sin, -l * cos)
}

#[test]
fn a_point_with_mass_hangs_on_dimensions() -> kin::Result<()> {
    let build = |described: bool, [bob, l]: [f64; 2]| {
        let mut m = Mechanism::new("pendulum");
        let theta = m.angle("theta", 0.3)?;
        m.add("motor", drive(theta, Law::sine(0.4, 2.0, 0.1)))?;
        m.gravity(vec2(0.0, -9.81));
        match described {
            true => {
                let bob = m.dimension("bob", bob)?;
                let l = m.dimension("l", l)?;
                m.point_mass("bob", tip(theta, l), bob)?;
            }
            false => m.point_mass("bob", tip(theta, l), bob)?,
        }
        Ok::<Mechanism, Error>(m)
    };
    let effort = |system: &System| {
        let motion = system.run_both(times())?;
        Ok::<Vec<f64>, Error>(system.forces(&motion)?.drive("motor")?.effort().values().to_vec())
    };
    let described = build(true, [2.0, 0.4])?;
    let data = described.data()?;
    assert_eq!(Mechanism::from_data(&data, &Registry::new().with::<tip>())?.data()?, data);
    let mut system = described.build()?;
    system.set("bob", 3.5)?;
    system.set("l", 0.9)?;
    let set = effort(&system)?;
    assert!(far(&set, &effort(&build(false, [3.5, 0.9])?.build()?)?) < 1e-13);
    let error = system.set("bob", 0.0).expect_err("no mass").to_string();
    assert!(
        error.contains("`bob`: with the value 0 ")
            && error.contains("the mass is 0. Give a value above zero"),
        "{error}"
    );
    assert_eq!(bits(&effort(&system)?), bits(&set));
    Ok(())
}

/// A number that makes no sense is told with the dimension and the thing, and leaves the system as
/// it was.
#[test]
fn what_makes_no_sense_is_told_by_name() -> kin::Result<()> {
    let mut system = described()?.build()?;
    let before = efforts(&system);
    for (name, x, told) in [
        ("m", -1.0, "the dimension `m`: with the value -1 `arm` (mass): "),
        ("m", 0.0, "the mass is 0. Give a value above zero"),
        ("J", -0.01, "the dimension `J`: with the value -0.01 `arm` (mass): "),
        ("r", 0.0, "the dimension `r`: with the value 0 `O` (friction): "),
        ("mu", -0.1, "the coefficient of friction is -0.1"),
        ("g", f64::INFINITY, "the dimension `g`: the value is inf"),
        ("nobody", 1.0, "nobody"),
    ] {
        let error = system.set(name, x).expect_err(name).to_string();
        assert!(error.contains(told), "{error}\n  for {told}");
        assert_eq!(bits(&efforts(&system)), bits(&before), "{name}");
    }
    Ok(())
}

/// Expressions that are not finite, ranges, and dimensions of another mechanism.
#[test]
fn expressions_ranges_and_strangers_are_told_by_name() -> kin::Result<()> {
    let mut m = Mechanism::new("bar");
    let bar = m.link("bar", 1.0)?;
    m.add("O", revolute(bar, Ground, bar.start(), (0.0, 0.0)))?;
    m.add("motor", drive_angle(bar, Law::ramp(1.0)))?;
    let x = m.dimension("x", 2.0)?.within(0.0, 5.0);
    m.mass(bar, x + 1.0, (0.0, 0.0), 0.1)?;
    m.gravity(vec2(0.0, 1.0 / x));
    m.load("push", Load::force(bar, (0.0, 1.0 / x), vec2(1.0, 0.0)))?;
    m.load("pull", Load::force(bar, (0.0, 0.0), [Law::constant(1.0 / x), Law::constant(0.0)]))?;
    let mut system = m.clone().build()?;
    assert!(system.set("x", 6.0).expect_err("a range").to_string().contains("outside the range"));
    let error = system.set("x", 0.0).expect_err("1/0").to_string();
    assert!(error.contains("the dimension `x`: with the value 0 "), "{error}");
    system.set("x", 4.0)?;
    let stranger = Mechanism::new("other").dimension("y", 1.0)?;
    let mut other = Mechanism::new("other");
    let y = other.dimension("y", 1.0)?;
    for y in [y, stranger] {
        let all = [
            m.mass(bar, y, (0.0, 0.0), 0.1),
            m.load("a", Load::force(bar, (y, 0.0), vec2(1.0, 0.0))),
            m.load("b", Load::torque(bar, y)),
            m.load("c", loads::coordinate_spring(bar.theta(), y, 0.0)),
            m.friction("O", Friction::pin(y, 0.1, 1e-3)),
        ];
        for error in all {
            let error = error.expect_err("a stranger");
            assert!(
                matches!(&error, Error::Dimension(found) if matches!(**found, DimensionError::Foreign { .. })),
                "{error}"
            );
        }
    }
    let mut late = m.clone();
    late.gravity(vec2(0.0, y));
    assert!(
        late.build()
            .map(|_| ())
            .expect_err("a stranger")
            .to_string()
            .contains("does not belong to")
    );
    // The mechanism stays as it was.
    assert_eq!(m.data()?, m.clone().data()?);
    m.build().map(|_| ())
}

#[test]
fn files_carry_what_hangs() -> kin::Result<()> {
    let m = described()?;
    let text = serde_json::to_string(&m.data()?).expect("JSON");
    for part in [
        r#""mass":"m""#,
        r#""gravity":[0.0,"g",0.0]"#,
        r#""coefficient":"mu""#,
        r#""radius":"r""#,
        r#""damping":"k * 0.01""#,
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
    let data = serde_json::from_str(&text).expect("data");
    let back = Mechanism::from_data(&data, &Registry::new())?;
    assert_eq!(back.data()?, data);
    let mut one = m.build()?;
    let mut other = back.build()?;
    for (name, x) in NAMES.into_iter().zip(OTHER) {
        one.set(name, x)?;
        other.set(name, x)?;
        assert_eq!(bits(&efforts(&one)), bits(&efforts(&other)), "{name}");
    }
    let wrong = text.replace(r#""mass":"m""#, r#""mass":"nobody + 1""#);
    let data = serde_json::from_str(&wrong).expect("data");
    let error =
        Mechanism::from_data(&data, &Registry::new()).map(|_| ()).expect_err("nobody").to_string();
    assert!(
        error.contains("mass of `arm`") && error.contains("there is no dimension `nobody`"),
        "{error}"
    );
    Ok(())
}

/// A dimension of a mass moves nothing: it has no share in how far a measure may be off.
#[test]
fn masses_have_no_share_in_a_motion() -> kin::Result<()> {
    let mut m = Mechanism::new("bar");
    let a = m.dimension("a", 1.0)?.tolerance(1e-3);
    let mass = m.dimension("mass", 2.0)?.tolerance(0.1);
    let bar = m.link("bar", a)?;
    m.mass(bar, mass, (0.0, 0.0), mass * a * a / 12.0)?;
    m.add("O", revolute(bar, Ground, bar.start(), (0.0, 0.0)))?;
    m.add("motor", drive_angle(bar, Law::ramp(1.0)))?;
    let system = m.build()?;
    let motion = system.run_both([0.5])?;
    let found = system.tolerance(&motion, bar.x())?;
    let names: Vec<&str> = found.contributions.iter().map(|one| one.name.as_str()).collect();
    assert_eq!(names, ["a"]);
    assert!((found.worst_case() - 0.5e-3 * 0.5_f64.cos()).abs() < 1e-15);
    let error = system
        .sensitivities(&motion, ["mass"])
        .map(|_| ())
        .expect_err("it moves nothing")
        .to_string();
    assert!(
        error.contains("`mass`") && error.contains("no equation depends on the parameter"),
        "{error}"
    );
    Ok(())
}
