//! Mechanisms with masses and loads from the files of `tests/data/forces/`, planar and spatial
//! ones.

use kin::prelude::*;
use kin::{Load, Mechanism, Result};
use serde_json::Value;

use super::data::{array, number, numbers};

/// Bodies by name, of the plane or of space.
pub enum Bodies {
    Planar(Vec<(String, PlanarBody)>),
    Spatial(Vec<(String, SpatialBody)>),
}

/// f(x) = a + b x + c sin(w x).
#[law]
fn wave(x: f64, a: f64, b: f64, c: f64, w: f64) -> f64 {
    a + b * x + c * (w * x).sin()
}

/// Length between two points.      [m]
#[constraint]
fn length(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> f64 {
    (i.point(u_i) - j.point(u_j)).norm()
}

/// A law as the files write it: a sum of constants, multiples of t and of sin(w*t).
pub fn law(file: &Value, text: &str) -> Law {
    let value = |word: &str| {
        word.parse::<f64>().unwrap_or_else(|_| number(&file["parameters"], word.trim()))
    };
    let mut sum = [0.0; 4];
    let mut sign = 1.0;
    for word in text.split_whitespace() {
        match word {
            "+" | "-" => sign = if word == "-" { -1.0 } else { 1.0 },
            term => {
                let (term, sign) = match term.strip_prefix('-') {
                    Some(rest) => (rest, -sign),
                    None => (term, sign),
                };
                if let Some((before, inside)) = term.split_once("sin(") {
                    sum[2] = sign * before.strip_suffix('*').map_or(1.0, value);
                    let inside = inside.trim_end_matches(')');
                    sum[3] = inside.strip_suffix("*t").map_or(1.0, value);
                } else if let Some(factor) = term.strip_suffix("*t") {
                    sum[1] += sign * value(factor);
                } else {
                    sum[0] += sign * value(term);
                }
            }
        }
    }
    wave(sum[0], sum[1], sum[2], sum[3])
}

/// The mechanism of a file, with everything that acts.
pub fn build(file: &Value) -> Result<(Mechanism, Bodies)> {
    let mut m = Mechanism::new(text(file, "id"));
    let bodies = if file["dim"] == 2 { planar(&mut m, file)? } else { spatial(&mut m, file)? };
    Ok((m, bodies))
}

fn planar(m: &mut Mechanism, file: &Value) -> Result<Bodies> {
    let guess = numbers(file, "initial_guess");
    let mut bodies = vec![];
    let mut poses = guess.chunks(3);
    for body in list(file, "bodies") {
        let name = text(body, "name");
        if body["ground"] == true {
            bodies.push((name.to_string(), PlanarBody::from(m.ground())));
            continue;
        }
        let q = poses.next().expect("a pose");
        let own = m.planar(name, pose(q[0], q[1], q[2]))?;
        m.mass(own, number(body, "mass"), vec2_of(body, "centre"), number(body, "inertia"))?;
        bodies.push((name.to_string(), own));
    }
    m.gravity(vec2_of(file, "gravity"));
    let body = |of: &Value, field: &str| find(&bodies, text(of, field));
    for c in list(file, "constraints").iter().chain(list(file, "drivers")) {
        let name = text(c, "name");
        let j = body(c, "j");
        let i = || body(c, "i");
        let pi = || vec2_of(c, "pi");
        let pj = || vec2_of(c, "pj");
        match text(c, "type") {
            "revolute" => m.add(name, revolute(i(), j, pi(), pj()))?,
            "prismatic" => {
                m.add(name, prismatic(i(), j, pi(), pj(), vec2_of(c, "hi"), number(c, "theta0")))?
            }
            "relative_slide" => m.add(
                name,
                drive_slide(j, i(), pj(), pi(), vec2_of(c, "gi"), law(file, text(c, "f"))),
            )?,
            "coordinate" => m.add(name, drive(j.theta(), law(file, text(c, "f"))))?,
            other => panic!("a constraint `{other}`"),
        };
    }
    for e in list(file, "elements") {
        let name = text(e, "name");
        match text(e, "type") {
            "force" => {
                let laws = [0, 1].map(|k| law(file, e["force"][k].as_str().expect("a law")));
                m.load(name, Load::force(body(e, "body"), vec2_of(e, "point"), laws))?;
            }
            "spring" => {
                let [k, c, l] = ["stiffness", "damping", "length"].map(|field| number(e, field));
                let strut = length(body(e, "i"), body(e, "j"), vec2_of(e, "pi"), vec2_of(e, "pj"));
                m.load(name, Load::along(strut, move |x, rate, _| -k * (x - l) - c * rate))?;
            }
            other => panic!("an element `{other}`"),
        }
    }
    Ok(Bodies::Planar(bodies))
}

fn spatial(m: &mut Mechanism, file: &Value) -> Result<Bodies> {
    let guess = numbers(file, "initial_guess");
    let mut bodies = vec![];
    let mut poses = guess.chunks(7);
    for body in list(file, "bodies") {
        let name = text(body, "name");
        if body["ground"] == true {
            bodies.push((name.to_string(), SpatialBody::from(m.ground())));
            continue;
        }
        let q = poses.next().expect("a pose");
        let p = kin::EulerParameters::new(q[3], q[4], q[5], q[6]);
        let own = m.spatial(name, SpatialPose::new(vec3(q[0], q[1], q[2]), p))?;
        let inertia: Vec<[f64; 3]> = super::data::rows(body, "inertia")
            .into_iter()
            .map(|row| row.try_into().expect("three"))
            .collect();
        let inertia: [[f64; 3]; 3] = inertia.try_into().expect("three rows");
        m.mass(own, number(body, "mass"), vec3_of(body, "centre"), inertia)?;
        bodies.push((name.to_string(), own));
    }
    m.gravity(vec3_of(file, "gravity"));
    let body = |of: &Value, field: &str| find(&bodies, text(of, field));
    for c in list(file, "constraints").iter().chain(list(file, "drivers")) {
        let name = text(c, "name");
        let i = body(c, "i");
        let j = body(c, "j");
        let pi = || vec3_of(c, "pi");
        let pj = || vec3_of(c, "pj");
        match text(c, "type") {
            "revolute" => m.add(
                name,
                spatial::revolute(i, j, pi(), pj(), vec3_of(c, "hi"), vec3_of(c, "hj")),
            )?,
            "universal" => m.add(
                name,
                spatial::universal(i, j, pi(), pj(), vec3_of(c, "hi"), vec3_of(c, "hj")),
            )?,
            "spherical" => m.add(name, spatial::spherical(i, j, pi(), pj()))?,
            "axis_angle" => {
                let hinge = list(file, "constraints")
                    .iter()
                    .find(|joint| [&joint["i"], &joint["j"]] == [&c["i"], &c["j"]])
                    .expect("a hinge");
                let axis_j = Axis::new(vec3_of(hinge, "hj"), vec3_of(c, "bj"));
                let axis_i = Axis::new(vec3_of(c, "hi"), vec3_of(c, "ai"));
                m.add(
                    name,
                    kin::joints::spatial::drive_turn(j, i, axis_j, axis_i, law(file, text(c, "f"))),
                )?
            }
            other => panic!("a constraint `{other}`"),
        };
    }
    for e in list(file, "elements") {
        let laws = [0, 1, 2].map(|k| law(file, e["torque"][k].as_str().expect("a law")));
        m.load(text(e, "name"), Load::torque(body(e, "body"), laws))?;
    }
    Ok(Bodies::Spatial(bodies))
}

/// The body of that name.
pub fn find<B: Copy>(bodies: &[(String, B)], name: &str) -> B {
    bodies.iter().find(|(known, _)| known == name).map(|(_, body)| *body).expect("a body")
}

pub fn list<'a>(of: &'a Value, field: &str) -> &'a [Value] {
    of[field].as_array().unwrap_or_else(|| panic!("no list `{field}`"))
}

pub fn text<'a>(of: &'a Value, field: &str) -> &'a str {
    of[field].as_str().unwrap_or_else(|| panic!("no text `{field}` in {of}"))
}

fn vec2_of(of: &Value, field: &str) -> Vec2 {
    let [x, y] = array(of, field);
    vec2(x, y)
}

fn vec3_of(of: &Value, field: &str) -> Vec3 {
    let [x, y, z] = array(of, field);
    vec3(x, y, z)
}
