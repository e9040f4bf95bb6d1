//! Numbers of 77 digits, to say what is true.

use std::cell::RefCell;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use astro_float_num::{BigFloat, Consts, Radix, RoundingMode};

/// Bits of a number.
const P: usize = 256;
const NEAREST: RoundingMode = RoundingMode::ToEven;

thread_local! {
    static CONSTANTS: RefCell<Consts> = RefCell::new(Consts::new().expect("constants"));
}

/// A number of 77 digits.
#[derive(Clone, Debug)]
pub struct Wide(BigFloat);

/// An f64 as it is.
pub fn w(x: f64) -> Wide {
    Wide(BigFloat::from_f64(x, P))
}

/// A decimal as it is written.
pub fn dec(text: &str) -> Wide {
    CONSTANTS
        .with_borrow_mut(|constants| Wide(BigFloat::parse(text, Radix::Dec, P, NEAREST, constants)))
}

macro_rules! operators {
    ($($trait:ident $name:ident),*) => {$(
        impl $trait<&Wide> for &Wide {
            type Output = Wide;
            fn $name(self, other: &Wide) -> Wide {
                Wide(self.0.$name(&other.0, P, NEAREST))
            }
        }
        operators!(by_value $trait $name [Wide, Wide] [Wide, &Wide] [&Wide, Wide]);
        impl $trait<f64> for Wide {
            type Output = Wide;
            fn $name(self, other: f64) -> Wide {
                $trait::$name(&self, &w(other))
            }
        }
        impl $trait<f64> for &Wide {
            type Output = Wide;
            fn $name(self, other: f64) -> Wide {
                $trait::$name(self, &w(other))
            }
        }
        impl $trait<Wide> for f64 {
            type Output = Wide;
            fn $name(self, other: Wide) -> Wide {
                $trait::$name(&w(self), &other)
            }
        }
        impl $trait<&Wide> for f64 {
            type Output = Wide;
            fn $name(self, other: &Wide) -> Wide {
                $trait::$name(&w(self), other)
            }
        }
    )*};
    (by_value $trait:ident $name:ident $([$a:ty, $b:ty])*) => {$(
        impl $trait<$b> for $a {
            type Output = Wide;
            #[allow(clippy::op_ref)]
            fn $name(self, other: $b) -> Wide {
                $trait::$name(std::borrow::Borrow::<Wide>::borrow(&self), std::borrow::Borrow::<Wide>::borrow(&other))
            }
        }
    )*};
}

operators!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Wide {
    type Output = Wide;
    fn neg(self) -> Wide {
        -&self
    }
}

impl Neg for &Wide {
    type Output = Wide;
    fn neg(self) -> Wide {
        Wide(BigFloat::neg(&self.0))
    }
}

impl PartialEq for Wide {
    fn eq(&self, other: &Wide) -> bool {
        self.0.cmp(&other.0) == Some(0)
    }
}

impl PartialOrd for Wide {
    fn partial_cmp(&self, other: &Wide) -> Option<Ordering> {
        self.0.cmp(&other.0).map(|sign| sign.cmp(&0))
    }
}

impl PartialEq<f64> for Wide {
    fn eq(&self, other: &f64) -> bool {
        *self == w(*other)
    }
}

impl PartialOrd<f64> for Wide {
    fn partial_cmp(&self, other: &f64) -> Option<Ordering> {
        self.partial_cmp(&w(*other))
    }
}

macro_rules! functions {
    ($($name:ident)*; $($plain:ident)*; $($root:ident)*) => {
        #[allow(dead_code)]
        impl Wide {
            $(pub fn $name(&self) -> Wide {
                CONSTANTS.with_borrow_mut(|constants| Wide(self.0.$name(P, NEAREST, constants)))
            })*
            $(pub fn $plain(&self) -> Wide {
                Wide(self.0.$plain())
            })*
            $(pub fn $root(&self) -> Wide {
                Wide(self.0.$root(P, NEAREST))
            })*
        }
    };
}

functions!(sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh exp ln log2 log10; abs floor ceil; sqrt cbrt);

#[allow(dead_code)]
impl Wide {
    pub fn trunc(&self) -> Wide {
        if *self < 0.0 { self.ceil() } else { self.floor() }
    }

    pub fn fract(&self) -> Wide {
        self - self.trunc()
    }

    /// Halves away from zero.
    pub fn round(&self) -> Wide {
        if *self < 0.0 { -(0.5 - self).floor() } else { (self + 0.5).floor() }
    }

    pub fn signum(&self) -> Wide {
        w(if *self < 0.0 { -1.0 } else { 1.0 })
    }

    pub fn rem(&self, other: &Wide) -> Wide {
        self - other * (self / other).trunc()
    }

    pub fn rem_euclid(&self, other: &Wide) -> Wide {
        self - other * self.div_euclid(other)
    }

    pub fn div_euclid(&self, other: &Wide) -> Wide {
        if *other > 0.0 { (self / other).floor() } else { (self / other).ceil() }
    }

    pub fn max(&self, other: &Wide) -> Wide {
        if self < other { other.clone() } else { self.clone() }
    }

    pub fn min(&self, other: &Wide) -> Wide {
        if self > other { other.clone() } else { self.clone() }
    }

    pub fn hypot(&self, other: &Wide) -> Wide {
        (self * self + other * other).sqrt()
    }

    pub fn powf(&self, other: &Wide) -> Wide {
        (other * self.ln()).exp()
    }

    pub fn pi() -> Wide {
        4.0 * w(1.0).atan()
    }

    /// The angle of (x, self).
    pub fn atan2(&self, x: &Wide) -> Wide {
        if *x > 0.0 {
            (self / x).atan()
        } else if *self == 0.0 {
            if *x < 0.0 { Wide::pi() } else { w(0.0) }
        } else {
            // the angle from the y-axis
            let quarter = 0.5 * Wide::pi() * self.signum();
            quarter - (x / self).atan()
        }
    }

    /// True if |self| ≤ bound.
    pub fn is_within(&self, bound: f64) -> bool {
        self.abs() <= bound
    }

    /// For messages.
    pub fn show(&self) -> String {
        CONSTANTS
            .with_borrow_mut(|constants| self.0.format(Radix::Dec, NEAREST, constants))
            .unwrap_or_default()
            .chars()
            .take(24)
            .collect()
    }
}
