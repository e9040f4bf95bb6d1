//! Lists every function of one or two numbers, with one entry for each function.

/// Hands every function of one number to a macro.
///
/// An entry has a doc comment, the name of the function, the name of its method, the text of that
/// name, and in braces
/// * `value`: its value in f64;
/// * `definition`, for a function that some libraries lack: an expression in other functions of the
///   list, for numbers of any kind; the test computes 60 digits with it;
/// * `slope`: its derivative with respect to the argument u, y being its value, for numbers of any
///   kind (helpers: `rules.rs`);
/// * `facts`: domain, range, extrema, poles, growth, error ([`Facts`](crate::functions::Facts)).
#[macro_export]
macro_rules! functions_of_one {
    ($to:ident) => {
        $to! {
            /// Returns sin x, x in rad.
            Sin sin "sin" {
                value: f64::sin;
                slope: |u, _| u.call(Function::Cos);
                facts: Facts {
                    range: UNIT,
                    extrema: &[(at_quarters(1.0, 4.0), 1.0), (at_quarters(3.0, 4.0), -1.0)],
                    growth: Growth::Bounded,
                    ..OF_ANGLES
                };
            }
            /// Returns cos x, x in rad.
            Cos cos "cos" {
                value: f64::cos;
                slope: |u, _| -u.call(Function::Sin);
                facts: Facts {
                    range: UNIT,
                    extrema: &[(at_quarters(0.0, 4.0), 1.0), (at_quarters(2.0, 4.0), -1.0)],
                    growth: Growth::Bounded,
                    ..OF_ANGLES
                };
            }
            /// Returns tan x, x in rad.
            Tan tan "tan" {
                value: f64::tan;
                slope: |_, y| y.squared() + number(1.0);
                facts: Facts { poles: &[at_quarters(1.0, 2.0)], ..OF_ANGLES };
            }
            /// Returns arcsin x in \[−π/2, π/2\] rad. The slope is infinite at ±1; beyond ±1 the
            /// result is NaN.
            Asin asin "asin" {
                value: f64::asin;
                slope: |u, _| inverse(root(one_minus(u.squared())));
                facts: Facts { domain: UNIT, steep: &UNIT, growth: Growth::Bounded, ..CONTINUOUS };
            }
            /// Returns arccos x in \[0, π\] rad. The slope is infinite at ±1; beyond ±1 the result
            /// is NaN.
            Acos acos "acos" {
                value: f64::acos;
                slope: |u, _| -inverse(root(one_minus(u.squared())));
                facts: Facts { domain: UNIT, steep: &UNIT, growth: Growth::Bounded, ..CONTINUOUS };
            }
            /// Returns arctan x in (−π/2, π/2) rad.
            Atan atan "atan" {
                value: f64::atan;
                slope: |u, _| inverse(u.squared() + number(1.0));
                facts: Facts { growth: Growth::Bounded, ..CONTINUOUS };
            }
            /// Returns sinh x.
            Sinh sinh "sinh" {
                value: f64::sinh;
                slope: |u, _| u.call(Function::Cosh);
                facts: Facts { growth: Growth::Bursting, ..CONTINUOUS };
            }
            /// Returns cosh x.
            Cosh cosh "cosh" {
                value: f64::cosh;
                slope: |u, _| u.call(Function::Sinh);
                facts: Facts {
                    range: [1.0, f64::INFINITY],
                    extrema: &[(Place::At(0.0), 1.0)],
                    growth: Growth::Bursting,
                    ..CONTINUOUS
                };
            }
            /// Returns tanh x.
            Tanh tanh "tanh" {
                value: f64::tanh;
                slope: |_, y| one_minus(y.squared());
                facts: Facts { range: UNIT, growth: Growth::Bounded, ..CONTINUOUS };
            }
            /// Returns arsinh x.
            Asinh asinh "asinh" {
                value: $crate::functions::asinh;
                slope: |u, _| inverse(u.call2(Function2::Hypot, number(1.0)));
                facts: Facts { growth: Growth::Logarithmic, ..CONTINUOUS };
            }
            /// Returns arcosh x ≥ 0. The slope is infinite at 1; below 1 the result is NaN.
            Acosh acosh "acosh" {
                value: $crate::functions::acosh;
                slope: |u, _| inverse(root(u.clone() + number(-1.0)) * root(u + number(1.0)));
                facts: Facts {
                    domain: [1.0, f64::INFINITY],
                    range: ABOVE_0,
                    steep: &[1.0],
                    growth: Growth::Logarithmic,
                    ..CONTINUOUS
                };
            }
            /// Returns artanh x. The result is infinite at ±1, and NaN beyond.
            Atanh atanh "atanh" {
                value: $crate::functions::atanh;
                slope: |u, _| inverse(one_minus(u.squared()));
                facts: Facts {
                    domain: UNIT,
                    poles: &[Place::At(-1.0), Place::At(1.0)],
                    growth: Growth::Logarithmic,
                    ..CONTINUOUS
                };
            }
            /// Returns eˣ.
            Exp exp "exp" {
                value: f64::exp;
                slope: |_, y| y;
                facts: Facts { range: ABOVE_0, growth: Growth::Bursting, ..CONTINUOUS };
            }
            /// Returns 2ˣ.
            Exp2 exp2 "exp2" {
                value: f64::exp2;
                definition: |x| (x * logarithm(2.0)).call(Function::Exp);
                slope: |_, y| y * logarithm(2.0);
                facts: Facts { range: ABOVE_0, growth: Growth::Bursting, ..CONTINUOUS };
            }
            /// Returns eˣ − 1, without loss of digits near 0.
            ExpM1 exp_m1 "exp_m1" {
                value: f64::exp_m1;
                definition: |x| x.call(Function::Exp) - number(1.0);
                slope: |_, y| y + number(1.0);
                facts: Facts { range: [-1.0, f64::INFINITY], growth: Growth::Bursting, ..CONTINUOUS };
            }
            /// Returns ln x. The result is −∞ at 0, and NaN below.
            Ln ln "ln" {
                value: f64::ln;
                slope: |u, _| inverse(u);
                facts: LOGARITHM;
            }
            /// Returns ln(1 + x), without loss of digits near 0. The result is −∞ at −1, and NaN
            /// below.
            Ln1p ln_1p "ln_1p" {
                value: f64::ln_1p;
                definition: |x| (x + number(1.0)).call(Function::Ln);
                slope: |u, _| inverse(u + number(1.0));
                facts: Facts { domain: [-1.0, f64::INFINITY], poles: &[Place::At(-1.0)], ..LOGARITHM };
            }
            /// Returns log₂ x. The result is −∞ at 0, and NaN below.
            Log2 log2 "log2" {
                value: f64::log2;
                definition: |x| x.call(Function::Ln) / logarithm(2.0);
                slope: |u, _| inverse(u * logarithm(2.0));
                facts: LOGARITHM;
            }
            /// Returns log₁₀ x. The result is −∞ at 0, and NaN below.
            Log10 log10 "log10" {
                value: f64::log10;
                definition: |x| x.call(Function::Ln) / logarithm(10.0);
                slope: |u, _| inverse(u * logarithm(10.0));
                facts: LOGARITHM;
            }
            /// Returns √x. The slope is infinite at 0 unless x is constant; below 0 the result is
            /// NaN.
            Sqrt sqrt "sqrt" {
                value: f64::sqrt;
                slope: |_, y| inverse(y * number(2.0));
                facts: Facts {
                    domain: ABOVE_0,
                    range: ABOVE_0,
                    steep: &[0.0],
                    error: |_| 1.0,
                    ..CONTINUOUS
                };
            }
            /// Returns ∛x with the sign of x. The slope is infinite at 0 unless x is constant.
            Cbrt cbrt "cbrt" {
                value: f64::cbrt;
                slope: |_, y| inverse(y.squared() * number(3.0));
                facts: Facts { steep: &[0.0], ..CONTINUOUS };
            }
            /// Returns |x|. The slope is 1 at 0 and −0.
            Abs abs "abs" {
                value: f64::abs;
                slope: |u, _| side(u);
                facts: Facts { range: ABOVE_0, extrema: &[(Place::At(0.0), 0.0)], ..EXACT };
            }
            /// Returns 1 for x ≥ +0, −1 for x ≤ −0 and NaN for NaN. The slope is 0.
            Signum signum "signum" {
                value: f64::signum;
                slope: |_, _| number(0.0);
                // The sign of a zero is that of its way of being computed.
                facts: Facts { range: UNIT, poles: &[Place::At(0.0)], growth: Growth::Bounded, ..EXACT };
            }
            /// Returns the largest whole number ≤ x. The slope is 0.
            Floor floor "floor" {
                value: f64::floor;
                slope: |_, _| number(0.0);
                facts: Facts { jumps: Some(f64::floor), ..EXACT };
            }
            /// Returns the smallest whole number ≥ x. The slope is 0.
            Ceil ceil "ceil" {
                value: f64::ceil;
                slope: |_, _| number(0.0);
                facts: Facts { jumps: Some(f64::ceil), ..EXACT };
            }
            /// Rounds to the nearest whole number, and a half away from 0. The slope is 0.
            Round round "round" {
                value: f64::round;
                slope: |_, _| number(0.0);
                facts: Facts { jumps: Some(f64::round), ..EXACT };
            }
            /// Returns the whole part of x, rounded towards 0. The slope is 0.
            Trunc trunc "trunc" {
                value: f64::trunc;
                slope: |_, _| number(0.0);
                facts: Facts { jumps: Some(f64::trunc), ..EXACT };
            }
            /// Returns x − trunc x, with the sign of x. The slope is 1.
            Fract fract "fract" {
                value: f64::fract;
                slope: |_, _| number(1.0);
                facts: Facts { range: UNIT, jumps: Some(f64::trunc), growth: Growth::Bounded, ..EXACT };
            }
        }
    };
}

/// Hands every function of two numbers to a macro, as [`functions_of_one`](crate::functions_of_one)
/// does; the operator `%` is a method of [`std::ops::Rem`].
///
/// * `value`: its value in f64;
/// * `definition`: an expression in other functions of the list, for numbers of any kind. It gives
///   the bounds, derivatives and 60 digits of a function that has none written by hand;
/// * `slopes`: ∂z/∂u and ∂z/∂v of z = f(u, v), for numbers of any kind;
/// * `facts`: exactness, jumps, growth ([`FactsOfTwo`](crate::functions::FactsOfTwo)).
#[macro_export]
macro_rules! functions_of_two {
    ($to:ident) => {
        $to! {
            /// Returns the angle of the point (x, y) = (`x`, `self`) in (−π, π] rad, exact on both
            /// axes. The derivatives are singular at (0, 0) unless both numbers are constant.
            Atan2 atan2 "atan2" {
                value: f64::atan2;
                slopes: |u, v, _| {
                    let r2 = u.clone().squared() + v.clone().squared();
                    let minus = -u;
                    (v / r2.clone(), minus / r2)
                };
                facts: FactsOfTwo { growth: Growth::Bounded, ..SMOOTH };
            }
            /// Returns √(x² + y²) without overflow. The derivatives are singular at (0, 0) unless
            /// both numbers are constant.
            Hypot hypot "hypot" {
                value: f64::hypot;
                definition: |u, v| root(u.squared() + v.squared());
                slopes: |u, v, z| (u / z.clone(), v / z);
                facts: SMOOTH;
            }
            /// Returns xⁿ.
            ///
            /// For a constant n the derivatives are n xⁿ⁻¹, n (n − 1) xⁿ⁻², …. A derivative is
            /// infinite at x = 0 if its exponent is negative and its factor is not 0. A variable n
            /// needs x > 0, or x = 0 and n > 0.
            Powf powf "powf" {
                value: f64::powf;
                definition: |u, v| (v * u.call(Function::Ln)).call(Function::Exp);
                slopes: |u, v, z| (lower_power(&u, &v), logarithm_times(u, z));
                facts: FactsOfTwo { growth: Growth::Bursting, ..SMOOTH };
            }
            /// Returns the larger number, or `self` if both are equal. If one is NaN, the result is
            /// the other.
            Max max "max" {
                value: f64::max;
                slopes: |u, v, _| choice(first_of(Comparison::GreaterEqual, u, v));
                facts: FactsOfTwo { exact: true, ..SMOOTH };
            }
            /// Returns the smaller number, or `self` if both are equal. If one is NaN, the result
            /// is the other.
            Min min "min" {
                value: f64::min;
                slopes: |u, v, _| choice(first_of(Comparison::LessEqual, u, v));
                facts: FactsOfTwo { exact: true, ..SMOOTH };
            }
            /// Returns x − n y ≥ 0; the whole number n is constant between jumps.
            RemEuclid rem_euclid "rem_euclid" {
                value: f64::rem_euclid;
                definition: |u, v| u.clone() - u.call2(Function2::DivEuclid, v.clone()) * v;
                slopes: |u, v, _| (number(1.0), -u.call2(Function2::DivEuclid, v));
                facts: FactsOfTwo { jumps: true, ..SMOOTH };
            }
            /// Returns the whole number n of [`rem_euclid`](Self::rem_euclid). The slope is 0.
            DivEuclid div_euclid "div_euclid" {
                value: f64::div_euclid;
                slopes: |_, _, _| (number(0.0), number(0.0));
                facts: FactsOfTwo { jumps: true, ..SMOOTH };
            }
            /// Returns x − n y with the sign of x; the whole number n is constant between jumps.
            Rem rem "%" {
                value: <f64 as std::ops::Rem>::rem;
                slopes: |u, v, _| (number(1.0), -(u / v).call(Function::Trunc));
                facts: FactsOfTwo { exact: true, jumps: true, ..SMOOTH };
            }
        }
    };
}
