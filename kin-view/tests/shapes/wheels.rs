//! Gears, racks and belts.

use super::*;

#[test]
fn gears_are_pitch_circles_that_meet_at_the_pitch_point() -> Result<()> {
    let mut m = Mechanism::new("pair of gears");
    let ground = m.ground();
    let small = m.planar("pinion", pose(1.0, 0.5, 0.0))?;
    let large = m.planar("wheel", pose(0.0, 0.0, 0.0))?;
    // The axle of the pinion is not where its frame is.
    let at = vec2(3.0, 4.0) * 0.12;
    let axle = vec2(0.05, 0.0);
    m.add("axle 1", revolute(ground, small, at, axle))?;
    m.add("axle 2", revolute(ground, large, vec2(0.0, 0.0), vec2(0.0, 0.0)))?;
    m.add("mesh", gear(small, large, ground, 0.2, 0.4, 0.3))?;
    m.add("motor", drive_angle(large, Law::ramp(1.0)))?;
    let system = m.build()?;
    let drawn = Drawn::new(&Scene::new(&system), &system.run(linspace(0.0, 1.0, 21))?)?;
    let pinion = drawn.discs("pinion");
    let wheel = drawn.discs("wheel");
    let near = |discs: &[(Vec3, f64)], centre: Vec3, radius: f64| {
        discs.iter().any(|(c, r)| (*c - centre).norm() < 1e-6 && (r - radius).abs() < 1e-6)
    };
    assert!(near(&pinion, vec3(axle.x, axle.y, 0.0), 0.2), "{pinion:?}");
    assert!(near(&wheel, vec3(0.0, 0.0, 0.0), 0.4), "{wheel:?}");
    // Radii add up to the distance of the axles: both circles meet there, and a mark of either
    // stands where they meet, at θ_wheel = 0.
    assert!((at.norm() - 0.6).abs() < 1e-12);
    let mark = |name: &str, direction: f64| {
        let shapes = drawn.shapes(name);
        let (_, comb) = shapes
            .iter()
            .find(|(style, points)| style == "slot" && points.len() > 50)
            .expect("marks");
        let centre = if name == "pinion" { vec3(axle.x, axle.y, 0.0) } else { vec3(0.0, 0.0, 0.0) };
        let radius = most_far(comb, centre);
        let towards = vec3(direction.cos(), direction.sin(), 0.0);
        comb.iter().any(|p| {
            (*p - centre).norm() < 0.99 * radius
                && (*p - centre).cross(towards).norm() < 1e-5
                && (*p - centre).dot(towards) > 0.0
        })
    };
    let beta = at.y.atan2(at.x);
    assert!(mark("wheel", beta), "a mark of the wheel at the pitch point");
    assert!(
        mark("pinion", beta + PI - 0.3),
        "a mark of the pinion, which is turned by the phase, at the pitch point"
    );
    Ok(())
}

fn most_far(points: &[Vec3], centre: Vec3) -> f64 {
    points.iter().map(|p| (*p - centre).norm()).fold(0.0, f64::max)
}

#[test]
fn a_planetary_train_has_sun_planet_and_ring_that_touch() -> Result<()> {
    let mut m = Mechanism::new("planetary train");
    let ground = m.ground();
    let origin = vec2(0.0, 0.0);
    let carrier = m.planar("carrier", pose(0.0, 0.0, 0.0))?;
    let sun = m.planar("sun", pose(0.0, 0.0, 0.0))?;
    let planet = m.planar("planet", pose(0.05, 0.0, 0.0))?;
    m.add("axle of the carrier", revolute(ground, carrier, origin, origin))?;
    m.add("axle of the sun", revolute(ground, sun, origin, origin))?;
    m.add("axle of the planet", revolute(carrier, planet, vec2(0.05, 0.0), origin))?;
    m.add("sun mesh", gear(planet, sun, carrier, 0.02, 0.03, 0.0))?;
    m.add("ring mesh", internal_gear(planet, ground, carrier, 0.02, 0.07, 0.0))?;
    m.add("motor", drive_angle(carrier, Law::ramp(1.0)))?;
    let system = m.build()?;
    let drawn = Drawn::new(&Scene::new(&system), &system.run(linspace(0.0, 1.0, 41))?)?;
    let radius = |name: &str| drawn.discs(name).into_iter().map(|(_, r)| r).fold(0.0, f64::max);
    assert!((radius("sun") - 0.03).abs() < 1e-6 && (radius("planet") - 0.02).abs() < 1e-6);
    let shapes = drawn.shapes("ground");
    let ring = shapes
        .iter()
        .find_map(|(_, points)| circle(points).filter(|(_, r)| (r - 0.07).abs() < 1e-5));
    assert!(
        ring.is_some(),
        "a ring at the pitch radius: {:?}",
        shapes.iter().map(|(_, points)| circle(points)).collect::<Vec<_>>()
    );
    Ok(())
}

#[test]
fn a_pinion_rolls_on_its_rack_and_a_wheel_on_its_track() -> Result<()> {
    for teeth in [true, false] {
        let mut m = Mechanism::new("rolling");
        let ground = m.ground();
        let wheel = m.planar("wheel", pose(0.0, 0.3, 0.0))?;
        let from = vec2(0.0, 0.1);
        let along = vec2(2.0, 0.0);
        if teeth {
            m.add("rack", rack_and_pinion(wheel, ground, vec2(0.0, 0.0), from, along, 0.2, 0.0))?;
            m.add("height", drive(wheel.y(), Law::constant(0.3)))?;
        } else {
            m.add("track", rolling(wheel, ground, vec2(0.0, 0.0), from, along, 0.2, 0.0))?;
        }
        m.add("motor", drive(wheel.x(), Law::linear(0.0, 1.0)))?;
        let system = m.build()?;
        let drawn = Drawn::new(&Scene::new(&system), &system.run(linspace(0.0, 1.0, 21))?)?;
        let discs = drawn.discs("wheel");
        assert!(discs.iter().any(|(c, r)| c.norm() < 1e-6 && (r - 0.2).abs() < 1e-6), "{discs:?}");
        let shapes = drawn.shapes("ground");
        let [(style, line)] = &shapes[..] else { panic!("one line: {shapes:?}") };
        assert_eq!(style, "guide");
        assert!(
            (most(line, vec3(0.0, 1.0, 0.0)) - 0.1).abs() < 1e-6,
            "the pitch line touches the wheel from below"
        );
        assert!(
            most(line, vec3(1.0, 0.0, 0.0)) > 1.0 && most(line, vec3(-1.0, 0.0, 0.0)) > 0.0,
            "it is as long as the way"
        );
    }
    Ok(())
}

#[test]
fn a_belt_touches_both_pulleys() -> Result<()> {
    for crossed in [false, true] {
        let mut m = Mechanism::new("belt");
        let ground = m.ground();
        let a = m.planar("a", pose(0.0, 0.0, 0.0))?;
        let b = m.planar("b", pose(1.0, 0.2, 0.0))?;
        let at_a = vec2(0.0, 0.0);
        let at_b = vec2(1.0, 0.2);
        let origin = vec2(0.0, 0.0);
        m.add("axle a", revolute(ground, a, at_a, origin))?;
        m.add("axle b", revolute(ground, b, at_b, origin))?;
        let r_a = 0.1;
        let r_b = if crossed { -0.3 } else { 0.3 };
        m.add("belt", belt(a, b, ground, r_a, r_b, 0.0))?;
        m.add("motor", drive_angle(a, Law::ramp(1.0)))?;
        let system = m.build()?;
        let drawn = Drawn::new(&Scene::new(&system), &system.run(linspace(0.0, 1.0, 21))?)?;
        let shapes = drawn.shapes("ground");
        let [(_, line)] = &shapes[..] else { panic!("one belt: {} shapes", shapes.len()) };
        // No piece of the belt comes nearer to an axle than the radius (but for the corners of
        // arcs), and it lies on both.
        for (at, radius) in [(at_a, 0.1), (at_b, 0.3)] {
            let nearest = distance_to(line, vec3(at.x, at.y, 0.0));
            assert!((nearest - radius).abs() < 0.003 * radius, "{nearest} for {radius}");
        }
        // The middle between the axles, along their line, is crossed by a crossed belt alone.
        let inner = at_a + (at_b - at_a) * (0.1 / 0.4);
        let crosses = distance_to(line, vec3(inner.x, inner.y, 0.0)) < 1e-6;
        assert_eq!(crosses, crossed);
    }
    Ok(())
}
