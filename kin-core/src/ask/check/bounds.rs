//! Tests the interval bounds that proofs use against values at points.
//!
//! A value outside its bounds is an error.

use super::law::derivative;
use super::{Disagreement, Spread, Terms};
use crate::ask::proof::Part;
use crate::law::Law;
use crate::model::constraint::Constraint;
use crate::numbers::enclosure::{Interval, ONE, Series};

/// The widths of the intervals around points.
const WIDTHS: [f64; 4] = [0.0, 1e-7, 1e-3, 0.1];
/// The number of coefficients of Taylor's formula.
const FULL: usize = 7;

/// Returns the entries of C, C_q, C_q q̇ + C_t and Q_d outside their bounds over boxes around a
/// state, and whether bounds were known over a small box.
pub(super) fn outside(
    constraint: &dyn Constraint,
    q: &[f64],
    qd: &[f64],
    t: f64,
    terms: &Terms,
) -> (Vec<Disagreement>, bool) {
    let mut all = Vec::new();
    let mut known = false;
    let Some(part) = Part::alone(constraint) else { return (all, known) };
    let mut spread = Spread(t.to_bits());
    let rows = constraint.facts().rows;
    let narrow = spread.next() < 0.0;
    for width in WIDTHS.into_iter().skip(usize::from(!narrow)).step_by(2) {
        let mut around = |x: f64| {
            Interval::new(x - width * (2.0 + spread.next()), x + width * (2.0 + spread.next()))
        };
        let boxes = q.iter().map(|q| around(*q)).collect::<Vec<_>>();
        let times = around(t);
        let along: Vec<Series> = boxes
            .iter()
            .zip(qd)
            .map(|(q, qd)| Series::variable(*q, Interval::from(*qd), FULL))
            .collect();
        let mut c = Vec::new();
        let mut c_q = Vec::new();
        let found = part.residual(&along, Series::variable(times, ONE, FULL), &mut c);
        if found.and_then(|()| part.jacobian(&boxes, times, &mut c_q)).is_err() {
            continue;
        }
        known = true;
        let mut check = |name: String, bounds: Interval, value: f64, size: f64| {
            // The computed value at the point contains the rounding of its operands.
            let slack = 1e-12 * (1.0 + size + bounds.mag().min(1e6 * (1.0 + value.abs())));
            let difference = (bounds.lo() - value).max(value - bounds.hi());
            if value.is_finite() && difference > slack {
                all.push(Disagreement {
                    name,
                    own: bounds.mid(),
                    dual: value,
                    central: None,
                    difference,
                });
            }
        };
        let velocity = &terms.c_q * nalgebra::DVector::from_column_slice(qd) + &terms.c_t;
        for (k, c) in c.iter().enumerate() {
            let size = terms.c_qqd_qd.amax().max(terms.c_tt.amax()).max(velocity.amax());
            check(format!("bounds of C, {}", rows[k]), c.at(0), terms.c[k], terms.c.amax());
            check(format!("bounds of C_q qd + C_t, {}", rows[k]), c.at(1), velocity[k], size);
            check(
                format!("bounds of Q_d, {}", rows[k]),
                c.at(2) * Interval::from(-2.0),
                terms.q_d[k],
                size,
            );
        }
        for (row, column, values) in c_q {
            check(
                format!("bounds of C_q, {}, column {column}", rows[row]),
                values,
                terms.c_q[(row, column)],
                terms.c_q.amax(),
            );
        }
    }
    (all, known)
}

/// Returns the places at which a law or a derivative is outside its bounds, in words. It tests
/// random intervals, from points to the whole range, at their ends and inside, and over breaks.
pub(super) fn of_law(law: &Law, from: f64, to: f64, sizes: &[f64; 4]) -> Vec<String> {
    let mut spread = Spread(from.to_bits() ^ to.to_bits());
    let mut share = || 0.25 * (spread.next() + 2.0);
    let mut lines = Vec::new();
    for k in 0..400 {
        // Widths of all magnitudes; every eighth one is zero.
        let width = if k % 8 == 0 { 0.0 } else { (to - from) * 10_f64.powf(-9.0 * share()) };
        let begin = from + (to - from - width).max(0.0) * share();
        let (begin, end) = (begin, (begin + width).max(begin));
        let Some(bounds) = law.over(&Series::variable(Interval::new(begin, end), ONE, FULL)) else {
            return lines;
        };
        // A break counts as inside if it is inside by more than rounding.
        let beside = 1e-9 * (end - begin) + 1e-12 * (begin.abs() + end.abs());
        for found in law
            .breaks(begin + beside, end - beside)
            .iter()
            .filter(|_| begin + beside < end - beside)
        {
            if bounds.len() > found.order + 1 {
                let what = format!(
                    "{} jumps at the break at x = {}, so over this break `over` must return at most {} Taylor coefficients. It returns {}",
                    derivative(found.order),
                    found.x,
                    found.order + 1,
                    bounds.len()
                );
                lines.push(what);
            }
        }
        for x in [begin, begin + (end - begin) * share(), end] {
            lines.extend(not_within(law, &bounds, x.clamp(begin, end), sizes));
        }
    }
    lines
}

fn not_within(law: &Law, bounds: &Series, x: f64, sizes: &[f64; 4]) -> Vec<String> {
    let factorial = [1.0, 1.0, 2.0, 6.0];
    let outside = |(order, value): (usize, f64)| {
        let known = bounds.at(order) * Interval::from(factorial[order]);
        // Near a break the law's rounding decides on which side the point is.
        let slack = 1e-11 * (1.0 + sizes[order]);
        let found = value < known.lo() - slack || value > known.hi() + slack;
        found.then(|| {
            format!(
                "{} at x = {x} is {value:e}. By the bounds of the law it must be between {:e} and {:e}",
                derivative(order),
                known.lo(),
                known.hi()
            )
        })
    };
    law.jet(x).into_iter().enumerate().take(bounds.len()).filter_map(outside).collect()
}
