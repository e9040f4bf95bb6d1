//! Dry friction against closed forms, and what jams.

use kin::loads::Friction;
use kin::prelude::*;
use kin::{Error, Load, Mechanism};

use crate::both::Engines;

pub const X: Vec3 = Vec3::new(1.0, 0.0, 0.0);
const Z: Vec3 = Vec3::new(0.0, 0.0, 1.0);
pub const O: Vec2 = Vec2::new(0.0, 0.0);

fn near(found: f64, due: f64, what: &str) {
    assert!((found - due).abs() <= 1e-11 * (1.0 + due.abs()), "{what}: {found} instead of {due}");
}

/// A drum on a shaft, pulled by its weight and a belt: the torque μ r F tanh(ω/ω₀).
#[test]
fn a_journal_bearing_takes_the_radius_of_its_friction_circle() {
    let mu = 0.13;
    let r = 0.02;
    let pull = vec2(80.0, -30.0);
    for (rate, share) in [(1e-3, 1.0), (5.0, 1.0_f64.tanh()), (50.0, 0.1_f64.tanh())] {
        let mut m = Mechanism::new("drum");
        let drum = m.planar("drum", pose(0.0, 0.0, 0.0)).expect("a body");
        m.add("shaft", revolute(drum, m.ground(), O, O)).expect("a joint");
        m.friction("shaft", Friction::pin(mu, r, rate)).expect("friction");
        m.add("motor", drive_angle(drum, Law::ramp(5.0))).expect("a driver");
        m.mass(drum, 30.0, O, 0.6).expect("a mass");
        m.gravity(vec2(0.0, -9.81));
        m.load("belt", Load::force(drum, O, pull)).expect("a load");
        let ground = PlanarBody::from(m.ground());
        let system = m.build().expect("a system");
        let motion = system.run_both([0.0, 0.7]).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        let due = share * mu * r * pull.x.hypot(30.0 * 9.81 + 30.0);
        near(forces.drive("motor").expect("a driver").effort().max(), due, "effort");
        let friction = forces.friction("shaft").expect("friction");
        near(
            friction.on(drum).expect("its body").torque().expect("unique")[1],
            -due,
            "on the drum",
        );
        near(
            friction.on(ground).expect("its body").torque().expect("unique")[1],
            due,
            "on the ground",
        );
        near(friction.power().min(), -5.0 * due, "loss");
        near(forces.balance().friction.min(), -5.0 * due, "loss in the balance");
        assert!(forces.balance().worst() < 1e-14, "{}", forces.balance());
        assert!(forces.balance().to_string().contains("drives + loads + friction −"));
        // The shaft shakes the ground with the friction too: all moments there are the driver's
        // opposite.
        let shaking = forces.on_ground().on(ground).expect("the ground");
        near(shaking.torque().expect("unique")[1], 0.0, "shaking moment");
    }
}

/// A block that is drawn up an incline, faster and faster.
#[test]
fn a_block_on_an_incline() {
    let mu = 0.3;
    let beta = 0.4_f64;
    let mass = 7.0;
    let acceleration = 1.6;
    let (m, _) = inclined(mu, beta, mass, Law::polynomial(&[0.0, 1.0, 0.5 * acceleration]));
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 2.0, 21)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let due = mass * (9.81 * (beta.sin() + mu * beta.cos()) + acceleration);
    let drive = forces.drive("winch").expect("a driver");
    drive.effort().values().iter().for_each(|effort| near(*effort, due, "effort"));
    for (lost, t) in forces.balance().friction.values().iter().zip(motion.times()) {
        near(*lost, -mu * mass * 9.81 * beta.cos() * (1.0 + acceleration * t), "loss");
    }
    assert!(forces.balance().worst() < 1e-13);
    // Downwards friction is the other way.
    let (m, _) = inclined(mu, beta, mass, Law::ramp(-1.0));
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 1.0]).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let due = mass * 9.81 * (beta.sin() - mu * beta.cos());
    near(forces.drive("winch").expect("a driver").effort().values()[1], due, "downwards");
    // At rest it holds nothing.
    let (m, _) = inclined(mu, beta, mass, Law::constant(0.0));
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 1.0]).expect("a motion");
    let effort =
        system.forces(&motion).expect("forces").drive("winch").expect("a driver").effort().max();
    near(effort, mass * 9.81 * beta.sin(), "at rest");
}

pub fn inclined(mu: f64, beta: f64, mass: f64, law: Law) -> (Mechanism, PlanarBody) {
    let mut m = Mechanism::new("incline");
    let block = m.planar("block", pose(0.0, 0.0, beta)).expect("a body");
    let ground = PlanarBody::from(m.ground());
    m.add("incline", prismatic(block, ground, O, O, vec2(0.0, 2.0), beta)).expect("a joint");
    m.friction("incline", Friction::slide(mu, [0.4, 0.0], 1e-3)).expect("friction");
    let way = vec2(beta.cos(), beta.sin());
    m.add("winch", drive_slide(block, ground, O, O, way, law)).expect("a driver");
    m.mass(block, mass, O, 0.1).expect("a mass");
    m.gravity(vec2(0.0, -9.81));
    (m, block)
}

/// A slider-crank whose rod weighs nothing: the force in it touches the friction circles of both of
/// its pins.
#[test]
fn a_slider_crank_with_friction_in_pins_and_guide() {
    for [mu, mu_g] in [[0.2, 0.15], [0.6, 0.5], [0.1, 1.2]] {
        one_slider_crank(mu, mu_g);
    }
}

fn one_slider_crank(mu: f64, mu_g: f64) {
    let a = 0.1;
    let l = 0.27;
    let mass = 3.0;
    let load = 400.0;
    let r = 0.015;
    let guide = 0.08;
    let rho = mu * r;
    let mut m = Mechanism::new("slider-crank");
    let ground = PlanarBody::from(m.ground());
    let crank = m.link("crank", a).expect("a link");
    let rod = m.link("rod", l).expect("a link");
    let piston = m.planar("piston", pose(0.35, 0.0, 0.0)).expect("a body");
    m.add("O", revolute(crank, ground, crank.start(), O)).expect("a joint");
    m.add("A", revolute(rod, crank, rod.start(), crank.end())).expect("a joint");
    m.add("B", revolute(rod, piston, rod.end(), O)).expect("a joint");
    m.add("guide", prismatic(piston, ground, O, O, vec2(0.0, 1.0), 0.0)).expect("a joint");
    m.add("motor", drive_angle(crank, Law::linear(0.3, 7.0))).expect("a driver");
    for pin in ["O", "A", "B"] {
        m.friction(pin, Friction::pin(mu, r, 1e-6)).expect("friction");
    }
    m.friction("guide", Friction::slide(mu_g, [guide, 0.0], 1e-6)).expect("friction");
    m.mass(piston, mass, O, 0.01).expect("a mass");
    m.load("work", Load::force(piston, O, vec2(-load, 0.0))).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both(linspace(0.0, 0.9, 60)).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    let effort = forces.drive("motor").expect("a driver").effort().values().to_vec();
    let [x, turn] =
        [motion.coordinate(piston.x()), motion.coordinate(rod.theta())].map(|c| c.expect("known"));
    let mut largest = 0.0_f64;
    for (k, t) in motion.times().iter().enumerate() {
        let theta = 0.3 + 7.0 * t;
        let phi = turn.value.values()[k];
        let w = turn.rate.values()[k];
        let v = x.rate.values()[k];
        if (w.abs() < 1e-4) || (v.abs() < 1e-4) || (w - 7.0).abs() < 1e-4 {
            continue;
        }
        // Thrust of the rod on the piston: S (cos(φ + δ), sin(φ + δ)), with friction torques ∓
        // ρ |S| at A and B on the rod, against its turn in crank and piston: S l sin δ = torque of
        // both.
        let due = |sign: f64| {
            let turning = -rho * ((w - 7.0).signum() + w.signum());
            // The rod holds −S at B and S at A: l × (−S) + torques = 0.
            let delta = (sign * turning / l).asin();
            let fx = (phi + delta).cos();
            let fy = (phi + delta).sin();
            // On the piston: the guide holds −S fy, and the torque of the pin, ρ |S| against its
            // own turn.
            let moment = sign * rho * w.signum();
            let ends = (0.5 * fy + moment / guide).abs() + (0.5 * fy - moment / guide).abs();
            let s =
                (load + mass * x.second_rate.values()[k]) / (fx - sign * mu_g * v.signum() * ends);
            // The crank turns against the thrust at A, and the friction of A and O.
            let at_a = vec2(a * theta.cos(), a * theta.sin()).cross(vec2(fx, fy) * s);
            (s, at_a + rho * s.abs() * (7.0 - w).signum() + rho * s.abs())
        };
        let pushed = due(1.0);
        let (_, torque) = if pushed.0 > 0.0 { pushed } else { due(-1.0) };
        largest = largest.max(torque.abs());
        assert!(
            (effort[k] - torque).abs() < 1e-10 * (1.0 + torque.abs()),
            "{t}: {} {torque}",
            effort[k]
        );
    }
    assert!(largest > 30.0);
    assert!(forces.balance().worst() < 1e-13, "{}", forces.balance());
    assert!(forces.balance().friction.max() <= 0.0);
}

/// A block is pushed along its guide by a rod that leans more and more, α = α₀ + w t, with its pin
/// `off` behind the middle of the guide.
pub fn pushed(mu: f64, guide: [f64; 2], off: f64, lean: [f64; 2]) -> Mechanism {
    let rod = 0.5;
    let [lean, w] = lean;
    let mut m = Mechanism::new("drawer");
    let ground = PlanarBody::from(m.ground());
    let block = m.planar("block", pose(off, 0.0, 0.0)).expect("a body");
    let at = vec2(-rod * lean.cos(), -rod * lean.sin());
    let hand = m.planar("hand", pose(at.x, at.y, 0.0)).expect("a body");
    m.add("guide", prismatic(block, ground, O, O, vec2(0.0, 1.0), 0.0)).expect("a joint");
    m.friction("guide", Friction::slide(mu, guide, 1e-6)).expect("friction");
    m.add("rod", distance(hand, block, O, vec2(-off, 0.0), rod)).expect("a joint");
    let turned = |phase: f64| Law::sine(-rod, w, lean + phase);
    m.add("hand.x", drive(hand.x(), turned(PI / 2.0) + Law::ramp(0.2))).expect("a driver");
    m.add("hand.y", drive(hand.y(), turned(0.0))).expect("a driver");
    m.add("hand.theta", drive(hand.theta(), Law::constant(0.0))).expect("a driver");
    m.load("work", Load::force(block, O, vec2(-50.0, 0.0))).expect("a load");
    m
}

/// It jams at tan α = L/(2 μ (off − μ b/2)), where the pin is outside of the guide's ends, and at
/// 1/μ otherwise.
#[test]
fn a_block_jams_in_its_guide_from_the_angle_of_the_closed_form() {
    let lean = 0.2;
    let w = 0.5;
    for (mu, [length, width], off) in [
        (0.3_f64, [0.2, 0.0], 0.3_f64),
        (0.3, [0.2, 0.1], 0.3),
        (0.12, [0.05, 0.2], 0.4),
        (0.8, [0.2, 0.0], 0.05),
        (0.5, [0.2, 0.02], 0.0),
    ] {
        let arm = f64::max(0.5, (off - 0.5 * mu * width).abs() / length);
        let jam = (0.5 / (mu * arm)).atan();
        let last = (jam - lean) / w;
        let system = pushed(mu, [length, width], off, [lean, w]).build().expect("a system");
        let up_to = |t: f64| system.run_both(linspace(0.0, t, 8)).expect("a motion");
        let before = up_to(last - 1e-8);
        let forces = system.forces(&before).expect("it still moves");
        let thrust = forces.reaction("rod").expect("a joint");
        let block = before.motion_of_block(&system);
        let size = thrust.on(block).expect("its body").magnitude().expect("unique");
        for (t, size) in before.times().iter().zip(size.values()) {
            let alpha: f64 = lean + w * t;
            let due = 50.0 / (alpha.cos() - 2.0 * mu * arm * alpha.sin());
            assert!((size - due).abs() < 1e-7 * due * due / 50.0, "{mu} at {alpha}: {size} {due}");
        }
        assert!(size.max() > 1e8, "{}", size.max());
        let after = up_to(last + 1e-8);
        let Err(Error::Jammed(jammed)) = system.forces(&after).map(|_| ()) else {
            panic!("it moves")
        };
        assert_eq!((jammed.constraint.as_str(), jammed.t), ("guide", last + 1e-8));
        assert!(jammed.share < 1.0 && jammed.share > 1.0 - 1e-6, "{}", jammed.share);
        // Further on less friction would do: the share with which the closed form jams.
        let lean_there = f64::min(jam + 0.2, 1.5);
        let beyond =
            system.run_both(linspace(last + 0.01, (lean_there - lean) / w, 3)).expect("a motion");
        let Err(Error::Jammed(jammed)) = system.forces(&beyond).map(|_| ()) else {
            panic!("it moves")
        };
        assert_eq!(jammed.t, last + 0.01);
        let told = jammed.to_string();
        assert!(
            told.contains("already requires infinite")
                && told.contains("`guide`")
                && told.contains("`hand.x`"),
            "{told}"
        );
    }
}

trait Block {
    fn motion_of_block(&self, system: &System) -> PlanarBody;
}

impl Block for Motion {
    fn motion_of_block(&self, system: &System) -> PlanarBody {
        let found =
            system.bodies().into_iter().find(|(name, _)| *name == "block").expect("a body").1;
        match found {
            kin::extend::Target::Planar(body) => body,
            _ => panic!("it is planar"),
        }
    }
}

/// A crank that is pushed round by a rod without mass, against a torque: it jams where the rod's
/// line touches the friction circle of its bearing.
#[test]
fn a_crank_jams_near_its_dead_centre_by_its_friction_circle() {
    let a = 0.1;
    let l = 0.3;
    let mu = 0.25;
    let r = 0.03;
    let mut m = Mechanism::new("treadle");
    let ground = PlanarBody::from(m.ground());
    let crank = m.link("crank", a).expect("a link");
    let treadle = m.planar("treadle", pose(0.3, 0.0, 0.0)).expect("a body");
    m.add("O", revolute(crank, ground, crank.start(), O)).expect("a joint");
    m.friction("O", Friction::pin(mu, r, 1e-6)).expect("friction");
    m.add("rod", distance(crank, treadle, crank.end(), O, l)).expect("a joint");
    m.add("guide", prismatic(treadle, ground, O, O, vec2(0.0, 1.0), 0.0)).expect("a joint");
    // Down to the dead centre at l − a.
    let from = 0.32;
    let speed = 0.1;
    m.add("foot", drive(treadle.x(), Law::linear(from, -speed))).expect("a driver");
    m.load("work", Load::torque(crank, -6.0)).expect("a load");
    m.prefer(crank, deg(80.0));
    // At x the crank stands at cos θ = (a² + x² − l²)/(2 a x), and the rod passes O at p = a x sin
    // θ / l.
    let lever = |x: f64| {
        let cos = (a * a + x * x - l * l) / (2.0 * a * x);
        a * x * (1.0 - cos * cos).sqrt() / l
    };
    let mut far = 0.3;
    let mut close = l - a + 1e-9;
    for _ in 0..100 {
        let middle = 0.5 * (far + close);
        if lever(middle) > mu * r { far = middle } else { close = middle }
    }
    let last = (from - far) / speed;
    let system = m.build().expect("a system");
    let before = system.run_both(linspace(0.0, last - 1e-8, 30)).expect("a motion");
    let forces = system.forces(&before).expect("it still moves");
    let push = forces.drive("foot").expect("a driver");
    for (k, t) in before.times().iter().enumerate() {
        let x = from - speed * t;
        let thrust = 6.0 / (lever(x) - mu * r);
        // Along the guide: the rod's own way.
        let due = -thrust * (x * x + l * l - a * a) / (2.0 * x * l);
        let found = push.effort().values()[k];
        assert!((found - due).abs() < 1e-8 * (1.0 + due * due), "{x}: {found} {due}");
    }
    let after = system.run_both(linspace(0.0, last + 1e-8, 30)).expect("a motion");
    let Err(Error::Jammed(jammed)) = system.forces(&after).map(|_| ()) else { panic!("it moves") };
    assert_eq!(
        (jammed.constraint.as_str(), jammed.drives.as_slice()),
        ("O", &["foot".to_string()][..])
    );
    assert_eq!(jammed.t, last + 1e-8);
}

/// In space: a hinge bent by a weight out of its middle, a carriage that is twisted.
#[test]
fn a_long_bearing_and_a_twisted_carriage_in_space() {
    let mu = 0.2;
    let r = 0.03;
    let length = 0.12;
    let g = 9.81;
    let mass = 5.0;
    for (bearing, due) in [
        // The radial force alone, or forces at both ends: F/2 ± M/L with M = m g d.
        (0.0, mu * r * mass * g),
        (length, mu * r * 2.0 * mass * g * 0.4 / length),
    ] {
        let mut m = Mechanism::new("fan");
        let o = vec3(0.0, 0.0, 0.0);
        let fan = m.spatial("fan", SpatialPose::at(o)).expect("a body");
        m.add("hub", spatial::revolute(m.ground(), fan, o, o, X, X)).expect("a joint");
        m.friction("hub", Friction::pin(mu, r, 1e-6).length(bearing)).expect("friction");
        m.add("motor", spatial::drive_turn(fan, m.ground(), X, X, Law::ramp(9.0)))
            .expect("a driver");
        let inertia = [[0.2, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.2]];
        m.mass(fan, mass, vec3(0.4, 0.0, 0.0), inertia).expect("a mass");
        m.gravity(vec3(0.0, 0.0, -g));
        let system = m.build().expect("a system");
        let motion = system.run_both([0.0, 0.3]).expect("a motion");
        let forces = system.forces(&motion).expect("forces");
        near(forces.drive("motor").expect("a driver").effort().values()[1], due, "motor");
        assert!(forces.balance().worst() < 1e-13);
    }
    // A push off the line of a slide, with a twist about it: 2 |M|/L + 2 |T|/b.
    let width = 0.05;
    let push = vec3(0.0, 40.0, 30.0);
    let twist = 3.0;
    let mut m = Mechanism::new("carriage");
    let o = vec3(0.0, 0.0, 0.0);
    let carriage = m.spatial("carriage", SpatialPose::at(o)).expect("a body");
    let own = EulerParameters::new(1.0, 0.0, 0.0, 0.0);
    m.add("rail", spatial::prismatic(carriage, m.ground(), o, o, X, own)).expect("a joint");
    m.friction("rail", Friction::slide(mu, [length, width], 1e-6)).expect("friction");
    m.add("winch", spatial::drive_slide(carriage, m.ground(), o, o, X, Law::ramp(0.7)))
        .expect("a driver");
    let load =
        Load::force(carriage, vec3(0.3, 0.0, 0.0), push).and(Load::torque(carriage, X * twist));
    m.load("work", load).expect("a load");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 0.3]).expect("a motion");
    let forces = system.forces(&motion).expect("forces");
    // N = −push; the moment about the middle is the load's, 0.3 push, and what friction has off the
    // line.
    let arm = 0.3 + 0.5 * mu * width;
    let due = mu * (2.0 * push.norm() * arm / length + 2.0 * twist / width);
    near(forces.drive("winch").expect("a driver").effort().values()[1], due, "winch");
    assert!(forces.balance().worst() < 1e-13, "{}", forces.balance());
}

#[test]
fn friction_of_a_force_that_is_not_unique_is_refused_by_name() {
    let mut m = Mechanism::new("door");
    let door = m.spatial("door", SpatialPose::at(vec3(0.5, 0.0, 1.0))).expect("a body");
    for (name, height) in [("hinge 1", 0.3), ("hinge 2", 1.7)] {
        let u = vec3(-0.5, 0.0, height - 1.0);
        let p = vec3(0.0, 0.0, height);
        m.add(name, spatial::revolute(door, m.ground(), u, p, Z, Z)).expect("a hinge");
    }
    m.add("hand", spatial::drive_turn(door, m.ground(), Z, Z, Law::ramp(0.5))).expect("a driver");
    let inertia = [[8.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, 2.0]];
    m.mass(door, 20.0, vec3(0.0, 0.0, 0.0), inertia).expect("a mass");
    m.gravity(vec3(0.0, 0.0, -9.81));
    m.friction("hinge 2", Friction::pin(0.1, 0.01, 1e-3)).expect("friction");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0, 0.5]).expect("a motion");
    let told = system.forces(&motion).map(|_| ()).unwrap_err().to_string();
    assert!(
        told.starts_with(
            "`hinge 2`: the force that causes its friction is not unique. The constraints `hinge 1` and `hinge 2`"
        ),
        "{told}"
    );
}
