//! Drawn things have the size and the place that the mechanism gives them.

mod space;
mod wheels;

use std::f64::consts::{PI, TAU};

use kin::extend::Target;
use kin::joints::drivers::{drive, drive_angle};
use kin::joints::planar::*;
use kin::joints::spatial;
use kin::law::Ends;
use kin::*;
use kin_view::Scene;
use serde_json::Value;

/// The drawing on the page of a motion.
struct Drawn {
    data: Value,
}

impl Drawn {
    fn new(scene: &Scene, motion: &Motion) -> Result<Drawn> {
        let html = scene.page(motion)?.html();
        let (_, rest) = html.split_once("<script id=\"data\" type=\"application/json\">").unwrap();
        Ok(Drawn { data: serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap() })
    }

    /// The shapes of a body in its own frame, with their styles.
    fn shapes(&self, name: &str) -> Vec<(String, Vec<Vec3>)> {
        let all =
            self.data["shapes"].as_array().unwrap().iter().filter(|shape| shape["name"] == name);
        all.map(|shape| (shape["style"].as_str().unwrap().to_string(), points(&shape["points"])))
            .collect()
    }

    /// Centres and radii of the filled circles of a body.
    fn discs(&self, name: &str) -> Vec<(Vec3, f64)> {
        self.shapes(name)
            .iter()
            .filter(|(style, _)| style == "plate")
            .filter_map(|(_, points)| circle(points))
            .collect()
    }
}

fn points(list: &Value) -> Vec<Vec3> {
    let number = |p: &Value, k: usize| p[k].as_f64().unwrap();
    list.as_array()
        .unwrap()
        .iter()
        .map(|p| vec3(number(p, 0), number(p, 1), number(p, 2)))
        .collect()
}

/// Centre and radius, if many points lie evenly on a circle, which may be closed.
fn circle(points: &[Vec3]) -> Option<(Vec3, f64)> {
    let points =
        if points.len() > 1 && points.first() == points.last() { &points[1..] } else { points };
    let centre = points.iter().fold(vec3(0.0, 0.0, 0.0), |sum, p| sum + *p) / points.len() as f64;
    let radii: Vec<f64> = points.iter().map(|p| (*p - centre).norm()).collect();
    let (low, high) =
        radii.iter().fold((f64::MAX, f64::MIN), |(low, high), r| (low.min(*r), high.max(*r)));
    (points.len() > 20 && high - low < 1e-5 * high).then_some((centre, 0.5 * (low + high)))
}

fn most(points: &[Vec3], along: Vec3) -> f64 {
    points.iter().map(|p| along.dot(*p)).fold(f64::MIN, f64::max)
}

#[test]
fn a_link_with_a_free_end_is_drawn_to_its_end() -> Result<()> {
    let mut m = Mechanism::new("pendulum");
    let arm = m.link("arm", 2.0)?;
    m.add("O", revolute(m.ground(), arm, vec2(0.0, 0.0), arm.start()))?;
    m.add("motor", drive_angle(arm, Law::ramp(1.0)))?;
    let system = m.build()?;
    let drawn = Drawn::new(&Scene::new(&system), &system.run(linspace(0.0, 1.0, 11))?)?;
    let [(_, bar)] = &drawn.shapes("arm")[..] else { panic!("one bar") };
    for side in [1.0, -1.0] {
        let reach = most(bar, vec3(side, 0.0, 0.0));
        assert!(
            (1.0..1.1).contains(&reach),
            "the link ends at 1 m from its middle, and is drawn to {reach}"
        );
    }
    Ok(())
}

#[test]
fn a_spatial_link_with_a_free_end_is_drawn_to_its_end() -> Result<()> {
    let mut m = Mechanism::new("boom");
    let boom = m.spatial_link_between("boom", vec3(0.0, 0.0, 1.0), vec3(3.0, 0.0, 1.0))?;
    let z = vec3(0.0, 0.0, 1.0);
    let ground = m.ground();
    m.add("mast", spatial::revolute(boom, ground, boom.start(), vec3(0.0, 0.0, 1.0), z, z))?;
    m.add("motor", joints::drivers::spatial::drive_turn(boom, ground, z, z, Law::ramp(1.0)))?;
    let system = m.build()?;
    let drawn = Drawn::new(&Scene::new(&system), &system.run(linspace(0.0, 1.0, 11))?)?;
    let [(_, bar)] = &drawn.shapes("boom")[..] else { panic!("one bar") };
    assert!(
        (most(bar, vec3(1.0, 0.0, 0.0)) - 1.5).abs() < 1e-6
            && (most(bar, vec3(-1.0, 0.0, 0.0)) - 1.5).abs() < 1e-6
    );
    Ok(())
}

fn four_bar() -> Result<System> {
    let mut m = Mechanism::new("four-bar");
    let ground = m.ground();
    let [crank, coupler, rocker] =
        [m.link("crank", 1.0)?, m.link("coupler", 3.5)?, m.link("rocker", 3.0)?];
    m.add("O", revolute(ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
    m.add("C", revolute(ground, rocker, vec2(4.0, 0.0), rocker.start()))?;
    m.add("motor", drive_angle(crank, Law::ramp(TAU)))?;
    m.prefer(rocker, deg(100.0));
    m.build()
}

#[test]
fn hiding_a_joint_leaves_its_bodies_as_they_are() -> Result<()> {
    let system = four_bar()?;
    let motion = system.run(linspace(0.0, 1.0, 21))?;
    let whole = Drawn::new(&Scene::new(&system), &motion)?;
    let hidden = Drawn::new(&Scene::new(&system).hide_joint("A").hide_joint("B"), &motion)?;
    for name in ["crank", "coupler", "rocker"] {
        assert_eq!(whole.shapes(name), hidden.shapes(name), "{name}");
    }
    // The same of a body whose form is known from its joints alone.
    let mut m = Mechanism::new("plate");
    let plate = m.planar("plate", pose(0.0, 0.0, 0.0))?;
    let rod = m.link("rod", 1.0)?;
    m.add("O", revolute(m.ground(), plate, vec2(0.0, 0.0), vec2(0.0, 0.0)))?;
    m.add("A", revolute(plate, rod, vec2(2.0, 0.0), rod.start()))?;
    m.add("motor", drive_angle(plate, Law::ramp(1.0)))?;
    m.add("second motor", drive_angle(rod, Law::ramp(2.0)))?;
    let system = m.build()?;
    let motion = system.run(linspace(0.0, 1.0, 21))?;
    let whole = Drawn::new(&Scene::new(&system), &motion)?;
    let hidden = Drawn::new(&Scene::new(&system).hide_joint("A"), &motion)?;
    assert_eq!(whole.shapes("plate"), hidden.shapes("plate"));
    assert_eq!(hidden.data["marks"].as_array().unwrap().len(), 1, "its pin is gone");
    Ok(())
}

#[test]
fn a_pose_of_one_time_shows_its_bodies() -> Result<()> {
    let system = four_bar()?;
    let motion = system.run(linspace(0.0, 1.0, 21))?;
    let drawn = Drawn::new(&Scene::new(&system), &system.at(&motion, 0.33)?)?;
    for name in ["crank", "coupler", "rocker"] {
        assert_eq!(drawn.shapes(name).len(), 1, "{name}");
    }
    let supports = drawn.data["marks"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|mark| mark["grounded"] == true)
        .count();
    assert_eq!(supports, 2, "pins on the ground alone are supports");
    Ok(())
}

#[test]
fn a_link_that_is_held_still_is_drawn() -> Result<()> {
    let mut m = Mechanism::new("held");
    let arm = m.link("arm", 2.0)?;
    let hand = m.link("hand", 1.0)?;
    m.add("O", revolute(m.ground(), arm, vec2(0.0, 0.0), arm.start()))?;
    m.add("A", revolute(arm, hand, arm.end(), hand.start()))?;
    m.add("hold", drive_angle(arm, Law::constant(0.3)))?;
    m.add("motor", drive_angle(hand, Law::ramp(1.0)))?;
    let system = m.build()?;
    let drawn = Drawn::new(&Scene::new(&system), &system.run(linspace(0.0, 1.0, 11))?)?;
    assert_eq!(drawn.shapes("arm").len(), 1);
    Ok(())
}

/// Rise and fall of a cam, over a base circle, from a table.
fn profile() -> Law {
    let table: Vec<(f64, f64)> = (0..=12)
        .map(|k| {
            (TAU * f64::from(k) / 12.0, 0.05 + 0.008 * (1.0 - (TAU * f64::from(k) / 12.0).cos()))
        })
        .collect();
    Law::spline(&table, Ends::Periodic)
}

/// A cam whose follower slides along y, or along a line beside the axle; it is turned from 0 by
/// `turn`.
fn roller_cam(radius: f64, beside: f64, turn: f64) -> Result<(System, Motion, PlanarBody)> {
    let mut m = Mechanism::new("cam with a roller");
    let ground = m.ground();
    let cam = m.planar("cam", pose(0.0, 0.0, 0.0))?;
    let follower = m.planar("follower", pose(beside, 0.08, 0.0))?;
    let phi = m.angle("phi", PI / 2.0)?;
    m.add("axle", revolute(ground, cam, vec2(0.0, 0.0), vec2(0.0, 0.0)))?;
    m.add(
        "guide",
        prismatic(follower, ground, vec2(0.0, 0.1), vec2(beside, 0.2), vec2(1.0, 0.0), 0.0),
    )?;
    m.add("contact", cam_roller(cam, follower, phi, vec2(0.0, 0.01), radius, profile()))?;
    m.add("motor", drive_angle(cam, Law::ramp(turn)))?;
    let system = m.build()?;
    let motion = system.run(linspace(0.0, 1.0, 91))?;
    Ok((system, motion, follower))
}

#[test]
fn a_cam_with_a_roller_is_drawn_by_its_edge_and_the_roller_touches_it() -> Result<()> {
    for (radius, beside, turn) in [(0.012, 0.0, TAU), (0.02, 0.005, 1.0)] {
        let (system, motion, follower) = roller_cam(radius, beside, turn)?;
        let drawn = Drawn::new(&Scene::new(&system), &motion)?;
        let roller = drawn
            .discs("follower")
            .into_iter()
            .find(|(centre, _)| (*centre - vec3(0.0, 0.01, 0.0)).norm() < 1e-6);
        assert!(
            roller.is_some_and(|(_, r)| (r - radius).abs() < 1e-6),
            "the roller has its radius: {roller:?}"
        );
        let shapes = drawn.shapes("cam");
        let (_, edge) = shapes.iter().max_by_key(|(_, points)| points.len()).unwrap();
        for p in edge {
            let rho = profile().at(p.y.atan2(p.x));
            assert!((p.norm() - rho).abs() < 1e-5, "({}, {}) is not on the edge", p.x, p.y);
        }
        // The edge is the inner parallel of the path of the roller's centre: nowhere nearer to it
        // than the radius, and somewhere as near.
        let centre = motion.point(follower, vec2(0.0, 0.01))?;
        let angle = motion.coordinate(system_cam(&system).theta())?;
        for (r, theta) in centre.r().iter().zip(angle.value.values()).step_by(9) {
            let (sin, cos) = theta.sin_cos();
            let seen = vec3(cos * r.x + sin * r.y, cos * r.y - sin * r.x, 0.0);
            let gap = distance_to(edge, seen);
            assert!(
                (gap - radius).abs() < 2e-5,
                "the roller is {gap} from the edge that is drawn, its radius is {radius}"
            );
        }
    }
    Ok(())
}

fn system_cam(system: &System) -> PlanarBody {
    match system.bodies()[0].1 {
        Target::Planar(body) => body,
        _ => panic!("the cam is planar"),
    }
}

/// How far a point is from a closed polygon.
fn distance_to(polygon: &[Vec3], p: Vec3) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    let side = |(a, b): (&Vec3, &Vec3)| {
        let along = *b - *a;
        let share = ((p - *a).dot(along) / along.dot(along)).clamp(0.0, 1.0);
        (p - *a - along * share).norm()
    };
    polygon.iter().zip(next).map(side).fold(f64::MAX, f64::min)
}

#[test]
fn a_flat_face_touches_the_edge_of_its_cam_and_is_as_long_as_the_contact_wanders() -> Result<()> {
    let mut m = Mechanism::new("cam with a flat face");
    let ground = m.ground();
    let cam = m.planar("cam", pose(0.0, 0.0, 0.0))?;
    let follower = m.planar("follower", pose(0.0, 0.06, 0.0))?;
    m.add("axle", revolute(ground, cam, vec2(0.0, 0.0), vec2(0.0, 0.0)))?;
    m.add(
        "guide",
        prismatic(follower, ground, vec2(0.0, 0.1), vec2(0.0, 0.2), vec2(1.0, 0.0), 0.0),
    )?;
    m.add("contact", cam_flat_face(cam, follower, vec2(0.0, 0.0), vec2(0.0, 2.0), profile()))?;
    m.add("motor", drive_angle(cam, Law::ramp(1.0)))?;
    let system = m.build()?;
    let motion = system.run(linspace(0.0, 1.0, 31))?;
    let drawn = Drawn::new(&Scene::new(&system), &motion)?;
    let shapes = drawn.shapes("cam");
    let (_, edge) = shapes.iter().max_by_key(|(_, points)| points.len()).unwrap();
    let shapes = drawn.shapes("follower");
    let (_, face) =
        shapes.iter().find(|(style, points)| style == "bar" && points.len() == 2).expect("a face");
    assert!(face.iter().all(|p| p.y.abs() < 1e-6), "the face goes through its point");
    for k in 0..motion.len() {
        let (sin, cos) = motion.q(k)[2].sin_cos();
        let turned: Vec<Vec3> =
            edge.iter().map(|p| vec3(cos * p.x - sin * p.y, sin * p.x + cos * p.y, 0.0)).collect();
        let top = turned.iter().copied().max_by(|a, b| a.y.total_cmp(&b.y)).unwrap();
        let lift = motion.q(k)[4];
        assert!(
            (top.y - lift).abs() < 2e-6,
            "the cam reaches {}, the face stands at {lift}",
            top.y
        );
        assert!(
            face[0].x.min(face[1].x) < top.x && top.x < face[0].x.max(face[1].x),
            "the contact at {} leaves the face",
            top.x
        );
    }
    Ok(())
}

#[test]
fn an_added_outline_leaves_what_is_drawn() -> Result<()> {
    let system = four_bar()?;
    let motion = system.run(linspace(0.0, 1.0, 21))?;
    let Target::Planar(coupler) = system.bodies()[1].1 else { panic!("a planar body") };
    let triangle = kin_view::Outline::polygon([vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(0.0, 1.0)]);
    let plain = Drawn::new(&Scene::new(&system), &motion)?.shapes("coupler");
    let added = Drawn::new(&Scene::new(&system).add_outline(coupler, triangle.clone()), &motion)?
        .shapes("coupler");
    assert_eq!((plain.len(), added.len()), (1, 2));
    assert_eq!(added[0], plain[0], "the bar stays");
    assert_eq!(added[1].1.len(), 3);
    let told = Drawn::new(&Scene::new(&system).outline(coupler, triangle.clone()), &motion)?
        .shapes("coupler");
    assert_eq!(told, added[1..], "`outline` takes its place");
    let ground = Drawn::new(&Scene::new(&system).add_outline(Ground, triangle), &motion)?;
    assert_eq!(ground.shapes("ground").len(), 1, "of the ground, too");
    Ok(())
}

#[test]
fn a_rod_whose_length_is_driven_is_a_cylinder_with_a_barrel_that_keeps_its_length() -> Result<()> {
    let mut m = Mechanism::new("cylinder");
    let ground = m.ground();
    let arm = m.link("arm", 2.0)?;
    m.add("O", revolute(ground, arm, vec2(0.0, 0.0), arm.start()))?;
    m.add(
        "cylinder",
        joints::drivers::drive_distance(
            arm,
            ground,
            arm.end(),
            vec2(1.0, -1.0),
            Law::linear(2.0, 0.5),
        ),
    )?;
    m.prefer(arm, deg(30.0));
    let system = m.build()?;
    let drawn = Drawn::new(&Scene::new(&system), &system.run(linspace(0.0, 1.0, 21))?)?;
    let lines = drawn.data["lines"].as_array().unwrap();
    assert_eq!(
        lines.iter().map(|line| line["style"].as_str().unwrap()).collect::<Vec<_>>(),
        ["rod", "barrel"]
    );
    assert!(lines.iter().all(|line| line["name"] == "cylinder"));
    // The barrel is fixed at the ground; its mouth is a track of its own, whose first position is
    // on the way to the arm's end.
    assert_eq!(
        (&lines[1]["points"][0][0], &lines[1]["points"][0][1]),
        (&lines[0]["points"][0][0], &lines[0]["points"][0][1])
    );
    assert_eq!(lines[1]["points"][0][0], 0);
    Ok(())
}
