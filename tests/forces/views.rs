//! Which forces are unique does not depend on units, on the order of joints, or on where the
//! machine stands.

use kin::Mechanism;
use kin::forces::Forces;
use kin::prelude::*;

use crate::both::Engines;

const Z: Vec3 = Vec3::new(0.0, 0.0, 1.0);

fn tensor(x: f64, y: f64, z: f64) -> [[f64; 3]; 3] {
    [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]
}

/// How a mechanism is written down.
#[derive(Clone, Copy, Debug)]
struct View {
    /// Units of length to the metre.
    scale: f64,
    /// How far it is turned.
    tilt: f64,
    /// True if its joints are given the other way round.
    swapped: bool,
}

impl View {
    fn all(check: impl Fn(View)) {
        for (scale, tilt, swapped) in
            [(1.0, 0.0, false), (1000.0, 0.0, true), (0.001, 1.1, false), (1.0, 2.3, true)]
        {
            println!("{scale} {tilt} {swapped}");
            check(View { scale, tilt, swapped });
        }
    }

    fn ordered<T>(self, mut all: Vec<T>) -> Vec<T> {
        if self.swapped {
            all.reverse();
        }
        all
    }
}

/// Bennett's linkage: four links of lengths a, b, a, b whose axes are twisted by α, β with sin α /
/// a = sin β / b. Link 4 is the ground; the frame of link k stands at joint k + 1, its z-axis along
/// it.
fn bennett(view: View) -> (Mechanism, Vec<SpatialBody>) {
    let s = view.scale;
    let a = 1.0;
    let b = 1.5;
    let alpha = 0.6_f64;
    let beta = (b * alpha.sin() / a).asin();
    let mut m = Mechanism::new("Bennett");
    // Denavit–Hartenberg: turn about z by θ_k, then along x by a_k and about x by α_k. Angles of
    // the four joints: θ1, θ2, −θ1, −θ2 with tan θ1/2 tan θ2/2 = sin((β + α)/2) / sin((β − α)/2).
    let theta1 = 1.0_f64;
    let half =
        ((0.5 * (beta + alpha)).sin() / (0.5 * (beta - alpha)).sin() / (0.5 * theta1).tan()).atan();
    let lengths = [a, b, a].map(|l| l * s);
    let twists = [alpha, beta, alpha];
    // Turned about J1, which stays along z.
    let mut r = vec3(0.3, -0.2, 0.5) * s * view.tilt;
    let mut p = EulerParameters::from_axis_angle(Z, view.tilt);
    let mut bodies = Vec::new();
    let mut places = vec![(r, Z)];
    for (k, theta) in [theta1, 2.0 * half, -theta1].into_iter().enumerate() {
        p = p * EulerParameters::from_axis_angle(Z, theta);
        r += p.rotation() * vec3(lengths[k], 0.0, 0.0);
        p = p * EulerParameters::from_axis_angle(vec3(1.0, 0.0, 0.0), twists[k]);
        let body = m.spatial(&format!("link {}", k + 1), SpatialPose::new(r, p)).expect("a body");
        let inertia = tensor(0.05 * s * s, 0.06 * s * s, 0.07 * s * s);
        m.mass(body, 1.0 + 0.3 * k as f64, vec3(-0.3, 0.1, 0.05) * s, inertia).expect("a mass");
        bodies.push(body);
        places.push((r, p.rotation() * Z));
    }
    let ground = SpatialBody::from(m.ground());
    for (k, (point, axis)) in view.ordered(places.into_iter().enumerate().collect()) {
        let [i, j] =
            [(k < 3).then_some(k), k.checked_sub(1)].map(|body| body.map_or(ground, |k| bodies[k]));
        let u = [i, j].map(|body| m.local(body, point).expect("a body"));
        let h = [i, j].map(|body| m.local_direction(body, axis).expect("a body"));
        m.add(&format!("J{}", k + 1), spatial::revolute(i, j, u[0], u[1], h[0], h[1]))
            .expect("a joint");
        if k == 0 {
            let drive = spatial::drive_turn(
                i,
                j,
                Axis::along(h[0]),
                Axis::along(h[1]),
                Law::linear(0.0, 0.4),
            );
            m.add("drive", drive).expect("a driver");
        }
    }
    m.gravity(vec3(0.3, -0.5, -9.81) * s);
    (m, bodies)
}

/// Three equations too many. Driven at J1, of all reactions only the torque about a hinge's own
/// axis is unique (it is zero), and so is the torque of the drive at J1.
#[test]
fn bennetts_linkage() {
    View::all(one_bennett);
}

fn one_bennett(view: View) {
    let (m, bodies) = bennett(view);
    let ground = SpatialBody::from(m.ground());
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 1.0, 6)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    assert!(forces.drive("drive").is_ok());
    for k in 0..4 {
        let name = format!("J{}", k + 1);
        let reaction = forces.reaction(&name).expect("a joint");
        // Axes along that of the joint: the ground's at J1, those of link k at joint k + 1.
        let acted = match k {
            0 => reaction.on(bodies[0]).expect("its body"),
            _ => reaction.on(bodies[k - 1]).expect("its body").in_body(),
        };
        assert_eq!(acted.not_unique(), ["F_x", "F_y", "F_z", "T_x", "T_y"], "{name}");
        assert!(
            acted.component("T_z").expect("a hinge holds nothing there").max().abs()
                < 1e-9 * view.scale * view.scale
        );
    }
    let shaking = forces.on_ground().on(ground).expect("the ground");
    assert_eq!(shaking.not_unique(), [""; 0]);
}

/// Sarrus' linkage: a platform that moves straight up, held by two chains of three parallel hinges
/// each, the axes of one along x, of the other along y.
fn sarrus(view: View) -> (Mechanism, SpatialBody, [SpatialBody; 2]) {
    let s = view.scale;
    let turn = EulerParameters::from_axis_angle(vec3(1.0, 2.0, -0.5), view.tilt);
    let a = turn.rotation();
    let place = |v: Vec3| a * (v * s);
    let mut m = Mechanism::new("Sarrus");
    let height = 1.2;
    let platform = m
        .spatial("platform", SpatialPose::new(place(vec3(0.0, 0.0, height)), turn))
        .expect("a body");
    m.mass(platform, 3.0, vec3(0.05, 0.02, 0.1) * s, tensor(0.2 * s * s, 0.3 * s * s, 0.4 * s * s))
        .expect("a mass");
    let ground = SpatialBody::from(m.ground());
    let x = vec3(1.0, 0.0, 0.0);
    let y = vec3(0.0, 1.0, 0.0);
    let mut joints = Vec::new();
    let mut outer = Vec::new();
    for (chain, axis, out) in [("A", x, y), ("B", y, x)] {
        // The knee stands out as far as two links of length 1 leave it.
        let reach = (1.0 - 0.25 * height * height).sqrt();
        let foot = out * 0.5;
        let points = [foot, foot + out * reach + Z * (0.5 * height), foot + Z * height];
        let links = [0, 1].map(|k| {
            let name = format!("{chain} link {}", k + 1);
            let middle = (points[k] + points[k + 1]) * 0.5;
            let body = m.spatial(&name, SpatialPose::new(place(middle), turn)).expect("a body");
            m.mass(body, 0.8, vec3(0.0, 0.0, 0.0), tensor(0.1 * s * s, 0.1 * s * s, 0.1 * s * s))
                .expect("a mass");
            body
        });
        outer.push(links[1]);
        for (k, [i, j]) in
            [[links[0], ground], [links[1], links[0]], [platform, links[1]]].into_iter().enumerate()
        {
            joints.push((format!("{chain}{}", k + 1), i, j, place(points[k]), a * axis));
        }
    }
    for (name, i, j, point, axis) in view.ordered(joints) {
        let u = [i, j].map(|body| m.local(body, point).expect("a body"));
        let h = [i, j].map(|body| m.local_direction(body, axis).expect("a body"));
        m.add(&name, spatial::revolute(i, j, u[0], u[1], h[0], h[1])).expect("a joint");
    }
    let o = vec3(0.0, 0.0, 0.0);
    let law = Law::constant(height * s) + Law::sine(0.2 * s, 2.0, 0.0);
    m.add("jack", spatial::drive_slide(platform, ground, o, o, a * Z, law)).expect("a driver");
    m.gravity(place(vec3(0.3, -0.5, -9.81)));
    (m, platform, [outer[0], outer[1]])
}

/// One equation too many: both chains keep the platform from turning about z. All forces are
/// unique, and all torques but those about z.
#[test]
fn sarrus_linkage() {
    View::all(|view| {
        let (m, platform, links) = sarrus(view);
        let system = m.build().expect("a system");
        let motion = system.run_both(linspace(0.0, 1.0, 6)).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        for joint in ["A3", "B3"] {
            let acted =
                forces.reaction(joint).expect("a joint").on(platform).expect("on it").in_body();
            assert_eq!(acted.not_unique(), ["T_z"], "{joint}");
            let told = acted.torque().unwrap_err().to_string();
            assert!(
                told.contains("`A1`") && told.contains("`B2`") && !told.contains("jack"),
                "{told}"
            );
        }
        for (joint, link) in [("A2", links[0]), ("B2", links[1])] {
            let acted = forces.reaction(joint).expect("a joint").on(link).expect("on it");
            assert!(acted.force().is_ok() && acted.torque().is_err(), "{joint}");
        }
        let both = forces.sum(["A3", "B3"]).expect("both").on(platform).expect("on it");
        assert_eq!(both.not_unique(), [""; 0]);
        assert!(forces.drive("jack").is_ok());
        assert!(forces.balance().worst() < 1e-11, "{}", forces.balance());
    });
}

/// Three parallel cranks with one rod, the ground turned by `tilt`.
fn parallelogram(view: View) -> (Mechanism, [PlanarBody; 3]) {
    let s = view.scale;
    let mut m = Mechanism::new("parallelogram");
    let (sin, cos) = view.tilt.sin_cos();
    let place = |x: f64, y: f64| vec2(cos * x - sin * y, sin * x + cos * y) * s;
    let angle = 0.7_f64;
    let rod = place(1.0 + angle.cos(), angle.sin());
    let coupler = m.planar("rod", pose(rod.x, rod.y, view.tilt)).expect("a body");
    m.mass(coupler, 4.0, vec2(0.1, 0.05) * s, 0.9 * s * s).expect("a mass");
    let mut joints = Vec::new();
    let cranks = [0.0, 0.8, 2.0].map(|x| {
        let middle = place(x + 0.5 * angle.cos(), 0.5 * angle.sin());
        let name = format!("crank {}", joints.len() / 2 + 1);
        let body = m.planar(&name, pose(middle.x, middle.y, angle + view.tilt)).expect("a body");
        m.mass(body, 1.5, vec2(0.02, 0.01) * s, 0.2 * s * s).expect("a mass");
        let ground = PlanarBody::from(m.ground());
        joints.push((body, ground, vec2(-0.5, 0.0) * s, place(x, 0.0)));
        joints.push((body, coupler, vec2(0.5, 0.0) * s, vec2(x - 1.0, 0.0) * s));
        body
    });
    for (k, (i, j, u, v)) in view.ordered(joints.into_iter().enumerate().collect()) {
        let name = format!("{}{}", if k % 2 == 0 { "O" } else { "A" }, k / 2 + 1);
        m.add(&name, revolute(i, j, u, v)).expect("a joint");
    }
    m.add("motor", drive_angle(cranks[0], Law::linear(angle + view.tilt, 2.0))).expect("a driver");
    m.gravity(place(0.0, -9.81));
    (m, cranks)
}

/// One equation too many: the rod may be strained along the cranks. Across them forces are unique.
#[test]
fn a_third_crank() {
    View::all(|view| {
        let (m, cranks) = parallelogram(view);
        let ground = PlanarBody::from(m.ground());
        let system = m.build().expect("a system");
        let motion = system.run_both(linspace(0.0, 0.5, 6)).expect("a motion");
        let forces: Forces<'_> = system.forces(&motion).expect("forces");
        for (k, crank) in cranks.into_iter().enumerate() {
            for joint in ["O", "A"] {
                let reaction = forces.reaction(&format!("{joint}{}", k + 1)).expect("a joint");
                let acted = reaction.on(crank).expect("on it").in_body();
                assert_eq!(acted.not_unique(), ["F_x"], "{joint}{}", k + 1);
            }
        }
        assert!(forces.drive("motor").is_ok());
        assert_eq!(forces.on_ground().on(ground).expect("the ground").not_unique(), [""; 0]);
    });
}

/// A four-bar of spatial bodies in a plane that leans by `tilt`, with hinges across it.
fn flat_in_space(view: View) -> (Mechanism, [(String, SpatialBody); 4]) {
    let s = view.scale;
    let turn = EulerParameters::from_axis_angle(vec3(0.6, -0.8, 0.0), view.tilt);
    let a = turn.rotation();
    let mut m = Mechanism::new("four-bar in space");
    // Pins of the crank at 0.6 rad and of coupler and rocker where circles about their ends meet.
    let crank = vec2(0.6_f64.cos(), 0.6_f64.sin());
    let far = vec2(2.4, 0.0);
    let way = far - crank;
    let l = (far - crank).norm();
    let along = (4.0 - 2.25 + l * l) / (2.0 * l);
    let across = (4.0 - along * along).sqrt();
    let knee = crank + way * (along / l) + vec2(-way.y, way.x) * (across / l);
    let ends = [(vec2(0.0, 0.0), crank), (crank, knee), (far, knee)];
    let bodies = ends.map(|(from, to)| {
        let middle = (from + to) * 0.5;
        let angle = (to - from).y.atan2((to - from).x);
        let p = turn * EulerParameters::from_axis_angle(Z, angle);
        let name = format!("link {angle}");
        let place = a * (vec3(middle.x, middle.y, 0.0) * s);
        let body = m.spatial(&name, SpatialPose::new(place, p)).expect("a body");
        let inertia = tensor(0.1 * s * s, 0.2 * s * s, 0.25 * s * s);
        m.mass(body, 1.2, vec3(0.05, 0.02, 0.0) * s, inertia).expect("a mass");
        body
    });
    let ground = SpatialBody::from(m.ground());
    let [one, two, three] = bodies;
    let joints = vec![
        ("O", one, ground, vec2(0.0, 0.0)),
        ("A", one, two, crank),
        ("B", two, three, knee),
        ("C", three, ground, far),
    ];
    let held = ["O", "A", "B", "C"].map(str::to_string);
    for (name, i, j, p) in view.ordered(joints) {
        let p = a * (vec3(p.x, p.y, 0.0) * s);
        let axis = a * Z;
        let u = [i, j].map(|body| m.local(body, p).expect("a body"));
        let h = [i, j].map(|body| m.local_direction(body, axis).expect("a body"));
        m.add(name, spatial::revolute(i, j, u[0], u[1], h[0], h[1])).expect("a joint");
    }
    // Turns count from where it stands.
    let axis = [one, ground].map(|body| {
        let [h, f] =
            [Z, vec3(1.0, 0.0, 0.0)].map(|v| m.local_direction(body, a * v).expect("a body"));
        Axis::new(h, f)
    });
    m.add("motor", spatial::drive_turn(one, ground, axis[0], axis[1], Law::ramp(1.5)))
        .expect("a driver");
    m.gravity(a * (vec3(0.3, -9.81, 0.0) * s));
    let [o, first, b, c] = held;
    (m, [(o, one), (first, one), (b, two), (c, three)])
}

/// Three equations too many: within the plane all is unique, across it nothing of a single joint
/// is.
#[test]
fn a_flat_mechanism_in_space() {
    View::all(|view| {
        let (m, held) = flat_in_space(view);
        let ground = SpatialBody::from(m.ground());
        let system = m.build().expect("a system");
        let motion = system.run_both(linspace(0.0, 0.8, 6)).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        for (name, body) in held {
            let acted =
                forces.reaction(&name).expect("a joint").on(body).expect("its body").in_body();
            assert_eq!(acted.not_unique(), ["F_z", "T_x", "T_y"], "{name}");
        }
        assert!(forces.drive("motor").is_ok());
        assert_eq!(forces.on_ground().on(ground).expect("the ground").not_unique(), [""; 0]);
        assert!(forces.balance().worst() < 1e-11, "{}", forces.balance());
    });
}
