//! Too many motors, too few, or motors that ask for what cannot be.

use super::*;

pub fn all() -> Vec<Mistake> {
    vec![
        Mistake {
            title: "No motor",
            line: "// nothing drives the crank",
            culprit: "crank",
            told: missing,
        },
        Mistake {
            title: "A second motor that contradicts the first",
            line: r#"m.add("motor 2", drive_angle(rocker, Law::constant(2.0)))?; // `motor` already turns the crank"#,
            culprit: "motor 2",
            told: crank_and_rocker,
        },
        Mistake {
            title: "Two motors of different speeds at one crank",
            line: r#"m.add("motor 2", drive_angle(crank, Law::linear(1.0, 1.5)))?; // `motor` turns it at 1 rad/s"#,
            culprit: "motor 2",
            told: two_speeds,
        },
        Mistake {
            title: "A second motor between two links",
            line: r#"m.add("motor 2", drive_relative_angle(rocker, coupler, Law::linear(0.2, 1.0)))?;"#,
            culprit: "motor 2",
            told: relative,
        },
        Mistake {
            title: "A motor that requests an angle out of reach",
            line: r#"m.add("motor", drive_angle(rocker, Law::linear(0.3, 1.0)))?; // the rocker's least angle is 1.77"#,
            culprit: "motor",
            told: beyond_reach,
        },
        Mistake {
            title: "The crank is driven twice and the hand not at all",
            line: r#"m.add("motor 3", drive_angle(upper_arm, Law::linear(0.6, 1.0)))?; // intended: drive_angle(hand, …)"#,
            culprit: "motor 3",
            told: wrong_body,
        },
        Mistake {
            title: "A position and an angle of the same link",
            line: r#"m.add("place", drive(crank.x(), Law::constant(0.1)))?; // `motor` already turns the crank"#,
            culprit: "place",
            told: place_and_angle,
        },
    ]
}

fn missing(wrong: bool) -> Told {
    let (mut m, [crank, ..]) = four_bar([1.0, 3.5, 3.0], 4.0);
    if !wrong {
        m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    }
    run(m)
}

fn crank_and_rocker(wrong: bool) -> Told {
    let (mut m, [crank, _, rocker]) = four_bar([1.0, 3.5, 3.0], 4.0);
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    if wrong {
        m.add("motor 2", drive_angle(rocker, Law::constant(2.0))).unwrap();
    }
    run(m)
}

fn two_speeds(wrong: bool) -> Told {
    let (mut m, [crank, ..]) = four_bar([1.0, 3.5, 3.0], 4.0);
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    if wrong {
        m.add("motor 2", drive_angle(crank, Law::linear(1.0, 1.5))).unwrap();
    }
    run(m)
}

fn relative(wrong: bool) -> Told {
    let (mut m, [crank, coupler, rocker]) = four_bar([1.0, 3.5, 3.0], 4.0);
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    if wrong {
        m.add("motor 2", drive_relative_angle(rocker, coupler, Law::linear(0.2, 1.0))).unwrap();
    }
    run(m)
}

fn beyond_reach(wrong: bool) -> Told {
    let (mut m, [_, _, rocker]) = four_bar([1.0, 3.5, 3.0], 4.0);
    m.add(
        "motor",
        drive_angle(rocker, if wrong { Law::linear(0.3, 1.0) } else { Law::linear(2.2, -0.2) }),
    )
    .unwrap();
    run(m)
}

fn wrong_body(wrong: bool) -> Told {
    let mut m = Mechanism::new("arm and hand");
    let links = ["upper arm", "fore arm", "hand"].map(|name| m.link(name, 1.0).unwrap());
    m.add("shoulder", revolute(m.ground(), links[0], vec2(0.0, 0.0), links[0].start())).unwrap();
    m.add("elbow", revolute(links[0], links[1], links[0].end(), links[1].start())).unwrap();
    m.add("wrist", revolute(links[1], links[2], links[1].end(), links[2].start())).unwrap();
    m.add("motor 1", drive_angle(links[0], Law::linear(0.6, 1.0))).unwrap();
    m.add("motor 2", drive_angle(links[1], Law::linear(0.9, 1.0))).unwrap();
    m.add("motor 3", drive_angle(links[if wrong { 0 } else { 2 }], Law::linear(0.6, 1.0))).unwrap();
    run(m)
}

fn place_and_angle(wrong: bool) -> Told {
    let (mut m, [crank, ..]) = four_bar([1.0, 3.5, 3.0], 4.0);
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    if wrong {
        m.add("place", drive(crank.x(), Law::constant(0.1))).unwrap();
    }
    run(m)
}
