//! Spatial slider-crank, Stewart platform, Bennett's linkage.

use kin::SpatialPose;
use kin::check::any_spatial;
use kin::extend::terms;
use kin::prelude::*;

use crate::engines::Engines;
use crate::worst;

const O: Vec3 = Vec3::new(0.0, 0.0, 0.0);

/// Crank 0.08 m about x at (0, 0.1, 0.12), rod 0.3 m, slider along x, ω = 6 rad/s: at crank up x =
/// 0.2, ẋ = 0.24, ẍ = 1.44; with the rod as an equation and as a body between a ball and a
/// universal joint.
#[test]
fn spatial_slider_crank() {
    let centre = vec3(0.0, 0.1, 0.12);
    let crank_length = 0.08;
    let rod = 0.3;
    let omega = 6.0;
    for rod_is_a_body in [false, true] {
        let mut m = Mechanism::new("spatial slider-crank");
        let crank = m.spatial("crank", SpatialPose::at(centre)).unwrap();
        let slider = m.spatial("slider", SpatialPose::at(vec3(0.2, 0.0, 0.0))).unwrap();
        let pin = vec3(0.0, 0.0, crank_length);
        m.add("bearing", spatial::revolute(crank, Ground, O, centre, Vec3::x(), Vec3::x()))
            .unwrap();
        m.add(
            "guide",
            spatial::prismatic(slider, Ground, O, O, Vec3::x(), EulerParameters::identity()),
        )
        .unwrap();
        if rod_is_a_body {
            let link = m.spatial_link_between("rod", centre + pin, vec3(0.2, 0.0, 0.0)).unwrap();
            assert!((link.length() - rod).abs() < 1e-15);
            m.add("ball", spatial::spherical(crank, link, pin, link.start())).unwrap();
            m.add("cross", spatial::universal(link, slider, link.end(), O, Vec3::y(), Vec3::y()))
                .unwrap();
        } else {
            m.add("rod", spatial::distance(crank, slider, pin, O, rod)).unwrap();
        }
        m.add("motor", spatial::drive_turn(crank, Ground, Vec3::x(), Vec3::x(), Law::ramp(omega)))
            .unwrap();
        // three turns, beginning with the crank up
        let motion = m.build().unwrap().run_both(linspace(0.0, PI, 601)).unwrap();
        let x = motion.coordinate(slider.x()).unwrap();
        let first = [x.value.values()[0], x.rate.values()[0], x.second_rate.values()[0]];
        assert!(
            first.iter().zip([0.2, 0.24, 1.44]).all(|(found, exact)| (found - exact).abs() < 1e-13),
            "{first:?}"
        );
        let error = worst(&motion, |k, t| {
            let (s, c) = (omega * t).sin_cos();
            let a = centre + vec3(0.0, -crank_length * s, crank_length * c);
            x.value.values()[k] - (rod * rod - a.y * a.y - a.z * a.z).sqrt()
        });
        assert!(error < 1e-13, "{error:e}");
    }
}

/// A corner of the platform or of the base of a Stewart platform.
fn corner(k: usize, size: f64, spread: f64) -> Vec3 {
    let angle = TAU * (k / 2) as f64 / 3.0 + if k.is_multiple_of(2) { -spread } else { spread };
    vec3(size * angle.cos(), size * angle.sin(), 0.0)
}

/// Six legs of the lengths that a known pose has: that pose is found; and in motion legs have their
/// lengths and rates.
#[test]
fn stewart_platform_finds_the_pose_of_its_legs() {
    let known = SpatialPose::turned(vec3(0.1, -0.15, 1.1), vec3(1.0, 2.0, -0.5), 0.35);
    let p = |k| corner(k, 0.5, PI / 4.0);
    let u = |k| corner(k, 1.0, PI / 12.0);
    let a = known.p.rotation();
    let lengths: Vec<f64> = (0..6).map(|k| (known.r + a * p(k) - u(k)).norm()).collect();
    let laws: Vec<Law> = (0..6)
        .map(|k| {
            Law::constant(lengths[k]) + Law::sine(0.05, 2.0, k as f64)
                - Law::constant(0.05 * (k as f64).sin())
        })
        .collect();
    let mut m = Mechanism::new("Stewart platform");
    let platform = m.spatial("platform", SpatialPose::at(vec3(0.0, 0.0, 1.0))).unwrap();
    for (k, law) in laws.iter().enumerate() {
        m.add(
            &format!("leg {k}"),
            spatial::drive_distance(platform, Ground, p(k), u(k), law.clone()),
        )
        .unwrap();
    }
    let motion = m.build().unwrap().run_both(linspace(0.0, 3.0, 301)).unwrap();
    let q = motion.q(0);
    let sign = q[3].signum() * known.p.e0.signum();
    let found = [
        q[0] - known.r.x,
        q[1] - known.r.y,
        q[2] - known.r.z,
        sign * q[3] - known.p.e0,
        sign * q[4] - known.p.e1,
        sign * q[5] - known.p.e2,
    ];
    assert!(found.iter().all(|d| d.abs() < 1e-12), "{found:?}");
    for (k, law) in laws.iter().enumerate() {
        let end = motion.point(platform, p(k)).unwrap();
        let error = worst(&motion, |n, t| {
            let d = end.r()[n] - u(k);
            let [l, rate, ..] = law.jet(t);
            (d.norm() - l).abs() + (d.dot(end.v()[n]) / l - rate).abs()
        });
        assert!(error < 1e-12, "leg {k}: {error:e}");
    }
}

/// Bennett's linkage with one of its rods for the coupler: cranks of length b, driven from 1 rad
/// on, and the angle of the other one.
fn bennett([a, b]: [f64; 2], [alpha, _]: [f64; 2]) -> (Mechanism, Coordinate) {
    // ground link of length a and twist α from A to D; cranks of length b and twist β; coupler of
    // length a and twist α
    let z_a = Vec3::z();
    let z_d = vec3(0.0, -alpha.sin(), alpha.cos());
    let d = vec3(a, 0.0, 0.0);
    let mut m = Mechanism::new("Bennett's linkage");
    let crank = m.spatial("crank", SpatialPose::at(O)).unwrap();
    let rocker = m
        .spatial("rocker", SpatialPose::facing(d, Axis::new(Vec3::x(), z_d.cross(Vec3::x()))))
        .unwrap();
    m.add("A", spatial::revolute(crank, Ground, O, O, Vec3::z(), z_a)).unwrap();
    m.add("D", spatial::revolute(rocker, Ground, O, d, Vec3::z(), z_d)).unwrap();
    m.add("coupler", spatial::distance(crank, rocker, vec3(b, 0.0, 0.0), vec3(b, 0.0, 0.0), a))
        .unwrap();
    m.add(
        "motor",
        spatial::drive_turn(
            crank,
            Ground,
            Axis::new(Vec3::z(), Vec3::x()),
            Axis::new(Vec3::z(), Vec3::x()),
            Law::linear(1.0, 1.0),
        ),
    )
    .unwrap();
    let phi = m.angle("phi", 0.0).unwrap();
    m.add(
        "phi",
        spatial::relative_angle(
            rocker,
            Ground,
            phi,
            Axis::new(Vec3::z(), Vec3::x()),
            Axis::new(z_d, Vec3::x()),
        ),
    )
    .unwrap();
    (m, phi)
}

/// Bennett's linkage, a = 1, b = sin β/sin α: of the four rows of the coupler one suffices, and the
/// other three hold by themselves; the angles of both cranks have tan(φ/2) = tan(θ/2) sin((β +
/// α)/2)/sin((β − α)/2).
#[test]
fn bennett_linkage_moves() {
    let alpha = 0.5_f64;
    let beta = 1.1_f64;
    let a = 1.0;
    let b = beta.sin() / alpha.sin();
    let (mut m, phi) = bennett([a, b], [alpha, beta]);
    // the far hinge of a crank: b along x, its axis turned by β about x
    let far = vec3(0.0, -beta.sin(), beta.cos());
    // two assemblies close the distance: Bennett's is the one with this output angle
    let ratio = ((beta + alpha) / 2.0).sin() / ((beta - alpha) / 2.0).sin();
    let exact = |theta: f64| 2.0 * (ratio * (theta / 2.0).tan()).atan();
    m.prefer(phi, exact(1.0));
    let motion = m.build().unwrap().run_both(linspace(0.0, 2.0, 201)).unwrap();
    let angle = motion.coordinate(phi).unwrap().value;
    let error = worst(&motion, |k, t| angle.values()[k] - exact(1.0 + t));
    assert!(error < 1e-12, "{error:e}");
    let link = spatial::revolute_revolute(
        any_spatial(),
        any_spatial(),
        vec3(b, 0.0, 0.0),
        vec3(b, 0.0, 0.0),
        far,
        far,
        a,
        alpha,
    );
    let error = worst(&motion, |k, _| terms(&link, &motion.q(k)[..14], &[], 0.0).c.amax());
    assert!(error < 1e-13, "the coupler's other rows: {error:e}");
    // with another twist they do not hold: the linkage moves because it is Bennett's
    let other = spatial::revolute_revolute(
        any_spatial(),
        any_spatial(),
        vec3(b, 0.0, 0.0),
        vec3(b, 0.0, 0.0),
        far,
        far,
        a,
        alpha + 0.1,
    );
    assert!(terms(&other, &motion.q(100)[..14], &[], 0.0).c.amax() > 1e-2);
}
