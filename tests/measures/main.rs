//! Measures of mechanisms, against closed forms: angular velocities, angles, slides, dead centres,
//! limits, instant centres.

mod changed;
mod coarse;
#[path = "../data/engines.rs"]
mod engines;
mod first_run;
mod happened;
mod ranges;
mod set_since;

use kin::SolverOptions;
use kin::prelude::*;
use kin::results::Quantity;

use crate::engines::Engines;

/// Crank, coupler, rocker, distance of the ground pins: the crank turns all the way round.   [m]
const LINKS: [f64; 4] = [1.0, 3.5, 3.0, 4.0];

struct FourBar {
    system: System,
    crank: Link,
    coupler: Link,
    rocker: Link,
}

/// Its crank at θ = 2π t.
fn crank_rocker() -> FourBar {
    let mut m = Mechanism::new("four-bar");
    let ground = m.ground();
    let [crank, coupler, rocker] = [("crank", 0), ("coupler", 1), ("rocker", 2)]
        .map(|(name, k)| m.link(name, LINKS[k]).expect("a new name"));
    m.add("O", revolute(crank, ground, crank.start(), vec2(0.0, 0.0))).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(rocker, ground, rocker.start(), vec2(LINKS[3], 0.0))).unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(TAU))).unwrap();
    m.prefer(rocker, deg(100.0));
    FourBar { system: m.build().unwrap(), crank, coupler, rocker }
}

fn near(found: f64, exact: f64, tolerance: f64) {
    assert!(
        (found - exact).abs() <= tolerance,
        "{found} instead of {exact}, off by {:.1e}",
        (found - exact).abs()
    );
}

/// The angle at C of a triangle with sides a and b there and c across.
fn corner(a: f64, b: f64, c: f64) -> f64 {
    ((a * a + b * b - c * c) / (2.0 * a * b)).acos()
}

#[test]
fn dead_centres_and_time_ratio_of_a_crank_rocker() {
    let [a, b, c, d] = LINKS;
    // crank and coupler in line: stretched, and folded with the crank pointing away
    let stretched = corner(a + b, d, c);
    let folded = PI + corner(b - a, d, c);
    let ratio = {
        let forth = folded - stretched;
        forth.max(TAU - forth) / forth.min(TAU - forth)
    };
    for steps in [10, 37, 361] {
        let FourBar { system, crank, rocker, .. } = crank_rocker();
        let motion = system.run_both(linspace(0.0, 1.0, steps + 1)).unwrap();
        let swing = system.extremes(&motion, rocker.theta()).unwrap();
        let [first, second] = swing.all() else {
            panic!("two dead centres, not {:?}", swing.all())
        };
        near(first.t, stretched / TAU, 1e-12);
        near(second.t, folded / TAU, 1e-12);
        assert!(!first.is_max && second.is_max);
        near(first.value, PI - corner(c, d, a + b), 1e-12);
        near(second.value, PI - corner(c, d, b - a), 1e-12);
        near(swing.stroke(), corner(c, d, a + b) - corner(c, d, b - a), 1e-12);
        near(swing.time_ratio().unwrap(), ratio, 1e-11);
        near(swing.max().t, folded / TAU, 1e-12);
        // the pose there
        let pose = system.at(&motion, first.t).unwrap();
        near(pose.coordinate(crank.theta()).unwrap().value.values()[0], stretched, 1e-11);
        near(pose.coordinate(rocker.theta()).unwrap().rate.values()[0], 0.0, 1e-10);
        // backwards in time the same
        let back = system.run_both(linspace(1.0, 0.0, steps + 1)).unwrap();
        let swing = system.extremes(&back, "rocker.theta").unwrap();
        assert_eq!(
            swing.all().iter().map(|extreme| extreme.is_max).collect::<Vec<_>>(),
            [true, false]
        );
        near(swing.all()[1].t, stretched / TAU, 1e-12);
    }
}

#[test]
fn transmission_angle_of_a_crank_rocker() {
    let FourBar { system, coupler, rocker, .. } = crank_rocker();
    let motion = system.run_both(linspace(0.0, 1.0, 181)).unwrap();
    let angle = motion.transmission_angle(coupler, rocker).unwrap();
    let [a, b, c, d] = LINKS;
    for (k, t) in motion.times().iter().enumerate() {
        let (sin, cos) = (TAU * t).sin_cos();
        let whole = ((b * b + c * c - a * a - d * d + 2.0 * a * d * cos) / (2.0 * b * c)).acos();
        let rate = TAU * a * d * sin / (b * c * whole.sin());
        near(angle.value.values()[k], whole.min(PI - whole), 1e-12);
        near(angle.rate.values()[k], if whole > 0.5 * PI { -rate } else { rate }, 1e-10);
    }
    // worst where the crank lies along the ground, on either side
    let worst =
        system.extremes(&motion, |m: &Motion| m.transmission_angle(coupler, rocker)).unwrap();
    near(
        worst.min().value,
        [corner(b, c, d - a), corner(b, c, d + a)]
            .map(|whole| whole.min(PI - whole))
            .into_iter()
            .fold(PI, f64::min),
        1e-12,
    );
    assert!(worst.all().iter().any(|extreme| (extreme.t - 0.5).abs() < 1e-11), "{worst:?}");
    assert_eq!(
        (angle.value.name(), angle.rate.name(), angle.second_rate.unit()),
        ("transmission angle", "transmission angle'", "rad/s^2")
    );
}

#[test]
fn transmission_angle_of_a_slider_is_that_against_the_direction_across_its_way() {
    let mut m = Mechanism::new("slider-crank");
    let ground = m.ground();
    let (l2, l3) = (0.1, 0.3);
    let crank = m.link("crank", l2).unwrap();
    let rod = m.link("rod", l3).unwrap();
    let slider = m.planar("slider", pose(0.4, 0.0, 0.0)).unwrap();
    m.add("O", revolute(crank, ground, crank.start(), vec2(0.0, 0.0))).unwrap();
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).unwrap();
    m.add("B", revolute(rod, slider, rod.end(), vec2(0.0, 0.0))).unwrap();
    m.add("guide", prismatic(slider, ground, vec2(0.0, 0.0), vec2(0.1, 0.0), vec2(0.0, 2.0), 0.0))
        .unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(TAU))).unwrap();
    let system = m.build().unwrap();
    let motion = system.run_both(linspace(0.0, 1.0, 73)).unwrap();
    let angle = motion.transmission_angle(rod, (ground, vec2(0.0, 1.0))).unwrap().value;
    let slide = system.measure(&motion, "guide.slide").unwrap();
    let x = motion.coordinate(slider.x()).unwrap();
    for (k, t) in motion.times().iter().enumerate() {
        near(angle.values()[k], 0.5 * PI - (l2 * (TAU * t).sin() / l3).asin().abs(), 1e-12);
        near(slide.value.values()[k], x.value.values()[k] - 0.1, 1e-14);
        near(slide.rate.values()[k], x.rate.values()[k], 1e-13);
        near(slide.second_rate.values()[k], x.second_rate.values()[k], 1e-12);
    }
    let stroke = system.extremes(&motion, "guide.slide").unwrap();
    near(stroke.stroke(), 2.0 * l2, 1e-13);
    near(stroke.time_ratio().unwrap_or(1.0), 1.0, 1e-9);
    assert_eq!(stroke.unit(), "m");
}

#[test]
fn angles_of_joints_count_turns() {
    let FourBar { system, crank, coupler, .. } = crank_rocker();
    let motion =
        system.run_both_with(linspace(0.0, 3.0, 331), &SolverOptions::new().jerk(true)).unwrap();
    let angle = system.measure(&motion, "O.angle").unwrap();
    near(angle.value.max(), 6.0 * PI, 1e-12);
    let relative = motion.relative_angle(crank, coupler).unwrap();
    let at_a = system.measure(&motion, "A.angle").unwrap();
    for k in 0..motion.len() {
        for (a, b) in [
            (&relative.value, &at_a.value),
            (&relative.rate, &at_a.rate),
            (&relative.third_rate, &at_a.third_rate),
        ] {
            near(a.values()[k], b.values()[k], 1e-9);
        }
    }
    // A level that is passed once a turn.
    let passed = system.crossings(&motion, "O.angle", 2.0 * PI + 1.0).unwrap();
    assert!(passed.len() == 1 && passed[0].rises);
    near(passed[0].t, 1.0 + 1.0 / TAU, 1e-13);
    let names = system.measures();
    assert_eq!(names, ["O.angle", "A.angle", "B.angle", "C.angle"]);
}

/// A screw that is turned and a nut that cannot turn; a shaft that turns and slides.
#[test]
fn angle_and_slide_of_spatial_joints() {
    let axis = kin::Axis::along(Vec3::z());
    let zero = vec3(0.0, 0.0, 0.0);
    let law = || Law::linear(0.3, 5.0) + Law::sine(0.2, 3.0, 0.0);
    let mut m = Mechanism::new("screw and shaft");
    let screw = m.spatial("screw", SpatialPose::at(zero)).unwrap();
    let shaft = m.spatial("shaft", SpatialPose::at(vec3(1.0, 0.0, 0.0))).unwrap();
    m.add("thread", spatial::screw(screw, m.ground(), zero, zero, axis, axis, 0.02)).unwrap();
    m.add("motor", spatial::drive_turn(screw, m.ground(), axis, axis, law())).unwrap();
    m.add(
        "bearing",
        spatial::cylindrical(shaft, m.ground(), zero, vec3(1.0, 0.0, 0.0), axis, Vec3::z() * 3.0),
    )
    .unwrap();
    m.add("spin", spatial::drive_turn(shaft, m.ground(), axis, axis, Law::ramp(-4.0))).unwrap();
    m.add(
        "push",
        spatial::drive_slide(
            shaft,
            m.ground(),
            zero,
            vec3(1.0, 0.0, 0.0),
            axis,
            Law::sine(0.1, 1.0, 0.0),
        ),
    )
    .unwrap();
    let system = m.build().unwrap();
    let motion = system.run_both(linspace(0.0, 10.0, 101)).unwrap();
    let measure = |name: &str| system.measure(&motion, name).unwrap();
    let check = |found: &Quantity, exact: &dyn Fn(f64) -> [f64; 3]| {
        for (k, t) in motion.times().iter().enumerate() {
            let found =
                [&found.value, &found.rate, &found.second_rate].map(|series| series.values()[k]);
            found.into_iter().zip(exact(*t)).for_each(|(found, exact)| near(found, exact, 1e-10));
        }
    };
    let turn = |t: f64| {
        let (sin, cos) = (3.0 * t).sin_cos();
        [0.3 + 5.0 * t + 0.2 * sin, 5.0 + 0.6 * cos, -1.8 * sin]
    };
    check(&measure("thread.angle"), &turn);
    check(&measure("thread.slide"), &|t| turn(t).map(|x| 0.02 / TAU * x));
    check(&measure("bearing.angle"), &|t| [-4.0 * t, -4.0, 0.0]);
    check(&measure("bearing.slide"), &|t| [0.1 * t.sin(), 0.1 * t.cos(), -0.1 * t.sin()]);
}

#[test]
fn shafts_of_a_hookes_joint() {
    let beta = deg(35.0);
    let omega = 2.0;
    let zero = vec3(0.0, 0.0, 0.0);
    let x = Vec3::x();
    let y = Vec3::y();
    let z = Vec3::z();
    let along = vec3(beta.cos(), 0.0, beta.sin());
    let mut m = Mechanism::new("Hooke's joint");
    let driving = m.spatial("driving", SpatialPose::at(zero)).unwrap();
    let driven = m.spatial("driven", SpatialPose::turned(zero, -y, beta)).unwrap();
    m.add("bearing", spatial::revolute(driving, m.ground(), zero, zero, x, x)).unwrap();
    m.add("cross", spatial::universal(driving, driven, zero, zero, y, z)).unwrap();
    m.add("direction", spatial::parallel(driven, m.ground(), x, along)).unwrap();
    let axis = kin::Axis::along(x);
    m.add("motor", spatial::drive_turn(driving, m.ground(), axis, axis, Law::ramp(omega))).unwrap();
    let motion = m.build().unwrap().run_both(linspace(0.0, 4.0, 201)).unwrap();
    let rotation = motion.rotation(driven).unwrap();
    let speed = rotation.about(along);
    for (k, t) in motion.times().iter().enumerate() {
        // Norton: ω2 = ω1 cos β / (1 − sin² β cos² θ), θ from where the driving fork lies in the
        // plane of the shafts; here it begins across it
        let (sin, cos) = (omega * t).sin_cos();
        let below = 1.0 - (beta.sin() * sin).powi(2);
        let exact = omega * beta.cos() / below;
        near(speed.values()[k], exact, 1e-11);
        // about its own axis, and nothing across it
        near(rotation.in_body().about(x).values()[k], exact, 1e-11);
        near(rotation.speed().values()[k], exact, 1e-11);
        let alpha =
            2.0 * omega * omega * beta.cos() * beta.sin().powi(2) * sin * cos / below.powi(2);
        near(rotation.alpha()[k].dot(along), alpha, 1e-10);
    }
}

#[test]
fn omega_of_a_precessing_body() {
    let zero = vec3(0.0, 0.0, 0.0);
    let axis = kin::Axis::along(Vec3::z());
    let along = kin::Axis::along(Vec3::x());
    let mut m = Mechanism::new("top");
    let table = m.spatial("table", SpatialPose::at(zero)).unwrap();
    let top = m.spatial("top", SpatialPose::at(zero)).unwrap();
    m.add("O", spatial::revolute(table, m.ground(), zero, zero, axis, Vec3::z())).unwrap();
    m.add("A", spatial::revolute(top, table, zero, zero, along, Vec3::x())).unwrap();
    // precession φ = 0.7 t + 0.1 t², spin ψ = 9 t + 0.2 sin 2 t
    m.add(
        "precession",
        spatial::drive_turn(table, m.ground(), axis, axis, Law::polynomial(&[0.0, 0.7, 0.1])),
    )
    .unwrap();
    m.add(
        "spin",
        spatial::drive_turn(top, table, along, along, Law::ramp(9.0) + Law::sine(0.2, 2.0, 0.0)),
    )
    .unwrap();
    let mut motion = m
        .build()
        .unwrap()
        .run_both_with(linspace(0.0, 5.0, 251), &SolverOptions::new().jerk(true))
        .unwrap();
    let rotation = motion.rotation(top).unwrap();
    for (k, &t) in motion.times().iter().enumerate() {
        let phi = 0.7 * t + 0.1 * t * t;
        let w = 0.7 + 0.2 * t;
        let w1 = 0.2;
        let [s, s1, s2] =
            [9.0 + 0.4 * (2.0 * t).cos(), -0.8 * (2.0 * t).sin(), -1.6 * (2.0 * t).cos()];
        // h, the axis of spin, and h across it in the plane of the table: h' = φ' across, across' =
        // −φ' h
        let h = vec3(phi.cos(), phi.sin(), 0.0);
        let across = vec3(-phi.sin(), phi.cos(), 0.0);
        let omega = Vec3::z() * w + h * s;
        let alpha = Vec3::z() * w1 + h * s1 + across * (s * w);
        let rate = h * (s2 - s * w * w) + across * (2.0 * s1 * w + s * w1);
        assert!(
            (rotation.omega()[k] - omega).norm() < 1e-10,
            "{:?} {omega:?}",
            rotation.omega()[k]
        );
        assert!((rotation.alpha()[k] - alpha).norm() < 1e-9, "{:?} {alpha:?}", rotation.alpha()[k]);
        assert!(
            (rotation.alpha_rate()[k] - rate).norm() < 1e-8,
            "{:?} {rate:?}",
            rotation.alpha_rate()[k]
        );
        near(rotation.in_body().omega()[k].x, s, 1e-10);
    }
    motion.add_rotation("top", top).unwrap();
    assert_eq!(motion.outputs()[3].name(), "top.alpha_x");
    assert!(
        motion
            .rotation(kin::check::any_spatial())
            .unwrap_err()
            .to_string()
            .contains("`body` does not belong to \"top\"")
    );
}

#[test]
fn instant_centre_of_a_coupler_is_where_crank_and_rocker_meet() {
    let FourBar { system, crank, coupler, rocker } = crank_rocker();
    let motion = system.run_both(linspace(0.0, 1.0, 91)).unwrap();
    let centres = motion.instant_centre(coupler, system_ground()).unwrap();
    let pins =
        [motion.point(crank, crank.end()).unwrap(), motion.point(rocker, rocker.end()).unwrap()];
    let c = vec2(LINKS[3], 0.0);
    for (k, centre) in centres.iter().enumerate() {
        let a = pins[0].r()[k];
        let b = pins[1].r()[k];
        let Some(p) = centre else { panic!("it turns at time {k}") };
        // on both lines
        let size = 1.0 + p.norm();
        near(a.cross(*p) / size, 0.0, 1e-9);
        near((b - c).cross(*p - c) / size, 0.0, 1e-9);
    }
    // the pin is the centre of its own two bodies
    for (p, a) in motion.instant_centre(crank, coupler).unwrap().iter().zip(pins[0].r()) {
        assert!((p.unwrap() - *a).norm() < 1e-10);
    }
}

/// The ground, without a mechanism at hand.
fn system_ground() -> PlanarBody {
    Mechanism::new("any").ground().into()
}

#[test]
fn a_body_that_only_slides_has_no_instant_centre() {
    let mut m = Mechanism::new("slider");
    let slider = m.planar("slider", pose(0.1, 0.0, 0.0)).unwrap();
    m.add(
        "guide",
        prismatic(slider, m.ground(), vec2(0.0, 0.0), vec2(0.0, 0.0), vec2(0.0, 1.0), 0.0),
    )
    .unwrap();
    m.add("motor", drive(slider.x(), Law::sine(0.3, 1.0, 0.0))).unwrap();
    let motion = m.build().unwrap().run_both(linspace(0.0, 1.0, 5)).unwrap();
    assert_eq!(motion.instant_centre(slider, system_ground()).unwrap(), [None; 5]);
}
