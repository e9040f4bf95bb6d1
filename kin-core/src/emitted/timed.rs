//! Values that a constraint computes from the time alone, for a caller that has not asked for them
//! once a time.

use crate::model::constraint::Constraint;

/// The N numbers of [`Constraint::at_time`].
#[cold]
pub fn timed<const N: usize>(constraint: &dyn Constraint, t: f64) -> [f64; N] {
    let mut numbers = [0.0; N];
    constraint.at_time(t, &mut numbers);
    numbers
}
