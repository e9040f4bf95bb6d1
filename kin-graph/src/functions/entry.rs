//! Describes the facts of a function that its entry in the list states in addition to formulas.

/// The facts of a function of one number.
///
/// A fact that an entry does not state has the value of [`CONTINUOUS`].
pub struct Facts {
    /// The domain of the function; both ends belong to the domain, unless they are poles.
    pub domain: [f64; 2],
    /// The range of the values; a bound is infinite if no f64 is the exact bound.
    pub range: [f64; 2],
    /// The extrema of the function, with their values: between two neighbours the function rises or
    /// falls.
    pub extrema: &'static [(Place, f64)],
    /// The places at which the function is infinite or jumps.
    pub poles: &'static [Place],
    /// The arguments at which the slope is infinite although the value is finite.
    pub steep: &'static [f64],
    /// A function that is constant between jumps and jumps at the same places as this function.
    pub jumps: Option<fn(f64) -> f64>,
    /// The growth of the values.
    pub growth: Growth,
    /// Returns a bound of the error of f64's value for arguments up to a size.
    /// \[units in the last place\]
    pub error: fn(f64) -> f64,
    /// True if f64 has a method with the name of the function.
    pub in_std: bool,
}

/// Places on the real line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    At(f64),
    /// At (first + k every) quarters of a turn, π/2 rad, for each whole k.
    Quarters {
        first: f64,
        every: f64,
    },
}

/// Growth of the values of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// The values grow like the argument, or like a power of the argument.
    Ordinary,
    /// The values are small and finite for every argument.
    Bounded,
    /// The function maps large arguments to small values.
    Logarithmic,
    /// The values grow like an exponential.
    Bursting,
}

/// The error that Kin allows for f64's elementary functions. \[units in the last place\]
///
/// The manual of glibc lists at most 4 units in the last place for these functions; the libraries
/// of other platforms state 1 or 2.
pub const ALLOWED: f64 = 8.0;

/// Of angles larger than this sine, cosine and tangent are allowed an error that is 8 times as
/// large: glibc takes so many turns off them that its cosine of 5.3e255, which is 4.7e-19, is off
/// by 7 units in the last place; no f64 is nearer to a multiple of a quarter turn.   \[rad\]
const LARGE_ANGLE: f64 = 1e5;

/// The facts of a function that has a value everywhere and is monotonic.
pub const CONTINUOUS: Facts = Facts {
    domain: ALL,
    range: ALL,
    extrema: &[],
    poles: &[],
    steep: &[],
    jumps: None,
    growth: Growth::Ordinary,
    error: |_| ALLOWED,
    in_std: true,
};

/// A function of angles.
pub(super) const OF_ANGLES: Facts =
    Facts { error: |size| if size > LARGE_ANGLE { 8.0 * ALLOWED } else { ALLOWED }, ..CONTINUOUS };

/// A logarithm, from its pole on.
pub(super) const LOGARITHM: Facts =
    Facts { domain: ABOVE_0, poles: &[Place::At(0.0)], growth: Growth::Logarithmic, ..CONTINUOUS };

/// Constant between jumps, or as exact as that.
pub(super) const EXACT: Facts = Facts { error: |_| 0.0, ..CONTINUOUS };

/// The facts of a function of two numbers.
pub struct FactsOfTwo {
    /// True if f64 has its values exactly.
    pub exact: bool,
    /// True if the values jump at some arguments, by an amount that is not a whole number of
    /// revolutions.
    pub jumps: bool,
    /// The growth of the values.
    pub growth: Growth,
    /// True if f64 has a method with the name of the function.
    pub in_std: bool,
}

/// The facts of a function of two numbers without jumps.
pub const SMOOTH: FactsOfTwo =
    FactsOfTwo { exact: false, jumps: false, growth: Growth::Ordinary, in_std: true };

pub(super) const ALL: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
pub(super) const ABOVE_0: [f64; 2] = [0.0, f64::INFINITY];
pub(super) const UNIT: [f64; 2] = [-1.0, 1.0];

/// An extremum at (first + k every) quarters of a turn.
pub(super) const fn at_quarters(first: f64, every: f64) -> Place {
    Place::Quarters { first, every }
}

impl Facts {
    /// True if f64 has its values exactly.
    pub fn is_exact(&self) -> bool {
        (self.error)(0.0) == 0.0
    }

    /// Returns true if the values jump from one finite value to another at some arguments.
    pub fn can_jump(&self) -> bool {
        self.jumps.is_some() || self.growth == Growth::Bounded && !self.poles.is_empty()
    }

    /// Returns true if the function has values everywhere, and a finite slope wherever the values
    /// are finite.
    pub const fn is_tame(&self) -> bool {
        let [from, to] = self.domain;
        from == f64::NEG_INFINITY && to == f64::INFINITY && self.steep.is_empty()
    }
}
