//! Lengths and points with which a loop does not close.

use super::*;

pub fn all() -> Vec<Mistake> {
    vec![
        Mistake {
            title: "Millimetres among metres",
            line: r#"let coupler = m.link("coupler", 3500.0)?; // intended: 3.5"#,
            culprit: "coupler",
            told: |wrong| run(driven([1.0, if wrong { 3500.0 } else { 3.5 }, 3.0], 4.0, 0.0)),
        },
        Mistake {
            title: "A decimal point too far to the left",
            line: r#"let coupler = m.link("coupler", 0.35)?; // intended: 3.5"#,
            culprit: "motor",
            told: |wrong| run(driven([1.0, if wrong { 0.35 } else { 3.5 }, 3.0], 4.0, 1.0)),
        },
        Mistake {
            title: "A decimal point too far to the right",
            line: r#"let rocker = m.link("rocker", 30.0)?; // intended: 3.0"#,
            culprit: "rocker",
            told: |wrong| run(driven([1.0, 3.5, if wrong { 30.0 } else { 3.0 }], 4.0, 0.0)),
        },
        Mistake {
            title: "Links whose sum is too short",
            line: r#"let coupler = m.link("coupler", 0.5)?; // intended: 3.0"#,
            culprit: "coupler",
            told: |wrong| run(driven([1.0, if wrong { 0.5 } else { 3.0 }, 2.5], 4.0, PI)),
        },
        Mistake {
            title: "A pin in millimetres",
            line: r#"m.add("C", revolute(ground, rocker, vec2(4000.0, 0.0), rocker.start()))?; // intended: 4.0"#,
            culprit: "C",
            told: |wrong| run(driven([1.0, 3.5, 3.0], if wrong { 4000.0 } else { 4.0 }, 0.0)),
        },
        Mistake {
            title: "A third crank that is not as long as the others",
            line: r#"let third = m.link("crank 3", 1.1)?; // the other two are 1.0 long"#,
            culprit: "crank 3",
            told: third_crank,
        },
        Mistake {
            title: "A rod that is too short",
            line: r#"m.add("rod", distance(crank, slider, crank.end(), vec2(0.0, 0.0), 0.1))?; // intended: 1.0"#,
            culprit: "rod.length",
            told: rod,
        },
    ]
}

fn third_crank(wrong: bool) -> Told {
    let mut m = Mechanism::new("parallelogram");
    let pivots = [vec2(0.0, 0.0), vec2(2.0, 0.0), vec2(0.8, -0.5)];
    let coupler = m.planar("coupler", pose(0.5, 0.8, 0.0)).unwrap();
    let lengths = [1.0, 1.0, if wrong { 1.1 } else { 1.0 }];
    let cranks = [0, 1, 2].map(|k| m.link(&format!("crank {}", k + 1), lengths[k]).unwrap());
    for (k, (crank, pivot)) in cranks.iter().zip(pivots).enumerate() {
        m.add(&format!("O{}", k + 1), revolute(m.ground(), *crank, pivot, crank.start())).unwrap();
        m.add(&format!("A{}", k + 1), revolute(*crank, coupler, crank.end(), pivot)).unwrap();
    }
    m.add("motor", drive_angle(cranks[0], Law::linear(1.0, 1.0))).unwrap();
    run(m)
}

fn rod(wrong: bool) -> Told {
    let mut m = Mechanism::new("slider-crank");
    let crank = m.link("crank", 0.3).unwrap();
    let slider = m.planar("slider", pose(0.6, 0.8, 0.0)).unwrap();
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add(
        "rod",
        distance(crank, slider, crank.end(), vec2(0.0, 0.0), if wrong { 0.1 } else { 1.0 }),
    )
    .unwrap();
    m.add(
        "guide",
        prismatic(slider, m.ground(), vec2(0.0, 0.0), vec2(0.0, 0.8), vec2(0.0, 1.0), 0.0),
    )
    .unwrap();
    m.add("motor", drive_angle(crank, Law::linear(0.5, 1.0))).unwrap();
    run(m)
}
