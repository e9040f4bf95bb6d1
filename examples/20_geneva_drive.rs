//! A Geneva drive with six stations. Lengths in mm, angles in rad, time in s.
//!
//! What to see: the driver goes round evenly; for a third of a turn its pin runs in a slot of the
//! wheel and turns it by 60°, for the rest the wheel is locked by the disc that runs in its hollow
//! side. The pin comes in along the slot, so the wheel starts without a shock, but its acceleration
//! jumps. The constraint is a user's own: one equation with an `if` in it.
//!
//! `cargo run --release --example 20_geneva_drive`

use kin::prelude::*;
use kin_view::{Figure, Outline, Panel, Scene};

const OUT: &str = "out/20_geneva_drive";

/// Geneva drive: where the pin P of the driver is in a slot, s × e / |ū| = 0, s = P as the wheel
/// sees it and e the slot's direction; else the wheel stands at its station.      [–, rad]
///
/// `pin`: ū, P in the driver, on its x-axis; at the driver's angle 0 it is deepest in a slot.
/// `slots`: their number; the wheel's axle is to the right.
#[constraint]
#[require(slots >= 3.0 && slots.fract() == 0.0, "a Geneva wheel has three slots at least, and a whole number of them")]
fn geneva(driver: Planar, wheel: Planar, pin: Vec2, slots: f64) -> f64 {
    let step = TAU / slots;
    let turns = (driver.theta / TAU).round();
    let ahead = driver.theta - TAU * turns;
    let reach = 0.5 * PI - 0.5 * step; // of the driver, to either side of the line of axles
    if ahead.abs() < reach {
        let s = wheel.local(driver.point(pin));
        let slot = PI + step * turns; // against the driver's sense
        s.cross(vec2(slot.cos(), slot.sin())) / pin.norm()
    } else {
        let station = if ahead > 0.0 { turns + 0.5 } else { turns - 0.5 };
        wheel.theta + step * station
    }
}

const SLOTS: usize = 6;
const CRANK: f64 = 40.0; // mm: from the driver's axle to its pin
const PIN: f64 = 5.0; // radius of the pin, and half the width of a slot

fn main() -> kin::Result<()> {
    // 1. Geometry: the pin comes into a slot at a right angle to the crank.
    let half = PI / SLOTS as f64;
    let apart = CRANK / half.sin(); // of the axles
    let outer = apart * half.cos(); // radius of the wheel
    let bottom = apart - CRANK; // of the slots, where the pin is deepest
    let lock = CRANK - 2.0 * PIN; // radius of the locking disc

    // 2. Six equations for six coordinates; a turn of the driver in two seconds, six turns for one
    //    of the wheel.
    let mut m = Mechanism::new("Geneva drive");
    m.units("mm", "s");
    let ground = m.ground();
    let driver = m.planar("driver", pose(0.0, 0.0, PI))?;
    let wheel = m.planar("wheel", pose(apart, 0.0, -half))?;
    let origin = vec2(0.0, 0.0);
    m.add("axle of the driver", revolute(ground, driver, origin, origin))?;
    m.add("axle of the wheel", revolute(ground, wheel, vec2(apart, 0.0), origin))?;
    m.add("pin and slots", geneva(driver, wheel, vec2(CRANK, 0.0), SLOTS as f64))?;
    m.add("motor", drive_angle(driver, Law::linear(PI, PI)))?;

    // 3. Motion: three stations.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 6.0, 1201))?;
    let turn = motion.coordinate(wheel.theta())?;
    println!("{}", motion.summary());
    println!(
        "from station to station {:.4}°",
        (turn.value.values()[0] - turn.value.values()[400]).to_degrees()
    );
    println!(
        "wheel: at most {:.3} rad/s and {:.2} rad/s²",
        -turn.rate.min(),
        turn.second_rate.max()
    );
    motion.add_point("pin", driver, vec2(CRANK, 0.0))?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 4. Pictures: the wheel with slots and hollow sides, the driver with its pin and its locking
    //    disc, which is cut out where the wheel passes. where the disc meets the rim of the wheel
    let open = ((apart * apart + lock * lock - outer * outer) / (2.0 * apart * lock)).acos();
    let passes = (lock * open.sin() / outer).asin();
    let disc = arc(origin, lock, open, TAU - open).chain(arc(
        vec2(apart, 0.0),
        outer,
        PI + passes,
        PI - passes,
    ));
    let edge = (0..SLOTS).flat_map(|k| {
        let slot = 2.0 * half * k as f64;
        let side = 2.0 * half * (k as f64 + 0.5);
        let mouth =
            [-1.0, 1.0].map(|side| direction(slot) * outer + direction(slot).perp() * (side * PIN));
        let round = arc(direction(slot) * bottom, PIN, slot - 0.5 * PI, slot - 1.5 * PI);
        let hollow = arc(direction(side) * apart, lock, side + PI + open, side + PI - open);
        [mouth[0]].into_iter().chain(round).chain([mouth[1]]).chain(hollow)
    });
    let scene = Scene::new(&system)
        .hide_joint("pin and slots")
        .outline(wheel, Outline::polygon(edge))
        .outline(driver, Outline::polygon(disc));
    let crank = [vec2(-0.1 * CRANK, 0.0), vec2(CRANK, 0.0)];
    let scene = scene
        .outline(driver, Outline::line(crank))
        .outline(driver, Outline::disc(crank[1], PIN))
        .trace("pin", driver, crank[1]);
    scene.pose(&motion, 0.9)?.save(format!("{OUT}/pose.svg"))?;
    scene.animated(&motion, 9.0)?.save(format!("{OUT}/animated.svg"))?;
    let panel = |title: &str, label: &str, series: &Series| {
        Panel::over_time(title, label).series("wheel", series)
    };
    let panels = [
        panel("Turn", "angle", &turn.value),
        panel("Angular acceleration", "acceleration", &turn.second_rate),
    ];
    Figure::new(panels).save(format!("{OUT}/wheel.svg"))?;
    scene.page(&motion)?.coordinate("Wheel", &turn).save(format!("{OUT}/index.html"))
}

fn direction(angle: f64) -> Vec2 {
    vec2(angle.cos(), angle.sin())
}

/// Points of an arc, from one angle to the other.
fn arc(centre: Vec2, radius: f64, from: f64, to: f64) -> impl Iterator<Item = Vec2> {
    (0..=32).map(move |k| centre + direction(from + (to - from) * f64::from(k) / 32.0) * radius)
}
