//! Where a motion has no derivatives by parameters: beyond singular positions, at kinks and breaks of laws.

use crate::model::error::Result;
use crate::model::no_derivative::NoDerivative;
use crate::solve::motion::{EventKind, Motion};
use crate::system::System;

/// Times this share of the step apart are one time.   \[-\]
const SAME: f64 = 1e-9;

/// An error by name unless the motion is smooth at each of its times, on a branch that it has never left.
pub(super) fn check(system: &System, motion: &Motion, by: &str) -> Result<()> {
    let s = motion.unit_words().time();
    if let Some(found) = motion.singular_positions().first() {
        let t = found.t;
        return Err(NoDerivative::error(
            by,
            format!(
                "the motion meets a singular position at t = {t} {s}, and beyond it another value may take \
                 another branch; ask a motion that ends before it"
            ),
        ));
    }
    for (k, &t) in motion.times().iter().enumerate() {
        kink(motion, t, by)?;
        let (equations, mut broken) = (system.equations(), None);
        let (instant, near) = (equations.instant_at(t, motion.q(k)), SAME * step(motion));
        for block in &equations.blocks {
            block.constraint.laws(&equations.at(block, &instant), &mut |law, f, x| {
                let near = near.max(SAME * x.abs());
                if broken.is_none() && f.breaks(x - near, x + near).iter().any(|found| found.order <= 2) {
                    broken = Some(format!("`{law}` of `{}`", block.name));
                }
            });
        }
        if let Some(law) = broken {
            let reason = format!("at t = {t} {s} the law {law} has a break; ask other times");
            return Err(NoDerivative::error(by, reason));
        }
    }
    Ok(())
}

/// An error by name where the motion has a kink at that time.
pub(super) fn kink(motion: &Motion, t: f64, by: &str) -> Result<()> {
    let (s, near) = (motion.unit_words().time(), SAME * step(motion));
    let mut kinks = motion.events().iter().filter(|event| event.kind == EventKind::Kink);
    let Some(kink) = kinks.find(|kink| (kink.t - t).abs() <= near) else { return Ok(()) };
    Err(NoDerivative::error(by, format!("at t = {t} {s} there is {}; ask other times", kink.text)))
}

/// The longest step of a motion; 1 of one time alone.
fn step(motion: &Motion) -> f64 {
    let steps = motion.times().windows(2).map(|pair| (pair[1] - pair[0]).abs());
    steps.reduce(f64::max).unwrap_or(1.0)
}
