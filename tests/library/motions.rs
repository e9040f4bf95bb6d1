//! Joints at work in small machines, against rotations by nalgebra and closed forms.

use kin::Error;
use kin::check::any_spatial as s;
use kin::prelude::*;
use kin::results::Quantity;
use nalgebra::{Quaternion, Unit, UnitQuaternion, Vector3};

use crate::engines::Engines;

fn near(found: f64, exact: f64, tolerance: f64) {
    assert!((found - exact).abs() <= tolerance * (1.0 + exact.abs()), "{found} instead of {exact}");
}

fn about(axis: [f64; 3], angle: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Unit::new_normalize(Vector3::from(axis)), angle)
}

fn parameters(turn: UnitQuaternion<f64>) -> EulerParameters {
    EulerParameters::new(turn.w, turn.i, turn.j, turn.k)
}

fn turn(q: &[f64]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(q[3], q[4], q[5], q[6]))
}

/// Value, rate and second rate at each time.
fn follows(found: &Quantity, exact: impl Fn(f64) -> [f64; 3]) {
    for (k, t) in found.value.times().iter().enumerate() {
        let found =
            [&found.value, &found.rate, &found.second_rate].map(|series| series.values()[k]);
        found.into_iter().zip(exact(*t)).for_each(|(found, exact)| near(found, exact, 1e-10));
    }
}

/// A law with its first two derivatives, written out: 0.3 + 2 t + 0.4 sin 3 t.
fn swing() -> Law {
    Law::linear(0.3, 2.0) + Law::sine(0.4, 3.0, 0.0)
}

fn swung(t: f64) -> [f64; 3] {
    let (sin, cos) = (3.0 * t).sin_cos();
    [0.3 + 2.0 * t + 0.4 * sin, 2.0 + 1.2 * cos, -3.6 * sin]
}

/// A hinge on a slanting axis between two bodies that are turned anyhow: unchosen its zero is where
/// it happens to be, chosen it is as drawn.
#[test]
fn the_zero_of_a_hinge_is_where_it_was_chosen() {
    let h = vec3(0.4, -0.3, 0.8);
    let f = vec3(1.0, 0.5, 0.2);
    for (frame_turn, door_turn) in [(0.0, 0.0), (0.7, -1.9), (2.8, 0.4)] {
        let mut m = Mechanism::new("door");
        let frame = m
            .spatial(
                "frame",
                SpatialPose::turned(vec3(0.5, 0.1, 0.0), vec3(1.0, 2.0, 3.0), frame_turn),
            )
            .unwrap();
        let door = m
            .spatial(
                "door",
                SpatialPose::turned(vec3(0.2, 0.0, 0.9), vec3(-1.0, 0.3, 0.1), door_turn),
            )
            .unwrap();
        let wall = EulerParameters::from_axis_angle(vec3(1.0, 2.0, 3.0), frame_turn);
        m.add("wall", spatial::fixed(frame, vec3(0.5, 0.1, 0.0), wall)).unwrap();
        let at = (0.3, 0.3, 0.3);
        let u_i = m.local(door, at).unwrap();
        let u_j = m.local(frame, at).unwrap();
        let h_i = m.local_direction(door, h).unwrap();
        let h_j = m.local_direction(frame, h).unwrap();
        let f_i = m.local_direction(door, f).unwrap();
        let f_j = m.local_direction(frame, f).unwrap();
        m.add("hinge", spatial::revolute(door, frame, u_i, u_j, h_i, h_j).zero(f_i, f_j)).unwrap();
        m.add(
            "motor",
            spatial::drive_turn(door, frame, Axis::new(h_i, f_i), Axis::new(h_j, f_j), swing()),
        )
        .unwrap();
        let system = m.build().unwrap();
        let motion = system.run_both(linspace(0.0, 3.0, 61)).unwrap();
        follows(&system.measure(&motion, "hinge.angle").unwrap(), swung);
        // the door is where it was drawn, turned about the hinge by the angle
        let drawn = about([-1.0, 0.3, 0.1], door_turn);
        for (k, t) in motion.times().iter().enumerate() {
            let expected = about([0.4, -0.3, 0.8], swung(*t)[0]) * drawn;
            assert!(turn(&motion.q(k)[7..]).angle_to(&expected) < 1e-7, "at {t}");
        }
    }
}

/// A row of `zeros.json`: axes and directions of a body that stands as the ground does, and the
/// angle of f_i from f_j about them.
#[derive(serde::Deserialize)]
struct Zero {
    h_i: (V, Option<V>),
    h_j: V,
    f_i: V,
    f_j: V,
    angle: f64,
}

type V = (f64, f64, f64);

/// The table is that of the wheel's tests too. An f that the axis has of its own is replaced.
#[test]
fn zeros_of_hinges_sleeves_and_tables() {
    let rows: Vec<Zero> = serde_json::from_str(include_str!("zeros.json")).unwrap();
    let o = vec3(0.0, 0.0, 0.0);
    for Zero { h_i: (h, f), h_j, f_i, f_j, angle } in rows {
        let h_i = f.map_or_else(|| Axis::along(h), |f| Axis::new(h, f));
        for joint in ["hinge", "sleeve", "table"] {
            let mut m = Mechanism::new("m");
            let a = m.spatial("a", SpatialPose::at(o)).unwrap();
            match joint {
                "hinge" => {
                    m.add(joint, spatial::revolute(a, Ground, o, o, h_i, h_j).zero(f_i, f_j))
                }
                "sleeve" => {
                    m.add(joint, spatial::cylindrical(a, Ground, o, o, h_i, h_j).zero(f_i, f_j))
                }
                _ => m.add(joint, spatial::planar(a, Ground, o, o, h_i, h_j).zero(f_i, f_j)),
            }
            .unwrap();
            m.add("still", spatial::fixed(a, o, EulerParameters::identity())).unwrap();
            let system = m.build().unwrap();
            let motion = system.run([0.0]).unwrap();
            let found = system.measure(&motion, format!("{joint}.angle")).unwrap();
            near(found.value.values()[0], angle, 1e-12);
        }
    }
}

#[test]
fn a_zero_along_the_axis_is_refused() {
    let mut m = Mechanism::new("m");
    let a = m.spatial("a", SpatialPose::at(vec3(0.0, 0.0, 0.0))).unwrap();
    let z = vec3(0.0, 0.0, 1.0);
    let o = vec3(0.0, 0.0, 0.0);
    for (f_i, f_j) in [((0.0, 0.0, 2.0), (1.0, 0.0, 0.0)), ((1.0, 0.0, 0.0), (0.0, 0.0, 2.0))] {
        for refused in [
            m.add("hinge", spatial::revolute(a, Ground, o, o, z, z).zero(f_i, f_j)),
            m.add("sleeve", spatial::cylindrical(a, Ground, o, o, z, z).zero(f_i, f_j)),
            m.add("table", spatial::planar(a, Ground, o, o, z, z).zero(f_i, f_j)),
        ] {
            let error = refused.unwrap_err();
            assert!(error.to_string().contains("h_i"), "{error}");
        }
    }
}

/// Body i is turned in body j by the one angle about its bar and by the other about that of j: from
/// any two angles the measures find them again.
#[test]
fn angles_of_a_universal_joint_turn_the_one_frame_into_the_other() {
    let h_i = [0.6, 0.8, 0.0];
    let h_j = [0.0, 0.0, 2.0];
    let joint = spatial::universal(
        s(),
        s(),
        (0.0, 0.0, 0.0),
        (0.0, 0.0, 0.0),
        vec3(0.6, 0.8, 0.0),
        vec3(0.0, 0.0, 2.0),
    );
    let names: Vec<&str> = joint.facts().measures.iter().map(|measure| measure.name).collect();
    let place = |name: &str| names.iter().position(|known| *known == name).unwrap();
    for j_anyhow in [0.0, 1.3] {
        for (a_i, a_j) in [(0.0, 0.0), (0.4, -0.9), (-2.5, 1.1), (1.5, 3.0)] {
            let j = about([1.0, -2.0, 0.5], j_anyhow);
            let i = j * about(h_j, a_j) * about(h_i, a_i);
            let body = |turn: UnitQuaternion<f64>| {
                [vec![0.0; 3], parameters(turn).to_array().to_vec()].concat()
            };
            let q = [body(i), body(j)].concat();
            assert!(kin::extend::terms(&joint, &q, &[], 0.0).c.amax() < 1e-14, "the joint is open");
            let still = kin::extend::Moving { q: &q, ..kin::extend::Moving::default() };
            near(kin::extend::measure(&joint, place("angle_i"), still, 0.0)[0], a_i, 1e-14);
            near(kin::extend::measure(&joint, place("angle_j"), still, 0.0)[0], a_j, 1e-14);
        }
    }
}

/// A thread makes a screw of a sleeve.
#[test]
fn a_thread_on_a_sleeve_is_a_screw() {
    let o = vec3(0.0, 0.0, 0.0);
    let axis = Axis::new((0.0, 3.0, 4.0), (1.0, 0.0, 0.0));
    let lead = -0.02;
    let mut m = Mechanism::new("nut");
    let nut = m.spatial("nut", SpatialPose::at(o)).unwrap();
    m.add("sleeve", spatial::cylindrical(nut, Ground, o, o, axis, axis.h)).unwrap();
    m.add("thread", spatial::thread(nut, Ground, o, o, axis, axis, lead)).unwrap();
    m.add("motor", spatial::drive_turn(nut, Ground, axis, axis, swing())).unwrap();
    let system = m.build().unwrap();
    let motion = system.run_both(linspace(0.0, 8.0, 81)).unwrap();
    follows(&system.measure(&motion, "sleeve.angle").unwrap(), swung);
    follows(&system.measure(&motion, "sleeve.slide").unwrap(), |t| {
        swung(t).map(|x| lead / TAU * x)
    });
    follows(&motion.coordinate(nut.z()).unwrap(), |t| swung(t).map(|x| 0.8 * lead / TAU * x));
}

/// Two bevel friction wheels whose radii have no common measure, over many turns, driven by what
/// rolls through.
#[test]
fn wheels_by_their_radii_keep_any_ratio_over_many_turns() {
    let o = vec3(0.0, 0.0, 0.0);
    let x = Vec3::x();
    let z = Vec3::z();
    let r_i = 0.1;
    let r_j = 0.1 * 2.0_f64.sqrt();
    for sign in [1.0, -1.0] {
        let mut m = Mechanism::new("wheels");
        let i = m.spatial("i", SpatialPose::at(o)).unwrap();
        let j = m.spatial("j", SpatialPose::at(o)).unwrap();
        let rolled = m.length("rolled", 0.0).unwrap();
        m.add("axle i", spatial::revolute(i, Ground, o, o, z, z)).unwrap();
        m.add("axle j", spatial::revolute(j, Ground, o, o, x, x)).unwrap();
        m.add(
            "mesh",
            spatial::gear_by_radii(i, j, Ground, rolled, z, x, z, x, r_i, sign * r_j, 0.25),
        )
        .unwrap();
        m.add("motor", spatial::drive_turn(i, Ground, z, z, Law::linear(0.25, 20.0))).unwrap();
        let system = m.build().unwrap();
        let motion = system.run_both(linspace(0.0, 5.0, 201)).unwrap();
        follows(&motion.coordinate(rolled).unwrap(), |t| [r_i * 20.0 * t, r_i * 20.0, 0.0]);
        follows(&system.measure(&motion, "axle j.angle").unwrap(), |t| {
            [-sign * r_i / r_j * 20.0 * t, -sign * r_i / r_j * 20.0, 0.0]
        });
    }
}

/// A differential: the cage turns by half of what both wheels turn; and six coordinates, as many as
/// there may be.
#[test]
fn more_than_two_coordinates_are_coupled() {
    let mut m = Mechanism::new("differential");
    let [left, right, cage] = ["left", "right", "cage"].map(|name| m.angle(name, 0.0).unwrap());
    m.add("left motor", drive(left, swing())).unwrap();
    m.add("right motor", drive(right, Law::ramp(-1.0))).unwrap();
    m.add("differential", linear_coupling([left, right, cage], [1.0, 1.0, -2.0], 0.5)).unwrap();
    let data = m.data().unwrap();
    let system = m.build().unwrap();
    let motion = system.run_both(linspace(0.0, 6.0, 31)).unwrap();
    let halved = |t: f64| {
        let [x, rate, second] = swung(t);
        [0.5 * (x - t - 0.5), 0.5 * (rate - 1.0), 0.5 * second]
    };
    follows(&motion.coordinate(cage).unwrap(), halved);
    assert!(system.prove(&motion).unwrap().is_complete());
    let again = Mechanism::from_data(&data, &kin::data::Registry::new())
        .unwrap()
        .build()
        .unwrap()
        .run_both([0.0, 6.0])
        .unwrap();
    near(again.named("cage").unwrap().value.values()[1], halved(6.0)[0], 1e-14);

    let mut m = Mechanism::new("six");
    let q: [Coordinate; 6] = std::array::from_fn(|k| m.length(&format!("x{k}"), 0.0).unwrap());
    for (k, driven) in q.into_iter().take(5).enumerate() {
        m.add(&format!("motor {k}"), drive(driven, Law::ramp(k as f64))).unwrap();
    }
    m.add("sum", linear_coupling(q, [1.0, -1.0, 1.0, -1.0, 1.0, 2.0], 4.0)).unwrap();
    let motion = m.build().unwrap().run_both([0.0, 1.0]).unwrap();
    follows(&motion.coordinate(q[5]).unwrap(), |t| [0.5 * (4.0 - 2.0 * t), -1.0, 0.0]);

    let mut m = Mechanism::new("nothing");
    let [a, b] = ["a", "b"].map(|name| m.angle(name, 0.0).unwrap());
    let error = m.add("it", linear_coupling([a, b], [0.0, 0.0], 1.0)).unwrap_err();
    assert!(
        matches!(error, Error::InvalidParameters { .. })
            && error.to_string().contains("at least one factor must differ from zero"),
        "{error}"
    );
}

/// A planetary train by its turns alone: Willis' ratio of sun, planet and carrier with the ring
/// held.
#[test]
fn a_planetary_train_is_one_linear_coupling_a_mesh() {
    let sun_teeth = 20.0;
    let planet_teeth = 15.0;
    let ring_teeth = sun_teeth + 2.0 * planet_teeth;
    let mut m = Mechanism::new("planetary train");
    let [sun, planet, carrier, ring] =
        ["sun", "planet", "carrier", "ring"].map(|name| m.angle(name, 0.0).unwrap());
    // seen from the carrier: z_s (φ_s − φ_c) + z_p (φ_p − φ_c) = 0 and z_r (φ_r − φ_c) − z_p (φ_p −
    // φ_c) = 0
    m.add(
        "sun with planet",
        linear_coupling(
            [sun, planet, carrier],
            [sun_teeth, planet_teeth, -sun_teeth - planet_teeth],
            0.0,
        ),
    )
    .unwrap();
    m.add(
        "planet in ring",
        linear_coupling(
            [ring, planet, carrier],
            [ring_teeth, -planet_teeth, planet_teeth - ring_teeth],
            0.0,
        ),
    )
    .unwrap();
    m.add("brake", drive(ring, Law::constant(0.0))).unwrap();
    m.add("motor", drive(sun, Law::ramp(7.0))).unwrap();
    let motion = m.build().unwrap().run_both(linspace(0.0, 10.0, 11)).unwrap();
    let ratio = sun_teeth / (sun_teeth + ring_teeth);
    follows(&motion.coordinate(carrier).unwrap(), |t| [7.0 * ratio * t, 7.0 * ratio, 0.0]);
}

/// A frame of the one body moves in a frame of the other, which moves itself, by six laws; poses by
/// nalgebra's quaternions, rates by differences.
#[test]
fn a_body_moves_in_another_by_six_laws() {
    let law =
        |k: f64| Law::sine(0.3 + 0.1 * k, 1.0 + 0.2 * k, k) + Law::linear(0.2 * k, 0.5 - 0.3 * k);
    let value = |k: f64, t: f64| {
        (0.3 + 0.1 * k) * ((1.0 + 0.2 * k) * t + k).sin() + 0.2 * k + (0.5 - 0.3 * k) * t
    };
    let u_i = vec3(0.3, -0.2, 0.5);
    let u_j = vec3(-0.4, 0.1, 0.7);
    let f_i = about([1.0, 2.0, -1.0], 0.8);
    let f_j = about([0.3, -1.0, 0.6], -2.1);
    let mut m = Mechanism::new("general motion");
    let base = m.spatial("base", SpatialPose::at(vec3(0.0, 0.0, 0.0))).unwrap();
    let tool = m.spatial("tool", SpatialPose::at(vec3(0.0, 0.0, 0.0))).unwrap();
    m.add(
        "place",
        spatial::drive_point(
            base,
            (0.0, 0.0, 0.0),
            Law::ramp(1.0),
            Law::constant(2.0),
            Law::sine(0.2, 1.0, 0.0),
        ),
    )
    .unwrap();
    m.add("spin", spatial::drive_rotation(base, Ground, (1.0, 1.0, 0.0), Law::ramp(0.9))).unwrap();
    // Euler parameters of any length: what counts is the turn
    let p_i = parameters(f_i);
    let p_j = parameters(f_j);
    let p_i = EulerParameters::new(3.0 * p_i.e0, 3.0 * p_i.e1, 3.0 * p_i.e2, 3.0 * p_i.e3);
    let [x, y, z, yaw, pitch, roll] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(law);
    m.add(
        "motion",
        spatial::drive_motion(tool, base, u_i, u_j, p_i, p_j, x, y, z, yaw, pitch, roll),
    )
    .unwrap();
    let motion = m.build().unwrap().run_both(linspace(0.0, 5.0, 501)).unwrap();
    let vector = |v: Vec3| Vector3::new(v.x, v.y, v.z);
    for (k, t) in motion.times().iter().enumerate() {
        let [base, tool] = [&motion.q(k)[..7], &motion.q(k)[7..]];
        let a_j = turn(base);
        let a_i = turn(tool);
        let frame_j = about([1.0, 1.0, 0.0], 0.9 * t) * f_j;
        near((a_j * f_j).angle_to(&frame_j), 0.0, 1e-7);
        let expected = frame_j
            * about([0.0, 0.0, 1.0], value(3.0, *t))
            * about([0.0, 1.0, 0.0], value(4.0, *t))
            * about([1.0, 0.0, 0.0], value(5.0, *t));
        assert!((a_i * f_i).angle_to(&expected) < 1e-7, "at {t}");
        let r = |q: &[f64]| Vector3::new(q[0], q[1], q[2]);
        let d = r(tool) + a_i * vector(u_i) - r(base) - a_j * vector(u_j);
        let s = frame_j.inverse() * d;
        (0..3).for_each(|c| near(s[c], value(c as f64, *t), 1e-12));
    }
    let point = motion.point(tool, u_i).unwrap();
    for k in 1..motion.len() - 1 {
        let slope = (vector(point.r()[k + 1]) - vector(point.r()[k - 1])) / 0.02;
        assert!(
            (slope - vector(point.v()[k])).norm() < 1e-3 * (1.0 + slope.norm()),
            "velocity at step {k}"
        );
    }
}

/// Where a vector is asked for, tuples and arrays do as well.
#[test]
fn tuples_and_arrays_are_points() {
    let mut m = Mechanism::new("points");
    let a = m.link("a", 1.0).unwrap();
    let b = m.spatial("b", SpatialPose::at((0.0, 0.0, 0.0))).unwrap();
    m.add("pin", revolute(m.ground(), a, (0.0, 0.1), [-0.5, 0.0])).unwrap();
    m.add("motor", drive_angle(a, Law::ramp(1.0))).unwrap();
    m.add("ball", spatial::spherical(b, m.ground(), (0.0, 0.0, 0.0), [0.0, 1.0, 0.0])).unwrap();
    m.add("turn", spatial::drive_rotation(b, m.ground(), (0.0, 0.0, 1.0), Law::ramp(1.0))).unwrap();
    let motion = m.build().unwrap().run_both([0.0, 1.0]).unwrap();
    near(motion.point(a, (0.5, 0.0)).unwrap().r()[0].x, 1.0, 1e-14);
    near(motion.point(b, (1.0, 0.0, 0.0)).unwrap().r()[1].x, 1.0_f64.cos(), 1e-14);
}

#[test]
fn a_law_is_divided_by_a_number() {
    let law = Law::sine(0.3, 2.0, 0.1);
    let half = Law::sine(0.3, 2.0, 0.1) / 2.0;
    for x in [-1.0, 0.0, 0.7] {
        assert_eq!(half.jet(x), law.jet(x).map(|of| 0.5 * of));
    }
}
