//! Sums of many coordinates, as one kernel.

use kin_macros::constraint;

/// As many coordinates as one coupling takes.
pub(super) const TERMS: usize = 6;

/// Linear coupling of two to six coordinates: Σ k_n q_n − c = 0.      \[unit of c\]
///
/// Removes 1 freedom. `q`: bare coordinates or those of bodies (`wheel.theta()`, `rack.x()`); `k`:
/// a factor for each; `c`: what they add up to. A differential, a planetary train by its turns, a
/// platform held by ropes over pulleys. To drive a sum, couple it with a separate coordinate and
/// drive that. Norton, *Design of Machinery*, ch. 9.
///
/// Signs: those of the coordinates.
#[constraint]
#[require(k.iter().any(|k| *k != 0.0), "factors of zero couple nothing")]
pub fn linear_coupling(q: [Coord; 6], k: [f64; 6], c: f64) -> f64 {
    let mut sum = -c;
    for n in 0..6 {
        sum += k[n] * q[n];
    }
    sum
}
