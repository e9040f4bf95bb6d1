//! Steps of redundant mechanisms, judged by what they have: no signs of determinants.

use super::super::{Follow, largest};
use super::Driver;
use crate::follow::{EASY, Lever, Objection, REACH, Span};
use crate::fours::{self, Fours};
use crate::system::evaluate::Instant;

impl Driver<'_> {
    /// What is wrong with the step to `target`: it turns something too far, a prediction from either end misses the other by more than what is sure
    /// to be one branch, or what drives may move further in between. Signs of determinants, which rectangular matrices have not, are not asked.
    pub(super) fn objection(&mut self, target: f64, [q, qd, qdd]: &[Vec<f64>; 3]) -> Option<Objection> {
        if self.options.follow == Follow::Unchecked {
            return None;
        }
        let (from, pivot) = (self.t, self.tall.smallest_pivot());
        let shares: Vec<f64> = self.measures.sizes.iter().map(|size| size.recip()).collect();
        let turns: Vec<f64> = (0..q.len()).map(|column| f64::from(u8::from(self.model.turns(column)))).collect();
        let [q, qd, qdd, r, rd, rdd] = [q, qd, qdd, &self.q, &self.qd, &self.qdd].map(|x| Fours::from(&x[..]));
        let [miss, reach] =
            fours::miss(target - from, [&q, &qd, &qdd], [&r, &rd, &rdd], &Fours::from(&shares[..]), &Fours::from(&turns[..]));
        if reach > REACH {
            return Some(Objection::Long);
        }
        if miss.is_nan() || miss > EASY * pivot {
            return Some(Objection::Missed(miss));
        }
        let mut drive = self.drive.take()?;
        let equations = self.model.equations;
        let hides = !drive.is_told(from, target, pivot) && {
            let mut lever = Squares { instant: equations.instant_at(target, &self.q), driver: self };
            drive.hides(Span { equations, from, to: target, pivot }, &mut lever)
        };
        self.drive = Some(drive);
        hides.then_some(Objection::Hidden)
    }
}

/// The matrix in hand as a lever, in the sense of least squares.
struct Squares<'d, 'a> {
    instant: Instant,
    driver: &'d mut Driver<'a>,
}

impl Lever for Squares<'_, '_> {
    fn instant(&self) -> &Instant {
        &self.instant
    }

    fn moved(&mut self, first: usize, b: &[f64]) -> f64 {
        let m = self.driver.model.m();
        let rhs: Vec<f64> = (0..m).map(|row| row.checked_sub(first).and_then(|k| b.get(k)).copied().unwrap_or(0.0)).collect();
        let moved = self.driver.solved(&rhs);
        largest(moved.iter().zip(&self.driver.measures.sizes).map(|(x, size)| (x / size).abs()))
    }

    fn bend(&mut self) -> f64 {
        f64::INFINITY
    }

    fn turned(&self) -> f64 {
        f64::INFINITY
    }

    fn is_singular_within(&mut self, _: f64) -> bool {
        true
    }
}
