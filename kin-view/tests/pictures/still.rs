//! Animated pictures: what they show at rest, and between poses that are far apart.

use super::*;

/// Two wheels that mesh; the axle of the small one is off its frame.
fn gears() -> Result<System> {
    let mut m = Mechanism::new("gears");
    let ground = m.ground();
    let o = vec2(0.0, 0.0);
    let small = m.planar("pinion", pose(0.6, 0.0, 0.0))?;
    let large = m.planar("wheel", pose(0.0, 0.0, 0.0))?;
    m.add("axle 1", revolute(ground, small, vec2(0.6, 0.0), vec2(0.05, 0.0)))?;
    m.add("axle 2", revolute(ground, large, o, o))?;
    m.add("mesh", kin::joints::planar::gear(small, large, ground, 0.2, 0.4, 0.0))?;
    m.add("motor", drive_angle(large, Law::ramp(std::f64::consts::PI)))?;
    m.build()
}

/// A shaft that turns about its length.
fn shaft() -> Result<System> {
    let mut m = Mechanism::new("shaft");
    let ground = m.ground();
    let x = vec3(1.0, 0.0, 0.0);
    let shaft = m.spatial_link_between("shaft", vec3(0.0, 0.0, 0.0), vec3(2.0, 0.0, 0.0))?;
    m.add(
        "bearing",
        kin::joints::spatial::revolute(shaft, ground, shaft.start(), vec3(0.0, 0.0, 0.0), x, x),
    )?;
    m.add(
        "motor",
        kin::joints::drivers::spatial::drive_turn(
            shaft,
            ground,
            x,
            x,
            Law::ramp(std::f64::consts::TAU),
        ),
    )?;
    m.build()
}

/// The first of the values of an animation.
fn first<'a>(node: &roxmltree::Node<'a, '_>, name: &str) -> Option<&'a str> {
    let animation = node.children().find(|child| {
        child.attribute("attributeName") == Some(name) || child.attribute("type") == Some(name)
    });
    animation.and_then(|child| child.attribute("values")?.split(';').next())
}

#[test]
fn an_animated_picture_stands_in_its_first_pose_where_nothing_moves() -> Result<()> {
    let (planar, coupler) = four_bar("four-bar", 1.0)?;
    let spatial = tripod()?;
    let mut counted = [0; 3];
    for (system, scene) in [
        (&planar, Scene::new(&planar).trace("P", coupler, vec2(0.2, 1.4))),
        (&spatial, Scene::new(&spatial)),
    ] {
        let picture = scene.animated(&system.run(linspace(0.0, 1.0, 50))?, 3.0)?;
        for node in parsed(picture.svg()).descendants() {
            if let (Some(moved), Some(turned)) = (first(&node, "translate"), first(&node, "rotate"))
            {
                assert_eq!(
                    node.attribute("transform"),
                    Some(&*format!("translate({moved}) rotate({turned})"))
                );
                counted[0] += 1;
            }
            for (k, name) in [(1, "points"), (2, "cx"), (2, "cy")] {
                if let Some(value) = first(&node, name) {
                    assert_eq!(node.attribute(name), Some(value));
                    counted[k] += 1;
                }
            }
        }
    }
    assert!(counted.iter().all(|count| *count > 2), "{counted:?}");
    Ok(())
}

#[test]
fn nothing_is_drawn_between_poses_that_are_far_apart() -> Result<()> {
    for system in [gears()?, shaft()?] {
        let shown = |count: usize| -> Result<(bool, bool)> {
            let motion = system.run(linspace(0.0, 4.0, count))?;
            let scene = Scene::new(&system);
            let svg = scene.animated(&motion, 3.0)?.svg().to_string();
            Ok((
                svg.contains("calcMode=\"discrete\""),
                !data(&scene.page(&motion)?.html())["leaps"].is_null(),
            ))
        };
        // One whole turn a step, two of them, and many steps a turn.
        assert_eq!(shown(5)?, (true, true), "{}", system.name());
        assert_eq!(shown(3)?, (true, true), "{}", system.name());
        assert_eq!(shown(401)?, (false, false), "{}", system.name());
    }
    Ok(())
}
