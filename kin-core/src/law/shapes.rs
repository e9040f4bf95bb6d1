//! Computes interval bounds of the modified rises, piece by piece.
//!
//! The bounds treat π as an interval too.

use crate::numbers::enclosure::{Interval, Series, piecewise};

fn pi(factor: f64) -> Series {
    Series::constant(Interval::pi(factor))
}

/// Evaluates a shape with s(1 − ξ) = 1 − s(ξ) from its first half.
pub(super) fn mirrored(x: &Series, half: &dyn Fn(&Series) -> Option<Series>) -> Option<Series> {
    piecewise(x, &[0.5], &|k, x| {
        if k == 0 { half(x) } else { Some(-half(&(-*x).plus(1.0))?.plus(-1.0)) }
    })
}

/// Evaluates the first eighth of both shapes: s″ = a sin 4πξ.
fn first_eighth(x: &Series, a: Series) -> Series {
    let w = pi(4.0);
    a * (*x / w - (w * *x).sin_cos().0 / w.sqr())
}

/// Returns s and s′ at the end of the first eighth.
fn after_eighth(a: Series) -> (Series, Series) {
    let end = first_eighth(&Series::constant(Interval::from(0.125)), a);
    // 4π/8 is a quarter of a revolution, so s′ = a (1 − cos π/2)/4π.
    (end, a / pi(4.0))
}

/// Evaluates s″ = a cos w τ with the given s and s′ at τ = 0.
fn cosine(tau: Series, a: Series, w: Series, (s, v): (Series, Series)) -> Series {
    s + v * tau + a * (-(w * tau).sin_cos().1).plus(1.0) / w.sqr()
}

/// Evaluates s″ = a sin 4πξ to 1/8, then a cos(4π(ξ − 1/8)/3), with a = 4π²/(π + 4).
pub(super) fn modified_sine(x: &Series) -> Option<Series> {
    let a = pi(1.0).sqr().times(4.0) / pi(1.0).plus(4.0);
    piecewise(x, &[0.125], &|k, x| {
        let third = pi(4.0) / Series::constant(Interval::from(3.0));
        Some(if k == 0 {
            first_eighth(x, a)
        } else {
            cosine(x.plus(-0.125), a, third, after_eighth(a))
        })
    })
}

/// Evaluates s″ = a sin 4πξ to 1/8, a to 3/8, then a cos 4π(ξ − 3/8), with a = 8π/(2 + π).
pub(super) fn modified_trapezoid(x: &Series) -> Option<Series> {
    let a = pi(8.0) / pi(1.0).plus(2.0);
    let (s, v) = after_eighth(a);
    let constant = |tau: Series| s + v * tau + a.times(0.5) * tau.sqr();
    piecewise(x, &[0.125, 0.375], &|k, x| {
        Some(match k {
            0 => first_eighth(x, a),
            1 => constant(x.plus(-0.125)),
            _ => {
                let quarter = Series::constant(Interval::from(0.25));
                cosine(x.plus(-0.375), a, pi(4.0), (constant(quarter), v + a * quarter))
            }
        })
    })
}
