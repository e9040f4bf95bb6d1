//! Mistakes that show on the way.

use super::*;

use crate::engines::Engines;

pub fn all() -> Vec<Mistake> {
    vec![
        Mistake {
            title: "A motor that leads past a toggle",
            line: r#"m.add("motor", drive_angle(rocker, Law::linear(2.2, -1.0)))?; // the rocker turns back at 1.77"#,
            culprit: "motor",
            told: toggle,
        },
        Mistake {
            title: "A run that begins at a change point",
            line: r#"m.add("motor", drive_angle(crank, Law::linear(0.0, 1.0)))?; // a parallelogram is flat at 0"#,
            culprit: "Begin at t = 0.01 s",
            told: change_point,
        },
        Mistake {
            title: "A law whose parts do not meet",
            line: r#"Law::sequence(0.0, [(0.5, Law::ramp(1.0)), (0.5, Law::constant(0.9))])"#,
            culprit: "motor",
            told: jump,
        },
        Mistake {
            title: "A law with a corner",
            line: r#"Law::sequence(0.0, [(0.5, Law::ramp(1.0)), (0.5, Law::linear(0.5, -1.0))])"#,
            culprit: "law",
            told: corner,
        },
        Mistake {
            title: "No times",
            line: r#"system.run([])?;"#,
            culprit: "there are none",
            told: no_times,
        },
        Mistake {
            title: "Times that go back",
            line: r#"system.run([0.0, 0.2, 0.1])?;"#,
            culprit: "0.2 is followed by 0.1",
            told: times_back,
        },
    ]
}

fn toggle(wrong: bool) -> Told {
    let (mut m, [_, _, rocker]) = four_bar([1.0, 3.5, 3.0], 4.0);
    m.add("motor", drive_angle(rocker, Law::linear(2.2, if wrong { -1.0 } else { -0.3 }))).unwrap();
    run(m)
}

fn change_point(wrong: bool) -> Told {
    let mut m = Mechanism::new("parallelogram");
    let [crank, coupler, rocker] = [("crank", 1.0), ("coupler", 2.0), ("rocker", 1.0)]
        .map(|(name, length)| m.link(name, length).unwrap());
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(m.ground(), rocker, vec2(2.0, 0.0), rocker.start())).unwrap();
    m.add("motor", drive_angle(crank, Law::linear(0.0, 1.0))).unwrap();
    let from = if wrong { 0.0 } else { 0.01 };
    m.build()
        .and_then(|system| system.run_both(linspace(from, 1.0, 21)))
        .map_err(|error| error.to_string())
}

fn motor(law: Law) -> Told {
    let (mut m, [crank, ..]) = four_bar([1.0, 3.5, 3.0], 4.0);
    m.add("motor", drive_angle(crank, law)).map_err(|error| error.to_string())?;
    run(m)
}

fn jump(wrong: bool) -> Told {
    motor(
        Law::sequence(
            0.0,
            [(0.5, Law::ramp(1.0)), (0.5, Law::constant(if wrong { 0.9 } else { 0.5 }))],
        ) + Law::constant(1.0),
    )
    .or_else(|message| if wrong { Err(message) } else { motor(Law::ramp(1.0)) })
}

fn corner(wrong: bool) -> Told {
    let corner = Law::sequence(0.0, [(0.5, Law::ramp(1.0)), (0.5, Law::linear(0.5, -1.0))]);
    motor(if wrong { corner } else { Law::cycloidal(1.0, 1.0) })
}

fn no_times(wrong: bool) -> Told {
    let system = driven([1.0, 3.5, 3.0], 4.0, 1.0).build().unwrap();
    system
        .run_both(if wrong { vec![] } else { linspace(0.0, 1.0, 101) })
        .map_err(|error| error.to_string())
}

fn times_back(wrong: bool) -> Told {
    let system = driven([1.0, 3.5, 3.0], 4.0, 1.0).build().unwrap();
    system
        .run_both(if wrong { [0.0, 0.2, 0.1] } else { [0.0, 0.1, 0.2] })
        .map_err(|error| error.to_string())
}
