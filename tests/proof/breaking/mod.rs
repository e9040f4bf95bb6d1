//! Constructions made to break a proof, with what is true of each in 77 digits: none is proved
//! wrongly, and what is honest is still proved.
//!
//! A construction is a system, a motion of it (run, or forged from poses) and all solutions near it
//! at any time. The proof is held against these: each computed position is as near to one as is
//! said; at many times of a proved step one solution is in the tube, and no second one is where
//! none is said to be; that solution is the same one all along.

mod branches;
mod constants;
mod explicit;
mod forged;
mod scales;
mod seams;

use kin::prelude::*;
use kin::results::{StepProof, Tube};

use crate::engines::Engines;
use crate::wide::{Wide, w};

/// All solutions near the motion at a time, coordinate by coordinate. Those of one number from one
/// time to the next are one continuous motion; a solution that jumps has another number after it.
pub type Solutions = Vec<(usize, Vec<Wide>)>;

/// One construction.
pub struct Case {
    pub name: String,
    /// True if all of it is regular and continuous, by a margin: it ought to be proved.
    pub honest: bool,
    pub system: System,
    pub motion: Motion,
    pub solutions: Box<dyn Fn(&Wide) -> Solutions>,
}

/// At how many times of a step it is looked at.
const TIMES: usize = 16;

impl Case {
    /// True if all of it was proved; a wrong proof is an error.
    fn judge(&self) -> Result<bool, String> {
        let proof = match self.system.prove(&self.motion) {
            Ok(proof) => proof,
            Err(kin::Error::CannotBeProved { .. }) => return Ok(false),
            Err(error) => return Err(format!("{}: {error}", self.name)),
        };
        let wrong = |what: String| format!("{}: {what}\n{proof}", self.name);
        for (k, t) in self.motion.times().iter().enumerate() {
            let Some(error) = proof.error(k) else { continue };
            let near = |(_, solution): &(usize, Vec<Wide>)| {
                within(solution, &wide(self.motion.q(k)), error, 0.0)
            };
            let all = (self.solutions)(&w(*t));
            if !all.iter().any(near) {
                let all: Vec<String> =
                    all.iter().flat_map(|(_, q)| q.iter().map(Wide::show)).collect();
                return Err(wrong(format!(
                    "position {k}, {:?} within {error:?}, is none of {all:?}",
                    self.motion.q(k)
                )));
            }
        }
        for step in proof.steps() {
            if let Ok(tube) = &step.tube {
                self.step(step, tube).and_then(|()| self.continuous(step)).map_err(wrong)?;
            }
        }
        Ok(proof.is_complete())
    }

    fn step(&self, step: &StepProof, tube: &Tube) -> Result<(), String> {
        let mut before: Option<usize> = None;
        for j in 0..=TIMES {
            // all over the step, and thick about its middle and both ends
            let u = match j % 4 {
                0..2 => j as f64 / TIMES as f64,
                2 => 0.5 + 0.5_f64.powi(j as i32) * if j % 8 < 4 { 1.0 } else { -1.0 },
                _ => 0.5_f64.powi(j as i32),
            };
            let (p, rounding) = interpolated(&self.motion, step.step, u);
            let t = w(step.from) + w(u) * (w(step.to) - w(step.from));
            let all = (self.solutions)(&t);
            let inside = |bounds: &[f64], sense: f64| {
                all.iter()
                    .filter(|(_, q)| within(q, &p, bounds, sense * rounding))
                    .collect::<Vec<_>>()
            };
            let near = inside(&tube.radius, 1.0);
            let around = inside(&tube.alone, -1.0);
            if near.is_empty() {
                return Err(format!(
                    "step {}: no solution within {:?} at u = {u}",
                    step.step, tube.radius
                ));
            }
            if around.len() > 1 {
                return Err(format!(
                    "step {}: {} solutions within {:?} at u = {u}",
                    step.step,
                    around.len(),
                    tube.alone
                ));
            }
            // times are not in their order here: a number that is another one anywhere is a jump
            let number = near[0].0;
            if before.is_some_and(|before| before != number && near.len() == 1) {
                return Err(format!("step {}: the solution is another one at u = {u}", step.step));
            }
            before = Some(number);
        }
        Ok(())
    }
}

impl Case {
    /// Tests that the solutions of each number go on without a jump: where they change most they
    /// are looked at closer and closer.
    fn continuous(&self, step: &StepProof) -> Result<(), String> {
        let at = |u: &Wide| (self.solutions)(&(w(step.from) + u * (w(step.to) - w(step.from))));
        let change = |from: &Solutions, to: &Solutions| {
            let of = |(number, q): &(usize, Vec<Wide>)| {
                let other = to.iter().find(|(other, _)| other == number)?;
                q.iter().zip(&other.1).map(|(a, b)| (a - b).abs()).reduce(|a, b| a.max(&b))
            };
            from.iter().filter_map(of).reduce(|a, b| a.max(&b)).unwrap_or(w(0.0))
        };
        let grid: Vec<Solutions> = (0..=TIMES).map(|k| at(&w(k as f64 / TIMES as f64))).collect();
        let most = (0..TIMES)
            .reduce(|a, b| {
                if change(&grid[a], &grid[a + 1]) > change(&grid[b], &grid[b + 1]) { a } else { b }
            })
            .unwrap_or(0);
        let mut low = w(most as f64 / TIMES as f64);
        let mut high = w((most + 1) as f64 / TIMES as f64);
        let first = change(&at(&low), &at(&high));
        let mut below = at(&low);
        let mut above = at(&high);
        for _ in 0..40 {
            let middle = 0.5 * (&low + &high);
            let here = at(&middle);
            if change(&below, &here) > change(&here, &above) {
                (high, above) = (middle, here);
            } else {
                (low, below) = (middle, here);
            }
        }
        let last = change(&below, &above);
        let jumps = last > 1e-3 * &first && first > 1e-20;
        if jumps {
            Err(format!("step {}: it jumps by {} at u = {}", step.step, last.show(), low.show()))
        } else {
            Ok(())
        }
    }
}

fn wide(q: &[f64]) -> Vec<Wide> {
    q.iter().map(|q| w(*q)).collect()
}

/// True if a solution is within bounds of a position, coordinate by coordinate.
fn within(solution: &[Wide], q: &[Wide], bounds: &[f64], rounding: f64) -> bool {
    solution
        .iter()
        .zip(q)
        .zip(bounds)
        .all(|((solution, q), bound)| (solution - q).is_within(bound + rounding * (1.0 + bound)))
}

/// The position interpolated by q, q̇ and q̈ at both ends, and what f64 may have lost of it.
fn interpolated(motion: &Motion, k: usize, u: f64) -> (Vec<Wide>, f64) {
    let h = w(motion.times()[k + 1]) - w(motion.times()[k]);
    let u = w(u);
    let power = |n: usize| (0..n).fold(w(1.0), |power, _| power * &u);
    let of = |c: [f64; 4]| (0..4).fold(w(0.0), |sum, j| sum + c[j] * power(j + 2));
    // over u², u³, u⁴, u⁵
    let end = of([0.0, 10.0, -15.0, 6.0]);
    let base = [
        1.0 - &end,
        &h * (&u + of([0.0, -6.0, 8.0, -3.0])),
        &h * &h * of([0.5, -1.5, 1.5, -0.5]),
        end,
        &h * of([0.0, -4.0, 7.0, -3.0]),
        &h * &h * of([0.0, 0.5, -1.0, 0.5]),
    ];
    let rows = [
        motion.q(k),
        motion.qd(k),
        motion.qdd(k),
        motion.q(k + 1),
        motion.qd(k + 1),
        motion.qdd(k + 1),
    ];
    let step = motion.times()[k + 1] - motion.times()[k];
    let sizes = [1.0, step, step * step, 1.0, step, step * step];
    let largest = rows
        .iter()
        .zip(sizes)
        .flat_map(|(row, size)| row.iter().map(move |x| (x * size).abs()))
        .fold(0.0, f64::max);
    let p = (0..rows[0].len())
        .map(|j| rows.iter().zip(&base).fold(w(0.0), |sum, (row, b)| sum + row[j] * b))
        .collect();
    (p, 64.0 * f64::EPSILON * largest)
}

/// A mechanism of lengths with these values.
pub fn lengths<const N: usize>(
    q: [f64; N],
    add: impl FnOnce(&mut Mechanism, [Coordinate; N]) -> kin::Result<()>,
) -> System {
    crate::promises::lengths(q, add)
}

/// The motion as it is run, or, where it cannot be, of poses solved one by one.
pub fn moved(system: &System, times: &[f64]) -> Option<Motion> {
    system.run_both(times).ok().or_else(|| posed(system, times))
}

/// A motion of poses that were solved one by one.
pub fn posed(system: &System, times: &[f64]) -> Option<Motion> {
    let all: Vec<_> = times
        .iter()
        .map(|t| system.run_both([*t]).map(|motion| motion.data()))
        .collect::<kin::Result<_>>()
        .ok()?;
    let mut whole = all.first()?.clone();
    for one in &all[1..] {
        whole.times.extend(&one.times);
        for (to, from) in
            [(&mut whole.q, &one.q), (&mut whole.qd, &one.qd), (&mut whole.qdd, &one.qdd)]
        {
            to.extend(from.iter().cloned());
        }
        whole.iterations.extend(&one.iterations);
        whole.residuals.extend(&one.residuals);
    }
    Motion::from_data(&whole).ok()
}

/// Tells all that was proved wrongly at once, and how many of the honest ones were proved.
fn judged(cases: Vec<Case>) -> [usize; 3] {
    let mut honest = 0;
    let mut proved = 0;
    let mut wrong = Vec::new();
    let mut unproved = Vec::new();
    for case in &cases {
        match case.judge() {
            Err(what) => wrong.push(what),
            Ok(complete) => {
                honest += usize::from(case.honest);
                proved += usize::from(case.honest && complete);
                if case.honest && !complete {
                    unproved.push(case.name.clone());
                }
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "{} of {} are proved wrongly:\n{}",
        wrong.len(),
        cases.len(),
        wrong.join("\n")
    );
    println!(
        "{} constructions, {proved} of {honest} honest ones proved; not: {unproved:?}",
        cases.len()
    );
    [cases.len(), honest, proved]
}

#[test]
fn nothing_is_proved_wrongly_and_what_is_honest_is_proved() {
    let all = [
        explicit::cases(),
        constants::cases(),
        branches::cases(),
        seams::cases(),
        forged::cases(),
        scales::cases(),
    ];
    let counts: Vec<[usize; 3]> = all.into_iter().map(judged).collect();
    let [count, honest, proved] =
        counts.iter().fold([0; 3], |sum, one| std::array::from_fn(|k| sum[k] + one[k]));
    println!("{count} constructions, {proved} of {honest} honest ones proved");
    assert!(count >= 200 && honest >= 100 && count - honest >= 100, "{count} {honest}");
    assert!(100 * proved >= 95 * honest, "{proved} of {honest}");
}
