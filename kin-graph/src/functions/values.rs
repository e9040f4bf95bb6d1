//! Computes values of functions for which the standard library loses digits.

/// Returns arsinh x to rounding.
///
/// The function of the standard library is infinite for the largest numbers, because a sum
/// overflows before the logarithm. For such x this function returns ln |x| + ln 2 with the sign of
/// x.
pub fn asinh(x: f64) -> f64 {
    if x.abs() > 1e300 { (x.abs().ln() + std::f64::consts::LN_2).copysign(x) } else { x.asinh() }
}

/// Returns arcosh x to rounding, or NaN below 1.
///
/// The function of the standard library loses all digits near 1, because it adds 1 before the
/// logarithm.
///
/// With t = x − 1 it is ln(1 + t + √(2 t + t²)); from 2 on ln(2 x − 1/(x + √(x² − 1))), and ln x +
/// ln 2 where 1/x is below rounding.
pub fn acosh(x: f64) -> f64 {
    if x < 1.0 {
        f64::NAN
    } else if x > 1e9 {
        x.ln() + std::f64::consts::LN_2
    } else if x > 2.0 {
        (2.0 * x - (x + (x * x - 1.0).sqrt()).recip()).ln()
    } else {
        let t = x - 1.0;
        (t + (t * (2.0 + t)).sqrt()).ln_1p()
    }
}

/// Returns artanh x to rounding; infinite at ±1, NaN beyond ±1.
///
/// The formula is ½ ln(1 + 2 |x|/(1 − |x|)) with the sign of x. For a negative x the standard
/// library computes the logarithm of a difference close to zero.
pub fn atanh(x: f64) -> f64 {
    let a = x.abs();
    let twice = a + a;
    let y = if a < 0.5 { twice + twice * a / (1.0 - a) } else { twice / (1.0 - a) };
    (0.5 * y.ln_1p()).copysign(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arsinh_of_the_largest_number_is_finite() {
        assert!((asinh(f64::MAX) - 710.475_860_073_943_9).abs() < 1e-12);
        assert_eq!((asinh(-f64::MAX), asinh(f64::INFINITY)), (-asinh(f64::MAX), f64::INFINITY));
        assert!(asinh(-0.0).is_sign_negative() && asinh(f64::NAN).is_nan());
    }
}
