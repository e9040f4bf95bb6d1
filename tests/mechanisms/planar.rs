//! Four-bar, quick return, Scotch yoke, epicyclic gears, cams, rolling.

use kin::prelude::*;

use crate::engines::Engines;
use crate::worst;

const O: Vec2 = Vec2::new(0.0, 0.0);

/// Both assemblies of a crank-rocker against the intersection of two circles, and the rocker's rate
/// against the textbook's formula.
#[test]
fn four_bar_in_both_assemblies() {
    let a = 1.0;
    let b = 3.5;
    let c = 3.0;
    let d = 4.0;
    for (side, preferred) in [(1.0, 100.0), (-1.0, -100.0)] {
        let mut m = Mechanism::new("four-bar");
        let crank = m.link("crank", a).unwrap();
        let coupler = m.link("coupler", b).unwrap();
        let rocker = m.link("rocker", c).unwrap();
        m.add("O", revolute(Ground, crank, O, crank.start())).unwrap();
        m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
        m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
        m.add("C", revolute(Ground, rocker, vec2(d, 0.0), rocker.start())).unwrap();
        m.add("motor", drive_angle(crank, Law::ramp(2.0))).unwrap();
        m.prefer(rocker, deg(preferred));
        let motion = m.build().unwrap().run_both(linspace(0.0, 3.2, 321)).unwrap();
        let pin = motion.point(rocker, rocker.end()).unwrap();
        let theta3 = motion.coordinate(coupler.theta()).unwrap();
        let theta4 = motion.coordinate(rocker.theta()).unwrap();
        let error = worst(&motion, |k, t| {
            let pin_a = vec2((2.0 * t).cos(), (2.0 * t).sin()) * a;
            let to_c = vec2(d, 0.0) - pin_a;
            let along = (b * b - c * c + to_c.norm_squared()) / (2.0 * to_c.norm());
            let u = to_c.normalize();
            (pin.r()[k] - (pin_a + u * along + u.perp() * (side * (b * b - along * along).sqrt())))
                .norm()
        });
        assert!(error < 1e-12, "{side}: {error:e}");
        let error = worst(&motion, |k, t| {
            let theta2 = 2.0 * t;
            let theta3 = theta3.value.values()[k];
            let angle = theta4.value.values()[k];
            theta4.rate.values()[k] - a / c * 2.0 * (theta3 - theta2).sin() / (theta3 - angle).sin()
        });
        assert!(error < 1e-11, "{side}: {error:e}");
    }
}

/// Crank-shaper: the arm's angle is atan2(d + r sin θ, r cos θ), its rate ω (r² + r d sin θ)/(r² +
/// d² + 2 r d sin θ).
#[test]
fn quick_return() {
    let r = 0.1;
    let d = 0.25;
    let omega = 3.0;
    let mut m = Mechanism::new("quick return");
    let crank = m.link_between("crank", O, (r, 0.0)).unwrap();
    let arm = m.link_between("arm", (0.0, -d), (0.25, 0.0)).unwrap();
    m.add("O2", revolute(Ground, crank, O, crank.start())).unwrap();
    m.add("O4", revolute(Ground, arm, vec2(0.0, -d), arm.start())).unwrap();
    m.add("block", pin_in_slot(crank, arm, crank.end(), arm.start(), arm.end())).unwrap();
    m.add("motor", drive_angle(crank, Law::ramp(omega))).unwrap();
    let motion = m.build().unwrap().run_both(linspace(0.0, TAU / omega, 361)).unwrap();
    let angle = motion.coordinate(arm.theta()).unwrap();
    let error = worst(&motion, |k, t| {
        angle.value.values()[k] - (d + r * (omega * t).sin()).atan2(r * (omega * t).cos())
    });
    assert!(error < 1e-13, "{error:e}");
    let error = worst(&motion, |k, t| {
        let sin = (omega * t).sin();
        angle.rate.values()[k] - omega * (r * r + r * d * sin) / (r * r + d * d + 2.0 * r * d * sin)
    });
    assert!(error < 1e-12, "{error:e}");
    // time forth over time back: (π + 2 asin(r/d))/(π − 2 asin(r/d)), told by the turning points
    let forth =
        motion.times().iter().zip(angle.rate.values()).filter(|(_, rate)| **rate > 0.0).count()
            as f64
            / 360.0;
    assert!((forth - (PI + 2.0 * (r / d).asin()) / TAU).abs() < 0.005, "{forth}");
}

#[test]
fn scotch_yoke_is_harmonic() {
    let r = 0.3;
    let omega = 2.0;
    let mut m = Mechanism::new("Scotch yoke");
    let crank = m.link_between("crank", O, (r, 0.0)).unwrap();
    let yoke = m.planar("yoke", pose(r, 0.0, 0.0)).unwrap();
    m.add("O", revolute(Ground, crank, O, crank.start())).unwrap();
    m.add("slot", point_on_line(crank, yoke, crank.end(), O, vec2(0.0, 1.0))).unwrap();
    m.add("guide", prismatic(yoke, Ground, O, O, vec2(0.0, 1.0), 0.0)).unwrap();
    m.add("motor", drive_angle(crank, Law::linear(0.1, omega))).unwrap();
    let motion = m.build().unwrap().run_both(linspace(0.0, 6.0, 601)).unwrap();
    let x = motion.coordinate(yoke.x()).unwrap();
    let phase = |t: f64| 0.1 + omega * t;
    assert!(worst(&motion, |k, t| x.value.values()[k] - r * phase(t).cos()) < 1e-14);
    assert!(worst(&motion, |k, t| x.rate.values()[k] + r * omega * phase(t).sin()) < 1e-13);
    assert!(
        worst(&motion, |k, t| x.second_rate.values()[k] + r * omega * omega * phase(t).cos())
            < 1e-12
    );
}

/// Willis: with the ring held, the arm turns at r_s/(r_s + r_r) of the sun; the planet at the sum
/// of what it rolls and the arm's turn.
#[test]
fn epicyclic_gears_follow_willis() {
    let sun_r = 0.03;
    let planet_r = 0.02;
    let ring_r = sun_r + 2.0 * planet_r;
    let mut m = Mechanism::new("epicyclic");
    let sun = m.planar("sun", pose(0.0, 0.0, 0.0)).unwrap();
    let arm = m.link_between("arm", O, (sun_r + planet_r, 0.0)).unwrap();
    let planet = m.planar("planet", pose(sun_r + planet_r, 0.0, 0.0)).unwrap();
    m.add("sun axle", revolute(Ground, sun, O, O)).unwrap();
    m.add("arm axle", revolute(Ground, arm, O, arm.start())).unwrap();
    m.add("planet axle", revolute(arm, planet, arm.end(), O)).unwrap();
    m.add("sun and planet", gear(sun, planet, arm, sun_r, planet_r, 0.0)).unwrap();
    m.add("planet and ring", internal_gear(planet, Ground, arm, planet_r, ring_r, 0.0)).unwrap();
    m.add("motor", drive_angle(sun, Law::ramp(10.0))).unwrap();
    let motion = m.build().unwrap().run_both(linspace(0.0, 20.0, 401)).unwrap();
    let arm_angle = motion.coordinate(arm.theta()).unwrap().value;
    let planet_angle = motion.coordinate(planet.theta()).unwrap().value;
    let arm_rate = 10.0 * sun_r / (sun_r + ring_r);
    assert!(
        worst(&motion, |k, t| arm_angle.values()[k] - arm_rate * t) < 1e-12,
        "31 turns of the sun, none lost"
    );
    assert!(
        worst(&motion, |k, t| planet_angle.values()[k] - arm_rate * (1.0 - ring_r / planet_r) * t)
            < 1e-12
    );
    // the point of the planet on the ring stands still
    let touching = motion.point(planet, vec2(planet_r, 0.0)).unwrap();
    assert!(touching.v()[0].norm() < 1e-15, "{:?}", touching.v()[0]);
}

/// A wheel on an inclined track: its centre goes r φ along it, the point on the track stands still.
#[test]
fn a_rolling_wheel_keeps_to_its_track() {
    let radius = 0.25;
    let slope = 0.3_f64;
    let along = vec2(slope.cos(), slope.sin());
    let mut m = Mechanism::new("wheel");
    let wheel = m.planar("wheel", pose(0.0, radius, 0.0)).unwrap();
    m.add("track", rolling(wheel, Ground, O, O, along * 3.0, radius, 0.0)).unwrap();
    m.add("motor", drive_angle(wheel, Law::ramp(-4.0))).unwrap();
    let motion = m.build().unwrap().run_both(linspace(0.0, 5.0, 101)).unwrap();
    let centre = motion.point(wheel, O).unwrap();
    assert!(
        worst(&motion, |k, t| (centre.r()[k] - along * (radius * 4.0 * t) - along.perp() * radius)
            .norm())
            < 1e-13
    );
    // the point that touches the track at this time, in the wheel's own frame
    let error = worst(&motion, |k, t| {
        let touch =
            motion.point(wheel, Mat2::rotation(4.0 * t) * (along.perp() * -radius)).unwrap();
        touch.v()[k].norm()
    });
    assert!(error < 1e-13, "{error:e}");
}

/// The lift of a flat-faced follower is the law itself; a roller of radius zero is a knife edge; on
/// a round cam a roller stays at ρ + r.
#[test]
fn cams_lift_as_their_profiles_say() {
    let support = Law::constant(0.05) + Law::sine(0.01, 2.0, 0.4);
    let lift = |contact: &dyn Fn(&mut Mechanism, PlanarBody, PlanarBody)| {
        let mut m = Mechanism::new("cam");
        let cam = m.planar("cam", pose(0.0, 0.0, 0.0)).unwrap();
        let rod = m.planar("rod", pose(0.0, 0.06, 0.0)).unwrap();
        m.add("O", revolute(cam, Ground, O, O)).unwrap();
        m.add("guide", prismatic(rod, Ground, O, O, vec2(1.0, 0.0), 0.0)).unwrap();
        contact(&mut m, cam, rod);
        m.add("motor", drive_angle(cam, Law::ramp(-2.0))).unwrap();
        let motion = m.build().unwrap().run_both(linspace(0.0, 10.0, 1001)).unwrap();
        let y = motion.coordinate(rod.y()).unwrap();
        (y.value.values().to_vec(), y.second_rate.values().to_vec())
    };
    let flat = lift(&|m, cam, rod| {
        m.add("face", cam_flat_face(cam, rod, O, vec2(0.0, 1.0), support.clone())).unwrap();
    });
    let edge = lift(&|m, cam, rod| {
        m.add("edge", cam_knife_edge(cam, rod, O, support.clone())).unwrap();
    });
    let roller = |radius: f64, profile: Law| {
        lift(&move |m, cam, rod| {
            let phi = m.angle("phi", PI / 2.0).unwrap();
            m.add("roller", cam_roller(cam, rod, phi, O, radius, profile.clone())).unwrap();
        })
    };
    let thin = roller(0.0, support.clone());
    let round = roller(0.02, Law::constant(0.05));
    for k in 0..1001 {
        // the follower stands over the cam's angle π/2 + 2 t
        let [h, _, h2, _] = support.jet(PI / 2.0 + 2.0 * 0.01 * k as f64);
        assert!((flat.0[k] - h).abs() < 1e-14 && (flat.1[k] - 4.0 * h2).abs() < 1e-11, "{k}");
        assert!((edge.0[k] - h).abs() < 1e-14 && (edge.1[k] - 4.0 * h2).abs() < 1e-11, "{k}");
        assert!(
            (thin.0[k] - h).abs() < 1e-13 && (thin.1[k] - 4.0 * h2).abs() < 1e-10,
            "{k}: {} {}",
            thin.1[k],
            4.0 * h2
        );
        assert!((round.0[k] - 0.07).abs() < 1e-14 && round.1[k].abs() < 1e-11, "{k}");
    }
}

/// A roller on an eccentric disc: its centre keeps e's distance plus both radii, whatever the
/// profile's formula is.
#[test]
fn a_roller_on_an_eccentric_is_a_rod() {
    let e = 0.02_f64;
    let disc = 0.05_f64;
    let radius = 0.015;
    // the edge of a disc whose centre is at (e, 0): ρ(φ) = e cos φ + √(R² − e² sin² φ)
    #[law]
    fn eccentric(phi: f64, e: f64, disc: f64) -> f64 {
        e * phi.cos() + (disc * disc - e * e * phi.sin() * phi.sin()).sqrt()
    }
    let mut m = Mechanism::new("eccentric");
    let cam = m.planar("cam", pose(0.0, 0.0, 0.0)).unwrap();
    let rod = m.planar("rod", pose(0.0, 0.06, 0.0)).unwrap();
    let phi = m.angle("phi", 1.5).unwrap();
    m.add("O", revolute(cam, Ground, O, O)).unwrap();
    m.add("guide", prismatic(rod, Ground, O, O, vec2(1.0, 0.0), 0.0)).unwrap();
    m.add("roller", cam_roller(cam, rod, phi, O, radius, eccentric(e, disc))).unwrap();
    m.add("motor", drive_angle(cam, Law::ramp(3.0))).unwrap();
    let motion = m.build().unwrap().run_both(linspace(0.0, 4.0, 801)).unwrap();
    let y = motion.coordinate(rod.y()).unwrap();
    let c = |t: f64| (3.0 * t).sin_cos();
    let l = disc + radius;
    assert!(
        worst(&motion, |k, t| y.value.values()[k]
            - (e * c(t).0 + (l * l - (e * c(t).1).powi(2)).sqrt()))
            < 1e-14
    );
    let centre = motion.point(cam, vec2(e, 0.0)).unwrap();
    let pin = motion.point(rod, O).unwrap();
    assert!(worst(&motion, |k, _| (pin.r()[k] - centre.r()[k]).norm() - l) < 1e-14);
    assert!(
        worst(&motion, |k, _| (pin.r()[k] - centre.r()[k]).dot(pin.v()[k] - centre.v()[k])) < 1e-14
    );
    let rates = |k: usize| {
        (pin.r()[k] - centre.r()[k]).dot(pin.a()[k] - centre.a()[k])
            + (pin.v()[k] - centre.v()[k]).norm_squared()
    };
    assert!(worst(&motion, |k, _| rates(k)) < 1e-12);
}

/// A block driven along a slot in a turning disc: Coriolis by the lecture's formula, by a law of
/// time and by a coordinate along the path.
#[test]
fn a_block_in_a_slot_has_its_coriolis_acceleration() {
    let omega = 2.0;
    let speed = 0.3;
    let by_coordinate = |along: bool| {
        let mut m = Mechanism::new("slot");
        let disc = m.planar("disc", pose(0.0, 0.0, 0.0)).unwrap();
        let block = m.planar("block", pose(0.1, 0.0, 0.0)).unwrap();
        m.add("O", revolute(disc, Ground, O, O)).unwrap();
        m.add("upright", drive_angle(block, Law::constant(0.0))).unwrap();
        if along {
            let s = m.length("s", 0.1).unwrap();
            m.add("slot", point_on_path(disc, block, s, Law::ramp(1.0), Law::constant(0.05), O))
                .unwrap();
            m.add("feed", drive(s, Law::linear(0.1, speed))).unwrap();
        } else {
            m.add(
                "slot",
                moving_point(disc, block, Law::linear(0.1, speed), Law::constant(0.05), O),
            )
            .unwrap();
        }
        m.add("motor", drive_angle(disc, Law::ramp(omega))).unwrap();
        let motion = m.build().unwrap().run_both(linspace(0.0, 2.0, 101)).unwrap();
        let block = motion.point(block, O).unwrap();
        worst(&motion, |k, t| {
            let turn = Mat2::rotation(omega * t);
            let u = turn * vec2(0.1 + speed * t, 0.05);
            let v = u.perp() * omega + turn * vec2(speed, 0.0);
            let a = u * (-omega * omega) + (turn * vec2(speed, 0.0)).perp() * (2.0 * omega);
            (block.r()[k] - u).norm() + (block.v()[k] - v).norm() + (block.a()[k] - a).norm()
        })
    };
    assert!(by_coordinate(false) < 1e-12 && by_coordinate(true) < 1e-12);
}
