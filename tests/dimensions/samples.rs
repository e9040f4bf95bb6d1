//! Mechanisms made at random: distributions, clearances, and those that cannot be assembled.

use kin::Coordinate;
use kin::design::{Distribution, Sampling, Tolerance};
use kin::prelude::*;

use crate::engines::Engines;

/// A link that hangs from the origin on another one: its end is at (a, b).
fn square(of: impl Fn(Dimension) -> Dimension) -> (System, [Coordinate; 2]) {
    let mut m = Mechanism::new("square");
    let a = m.dimension("a", 1.0).expect("a");
    let b = m.dimension("b", 2.0).expect("b");
    let a = of(a.tolerance(0.01));
    let b = b.tolerance(0.02);
    let x = m.length("x", 1.0).expect("x");
    let y = m.length("y", 2.0).expect("y");
    m.add("x", drive(x, Law::constant(a))).expect("adds");
    m.add("y", drive(y, Law::constant(b))).expect("adds");
    (m.build().expect("a system"), [x, y])
}

const SAMPLING: Sampling = sampling(4000, Distribution::Normal);

const fn sampling(count: usize, distribution: Distribution) -> Sampling {
    Sampling { count, seed: 11, distribution }
}

/// Means, standard deviations and the farthest sample of each distribution; x is the dimension
/// itself.
#[test]
fn each_distribution_is_the_one_that_it_is_called() {
    for (distribution, sigma, most) in [
        (Distribution::Normal, 1.0 / 3.0, 1.0..1.9),
        (Distribution::TruncatedNormal, (1.0 - 0.026_663_073_f64).sqrt() / 3.0, 0.9..1.0),
        (Distribution::Uniform, 3.0_f64.sqrt().recip(), 0.995..1.0),
    ] {
        let (system, [x, y]) = square(|a| a.distributed(distribution));
        let motion = system.run_both([0.0]).expect("a motion");
        let found = system.samples(&motion, x, 0.0, &SAMPLING).expect("samples");
        assert_eq!((found.values().len(), found.missing(), found.sampling()), (4000, 0, &SAMPLING));
        assert!((found.mean() - 1.0).abs() < 5.0 * 0.01 * sigma / 4000_f64.sqrt());
        assert!((found.sigma() / (0.01 * sigma) - 1.0).abs() < 0.06, "{distribution:?}");
        let off = found.values().iter().map(|x| (x - 1.0).abs() / 0.01).fold(0.0, f64::max);
        assert!(most.contains(&off), "{distribution:?}: {off}");
        // The one that names none has the one that is asked for.
        let other = system
            .samples(&motion, y, 0.0, &sampling(4000, Distribution::Uniform))
            .expect("samples");
        assert!((other.sigma() / 0.02 * 3.0_f64.sqrt() - 1.0).abs() < 0.06);
        let told: Tolerance = system.tolerance(&motion, x).expect("a tolerance");
        assert!((told.sigma() / (0.01 * sigma) - 1.0).abs() < 1e-6);
        assert_eq!(told.contributions[0].distribution, distribution);
    }
}

/// The same seed gives the same bits on any number of threads, another seed others.
#[test]
fn a_seed_gives_the_same_samples() {
    let (system, [x, _]) = square(|a| a);
    let motion = system.run_both([0.0]).expect("a motion");
    let of = |seed: u64| {
        let sampling = Sampling { count: 300, seed, ..Sampling::default() };
        system.samples(&motion, x, 0.0, &sampling).expect("samples").values().to_vec()
    };
    assert!(of(1) == of(1) && of(1) != of(2));
}

/// A rod from the origin to a slider at the height h: x = √(rod² − h²), which has no value where
/// h > rod. With rod = 1 ± 0.02 and h = 0.94 ± 0.1, both uniform, these are E((1 − 0.6 − 0.2
/// u)/2) = 1/5 of all.
#[test]
fn a_fifth_of_a_box_that_cannot_be_assembled_is_told_with_its_share() {
    let mut m = Mechanism::new("reach");
    let rod = m.dimension("rod", 1.0).expect("a dimension").tolerance(0.02);
    let h = m.dimension("h", 0.94).expect("a dimension").tolerance(0.1);
    let rod = m.link("rod", rod).expect("a link");
    let slider = m.planar("slider", pose(0.35, h, 0.0)).expect("a body");
    m.add("O", revolute(rod, Ground, rod.start(), (0.0, 0.0))).expect("adds");
    m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0))).expect("adds");
    m.add("upright", drive_angle(slider, Law::constant(0.0))).expect("adds");
    m.add("height", drive(slider.y(), Law::constant(h))).expect("adds");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0]).expect("a motion");
    let count = 4000;
    let found = system.samples(&motion, slider.x(), 0.0, &sampling(count, Distribution::Uniform));
    let found = found.expect("samples");
    let error = (0.2 * 0.8 / count as f64).sqrt();
    assert!((found.share_missing() - 0.2).abs() < 4.0 * error, "{}", found.share_missing());
    // All of the others are on this side of the toggle.
    assert!(
        found.values().iter().all(|x| *x > 0.0) && found.values().len() + found.missing() == count
    );
    // E(x) of those that can be assembled, by a sum over the box.
    let n = 1000;
    let at = |k: i32| (f64::from(k) + 0.5) / f64::from(n) * 2.0 - 1.0;
    let box_of = (0..n).flat_map(|i| (0..n).map(move |j| (at(i), at(j))));
    let all = box_of.map(|(u, v)| (1.0 + 0.02 * u).powi(2) - (0.94 + 0.1 * v).powi(2));
    let (sum, inside) =
        all.filter(|x| *x >= 0.0).fold((0.0, 0.0), |(sum, n), x| (sum + x.sqrt(), n + 1.0));
    assert!((found.mean() - sum / inside).abs() < 5.0 * found.sigma() / (count as f64).sqrt());
    let told = found.to_string();
    let share = format!("{} samples ({:.1}", found.missing(), 100.0 * found.share_missing());
    assert!(told.contains(&share) && told.ends_with(" %) cannot be assembled."), "{told}");
    // Beyond the toggle the stack has no corner.
    let stack = system.tolerance(&motion, slider.x()).expect("a tolerance");
    assert!(stack.corners.contains(&None), "{stack}");
}

/// A crank whose pin has play: as much as it may be off in every direction, it is off to both
/// sides; the four corners of a square around the disc are none of it.
#[test]
fn the_clearance_of_a_joint_is_one_dimension() {
    let mut m = Mechanism::new("play");
    let gap = m.clearance("gap", 0.01).expect("a clearance");
    let crank = m.link("crank", 0.2).expect("a link");
    m.add("O", revolute(crank, Ground, crank.start(), gap)).expect("adds");
    m.add("motor", drive_angle(crank, Law::constant(0.0))).expect("adds");
    let system = m.build().expect("a system");
    let motion = system.run_both([0.0]).expect("a motion");
    // Along (3, 4)/5 the pin is off by its radius at most.
    let along = |motion: &Motion| Ok(motion.point(crank, (0.1, 0.0))?.along((0.6, 0.8)));
    let found = system.tolerance(&motion, along).expect("a tolerance");
    assert_eq!((found.contributions.len(), found.contributions[0].name.as_str()), (1, "gap"));
    let nominal = 0.2 * 0.6;
    assert!((found.nominal - nominal).abs() < 1e-15 && (found.worst_case() - 0.01).abs() < 1e-14);
    let [low, high] = found.corners.map(|corner| corner.expect("assembled"));
    assert!(
        (low - nominal + 0.01).abs() < 1e-14 && (high - nominal - 0.01).abs() < 1e-14,
        "{low} {high}"
    );
    assert!((found.sigma() - 0.005).abs() < 1e-14); // of a disc r/2
    let samples = system.samples(&motion, along, 0.0, &SAMPLING).expect("samples");
    assert!((samples.sigma() / 0.005 - 1.0).abs() < 0.05, "{samples}");
    let off = samples.values().iter().map(|x| (x - nominal).abs() / 0.01).fold(0.0, f64::max);
    assert!((0.95..1.0).contains(&off), "{off}");
}

#[test]
fn clearances_and_distributions_that_make_no_sense_are_told_by_name() {
    let told = |of: &dyn Fn(&mut Mechanism) -> kin::Result<()>| {
        let mut m = Mechanism::new("odd");
        of(&mut m).and_then(|()| m.build().map(|_| ())).expect_err("an error").to_string()
    };
    let x = |m: &mut Mechanism, number: Dimension| {
        let x = m.length("x", 0.0)?;
        m.add("x", drive(x, Law::constant(number))).map(|_| ())
    };
    let disc = told(&|m| {
        let a = m.dimension("a", 0.0)?.tolerance(0.1).distributed(Distribution::Disc);
        x(m, a)
    });
    assert!(disc.contains("`a`") && disc.contains("m.clearance"), "{disc}");
    let other = told(&|m| {
        let gap = m.clearance("gap", 0.1)?;
        x(m, gap.x.distributed(Distribution::Uniform) + gap.y)
    });
    assert!(
        other.contains("`gap.x`") && other.contains("a uniform distribution in a disc"),
        "{other}"
    );
    let two = told(&|m| {
        let gap = m.clearance("gap", 0.1)?;
        x(m, gap.x.tolerance(0.2) + gap.y)
    });
    assert!(
        two.contains("`gap.x`") && two.contains("Give both dimensions the same tolerance"),
        "{two}"
    );
    let negative = told(&|m| {
        let gap = m.clearance("gap", -0.1)?;
        x(m, gap.x + gap.y)
    });
    assert!(negative.contains("-0.1"), "{negative}");
    let unused = told(&|m| {
        let gap = m.clearance("gap", 0.1)?;
        x(m, gap.x)
    });
    assert!(unused.contains("gap.y"), "{unused}");
    let count = |count: usize| {
        let (system, [x, _]) = square(|a| a);
        let motion = system.run_both([0.0]).expect("a motion");
        system
            .samples(&motion, x, 0.0, &sampling(count, Distribution::Normal))
            .expect_err("none")
            .to_string()
    };
    for many in [0, usize::MAX] {
        let said = count(many);
        assert!(said.contains(&format!("the number of samples is {many}. ")), "{said}");
    }
}
