//! Forces in pictures: arrows against the numbers that they stand for.

use kin::forces::LoadSharing;
use kin::joints::drivers::drive_angle;
use kin::joints::planar::revolute;
use kin::joints::spatial;
use kin::*;
use kin_view::{Figure, Scene};

use crate::{attributes, data, names, parsed};

/// An arm that hangs on a pin and carries a weight at its end.
fn arm(weight: f64) -> Result<(System, Link)> {
    let mut m = Mechanism::new("arm");
    let arm = m.link("arm", 0.5)?;
    m.add("O", revolute(arm, m.ground(), arm.start(), vec2(0.0, 0.0)))?;
    m.add("motor", drive_angle(arm, Law::linear(0.4, 1.3)))?;
    m.load("weight", Load::force(arm, arm.end(), vec2(0.0, -weight)))?;
    Ok((m.build()?, arm))
}

/// Points of the path of that title: foot, neck and tip.
fn points(svg: &str, title: &str) -> Vec<[f64; 2]> {
    let document = parsed(svg);
    let path = document.descendants().find(|node| {
        node.has_tag_name(("http://www.w3.org/2000/svg", "path"))
            && node.first_element_child().and_then(|child| child.text()) == Some(title)
    });
    let d = path.unwrap_or_else(|| panic!("no `{title}`")).attribute("d").unwrap();
    let place = |text: &str| -> [f64; 2] {
        let numbers: Vec<f64> =
            text.split_whitespace().map(|number| number.parse().unwrap()).collect();
        [numbers[0], numbers[1]]
    };
    d.split(['M', 'L', 'Z'])
        .filter(|part| !part.is_empty() && !part.contains('A'))
        .map(place)
        .collect()
}

/// Newtons for one pixel, by the scale in the picture.
fn newtons_a_pixel(svg: &str) -> f64 {
    let document = parsed(svg);
    let texts = document
        .descendants()
        .filter(|node| node.has_tag_name(("http://www.w3.org/2000/svg", "text")));
    let newtons = texts
        .filter_map(|node| node.text()?.strip_suffix(" N")?.parse::<f64>().ok())
        .next()
        .unwrap();
    let bar =
        document.descendants().find(|node| node.attribute("stroke") == Some("#444444")).unwrap();
    let d = bar.attribute("d").unwrap();
    let x = |part: &str| part.split(' ').next().unwrap().parse::<f64>().unwrap();
    let from = x(d.split(['M', 'L']).nth(1).unwrap());
    let tip = x(d.split('M').nth(2).unwrap());
    newtons / (tip - from)
}

/// The load and the pin's answer are of one size, along the vertical, where they act.
#[test]
fn arrows_are_as_long_as_the_scale_says() -> Result<()> {
    for weight in [20.0, 7.3, 4.1e6] {
        let (system, _) = arm(weight)?;
        let motion = system.run(linspace(0.0, 1.0, 11))?;
        let forces = system.forces(&motion)?;
        let picture = Scene::new(&system).forces(&forces).pose(&motion, 0.5)?;
        let scale = newtons_a_pixel(picture.svg());
        for (name, up) in [("weight on arm", -1.0), ("O on arm", 1.0)] {
            let all = points(picture.svg(), name);
            let foot = all[0];
            let tip = all[2];
            // Pictures are upside down.
            let newtons = (foot[1] - tip[1]) * scale;
            assert!((newtons / (up * weight) - 1.0).abs() < 2e-3, "{name}: {newtons} of {weight}");
            assert!((foot[0] - tip[0]).abs() < 0.02, "{name}: {all:?}");
        }
        let [pin, end] = ["O on arm", "weight on arm"].map(|name| points(picture.svg(), name)[0]);
        let angle = (pin[1] - end[1]).atan2(end[0] - pin[0]);
        assert!((angle - (0.4 + 1.3 * 0.5)).abs() < 1e-3, "{angle}");
    }
    Ok(())
}

/// A motor that holds an arm up turns it to the left: an arc against the clock, SVG's sweep 0.
#[test]
fn a_torque_in_the_plane_is_an_arc() -> Result<()> {
    for (weight, sweep) in [(20.0, 0), (-20.0, 1)] {
        let (system, _) = arm(weight)?;
        let motion = system.run([0.0, 0.1])?;
        let forces = system.forces(&motion)?;
        let picture = Scene::new(&system).forces(&forces).pose(&motion, 0.0)?;
        let document = parsed(picture.svg());
        let arcs: Vec<&str> = attributes(&document, "path", "d")
            .into_iter()
            .filter(|d| d.contains('A') && d.contains('Z'))
            .collect();
        let [arc] = arcs[..] else { panic!("{arcs:?}") };
        let way = arc.split('A').nth(1).unwrap().split(' ').nth(4).unwrap();
        assert_eq!(way, sweep.to_string(), "{arc}");
        assert!(picture.svg().contains("half a turn: 10 N m"), "{}", picture.svg());
    }
    Ok(())
}

/// A page has an arrow for each force, with numbers that a reader of the page can trust, and
/// charts.
#[test]
fn a_page_has_forces_by_name_with_their_unit() -> Result<()> {
    let (system, _) = arm(20.0)?;
    let motion = system.run(linspace(0.0, 1.0, 11))?;
    let forces = system.forces(&motion)?;
    let html = Scene::new(&system).forces(&forces).page(&motion)?.forces(&forces).html();
    let page = data(&html);
    assert_eq!(names(&page, "pushes"), ["O on arm", "motor on arm", "weight on arm"]);
    let acting: Vec<&str> = page["pushes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|push| push["acting"].as_str().unwrap())
        .collect();
    assert_eq!(acting, ["joint", "drive", "load"]);
    assert_eq!(
        (page["scales"][0]["unit"].as_str(), page["scales"][1]["unit"].as_str()),
        (Some("N"), Some("N m"))
    );
    // The pin holds 20 N at all times: one number, the same each time.
    assert!((page["pushes"][0]["columns"][1]["o"].as_f64().unwrap() - 20.0).abs() < 1e-6);
    let titles: Vec<&str> = page["charts"]
        .as_array()
        .unwrap()
        .iter()
        .map(|chart| chart["title"].as_str().unwrap())
        .collect();
    assert_eq!(titles, ["efforts of drives", "forces in joints"]);
    assert!(html.contains("id=\"forces\""));
    let without = data(&Scene::new(&system).page(&motion)?.html());
    assert_eq!(without["pushes"].as_array().map(Vec::len), Some(0));
    let chart = Figure::of_forces(&forces).svg();
    parsed(&chart);
    assert!(chart.contains("effort [N m]") && chart.contains("F [N]"), "{chart}");
    Ok(())
}

/// Of two hinges that share a weight nobody knows how, what is unique is shown, and nothing else.
#[test]
fn forces_that_are_not_unique_have_no_arrows() -> Result<()> {
    let mut m = Mechanism::new("door");
    let door = m.spatial("door", SpatialPose::at(vec3(0.5, 0.0, 1.0)))?;
    let ground = m.ground();
    let z = vec3(0.0, 0.0, 1.0);
    for (name, height) in [("hinge 1", 0.3), ("hinge 2", 1.7)] {
        let u = vec3(-0.5, 0.0, height - 1.0);
        let p = vec3(0.0, 0.0, height);
        m.add(name, spatial::revolute(door, ground, u, p, z, z))?;
    }
    m.add("hand", spatial::drive_turn(door, ground, z, z, Law::polynomial(&[0.0, 0.0, 0.5])))?;
    m.mass(door, 20.0, vec3(0.0, 0.0, 0.0), [[8.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, 2.0]])?;
    m.gravity(vec3(0.0, 0.0, -9.81));
    let system = m.build()?;
    let motion = system.run([0.0, 0.5])?;
    for (sharing, shown) in [
        (LoadSharing::NotGiven, vec!["hand on door"]),
        (LoadSharing::LeastNorm, vec!["hinge 1 on door", "hinge 2 on door", "hand on door"]),
    ] {
        let forces = system
            .solver()
            .options(SolverOptions::new().sharing(sharing.clone()))
            .forces(&motion)?;
        let scene = Scene::new(&system).forces(&forces);
        parsed(scene.pose(&motion, 0.5)?.svg());
        let page = data(&scene.page(&motion)?.html());
        let mut all = names(&page, "pushes");
        all.dedup();
        assert_eq!(all, shown, "{sharing:?}");
    }
    Ok(())
}

/// Towards a dead centre forces have no bound: the peak is cut, and the others can still be seen.
#[test]
fn a_peak_does_not_hide_everything_else() -> Result<()> {
    let (system, _) = arm(20.0)?;
    let mut m = Mechanism::new("jolt");
    let link = m.link("arm", 0.5)?;
    m.add("O", revolute(link, m.ground(), link.start(), vec2(0.0, 0.0)))?;
    m.add("motor", drive_angle(link, Law::linear(0.4, 1.3)))?;
    let jolt = |_: f64, _: f64, t: f64| if (t - 0.5).abs() < 1e-9 { 5e4 } else { 20.0 };
    m.load("jolt", Load::along(drive_angle(link, Law::constant(0.0)), jolt))?;
    let jolted = m.build()?;
    let pages = [&system, &jolted].map(|system| {
        let motion = system.run(linspace(0.0, 1.0, 101))?;
        let forces = system.forces(&motion)?;
        let scene = Scene::new(system).forces(&forces);
        let cut = scene.pose(&motion, 0.5)?.svg().contains("stroke-dasharray");
        Ok((data(&scene.page(&motion)?.html()), cut))
    });
    let [usual, jolted]: [Result<_>; 2] = pages;
    let (usual, plain) = usual?;
    let (jolted, cut) = jolted?;
    assert!(!plain && cut, "the peak is dashed");
    let turn = |page: &serde_json::Value| page["scales"][1]["turn"].as_f64().unwrap();
    assert!(turn(&jolted) > 0.1 * turn(&usual), "{} {}", turn(&jolted), turn(&usual));
    Ok(())
}
