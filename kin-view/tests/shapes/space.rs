//! Mechanisms in space: marks of what turns about itself, and where the eye stands.

use std::f64::consts::FRAC_PI_2;

use super::*;

/// A shaft with its bearing at the origin, which turns about an axis in it.
fn shaft(axis: Vec3, law: Law) -> Result<(System, SpatialBody)> {
    let mut m = Mechanism::new("shaft");
    let ground = m.ground();
    let zero = vec3(0.0, 0.0, 0.0);
    let shaft = m.spatial("shaft", SpatialPose::at(zero))?;
    m.add("bearing", spatial::revolute(shaft, ground, zero, zero, axis, axis))?;
    m.add("motor", joints::drivers::spatial::drive_turn(shaft, ground, axis, axis, law))?;
    Ok((m.build()?, shaft))
}

#[test]
fn what_turns_about_its_own_length_has_a_mark_that_moves() -> Result<()> {
    let along = vec3(0.6, 0.0, 0.8);
    let times = linspace(0.0, 1.0, 21);
    let drawn = |end: Vec3, law: Law| -> Result<Drawn> {
        let (system, shaft) = shaft(along, law)?;
        Drawn::new(&Scene::new(&system).trace("end", shaft, end), &system.run(&times)?)
    };
    let shapes = drawn(along * 2.0, Law::ramp(TAU))?.shapes("shaft");
    let styles: Vec<&str> = shapes.iter().map(|(style, _)| style.as_str()).collect();
    assert_eq!(styles, ["plate", "slot", "bar"]);
    // The disc stands across the shaft, in its middle; the spoke goes out to its edge.
    let disc = &shapes[0].1;
    let spoke = &shapes[1].1;
    let bar = &shapes[2].1;
    let (centre, radius) = circle(disc).expect("a circle");
    let axis = bar[1] - bar[0];
    assert!((centre - (bar[0] + bar[1]) * 0.5).norm() < 1e-6 && radius > 0.03 * axis.norm());
    assert!(disc.iter().all(|p| (*p - centre).dot(axis).abs() < 1e-6));
    assert!(
        (spoke[0] - centre).norm() < 1e-6 && ((spoke[1] - centre).norm() - radius).abs() < 1e-5
    );
    // A bar that only swings has no mark, nor has a shaft that stands still.
    let swings = drawn(vec3(0.8, 0.0, -0.6), Law::ramp(TAU))?.shapes("shaft");
    assert_eq!(swings.iter().map(|(style, _)| style.as_str()).collect::<Vec<_>>(), ["bar"]);
    assert!(
        drawn(along, Law::constant(0.0))?.shapes("shaft").iter().all(|(style, _)| style != "slot")
    );
    // One point alone shows its axis by the disc.
    let (system, _) = shaft(along, Law::ramp(TAU))?;
    let alone = Drawn::new(&Scene::new(&system), &system.run(&times)?)?.shapes("shaft");
    let (_, disc) = alone.iter().find(|(style, _)| style == "plate").expect("a disc");
    assert!(disc.iter().all(|p| p.dot(along).abs() < 1e-6), "the disc stands across the axis");
    Ok(())
}

#[test]
fn a_disc_of_one_point_that_turns_in_the_plane_has_a_mark() -> Result<()> {
    let shown = |law: Law| -> Result<Vec<String>> {
        let mut m = Mechanism::new("knob");
        let knob = m.planar("knob", pose(0.0, 0.0, 0.0))?;
        m.add("O", revolute(m.ground(), knob, vec2(0.0, 0.0), vec2(0.0, 0.0)))?;
        m.add("motor", drive_angle(knob, law))?;
        let system = m.build()?;
        let drawn = Drawn::new(&Scene::new(&system), &system.run(linspace(0.0, 1.0, 21))?)?;
        Ok(drawn.shapes("knob").into_iter().map(|(style, _)| style).collect())
    };
    assert_eq!(shown(Law::ramp(1.0))?, ["plate", "slot"]);
    assert!(!shown(Law::constant(0.0))?.contains(&"slot".to_string()));
    Ok(())
}

#[test]
fn the_eye_looks_straight_at_a_mechanism_that_moves_in_one_plane() -> Result<()> {
    let times = linspace(0.0, 1.0, 21);
    let x = vec3(1.0, 0.0, 0.0);
    let y = vec3(0.0, 1.0, 0.0);
    let z = vec3(0.0, 0.0, 1.0);
    let eye = |scene: Scene, system: &System| -> Result<[f64; 2]> {
        let drawn = Drawn::new(&scene, &system.run(&times)?)?;
        Ok([0, 1].map(|k| drawn.data["eye"][k].as_f64().unwrap()))
    };
    let low = [-FRAC_PI_2, 0.0];
    for (normal, expected) in [(z, [-FRAC_PI_2, FRAC_PI_2]), (y, low), (-y, low), (x, [0.0, 0.0])] {
        let (system, _) = shaft(normal, Law::ramp(TAU))?;
        let found = eye(Scene::new(&system), &system)?;
        let off = found.iter().zip(expected).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
        assert!(off < 1e-6, "{normal:?}: {found:?}");
        assert_eq!(
            eye(Scene::new(&system).seen_from(0.3, 0.2), &system)?,
            [0.3, 0.2],
            "what is told counts"
        );
    }
    let (leaning, _) = shaft(vec3(0.0, -0.6, 0.8), Law::ramp(TAU))?;
    assert!(
        (eye(Scene::new(&leaning), &leaning)?[1] - 0.8_f64.asin()).abs() < 1e-6,
        "its plane leans"
    );
    // Two shafts that cross have no plane in common.
    let mut m = Mechanism::new("two shafts");
    let ground = m.ground();
    let zero = vec3(0.0, 0.0, 0.0);
    for (name, axis) in [("one", x), ("other", z)] {
        let shaft = m.spatial(name, SpatialPose::at(zero))?;
        m.add(
            &format!("bearing {name}"),
            spatial::revolute(shaft, ground, zero, zero, axis, axis),
        )?;
        let motor = joints::drivers::spatial::drive_turn(shaft, ground, axis, axis, Law::ramp(1.0));
        m.add(&format!("motor {name}"), motor)?;
    }
    let system = m.build()?;
    assert_eq!(eye(Scene::new(&system), &system)?, [-1.05, 0.35]);
    Ok(())
}
