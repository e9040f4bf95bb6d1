//! The same systems over lanes: each lane solves its own, whatever rows of its right sides are zero for good.

use super::random::{Kind, Sparse};
use crate::linear::lanes::WideLinear;
use crate::numbers::lanes::{Lanes, Level, Mask, Wide, WithLevel};
use crate::numbers::random::Random;

/// One system in as many lanes as there are, each with numbers near the first one's.
struct Together<'a>(&'a Sparse, u64);

impl WithLevel for Together<'_> {
    /// How many lanes fitted.
    type Output = usize;

    fn run<S: Level>(self, simd: S) -> usize {
        let (a, random) = (self.0, &mut Random::new(self.1));
        let mut first = a.linear();
        first.values_mut().copy_from_slice(&a.values);
        if !(first.measure() && first.factor() && first.smallest_pivot() > 1e-4) {
            return 0;
        }
        let n = a.n;
        let asked = [0, 1].map(|_| (0..n).filter(|_| random.below(3) == 0).collect::<Vec<usize>>());
        let mut wide = WideLinear::new(simd, first, asked.clone());
        let all = Mask::splat(simd, true);
        let values: Vec<Wide<S>> =
            (0..a.values.len()).map(|k| vary(simd, a.values[k], a.constants[k], random)).collect();
        wide.begin(&vec![Wide::splat(simd, 1.0); n]);
        wide.written().1.copy_from_slice(&values);
        let fits = wide.measure(all) & wide.factor(all);
        let every: Vec<usize> = (0..n).collect();
        let b = [&every, &asked[0], &asked[1]].map(|rows| right_side(simd, n, rows, random));
        // Right sides that are zero for good are not read.
        wide.velocity_rhs().fill(Wide::splat(simd, f64::NAN));
        wide.acceleration_rhs().1.fill(Wide::splat(simd, f64::NAN));
        every.iter().for_each(|row| wide.written().0[*row] = b[0][*row]);
        asked[0].iter().for_each(|row| wide.velocity_rhs()[*row] = b[1][*row]);
        asked[1].iter().for_each(|row| wide.acceleration_rhs().1[*row] = b[2][*row]);
        wide.correct();
        wide.solve_velocity();
        wide.solve_acceleration();
        let found = [wide.correction(), wide.rates(), wide.second_rates()];
        for lane in (0..Wide::<S>::LANES).filter(|lane| fits.lane(*lane)) {
            let own = |x: &Wide<S>| x.as_slice()[lane];
            for (x, b) in found.iter().zip(&b) {
                let mut left: Vec<f64> = b.iter().map(own).collect();
                a.entries
                    .iter()
                    .zip(&values)
                    .for_each(|((i, j), value)| left[*i] -= own(value) * own(&x[*j]));
                let size = x.iter().map(own).fold(1.0, |m: f64, x| m.max(x.abs()));
                let worst = left.iter().fold(0.0, |m: f64, r| if r.abs() <= m { m } else { r.abs() });
                assert!(worst <= 1e-10 * size, "lane {lane} of {}: {worst:e}, {size:e}", Wide::<S>::LANES);
            }
        }
        (0..Wide::<S>::LANES).filter(|lane| fits.lane(*lane)).count()
    }
}

fn vary<S: Level>(simd: S, value: f64, constant: Option<f64>, random: &mut Random) -> Wide<S> {
    let mut all = Wide::splat(simd, value);
    if constant.is_none() {
        all.as_mut_slice().iter_mut().skip(1).for_each(|x| *x *= 1.0 + 0.2 * random.number());
    }
    all
}

/// Random numbers in these rows, zero in the others.
fn right_side<S: Level>(simd: S, n: usize, rows: &[usize], random: &mut Random) -> Vec<Wide<S>> {
    let mut b = vec![Wide::splat(simd, 0.0); n];
    rows.iter().for_each(|row| b[*row].as_mut_slice().iter_mut().for_each(|x| *x = random.number()));
    b
}

#[test]
fn every_lane_solves_its_own_system() {
    let random = &mut Random::new(20_261_122);
    let mut solved = 0;
    for case in 0..600 {
        let n = if case % 50 == 0 { 60 } else { 1 + random.below(12) };
        let a = Sparse::random(n, if case % 2 == 0 { Kind::Plain } else { Kind::Permuted }, random);
        for lanes in [1, 2, 4, 8] {
            solved += Lanes::Only(lanes).dispatch(Together(&a, case)).unwrap_or(0);
        }
    }
    assert!(solved > 1000, "{solved}");
}
