//! Values that a constraint computes from the time alone, for a caller that has not computed them
//! once for the time.

use crate::model::constraint::Constraint;

/// Returns the N numbers of [`Constraint::at_time`].
#[cold]
pub fn timed<const N: usize>(constraint: &dyn Constraint, t: f64) -> [f64; N] {
    let mut numbers = [0.0; N];
    constraint.at_time(t, &mut numbers);
    numbers
}
