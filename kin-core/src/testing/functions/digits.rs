//! Numbers of more than 60 digits, and their Taylor series, walking the list of functions.

use std::cell::RefCell;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use astro_float_num::{BigFloat, Consts, RoundingMode};
use kin_graph::{Comparison, Function, Function2, Number, rules};

/// Bits of a number: of 1 + 5e-324 there are still 60 digits.
const BITS: usize = 1280;
const NEAREST: RoundingMode = RoundingMode::ToEven;

thread_local! {
    static CONSTANTS: RefCell<Consts> = RefCell::new(Consts::new().expect("constants"));
}

#[derive(Clone, Debug)]
pub struct Digits(BigFloat);

type Elementary = fn(&BigFloat, usize, RoundingMode, &mut Consts) -> BigFloat;

/// The functions that the library of such numbers has; all others need a definition by these.
const ELEMENTARY: [(&str, Elementary); 18] = [
    ("sin", BigFloat::sin),
    ("cos", BigFloat::cos),
    ("tan", BigFloat::tan),
    ("asin", BigFloat::asin),
    ("acos", BigFloat::acos),
    ("atan", BigFloat::atan),
    ("sinh", BigFloat::sinh),
    ("cosh", BigFloat::cosh),
    ("tanh", BigFloat::tanh),
    ("asinh", BigFloat::asinh),
    ("acosh", BigFloat::acosh),
    ("atanh", BigFloat::atanh),
    ("exp", BigFloat::exp),
    ("ln", BigFloat::ln),
    ("log2", BigFloat::log2),
    ("log10", BigFloat::log10),
    ("sqrt", |x, bits, rounding, _| x.sqrt(bits, rounding)),
    ("cbrt", |x, bits, rounding, _| x.cbrt(bits, rounding)),
];

impl Digits {
    pub fn new(x: f64) -> Self {
        if x.is_subnormal() {
            // The library takes these for others.
            return Digits::new(x * 2f64.powi(100)) / Digits::new(2f64.powi(100));
        }
        Digits(BigFloat::from_f64(x, BITS))
    }

    /// The sum of two f64s.
    pub fn sum(a: f64, b: f64) -> Self {
        Digits::new(a) + Digits::new(b)
    }

    pub fn abs(self) -> Self {
        Digits(self.0.abs())
    }

    fn whole(self, upwards: bool) -> Self {
        Digits(if upwards { self.0.ceil() } else { self.0.floor() })
    }

    fn truncated(self) -> Self {
        let upwards = self < Digits::new(0.0);
        self.whole(upwards)
    }

    /// Functions that f64 has exactly; `None` of others.
    fn exactly(self, name: &str) -> Option<Self> {
        let sign = if self.0.is_negative() { -1.0 } else { 1.0 };
        Some(match name {
            "abs" => self.abs(),
            "signum" => Digits::new(sign),
            "floor" => self.whole(false),
            "ceil" => self.whole(true),
            "trunc" => self.truncated(),
            "round" => (self + Digits::new(0.5 * sign)).truncated(),
            "fract" => self.clone() - self.truncated(),
            _ => return None,
        })
    }
}

impl Neg for Digits {
    type Output = Self;

    fn neg(self) -> Self {
        Digits(BigFloat::neg(&self.0))
    }
}

macro_rules! operator {
    ($($trait:ident $name:ident),*) => {$(
        impl $trait for Digits {
            type Output = Self;

            fn $name(self, other: Self) -> Self {
                Digits(self.0.$name(&other.0, BITS, NEAREST))
            }
        }
    )*};
}

operator!(Add add, Sub sub, Mul mul, Div div);

impl PartialEq for Digits {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for Digits {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.cmp(&other.0).map(|sign| sign.cmp(&0))
    }
}

/// The operations on conditions of numbers that compare as they are.
macro_rules! compared {
    () => {
        type Condition = bool;

        fn compare(comparison: Comparison, a: &Self, b: &Self) -> bool {
            comparison.holds(a, b)
        }

        fn select(condition: &bool, a: Self, b: Self) -> Self {
            if *condition { a } else { b }
        }

        fn of_condition(condition: &bool) -> Self {
            Self::constant(if *condition { 1.0 } else { 0.0 })
        }

        fn holds(&self) -> bool {
            *self != Self::constant(0.0)
        }
    };
}

impl Number for Digits {
    compared!();

    fn constant(x: f64) -> Self {
        Digits::new(x)
    }

    fn logarithm_of(x: f64) -> Self {
        Digits::new(x).call(Function::Ln)
    }

    fn call(self, f: Function) -> Self {
        let known = ELEMENTARY.iter().find(|(name, _)| *name == f.method());
        if let Some((_, function)) = known {
            return CONSTANTS
                .with_borrow_mut(|constants| Digits(function(&self.0, BITS, NEAREST, constants)));
        }
        let exactly = self.clone().exactly(f.method());
        exactly.or_else(|| rules::definition(f, self)).unwrap_or_else(|| {
            panic!("{}: its entry has no `definition` by which 60 digits of it are known", f.name())
        })
    }

    fn call2(self, f: Function2, other: Self) -> Self {
        let x = self;
        let y = other;
        let is_negative = |x: &Digits| x.0.is_negative();
        match f.method() {
            "atan2" => angle(x, y),
            "max" => {
                if x >= y {
                    x
                } else {
                    y
                }
            }
            "min" => {
                if x <= y {
                    x
                } else {
                    y
                }
            }
            "%" => x.clone() - (x / y.clone()).truncated() * y,
            "div_euclid" => {
                let upwards = is_negative(&y);
                (x / y).whole(upwards)
            }
            _ => rules::definition_of_two(f, x, y).unwrap_or_else(|| {
                panic!(
                    "{}: its entry has no `definition` by which 60 digits of it are known",
                    f.name()
                )
            }),
        }
    }

    fn powi(self, n: i32) -> Self {
        let power = (0..n.unsigned_abs()).fold(Digits::new(1.0), |power, _| power * self.clone());
        if n < 0 { Digits::new(1.0) / power } else { power }
    }
}

/// The angle of (x, y), twice that of (√(x² + y²) + |x|, y) or what is left of a half turn.
fn angle(y: Digits, x: Digits) -> Digits {
    let length = (x.clone().squared() + y.clone().squared()).call(Function::Sqrt);
    let half = (y.clone() / (length + x.clone().abs())).call(Function::Atan);
    let angle = half.clone() + half;
    if x >= Digits::new(0.0) {
        return angle;
    }
    let turn = Digits::new(-1.0).call(Function::Acos);
    if y.0.is_negative() { -turn - angle } else { turn - angle }
}

/// A Taylor series of as many coefficients as are known, at most [`ORDERS`].
#[derive(Clone, Debug)]
pub struct Taylor(pub Vec<Digits>);

/// The value and three derivatives.
pub const ORDERS: usize = 4;

impl Taylor {
    /// x + s
    pub fn variable(x: f64) -> Self {
        let mut series = Taylor::constant(x);
        series.0[1] = Digits::new(1.0);
        series
    }

    fn cut(&self, len: usize) -> Self {
        Taylor(self.0.iter().take(len).cloned().collect())
    }

    fn each(self, other: Self, f: impl Fn(Digits, Digits) -> Digits) -> Self {
        Taylor(self.0.into_iter().zip(other.0).map(|(a, b)| f(a, b)).collect())
    }

    /// Σ j x_j r_(k−j) / k over j = 1 … k: coefficient k of ∫ r x′.
    fn slope_times(&self, r: &Taylor, k: usize) -> Digits {
        let terms = (1..=k).map(|j| Digits::new(j as f64) * self.0[j].clone() * r.0[k - j].clone());
        terms.fold(Digits::new(0.0), Add::add) / Digits::new(k as f64)
    }

    /// Its derivatives: k! times coefficient k.
    pub fn derivatives(self) -> Vec<Digits> {
        let factorials = [1.0, 1.0, 2.0, 6.0];
        self.0
            .into_iter()
            .zip(factorials)
            .map(|(c, factorial)| c * Digits::new(factorial))
            .collect()
    }
}

impl Neg for Taylor {
    type Output = Self;

    fn neg(self) -> Self {
        Taylor(self.0.into_iter().map(Neg::neg).collect())
    }
}

impl Add for Taylor {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.each(other, Add::add)
    }
}

impl Sub for Taylor {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self.each(other, Sub::sub)
    }
}

impl Mul for Taylor {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = |k: usize| {
            let terms = (0..=k).map(|j| self.0[j].clone() * other.0[k - j].clone());
            terms.fold(Digits::new(0.0), Add::add)
        };
        Taylor((0..self.0.len().min(other.0.len())).map(product).collect())
    }
}

impl Div for Taylor {
    type Output = Self;

    // Coefficient k of a = q b, less what is known of it.
    #[allow(clippy::suspicious_arithmetic_impl)]
    fn div(self, other: Self) -> Self {
        let mut quotient = Taylor(Vec::new());
        for k in 0..self.0.len().min(other.0.len()) {
            let known = (1..=k).map(|j| other.0[j].clone() * quotient.0[k - j].clone());
            let rest = known.fold(self.0[k].clone(), Sub::sub);
            quotient.0.push(rest / other.0[0].clone());
        }
        quotient
    }
}

impl PartialEq for Taylor {
    fn eq(&self, other: &Self) -> bool {
        self.0[0] == other.0[0]
    }
}

impl PartialOrd for Taylor {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0[0].partial_cmp(&other.0[0])
    }
}

impl Number for Taylor {
    compared!();

    fn constant(x: f64) -> Self {
        let mut series = Taylor(vec![Digits::new(0.0); ORDERS]);
        series.0[0] = Digits::new(x);
        series
    }

    fn logarithm_of(x: f64) -> Self {
        let mut series = Taylor::constant(0.0);
        series.0[0] = Digits::logarithm_of(x);
        series
    }

    /// From the rule of its slope: y′ = f′ x′, coefficient after coefficient.
    fn call(self, f: Function) -> Self {
        let first = Taylor(vec![self.0[0].clone().call(f)]);
        (1..self.0.len()).fold(first, |mut y, k| {
            let slope = rules::slope(f, self.cut(k), y.clone());
            y.0.push(self.slope_times(&slope, k));
            y
        })
    }

    /// The same of two: z′ = f_x x′ + f_y y′.
    fn call2(self, f: Function2, other: Self) -> Self {
        let first = Taylor(vec![self.0[0].clone().call2(f, other.0[0].clone())]);
        (1..self.0.len().min(other.0.len())).fold(first, |mut z, k| {
            let (by_x, by_y) = rules::slopes(f, self.cut(k), other.cut(k), z.clone());
            z.0.push(self.slope_times(&by_x, k) + other.slope_times(&by_y, k));
            z
        })
    }

    fn powi(self, n: i32) -> Self {
        let power =
            (0..n.unsigned_abs()).fold(Taylor::constant(1.0), |power, _| power * self.clone());
        if n < 0 { Taylor::constant(1.0) / power } else { power }
    }
}
