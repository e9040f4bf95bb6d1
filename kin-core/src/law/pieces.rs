//! A law as polynomials between knots, such as a spline.

/// Polynomials between knots. Before the first knot and after the last one the law is a straight
/// line, unless it repeats.
#[derive(Clone, Debug, PartialEq)]
pub struct Pieces {
    /// The knots in increasing order, at least two.
    pub knots: Vec<f64>,
    /// For each knot the coefficients of the polynomial after it, in powers of x minus the knot.
    /// After the last knot only the first two count.
    pub coefficients: Vec<[f64; 4]>,
    /// True if the law repeats beyond its knots.
    pub repeats: bool,
}
