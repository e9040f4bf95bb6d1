//! Between the times of a motion.

use kin::prelude::*;

/// The polynomial that meets q, q̇ and q̈ at both ends, by Hermite's own base: what a tube is
/// around.
pub fn interpolated(motion: &Motion, k: usize, u: f64) -> Vec<f64> {
    let h = motion.times()[k + 1] - motion.times()[k];
    let u2 = u * u;
    let u3 = u.powi(3);
    let u4 = u.powi(4);
    let u5 = u.powi(5);
    let base = [
        1.0 - 10.0 * u3 + 15.0 * u4 - 6.0 * u5,
        h * (u - 6.0 * u3 + 8.0 * u4 - 3.0 * u5),
        h * h * (0.5 * u2 - 1.5 * u3 + 1.5 * u4 - 0.5 * u5),
        10.0 * u3 - 15.0 * u4 + 6.0 * u5,
        h * (-4.0 * u3 + 7.0 * u4 - 3.0 * u5),
        h * h * (0.5 * u3 - u4 + 0.5 * u5),
    ];
    let rows = [
        motion.q(k),
        motion.qd(k),
        motion.qdd(k),
        motion.q(k + 1),
        motion.qd(k + 1),
        motion.qdd(k + 1),
    ];
    (0..rows[0].len()).map(|j| rows.iter().zip(base).map(|(row, b)| row[j] * b).sum()).collect()
}
