//! Couples sums of many coordinates by one compiled kernel.

use kin_macros::constraint;

/// The largest number of coordinates in one coupling.
pub(super) const TERMS: usize = 6;

/// Couples two to six coordinates linearly: Σ k_n q_n − c = 0. \[unit of c\]
///
/// Removes 1 freedom. `q` are scalar coordinates or coordinates of bodies (`wheel.theta()`,
/// `rack.x()`). `k` contains one factor for each coordinate, and `c` is the sum. Use this coupling
/// for a differential, a planetary train or a platform on ropes and pulleys. To drive a sum, couple
/// the sum with a separate coordinate and drive the separate coordinate. Source: Norton, *Design of
/// Machinery*, ch. 9.
///
/// Signs: each coordinate has its usual sign.
#[constraint]
#[require(k.iter().any(|k| *k != 0.0), "at least one factor must differ from zero")]
pub fn linear_coupling(q: [Coord; 6], k: [f64; 6], c: f64) -> f64 {
    let mut sum = -c;
    for n in 0..6 {
        sum += k[n] * q[n];
    }
    sum
}
