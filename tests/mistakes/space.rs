//! Mistakes in space.

use kin::SolverOptions;
use kin::joints::drivers::spatial as drivers;

use super::*;
use crate::engines::Engines;

const O: Vec3 = Vec3 { x: 0.0, y: 0.0, z: 0.0 };
const X: Vec3 = Vec3 { x: 1.0, y: 0.0, z: 0.0 };
const Y: Vec3 = Vec3 { x: 0.0, y: 1.0, z: 0.0 };
const Z: Vec3 = Vec3 { x: 0.0, y: 0.0, z: 1.0 };

pub fn all() -> Vec<Mistake> {
    vec![
        Mistake {
            title: "A hinge without motor",
            line: "// nothing drives `Part2`",
            culprit: "Part2",
            told: hinge,
        },
        Mistake {
            title: "A rod between two balls",
            line: r#"m.add("B", spatial::spherical(rod, rocker, rod.end(), rocker.end()))?; // `A` is also a ball joint"#,
            culprit: "rod",
            told: rod,
        },
        Mistake {
            title: "A second hinge beside the axis of the first",
            line: r#"m.add("hinge 2", spatial::revolute(door, ground, z, vec3(0.02, 0.0, 1.0), z, z))?;"#,
            culprit: "hinge 2",
            told: second_hinge,
        },
        Mistake {
            title: "A hinge with the opposite axis",
            line: r#"m.add("hinge 2", spatial::revolute(door, ground, z, z, z, -z))?;"#,
            culprit: "hinge 2",
            told: opposite,
        },
        Mistake {
            title: "A global axis in place of a local axis",
            line: r#"m.add("hinge", spatial::revolute(wheel, ground, o, o, y, y))?; // intended: m.local_direction(wheel, y)"#,
            culprit: "wheel",
            told: axis,
        },
        Mistake {
            title: "A part that is off by five nanometres",
            line: r#"let third = m.link("crank 3", 1.0 + 5e-9)?; // an imported length"#,
            culprit: "SolverOptions::new().allowed_misfit(6e-9)",
            told: imported,
        },
    ]
}

fn hinge(wrong: bool) -> Told {
    let mut m = Mechanism::new("door");
    let part = m.spatial("Part2", SpatialPose::at(O)).unwrap();
    m.add("hinge", spatial::revolute(part, m.ground(), vec3(0.5, 0.0, 0.0), O, Z, Z)).unwrap();
    if !wrong {
        m.add("motor", drivers::drive_turn(part, m.ground(), Z, Z, Law::ramp(1.0))).unwrap();
    }
    run(m)
}

fn rod(wrong: bool) -> Told {
    let mut m = Mechanism::new("two cranks and a rod");
    let crank = m.spatial("crank", SpatialPose::at(O)).unwrap();
    let rocker = m.spatial("rocker", SpatialPose::at(vec3(3.0, 0.0, -0.5))).unwrap();
    let rod = m.spatial_link_between("rod", (1.0, 0.0, 0.0), (3.0, 1.5, 1.7)).unwrap();
    m.add("O", spatial::revolute(crank, m.ground(), O, O, Z, Z)).unwrap();
    m.add("C", spatial::revolute(rocker, m.ground(), O, vec3(3.0, 0.0, -0.5), X, X)).unwrap();
    m.add("A", spatial::spherical(crank, rod, X, rod.start())).unwrap();
    m.add("B", spatial::spherical(rod, rocker, rod.end(), vec3(0.0, 1.5, 2.2))).unwrap();
    m.add("motor", drivers::drive_turn(crank, m.ground(), Z, Z, Law::ramp(1.0))).unwrap();
    if !wrong {
        assert_eq!(m.hold_idle_turns().unwrap(), ["rod"]);
    }
    run(m)
}

fn door(second: impl FnOnce(&mut Mechanism, SpatialBody)) -> Told {
    let mut m = Mechanism::new("door");
    let door = m.spatial("door", SpatialPose::at(O)).unwrap();
    m.add("hinge 1", spatial::revolute(door, m.ground(), O, O, Z, Z)).unwrap();
    second(&mut m, door);
    m.add("motor", drivers::drive_turn(door, m.ground(), Z, Z, Law::ramp(1.0))).unwrap();
    run(m)
}

fn second_hinge(wrong: bool) -> Told {
    let at = if wrong { vec3(0.02, 0.0, 1.0) } else { Z };
    door(|m, door| {
        m.add("hinge 2", spatial::revolute(door, m.ground(), Z, at, Z, Z)).unwrap();
    })
}

fn opposite(wrong: bool) -> Told {
    let axis = if wrong { vec3(0.0, 0.0, -1.0) } else { Z };
    door(|m, door| {
        m.add("hinge 2", spatial::revolute(door, m.ground(), Z, Z, Z, axis)).unwrap();
    })
}

fn axis(wrong: bool) -> Told {
    let mut m = Mechanism::new("wheel");
    let wheel = m.spatial("wheel", SpatialPose::turned(vec3(0.0, 2.0, 0.0), X, PI / 2.0)).unwrap();
    let axis = if wrong { Y } else { m.local_direction(wheel, Y).unwrap() };
    m.add("hinge", spatial::revolute(wheel, m.ground(), O, vec3(0.0, 2.0, 0.0), axis, Y)).unwrap();
    m.add("motor", drivers::drive_turn(wheel, m.ground(), axis, Y, Law::ramp(0.5))).unwrap();
    summary(m, wrong)
}

fn imported(wrong: bool) -> Told {
    let mut m = Mechanism::new("parallelogram");
    let pivots = [vec2(0.0, 0.0), vec2(2.0, 0.0), vec2(0.8, -0.5)];
    let coupler = m.planar("coupler", pose(0.5, 0.8, 0.0)).unwrap();
    let cranks = [0, 1, 2].map(|k| {
        m.link(&format!("crank {}", k + 1), if k == 2 { 1.0 + 5e-9 } else { 1.0 }).unwrap()
    });
    for (k, (crank, pivot)) in cranks.iter().zip(pivots).enumerate() {
        m.add(&format!("O{}", k + 1), revolute(m.ground(), *crank, pivot, crank.start())).unwrap();
        m.add(&format!("A{}", k + 1), revolute(*crank, coupler, crank.end(), pivot)).unwrap();
    }
    m.add("motor", drive_angle(cranks[0], Law::linear(1.0, 1.0))).unwrap();
    let options =
        if wrong { SolverOptions::default() } else { SolverOptions::new().allowed_misfit(6e-9) };
    m.build()
        .and_then(|system| system.run_both_with(linspace(0.0, 6.0, 61), &options))
        .map_err(|error| error.to_string())
}
