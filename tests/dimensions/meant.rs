//! Which assembly is meant, and where bodies face, by dimensions.

use kin::data::Registry;
use kin::prelude::*;
use kin::{Axis, deg};

use crate::engines::Engines;
use crate::times;

/// A four-bar whose rocker, or its angle at B, is preferred at a dimension.
fn four_bar(by_measure: bool) -> kin::Result<Mechanism> {
    let mut m = Mechanism::new("four-bar");
    let side = m.dimension("side", deg(100.0))?;
    let crank = m.link("crank", 1.0)?;
    let coupler = m.link("coupler", 3.5)?;
    let rocker = m.link("rocker", 3.0)?;
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0)))?;
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
    m.add("C", revolute(rocker, Ground, rocker.start(), (4.0, 0.0)))?;
    m.add("motor", drive_angle(crank, Law::ramp(1.0)))?;
    match by_measure {
        true => m.prefer("C.angle", side),
        false => m.prefer(rocker, side),
    }
    Ok(m)
}

#[test]
fn a_preference_hangs_on_a_dimension() -> kin::Result<()> {
    for by_measure in [false, true] {
        let m = four_bar(by_measure)?;
        let mut system = m.clone().build()?;
        let mut again = Mechanism::from_data(&m.data()?, &Registry::new())?.build()?;
        let rocker =
            |system: &System| Ok::<f64, kin::Error>(system.run_both(times())?.q(0)[8].sin());
        assert!(rocker(&system)? > 0.5, "{by_measure}");
        for (side, up) in [(-100.0, false), (95.0, true), (-80.0, false)] {
            system.set("side", deg(side))?;
            again.set("side", deg(side))?;
            for system in [&system, &again] {
                assert_eq!(rocker(system)? > 0.0, up, "{by_measure} {side}");
            }
        }
        assert!(system.set("side", f64::NAN).is_err() && rocker(&system)? < 0.0);
        // Preferred once more at a number it hangs on nothing.
        let mut constant = m.clone();
        match by_measure {
            true => constant.prefer("C.angle", deg(100.0)),
            false => constant.prefer("rocker.theta", deg(100.0)),
        }
        if by_measure {
            let error = constant.build().map(|_| ()).expect_err("unused").to_string();
            assert!(
                error.contains("no number of the mechanism depends on the dimension `side`"),
                "{error}"
            );
        }
    }
    Ok(())
}

/// How a body is turned in space by a preference whose numbers hang on a dimension.
#[test]
fn a_turn_is_preferred_by_a_dimension() -> kin::Result<()> {
    let build = |described: bool, half: f64| {
        let mut m = Mechanism::new("held");
        let body = m.spatial("body", SpatialPose::at((1.0, 2.0, 3.0)))?;
        match described {
            true => {
                let half = m.dimension("half", half)?;
                m.prefer(
                    body,
                    EulerParameters {
                        e0: half.cos(),
                        e1: half.sin(),
                        e2: 0.0.into(),
                        e3: 0.0.into(),
                    },
                );
            }
            false => m.prefer(body, EulerParameters::new(half.cos(), half.sin(), 0.0, 0.0)),
        }
        let p = EulerParameters::new(0.8, 0.6, 0.0, 0.0);
        m.add("held", spatial::fixed(body, (1.0, 2.0, 3.0), p))?;
        m.build()
    };
    let mut system = build(true, 0.3)?;
    for half in [0.3, 1.0, -0.4] {
        system.set("half", half)?;
        let built = build(false, half)?;
        let off = system.initial().iter().zip(built.initial()).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-15, "{:?} {:?}", system.initial(), built.initial());
    }
    Ok(())
}

/// A body that faces a direction of dimensions is turned anew where these are set.
#[test]
fn a_body_faces_where_dimensions_say() -> kin::Result<()> {
    let build = |x: f64, y: f64| {
        let mut m = Mechanism::new("facing");
        let z = vec3(0.0, 0.0, 1.0);
        let one = m.spatial("one", SpatialPose::facing((y, 0.0, 0.0), vec3(x, y, 0.5)))?;
        let two = m.spatial(
            "two",
            SpatialPose::facing((0.0, 0.0, 0.0), Axis::new(vec3(x, 1.0, 0.0), z)),
        )?;
        Ok::<_, kin::Error>((m, one, two))
    };
    let mut m = Mechanism::new("facing");
    let x = m.dimension("x", 1.0)?;
    let y = m.dimension("y", 0.2)?;
    let one = m.spatial("one", SpatialPose::facing((y, 0.0, 0.0), (x, y, 0.5)))?;
    let two = m.spatial("two", SpatialPose::at((0.0, 0.0, 0.0)))?;
    let z = vec3(0.0, 0.0, 1.0);
    m.set_spatial_pose(two, SpatialPose::facing((0.0, 0.0, 0.0), Axis::new((x, 1.0, 0.0), z)))?;
    for (name, body) in [("one", one), ("two", two)] {
        m.add(
            name,
            spatial::fixed(body, (0.0, 0.0, 0.0), EulerParameters::new(1.0, 0.0, 0.0, 0.0)),
        )?;
    }
    let data = m.data()?;
    let text = serde_json::to_string(&data).expect("JSON");
    assert!(text.contains(r#""facing":["y",0.0,0.0,"x","y",0.5]"#), "{text}");
    let mut again = Mechanism::from_data(&data, &Registry::new())?;
    assert_eq!(again.data()?, data);
    let mut again = std::mem::replace(&mut again, Mechanism::new("none")).build()?;
    let mut system = m.clone().build()?;
    for (x, y) in [(1.0, 0.2), (-3.0, 0.7), (0.1, -2.0)] {
        for system in [&mut system, &mut again] {
            system.set("x", x)?;
            system.set("y", y)?;
        }
        let (plain, ..) = build(x, y)?;
        assert_eq!(system.initial(), again.initial());
        let guess: Vec<f64> =
            plain.data()?.bodies.iter().flat_map(|body| body.guess.clone()).map(number).collect();
        let off = system.initial().iter().zip(&guess).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-15, "{:?} {guess:?}", system.initial());
    }
    // A direction that is none is told by name, and the guess stays.
    let mut m = Mechanism::new("none");
    let x = m.dimension("x", 1.0)?;
    let body = m.spatial("body", SpatialPose::facing((0.0, 0.0, 0.0), (x, 0.0, 0.0)))?;
    m.add("held", spatial::fixed(body, (0.0, 0.0, 0.0), EulerParameters::new(1.0, 0.0, 0.0, 0.0)))?;
    let mut system = m.build()?;
    let before = system.initial().to_vec();
    let error = system.set("x", 0.0).expect_err("no direction").to_string();
    assert!(error.contains("the dimension `x`: with the value 0 "), "{error}");
    assert_eq!(system.initial(), before);
    Ok(())
}

fn number(number: kin::data::NumberData) -> f64 {
    match number {
        kin::data::NumberData::Number(x) => x,
        kin::data::NumberData::Expression(text) => panic!("{text}"),
    }
}
