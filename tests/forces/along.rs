//! Forces by functions under `#[force]` against the same ones by hand, on both routes; and loads in
//! files.

use kin::extend::by_dual;
use kin::law::Ends;
use kin::prelude::*;
use kin::{Load, Mechanism, loads};

use crate::both::Engines;

/// A strut whose damper works by the square of the rate, with a force by time in it.      [N]
#[force]
fn strut(x: Coord, rate: Rate, t: Time, k: f64, free: f64, c: f64) -> f64 {
    let spring = -k * (x - free);
    spring - c * rate * rate.abs() + 3.0 * (2.0 * t).sin()
}

/// The same on dual numbers.      [N]
#[force(dual)]
fn strut_by_dual(x: Coord, rate: Rate, t: Time, k: f64, free: f64, c: f64) -> f64 {
    -k * (x - free) - c * rate * rate.abs() + 3.0 * (2.0 * t).sin()
}

/// Energy of a spring that gets stiffer.      [J]
#[potential]
fn stiffening(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, k: f64) -> f64 {
    let l = (i.point(u_i) - j.point(u_j)).norm();
    0.25 * k * l * l * l * l
}

/// A length of one's own: how far P_i is from a circle about P_j.      [m]
#[constraint]
fn gap(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, radius: f64) -> f64 {
    (i.point(u_i) - j.point(u_j)).norm() - radius
}

const U: [Vec2; 2] = [Vec2::new(0.3, 0.1), Vec2::new(-0.2, 0.15)];

/// Two bodies of which everything is driven.
fn planar() -> (Mechanism, [PlanarBody; 2]) {
    let mut m = Mechanism::new("two bodies");
    let bodies = [("a", 0.9, 0.2), ("b", -0.4, 1.0)].map(|(name, x, y)| {
        let body = m.planar(name, pose(x, y, 0.0)).expect("a body");
        for (axis, coordinate, mean) in
            [("x", body.x(), x), ("y", body.y(), y), ("theta", body.theta(), 0.3)]
        {
            let law = Law::constant(mean) + Law::sine(0.2 * mean, 1.7, 0.4 * x);
            m.add(&format!("{name}.{axis}"), drive(coordinate, law)).expect("a driver");
        }
        body
    });
    (m, bodies)
}

fn spatial() -> (Mechanism, [SpatialBody; 2]) {
    let mut m = Mechanism::new("two bodies in space");
    let bodies = [("a", 0.9), ("b", -0.4)].map(|(name, x)| {
        let body = m.spatial(name, SpatialPose::at(vec3(x, 0.2, 0.1))).expect("a body");
        let law = |a: f64, w: f64| Law::sine(a, w, 0.4 * x);
        let o = vec3(0.0, 0.0, 0.0);
        m.add(
            &format!("{name} moves"),
            spatial_motion(
                body,
                m.ground(),
                o,
                [Law::constant(x) + law(0.2, 1.7), law(0.3, 1.1), law(0.1, 2.0)],
                [law(0.3, 1.3), law(0.4, 0.9), law(0.5, 1.9)],
            ),
        )
        .expect("a driver");
        body
    });
    (m, bodies)
}

fn spatial_motion(
    body: SpatialBody,
    ground: Ground,
    o: Vec3,
    [x, y, z]: [Law; 3],
    [yaw, pitch, roll]: [Law; 3],
) -> kin::joints::drivers::spatial::drive_motion {
    let p = EulerParameters::identity();
    spatial::drive_motion(body, ground, o, o, p, p, x, y, z, yaw, pitch, roll)
}

/// Force at P on the first body and the torque there, over time.
fn on_first(
    mut m: Mechanism,
    body: PlanarBody,
    load: impl kin::loads::IntoLoad,
) -> (Vec<[f64; 3]>, Motion) {
    m.load("load", load).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 3.0, 31)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let acted = forces.load("load").expect("a load").on(body).expect("its body").at(U[0]);
    let force = acted.force().expect("unique");
    let torque = acted.torque().expect("unique");
    let all = force.iter().zip(torque).map(|(f, t)| [f.x, f.y, t]).collect();
    assert!(forces.balance().worst() < 1e-12, "{}", forces.balance());
    (all, motion)
}

/// The force apart along the line between the points, by hand, from l, l̇ and t.
fn by_hand(
    motion: &Motion,
    bodies: [PlanarBody; 2],
    push: impl Fn(f64, f64, f64) -> f64,
) -> Vec<[f64; 3]> {
    let points = [0, 1].map(|k| motion.point(bodies[k], U[k]).expect("a point"));
    let at = |k: usize| {
        let d = points[0].r()[k] - points[1].r()[k];
        let v = points[0].v()[k] - points[1].v()[k];
        let l = d.norm();
        let f = d * (push(l, d.dot(v) / l, motion.times()[k]) / l);
        [f.x, f.y, 0.0]
    };
    (0..motion.len()).map(at).collect()
}

fn near(found: &[[f64; 3]], exact: &[[f64; 3]], what: &str) {
    let size = exact.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let off = found
        .iter()
        .flatten()
        .zip(exact.iter().flatten())
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    println!("{what}: off by {off:.1e} of {size:.3}");
    assert!(size > 0.1 && off <= 1e-13 * (1.0 + size), "{what}: {off:e}");
}

#[test]
fn a_force_of_ones_own_is_the_same_by_hand_on_both_routes() {
    let push =
        |l: f64, v: f64, t: f64| -80.0 * (l - 0.4) - 12.0 * v * v.abs() + 3.0 * (2.0 * t).sin();
    let length = |[a, b]: [PlanarBody; 2]| loads::length(a, b, U[0], U[1]);
    let (m, bodies) = planar();
    let (found, motion) = on_first(m, bodies[0], strut(length(bodies), 80.0, 0.4, 12.0));
    near(&found, &by_hand(&motion, bodies, push), "symbolic");
    let (m, bodies) = planar();
    let dual = strut_by_dual(by_dual(length(bodies)), 80.0, 0.4, 12.0);
    let (found, motion) = on_first(m, bodies[0], dual);
    near(&found, &by_hand(&motion, bodies, push), "dual");
    let (m, bodies) = planar();
    let own = strut(gap(bodies[0], bodies[1], U[0], U[1], 0.3), 80.0, 0.1, 12.0);
    let (found, motion) = on_first(m, bodies[0], own);
    near(&found, &by_hand(&motion, bodies, push), "along an expression of one's own");
}

#[test]
fn the_elements_of_the_library_push_as_their_formulas_say() {
    let table = || Law::spline(&[(0.5, 90.0), (1.2, 40.0), (2.5, 25.0)], Ends::Natural);
    let check =
        |what: &str, make: &dyn Fn(loads::length) -> Load, push: &dyn Fn(f64, f64, f64) -> f64| {
            let (m, [a, b]) = planar();
            let (found, motion) = on_first(m, a, make(loads::length(a, b, U[0], U[1])));
            near(&found, &by_hand(&motion, [a, b], push), what);
        };
    let law = table();
    check("spring and damper", &|x| loads::spring_damper(x, 70.0, 0.3, 5.0), &|l, v, _| {
        -70.0 * (l - 0.3) - 5.0 * v
    });
    check("damper", &|x| loads::viscous(x, 9.0), &|_, v, _| -9.0 * v);
    check("pressure", &|x| loads::pressure(x, table(), 0.2), &|l, _, _| law.at(l) * 0.2);
    check("by length", &|x| loads::force_by(x, table()), &|l, _, _| law.at(l));
    check("by time", &|x| loads::force_in_time(x, table()), &|_, _, t| law.at(t));
    check("gas", &|x| loads::gas(x, 200.0, 2.0, 3.0, 1.3), &|l, _, _| {
        200.0 * (3.0 / (3.0 + l - 2.0)).powf(1.3)
    });
}

#[test]
fn a_bushing_with_damping_in_the_plane() {
    let k = [300.0, 500.0, 9.0];
    let c = [4.0, 7.0, 0.6];
    let (m, [a, b]) = planar();
    let (found, motion) = on_first(m, a, loads::damped_bushing(a, b, U, k, c, 0.1));
    let points = [a, b]
        .map(|body| motion.point(body, if body == a { U[0] } else { U[1] }).expect("a point"));
    let turns = [a, b].map(|body| motion.coordinate(body.theta()).expect("an angle"));
    let mut exact = Vec::new();
    for n in 0..motion.len() {
        let [(t_a, w_a), (t_b, w_b)] =
            [0, 1].map(|i| (turns[i].value.values()[n], turns[i].rate.values()[n]));
        let (sin, cos) = t_b.sin_cos();
        let back = |v: Vec2| vec2(cos * v.x + sin * v.y, cos * v.y - sin * v.x);
        let way = points[0].r()[n] - points[1].r()[n];
        let d = back(way);
        let v = back(points[0].v()[n] - points[1].v()[n]);
        // The way as b sees it turns back as b turns.
        let rate = vec2(v.x + w_b * d.y, v.y - w_b * d.x);
        let x = -k[0] * d.x - c[0] * rate.x;
        let y = -k[1] * d.y - c[1] * rate.y;
        let torque = -k[2] * (t_a - t_b - 0.1) - c[2] * (w_a - w_b);
        exact.push([cos * x - sin * y, sin * x + cos * y, torque]);
    }
    near(&found, &exact, "bushing");
}

/// Force at P_i on the first of two spatial bodies and the torque there, against the same by hand:
/// `push` gives both in the axes of the second body from the way, its rate, the matrix of i in j
/// and its ω.
fn in_space(
    what: &str,
    load: impl FnOnce(SpatialBody, SpatialBody) -> Load,
    push: impl Fn(Vec3, Vec3, Mat3, Vec3) -> [Vec3; 2],
) {
    let u = [vec3(0.3, 0.1, -0.2), vec3(-0.2, 0.15, 0.4)];
    let (mut m, [a, b]) = spatial();
    m.load("load", load(a, b)).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 3.0, 31)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let acted = forces.load("load").expect("a load").on(a).expect("its body").at(u[0]);
    let force = acted.force().expect("unique");
    let torque = acted.torque().expect("unique");
    let points = [(a, u[0]), (b, u[1])].map(|(body, u)| motion.point(body, u).expect("a point"));
    let omegas = [a, b].map(|body| motion.rotation(body).expect("a body").omega().to_vec());
    let mut off = 0.0_f64;
    let mut size = 0.0_f64;
    for n in 0..motion.len() {
        let [m_a, m_b] = [0, 7].map(|first| matrix(&motion.q(n)[first..]));
        let way = points[0].r()[n] - points[1].r()[n];
        let v = points[0].v()[n] - points[1].v()[n];
        let w_a = omegas[0][n];
        let w_b = omegas[1][n];
        let back = m_b.transpose();
        let rate = back * (v - w_b.cross(way));
        let [f, t] = push(back * way, rate, back * m_a, back * (w_a - w_b));
        size = size.max(f.norm()).max(t.norm());
        off = off.max((force[n] - m_b * f).norm()).max((torque[n] - m_b * t).norm());
    }
    println!("{what}: off by {off:.1e} of {size:.3}");
    assert!(size > 0.1 && off <= 1e-13 * (1.0 + size), "{what}: {off:e}");
    assert!(forces.balance().worst() < 1e-12, "{}", forces.balance());
}

/// The matrix of a spatial body by its coordinates.
fn matrix(q: &[f64]) -> Mat3 {
    EulerParameters::new(q[3], q[4], q[5], q[6]).rotation()
}

/// The quaternion (cos φ/2, e) of a matrix without half turns, by its antisymmetric part.
fn vector_of(a: Mat3) -> (f64, Vec3) {
    let e0 = 0.5 * (1.0 + a.m11 + a.m22 + a.m33).sqrt();
    (e0, vec3(a.m32 - a.m23, a.m13 - a.m31, a.m21 - a.m12) * (0.25 / e0))
}

#[test]
fn a_bushing_with_damping_in_space() {
    let k = vec3(300.0, 500.0, 100.0);
    let kappa = vec3(9.0, 4.0, 6.0);
    let c = vec3(3.0, 5.0, 1.0);
    let gamma = vec3(0.9, 0.4, 0.6);
    let u = [vec3(0.3, 0.1, -0.2), vec3(-0.2, 0.15, 0.4)];
    let by = |a: Vec3, b: Vec3| vec3(a.x * b.x, a.y * b.y, a.z * b.z);
    let make = |a, b| {
        loads::spatial::damped_bushing(a, b, u, EulerParameters::default(), [k, kappa], [c, gamma])
    };
    in_space("bushing", make, |d, rate, turn, w| {
        let (e0, e) = vector_of(turn);
        // ė = ½ (e0 ω + ω × e), ω of i in j by the axes of j; a torque T has the power 2 ė · (κ 2
        // e + γ 2 ė).
        let e_rate = (w * e0 + w.cross(e)) * 0.5;
        let along = (by(kappa, e) + by(gamma, e_rate)) * 2.0;
        [-(by(k, d) + by(c, rate)), -(along * e0 + e.cross(along))]
    });
}

#[test]
fn a_torsion_spring_in_space_is_one_in_the_plane_where_axes_are_held_parallel() {
    let mut m = Mechanism::new("hinge");
    let door = m.spatial("door", SpatialPose::at(vec3(0.0, 0.0, 0.0))).expect("a body");
    let o = vec3(0.0, 0.0, 0.0);
    let z = vec3(0.0, 0.0, 1.0);
    let ground = m.ground();
    m.add("hinge", spatial::revolute(door, ground, o, o, z, z)).expect("a joint");
    m.add("motor", spatial::drive_turn(door, ground, z, z, Law::ramp(0.5))).expect("a driver");
    m.load("closer", loads::spatial::torsion_spring(door, ground, z, z, 7.0, 0.2)).expect("a load");
    m.load("brake", loads::viscous(loads::spatial::turn(door, ground, z, z), 3.0)).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 3.0, 7)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    for (t, effort) in
        motion.times().iter().zip(forces.drive("motor").expect("a driver").effort().values())
    {
        assert!((effort - (7.0 * (0.5 * t - 0.2) + 1.5)).abs() < 1e-13, "{t}: {effort}");
    }
}

/// Everything that a file can carry.
fn with_everything() -> Mechanism {
    let (mut m, [a, b]) = planar();
    let x = || loads::length(a, b, U[0], U[1]);
    let table = || Law::spline(&[(0.5, 90.0), (1.2, 40.0), (2.5, 25.0)], Ends::Natural);
    m.mass(a, 1.2, vec2(0.1, 0.02), 0.03).expect("a mass");
    m.load("own force", strut(gap(a, b, U[0], U[1], 0.1), 80.0, 0.4, 12.0)).expect("a load");
    m.load("own energy", stiffening(a, b, U[0], U[1], 3.0)).expect("a load");
    m.load("bushing", loads::damped_bushing(a, b, U, [300.0, 500.0, 9.0], [4.0, 7.0, 0.6], 0.1))
        .expect("a load");
    m.load("pressure", loads::pressure(x(), table(), 0.2)).expect("a load");
    m.load("gas", loads::gas_spring(a, b, U, 200.0, [2.0, 3.0], 1.3)).expect("a load");
    m.load("by time", loads::force_along(a.theta(), Law::sine(3.0, 2.0, 0.1))).expect("a load");
    let push = [Law::sine(20.0, 3.0, 0.0), Law::constant(1.0)];
    m.load("push", Load::force_in_body(b, U[1], push).and(Load::torque(a, 2.0))).expect("a load");
    m
}

fn efforts(m: Mechanism) -> Vec<Vec<f64>> {
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 3.0, 7)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let effort = |name: &str| forces.drive(name).expect("a driver").effort().values().to_vec();
    forces.drives().into_iter().map(effort).collect()
}

#[test]
fn loads_come_back_from_a_file_with_equations_of_ones_own_as_text() {
    let m = with_everything();
    let text = serde_json::to_string(&m.data().expect("data")).expect("writes");
    let data = serde_json::from_str(&text).expect("reads");
    let again = Mechanism::from_data(&data, &kin_text::registry()).expect("the same");
    assert_eq!(again.data().expect("data"), data);
    let before = efforts(m);
    let after = efforts(again);
    let off = before.iter().flatten().zip(after.iter().flatten()).map(|(a, b)| (a - b).abs());
    let off = off.fold(0.0, f64::max);
    assert!(off < 1e-12, "{off:e}");
    let by_program = kin::data::Registry::new().with::<strut>().with::<gap>().with::<stiffening>();
    let again = Mechanism::from_data(&data, &by_program).expect("the same");
    assert_eq!(efforts(again), before);
}

/// Text of the library in a file would take the place of its compiled functions.
#[test]
fn loads_of_the_library_carry_no_text() {
    let data = with_everything().data().expect("data");
    let own = ["fn strut(", "fn gap(", "fn stiffening("];
    assert_eq!(data.equations.len(), own.len(), "{:?}", data.equations);
    assert!(own.iter().all(|own| data.equations.iter().any(|text| text.contains(own))));
}

#[test]
fn loads_of_a_file_that_make_no_sense_are_refused_by_name() {
    let told = |change: &dyn Fn(&mut serde_json::Value)| {
        let mut value =
            serde_json::to_value(with_everything().data().expect("data")).expect("a value");
        change(&mut value["loads"]);
        let data = serde_json::from_value(value).expect("the form of a file");
        Mechanism::from_data(&data, &kin_text::registry())
            .err()
            .map(|e| e.to_string())
            .unwrap_or_default()
    };
    let kind = told(&|loads| loads[3]["parts"][0]["along"]["force"]["kind"] = "vapour".into());
    assert!(kind.starts_with("load `pressure`: unknown constraint `vapour`"), "{kind}");
    let body = told(&|loads| loads[6]["parts"][1]["on_body"]["body"] = "c".into());
    assert!(body.starts_with("load `push`: no body `c`. Use "), "{body}");
    let area =
        told(&|loads| loads[3]["parts"][0]["along"]["force"]["parameters"]["area"] = (-1.0).into());
    assert_eq!(
        area,
        "`pressure` (pressure): the area of the piston must be above zero (area = -1)"
    );
    let missing = told(&|loads| {
        loads[4]["parts"][0]["along"]["x"]["parameters"]
            .as_object_mut()
            .expect("an object")
            .remove("u_i");
    });
    assert_eq!(missing, "load `gas`: its parameter `u_i` is missing. Is it meant by `u_j`?");
    assert_eq!(
        told(&|loads| loads[0]["parts"] = serde_json::json!([])),
        "a load has an empty name. Give the load a name"
    );
}
