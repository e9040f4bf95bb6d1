//! Facts of a function that its entry in the list states beside formulas.

/// A function of one number, as far as numbers say it. What an entry does not name it has none of
/// ([`CONTINUOUS`]).
pub struct Facts {
    /// From where to where it has values: both ends belong to it, unless they are poles.
    pub domain: [f64; 2],
    /// Between which numbers its values stay; infinite where no f64 is the exact bound.
    pub range: [f64; 2],
    /// Places where it turns, with its value there: between two neighbours it rises or falls.
    pub extrema: &'static [(Place, f64)],
    /// Places where it is infinite, or jumps.
    pub poles: &'static [Place],
    /// Arguments at which its slope is infinite though its value is not.
    pub steep: &'static [f64],
    /// The function that is constant between jumps and jumps where this one does.
    pub jumps: Option<fn(f64) -> f64>,
    /// Growth of its values.
    pub growth: Growth,
    /// Bound of the error of f64's value for arguments up to a size.   \[units in the last place\]
    pub error: fn(f64) -> f64,
    /// True if f64 has a method of its name.
    pub in_std: bool,
}

/// Places on the line.
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
    /// As its argument does, or like a power of it.
    Ordinary,
    /// They are small and finite, whatever the argument.
    Bounded,
    /// It makes what is large small.
    Logarithmic,
    /// As those of an exponential.
    Bursting,
}

/// Error that f64's elementary functions are allowed: the manual of glibc lists at most 4 units in
/// the last place for all of them, other platforms' libraries state 1 or 2.   \[units in the last
/// place\]
pub const ALLOWED: f64 = 8.0;

/// Of angles larger than this sine, cosine and tangent are allowed an error that is 8 times as
/// large: glibc takes so many turns off them that its cosine of 5.3e255, which is 4.7e-19, is off
/// by 7 units in the last place; no f64 is nearer to a multiple of a quarter turn.   \[rad\]
const LARGE_ANGLE: f64 = 1e5;

/// A function that has a value everywhere and rises or falls all along.
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

/// A function of two numbers, as far as its entry says it without a formula.
pub struct FactsOfTwo {
    /// True if f64 has its values exactly.
    pub exact: bool,
    /// True if its values jump somewhere, by more or less than whole turns.
    pub jumps: bool,
    /// Growth of its values.
    pub growth: Growth,
    /// True if f64 has a method of its name.
    pub in_std: bool,
}

/// A function of two numbers without jumps.
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

    /// True if its values jump somewhere between two finite ones.
    pub fn can_jump(&self) -> bool {
        self.jumps.is_some() || self.growth == Growth::Bounded && !self.poles.is_empty()
    }

    /// True if it has values everywhere, and a finite slope wherever they are finite.
    pub const fn is_tame(&self) -> bool {
        let [from, to] = self.domain;
        from == f64::NEG_INFINITY && to == f64::INFINITY && self.steep.is_empty()
    }
}
