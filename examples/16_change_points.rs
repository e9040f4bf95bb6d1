//! A parallelogram that changes at its dead positions. Lengths in m, angles in rad, time in s.
//!
//! What to see: crank and rocker go round side by side until all four links lie in line; there the
//! mechanism could be either of two. On the page it goes on as an antiparallelogram, the rocker the
//! other way round, and changes back one turn later. Locomotives have a second set of rods at a
//! right angle, so that theirs never can.
//!
//! `cargo run --release --example 16_change_points`

use kin::error::FailureKind;
use kin::prelude::*;
use kin::{Error, Follow, SolverOptions};
use kin_view::{Figure, Panel, Scene};

const OUT: &str = "out/16_change_points";

/// Crank and rocker of 1 m, coupler and ground of 2 m.
fn parallelogram() -> kin::Result<(Mechanism, [Link; 3])> {
    let mut m = Mechanism::new("parallelogram");
    let ground = m.ground();
    let crank = m.link("crank", 1.0)?;
    let coupler = m.link("coupler", 2.0)?;
    let rocker = m.link("rocker", 1.0)?;
    m.add("O", revolute(ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
    m.add("C", revolute(ground, rocker, vec2(2.0, 0.0), rocker.start()))?;
    m.prefer(rocker, deg(60.0));
    Ok((m, [crank, coupler, rocker]))
}

fn main() -> kin::Result<()> {
    // 1. A crank that turns once a second, from 60°: the run passes both flat positions of each
    //    turn and stays what it is.
    let (mut m, [crank, coupler, rocker]) = parallelogram()?;
    m.add("motor", drive_angle(crank, Law::linear(deg(60.0), TAU)))?;
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let times = linspace(0.0, 2.0, 241);
    let smooth = system.run(&times)?;
    smooth.events().iter().for_each(|event| println!("{event}"));
    println!("{}", system.prove(&smooth)?); // not over the flat positions, beyond which there are two motions

    // 2. The same, turned into the other branch at the first flat position and back at the third.
    let options = SolverOptions::new().follow(Follow::OtherBranchAt(vec![0, 2]));
    let mut motion = system.solver().options(options.clone()).run(&times)?;
    for found in motion.singular_positions() {
        let speeds: Vec<f64> = found.branches.iter().map(|branch| branch.qd[8] / TAU).collect();
        println!(
            "t = {:.6} s: the rocker can go on at {speeds:.3?} of the crank's speed; taken: the first",
            found.t
        );
    }
    motion.add_point("A", crank, crank.end())?;
    motion.add_point("B", rocker, rocker.end())?;
    motion.write_csv(format!("{OUT}/motion.csv"))?;
    println!("{}", motion.summary());

    // 3. A press on the crank pushes until crank and strut are in line: a toggle, where the run
    //    ends.
    let (mut short, [crank, ..]) = parallelogram()?;
    let strut = short.link("strut", 1.2)?;
    short.add("D", revolute(crank, strut, crank.end(), strut.start()))?;
    let block = short.planar("block", pose(0.0, 1.5, 0.0))?;
    short.add("E", revolute(strut, block, strut.end(), vec2(0.0, 0.0)))?;
    short.add(
        "guide",
        prismatic(block, Ground, vec2(0.0, 0.0), vec2(0.0, 0.0), vec2(1.0, 0.0), 0.0),
    )?;
    short.add("press", drive(block.y(), Law::linear(1.5, 1.0)))?; // reaches 1 + 1.2 at t = 0.7
    match short.build()?.run(linspace(0.0, 2.0, 21)) {
        Err(Error::Run(failure)) => {
            let FailureKind::Toggle { movable, .. } = &failure.kind else {
                return Err(failure.into());
            };
            let movable = movable.join(", ");
            println!("the press stops at t = {:.12} s with {movable} in line", failure.t);
        }
        run => println!("{:?}", run?),
    }

    // 4. Figures.
    let scene = Scene::new(&system).trace("middle of the coupler", coupler, vec2(0.0, 0.0));
    scene.sequence(&motion, 9)?.save(format!("{OUT}/sequence.svg"))?;
    scene.animated(&motion, 4.0)?.save(format!("{OUT}/animated.svg"))?;
    let angle = motion.coordinate(rocker.theta())?;
    scene.page(&motion)?.coordinate("Rocker", &angle).save(format!("{OUT}/index.html"))?;
    Figure::of_coordinate("Rocker", &angle).save(format!("{OUT}/rocker.svg"))?;
    let near = Panel::log_over_time("How near to a singular position", "smallest singular value");
    Figure::new([near.series("σ", &system.smallest_singular_value(&motion)?)])
        .save(format!("{OUT}/singular.svg"))
}
