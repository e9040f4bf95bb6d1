//! Pictures and pages as anyone gets them: well-formed, finite, safe and small.

mod bars;
mod forces;
mod numbers;
mod still;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use kin::joints::drivers::{drive, drive_angle, drive_distance};
use kin::joints::planar::{prismatic, revolute};
use kin::joints::spatial::spherical;
use kin::*;
use kin_view::{Figure, Map, Outline, Panel, Scene};
use serde_json::Value;
use sha2::{Digest, Sha256};

/// Pin in a parabolic slot.      [m]
#[constraint]
fn parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {
    let s = j.local(i.point(u_i));
    s.y - k * s.x * s.x
}

/// A four-bar with all lengths times `scale`, and its coupler.
fn four_bar(name: &str, scale: f64) -> Result<(System, Link)> {
    let mut m = Mechanism::new(name);
    let ground = m.ground();
    let [crank, coupler, rocker] =
        [m.link("crank", scale)?, m.link("coupler", 3.5 * scale)?, m.link("rocker", 3.0 * scale)?];
    m.add("O", revolute(ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
    m.add("C", revolute(ground, rocker, vec2(4.0 * scale, 0.0), rocker.start()))?;
    m.add("motor", drive_angle(crank, Law::ramp(std::f64::consts::TAU)))?;
    m.prefer(rocker, deg(100.0));
    Ok((m.build()?, coupler))
}

/// A plate on three legs, and a ball that hangs from it.
fn tripod() -> Result<System> {
    let mut m = Mechanism::new("tripod");
    let ground = m.ground();
    let plate = m.spatial("plate", SpatialPose::at(vec3(0.0, 0.0, 1.0)))?;
    let drive = kin::joints::drivers::spatial::drive_distance;
    for k in 0..6 {
        let a = deg(60.0 * f64::from(k));
        let b = deg(60.0 * f64::from(k) + if k % 2 == 0 { 40.0 } else { -40.0 });
        let foot = vec3(a.cos(), a.sin(), 0.0);
        let head = vec3(0.5 * b.cos(), 0.5 * b.sin(), 0.0);
        let length = (head + vec3(0.0, 0.0, 1.0) - foot).norm();
        m.add(
            &format!("leg {k}"),
            drive(
                plate,
                ground,
                head,
                foot,
                Law::constant(length) + Law::sine(0.05, 2.0, f64::from(k)),
            ),
        )?;
    }
    let ball = m.spatial("ball", SpatialPose::at(vec3(0.0, 0.0, 0.5)))?;
    m.add("hook", spherical(plate, ball, vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 0.5)))?;
    m.add(
        "upright",
        kin::joints::drivers::spatial::drive_rotation(
            ball,
            ground,
            vec3(0.0, 0.0, 1.0),
            Law::ramp(1.0),
        ),
    )?;
    m.build()
}

/// The SVG as a tree; fails on what is no XML, and on numbers that are none.
fn parsed(svg: &str) -> roxmltree::Document<'_> {
    let document = roxmltree::Document::parse(svg).unwrap_or_else(|error| panic!("{error}\n{svg}"));
    for node in document.descendants() {
        for attribute in node.attributes() {
            assert!(
                !attribute.value().contains("NaN") && !attribute.value().contains("inf"),
                "{attribute:?}"
            );
        }
    }
    document
}

fn attributes<'a>(document: &'a roxmltree::Document<'_>, tag: &str, name: &str) -> Vec<&'a str> {
    document
        .descendants()
        .filter(|node| node.has_tag_name(("http://www.w3.org/2000/svg", tag)))
        .filter_map(|node| node.attribute(name))
        .collect()
}

/// The data of a page.
fn data(html: &str) -> Value {
    let (_, rest) = html.split_once("<script id=\"data\" type=\"application/json\">").unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

fn names<'a>(data: &'a Value, list: &str) -> Vec<&'a str> {
    data[list].as_array().unwrap().iter().map(|item| item["name"].as_str().unwrap()).collect()
}

#[test]
fn every_kind_of_picture_is_xml_with_numbers_only() -> Result<()> {
    let (planar, coupler) = four_bar("four-bar", 1.0)?;
    let spatial = tripod()?;
    for (system, scene) in [
        (&planar, Scene::new(&planar).trace("P", coupler, vec2(0.2, 1.4))),
        (&spatial, Scene::new(&spatial)),
    ] {
        for count in [1, 2, 50] {
            let motion = system.run(linspace(0.0, 1.0, count))?;
            for picture in [
                scene.pose(&motion, 0.3)?,
                scene.sequence(&motion, 5)?,
                scene.animated(&motion, 3.0)?,
                scene.animated(&motion, f64::NAN)?,
            ] {
                parsed(picture.svg());
            }
            let page = scene.page(&motion)?.html();
            assert!(data(&page)["frames"] == count);
        }
    }
    Ok(())
}

#[test]
fn pins_supports_rods_and_slots_come_from_the_constraints() -> Result<()> {
    let (system, coupler) = four_bar("four-bar", 1.0)?;
    let motion = system.run(linspace(0.0, 1.0, 101))?;
    let page = data(&Scene::new(&system).trace("P", coupler, vec2(0.2, 1.4)).page(&motion)?.html());
    assert_eq!(names(&page, "marks"), ["O", "A", "B", "C"]);
    let grounded: Vec<bool> =
        page["marks"].as_array().unwrap().iter().map(|mark| mark["grounded"] == true).collect();
    assert_eq!(grounded, [true, false, false, true]);
    assert_eq!(names(&page, "shapes"), ["crank", "coupler", "rocker"]);

    let mut m = Mechanism::new("slot and rod");
    let ground = m.ground();
    let slider = m.planar("slider", pose(0.2, 0.1, 0.0))?;
    m.add("slot", parabolic_slot(slider, ground, vec2(0.0, 0.0), 2.0))?;
    m.add("upright", drive_angle(slider, Law::constant(0.0)))?;
    m.add("motor", drive(slider.x(), Law::sine(0.3, 1.0, 0.0)))?;
    let arm = m.link("arm", 0.3)?;
    m.add("pin", revolute(slider, arm, vec2(0.0, 0.0), arm.start()))?;
    m.add("rod", drive_distance(arm, ground, arm.end(), vec2(0.3, 0.5), Law::constant(0.4)))?;
    let block = m.planar("block", pose(0.0, -0.5, 0.0))?;
    m.add("guide", prismatic(block, ground, vec2(0.0, 0.0), vec2(0.0, -0.5), vec2(0.0, 1.0), 0.0))?;
    m.add("second motor", drive(block.x(), Law::sine(0.2, 1.0, 0.0)))?;
    let system = m.build()?;
    let page = data(&Scene::new(&system).page(&system.run(linspace(0.0, 6.3, 200))?)?.html());
    assert_eq!(names(&page, "lines"), ["rod"]);
    let guide =
        page["shapes"].as_array().unwrap().iter().find(|shape| shape["name"] == "slot").unwrap();
    assert_eq!(guide["style"], "guide");
    for point in guide["points"].as_array().unwrap() {
        let x = point[0].as_f64().unwrap();
        let y = point[1].as_f64().unwrap();
        assert!(
            (y - 2.0 * x * x).abs() < 1e-6,
            "({x}, {y}) is not on the parabola that nobody told"
        );
    }
    let blocks =
        page["shapes"].as_array().unwrap().iter().filter(|shape| shape["name"] == "block").count();
    assert_eq!(blocks, 2, "a disc, and the block that slides");
    Ok(())
}

#[test]
fn what_is_told_takes_the_place_of_the_default() -> Result<()> {
    let (system, coupler) = four_bar("four-bar", 1.0)?;
    let motion = system.run(linspace(0.0, 1.0, 21))?;
    let scene = Scene::new(&system)
        .outline(coupler, Outline::polygon([vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(0.0, 1.0)]));
    let page = data(&scene.clone().color(coupler, "#123456").page(&motion)?.html());
    let shape = &page["shapes"][1];
    assert_eq!(
        (shape["color"].as_str(), shape["points"].as_array().unwrap().len()),
        (Some("#123456"), 3)
    );
    assert_eq!(
        names(&data(&scene.clone().hide(coupler).page(&motion)?.html()), "shapes"),
        ["crank", "rocker"]
    );
    assert_eq!(
        names(&data(&scene.clone().hide_joint("A").page(&motion)?.html()), "marks"),
        ["O", "B", "C"]
    );
    // A colour that is none changes nothing.
    let spoiled = scene.color(coupler, "red\" onload=\"alert(1)").pose(&motion, 0.0)?;
    assert!(!spoiled.svg().contains("onload"));
    Ok(())
}

#[test]
fn names_cannot_become_markup() -> Result<()> {
    const EVIL: &str = "</script><img src=x onerror=alert(1)>]]>&\"'<!--\u{1}";
    let (system, coupler) = four_bar(EVIL, 1.0)?;
    let mut motion = system.run(linspace(0.0, 1.0, 21))?;
    motion.add_output(EVIL, EVIL, vec![0.0; 21])?;
    let scene = Scene::new(&system)
        .trace(EVIL, coupler, vec2(0.2, 1.4))
        .line(EVIL, &[&[vec2(0.0, 0.0)], &[vec2(1.0, 1.0)]]);
    for picture in [scene.pose(&motion, 0.0)?, scene.animated(&motion, 2.0)?] {
        let svg = picture.svg().to_string();
        assert!(
            parsed(&svg)
                .descendants()
                .all(|node| !node.has_tag_name(("http://www.w3.org/2000/svg", "img")))
        );
    }
    let html = scene.page(&motion)?.title(EVIL).chart(EVIL, [(EVIL, &motion.outputs()[0])]).html();
    assert!(!html.contains("<img"), "a name became an element");
    assert_eq!(html.matches("</script>").count(), 2, "a name ended a script");
    assert_eq!(data(&html)["traces"][0]["name"], EVIL, "the name itself is kept");
    parsed(
        &Figure::new([Panel::over_time(EVIL, EVIL).series(EVIL, &motion.outputs()[0])])
            .svg()
            .replace('\u{1}', ""),
    );
    Ok(())
}

#[test]
fn the_policy_allows_the_script_of_the_page_and_nothing_else() -> Result<()> {
    let (system, _) = four_bar("four-bar", 1.0)?;
    let html = Scene::new(&system).page(&system.run(linspace(0.0, 1.0, 5))?)?.html();
    let between = |from: &str, to: &str| {
        html.split_once(from).unwrap().1.split_once(to).unwrap().0.to_string()
    };
    let policy = between("http-equiv=\"Content-Security-Policy\" content=\"", "\"");
    let hash = |text: String| format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text)));
    assert!(policy.starts_with("default-src 'none';"));
    assert!(
        policy.contains(&format!(
            "script-src {};",
            hash(between("</script>\n<script>", "</script>"))
        )),
        "{policy}"
    );
    assert!(
        policy.contains(&format!("style-src {};", hash(between("<style>", "</style>")))),
        "{policy}"
    );
    assert!(
        !html.contains("http://www.w3.org/1999")
            && !html.contains("https://")
            && !html.contains("src=\""),
        "something is loaded"
    );
    Ok(())
}

#[test]
fn ten_thousand_frames_are_a_small_file() -> Result<()> {
    let (system, coupler) = four_bar("four-bar", 1.0)?;
    let motion = system.run(linspace(0.0, 10.0, 10_000))?;
    let rocker = motion.named("rocker.theta")?;
    let html = Scene::new(&system)
        .trace("P", coupler, vec2(0.2, 1.4))
        .page(&motion)?
        .coordinate("Rocker", &rocker)
        .html();
    assert!(
        html.len() < 300_000,
        "{} bytes for 10⁴ frames, 9 coordinates and 3 charts",
        html.len()
    );
    let turn = system.run(linspace(0.0, 1.0, 10_000))?;
    let svg =
        Scene::new(&system).trace("P", coupler, vec2(0.2, 1.4)).animated(&turn, 4.0)?.svg().len();
    assert!(svg < 10_000, "{svg} bytes of animated SVG");
    Ok(())
}

#[test]
fn a_page_of_a_run_that_ended_early_spans_the_times_reached_and_says_why() -> Result<()> {
    let mut m = Mechanism::new("toggle");
    let ground = m.ground();
    let a = m.link("a", 1.0)?;
    let b = m.link("b", 1.0)?;
    m.add("O", revolute(ground, a, vec2(0.0, 0.0), a.start()))?;
    m.add("A", revolute(a, b, a.end(), b.start()))?;
    let slider = m.planar("slider", pose(1.0, 0.0, 0.0))?;
    m.add("B", revolute(b, slider, b.end(), vec2(0.0, 0.0)))?;
    m.add("guide", prismatic(slider, ground, vec2(0.0, 0.0), vec2(0.0, 0.0), vec2(0.0, 1.0), 0.0))?;
    m.add("motor", drive(slider.x(), Law::linear(1.0, 1.0)))?; // reaches 2, the full length, at t = 1
    m.prefer(a, deg(60.0));
    let system = m.build()?;
    let asked = linspace(0.0, 2.0, 201);
    let error = system.run(&asked).unwrap_err();
    let part = error.motion().expect("the motion up to the toggle");
    assert!((80..=101).contains(&part.len()), "{}", part.len());
    let x = part.coordinate(slider.x())?;
    let scene = Scene::new(&system);
    let why = format!("{error} <img src=x>");
    let html = scene.page(part)?.asked(&asked).ended(&why).chart("x", [("x", &x.value)]).html();
    let page = data(&html);
    assert_eq!(page["frames"], part.len());
    for column in [&page["charts"][0]["series"][0]["values"], &page["tracks"][1]["columns"][0]] {
        let gaps = STANDARD.decode(column["d"].as_str().unwrap()).unwrap();
        assert!(!gaps.contains(&0), "there is a gap");
    }
    let note = html.split_once("<aside id=\"ended\" role=\"note\">").expect("a note").1;
    let note = note.split_once("</aside>").expect("its end").0;
    assert!(note.contains("up to t = 0.99 s, of 2 s"), "{note}");
    let sentence = error.to_string().lines().next().unwrap_or_default().replace('\'', "&#39;");
    assert!(note.contains(&sentence) && !note.contains("<img"), "{note}");
    let whole = scene.page(part)?.asked(part.times()).ended(&why).html();
    assert!(!whole.contains("id=\"ended\"") && !scene.page(part)?.html().contains("id=\"ended\""));
    Ok(())
}

#[test]
fn gaps_break_the_line_of_a_chart() -> Result<()> {
    let (system, _) = four_bar("four-bar", 1.0)?;
    let motion = system.run(linspace(0.0, 1.0, 21))?;
    let points: Vec<Vec2> = (0..40)
        .map(|k| vec2(f64::from(k), if k == 20 { f64::NAN } else { f64::from(k * k) }))
        .collect();
    let svg = Figure::new([Panel::numbers("gap", "x", "y").path("parabola", &points)]).svg();
    let whole =
        Figure::new([Panel::numbers("gap", "x", "y").path("parabola", &points[..20])]).svg();
    let curves = |svg: &str| {
        parsed(svg).descendants().filter(|node| node.attribute("stroke") == Some("#0072B2")).count()
    };
    assert_eq!(curves(&svg), curves(&whole) + 1);
    let condition = system.condition(&motion)?;
    parsed(&Figure::new([Panel::log_over_time("condition", "κ").series("κ", &condition)]).svg());
    Ok(())
}

#[test]
fn a_picture_is_the_same_in_millimetres_and_kilometres() -> Result<()> {
    let picture = |scale: f64| -> Result<Vec<f64>> {
        let (system, coupler) = four_bar("four-bar", scale)?;
        let motion = system.run(linspace(0.0, 1.0, 41))?;
        let svg = Scene::new(&system)
            .trace("P", coupler, vec2(0.2 * scale, 1.4 * scale))
            .pose(&motion, 0.25)?
            .svg()
            .to_string();
        let document = parsed(&svg);
        let points = attributes(&document, "polygon", "points").join(" ");
        Ok(points.split([' ', ',']).filter_map(|x| x.parse().ok()).collect())
    };
    let metres = picture(1.0)?;
    let small = picture(1e-3)?;
    let large = picture(1e3)?;
    assert!(metres.len() > 50 && metres.len() == small.len() && metres.len() == large.len());
    for ((a, b), c) in metres.iter().zip(&small).zip(&large) {
        assert!((a - b).abs() < 0.02 && (a - c).abs() < 0.02, "{a} {b} {c}");
    }
    Ok(())
}

#[test]
fn a_map_leaves_blank_what_is_not_known() {
    let values = (0..60).map(|k| if k == 17 { f64::NAN } else { f64::from(k % 10) });
    let map = Map::new("<map>", "swing [°]")
        .along_x("b [m]", 1.0, 2.0, 10)
        .along_y("c [m]", 1.0, 1.5, 6)
        .values(values);
    let svg = map.svg();
    let cells: usize = attributes(&parsed(&svg), "path", "d")
        .iter()
        .flat_map(|d| d.split('h').skip(1).step_by(2))
        .filter_map(|run| run.split('v').next()?.parse::<usize>().ok())
        .sum();
    assert_eq!(cells, 59, "each known cell once");
    parsed(&Map::new("empty", "").svg());
    parsed(
        &Map::new("one value", "")
            .along_x("", 0.0, 1.0, 2)
            .along_y("", 0.0, 1.0, 1)
            .values([3.0, f64::INFINITY])
            .svg(),
    );
}

#[test]
fn a_motion_of_another_mechanism_is_an_error() -> Result<()> {
    let (system, _) = four_bar("one", 1.0)?;
    let (other, _) = four_bar("other", 1.0)?;
    let motion = other.run(linspace(0.0, 1.0, 5))?;
    assert!(matches!(Scene::new(&system).pose(&motion, 0.0), Err(Error::ForeignBody { .. })));
    assert!(matches!(Scene::new(&system).page(&motion).err(), Some(Error::ForeignBody { .. })));
    Ok(())
}

#[cfg(feature = "png")]
#[test]
fn a_picture_called_png_is_one() -> Result<()> {
    let (system, coupler) = four_bar("four-bar", 1.0)?;
    let motion = system.run(linspace(0.0, 1.0, 41))?;
    let folder = std::env::temp_dir().join(format!("kin-png-{}", std::process::id()));
    let scene = Scene::new(&system).trace("P", coupler, vec2(0.2, 1.4));
    scene.pose(&motion, 0.2)?.save(folder.join("pose.png"))?;
    Figure::of_coordinate("rocker", &motion.named("rocker.theta")?)
        .save(folder.join("rocker.PNG"))?;
    for name in ["pose.png", "rocker.PNG"] {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        assert!(
            bytes.starts_with(b"\x89PNG\r\n") && bytes.len() > 5_000,
            "{name}: {} bytes",
            bytes.len()
        );
    }
    std::fs::remove_dir_all(&folder).unwrap();
    Ok(())
}

#[cfg(not(feature = "png"))]
#[test]
fn without_the_feature_a_png_is_refused_with_its_cure() -> Result<()> {
    let (system, _) = four_bar("four-bar", 1.0)?;
    let error = Scene::new(&system)
        .pose(&system.run([0.0])?, 0.0)?
        .save("pose.png")
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("pose.png") && error.contains("the feature `png` of kin-view"),
        "{error}"
    );
    Ok(())
}
