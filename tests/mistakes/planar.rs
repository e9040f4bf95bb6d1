//! Bodies, points and joints of the plane that are not what was meant.

use super::*;

pub fn all() -> Vec<Mistake> {
    vec![
        Mistake {
            title: "Bodies in the wrong order",
            line: r#"m.add("A", revolute(coupler, crank, crank.end(), coupler.start()))?; // the points are those of crank, coupler"#,
            culprit: "A",
            told: swapped,
        },
        Mistake {
            title: "Two joints at the same end",
            line: r#"m.add("B", revolute(coupler, rocker, coupler.end(), rocker.start()))?; // `C` already holds rocker.start()"#,
            culprit: "B",
            told: same_end,
        },
        Mistake {
            title: "A global point in place of a local point",
            line: r#"m.add("C", revolute(ground, rocker, vec2(4.0, 0.0), vec2(4.0, 0.0)))?; // intended: m.local(rocker, (4.0, 0.0))"#,
            culprit: "rocker",
            told: |wrong| global(wrong, false),
        },
        Mistake {
            title: "Two global points in place of local points",
            line: r#"m.add("A", revolute(crank, plate, crank.end(), vec2(0.0, 1.0)))?; // intended: m.local(plate, (0.0, 1.0))"#,
            culprit: "plate",
            told: |wrong| global(wrong, true),
        },
        Mistake {
            title: "A forgotten pin",
            line: r#"// m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?; is missing"#,
            culprit: "coupler",
            told: pin_forgotten,
        },
        Mistake {
            title: "A body that nothing holds",
            line: r#"let spare = m.link("spare", 1.0)?; // no constraint uses it"#,
            culprit: "spare",
            told: spare,
        },
        Mistake {
            title: "A second guide beside the line of the first",
            line: r#"m.add("guide 2", prismatic(slider, ground, vec2(0.0, 0.0), vec2(1.0, 0.02), vec2(0.0, 1.0), 0.0))?;"#,
            culprit: "guide 2",
            told: guides,
        },
        Mistake {
            title: "Degrees in place of radians",
            line: r#"m.add("motor", drive_angle(crank, Law::linear(98.6, 1.0)))?; // intended: deg(98.6)"#,
            culprit: "crank",
            told: degrees,
        },
        Mistake {
            title: "Two bars in line that cannot move",
            line: r#"m.add("C", revolute(ground, right, vec2(0.5, 0.0), right.end()))?; // the bars are 0.2 and 0.3 long, so nothing moves"#,
            culprit: "left",
            told: in_line,
        },
    ]
}

fn swapped(wrong: bool) -> Told {
    let mut m = Mechanism::new("four-bar");
    let [crank, coupler, rocker] = [("crank", 1.0), ("coupler", 3.5), ("rocker", 3.0)]
        .map(|(name, length)| m.link(name, length).unwrap());
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    let (i, j) = if wrong { (coupler, crank) } else { (crank, coupler) };
    m.add("A", revolute(i, j, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(m.ground(), rocker, vec2(4.0, 0.0), rocker.start())).unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(TAU))).unwrap();
    run(m)
}

fn same_end(wrong: bool) -> Told {
    let mut m = Mechanism::new("four-bar");
    let [crank, coupler, rocker] = [("crank", 1.0), ("coupler", 3.5), ("rocker", 3.0)]
        .map(|(name, length)| m.link(name, length).unwrap());
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add(
        "B",
        revolute(coupler, rocker, coupler.end(), if wrong { rocker.start() } else { rocker.end() }),
    )
    .unwrap();
    m.add("C", revolute(m.ground(), rocker, vec2(4.0, 0.0), rocker.start())).unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(TAU))).unwrap();
    run(m)
}

/// Crank, plate and rocker as they are drawn; the rocker's or the plate's points may be global
/// ones.
fn global(wrong: bool, plate_wrong: bool) -> Told {
    let mut m = Mechanism::new("four-bar");
    let crank = m.link_between("crank", (0.0, 0.0), (0.0, 1.0)).unwrap();
    let plate = m.planar("plate", pose(1.5, 2.0, 0.3)).unwrap();
    let rocker = m.link_between("rocker", (4.0, 0.0), (3.5, 2.9)).unwrap();
    let given =
        |body: PlanarBody, p: Vec2, wrong: bool| if wrong { p } else { m.local(body, p).unwrap() };
    let a = given(plate, vec2(0.0, 1.0), wrong && plate_wrong);
    let b = given(plate, vec2(3.5, 2.9), wrong && plate_wrong);
    let c = given(rocker.body(), vec2(4.0, 0.0), wrong && !plate_wrong);
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, plate, crank.end(), a)).unwrap();
    m.add("B", revolute(plate, rocker, b, rocker.end())).unwrap();
    m.add("C", revolute(m.ground(), rocker, vec2(4.0, 0.0), c)).unwrap();
    m.add("motor", drive_angle(crank, Law::linear(PI / 2.0, 1.0))).unwrap();
    summary(m, wrong)
}

fn pin_forgotten(wrong: bool) -> Told {
    if !wrong {
        return run(driven([1.0, 3.5, 3.0], 4.0, 1.0));
    }
    let mut m = Mechanism::new("four-bar");
    let [crank, coupler, rocker] = [("crank", 1.0), ("coupler", 3.5), ("rocker", 3.0)]
        .map(|(name, length)| m.link(name, length).unwrap());
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("C", revolute(m.ground(), rocker, vec2(4.0, 0.0), rocker.start())).unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(TAU))).unwrap();
    run(m)
}

fn spare(wrong: bool) -> Told {
    let mut m = driven([1.0, 3.5, 3.0], 4.0, 1.0);
    if wrong {
        m.link("spare", 1.0).unwrap();
    }
    run(m)
}

fn guides(wrong: bool) -> Told {
    let mut m = Mechanism::new("slider");
    let slider = m.planar("slider", pose(0.2, 0.1, 0.0)).unwrap();
    for (name, at) in
        [("guide 1", vec2(0.0, 0.0)), ("guide 2", vec2(1.0, if wrong { 0.02 } else { 0.0 }))]
    {
        m.add(name, prismatic(slider, m.ground(), vec2(0.0, 0.0), at, vec2(0.0, 1.0), 0.0))
            .unwrap();
    }
    m.add("motor", drive(slider.x(), Law::sine(0.3, 1.0, 0.0))).unwrap();
    run(m)
}

fn degrees(wrong: bool) -> Told {
    let (mut m, [crank, ..]) = four_bar([1.0, 3.5, 3.0], 4.0);
    m.add("motor", drive_angle(crank, Law::linear(if wrong { 98.6 } else { deg(98.6) }, 1.0)))
        .unwrap();
    summary(m, wrong)
}

fn in_line(wrong: bool) -> Told {
    let mut m = Mechanism::new("two bars");
    let left = m.link("left", 0.2).unwrap();
    let right = m.link("right", 0.3).unwrap();
    m.add("A", revolute(m.ground(), left, vec2(0.0, 0.0), left.start())).unwrap();
    m.add("B", revolute(left, right, left.end(), right.start())).unwrap();
    if wrong {
        m.add("C", revolute(m.ground(), right, vec2(0.5, 0.0), right.end())).unwrap();
        return run(m);
    }
    m.add("C", point_on_line(right, m.ground(), right.end(), vec2(0.4, 0.0), vec2(1.0, 0.0)))
        .unwrap();
    m.add("motor", drive_angle(left, Law::linear(0.5, 1.0))).unwrap();
    run(m)
}
