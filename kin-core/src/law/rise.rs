//! Creates rises from 0 to a height over a length, with a dwell before and after, for cams and
//! indexing machines.

use std::f64::consts::{PI, TAU};

use super::{Break, Law, LawFunction, shapes, trusted_parts};
use crate::dimensions::IntoNumber;
use crate::numbers::enclosure::{Interval, Series, piecewise};

impl Law {
    /// Returns the simple harmonic rise f(x) = h/2 (1 − cos(π x/β)) for 0 ≤ x ≤ β.
    ///
    /// The law is 0 before the rise and h after the rise. The acceleration jumps at both ends of
    /// the rise.
    pub fn harmonic_rise(height: impl IntoNumber, length: impl IntoNumber) -> Law {
        rise(Shape::Harmonic, height, length)
    }

    /// Returns the cycloidal rise f(x) = h (x/β − sin(2π x/β)/2π) for 0 ≤ x ≤ β.
    ///
    /// The law is 0 before the rise and h after the rise.
    pub fn cycloidal(height: impl IntoNumber, length: impl IntoNumber) -> Law {
        rise(Shape::Cycloidal, height, length)
    }

    /// Returns the 3-4-5 polynomial rise f(x) = h (10 ξ³ − 15 ξ⁴ + 6 ξ⁵) with ξ = x/β for
    /// 0 ≤ x ≤ β.
    ///
    /// The law is 0 before the rise and h after the rise.
    pub fn polynomial_345(height: impl IntoNumber, length: impl IntoNumber) -> Law {
        rise(Shape::Polynomial345, height, length)
    }

    /// Returns the 4-5-6-7 polynomial rise f(x) = h (35 ξ⁴ − 84 ξ⁵ + 70 ξ⁶ − 20 ξ⁷) with ξ = x/β
    /// for 0 ≤ x ≤ β.
    ///
    /// The law is 0 before the rise and h after the rise. No derivative up to the third jumps.
    pub fn polynomial_4567(height: impl IntoNumber, length: impl IntoNumber) -> Law {
        rise(Shape::Polynomial4567, height, length)
    }

    /// Returns the modified sine rise: f″ is a sine for an eighth of β, then a slower cosine, then
    /// the sine again.
    ///
    /// The sine has the period β/2 and the cosine the period 3β/2. The law is 0 before the rise and
    /// h after the rise. The largest acceleration is 5.528 h/β².
    pub fn modified_sine(height: impl IntoNumber, length: impl IntoNumber) -> Law {
        rise(Shape::ModifiedSine, height, length)
    }

    /// Returns the modified trapezoidal rise: f″ is a trapezoid whose ramps are quarters of a sine.
    ///
    /// Each ramp is an eighth of β long. The law is 0 before the rise and h after the rise. The
    /// largest acceleration is 4.888 h/β².
    pub fn modified_trapezoid(height: impl IntoNumber, length: impl IntoNumber) -> Law {
        rise(Shape::ModifiedTrapezoid, height, length)
    }
}

fn rise(shape: Shape, height: impl IntoNumber, length: impl IntoNumber) -> Law {
    Law::hanging(|to| Rise {
        shape,
        height: to.number("height", height),
        length: to.number("length", length),
    })
}

/// The law height · s(x/length).
#[derive(Clone)]
struct Rise {
    shape: Shape,
    height: f64,
    length: f64,
}

/// The shape s(ξ) of a rise on 0..1, from 0 to 1.
#[derive(Clone, Copy)]
enum Shape {
    Harmonic,
    Cycloidal,
    Polynomial345,
    Polynomial4567,
    ModifiedSine,
    ModifiedTrapezoid,
}

impl Shape {
    /// Returns \[s, s′, s″, s‴, s⁗\] for 0 ≤ ξ ≤ 1.
    fn jet(self, x: f64) -> [f64; 5] {
        match self {
            Shape::Harmonic => {
                let (s, c) = (PI * x).sin_cos();
                [
                    0.5 * (1.0 - c),
                    0.5 * PI * s,
                    0.5 * PI * PI * c,
                    -0.5 * PI.powi(3) * s,
                    -0.5 * PI.powi(4) * c,
                ]
            }
            Shape::Cycloidal => {
                let (s, c) = (TAU * x).sin_cos();
                [x - s / TAU, 1.0 - c, TAU * s, TAU * TAU * c, -TAU.powi(3) * s]
            }
            Shape::Polynomial345 => {
                let s1 = x * x * (30.0 + x * (-60.0 + 30.0 * x));
                let s2 = x * (60.0 + x * (-180.0 + 120.0 * x));
                [
                    x.powi(3) * (10.0 + x * (-15.0 + 6.0 * x)),
                    s1,
                    s2,
                    60.0 + x * (-360.0 + 360.0 * x),
                    -360.0 + 720.0 * x,
                ]
            }
            Shape::Polynomial4567 => {
                let s = x.powi(4) * (35.0 + x * (-84.0 + x * (70.0 - 20.0 * x)));
                let s1 = x.powi(3) * (140.0 + x * (-420.0 + x * (420.0 - 140.0 * x)));
                let s2 = x * x * (420.0 + x * (-1680.0 + x * (2100.0 - 840.0 * x)));
                let s3 = x * (840.0 + x * (-5040.0 + x * (8400.0 - 4200.0 * x)));
                [s, s1, s2, s3, 840.0 + x * (-10080.0 + x * (25200.0 - 16800.0 * x))]
            }
            Shape::ModifiedSine => mirrored(x, modified_sine),
            Shape::ModifiedTrapezoid => mirrored(x, modified_trapezoid),
        }
    }

    /// Returns s with bounds for a bounded ξ.
    fn over(self, x: &Series) -> Option<Series> {
        let pi = |factor: f64| Series::constant(Interval::pi(factor));
        let x = *x;
        let powers = |c: &[f64], first: i32| {
            x.powi(first) * c.iter().rev().fold(x.times(0.0), |sum, c| (sum * x).plus(*c))
        };
        match self {
            Shape::Harmonic => Some((-(pi(1.0) * x).sin_cos().1).plus(1.0).times(0.5)),
            Shape::Cycloidal => Some(x - (pi(2.0) * x).sin_cos().0 / pi(2.0)),
            Shape::Polynomial345 => Some(powers(&[10.0, -15.0, 6.0], 3)),
            Shape::Polynomial4567 => Some(powers(&[35.0, -84.0, 70.0, -20.0], 4)),
            Shape::ModifiedSine => shapes::mirrored(&x, &shapes::modified_sine),
            Shape::ModifiedTrapezoid => shapes::mirrored(&x, &shapes::modified_trapezoid),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Shape::Harmonic => "harmonic_rise",
            Shape::Cycloidal => "cycloidal",
            Shape::Polynomial345 => "polynomial_345",
            Shape::Polynomial4567 => "polynomial_4567",
            Shape::ModifiedSine => "modified_sine",
            Shape::ModifiedTrapezoid => "modified_trapezoid",
        }
    }

    /// Returns the lowest derivative that jumps at the ends, if it is one of the first three.
    fn order(self) -> Option<usize> {
        match self {
            Shape::Harmonic => Some(2),
            Shape::Polynomial4567 => None,
            _ => Some(3),
        }
    }
}

/// Evaluates a shape with s(1 − ξ) = 1 − s(ξ) from its first half.
fn mirrored(x: f64, half: fn(f64) -> [f64; 5]) -> [f64; 5] {
    if x <= 0.5 {
        return half(x);
    }
    let [s, s1, s2, s3, s4] = half(1.0 - x);
    [1.0 - s, s1, -s2, s3, -s4]
}

/// Evaluates the first eighth of both modified shapes: s″ = a sin 4πξ.
fn first_eighth(x: f64, a: f64) -> [f64; 5] {
    let w = 4.0 * PI;
    let (s, c) = (w * x).sin_cos();
    [a * (x / w - s / (w * w)), a * (1.0 - c) / w, a * s, a * w * c, -a * w * w * s]
}

/// Evaluates s″ = a cos w τ with s = s0 and s′ = v0 at τ = 0.
fn cosine(tau: f64, a: f64, w: f64, [s0, v0]: [f64; 2]) -> [f64; 5] {
    let (s, c) = (w * tau).sin_cos();
    [s0 + v0 * tau + a * (1.0 - c) / (w * w), v0 + a * s / w, a * c, -a * w * s, -a * w * w * c]
}

/// Evaluates s″ = a sin 4πξ to 1/8, then a cos(4π(ξ − 1/8)/3), with a = 4π²/(π + 4). Norton, *Cam
/// Design and Manufacturing Handbook*.
fn modified_sine(x: f64) -> [f64; 5] {
    let a = 4.0 * PI * PI / (PI + 4.0);
    if x < 0.125 {
        return first_eighth(x, a);
    }
    let [s, v, ..] = first_eighth(0.125, a);
    cosine(x - 0.125, a, 4.0 * PI / 3.0, [s, v])
}

/// Evaluates s″ = a sin 4πξ to 1/8, a to 3/8, then a cos 4π(ξ − 3/8), with a = 8π/(2 + π). Norton.
fn modified_trapezoid(x: f64) -> [f64; 5] {
    let a = 8.0 * PI / (2.0 + PI);
    if x < 0.125 {
        return first_eighth(x, a);
    }
    let [s, v, ..] = first_eighth(0.125, a);
    let constant = |tau: f64| [s + v * tau + 0.5 * a * tau * tau, v + a * tau];
    if x < 0.375 {
        let [s, v] = constant(x - 0.125);
        return [s, v, a, 0.0, 0.0];
    }
    cosine(x - 0.375, a, 4.0 * PI, constant(0.25))
}

impl Rise {
    /// Returns the shape's jet at x, or `None` if x is before or after the rise.
    fn inside(&self, x: f64) -> Option<[f64; 5]> {
        (x >= 0.0 && x < self.length).then(|| self.shape.jet(x / self.length))
    }
}

impl LawFunction for Rise {
    fn jet(&self, x: f64) -> [f64; 4] {
        let Some([s, s1, s2, s3, _]) = self.inside(x) else {
            return [if x.is_sign_negative() { 0.0 } else { self.height }, 0.0, 0.0, 0.0];
        };
        let h = self.height;
        let l = self.length;
        [h * s, h * s1 / l, h * s2 / (l * l), h * s3 / (l * l * l)]
    }

    fn kind(&self) -> &str {
        self.shape.name()
    }

    fn description(&self) -> &str {
        match self.shape {
            Shape::Harmonic => {
                "Simple harmonic rise: f(x) = h/2 (1 − cos(π x/β)). For x < 0 f is 0, and for x > β f is h."
            }
            Shape::Cycloidal => {
                "Cycloidal rise: f(x) = h (x/β − sin(2π x/β)/2π). For x < 0 f is 0, and for x > β f is h."
            }
            Shape::Polynomial345 => {
                "3-4-5 polynomial rise: f(x) = h (10 ξ³ − 15 ξ⁴ + 6 ξ⁵) with ξ = x/β. For x < 0 f is 0, and for x > β f is h."
            }
            Shape::Polynomial4567 => {
                "4-5-6-7 polynomial rise: f(x) = h (35 ξ⁴ − 84 ξ⁵ + 70 ξ⁶ − 20 ξ⁷) with ξ = x/β. For x < 0 f is 0, and for x > β f is h."
            }
            Shape::ModifiedSine => {
                "Modified sine rise: the acceleration f″ consists of two quarter sines and a long cosine between them. For x < 0 f is 0, and for x > β f is h."
            }
            Shape::ModifiedTrapezoid => {
                "Modified trapezoidal rise: the acceleration f″ is a trapezoid with ramps that are parts of a sine. For x < 0 f is 0, and for x > β f is h."
            }
        }
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        piecewise(x, &[0.0, self.length], &|k, x| {
            Some(match k {
                0 => x.times(0.0),
                1 => self
                    .shape
                    .over(&(*x / Series::constant(Interval::from(self.length))))?
                    .times(self.height),
                _ => x.times(0.0).plus(self.height),
            })
        })
    }

    fn fourth(&self, x: f64) -> f64 {
        self.inside(x).map_or(0.0, |s| self.height * s[4] / self.length.powi(4))
    }

    fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
        let ends = self.shape.order().map(|order| [0.0, self.length].map(|x| Break { x, order }));
        ends.into_iter()
            .flatten()
            .filter(|b| self.height != 0.0 && (from..=to).contains(&b.x))
            .collect()
    }

    fn is_smooth(&self) -> bool {
        self.shape.order().is_none()
    }

    fn refusal(&self) -> Option<String> {
        (self.length <= 0.0).then(|| {
            format!(
                "{}: the length of a rise must be above zero (length = {})",
                self.kind(),
                self.length
            )
        })
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        visit("height", self.height);
        visit("length", self.length);
    }

    fn by_parameter(&self, name: &str) -> Option<Law> {
        (name == "height").then(|| rise(self.shape, 1.0, self.length))
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let mut changed = self.clone();
        *match name {
            "height" => &mut changed.height,
            "length" => &mut changed.length,
            _ => return None,
        } = value;
        Some(Law::new(changed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::tests::near;

    /// Where pieces of the modified shapes meet the fourth derivative is that of the right side.
    #[test]
    fn fourth_derivatives_where_pieces_meet() {
        let h = 0.5;
        let l = 2.0;
        let fourth = |law: &Law, x: f64| law.fourth(x * l) * l.powi(4) / h;
        let sine = Law::modified_sine(h, l);
        let trapezoid = Law::modified_trapezoid(h, l);
        let a = 4.0 * PI * PI / (PI + 4.0);
        near(fourth(&sine, 0.125) / a, -(4.0 * PI / 3.0).powi(2), 1e-13);
        near(fourth(&sine, 0.125_f64.next_down()) / a, -(4.0 * PI).powi(2), 1e-13);
        let a = 8.0 * PI / (2.0 + PI);
        assert_eq!(
            (fourth(&trapezoid, 0.125), fourth(&trapezoid, 0.375_f64.next_down())),
            (0.0, 0.0)
        );
        near(fourth(&trapezoid, 0.125_f64.next_down()) / a, -(4.0 * PI).powi(2), 1e-13);
        near(fourth(&trapezoid, 0.375) / a, -(4.0 * PI).powi(2), 1e-13);
        assert_eq!(
            [-1.0, 2.0, 3.0].map(|x| (sine.jet(x), sine.fourth(x))),
            [([0.0; 4], 0.0), ([h, 0.0, 0.0, 0.0], 0.0), ([h, 0.0, 0.0, 0.0], 0.0)]
        );
        assert!(Law::polynomial_4567(1.0, 1.0).is_smooth() && !sine.is_smooth());
    }
}
