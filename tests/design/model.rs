//! Mechanisms of the files in `tests/data/design`, and what of each parameter of a file is read
//! where.

use kin::Mechanism;
use kin::mechanism::IntoConstraint;
use kin::prelude::*;
use serde_json::Value;

use crate::data::{number, numbers};

/// A file with its system, and for each of its parameters the system's own, with factors.
pub struct Model {
    pub file: Value,
    pub system: System,
    /// Its bodies by name, without the ground.
    pub planar: Vec<(String, PlanarBody)>,
    pub spatial: Vec<(String, SpatialBody)>,
    read: Vec<(String, String, f64)>,
}

impl Model {
    /// The system's parameters with the factors of one parameter of the file.
    pub fn behind(&self, parameter: &str) -> Vec<(&str, f64)> {
        let own = self.read.iter().filter(|(name, ..)| name == parameter);
        own.map(|(_, system, factor)| (system.as_str(), *factor)).collect()
    }

    /// All parameters of the system that are asked for.
    pub fn parameters(&self) -> Vec<&str> {
        let mut all: Vec<&str> = self.read.iter().map(|(_, system, _)| system.as_str()).collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}

/// θ − th0 − w t − a sin(W t) = 0      [rad]
#[constraint]
fn drive_wave(body: Planar, th0: f64, w: f64, a: f64, big_w: f64, t: Time) -> f64 {
    body.theta - (th0 + w * t + a * (big_w * t).sin())
}

/// The direction (1, 0, 0) of a body turns about z: th0 + w t + a sin(3 t).      [-]
#[constraint]
fn turn_about_z(body: Spatial, th0: f64, w: f64, a: f64, t: Time) -> f64 {
    let angle = th0 + w * t + a * (3.0 * t).sin();
    let direction = body.direction(vec3(1.0, 0.0, 0.0));
    direction.y * angle.cos() - direction.x * angle.sin()
}

/// The tip (l2, 0) is on an ellipse.      [m]
#[constraint]
#[allow(clippy::too_many_arguments)]
fn on_ellipse(
    arm: Planar,
    l2: f64,
    cx: f64,
    cy: f64,
    rx: f64,
    ry: f64,
    w: f64,
    ph: f64,
    t: Time,
) -> Vec2 {
    arm.point(vec2(l2, 0.0)) - vec2(cx + rx * (w * t + ph).cos(), cy + ry * (w * t + ph).sin())
}

/// The edge (0, −s) of the follower is the point of the cam's profile with polar angle p0 + w t.
/// [m]
#[constraint]
#[allow(clippy::too_many_arguments)]
fn on_profile(
    cam: Planar,
    follower: Planar,
    r0: f64,
    a1: f64,
    a2: f64,
    a3: f64,
    p0: f64,
    w: f64,
    s: f64,
    t: Time,
) -> Vec2 {
    let angle = p0 + w * t;
    let r = r0 + a1 * angle.cos() + a2 * (2.0 * angle).cos() + a3 * (3.0 * angle).sin();
    cam.point(vec2(r * angle.cos(), r * angle.sin())) - follower.point(vec2(0.0, -s))
}

/// The loop closure of an offset slider-crank.      [m]
#[constraint]
#[allow(clippy::too_many_arguments)]
fn loop_closure(
    phi: Coord,
    x: Coord,
    r: f64,
    l: f64,
    e: f64,
    ox: f64,
    th0: f64,
    w: f64,
    a: f64,
    big_w: f64,
    t: Time,
) -> (f64, f64) {
    let theta = th0 + w * t + a * (big_w * t).sin();
    let along = ox + r * theta.cos() + l * phi.cos() - x;
    let across = r * theta.sin() + l * phi.sin() - e;
    (along, across)
}

/// A mechanism on its way, and what has been read of the file.
struct Builder {
    file: Value,
    m: Mechanism,
    read: Vec<(String, String, f64)>,
}

impl Builder {
    /// The number of `-a/2`, noted as the system's parameter of that name.
    fn number(&mut self, text: &str, parameter: String) -> f64 {
        let (sign, rest) = text.strip_prefix('-').map_or((1.0, text), |rest| (-1.0, rest));
        let (factor, name) =
            rest.strip_suffix("/2").map_or((sign, rest), |name| (0.5 * sign, name));
        if let Ok(value) = name.parse::<f64>() {
            return factor * value;
        }
        self.read.push((name.to_string(), parameter, factor));
        factor * number(&self.file["parameters"], name)
    }

    fn numbers<const N: usize>(&mut self, of: &Value, field: &str, parameter: &str) -> [f64; N] {
        let texts: Vec<String> = of[field].as_array().expect("a list").iter().map(text).collect();
        let parts = ["x", "y", "z"];
        std::array::from_fn(|k| {
            self.number(&texts[k], format!("{}.{parameter}.{}", text(&of["name"]), parts[k]))
        })
    }

    fn point(&mut self, of: &Value, field: &str, parameter: &str) -> Vec2 {
        let [x, y] = self.numbers(of, field, parameter);
        vec2(x, y)
    }

    fn place(&mut self, of: &Value, field: &str, parameter: &str) -> Vec3 {
        let [x, y, z] = self.numbers(of, field, parameter);
        vec3(x, y, z)
    }

    /// Parameters that are called in the constraint as they are in the file.
    fn own<const N: usize>(&mut self, constraint: &str, names: [&str; N]) -> [f64; N] {
        names.map(|name| {
            let local = if name == "A" {
                "a"
            } else if name == "W" {
                "big_w"
            } else {
                name
            };
            let value = self.file["parameters"][name].as_f64();
            if value.is_some() {
                self.read.push((name.to_string(), format!("{constraint}.{local}"), 1.0));
            }
            value.unwrap_or(0.0)
        })
    }

    fn add(&mut self, name: &str, constraint: impl IntoConstraint) {
        self.m.add(name, constraint).expect("a constraint");
    }
}

fn text(value: &Value) -> String {
    value.as_str().expect("a text").to_string()
}

/// The mechanism of a file.
pub fn model(name: &str) -> Model {
    let file = crate::data::read(&format!("design/sens_{name}"));
    let guess = numbers(&file, "initial_guess");
    let mut b = Builder { m: Mechanism::new(name), file: file.clone(), read: Vec::new() };
    let mut planar = Vec::new();
    let mut spatial = Vec::new();
    let bodies =
        file["bodies"].as_array().expect("bodies").iter().skip(1).map(|body| text(&body["name"]));
    if name == "slider_crank_loop" {
        let phi = b.m.angle("phi", guess[0]).unwrap();
        let x = b.m.length("x", guess[1]).unwrap();
        let [r, l, e, ox, th0, w, a, big_w] =
            b.own("loop", ["r", "l", "e", "ox", "th0", "w", "A", "W"]);
        b.add("loop", loop_closure(phi, x, r, l, e, ox, th0, w, a, big_w));
    } else if file["dim"] == 3 {
        for (body, q) in bodies.zip(guess.chunks(7)) {
            let p = EulerParameters { e0: q[3], e1: q[4], e2: q[5], e3: q[6] }.normalize();
            spatial.push((
                body.clone(),
                b.m.spatial(&body, SpatialPose::new(vec3(q[0], q[1], q[2]), p)).unwrap(),
            ));
        }
        rssr(&mut b, &file, [spatial[0].1, spatial[1].1]);
    } else {
        for (body, q) in bodies.zip(guess.chunks(3)) {
            planar.push((body.clone(), b.m.planar(&body, pose(q[0], q[1], q[2])).unwrap()));
        }
        joints(&mut b, &file, &planar);
    }
    let system = b.m.build().expect("a system");
    Model { file, system, planar, spatial, read: b.read }
}

/// Crank, rocker and a coupler of constant length in space.
fn rssr(b: &mut Builder, file: &Value, [crank, rocker]: [SpatialBody; 2]) {
    let c = &file["constraints"];
    let z = vec3(0.0, 0.0, 1.0);
    let at = b.place(&c[0], "pi", "u_i");
    let ground = b.m.ground();
    b.add("O1", spatial::revolute(ground, crank, at, vec3(0.0, 0.0, 0.0), z, z));
    let at = b.place(&c[1], "pi", "u_i");
    let axis = vec3(0.0, -0.6, 0.8);
    b.add("O2", spatial::revolute(ground, rocker, at, vec3(0.0, 0.0, 0.0), axis, z));
    let u_i = b.place(&c[2], "pi", "u_i");
    let u_j = b.place(&c[2], "pj", "u_j");
    let length = b.number("L", "coupler.length".to_string());
    b.add("coupler", spatial::distance(crank, rocker, u_i, u_j, length));
    let [th0, w, a] = b.own("drive", ["th0", "w", "A"]);
    b.add("drive", turn_about_z(crank, th0, w, a));
}

/// Joints and driver of a plane mechanism.
fn joints(b: &mut Builder, file: &Value, bodies: &[(String, PlanarBody)]) {
    let body = |b: &Builder, name: &Value| {
        bodies
            .iter()
            .find(|(known, _)| name == known)
            .map_or_else(|| PlanarBody::from(b.m.ground()), |(_, body)| *body)
    };
    for c in file["constraints"].as_array().expect("constraints") {
        let name = text(&c["name"]);
        let i = body(b, &c["i"]);
        let j = body(b, &c["j"]);
        let u_i = b.point(c, "pi", "u_i");
        let u_j = b.point(c, "pj", "u_j");
        match c["type"].as_str().expect("a type") {
            "revolute" => b.add(&name, revolute(i, j, u_i, u_j)),
            _ => {
                let h_i = b.point(c, "hi", "h_i");
                b.add(&name, prismatic(i, j, u_i, u_j, h_i, 0.0));
            }
        }
    }
    let c = &file["drivers"][0];
    let name = text(&c["name"]);
    let j = body(b, &c["j"]);
    match (file["id"].as_str().expect("a name"), c["f"].is_object()) {
        ("two_link_ellipse", _) => {
            let [l2, cx, cy, rx, ry, w, ph] =
                b.own(&name, ["l2", "cx", "cy", "rx", "ry", "w", "ph"]);
            b.add(&name, on_ellipse(j, l2, cx, cy, rx, ry, w, ph));
        }
        ("cam_knife", _) => {
            let [r0, a1, a2, a3, p0, w, s] = b.own(&name, ["r0", "a1", "a2", "a3", "p0", "w", "s"]);
            let cam = body(b, &c["i"]);
            b.add(&name, on_profile(cam, j, r0, a1, a2, a3, p0, w, s));
        }
        (_, true) => {
            let xs = c["f"]["x"]
                .as_array()
                .expect("x")
                .iter()
                .map(|x| text(x).parse::<f64>().expect("a number"));
            let xs: Vec<f64> = xs.collect();
            let y = |(k, x): (usize, &f64)| {
                (*x, b.number(&format!("y{k}"), format!("{name}.law.y[{k}]")))
            };
            let table: Vec<(f64, f64)> = xs.iter().enumerate().map(y).collect();
            b.add(&name, drive_angle(j, Law::spline(&table, Ends::Natural)));
        }
        _ => {
            let [th0, w, a, big_w] = b.own(&name, ["th0", "w", "A", "W"]);
            b.add(&name, drive_wave(j, th0, w, a, big_w));
        }
    }
}
