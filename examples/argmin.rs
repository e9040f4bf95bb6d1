//! The lengths of a machine from what it does, by an optimiser of another crate:
//! `cargo run --release --features argmin --example argmin`. The height of a coupler point has been
//! measured over a turn; which four-bar goes so?
use kin::design::argmin::core::{Executor, State};
use kin::design::argmin::solver::linesearch::MoreThuenteLineSearch;
use kin::design::argmin::solver::quasinewton::LBFGS;
use kin::prelude::*;
use kin::results::Quantity;

/// The four-bar of the drawing, and the height of its coupler point.   [m]
fn four_bar() -> kin::Result<(System, impl Fn(&Motion) -> kin::Result<Quantity>)> {
    let mut m = Mechanism::new("four-bar");
    let a = m.dimension("crank", 0.1)?;
    let b = m.dimension("coupler", 0.27)?;
    let c = m.dimension("rocker", 0.24)?;
    let crank = m.link("crank", a)?;
    let coupler = m.link("coupler", b)?;
    let rocker = m.link("rocker", c)?;
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0)))?;
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
    m.add("C", revolute(rocker, Ground, rocker.start(), (0.3, 0.0)))?;
    m.add("motor", drive_angle(crank, Law::ramp(TAU)))?;
    m.prefer(rocker, 1.4);
    let height = move |motion: &Motion| Ok(motion.point(coupler, (0.0, 0.1))?.along((0.0, 1.0)));
    Ok((m.build()?, height))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    const BUILT: [f64; 3] = [0.104, 0.262, 0.243];
    let times = linspace(0.0, 1.0, 61);
    let (mut built, height) = four_bar()?;
    for (name, length) in ["crank", "coupler", "rocker"].into_iter().zip(BUILT) {
        built.set(name, length)?;
    }
    let measured = built.measure(&built.run(&times)?, height)?.value.values().to_vec();

    // Value and gradient of the mean square, one run and one backward solve each.
    let (drawn, height) = four_bar()?;
    let cost = |y: &Quantity| {
        let off: Vec<f64> =
            y.value.values().iter().zip(&measured).map(|(y, measured)| y - measured).collect();
        let weight = 10.0 / off.len() as f64;
        let value = weight * off.iter().map(|off| off * off).sum::<f64>();
        (value, off.iter().map(|off| [2.0 * weight * off, 0.0, 0.0]).collect())
    };
    let objective = drawn.objective(["crank", "coupler", "rocker"], &times, height, cost)?;
    let start = objective.start();

    let solver = LBFGS::new(MoreThuenteLineSearch::new(), 5).with_tolerance_grad(1e-12)?;
    let found = Executor::new(objective, solver)
        .configure(|state| state.param(start).max_iters(100))
        .run()?;
    let best = found.state().get_best_param().ok_or("no lengths")?;
    println!("crank, coupler, rocker: {best:.6?} m after {} steps", found.state().get_iter());
    assert!(best.iter().zip(BUILT).all(|(found, built)| (found - built).abs() < 1e-6));
    Ok(())
}
