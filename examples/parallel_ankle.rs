//! A parallel ankle with two motors. Lengths in m, angles in rad, masses in kg.
//!
//! What to see: a controller gives pitch and roll of the foot. The map answers with the angles of
//! both motors, the velocities and the torques, and draws the limits of the motors as limits of the
//! foot. The same mechanism answers the other way round.
//!
//! `cargo run --release --example parallel_ankle`

use kin::prelude::*;

const OUT: &str = "out/parallel_ankle";

const ARM: f64 = 0.04; // m: from the axis of a crank to its ball
const ROD: f64 = 0.15;
const AXIS: [f64; 2] = [-0.01, 0.15]; // x and z of the cranks' axes, from the ankle
const HEEL: [f64; 2] = [0.05, 0.03]; // from the ankle to the balls on the foot: back and sideways

fn main() -> kin::Result<()> {
    // 1. The foot turns about a cross: a pitch about y, then a roll about x. Behind the shank two
    //    cranks with axes along y move the heel by rods between ball joints.
    let mut m = Mechanism::new("parallel ankle");
    let zero = vec3(0.0, 0.0, 0.0);
    let cross = m.spatial("cross", SpatialPose::at(zero))?;
    let foot = m.spatial("foot", SpatialPose::at(zero))?;
    m.add("pitch", spatial::revolute(cross, Ground, zero, zero, Vec3::y(), Vec3::y()))?;
    m.add("roll", spatial::revolute(foot, cross, zero, zero, Vec3::x(), Vec3::x()))?;
    for (name, side) in [("left", HEEL[1]), ("right", -HEEL[1])] {
        let axis = vec3(AXIS[0], side, AXIS[1]);
        let crank = m.spatial(&format!("{name} crank"), SpatialPose::at(axis))?;
        let joint = spatial::revolute(crank, Ground, zero, axis, Vec3::y(), Vec3::y());
        m.add(&format!("{name} axis"), joint)?;
        let heel = vec3(-HEEL[0], side, 0.0);
        let rod = spatial::distance(crank, foot, vec3(-ARM, 0.0, 0.0), heel, ROD);
        m.add(&format!("{name} rod"), rod)?;
        let motor = spatial::drive_turn(crank, Ground, Vec3::y(), Vec3::y(), Law::constant(0.0));
        m.add(&format!("{name} motor"), motor)?;
    }
    let inertia = [[0.002, 0.0, 0.0], [0.0, 0.004, 0.0], [0.0, 0.0, 0.005]];
    m.mass(foot, 1.1, vec3(0.03, 0.0, -0.05), inertia)?;
    m.gravity(vec3(0.0, 0.0, -9.81));
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;

    // 2. Where are the motors at this pitch and roll?
    let angles = ["pitch.angle", "roll.angle"];
    let motors = ["left motor", "right motor"];
    let mut map = system.map(angles, motors)?;
    let here = map.to([("pitch.angle", 0.2), ("roll.angle", -0.1)])?;
    for motor in here.wanted() {
        println!("{motor}");
    }

    // 3. Velocities and torques. A torque of 20 N m about the pitch axis needs these of the motors.
    for velocity in here.velocities([("pitch.angle", 2.0)])? {
        println!("{} turns at {:.6} rad/s", velocity.name, velocity.value);
    }
    let there = map.inverse()?.here()?;
    for torque in there.efforts([("pitch.angle", 20.0)])? {
        println!("{} needs {:.6} N m", torque.name, torque.value);
    }

    // 4. The weight of the foot, by masses and gravity.
    let rest: [(&str, [f64; 2]); 0] = [];
    for effort in map.follower().given(motors)?.efforts(rest)? {
        println!("{} holds the foot with {:.6} N m", effort.name, effort.value);
    }

    // 5. The limits of the motors, drawn as limits of the foot.
    let forward = system.map(motors, angles)?;
    let border = forward.border([("left motor", [-0.5, 0.4]), ("right motor", [-0.4, 0.3])], 9)?;
    for corner in border.iter().step_by(9) {
        let [pitch, roll] = [0, 1].map(|k| corner.wanted()[k].value.to_degrees());
        println!("corner at pitch {pitch:.3}° and roll {roll:.3}°");
    }
    Ok(())
}
