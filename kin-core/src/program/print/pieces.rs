//! Prints laws that are polynomials between knots, such as splines, as tables with a function.

use std::fmt::Write;

use super::c::rows;
use crate::law::Law;

/// The function that all tables share.
const PIECE: &str =
    "/* A derivative of polynomials between knots at x; c holds four coefficients of each. */
static double @N@_piece(
    const double knots[], const double c[], int n, int repeats, double x, int order)
{
    const double length = knots[n - 1] - knots[0];
    double t, d;
    int low = 0, high = n - 1;
    const double *p;
    if (repeats) {
        x -= length * floor((x - knots[0]) / length);
    }
    if (x < knots[0] || x > knots[n - 1]) {
        p = x < knots[0] ? c : c + 4 * (n - 1);
        t = x - (x < knots[0] ? knots[0] : knots[n - 1]);
        return order == 0 ? p[0] + t * p[1] : order == 1 ? p[1] : 0.0;
    }
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (knots[middle] <= x) {
            low = middle;
        } else {
            high = middle;
        }
    }
    p = c + 4 * low;
    t = x - knots[low];
    d = 3.0 * p[3];
    switch (order) {
    case 0:
        return p[0] + t * (p[1] + t * (p[2] + t * p[3]));
    case 1:
        return p[1] + t * (2.0 * p[2] + t * d);
    case 2:
        return 2.0 * (p[2] + t * d);
    default:
        return order == 3 ? 2.0 * d : 0.0;
    }
}

";

/// Prints the laws that a text calls, as functions `NAME_law0(x, order)`.
pub(super) fn laws(laws: &[Law], called: &str) -> String {
    let mut text = String::new();
    for (k, law) in laws.iter().enumerate() {
        let Some(pieces) = law.pieces().filter(|_| called.contains(&format!("_law{k}("))) else {
            continue;
        };
        let n = pieces.knots.len();
        let repeats = usize::from(pieces.repeats);
        let _ = write!(
            text,
            "static const double @N@_law{k}_knots[{n}] = {{{}}};
static const double @N@_law{k}_c[{}] = {{{}}};
static double @N@_law{k}(double x, int order)
{{
    return @N@_piece(@N@_law{k}_knots, @N@_law{k}_c, {n}, {repeats}, x, order);
}}

",
            rows(&pieces.knots),
            4 * n,
            rows(&pieces.coefficients.concat()),
        );
    }
    if text.is_empty() { text } else { format!("{PIECE}{text}") }
}
