//! The examples of forces against their closed forms, which a changed mass, load or table would
//! miss.

use kin::prelude::*;

use crate::both::Engines;

#[path = "../../examples/25_arm_torque.rs"]
mod arm;
#[path = "../../examples/27_digging.rs"]
mod digging;
#[path = "../../examples/26_engine.rs"]
mod engine;

/// The largest difference of rows, and the largest number.
fn apart<const N: usize>(found: &[[f64; N]], exact: &[[f64; N]]) -> [f64; 2] {
    assert_eq!(found.len(), exact.len());
    let pairs = found.iter().flatten().zip(exact.iter().flatten());
    pairs.fold([0.0, 0.0], |[off, most], (a, b)| {
        let miss = (a - b).abs();
        [if miss > off || miss.is_nan() { miss } else { off }, most.max(b.abs())]
    })
}

#[test]
fn the_arm_has_the_torques_of_lagrange() -> kin::Result<()> {
    let (m, links, solids) = arm::arm()?;
    let system = m.build()?;
    let motion = system.run_both(linspace(0.0, 4.0, 1601))?;
    let forces = system.forces(&motion)?;
    let shoulder = forces.drive("shoulder motor")?;
    let elbow = forces.drive("elbow motor")?;
    let torques = [shoulder.effort(), elbow.effort()];
    let off = arm::off(&motion, links, solids, torques);
    assert!(off < 1e-12, "{off:e} of {}", shoulder.peak());
    let mut wrong = solids;
    wrong[1].mass *= 1.001;
    assert!(arm::off(&motion, links, wrong, torques) > 1e-3);
    Ok(())
}

#[test]
fn the_engine_shakes_and_is_driven_as_by_hand() -> kin::Result<()> {
    let mut shaken = Vec::new();
    for counterweight in [false, true] {
        let engine::Engine { mechanism, solids, .. } = engine::engine(counterweight)?;
        let system = mechanism.build()?;
        let motion = system.run_both(linspace(0.0, 40.0, 1441))?;
        let forces = system.forces(&motion)?;
        let (force, moment) = engine::shaking(&forces)?;
        let effort = forces.drive("turning")?.effort().values().to_vec();
        let by_hand = |solids: [kin::loads::Solid; 3]| -> [Vec<[f64; 2]>; 2] {
            let at = |t: &f64| engine::by_hand(solids, *t);
            let all: Vec<_> = motion.times().iter().map(at).collect();
            let turning = all.iter().map(|(_, moment, torque)| [*moment, *torque]);
            [all.iter().map(|(force, ..)| [force.x, force.y]).collect(), turning.collect()]
        };
        let found = [
            force.iter().map(|f| [f.x, f.y]).collect::<Vec<_>>(),
            moment.iter().zip(&effort).map(|(moment, effort)| [*moment, *effort]).collect(),
        ];
        let mut wrong = solids;
        wrong[1].centre.x += 0.01;
        for ((found, exact), wrong) in found.iter().zip(by_hand(solids)).zip(by_hand(wrong)) {
            let [off, most] = apart(found, &exact);
            assert!(off < 1e-12 * most, "{off:e} of {most}");
            let [off, _] = apart(found, &wrong);
            assert!(
                off > 1e-5 * most,
                "a centre that is off by 0.01 mm shows by {off:e} of {most}"
            );
        }
        shaken.push(force.iter().fold(0.0_f64, |most, f| most.max(f.norm())));
    }
    // The counterweight takes all that turns, and half of the mass that goes up and down.
    assert!(shaken[1] < shaken[0] / 3.0, "{shaken:?}");
    Ok(())
}

#[test]
fn the_cylinders_of_the_excavator_push_as_virtual_power_says() -> kin::Result<()> {
    let digging::Digger { mechanism, bodies, solids } = digging::digger()?;
    let system = mechanism.build()?;
    let motion = system.run_both(linspace(0.0, 9.0, 451))?;
    let forces = system.forces(&motion)?;
    let mut found = vec![[0.0; 3]; motion.len()];
    for (k, name) in digging::CYLINDERS.into_iter().enumerate() {
        let drive = forces.drive(name)?;
        assert_eq!((drive.effort().unit(), drive.power().unit()), ("kN", "kW"));
        found.iter_mut().zip(drive.effort().values()).for_each(|(row, effort)| row[k] = *effort);
    }
    let [off, most] = apart(&found, &digging::by_hand(&motion, bodies, solids)?);
    assert!(off < 1e-12 * most, "{off:e} of {most}");
    let mut wrong = solids;
    wrong[4].mass *= 1.01; // the rod, the lightest of all
    let [off, _] = apart(&found, &digging::by_hand(&motion, bodies, wrong)?);
    assert!(off > 1e-5 * most, "{off:e} of {most}");
    Ok(())
}
