//! Finds the times at which a motion has no derivatives by parameters: beyond singular positions,
//! at kinks and at breaks of laws.

use kin_graph::Op;

use crate::numbers::random::Random;
use crate::outcome::error::{Error, Result};
use crate::solve::motion::{EventKind, Motion};
use crate::solve::newton::Outcome;
use crate::system::System;
use crate::system::evaluate::Block;

/// Times closer than this share of the step are equal. \[-\]
const SAME: f64 = 1e-9;

/// A row jumps if its values on both sides of a pose differ by more than this share of its norm.
/// \[-\]
const JUMP: f64 = 1e-5;

/// The number of random directions in which a pose is tested.
const DIRECTIONS: usize = 2;

/// Returns an error, by name, unless the motion is smooth at each of its times, on a branch that it
/// has never left.
pub(super) fn check(system: &System, motion: &Motion, by: &str) -> Result<()> {
    let s = motion.unit_words().time();
    if let Some(found) = motion.singular_positions().first() {
        let t = found.t;
        return Err(Error::no_derivative(
            by,
            format!(
                "the motion passes a singular position at t = {t} {s}, beyond which another value may take another branch. Use a motion that ends before this position"
            ),
        ));
    }
    let beside = Beside::new(system);
    let breaking = breaking(system, motion);
    let has_kinks = motion.events().iter().any(|event| event.kind == EventKind::Kink);
    if !beside.asked && breaking.is_empty() && !has_kinks {
        return Ok(());
    }
    let step = step(motion);
    for (k, &t) in motion.times().iter().enumerate() {
        if has_kinks {
            kink_within(motion, (t, step), by)?;
        }
        beside.check(motion, (k, step), by)?;
        if breaking.is_empty() {
            continue;
        }
        let ends = k == 0 || k + 1 == motion.len();
        let equations = system.equations();
        let mut broken = None;
        let instant = equations.instant_at(t, motion.q(k));
        let near = SAME * step;
        for block in &breaking {
            block.constraint.laws(&equations.at(block, &instant), &mut |law, f, x| {
                let near = near.max(SAME * x.abs());
                // A run may end where a table ends.
                let is_end = |x: f64| {
                    ends && f.is_table() && f.range().is_some_and(|range| range.ends_at(x))
                };
                let breaks = f.breaks(x - near, x + near);
                if broken.is_none()
                    && breaks.iter().any(|found| found.order <= 2 && !is_end(found.x))
                {
                    broken = Some(format!("`{law}` of `{}`", block.name));
                }
            });
        }
        if let Some(law) = broken {
            let reason = format!("at t = {t} {s} the law {law} has a break. Choose other times");
            return Err(Error::no_derivative(by, reason));
        }
    }
    Ok(())
}

/// Returns the constraints with a law that has a break.
fn breaking<'a>(system: &'a System, motion: &Motion) -> Vec<&'a Block> {
    let (equations, Some(t)) = (system.equations(), motion.times().first()) else {
        return Vec::new();
    };
    let instant = equations.instant_at(*t, motion.q(0));
    let breaks = |block: &&Block| {
        let mut found = false;
        let at = equations.at(block, &instant);
        block.constraint.laws(&at, &mut |_, law, _| found |= !law.is_smooth());
        found
    };
    equations.blocks.iter().filter(breaks).collect()
}

/// Returns an error, by name, if the motion has a kink at that time.
pub(super) fn kink(motion: &Motion, t: f64, by: &str) -> Result<()> {
    kink_within(motion, (t, step(motion)), by)
}

/// Returns an error, by name, if the motion has a kink at that time; its longest step is given.
fn kink_within(motion: &Motion, (t, step): (f64, f64), by: &str) -> Result<()> {
    let s = motion.unit_words().time();
    let near = SAME * step.max(t.abs());
    let mut kinks = motion.events().iter().filter(|event| event.kind == EventKind::Kink);
    let Some(kink) = kinks.find(|kink| (kink.t - t).abs() <= near) else { return Ok(()) };
    Err(Error::no_derivative(
        by,
        format!("at t = {t} {s} there is {}. Choose other times", kink.text),
    ))
}

/// Poses near those of a motion, to test equations with switches and jumps.
struct Beside<'a> {
    system: &'a System,
    /// True if some equation contains functions that jump, or switches.
    asked: bool,
}

impl<'a> Beside<'a> {
    fn new(system: &'a System) -> Self {
        let asked = system.equations().blocks.iter().any(|block| {
            let jumps = block.constraint.formula(|table, _, _| {
                let graph = &table.formula().graph;
                let rows = &table.formula().rows;
                graph.reachable(rows).into_iter().any(|node| match graph.op(node) {
                    Op::Call(f, _) => f.facts().can_jump(),
                    Op::Call2(f, ..) => f.facts().jumps,
                    _ => false,
                })
            });
            jumps.unwrap_or(false)
        });
        Beside { system, asked: asked || !system.switching().is_empty() }
    }

    /// Returns an error, by name, if an equation has a kink or a jump at time k of a motion with
    /// the longest step `step`. The test moves a little to both sides of the pose in random
    /// directions. There the equation has a kink if its switches differ, and a jump if its values
    /// differ much.
    fn check(&self, motion: &Motion, (k, step): (usize, f64), by: &str) -> Result<()> {
        if !self.asked {
            return Ok(());
        }
        let system = self.system;
        let t = motion.times()[k];
        let q = motion.q(k);
        let measures = system.model().measure(q, t);
        let near = SAME * step.max(t.abs());
        let mut random = Random::new(1);
        for _ in 0..DIRECTIONS {
            let off: Vec<f64> =
                measures.sizes.iter().map(|size| SAME * size * random.number()).collect();
            let mut beside = Motion::new(system, 2);
            let mut residuals = Vec::new();
            for side in [-1.0, 1.0] {
                let t = t + side * near;
                let q = q.iter().zip(&off).map(|(q, off)| q + side * off);
                let q = q.collect::<Vec<f64>>();
                let still = vec![0.0; off.len()];
                beside.append(
                    t,
                    [&q, &still, &still, &[]],
                    Outcome { iterations: 0, residual: 0.0 },
                    0,
                );
                residuals.push(system.residual(&q, t)?);
            }
            let mut passed = beside.clone();
            system.note_kinks_along(&beside, &mut passed);
            kink(&passed, t, by)?;
            let apart = residuals[0].iter().zip(&residuals[1]).map(|(a, b)| (a - b).abs());
            if let Some(row) =
                apart.zip(&measures.norms).position(|(apart, norm)| apart > JUMP * norm)
            {
                let s = motion.unit_words().time();
                let row = system.equations().equation(row);
                let reason = format!("at t = {t} {s} `{row}` jumps. Choose other times");
                return Err(Error::no_derivative(by, reason));
            }
        }
        Ok(())
    }
}

/// Returns the longest step of a motion, or 1 for a single time.
fn step(motion: &Motion) -> f64 {
    let steps = motion.times().windows(2).map(|pair| (pair[1] - pair[0]).abs());
    steps.reduce(f64::max).unwrap_or(1.0)
}
