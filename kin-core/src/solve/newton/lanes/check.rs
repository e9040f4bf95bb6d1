//! Steps of time judged over lanes, by what [`crate::solve::follow`] sees without a further evaluation. A
//! lane that is objected to is not looked at any closer here: its case is run alone.

use crate::linear::lanes::WideLinear;
use crate::model::units::Unit;
use crate::numbers::lanes::lanewise::misses;
use crate::numbers::lanes::{Level, Mask, Wide};
use crate::solve::follow::{self, Drive, misses_too_far, turns_too_far};
use crate::solve::newton::Newton;
use crate::system::System;

/// The findings at the last positions that were accepted.
pub(super) struct Check<S: Level> {
    simd: S,
    /// −1 or 1 of each block of C_q, there and at the positions in hand.
    signs: Vec<Wide<S>>,
    now: Vec<Wide<S>>,
    pivot: Wide<S>,
    /// q, q̇, q̈ there.
    from: [Vec<Wide<S>>; 3],
    turns: Vec<bool>,
    /// The effect of time on such systems, and in each lane between the ends of a step: see
    /// [`Drive::outlook`].
    drive: Drive,
    outlook: [Wide<S>; 4],
}

impl<S: Level> Check<S> {
    pub(super) fn new(simd: S, typical: &System) -> Self {
        let (units, drive) = (&typical.layout().units, Drive::new(typical.equations()));
        let zero = Wide::splat(simd, 0.0);
        let turns = units.iter().map(|unit| *unit != Unit::Metre).collect();
        let from = [0; 3].map(|_| vec![zero; units.len()]);
        Check {
            simd,
            signs: Vec::new(),
            now: Vec::new(),
            pivot: zero,
            from,
            turns,
            drive,
            outlook: [zero; 4],
        }
    }

    /// A run between these times begins at the position in hand, in a lane; false where it is to be run
    /// alone.
    pub(super) fn foresee(&mut self, lane: usize, newton: &mut Newton<'_>, ends: [f64; 2]) -> bool {
        let Some(outlook) = follow::outlook(self.drive.clone(), newton, ends) else { return false };
        self.outlook.iter_mut().zip(outlook).for_each(|(all, own)| all.as_mut_slice()[lane] = own);
        true
    }

    /// Takes the positions in hand as they are.
    #[inline(always)]
    pub(super) fn accept(&mut self, linear: &WideLinear<S>) {
        linear.orientation(&mut self.signs);
        self.pivot = linear.smallest_pivot();
    }

    /// A step begins at these q, q̇, q̈.
    #[inline(always)]
    pub(super) fn begin(&mut self, from: [&[Wide<S>]; 3]) {
        self.from.iter_mut().zip(from).for_each(|(own, from)| own.copy_from_slice(from));
    }

    /// True in the lanes where there is no objection to the step h that has ended at q and its rates; what is
    /// seen there is kept for the next.
    #[inline(always)]
    pub(super) fn judge(
        &mut self,
        h: f64,
        q: &[Wide<S>],
        per_size: &[Wide<S>],
        linear: &WideLinear<S>,
    ) -> Mask<S> {
        let (simd, [qd, qdd], [from, from_rates, from_second]) =
            (self.simd, [linear.rates(), linear.second_rates()], &self.from);
        let (whole, zero) = (Wide::splat(simd, h), Wide::splat(simd, 0.0));
        let (mut miss, mut reach, mut all) = (zero, zero, zero);
        for (j, per_size) in per_size.iter().enumerate() {
            // Arrays that are mapped are made by calls, without the machine's instructions.
            let from = [from[j], from_rates[j], from_second[j]];
            let [forward, back, d] = misses(whole, from, [q[j], qd[j], qdd[j]]);
            miss = miss.or_larger(forward.abs().or_larger(back.abs()) * *per_size);
            all = all + (forward + back);
            if self.turns[j] {
                reach = reach.or_larger(d.abs());
            }
        }
        let pivot = linear.smallest_pivot();
        let (least, long, [e0, e1, e2, e3]) =
            (pivot.min(self.pivot), Wide::splat(simd, h.abs()), self.outlook);
        let off = long.mul_add(long.mul_add(long.mul_add(e3, e2), e1), e0);
        // The larger of two numbers says nothing of one that is none; a sum does.
        let mut good = all.abs().le(Wide::splat(simd, f64::INFINITY))
            & !misses_too_far(miss, least)
            & !turns_too_far(reach)
            & off.le(least * least);
        linear.orientation(&mut self.now);
        if self.now.len() == self.signs.len() {
            good = self
                .now
                .iter()
                .zip(&self.signs)
                .fold(good, |good, (now, before)| good & (*now * *before).gt(zero));
        }
        std::mem::swap(&mut self.now, &mut self.signs);
        self.pivot = pivot;
        good
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::joints::drivers::drive;
    use crate::linear::Linear;
    use crate::numbers::lanes::{Lanes, WithLevel};
    use crate::{Law, Mechanism};

    /// Steps of two lengths with the matrix [2 x + 1, 1; 1, 1], whose smaller pivot goes with x.
    struct Steps<'a>(&'a System);

    fn matrix<S: Level>(simd: S, linear: &mut WideLinear<S>, x: f64) {
        let values = [2.0 * x + 1.0, 1.0, 1.0, 1.0].map(|value| Wide::splat(simd, value));
        linear.written().1.copy_from_slice(&values);
        let all = Mask::splat(simd, true);
        assert!((linear.measure(all) & linear.factor(all)).lane(0));
        linear.written().0.fill(Wide::splat(simd, 0.0));
        linear.solve_velocity();
        linear.solve_acceleration();
    }

    impl WithLevel for Steps<'_> {
        type Output = ();

        fn run<S: Level>(self, simd: S) {
            let entries = [(0, 0), (0, 1), (1, 0), (1, 1)];
            let mut first = Linear::new(2, entries.map(Some), &[]);
            first.values_mut().copy_from_slice(&[3.0, 1.0, 1.0, 1.0]);
            assert!(first.measure() && first.factor());
            let mut linear = WideLinear::new(simd, first, [vec![], vec![]]);
            let number = |x: f64| Wide::splat(simd, x);
            linear.begin(&[number(1.0); 2]);
            let (q, still) = ([number(0.0); 2], [number(0.0); 2]);
            // A step from one matrix to another is good if it misses by so little.
            let mut good = |before: f64, after: f64, miss: f64| {
                let mut check = Check::new(simd, self.0);
                matrix(simd, &mut linear, before);
                check.accept(&linear);
                check.begin([&[number(miss), number(0.0)], &still, &still]);
                matrix(simd, &mut linear, after);
                check.judge(0.1, &q, &[number(1.0); 2], &linear).lane(0)
            };
            for (before, after) in [(1.0, 0.01), (0.01, 1.0), (0.01, 0.01)] {
                assert!(!good(before, after, 0.004) && good(before, after, 1e-4), "{before} {after}");
            }
            assert!(
                good(1.0, 1.0, 0.004)
                    && good(1.0, 1.0, -0.004)
                    && !good(1.0, 1.0, 0.1)
                    && !good(1.0, 1.0, -0.1)
            );
            // A block that turns over, and what is not a number.
            assert!(!good(1.0, -1.0, 0.0) && good(-1.0, -1.0, 0.0) && !good(1.0, 1.0, f64::NAN));
        }
    }

    /// A miss is held against the smaller pivot of both ends of a step, in every lane.
    #[test]
    fn steps_over_lanes_are_judged_by_the_smaller_pivot() {
        let mut m = Mechanism::new("pair");
        for name in ["x", "y"] {
            let x = m.length(name, 0.0).expect("a new name");
            m.add(&format!("motor {name}"), drive(x, Law::constant(0.0))).expect("adds");
        }
        let system = m.build().expect("builds");
        let judged =
            [1, 2, 4, 8].into_iter().filter(|lanes| Lanes::Only(*lanes).dispatch(Steps(&system)).is_ok());
        assert!(judged.count() > 0);
    }
}
