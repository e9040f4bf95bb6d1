//! The few loops over whole vectors that every step takes, four numbers at a time: the compiler, left alone, unrolls them for long vectors,
//! which costs short ones more than the work itself. The last four overlap those before where that does no harm.

use wide::f64x4;

/// The largest |x|, 0 of none; infinite if a number is not finite.
pub(crate) fn largest(x: &[f64]) -> f64 {
    let mut seen = Seen::default();
    x.as_chunks().0.iter().for_each(|four| seen.see(f64x4::new(*four)));
    seen.see(last(x, 0.0));
    seen.largest()
}

/// The largest |x_i| · share_i of finite shares; infinite if a number is not finite.
pub(crate) fn largest_share(x: &[f64], shares: &[f64]) -> f64 {
    let mut seen = Seen::default();
    pairs(x, shares).for_each(|(four, shares)| seen.see(four * shares));
    seen.see(last(x, 0.0) * last(shares, 0.0));
    seen.largest()
}

/// Whether |x_i| ≤ limit_i everywhere.
pub(crate) fn inside(x: &[f64], limits: &[f64]) -> bool {
    let inside = last(x, 0.0).abs().simd_le(last(limits, 1.0));
    pairs(x, limits).fold(inside, |inside, (four, limits)| inside & four.abs().simd_le(limits)).all()
}

/// x = y; whether all numbers are finite.
pub(crate) fn take(x: &mut [f64], y: &[f64]) -> bool {
    let mut odd = f64x4::ZERO;
    for (four, numbers) in x.as_chunks_mut().0.iter_mut().zip(y.as_chunks().0) {
        *four = *numbers;
        odd += f64x4::new(*numbers) * f64x4::ZERO;
    }
    match x.last_chunk_mut::<4>().zip(y.last_chunk()) {
        Some((four, numbers)) => *four = *numbers,
        None => x.copy_from_slice(y),
    }
    (odd + last(y, 0.0) * f64x4::ZERO).reduce_add() == 0.0
}

/// x += y
pub(crate) fn add(x: &mut [f64], y: &[f64]) {
    let Some((end, terms)) = x.last_chunk().copied().zip(y.last_chunk().copied()) else {
        return x.iter_mut().zip(y).for_each(|(x, y)| *x += y);
    };
    for (four, terms) in x.as_chunks_mut().0.iter_mut().zip(y.as_chunks().0) {
        *four = (f64x4::new(*four) + f64x4::new(*terms)).to_array();
    }
    let end = f64x4::new(end) + f64x4::new(terms);
    x.last_chunk_mut().into_iter().for_each(|four| *four = end.to_array());
}

/// How far q + h q̇ + ½ h² q̈ from either end of a step h is from the other end, by shares, and how far the ends are apart, by `turns`; the
/// largest of each. All vectors must have the same length.
pub(crate) fn miss(h: f64, [q, qd, qdd]: [&[f64]; 3], [r, rd, rdd]: [&[f64]; 3], shares: &[f64], turns: &[f64]) -> [f64; 2] {
    let (h, half, mut miss, mut reach) = (f64x4::splat(h), f64x4::splat(0.5 * h), f64x4::ZERO, f64x4::ZERO);
    let mut see = |[q, qd, qdd, r, rd, rdd, share, turn]: [f64x4; 8]| {
        let d = r - q;
        let (forward, back) = (d - h * (qd + half * qdd), d - h * (rd - half * rdd));
        miss = miss.fast_max(forward.abs().fast_max(back.abs()) * share);
        reach = reach.fast_max(d.abs() * turn);
    };
    let all = [q, qd, qdd, r, rd, rdd, shares, turns];
    let whole = all.map(|x| x.as_chunks::<4>().0);
    for k in 0..q.len() / 4 {
        see(whole.map(|x| x.get(k).map_or(f64x4::ZERO, |four| f64x4::new(*four))));
    }
    see(all.map(|x| last(x, 0.0)));
    [miss, reach].map(|most| most.to_array().into_iter().fold(0.0, f64::max))
}

/// x = −y
pub(crate) fn negate(x: &mut [f64], y: &[f64]) {
    for (four, terms) in x.as_chunks_mut().0.iter_mut().zip(y.as_chunks().0) {
        *four = (-f64x4::new(*terms)).to_array();
    }
    match x.last_chunk_mut::<4>().zip(y.last_chunk()) {
        Some((four, terms)) => *four = (-f64x4::new(*terms)).to_array(),
        None => x.iter_mut().zip(y).for_each(|(x, y)| *x = -y),
    }
}

/// The whole fours of two vectors side by side.
fn pairs(x: &[f64], y: &[f64]) -> impl Iterator<Item = (f64x4, f64x4)> {
    x.as_chunks().0.iter().zip(y.as_chunks().0).map(|(x, y)| (f64x4::new(*x), f64x4::new(*y)))
}

/// The last four numbers; where there are fewer, padded.
#[inline(always)]
fn last(x: &[f64], padding: f64) -> f64x4 {
    f64x4::new(x.last_chunk().copied().unwrap_or_else(|| padded(x, padding)))
}

fn padded(x: &[f64], padding: f64) -> [f64; 4] {
    let mut four = [padding; 4];
    four.iter_mut().zip(x).for_each(|(four, x)| *four = *x);
    four
}

/// The largest numbers so far, and something that is 0 while all of them are finite.
#[derive(Default)]
struct Seen {
    largest: f64x4,
    odd: f64x4,
}

impl Seen {
    #[inline(always)]
    fn see(&mut self, four: f64x4) {
        self.largest = four.abs().fast_max(self.largest);
        self.odd += four * f64x4::ZERO;
    }

    fn largest(&self) -> f64 {
        let [a, b, c, d] = self.largest.to_array();
        if self.odd.reduce_add() == 0.0 { a.max(b).max(c.max(d)) } else { f64::INFINITY }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_counts() {
        for n in 0..12 {
            let x: Vec<f64> = (0..n).map(|k| 1.0 - 0.1 * k as f64).collect();
            let (halves, limits) = (vec![0.5; n], vec![5.0; n]);
            assert_eq!((largest(&x), largest_share(&x, &halves)), if n > 0 { (1.0, 0.5) } else { (0.0, 0.0) });
            assert!(inside(&x, &x.iter().map(|x| x.abs()).collect::<Vec<_>>()));
            for k in 0..n {
                for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    let mut x = x.clone();
                    x[k] = odd;
                    assert_eq!((largest(&x), largest_share(&x, &halves)), (f64::INFINITY, f64::INFINITY));
                    assert!(!inside(&x, &limits) && !take(&mut vec![0.0; n], &x));
                }
                let mut x = x.clone();
                x[k] = -7.0;
                assert!(largest(&x) == 7.0 && largest_share(&x, &halves) == 3.5 && !inside(&x, &limits));
            }
            let (mut sum, mut opposite, mut taken) = (x.clone(), vec![3.0; n], vec![3.0; n]);
            assert!(take(&mut taken, &x) && taken == x);
            add(&mut sum, &x);
            negate(&mut opposite, &x);
            assert!((0..n).all(|k| sum[k] == 2.0 * x[k] && opposite[k] == -x[k]));
        }
    }
}
