//! Values that are refused where they are given.

use super::*;

use crate::engines::Engines;

pub fn all() -> Vec<Mistake> {
    vec![
        Mistake {
            title: "Two bodies with the same name",
            line: r#"m.link("crank", 3.5)?; // the mechanism already has a crank"#,
            culprit: "crank",
            told: twice,
        },
        Mistake {
            title: "A link without length",
            line: r#"m.link("spare", 0.0)?;"#,
            culprit: "spare",
            told: no_length,
        },
        Mistake {
            title: "A body of another mechanism",
            line: r#"m.add("D", revolute(ground, other_crank, vec2(0.0, 0.0), other_crank.start()))?;"#,
            culprit: "D",
            told: foreign,
        },
        Mistake {
            title: "A joint of a body with itself",
            line: r#"m.add("D", revolute(crank, crank, crank.start(), crank.end()))?;"#,
            culprit: "D",
            told: itself,
        },
        Mistake {
            title: "A joint of the ground with the ground",
            line: r#"m.add("D", revolute(ground, ground, vec2(0.0, 0.0), vec2(1.0, 0.0)))?;"#,
            culprit: "D",
            told: grounded,
        },
        Mistake {
            title: "A parameter that is not a number",
            line: r#"m.add("D", distance(crank, ground, crank.end(), vec2(0.0, 0.0), (-1.0_f64).sqrt()))?;"#,
            culprit: "D",
            told: not_a_number,
        },
        Mistake {
            title: "A parameter that does not exist",
            line: r#"system.set("O.u_i.z", 0.1)?;"#,
            culprit: "O.u_i.z",
            told: no_parameter,
        },
    ]
}

/// The four-bar after a step that is refused, or without it.
fn refused(wrong: bool, step: impl FnOnce(&mut Mechanism, [Link; 3]) -> kin::Result<()>) -> Told {
    let (mut m, links) = four_bar([1.0, 3.5, 3.0], 4.0);
    m.add("motor", drive_angle(links[0], Law::linear(1.0, 1.0))).unwrap();
    if wrong {
        step(&mut m, links).map_err(|error| error.to_string())?;
    }
    run(m)
}

fn twice(wrong: bool) -> Told {
    refused(wrong, |m, _| m.link("crank", 3.5).map(|_| ()))
}

fn no_length(wrong: bool) -> Told {
    refused(wrong, |m, _| m.link("spare", 0.0).map(|_| ()))
}

fn foreign(wrong: bool) -> Told {
    let (_, [other, ..]) = four_bar([1.0, 3.5, 3.0], 4.0);
    refused(wrong, |m, _| {
        m.add("D", revolute(m.ground(), other, vec2(0.0, 0.0), other.start())).map(|_| ())
    })
}

fn itself(wrong: bool) -> Told {
    refused(wrong, |m, [crank, ..]| {
        m.add("D", revolute(crank, crank, crank.start(), crank.end())).map(|_| ())
    })
}

fn grounded(wrong: bool) -> Told {
    refused(wrong, |m, _| {
        m.add("D", revolute(m.ground(), m.ground(), vec2(0.0, 0.0), vec2(1.0, 0.0))).map(|_| ())
    })
}

fn not_a_number(wrong: bool) -> Told {
    refused(wrong, |m, [crank, ..]| {
        m.add("D", distance(crank, m.ground(), crank.end(), vec2(0.0, 0.0), (-1.0_f64).sqrt()))
            .map(|_| ())
    })
}

fn no_parameter(wrong: bool) -> Told {
    let mut system = driven([1.0, 3.5, 3.0], 4.0, 1.0).build().unwrap();
    if wrong {
        system.set("O.u_i.z", 0.1).map_err(|error| error.to_string())?;
    }
    system.run_both(linspace(0.0, 1.0, 21)).map_err(|error| error.to_string())
}
